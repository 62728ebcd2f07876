#include "render/lights/solid_lights.h"

#include <algorithm>
#include <unordered_map>

#include "scene/emitters/solid_meshes.h"
#include "scene/emitters/symmetric_matrix.h"

namespace steradian {
namespace {

// The principal axes of the triangles' corners.
std::array<Vec3d, 3> axes_of(const std::vector<scene::Triangle>& triangles) {
  Vec3d middle{};
  const double count = 3 * static_cast<double>(triangles.size());
  for (const scene::Triangle& t : triangles)
    for (const Vec3d& v : t) middle += v / count;
  scene::SymmetricMatrix spread(3);
  for (const scene::Triangle& t : triangles)
    for (const Vec3d& v : t) spread.add_square({v.x - middle.x, v.y - middle.y, v.z - middle.z});
  const std::vector<std::vector<double>> vectors = scene::eigen_system(spread).vectors;
  std::array<Vec3d, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) axes[i] = {vectors[i][0], vectors[i][1], vectors[i][2]};
  return axes;
}

}  // namespace

std::vector<PackLight> with_solids(std::vector<PackLight> lights, const Scene& scene) {
  const std::vector<scene::SolidMesh> meshes = scene::solid_meshes(scene);
  if (meshes.empty()) return lights;
  std::unordered_map<const AreaLight*, std::size_t> place;
  for (const PackLight& light : lights)
    if (light.area != nullptr) place.emplace(light.area, light.index);
  std::vector<bool> replaced(lights.size(), false);
  std::vector<PackLight> solids;
  for (const scene::SolidMesh& mesh : meshes) {
    auto form = shadow::solid_light(mesh.triangles, mesh.face_of, axes_of(mesh.triangles));
    std::vector<std::size_t> places;
    for (const std::int32_t i : mesh.lights)
      if (const auto found = place.find(&scene.area_lights[static_cast<std::size_t>(i)]); found != place.end())
        places.push_back(found->second);
    if (!form || places.empty()) continue;
    auto solid = std::make_shared<SolidPackLight>();
    solid->form = std::move(*form);
    for (const scene::MergedPolygon& face : mesh.faces) solid->faces.push_back(prepare_polygon({face.outline, face.holes}));
    PackLight light;
    light.shape = packed::Pieces();
    light.radiance = static_cast<Vec3f>(mesh.radiance);
    light.area = lights[places.front()].area;
    light.solid = std::move(solid);
    solids.push_back(std::move(light));
    for (const std::size_t i : places) replaced[i] = true;
  }
  std::vector<PackLight> result;
  for (PackLight& light : lights)
    if (!replaced[light.index]) result.push_back(std::move(light));
  for (PackLight& light : solids) result.push_back(std::move(light));
  for (std::size_t i = 0; i < result.size(); ++i) result[i].index = i;
  return result;
}

}  // namespace steradian
