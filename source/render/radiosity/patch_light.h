// PatchLight: the radiance that the sides of all patches reflect, after any number of bounces.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/mip_maps.h"
#include "render/radiosity/bounce_rays.h"
#include "render/radiosity/glossy_sides.h"
#include "render/radiosity/patches.h"
#include "render/tile/tile.h"

namespace steradian::radiosity {

struct PatchOptions {
  int bounces = kAllBounces;  // of the light in the picture: the last one is that of the gather
  Quality quality = Quality::normal;
};

// Stores a white diffuse surface in the place of another, so that the radiance that it reflects is its irradiance over pi.
void put_white(SurfaceTile& tile, std::size_t slot, const Surface& surface);

// A place that stands for an equal part of the light of all bright sides, which few directions of a gather would meet.
struct BrightPlace {
  Vec3f position, normal;
  std::uint32_t side;
  float area;  // that it stands for
};

class PatchLight {
 public:
  // Adds the direct light of a tile's surfaces to their radiance.
  using AddDirect = std::function<void(SurfaceTile& tile)>;

  // Appends the light that reaches a surface from directions. number: seed of the directions.
  using FindIncident = std::function<void(const Surface& surface, std::uint64_t number, std::vector<IncidentLight>& found)>;

  // Computes all radiances, on the threads of the caller's arena. The scene, its rays and its mip maps must outlive this object.
  PatchLight(const Scene& scene, const RayScene& rays, const MipMaps& maps, const PatchOptions& options, const AddDirect& add_direct,
             const FindIncident& find_incident);

  // Number of calls of add_direct, for progress.
  static std::size_t direct_tiles(const Scene& scene, Quality quality);

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
  Surface surface_of(std::uint32_t side) const;
  Surface surface_at_site(std::uint32_t side, const Patches::Site& at) const;
  void find_direct(const AddDirect& add_direct);
  void refine_direct(const AddDirect& add_direct);
  void find_glossy(const FindIncident& find_incident);
  void find_links(std::size_t rays);
  void iterate(int bounces);
  void find_coarse();
  void find_bright_sides();
  float area_of(std::uint32_t side) const;
  float turn_of(std::uint32_t side) const;

  const Scene& scene_;
  const RayScene& rays_;
  const MipMaps& maps_;
  const Patches patches_;
  GlossySides glossy_;
  std::vector<Vec3f> reflectance_, direct_, radiance_;           // by side
  std::vector<Vec3f> even_glossy_;                               // by side: mean radiance of its glossy lobe
  std::vector<Vec3f> from_glossy_;                               // by side: mean radiance that glossy lobes of other sides send there
  std::vector<Vec3f> coarse_;                                    // by side
  std::vector<std::uint32_t> parts_of_;                          // by side: index below, or kNoSide
  std::vector<std::array<Vec3f, kPatchParts>> change_in_parts_;  // from the side's mean
  std::size_t links_per_side_ = 0;
  std::vector<std::uint32_t> links_;  // sides that the rays of each side meet
  std::vector<std::uint8_t> bright_;  // by side; empty: none is
  std::vector<BrightPlace> places_;
  float bright_area_ = 0;
  double mean_radiance_ = 0;
  int iterations_ = 0;
  std::optional<float> left_out_ = 0;
};

}  // namespace steradian::radiosity
