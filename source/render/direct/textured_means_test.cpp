#include "render/direct/textured_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "integrals/textured/textured_light.h"
#include "render/tile/tile.h"
#include "support/random_configurations.h"

namespace steradian::textured_means_test {
namespace {

using reference::Random;

// A square of side 2 with a texture of spots in three colours on grey.
struct Window {
  std::vector<Image> images;
  AreaLight light;
  std::unique_ptr<TexturedLight> textured;

  explicit Window(Random& random) {
    Image image{"", 32, 32, {}};
    for (int i = 0; i < 32 * 32; ++i)
      for (int c = 0; c < 4; ++c) image.rgba.push_back(static_cast<std::uint8_t>(c == 3 || random.uniform(0, 1) < 0.1 ? 255 : 40));
    images = {image};
    light.shape = Polygon{{{-1, 0.2, -1}, {1, 0.2, -1}, {1, 2.2, -1}, {-1, 2.2, -1}}, {}};
    LightTexture t;
    t.use.image = 0;
    t.use.wrap_u = t.use.wrap_v = Wrap::clamp_to_edge;
    t.origin = {-1, 2.2, -1};
    t.du = {0.5, 0, 0};
    t.dv = {0, -0.5, 0};
    t.factor = {3, 3, 3};
    light.texture = t;
    light.radiance = {1, 1, 1};
    textured = std::make_unique<TexturedLight>(
        light, prepare_polygon(PolygonLight{std::get<Polygon>(light.shape).vertices, {}, light.radiance, false}), images);
  }
};

Vec3d double_of(const TileVector& v, std::size_t i) { return static_cast<Vec3d>(get(v, i)); }

}  // namespace

// Every point against its own double, for every instruction set. Each stops splitting cells when their bounds sum to kTolerance of the
// mean. A pack splits the cells that any of its points needs split. On such a rough texture, the two therefore differ by the error of
// either. That is 2.5 % at most (docs/theory/ltc.md, "Textured lights"), and a quarter of it in the mean square.
TEST(TexturedMeans, PacksFollowTheMeanOfEveryPoint) {
  Random random(21);
  const Window window(random);
  const LtcPackTables tables = ltc_pack_tables(Method::ltc_compact);
  auto tile = std::make_unique<SurfaceTile>(), out = std::make_unique<SurfaceTile>();
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    // Neighbours, as in a tile, with an arbitrary point now and then.
    const bool any = i % 64 < 16;
    const double x = any ? random.uniform(-3, 3) : 0.02 * static_cast<double>(i % 32),
                 z = any ? random.uniform(-0.9, 4) : 0.02 * static_cast<double>(i / 32);
    const Vec3d normal = normalized(Vec3d{random.uniform(-0.1, 0.1), 1, random.uniform(-0.1, 0.1)});
    put(tile->position, i, static_cast<Vec3f>(Vec3d{x, 0, z}));
    put(tile->normal, i, static_cast<Vec3f>(normal));
    put(tile->view, i, static_cast<Vec3f>(normalized(Vec3d{random.uniform(-0.5, 0.5), random.uniform(0.3, 1), random.uniform(0.2, 2)})));
    tile->alpha_x[i] = static_cast<float>(std::exp(random.uniform(-3.5, 0)));
    tile->alpha_y[i] = i % 3 == 0 ? tile->alpha_x[i] : static_cast<float>(std::exp(random.uniform(-3.5, 0)));
    tile->sheen_alpha[i] = i % 7 == 0 ? 0.0f : 1.0f;  // 1 if the mean is wanted
  }
  const Points points = {kTilePixels, arrays_of(tile->position), arrays_of(tile->normal), arrays_of(tile->view),
                         {},          tile->alpha_x.data(),      tile->alpha_y.data()};
  const TexturedMeans means = {out->radiance.x.data(), out->radiance.y.data(), out->radiance.z.data(), out->coat.data()};
  for (const Simd simd : available_simd())
    for (const bool ggx : {false, true}) {
      const TexturedMeansTable& table = textured_means_table_for(simd);
      if (ggx)
        table.ggx(*window.textured, points, tables, tile->sheen_alpha.data(), means);
      else
        table.diffuse(*window.textured, points, tile->sheen_alpha.data(), means);
      double square = 0, worst = 0;
      int found = 0;
      for (std::size_t i = 0; i < kTilePixels; ++i) {
        if (tile->sheen_alpha[i] == 0 || out->coat[i] == 0) {
          EXPECT_TRUE(tile->sheen_alpha[i] > 0 || out->coat[i] == 0);
          continue;
        }
        const ShadingPoint at{double_of(tile->position, i), normalized(double_of(tile->normal, i)), normalized(double_of(tile->view, i))};
        const double width = std::sqrt(static_cast<double>(tile->alpha_x[i]) * static_cast<double>(tile->alpha_y[i]));
        const auto truth = static_cast<Vec3d>(ggx ? window.textured->seen_by_ggx(at, width) : window.textured->seen_by_diffuse(at));
        const Vec3d off = double_of(out->radiance, i) - truth;
        const double error = length(off) / length(truth);
        worst = std::max(worst, error);
        square += error * error;
        ++found;
      }
      EXPECT_GT(found, ggx ? 400 : 800);
      EXPECT_LT(worst, static_cast<double>(kTextureTolerance)) << name_of(simd) << " " << ggx;
      EXPECT_LT(std::sqrt(square / found), 0.025 / 4) << name_of(simd) << " " << ggx;
    }
}

}  // namespace steradian::textured_means_test
