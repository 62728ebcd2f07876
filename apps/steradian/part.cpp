#include "part.h"

#include <cstdio>

#include "verb.h"

namespace steradian::app {

Part part_named(const std::string& text) {
  constexpr int kMost = 1'000'000;
  Part part;
  int used = 0;
  if (text.size() > 15 || std::sscanf(text.c_str(), "%d/%d%n", &part.number, &part.count, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || part.number < 1 || part.number > part.count || part.count > kMost)
    throw WrongOption("--part", "'" + text + "' is not k/n with k from 1 to n");
  return part;
}

}  // namespace steradian::app
