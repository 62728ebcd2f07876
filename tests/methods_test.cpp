// The table of methods: its promises hold, `eval` and `render` follow it alike, and the manual agrees.
#include "integrals/methods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "core/words.h"
#include "paths.h"
#include "render/frame/methods.h"
#include "render/surface/camera_rays.h"
#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "steradian/half_vector.h"
#include "support/meshes.h"

namespace steradian::methods_test {
namespace {

using namespace scene;

using methods::Row;

struct NamedLobe {
  const char* words;  // in the form of Row::lobes
  Material lobe;
};

// One lobe of every kind that some method distinguishes.
std::vector<NamedLobe> lobes() {
  Material lambert, phong, between, foreshortened, ggx, anisotropic, bare, blinn, beckmann, charlie, product;
  phong.brdf = between.brdf = Brdf::phong;
  phong.exponent = 20;
  between.exponent = 20.5;
  foreshortened = phong;
  foreshortened.foreshortening = true;
  ggx.brdf = anisotropic.brdf = bare.brdf = Brdf::ggx;
  ggx.f0 = anisotropic.f0 = {0.04, 0.04, 0.04};
  anisotropic.alpha_x = 0.5;
  bare.shadowing = false;
  blinn.brdf = Brdf::blinn_phong;
  blinn.exponent = 20;
  beckmann.brdf = Brdf::beckmann;
  charlie.brdf = Brdf::charlie;
  product.brdf = Brdf::lobe_product;
  product.exponent = 20;
  product.axis_exponent = 5;
  return {{"lambert", lambert},
          {"phong", phong},
          {"phong, any exponent", between},
          {"phong, foreshortened", foreshortened},
          {"ggx", ggx},
          {"ggx, any widths", anisotropic},
          {"ggx without shadowing", bare},
          {"blinn-phong", blinn},
          {"beckmann", beckmann},
          {"charlie", charlie},
          {"lobe-product", product}};
}

PreparedPolygon light() {
  PolygonLight panel;
  panel.vertices = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
  return prepare_polygon(panel);
}

std::string text_of(const std::string& path) {
  std::ifstream in(test::kSourceDir + "/" + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A row of the manual's table.
std::string manual_row(const Row& row) {
  return std::string("| `") + row.name + "` | " + row.lobes + " | " + (row.in_float ? "double, float" : "double") + " | " + row.qualities +
         " | " + (row.density != nullptr ? "yes" : "") + " | " + row.error + " | " + row.time + " |";
}

}  // namespace

TEST(Methods, NamesReadBackAndAreTheirOwn) {
  std::set<std::string> names;
  for (const Row& row : methods::all()) {
    EXPECT_EQ(method_of(row.name), row.method) << row.name;
    EXPECT_STREQ(name_of(row.method), row.name);
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
  }
  EXPECT_EQ(method_of("auto"), Method::automatic);
  EXPECT_FALSE(method_of("magic"));
}

// Compares the words of a row with its condition, lobe by lobe. A row answers every lobe that it serves.
TEST(Methods, RowsServeWhatTheySay) {
  const ShadingPoint at = {{0.3, 0, 0.2}, {0, 1, 0}, normalized(Vec3d{1, 2, 0})};
  for (const Row& row : methods::all()) {
    const std::string words = row.lobes;
    for (const NamedLobe& l : lobes()) {
      const std::string brdf = name_of(l.lobe.brdf);
      const bool phong_word = std::regex_search(words, std::regex("(^|[^-])\\b" + brdf + "\\b"));
      bool expected = words == "all" || phong_word;
      const std::string kind = l.words;
      if (kind == "phong, any exponent" && words.find("integer") != std::string::npos) expected = false;
      if (kind == "phong, foreshortened" && words.find("without foreshortening") != std::string::npos) expected = false;
      if (kind == "ggx, any widths" && words.find("isotropic") != std::string::npos) expected = false;
      if (brdf == "ggx" && words.find("without shadowing") != std::string::npos) expected = kind == "ggx without shadowing";
      if (kind == "ggx without shadowing" && words.find("with shadowing") != std::string::npos) expected = false;
      EXPECT_EQ(row.serves(l.lobe), expected) << row.name << ": " << l.words;
      if (!row.serves(l.lobe)) continue;
      for (const Precision precision : {Precision::double_, Precision::float_}) {
        if (precision == Precision::float_ && !row.in_float) continue;
        RadianceOptions options;
        options.precision = precision;
        const RadianceResult r = row.polygon(light(), at, l.lobe, options);
        EXPECT_GT(r.radiance.x, 0) << row.name << ": " << l.words;
        EXPECT_EQ(r.method, row.method);
        EXPECT_EQ(r.bound.has_value(), row.method == Method::reference);
        EXPECT_EQ(r.standard_error.has_value(), row.method == Method::sampled);
      }
    }
  }
}

// The public call gives the row's result, for a stored or a prepared light.
TEST(Methods, RadianceIsWhatTheRowAnswers) {
  PolygonLight panel;
  panel.vertices = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
  const ShadingPoint at = {{0.3, 0, 0.2}, {0, 1, 0}, normalized(Vec3d{1, 2, 0})};
  for (const NamedLobe& l : lobes()) {
    const RadianceResult r = radiance(panel, at, l.lobe);
    const Row* row = methods::find(Method::automatic, l.lobe, Quality::normal);
    EXPECT_EQ(r.method, row->method) << l.words;
    EXPECT_EQ(r.radiance, row->polygon(light(), at, l.lobe, {}).radiance) << l.words;
    EXPECT_EQ(radiance(light(), at, l.lobe).radiance, r.radiance) << l.words;
    const RadianceResult truth = radiance(panel, at, l.lobe, {.method = Method::reference});
    ASSERT_TRUE(truth.bound.has_value()) << l.words;
    EXPECT_NEAR(r.radiance.x, truth.radiance.x, 0.05) << l.words;  // the error of the roughest method of auto
    EXPECT_EQ(radiance(panel, {at.position, at.normal, -at.view}, l.lobe).radiance, Vec3d{}) << l.words;
  }
  EXPECT_THROW(radiance(panel, at, lobes()[0].lobe, {.method = Method::ltc}), Error);
  EXPECT_THROW(radiance(panel, at, lobes()[0].lobe, {.method = Method::reference, .precision = Precision::float_}), Error);
}

// Normals and views of any length: the answer is that of the unit vectors. The zero vector is no direction.
TEST(Methods, RadianceTakesVectorsOfAnyLength) {
  const ShadingPoint at = {{0.3, 0, 0.2}, {0, 1, 0}, normalized(Vec3d{1, 2, 0})};
  const AreaLight disk = {Ellipse{{0, 2, 0}, {1, 0, 0}, {0, 0, 1}}};
  for (const NamedLobe& l : lobes())
    for (const double scale : {1e-200, 0.3, 7.0, 1e100}) {
      const ShadingPoint scaled = {at.position, at.normal * 3.0, at.view * scale};
      // Normalising again may change the last place; the narrowest of these lobes multiply that by some hundreds.
      const double one = radiance(light(), at, l.lobe).radiance.x, round = radiance(disk, at, l.lobe).radiance.x;
      EXPECT_NEAR(radiance(light(), scaled, l.lobe).radiance.x, one, 1e-12 * one) << l.words << " " << scale;
      EXPECT_NEAR(radiance(disk, scaled, l.lobe).radiance.x, round, 1e-12 * round) << l.words << " " << scale;
    }
  for (const ShadingPoint& none : {ShadingPoint{at.position, {}, at.view}, ShadingPoint{at.position, at.normal, {}}})
    EXPECT_EQ(radiance(light(), none, lobes()[0].lobe).radiance, Vec3d{});
}

// Round lights by the same call: closed forms for Lambert, and values near the ground truth.
TEST(Methods, RadianceOfRoundLightsIsNearTheReference) {
  const ShadingPoint at = {{0.3, 0, 0.2}, {0, 1, 0}, normalized(Vec3d{1, 2, 0})};
  const AreaLight disk = {Ellipse{{0, 2, 0}, {1, 0, 0}, {0, 0, 1}}};
  const AreaLight sphere = {Ellipsoid{{0, 2, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const AreaLight tube = {Capsule{{-1, 2, 0}, {1, 2, 0}, 0.25}};
  for (const AreaLight& round : {disk, sphere, tube})
    for (const Material& lobe : {lobes()[0].lobe, lobes()[1].lobe, lobes()[4].lobe}) {
      const RadianceResult r = radiance(round, at, lobe), truth = radiance(round, at, lobe, {.method = Method::reference});
      EXPECT_GT(truth.radiance.x, 0) << name_of(lobe.brdf);
      EXPECT_EQ(truth.method, Method::reference);
      // Lambert is exact. A polygon of 12 corners is off by at most 0.5 % of the lobe, the methods by 0.2 % (docs/methods.md).
      const double allowed = lobe.brdf == Brdf::lambert ? 0 : 0.01;
      EXPECT_NEAR(r.radiance.x, truth.radiance.x, allowed + *truth.bound) << name_of(lobe.brdf);
    }
}

TEST(Methods, AutomaticIsTheFirstThatServesAndADraftTakesTheTable) {
  const auto chosen = [](const Material& lobe, Quality quality) {
    return std::string(methods::find(Method::automatic, lobe, quality)->name);
  };
  const char* const normal[] = {"exact", "series",      "series",      "series",   "closed-form", "closed-form",
                                "exact", "half-vector", "half-vector", "cubature", "matched-lobe"};
  const char* const draft[] = {"exact", "series",      "series",      "series",   "ltc-compact", "closed-form",
                               "exact", "half-vector", "half-vector", "cubature", "matched-lobe"};
  const std::vector<NamedLobe> all = lobes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(chosen(all[i].lobe, Quality::normal), normal[i]) << all[i].words;
    EXPECT_EQ(chosen(all[i].lobe, Quality::draft), draft[i]) << all[i].words;
  }
}

// A scene whose floor has one lobe beside its diffuse one.
namespace {
Scene scene_with(const Material& lobe) {
  SurfaceMaterial material;
  material.base_color = {0, 0, 0, 1};
  material.specular_override = {lobe};
  Scene scene = scene::floor_scene(material, 8, {0, 3, 4});
  AreaLight panel;
  panel.shape = Polygon{{{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, {}};
  scene.area_lights = {panel};
  return scene;
}
}  // namespace

TEST(Methods, EvalAndRenderServeTheSameLobes) {
  for (const Row& row : methods::all())
    for (const NamedLobe& l : lobes()) {
      if (l.lobe.brdf == Brdf::lambert || l.lobe.brdf == Brdf::charlie) continue;  // the same beside every method
      RenderOptions options;
      options.method = row.name;
      const bool serves = methods::find(row.method, l.lobe, Quality::normal) != nullptr;
      if (serves)
        EXPECT_NO_THROW(choose_method(scene_with(l.lobe), options)) << row.name << ": " << l.words;
      else
        EXPECT_THROW(choose_method(scene_with(l.lobe), options), UsageError) << row.name << ": " << l.words;
    }
}

// Layers of glTF's surfaces run on packs alone: a method that pictures offer for them has a procedure.
TEST(Methods, LayersRunOnPacks) {
  Material layer;
  layer.brdf = Brdf::ggx;
  layer.f0 = {0.04, 0.04, 0.04};
  for (const Row& row : methods::all()) {
    if (row.serves(layer) && row.in_float) {
      EXPECT_NE(row.procedure, methods::Procedure::none) << row.name;
    }
  }
}

// Every pixel equals the result of the library's own call: half vectors for GGX, and GGX without shadowing exactly.
TEST(Methods, RenderAnswersAsTheLibraryDoes) {
  const auto compare = [](const char* method, const Material& lobe, const auto& expected_at) {
    const Scene scene = scene_with(lobe);
    RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.method = method;
    const Picture picture = render(scene, options);
    const CameraRays rays(scene.cameras[0], options.width, options.height);
    for (int y = 24; y < 48; y += 6)
      for (int x = 5; x < 64; x += 9) {
        const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const Vec3d eye = scene.cameras[0].position, p = eye + d * (-eye.y / d.y);
        const double expected = expected_at(ShadingPoint{p, {0, 1, 0}, normalized(eye - p)});
        // Hit points are exact to 2e-6 of 10 m, under lobes whose slope is at most 1/alpha = 5 per radian. Rounding of floats adds to that.
        EXPECT_NEAR(picture.at(x, y).x, expected, 2e-4 * expected + 1e-5) << method << " " << x << " " << y;
      }
  };
  Material ggx;
  ggx.brdf = Brdf::ggx;
  ggx.alpha_x = ggx.alpha_y = 0.2;
  compare("half-vector", ggx, [&](const ShadingPoint& at) { return half_vector_radiance(light(), at, ggx).x; });
  ggx.shadowing = false;
  compare("exact", ggx, [&](const ShadingPoint& at) { return exact_ggx_radiance(light(), at, ggx).x; });
}

// The table of docs/methods.md has exactly these rows.
TEST(Methods, TheManualHasTheTable) {
  const std::string manual = text_of("docs/methods.md");
  const std::string head = "| method | lobes | precision | qualities | derivatives | error | time |\n|---|---|---|---|---|---|---|\n";
  const std::size_t begin = manual.find(head);
  ASSERT_NE(begin, std::string::npos) << "docs/methods.md lacks the head of its table of methods:\n" << head;
  std::string expected = head;
  for (const Row& row : methods::all()) expected += manual_row(row) + "\n";
  EXPECT_EQ(manual.substr(begin, manual.find("\n\n", begin) + 1 - begin), expected);
}

// The add-on for Blender offers words of the tables.
TEST(Methods, BlenderOffersKnownWords) {
  const std::string engine = text_of("blender/steradian/engine.py");
  const std::regex setting(R"re((\w+): bpy\.props\.EnumProperty\(([^\]]*)\])re"), item(R"re(\("([a-z-]+)", ")re");
  std::set<std::string> found;
  for (std::sregex_iterator s(engine.begin(), engine.end(), setting), end; s != end; ++s) {
    const std::string option = (*s)[1], items = (*s)[2];
    for (std::sregex_iterator i(items.begin(), items.end(), item); i != end; ++i) {
      const std::string word = (*i)[1];
      EXPECT_TRUE(option == "method"       ? method_of(word).has_value()
                  : option == "quality"    ? words::find<Quality>(word).has_value()
                  : option == "shadows"    ? words::find<Shadows>(word).has_value()
                  : option == "terminator" ? words::find<Terminator>(word).has_value()
                  : option == "environment"
                      ? word == "white" || word == "sky" || word == "world" || word == "none"  // the last two: Blender's
                      : word == "all" || words::find<IndirectMode>(word).has_value())          // all: of --bounces
          << option << " " << word;
      found.insert(option);
    }
  }
  EXPECT_EQ(found, (std::set<std::string>{"method", "quality", "shadows", "indirect", "terminator", "environment"}));
}

}  // namespace steradian::methods_test
