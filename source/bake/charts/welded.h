// The edges of a mesh, which triangles share where their corners' positions are equal.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "steradian/scene.h"

namespace steradian::bake {

// Cosine between the vertex normals of two triangles that meet smoothly.
inline constexpr float kSmoothEdge = 0.999f;

// Numbers of positions, equal for equal ones.
class WeldedPoints {
 public:
  std::uint32_t number_of(Vec3f p) {
    const Vec3f q = p + Vec3f{0, 0, 0};  // -0 becomes 0
    const auto [it, fresh] = numbers_.try_emplace(q, static_cast<std::uint32_t>(numbers_.size()));
    return it->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3f& p) const {
      std::uint64_t h = 0;
      for (const float x : {p.x, p.y, p.z}) h = (h ^ std::bit_cast<std::uint32_t>(x)) * 0xBF58476D1CE4E5B9u, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_map<Vec3f, std::uint32_t, Hash> numbers_;
};

// An edge of a triangle: from corner k to the next one.
struct EdgeOf {
  std::uint32_t triangle, k;
};

// True if the vertex normals of two triangles agree at their common edge. Edges are 3 triangle + k.
inline bool meet_smoothly(const Mesh& mesh, std::uint32_t edge, std::uint32_t other) {
  const auto normal = [&](std::uint32_t of, std::uint32_t end) { return mesh.normals[mesh.indices[of - of % 3 + (of % 3 + end) % 3]]; };
  return dot(normal(edge, 0), normal(other, 1)) > kSmoothEdge && dot(normal(edge, 1), normal(other, 0)) > kSmoothEdge;
}

// The other triangle at each edge of a mesh, if exactly two triangles that wind the same way share it.
class MeshNeighbours {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  explicit MeshNeighbours(const Mesh& mesh) {
    WeldedPoints points;
    for (const std::uint32_t i : mesh.indices) corners_.push_back(points.number_of(mesh.positions[i]));
    std::unordered_map<std::uint64_t, std::uint32_t> edges;  // by directed edge: 3 triangle + k, or kNone where it is shared
    const auto count = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t e = 0; e < count; ++e) {
      const auto [it, fresh] = edges.try_emplace(key(e, false), e);
      if (!fresh) it->second = kNone;
    }
    others_.assign(count, kNone);
    for (std::uint32_t e = 0; e < count; ++e) {
      const auto own = edges.find(key(e, false)), other = edges.find(key(e, true));
      if (own->second != kNone && other != edges.end()) others_[e] = other->second;
    }
  }

  // The edge of the other triangle, as 3 triangle + k; kNone: there is none.
  std::uint32_t across(std::uint32_t triangle, std::uint32_t k) const { return others_[3 * std::size_t{triangle} + k]; }
  std::uint32_t corner(std::uint32_t triangle, std::uint32_t k) const { return corners_[3 * std::size_t{triangle} + k]; }

 private:
  std::uint64_t key(std::uint32_t e, bool reversed) const {
    const std::uint64_t a = corners_[e], b = corners_[e - e % 3 + (e % 3 + 1) % 3];
    return reversed ? b << 32 | a : a << 32 | b;
  }
  std::vector<std::uint32_t> corners_, others_;
};

}  // namespace steradian::bake
