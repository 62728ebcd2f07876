#include "core/budget.h"
#include "core/read_file.h"
#include "scene/photometry/readers.h"
#include "steradian/error.h"

namespace steradian {
namespace {

// Expanded symmetries take four times the file's numbers. Each number takes eight bytes in memory and at least two in the file.
constexpr std::uint64_t kBytesAByte = 32;

bool has_tilt(std::string_view text) {
  return text.find("TILT=") != std::string_view::npos || text.find("TILT =") != std::string_view::npos;
}

bool ends_with_ldt(std::string_view name) { return name.ends_with(".ldt") || name.ends_with(".LDT"); }

}  // namespace

LightProfile read_light_profile_from_memory(std::string_view bytes, const std::string& name, const Limits& limits) {
  Budget budget(limits);
  budget.take_memory(name, "its intensities", bytes.size() * kBytesAByte);
  const scene::PhotometryText text(bytes, name);
  LightProfile profile = ends_with_ldt(name) && !has_tilt(bytes) ? scene::read_eulumdat(text) : scene::read_ies(text);
  // The limit keeps intensities times a distance of a millimetre within the single precision of packs.
  for (const double candela : profile.candela)
    if (candela > 1e30) throw Error(name, "an intensity is more than 1e30 candela");
  return profile;
}

LightProfile read_light_profile(const std::string& path, const Limits& limits) {
  Budget budget(limits);
  const Bytes bytes = read_file(path, path, budget);
  return read_light_profile_from_memory({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, limits);
}

}  // namespace steradian
