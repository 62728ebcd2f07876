// Small texts that the completions share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "options_table.h"

namespace steradian::app {

inline std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// Puts `mark` before each of the characters.
inline std::string escaped(const std::string& text, std::string_view characters, const char* mark) {
  std::string result;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) result += mark;
    result += c;
  }
  return result;
}

// True if the value is a number, so that no name of a file completes it.
inline bool is_number(const OptionRow& option) {
  return option.value == "INT" || option.value == "UINT" || option.value == "FLOAT" || option.value == "SIZE" || option.value == "N" ||
         option.value == "S";
}

}  // namespace steradian::app
