// Layout of the buffers that the host and the shaders share, and numbers of choices. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Surfaces: kPlanes planes a tile, of kSlots vectors of four each: three numbers, and one that is stored beside them.
const int kSlots = 1024;
const int kPosition = 0;    // beside it: alpha_x
const int kNormal = 1;      // alpha_y
const int kView = 2;        // Fresnel loss
const int kAlbedo = 3;      // surfaces from the device: x of the triangle's normal
const int kF0 = 4;          // y; surfaces from the host: number of a material with lobes of extras.steradian, from 1
const int kF90 = 5;         // z
const int kTangent = 6;     // weight of the coat
const int kCoatNormal = 7;  // alpha of the coat
const int kSheen = 8;       // its alpha
const int kPlanes = 9;

// Lights: kRecord vectors of four each, as shaders/lights/lights.glsl reads them.
const int kRecord = 9;
const int kWhereDetails = 7;  // its w: place where the light's details begin

// Kinds of lights: each has its own pipeline.
const int kPolygon = 0;
const int kDisk = 1;
const int kEllipsoid = 2;
const int kCapsule = 3;
const int kPunctual = 4;

// An entry of the lists: square, place of its lights' numbers, their count, place where the entry's lobe begins.
const int kEntry = 4;

// Vectors of a lobe of extras.steradian, which is stored among the lights' details: own_lobe.glsl.
const int kOwnLobe = 4;

// Threads of a work group, and number of groups of a tile.
const int kGroup = 64;
const int kGroupsOfTile = 16;

// A tile's squares of 16 x 16 pixels: each has its own lists. A square's number is the tile's times kSquares, plus its place row by row.
const int kSquares = 4;
const int kGroupsOfSquare = 4;  // kGroupsOfTile / kSquares

// Radiance: kSlots vectors a tile. If the device has found the surfaces, the mesh's number, from 1, is beside it. Then come kBounds vectors
// for each group: low and high corner of the box of positions, and of normals. Beside the first is the sum of the kinds of surfaces in it.
const int kBounds = 4;
const int kRadiance = 1088;  // kSlots + kGroupsOfTile * kBounds
const int kAnySurface = 1;
const int kAnyDiffuse = 2;
const int kAnySpecular = 4;
const int kAnySheen = 8;
const int kAnyCoat = 16;
const int kAnyForHost = 32;  // surfaces that the device cannot find: the host handles the tile

// Textured lights: light_textures.glsl.
const int kTextureHead = 7;
const int kTextureLevel = 2;
const int kTextureCell = 5;
