// webgl_picture WIDTH HEIGHT ORBIT LIGHT_HEIGHT SIZE TILT INTENSITY EXPOSURE: the picture of examples/webgl/page.html, computed
// by the library in double; RGB bytes on standard output, the lowest row first as WebGL reads pixels.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "steradian/polygon_light.h"

namespace {

using namespace steradian;

constexpr double kPi = 3.14159265358979324;
const Vec3d kLightColour{1.0, 0.80, 0.58};
const Vec3d kSky{0.0006, 0.0007, 0.0010};

struct Setup {
  double orbit, height, size, tilt, intensity, exposure;
};

struct Scene {
  Vec3d facing, u, w, centre;
  double intensity;
  PreparedPolygon light;

  explicit Scene(const Setup& s) : intensity(s.intensity) {
    const double tilt = s.tilt * kPi / 180.0;
    facing = {0.0, -std::cos(tilt), std::sin(tilt)};
    u = {s.size / 2, 0.0, 0.0};
    w = Vec3d{0.0, std::sin(tilt), std::cos(tilt)} * (s.size * 0.3);
    centre = {0.0, s.height, 0.0};
    PolygonLight polygon;
    polygon.vertices = {centre - u - w, centre + u - w, centre + u + w, centre - u + w};
    light = prepare_polygon(polygon);
  }

  Vec3d radiance_along(Vec3d eye, Vec3d ray) const {
    double nearest = 1e30;
    Vec3d seen = kSky;
    if (ray.y < 0.0) {
      nearest = -eye.y / ray.y;
      const Vec3d p = eye + ray * nearest;
      const bool odd = std::fmod(std::fabs(std::floor(p.x) + std::floor(p.z)), 2.0) > 0.5;
      const Vec3d albedo = odd ? Vec3d{0.42, 0.42, 0.43} : Vec3d{0.62, 0.61, 0.60};
      seen = albedo * kLightColour * (polygon_irradiance(light, {p.x, 0.0, p.z}, {0, 1, 0}) / kPi * intensity);
    }
    const double t = dot(facing, centre - eye) / dot(facing, ray);
    const Vec3d q = eye + ray * t - centre;
    if (t > 0.0 && t < nearest && std::fabs(dot(q, u)) <= dot(u, u) && std::fabs(dot(q, w)) <= dot(w, w))
      seen = dot(facing, ray) < 0.0 ? kLightColour * intensity : Vec3d{0.02, 0.02, 0.02};
    return seen;
  }
};

unsigned char encode(double radiance, double exposure) {
  const double x = 1.0 - std::exp(-radiance * std::exp2(exposure));
  const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<unsigned char>(std::lround(255.0 * srgb));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 9) {
    std::fprintf(stderr, "usage: webgl_picture WIDTH HEIGHT ORBIT LIGHT_HEIGHT SIZE TILT INTENSITY EXPOSURE\n");
    return 2;
  }
  const int width = std::atoi(argv[1]), height = std::atoi(argv[2]);
  const Setup setup = {std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5]),
                       std::atof(argv[6]), std::atof(argv[7]), std::atof(argv[8])};
  const Scene scene(setup);
  const Vec3d eye{5.2 * std::sin(setup.orbit), 1.7, 5.2 * std::cos(setup.orbit)};
  const Vec3d forward = normalized(Vec3d{0.0, 0.55, 0.0} - eye);
  const Vec3d right = normalized(cross(forward, Vec3d{0, 1, 0})), up = cross(right, forward);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double x = (2.0 * (i + 0.5) - width) / height * 0.45, y = (2.0 * (j + 0.5) - height) / height * 0.45;
      const Vec3d r = scene.radiance_along(eye, normalized(forward + right * x + up * y));
      for (const double channel : {r.x, r.y, r.z}) std::putchar(encode(channel, setup.exposure));
    }
}
