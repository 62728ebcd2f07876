// Finds the triangle visible at every pixel. The vertices are the corners of all triangles of a scene, three after three.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "surface_layout.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform samplerBuffer triangles;
// For a vertex d from the origin at a depth along `forward`: its place in the picture, from -1 to 1, times the depth. Depths are stored
// as forward.w over them: nearer is greater, and as fine in the distance as next to the camera.
layout(push_constant) uniform View {
    vec4 origin;
    vec4 across;
    vec4 down;
    vec4 forward;
};
layout(location = 0) flat out uint triangle_and_one;

void main() {
    int triangle = gl_VertexIndex / 3;
    int corner = gl_VertexIndex - 3 * triangle;
    vec4 numbers = texelFetch(triangles, triangle);
    int vertex = int(corner == 0 ? numbers.x : corner == 1 ? numbers.y : numbers.z);
    vec3 d = texelFetch(vertices, vertex * kVertex + kVertexPosition).xyz - origin.xyz;
    float depth = dot(forward.xyz, d);
    gl_Position = vec4(dot(across.xyz, d) + across.w * depth, dot(down.xyz, d) + down.w * depth, forward.w, depth);
    triangle_and_one = uint(triangle) + 1u;
}
