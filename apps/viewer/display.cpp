#include "display.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "steradian/area_light.h"  // luminance

namespace steradian::view {
namespace {

template <class ColorAt>  // of a pixel's index, in [0, 1]
Display filled(int width, int height, ColorAt color_at) {
  Display display{width, height, {}};
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  display.rgba.resize(4 * w * h);
  tbb::parallel_for(std::size_t{0}, h, [&](std::size_t y) {
    for (std::size_t i = y * w; i < (y + 1) * w; ++i) {
      const Vec3f c = color_at(i);
      const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(x * 255.0f)); };
      std::uint8_t* p = display.rgba.data() + 4 * i;
      p[0] = byte(c.x);
      p[1] = byte(c.y);
      p[2] = byte(c.z);
      p[3] = 255;
    }
  });
  return display;
}

}  // namespace

Display shown(const Picture& picture, float exposure_stops) {
  return filled(picture.width, picture.height, [&](std::size_t i) { return tone_map(picture.pixels[i], exposure_stops); });
}

Vec3f heat(double share) {
  const auto ramp = [&](double from) { return static_cast<float>(std::clamp(3 * share - from, 0.0, 1.0)); };
  return {ramp(0), ramp(1), ramp(2)};
}

Display error_map(const Picture& a, const Picture& b, double most) {
  double mean = 0;
  for (const Vec3f& c : b.pixels) mean += luminance(static_cast<Vec3d>(c));
  mean /= std::max<double>(static_cast<double>(b.pixels.size()), 1);
  const double scale = mean * most > 0 ? 1 / (mean * most) : 0;
  return filled(a.width, a.height, [&](std::size_t i) {
    const Vec3f d = a.pixels[i] - b.pixels[i];
    return heat(static_cast<double>(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)})) * scale);
  });
}

Display split(const Display& a, const Display& b, int column) {
  Display result = b;
  const auto width = static_cast<std::size_t>(a.width), left = static_cast<std::size_t>(std::clamp(column, 0, a.width));
  for (std::size_t y = 0; y < static_cast<std::size_t>(a.height); ++y)
    std::copy_n(a.rgba.begin() + static_cast<std::ptrdiff_t>(4 * y * width), 4 * left,
                result.rgba.begin() + static_cast<std::ptrdiff_t>(4 * y * width));
  return result;
}

}  // namespace steradian::view
