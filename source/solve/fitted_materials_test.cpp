// Materials that fit themselves: recovery of seeded ones, ranges, and slopes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/lamp_room_test.h"
#include "steradian/error.h"
#include "steradian/solve.h"

namespace steradian::solve_test {

// Seeded roughness and base colour of the floor: with a lamp that stays, and together with a lamp whose place is free.
TEST(Solve, RecoversTheMaterialOfAFloor) {
  for (const bool lamp_moves : {false, true}) {
    Scene scene = room();
    scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
    scene.materials[1].base_color = {0.3f, 0.45f, 0.15f, 1};
    scene.materials[1].roughness = 0.35f;
    const PictureTarget target = picture_of(scene, 64, 36);
    scene.materials[1].base_color = {0.6f, 0.6f, 0.6f, 1};
    scene.materials[1].roughness = 0.6f;
    std::vector<LightFit> fits;
    if (lamp_moves) {
      scene.area_lights = {panel({0.2, 2.4, -0.3}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
      fits.push_back({});
      fits.back().position = true;
    }
    SolveOptions options;
    options.materials.push_back({1, "floor", true, true});
    const Solution found = solve(scene, fits, {}, {target}, options);
    EXPECT_TRUE(found.converged);
    ASSERT_EQ(found.material_changes.size(), 1u);
    const MaterialChange& floor = found.material_changes[0];
    const double albedo = length(floor.albedo - Vec3d(Vec3f{0.3f, 0.45f, 0.15f})), roughness = std::fabs(floor.roughness - 0.35);
    std::printf("floor recovered: base colour to %.1e, roughness to %.1e, picture to %.1e, %zu steps\n", albedo, roughness,
                found.picture_error, found.steps.size() - 1);
    // The picture has single precision: an rms residual of 2e-6 (solve.cpp), over the least change that a parameter makes of 0.02 or more.
    EXPECT_LT(albedo, 1e-4);
    EXPECT_LT(roughness, 1e-4);
    EXPECT_EQ(found.parameters[found.parameters.size() - 1].name, "floor: roughness");
    for (const FittedParameter& p : found.parameters) EXPECT_TRUE(p.determined) << p.name;
    const Vec3d lamp = center_of(lamp_moves ? found.area_lights[0] : scene.area_lights[0]);
    EXPECT_LT(length(lamp - Vec3d{0.4, 2.5, -0.5}), 1e-3);
  }
}

TEST(Solve, KeepsMaterialsInTheirRanges) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  scene.materials[0].base_color = {0.9f, 0.9f, 0.9f, 1};  // walls and ceiling share it
  const PictureTarget target = picture_of(scene, 48, 27);
  scene.materials[0].base_color = {0.5f, 0.5f, 0.5f, 1};
  SolveOptions options;
  options.materials.push_back({0, "walls", true, false, {0.2, 0.7}});
  const Solution found = solve(scene, {}, {}, {target}, options);
  EXPECT_NEAR(found.material_changes[0].albedo.x, 0.7, 1e-6);
  EXPECT_TRUE(found.parameters[0].at_bound);
  ASSERT_FALSE(found.notes.empty());
  EXPECT_EQ(found.notes[0], "material 'walls' is that of 4 meshes, which all change");
  options.materials[0].albedo_range = {0.6, 0.7};
  EXPECT_THROW(solve(scene, {}, {}, {target}, options), Error);
  options.materials[0] = {7, "", true};
  EXPECT_THROW(solve(scene, {}, {}, {target}, options), Error);
  options.materials[0] = {0, "walls", false, true};  // they have no glossy lobe: nothing changes with it
  EXPECT_THROW(solve(scene, {}, {}, {target}, options), Error);
}

// The slopes by a material against differences of the values with another step.
TEST(Solve, SlopesByMaterialsAreDifferences) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  const std::vector<LightTarget> targets = {picture_of(scene, 32, 18)};
  SolveOptions options;
  options.materials.push_back({1, "floor", true, true});
  LightFit power;
  power.power = true;
  const std::vector<LightFit> fits = {power};
  const LightModel model(scene, fits, {}, targets, options);
  const std::vector<double> x = model.start();
  ASSERT_EQ(x.size(), 5u);
  const LightModel::Values all = model.with_slopes(x);
  for (std::size_t u = 0; u < x.size(); ++u) {
    // The light is affine in the base colour. By the roughness, steps of 0.02 and half of that give a difference of fourth order.
    const auto difference = [&](double step) {
      std::vector<double> low = x, high = x;
      low[u] -= step;
      high[u] += step;
      std::vector<double> a = model.at(low).value;
      const std::vector<double> b = model.at(high).value;
      for (std::size_t i = 0; i < a.size(); ++i) a[i] = (b[i] - a[i]) / (2 * step);
      return a;
    };
    const std::vector<double> wide = difference(0.02), narrow = difference(0.01);
    // The value has a step of a thousandth where the cubature changes its number of nodes: nine values of ten count.
    std::vector<double> errors;
    double size = 0;
    for (std::size_t i = 0; i < wide.size(); ++i) {
      const double judge = (4 * narrow[i] - wide[i]) / 3;
      errors.push_back(std::fabs(all.slopes[i * x.size() + u] - judge));
      size = std::max(size, std::fabs(judge));
    }
    std::sort(errors.begin(), errors.end());
    const double error = errors[errors.size() * 9 / 10];
    std::printf("%s: nine of ten within %.1e of the largest derivative\n", model.variables()[u].name.c_str(), error / size);
    EXPECT_GT(size, 0);
    EXPECT_LT(error, 1e-3 * size) << model.variables()[u].name;
  }
}

}  // namespace steradian::solve_test
