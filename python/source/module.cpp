// _core: what the package steradian calls. It takes what the package has checked and shaped; people read the package.
#include "bindings.h"
#include "core/simd.h"
#include "steradian/version.h"

namespace {

namespace py = pybind11;

// Raises the package's Error or UsageError with place, problem and hint.
void raise(const char* type, const steradian::Error& e) {
  const py::object exception = py::module_::import("steradian.errors").attr(type)(e.place(), e.problem(), e.hint());
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const steradian::UsageError& e) {
      raise("UsageError", e);
    } catch (const steradian::Error& e) {
      raise("Error", e);
    }
  });
  m.attr("version") = steradian::version();
  m.def("simd", [] { return steradian::name_of(steradian::active_simd()); });
  steradian::python::add_integrals(m);
  steradian::python::add_pictures(m);
  steradian::python::add_plane(m);
}
