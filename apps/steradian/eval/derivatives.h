// Derivatives in `steradian eval`: the key "derivatives" of a query.
#pragma once

#include <array>
#include <vector>

#include "eval/query.h"

namespace steradian::eval {

// A derivative of the radiance by a parameter of the query.
struct Derivative {
  enum class Form { number, vector, vectors };
  const char* key;  // in the answer
  Form form;
  // By channel: of a number in x. One element, but for vectors.
  std::vector<std::array<Vec3d, 3>> values;
};

// Throws Error for methods and lights that have no derivatives.
std::vector<Derivative> derivatives_of(const Query& query);

}  // namespace steradian::eval
