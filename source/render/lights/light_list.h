// Lights in the form that packs read, and the selection of those that can reach a tile.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/box.h"
#include "render/tile/tile.h"
#include "shapes/capsule.h"
#include "shapes/ellipse.h"
#include "shapes/pieces.h"
#include "shapes/punctual.h"
#include "steradian/scene.h"

namespace steradian {

class ProfiledLight;
class TexturedLight;
struct SolidPackLight;

struct PackLight {
  std::variant<packed::FloatPolygon, packed::FloatDisk, packed::FloatEllipsoid, packed::FloatCapsule, packed::Punctual, packed::Pieces>
      shape;
  Vec3f radiance{};                               // punctual lights: intensity (illuminance for directional)
  const AreaLight* area = nullptr;                // source of this light; null for punctual lights
  std::size_t index = 0;                          // index among all lights of the scene
  PreparedPolygon polygon;                        // the polygon in double, if it is one
  std::shared_ptr<const TexturedLight> textured;  // null without a texture; radiance is then the mean
  std::shared_ptr<const ProfiledLight> profiled;  // null without an emission profile; radiance is then the mean
  std::shared_ptr<const SolidPackLight> solid;    // a closed mesh that shines evenly; its shape are pieces (solid_lights.h)

  bool is_polygon() const { return std::holds_alternative<packed::FloatPolygon>(shape); }
  bool is_even() const { return textured == nullptr && profiled == nullptr; }  // one radiance everywhere
  bool is_area() const { return !std::holds_alternative<packed::Punctual>(shape); }
  bool is_pieces() const { return std::holds_alternative<packed::Pieces>(shape); }  // for the points of one tile (shadow/tile.h)
  bool is_round() const { return is_area() && !is_polygon() && !is_pieces(); }

  // Calls use(shape) with the shape of a round light.
  template <class Use>
  STERADIAN_INLINE void with_round(Use use) const {
    if (const auto* disk = std::get_if<packed::FloatDisk>(&shape))
      use(*disk);
    else if (const auto* ellipsoid = std::get_if<packed::FloatEllipsoid>(&shape))
      use(*ellipsoid);
    else
      use(*std::get_if<packed::FloatCapsule>(&shape));
  }
};

PackLight prepare_light(const PreparedPolygon& polygon);

// All lights of a scene, and additional area lights, which must outlive the result. Skips lights without area, power or volume.
std::vector<PackLight> prepare_lights(const Scene& scene, std::span<const AreaLight> beside = {});

// Boxes of surfaces' positions and of their normals.
struct SurfaceBounds {
  Box3f positions, normals;
};

// Lights that may reach a surface of a tile.
struct ReachingLights {
  std::vector<const PackLight*> lights;
  std::vector<std::unique_ptr<PackLight>> cut;  // lights that some pointers refer to; see with_long_edges_cut
};

// Selects lights by the bounds, against the lights' planes and the surfaces' horizons.
ReachingLights lights_reaching(std::span<const PackLight* const> lights, const SurfaceBounds& surfaces);
ReachingLights lights_reaching(std::span<const PackLight* const> lights, const SurfaceTile& tile);

// Adds corners to edges that points of the ball see under nearly half a turn. Single precision has no direction between ends that are
// almost opposite. The outline stays the same. Returns nothing if no edge is that long.
std::optional<packed::FloatPolygon> with_long_edges_cut(const PreparedPolygon& light, Vec3d center, double radius);

}  // namespace steradian
