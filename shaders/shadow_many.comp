// Visible parts of flat lights for points with many edges, which exceed the capacity of shadow_parts.comp. A work group of one subgroup is
// a point. docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#define MANY_EDGES
#include "shadow_parts.glsl"
