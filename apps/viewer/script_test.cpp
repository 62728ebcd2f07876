// Scripts of the window: lines written and read back, and the messages for invalid lines.
#include "script.h"

#include <gtest/gtest.h>

#include "keys.h"
#include "steradian/error.h"

namespace steradian::view::script_test {
namespace {

TEST(ViewScript, ADragIsAPressItsMovesAndARelease) {
  const auto events = read_script(R"({"drag": "left", "from": [10, 20], "to": [30, 40], "steps": 4, "shift": true})", "s");
  ASSERT_EQ(events.size(), 6u);
  EXPECT_EQ(events[0].word, ScriptWord::press);
  EXPECT_TRUE(events[0].shift);
  EXPECT_EQ(events[2].at, (Vec2d{20, 30}));
  EXPECT_EQ(events[4].at, (Vec2d{30, 40}));
  EXPECT_EQ(events[5].word, ScriptWord::release);
}

TEST(ViewScript, WhatIsRecordedIsPlayedTheSame) {
  const std::string text = R"({"press":"right","at":[1.5,2.0]}
{"move":[3.0,4.0]}
{"release":"right","at":[3.0,4.0]}
{"wheel":-2.0,"at":[5.0,6.0]}
{"key":"Ctrl+Z"}
{"wait":"settled"}
{"set":"color","value":[1,0,0]}
{"quit":true}
)";
  std::string again;
  for (const ScriptEvent& event : read_script(text, "s")) again += script_line(event) + "\n";
  EXPECT_EQ(again, text);
}

TEST(ViewScript, SaysWhereAndWhatIsWrong) {
  const auto message = [](const std::string& text) {
    try {
      read_script(text, "demo.jsonl");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(message("{\"key\": \"F1\"}\n\nnonsense").find("demo.jsonl: line 3: not a JSON object"), std::string::npos);
  EXPECT_NE(message(R"({"dance": 1})").find("known are drag, press"), std::string::npos);
  EXPECT_NE(message(R"({"press": "thumb", "at": [0, 0]})").find("left, middle or right"), std::string::npos);
  EXPECT_NE(message(R"({"press": "left"})").find("must be two numbers"), std::string::npos);
  EXPECT_NE(message(R"({"set": "size"})").find("needs a \"value\""), std::string::npos);
  EXPECT_NE(message(R"({"wait": "forever"})").find("settled"), std::string::npos);
  EXPECT_NE(message("[]").find("not a JSON object"), std::string::npos);
}

TEST(ViewKeys, HaveOneMeaningEach) {
  const auto bindings = key_bindings();
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    EXPECT_EQ(action_of(bindings[i].key), bindings[i].action);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(bindings[i].key, bindings[j].key);
  }
  EXPECT_EQ(action_of("ctrl+z"), Action::undo);
  EXPECT_FALSE(action_of("Hyper+X"));
}

}  // namespace
}  // namespace steradian::view::script_test
