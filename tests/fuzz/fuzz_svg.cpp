#include "steradian/error.h"
#include "steradian/plane.h"
#include "targets.h"

namespace steradian::fuzz {

void svg(Input input) {
  try {
    load_plane_scene_from_text({reinterpret_cast<const char*>(input.data()), input.size()}, "scene.svg", kLimits);
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
