// Filter that joins the results of a pattern's pixels, along rows (step 0), then along columns (step 1); a thread a pixel.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce.glsl"
#include "bounce_kernels.glsl"

float tap_weight(int kind, int tap) {
    int sets = parameter(kStride) * parameter(kStride);
    return uintBitsToFloat(parameters[kSets + sets * kSet + kind * kTaps + tap + kTaps / 2]);
}

// Alpha of the glossy lobe, or -1 without one.
float width_at(int i) {
    vec4 f0 = f0s[i];
    return f0.x + f0.y + f0.z + normals[i].w > 0.0 ? positions[i].w : -1.0;
}

struct Sums {
    vec3 diffuse;
    vec3 glossy;
    float diffuse_weight;
    float glossy_weight;
};

// Sums over the taps on the same surface.
Sums gather(int i, ivec2 pixel, IndirectLikeness like) {
    vec3 n = normals[i].xyz;
    vec3 p = positions[i].xyz;
    float width = width_at(i);
    bool glossy = width > 0.0;
    bool sharp = glossy && width < indirect_sharp();
    Sums s = Sums(vec3(0.0), vec3(0.0), 0.0, 0.0);
    int low = -parameter(kReachLow);
    int high = parameter(kReachHigh);
    for (int k = low; k <= high; k++) {
        ivec2 at = pixel + (step == 0u ? ivec2(k, 0) : ivec2(0, k));
        if (at.x < 0 || at.y < 0 || at.x >= parameter(kWidth) || at.y >= parameter(kHeight)) continue;
        int j = index_of(at);
        if (!indirect_same_surface(like, n, normals[j].xyz, positions[j].xyz - p)) continue;
        float weight = tap_weight(0, k);
        s.diffuse += (step == 0u ? diffuse_light[j].xyz : diffuse_rows[j].xyz) * weight;
        s.diffuse_weight += weight;
        if (!glossy || !(abs(width_at(j) - width) < width * like.widths)) continue;
        weight = tap_weight(sharp ? 2 : 1, k);
        s.glossy += (step == 0u ? glossy_light[j].xyz : glossy_rows[j].xyz) * weight;
        s.glossy_weight += weight;
    }
    return s;
}

void main() {
    int i = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    if (i >= parameter(kWidth) * parameter(kHeight)) return;
    vec3 n = normals[i].xyz;
    vec3 diffuse = vec3(0.0);
    vec3 glossy = vec3(0.0);
    if (n != vec3(0.0)) {
        ivec2 pixel = ivec2(i % parameter(kWidth), i / parameter(kWidth));
        Sums same = gather(i, pixel, indirect_alike());
        // Looser sums, for edges: there the strict ones find so little that the pattern would be visible.
        Sums loose = Sums(vec3(0.0), vec3(0.0), 0.0, 0.0);
        if (same.diffuse_weight < indirect_enough() || (width_at(i) > 0.0 && same.glossy_weight < indirect_enough()))
            loose = gather(i, pixel, indirect_alike_loosely());
        diffuse = indirect_filtered(same.diffuse, same.diffuse_weight, loose.diffuse, loose.diffuse_weight);
        glossy = indirect_filtered(same.glossy, same.glossy_weight, loose.glossy, loose.glossy_weight);
    }
    if (step == 0u) {
        diffuse_rows[i] = vec4(diffuse, 0.0);
        glossy_rows[i] = vec4(glossy, 0.0);
    } else {
        diffuse_light[i] = vec4(diffuse, 0.0);
        glossy_light[i] = vec4(glossy, 0.0);
    }
}
