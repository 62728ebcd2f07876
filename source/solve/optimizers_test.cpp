// One lamp from random places by several optimizers, on the same values and slopes. By night it prints the table of docs/measured/solve.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <nlopt.hpp>
#include <numbers>

#include "core/random.h"
#include "night.h"
#include "solve/lamp_room_test.h"
#include "steradian/solve.h"

namespace steradian::solve_test {
namespace {

// The sum of squares that solve() minimizes, with the space `root`.
class Objective {
 public:
  explicit Objective(const LightModel& model) : model_(model), wanted_(model.wanted()) {
    for (const double v : wanted_) mean_ += v / static_cast<double>(wanted_.size());
  }

  // gradient: filled unless null. samples: of a simulated estimate by Monte Carlo; 0 is exact.
  double operator()(const std::vector<double>& x, std::vector<double>* gradient, int samples, reference::Random& random) {
    ++evaluations;
    const LightModel::Values v = gradient != nullptr ? model_.with_slopes(x) : model_.at(x);
    if (gradient != nullptr) gradient->assign(x.size(), 0.0);
    double sum = 0;
    // One sample has the standard error of its value.
    const auto noise = [&] { return samples > 0 ? 1 + gaussian(random) / std::sqrt(static_cast<double>(samples)) : 1.0; };
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const double value = std::max(v.value[i] * noise(), 0.0) / mean_, root = std::sqrt(value + 0.01);
      const double r = root - std::sqrt(wanted_[i] / mean_ + 0.01);
      sum += r * r / static_cast<double>(wanted_.size());
      if (gradient == nullptr) continue;
      const double factor = r / (root * mean_ * static_cast<double>(wanted_.size())) * noise();
      for (std::size_t u = 0; u < x.size(); ++u) (*gradient)[u] += factor * v.slopes[i * x.size() + u];
    }
    return sum;
  }

  int evaluations = 0;

 private:
  static double gaussian(reference::Random& random) {
    return std::sqrt(-2 * std::log(random.uniform(1e-300, 1))) * std::cos(random.uniform(0, 2 * std::numbers::pi));
  }
  const LightModel& model_;
  std::vector<double> wanted_;
  double mean_ = 0;
};

struct Outcome {
  double off = 0, seconds = 0;  // distance of the lamp [m]
  int evaluations = 0;
};

struct Problem {
  Scene scene;
  std::vector<LightFit> fits;
  std::vector<LightTarget> targets;
  Vec3d truth;
};

Vec3d place_of(const LightModel& model, const std::vector<double>& x) {
  Vec3d p{};
  for (std::size_t u = 0; u < x.size(); ++u) {
    const std::string name = model.variables()[u].name;
    if (name.ends_with("position x")) p.x = x[u];
    if (name.ends_with("position y")) p.y = x[u];
    if (name.ends_with("position z")) p.z = x[u];
  }
  return p;
}

Outcome by_ours(const Problem& problem) {
  const Solution found = solve(problem.scene, problem.fits, {}, problem.targets);
  return {length(center_of(found.area_lights[0]) - problem.truth), 0, found.evaluations};
}

Outcome by_nlopt(const Problem& problem, nlopt::algorithm algorithm) {
  const LightModel model(problem.scene, problem.fits, {}, problem.targets);
  struct Data {
    Objective objective;
    reference::Random random{1};
  } data{Objective(model)};
  nlopt::opt search(algorithm, static_cast<unsigned>(model.start().size()));
  std::vector<double> low, high, x = model.start();
  for (const LightModel::Variable& v : model.variables()) low.push_back(v.low), high.push_back(v.high);
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_min_objective(
      [](const std::vector<double>& at, std::vector<double>&, void* d) {
        Data& own = *static_cast<Data*>(d);
        return std::sqrt(own.objective(at, nullptr, 0, own.random));
      },
      &data);
  search.set_stopval(1e-6);
  search.set_maxeval(2000);
  double reached = 0;
  try {
    search.optimize(x, reached);
  } catch (const nlopt::roundoff_limited&) {  // counts as far as it came
  }
  return {length(place_of(model, x) - problem.truth), 0, data.objective.evaluations};
}

Outcome by_adam(const Problem& problem, int samples) {
  const LightModel model(problem.scene, problem.fits, {}, problem.targets);
  Objective objective(model);
  reference::Random random(7);
  constexpr int kSteps = 400;
  std::vector<double> x = model.start(), gradient, first(x.size()), second(x.size());
  for (int step = 1; step <= kSteps; ++step) {
    objective(x, &gradient, samples, random);
    const double rate = 0.05 * 0.5 * (1 + std::cos(std::numbers::pi * step / kSteps));
    for (std::size_t u = 0; u < x.size(); ++u) {
      first[u] = 0.9 * first[u] + 0.1 * gradient[u];
      second[u] = 0.999 * second[u] + 0.001 * gradient[u] * gradient[u];
      const double m = first[u] / (1 - std::pow(0.9, step)), v = second[u] / (1 - std::pow(0.999, step));
      x[u] = std::clamp(x[u] - rate * m / (std::sqrt(v) + 1e-12), model.variables()[u].low, model.variables()[u].high);
    }
  }
  return {length(place_of(model, x) - problem.truth), 0, objective.evaluations};
}

}  // namespace

TEST(SolveOptimizers, NeedATenthOfTheEvaluationsOfBobyqa) {
  struct Method {
    const char* name;
    std::function<Outcome(const Problem&)> run;
    std::vector<Outcome> found{};
  };
  Method methods[] = {{"`solve`", by_ours},
                      {"BOBYQA, without derivatives", [](const Problem& p) { return by_nlopt(p, nlopt::LN_BOBYQA); }},
                      {"COBYLA, without derivatives", [](const Problem& p) { return by_nlopt(p, nlopt::LN_COBYLA); }},
                      {"Adam, exact gradient", [](const Problem& p) { return by_adam(p, 0); }},
                      {"Adam, simulated noise of 16 samples", [](const Problem& p) { return by_adam(p, 16); }},
                      {"Adam, simulated noise of 1 sample", [](const Problem& p) { return by_adam(p, 1); }}};
  reference::Random random(11);
  const int starts = test::by_day_or_night(3, 12);
  for (int i = 0; i < starts; ++i) {
    Problem problem{room(), {everything(0)}, {}, {0.4, 2.5, -0.5}};
    problem.scene.area_lights = {panel(problem.truth, 1.2, 0.6, {8, 7, 6})};
    problem.targets = {picture_of(problem.scene, 64, 36)};
    problem.scene.area_lights = {panel({random.uniform(-2, 2), random.uniform(1.8, 2.7), random.uniform(-2, 2)}, 0.8, 0.8, {6, 5.25, 4.5})};
    problem.fits[0].rotation = false;
    problem.fits[0].power_range = {1, 1000};
    for (Method& m : methods) {
      const auto begin = std::chrono::steady_clock::now();
      Outcome one = m.run(problem);
      one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      m.found.push_back(one);
    }
  }
  const auto median = [](std::vector<Outcome> all, auto member) {
    std::sort(all.begin(), all.end(), [&](const Outcome& a, const Outcome& b) { return a.*member < b.*member; });
    return all[all.size() / 2].*member;
  };
  std::printf("| optimizer | within 1 mm | evaluations | time | distance |\n|---|---|---|---|---|\n");
  for (const Method& m : methods) {
    const auto recovered = std::count_if(m.found.begin(), m.found.end(), [](const Outcome& o) { return o.off < 1e-3; });
    std::printf("| %s | %td of %d | %d | %.2g s | %.1e m |\n", m.name, recovered, starts, median(m.found, &Outcome::evaluations),
                median(m.found, &Outcome::seconds), median(m.found, &Outcome::off));
  }
  const auto& [ours, bobyqa, cobyla, adam, noisy, noisier] = methods;
  EXPECT_LT(10 * median(ours.found, &Outcome::evaluations), median(bobyqa.found, &Outcome::evaluations));
  EXPECT_LT(100 * median(ours.found, &Outcome::off), median(noisy.found, &Outcome::off));
  EXPECT_LT(median(ours.found, &Outcome::off), 1e-5);
}

}  // namespace steradian::solve_test
