// Picture: scene-linear pixels with named extra layers and metadata; EXR and PNG.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Vec3f> pixels;                         // radiance, linear RGB, unclamped; row 0 on top
  std::map<std::string, std::vector<Vec3f>> layers;  // e.g. "variance": stored as variance.R, .G, .B
  // The layer "alpha" is coverage, by which the pixels are already multiplied. It is stored as A, in .png as its alpha channel.
  std::map<std::string, std::string> metadata;  // settings; EXR attributes, PNG text
  std::vector<std::string> unread;              // channels of the file other than R, G, B, Y and A

  Picture() = default;
  Picture(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Vec3f& at(int x, int y) { return pixels[index(x, y)]; }
  const Vec3f& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

// The tone curve of PNG output: exposure in stops, Khronos PBR Neutral, sRGB. In and out in [0, 1] per channel.
// Source: Khronos, "PBR Neutral Tone Mapper", 2024: base colours up to 0.8 - 0.04 pass unchanged in hue and value.
Vec3f tone_map(Vec3f radiance, float exposure_stops);

// The exposure in stops that brings the geometric mean of a picture's luminance to 0.18, middle grey. Values below a millionth of the
// largest luminance, above all a black background, are ignored. If they are more than half of the picture, at most a twentieth of the
// others becomes brighter than 1. 0 for a black picture; within +-30.
// Source: Reinhard et al., "Photographic tone reproduction for digital images", 2002, equations 1 and 2.
float auto_exposure(const Picture& picture);

// sRGB transfer functions, IEC 61966-2-1.
float srgb_encode(float linear);
float srgb_decode(float encoded);

// Writes `.exr` (linear, 32-bit float, ZIP) or `.png` (tone mapped, 8 bits) by the name's ending. The file is written beside its target and
// then renamed. Throws Error for any other ending and when the file cannot be written.
void write_picture(const Picture& picture, const std::string& path, float exposure_stops = 0.0f);

// Reads `.exr` (with layers and text attributes), `.hdr` (Radiance) or `.png`/`.jpg` (sRGB made linear).
Picture read_picture(const std::string& path);

}  // namespace steradian
