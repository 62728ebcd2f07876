#include "display.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "image/tone.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::view {
namespace {

template <class FillRow>  // (first pixel, count, their bytes, four per pixel)
Display filled(int width, int height, FillRow fill_row) {
  Display display{width, height, {}};
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  display.rgba.resize(4 * w * h);
  tbb::parallel_for(std::size_t{0}, h, [&](std::size_t y) { fill_row(y * w, w, display.rgba.data() + 4 * y * w); });
  return display;
}

}  // namespace

Display shown(const Picture& picture, float exposure_stops, ToneCurve curve) {
  const float scale = std::exp2(exposure_stops);
  return filled(picture.width, picture.height, [&](std::size_t first, std::size_t count, std::uint8_t* row) {
    image::tone_row(picture.pixels.data() + first, count, scale, row, curve);
  });
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
  return filled(a.width, a.height, [&](std::size_t first, std::size_t count, std::uint8_t* row) {
    for (std::size_t i = first; i < first + count; ++i, row += 4) {
      const Vec3f d = a.pixels[i] - b.pixels[i];
      const Vec3f c = heat(static_cast<double>(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)})) * scale);
      const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(x * 255.0f)); };
      row[0] = byte(c.x);
      row[1] = byte(c.y);
      row[2] = byte(c.z);
      row[3] = 255;
    }
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
