// View factors asked by lines of JSON.
#include "eval/exchange.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "eval/answer.h"

namespace steradian::eval::exchange_test {
namespace {

using nlohmann::json;

json ask(const std::string& line) {
  std::string padded = line, out;
  padded.resize(line.size() + kQueryPadding);
  QueryReader reader;
  answer_line(reader, {padded.data(), line.size()}, out);
  return json::parse(out);
}

const std::string kFloor = "[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]", kCeiling = "[[0,0,1],[0,1,1],[1,1,1],[1,0,1]]";

TEST(ExchangeQueries, HaveTheExactFactors) {
  const json open = ask(R"({"id":7,"from":)" + kFloor + R"(,"to":{"vertices":)" + kCeiling + "}}");
  EXPECT_EQ(open["id"], 7);
  EXPECT_NEAR(open["view_factor"].get<double>(), 0.1998248956983873830416, open["bound"].get<double>());
  EXPECT_LE(open["bound"].get<double>(), 1e-8);
  EXPECT_EQ(open["view_factor"], open["exchange_area"]);
  const json hidden = ask(R"({"from":)" + kFloor + R"(,"to":)" + kCeiling +
                          R"(,"obstacles":[[[0,0,0.5],[0.5,0,0.5],[0.5,0.5,0.5],[0,0.5,0.5]]],"eps":1e-10})");
  EXPECT_NEAR(hidden["view_factor"].get<double>(), 0.75 * 0.1998248956983873830416, hidden["bound"].get<double>());
  EXPECT_LE(hidden["bound"].get<double>(), 1e-10);
}

TEST(ExchangeQueries, NameWhatIsWrong) {
  const auto error = [](const std::string& line) { return ask(line).value("error", ""); };
  EXPECT_NE(error(R"({"from":)" + kFloor + "}").find("to: missing"), std::string::npos);
  EXPECT_NE(error(R"({"from":[[0,0,0],[1,0,0],[2,0,0]],"to":)" + kCeiling + "}").find("no area"), std::string::npos);
  EXPECT_NE(error(R"({"from":)" + kFloor + R"(,"to":)" + kCeiling + R"(,"obstacle":[]})").find("unknown key"), std::string::npos);
  EXPECT_NE(error(R"({"from":)" + kFloor + R"(,"to":)" + kCeiling + R"(,"obstacles":[[[0,0,0]]]})").find("obstacles[0]"),
            std::string::npos);
  EXPECT_NE(error(R"({"from":)" + kFloor + R"(,"to":)" + kCeiling + R"(,"eps":2})").find("eps"), std::string::npos);
  EXPECT_NE(error(R"({"from":3,"to":)" + kCeiling + "}").find("from"), std::string::npos);
}

}  // namespace
}  // namespace steradian::eval::exchange_test
