// The parts of the module _core, a unit each: pybind11 compiles slowly.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "steradian/error.h"
#include "steradian/method.h"
#include "steradian/picture.h"

namespace steradian::python {

namespace py = pybind11;

void add_integrals(py::module_& m);
void add_pictures(py::module_& m);
void add_plane(py::module_& m);

inline Quality quality_of(const std::string& name) {
  if (name == "draft") return Quality::draft;
  if (name == "normal") return Quality::normal;
  if (name == "high") return Quality::high;
  throw Error("quality", "'" + name + "' is not known", "draft, normal or high");
}

// H x W x 3, its own copy.
inline py::array_t<float> array_of(int width, int height, const std::vector<Vec3f>& pixels) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float) && std::is_standard_layout_v<Vec3f>);
  return py::array_t<float>({static_cast<py::ssize_t>(height), static_cast<py::ssize_t>(width), py::ssize_t{3}},
                            pixels.empty() ? nullptr : &pixels.front().x);
}

}  // namespace steradian::python
