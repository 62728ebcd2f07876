#include "render/shadow/side.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "shadow/edges/edge_arrays.h"
#include "shadow/region/arrangement.h"
#include "shadow/region/round_light.h"

namespace steradian {

using shadow::LightFrame;

bool on_light(const LightFrame& frame, double x, double y) {
  bool inside = false;
  for (const auto& c : frame.contours)
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
      if ((c[i].y > y) != (c[j].y > y) && x < (c[j].x - c[i].x) * (y - c[i].y) / (c[j].y - c[i].y) + c[i].x) inside = !inside;
  return inside;
}

LightFrame with_contours(LightFrame frame) {
  if (frame.contours.empty()) frame.contours = {shadow::contour_of_ellipse(frame, kRoundCorners)};
  return frame;
}

Above above_horizon(const LightFrame& frame, Vec3d position, Vec3d normal) {
  const double middle = dot(frame.origin - position, normal);
  const double reach = std::fabs(dot(frame.axes.x, normal)) * frame.box_x + std::fabs(dot(frame.axes.y, normal)) * frame.box_y;
  return middle - reach > 0 ? Above::all : middle + reach > 0 ? Above::some : Above::none;
}

LightSide side_of(const PreparedPolygon& polygon, int side) {
  LightSide result;
  result.side = side;
  result.frame = shadow::light_frame(polygon, side);
  result.outline = std::make_shared<const std::vector<shadow::Segment>>(shadow::outline_segments(result.frame));
  if (on_light(result.frame, 0, 0)) result.middle = result.frame.origin;
  return result;
}

std::optional<LightSide> side_of_round(const PackLight& light, const Body& body, Vec3d position,
                                       const std::shared_ptr<const std::vector<shadow::Segment>>& ellipse) {
  if (std::holds_alternative<Capsule>(light.area->shape)) {
    const PreparedPolygon polygon = shadow::polygon_of_round(*light.area, position, kRoundCorners);
    if (polygon.side_of(position) <= 0) return {};
    LightSide side = side_of(polygon, 1);
    side.frame.body = &body;
    return side;
  }
  std::optional<LightFrame> frame = shadow::frame_of_ellipsoid(std::get<Ellipsoid>(light.area->shape), position, kRoundCorners);
  if (!frame) return {};
  LightSide result;
  result.frame = std::move(*frame);
  result.frame.body = &body;
  result.outline = ellipse;
  result.middle = result.frame.origin;
  return result;
}

std::vector<LightSide> sides_of_tube(const Capsule& tube, const Body& body, Vec3d position) {
  std::vector<LightSide> sides;
  for (const PreparedPolygon& part : shadow::parts_of_tube(tube, {1, 1, 1}, position, kRoundCorners)) {
    if (part.side_of(position) <= 0) continue;
    sides.push_back(side_of(part, 1));
    sides.back().frame.body = &body;
  }
  return sides;
}

namespace {

using shadow::LightFrame;
using shadow::Viewpoint;

constexpr int kShareRays = 64;

// Visible fraction of a light by stratified rays, weighted by each place's light on a diffuse surface. It is the open part of the places
// that count. counts(x, y) is in the light's frame. open(to) tests the way there, which ends just before the light.
template <class Counts, class Open>
double stratified_share(const LightFrame& frame, const Viewpoint& at, Counts counts, Open open) {
  constexpr int kSide = 8;
  static_assert(kSide * kSide == kShareRays);
  reference::Random random(at.seed);
  double all = 0, arrives = 0;
  for (int i = 0; i < kShareRays; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const double x = (2 * (i % kSide + u) / kSide - 1) * frame.half_x;
    const double y = (2 * (i / kSide + v) / kSide - 1) * frame.half_y;
    if (!counts(x, y)) continue;
    const Vec3d place = frame.to_world({x, y, 0}), to = place - at.position;
    const double cosine = dot(to, at.normal);
    if (!(cosine > 0)) continue;
    const double d2 = dot(to, to), weight = cosine / (d2 * d2);
    all += weight;
    if (open(frame.way(at.position, place))) arrives += weight;
  }
  return all > 0 ? arrives / all : 1.0;
}

template <class Counts>
double share_past_cut_outs_of(const RayScene& rays, const LightFrame& frame, const Viewpoint& at, Counts counts) {
  return stratified_share(frame, at, counts, [&](Vec3d to) { return !rays.between(at.position, at.position + to, Casters::cut_outs); });
}

}  // namespace

double share_by_rays(const RayScene& rays, const LightSide& side, const Viewpoint& at) {
  const LightFrame frame = with_contours(side.frame);
  return stratified_share(
      frame, at, [&](double x, double y) { return on_light(frame, x, y); },
      [&](Vec3d to) {
        if (at.geometric_normal && !(dot(to, *at.geometric_normal) > 0)) return false;
        return !rays.between(at.position, at.position + to, Casters::all);
      });
}

double share_past_cut_outs(const RayScene& rays, const LightSide& side, const Viewpoint& at) {
  const LightFrame frame = with_contours(side.frame);
  return share_past_cut_outs_of(rays, frame, at, [&](double x, double y) { return on_light(frame, x, y); });
}

double share_past_cut_outs(const RayScene& rays, const LightSide& side, const Viewpoint& at, const shadow::SegmentSet& segments,
                           const shadow::VisibleRegion& seen) {
  const LightFrame& frame = side.frame;
  const double scale_x = shadow::kCells / frame.box_x, scale_y = shadow::kCells / frame.box_y;
  return share_past_cut_outs_of(rays, frame, at,
                                [&](double x, double y) { return count_at(segments, x * scale_x, y * scale_y) <= seen.level; });
}

}  // namespace steradian
