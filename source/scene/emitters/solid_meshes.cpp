#include "scene/emitters/solid_meshes.h"

#include <algorithm>
#include <set>
#include <variant>

#include "scene/emitters/closed_parts.h"

namespace steradian::scene {
namespace {

bool may_be_solid(const Scene& scene, const Mesh& mesh) {
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  return mesh.is_emitter() && !mesh.is_light_shape && !m.unlit && !m.emissive_texture.present() && mesh.triangle_count() >= kFewestFaces &&
         mesh.triangle_count() <= 4 * kMostFaces;
}

bool is_plain_face(const AreaLight& light) {
  return std::holds_alternative<Polygon>(light.shape) && !light.two_sided && !light.texture && !light.emission;
}

double area_of(const std::vector<Vec3d>& contour) {
  Vec3d sum{};
  for (std::size_t i = 1; i + 1 < contour.size(); ++i) sum += cross(contour[i] - contour[0], contour[i + 1] - contour[0]);
  return length(sum) / 2;
}

// The radiance with which a mesh sends out what its lights send out together.
Vec3d mean_radiance(const Scene& scene, const SolidMesh& solid) {
  Vec3d power{};
  for (const std::int32_t i : solid.lights) {
    const AreaLight& light = scene.area_lights[static_cast<std::size_t>(i)];
    power += light.radiance * prepare_polygon(flat_polygon(light)).area;
  }
  double area = 0;
  for (const MergedPolygon& face : solid.faces) {
    area += area_of(face.outline);
    for (const std::vector<Vec3d>& hole : face.holes) area -= area_of(hole);
  }
  return area > 0 ? power / area : Vec3d{};
}

}  // namespace

std::vector<SolidMesh> solid_meshes(const Scene& scene) {
  std::vector<SolidMesh> result;
  std::vector<Box3d> others;  // found where a mesh needs them
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (!may_be_solid(scene, mesh)) continue;
    std::set<std::int32_t> numbers(mesh.triangle_lights.begin(), mesh.triangle_lights.end());
    numbers.erase(-1);
    const auto plain = [&](std::int32_t i) { return is_plain_face(scene.area_lights[static_cast<std::size_t>(i)]); };
    if (numbers.empty() || !std::all_of(numbers.begin(), numbers.end(), plain)) continue;
    SolidMesh solid;
    solid.mesh = m;
    solid.lights.assign(numbers.begin(), numbers.end());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const auto at = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]); };
      solid.triangles.push_back({at(0), at(1), at(2)});
    }
    const std::vector<MeshPart> parts = mesh_parts(solid.triangles);
    if (others.empty()) others = bounds_of_the_others(scene);
    std::vector<Shines> shines(solid.triangles.size(), Shines::as_the_file_says);
    for (const MeshPart& part : parts)
      for (const std::size_t t : part.triangles)
        shines[t] = where_it_shines(scene.materials[static_cast<std::size_t>(mesh.material)], part, others[m]);
    if (std::find(shines.begin(), shines.end(), Shines::as_the_file_says) != shines.end()) continue;
    MergedPolygons merged = merge_coplanar(solid.triangles, [](std::size_t, std::size_t) { return true; });
    if (merged.without_area > 0 || merged.polygons.size() < kFewestFaces || merged.polygons.size() > kMostFaces) continue;
    solid.face_of.resize(solid.triangles.size());
    for (MergedPolygon& polygon : merged.polygons) {
      if (shines[polygon.triangles.front()] == Shines::outwards_and_faces_inwards) turn_over(polygon);
      for (const std::size_t t : polygon.triangles) solid.face_of[t] = static_cast<std::uint32_t>(solid.faces.size());
      solid.faces.push_back(std::move(polygon));
    }
    solid.radiance = mean_radiance(scene, solid);
    result.push_back(std::move(solid));
  }
  return result;
}

}  // namespace steradian::scene
