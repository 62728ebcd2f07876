// Direct light of a batch of tiles from lights of one kind by one method. A thread handles a pixel and goes through its tile's lights.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
//
// A shader is one lobe by one family of methods and defines it as LOBE. The diffuse lobe has diffuse.comp, sheen has sheen.comp. GGX has
// ltc.comp, ltc_clipless.comp, closed_form.comp, half_vector.comp and representative_point.comp. Phong's lobe
// has phong_lobe.comp. texture_means.comp computes what they read, and runs before them.
// Drivers compile everything that a shader holds for each of its pipelines.
#extension GL_KHR_shader_subgroup_ballot : require
#include "layout.glsl"
#include "shadow/shadow_layout.glsl"

// A pipeline is one choice of these (source/device/direct/direct_light.cpp). source/CMakeLists.txt lists the constants that a module fixes.
#ifndef KIND
layout(constant_id = 0) const int KIND = 0;
#endif
layout(constant_id = 1) const int WITH_DIFFUSE = 0;        // transformed cosines only: 1: one walk for both lobes
layout(constant_id = 2) const int COMPACT_TABLE = 0;       // transformed cosines only
layout(constant_id = 3) const int QUALITY = 1;             // 0 draft, 1 normal, 2 high
layout(constant_id = 4) const int WHICH_LOBE = 0;          // 1: coat's, not the base's, 2: own_lobe.glsl's; texture_means.comp: see there
layout(constant_id = 5) const int CAREFUL_LIGHTS = 1;      // some points may see a light as small
layout(constant_id = 6) const int FRESNEL_LOBE = 0;        // 1: the table has a separate lobe for (1 - v.h)^5
layout(constant_id = 7) const int ONLY_BALLS = 0;          // 1: only ellipsoids of three equal axes
layout(constant_id = 8) const int CORNERS = 12;            // number of corners that replace a round light
layout(constant_id = 9) const int MATRIX_SIZE = 2;
layout(constant_id = 10) const int MAGNITUDE_SIZE = 2;
layout(constant_id = 11) const int SHADOWED_LIGHTS = 0;    // not 0: something occludes the lights from some points; 1: adds visible parts, 2: whole lights
layout(constant_id = 12) const int UNCUT_LIGHTS = 0;       // 1: every point sees each light whole, above its horizon, from the lit side
layout(constant_id = 13) const int UNEVEN_LIGHTS = 0;      // 1: textured, with means in `means`
layout(constant_id = 14) const int TABLE_FIRST = 0;        // texture_means.comp only: place where the table begins
layout(constant_id = 15) const int PROFILED_LIGHTS = 0;    // 1: point lights with a profile
layout(constant_id = 16) const int LOBE_FORM = 0;          // GGX 1: without shadowing, 2: also without Fresnel; custom lobes: see there
#ifndef METHOD
layout(constant_id = 17) const int METHOD = 0;             // Phong's lobe only: phong_methods.glsl
#endif
layout(constant_id = 18) const int LOW_EXPONENT = 0;       // form of a series: own_lobes.cpp
layout(constant_id = 19) const int NEAR_RIM = 1;           // some points may be near the rim of a disk or an ellipsoid
const float SMITH = LOBE_FORM == 0 ? 1.0 : 0.0;
const bool COAT = WHICH_LOBE == 1;
const bool OWN = WHICH_LOBE == 2;
const bool CAREFUL = CAREFUL_LIGHTS == 1;
const bool FRESNEL_TABLE = FRESNEL_LOBE == 1;
const bool BALLS = ONLY_BALLS == 1;
const bool COMPACT = COMPACT_TABLE == 1;
const bool TOGETHER = WITH_DIFFUSE == 1;
const bool SHADOWED = SHADOWED_LIGHTS != 0;
const bool BY_PIECES = SHADOWED_LIGHTS == 1;
const bool UNCUT = UNCUT_LIGHTS == 1;
const bool PROFILED = PROFILED_LIGHTS == 1;
const bool UNEVEN = UNEVEN_LIGHTS != 0;

layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer surfaces;
layout(binding = 1) uniform samplerBuffer tables;
// Storage buffers, not texels: what a group has in common goes to registers that its threads share.
layout(std430, binding = 2) readonly buffer Lights { vec4 lights[]; };
layout(std430, binding = 3) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 4) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 5) buffer Radiance { vec4 radiance[]; };  // each thread reads and writes its pixel alone
layout(std430, binding = 6) readonly buffer States { uint states[]; };
layout(std430, binding = 7) buffer Parts { vec4 parts[]; };
layout(std430, binding = 8) buffer Means { vec4 means[]; };
layout(std430, binding = 9) readonly buffer Details { vec4 details[]; };
layout(push_constant) uniform Push { uint first_entry; };

#include "entry.glsl"
#include "kernels.glsl"
#include "shadow/parts.glsl"
#include "lights/lights.glsl"
#include "lights/light_profiles.glsl"

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
    incident = punctual_incident(source, p);
    if (PROFILED) {
        vec3 from = -incident.direction;
        incident.irradiance *= profile_intensity(int(light.r[kWhereDetails].w), vec3(dot(from, light.r[5].xyz), dot(from, light.r[6].xyz),
                                                                                   dot(from, light.r[7].xyz)));
    }
    return incident;
}

#include "lights/outline.glsl"
#include "lobes/own_lobe.glsl"
#if LOBE == LOBE_DIFFUSE
#include "lobes/diffuse.glsl"
#elif LOBE == LOBE_SHEEN
#include "lobes/sheen.glsl"
#elif LOBE == LOBE_PHONG
#include "lobes/phong_lobe.glsl"
#elif LOBE != LOBE_TEXTURE_MEANS
#define HAS_SPECULAR_LOBE
#include "lobes/specular.glsl"
#endif

// Index of the thread's pixel among the means of a square and a light.
uint slot_of_means() { return gl_WorkGroupID.x * uint(kGroup) + gl_LocalInvocationID.x; }

vec4 surface_at(uint tile, int plane, uint slot) { return texelFetch(surfaces, (int(tile) * kPlanes + plane) * kSlots + int(slot)); }

#if LOBE == LOBE_TEXTURE_MEANS
#include "lobes/tables.glsl"
#include "lights/light_textures.glsl"
#include "lights/texture_means.glsl"
#else
// The values of a pixel's surface that a lobe's integral needs.
struct Surface {
    vec3 p;
    vec3 n;
    vec3 up;  // the same, except for a coat's lobe
    vec3 v;
    float loss;
#ifdef HAS_SPECULAR_LOBE
    SpecularLobe lobe;
#endif
};

bool has_lobe(Entry entry) {
    vec3 n = surface_at(entry.tile, kNormal, entry.slot).xyz;
    return dot(n, n) > 0.25 && (!OWN || surface_at(entry.tile, kF0, entry.slot).w == own_lobe_at(entry.own).material);
}

Surface surface_in(Entry entry) {
    vec4 position = surface_at(entry.tile, kPosition, entry.slot);
    vec4 normal = surface_at(entry.tile, kNormal, entry.slot);
    vec4 view = surface_at(entry.tile, kView, entry.slot);
    Surface s;
    s.p = position.xyz;
    s.n = normal.xyz;
    s.up = normal.xyz;
    s.v = view.xyz;
    s.loss = view.w;
#ifdef HAS_SPECULAR_LOBE
    s.lobe.tangent = surface_at(entry.tile, kTangent, entry.slot).xyz;
    s.lobe.ax = position.w;
    s.lobe.ay = normal.w;
    if (OWN) {
        OwnLobe own = own_lobe_at(entry.own);
        s.lobe.tangent = tangent_of(own, s.lobe.tangent);
        s.lobe.ax = own.ax;
        s.lobe.ay = own.ay;
    } else if (COAT) {
        vec4 coat = surface_at(entry.tile, kCoatNormal, entry.slot);
        s.n = coat.xyz;
        s.lobe.ax = coat.w;
        s.lobe.ay = coat.w;
    }
#endif
    return s;
}

// Radiance towards the view from a light of radiance 1. Each light reads the surface again, and its colours after the integral: values that
// live longer take registers from the integral.
vec3 sent_by(Light light, Entry entry) {
    Surface s = surface_in(entry);
#if LOBE == LOBE_DIFFUSE
    float irradiance = irradiance_below_boundary(light, s.p, s.n, s.v, s.loss);
    return surface_at(entry.tile, kAlbedo, entry.slot).xyz * lambert_radiance(irradiance);
#elif LOBE == LOBE_SHEEN
    vec4 sheen = surface_at(entry.tile, kSheen, entry.slot);
    if (OWN) {
        OwnLobe own = own_lobe_at(entry.own);
        sheen = vec4(own.color, own.ax);
    }
    return sheen.xyz * sheen_radiance(light, s.p, s.n, s.v, sheen.w);
#elif LOBE == LOBE_PHONG
    OwnLobe own = own_lobe_at(entry.own);
    return own.color * own_radiance(light, s.p, s.n, s.v, own);
#else
    // The visible part of a light lies above the surface's horizon. A coat's normal differs from the surface's only by rounding.
    vec3 n = COAT && by_pieces() ? s.up : s.n;
    Answer answer = specular_answer(light, s.p, n, s.v, s.lobe, s.loss);
    vec3 f0 = surface_at(entry.tile, kF0, entry.slot).xyz;
    vec3 f90 = surface_at(entry.tile, kF90, entry.slot).xyz;
    if (OWN) {
        OwnLobe own = own_lobe_at(entry.own);
        f0 = own.color;
        f90 = own.f90;
    } else if (COAT) {
        f90 = vec3(surface_at(entry.tile, kTangent, entry.slot).w);
        f0 = 0.04 * f90;
    }
    vec3 sent = f0 * (answer.specular.x - answer.specular.y) + f90 * answer.specular.y;
    if (TOGETHER) sent += surface_at(entry.tile, kAlbedo, entry.slot).xyz * lambert_radiance(answer.irradiance);
    return sent;
#endif
}

// Numbers for each light in the lists: its own, that of its states, that of its means.
const uint kNumbers = 1u + (SHADOWED ? 1u : 0u) + (UNEVEN ? 1u : 0u);

void main() {
    Entry entry = entry_here();
    if (!has_lobe(entry)) return;
    uint to = entry.tile * uint(kRadiance) + entry.slot;
    uint i = 0u;
    do {
        uint at = entry.first + kNumbers * i;
        Light light = light_at(listed(at));
        vec4 found = vec4(0.0);  // mean radiance of a textured light
        if (UNEVEN) found = means[listed(at + kNumbers - 1u) + slot_of_means()];
        int turns = 1;
        if (SHADOWED) turns = turns_of(states[listed(at + 1u) + entry.slot]);
        for (int turn = 0; turn < turns; turn++) {
            if (BY_PIECES && turn == 1) take_record(part.whole);
            vec3 sent = sent_by(light, entry) * (UNEVEN ? found.xyz : light.r[0].xyz);
            if (SHADOWED && part.whole > 0)
                parts[part.whole - kPartSums + (BY_PIECES ? turn : kPartSums - 1)].xyz += sent;
            else
                radiance[to].xyz += sent;  // at once: a sum of all lights takes registers from their integrals
        }
        ++i;
    } while (i < entry.count);
}
#endif
