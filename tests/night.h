// The size of a test: small by day, full where STERADIAN_NIGHT is set, as `./dev test --all` does. The seeds are the same.
#pragma once

#include <cstdlib>

namespace steradian::test {

inline bool is_night() { return std::getenv("STERADIAN_NIGHT") != nullptr; }

template <class T>
T by_day_or_night(T day, T night) {
  return is_night() ? night : day;
}

}  // namespace steradian::test
