// MipMaps: pictures at half, a quarter, ... of their size, so that a pixel that covers many texels shows their mean.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "core/fingerprint.h"
#include "steradian/texture.h"

namespace steradian {

// How a mesh's texture coordinates change from a pixel to the next one, to the right and below: the pixel covers the parallelogram
// that the two span about its own coordinates.
struct TextureFootprint {
  Vec2f right, down;
};

// The mean over the texels that the next larger picture has in its place, by area; in linear light.
class MipMaps {
 public:
  // The smaller pictures of one in a color space.
  struct Pyramid;
  // By the picture's texels, size and color space.
  using Pyramids = std::map<std::tuple<Fingerprint, int, int, ColorSpace>, std::shared_ptr<Pyramid>>;

  // Nothing is computed before it is asked for. The images must outlive this.
  explicit MipMaps(const std::vector<Image>& images);
  // The same, with those that are there already; the last ones become these.
  MipMaps(const std::vector<Image>& images, Pyramids& last);
  ~MipMaps();

  const std::vector<Image>& images() const { return images_; }
  // The picture of a use, then ever smaller ones in the same encoding, the last of one texel.
  const std::vector<const Image*>& levels(const TextureUse& use) const;
  // The picture alone.
  const std::vector<const Image*>& whole(const TextureUse& use) const;
  // The same object has been made of the same texels.
  const std::shared_ptr<Pyramid>& pyramid(const TextureUse& use) const;

 private:
  struct Levels;
  Levels& of(const TextureUse& use) const;
  const std::vector<Image>& images_;
  std::unique_ptr<Levels[]> levels_;  // two for an image: its rgb linear, and sRGB
};

// How many levels an image has.
int level_count(const Image& image);

// Where taps on a texture lie, and how coarse they are, for the mean over a footprint.
struct TextureTaps {
  int count = 1;        // side by side along the footprint's longer axis, about its middle
  Vec2f axis;           // that axis, whole, in the use's coordinates (0 to 1 over the picture)
  float level = 0;      // of their picture, between two whole numbers both
  bool covers = false;  // more than a texel: else one tap on the picture itself, by the use's own filter
};
TextureTaps texture_taps(const TextureUse& use, const Image& image, const TextureFootprint& footprint);

// The mean over a footprint at mesh coordinates t (transform and wrap applied), rgb linear: exact for a texture that is linear there,
// else within what bilinear pictures of half the size show of it. White without a texture.
//
// Taps lie along the longer axis of the ellipse inscribed in the footprint, at most 16, and are as wide as the shorter.
Vec4f sample_texture(const MipMaps& maps, const TextureUse& use, Vec2f t, const TextureFootprint& footprint);

}  // namespace steradian
