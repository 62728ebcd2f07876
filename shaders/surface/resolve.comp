// Computes the surfaces at the pixels of tiles, from the visible triangles.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "../layout.glsl"
#include "surface_layout.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform samplerBuffer triangles;  // numbers of three vertices and of the mesh
layout(binding = 2) uniform samplerBuffer materials;  // and the data that they refer to
layout(binding = 3) uniform samplerBuffer view;
layout(binding = 4) uniform samplerBuffer texels;
layout(binding = 5) uniform samplerBuffer tables;
layout(std430, binding = 6) readonly buffer Seen { uint seen[]; };
layout(std430, binding = 7) writeonly buffer Surfaces { vec4 surfaces[]; };
layout(std430, binding = 8) writeonly buffer Radiance { vec4 radiance[]; };
layout(std430, binding = 9) writeonly buffer Taken { vec4 taken[]; };  // the same surfaces, for the host
layout(constant_id = 0) const int kTaken = 0;                          // 1: the host needs them
#ifndef LAYERS
layout(constant_id = 1) const int LAYERS = 0;                         // 1: some surface may have a layer of layers.glsl
#endif
layout(constant_id = 2) const int kSmooth = 0;                         // 1: positions are those of the smooth terminator
layout(push_constant) uniform Push { uint first_tile; };

#include "prelude/prelude.glsl"
#include "math/constants.glsl"
#include "math/frame.glsl"
#include "math/inverse_trig.glsl"
#include "surface/surface.glsl"
#include "surface/texture.glsl"
#include "outline/polygon.glsl"
#include "lobe/microfacet.glsl"
#include "integral/ltc.glsl"
#include "textures.glsl"
#include "../lobes/tables.glsl"

vec3 unit(vec3 a) { return surface_has_direction(a) ? surface_unit(a) : vec3(0.0); }

// Corners of a triangle, and the weights that blend their values.
struct Corners {
    ivec3 number;
    vec3 weight;
};
vec4 blended(Corners at, int value) {
    return texelFetch(vertices, at.number.x * kVertex + value) * at.weight.x + texelFetch(vertices, at.number.y * kVertex + value) * at.weight.y +
           texelFetch(vertices, at.number.z * kVertex + value) * at.weight.z;
}

// Change of texture coordinates with the weights of the second and third corner.
vec4 change(Corners at, vec2 by) {
    vec4 first = texelFetch(vertices, at.number.x * kVertex + kVertexTexcoords);
    return (texelFetch(vertices, at.number.y * kVertex + kVertexTexcoords) - first) * by.x +
           (texelFetch(vertices, at.number.z * kVertex + kVertexTexcoords) - first) * by.y;
}

// Both sets of coordinates; sets that the mesh lacks are 0 everywhere.
struct Coordinates {
    vec4 at;
    vec4 right;
    vec4 down;
    int sets;
};
vec4 texture_of(int use, Coordinates c) {
    int set = int(texelFetch(materials, use).w);
    Footprint f;
    f.at = f.right = f.down = vec2(0.0);
    if ((c.sets & (1 << set)) != 0) {
        f.at = set == 0 ? c.at.xy : c.at.zw;
        f.right = set == 0 ? c.right.xy : c.right.zw;
        f.down = set == 0 ? c.down.xy : c.down.zw;
    }
    return sample_texture(use, f);
}

// The textures of a material at a place.
struct Textures {
    int first;  // place of their uses
    vec3 base;
    vec2 rough_metal;
    vec3 normal;
    vec3 emission;
    float specular;
    vec3 specular_color;
    vec3 sheen;
    float sheen_roughness;
    float coat;
    float coat_roughness;
    vec3 coat_normal;
    vec3 anisotropy;
};

// One loop over the textures, so that the code of a look-up is there once.
Textures textures_at(int first, Coordinates c) {
    Textures t;
    t.first = first;
    for (int use = 0; use < (LAYERS != 0 ? kUses : kUseSheen); use++) {
        vec4 v = texture_of(first + kUse * use, c);
        if (use == kUseBase) t.base = v.xyz;
        if (use == kUseMetallicRoughness) t.rough_metal = v.yz;
        if (use == kUseNormal) t.normal = v.xyz;
        if (use == kUseEmission) t.emission = v.xyz;
        if (use == kUseSpecular) t.specular = v.w;
        if (use == kUseSpecularColor) t.specular_color = v.xyz;
        if (use == kUseSheen) t.sheen = v.xyz;
        if (use == kUseSheenRoughness) t.sheen_roughness = v.w;
        if (use == kUseCoat) t.coat = v.x;
        if (use == kUseCoatRoughness) t.coat_roughness = v.y;
        if (use == kUseCoatNormal) t.coat_normal = v.xyz;
        if (use == kUseAnisotropy) t.anisotropy = v.xyz;
    }
    return t;
}

bool has_texture(Textures t, int use) { return texelFetch(materials, t.first + kUse * use).x >= 0.0; }

// Normal by the map of a use, or the frame's own without one.
vec3 bent_normal(Textures t, int use, SurfaceFrame frame) {
    if (!has_texture(t, use)) return frame.z;
    return surface_bent_normal(frame, use == kUseNormal ? t.normal : t.coat_normal, texelFetch(materials, t.first + kUse * use + 2).z);
}

struct Surface {
    vec3 position;
    vec3 normal;
    vec3 geometric;
    vec3 tangent;
    vec3 view;
    SurfaceWeights weights;
    vec2 alpha;
    float sheen_alpha;
    vec3 coat_normal;
    float coat_alpha;
    float mesh;  // its number from 1
    bool found;
    bool for_host;
};

void put(uint tile, uint slot, int plane, vec3 v, float beside) {
    surfaces[tile * uint(kPlanes * kSlots) + uint(plane * kSlots) + slot] = vec4(v, beside);
    if (kTaken != 0) taken[tile * uint(kPlanes * kSlots) + uint(plane * kSlots) + slot] = vec4(v, beside);
}

#include "layers.glsl"

Surface surface_of(uint triangle, vec3 direction) {
    Surface s;
    s.found = false;
    vec4 numbers = texelFetch(triangles, int(triangle));
    vec4 mesh = texelFetch(materials, int(numbers.w));
    int sets = int(mesh.w);
    s.mesh = numbers.w - float(kCodes) + 1.0;
    s.for_host = sets >= kForHost;
    if (s.for_host) return s;
    Corners at;
    at.number = ivec3(numbers.xyz);
    vec3 p0 = texelFetch(vertices, at.number.x * kVertex + kVertexPosition).xyz;
    vec3 e1 = texelFetch(vertices, at.number.y * kVertex + kVertexPosition).xyz - p0;
    vec3 e2 = texelFetch(vertices, at.number.z * kVertex + kVertexPosition).xyz - p0;
    vec3 n = cross(e1, e2);

    // Intersects the ray with the triangle's plane, and takes the nearest place in the triangle: rasters round corners.
    vec3 from = texelFetch(view, kViewOrigin).xyz - p0;
    vec3 across = cross(direction, e2);
    float determinant = dot(e1, across);
    float area2 = dot(n, n);
    if (determinant == 0.0 || !(area2 > 0.0)) return s;
    vec3 q = cross(from, e1);
    vec2 uv = clamp(vec2(dot(from, across), dot(direction, q)) / determinant, 0.0, 1.0);
    uv /= max(1.0, uv.x + uv.y);
    float distance = dot(e2, q) / determinant;
    at.weight = vec3(1.0 - uv.x - uv.y, uv);

    s.found = true;
    s.view = -direction;
    vec3 geometric = unit(n);
    float towards = dot(geometric, s.view);
    float side = towards < 0.0 ? -1.0 : 1.0;
    s.geometric = geometric * side;
    vec4 position = blended(at, kVertexPosition);
    s.position = position.xyz + geometric * (side * position.w);  // gbuffer.cpp's lift_off_lights
    if (kSmooth != 0) {
        vec3 hit = position.xyz;
        for (int i = 0; i < 3; i++) {
            int corner = at.number[i] * kVertex;
            vec3 to_corner = texelFetch(vertices, corner + kVertexPosition).xyz - hit;
            s.position += surface_lift(to_corner, unit(texelFetch(vertices, corner + kVertexNormal).xyz), s.geometric, at.weight[i]);
        }
    }
    vec3 up = unit(blended(at, kVertexNormal).xyz);
    if (!(dot(up, up) > 0.5)) up = geometric;

    int material = int(mesh.x);
    Coordinates c;
    c.sets = sets;
    if (c.sets != 0) {  // footprint_on
        float depth = distance * dot(direction, texelFetch(view, kViewForward).xyz);
        float facing = dot(n, direction);
        vec3 right = texelFetch(view, kViewStepRight).xyz;
        vec3 down = texelFetch(view, kViewStepDown).xyz;
        right = (right - direction * (dot(n, right) / facing)) * (depth / area2);
        down = (down - direction * (dot(n, down) / facing)) * (depth / area2);
        c.at = blended(at, kVertexTexcoords);
        c.right = change(at, vec2(dot(cross(right, e2), n), dot(cross(e1, right), n)));
        c.down = change(at, vec2(dot(cross(down, e2), n), dot(cross(e1, down), n)));
    }

    // The steps of surface_at, in its order.
    s.sheen_alpha = s.coat_alpha = 1.0;
    vec4 rest = texelFetch(materials, material + kMaterialRest);
    int flags = int(rest.w);
    Textures t = textures_at(material + kMaterialTextures, c);
    vec3 base = texelFetch(materials, material + kMaterialBase).xyz * t.base;
    if (mesh.z > 0.5) base *= blended(at, kVertexColor).xyz;
    if (LAYERS != 0 && (flags & kUnlit) != 0) {
        s.normal = s.coat_normal = up * side;
        s.tangent = frame_from_normal(up)[0];
        s.weights = surface_unlit(base);
        s.alpha = vec2(1.0);
        return s;
    }
    vec4 emission = texelFetch(materials, material + kMaterialEmission);
    emission.xyz = side > 0.0 || emission.w > 0.5 ? emission.xyz * t.emission : vec3(0.0);

    vec4 tangent = mesh.y > 0.5 ? blended(at, kVertexTangent) : vec4(0.0);
    SurfaceFrame frame = surface_frame(up, tangent, frame_from_normal(up)[0]);
    s.normal = surface_towards(bent_normal(t, kUseNormal, frame) * side, s.view, abs(towards));

    float metallic = clamp(rest.x * t.rough_metal.y, 0.0, 1.0);
    s.alpha = vec2(surface_alpha(rest.y * t.rough_metal.x));
    vec3 along = frame.x;
    if (LAYERS != 0) {
        s.coat_normal = surface_towards(bent_normal(t, kUseCoatNormal, frame) * side, s.view, abs(towards));
        vec2 brushed = brush(s, material, t);
        along = along * brushed.x + frame.y * brushed.y;
    }
    s.tangent = surface_tangent(along, s.normal, frame_from_normal(s.normal)[0]);

    vec4 colored = texelFetch(materials, material + kMaterialSpecularColor);
    float specular = colored.w * t.specular;
    colored.xyz *= t.specular_color;
    s.weights = surface_weights(emission.xyz, base, metallic, surface_dielectric(specular, colored.xyz, rest.z));
    if (LAYERS != 0) {
        if ((flags & kScatters) != 0) scatter_between_facets(s);
        add_sheen(s, material, t);
        add_coat(s, material, t);
    }
    return s;
}

shared vec3 positions_of_group[kGroup];
shared vec3 normals_of_group[kGroup];
shared int kinds_of_group[kGroup];

void main() {
    uint tile = gl_WorkGroupID.y;
    uint slot = gl_WorkGroupID.x * uint(kGroup) + gl_LocalInvocationID.x;
    vec4 origin = texelFetch(view, kViewOrigin);
    vec4 corner = texelFetch(view, kViewCorner);
    vec4 right = texelFetch(view, kViewRight);
    vec4 down = texelFetch(view, kViewDown);
    uint tiles_across = uint(right.w);
    uint number = first_tile + tile;
    // The inverse of tile_slot.
    uint block = slot / 16u;
    uvec2 pixel = uvec2(number % tiles_across, number / tiles_across) * 32u + uvec2(block % 8u, block / 8u) * 4u + uvec2(slot % 4u, slot % 16u / 4u);
    uint triangle_and_one = 0u;
    if (pixel.x < uint(origin.w) && pixel.y < uint(corner.w)) triangle_and_one = seen[pixel.y * uint(origin.w) + pixel.x];

    Surface s;
    s.found = false;
    s.for_host = false;
    if (triangle_and_one > 0u) {
        vec2 place = vec2(pixel) + vec2(texelFetch(view, kViewStepRight).w, texelFetch(view, kViewStepDown).w);
        s = surface_of(triangle_and_one - 1u, normalize(corner.xyz + right.xyz * place.x + down.xyz * place.y));
    }

    int kinds = s.for_host ? kAnyForHost : 0;
    if (s.found) {
        put(tile, slot, kPosition, s.position, s.alpha.x);
        put(tile, slot, kNormal, s.normal, s.alpha.y);
        put(tile, slot, kView, s.view, s.weights.fresnel_loss);
        put(tile, slot, kAlbedo, s.weights.albedo, s.geometric.x);
        put(tile, slot, kF0, s.weights.f0, s.geometric.y);
        put(tile, slot, kF90, s.weights.f90, s.geometric.z);
        put(tile, slot, kTangent, s.tangent, s.weights.coat);
        if (LAYERS != 0) {
            put(tile, slot, kCoatNormal, s.coat_normal, s.coat_alpha);
            put(tile, slot, kSheen, s.weights.sheen, s.sheen_alpha);
        }
        kinds = kAnySurface;
        if (any(greaterThan(s.weights.albedo, vec3(0.0)))) kinds |= kAnyDiffuse;
        if (any(greaterThan(max(s.weights.f0, s.weights.f90), vec3(0.0)))) kinds |= kAnySpecular;
        if (any(greaterThan(s.weights.sheen, vec3(0.0)))) kinds |= kAnySheen;
        if (s.weights.coat > 0.0) kinds |= kAnyCoat;
    } else {
        put(tile, slot, kNormal, vec3(0.0), 0.0);
    }
    radiance[tile * uint(kRadiance) + slot] = s.found ? vec4(s.weights.emission, s.mesh) : vec4(0.0);

    // Bounds of the group's surfaces: by these, the host finds the lights that reach the tile.
    positions_of_group[gl_LocalInvocationID.x] = s.found ? s.position : vec3(0.0);
    normals_of_group[gl_LocalInvocationID.x] = s.found ? s.normal : vec3(0.0);
    kinds_of_group[gl_LocalInvocationID.x] = kinds;
    barrier();
    if (gl_LocalInvocationID.x != 0u) return;
    vec3 low = vec3(3.0e38);
    vec3 high = vec3(-3.0e38);
    vec3 normal_low = low;
    vec3 normal_high = high;
    int all_kinds = 0;
    for (int i = 0; i < kGroup; i++) {
        all_kinds |= kinds_of_group[i];
        if ((kinds_of_group[i] & kAnySurface) == 0) continue;
        low = min(low, positions_of_group[i]);
        high = max(high, positions_of_group[i]);
        normal_low = min(normal_low, normals_of_group[i]);
        normal_high = max(normal_high, normals_of_group[i]);
    }
    uint bounds = tile * uint(kRadiance) + uint(kSlots) + gl_WorkGroupID.x * uint(kBounds);
    radiance[bounds] = vec4(low, float(all_kinds));
    radiance[bounds + 1u] = vec4(high, 0.0);
    radiance[bounds + 2u] = vec4(normal_low, 0.0);
    radiance[bounds + 3u] = vec4(normal_high, 0.0);
}
