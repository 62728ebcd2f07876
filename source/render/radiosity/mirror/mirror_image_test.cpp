// The image of an edge between bright and dark in a rough mirror, against quadrature of its lobe.
#include "render/radiosity/mirror/mirror_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "steradian/reference.h"

namespace steradian::mirror_image_test {
namespace {

constexpr int kSide = 320;
constexpr float kPixel = 0.003f;  // at distance 1 before the camera
const Vec3f kEye = {0.1f, 0.9f, 1.3f};
constexpr float kCeiling = 1.2f;  // its height; bright where x < 0
constexpr float kBright = 1, kDark = 0.2f;

Vec3f ray_of(int x, int y) {
  const Vec3f ahead = normalized(Vec3f{0, -0.7f, -1}), right = {1, 0, 0}, down = cross(ahead, right);
  return normalized(ahead + right * ((static_cast<float>(x) + 0.5f - kSide / 2) * kPixel) +
                    down * ((static_cast<float>(y) + 0.5f - kSide / 2) * kPixel));
}

struct Place {
  Vec3f position, view, direction;
  float reach;
};
Place place_of(int x, int y) {
  const Vec3f ray = ray_of(x, y);
  const Vec3f at = kEye + ray * (kEye.y / -ray.y);
  const Vec3f direction = {ray.x, -ray.y, ray.z};
  return {at, -ray, direction, kCeiling / direction.y};
}

// The picture of the mirror y = 0, which reflects all light.
Picture picture_of(float alpha_x, float alpha_y) {
  static const SurfaceMaterial material;
  radiosity::MirrorImage image(kSide, kSide, kPixel, 1000);
  Picture picture(kSide, kSide);
  for (const char* layer : {"indirect", "bounce_error"}) picture.layers[layer].resize(picture.pixels.size());
  const auto tile = std::make_unique<SurfaceTile>();
  const auto mirrors = std::make_unique<radiosity::Mirrors>();
  const auto light = std::make_unique<TileVector>();
  TilePlane reach;
  radiosity::StandsFor stands_for;
  stands_for.fill(1);
  for (int top = 0; top < kSide; top += kTileSide)
    for (int left = 0; left < kSide; left += kTileSide) {
      for (int y = 0; y < kTileSide; ++y)
        for (int x = 0; x < kTileSide; ++x) {
          const std::size_t slot = tile_slot(x, y);
          const Place p = place_of(left + x, top + y);
          tile->material[slot] = &material;
          put(tile->tangent, slot, {1, 0, 0});
          put(tile->view, slot, p.view);
          mirrors->ways.bent[slot] = 1;
          put(mirrors->ways.shares, slot, {1, 1, 1});
          put(mirrors->ways.origin, slot, p.position);
          put(mirrors->ways.direction, slot, p.direction);
          mirrors->ways.length[slot] = length(p.position - kEye);
          put(mirrors->normal, slot, {0, 1, 0});
          mirrors->alpha_x[slot] = alpha_x;
          mirrors->alpha_y[slot] = alpha_y;
          reach[slot] = p.reach;
          const float value = (p.position + p.direction * p.reach).x < 0 ? kBright : kDark;
          put(*light, slot, {value, value, value});
          picture.at(left + x, top + y) = {value, value, value};
        }
      image.take({*tile, *mirrors, stands_for, reach, *light, nullptr, nullptr, 1}, {left, top, kTileSide, kTileSide});
    }
  image.blur(picture, nullptr);
  return picture;
}

// Light that the lobe sees of a rectangle of the ceiling with radiance 1.
double seen(const Place& p, float alpha_x, float alpha_y, double from, double to) {
  PolygonLight strip;
  strip.vertices = {{from, double{kCeiling}, -60}, {to, double{kCeiling}, -60}, {to, double{kCeiling}, 60}, {from, double{kCeiling}, 60}};
  strip.radiance = {1, 1, 1};
  strip.two_sided = true;
  Material material;
  material.brdf = Brdf::ggx;
  material.alpha_x = double{alpha_x};
  material.alpha_y = double{alpha_y};
  material.tangent = {1, 0, 0};
  material.f0 = material.f90 = {1, 1, 1};
  ReferenceOptions options;
  options.relative_error = options.absolute_error = 1e-3;
  return reference_radiance(prepare_polygon(strip), {static_cast<Vec3d>(p.position), {0, 1, 0}, static_cast<Vec3d>(p.view)}, material,
                            options)
      .radiance.x;
}

}  // namespace

// The edge lies between two pixels, so up to half a pixel of the bright side may count as dark. The lobe's density across an edge is at
// most 1 / (4 alpha). Blocks of pixels add up to 1 % of the contrast.
TEST(MirrorImage, EdgesAreBlurredByTheLobe) {
  constexpr double kContrast = double{kBright} - double{kDark};
  for (const auto& [alpha_x, alpha_y] : {std::pair{0.01f, 0.01f}, {0.03f, 0.03f}, {0.07f, 0.07f}, {0.01f, 0.06f}}) {
    const Picture picture = picture_of(alpha_x, alpha_y);
    double worst = 0, sharp = 0, largest_error = 0;
    for (int y = 90; y < 230; y += 45)
      for (int x = 90; x < 230; x += 8) {
        const Place p = place_of(x, y);
        const double bright = seen(p, alpha_x, alpha_y, -60, 0), all = bright + seen(p, alpha_x, alpha_y, 0, 60);
        const double truth = (bright * double{kBright} + (all - bright) * double{kDark}) / all;
        const double off = std::fabs(double{picture.at(x, y).x} - truth);
        const double error = double{picture.layers.at("bounce_error")[static_cast<std::size_t>(y * kSide + x)].x};
        worst = std::max(worst, off);
        largest_error = std::max(largest_error, error);
        const double before = (p.position + p.direction * p.reach).x < 0 ? double{kBright} : double{kDark};
        sharp = std::max(sharp, std::fabs(before - truth));
        const double pixel = double{kPixel * (length(p.position - kEye) + p.reach) / p.reach};
        EXPECT_LT(off, kContrast * (pixel / 2 / (4 * double{alpha_x}) + 0.01) + error) << alpha_x << ' ' << alpha_y << ' ' << x << ' ' << y;
      }
    std::printf("alpha %.3f, %.3f: off by at most %.4f, sharp %.3f, largest error %.3f\n", double{alpha_x}, double{alpha_y}, worst, sharp,
                largest_error);
  }
}

}  // namespace steradian::mirror_image_test
