// Round lights that geometry enters, or that stand close to it: families of random cases against rays to the light's true surface.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/random.h"
#include "eval/answer.h"
#include "night.h"

namespace steradian::eval::entered_lights_test {
namespace {

using nlohmann::json;
using reference::Random;

json answer(const json& query) {
  static QueryReader reader;
  std::string line = query.dump(), out;
  const std::size_t size = line.size();
  line.append(kQueryPadding, ' ');
  answer_line(reader, {line.data(), size}, out);
  return json::parse(out);
}

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }
json vector(double x, double y, double z) { return {x, y, z}; }

// A square in the plane y = height, of two triangles.
void add_ceiling(json& triangles, double height, double half) {
  const json a = vector(-half, height, -half), b = vector(half, height, -half), c = vector(half, height, half),
             d = vector(-half, height, half);
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

// A plate across x, from y = low to high.
void add_wall(json& triangles, double x, double low, double high, double half) {
  const json a = vector(x, low, -half), b = vector(x, high, -half), c = vector(x, high, half), d = vector(x, low, half);
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

struct Case {
  json light, occluders = json::array();
};

// A ball half sunk in a ceiling, at any depth.
Case sunk_ball(Random& random) {
  Case c;
  const double radius = between(random, 0.05, 0.5), height = 2 + between(random, -0.9, 0.9) * radius;
  c.light = {{"type", "sphere"}, {"center", vector(between(random, -1, 1), height, between(random, -1, 1))}, {"radius", radius}};
  add_ceiling(c.occluders, 2, 4);
  return c;
}

Case sunk_ellipsoid(Random& random) {
  Case c;
  const double x = between(random, 0.1, 0.5), y = between(random, 0.1, 0.4), tilt = between(random, -0.2, 0.2);
  c.light = {{"type", "ellipsoid"},
             {"center", vector(0.2, 2 + between(random, -0.7, 0.7) * y, 0)},
             {"x", vector(x, tilt * x, 0)},
             {"y", vector(-tilt * y, y, 0)},
             {"z", vector(0, 0, between(random, 0.1, 0.5))}};
  add_ceiling(c.occluders, 2, 4);
  return c;
}

// A tube through a wall, or along a board.
Case tube_in_wall(Random& random) {
  Case c;
  const double radius = between(random, 0.02, 0.2), y = between(random, 1, 2);
  c.light = {{"type", "capsule"},
             {"ends", {vector(-between(random, 0.2, 1), y, 0.1), vector(between(random, 0.2, 1), y + 0.1, 0)}},
             {"radius", radius}};
  add_wall(c.occluders, between(random, -0.3, 0.3), 0.5, 3, between(random, 0.1, 1));
  add_ceiling(c.occluders, y + between(random, -0.8, 2) * radius, 2);
  return c;
}

// A bulb in its socket: a cup of triangles around its lower half, that begins inside it.
Case bulb_in_socket(Random& random) {
  Case c;
  const double radius = between(random, 0.05, 0.2), deep = between(random, 0.3, 0.9) * radius, rim = between(random, 0.4, 1.3) * radius;
  c.light = {{"type", "sphere"}, {"center", vector(0, 1.5, 0)}, {"radius", radius}};
  constexpr int kSides = 12;
  for (int k = 0; k < kSides; ++k) {
    const double a = 2 * M_PI * k / kSides, b = 2 * M_PI * (k + 1) / kSides;
    const auto at = [&](double angle, double r, double y) { return vector(r * std::cos(angle), 1.5 + y, r * std::sin(angle)); };
    c.occluders.push_back({at(a, rim, 0.2 * radius), at(b, rim, 0.2 * radius), at(b, 0.3 * radius, deep)});
    c.occluders.push_back({at(a, rim, 0.2 * radius), at(b, 0.3 * radius, deep), at(a, 0.3 * radius, deep)});
  }
  return c;
}

// A shelf beyond a tube's end, seen from beyond that end, too.
Case shelf_beyond_tube(Random& random) {
  Case c;
  c.light = {{"type", "capsule"},
             {"ends", {vector(0, 2.4, 0), vector(between(random, -0.1, 0.1), 1.4, 0)}},
             {"radius", between(random, 0.02, 0.1)}};
  add_ceiling(c.occluders, between(random, 1.05, 1.35), between(random, 0.02, 0.3));
  return c;
}

struct Family {
  const char* name;
  Case (*make)(Random&);
};

TEST(EnteredLights, AgreeWithRaysToTheirSurface) {
  const Family families[] = {{"sunk balls", sunk_ball},
                             {"sunk ellipsoids", sunk_ellipsoid},
                             {"tubes in walls", tube_in_wall},
                             {"bulbs in sockets", bulb_in_socket},
                             {"shelves beyond tubes", shelf_beyond_tube}};
  const int count = test::by_day_or_night(12, 200);
  for (const Family& family : families) {
    Random random(7, static_cast<std::uint64_t>(&family - families));
    int tried = 0, beyond = 0;
    double worst = 0;
    for (int i = 0; i < count; ++i) {
      const Case c = family.make(random);
      json query = {{"light", c.light},
                    {"occluders", c.occluders},
                    {"position", vector(between(random, -1.5, 1.5), between(random, -0.2, 0.5), between(random, -1.5, 1.5))},
                    {"normal", vector(between(random, -0.3, 0.3), 1, between(random, -0.3, 0.3))},
                    {"view", vector(0.3, 1, 0.1)},
                    {"material", {{"brdf", "lambert"}, {"albedo", 1}}}};
      query["method"] = "sampled";
      query["spp"] = 20000;
      const json rays = answer(query);
      ASSERT_TRUE(rays.contains("radiance")) << rays << query;
      query["method"] = "exact";
      const json exact = answer(query);
      ASSERT_TRUE(exact.contains("radiance")) << exact << query;
      json open = query;
      open.erase("occluders");
      const double whole = answer(open)["radiance"][1], expected = rays["radiance"][1], sigma = rays["standard_error"];
      const double off = std::fabs(exact["radiance"][1].get<double>() - expected);
      ++tried;
      // The polygon of 24 corners that is a round light in penumbrae: at most 1.4e-3 of the whole.
      const double bar = 5 * sigma + 1.4e-3 * whole;
      worst = std::max(worst, off / bar);
      if (off > bar) {
        ++beyond;
        ADD_FAILURE() << family.name << " " << i << ": " << exact["radiance"][1] << " for " << expected << " +- " << sigma << " of "
                      << whole << "\n"
                      << query;
      }
    }
    std::cout << "[ measured ] " << family.name << ": " << tried << " tried, " << beyond << " beyond, worst " << worst << " of the bar\n";
  }
}

}  // namespace
}  // namespace steradian::eval::entered_lights_test
