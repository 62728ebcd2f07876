#include "plane/extras/extras.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "steradian/error.h"
#include "steradian/plane.h"
#include "steradian/plane_normals.h"

namespace steradian::plane {
namespace {

bool are_shares(Vec3d v) {
  const auto is_share = [](double x) { return x >= 0 && x <= 1; };
  return is_share(v.x) && is_share(v.y) && is_share(v.z);
}

void check(const PlaneBody& body, std::size_t index) {
  const std::string place = body.name.empty() ? "body " + std::to_string(index) : "body '" + body.name + "'";
  const int count = (body.transmittance ? 1 : 0) + (body.mirror ? 1 : 0) + (body.light_depth != 0 ? 1 : 0);
  if (count == 0) return;
  if (count > 1) throw Error(place, "more than one of transmittance, mirror and light depth", "give one of them");
  if (body.light)
    throw Error(place, "a light with a transmittance, a mirror or a light depth", "these are for occluders; make two shapes of it");
  if (body.transmittance && !are_shares(*body.transmittance)) throw Error(place, "the transmittance is not within 0 and 1");
  if (body.mirror && !are_shares(*body.mirror)) throw Error(place, "what the mirror sends back is not within 0 and 1");
  if (!(body.light_depth >= 0) || std::isinf(body.light_depth)) throw Error(place, "the light depth is not a positive number");
  const bool straight = body.shape == PlaneBody::Shape::polygon || body.shape == PlaneBody::Shape::polyline;
  if (body.mirror && !straight) throw Error(place, "a mirror with round edges", "make it a polygon, a rect or a line");
  if (body.light_depth > 0 && body.shape == PlaneBody::Shape::polyline)
    throw Error(place, "a light depth of a line, which has no inside", "give it to a filled shape");
}

void check(const PlaneSun& sun) {
  if (!is_finite(sun.radiance)) throw Error("sun '" + sun.name + "'", "the radiance is not finite");
  if (!std::isfinite(sun.direction)) throw Error("sun '" + sun.name + "'", "the direction is not finite");
  if (!(sun.half_width >= 0 && sun.half_width <= std::numbers::pi + 1e-9))
    throw Error("sun '" + sun.name + "'", "the half width is not within 0 and pi");
}

std::string named(const PlaneBody& body, const char* what) { return (body.name.empty() ? "a body" : "'" + body.name + "'") + what; }

}  // namespace

Matter matter_of(const PlaneBody& body) {
  if (body.transmittance) return Matter::clear;
  if (body.mirror) return Matter::mirror;
  return body.light_depth > 0 ? Matter::deep : Matter::opaque;
}

std::unique_ptr<const Extras> extras_of(const PlaneScene& scene) {
  if (!(scene.fog_density >= 0) || std::isinf(scene.fog_density))
    throw Error(scene.name, "the fog's density is not a number of at least 0");
  Extras extras;
  const auto add = [&](const std::string& name) { extras.names += (extras.names.empty() ? "" : ", ") + name; };
  for (const PlaneSun& sun : scene.suns) {
    check(sun);
    if (sun.half_width == 0) ++extras.hard_suns;
  }
  if (!scene.suns.empty()) add("a sun");
  if (scene.fog_density > 0) add("fog");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const PlaneBody& body = scene.bodies[i];
    check(body, i);
    if (body.light) extras.lights.push_back(i);
    const Matter matter = matter_of(body);
    extras.matter.push_back(matter);
    if (matter == Matter::mirror) {
      if (extras.mirrors.empty()) add(named(body, ", a mirror"));
      extras.mirrors.push_back(i);
    } else if (matter == Matter::clear) {
      if (!extras.clear) add(named(body, ", which lets light through"));
      extras.clear = true;
    } else if (matter == Matter::deep) {
      if (!extras.deep) add(named(body, ", which takes light in"));
      extras.deep = true;
    }
  }
  if (extras.names.empty()) return nullptr;
  return std::make_unique<const Extras>(std::move(extras));
}

}  // namespace steradian::plane

namespace steradian {
namespace {

// IEC 61966-2-1. The plane is below the layer of image files, which has its own version.
double srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

std::string size_of(const Picture& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); }

}  // namespace

Picture light_normals(const Picture& light, const Picture& normals, double lamp_height) {
  if (!(lamp_height >= 0 && lamp_height <= std::numbers::pi / 2 + 1e-9))
    throw Error("lamp height", "is not within 0 and a right angle", "give the angle of the lamps above the plane");
  if (normals.width != light.width || normals.height != light.height)
    throw Error("normal map", "has " + size_of(normals) + " pixels, the light " + size_of(light), "draw the light in the size of the map");
  const auto x = light.layers.find("moment_x"), y = light.layers.find("moment_y");
  if (x == light.layers.end() || y == light.layers.end()) throw Error("light", "has no first moments", "draw it with moments");
  const auto across = static_cast<float>(std::cos(lamp_height)), up = static_cast<float>(std::sin(lamp_height));
  Picture lit(light.width, light.height);
  const auto alpha = normals.layers.find("alpha");
  if (alpha != normals.layers.end()) lit.layers["alpha"] = alpha->second;
  for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
    const Vec3f n = normals.pixels[i];
    Vec3f value = (x->second[i] * n.x + y->second[i] * n.y) * across + light.pixels[i] * (n.z * up);
    value = {std::max(value.x, 0.0f), std::max(value.y, 0.0f), std::max(value.z, 0.0f)};
    lit.pixels[i] = alpha != normals.layers.end() ? value * alpha->second[i] : value;
  }
  return lit;
}

Picture normals_of_map(const Picture& map, bool encoded_srgb) {
  Picture normals(map.width, map.height);
  const auto alpha = map.layers.find("alpha");
  if (alpha != map.layers.end()) normals.layers["alpha"] = alpha->second;
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    Vec3d c = static_cast<Vec3d>(map.pixels[i]);
    const double covered = alpha != map.layers.end() ? static_cast<double>(alpha->second[i].x) : 1;
    if (covered > 0) c = c / covered;
    if (encoded_srgb) c = {srgb(c.x), srgb(c.y), srgb(c.z)};
    const Vec3d n{2 * c.x - 1, 1 - 2 * c.y, 2 * c.z - 1};
    const double size = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    normals.pixels[i] = covered > 0 && size > 1e-6 ? static_cast<Vec3f>(n / size) : Vec3f{0, 0, 1};
  }
  return normals;
}

// Textured lines: edges with a gradient that has a stop at every texel. Queries and frames integrate them in closed form.

std::vector<PlaneBody> plane_textured_line(const std::vector<Vec2d>& points, const std::vector<Vec3d>& texels,
                                           const PlaneEmission& emission) {
  double whole = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) whole += length(points[i + 1] - points[i]);
  if (!(whole > 0) || std::isinf(whole)) throw Error("textured line", "has no length", "give it two points or more");
  if (texels.empty()) throw Error("textured line", "has no texels", "give one or more colours");
  const double last = static_cast<double>(texels.size() - 1);
  const auto texel_at = [&](double place) {
    const double t = std::fmin(std::fmax(place / whole, 0), 1) * last, k = std::fmin(std::floor(t), std::fmax(last - 1, 0));
    const auto index = static_cast<std::size_t>(k);
    return last == 0 ? texels[0] : texels[index] * (1 - (t - k)) + texels[index + 1] * (t - k);
  };
  std::vector<PlaneBody> lines;
  double begin = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double size = length(points[i + 1] - points[i]), end = begin + size;
    if (!(size > 0)) continue;
    PlaneGradient gradient{points[i], points[i + 1], {{0, texel_at(begin)}}};
    for (double k = std::floor(begin / whole * last) + 1; k / last * whole < end && last > 0; ++k)
      gradient.stops.push_back({(k / last * whole - begin) / size, texels[static_cast<std::size_t>(k)]});
    gradient.stops.push_back({1, texel_at(end)});
    PlaneBody line;
    line.shape = PlaneBody::Shape::polyline;
    line.contours = {{points[i], points[i + 1]}};
    line.light = emission;
    line.light->gradient = std::move(gradient);
    lines.push_back(std::move(line));
    begin = end;
  }
  return lines;
}

}  // namespace steradian
