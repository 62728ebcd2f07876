#include "render/bounce/true_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrals/ggx/ltc_radiance.h"
#include "integrals/tables/ggx_tables.h"
#include "lobes/lobe.h"
#include "render/bounce/light_sets.h"

namespace steradian::indirect {
namespace {

Vec3d wide(Vec3f v) { return static_cast<Vec3d>(v); }

// One surface and the direction of its table look-up. Results are BRDF times the cosine of the other direction, in RGB.
class LinkEnd {
 public:
  LinkEnd(Vec3f normal, Vec3f view, Vec3f albedo, Vec3f f0, Vec3f f90, float alpha)
      : frame_(Frame::from_normal_and_tangent(normalized(wide(normal)), wide(view))),
        view_(normalized(frame_.to_local(wide(view)))),
        albedo_(wide(albedo)),
        f0_(wide(f0)),
        f90_(wide(f90)),
        alpha_(static_cast<double>(alpha)),
        glossy_((weighs(f0) || weighs(f90)) && view_.z > 0) {}

  Vec3d local(Vec3d w) const { return frame_.to_local(w); }
  double view_cosine() const { return view_.z; }
  Vec3d diffuse(Vec3d l) const { return albedo_ * (std::max(l.z, 0.0) / std::numbers::pi); }

  Vec3d ggx(Vec3d l) const {
    if (!glossy_ || !(l.z > 0)) return {};
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = m.alpha_y = alpha_;
    m.f0 = f0_;
    m.f90 = f90_;
    const lobes::Lobe lobe(m, view_);
    return lobe.radiance(lobe.evaluate(l));
  }

  // The transformed cosine for the view, evaluated at l. Fresnel is averaged over the lobe, or by pair.
  Vec3d ltc(Vec3d l, bool fresnel_by_pair) {
    if (!glossy_ || !(l.z > 0)) return {};
    if (!looked_up_) value_ = ggx_compact_table().look_up(std::sqrt(alpha_), view_.z);
    looked_up_ = true;
    const double lobe = ltc_evaluate(value_.inverse, l);
    if (!fresnel_by_pair) return (f0_ * value_.n_a + (f90_ - f0_) * value_.f_a) * lobe;
    const double x = std::clamp(1 - dot(normalized(l + view_), view_), 0.0, 1.0);
    return (f0_ + (f90_ - f0_) * (x * x * x * x * x)) * (value_.n_a * lobe);
  }

  // The same with the directions exchanged: looked up at l, evaluated at the view. Times cos l, so it is BRDF times cosine.
  Vec3d ltc_from(Vec3d l, double numerator, double denominator) const {
    if (!glossy_ || !(l.z > 0)) return {};
    const LtcValue value = ggx_compact_table().look_up(std::sqrt(alpha_), l.z);
    const Vec3d x = normalized(Vec3d{l.x, l.y, 0});
    const Frame turned = {length(x) > 0.5 ? x : Vec3d{1, 0, 0}, cross({0, 0, 1}, length(x) > 0.5 ? x : Vec3d{1, 0, 0}), {0, 0, 1}};
    return (f0_ * value.n_a + (f90_ - f0_) * value.f_a) * (ltc_evaluate(value.inverse, turned.to_local(view_)) * numerator / denominator);
  }

 private:
  Frame frame_;
  Vec3d view_, albedo_, f0_, f90_;
  double alpha_;
  bool glossy_;
  bool looked_up_ = false;
  LtcValue value_;
};

}  // namespace

Vec3d sum_virtual_lights(const ShadowMap& map, const Surface& receiver, Vec3f view, const SumOptions& options) {
  const Vec3d p = wide(receiver.position);
  const float alpha = std::sqrt(receiver.alpha_x * receiver.alpha_y);
  LinkEnd eye(receiver.normal, view, receiver.albedo, receiver.f0, receiver.f90, alpha);
  Vec3d sum{};
  for (std::size_t i = 0; i < map.count; ++i) {
    const Vec3d v = wide(map.position[i]) - p;
    const double d2 = dot(v, v);
    if (!(d2 > 0) || !weighs(map.flux[i])) continue;
    const Vec3d l = v / std::sqrt(d2);
    const Vec3d at_eye = eye.local(l);
    if (!(at_eye.z > 0) || !(dot(wide(map.normal[i]), l) < 0)) continue;
    LinkEnd light(map.normal[i], map.incoming[i], map.albedo[i], map.f0[i], map.f90[i], map.alpha[i]);
    const Vec3d at_light = light.local(-l);
    const bool by_pair = largest(map.f0[i]) < kFresnelByPair;
    Vec3d out = light.diffuse(at_light), in = eye.diffuse(at_eye);
    switch (options.lobe) {
      case SumLobe::ggx:
        out += light.ggx(at_light);
        in += eye.ggx(at_eye);
        break;
      case SumLobe::ltc:
        out += light.ltc(at_light, by_pair);
        in += eye.ltc(at_eye, false);
        break;
      case SumLobe::ltc_averaged:
        out += light.ltc(at_light, false);
        in += eye.ltc(at_eye, false);
        break;
      case SumLobe::ltc_outgoing:
        out += light.ltc_from(at_light, at_light.z, std::max(light.view_cosine(), 1e-6));
        in += eye.ltc(at_eye, false);
        break;
      case SumLobe::ltc_outgoing_raw:
        out += light.ltc_from(at_light, 1, 1);
        in += eye.ltc(at_eye, false);
        break;
    }
    const Vec3d pair = wide(map.flux[i]) * out * in;
    if (!(pair.x + pair.y + pair.z > 0)) continue;
    if (options.shadows != nullptr && options.shadows->occluded(receiver.position, map.position[i])) continue;
    sum += pair / (d2 + (options.soften ? static_cast<double>(map.area[i]) / std::numbers::pi : 0));
  }
  return sum;
}

}  // namespace steradian::indirect
