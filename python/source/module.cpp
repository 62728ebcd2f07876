// _core: what the package steradian calls. It takes what the package has checked and shaped; people read the package.
#include "bindings.h"
#include "core/simd.h"
#include "steradian/light_units.h"
#include "steradian/version.h"

namespace {

namespace py = pybind11;

// Raises the package's Error or UsageError with place, problem and hint.
void raise(const char* type, const steradian::Error& e) {
  const py::object exception = py::module_::import("steradian.errors").attr(type)(e.place(), e.problem(), e.hint());
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
}

steradian::LightSystem system_of(const std::string& name) {
  if (const auto system = steradian::light_system_of(name)) return *system;
  throw steradian::Error("system", "'" + name + "' is not known", "gltf, blender, usd, three, mitsuba or pbrt");
}

steradian::EmitterKind kind_of(const std::string& name) {
  if (const auto kind = steradian::emitter_kind_of(name)) return *kind;
  throw steradian::Error("kind", "'" + name + "' is not known", "area, sphere, point, spot or directional");
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
  m.def("light_factor", [](const std::string& system, const std::string& kind, double area) {
    return steradian::light_factor(system_of(system), kind_of(kind), area);
  });
  m.def("is_photometric", [](const std::string& system) { return steradian::is_photometric(system_of(system)); });
  m.def("radiance_from_power", steradian::radiance_from_power);
  m.def("power_from_radiance", steradian::power_from_radiance);
  m.def("intensity_from_power", steradian::intensity_from_power);
  m.def("power_from_intensity", steradian::power_from_intensity);
  m.def("lumens_from_watts", steradian::lumens_from_watts);
  m.def("watts_from_lumens", steradian::watts_from_lumens);
  m.def("ev100_of_camera", steradian::ev100_of_camera);
  m.def("stops_from_ev100", steradian::stops_from_ev100);
  steradian::python::add_integrals(m);
  steradian::python::add_pictures(m);
  steradian::python::add_plane(m);
  steradian::python::add_solve(m);
  steradian::python::add_view_factors(m);
}
