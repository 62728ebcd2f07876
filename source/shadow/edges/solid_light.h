// SolidLight: a closed mesh that shines evenly. A point outside of it sees one radiance within the mesh's outline.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/box.h"
#include "shadow/edges/edges.h"
#include "shadow/region/light_frame.h"

namespace steradian::shadow {

// An edge between two faces that lie in different planes. The first face traverses it from v0 to v1, the second one from v1 to v0.
struct SolidEdge {
  std::uint32_t v0 = 0, v1 = 0, face0 = 0, face1 = 0;
};

struct SolidLight {
  std::vector<Vec3d> vertices;
  std::vector<Plane> faces;
  std::vector<SolidEdge> edges;
  std::array<Vec3d, 3> axes;  // unit directions, that of the least extent first
  Box3d box;
};

// For each triangle of a mesh, true if it is one of the light's.
std::vector<bool> triangles_of(const SolidLight& light, const EdgeMesh& mesh);

// Makes a light of triangles.
//
//   face_of  the face of each triangle; the triangles of a face lie in one plane
//   axes     unit directions in which the mesh may be thin
//   returns  none if some edge does not have two triangles that traverse it in opposite directions
std::optional<SolidLight> solid_light(const std::vector<std::array<Vec3d, 3>>& triangles, const std::vector<std::uint32_t>& face_of,
                                      std::array<Vec3d, 3> axes);

// Frames in which some points see the light as a flat one, the thinnest direction of the light first. The plane of each touches the light
// on the points' side, and its box contains the projections of the light from all points. Shadows in such a frame are exact if no occluder
// beyond the plane may lie between a point and the light (TriangleTree::is_open_beyond).
//
//   returns  none if the points are in the light's midst, or so far from each other that they see it in different places
std::vector<LightFrame> frames_of(const SolidLight& light, const Box3d& points);

// The edges that may be a contour from some place of a box.
std::vector<std::uint32_t> contours_from(const SolidLight& light, const Box3d& points);

}  // namespace steradian::shadow
