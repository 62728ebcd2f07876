// The numbers of the rule by which textured lights are seen (texture_mean.h, textured_light.cpp). This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Cells are split until the sum of what their bounds leave off is this share of the mean. They add up as if every cell were off by all of
// its bound, and the same way: measured, the mean is off by less than a tenth of it (docs/ltc.md, "Textured lights").
const float kTextureTolerance = 0.15f;
// Of one look: passes over the cells, and splits in one.
const int kTexturePasses = 16;
const int kTextureSplits = 1000;
// A pass's threshold falls as if the sum of the bounds went with the root of it, and by so much more, at most so steeply.
const float kTextureMargin = 0.7f;
const float kTextureSteepest = 0.0039f;
// ... and how far it goes back after a pass with too many splits, until one has not: that is the last.
const float kTextureBack = 8.0f;
// Halvings below the smallest cells: an eighth of their side.
const int kTextureDeepest = 6;

// The cosine lobe's footprint on a plane at distance 1, 1 / (pi (1 + r^2)^2), as a mixture of two Gaussians: the
// least squares fit of its spectrum k K_1(k) under the weight 1/k, that is, for textures whose power falls as 1/k^2 (edges,
// photographs). What is left has a square of 7e-4; of the best single Gaussian (width 0.905), 1.5e-2.
// TexturedLight.WidthsFitTheSpectrumOfTheCosine finds them again. Widths in radians of the footprint's cone.
const float kTextureNarrow = 0.62f;
const float kTextureNarrowWeight = 0.64f;
const float kTextureWide = 1.92f;
// A Gaussian wider than this many rms radii of the light is a ramp over it, whatever its width.
const float kTextureWidest = 4.0f;
// Of a look-up: less is none of the light.
const float kTextureLeastCoverage = 1.0e-6f;
// ... how much longer than wide, what is longer is thicker; and the standard deviations between the probes along it: ripple below 1e-3.
const float kTextureAnisotropy = 4.0f;
const float kTextureProbeSpacing = 1.5f;
