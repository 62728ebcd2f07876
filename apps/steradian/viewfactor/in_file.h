// Errors that name a face alone then name its file as well.
#pragma once

#include <string>

#include "steradian/error.h"

namespace steradian::app {

// Calls a function for the work on a file.
template <class Function>
auto in_file(const std::string& path, Function function) {
  try {
    return function();
  } catch (const UsageError&) {
    throw;
  } catch (const Error& e) {
    if (e.place().starts_with(path)) throw;
    throw Error(e.place().empty() ? path : path + ": " + e.place(), e.problem(), e.hint());
  }
}

}  // namespace steradian::app
