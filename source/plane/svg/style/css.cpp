#include "plane/svg/style/css.h"

#include <algorithm>

#include "plane/svg/text/text.h"

namespace steradian::plane::svg {
namespace {

std::string without_comments(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find("/*"), text.size());
    out += text.substr(0, begin);
    if (begin == text.size()) break;
    const std::size_t end = text.find("*/", begin + 2);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 2);
  }
  return out;
}

// The position behind the brace that closes the one at `open`.
std::size_t behind_block(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
    if (depth == 0) return i + 1;
  }
  return text.size();
}

}  // namespace

std::map<std::string, std::string, std::less<>> parse_declarations(std::string_view text) {
  std::map<std::string, std::string, std::less<>> result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    const std::string_view declaration = text.substr(0, end);
    const std::size_t colon = declaration.find(':');
    if (colon != std::string_view::npos) {
      std::string_view value = declaration.substr(colon + 1);
      if (const std::size_t important = value.find('!'); important != std::string_view::npos) value = value.substr(0, important);
      result.insert_or_assign(std::string(trimmed(declaration.substr(0, colon))), std::string(trimmed(value)));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

void StyleSheet::add(std::string_view given) {
  const std::string clean = without_comments(given);
  std::string_view text = trimmed(clean);
  while (!text.empty()) {
    const std::size_t open = text.find_first_of("{;");
    if (open == std::string_view::npos) break;
    const std::string_view head = trimmed(text.substr(0, open));
    const std::size_t end = text[open] == ';' ? open + 1 : behind_block(text, open);
    if (head.starts_with('@')) {
      unsupported.insert("CSS " + std::string(head.substr(0, head.find_first_of(" \t\n"))));
    } else if (text[open] == '{') {
      const auto declarations = parse_declarations(text.substr(open + 1, std::max(end, open + 2) - open - 2));
      std::string_view selectors = head;
      while (!selectors.empty()) {
        const std::size_t comma = std::min(selectors.find(','), selectors.size());
        add_rule(trimmed(selectors.substr(0, comma)), declarations);
        selectors.remove_prefix(std::min(comma + 1, selectors.size()));
      }
    }
    text = trimmed(text.substr(end));
  }
}

void StyleSheet::add_rule(std::string_view selector, const std::map<std::string, std::string, std::less<>>& declarations) {
  const std::size_t mark = selector.find_first_of(".#");
  const bool is_plain = !selector.empty() && selector.find_first_of(" \t\n>+~:[") == std::string_view::npos &&
                        (mark == std::string_view::npos || selector.find_first_of(".#", mark + 1) == std::string_view::npos);
  if (!is_plain) {
    unsupported.insert("CSS selector '" + std::string(selector) + "'");
    return;
  }
  const std::string_view element = selector.substr(0, mark);
  const bool named = !element.empty() && element != "*";
  const int by_mark = mark == std::string_view::npos ? 0 : selector[mark] == '#' ? 100 : 10;
  const std::string found_by(mark == std::string_view::npos ? selector : selector.substr(mark));
  rules_[found_by].push_back(
      {named && by_mark != 0 ? std::string(element) : std::string(), by_mark + (named ? 1 : 0), count_++, declarations});
}

std::optional<std::string> StyleSheet::property(std::string_view element, std::string_view id, std::string_view classes,
                                                std::string_view key) const {
  const Rule* best = nullptr;
  const auto look = [&](std::string_view found_by) {
    const auto rules = rules_.find(found_by);
    if (rules == rules_.end()) return;
    for (const Rule& rule : rules->second) {
      if (!rule.element.empty() && rule.element != element) continue;
      if (rule.declarations.find(key) == rule.declarations.end()) continue;
      if (best == nullptr || rule.weight > best->weight || (rule.weight == best->weight && rule.order > best->order)) best = &rule;
    }
  };
  look("*");
  look(element);
  if (!id.empty()) look("#" + std::string(id));
  for (std::string_view rest = trimmed(classes); !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of(" \t\n\r\f"), rest.size());
    look("." + std::string(rest.substr(0, end)));
    rest = trimmed(rest.substr(end));
  }
  if (best == nullptr) return {};
  return best->declarations.find(key)->second;
}

}  // namespace steradian::plane::svg
