// A side of a light as shadows use it, and the fraction of it that rays find visible.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/lights/light_list.h"
#include "render/surface/ray_scene.h"
#include "shadow/edges/segments.h"
#include "shadow/region/visible.h"

namespace steradian {

// A side of a light as shadows see it: that of a flat light, or the polygon that stands for a round light seen from one point.

// Number of corners of polygons that stand for round lights. Penumbrae are then 4.5e-5 rms off.
inline constexpr int kRoundCorners = 24;

// One prepared side of a flat light.
struct LightSide {
  int side = 1;  // -1: the back
  shadow::LightFrame frame;
  std::shared_ptr<const std::vector<shadow::Segment>> outline;
  std::vector<std::uint32_t> crossing;  // triangles that cross the light's plane
  std::optional<Vec3d> middle;          // a place on the light, if one is at hand
};

// side: +1 for the lit side, -1 for the other.
LightSide side_of(const PreparedPolygon& polygon, int side);

// The side of a round light, which differs from point to point; empty if the point sees nothing of the light.
//
//   ellipse  outline_of_ellipse(kRoundCorners), shared by all ellipsoids
//   body     of the light
std::optional<LightSide> side_of_round(const PackLight& light, const Body& body, Vec3d position,
                                       const std::shared_ptr<const std::vector<shadow::Segment>>& ellipse);

// The flat parts of a tube for one point (shadow::parts_of_tube), as sides.
std::vector<LightSide> sides_of_tube(const Capsule& tube, const Body& body, Vec3d position);

// Adds the outline to a frame: frames of ellipsoids come without one.
shadow::LightFrame with_contours(shadow::LightFrame frame);

// True if a place in the light's plane lies on the light. The frame must have contours.
bool on_light(const shadow::LightFrame& frame, double x, double y);

// Part of the light's box that lies above a normal's horizon.
enum class Above { all, some, none };
Above above_horizon(const shadow::LightFrame& frame, Vec3d position, Vec3d normal);

// True if the horizon of the point's triangle may occlude some of the light.
inline bool is_cut(const shadow::LightFrame& frame, const shadow::Viewpoint& at) {
  return at.geometric_normal && above_horizon(frame, at.position, *at.geometric_normal) != Above::all;
}

// Fractions of a light by stratified rays: where there are too many edges to arrange, and for light through cut-outs.

// Visible fraction of the light above the point's horizons, past all occluders.
double share_by_rays(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at);

// Fraction of the light that passes cut-outs. The second function takes only the part of the light that `seen` found in `segments`.
double share_past_cut_outs(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at);
double share_past_cut_outs(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at, const shadow::SegmentSet& segments,
                           const shadow::VisibleRegion& seen);

}  // namespace steradian
