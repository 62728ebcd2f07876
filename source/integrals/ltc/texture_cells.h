// What a lobe sees of one cell of a textured light (texture_tree.h), for the numbers S of a kernel.
#pragma once

#include <array>
#include <cmath>

#include "integrals/ltc/texture_tree.h"
#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

// A lobe over the light's plane from a point, in the shading frame.
//   matrix          M^-1 of the linearly transformed cosine that tells how wide it is, and that it is where `is_ggx` is false
//   ggx             else the GGX lobe
//   origin, x, y    of the plane's coordinates, from the point
template <class S>
struct TextureView {
  typename Kernels<S>::LtcMatrix matrix;
  bool is_ggx = false;
  typename Kernels<S>::GgxView ggx;
  typename Kernels<S>::vec3 origin, x, y;
};

// With what all cells ask of it.
template <class S>
struct PreparedTextureView {
  using K = Kernels<S>;
  using real = Real<S>;
  TextureView<S> view;
  typename K::vec3 normal;  // of the plane, unit
  real height;              // of the point over it
  real least_length;        // |M^-1 l| in the lobe's own direction
  real determinant;         // of M^-1

  explicit PreparedTextureView(const TextureView<S>& v) : view(v), normal(cross(v.x, v.y)) {
    K k;
    height = abs(dot(normal, v.origin));
    const auto peak = k.ltc_texture_transform_back(v.matrix, typename K::vec3(0.0, 0.0, 1.0));
    const auto under = k.ltc_transform(v.matrix, peak * inversesqrt(dot(peak, peak)));
    least_length = sqrt(dot(under, under));
    determinant = v.matrix.yy * (v.matrix.xx * v.matrix.zz - v.matrix.xz * v.matrix.zx);
  }
};

template <class S>
struct SeenCell {
  Real<S> weight = 0.0;                                  // the integral of the lobe
  typename Kernels<S>::vec3 radiance = {0.0, 0.0, 0.0};  // of the lobe times the texture
  Real<S> error = 0.0;                                   // of what the quotient of the sums may be off, times the sum of the weights
};

template <class V>
auto luminance_of(const V& v) {
  return (v.x + v.y + v.z) * decltype(v.x)(1.0 / 3);
}

//   expected   the mean of the whole light, as far as it is known
template <class S>
SeenCell<S> seen_cell(const TextureCell& cell, const PreparedTextureView<S>& prepared, const typename Kernels<S>::vec3& expected) {
  using K = Kernels<S>;
  using real = Real<S>;
  using vec3 = typename K::vec3;
  K k;
  SeenCell<S> s;
  if (!(cell.area > 0)) return s;
  const TextureView<S>& view = prepared.view;
  const auto vector = [](const Vec3d& v) { return vec3(real(v.x), real(v.y), real(v.z)); };
  const auto in_frame = [&](const std::array<double, 2>& v) { return view.x * real(v[0]) + view.y * real(v[1]); };
  const vec3 center = view.origin + in_frame(cell.center), a = in_frame(cell.axis_a), b = in_frame(cell.axis_b);
  const real zero(0.0), one(1.0);
  const auto value = [&](const vec3& r) {
    const auto above = r.z > zero;
    const vec3 upper(r.x, r.y, select(above, r.z, one));
    const real inverse2 = one / dot(upper, upper), inverse = sqrt(inverse2);
    const vec3 l = upper * inverse;
    const real lobe = view.is_ggx ? k.ggx_lobe_and_fresnel(view.ggx, l, 1.0).x : k.ltc_lobe(view.matrix, l);
    return select(above, lobe * inverse * inverse2, zero);
  };
  const real at_a = value(center + a), from_a = value(center - a), at_b = value(center + b), from_b = value(center - b);
  const real area = real(cell.area) * prepared.height;  // times the cosine at the light, which is the height over the distance
  const real mean = real(0.25) * (at_a + from_a + at_b + from_b);
  s.weight = area * mean;
  const vec3 power = (vector(cell.mean) * mean + vector(cell.along_a) * (real(0.5) * (at_a - from_a)) +
                      vector(cell.along_b) * (real(0.5) * (at_b - from_b))) *
                     area;
  s.radiance = {max(power.x, zero), max(power.y, zero), max(power.z, zero)};

  // t as kernels/outline/light_elements.glsl has it. The lobe is at most det / (pi |M^-1 l|^3), whose denominator falls by no more than the
  // cell reaches, and not below its least.
  const auto length2 = [](const std::array<double, 2>& v) { return v[0] * v[0] + v[1] * v[1]; };
  const real distance2 = dot(center, center), inverse_distance = one / sqrt(distance2), distance = distance2 * inverse_distance;
  const real steepness = k.ltc_sharpness(view.matrix, center), sharpness = k.light_elements_diffuse_sharpness() + steepness;
  const real t = real(std::sqrt(0.5 * (length2(cell.axis_a) + length2(cell.axis_b)))) * inverse_distance * sharpness;
  const vec3 under = k.ltc_transform(view.matrix, center * inverse_distance);
  const real radius(cell.radius), reach = min(radius * inverse_distance * steepness, one);
  const real m = max(sqrt(dot(under, under)) * (one - reach), prepared.least_length);
  const real nearest = max(distance - radius, prepared.height);
  const real steep = min(prepared.height + radius, nearest) / (nearest * nearest * nearest);
  const real highest = prepared.determinant / (real(3.14159265358979324) * m * m * m) * steep;
  const real off = abs(real(luminance_of(cell.mean)) - luminance_of(expected));
  const real small = min(t, real(2.0));
  s.error = real(cell.area) * highest * (off * small * small * small * real(0.125) + real(0.5 * cell.deviation) * small * small);
  return s;
}

// Whether cells of the deviation `finest` are small against the lobe, where its peak is on the light.
//   bounds   left, right, bottom, top of the light
template <class S>
Mask<S> cells_resolve(const TextureView<S>& view, double finest, const std::array<double, 4>& bounds) {
  using K = Kernels<S>;
  using real = Real<S>;
  using vec3 = typename K::vec3;
  K k;
  const real zero(0.0);
  const vec3 normal = cross(view.x, view.y), peak = k.ltc_texture_transform_back(view.matrix, vec3(0.0, 0.0, 1.0));
  const real along = dot(normal, peak), height = dot(normal, view.origin);
  const auto towards = along * height > zero;
  const vec3 hit = peak * (height / select(towards, along, real(1.0)));
  const real x = dot(hit - view.origin, view.x), y = dot(hit - view.origin, view.y), distance2 = dot(hit, hit);
  const real distance = sqrt(distance2), sharpness = k.ltc_sharpness(view.matrix, hit);
  const real size = real(finest) * sharpness / distance, margin = real(2.0) * distance / sharpness;
  const auto on_light =
      x > real(bounds[0]) - margin && x < real(bounds[1]) + margin && y > real(bounds[2]) - margin && y < real(bounds[3]) + margin;
  return !towards || !on_light || size < real(1.5);
}

STERADIAN_END_ISA
