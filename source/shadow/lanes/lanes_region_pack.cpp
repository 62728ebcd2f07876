// The visible region, for sixteen points at once: whether it is thin, a position well inside, and the edges that bound it.
#include "shadow/edges/segments.h"
#include "shadow/lanes/lanes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;

constexpr float kFar = 1e30f;
constexpr float kThin = 1.0f / 4096;             // narrower than this fraction of its length, a region proves nothing by a ray
constexpr float kCellSize = 1.0f / kCells;       // in half sides of the box
constexpr float kRoomEnough = kCells / 1024.0f;  // around a position: a ray's rounding is a thousand times less
constexpr float kLeastRoom = kCells / 8192.0f;   // below it, the point searches for a position by itself
constexpr int kTrials = 4;

// Lanes where the region is not thin, by its area and perimeter in half sides.
std::uint32_t find_wide(const LaneWork& work) {
  LaneReals area{}, perimeter{};
  const PackReal zero(0.0), size = broadcast(kCellSize);
  for (std::size_t s = 0; s < work.count; ++s) {
    const SegmentLanes& e = work.segments[s];
    if (e.bounds == 0) continue;
    each_pack([&](std::size_t i) {
      const PackReal ax = size * get(e.ax, i), ay = size * get(e.ay, i), dx = size * get(e.bx, i) - ax, dy = size * get(e.by, i) - ay;
      const PackMask here = mask_at(e.bounds, i);
      const std::uint32_t backwards = bits_of(get(e.weight, i) > PackInt(0)) << i;  // the right side has the lower count
      const PackReal twice = ax * dy - ay * dx;
      put(area, i, get(area, i) + select(here, select(mask_at(backwards, i), -twice, twice), zero));
      put(perimeter, i, get(perimeter, i) + select(here, sqrt(dx * dx + dy * dy), zero));
    });
  }
  for (std::size_t k = 0; k < work.pieces.size; ++k) {
    const CrossedPiece& p = work.pieces.data[k];
    const float dx = p.bx - p.ax, dy = p.by - p.ay;
    area.at[p.lane] += (p.ax * dy - p.ay * dx) * (kCellSize * kCellSize);
    perimeter.at[p.lane] += __builtin_sqrtf(dx * dx + dy * dy) * kCellSize;
  }
  return lane_bits([&](std::size_t i) { return get(area, i) > PackReal(2.0) * broadcast(kThin) * get(perimeter, i); });
}

// A piece in every lane: its middle, the unit normal into the region, its squared length.
struct Longest {
  LaneReals x, y, nx, ny, length2;
  LaneInts number;   // the search continues from it
  LaneInts segment;  // segment of the piece
};

// Finds the longest pieces that bound the region after those of `before`.
void find_longest(const LaneWork& work, std::uint32_t lanes, const Longest& before, Longest& found) {
  each_pack([&](std::size_t i) {
    put(found.length2, i, PackReal(0.0));
    put(found.number, i, PackInt(-1));
  });
  for (std::size_t s = 0; s < work.count; ++s) {
    const SegmentLanes& e = work.segments[s];
    const std::uint32_t bits = e.bounds & lanes;
    if (bits == 0) continue;
    const PackInt number(static_cast<std::int32_t>(s));
    each_pack([&](std::size_t i) {
      const PackReal dx = get(e.bx, i) - get(e.ax, i), dy = get(e.by, i) - get(e.ay, i), length2 = dx * dx + dy * dy;
      const PackReal last = get(before.length2, i);
      const std::uint32_t later = bits_of(number > get(before.number, i)) << i;
      const PackMask next = length2 < last || (length2 <= last && mask_at(later, i));
      const PackMask take = mask_at(bits, i) && next && length2 > get(found.length2, i);
      if (!any_lane(take)) return;
      const std::uint32_t backwards = bits_of(get(e.weight, i) > PackInt(0)) << i;
      const PackReal sign = select(mask_at(backwards, i), PackReal(-1.0), PackReal(1.0)), half(0.5);
      const auto replace = [&](LaneReals& to, const PackReal& x) { put(to, i, select(take, x, get(to, i))); };
      replace(found.x, half * (get(e.ax, i) + get(e.bx, i)));
      replace(found.y, half * (get(e.ay, i) + get(e.by, i)));
      replace(found.nx, -sign * dy);
      replace(found.ny, sign * dx);
      replace(found.length2, length2);
      put(found.number, i, select(take, number, get(found.number, i)));
      put(found.segment, i, select(take, number, get(found.segment, i)));
    });
  }
  for (std::size_t k = 0; k < work.pieces.size; ++k) {
    const CrossedPiece& p = work.pieces.data[k];
    const std::size_t lane = p.lane;
    if ((lanes >> lane & 1) == 0) continue;
    const float dx = p.bx - p.ax, dy = p.by - p.ay, length2 = dx * dx + dy * dy;
    const auto number = static_cast<std::int32_t>(work.count + k);
    const float last = before.length2.at[lane];
    if (!(length2 < last || (length2 <= last && number > before.number.at[lane])) || !(length2 > found.length2.at[lane])) continue;
    found.x.at[lane] = 0.5f * (p.ax + p.bx);
    found.y.at[lane] = 0.5f * (p.ay + p.by);
    found.nx.at[lane] = -dy;
    found.ny.at[lane] = dx;
    found.length2.at[lane] = length2;
    found.number.at[lane] = number;
    found.segment.at[lane] = static_cast<std::int32_t>(p.segment);
  }
  each_pack([&](std::size_t i) {
    const PackReal scale = inversesqrt(max(get(found.length2, i), PackReal(1e-20)));
    put(found.nx, i, get(found.nx, i) * scale);
    put(found.ny, i, get(found.ny, i) * scale);
  });
}

// Steps from middles along the normals, half way to the next segment.
void step_inside(const LaneWork& work, const Longest& from, LaneReals& x, LaneReals& y) {
  const PackReal zero(0.0), one(1.0), far = broadcast(kFar);
  LaneReals distance;
  each_pack([&](std::size_t i) { put(distance, i, far); });
  for (std::size_t s = 0; s < work.count; ++s) {
    const SegmentLanes& f = work.segments[s];
    each_pack([&](std::size_t i) {
      const PackReal ax = get(f.ax, i), ay = get(f.ay, i), fx = get(f.bx, i) - ax, fy = get(f.by, i) - ay;
      const PackReal px = ax - get(from.x, i), py = ay - get(from.y, i), nx = get(from.nx, i), ny = get(from.ny, i);
      const PackReal det = nx * fy - ny * fx;
      const std::uint32_t other = ~(bits_of(get(from.segment, i) == PackInt(static_cast<std::int32_t>(s))) << i);
      const PackMask here = mask_at(f.present & other, i) && abs(det) > zero;
      const PackReal inverse = one / select(here, det, one);
      const PackReal d = (px * fy - py * fx) * inverse, t = (px * ny - py * nx) * inverse;
      put(distance, i, min(get(distance, i), select(here && d > zero && t >= zero && t <= one, d, far)));
    });
  }
  each_pack([&](std::size_t i) {
    const PackReal half = PackReal(0.5) * get(distance, i);
    put(x, i, get(from.x, i) + half * get(from.nx, i));
    put(y, i, get(from.y, i) + half * get(from.ny, i));
  });
}

// Distance of positions from all segments; 0 where the count exceeds the level or is uncertain.
void find_room(const LaneWork& work, const LaneView& view, const LaneInts& level, const LaneReals& x, const LaneReals& y, LaneReals& room) {
  const PackReal zero(0.0), one(1.0);
  LaneReals least2;
  LaneInts count;
  std::uint32_t uncertain = 0;
  each_pack([&](std::size_t i) {
    put(least2, i, broadcast(kFar));
    put(count, i, get(view.base, i));
  });
  for (std::size_t s = 0; s < work.count; ++s) {
    const SegmentLanes& f = work.segments[s];
    each_pack([&](std::size_t i) {
      const PackMask here = mask_at(f.present, i);
      const PackReal ax = get(f.ax, i), ay = get(f.ay, i), fx = get(f.bx, i) - ax, fy = get(f.by, i) - ay;
      const PackReal qx = get(x, i), qy = get(y, i), px = qx - ax, py = qy - ay;
      const PackReal t = clamp((px * fx + py * fy) / max(fx * fx + fy * fy, one), zero, one);
      const PackReal rx = px - t * fx, ry = py - t * fy;
      put(least2, i, min(get(least2, i), select(here, rx * rx + ry * ry, broadcast(kFar))));
      // The left ray. The position is no whole number, so differences round as well.
      const PackMask start = ay > qy, end = get(f.by, i) > qy, rises = here && end && !start, falls = here && start && !end;
      const PackReal p = fx * py, q = fy * px, d = p - q;
      uncertain |= bits_of((rises || falls) && abs(d) <= PackReal(1e-6) * (abs(p) + abs(q))) << i;
      const PackInt w = get(f.weight, i);
      PackInt sum = get(count, i);
      sum = sum - where(rises && d < zero, w);
      sum = sum + where(falls && d > zero, w);
      if ((f.left_a | f.left_b) != 0) {
        sum = sum + where(mask_at(f.left_a, i) && ay < qy, w);
        sum = sum - where(mask_at(f.left_b, i) && get(f.by, i) < qy, w);
      }
      put(count, i, sum);
    });
  }
  each_pack([&](std::size_t i) {
    const std::uint32_t inside = ~(bits_of(comparable(get(count, i), work.layered) > get(level, i)) << i) & ~uncertain;
    put(room, i, select(mask_at(inside, i), sqrt(get(least2, i)), zero));
  });
}

struct RegionWriter {
  const LaneView& view;
  std::uint32_t lanes;

  // Writes an end of an edge, given in cells, as vectors from the points, on or above their horizons.
  STERADIAN_INLINE void corner(const PackReal& cell_x, const PackReal& cell_y, std::size_t i, float* to) const {
    const PackReal size = broadcast(kCellSize), zero(0.0), one(1.0);
    const PackReal x = cell_x * (get(view.box_x, i) * size) - get(view.eye[0], i);
    const PackReal y = cell_y * (get(view.box_y, i) * size) - get(view.eye[1], i);
    PackVec3 d = get(view.axes, i) * x + get(view.axes + 3, i) * y + get(view.axes + 6, i) * get(view.eye[2], i);
    const PackVec3 normal = get(view.normal, i);
    const PackReal least = PackReal(1e-6) * sqrt(dot(d, d)), height = dot(d, normal);
    d = d + normal * max(least - height, zero);
    const PackMask here = mask_at(lanes, i);
    store(to + i, select(here, d.x, zero));
    store(to + kPoints + i, select(here, d.y, one));
    store(to + 2 * kPoints + i, select(here, d.z, zero));
  }
};

}  // namespace

static __attribute__((flatten)) void region_in_lanes(LaneWork& work, const LaneView& view, LaneBits lanes, RegionLanes& result) {
  result.wide = narrow(find_wide(work) & lanes & ~static_cast<std::uint32_t>(result.none));
  std::uint32_t todo = result.wide;
  LaneReals best{}, x, y, room;
  Longest before, longest;
  each_pack([&](std::size_t i) {
    put(before.length2, i, broadcast(kFar));
    put(before.number, i, PackInt(-1));
    put(result.place_x, i, PackReal(0.0));
    put(result.place_y, i, PackReal(0.0));
    put(longest.segment, i, PackInt(-1));
    for (LaneReals* r : {&longest.x, &longest.y, &longest.nx, &longest.ny}) put(*r, i, PackReal(0.0));
  });
  for (int trial = 0; trial < kTrials && todo != 0; ++trial) {
    find_longest(work, todo, before, longest);
    step_inside(work, longest, x, y);
    find_room(work, view, result.level, x, y, room);
    std::uint32_t enough = 0;
    each_pack([&](std::size_t i) {
      const PackReal is = get(room, i);
      const PackMask better = is > get(best, i) && mask_at(todo, i) && abs(get(x, i)) + abs(get(y, i)) < broadcast(1e9f);
      put(best, i, select(better, is, get(best, i)));
      put(result.place_x, i, select(better, get(x, i), get(result.place_x, i)));
      put(result.place_y, i, select(better, get(y, i), get(result.place_y, i)));
      enough |= bits_of(get(best, i) > broadcast(kRoomEnough)) << i;
    });
    todo &= ~enough;
    before = longest;
  }
  result.found =
      narrow(static_cast<std::uint32_t>(result.wide) & lane_bits([&](std::size_t i) { return get(best, i) > broadcast(kLeastRoom); }));
}

static std::size_t count_edges_in_lanes(const LaneWork& work, LaneBits lanes) {
  std::size_t whole = 0, most = 0;
  std::size_t crossed[kPoints] = {};
  for (std::size_t s = 0; s < work.count; ++s) whole += (work.segments[s].bounds & lanes) != 0;
  for (std::size_t k = 0; k < work.pieces.size; ++k) ++crossed[work.pieces.data[k].lane];
  for (std::size_t lane = 0; lane < kPoints; ++lane)
    if ((lanes >> lane & 1) != 0 && crossed[lane] > most) most = crossed[lane];
  return whole + most;
}

static __attribute__((flatten)) void write_edges_in_lanes(const LaneWork& work, const LaneView& view, const RegionLanes& region,
                                                          LaneBits lanes, float* to) {
  constexpr std::size_t kEdge = 6 * kPoints;
  const RegionWriter writer{view, lanes};
  const auto write = [&](const PackReal& ax, const PackReal& ay, const PackReal& bx, const PackReal& by, std::size_t i, float* edge) {
    writer.corner(ax, ay, i, edge);
    writer.corner(bx, by, i, edge + 3 * kPoints);
  };
  for (std::size_t s = 0; s < work.count; ++s) {
    const SegmentLanes& e = work.segments[s];
    const std::uint32_t bits = e.bounds & lanes;
    if (bits == 0) continue;
    each_pack([&](std::size_t i) {
      // The edge has no length where it does not bound the region, which lies on the left.
      const PackMask here = mask_at(bits, i);
      const std::uint32_t less_right = bits_of(get(e.weight, i) > PackInt(0)) << i;
      const PackMask backwards = mask_at(less_right, i);
      const PackReal x = get(region.place_x, i), y = get(region.place_y, i);
      const PackReal ax = select(here, get(e.ax, i), x), ay = select(here, get(e.ay, i), y);
      const PackReal bx = select(here, get(e.bx, i), x), by = select(here, get(e.by, i), y);
      write(select(backwards, bx, ax), select(backwards, by, ay), select(backwards, ax, bx), select(backwards, ay, by), i, to);
    });
    to += kEdge;
  }
  // Row k of the crossed pieces holds the k-th piece of every lane, at first in cells.
  std::size_t crossed[kPoints] = {}, rows = 0;
  for (std::size_t k = 0; k < work.pieces.size; ++k) {
    const CrossedPiece& p = work.pieces.data[k];
    if ((lanes >> p.lane & 1) == 0) continue;
    const std::size_t row = crossed[p.lane]++;
    if (row == rows) {
      each_pack([&](std::size_t i) {
        for (std::size_t c = 0; c < 4; ++c) store(to + row * kEdge + c * kPoints + i, get(c % 2 == 0 ? region.place_x : region.place_y, i));
      });
      ++rows;
    }
    float* cell = to + row * kEdge + p.lane;
    cell[0] = p.ax;
    cell[kPoints] = p.ay;
    cell[2 * kPoints] = p.bx;
    cell[3 * kPoints] = p.by;
  }
  for (std::size_t row = 0; row < rows; ++row) {
    float* edge = to + row * kEdge;
    each_pack([&](std::size_t i) {
      const PackReal ax = load(edge + i), ay = load(edge + kPoints + i), bx = load(edge + 2 * kPoints + i),
                     by = load(edge + 3 * kPoints + i);
      write(ax, ay, bx, by, i, edge);
    });
  }
}

const LaneTable& lane_table() {
  static constexpr LaneTable table = {see_in_lanes, bound_in_lanes,  cross_in_lanes,       count_in_lanes,
                                      cut_in_lanes, region_in_lanes, count_edges_in_lanes, write_edges_in_lanes};
  return table;
}

STERADIAN_END_ISA
