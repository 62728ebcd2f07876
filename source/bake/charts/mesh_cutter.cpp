#include "bake/charts/mesh_cutter.h"

#include <algorithm>

namespace steradian::bake {

std::uint32_t MeshCutter::put(std::uint32_t m, std::uint32_t source, bool in_place, const std::array<CutCorner, 3>& corners) {
  Mesh& mesh = to_.scene.meshes[m];
  auto& from = to_.corners[m];
  before_.try_emplace(m, mesh.indices);
  if (from.empty()) {
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) from.push_back({{{t, {1, 0, 0}}, {t, {0, 1, 0}}, {t, {0, 0, 1}}}});
  }
  std::array<std::uint32_t, 3> vertices;
  for (std::size_t k = 0; k < 3; ++k) vertices[k] = vertex(mesh, m, corners[k]);
  const auto number = in_place ? source : static_cast<std::uint32_t>(mesh.triangle_count());
  if (!in_place) {
    mesh.indices.resize(mesh.indices.size() + 3);
    from.emplace_back();
    if (mesh.is_emitter()) mesh.triangle_lights.push_back(mesh.triangle_lights[source]);
  }
  std::copy(vertices.begin(), vertices.end(), mesh.indices.begin() + 3 * static_cast<std::ptrdiff_t>(number));
  from[number] = corners;
  return number;
}

std::uint32_t MeshCutter::vertex(Mesh& mesh, std::uint32_t m, const CutCorner& corner) {
  const std::uint32_t* old = before_[m].data() + 3 * std::size_t{corner.triangle};
  constexpr double kAtCorner = 1 - 1e-9;
  for (std::size_t k = 0; k < 3; ++k)
    if (corner.weights[k] >= kAtCorner) return old[k];
  const auto [it, fresh] = vertices_.try_emplace({corner.triangle, corner.weights}, static_cast<std::uint32_t>(mesh.positions.size()));
  if (!fresh) return it->second;
  Vec3d place{}, normal{};
  for (std::size_t k = 0; k < 3; ++k) {
    place += static_cast<Vec3d>(mesh.positions[old[k]]) * corner.weights[k];
    normal += static_cast<Vec3d>(mesh.normals[old[k]]) * corner.weights[k];
  }
  mesh.positions.push_back(static_cast<Vec3f>(place));
  mesh.normals.push_back(static_cast<Vec3f>(normalized(normal)));
  if (!mesh.tangents.empty()) mesh.tangents.push_back(mesh.tangents[old[0]]);
  const auto mean_of = [&](auto member) {
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += member(old[k]) * static_cast<float>(corner.weights[k]);
    return sum;
  };
  for (std::vector<Vec2f>& set : mesh.texcoords)
    if (!set.empty()) set.push_back({mean_of([&](auto i) { return set[i].x; }), mean_of([&](auto i) { return set[i].y; })});
  const std::vector<Vec4f>& colors = mesh.colors;
  if (!colors.empty())
    mesh.colors.push_back({mean_of([&](auto i) { return colors[i].x; }), mean_of([&](auto i) { return colors[i].y; }),
                           mean_of([&](auto i) { return colors[i].z; }), mean_of([&](auto i) { return colors[i].w; })});
  return it->second;
}

}  // namespace steradian::bake
