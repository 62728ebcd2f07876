#include "scene/tangents.h"

namespace steradian::scene {
namespace {

template <class T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  if (values.empty()) return;
  std::vector<T> result;
  result.reserve(indices.size());
  for (const std::uint32_t i : indices) result.push_back(values[i]);
  values = std::move(result);
}

Vec3d corner(const Mesh& mesh, std::size_t i) { return static_cast<Vec3d>(mesh.positions[mesh.indices[i]]); }

// Twice the area along the normal, in double because the products of tiny floats would vanish.
Vec3d face_vector(const Mesh& mesh, std::size_t triangle) {
  const Vec3d a = corner(mesh, 3 * triangle);
  return cross(corner(mesh, 3 * triangle + 1) - a, corner(mesh, 3 * triangle + 2) - a);
}

}  // namespace

void make_flat_normals(Mesh& mesh) {
  unshare(mesh.positions, mesh.indices);
  unshare(mesh.texcoords[0], mesh.indices);
  unshare(mesh.texcoords[1], mesh.indices);
  unshare(mesh.colors, mesh.indices);
  mesh.tangents.clear();
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
  mesh.normals.assign(mesh.positions.size(), Vec3f{0, 1, 0});  // stays if a triangle has no area
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3d n = normalized(face_vector(mesh, t));
    if (dot(n, n) > 0) mesh.normals[3 * t] = mesh.normals[3 * t + 1] = mesh.normals[3 * t + 2] = static_cast<Vec3f>(n);
  }
}

std::size_t repair_normals(Mesh& mesh) {
  std::size_t broken = 0;
  for (const Vec3f& n : mesh.normals) broken += !(dot(n, n) > 0.25f);
  if (broken == 0) return 0;
  std::vector<Vec3d> sums(mesh.normals.size());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) sums[mesh.indices[i]] += face_vector(mesh, i / 3);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (dot(mesh.normals[i], mesh.normals[i]) > 0.25f) continue;
    const Vec3d n = normalized(sums[i]);
    mesh.normals[i] = dot(n, n) > 0 ? static_cast<Vec3f>(n) : Vec3f{0, 1, 0};
  }
  return broken;
}

void make_tangents(Mesh& mesh, int set) {
  const auto& uv = mesh.texcoords[set];
  std::vector<Vec3d> along_u(mesh.positions.size()), along_v(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* i = mesh.indices.data() + 3 * t;
    const Vec3d e1 = corner(mesh, 3 * t + 1) - corner(mesh, 3 * t), e2 = corner(mesh, 3 * t + 2) - corner(mesh, 3 * t);
    const double u1 = static_cast<double>(uv[i[1]].x) - static_cast<double>(uv[i[0]].x),
                 v1 = static_cast<double>(uv[i[1]].y) - static_cast<double>(uv[i[0]].y);
    const double u2 = static_cast<double>(uv[i[2]].x) - static_cast<double>(uv[i[0]].x),
                 v2 = static_cast<double>(uv[i[2]].y) - static_cast<double>(uv[i[0]].y);
    const double sign = u1 * v2 - u2 * v1 < 0 ? -1 : 1;  // gradients up to a positive factor; larger faces weigh more
    const double area = length(cross(e1, e2));
    const Vec3d du = normalized((e1 * v2 - e2 * v1) * sign) * area, dv = normalized((e2 * u1 - e1 * u2) * sign) * area;
    for (int c = 0; c < 3; ++c) {
      along_u[i[c]] += du;
      along_v[i[c]] += dv;
    }
  }
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3d n = static_cast<Vec3d>(mesh.normals[i]);
    const Frame frame = Frame::from_normal_and_tangent(n, along_u[i]);
    // v grows down the picture, but a normal map's y points up. So the bitangent runs against v.
    const double w = dot(frame.y, along_v[i]) > 0 ? 1 : -1;
    mesh.tangents[i] = {static_cast<float>(frame.x.x), static_cast<float>(frame.x.y), static_cast<float>(frame.x.z),
                        static_cast<float>(-w)};
  }
}

}  // namespace steradian::scene
