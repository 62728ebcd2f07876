// Beckmann's and Blinn-Phong's lobes by arcs of half vectors.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "lobes.glsl"
#define LOBE LOBE_ARCS
#include "direct.glsl"
