// Round lights in the plane, by event lines.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "plane_kinds.glsl"
#define KIND PLANE_DISKS
#include "plane.glsl"
