#include "scene/emitters/merge_polygons.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>

#include "steradian/error.h"
#include "steradian/polygon_light.h"

namespace steradian::scene {
namespace {

using Contour = std::vector<Vec3d>;
using Index = std::uint32_t;

// Below this fraction of its longest edge's square, a triangle's doubled area is only rounding (floats have 2^-24 = 6e-8).
constexpr double kThinnest = 1e-7;
// prepare_polygon refuses points that are off the plane by 1e-5 of the light's size. The limit here is half of that, as the patch's plane
// may tilt.
constexpr double kOffPlane = 5e-6;
// Cosine of the angle between a triangle and its patch: 2.6 degrees, since the planes of thin triangles are uncertain.
constexpr double kFacesAlike = 0.999;

struct Welded {
  std::vector<Vec3d> points;
  std::vector<std::array<Index, 3>> corners;  // by triangle
};

struct BitHash {
  std::size_t operator()(const std::array<std::uint64_t, 3>& k) const {
    std::uint64_t h = 0;
    for (const std::uint64_t x : k) h = (h ^ (x + 0x9E3779B97F4A7C15u + (h << 6) + (h >> 2))) * 0xBF58476D1CE4E5B9u;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
};

Welded weld(const std::vector<Triangle>& triangles) {
  Welded result;
  std::unordered_map<std::array<std::uint64_t, 3>, Index, BitHash> known;
  for (const Triangle& t : triangles) {
    std::array<Index, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      // Adding zero turns -0 into 0, so that both are one corner.
      const Vec3d p = t[c] + Vec3d{0, 0, 0};
      const std::array<std::uint64_t, 3> key{std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
                                             std::bit_cast<std::uint64_t>(p.z)};
      const auto [it, fresh] = known.emplace(key, static_cast<Index>(result.points.size()));
      if (fresh) result.points.push_back(p);
      corners[c] = it->second;
    }
    result.corners.push_back(corners);
  }
  return result;
}

std::uint64_t edge_key(Index a, Index b) { return std::uint64_t{a} << 32 | b; }

constexpr std::size_t kShared = static_cast<std::size_t>(-1);  // a directed edge that two triangles claim

Vec3d face_vector(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

double longest_edge(const Triangle& t) { return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])}); }

bool has_area(const Triangle& t) {
  const double edge = longest_edge(t);
  return length(face_vector(t)) > kThinnest * edge * edge;
}

// A patch that grows from one triangle. The larger it is, the better its plane is known, whatever the rounding of one triangle's corners.
struct GrowingPatch {
  Vec3d point, area;  // a point of the plane; the sum of the face vectors
  Vec3d low, high;    // bounds
  std::vector<std::size_t> triangles;

  explicit GrowingPatch(Vec3d corner) : point(corner), low(corner), high(corner) {}

  void add(std::size_t index, const Triangle& t) {
    triangles.push_back(index);
    area += face_vector(t);
    for (const Vec3d& v : t) {
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
  }

  bool takes(const Triangle& t) const {
    const Vec3d n = normalized(area);
    if (dot(n, normalized(face_vector(t))) < kFacesAlike) return false;
    const double size = std::max(length(high - low), longest_edge(t));
    for (const Vec3d& v : t) {
      const double rounding = 1e-7 * (std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z));
      if (std::fabs(dot(v - point, n)) > kOffPlane * size + rounding) return false;
    }
    return true;
  }
};

// Removes corners that lie on the line between their neighbours.
Contour without_straight_corners(const Contour& contour) {
  Contour result;
  const auto straight = [](Vec3d a, Vec3d b, Vec3d c) {
    const double span = length(c - a);
    return dot(b - a, c - b) > 0 && length(cross(b - a, c - a)) <= kThinnest * span * span;
  };
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3d next = contour[(i + 1) % contour.size()];
    const Vec3d previous = result.empty() ? contour.back() : result.back();
    if (!straight(previous, contour[i], next)) result.push_back(contour[i]);
  }
  return result;
}

double signed_area(const Contour& contour, Vec3d normal) {
  Vec3d sum{};
  for (std::size_t i = 1; i + 1 < contour.size(); ++i) sum += cross(contour[i] - contour[0], contour[i + 1] - contour[0]);
  return dot(sum, normal) / 2;
}

// The closed contours of a patch's boundary; none if a corner is visited twice.
std::optional<std::vector<Contour>> trace_boundary(const Welded& mesh, const std::vector<std::size_t>& patch) {
  std::map<std::pair<Index, Index>, int> edges;  // ordered: the result does not depend on a hash
  for (const std::size_t t : patch)
    for (std::size_t c = 0; c < 3; ++c)
      if (++edges[{mesh.corners[t][c], mesh.corners[t][(c + 1) % 3]}] > 1) return {};
  std::map<Index, Index> next;
  for (const auto& [edge, count] : edges) {
    if (edges.count({edge.second, edge.first})) continue;
    if (!next.emplace(edge.first, edge.second).second) return {};
  }
  std::vector<Contour> contours;
  while (!next.empty()) {
    Contour contour;
    const Index first = next.begin()->first;
    Index at = first;
    do {
      const auto it = next.find(at);
      if (it == next.end()) return {};
      contour.push_back(mesh.points[at]);
      at = it->second;
      next.erase(it);
    } while (at != first);
    contours.push_back(without_straight_corners(contour));
    if (contours.back().size() < 3) return {};
  }
  return contours;
}

// A valid patch has one outline, holes in it, and the area of its triangles. Otherwise it overlaps itself.
std::optional<MergedPolygon> to_polygon(const Welded& mesh, const std::vector<Triangle>& triangles, const std::vector<std::size_t>& patch) {
  const auto contours = trace_boundary(mesh, patch);
  if (!contours) return {};
  const Vec3d normal = normalized(face_vector(triangles[patch.front()]));
  MergedPolygon polygon;
  polygon.triangles = patch;
  double area = 0, expected = 0;
  for (const Contour& contour : *contours) {
    const double a = signed_area(contour, normal);
    area += a;
    if (a < 0) {
      polygon.holes.push_back(contour);
    } else if (polygon.outline.empty()) {
      polygon.outline = contour;
    } else {
      return {};
    }
  }
  for (const std::size_t t : patch) expected += length(face_vector(triangles[t])) / 2;
  if (polygon.outline.empty() || std::fabs(area - expected) > 1e-5 * expected) return {};
  try {
    prepare_polygon({polygon.outline, polygon.holes, {1, 1, 1}, false});
  } catch (const Error&) {
    return {};
  }
  return polygon;
}

}  // namespace

MergedPolygons merge_coplanar(const std::vector<Triangle>& triangles, const std::function<bool(std::size_t, std::size_t)>& may_join) {
  const Welded mesh = weld(triangles);
  MergedPolygons result;
  std::vector<bool> taken(triangles.size(), false);
  std::unordered_map<std::uint64_t, std::size_t> owner;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!has_area(triangles[t])) {
      taken[t] = true;
      if (result.without_area++ == 0) result.first_without_area = t;
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [it, fresh] = owner.emplace(edge_key(mesh.corners[t][c], mesh.corners[t][(c + 1) % 3]), t);
      if (!fresh) it->second = kShared;
    }
  }

  // Patches grow from the largest triangles, whose planes are known best.
  std::vector<std::size_t> seeds;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!taken[t]) seeds.push_back(t);
  std::vector<double> size(triangles.size());
  for (const std::size_t t : seeds) size[t] = length(face_vector(triangles[t]));
  std::stable_sort(seeds.begin(), seeds.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  for (const std::size_t seed : seeds) {
    if (taken[seed]) continue;
    taken[seed] = true;
    GrowingPatch patch(triangles[seed][0]);
    patch.add(seed, triangles[seed]);
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t from = patch.triangles[i];
        const auto across = owner.find(edge_key(mesh.corners[from][(c + 1) % 3], mesh.corners[from][c]));
        if (across == owner.end() || across->second == kShared || taken[across->second]) continue;
        const std::size_t other = across->second;
        if (!patch.takes(triangles[other]) || !may_join(seed, other)) continue;
        taken[other] = true;
        patch.add(other, triangles[other]);
      }
    if (auto polygon = to_polygon(mesh, triangles, patch.triangles)) {
      result.polygons.push_back(std::move(*polygon));
    } else {
      for (const std::size_t t : patch.triangles) result.polygons.push_back({{triangles[t].begin(), triangles[t].end()}, {}, {t}});
    }
  }
  std::stable_sort(result.polygons.begin(), result.polygons.end(), [](const MergedPolygon& a, const MergedPolygon& b) {
    return *std::min_element(a.triangles.begin(), a.triangles.end()) < *std::min_element(b.triangles.begin(), b.triangles.end());
  });
  return result;
}

}  // namespace steradian::scene
