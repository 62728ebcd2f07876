// Closed meshes that shine evenly. A point outside of one sees one radiance within its outline, whatever the number of its faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/emitters/merge_polygons.h"
#include "steradian/scene.h"

namespace steradian::scene {

struct SolidMesh {
  std::size_t mesh = 0;
  std::vector<std::int32_t> lights;  // those that stand for it in Scene::area_lights, ascending
  Vec3d radiance;
  std::vector<Triangle> triangles;
  std::vector<MergedPolygon> faces;    // they shine to their front
  std::vector<std::uint32_t> face_of;  // of each triangle
};

// The meshes of which all parts are closed and shine outwards with one radiance, and whose number of faces lies between these bounds. With
// fewer, it costs less to treat the faces one by one. With more, points that need the faces would take too long. The lights of the mesh may
// be fewer than its faces, as its weakest ones may have been merged (keep_strongest).
inline constexpr std::size_t kFewestFaces = 24, kMostFaces = 4096;
std::vector<SolidMesh> solid_meshes(const Scene& scene);

}  // namespace steradian::scene
