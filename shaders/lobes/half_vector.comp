// GGX by arcs of half vectors.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "lobes.glsl"
#define LOBE LOBE_HALF_VECTOR
#include "../direct.glsl"
