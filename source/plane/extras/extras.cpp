#include "plane/extras/extras.h"

#include <cmath>
#include <numbers>

#include "steradian/error.h"

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
