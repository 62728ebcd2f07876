// Direct specular light of a tile without sampling.
#pragma once

#include <vector>

#include "render/direct/lobe_packs.h"
#include "render/frame/methods.h"
#include "render/lights/light_list.h"
#include "render/surface/surface.h"
#include "render/tile/tile.h"
#include "steradian/reference.h"

namespace steradian {

namespace lights {
struct FarLights;
struct LobeElements;
}  // namespace lights
struct ProfiledMeans;

// Lobes of metallic-roughness surfaces and their coats run on packs, and so do Phong, Beckmann and Blinn-Phong lobes. Other lobes run point
// by point in float.
class SpecularPass {
 public:
  explicit SpecularPass(const DirectMethod& method);

  // True if add() also adds the diffuse light of a light: one walk along a polygon serves both lobes.
  bool brings_diffuse(const SurfaceTile& tile, const PackLight& light) const;

  // Adds the specular light of the lights to tile.radiance, and the diffuse light that comes with it, if wanted.
  enum class Walk { both_lobes, specular_alone };
  // far: flat lights become elements if their error is at most that, in methods of transformed cosines. Their errors are added to `bound`.
  struct Far {
    const lights::FarLights& lights;
    float error;
    TileVector& bound;
  };
  void add(SurfaceTile& tile, const std::vector<const PackLight*>& lights, Walk walk = Walk::both_lobes, const Far* far = nullptr) const;

 private:
  struct Lobe;
  void add_ggx(SurfaceTile& tile, const Lobe& lobe, const std::vector<const PackLight*>& lights) const;
  static void find_profiled_means(const ProfiledLight& light, const Points& points, const Lobe& lobe, const LobeRadiance& even,
                                  const ProfiledMeans& means);
  void add_far_ggx(SurfaceTile& tile, const Lobe& lobe, const std::vector<const PackLight*>& lights, const Far& far) const;
  void add_sheen(SurfaceTile& tile, const std::vector<const PackLight*>& lights) const;
  bool add_ggx_override(SurfaceTile& tile, const SurfaceMaterial& surface, const Material& m,
                        const std::vector<const PackLight*>& lights) const;
  void add_overrides(SurfaceTile& tile, const std::vector<const PackLight*>& lights) const;
  Material ggx_material(const Lobe& lobe, const SurfaceTile& tile, std::size_t i) const;
  void integrate_ggx(const PackLight& light, const Points& points, const LobeRadiance& result) const;

  const DirectMethod method_;
  const methods::Procedure procedure_;  // of layered GGX
  const LobePacks& packs_;
  const lights::LobeElements* const elements_;
  const LtcPackTables tables_;
  const LtcPackTables compact_tables_;  // these also give the width of a lobe
};

}  // namespace steradian
