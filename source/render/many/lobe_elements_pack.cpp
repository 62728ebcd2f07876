#include "render/many/lobe_elements_loop.h"

#include "render/direct/table_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace lights;
using K = PackKernels;
using Mask = K::mask;

// A pack of points and their lobe. Under M^-1, as a map from the world, a lobe is a clamped cosine. An element of the light is transformed
// by this map. It then sends the light given by far_element_vector, along z, and its error bound is the one given there.
struct LobePoints {
  PackVec3 position, normal, row_x, row_y, row_z;  // rows of the map
  PackReal determinant, stretch2, area_stretch;    // stretch2: largest singular value squared; area_stretch: product of the two largest
  PackReal n_a, f_a;
  Mask sees;

  struct Answer {
    PackReal value, error;
    Mask serves;
  };
  STERADIAN_INLINE Answer answer(const SpreadLight& light, const PackReal& allowed) const;

  struct Sum : RadianceSum {
    STERADIAN_INLINE void add(const PackVec3& radiance, const Answer& a) { RadianceSum::add(radiance, a.value, a.error); }
    STERADIAN_INLINE void put(const LobePoints& at, LobeSums& sums, std::size_t i) const {
      add_to(sums.specular, i, value * at.n_a);
      add_to(sums.grazing, i, value * at.f_a);
      add_to(sums.specular_error, i, error * at.n_a);
      add_to(sums.grazing_error, i, error * at.f_a);
    }
  };
};

template <class Decode>
STERADIAN_INLINE LobePoints lobe_points(const Points& points, const LtcPackTables& tables, std::size_t i, Decode decode) {
  K k;
  LobePoints at;
  at.position = vector_at(points.position, i);
  at.normal = vector_at(points.normal, i);
  const PackVec3 v = vector_at(points.view, i);
  const PackReal roughness = sqrt(load(points.alpha_x + i)), c = dot(at.normal, v);
  const auto frame = k.frame_from_normal_and_view(at.normal, v);
  const auto coordinates = k.ltc_coordinates(roughness, c);
  const auto scale = look_up(tables.magnitude.nodes.data(), tables.magnitude.size, coordinates.x, coordinates.y);
  const K::LtcMatrix m = decode(look_up(tables.matrix.nodes.data(), tables.matrix.size, coordinates.x, coordinates.y), roughness,
                                PackVec3(dot(frame.c0, v), PackReal(0.0), c));
  at.n_a = scale.x;
  at.f_a = scale.y;
  at.sees = c > PackReal(0.0) && dot(at.normal, at.normal) > PackReal(0.5);
  at.row_x = frame.c0 * m.xx + frame.c2 * m.xz;
  at.row_y = frame.c1 * m.yy;
  at.row_z = frame.c0 * m.zx + frame.c2 * m.zz;
  const PackReal minor = m.xx * m.zz - m.xz * m.zx, size2 = m.xx * m.xx + m.xz * m.xz + m.zx * m.zx + m.zz * m.zz;
  at.determinant = m.yy * minor;
  // Squared singular values of the 2 x 2 part, and the third one.
  const PackReal root = sqrt(max(size2 * size2 - PackReal(4.0) * minor * minor, PackReal(0.0)));
  const PackReal large2 = PackReal(0.5) * (size2 + root), small2 = PackReal(0.5) * (size2 - root), y2 = m.yy * m.yy;
  at.stretch2 = max(large2, y2);
  at.area_stretch = sqrt(large2 * max(small2, y2));
  return at;
}

// Clamped cosine of an element at r, over pi, for area 1.
STERADIAN_INLINE PackReal element(const LobePoints& at, const SpreadLight& light, const PackVec3& r, const PackReal& side) {
  const PackVec3 y(dot(at.row_x, r), dot(at.row_y, r), dot(at.row_z, r));
  const PackReal inverse2 = PackReal(1.0) / max(dot(y, y), PackReal(1e-30));
  return (max(y.z, PackReal(0.0)) * inverse2) * (max(side * dot(light.normal, r), PackReal(0.0)) * inverse2);
}

STERADIAN_INLINE LobePoints::Answer LobePoints::answer(const SpreadLight& light, const PackReal& allowed) const {
  K k;
  const LobePoints& at = *this;
  const PackReal zero(0.0), one(1.0);
  const PackVec3 r = light.center - at.position;
  const PackReal r2 = max(dot(r, r), PackReal(1e-12));
  const PackVec3 y(dot(at.row_x, r), dot(at.row_y, r), dot(at.row_z, r));
  const PackReal y2 = max(dot(y, y), PackReal(1e-20));

  // Sides of the light's plane, of the real horizon, and of the lobe's own horizon under the map.
  const PackReal facing = dot(light.normal, r), side = light.two_sided ? select(facing > zero, one, PackReal(-1.0)) : PackReal(-1.0);
  const Mask lit = side * facing > zero && at.sees;
  const PackReal slack = PackReal(1e-5) * sqrt(r2), tilt = dot(light.normal, at.normal), up = dot(at.normal, r);
  const PackReal reach = light.radius * sqrt(max(one - tilt * tilt, zero)) + slack;
  const PackReal reach_under = (light.radius + slack) * sqrt(dot(at.row_z, at.row_z));
  const Mask nothing = !lit || up < -reach || y.z<-reach_under, whole = up> reach && y.z > reach_under;

  const PackReal stretch = sqrt(at.stretch2), distance = sqrt(y2) - stretch * (light.spread + slack);
  const PackReal distance2 = max(distance * distance, PackReal(1e-20));
  const PackReal most = PackReal(0.318309886) * at.area_stretch * light.area / distance2;
  const PackReal limit = allowed * PackReal(0.318309886) * light.area / r2;
  const PackReal by_one = most * k.far_error_of_one(at.stretch2 * light.deviation2, distance2);
  const Mask apart = whole && distance > PackReal(1e-4) * sqrt(y2);
  const Mask takes_one = apart && by_one < limit;

  const PackReal scale = PackReal(0.318309886) * at.determinant * light.area;
  Answer a = {select(takes_one, scale * element(at, light, r, side), zero), select(takes_one, by_one, zero), nothing || takes_one};
  if (all_lanes(a.serves)) {
    a.value = select(nothing, zero, a.value);
    a.error = select(nothing, zero, a.error);
    return a;
  }
  const Mask symmetric = PackReal(light.symmetric ? 1.0 : 0.0) > PackReal(0.5);
  const PackReal by_four =
      most * k.far_error_of_four(at.stretch2 * stretch * light.third, at.stretch2 * at.stretch2 * light.fourth, symmetric, distance2);
  const Mask takes_four = apart && by_four < limit;
  a.serves = nothing || takes_one || takes_four;
  if (!all_lanes(a.serves)) return a;
  const PackReal four = element(at, light, r + light.reach_a, side) + element(at, light, r - light.reach_a, side) +
                        element(at, light, r + light.reach_b, side) + element(at, light, r - light.reach_b, side);
  a.value = select(nothing, zero, select(takes_four, PackReal(0.25) * scale * four, a.value));
  a.error = select(nothing, zero, select(takes_four, by_four, a.error));
  return a;
}

template <class Decode>
__attribute__((flatten, noinline)) void add_by(const FarLights& far, const std::uint32_t* numbers, std::size_t count, const Points& points,
                                               const LtcPackTables& tables, float error, LobeSums& sums, std::uint64_t* left,
                                               Decode decode) {
  add_elements_of(far, numbers, count, points, error, sums, left, [&](std::size_t i) { return lobe_points(points, tables, i, decode); });
}

void add(const FarLights& far, const std::uint32_t* numbers, std::size_t count, const Points& points, const LtcPackTables& tables,
         float error, LobeSums& sums, std::uint64_t* left) {
  const auto by = [&](auto decode) { add_by(far, numbers, count, points, tables, error, sums, left, decode); };
  if (tables.compact)
    by([](const K::vec4& e, PackReal roughness, const PackVec3& view) {
      return K{}.ltc_from_compact(e, max(roughness * roughness, PackReal(1.0e-4)), view);
    });
  else
    by([](const K::vec4& t, PackReal, const PackVec3&) { return K{}.ltc_from_classic(t); });
}

}  // namespace

const lights::LobeElements& ltc_elements() {
  static constexpr lights::LobeElements table = {add};
  return table;
}

STERADIAN_END_ISA
