#include "render/shadow/few_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lattices.h"
#include "core/random.h"
#include "render/shadow/side.h"

namespace steradian {
namespace {

// Fraction of the way to a place that a ray leaves out: occluders end just before the light.
constexpr double kLeftOut = 1e-4;

// Places spread evenly over a flat light. A light that fills little of its box has fewer.
std::vector<Vec3d> places_on(const PreparedPolygon& polygon, std::size_t count) {
  constexpr std::size_t kTries = 16;  // per place
  const shadow::LightFrame frame = shadow::light_frame(polygon, 1);
  std::vector<Vec3d> places;
  for (std::size_t i = 0; i < kTries * count && places.size() < count; ++i) {
    const auto [u, v] = r2_place(static_cast<double>(i + 1));
    const double x = (2 * u - 1) * frame.half_x, y = (2 * v - 1) * frame.half_y;
    if (on_light(frame, x, y)) places.push_back(frame.to_world({x, y, 0}));
  }
  if (places.empty()) places.push_back(polygon.quarters.center);
  return places;
}

// A place on the front of an ellipsoid as seen from a point, at a place of the unit disc.
Vec3d on_front(const Ellipsoid& e, Vec3d from, double u, double v) {
  const Vec3d to = from - e.center;
  const Vec3d d = normalized(Vec3d{dot(to, e.x) / dot(e.x, e.x), dot(to, e.y) / dot(e.y, e.y), dot(to, e.z) / dot(e.z, e.z)});
  const Frame frame = Frame::from_normal(d);
  const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
  const Vec3d n = frame.to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)});
  return e.center + e.x * n.x + e.y * n.y + e.z * n.z;
}

// The same for a tube, along its axis and across.
Vec3d on_front(const Capsule& tube, Vec3d from, double u, double v) {
  const Vec3d axis = tube.end_b - tube.end_a, middle = tube.end_a + axis * u;
  const Vec3d across = cross(axis, from - middle);
  if (!(length(across) > 0)) return middle;
  const Vec3d side = normalized(across), front = normalized(cross(side, axis));
  const double s = 2 * v - 1;
  return middle + (side * s + front * std::sqrt(1 - s * s)) * tube.radius;
}

}  // namespace

FewRays::FewRays(const RayScene& rays, const std::vector<PackLight>& lights) : rays_(rays) {
  for (const PackLight& light : lights) {
    std::vector<Vec3d>& places = flat_.emplace_back();
    if (light.is_polygon())
      places = places_on(light.polygon, kPlaces);
    else if (light.area != nullptr && std::holds_alternative<Ellipse>(light.area->shape))
      places = places_on(prepare_polygon(flat_polygon(*light.area, kRoundCorners)), kPlaces);
  }
}

FewRays::SequencePlace FewRays::sequence_place(const PackLight& light, std::size_t number) const {
  const std::vector<Vec3d>& flat = flat_[light.index];
  if (!flat.empty()) return {&flat[number % flat.size()], 0, 0};
  const auto [u, v] = r2_place(static_cast<double>(number + 1));
  return {nullptr, u, v};
}

FewRays::PlaceOnLight FewRays::place_on(const PackLight& light, const shadow::Viewpoint& from, const SequencePlace& in_sequence) {
  PlaceOnLight place;
  if (in_sequence.flat != nullptr)
    place.at = *in_sequence.flat;
  else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&light.area->shape))
    place.at = on_front(*ellipsoid, from.position, in_sequence.u, in_sequence.v);
  else
    place.at = on_front(std::get<Capsule>(light.area->shape), from.position, in_sequence.u, in_sequence.v);
  const Vec3d to = place.at - from.position;
  const double cosine = dot(to, from.normal), square = dot(to, to);
  if (cosine > 0 && square > 0) place.weight = static_cast<float>(cosine / (square * square));
  return place;
}

void FewRays::find(const SurfaceTile& tile, const TilePoints& points, const PackLight& light, std::size_t count, int sample,
                   RayFractions& result) const {
  constexpr std::size_t kLanes = 16;
  constexpr std::size_t kRuns = 1 << 16;  // beginnings of the slots' own runs of the sequence
  for (std::size_t first = 0; first < kTilePixels; first += kLanes) {
    std::array<std::size_t, kLanes> begin;
    begin.fill(static_cast<std::size_t>(std::max(sample, 0)) * count);
    if (sample == kPlacesOfEach)
      for (std::size_t i = 0; i < kLanes; ++i) begin[i] = reference::Random(tile.seed * kTilePixels + first + i).bits() % kRuns;
    std::array<std::array<float, 2>, kLanes> all{}, open{};  // by half
    for (std::size_t k = 0; k < count; ++k) {
      RayScene::Sixteen rays;
      std::uint32_t asked = 0;
      std::array<float, kLanes> weight{};
      for (std::size_t i = 0; i < kLanes; ++i) {
        if (tile.material[first + i] == nullptr) continue;
        const shadow::Viewpoint& from = points.points[first + i];
        const PlaceOnLight place = place_on(light, from, sequence_place(light, begin[i] + k));
        if (!(place.weight > 0)) continue;
        weight[i] = place.weight;
        all[i][k % 2] += place.weight;
        const Vec3d to = place.at - from.position;
        if (from.geometric_normal && !(dot(to, *from.geometric_normal) > 0)) continue;
        rays.set(i, from.position, to * (1 - kLeftOut));
        asked |= 1u << i;
      }
      const std::uint32_t free = asked & ~rays_.blocked_among(rays, asked, Casters::all);
      for (std::size_t i = 0; i < kLanes; ++i)
        if ((free >> i & 1) != 0) open[i][k % 2] += weight[i];
    }
    for (std::size_t i = 0; i < kLanes; ++i) {
      const auto ratio = [](float part, float whole) { return whole > 0 ? part / whole : 1.0f; };
      result.visible[first + i] = ratio(open[i][0] + open[i][1], all[i][0] + all[i][1]);
      result.half_difference[first + i] = 0.5f * (ratio(open[i][0], all[i][0]) - ratio(open[i][1], all[i][1]));
    }
  }
}

}  // namespace steradian
