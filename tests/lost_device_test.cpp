// A Vulkan device that is lost, never ends or has no memory left, simulated by a layer of the loader (tests/faulty_device). The program
// reports it, leaves no half-written picture and does not hang.
#include <set>

#include "device/vulkan/device.h"
#include "program.h"

namespace steradian::lost_device_test {
namespace {

class LostDevice : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    const auto devices = vulkan::list_devices();
    if (devices.empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
    name = devices.front().name;
    fs::create_directory(folder / "results");
  }

  Outcome run_with(const std::string& fault, std::vector<std::string> arguments) {
    return run_limited(std::move(arguments), [&] {
      setenv("VK_LAYER_PATH", test::kFaultyDevice.c_str(), 1);
      setenv("VK_INSTANCE_LAYERS", "VK_LAYER_STERADIAN_faulty_device", 1);
      setenv("STERADIAN_FAULT", fault.c_str(), 1);
      alarm(120);  // a hang is a failure, not an endless test
    });
  }
  std::vector<std::string> render(const std::string& scene, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "render", test::kSourceDir + "/scenes/" + scene, "-o", folder / "results" / "picture.png", "--size", "64x48", "--backend",
        "vulkan"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void expect_error(const Outcome& r, const std::string& what) const {
    EXPECT_EQ(r.status, 1) << r.err;
    EXPECT_NE(r.err.find("'" + name + "'"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find(what), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("--backend cpu"), std::string::npos) << r.err;
    EXPECT_TRUE(fs::is_empty(folder / "results")) << "left behind: " << fs::directory_iterator(folder / "results")->path();
  }

  std::string name;
};

TEST_F(LostDevice, TheLayerIsThereAndSilentUntilItIsAsked) {
  const Outcome r = run_with("vkQueueSubmit:1000000", render("glossy_floor.glb", {"--method", "ltc-compact", "--shadows", "off"}));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fs::exists(folder / "results" / "picture.png"));
}

TEST_F(LostDevice, EndsAPictureWithAnErrorAndNoFile) {
  const std::vector<std::string> direct = {"--method", "ltc-compact", "--shadows", "off"};
  expect_error(run_with("vkQueueSubmit:1", render("glossy_floor.glb", direct)), "lost");
  expect_error(run_with("vkWaitForFences:1", render("glossy_floor.glb", direct)), "lost");
  expect_error(run_with("timeout:1", render("glossy_floor.glb", direct)), "within five minutes");
  // The bounce begins after the direct light's only batch.
  expect_error(run_with("vkWaitForFences:2",
                        render("glossy_floor.glb", {"--method", "ltc-compact", "--shadows", "off", "--indirect", "ltc", "--vpls", "256"})),
               "lost");
  expect_error(run_with("vkQueueSubmit:1", render("plane/lamps.svg")), "lost");
}

TEST_F(LostDevice, OutOfMemoryIsSaidWhereverItHappens) {
  for (const int call : {1, 3, 6})
    expect_error(run_with("vkAllocateMemory:" + std::to_string(call), render("glossy_floor.glb", {"--shadows", "off"})), "memory");
}

TEST_F(LostDevice, EndsABench) {
  const Outcome r = run_with("vkQueueSubmit:1", {"bench", "--backend", "vulkan", "--filter", "vulkan/frame/direct", "--min-time", "0"});
  expect_error(r, "lost");
}

}  // namespace
}  // namespace steradian::lost_device_test
