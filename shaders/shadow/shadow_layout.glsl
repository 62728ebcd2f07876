// Layout of the buffers that the host and shadow_parts.comp share. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The mesh of a scene: its edges, for all lights, in vectors of four uints. A vector of floats holds their bits. After a head:
//   0  number of edges, of nodes; places of the nodes, incidences
//   1  places of the vertices, planes
// there are the edges: ends, planes. The flags below stand in the highest bits of the first end. An edge of more than two triangles has the
// place and number of its incidences instead of planes. Incidences: plane, kAgainst; four a vector.
// Nodes are boxes, a node before those below it: low corner, the first of the edges of a leaf plus 1, or 0; high corner, the first node
// that is not below. The boxes, vertices and planes are relative to the middle of the mesh.
const int kMeshHead = 2;
const int kNodeVectors = 2;
const int kLeaf = 64;        // edges of a leaf: as many as threads of a group
const int kFlagsFrom = 27;
const int kWalks0 = 1;       // there is a first triangle ...
const int kAgainst0 = 2;     // ... that walks against the edge
const int kWalks1 = 4;       // and a second one
const int kAgainst1 = 8;
const int kManyWalks = 16;
const int kAgainstFrom = 31;  // flag of an incidence that walks against the edge
// Limits of a group.
const int kMostLeaves = 2048;
const int kMostEdges = 20480;
const int kMostIncidences = 1024;

// Gathered edges: for each group their place and number, and kSeesNone or the answer of all points; then the edges' numbers.
const int kGatheredHead = 3;

// Frames: vertices and planes of the mesh in the coordinates of a light, vectors of four floats.

// Groups of points, in vectors of four uints; the headers of all groups come first.
//   0  places of the frame's vertices and planes
//   1  unused; places of corners and points; number of corners with the flags kTurned, kOwnCorners: data of each point
//   2  number of points, kTriangles times that of triangles that cross the light's plane; number of the first answer; half sides of the box
//   3  axis x of the light's frame; half side of the light along it
//   4  axis y; half side
//   5  axis z; height below which edges block
//   6  the shaft of the points and the light, relative to the middle of the mesh: normal and offset of each side
//  13  half sides of the box around the points
//  16  its middle; reach: ShaftView of source/shadow/lanes/packs.h
const int kShaft = 6;
const int kShaftBounds = 7;
const int kShadowHeader = kShaft + kShaftBounds + 4;
const int kTurned = 65536;       // each point has its own plane in front of the light
const int kOwnCorners = 131072;  // each point has its own corners
const int kTriangles = 65536;
// Corners: cells of the outline's edge that begins there; numbers of its ends.
// The triangles come after the corners: corners and plane; number of the triangle, and those of the edges from each corner to the next.
const int kShadowCorner = 2;
const int kShadowTriangle = 2;

// Points: place in the frame, flags; shading normal; cells of the horizons by it and by the triangle. With kTurned, the point's own plane
// follows: 3, 4 and 5 of the header; the frame's origin, half side of the box; place in the coordinates of the edges, other half side.
// Then come the cells of its own corners.
const int kShadowPoint = 4;
const int kShadowPlane = 5;
const int kArranged = 1;      // even if no occluder is visible
const int kCutByTriangle = 2;
const int kHorizon = 4;       // by the shading normal; twice that: by the triangle
const int kHorizonLeft = 16;  // the box's left side cuts: start, end; then the triangle's: start, end
const int kShares = 256;      // the outline replaces a round light
const int kBase = 512;        // times how often the lower left corner is occluded

// Answers, after a head of vectors and one for each space. Points whose segments exceed a space go on to the next one.
//   0  number of vectors of the parts, capacity; number of points that are left to the host, and of those that see a part
//   1  place of the lists of edges; number of points without any; number of edges of all groups, capacity
//   2  number of points of each space; how often points look at an edge of their group; nodes and leaves that
//   groups meet; in two vectors
//   for each space three vectors of its work, kWork: edges, triangles, segments, pairs of segments in units of kPairUnit; near pairs, open
//   pairs, turns of looks, of near pairs; turns of sorting, of crossings. Only a search that counts sums them up (shadow_work.glsl).
//   and for each space: numbers of its work groups in a row and of rows, 1: a dispatch; place of the points' names after the answers, four a vector
const int kShadowSpaces = 5;
const int kAtOnce = 8;  // segments that a turn looks at; capacities are multiples of it
const int kMostInRow = 65535;
const int kAnswersHead = 4 + 4 * kShadowSpaces;
const int kWork = 12;  // numbers of three vectors
const int kPairUnit = 64;
// In the first spaces a subgroup serves several points. The edges that such a point may see as segments are listed, four a vector. Their
// number is x of vector 1 of its answer.
const int kFewSpaces = 2;
const int kMostListed = 44;
const int kListVectors = 11;
// An answer:
//   0  begin of a ray, as the host has it; place of the point's state, and kAskRay
//   1  vector of the ray to its end; the result so far
const int kShadowAnswer = 2;
const int kAskRay = 1073741824;
const int kSeesNone = 0;
const int kSeesWhole = 1;    // if the ray is free; the same holds for a part
const int kAskHost = 2;
const int kNoRoom = 3;       // no capacity for the visible part
const int kSeesPart = 4;     // plus the place of its record

// Name of a point: kGroupPoints times the number of its group, plus the point's number in the group.
const int kGroupPoints = 64;

// States of slots before a light: kSeesNone, kSeesWhole or kSeesPart.
//
// Parts: records, vectors of four floats each.
//   0  centre of the elements relative to the point; number of places of the outline
//   1  reach_a; mean square deviation
//   2  reach_b
//   3  area; 0, or distance to the record of the polygon that replaces a round light
// and its places, relative to the point: 1 if they go on with an edge, 0 if they begin one.
const int kPartHeader = 4;
// A round light uses the fraction of the polygon's radiance that the part sends. Before the polygon's record are the radiances that arrive
// from the part, from the polygon and from the light itself, summed over the lobes.
const int kPartSums = 3;
