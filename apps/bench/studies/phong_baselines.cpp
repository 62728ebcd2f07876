#include "bench/studies/phong_baselines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "integrals/phong/phong.h"

namespace steradian::moment {
namespace {

// Unit directions of the light's corners in walk order, about the mirrored view r.
struct SeenPolygon {
  std::vector<Vec3d> corners;
  Vec3d mirror;
  double solid_angle = 0;
  Vec3d mean{};  // integral of the direction over the light
};

double solid_angle_of(const std::vector<Vec3d>& v) {
  double sum = 0;  // signed triangles of a fan: van Oosterom, Strackee 1983
  for (std::size_t i = 1; i + 1 < v.size(); ++i)
    sum += 2 * std::atan2(dot(v[0], cross(v[i], v[i + 1])), 1 + dot(v[0], v[i]) + dot(v[i], v[i + 1]) + dot(v[i + 1], v[0]));
  return sum;
}

Vec3d mean_of(const std::vector<Vec3d>& v) {
  Vec3d sum{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3d c = cross(v[i], v[(i + 1) % v.size()]);
    const double sine = length(c);
    if (sine > 0) sum = sum + c * (0.5 * std::atan2(sine, dot(v[i], v[(i + 1) % v.size()])) / sine);
  }
  return sum;
}

SeenPolygon seen_from(const PreparedPolygon& light, const ShadingPoint& at) {
  SeenPolygon seen;
  const Vec3d n = normalized(at.normal), v = normalized(at.view);
  seen.mirror = n * (2 * dot(n, v)) - v;
  if (light.side_of(at.position) <= 0) return seen;
  for (const Vec3d& p : light.vertices) seen.corners.push_back(normalized(p - at.position));
  seen.solid_angle = solid_angle_of(seen.corners);
  seen.mean = mean_of(seen.corners);
  if (seen.solid_angle < 0) {  // prepared in reverse order
    seen.solid_angle = -seen.solid_angle;
    seen.mean = seen.mean * -1.0;
    std::reverse(seen.corners.begin(), seen.corners.end());
  }
  return seen;
}

// Computes (1 - exp(-2 x))/x. The product with the factor that follows does not overflow.
double one_minus_exp_over(double x) { return x > 1e-8 ? -std::expm1(-2 * x) / x : 2; }

struct Flat {
  double x, y;
};
Flat to_plane(const Frame& frame, Vec3d direction) {
  const Vec3d l = frame.to_local(direction);
  return {l.x / l.z, l.y / l.z};
}

double area_and_middle(const std::vector<Flat>& p, Flat& middle) {
  double area = 0;
  middle = {0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Flat &a = p[i], &b = p[(i + 1) % p.size()];
    const double c = 0.5 * (a.x * b.y - a.y * b.x);
    area += c;
    middle.x += c * (a.x + b.x) / 3;
    middle.y += c * (a.y + b.y) / 3;
  }
  if (area != 0) middle = {middle.x / area, middle.y / area};
  return area;
}

// The part of a polygon on the left of the line from a to b: Sutherland, Hodgman 1974.
std::vector<Flat> left_of(const std::vector<Flat>& polygon, Flat a, Flat b) {
  std::vector<Flat> result;
  const auto side = [&](Flat p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Flat p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double sp = side(p), sq = side(q);
    if (sp >= 0) result.push_back(p);
    if ((sp >= 0) != (sq >= 0)) result.push_back({p.x + (q.x - p.x) * sp / (sp - sq), p.y + (q.y - p.y) * sp / (sp - sq)});
  }
  return result;
}

}  // namespace

double by_spherical_gaussian(const PreparedPolygon& light, const ShadingPoint& at, double n) {
  const SeenPolygon seen = seen_from(light, at);
  const double length_of_mean = length(seen.mean);
  if (!(length_of_mean > 0)) return 0;
  const double r = std::min(length_of_mean / seen.solid_angle, 1 - 1e-9);
  const double sharpness = r * (3 - r * r) / (1 - r * r);  // sharpness for that mean cosine: Banerjee et al. 2005
  const double peak = seen.solid_angle / (2 * std::numbers::pi * one_minus_exp_over(sharpness));
  const Vec3d axis = seen.mean / length_of_mean;
  const double together = length(axis * sharpness + seen.mirror * n);
  return (n + 1) / (2 * std::numbers::pi) * peak * std::exp(together - sharpness - n) * 2 * std::numbers::pi * one_minus_exp_over(together);
}

double by_anisotropic_gaussian(const PreparedPolygon& light, const ShadingPoint& at, double n) {
  const SeenPolygon seen = seen_from(light, at);
  if (!(length(seen.mean) > 0)) return 0;
  const Frame frame = Frame::from_normal(normalized(seen.mean));
  if (!(frame.to_local(seen.mirror).z > 0)) return 0;
  std::vector<Flat> p;
  for (const Vec3d& v : seen.corners) {
    if (!(dot(v, frame.z) > 1e-3)) return by_spherical_gaussian(light, at, n);
    p.push_back(to_plane(frame, v));
  }
  Flat middle;
  const double area = area_and_middle(p, middle);
  double xx = 0, xy = 0, yy = 0;  // second moments about the middle
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Flat a{p[i].x - middle.x, p[i].y - middle.y};
    const Flat b{p[(i + 1) % p.size()].x - middle.x, p[(i + 1) % p.size()].y - middle.y};
    const double c = (a.x * b.y - a.y * b.x) / (24 * area);
    xx += 2 * c * (a.x * a.x + a.x * b.x + b.x * b.x);
    yy += 2 * c * (a.y * a.y + a.y * b.y + b.y * b.y);
    xy += c * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y);
  }
  xx += 1 / n;
  yy += 1 / n;
  const double determinant = xx * yy - xy * xy;
  const Flat r = to_plane(frame, seen.mirror);
  const double dx = r.x - middle.x, dy = r.y - middle.y;
  const double far = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / determinant;
  return (n + 1) / n * seen.solid_angle / (2 * std::numbers::pi * std::sqrt(determinant)) * std::exp(-0.5 * far);
}

double by_representative_point(const PreparedPolygon& light, const ShadingPoint& at, double n) {
  const SeenPolygon seen = seen_from(light, at);
  if (seen.corners.empty()) return 0;
  const Frame frame = Frame::from_normal(seen.mirror);
  // Corners in the plane that touches the sphere at r; directions behind it are skipped.
  std::vector<Flat> p;
  for (std::size_t i = 0; i < seen.corners.size(); ++i) {
    const Vec3d a = frame.to_local(seen.corners[i]), b = frame.to_local(seen.corners[(i + 1) % seen.corners.size()]);
    constexpr double kLeast = 1e-3;
    if (a.z >= kLeast) p.push_back({a.x / a.z, a.y / a.z});
    if ((a.z >= kLeast) == (b.z >= kLeast)) continue;
    const Vec3d c = a + (b - a) * ((kLeast - a.z) / (b.z - a.z));
    p.push_back({c.x / c.z, c.y / c.z});
  }
  const double cosine = 1 - 1 / (n + 1), radius = std::sqrt(1 - cosine * cosine) / cosine;
  constexpr int kCorners = 48;  // corners of the cone, with the circle's area
  const double wide = radius * std::sqrt(2 * std::numbers::pi / kCorners / std::sin(2 * std::numbers::pi / kCorners));
  for (int k = 0; k < kCorners && p.size() > 2; ++k) {
    const double t0 = 2 * std::numbers::pi * k / kCorners, t1 = 2 * std::numbers::pi * (k + 1) / kCorners;
    p = left_of(p, {wide * std::cos(t0), wide * std::sin(t0)}, {wide * std::cos(t1), wide * std::sin(t1)});
  }
  if (p.size() < 3) return 0;
  Flat middle;
  const double area = area_and_middle(p, middle);
  if (!(area > 0)) return 0;
  std::vector<Vec3d> part;
  for (const Flat& f : p) part.push_back(normalized(Vec3d{f.x, f.y, 1}));
  const double towards = 1 / std::sqrt(1 + middle.x * middle.x + middle.y * middle.y);
  return (n + 1) / (2 * std::numbers::pi) * std::pow(towards, n) * solid_angle_of(part);
}

namespace {

using BaselineKernels = Kernels<double>;

// x_w of one variant, divided by its limit for c -> 0. The nodes are dense towards c = 1, where it changes fastest, and even in log n.
class HalfWidthTable {
 public:
  explicit HalfWidthTable(int f_is_x) {
    for (std::size_t j = 0; j < kExponents; ++j)
      for (std::size_t i = 0; i < kCosines; ++i) {
        const double t = std::max(static_cast<double>(i), 0.01) / (kCosines - 1);
        rows_[j][i] = half_width(1 - t * t * (1 - kLeastCosine), std::pow(kMost, static_cast<double>(j) / (kExponents - 1)), f_is_x);
      }
  }
  double look_up(double c, double n) const {
    const double x = std::sqrt(std::clamp((1 - c) / (1 - kLeastCosine), 0.0, 1.0)) * (kCosines - 1);
    const double y = std::clamp(std::log(n) / std::log(kMost), 0.0, 1.0) * (kExponents - 1);
    const auto i = std::min(static_cast<std::size_t>(x), kCosines - 2), j = std::min(static_cast<std::size_t>(y), kExponents - 2);
    const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
    return (1 - v) * ((1 - u) * rows_[j][i] + u * rows_[j][i + 1]) + v * ((1 - u) * rows_[j + 1][i] + u * rows_[j + 1][i + 1]);
  }

 private:
  static constexpr std::size_t kCosines = 64, kExponents = 32;
  static constexpr double kMost = 1e4, kLeastCosine = 0.01;
  std::array<std::array<double, kCosines>, kExponents> rows_{};

  static double half_width(double c, double n, int f_is_x) {
    BaselineKernels k;
    const double s2 = (1 - c) * (1 + c);
    const auto height = [&](double phi) { return k.moment_peak_height(s2, c * c, n, f_is_x, std::cos(phi), std::sin(phi)).v; };
    double low = 0, high = std::numbers::pi / 2;
    for (int step = 0; step < 50; ++step) (height(0.5 * (low + high)) > 0.5 * height(0) ? low : high) = 0.5 * (low + high);
    return low / (f_is_x == 1 ? std::numbers::pi / 3 : std::numbers::pi / 4);
  }
};

// The kernel's peak with another half width: recomputes the values that depend on x_w.
BaselineKernels::MomentPeak with_half_width(BaselineKernels::MomentPeak p, const BaselineKernels::MomentEdge& edge, double n, int f_is_x,
                                            double ratio) {
  BaselineKernels k;
  const double widest = f_is_x == 1 ? std::numbers::pi / 3 : std::numbers::pi / 4;
  const auto height = [&](const auto& phi) {
    return k.moment_peak_height(edge.s * edge.s, edge.c * edge.c, n, f_is_x, k.moment_peak_cosine(phi), k.moment_peak_sine(phi));
  };
  p.ratio_w = ratio;
  p.x_w = widest * ratio;
  p.x_t = std::min(p.x_w.v + 0.3946 * widest * (1 - std::pow(1 - ratio, 12)), std::numbers::pi / 2);  // eq. 14
  const double scale = 1 / std::max(p.peak.v, 1e-12);
  p.y_w = std::clamp(scale * height(p.x_w).v, 0.01, 0.99);
  p.y_t = scale * height(p.x_t).v;
  return p;
}

BaselineKernels::MomentFit fit_of(Method method, const BaselineKernels::MomentEdge& edge, const BaselineKernels::MomentPeak& p) {
  BaselineKernels k;
  if (method == Method::lorentzian) return k.moment_fit_lorentzian(p);
  if (method == Method::pearson) return k.moment_fit_blended(p, k.moment_fit_lorentzian(p), k.moment_fit_pearson(p));
  return k.moment_fit_blended(p, k.moment_fit_ellipsoid(edge, p), k.moment_fit_ellipsoid_squared(edge, p));
}

template <Method method>
double by_table(const PreparedPolygon& light, const ShadingPoint& at, double n) {
  return by_peak_fit_with_table(method, light, at, n);
}

}  // namespace

double by_peak_fit_with_table(Method method, const PreparedPolygon& light, const ShadingPoint& at, double n) {
  static const HalfWidthTable tables[2] = {HalfWidthTable(0), HalfWidthTable(1)};
  BaselineKernels k;
  const int f_is_x = integrals::takes_x({.method = method}, false);
  const SeenPolygon seen = seen_from(light, at);
  const auto corner = [&](std::size_t i) {
    const Vec3d v = seen.corners[i % seen.corners.size()];
    return BaselineKernels::vec3(v.x, v.y, v.z);
  };
  double sum = 0;
  for (std::size_t i = 0; i < seen.corners.size(); ++i) {
    const auto edge = k.moment_edge(corner(i), corner(i + 1), BaselineKernels::vec3(seen.mirror.x, seen.mirror.y, seen.mirror.z));
    const auto p = with_half_width(k.moment_peak_prepare(edge, n, f_is_x), edge, n, f_is_x, tables[f_is_x].look_up(edge.c.v, n));
    sum += k.moment_edge_share(edge, k.moment_fit_front(edge, p, fit_of(method, edge, p), f_is_x)).v;
  }
  return std::clamp(sum / (2 * std::numbers::pi), 0.0, 1.0);
}

const std::vector<Baseline>& phong_baselines() {
  static const std::vector<Baseline> baselines = {
      {"lorentzian, x_w by table", by_table<Method::lorentzian>}, {"pearson, x_w by table", by_table<Method::pearson>},
      {"ellipsoid, x_w by table", by_table<Method::ellipsoid>},   {"spherical Gaussian", by_spherical_gaussian},
      {"anisotropic Gaussian", by_anisotropic_gaussian},          {"representative point", by_representative_point}};
  return baselines;
}

}  // namespace steradian::moment
