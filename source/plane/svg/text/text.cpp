#include "plane/svg/text/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace steradian::plane::svg {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const auto end = std::find_if(text.begin(), text.end(), is_space);
    result.emplace_back(text.begin(), end);
    text.remove_prefix(result.back().size());
  }
  return result;
}

bool Scanner::accept(char c) {
  if (peek() != c || at_end()) return false;
  ++at_;
  return true;
}

void Scanner::skip_separators() {
  while (!at_end() && (is_space(text_[at_]) || text_[at_] == ',')) ++at_;
}

std::optional<double> Scanner::number() {
  std::size_t begin = at_;
  if (peek() == '+') ++begin;
  // from_chars also reads "inf" and "nan", which are not numbers here.
  const char first = begin < text_.size() ? text_[begin] : '\0';
  if (first != '-' && first != '.' && (first < '0' || first > '9')) return {};
  double value = 0;
  const auto [end, error] = std::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return {};
  at_ = static_cast<std::size_t>(end - text_.data());
  return value;
}

std::optional<bool> Scanner::flag() {
  skip_separators();
  if (accept('0')) return false;
  if (accept('1')) return true;
  return {};
}

Transform Transform::operator*(const Transform& n) const {
  return {a * n.a + c * n.b, b * n.a + d * n.b, a * n.c + c * n.d, b * n.c + d * n.d, a * n.e + c * n.f + e, b * n.e + d * n.f + f};
}

std::optional<Transform> parse_transform(std::string_view text) {
  Transform result;
  text = trimmed(text);
  while (!text.empty()) {
    const std::size_t open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
    const std::string_view name = trimmed(text.substr(0, open));
    Scanner scan(text.substr(open + 1, close - open - 1));
    double v[6];
    int count = 0;
    while (!scan.at_end()) {
      const auto number = scan.number();
      if (!number || count == 6) return {};
      v[count++] = *number;
      scan.skip_separators();
    }
    Transform t;
    const double degree = std::numbers::pi / 180;
    if (name == "matrix" && count == 6) {
      t = {v[0], v[1], v[2], v[3], v[4], v[5]};
    } else if (name == "translate" && (count == 1 || count == 2)) {
      t.e = v[0];
      t.f = count == 2 ? v[1] : 0;
    } else if (name == "scale" && (count == 1 || count == 2)) {
      t.a = v[0];
      t.d = count == 2 ? v[1] : v[0];
    } else if (name == "rotate" && (count == 1 || count == 3)) {
      const double c = std::cos(v[0] * degree), s = std::sin(v[0] * degree);
      t = {c, s, -s, c, 0, 0};
      if (count == 3) {
        const Vec2d moved = t.apply({v[1], v[2]});
        t.e = v[1] - moved.x;
        t.f = v[2] - moved.y;
      }
    } else if (name == "skewX" && count == 1) {
      t.c = std::tan(v[0] * degree);
    } else if (name == "skewY" && count == 1) {
      t.b = std::tan(v[0] * degree);
    } else {
      return {};
    }
    result = result * t;
    text.remove_prefix(close + 1);
    while (!text.empty() && (is_space(text.front()) || text.front() == ',')) text.remove_prefix(1);
  }
  return result;
}

std::vector<std::string> family_names(const std::string& css) {
  std::vector<std::string> names;
  for (std::string_view rest = css; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view name = trimmed(rest.substr(0, comma));
    if (name.size() > 1 && (name.front() == '"' || name.front() == '\'')) name = name.substr(1, name.size() - 2);
    if (!name.empty()) names.emplace_back(name);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return names;
}

}  // namespace steradian::plane::svg
