#include "script.h"

#include <cmath>
#include <sstream>

#include "steradian/error.h"

namespace steradian::view {
namespace {

using nlohmann::json;

struct Word {
  const char* name;
  ScriptWord word;
  enum { text, point, steps, seconds, flag, what } takes;
};
constexpr Word kWords[] = {
    {"press", ScriptWord::press, Word::text},       {"move", ScriptWord::move, Word::point},
    {"release", ScriptWord::release, Word::text},   {"click", ScriptWord::click, Word::point},
    {"wheel", ScriptWord::wheel, Word::steps},      {"key", ScriptWord::key, Word::text},
    {"select", ScriptWord::select, Word::text},     {"set", ScriptWord::set, Word::what},
    {"wait", ScriptWord::wait, Word::seconds},      {"time", ScriptWord::time, Word::text},
    {"shot", ScriptWord::shot, Word::text},         {"picture", ScriptWord::picture, Word::text},
    {"save", ScriptWord::save, Word::text},         {"resize", ScriptWord::resize, Word::point},
    {"minimise", ScriptWord::minimise, Word::flag}, {"restore", ScriptWord::restore, Word::flag},
    {"open", ScriptWord::open, Word::text},         {"quit", ScriptWord::quit, Word::flag},
};

struct ScriptLine {
  std::string place;
  json object;

  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const { throw Error(place, problem, hint); }
  Vec2d point(const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array() || found->size() != 2 || !found->at(0).is_number() || !found->at(1).is_number())
      fail(std::string("\"") + key + "\" must be two numbers", R"(as in "at": [400, 300])");
    return {found->at(0).get<double>(), found->at(1).get<double>()};
  }
  std::string text(const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) fail(std::string("\"") + key + "\" must be a text");
    return found->get<std::string>();
  }
  double number(const char* key, double otherwise) const {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    if (!found->is_number()) fail(std::string("\"") + key + "\" must be a number");
    return found->get<double>();
  }
  bool flag(const char* key) const { return object.contains(key) && object[key].is_boolean() && object[key].get<bool>(); }
  std::string button(const char* key) const {
    const std::string name = text(key);
    if (name != "left" && name != "middle" && name != "right") fail("\"" + name + "\" is not a button", "left, middle or right");
    return name;
  }
};

void add_drag(const ScriptLine& line, std::vector<ScriptEvent>& events) {
  const std::string button = line.button("drag");
  const Vec2d from = line.point("from"), to = line.point("to");
  const int steps = static_cast<int>(std::fmin(std::fmax(line.number("steps", 10), 1), 10000));
  events.push_back({ScriptWord::press, button, from, 0, line.flag("shift"), {}});
  for (int i = 1; i <= steps; ++i)
    events.push_back({ScriptWord::move, {}, from + (to - from) * (static_cast<double>(i) / steps), 0, false, {}});
  events.push_back({ScriptWord::release, button, to, 0, false, {}});
}

ScriptEvent event_of(const ScriptLine& line) {
  std::string known = "drag";
  for (const Word& word : kWords) {
    known += std::string(", ") + word.name;
    if (!line.object.contains(word.name)) continue;
    ScriptEvent event;
    event.word = word.word;
    event.shift = line.flag("shift");
    switch (word.takes) {
      case Word::text:
        event.text = word.word == ScriptWord::press || word.word == ScriptWord::release ? line.button(word.name) : line.text(word.name);
        if (word.word == ScriptWord::press || line.object.contains("at")) event.at = line.point("at");
        break;
      case Word::point: event.at = line.point(word.name); break;
      case Word::steps:
        event.number = line.number(word.name, 0);
        if (line.object.contains("at")) event.at = line.point("at");
        break;
      case Word::seconds:
        if (!line.object["wait"].is_string())
          event.number = std::fmax(line.number("wait", 0), 0.0);
        else if (line.text("wait") == "settled" || line.text("wait") == "picture")
          event.number = line.text("wait") == "settled" ? kSettled : kPicture;
        else
          line.fail("\"wait\" must be seconds, \"settled\" or \"picture\"");
        break;
      case Word::flag: break;
      case Word::what:
        event.text = line.text(word.name);
        if (!line.object.contains("value")) line.fail("\"set\" needs a \"value\"");
        event.value = line.object["value"];
        break;
    }
    return event;
  }
  line.fail("no word of a script", "known are " + known);
}

}  // namespace

std::vector<ScriptEvent> read_script(const std::string& text, const std::string& path) {
  std::vector<ScriptEvent> events;
  std::istringstream in(text);
  std::string content;
  for (int number = 1; std::getline(in, content); ++number) {
    if (content.find_first_not_of(" \t\r") == std::string::npos || content.starts_with("//")) continue;
    ScriptLine line{path + ": line " + std::to_string(number), json::parse(content, nullptr, false)};
    if (!line.object.is_object()) line.fail("not a JSON object", R"(as in {"key": "F1"})");
    if (line.object.contains("drag"))
      add_drag(line, events);
    else
      events.push_back(event_of(line));
  }
  return events;
}

std::string script_line(const ScriptEvent& event) {
  nlohmann::ordered_json line;
  for (const Word& word : kWords) {
    if (word.word != event.word) continue;
    const json point = {event.at.x, event.at.y};
    switch (word.takes) {
      case Word::text: line[word.name] = event.text; break;
      case Word::point: line[word.name] = point; break;
      case Word::steps: line[word.name] = event.number; break;
      case Word::seconds:
        line[word.name] = event.number >= 0 ? json(event.number) : json(event.number == kSettled ? "settled" : "picture");
        break;
      case Word::flag: line[word.name] = true; break;
      case Word::what:
        line[word.name] = event.text;
        line["value"] = event.value;
        break;
    }
    if (event.word == ScriptWord::press || event.word == ScriptWord::release || event.word == ScriptWord::wheel) line["at"] = point;
  }
  if (event.shift) line["shift"] = true;
  return line.dump();
}

}  // namespace steradian::view
