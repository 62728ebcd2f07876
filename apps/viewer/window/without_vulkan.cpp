// Stands for vulkan_screen.cpp in a build without the Vulkan back end.
#include "steradian/error.h"
#include "window/screen.h"

namespace steradian::view {

std::unique_ptr<Screen> open_vulkan_screen(const ScreenRequest&) {
  throw Error("--backend vulkan", "this program was built without Vulkan", "build it with -DSTERADIAN_VULKAN=ON, as ./dev build does");
}

}  // namespace steradian::view
