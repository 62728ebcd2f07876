#include "solve/fit_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/frame/frame_surfaces.h"
#include "render/surface/gbuffer.h"
#include "solve/tile_products.h"
#include "steradian/error.h"

namespace steradian::solving {
namespace {

constexpr double kFloor = 0.01;   // of the mean, below which root and log see no difference
constexpr double kCauchy = 0.05;  // residual at which the loss turns from squares to logarithms
constexpr double kMostBytes = 4e9;
constexpr std::size_t kMostPixels = std::size_t{1} << 21;
constexpr std::size_t kLeastCoarse = 36 * 36;  // pixels of a coarse picture that count: fewer lead into traps
constexpr double kInside = 1e-3;               // bands are narrowed by this fraction, so that a solution is inside of them

// Residual space: value and slope of the function.
struct Compared {
  double value, slope;
};
Compared compared(ResidualSpace space, double v, double mean) {
  const double u = std::max(v / mean, 0.0);
  switch (space) {
    case ResidualSpace::linear: return {v / mean, 1 / mean};
    case ResidualSpace::log: return {std::log(u + kFloor), 1 / ((u + kFloor) * mean)};
    case ResidualSpace::root: break;
  }
  const double root = std::sqrt(u + kFloor);
  return {root, 0.5 / (root * mean)};
}

float& channel(TileVector& v, std::size_t c, std::size_t i) { return c == 0 ? v.x[i] : c == 1 ? v.y[i] : v.z[i]; }
float channel(const TileVector& v, std::size_t c, std::size_t i) { return c == 0 ? v.x[i] : c == 1 ? v.y[i] : v.z[i]; }

// Lamps of a picture are patches of exactly one color, much brighter than what they light.
std::vector<char> lamps_shown(const Picture& picture, double mean_luminance) {
  std::vector<char> shown(picture.pixels.size(), 0);
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Vec3f p = picture.pixels[at(x, y)];
      if (!(luminance(static_cast<Vec3d>(p)) > 4 * mean_luminance)) continue;
      for (const auto& [nx, ny] : {std::pair{x + 1, y}, std::pair{x, y + 1}})
        if (nx < picture.width && ny < picture.height && picture.pixels[at(nx, ny)] == p) shown[at(x, y)] = shown[at(nx, ny)] = 1;
    }
  return shown;
}

std::vector<bool> fitted_numbers(const Scene& scene, const FittedLights& lights) {
  std::vector<bool> fitted(scene.area_lights.size() + scene.punctual_lights.size());
  for (std::size_t i = 0; i < fitted.size(); ++i) fitted[i] = lights.is_fitted(i);
  return fitted;
}

std::string count_of(std::size_t n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

}  // namespace

// Sums over residuals, in double. Each tile has sums of its own, which are added in the order of the tiles.
struct FitProblem::Sums {
  double cost = 0;
  std::vector<double> gradient, hessian;
  std::vector<double> row;  // of the residual that is added

  Sums(std::size_t unknowns, Wants wants) {
    if (wants == Wants::cost) return;
    gradient.resize(unknowns);
    hessian.resize(unknowns * unknowns);
    row.resize(unknowns);
  }
  // Adds a residual r with the derivatives in `row`, times a weight on its square.
  void add(double r, double weight) {
    const std::size_t n = row.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (row[i] == 0) continue;
      const double d = weight * row[i];
      gradient[i] += d * r;
      for (std::size_t j = 0; j <= i; ++j) hessian[i * n + j] += d * row[j];
    }
  }
  void add(const Sums& other) {
    cost += other.cost;
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += other.gradient[i];
    for (std::size_t i = 0; i < hessian.size(); ++i) hessian[i] += other.hessian[i];
  }
};

FitProblem::FitProblem(const Scene& scene, const FittedLights& lights, const std::vector<LightTarget>& targets, const SolveOptions& options,
                       float least_alpha)
    : lights_(lights), targets_(targets), least_alpha_(least_alpha) {
  std::vector<std::string> problems;
  if (targets.empty()) problems.push_back("no target (give a picture or illuminances)");
  if (options.render.bounces != 0 && !lights.is_linear())
    problems.push_back("bounces count where powers and colors alone are fitted (leave --bounces out, or fit power alone)");
  RenderOptions render = options.render;
  render.lights = LightSum::all;
  tiles_ = std::make_unique<ReceivingTiles>(scene, render, fitted_numbers(scene, lights));
  parts_.resize(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Part& part = parts_[i];
    part.first_tile = tiles_->tiles().size();
    const std::string name = "targets[" + std::to_string(i) + "]";
    if (const auto* picture = std::get_if<PictureTarget>(&targets[i])) {
      add_picture(*picture, name, part, problems);
    } else {
      const auto& lux = std::get<LuxTarget>(targets[i]);
      const std::string place = lux.name.empty() ? name : lux.name;
      if (lux.points.empty() || lux.points.size() != lux.normals.size())
        problems.push_back(place + ": it has no points (give a zone, a mesh or points)");
      if (!lux.lux.min && !lux.lux.max && !lux.lux.mean && !lux.lux.uniformity)
        problems.push_back(place + ": it asks for nothing (give min, max, mean or uniformity)");
      if (lux.lux.min && lux.lux.max && *lux.lux.min > *lux.lux.max) problems.push_back(place + ": min is above max");
      if (!(lux.weight > 0)) problems.push_back(place + ": its weight must be above 0");
      if (lux.points.size() == lux.normals.size()) tiles_->add_points(lux.points, lux.normals);
      part.first_value = points_;
      points_ += lux.points.size();
      part.last_value = points_;
      residuals_ += lux.points.size() * (lux.lux.min || lux.lux.max ? 1u : 0u) + lux.points.size() * (lux.lux.uniformity ? 1u : 0u) +
                    (lux.lux.mean ? 1u : 0u);
    }
    part.last_tile = tiles_->tiles().size();
  }
  for (const Unknown& u : lights.unknowns()) residuals_ += u.keep > 0 ? 1u : 0u;
  const std::size_t unknowns = lights.unknowns().size();
  if (problems.empty() && residuals_ < unknowns)
    problems.push_back("the targets have " + count_of(residuals_, "value") + " for " + count_of(unknowns, "unknown") +
                       " (fit fewer parameters, or add targets)");
  // Sums of each tile, the light of each lamp on it, and the slopes of illuminances.
  const double tiles = static_cast<double>(tiles_->tiles().size()), n = static_cast<double>(unknowns);
  const double bytes = tiles * (8 * n * n + (lights.is_linear() ? sizeof(TileVector) * static_cast<double>(lights.light_count()) : 0)) +
                       8 * n * static_cast<double>(points_);
  if (problems.empty() && bytes > kMostBytes)
    problems.push_back("the fit would take " + std::to_string(static_cast<int>(bytes / 1e9)) +
                       " GB (choose a smaller --size, or fit fewer lights)");
  if (!problems.empty()) {
    std::string text;
    for (const std::string& p : problems) text += (text.empty() ? "" : "\n") + p;
    throw Error("targets", text);
  }
  tiles_->add_fixed_light();
  for (std::size_t i = 0; i < tiles_->tiles().size(); ++i) all_.push_back(i);
  for (Part& part : parts_) {
    if (!lights.is_linear() && lights.materials().empty() && part.counted > 0) add_coarse(part);
    const bool coarse = part.first_coarse < part.last_coarse;
    for (std::size_t i = coarse ? part.first_coarse : part.first_tile; i < (coarse ? part.last_coarse : part.last_tile); ++i)
      coarse_.push_back(i);
    has_coarse_ = has_coarse_ || coarse;
  }
  model_.emplace(lights, *tiles_, all_);
}

// Takes one block of pixels of 16, or of 4, if enough of their pixels count.
void FitProblem::add_coarse(Part& part) {
  for (const int factor : {4, 2}) {
    std::size_t counted = 0;
    for (std::size_t number = part.first_tile; number < part.last_tile; ++number)
      for (std::size_t slot = 0; slot < kTilePixels; ++slot) {
        const std::uint32_t pixel = tiles_->tiles()[number].value[slot];
        if (ReceivingTiles::is_coarse_slot(slot, factor) && pixel != kNoValue && part.row[pixel] != kNoValue) ++counted;
      }
    if (counted < kLeastCoarse) continue;
    part.first_coarse = tiles_->tiles().size();
    tiles_->add_coarse(part.first_tile, part.last_tile, factor);
    part.last_coarse = tiles_->tiles().size();
    part.coarse_weight = static_cast<double>(part.counted) / static_cast<double>(counted);
    return;
  }
}

void FitProblem::add_picture(const PictureTarget& target, const std::string& name, Part& part, std::vector<std::string>& problems) {
  const Picture& picture = target.picture;
  const std::size_t count = picture.pixels.size();
  const auto complain = [&](const std::string& problem) { problems.push_back(name + ": " + problem); };
  if (count == 0) return complain("the picture is empty");
  if (count > kMostPixels) return complain(count_of(count, "pixel") + " are more than a fit takes (choose a smaller --size)");
  if (!target.pixel_weights.empty() && target.pixel_weights.size() != count)
    return complain("the mask has another size than the picture (make both of one size)");
  if (!(target.weight > 0)) return complain("its weight must be above 0");
  part.weights = target.pixel_weights;
  part.weights.resize(count, 1.0f);
  double luminances = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f p = picture.pixels[i];
    if (!is_finite(p))
      return complain("pixel (" + std::to_string(i % static_cast<std::size_t>(picture.width)) + ", " +
                      std::to_string(i / static_cast<std::size_t>(picture.width)) + ") is not finite (repair the picture)");
    if (!(part.weights[i] >= 0) || !std::isfinite(part.weights[i])) return complain("a weight of the mask is negative or not finite");
    luminances += luminance(static_cast<Vec3d>(p));
  }
  if (!(luminances > 0)) return complain("the picture is black (give one with light)");
  tiles_->add_camera(target.camera, picture.width, picture.height, target.part, least_alpha_);
  const std::vector<char> fitted = tiles_->pixels_of_fitted(target.camera, picture.width, picture.height);
  // A painted picture, and a part of the light, show no lamps.
  const std::vector<char> shown = target.part == LightPart::all && !target.painted
                                      ? lamps_shown(picture, luminances / static_cast<double>(count))
                                      : std::vector<char>(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    if (shown[i] != 0 || fitted[i] != 0) part.weights[i] = 0;
  double sum = 0, counted = 0;
  for (std::size_t index = part.first_tile; index < tiles_->tiles().size(); ++index)
    for (const std::uint32_t pixel : tiles_->tiles()[index].value) {
      if (pixel == kNoValue || !(part.weights[pixel] > 0)) continue;
      const Vec3f p = picture.pixels[pixel];
      sum += static_cast<double>(p.x + p.y + p.z);
      counted += 3;
    }
  if (counted == 0) return complain("no pixel counts: all are masked, show no surface or show a lamp (widen the mask)");
  if (!(sum > 0)) return complain("all pixels that count are black (give a target with light)");
  part.mean = sum / counted;
  part.row.assign(count, kNoValue);
  for (std::size_t index = part.first_tile; index < tiles_->tiles().size(); ++index)
    for (const std::uint32_t pixel : tiles_->tiles()[index].value)
      if (pixel != kNoValue && part.weights[pixel] > 0) part.row[pixel] = 0;
  for (std::uint32_t& row : part.row)
    if (row != kNoValue) row = static_cast<std::uint32_t>(part.counted++);
  residuals_ += static_cast<std::size_t>(counted);
  picture_residuals_ += static_cast<std::size_t>(counted);
}

void FitProblem::add_picture_tile(const PictureTarget& target, const Part& part, std::size_t number, const TileVector& value,
                                  const TileLight& slopes, Sums& sums) const {
  const ReceivingTile& tile = tiles_->tiles()[number];
  const double of_target = target.weight * (number >= part.last_tile ? part.coarse_weight : 1);
  const std::size_t n = slopes.size();
  const bool wants_slopes = n > 0;
  // The derivatives of the residuals, and the residuals themselves, times the square root of their influence on the gradient.
  TileLight rows(wants_slopes ? n + 1 : 0);
  TileVector factors{};
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const std::uint32_t pixel = tile.value[i];
    if (pixel == kNoValue || !(part.weights[pixel] > 0)) continue;
    const double weight = of_target * static_cast<double>(part.weights[pixel]);
    const Vec3f wanted = target.picture.pixels[pixel];
    for (std::size_t c = 0; c < 3; ++c) {
      const Compared have = compared(target.space, static_cast<double>(channel(value, c, i)), part.mean);
      const double goal = static_cast<double>(c == 0 ? wanted.x : c == 1 ? wanted.y : wanted.z);
      const double r = have.value - compared(target.space, goal, part.mean).value;
      double influence = weight;
      if (target.loss == ResidualLoss::cauchy) {
        const double ratio = r / kCauchy;
        influence = weight / (1 + ratio * ratio);
        sums.cost += 0.5 * weight * kCauchy * kCauchy * std::log1p(ratio * ratio);
      } else {
        sums.cost += 0.5 * weight * r * r;
      }
      if (!wants_slopes) continue;
      const double root = std::sqrt(influence);
      channel(rows[n], c, i) = static_cast<float>(r * root);
      channel(factors, c, i) = static_cast<float>(have.slope * root);
    }
  }
  if (!wants_slopes) return;
  for (std::size_t u = 0; u < n; ++u)
    for (TilePlane TileVector::*plane : {&TileVector::x, &TileVector::y, &TileVector::z})
      for (std::size_t i = 0; i < kTilePixels; ++i) (rows[u].*plane)[i] = (slopes[u].*plane)[i] * (factors.*plane)[i];
  std::vector<double> products((n + 1) * (n + 1));
  tile_products_for(active_simd()).find(rows.data(), n + 1, products.data());
  for (std::size_t i = 0; i < n; ++i) {
    sums.gradient[i] += products[n * (n + 1) + i];
    for (std::size_t j = 0; j <= i; ++j) sums.hessian[i * n + j] += products[i * (n + 1) + j];
  }
}

FitProblem::Lux FitProblem::illuminances(const std::vector<double>& x, Wants wants) const {
  Lux lux;
  lux.value.resize(points_);
  if (wants == Wants::derivatives) lux.slopes.resize(points_ * unknown_count());
  std::vector<std::size_t> numbers;
  for (const Part& part : parts_)
    if (part.first_value < part.last_value)
      for (std::size_t i = part.first_tile; i < part.last_tile; ++i) numbers.push_back(i);
  if (numbers.empty()) return lux;
  model_->each(x, wants, numbers,
               [&](std::size_t number, const TileVector& value, const TileLight& slopes) { take_lux(number, value, slopes, lux); });
  return lux;
}

void FitProblem::take_lux(std::size_t number, const TileVector& value, const TileLight& slopes, Lux& lux) const {
  const auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.has(number); });
  if (part->first_value == part->last_value) return;
  const ReceivingTile& tile = tiles_->tiles()[number];
  const auto lux_of = [](const TileVector& v, std::size_t i) { return std::numbers::pi * luminance(static_cast<Vec3d>(get(v, i))); };
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.value[i] == kNoValue) continue;
    const std::size_t point = part->first_value + tile.value[i];
    lux.value[point] = lux_of(value, i);
    for (std::size_t u = 0; u < slopes.size(); ++u) lux.slopes[point * slopes.size() + u] = lux_of(slopes[u], i);
  }
}

void FitProblem::add_lux(const LuxTarget& target, const Part& part, const Lux& lux, Wants wants, Sums& sums) const {
  const std::size_t n = sums.row.size(), count = part.last_value - part.first_value;
  std::vector<double> mean_slopes(n);
  double mean = 0;
  for (std::size_t p = part.first_value; p < part.last_value; ++p) {
    mean += lux.value[p] / static_cast<double>(count);
    for (std::size_t u = 0; u < n; ++u) mean_slopes[u] += lux.slopes[p * n + u] / static_cast<double>(count);
  }
  // A residual r with dr = a dE + b dmean, at point p.
  const auto add = [&](double r, double a, double b, std::size_t p) {
    sums.cost += 0.5 * target.weight * r * r;
    if (wants == Wants::cost) return;
    for (std::size_t u = 0; u < n; ++u) sums.row[u] = (a != 0 ? a * lux.slopes[p * n + u] : 0) + b * mean_slopes[u];
    sums.add(r, target.weight);
  };
  const LuxBand& band = target.lux;
  for (std::size_t p = part.first_value; p < part.last_value; ++p) {
    const double e = lux.value[p];
    const bool exact = band.min && band.max && *band.min == *band.max;
    if (band.min) {
      const double low = *band.min * (exact ? 1 : 1 + kInside), unit = std::max(low, 1e-6);
      if (e < low) add((e - low) / unit, 1 / unit, 0, p);
    }
    if (band.max) {
      const double high = *band.max * (exact ? 1 : 1 - kInside), unit = std::max(high, 1e-6);
      if (e > high) add((e - high) / unit, 1 / unit, 0, p);
    }
    if (band.uniformity && mean > 0) {
      const double least = std::min(*band.uniformity * (1 + kInside), 1.0);
      if (e < least * mean) add(e / mean - least, 1 / mean, -e / (mean * mean), p);
    }
  }
  if (band.mean) {
    const double share = std::sqrt(static_cast<double>(count)) / std::max(*band.mean, 1e-6);
    add((mean - *band.mean) * share, 0, share, part.first_value);
  }
}

void FitProblem::add_keep(const std::vector<double>& x, Wants wants, Sums& sums) const {
  for (std::size_t u = 0; u < x.size(); ++u) {
    const Unknown& unknown = lights_.unknowns()[u];
    if (!(unknown.keep > 0)) continue;
    const double r = (x[u] - unknown.start) / unknown.typical;
    sums.cost += 0.5 * unknown.keep * r * r;
    if (wants == Wants::cost) continue;
    std::fill(sums.row.begin(), sums.row.end(), 0.0);
    sums.row[u] = 1 / unknown.typical;
    sums.add(r, unknown.keep);
  }
}

Evaluation FitProblem::evaluate(const std::vector<double>& x, Wants wants, Detail detail) const {
  std::vector<Sums> by_tile(tiles_->tiles().size(), Sums(unknown_count(), wants));
  Lux lux;
  lux.value.resize(points_);
  if (wants == Wants::derivatives) lux.slopes.resize(points_ * unknown_count());
  model_->each(x, wants, numbers(detail), [&](std::size_t number, const TileVector& value, const TileLight& slopes) {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (const auto* picture = std::get_if<PictureTarget>(&targets_[i]); picture != nullptr && parts_[i].has(number))
        add_picture_tile(*picture, parts_[i], number, value, slopes, by_tile[number]);
    take_lux(number, value, slopes, lux);
  });
  Sums all(unknown_count(), wants);
  for (const Sums& sums : by_tile) all.add(sums);
  const double pictures = all.cost;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (const auto* target = std::get_if<LuxTarget>(&targets_[i])) add_lux(*target, parts_[i], lux, wants, all);
  add_keep(x, wants, all);
  const std::size_t n = unknown_count();
  if (wants == Wants::derivatives)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) all.hessian[i * n + j] = all.hessian[j * n + i];
  return {all.cost, pictures, std::move(all.gradient), std::move(all.hessian)};
}

FitProblem::Lux FitProblem::values(const std::vector<double>& x, Wants wants) const {
  std::vector<std::size_t> first;  // value of each target
  std::size_t all = 0;
  for (const Part& part : parts_) {
    first.push_back(all);
    all += 3 * part.counted + part.last_value - part.first_value;
  }
  const std::size_t n = wants == Wants::derivatives ? unknown_count() : 0;
  Lux result{std::vector<double>(all), std::vector<double>(all * n)};
  Lux lux;
  lux.value.resize(points_);
  lux.slopes.resize(points_ * n);
  model_->each(x, wants, all_, [&](std::size_t number, const TileVector& value, const TileLight& slopes) {
    take_lux(number, value, slopes, lux);
    for (std::size_t t = 0; t < parts_.size(); ++t) {
      const Part& part = parts_[t];
      if (part.counted == 0 || number < part.first_tile || number >= part.last_tile) continue;
      for (std::size_t i = 0; i < kTilePixels; ++i) {
        const std::uint32_t pixel = tiles_->tiles()[number].value[i];
        if (pixel == kNoValue || part.row[pixel] == kNoValue) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = first[t] + 3 * std::size_t{part.row[pixel]} + c;
          result.value[at] = static_cast<double>(channel(value, c, i));
          for (std::size_t u = 0; u < n; ++u) result.slopes[at * n + u] = static_cast<double>(channel(slopes[u], c, i));
        }
      }
    }
  });
  for (std::size_t t = 0; t < parts_.size(); ++t)
    for (std::size_t p = parts_[t].first_value; p < parts_[t].last_value; ++p) {
      const std::size_t at = first[t] + p - parts_[t].first_value;
      result.value[at] = lux.value[p];
      for (std::size_t u = 0; u < n; ++u) result.slopes[at * n + u] = lux.slopes[p * n + u];
    }
  return result;
}

std::vector<double> FitProblem::wanted() const {
  std::vector<double> all;
  for (std::size_t t = 0; t < parts_.size(); ++t) {
    if (const auto* picture = std::get_if<PictureTarget>(&targets_[t]))
      for (std::size_t pixel = 0; pixel < parts_[t].row.size(); ++pixel) {
        if (parts_[t].row[pixel] == kNoValue) continue;
        const Vec3f p = picture->picture.pixels[pixel];
        for (const float c : {p.x, p.y, p.z}) all.push_back(static_cast<double>(c));
      }
    all.resize(all.size() + parts_[t].last_value - parts_[t].first_value, std::numeric_limits<double>::quiet_NaN());
  }
  return all;
}

double FitProblem::brightness(const std::vector<double>& x) const {
  std::vector<double> have(tiles_->tiles().size());
  model_->each(x, Wants::cost, coarse_, [&](std::size_t number, const TileVector& value, const TileLight&) {
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const std::uint32_t at = tiles_->tiles()[number].value[i];
      if (at != kNoValue) have[number] += luminance(static_cast<Vec3d>(get(value, i)));
    }
  });
  double wanted = 0, found = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto* picture = std::get_if<PictureTarget>(&targets_[i]);
    if (picture == nullptr) continue;
    for (const std::size_t number : coarse_) {
      if (!parts_[i].has(number)) continue;
      found += have[number];
      for (const std::uint32_t pixel : tiles_->tiles()[number].value)
        if (pixel != kNoValue) wanted += luminance(static_cast<Vec3d>(picture->picture.pixels[pixel]));
    }
  }
  return found > 0 && wanted > 0 ? wanted / found : 1;
}

}  // namespace steradian::solving
