// Whole integrals against quadrature: polygons on Lambert surfaces, and on Phong lobes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <ostream>

#include "sections.h"
#include "steradian/phong.h"
#include "support/random_configurations.h"

namespace steradian::accuracy {
namespace {

struct Errors {
  int count = 0, lit = 0;
  double largest = 0, squares = 0;
  void add(double error) {
    ++count;
    largest = std::max(largest, std::fabs(error));
    squares += error * error;
  }
  double rms() const { return count > 0 ? std::sqrt(squares / count) : 0; }
};

}  // namespace

void write_lambert(std::ostream& out) {
  constexpr int kLights = 1000;
  reference::Random random(1);
  std::map<std::string, Errors> in_double, in_float;
  for (int i = 0; i < kLights; ++i) {
    const auto c = reference::random_configuration(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const double exact = polygon_irradiance(light, c.at.position, c.at.normal) / std::numbers::pi;
    const double single = static_cast<double>(polygon_irradiance_float(light, c.at.position, c.at.normal)) / std::numbers::pi;
    const ReferenceResult r = reference_radiance(light, c.at, Material{});
    in_double[c.kind].add(exact - r.radiance.x);
    in_float[c.kind].add(single - exact);
    in_double[c.kind].lit += exact > 0;
  }
  out << "\n## Polygon irradiance\n\n"
      << kLights
      << " random polygons, most of which cross the horizon, against adaptive quadrature (`reference`). Errors of the form\n"
         "factor, whose full value is 1. Float: against double, the frame and the vertices rounded to float on the way.\n\n"
         "| lights | lit | double, largest | double, rms | float, largest | float, rms |\n|---|---:|---:|---:|---:|---:|\n";
  for (const auto& [kind, d] : in_double)
    out << fmt::format("| {} | {} of {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", kind, d.lit, d.count, d.largest, d.rms(),
                       in_float[kind].largest, in_float[kind].rms());
}

void write_phong(std::ostream& out) {
  constexpr int kLights = 400;
  struct Row {
    const char* name;
    PhongOptions options;
  };
  const Row rows[] = {{"exact", {Method::exact}},         {"series", {Method::series}},   {"series, high", {Method::series, Quality::high}},
                      {"ellipsoid", {Method::ellipsoid}}, {"pearson", {Method::pearson}}, {"lorentzian", {Method::lorentzian}}};
  out << "\n## Phong lobes\n\n"
      << kLights
      << " random polygons as above for each exponent, against adaptive quadrature (`exact`) and against `exact` (the others).\n"
         "Errors as shares of the full lobe, largest and rms, in double.\n\n| method | n = 1 | 10 | 100 | 1000 | 5000 |\n"
         "|---|---:|---:|---:|---:|---:|\n";
  for (const Row& row : rows) {
    out << "| `" << row.name << "` |";
    for (const double n : {1.0, 10.0, 100.0, 1000.0, 5000.0}) {
      reference::Random random(3);
      Material material;
      material.brdf = Brdf::phong;
      material.exponent = n;
      Errors errors;
      for (int i = 0; i < kLights; ++i) {
        const auto c = reference::random_configuration(random);
        const PreparedPolygon light = prepare_polygon(c.light);
        const double value = phong_radiance(light, c.at, material, row.options).x;
        const double truth = row.options.method == Method::exact ? reference_radiance(light, c.at, material).radiance.x
                                                                 : phong_radiance(light, c.at, material, {Method::exact}).x;
        errors.add(value - truth);
      }
      out << fmt::format(" {:.1e}, {:.1e} |", errors.largest, errors.rms());
    }
    out << "\n";
  }
}

}  // namespace steradian::accuracy
