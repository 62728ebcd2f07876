// Point lights with a measured profile, from JSON to JSON.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "eval/answer.h"

namespace steradian::eval {
namespace {

nlohmann::json answer_to(const std::string& light, const std::string& position = "[0,0,0]") {
  QueryReader reader;
  std::string line = R"({"light":)" + light + R"(,"position":)" + position + R"(,"normal":[0,1,0],"material":{"brdf":"lambert"}})", out;
  const std::size_t size = line.size();
  line.resize(size + kQueryPadding);
  answer_line(reader, std::string_view(line).substr(0, size), out);
  return nlohmann::json::parse(out);
}

// 100 cd ahead, 60 at 90 degrees in the plane of angle 0, 20 in that of 90.
std::string lamp_file() {
  const std::string path = testing::TempDir() + "steradian_eval_lamp.ies";
  std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 10\n0 90\n0 90\n100 60\n100 20\n";
  return path;
}

TEST(EvalProfile, IntensityFollowsTheAngle) {
  const std::string light = R"({"type":"point","position":[0,2,0],"intensity":3,"profile":")" + lamp_file() + "\"";
  const auto red = [](const nlohmann::json& a) { return a.at("radiance").at(0).get<double>(); };
  EXPECT_NEAR(red(answer_to(light + "}")), 3 * 100 / 4.0 / std::numbers::pi, 1e-12);
  // 45 degrees to +x: in the plane of angle 0, half way from 100 to 60.
  const double share = 3 / 8.0 * std::sqrt(0.5) / std::numbers::pi;
  EXPECT_NEAR(red(answer_to(light + "}", "[2,0,0]")), 80 * share, 1e-12);
  EXPECT_NEAR(red(answer_to(light + "}", "[0,0,-2]")), 60 * share, 1e-12);
  EXPECT_NEAR(red(answer_to(light + R"(,"tangent":[0,0,1]})", "[2,0,0]")), 60 * share, 1e-12);
  EXPECT_NEAR(red(answer_to(light + R"(,"aim":[1,0,0]})", "[2,0,0]")), 60 * share, 1e-12);  // now 45 degrees in the plane of 90
  EXPECT_EQ(red(answer_to(light + R"(,"aim":[0,1,0]})")), 0);                               // it shines upwards
}

TEST(EvalProfile, ABadFileIsNamedByTheKey) {
  const auto error = answer_to(R"({"type":"point","position":[0,2,0],"profile":"/nowhere/lamp.ies"})").at("error").get<std::string>();
  EXPECT_NE(error.find("light.profile"), std::string::npos) << error;
}

}  // namespace
}  // namespace steradian::eval
