// Layout of the buffers that the host and the shaders of rays share. This text is C++ and GLSL at once.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The hierarchy of triangles, in vectors of four uints: kHead of them, nodes in traversal order, then three corners of each triangle. The
// first corner has the triangle's number beside it. The very first is the unit of the others (RayScene's), a float that multiplies rays.
const int kHead = 1;
//   0  least coordinates of a node's box; kLeafSizes times the place of a leaf's triangles, plus their number
//   1  greatest coordinates; number of the node past all that is below this one
const int kLeafSizes = 8;

// A ray of a shadow map, in vectors of four floats: origin, distance at which it begins; unit direction, 0 if there is none.
const int kMapRay = 2;
// The first hit of a ray: a triangle's number from 1, or one of these.
const int kMeetsNothing = 0;
const int kHostFinds = -1;
