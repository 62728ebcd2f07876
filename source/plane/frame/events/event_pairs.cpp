#include "plane/frame/events/event_pairs.h"

#include <algorithm>

namespace steradian::plane {
namespace {

// Gathers blockers of one kind until a batch is full.
class Batch {
 public:
  Batch(void (*make)(const EventOutlines&, float), double radius) : make_(make), radius_(static_cast<float>(radius)) {}
  int add(EventPair& pair) {
    if (outlines_.count == EventOutlines::kRoom) flush();
    outlines_.to[outlines_.count] = &pair;
    return outlines_.count++;
  }
  void flush() {
    if (outlines_.count > 0) make_(outlines_, radius_);
    outlines_.count = outlines_.most_vertices = 0;
  }
  EventOutlines& outlines() { return outlines_; }

 private:
  void (*make_)(const EventOutlines&, float);
  float radius_;
  EventOutlines outlines_;
};

void set_line(EventPair& pair, int line, double x, double y, double c) {
  const double size = std::fabs(x) + std::fabs(y), scale = size > 0 ? 1 / size : 1;
  pair.lines[line][0] = static_cast<float>(x * scale);
  pair.lines[line][1] = static_cast<float>(y * scale);
  pair.lines[line][2] = static_cast<float>(c * scale);
}

// Lines of a pair that touches every square and occludes no end of the light.
void set_general(EventPair& pair) {
  for (int line = 0; line < 6; ++line) set_line(pair, line, 0, 0, line < 3 ? -kNever : kNever);
}

// Nothing is occluded on the light's side of the common chord, between the light's tangents at the crossings of the two outlines.
void set_lens(EventPair& pair, const Lens& lens, Vec2d light, double radius, Vec2d blocker) {
  set_general(pair);
  if (lens.count != 2) return;
  Vec2d n = blocker - light;
  n = n / length(n);
  set_line(pair, 0, n.x, n.y, dot(n, lens.crossings[0].at - light));
  for (int k = 0; k < 2; ++k) set_line(pair, k + 1, lens.crossings[k].light_normal.x, lens.crossings[k].light_normal.y, radius);
}

}  // namespace

void make_event_pairs(FrameScene& frame, const Emitter& disk, const std::vector<int>& blockers, std::size_t first) {
  const EventTable& table = event_table_for(active_simd());
  Batch convex(table.make_convex, disk.radius), round(table.make_round, disk.radius);
  for (std::size_t i = 0; i < blockers.size(); ++i) {
    const Blocker& b = frame.blockers[static_cast<std::size_t>(blockers[i])];
    EventPair& pair = frame.pairs[first + i];
    pair.blocker = blockers[i];
    pair.radius = static_cast<float>(b.bound);
    pair.first = static_cast<std::int32_t>(b.first);
    pair.count = static_cast<std::uint8_t>(b.count);
    const Vec2d center = b.center - disk.center;
    if (b.kind == Blocker::Kind::lens) {
      pair.kind = EventPair::Kind::lens;
      if (b.round)
        set_lens(pair, frame.lenses[static_cast<std::size_t>(b.lens)], disk.center, disk.radius, b.center);
      else
        set_general(pair);
    } else if (b.kind == Blocker::Kind::convex && b.edges == 0 && b.count <= EventOutlines::kMostVertices) {
      pair.kind = EventPair::Kind::convex;
      const int k = convex.add(pair);
      EventOutlines& o = convex.outlines();
      o.most_vertices = std::max(o.most_vertices, static_cast<int>(b.count));
      // A blocker with fewer vertices repeats the first one.
      for (int v = 0; v <= EventOutlines::kMostVertices; ++v) {
        const Vec2d at = frame.vertices[b.first + (static_cast<std::size_t>(v) < b.count ? static_cast<std::size_t>(v) : 0)] - disk.center;
        o.x[v][k] = static_cast<float>(at.x);
        o.y[v][k] = static_cast<float>(at.y);
      }
    } else if (length(center) > disk.radius + b.bound) {
      // A chain or an ellipse is no nearer than its bounding circle.
      pair.kind = b.kind == Blocker::Kind::ellipse && b.round ? EventPair::Kind::round : EventPair::Kind::general;
      const int k = round.add(pair);
      EventOutlines& o = round.outlines();
      o.x[0][k] = static_cast<float>(center.x);
      o.y[0][k] = static_cast<float>(center.y);
      o.radius[k] = static_cast<float>(b.bound);
    } else {
      pair.kind = EventPair::Kind::general;
      set_general(pair);
    }
  }
  convex.flush();
  round.flush();
  for (std::size_t i = first; i < first + blockers.size(); ++i) {
    // A general blocker has the inner lines of its bounding circle; its outer lines decide nothing.
    EventPair& pair = frame.pairs[i];
    if (pair.kind == EventPair::Kind::general)
      for (int line = 3; line < 6; ++line) set_line(pair, line, 0, 0, kNever);
  }
}

}  // namespace steradian::plane
