// What the host and the shaders of the bounce agree on: places in buffers. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Parameters, then the sets, then the filter's weights: diffuse, glossy, sharp.
const int kWidth = 0;
const int kHeight = 1;
const int kStride = 2;
const int kTilesX = 3;
const int kTilesY = 4;
const int kMaskWords = 5;  // of a block's mask of each kind of light, in this round
const int kAdds = 6;       // 1: to what the rounds before have left
const int kReachLow = 7;   // of the filter, as it is and negated
const int kReachHigh = 8;
const int kTilesAt = 9;    // where numbers of tiles, of all sets, begin
const int kSets = 16;
// A set: where its diffuse lights begin, how many there are, and the same of the glossy ones.
const int kSet = 4;
const int kTaps = 33;

// Vectors of four. A diffuse light: position, reach; normal (turned), xi; bright, soft; edge x, 1 / area; edge y, edges squared; range, offset.
const int kDiffuse = 6;
// A glossy one: position, reach; rows x, y, z with xi, soft and 1 where Fresnel is by pair; normal (turned), 1 / area; bright, edges
// squared; grazing, offset; incoming; edge x; edge y; rows of T with g. On GGX: frame x, y and normal with xi, soft and alpha; normal
// (turned), view x; bright, view z; grazing, offset; ...; T.
const int kGlossy = 13;
const int kSpheroid = 10;  // T in it

// A box: center, 1 where it is empty; half; normal; its half. Boxes of blocks stand before those of tiles.
const int kBox = 4;

// A texel: normal, alpha; incoming. Its lobe: rows with scale, n_a and f_a; stretch.
const int kTexel = 2;
const int kLobe = 4;

const int kTileSide = 16;
const int kBlockSide = 4;
const int kBlocksOfTile = 16;
const int kReceiversOfTile = 256;
