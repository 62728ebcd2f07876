// The part of CSS that drawings use: rules whose selectors are an element's name, .class, #id, * or element.class.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace steradian::plane::svg {

class StyleSheet {
 public:
  // Adds the text of a <style>; later rules in the file override earlier ones of the same weight.
  void add(std::string_view text);

  // The value of a property of an element by the rules.
  std::optional<std::string> property(std::string_view element, std::string_view id, std::string_view classes, std::string_view key) const;
  bool empty() const { return rules_.empty(); }

  std::set<std::string> unsupported;  // selectors and at-rules that were skipped

 private:
  struct Rule {
    std::string element;  // empty: any
    int weight;           // id 100, class 10, element 1
    std::size_t order;
    std::map<std::string, std::string, std::less<>> declarations;
  };
  void add_rule(std::string_view selector, const std::map<std::string, std::string, std::less<>>& declarations);

  std::map<std::string, std::vector<Rule>, std::less<>> rules_;  // by the key that finds them: "name", ".class", "#id", "*"
  std::size_t count_ = 0;
};

// The declarations of style="..." or of a rule's braces, in their order.
std::map<std::string, std::string, std::less<>> parse_declarations(std::string_view text);

}  // namespace steradian::plane::svg
