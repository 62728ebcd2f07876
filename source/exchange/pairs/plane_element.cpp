#include "exchange/pairs/plane_element.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "shapes/triangulate.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

using Loop = std::vector<Vec3d>;

// Rounding of a height above a plane, as a fraction of the sizes and the distance: 2^-53 times the products and sums of one dot product.
constexpr double kHeightRounding = 0x1p-46;
// Products of four lengths stay in the range of double.
constexpr double kLargest = 1e50;
// Slivers of rounding are no triangles. A cut moves corners by kHeightRounding of the size, so that a hundred cuts change less of the area
// than kSplitArea; a hole that reaches beyond its outline changes more.
constexpr double kSliver = 1e-12, kSplitArea = 1e-9;

Vec3d area_vector_of(const Loop& loop) {
  Vec3d sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  return sum * 0.5;
}

Loop without_repeated(const Loop& loop) {
  Loop result;
  for (const Vec3d& v : loop)
    if (result.empty() || !(v == result.back())) result.push_back(v);
  while (result.size() > 1 && result.front() == result.back()) result.pop_back();
  return result;
}

// Sets area, centroid, radius and half edges from the contours and the normal.
void measure(PlaneElement& e) {
  e.area = 0;
  e.half_a = e.half_b = {};
  e.skew = 0;
  Vec3d moment{};
  if (e.contours.empty()) return;
  const Vec3d origin = e.contours[0][0];
  for (const Loop& loop : e.contours)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3d a = loop[i] - origin, b = loop[(i + 1) % loop.size()] - origin;
      const double twice = dot(cross(a, b), e.normal);
      e.area += twice / 2;
      moment += (a + b) * (twice / 6);
    }
  if (!(e.area > 0)) {
    e.contours.clear();
    e.area = 0;
    return;
  }
  e.centroid = origin + moment / e.area;
  e.radius = 0;
  for (const Loop& loop : e.contours)
    for (const Vec3d& v : loop) e.radius = std::max(e.radius, length(v - e.centroid));
  if (e.contours.size() == 1 && e.contours[0].size() == 4) {
    const Loop& v = e.contours[0];
    // Corners are c + a s + b t + q s t for s and t of -1 and 1.
    const Vec3d a = (v[1] - v[0] + (v[2] - v[3])) * 0.25, b = (v[3] - v[0] + (v[2] - v[1])) * 0.25,
                q = (v[2] - v[3] - (v[1] - v[0])) * 0.25;
    if (length(q) <= kOffPlane * e.radius) {
      e.half_a = a;
      e.half_b = b;
      const double whole = dot(cross(a, b), e.normal), along = std::fabs(dot(cross(q, b), e.normal) / whole),
                   across = std::fabs(dot(cross(a, q), e.normal) / whole);
      e.skew = 2 * ((along + across) * (length(a) + length(b)) + 0.5 * length(q));
    }
  }
}

double size_of(const Loop& loop) {
  double size = 0;
  for (const Vec3d& v : loop) size = std::max(size, length(v - loop[0]));
  return size;
}

double largest_height(const Loop& loop, Vec3d point, Vec3d normal) {
  double height = 0;
  for (const Vec3d& v : loop) height = std::max(height, std::fabs(dot(v - point, normal)));
  return height;
}

Vec3d middle_of(const Loop& loop) {
  Vec3d sum{};
  for (const Vec3d& v : loop) sum += (v - loop[0]) / static_cast<double>(loop.size());
  return loop[0] + sum;
}

}  // namespace

bool is_bent(const std::vector<Vec3d>& outline) {
  const Loop loop = without_repeated(outline);
  if (loop.size() < 4) return false;
  return largest_height(loop, middle_of(loop), normalized(area_vector_of(loop))) > kOffPlane * size_of(loop);
}

PlaneElement make_element(const std::vector<Vec3d>& outline, const std::vector<std::vector<Vec3d>>& holes, const std::string& place) {
  const auto check_finite = [&](const Loop& loop) {
    for (const Vec3d& v : loop)
      if (!is_finite(v)) throw Error(place, "a coordinate is not finite");
  };
  check_finite(outline);
  const Loop loop = without_repeated(outline);
  for (const Vec3d& v : loop)
    if (!(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}) < kLargest))
      throw Error(place, "a coordinate is 1e50 or more", "scale the scene down");
  if (loop.size() < 3) throw Error(place, "has fewer than three different corners", "remove the face");
  PlaneElement e;
  const Vec3d area = area_vector_of(loop);
  const double size = size_of(loop);
  if (!(size > 1 / kLargest)) throw Error(place, "is smaller than 1e-50", "scale the scene up");
  // A thinner outline is only rounding: floats have 2^-24 = 6e-8.
  if (!(length(area) > 1e-12 * size * size)) throw Error(place, "has no area", "remove the face");
  e.normal = normalized(area);
  const Vec3d middle = middle_of(loop);
  const auto check_plane = [&](const Loop& l) {
    e.off_plane = std::max(e.off_plane, largest_height(l, middle, e.normal));
    if (e.off_plane > kOffPlane * size) throw Error(place, "is bent by more than 1e-6 of its size", "split it into triangles");
  };
  check_plane(loop);
  e.contours.push_back(loop);
  for (const Loop& stored : holes) {
    check_finite(stored);
    Loop hole = without_repeated(stored);
    if (hole.size() < 3) continue;
    check_plane(hole);
    if (dot(area_vector_of(hole), e.normal) > 0) std::reverse(hole.begin(), hole.end());
    e.contours.push_back(std::move(hole));
  }
  measure(e);
  if (e.is_empty()) throw Error(place, "its holes leave no area", "remove the face");
  return e;
}

namespace {

double height_rounding(const PlaneElement& element, Vec3d point) {
  return kHeightRounding * (length(element.centroid - point) + element.radius);
}

// Cuts; heights up to `near` are 0.
PlaneElement cut_near(const PlaneElement& element, Vec3d point, Vec3d normal, int side, double near) {
  bool all = true, none = true;
  std::vector<std::vector<double>> heights;
  for (const Loop& loop : element.contours) {
    std::vector<double>& h = heights.emplace_back();
    for (const Vec3d& v : loop) {
      double height = side * dot(v - point, normal);
      if (std::fabs(height) <= near) height = 0;
      h.push_back(height);
      all = all && height >= 0;
      none = none && height <= 0;
    }
  }
  if (none) return {};
  if (all) return element;
  PlaneElement part;
  part.normal = element.normal;
  part.off_plane = element.off_plane;
  // Sutherland and Hodgman, "Reentrant polygon clipping", 1974, contour by contour. Edges along the plane may run forth and back; they
  // cancel in every integral.
  for (std::size_t c = 0; c < element.contours.size(); ++c) {
    const Loop& loop = element.contours[c];
    Loop cut;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      const double a = heights[c][i], b = heights[c][j];
      if (a >= 0) cut.push_back(loop[i]);
      // Both directions of an edge give the same bits.
      if (a > 0 && b < 0) cut.push_back(loop[i] + (loop[j] - loop[i]) * (a / (a - b)));
      if (a < 0 && b > 0) cut.push_back(loop[j] + (loop[i] - loop[j]) * (b / (b - a)));
    }
    cut = without_repeated(cut);
    if (cut.size() >= 3) part.contours.push_back(std::move(cut));
  }
  measure(part);
  return part;
}

}  // namespace

PlaneElement cut_element(const PlaneElement& element, Vec3d point, Vec3d normal, int side) {
  return cut_near(element, point, normal, side, height_rounding(element, point));
}

PlaneElement in_front_of(const PlaneElement& element, const PlaneElement& plane) {
  return cut_near(element, plane.centroid, plane.normal, 1,
                  height_rounding(element, plane.centroid) + kInPlane * (element.off_plane + plane.off_plane));
}

PlaneElement turned_over(const PlaneElement& element) {
  PlaneElement result = element;
  result.normal = -element.normal;
  for (Loop& loop : result.contours) std::reverse(loop.begin(), loop.end());
  measure(result);
  return result;
}

namespace {

// The contours in the element's own plane.
Contours flat_contours(const PlaneElement& element) {
  const Frame frame = Frame::from_normal(element.normal);
  Contours contours;
  for (const Loop& loop : element.contours) {
    std::vector<Vec2d>& flat = contours.emplace_back();
    for (const Vec3d& v : loop) {
      const Vec3d local = frame.to_local(v - element.centroid);
      flat.push_back({local.x, local.y});
    }
  }
  return contours;
}

}  // namespace

bool is_simple(const PlaneElement& element) {
  return (element.contours.size() == 1 && element.contours[0].size() == 3) || triangles_of(flat_contours(element)).has_value();
}

namespace {

PlaneElement element_of_loop(const Loop& loop, Vec3d normal) {
  PlaneElement e;
  e.normal = normal;
  e.contours.push_back(loop);
  measure(e);
  return e;
}

// Triangles between contours that do not touch; none otherwise.
std::optional<std::vector<PlaneElement>> simple_triangles(const PlaneElement& element) {
  const auto triangles = triangles_of(flat_contours(element));
  if (!triangles) return std::nullopt;
  std::vector<Vec3d> corners;
  for (const Loop& loop : element.contours) corners.insert(corners.end(), loop.begin(), loop.end());
  std::vector<PlaneElement> result;
  for (const auto& [a, b, c] : *triangles) {
    PlaneElement t = element_of_loop({corners[a], corners[b], corners[c]}, element.normal);
    if (!t.is_empty()) result.push_back(std::move(t));
  }
  return result;
}

// Holes that touch the outline or each other, as a door touches the edge of its wall: the triangles of the outline, cut along the triangles
// of each hole. None if the outline is not simple, or if a hole does not lie within it.
std::optional<std::vector<PlaneElement>> triangles_around_holes(const PlaneElement& element) {
  auto pieces = simple_triangles(element_of_loop(element.contours[0], element.normal));
  for (std::size_t h = 1; pieces && h < element.contours.size(); ++h) {
    const auto hole = simple_triangles(element_of_loop({element.contours[h].rbegin(), element.contours[h].rend()}, element.normal));
    if (!hole) return std::nullopt;
    for (const PlaneElement& triangle : *hole) {
      std::vector<PlaneElement> outside;
      for (PlaneElement inside : *pieces)
        for (std::size_t k = 0; k < 3 && !inside.is_empty(); ++k) {
          const Loop& corners = triangle.contours[0];
          const Vec3d outwards = normalized(cross(corners[(k + 1) % 3] - corners[k], element.normal));
          PlaneElement beyond = cut_element(inside, corners[k], outwards, 1);
          if (!beyond.is_empty()) outside.push_back(std::move(beyond));
          inside = cut_element(inside, corners[k], outwards, -1);
        }
      pieces = std::move(outside);
    }
  }
  if (!pieces) return std::nullopt;
  double area = 0;
  std::vector<PlaneElement> result;
  for (const PlaneElement& piece : *pieces) {
    const Loop& loop = piece.contours[0];  // convex
    area += piece.area;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      PlaneElement t = element_of_loop({loop[0], loop[k], loop[k + 1]}, element.normal);
      if (t.area > kSliver * element.area) result.push_back(std::move(t));
    }
  }
  if (!(std::fabs(area - element.area) <= kSplitArea * element.area)) return std::nullopt;
  return result;
}

}  // namespace

std::optional<std::vector<PlaneElement>> split_element(const PlaneElement& element) {
  auto triangles = simple_triangles(element);
  if (!triangles && element.contours.size() > 1) triangles = triangles_around_holes(element);
  return triangles;
}

std::vector<PlaneElement> triangles_of_element(const PlaneElement& element, const std::string& place) {
  auto triangles = split_element(element);
  if (!triangles) throw Error(place, "its outline crosses or touches itself", "split the face into triangles");
  return std::move(*triangles);
}

}  // namespace steradian::exchange
