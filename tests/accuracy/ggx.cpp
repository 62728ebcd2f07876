// "GGX under rectangles", "Half vectors", "Round lights": every real-time method of glossy lobes against the reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <vector>

#include "integrals/ggx/representative_point.h"
#include "sections.h"
#include "shapes/polygon.h"
#include "steradian/closed_form.h"
#include "steradian/half_vector.h"
#include "steradian/ltc.h"
#include "support/point_light_error.h"
#include "support/random_rectangles.h"

namespace steradian::accuracy {
namespace {

constexpr double kRoughness[] = {0.1, 0.25, 0.4, 0.55, 0.7, 0.85};
constexpr double kViews[] = {3, 20, 40, 60, 75, 86};
constexpr int kPerCell = 28;

struct Case {
  PreparedPolygon light;
  ShadingPoint at;
  Material material;
  double truth;
};

std::vector<std::vector<Case>> rectangles(double f0) {
  reference::Random random(5);
  std::vector<std::vector<Case>> cells;
  for (double roughness : kRoughness)
    for (double view : kViews) {
      auto& cell = cells.emplace_back();
      for (int i = 0; i < kPerCell; ++i) {
        auto s = ggx::random_rectangle(random, roughness, view);
        s.material.f0 = {f0, f0, f0};
        Case c{prepare_polygon(s.light), s.at, s.material, 0};
        c.truth = reference_radiance(c.light, c.at, c.material, {1e-6, 1e-9, 100'000}).radiance.x;
        cell.push_back(c);
      }
    }
  return cells;
}

using Evaluate = std::function<double(const Case&)>;
struct Method {
  const char* name;
  Evaluate evaluate;
};

// Karis' representative point as published: the method without its factor 1/sqrt(v.h).
double karis(const Case& c) {
  const Vec3d n = normalized(c.at.normal), v = normalized(c.at.view);
  const auto frame = Kernels<double>().frame_from_normal_and_view(integrals::to_kernel<double>(n), integrals::to_kernel<double>(v));
  auto view = transform_transposed(frame, integrals::to_kernel<double>(v));
  view.y = 0.0;
  const auto shading = integrals::shading_from<double>(dot(n, v) > 0 ? shapes::lit_side(c.light, c.at.position) : 0, view);
  integrals::RepresentativePoint<double> integral(c.material.alpha_x, integrals::Widening::published);
  const auto part = integrate(integrals::contours_in<double>(c.light, frame, c.at.position), shading, integral);
  return integrals::radiance_of<double>(part, c.material.f0, c.material.f90, c.light.radiance).x;
}

std::vector<Method> methods() {
  const auto closed = [](Quality q) { return [q](const Case& c) { return closed_form_radiance(c.light, c.at, c.material, q).x; }; };
  const auto ltc = [](LtcMethod m) { return [m](const Case& c) { return ltc_radiance(m, c.light, c.at, c.material).x; }; };
  return {{"closed-form, normal", closed(Quality::normal)},
          {"closed-form, high", closed(Quality::high)},
          {"closed-form, draft", closed(Quality::draft)},
          {"closed-form, normal, float", [](const Case& c) { return closed_form_radiance_float(c.light, c.at, c.material).x; }},
          {"ltc", ltc(LtcMethod::classic)},
          {"ltc, high", ltc(LtcMethod::fresnel)},
          {"ltc-compact", ltc(LtcMethod::compact)},
          {"representative-point", ltc(LtcMethod::representative_point)},
          {"representative-point, lobe widened as published", karis}};
}

struct Sum {
  double error = 0, signal = 0;
  void add(double value, double truth) {
    error += (value - truth) * (value - truth);
    signal += truth * truth;
  }
  double relative() const { return std::sqrt(error / signal); }
};

// Relative RMSE over all cells, the worst cell, and a map of the cells.
struct Map {
  double all, worst;
  std::vector<double> cells;
};
Map map_of(const std::vector<std::vector<Case>>& cells, const Evaluate& evaluate) {
  Map map{0, 0, {}};
  Sum all;
  for (const auto& cell : cells) {
    Sum sum;
    for (const Case& c : cell) {
      const double value = evaluate(c);
      sum.add(value, c.truth);
      all.add(value, c.truth);
    }
    map.cells.push_back(sum.relative());
    map.worst = std::max(map.worst, sum.relative());
  }
  map.all = all.relative();
  return map;
}

void write_map(std::ostream& out, const char* title, const Map& map) {
  out << "\n" << title << "\n\n| roughness |";
  for (double view : kViews) out << fmt::format(" {:.0f}° |", view);
  out << "\n|---|---:|---:|---:|---:|---:|---:|\n";
  std::size_t i = 0;
  for (double roughness : kRoughness) {
    out << fmt::format("| {} |", roughness);
    for (std::size_t j = 0; j < std::size(kViews); ++j) out << fmt::format(" {:.4f} |", map.cells[i++]);
    out << "\n";
  }
}

struct Deviation {
  double rms = 0, largest = 0;
};
Deviation deviation(const std::vector<Case>& all, const HalfVectorOptions& options) {
  Deviation d;
  for (const Case& c : all) {
    const double e = std::fabs(half_vector_radiance(c.light, c.at, c.material, options).x - c.truth);
    d.rms += e * e / static_cast<double>(all.size());
    d.largest = std::max(d.largest, e);
  }
  d.rms = std::sqrt(d.rms);
  return d;
}

}  // namespace

void write_ggx(std::ostream& out) {
  out << fmt::format(
      "\n## GGX with shadowing and Fresnel\n\n"
      "{} random rectangles over roughness 0.1 to 0.85 and views 3 to 86 degrees from the normal (tests/support/random_rectangles.h, "
      "seed 5), against adaptive cubature. Relative RMSE: root mean square of the error over that of the signal; \"worst "
      "cell\" is that of the worst pair of roughness and view.\n\n"
      "| method | F0 = 1 | worst cell | F0 = 0.04 | worst cell |\n|---|---:|---:|---:|---:|\n",
      kPerCell * static_cast<int>(std::size(kRoughness) * std::size(kViews)));
  const auto metal = rectangles(1.0), dielectric = rectangles(0.04);
  for (const Method& m : methods()) {
    const Map a = map_of(metal, m.evaluate), b = map_of(dielectric, m.evaluate);
    out << fmt::format("| `{}` | {:.5f} | {:.4f} | {:.5f} | {:.4f} |\n", m.name, a.all, a.worst, b.all, b.worst);
  }
  const auto by_name = [](const std::string& name) {
    const std::vector<Method> all = methods();
    return std::find_if(all.begin(), all.end(), [&](const Method& m) { return m.name == name; })->evaluate;
  };
  out << "\nThe same for each pair of roughness (downwards) and view, drawn by `tools/draw_accuracy.py`; the tables below hold the "
         "figures.\n\n"
         "![Maps of the relative RMSE of GGX's methods](../images/accuracy-ggx.svg)\n";
  for (const char* name :
       {"closed-form, draft", "closed-form, normal", "closed-form, high", "ltc", "ltc, high", "ltc-compact", "representative-point"}) {
    write_map(out, fmt::format("`{}`, F0 = 1:", name).c_str(), map_of(metal, by_name(name)));
    write_map(out, fmt::format("`{}`, F0 = 0.04:", name).c_str(), map_of(dielectric, by_name(name)));
  }
}

void write_point_lights(std::ostream& out) {
  out << "\n## Point lights on GGX\n\n"
         "Transformed cosines towards lights without extent, against GGX itself (tests/support/point_light_error.h), for the roughnesses "
         "and "
         "views of the section before. Relative RMSE over directions of the light, of equal solid angle; \"all\" is the root mean square "
         "over "
         "the pairs of roughness and view. All other methods take GGX itself.\n\n"
         "| method | F0 = 1, all | worst pair | F0 = 0.04, all | worst pair |\n|---|---:|---:|---:|---:|\n";
  for (const methods::Row& row : methods::all()) {
    if (row.towards == nullptr) continue;
    for (const Quality quality : {Quality::normal, Quality::high}) {
      if (quality == Quality::high && row.method != steradian::Method::ltc) continue;
      const auto metal = test::error_under_points(row, quality, 1), dielectric = test::error_under_points(row, quality, 0.04);
      out << fmt::format("| `{}{}` | {:.4f} | {:.4f} | {:.4f} | {:.4f} |\n", row.name, quality == Quality::high ? ", high" : "", metal.rms,
                         metal.worst, dielectric.rms, dielectric.worst);
    }
  }
}

void write_half_vector(std::ostream& out) {
  out << "\n## Half vectors\n\nMethod `half-vector` on rectangles about the mirror direction, widths 0.05 to 0.8 (Blinn-Phong's exponent "
         "is "
         "that of the width), without shadowing and Fresnel, against adaptive cubature: rms error / largest, in units of "
         "the light's radiance, with edges split at the poles and uniformly.\n";
  for (Brdf brdf : {Brdf::blinn_phong, Brdf::beckmann, Brdf::ggx}) {
    out << "\n| " << name_of(brdf) << ", arcs | 5° | 45° | 75° | 85° |\n|---|---:|---:|---:|---:|\n";
    std::vector<std::vector<Case>> views;
    for (double view : {5.0, 45.0, 75.0, 85.0}) {
      reference::Random random(static_cast<std::uint64_t>(view));
      auto& cell = views.emplace_back();
      for (double alpha : {0.05, 0.1, 0.2, 0.4, 0.8})
        for (int i = 0; i < 30; ++i) {
          auto s = ggx::random_rectangle(random, std::sqrt(alpha), view);
          s.material.brdf = brdf;
          s.material.exponent = 2 / (alpha * alpha) - 2;
          s.material.shadowing = false;
          Case c{prepare_polygon(s.light), s.at, s.material, 0};
          c.truth = reference_radiance(c.light, c.at, c.material, {1e-6, 1e-8, 100'000}).radiance.x;
          cell.push_back(c);
        }
    }
    for (ArcSplit split : {ArcSplit::pole_mapped, ArcSplit::uniform})
      for (int arcs : {2, 3, 4, 6, 8}) {
        out << fmt::format("| {} {} |", arcs, split == ArcSplit::uniform ? "uniform" : "pole-mapped");
        for (const auto& cell : views) {
          const Deviation d = deviation(cell, {arcs, split});
          out << fmt::format(" {:.4f} / {:.3f} |", d.rms, d.largest);
        }
        out << "\n";
      }
  }
}

}  // namespace steradian::accuracy
