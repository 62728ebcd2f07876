// Questions of `solve` with random mistakes: each gives an answer or an Error, and never a crash.
#include <gtest/gtest.h>

#include "core/random.h"
#include "solve/job.h"
#include "steradian/error.h"
#include "support/boxes.h"

namespace steradian::solve_question_test {
namespace {

constexpr std::string_view kQuestion =
    R"({"fit": [{"light": "lamp*", "position": {"min": [-3,2,-3], "max": [3,2.8,3]}, "rotation": {"max_degrees": 30}, "size": {"min": 0.1, "max": 1.2},
 "power": {"min": 0, "max": 8000}, "keep": 0.1}, {"material": "wall", "albedo": {"max": 0.9}, "roughness": true}], "tie": [{"lights": ["lamp 1", "lamp 2"], "mirror": {"point": [0,0,0], "normal": [1,0,0]}}],
 "targets": [{"zone": {"center": [1,0.75,0], "x": [0.8,0,0], "y": [0,0,0.4], "grid": [8,4]}, "lux": {"min": 450, "max": 550}},
 {"mesh": "floor", "grid": 0.25, "lux": {"max": 100}, "weight": 0.3}, {"points": [[0,0.75,0]], "normal": [0,1,0], "lux": {"mean": 500, "uniformity": 0.6}}],
 "least": "power"})";

}  // namespace

TEST(SolveQuestion, MistakesGiveErrors) {
  Scene scene = scene::closed_box(0.5f, true);
  for (AreaLight& light : scene.area_lights) light.name = "lamp", light.power = 4;
  for (Mesh& mesh : scene.meshes) mesh.name = "floor";
  for (SurfaceMaterial& material : scene.materials) material.name = "wall";
  reference::Random random(3);
  int errors = 0, read = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text(kQuestion);
    const int mistakes = round == 0 ? 0 : 1 + static_cast<int>(random.uniform(0, 3));
    for (int i = 0; i < mistakes; ++i) {
      const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(text.size())));
      const double kind = random.uniform(0, 3);
      if (kind < 1)
        text.erase(at, 1 + static_cast<std::size_t>(random.uniform(0, 6)));
      else if (kind < 2)
        text[at] = static_cast<char>(random.uniform(32, 127));
      else
        text.insert(at, text.substr(static_cast<std::size_t>(random.uniform(0, static_cast<double>(text.size()))), 5));
    }
    try {
      app::SolveJobReader reader(scene, {}, {});
      reader.add_text(text, "question", "");
      const app::SolveJob job = reader.finish();
      EXPECT_FALSE(job.fits.empty());
      ++read;
    } catch (const Error& e) {
      EXPECT_FALSE(std::string(e.what()).empty());
      ++errors;
    }
  }
  std::printf("4000 questions: %d read, %d errors\n", read, errors);
  EXPECT_GT(errors, 1000);
  EXPECT_GT(read, 20);
}

TEST(SolveQuestion, KnowsItsWords) {
  Scene scene = scene::closed_box(0.5f, true);
  for (AreaLight& light : scene.area_lights) light.name = "lamp", light.power = 4;
  for (const char* part : {"all", "diffuse", "specular", "shiny"}) {
    app::SolveJobReader reader(scene, {}, {});
    reader.add_text(
        R"({"fit": [{"light": "lamp*", "power": true}], "targets": [{"picture": "missing.exr", "part": ")" + std::string(part) + R"("}]})",
        "question", "");
    try {
      reader.finish();
      FAIL() << "the picture is missing";
    } catch (const Error& e) {
      const bool refused = std::string_view(e.what()).find("'shiny' is not known") != std::string_view::npos;
      EXPECT_EQ(refused, std::string_view(part) == "shiny") << e.what();
    }
  }
}

}  // namespace steradian::solve_question_test
