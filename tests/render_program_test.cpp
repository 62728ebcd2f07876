// `steradian render` and `diff` as processes: pictures, statistics, exit codes, no half-written files.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "device/vulkan/device.h"
#include "program.h"
#include "steradian/compare.h"
#include "steradian/picture.h"
#include "support/gltf_test_file.h"

namespace steradian::render_program_test {
namespace {

using nlohmann::json;

std::string floor_scene() { return test::kSourceDir + "/scenes/diffuse_floor.glb"; }
std::string glossy_scene() { return test::kSourceDir + "/scenes/glossy_floor.glb"; }

TEST_F(Program, RenderWritesAPictureWithItsSettingsAndItsStatistics) {
  const std::string exr = folder / "a.exr", stats = folder / "s.json";
  const Outcome r = run({"render", floor_scene(), "-o", exr, "--size", "64x36", "--stats", stats, "--threads", "1"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "");
  const Picture picture = read_picture(exr);
  EXPECT_EQ(picture.width, 64);
  EXPECT_EQ(picture.height, 36);
  EXPECT_EQ(picture.metadata.at("steradian.method"), "exact");
  EXPECT_EQ(picture.metadata.at("steradian.shadows"), "on");
  EXPECT_EQ(picture.metadata.at("steradian.scene"), floor_scene());
  const json s = json::parse(contents(stats));
  for (const char* key :
       {"version", "command", "backend", "device", "simd", "threads", "width", "height", "seed", "lights", "method", "passes", "total_ms"})
    EXPECT_TRUE(s.contains(key)) << key;
  EXPECT_EQ(s["lights"], 1);
  EXPECT_NE(s["command"].get<std::string>().find("render"), std::string::npos);
  EXPECT_EQ(s["passes"][0]["name"], "load");
  EXPECT_EQ(s["passes"][1]["name"], "textures");
  double sum = 0;
  for (const json& pass : s["passes"]) sum += pass["ms"].get<double>();
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, s["total_ms"].get<double>() * 1.01);
}

TEST_F(Program, RenderGivesTheSameBytesAtOneAndTwoThreads) {
  for (const std::string method : {"auto", "sampled"}) {
    const auto picture = [&](const std::string& threads) {
      const std::string path = folder / ("t" + threads + ".exr");
      const Outcome r = run(
          {"render", glossy_scene(), "-o", path, "--size", "96x54", "--method", method, "--aa", "2", "--seed", "7", "--threads", threads});
      EXPECT_EQ(r.status, 0) << r.err;
      return contents(path);
    };
    const std::string one = picture("1");
    EXPECT_FALSE(one.empty());
    EXPECT_TRUE(one == picture("2")) << method;
  }
}

// 3 x 2 squares, of which each part has two or one: the merged file has the bytes of one run.
TEST_F(Program, PartsOfAPictureAreThePicture) {
  const std::string scene = test::kSourceDir + "/scenes/cornell.glb";
  const auto render = [&](const std::string& out, std::vector<std::string> settings, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", scene, "-o", out, "--size", "300x200", "--threads", "2"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
  };
  const std::vector<std::vector<std::string>> kinds = {{"--aa", "2"},
                                                       {"--method", "sampled", "--spp", "2", "--bounces", "2"},
                                                       {"--bounces", "all", "--reflections", "0", "--quality", "draft"},
                                                       {"--shadows", "off", "--lights", "tree"}};
  for (const std::vector<std::string>& kind : kinds) {
    std::vector<std::string> merge = {"merge"};
    for (const std::string k : {"4", "2", "1", "3"}) {
      merge.push_back(folder / (k + ".exr"));
      render(merge.back(), kind, {"--part", k + "/4"});
    }
    for (const std::string ending : {".exr", ".png"}) {
      if (ending == ".png" && &kind != &kinds.front()) continue;
      const std::string whole = folder / ("whole" + ending), merged = folder / ("merged" + ending);
      render(whole, kind, {});
      std::vector<std::string> arguments = merge;
      arguments.insert(arguments.end(), {"-o", merged});
      const Outcome r = run(arguments);
      ASSERT_EQ(r.status, 0) << r.err;
      EXPECT_TRUE(contents(whole) == contents(merged)) << kind.front() << ending;
    }
  }
  EXPECT_FALSE(read_picture(folder / "1.exr").pixels == read_picture(folder / "merged.exr").pixels);

  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.end(), {"-o", folder / "none.exr"});
    const Outcome r = run(arguments);
    EXPECT_NE(r.status, 0);
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "none.exr"));
  };
  refused({"merge", folder / "1.exr", folder / "2.exr", folder / "4.exr"}, "part 3 is missing");
  refused({"merge", folder / "1.exr", folder / "1.exr"}, "once more");
  refused({"merge", folder / "merged.exr"}, "no part");
  render(folder / "other.exr", {"--seed", "2"}, {"--part", "2/4"});
  refused({"merge", folder / "1.exr", folder / "other.exr"}, "other settings");
  refused({"render", scene, "--part", "5/4"}, "not k/n");
  refused({"render", scene, "--part", "1/4", "--bounces", "all"}, "--reflections 0");
  refused({"render", scene, "--part", "1/4", "--time-limit", "1"}, "--time-limit");
}

TEST_F(Program, RendersOnVulkanWhatTheCpuDoesAndSaysWhatTheHostHasDone) {
  if (vulkan::list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const std::string exr = folder / "v.exr", stats = folder / "s.json";
  const std::vector<std::string> usual = {"render", floor_scene(), "-o", exr, "--size", "64x36", "--backend", "vulkan"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), usual.begin(), usual.end());
    return run(more);
  };
  const Outcome r = with({"--stats", stats, "--device", "0"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(read_picture(exr).metadata.at("steradian.shadows"), "on");
  const json s = json::parse(contents(stats));
  EXPECT_EQ(s["backend"], "vulkan");
  EXPECT_EQ(s["device"], vulkan::list_devices().front().name);
  for (const char* name : {"device", "shadows"})
    EXPECT_TRUE(std::any_of(s["passes"].begin(), s["passes"].end(), [&](const json& pass) { return pass["name"] == name; })) << name;

  const Outcome sampled = with({"--method", "sampled", "--spp", "1"});
  EXPECT_EQ(sampled.status, 0) << sampled.err;
  EXPECT_NE(sampled.err.find("the CPU renders this picture, not the Vulkan device: it has no method sampled"), std::string::npos)
      << sampled.err;

  fs::remove(exr);
  const Outcome missing = with({"--device", "no such device"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("here are: 0 "), std::string::npos) << missing.err;
  EXPECT_FALSE(fs::exists(exr));
}

TEST_F(Program, RefusesWhatWouldChangeNothingAndNamesUnknownVerbs) {
  const std::string exr = folder / "x.exr", png = folder / "x.png", svg = test::kSourceDir + "/scenes/plane/room.svg";
  const std::vector<std::vector<std::string>> wrong = {
      {"render", floor_scene(), "-o", exr, "--spp", "8"},
      {"render", floor_scene(), "-o", exr, "--target-error", "0.1"},
      {"render", floor_scene(), "-o", exr, "--device", "0"},
      {"render", floor_scene(), "-o", exr, "--indirect-shadows", "4"},
      {"render", floor_scene(), "-o", exr, "--indirect", "ltc-outgoing", "--indirect-shadows", "4"},
      {"render", floor_scene(), "-o", exr, "--indirect", "ltc-outgoing", "--indirect-quads", "on"},
      {"render", floor_scene(), "-o", exr, "--vpls", "4096"},
      {"render", floor_scene(), "-o", exr, "--moments"},
      {"render", floor_scene(), "-o", exr, "--exposure", "bright"},
      {"render", floor_scene(), "-o", exr, "--background", "off"},
      {"render", floor_scene(), "-o", exr, "--light-units", "lumen"},
      {"render", svg, "-o", png, "--environment", "white"},
      {"render", floor_scene(), "-o", exr, "--light", "moon"},
      {"render", svg, "-o", png, "--moments"},
      {"render", svg, "-o", png, "--indirect", "ltc"},
      {"render", svg, "-o", png, "--camera", "left"},
  };
  for (const auto& arguments : wrong) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 2) << arguments.back() << ": " << r.err;
    EXPECT_FALSE(fs::exists(exr) || fs::exists(png)) << arguments.back();
  }
  const Outcome verb = run({"rendr"});
  EXPECT_EQ(verb.status, 2);
  EXPECT_NE(verb.err.find("did you mean 'render'?"), std::string::npos) << verb.err;
}

// The scene is none, and the tables would take seconds: an error about the output comes before both.
TEST_F(Program, JudgesEveryOutputBeforeTheWork) {
  const std::string no = folder / "no", file = folder / "file", scene = folder / "no_scene.glb", svg = folder / "no_scene.svg";
  std::ofstream(file) << "";
  const auto refuses = [&](const std::vector<std::string>& arguments, const std::string& path, const std::string& text) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 1) << arguments[0] << ": " << r.err;
    EXPECT_TRUE(r.err.starts_with("steradian: " + path) && r.err.find(text) != std::string::npos) << arguments[0] << ": " << r.err;
    EXPECT_EQ(r.out, "") << arguments[0];
  };
  const std::string missing = "the folder does not exist", ok = folder / "x.png";
  for (const std::string& of : {scene, svg}) {
    refuses({"render", of, "-o", no + "/x.png"}, no + "/x.png", missing);
    refuses({"render", of, "-o", ok, "--stats", no + "/x.json"}, no + "/x.json", missing);
    refuses({"render", of, "-o", no + "/x_##.png", "--frames", "0..3"}, no + "/x_##.png", missing);
    refuses({"render", of, "-o", folder / "x.gif"}, folder / "x.gif", "unknown picture format '.gif'");
    refuses({"compare", of, "-o", file}, file, "is a file");
    refuses({"compare", of, "-o", file + "/below/it"}, file + "/below/it", "is a file");
    refuses({"compare", of, "-o", "/proc/report"}, "/proc/report", "cannot write in the folder /proc");
  }
  refuses({"render", scene, "-o", folder / "f#" / "x.png", "--frames", "0..3"}, folder / "f0" / "x.png", missing);
  refuses({"fit", "-o", no + "/x.json"}, no + "/x.json", missing);
  refuses({"fit", "--report", "--report-picture", no + "/x.png"}, no + "/x.png", missing);
  refuses({"eval", no + "/queries", "-o", no + "/x.json"}, no + "/x.json", missing);
  refuses({"view", scene, "--record", no + "/x.txt"}, no + "/x.txt", missing);
  refuses({"bench", "--table2", "--figures", "/proc"}, "/proc", "cannot write in the folder /proc");
  EXPECT_FALSE(fs::exists(no) || fs::exists(ok));

  // A pipe is not opened before its time: its reader would see an end.
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Outcome r = run({"render", scene, "-o", ok, "--stats", pipe});
  EXPECT_NE(r.err.find("no_scene.glb"), std::string::npos) << r.err;
}

TEST_F(Program, AnUnknownOptionNamesTheNearestOne) {
  const auto says = [&](const std::vector<std::string>& arguments, const std::string& text) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 2) << text;
    EXPECT_NE(r.err.find(text), std::string::npos) << r.err;
  };
  says({"render", "x.gltf", "--sise", "10x10"}, "steradian render: unknown option --sise; did you mean --size?\n");
  says({"render", "x.gltf", "-o", "x.png", "--sise=10x10"}, "unknown option --sise; did you mean --size?\n");
  says({"render", "x.gltf", "-size", "10x10"}, "did you mean --size?\n");
  says({"render", "x.gltf", "--out", "x.png"}, "did you mean --output?\n");  // its beginning
  says({"render", "x.gltf", "--env", "sky"}, "did you mean --environment?\n");
  says({"compare", "x.gltf", "--targeterror", "1"}, "steradian compare: unknown option --targeterror; did you mean --target-error?\n");
  says({"bench", "--filtre", "kernel"}, "unknown option --filtre; did you mean --filter?\n");
  says({"--hlep"}, "steradian: unknown option --hlep; did you mean --help?\n");
  says({"render", "x.gltf", "--frobnicate"}, "unknown option --frobnicate\nsteradian render --help-all lists the options\n");
  EXPECT_EQ(run({"render", "--sise", "--help"}).status, 0);
}

TEST_F(Program, AnEnvironmentLightsAndIsSaid) {
  const std::string exr = folder / "a.exr", stats = folder / "s.json", map = folder / "map.exr";
  Picture white(16, 8);
  for (Vec3f& p : white.pixels) p = {1, 1, 1};
  write_picture(white, map);
  const auto picture = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", floor_scene(), "-o", exr, "--size", "32x18", "--stats", stats};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(r.err.find("environment:") != std::string::npos, !more.empty()) << r.err;
    return read_picture(exr);
  };
  const Picture plain = picture({}), from_file = picture({"--environment", map}), by_name = picture({"--environment", "white"});
  EXPECT_LT(difference(from_file, by_name).relative_l2, 1e-3);
  EXPECT_TRUE(json::parse(contents(stats)).contains("diffuse_residual"));
  const Picture dark = picture({"--environment", map, "--background", "off"});
  const Vec3f above = plain.at(0, 0);  // the sky
  EXPECT_EQ(dark.at(0, 0), above);
  EXPECT_EQ(by_name.at(0, 0), (Vec3f{1, 1, 1}));
  EXPECT_GT(dark.at(16, 16).x, plain.at(16, 16).x);
  EXPECT_EQ(run({"render", floor_scene(), "-o", exr, "--environment", "no_such.hdr"}).status, 1);
}

// The help tells how a file of samples is written, and the example in it is one.
TEST_F(Program, HelpOfFitTellsTheFormatOfSamples) {
  const std::string help = run({"fit", "--help"}).out, samples = folder / "wall.txt";
  std::istringstream lines(help);
  std::ofstream wall(samples);
  int count = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.ends_with(" 0.3183")) wall << line << "\n", ++count;
  wall.close();
  EXPECT_EQ(count, 4) << help;
  const Outcome r = run({"fit", "--samples", samples, "--size", "4", "-o", folder / "wall.json"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("albedo       1.000"), std::string::npos) << r.out;
}

// A measured white Lambertian surface: its table gives the closed form of Lambert's lobe.
TEST_F(Program, FitsSamplesToATableThatEvalReads) {
  const std::string samples = folder / "white.txt", table = folder / "white.json", wrong = folder / "wrong.txt";
  std::ofstream text(samples);
  text << "# theta_view theta_light azimuth value\n";
  for (const int view : {0, 45, 90})
    for (const int light : {0, 90})
      for (const int azimuth : {0, 180}) text << view << ' ' << light << ' ' << azimuth << " 0.3183098861837907\n";
  text.close();
  const Outcome fitted = run({"fit", "--samples", samples, "--size", "4", "-o", table});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  ASSERT_EQ(fitted.out.find("albedo"), 0u) << fitted.out;
  EXPECT_NEAR(std::stod(fitted.out.substr(6)), 1, 0.005) << "65,536 samples, of which half are even over the lobe";

  const auto answer = [&](const std::string& material) {
    const Outcome r =
        run({"eval"}, R"({"light": {"type": "rect", "center": [0.3,1,0], "x": [0.6,0,0], "y": [0,0,0.5]}, "position": [0,0,0], )"
                      R"("normal": [0,1,0], "view": [0.8,0.6,0], )" +
                          material + "}\n");
    return json::parse(r.out);
  };
  const double lambert = answer(R"("material": {"brdf": "lambert"})")["radiance"][0].get<double>();
  const json own = answer(R"("material": {"brdf": "ggx", "roughness": 0.3}, "method": "ltc", "table": ")" + table + "\"");
  ASSERT_TRUE(own.contains("radiance")) << own;
  EXPECT_NEAR(own["radiance"][0].get<double>(), lambert, 0.01 * lambert) << "the fit's tolerance; the lobe itself is a cosine";
  EXPECT_TRUE(answer(R"("material": {"brdf": "ggx", "roughness": 0.3}, "table": ")" + table + "\"").contains("error")) << "without ltc";
  EXPECT_TRUE(answer(R"("material": {"brdf": "ggx", "roughness": 0.3}, "method": "ltc", "table": "no.json")").contains("error"));

  std::ofstream(wrong) << "0 0 0 1\n0 0 south 1\n";
  const Outcome refused = run({"fit", "--samples", wrong, "-o", table});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("wrong.txt:2"), std::string::npos) << refused.err;
  EXPECT_EQ(run({"fit", "--samples", samples, "--layout", "compact", "-o", table}).status, 2);
  EXPECT_EQ(run({"fit", "--samples", samples, "--lobe", "ggx", "-o", table}).status, 2);
}

TEST_F(Program, ATableOfOnesOwnTakesThePlaceOfTheShippedOne) {
  const std::string table = folder / "t.json", rough = folder / "rough.json", exr = folder / "a.exr";
  ASSERT_EQ(run({"fit", "--lobe", "ggx", "--size", "8", "-o", table}).status, 0);
  const auto picture = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", glossy_scene(), "-o", exr, "--size", "64x36", "--method", "ltc", "--shadows", "off"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
    return read_picture(exr);
  };
  const Picture shipped = picture({}), own = picture({"--table", table});
  const double off = difference(own, shipped).relative_l2;
  EXPECT_GT(off, 1e-5) << "the table is read";
  EXPECT_LT(off, 0.2) << "8 x 8 nodes in place of 64 x 64 of the same lobe";

  // Twice the magnitudes give twice the specular light, and the same diffuse light.
  json doubled = json::parse(contents(table));
  for (json& node : doubled["magnitude"])
    for (int i : {0, 1}) node[static_cast<std::size_t>(i)] = 2 * node[static_cast<std::size_t>(i)].get<double>();
  std::ofstream(rough) << doubled;
  EXPECT_GT(picture({"--table", rough}).at(32, 30).x, own.at(32, 30).x);

  json broken = doubled;
  broken["matrix"].erase(3);
  for (const json& bad : {broken, json({{"layout", "compact"}}), json(17)}) {
    std::ofstream(rough) << bad;
    const Outcome r =
        run({"render", glossy_scene(), "-o", exr, "--size", "64x36", "--method", "ltc", "--shadows", "off", "--table", rough});
    EXPECT_EQ(r.status, 1) << r.err;
    EXPECT_NE(r.err.find(rough), std::string::npos) << r.err;
  }
  EXPECT_EQ(run({"render", glossy_scene(), "-o", exr, "--shadows", "off", "--table", table}).status, 2) << "without --method ltc";
  EXPECT_EQ(run({"render", glossy_scene(), "-o", exr, "--method", "ltc", "--bounces", "1", "--table", table}).status, 2) << "GGX's albedo";
}

TEST_F(Program, InfoTellsWhatASceneHolds) {
  const Outcome r = run({"info", test::kSourceDir + "/scenes/gallery.glb", "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const json facts = json::parse(r.out);
  for (const char* key :
       {"cameras", "lights", "materials", "extensions_used", "extensions_required", "not_supported", "not_computed", "method", "warnings"})
    EXPECT_TRUE(facts.contains(key)) << key;
  EXPECT_EQ(facts["lights"].size(), 4u);
  for (const json& light : facts["lights"]) {
    EXPECT_GT(light["power"].get<double>(), 0) << light;
    EXPECT_TRUE(light.contains("radiance") && light.contains("type")) << light;
  }
  EXPECT_EQ(facts["method"], "closed-form");
  const Outcome text = run({"info", test::kSourceDir + "/scenes/gallery.glb"});
  EXPECT_NE(text.out.find("EXT_lights_area"), std::string::npos) << text.out;
  EXPECT_EQ(run({"info", "no_such.glb"}).status, 1);
}

TEST_F(Program, DiffNamesWhatItDoesNotCompare) {
  Picture a(4, 2);
  a.layers["variance"].resize(8);
  const std::string path = folder / "a.exr";
  write_picture(a, path);
  const Outcome r = run({"diff", path, path});
  EXPECT_EQ(r.status, 0);
  EXPECT_NE(r.err.find("not compared: layer variance"), std::string::npos) << r.err;
}

TEST_F(Program, RenderSaysOnceThatSurfacesDoNotLightEachOther) {
  const std::string line = "direct light only", room = test::kSourceDir + "/scenes/room.glb";
  const auto said = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", folder / "a.exr", "--size", "32x18"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
    const std::size_t first = r.err.find(line);
    return first == std::string::npos ? 0 : r.err.find(line, first + 1) == std::string::npos ? 1 : 2;
  };
  EXPECT_EQ(said({"render", room}), 1);
  EXPECT_EQ(said({"render", room, "--indirect", "ltc", "--vpls", "1024"}), 0);
  EXPECT_EQ(said({"render", floor_scene()}), 0) << "a floor alone sends itself no light";
}

TEST_F(Program, RenderSaysWhereRoughGlassIsSharp) {
  using nlohmann::json;
  const auto said = [&](double roughness, const char* bounces) {
    scene::GltfTestFile f = scene::GltfTestFile::square();
    f.material()["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
    f.material()["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    f.json["extensionsUsed"] = {"KHR_materials_transmission"};
    const Outcome r = run({"render", f.write(), "-o", folder / "a.exr", "--size", "32x18", "--bounces", bounces});
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err.find("rough glass shows a sharp image") != std::string::npos;
  };
  EXPECT_TRUE(said(0.5, "0"));
  EXPECT_FALSE(said(0.5, "all"));
  EXPECT_FALSE(said(0, "0"));
}

TEST_F(Program, ExposesPngToMiddleGreyUnlessTold) {
  const std::string exr = folder / "a.exr", automatic = folder / "a.png", told = folder / "b.png";
  ASSERT_EQ(run({"render", floor_scene(), "-o", exr, "--size", "64x36"}).status, 0);
  const float stops = auto_exposure(read_picture(exr));
  const Outcome r = run({"render", floor_scene(), "-o", automatic, "--size", "64x36"});
  EXPECT_NE(r.err.find("(auto)"), std::string::npos) << r.err;
  ASSERT_EQ(run({"render", floor_scene(), "-o", told, "--size", "64x36", "--exposure", std::to_string(stops)}).status, 0);
  const Picture a = read_picture(automatic), b = read_picture(told);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) ASSERT_NEAR(a.pixels[i].y, b.pixels[i].y, 0.01f) << i;  // a step of 8 bits
}

TEST_F(Program, RenderRefusesWrongUseWithTwo) {
  const std::string out = folder / "x.exr";
  const std::vector<std::vector<std::string>> wrong = {
      {"render"},
      {"render", floor_scene()},
      {"render", floor_scene(), "-o", out, "--size", "64"},
      {"render", floor_scene(), "-o", out, "--size", "64x-1"},
      {"render", floor_scene(), "-o", out, "--size", "99999x99999"},
      {"render", floor_scene(), "-o", out, "--method", "magic"},
      {"render", floor_scene(), "-o", out, "--shadows", "maybe"},
      {"render", floor_scene(), "-o", out, "--terminator", "smooth", "--shadows", "off"},
      {"render", glossy_scene(), "-o", out, "--method", "exact"},
      {"render", glossy_scene(), "-o", out, "--method", "series"},
      {"render", floor_scene(), "-o", out, "--aa", "0"},
      {"render", floor_scene(), "-o", out, "--threads", "many"},
      {"render", floor_scene(), "-o", out, "--exposure", "bright"},
      {"render", floor_scene(), "-o", out, "--nonsense"},
      {"diff", floor_scene()},
      {"diff", out, out, "--fail-above", "rmse"},
  };
  for (const auto& arguments : wrong) {
    const Outcome r = run(arguments);
    std::string line;
    for (const std::string& a : arguments) line += a + " ";
    EXPECT_EQ(r.status, 2) << line << r.err;
    EXPECT_NE(r.err, "") << line;
    EXPECT_FALSE(fs::exists(out)) << line;
  }
  // The message names the lobe and the material.
  const Outcome r = run({"render", glossy_scene(), "-o", out, "--method", "exact"});
  EXPECT_NE(r.err.find("ggx"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("'mirror'"), std::string::npos) << r.err;
}

TEST_F(Program, RenderFailsWithOneAndLeavesNothingBehind) {
  const std::string out = folder / "x.exr";
  std::ofstream(folder / "broken.glb") << "glTF nothing";
  const std::vector<std::vector<std::string>> failing = {
      {"render", "/no/such/scene.glb", "-o", out},
      {"render", folder / "broken.glb", "-o", out},
      {"render", floor_scene(), "-o", "/no/such/folder/x.exr", "--size", "8x8"},
      {"render", floor_scene(), "-o", "/dev/full.exr/x.exr", "--size", "8x8"},
      {"render", floor_scene(), "-o", folder / "x.bmp", "--size", "8x8"},
      {"render", floor_scene(), "-o", out, "--camera", "nobody", "--size", "8x8"},
      {"diff", "/no/such/a.exr", "/no/such/b.exr"},
  };
  for (const auto& arguments : failing) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 1) << arguments[1] << ": " << r.err;
    EXPECT_NE(r.err, "");
  }
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name != "in" && name != "out" && name != "err" && name != "broken.glb") ADD_FAILURE() << name << " was left behind";
    ++files;
  }
  EXPECT_GE(files, 3);
}

TEST_F(Program, DiffMeasuresAndFailsAboveALimit) {
  const std::string a = folder / "a.exr", b = folder / "b.exr";
  ASSERT_EQ(run({"render", floor_scene(), "-o", a, "--size", "32x18"}).status, 0);
  Picture darker = read_picture(a);
  for (Vec3f& p : darker.pixels) p *= 0.5f;
  write_picture(darker, b);
  const Outcome r = run({"diff", b, a, "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const json d = json::parse(r.out);
  EXPECT_NEAR(d["relative_l2"].get<double>(), 0.5, 1e-6);
  EXPECT_GT(d["rmse"].get<double>(), 0);
  EXPECT_GT(d["max"].get<double>(), 0);
  EXPECT_EQ(run({"diff", b, a, "--fail-above", "relative_l2=0.51"}).status, 0);
  EXPECT_EQ(run({"diff", b, a, "--fail-above", "relative_l2=0.49"}).status, 1);
}

// The error of methods without sampling against the converged reference: alpha 0.09, F = 1. The closed form is accurate to 0.004
// (docs/theory/ggx.md), the tables to 0.02 (docs/theory/ltc.md). The reference itself is accurate to its target of 0.02, which is estimated
// from a pilot and thus uncertain by a quarter. Independent errors add in squares.
TEST_F(Program, GlossyMethodsAreNearTheReference) {
  const std::string reference = folder / "reference.exr";
  ASSERT_EQ(run({"render", glossy_scene(), "-o", reference, "--size", "48x27", "--method", "reference", "--target-error", "0.02"}).status,
            0);
  for (const auto& [method, limit] :
       std::vector<std::pair<std::string, std::string>>{{"closed-form", "0.0254"}, {"ltc", "0.0321"}, {"ltc-compact", "0.0321"}}) {
    const std::string path = folder / (method + ".exr");
    ASSERT_EQ(run({"render", glossy_scene(), "-o", path, "--size", "48x27", "--method", method}).status, 0);
    const Outcome r = run({"diff", path, reference, "--json", "--fail-above", "relative_l2=" + limit});
    EXPECT_EQ(r.status, 0) << method << ": " << r.out << r.err;
    EXPECT_NEAR(json::parse(r.out)["mean_ratio"].get<double>(), 1, 0.02) << method;
  }
}

}  // namespace
}  // namespace steradian::render_program_test
