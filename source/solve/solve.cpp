#include "steradian/solve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/random.h"
#include "solve/box_least_squares.h"
#include "solve/fit_problem.h"
#include "solve/least_power.h"
#include "solve/quarter_turns.h"
#include "steradian/error.h"

namespace steradian {
namespace {

using namespace solving;

constexpr int kCoarseSteps = 25;    // of each starting point
constexpr double kRounding = 5e-7;  // rms residual of pictures in single precision
constexpr double kShadowed = 2e-6;  // of pictures with shadows, whose edges are less true

constexpr double kMeanSlack = 1e-3;  // of a wanted mean, for the search of the least power

// A random place in the box: positions without a range lie in the scene's bounds.
std::vector<double> random_place(const std::vector<Unknown>& unknowns, const Scene& scene, reference::Random& random) {
  std::vector<double> x;
  for (const Unknown& u : unknowns) {
    double low = u.low, high = u.high;
    const auto within = [&](double least, double most) { low = std::max(low, least), high = std::min(high, most); };
    switch (u.kind) {
      case UnknownKind::position_x: within(scene.bounds_min.x, scene.bounds_max.x); break;
      case UnknownKind::position_y: within(scene.bounds_min.y, scene.bounds_max.y); break;
      case UnknownKind::position_z: within(scene.bounds_min.z, scene.bounds_max.z); break;
      case UnknownKind::rotation_x:
      case UnknownKind::rotation_y:
      case UnknownKind::rotation_z: within(-0.5, 0.5); break;
      case UnknownKind::vertex_u:
      case UnknownKind::vertex_v: low = high = u.start; break;  // random outlines would cross themselves
      case UnknownKind::albedo_red:
      case UnknownKind::albedo_green:
      case UnknownKind::albedo_blue:
      case UnknownKind::roughness: low = high = u.start; break;  // they have one valley each
      default: within(u.start - 0.5, u.start + 0.5); break;
    }
    x.push_back(std::clamp(low < high ? random.uniform(low, high) : u.start, u.low, u.high));
  }
  return x;
}

class Solver {
 public:
  Solver(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties, const std::vector<LightTarget>& targets,
         const SolveOptions& options)
      : scene_(scene),
        targets_(targets),
        options_(options),
        lights_(scene, fits, ties, options.materials),
        problem_(scene, lights_, targets, options) {
    for (const Unknown& u : lights_.unknowns()) {
      settings_.low.push_back(u.low);
      settings_.high.push_back(u.high);
      settings_.typical.push_back(u.typical);
    }
    settings_.max_steps = options.max_steps;
    settings_.rounding = cost_of(options.render.shadows != Shadows::off ? kShadowed : kRounding);
    settings_.tolerance = options.tolerance;
    settings_.same = [this](std::vector<double> x) { return with_quarter_turns(lights_, std::move(x)); };
  }

  Solution solve() {
    refuse_blind_lights();
    std::vector<double> x = lights_.start();
    if (!lights_.is_linear()) x = best_start(x);
    if (has_highlights() && !lights_.is_linear()) x = annealed(x);
    BoxMinimum found = solution_.stopped ? BoxMinimum{x, 0, {}, 0, 0, false, true} : minimize(problem_, x, 0, settings_);
    if (options_.least_power && lights_.is_linear() && !found.stopped) take_least_power(found);
    gather(found);
    return std::move(solution_);
  }

 private:
  // Half the sum of squares of this rms residual of pictures.
  double cost_of(double rms) const { return 0.5 * static_cast<double>(problem_.picture_residual_count()) * rms * rms; }

  BoxMinimum minimize(const FitProblem& problem, const std::vector<double>& x, int start, const BoxSettings& settings,
                      Detail detail = Detail::all) {
    const auto value = [&](const std::vector<double>& at) {
      return lights_.crosses_itself(at) ? std::numeric_limits<double>::infinity() : problem.evaluate(at, Wants::cost, detail).cost;
    };
    const auto quadratic = [&](const std::vector<double>& at) {
      Evaluation e = problem.evaluate(at, Wants::derivatives, detail);
      return Quadratic{e.cost, std::move(e.gradient), std::move(e.hessian)};
    };
    BoxMinimum found =
        minimize_in_box(value, quadratic, x, settings, [&](int step, double cost, double damping, const std::vector<double>& at) {
          if (options_.moved) options_.moved(changes_at(at));
          const SolveStep done{start, step, cost, damping};
          solution_.steps.push_back(done);
          return !options_.progress || options_.progress(done);
        });
    solution_.evaluations += found.evaluations;
    return found;
  }

  bool has_highlights() const {
    return std::any_of(targets_.begin(), targets_.end(), [](const LightTarget& target) {
      const auto* picture = std::get_if<PictureTarget>(&target);
      return picture != nullptr && picture->part == LightPart::specular;
    });
  }

  // A few steps with wide lobes, then narrower ones: a narrow highlight that does not touch its target has no slope towards it.
  std::vector<double> annealed(std::vector<double> x) {
    BoxSettings settings = settings_;
    settings.max_steps = kCoarseSteps;
    for (const float alpha : {0.5f, 0.25f, 0.12f}) {
      if (solution_.stopped) break;
      const FitProblem problem(scene_, lights_, targets_, options_, alpha);
      BoxMinimum found = minimize(problem, x, 0, settings);
      solution_.stopped = found.stopped;
      x = std::move(found.x);
    }
    return x;
  }

  // The best of the scene's own start and random ones, each after a few steps by coarse pictures.
  std::vector<double> best_start(const std::vector<double>& own) {
    // A highlight's first steps are those of wider lobes.
    if (options_.starts == 1 && (!problem_.has_coarse() || has_highlights())) return own;
    const double own_cost = problem_.evaluate(own, Wants::cost).cost;
    if (own_cost <= settings_.rounding) return own;
    BoxSettings settings = settings_;
    if (options_.starts > 1) settings.max_steps = kCoarseSteps;
    reference::Random random(options_.seed);
    BoxMinimum best;
    for (int start = 0; start < options_.starts && !solution_.stopped; ++start) {
      std::vector<double> x = own;
      if (start > 0) {
        x = random_place(lights_.unknowns(), scene_, random);
        const double factor = std::log(problem_.brightness(x));
        for (std::size_t u = 0; u < x.size(); ++u)
          if (is_scale(lights_.unknowns()[u].kind)) x[u] = std::clamp(x[u] + factor, settings.low[u], settings.high[u]);
      }
      BoxMinimum found = minimize(problem_, x, start, settings, Detail::coarse);
      solution_.stopped = found.stopped;
      if (start == 0 || found.value < best.value) best = std::move(found);
    }
    return problem_.evaluate(best.x, Wants::cost).cost < own_cost ? best.x : own;
  }

  // Throws Error for a light or a material whose every derivative is 0. Coarse pixels mostly see all of them.
  void refuse_blind_lights() {
    if (problem_.has_coarse() && blind_fits(Detail::coarse).empty()) return;
    const std::string blind = blind_fits(Detail::all);
    if (!blind.empty()) throw Error("fit", blind);
  }

  // The complaint about lights or materials whose every derivative is 0, and its remedy; else empty.
  std::string blind_fits(Detail detail) const {
    const Evaluation e = problem_.evaluate(lights_.start(), Wants::derivatives, detail);
    const std::size_t n = lights_.unknowns().size();
    // Bands that are satisfied hide a light from the cost, so the illuminances themselves are asked.
    const FitProblem::Lux lux = problem_.illuminances(lights_.start(), Wants::derivatives);
    const auto unseen = [&](std::size_t count, bool materials, const auto& name_of) {
      std::string blind;
      for (std::size_t fit = 0; fit < count; ++fit) {
        bool asked = false, seen = false;
        for (std::size_t u = 0; u < n; ++u) {
          if (lights_.unknowns()[u].fit != fit || is_of_material(lights_.unknowns()[u].kind) != materials) continue;
          asked = true;
          seen = seen || e.hessian[u * n + u] > 0;
          for (std::size_t p = 0; p < lux.value.size() && !seen; ++p) seen = lux.slopes[p * n + u] != 0;
        }
        if (asked && !seen) blind += (blind.empty() ? "'" : ", '") + name_of(fit) + "'";
      }
      return blind;
    };
    std::string blind = unseen(lights_.light_count(), false, [&](std::size_t i) { return lights_.name_of(i); });
    if (!blind.empty()) return "no target sees the light of " + blind + " (turn or move the light towards the target, or leave it out)";
    const FittedMaterials& materials = lights_.materials();
    blind = unseen(materials.count(), true, [&](std::size_t i) { return materials.name_of(i); });
    return blind.empty() ? "" : "no target sees light on the material " + blind + " (point the camera at it, or leave it out)";
  }

  // Conditions of the illuminances, linear in the powers.
  std::vector<Condition> conditions() const {
    const std::size_t n = lights_.unknowns().size();
    const FitProblem::Lux dark = problem_.illuminances(std::vector<double>(n, 0.0), Wants::derivatives);
    std::vector<Condition> result;
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const auto* target = std::get_if<LuxTarget>(&targets_[t]);
      if (target == nullptr) continue;
      const auto [first, last] = problem_.lux_range(t);
      const auto row = [&](std::size_t p) {
        return std::vector<double>(dark.slopes.begin() + static_cast<std::ptrdiff_t>(p * n),
                                   dark.slopes.begin() + static_cast<std::ptrdiff_t>((p + 1) * n));
      };
      Condition mean{0, std::vector<double>(n)};
      for (std::size_t p = first; p < last; ++p) {
        mean.constant += dark.value[p] / static_cast<double>(last - first);
        for (std::size_t u = 0; u < n; ++u) mean.slopes[u] += dark.slopes[p * n + u] / static_cast<double>(last - first);
      }
      const auto add = [&](double sign, const Condition& e, double offset) {
        Condition c{sign * e.constant + offset, e.slopes};
        for (double& s : c.slopes) s *= sign;
        result.push_back(std::move(c));
      };
      const LuxBand& band = target->lux;
      for (std::size_t p = first; p < last; ++p) {
        const Condition e{dark.value[p], row(p)};
        if (band.min) add(1, e, -*band.min);
        if (band.max) add(-1, e, *band.max);
        if (band.uniformity) {
          Condition c{e.constant - *band.uniformity * mean.constant, e.slopes};
          for (std::size_t u = 0; u < n; ++u) c.slopes[u] -= *band.uniformity * mean.slopes[u];
          result.push_back(std::move(c));
        }
      }
      if (band.mean) {
        add(1, mean, -*band.mean);
        add(-1, mean, *band.mean * (1 + kMeanSlack));
      }
    }
    return result;
  }

  void take_least_power(BoxMinimum& found) {
    std::vector<double> cost;
    for (std::size_t u = 0; u < lights_.unknowns().size(); ++u) cost.push_back(lights_.shown(u, 1));
    if (const auto least = least_cost(cost, conditions(), settings_.low, settings_.high, found.x)) {
      found.x = *least;
      const Evaluation e = problem_.evaluate(found.x, Wants::derivatives);
      found.value = e.cost;
      found.hessian = e.hessian;
      solution_.notes.push_back("the powers are the least that satisfy the illuminances");
    } else {
      solution_.notes.push_back("no powers satisfy all illuminances: the nearest ones by least squares are taken");
    }
  }

  std::vector<LightChange> changes_at(const std::vector<double>& x) const {
    std::vector<LightChange> changes;
    for (const FittedLight& light : lights_.at(x)) {
      LightChange& change = changes.emplace_back(light.change);
      change.light = light.number;
      change.radiance = (light.is_punctual ? light.punctual.intensity : light.area.radiance) * light.scale;
    }
    return changes;
  }

  void gather(const BoxMinimum& found) {
    solution_.changes = changes_at(found.x);
    solution_.material_changes = lights_.materials().changes_at(found.x);
    for (std::string& note : lights_.materials().notes()) solution_.notes.push_back(std::move(note));
    solution_.area_lights = scene_.area_lights;
    solution_.punctual_lights = scene_.punctual_lights;
    for (const FittedLight& light : lights_.at(found.x)) {
      if (light.is_punctual) {
        PunctualLight& to = solution_.punctual_lights[light.number - scene_.area_lights.size()];
        to = light.punctual;
        to.intensity = to.intensity * light.scale;
      } else {
        AreaLight& to = solution_.area_lights[light.number];
        to = light.area;
        to.radiance = to.radiance * light.scale;
        if (to.texture) to.texture->factor = to.texture->factor * light.scale;
        if (to.emission) to.emission->intensity = to.emission->intensity * light.scale;
      }
    }
    Evaluation end = problem_.evaluate(found.x, found.hessian.empty() ? Wants::derivatives : Wants::cost);
    if (!found.hessian.empty()) end.hessian = found.hessian;
    solution_.cost = end.cost;
    solution_.residuals = problem_.residual_count();
    if (problem_.picture_residual_count() > 0)
      solution_.picture_error = std::sqrt(2 * end.pictures / static_cast<double>(problem_.picture_residual_count()));
    solution_.converged = found.converged;
    solution_.stopped = solution_.stopped || found.stopped;
    gather_parameters(found.x, end);
    note_missing_light(found.x);
    gather_lux(found.x);
  }

  // States that the pictures are brighter nearly everywhere: they may hold light that the fit leaves out.
  void note_missing_light(const std::vector<double>& x) {
    if (problem_.picture_residual_count() == 0) return;
    const std::vector<double> have = problem_.values(x, Wants::cost).value, wanted = problem_.wanted();
    std::size_t brighter = 0, darker = 0, all = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (std::isnan(wanted[i])) continue;
      ++all;
      brighter += wanted[i] > 1.1 * have[i] ? 1u : 0u;
      darker += wanted[i] < 0.9 * have[i] ? 1u : 0u;
    }
    if (brighter > all / 10 && brighter > 4 * darker)
      solution_.notes.push_back(
          "the target is more than a tenth brighter than the result over much of the picture: it may hold light that the fit leaves out, "
          "such as bounces (use the loss cauchy, or a mask)");
  }

  void gather_parameters(const std::vector<double>& x, const Evaluation& end) {
    const std::vector<Unknown>& unknowns = lights_.unknowns();
    std::vector<char> held(x.size());
    for (std::size_t u = 0; u < x.size(); ++u) {
      const double near = 1e-9 * unknowns[u].typical;
      held[u] = x[u] <= unknowns[u].low + near || x[u] >= unknowns[u].high - near ? 1 : 0;
    }
    const double free = std::max(static_cast<double>(problem_.residual_count()) - static_cast<double>(x.size()), 1.0);
    const Uncertainty sure = uncertainty_of(end.hessian, 2 * end.cost / free, settings_.typical, held);
    for (std::size_t u = 0; u < x.size(); ++u) {
      FittedParameter p;
      p.name = unknowns[u].name;
      p.start = lights_.shown(u, unknowns[u].start);
      double slope = 1;
      p.value = lights_.shown(u, x[u], &slope);
      p.sigma = sure.sigma[u] * std::fabs(slope);
      p.at_bound = held[u] != 0;
      p.determined = sure.determined[u] != 0;
      solution_.parameters.push_back(std::move(p));
    }
  }

  void gather_lux(const std::vector<double>& x) {
    const FitProblem::Lux lux = problem_.illuminances(x, Wants::cost);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const auto* target = std::get_if<LuxTarget>(&targets_[t]);
      if (target == nullptr) continue;
      const auto [first, last] = problem_.lux_range(t);
      LuxResult result;
      result.name = target->name;
      result.points = last - first;
      result.min = result.max = lux.value[first];
      for (std::size_t p = first; p < last; ++p) {
        const double e = lux.value[p];
        result.min = std::min(result.min, e);
        result.max = std::max(result.max, e);
        result.mean += e / static_cast<double>(last - first);
      }
      const LuxBand& band = target->lux;
      for (std::size_t p = first; p < last; ++p) {
        const double e = lux.value[p];
        const bool low = (band.min && e < *band.min * (1 - 1e-3)) || (band.uniformity && e < *band.uniformity * result.mean * (1 - 1e-3));
        result.outside += low || (band.max && e > *band.max * (1 + 1e-3)) ? 1u : 0u;
      }
      if (band.mean && std::fabs(result.mean - *band.mean) > 1e-3 * *band.mean && !options_.least_power)
        solution_.notes.push_back(target->name + ": the mean differs from the wanted one");
      solution_.lux.push_back(result);
    }
  }

  const Scene& scene_;
  const std::vector<LightTarget>& targets_;
  const SolveOptions& options_;
  FittedLights lights_;
  FitProblem problem_;
  BoxSettings settings_;
  Solution solution_;
};

}  // namespace

Solution solve(const Scene& scene, const std::vector<LightFit>& fits, const std::vector<LightTie>& ties,
               const std::vector<LightTarget>& targets, const SolveOptions& options) {
  if (options.starts < 1 || options.max_steps < 1 || !(options.tolerance > 0))
    throw Error("options", "starts and max_steps must be at least 1, and tolerance above 0");
  return Solver(scene, fits, ties, targets, options).solve();
}

}  // namespace steradian
