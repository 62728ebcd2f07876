// The sky through openings of a room of 4 x 4 x 3 m. Its floor is z = 0, and its facade y = 4. Points lie on the floor and face up.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "bench/studies/cie171_cases.h"
#include "bench/studies/cie171_exact.h"
#include "steradian/phong.h"
#include "steradian/polygon_light.h"

namespace steradian::cie171 {
namespace {

using std::numbers::pi;

// A boundary lies within a cell of its place: 2^-40 of the half size of a face, here at most 6e-12 m. All boundaries in view are shorter
// than 100 m and further than 0.5 m: less than 100 x 6e-12 / (pi 0.25) = 7.7e-10.
constexpr double kSkyCells = 8e-10;
// A moment errs by 1e-10 pi at most (phong.h), and counts 6/(7 pi).
constexpr double kMoment = 1e-10;

const Vec3d kUp{0, 0, 1};

// Walls but the facade. The floor lies below the horizon of all points.
std::vector<ViewFactorFace> three_walls() {
  return {rectangle({0, 0, 0}, {0, 0, 3}, {4, 0, 0}), rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, 3}),
          rectangle({4, 0, 0}, {0, 0, 3}, {0, 4, 0})};
}

ViewFactorFace with_hole(ViewFactorFace face, const ViewFactorFace& hole) {
  face.holes.push_back(hole.outline);
  return face;
}

const ViewFactorFace kFacade = rectangle({0, 4, 0}, {4, 0, 0}, {0, 0, 3});
const ViewFactorFace kCeiling = rectangle({0, 0, 3}, {0, 4, 0}, {4, 0, 0});

// Part of the illuminance under the whole overcast sky that comes through an opening that nothing obstructs.
double overcast_by_moments(const ViewFactorFace& opening, Vec3d at) {
  PolygonLight light;
  light.vertices = opening.outline;
  light.two_sided = true;
  const PreparedPolygon prepared = prepare_polygon(light);
  return 3 / (7 * pi) * (polygon_irradiance(prepared, at, kUp) + 2 * double_axis_moment(prepared, at, kUp, kUp, kUp, 1));
}

void add_uniform(std::vector<Comparison>& out, const std::string& number, const std::string& geometry, double exact, double ours) {
  out.push_back({number, geometry, "`viewfactor points`", exact, ours, kSkyCells / exact});
}
void add_overcast(std::vector<Comparison>& out, const std::string& number, const std::string& geometry, double exact, double ours) {
  out.push_back({number, geometry + ", overcast", "moments", exact, ours, kMoment / exact + kRounding});
}

void add_roof(std::vector<Comparison>& out) {
  for (const double side : {1.0, 4.0}) {
    const double low = 2 - side / 2, high = 2 + side / 2;
    const ViewFactorFace opening = rectangle({low, low, 3}, {0, side, 0}, {side, 0, 0});
    std::vector<ViewFactorFace> room = three_walls();
    room.push_back(kFacade);
    if (side < 4) room.push_back(with_hole(kCeiling, opening));
    for (const Vec3d at : {Vec3d{2, 2, 0}, Vec3d{2, 0.5, 0}, Vec3d{0.5, 0.5, 0}}) {
      const Span x{low - at.x, high - at.x}, y{low - at.y, high - at.y};
      const std::string geometry = fmt::format("opening {} x {} m, point ({}, {})", side, side, at.x, at.y);
      add_uniform(out, "5.9", geometry, parallel_factor(x, y, 3), factors_at(at, kUp, room).sky);
      add_overcast(out, "5.9", geometry, overcast_through_roof(x, y, 3), overcast_by_moments(opening, at));
    }
  }
}

// The part of a facade's opening in which a point sees the sky, at a distance from the facade.
struct SkyInOpening {
  Span x, z;
  double distance;

  double uniform() const { return perpendicular_factor(z, x, distance); }
  double overcast() const { return overcast_through_wall(x, z, distance); }
  Vec3d point() const { return {2, 4 - distance, 0}; }
  double by_moments() const {
    return overcast_by_moments(rectangle({2 + x.low, 4, z.low}, {x.high - x.low, 0, 0}, {0, 0, z.high - z.low}), point());
  }
};

void add_facade(std::vector<Comparison>& out) {
  for (const bool whole : {false, true}) {
    std::vector<ViewFactorFace> room = three_walls();
    room.push_back(kCeiling);
    if (!whole) room.push_back(with_hole(kFacade, rectangle({1, 4, 1}, {0, 0, 1}, {2, 0, 0})));
    for (const double distance : {0.5, 2.0, 3.5}) {
      const SkyInOpening sky = whole ? SkyInOpening{{-2, 2}, {0, 3}, distance} : SkyInOpening{{-1, 1}, {1, 2}, distance};
      const std::string geometry = fmt::format("opening {} m, {} m away", whole ? "4 x 3" : "2 x 1", distance);
      add_uniform(out, "5.11", geometry, sky.uniform(), factors_at(sky.point(), kUp, room).sky);
      add_overcast(out, "5.11", geometry, sky.overcast(), sky.by_moments());
    }
  }
}

// mask: is seen from above `limit` of the opening (overhang) or from below it.
void add_masked(std::vector<Comparison>& out, const std::string& number, const ViewFactorFace& mask, bool overhang, double distance,
                double limit) {
  std::vector<ViewFactorFace> room = three_walls();
  room.push_back(kCeiling);
  room.push_back(with_hole(kFacade, rectangle({1, 4, 1}, {0, 0, 1}, {2, 0, 0})));
  room.push_back(mask);
  const Span below{1, limit}, above{limit, 2};
  const SkyInOpening sky{{-1, 1}, overhang ? below : above, distance}, masked{{-1, 1}, overhang ? above : below, distance};
  const exchange::SensorFactors factors = factors_at(sky.point(), kUp, room);
  const std::string geometry = fmt::format("{} m away", distance);
  add_uniform(out, number, geometry, sky.uniform(), factors.sky);
  add_uniform(out, number, geometry + ", the mask", masked.uniform(), factors.fronts.back());
  add_overcast(out, number, geometry, sky.overcast(), sky.by_moments());
}

}  // namespace

void add_daylight(std::vector<Comparison>& out) {
  add_roof(out);
  add_facade(out);
  // The edge of the overhang is 1 m outside at 2.5 m; the top of the wall across is 6 m outside at 5 m. Both are wider than all views.
  const ViewFactorFace overhang = rectangle({-4, 4, 2.5}, {0, 1, 0}, {12, 0, 0}), across = rectangle({-4, 10, 0}, {12, 0, 0}, {0, 0, 5});
  for (const double d : {1.0, 2.0, 3.0}) add_masked(out, "5.13", overhang, true, d, 2.5 * d / (d + 1));
  for (const double d : {2.0, 3.0, 3.5}) add_masked(out, "5.14", across, false, d, 5 * d / (d + 6));
}

}  // namespace steradian::cie171
