// What the host and the shaders agree on: places in buffers and the numbers of choices. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Surfaces: planes of kSlots vectors of four, kPlanes of them a tile: three numbers, and one that stands beside them.
const int kSlots = 1024;
const int kPosition = 0;    // alpha_x
const int kNormal = 1;      // alpha_y
const int kView = 2;        // Fresnel loss
const int kAlbedo = 3;      // of what the device has found: x of the triangle's normal
const int kF0 = 4;          // y; of what the host has found: number of a material that has lobes of extras.steradian, from 1
const int kF90 = 5;         // z
const int kTangent = 6;     // weight of the coat
const int kCoatNormal = 7;  // alpha of the coat
const int kSheen = 8;       // its alpha
const int kPlanes = 9;

// Lights: kRecord vectors of four each, as shaders/lights.glsl reads them.
const int kRecord = 9;
const int kWhereDetails = 7;  // its w: where what stands behind the light begins

// The kinds of lights: each is a pipeline of its own.
const int kPolygon = 0;
const int kDisk = 1;
const int kEllipsoid = 2;
const int kCapsule = 3;
const int kPunctual = 4;

// An entry of the lists: square, where its lights' numbers begin, how many there are, where the lobe begins that it is about.
const int kEntry = 4;

// A lobe of extras.steradian, among the lights' details: own_lobe.glsl.
const int kOwnLobe = 4;

// Threads of a work group, and the groups that a tile makes.
const int kGroup = 64;
const int kGroupsOfTile = 16;

// A tile's squares of 16 x 16 pixels: each has lists of its own. Number of the tile times kSquares, then row by row.
const int kSquares = 4;
const int kGroupsOfSquare = 4;  // kGroupsOfTile / kSquares

// Radiance: kSlots vectors a tile, of what the device has found beside it the number of the mesh, from 1; then kBounds for each of its
// groups: low and high corner of the box of positions, and of normals; beside the first, as a sum, what is among them.
const int kBounds = 4;
const int kRadiance = 1088;  // kSlots + kGroupsOfTile * kBounds
const int kAnySurface = 1;
const int kAnyDiffuse = 2;
const int kAnySpecular = 4;
const int kAnySheen = 8;
const int kAnyCoat = 16;
const int kAnyForHost = 32;  // what the device does not find: the tile is the host's

// Textured lights: light_textures.glsl.
const int kTextureHead = 7;
const int kTextureLevel = 2;
const int kTextureCell = 5;

// Rects and disks with a profile: profile_means.glsl. What a light's mean is found by.
const int kProfileHead = 6;
const int kTextureMean = 1;
const int kProfileMean = 2;
