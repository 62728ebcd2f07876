#include "device/shadow/edge_buffers.h"

#include <algorithm>
#include <bit>

#include "core/box_tree.h"
#include "shadow/edges/segments.h"

namespace steradian::vulkan {
namespace {

#include "shaders/shadow/shadow_layout.glsl"

using FourBits = std::array<std::uint32_t, 4>;

std::uint32_t bits(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }
std::uint32_t whole(std::size_t n) { return static_cast<std::uint32_t>(n); }
std::array<float, 4> floats(Vec3d v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

constexpr std::uint32_t walks_of(const shadow::EdgeTriangle& t, int there, int against) {
  return static_cast<std::uint32_t>(there | (t.walks < 0 ? against : 0));
}

// Adds the edges' records and the incidences of those with more than two triangles.
void add_edges(const shadow::EdgeMesh& mesh, std::vector<FourBits>& vectors, std::vector<std::uint32_t>& incidences) {
  std::vector<shadow::EdgeTriangle> blocking;
  for (const shadow::MeshEdge& e : mesh.edges) {
    blocking.clear();
    add_incidences(mesh, e, {}, blocking);
    const std::size_t count = blocking.size();
    std::uint32_t flags = 0, planes[2] = {0, 0};
    if (count > 2) {
      flags = static_cast<std::uint32_t>(kManyWalks);
      planes[0] = whole(incidences.size());
      planes[1] = whole(count);
      for (const shadow::EdgeTriangle& t : blocking) incidences.push_back(t.triangle | (t.walks < 0 ? 1u << kAgainstFrom : 0u));
    } else {
      for (std::size_t i = 0; i < count; ++i) planes[i] = blocking[i].triangle;
      if (count > 0) flags = walks_of(blocking[0], kWalks0, kAgainst0);
      if (count > 1) flags |= walks_of(blocking[1], kWalks1, kAgainst1);
    }
    vectors.push_back({e.v0 | flags << kFlagsFrom, e.v1, planes[0], planes[1]});
  }
}

// Adds boxes around the edges, whose order is that of leaves already.
std::size_t add_nodes(const shadow::EdgeMesh& mesh, std::vector<FourBits>& vectors) {
  constexpr auto kEdges = static_cast<std::size_t>(kLeaf);
  const auto box_of = [&](std::uint32_t leaf) {
    Box3d box;
    for (std::size_t e = leaf * kEdges; e < std::min((leaf + 1) * kEdges, mesh.edges.size()); ++e)
      for (const std::uint32_t v : {mesh.edges[e].v0, mesh.edges[e].v1}) box.add(mesh.vertices[v] - mesh.around.middle);
    return box;
  };
  const BoxTree<Box3d> tree((mesh.edges.size() + kEdges - 1) / kEdges, box_of,
                            [](auto leaves) { return leaves.size() > 1 ? (leaves.size() + 1) / 2 : 0; });
  const std::size_t count = mesh.edges.empty() ? 0 : tree.nodes().size() - 1;
  for (std::size_t n = 0; n < count; ++n) {
    const auto& node = tree.nodes()[n];
    const auto vector = [](Vec3d v, std::size_t w) { return FourBits{bits(v.x), bits(v.y), bits(v.z), whole(w)}; };
    vectors.push_back(vector(node.volume.low, node.next == n + 1 ? node.first * kEdges + 1 : 0));
    vectors.push_back(vector(node.volume.high, node.next));
  }
  return count;
}

}  // namespace

std::vector<FourBits> mesh_vectors(const shadow::EdgeMesh& mesh) {
  std::vector<FourBits> vectors(static_cast<std::size_t>(kMeshHead));
  std::vector<std::uint32_t> incidences;
  add_edges(mesh, vectors, incidences);
  const std::size_t nodes_at = vectors.size(), nodes = add_nodes(mesh, vectors), incidences_at = vectors.size();
  for (std::size_t i = 0; i < incidences.size(); ++i) {
    if (i % 4 == 0) vectors.push_back({});
    vectors.back()[i % 4] = incidences[i];
  }
  vectors[0] = {whole(mesh.edges.size()), whole(nodes), whole(nodes_at), whole(incidences_at)};
  vectors[1] = {whole(vectors.size()), whole(vectors.size() + mesh.vertices.size()), 0, 0};
  const auto add = [&](Vec3d v, double w) { vectors.push_back({bits(v.x), bits(v.y), bits(v.z), bits(w)}); };
  for (const Vec3d& v : mesh.vertices) add(v - mesh.around.middle, 0);
  for (const shadow::Plane& p : mesh.planes) {
    // Normals have unit length here: those of small triangles would leave the range of floats.
    const double size = length(p.normal), scale = size > 0 ? 1 / size : 0;
    add(p.normal * scale, (p.offset - dot(p.normal, mesh.around.middle)) * scale);
  }
  return vectors;
}

void write_frame(const shadow::EdgeMesh& mesh, const Frame& axes, Vec3d origin, std::array<float, 4>* to) {
  for (const Vec3d& v : mesh.vertices) *to++ = floats(axes.to_local(v - origin), 0);
  for (const shadow::Plane& p : mesh.planes) *to++ = floats(axes.to_local(p.normal), p.offset - dot(p.normal, origin));
}

}  // namespace steradian::vulkan
