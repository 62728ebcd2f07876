#include "integrals/phong/exact_moment.h"

#include <cmath>

namespace steradian {
namespace {

using K = Kernels<double>;

constexpr int kDeepest = 30;          // halvings; a piece is then below rounding
constexpr double kTolerance = 1e-14;  // of one piece; a quadrilateral has some dozens

K::MomentIntegrands sum_of(K::MomentIntegrands a, K::MomentIntegrands b) {
  a.moment += b.moment;
  a.power += b.power;
  return a;
}

K::MomentIntegrands refine(const K::MomentQuadrature& q, double low, double high, K::MomentIntegrands whole, int depth) {
  K k;
  const double mid = 0.5 * (low + high);
  const auto left = k.moment_quadrature_piece(q, low, mid), right = k.moment_quadrature_piece(q, mid, high);
  const auto halves = sum_of(left, right);
  const double change = std::fmax(std::fabs(halves.moment.v - whole.moment.v), std::fabs(halves.power.v - whole.power.v));
  if (depth == kDeepest || change <= kTolerance) return halves;
  return sum_of(refine(q, low, mid, left, depth + 1), refine(q, mid, high, right, depth + 1));
}

K::MomentIntegrands integrate(const K::MomentQuadrature& q, double low, double high) {
  K k;
  return refine(q, low, high, k.moment_quadrature_piece(q, low, high), 0);
}

}  // namespace

K::MomentIntegrands integrate_front(const K::MomentEdge& edge, double n) {
  K k;
  const auto q = k.moment_quadrature_prepare(edge, n);
  const double t0 = q.t0.v, t1 = q.t1.v;
  if (!(t0 < t1)) {
    K::MomentIntegrands nothing;
    nothing.moment = 0.0;
    nothing.power = 0.0;
    return nothing;
  }
  if (t0 < 0 && t1 > 0) return sum_of(integrate(q, t0, 0), integrate(q, 0, t1));
  return integrate(q, t0, t1);
}

}  // namespace steradian
