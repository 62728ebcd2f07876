// Arrays of points in, arrays of answers out. What is asked comes as the JSON of `steradian eval`, without its points.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "bindings.h"
#include "eval/answer.h"
#include "integrals/point_light.h"
#include "steradian/batch.h"

namespace steradian::python {
namespace {

template <class T>
using Array = py::array_t<T, 0>;

template <class T>
Rows<T> rows_of(const Array<T>& a) {
  constexpr auto kSize = static_cast<py::ssize_t>(sizeof(T));
  return {a.data(), a.strides(0) / kSize, a.strides(1) / kSize};
}

eval::Query query_of(const std::string& json) {
  eval::QueryReader reader;
  std::string padded = json;
  padded.resize(json.size() + eval::kQueryPadding);
  return reader.read({padded.data(), json.size()});
}

template <class T>
struct Answers {
  Array<T> radiance, error;  // N x 3, N
  std::string method;

  explicit Answers(std::size_t n) : radiance({static_cast<py::ssize_t>(n), py::ssize_t{3}}), error(static_cast<py::ssize_t>(n)) {}
};

template <class T>
Vec3d row_at(const Rows<T>& rows, std::size_t i) {
  return {static_cast<double>(rows.at(i, 0)), static_cast<double>(rows.at(i, 1)), static_cast<double>(rows.at(i, 2))};
}

template <class T>
void put(T* to, Vec3d v) {
  to[0] = static_cast<T>(v.x);
  to[1] = static_cast<T>(v.y);
  to[2] = static_cast<T>(v.z);
}

// The query at one point; none where there is no surface or a number is not finite, which `nothing` then tells.
template <class T>
std::optional<eval::Query> at_point(const eval::Query& query, const PointRows<T>& points, std::size_t i, double& nothing) {
  const Vec3d p = row_at(points.position, i), n = row_at(points.normal, i), v = row_at(points.view, i);
  const bool finite = is_finite(p) && is_finite(n) && is_finite(v);
  nothing = finite ? 0 : std::numeric_limits<double>::quiet_NaN();
  if (!finite || n == Vec3d{} || v == Vec3d{}) return {};
  eval::Query q = query;
  q.position = p;
  q.normal = normalized(n);
  q.view = normalized(v);
  q.seed += i * 0x2545f4914f6cdd1du;  // as batch.h
  return q;
}

void each_point(std::size_t count, const auto& use) {
  if (count < 64) {
    for (std::size_t i = 0; i < count; ++i) use(i);
  } else {
    tbb::parallel_for(std::size_t{0}, count, use);
  }
}

// Area lights without occluders are evaluated by the library's batches.
bool serves_batches(const eval::Query& query) {
  if (query.occluders != nullptr) return false;
  for (const eval::Light& light : query.lights)
    if (!std::holds_alternative<AreaLight>(light)) return false;
  return true;
}

template <class T>
void answer_in_batches(const eval::Query& query, const PointRows<T>& points, T* radiance_rows, T* error_rows) {
  BatchOptions options;
  options.radiance = {query.method, query.quality, query.precision, query.spp, query.seed, query.table};
  std::vector<T> radiance_of_one, error_of_one;
  bool first = true;
  for (const eval::Light& light : query.lights) {
    const std::uint64_t seed = options.radiance.seed;
    for (const Material& material : query.materials) {
      if (!first) {
        radiance_of_one.resize(3 * points.count);
        error_of_one.resize(points.count);
      }
      const RadianceRows<T> rows =
          first ? RadianceRows<T>{radiance_rows, error_rows} : RadianceRows<T>{radiance_of_one.data(), error_of_one.data()};
      try {
        radiance(std::get<AreaLight>(light), points, material, rows, options);
      } catch (const Error& e) {
        const bool of_light = e.place().starts_with("vertices") || e.place().starts_with("holes");
        throw of_light ? Error("light." + e.place(), e.problem(), e.hint()) : e;
      }
      if (!first) {
        for (std::size_t i = 0; i < radiance_of_one.size(); ++i) radiance_rows[i] += radiance_of_one[i];
        // Bounds add, standard errors of independent samples by their squares.
        for (std::size_t i = 0; i < points.count; ++i)
          error_rows[i] = query.method == Method::sampled ? std::hypot(error_rows[i], error_of_one[i]) : error_rows[i] + error_of_one[i];
      }
      first = false;
      options.radiance.seed += 0x9e3779b97f4a7c15u;  // as eval/answer.cpp
    }
    options.radiance.seed = seed + 0xd1342543de82ef95u;
  }
}

template <class T>
py::tuple answer(const std::string& json, const Array<T>& position, const Array<T>& normal, const Array<T>& view) {
  eval::Query query = query_of(json);
  query.precision = std::is_same_v<T, float> && query.method != Method::reference && query.method != Method::sampled ? Precision::float_
                                                                                                                     : Precision::double_;
  const auto count = static_cast<std::size_t>(position.shape(0));
  Answers<T> answers(count);
  const PointRows<T> points = {count, rows_of(position), rows_of(normal), rows_of(view)};
  T *radiance_rows = answers.radiance.mutable_data(), *error_rows = answers.error.mutable_data();
  {
    const py::gil_scoped_release free;
    if (serves_batches(query)) {
      answer_in_batches(query, points, radiance_rows, error_rows);
    } else {
      each_point(count, [&](std::size_t i) {
        double nothing = 0;
        const auto q = at_point(query, points, i, nothing);
        eval::Answer a;
        a.radiance = {nothing, nothing, nothing};
        if (q) a = eval::evaluate(*q);
        put(radiance_rows + 3 * i, a.radiance);
        error_rows[i] = static_cast<T>(a.bound.value_or(a.standard_error.value_or(nothing)));
      });
    }
  }
  return py::make_tuple(answers.radiance, answers.error);
}

// Every key of eval's answer with `derivatives`, as an array of a row a point.
template <class T>
py::dict derivatives(const std::string& json, const Array<T>& position, const Array<T>& normal, const Array<T>& view) {
  const eval::Query query = query_of(json);
  const auto count = static_cast<std::size_t>(position.shape(0));
  const PointRows<T> points = {count, rows_of(position), rows_of(normal), rows_of(view)};
  std::vector<std::optional<eval::Answer>> found(count);
  {
    const py::gil_scoped_release free;
    each_point(count, [&](std::size_t i) {
      double nothing = 0;
      if (const auto q = at_point(query, points, i, nothing)) found[i] = eval::evaluate(*q);
    });
  }
  py::dict result;
  using Numbers = std::function<void(const eval::Answer&, T*)>;
  const auto add = [&](const char* key, std::vector<py::ssize_t> shape, const Numbers& numbers) {
    shape.insert(shape.begin(), static_cast<py::ssize_t>(count));
    Array<T> array(shape);
    T* to = array.mutable_data();
    const std::size_t size = count == 0 ? 0 : static_cast<std::size_t>(array.size()) / count;
    std::fill(to, to + array.size(), T(0));
    for (std::size_t i = 0; i < count; ++i)
      if (found[i]) numbers(*found[i], to + i * size);
    result[key] = array;
  };
  add("radiance", {3}, [](const eval::Answer& a, T* to) { put(to, a.radiance); });
  // Every point has the same keys.
  const auto any = std::find_if(found.begin(), found.end(), [](const auto& a) { return a && !a->derivatives.empty(); });
  if (any == found.end()) return result;
  for (std::size_t which = 0; which < (*any)->derivatives.size(); ++which) {
    const eval::Derivative& like = (*any)->derivatives[which];
    const auto count_of_vectors = static_cast<py::ssize_t>(like.values.size());
    std::vector<py::ssize_t> shape = {3};
    if (like.form == eval::Derivative::Form::vectors) shape.push_back(count_of_vectors);
    if (like.form != eval::Derivative::Form::number) shape.push_back(3);
    add(like.key, shape, [which, like](const eval::Answer& a, T* to) {
      const auto& values = a.derivatives[which].values;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < values.size(); ++k) {
          if (like.form == eval::Derivative::Form::number)
            to[c] = static_cast<T>(values[k][c].x);
          else
            put(to + 3 * (c * values.size() + k), values[k][c]);
        }
    });
  }
  return result;
}

}  // namespace

void add_integrals(py::module_& m) {
  m.def("answer", answer<float>);
  m.def("answer", answer<double>);
  m.def("derivatives", derivatives<double>);
}

}  // namespace steradian::python
