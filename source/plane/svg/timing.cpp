#include "plane/svg/timing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "plane/svg/text/text.h"

namespace steradian::plane::svg {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

// The first of the begins that is a time; events and other animations never begin.
std::optional<double> begin_of(SvgDocument& document, std::string_view text) {
  if (text.empty()) return 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    const std::string_view one = trimmed(text.substr(0, end));
    const bool negative = one.starts_with('-');
    const std::string_view digits = trimmed(negative || one.starts_with('+') ? one.substr(1) : one);
    if (const auto at = clock_value(digits)) return negative ? -*at : *at;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  document.ignored.insert("animations that an event or another animation begins");
  return {};
}

double duration_of(SvgDocument& document, pugi::xml_node n, const char* key) {
  const std::string_view text = trimmed(n.attribute(key).value());
  if (text.empty() || text == "indefinite") return kForever;
  const auto seconds = clock_value(text);
  if (!seconds || !(*seconds > 0))
    document.fail(n, std::string(key) + "=\"" + std::string(text) + "\" is not a duration", "write 2s, 500ms or indefinite");
  return *seconds;
}

}  // namespace

std::optional<double> clock_value(std::string_view text) {
  Scanner scan(text);
  const auto first = scan.number();
  if (!first || *first < 0) return {};
  double seconds = *first;
  for (int parts = 1; scan.peek() == ':'; ++parts) {
    scan.next();
    const auto more = scan.number();
    if (!more || *more < 0 || parts > 2) return {};
    seconds = 60 * seconds + *more;
  }
  std::string unit;
  while (!scan.at_end()) unit += scan.next();
  unit = std::string(trimmed(unit));
  if (unit.empty() || unit == "s") return seconds;
  if (unit == "ms") return seconds / 1000;
  if (unit == "min") return seconds * 60;
  if (unit == "h") return seconds * 3600;
  return {};
}

namespace {

// Active duration, with repeats. As in SMIL it is the smaller of the declared limits; one turn if none is declared.
double active_of(SvgDocument& document, pugi::xml_node n, double simple) {
  const std::string_view repeats = trimmed(n.attribute("repeatCount").value());
  double active = kForever;
  if (n.attribute("repeatDur")) active = duration_of(document, n, "repeatDur");
  if (!repeats.empty() && repeats != "indefinite") {
    const auto count = Scanner(repeats).number();
    if (!count || !(*count > 0)) document.fail(n, "repeatCount is not a number above 0", "write 3 or indefinite");
    active = std::min(active, *count * simple);
  } else if (repeats.empty() && !n.attribute("repeatDur")) {
    active = simple;
  }
  return active;
}

}  // namespace

Extent extent_of(SvgDocument& document, pugi::xml_node n) {
  const auto begin = begin_of(document, n.attribute("begin").value());
  if (!begin) return {};
  const double simple = duration_of(document, n, "dur");
  if (simple == kForever) return {std::max(*begin, 0.0), false};
  const double active = active_of(document, n, simple);
  return {std::max(*begin + (active == kForever ? simple : active), 0.0), active == kForever};
}

std::optional<TimelineProgress> progress_of(SvgDocument& document, pugi::xml_node n, double seconds) {
  for (const char* key : {"end", "min", "max"})
    if (n.attribute(key)) document.ignored.insert(std::string("attribute ") + key + " of animations");
  const auto begin = begin_of(document, n.attribute("begin").value());
  if (!begin || seconds < *begin) return {};
  const double simple = duration_of(document, n, "dur"), at = seconds - *begin;
  if (simple == kForever) return TimelineProgress{};
  const double active = active_of(document, n, simple);
  const bool over = at >= active;
  if (over && std::string_view(n.attribute("fill").value()) != "freeze") return {};
  const double turns = std::min(over ? active / simple : at / simple, 1e9), whole = std::floor(turns);
  // Frozen at the end of a turn, not at the beginning of the next.
  if (over && turns == whole) return TimelineProgress{1, static_cast<int>(whole) - 1};
  return TimelineProgress{turns - whole, static_cast<int>(whole)};
}

}  // namespace steradian::plane::svg
