// EULUMDAT: one entry per line, in a fixed order. Intensities are in candela per 1000 lumens of the lamps.
#include <string>
#include <vector>

#include "scene/photometry/profile.h"

namespace steradian::scene {
namespace {

constexpr double kLargestEntry = 1e12;
constexpr std::size_t kMostPlanes = 721, kMostAngles = 361, kMostLamps = 20;

class Lines {
 public:
  explicit Lines(PhotometryText& text) : text_(text) {}

  void skip(std::size_t lines) {
    for (std::size_t i = 0; i < lines; ++i) next("an entry");
  }
  double number(const char* what, double low, double high) {
    const std::string_view line = next(what);
    double value = 0;
    if (!read_number(line, value)) text_.fail(std::string("expected ") + what + ", found " + quoted(line));
    text_.check_range(what, value, low, high);
    return value;
  }
  std::size_t count(const char* what, std::size_t low, std::size_t high) {
    const double value = number(what, static_cast<double>(low), static_cast<double>(high));
    if (value != static_cast<double>(static_cast<std::size_t>(value))) text_.fail(std::string(what) + " is not a whole number");
    return static_cast<std::size_t>(value);
  }
  std::vector<double> rising(const char* what, std::size_t size, double high) {
    std::vector<double> result;
    for (std::size_t i = 0; i < size; ++i) {
      result.push_back(number(what, 0, high));
      if (i > 0 && !(result[i] > result[i - 1])) text_.fail(std::string(what) + " is not above the one before");
    }
    return result;
  }

  // True if a number follows. Remarks of companies may follow the data.
  bool a_number_follows() {
    double value = 0;
    while (!text_.at_end())
      if (read_number(text_.line(), value)) return true;
    return false;
  }

 private:
  // A decimal comma counts as a decimal point.
  static bool read_number(std::string_view text, double& value) {
    std::string line(text);
    for (char& c : line)
      if (c == ',') c = '.';
    return read_whole_number(line, value);
  }
  std::string_view next(const char* what) {
    if (text_.at_end()) text_.fail(std::string("the file ends where ") + what + " is expected");
    return text_.line();
  }
  PhotometryText& text_;
};

// Isym, and the part of the Mc planes that the file holds: its first plane and the number of planes.
enum class Symmetry { none, about_axis, by_0_180, by_90_270, by_both };
struct Held {
  std::size_t first, count;
};
Held planes_held(Symmetry symmetry, std::size_t planes) {
  switch (symmetry) {
    case Symmetry::none: return {0, planes};
    case Symmetry::about_axis: return {0, 1};
    case Symmetry::by_0_180: return {0, planes / 2 + 1};
    case Symmetry::by_90_270: return {3 * planes / 4, planes / 2 + 1};
    case Symmetry::by_both: return {0, planes / 4 + 1};
  }
  return {0, planes};
}

// Mirrors planes of 270 to 450 degrees at the plane of 90 and 270. They become those of 90 to 270, in reverse order.
void turn_from_270_to_90(LightProfile& profile) {
  const std::vector<double> planes = std::move(profile.horizontal), candela = std::move(profile.candela);
  const std::size_t angles = profile.vertical.size();
  profile.horizontal.clear();
  profile.candela.clear();
  for (std::size_t i = planes.size(); i-- > 0;) {
    profile.horizontal.push_back(540 - planes[i]);
    for (std::size_t v = 0; v < angles; ++v) profile.candela.push_back(candela[i * angles + v]);
  }
}

}  // namespace

LightProfile read_eulumdat(PhotometryText text) {
  Lines lines(text);
  lines.skip(2);  // company; type of luminaire
  const auto symmetry = static_cast<Symmetry>(lines.count("the symmetry (0 to 4)", 0, 4));
  const std::size_t planes = lines.count("the number of C planes", 1, kMostPlanes);
  lines.skip(1);
  const std::size_t angles = lines.count("the number of angles of a plane", 2, kMostAngles);
  lines.skip(6);   // distance of angles; report, name, number, file, date
  lines.skip(11);  // sizes; downward flux; light output ratio
  const double conversion = lines.number("the factor of intensities", 0, kLargestEntry);
  lines.skip(1);  // tilt
  const std::size_t sets = lines.count("the number of sets of lamps", 1, kMostLamps);
  LightProfile profile;
  for (std::size_t i = 0; i < sets; ++i) {
    lines.skip(2);  // number of lamps (negative: absolute measurement), type
    profile.rated_lumens += lines.number("the lamps' lumens", 0, kLargestEntry);
    lines.skip(3);  // colour, rendering index, watts
  }
  lines.skip(10);  // ratios of rooms
  if (planes % 4 != 0 && (symmetry == Symmetry::by_90_270 || symmetry == Symmetry::by_both))
    text.fail("this symmetry asks for a multiple of four C planes, here are " + std::to_string(planes));
  if (planes % 2 != 0 && symmetry == Symmetry::by_0_180)
    text.fail("this symmetry asks for an even number of C planes, here are " + std::to_string(planes));
  const std::vector<double> all = lines.rising("an angle of a C plane", planes, 360);
  profile.vertical = lines.rising("an angle of a plane", angles, 180);
  const Held held = planes_held(symmetry, planes);
  const double factor = conversion * profile.rated_lumens / 1000;
  for (std::size_t i = 0; i < held.count * angles; ++i) profile.candela.push_back(factor * lines.number("an intensity", 0, kLargestEntry));

  for (std::size_t i = 0; i < held.count; ++i) {
    const std::size_t plane = held.first + i;
    profile.horizontal.push_back(plane < planes ? all[plane] : all[plane - planes] + 360);
  }
  if (held.count == 1) profile.horizontal = {0};
  if (symmetry == Symmetry::by_90_270) turn_from_270_to_90(profile);
  if (!goes_round(profile.horizontal)) text.fail("the C planes do not go around the circle as their symmetry asks");
  if (lines.a_number_follows())
    text.fail("more intensities follow than the symmetry, " + std::to_string(planes) + " planes and " + std::to_string(angles) +
                  " angles announce",
              "check lines 3, 4 and 6");
  complete_circle(profile);
  return profile;
}

}  // namespace steradian::scene
