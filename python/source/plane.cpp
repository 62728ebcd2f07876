// Light in the plane.
#include <tbb/parallel_for.h>

#include "bindings.h"
#include "steradian/plane.h"

namespace steradian::python {
namespace {

struct World {
  PlaneWorld world;
  std::vector<std::string> ignored;
};

World world_of(PlaneSvg svg) {
  for (const PlaneLeftOut& shapes : svg.left_out)
    if (shapes.is_backdrop()) svg.ignored.push_back(std::string("a backdrop, which ") + words_of(shapes.why));
  svg.ignored.insert(svg.ignored.end(), svg.warnings.begin(), svg.warnings.end());
  return {PlaneWorld(std::move(svg.scene)), std::move(svg.ignored)};
}

py::tuple frame(const World& world, const py::dict& o) {
  PlaneFrameOptions options;
  options.width = o["width"].cast<int>();
  options.height = o["height"].cast<int>();
  options.method = plane_method_from_name(o["method"].cast<std::string>());
  options.sampling = {o["spp"].cast<int>(), o["seed"].cast<std::uint64_t>()};
  options.occluders = value_of<PlaneOccluders>(o["occluders"], "occluders");
  options.aa = o["aa"].cast<int>();
  options.threads = o["threads"].cast<int>();
  Picture picture;
  {
    const py::gil_scoped_release free;
    picture = render_plane(world.world, options);
  }
  py::dict layers;
  for (const auto& [name, pixels] : picture.layers) layers[name.c_str()] = array_of(picture.width, picture.height, pixels);
  return py::make_tuple(array_of(picture.width, picture.height, picture.pixels), layers);
}

using Points = py::array_t<double, py::array::c_style>;

// N x 2 to N x 3 x 3: the mean radiance, and its first moments along x and y.
py::array_t<double> query(const World& world, const Points& points, const std::string& method_name, int spp, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(points.shape(0));
  const PlaneMethod method = plane_method_from_name(method_name);
  py::array_t<double> result({count, std::size_t{3}, std::size_t{3}});
  const double* at = points.data();
  double* to = result.mutable_data();
  const py::gil_scoped_release free;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const PlaneLight light = world.world.query({at[2 * i], at[2 * i + 1]}, method, {spp, seed});
    std::size_t k = 9 * i;
    for (const Vec3d& v : {light.radiance, light.moment_x, light.moment_y})
      for (const double x : {v.x, v.y, v.z}) to[k++] = x;
  });
  return result;
}

}  // namespace

void add_plane(py::module_& m) {
  py::class_<World>(m, "World")
      .def_property_readonly("width", [](const World& w) { return w.world.scene().width; })
      .def_property_readonly("height", [](const World& w) { return w.world.scene().height; })
      .def_property_readonly("body_count", [](const World& w) { return w.world.scene().bodies.size(); })
      .def_property_readonly("ignored", [](const World& w) { return w.ignored; });
  m.def("plane_load", [](const std::string& path) {
    const py::gil_scoped_release free;
    return world_of(load_plane_scene(path));
  });
  m.def("plane_loads", [](const std::string& svg, const std::string& name) {
    const py::gil_scoped_release free;
    return world_of(load_plane_scene_from_text(svg, name));
  });
  m.def("plane_render", frame);
  m.def("plane_query", query);
}

}  // namespace steradian::python
