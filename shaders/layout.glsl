// What the host and the shaders agree on: places in buffers and the numbers of choices. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Surfaces: planes of kSlots floats, kPlanes of them a tile; three for a vector.
const int kSlots = 1024;
const int kPosition = 0;
const int kNormal = 3;
const int kView = 6;
const int kTangent = 9;
const int kAlbedo = 12;
const int kFresnelLoss = 15;
const int kF0 = 16;
const int kF90 = 19;
const int kAlphaX = 22;
const int kAlphaY = 23;
const int kCoat = 24;
const int kCoatAlpha = 25;
const int kCoatNormal = 26;
const int kSheen = 29;
const int kSheenAlpha = 32;
const int kPlanes = 33;

// Lights: kRecord vectors of four each, as shaders/lights.glsl reads them.
const int kRecord = 9;

// The kinds of lights: each is a pipeline of its own.
const int kPolygon = 0;
const int kDisk = 1;
const int kEllipsoid = 2;
const int kCapsule = 3;
const int kPunctual = 4;

// An entry of the lists: tile, where its lights' numbers begin, how many there are.
const int kEntry = 3;

// Threads of a work group, and the groups that a tile makes.
const int kGroup = 64;
const int kGroupsOfTile = 16;
