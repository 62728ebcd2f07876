#include "render/surface/clear_meshes.h"

#include <algorithm>
#include <cmath>

#include "render/surface/surface.h"

namespace steradian {
namespace {

Vec3f root(Vec3f v) { return {std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)}; }

struct Measures {
  double area = 0, volume = 0;
  Vec3d sum{};  // of the triangles' areas as vectors; zero for a closed mesh
};
Measures measures_of(const Mesh& mesh) {
  Measures m;
  const auto origin = static_cast<Vec3d>(mesh.positions[mesh.indices[0]]);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto corner = [&](std::size_t i) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + i]]) - origin; };
    const Vec3d across = cross(corner(1) - corner(0), corner(2) - corner(0)) * 0.5;
    m.area += length(across);
    m.sum += across;
    m.volume += dot(corner(0), across) / 3;
  }
  return m;
}

// Mean over some triangles of the fraction that comes through a face along its normal.
Vec3f through_face(const Scene& scene, const Mesh& mesh) {
  constexpr std::size_t kMost = 64;
  const std::size_t count = mesh.triangle_count(), every = (count + kMost - 1) / kMost;
  Vec3f sum{};
  double weight = 0;
  for (std::size_t t = 0; t < count; t += every) {
    const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * t + i]]; };
    const Vec3f across = cross(corner(1) - corner(0), corner(2) - corner(0));
    const float size = length(across);
    if (!(size > 0)) continue;
    sum += surface_at(scene, mesh, static_cast<unsigned>(t), 1.0f / 3, 1.0f / 3, across / size).passes * size;
    weight += static_cast<double>(size);
  }
  return weight > 0 ? sum * static_cast<float>(1 / weight) : Vec3f{1, 1, 1};
}

}  // namespace

ClearMeshes::ClearMeshes(const Scene& scene) : at_face_(scene.meshes.size(), Vec3f{1, 1, 1}), crossings_(scene.meshes.size(), 1) {
  constexpr double kClosed = 1e-2;  // of the area
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (mesh.is_light_shape || mesh.indices.empty() || !light_passes(scene, mesh)) continue;
    const SurfaceMaterial& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    const Measures measures = measures_of(mesh);
    numbers_.push_back(m);
    at_face_[m] = through_face(scene, mesh);
    crossings_[m] = material.solid || length(measures.sum) < kClosed * measures.area ? 2 : 1;
    if (!material.solid) continue;
    const double chord = measures.area > 0 ? 4 * std::fabs(measures.volume) / measures.area : 0;
    at_face_[m] = root(at_face_[m] * left_after(material, static_cast<float>(chord)));
  }
}

Vec3d ClearMeshes::passes_between(const RayScene& rays, Vec3d from, Vec3d to) const {
  Vec3d fraction{1, 1, 1};
  if (empty()) return fraction;
  constexpr int kMostFaces = 32;
  const auto end = static_cast<Vec3f>(to);
  auto place = static_cast<Vec3f>(from);
  const Vec3f direction = normalized(end - place);
  for (int face = 0; face < kMostFaces; ++face) {
    RTCRayHit hit;
    if (!rays.intersect(place, direction, hit) || !(hit.ray.tfar < length(end - place))) break;
    fraction = fraction * static_cast<Vec3d>(at_face_[hit.hit.geomID]);
    const Vec3f met = place + direction * hit.ray.tfar;
    place = met + direction * static_cast<float>(rays.offset_from_surface(static_cast<Vec3d>(met)));
  }
  return fraction;
}

void ClearMeshes::tint(const RayScene& rays, RayScene::Sixteen& sixteen, std::uint32_t asked, Sixteen& light) const {
  if (empty()) return;
  const std::uint32_t through = rays.blocked_among(sixteen, asked, Casters::clear);
  const RTCRay16& r = sixteen.rays;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if ((through >> i & 1) == 0) continue;
    const auto from = static_cast<Vec3d>(Vec3f{r.org_x[i], r.org_y[i], r.org_z[i]});
    const auto along = static_cast<Vec3d>(Vec3f{r.dir_x[i], r.dir_y[i], r.dir_z[i]});
    light[i] = light[i] * static_cast<Vec3f>(passes_between(rays, from, from + along));
  }
}

}  // namespace steradian
