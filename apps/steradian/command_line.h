// The running command as it was typed, for statistics.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace steradian::app {

// The arguments joined by spaces; empty if the system does not provide them (/proc exists on Linux only).
inline std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  while (!text.empty() && text.back() == '\0') text.pop_back();
  for (char& c : text)
    if (c == '\0') c = ' ';
  return text;
}

}  // namespace steradian::app
