// Constants of the rule for textured lights (texture_mean.h, textured_light.cpp). This text is both C++ and GLSL.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Cells are split until the sum of their error bounds is this fraction of the mean. The sum assumes that every cell has the full error of
// its bound, with the same sign. As measured, the mean's error is less than a tenth of it (docs/theory/ltc.md, "Textured lights").
const float kTextureTolerance = 0.15f;
// Limits of one evaluation: passes over the cells, and splits in one pass.
const int kTexturePasses = 16;
const int kTextureSplits = 1000;
// The threshold of a pass falls as if the sum of the bounds were proportional to its root, times this margin, at most this steeply.
const float kTextureMargin = 0.7f;
const float kTextureSteepest = 0.0039f;
// ... and by this factor it rises after a pass with too many splits, until a pass has not too many: that is the last.
const float kTextureBack = 8.0f;
// Halvings below the smallest cells, down to an eighth of their side.
const int kTextureDeepest = 6;

// The cosine lobe's footprint on a plane at distance 1, 1 / (pi (1 + r^2)^2), as a mixture of two Gaussians: the least squares fit of its
// spectrum k K_1(k) under the weight 1/k, that is, for textures whose power falls as 1/k^2 (edges, photographs). The residual has a square
// of 7e-4; that of the best single Gaussian (width 0.905) is 1.5e-2. TexturedLight.WidthsFitTheSpectrumOfTheCosine recomputes them. Widths
// in radians of the footprint's cone.
const float kTextureNarrow = 0.62f;
const float kTextureNarrowWeight = 0.64f;
const float kTextureWide = 1.92f;
// A Gaussian wider than this many rms radii of the light is a ramp over the light, whatever its width.
const float kTextureWidest = 4.0f;
// Least coverage in a look-up: less counts as none of the light.
const float kTextureLeastCoverage = 1.0e-6f;
// ... largest ratio of length to width; longer footprints become thicker; and the standard deviations between the probes along it: ripple
// below 1e-3.
const float kTextureAnisotropy = 4.0f;
const float kTextureProbeSpacing = 1.5f;
