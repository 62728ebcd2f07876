// Point lights with a measured profile, from JSON query to JSON answer.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/random.h"
#include "eval/answer.h"
#include "night.h"

namespace steradian::eval::profile_test {
namespace {

nlohmann::json answer_to(const std::string& light, const std::string& position = "[0,0,0]") {
  QueryReader reader;
  std::string line = R"({"light":)" + light + R"(,"position":)" + position + R"(,"normal":[0,1,0],"material":{"brdf":"lambert"}})", out;
  const std::size_t size = line.size();
  line.resize(size + kQueryPadding);
  answer_line(reader, std::string_view(line).substr(0, size), out);
  return nlohmann::json::parse(out);
}

// 100 cd ahead, 60 at 90 degrees in the plane of angle 0, 20 in the plane of 90.
std::string lamp_file() {
  const std::string path = testing::TempDir() + "steradian_eval_lamp.ies";
  std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 10\n0 90\n0 90\n100 60\n100 20\n";
  return path;
}

TEST(EvalProfile, IntensityFollowsTheAngle) {
  const std::string light = R"({"type":"point","position":[0,2,0],"intensity":3,"profile":")" + lamp_file() + "\"";
  const auto red = [](const nlohmann::json& a) { return a.at("radiance").at(0).get<double>(); };
  EXPECT_NEAR(red(answer_to(light + "}")), 3 * 100 / 4.0 / std::numbers::pi, 1e-12);
  // At 45 degrees to +x, in the plane of angle 0, the intensity is half way from 100 to 60.
  const double share = 3 / 8.0 * std::sqrt(0.5) / std::numbers::pi;
  EXPECT_NEAR(red(answer_to(light + "}", "[2,0,0]")), 80 * share, 1e-12);
  EXPECT_NEAR(red(answer_to(light + "}", "[0,0,-2]")), 60 * share, 1e-12);
  EXPECT_NEAR(red(answer_to(light + R"(,"tangent":[0,0,1]})", "[2,0,0]")), 60 * share, 1e-12);
  EXPECT_NEAR(red(answer_to(light + R"(,"aim":[1,0,0]})", "[2,0,0]")), 60 * share, 1e-12);  // now 45 degrees in the plane of 90
  EXPECT_EQ(red(answer_to(light + R"(,"aim":[0,1,0]})")), 0);                               // it shines upwards
}

// Sums points over the area, each with its fraction.
TEST(EvalProfile, RectsAndDisksShineByIt) {
  const std::string file = lamp_file();
  const auto red = [](const nlohmann::json& a) { return a.at("radiance").at(0).get<double>(); };
  constexpr int kSteps = 60;
  for (const bool round : {false, true}) {
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < kSteps; ++k) {
        double u = 2 * (i + 0.5) / kSteps - 1, v = 2 * (k + 0.5) / kSteps - 1;
        if (round) {
          const double r = std::sqrt((i + 0.5) / kSteps), phi = 2 * std::numbers::pi * (k + 0.5) / kSteps;
          u = r * std::cos(phi), v = r * std::sin(phi);
        }
        const std::string place = std::to_string(0.5 * u) + ",2," + std::to_string(0.3 * v);
        sum += red(answer_to(R"({"type":"point","position":[)" + place + R"(],"intensity":3,"profile":")" + file + "\"}", "[1,0,0.4]"));
      }
    const std::string lamp = std::string(R"({"type":")") + (round ? "disk" : "rect") +
                             R"(","center":[0,2,0],"x":[0.5,0,0],"y":[0,0,0.3],"intensity":3,"profile":")" + file + "\"}";
    // x cross y points down, and x is the plane of angle 0, as the points' tangent is.
    EXPECT_NEAR(red(answer_to(lamp, "[1,0,0.4]")), sum / (kSteps * kSteps), 1e-3 * sum / (kSteps * kSteps)) << lamp;
  }
}

// Occluders that hide nothing, half of the light by its middle, and all of it. Past occluders the point is moved up by a
// hundred-thousandth.
TEST(EvalProfile, OccludersHideTheirShareOfIt) {
  const std::string lamp = R"({"type":"rect","center":[0,2,0],"x":[0.5,0,0],"y":[0,0,0.3],"profile":")" + lamp_file() + "\"}";
  const auto red = [&](const std::string& occluders, const std::string& method = "") {
    QueryReader reader;
    std::string out, line = R"({"light":)" + lamp + R"(,"position":[0,0,0],"normal":[0,1,0],"material":{"brdf":"lambert"})" + method +
                            (occluders.empty() ? "" : ",\"occluders\":[" + occluders + "]") + "}";
    const std::size_t size = line.size();
    line.resize(size + kQueryPadding);
    answer_line(reader, std::string_view(line).substr(0, size), out);
    const auto answer = nlohmann::json::parse(out);
    return answer.contains("error") ? -1 : answer.at("radiance").at(0).get<double>();
  };
  const double whole = red("");
  EXPECT_GT(whole, 1);
  EXPECT_NEAR(red("[[9,1,0],[10,1,0],[9,1,1]]"), whole, 3e-5 * whole);
  EXPECT_NEAR(red("[[0,1,-9],[9,1,0],[0,1,9]]"), 7.235841 / 2, 2e-3 * whole);  // half of the reference without occluders
  EXPECT_EQ(red("[[-9,1,-9],[9,1,-9],[0,1,9]]"), 0);
  EXPECT_NEAR(red("[[9,1,0],[10,1,0],[9,1,1]]", ",\"method\":\"reference\""), 7.235841, 1e-5);
  EXPECT_NEAR(red("[[0,1,-9],[9,1,0],[0,1,9]]", ",\"method\":\"reference\""), 7.235841 / 2, 1e-5);
}

// A lobe of about 12 degrees: what a point sees of the lamp decides how bright it is. Random boards, against rays.
TEST(EvalProfile, TheVisiblePartHasItsOwnMean) {
  const std::string path = testing::TempDir() + "steradian_eval_spot.ies";
  std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 6 1 1 2 0 0 0\n1 1 10\n0 6 12 20 40 90\n0\n1000 800 250 60 10 0\n";
  reference::Random random(5);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  int tried = 0;
  double worst = 0;
  for (int i = 0; i < test::by_day_or_night(24, 300); ++i) {
    const bool round = i % 2 == 1;
    const double edge = between(-0.5, 0.5);
    nlohmann::json query = {
        {"light", {{"type", round ? "disk" : "rect"}, {"center", {0, 2, 0}}, {"x", {0.5, 0, 0}}, {"y", {0, 0, 0.4}}, {"profile", path}}},
        {"position", {between(-0.6, 0.6), 0, between(-0.6, 0.6)}},
        {"normal", {between(-0.2, 0.2), 1, 0}},
        {"view", {0.1, 1, 0.3}},
        {"material", {{"brdf", "lambert"}}},
        {"occluders", {{{edge, 1, -9}, {9, 1, between(-3, 3)}, {between(-1, 1), 1, 9}}}}};
    const auto answer = [&](const char* method) {
      QueryReader reader;
      query["method"] = method;
      query["spp"] = 20000;
      std::string line = query.dump(), out;
      const std::size_t size = line.size();
      line.resize(size + kQueryPadding);
      answer_line(reader, std::string_view(line).substr(0, size), out);
      return nlohmann::json::parse(out);
    };
    const auto rays = answer("sampled"), exact = answer("exact");
    ASSERT_TRUE(rays.contains("radiance") && exact.contains("radiance")) << rays << exact;
    query.erase("occluders");
    const double whole = answer("exact")["radiance"][0], expected = rays["radiance"][0], sigma = rays["standard_error"];
    // Cells that the board cuts count by their area: a fraction of the light in them, which 1024 cells keep below a hundredth.
    const double bar = 5 * sigma + 0.01 * whole, off = std::fabs(exact["radiance"][0].get<double>() - expected);
    EXPECT_LT(off, bar) << i << ": " << exact << rays << " of " << whole;
    worst = std::max(worst, off / bar);
    ++tried;
  }
  std::cout << "[ measured ] " << tried << " lamps past boards, worst " << worst << " of the bar\n";
}

TEST(EvalProfile, KeysThatDoNotGoTogetherAreRefused) {
  const std::string rect = R"({"type":"rect","center":[0,2,0],"x":[1,0,0],"y":[0,0,1],)", profile = R"("profile":")" + lamp_file() + "\"";
  const auto error = [](const nlohmann::json& a) { return a.at("error").get<std::string>(); };
  EXPECT_NE(error(answer_to(rect + profile + R"(,"radiance":1})")).find("light.radiance"), std::string::npos);
  EXPECT_NE(error(answer_to(rect + R"("intensity":1})")).find("without \"profile\""), std::string::npos);
  EXPECT_NE(error(answer_to(R"({"type":"sphere","center":[0,2,0],"radius":1,)" + profile + "}")).find("profile"), std::string::npos);
}

TEST(EvalProfile, ABadFileIsNamedByTheKey) {
  const auto error = answer_to(R"({"type":"point","position":[0,2,0],"profile":"/nowhere/lamp.ies"})").at("error").get<std::string>();
  EXPECT_NE(error.find("light.profile"), std::string::npos) << error;
}

}  // namespace
}  // namespace steradian::eval::profile_test
