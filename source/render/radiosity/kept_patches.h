// KeptPatches: the light of all patches of the last pictures, for the next picture of the same light. A camera that moves changes none of
// it. Lights that change leave the patches, and what their rays meet but for the lights' own shapes.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "render/radiosity/patch_light.h"
#include "render/radiosity/patch_links.h"
#include "steradian/render.h"

namespace steradian::radiosity {

class KeptPatches {
 public:
  // links: those that serve the scene, or null; it sets them.
  using Solve = std::function<std::shared_ptr<const PatchLight>(std::shared_ptr<const PatchLinks>& links)>;
  // The light of the patches of this scene with these options: the kept one, or that of `solve`. It is kept until another one comes with
  // the same bounce_preview, unless options.stop ended it.
  std::shared_ptr<const PatchLight> light(const Scene& scene, const RenderOptions& options, const Solve& solve);

 private:
  struct Kept {
    Scene scene;  // without cameras
    RenderOptions options;
    std::shared_ptr<const PatchLight> light;
    std::shared_ptr<const PatchLinks> links;
  };
  std::array<Kept, 2> kept_;  // of pictures, and of previews
};

}  // namespace steradian::radiosity
