#include "device/plane/recorded_tiles.h"

#include <algorithm>
#include <bit>

namespace steradian::plane {
namespace {

#include "shaders/plane/plane_layout.glsl"

using Words = std::vector<std::uint32_t>;

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
std::uint32_t bits(bool x) { return x ? 1 : 0; }
std::uint32_t bits(int x) { return static_cast<std::uint32_t>(x); }

template <class... Values>
void put(Words& to, Values... values) {
  (to.push_back(bits(values)), ...);
}

void put_round(Words& to, const TileRound& r) { put(to, r.cx, r.cy, r.xx, r.xy, r.yx, r.yy, r.ux, r.uy, r.vx, r.vy); }

void put_vertices(Words& to, const TileVertex* vertices, int count) {
  for (int i = 0; i < count; ++i) put(to, vertices[i].x, vertices[i].y);
}
void put_disks(Words& to, const TileDisk* disks, int count) {
  for (int i = 0; i < count; ++i) put(to, disks[i].x, disks[i].y, disks[i].radius);
}

void put_parts(Words& to, const TileLight& light) {
  for (int i = 0; i < light.part_count; ++i) {
    const TilePart& p = light.parts[i];
    put(to, p.x, p.y, p.nx, p.ny, p.begin, p.end, p.red, p.green, p.blue, p.red_end, p.green_end, p.blue_end, p.from_x, p.from_y, p.to_x,
        p.to_y,
        !p.small               ? 0
        : light.all_parts_seen ? kSmallAndSeen
                               : kSmallPart);
  }
}

// The order is that of shaders/plane/plane_layout.glsl.
void put_header(Words& to, const TileLight& light) {
  put(to, static_cast<int>(light.kind), light.x, light.y, light.radius, light.nx, light.ny, light.begin, light.end, light.inverse_range,
      light.red, light.green, light.blue, light.red_end, light.green_end, light.blue_end, light.profile, light.linear);
  const TileSpot& spot = light.spot;
  put(to, !spot.present ? 0 : spot.wide ? 2 : 1, spot.low_x, spot.low_y, spot.high_x, spot.high_y);
  put_round(to, light.shape);
  put(to, light.part_count, light.low_count, light.high_count, light.low_disk_count, light.high_disk_count, light.disk_count,
      light.span_count, light.body_count, light.chord_count, light.deep_count, light.round_count, light.lens_count);
  const TileArc& a = light.arc;
  put(to, a.x0, a.y0, a.x1, a.y1, a.u0, a.v0, a.u1, a.v1, a.um, a.vm, a.least_cosine, a.whole, a.between_tangents, a.det, a.ramp_x,
      a.ramp_y, a.ramp_c);
}

void put_lists(Words& to, const TileLight& light) {
  put_parts(to, light);
  put_vertices(to, light.lows, light.low_count);
  put_vertices(to, light.highs, light.high_count);
  put_disks(to, light.low_disks, light.low_disk_count);
  put_disks(to, light.high_disks, light.high_disk_count);
  put_disks(to, light.disks, light.disk_count);
  for (int i = 0; i < light.span_count; ++i) {
    const TileSpan& s = light.spans[i];
    put(to, s.begins, s.ends);
    put_vertices(to, light.span_vertices + s.first, s.begins + s.ends);
  }
  for (int i = 0; i < light.body_count; ++i) {
    const TileBody& b = light.bodies[i];
    put(to, b.vertices.begins, b.vertices.ends, b.deep, b.depth_x, b.depth_y, b.depth_c);
    put_vertices(to, light.span_vertices + b.vertices.first, b.vertices.begins + b.vertices.ends);
  }
  for (int i = 0; i < light.chord_count; ++i) put(to, light.chords[i].px, light.chords[i].py, light.chords[i].qx, light.chords[i].qy);
  for (int i = 0; i < light.deep_count; ++i) {
    const TileItem& d = light.deep[i];
    put(to, d.px, d.py, d.qx, d.qy, d.depth_x, d.depth_y, d.depth_c);
  }
  for (int i = 0; i < light.round_count; ++i) {
    put_round(to, light.rounds[i]);
    put(to, light.rounds[i].depth_x, light.rounds[i].depth_y, light.rounds[i].depth_c);
  }
  for (int i = 0; i < light.lens_count; ++i) {
    const TileLens& lens = light.lenses[i];
    put_round(to, lens.round);
    put(to, lens.count);
    for (const TileLens::Crossing& c : lens.crossings) put(to, c.x, c.y, c.lx, c.ly, c.bx, c.by, c.begins);
  }
  put_vertices(to, light.low_corners, light.low_corner_count);
  put_vertices(to, light.high_corners, light.high_corner_count);
}

// Largest number of rounds of a thread's loops for a job, and the rounds of one blocker. These place it among the intervals, and move
// others for it.
constexpr std::size_t kMostSteps = kMostTurns, kStepsOfBlocker = 2 + 2 * kIntervals, kNone = static_cast<std::size_t>(-1);

std::size_t steps_of(const TileLight& light) {
  const auto size = [](int count) { return static_cast<std::size_t>(count); };
  std::size_t within = size(light.disk_count + light.span_count + light.body_count + light.chord_count + light.deep_count +
                            light.round_count + 8 * light.lens_count);
  std::size_t steps = 16 + size(light.low_count + light.high_count + light.low_disk_count + light.high_disk_count + light.low_corner_count +
                                light.high_corner_count);
  for (int i = 0; i < light.span_count; ++i) steps += size(light.spans[i].begins + light.spans[i].ends);
  for (int i = 0; i < light.body_count; ++i) steps += size(light.bodies[i].vertices.begins + light.bodies[i].vertices.ends);
  steps += within * kStepsOfBlocker;
  const std::size_t gaps = std::min<std::size_t>(within + 1, kIntervals + 1);
  steps += size(light.part_count + 1) * 13 * gaps;
  // Arcs: 15 nodes for each gap, and halvings near one end.
  if (light.kind == TileKind::arc) steps += 15 * (gaps + 64);
  return steps;
}

}  // namespace

void RecordedTiles::clear(std::size_t pairs, const std::vector<char>& elsewhere) {
  pairs_ = pairs;
  elsewhere_ = &elsewhere;
  tiles_.clear();
  jobs_.clear();
  for (Words& words : words_) words.clear();
}

void RecordedTiles::begin_tile(int x, int y, Vec2d center) {
  tile_ = {};
  tile_.x = x;
  tile_.y = y;
  tile_.center = center;
  tile_.first_job = jobs_.size();
  std::fill(std::begin(open_), std::end(open_), kNone);
}

Words* RecordedTiles::begin_light(LightGroup group, std::size_t steps) {
  if (steps > kMostSteps) return nullptr;
  std::size_t& open = open_[static_cast<std::size_t>(group)];
  Words& words = words_[static_cast<std::size_t>(group)];
  if (open == kNone || jobs_[open].steps + steps > kMostSteps) {
    const int round = open == kNone ? 0 : jobs_[open].round + 1;
    open = jobs_.size();
    jobs_.push_back({group, round, words.size()});
  }
  jobs_[open].steps += steps;
  return &words;
}

void RecordedTiles::end_light(LightGroup group) {
  RecordedJob& job = jobs_[open_[static_cast<std::size_t>(group)]];
  ++job.lights;
  job.words = words_[static_cast<std::size_t>(group)].size() - job.first;
}

void RecordedTiles::add(const TileLight& light) {
  const LightGroup group = light.kind == TileKind::arc ? LightGroup::arcs : LightGroup::cuts;
  Words* to = begin_light(group, steps_of(light));
  if (to == nullptr) {
    tile_.for_cpu = true;
    return;
  }
  const std::size_t first = to->size();
  put_header(*to, light);
  to->resize(first + kLight);
  put_lists(*to, light);
  (*to)[first + kLightWords] = static_cast<std::uint32_t>(to->size() - first);
  (*to)[first + kLightCorners] = bits(light.low_corner_count);
  (*to)[first + kLightCorners + 1] = bits(light.high_corner_count);
  end_light(group);
}

bool RecordedTiles::add(const EventLight& light, const int* pairs, int count) {
  for (int i = 0; i < count; ++i)
    if (static_cast<std::size_t>(pairs[i]) >= pairs_) return false;
  Words* words = begin_light(LightGroup::disks, static_cast<std::size_t>(count) * (kStepsOfBlocker + EventOutlines::kMostVertices) + 8);
  if (words == nullptr) return false;
  Words& to = *words;
  put(to, light.x, light.y, light.radius, light.inverse_range, light.red, light.green, light.blue, count);
  for (int i = 0; i < count; ++i) to.push_back(static_cast<std::uint32_t>(pairs[i]));
  end_light(LightGroup::disks);
  return true;
}

void RecordedTiles::end_tile(const std::bitset<kTilePixels>& filled) {
  tile_.filled = filled;
  tile_.jobs = jobs_.size() - tile_.first_job;
  for (std::size_t i = tile_.first_job; i < jobs_.size(); ++i) tile_.words += jobs_[i].words;
  tiles_.push_back(tile_);
}

}  // namespace steradian::plane
