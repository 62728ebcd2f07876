// MeshCutter: puts the parts of triangles in their place, and remembers where they come from.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "steradian/scene.h"

namespace steradian::bake {

// A corner of a triangle of a cut mesh, in the uncut one.
struct CutCorner {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};  // of its corners
};

// The meshes that were cut, and where their triangles come from.
struct CutScene {
  Scene scene;
  std::vector<std::vector<std::array<CutCorner, 3>>> corners;  // by mesh and triangle; empty for a mesh that was not cut
  std::vector<std::string> warnings;
  std::size_t cut = 0;  // charts that contacts part
};

class MeshCutter {
 public:
  // The scene must outlive this object. Triangles that are cut must be whole before.
  explicit MeshCutter(CutScene& to) : to_(to) {}

  // Begins a part whose new vertices are its own.
  void begin_part() { vertices_.clear(); }
  // Stores a triangle of a mesh in the place of the one that it is cut from, or behind all others. Returns its number.
  std::uint32_t put(std::uint32_t mesh, std::uint32_t source, bool in_place, const std::array<CutCorner, 3>& corners);

 private:
  // A corner's vertex: that of the uncut triangle, or a new one between its vertices.
  std::uint32_t vertex(Mesh& mesh, std::uint32_t m, const CutCorner& corner);

  CutScene& to_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> before_;  // indices of the meshes that are being cut
  std::map<std::pair<std::uint32_t, std::array<double, 3>>, std::uint32_t> vertices_;
};

}  // namespace steradian::bake
