#include "steradian/batch.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <type_traits>

#include "core/float_mode.h"
#include "integrals/curved_light.h"
#include "integrals/methods.h"
#include "render/batch/batch_rows.h"
#include "render/direct/lobe_packs.h"

namespace steradian {
namespace {

constexpr std::size_t kChunk = kTilePixels;  // points that a thread takes at a time
constexpr std::size_t kPackMultiple = 16;    // multiple for Points::count

// The data that all points of a batch have in common.
struct Question {
  const AreaLight& light;
  const Material& lobe;
  const methods::Row& row;
  RadianceOptions options;
  bool is_polygon;
  PreparedPolygon polygon;  // empty unless the light is a polygon

  Question(const AreaLight& l, const Material& m, const RadianceOptions& o)
      : light(l),
        lobe(m),
        row(methods::resolve(o.method, m, o.precision, o.quality)),
        options(o),
        is_polygon(std::holds_alternative<Polygon>(l.shape) && !l.emission),
        polygon(is_polygon ? prepare_polygon(flat_polygon(l)) : PreparedPolygon{}) {}

  RadianceResult answer(std::size_t i, const ShadingPoint& at) const {
    if (!(dot(at.normal, at.view) > 0)) return methods::nothing(row.method);
    RadianceOptions own = options;
    own.seed += i * 0x2545f4914f6cdd1du;  // an odd number, so that no two points draw the same
    return is_polygon ? row.polygon(polygon, at, lobe, own) : methods::curved_light_answer(light, at, lobe, row, own);
  }
};

template <class T>
Vec3d row_at(const Rows<T>& rows, std::size_t i) {
  return {static_cast<double>(rows.at(i, 0)), static_cast<double>(rows.at(i, 1)), static_cast<double>(rows.at(i, 2))};
}

template <class T>
void put(const RadianceRows<T>& result, std::size_t i, Vec3d radiance, double error) {
  result.radiance[3 * i] = static_cast<T>(radiance.x);
  result.radiance[3 * i + 1] = static_cast<T>(radiance.y);
  result.radiance[3 * i + 2] = static_cast<T>(radiance.z);
  if (result.error != nullptr) result.error[i] = static_cast<T>(error);
}

template <class T>
void answer_point(const Question& question, const PointRows<T>& points, std::size_t i, const RadianceRows<T>& result) {
  const Vec3d p = row_at(points.position, i), n = row_at(points.normal, i), v = row_at(points.view, i);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!is_finite(p) || !is_finite(n) || !is_finite(v)) return put(result, i, {kNone, kNone, kNone}, kNone);
  if (n == Vec3d{} || v == Vec3d{}) return put(result, i, {}, 0);
  const RadianceResult r = question.answer(i, {p, normalized(n), normalized(v)});
  put(result, i, r.radiance, r.bound.value_or(r.standard_error.value_or(0)));
}

// ---- On packs ----------------------------------------------------------------------------------------------------

// A method on packs. A channel is plain times its factor plus fresnel times its own.
struct PackMethod {
  LobePacks::Function run;
  PackLobe lobe;
  LtcPackTables tables;
  Vec3f of_plain, of_fresnel = {};
};

// Returns nothing if a method has no packs for the lobe and the light.
std::optional<PackMethod> pack_method(const Question& q) {
  using methods::Procedure;
  const Material& m = q.lobe;
  const Method by = q.row.method;
  const Procedure procedure = methods::procedure_of(by, m.brdf);
  // Round lights use fewer corners on packs. The methods for comparison answer point by point.
  if (procedure == Procedure::none || procedure == Procedure::ltc_clipless || procedure == Procedure::representative_point ||
      (procedure != Procedure::diffuse && !q.is_polygon) || !methods::has_packs(m))
    return {};
  const auto shines = [&](Vec3d factor) { return static_cast<Vec3f>(q.light.radiance * factor); };
  PackMethod method = {lobe_packs_for(active_simd())[procedure],
                       {m, {by, q.options.quality, q.options.early_stop, q.options.peak_form}},
                       ltc_pack_tables(by, q.options.quality, q.options.table.get()),
                       shines(m.albedo)};
  if (m.brdf == Brdf::lambert) method.of_plain = shines(m.albedo * std::numbers::inv_pi);
  if (m.brdf == Brdf::beckmann || m.brdf == Brdf::blinn_phong) method.of_plain = shines({1, 1, 1});
  if (m.brdf == Brdf::ggx) method.of_plain = shines(m.f0), method.of_fresnel = shines(m.f90 - m.f0);
  return method;
}

// The widths and tangents that all points have in common, in the form that packs read.
struct Widths {
  alignas(64) TilePlane alpha_x, alpha_y;
  TileVector tangent;

  explicit Widths(const Material& m) {
    alpha_x.fill(static_cast<float>(m.alpha_x));
    alpha_y.fill(static_cast<float>(m.alpha_y));
    const auto t = static_cast<Vec3f>(m.tangent);
    tangent.x.fill(t.x);
    tangent.y.fill(t.y);
    tangent.z.fill(t.z);
  }
};

template <class T>
const BatchRowsTable<T>& rows_table() {
  const BatchTable& table = batch_table_for(active_simd());
  if constexpr (std::is_same_v<T, float>)
    return table.in_float;
  else
    return table.in_double;
}

// Unit directions are known to a rounding. If an edge is seen under nearly half a turn, no direction between its ends is left. The
// library's function walks such an edge in two. An edge of half length h is seen under more than 179.2 degrees from within h / 140.
template <class T>
Alone<T> alone_of(const Question& question) {
  Alone<T> alone;
  if (!question.is_polygon || question.polygon.vertices.empty()) return alone;
  double reach = 0;
  for (const Vec3d& v : question.polygon.vertices) reach = std::max(reach, length(v - question.polygon.centroid));
  alone.of_flat = true;
  alone.centroid = static_cast<Vector3<T>>(question.polygon.centroid);
  alone.normal = static_cast<Vector3<T>>(question.polygon.normal);
  alone.reach2 = static_cast<T>(1.02 * reach * reach);
  alone.height2 = static_cast<T>(reach * reach / (140 * 140));
  return alone;
}

// Memory of one thread.
template <class T>
struct BatchScratch {
  Columns<T> position, normal, view;
  alignas(64) std::array<T, kTilePixels + 16> plain, fresnel;
  std::array<std::uint8_t, kTilePixels + 16> alone;
};

// run(position, normal, view, count, plain, fresnel) fills plain, and fresnel where it is not null, for count points.
template <class T>
void answer_chunk(const Question& question, const Alone<T>& which, const PointRows<T>& points, std::size_t first, std::size_t count,
                  const RadianceRows<T>& result, Vector3<T> of_plain, Vector3<T> of_fresnel, const auto& run) {
  thread_local const auto scratch = std::make_unique<BatchScratch<T>>();
  BatchScratch<T>& s = *scratch;
  const BatchRowsTable<T>& table = rows_table<T>();
  const std::size_t padded = (count + kPackMultiple - 1) / kPackMultiple * kPackMultiple;
  const auto from = [&](const Rows<T>& rows) {
    return RowsFrom<T>{rows.first + static_cast<std::ptrdiff_t>(first) * rows.row, rows.row, rows.column};
  };
  const bool along_normal =
      points.view.first == points.normal.first && points.view.row == points.normal.row && points.view.column == points.normal.column;
  Columns<T>& view = along_normal ? s.normal : s.view;
  table.load(from(points.position), count, s.position);
  table.load(from(points.normal), count, s.normal);
  if (!along_normal) table.load(from(points.view), count, view);
  const std::size_t alone = table.mark_alone(which, s.position, s.normal, view, padded, s.alone.data());
  table.normalize(s.normal, padded);
  if (!along_normal) table.normalize(view, padded);
  const bool has_fresnel = of_fresnel != Vector3<T>{};
  run(s.position, s.normal, view, padded, s.plain.data(), has_fresnel ? s.fresnel.data() : nullptr);
  table.store(s.plain.data(), of_plain, has_fresnel ? s.fresnel.data() : nullptr, of_fresnel, s.normal, view, count,
              result.radiance + 3 * first);
  if (result.error != nullptr) std::fill_n(result.error + first, count, T(0));
  for (std::size_t i = 0; alone > 0 && i < count; ++i)
    if (s.alone[i] != 0) answer_point(question, points, first + i, result);
}

VectorArrays arrays(const Columns<float>& v) { return {v.x.data(), v.y.data(), v.z.data()}; }

// Calls work(first, count) for all points, on the given number of threads (0: all cores).
void in_chunks(std::size_t points, int threads, const std::function<void(std::size_t, std::size_t)>& work) {
  const auto chunk = [&](std::size_t c) {
    const FlushDenormals flush;
    work(c * kChunk, std::min(kChunk, points - c * kChunk));
  };
  const std::size_t chunks = (points + kChunk - 1) / kChunk;
  if (chunks <= 1 || threads == 1) {
    for (std::size_t c = 0; c < chunks; ++c) chunk(c);
    return;
  }
  const auto all = [&] { tbb::parallel_for(std::size_t{0}, chunks, chunk); };
  if (threads > 0)
    tbb::task_arena(threads).execute(all);
  else
    all();
}

template <class T>
void answer_points(const Question& question, const PointRows<T>& points, const RadianceRows<T>& result, int threads) {
  in_chunks(points.count, threads, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) answer_point(question, points, i, result);
  });
}

}  // namespace

void radiance(const AreaLight& light, const PointRows<float>& points, const Material& lobe, const RadianceRows<float>& result,
              const BatchOptions& options) {
  RadianceOptions in_float = options.radiance;
  const methods::Row* row = methods::find(in_float.method, lobe, in_float.quality);
  in_float.precision = row == nullptr || row->in_float ? Precision::float_ : Precision::double_;
  const Question question(light, lobe, in_float);
  const std::vector<PackLight> lights = prepare_lights({}, {&light, 1});  // empty if it has no extent or does not shine
  std::optional<PackMethod> method;
  if (!lights.empty() && !light.emission) method = pack_method(question);
  if (!method) return answer_points(question, points, result, options.threads);
  const Widths widths(lobe);
  const Alone<float> alone = alone_of<float>(question);
  method->lobe.tables = &method->tables;
  const auto run = [&](const auto& position, const auto& normal, const auto& view, std::size_t count, float* plain, float* fresnel) {
    const Points some = {
        count, arrays(position), arrays(normal), arrays(view), arrays_of(widths.tangent), widths.alpha_x.data(), widths.alpha_y.data()};
    method->run(lights.front(), some, method->lobe, {plain, fresnel});
  };
  in_chunks(points.count, options.threads, [&](std::size_t first, std::size_t count) {
    answer_chunk(question, alone, points, first, count, result, method->of_plain, method->of_fresnel, run);
  });
}

void radiance(const AreaLight& light, const PointRows<double>& points, const Material& lobe, const RadianceRows<double>& result,
              const BatchOptions& options) {
  RadianceOptions in_double = options.radiance;
  in_double.precision = Precision::double_;
  const Question question(light, lobe, in_double);
  const bool on_packs = lobe.brdf == Brdf::lambert && question.row.method == Method::exact && !question.polygon.vertices.empty();
  if (!on_packs) return answer_points(question, points, result, options.threads);
  const auto irradiance = batch_table_for(active_simd()).polygon_irradiance;
  const Vec3d factor = light.radiance * lobe.albedo * std::numbers::inv_pi;
  const Alone<double> alone = alone_of<double>(question);
  const auto run = [&](const auto& position, const auto& normal, const auto&, std::size_t count, double* plain, double*) {
    irradiance(question.polygon, position, normal, count, plain);
  };
  in_chunks(points.count, options.threads,
            [&](std::size_t first, std::size_t count) { answer_chunk(question, alone, points, first, count, result, factor, {}, run); });
}

}  // namespace steradian
