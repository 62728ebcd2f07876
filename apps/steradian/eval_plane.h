// eval --plane: light at points of SVG scenes.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "steradian/plane_bounce.h"

namespace steradian::app {

struct PlaneQueryDefaults {
  PlaneMethod method = PlaneMethod::exact;
  PlaneSampling sampling;
  Limits limits;
};

// Reads a scene once, however many queries name it.
class PlaneAnswers {
 public:
  explicit PlaneAnswers(const PlaneQueryDefaults& defaults) : defaults_(defaults) {}
  // Appends the answer and a newline; false if it is an error.
  bool answer_line(std::string_view line, std::string& out);

 private:
  const PlaneWorld& world(const std::string& path);
  const PlaneBounces& bounces(const std::string& path, int count);
  std::string answer(std::string_view line);

  PlaneQueryDefaults defaults_;
  std::map<std::string, PlaneWorld> worlds_;
  std::map<std::pair<std::string, int>, PlaneBounces> bounces_;
};

}  // namespace steradian::app
