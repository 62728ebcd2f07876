// The points of a pack share a grid of the light: strips across the direction in which the profile changes most, which each point has for
// itself, and cells along each strip. A cell has the lobe at its middle and the profile's mean over its width (ProfileTable).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "integrals/textured/profiled_light.h"
#include "render/direct/profiled_means.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;
using Lanes = K::mask;

constexpr int kLeastStrips = 8, kLeastStripsOfDisk = 12, kMostStrips = 24, kLeastAcross = 6;
// As in profiled_strips.cpp: a fraction of the lobe's width; radians of the kernel that the strips shall have, and must have.
constexpr double kLobeSpacing = 0.35, kKernelSpacing = 0.1, kWidestSpacing = 0.25;

// One strip of a unit disk or of a square from -1 to 1: its centroid, half of its width, half of its length, and its area.
struct Strip {
  float middle, half, along, area;
};
struct Strips {
  std::array<Strip, kMostStrips> all;

  // Strips of a disk are equal in the angle from its middle, whose sine is their place: those at the rim are narrow. Their lengths change
  // over their widths. So a strip has the centroid and the variance of its area, as a strip of one length would have.
  static Strips of_disk(int n) {
    Strips s = {};
    // Integrals of x^k over the area up to x = sin a: of 2 cos(a)^2 sin(a)^k da.
    const auto area_before = [](double a) { return a + std::sin(2 * a) / 2; };
    const auto first_before = [](double a) { return -2 * std::pow(std::cos(a), 3) / 3; };
    const auto second_before = [](double a) { return a / 4 - std::sin(4 * a) / 16; };
    for (int i = 0; i < n; ++i) {
      const double a = std::numbers::pi * (i / static_cast<double>(n) - 0.5), b = a + std::numbers::pi / n;
      const double area = area_before(b) - area_before(a), middle = (first_before(b) - first_before(a)) / area;
      const double variance = (second_before(b) - second_before(a)) / area - middle * middle;
      s.all[static_cast<std::size_t>(i)] = {static_cast<float>(middle), static_cast<float>(std::sqrt(3 * variance)),
                                            static_cast<float>(area / (2 * (std::sin(b) - std::sin(a)))), static_cast<float>(area)};
    }
    return s;
  }
  static Strips of_square(int n) {
    Strips s = {};
    for (int i = 0; i < n; ++i)
      s.all[static_cast<std::size_t>(i)] = {static_cast<float>((2 * i + 1.0) / n - 1), static_cast<float>(1.0 / n), 1,
                                            static_cast<float>(4.0 / n)};
    return s;
  }
};

const Strips& strips_of(bool round, int n) {
  static const std::array<std::array<Strips, kMostStrips + 1>, 2> table = [] {
    std::array<std::array<Strips, kMostStrips + 1>, 2> t = {};
    for (int i = 1; i <= kMostStrips; ++i) {
      t[0][static_cast<std::size_t>(i)] = Strips::of_square(i);
      t[1][static_cast<std::size_t>(i)] = Strips::of_disk(i);
    }
    return t;
  }();
  return table[round ? 1 : 0][static_cast<std::size_t>(n)];
}

// sin(theta / 2) of the angle from the light's normal, for a height above its plane, the square of the distance from the normal, and the
// distance.
STERADIAN_INLINE PackReal half_sine(const PackReal& height, const PackReal& beside2, const PackReal& distance) {
  const PackReal above = abs(height), before = beside2 / (distance * (distance + above));
  return sqrt(max(PackReal(0.5) * select(height < PackReal(0.0), PackReal(2.0) - before, before), PackReal(0.0)));
}

// Mean intensity over an interval of t.
class Candela {
 public:
  explicit Candela(const ProfileTable& table)
      : table_(table), per_step_(1 / static_cast<double>(table.step())), step_(static_cast<double>(table.step())) {}

  //   x, y  in the profile's axes, from the light to the point, for the horizontal angle
  STERADIAN_INLINE PackReal mean(const PackReal& t, const PackReal& half, const PackReal& x, const PackReal& y) const {
    const PackReal a = (t + half) * per_step_, b = (t - half) * per_step_;
    const auto along = [&](const PackReal& column) {
      const Integral to = integral(a, column), from = integral(b, column);
      return ((to.high - from.high) + (to.low - from.low)) / (half + half);
    };
    if (table_.columns() == 1) return along(PackReal(0.0));
    const PackReal turn = K().trig_atan2(y, x) * PackReal(0.5 * std::numbers::inv_pi);
    const PackReal columns(static_cast<double>(table_.columns()));
    const PackReal at = select(turn < PackReal(0.0), turn + PackReal(1.0), turn) * columns;
    const PackReal c = clamp(floor(at), PackReal(0.0), columns - PackReal(1.0));
    const PackReal first = along(c);
    return first + (at - c) * (along(c + PackReal(1.0)) - first);
  }

 private:
  struct Integral {
    PackReal high, low;
  };
  // The integral from 0 to a place in steps of a column, odd in the place.
  STERADIAN_INLINE Integral integral(const PackReal& at, const PackReal& column) const {
    constexpr double kLast = ProfileTable::kSteps;
    const PackReal place = min(abs(at), PackReal(kLast)), i = floor(place), part = place - i;
    alignas(64) std::array<float, kLanes> index, sum, sum_low, intensity, half_rise;
    store(index.data(), column * PackReal(static_cast<double>(ProfileTable::kRow)) + i);  // exact: below 2^24
    const ProfileTable::Step* steps = table_.column(0);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const ProfileTable::Step& s = steps[static_cast<std::size_t>(static_cast<std::int32_t>(index[lane]))];
      sum[lane] = s.sum, sum_low[lane] = s.sum_low, intensity[lane] = s.intensity, half_rise[lane] = s.half_rise;
    }
    const PackReal high = load(sum.data());
    const PackReal low = load(sum_low.data()) + step_ * part * (load(intensity.data()) + part * load(half_rise.data()));
    const Lanes odd = at < PackReal(0.0);
    return {select(odd, -high, high), select(odd, -low, low)};
  }

  const ProfileTable& table_;
  const PackReal per_step_, step_;
};

// A lobe at the points of a pack. towards: from the point to a place of the light, in the light's axes; distance: its length.
struct DiffuseLobe {
  PackVec3 normal;  // in the light's axes
  STERADIAN_INLINE PackReal at(const PackVec3& towards, const PackReal& inverse) const {
    return max(dot(normal, towards), PackReal(0.0)) * inverse * PackReal(std::numbers::inv_pi);
  }
};
struct GgxLobe {
  K::mat3 frame;  // the surface's axes, in the light's
  PackVec3 view;  // in the surface's axes
  PackReal alpha_x, alpha_y, f0, f90;
  STERADIAN_INLINE PackReal at(const PackVec3& towards, const PackReal& inverse) const {
    K k;
    const PackVec3 l = transform_transposed(frame, towards) * inverse;
    return k.ggx_lobe(l, view, alpha_x, alpha_y) * k.fresnel_schlick(f0, f90, dot(view, k.microfacet_half_vector(l, view)));
  }
};

// The direction about which a lobe lies, in the light's axes, and its width; the integral at radiance 1.
struct Peak {
  PackVec3 axis;
  PackReal width, integral;
  bool controls;  // the radiance there controls the sum
};

class Means {
 public:
  Means(const ProfiledLight& light, const ProfileTable& table)
      : light_(light), table_(table), candela_(table), outline_(light.outline()), axes_(light.emission().axes) {
    const auto flat = [&](Vec3d v) { return Flat{PackReal(dot(v, axes_.x)), PackReal(dot(v, axes_.y))}; };
    x_ = flat(outline_.x), y_ = flat(outline_.y);
    area_ = length(cross(outline_.x, outline_.y));
  }

  STERADIAN_INLINE PackVec3 in_axes(const PackVec3& v) const {
    return {dot(v, single(axes_.x)), dot(v, single(axes_.y)), dot(v, single(axes_.aim))};
  }
  STERADIAN_INLINE PackVec3 from_center(const PackVec3& position) const { return in_axes(position - single(outline_.center)); }

  // p: the points, in the light's axes from its centre. lobe_here(): the lobe and its peak, for packs that need them.
  template <class LobeHere>
  STERADIAN_INLINE void find(const PackVec3& p, const Lanes& wanted, LobeHere lobe_here, float* candela, float* found) const {
    const PackReal beside2 = p.x * p.x + p.y * p.y, beside = sqrt(beside2), reach(light_.reach());
    const PackReal inner = max(beside - reach, PackReal(0.0)), outer = beside + reach;
    const auto half_sine_at = [&](const PackReal& b) { return half_sine(p.z, b * b, max(sqrt(b * b + p.z * p.z), PackReal(1e-18))); };
    const PackReal a = half_sine_at(inner), b = half_sine_at(outer);
    alignas(64) std::array<float, kLanes> from, to, least, most;
    store(from.data(), min(a, b));
    store(to.data(), max(a, b));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const ProfileTable::Range range = table_.range(from[lane], to[lane]);
      least[lane] = range.least, most[lane] = range.most;
    }
    const PackReal low = load(least.data()), high = load(most.data());
    PackReal mean = PackReal(0.5) * (low + high);
    const PackReal even = PackReal(2 * static_cast<double>(ProfiledLight::kEven));
    Lanes open = wanted && high - low > even * high, served = wanted;
    if (any_lane(open)) {
      const auto [lobe, peak] = lobe_here();
      const PackReal distance = sqrt(max(beside2 + p.z * p.z, PackReal(1e-36)));
      const PackReal near = max(max(distance - reach, abs(p.z)), PackReal(1e-18)), span = (reach + reach) / near;
      const PackVec3 off = p * (PackReal(-1.0) / distance) - peak.axis;
      const PackReal from_peak = sqrt(dot(off, off)) - PackReal(0.5) * span;
      // The middle strips of a disk are wider than the others.
      const PackReal size = span * PackReal(outline_.round ? 0.5 * std::numbers::pi : 1.0), most_strips(static_cast<double>(kMostStrips));
      const PackReal for_lobe = size / (PackReal(kLobeSpacing) * max(peak.width, from_peak));
      const PackReal least_count = max(for_lobe, size * PackReal(1 / kWidestSpacing));
      const PackReal count = min(max(for_lobe, size * PackReal(1 / kKernelSpacing)), most_strips);
      const Lanes too_many = least_count > most_strips;
      served = served && !(open && too_many);
      open = open && !too_many;
      if (any_lane(open)) {
        alignas(64) std::array<float, kLanes> counts;
        store(counts.data(), select(open, count, PackReal(0.0)));
        const int needed = static_cast<int>(std::ceil(*std::max_element(counts.begin(), counts.end())));
        const int strips = std::max(needed, outline_.round ? kLeastStripsOfDisk : kLeastStrips);
        // Along a disk's strips only the lobe changes, and the profile by their curvature.
        const int across = outline_.round ? std::max(2 * needed / 3, kLeastAcross) : strips;
        const PackReal summed = sum(p, lobe, peak, strips, across, low, high, mean);
        mean = select(open, summed, mean);
      }
    }
    store(candela, mean);
    store(found, select(served, PackReal(1.0), PackReal(0.0)));
  }

 private:
  struct Flat {
    PackReal x, y;
  };
  static PackVec3 single(Vec3d v) { return broadcast(static_cast<Vec3f>(v)); }

  // The sum over the grid. fallback: the result where the lobe covers nothing of it.
  template <class L>
  STERADIAN_INLINE PackReal sum(const PackVec3& p, const L& lobe, const Peak& peak, int strips, int across, const PackReal& least,
                                const PackReal& most, const PackReal& fallback) const {
    // Axes of the grid. A disk's first one is turned to where the distance from the normal changes most.
    Flat g = x_, h = y_;
    if (outline_.round) {
      const PackReal a = -(p.x * x_.x + p.y * x_.y), b = -(p.x * y_.x + p.y * y_.y), l2 = a * a + b * b;
      const PackReal inverse = inversesqrt(max(l2, PackReal(1e-36)));
      const Lanes turned = l2 > PackReal(1e-30);
      const PackReal c = select(turned, a * inverse, PackReal(1.0)), s = select(turned, b * inverse, PackReal(0.0));
      g = {c * x_.x + s * y_.x, c * x_.y + s * y_.y};
      h = {c * y_.x - s * x_.x, c * y_.y - s * x_.y};
    }
    PackReal seen(0.0), weight(0.0);
    const Strips& grid = strips_of(outline_.round, strips);
    const PackReal least_half(static_cast<double>(table_.least_half())), quarter_height = PackReal(0.25) * abs(p.z);
    for (int i = 0; i < strips; ++i) {
      const Strip& strip = grid.all[static_cast<std::size_t>(i)];
      const double area = static_cast<double>(strip.area) / across * area_, along = static_cast<double>(strip.along);
      const PackReal u(static_cast<double>(strip.middle)), half_u(static_cast<double>(strip.half)), half_v(along / across);
      for (int j = 0; j < across; ++j) {
        const PackReal v(along * ((2 * j + 1.0) / across - 1));
        const PackVec3 to(u * g.x + v * h.x - p.x, u * g.y + v * h.y - p.y, -p.z);
        const PackReal beside2 = to.x * to.x + to.y * to.y, distance2 = max(beside2 + p.z * p.z, PackReal(1e-30));
        const PackReal inverse = inversesqrt(distance2), distance = distance2 * inverse;
        const PackReal t = half_sine(p.z, beside2, distance);
        // As in profiled_strips.cpp.
        const PackReal rate = quarter_height * inverse * inverse * inverse / max(t, PackReal(1e-6));
        const PackReal a = half_u * (to.x * g.x + to.y * g.y), b = half_v * (to.x * h.x + to.y * h.y);
        const PackReal half = max(rate * sqrt(a * a + b * b), least_half);
        const PackReal w = lobe.at(to, inverse) * (inverse * inverse * PackReal(area));
        seen = seen + w * candela_.mean(t, half, -to.x, -to.y);
        weight = weight + w * (abs(p.z) * inverse);
      }
    }
    const Lanes some = weight > PackReal(1e-30);
    PackReal mean = select(some, seen / select(some, weight, PackReal(1.0)), fallback);
    if (!peak.controls) return mean;
    // Times the integral, the radiance at the peak has no error where the lobe is narrowest.
    const PackReal distance = p.z / -peak.axis.z, x = p.x + peak.axis.x * distance, y = p.y + peak.axis.y * distance;
    const PackReal turn = x_.x * y_.y - x_.y * y_.x, a = (x * y_.y - y * y_.x) / turn, b = (y * x_.x - x * x_.y) / turn;
    const Lanes inside = outline_.round ? a * a + b * b < PackReal(1.0) : max(abs(a), abs(b)) < PackReal(1.0);
    const Lanes hit = some && peak.integral > PackReal(0.0) && distance > PackReal(0.0) && inside && abs(peak.axis.z) > PackReal(1e-4);
    if (!any_lane(hit)) return mean;
    const PackReal t = half_sine(-peak.axis.z, peak.axis.x * peak.axis.x + peak.axis.y * peak.axis.y, PackReal(1.0));
    const PackReal here = candela_.mean(t, least_half, -peak.axis.x, -peak.axis.y) / max(abs(peak.axis.z), PackReal(1e-4));
    const PackReal controlled = here + (seen - here * weight) / select(hit, peak.integral, PackReal(1.0));
    return select(hit && here > PackReal(0.0), min(max(controlled, least), most), mean);
  }

  const ProfiledLight& light_;
  const ProfileTable& table_;
  const Candela candela_;
  const ProfiledLight::Outline outline_;
  const ProfileAxes axes_;
  Flat x_, y_;
  double area_ = 0;
};

template <class L>
struct LobeAndPeak {
  L lobe;
  Peak peak;
};

__attribute__((flatten)) void diffuse(const ProfiledLight& light, const Points& points, const float* wanted, const ProfiledMeans& means) {
  const Means of(light, *light.table());
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const Lanes here = load(wanted + i) > PackReal(0.0);
    if (!any_lane(here)) {
      store(means.found + i, PackReal(0.0));
      continue;
    }
    of.find(
        of.from_center(load(points.position, i)), here,
        [&] {
          const PackVec3 normal = of.in_axes(load(points.normal, i));
          return LobeAndPeak<DiffuseLobe>{{normal}, {normal, PackReal(1.0), PackReal(0.0), false}};
        },
        means.candela + i, means.found + i);
  }
}

__attribute__((flatten)) void ggx(const ProfiledLight& light, const Points& points, const ProfiledLobes& lobes,
                                  const ProfiledMeans& means) {
  const Means of(light, *light.table());
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackReal integral = load(lobes.integral + i);
    const Lanes here = integral > PackReal(0.0);
    if (!any_lane(here)) {
      store(means.found + i, PackReal(0.0));
      continue;
    }
    of.find(
        of.from_center(load(points.position, i)), here,
        [&] {
          K k;
          const auto frame = k.frame_from_normal_and_view(load(points.normal, i), load(points.tangent, i));
          const PackVec3 view = transform_transposed(frame, load(points.view, i));
          K::mat3 turned;
          turned.c0 = of.in_axes(frame.c0), turned.c1 = of.in_axes(frame.c1), turned.c2 = of.in_axes(frame.c2);
          const PackReal alpha_x = load(points.alpha_x + i), alpha_y = load(points.alpha_y + i);
          const PackVec3 mirror = turned.c0 * -view.x + turned.c1 * -view.y + turned.c2 * view.z;
          return LobeAndPeak<GgxLobe>{{turned, view, alpha_x, alpha_y, load(lobes.f0 + i), load(lobes.f90 + i)},
                                      {mirror, PackReal(2.0) * min(alpha_x, alpha_y), integral, true}};
        },
        means.candela + i, means.found + i);
  }
}

}  // namespace

const ProfiledMeansTable& profiled_means_table() {
  static constexpr ProfiledMeansTable table = {diffuse, ggx};
  return table;
}

STERADIAN_END_ISA
