// Number of the triangle, from 1; 0 where there is none.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450

layout(location = 0) flat in uint triangle_and_one;
layout(location = 0) out uint seen;

void main() { seen = triangle_and_one; }
