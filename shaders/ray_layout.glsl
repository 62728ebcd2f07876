// What the host and the shaders that follow rays agree on. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The hierarchy of triangles, vectors of four uints: kHead of them, nodes in the order of a walk, then three corners of each triangle, its
// number beside the first. The first of all is the unit in which the others are (RayScene's), a float by which rays are multiplied.
const int kHead = 1;
//   0  least coordinates of a node's box; kLeafSizes times where the triangles of a leaf begin, and their number
//   1  greatest coordinates; number of the node past all that is below this one
const int kLeafSizes = 8;

// A ray of a shadow map, vectors of four floats: origin, how far on it begins; unit direction, 0 where there is none.
const int kMapRay = 2;
// What it meets first: a triangle's number from 1, or one of these.
const int kMeetsNothing = 0;
const int kHostFinds = -1;
