#include "exchange/pairs/far_pairs.h"

#include <cmath>

namespace steradian::exchange {
namespace {

// g_m (2 m + 1), as in pair.cpp.
constexpr double kRemainders[] = {1, 4.0 / 9, 8.0 / 50, 128.0 / 2450, 128.0 / 7938, 512.0 / 106722};

}  // namespace

ElementArrays::ElementArrays(const std::vector<PlaneElement>& elements)
    : count(elements.size()), stride((elements.size() + 2 * kPad - 1) / kPad * kPad), numbers(name_count * stride, 0.0) {
  kinds.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PlaneElement& e = elements[i];
    const auto set = [&](std::size_t name, double x) { numbers[name * stride + i] = x; };
    const auto set_vector = [&](std::size_t name, Vec3d v) {
      set(name, v.x);
      set(name + 1, v.y);
      set(name + 2, v.z);
    };
    set_vector(center_x, e.centroid);
    set_vector(normal_x, e.normal);
    set(area, e.area);
    set(radius, e.radius);
    set(off_plane, e.off_plane);
    set(skew, e.skew);
    ElementKind k = ElementKind::other;
    if (e.is_parallelogram()) {
      k = ElementKind::parallelogram;
      set_vector(origin_x, e.centroid - e.half_a - e.half_b);
      set_vector(a_x, e.half_a * 2.0);
      set_vector(b_x, e.half_b * 2.0);
      set_vector(reach_x, e.half_a);
      set_vector(span_x, e.half_b);
      const double a2 = dot(e.half_a, e.half_a) / (e.radius * e.radius), b2 = dot(e.half_b, e.half_b) / (e.radius * e.radius);
      for (int m = 1; m <= kLargestProduct; ++m)
        set(remainder_1 + static_cast<std::size_t>(m) - 1, kRemainders[m - 1] * (std::pow(a2, m) + std::pow(b2, m)));
    } else if (e.contours.size() == 1 && e.contours[0].size() == 3) {
      k = ElementKind::triangle;
      const std::vector<Vec3d>& v = e.contours[0];
      set_vector(origin_x, v[0]);
      set_vector(a_x, v[1] - v[0]);
      set_vector(b_x, v[2] - v[1]);
      set_vector(reach_x, v[0] - e.centroid);
      set_vector(span_x, v[1] - e.centroid);
      for (int m = 1; m <= kLargestProduct; ++m) set(remainder_1 + static_cast<std::size_t>(m) - 1, 4.0 * m);
    }
    set(kind, static_cast<double>(k));
    kinds.push_back(k);
  }
}

}  // namespace steradian::exchange
