// GGX by linearly transformed cosines without clipping.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "lobes.glsl"
#define LOBE LOBE_LTC_CLIPLESS
#include "../direct.glsl"
