// The mean of a textured light under one lobe, over cells of the light (texture_tree.h), for the numbers S of a kernel.
#pragma once

#include <algorithm>

#include "integrals/textured/texture_tree.h"
#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

//   found  false if the lobe is too narrow for the cells: it then covers a part of the texture larger than its texels, and a
//          look-up serves
template <class S>
struct TextureMean {
  typename Kernels<S>::vec3 radiance;
  Mask<S> found;
};

// Cells whose bounds are above a threshold are split. The threshold falls from pass to pass, by the remaining excess, until the bounds sum
// to kTextureTolerance of the mean. After too many splits it rises again. So every lane uses the cells of its own threshold, whatever the
// others do, and no pass stores more than a path. shaders/lights/texture_means.comp does the same.
template <class S>
class TextureCells {
 public:
  using K = Kernels<S>;
  using real = Real<S>;
  using vec3 = typename K::vec3;
  using View = typename K::LtcTextureCellView;

  TextureCells(const TextureTree& tree, const PlaneTexels& texels, const View& view) : tree_(tree), texels_(texels), view_(view) {}

  TextureMean<S> mean(Mask<S> active) {
    K k;
    const std::array<double, 4>& b = tree_.bounds();
    active = active && k.ltc_texture_cell_resolves(view_, tree_.finest(), {real(b[0]), real(b[1]), real(b[2]), real(b[3])});
    if (!any_lane(active)) return {vec3(0.0, 0.0, 0.0), active};
    const TextureCell& whole = tree_.cells().front();
    const real zero(0.0), least(1e-37);
    expected_ = constant(whole.mean);
    Sums seen;
    add(seen, k.ltc_texture_cell_seen(packed(whole), view_, expected_), active);
    threshold_ = seen.error;
    Mask<S> open = active, over = real(1.0) < zero, closing = over;
    for (int pass = 0; pass < kTexturePasses; ++pass) {
      const real allowed = static_cast<real>(kTextureTolerance) * k.ltc_texture_cell_luminance(seen.radiance);
      open = open && seen.error > allowed;
      if (!any_lane(open)) break;
      const real share = allowed / select(open, seen.error, real(1.0));
      const real lower = min(max(share * share * static_cast<real>(kTextureMargin), static_cast<real>(kTextureSteepest)), real(0.5));
      threshold_ = threshold_ * select(over, static_cast<real>(kTextureBack), lower);
      expected_ = select(seen.weight > least, seen.radiance * (real(1.0) / max(seen.weight, least)), expected_);
      sums_ = {};
      splits_ = zero;
      too_deep_ = real(1.0) < zero;
      visit(whole, whole, open);
      over = splits_ > static_cast<real>(kTextureSplits);
      closing = closing || over;
      active = active && !too_deep_;
      const auto taken = open && !too_deep_ && !over;
      seen.weight = select(taken, sums_.weight, seen.weight);
      seen.radiance = select(taken, sums_.radiance, seen.radiance);
      seen.error = select(taken, sums_.error, seen.error);
      open = open && !too_deep_ && (over || !closing);
    }
    active = active && seen.weight > least && seen.error < real(1e30);
    return {seen.radiance * (real(1.0) / select(active, seen.weight, real(1.0))), active};
  }

 private:
  struct Sums {
    real weight{0.0}, error{0.0};
    vec3 radiance{0.0, 0.0, 0.0};
  };

  static vec3 constant(const Vec3d& v) { return {real(v.x), real(v.y), real(v.z)}; }

 public:
  static typename K::LtcTextureCell packed(const TextureCell& c) {
    const auto place = [](const std::array<double, 2>& v) { return typename K::vec2(real(v[0]), real(v[1])); };
    typename K::LtcTextureCell cell;
    cell.center = place(c.center);
    cell.axis_a = place(c.axis_a);
    cell.axis_b = place(c.axis_b);
    cell.area = c.area;
    cell.radius = c.radius;
    cell.deviation = c.deviation;
    cell.mean = constant(c.mean);
    cell.along_a = constant(c.along_a);
    cell.along_b = constant(c.along_b);
    return cell;
  }

 private:
  static void add(Sums& sums, const typename K::LtcTextureCellSeen& seen, Mask<S> lanes) {
    const real zero(0.0);
    sums.weight = sums.weight + select(lanes, seen.weight, zero);
    sums.radiance = sums.radiance + select(lanes, seen.radiance, vec3(0.0, 0.0, 0.0));
    sums.error = sums.error + select(lanes, seen.error, zero);
  }

  // smallest: the cell itself, or the smallest cell above it.
  void visit(const TextureCell& cell, const TextureCell& smallest, Mask<S> lanes) {
    if (!(cell.area > 0)) return;
    const auto seen = K().ltc_texture_cell_seen(packed(cell), view_, expected_);
    auto splits = lanes && seen.error > threshold_;
    if (cell.depth == kTextureDeepest) {
      too_deep_ = too_deep_ || (splits && !(splits_ > static_cast<real>(kTextureSplits)));
      splits = splits && !splits;
    }
    add(sums_, seen, lanes && !splits);
    splits_ = splits_ + select(splits, real(1.0), real(0.0));
    splits = splits && !(splits_ > static_cast<real>(kTextureSplits));
    if (!any_lane(splits)) return;
    if (cell.children > 0) {
      const auto first = static_cast<std::size_t>(cell.children);
      visit(tree_.cells()[first], tree_.cells()[first], splits);
      visit(tree_.cells()[first + 1], tree_.cells()[first + 1], splits);
    } else {
      visit(tree_.half(cell, 0, smallest, texels_), smallest, splits);
      visit(tree_.half(cell, 1, smallest, texels_), smallest, splits);
    }
  }

  const TextureTree& tree_;
  const PlaneTexels texels_;
  const View view_;
  vec3 expected_;  // mean of the last pass
  real threshold_, splits_;
  Mask<S> too_deep_;
  Sums sums_;
};

STERADIAN_END_ISA
