// The mean of a profiled light by the table of its profile: one value where it is even over the light, strips over a visible part.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrals/textured/profiled_light.h"

namespace steradian {
namespace {

constexpr int kCellsForNarrowLobes = 1024;  // for a lobe too narrow for strips

// Strips and cells of a strip. The spacing is a fraction of the lobe's width: the midpoints' sum over a lobe w wide at a spacing of 0.35 w
// is off by exp(-2 pi / 0.35), and by the ends of the light. A quarter of a radian is the same for cosines over distance squared.
constexpr int kStripsOfPart = 14, kMostStripsOfPart = 32, kCellsOfStrip = 5;
constexpr double kLobeSpacing = 0.35, kKernelSpacing = 0.25;

// sin(theta / 2) for the point at this height above the light's plane and this distance from the normal.
double half_sine(double height, double beside) {
  const double distance = std::sqrt(height * height + beside * beside);
  if (!(distance > 0)) return 0;
  const double less = height >= 0 ? beside * beside / (distance * (distance + height)) : 1 - height / distance;
  return std::sqrt(less / 2);
}

}  // namespace

// Range of t over the circle that holds the light. t rises with the distance from the normal before the light, and falls behind it.
std::pair<float, float> ProfiledLight::extent(Vec3d position) const {
  const Vec3d from = position - center_;
  const double height = dot(from, emission_.axes.aim), beside = std::hypot(dot(from, emission_.axes.x), dot(from, emission_.axes.y));
  const auto a = static_cast<float>(half_sine(height, std::max(beside - reach_, 0.0)));
  const auto b = static_cast<float>(half_sine(height, beside + reach_));
  return {std::min(a, b), std::max(a, b)};
}

std::optional<Vec3d> ProfiledLight::even_radiance(Vec3d position) const {
  if (table() == nullptr) return std::nullopt;
  const auto [from, to] = extent(position);
  const auto [least, most] = table_->range(from, to);
  if (most - least > 2 * kEven * most) return std::nullopt;
  return radiance_of(static_cast<double>(least + most) / 2);
}

// In coordinates of the half axes, turned so that x is the direction in which the angle from the normal changes most.
Vec3d ProfiledLight::seen_in_part(const Material& material, const ShadingPoint& at, double integral, const PlaneRegion& visible) const {
  if (const std::optional<Vec3d> even = even_radiance(at.position)) return *even;
  const Vec3d from = at.position - center_, aim = emission_.axes.aim;
  const double height = dot(from, aim);
  const Vec3d beside = from - aim * height;
  Vec2d along = {-dot(beside, x_), -dot(beside, y_)};
  const double steep = std::hypot(along.x, along.y);
  along = steep > 0 ? Vec2d{along.x / steep, along.y / steep} : Vec2d{1, 0};
  const PlaneRegion part = visible.turned(along);
  const Box2d box = part.bounds();
  const Vec3d u_axis = x_ * along.x + y_ * along.y, v_axis = y_ * along.x - x_ * along.y;
  const Vec3d middle = center_ + u_axis * (0.5 * (box.low.x + box.high.x)) + v_axis * (0.5 * (box.low.y + box.high.y));
  const double size_u = length(u_axis) * (box.high.x - box.low.x), size_v = length(v_axis) * (box.high.y - box.low.y);
  const double near = std::max(length(at.position - middle) - 0.5 * std::hypot(size_u, size_v), std::fabs(height));
  const LobeAxis axis = lobe_axis(material, at);
  const double from_peak = length(normalized(middle - at.position) - axis.axis) - 0.5 * std::hypot(size_u, size_v) / near;
  const double spacing = std::min(kKernelSpacing, kLobeSpacing * std::max(axis.width, from_peak)) * near;
  if (table() == nullptr || !(size_u * size_v > 0) || std::max(size_u, size_v) > kMostStripsOfPart * spacing)
    return seen_by(material, at, integral, kCellsForNarrowLobes, &visible);
  const auto needed = [&](double size, int least) { return std::max(static_cast<int>(std::ceil(size / spacing)), least); };
  const int strips = needed(size_u, kStripsOfPart), across = needed(size_v, kCellsOfStrip);

  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  const double step_u = (box.high.x - box.low.x) / strips, step_v = (box.high.y - box.low.y) / across;
  lobes::LobeValue seen, weight;
  thread_local PlaneRegion row;
  for (int k = 0; k < across; ++k) {
    const double low_v = box.low.y + k * step_v;
    part.cut_row(low_v, low_v + step_v, row);
    for (int i = 0; i < strips; ++i) {
      const Vec2d low = {box.low.x + i * step_u, low_v};
      const auto [area, middle_of] = row.part_in({low, {low.x + step_u, low.y + step_v}});
      if (std::fabs(area) < 1e-6 * step_u * step_v) continue;  // the boundary is rounded to 1.2e-7 of the light
      const Vec3d place = center_ + u_axis * middle_of.x + v_axis * middle_of.y;
      const Vec3d to = place - at.position;
      const double distance2 = dot(to, to), distance = std::sqrt(distance2);
      const Vec3d l = to / distance;
      const lobes::LobeValue value = lobe.evaluate(frame.to_local(l));
      const lobes::LobeValue w = value * (std::fabs(area) * length(cross(x_, y_)) / distance2);
      if (!(w.plain > 0)) continue;
      // d t = height rho d rho / (4 t r^3), with rho the distance from the normal; the two sides of a cell add as deviations do.
      const double x = -dot(to, emission_.axes.x), y = -dot(to, emission_.axes.y), beside_here = std::sqrt(x * x + y * y);
      const double t = half_sine(height, beside_here), rate = height / (4 * std::max(t, 1e-6) * distance2 * distance);
      const double share = std::fabs(area) / (step_u * step_v);
      const double half_u = 0.5 * share * step_u * dot(to, u_axis) * rate, half_v = 0.5 * share * step_v * dot(to, v_axis) * rate;
      const double half = std::max(std::sqrt(half_u * half_u + half_v * half_v), static_cast<double>(table_->least_half()));
      const double turn = table_->columns() > 1 ? std::atan2(y, x) / (2 * std::numbers::pi) : 0;
      const double candela = table_->mean(t, half, (turn < 0 ? turn + 1 : turn) * table_->columns());
      const double cosine = std::fabs(height) / distance;
      seen += w * candela;
      weight += w * cosine;
    }
  }
  const InBrightestChannel sums(lobe, seen, weight);
  if (!(sums.weight > 0)) return mean_;
  const auto [t0, t1] = extent(at.position);
  const auto [least, most] = table_->range(t0, t1);
  double mean = sums.seen / sums.weight;
  const double peak = sees_peak(axis, at.position, visible) ? radiance_of_peak(axis, at.position) : 0;
  if (peak > 0 && integral > 0)
    mean = std::clamp(peak + (sums.seen - peak * sums.weight) / integral, static_cast<double>(least), static_cast<double>(most));
  return radiance_of(mean);
}

}  // namespace steradian
