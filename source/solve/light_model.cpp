#include "solve/fit_problem.h"
#include "steradian/error.h"

namespace steradian {

using namespace solving;

struct LightModel::Parts {
  FittedLights lights;
  FitProblem problem;

  Parts(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties, const std::vector<LightTarget>& targets,
        const SolveOptions& options)
      : lights(scene, fits, ties, options.materials), problem(scene, lights, targets, options) {}

  Values at(const std::vector<double>& x, Wants wants) const {
    if (x.size() != lights.unknowns().size())
      throw Error("x", "has " + std::to_string(x.size()) + " numbers", "give " + std::to_string(lights.unknowns().size()));
    FitProblem::Lux found = problem.values(x, wants);
    return {std::move(found.value), std::move(found.slopes)};
  }
};

LightModel::LightModel(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties,
                       const std::vector<LightTarget>& targets, const SolveOptions& options)
    : parts_(std::make_unique<Parts>(scene, fits, ties, targets, options)) {}
LightModel::~LightModel() = default;

std::vector<LightModel::Variable> LightModel::variables() const {
  std::vector<Variable> result;
  for (const Unknown& u : parts_->lights.unknowns()) result.push_back({u.name, u.start, u.low, u.high});
  return result;
}
std::vector<double> LightModel::start() const { return parts_->lights.start(); }
LightModel::Values LightModel::at(const std::vector<double>& x) const { return parts_->at(x, Wants::cost); }
LightModel::Values LightModel::with_slopes(const std::vector<double>& x) const { return parts_->at(x, Wants::derivatives); }
std::vector<double> LightModel::wanted() const { return parts_->problem.wanted(); }

}  // namespace steradian
