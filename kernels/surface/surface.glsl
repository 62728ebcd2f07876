// The surface of glTF: frames and lobes, from a material's factors times its texels.
//
// Radiance = emission + diffuse + specular (+ sheen) (+ coat). A back face shows the front's frame with a reversed normal:
// bumps and directions of brushing keep their places.
// Source: glTF 2.0, appendix B, and KHR_materials_specular, _ior, _transmission, _anisotropy, _sheen and _clearcoat.
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Product of two colours.
vec3 surface_product(vec3 a, vec3 b) {
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}

// Unit vector; a vector shorter than 1e-15 stays short.
vec3 surface_unit(vec3 a) {
    return a * inversesqrt(max(dot(a, a), smallest_divisor()));
}

// True if a vector is long enough to have a direction, and its square is in the range of float.
mask surface_has_direction(vec3 a) {
    real square = dot(a, a);
    return square > smallest_divisor() && square < 1.0e30;
}

// The frame of tangent-space textures on the front face.
struct SurfaceFrame {
    vec3 x;
    vec3 y;
    vec3 z;
};

// The frame of a normal and the mesh's tangent.
//
//   n        unit normal
//   tangent  w below 0 reverses y
//   any      unit, perpendicular to n: x where the tangent is 0 or along the normal
SurfaceFrame surface_frame(vec3 n, vec4 tangent, vec3 any) {
    vec3 t = vec3(tangent.x, tangent.y, tangent.z);
    vec3 across = t - n * dot(n, t);
    mask usual = surface_has_direction(across);
    SurfaceFrame frame;
    frame.x = select(usual, surface_unit(across), any);
    frame.y = cross(n, frame.x) * select(usual && tangent.w < 0.0, -1.0, 1.0);
    frame.z = n;
    return frame;
}

// Normal from a normal map, unit; the frame's normal if the map points below the surface.
//
//   map      texel, from 0 to 1
//   scale    factor of its x and y
vec3 surface_bent_normal(SurfaceFrame frame, vec3 map, real scale) {
    real up = 2.0 * map.z - 1.0;
    vec3 bent = frame.x * ((2.0 * map.x - 1.0) * scale) + frame.y * ((2.0 * map.y - 1.0) * scale) + frame.z * up;
    return select(surface_has_direction(bent) && up > 0.0, surface_unit(bent), frame.z);
}

// A visible surface is seen from above. If interpolation or a normal map turns the normal away from the viewer, this turns it back until
// the view lies just above its horizon.
//
//   n, view  unit
//   facing   cosine between the view and the triangle, which itself never changes
vec3 surface_towards(vec3 n, vec3 view, real facing) {
    real least = min(0.01, 0.5 * facing);
    real cosine = dot(n, view);
    mask below = cosine < least;
    vec3 turned = n;
    if (any_lane(below)) {
        turned = select(below, surface_unit(n + view * (least - cosine)), n);
    }
    return turned;
}

// Share of a triangle's corner in the way of a hit to the curved surface that the corners' normals describe. The way leads to the mean of
// the hit's feet on the planes through the corners, by their weights. At a vertex, on a flat triangle and in a hollow it is zero.
//
//   corner   from the hit
//   normal   of the corner: unit, or zero
//   outside  the triangle's normal, turned to the viewer
// Source: Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021.
vec3 surface_lift(vec3 corner, vec3 normal, vec3 outside, real weight) {
    vec3 up = normal * select(dot(normal, outside) < 0.0, -1.0, 1.0);
    return up * (weight * max(0.0, dot(corner, up)));
}

// The part of a unit vector across a normal, as a unit vector. It is computed twice, because a small part is mostly rounding.
//
//   any      the result if there is no such part
vec3 surface_tangent(vec3 along, vec3 n, vec3 any) {
    vec3 across = along - n * dot(n, along);
    vec3 x = surface_unit(across);
    return select(dot(across, across) > 1.0e-10, surface_unit(x - n * dot(n, x)), any);
}

// Width of a lobe.
real surface_alpha(real roughness) {
    return clamp(roughness * roughness, 1.0e-4, 1.0);
}

// Width of a brushed lobe along the rotated tangent.
//
//   strength   of anisotropy, from 0 to 1
real surface_brushed_alpha(real alpha, real strength) {
    return alpha + (1.0 - alpha) * strength * strength;
}

// Weights of a surface's lobes.
//   emission      radiance towards the viewer
//   albedo        diffuse, in the direction in which the boundary above reflects F0
//   fresnel_loss  decrease of the albedo in other directions: this fraction of (1 - v.h)^5
//   f0, f90       of the specular lobe; both are 0 without one
//   sheen         colour of Charlie's lobe
//   coat          weight of the clear coat; its F0 is 0.04
//   passes        fraction of the light from behind that comes through
struct SurfaceWeights {
    vec3 emission;
    vec3 albedo;
    real fresnel_loss;
    vec3 f0;
    vec3 f90;
    vec3 sheen;
    real coat;
    vec3 passes;
};

// A surface that only emits.
SurfaceWeights surface_unlit(vec3 emission) {
    vec3 black = vec3(0.0, 0.0, 0.0);
    SurfaceWeights weights;
    weights.emission = emission;
    weights.albedo = black;
    weights.fresnel_loss = 0.0;
    weights.f0 = black;
    weights.f90 = black;
    weights.sheen = black;
    weights.coat = 0.0;
    weights.passes = black;
    return weights;
}

// The dielectric below a material's colour.
//   f0, f90  of its boundary
//   largest  channel of f0
struct SurfaceDielectric {
    vec3 f0;
    real f90;
    real largest;
};

// The dielectric of a material.
//
//   specular     strength; its colour multiplies the reflectance
//   reflectance  F0 of the index of refraction
SurfaceDielectric surface_dielectric(real specular, vec3 specular_color, real reflectance) {
    vec3 f0 = specular_color * reflectance;
    SurfaceDielectric dielectric;
    dielectric.f0 = vec3(clamp(f0.x, 0.0, 1.0), clamp(f0.y, 0.0, 1.0), clamp(f0.z, 0.0, 1.0)) * specular;
    dielectric.f90 = specular;
    dielectric.largest = max(dielectric.f0.x, max(dielectric.f0.y, dielectric.f0.z));
    return dielectric;
}

// The metallic-roughness surface. The diffuse lobe has albedo base (1 - metallic) (1 - F), F the largest channel of the dielectric's Fresnel:
// light that its specular lobe reflects does not reach it.
//
//   metallic   from 0 to 1
SurfaceWeights surface_weights(vec3 emission, vec3 base, real metallic, SurfaceDielectric dielectric) {
    real enters = 1.0 - dielectric.largest;
    mask loses = dielectric.largest < 1.0;
    SurfaceWeights weights = surface_unlit(emission);
    weights.albedo = base * ((1.0 - metallic) * enters);
    weights.fresnel_loss = select(loses, (dielectric.f90 - dielectric.largest) / select(loses, enters, 1.0), 0.0);
    weights.f0 = dielectric.f0 * (1.0 - metallic) + base * metallic;
    real f90 = dielectric.f90 * (1.0 - metallic) + metallic;
    weights.f90 = vec3(f90, f90, f90);
    return weights;
}

// The same surface as a thin wall.
//
//   share    of the diffuse light that passes instead
//   cosine   between the normal and the view
SurfaceWeights surface_transmitting(SurfaceWeights opaque, vec3 base, real metallic, SurfaceDielectric dielectric, real share, real cosine) {
    real c = clamp(1.0 - cosine, 0.0, 1.0);
    real reflected = dielectric.largest + (dielectric.f90 - dielectric.largest) * c * c * c * c * c;
    SurfaceWeights weights = opaque;
    weights.albedo = opaque.albedo * (1.0 - share);
    weights.passes = base * ((1.0 - metallic) * share * (1.0 - min(reflected, 1.0)));
    return weights;
}

// A surface below a layer that lets a fraction of the light through.
SurfaceWeights surface_below(SurfaceWeights bare, real fraction) {
    SurfaceWeights weights = bare;
    weights.albedo = bare.albedo * fraction;
    weights.f0 = bare.f0 * fraction;
    weights.f90 = bare.f90 * fraction;
    weights.passes = bare.passes * fraction;
    return weights;
}

// A surface below sheen. Light that the fibres reflect does not reach the layers below.
//
//   albedo   of a white sheen, as seen from the view
SurfaceWeights surface_with_sheen(SurfaceWeights bare, vec3 sheen, real albedo) {
    SurfaceWeights weights = surface_below(bare, clamp(1.0 - max(sheen.x, max(sheen.y, sheen.z)) * albedo, 0.0, 1.0));
    weights.sheen = sheen;
    return weights;
}

// A surface below a clear coat. Light that it reflects at the view's angle does not reach the layers below.
//
//   cosine   between the coat's normal and the view
SurfaceWeights surface_with_coat(SurfaceWeights bare, real coat, real cosine) {
    real c = clamp(1.0 - cosine, 0.0, 1.0);
    real fraction = 1.0 - coat * (0.04 + 0.96 * c * c * c * c * c);
    SurfaceWeights weights = surface_below(bare, fraction);
    weights.sheen = bare.sheen * fraction;
    weights.emission = bare.emission * fraction;
    weights.coat = coat;
    return weights;
}

// A surface that covers a part of its place. The rest shows the surfaces behind.
//
//   coverage   alpha of its base colour, from 0 to 1
SurfaceWeights surface_covering(SurfaceWeights bare, real coverage) {
    real gap = 1.0 - coverage;
    SurfaceWeights weights = surface_below(bare, coverage);
    weights.emission = bare.emission * coverage;
    weights.sheen = bare.sheen * coverage;
    weights.coat = bare.coat * coverage;
    weights.passes = weights.passes + vec3(gap, gap, gap);
    return weights;
}
