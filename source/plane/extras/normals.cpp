#include "steradian/plane_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "steradian/error.h"

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

}  // namespace steradian
