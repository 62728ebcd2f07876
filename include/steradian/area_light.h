// AreaLight: a light with an extent: a shape that shines with one radiance, or with a texture.
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
};

// Light that leaves a flat light by a measured profile: every point of it has `intensity` times the profile's candela over the area, so
// that from afar the light is the lamp that was measured, and near to it no point.
struct LightEmission {
  std::shared_ptr<const LightProfile> profile;  // never null
  ProfileAxes axes;                             // aim: the light's normal
  Vec3d intensity{1, 1, 1};
  double area = 0;  // [m2]
};

struct AreaLight {
  Shape shape;
  Vec3d radiance{1, 1, 1};  // linear RGB, W/(m2 sr) or nits; of a line, radiance times width
  bool two_sided = false;   // of flat shapes
  std::string name{};
  std::optional<LightTexture> texture{};    // of polygons; radiance is then the mean
  double power = 0;                         // luminance of the radiance times area: what max_lights ranks by
  std::optional<LightEmission> emission{};  // of rects and disks; radiance is then the mean of all directions and both sides

  bool is_flat() const { return std::holds_alternative<Polygon>(shape) || std::holds_alternative<Ellipse>(shape); }
};

// A polygon as a light of a scene.
AreaLight area_light(PolygonLight polygon);

// K-gon of the ellipse's area (all vertices pushed out by one factor), in stored order: counter-clockwise as
// seen from the side to which x cross y points. vertices >= 3.
PolygonLight equal_area_polygon(const Ellipse& ellipse, Vec3d radiance, int vertices = 64);

// The outline of an ellipsoid as seen from a point outside of it: a
// planar ellipse whose cone touches the ellipsoid; x cross y points to the point. None from inside and for an
// ellipsoid without volume.
std::optional<Ellipse> silhouette(const Ellipsoid& ellipsoid, Vec3d position);

// The flat light that a point sees in place of `light`: a polygon itself, of other shapes a polygon of so many vertices that
// has the outline's area. No vertices from inside, and for a line.
PolygonLight polygon_seen_from(const AreaLight& light, Vec3d position, int vertices = 64);

// The same of a flat light, whoever sees it. Throws Error for a shape that is not flat.
PolygonLight flat_polygon(const AreaLight& light, int vertices = 64);

// Radiance of a textured light at a point of its plane.
Vec3d texture_radiance(const LightTexture& texture, const std::vector<Image>& images, Vec3d p);

// Has a rect (a polygon of four corners) or a disk shine by a profile. Sets its mean radiance, its power, and two_sided by whether the
// profile shines to the back. The profile's plane of angle 0 is nearest to towards_x. Throws Error for other shapes.
void set_emission(AreaLight& light, std::shared_ptr<const LightProfile> profile, Vec3d towards_x, Vec3d intensity = {1, 1, 1});

// Radiance that leaves the light in a unit direction: intensity over area, over the cosine from the normal. Without bound towards the
// light's plane, where what it sends is not: a flat light whose profile is not dark there has no radiance.
Vec3d emitted_radiance(const LightEmission& emission, Vec3d direction);

// Rec. 709 luminance of linear RGB.
double luminance(Vec3d rgb);

}  // namespace steradian
