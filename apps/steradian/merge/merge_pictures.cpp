#include "merge/merge_pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "image/codecs.h"
#include "merge/joined_parts.h"
#include "render/part_facts.h"
#include "steradian/error.h"
#include "steradian/render.h"
#include "steradian/tone.h"

namespace steradian::app {
namespace {

void copy_part(std::vector<Vec3f>& to, const std::vector<Vec3f>& from, PicturePart part, int width) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    const auto pixel = static_cast<std::int64_t>(i);
    if (part.holds(static_cast<int>(pixel % width), static_cast<int>(pixel / width), width)) to[i] = from[i];
  }
}

}  // namespace

void merge_pictures(const std::vector<std::string>& parts, const std::string& output, const Limits& limits) {
  Picture all = join_parts(parts, "render", limits, [](Picture& to, const Picture& from, Part which) {
    const PicturePart part{which.number, which.count};
    copy_part(to.pixels, from.pixels, part, to.width);
    for (auto& [name, layer] : to.layers) copy_part(layer, from.layers.at(name), part, to.width);
  });
  if (all.metadata.erase(part_facts::kSettings) == 0)
    throw Error(parts[0], "is no part of a picture", "merge the files of render --part, or write a .glb of those of bake");
  std::string& exposure = all.metadata["steradian.exposure"];
  char* end = nullptr;
  const float stops = exposure == part_facts::kAutoExposure ? auto_exposure(all) : std::strtof(exposure.c_str(), &end);
  if (end != nullptr && (end == exposure.c_str() || *end != 0 || !std::isfinite(stops)))
    throw Error(parts[0], "has no exposure", "render the parts again");
  exposure = fmt::format("{}", stops);
  write_picture(all, output, stops, tone_curve_named(all.metadata["steradian.tone"]));
}

}  // namespace steradian::app
