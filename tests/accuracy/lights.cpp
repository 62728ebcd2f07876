// "Small, near and grazing lights", "Half vectors with shadowing", "Textured lights": methods at their limits.
#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <vector>

#include "fit/textured_error.h"
#include "sections.h"
#include "steradian/closed_form.h"
#include "steradian/ellipse_light.h"
#include "steradian/half_vector.h"
#include "steradian/ltc.h"
#include "steradian/phong.h"
#include "steradian/reference.h"
#include "support/random_rectangles.h"

namespace steradian::accuracy {
namespace {

using namespace fit;

using Evaluate = double (*)(const PreparedPolygon&, const ShadingPoint&, const Material&);
struct Row {
  const char* name;
  Brdf brdf;
  double width;  // alpha, or the exponent
  Evaluate evaluate;
};

constexpr Row kRows[] = {
    {"lambert, float", Brdf::lambert, 1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material&) {
       return static_cast<double>(polygon_irradiance_float(l, p.position, p.normal)) / M_PI;
     }},
    {"phong 50 by `series`", Brdf::phong, 50,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return phong_radiance(l, p, m, {}).x; }},
    {"the same in float", Brdf::phong, 50,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) {
       return static_cast<double>(phong_radiance_float(l, p, m, {}).x);
     }},
    {"ggx 0.1 by `closed-form`", Brdf::ggx, 0.1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return closed_form_radiance(l, p, m).x; }},
    {"the same in float", Brdf::ggx, 0.1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return closed_form_radiance_float(l, p, m).x; }},
    {"ggx 0.1 by `ltc`, float", Brdf::ggx, 0.1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return ltc_radiance_float(LtcMethod::classic, l, p, m).x; }},
    {"ggx 0.1 by `ltc-compact`, float", Brdf::ggx, 0.1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return ltc_radiance_float(LtcMethod::compact, l, p, m).x; }},
    {"beckmann 0.1 by `half-vector`", Brdf::beckmann, 0.1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return half_vector_radiance(l, p, m).x; }},
    {"the same in float", Brdf::beckmann, 0.1,
     [](const PreparedPolygon& l, const ShadingPoint& p, const Material& m) { return half_vector_radiance_float(l, p, m).x; }},
};

Material material_of(const Row& row) {
  Material m;
  m.brdf = row.brdf;
  m.exponent = row.width;
  m.alpha_x = m.alpha_y = row.width;
  return m;
}

struct Sum {
  double error = 0, signal = 0;
  void add(double value, double truth) {
    error += (value - truth) * (value - truth);
    signal += truth * truth;
  }
  double relative() const { return signal > 0 ? std::sqrt(error / signal) : 0; }
};

Vec3d view_at(double degrees) { return {std::sin(degrees * M_PI / 180), 0, std::cos(degrees * M_PI / 180)}; }

// A rectangle of half sides `size` and 0.6 `size` at the distance 1 about the mirror direction, tilted. Its distance from that direction is
// about the lobe's width.
PreparedPolygon rectangle(reference::Random& random, const ShadingPoint& at, double size) {
  const auto vector = [&] { return Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  Vec3d direction = normalized(Vec3d{-at.view.x, -at.view.y, at.view.z} + vector() * 0.15);
  direction.z = std::max(direction.z, 0.03);
  const Frame plane = Frame::from_normal(normalized(vector() * 0.5 - direction));
  PolygonLight light;
  const Vec3d x = plane.x * size, y = plane.y * (0.6 * size);
  light.vertices = {direction - x - y, direction + x - y, direction + x + y, direction - x + y};
  return prepare_polygon(light);
}

void write_table(std::ostream& out, const std::vector<double>& columns, int count, double (*size_of)(double),
                 double (*degrees_of)(double)) {
  for (const Row& row : kRows) {
    out << fmt::format("| {} |", row.name);
    for (const double column : columns) {
      reference::Random random(17);
      const ShadingPoint at = {{}, {0, 0, 1}, view_at(degrees_of(column))};
      const Material m = material_of(row);
      Sum sum;
      for (int i = 0; i < count; ++i) {
        const PreparedPolygon light = rectangle(random, at, size_of(column));
        sum.add(row.evaluate(light, at, m), reference_radiance(light, at, m, {1e-7, 1e-12, 100'000}).radiance.x);
      }
      out << fmt::format(" {:.1e} |", sum.relative());
    }
    out << "\n";
  }
}

}  // namespace

void write_lights(std::ostream& out) {
  out << "\n## Small and near lights\n\nRelative RMSE over 40 rectangles about the mirror direction of a view at 45 degrees, by their half "
         "side over their distance, "
         "against adaptive cubature (itself good to its share of the size that the rounding of vertices leaves).\n\n"
         "| lobe | 1e-8 | 1e-6 | 1e-4 | 1e-3 | 0.01 | 0.1 | 1 | 10 | 1000 |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  write_table(
      out, {1e-8, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 1, 10, 1000}, 40, [](double c) { return c; }, [](double) { return 45.0; });

  out << "\n## Grazing views\n\nThe same for half sides of 0.3, by the view's angle from the normal.\n\n| lobe | 80° | 86° | 89° | 89.9° "
         "|\n|---|---:|---:|---:|---:|\n";
  write_table(
      out, {80, 86, 89, 89.9}, 40, [](double) { return 0.3; }, [](double c) { return c; });

  out << "\n## Half vectors with shadowing and Fresnel\n\nMethod `half-vector` for GGX, 4 arcs an edge, on the rectangles of the section "
         "before last but one, with shadowing, against adaptive cubature: relative RMSE.\n\n"
         "| F0 | 5° | 45° | 75° | 85° |\n|---|---:|---:|---:|---:|\n";
  for (const double f0 : {1.0, 0.04}) {
    out << fmt::format("| {} |", f0);
    for (const double view : {5.0, 45.0, 75.0, 85.0}) {
      reference::Random random(static_cast<std::uint64_t>(view));
      Sum sum;
      for (const double alpha : {0.05, 0.1, 0.2, 0.4, 0.8})
        for (int i = 0; i < 30; ++i) {
          auto s = ggx::random_rectangle(random, std::sqrt(alpha), view);
          s.material.f0 = {f0, f0, f0};
          const PreparedPolygon light = prepare_polygon(s.light);
          sum.add(half_vector_radiance(light, s.at, s.material, {}).x,
                  reference_radiance(light, s.at, s.material, {1e-6, 1e-8, 100'000}).radiance.x);
        }
      out << fmt::format(" {:.4f} |", sum.relative());
    }
    out << "\n";
  }

  TexturedErrorOptions options;
  options.setups = 24;
  options.samples = 96;
  const auto rows = measure_textured_error(options);
  out << "\n## Textured lights\n\nRelative L2 error of the radiance over 24 square lights, GGX with F = 1 or a diffuse surface (roughness "
         "0), by distance in sides "
         "(docs/theory/ltc.md says of which kind); in brackets the error of the summed energy. The grid that judges is itself good to 0.3 "
         "%.\n\n"
      << textured_error_text(rows);
}

}  // namespace steradian::accuracy
