#include "plane/stage/light_field.h"

#include <cmath>
#include <numbers>

#include "plane/exact/outline.h"
#include "plane/exact/random.h"

namespace steradian::plane {

PlaneScene make_light_field(const LightField& field, std::uint64_t seed) {
  SceneRandom random(seed);
  PlaneScene scene;
  scene.width = field.width;
  scene.height = field.height;
  for (int i = 0; i < field.boxes; ++i) {
    const Vec2d c{random.uniform(0, scene.width), random.uniform(0, scene.height)};
    const double a = random.uniform(0, 2 * std::numbers::pi), hx = field.size * random.uniform(0.4, 1.2),
                 hy = field.size * random.uniform(0.4, 1.2);
    const Vec2d x = Vec2d{std::cos(a), std::sin(a)} * hx, y = Vec2d{-std::sin(a), std::cos(a)} * hy;
    scene.bodies.push_back(plane_polygon({c - x - y, c + x - y, c + x + y, c - x + y}));
  }
  for (int i = 0; i < field.lights;) {
    const Vec2d c{random.uniform(0, scene.width), random.uniform(0, scene.height)};
    bool free = true;
    for (int k = 0; k < field.boxes && free; ++k) free = !contains(scene.bodies[static_cast<std::size_t>(k)], c);
    if (!free) continue;
    scene.bodies.push_back(plane_circle(c, field.radius));
    PlaneEmission& light = scene.bodies.back().light.emplace();
    light.radiance = {random.uniform(0.4, 1), random.uniform(0.4, 1), random.uniform(0.4, 1)};
    light.range = field.range;
    ++i;
  }
  return scene;
}

}  // namespace steradian::plane
