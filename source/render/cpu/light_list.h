// Lights as packs read them, and which of them can reach a tile.
#pragma once

#include <memory>
#include <vector>

#include "render/cpu/tile.h"
#include "steradian/scene.h"

namespace steradian {

class TexturedLight;

struct PackLight {
  enum class Kind { polygon, ellipse, ellipsoid, capsule, point, spot, directional };
  Kind kind = Kind::polygon;
  bool is_area() const { return kind == Kind::polygon || is_round(); }
  bool is_round() const { return kind == Kind::ellipse || kind == Kind::ellipsoid || kind == Kind::capsule; }
  const AreaLight* area = nullptr;  // what it was made of; null for punctual lights
  PreparedPolygon polygon;          // polygon, in double
  std::shared_ptr<const TexturedLight> textured;  // null without a texture; radiance is then the mean

  Vec3f radiance{};  // punctual lights: intensity (illuminance for directional)

  // polygon, in walk order
  std::vector<Vec3f> vertices;
  std::vector<std::size_t> contours;
  Vec3f plane_normal{}, plane_point{};  // of an ellipse too
  bool two_sided = false;

  // ellipse: centre and half axes. ellipsoid: the same, and the rows of the matrix that takes it to the unit sphere
  Vec3f center{}, axis_x{}, axis_y{}, axis_z{};
  Vec3f unit_x{}, unit_y{}, unit_z{};

  // capsule. An ellipsoid that is a ball is one, too, without length: its irradiance is the quicker
  Vec3f end_a{}, end_b{};
  float radius = 0;

  // punctual
  Vec3f position{}, direction{};
  float inverse_range2 = 0;  // 1 / range^2, 0 without a limit
  float spot_scale = 0, spot_offset = 1;
};

PackLight prepare_light(const PreparedPolygon& polygon);

// All lights of a scene. Lights without area, power or volume are left out.
std::vector<PackLight> prepare_lights(const Scene& scene);

// Lights that may reach a surface of the tile: conservative bounds of positions and normals against the light's plane
// and the surfaces' horizons.
std::vector<const PackLight*> lights_reaching(const std::vector<PackLight>& lights, const SurfaceTile& tile);

}  // namespace steradian
