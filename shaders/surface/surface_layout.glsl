// Layout of a scene for the shaders that find surfaces (source/device/surface/scene_buffers.cpp). This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Vertices: vectors of four each.
const int kVertexPosition = 0;
const int kVertexNormal = 1;
const int kVertexTangent = 2;
const int kVertexTexcoords = 3;  // both sets
const int kVertexColor = 4;
const int kVertex = 5;

// The view: origin and directions of rays, in pixels from the picture's upper left corner.
const int kViewOrigin = 0;     // width of the picture
const int kViewCorner = 1;     // height
const int kViewRight = 2;      // tiles across
const int kViewDown = 3;
const int kViewStepRight = 4;  // to the next sample; x of the sample's place in its pixel
const int kViewStepDown = 5;   // y of it
const int kViewForward = 6;
const int kViewVectors = 7;

// Materials begin with the linear values of the 256 codes of sRGB, four a vector.
const int kCodes = 64;
// Meshes: one vector each: number of its material's first vector, 1 if it has tangents, 1 if it has colours, sets of texture coordinates
// (1 + 2), plus kForHost if the host handles it.
const int kForHost = 4;
// Materials:
const int kMaterialBase = 0;           // rgba
const int kMaterialEmission = 1;       // rgb, 1 where both sides emit
const int kMaterialSpecularColor = 2;  // rgb, specular
const int kMaterialRest = 3;           // metallic, roughness, F0 of its index, kUnlit and kScatters
const int kMaterialSheen = 4;          // rgb, roughness
const int kMaterialCoat = 5;           // weight, roughness; strength of anisotropy, its rotation
const int kMaterialTextures = 6;
const int kUnlit = 1;
const int kScatters = 2;  // light bounces between its facets

// Uses of textures, kUse vectors each: number of its first level (below 0: none), number of levels, flags, set of coordinates; the
// transform's numbers 0 to 3; 4 and 5 of them, scale.
const int kUseBase = 0;
const int kUseMetallicRoughness = 1;
const int kUseNormal = 2;
const int kUseEmission = 3;
const int kUseSpecular = 4;
const int kUseSpecularColor = 5;
const int kUseSheen = 6;
const int kUseSheenRoughness = 7;
const int kUseCoat = 8;
const int kUseCoatRoughness = 9;
const int kUseCoatNormal = 10;
const int kUseAnisotropy = 11;
const int kUses = 12;
const int kUse = 3;
const int kMaterial = 42;  // kMaterialTextures + kUses * kUse

// Flags: wrap mode of u (0 repeats, 1 mirrors, 2 stays at the edge), four times the mode of v, and these.
const int kNearest = 16;
const int kSrgb = 32;

// Levels: one vector each: number of its first texel divided by kTexelRow, the remainder of that, width, height.
const int kTexelRow = 65536;

// Tables: the sizes of GGX's shapes and magnitudes and of Charlie's, then their nodes, one vector each, in that order.
