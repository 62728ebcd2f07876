// Blockers that may lie between an emitter and the places that it lights, and replacements of a blocker that overlaps it.
#include <algorithm>
#include <cmath>

#include "plane/frame/events/event_walk.h"
#include "plane/frame/runs/overlap.h"
#include "plane/frame/runs/runs.h"
#include "plane/stage/preparation.h"

namespace steradian::plane {
namespace {

constexpr double kApart = 1e-6;

bool is_around(const Emitter& e) { return is_run(e) && e.shape == Emitter::RunShape::around; }
bool has_no_chord(const Emitter& e) { return is_run(e) && (e.shape == Emitter::RunShape::closed || e.shape == Emitter::RunShape::around); }

}  // namespace

// Writes the list of an emitter to its place if the capacity is enough, or to the end.
void Preparation::make_list(std::size_t index) {
  Emitter& e = frame_.emitters[index];
  if (index >= frame_.nearby_count.size()) {
    frame_.first_nearby.resize(index + 2, frame_.nearby.size);
    frame_.nearby_count.push_back(0);
    frame_.whole_run.push_back(0);
    frame_.filled_run.push_back(0);
    room_.push_back(0);
    first_pair_.push_back(0);
  }
  e.hidden = false;
  // A hole is never visible as one run: its entry exists to be dropped together with the emitters that it represents.
  const bool hole = is_run(e) && e.shape == Emitter::RunShape::hole;
  bool filled = is_around(e);
  frame_.whole_run[index] = is_run(e) && (hole || is_clear(&e, filled));
  frame_.filled_run[index] = filled && frame_.whole_run[index] != 0;
  std::vector<int> list;
  if (!hole && (frame_.whole_run[index] != 0 || !is_run(e))) find_nearby(index, list);
  write_list(index, list);
}

void Preparation::write_list(std::size_t index, const std::vector<int>& list) {
  const Emitter& e = frame_.emitters[index];
  const bool events = e.kind == Emitter::Kind::disk, made = made_pairs_ != 0;
  std::size_t& first = frame_.first_nearby[index];
  int pair = 0;
  if (list.size() > room_[index] || !made) {
    // Lists that have been rebuilt may grow a little.
    room_[index] = made ? list.size() + list.size() / 4 + 8 : list.size();
    first = frame_.nearby.size;
    frame_.nearby.reserve_more(room_[index]);
    frame_.nearby.size += room_[index];
    pair = static_cast<int>(frame_.pairs.size());
    if (events) frame_.pairs.resize(frame_.pairs.size() + room_[index]);
  } else if (events && !list.empty()) {
    pair = first_pair_[index];
  }
  first_pair_[index] = pair;
  frame_.nearby_count[index] = list.size();
  if (events) make_event_pairs(frame_, e, list, static_cast<std::size_t>(pair));
  for (std::size_t i = 0; i < list.size(); ++i) {
    const int k = list[i];
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
    const Vec2d center = b.center - world_.scene.origin;
    const auto radius = static_cast<float>(b.bound + frame_.slack);
    frame_.nearby.set(first + i, static_cast<float>(center.x), static_cast<float>(center.y), radius,
                      b.kind == Blocker::Kind::convex ? radius : -1.0f, events ? pair++ : k);
  }
}

Preparation::ChainView Preparation::view_of_chain(const Emitter& e, const Blocker& chain) const {
  // A light's own outline may be behind it in one part and in front in another. Event lines take chains.
  if (chain.chains != 0 && (chain.body == e.body || e.kind == Emitter::Kind::disk)) return ChainView::edge_by_edge;
  const Vec2d* v = &frame_.vertices[chain.first];
  if (has_no_chord(e)) {
    // If an outline crosses itself, a chain may continue from one closed run of the body to the next.
    bool behind = chain.body == e.body;
    for (int k = 0; k < chain.edges && behind; ++k) behind = is_behind_outline(e, chain.first_edge + k);
    if (behind) return ChainView::behind;
  } else if (e.kind == Emitter::Kind::edge) {
    Interval<double> heights;
    for (std::size_t k = 0; k < chain.count; ++k) heights.add(dot(v[k] - e.a, e.normal));
    if (heights.high <= kTouching) return ChainView::behind;
    if (chain.body == e.body && heights.low < 0) return ChainView::edge_by_edge;
  }
  const bool near = length(e.center - chain.center) < e.bound + chain.bound + kApart;
  return near && comes_within(kApart, e, v, chain.count) ? ChainView::edge_by_edge : ChainView::whole;
}

// Does an edge of the same body belong to a closed run, or lie within its hull? Then it is not visible from outside.
bool Preparation::is_behind_outline(const Emitter& run, int edge) const {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(edge)];
  return holds(region_of(run), frame_.vertices[b.first]) && holds(region_of(run), frame_.vertices[b.first + 1]);
}

// Does nothing else come near a run, and none of its own outline come between its edges and its chord?
// Clears `filled` if some of its own outlines lie within it.
bool Preparation::is_clear(const Emitter* run, bool& filled) {
  bool clear = true;
  const auto comes_near = [&](const Blocker& b) {
    if (length(run->center - b.center) >= run->bound + b.bound + kApart) return false;
    spend(run->hull.size());
    if (b.kind == Blocker::Kind::convex) return comes_within(kApart, *run, &frame_.vertices[b.first], b.count);
    const ConvexRegion hull = region_of(*run);
    return holds(hull, b.center) || length(b.center - nearest_of(hull, b.center)) < b.bound + kApart;
  };
  bins_.for_each_within(frame_.blockers, run->center, run->bound + kApart, [&](int k) {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
    if (!clear) return;
    spend(10);
    if (b.body != run->body) {
      // A chain may come near although its edges do not.
      if (!comes_near(b)) return;
      if (b.edges == 0) clear = false;
      for (int edge = b.first_edge; edge < b.first_edge + b.edges; ++edge)
        clear = clear && !comes_near(frame_.blockers[static_cast<std::size_t>(edge)]);
      return;
    }
    // The inside of a closed run's outline is not visible, and nothing of it crosses.
    if (has_no_chord(*run) && !is_around(*run)) return;
    const auto between = [&](int edge) {
      const Blocker& e = frame_.blockers[static_cast<std::size_t>(edge)];
      if (!clear || !comes_near(e) || is_of_run(run, edge)) return;
      spend(10 * run->group);
      filled = false;
      clear = is_within_outline(run, (frame_.vertices[e.first] + frame_.vertices[e.first + e.count - 1]) * 0.5);
    };
    const auto own = [&](int edge) {
      const Blocker& e = frame_.blockers[static_cast<std::size_t>(edge)];
      if (e.count != 2 || length(run->center - e.center) >= run->bound + e.bound || is_of_run(run, edge)) return;
      spend(20 * run->group);
      clear = clear && !crosses_run(run, frame_.vertices[e.first], frame_.vertices[e.first + 1]);
    };
    const auto look = [&](int edge) { is_around(*run) ? between(edge) : own(edge); };
    if (b.edges == 0) return look(k);
    for (int edge = b.first_edge; edge < b.first_edge + b.edges; ++edge) look(edge);
  });
  return clear;
}

// Index in the world of an edge of an emitter's own body.
std::size_t Preparation::curve_of(const Emitter& e, int blocker) const {
  const auto body = static_cast<std::size_t>(e.body);
  return world_.first_curve[body] + static_cast<std::size_t>(blocker) - first_blocker_[body];
}

// Is a blocker one of a run's own edges, or does it have some of them as parts?
bool Preparation::is_of_run(const Emitter* run, int blocker) const {
  const std::size_t curve = curve_of(*run, blocker);
  for (std::size_t k = 1; k < run->group; ++k)
    if (!is_run(run[k]) && run[k].curve == curve) return true;
  return false;
}

void Preparation::find_nearby(std::size_t index, std::vector<int>& list) {
  Emitter& e = frame_.emitters[index];
  std::vector<int> overlapping;
  const auto consider = [&](int k) {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
    if (b.body == e.body) {
      // The rest of a concave light blocks its own edges; a convex one lies behind them.
      if (has_no_chord(e)) {
        if (!is_behind_outline(e, k)) list.push_back(k);
      } else if (e.kind == Emitter::Kind::edge && b.count == 2) {
        if (is_run(e) && is_of_run(&e, k))
          rest_of_edge(e, k, list);
        else
          own_edge(e, k, list);
      }
      return;
    }
    // Nothing else overlaps a run: is_clear.
    if (is_run(e)) return list.push_back(k);
    const bool near = length(e.center - b.center) < e.bound + b.bound;
    if (near && (b.kind != Blocker::Kind::convex || overlaps(e, &frame_.vertices[b.first], b.count)))
      overlapping.push_back(k);
    else
      list.push_back(k);
  };
  const std::function<void(int)> visit = [&](int k) {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
    if (e.lid && b.body != e.body) return;  // within the hull there is nothing else
    if (b.edges == 0) return consider(k);
    switch (view_of_chain(e, b)) {
      case ChainView::behind: return;
      case ChainView::whole: return list.push_back(k);
      case ChainView::edge_by_edge: return for_each_part(frame_.blockers, k, visit);
    }
  };
  // A blocker further from the light than its range is behind the last lit point.
  bins_.for_each_within(frame_.blockers, e.center, std::min(e.range, 1e8) + e.bound, visit);
  for (int k : overlapping) stand_in(e, k, list);
}

void Preparation::add_private(const std::vector<Vec2d>& vertices, int owner, std::vector<int>& list) {
  spend(300);
  list.push_back(static_cast<int>(frame_.blockers.size()));
  add_convex(vertices, owner);
}

// Adds the part of p, q on the lit side of an edge.
void Preparation::add_in_front(const Emitter& e, Vec2d p, Vec2d q, int owner, std::vector<int>& list) {
  const Vec2d n = e.normal;
  double hp = dot(p - e.a, n), hq = dot(q - e.a, n);
  if (hp < hq) std::swap(p, q), std::swap(hp, hq);
  if (hp <= kTouching) return;
  if (hq < 0) q = p + (q - p) * (hp / (hp - hq));
  add_private({p, q}, owner, list);
}

void Preparation::own_edge(const Emitter& e, int blocker, std::vector<int>& list) {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  const Vec2d p = frame_.vertices[b.first], q = frame_.vertices[b.first + 1];
  const double hp = dot(p - e.a, e.normal), hq = dot(q - e.a, e.normal);
  if (std::max(hp, hq) <= kTouching) return;
  if (std::min(hp, hq) >= 0)
    list.push_back(blocker);  // all of it is in front: unchanged
  else
    add_in_front(e, p, q, b.body, list);
}

// A run may have only some parts of an edge that a gradient cuts. The other parts may occlude its further edges, like those of a line that
// emits light to both sides.
void Preparation::rest_of_edge(const Emitter& run, int blocker, std::vector<int>& list) {
  const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
  const Vec2d p = frame_.vertices[b.first], q = frame_.vertices[b.first + 1];
  const int body = b.body;
  const auto rest = [&](const Emitter& outer, Vec2d end, Vec2d away) {
    if (outer.curve != curve_of(run, blocker)) return;
    const Vec2d other = dot(p - end, away) > dot(q - end, away) ? p : q;
    if (dot(other - end, away) > kTouching * length(away)) add_in_front(run, other, end, body, list);
  };
  const Emitter *first = nullptr, *last = nullptr;
  for (const Emitter* e = &run + 1; e < &run + run.group; ++e)
    if (!is_run(*e)) first = first == nullptr ? e : first, last = e;
  rest(*first, run.a, first->a - first->b);
  rest(*last, run.b, last->b - last->a);
}

// Replaces a blocker that overlaps the emitter, or whose bounding circle does.
void Preparation::stand_in(Emitter& e, int blocker, std::vector<int>& list) {
  Blocker b = frame_.blockers[static_cast<std::size_t>(blocker)];
  if (b.kind == Blocker::Kind::convex) {
    for (std::size_t k = 0; k < b.count; ++k) {
      const Vec2d p = frame_.vertices[b.first + k], q = frame_.vertices[b.first + (k + 1) % b.count];
      if (e.kind == Emitter::Kind::edge) {
        add_in_front(e, p, q, b.body, list);
      } else {
        const SegmentParts parts = parts_outside(ellipse_of(e), p, q);
        for (int i = 0; i < parts.count; ++i) add_private({parts.from[i], parts.to[i]}, b.body, list);
      }
      if (b.count == 2) break;
    }
    return;
  }
  spend(2000);
  const Meeting meeting = meet(e, {b.center, b.x_axis, b.y_axis});
  switch (meeting.kind) {
    case Meeting::Kind::within: return;  // visible from inside the light only
    case Meeting::Kind::hides: e.hidden = true; return;
    case Meeting::Kind::apart:
      if (b.round && e.kind != Emitter::Kind::arc) return list.push_back(blocker);
      b.line = static_cast<int>(frame_.lines.size());
      frame_.lines.push_back(meeting.line);
      break;
    case Meeting::Kind::cross:
      b.kind = Blocker::Kind::lens;
      b.lens = static_cast<int>(frame_.lenses.size());
      frame_.lenses.push_back(meeting.lens);
  }
  list.push_back(static_cast<int>(frame_.blockers.size()));
  frame_.blockers.push_back(b);
}

}  // namespace steradian::plane
