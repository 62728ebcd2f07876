#include "eval/point_light.h"

#include "steradian/kernels.h"

namespace steradian::eval {
namespace {

using K = Kernels<double>;

K::vec3 to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }

Vec3d schlick(const Material& m, double v_dot_h) {
  const auto channel = [&](double f0, double f90) { return K().fresnel_schlick(f0, f90, v_dot_h).v; };
  return {channel(m.f0.x, m.f90.x), channel(m.f0.y, m.f90.y), channel(m.f0.z, m.f90.z)};
}

// BRDF times cosine; l and v unit, in the frame of normal and tangent, above the surface.
Vec3d lobe(const Material& m, Vec3d light, Vec3d view) {
  K k;
  const K::vec3 l = to_kernel(light), v = to_kernel(view);
  const K::vec3 h = k.microfacet_half_vector(l, v);
  switch (m.brdf) {
    case Brdf::lambert: return m.albedo * k.lambert_lobe(l).v;
    case Brdf::phong: return m.albedo * k.phong_lobe(l, k.phong_mirror(v), m.exponent).v;
    case Brdf::blinn_phong: {
      const double f = k.microfacet_lobe_unshadowed(k.blinn_phong_distribution(h, m.exponent), l, v).v;
      return Vec3d{f, f, f};
    }
    case Brdf::beckmann: {
      const double f = k.microfacet_lobe_unshadowed(k.beckmann_distribution(h, m.alpha_x, m.alpha_y), l, v).v;
      return Vec3d{f, f, f};
    }
    case Brdf::ggx: {
      const double f =
          m.shadowing ? k.ggx_lobe(l, v, m.alpha_x, m.alpha_y).v
                      : k.microfacet_lobe_unshadowed(k.ggx_distribution(h, m.alpha_x, m.alpha_y), l, v).v;
      return schlick(m, dot(v, h).v) * f;
    }
  }
  return {};
}

}  // namespace

Vec3d point_light_radiance(const PointLight& light, const ShadingPoint& at, const Material& material) {
  const Vec3d to_light = light.position - at.position;
  const double distance = length(to_light);
  if (!(distance > 0)) return {};
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const Vec3d l = frame.to_local(normalized(to_light)), v = frame.to_local(at.view);
  if (!(l.z > 0) || !(v.z > 0)) return {};
  return lobe(material, l, v) * light.intensity / distance / distance;
}

}  // namespace steradian::eval
