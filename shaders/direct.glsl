// Direct light of a batch of tiles from lights of one kind by one method: a thread a pixel, the lights of its tile's list in turn.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
//
// A shader is one lobe by one family of methods: diffuse.comp, sheen.comp, and of GGX ltc.comp, ltc_clipless.comp,
// closed_form.comp, half_vector.comp and representative_point.comp define which, as LOBE.
// Drivers compile all that a shader holds for each of its pipelines.
#include "layout.glsl"
#include "shadow_layout.glsl"

// A pipeline is one choice of these (source/render/vulkan/direct_light.cpp).
layout(constant_id = 0) const int KIND = 0;
layout(constant_id = 1) const int WITH_DIFFUSE = 0;        // of transformed cosines: 1: one walk for both lobes
layout(constant_id = 2) const int COMPACT_TABLE = 0;       // of transformed cosines
layout(constant_id = 3) const int QUALITY = 1;             // 0 draft, 1 normal, 2 high
layout(constant_id = 4) const int COAT_LOBE = 0;           // 1: the clear coat's lobe in the place of the base's
layout(constant_id = 5) const int CAREFUL_LIGHTS = 1;      // some points may see a light as small, or be near its rim
layout(constant_id = 6) const int CHUNKED_EDGES = 0;       // an outline may have more edges than there is space for
layout(constant_id = 7) const int FRESNEL_LOBE = 0;        // the table has a lobe of its own for (1 - v.h)^5
layout(constant_id = 8) const int ONLY_BALLS = 0;          // ellipsoids of three equal axes
layout(constant_id = 9) const int CORNERS = 12;            // that stand for a round light
layout(constant_id = 10) const int CORNER_SPACE = 32;      // ... and near its rim
layout(constant_id = 11) const int EDGE_SPACE = 34;
layout(constant_id = 12) const int ARC_SPACE = 34;
layout(constant_id = 13) const int MATRIX_SIZE = 2;
layout(constant_id = 14) const int MAGNITUDE_SIZE = 2;
layout(constant_id = 15) const int SHADOWED_LIGHTS = 0;    // 1: something hides the lights from some points, or a part of them
layout(constant_id = 16) const int UNCUT_LIGHTS = 0;       // 1: every point sees each light whole, above its horizon, from the lit side
const bool CAREFUL = CAREFUL_LIGHTS == 1;
const bool CHUNKED = CHUNKED_EDGES == 1;
const bool FRESNEL_TABLE = FRESNEL_LOBE == 1;
const bool BALLS = ONLY_BALLS == 1;
const bool COMPACT = COMPACT_TABLE == 1;
const bool TOGETHER = WITH_DIFFUSE == 1;
const bool SHADOWED = SHADOWED_LIGHTS == 1;
const bool UNCUT = UNCUT_LIGHTS == 1;

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer surfaces;
layout(binding = 1) uniform samplerBuffer tables;
layout(binding = 2) uniform samplerBuffer lights;
layout(binding = 3) uniform samplerBuffer vertices;
layout(binding = 4) uniform samplerBuffer radiance_before;  // the same buffer as `radiance`: every thread reads what it alone writes
layout(std430, binding = 5) writeonly buffer Radiance { vec4 radiance[]; };
layout(std430, binding = 6) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 7) readonly buffer States { uint states[]; };
layout(std430, binding = 8) readonly buffer Parts { vec4 parts[]; };
layout(push_constant) uniform Push { uint first_entry; };

#include "kernels.glsl"
#include "parts.glsl"
#include "lights.glsl"

PunctualIncident punctual_at(Light light, vec3 p) {
    PunctualIncident incident;
    if (light.r[1].w > 0.5) {  // directional
        incident.direction = -light.r[3].xyz;
        incident.irradiance = 1.0;
        return incident;
    }
    PunctualSource source;
    source.position = light.r[2].xyz;
    source.direction = light.r[3].xyz;
    source.inverse_range2 = light.r[2].w;
    source.spot_scale = light.r[3].w;
    source.spot_offset = light.r[4].w;
    return punctual_incident(source, p);
}

#include "outline.glsl"
#if LOBE == LOBE_DIFFUSE
#include "diffuse.glsl"
#elif LOBE == LOBE_SHEEN
#include "sheen.glsl"
#else
#include "specular.glsl"
#endif

// The groups of a square lie below each other, those of two squares side by side in turn.
uint group_of_square(uint square, uint row) { return (square / 2u * uint(kGroupsOfSquare) + row) * 2u + square % 2u; }

vec4 surface_at(uint tile, int plane, uint slot) { return texelFetch(surfaces, (int(tile) * kPlanes + plane) * kSlots + int(slot)); }

void main() {
    uint entry = (first_entry + gl_WorkGroupID.y) * uint(kEntry);
    uint square = lists[entry];
    uint first = lists[entry + 1u];
    uint count = lists[entry + 2u];
    uint tile = square / uint(kSquares);
    uint slot = group_of_square(square % uint(kSquares), gl_WorkGroupID.x) * uint(kGroup) + gl_LocalInvocationID.x;

    vec4 position = surface_at(tile, kPosition, slot);
    vec4 normal = surface_at(tile, kNormal, slot);
    vec4 view = surface_at(tile, kView, slot);
    vec3 p = position.xyz;
    vec3 n = normal.xyz;
    vec3 v = view.xyz;
    float loss = view.w;
    if (!(dot(n, n) > 0.25)) return;  // no surface
#if LOBE == LOBE_DIFFUSE
    vec3 albedo = surface_at(tile, kAlbedo, slot).xyz;
#elif LOBE == LOBE_SHEEN
    vec4 sheen = surface_at(tile, kSheen, slot);
#else
    SpecularLobe lobe;
    vec4 tangent = surface_at(tile, kTangent, slot);
    lobe.tangent = tangent.xyz;
    lobe.ax = position.w;
    lobe.ay = normal.w;
    vec3 f0 = vec3(0.0);
    vec3 f90 = vec3(0.0);
    if (COAT_LOBE == 1) {
        vec4 coat = surface_at(tile, kCoatNormal, slot);
        n = coat.xyz;
        lobe.ax = coat.w;
        lobe.ay = coat.w;
        f90 = vec3(tangent.w);
        f0 = 0.04 * f90;
    } else {
        f0 = surface_at(tile, kF0, slot).xyz;
        f90 = surface_at(tile, kF90, slot).xyz;
    }
    vec3 albedo = TOGETHER ? surface_at(tile, kAlbedo, slot).xyz : vec3(0.0);
#endif

    vec3 sum = vec3(0.0);
    uint i = 0u;
    do {
        vec3 sent;
        if (SHADOWED) take_part(states[lists[first + 2u * i + 1u] + slot]);
        Light light = light_at(lists[first + (SHADOWED ? 2u : 1u) * i]);
#if LOBE == LOBE_DIFFUSE
        sent = light.r[0].xyz * albedo * lambert_radiance(irradiance_below_boundary(light, p, n, v, loss));
#elif LOBE == LOBE_SHEEN
        sent = light.r[0].xyz * sheen.xyz * sheen_radiance(light, p, n, v, sheen.w);
#else
        // What is seen of a light lies above the surface's horizon, and no coat's normal differs from that but by rounding.
        vec3 up = COAT_LOBE == 1 && by_pieces() ? normal.xyz : n;
        Answer answer = specular_answer(light, p, up, v, lobe, loss);
        sent = light.r[0].xyz * (f0 * (answer.specular.x - answer.specular.y) + f90 * answer.specular.y +
                                 albedo * lambert_radiance(answer.irradiance));
#endif
        sum += !SHADOWED ? sent : part.seen ? sent * part.weight : vec3(0.0);
        ++i;
    } while (i < count);

    uint at = tile * uint(kRadiance) + slot;
    radiance[at] = vec4(texelFetch(radiance_before, int(at)).xyz + sum, 0.0);
}
