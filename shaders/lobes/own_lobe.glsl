// Lobes of extras.steradian, which the host stored among the lights' details (source/device/direct/own_lobes.cpp).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

struct OwnLobe {
    vec3 color;      // GGX: f0
    float material;  // number that a surface has beside its f0
    vec3 f90;
    float exponent;
    vec3 tangent;  // direction of alpha_x; zero: any
    float ax;
    float ay;
};

OwnLobe own_lobe_at(uint first) {
    vec4 a = details[first];
    vec4 b = details[first + 1u];
    vec4 c = details[first + 2u];
    vec4 d = details[first + 3u];
    return OwnLobe(a.xyz, a.w, b.xyz, b.w, c.xyz, d.x, d.y);
}

vec3 tangent_of(OwnLobe own, vec3 tangent) { return dot(own.tangent, own.tangent) > 0.0 ? own.tangent : tangent; }
