// Names of the kinds of lights that a shader of the plane can handle.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#define PLANE_DISKS 0
#define PLANE_CUTS 1
#define PLANE_ARCS 2
#define PLANE_LISTED 3
