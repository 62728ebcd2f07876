#include "render/left_out.h"

#include <fmt/format.h>

#include <cstdio>

namespace steradian::app {

std::string names_of(const PlaneLeftOut& left_out) {
  std::string names;
  for (const std::string& name : left_out.names) names += (names.empty() ? "" : ", ") + name;
  if (left_out.count > left_out.names.size()) names += fmt::format(" and {} more", left_out.count - left_out.names.size());
  return names;
}

void say_backdrops(const PlaneSvg& drawing, const std::string& file) {
  std::string shapes;
  for (const PlaneLeftOut& left_out : drawing.left_out)
    if (left_out.is_backdrop()) shapes += fmt::format("{}{} ({})", shapes.empty() ? "" : "; ", names_of(left_out), words_of(left_out.why));
  if (shapes.empty()) return;
  fmt::print(stderr, "steradian: {}: taken for a backdrop, which blocks no light: {}; data-steradian=\"occluder\" makes it block\n", file,
             shapes);
}

}  // namespace steradian::app
