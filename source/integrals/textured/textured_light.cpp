#include "integrals/textured/textured_light.h"

#include <algorithm>
#include <cmath>

#include "integrals/tables/ggx_tables.h"
#include "integrals/textured/texture_mean.h"

namespace steradian {
namespace {

using K = Kernels<double>;

// A lobe at a point. ggx: half vectors for which the lobe is GGX, or null.
struct Seeing {
  K::mat3 frame;
  K::LtcMatrix m;
  const K::GgxView* ggx = nullptr;
};

// Mean over the texture's cells.
TextureMean<double> over_cells(const FilteredTexture& texture, const TextureTree& tree, const ShadingPoint& at, const Seeing& s) {
  const auto turned = [&](Vec3d v) { return transform_transposed(s.frame, integrals::to_kernel<double>(v)); };
  const auto view =
      Kernels<double>().ltc_texture_cell_view(s.m, s.ggx != nullptr ? 1 : 0, s.ggx != nullptr ? *s.ggx : K::GgxView{},
                                              turned(texture.origin() - at.position), turned(texture.axis_x()), turned(texture.axis_y()));
  return TextureCells<double>(tree, texture.finest(), view).mean(K::mask(true));
}

// Look-up around the centre of the lobe's footprint.
Vec3f look_up(const PreparedPolygon& light, const FilteredTexture& texture, const ShadingPoint& at, const Seeing& s) {
  K k;
  const auto& [frame, m, ggx] = s;
  // Any view serves: the matrix determines the lobe's direction.
  const auto shading = integrals::Shading<double>{K::vec3(0.0, 0.0, 1.0), K::mask(true), K::mask(light.side_of(at.position) < 0)};
  integrals::LtcVector<double> integral({m});
  const auto phi = integrate(integrals::contours_in<double>(light, frame, at.position), shading, integral);
  const auto normal = transform_transposed(frame, integrals::to_kernel<double>(light.normal));
  const auto f = k.ltc_texture_footprint(m, phi, normal, dot(light.normal, light.centroid - at.position));
  if (!any_lane(f.valid)) return texture.mean();

  const auto axis_x = transform_transposed(frame, integrals::to_kernel<double>(texture.axis_x()));
  const auto axis_y = transform_transposed(frame, integrals::to_kernel<double>(texture.axis_y()));
  const auto ellipse = k.ltc_texture_axes({dot(f.axis_a, axis_x), dot(f.axis_a, axis_y)}, {dot(f.axis_b, axis_x), dot(f.axis_b, axis_y)});
  const Vec3d to_origin = texture.origin() - at.position;
  const double x = dot(f.center, axis_x).v - dot(to_origin, texture.axis_x());
  const double y = dot(f.center, axis_y).v - dot(to_origin, texture.axis_y());
  const auto centroid = texture.centroid();
  const auto covariance = texture.covariance();
  const K::vec3 shape(covariance[0], covariance[1], covariance[2]);
  const K::vec2 aside(x - centroid[0], y - centroid[1]);
  // Slope of the logarithm of the cosine: z under M^-1 is linear over the plane.
  const auto z = max(k.ltc_transform(m, f.center).z, 1.0e-30);
  const K::vec2 slope(k.ltc_transform(m, axis_x).z / z, k.ltc_transform(m, axis_y).z / z);
  const double widest = static_cast<double>(kTextureWidest) * std::sqrt(covariance[0] + covariance[2]);
  FilteredTexture::Sum sum;
  for (const TextureGaussian& part : kMixture) {
    const auto g = k.ltc_texture_gaussian(ellipse, part.width, widest);
    const auto place = k.ltc_texture_place(g, aside, slope, shape);
    const auto under = [&](double px, double py) { return texture.under({px, py, g.major.x.v, g.major.y.v, g.minor.v}); };
    // Its fraction of the light is that at the footprint's centre; only its centroid is moved.
    const FilteredTexture::Sum here = under(x, y), there = under(centroid[0] + place.x.v, centroid[1] + place.y.v);
    const bool off = !(there.rgbw[3] > kTextureLeastCoverage);
    const auto weight = static_cast<float>(part.weight);
    sum.add(off ? here : there, off ? weight : weight * here.rgbw[3] / there.rgbw[3]);
  }
  return texture.radiance(sum);
}

Vec3f seen(const PreparedPolygon& light, const FilteredTexture& texture, const TextureTree& tree, const ShadingPoint& at, const Seeing& s,
           TextureWay way) {
  if (way == TextureWay::either) {
    const auto mean = over_cells(texture, tree, at, s);
    if (any_lane(mean.found)) return static_cast<Vec3f>(Vec3d{mean.radiance.x.v, mean.radiance.y.v, mean.radiance.z.v});
  }
  return look_up(light, texture, at, s);
}

}  // namespace

Vec3f TexturedLight::seen_by_diffuse(const ShadingPoint& at, TextureWay way) const {
  K k;
  return seen(polygon_, texture_, tree_, at, {k.frame_from_normal(integrals::to_kernel<double>(at.normal)), k.ltc_texture_diffuse()}, way);
}

Vec3f TexturedLight::seen_by_ggx(const ShadingPoint& at, double alpha, TextureWay way) const {
  K k;
  const double cosine = dot(at.normal, at.view);
  if (!(cosine > 0)) return texture_.mean();
  const auto frame = k.frame_from_normal_and_view(integrals::to_kernel<double>(at.normal), integrals::to_kernel<double>(at.view));
  auto view = transform_transposed(frame, integrals::to_kernel<double>(at.view));
  view.y = 0.0;
  const double width = std::max(alpha, kSmallestAlpha);
  const auto lobe = compact_lobe<double>(ggx_compact_table(), width, cosine, view);
  const auto ggx = K().ggx_view(view, width, width);
  return seen(polygon_, texture_, tree_, at, {frame, lobe.matrix, &ggx}, way);
}

}  // namespace steradian
