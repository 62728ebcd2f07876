#include "plane/svg/document.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "plane/svg/text/text.h"
#include "steradian/error.h"

namespace steradian::plane::svg {

SvgDocument::SvgDocument(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {
  const auto parsed = document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_auto);
  if (!parsed)
    throw Error(place(parsed.offset), std::string("not well-formed XML: ") + parsed.description(),
                "check the tags and quotes on this line");
  if (std::string_view(root().name()) != "svg")
    throw Error(place_of(root()), "the root element is <" + std::string(root().name()) + ">, not <svg>", "give an SVG file");
  std::vector<pugi::xml_node> open{root()}, sheets;
  while (!open.empty()) {
    const pugi::xml_node n = open.back();
    open.pop_back();
    if (std::string_view(n.name()) == "style") sheets.push_back(n);
    if (n.attribute("id")) ids_.insert({n.attribute("id").value(), n});
    for (pugi::xml_node child : n.children()) open.push_back(child);
  }
  // The last of equal rules wins, so they are added in the file's order.
  std::sort(sheets.begin(), sheets.end(), [](pugi::xml_node a, pugi::xml_node b) { return a.offset_debug() < b.offset_debug(); });
  for (pugi::xml_node sheet : sheets)
    for (pugi::xml_node part : sheet.children()) sheet_.add(part.value());
  ignored.insert(sheet_.unsupported.begin(), sheet_.unsupported.end());
}

std::ptrdiff_t SvgDocument::line(std::ptrdiff_t offset) const {
  const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
  return 1 + std::count(text_.begin(), end, '\n');
}
std::string SvgDocument::place(std::ptrdiff_t offset) const { return name_ + ":" + std::to_string(line(offset)); }
std::string SvgDocument::called(pugi::xml_node n) const {
  if (*n.attribute("id").value() != '\0') return n.attribute("id").value();
  const std::string element = std::string("<") + n.name() + ">";
  return text_.find('\n') == std::string::npos ? element : element + " in line " + std::to_string(line(n.offset_debug()));
}
std::string SvgDocument::place_of(pugi::xml_node n) const {
  std::string where = place(n.offset_debug());
  if (*n.name() != '\0') where += std::string(": <") + n.name() + ">";
  if (n.attribute("id")) where += std::string(" '") + n.attribute("id").value() + "'";
  return where;
}
void SvgDocument::fail(pugi::xml_node n, const std::string& problem, const std::string& hint) const {
  throw Error(place_of(n), problem, hint);
}

pugi::xml_node SvgDocument::by_id(const std::string& id) const {
  const auto found = ids_.find(id);
  return found == ids_.end() ? pugi::xml_node() : found->second;
}

pugi::xml_node SvgDocument::referred(pugi::xml_node n) const {
  const std::string_view target = n.attribute("href") ? n.attribute("href").value() : n.attribute("xlink:href").value();
  return target.starts_with('#') ? by_id(std::string(target.substr(1))) : pugi::xml_node();
}

std::optional<double> SvgDocument::length_of(std::string_view text, double whole) {
  Scanner scan(text);
  const auto value = scan.number();
  if (!value) return {};
  std::string unit;
  while (!scan.at_end()) unit += scan.next();
  unit = std::string(trimmed(unit));
  static constexpr std::pair<const char*, double> kUnits[] = {{"", 1},    {"px", 1},         {"pt", 96.0 / 72}, {"pc", 16},
                                                              {"in", 96}, {"cm", 96 / 2.54}, {"mm", 9.6 / 2.54}};
  for (const auto& [known, scale] : kUnits)
    if (unit == known) return *value * scale;
  if (unit == "%") return *value / 100 * whole;
  return {};
}
double SvgDocument::length_attribute(pugi::xml_node n, const char* attribute, double whole, double otherwise) const {
  if (!n.attribute(attribute)) return otherwise;
  const auto v = length_of(n.attribute(attribute).value(), whole);
  if (!v)
    fail(n, std::string(attribute) + "=\"" + n.attribute(attribute).value() + "\" is not a length",
         "write a number, with px, pt, mm, cm, in or %");
  return *v;
}

std::optional<std::string> SvgDocument::property(pugi::xml_node n, const char* key) const {
  if (n.attribute("style")) {
    auto declarations = parse_declarations(n.attribute("style").value());
    if (const auto found = declarations.find(key); found != declarations.end()) return std::move(found->second);
  }
  if (!sheet_.empty())
    if (auto found = sheet_.property(n.name(), n.attribute("id").value(), n.attribute("class").value(), key)) return found;
  if (n.attribute(key)) return std::string(trimmed(n.attribute(key).value()));
  return {};
}

double SvgDocument::number_attribute(pugi::xml_node n, const char* key, double low, const char* hint) const {
  Scanner scan(n.attribute(key).value());
  const auto v = scan.number();
  scan.skip_separators();
  if (!v || !scan.at_end() || *v < low) fail(n, std::string(key) + "=\"" + n.attribute(key).value() + "\" does not do", hint);
  return *v;
}

}  // namespace steradian::plane::svg
