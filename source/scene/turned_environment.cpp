#include "scene/turned_environment.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace steradian::scene {

void turn(Environment& environment, double degrees) {
  const double turns = degrees / 360 - std::floor(degrees / 360);
  if (turns == 0) return;
  Picture& map = environment.map;
  const double columns = turns * map.width, whole = std::floor(columns);
  const auto part = static_cast<float>(columns - whole);
  const int first = static_cast<int>(whole);
  std::vector<Vec3f> row(static_cast<std::size_t>(map.width));
  for (int j = 0; j < map.height; ++j) {
    for (int i = 0; i < map.width; ++i) {
      const Vec3f left = map.at((i + first) % map.width, j), right = map.at((i + first + 1) % map.width, j);
      row[static_cast<std::size_t>(i)] = part > 0 ? left * (1 - part) + right * part : left;
    }
    for (int i = 0; i < map.width; ++i) map.at(i, j) = row[static_cast<std::size_t>(i)];
  }
  if (!environment.irradiance) return;
  const double angle = 2 * std::numbers::pi * turns, c = std::cos(angle), s = std::sin(angle);
  for (Vec3d* axis : {&environment.irradiance->x, &environment.irradiance->y, &environment.irradiance->z})
    *axis = {axis->x * c + axis->z * s, axis->y, axis->z * c - axis->x * s};
}

}  // namespace steradian::scene
