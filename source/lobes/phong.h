// Phong: a power of the cosine about the mirrored view, with or without the cosine of the light.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

struct Phong {
  static constexpr Brdf kBrdf = Brdf::phong;
  static constexpr const char* kName = "phong";
  static constexpr Key kKeys[] = {
      kExponent, kAlbedo, {"foreshortening", KeyKind::flag, [](Draft& d, const KeyValue& v) { d.material.foreshortening = v.flag; }}};
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) { return {mirrored(at), 1 / std::sqrt(m.exponent + 1)}; }

  Phong(const Material& material, Vec3d view)
      : colours{material.albedo},
        n(material.exponent),
        foreshortening(material.foreshortening),
        mirror(from_kernel(Kernels<double>().phong_mirror(to_kernel(view)))),
        frame(Frame::from_normal(mirror)) {}

  LobeValue evaluate(Vec3d l) const {
    if (!(dot(l, mirror) > 0)) return {};  // the kernel's power 0 has no end of the lobe
    return {Kernels<double>().phong_lobe(to_kernel(l), to_kernel(mirror), n).v * (foreshortening ? l.z : 1), 0};
  }
  Vec3d sample(double u, double v) const { return frame.to_world(sample_cosine_power(n, u, v)); }
  double pdf(Vec3d l) const { return pdf_cosine_power(n, dot(l, mirror)); }
  LobeShape shape() const { return shape_about(mirror, 1 / std::sqrt(n + 1)); }
  double sensitivity() const { return 1 + n; }
  std::array<Vec3d, 2> ending_planes() const { return {mirror, Vec3d{}}; }

  Colours colours;
  double n;
  bool foreshortening;
  Vec3d mirror;
  Frame frame;
};

}  // namespace steradian::lobes
