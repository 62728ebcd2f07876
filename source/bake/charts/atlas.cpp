#include "bake/charts/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "steradian/error.h"

namespace steradian::bake {
namespace {

int cells_for(double texels) { return static_cast<int>(std::clamp(std::ceil(texels - 1e-6), 1.0, 2.0 * kLargestMap)); }

// The texels around a box of a plane that is divided into texels as a whole. Charts of one plane with doors between them have the same
// texels beside a door, so that both sides can show the same light there.
struct DoorTexels {
  double x = 0, y = 0;  // centre of the first
  int width = 0, height = 0;
};
DoorTexels texels_of(const Box2d& box, double texels) {
  const auto first = [&](double low) { return std::floor(low * texels - kInside); };
  const auto number = [&](double low, double high) {
    return static_cast<int>(std::clamp(std::ceil(high * texels + kInside) - first(low), 1.0, 2.0 * kLargestMap)) + 1;
  };
  return {first(box.low.x), first(box.low.y), number(box.low.x, box.high.x), number(box.low.y, box.high.y)};
}

template <class Moved>
void move(Chart& chart, Moved moved) {
  for (ChartTriangle& t : chart.triangles)
    for (Vec2d& p : t.at) p = moved(p);
  for (ChartPiece& piece : chart.pieces)
    for (Vec2d& p : piece.outline) p = moved(p);
  for (ChartDoor& door : chart.doors)
    for (Vec2d& p : door.ends) p = moved(p);
}

}  // namespace

MapSize place_charts(const Scene& scene, std::vector<Chart>& charts, double texels, const std::string& place, const std::string& advice) {
  const auto refuse = [&](const std::string& where, double width, double height) {
    throw Error(where,
                "the map would have " + std::to_string(static_cast<long long>(width)) + " x " +
                    std::to_string(static_cast<long long>(height)) + " texels, the most is " + std::to_string(kLargestMap) + " a side",
                advice);
  };
  double area = 0;
  int widest = 0;
  std::uint32_t of_widest = 0;  // its mesh
  const auto count = [&](const Chart& chart) {
    area += static_cast<double>(chart.width) * chart.height;
    if (chart.width > widest) widest = chart.width, of_widest = chart.mesh;
  };
  for (Chart& chart : charts) {
    const Box2d box = chart.box();
    Vec2d size = box.size();
    if (!chart.doors.empty()) {
      const DoorTexels all = texels_of(box, texels);
      chart.width = all.width;
      chart.height = all.height;
      count(chart);
      continue;
    }
    if (size.y > size.x) {  // lying charts pack better
      move(chart, [](Vec2d p) { return Vec2d{p.y, -p.x}; });
      std::swap(size.x, size.y);
    }
    chart.width = (chart.is_covered ? 1 : cells_for(size.x * texels)) + 1;
    chart.height = (chart.is_covered ? 1 : cells_for(size.y * texels)) + 1;
    count(chart);
  }
  if (widest > kLargestMap)
    refuse(place + ": " + name_of(scene.meshes[of_widest], of_widest), std::max<double>(widest, std::sqrt(area)), std::sqrt(area));
  if (area > static_cast<double>(kLargestMap) * kLargestMap) refuse(place, std::sqrt(area), std::sqrt(area));
  // Shelves: the highest charts first, each behind the last one, or on a new shelf.
  std::vector<std::uint32_t> order(charts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(charts[a].height, charts[a].width) > std::pair(charts[b].height, charts[b].width);
  });
  const int wanted = (static_cast<int>(std::ceil(std::sqrt(area) * 1.05)) + 3) / 4 * 4;
  MapSize map{std::clamp(wanted, std::max(widest, 4), kLargestMap), 0};
  int x = 0, shelf = 0;
  for (const std::uint32_t i : order) {
    Chart& chart = charts[i];
    if (x + chart.width > map.width) x = 0, shelf = map.height;
    chart.x = x;
    chart.y = shelf;
    x += chart.width;
    map.height = std::max(map.height, shelf + chart.height);
    if (map.height > kLargestMap) refuse(place, map.width, map.height);
  }
  map.height = std::max((map.height + 3) / 4 * 4, 4);
  if (map.height > kLargestMap) refuse(place, map.width, map.height);
  for (Chart& chart : charts) {
    const Box2d box = chart.box();
    if (!chart.doors.empty()) {
      const DoorTexels all = texels_of(box, texels);
      move(chart, [&](Vec2d p) { return Vec2d{chart.x + 0.5 + p.x * texels - all.x, chart.y + 0.5 + p.y * texels - all.y}; });
      continue;
    }
    const auto scale = [](int cells, double size) { return size > 0 ? (cells - 2 * kInside) / size : 1; };
    const double sx = scale(chart.width - 1, box.size().x), sy = scale(chart.height - 1, box.size().y);
    const Vec2d at{chart.x + 0.5 + kInside, chart.y + 0.5 + kInside};
    const auto placed = [&](Vec2d p) { return Vec2d{at.x + (p.x - box.low.x) * sx, at.y + (p.y - box.low.y) * sy}; };
    move(chart, placed);
  }
  return map;
}

}  // namespace steradian::bake
