#include "scene/emitters/solid_meshes.h"

#include <algorithm>
#include <set>
#include <variant>

#include "scene/emitters/closed_parts.h"

namespace steradian::scene {
namespace {

// True if the light is one of equal flat faces.
bool may_be_a_face(const AreaLight& light, const AreaLight& first) {
  return std::holds_alternative<Polygon>(light.shape) && !light.two_sided && !light.texture && !light.emission &&
         light.radiance == first.radiance && light.power > 0;
}

}  // namespace

std::vector<SolidMesh> solid_meshes(const Scene& scene) {
  std::vector<SolidMesh> result;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (mesh.is_light_shape || !mesh.is_emitter() || mesh.triangle_lights.size() < 2 * kFewestFaces) continue;
    const std::set<std::int32_t> numbers(mesh.triangle_lights.begin(), mesh.triangle_lights.end());
    if (numbers.size() < kFewestFaces || numbers.size() > kMostFaces || *numbers.begin() < 0) continue;  // -1: a triangle without light
    const auto light = [&](std::int32_t number) -> const AreaLight& { return scene.area_lights[static_cast<std::size_t>(number)]; };
    if (!std::all_of(numbers.begin(), numbers.end(), [&](std::int32_t i) { return may_be_a_face(light(i), light(*numbers.begin())); }))
      continue;
    SolidMesh solid;
    solid.mesh = m;
    solid.lights = numbers.size();
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]); };
      solid.triangles.push_back({at(0), at(1), at(2)});
      solid.light_of.push_back(static_cast<std::uint32_t>(mesh.triangle_lights[t]));
    }
    const std::vector<MeshPart> parts = mesh_parts(solid.triangles);
    const auto shines_outwards = [&](const MeshPart& part) {
      if (!part.closed || part.volume == 0) return false;
      const Triangle& t = solid.triangles[part.triangles.front()];
      const auto& face = std::get<Polygon>(light(mesh.triangle_lights[part.triangles.front()]).shape);
      return dot(prepare_polygon({face.vertices, face.holes}).normal, cross(t[1] - t[0], t[2] - t[0])) * part.volume > 0;
    };
    if (!parts.empty() && std::all_of(parts.begin(), parts.end(), shines_outwards)) result.push_back(std::move(solid));
  }
  return result;
}

}  // namespace steradian::scene
