// Triangles that enter round lights: each is cut along the light's surface, so that its part inside can be left out for that light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadow/edges/edges.h"
#include "shapes/body.h"

namespace steradian::shadow {

// Cuts the mesh's triangles, which have no edges yet, and lists those inside each body. Stops at 200,000 new triangles. Neighbours get the
// same corners where their common edge meets a body. The parts of a triangle share its plane bit for bit, so no edge between them is ever a
// contour of both.
void cut_by_bodies(EdgeMesh& mesh, std::span<const Body> bodies);

// Returns true if the box of some triangle meets the box of a body: only then it may enter it.
bool may_enter(const EdgeMesh& mesh, std::span<const Body> bodies);

}  // namespace steradian::shadow
