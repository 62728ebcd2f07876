// Single texels of an image, and the blend of four.
#pragma once

#include "steradian/texture.h"

namespace steradian {

// Texel (x, y), rgb linear.
Vec4f texel_of(const Image& image, int x, int y, ColorSpace space);

// Blend of four texels at finite coordinates (0 to 1 over the picture), wrapped as the use says, whatever its filter; rgb linear.
Vec4f bilinear(const Image& image, const TextureUse& use, Vec2f uv);

}  // namespace steradian
