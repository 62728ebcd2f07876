// KeptPatches: the light of all patches of the last pictures, for the next picture of the same light. A camera that moves changes none of
// it.
#pragma once

#include <array>
#include <memory>

#include "render/radiosity/patch_light.h"
#include "steradian/render.h"

namespace steradian::radiosity {

class KeptPatches {
 public:
  // The light of the patches of this scene, computed with these options; null if none is kept.
  std::shared_ptr<const PatchLight> find(const Scene& scene, const RenderOptions& options) const;
  // Keeps it until another one is kept with the same bounce_preview.
  void keep(const Scene& scene, const RenderOptions& options, std::shared_ptr<const PatchLight> light);

 private:
  struct Kept {
    Scene scene;  // without cameras
    RenderOptions options;
    std::shared_ptr<const PatchLight> light;
  };
  std::array<Kept, 2> kept_;  // of pictures, and of previews
};

}  // namespace steradian::radiosity
