#include <algorithm>
#include <cmath>

#include "ltc/ggx_tables.h"
#include "moment/clipped_edges.h"
#include "steradian/albedo.h"
#include "steradian/error.h"
#include "steradian/kernels.h"
#include "steradian/ltc.h"

namespace steradian {
namespace {

// One evaluation in the arithmetic of S: the light in the shading frame, x along the view's projection.
template <class S>
struct Evaluation : Kernels<S> {
  using typename Kernels<S>::real;
  using typename Kernels<S>::mask;
  using typename Kernels<S>::vec3;
  using typename Kernels<S>::mat3;
  using typename Kernels<S>::LtcMatrix;

  const PreparedPolygon& light;
  Vec3d position;
  mat3 frame;
  vec3 view;
  mask reversed;

  Evaluation(const PreparedPolygon& polygon, const ShadingPoint& at, int side)
      : light(polygon), position(at.position), reversed(mask(side < 0)) {
    const Vec3d v = normalized(at.view), n = normalized(at.normal);
    frame = this->frame_from_normal_and_view(vector(n), vector(v));
    view = transform_transposed(frame, vector(v));
    view.y = 0.0;
  }

  static vec3 vector(Vec3d v) { return {v.x, v.y, v.z}; }

  template <class AddEdge>
  void walk_edges(AddEdge add_edge) {
    for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
      const std::size_t begin = light.contours[c], end = light.contours[c + 1];
      vec3 previous = direction(end - 1);
      for (std::size_t i = begin; i < end; ++i) {
        const vec3 next = direction(i);
        add_edge(previous, next);
        previous = next;
      }
    }
  }
  vec3 direction(std::size_t i) {
    return this->polygon_direction(transform_transposed(frame, vector(light.vertices[i] - position)));
  }

  real integrate(const LtcMatrix& m) {
    auto walk = this->ltc_begin();
    walk_edges([&](vec3 a, vec3 b) {
      walk = this->ltc_add_edge(walk, m, a, b, this->ltc_direction(m, a), this->ltc_direction(m, b));
    });
    return this->ltc_integral(walk, reversed);
  }

  real integrate_clipless(const LtcMatrix& m) {
    vec3 sum(0.0, 0.0, 0.0);
    walk_edges([&](vec3 a, vec3 b) {
      sum = this->ltc_clipless_add_edge(sum, this->ltc_direction(m, a), this->ltc_direction(m, b));
    });
    return this->ltc_clipless_integral(sum, reversed);
  }

  LtcMatrix matrix(const LtcInverse& inverse) {
    LtcMatrix m;
    m.xx = inverse.xx, m.xz = inverse.xz, m.yy = inverse.yy, m.zx = inverse.zx, m.zz = inverse.zz;
    return m;
  }

  LtcMatrix compact(const LtcShape& shape, double alpha, const vec3& about) {
    typename Kernels<S>::vec4 e;
    e.x = shape.e00, e.y = shape.e11, e.z = shape.e02, e.w = shape.e20;
    return this->ltc_from_compact(e, alpha, about);
  }

  Vec3d sheen(const Material& material, double n_a, real integral) {
    return material.albedo * light.radiance * (n_a * static_cast<double>(integral.v));
  }

  Vec3d coloured(const Material& material, double n_a, double f_a, real integral) {
    const auto channel = [&](double f0, double f90, double radiance) {
      return static_cast<double>((this->ltc_specular_scale(f0, f90, n_a, f_a) * integral * real(radiance)).v);
    };
    return {channel(material.f0.x, material.f90.x, light.radiance.x),
            channel(material.f0.y, material.f90.y, light.radiance.y),
            channel(material.f0.z, material.f90.z, light.radiance.z)};
  }

  Vec3d representative_point(const Material& material) {
    const vec3 mirror(-view.x, 0.0, view.z);
    auto walk = this->representative_begin();
    // Any apex serves: the walk is closed by clipping.
    auto solid_angle = this->solid_angle_begin(vec3(0.0, 0.0, 1.0));
    const auto to = [&](const Vec3d& v) { return this->polygon_direction(transform_transposed(frame, vector(v - position))); };
    sum_over_clipped_edges<S>(light, to, [&](const auto& a, const auto& b) {
      walk = this->representative_add_edge(walk, mirror, a, b);
      solid_angle = this->solid_angle_add_edge(solid_angle, a, b);
      return real(0.0);
    });
    const real sr = this->solid_angle_finish(solid_angle, reversed);
    const real lobe = this->representative_radiance(walk, view, mirror, sr, material.alpha_x, reversed);
    const real v_dot_h = this->representative_v_dot_h(walk, view, mirror, reversed);
    const auto channel = [&](double f0, double f90, double radiance) {
      return static_cast<double>((this->fresnel_schlick(f0, f90, v_dot_h) * lobe * real(radiance)).v);
    };
    return {channel(material.f0.x, material.f90.x, light.radiance.x),
            channel(material.f0.y, material.f90.y, light.radiance.y),
            channel(material.f0.z, material.f90.z, light.radiance.z)};
  }
};

template <class S>
Vec3d radiance(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  const int side = light.side_of(at.position);
  const double cosine = dot(normalized(at.normal), normalized(at.view));
  if (side == 0 || (side < 0 && !light.two_sided) || !(cosine > 0)) return {};
  Evaluation<S> evaluation(light, at, side);
  const double alpha = std::max(material.alpha_x, 1e-4), roughness = std::sqrt(alpha);
  switch (method) {
    case LtcMethod::representative_point: return evaluation.representative_point(material);
    case LtcMethod::classic:
    case LtcMethod::clipless: {
      const LtcValue value = ggx_classic_table().look_up(roughness, cosine);
      const auto m = evaluation.matrix(value.inverse);
      const auto integral = method == LtcMethod::classic ? evaluation.integrate(m) : evaluation.integrate_clipless(m);
      return evaluation.coloured(material, value.n_a, value.f_a, integral);
    }
    case LtcMethod::compact: {
      if (material.brdf == Brdf::charlie) {
        const CompactTable::Entry entry = charlie_compact_table().entry(roughness, cosine);
        return evaluation.sheen(material, entry.n_a, evaluation.integrate(evaluation.compact(entry.shape, 1.0, {0.0, 0.0, 1.0})));
      }
      const CompactTable::Entry entry = ggx_compact_table().entry(roughness, cosine);
      const auto m = evaluation.compact(entry.shape, alpha, evaluation.view);
      return evaluation.coloured(material, entry.n_a, entry.f_a, evaluation.integrate(m));
    }
  }
  return {};
}

void require_service(LtcMethod method, const Material& material) {
  if (!serves(method, material))
    throw Error("material", "linearly transformed cosines serve isotropic ggx with shadowing, and ltc-compact charlie",
                "use the method closed-form or reference");
}

}  // namespace

bool serves(LtcMethod method, const Material& material) {
  if (material.brdf == Brdf::charlie) return method == LtcMethod::compact;
  return material.brdf == Brdf::ggx && material.shadowing && material.alpha_x == material.alpha_y;
}

Vec3d ltc_radiance(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at, const Material& material) {
  require_service(method, material);
  return radiance<double>(method, light, at, with_multiple_scattering(material, at));
}

Vec3d ltc_radiance_float(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at,
                         const Material& material) {
  require_service(method, material);
  return radiance<float>(method, light, at, with_multiple_scattering(material, at));
}

}  // namespace steradian
