// Mean radiances of textured lights, for the shaders of the lobes.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "../lobes/lobes.glsl"
#define LOBE LOBE_TEXTURE_MEANS
#include "../direct.glsl"
