// The triangles of Dear ImGui's widgets, in the window's points.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec4 color;
layout(push_constant) uniform View {
    vec2 scale;
    vec2 origin;
};
layout(location = 0) out vec2 texture_place;
layout(location = 1) out vec4 vertex_color;

void main() {
    gl_Position = vec4((position - origin) * scale - 1.0, 0.0, 1.0);
    texture_place = place;
    vertex_color = color;
}
