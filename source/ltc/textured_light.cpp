#include "ltc/textured_light.h"

#include <algorithm>
#include <cmath>

#include "ltc/ggx_tables.h"
#include "steradian/kernels.h"

namespace steradian {
namespace {

using K = Kernels<double>;

K::vec3 vector(Vec3d v) { return {v.x, v.y, v.z}; }

// A Gaussian wider than this many rms radii of the light is a ramp over it, whatever its width.
constexpr double kWidest = 4;
constexpr float kLeastCoverage = 1e-6f;

Vec3f look_up(const PreparedPolygon& light, const FilteredTexture& texture, const ShadingPoint& at, const K::mat3& frame,
              const K::LtcMatrix& m) {
  K k;
  const int side = light.side_of(at.position);
  auto walk = k.ltc_begin();
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    const std::size_t begin = light.contours[c], end = light.contours[c + 1];
    const auto direction = [&](std::size_t i) {
      return k.polygon_direction(transform_transposed(frame, vector(light.vertices[i] - at.position)));
    };
    auto a = direction(end - 1), ta = k.ltc_direction(m, a);
    for (std::size_t i = begin; i < end; ++i) {
      const auto b = direction(i), tb = k.ltc_direction(m, b);
      walk = k.ltc_add_edge(walk, m, a, b, ta, tb);
      a = b;
      ta = tb;
    }
  }
  const auto phi = k.ltc_texture_irradiance_vector(walk, K::mask(side < 0));
  const auto normal = transform_transposed(frame, vector(light.normal));
  const auto f = k.ltc_texture_footprint(m, phi, normal, dot(light.normal, light.centroid - at.position));
  if (!any_lane(f.valid)) return texture.mean();

  const auto axis_x = transform_transposed(frame, vector(texture.axis_x()));
  const auto axis_y = transform_transposed(frame, vector(texture.axis_y()));
  const auto ellipse = k.ltc_texture_axes({dot(f.axis_a, axis_x), dot(f.axis_a, axis_y)}, {dot(f.axis_b, axis_x), dot(f.axis_b, axis_y)});
  const Vec3d to_origin = texture.origin() - at.position;
  const double x = dot(f.center, axis_x).v - dot(to_origin, texture.axis_x());
  const double y = dot(f.center, axis_y).v - dot(to_origin, texture.axis_y());
  const auto centroid = texture.centroid();
  const auto covariance = texture.covariance();
  const K::vec3 shape(covariance[0], covariance[1], covariance[2]);
  const K::vec2 aside(x - centroid[0], y - centroid[1]);
  // Of the logarithm of the cosine: z under M^-1 is linear over the plane.
  const auto z = max(k.ltc_transform(m, f.center).z, 1.0e-30);
  const K::vec2 slope(k.ltc_transform(m, axis_x).z / z, k.ltc_transform(m, axis_y).z / z);
  const double widest = kWidest * std::sqrt(covariance[0] + covariance[2]);
  FilteredTexture::Sum sum;
  for (const TextureGaussian& part : kMixture) {
    const auto g = k.ltc_texture_gaussian(ellipse, part.width, widest);
    const auto place = k.ltc_texture_place(g, aside, slope, shape);
    const auto under = [&](double px, double py) {
      return texture.under({px, py, g.major.x.v, g.major.y.v, g.minor.v});
    };
    // Its share of the light is that of where the lobe looks; only its centroid is moved.
    const FilteredTexture::Sum here = under(x, y), there = under(centroid[0] + place.x.v, centroid[1] + place.y.v);
    const bool off = !(there.rgbw[3] > kLeastCoverage);
    const auto weight = static_cast<float>(part.weight);
    sum.add(off ? here : there, off ? weight : weight * here.rgbw[3] / there.rgbw[3]);
  }
  return texture.radiance(sum);
}

}  // namespace

Vec3f TexturedLight::seen_by_diffuse(const ShadingPoint& at) const {
  K k;
  return look_up(polygon_, texture_, at, k.frame_from_normal(vector(at.normal)), k.ltc_texture_diffuse());
}

Vec3f TexturedLight::seen_by_ggx(const ShadingPoint& at, double alpha) const {
  K k;
  const double cosine = dot(at.normal, at.view);
  if (!(cosine > 0)) return texture_.mean();
  const auto frame = k.frame_from_normal_and_view(vector(at.normal), vector(at.view));
  auto view = transform_transposed(frame, vector(at.view));
  view.y = 0.0;
  const double width = std::max(alpha, 1e-4);
  const LtcShape shape = ggx_compact_table().entry(std::sqrt(width), cosine).shape;
  K::vec4 e;
  e.x = shape.e00, e.y = shape.e11, e.z = shape.e02, e.w = shape.e20;
  return look_up(polygon_, texture_, at, frame, k.ltc_from_compact(e, width, view));
}

}  // namespace steradian
