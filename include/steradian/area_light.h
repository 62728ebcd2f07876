// AreaLight: a light with an extent, a shape that shines with one radiance or with a texture.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "steradian/light_profile.h"
#include "steradian/polygon_light.h"
#include "steradian/shape.h"
#include "steradian/texture.h"
#include "steradian/vector.h"

namespace steradian {

// Texture coordinates of a textured flat light: u = dot(p - origin, du) + u0, v likewise.
struct LightTexture {
  TextureUse use;
  Vec3d origin, du, dv;
  double u0 = 0, v0 = 0;
  Vec3d factor{1, 1, 1};  // radiance = factor times the texel

  bool operator==(const LightTexture&) const = default;
};

// Light that leaves a flat light by a measured profile. Every point has `intensity` times the profile's candela over the area. From afar,
// the light equals the measured lamp; from near, it is no point.
struct LightEmission {
  std::shared_ptr<const LightProfile> profile;  // never null
  ProfileAxes axes;                             // aim: the light's normal
  Vec3d intensity{1, 1, 1};
  double area = 0;  // [m2]

  bool operator==(const LightEmission&) const = default;
};

struct AreaLight {
  Shape shape;
  Vec3d radiance{1, 1, 1};  // linear RGB, W/(m2 sr) or nits; for a line, radiance times width
  bool two_sided = false;   // for flat shapes
  std::string name{};
  std::optional<LightTexture> texture{};    // for polygons; radiance is then the mean
  double power = 0;                         // luminance of the radiance times area, by which max_lights ranks
  std::optional<LightEmission> emission{};  // for rects and disks; radiance is then the mean of all directions and both sides
  int node = -1;                            // of the file that places the light; -1: none, as for emissive meshes

  bool is_flat() const { return std::holds_alternative<Polygon>(shape) || std::holds_alternative<Ellipse>(shape); }

  bool operator==(const AreaLight&) const = default;
};

// Makes a light of a scene from a polygon.
AreaLight area_light(PolygonLight polygon);

// K-gon with the ellipse's area (all vertices pushed out by one factor), in stored order: counter-clockwise from the side to which x cross
// y points. vertices >= 3.
PolygonLight equal_area_polygon(const Ellipse& ellipse, Vec3d radiance, int vertices = 64);

// The outline of an ellipsoid from a point outside of it: a planar ellipse whose cone touches the ellipsoid; x cross y points to the point.
// None from inside and for an ellipsoid without volume.
std::optional<Ellipse> silhouette(const Ellipsoid& ellipsoid, Vec3d position);

// The flat light that replaces `light` for a point: a polygon itself; for other shapes, a polygon of so many vertices with the outline's
// area. No vertices from inside, and for a line.
PolygonLight polygon_seen_from(const AreaLight& light, Vec3d position, int vertices = 64);

// The same for a flat light, from any point. Throws Error for a shape that is not flat.
PolygonLight flat_polygon(const AreaLight& light, int vertices = 64);

// Radiance of a textured light at a point of its plane.
Vec3d texture_radiance(const LightTexture& texture, const std::vector<Image>& images, Vec3d p);

// Makes a rect (a polygon of four corners) or a disk shine by a profile. Sets its mean radiance and its power; two_sided is true if the
// profile shines to the back. The profile's plane of angle 0 is nearest to towards_x. Throws Error for other shapes.
void set_emission(AreaLight& light, std::shared_ptr<const LightProfile> profile, Vec3d towards_x, Vec3d intensity = {1, 1, 1});

// Radiance that leaves the light in a unit direction: intensity over area, over the cosine from the normal. It is unbounded towards the
// light's plane, although the emitted light is not. A flat light whose profile is not dark there has no radiance in that plane.
Vec3d emitted_radiance(const LightEmission& emission, Vec3d direction);

// Rec. 709 luminance of linear RGB.
double luminance(Vec3d rgb);

}  // namespace steradian
