// The pictures that `compare` makes: of a scene by the reference, and by each method at its settings.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/alarm.h"
#include "steradian/limits.h"
#include "steradian/plane.h"
#include "steradian/render.h"

namespace steradian::app {

struct CompareArguments {
  std::string scene, output, size, exposure = "auto", bounces = "0";
  std::vector<std::string> methods;
  bool settings = true;
  std::optional<int> max_lights;
  double time_limit = 0;  // seconds; 0: none
  Limits limits;
  RenderOptions render;
};

// The picture of a method, with its time and passes.
struct Made {
  Picture picture;
  double ms = 0;
  std::vector<PassTime> passes;
};

// Renders a picture; none if the alarm rings before it is complete.
using Make = std::function<std::optional<Made>(const Alarm&)>;

// One setting of a method: its name, and the function that renders it.
struct Setting {
  std::string words;
  Make make;
};

// The settings of a method, from cheap to expensive, and the index of the one in the table.
using Settings = std::pair<std::vector<Setting>, std::size_t>;

// A scene in three dimensions or in the plane, in the form that `compare` needs.
struct Subject {
  Make reference;
  std::string reference_words;
  std::function<Settings(const std::string& method)> settings;
  // Renders a small picture, so that no method's time has that of the first threads, pages of memory and tables.
  std::function<void()> warm_up;
};

Subject frame_subject(const std::shared_ptr<const Scene>& scene, const CompareArguments& options);
Subject plane_subject(const std::shared_ptr<const PlaneWorld>& world, const CompareArguments& options);

}  // namespace steradian::app
