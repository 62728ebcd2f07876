#include "bench/studies/cie171_exact.h"

#include <cmath>
#include <numbers>

namespace steradian::cie171 {
namespace {

using std::numbers::pi;

// The factor of the rectangle from the foot of the point to (x, y), odd in x and y.
double corner_parallel(double x, double y, double h) {
  const double far_x = std::hypot(x, h), far_y = std::hypot(y, h);
  return (x / far_x * std::atan(y / far_x) + y / far_y * std::atan(x / far_y)) / (2 * pi);
}
double corner_perpendicular(double x, double y, double h) {
  const double away = std::hypot(x, h);
  return (std::atan(y / h) - h / away * std::atan(y / away)) / (2 * pi);
}

template <class Corner>
double between_corners(Corner corner, Span x, Span y, double h) {
  return corner(x.high, y.high, h) - corner(x.low, y.high, h) - corner(x.high, y.low, h) + corner(x.low, y.low, h);
}

// Gauss and Legendre with five nodes a panel: 64 x 64 panels err by less than 1e-13 where a panel is smaller than a fifth of its distance.
template <class Integrand>
double integral(Integrand f, Span u, Span v) {
  constexpr int kPanels = 64;
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double node[5] = {-outer, -inner, 0, inner, outer};
  const double heavy = (322 + 13 * std::sqrt(70.0)) / 900, light = (322 - 13 * std::sqrt(70.0)) / 900;
  const double weight[5] = {light, heavy, 128.0 / 225, heavy, light};
  const double half_u = (u.high - u.low) / (2 * kPanels), half_v = (v.high - v.low) / (2 * kPanels);
  double sum = 0;
  for (int i = 0; i < kPanels; ++i)
    for (int j = 0; j < kPanels; ++j)
      for (int k = 0; k < 5; ++k)
        for (int l = 0; l < 5; ++l)
          sum += weight[k] * weight[l] * f(u.low + half_u * (2 * i + 1 + node[k]), v.low + half_v * (2 * j + 1 + node[l]));
  return sum * half_u * half_v;
}

// Illuminance of a whole overcast sky with a zenith of 1: 7/9 pi.
constexpr double kWholeSky = 7 * pi / 9;

double overcast(double sine) { return (1 + 2 * sine) / 3; }

}  // namespace

double parallel_factor(Span x, Span y, double distance) { return between_corners(corner_parallel, x, y, distance); }

double perpendicular_factor(Span x, Span y, double distance) { return between_corners(corner_perpendicular, x, y, distance); }

double facing_rectangles(double a, double b, double distance) {
  const double x = a / distance, y = b / distance, xx = 1 + x * x, yy = 1 + y * y;
  return 2 / (pi * x * y) *
         (std::log(std::sqrt(xx * yy / (1 + x * x + y * y))) + x * std::sqrt(yy) * std::atan(x / std::sqrt(yy)) +
          y * std::sqrt(xx) * std::atan(y / std::sqrt(xx)) - x * std::atan(x) - y * std::atan(y));
}

double joined_rectangles(double h, double w) {
  const double hh = h * h, ww = w * w, all = 1 + hh + ww;
  return (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(hh + ww) * std::atan(1 / std::sqrt(hh + ww)) +
          (std::log((1 + ww) * (1 + hh) / all) + ww * std::log(ww * all / ((1 + ww) * (hh + ww))) +
           hh * std::log(hh * all / ((1 + hh) * (hh + ww)))) /
              4) /
         (pi * w);
}

double overcast_through_roof(Span x, Span y, double distance) {
  return integral(
             [distance](double u, double v) {
               const double square = u * u + v * v + distance * distance, cosine = distance / std::sqrt(square);
               return overcast(cosine) * cosine * cosine / square;
             },
             x, y) /
         kWholeSky;
}

double overcast_through_wall(Span x, Span z, double distance) {
  return integral(
             [distance](double u, double v) {
               const double square = u * u + v * v + distance * distance, away = std::sqrt(square);
               return overcast(v / away) * (v / away) * (distance / away) / square;
             },
             x, z) /
         kWholeSky;
}

}  // namespace steradian::cie171
