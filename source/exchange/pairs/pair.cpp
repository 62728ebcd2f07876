#include "exchange/pairs/pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "exchange/pairs/edge_pair.h"
#include "exchange/pairs/gauss_rules.h"

namespace steradian::exchange {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPairUnit = 0x1p-53;

struct WeightedPoint {
  Vec3d at;
  double weight;  // part of the area
};

// Nodes of m a side: a product of Gauss rules on a parallelogram, the same folded onto a corner on a triangle (degree 2 m - 2).
std::vector<WeightedPoint> nodes_on(const PlaneElement& e, int m) {
  const GaussRule& rule = gauss_rule(m);
  std::vector<WeightedPoint> nodes;
  for (std::size_t i = 0; i < rule.node.size(); ++i)
    for (std::size_t j = 0; j < rule.node.size(); ++j) {
      const double s = rule.node[i], t = rule.node[j], w = rule.weight[i] * rule.weight[j];
      if (e.is_parallelogram()) {
        nodes.push_back({e.centroid + e.half_a * (2 * s - 1) + e.half_b * (2 * t - 1), w * e.area});
      } else {
        const std::vector<Vec3d>& v = e.contours[0];
        nodes.push_back({v[0] + (v[1] - v[0]) * s + (v[2] - v[1]) * (s * t), w * 2 * s * e.area});
      }
    }
  return nodes;
}

// Remainder of a positive rule of degree d: T_d of docs/theory/view_factors.md.
double tail(int d, double t) {
  return t < 1 ? std::pow(t, d + 1) * ((d + 2) - (d + 1) * t) / ((1 - t) * (1 - t)) : std::numeric_limits<double>::infinity();
}

// g_m (2 m + 1): the remainder of m Gauss nodes on [-1, 1] for the derivative of order 2 m over its factorial.
constexpr double kGaussRemainder[] = {0, 1, 4.0 / 9, 8.0 / 50, 128.0 / 2450, 128.0 / 7938, 512.0 / 106722};

bool serves_product(const PlaneElement& e) { return e.is_parallelogram() || (e.contours.size() == 1 && e.contours[0].size() == 3); }

double perimeter_of(const PlaneElement& e) {
  double sum = 0;
  for (const auto& loop : e.contours)
    for (std::size_t i = 0; i < loop.size(); ++i) sum += length(loop[(i + 1) % loop.size()] - loop[i]);
  return sum;
}

}  // namespace

double product_bound(const PlaneElement& a, const PlaneElement& b, double distance, int m) {
  if (!(distance > 0)) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const PlaneElement* e : {&a, &b}) {
    if (e->is_parallelogram()) {
      for (const Vec3d& h : {e->half_a, e->half_b}) sum += kGaussRemainder[m] * std::pow(dot(h, h) / (distance * distance), m);
      sum += e->skew / distance;
    } else {
      // By the distance from the centroid.
      const double from_middle = distance + e->radius;
      sum += 2 * tail(2 * m - 2, e->radius / from_middle) * (distance * distance) / (from_middle * from_middle);
    }
  }
  return sum;
}

ExchangeArea exchange_by_product(const PlaneElement& a, const PlaneElement& b, int m) {
  const std::vector<WeightedPoint> on_a = nodes_on(a, m), on_b = nodes_on(b, m);
  double sum = 0, size = 0;
  for (const WeightedPoint& p : on_a)
    for (const WeightedPoint& q : on_b) {
      const Vec3d r = q.at - p.at;
      const double r2 = dot(r, r), term = p.weight * q.weight * dot(r, a.normal) * -dot(r, b.normal) / (r2 * r2);
      sum += term;
      size += std::fabs(term);
    }
  const double distance = length(a.centroid - b.centroid) - a.radius - b.radius;
  const double bound = a.area * b.area / (kPi * distance * distance) * product_bound(a, b, distance, m);
  // Rounding of the cosines is that of the distance, not of the height.
  const double middle = length(a.centroid - b.centroid),
               rounding = 16 * kPairUnit * (size / kPi + a.area * b.area / (kPi * middle * middle));
  return {sum / kPi, bound + rounding, static_cast<int>(on_a.size() * on_b.size())};
}

ExchangeArea exchange_by_contours(const PlaneElement& a, const PlaneElement& b, double eps) {
  const Vec3d origin = (a.centroid + b.centroid) * 0.5, way = b.centroid - a.centroid;
  const double unit = std::max(length(way), 0.5 * (a.radius + b.radius));
  const double edges = perimeter_of(a) * perimeter_of(b) / (unit * unit);
  // A first guess of the exchange area, from the middles; the error that comes out decides whether to try again.
  const double facing = std::fabs(dot(way, a.normal) * dot(way, b.normal)) / std::max(dot(way, way), 1e-300);
  const double guess = a.area * b.area * std::clamp(facing / (unit * unit), 0.01, 1.0) / (kPi * unit * unit * unit * unit);
  double tolerance = std::max(eps * guess, kPairUnit * edges);
  for (int attempt = 0;; ++attempt) {
    ExchangeArea sum;
    for (const auto& loop_a : a.contours)
      for (std::size_t i = 0; i < loop_a.size(); ++i) {
        const Vec3d p0 = (loop_a[i] - origin) / unit, p1 = (loop_a[(i + 1) % loop_a.size()] - origin) / unit;
        const double length_p = length(p1 - p0);
        if (!(length_p > 0)) continue;
        for (const auto& loop_b : b.contours)
          for (std::size_t j = 0; j < loop_b.size(); ++j) {
            const Vec3d q0 = (loop_b[j] - origin) / unit, q1 = (loop_b[(j + 1) % loop_b.size()] - origin) / unit;
            const double length_q = length(q1 - q0);
            if (!(length_q > 0)) continue;
            const double c = dot(p1 - p0, q1 - q0) / (length_p * length_q);
            if (std::fabs(c) < 1e-16) continue;
            // Each pair of edges may err by its part of the perimeters.
            const double enough = 2 * kPi * tolerance * length_p * length_q / edges;
            const LogIntegral j_pq = integrate_log(p0, p1, q0, q1, enough);
            sum.value += c * j_pq.value;
            sum.error += std::fabs(c) * j_pq.error + kPairUnit * std::fabs(j_pq.value) * 4;
            sum.evaluations += j_pq.evaluations;
          }
      }
    const double scale = unit * unit / (2 * kPi);
    sum.value *= scale;
    sum.error *= scale;
    const double reached = sum.error / (unit * unit), wanted = eps * sum.value / (unit * unit);
    if (attempt == 1 || reached <= wanted || tolerance <= kPairUnit * edges) {
      sum.value = std::max(sum.value, 0.0);
      return sum;
    }
    tolerance = std::max(0.5 * wanted, kPairUnit * edges);
  }
}

namespace {

ExchangeArea exchange_in_front(const PlaneElement& a, const PlaneElement& b, double eps) {
  if (a.is_empty() || b.is_empty()) return {};
  const Vec3d way = b.centroid - a.centroid;
  const double middle = length(way), distance = middle - a.radius - b.radius;
  const bool apart = distance > 0 && serves_product(a) && serves_product(b);
  if (apart) {
    // The bound counts against the exchange area itself, which is smaller by the cosines.
    const double facing = std::max(dot(way, a.normal), 0.0) * std::max(-dot(way, b.normal), 0.0) / (middle * middle);
    for (int m = 1; m <= kMostProductNodes; ++m) {
      if (!(product_bound(a, b, distance, m) <= 0.5 * eps * facing)) continue;
      const ExchangeArea far = exchange_by_product(a, b, m);
      if (far.error <= eps * far.value) return far;
    }
  }
  const ExchangeArea near = exchange_by_contours(a, b, eps);
  if (near.error <= eps * near.value || !apart) return near;
  // Far away the contours cancel; the product may still be the better one.
  const ExchangeArea far = exchange_by_product(a, b, kMostProductNodes);
  return far.error < near.error ? far : near;
}

}  // namespace

ExchangeArea exchange_area(const PlaneElement& first, const PlaneElement& second, double eps) {
  ExchangeArea h = exchange_in_front(in_front_of(first, second), in_front_of(second, first), eps);
  h.value = std::min(h.value, std::min(first.area, second.area));  // no factor is above 1
  return h;
}

}  // namespace steradian::exchange
