#include "steradian/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/codecs.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"

namespace steradian {
namespace {

// The largest value of a map. The sun's disc has 2e9 nits.
constexpr float kMostRadiance = 1e12f;

// Replaces the invalid values that other programs write into maps by valid radiances; returns the number of replacements.
std::size_t repair(Picture& map) {
  float largest = 0;
  const auto each = [&](auto use) {
    for (Vec3f& p : map.pixels)
      for (float* x : {&p.x, &p.y, &p.z}) use(*x);
  };
  each([&](const float& x) {
    if (std::isfinite(x)) largest = std::max(largest, std::min(x, kMostRadiance));
  });
  std::size_t repaired = 0;
  each([&](float& x) {
    if (x >= 0 && x <= largest) return;
    x = x > largest ? largest : 0;
    ++repaired;
  });
  return repaired;
}

double smooth_share(double x) { return std::clamp(x, 0.0, 1.0); }

// Relative luminance of the clear sky. The arguments are the cosines of the angles from the zenith and from the sun. Source: Kittler,
// Perez, Darula, "A set of standard skies", 1998; CIE S 011 type 12.
double clear_sky_luminance(double cos_zenith, double cos_from_sun) {
  constexpr double a = -1, b = -0.32, c = 10, d = -3, e = 0.45;
  const double gradation = 1 + a * std::exp(b / std::max(cos_zenith, 0.01));
  const double angle = std::acos(std::clamp(cos_from_sun, -1.0, 1.0));
  return gradation * (1 + c * (std::exp(d * angle) - std::exp(d * std::numbers::pi / 2)) + e * cos_from_sun * cos_from_sun);
}

// Sky colour of luminance 1, whiter towards the horizon. The hues are a choice, not a measurement.
Vec3d sky_colour(double cos_zenith) {
  const Vec3d zenith{0.30, 0.55, 1.15}, horizon{0.80, 0.92, 1.10};
  const double t = std::pow(1 - smooth_share(cos_zenith), 3.0);
  const Vec3d colour = zenith * (1 - t) + horizon * t;
  return colour / luminance(colour);
}

}  // namespace

Vec3d IrradianceCoefficients::at(Vec3d normal) const {
  const double nx = dot(normal, x), ny = dot(normal, y), nz = dot(normal, z);
  const double k0 = std::sqrt(1 / (4 * std::numbers::pi)), k1 = std::sqrt(3 / (4 * std::numbers::pi)),
               k2 = std::sqrt(15 / (4 * std::numbers::pi));
  const double harmonics[9] = {k0,
                               k1 * ny,
                               k1 * nz,
                               k1 * nx,
                               k2 * nx * ny,
                               k2 * ny * nz,
                               k2 / std::sqrt(12.0) * (3 * nz * nz - 1),
                               k2 * nx * nz,
                               k2 / 2 * (nx * nx - ny * ny)};
  Vec3d sum{};
  for (std::size_t i = 0; i < 9; ++i) sum += rgb[i] * harmonics[i];
  return sum;
}

MapPlace place_of(Vec3d d) {
  return {0.5 + std::atan2(d.x, -d.z) / (2 * std::numbers::pi), std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi};
}

Vec3d direction_of(MapPlace place) {
  const double phi = 2 * std::numbers::pi * (place.u - 0.5), theta = std::numbers::pi * place.v;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

Vec3f radiance_from(const Picture& map, Vec3d direction) {
  const MapPlace place = place_of(direction);
  const double x = place.u * map.width - 0.5, y = std::clamp(place.v * map.height - 0.5, 0.0, map.height - 1.0);
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const int left = (static_cast<int>(x0) + map.width) % map.width, right = (left + 1) % map.width;
  const int up = static_cast<int>(y0), down = std::min(up + 1, map.height - 1);
  const auto row = [&](int j) { return map.at(left, j) * (1 - fx) + map.at(right, j) * fx; };
  return row(up) * (1 - fy) + row(down) * fy;
}

Environment white_environment() {
  Environment white{"white", Picture(4, 2), {}, 0};
  for (Vec3f& p : white.map.pixels) p = {1, 1, 1};
  return white;
}

Environment clear_sky() {
  Environment sky{"sky", Picture(512, 256), {}, 0};
  const Vec3d sun = normalized(Vec3d{-0.4, 0.8, 0.6});
  // A clear sky gives the ground about a sixth of the sun's irradiance, and --light sun gives the ground pi.
  constexpr double kIrradiance = std::numbers::pi / 6, kGroundAlbedo = 0.2;
  double irradiance = 0;
  const auto texel = [&](int i, int j) { return direction_of({(i + 0.5) / sky.map.width, (j + 0.5) / sky.map.height}); };
  for (int j = 0; j < sky.map.height / 2; ++j)
    for (int i = 0; i < sky.map.width; ++i) {
      const Vec3d d = texel(i, j);
      const double l = clear_sky_luminance(d.y, dot(d, sun)), top = std::numbers::pi * j / sky.map.height,
                   bottom = std::numbers::pi * (j + 1) / sky.map.height;
      sky.map.at(i, j) = static_cast<Vec3f>(sky_colour(d.y) * l);
      irradiance += l * d.y * (std::cos(top) - std::cos(bottom)) * 2 * std::numbers::pi / sky.map.width;
    }
  const auto scale = static_cast<float>(kIrradiance / irradiance);
  const auto ground = static_cast<float>(kIrradiance * kGroundAlbedo / std::numbers::pi);
  for (int j = 0; j < sky.map.height; ++j)
    for (int i = 0; i < sky.map.width; ++i) {
      if (j < sky.map.height / 2)
        sky.map.at(i, j) *= scale;
      else
        sky.map.at(i, j) = {ground, ground, ground};
    }
  return sky;
}

Environment load_environment(const std::string& name, const Limits& limits) {
  if (name == "white") return white_environment();
  if (name == "sky") return clear_sky();
  Environment environment{name, read_picture(name, limits), {}, 0};
  environment.map.layers.clear();
  const auto finite = [](Vec3f p) { return std::isfinite(p.x) || std::isfinite(p.y) || std::isfinite(p.z); };
  if (std::none_of(environment.map.pixels.begin(), environment.map.pixels.end(), finite))
    throw Error(name, "the environment has no finite value", "save it again");
  environment.repaired = repair(environment.map);
  return environment;
}

}  // namespace steradian
