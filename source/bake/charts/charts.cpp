#include "bake/charts/charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/charts/grid_charts.h"
#include "bake/charts/overlaps.h"
#include "bake/charts/welded.h"
#include "render/surface/surface.h"
#include "steradian/error.h"

namespace steradian::bake {
namespace {

constexpr double kSameWay = 0.999;           // cosine: plane triangles face within 2.6 degrees, since thin ones are uncertain
constexpr double kCone = 0.76604444;         // cosine of 40 degrees
constexpr float kStraight = 1 - 1e-6f;       // cosine between vertex normals that agree: they differ by rounding alone
constexpr double kMostOfTexels = 3;          // texels of charts with grids over those without: powers of two alone cost up to 2^1.6 = 3
constexpr double kThinnest = 1e-7;           // of the longest edge's square: a smaller doubled area is rounding
constexpr double kRounding = 0x1p-21;        // of coordinates in single precision, over a few operations
constexpr std::size_t kManyCharts = 10'000;  // of one mesh, from which a warning names it

double longest_edge(const Mesh& mesh, std::size_t t) {
  const Vec3d a = corner_of(mesh, t, 0), b = corner_of(mesh, t, 1), c = corner_of(mesh, t, 2);
  return std::max({length(b - a), length(c - b), length(a - c)});
}

void check_mesh(const Mesh& mesh, std::uint32_t number, const std::string& place) {
  const std::size_t count = mesh.positions.size();
  const auto refuse = [&](const std::string& problem, const std::string& advice) {
    throw Error(place + ": " + name_of(mesh, number), problem, advice);
  };
  if (mesh.normals.size() != count)
    refuse("has " + std::to_string(mesh.normals.size()) + " normals for " + std::to_string(count) + " positions",
           "give each position a unit normal");
  if (!mesh.texcoords[1].empty() && mesh.texcoords[1].size() != count)
    refuse("has " + std::to_string(mesh.texcoords[1].size()) + " coordinates in TEXCOORD_1 for " + std::to_string(count) + " positions",
           "give each position its coordinates, or none");
  for (const std::uint32_t i : mesh.indices)
    if (i >= count) refuse("has a triangle with vertex " + std::to_string(i) + " of " + std::to_string(count), "mend its indices");
  const auto is_finite = [](Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2f uv = mesh.texcoords[1].empty() ? Vec2f{} : mesh.texcoords[1][i];
    if (!is_finite(mesh.positions[i]) || !is_finite(mesh.normals[i]) || !std::isfinite(uv.x) || !std::isfinite(uv.y))
      refuse("has a vertex that is not finite, number " + std::to_string(i), "mend its position, normal and TEXCOORD_1");
  }
}

bool has_area(const Mesh& mesh, std::size_t t) {
  const double edge = longest_edge(mesh, t);
  return length(across(mesh, t)) > kThinnest * edge * edge;
}

// The work on one mesh.
class MeshCharts {
 public:
  MeshCharts(const Scene& scene, std::uint32_t number, const std::string& place)
      : mesh_(scene.meshes[number]), number_(number), place_(place), neighbours_(mesh_), taken_(mesh_.triangle_count(), 0) {
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      normals_.push_back(normalized(steradian::bake::across(mesh_, t)));
      if (has_area(mesh_, t))
        order_.push_back(t);
      else
        taken_[t] = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d p = corner_of(mesh_, t, k);
        reach_ = std::max({reach_, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
      }
    }
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return length(steradian::bake::across(mesh_, a)) > length(steradian::bake::across(mesh_, b));
    });
  }

  std::size_t without_area() const { return mesh_.triangle_count() - order_.size(); }

  // Grids of curved quadrilaterals, plane parts and cones.
  std::vector<Chart> found(double texels) {
    std::vector<std::uint8_t> curved(mesh_.triangle_count(), 0);
    for (const std::uint32_t t : order_) curved[t] = is_curved(t);
    std::vector<Chart> grids = grid_charts(mesh_, number_, neighbours_, curved, texels);
    if (grids.empty()) return with_rest({});
    std::vector<Chart> without = with_rest({}), all = with_rest(grids);
    const auto texels_of = [&](const std::vector<Chart>& charts) {
      double sum = 0;
      for (const Chart& chart : charts) sum += texels_in(chart, texels);
      return sum;
    };
    if (texels_of(all) <= kMostOfTexels * texels_of(without)) return all;
    // Thin triangles around one vertex, and small ones without order, are left to cones.
    std::erase_if(grids, [&](const Chart& c) { return texels_in(c, texels) > 2 * kMostOfTexels * area_of(c) * texels * texels; });
    return with_rest(std::move(grids));
  }

  // Charts, and plane parts and cones for all other triangles.
  std::vector<Chart> with_rest(std::vector<Chart> charts) {
    const std::vector<std::uint8_t> before = taken_;
    for (const Chart& chart : charts)
      for (const ChartTriangle& t : chart.triangles) taken_[t.triangle] = 1;
    for (const std::uint32_t seed : order_)
      if (taken_[seed] == 0) charts.push_back(grown_from(seed));
    taken_ = before;
    return charts;
  }

  // The charts of the second set of texture coordinates.
  std::vector<Chart> given() {
    std::vector<Chart> charts;
    for (const std::uint32_t t : order_)
      if (!(std::fabs(doubled_area(uv_of(t))) > 0))
        fail("triangle " + std::to_string(t) + " of TEXCOORD_1 has no area", "unwrap the mesh again, or remove TEXCOORD_1");
    double longest = 0;
    for (const std::uint32_t t : order_)
      for (const auto at = uv_of(t); const std::size_t k : {0u, 1u, 2u}) longest = std::max(longest, length(at[(k + 1) % 3] - at[k]));
    Overlaps overlaps(longest);
    for (const std::uint32_t seed : order_)
      if (taken_[seed] == 0) charts.push_back(given_from(seed, overlaps));
    return charts;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& advice) const {
    throw Error(place_ + ": " + name_of(mesh_, number_), problem, advice);
  }
  std::array<Vec2d, 3> uv_of(std::uint32_t t) const {
    std::array<Vec2d, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = mesh_.texcoords[1][mesh_.indices[3 * std::size_t{t} + k]];
      at[k] = {static_cast<double>(uv.x), static_cast<double>(uv.y)};
    }
    return at;
  }

  // A plane through the largest triangle, with x along its longest edge.
  ChartPlane plane_of(std::uint32_t t) const {
    Vec3d along{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d edge = corner_of(mesh_, t, (k + 1) % 3) - corner_of(mesh_, t, k);
      if (length(edge) > length(along) * (1 + 1e-6)) along = edge;
    }
    // Right-angled triangles have their legs along the axes: charts of rectangles are rectangles.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d a = corner_of(mesh_, t, (k + 1) % 3) - corner_of(mesh_, t, k),
                  b = corner_of(mesh_, t, (k + 2) % 3) - corner_of(mesh_, t, k);
      if (std::fabs(dot(a, b)) <= 1e-4 * length(a) * length(b)) along = length(a) >= length(b) ? a : b;
    }
    const Vec3d normal = normals_[t], x = normalized(along - normal * dot(along, normal));
    return {corner_of(mesh_, t, 0), x, cross(normal, x), normal};
  }
  std::array<Vec2d, 3> places_in(const ChartPlane& plane, std::uint32_t t) const {
    return {plane.at(corner_of(mesh_, t, 0)), plane.at(corner_of(mesh_, t, 1)), plane.at(corner_of(mesh_, t, 2))};
  }

  static double texels_in(const Chart& chart, double texels) {
    const Vec2d size = chart.box().size() * texels;
    return (std::ceil(size.x) + 1) * (std::ceil(size.y) + 1);
  }
  double area_of(const Chart& chart) const {
    double area = 0;
    for (const ChartTriangle& t : chart.triangles) area += length(steradian::bake::across(mesh_, t.triangle)) / 2;
    return area;
  }

  // True if the vertex normals turn along the triangle.
  bool is_curved(std::uint32_t t) const {
    const auto normal = [&](std::size_t k) { return mesh_.normals[mesh_.indices[3 * std::size_t{t} + k]]; };
    return std::min({dot(normal(0), normal(1)), dot(normal(1), normal(2)), dot(normal(2), normal(0))}) < kStraight;
  }

  Chart grown_from(std::uint32_t seed) {
    Chart chart;
    chart.mesh = number_;
    chart.is_flat = true;
    chart.plane = plane_of(seed);
    Overlaps overlaps(longest_edge(mesh_, seed));
    const auto take = [&](std::uint32_t t) {
      taken_[t] = 1;
      chart.triangles.push_back({t, places_in(chart.plane, t)});
      overlaps.add(chart.triangles.back().at);
    };
    take(seed);
    Box3d box;
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
      const std::uint32_t t = chart.triangles[n].triangle;
      for (std::size_t k = 0; k < 3; ++k) box.add(corner_of(mesh_, t, k));
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t edge = neighbours_.across(t, k);
        if (edge == MeshNeighbours::kNone || taken_[edge / 3] != 0) continue;
        const std::uint32_t other = edge / 3;
        const double towards = dot(normals_[other], chart.plane.normal);
        double off = 0;
        for (std::size_t c = 0; c < 3; ++c)
          off = std::max(off, std::fabs(dot(corner_of(mesh_, other, c) - chart.plane.origin, chart.plane.normal)));
        const bool plane = towards > kSameWay && off <= 5e-6 * length(box.size()) + kRounding * reach_;
        if (!plane && !(towards > kCone && meet_smoothly(mesh_, 3 * t + k, edge))) continue;
        if (overlaps.meet(places_in(chart.plane, other))) continue;
        chart.is_flat &= plane;
        take(other);
      }
    }
    return chart;
  }

  // overlaps: the triangles of all charts before it.
  Chart given_from(std::uint32_t seed, Overlaps& overlaps) {
    Chart chart;
    chart.mesh = number_;
    double area = 0, in_map = 0;
    const auto take = [&](std::uint32_t t) {
      taken_[t] = 1;
      chart.triangles.push_back({t, uv_of(t)});
      const auto& at = chart.triangles.back().at;
      area += length(steradian::bake::across(mesh_, t));
      in_map += std::fabs(doubled_area(at));
    };
    take(seed);
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
      const std::uint32_t t = chart.triangles[n].triangle;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t edge = neighbours_.across(t, k);
        if (edge == MeshNeighbours::kNone || taken_[edge / 3] != 0) continue;
        const auto here = uv_of(t), there = uv_of(edge / 3);
        const std::uint32_t l = edge % 3;
        if (here[k] == there[(l + 1) % 3] && here[(k + 1) % 3] == there[l]) take(edge / 3);
      }
    }
    const bool mirrored = doubled_area(chart.triangles.front().at) < 0;
    for (ChartTriangle& t : chart.triangles) {
      if ((doubled_area(t.at) < 0) != mirrored)
        fail("triangle " + std::to_string(t.triangle) + " of TEXCOORD_1 is flipped within its chart",
             "unwrap the mesh again, or remove TEXCOORD_1");
      if (overlaps.meet(t.at))
        fail("triangle " + std::to_string(t.triangle) + " of TEXCOORD_1 overlaps another one",
             "unwrap the mesh again, or remove TEXCOORD_1");
      overlaps.add(t.at);
    }
    const double scale = std::sqrt(area / in_map);
    for (ChartTriangle& t : chart.triangles)
      for (Vec2d& p : t.at) p = p * scale;
    return chart;
  }

  const Mesh& mesh_;
  const std::uint32_t number_;
  const std::string& place_;
  const MeshNeighbours neighbours_;
  std::vector<std::uint8_t> taken_;
  std::vector<Vec3d> normals_;
  std::vector<std::uint32_t> order_;  // triangles with area, the largest first
  double reach_ = 0;
};

}  // namespace

bool takes_light(const Scene& scene, const Mesh& mesh) {
  return !mesh.is_light_shape && !scene.materials[static_cast<std::size_t>(mesh.material)].unlit && !light_passes(scene, mesh);
}

Charts charts_of(const Scene& scene, double texels, const std::string& place) {
  Charts result;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (!takes_light(scene, mesh)) continue;
    check_mesh(mesh, m, place);
    MeshCharts work(scene, m, place);
    result.without_area += work.without_area();
    std::vector<Chart> charts = mesh.texcoords[1].empty() ? work.found(texels) : work.given();
    if (charts.empty()) result.warnings.push_back(name_of(mesh, m) + " has no triangle with an area: it gets no light map");
    if (charts.size() > kManyCharts)
      result.warnings.push_back(name_of(mesh, m) + " has " + std::to_string(mesh.triangle_count()) + " triangles in " +
                                std::to_string(charts.size()) + " charts: smooth normals or --target vertex give a smaller map");
    for (Chart& chart : charts) result.charts.push_back(std::move(chart));
  }
  return result;
}

}  // namespace steradian::bake
