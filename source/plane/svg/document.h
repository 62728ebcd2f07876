// An SVG file as a tree: places of elements, references between them, and readers of attributes.
#pragma once

#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>

#include "plane/svg/style/css.h"
#include "steradian/limits.h"
#include "steradian/vector.h"

namespace steradian::plane::svg {

// The text of a file. Throws Error if it cannot be read, or needs more memory than the limits.
std::string read_text(const std::string& path, const Limits& limits);

class SvgDocument {
 public:
  // Throws Error if the text is not XML or not SVG.
  SvgDocument(std::string text, std::string name);

  pugi::xml_node root() const { return document_.document_element(); }
  std::string place_of(pugi::xml_node n) const;  // file, line and name, for messages
  // The id; without one the element, and its line unless that is the file's only one.
  std::string called(pugi::xml_node n) const;
  [[noreturn]] void fail(pugi::xml_node n, const std::string& problem, const std::string& hint) const;

  // The element that href names; empty if it is not in this file.
  pugi::xml_node referred(pugi::xml_node n) const;
  pugi::xml_node by_id(const std::string& id) const;

  // A property in style="...", else in a <style> of the file, else the attribute of that name.
  std::optional<std::string> property(pugi::xml_node n, const char* key) const;
  // A length: user units, px, or an absolute unit at 96 to the inch; percentages refer to `whole`.
  static std::optional<double> length_of(std::string_view text, double whole);
  double length_attribute(pugi::xml_node n, const char* attribute, double whole, double otherwise = 0) const;
  double number_attribute(pugi::xml_node n, const char* key, double low, const char* hint) const;

  std::set<std::string> ignored;  // features that are not supported

 private:
  std::string place(std::ptrdiff_t offset) const;
  std::ptrdiff_t line(std::ptrdiff_t offset) const;

  std::string text_, name_;
  pugi::xml_document document_;
  std::map<std::string, pugi::xml_node> ids_;
  StyleSheet sheet_;
};

}  // namespace steradian::plane::svg
