// `steradian solve` as a process: pictures, illuminances, the written file, and errors.
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "steradian/vector.h"
#include "support/gltf_test_file.h"

namespace steradian::solve_program_test {
namespace {

using nlohmann::json;

// A floor of 4 x 4 m, a wall behind it, and panels above. All panels share one light of the file.
struct RoomFile {
  scene::GltfTestFile file;

  explicit RoomFile(const std::vector<Vec3d>& panels, double intensity = 5, double size = 0.8) {
    add({{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}});
    add({{-2, 0, -2}, {2, 0, -2}, {2, 2.5f, -2}, {-2, 2.5f, -2}});
    file.json["extensionsUsed"] = {"EXT_lights_area", "KHR_materials_specular"};
    file.json["materials"] = {{{"name", "grey"},
                               {"pbrMetallicRoughness", {{"baseColorFactor", {0.6, 0.6, 0.6, 1}}, {"metallicFactor", 0}}},
                               {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}};
    file.json["extensions"]["EXT_lights_area"]["lights"] = {
        {{"type", "rect"}, {"name", "panel"}, {"size", size}, {"color", {1, 0.9, 0.8}}, {"intensity", intensity}}};
    for (const Vec3d& p : panels)
      list.push_back(file.append("nodes", {{"name", "place"},
                                           {"translation", {p.x, p.y, p.z}},
                                           {"rotation", {-0.70710678, 0, 0, 0.70710678}},
                                           {"extensions", {{"EXT_lights_area", {{"light", 0}}}}}}));
    file.json["cameras"] = {{{"name", "main"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.01}}}}};
    list.push_back(file.append("nodes", {{"camera", 0}, {"translation", {0, 1.2, 4}}}));
    file.json["scenes"] = {{{"nodes", list}}};
  }
  std::string write(const fs::path& path) {
    std::ofstream(path, std::ios::binary) << file.text();
    return path;
  }

 private:
  void add(const std::vector<Vec3f>& corners) {
    std::vector<float> numbers;
    for (const Vec3f& v : corners) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    const int mesh = file.append("meshes", {{"name", "part"},
                                            {"primitives",
                                             {{{"attributes", {{"POSITION", file.add_floats(numbers, "VEC3")}}},
                                               {"indices", file.add_indices({0, 1, 2, 0, 2, 3})},
                                               {"material", 0}}}}});
    list.push_back(file.append("nodes", {{"mesh", mesh}}));
  }
  json list = json::array();
};

const char* const kDesk = R"({"fit": [{"light": "panel*", "power": true}],
  "targets": [{"name": "desk", "zone": {"center": [0.3, 0.7, 0], "x": [0.5, 0, 0], "y": [0, 0, 0.3], "grid": [6, 4]}, "lux": {"min": 450, "max": 550}}]})";

}  // namespace

TEST_F(Program, SolveFindsTheColorOfAMaterial) {
  RoomFile truth({{0.5, 2.1, -0.4}});
  truth.file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.2, 0.5, 0.3, 1};
  const std::string scene = RoomFile({{0.5, 2.1, -0.4}}).write(folder / "scene.gltf");
  const std::string target = folder / "target.exr", solved = folder / "solved.gltf";
  ASSERT_EQ(run({"render", truth.write(folder / "truth.gltf"), "-o", target, "--size", "64x36"}).status, 0);
  const Outcome made = run({"solve", scene, "--target", target, "--fit", "material:grey", "-o", solved, "--report", folder / "report"});
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  EXPECT_NE(made.out.find("grey: albedo green"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("material 'grey' is that of 2 meshes"), std::string::npos) << made.out;
  json after = json::parse(contents(solved));
  auto& color = after["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
  EXPECT_NEAR(color[0].get<double>(), 0.2, 1e-5);
  EXPECT_NEAR(color[1].get<double>(), 0.5, 1e-5);
  EXPECT_NEAR(color[2].get<double>(), 0.3, 1e-5);
  EXPECT_EQ(color[3].get<double>(), 1);
  // Nothing else changes.
  const json before = json::parse(contents(scene));
  color = before["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
  EXPECT_EQ(after, before);
  const Outcome unknown = run({"solve", scene, "--target", target, "--fit", "material:gray:albedo,shine", "-o", solved});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find("'shine' is not a parameter"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("albedo and roughness are"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("did you mean 'grey'?"), std::string::npos) << unknown.err;
}

TEST_F(Program, SolveMovesALampToWhereItsPictureWasTaken) {
  const std::string truth = RoomFile({{0.5, 2.1, -0.4}}, 7, 0.9).write(folder / "truth.gltf");
  const std::string scene = RoomFile({{-0.2, 1.9, 0.3}}).write(folder / "scene.gltf");
  const std::string target = folder / "target.exr", solved = folder / "solved.gltf";
  ASSERT_EQ(run({"render", truth, "-o", target, "--size", "96x54"}).status, 0);
  const Outcome made =
      run({"solve", scene, "--target", target, "--fit", "panel:position,size,power", "-o", solved, "--report", folder / "report"});
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  const json after = json::parse(contents(solved)), before = json::parse(contents(scene));
  const auto& place = after["nodes"][2]["translation"];
  EXPECT_NEAR(place[0].get<double>(), 0.5, 1e-5);
  EXPECT_NEAR(place[1].get<double>(), 2.1, 1e-5);
  EXPECT_NEAR(place[2].get<double>(), -0.4, 1e-5);
  const auto& light = after["extensions"]["EXT_lights_area"]["lights"][0];
  EXPECT_NEAR(light["size"].get<double>(), 0.9, 1e-5);
  EXPECT_NEAR(light["intensity"].get<double>(), 7, 1e-4);
  // Nothing else changes.
  json same = after;
  same["nodes"][2] = before["nodes"][2];
  same["extensions"] = before["extensions"];
  EXPECT_EQ(same, before);
  const json report = json::parse(contents(folder / "report" / "report.json"));
  EXPECT_TRUE(report["converged"].get<bool>());
  EXPECT_GT(contents(folder / "report" / "index.html").size(), 4000u);
  // The written scene renders to the target.
  ASSERT_EQ(run({"render", solved, "-o", folder / "again.exr", "--size", "96x54"}).status, 0);
  const Outcome compared = run({"diff", folder / "again.exr", target, "--fail-above", "relative_l2=1e-3"});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
  // Its own solution takes no steps.
  const Outcome again =
      run({"solve", solved, "--target", target, "--fit", "panel:position,size,power", "-o", folder / "twice.gltf", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  for (const json& p : json::parse(again.out)["parameters"])
    EXPECT_NEAR(p["value"].get<double>(), p["start"].get<double>(), 1e-4) << p["name"];
}

// The lamp's node has a child of its own and a parent that turns, moves and scales it.
TEST_F(Program, SolveTurnsALampWithinItsParents) {
  const std::string target = folder / "target.exr", solved = folder / "solved.gltf";
  const auto file = [&](const char* name, const json& translation, const json& rotation) {
    RoomFile room({{0, 2, 0}});
    json& nodes = room.file.json["nodes"];
    nodes[2]["translation"] = translation;
    nodes[2]["rotation"] = rotation;
    nodes[2]["children"] = {room.file.append("nodes", {{"name", "empty"}})};
    const int parent = room.file.append(
        "nodes",
        {{"name", "arm"}, {"translation", {0.2, 1, -0.1}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 2, 2}}, {"children", {2}}});
    room.file.json["scenes"][0]["nodes"] = {0, 1, 3, parent};
    return room.write(folder / name);
  };
  const std::string truth = file("truth.gltf", {0.1, 0.5, 0.2}, {-0.69, 0.1, 0.05, std::sqrt(1 - 0.69 * 0.69 - 0.0125)});
  const std::string scene = file("scene.gltf", {0, 0.45, 0}, {-0.70710678, 0, 0, 0.70710678});
  ASSERT_EQ(run({"render", truth, "-o", target, "--size", "96x54"}).status, 0);
  const Outcome made = run({"solve", scene, "--target", target, "--fit", "panel:position,rotation,size,power", "-o", solved});
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  ASSERT_EQ(run({"render", solved, "-o", folder / "again.exr", "--size", "96x54"}).status, 0);
  const Outcome compared = run({"diff", folder / "again.exr", target, "--fail-above", "relative_l2=1e-3"});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err << made.out;
  const json after = json::parse(contents(solved));
  EXPECT_EQ(after["nodes"][2]["translation"], json::parse(contents(scene))["nodes"][2]["translation"]) << "the child stays in its place";
}

TEST_F(Program, SolveCopiesALightThatNodesShare) {
  const std::string scene = RoomFile({{-1, 2, 0}, {0, 2, 0}, {1, 2, 0}}, 100).write(folder / "scene.gltf"), solved = folder / "solved.gltf";
  std::ofstream(folder / "desk.json") << kDesk;
  const Outcome made = run({"solve", scene, "--spec", folder / "desk.json", "-o", solved, "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const json report = json::parse(made.out), after = json::parse(contents(solved));
  EXPECT_EQ(report["lux"][0]["outside"], 0);
  EXPECT_EQ(report["parameters"][1]["name"], "panel 2: power");
  const auto& lights = after["extensions"]["EXT_lights_area"]["lights"];
  ASSERT_EQ(lights.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const auto number = after["nodes"][2 + i]["extensions"]["EXT_lights_area"]["light"].get<std::size_t>();
    const double factor = report["parameters"][i]["value"].get<double>() / report["parameters"][i]["start"].get<double>();
    EXPECT_NEAR(lights[number]["intensity"].get<double>(), 100 * factor, 1e-6 * 100);
  }
  // The same bytes on one thread.
  const Outcome one = run({"solve", scene, "--spec", folder / "desk.json", "-o", folder / "one.gltf", "--threads", "1"});
  ASSERT_EQ(one.status, 0);
  EXPECT_EQ(contents(folder / "one.gltf"), contents(solved));
}

TEST_F(Program, SolveWritesTheBestWhenItIsInterrupted) {
  const std::string truth = RoomFile({{0.5, 2.1, -0.4}, {-0.8, 2, 0.5}}, 7, 0.9).write(folder / "truth.gltf");
  const std::string scene = RoomFile({{-0.2, 1.9, 0.3}, {0.3, 1.8, 0}}).write(folder / "scene.gltf");
  const std::string target = folder / "target.exr", solved = folder / "solved.gltf";
  ASSERT_EQ(run({"render", truth, "-o", target, "--size", "640x360"}).status, 0);
  const Child child =
      start({"solve", scene, "--target", target, "--fit", "*:position,rotation,size,power", "--starts", "1000", "-o", solved}, [] {});
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  kill(child.pid, SIGINT);
  const Outcome made = finish(child);
  EXPECT_EQ(made.status, 128 + SIGINT) << made.err;
  EXPECT_EQ(json::parse(contents(solved))["extensions"]["EXT_lights_area"]["lights"].size(), 2u);
  EXPECT_NE(made.out.find("stopped"), std::string::npos) << made.out;
}

TEST_F(Program, SolveSaysEverythingThatIsWrong) {
  const std::string scene = RoomFile({{0, 2, 0}}).write(folder / "scene.gltf"), solved = folder / "solved.gltf";
  const auto error_of = [&](const std::string& spec, std::vector<std::string> more = {}) {
    std::ofstream(folder / "spec.json") << spec;
    std::vector<std::string> arguments = {"solve", scene, "--spec", folder / "spec.json", "-o", solved};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome made = run(arguments);
    EXPECT_EQ(made.status, 1) << spec << made.out;
    EXPECT_FALSE(fs::exists(solved)) << spec;
    return made.err;
  };
  const std::string all = error_of(
      R"({"fit": [{"light": "pannel", "power": true, "colour": 1}], "targets": [{"mesh": "flor", "lux": {"min": 5, "max": 1}}], "x": 1})");
  for (const char* part :
       {"did you mean 'panel'?", "fit[0].colour: unknown key", "no mesh is named 'flor'", "lux: min is above max", "x: unknown key"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
  const std::string target = R"("targets": [{"points": [[0,0,0]], "lux": {"min": 5}}])";
  const struct {
    std::string spec;
    const char* part;
  } cases[] = {
      {"{", "not JSON"},
      {"[]", "expected an object"},
      {"{}", "nothing to fit"},
      {R"({"fit": [{"light": "*", "power": true}]})", "no target"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{}]})", "has no target"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"points": [[0,0,0]]}]})", "lux: missing"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"points": [[0,0,0]], "lux": {}}]})", "asks for nothing"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"points": [[0,0,1e999]], "lux": {"min": 1}}]})", "not JSON"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"points": [], "lux": {"min": 1}}]})", "has no points"},
      {R"({"fit": [{"light": "*"}], )" + target + "}", "nothing to fit"},
      {R"({"fit": [{"light": "*", "position": {"min": [0,0,0]}}], )" + target + "}", "for 3 unknowns"},
      {R"({"fit": [{"light": "*", "position": {"min": [1,0,0], "max": [0,1,1]}}], )" + target + "}", "min is above max"},
      {R"({"fit": [{"light": "*", "power": {"min": 1e9}}], )" + target + "}", "outside of its range"},
      {R"({"fit": [{"light": "*", "power": true}, {"light": "panel", "power": true}], )" + target + "}", "fitted twice"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"picture": "none.exr"}]})", "none.exr"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"picture": "none.exr", "camera": "x"}]})", "no camera is named 'x'"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"points": [[0,0,0]], "normal": [0,-1,0], "lux": {"min": 5}}]})",
       "no target sees the light"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"points": [[0,0,0]], "lux": {"uniformity": 2}}]})", "is above 1"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"zone": {"center": [0,0,0], "x": [1,0,0], "y": [2,0,0]}, "lux": {"min": 1}}]})",
       "parallel"},
      {R"({"fit": [{"light": "*", "power": true}], "targets": [{"mesh": "part", "grid": 1e-4, "lux": {"min": 1}}]})", "200000"},
      {R"({"tie": [{"lights": ["panel"]}], "fit": [{"light": "*", "power": true}], )" + target + "}", "a tie needs"},
      {R"({"fit": [{"light": "*", "power": true, "keep": -1}], )" + target + "}", "must not be negative"},
      {R"({"least": "cost", "fit": [{"light": "*", "power": true}], )" + target + "}", "power is"},
  };
  for (const auto& c : cases) {
    const std::string error = error_of(c.spec);
    EXPECT_NE(error.find(c.part), std::string::npos) << c.spec << "\n" << error;
  }
  EXPECT_NE(
      error_of(R"({"fit": [{"light": "*", "position": true}], "targets": [{"points": [[0,0,0],[1,0,0],[0,0,1]], "lux": {"min": 5}}]})",
               {"--bounces", "2"})
          .find("bounces count where"),
      std::string::npos);
  EXPECT_EQ(run({"solve", scene, "--fit", "panel", "-o", solved, "--mask", scene}).status, 2);
  // 3,000 lamps on a picture of a million pixels: refused before the memory is taken.
  std::vector<Vec3d> many;
  for (int i = 0; i < 3000; ++i) many.push_back({0.001 * i - 1.5, 2, 0});
  const std::string crowd = RoomFile(many).write(folder / "crowd.gltf");
  ASSERT_EQ(run({"render", scene, "-o", folder / "large.exr", "--size", "1280x800"}).status, 0);
  const Outcome crowded = run({"solve", crowd, "--target", folder / "large.exr", "--fit", "*", "-o", solved});
  EXPECT_EQ(crowded.status, 1);
  EXPECT_NE(crowded.err.find("GB (choose a smaller --size"), std::string::npos) << crowded.err;
}

}  // namespace steradian::solve_program_test
