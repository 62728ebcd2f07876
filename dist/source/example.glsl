#version 450
#extension GL_GOOGLE_include_directive : require  // without it: paste the file in place of the next line
#include "steradian.glsl"

layout(location = 0) in vec3 position;  // of the surface
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 color;    // linear
layout(binding = 0) uniform Scene {
    vec4 eye;
    vec4 corners[4];  // of the light
    vec4 radiance;    // of the light
    vec4 albedo;
    vec4 f0;          // w: roughness
};

void main() {
    vec3 n = normalize(normal);
    vec3 v = normalize(eye.xyz - position);
    vec3 a = corners[0].xyz, b = corners[1].xyz, c = corners[2].xyz, d = corners[3].xyz;
    vec3 specular = steradian_ggx_quad(position, n, v, a, b, c, d, f0.w, f0.xyz);
    float diffuse = steradian_lambert_quad(position, n, a, b, c, d);
    color = vec4(radiance.rgb * (albedo.rgb * diffuse + specular), 1.0);
}
