// Layout of the buffers that the host and shaders/plane/plane.glsl share, and kinds of work. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A job is one tile's lights of one kind: tile, place of its lights, their number, the tile's centre (x and y, each as a float and its
// remainder), 1 if it is the tile's first job.
const int kJob = 8;

// Results of a tile: a plane of pixels for each colour, and one number that is 1 if the CPU has to draw it.
const int kPixels = 256;
const int kTileSums = 772;
const int kToCpu = 768;

// A light by event lines: x, y, radius, 1 / range, red, green, blue, number of pairs; then the pairs' numbers.
const int kDiskLight = 8;
// A pair: six lines of three, radius; then its first vertex, kind (1: round), vertices, end_first, ends, begin_first, begins as bytes.
const int kPair = 24;
const int kPairRadius = 18;
const int kPairFirst = 19;
const int kPairKind = 20;   // kind, count
const int kPairChain = 21;  // end_first, ends, begin_first, begins

// A light whose lists the device computes: place of its disk, place of its mask of the tile.
const int kListedLight = 2;
// A disk: x and y, each as a float and its remainder, radius, 1 / range, red, green, blue; x and y from the picture's corner; its first
// pair, number of pairs; tiles that it reaches: column and row of the first one, numbers across and down; place of its masks. A mask:
// 1 if one blocker occludes the light from all of the tile, then a bit for each pair.
const int kDisk = 20;
const int kDiskCorner = 9;
const int kDiskFirstPair = 11;
const int kDiskPairs = 12;
const int kDiskTiles = 13;
const int kDiskMasks = 17;
const int kDiskHeader = 3;  // in the header: place of the disks

// Most turns that all loops of a thread may take together: a software device silently ends them at 65,535.
const int kMostTurns = 60000;

// A light by the general rules: words, then its lists in the order of their counts.
const int kLightKind = 0;  // TileKind
const int kLightX = 1;
const int kLightY = 2;
const int kLightRadius = 3;
const int kLightNormal = 4;
const int kLightBegin = 6;
const int kLightEnd = 7;
const int kLightInverseRange = 8;
const int kLightColour = 9;
const int kLightColourEnd = 12;
const int kLightProfile = 15;
const int kLightLinear = 16;
const int kLightSpot = 17;  // 0 none, 1, 2 more than half a turn; then low and high
const int kLightShape = 22;
const int kLightCounts = 32;
const int kLightArc = 44;
const int kLightWords = 61;  // number of words of the light and its lists
const int kLightCorners = 62;  // run only: numbers of corners in which it may begin and end; they come after the lists
const int kLight = 64;
// Words of an entry of each list; the vertices of spans and bodies follow them.
const int kPart = 17;  // words of TilePart; the last is 0 or one of the two below
const int kSmallPart = 1;
const int kSmallAndSeen = 2;  // also, all of the light's parts are visible if nothing is cut out of it
const int kVertex = 2;
const int kDiskBlocker = 3;
const int kSpan = 2;
const int kBody = 6;
const int kChord = 4;
const int kDeep = 7;
const int kRound = 13;
const int kLens = 39;
const int kCrossing = 7;

// Capacity of a thread for intervals within a light; a tile that needs more goes to the CPU.
const int kIntervals = 24;
