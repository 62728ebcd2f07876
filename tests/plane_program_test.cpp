// The plane through the program: `render scene.svg` and `eval --plane` as processes.
#include <nlohmann/json.hpp>

#include <cmath>
#include <tuple>

#include "device/vulkan/device.h"
#include "program.h"
#include "steradian/picture.h"

namespace steradian::plane_program_test {
namespace {

using nlohmann::json;

const std::string kScene =
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 96 64'>"
    "<circle class='light' cx='20' cy='30' r='6' fill='#ffd080' data-intensity='2' data-range='80'/>"
    "<rect class='light' x='70' y='50' width='8' height='3' fill='#4080ff'/>"
    "<rect x='40' y='20' width='10' height='24' transform='rotate(20 45 32)'/>"
    "<image/><image/></svg>";

std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t n = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_F(Program, RenderOfAPlaneEqualsItsQueries) {
  const std::string svg = folder / "scene.svg", exr = folder / "a.exr", stats = folder / "s.json";
  std::ofstream(svg) << kScene;
  const Outcome r = run({"render", svg, "-o", exr, "--stats", stats});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(occurrences(r.err, "image"), 1u) << "unknown elements are named once: " << r.err;
  const Picture picture = read_picture(exr);
  ASSERT_EQ(picture.width, 96);
  ASSERT_EQ(picture.height, 64);
  const json s = json::parse(contents(stats));
  EXPECT_EQ(s["method"], "exact");
  EXPECT_EQ(s["lights"], 2);
  EXPECT_EQ(s["occluders"], 1);

  std::string queries;
  std::vector<std::pair<int, int>> pixels;
  for (int y = 2; y < 64; y += 5)
    for (int x = 1; x < 96; x += 7) {
      pixels.emplace_back(x, y);
      queries += json{{"scene", svg}, {"position", {x + 0.5, y + 0.5}}, {"method", "exact"}}.dump() + "\n";
    }
  const Outcome e = run({"eval", "--plane"}, queries);
  ASSERT_EQ(e.status, 0) << e.err << e.out;
  std::istringstream lines(e.out);
  std::string line;
  double brightest = 0;
  for (const auto& [x, y] : pixels) {
    ASSERT_TRUE(std::getline(lines, line));
    const json answer = json::parse(line);
    ASSERT_TRUE(answer.contains("mean_radiance")) << line;
    const Vec3f pixel = picture.at(x, y);
    const float values[3] = {pixel.x, pixel.y, pixel.z};
    for (int c = 0; c < 3; ++c) {
      const double exact = answer["mean_radiance"][static_cast<std::size_t>(c)].get<double>();
      EXPECT_NEAR(exact, static_cast<double>(values[c]), 2e-5) << x << ", " << y;  // 1e-5 of the brightest emission, 2
      brightest = std::max(brightest, exact);
    }
  }
  EXPECT_GT(brightest, 0.1);
}

TEST_F(Program, RenderOfAPlaneWithItsBouncesEqualsItsQueries) {
  const std::string svg = folder / "scene.svg", exr = folder / "a.exr", stats = folder / "s.json";
  std::ofstream(svg)
      << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 64 48'>"
         "<path d='M0 0H64V48H0ZM4 4V44H60V4Z' fill-rule='evenodd' data-albedo='0.7 0.5 0.3'/>"
         "<rect x='30' y='4' width='3' height='28' fill='#fff'/><circle class='light' cx='14' cy='14' r='3' fill='#fff'/></svg>";
  ASSERT_EQ(run({"render", svg, "-o", exr, "--bounces", "all", "--stats", stats}).status, 0);
  const Picture picture = read_picture(exr);
  const json s = json::parse(contents(stats));
  EXPECT_GT(s["bounces"]["elements"].get<int>(), 100);
  EXPECT_LT(s["bounces"]["error"].get<double>(), 0.02);
  const json answer =
      json::parse(run({"eval", "--plane"}, json{{"scene", svg}, {"position", {50.5, 10.5}}, {"bounces", "all"}}.dump() + "\n").out);
  const json once =
      json::parse(run({"eval", "--plane"}, json{{"scene", svg}, {"position", {50.5, 10.5}}, {"bounces", 1}}.dump() + "\n").out);
  EXPECT_NEAR(answer["mean_radiance"][0].get<double>(), static_cast<double>(picture.at(50, 10).x), 2e-5);
  EXPECT_NEAR(answer["bounce_error"][0].get<double>(), static_cast<double>(picture.layers.at("bounce_error")[50 + 10 * 64].x), 2e-5);
  EXPECT_GT(answer["mean_radiance"][0].get<double>(), once["mean_radiance"][0].get<double>()) << "behind the wall";
  EXPECT_NE(run({"render", svg, "-o", exr, "--bounces", "all", "--method", "sampled"}).status, 0);
  EXPECT_NE(run({"render", svg, "-o", exr, "--bounces", "many"}).status, 0);
}

TEST_F(Program, RenderOfAPlaneByFramesMovesWhatTheEditsSay) {
  const std::string svg = folder / "scene.svg", edits = folder / "edits.json", pattern = folder / "f_###.exr";
  const auto scene = [&](int x, bool box) {
    std::ofstream(svg) << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 64 48'><circle id='lamp' class='light' cx='" << x
                       << "' cy='14' r='3' fill='#fff'/>" << (box ? "<rect id='box' x='30' y='20' width='8' height='8'/>" : "") << "</svg>";
  };
  scene(10, true);
  std::ofstream(edits) << R"([{"frames": [1, 4], "id": "lamp", "move": [2, 0]}, {"frame": 3, "id": "box", "remove": true}])";
  const Outcome r = run({"render", svg, "-o", pattern, "--frames", "2..3", "--edits", edits});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(fs::exists(folder / "f_001.exr"));
  for (const auto& [frame, x, box] : {std::tuple(2, 14, true), std::tuple(3, 16, false)}) {
    scene(x, box);
    const std::string cold = folder / "cold.exr";
    ASSERT_EQ(run({"render", svg, "-o", cold}).status, 0);
    EXPECT_EQ(read_picture(folder / ("f_00" + std::to_string(frame) + ".exr")).pixels, read_picture(cold).pixels) << "frame " << frame;
  }
  // Frames that a stage does not draw come from scratch.
  scene(10, true);
  ASSERT_EQ(run({"render", svg, "-o", pattern, "--frames", "2..2", "--force", "--edits", edits, "--occluders", "fill", "--aa", "4"}).status,
            0);
  scene(14, true);
  ASSERT_EQ(run({"render", svg, "-o", folder / "cold.exr", "--occluders", "fill", "--aa", "4"}).status, 0);
  EXPECT_EQ(read_picture(folder / "f_002.exr").pixels, read_picture(folder / "cold.exr").pixels);
  scene(16, false);
  std::ofstream(edits) << R"([{"frames": [1, 4], "id": "nobody", "move": [2, 0]}])";
  EXPECT_NE(run({"render", svg, "-o", pattern, "--frames", "0..3", "--edits", edits}).err.find("nobody"), std::string::npos);
  EXPECT_NE(run({"render", svg, "-o", folder / "one.exr", "--frames", "0..3"}).status, 0);
  EXPECT_NE(run({"render", svg, "-o", pattern, "--frames", "3..0"}).status, 0);
}

TEST_F(Program, RenderOfAPlaneByFramesOnADeviceDrawsTheCpusFrames) {
  if (vulkan::list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const std::string svg = folder / "scene.svg", edits = folder / "edits.json";
  std::ofstream(edits) << R"([{"frames": [1, 4], "id": "lamp", "move": [2, 0]}])";
  const auto scene = [&](const std::string& inside) {
    std::ofstream(svg)
        << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 64 48'><circle id='lamp' class='light' cx='10' cy='14' r='3' "
           "fill='#fff'>"
        << inside << "</circle><rect x='30' y='20' width='8' height='8'/></svg>";
  };
  const auto frames = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", svg, "-o", folder / (name + "_#.exr"), "--frames", "0..2", "--fps", "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << r.err;
  };
  const auto same = [&] {
    std::vector<Vec3f> first;
    for (const char* frame : {"0", "1", "2"}) {
      const Picture cpu = read_picture(folder / ("cpu_" + std::string(frame) + ".exr"));
      const Picture device = read_picture(folder / ("device_" + std::string(frame) + ".exr"));
      for (std::size_t i = 0; i < cpu.pixels.size(); ++i)
        ASSERT_NEAR(device.pixels[i].x, cpu.pixels[i].x, 1e-4) << frame << ", pixel " << i;
      EXPECT_NE(device.pixels, first) << "nothing moves";
      first = device.pixels;
    }
  };
  scene("");
  frames("cpu", {"--edits", edits});
  frames("device", {"--edits", edits, "--backend", "vulkan"});
  same();
  scene("<animate attributeName='cx' from='10' to='50' dur='2s'/>");
  frames("cpu", {"--force"});
  frames("device", {"--force", "--backend", "vulkan"});
  same();
}

TEST_F(Program, RenderOfAPlaneByFramesMovesAsTheDrawingDoes) {
  const std::string svg = folder / "scene.svg", pattern = folder / "f_##.exr";
  const auto scene = [&](const std::string& cx, const std::string& inside) {
    std::ofstream(svg) << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 64 48'><circle class='light' cx='" << cx
                       << "' cy='14' r='3' fill='#fff' data-range='40'>" << inside
                       << "</circle><rect x='30' y='20' width='8' height='8'/></svg>";
  };
  const std::string slide = "<animate attributeName='cx' from='10' to='50' dur='2s'/>";
  scene("10", slide);
  Outcome r = run({"render", svg, "-o", pattern, "--frames", "0..4", "--fps", "5"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.err.find("not supported"), std::string::npos) << r.err;
  // Existing frames stay, unless all are drawn again.
  const fs::path third = folder / "f_03.exr";
  fs::remove(third);
  std::ofstream(folder / "f_02.exr") << "not a picture";
  r = run({"render", svg, "-o", pattern, "--frames", "0..4", "--fps", "5"});
  EXPECT_NE(r.err.find("4 of 5 frames are there"), std::string::npos) << r.err;
  const Picture drawn = read_picture(third);
  EXPECT_THROW(read_picture(folder / "f_02.exr"), std::exception);
  ASSERT_EQ(run({"render", svg, "-o", pattern, "--frames", "0..4", "--fps", "5", "--force"}).status, 0);
  EXPECT_EQ(read_picture(third).pixels, drawn.pixels);
  EXPECT_NO_THROW(read_picture(folder / "f_02.exr"));
  // Parts have the frames of the sequence.
  for (const char* part : {"2/2", "1/2"}) {
    ASSERT_EQ(run({"render", svg, "-o", folder / "p_#.exr", "--frames", "0..4", "--fps", "5", "--part", part}).status, 0);
    EXPECT_EQ(fs::exists(folder / "p_4.exr"), part[0] == '1');
  }
  for (const std::string k : {"0", "1", "2", "3", "4"})
    EXPECT_EQ(contents(folder / ("p_" + k + ".exr")), contents(folder / ("f_0" + k + ".exr")));
  EXPECT_NE(run({"render", svg, "-o", folder / "none.exr", "--part", "1/2"}).err.find("needs --frames"), std::string::npos);
  // 3 / 5 of a second: 10 + 40 * 0.3.
  scene("22", "");
  const std::string cold = folder / "cold.exr";
  ASSERT_EQ(run({"render", svg, "-o", cold}).status, 0);
  EXPECT_EQ(drawn.pixels, read_picture(cold).pixels);
  EXPECT_NE(run({"render", svg, "-o", cold, "--fps", "5"}).status, 0);
}

TEST_F(Program, RenderOfAPlaneLeavesOccludersClear) {
  const std::string svg = folder / "scene.svg", png = folder / "a.png";
  std::ofstream(svg) << kScene;
  const Outcome r = run({"render", svg, "-o", png, "--occluders", "clear"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(contents(png).at(25), 6) << "PNG's colour type: red, green, blue and alpha";
  const std::string exr = folder / "a.exr";
  ASSERT_EQ(run({"render", svg, "-o", exr, "--occluders", "clear"}).status, 0);
  const std::vector<Vec3f> alpha = read_picture(exr).layers.at("alpha");
  EXPECT_EQ(alpha.front(), (Vec3f{1, 1, 1}));
  EXPECT_NE(std::find(alpha.begin(), alpha.end(), Vec3f{}), alpha.end());
  const Outcome same = run({"diff", exr, exr});
  EXPECT_NE(same.out.find("alpha max    0"), std::string::npos) << same.out;
  EXPECT_EQ(same.err, "");
  const Outcome in_space = run({"render", "no.gltf", "-o", png, "--occluders", "clear"});
  EXPECT_EQ(in_space.status, 2) << in_space.err;
}

TEST_F(Program, RenderOfAPlaneSaysWhatIsABackdrop) {
  const std::string svg = folder / "scene.svg", exr = folder / "a.exr";
  const auto drawing = [&](const std::string& more) {
    std::ofstream(svg) << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 96 64'>\n<g inkscape:label='Background'><rect id='page' "
                          "width='96' height='64' fill='#ffe'"
                       << more << "/></g>\n<circle class='light' cx='20' cy='30' r='6' fill='#fff'/></svg>";
    const Outcome r = run({"render", svg, "-o", exr});
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  };
  const std::string line = "taken for a backdrop, which blocks no light: page (covers the whole picture); data-steradian=\"occluder\"";
  const std::string said = drawing("");
  EXPECT_EQ(occurrences(said, line), 1u) << said;
  EXPECT_GT(read_picture(exr).at(80, 30).x, 0.01f);
  EXPECT_EQ(occurrences(drawing(" data-steradian='occluder'"), "backdrop"), 0u);
  EXPECT_EQ(read_picture(exr).at(80, 30).x, 0.0f) << "it insists";

  std::ofstream(svg) << "<svg viewBox='0 0 96 64'><rect width='96' height='64'/><circle class='light' cy='30' r='6' fill='#fff'>"
                        "<animate attributeName='cx' from='10' to='50' dur='2s'/></circle></svg>";
  const Outcome frames = run({"render", svg, "-o", folder / "f_#.exr", "--frames", "0..2"});
  ASSERT_EQ(frames.status, 0) << frames.err;
  EXPECT_EQ(occurrences(frames.err, "taken for a backdrop"), 1u) << "once for all frames: " << frames.err;
  EXPECT_GT(read_picture(folder / "f_2.exr").at(80, 30).x, 0.01f);
}

TEST_F(Program, InfoTellsWhatADrawingHolds) {
  const std::string svg = folder / "scene.svg";
  std::ofstream(svg)
      << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 96 64'>\n<rect id='page' width='96' height='64'/>\n"
         "<circle id='lamp' class='light' cx='20' cy='30' r='6' fill='#fff' data-range='40'/>\n"
         "<circle id='noon' data-steradian='sun' data-sun-direction='-90 10' fill='#fff'/>\n"
         "<rect id='pane' x='40' y='9' width='5' height='20' data-transmittance='0.5'/><rect x='70' y='9' width='5' height='9'/>"
         "\n<g style='display:none'><rect width='1' height='1'/></g><image/></svg>";
  const Outcome r = run({"info", svg, "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const json facts = json::parse(r.out);
  ASSERT_EQ(facts["lights"].size(), 1u);
  EXPECT_EQ(facts["lights"][0]["name"], "lamp");
  EXPECT_EQ(facts["lights"][0]["range"], 40);
  ASSERT_EQ(facts["suns"].size(), 1u);
  EXPECT_NEAR(facts["suns"][0]["half_width"].get<double>(), 10, 1e-9);
  ASSERT_EQ(facts["occluders"].size(), 2u);
  EXPECT_EQ(facts["occluders"][0]["name"], "pane");
  EXPECT_TRUE(facts["occluders"][0].contains("transmittance"));
  EXPECT_EQ(facts["left_out"][0]["name"], "page");
  EXPECT_EQ(facts["left_out"][0]["reason"], "covers the whole picture");
  EXPECT_EQ(facts["left_out"][1]["name"], "<g> in line 6");
  EXPECT_EQ(facts["not_supported"], json({"<image>"}));
  const Outcome text = run({"info", svg});
  EXPECT_NE(text.out.find("page; count 1; reason covers the whole picture"), std::string::npos) << text.out;
  EXPECT_EQ(run({"info", folder / "none.svg"}).status, 1);
}

TEST_F(Program, RenderOfAPlaneTakesEveryMethod) {
  const std::string svg = folder / "scene.svg";
  std::ofstream(svg) << kScene;
  const auto mean = [&](const std::string& method) {
    const std::string exr = folder / (method + ".exr");
    std::vector<std::string> arguments = {"render", svg, "-o", exr, "--method", method, "--size", "48x32"};
    if (method == "sampled" || method == "marched") arguments.insert(arguments.end(), {"--spp", "64"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, 0) << method << ": " << r.err;
    double sum = 0;
    for (Vec3f p : read_picture(exr).pixels) sum += static_cast<double>(p.x + p.y + p.z);
    return sum;
  };
  const double exact = mean("exact");
  EXPECT_GT(exact, 0);
  // The estimate uses 1536 pixels with 64 stratified rays each: a ray's fraction of a pixel is 1/64, and errors average out.
  EXPECT_NEAR(mean("sampled") / exact, 1, 0.02);
  EXPECT_NEAR(mean("marched") / exact, 1, 0.02);
  const Outcome refused = run({"render", svg, "-o", folder / "par.exr", "--method", "par"});
  EXPECT_EQ(refused.status, 1) << "par knows no range";
  EXPECT_NE(refused.err.find("use exact"), std::string::npos) << refused.err;
  // If there is one light and nothing else, the heuristic is exact outside the light.
  std::ofstream(svg)
      << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 96 64'><circle cx='48' cy='32' r='9' class='light' fill='#fff'/></svg>";
  EXPECT_GT(mean("par"), 0);
  EXPECT_GT(mean("exact"), 0);
  const Picture par = read_picture(folder / "par.exr"), right = read_picture(folder / "exact.exr");
  for (const int x : {0, 12, 47}) EXPECT_NEAR(par.at(x, 3).x, right.at(x, 3).x, 1e-5f) << x;
}

TEST_F(Program, RenderRefusesBrokenSvgWithLineAndHint) {
  const std::string svg = folder / "broken.svg", out = folder / "a.png";
  std::ofstream(svg) << "<svg xmlns='http://www.w3.org/2000/svg'>\n<circle r='4'>\n</svg>";
  const Outcome r = run({"render", svg, "-o", out});
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.err.find("broken.svg:"), std::string::npos) << r.err;
  EXPECT_FALSE(fs::exists(out));
  std::ofstream(svg) << kScene;
  const Outcome wrong = run({"render", svg, "-o", out, "--method", "closed-form"});
  EXPECT_EQ(wrong.status, 2) << wrong.err;
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Program, EvalOfAPlaneAnswersTheOtherLines) {
  const std::string svg = folder / "scene.svg";
  std::ofstream(svg) << kScene;
  const std::string good = json{{"scene", svg}, {"position", {30, 30}}}.dump();
  const std::vector<std::string> bad = {"nonsense",
                                        "[]",
                                        json{{"scene", svg}}.dump(),
                                        json{{"scene", svg}, {"position", {1}}}.dump(),
                                        json{{"scene", svg}, {"position", {1, 2}}, {"method", "magic"}}.dump(),
                                        json{{"scene", svg}, {"position", {1, 2}}, {"colour", 1}}.dump(),
                                        json{{"scene", folder / "none.svg"}, {"position", {1, 2}}}.dump(),
                                        json{{"scene", svg}, {"position", {1, 2}}, {"spp", 0}}.dump()};
  std::string input = good + "\n";
  for (const std::string& line : bad) input += line + "\n";
  const Outcome r = run({"eval", "--plane"}, input + good + "\n");
  EXPECT_EQ(r.status, 1);
  std::istringstream lines(r.out);
  std::string first, line;
  ASSERT_TRUE(std::getline(lines, first));
  EXPECT_GT(json::parse(first)["mean_radiance"][0].get<double>(), 0);
  for (const std::string& query : bad) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_TRUE(json::parse(line).contains("error")) << query << " -> " << line;
  }
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, first);
}

}  // namespace steradian::plane_program_test
