#include "core/pack_bits.h"
#include "shadow/lanes/packs.h"
#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;
using K = PackKernels;
using IntPack = xsimd::batch<std::int32_t, PackArch>;
using PackMask = PackKernels::mask;

STERADIAN_INLINE PackVec3 load_vector(const VectorView& v, std::size_t i) { return {load(v.x + i), load(v.y + i), load(v.z + i)}; }
STERADIAN_INLINE void store_vector(const VectorSpan& v, std::size_t i, const PackVec3& a) {
  store(v.x + i, a.x);
  store(v.y + i, a.y);
  store(v.z + i, a.z);
}
STERADIAN_INLINE PackReal gather(const float* from, const IntPack& at) { return PackReal::of(Pack::gather(from, at)); }
STERADIAN_INLINE PackVec3 gather(const VectorView& v, const IntPack& at) { return {gather(v.x, at), gather(v.y, at), gather(v.z, at)}; }

__attribute__((flatten)) void turn(const VectorView& from, std::size_t count, const float axes[9], const float origin[3],
                                   const VectorSpan& to) {
  const PackVec3 x = broadcast({axes[0], axes[1], axes[2]}), y = broadcast({axes[3], axes[4], axes[5]}),
                 z = broadcast({axes[6], axes[7], axes[8]}), o = broadcast({origin[0], origin[1], origin[2]});
  for (std::size_t i = 0; i < count; i += kLanes) {
    const PackVec3 d = load_vector(from, i) - o;
    store_vector(to, i, {dot(x, d), dot(y, d), dot(z, d)});
  }
}

__attribute__((flatten)) void project(const VectorView& vertices, std::size_t count, const Projection& by, const ProjectedView& to) {
  K k;
  const PackVec3 eye = broadcast({by.eye[0], by.eye[1], by.eye[2]}), shift = broadcast({by.shift[0], by.shift[1], by.shift[2]});
  const K::vec2 box(broadcast(by.box[0]), broadcast(by.box[1]));
  const PackReal zero(0.0);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const PackVec3 v = load_vector(vertices, i), h = k.shadow_project(eye, shift, v);
    store_vector(to.homogeneous, i, h);
    const K::vec2 cell = k.shadow_cell(h, box, zero);
    store(to.cell_x + i, cell.x);
    store(to.cell_y + i, cell.y);
    const auto bit = [](const PackMask& m, double value) { return select(m, PackReal(value), PackReal(0.0)); };
    store(to.outside + i, bit(box.x * h.z + h.x <= zero, kLeftOut) + bit(box.x * h.z - h.x <= zero, kRightOut) +
                              bit(box.y * h.z + h.y <= zero, kBottomOut) + bit(box.y * h.z - h.y <= zero, kTopOut) +
                              bit(v.z >= broadcast(by.height), kAbove));
  }
}

__attribute__((flatten)) void facing(const VectorView& normals, const float* offsets, std::size_t count, const float at[3], float* to) {
  K k;
  const PackVec3 p = broadcast({at[0], at[1], at[2]});
  for (std::size_t i = 0; i < count; i += kLanes) store(to + i, k.shadow_facing(load_vector(normals, i), load(offsets + i), p));
}

__attribute__((flatten)) std::size_t contours(const EdgeView& edges, const float* facing, const float* outside, std::uint32_t* found,
                                              std::int32_t* weights) {
  std::size_t n = 0;
  const auto at = [](const std::int32_t* from, std::size_t i) { return IntPack::load_unaligned(from + i); };
  for (std::size_t i = 0; i < edges.count; i += kLanes) {
    const PackReal w =
        load(edges.walks0 + i) * gather(facing, at(edges.plane0, i)) + load(edges.walks1 + i) * gather(facing, at(edges.plane1, i));
    for_each_bit(bits_of(abs(w) > PackReal(0.5)), [&](std::size_t lane) {
      const auto o0 = static_cast<int>(outside[edges.v0[i + lane]]), o1 = static_cast<int>(outside[edges.v1[i + lane]]);
      // If the plane cuts an edge, its upper end is not tested against the box.
      if ((o0 & o1 & kAbove) != 0 || (((o0 | o1) & kAbove) == 0 && (o0 & o1) != 0)) return;
      found[n] = static_cast<std::uint32_t>(i + lane);
      const float weight =
          edges.walks0[i + lane] * facing[edges.plane0[i + lane]] + edges.walks1[i + lane] * facing[edges.plane1[i + lane]];
      weights[n++] = -static_cast<std::int32_t>(weight);
    });
  }
  return n;
}

// Tests of a shaft against packs of edges.
class PackShaft {
 public:
  STERADIAN_INLINE explicit PackShaft(const ShaftView& shaft) : shaft_(shaft), middle_(vector(shaft.middle)) {
    for (int i = 0; i < 3; ++i) half_[i] = vector(shaft.half[i]);
    reach_ = size(middle_) + broadcast(shaft.reach);
  }

  // Lanes where some of the segment may be inside.
  STERADIAN_INLINE PackMask meets(const PackVec3& a, const PackVec3& b) const {
    const PackReal margin_a = rounding() * (size(a) + broadcast(shaft_.reach)), margin_b = rounding() * (size(b) + broadcast(shaft_.reach));
    PackMask result = PackReal(0.0) <= PackReal(0.0);
    for (std::size_t s = 0; s < kShaftSides; ++s) {
      const PackVec3 normal = vector(shaft_.normal[s]);
      const PackReal offset = broadcast(shaft_.offset[s]), scale = size(normal);
      result = result && (dot(normal, a) - scale * margin_a <= offset || dot(normal, b) - scale * margin_b <= offset);
    }
    return result;
  }

  // 1 if all points see the front of a plane, -1 if all see the back, else 0.
  STERADIAN_INLINE PackReal facing(const PackVec3& normal, const PackReal& offset) const {
    const PackReal height = dot(normal, middle_) - offset;
    const PackReal reach = abs(dot(normal, half_[0])) + abs(dot(normal, half_[1])) + abs(dot(normal, half_[2])) +
                           rounding() * (abs(offset) + size(normal) * reach_);
    return select(height > reach, PackReal(1.0), select(height < -reach, PackReal(-1.0), PackReal(0.0)));
  }

  // Lanes where an edge between two triangles may be a contour.
  STERADIAN_INLINE static PackMask may_be_contour(const PackReal& walks0, const PackReal& facing0, const PackReal& walks1,
                                                  const PackReal& facing1) {
    const PackReal zero(0.0), half(0.5);
    const PackMask open = (abs(walks0) > zero && abs(facing0) < half) || (abs(walks1) > zero && abs(facing1) < half);
    return open || abs(walks0 * facing0 + walks1 * facing1) > half;
  }

 private:
  STERADIAN_INLINE static PackReal rounding() { return PackReal(2e-6); }
  STERADIAN_INLINE static PackReal size(const PackVec3& v) { return abs(v.x) + abs(v.y) + abs(v.z); }
  STERADIAN_INLINE static PackVec3 vector(const float v[3]) { return broadcast({v[0], v[1], v[2]}); }

  const ShaftView& shaft_;
  PackVec3 middle_, half_[3];
  PackReal reach_;
};

__attribute__((flatten)) std::size_t filter(const EdgeView& edges, const VectorView& vertices, const VectorView& normals,
                                            const float* offsets, const ShaftView& shaft, const std::uint8_t* has_more,
                                            std::uint32_t* found) {
  std::size_t n = 0;
  const auto at = [](const std::int32_t* from, std::size_t i) { return IntPack::load_unaligned(from + i); };
  const PackShaft by(shaft);
  const auto facing = [&](const IntPack& plane) { return by.facing(gather(normals, plane), gather(offsets, plane)); };
  for (std::size_t i = 0; i < edges.count; i += kLanes) {
    const std::uint32_t bits = bits_of(by.meets(gather(vertices, at(edges.v0, i)), gather(vertices, at(edges.v1, i))));
    if (bits == 0) continue;
    const std::uint32_t contour = bits_of(PackShaft::may_be_contour(load(edges.walks0 + i), facing(at(edges.plane0, i)),
                                                                    load(edges.walks1 + i), facing(at(edges.plane1, i))));
    for_each_bit(bits, [&](std::size_t lane) {
      if ((contour >> lane & 1u) != 0 || has_more[i + lane] != 0) found[n++] = static_cast<std::uint32_t>(i + lane);
    });
  }
  return n;
}

__attribute__((flatten)) std::uint32_t needed(const EdgeLeaf& leaf, const ShaftView& shaft) {
  const PackShaft by(shaft);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kPadding; i += kLanes) {
    const auto vector = [i](const float v[3][kPadding]) { return PackVec3(load(v[0] + i), load(v[1] + i), load(v[2] + i)); };
    const std::uint32_t meets = bits_of(by.meets(vector(leaf.a), vector(leaf.b)));
    if (meets == 0) continue;
    const std::uint32_t contour =
        bits_of(PackShaft::may_be_contour(load(leaf.walks0 + i), by.facing(vector(leaf.normal0), load(leaf.offset0 + i)),
                                          load(leaf.walks1 + i), by.facing(vector(leaf.normal1), load(leaf.offset1 + i))));
    bits |= (meets & (contour | leaf.many >> i)) << i;
  }
  return bits & leaf.valid;
}

// A product of cells' differences is off by 2^-24 of itself, and so is the difference of two products.
STERADIAN_INLINE PackReal bound_of(PackReal p, PackReal q) { return PackReal(4e-7) * (abs(p) + abs(q)); }

struct CertainSides {
  PackMask left, right;  // certain sides of the line
};
// Sides of the vertex p from f.a, with f along d.
STERADIAN_INLINE CertainSides sides_of(PackReal dx, PackReal dy, PackReal px, PackReal py) {
  const PackReal p = dx * py, q = dy * px, d = p - q, bound = bound_of(p, q);
  return {d > bound, d < -bound};
}

__attribute__((flatten)) LeftRay left_ray(const SegmentView& f, std::size_t e, std::uint32_t* uncertain) {
  LeftRay result;
  const float ax = f.ax[e], ay = f.ay[e], bx = f.bx[e], by = f.by[e];
  const float twice_y = ay + by, middle_y = 0.5f * twice_y, right = ax < bx ? bx : ax;
  // Twice the middle, as whole numbers below 2^24.
  const PackReal mx = broadcast(ax + bx), my = broadcast(twice_y), rightmost = broadcast(right), two(2.0);
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const std::size_t block = i / kPadding;
    if (f.block_low[block] > middle_y || f.block_high[block] < middle_y || f.block_left[block] > right) continue;
    const PackReal fax = load(f.ax + i), fay = load(f.ay + i), fbx = load(f.bx + i), fby = load(f.by + i);
    const PackReal start = two * fay, end = two * fby;
    const PackMask level = min(start, end) <= my && max(start, end) >= my && min(fax, fbx) <= rightmost;
    if (!any_lane(level)) continue;
    const CertainSides middle = sides_of(fbx - fax, fby - fay, mx - two * fax, my - two * fay);
    const PackMask rises = start < my && end > my, falls = start > my && end < my;
    const PackMask sure = (rises || falls) && (middle.left || middle.right);
    for_each_bit(bits_of(level) & ~bits_of(sure),
                 [&](std::size_t lane) { uncertain[result.uncertain++] = static_cast<std::uint32_t>(i + lane); });
    for_each_bit(bits_of(level && rises && middle.right), [&](std::size_t lane) { result.count -= f.weight[i + lane]; });
    for_each_bit(bits_of(level && falls && middle.left), [&](std::size_t lane) { result.count += f.weight[i + lane]; });
  }
  return result;
}

__attribute__((flatten)) std::size_t may_cross(const SegmentView& f, std::size_t e, std::uint32_t* found) {
  std::size_t n = 0;
  const float ax = f.ax[e], ay = f.ay[e], bx = f.bx[e], by = f.by[e];
  const float low = ay < by ? ay : by, high = ay < by ? by : ay, left = ax < bx ? ax : bx, right = ax < bx ? bx : ax;
  const PackReal low_x = broadcast(left), high_x = broadcast(right), low_y = broadcast(low), high_y = broadcast(high);
  const PackReal eax = broadcast(ax), eay = broadcast(ay), ex = broadcast(bx - ax), ey = broadcast(by - ay);
  for (std::size_t i = e / kLanes * kLanes; i < f.count; i += kLanes) {
    const std::size_t block = i / kPadding;
    if (f.block_low[block] > high || f.block_high[block] < low || f.block_left[block] > right || f.block_right[block] < left) continue;
    const PackReal fax = load(f.ax + i), fay = load(f.ay + i), fbx = load(f.bx + i), fby = load(f.by + i);
    const PackMask near = min(fay, fby) <= high_y && max(fay, fby) >= low_y && min(fax, fbx) <= high_x && max(fax, fbx) >= low_x;
    if (!any_lane(near)) continue;
    const PackReal dx = fbx - fax, dy = fby - fay, px = eax - fax, py = eay - fay;
    const CertainSides ea = sides_of(dx, dy, px, py), eb = sides_of(dx, dy, px + ex, py + ey);
    const CertainSides fa = sides_of(ex, ey, -px, -py), fb = sides_of(ex, ey, fbx - eax, fby - eay);
    const PackMask misses = (ea.left && eb.left) || (ea.right && eb.right) || (fa.left && fb.left) || (fa.right && fb.right);
    std::uint32_t bits = bits_of(near) & ~bits_of(misses);
    if (i <= e) bits &= ~((2u << (e - i)) - 1u);
    for_each_bit(bits, [&](std::size_t lane) { found[n++] = static_cast<std::uint32_t>(i + lane); });
  }
  return n;
}

// Combines all lanes of a result.
template <class Combine>
STERADIAN_INLINE float reduce(PackReal x, Combine combine) {
  alignas(64) float lanes[kLanes];
  store(lanes, x);
  float result = lanes[0];
  for (std::size_t i = 1; i < kLanes; ++i) result = combine(result, lanes[i]);
  return result;
}
STERADIAN_INLINE float least_of(PackReal x) {
  return reduce(x, [](float a, float b) { return a < b ? a : b; });
}

__attribute__((flatten)) float distance_to_next(const SegmentView& f, float x, float y, float dx, float dy, std::size_t but) {
  const PackReal zero(0.0), one(1.0), far(1e30);
  PackReal nearest = far;
  const float huge = 1e30f;
  alignas(64) float lanes[kLanes];
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const PackReal fax = load(f.ax + i), fay = load(f.ay + i);
    const PackReal fx = load(f.bx + i) - fax, fy = load(f.by + i) - fay;
    const PackReal px = fax - broadcast(x), py = fay - broadcast(y);
    const PackReal det = broadcast(dx) * fy - broadcast(dy) * fx;
    const PackMask crosses = abs(det) > zero;
    const PackReal inverse = one / select(crosses, det, one);
    const PackReal distance = (px * fy - py * fx) * inverse, t = (px * broadcast(dy) - py * broadcast(dx)) * inverse;
    PackReal found = select(crosses && distance > zero && t >= zero && t <= one, distance, far);
    if (but - i < kLanes) {
      store(lanes, found);
      lanes[but - i] = huge;
      found = load(lanes);
    }
    nearest = min(nearest, found);
  }
  return least_of(nearest);
}

__attribute__((flatten)) std::int32_t count_at(const SegmentView& f, float x, float y) {
  std::int32_t count = 0;
  const PackReal qx = broadcast(x), qy = broadcast(y);
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const PackReal fax = load(f.ax + i), fay = load(f.ay + i);
    const PackReal fbx = load(f.bx + i), fby = load(f.by + i);
    const PackMask start = fay > qy, end = fby > qy;
    const PackMask straddles = (start && !end) || (end && !start);
    if (!any_lane(straddles)) continue;
    // The position is no whole number, so differences round as well.
    const PackReal p = (fbx - fax) * (qy - fay), q = (fby - fay) * (qx - fax), d = p - q;
    const PackReal bound = PackReal(1e-6) * (abs(p) + abs(q));
    if (any_lane(straddles && abs(d) <= bound)) return kUncertain;
    for_each_bit(bits_of(end && straddles && d < PackReal(0.0)), [&](std::size_t lane) { count -= f.weight[i + lane]; });
    for_each_bit(bits_of(start && straddles && d > PackReal(0.0)), [&](std::size_t lane) { count += f.weight[i + lane]; });
  }
  return count;
}

__attribute__((flatten)) float clearance2(const SegmentView& f, float x, float y) {
  PackReal least(1e30);
  const PackReal zero(0.0), one(1.0);
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const PackReal fax = load(f.ax + i), fay = load(f.ay + i);
    const PackReal fx = load(f.bx + i) - fax, fy = load(f.by + i) - fay;
    const PackReal px = broadcast(x) - fax, py = broadcast(y) - fay;
    const PackReal t = clamp((px * fx + py * fy) / max(fx * fx + fy * fy, one), zero, one);
    const PackReal rx = px - t * fx, ry = py - t * fy;
    least = min(least, rx * rx + ry * ry);
  }
  return least_of(least);
}

}  // namespace

const ShadowTable& shadow_table() {
  static constexpr ShadowTable table = {turn,     project,   facing,           contours, filter,    needed,
                                        left_ray, may_cross, distance_to_next, count_at, clearance2};
  return table;
}

STERADIAN_END_ISA
