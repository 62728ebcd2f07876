#include "render/many/lobe_elements_loop.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace lights;
using K = PackKernels;
using Mask = K::mask;

// A pack of points and their isotropic lobe. An element in the light's centroid c sends f k, with the lobe f and the fraction k of the
// sky. Its error is half the mean square distance from c times the largest second derivative of f k along a line over the light.
//
// Let l be the direction to a point of the light at the distance r >= R. Let v be the view, and H = l + v. Let A be the map that divides
// the tangential part of H by alpha. Then f = (|H| / |A H|)^4 G2 / (4 pi alpha^2 v_z). Along a line, l' <= 1 / R and l'' <= 1.155 / R^2.
// The logarithm of |y|^2 has the derivatives 2 y.y' / |y|^2 and 2 (y'.y' + y.y'') / |y|^2 - (2 y.y' / |y|^2)^2. They lie within 2 |y'| /
// |y| and 2 (|y'| / |y|)^2 + 2 |y''| / |y|. Those of log G2 by the height u of l lie within 1 / u and 2 / u^2. So with such bounds d1 and
// d2 of log f, |f''| <= (d1^2 + d2) f. f itself grows by no more than exp(d1 |q - c| / R) <= 1 / (1 - d1 |q - c| / R).
struct GgxPoints {
  PackVec3 position, normal, view;
  PackReal inverse_alpha, alpha2, stretched_view, scale;  // stretched_view: |v| under the map of G2; scale: 1 / (4 pi alpha^2)
  Mask sees, isotropic;

  struct Answer {
    PackReal plain, fresnel, plain_error, fresnel_error;
    Mask serves;
  };
  STERADIAN_INLINE Answer answer(const SpreadLight& light, const PackReal& allowed) const;

  struct Sum {
    RadianceSum plain, fresnel;
    STERADIAN_INLINE void add(const PackVec3& radiance, const Answer& a) {
      plain.add(radiance, a.plain, a.plain_error);
      fresnel.add(radiance, a.fresnel, a.fresnel_error);
    }
    STERADIAN_INLINE void put(const GgxPoints&, LobeSums& sums, std::size_t i) const {
      add_to(sums.specular, i, plain.value);
      add_to(sums.grazing, i, fresnel.value);
      add_to(sums.specular_error, i, plain.error);
      add_to(sums.grazing_error, i, fresnel.error);
    }
  };
};

STERADIAN_INLINE PackReal power5(const PackReal& x) { return x * x * (x * x) * x; }

STERADIAN_INLINE GgxPoints::Answer GgxPoints::answer(const SpreadLight& light, const PackReal& allowed) const {
  const PackReal zero(0.0), one(1.0);
  const PackVec3 r = light.center - position;
  const PackReal r2 = max(dot(r, r), PackReal(1e-12)), inverse = inversesqrt(r2), length = r2 * inverse;

  const PackReal facing = dot(light.normal, r), side = light.two_sided ? select(facing > zero, one, PackReal(-1.0)) : PackReal(-1.0);
  const PackReal front = side * facing, slack = PackReal(1e-5) * length;
  const PackReal tilt = dot(light.normal, normal), up = dot(normal, r);
  const PackReal reach = light.radius * sqrt(max(one - tilt * tilt, zero)) + slack;
  const Mask nothing = !(front > zero && sees) || up < -reach;

  // The element's light.
  const PackVec3 l = r * inverse, h = l + view;
  const PackReal h_z = dot(h, normal), h2 = max(dot(h, h), PackReal(1e-12)), l_z = max(up * inverse, PackReal(1e-6));
  const PackVec3 across = h - normal * h_z;
  const PackReal m2 = max(dot(across, across) * inverse_alpha * inverse_alpha + h_z * h_z, PackReal(1e-12));
  const PackReal stretched = sqrt(alpha2 + (one - alpha2) * l_z * l_z), ratio = h2 / m2;
  // G2 / v_z = 2 l_z / (l_z |v|' + v_z |l|').
  const PackReal lobe = scale * ratio * ratio * (PackReal(2.0) * l_z / (l_z * stretched_view + dot(normal, view) * stretched));
  const PackReal h_length = sqrt(h2), x = clamp(one - PackReal(0.5) * h_length, 0.0, 1.0);
  const PackReal sky = light.area * max(front, zero) * (inverse * inverse * inverse);

  // The error bound.
  const PackReal distance = length - light.radius - slack, safe = max(distance, PackReal(1e-3) * length), nearness = one / safe;
  const PackReal turn = light.radius * nearness, low = (up - reach) / (length + light.radius);
  const PackReal m_least = sqrt(m2) - inverse_alpha * turn, h_least = h_length - turn;
  const Mask regular = low > zero && m_least > zero && h_least > zero && distance > safe * PackReal(0.5) && isotropic;
  const PackReal of_m = inverse_alpha / max(m_least, PackReal(1e-3)), of_h = one / max(h_least, PackReal(1e-3)),
                 of_u = one / max(low, PackReal(1e-3));
  const PackReal d1 = PackReal(4.0) * (of_m + of_h) + of_u;
  const auto second = [](const PackReal& y) { return PackReal(4.0) * y * y + PackReal(4.62) * y; };  // for twice log |y|^2
  const PackReal d2 = second(of_m) + second(of_h) + PackReal(2.0) * of_u * of_u + PackReal(1.155) * of_u;
  const PackReal left = one - d1 * turn;
  const PackReal square = d1 * d1 + d2, cosine = front * nearness;
  const PackReal factor =
      PackReal(0.5) * light.deviation2 * light.area * (nearness * nearness) * (nearness * nearness) * lobe / max(left, PackReal(1e-3));
  const PackReal plain_error = factor * (square * cosine + PackReal(4.0) * d1 + PackReal(6.0));
  const PackReal x_most = clamp(one - PackReal(0.5) * h_least, 0.0, 1.0), x3 = x_most * x_most * x_most, x4 = x3 * x_most, x5 = x4 * x_most;
  const PackReal x_first = PackReal(2.5) * x4, x_second = PackReal(5.0) * x3 + x_first * (of_h + PackReal(1.155));
  const PackReal fresnel_error = factor * ((square * x5 + PackReal(2.0) * d1 * x_first + x_second) * cosine +
                                           PackReal(4.0) * (d1 * x5 + x_first) + PackReal(6.0) * x5);

  const PackReal limit = allowed * PackReal(0.318309886) * light.area / r2;
  const Mask takes = regular && left > PackReal(0.05) && plain_error < limit && fresnel_error < limit;
  const PackReal plain = lobe * sky;
  return {select(takes && !nothing, plain, zero), select(takes && !nothing, plain * power5(x), zero),
          select(takes && !nothing, plain_error, zero), select(takes && !nothing, fresnel_error, zero), nothing || takes};
}

STERADIAN_INLINE GgxPoints ggx_points(const Points& points, std::size_t i) {
  GgxPoints at;
  at.position = vector_at(points.position, i);
  at.normal = vector_at(points.normal, i);
  at.view = vector_at(points.view, i);
  const PackReal alpha = load(points.alpha_x + i), v_z = dot(at.normal, at.view);
  at.inverse_alpha = PackReal(1.0) / max(alpha, PackReal(1e-4));
  at.alpha2 = alpha * alpha;
  at.stretched_view = sqrt(at.alpha2 + (PackReal(1.0) - at.alpha2) * v_z * v_z);
  at.scale = PackReal(0.25 * 0.318309886) * at.inverse_alpha * at.inverse_alpha;
  at.sees = v_z > PackReal(0.0) && dot(at.normal, at.normal) > PackReal(0.5);
  at.isotropic = abs(load(points.alpha_y + i) - alpha) <= PackReal(0.0);
  return at;
}

__attribute__((flatten)) void add(const FarLights& far, const std::uint32_t* numbers, std::size_t count, const Points& points,
                                  const LtcPackTables&, float error, LobeSums& sums, std::uint64_t* left) {
  add_elements_of(far, numbers, count, points, error, sums, left, [&](std::size_t i) { return ggx_points(points, i); });
}

}  // namespace

const lights::LobeElements& ggx_elements() {
  static constexpr lights::LobeElements table = {add};
  return table;
}

STERADIAN_END_ISA
