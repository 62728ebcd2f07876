// Phong's lobe, and products of two lobes.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "lobes.glsl"
#define LOBE LOBE_PHONG
#include "../direct.glsl"
