// `steradian render SCENE.glb --frames`: the pictures of an animation, as a process.
#include "program.h"
#include "scene/gltf/gltf_animation.h"
#include "steradian/load_scene.h"
#include "steradian/picture.h"
#include "steradian/render.h"

namespace steradian::frames_program_test {
namespace {

std::string morph() { return test::kSourceDir + "/scenes/morph.glb"; }

TEST_F(Program, FramesOfAnAnimationAreItsMoments) {
  const std::string pattern = folder / "f_###.exr";
  const Outcome r = run({"render", morph(), "-o", pattern, "--frames", "9..11", "--fps", "10", "--size", "64x36", "--shadows", "off"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(fs::exists(folder / "f_008.exr"));
  EXPECT_FALSE(fs::exists(folder / "f_012.exr"));
  scene::GltfFile file = scene::read_gltf_file(morph());
  const auto animations = read_animations(file);
  file.json = json_at(file.json, animations.at(0), 1.1);
  RenderOptions options;
  options.width = 64;
  options.height = 36;
  const Picture expected = render(load_scene_from_memory(glb_bytes(file), morph()).scene, options);
  const Picture frame = read_picture(folder / "f_011.exr");
  EXPECT_EQ(frame.pixels, expected.pixels);
  EXPECT_EQ(frame.metadata.at("steradian.frame"), "11");
  EXPECT_NE(frame.pixels, read_picture(folder / "f_009.exr").pixels);
}

TEST_F(Program, FramesGoOnWhereTheyWereInterrupted) {
  const std::string pattern = folder / "f_##.png";
  std::vector<std::string> command = {"render", morph(), "-o",     pattern, "--frames",  "0..3",
                                      "--fps",  "1",     "--size", "48x27", "--shadows", "off"};
  ASSERT_EQ(run(command).status, 0);
  const std::string second = contents(folder / "f_01.png"), third = contents(folder / "f_02.png");
  fs::remove(folder / "f_02.png");
  std::ofstream(folder / "f_01.png") << "kept";
  const Outcome again = run(command);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("3 of 4 frames are there"), std::string::npos) << again.err;
  EXPECT_EQ(contents(folder / "f_02.png"), third) << "the exposure, too, is that of the whole sequence";
  EXPECT_EQ(contents(folder / "f_01.png"), "kept");
  command.push_back("--force");
  ASSERT_EQ(run(command).status, 0);
  EXPECT_EQ(contents(folder / "f_01.png"), second);
}

// Each part has every third frame, with the exposure of the first frame of all.
TEST_F(Program, FramesAreDealtOutToParts) {
  std::vector<std::string> command = {"render", morph(), "--frames", "2..6", "--fps", "2", "--size", "48x27", "--shadows", "off", "-o"};
  const auto make = [&](const std::string& pattern, const std::string& part) {
    std::vector<std::string> whole = command;
    whole.push_back(folder / pattern);
    if (!part.empty()) whole.insert(whole.end(), {"--part", part});
    return run(whole);
  };
  ASSERT_EQ(make("whole_#.png", "").status, 0);
  ASSERT_EQ(make("part_#.png", "2/3").status, 0);
  for (int frame = 2; frame <= 6; ++frame)
    EXPECT_EQ(fs::exists(folder / ("part_" + std::to_string(frame) + ".png")), frame == 3 || frame == 6) << frame;
  for (const char* part : {"1/3", "3/3"}) ASSERT_EQ(make("part_#.png", part).status, 0);
  for (int frame = 2; frame <= 6; ++frame) {
    const std::string name = std::to_string(frame) + ".png";
    EXPECT_EQ(contents(folder / ("part_" + name)), contents(folder / ("whole_" + name))) << frame;
  }
  EXPECT_EQ(make("none_#.png", "9/9").status, 0) << "a part without frames";
  EXPECT_NE(make("none_#.png", "4/3").err.find("not k/n"), std::string::npos);
}

TEST_F(Program, FramesRefuseWhatMeansNothing) {
  const std::string pattern = folder / "f_##.png";
  const auto error = [&](std::vector<std::string> more) {
    std::vector<std::string> command = {"render", morph(), "-o", pattern, "--size", "16x9"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome r = run(command);
    EXPECT_NE(r.status, 0);
    return r.err;
  };
  EXPECT_NE(error({"--frames", "0..1", "--animation", "walk"}).find("there are: star to disk"), std::string::npos);
  EXPECT_NE(error({"--fps", "10"}).find("--frames"), std::string::npos);
  EXPECT_NE(error({"--frames", "2..1"}).find("A..B"), std::string::npos);
  const Outcome still = run({"render", test::kSourceDir + "/scenes/plane.glb", "-o", pattern, "--frames", "0..1", "--size", "16x9"});
  EXPECT_EQ(still.status, 1);
  EXPECT_NE(still.err.find("has no animation"), std::string::npos) << still.err;
  const Outcome one = run({"render", morph(), "-o", folder / "one.png", "--frames", "0..1", "--size", "16x9"});
  EXPECT_EQ(one.status, 2);
}

}  // namespace
}  // namespace steradian::frames_program_test
