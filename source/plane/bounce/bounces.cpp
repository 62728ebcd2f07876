#include "plane/bounce/bounces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/budget.h"
#include "plane/bounce/weigh.h"
#include "plane/extras/extras.h"
#include "steradian/error.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr double kMostAlbedo = 0.98;  // of all bounces: a closed white room would have no end of light
constexpr double kInitialParts = 32;  // elements to the picture's larger side, before any is halved
constexpr int kMostRounds = 5;
constexpr int kMostSweeps = 2000;
constexpr double kSettled = 1e-7;         // a sweep that changes less than this share of the brightest node is the last
constexpr double kErrorSettled = 1e-3;    // the same of what errors are estimated to be
constexpr double kRoughlySettled = 1e-4;  // while elements are still halved

double largest(Vec3d v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }
Vec3d times(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3d magnitude(Vec3d v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

// What a point of a wall sees: pieces of walls in front of it, and the light that arrives at once.
struct Node {
  ElementPlace place;
  std::vector<Visible> walls;
  Vec3d direct;  // integral of radiance times the cosine

  // Parts of what is seen that lie in front.
  template <class F>
  static void for_each_in_front(const Visible& v, double middle, F f) {
    for (int turn = -1; turn <= 1; ++turn) {
      Visible part = v;
      part.begin = std::max(v.begin, middle - 0.5 * pi + 2 * pi * turn);
      part.end = std::min(v.end, middle + 0.5 * pi + 2 * pi * turn);
      if (part.end > part.begin) f(part);
    }
  }
};

// All of the curve behind the line through a point, which a normal points away from.
bool lies_behind(const Curve& c, Vec2d at, Vec2d normal) {
  if (c.kind == Curve::Kind::segment) return dot(c.a - at, normal) < 0 && dot(c.b - at, normal) < 0;
  return dot(c.ellipse.center - at, normal) < -std::hypot(dot(c.ellipse.x, normal), dot(c.ellipse.y, normal));
}

Node look(const World& world, const Elements& elements, const Element& element, double share) {
  Node node;
  node.place = place_on(world, element, share);
  const Vec2d at = node.place.at, normal = node.place.normal;
  if (!is_open(world, node.place)) return node;
  thread_local std::vector<const Curve*> curves;
  curves.clear();
  for (std::size_t c = 0; c < world.curves.size(); ++c)
    if (c != element.curve && !lies_behind(world.curves[c], at, normal)) curves.push_back(&world.curves[c]);
  PlaneLight lights;
  for (const Visible& v : lower_envelope(curves, at, world.scene.bodies, {-1})) {
    const auto& light = world.scene.bodies[static_cast<std::size_t>(v.curve->body)].light;
    Node::for_each_in_front(v, angle_of(normal), [&](const Visible& part) {
      if (light) add_emission(part, *light, at, EmissionParts::radiance_and_moments, lights);
      if (elements.reflects(part, world)) node.walls.push_back(part);
    });
  }
  node.direct = lights.moment_x * normal.x + lights.moment_y * normal.y;
  return node;
}

// The integral of what the elements send, over the directions of a node's pieces, times the cosine.
class Row {
 public:
  struct Weight {
    std::size_t element;
    double constant, slope;
  };

  Row() = default;
  Row(const World& world, const Elements& elements, const Node& node) {
    for (const Visible& v : node.walls) add(world, elements, node, v);
  }

  // After some elements have been halved: what other walls send stays as it is.
  void follow(const World& world, const Elements& before, const Elements& elements, const Node& node) {
    const Row old = std::move(*this);
    *this = {};
    std::size_t at = 0;
    for (std::size_t k = 0; k < node.walls.size(); ++k) {
      const auto [was_first, was_last] = before.of(node.walls[k], world);
      const auto [first, last] = elements.of(node.walls[k], world);
      if (last - first != was_last - was_first) {
        add(world, elements, node, node.walls[k]);
      } else {
        for (std::size_t i = at; i < old.ends_[k]; ++i)
          weights_.push_back({old.weights_[i].element - was_first + first, old.weights_[i].constant, old.weights_[i].slope});
        ends_.push_back(weights_.size());
      }
      at = old.ends_[k];
    }
  }

  template <class Value>
  Vec3d gather(const std::vector<Element>& elements, Value value) const {
    Vec3d sum;
    for (const Weight& w : weights_) sum += value(elements[w.element], w);
    return sum;
  }

 private:
  void add(const World& world, const Elements& elements, const Node& node, const Visible& v) {
    weigh(world, elements, v, node.place.at, &node.place.normal, [&](std::size_t element, double w0, double w1) {
      weights_.push_back({element, w0, w1});
    });
    ends_.push_back(weights_.size());
  }
  std::vector<Weight> weights_;
  std::vector<std::size_t> ends_;  // by piece of the node's walls
};

class Solver {
 public:
  Solver(const World& world, const PlaneBounceOptions& options)
      : world_(world),
        options_(options),
        budget_(options.limits),
        elements_(world, std::max(world.scene.width, world.scene.height) / kInitialParts,
                  options.bounces == kAllBounces ? kMostAlbedo : 1.0) {}

  void run(PlaneBounces::Impl& result) {
    std::vector<char> all(elements_.all().size(), 1);
    look_at(all);
    for (stats_.rounds = 0;; ++stats_.rounds) {
      solve(kRoughlySettled);
      const std::vector<char> marked = check();
      if (stats_.rounds == kMostRounds || std::none_of(marked.begin(), marked.end(), [](char m) { return m != 0; })) break;
      halve(marked);
    }
    solve(kSettled);
    check();
    spread_error();
    stats_.elements = elements_.all().size();
    result.elements = std::move(elements_);
    result.stats = stats_;
  }

 private:
  // Of every element: two nodes at the places of Gauss' rule, and a third one between them that checks.
  static constexpr double kShares[3] = {0.5 - 0.28867513459481288, 0.5 + 0.28867513459481288, 0.5};
  struct Nodes {
    Node at[3];
    Row rows[3];
    Vec3d radiance[3];
  };

  void look_at(const std::vector<char>& fresh) {
    const std::size_t count = elements_.all().size();
    const auto looks = static_cast<std::size_t>(std::count(fresh.begin(), fresh.end(), 1));
    const std::string what =
        "what " + std::to_string(looks) + " elements of its walls see of " + std::to_string(world_.curves.size()) + " edges";
    budget_.take_work(world_.scene.name, what, 3 * looks * world_.curves.size() * 150);
    budget_.take_memory(world_.scene.name, what, 3 * looks * (sizeof(Node) + 40 * (sizeof(Visible) + sizeof(Row::Weight))));
    nodes_.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      if (fresh[i] == 0) return;
      for (int k = 0; k < 3; ++k) {
        nodes_[i].at[k] = look(world_, elements_, elements_.all()[i], kShares[k]);
        nodes_[i].rows[k] = Row(world_, elements_, nodes_[i].at[k]);
      }
    });
  }

  // What a node sends on, of what arrives at once and from all elements.
  Vec3d sent(std::size_t i, int k) const {
    const Vec3d arrives = nodes_[i].at[k].direct + nodes_[i].rows[k].gather(elements_.all(), [](const Element& e, const Row::Weight& w) {
      return e.constant * w.constant + e.slope * w.slope;
    });
    return times(elements_.all()[i].albedo, arrives) * 0.5;
  }

  // The line through an element's two nodes.
  void lay_radiance(std::size_t i) {
    const Nodes& n = nodes_[i];
    Element& e = elements_.all()[i];
    const double u0 = n.at[0].place.u, u1 = n.at[1].place.u;
    e.slope = (n.radiance[1] - n.radiance[0]) / (u1 - u0);
    e.constant = n.radiance[0] - e.slope * u0;
  }

  // All bounces go on from what is there; those that are counted begin with none.
  void solve(double settled) {
    const bool all = options_.bounces == kAllBounces;
    if (!all)
      for (Element& e : elements_.all()) e.constant = e.slope = {};
    for (int sweep = 0; sweep < (all ? kMostSweeps : options_.bounces); ++sweep) {
      ++stats_.sweeps;
      double change = 0, most = 0;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        for (int k = 0; k < (all ? 2 : 3); ++k) {
          const Vec3d next = sent(i, k);
          change = std::max(change, largest(next - nodes_[i].radiance[k]));
          most = std::max(most, largest(next));
          nodes_[i].radiance[k] = next;
        }
        // In place: what follows sees it at once. Bounces that are counted wait for the end of the sweep.
        if (all) lay_radiance(i);
      }
      if (!all)
        for (std::size_t i = 0; i < nodes_.size(); ++i) lay_radiance(i);
      if (change <= settled * most) break;
    }
  }

  // How far each element is off at its middle; those that are too far.
  std::vector<char> check() {
    std::vector<char> marked(nodes_.size(), 0);
    if (options_.bounces == kAllBounces)
      for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].radiance[2] = sent(i, 2);
    double brightest = 0;
    for (const Nodes& n : nodes_) brightest = std::max({brightest, largest(n.radiance[0]), largest(n.radiance[1])});
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Element& e = elements_.all()[i];
      e.error = magnitude(nodes_[i].radiance[2] - e.constant - e.slope * nodes_[i].at[2].place.u);
      marked[i] = largest(e.error) > options_.tolerance * brightest;
    }
    return marked;
  }

  void halve(const std::vector<char>& marked) {
    std::vector<Nodes> next;
    std::vector<char> fresh;
    for (std::size_t i = 0; i < marked.size(); ++i) {
      if (marked[i] != 0) {
        next.resize(next.size() + 2);
        fresh.insert(fresh.end(), 2, 1);
      } else {
        next.push_back(std::move(nodes_[i]));
        fresh.push_back(0);
      }
    }
    nodes_ = std::move(next);
    const Elements before = elements_;
    elements_.halve(world_, marked);
    tbb::parallel_for(std::size_t{0}, nodes_.size(), [&](std::size_t i) {
      if (fresh[i] != 0) return;
      for (int k = 0; k < 3; ++k) nodes_[i].rows[k].follow(world_, before, elements_, nodes_[i].at[k]);
    });
    look_at(fresh);
  }

  // Errors are sent on as light is.
  void spread_error() {
    std::vector<Element>& all = elements_.all();
    std::vector<Vec3d> own(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) own[i] = all[i].error;
    for (int sweep = 0; sweep < 50; ++sweep) {
      double change = 0, most = 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Vec3d arrives = nodes_[i].rows[2].gather(all, [](const Element& e, const Row::Weight& w) { return e.error * w.constant; });
        const Vec3d next = own[i] + times(all[i].albedo, arrives) * 0.5;
        change = std::max(change, largest(next - all[i].error));
        most = std::max(most, largest(next));
        all[i].error = next;
      }
      if (change <= kErrorSettled * most) break;
    }
    double size = 0, squares = 0, mean = 0;
    for (const Element& e : all) {
      const Vec3d light = magnitude(e.constant);
      size += e.half;
      mean += e.half * (light.x + light.y + light.z);
      squares += e.half * dot(e.error, e.error);
    }
    stats_.error = mean > 0 ? std::sqrt(3 * squares / size) / (mean / size) : 0;
  }

  const World& world_;
  const PlaneBounceOptions& options_;
  Budget budget_;
  Elements elements_;
  std::vector<Nodes> nodes_;
  PlaneBounceStats stats_;
};

// Calls f with every visible piece of a wall that reflects.
template <class F>
void for_each_wall(const PlaneBounces::Impl& bounces, Vec2d p, F f) {
  const World& world = *bounces.world;
  const World::Inside inside = world.inside(p);
  if (inside.dark || inside.body >= 0) return;
  thread_local std::vector<const Curve*> curves;
  curves.clear();
  for (const Curve& c : world.curves) curves.push_back(&c);
  for (const Visible& v : lower_envelope(curves, p, world.scene.bodies, {-1}))
    if (bounces.elements.reflects(v, world)) f(v);
}

}  // namespace
}  // namespace steradian::plane

namespace steradian {

PlaneBounces::PlaneBounces(const PlaneWorld& world, const PlaneBounceOptions& options) : impl_(std::make_unique<Impl>()) {
  const auto start = std::chrono::steady_clock::now();
  if (options.bounces < kAllBounces) throw Error("bounces", "must be a number of bounces, or all of them");
  if (!(options.tolerance > 0)) throw Error("tolerance", "must be positive");
  impl_->world = &world.impl();
  if (const auto& extras = world.impl().extras)
    throw Error(world.scene().name, "has " + extras->names + ", of which bounces know nothing",
                "leave bounces out, or what they know nothing of");
  if (options.bounces == 0)
    impl_->elements = plane::Elements(world.impl(), 1e300, 0);  // none: nothing reflects
  else
    plane::Solver(world.impl(), options).run(*impl_);
  impl_->stats.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

PlaneBounces::~PlaneBounces() = default;
PlaneBounces::PlaneBounces(PlaneBounces&&) noexcept = default;
PlaneBounces& PlaneBounces::operator=(PlaneBounces&&) noexcept = default;

const PlaneBounceStats& PlaneBounces::stats() const { return impl_->stats; }

PlaneLight PlaneBounces::query(Vec2d position) const {
  if (!is_finite(position)) throw Error("position", "a coordinate is not finite");
  const Vec2d p = position * impl_->world->scale, axes[2] = {{1, 0}, {0, 1}};
  PlaneLight sum;
  Vec3d* parts[3] = {&sum.radiance, &sum.moment_x, &sum.moment_y};
  plane::for_each_wall(*impl_, p, [&](const plane::Visible& v) {
    for (int k = 0; k < 3; ++k)
      plane::weigh(*impl_->world, impl_->elements, v, p, k == 0 ? nullptr : &axes[k - 1], [&](std::size_t i, double w0, double w1) {
        const plane::Element& e = impl_->elements.all()[i];
        *parts[k] += (e.constant * w0 + e.slope * w1) / (2 * std::numbers::pi);
      });
  });
  return sum;
}

Vec3d PlaneBounces::error(Vec2d position) const {
  const Vec2d p = position * impl_->world->scale;
  Vec3d sum;
  plane::for_each_wall(*impl_, p, [&](const plane::Visible& v) {
    plane::weigh(*impl_->world, impl_->elements, v, p, nullptr,
                 [&](std::size_t i, double w0, double) { sum += impl_->elements.all()[i].error * w0 / (2 * std::numbers::pi); });
  });
  return sum;
}

}  // namespace steradian
