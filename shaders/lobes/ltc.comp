// GGX by linearly transformed cosines, and with them the diffuse lobe under polygons.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "lobes.glsl"
#define LOBE LOBE_LTC
#include "../direct.glsl"
