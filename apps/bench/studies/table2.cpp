#include "bench/studies/table2.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "bench/phong_plane.h"
#include "bench/run.h"
#include "bench/studies/phong_baselines.h"
#include "core/float_mode.h"

namespace steradian::moment {
namespace {

constexpr int kExponents[] = {100, 500, 5000};

// A smaller picture: every k-th pixel of every k-th row, with the same camera.
PhongPlane thinned(const Table2Options& options) { return make_phong_plane(options.width / options.every, options.height / options.every); }

std::vector<double> exact_picture(const PhongPlane& plane, const PreparedPolygon& light, int n) {
  std::vector<double> picture(plane.count);
  const Material material = phong(n);
  for (std::size_t i = 0; i < plane.count; ++i) picture[i] = phong_radiance(light, plane.at(i), material, {Method::exact}).x;
  return picture;
}

std::vector<float> picture_by(const PhongPlane& plane, const PreparedPolygon& light, int n, const PhongOptions& options, Simd simd) {
  const FlushDenormals flush;
  std::vector<float> picture(plane.x.size());
  lobe_packs_for(simd)[methods::Procedure::phong_lobe](prepare_light(light), plane.points(), {phong(n), options}, {picture.data()});
  return picture;
}

double packs_ns(const PhongPlane& plane, const NamedLight& light, int n, const PhongOptions& method, const Table2Options& options) {
  BenchOptions bench;
  bench.min_time = options.min_time;
  bench.min_runs = 5;
  std::vector<float> picture(plane.x.size());
  const auto radiance = lobe_packs_for(options.simd)[methods::Procedure::phong_lobe];
  const PackLobe lobe = {phong(n), method};
  const PackLight pack_light = prepare_light(light.light);
  const Bench body{"packs", picture.size() * light.edges, name_of(options.simd), [&] {
                     const FlushDenormals flush;
                     radiance(pack_light, plane.points(), lobe, {picture.data()});
                     keep(picture.front());
                   }};
  return run_bench(body, bench).ns_per_item;
}

double scalar_ns(const PhongPlane& plane, const NamedLight& light, int n, const PhongOptions& method, const Table2Options& options) {
  BenchOptions bench;
  bench.min_time = options.min_time;
  bench.min_runs = 5;
  constexpr std::size_t kStep = 61;  // scalar is slow; a prime, so that the samples spread over the columns
  const Material material = phong(n);
  const Bench body{"scalar", plane.count / kStep * light.edges, "scalar", [&] {
                     const FlushDenormals flush;
                     float sum = 0;
                     for (std::size_t i = 0; i < plane.count / kStep; ++i)
                       sum += phong_radiance_float(light.light, plane.at(i * kStep), material, method).x;
                     keep(sum);
                   }};
  return run_bench(body, bench).ns_per_item;
}

double baseline_ns(const PhongPlane& plane, const NamedLight& light, int n, const Baseline& baseline, const Table2Options& options) {
  BenchOptions bench;
  bench.min_time = options.min_time;
  bench.min_runs = 5;
  constexpr std::size_t kStep = 61;
  const Bench body{"baseline", plane.count / kStep * light.edges, "scalar", [&] {
                     double sum = 0;
                     for (std::size_t i = 0; i < plane.count / kStep; ++i) sum += baseline.radiance(light.light, plane.at(i * kStep), n);
                     keep(sum);
                   }};
  return run_bench(body, bench).ns_per_item;
}

// Errors of the answers at the plane's points, relative to the brightest.
void judge(Table2Row& row, const std::vector<double>& exact, double all_pixels, const std::function<double(std::size_t)>& answer) {
  const double brightest = *std::max_element(exact.begin(), exact.end());
  double squares = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error = std::fabs(answer(i) - exact[i]) / brightest;
    squares += error * error;
    row.largest = std::max(row.largest, error);
  }
  row.rmse = std::sqrt(squares / all_pixels);
}

std::string table2_format(const char* pattern, double x) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, x);
  return text;
}

// The paper's own figures of a method, for n = 100, 500, 5000; all three are even.
struct Published {
  const char* method;  // how the names of our rows begin
  const char* rmse;
  const char* milliseconds;  // per edge on the whole screen: GTX 580 / GTX 980 Ti
};
constexpr Published kPublished[] = {
    {"arvo", "reference", "13.6, 49, 476 / 0.41, 1.57, 9.8"},
    {"lorentzian", "4.4e-03, 5.5e-03, 4.1e-03", "0.25 / 0.12"},
    {"pearson", "3.6e-03, 3.1e-03, 2.6e-03", "0.40 / 0.125"},
    {"ellipsoid", "1.5e-03, 1.7e-03, 1.0e-03", "0.47 / 0.127"},
};
const Published* published_of(const std::string& method) {
  for (const Published& p : kPublished)
    if (method == p.method || method.starts_with(p.method + std::string(","))) return &p;
  return nullptr;
}

}  // namespace

const std::vector<ComparedMethod>& compared_methods() {
  static const std::vector<ComparedMethod> methods = {
      {"arvo", {Method::arvo}},
      {"arvo to 1e-4", {Method::arvo, Quality::normal, 1e-4}},
      {"lorentzian, f = 1", {.method = Method::lorentzian, .form = PeakForm::one}},
      {"lorentzian, f = x", {.method = Method::lorentzian, .form = PeakForm::x}},
      {"pearson, f = 1", {.method = Method::pearson, .form = PeakForm::one}},
      {"pearson, f = x", {.method = Method::pearson, .form = PeakForm::x}},
      {"ellipsoid, f = 1", {.method = Method::ellipsoid, .form = PeakForm::one}},
      {"ellipsoid, f = x", {.method = Method::ellipsoid, .form = PeakForm::x}},
      {"series", {Method::series}},
      {"series high", {Method::series, Quality::high}},
      {"quadrature", {Method::exact}},
  };
  return methods;
}

std::vector<Table2Row> measure_table2(const Table2Options& options) {
  const PhongPlane plane = thinned(options);
  const double all_pixels = static_cast<double>(plane.width) * plane.height;
  std::vector<Table2Row> rows;
  for (const NamedLight& light : comparison_lights())
    for (const int n : kExponents) {
      const std::vector<double> exact = exact_picture(plane, light.light, n);
      for (const ComparedMethod& method : compared_methods()) {
        const std::vector<float> picture = picture_by(plane, light.light, n, method.options, options.simd);
        Table2Row row{.light = light.name, .method = method.name, .exponent = n};
        judge(row, exact, all_pixels, [&](std::size_t i) { return static_cast<double>(picture[i]); });
        if (options.min_time > 0) {
          row.packs_ns = packs_ns(plane, light, n, method.options, options);
          row.scalar_ns = scalar_ns(plane, light, n, method.options, options);
        }
        rows.push_back(row);
      }
      for (const Baseline& baseline : phong_baselines()) {
        Table2Row row{.light = light.name, .method = baseline.name, .exponent = n};
        judge(row, exact, all_pixels, [&](std::size_t i) { return baseline.radiance(light.light, plane.at(i), n); });
        if (options.min_time > 0) row.scalar_ns = baseline_ns(plane, light, n, baseline, options);
        rows.push_back(row);
      }
    }
  return rows;
}

std::string table2_text(const std::vector<Table2Row>& rows, const Table2Options& options) {
  std::string text;
  const auto cells = [&](const std::string& light, const std::string& method, auto value) {
    for (const int n : kExponents)
      for (const Table2Row& row : rows)
        if (row.light == light && row.method == method && row.exponent == n) text += " " + value(row) + " |";
  };
  for (const NamedLight& light : comparison_lights()) {
    text += "**" + light.name + "**, " + std::to_string(light.edges) + " edges\n\n";
    text += "| method | RMSE n=100 | 500 | 5000 | the paper's RMSE | largest 100 | 500 | 5000 |";
    if (options.min_time > 0)
      text += std::string(" ns scalar 100 | 500 | 5000 | ns ") + name_of(options.simd) + " 100 | 500 | 5000 | the paper's ms |";
    text += options.min_time > 0 ? "\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
                                 : "\n|---|---|---|---|---|---|---|---|\n";
    const auto add = [&](const std::string& method, bool in_packs) {
      text += "| " + method + " |";
      const Published* published = in_packs ? published_of(method) : nullptr;
      cells(light.name, method, [](const Table2Row& r) { return table2_format("%.1e", r.rmse); });
      text += std::string(" ") + (published != nullptr ? published->rmse : "") + " |";
      cells(light.name, method, [](const Table2Row& r) { return table2_format("%.1e", r.largest); });
      if (options.min_time > 0) {
        cells(light.name, method, [](const Table2Row& r) { return table2_format("%.0f", r.scalar_ns); });
        cells(light.name, method, [&](const Table2Row& r) { return in_packs ? table2_format("%.1f", r.packs_ns) : std::string(); });
        text += std::string(" ") + (published != nullptr ? published->milliseconds : "") + " |";
      }
      text += "\n";
    };
    for (const ComparedMethod& method : compared_methods()) add(method.name, true);
    for (const Baseline& baseline : phong_baselines()) add(baseline.name, false);
    text += "\n";
  }
  text +=
      "The paper's figures are of another scene, which is not known, and of another machine (GTX 580 / GTX 980 Ti, whole screen, per "
      "edge).\n";
  return text;
}

}  // namespace steradian::moment
