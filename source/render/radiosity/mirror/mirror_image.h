// MirrorImage: what the mirrors of a picture show, blurred by their lobes. docs/bounces.md.
//
// Mirror pixels have traced one ray each, or one for 2 x 2 pixels, and what they met is lit. For the lobe of a pixel, the places that its
// neighbours have met are samples of what it sees: each stands for the solid angle of its pixel's footprint there. So a pixel's image is
// the mean of theirs, weighted by its lobe. Blocks of 2^k x 2^k pixels count as one place where the lobe hardly changes over them.
#pragma once

#include <cstdint>
#include <vector>

#include "render/radiosity/mirror/mirrors.h"
#include "render/radiosity/mirror/patches_in_lobes.h"
#include "steradian/picture.h"

namespace steradian::radiosity {

class MirrorImage {
 public:
  // pixel: size of a pixel at distance 1 before the camera. far: the distance of what mirrored rays do not meet.
  MirrorImage(int width, int height, float pixel, float far);

  float pixel() const { return pixel_; }

  // The mirrors of a tile.
  //
  //   stands_for  number of pixels that the ray of each stands for; 0: it was not traced
  //   reach   way of each mirrored ray to what it met; infinity where it met nothing
  //   light   that the mirrors send to the viewer, before the blur
  //   patches  the same of the patches alone; null: the blur uses no patches
  //   shares  fraction of it that arrives; null for all
  //   weight  of these samples of the pixels
  struct Taken {
    const SurfaceTile& tile;
    const Mirrors& mirrors;
    const StandsFor& stands_for;
    const TilePlane& reach;
    const TileVector& light;
    const TileVector* patches;
    const TileVector* shares;
    float weight;
  };
  // Takes what a tile's mirrors show. Threads may take different tiles at the same time. The first sample of a pixel decides its place.
  void take(const Taken& taken, TileArea area);

  // Replaces the mirrors' sharp light by the blurred light in the pixels and in the layer "indirect". Where few rays fall into a lobe, its
  // own directions correct their mean by what they see of the patches. Adds to "bounce_error" the error of that, and what lobes see beyond
  // the neighbours. in_lobes: null for no patches.
  void blur(Picture& picture, const PatchesInLobes* in_lobes) const;

 private:
  struct Pixel {
    int x = 0, y = 0;
    Vec3f position, normal, geometric_normal, tangent, view, direction, place;  // place: that the ray met
    float alpha_x = 0, alpha_y = 0, length = 0;                                 // length: from the viewer to the place
    Vec3f share, traced_share, light, patches;                                  // traced_share: of the samples that were traced
    int stands_for = 1;
    const SurfaceMaterial* material = nullptr;
  };
  struct Tile {
    std::vector<Pixel> pixels;
    std::vector<std::uint16_t> of_slot;  // number of the slot's pixel, from 1 on; 0: none
  };
  struct Cells;
  // Pixels by their place in the picture; null where there is no mirror.
  using Places = std::vector<const Pixel*>;
  template <class Of>
  Vec3f step(const Pixel& pixel, const Places& at, int dx, int dy, Of of) const;
  float footprint(const Pixel& pixel, const Places& at) const;
  MirrorLobe lobe_of(const Pixel& pixel, const Places& at) const;

  const int width_, height_, across_;
  const float pixel_, far_;
  std::vector<Tile> tiles_;
};

}  // namespace steradian::radiosity
