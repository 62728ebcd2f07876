// Textures of surfaces: single texels, and MipMaps, from which a pixel that covers many texels takes their mean.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "core/fingerprint.h"
#include "steradian/texture.h"

namespace steradian {

// Single texels of an image, and the blend of four.

// Texel (x, y), rgb linear.
Vec4f texel_of(const Image& image, int x, int y, ColorSpace space);

// Blend of four texels at finite coordinates (0 to 1 over the picture), wrapped as the use says, whatever its filter; rgb linear.
Vec4f bilinear(const Image& image, const TextureUse& use, Vec2f uv);

// MipMaps: pictures at half, a quarter, ... of their size, so that a pixel that covers many texels shows their mean.

// Change of a mesh's texture coordinates from a pixel to its right neighbour and to the one below. The pixel covers the parallelogram that
// the two vectors span about its own coordinates.
struct TextureFootprint {
  Vec2f right, down;
};

// Smaller pictures: each texel is the area mean of the texels that it replaces in the next larger picture, in linear light.
class MipMaps {
 public:
  // The smaller pictures of one picture in one color space.
  struct Pyramid;
  // Pyramids by the picture's texels, size and color space.
  using Pyramids = std::map<std::tuple<Fingerprint, int, int, ColorSpace>, std::shared_ptr<Pyramid>>;

  // Nothing is computed before it is requested. The images must outlive this object.
  explicit MipMaps(const std::vector<Image>& images);
  // The same, but reuses the pyramids in `last` and then stores this object's pyramids there.
  MipMaps(const std::vector<Image>& images, Pyramids& last);
  ~MipMaps();

  const std::vector<Image>& images() const { return images_; }
  // The picture of a use, then ever smaller ones in the same encoding; the last has one texel.
  const std::vector<const Image*>& levels(const TextureUse& use) const;
  // Only the full-size picture.
  const std::vector<const Image*>& whole(const TextureUse& use) const;
  // Images with the same texels share one object.
  const std::shared_ptr<Pyramid>& pyramid(const TextureUse& use) const;

 private:
  struct Levels;
  Levels& of(const TextureUse& use) const;
  const std::vector<Image>& images_;
  std::unique_ptr<Levels[]> levels_;  // two for an image: its rgb linear, and sRGB
};

// Number of levels of an image.
int level_count(const Image& image);

// Mean over a footprint at mesh coordinates t (transform and wrap applied), rgb linear. It is exact for a texture that is linear there,
// else within what bilinear pictures of half the size show of it. White without a texture.
// The taps are those of kernels/surface/texture.glsl.
Vec4f sample_texture(const MipMaps& maps, const TextureUse& use, Vec2f t, const TextureFootprint& footprint);

}  // namespace steradian
