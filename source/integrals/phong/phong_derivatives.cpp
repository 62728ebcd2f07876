#include "integrals/phong/phong_derivatives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/gauss_kronrod.h"

namespace steradian::slopes {
namespace {

using integrals::to_kernel;
using K = Kernels<double>;
using V = K::vec3;

// Moments of the lobe f along an arc of a great circle, l = middle cos t + along sin t from -half to half.
struct ArcMoments {
  double cosine = 0, sine = 0;  // INT f cos t dt, INT f sin t dt
};

class PhongArc {
 public:
  // foreshortened: the light's cosine counts, too
  PhongArc(double exponent, Vec3d axis, bool foreshortened)
      : exponent_(exponent),
        axis_(axis),
        longest_(kWidths / std::sqrt(exponent + 1)),
        foreshortened_(foreshortened),
        has_root_(exponent < kSmooth && exponent != std::floor(exponent)) {}

  // On the arc, l.r is c cos x, with x the angle from the foot. So the lobe falls like a normal distribution of x. A piece of four of its
  // widths is within 1e-12 by Kronrod's rule. At the lobe's equator, an exponent that is not whole has a root.
  ArcMoments moments(Vec3d middle, Vec3d along, double half) const {
    const Circle circle = {dot(axis_, middle), dot(axis_, along), middle.z, along.z};
    if (circle.axis_middle == 0 && circle.axis_along == 0) return {};
    const double foot = std::atan2(circle.axis_along, circle.axis_middle);
    ArcMoments sum;
    for (const double turn : {-2 * std::numbers::pi, 0.0, 2 * std::numbers::pi}) {
      const double low = std::max(-half, foot + turn - 0.5 * std::numbers::pi), high = std::min(half, foot + turn + 0.5 * std::numbers::pi);
      if (high > low) add(sum, circle, foot + turn, low, high);
    }
    return sum;
  }

 private:
  static constexpr double kWidths = 4, kDepth = 40;
  static constexpr double kSmooth = 10;  // from this exponent on, the equator is darker than e^-40

  // Components of the lobe's axis and of the normal along the middle of an arc and along the direction there.
  struct Circle {
    double axis_middle, axis_along, z_middle, z_along;
  };

  // From low to high, where l.r = c cos(t - foot) is not negative.
  void add(ArcMoments& sum, const Circle& circle, double foot, double low, double high) const {
    const double brightest = std::cos(std::clamp(foot, low, high) - foot);
    if (exponent_ > 0 && brightest > 0) {
      // Beyond, the lobe is below e^-40 of its largest value on the arc.
      const double reach = std::acos(brightest * std::exp(-kDepth / exponent_));
      low = std::max(low, foot - reach);
      high = std::min(high, foot + reach);
    }
    if (!has_root_) return add_pieces(sum, circle, low, high);
    // Halvings towards the lobe's equator: no piece is longer than its distance from there, until the rest is below rounding.
    const auto halved = [&](double from, double to) {
      const double gap = std::max(0.5 * std::numbers::pi - std::fabs(to - foot), 0.0);
      for (double rest = 1; std::fabs(to - from) > gap && std::pow(rest, exponent_ + 1) > 1e-14; rest *= 0.5) {
        const double middle = 0.5 * (from + to);
        add_pieces(sum, circle, from, middle);
        from = middle;
      }
      add_pieces(sum, circle, from, to);
    };
    const double middle = 0.5 * (low + high);
    halved(middle, low);
    halved(middle, high);
  }

  // In either direction.
  void add_pieces(ArcMoments& sum, const Circle& circle, double from, double to) const {
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::fabs(to - from) / longest_)));
    const double step = 0.5 * (to - from) / pieces;
    // The nodes of all pieces lie at the same angles from their middles.
    std::array<double, 8> cosines, sines;
    for (std::size_t i = 0; i < 8; ++i) {
      cosines[i] = std::cos(step * reference::kKronrodHalfNodes[i]);
      sines[i] = std::sin(step * reference::kKronrodHalfNodes[i]);
    }
    for (int i = 0; i < pieces; ++i) {
      const double middle = from + step * (2 * i + 1), c = std::cos(middle), s = std::sin(middle);
      for (std::size_t j = 0; j < 8; ++j)
        for (const double side : {1.0, -1.0}) {
          if (j == 7 && side < 0) continue;
          const double at_c = c * cosines[j] - side * s * sines[j], at_s = s * cosines[j] + side * c * sines[j];
          const double cosine = circle.axis_middle * at_c + circle.axis_along * at_s;
          double f = reference::kKronrodHalfWeights[j] * std::fabs(step) * std::pow(std::max(cosine, 0.0), exponent_);
          if (foreshortened_) f *= circle.z_middle * at_c + circle.z_along * at_s;
          sum.cosine += f * at_c;
          sum.sine += f * at_s;
        }
    }
  }

  double exponent_;
  Vec3d axis_;
  double longest_;
  bool foreshortened_, has_root_;
};

// The middle of an arc above the horizon, the direction along it there, and half its angle.
struct MiddleArc {
  Vec3d middle, along;
  double half_cosine = 0, half_sine = 0;

  MiddleArc(Vec3d start, Vec3d end) {
    const Vec3d sum = start + end, chord = end - start;
    half_cosine = 0.5 * length(sum);
    half_sine = 0.5 * length(chord);
    middle = normalized(sum);
    along = normalized(chord);
  }
  bool is_usable() const { return half_cosine > 1e-12 && half_sine > 0; }
  double half() const { return std::atan2(half_sine, half_cosine); }
};

// Sum over all arcs of the visible outline, the horizon's too, of -INT f l x N ds: the derivative by a turn of outline and horizon. The
// lobe turns the other way.
class TurnOfAll {
 public:
  static constexpr integrals::Clip kClip = integrals::Clip::horizon;
  explicit TurnOfAll(const PhongArc& lobe) : lobe_(lobe) {}

  V end(const V& u) const { return u; }
  void add(const V& a, const V& b) {
    const MiddleArc arc(to_vector(a), to_vector(b));
    if (!arc.is_usable()) return;
    const ArcMoments m = lobe_.moments(arc.middle, arc.along, arc.half());
    sum_ += arc.along * m.cosine - arc.middle * m.sine;  // l x N = middle sin t - along cos t
  }
  Vec3d finish(Mask<double>) const { return sum_; }

 private:
  const PhongArc& lobe_;
  Vec3d sum_;
};

}  // namespace

PhongDerivatives phong_derivatives(const PreparedPolygon& light, int side, const ShadingPoint& at, const Material& m) {
  K k;
  const Frame frame = Frame::from_normal(at.normal);
  const Vec3d view = frame.to_local(normalized(at.view)), axis = {-view.x, -view.y, view.z};
  const PhongArc lobe(m.exponent, axis, m.foreshortening);
  const double scale = 0.5 * (m.exponent + 1) / std::numbers::pi;
  PhongDerivatives result;
  bool crosses = false;
  result.by_vertex = by_edges(light, side, at.position, frame, [&](const V& a, const V& b) -> EdgeDerivatives {
    crosses = crosses || a.z.v < 0 || b.z.v < 0;
    const auto part = k.edge_above_horizon(a, b);
    const MiddleArc arc(to_vector(part.start), to_vector(part.end));
    if (!arc.is_usable()) return {};
    const ArcMoments f = lobe.moments(arc.middle, arc.along, arc.half());
    // l = even (start + end) + odd (end - start)
    const double even = 0.5 * f.cosine / arc.half_cosine, odd = 0.5 * f.sine / arc.half_sine;
    const Vec3d n = cross(arc.middle, arc.along) * -scale;
    const double by_start = even - odd, by_end = even + odd;
    return {{n * (by_start * part.start_a.v + by_end * part.end_a.v), {}}, {n * (by_start * part.start_b.v + by_end * part.end_b.v), {}}};
  });
  if (m.foreshortening) return result;
  Vec3d turn;
  if (crosses) {
    TurnOfAll all(lobe);
    const auto shading = integrals::shading_from<double>(side, to_kernel<double>(view));
    turn = integrals::integrate_edges(integrals::contours_in<double>(light, frame, at.position), shading, all) * (scale * side);
  } else {
    turn = frame.to_local(turn_of(light, at.position, result.by_vertex).plain);
  }
  // The lobe turns about the mirrored view. Its derivative by that direction is cross(-turn, axis).
  const Vec3d by_axis = cross(axis, turn);
  const Vec3d by_view = {-by_axis.x, -by_axis.y, by_axis.z};
  result.by_view = frame.to_world(by_view - view * dot(by_view, view));
  return result;
}

}  // namespace steradian::slopes
