// A side of a light as shadows see it: flat, or as the polygon that stands for a round light before one point.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/cpu/light_list.h"
#include "shadow/segments.h"

namespace steradian {

// Of the polygons that stand for round lights: penumbrae are then 4.5e-5 rms off (docs/shadows.md).
inline constexpr int kRoundCorners = 24;

// One side of a flat light, made ready.
struct LightSide {
  int side = 1;  // -1: behind it
  shadow::LightFrame frame;
  std::shared_ptr<const std::vector<shadow::Segment>> outline;
  std::vector<std::uint32_t> crossing;  // triangles
  std::optional<Vec3d> middle;          // a place of the light, if one is at hand
};

// side: +1 as the lit side sees it, -1 as the other does.
LightSide side_of(const PreparedPolygon& polygon, int side);

// Of a round light, which looks another way from every point; nothing where nothing of it is seen.
//
//   ellipse  outline_of_ellipse(kRoundCorners), of all ellipsoids
std::optional<LightSide> side_of_round(const PackLight& light, Vec3d position,
                                       const std::shared_ptr<const std::vector<shadow::Segment>>& ellipse);

// The frame with its outline: those of ellipsoids come without.
shadow::LightFrame with_contours(shadow::LightFrame frame);

// Whether a place of the light's plane lies on it; the frame has contours.
bool on_light(const shadow::LightFrame& frame, double x, double y);

// How much of the light's box a normal looks on.
enum class Above { all, some, none };
Above above_horizon(const shadow::LightFrame& frame, Vec3d position, Vec3d normal);

// Whether the horizon of the point's triangle may hide some of the light.
inline bool is_cut(const shadow::LightFrame& frame, const shadow::Viewpoint& at) {
  return at.geometric_normal && above_horizon(frame, at.position, *at.geometric_normal) != Above::all;
}

}  // namespace steradian
