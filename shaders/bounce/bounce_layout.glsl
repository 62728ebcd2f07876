// Layout of the buffers that the host and the bounce's shaders share. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Parameters, then the sets, then the filter's weights: diffuse, glossy, sharp.
const int kWidth = 0;
const int kHeight = 1;
const int kStride = 2;
const int kTilesX = 3;
const int kTilesY = 4;
const int kMaskWords = 5;  // words of a block's mask for each kind of light, in this round
const int kAdds = 6;       // 1: adds to the results of the rounds before
const int kReachLow = 7;   // reach of the filter: its low end negated, its high end
const int kReachHigh = 8;
const int kTilesAt = 9;    // place where the numbers of tiles, of all sets, begin
const int kSets = 16;
// A set: place of its diffuse lights, their number, and the same for its glossy lights.
const int kSet = 4;
const int kTaps = 33;

// Lights, in vectors of four. A diffuse light: position, reach; normal (turned), xi; bright, soft; edge x, 1 / area; edge y, edges squared;
// range, offset.
const int kDiffuse = 6;
// A glossy light: position, reach; rows x, y, z with xi, soft and 1 where Fresnel is by pair; normal (turned), 1 / area; bright, edges
// squared; grazing, offset; incoming; edge x; edge y; rows of T with g. With GGX: frame x, y and normal with xi, soft and alpha; normal
// (turned), view x; bright, view z; grazing, offset; ...; T.
const int kGlossy = 13;
const int kSpheroid = 10;  // place of T in a glossy light

// A box: center, 1 if it is empty; half; normal; its half. Boxes of blocks come before those of tiles.
const int kBox = 4;

// A texel: normal, alpha; incoming. Its lobe: rows with scale, n_a and f_a; stretch.
const int kTexel = 2;
const int kLobe = 4;

const int kTileSide = 16;
const int kBlockSide = 4;
const int kBlocksOfTile = 16;
const int kReceiversOfTile = 256;
