// The shadow of a convex blocker in front of a round light is six half-planes. Their borders are event lines, at which the view of the two
// changes.
//
// Places are relative to the light's centre; K is the blocker, D the light, r its radius. "low" is the clockwise side, as a point in the
// shadow sees it. E(P) = x P.x + y P.y - c, and E > 0 means
//
//   inner_low     K's end is above the light's low tangent         outer_low     K begins below the low tangent
//   inner_high    K's begin is below the high tangent              outer_high    K ends above the high tangent
//   separator     P is on K's side of a line between the two       chord         P is beyond the chord between K's outer contacts
//
// Conclusions, each by a separating or a supporting line:
//   one of the inner two or the separator < 0     K occludes nothing of the light
//   both outer ones and the chord > 0             K occludes the light: the way to it crosses the chord, which lies in K
//   separator, outer_low and chord > 0            K occludes all from the low tangent up to its end, a vertex of the chain end_first ..
//                                                 end_last, counter-clockwise; with outer_high: down to its begin, of begin_first ..
//                                                 begin_last
//
// The functions take numbers of the kernels, Real<double> and packs. Lines are divided by |x| + |y|: over a square of half the side h, E
// lies within h of its value at the centre.
#pragma once

#include "steradian/real.h"

namespace steradian::plane {

template <class R>
struct EventLine {
  R x, y, c;
  STERADIAN_INLINE R at(R px, R py) const { return x * px + y * py - c; }
};

template <class R>
struct EventLines {
  EventLine<R> inner_low, inner_high, separator, outer_low, outer_high, chord;
  R end_first, end_last, begin_first, begin_last;  // vertices
};

template <class R>
STERADIAN_INLINE EventLine<R> event_line(R x, R y, R c) {
  const R scale = R(1.0) / max(abs(x) + abs(y), R(1e-30));
  return {x * scale, y * scale, c * scale};
}

template <class R>
STERADIAN_INLINE EventLine<R> reversed(const EventLine<R>& e) {
  return {-e.x, -e.y, -e.c};
}

namespace events {

// The vertex whose tangent's normal m is furthest along, or against, the direction to K.
template <class R>
struct Extreme {
  R score, index, x, y, mx, my;
  template <class M>
  STERADIAN_INLINE void take(M better, const Extreme& other) {
    score = select(better, other.score, score);
    index = select(better, other.index, index);
    x = select(better, other.x, x);
    y = select(better, other.y, y);
    mx = select(better, other.mx, mx);
    my = select(better, other.my, my);
  }
};

}  // namespace events

// Event lines of a convex polygon or a segment that does not overlap the light: count vertices, counter-clockwise, and the first one again.
// Lanes with fewer vertices repeat it.
template <class R>
STERADIAN_INLINE EventLines<R> convex_event_lines(const R* x, const R* y, int count, R r) {
  R near_x = x[0], near_y = y[0], near2 = x[0] * x[0] + y[0] * y[0];
  for (int k = 0; k < count; ++k) {
    const R ex = x[k + 1] - x[k], ey = y[k + 1] - y[k];
    const R t = clamp(-(x[k] * ex + y[k] * ey) / max(ex * ex + ey * ey, R(1e-30)), R(0.0), R(1.0));
    const R px = x[k] + t * ex, py = y[k] + t * ey, d2 = px * px + py * py;
    const auto nearer = d2 < near2;
    near_x = select(nearer, px, near_x);
    near_y = select(nearer, py, near_y);
    near2 = min(d2, near2);
  }
  const R to_near = inversesqrt(max(near2, R(1e-30))), nx = near_x * to_near, ny = near_y * to_near;
  // The lowest and the highest of the two tangents through a vertex.
  struct Tangents {
    events::Extreme<R> low, high;
  };
  const auto tangents_through = [&](int k) {
    const R inverse = inversesqrt(max(x[k] * x[k] + y[k] * y[k], R(1e-30)));
    const R ux = x[k] * inverse, uy = y[k] * inverse, along = min(r * inverse, R(1.0)), across = sqrt(max(R(1.0) - along * along, R(0.0)));
    const R lx = along * ux - across * uy, ly = along * uy + across * ux, hx = along * ux + across * uy, hy = along * uy - across * ux;
    return Tangents{{nx * lx + ny * ly, R(k), x[k], y[k], lx, ly}, {nx * hx + ny * hy, R(k), x[k], y[k], hx, hy}};
  };
  const Tangents first = tangents_through(0);
  events::Extreme<R> inner_low = first.low, inner_high = first.high, outer_low = first.low, outer_high = first.high;
  for (int k = 1; k < count; ++k) {
    const Tangents t = tangents_through(k);
    inner_low.take(t.low.score > inner_low.score, t.low);
    outer_low.take(t.low.score < outer_low.score, t.low);
    inner_high.take(t.high.score > inner_high.score, t.high);
    outer_high.take(t.high.score < outer_high.score, t.high);
  }
  EventLines<R> lines;
  lines.inner_low = event_line(inner_low.mx, inner_low.my, r);
  lines.inner_high = event_line(inner_high.mx, inner_high.my, r);
  lines.separator = event_line(nx, ny, near2 * to_near);
  lines.outer_low = reversed(event_line(outer_low.mx, outer_low.my, r));
  lines.outer_high = reversed(event_line(outer_high.mx, outer_high.my, r));
  // The chord's line does not meet the light: a point outside of the chord has left one of the outer half-planes.
  R cx = outer_high.y - outer_low.y, cy = outer_low.x - outer_high.x;
  const auto one_vertex = cx * cx + cy * cy <= R(0.0);
  cx = select(one_vertex, outer_low.x, cx);
  cy = select(one_vertex, outer_low.y, cy);
  const R c = cx * outer_low.x + cy * outer_low.y, sign = select(c < R(0.0), R(-1.0), R(1.0));
  lines.chord = event_line(cx * sign, cy * sign, c * sign);
  lines.end_first = inner_low.index;
  lines.end_last = outer_high.index;
  lines.begin_first = outer_low.index;
  lines.begin_last = inner_high.index;
  return lines;
}

// Event lines of a disk of radius s at (x, y), apart from the light. It has no vertices.
template <class R>
STERADIAN_INLINE EventLines<R> round_event_lines(R x, R y, R s, R r) {
  const R inverse = inversesqrt(x * x + y * y), ux = x * inverse, uy = y * inverse, d = (x * x + y * y) * inverse;
  const R inner = min((r + s) * inverse, R(1.0)), outer = (r - s) * inverse;
  const R inner_across = sqrt(max(R(1.0) - inner * inner, R(0.0))), outer_across = sqrt(max(R(1.0) - outer * outer, R(0.0)));
  EventLines<R> lines;
  lines.inner_low = event_line(inner * ux - inner_across * uy, inner * uy + inner_across * ux, r);
  lines.inner_high = event_line(inner * ux + inner_across * uy, inner * uy - inner_across * ux, r);
  lines.separator = event_line(ux, uy, R(0.5) * (d - s + r));
  lines.outer_low = reversed(event_line(outer * ux - outer_across * uy, outer * uy + outer_across * ux, r));
  lines.outer_high = reversed(event_line(outer * ux + outer_across * uy, outer * uy - outer_across * ux, r));
  lines.chord = event_line(ux, uy, d + s * outer);
  lines.end_first = lines.end_last = lines.begin_first = lines.begin_last = R(0.0);
  return lines;
}

}  // namespace steradian::plane
