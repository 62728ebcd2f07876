// A scene's edges as a device gathers them. Numbers are laid out as in shaders/shadow/shadow_layout.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shadow/edges/edges.h"
#include "steradian/vector.h"

namespace steradian::vulkan {

// The edges, their boxes, vertices and planes, relative to the middle of the mesh.
std::vector<std::array<std::uint32_t, 4>> mesh_vectors(const shadow::EdgeMesh& mesh);

// Vertices and planes in the coordinates of a light.
inline std::size_t vectors_of_frame(const shadow::EdgeMesh& mesh) { return mesh.vertices.size() + mesh.planes.size(); }
void write_frame(const shadow::EdgeMesh& mesh, const Frame& axes, Vec3d origin, std::array<float, 4>* to);

}  // namespace steradian::vulkan
