#include "integrals/textured/profiled_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "integrals/curved_light.h"
#include "integrals/methods.h"
#include "reference/gauss_kronrod.h"

namespace steradian {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A cell's span over which 3 x 3 points integrate cosine over distance squared to 1e-4.
constexpr double kWidestKernel = 0.6;
// Fractions that a cell may span: of the lobe's width, and of the angle in which the steepest part of a profile falls from its peak to
// nothing. At these, finer cells change the mean by less than the profile's kinks do (ProfiledLight.ErrorsAreMeasured).
constexpr double kLobeShare = 0.6, kProfileShare = 0.5;
constexpr double kFinerInPart = 4;   // a cell that is visible in part is finer by this
constexpr double kNarrowest = 0.01;  // no measured lamp is steeper than this [rad]

struct GaussNode {
  double x, weight;
};
constexpr double kOuter = 0.774596669241483377;  // Gauss-Legendre, three points
constexpr std::array<GaussNode, 3> kGauss = {{{-kOuter, 5.0 / 9}, {0, 8.0 / 9}, {kOuter, 5.0 / 9}}};

// The angle in which the profile's steepest part would fall from the peak to nothing [rad].
double steepest_part(const LightProfile& profile) {
  const std::size_t n = profile.vertical.size();
  double peak = 0, slope = 0;
  for (const double candela : profile.candela) peak = std::max(peak, candela);
  for (std::size_t i = 0; i < profile.candela.size(); ++i) {
    const std::size_t v = i % n, h = i / n;
    if (v + 1 < n)
      slope = std::max(slope, std::fabs(profile.candela[i + 1] - profile.candela[i]) / (profile.vertical[v + 1] - profile.vertical[v]));
    if (h + 1 < profile.horizontal.size()) {
      const double around = profile.type == LightProfile::Type::c ? std::sin(profile.vertical[v] * std::numbers::pi / 180) : 1;
      if (around > 0.1)  // near the pole the planes meet
        slope = std::max(
            slope, std::fabs(profile.candela[i + n] - profile.candela[i]) / ((profile.horizontal[h + 1] - profile.horizontal[h]) * around));
    }
  }
  return slope > 0 ? std::max(peak / slope * std::numbers::pi / 180, kNarrowest) : 1;
}

}  // namespace

ProfiledLight::ProfiledLight(const AreaLight& light, std::shared_ptr<const ProfileTable> table)
    : emission_(*light.emission), mean_(light.radiance), round_(std::holds_alternative<Ellipse>(light.shape)) {
  if (round_) {
    const auto& disk = std::get<Ellipse>(light.shape);
    center_ = disk.center, x_ = disk.x, y_ = disk.y;
  } else {
    const auto& v = std::get<Polygon>(light.shape).vertices;
    center_ = (v[0] + v[2]) * 0.5, x_ = (v[1] - v[0]) * 0.5, y_ = (v[3] - v[0]) * 0.5;
  }
  widest_ = std::min(kWidestKernel, kProfileShare * steepest_part(*emission_.profile));
  reach_ = round_ ? std::sqrt(dot(x_, x_) + dot(y_, y_)) : std::max(length(x_ + y_), length(x_ - y_));
  if (round_ && std::fabs(dot(x_, y_)) < 1e-9 * dot(x_, x_)) reach_ = std::max(length(x_), length(y_));
  table_ = std::move(table);
}

Vec2d ProfiledLight::coordinates_of(Vec3d place) const {
  const Vec3d at = place - center_, normal = cross(x_, y_);
  return {dot(cross(at, y_), normal) / dot(normal, normal), dot(cross(x_, at), normal) / dot(normal, normal)};
}

// A rect has u and v along the half axes, from -1 to 1. A disk has u as the distance from the middle, v as the angle about it.
Vec3d ProfiledLight::place(Grid grid, double u, double v) const {
  if (grid == Grid::along_axes) return center_ + x_ * u + y_ * v;
  return center_ + x_ * (u * std::cos(v)) + y_ * (u * std::sin(v));
}

ProfiledLight::Sent ProfiledLight::sent(Grid grid, double u, double v, const lobes::Lobe& lobe, const Frame& frame, Vec3d position) const {
  const Vec3d to = place(grid, u, v) - position;
  const double distance2 = dot(to, to);
  if (!(distance2 > 0)) return {};
  const Vec3d l = to / std::sqrt(distance2);
  const double cosine = -dot(l, emission_.axes.aim);
  const double per_area = (grid == Grid::polar ? u : 1) * length(cross(x_, y_)) / distance2;
  return {intensity(*emission_.profile, {-dot(l, emission_.axes.x), -dot(l, emission_.axes.y), cosine}), std::fabs(cosine),
          lobe.evaluate(frame.to_local(l)) * per_area};
}

// The fraction of a cell along the axes that is visible; exactly 0 or 1 where only rounding is missing.
double ProfiledLight::visible_share(const PlaneRegion& visible, const Cell& cell) {
  const double share = std::fabs(visible.area_in({{cell.u0, cell.v0}, {cell.u1, cell.v1}})) / ((cell.u1 - cell.u0) * (cell.v1 - cell.v0));
  constexpr double kRounding = 1e-6;  // the boundary is rounded to 1.2e-7 of the light
  return share < kRounding ? 0 : share > 1 - kRounding ? 1 : share;
}

// Cells of the light that are as fine as the lobe and the profile require.
class ProfiledLight::Cells {
 public:
  // visible: cells that are visible in part are fine.
  Cells(const ProfiledLight& light, Grid grid, const LobeAxis& peak, Vec3d position, const PlaneRegion* visible = nullptr)
      : light_(light), grid_(grid), peak_(peak), position_(position), visible_(visible) {}

  // Calls use(cell) once for each. The cell with the largest excess is halved first, while there are fewer than `most`.
  void visit(std::size_t most, auto use) const {
    thread_local std::vector<Wide> cells;
    cells.clear();
    if (grid_ == Grid::polar)
      for (int k = 0; k < 4; ++k) cells.push_back(judged({0, 1, k * std::numbers::pi / 2, (k + 1) * std::numbers::pi / 2}));
    else
      cells.push_back(judged({-1, 1, -1, 1}));
    std::make_heap(cells.begin(), cells.end());
    while (cells.front().excess > 1 && cells.size() < most) {
      std::pop_heap(cells.begin(), cells.end());
      Cell first = cells.back().cell, second = first;
      if (cells.back().along_u)
        first.u1 = second.u0 = 0.5 * (first.u0 + first.u1);
      else
        first.v1 = second.v0 = 0.5 * (first.v0 + first.v1);
      cells.back() = judged(first);
      std::push_heap(cells.begin(), cells.end());
      cells.push_back(judged(second));
      std::push_heap(cells.begin(), cells.end());
    }
    for (const Wide& wide : cells) use(wide.cell);
  }

 private:
  struct Wide {
    Cell cell;
    double excess;  // span over the allowed span
    bool along_u;   // direction in which it is to be halved
    bool operator<(const Wide& other) const { return excess < other.excess; }
  };
  Wide judged(const Cell& cell) const {
    const auto towards = [&](double u, double v) { return normalized(light_.place(grid_, u, v) - position_); };
    const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
    const Vec3d middle = towards(u, v);
    const double across_u = length(towards(cell.u0, v) - middle) + length(towards(cell.u1, v) - middle);
    const double across_v = length(towards(u, cell.v0) - middle) + length(towards(u, cell.v1) - middle);
    const double span = std::max(across_u, across_v);
    // The lobe varies over its width, and over its distance from the peak beyond.
    const double from_peak = length(middle - peak_.axis) - span / 2;
    double excess = span / std::min(is_even(middle, span) ? kWidestKernel : light_.widest_, kLobeShare * std::max(peak_.width, from_peak));
    if (visible_ != nullptr) {
      const double share = visible_share(*visible_, cell);
      if (share == 0) excess = 0;
      if (share > 0 && share < 1) excess *= kFinerInPart;
    }
    return {cell, excess, across_u > across_v};
  }

  // True if the radiance is even over a cell. t changes by half of the angle, and the cell's corners are at most 0.71 of its span away.
  bool is_even(Vec3d towards, double span) const {
    const ProfileTable* table = light_.table();
    if (table == nullptr) return false;
    const double t = std::sqrt(std::max(0.5 + 0.5 * dot(towards, light_.emission_.axes.aim), 0.0));
    const auto [least, most] = table->range(static_cast<float>(t - 0.36 * span), static_cast<float>(t + 0.36 * span));
    return most - least <= 2 * kEven * most;
  }

  const ProfiledLight& light_;
  const Grid grid_;
  const LobeAxis peak_;
  const Vec3d position_;
  const PlaneRegion* visible_;
};

// True if a small square about the peak is visible.
bool ProfiledLight::sees_peak(const LobeAxis& peak, Vec3d position, const PlaneRegion& visible) const {
  const double distance = -dot(center_ - position, emission_.axes.aim) / -dot(peak.axis, emission_.axes.aim);
  if (!(distance > 0) || !std::isfinite(distance)) return false;
  const auto [u, v] = coordinates_of(position + peak.axis * distance);
  constexpr double kHalf = 1e-4;
  return visible_share(visible, {u - kHalf, u + kHalf, v - kHalf, v + kHalf}) > 0.5;
}

double ProfiledLight::radiance_of_peak(const LobeAxis& peak, Vec3d position) const {
  const double cosine = -dot(peak.axis, emission_.axes.aim);
  const Vec3d to_center = center_ - position;
  const double distance = -dot(to_center, emission_.axes.aim) / cosine;
  if (!(distance > 0) || !std::isfinite(distance)) return 0;
  const auto [u, v] = coordinates_of(position + peak.axis * distance);
  if (round_ ? u * u + v * v > 1 : std::max(std::fabs(u), std::fabs(v)) > 1) return 0;
  return intensity(*emission_.profile, {-dot(peak.axis, emission_.axes.x), -dot(peak.axis, emission_.axes.y), cosine}) / std::fabs(cosine);
}

// The result is peak * integral, plus the lobe times the difference of the radiance from the peak's. That difference is zero where the lobe
// is narrowest, so a lobe between the points costs no more than the others.
Vec3d ProfiledLight::seen_by(const Material& material, const ShadingPoint& at, double integral, int most_cells,
                             const PlaneRegion* visible) const {
  if (const std::optional<Vec3d> even = even_radiance(at.position)) return *even;
  const Grid cells = visible != nullptr ? Grid::along_axes : grid();
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  const LobeAxis axis = lobe_axis(material, at);
  lobes::LobeValue seen, weight;
  double least = kInfinity, most = 0;
  Cells(*this, cells, axis, at.position, visible).visit(static_cast<std::size_t>(most_cells), [&](const Cell& cell) {
    const double share = visible != nullptr ? visible_share(*visible, cell) : 1;
    if (share == 0) return;
    const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
    const double half_u = 0.5 * (cell.u1 - cell.u0), half_v = 0.5 * (cell.v1 - cell.v0);
    for (const GaussNode& nu : kGauss)
      for (const GaussNode& nv : kGauss) {
        const Sent s = sent(cells, u + half_u * nu.x, v + half_v * nv.x, lobe, frame, at.position);
        const lobes::LobeValue w = s.lobe * (share * nu.weight * nv.weight * half_u * half_v);
        if (!(w.plain > 0) || !(s.even > 0)) continue;
        seen += w * s.intensity;
        weight += w * s.even;
        least = std::min(least, s.intensity / s.even);
        most = std::max(most, s.intensity / s.even);
      }
  });
  const InBrightestChannel sums(lobe, seen, weight);
  if (!(sums.weight > 0)) return mean_;
  double mean = sums.seen / sums.weight;
  const double peak = visible == nullptr || sees_peak(axis, at.position, *visible) ? radiance_of_peak(axis, at.position) : 0;
  if (peak > 0 && integral > 0)
    mean = std::clamp(peak + (sums.seen - peak * sums.weight) / integral, std::min(least, peak), std::max(most, peak));
  return radiance_of(mean);
}

// Starts with the cells of seen_by. While Gauss's rule of 7 points a side is far from Kronrod's of 15, it halves the cell with the largest
// difference. The sum of the differences is the bound.
ReferenceResult ProfiledLight::reference(const Material& material, const ShadingPoint& at, const ReferenceOptions& options) const {
  struct Part {
    Cell cell;
    lobes::LobeValue value;
    double error_u, error_v;
    bool operator<(const Part& other) const { return error_u + error_v < other.error_u + other.error_v; }
  };
  using reference::kKronrodNodes;
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  if (!lobe.above_surface() || !(emission_.area > 0)) return {};
  const lobes::LobeValue factors = lobe.largest_factors();
  const auto size = [&](lobes::LobeValue v) { return std::fabs(v.plain) * factors.plain + std::fabs(v.fresnel) * factors.fresnel; };
  const auto part_of = [&](const Cell& cell) {
    const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
    const double half_u = 0.5 * (cell.u1 - cell.u0), half_v = 0.5 * (cell.v1 - cell.v0);
    lobes::LobeValue whole, by_u, by_v;
    for (const reference::KronrodNode& nu : kKronrodNodes) {
      lobes::LobeValue kronrod, gauss;
      for (const reference::KronrodNode& nv : kKronrodNodes) {
        const Sent s = sent(grid(), u + half_u * nu.x, v + half_v * nv.x, lobe, frame, at.position);
        kronrod += s.lobe * (s.intensity * nv.kronrod);
        gauss += s.lobe * (s.intensity * nv.gauss);
      }
      whole += kronrod * nu.kronrod;
      by_u += kronrod * nu.gauss;
      by_v += gauss * nu.kronrod;
    }
    const double area = half_u * half_v;
    return Part{cell, whole * area, size(whole - by_u) * area, size(whole - by_v) * area};
  };
  std::vector<Part> parts;
  Cells(*this, grid(), lobe_axis(material, at), at.position).visit(1024, [&](const Cell& cell) { parts.push_back(part_of(cell)); });
  std::make_heap(parts.begin(), parts.end());
  lobes::LobeValue value;
  double error = 0;
  const auto resum = [&] {
    value = {};
    error = 0;
    for (const Part& part : parts) value += part.value, error += part.error_u + part.error_v;
  };
  resum();
  constexpr int kPoints = reference::kKronrodPoints * reference::kKronrodPoints;
  for (int evaluations = static_cast<int>(parts.size()) * kPoints; evaluations < options.max_evaluations; evaluations += 2 * kPoints) {
    if (error <= std::max(options.absolute_error, options.relative_error * size(value))) break;
    std::pop_heap(parts.begin(), parts.end());
    const Part worst = parts.back();
    parts.pop_back();
    Cell first = worst.cell, second = worst.cell;
    if (worst.error_u > worst.error_v)
      first.u1 = second.u0 = 0.5 * (first.u0 + first.u1);
    else
      first.v1 = second.v0 = 0.5 * (first.v0 + first.v1);
    value = value - worst.value;
    error -= worst.error_u + worst.error_v;
    for (const Cell& half : {first, second}) {
      const Part part = part_of(half);
      value += part.value;
      error += part.error_u + part.error_v;
      parts.push_back(part);
      std::push_heap(parts.begin(), parts.end());
    }
  }
  resum();  // running sums carry the rounding of all terms that were removed
  const Vec3d scale = emission_.intensity * (1 / emission_.area);
  return {lobe.radiance(value) * scale,
          error * std::max({scale.x, scale.y, scale.z}) + 1e-14 * size(value) * std::max({scale.x, scale.y, scale.z})};
}

namespace methods {
namespace {

int most_cells(Quality quality) { return quality == Quality::draft ? 64 : quality == Quality::normal ? 256 : 1024; }

}  // namespace

EmissionFactor emission_factor(const LightEmission& emission) {
  LightEmission white = emission;
  white.intensity = {1, 1, 1};
  return [white = std::move(white)](Vec3d towards) { return emitted_radiance(white, -towards).x; };
}

RadianceResult profiled_light_answer(const AreaLight& light, const ShadingPoint& at, const Material& m, const Row& entry,
                                     const RadianceOptions& options) {
  AreaLight even = light;
  even.emission.reset();
  even.radiance = {1, 1, 1};
  if (entry.method != Method::reference && entry.method != Method::sampled) {
    RadianceResult answer = curved_light_answer(even, at, m, entry, options);
    const double integral = std::max({answer.radiance.x, answer.radiance.y, answer.radiance.z});
    if (integral > 0) answer.radiance = answer.radiance * ProfiledLight(light).seen_by(m, at, integral, most_cells(options.quality));
    return answer;
  }
  RadianceResult answer = nothing(entry.method);
  if (entry.method == Method::reference) {
    // The table's kinks cover the whole light: to 1e-7, or as far as that many points allow.
    const ReferenceResult r = ProfiledLight(light).reference(m, at, {1e-7, 0, 1'000'000});
    answer.radiance = r.radiance;
    answer.bound = r.bound;
    return answer;
  }
  PolygonLight polygon = flat_polygon(light, kFineVertices);
  polygon.radiance = light.emission->intensity;
  const SampledResult r = sampled_radiance(prepare_polygon(polygon), at, m, {options.spp, options.seed, emission_factor(*light.emission)});
  answer.radiance = r.radiance;
  answer.standard_error = r.standard_error;
  return answer;
}

}  // namespace methods
}  // namespace steradian
