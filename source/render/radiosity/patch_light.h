// PatchLight: the radiance that the sides of all patches reflect, after any number of bounces. PatchSolver computes it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/radiosity/glossy_sides.h"
#include "render/radiosity/patches.h"

namespace steradian::radiosity {

// A place that stands for an equal part of the light of all bright sides, which few directions of a gather would meet.
struct BrightPlace {
  Vec3f position, normal;
  std::uint32_t side;
  float area;  // that it stands for
};

class PatchLight {
 public:
  const Patches& patches() const { return *patches_; }
  // Radiance at a place that is on a side. A side beside a border of light has a direct light for each part.
  Vec3f radiance(PatchPlace at) const {
    const Side& side = sides_[at.side];
    return side.parts == kNoParts ? side.radiance : side.radiance + change_in_parts_[side.parts][at.part];
  }
  // Radiance that a side's glossy lobe sends on in a direction. It comes on top of radiance(). wider: width to add to it.
  Vec3f glossy_radiance(std::uint32_t side, Vec3f to, float wider) const { return glossy_.radiance(sides_[side].glossy, to, wider); }
  // The same for rays that cover all sides.
  Vec3f glossy_radiance(std::uint32_t side, Vec3f to) const { return glossy_.radiance_for_few_rays(sides_[side].glossy, to); }
  bool has_lobe(std::uint32_t side) const { return sides_[side].glossy != GlossySides::kNone; }
  Vec3f radiance_towards(const BrightPlace& place, Vec3f to) const { return sides_[place.side].radiance + glossy_radiance(place.side, to); }
  // Mean radiance over the group of sides around it: what patches of twice the size would send.
  Vec3f coarse_radiance(PatchPlace at) const { return sides_[at.side].coarse; }
  // Sides many times brighter than the mean of all that send light. Their light comes from bright_places().
  bool is_bright(std::uint32_t side) const { return sides_[side].bright != 0; }
  const std::vector<BrightPlace>& bright_places() const { return places_; }
  float bright_area() const { return bright_area_; }       // mean of the places' areas
  double mean_radiance() const { return mean_radiance_; }  // luminance, over the sides that send light
  int iterations() const { return iterations_; }
  std::uint64_t traced() const { return traced_; }  // rays from side to side that were traced for it
  // Fractions of the light that all sides send on: by their glossy lobes, and by those of them that send it evenly to all directions.
  struct GlossyShares {
    double all = 0, evenly = 0;
  };
  GlossyShares glossy_shares() const { return glossy_shares_; }
  // Bound of the radiance that the bounces after the last iteration would add to any side. None if they do not become less.
  std::optional<float> left_out() const { return left_out_; }

 private:
  friend class PatchSolver;
  explicit PatchLight(std::shared_ptr<const Patches> patches) : patches_(std::move(patches)), sides_(patches_->side_count()) {}

  static constexpr std::uint32_t kNoParts = (1u << 31) - 1;
  // All that a ray asks of a side, in half a cache line.
  struct alignas(32) Side {
    Vec3f radiance, coarse;
    std::uint32_t parts : 31 = kNoParts;  // index of change_in_parts_
    std::uint32_t bright : 1 = 0;
    std::uint32_t glossy = GlossySides::kNone;  // lobe of glossy_
  };

  std::shared_ptr<const Patches> patches_;
  GlossySides glossy_;
  std::vector<Side> sides_;
  std::vector<std::array<Vec3f, kPatchParts>> change_in_parts_;  // from the side's mean
  std::vector<BrightPlace> places_;
  float bright_area_ = 0;
  double mean_radiance_ = 0;
  int iterations_ = 0;
  std::uint64_t traced_ = 0;
  std::optional<float> left_out_ = 0;
  GlossyShares glossy_shares_;
};

}  // namespace steradian::radiosity
