#include "steradian/closed_form.h"

#include <vector>

#include "ggx/clipped_walk.h"
#include "steradian/albedo.h"
#include "steradian/error.h"

namespace steradian {
namespace {

void check_ggx(const Material& material) {
  if (material.brdf != Brdf::ggx)
    throw Error("material.brdf", std::string("the closed form has no ") + name_of(material.brdf), "use ggx");
}

// The walks over one light, seen from one point.
template <class S>
class Evaluation {
 public:
  using K = Kernels<S>;

  Evaluation(const PreparedPolygon& light, const ShadingPoint& at, const Material& m) {
    const int side = light.side_of(at.position);
    const bool lit = side > 0 || (side < 0 && light.two_sided);
    if (!lit || !(dot(at.view, at.normal) > 0)) return;
    facing_ = side;
    const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
    view_ = k_.ggx_view(to_kernel<S>(frame.to_local(at.view)), m.alpha_x, m.alpha_y);
    smith_ = m.shadowing ? 1.0 : 0.0;
    walk_clipped_edges<S>(light, frame, at.position, [&](const auto& a, const auto& b) {
      edges_.push_back(k_.ggx_edge(view_, a, b));
      e_ = e_ + k_.conic_vector(edges_.back());
    });
  }

  bool is_dark() const { return edges_.empty(); }
  double unshadowed() const { return is_dark() ? 0.0 : static_cast<double>(k_.ggx_unshadowed(view_, e_ * facing_).v); }

  // Radiance with F = 1, and with F = (1 - v.h)^5.
  typename K::vec2 shadowed(Quality quality) const {
    if (quality == Quality::draft) return k_.ggx_draft(view_, e_, smith_, facing_);
    const int extra_nodes = quality == Quality::high ? 2 : 0;
    auto c = k_.ggx_cubature_begin(view_, e_, smith_, facing_);
    for (const auto& edge : edges_) c = k_.ggx_cubature_edge(c, edge, extra_nodes);
    return k_.ggx_cubature_finish(c);
  }

 private:
  mutable K k_;
  typename K::GgxView view_;
  typename K::vec3 e_{0.0, 0.0, 0.0};
  typename K::real facing_ = 0.0, smith_ = 1.0;
  std::vector<typename K::ConicArc> edges_;
};

template <class S>
Vec3d closed_form(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, Quality quality) {
  check_ggx(m);
  const Evaluation<S> evaluation(light, at, m);
  if (evaluation.is_dark()) return {};
  Kernels<S> k;
  const auto r = evaluation.shadowed(quality);
  const auto channel = [&](double f0, double f90, double radiance) {
    return radiance * static_cast<double>(k.ggx_radiance(r, f0, f90).v);
  };
  return {channel(m.f0.x, m.f90.x, light.radiance.x), channel(m.f0.y, m.f90.y, light.radiance.y),
          channel(m.f0.z, m.f90.z, light.radiance.z)};
}

template <class S>
Vec3d exact(const PreparedPolygon& light, const ShadingPoint& at, const Material& m) {
  check_ggx(m);
  if (m.shadowing || !(m.f0 == m.f90))
    throw Error("material", "GGX is exact only without shadowing and with f0 = f90",
                "set shadowing to none, or use the method closed-form");
  return light.radiance * m.f0 * Evaluation<S>(light, at, m).unshadowed();
}

}  // namespace

Vec3d closed_form_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           Quality quality) {
  return closed_form<double>(light, at, with_multiple_scattering(material, at), quality);
}
Vec3d closed_form_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                 Quality quality) {
  return closed_form<float>(light, at, with_multiple_scattering(material, at), quality);
}

Vec3d exact_ggx_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  return exact<double>(light, at, with_multiple_scattering(material, at));
}
Vec3d exact_ggx_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  return exact<float>(light, at, with_multiple_scattering(material, at));
}

}  // namespace steradian
