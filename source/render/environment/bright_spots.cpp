#include "render/environment/bright_spots.h"

#include <algorithm>
#include <array>
#include <optional>

#include "render/environment/convex_patch.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::environment {
namespace {

constexpr double kLeastShare = 0.005;  // of the map's power: weaker spots stay in the rest
// A part is cut if it leaves more light than these in the map: a fraction of the map's power, and of its own. A part of one radiance that
// fills nine tenths of its polygon leaves a fifth.
constexpr double kLeastError = 0.0015, kLeastOwnError = 0.2;
constexpr std::size_t kMostSpots = 16, kMostLights = 48, kMostCorners = 16;

using Cell = DirectionGrid::Cell;

struct Spot {
  std::vector<Cell> cells;
  double power = 0;
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

// A convex part of a spot.
struct SpotPart {
  std::vector<Cell> cells;  // those that it covers in part are in its neighbour as well
  std::vector<Vec3d> cuts;  // great circles that bound it
  Vec3d around;             // radiance about the spot
  std::optional<ConvexPatch> patch;
  Vec3d radiance;
  double solid_angle = 0, error = INFINITY;  // error: light that it leaves in the map, if that is worth a cut
  std::vector<MapSample> samples;            // luminance above the surroundings
};

std::array<Vec3d, 4> corners_of(const DirectionGrid& grid, Cell c) {
  return {grid.direction(c.column, c.row), grid.direction(c.column + 1, c.row), grid.direction(c.column, c.row + 1),
          grid.direction(c.column + 1, c.row + 1)};
}

// Calls use(cell, fraction) for the texels that a patch covers. The fraction is measured at 8 x 8 places.
template <class Use>
void each_covered(const DirectionGrid& grid, const ConvexPatch& patch, Use use) {
  constexpr int kPlaces = 8;
  const int width = grid.map.width, height = grid.map.height;
  const double texel = std::numbers::pi / height + 2 * std::numbers::pi / width, reach = patch.reach() + texel;
  const double least = reach < std::numbers::pi ? std::cos(reach) : -1, angle = std::acos(std::clamp(patch.middle().y, -1.0, 1.0));
  const int first = std::max(static_cast<int>((angle - reach) / std::numbers::pi * height), 0);
  const int last = std::min(static_cast<int>((angle + reach) / std::numbers::pi * height), height - 1);
  for (int j = first; j <= last; ++j)
    for (int i = 0; i < width; ++i) {
      if (dot(grid.center(i, j), patch.middle()) < least) continue;
      const ConvexPatch::Coverage coverage = patch.coverage_of(corners_of(grid, {i, j}));
      if (coverage == ConvexPatch::Coverage::none) continue;
      int covered = coverage == ConvexPatch::Coverage::all ? kPlaces * kPlaces : 0;
      if (covered == 0)
        for (int k = 0; k < kPlaces * kPlaces; ++k)
          covered += patch.contains(grid.direction(i + (k % kPlaces + 0.5) / kPlaces, j + (k / kPlaces + 0.5) / kPlaces)) ? 1 : 0;
      if (covered > 0) use(Cell{i, j}, covered / double{kPlaces * kPlaces});
    }
}

// Finds the part's patch, radiance and error. A part without a patch is too wide for a plane.
void fit(const DirectionGrid& grid, SpotPart& part) {
  Vec3d middle{};
  std::vector<Vec3d> corners;
  for (const Cell c : part.cells) {
    middle += grid.center(c.column, c.row) * grid.solid_angle(c.row);
    for (const Vec3d d : corners_of(grid, c)) corners.push_back(d);
  }
  if (!(length(middle) > 0)) return;
  part.patch = ConvexPatch::around(normalized(middle), corners);
  if (!part.patch) return;
  for (const Vec3d normal : part.cuts) part.patch->cut(normal);
  part.patch->simplify(kMostCorners);
  part.error = 0;
  part.solid_angle = part.patch->solid_angle();
  if (!part.patch->has_area()) return;
  Vec3d sum{};
  double weight = 0;
  each_covered(grid, *part.patch, [&](Cell c, double covered) {
    const Vec3d excess = static_cast<Vec3d>(grid.map.at(c.column, c.row)) - part.around;
    const double solid_angle = grid.solid_angle(c.row) * covered;
    sum += excess * solid_angle;
    weight += solid_angle;
    part.samples.push_back({grid.center(c.column, c.row), solid_angle, luminance(excess)});
  });
  if (!(weight > 0)) return;
  const Vec3d mean = sum / weight;
  part.radiance = {std::max(mean.x, 0.0), std::max(mean.y, 0.0), std::max(mean.z, 0.0)};
  const double error = unevenness(part.samples);
  part.error = error > kLeastOwnError * luminance(part.radiance) * part.solid_angle ? error : 0;
}

// A part that is too wide for a plane is cut across the axis along which it is longest, among those that it has on both sides. A part of an
// octant is not too wide.
Vec3d cut_of_wide(const DirectionGrid& grid, const SpotPart& part) {
  const std::array<Vec3d, 3> axes = {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3d best = axes[0];
  double most = -1;
  for (const Vec3d axis : axes) {
    double weight = 0, sum = 0, squares = 0, low = 1, high = -1;
    for (const Cell c : part.cells) {
      const double x = dot(axis, grid.center(c.column, c.row)), solid_angle = grid.solid_angle(c.row);
      weight += solid_angle;
      sum += x * solid_angle;
      squares += x * x * solid_angle;
      low = std::min(low, x);
      high = std::max(high, x);
    }
    const double spread = squares / weight - sum / weight * (sum / weight);
    if (!(low < 0 && high > 0) || std::min(-low, high) < std::numbers::pi / grid.map.height || !(spread > most)) continue;
    most = spread;
    best = axis;
  }
  return best;
}

std::array<SpotPart, 2> halves_of(const DirectionGrid& grid, const SpotPart& part) {
  const Vec3d normal = part.patch ? best_cut(*part.patch, part.samples) : cut_of_wide(grid, part);
  std::array<SpotPart, 2> halves;
  for (const int side : {0, 1}) {
    SpotPart& half = halves[static_cast<std::size_t>(side)];
    const Vec3d inwards = side == 0 ? normal : -normal;
    half.around = part.around;
    half.cuts = part.cuts;
    half.cuts.push_back(inwards);
    for (const Cell c : part.cells) {
      const auto corners = corners_of(grid, c);
      if (std::any_of(corners.begin(), corners.end(), [&](Vec3d d) { return dot(d, inwards) > 1e-12; })) half.cells.push_back(c);
    }
    if (half.cells.empty())
      half.error = 0;
    else
      fit(grid, half);
  }
  return halves;
}

// Cuts the spots into at most kMostLights parts. The part with the largest error is cut first.
std::vector<SpotPart> parts_of(const DirectionGrid& grid, const std::vector<Spot>& spots, double least_error) {
  std::vector<SpotPart> parts;
  for (const Spot& spot : spots) {
    SpotPart part;
    part.cells = spot.cells;
    part.around = mean_around(grid, spot);
    fit(grid, part);
    parts.push_back(std::move(part));
  }
  while (!parts.empty() && parts.size() < kMostLights) {
    const auto worst = std::max_element(parts.begin(), parts.end(), [](const SpotPart& a, const SpotPart& b) { return a.error < b.error; });
    if (!(worst->error > least_error)) break;
    std::array<SpotPart, 2> halves = halves_of(grid, *worst);
    *worst = std::move(halves[0]);
    parts.push_back(std::move(halves[1]));
  }
  std::erase_if(parts, [](const SpotPart& p) { return !p.patch || !p.patch->has_area() || !(luminance(p.radiance) > 0); });
  return parts;
}

// Takes the part's light out of the map, exactly as much as its polygon sends.
void take_out(DirectionGrid& grid, const SpotPart& part) {
  double sum = 0;
  for (const MapSample& s : part.samples) sum += s.solid_angle;
  const Vec3d radiance = part.radiance * (part.solid_angle / sum);
  each_covered(grid, *part.patch, [&](Cell c, double covered) { grid.map.at(c.column, c.row) -= static_cast<Vec3f>(radiance * covered); });
}

}  // namespace

SplitMap split_bright_spots(const DirectionGrid& grid) {
  SplitMap split{grid, {}, 0};
  double power = 0;
  for (int j = 0; j < grid.map.height; ++j)
    for (int i = 0; i < grid.map.width; ++i) power += luminance_of(grid, {i, j}) * grid.solid_angle(j);
  if (!(power > 0)) return split;

  std::vector<Spot> spots = bright_parts(grid, threshold(grid, power));
  std::erase_if(spots, [&](const Spot& s) { return s.power < kLeastShare * power; });
  std::stable_sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.power > b.power; });
  if (spots.size() > kMostSpots) spots.resize(kMostSpots);

  for (const SpotPart& part : parts_of(grid, spots, kLeastError * power)) {
    take_out(split.rest, part);
    split.share += luminance(part.radiance) * part.solid_angle / power;
    split.spots.push_back(part.patch->light(part.radiance));
  }
  return split;
}

}  // namespace steradian::environment
