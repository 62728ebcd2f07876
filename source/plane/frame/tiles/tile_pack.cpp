// The inner loop of a frame: one light on the pixels of one tile. The part that blockers leave visible is integrated in closed form.
#include "plane/frame/tiles/tile_arc.h"
#include "plane/frame/tiles/tile_cut.h"
#include "plane/frame/tiles/tile_disk.h"
#include "plane/frame/tiles/tile_parts.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

STERADIAN_INLINE void add_edge(const TileLight& light, TileBuffer& tile, int i) {
  PackKernels k;
  Axis axis;
  axis.px = load(tile.x + i);
  axis.py = load(tile.y + i);
  // Towards the edge: against its lit normal. t runs along the edge.
  axis.x = broadcast(-light.nx);
  axis.y = broadcast(-light.ny);
  const PackReal d = axis.w(broadcast(light.x) - axis.px, broadcast(light.y) - axis.py);
  const PackReal foot = axis.t(axis.px, axis.py);
  const PackMask lit = d > PackReal(1e-6);
  const PackReal inverse_d = PackReal(1.0) / max(d, PackReal(1e-6));
  Cut cut;
  cut.kept = light.scratch;
  // Fourth powers of slopes stay within float's range.
  if (light.low_corner_count > 0) {
    cut.low = slope_to(light.low_corners[0], axis);
    for (int n = 1; n < light.low_corner_count; ++n) cut.low = min(cut.low, slope_to(light.low_corners[n], axis));
    cut.high = slope_to(light.high_corners[0], axis);
    for (int n = 1; n < light.high_corner_count; ++n) cut.high = max(cut.high, slope_to(light.high_corners[n], axis));
  } else {
    cut.low = clamp((broadcast(light.begin) - foot) * inverse_d, PackReal(-kBeyond), PackReal(kBeyond));
    cut.high = clamp((broadcast(light.end) - foot) * inverse_d, PackReal(-kBeyond), PackReal(kBeyond));
    cut.high = select(lit, cut.high, cut.low);
  }
  if (light.inverse_range > 0.0f && light.low_corner_count == 0) {
    const PackReal q = d * d * broadcast(light.inverse_range * light.inverse_range);
    const PackReal reach = sqrt(max(PackReal(1.0) / max(q, PackReal(1e-30)) - PackReal(1.0), PackReal(0.0)));
    cut.low = max(cut.low, -reach);
    cut.high = min(cut.high, reach);
  }
  const PackReal low = cut.low, high = cut.high;
  if (cut.dark() || !cut_blockers(light, axis, cut)) return;
  if (light.part_count > 0)
    return add_parts(light, tile, i, axis, cut, light.all_parts_seen && cut.count == 0 && all_lanes(cut.low <= low && cut.high >= high));

  PackReal sum(0.0);
  cut.for_each_gap([&](PackReal from, PackReal to) { sum += k.trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to); });
  sum *= PackKernels().inverse_two_pi();
  add(tile.red + i, broadcast(light.red) * sum);
  add(tile.green + i, broadcast(light.green) * sum);
  add(tile.blue + i, broadcast(light.blue) * sum);
}

// The slopes of an arc that face the pixels, by its tangents and ends.
STERADIAN_INLINE void open_arc(const TileLight& light, const UnitPoint& eye, Axis& axis, Cut& cut) {
  const TileArc& arc = light.arc;
  const TangentVectors t(light.shape, eye);
  if (arc.between_tangents) {
    const PackReal p = inversesqrt(max(t.px * t.px + t.py * t.py, PackReal(1e-30))),
                   q = inversesqrt(max(t.qx * t.qx + t.qy * t.qy, PackReal(1e-30)));
    axis.x = t.px * p + t.qx * q;
    axis.y = t.py * p + t.qy * q;
  } else {
    axis.x = broadcast(light.x) - axis.px;
    axis.y = broadcast(light.y) - axis.py;
  }
  cut.low = slope(axis.w(t.px, t.py), axis.t(t.px, t.py), PackReal(-kBeyond));
  cut.high = slope(axis.w(t.qx, t.qy), axis.t(t.qx, t.qy), PackReal(kBeyond));
  PackMask outside = eye.outside2 > PackReal(1e-6);
  if (!arc.whole) {
    // From outside, the near side runs clockwise: the arc's first end is the high one.
    const PackMask first = eye.u * broadcast(arc.u0) + eye.v * broadcast(arc.v0) > PackReal(1.0),
                   last = eye.u * broadcast(arc.u1) + eye.v * broadcast(arc.v1) > PackReal(1.0);
    const PackReal d = sqrt(eye.outside2 + PackReal(1.0)), middle = eye.u * broadcast(arc.um) + eye.v * broadcast(arc.vm);
    cut.high = select(first, min(cut.high, slope_to({arc.x0, arc.y0}, axis)), cut.high);
    cut.low = select(last, max(cut.low, slope_to({arc.x1, arc.y1}, axis)), cut.low);
    outside = outside && (first || last || middle > broadcast(arc.least_cosine) * d);
  }
  cut.high = select(outside, cut.high, cut.low);
}

STERADIAN_INLINE void add_arc(const TileLight& light, TileBuffer& tile, int i) {
  Axis axis;
  axis.px = load(tile.x + i);
  axis.py = load(tile.y + i);
  const UnitPoint eye(light.shape, axis.px, axis.py);
  Cut cut;
  cut.kept = light.scratch;
  open_arc(light, eye, axis, cut);
  if (cut.dark() || !cut_blockers(light, axis, cut)) return;
  EndWeights sum;
  const bool plain = light.profile == 0 && light.inverse_range == 0.0f && !light.linear;
  const ArcIntegrand integrand(light, eye);
  cut.for_each_gap([&](PackReal from, PackReal to) {
    if (plain)
      sum.begin += PackKernels().trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to);
    else
      integrand.add(axis, from, to, sum);
  });
  const PackReal scale = PackKernels().inverse_two_pi(), begin = sum.begin * scale, end = sum.end * scale;
  add(tile.red + i, broadcast(light.red) * begin + broadcast(light.red_end) * end);
  add(tile.green + i, broadcast(light.green) * begin + broadcast(light.green_end) * end);
  add(tile.blue + i, broadcast(light.blue) * begin + broadcast(light.blue_end) * end);
}

// A call of its own: add_light would flatten it once more.
__attribute__((flatten, noinline)) void add_arcs(const TileLight& light, TileBuffer& tile, unsigned blocks) {
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes))
    if ((blocks >> (i / 16) & 1) != 0) add_arc(light, tile, i);
}

__attribute__((flatten)) void add_light(const TileLight& light, TileBuffer& tile, unsigned blocks) {
  if (light.kind == TileKind::arc) {
    add_arcs(light, tile, blocks);
    return;
  }
  const bool edge = light.kind == TileKind::edge;
  if (!edge && light.inverse_range > 0.0f) {
    add_ranged_disk(light, tile, blocks);
    return;
  }
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    if ((blocks >> (i / 16) & 1) == 0) continue;
    if (edge)
      add_edge(light, tile, i);
    else
      add_disk(light, tile, i);
  }
}

void write(const TileBuffer& tile, int width, int height, float* out, std::size_t stride) {
  for (int y = 0; y < height; ++y, out += stride) {
    int x = 0;
#if defined(__SSE2__)
    for (; x + 4 <= width; x += 4) {
      const int i = TileBuffer::slot(x, y);
      const __m128 r = _mm_load_ps(tile.red + i), g = _mm_load_ps(tile.green + i), b = _mm_load_ps(tile.blue + i);
      const __m128 b0r1 = _mm_shuffle_ps(b, r, _MM_SHUFFLE(1, 1, 0, 0)), g1b1 = _mm_shuffle_ps(g, b, _MM_SHUFFLE(1, 1, 1, 1));
      const __m128 b2r3 = _mm_shuffle_ps(b, r, _MM_SHUFFLE(3, 3, 2, 2)), g3b3 = _mm_shuffle_ps(g, b, _MM_SHUFFLE(3, 3, 3, 3));
      _mm_storeu_ps(out + 3 * x, _mm_shuffle_ps(_mm_unpacklo_ps(r, g), b0r1, _MM_SHUFFLE(2, 0, 1, 0)));
      _mm_storeu_ps(out + 3 * x + 4, _mm_shuffle_ps(g1b1, _mm_unpackhi_ps(r, g), _MM_SHUFFLE(1, 0, 2, 0)));
      _mm_storeu_ps(out + 3 * x + 8, _mm_shuffle_ps(b2r3, g3b3, _MM_SHUFFLE(2, 0, 2, 0)));
    }
#elif defined(__aarch64__)
    for (; x + 4 <= width; x += 4) {
      const int i = TileBuffer::slot(x, y);
      vst3q_f32(out + 3 * x, {{vld1q_f32(tile.red + i), vld1q_f32(tile.green + i), vld1q_f32(tile.blue + i)}});
    }
#endif
    for (; x < width; ++x) {
      const int i = TileBuffer::slot(x, y);
      out[3 * x] = tile.red[i];
      out[3 * x + 1] = tile.green[i];
      out[3 * x + 2] = tile.blue[i];
    }
  }
}

}  // namespace

const TileTable& tile_table() {
  static constexpr TileTable table = {add_light, write};
  return table;
}

}  // namespace steradian::plane::STERADIAN_ISA
