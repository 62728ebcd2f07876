// Image and TextureUse: decoded pictures, and their look-up by a material.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

struct Vec2f {
  float x = 0, y = 0;

  bool operator==(const Vec2f&) const = default;
};
struct Vec4f {
  float x = 0, y = 0, z = 0, w = 0;

  bool operator==(const Vec4f&) const = default;
};

// RGBA, 8 bits a channel, first row at the top (texture coordinate v = 0). The use says if rgb is sRGB-coded.
struct Image {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // 4 width height

  bool operator==(const Image&) const = default;
};

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter { nearest, linear };
enum class ColorSpace { linear, srgb };  // encoding of rgb; alpha is always linear

struct TextureUse {
  int image = -1;    // into Scene::images; -1: no texture
  int texcoord = 0;  // set 0 or 1 of the mesh
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  Filter filter = Filter::linear;
  ColorSpace color_space = ColorSpace::linear;
  float scale = 1;  // normal textures: factor of x and y; occlusion: strength
  // KHR_texture_transform: u' = uv[0] u + uv[1] v + uv[2],  v' = uv[3] u + uv[4] v + uv[5].
  float uv[6] = {1, 0, 0, 0, 1, 0};

  bool present() const { return image >= 0; }
  Vec2f transformed(Vec2f t) const { return {uv[0] * t.x + uv[1] * t.y + uv[2], uv[3] * t.x + uv[4] * t.y + uv[5]}; }

  bool operator==(const TextureUse&) const = default;
};

// The texel value at mesh coordinates t (transform, wrap and filter applied), rgb linear. White without a texture.
Vec4f sample_texture(const std::vector<Image>& images, const TextureUse& use, Vec2f t);

// The sRGB transfer function (IEC 61966-2-1) of an 8-bit code, to linear.
float linear_from_srgb8(std::uint8_t code);

}  // namespace steradian
