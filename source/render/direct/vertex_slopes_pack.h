// Walks along a polygon that compute a lobe's integral and its derivatives by the vertices, on packs.
#pragma once

#include <vector>

#include "integrals/ggx/ggx.h"
#include "integrals/ggx/ltc.h"
#include "integrals/vertex_walk.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace slopes {

using integrals::EndSlopes;
using K = PackKernels;
using FrameSlopes = integrals::PartVectors<PackVec3>;
constexpr int kGgxNodes = 4;  // of an edge: within 3e-4 of the largest derivative

// A polygon about a pack of points. facing: 1, -1 from behind, 0 where it does not shine.
struct PolygonHere {
  const packed::FloatPolygon& polygon;
  const K::mat3& frame;
  const PackVec3& p;
  PackReal facing;

  STERADIAN_INLINE PolygonHere(const SeenLight& seen, const K::mat3& f, const PackVec3& point)
      : polygon(*std::get_if<packed::FloatPolygon>(&seen.light.shape)),
        frame(f),
        p(point),
        facing(select(seen.lit, select(seen.reversed, PackReal(-1.0), PackReal(1.0)), PackReal(0.0))) {}

  struct Corner {
    PackVec3 u;      // unit direction in the frame
    PackReal scale;  // facing over the distance: what takes derivatives by u, which are across it, to those by the vertex
  };
  STERADIAN_INLINE Corner corner(std::size_t i) const {
    const PackVec3 v = transform_transposed(frame, broadcast(polygon.vertices[i]) - p);
    return {K().polygon_direction(v), facing * inversesqrt(max(dot(v, v), PackReal(1e-36)))};
  }
  // take(i, d): the derivative by vertex i, in the frame.
  template <class CornerAt, class Edge, class Take>
  STERADIAN_INLINE void walk(CornerAt corner_at, Edge edge, Take take) const {
    integrals::walk_vertices(polygon.contours.data(), polygon.contours.size() - 1, corner_at, edge, take);
  }
};

STERADIAN_INLINE EndSlopes<PackVec3> by_ends(const K::EdgeSlopes& s, PackReal scale_a, PackReal scale_b) {
  return {s.normal * (s.by_start * scale_a), s.normal * (s.by_end * scale_b)};
}

// Returns the irradiance vector.
template <class Take>
STERADIAN_INLINE PackVec3 walk_irradiance(const PolygonHere& here, PackKernels::mask reversed, Take take) {
  K k;
  auto walk = k.polygon_begin();
  here.walk([&](std::size_t i) { return here.corner(i); },
            [&](const auto& a, const auto& b) {
              const auto part = k.edge_above_horizon(a.u, b.u);
              walk = k.polygon_add_part(walk, part);
              return by_ends(k.polygon_part_slopes(part), a.scale, b.scale);
            },
            take);
  return k.polygon_irradiance_vector(walk, reversed);
}

// Returns the integral of a transformed cosine.
template <class Take>
STERADIAN_INLINE PackReal walk_ltc(const PolygonHere& here, PackKernels::mask reversed, const K::LtcMatrix& m, Take take) {
  K k;
  struct Corner {
    PackVec3 u, under;
    PackReal scale;
  };
  auto walk = k.ltc_begin();
  here.walk(
      [&](std::size_t i) {
        const auto corner = here.corner(i);
        const PackVec3 under = k.ltc_transform(m, corner.u);
        return Corner{corner.u, k.polygon_direction(under), corner.scale * inversesqrt(max(dot(under, under), PackReal(1e-36)))};
      },
      [&](const Corner& a, const Corner& b) {
        const auto part = k.ltc_part(m, a.u, b.u, a.under, b.under);
        const auto lobe_part = k.edge_above_horizon(part.start, part.end);
        walk = k.ltc_close_gap(walk, part);
        walk.lobe = k.polygon_add_part(walk.lobe, lobe_part);
        return by_ends(k.ltc_part_slopes(part, lobe_part), a.scale, b.scale);
      },
      [&](std::size_t i, const PackVec3& d) { take(i, k.ltc_transform_transposed(m, d)); });
  return k.ltc_integral(walk, reversed);
}

// exponent: of the Phong lobe about `axis`.
template <class Take>
STERADIAN_INLINE void walk_phong_slopes(const PolygonHere& here, const PackVec3& axis, double exponent, Take take) {
  K k;
  const PackReal n(exponent);
  const int low = exponent < 7 ? 1 : 0;
  here.walk([&](std::size_t i) { return here.corner(i); },
            [&](const auto& a, const auto& b) {
              return by_ends(k.phong_part_slopes(k.edge_above_horizon(a.u, b.u), axis, n, low), a.scale, b.scale);
            },
            take);
}

// take(i, d): of both parts. arc_of(part): the arc of an edge's part, in walk order.
template <class ArcOf, class Take>
STERADIAN_INLINE void walk_ggx_slopes(const PolygonHere& here, const K::GgxView& view, PackReal smith, ArcOf arc_of, Take take) {
  K k;
  here.walk([&](std::size_t i) { return here.corner(i); },
            [&](const auto& a, const auto& b) {
              const auto part = k.edge_above_horizon(a.u, b.u);
              const auto s = k.ggx_edge_slopes_of_part(view, part, arc_of(part), smith, kGgxNodes, 1);
              const auto by_end = [&](const K::vec2& by, PackReal scale) {
                return FrameSlopes{s.normal * (by.x * scale), s.normal * (by.y * scale)};
              };
              return EndSlopes<FrameSlopes>{by_end(s.by_start, a.scale), by_end(s.by_end, b.scale)};
            },
            take);
}

}  // namespace slopes
STERADIAN_END_ISA
