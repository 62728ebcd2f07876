#include "reference/past_occluders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/box.h"
#include "lobes/lobe.h"
#include "reference/gauss_kronrod.h"
#include "reference/lit_surface.h"

namespace steradian::reference {
namespace {

using lobes::Lobe;
using lobes::LobeValue;

constexpr double kPi = std::numbers::pi;
constexpr double kUlp = std::numeric_limits<double>::epsilon();

// True if the point lies in the triangle's plane, to the rounding of the corners; within: and inside the triangle.
bool touches(const Blocker& t, Vec3d from, bool& within) {
  const Vec3d a = t[0] - from, b = t[1] - from, c = t[2] - from, n = cross(b - a, c - a);
  const double size = length(n), largest = std::max({length(t[0]), length(t[1]), length(t[2]), length(from)});
  within = false;
  if (!(size > 0)) return true;
  if (std::fabs(dot(n, a)) > 8 * kUlp * largest * size) return false;
  constexpr double kInside = 1e-9;
  const double area = size * kInside;
  within = dot(cross(a, b), n) / size > area && dot(cross(b, c), n) / size > area && dot(cross(c, a), n) / size > area;
  return true;
}

// Finds triangles that block nothing of a light: behind the point, beside the rectangle around the light's hull in a plane before the
// point, or below a horizon.
class Shield {
 public:
  Shield(const LitSurface& light, const std::vector<Vec3d>& horizons) : horizons_(horizons) {
    std::vector<Vec3d> hull;
    light.add_hull(hull);
    Vec3d middle;
    for (const Vec3d& v : hull) middle += normalized(v);
    if (length(middle) < 1e-3) return;
    about_ = Frame::from_normal(normalized(middle));
    knows_ = true;
    for (const Vec3d& v : hull) {
      const Vec3d l = about_.to_local(v);
      if (!(l.z > 1e-6 * length(l))) knows_ = false;
      light_.add(Vec3d{l.x / l.z, l.y / l.z, 0});
    }
  }

  bool is_free(const Blocker& b) const {
    const auto all = [&](auto&& holds) { return holds(b[0]) && holds(b[1]) && holds(b[2]); };
    for (const Vec3d& plane : horizons_)
      if (all([&](Vec3d v) { return dot(v, plane) < 0; })) return true;
    if (!knows_ || all([&](Vec3d v) { return dot(v, about_.z) <= 0; })) return knows_;
    if (!all([&](Vec3d v) { return dot(v, about_.z) > 0; })) return false;
    Box3d box;
    for (const Vec3d& v : b) {
      const Vec3d l = about_.to_local(v);
      box.add(Vec3d{l.x / l.z, l.y / l.z, 0});
    }
    return !box.meets(light_);
  }

 private:
  const std::vector<Vec3d>& horizons_;
  Frame about_;
  Box3d light_;
  bool knows_ = false;
};

struct Integral {
  LobeValue value;
  double error = 0, magnitude = 0;  // weighted sums over the two scalars
  double boundary = 0;              // the lobe at the ends of the visible angles

  void add(const Integral& b, double factor) {
    value += b.value * factor;
    error += b.error * factor;
    magnitude += b.magnitude * factor;
    boundary += b.boundary * factor;
  }
};

class Slices {
 public:
  Slices(const LitSurface& light, std::vector<Blocker> blockers, std::vector<Vec3d> planes, const Lobe& lobe, const Frame& frame,
         const EmissionFactor& emission)
      : light_(light),
        blockers_(std::move(blockers)),
        planes_(std::move(planes)),
        lobe_(lobe),
        frame_(frame),
        emission_(emission),
        factors_(lobe.largest_factors()) {
    const lobes::LobeShape shape = lobe.shape();
    const Vec3d peak = normalized(frame.to_world(shape.peak));
    about_ = Frame::from_normal(light.nearest(peak));
    scale_ = std::clamp(2 * shape.width * std::min(length(shape.x), length(shape.y)), 1e-9, 1.0);
  }

  // Halves the range of azimuths with the largest error until the bound is small enough.
  Integral run(const ReferenceOptions& options) {
    std::vector<double> azimuths;
    for (int i = 0; i <= kFirst; ++i) azimuths.push_back(2 * kPi * i / kFirst);
    std::vector<Vec3d> corners;
    light_.add_corners(corners);
    for (const Blocker& b : blockers_) corners.insert(corners.end(), b.begin(), b.end());
    if (corners.size() <= kMostCorners)
      for (const Vec3d& c : corners) {
        const double azimuth = std::atan2(dot(c, about_.y), dot(c, about_.x));
        azimuths.push_back(azimuth < 0 ? azimuth + 2 * kPi : azimuth);
      }
    std::sort(azimuths.begin(), azimuths.end());
    for (std::size_t i = 0; i + 1 < azimuths.size(); ++i)
      if (azimuths[i] < azimuths[i + 1]) push(over(azimuths[i], azimuths[i + 1]));
    Integral sum = total();
    for (int round = 0; evaluations_ < options.max_evaluations && !heap_.empty(); ++round) {
      if (sum.error <= std::max(options.absolute_error, options.relative_error * weighted(sum.value))) {
        sum = total();  // running sums carry the rounding of all terms that were removed
        if (sum.error <= std::max(options.absolute_error, options.relative_error * weighted(sum.value))) break;
      }
      std::pop_heap(heap_.begin(), heap_.end());
      const Range worst = heap_.back();
      heap_.pop_back();
      const double middle = 0.5 * (worst.begin + worst.end);
      if (!(worst.begin < middle && middle < worst.end)) {  // the range is one number wide
        heap_.push_back(worst);
        break;
      }
      sum.add(worst.integral, -1);
      for (const auto& [begin, end] : {std::pair{worst.begin, middle}, std::pair{middle, worst.end}}) {
        const Range half = over(begin, end);
        sum.add(half.integral, 1);
        push(half);
      }
    }
    return total();
  }

 private:
  static constexpr int kFirst = 16;
  static constexpr std::size_t kMostCorners = 1024;

  // A range of azimuths.
  struct Range {
    double begin, end;
    Integral integral;
    friend bool operator<(const Range& a, const Range& b) { return a.integral.error < b.integral.error; }
  };

  double weighted(LobeValue v) const { return std::fabs(v.plain) * factors_.plain + std::fabs(v.fresnel) * factors_.fresnel; }

  void push(const Range& range) {
    heap_.push_back(range);
    std::push_heap(heap_.begin(), heap_.end());
  }
  Integral total() const {
    Integral sum;
    for (const Range& r : heap_) sum.add(r.integral, 1);
    return sum;
  }

  double error_of(const std::array<LobeValue, kKronrodPoints>& f, LobeValue kronrod, LobeValue gauss, double half) const {
    const LobeValue mean = kronrod * 0.5, difference = (kronrod - gauss) * half;
    LobeValue variation;
    for (std::size_t i = 0; i < f.size(); ++i)
      variation +=
          LobeValue{std::fabs(f[i].plain - mean.plain), std::fabs(f[i].fresnel - mean.fresnel)} * (kKronrodNodes[i].kronrod * half);
    return weighted(
        {error_estimate(std::fabs(difference.plain), variation.plain), error_estimate(std::fabs(difference.fresnel), variation.fresnel)});
  }

  Range over(double begin, double end) {
    Range range{begin, end, {}};
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    std::array<LobeValue, kKronrodPoints> values;
    LobeValue kronrod, gauss;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const KronrodNode& node = kKronrodNodes[i];
      const Integral slice = along(HalfPlane(about_, middle + half * node.x));
      values[i] = slice.value;
      kronrod += slice.value * node.kronrod;
      gauss += slice.value * node.gauss;
      range.integral.add(slice, node.kronrod * half);
    }
    range.integral.error += error_of(values, kronrod, gauss, half);
    return range;
  }

  // The lobe over the visible angles of a half plane.
  Integral along(const HalfPlane& h) {
    lit_.clear(), blocked_.clear();
    light_.add_angles(h, lit_);
    Integral sum;
    if (lit_.empty()) return sum;
    double lowest = 0, highest = kPi;
    for (const Vec3d& plane : planes_) {
      const double turned = std::atan2(dot(plane, h.across), dot(plane, h.axis));
      const double shift = turned < -0.5 * kPi ? 2 * kPi : 0;
      lowest = std::max(lowest, turned + shift - 0.5 * kPi);
      highest = std::min(highest, turned + shift + 0.5 * kPi);
    }
    for (const Blocker& b : blockers_) {
      std::array<std::optional<HalfPlaneCrossing>, 3> c;
      for (std::size_t i = 0; i < 3; ++i) c[i] = crossing(h, b[i], b[(i + 1) % 3]);
      const std::size_t missed = !c[0] ? 0 : !c[1] ? 1 : 2;
      const auto &first = c[(missed + 1) % 3], &second = c[(missed + 2) % 3];
      if (!first || !second) continue;
      if (first->place.y < 0 && second->place.y < 0) continue;
      light_.add_in_front(h, {first->place, second->place}, lit_, blocked_);
    }
    std::sort(blocked_.begin(), blocked_.end(), [](const Angles& a, const Angles& b) { return a.begin < b.begin; });
    for (const Angles& lit : lit_) {
      double begin = std::max(lit.begin, lowest);
      const double end = std::min(lit.end, highest);
      for (const Angles& b : blocked_) {
        if (b.begin > begin) add_visible(h, begin, std::min(b.begin, end), lit.weight, sum);
        begin = std::max(begin, b.end);
      }
      add_visible(h, begin, end, lit.weight, sum);
    }
    return sum;
  }

  // Angles are scale sinh(w): near the axis, where the lobe may have its peak, they are dense.
  void add_visible(const HalfPlane& h, double begin, double end, double weight, Integral& sum) {
    if (!(begin < end)) return;
    struct Piece {
      double begin, end;
      int depth;
    };
    const auto lobe_at = [&](double w) -> LobeValue {
      const double theta = scale_ * std::sinh(w);
      const Vec3d direction = h.direction(theta);
      double factor = std::sin(theta) * scale_ * std::cosh(w);
      if (emission_) factor *= emission_(direction);
      return lobe_.evaluate(frame_.to_local(direction)) * factor;
    };
    for (const double theta : {begin, end}) sum.boundary += weighted(lobe_.evaluate(frame_.to_local(h.direction(theta)))) * std::sin(theta);
    std::vector<Piece> pieces = {{std::asinh(begin / scale_), std::asinh(end / scale_), 0}};
    Integral result;
    while (!pieces.empty()) {
      const Piece p = pieces.back();
      pieces.pop_back();
      const double middle = 0.5 * (p.begin + p.end), half = 0.5 * (p.end - p.begin);
      std::array<LobeValue, kKronrodPoints> values;
      LobeValue kronrod, gauss;
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = lobe_at(middle + half * kKronrodNodes[i].x);
        kronrod += values[i] * kKronrodNodes[i].kronrod;
        gauss += values[i] * kKronrodNodes[i].gauss;
      }
      evaluations_ += kKronrodPoints;
      const double error = error_of(values, kronrod, gauss, half), magnitude = weighted(kronrod * half);
      largest_ = std::max(largest_, magnitude);
      if (error <= 1e-12 * magnitude || error <= 1e-14 * largest_ || p.depth == kDeepest) {
        result.value += kronrod * half;
        result.error += error;
        result.magnitude += magnitude;
        continue;
      }
      pieces.push_back({middle, p.end, p.depth + 1});
      pieces.push_back({p.begin, middle, p.depth + 1});
    }
    sum.value += result.value * weight;
    sum.error += result.error * std::fabs(weight);
    sum.magnitude += result.magnitude * std::fabs(weight);
  }
  static constexpr int kDeepest = 20;

  const LitSurface& light_;
  const std::vector<Blocker> blockers_;
  const std::vector<Vec3d> planes_;
  const Lobe& lobe_;
  const Frame frame_;
  const EmissionFactor& emission_;
  const LobeValue factors_;
  Frame about_;
  double scale_;        // angle from the axis at which the lobe falls off
  double largest_ = 0;  // magnitude of a piece so far
  int evaluations_ = 0;
  std::vector<Range> heap_;
  std::vector<Angles> lit_, blocked_;
};

}  // namespace

ReferenceResult radiance_past(std::span<const Blocker> blockers, const AreaLight& light, const ShadingPoint& at, Vec3d horizon,
                              const Material& material, const ReferenceOptions& options, const EmissionFactor& emission) {
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  const std::unique_ptr<LitSurface> surface = surface_of(light, at.position);
  if (!lobe.above_surface() || !surface || !surface->shines()) return {};

  std::vector<Vec3d> planes = {at.normal, normalized(horizon)};
  for (const Vec3d& plane : lobe.ending_planes())
    if (!(plane == Vec3d{})) planes.push_back(frame.to_world(plane));
  std::vector<Blocker> free;
  double magnification = 1;
  for (const Blocker& b : blockers) {
    bool within;
    if (touches(b, at.position, within)) {
      const Vec3d n = normalized(cross(b[1] - b[0], b[2] - b[0]));
      if (const double side = dot(n, planes[1]); within && std::fabs(side) > 1e-12) planes.push_back(side > 0 ? n : -n);
      continue;
    }
    free.push_back({b[0] - at.position, b[1] - at.position, b[2] - at.position});
    for (int i = 0; i < 3; ++i) magnification = std::max(magnification, (length(at.position) + length(b[i])) / length(free.back()[i]));
  }
  const Shield shield(*surface, planes);
  std::erase_if(free, [&](const Blocker& b) { return shield.is_free(b); });
  Slices slices(*surface, std::move(free), std::move(planes), lobe, frame, emission);
  const Integral sum = slices.run(options);
  const Vec3d brightness = light.emission ? light.emission->intensity : light.radiance;
  const double scale = std::max({std::fabs(brightness.x), std::fabs(brightness.y), std::fabs(brightness.z)});
  const double rounding = kUlp * (4 * (8 + lobe.sensitivity()) * sum.magnitude + 4 * magnification * sum.boundary);
  return {lobe.radiance(sum.value) * brightness, (sum.error + rounding) * scale};
}

}  // namespace steradian::reference
