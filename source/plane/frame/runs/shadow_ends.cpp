#include "plane/frame/runs/shadow_ends.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace steradian::plane {
namespace {

TileVertex vertex(Vec2d p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }
TileDisk disk(const Silhouette& s) {
  return {static_cast<float>(s.center.x), static_cast<float>(s.center.y), static_cast<float>(s.radius)};
}

// Other ends are compared with this many ends only, however many there are.
constexpr std::size_t kFurthest = 16, kLooks = 24;

// Moves the furthest ends to the front, as the tile's centre sees them; all are ahead of it, within half a turn.
template <class Further>
void bring_forward(std::vector<Vec2d>& ends, Further further) {
  if (ends.size() > kFurthest) std::nth_element(ends.begin(), ends.begin() + kFurthest, ends.end(), further);
}
template <class Further>
void keep_furthest(std::vector<Vec2d>& ends, Further further) {
  bring_forward(ends, further);
  if (ends.size() > kFurthest) ends.resize(kFurthest);
}

template <class F>
void for_each(unsigned set, F call) {
  for (; set != 0; set &= set - 1) call(std::countr_zero(set));
}
template <class F>
bool any_of(unsigned set, F test) {
  for (; set != 0; set &= set - 1)
    if (test(std::countr_zero(set))) return true;
  return false;
}

}  // namespace

void ShadowEnds::clear(const std::vector<Silhouette>& pool, Vec2d to_light) {
  axis_ = to_light;
  hidden_ = false;
  pool_ = &pool;
  held_.clear();
  low_front_.clear();
  high_front_.clear();
  low_points_.clear();
  high_points_.clear();
  far_rounds_.clear();
  low_disks_.clear();
  high_disks_.clear();
  lenses_.clear();
}

// Is b counter-clockwise of a, from all of the tile? cross(a - p, b - p) = cross(a, b) - cross(p, b - a)
bool ShadowEnds::follows(Vec2d a, Vec2d b) const { return cross(a, b) >= std::fabs(b.y - a.y) * half_.x + std::fabs(b.x - a.x) * half_.y; }

// The same for all of a disk.
bool ShadowEnds::follows_disk(Vec2d a, double radius, Vec2d b) const {
  const double turn = cross(a, b) - std::fabs(b.y - a.y) * half_.x - std::fabs(b.x - a.x) * half_.y;
  const double left = turn - radius * radius_;
  return left >= 0 && left * left >= radius * radius * dot(b, b);
}

void ShadowEnds::take_front(int silhouette, std::uint16_t ahead, bool from_low, bool to_high) {
  if (from_low && to_high) {
    hidden_ = true;
    return;
  }
  held_.push_back({silhouette, ahead, false, false, false, false, {}});
  if (from_low) grow_low(held_.back());
  if (to_high) grow_high(held_.back());
}

void ShadowEnds::take_deep(int silhouette, std::uint16_t ahead, const DepthLine& depth) {
  held_.push_back({silhouette, ahead, true, false, false, false, depth});
}

// The blocker is known to begin before the rest of the light.
void ShadowEnds::grow_low(Held& h) {
  const Silhouette& s = of(h);
  h.low_done = true;
  for_each(s.ends & h.ahead, [&](int k) { low_front_.push_back(s.at(k)); });
  if ((s.ends & ~h.ahead) != 0) return;
  h.dropped = true;
  if (s.kind == Silhouette::Kind::disk)
    low_disks_.push_back(disk(s));
  else
    for_each(s.ends, [&](int k) { low_points_.push_back(s.at(k)); });
}

void ShadowEnds::grow_high(Held& h) {
  const Silhouette& s = of(h);
  h.high_done = true;
  for_each(s.begins & h.ahead, [&](int k) { high_front_.push_back(s.at(k)); });
  if ((s.begins & ~h.ahead) != 0) return;
  h.dropped = true;
  if (s.kind == Silhouette::Kind::disk)
    high_disks_.push_back(disk(s));
  else
    for_each(s.begins, [&](int k) { high_points_.push_back(s.at(k)); });
}

bool ShadowEnds::covered(Vec2d center, double radius) const {
  // For the other side the test uses the mirror image.
  return std::any_of(low_front_.begin(), low_front_.end(), [&](Vec2d v) { return follows_disk(center, radius, v); }) ||
         std::any_of(high_front_.begin(), high_front_.end(), [&](Vec2d v) {
           return follows_disk({center.x, -center.y}, radius, {v.x, -v.y});
         });
}

bool ShadowEnds::covered(const Held& h) const {
  const Silhouette& s = of(h);
  if (s.kind == Silhouette::Kind::disk) return covered(s.center, s.radius);
  const unsigned outer = s.begins | s.ends;
  for (Vec2d v : low_front_)
    if (!any_of(outer, [&](int k) { return !follows(s.at(k), v); })) return true;
  for (Vec2d v : high_front_)
    if (!any_of(outer, [&](int k) { return !follows(v, s.at(k)); })) return true;
  return false;
}

// Drops ends that another end is always beyond. Ends that only moved a front on do not count: they rely on the ends before them.
void ShadowEnds::drop_dominated() {
  const auto thin = [](std::vector<Vec2d>& ends, auto further, auto beyond) {
    // The furthest first, as the tile's centre sees them.
    bring_forward(ends, further);
    for (std::size_t i = ends.size(); i-- > 0;)
      for (std::size_t k = 0; k < std::min(ends.size(), kFurthest); ++k)
        if (k != i && beyond(ends[i], ends[k])) {
          ends[i] = ends.back();
          ends.pop_back();
          break;
        }
  };
  thin(
      low_points_, [](Vec2d a, Vec2d b) { return cross(a, b) < 0; }, [&](Vec2d end, Vec2d v) { return follows(end, v); });
  thin(
      high_points_, [](Vec2d a, Vec2d b) { return cross(a, b) > 0; }, [&](Vec2d end, Vec2d v) { return follows(v, end); });
}

bool ShadowEnds::hidden() {
  if (hidden_) return true;
  // The growth is limited: work that remains for the pixels gives the same result.
  std::size_t looks = kLooks * (held_.size() + 16);
  const auto worth = [&] { return looks > held_.size() && (looks -= held_.size()) != 0; };
  for (std::size_t i = 0; i < low_front_.size() && worth(); ++i)
    for (Held& h : held_) {
      if (h.dropped || h.deep || h.low_done) continue;
      const Silhouette& s = of(h);
      if (any_of(s.begins & h.ahead, [&, low = low_front_[i]](int k) { return follows(s.at(k), low); })) grow_low(h);
    }
  looks = kLooks * (held_.size() + 16);
  for (std::size_t i = 0; i < high_front_.size() && worth(); ++i)
    for (Held& h : held_) {
      if (h.dropped || h.deep || h.high_done) continue;
      const Silhouette& s = of(h);
      if (any_of(s.ends & h.ahead, [&, high = high_front_[i]](int k) { return follows(high, s.at(k)); })) grow_high(h);
    }
  keep_furthest(low_front_, [](Vec2d a, Vec2d b) { return cross(a, b) < 0; });
  keep_furthest(high_front_, [](Vec2d a, Vec2d b) { return cross(a, b) > 0; });
  for (Vec2d low : low_front_)
    for (Vec2d high : high_front_)
      if (follows(high, low)) return true;
  return false;
}

// A value that rises with the angle from the light's direction, -2 to 2.
double ShadowEnds::turn_of(Vec2d v) const {
  const double across = cross(axis_, v), along = dot(axis_, v), sum = std::fabs(across) + std::fabs(along);
  if (!(sum > 0)) return 0;
  return along >= 0 ? across / sum : std::copysign(2, across) - across / sum;
}

void ShadowEnds::write(TileLight& light) {
  drop_dominated();
  lows_.clear();
  highs_.clear();
  vertices_.clear();
  disks_.clear();
  spans_.clear();
  bodies_.clear();
  chords_.clear();
  deep_.clear();
  rounds_.clear();
  for (Vec2d v : low_points_) lows_.push_back(vertex(v));
  for (Vec2d v : high_points_) highs_.push_back(vertex(v));
  // Sorted by their begins, as the tile's centre sees them: spans that follow each other then merge as they are applied.
  if (held_.size() > kFurthest) {
    const auto begin = [&](const Held& h) { return of(h).at(std::countr_zero(static_cast<unsigned>(of(h).begins))); };
    std::sort(held_.begin(), held_.end(), [&](const Held& a, const Held& b) {
      const double turn_a = turn_of(begin(a)), turn_b = turn_of(begin(b));
      return turn_a != turn_b ? turn_a < turn_b : a.silhouette < b.silhouette;
    });
  }
  for (const Held& h : held_) {
    // A blocker whose own ends are among the front's would cover itself.
    if (h.dropped || (!h.low_done && !h.high_done && covered(h))) continue;
    const Silhouette& s = of(h);
    if (s.kind == Silhouette::Kind::disk) {
      disks_.push_back(disk(s));
      continue;
    }
    const bool ordered = !h.deep && ((s.begins | s.ends) & ~h.ahead) == 0;
    if (!ordered && s.kind == Silhouette::Kind::segment) {
      (h.deep ? deep_ : chords_)
          .push_back({static_cast<float>(s.x[0]), static_cast<float>(s.y[0]), static_cast<float>(s.x[1]), static_cast<float>(s.y[1]),
                      h.depth.x, h.depth.y, h.depth.c});
      continue;
    }
    const TileSpan span{static_cast<int>(vertices_.size()), std::popcount(s.begins), std::popcount(s.ends)};
    for_each(s.begins, [&](int k) { vertices_.push_back(vertex(s.at(k))); });
    for_each(s.ends, [&](int k) { vertices_.push_back(vertex(s.at(k))); });
    if (ordered)
      spans_.push_back(span);
    else
      bodies_.push_back({span, h.deep, h.depth.x, h.depth.y, h.depth.c});
  }
  for (const Round& r : far_rounds_)
    if (!covered({static_cast<double>(r.round.cx), static_cast<double>(r.round.cy)}, r.bound)) rounds_.push_back(r.round);

  const auto list = [](const auto& from, auto& first, int& count) {
    first = from.data();
    count = static_cast<int>(from.size());
  };
  list(lows_, light.lows, light.low_count);
  list(highs_, light.highs, light.high_count);
  list(low_disks_, light.low_disks, light.low_disk_count);
  list(high_disks_, light.high_disks, light.high_disk_count);
  list(disks_, light.disks, light.disk_count);
  list(spans_, light.spans, light.span_count);
  list(bodies_, light.bodies, light.body_count);
  list(chords_, light.chords, light.chord_count);
  list(deep_, light.deep, light.deep_count);
  list(rounds_, light.rounds, light.round_count);
  list(lenses_, light.lenses, light.lens_count);
  light.span_vertices = vertices_.data();
}

std::size_t ShadowEnds::intervals() const {
  return disks_.size() + spans_.size() + bodies_.size() + chords_.size() + deep_.size() + rounds_.size() + 3 * lenses_.size() +
         1;  // and a spot's dark side
}

}  // namespace steradian::plane
