#include "plane/svg/style/values.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "plane/svg/text/text.h"

namespace steradian::plane::svg {
namespace {

// A text as its numbers and the texts between them, which are one more. White space and commas are equivalent.
struct Numbers {
  std::vector<double> values;
  std::vector<std::string> between{""};
};

Numbers numbers_of(std::string_view text) {
  Numbers result;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const auto digit = [&](std::size_t k) { return k < text.size() && std::isdigit(static_cast<unsigned char>(text[k])) != 0; };
    const bool signed_one = (c == '-' || c == '+') && (digit(i + 1) || (i + 1 < text.size() && text[i + 1] == '.' && digit(i + 2)));
    if (digit(i) || (c == '.' && digit(i + 1)) || signed_one) {
      const std::size_t from = c == '+' ? i + 1 : i;
      double value = 0;
      const auto [end, error] = std::from_chars(text.data() + from, text.data() + text.size(), value);
      if (error == std::errc() && std::isfinite(value)) {
        result.values.push_back(value);
        result.between.emplace_back();
        i = static_cast<std::size_t>(end - text.data());
        continue;
      }
    }
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',';
    std::string& last = result.between.back();
    if (!blank)
      last += c;
    else if (!last.ends_with(' '))
      last += ' ';
    ++i;
  }
  for (std::string& part : result.between)
    if (part.empty()) part = " ";
  return result;
}

// The same text with numbers combined from two texts, if both are of one kind.
template <class F>
std::optional<std::string> combined(std::string_view a, std::string_view b, F f) {
  const Numbers x = numbers_of(a), y = numbers_of(b);
  const auto alike = [](const std::string& s, const std::string& t) { return trimmed(s) == trimmed(t); };
  if (x.values.empty() || x.values.size() != y.values.size()) return {};
  if (!std::equal(x.between.begin(), x.between.end(), y.between.begin(), alike)) return {};
  std::string result(trimmed(x.between[0]));
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    result += number_text(f(x.values[i], y.values[i]));
    result += i + 1 < x.values.size() ? x.between[i + 1] : std::string(trimmed(x.between[i + 1]));
  }
  return result;
}

}  // namespace

std::string number_text(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x).ptr;
  return {text, end};
}

std::vector<std::string> split_list(std::string_view text, char separator) {
  std::vector<std::string> result;
  for (;;) {
    const std::size_t end = text.find(separator);
    const std::string_view one = trimmed(text.substr(0, end));
    // A separator at the end of a list closes it.
    if (end != std::string_view::npos || !one.empty()) result.emplace_back(one);
    if (end == std::string_view::npos) return result;
    text.remove_prefix(end + 1);
  }
}

std::optional<std::string> value_between(std::string_view a, std::string_view b, double share) {
  const auto from = parse_color(a), to = parse_color(b);
  if (from && to) {
    const auto channel = [&](double x, double y) {
      const double s = srgb_from_linear(x), t = srgb_from_linear(y);
      return number_text(100 * std::clamp(s + share * (t - s), 0.0, 1.0)) + "%";
    };
    return "rgb(" + channel(from->x, to->x) + "," + channel(from->y, to->y) + "," + channel(from->z, to->z) + ")";
  }
  return combined(a, b, [&](double x, double y) { return x + share * (y - x); });
}

std::optional<std::string> value_sum(std::string_view a, std::string_view b, double times) {
  return combined(a, b, [&](double x, double y) { return x + times * y; });
}

}  // namespace steradian::plane::svg
