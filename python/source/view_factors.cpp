// View factors: polygons as arrays in, the lower triangle as arrays out.
#include "steradian/view_factors.h"

#include <array>
#include <cstring>

#include "bindings.h"

namespace steradian::python {
namespace {

using Corners = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<Vec3d> loop_of(const Corners& a) {
  std::vector<Vec3d> loop(static_cast<std::size_t>(a.shape(0)));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    loop[i] = {a.at(row, 0), a.at(row, 1), a.at(row, 2)};
  }
  return loop;
}

template <class T>
py::array_t<T> array_of_list(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

// faces: for each the outline and its holes, all N x 3. obstacles: T x 3 x 3.
py::dict view_factor_arrays(const std::vector<std::vector<Corners>>& faces, const std::vector<std::string>& names, const Corners& obstacles,
                            double eps, bool obstruction) {
  std::vector<ViewFactorFace> list;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    ViewFactorFace face{names[i], loop_of(faces[i][0])};
    for (std::size_t h = 1; h < faces[i].size(); ++h) face.holes.push_back(loop_of(faces[i][h]));
    list.push_back(std::move(face));
  }
  ViewFactorOptions options;
  options.eps = eps;
  options.obstruction = obstruction ? Obstruction::on : Obstruction::off;
  for (py::ssize_t t = 0; t < obstacles.shape(0); ++t) {
    std::array<Vec3d, 3>& corners = options.obstacles.emplace_back();
    for (py::ssize_t c = 0; c < 3; ++c)
      corners[static_cast<std::size_t>(c)] = {obstacles.at(t, c, 0), obstacles.at(t, c, 1), obstacles.at(t, c, 2)};
  }
  ViewFactors f;
  {
    const py::gil_scoped_release release;
    f = view_factors(list, options);
  }
  std::vector<std::int64_t> starts = {0}, columns;
  std::vector<double> values, errors;
  for (const ExchangeBlock& b : f.blocks)
    for (std::size_t r = 0; r < b.rows(); ++r) {
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) {
        columns.push_back(b.columns[k]);
        values.push_back(b.values[k]);
        errors.push_back(static_cast<double>(b.errors[k]));
      }
      starts.push_back(static_cast<std::int64_t>(columns.size()));
    }
  py::dict result;
  result["indptr"] = array_of_list(starts);
  result["indices"] = array_of_list(columns);
  result["data"] = array_of_list(values);
  result["errors"] = array_of_list(errors);
  result["areas"] = array_of_list(f.areas);
  result["row_sums"] = array_of_list(f.row_sums);
  result["row_errors"] = array_of_list(f.row_errors);
  return result;
}

}  // namespace

void add_view_factors(py::module_& m) { m.def("view_factors", view_factor_arrays); }

}  // namespace steradian::python
