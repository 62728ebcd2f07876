#include "integrals/ggx/ggx_derivatives.h"

#include <cmath>

#include "integrals/ggx/ggx.h"
#include "integrals/methods.h"

namespace steradian::slopes {
namespace {

using integrals::to_kernel;
using K = Kernels<double>;
using V = K::vec3;

// The closed form under a view that moves while the region of half vectors stays.
class GgxInside : public integrals::GgxArcs<double> {
 public:
  double smith = 1;
  Quality quality = Quality::normal;
  double side = 0;  // longest side of the triangles into which the light is divided [rad]; 0: it stays whole

  void take(const K::ConicArc& arc) {
    if (arc.end.v > arc.begin.v) arcs_.push_back(arc);
  }
  // After all arcs: of those taken, if there are some, else of the edges.
  void finish(Mask<double> reversed) {
    parts_.clear();
    if (edges_.empty()) {
      V e{};
      for (const K::ConicArc& arc : arcs_) e = e + K().conic_vector(arc);
      parts_.push_back({std::move(arcs_), e, facing(reversed), 1});
    } else if (side > 0) {
      add_fan(facing(reversed).v);
    } else {
      const V e = prepare();
      parts_.push_back({std::move(arcs_), e, facing(reversed), 1});
    }
  }
  PartSlopes at(Vec3d view) const {
    K k;
    const auto moved = k.ggx_view(to_kernel<double>(view), alpha_x, alpha_y);
    PartSlopes sum;
    for (const Part& part : parts_) {
      if (quality == Quality::draft) {
        sum = sum + both(k.ggx_draft(moved, part.e, smith, part.facing)) * part.sign;
        continue;
      }
      auto c = k.ggx_cubature_begin(moved, part.e, smith, part.facing);
      for (const K::ConicArc& arc : part.arcs)
        if (is_seen(arc)) c = k.ggx_cubature_edge(c, arc, quality == Quality::high ? 2 : 0);
      sum = sum + both(k.ggx_cubature_finish(c)) * part.sign;
    }
    return sum;
  }
  // The change as the view turns towards a direction across it. At fixed nodes, the mean is smooth. Its width is the view's height.
  PartSlopes along(Vec3d view, Vec3d across) const {
    const double step = 1e-4 * view.z;
    const auto turned = [&](double angle) { return at(view * std::cos(angle) + across * std::sin(angle)); };
    return (turned(step) - turned(-step)) * (0.5 / step);
  }

 private:
  static constexpr int kDepth = 6;

  struct Part {
    std::vector<K::ConicArc> arcs;
    V e;
    Real<double> facing;
    double sign;
  };

  static PartSlopes both(const K::vec2& v) { return {v.x.v, v.y.v}; }

  // Triangles from one direction to all edges, those of one orientation with a minus.
  void add_fan(double facing) {
    Vec3d middle{};
    for (const Edge& edge : edges_) middle += to_vector(edge.a) + to_vector(edge.b);
    middle = normalized(middle);
    if (middle == Vec3d{}) middle = {0, 0, 1};
    for (const Edge& edge : edges_) add_triangle(middle, to_vector(edge.a), to_vector(edge.b), facing, 0);
  }
  void add_triangle(Vec3d a, Vec3d b, Vec3d c, double sign, int depth) {
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    if (longest > side && depth < kDepth) {
      const Vec3d ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
      add_triangle(a, ab, ca, sign, depth + 1);
      add_triangle(ab, b, bc, sign, depth + 1);
      add_triangle(ca, bc, c, sign, depth + 1);
      add_triangle(ab, bc, ca, sign, depth + 1);
      return;
    }
    if (dot(a, cross(b, c)) < 0) {
      std::swap(b, c);
      sign = -sign;
    }
    Part part{{}, {}, 1.0, sign};
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      const auto arc = K().ggx_edge(view_, to_kernel<double>(from), to_kernel<double>(to));
      if (!is_seen(arc)) continue;
      part.e = part.e + K().conic_vector(arc);
      part.arcs.push_back(arc);
    }
    parts_.push_back(std::move(part));
  }

  std::vector<Part> parts_;
};

// The rule along an edge (ggx_edge_slopes).
struct EdgeRule {
  int nodes, pieces;
};
EdgeRule rule_of(Quality quality) {
  return {quality == Quality::draft ? 4 : quality == Quality::normal ? 6 : 8, quality == Quality::high ? 2 : 1};
}

}  // namespace

GgxDerivatives ggx_derivatives(const PreparedPolygon& light, int side, const ShadingPoint& at, const Material& m, Quality quality) {
  K k;
  const Frame frame = Frame::from_normal_and_tangent(normalized(at.normal), m.tangent);
  const Vec3d v = frame.to_local(normalized(at.view));
  const auto view = k.ggx_view(to_kernel<double>(v), m.alpha_x, m.alpha_y);
  const double smith = m.shadowing ? 1.0 : 0.0;
  const EdgeRule rule = rule_of(quality);
  GgxDerivatives result;
  GgxInside inside;
  BothParts by_view{};
  bool crosses = false;
  Vec3d first;
  double width = 0;  // of the light on the unit sphere, as a chord from `first`
  result.by_vertex = by_edges(light, side, at.position, frame, [&](const V& a, const V& b) {
    const auto part = k.edge_above_horizon(a, b);
    const auto arc = k.ggx_edge(view, part.start, part.end);
    const auto s = k.ggx_edge_slopes_of_part(view, part, arc, smith, rule.nodes, rule.pieces);
    if (m.shadowing) {
      crosses = crosses || a.z.v < 0 || b.z.v < 0;
      first = first == Vec3d{} ? to_vector(a) : first;
      width = std::max(width, length(to_vector(b) - first));
      inside.take(arc);
      by_view = by_view + BothParts{to_vector(s.turn), to_vector(s.turn_of_fresnel)};
    }
    return EdgeDerivatives{{to_vector(s.normal * s.by_start.x), to_vector(s.normal * s.by_start.y)},
                           {to_vector(s.normal * s.by_end.x), to_vector(s.normal * s.by_end.y)}};
  });
  if (!m.shadowing) return result;
  inside.alpha_x = m.alpha_x;
  inside.alpha_y = m.alpha_y;
  inside.smith = smith;
  inside.quality = methods::fine_method(Method::closed_form, quality).quality;
  const auto shading = integrals::shading_from<double>(side, to_kernel<double>(v));
  inside.begin(shading);
  // Over all of a wide light, the mean of shadowing and Fresnel would make the derivative by the view wrong by as much as itself.
  const bool high = quality == Quality::high;
  if (width > (high ? 0.5 : 1.8)) inside.side = high ? 0.5 : 1;
  // Only where the horizon cuts the light, its arcs close the outline.
  if (crosses || inside.side > 0)
    integrals::integrate_edges(integrals::contours_in<double>(light, frame, at.position), shading, inside);
  else
    inside.finish(shading.reversed);
  const auto along = [&](Vec3d across) {
    const PartSlopes change = inside.along(v, across);
    return PartSlopes{change.plain + side * dot(by_view.plain, across), change.fresnel + side * dot(by_view.fresnel, across)};
  };
  if (m.alpha_x == m.alpha_y) {
    result.by_view = view_of_round_lobe(frame.z, normalized(at.view), turn_of(light, at.position, result.by_vertex),
                                        [&](const Vec3d& across) { return along(frame.to_local(across)); });
    return result;
  }
  const Frame about = Frame::from_normal(v);
  const PartSlopes x = along(about.x), y = along(about.y);
  result.by_view = {frame.to_world(about.x * x.plain + about.y * y.plain), frame.to_world(about.x * x.fresnel + about.y * y.fresnel)};
  return result;
}

}  // namespace steradian::slopes
