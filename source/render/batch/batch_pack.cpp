#include "render/batch/batch_rows.h"

#include "core/pack_double.h"
#include "integrals/irradiance.h"

STERADIAN_BEGIN_ISA
namespace {

template <class T>
struct Lanes;
template <>
struct Lanes<float> {
  using Pack_ = Pack;
};
template <>
struct Lanes<double> {
  using Pack_ = PackD;
};
template <class T>
using PackOf = typename Lanes<T>::Pack_;

template <class T>
STERADIAN_INLINE Real<PackOf<T>> load_pack(const T* p) {
  return Real<PackOf<T>>::of(PackOf<T>::load_unaligned(p));
}
template <class T>
STERADIAN_INLINE Vec3<Real<PackOf<T>>> load_pack(const Columns<T>& v, std::size_t i) {
  return {load_pack(v.x.data() + i), load_pack(v.y.data() + i), load_pack(v.z.data() + i)};
}
template <class T>
STERADIAN_INLINE void store_pack(T* p, Real<PackOf<T>> x) {
  x.v.store_unaligned(p);
}

// Steps known at compile time become shuffles.
template <class T>
STERADIAN_INLINE void load_steps(const T* first, std::ptrdiff_t row, std::ptrdiff_t column, std::ptrdiff_t count, T* x, T* y, T* z) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    x[i] = first[i * row];
    y[i] = first[i * row + column];
    z[i] = first[i * row + 2 * column];
  }
}

template <class T>
__attribute__((flatten)) void load_rows(const RowsFrom<T>& rows, std::size_t count, Columns<T>& to) {
  T *x = to.x.data(), *y = to.y.data(), *z = to.z.data();
  const auto n = static_cast<std::ptrdiff_t>(count);
  if (rows.row == 3 && rows.column == 1)
    load_steps(rows.first, 3, 1, n, x, y, z);
  else
    load_steps(rows.first, rows.row, rows.column, n, x, y, z);
  for (std::size_t i = count; i % 16 != 0; ++i) {
    x[i] = x[count - 1];
    y[i] = y[count - 1];
    z[i] = z[count - 1];
  }
}

template <class T>
__attribute__((flatten)) void normalize(Columns<T>& vectors, std::size_t count) {
  using R = Real<PackOf<T>>;
  const R shortest(1e-36), longest(1e36), zero(0.0);
  for (std::size_t i = 0; i < count; i += PackOf<T>::size) {
    const auto v = load_pack(vectors, i);
    const R length2 = dot(v, v);
    const R scale = select(length2 > shortest && length2 < longest, inversesqrt(clamp(length2, shortest, longest)), zero);
    store_pack(vectors.x.data() + i, v.x * scale);
    store_pack(vectors.y.data() + i, v.y * scale);
    store_pack(vectors.z.data() + i, v.z * scale);
  }
}

template <class T>
__attribute__((flatten)) std::size_t mark_alone(const Alone<T>& which, const Columns<T>& position, const Columns<T>& normal,
                                                const Columns<T>& view, std::size_t count, std::uint8_t* alone) {
  using R = Real<PackOf<T>>;
  const R reach2(static_cast<double>(which.reach2)), height2(static_cast<double>(which.height2)), zero(0.0);
  const Vec3<R> centroid(static_cast<double>(which.centroid.x), static_cast<double>(which.centroid.y),
                         static_cast<double>(which.centroid.z));
  const Vec3<R> up(static_cast<double>(which.normal.x), static_cast<double>(which.normal.y), static_cast<double>(which.normal.z));
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += PackOf<T>::size) {
    const auto p = load_pack(position, i), n = load_pack(normal, i), v = load_pack(view, i);
    const R zero_if_finite = (p.x + p.y + p.z + n.x + n.y + n.z + v.x + v.y + v.z) * zero;
    auto is_alone = !(zero_if_finite <= zero);
    if (which.of_flat) {
      const auto from = p - centroid;
      const R height = dot(from, up);
      is_alone = is_alone || (dot(from, from) < reach2 && height * height < height2);
    }
    if (!any_lane(is_alone)) {
      for (std::size_t lane = 0; lane < PackOf<T>::size; ++lane) alone[i + lane] = 0;
      continue;
    }
    alignas(64) T mark[PackOf<T>::size];
    store_pack(mark, select(is_alone, R(1.0), zero));
    for (std::size_t lane = 0; lane < PackOf<T>::size; ++lane) {
      alone[i + lane] = mark[lane] > T(0) ? 1 : 0;
      found += alone[i + lane];
    }
  }
  return found;
}

template <class T>
__attribute__((flatten)) void store_rows(const T* plain, Vector3<T> of_plain, const T* fresnel, Vector3<T> of_fresnel,
                                         const Columns<T>& normal, const Columns<T>& view, std::size_t count, T* rows) {
  const T *nx = normal.x.data(), *ny = normal.y.data(), *nz = normal.z.data();
  const T *vx = view.x.data(), *vy = view.y.data(), *vz = view.z.data();
  const T ax = of_plain.x, ay = of_plain.y, az = of_plain.z, bx = of_fresnel.x, by = of_fresnel.y, bz = of_fresnel.z;
  for (std::size_t i = 0; i < count; ++i) {
    const T facing = nx[i] * vx[i] + ny[i] * vy[i] + nz[i] * vz[i];
    const T p = facing > T(0) ? plain[i] : T(0);
    rows[3 * i] = ax * p;
    rows[3 * i + 1] = ay * p;
    rows[3 * i + 2] = az * p;
  }
  if (fresnel == nullptr) return;
  for (std::size_t i = 0; i < count; ++i) {
    const T facing = nx[i] * vx[i] + ny[i] * vy[i] + nz[i] * vz[i];
    const T f = facing > T(0) ? fresnel[i] : T(0);
    rows[3 * i] += bx * f;
    rows[3 * i + 1] += by * f;
    rows[3 * i + 2] += bz * f;
  }
}

// A polygon seen from eight points at once, in double.
struct OutlineD {
  const PreparedPolygon& light;
  const Mat3<Real<PackD>>& frame;
  const Vec3<Real<PackD>>& p;

  using K = Kernels<PackD>;
  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    integrals::walk_contours(
        light.vertices.data(), light.contours.data(), light.contours.size() - 1,
        [&](const Vec3d& v) { return end(K().polygon_direction(transform_transposed(frame, integrals::to_kernel<PackD>(v) - p))); }, add);
  }
  STERADIAN_INLINE Vec3<Real<PackD>> turned(const Vec3d& v) const { return transform_transposed(frame, integrals::to_kernel<PackD>(v)); }
  K::LightElements elements() const {
    const LightQuarters& q = light.quarters;
    const Vec3d area = {light.normal.x * light.area, light.normal.y * light.area, light.normal.z * light.area};
    return {transform_transposed(frame, integrals::to_kernel<PackD>(q.center) - p), turned(q.reach_a), turned(q.reach_b), turned(area)};
  }
  STERADIAN_INLINE Real<PackD> deviation2() const {
    const Vec3d &a = light.quarters.reach_a, &b = light.quarters.reach_b;
    return Real<PackD>((a.x * a.x + a.y * a.y + a.z * a.z + b.x * b.x + b.y * b.y + b.z * b.z) / 2);
  }
  STERADIAN_INLINE Real<PackD> distance2() const {
    const auto to = integrals::to_kernel<PackD>(light.quarters.center) - p;
    return dot(to, to);
  }
};

__attribute__((flatten)) void polygon_irradiance(const PreparedPolygon& light, const Columns<double>& position,
                                                 const Columns<double>& normal, std::size_t count, double* result) {
  using R = Real<PackD>;
  const R zero(0.0);
  const auto centroid = integrals::to_kernel<PackD>(light.centroid), up = integrals::to_kernel<PackD>(light.normal);
  for (std::size_t i = 0; i < count; i += PackD::size) {
    const auto p = load_pack(position, i);
    const R height = dot(p - centroid, up);
    const auto reversed = height < zero;
    const auto lit = light.two_sided ? reversed || height > zero : height > zero;
    const auto frame = Kernels<PackD>().frame_from_normal(load_pack(normal, i));
    integrals::Irradiance<PackD> integral;
    const integrals::Shading<PackD> shading = {Vec3<R>(zero, zero, R(1.0)), lit, reversed};
    store_pack(result + i, integrate(OutlineD{light, frame, p}, shading, integral).z);
  }
}

}  // namespace

const BatchTable& batch_table() {
  static constexpr BatchTable table = {{load_rows<float>, normalize<float>, mark_alone<float>, store_rows<float>},
                                       {load_rows<double>, normalize<double>, mark_alone<double>, store_rows<double>},
                                       polygon_irradiance};
  return table;
}

STERADIAN_END_ISA
