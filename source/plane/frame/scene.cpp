#include "plane/frame/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plane/frame/blocker_bins.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr std::size_t kMostVertices = 8;  // of a convex blocker; more, and edges stand alone: their tangents move less
constexpr double kTouching = 1e-9;

bool is_full_circle(const Curve& c) {
  const double xx = dot(c.ellipse.x, c.ellipse.x), yy = dot(c.ellipse.y, c.ellipse.y);
  return c.kind == Curve::Kind::arc && c.tau_span > 2 * pi - 1e-9 && std::fabs(xx - yy) <= 1e-12 * xx &&
         std::fabs(dot(c.ellipse.x, c.ellipse.y)) <= 1e-12 * xx;
}

double distance_to_segment(Vec2d p, Vec2d a, Vec2d b) {
  const Vec2d ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / std::max(dot(ab, ab), 1e-300), 0.0, 1.0);
  return length(p - a - ab * t);
}

class Preparation {
 public:
  Preparation(const World& world, Budget& budget) : world_(world), budget_(budget) {
    frame_.world = &world;
    frame_.general.assign(world.scene.bodies.size(), 0);
    frame_.convex.assign(world.scene.bodies.size(), 0);
  }

  FrameScene run() {
    const std::size_t bodies = world_.scene.bodies.size();
    const std::string& name = world_.scene.name;
    budget_.take_memory(name, "what may block its lights", (world_.curves.size() + 3 * bodies) * kBlockerBytes);
    for (std::size_t i = 0; i < bodies; ++i) {
      first_blocker_.push_back(frame_.blockers.size());
      add_blockers(i);
    }
    first_blocker_.push_back(frame_.blockers.size());
    for (std::size_t i = 0; i < bodies; ++i)
      if (world_.scene.bodies[i].light) add_emitters(i);
    bins_ = BlockerBins(frame_.blockers);
    const Vec2d origin = world_.scene.origin, low = bins_.low(), high = bins_.high();
    slack_ = 32 * 0x1p-24 *
             std::max({std::fabs(low.x - origin.x), std::fabs(low.y - origin.y), std::fabs(high.x - origin.x), std::fabs(high.y - origin.y),
                       world_.scene.width, world_.scene.height});
    if (!frame_.emitters.empty()) check_pairs();
    check_general();
    interior();
    frame_.first_nearby.push_back(0);
    for (std::size_t e = 0; e < frame_.emitters.size(); ++e) {
      find_nearby(e);
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
  static constexpr std::size_t kPairBytes = 60, kPairSteps = 600;

  void check_pairs() {
    const BinCounts counts(bins_);
    std::uint64_t pairs = 0;
    for (const Emitter& e : frame_.emitters) pairs += counts.within(e.center, std::min(e.range, 1e8) + e.bound);
    const std::string what = fmt::format("the {} pairs of its {} pieces of light and what may block them", pairs, frame_.emitters.size());
    budget_.take_work(world_.scene.name, what, pairs * kPairSteps);
    budget_.take_memory(world_.scene.name, what, pairs * kPairBytes);
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
    budget_.take_work(world_.scene.name, fmt::format("its {} lights that are ellipses, strokes, spots or shaded by profile", lights),
                      steps);
  }

  // Steps that are known only as they are made.
  void spend(std::uint64_t steps) {
    steps_ += steps;
    if (steps != 0 && steps_ < 10'000'000) return;
    budget_.take_work(world_.scene.name, "the overlaps of its lights with other shapes", steps_);
    budget_.take_memory(world_.scene.name, "the parts of shapes that overlap its lights",
                        (frame_.outlines.size() - outlines_held_) * kBlockerBytes);
    outlines_held_ = frame_.outlines.size();
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
    frame_.blockers.push_back(b);
  }
  static bool is_round(const Ellipse& e) {
    return std::fabs(dot(e.x, e.x) - dot(e.y, e.y)) <= 1e-12 * dot(e.x, e.x) && std::fabs(dot(e.x, e.y)) <= 1e-12 * dot(e.x, e.x);
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
    for (std::size_t c = world_.first_curve[i]; c < world_.first_curve[i + 1]; ++c) {
      const Curve& curve = world_.curves[c];
      if (curve.kind == Curve::Kind::segment)
        add_convex({curve.a, curve.b}, owner, frame_.blockers);
      else if (!ellipse_done)
        add_ellipse(curve.ellipse, owner), ellipse_done = true;  // gradients cut an ellipse into several arcs
    }
  }

  void add_emitters(std::size_t i) {
    const PlaneEmission& light = *body(i).light;
    const bool spot = light.spot_axis.x != 0 || light.spot_axis.y != 0;
    const bool plain = light.profile == PlaneProfile::uniform && !light.gradient;
    const std::size_t first = world_.first_curve[i], last = world_.first_curve[i + 1];
    const std::size_t before = frame_.emitters.size();
    for (std::size_t c = first; c < last; ++c) {
      const Curve& curve = world_.curves[c];
      Emitter e;
      e.body = static_cast<int>(i);
      if (curve.kind == Curve::Kind::segment && !spot) {
        e.kind = Emitter::Kind::edge;
        // Cut where the gradient has a stop, so that radiance is linear on each.
        const std::vector<double> cuts = light.gradient ? gradient_cuts(*light.gradient, curve) : std::vector<double>{0, 1};
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
          const Curve part = part_of(curve, cuts[k], cuts[k + 1]);
          if (part.a == part.b) continue;
          e.a = part.a;
          e.b = part.b;
          e.radiance = radiance_ends(light, e.a, e.b);
          add_emitter(e);
          if (!curve.two_sided) continue;
          std::swap(e.a, e.b);
          std::swap(e.radiance.a, e.radiance.b);
          add_emitter(e);
        }
      } else if (is_full_circle(curve) && plain && !spot) {
        e.a = e.b = curve.ellipse.center;
        e.radius = length(curve.ellipse.x);
        add_emitter(e);
      } else {
        frame_.emitters.resize(before);
        frame_.general[i] = 1;
        return;
      }
    }
  }

  void add_emitter(Emitter e) {
    const Vec2d along = e.b - e.a;
    const double size = length(along);
    e.center = (e.a + e.b) * 0.5;
    e.bound = e.radius + 0.5 * size;
    if (size > 0) e.normal = Vec2d{along.y, -along.x} / size;
    e.range = body(static_cast<std::size_t>(e.body)).light->range;
    frame_.emitters.push_back(e);
  }

  void interior() {
    frame_.interior.resize(world_.scene.bodies.size());
    for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) {
      if (!body(i).light || world_.first_curve[i] == world_.first_curve[i + 1]) continue;
      const Box& mine = world_.boxes[i];
      std::vector<std::size_t> others{i};
      const Vec2d middle = (mine.low + mine.high) * 0.5;
      bins_.for_each_within(frame_.blockers, middle, 0.5 * length(mine.high - mine.low), [&](int k) {
        spend(20);
        const std::size_t o = static_cast<std::size_t>(frame_.blockers[static_cast<std::size_t>(k)].body);
        const Box& box = world_.boxes[o];
        if (box.low.x > mine.high.x || box.high.x < mine.low.x || box.low.y > mine.high.y || box.high.y < mine.low.y) return;
        if (!may_be_inside(i, frame_.blockers[static_cast<std::size_t>(k)])) return;
        others.push_back(o);
      });
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
      if (others.size() == 1) continue;  // nothing inside: the light alone
      LightInterior& inside = frame_.interior[i];
      std::size_t reaching = 0;
      for (std::size_t o : others) reaching += world_.first_curve[o + 1] - world_.first_curve[o];
      spend(20 * reaching);
      budget_.take_memory(world_.scene.name, "what reaches into its lights", reaching * (sizeof(Curve*) + sizeof(Curve)));
      for (std::size_t o : others)
        for (std::size_t c = world_.first_curve[o]; c < world_.first_curve[o + 1]; ++c) inside.curves.push_back(&world_.curves[c]);
      const Curve& own = world_.curves[world_.first_curve[i]];
      inside.by_chords = is_full_circle(own) && std::all_of(inside.curves.begin(), inside.curves.end(), [&](const Curve* c) {
                           return c == &own || (c->kind == Curve::Kind::segment && !body(static_cast<std::size_t>(c->body)).light);
                         });
      if (inside.by_chords) {
        for (const Curve* c : inside.curves) {
          if (c == &own) continue;
          if (const std::optional<Curve> part = clipped_to_circle(*c, own.ellipse)) inside.chords.push_back(*part);
        }
        continue;
      }
      inside.by_parts = is_full_circle(own) && std::all_of(inside.curves.begin(), inside.curves.end(), [&](const Curve* c) {
                          return c->kind == Curve::Kind::segment || is_full_circle(*c);
                        });
      if (!inside.by_parts) continue;
      for (const Curve* c : inside.curves) {
        if (c == &own) continue;
        const std::optional<Curve> part =
            c->kind == Curve::Kind::segment ? clipped_to_circle(*c, own.ellipse) : circle_clipped_to_circle(*c, own.ellipse);
        if (part) inside.parts.push_back(*part);
      }
    }
  }

  // Exact for round lights and among polygons; others go by their boxes.
  bool may_be_inside(std::size_t light, const Blocker& b) {
    if (b.body == static_cast<int>(light)) return true;
    const Curve& curve = world_.curves[world_.first_curve[light]];
    if (b.kind == Blocker::Kind::convex && body(light).shape == PlaneBody::Shape::polygon) return reaches_into(light, b);
    if (!is_full_circle(curve)) return true;
    Emitter disk;
    disk.a = disk.b = disk.center = curve.ellipse.center;
    disk.radius = disk.bound = length(curve.ellipse.x);
    return overlaps(disk, b);
  }

  bool reaches_into(std::size_t polygon, const Blocker& b) {
    for (std::size_t k = 0; k < b.count; ++k) {
      const Vec2d p = frame_.vertices[b.first + k], q = frame_.vertices[b.first + (k + 1) % b.count];
      spend(30 + 2 * (world_.first_curve[polygon + 1] - world_.first_curve[polygon]));
      if (world_.contains(polygon, p)) return true;
      for (std::size_t c = world_.first_curve[polygon]; c < world_.first_curve[polygon + 1]; ++c) {
        const Curve& edge = world_.curves[c];
        const Vec2d along = edge.b - edge.a, d = q - p;
        const bool apart = cross(along, p - edge.a) * cross(along, q - edge.a) > 0 || cross(d, edge.a - p) * cross(d, edge.b - p) > 0;
        if (!apart) return true;
      }
      if (b.count == 2) return world_.contains(polygon, q);
    }
    // The polygon within the body: nothing of the body's outline is in it.
    return false;
  }

  void find_nearby(std::size_t index) {
    const Emitter e = frame_.emitters[index];
    std::vector<int> list, overlapping;
    // What is further from the light than its range stands behind the last lit point.
    bins_.for_each_within(frame_.blockers, e.center, std::min(e.range, 1e8) + e.bound, [&](int k) {
      const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
      if (b.body == e.body) {
        // The rest of a concave light blocks its own edges; a convex one lies behind them.
        if (e.kind == Emitter::Kind::edge && b.count == 2) own_edge(e, k, list);
        return;
      }
      if (overlaps(e, b))
        overlapping.push_back(k);
      else
        list.push_back(k);
    });
    for (int k : overlapping)
      if (!stand_in(e, frame_.blockers[static_cast<std::size_t>(k)], list)) {
        frame_.general[static_cast<std::size_t>(e.body)] = 1;
        return;
      }
    for (int k : list) {
      const Blocker& b = frame_.blockers[static_cast<std::size_t>(k)];
      const Vec2d center = b.center - world_.scene.origin;
      const auto radius = static_cast<float>(b.bound + slack_);
      frame_.nearby.add(static_cast<float>(center.x), static_cast<float>(center.y), radius,
                        b.kind == Blocker::Kind::convex ? radius : -1.0f, k);
    }
  }

  bool overlaps(const Emitter& e, const Blocker& b) const {
    if (length(e.center - b.center) >= e.bound + b.bound) return false;
    if (b.kind != Blocker::Kind::convex) {
      // Round against what is round or thin: by distance; other ellipses by their bounding circle.
      return distance_to_segment(b.center, e.a, e.b) < e.radius + b.bound - kTouching;
    }
    const Vec2d* v = &frame_.vertices[b.first];
    if (e.kind == Emitter::Kind::disk) {
      double nearest = 1e300;
      bool inside = b.count > 2;
      for (std::size_t k = 0; k < b.count; ++k) {
        const Vec2d p = v[k], q = v[(k + 1) % b.count];
        nearest = std::min(nearest, distance_to_segment(e.a, p, q));
        inside = inside && cross(q - p, e.a - p) > 0;
      }
      return inside || nearest < e.radius - kTouching;
    }
    // Separating axes: the edges of both.
    const auto separates = [&](Vec2d p, Vec2d q) {
      const Vec2d n = Vec2d{q.y - p.y, p.x - q.x} / length(q - p);
      double low = 1e300, high = -1e300;
      for (std::size_t k = 0; k < b.count; ++k) low = std::min(low, dot(v[k] - p, n)), high = std::max(high, dot(v[k] - p, n));
      const double s = dot(e.a - p, n), t = dot(e.b - p, n);
      return std::min(s, t) >= high - kTouching || std::max(s, t) <= low + kTouching;
    };
    if (separates(e.a, e.b)) return false;
    for (std::size_t k = 0; k < b.count; ++k)
      if (separates(v[k], v[(k + 1) % b.count])) return false;
    return true;
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

  // Replaces a blocker that overlaps the emitter; false where no rule serves.
  bool stand_in(const Emitter& e, Blocker b, std::vector<int>& list) {
    if (b.kind == Blocker::Kind::convex) {
      for (std::size_t k = 0; k < b.count; ++k) {
        const Vec2d p = frame_.vertices[b.first + k], q = frame_.vertices[b.first + (k + 1) % b.count];
        if (e.kind == Emitter::Kind::edge)
          add_in_front(e, p, q, b.body, list);
        else
          add_outside_disk(e, p, q, b.body, list);
        if (b.count == 2) break;
      }
      return true;
    }
    if (e.kind != Emitter::Kind::disk || !b.round) return false;
    return add_lens(e, b, list);
  }

  void add_outside_disk(const Emitter& e, Vec2d p, Vec2d q, int owner, std::vector<int>& list) {
    const Vec2d d = q - p, c = p - e.a;
    const double a = dot(d, d), h = dot(c, d), k = dot(c, c) - e.radius * e.radius, det = h * h - a * k;
    if (det <= 0) return add_private({p, q}, owner, list);
    const double root = std::sqrt(det), t0 = (-h - root) / a, t1 = (-h + root) / a;
    if (t0 >= 1 || t1 <= 0) return add_private({p, q}, owner, list);
    const double size = std::sqrt(a);
    if (t0 * size > kTouching) add_private({p, p + d * t0}, owner, list);
    if ((1 - t1) * size > kTouching) add_private({p + d * t1, q}, owner, list);
  }

  bool add_lens(const Emitter& e, Blocker b, std::vector<int>& list) {
    const Vec2d to = b.center - e.a;
    const double d = length(to), r = e.radius, s = length(b.x_axis);
    if (d + s <= r) return true;  // within the light: seen from inside only
    if (d + r <= s) {             // the light is within: not seen from outside. A box around it, as its own edges.
      frame_.general[static_cast<std::size_t>(e.body)] = 1;
      return false;
    }
    const double along = (d * d + r * r - s * s) / (2 * d), across = std::sqrt(std::max(r * r - along * along, 0.0));
    const Vec2d u = to / d, v{-u.y, u.x};
    b.kind = Blocker::Kind::lens;
    for (int k = 0; k < 2; ++k) {
      const Vec2d at = e.a + u * along + v * (k == 0 ? across : -across);
      const Vec2d nl = (at - e.a) / r, nb = (at - b.center) / s;
      const int place = cross(nl, nb) > 0 ? 0 : 1;
      b.crossing[place] = at;
      b.light_normal[place] = nl;
      b.blocker_normal[place] = nb;
    }
    list.push_back(static_cast<int>(frame_.blockers.size()));
    frame_.blockers.push_back(b);
    return true;
  }

  const World& world_;
  FrameScene frame_;
  std::vector<std::size_t> first_blocker_;
  BlockerBins bins_;
  Budget& budget_;
  std::uint64_t steps_ = 0;
  std::size_t outlines_held_ = 0;
  double slack_ = 0;  // of circles in float: a few roundings of the scene's size
};

}  // namespace

FrameScene prepare_frame(const World& world, Budget& budget) { return Preparation(world, budget).run(); }

}  // namespace steradian::plane
