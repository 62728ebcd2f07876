#include "plane/bounce/bounces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <span>

#include "core/budget.h"
#include "plane/bounce/fixed_point.h"
#include "plane/bounce/outlook.h"
#include "plane/bounce/rows.h"
#include "plane/bounce/weigh.h"
#include "plane/extras/extras.h"
#include "steradian/error.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

constexpr double kMostAlbedo = 0.98;  // for all bounces: in a closed white room light would never end
constexpr double kInitialParts = 32;  // elements along the picture's larger side, before any is halved
constexpr int kMostRounds = 5;
constexpr int kMostSweeps = 2000;
constexpr double kSettled = 1e-14;        // a sweep that changes less than this fraction of the brightest value is the last
constexpr double kErrorSettled = 1e-3;    // the same for the estimates of errors
constexpr double kRoughlySettled = 1e-4;  // while elements are still halved

double largest(Vec3d v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }
Vec3d times(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3d magnitude(Vec3d v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

// View from a point of a wall: parts of walls in front of it, and the direct light.
struct WallNode {
  ElementPlace place;
  std::vector<SeenPart> walls;
  Vec3d direct;  // integral of radiance times the cosine
};

WallNode look(const World& world, const Outlook& outlook, const BoundaryElements& elements, const BoundaryElement& element, double share) {
  WallNode node;
  node.place = place_on(world, element, share);
  const Vec2d at = node.place.at, normal = node.place.normal;
  if (!is_open(world, node.place)) return node;
  thread_local std::vector<SeenPart> parts;
  outlook.look(&world.curves[element.curve], at, normal, parts);
  PlaneLight lights;
  for (const SeenPart& part : parts) {
    if (const auto& light = world.scene.bodies[static_cast<std::size_t>(part.curve->body)].light) {
      const SeenAngles angles = angles_of(part, normal);
      for (int k = 0; k < angles.count; ++k) add_emission(angles.parts[k], *light, at, EmissionParts::radiance_and_moments, lights);
    }
    if (elements.reflects(part, world)) node.walls.push_back(part);
  }
  node.direct = lights.moment_x * normal.x + lights.moment_y * normal.y;
  return node;
}

// The integral of the elements' radiance, over the directions of a node's parts, times the cosine.
class WallRow {
 public:
  WallRow() = default;
  WallRow(const RowsTable& table, const World& world, const BoundaryElements& elements, const WallNode& node) {
    Making& making = begin();
    for (std::size_t k = 0; k < node.walls.size(); ++k) add(world, elements, node, k, making);
    finish(table, node.place.normal, making);
  }

  // Updates the row after some elements have been halved: the weights of other walls stay the same.
  void follow(const RowsTable& table, const World& world, const BoundaryElements& before, const BoundaryElements& elements,
              const WallNode& node) {
    Making& making = begin();
    std::size_t at = 0;
    for (std::size_t k = 0; k < node.walls.size(); ++k) {
      const auto [was_first, was_last] = before.of(node.walls[k], world);
      const auto [first, last] = elements.of(node.walls[k], world);
      const std::size_t end = ends_[k];
      if (last - first != was_last - was_first) {
        add(world, elements, node, k, making);
      } else {
        for (std::size_t i = at; i < end; ++i) making.elements.push_back(static_cast<std::uint32_t>(elements_[i] - was_first + first));
        making.weights.insert(making.weights.end(), weights_.begin() + static_cast<std::ptrdiff_t>(at),
                              weights_.begin() + static_cast<std::ptrdiff_t>(end));
        making.part_ends.push_back(making.weights.size());
      }
      at = end;
    }
    finish(table, node.place.normal, making);
  }

  Vec3d gather(const RowsTable& table, const std::vector<ElementLine>& lines) const {
    const auto sum = table.gather(elements_, weights_.data(), lines.data());
    return {sum[0], sum[1], sum[2]};
  }

 private:
  // A row under construction. Pieces of segments wait until the ends of all of them are known.
  struct Making {
    struct Piece {
      SeenPiece seen;
      std::size_t end, weight;  // index of its first end and its first weight
    };
    EndColumns ends;
    std::vector<Piece> pieces;
    std::vector<std::uint32_t> elements;
    std::vector<ElementWeight> weights;
    std::vector<std::size_t> part_ends;
  };
  static Making& begin() {
    thread_local Making making;
    making.ends.count = 0;
    making.pieces.clear();
    making.elements.clear();
    making.part_ends.clear();
    making.weights.clear();
    return making;
  }

  static void add(const World& world, const BoundaryElements& elements, const WallNode& node, std::size_t k, Making& making) {
    const SeenPart& part = node.walls[k];
    const Vec2d at = node.place.at, normal = node.place.normal;
    if (part.curve->kind == Curve::Kind::segment) {
      const SeenPiece seen(*part.curve, at, direction_of(part.begin, normal), direction_of(part.end, normal), elements,
                           elements.of(part, world));
      making.pieces.push_back({seen, making.ends.count, making.weights.size()});
      seen.for_each_end([&](double t) { making.ends.add(t); });
      for (std::size_t i = seen.first(); i < seen.last(); ++i) making.elements.push_back(static_cast<std::uint32_t>(i));
      making.weights.resize(making.elements.size());
    } else {
      const SeenAngles angles = angles_of(part, normal);
      for (int i = 0; i < angles.count; ++i)
        weigh(world, elements, angles.parts[i], at, &normal, [&](std::size_t element, double w0, double w1) {
          making.elements.push_back(static_cast<std::uint32_t>(element));
          making.weights.push_back({w0, w1});
        });
    }
    making.part_ends.push_back(making.weights.size());
  }

  void finish(const RowsTable& table, Vec2d normal, Making& making) {
    table.evaluate(making.ends);
    for (const Making::Piece& piece : making.pieces) {
      ElementWeight* weight = making.weights.data() + piece.weight;
      piece.seen.for_each_weight(
          piece.end, [&](std::size_t k) { return piece.seen.with_cosine(making.ends[k], normal); },
          // u is nowhere above 1, and nothing is visible from behind.
          [&](std::size_t, double w0, double w1) {
            *weight++ = {w0, std::clamp(w1, -std::fabs(w0), std::fabs(w0))};
          });
    }
    elements_ = making.elements;
    weights_ = making.weights;
    ends_ = making.part_ends;
  }

  std::vector<std::uint32_t> elements_;
  std::vector<ElementWeight> weights_;  // of each element
  std::vector<std::size_t> ends_;       // by part of the node's walls
};

class WallSolver {
 public:
  WallSolver(const World& world, const PlaneBounceOptions& options)
      : world_(world),
        options_(options),
        budget_(options.limits),
        outlook_(world),
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
    if (options_.bounces == kAllBounces) {
      solve(kSettled);
      check();
    }
    spread_error();
    stats_.elements = elements_.all().size();
    result.elements = std::move(elements_);
    result.stats = stats_;
  }

 private:
  // Nodes of every element: two at the places of Gauss' rule, and a third one between them for the error check.
  static constexpr double kShares[3] = {0.5 - 0.28867513459481288, 0.5 + 0.28867513459481288, 0.5};
  struct Nodes {
    WallNode at[3];
    WallRow rows[3];
    Vec3d middle;  // radiance of the third one
  };
  using Lines = std::vector<ElementLine>;

  void look_at(const std::vector<char>& fresh) {
    const std::size_t count = elements_.all().size();
    const auto looks = static_cast<std::size_t>(std::count(fresh.begin(), fresh.end(), 1));
    const std::string what =
        "what " + std::to_string(looks) + " elements of its walls see of " + std::to_string(world_.curves.size()) + " edges";
    budget_.take_work(world_.scene.name, what, 3 * looks * world_.curves.size() * 150);
    budget_.take_memory(world_.scene.name, what, 3 * looks * (sizeof(WallNode) + 40 * (sizeof(SeenPart) + 4 * sizeof(ElementWeight))));
    nodes_.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      if (fresh[i] == 0) return;
      for (int k = 0; k < 3; ++k) {
        nodes_[i].at[k] = look(world_, outlook_, elements_, elements_.all()[i], kShares[k]);
        nodes_[i].rows[k] = WallRow(table_, world_, elements_, nodes_[i].at[k]);
      }
    });
  }

  // Radiance that a node reflects, from direct light and from all elements.
  Vec3d sent(std::size_t i, int k, const Lines& lines) const {
    return times(elements_.all()[i].albedo, nodes_[i].at[k].direct + nodes_[i].rows[k].gather(table_, lines)) * 0.5;
  }

  // The line through the radiances of an element's two nodes.
  ElementLine line_of(std::size_t i, const Lines& lines) const {
    const Vec3d first = sent(i, 0, lines), second = sent(i, 1, lines);
    const double u0 = nodes_[i].at[0].place.u, u1 = nodes_[i].at[1].place.u;
    const Vec3d slope = (second - first) / (u1 - u0), constant = first - slope * u0;
    return {{constant.x, constant.y, constant.z, 0}, {slope.x, slope.y, slope.z, 0}};
  }

  static std::span<double> numbers(Lines& lines) { return {lines.data()->constant, 8 * lines.size()}; }

  // For all bounces the iteration starts from the current values; for a fixed number of bounces it starts from none.
  void solve(double settled) {
    Lines lines(nodes_.size());
    if (lines.empty()) return;
    if (options_.bounces == kAllBounces)
      settle(settled, lines);
    else
      count_bounces(lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      BoundaryElement& e = elements_.all()[i];
      e.constant = {lines[i].constant[0], lines[i].constant[1], lines[i].constant[2]};
      e.slope = {lines[i].slope[0], lines[i].slope[1], lines[i].slope[2]};
    }
  }

  void settle(double settled, Lines& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const BoundaryElement& e = elements_.all()[i];
      lines[i] = {{e.constant.x, e.constant.y, e.constant.z, 0}, {e.slope.x, e.slope.y, e.slope.z, 0}};
    }
    FixedPoint fixed_point(8 * lines.size());
    Lines before;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      ++stats_.sweeps;
      before = lines;
      // In place: later elements use the new values at once.
      for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = line_of(i, lines);
      double change = 0, most = 0;
      const std::span<double> now = numbers(lines), then = numbers(before);
      for (std::size_t i = 0; i < now.size(); ++i) {
        change = std::max(change, std::fabs(now[i] - then[i]));
        most = std::max(most, std::fabs(now[i]));
      }
      if (change <= settled * most) break;
      fixed_point.improve(then, now);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) nodes_[i].middle = sent(i, 2, lines);
  }

  // Each bounce uses only the results of the one before it.
  void count_bounces(Lines& lines) {
    Lines next(lines.size());
    for (int bounce = 0; bounce < options_.bounces; ++bounce) {
      ++stats_.sweeps;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        next[i] = line_of(i, lines);
        nodes_[i].middle = sent(i, 2, lines);
      }
      lines.swap(next);
    }
  }

  // Computes each element's error at its middle, and marks those that exceed the tolerance.
  std::vector<char> check() {
    std::vector<char> marked(nodes_.size(), 0);
    const double size = std::max(world_.scene.width, world_.scene.height);
    double brightest = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const BoundaryElement& e = elements_.all()[i];
      for (int k = 0; k < 2; ++k) brightest = std::max(brightest, largest(e.constant + e.slope * nodes_[i].at[k].place.u));
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      BoundaryElement& e = elements_.all()[i];
      e.error = magnitude(nodes_[i].middle - e.constant - e.slope * nodes_[i].at[2].place.u);
      // The tolerance applies to an element of the initial length; a shorter one may be off by more, because it sends less.
      const auto judge = [&](std::size_t k, double error) {
        if (error * 2 * elements_.all()[k].half * kInitialParts > options_.tolerance * brightest * size) marked[k] = 1;
      };
      judge(i, largest(e.error));
      // A sharp edge of light may miss the middle: then neighbouring lines do not meet. Each element gets half of the difference, at its
      // end.
      if (i + 1 == nodes_.size()) continue;
      const BoundaryElement& next = elements_.all()[i + 1];
      if (next.curve != e.curve || next.back != e.back || next.from != e.to) continue;
      const double apart = largest(e.constant + e.slope - next.constant + next.slope);
      judge(i, 0.25 * apart);
      judge(i + 1, 0.25 * apart);
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
    const BoundaryElements before = elements_;
    elements_.halve(world_, marked);
    tbb::parallel_for(std::size_t{0}, nodes_.size(), [&](std::size_t i) {
      if (fresh[i] != 0) return;
      for (int k = 0; k < 3; ++k) nodes_[i].rows[k].follow(table_, world_, before, elements_, nodes_[i].at[k]);
    });
    look_at(fresh);
  }

  // Errors are propagated like light.
  void spread_error() {
    std::vector<BoundaryElement>& all = elements_.all();
    Lines errors(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) errors[i] = {{all[i].error.x, all[i].error.y, all[i].error.z, 0}, {}};
    for (int sweep = 0; sweep < 50; ++sweep) {
      double change = 0, most = 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Vec3d next = all[i].error + times(all[i].albedo, nodes_[i].rows[2].gather(table_, errors)) * 0.5;
        const Vec3d was{errors[i].constant[0], errors[i].constant[1], errors[i].constant[2]};
        change = std::max(change, largest(next - was));
        most = std::max(most, largest(next));
        errors[i] = {{next.x, next.y, next.z, 0}, {}};
      }
      if (change <= kErrorSettled * most) break;
    }
    double size = 0, squares = 0, mean = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      BoundaryElement& e = all[i];
      e.error = {errors[i].constant[0], errors[i].constant[1], errors[i].constant[2]};
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
  Outlook outlook_;
  BoundaryElements elements_;
  const RowsTable& table_ = rows_table_for(active_simd());
  std::vector<Nodes> nodes_;
  PlaneBounceStats stats_;
};

// Calls f with every visible piece of a wall that reflects, and the place from which it is seen.
template <class F>
void for_each_wall(const PlaneBounces::Impl& bounces, Vec2d p, F f) {
  const World& world = *bounces.world;
  const World::Inside inside = world.inside(p);
  if (inside.dark || inside.body >= 0) return;
  thread_local std::vector<const Curve*> curves;
  curves.clear();
  for (const Curve& c : world.curves) curves.push_back(&c);
  for (const Visible& v : lower_envelope(curves, inside.at, world.scene.bodies, {-1}))
    if (bounces.elements.reflects(v, world)) f(v, inside.at);
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
    impl_->elements = plane::BoundaryElements(world.impl(), 1e300, 0);  // none: nothing reflects
  else
    plane::WallSolver(world.impl(), options).run(*impl_);
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
  plane::for_each_wall(*impl_, p, [&](const plane::Visible& v, Vec2d from) {
    for (int k = 0; k < 3; ++k)
      plane::weigh(*impl_->world, impl_->elements, v, from, k == 0 ? nullptr : &axes[k - 1], [&](std::size_t i, double w0, double w1) {
        const plane::BoundaryElement& e = impl_->elements.all()[i];
        *parts[k] += (e.constant * w0 + e.slope * w1) / (2 * std::numbers::pi);
      });
  });
  return sum;
}

Vec3d PlaneBounces::error(Vec2d position) const {
  const Vec2d p = position * impl_->world->scale;
  Vec3d sum;
  plane::for_each_wall(*impl_, p, [&](const plane::Visible& v, Vec2d from) {
    plane::weigh(*impl_->world, impl_->elements, v, from, nullptr,
                 [&](std::size_t i, double w0, double) { sum += impl_->elements.all()[i].error * w0 / (2 * std::numbers::pi); });
  });
  return sum;
}

}  // namespace steradian
