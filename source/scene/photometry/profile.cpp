#include "scene/photometry/profile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/budget.h"
#include "core/files.h"
#include "steradian/error.h"

namespace steradian::scene {
namespace {

// Planes in the order of their angle, each with the number of the measured plane that it equals.
struct MeasuredPlanes {
  std::vector<double> angles;
  std::vector<std::size_t> like;
  void add(double angle, std::size_t plane) {
    angles.push_back(angle);
    like.push_back(plane);
  }
};

}  // namespace

bool goes_round(const std::vector<double>& planes) {
  const double first = planes.front(), last = planes.back();
  if (planes.size() == 1) return true;
  if (first == 0) return last == 90 || last >= 180;
  // The plane of 90 and 270 degrees mirrors the others, so without a plane of 180 there is no plane of 0.
  return first == 90 && last == 270 && std::find(planes.begin(), planes.end(), 180.0) != planes.end();
}

void complete_circle(LightProfile& profile) {
  const std::vector<double> given = std::move(profile.horizontal);
  MeasuredPlanes planes;
  const std::size_t n = given.size();
  const double first = given.front(), last = given.back();
  if (n == 1) {
    planes.add(0, 0);
  } else if (first == 0 && (last == 90 || last == 180)) {
    for (std::size_t i = 0; i < n; ++i) planes.add(given[i], i);
    if (last == 90)
      for (std::size_t i = n - 1; i-- > 0;) planes.add(180 - given[i], i);
    const std::size_t half = planes.angles.size();
    for (std::size_t i = half - 1; i-- > 0;) planes.add(360 - planes.angles[i], planes.like[i]);
  } else if (first == 90 && last == 270) {
    // The plane of 180 also serves as that of 0.
    for (std::size_t i = n; i-- > 0;)
      if (given[i] <= 180) planes.add(180 - given[i], i);
    for (std::size_t i = 1; i < n; ++i) planes.add(given[i], i);
    for (std::size_t i = n - 1; i-- > 0;)
      if (given[i] >= 180) planes.add(540 - given[i], i);
  } else {
    for (std::size_t i = 0; i < n; ++i) planes.add(given[i], i);
    if (last < 360) planes.add(360, 0);
  }
  const std::size_t angles = profile.vertical.size();
  std::vector<double> candela;
  for (const std::size_t plane : planes.like)
    for (std::size_t v = 0; v < angles; ++v) candela.push_back(profile.candela[plane * angles + v]);
  profile.horizontal = std::move(planes.angles);
  profile.candela = std::move(candela);
}

namespace {

constexpr std::size_t kLongestQuoted = 30;
constexpr char kEndOfFile = 0x1a;  // the end mark of DOS

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\0' || c == kEndOfFile || c == '\f' || is_line_end(c); }

std::string readable(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

}  // namespace

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, kLongestQuoted)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kLongestQuoted ? "...'" : "'");
}

bool read_whole_number(std::string_view text, double& value) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

std::string_view PhotometryText::line() {
  last_line_ = number_;
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
  const std::string_view result = text_.substr(begin, at_ - begin);
  if (at_ < text_.size()) {
    at_ += text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n' ? 2 : 1;
    ++number_;
  }
  return result;
}

void PhotometryText::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) {
    if (text_[at_] == '\n' || (text_[at_] == '\r' && !(at_ + 1 < text_.size() && text_[at_ + 1] == '\n'))) ++number_;
    ++at_;
  }
}

double PhotometryText::number(const std::string& what, double low, double high) {
  skip_blanks();
  last_line_ = number_;
  if (at_ >= text_.size()) fail("the file ends where " + what + " is expected");
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  const std::string_view text = text_.substr(begin, at_ - begin);
  double value = 0;
  if (!read_whole_number(text, value)) fail("expected " + what + ", found " + quoted(text));
  check_range(what, value, low, high);
  return value;
}

void PhotometryText::check_range(const std::string& what, double value, double low, double high) const {
  if (value < low || value > high) fail(what + " is " + readable(value) + ", which is not from " + readable(low) + " to " + readable(high));
}

std::size_t PhotometryText::count(const std::string& what, std::size_t low, std::size_t high) {
  const double value = number(what, static_cast<double>(low), static_cast<double>(high));
  if (value != std::floor(value)) fail(what + " is not a whole number");
  return static_cast<std::size_t>(value);
}

std::vector<double> PhotometryText::rising_numbers(const std::string& what, std::size_t size, double low, double high) {
  std::vector<double> result;
  result.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    result.push_back(number(what, low, high));
    if (i > 0 && !(result[i] > result[i - 1]))
      fail(what + " " + readable(result[i]) + " follows " + readable(result[i - 1]), "angles rise from each to the next");
  }
  return result;
}

bool PhotometryText::nothing_follows() {
  skip_blanks();
  last_line_ = number_;
  return at_ >= text_.size();
}

void PhotometryText::fail(const std::string& problem, const std::string& hint) const {
  throw Error(name_ + ": line " + std::to_string(last_line_), problem, hint);
}

}  // namespace steradian::scene

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
