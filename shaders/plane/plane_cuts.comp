// Disks and edges in the plane, by the general rules.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "plane_kinds.glsl"
#define KIND PLANE_CUTS
#include "plane.glsl"
