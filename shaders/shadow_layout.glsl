// What the host and shadow_parts.comp agree on. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Groups of points, vectors of four uints each, the headers of all of them first. Where a vector holds floats, it holds their bits.
//   0  where the vertices, planes and edges begin; number of edges
//   1  where the incidences, corners and points begin; number of corners and kTurned, kOwnCorners: what each point has
//   2  number of points, kTriangles times that of triangles that cross the light's plane; number of the first answer; half sides of the box
//   3  axis x of the light's frame; half side of the light along it
//   4  axis y; half side
//   5  axis z; height below which edges block
const int kShadowHeader = 6;
const int kTurned = 65536;       // a plane of its own before the light
const int kOwnCorners = 131072;  // corners of its own
const int kTriangles = 65536;
// Vertices: place in the frame, number in the mesh. Planes: normal, offset. Edges: ends, planes (16 bits each), number, walks. Those of
// more than two triangles: where in the incidences theirs begin, and how many. Incidences: plane, walk, four a vector. Corners: cells of
// the outline's edge that begins there; numbers of its ends.
const int kWalks0 = 1;      // there is a first triangle ...
const int kAgainst0 = 2;    // ... that walks against the edge
const int kWalks1 = 4;      // and a second one
const int kAgainst1 = 8;
const int kManyWalks = 16;
const int kAgainst = 65536;  // of an incidence
// Behind the corners the triangles: corners and plane (16 bits each), number; numbers of the edges from each corner to the next.
const int kShadowCorner = 2;
const int kShadowTriangle = 2;

// Points: place in the frame, flags; shading normal; cells of the horizons by it and by the triangle. Of a light that each sees in a
// plane of its own, then that plane: 3, 4 and 5 of the header; the frame's origin, half side of the box; place in the coordinates
// of the edges, other half side. Then the cells of its own corners.
const int kShadowPoint = 4;
const int kShadowPlane = 5;
const int kArranged = 1;      // even if no occluder is seen
const int kCutByTriangle = 2;
const int kHorizon = 4;       // twice that: of the triangle
const int kHorizonLeft = 16;  // the box's left side cuts: start, end; of the triangle's: start, end
const int kShares = 256;      // of a round light, for which the outline stands
const int kBase = 512;        // times how often the lower left corner is hidden

// Answers:
//   0  where a ray begins, as the host has it; number of edges of the outline, and kAskRay
//   1  the ray's way, to its end; what is known
const int kShadowAnswer = 2;
const int kAskRay = 65536;  // whether the way is free: until that is known
const int kSeesNone = 0;
const int kSeesWhole = 1;    // if the way is free; so is a part
const int kAskHost = 2;
const int kNoRoom = 3;       // for what it sees
const int kSeesPart = 4;     // and where its record begins

// Points for which a thread has no space: kGroupPoints times the number of the group, and their own in it.
const int kGroupPoints = 64;
const int kMostMany = 65535;  // work groups in a row

// States of slots before a light: kSeesNone, kSeesWhole or kSeesPart.
//
// Parts: records, vectors of four floats each.
//   0  centre of the elements relative to the point; number of places of the outline, 0: the light's own
//   1  reach_a; mean square deviation
//   2  reach_b; weight
//   3  area; 0, or how far on there is the record of the polygon that stands for a round light
// and its places, relative to the point: 1 where they go on with an edge, 0 where they begin one.
const int kPartHeader = 4;
// Of a round light counts what share of the polygon's radiance the part sends. Before the polygon's record stand what arrives of the part,
// of the polygon and of the light itself, sums over the lobes.
const int kPartSums = 3;
