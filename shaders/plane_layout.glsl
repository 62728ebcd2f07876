// What the host and shaders/plane.glsl agree on: places in buffers and kinds of work. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A job is one tile's lights of one kind: tile, where its lights begin, how many there are, the tile's centre (x and y, each as a float and
// what that leaves), 1 where it is the tile's first job.
const int kJob = 8;

// Of a tile: a plane of pixels for each colour, and one number that is 1 where the CPU has to draw it.
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

// A light whose lists the device makes: where its disk stands, where its mask of the tile.
const int kListedLight = 2;
// A disk: x and y, each as a float and what that leaves, radius, 1 / range, red, green, blue; x and y from the picture's corner; its first
// pair, how many there are; tiles that it reaches: the first one's column and row, how many across and down; where its masks begin. A mask:
// 1 where one blocker hides the light from all of the tile, then a bit a pair.
const int kDisk = 20;
const int kDiskCorner = 9;
const int kDiskFirstPair = 11;
const int kDiskPairs = 12;
const int kDiskTiles = 13;
const int kDiskMasks = 17;
const int kDiskHeader = 3;  // in the header: where the disks begin

// Turns that a thread's loops may take in all: a software device ends them at 65,535 without a word.
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
const int kLightSlope = 12;
const int kLightProfile = 15;
const int kLightLinear = 16;
const int kLightSpot = 17;  // 0 none, 1, 2 more than half a turn; then low and high
const int kLightShape = 22;
const int kLightCounts = 32;
const int kLightArc = 44;
const int kLightWords = 60;  // of it and its lists
const int kLightCorners = 61;  // of a run: how many it may begin in, and end in; they stand behind the lists
const int kLight = 64;
// Words of an entry of each list; spans and bodies are followed by their vertices.
const int kPart = 17;  // those of TilePart; the last is one of the following or 0
const int kSmallPart = 1;
const int kSmallAndSeen = 2;  // and all of the light's parts are seen where nothing is taken of it
const int kVertex = 2;
const int kDiskBlocker = 3;
const int kSpan = 2;
const int kBody = 6;
const int kChord = 4;
const int kDeep = 7;
const int kRound = 13;
const int kLens = 39;
const int kCrossing = 7;

// Intervals within a light that a thread keeps; what takes more goes to the CPU.
const int kIntervals = 24;
