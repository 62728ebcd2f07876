// Visible parts of flat lights behind edges: a work group is a group of neighbouring points, a thread a point. docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shadow_parts.glsl"
