// The parts of the module _core, a unit each: pybind11 compiles slowly.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/words.h"
#include "steradian/error.h"
#include "steradian/picture.h"

namespace steradian::python {

namespace py = pybind11;

void add_integrals(py::module_& m);
void add_pictures(py::module_& m);
void add_plane(py::module_& m);
void add_solve(py::module_& m);
void add_view_factors(py::module_& m);

// The value of a word of core/words.h.
template <class Value>
Value value_of(const py::handle& word, const char* key) {
  const auto name = word.cast<std::string>();
  if (const std::optional<Value> value = words::find<Value>(name)) return *value;
  throw Error(key, "'" + name + "' is not known", words::choices<Value>());
}

// H x W x 3, its own copy.
inline py::array_t<float> array_of(int width, int height, const std::vector<Vec3f>& pixels) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float) && std::is_standard_layout_v<Vec3f>);
  return py::array_t<float>({static_cast<py::ssize_t>(height), static_cast<py::ssize_t>(width), py::ssize_t{3}},
                            pixels.empty() ? nullptr : &pixels.front().x);
}

}  // namespace steradian::python
