#include "plane/frame/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plane/frame/blocker_bins.h"
#include "plane/frame/chains.h"
#include "plane/frame/emitters.h"
#include "plane/frame/event_pairs.h"
#include "plane/frame/overlap.h"
#include "plane/frame/reaching.h"
#include "plane/frame/runs.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr std::size_t kMostVertices = 8;  // of a convex blocker; more, and edges stand alone: their tangents move less

class Preparation {
 public:
  Preparation(const World& world, Budget& budget, const FrameLights& lights) : world_(world), lights_(lights), budget_(budget) {
    frame_.world = &world;
    frame_.shines_within = lights.scene;
    frame_.general.assign(world.scene.bodies.size(), 0);
    frame_.convex.assign(world.scene.bodies.size(), 0);
  }

  FrameScene run() {
    const std::size_t bodies = world_.scene.bodies.size();
    const std::string& name = world_.scene.name;
    check_bodies();
    std::uint64_t shining = 0;
    for (std::size_t i = 0; i < bodies; ++i)
      if (body(i).light) shining += world_.first_curve[i + 1] - world_.first_curve[i];
    const std::size_t blockers = world_.curves.size() * 3 / 2 + 3 * bodies;
    budget_.take_memory(name, "its lights and what may block them",
                        blockers * kBlockerBytes + (shining + lights_.walls.size()) * sizeof(Emitter));
    for (std::size_t i = 0; i < bodies; ++i) {
      first_blocker_.push_back(frame_.blockers.size());
      add_blockers(i);
    }
    first_blocker_.push_back(frame_.blockers.size());
    for (std::size_t i = 0; i < bodies; ++i)
      if (lights_.scene && world_.scene.bodies[i].light) add_emitters(i);
    frame_.emitters.insert(frame_.emitters.end(), lights_.walls.begin(), lights_.walls.end());
    const Vec2d origin = world_.scene.origin, size{world_.scene.width, world_.scene.height};
    bins_ = BlockerBins(frame_.blockers, {origin, origin + size});
    // A power of two: it stays what it is when bodies move a little.
    double extent = std::max(size.x, size.y);
    for (const Blocker& b : frame_.blockers)
      extent = std::max({extent, std::fabs(b.center.x - origin.x), std::fabs(b.center.y - origin.y)});
    frame_.slack = 32 * 0x1p-24 * std::exp2(std::ceil(std::log2(extent)));
    if (!frame_.emitters.empty()) check_pairs();
    check_general();
    find_interiors(frame_, bins_, budget_, [this](std::uint64_t steps) { spend(steps); });
    frame_.first_nearby.push_back(0);
    frame_.whole_run.assign(frame_.emitters.size(), 0);
    for (std::size_t e = 0; e < frame_.emitters.size(); ++e) {
      frame_.whole_run[e] = is_run(frame_.emitters[e]) && is_clear(&frame_.emitters[e]);
      if (frame_.whole_run[e] != 0 || !is_run(frame_.emitters[e])) find_nearby(e);
      frame_.first_nearby.push_back(frame_.nearby.size);
    }
    spend(0);
    for (char g : frame_.general) frame_.any_general = frame_.any_general || g != 0;
    return std::move(frame_);
  }

 private:
  const PlaneBody& body(std::size_t i) const { return world_.scene.bodies[i]; }

  // A blocker with its outline, its place in a list and a tile's view of it.
  static constexpr std::size_t kBlockerBytes = sizeof(Blocker) + sizeof(PaddedOutline) + 2 * sizeof(Vec2d) + sizeof(Silhouette);
  // What it takes to hold a pair of a light's piece and a blocker in its range through the levels of a frame, and to look at it.
  static constexpr std::size_t kPairBytes = 60 + sizeof(EventPair), kPairSteps = 600;

  // A first look, before anything is made: a light without a range meets every body at least once for each of its pieces.
  void check_bodies() {
    std::uint64_t bodies = 0, pieces = 0;
    for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) {
      const std::uint64_t curves = world_.first_curve[i + 1] - world_.first_curve[i];
      bodies += curves > 0 ? 1 : 0;
      if (body(i).light && !(body(i).light->range < 1e8)) pieces += curves;
    }
    Budget look = budget_;
    const std::string what = "the " + std::to_string(pieces) + " pieces of its lights without a range and the " + std::to_string(bodies) +
                             " bodies that may block them";
    look.take_work(world_.scene.name, what, pieces * bodies * kPairSteps);
  }

  void check_pairs() {
    const BinCounts counts(bins_);
    std::uint64_t pairs = 0;
    std::size_t pieces = 0, of_disks = 0;
    for (const Emitter& e : frame_.emitters) {
      if (is_run(e)) continue;  // it takes work from its edges
      const std::size_t within = counts.within(e.center, std::min(e.range, 1e8) + e.bound);
      pairs += within;
      if (e.kind == Emitter::Kind::disk) of_disks += within;
      ++pieces;
    }
    const std::string what =
        "the " + std::to_string(pairs) + " pairs of its " + std::to_string(pieces) + " pieces of light and what may block them";
    budget_.take_work(world_.scene.name, what, pairs * kPairSteps);
    budget_.take_memory(world_.scene.name, what, pairs * kPairBytes);
    frame_.pairs.reserve(of_disks);
  }

  // Lights that only the general method serves are asked of every pixel on its own. What counts is the scene, not the picture:
  // as if it were small.
  void check_general() {
    constexpr std::uint64_t kPixels = 64 * 48;
    std::uint64_t lights = 0, steps = 0;
    for (std::size_t i = 0; i < frame_.general.size(); ++i) {
      if (frame_.general[i] == 0) continue;
      const auto& gradient = body(i).light->gradient;
      ++lights;
      steps += kPixels * (1000 + 4 * world_.curves.size() + 80 * (gradient ? gradient->stops.size() : 0));
    }
    budget_.take_work(world_.scene.name, "its " + std::to_string(lights) + " lights that are very thin ellipses", steps);
  }

  // Steps that are known only as they are made.
  void spend(std::uint64_t steps) {
    steps_ += steps;
    if (steps != 0 && steps_ < 10'000'000) return;
    budget_.take_work(world_.scene.name, "the overlaps of its lights with other shapes", steps_);
    budget_.take_memory(world_.scene.name, "the parts of shapes that overlap its lights",
                        (frame_.blockers.size() - blockers_held_) * (kBlockerBytes + sizeof(Lens)));
    blockers_held_ = frame_.blockers.size();
    steps_ = 0;
  }

  void add_convex(std::vector<Vec2d> vertices, int owner, std::vector<Blocker>& to) {
    Blocker b;
    b.body = owner;
    b.first = frame_.vertices.size();
    b.count = vertices.size();
    Box box;
    for (Vec2d v : vertices) box.add(v);
    b.center = (box.low + box.high) * 0.5;
    for (Vec2d v : vertices) b.bound = std::max(b.bound, length(v - b.center));
    frame_.vertices.insert(frame_.vertices.end(), vertices.begin(), vertices.end());
    b.outline = static_cast<int>(frame_.outlines.size());
    PaddedOutline& padded = frame_.outlines.emplace_back();
    padded.count = static_cast<int>(vertices.size());
    for (std::size_t k = 0; k <= PaddedOutline::kMost; ++k) {
      const Vec2d v = vertices[k < vertices.size() ? k : 0];
      padded.x[k] = v.x;
      padded.y[k] = v.y;
    }
    to.push_back(b);
  }

  void add_ellipse(const Ellipse& e, int owner) {
    Blocker b;
    b.kind = Blocker::Kind::ellipse;
    b.body = owner;
    b.center = e.center;
    b.x_axis = e.x;
    b.y_axis = e.y;
    b.round = is_round(e);
    b.bound = b.round ? length(e.x) : std::sqrt(dot(e.x, e.x) + dot(e.y, e.y));
    b.first = frame_.vertices.size();
    b.count = 1;
    frame_.vertices.push_back(e.center);
    frame_.blockers.push_back(b);
  }
  // The outline as one convex counter-clockwise polygon, if it is one.
  std::vector<Vec2d> convex_outline(std::size_t i) const {
    const PlaneBody& b = body(i);
    if (b.shape != PlaneBody::Shape::polygon || b.contours.size() != 1) return {};
    std::vector<Vec2d> v;
    for (Vec2d p : b.contours[0])
      if (v.empty() || !(p == v.back())) v.push_back(p);
    while (v.size() > 1 && v.front() == v.back()) v.pop_back();
    if (v.size() < 3 || v.size() > kMostVertices) return {};
    double turn = 0;
    int reflex = 0, convex = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vec2d e = v[(k + 1) % v.size()] - v[k], f = v[(k + 2) % v.size()] - v[(k + 1) % v.size()];
      (cross(e, f) > 0 ? convex : reflex) += 1;
      turn += std::atan2(cross(e, f), dot(e, f));
    }
    if ((convex != 0 && reflex != 0) || std::fabs(std::fabs(turn) - 2 * pi) > 1e-6) return {};
    if (reflex != 0) std::reverse(v.begin(), v.end());
    return v;
  }

  void add_blockers(std::size_t i) {
    const int owner = static_cast<int>(i);
    frame_.convex[i] = body(i).shape == PlaneBody::Shape::capsule || body(i).shape == PlaneBody::Shape::ellipse;
    if (body(i).shape == PlaneBody::Shape::capsule && world_.first_curve[i] < world_.first_curve[i + 1]) {
      // Two disks and the box between them: the same silhouette.
      const Vec2d p = body(i).contours[0][0], q = body(i).contours[0][1];
      const double r = body(i).radius;
      add_ellipse({p, {r, 0}, {0, r}}, owner);
      if (p == q) return;
      add_ellipse({q, {r, 0}, {0, r}}, owner);
      const Vec2d along = (q - p) / length(q - p), left = Vec2d{-along.y, along.x} * r;
      add_convex({p - left, q - left, q + left, p + left}, owner, frame_.blockers);
      return;
    }
    const std::vector<Vec2d> convex = convex_outline(i);
    if (!convex.empty()) {
      add_convex(convex, owner, frame_.blockers);
      frame_.convex[i] = 1;
      return;
    }
    bool ellipse_done = false;
    const std::size_t first_curve = world_.first_curve[i], curves = world_.first_curve[i + 1] - first_curve;
    const std::size_t first = frame_.blockers.size();
    for (std::size_t c = first_curve; c < first_curve + curves; ++c) {
      const Curve& curve = world_.curves[c];
      if (curve.kind == Curve::Kind::segment)
        add_convex({curve.a, curve.b}, owner, frame_.blockers);
      else if (!ellipse_done)
        add_ellipse(curve.ellipse, owner), ellipse_done = true;  // gradients cut an ellipse into several arcs
    }
    if (ellipse_done) return;
    for (const Chain& chain : convex_chains(&world_.curves[first_curve], curves)) {
      for (std::size_t k = 0; k < chain.count; ++k) frame_.blockers[first + chain.first + k].in_chain = true;
      add_convex(chain.hull, owner, frame_.blockers);
      frame_.blockers.back().first_edge = static_cast<int>(first + chain.first);
      frame_.blockers.back().edges = static_cast<int>(chain.count);
    }
  }

  void add_emitters(std::size_t i) {
    const std::optional<std::vector<Emitter>> emitters = emitters_of(world_, i);
    frame_.general[i] = !emitters;
    if (emitters) frame_.emitters.insert(frame_.emitters.end(), emitters->begin(), emitters->end());
  }

  // How an emitter takes a chain: its hull is a blocker only where it does not touch the emitter.
  enum class ChainView { behind, whole, edge_by_edge };
  ChainView view_of_chain(const Emitter& e, const Blocker& chain) const {
    const Vec2d* v = &frame_.vertices[chain.first];
    if (e.kind == Emitter::Kind::edge) {
      double low = 1e300, high = -1e300;
      for (std::size_t k = 0; k < chain.count; ++k) {
        const double h = dot(v[k] - e.a, e.normal);
        low = std::min(low, h);
        high = std::max(high, h);
      }
      if (high <= kTouching) return ChainView::behind;
      if (chain.body == e.body && low < 0) return ChainView::edge_by_edge;
    }
    const bool near = length(e.center - chain.center) < e.bound + chain.bound + kApart;
    const double gap = is_run(e) ? e.radius + kApart : kApart;
    return near && comes_within(gap, e, v, chain.count) ? ChainView::edge_by_edge : ChainView::whole;
  }
  static constexpr double kApart = 1e-6;

  // Does nothing else come near a run, and none of its own outline between its edges and its chord?
  bool is_clear(const Emitter* run) {
    bool clear = true;
    std::size_t first = run->curve, last = run->curve;
    for (std::size_t k = 1; k < run->group; ++k) {
      first = std::min(first, run[k].curve);
      last = std::max(last, run[k].curve);
    }
    const auto comes_near = [&](const Blocker& b) {
      if (length(run->center - b.center) >= run->bound + b.bound + kApart) return false;
      if (b.kind == Blocker::Kind::convex) return comes_within(run->radius + kApart, *run, &frame_.vertices[b.first], b.count);
      const Vec2d along = run->b - run->a, to = b.center - run->a;
      return length(to - along * std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0)) < run->radius + b.bound + kApart;
    };
    bins_.for_each_within(frame_.blockers, run->center, run->bound + kApart, [&](int k) {
      const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
      if (!clear) return;
      spend(10);
      if (b.body != run->body) {
        // Of a chain that comes near, its edges may not.
        if (!comes_near(b)) return;
        if (b.edges == 0) clear = false;
        for (int edge = b.first_edge; edge < b.first_edge + b.edges; ++edge)
          clear = clear && !comes_near(frame_.blockers[static_cast<std::size_t>(edge)]);
        return;
      }
      const auto own = [&](int edge) {
        const Blocker& e = frame_.blockers[static_cast<std::size_t>(edge)];
        const std::size_t curve = world_.first_curve[static_cast<std::size_t>(b.body)] + static_cast<std::size_t>(edge) -
                                  first_blocker_[static_cast<std::size_t>(b.body)];
        if (e.count != 2 || (curve >= first && curve <= last) || length(run->center - e.center) >= run->bound + e.bound) return;
        spend(20 * run->group);
        clear = clear && !crosses_run(run, frame_.vertices[e.first], frame_.vertices[e.first + 1]);
      };
      if (b.edges == 0) return own(k);
      for (int edge = b.first_edge; edge < b.first_edge + b.edges; ++edge) own(edge);
    });
    return clear;
  }

  // Is a blocker one of a run's own edges?
  bool is_of_run(std::size_t run, int blocker) const {
    const Emitter* e = &frame_.emitters[run];
    const auto body = static_cast<std::size_t>(e->body);
    const std::size_t curve = world_.first_curve[body] + static_cast<std::size_t>(blocker) - first_blocker_[body];
    for (std::size_t k = 1; k < e->group; ++k)
      if (!is_run(e[k]) && e[k].curve == curve) return true;
    return false;
  }

  void find_nearby(std::size_t index) {
    Emitter& e = frame_.emitters[index];
    std::vector<int> list, overlapping;
    const auto consider = [&](int k) {
      const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
      if (b.body == e.body) {
        // The rest of a concave light blocks its own edges; a convex one lies behind them.
        if (e.kind == Emitter::Kind::edge && b.count == 2 && !(is_run(e) && is_of_run(index, k))) own_edge(e, k, list);
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
    // What is further from the light than its range stands behind the last lit point.
    bins_.for_each_within(frame_.blockers, e.center, std::min(e.range, 1e8) + e.bound, [&](int k) {
      const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
      switch (b.edges == 0 ? ChainView::edge_by_edge : view_of_chain(e, b)) {
        case ChainView::behind: return;
        case ChainView::whole: return list.push_back(k);
        case ChainView::edge_by_edge: break;
      }
      if (b.edges == 0) return consider(k);
      // By value: parts of edges become blockers too, and move them all.
      for (int edge = b.first_edge, end = edge + b.edges; edge < end; ++edge) consider(edge);
    });
    for (int k : overlapping) stand_in(e, k, list);
    const bool events = e.kind == Emitter::Kind::disk;
    auto pair = static_cast<int>(frame_.pairs.size());
    if (events) append_event_pairs(frame_, e, list);
    for (int k : list) {
      const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
      const Vec2d center = b.center - world_.scene.origin;
      const auto radius = static_cast<float>(b.bound + frame_.slack);
      frame_.nearby.add(static_cast<float>(center.x), static_cast<float>(center.y), radius,
                        b.kind == Blocker::Kind::convex ? radius : -1.0f, events ? pair++ : k);
    }
  }

  void add_private(std::vector<Vec2d> vertices, int owner, std::vector<int>& list) {
    spend(300);
    list.push_back(static_cast<int>(frame_.blockers.size()));
    add_convex(std::move(vertices), owner, frame_.blockers);
  }

  // The part of p, q on the lit side of an edge.
  void add_in_front(const Emitter& e, Vec2d p, Vec2d q, int owner, std::vector<int>& list) {
    const Vec2d n = e.normal;
    double hp = dot(p - e.a, n), hq = dot(q - e.a, n);
    if (hp < hq) std::swap(p, q), std::swap(hp, hq);
    if (hp <= kTouching) return;
    if (hq < 0) q = p + (q - p) * (hp / (hp - hq));
    add_private({p, q}, owner, list);
  }

  void own_edge(const Emitter& e, int blocker, std::vector<int>& list) {
    const Blocker& b = frame_.blockers[static_cast<std::size_t>(blocker)];
    const Vec2d p = frame_.vertices[b.first], q = frame_.vertices[b.first + 1];
    const double hp = dot(p - e.a, e.normal), hq = dot(q - e.a, e.normal);
    if (std::max(hp, hq) <= kTouching) return;
    if (std::min(hp, hq) >= 0)
      list.push_back(blocker);  // all of it in front: as it is
    else
      add_in_front(e, p, q, b.body, list);
  }

  // Replaces a blocker that overlaps the emitter, or whose bounding circle does.
  void stand_in(Emitter& e, int blocker, std::vector<int>& list) {
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
      case Meeting::Kind::within: return;  // seen from inside the light only
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

  const World& world_;
  const FrameLights& lights_;
  FrameScene frame_;
  std::vector<std::size_t> first_blocker_;
  BlockerBins bins_;
  Budget& budget_;
  std::uint64_t steps_ = 0;
  std::size_t blockers_held_ = 0;
};

}  // namespace

const PlaneEmission& emission_of(const FrameScene& frame, const Emitter& e) {
  static const PlaneEmission uniform;
  return e.wall ? uniform : *frame.world->scene.bodies[static_cast<std::size_t>(e.body)].light;
}

FrameScene prepare_frame(const World& world, Budget& budget, const FrameLights& lights) { return Preparation(world, budget, lights).run(); }

}  // namespace steradian::plane
