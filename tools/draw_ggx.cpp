// draw_ggx DIR: the pictures of docs/theory/ggx.md, as SVG.
//   ggx_warp.svg    a rectangle's image in stretched half vector space, with poles and nodes
//   ggx_error.svg   error of the real-time methods over roughness and view
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "integrals/integrate.h"
#include "steradian/closed_form.h"
#include "steradian/ltc.h"
#include "support/random_rectangles.h"

using namespace steradian;

namespace {

using K = Kernels<double>;

std::string format(const char* text, double a, double b = 0, double c = 0, double d = 0) {
  std::array<char, 256> buffer;
  std::snprintf(buffer.data(), buffer.size(), text, a, b, c, d);
  return buffer.data();
}

struct Svg {
  std::ostringstream body;
  void path(const std::vector<std::array<double, 2>>& points, const std::string& style) {
    body << "<polyline points=\"";
    for (const auto& p : points) body << format("%.2f,%.2f ", p[0], p[1]);
    body << "\" style=\"" << style << "\"/>\n";
  }
  void dot(double x, double y, double r, const char* colour) {
    body << format("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"", x, y, r) << " fill=\"" << colour << "\"/>\n";
  }
  void text(double x, double y, const std::string& words, const char* style = "font-size:13px") {
    body << format("<text x=\"%.1f\" y=\"%.1f\"", x, y) << " style=\"font-family:sans-serif;" << style << "\">" << words << "</text>\n";
  }
  void save(const std::string& name, int width, int height) const {
    std::ofstream file(name);
    file << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height << "\" viewBox=\"0 0 " << width << " "
         << height << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
         << body.str() << "</svg>\n";
  }
};

const char* const kEdgeColours[] = {"#c0392b", "#2471a3", "#1e8449", "#b7950b"};

K::vec3 unit(const K::vec3& u) { return u * (1.0 / std::sqrt(dot(u, u).v)); }
K::vec3 at_tau(const K::ConicArc& arc, double tau) { return arc.u0 + (arc.u1 + arc.u2 * tau) * tau; }

void draw_warp(const std::string& name) {
  K k;
  Svg svg;
  const double theta = 1.1;
  const PreparedPolygon light =
      prepare_polygon({{{1.1, 0.55, 0.15}, {1.1, -0.75, 0.15}, {1.1, -0.75, 1.25}, {1.1, 0.55, 1.25}}, {}, {1, 1, 1}, true});
  const auto view = k.ggx_view({-std::sin(theta), 0.0, std::cos(theta)}, 0.3, 0.3);
  std::vector<K::ConicArc> arcs;
  K::vec3 e(0.0, 0.0, 0.0);
  const Frame world{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  integrals::sum_over_edges<double>(integrals::contours_in<double>(light, world, {}), [&](const auto& a, const auto& b) {
    arcs.push_back(k.ggx_edge(view, a, b));
    e = e + k.conic_vector(arcs.back());
    return Real<double>(0.0);
  });
  if (e.z.v < 0) e = -e;
  const auto centre = unit(e);
  const double R = 210, cx = 240, cy = 260;
  const auto place = [&](const K::vec3& u) { return std::array<double, 2>{cx + R * u.x.v, cy - R * u.y.v}; };

  svg.text(30, 28, "Stretched half vector space, seen along the normal", "font-size:15px;font-weight:bold");
  svg.body << format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#f4f6f7\" stroke=\"#7f8c8d\"/>\n", cx, cy, R);
  std::vector<std::array<double, 2>> fill;
  for (const auto& arc : arcs)
    for (int i = 0; i < 64; ++i) fill.push_back(place(unit(at_tau(arc, arc.begin.v + (arc.end.v - arc.begin.v) * i / 64))));
  svg.path(fill, "fill:#fcf3cf;stroke:none");
  for (std::size_t n = 0; n < arcs.size(); ++n) {
    const auto& arc = arcs[n];
    const std::string colour = kEdgeColours[n % 4];
    std::vector<std::array<double, 2>> curve, chord;
    const auto a = unit(at_tau(arc, arc.begin.v)), b = unit(at_tau(arc, arc.end.v));
    for (int i = 0; i <= 64; ++i) {
      curve.push_back(place(unit(at_tau(arc, arc.begin.v + (arc.end.v - arc.begin.v) * i / 64))));
      chord.push_back(place(unit(a * (1 - i / 64.0) + b * (i / 64.0))));
    }
    svg.path(chord, "fill:none;stroke:#7f8c8d;stroke-dasharray:4 4");
    svg.path(curve, "fill:none;stroke-width:2.5;stroke:" + colour);
    const double total = arc.sweep.x.v + arc.sweep.y.v;
    const int count = 1 + (total >= 0.25) + (total >= 0.8) + (total >= 1.6);

    // Right: the edge in the plane of tau, the poles, and the angles under which the edge appears from them.
    const double px = 520 + 230.0 * static_cast<double>(n % 2), py = 60 + 230.0 * static_cast<double>(n / 2), w = 210, h = 190;
    const double span = 4.6, x0 = px + w / 2, y0 = py + h - 25, scale = w / span;
    const auto plane = [&](double x, double y) { return std::array<double, 2>{x0 + scale * x, y0 - scale * y}; };
    svg.body << format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#f4f6f7\" stroke=\"#bdc3c7\"/>\n", px, py, w, h);
    svg.path({plane(-span / 2, 0), plane(span / 2, 0)}, "stroke:#7f8c8d");
    svg.path({plane(arc.begin.v, 0), plane(arc.end.v, 0)}, "stroke-width:4;stroke:" + colour);
    for (const auto& z : {arc.z1, arc.z2}) {
      svg.path({plane(arc.begin.v, 0), plane(z.x.v, z.y.v), plane(arc.end.v, 0)}, "fill:#d5d8dc;fill-opacity:0.5;stroke:#aeb6bf");
      const auto p = plane(z.x.v, z.y.v);
      svg.dot(p[0], p[1], 4, "#17202a");
    }
    svg.text(px + 6, py + 16, format("edge %.0f: angle %.2f, %.0f nodes", static_cast<double>(n + 1), total, count), "font-size:12px");

    for (int j = 0; j < count; ++j) {
      const auto node = k.conic_node(arc, k.gauss_legendre_node(count, j).x);
      const auto rim = unit(at_tau(arc, node.tau.v));
      const auto on_axis = plane(node.tau.v, 0), on_rim = place(rim);
      svg.dot(on_axis[0], on_axis[1], 3.5, "#8e44ad");
      svg.path({place(centre), on_rim}, "stroke:#d2b4de");
      const double cc = dot(rim, centre).v;
      const auto out = unit(rim - centre * cc);
      for (double g : total >= 0.5 ? std::vector<double>{0.355051, 0.844949} : std::vector<double>{0.666667}) {
        const double c = 1 - (1 - cc) * g;
        const auto p = place(centre * c + out * std::sqrt(1 - c * c));
        svg.dot(p[0], p[1], 3.5, "#8e44ad");
      }
    }
  }
  const auto c = place(centre);
  svg.dot(c[0], c[1], 5, "#17202a");
  svg.text(520, 28, "Each edge over tau: two poles and their angles", "font-size:15px;font-weight:bold");
  svg.text(30, 500, "dashed: great circles between the corners; violet: nodes of the cubature; black: the centre E/|E|, and poles");
  svg.save(name, 990, 520);
}

void draw_error(const std::string& name) {
  Svg svg;
  const std::vector<double> roughness = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85}, views = {3, 15, 30, 45, 60, 70, 80, 86};
  using Evaluate = std::function<double(const PreparedPolygon&, const ShadingPoint&, const Material&)>;
  struct Panel {
    const char* title;
    Evaluate evaluate;
  };
  const Panel panels[] = {
      {"closed-form", [](const auto& l, const auto& at, const auto& m) { return closed_form_radiance(l, at, m).x; }},
      {"ltc", [](const auto& l, const auto& at, const auto& m) { return ltc_radiance(LtcMethod::classic, l, at, m).x; }},
      {"representative-point",
       [](const auto& l, const auto& at, const auto& m) { return ltc_radiance(LtcMethod::representative_point, l, at, m).x; }}};
  reference::Random random(9);
  svg.text(20, 24, "Relative RMSE under random rectangles, F0 = 0.04", "font-size:15px;font-weight:bold");
  const double cell = 38;
  std::vector<std::array<double, 3>> error(roughness.size() * views.size());
  for (std::size_t r = 0; r < roughness.size(); ++r)
    for (std::size_t v = 0; v < views.size(); ++v) {
      std::array<double, 3> sum{};
      double signal = 0;
      for (int i = 0; i < 16; ++i) {
        auto s = ggx::random_rectangle(random, roughness[r], views[v]);
        s.material.f0 = {0.04, 0.04, 0.04};
        const PreparedPolygon light = prepare_polygon(s.light);
        const double truth = reference_radiance(light, s.at, s.material, {1e-6, 1e-9, 100'000}).radiance.x;
        signal += truth * truth;
        for (std::size_t p = 0; p < 3; ++p) {
          const double d = panels[p].evaluate(light, s.at, s.material) - truth;
          sum[p] += d * d;
        }
      }
      for (std::size_t p = 0; p < 3; ++p) error[r * views.size() + v][p] = std::sqrt(sum[p] / signal);
    }
  for (std::size_t p = 0; p < 3; ++p) {
    const double px = 70 + 345.0 * static_cast<double>(p), py = 70;
    svg.text(px, py - 12, panels[p].title, "font-size:14px;font-weight:bold");
    for (std::size_t r = 0; r < roughness.size(); ++r) {
      const double y = py + cell * static_cast<double>(r);
      if (p == 0) svg.text(px - 34, y + 24, format("%.2f", roughness[r]), "font-size:11px");
      for (std::size_t v = 0; v < views.size(); ++v) {
        const double x = px + cell * static_cast<double>(v), e = error[r * views.size() + v][p];
        // Colours from white at 1e-4 over yellow to dark red at 1.
        const double t = std::fmin(std::fmax((std::log10(e) + 4) / 4, 0), 1);
        svg.body << format("<rect x=\"%.1f\" y=\"%.1f\" width=\"38\" height=\"38\"", x, y)
                 << format(" fill=\"rgb(%.0f,%.0f,%.0f)\"/>\n", 255 - 110 * std::fmax(2 * t - 1, 0), 255 - 215 * t,
                           235 * (1 - std::fmin(2 * t, 1)));
        svg.text(x + 3, y + 23, e < 1e-4 ? "&lt;.01 %" : format(e < 0.0995 ? "%.2f %%" : "%.0f %%", 100 * e), "font-size:9px");
        if (r + 1 == roughness.size()) svg.text(x + 8, y + 54, format("%.0f°", views[v]), "font-size:11px");
      }
    }
  }
  svg.text(8, 60, "roughness", "font-size:11px");
  svg.text(70, 420, "view, from the normal");
  svg.save(name, 1100, 440);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_ggx DIR\n");
    return 2;
  }
  draw_warp(std::string(argv[1]) + "/ggx_warp.svg");
  draw_error(std::string(argv[1]) + "/ggx_error.svg");
  return 0;
}
