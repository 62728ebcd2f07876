// IES LM-63: some lines of text up to a line that begins with TILT=, then numbers in a fixed order.
#include <cctype>
#include <string>

#include "scene/photometry/profile.h"

namespace steradian::scene {
namespace {

constexpr double kLargestFactor = 1e12;  // limit of lumens, candelas and factors
constexpr double kAnyNumber = 1e300;

std::string upper_without_blanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t') result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

// Accepts small letters only if they make up the whole line, because the lines before it may hold any words.
bool is_tilt(std::string_view line) {
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  if (line.starts_with("TILT=") || line.starts_with("TILT =")) return true;
  const std::string upper = upper_without_blanks(line);
  return upper == "TILT=NONE" || upper == "TILT=INCLUDE";
}

// Skips the pairs of angle and factor by which a tilted lamp dims. They do not apply to the lamp as measured.
void skip_tilt(PhotometryText& text, std::string_view line) {
  if (upper_without_blanks(line) != "TILT=INCLUDE") return;
  text.number("the lamp's geometry", 1, 3);
  const std::size_t pairs = text.count("the number of tilts", 1, text.size());
  for (std::size_t i = 0; i < 2 * pairs; ++i) text.number("a tilt's angle or factor", -kLargestFactor, kLargestFactor);
}

// Mirrors the angles to -90 to 90 if the file gives one half. Returns the number of angles that it gave.
std::size_t mirror(std::vector<double>& angles) {
  const std::size_t given = angles.size();
  if (angles.front() != 0 || given == 1) return given;
  std::vector<double> whole;
  for (std::size_t i = given; i-- > 1;) whole.push_back(-angles[i]);
  whole.insert(whole.end(), angles.begin(), angles.end());
  angles = std::move(whole);
  return given;
}

// Expands the symmetry of type b.
void complete_b(LightProfile& profile) {
  const std::vector<double> given = std::move(profile.candela);
  const std::size_t planes = mirror(profile.horizontal), angles = mirror(profile.vertical);
  const std::size_t more_planes = profile.horizontal.size() - planes, more_angles = profile.vertical.size() - angles;
  const auto source = [](std::size_t i, std::size_t more) { return i >= more ? i - more : more - i; };
  profile.candela.clear();
  for (std::size_t h = 0; h < profile.horizontal.size(); ++h)
    for (std::size_t v = 0; v < profile.vertical.size(); ++v)
      profile.candela.push_back(given[source(h, more_planes) * angles + source(v, more_angles)]);
}

}  // namespace

LightProfile read_ies(PhotometryText text) {
  std::string_view first, line;
  do {
    if (text.at_end()) text.fail("the file has no line TILT=", "an IES file has one before its numbers: TILT=NONE");
    line = text.line();
    if (first.empty()) first = line;
  } while (!is_tilt(line));
  skip_tilt(text, line);

  LightProfile profile;
  const double lamps = text.number("the number of lamps", -kLargestFactor, kLargestFactor);
  const double lumens = text.number("the lumens of a lamp", -1, kLargestFactor);  // -1: the intensities are those of the whole luminaire
  const double multiplier = text.number("the multiplier of intensities", 0, kLargestFactor);
  const std::size_t vertical = text.count("the number of vertical angles", 2, text.size());
  const std::size_t horizontal = text.count("the number of horizontal angles", 1, text.size());
  const std::size_t type = text.count("the type of photometry", 1, 3);
  if (type == 3) text.fail("type A photometry is not read", "types B (2) and C (1) are: convert the file");
  for (const char* what : {"the unit of lengths", "the width", "the length", "the height"}) text.number(what, -kAnyNumber, kAnyNumber);
  const double ballast = text.number("the ballast's factor", 0, kLargestFactor);
  const double photometric = text.number("the ballast-lamp photometric factor", -kAnyNumber, kAnyNumber);
  text.number("the watts", -kAnyNumber, kAnyNumber);
  if (lumens > 0 && lamps > 0) profile.rated_lumens = lamps * lumens;
  // The third factor became "for future use" in 2002, and in 2019 a code of how the file was made.
  const bool is_factor = first.find("LM-63-2002") == first.npos && first.find("LM-63-2019") == first.npos && photometric > 0;
  const double factor = multiplier * ballast * (is_factor ? photometric : 1);
  if (!(factor <= kLargestFactor)) text.fail("the multipliers of intensities come to more than 1e12");

  // Each intensity takes at least a digit and a blank. So no memory is allocated for more intensities than the file can hold.
  if (vertical * horizontal > text.size())
    text.fail(std::to_string(vertical) + " vertical times " + std::to_string(horizontal) +
              " horizontal angles are more than the file holds");
  const bool is_c = type == 1;
  profile.type = is_c ? LightProfile::Type::c : LightProfile::Type::b;
  profile.vertical = text.rising_numbers("vertical angle", vertical, is_c ? 0 : -90, is_c ? 180 : 90);
  profile.horizontal = text.rising_numbers("horizontal angle", horizontal, is_c ? 0 : -90, is_c ? 360 : 90);
  if (is_c && !goes_round(profile.horizontal))
    text.fail("the horizontal angles are none of 0 to 90, 180 or 360 degrees, 90 to 270, or one alone");
  if (!is_c && horizontal < 2)
    text.fail("photometry of type B has one horizontal angle", "it shines between the angles measured: give two or more");
  for (std::size_t i = 0; i < vertical * horizontal; ++i)
    profile.candela.push_back(factor * text.number("an intensity", 0, kLargestFactor));
  if (!text.nothing_follows()) text.fail("more follows than the numbers of angles announce", "check the numbers of angles after TILT=");
  if (is_c)
    complete_circle(profile);
  else
    complete_b(profile);
  return profile;
}

}  // namespace steradian::scene
