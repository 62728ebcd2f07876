#include "render/picture_options.h"

#include "steradian/bounces.h"

#include <cstdio>

#include "integrals/methods.h"
#include "verb.h"

namespace steradian::app {

PictureSize picture_size(const std::string& text) {
  PictureSize size;
  int used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &size.width, &size.height, &used) == 2 && static_cast<std::size_t>(used) == text.size() &&
      size.width >= 1 && size.height >= 1 && size.width <= 16384 && size.height <= 16384)
    return size;
  throw WrongOption("--size", "'" + text + "' is not WIDTHxHEIGHT with 1 to 16384 pixels a side");
}

std::optional<float> exposure_stops(const std::string& text) {
  if (text == "auto") return {};
  float stops = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%f%n", &stops, &used) == 1 && static_cast<std::size_t>(used) == text.size() && stops >= -30 && stops <= 30)
    return stops;
  throw WrongOption("--exposure", "'" + text + "' is not auto or a number of stops, -30 to 30");
}

std::vector<std::string> method_names() {
  std::vector<std::string> names = {"auto"};
  for (const methods::Row& row : methods::all()) names.emplace_back(row.name);
  return names;
}

std::string unknown_method(const std::string& name, bool plane) {
  if (method_of(name) || (plane && words::find<PlaneMethod>(name))) return {};
  return "unknown method " + name + ", use " + methods::names();
}

int bounces_of(const std::string& text) { return text == "all" ? kAllBounces : std::stoi(text); }

std::string unknown_bounces(const std::string& text) {
  const bool number = !text.empty() && text.size() < 6 && text.find_first_not_of("0123456789") == std::string::npos;
  return number || text == "all" ? std::string() : "give a number of bounces, or all";
}

void add_environment(Verb& verb, LoadOptions& load) {
  verb.add("--environment", load.environment, "a map (.hdr, .exr, .png, .jpg), white, or sky").group("Light");
  verb.add("--environment-rotation", load.environment_rotation, "degrees about +y, counter-clockwise from above")
      .value_name("N")
      .range(-360.0, 360.0)
      .group("Light");
}

}  // namespace steradian::app
