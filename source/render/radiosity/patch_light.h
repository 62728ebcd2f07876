// PatchLight: the radiance that the sides of all patches reflect, after any number of bounces. PatchSolver computes it.
#pragma once

#include <array>
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
  const Patches& patches() const { return patches_; }
  // Radiance at a place that is on a side. A side beside a border of light has a direct light for each part.
  Vec3f radiance(PatchPlace at) const {
    const std::uint32_t parts = parts_of_[at.side];
    return parts == kNoSide ? radiance_[at.side] : radiance_[at.side] + change_in_parts_[parts][at.part];
  }
  // Radiance of direct light that a side's glossy lobe sends on in a direction. It comes on top of radiance(). wider: width to add to it.
  Vec3f glossy_radiance(std::uint32_t side, Vec3f to, float wider = 0) const { return glossy_.radiance(side, to, wider); }
  Vec3f radiance_towards(const BrightPlace& place, Vec3f to) const { return radiance_[place.side] + glossy_.radiance(place.side, to); }
  // Mean radiance over the group of sides around it: what patches of twice the size would send.
  Vec3f coarse_radiance(PatchPlace at) const { return coarse_[at.side]; }
  // Sides many times brighter than the mean of all that send light. Their light comes from bright_places().
  bool is_bright(std::uint32_t side) const { return !bright_.empty() && bright_[side] != 0; }
  const std::vector<BrightPlace>& bright_places() const { return places_; }
  float bright_area() const { return bright_area_; }       // mean of the places' areas
  double mean_radiance() const { return mean_radiance_; }  // luminance, over the sides that send light
  int iterations() const { return iterations_; }
  // Bound of the radiance that the bounces after the last iteration would add to any side. None if they do not become less.
  std::optional<float> left_out() const { return left_out_; }

 private:
  friend class PatchSolver;
  explicit PatchLight(Patches patches) : patches_(std::move(patches)), glossy_(patches_.side_count()) {}

  Patches patches_;
  GlossySides glossy_;
  std::vector<Vec3f> radiance_;                                  // by side
  std::vector<Vec3f> coarse_;                                    // by side
  std::vector<std::uint32_t> parts_of_;                          // by side: index below, or kNoSide
  std::vector<std::array<Vec3f, kPatchParts>> change_in_parts_;  // from the side's mean
  std::vector<std::uint8_t> bright_;                             // by side; empty: none is
  std::vector<BrightPlace> places_;
  float bright_area_ = 0;
  double mean_radiance_ = 0;
  int iterations_ = 0;
  std::optional<float> left_out_ = 0;
};

}  // namespace steradian::radiosity
