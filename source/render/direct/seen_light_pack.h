// Area lights as packs of points see them: lit or not, with their outlines and irradiance. Each shape has one file in source/shapes.
#pragma once

#include "core/pack.h"
#include "integrals/irradiance.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

STERADIAN_BEGIN_ISA

STERADIAN_INLINE PackVec3 load(const VectorArrays& v, std::size_t i) { return {load(v.x + i), load(v.y + i), load(v.z + i)}; }

using AboutLobe = shapes::AboutLobe<Pack>;

struct SeenLight {
  const PackLight& light;
  std::size_t first;  // the number of the pack's first point, by which pieces are looked up
  PackKernels::mask lit, reversed;

  STERADIAN_INLINE SeenLight(const PackLight& l, const PackVec3& p, std::size_t first_point) : light(l), first(first_point) {
    if (const auto* polygon = std::get_if<packed::FloatPolygon>(&l.shape)) {
      take(shapes::see<Pack>(*polygon, p));
    } else if (const auto* pieces = std::get_if<packed::Pieces>(&l.shape)) {
      lit = PackReal(0.0) < PackReal(first_point < pieces->point_count() ? 1.0 : 0.0);
      reversed = PackReal(1.0) < PackReal(0.0);
    } else
      l.with_round([&](const auto& shape) { take(shapes::see<Pack>(shape, p)); });
  }
  STERADIAN_INLINE integrals::Shading<Pack> shading(const PackVec3& view) const { return {view, lit, reversed}; }

 private:
  STERADIAN_INLINE void take(const shapes::Seen<Pack>& seen) {
    lit = seen.lit;
    reversed = seen.reversed;
  }
};

// Properties of an outline's light that integrate reads (shapes/small_light.h). The elements are in a function of their own, called rarely.
__attribute__((flatten, noinline)) inline PackKernels::LightElements elements_in(const SeenLight& light, const PackKernels::mat3& frame,
                                                                                 const PackVec3& p) {
  if (const auto* polygon = std::get_if<packed::FloatPolygon>(&light.light.shape)) return shapes::elements_in<Pack>(*polygon, frame, p);
  PackKernels::LightElements e;
  light.light.with_round([&](const auto& shape) { e = shapes::elements_in<Pack>(shape, frame, p); });
  return e;
}
STERADIAN_INLINE PackReal deviation2_of(const PackLight& light) {
  if (const auto* polygon = std::get_if<packed::FloatPolygon>(&light.shape)) return shapes::deviation2<Pack>(*polygon);
  PackReal result(0.0);
  light.with_round([&](const auto& shape) { result = shapes::deviation2<Pack>(shape); });
  return result;
}

STERADIAN_INLINE PackReal distance2_of(const PackLight& light, const PackVec3& p) {
  if (const auto* polygon = std::get_if<packed::FloatPolygon>(&light.shape)) return shapes::distance2<Pack>(*polygon, p);
  PackReal result(0.0);
  light.with_round([&](const auto& shape) { result = shapes::distance2<Pack>(shape, p); });
  return result;
}

// The contours of a polygon that no lane sees as small. Elements in the same function would cost a short walk an eighth, by the registers
// that they take. A caller may therefore ask PolygonOutline::may_be_small first, and have a function for each case.
struct PolygonEdges {
  const SeenLight& seen;
  const PackKernels::mat3& frame;
  const PackVec3& p;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    shapes::contours_in<Pack>(polygon(), frame, p).walk(end, add);
  }
  STERADIAN_INLINE const packed::FloatPolygon& polygon() const { return *std::get_if<packed::FloatPolygon>(&seen.light.shape); }
};

// The contours of any polygon.
struct PolygonOutline : PolygonEdges {
  PackKernels::LightElements elements() const { return elements_in(seen, frame, p); }
  STERADIAN_INLINE PackReal deviation2() const { return shapes::deviation2<Pack>(polygon()); }
  STERADIAN_INLINE PackReal distance2() const { return shapes::distance2<Pack>(polygon(), p); }
  STERADIAN_INLINE bool may_be_small(PackReal least_distance2) const {
    return any_lane(seen.lit && distance2() > deviation2() * least_distance2);
  }
};

// The outline of the visible part behind occluders, for each point by itself. Its edges lie above the horizon of the surface's normal.
struct PiecesOutline {
  const SeenLight& seen;
  const PackKernels::mat3& frame;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    PackKernels k;
    const packed::Pieces& pieces = of();
    const std::size_t count = pieces.edge_count(seen.first);
    for (std::size_t i = 0; i < count; ++i) {
      const float* edge = pieces.edge(seen.first, i);
      const auto corner = [&](std::size_t c) { return k.polygon_direction(transform_transposed(frame, vector_at(edge, c))); };
      add(end(corner(0)), end(corner(3)));
    }
  }
  PackKernels::LightElements elements() const {
    const float* e = of().elements(seen.first);
    const auto vector = [&](std::size_t plane) { return transform_transposed(frame, vector_at(e, plane)); };
    return {vector(0), vector(3), vector(6), vector(9)};
  }
  STERADIAN_INLINE PackReal deviation2() const { return load(of().elements(seen.first) + 12 * packed::Pieces::kBlock); }
  STERADIAN_INLINE PackReal distance2() const {
    const PackVec3 to = vector_at(of().elements(seen.first), 0);
    return dot(to, to);
  }

 private:
  STERADIAN_INLINE const packed::Pieces& of() const { return *std::get_if<packed::Pieces>(&seen.light.shape); }
  STERADIAN_INLINE static PackVec3 vector_at(const float* planes, std::size_t plane) {
    constexpr std::size_t kBlock = packed::Pieces::kBlock;
    return {load(planes + plane * kBlock), load(planes + (plane + 1) * kBlock), load(planes + (plane + 2) * kBlock)};
  }
};

// This is a function of its own: inlined, it would take registers from the walks.
__attribute__((flatten, noinline)) inline int fill_round_corners(const PackLight& light, const AboutLobe& lobe,
                                                                 const PackKernels::mat3& frame, const PackVec3& p,
                                                                 shapes::Corners<Pack>& corners) {
  int count = 0;
  light.with_round([&](const auto& shape) { count = shapes::fill_corners<Pack>(shape, lobe, frame, p, corners); });
  return count;
}

// The polygon that stands for a round light under the lobe. It has the area of the light's outline, and its corners gather where the lobe
// is sharp.
struct RoundOutline {
  const SeenLight& seen;
  const PackKernels::mat3& frame;
  const PackVec3& p;
  const AboutLobe& lobe;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    shapes::Corners<Pack> corners;
    const int count = fill_round_corners(seen.light, lobe, frame, p, corners);
    const std::size_t contour[] = {0, static_cast<std::size_t>(count)};
    integrals::walk_contours(corners.data(), contour, 1, end, add);
  }
  PackKernels::LightElements elements() const { return elements_in(seen, frame, p); }
  STERADIAN_INLINE PackReal deviation2() const { return deviation2_of(seen.light); }
  STERADIAN_INLINE PackReal distance2() const { return distance2_of(seen.light, p); }
};

// Any of the three outlines, where one place in the code must serve all.
struct AnyOutline {
  RoundOutline round;

  template <class End, class Add>
  STERADIAN_INLINE void walk(End end, Add add) const {
    if (round.seen.light.is_round())
      round.walk(end, add);
    else if (round.seen.light.is_pieces())
      pieces().walk(end, add);
    else
      PolygonEdges{round.seen, round.frame, round.p}.walk(end, add);
  }
  PackKernels::LightElements elements() const { return is_pieces() ? pieces().elements() : round.elements(); }
  STERADIAN_INLINE PackReal deviation2() const { return is_pieces() ? pieces().deviation2() : round.deviation2(); }
  STERADIAN_INLINE PackReal distance2() const { return is_pieces() ? pieces().distance2() : round.distance2(); }

 private:
  STERADIAN_INLINE bool is_pieces() const { return round.seen.light.is_pieces(); }
  STERADIAN_INLINE PiecesOutline pieces() const { return {round.seen, round.frame}; }
};

// Irradiance vector over pieces. This is a function of its own, so that it takes no registers from the walk along a polygon.
__attribute__((flatten, noinline)) inline PackVec3 irradiance_vector_of_pieces(const SeenLight& light, const PackKernels::mat3& frame) {
  integrals::Irradiance<Pack> integral;
  return integrate(PiecesOutline{light, frame}, light.shading(PackVec3(0.0, 0.0, 1.0)), integral);
}

// Irradiance of radiance 1, in [0, pi], and the irradiance vector in the frame, whose z is that irradiance. They are functions of their
// own: g++ flattens nothing that it reaches through a caller that is itself always inlined. The irradiance alone is an eighth faster than
// the vector.
__attribute__((flatten, noinline)) inline PackReal irradiance_of(const SeenLight& light, const PackKernels::mat3& frame,
                                                                 const PackVec3& p) {
  if (light.light.is_pieces()) return irradiance_vector_of_pieces(light, frame).z;
  if (light.light.is_round()) {
    PackReal e(0.0);
    light.light.with_round([&](const auto& shape) { e = select(light.lit, shapes::irradiance_vector<Pack>(shape, frame, p).z, e); });
    return e;
  }
  integrals::Irradiance<Pack> integral;
  return integrate(PolygonOutline{{light, frame, p}}, light.shading(PackVec3(0.0, 0.0, 1.0)), integral).z;
}

__attribute__((flatten, noinline)) inline PackVec3 irradiance_vector(const SeenLight& light, const PackKernels::mat3& frame,
                                                                     const PackVec3& p) {
  if (light.light.is_pieces()) return irradiance_vector_of_pieces(light, frame);
  if (light.light.is_round()) {
    PackVec3 e(0.0, 0.0, 0.0);
    light.light.with_round([&](const auto& shape) { e = select(light.lit, shapes::irradiance_vector<Pack>(shape, frame, p), e); });
    return e;
  }
  integrals::Irradiance<Pack> integral;
  return integrate(PolygonOutline{{light, frame, p}}, light.shading(PackVec3(0.0, 0.0, 1.0)), integral);
}

// Part of the irradiance that reaches a diffuse lobe under a dielectric's boundary (kernels/lobe/lambert.glsl). view: in the frame.
STERADIAN_INLINE PackReal irradiance_below(const PackVec3& e, const PackVec3& view, const PackReal& loss) {
  return any_lane(loss > PackReal(0.0)) ? PackKernels().lambert_irradiance_below(e, view, loss) : e.z;
}

// The loss at a pack of points from i on; 0 without a boundary.
STERADIAN_INLINE PackReal fresnel_loss(const Points& points, std::size_t i) {
  return points.fresnel_loss != nullptr ? load(points.fresnel_loss + i) : PackReal(0.0);
}

STERADIAN_END_ISA
