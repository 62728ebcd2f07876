// AreaLight: a light of a scene with an extent: a polygon, a disk (or ellipse), a sphere (or ellipsoid), a capsule (a tube).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "steradian/polygon_light.h"
#include "steradian/texture.h"
#include "steradian/vector.h"

namespace steradian {

enum class LightShape { polygon, disk, sphere, capsule };

// Texture coordinates of a textured flat light: u = dot(p - origin, du) + u0, v likewise.
struct LightTexture {
  TextureUse use;
  Vec3d origin, du, dv;
  double u0 = 0, v0 = 0;
  Vec3d factor{1, 1, 1};  // radiance = factor times the texel
};

struct AreaLight {
  std::string name;
  LightShape shape = LightShape::polygon;
  // polygon: the light. disk: the equal-area 64-gon that stands in for it. sphere, capsule: no vertices (their outline
  // depends on the point: polygon_seen_from), but radiance and two_sided hold.
  PolygonLight polygon;
  // disk: conjugate half axes x, y (x cross y points to the lit side). sphere: half axes x, y, z of the
  // ellipsoid. capsule: the segment from center - x to center + x.
  Vec3d center, x, y, z;
  double radius = 0;                    // capsule
  std::optional<LightTexture> texture;  // polygon only; polygon.radiance is then the mean
  double power = 0;                     // luminance of the radiance times area: what max_lights ranks by

  bool is_solid() const { return shape == LightShape::sphere || shape == LightShape::capsule; }
};

// A planar ellipse: points center + x cos t + y sin t.
struct Ellipse {
  Vec3d center, x, y;
};

// A tube: all points within the radius of the segment between the ends.
struct Capsule {
  Vec3d end_a, end_b;
  double radius = 0;
};

Capsule capsule_of(const AreaLight& light);

// K-gon of the ellipse's area (all vertices pushed out by one factor), in stored order: counter-clockwise as
// seen from the side to which x cross y points. vertices >= 3.
PolygonLight equal_area_polygon(const Ellipse& ellipse, Vec3d radiance, int vertices = 64);

// The outline of an ellipsoid center + x u + y v + z w, |(u,v,w)| = 1, as seen from a point outside of it: a
// planar ellipse whose cone touches the ellipsoid; x cross y points to the point. None from inside and for an
// ellipsoid without volume.
std::optional<Ellipse> silhouette(Vec3d center, Vec3d x, Vec3d y, Vec3d z, Vec3d position);

// The flat light that a point sees in place of `light`: its polygon, for a sphere or capsule the equal-area polygon of
// its outline (no vertices from inside).
PolygonLight polygon_seen_from(const AreaLight& light, Vec3d position, int vertices = 64);

// Radiance of a textured light at a point of its plane.
Vec3d texture_radiance(const LightTexture& texture, const std::vector<Image>& images, Vec3d p);

// Rec. 709 luminance of linear RGB.
double luminance(Vec3d rgb);

}  // namespace steradian
