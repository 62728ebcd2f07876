#include "bake/charts/seams.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "bake/charts/welded.h"

namespace steradian::bake {
namespace {

struct SeamSide {
  std::uint32_t chart, number, k;  // triangle of the chart, and its edge
  bool forwards;                   // from the lesser welded corner to the larger
};

}  // namespace

std::vector<Seam> seams_of(const Scene& scene, const std::vector<Chart>& charts) {
  WeldedPoints points;
  std::unordered_map<std::uint64_t, std::vector<SeamSide>> edges;
  std::vector<std::uint64_t> order;
  const auto vertex = [&](const Chart& chart, std::uint32_t number, std::uint32_t k) {
    return scene.meshes[chart.mesh].indices[3 * std::size_t{chart.triangles[number].triangle} + k % 3];
  };
  for (std::uint32_t c = 0; c < charts.size(); ++c) {
    if (charts[c].is_covered) continue;
    const Mesh& mesh = scene.meshes[charts[c].mesh];
    for (std::uint32_t n = 0; n < charts[c].triangles.size(); ++n)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint64_t a = points.number_of(mesh.positions[vertex(charts[c], n, k)]);
        const std::uint64_t b = points.number_of(mesh.positions[vertex(charts[c], n, k + 1)]);
        const auto [it, fresh] = edges.try_emplace(std::min(a, b) << 32 | std::max(a, b));
        if (fresh) order.push_back(it->first);
        it->second.push_back({c, n, k, a < b});
      }
  }
  std::vector<Seam> seams;
  for (const std::uint64_t key : order) {
    const std::vector<SeamSide>& sides = edges[key];
    if (sides.size() != 2) continue;  // at an edge of three triangles each may have a light of its own
    Seam seam;
    std::array<std::array<Vec3f, 2>, 2> normals;
    for (std::size_t s = 0; s < 2; ++s) {
      const SeamSide& side = sides[s];
      const Chart& chart = charts[side.chart];
      const Mesh& mesh = scene.meshes[chart.mesh];
      seam.chart[s] = side.chart;
      for (std::uint32_t end = 0; end < 2; ++end) {
        const std::uint32_t k = side.forwards ? side.k + end : side.k + 1 - end;
        seam.ends[s][end] = chart.triangles[side.number].at[k % 3];
        normals[s][end] = mesh.normals[vertex(chart, side.number, k)];
      }
      seam.length = length(
          static_cast<Vec3d>(mesh.positions[vertex(chart, side.number, side.k)] - mesh.positions[vertex(chart, side.number, side.k + 1)]));
    }
    const Chart &one = charts[seam.chart[0]], &other = charts[seam.chart[1]];
    if (sides[0].forwards == sides[1].forwards) continue;  // they face opposite ways
    if (one.cut_from != Chart::kWhole && one.cut_from == other.cut_from) continue;
    if (seam.chart[0] == seam.chart[1] && seam.ends[0] == seam.ends[1]) continue;
    if (!(dot(normals[0][0], normals[1][0]) > kSmoothEdge) || !(dot(normals[0][1], normals[1][1]) > kSmoothEdge)) continue;
    seams.push_back(seam);
  }
  std::map<std::uint32_t, std::pair<std::uint32_t, const ChartDoor*>> doors;  // the first chart of each
  for (std::uint32_t c = 0; c < charts.size(); ++c)
    for (const ChartDoor& door : charts[c].doors) {
      const auto [it, fresh] = doors.try_emplace(door.number, c, &door);
      if (!fresh) seams.push_back({{it->second.first, c}, {it->second.second->ends, door.ends}, door.length});
    }
  return seams;
}

std::vector<std::vector<std::uint32_t>> joined_charts(std::size_t charts, const std::vector<Seam>& seams) {
  std::vector<std::uint32_t> root(charts);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t c) {
    while (root[c] != c) c = root[c] = root[root[c]];
    return c;
  };
  for (const Seam& seam : seams) {
    const std::uint32_t a = find(seam.chart[0]), b = find(seam.chart[1]);
    root[std::max(a, b)] = std::min(a, b);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (std::uint32_t c = 0; c < charts; ++c) groups[find(c)].push_back(c);
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [first, group] : groups) result.push_back(std::move(group));
  return result;
}

}  // namespace steradian::bake
