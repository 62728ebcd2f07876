// What points before many edges see of flat lights: a work group of one subgroup is a point, for which shadow_parts.comp has no space. docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#define MANY_EDGES
#include "shadow_parts.glsl"
