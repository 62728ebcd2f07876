// Computes the radiance of every pixel from its demodulated light, a thread a pixel.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce.glsl"
#include "bounce_kernels.glsl"
#include "bounce_lobe.glsl"

void main() {
    int i = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    if (i >= parameter(kWidth) * parameter(kHeight)) return;
    diffuse_rows[i] = vec4(0.0);
    if (normals[i].xyz == vec3(0.0)) return;  // no surface: nothing was lit
    vec3 radiance = albedos[i].xyz * diffuse_light[i].xyz * inverse_pi();
    vec3 f0 = f0s[i].xyz;
    vec3 f90 = f90_at(i);
    if (f0.x + f0.y + f0.z + f90.x > 0.0) {
        vec4 magnitude = look_up_magnitude(sqrt(positions[i].w), dot(normals[i].xyz, views[i].xyz));
        radiance += (f0 * magnitude.x + (f90 - f0) * magnitude.y) * glossy_light[i].xyz;
    }
    diffuse_rows[i] = vec4(radiance, 0.0);
}
