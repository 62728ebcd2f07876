// GlossySides: the light that the glossy lobes of sides send on, by direction.
//
// A side keeps its lobe and the places, on lights and on other sides, that its middle sees. Each place's light leaves along the lobe, which
// is widened by the spacing of the places and by the turn of the normals within the side. Neighbouring places of one light whose cone is
// small beside the lobe become one.
#pragma once

#include <cstdint>
#include <vector>

#include "render/radiosity/glossy_places.h"
#include "render/sampled/monte_carlo.h"
#include "render/surface/surface.h"
#include "steradian/vector.h"

namespace steradian::radiosity {

class GlossySides {
 public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  // True if a surface's glossy lobe is one that these sides can keep.
  static bool has_lobe(const Surface& surface);
  // Keeps the lobe of a side's surface and its light. irradiance: of all the incident light; it is scaled to that.
  // turn: angle between the normals in the middle and at the border. besides: number of a lobe of the side whose light it has, too.
  // Returns the lobe's number, or kNone if no light arrives.
  std::uint32_t keep(const Surface& surface, const std::vector<IncidentLight>& incident, Vec3f irradiance, float turn,
                     std::uint32_t besides = kNone);

  // Radiance that a lobe sends in a direction of the scene. wider: width to add to the lobe.
  Vec3f radiance(std::uint32_t lobe, Vec3f to, float wider) const { return lobe == kNone ? Vec3f{} : sent(lobes_[lobe], to, wider, false); }
  // The same for rays that cover all sides. Few meet a narrow lobe, which is widened for them and sends as much light as before.
  Vec3f radiance_for_few_rays(std::uint32_t lobe, Vec3f to) const {
    return lobe == kNone ? Vec3f{} : sent(lobes_[lobe], to, lobes_[lobe].wider, true);
  }

 private:
  struct KeptLobe {
    Vec3f x, y, z;  // frame
    Vec3f f0, f90;
    std::size_t first, count;  // places
    float wider;               // for few rays
  };
  Vec3f sent(const KeptLobe& lobe, Vec3f to, float wider, bool keeps_energy) const;

  std::vector<KeptLobe> lobes_;
  GlossyPlaces places_;
  const GlossyTable* packs_ = &glossy_table_for(active_simd());
};

}  // namespace steradian::radiosity
