// Closed meshes that shine evenly. A point outside of one sees one radiance within its outline, whatever the number of its faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/emitters/merge_polygons.h"
#include "steradian/scene.h"

namespace steradian::scene {

struct SolidMesh {
  std::size_t mesh = 0;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> light_of;  // of each triangle, in Scene::area_lights
  std::size_t lights = 0;               // number of its lights
};

// The meshes of which all parts are closed and shine outwards with one radiance, and whose number of lights lies between these bounds. With
// fewer, it costs less to treat the faces one by one. With more, points that need the faces would take too long: the weakest faces are
// merged (keep_strongest).
inline constexpr std::size_t kFewestFaces = 24, kMostFaces = 4096;
std::vector<SolidMesh> solid_meshes(const Scene& scene);

}  // namespace steradian::scene
