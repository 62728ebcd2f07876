#include "bench/studies/cie171.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/studies/cie171_cases.h"
#include "bench/studies/cie171_exact.h"
#include "exchange/obstacles/scene_elements.h"
#include "steradian/view_factors.h"

namespace steradian::cie171 {
namespace {

// Behind an obstacle, a boundary lies within a cell of its place: 2^-40 of the half size of S2, 2.6e-12 m. Boundaries are shorter than 20 m
// and further than 0.5 m: less than 20 x 2.6e-12 / (pi 0.25) = 6.6e-11 of factors above 0.1.
constexpr double kCells = 1e-9;

double factor_between(const std::vector<ViewFactorFace>& faces, std::size_t from, std::size_t to) {
  ViewFactorOptions options;
  options.eps = kEps;
  const ViewFactors factors = view_factors(faces, options);
  return factors.between(from, to) / factors.areas[from];
}

const char* const kPoint = "`viewfactor points`";
const char* const kFactors = "`viewfactor`";

// 5.6. S2 lies on z = 0 and sends its light to the wall x = 0, which is 3 m high, and to the ceiling at 3 m.
void add_diffuse_reflection(std::vector<Comparison>& out) {
  for (const double side : {0.5, 4.0}) {
    const Span across{-side / 2, side / 2};
    const std::vector<ViewFactorFace> s2 = {rectangle({0, -side / 2, 0}, {side, 0, 0}, {0, side, 0})};
    for (const double z : {0.25, 1.25, 2.25})
      out.push_back({"5.6", fmt::format("S2 {} x {} m, wall at {} m", side, side, z), kPoint, perpendicular_factor({0, side}, across, z),
                     factors_at({0, 0, z}, {1, 0, 0}, s2).fronts[0], kRounding});
    for (const double x : {0.25, 2.0, 3.75})
      out.push_back({"5.6", fmt::format("S2 {} x {} m, ceiling at {} m", side, side, x), kPoint, parallel_factor({-x, side - x}, across, 3),
                     factors_at({x, 0, 3}, {0, 0, -1}, s2).fronts[0], kRounding});
  }
  const std::vector<ViewFactorFace> sides = {rectangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}), rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, 3}),
                                             rectangle({0, 0, 3}, {0, 4, 0}, {4, 0, 0})};
  out.push_back({"5.6", "S2 4 x 4 m to all of the wall", kFactors, joined_rectangles(0.75, 1), factor_between(sides, 0, 1), 2 * kEps});
  out.push_back({"5.6", "S2 4 x 4 m to all of the ceiling", kFactors, facing_rectangles(4, 4, 3), factor_between(sides, 0, 2), 2 * kEps});
}

// 5.7. An upright screen at x = 1, 1 m high, stands on S2 of 4 x 4 m. From the wall at z it hides S2 from x = 1 to z/(z - 1). It is wider
// than all views of S2. From below 1 m it hides all of S2 behind it. A plate in the middle hides a quarter of S2 from the ceiling.
void add_internal_obstruction(std::vector<Comparison>& out) {
  const std::vector<ViewFactorFace> room = {rectangle({0, -2, 0}, {4, 0, 0}, {0, 4, 0}), rectangle({1, -2, 0}, {0, 0, 1}, {0, 4, 0})};
  for (const double z : {0.5, 1.5, 2.0, 2.75}) {
    const double end = z > 1 ? std::min(z / (z - 1), 4.0) : 4.0;
    const double exact = perpendicular_factor({0, 1}, {-2, 2}, z) + perpendicular_factor({end, 4}, {-2, 2}, z);
    out.push_back({"5.7", fmt::format("screen 1 m high on S2, wall at {} m", z), kPoint, exact,
                   factors_at({0, 0, z}, {1, 0, 0}, room).fronts[0], kCells});
  }
  const std::vector<ViewFactorFace> halved = {rectangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}), rectangle({0, 0, 1.5}, {2, 0, 0}, {0, 2, 0})};
  for (const double x : {1.0, 2.0, 3.0}) {
    // Seen from the ceiling, the plate covers twice its size on S2.
    const Span hidden{-x, 4 - 2 * x};
    const double exact = parallel_factor({-x, 4 - x}, {-2, 2}, 3) - parallel_factor(hidden, {-2, 0}, 3);
    out.push_back({"5.7", fmt::format("plate 2 x 2 m half way, ceiling at {} m", x), kPoint, exact,
                   factors_at({x, 2, 3}, {0, 0, -1}, halved).fronts[0], kCells});
  }
  std::vector<ViewFactorFace> sides = halved;
  sides.push_back(rectangle({0, 0, 3}, {0, 4, 0}, {4, 0, 0}));
  out.push_back({"5.7", "plate 2 x 2 m half way, S2 to all of the ceiling", kFactors, 0.75 * facing_rectangles(4, 4, 3),
                 factor_between(sides, 0, 2), 2 * kEps});
}

}  // namespace

ViewFactorFace rectangle(Vec3d corner, Vec3d a, Vec3d b) { return {"", {corner, corner + a, corner + a + b, corner + b}}; }

exchange::SensorFactors factors_at(Vec3d position, Vec3d normal, const std::vector<ViewFactorFace>& faces) {
  const exchange::SceneElements scene = scene_elements(faces, {}, Obstruction::on, exchange::AskedFrom::points);
  return sensor_factors({position, normal}, scene.elements, scene.obstacles);
}

double Comparison::difference() const { return std::fabs(ours - exact) / exact; }

std::vector<Comparison> compare_with_cie171() {
  std::vector<Comparison> out;
  add_diffuse_reflection(out);
  add_internal_obstruction(out);
  add_closed_room(out);
  add_daylight(out);
  return out;
}

}  // namespace steradian::cie171
