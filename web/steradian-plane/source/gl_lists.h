// The data that the shaders of a picture by WebGL2 read: the words of the Vulkan back end's shaders, as the pixels of textures.
#pragma once

#include <cstdint>
#include <vector>

#include "steradian/picture.h"
#include "steradian/plane.h"

namespace steradian::plane {

struct GlLists {
  // shaders/plane/plane_layout.glsl: the header, disks, tiles, jobs, and what jobs are about. Of a job the first word is where its tile's
  // record stands: column and row of its first pixel, then 256 bits, 1 where something fills a pixel.
  std::vector<std::uint32_t> lists;
  std::vector<std::uint32_t> pairs;
  std::vector<float> vertices;  // four numbers each
  std::size_t mask_words = 0, disks = 0;
  struct Jobs {
    std::size_t first = 0, count = 0;  // in jobs from the first word on
  };
  static constexpr std::size_t kKinds = 4;
  Jobs jobs[kKinds];           // listed disks, disks, cuts, arcs
  Picture base;                // what the host alone knows: fills, and light of what the shaders do not serve
  bool all_on_device = false;  // no light is listed tile by tile on this machine
};

// room: words that a texture holds.
void make_gl_lists(GlLists& to, const PlaneWorld& world, const PlaneFrameOptions& options, std::size_t room);

}  // namespace steradian::plane
