// SVG from files. It is separate from its reader, since streams need locales: a page's module has neither (web/steradian-plane).
#include <fstream>
#include <sstream>

#include "core/budget.h"
#include "plane/svg/document.h"
#include "steradian/error.h"
#include "steradian/plane.h"

namespace steradian {

namespace plane::svg {

std::string read_text(const std::string& path, const Limits& limits) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Error(path, "cannot be opened", "check the path");
  const std::streamoff size = file.tellg();
  if (size > 0) Budget(limits).take_memory(path, "the text of the file, as a tree", static_cast<std::uint64_t>(size) * 4);
  file.seekg(0);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file && !file.eof()) throw Error(path, "cannot be read", "check that it is a file");
  return text.str();
}

}  // namespace plane::svg

PlaneSvg load_plane_scene(const std::string& path, const Limits& limits) {
  return load_plane_scene_from_text(plane::svg::read_text(path, limits), path, limits);
}

}  // namespace steradian
