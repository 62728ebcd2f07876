// webgl_picture WIDTH HEIGHT ORBIT LIGHT_HEIGHT SIZE TILT INTENSITY EXPOSURE ROUGHNESS F0 EXPONENT GAIN METHOD [OTHER]: the
// picture of examples/webgl/page.html, computed by the library in double; with OTHER the difference of two methods. RGB bytes
// on standard output, the lowest row first as WebGL reads pixels.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "steradian/closed_form.h"
#include "steradian/ltc.h"
#include "steradian/phong.h"
#include "steradian/polygon_light.h"

namespace {

using namespace steradian;

constexpr double kPi = 3.14159265358979324;
const Vec3d kLightColour{1.0, 0.80, 0.58};
const Vec3d kSky{0.0006, 0.0007, 0.0010};

struct Setup {
  double orbit, height, size, tilt, intensity, exposure, roughness, f0, exponent, gain;
};

// The glossy part of the floor, for a light of radiance 1.
double gloss(const std::string& method, const Setup& s, const PreparedPolygon& light, const ShadingPoint& at) {
  Material m;
  m.f0 = m.albedo = {s.f0, s.f0, s.f0};
  if (method == "series") {
    m.brdf = Brdf::phong;
    m.exponent = s.exponent;
    return phong_radiance(light, at, m, {Method::series}).x;
  }
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = s.roughness * s.roughness;
  if (method == "ltc-compact") return ltc_radiance(LtcMethod::compact, light, at, m).x;
  if (method == "closed-form-draft") return closed_form_radiance(light, at, m, Quality::draft).x;
  if (method == "closed-form") return closed_form_radiance(light, at, m, Quality::normal).x;
  std::fprintf(stderr, "no method %s\n", method.c_str());
  std::exit(2);
}

struct Scene {
  Vec3d facing, u, w, centre;
  Setup setup;
  PreparedPolygon light;

  explicit Scene(const Setup& s) : setup(s) {
    const double tilt = s.tilt * kPi / 180.0;
    facing = {0.0, -std::cos(tilt), std::sin(tilt)};
    u = {s.size / 2, 0.0, 0.0};
    w = Vec3d{0.0, std::sin(tilt), std::cos(tilt)} * (s.size * 0.3);
    centre = {0.0, s.height, 0.0};
    PolygonLight polygon;
    polygon.vertices = {centre - u - w, centre + u - w, centre + u + w, centre - u + w};
    light = prepare_polygon(polygon);
  }

  Vec3d radiance_along(const std::string& method, Vec3d eye, Vec3d ray) const {
    double nearest = 1e30;
    Vec3d seen = kSky;
    if (ray.y < 0.0) {
      nearest = -eye.y / ray.y;
      const Vec3d p = eye + ray * nearest;
      const bool odd = std::fmod(std::fabs(std::floor(p.x) + std::floor(p.z)), 2.0) > 0.5;
      const Vec3d albedo = odd ? Vec3d{0.42, 0.42, 0.43} : Vec3d{0.62, 0.61, 0.60};
      const ShadingPoint at = {{p.x, 0.0, p.z}, {0, 1, 0}, -ray};
      Vec3d floor = albedo * (polygon_irradiance(light, at.position, at.normal) / kPi);
      if (method != "lambert") {
        const double g = gloss(method, setup, light, at);
        floor = floor * 0.3 + Vec3d{g, g, g};
      }
      seen = floor * kLightColour * setup.intensity;
    }
    const double t = dot(facing, centre - eye) / dot(facing, ray);
    const Vec3d q = eye + ray * t - centre;
    if (t > 0.0 && t < nearest && std::fabs(dot(q, u)) <= dot(u, u) && std::fabs(dot(q, w)) <= dot(w, w))
      seen = dot(facing, ray) < 0.0 ? kLightColour * setup.intensity : Vec3d{0.02, 0.02, 0.02};
    return seen;
  }
};

double display(double radiance, double exposure) {
  const double x = 1.0 - std::exp(-radiance * std::exp2(exposure));
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

Vec3d display(Vec3d radiance, double exposure) {
  return {display(radiance.x, exposure), display(radiance.y, exposure), display(radiance.z, exposure)};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 14 && argc != 15) {
    std::fprintf(stderr,
                 "usage: webgl_picture WIDTH HEIGHT ORBIT LIGHT_HEIGHT SIZE TILT INTENSITY EXPOSURE ROUGHNESS F0 EXPONENT GAIN "
                 "METHOD [OTHER]\n");
    return 2;
  }
  const int width = std::atoi(argv[1]), height = std::atoi(argv[2]);
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const Setup setup = {number(3), number(4), number(5), number(6), number(7), number(8), number(9), number(10), number(11), number(12)};
  const std::string method = argv[13], other = argc > 14 ? argv[14] : "";
  const Scene scene(setup);
  const Vec3d eye{5.2 * std::sin(setup.orbit), 1.7, 5.2 * std::cos(setup.orbit)};
  const Vec3d forward = normalized(Vec3d{0.0, 0.3, 0.0} - eye);
  const Vec3d right = normalized(cross(forward, Vec3d{0, 1, 0})), up = cross(right, forward);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double x = (2.0 * (i + 0.5) - width) / height * 0.45, y = (2.0 * (j + 0.5) - height) / height * 0.45;
      const Vec3d ray = normalized(forward + right * x + up * y);
      Vec3d c = display(scene.radiance_along(method, eye, ray), setup.exposure);
      if (!other.empty()) {
        const Vec3d d = c - display(scene.radiance_along(other, eye, ray), setup.exposure);
        c = Vec3d{std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)} * setup.gain;
      }
      for (const double channel : {c.x, c.y, c.z}) std::putchar(static_cast<int>(std::lround(255.0 * std::fmin(channel, 1.0))));
    }
}
