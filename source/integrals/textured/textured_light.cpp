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

K::LtcTextureCellView view_of(const FilteredTexture& texture, const ShadingPoint& at, const Seeing& s) {
  const auto turned = [&](Vec3d v) { return transform_transposed(s.frame, integrals::to_kernel<double>(v)); };
  return Kernels<double>().ltc_texture_cell_view(s.m, s.ggx != nullptr ? 1 : 0, s.ggx != nullptr ? *s.ggx : K::GgxView{},
                                                 turned(texture.origin() - at.position), turned(texture.axis_x()),
                                                 turned(texture.axis_y()));
}

// Mean over the texture's cells.
TextureMean<double> over_cells(const FilteredTexture& texture, const TextureTree& tree, const ShadingPoint& at, const Seeing& s) {
  return TextureCells<double>(tree, texture.finest(), view_of(texture, at, s)).mean(K::mask(true));
}

// Sums over the cells that are visible in whole or in part. Cells in part are split to the smallest, which count by their visible fraction.
class VisibleCells {
 public:
  VisibleCells(const TextureTree& tree, const PlaneTexels& texels, const K::LtcTextureCellView& view, const PlaneRegion& visible)
      : tree_(tree), texels_(texels), view_(view), visible_(visible) {
    const TextureCell& whole = tree.cells().front();
    expected_ = K::vec3(whole.mean.x, whole.mean.y, whole.mean.z);
    // A cell may be off by this; a few dozen cells make up most of the sum.
    constexpr double kCells = 64;
    allowed_ = static_cast<double>(kTextureTolerance) / kCells * K().ltc_texture_cell_luminance(seen(whole).radiance).v;
    add(whole, {0, texels.width, 0, texels.height});
  }
  std::optional<Vec3d> mean() const {
    if (!(weight_ > 0)) return {};
    return radiance_ / weight_;
  }

 private:
  struct Texels {
    int left, right, bottom, top;
    int width() const { return right - left; }
    int height() const { return top - bottom; }
  };
  K::LtcTextureCellSeen seen(const TextureCell& cell) const {
    return K().ltc_texture_cell_seen(TextureCells<double>::packed(cell), view_, expected_);
  }
  void add(const TextureCell& cell, const Texels& t) {
    if (!(cell.area > 0)) return;
    const auto x = [&](int i) { return texels_.left + (i - 0.5) * texels_.spacing; };
    const auto y = [&](int j) { return texels_.bottom + (j - 0.5) * texels_.spacing; };
    const Box2d box{{x(t.left), y(t.bottom)}, {x(t.right), y(t.top)}};
    const double share = std::fabs(visible_.area_in(box)) / (box.size().x * box.size().y);
    constexpr double kNone = 1e-6;  // the boundary is rounded to 1.2e-7 of the light
    if (share < kNone) return;
    const auto s = seen(cell);
    const bool whole = share > 1 - kNone;
    if (cell.children > 0 && (!whole || s.error.v > allowed_)) {
      const auto first = static_cast<std::size_t>(cell.children);
      const bool wide = t.width() >= t.height();
      const int middle = wide ? (t.left + t.right) / 2 : (t.bottom + t.top) / 2;
      add(tree_.cells()[first], wide ? Texels{t.left, middle, t.bottom, t.top} : Texels{t.left, t.right, t.bottom, middle});
      add(tree_.cells()[first + 1], wide ? Texels{middle, t.right, t.bottom, t.top} : Texels{t.left, t.right, middle, t.top});
      return;
    }
    weight_ += share * s.weight.v;
    radiance_ += Vec3d{s.radiance.x.v, s.radiance.y.v, s.radiance.z.v} * share;
  }

  const TextureTree& tree_;
  const PlaneTexels texels_;
  const K::LtcTextureCellView view_;
  const PlaneRegion& visible_;
  K::vec3 expected_;
  double allowed_ = 0, weight_ = 0;
  Vec3d radiance_{};
};

// None where the lobe sees less than the smallest cells.
std::optional<Vec3d> over_visible(const FilteredTexture& texture, const TextureTree& tree, const ShadingPoint& at, const Seeing& s,
                                  const PlaneRegion& visible) {
  const auto view = view_of(texture, at, s);
  const std::array<double, 4>& b = tree.bounds();
  if (!any_lane(K().ltc_texture_cell_resolves(view, tree.finest(), {b[0], b[1], b[2], b[3]}))) return {};
  return VisibleCells(tree, texture.finest(), view, visible).mean();
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
           TextureWay way, const PlaneRegion* visible) {
  if (visible != nullptr)
    if (const std::optional<Vec3d> mean = over_visible(texture, tree, at, s, *visible)) return static_cast<Vec3f>(*mean);
  if (way == TextureWay::either) {
    const auto mean = over_cells(texture, tree, at, s);
    if (any_lane(mean.found)) return static_cast<Vec3f>(Vec3d{mean.radiance.x.v, mean.radiance.y.v, mean.radiance.z.v});
  }
  return look_up(light, texture, at, s);
}

}  // namespace

Vec3f TexturedLight::diffuse(const ShadingPoint& at, TextureWay way, const PlaneRegion* visible) const {
  K k;
  return seen(polygon_, texture_, tree_, at, {k.frame_from_normal(integrals::to_kernel<double>(at.normal)), k.ltc_texture_diffuse()}, way,
              visible);
}

Vec3f TexturedLight::ggx(const ShadingPoint& at, double alpha, TextureWay way, const PlaneRegion* visible,
                         const ClassicTable* fitted) const {
  K k;
  const double cosine = dot(at.normal, at.view);
  if (!(cosine > 0)) return texture_.mean();
  const auto frame = k.frame_from_normal_and_view(integrals::to_kernel<double>(at.normal), integrals::to_kernel<double>(at.view));
  auto view = transform_transposed(frame, integrals::to_kernel<double>(at.view));
  view.y = 0.0;
  const double width = std::max(alpha, kSmallestAlpha);
  if (fitted != nullptr)
    return seen(polygon_, texture_, tree_, at, {frame, classic_lobe<double>(*fitted, width, cosine).matrix}, way, visible);
  const auto lobe = compact_lobe<double>(ggx_compact_table(), width, cosine, view);
  const auto ggx = K().ggx_view(view, width, width);
  return seen(polygon_, texture_, tree_, at, {frame, lobe.matrix, &ggx}, way, visible);
}

Vec3f TexturedLight::seen_by_diffuse(const ShadingPoint& at, TextureWay way) const { return diffuse(at, way, nullptr); }
Vec3f TexturedLight::seen_by_diffuse(const ShadingPoint& at, const PlaneRegion& visible) const {
  return diffuse(at, TextureWay::either, &visible);
}
Vec3f TexturedLight::seen_by_ggx(const ShadingPoint& at, double alpha, TextureWay way, const ClassicTable* fitted) const {
  return ggx(at, alpha, way, nullptr, fitted);
}
Vec3f TexturedLight::seen_by_ggx(const ShadingPoint& at, double alpha, const PlaneRegion& visible, const ClassicTable* fitted) const {
  return ggx(at, alpha, TextureWay::either, &visible, fitted);
}

}  // namespace steradian
