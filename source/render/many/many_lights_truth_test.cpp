// Many lights together against the sum of exact irradiances in double: no receiver may be further off than its bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/random.h"
#include "night.h"
#include "render/many/many_lights.h"
#include "steradian/radiance.h"

namespace steradian::many_lights_truth_test {
namespace {

using reference::Random;

Vec3d direction(Random& random) {
  for (;;) {
    const Vec3d v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (const double d = length(v); d > 0.1 && d < 1) return v / d;
  }
}

// Receivers on a patch of a plane, and lights about it.
struct LightField {
  Scene scene;
  lights::ReceiverSet receivers;
  double error = 0;
  std::string kind;
};

// Lights in the receivers' plane, across it, parallel above it, and anywhere; radiances over eight orders of magnitude.
LightField any_field(Random& random) {
  LightField field;
  const char* const kKinds[] = {"in the plane", "across the plane", "nearly in the plane", "above the plane", "anywhere"};
  const auto kind = static_cast<std::size_t>(random.uniform(0, 5));
  field.kind = kKinds[kind];
  field.error = std::pow(10, random.uniform(-7, -1));
  const bool level = random.uniform() < 0.5;
  const Frame frame = level ? Frame{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}} : Frame::from_normal(direction(random));
  const Vec3d middle = direction(random) * std::pow(10, random.uniform(-1, 1));
  const double side = std::pow(10, random.uniform(-1, 0.5));
  const int rows = 12;
  for (int i = 0; i < rows * rows; ++i) {
    lights::Receiver q;
    q.position = static_cast<Vec3f>(middle + frame.x * (side * (i % rows / (rows - 1.0) - 0.5)) +
                                    frame.y * (side * (i / rows / (rows - 1.0) - 0.5)));
    q.normal = static_cast<Vec3f>(frame.z);
    q.albedo = {1, 1, 1};
    q.place = static_cast<std::uint32_t>(i);
    field.receivers.points.push_back(q);
  }
  const int count = static_cast<int>(std::pow(10, random.uniform(1, test::by_day_or_night(2.3, 3.3))));
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 6.283), distance = side * std::pow(10, random.uniform(-1, 1.5));
    const double size = distance * std::pow(10, random.uniform(-4, -0.5));
    Vec3d center = middle + frame.x * (std::cos(angle) * distance) + frame.y * (std::sin(angle) * distance), normal = frame.z;
    if (kind == 1) normal = direction(random);
    if (kind == 2) normal = normalized(frame.z + direction(random) * std::pow(10, random.uniform(-12, -3)));
    if (kind >= 3) center += frame.z * (distance * random.uniform(0.01, 2));
    if (kind == 3) normal = -frame.z;
    if (kind == 4) normal = direction(random);
    const Vec3d x = normalized(cross(normal, direction(random))) * size, y = normalized(cross(normal, x)) * (size * random.uniform(0.1, 1));
    AreaLight light;
    light.two_sided = random.uniform() < 0.5;
    light.radiance = Vec3d{1, 0.5, 0.1} * std::pow(10, random.uniform(-4, 4));
    const double shape = random.uniform();
    if (shape < 0.6 || kind == 2)
      light.shape = Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}};
    else if (shape < 0.8)
      light.shape = Ellipse{center, x, y};
    else
      light.shape = Ellipsoid{center, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    field.scene.area_lights.push_back(light);
  }
  return field;
}

struct FieldVerdict {
  double over = 0;   // largest error over its bound
  double error = 0;  // the error there, over the largest light of a receiver
  double bound = 0;
  int beyond = 0;  // receivers beyond their bound
};

FieldVerdict judge(LightField& field) {
  const std::vector<PackLight> prepared = prepare_lights(field.scene);
  const lights::ManyLights many(prepared, {0, 100, 0}, static_cast<float>(field.error));
  const auto work = lights::ManyLights::make_work();
  many.add_diffuse(field.receivers, *work);
  Material lambert;
  FieldVerdict judged;
  std::vector<double> truths;
  for (const lights::Receiver& q : field.receivers.points) {
    const ShadingPoint at = {static_cast<Vec3d>(q.position), static_cast<Vec3d>(q.normal), static_cast<Vec3d>(q.normal)};
    double truth = 0;
    for (const AreaLight& light : field.scene.area_lights) truth += radiance(light, at, lambert, {.method = Method::exact}).radiance.x;
    truths.push_back(truth);
  }
  const double largest = std::max(*std::max_element(truths.begin(), truths.end()), 1e-300);
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const lights::Received& r = field.receivers.received[i];
    const double off = std::fabs(static_cast<double>(r.radiance.x) - truths[i]), bound = static_cast<double>(r.bound.x);
    if (off <= bound) continue;
    ++judged.beyond;
    const double over = off / std::max(bound, 1e-300);
    if (over > judged.over) judged = {over, off / largest, bound / largest, judged.beyond};
  }
  return judged;
}

}  // namespace

TEST(ManyLightsTruth, NoReceiverIsBeyondItsBound) {
  Random random(77);
  const int fields = test::by_day_or_night(60, 600);
  int beyond = 0;
  for (int i = 0; i < fields; ++i) {
    LightField field = any_field(random);
    const FieldVerdict judged = judge(field);
    beyond += judged.beyond > 0;
    EXPECT_EQ(judged.beyond, 0) << i << ": lights " << field.kind << ", " << field.scene.area_lights.size() << ", error " << field.error
                                << ", over bound " << judged.over << ", error " << judged.error << " bound " << judged.bound;
  }
  std::printf("%d fields, %d with receivers beyond their bound\n", fields, beyond);
}

}  // namespace steradian::many_lights_truth_test
