// The coarse pixels of a fit.
#include "solve/fit_problem.h"

#include <gtest/gtest.h>

#include "solve/lamp_room_test.h"

namespace steradian::solve_test {

// Coarse pixels have the values of the fine ones: at the truth the cost is that of rounding, 5e-7 a residual. Elsewhere
// they stand for all: 144 blocks or more, whose costs spread by about their mean, have a standard error of a twelfth of it.
TEST(FitProblem, CoarsePixelsAreSomeOfAll) {
  Scene scene = room();
  scene.area_lights = {panel({0.4, 2.5, -0.5}, 1.2, 0.6, {8, 7, 6}, {0.2, 0, -0.1})};
  for (const auto& [width, height] : {std::pair{128, 72}, std::pair{200, 150}}) {
    const std::vector<LightTarget> targets{picture_of(scene, width, height)};
    const solving::FittedLights lights(scene, {everything(0)}, {});
    const solving::FitProblem problem(scene, lights, targets, {});
    ASSERT_TRUE(problem.has_coarse());
    std::vector<double> x = lights.start();
    const double rounding = 0.5 * static_cast<double>(problem.picture_residual_count()) * 5e-7 * 5e-7;
    EXPECT_LT(problem.evaluate(x, solving::Wants::cost).cost, rounding);
    EXPECT_LT(problem.evaluate(x, solving::Wants::cost, solving::Detail::coarse).cost, rounding);
    x[0] += 0.1;  // power
    const double all = problem.evaluate(x, solving::Wants::cost).cost;
    const double coarse = problem.evaluate(x, solving::Wants::cost, solving::Detail::coarse).cost;
    std::printf("%d x %d: cost %.4g, by coarse pixels %.4g\n", width, height, all, coarse);
    EXPECT_NEAR(coarse, all, 0.25 * all);
  }
  const std::vector<LightTarget> small{picture_of(scene, 64, 36)};
  const solving::FittedLights lights(scene, {everything(0)}, {});
  EXPECT_FALSE(solving::FitProblem(scene, lights, small, {}).has_coarse());
}

}  // namespace steradian::solve_test
