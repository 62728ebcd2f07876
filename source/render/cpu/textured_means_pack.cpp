#include <algorithm>
#include <array>
#include <vector>

#include "integrals/ltc/texture_cells.h"
#include "integrals/ltc/textured_light.h"
#include "render/cpu/seen_light_pack.h"
#include "render/cpu/table_pack.h"
#include "render/cpu/textured_means.h"

STERADIAN_BEGIN_ISA
namespace {

using View = TextureView<Pack>;
using PackMask = PackKernels::mask;
using Lanes = std::array<float, kLanes>;

// The cells that are not split, the worst of them first.
class OpenCells {
 public:
  OpenCells(const TexturedLight& light, const View& view)
      : tree_(light.tree()), texels_(light.texture().finest()), prepared_(view), expected_(of(tree_.cells().front().mean)) {
    parts_.reserve(256);
    worst_.reserve(256);
    radiance_ = PackVec3(1.0, 1.0, 1.0);
    open(tree_.cells().front(), 0, PackReal(1.0) > PackReal(0.0));
    sum();
  }

  // Splits cells until the mean is known in the lanes that are active; those for which no cell is small enough leave them.
  void settle(PackMask& active) {
    std::size_t next_sum = 32;
    for (int split = 0; split < TextureTree::kMostSplits; ++split) {
      PackMask wanted = unsettled(active);
      if (!any_lane(wanted)) {
        sum();
        wanted = unsettled(active);
        if (!any_lane(wanted)) return;
      }
      std::pop_heap(worst_.begin(), worst_.end());
      const Worst worst = worst_.back();
      worst_.pop_back();
      const Part part = parts_[worst.part];
      if (part.cell.depth == TextureTree::kDeepest) {
        active = active && !(share(part.seen) >= broadcast(worst.share));
        push({largest(share(part.seen), active), worst.part});
        continue;
      }
      weight_ = weight_ - part.seen.weight;
      radiance_ = radiance_ - part.seen.radiance;
      error_ = error_ - part.seen.error;
      for (int c = 0; c < 2; ++c) {
        const std::size_t at = c == 0 ? worst.part : parts_.size();
        const SeenCell<Pack>& seen = open(tree_.half(part.cell, c, texels_), at, wanted);
        weight_ = weight_ + seen.weight;
        radiance_ = radiance_ + seen.radiance;
        error_ = error_ + seen.error;
      }
      if (parts_.size() >= next_sum) {
        sum();
        next_sum *= 2;
      }
      expected_ = select(weight_ > PackReal(0.0), radiance_ * (PackReal(1.0) / max(weight_, PackReal(1e-37))), expected_);
    }
    sum();
  }

  // Where active: a lane has seen something.
  PackVec3 mean(PackMask& active) const {
    active = active && weight_ > PackReal(1e-37) && error_ < PackReal(1e30);
    return radiance_ * (PackReal(1.0) / select(active, weight_, PackReal(1.0)));
  }

 private:
  struct Part {
    TextureCell cell;
    SeenCell<Pack> seen;
  };
  struct Worst {
    float share;  // that it may leave off of the mean, in the lane where that is most
    std::size_t part;
    bool operator<(const Worst& other) const { return share < other.share; }
  };

  static PackVec3 of(Vec3d v) { return broadcast(static_cast<Vec3f>(v)); }

  // What a cell may leave off of the mean, as a share of it.
  PackReal share(const SeenCell<Pack>& seen) const { return seen.error / max(luminance_of(radiance_), PackReal(1e-30)); }
  static float largest(const PackReal& x, PackMask lanes) {
    alignas(64) Lanes values;
    store(values.data(), select(lanes, x, PackReal(-1.0)));
    return *std::max_element(values.begin(), values.end());
  }
  PackMask unsettled(PackMask active) const { return active && error_ > PackReal(TextureTree::kTolerance) * luminance_of(radiance_); }
  void push(const Worst& worst) {
    worst_.push_back(worst);
    std::push_heap(worst_.begin(), worst_.end());
  }
  const SeenCell<Pack>& open(const TextureCell& cell, std::size_t at, PackMask lanes) {
    if (at == parts_.size()) parts_.emplace_back();
    parts_[at] = {cell, seen_cell(cell, prepared_, expected_)};
    push({largest(share(parts_[at].seen), lanes), at});
    return parts_[at].seen;
  }
  // Afresh: differences leave their rounding in the sums.
  void sum() {
    weight_ = error_ = PackReal(0.0);
    radiance_ = PackVec3(0.0, 0.0, 0.0);
    for (const Part& part : parts_) {
      weight_ = weight_ + part.seen.weight;
      radiance_ = radiance_ + part.seen.radiance;
      error_ = error_ + part.seen.error;
    }
  }

  const TextureTree& tree_;
  const PlaneTexels texels_;
  const PreparedTextureView<Pack> prepared_;
  PackVec3 expected_;
  std::vector<Part> parts_;
  std::vector<Worst> worst_;  // a heap
  PackReal weight_, error_;
  PackVec3 radiance_;
};

// lobe(view, i): completes the view of the points from i on and returns their frame.
template <class LobeOf>
STERADIAN_INLINE void run(const TexturedLight& light, const Points& points, const float* wanted, const TexturedMeans& means, LobeOf lobe) {
  const FilteredTexture& texture = light.texture();
  const auto of = [](Vec3d v) { return broadcast(static_cast<Vec3f>(v)); };
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    PackMask active = load(wanted + i) > PackReal(0.0);
    PackVec3 mean(0.0, 0.0, 0.0);
    if (any_lane(active)) {
      View view;
      const PackKernels::mat3 frame = lobe(view, i);
      const PackVec3 p = load(points.position, i);
      view.origin = transform_transposed(frame, of(texture.origin()) - p);
      view.x = transform_transposed(frame, of(texture.axis_x()));
      view.y = transform_transposed(frame, of(texture.axis_y()));
      active = active && cells_resolve(view, light.tree().finest(), light.tree().bounds());
      if (any_lane(active)) {
        OpenCells cells(light, view);
        cells.settle(active);
        mean = cells.mean(active);
      }
    }
    store(means.r + i, mean.x);
    store(means.g + i, mean.y);
    store(means.b + i, mean.z);
    store(means.found + i, select(active, PackReal(1.0), PackReal(0.0)));
  }
}

void diffuse(const TexturedLight& light, const Points& points, const float* wanted, const TexturedMeans& means) {
  run(light, points, wanted, means, [&](View& view, std::size_t i) {
    PackKernels k;
    view.matrix = k.ltc_texture_diffuse();
    return k.frame_from_normal(load(points.normal, i));
  });
}

void ggx(const TexturedLight& light, const Points& points, const LtcPackTables& tables, const float* wanted, const TexturedMeans& means) {
  run(light, points, wanted, means, [&](View& view, std::size_t i) {
    PackKernels k;
    const PackVec3 n = load(points.normal, i), v = load(points.view, i);
    const PackReal width = max(sqrt(load(points.alpha_x + i) * load(points.alpha_y + i)), PackReal(kSmallestAlpha));
    const auto frame = k.frame_from_normal_and_view(n, v);
    const PackReal cosine = dot(n, v);
    const PackVec3 to_eye(dot(frame.c0, v), PackReal(0.0), cosine);
    const auto at = k.ltc_coordinates(sqrt(width), cosine);
    view.matrix = k.ltc_from_compact(look_up(tables.matrix.nodes.data(), tables.matrix.size, at.x, at.y), width, to_eye);
    view.is_ggx = true;
    view.ggx = k.ggx_view(to_eye, width, width);
    return frame;
  });
}

}  // namespace

const TexturedMeansTable& textured_means_table() {
  static constexpr TexturedMeansTable table = {diffuse, ggx};
  return table;
}

STERADIAN_END_ISA
