#include "plane/frame/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plane/frame/emitters.h"
#include "plane/frame/runs/convex.h"
#include "plane/frame/runs/reaching.h"
#include "plane/frame/runs/runs.h"
#include "plane/stage/preparation.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr std::size_t kMostVertices = 8;  // most vertices of a convex blocker; with more, edges stay separate: their tangents move less

// A blocker with its outline, its place in a list and a tile's view of it.
constexpr std::size_t kBlockerBytes = sizeof(Blocker) + sizeof(PaddedOutline) + 2 * sizeof(Vec2d) + sizeof(Silhouette);
// Memory for a pair of a light's piece and a blocker in its range through the levels of a frame, and steps to test it.
constexpr std::size_t kPairBytes = 60 + sizeof(EventPair), kPairSteps = 600;

}  // namespace

Preparation::Preparation(const World& world, Budget& budget, const FrameLights& lights) : world_(world), lights_(lights), budget_(budget) {
  frame_.world = &world;
  frame_.shines_within = lights_.scene;
  if (lights_.walls.empty() || lights_.walls_at)
    frame_.light_at = [this_world = &world, scene = lights_.scene, walls = lights_.walls_at](Vec2d p) {
      Vec3d light = scene ? this_world->light_at(p).radiance : Vec3d{};
      if (walls) light += walls(p);
      return light;
    };
  const std::size_t bodies = world_.scene.bodies.size();
  const std::string& name = world_.scene.name;
  frame_.general.assign(bodies, 0);
  frame_.convex.assign(bodies, 0);
  check_bodies();
  std::uint64_t shining = 0;
  for (std::size_t i = 0; i < bodies; ++i)
    if (body(i).light) shining += world_.first_curve[i + 1] - world_.first_curve[i];
  const std::size_t blockers = 2 * world_.curves.size() + 3 * bodies;
  budget_.take_memory(name, "its lights and what may block them",
                      blockers * kBlockerBytes + (shining + lights_.walls.size()) * sizeof(Emitter));
  for (std::size_t i = 0; i < bodies; ++i) {
    first_blocker_.push_back(frame_.blockers.size());
    add_blockers(i);
    blocker_count_.push_back(frame_.blockers.size() - first_blocker_.back());
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    first_emitter_.push_back(frame_.emitters.size());
    if (lights_.scene && body(i).light) add_emitters(i);
    emitter_count_.push_back(frame_.emitters.size() - first_emitter_.back());
  }
  frame_.emitters.insert(frame_.emitters.end(), lights_.walls.begin(), lights_.walls.end());
  const Vec2d origin = world_.scene.origin, size{world_.scene.width, world_.scene.height};
  bins_ = BlockerBins(frame_.blockers, {origin, origin + size});
  frame_.slack = find_slack();
  if (!frame_.emitters.empty()) check_pairs();
  check_general();
  find_interiors(frame_, bins_, budget_, [this](std::uint64_t steps) { spend(steps); });
  for (std::size_t e = 0; e < frame_.emitters.size(); ++e) make_list(e);
  made_blockers_ = frame_.blockers.size();
  frame_.first_nearby.resize(frame_.emitters.size() + 1, frame_.nearby.size);
  frame_.first_nearby.back() = frame_.nearby.size;
  spend(0);
  for (char g : frame_.general) frame_.any_general = frame_.any_general || g != 0;
  made_bodies_ = bodies;
  made_pairs_ = frame_.nearby.size;
  dirty_.resize(frame_.emitters.size());
  dirty_interior_.resize(bodies);
}

// A power of two: it does not change when bodies move a little.
double Preparation::find_slack() const {
  const Vec2d origin = world_.scene.origin;
  double extent = std::max(world_.scene.width, world_.scene.height);
  for (std::size_t i = 0; i < first_blocker_.size(); ++i)
    for (std::size_t k = first_blocker_[i]; k < first_blocker_[i] + blocker_count_[i]; ++k) {
      const Vec2d at = frame_.blockers[k].center - origin;
      extent = std::max({extent, std::fabs(at.x), std::fabs(at.y)});
    }
  return 32 * 0x1p-24 * std::exp2(std::ceil(std::log2(extent)));
}

// A first check, before anything is computed: a light without a range meets every body at least once for each of its pieces.
void Preparation::check_bodies() {
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

void Preparation::check_pairs() {
  const BinCounts counts(bins_);
  std::uint64_t pairs = 0;
  std::size_t pieces = 0, of_disks = 0;
  for (const Emitter& e : frame_.emitters) {
    if (is_run(e)) continue;  // it saves work that is counted for its edges
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

// Lights that only the general method serves are evaluated for every pixel on its own. The check depends on the scene, not on the picture:
// it assumes a small picture.
void Preparation::check_general() {
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

// Counts steps whose number is known only while they are done.
void Preparation::spend(std::uint64_t steps) {
  steps_ += steps;
  if (steps != 0 && steps_ < 10'000'000) return;
  budget_.take_work(world_.scene.name, "the overlaps of its lights with other shapes", steps_);
  budget_.take_memory(world_.scene.name, "the parts of shapes that overlap its lights",
                      (frame_.blockers.size() - blockers_held_) * (kBlockerBytes + sizeof(Lens)));
  blockers_held_ = frame_.blockers.size();
  steps_ = 0;
}

void Preparation::add_convex(const std::vector<Vec2d>& vertices, int owner) {
  Blocker b;
  b.body = owner;
  b.first = frame_.vertices.size();
  b.count = vertices.size();
  Box2d box;
  for (Vec2d v : vertices) box.add(v);
  b.center = box.center();
  for (Vec2d v : vertices) b.bound = std::max(b.bound, length(v - b.center));
  frame_.vertices.insert(frame_.vertices.end(), vertices.begin(), vertices.end());
  if (vertices.size() > PaddedOutline::kMost) {
    frame_.blockers.push_back(b);
    return;
  }
  b.outline = static_cast<int>(frame_.outlines.size());
  PaddedOutline& padded = frame_.outlines.emplace_back();
  padded.count = static_cast<int>(vertices.size());
  for (std::size_t k = 0; k <= PaddedOutline::kMost; ++k) {
    const Vec2d v = vertices[k < vertices.size() ? k : 0];
    padded.x[k] = v.x;
    padded.y[k] = v.y;
  }
  frame_.blockers.push_back(b);
}

void Preparation::add_ellipse(const PlaneEllipse& e, int owner) {
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
std::vector<Vec2d> Preparation::convex_outline(std::size_t i) const {
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

void Preparation::add_blockers(std::size_t i) {
  const int owner = static_cast<int>(i);
  frame_.convex[i] = body(i).shape == PlaneBody::Shape::capsule || body(i).shape == PlaneBody::Shape::ellipse;
  if (body(i).shape == PlaneBody::Shape::capsule && world_.first_curve[i] < world_.first_curve[i + 1]) {
    // Two disks and the box between them have the same silhouette.
    const Vec2d p = body(i).contours[0][0], q = body(i).contours[0][1];
    const double r = body(i).radius;
    add_ellipse({p, {r, 0}, {0, r}}, owner);
    if (p == q) return;
    add_ellipse({q, {r, 0}, {0, r}}, owner);
    const Vec2d along = (q - p) / length(q - p), left = Vec2d{-along.y, along.x} * r;
    add_convex({p - left, q - left, q + left, p + left}, owner);
    return;
  }
  const std::vector<Vec2d> convex = convex_outline(i);
  if (!convex.empty()) {
    add_convex(convex, owner);
    frame_.convex[i] = 1;
    return;
  }
  bool ellipse_done = false;
  const std::size_t first_curve = world_.first_curve[i], curves = world_.first_curve[i + 1] - first_curve;
  const std::size_t first = frame_.blockers.size();
  for (std::size_t c = first_curve; c < first_curve + curves; ++c) {
    const Curve& curve = world_.curves[c];
    if (curve.kind == Curve::Kind::segment)
      add_convex({curve.a, curve.b}, owner);
    else if (!ellipse_done)
      add_ellipse(curve.ellipse, owner), ellipse_done = true;  // gradients cut an ellipse into several arcs
  }
  if (ellipse_done) return;
  const std::vector<Chain> chains = convex_chains(&world_.curves[first_curve], curves);
  const std::size_t first_chain = frame_.blockers.size();
  for (const Chain& chain : chains) {
    for (std::size_t k = 0; k < chain.count; ++k) ++frame_.blockers[first + chain.first + k].level;
    add_convex(chain.hull, owner);
    frame_.blockers.back().first_edge = static_cast<int>(first + chain.first);
    frame_.blockers.back().edges = static_cast<int>(chain.count);
  }
  for (const Chain& outline : closed_outlines(&world_.curves[first_curve], curves)) {
    const auto begin = std::find_if(chains.begin(), chains.end(), [&](const Chain& c) { return c.first >= outline.first; });
    const auto end = std::find_if(begin, chains.end(), [&](const Chain& c) { return c.first >= outline.first + outline.count; });
    if (end != begin && (end - 1)->first + (end - 1)->count > outline.first + outline.count) continue;  // the last chain leads on
    if (begin != chains.begin() && (begin - 1)->first + (begin - 1)->count > outline.first) continue;
    Blocker whole;
    whole.first_edge = static_cast<int>(first + outline.first);
    whole.edges = static_cast<int>(outline.count);
    whole.first_chain = static_cast<int>(first_chain) + static_cast<int>(begin - chains.begin());
    whole.chains = static_cast<int>(end - begin);
    for (int k = whole.first_edge; k < whole.first_edge + whole.edges; ++k) ++frame_.blockers[static_cast<std::size_t>(k)].level;
    for (int k = whole.first_chain; k < whole.first_chain + whole.chains; ++k) ++frame_.blockers[static_cast<std::size_t>(k)].level;
    add_convex(outline.hull, owner);
    Blocker& made = frame_.blockers.back();
    made.first_edge = whole.first_edge;
    made.edges = whole.edges;
    made.first_chain = whole.first_chain;
    made.chains = whole.chains;
  }
}

void Preparation::add_emitters(std::size_t i) {
  const std::optional<std::vector<Emitter>> emitters = emitters_of(world_, i);
  frame_.general[i] = !emitters;
  if (emitters) frame_.emitters.insert(frame_.emitters.end(), emitters->begin(), emitters->end());
}

const PlaneEmission& emission_of(const FrameScene& frame, const Emitter& e) {
  static const PlaneEmission uniform;
  return e.wall ? uniform : *frame.world->scene.bodies[static_cast<std::size_t>(e.body)].light;
}

FrameScene prepare_frame(const World& world, Budget& budget, const FrameLights& lights) {
  return std::move(Preparation(world, budget, lights).frame());
}

}  // namespace steradian::plane
