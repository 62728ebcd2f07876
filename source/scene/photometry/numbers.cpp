#include "scene/photometry/numbers.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "steradian/error.h"

namespace steradian::scene {
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
