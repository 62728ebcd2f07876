// Scenes, pictures and tables.
#include <atomic>
#include <exception>
#include <mutex>

#include "bindings.h"
#include "fit/lobe.h"
#include "steradian/compare.h"
#include "steradian/fit.h"
#include "steradian/load_scene.h"
#include "steradian/picture.h"
#include "steradian/render.h"

namespace steradian::python {
namespace {

using Pixels = py::array_t<float, py::array::c_style | py::array::forcecast>;

Picture picture_of(const Pixels& pixels, const char* name) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 3) throw Error(name, "is no picture", "give an array of shape (height, width, 3) or a path");
  Picture picture(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)));
  std::copy_n(pixels.data(), pixels.size(), picture.pixels.empty() ? nullptr : &picture.pixels.front().x);
  return picture;
}

LoadedScene load(const std::string& path, const py::dict& o) {
  LoadOptions options;
  if (!o["max_lights"].is_none()) options.max_lights = o["max_lights"].cast<int>();
  options.environment = o["environment"].cast<std::string>();
  options.environment_rotation = o["environment_rotation"].cast<double>();
  options.light_units = value_of<LightUnits>(o["light_units"], "light_units");
  options.aspect = o["aspect"].cast<double>();
  for (const py::handle name : o["lights"]) options.lights.push_back(value_of<AddedLight>(name, "lights"));
  options.limits = {o["max_memory"].cast<std::uint64_t>(), o["max_work"].cast<std::uint64_t>()};
  const py::gil_scoped_release free;
  return load_scene(path, options);
}

// ---- The lights as eval's dictionaries ---------------------------------------------------------------------------

py::list list_of(Vec3d v) {
  py::list list;
  list.append(v.x), list.append(v.y), list.append(v.z);
  return list;
}
py::list list_of(const std::vector<Vec3d>& points) {
  py::list list;
  for (const Vec3d& p : points) list.append(list_of(p));
  return list;
}

struct LightKeys {
  py::dict& light;
  void operator()(const Polygon& s) const {
    light["type"] = "polygon";
    light["vertices"] = list_of(s.vertices);
    py::list holes;
    for (const auto& hole : s.holes) holes.append(list_of(hole));
    if (!s.holes.empty()) light["holes"] = holes;
  }
  void operator()(const Ellipse& s) const {
    light["type"] = "disk";
    light["center"] = list_of(s.center), light["x"] = list_of(s.x), light["y"] = list_of(s.y);
  }
  void operator()(const Ellipsoid& s) const {
    light["type"] = "ellipsoid";
    light["center"] = list_of(s.center), light["x"] = list_of(s.x), light["y"] = list_of(s.y), light["z"] = list_of(s.z);
  }
  void tube(Vec3d a, Vec3d b, double radius) const {
    light["type"] = "capsule";
    light["ends"] = list_of(std::vector<Vec3d>{a, b});
    light["radius"] = radius;
  }
  void operator()(const Capsule& s) const { tube(s.end_a, s.end_b, s.radius); }
  void operator()(const Line& s) const { tube(s.end_a, s.end_b, 0); }
};

py::list lights_of(const Scene& scene) {
  py::list lights;
  for (const AreaLight& a : scene.area_lights) {
    py::dict light;
    std::visit(LightKeys{light}, a.shape);
    light["radiance"] = list_of(a.radiance);
    if (a.is_flat()) light["two_sided"] = a.two_sided;
    lights.append(light);
  }
  return lights;
}

template <class T>
std::vector<std::string> names_of(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

// ---- render ------------------------------------------------------------------------------------------------------

// Calls Python now and then from whatever thread; what Python raises there (a KeyboardInterrupt, too) stops the render.
class Watch {
 public:
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}
  void operator()(std::uint64_t done, std::uint64_t total) {
    if (stop) return;
    const py::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_.is_none()) progress_(done, total);
    } catch (...) {
      if (!thrown_) thrown_ = std::current_exception();
      stop = true;
    }
  }
  void raise() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }
  std::atomic<bool> stop = false;

 private:
  py::object progress_;
  std::exception_ptr thrown_;
};

py::tuple render_scene(LoadedScene& loaded, const py::dict& o, const py::object& progress) {
  RenderOptions options;
  const auto number = [&](const char* key, int low) {
    const int value = o[key].cast<int>();
    if (value < low) throw Error(key, "must be at least " + std::to_string(low));
    return value;
  };
  options.width = number("width", 1);
  options.height = number("height", 1);
  options.camera = o["camera"].cast<std::string>();
  options.method = o["method"].cast<std::string>();
  options.table = o["table"].cast<std::string>();
  options.quality = value_of<Quality>(o["quality"], "quality");
  options.shadows = value_of<Shadows>(o["shadows"], "shadows");
  options.terminator = value_of<Terminator>(o["terminator"], "terminator");
  options.lights = value_of<LightSum>(o["lights"], "lights");
  options.light_error = o["light_error"].cast<double>();
  options.background = o["background"].cast<bool>();
  options.aa = number("aa", 1);
  options.spp = number("spp", 1);
  options.target_error = o["target_error"].cast<double>();
  options.indirect.mode = value_of<IndirectMode>(o["indirect"], "indirect");
  options.seed = o["seed"].cast<std::uint64_t>();
  options.threads = number("threads", 0);
  Watch watch(progress);
  options.progress = std::ref(watch);
  options.stop = &watch.stop;
  RenderStats stats;
  Picture picture;
  const bool multiple_scattering = o["multiple_scattering"].cast<bool>();
  {
    const py::gil_scoped_release free;
    loaded.scene.multiple_scattering = multiple_scattering;
    picture = render(loaded.scene, options, &stats);
  }
  watch.raise();
  py::dict told;
  told["method"] = stats.method;
  told["lights"] = stats.lights;
  told["triangles"] = stats.triangles;
  told["threads"] = stats.threads;
  told["light_tree"] = stats.light_tree;
  told["shadow_fallback"] = stats.shadow_fallback;
  told["shadows_estimated"] = stats.shadows_estimated;
  told["shadow_on_host"] = stats.shadow_on_host;
  told["total_ms"] = stats.total_ms;
  py::dict passes;
  for (const PassTime& pass : stats.passes) passes[pass.name.c_str()] = pass.ms;
  told["passes_ms"] = passes;
  told["warnings"] = stats.warnings;
  py::dict layers;
  for (const auto& [name, pixels] : picture.layers) layers[name.c_str()] = array_of(picture.width, picture.height, pixels);
  told["layers"] = layers;
  return py::make_tuple(array_of(picture.width, picture.height, picture.pixels), told);
}

py::dict difference_of(const Pixels& a, const Pixels& b) {
  const Difference d = difference(picture_of(a, "a"), picture_of(b, "b"));
  py::dict result;
  result["rmse"] = d.rmse;
  result["relative_l2"] = d.relative_l2;
  result["max"] = d.max;
  result["mean_ratio"] = d.mean_ratio;
  return result;
}

// ---- fit ---------------------------------------------------------------------------------------------------------

py::tuple fit_table(const std::string& output, const std::string& lobe, const std::string& samples, int size, int threads) {
  const py::gil_scoped_release free;
  const LobeFamily family = samples.empty() ? fit::lobe_family(lobe) : read_lobe_samples(samples).family;
  if (size < 2 || size > 1024) throw Error("size", "must be from 2 to 1024");
  const LobeFit result = fit_lobe_table(family, output, {size, threads, {}});
  const py::gil_scoped_acquire held;
  return py::make_tuple(result.mean_error, result.largest_error);
}

}  // namespace

void add_pictures(py::module_& m) {
  py::class_<LoadedScene>(m, "Scene")
      .def_property_readonly("warnings", [](const LoadedScene& s) { return s.warnings; })
      .def_property_readonly("cameras", [](const LoadedScene& s) { return names_of(s.scene.cameras); })
      .def_property_readonly("materials", [](const LoadedScene& s) { return names_of(s.scene.materials); })
      .def_property_readonly("lights", [](const LoadedScene& s) { return lights_of(s.scene); })
      .def_property_readonly("punctual_light_count", [](const LoadedScene& s) { return s.scene.punctual_lights.size(); })
      .def_property_readonly("triangle_count", [](const LoadedScene& s) { return s.scene.triangle_count(); })
      .def_property_readonly("bounds",
                             [](const LoadedScene& s) { return py::make_tuple(list_of(s.scene.bounds_min), list_of(s.scene.bounds_max)); });
  m.def("load_scene", load);
  m.def("render", render_scene);
  m.def("diff", difference_of);
  m.def("read_picture", [](const std::string& path) {
    const Picture p = read_picture(path);
    return array_of(p.width, p.height, p.pixels);
  });
  m.def("write_picture",
        [](const Pixels& pixels, const std::string& path, float exposure) { write_picture(picture_of(pixels, "pixels"), path, exposure); });
  m.def("auto_exposure", [](const Pixels& pixels) { return auto_exposure(picture_of(pixels, "pixels")); });
  m.def("fit", fit_table);
}

}  // namespace steradian::python
