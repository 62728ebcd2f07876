// A round light on the pixels of one tile, by the slopes that blockers leave visible. For *_pack.cpp only.
#pragma once

#include "plane/frame/tiles/tile_cut.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

// Ends of the visible parts of a disk with a range, on one tile. Blocks of pixels are integrated end by end in separate loops: without
// branches, many ends are in flight at once.
struct DiskEnds {
  static constexpr int kRoom = 64;
  alignas(64) float d2[kTilePixels];  // the centre's distance squared, range 1
  alignas(64) float sum[kTilePixels];
  alignas(64) float slope[kRoom * kLanes];
  int pixel[kRoom];  // the first of the block
  float sign[kRoom];
  int count = 0;
  // Ends at a tangent of the disk.
  alignas(64) float tangent[kTilePixels];
  int tangent_pixel[kTilePixels / kLanes];
  float tangent_sign[kTilePixels / kLanes];  // 2 if both are
  int tangent_count = 0;
  PackReal rho2;

  STERADIAN_INLINE void push(int i, PackReal at, float to_sum) {
    if (count == kRoom) flush();
    pixel[count] = i;
    sign[count] = to_sum;
    store(slope + static_cast<std::size_t>(count) * kLanes, at);
    ++count;
  }
  STERADIAN_INLINE void push_tangent(int i, PackReal at, float ends) {
    tangent_pixel[tangent_count] = i;
    tangent_sign[tangent_count++] = ends;
    store(tangent + i, at);
  }
  STERADIAN_INLINE void add_to_sum(int i, float times, PackReal part) { store(sum + i, load(sum + i) + broadcast(times) * part); }
  void flush() {
    PackKernels k;
    for (int n = 0; n < count; ++n)
      add_to_sum(pixel[n], sign[n], k.plane_disk_window(load(slope + static_cast<std::size_t>(n) * kLanes), load(d2 + pixel[n]), rho2));
    for (int n = 0; n < tangent_count; ++n) {
      const int i = tangent_pixel[n];
      add_to_sum(i, tangent_sign[n], PackReal(0.5) * k.plane_disk_window_whole(load(tangent + i), load(d2 + i), rho2));
    }
    count = tangent_count = 0;
  }
};

struct DiskView {
  Axis axis;
  PackReal d2, tangent2;
  STERADIAN_INLINE DiskView(const TileLight& light, const TileBuffer& tile, int i) {
    axis.px = load(tile.x + i);
    axis.py = load(tile.y + i);
    axis.x = broadcast(light.x) - axis.px;
    axis.y = broadcast(light.y) - axis.py;
    d2 = axis.x * axis.x + axis.y * axis.y;
    tangent2 = d2 - broadcast(light.radius * light.radius);
  }
  // The slope of the tangents; 0 within the disk.
  STERADIAN_INLINE PackReal limit(const TileLight& light) const {
    const PackReal slope = broadcast(light.radius) * inversesqrt(max(tangent2, PackReal(1e-12)));
    return select(tangent2 > PackReal(0.0), slope, PackReal(0.0));
  }
};

STERADIAN_INLINE void add_colour(const TileLight& light, TileBuffer& tile, int i, PackReal share) {
  share = share * PackKernels().inverse_two_pi();
  add(tile.red + i, share * broadcast(light.red));
  add(tile.green + i, share * broadcast(light.green));
  add(tile.blue + i, share * broadcast(light.blue));
}

void add_ranged_disk(const TileLight& light, TileBuffer& tile, unsigned blocks) {
  DiskEnds ends;
  const PackReal inverse2 = broadcast(light.inverse_range * light.inverse_range);
  ends.rho2 = broadcast(light.radius * light.radius) * inverse2;
  int lit[kTilePixels / kLanes], lit_count = 0;
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
    if ((blocks >> (i / 16) & 1) == 0) continue;
    const DiskView view(light, tile, i);
    const PackReal d2 = view.d2 * inverse2;
    Cut cut;
    cut.kept = light.scratch;
    cut.high = view.limit(light);
    const PackMask leaves = d2 - ends.rho2 > PackReal(1.0);
    const bool within = !any_lane(leaves);
    if (!within) {
      // The near side leaves the range before the tangent: law of cosines, R = 1.
      const PackReal numerator = d2 + PackReal(1.0) - ends.rho2;
      const PackReal sine2 = PackReal(4.0) * d2 - numerator * numerator;
      const PackReal reach = PackKernels().plane_root(max(sine2, PackReal(0.0))) / numerator;
      cut.high = select(leaves, min(reach, cut.high), cut.high);
    }
    cut.low = -cut.high;
    const PackReal reached = cut.high;
    if (cut.dark() || !cut_blockers(light, view.axis, cut)) continue;
    lit[lit_count++] = i;
    store(ends.d2 + i, d2);
    store(ends.sum + i, PackReal(0.0));
    // The integral over [low, high] without the removed intervals; if low has passed high, over nothing.
    const bool high_open = within && all_lanes(cut.high >= reached), low_open = within && all_lanes(cut.low <= -reached);
    if (high_open && low_open) {
      ends.push_tangent(i, reached, 2.0f);
    } else if (high_open) {
      ends.push_tangent(i, reached, 1.0f);
      ends.push(i, min(cut.low, cut.high), -1.0f);
    } else if (low_open) {
      ends.push_tangent(i, reached, 1.0f);
      ends.push(i, max(cut.low, cut.high), 1.0f);
    } else {
      ends.push(i, min(cut.low, cut.high), -1.0f);
      ends.push(i, cut.high, 1.0f);
    }
    cut.for_each_taken([&](PackReal from, PackReal to) {
      ends.push(i, from, 1.0f);
      ends.push(i, to, -1.0f);
    });
  }
  ends.flush();
  for (int n = 0; n < lit_count; ++n) add_colour(light, tile, lit[n], max(load(ends.sum + lit[n]), PackReal(0.0)));
}

STERADIAN_INLINE void add_disk(const TileLight& light, TileBuffer& tile, int i) {
  const DiskView view(light, tile, i);
  Cut cut;
  cut.kept = light.scratch;
  cut.high = view.limit(light);
  cut.low = -cut.high;
  if (cut.dark() || !cut_blockers(light, view.axis, cut)) return;
  PackReal sum(0.0);
  cut.for_each_gap([&](PackReal from, PackReal to) { sum += PackKernels().trig_atan2_unwrapped(to - from, PackReal(1.0) + from * to); });
  add_colour(light, tile, i, sum);
}

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
