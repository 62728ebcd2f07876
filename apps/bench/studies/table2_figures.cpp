// The figures of docs/theory/moments.md: the integrand, its half width and the fits as plots; the scene and the errors.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/phong_plane.h"
#include "bench/studies/phong_baselines.h"
#include "bench/studies/line_plot.h"
#include "bench/studies/table2.h"
#include "core/files.h"
#include "core/float_mode.h"
#include "integrals/phong/phong.h"
#include "steradian/picture.h"

namespace steradian::moment {
namespace {

using FigureKernels = Kernels<double>;

constexpr double kQuarterTurn = std::numbers::pi / 2;

// An edge whose foot has the cosine c, from phi0 to phi1.
FigureKernels::MomentEdge edge_on_circle(double c, double phi0, double phi1) {
  FigureKernels::MomentEdge edge;
  edge.side = 1.0;
  edge.c = c;
  edge.s = std::sqrt(1 - c * c);
  edge.x0 = c * std::cos(phi0);
  edge.y0 = c * std::sin(phi0);
  edge.x1 = c * std::cos(phi1);
  edge.y1 = c * std::sin(phi1);
  edge.log_c = -2 * std::log(c);
  edge.swept = 0.0;
  return edge;
}

double integrand(double c, double n, double phi) {
  const double x = c * std::cos(phi);
  return (1 - std::pow(x, n + 1)) / (1 - x * x);
}

// Error of a method's integral, relative to the peak, by its integral over short pieces.
template <class Front>
PlotCurve error_of(const std::string& name, double c, double n, double phi_high, int colour, int pieces, Front front) {
  PlotCurve curve{name, {}, false, colour};
  for (int i = 0; i < pieces; ++i) {
    const double a = phi_high * i / pieces, b = phi_high * (i + 1) / pieces;
    const auto edge = edge_on_circle(c, a, b);
    const double phi = 0.5 * (a + b);
    curve.points.push_back({phi, (front(edge).v / edge.s.v / (b - a) - integrand(c, n, phi)) / integrand(c, n, 0)});
  }
  return curve;
}

LinePlot integrand_plot() {
  LinePlot plot{"The integrand (1 - x^m)/(1 - x^2), x = c cos phi, over its peak", "phi [rad]", "", 0, kQuarterTurn, 0, 1, {}};
  int colour = 0;
  for (const double n : {10.0, 100.0, 5000.0}) {
    for (const double c : {0.5, 0.95, 0.9999}) {
      char name[64];
      std::snprintf(name, sizeof name, "n = %g, c = %g", n, c);
      PlotCurve curve{name, {}, c < 0.9 || c > 0.99, colour};
      if (c > 0.99) curve.dashed = false;
      for (int i = 0; i <= 400; ++i) {
        const double phi = kQuarterTurn * i / 400;
        curve.points.push_back({phi, integrand(c, n, phi) / integrand(c, n, 0)});
      }
      plot.curves.push_back(curve);
      colour = (colour + 1) % 8;
    }
  }
  return plot;
}

LinePlot half_width_plot() {
  FigureKernels k;
  LinePlot plot{"Half width of the peak above its smallest value, and the published fit (dashed)", "c", "x_w [rad]", 0, 1, 0, 1.2, {}};
  int colour = 0;
  for (const double n : {10.0, 11.0, 100.0, 101.0, 5000.0, 5001.0}) {
    const int even_n = static_cast<int>(n) % 2 == 0;
    PlotCurve exact{
        even_n ? "n = " + std::to_string(static_cast<int>(n)) + ", f = x" : "n = " + std::to_string(static_cast<int>(n)) + ", f = 1",
        {},
        false,
        colour};
    PlotCurve fit{"", {}, true, colour++};
    for (int i = 1; i < 200; ++i) {
      const double c = i / 200.0, s2 = 1 - c * c;
      const auto height = [&](double phi) { return k.moment_peak_height(s2, c * c, n, even_n, std::cos(phi), std::sin(phi)).v; };
      double low = 0, high = kQuarterTurn;
      for (int step = 0; step < 50; ++step) (height(0.5 * (low + high)) > 0.5 * height(0) ? low : high) = 0.5 * (low + high);
      exact.points.push_back({c, low});
      fit.points.push_back({c, (even_n ? std::numbers::pi / 3 : std::numbers::pi / 4) * k.moment_peak_half_width_ratio(c, n, even_n).v});
    }
    plot.curves.push_back(exact);
    plot.curves.push_back(fit);
  }
  return plot;
}

LinePlot fits_plot(double n, double c, double highest, int pieces) {
  FigureKernels k;
  constexpr double phi_high = kQuarterTurn;
  const integrals::PhongLobe<double> lobe(n);
  char title[96];
  std::snprintf(title, sizeof title, "Errors of the methods' integrands over the peak, n = %g, c = %g", n, c);
  LinePlot plot{title, "phi [rad]", "", 0, phi_high, -highest, highest, {}};
  const auto add = [&](const std::string& name, int colour, auto front) {
    plot.curves.push_back(error_of(name, c, n, phi_high, colour, pieces, front));
  };
  for (const int f_is_x : {0, 1}) {
    const std::string form = f_is_x ? ", f = x" : ", f = 1";
    add("lorentzian" + form, 1, [&](const auto& e) { return k.moment_lorentzian_front(e, n, f_is_x); });
    add("pearson" + form, 2, [&](const auto& e) { return k.moment_pearson_front(e, n, f_is_x); });
    add("ellipsoid" + form, 5, [&](const auto& e) { return k.moment_ellipsoid_front(e, n, f_is_x); });
    for (std::size_t i = plot.curves.size() - 3; i < plot.curves.size(); ++i) plot.curves[i].dashed = f_is_x == 1;
  }
  add("series", 3, [&](const auto& e) { return k.moment_series_front(e, lobe.series); });
  add("series high", 0, [&](const auto& e) { return k.moment_series_high_front(e, lobe.series_high); });
  return plot;
}

constexpr int kWidth = 240, kHeight = 135;  // of a part of a sheet

// A sheet of small pictures of the plane, a row for each light.
struct Sheet {
  PhongPlane plane = make_phong_plane(kWidth, kHeight);
  std::vector<NamedLight> lights = comparison_lights();
  Picture picture;

  explicit Sheet(std::size_t columns) : picture(kWidth * static_cast<int>(columns), kHeight * static_cast<int>(lights.size())) {}
  void put(std::size_t column, std::size_t row, std::size_t pixel, double value) {
    const float v = static_cast<float>(value);
    picture.at(static_cast<int>(column) * kWidth + plane.pixels[pixel] % kWidth,
               static_cast<int>(row) * kHeight + plane.pixels[pixel] / kWidth) = {v, v, v};
  }
  std::vector<double> exact(std::size_t row, int n) const {
    std::vector<double> values(plane.count);
    for (std::size_t i = 0; i < plane.count; ++i) values[i] = phong_radiance(lights[row].light, plane.at(i), phong(n), {Method::exact}).x;
    return values;
  }
};

// Columns: the exact picture, then the pictures of the published substitutes and of the series.
Picture substitutes_picture(int n) {
  std::vector<Baseline> shown;
  for (const Baseline& b : phong_baselines())
    if (b.name.find("table") == std::string::npos) shown.push_back(b);
  shown.push_back({"series", [](const PreparedPolygon& light, const ShadingPoint& at, double exponent) {
                     return phong_radiance(light, at, phong(exponent), {Method::series}).x;
                   }});
  Sheet sheet(shown.size() + 1);
  for (std::size_t l = 0; l < sheet.lights.size(); ++l) {
    const std::vector<double> exact = sheet.exact(l, n);
    const double brightest = *std::max_element(exact.begin(), exact.end());
    for (std::size_t i = 0; i < exact.size(); ++i) {
      sheet.put(0, l, i, 0.8 * exact[i] / brightest);
      for (std::size_t b = 0; b < shown.size(); ++b)
        sheet.put(b + 1, l, i, 0.8 * shown[b].radiance(sheet.lights[l].light, sheet.plane.at(i), n) / brightest);
    }
  }
  return sheet.picture;
}

// Columns: the exact picture, then errors of the methods, enlarged.
Picture error_picture(Simd simd, int n, double enlarged) {
  const std::vector<Method> methods = {Method::lorentzian, Method::pearson, Method::ellipsoid, Method::series};
  Sheet sheet(methods.size() + 1);
  const PhongPlane& plane = sheet.plane;
  const Material material = phong(n);
  for (std::size_t l = 0; l < sheet.lights.size(); ++l) {
    const std::vector<double> exact = sheet.exact(l, n);
    const double brightest = *std::max_element(exact.begin(), exact.end());
    for (std::size_t i = 0; i < plane.count; ++i) sheet.put(0, l, i, 0.8 * exact[i] / brightest);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const FlushDenormals flush;
      std::vector<float> result(plane.x.size());
      lobe_packs_for(simd)[methods::Procedure::phong_lobe](prepare_light(sheet.lights[l].light), plane.points(), {material, {methods[m]}},
                                                           {result.data()});
      for (std::size_t i = 0; i < plane.count; ++i)
        sheet.put(m + 1, l, i, enlarged * std::fabs(static_cast<double>(result[i]) - exact[i]) / brightest);
    }
  }
  return sheet.picture;
}

}  // namespace

std::vector<std::string> write_table2_figures(const std::string& folder, Simd simd) {
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const LinePlot& plot) {
    files.push_back(folder + "/" + name);
    write_file(files.back(), to_svg(plot));
  };
  write("phong_integrand.svg", integrand_plot());
  write("phong_half_width.svg", half_width_plot());
  write("phong_fits.svg", fits_plot(100, 0.99, 0.03, 200));
  std::vector<LinePlot> sheet;
  for (const double n : {10.0, 100.0, 1000.0})
    for (const double c : {0.5, 0.9, 0.99, 0.9999}) sheet.push_back(fits_plot(n, c, 0.1, 60));
  files.push_back(folder + "/phong_fits_sheet.svg");
  write_file(files.back(), sheet_to_svg(sheet, 4));
  files.push_back(folder + "/phong_substitutes.png");
  write_picture(substitutes_picture(100), files.back());
  for (const int n : {100, 5000}) {
    files.push_back(folder + "/phong_errors_" + std::to_string(n) + ".png");
    write_picture(error_picture(simd, n, 50), files.back());
  }
  return files;
}

}  // namespace steradian::moment
