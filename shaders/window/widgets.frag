// A widget's colour times its texture: the fonts, or the picture. Both are encoded for the screen.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450

layout(location = 0) in vec2 texture_place;
layout(location = 1) in vec4 vertex_color;
layout(binding = 0) uniform sampler2D texels;
layout(location = 0) out vec4 color;

void main() { color = vertex_color * texture(texels, texture_place); }
