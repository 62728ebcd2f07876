#include "render/environment/bright_spots.h"

#include <algorithm>
#include <numeric>

#include "steradian/area_light.h"  // luminance

namespace steradian::environment {
namespace {

constexpr double kMostSolidAngle = 0.5, kLeastFill = 0.6, kLeastShare = 0.005;
constexpr std::size_t kMostSpots = 16, kMostCorners = 16;

using Cell = DirectionGrid::Cell;

struct Spot {
  std::vector<Cell> cells;
  double solid_angle = 0, power = 0;
};

double luminance_of(const DirectionGrid& grid, Cell c) { return luminance(static_cast<Vec3d>(grid.map.at(c.column, c.row))); }

double threshold(const DirectionGrid& grid, double power) {
  std::vector<std::pair<double, double>> texels;  // luminance, solid angle
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i) texels.emplace_back(luminance_of(grid, {i, j}), grid.solid_angle(j));
  std::sort(texels.begin(), texels.end());
  double below = 0, median = 0;
  for (const auto& [l, solid_angle] : texels) {
    median = l;
    if ((below += solid_angle) >= 2 * std::numbers::pi) break;
  }
  return std::max(16 * median, 2 * power / (4 * std::numbers::pi));
}

// Texels above the threshold, grown over the eight neighbours, across the map's seam but not over the poles.
std::vector<Spot> bright_parts(const DirectionGrid& grid, double least) {
  const int width = grid.map.width, height = grid.map.height;
  std::vector<char> seen(grid.map.pixels.size(), 0);
  const auto index = [&](Cell c) {
    return static_cast<std::size_t>(c.row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.column);
  };
  std::vector<Spot> spots;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      if (seen[index({i, j})] != 0 || !(luminance_of(grid, {i, j}) > least)) continue;
      Spot spot;
      spot.cells.push_back({i, j});
      seen[index({i, j})] = 1;
      for (std::size_t next = 0; next < spot.cells.size(); ++next) {
        const Cell c = spot.cells[next];
        spot.solid_angle += grid.solid_angle(c.row);
        spot.power += luminance_of(grid, c) * grid.solid_angle(c.row);
        for (int dj = -1; dj <= 1; ++dj)
          for (int di = -1; di <= 1; ++di) {
            const Cell n{(c.column + di + width) % width, c.row + dj};
            if (n.row < 0 || n.row >= height || seen[index(n)] != 0 || !(luminance_of(grid, n) > least)) continue;
            seen[index(n)] = 1;
            spot.cells.push_back(n);
          }
      }
      spots.push_back(std::move(spot));
    }
  return spots;
}

struct Point {
  double x, y;
};
double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Counter-clockwise hull.
// Source: Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

// Removes the corners that cost the least area.
void simplify(std::vector<Point>& hull) {
  while (hull.size() > kMostCorners) {
    const auto lost = [&](std::size_t i) { return turn(hull[(i + hull.size() - 1) % hull.size()], hull[i], hull[(i + 1) % hull.size()]); };
    std::size_t least = 0;
    for (std::size_t i = 1; i < hull.size(); ++i)
      if (lost(i) < lost(least)) least = i;
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

// The plane that touches the unit sphere at a spot's middle. Directions become points of the plane.
struct TangentPlane {
  Frame frame;  // z points from the spot to the sphere's centre: a polygon counter-clockwise about it is lit towards the centre

  std::optional<Point> project(Vec3d d) const {
    const double towards = -dot(d, frame.z);
    if (towards < 0.3) return {};  // more than 72 degrees off
    return Point{dot(d, frame.x) / towards, dot(d, frame.y) / towards};
  }
  Vec3d lift(Point p) const { return frame.x * p.x + frame.y * p.y - frame.z; }
};

// Solid angle of a small convex polygon of the plane: the sum of its triangles' (van Oosterom, Strackee 1983).
double solid_angle(const std::vector<Vec3d>& v) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    const Vec3d a = normalized(v[0]), b = normalized(v[i]), c = normalized(v[i + 1]);
    sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return std::fabs(sum);
}

bool inside(const std::vector<Point>& hull, Point p) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (turn(hull[i], hull[(i + 1) % hull.size()], p) < 0) return false;
  return true;
}

// Mean of the texels that touch the spot and do not belong to it.
Vec3d mean_around(const DirectionGrid& grid, const Spot& spot) {
  const int width = grid.map.width;
  std::vector<std::pair<int, int>> own, around;  // (row, column), sorted
  for (const Cell c : spot.cells) own.emplace_back(c.row, c.column);
  std::sort(own.begin(), own.end());
  for (const Cell c : spot.cells)
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di) {
        const std::pair<int, int> n{c.row + dj, (c.column + di + width) % width};
        if (n.first >= 0 && n.first < grid.map.height && !std::binary_search(own.begin(), own.end(), n)) around.push_back(n);
      }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Vec3d sum{};
  double weight = 0;
  for (const auto& [row, column] : around) {
    sum += static_cast<Vec3d>(grid.map.at(column, row)) * grid.solid_angle(row);
    weight += grid.solid_angle(row);
  }
  return weight > 0 ? sum / weight : Vec3d{};
}

// Takes the polygon's light out of the map. The polygon's coverage of a texel is measured at 8 x 8 positions.
void take_out(DirectionGrid& grid, const Spot& spot, const TangentPlane& plane, const std::vector<Point>& hull, Vec3d radiance) {
  constexpr int kPlaces = 8;
  int first = grid.map.height, last = -1;
  for (const Cell c : spot.cells) {
    first = std::min(first, c.row);
    last = std::max(last, c.row);
  }
  // Texels farther from the hull than their own diagonal are not covered.
  double farthest = 0;
  for (const Point& p : hull) farthest = std::max(farthest, std::hypot(p.x, p.y));
  const double reach = std::atan(farthest) + 2 * std::numbers::pi / grid.map.height;
  for (int j = std::max(first - 1, 0); j <= std::min(last + 1, grid.map.height - 1); ++j)
    for (int i = 0; i < grid.map.width; ++i) {
      if (-dot(grid.center(i, j), plane.frame.z) < std::cos(std::min(reach, 1.5))) continue;
      int covered = 0;
      for (int k = 0; k < kPlaces * kPlaces; ++k) {
        const auto p = plane.project(grid.direction(i + (k % kPlaces + 0.5) / kPlaces, j + (k / kPlaces + 0.5) / kPlaces));
        covered += p && inside(hull, *p) ? 1 : 0;
      }
      if (covered > 0) grid.map.at(i, j) -= static_cast<Vec3f>(radiance * (covered / double{kPlaces * kPlaces}));
    }
}

}  // namespace

SplitMap split_bright_spots(const DirectionGrid& grid) {
  SplitMap split{grid, {}, 0};
  double power = 0;
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i) power += luminance_of(grid, {i, j}) * grid.solid_angle(j);
  if (!(power > 0)) return split;

  std::vector<Spot> spots = bright_parts(grid, threshold(grid, power));
  std::erase_if(spots, [&](const Spot& s) { return s.solid_angle > kMostSolidAngle || s.power < kLeastShare * power; });
  std::stable_sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.power > b.power; });
  if (spots.size() > kMostSpots) spots.resize(kMostSpots);

  for (const Spot& spot : spots) {
    Vec3d middle{}, sum{};
    for (const Cell c : spot.cells) {
      middle += grid.center(c.column, c.row) * (luminance_of(grid, c) * grid.solid_angle(c.row));
      sum += static_cast<Vec3d>(grid.map.at(c.column, c.row)) * grid.solid_angle(c.row);
    }
    const TangentPlane plane{Frame::from_normal(normalized(-middle))};
    std::vector<Point> corners;
    for (const Cell c : spot.cells)
      for (const int k : {0, 1, 2, 3})
        if (const auto p = plane.project(grid.direction(c.column + k % 2, c.row + k / 2))) corners.push_back(*p);
    if (corners.size() < 4 * spot.cells.size()) continue;
    std::vector<Point> hull = convex_hull(std::move(corners));
    simplify(hull);
    PolygonLight light;
    for (const Point p : hull) light.vertices.push_back(plane.lift(p));
    const double covered = solid_angle(light.vertices);
    if (hull.size() < 3 || !(spot.solid_angle > kLeastFill * covered)) continue;

    const Vec3d excess = sum - mean_around(grid, spot) * spot.solid_angle;
    light.radiance = Vec3d{std::max(excess.x, 0.0), std::max(excess.y, 0.0), std::max(excess.z, 0.0)} / covered;
    take_out(split.rest, spot, plane, hull, light.radiance);
    split.share += luminance(light.radiance) * covered / power;
    split.spots.push_back(std::move(light));
  }
  return split;
}

}  // namespace steradian::environment
