// Edges as seen from sixteen points: which are contours, where they lie, and their parts inside the light's box.
#include <cstring>

#include "shadow/lanes/lanes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;
using K = PackKernels;

// An end of an edge as seen from the lanes.
struct Ends {
  LaneReals x, y, z, cell_x, cell_y;
  std::uint32_t out[4];  // left, right, bottom, top
};

class LaneSight {
 public:
  STERADIAN_INLINE LaneSight(const LaneEdges& edges, const LaneView& view) : edges_(edges), view_(view) {}

  STERADIAN_INLINE PackVec3 place(std::size_t vertex, std::size_t i) const {
    const VectorView& v = edges_.vertices;
    const PackVec3 p = broadcast({v.x[vertex], v.y[vertex], v.z[vertex]});
    if (!view_.turned) return p;
    const PackVec3 d = p - get(view_.origin, i);
    return {dot(get(view_.axes, i), d), dot(get(view_.axes + 3, i), d), dot(get(view_.axes + 6, i), d)};
  }
  STERADIAN_INLINE K::vec2 box(std::size_t i) const { return {get(view_.box_x, i), get(view_.box_y, i)}; }

  // Projects a position; computes its cell and the bits of the four sides that it lies beyond.
  template <class To>
  STERADIAN_INLINE void look(const PackVec3& v, std::size_t i, To& to, std::uint32_t out[4]) const {
    K k;
    const PackVec3 h = k.shadow_project(get(view_.eye, i), get(view_.shift, i), v);
    const K::vec2 b = box(i), cell = k.shadow_cell(h, b, 0.0);
    put(to.x, i, h.x);
    put(to.y, i, h.y);
    put(to.z, i, h.z);
    put(to.cell_x, i, cell.x);
    put(to.cell_y, i, cell.y);
    const PackReal zero(0.0), x = b.x * h.z, y = b.y * h.z;
    out[0] |= bits_of(x + h.x <= zero) << i;
    out[1] |= bits_of(x - h.x <= zero) << i;
    out[2] |= bits_of(y + h.y <= zero) << i;
    out[3] |= bits_of(y - h.y <= zero) << i;
  }

  __attribute__((flatten, noinline)) void see(std::size_t vertex, VertexLanes& to) const {
    std::uint32_t out[4] = {}, above = 0;
    each_pack([&](std::size_t i) {
      const PackVec3 v = place(vertex, i);
      look(v, i, to, out);
      above |= bits_of(v.z >= get(view_.height, i)) << i;
    });
    to.left = narrow(out[0]);
    to.right = narrow(out[1]);
    to.bottom = narrow(out[2]);
    to.top = narrow(out[3]);
    to.above = vertex < edges_.of_light ? narrow(above) : narrow(0);
  }

  // Cuts the edge by the light's plane, in the lanes of `cut`.
  __attribute__((flatten, noinline)) void cut(std::size_t v0, std::size_t v1, std::uint32_t cut, Ends& end) const {
    K k;
    Ends at;
    std::uint32_t out[4] = {};
    each_pack([&](std::size_t i) { look(k.shadow_cut(place(v0, i), place(v1, i), get(view_.height, i)), i, at, out); });
    LaneReals* to[] = {&end.x, &end.y, &end.z, &end.cell_x, &end.cell_y};
    const LaneReals* from[] = {&at.x, &at.y, &at.z, &at.cell_x, &at.cell_y};
    each_pack([&](std::size_t i) {
      for (int c = 0; c < 5; ++c) put(*to[c], i, select(mask_at(cut, i), get(*from[c], i), get(*to[c], i)));
    });
    for (int s = 0; s < 4; ++s) end.out[s] = (end.out[s] & ~cut) | (out[s] & cut);
  }

 private:
  const LaneEdges& edges_;
  const LaneView& view_;
};

STERADIAN_INLINE void take(const VertexLanes& v, Ends& to) {
  each_pack([&](std::size_t i) {
    put(to.x, i, get(v.x, i));
    put(to.y, i, get(v.y, i));
    put(to.z, i, get(v.z, i));
    put(to.cell_x, i, get(v.cell_x, i));
    put(to.cell_y, i, get(v.cell_y, i));
  });
  to.out[0] = v.left;
  to.out[1] = v.right;
  to.out[2] = v.bottom;
  to.out[3] = v.top;
}

// Clips by the box. It relies on `out` for the ends, so that all edges of a vertex agree (clip of edge_arrays.cpp). The cells are in `to`
// already.
__attribute__((flatten, noinline)) void clip(const LaneSight& view, const Ends& a, const Ends& b, SegmentLanes& to) {
  K k;
  std::uint32_t lost = 0, clipped_a = 0, clipped_b = 0, left_a = 0, left_b = 0;
  each_pack([&](std::size_t i) {
    const K::vec2 box = view.box(i);
    const PackVec3 ha(get(a.x, i), get(a.y, i), get(a.z, i)), hb(get(b.x, i), get(b.y, i), get(b.z, i));
    K::ShadowSpan span;
    span.t0 = 0.0;
    span.t1 = 1.0;
    span.sides = {0.0, 0.0};
    const PackReal zero(0.0), one(1.0), half(0.5);
    span.inside = zero < one;
    const auto side = [&](int s, const PackReal& da, const PackReal& db) {
      const auto distance = [&](const Ends& e, const PackReal& d) {
        return select(mask_at(e.out[s], i), min(d, zero), max(d, PackReal(1e-30)));
      };
      span = k.shadow_clip_side(span, distance(a, da), distance(b, db), s + 1.0);
    };
    side(0, box.x * ha.z + ha.x, box.x * hb.z + hb.x);
    side(1, box.x * ha.z - ha.x, box.x * hb.z - hb.x);
    side(2, box.y * ha.z + ha.y, box.y * hb.z + hb.y);
    side(3, box.y * ha.z - ha.y, box.y * hb.z - hb.y);
    const PackMask at_a = span.sides.x > half, at_b = span.sides.y > half;
    // An end inside is not lost if the other lies a rounding beyond its side; otherwise its chain would break.
    lost |= bits_of(!(span.t0 < span.t1) && at_a && at_b) << i;
    clipped_a |= bits_of(at_a) << i;
    clipped_b |= bits_of(at_b) << i;
    left_a |= bits_of(at_a && span.sides.x < PackReal(1.5)) << i;
    left_b |= bits_of(at_b && span.sides.y < PackReal(1.5)) << i;
    const PackVec3 d = hb - ha;
    const K::vec2 start = k.shadow_cell(ha + d * span.t0, box, span.sides.x), end = k.shadow_cell(ha + d * span.t1, box, span.sides.y);
    put(to.ax, i, select(at_a, start.x, get(to.ax, i)));
    put(to.ay, i, select(at_a, start.y, get(to.ay, i)));
    put(to.bx, i, select(at_b, end.x, get(to.bx, i)));
    put(to.by, i, select(at_b, end.y, get(to.by, i)));
  });
  const std::uint32_t present = to.present & ~lost;
  to.present = narrow(present);
  to.clipped_a = narrow((to.clipped_a | clipped_a) & present);
  to.clipped_b = narrow((to.clipped_b | clipped_b) & present);
  to.cut_a = narrow(to.cut_a & ~clipped_a & present);
  to.cut_b = narrow(to.cut_b & ~clipped_b & present);
  to.left_a = narrow(left_a & present);
  to.left_b = narrow(left_b & present);
}

// Computes the weights of an edge of more than two triangles; returns the lanes where they are not 0.
std::uint32_t weigh(const LaneEdges& edges, const LaneEdges::More& more, const std::uint16_t* front, LaneInts& weight) {
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < kPoints; ++lane) {
    std::int32_t w = 0;
    for (std::uint32_t i = more.first; i < more.first + more.count; ++i)
      w -= edges.incidences[i].walks * ((front[edges.incidences[i].plane] >> lane & 1) != 0 ? 1 : -1);
    weight.at[lane] = w;
    if (w != 0) bits |= 1u << lane;
  }
  return bits;
}

STERADIAN_INLINE std::uint32_t beyond_a_side(const std::uint32_t a[4], const std::uint32_t b[4]) {
  return (a[0] & b[0]) | (a[1] & b[1]) | (a[2] & b[2]) | (a[3] & b[3]);
}

// Writes the section of a triangle by the light's plane. It runs from where the triangle's outline leaves the space below the plane to
// where it comes back. Returns false if no lane has one.
bool see_section(const LaneEdges& edges, const LaneView& lane_view, const LaneSight& view, const CrossingTriangle& triangle,
                 const VertexLanes* const corners[3], std::uint32_t front, SegmentLanes& to) {
  std::uint32_t leaving[3], returning[3], leaves = 0, returns = 0;
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t here = corners[c]->above, there = corners[(c + 1) % 3]->above;
    leaving[c] = ~here & there & lane_view.valid;
    returning[c] = here & ~there & lane_view.valid;
    leaves |= leaving[c];
    returns |= returning[c];
  }
  std::uint32_t bits = leaves & returns;
  if (bits == 0) return false;
  Ends a, b;
  take(*corners[0], a);
  take(*corners[0], b);
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t from = triangle.corners[c], with = triangle.corners[(c + 1) % 3];
    const bool in_order = edges.vertex_numbers[from] < edges.vertex_numbers[with];  // all triangles of an edge agree on its cut
    const std::size_t low = in_order ? from : with, high = in_order ? with : from;
    if (leaving[c] != 0) view.cut(low, high, leaving[c], a);
    if (returning[c] != 0) view.cut(low, high, returning[c], b);
  }
  bits &= ~beyond_a_side(a.out, b.out);
  if (bits == 0) return false;
  to.present = to.clipped_a = to.clipped_b = to.cut_a = to.cut_b = narrow(bits);
  to.left_a = to.left_b = 0;
  each_pack([&](std::size_t i) {
    put(to.ax, i, get(a.cell_x, i));
    put(to.ay, i, get(a.cell_y, i));
    put(to.bx, i, get(b.cell_x, i));
    put(to.by, i, get(b.cell_y, i));
    put(to.weight, i, select(mask_at(front, i), PackInt(-1), PackInt(1)));
  });
  if ((bits & (a.out[0] | a.out[1] | a.out[2] | a.out[3] | b.out[0] | b.out[1] | b.out[2] | b.out[3])) != 0) clip(view, a, b, to);
  to.place_a = to.place_b = -1;
  return to.present != 0;
}

// Adds the weight of a section to that of a coincident triangle, in the lanes where both have the same ends. Two segments with the same
// ends could not decide which one lies left of the other.
void merge_twins(SegmentLanes& first, SegmentLanes& second, bool same_direction) {
  const std::uint32_t both = static_cast<std::uint32_t>(first.cut_a) & first.cut_b & second.cut_a & second.cut_b;
  each_pack([&](std::size_t i) {
    const PackInt w = where(mask_at(both, i), get(second.weight, i));
    put(first.weight, i, same_direction ? get(first.weight, i) + w : get(first.weight, i) - w);
  });
  const std::uint32_t nothing = both & lane_bits([&](std::size_t i) { return get(first.weight, i) == PackInt(0); });
  first.present = narrow(first.present & ~nothing);
  second.present = narrow(second.present & ~both);
}

}  // namespace

__attribute__((flatten)) SeenByLanes see_in_lanes(const LaneEdges& edges, const LaneView& view, std::uint16_t* front,
                                                  std::int32_t* place_of, VertexLanes* vertices, SegmentLanes* to) {
  K k;
  for (std::size_t p = 0; p < edges.plane_count; ++p) {
    const PackVec3 normal = broadcast({edges.normals.x[p], edges.normals.y[p], edges.normals.z[p]});
    const PackReal offset = broadcast(edges.offsets[p]);
    front[p] = narrow(lane_bits([&](std::size_t i) { return k.shadow_facing(normal, offset, get(view.at, i)) > PackReal(0.0); }));
  }
  std::memset(place_of, -1, edges.vertex_count * sizeof *place_of);
  const LaneSight by(edges, view);
  std::size_t n = 0, seen = 0, more = 0;
  const auto place = [&](std::int32_t v) {
    if (place_of[v] < 0) {
      by.see(static_cast<std::size_t>(v), vertices[seen]);
      place_of[v] = static_cast<std::int32_t>(seen++);
    }
    return place_of[v];
  };
  LaneInts weights;
  for (std::size_t e = 0; e < edges.edge_count; ++e) {
    const EdgeView& all = edges.edges;
    const bool many = more < edges.more_count && edges.more[more].edge == e;
    std::uint32_t bits = view.valid, heads = 0;
    std::int32_t size = 0;
    if (many) {
      bits &= weigh(edges, edges.more[more++], front, weights);
    } else {
      const float walks0 = all.walks0[e], walks1 = all.walks1[e];
      heads = front[all.plane0[e]];
      if (walks1 != 0) bits &= walks0 == walks1 ? ~(heads ^ front[all.plane1[e]]) : heads ^ front[all.plane1[e]];
      size = static_cast<std::int32_t>(walks0) * (walks1 != 0 ? 2 : 1);
    }
    if (bits == 0) continue;
    const std::int32_t place_a = place(all.v0[e]), place_b = place(all.v1[e]);
    const VertexLanes &v0 = vertices[place_a], &v1 = vertices[place_b];
    // If the plane cuts an edge, its upper end is not tested against the box.
    const std::uint32_t cut_a = v0.above & ~v1.above, cut_b = v1.above & ~v0.above;
    const std::uint32_t out0[4] = {v0.left, v0.right, v0.bottom, v0.top}, out1[4] = {v1.left, v1.right, v1.bottom, v1.top};
    bits &= ~(v0.above & v1.above) & ~(beyond_a_side(out0, out1) & ~(cut_a | cut_b));
    if (bits == 0) continue;
    SegmentLanes& segment = to[n];
    const bool cuts = (bits & (cut_a | cut_b)) != 0;
    const bool clips = (bits & (out0[0] | out0[1] | out0[2] | out0[3] | out1[0] | out1[1] | out1[2] | out1[3])) != 0;
    segment.clipped_a = segment.cut_a = narrow(bits & cut_a);
    segment.clipped_b = segment.cut_b = narrow(bits & cut_b);
    segment.left_a = segment.left_b = 0;
    segment.present = narrow(bits);
    each_pack([&](std::size_t i) {
      put(segment.ax, i, get(v0.cell_x, i));
      put(segment.ay, i, get(v0.cell_y, i));
      put(segment.bx, i, get(v1.cell_x, i));
      put(segment.by, i, get(v1.cell_y, i));
      put(segment.weight, i, many ? get(weights, i) : select(mask_at(heads, i), PackInt(-size), PackInt(size)));
    });
    if (cuts || clips) {
      Ends a, b;
      take(v0, a);
      take(v1, b);
      if (cuts) {
        const auto v = [](std::int32_t i) { return static_cast<std::size_t>(i); };
        by.cut(v(all.v0[e]), v(all.v1[e]), cut_a, a);
        by.cut(v(all.v0[e]), v(all.v1[e]), cut_b, b);
        segment.present = narrow(segment.present & ~beyond_a_side(a.out, b.out));
        each_pack([&](std::size_t i) {
          put(segment.ax, i, get(a.cell_x, i));
          put(segment.ay, i, get(a.cell_y, i));
          put(segment.bx, i, get(b.cell_x, i));
          put(segment.by, i, get(b.cell_y, i));
        });
      }
      clip(by, a, b, segment);
      if (segment.present == 0) continue;
    }
    segment.place_a = place_a;
    segment.place_b = place_b;
    segment.row = static_cast<std::uint32_t>(e);
    ++n;
  }
  const std::size_t sections = n;
  for (std::size_t t = 0; t < edges.crossing_count; ++t) {
    const CrossingTriangle& triangle = edges.crossing[t];
    std::int32_t places[3];
    for (int c = 0; c < 3; ++c) places[c] = place(static_cast<std::int32_t>(triangle.corners[c]));
    const VertexLanes* const corners[3] = {&vertices[places[0]], &vertices[places[1]], &vertices[places[2]]};
    if (!see_section(edges, view, by, triangle, corners, front[triangle.plane], to[n])) continue;
    to[n].row = static_cast<std::uint32_t>(t);
    if (triangle.twin >= 0)
      for (std::size_t s = sections; s < n; ++s)
        if (to[s].row == static_cast<std::uint32_t>(triangle.twin)) merge_twins(to[s], to[n], triangle.same_direction);
    if (to[n].present != 0) ++n;
  }
  return {seen, sections, n - sections};
}

STERADIAN_END_ISA
