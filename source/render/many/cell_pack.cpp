#include "render/many/cell.h"

#include <algorithm>

#include "core/pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace lights;
using K = PackKernels;
using Mask = K::mask;

STERADIAN_INLINE PackVec3 vector_at(const VectorArrays& v, std::size_t i) { return {load(v.x + i), load(v.y + i), load(v.z + i)}; }

// The lights of one pack: consecutive ones, or those with given numbers.
struct Lanes {
  const std::uint32_t* numbers;
  std::size_t first;
  alignas(64) std::array<std::uint32_t, kLanes> some;

  Lanes(const std::uint32_t* n, std::size_t count, std::size_t i) : numbers(n), first(i) {
    if (numbers == nullptr) return;
    for (std::size_t k = 0; k < kLanes; ++k) some[k] = numbers[std::min(i + k, count - 1)];
  }
  STERADIAN_INLINE PackReal operator()(const Plane& plane) const {
    if (numbers == nullptr) return load(plane.data() + first);
    alignas(64) std::array<float, kLanes> values;
    for (std::size_t k = 0; k < kLanes; ++k) values[k] = plane.data()[some[k]];
    return load(values.data());
  }
  STERADIAN_INLINE PackVec3 operator()(const Planes& p) const { return {(*this)(p.x), (*this)(p.y), (*this)(p.z)}; }
};

// Largest value of lambert_grazing_of_sky, at grazing views.
constexpr double kSky = 0.0283;

// Values that all lights of a cell share.
struct CellJudge {
  const ReceiverCell& cell;
  PackReal error;
  PackVec3 center, normal, axis_x, axis_y, axis_z, to_eye;
  PackReal half_x, half_y, half_z, size, rise, turn, magnitude, loss, eye_distance;
  double lebesgue_x, lebesgue_xy, lebesgue_xyz;

  CellJudge(const ReceiverCell& c, float e)
      : cell(c),
        error(broadcast(e)),
        center(broadcast(c.center)),
        normal(broadcast(c.normal)),
        axis_x(broadcast(c.axes[0])),
        axis_y(broadcast(c.axes[1])),
        axis_z(broadcast(c.axes[2])),
        to_eye(broadcast(normalized(c.eye - c.center))),
        half_x(broadcast(c.half.x)),
        half_y(broadcast(c.half.y)),
        half_z(broadcast(c.half.z)),
        size(broadcast(c.radius)),
        rise(broadcast(std::abs(dot(c.axes[0], c.normal)) * c.half.x + std::abs(dot(c.axes[1], c.normal)) * c.half.y +
                       std::abs(dot(c.axes[2], c.normal)) * c.half.z)),
        turn(broadcast(c.turn)),
        magnitude(broadcast(length(c.center) + c.radius)),
        loss(broadcast(c.loss)),
        eye_distance(broadcast(std::max(c.eye_distance, 1e-6f))),
        lebesgue_x(lebesgue(c.grid.count[0])),
        lebesgue_xy(lebesgue_x * lebesgue(c.grid.count[1])),
        lebesgue_xyz(lebesgue_xy * lebesgue(c.grid.count[2])) {}

  // Error bound along the three axes in turn. Lebesgue's constants of the later axes may enlarge the error of the earlier ones.
  template <class Along>
  STERADIAN_INLINE PackReal over_axes(Along along) const {
    return along(cell.grid.count[0], half_x) + PackReal(lebesgue_x) * along(cell.grid.count[1], half_y) +
           PackReal(lebesgue_xy) * along(cell.grid.count[2], half_z);
  }
};

struct Verdict {
  PackReal share, plain, grazing, most;
};

STERADIAN_INLINE PackReal code(Share s) { return PackReal(static_cast<int>(s)); }

STERADIAN_INLINE Verdict judge_pack(const FarLights& far, const Lanes& of, const CellJudge& j) {
  K k;
  const PackReal zero(0.0), one(1.0);
  const PackVec3 d = of(far.center) - j.center, plane = of(far.normal);
  const PackReal d2 = max(dot(d, d), PackReal(1e-12)), inverse = inversesqrt(d2), distance = d2 * inverse;
  const PackReal radius = of(far.radius), area = of(far.area);
  const Mask flat = of(far.is_flat) > PackReal(0.5), two_sided = of(far.two_sided) > PackReal(0.5);
  // Positions are rounded to single precision, and so are the heights below: by some units of 6e-8 of the coordinates.
  const PackReal slack = PackReal(1e-6) * (distance + j.magnitude);

  const auto beyond = [&](const PackVec3& axis, const PackReal& half) { return max(abs(dot(d, axis)) - half, PackReal(0.0)); };
  const PackReal gx = beyond(j.axis_x, j.half_x), gy = beyond(j.axis_y, j.half_y), gz = beyond(j.axis_z, j.half_z);
  const PackReal gap = sqrt(gx * gx + gy * gy + gz * gz) - slack;
  const PackReal near = gap - of(far.spread), r = max(near, PackReal(1e-6)), r2 = r * r;
  const Mask apart = near > PackReal(1e-4) * j.size + PackReal(1e-5) && gap > radius && area > zero;

  // Side from which the receivers see the light.
  const PackReal height = -dot(d, plane);
  const PackReal extent =
      abs(dot(plane, j.axis_x)) * j.half_x + abs(dot(plane, j.axis_y)) * j.half_y + abs(dot(plane, j.axis_z)) * j.half_z;
  const PackReal to_side = extent + slack;
  const Mask in_front = height > to_side, behind = height < -to_side;
  const Mask lit = !flat || in_front || (two_sided && behind), dark = flat && behind && !two_sided;

  // The receivers' horizons.
  const PackReal up = dot(d, j.normal), tilt = dot(plane, j.normal);
  const PackReal support = select(flat, radius * sqrt(max(one - tilt * tilt, zero)) + slack, radius);
  const PackReal band = j.rise + support + j.turn * (distance + j.size + radius) + slack;
  const Mask above = up > band, below = up < -band;

  const PackReal weight = area / r2;
  const PackReal with_one = k.far_error_of_one(of(far.deviation2), r2);
  const PackReal with_four = k.far_error_of_four(of(far.third), of(far.fourth), of(far.symmetric) > PackReal(0.5), r2);
  const PackReal nodes = j.over_axes([&](int n, const PackReal& half) { return k.far_error_of_nodes(n, half, r); });
  const PackReal growth(j.lebesgue_xyz);
  const PackReal rounding = PackReal(kUnit) * (PackReal(kRoundings) + PackReal(kRoundingsOfPlaces) * (distance + j.magnitude) / r);

  // Error of one element of a flat light that the horizon may cut (far_error_across_horizon).
  const PackVec3 reach_a = of(far.reach_a), reach_b = of(far.reach_b);
  const PackReal rise_a = dot(reach_a, j.normal), rise_b = dot(reach_b, j.normal);
  const PackReal deviation = sqrt(of(far.deviation2)),
                 deviation_up = sqrt(PackReal(0.5) * (rise_a * rise_a + rise_b * rise_b)) + j.turn * deviation;
  const PackReal top = max(up + band, zero);
  const PackReal across = k.far_error_across_horizon(top, deviation_up, deviation, r);

  PackReal grazing_nodes(0.0), slope(0.0), sky_nodes(0.0), sky_points(0.0), across_grazing(0.0);
  if (j.cell.loss > 0) {
    // Over the cell and the light, no direction turns further than this. Beyond a right angle there is no bound.
    const PackReal to_light = (j.size + radius) * inverse, to_eye = j.size / j.eye_distance;
    const PackReal angle = dot(d, j.to_eye) * inverse - PackReal(1.4143) * (to_light + to_eye);
    const PackReal least = select(max(to_light, to_eye) < PackReal(0.99), clamp(PackReal(0.5) + PackReal(0.5) * angle, 0.0, 1.0), zero);
    const auto weight_of = k.far_grazing(sqrt(least));
    grazing_nodes =
        j.over_axes([&](int n, const PackReal& half) { return k.far_error_of_grazing_nodes(n, half, r, j.eye_distance, least); });
    slope = weight_of.x + weight_of.y;
    // Fraction of the sky that the light covers, which the polynomial omits, and its derivative.
    const PackReal covered = weight * PackReal(0.318309886), most = max(PackReal(kSky), weight_of.x);
    sky_nodes = covered * most;
    sky_points = covered * (PackReal(2.0) * most + weight_of.y);
    // The remaining part of the light may lie in any of its directions, within 1.6 radius / R.
    across_grazing =
        across * (weight_of.x + PackReal(2.0) * covered * most) + (top / r) * (PackReal(1.6) * radius / r) * weight_of.y * (one + covered);
  }
  const auto in_polynomial = [&](const PackReal& element) {
    return Vec2<PackReal>(nodes + growth * element, grazing_nodes + growth * element * slope + sky_nodes);
  };
  const auto by_one = in_polynomial(with_one), by_four = in_polynomial(with_four);
  const auto at_points = [&](const PackReal& element) { return Vec2<PackReal>(element, element * (slope + sky_points)); };
  const auto one_at_points = at_points(with_one), four_at_points = at_points(with_four);
  const Mask smooth = apart && lit && above;
  const Mask clear = apart && above;
  // The light sent about the cell's centre, relative to the most possible: faint lights may err by less, down to a fifth.
  const PackReal facing = select(flat, abs(height) * inverse, one);
  const PackReal allowed = j.error * clamp(facing * (up * inverse + j.turn), 0.2, 1.0);
  // The element of a point light is the point itself.
  const Mask is_point = radius <= zero && area > zero;
  Verdict v = {select(is_point, code(Share::one_at_points), code(Share::exact)), zero, zero, zero};
  // The offers run from the most expensive to the cheapest.
  const auto offer = [&](const Mask& possible, const Vec2<PackReal>& e, Share share, const PackReal& most) {
    const Mask takes = possible && e.x + j.loss * e.y < most;
    const bool together = share == Share::one || share == Share::four;
    // Points and balls at the receivers have their rounding there: add_elements.
    const PackReal with_rounding = e.x + (together ? rounding * growth : select(flat, rounding, zero));
    v = {select(takes, code(share), v.share), select(takes, weight * with_rounding, v.plain), select(takes, weight * e.y, v.grazing),
         select(takes, together ? weight : zero, v.most)};
  };
  offer(clear && flat, four_at_points, Share::four_at_points, allowed);
  // Next to a light even a small fraction of the most it can send is much. Lights that a horizon cuts err in one direction: half as much
  // is allowed.
  offer(apart && flat && near > radius, Vec2<PackReal>(across, across_grazing), Share::one_at_points, j.error * PackReal(0.5));
  offer(clear, one_at_points, Share::one_at_points, allowed);
  offer(smooth && flat, by_four, Share::four, allowed);
  offer(smooth, by_one, Share::one, allowed);
  v.share = select(dark || below, code(Share::nothing), v.share);
  return v;
}

__attribute__((flatten)) void judge(const FarLights& far, const std::uint32_t* numbers, std::size_t count, const ReceiverCell& cell,
                                    float error, Judged result) {
  const CellJudge j(cell, error);
  alignas(64) std::array<float, kLanes> share;
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Verdict v = judge_pack(far, Lanes(numbers, count, i), j);
    store(share.data(), v.share);
    for (std::size_t lane = 0; lane < kLanes; ++lane) result.share[i + lane] = static_cast<Share>(static_cast<int>(share[lane]));
    store(result.plain + i, v.plain);
    store(result.grazing + i, v.grazing);
    store(result.most + i, v.most);
  }
}

// (1 - v.h)^5 for a light in the direction r.
STERADIAN_INLINE PackReal grazing_of(const PackVec3& r, const PackVec3& view, const PackReal& inverse) {
  const PackReal x = PackReal(1.0) - sqrt(clamp(PackReal(0.5) + PackReal(0.5) * (dot(r, view) * inverse), 0.0, 1.0));
  const PackReal x2 = x * x;
  return x2 * x2 * x;
}

// Light of an element: a vector along r, and the inverse of r's length.
struct Sent {
  PackVec3 vector;
  PackReal inverse;
};

STERADIAN_INLINE Sent from_flat(const PackVec3& area, const PackVec3& r) {
  const PackReal r2 = max(dot(r, r), PackReal(1e-30)), inverse = inversesqrt(r2), inverse2 = inverse * inverse;
  return {(r * inverse2) * (max(-dot(area, r), PackReal(0.0)) * inverse2), inverse};
}
STERADIAN_INLINE Sent from_ball(const PackReal& area, const PackVec3& r) {
  const PackReal r2 = max(dot(r, r), PackReal(1e-30)), inverse = inversesqrt(r2);
  return {r * (area * inverse * inverse * inverse), inverse};
}
STERADIAN_INLINE Sent from_four(const FourElements& e, const PackVec3& p) {
  const PackVec3 center = broadcast(e.center) - p, a = broadcast(e.reach_a), b = broadcast(e.reach_b), area = broadcast(e.area);
  const PackVec3 sum = from_flat(area, center + a).vector + from_flat(area, center - a).vector + from_flat(area, center + b).vector +
                       from_flat(area, center - b).vector;
  return {sum, inversesqrt(max(dot(sum, sum), PackReal(1e-36)))};
}

// Sums over elements at a pack of nodes.
template <bool with_grazing>
struct ElementSums {
  PackReal plain[kParts], weighted[kParts];

  STERADIAN_INLINE ElementSums() {
    for (std::size_t k = 0; k < kParts; ++k) plain[k] = weighted[k] = PackReal(0.0);
  }
  STERADIAN_INLINE void add(const PackVec3& e, const PackReal& grazing, const Vec3f& radiance) {
    add_three(plain, e, radiance);
    if constexpr (with_grazing) add_three(weighted, e * grazing, radiance);
  }
  // Adds the sums to the nodes from `first` on.
  STERADIAN_INLINE void put(Polynomial& values, std::size_t first) const {
    for (std::size_t k = 0; k < kParts; ++k) {
      put(plain[k], values, first, k);
      if constexpr (with_grazing) put(weighted[k], values, first, kWeighted + k);
    }
  }

 private:
  STERADIAN_INLINE static void add_three(PackReal (&part)[kParts], const PackVec3& e, const Vec3f& radiance) {
    const PackReal r = broadcast(radiance.x), g = broadcast(radiance.y), b = broadcast(radiance.z);
    part[0] = part[0] + r * e.x;
    part[1] = part[1] + r * e.y;
    part[2] = part[2] + r * e.z;
    part[3] = part[3] + g * e.x;
    part[4] = part[4] + g * e.y;
    part[5] = part[5] + g * e.z;
    part[6] = part[6] + b * e.x;
    part[7] = part[7] + b * e.y;
    part[8] = part[8] + b * e.z;
  }
  STERADIAN_INLINE static void put(const PackReal& sum, Polynomial& values, std::size_t first, std::size_t part) {
    alignas(64) std::array<float, kLanes> lanes;
    store(lanes.data(), sum);
    for (std::size_t lane = 0; lane < kLanes; ++lane) values.rows.data()[first + lane][part] += lanes[lane];
  }
};

// Positions of a cell's nodes: kLanes of them from `first` on.
STERADIAN_INLINE PackVec3 node_places(const ReceiverCell& cell, std::size_t first) {
  alignas(64) std::array<std::array<float, kLanes>, 3> along;
  const std::array<const NodeRow*, 3> row = {&node_row(cell.grid.count[0]), &node_row(cell.grid.count[1]), &node_row(cell.grid.count[2])};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::size_t n = first + lane;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto count = static_cast<std::size_t>(cell.grid.count[k]);
      along[k][lane] = row[k]->node[n % count];
      n /= count;
    }
  }
  const auto of = [&](std::size_t k, float half) { return broadcast(cell.axes[k] * half) * load(along[k].data()); };
  return broadcast(cell.center) + of(0, cell.half.x) + of(1, cell.half.y) + of(2, cell.half.z);
}

// Calls add(e) for every element, and next() after each part of them.
template <class List, class Add, class Next>
STERADIAN_INLINE void in_parts(const List& list, const Add& add, const Next& next) {
  for (std::size_t first = 0; first < list.size(); first += kPart) {
    for (std::size_t i = first; i < std::min(first + kPart, list.size()); ++i) add(list[i]);
    next();
  }
}

template <bool with_grazing>
STERADIAN_INLINE void add_to_nodes(const FarElements& elements, const ReceiverCell& cell, Polynomial& values) {
  const PackVec3 eye = broadcast(cell.eye);
  for (std::size_t i = 0; i < cell.grid.size(); i += kLanes) {
    const PackVec3 p = node_places(cell, i);
    const PackVec3 to_eye = eye - p, view = to_eye * inversesqrt(max(dot(to_eye, to_eye), PackReal(1e-30)));
    ElementSums<with_grazing> sums;
    const auto put = [&] {
      sums.put(values, i);
      sums = {};
    };
    const auto add_one = [&](const FarElement& e) {
      const PackVec3 r = broadcast(e.center) - p;
      const Sent sent = from_flat(broadcast(e.area), r);
      sums.add(sent.vector, grazing_of(r, view, sent.inverse), e.radiance);
    };
    const auto add_ball = [&](const FarElement& e) {
      const PackVec3 r = broadcast(e.center) - p;
      const Sent sent = from_ball(broadcast(e.area.x), r);
      sums.add(sent.vector, grazing_of(r, view, sent.inverse), e.radiance);
    };
    const auto add_four = [&](const FourElements& e) {
      const Sent sent = from_four(e, p);
      sums.add(sent.vector, grazing_of(sent.vector, view, sent.inverse), e.radiance);
    };
    in_parts(elements.ones, add_one, put);
    in_parts(elements.balls, add_ball, put);
    in_parts(elements.fours, add_four, put);
  }
}

// Chebyshev's polynomials of a coordinate.
template <class R>
STERADIAN_INLINE void chebyshev(int count, const R& x, R (&t)[8]) {
  t[0] = R(1.0f);
  t[1] = x;
  for (int k = 2; k < count; ++k) t[k] = (x + x) * t[k - 1] - t[k - 2];
}

// Replaces rows along an axis of the grid by sums of them: row i becomes the sum of m[i][j] times row j.
using Matrix = std::array<std::array<float, 8>, 8>;
template <std::size_t width>
STERADIAN_INLINE void combine(std::size_t axis, const NodeGrid& grid, const Matrix& m, Polynomial& p) {
  std::size_t step = 1;
  for (std::size_t k = 0; k < axis; ++k) step *= static_cast<std::size_t>(grid.count[k]);
  const auto n = static_cast<std::size_t>(grid.count[axis]);
  if (n == 1) return;
  for (std::size_t block = 0; block < grid.size(); block += step * n)
    for (std::size_t inner = block; inner < block + step; ++inner)
      for (std::size_t part = 0; part < width; part += kLanes) {
        PackReal in[8];
        for (std::size_t j = 0; j < n; ++j) in[j] = load(p.rows.data()[inner + j * step].data() + part);
        for (std::size_t i = 0; i < n; ++i) {
          PackReal sum = broadcast(m[i][0]) * in[0];
          for (std::size_t j = 1; j < n; ++j) sum = sum + broadcast(m[i][j]) * in[j];
          store(p.rows.data()[inner + i * step].data() + part, sum);
        }
      }
}

STERADIAN_INLINE void copy_rows(const Polynomial& from, std::size_t count, Polynomial& to) {
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t part = 0; part < kRow; part += kLanes) store(to.rows.data()[n].data() + part, load(from.rows.data()[n].data() + part));
}

template <bool with_grazing>
__attribute__((flatten)) void fit_with(const FarElements& elements, const ReceiverCell& cell, const Polynomial* outer,
                                       const ReceiverCell* outer_cell, Polynomial& result) {
  constexpr std::size_t kWidth = with_grazing ? kRow : kWeighted;
  if (outer != nullptr) {
    copy_rows(*outer, cell.grid.size(), result);
    const std::array<float, 3> halves = {outer_cell->half.x, outer_cell->half.y, outer_cell->half.z};
    const std::array<float, 3> inner = {cell.half.x, cell.half.y, cell.half.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float scale = halves[axis] > 0 ? 1 / halves[axis] : 0.0f;
      const float middle = dot(cell.center - outer_cell->center, outer_cell->axes[axis]) * scale;
      const NodeRow& row = node_row(cell.grid.count[axis]);
      Matrix m;
      for (std::size_t i = 0; i < static_cast<std::size_t>(cell.grid.count[axis]); ++i) {
        float t[8];
        chebyshev(cell.grid.count[axis], middle + inner[axis] * scale * row.node[i], t);
        for (std::size_t j = 0; j < 8; ++j) m[i][j] = j < static_cast<std::size_t>(cell.grid.count[axis]) ? t[j] : 0.0f;
      }
      combine<kWidth>(axis, cell.grid, m, result);
    }
  } else {
    for (std::size_t n = 0; n < cell.grid.size(); ++n)
      for (std::size_t part = 0; part < kRow; part += kLanes) store(result.rows.data()[n].data() + part, PackReal(0.0));
  }
  add_to_nodes<with_grazing>(elements, cell, result);
  for (std::size_t axis = 0; axis < 3; ++axis) combine<kWidth>(axis, cell.grid, node_row(cell.grid.count[axis]).to_factors, result);
}

void fit(const FarElements& elements, const ReceiverCell& cell, const Polynomial* outer, const ReceiverCell* outer_cell,
         Polynomial& result) {
  // A part of receivers with losses may have none itself; its polynomial is still the whole one's.
  if (cell.loss > 0 || (outer_cell != nullptr && outer_cell->loss > 0))
    fit_with<true>(elements, cell, outer, outer_cell, result);
  else
    fit_with<false>(elements, cell, outer, outer_cell, result);
}

template <bool with_grazing>
__attribute__((flatten)) void add_polynomial_with(const Polynomial& polynomial, const ReceiverCell& cell, CellReceivers& receivers) {
  const VectorArrays positions = arrays_of(receivers.position), normals = arrays_of(receivers.normal);
  const PackVec3 center = broadcast(cell.center);
  const auto scale = [](float half) { return half > 0 ? 1 / half : 0.0f; };
  const PackVec3 x_axis = broadcast(cell.axes[0] * scale(cell.half.x)), y_axis = broadcast(cell.axes[1] * scale(cell.half.y)),
                 z_axis = broadcast(cell.axes[2] * scale(cell.half.z));
  for (std::size_t i = 0; i < receivers.filled; i += kLanes) {
    const PackVec3 from = vector_at(positions, i) - center;
    PackReal tx[8], ty[8], tz[8];
    const auto inside = [](const PackReal& x) { return clamp(x, PackReal(-1.0), PackReal(1.0)); };
    chebyshev(cell.grid.count[0], inside(dot(from, x_axis)), tx);
    chebyshev(cell.grid.count[1], inside(dot(from, y_axis)), ty);
    chebyshev(cell.grid.count[2], inside(dot(from, z_axis)), tz);
    PackReal plain[kParts], weighted[kParts];
    for (std::size_t k = 0; k < kParts; ++k) plain[k] = weighted[k] = PackReal(0.0);
    std::size_t n = 0;
    for (int c = 0; c < cell.grid.count[2]; ++c)
      for (int b = 0; b < cell.grid.count[1]; ++b) {
        const PackReal yz = ty[b] * tz[c];
        for (int a = 0; a < cell.grid.count[0]; ++a, ++n) {
          const PackReal basis = tx[a] * yz;
          const float* row = polynomial.rows.data()[n].data();
          for (std::size_t k = 0; k < kParts; ++k) {
            plain[k] = plain[k] + broadcast(row[k]) * basis;
            if constexpr (with_grazing) weighted[k] = weighted[k] + broadcast(row[kWeighted + k]) * basis;
          }
        }
      }
    const PackVec3 normal = vector_at(normals, i);
    const PackReal loss = load(receivers.loss.data() + i);
    std::size_t k = 0;
    for (TilePlane* plane : {&receivers.irradiance.x, &receivers.irradiance.y, &receivers.irradiance.z}) {
      PackReal e = dot(PackVec3(plain[k], plain[k + 1], plain[k + 2]), normal);
      if constexpr (with_grazing) e = e - loss * dot(PackVec3(weighted[k], weighted[k + 1], weighted[k + 2]), normal);
      // No light is negative: values below 0 are errors.
      store(plane->data() + i, load(plane->data() + i) + max(e, PackReal(0.0)));
      k += 3;
    }
  }
}

void add_polynomial(const Polynomial& polynomial, const ReceiverCell& cell, CellReceivers& receivers) {
  if (cell.loss > 0)
    add_polynomial_with<true>(polynomial, cell, receivers);
  else
    add_polynomial_with<false>(polynomial, cell, receivers);
}

__attribute__((flatten)) void add_elements(const FarElements& elements, CellReceivers& receivers) {
  K k;
  const Points points = receivers.points();
  for (std::size_t i = 0; i < receivers.filled; i += kLanes) {
    const PackVec3 p = vector_at(points.position, i), n = vector_at(points.normal, i), v = vector_at(points.view, i);
    const PackReal loss = load(points.fresnel_loss + i);
    const bool lossy = any_lane(loss > PackReal(0.0));
    const PackReal sky = k.lambert_grazing_of_sky(dot(n, v));
    PackVec3 total(0.0, 0.0, 0.0), sum(0.0, 0.0, 0.0), rounding(0.0, 0.0, 0.0);
    const auto end_part = [&] {
      total = total + sum;
      sum = PackVec3(0.0, 0.0, 0.0);
    };
    // Like lambert_irradiance_below.
    const auto add = [&](const Sent& sent, const PackVec3& r, const Vec3f& radiance) {
      PackReal e = max(dot(sent.vector, n), PackReal(0.0));
      if (lossy) {
        const PackReal grazing = grazing_of(r, v, sent.inverse), share = min(e * PackReal(0.318309886), PackReal(1.0));
        e = e * (PackReal(1.0) - loss * (grazing + (sky - grazing) * share));
      }
      sum = sum + broadcast(radiance) * e;
    };
    const auto add_one = [&](const FarElement& e) {
      const PackVec3 r = broadcast(e.center) - p;
      add(from_flat(broadcast(e.area), r), r, e.radiance);
    };
    // Points may be as near as they like: their rounding is that of each receiver.
    const auto add_ball = [&](const FarElement& e) {
      const PackVec3 r = broadcast(e.center) - p;
      const Sent sent = from_ball(broadcast(e.area.x), r);
      add(sent, r, e.radiance);
      const PackReal of_places = PackReal(kRoundingsOfPlaces) * broadcast(length(e.center)) * sent.inverse;
      const PackReal most = broadcast(e.area.x) * (sent.inverse * sent.inverse);
      rounding = rounding + broadcast(e.radiance) * (most * (PackReal(kRoundings) + of_places));
    };
    const auto add_four = [&](const FourElements& e) {
      const Sent sent = from_four(e, p);
      add(sent, sent.vector, e.radiance);
    };
    in_parts(elements.ones, add_one, end_part);
    in_parts(elements.balls, add_ball, end_part);
    in_parts(elements.fours, add_four, end_part);
    const auto put = [&](TileVector& to, const PackVec3& by) {
      store(to.x.data() + i, load(to.x.data() + i) + by.x);
      store(to.y.data() + i, load(to.y.data() + i) + by.y);
      store(to.z.data() + i, load(to.z.data() + i) + by.z);
    };
    put(receivers.irradiance, total);
    put(receivers.rounding, rounding * PackReal(kUnit));
  }
}

// The receiver is at least as far away as the light's ball, and as its plane. No light sends more than pi.
__attribute__((flatten)) void add_outline(const FarLights& far, std::uint32_t number, const float* sent, CellReceivers& receivers) {
  const auto at = [number](const Planes& planes) { return Vec3f{planes.x[number], planes.y[number], planes.z[number]}; };
  const Vec3f middle = at(far.center), radiance = at(far.radiance);
  const PackVec3 center = broadcast(middle), normal = broadcast(at(far.normal)), light = broadcast(radiance);
  const PackReal radius = broadcast(far.radius[number]), outline = broadcast(far.outline[number]), places = broadcast(length(middle));
  const bool is_flat = far.is_flat[number] > 0;
  const PackReal of_arithmetic(is_flat && far.lights[number]->is_polygon() ? kRoundings : kRoundingsOfRound);
  const PackReal of_places = PackReal(kRoundingsOfPlaces) * (places + radius);
  // Rounded corners tilt the light's plane; no edge subtends more than pi.
  const PackReal tilt = PackReal(kUnit) * of_places * outline / max(broadcast(far.area[number]), PackReal(1e-30));
  const auto* polygon = std::get_if<packed::FloatPolygon>(&far.lights[number]->shape);
  const PackReal edges(3.14159265 * static_cast<double>(polygon != nullptr ? polygon->vertices.size() : 2));
  for (std::size_t i = 0; i < receivers.filled; i += kLanes) {
    const PackVec3 p = vector_at(arrays_of(receivers.position), i), from = p - center;
    const PackReal height = dot(from, normal), least = max(sqrt(dot(from, from)) - radius, abs(height));
    const PackReal inverse = PackReal(1.0) / max(least, PackReal(1e-9));
    PackReal roundings = of_places * inverse;
    // The plane of a flat light is a band without a side (packed::kRounding2): what the light sends there is missing.
    if (is_flat) {
      const PackReal band2 = PackReal(packed::kRounding2) * (dot(p, p) + places * places) * PackReal(1.01);
      roundings = roundings + select(height * height <= band2, sqrt(band2) * inverse * PackReal(1 / kUnit), PackReal(0.0));
    }
    // Behind its plane and above the horizon, the directions to a one-sided light lie between two planes: their cosines are small.
    PackReal most(3.14159265);
    if (is_flat && !(far.two_sided[number] > 0)) {
      const PackVec3 apart = vector_at(arrays_of(receivers.normal), i) - normal;
      most = min(most, PackReal(6.2831853) * (sqrt(dot(apart, apart)) + tilt));
    }
    const PackReal angle = outline * inverse;
    const PackReal rounding = PackReal(kUnit) * of_arithmetic * min(angle, edges) + min(PackReal(kUnit) * angle * roundings, most);
    const PackReal irradiance = load(sent + i);
    const auto put = [&](TilePlane& to, TilePlane& error, const PackReal& r) {
      store(to.data() + i, load(to.data() + i) + r * irradiance);
      store(error.data() + i, load(error.data() + i) + r * rounding);
    };
    put(receivers.irradiance.x, receivers.rounding.x, light.x);
    put(receivers.irradiance.y, receivers.rounding.y, light.y);
    put(receivers.irradiance.z, receivers.rounding.z, light.z);
  }
}

}  // namespace

const lights::CellTable& cell_table() {
  static constexpr lights::CellTable table = {judge, fit, add_polynomial, add_outline, add_elements};
  return table;
}

STERADIAN_END_ISA
