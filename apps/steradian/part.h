// The option --part k/n: one of n parts of a run, which steradian merge joins.
#pragma once

#include <string>

namespace steradian::app {

struct Part {
  int number = 1;
  int count = 1;
};

// Throws WrongOption for a text that is not k/n.
Part part_named(const std::string& text);

}  // namespace steradian::app
