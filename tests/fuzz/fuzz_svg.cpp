#include "steradian/error.h"
#include "steradian/plane.h"
#include "steradian/plane_animation.h"
#include "targets.h"

namespace steradian::fuzz {

void svg(Input input) {
  try {
    const std::string text(reinterpret_cast<const char*>(input.data()), input.size());
    load_plane_scene_from_text(text, "scene.svg", kLimits);
    if (const PlaneAnimation animation(text, "scene.svg", kLimits); animation.moves()) animation.at(1.25);
  } catch (const Error&) {
  }
}

void svg_frame(Input input) {
  try {
    PlaneSvg loaded = load_plane_scene_from_text({reinterpret_cast<const char*>(input.data()), input.size()}, "scene.svg", kLimits);
    const PlaneWorld world(std::move(loaded.scene), kLimits);
    PlaneFrameOptions options;
    options.width = options.height = 16;
    options.threads = 1;
    options.limits = kLimits;
    render_plane(world, options);
  } catch (const Error&) {
  }
}

}  // namespace steradian::fuzz
