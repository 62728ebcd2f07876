#include "plane/bounce/depth_order.h"

#include <algorithm>
#include <cmath>

namespace steradian::plane {
namespace {

constexpr double kOnDividingLine = 1e-9;  // distance from a line; the picture has 1024 to 2048 units a side
constexpr std::size_t kCandidates = 8;    // number of facets whose lines are tried
constexpr std::size_t kSplitsWeigh = 4;   // weight of a cut facet, relative to one more on the larger side
constexpr std::size_t kMostParts = 6;     // facets for each segment, on average

struct SplittingLine {
  Vec2d normal;
  double offset;
  double height(Vec2d p) const { return dot(normal, p) - offset; }
};

SplittingLine line_of(const Facet& facet) {
  const Vec2d e = facet.curve->b - facet.curve->a, normal = Vec2d{-e.y, e.x} / length(e);
  return {normal, dot(normal, facet.curve->a)};
}

struct Heights {
  double a, b;
  bool on() const { return std::fabs(a) <= kOnDividingLine && std::fabs(b) <= kOnDividingLine; }
  bool in_front() const { return a >= -kOnDividingLine && b >= -kOnDividingLine; }
  bool behind() const { return a <= kOnDividingLine && b <= kOnDividingLine; }
};
Heights heights(const SplittingLine& line, const Facet& f) { return {line.height(f.a), line.height(f.b)}; }

// A line across the longer side of the facets' middles, with half of them on each side.
SplittingLine halving(const std::vector<Facet>& facets) {
  Box2d box;
  for (const Facet& f : facets) box.add((f.a + f.b) * 0.5);
  const bool wide = box.high.x - box.low.x > box.high.y - box.low.y;
  std::vector<double> middles;
  for (const Facet& f : facets) middles.push_back(0.5 * (wide ? f.a.x + f.b.x : f.a.y + f.b.y));
  const auto middle = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
  std::nth_element(middles.begin(), middle, middles.end());
  return {wide ? Vec2d{1, 0} : Vec2d{0, 1}, *middle};
}

// Returns kUseless if one side would have all of them.
constexpr std::size_t kUseless = static_cast<std::size_t>(-1);
std::size_t cost_of(const SplittingLine& line, const std::vector<Facet>& facets) {
  std::size_t front = 0, back = 0, cut = 0;
  for (const Facet& f : facets) {
    const Heights h = heights(line, f);
    if (h.on()) continue;
    if (h.in_front())
      ++front;
    else if (h.behind())
      ++back;
    else
      ++cut;
  }
  if (std::max(front, back) + cut == facets.size()) return kUseless;
  return kSplitsWeigh * cut + (front > back ? front - back : back - front);
}

SplittingLine best_line(const std::vector<Facet>& facets) {
  SplittingLine best = line_of(facets[0]);
  std::size_t least = kUseless;
  const auto consider = [&](const SplittingLine& line) {
    if (const std::size_t cost = cost_of(line, facets); cost < least) best = line, least = cost;
  };
  const std::size_t step = std::max<std::size_t>(1, facets.size() / kCandidates);
  for (std::size_t i = step / 2; i < facets.size(); i += step) consider(line_of(facets[i]));
  if (facets.size() > kCandidates) consider(halving(facets));
  return best;
}

}  // namespace

DepthOrder::DepthOrder(const World& world) {
  struct Task {
    std::vector<Facet> facets;
    std::int32_t parent;
    bool in_front;
  };
  std::vector<Task> tasks(1);
  tasks[0].parent = -1;
  for (const Curve& c : world.curves)
    if (c.kind == Curve::Kind::segment && c.a != c.b) tasks[0].facets.push_back({c.a, c.b, &c});
  if (tasks[0].facets.empty()) return;
  const std::size_t most = kMostParts * tasks[0].facets.size() + 1000;
  std::size_t count = tasks[0].facets.size();
  const auto shines = [&](const Facet& f) { return world.scene.bodies[static_cast<std::size_t>(f.curve->body)].light.has_value(); };
  while (!tasks.empty()) {
    const Task task = std::move(tasks.back());
    tasks.pop_back();
    const auto index = static_cast<std::int32_t>(nodes_.size());
    if (task.parent >= 0)
      (task.in_front ? nodes_[static_cast<std::size_t>(task.parent)].front : nodes_[static_cast<std::size_t>(task.parent)].back) = index;
    const SplittingLine line = best_line(task.facets);
    Node node;
    node.normal = line.normal;
    node.offset = line.offset;
    node.facets = static_cast<std::uint32_t>(task.facets.size());
    node.first = static_cast<std::uint32_t>(facets_.size());
    Task front{{}, index, true}, back{{}, index, false};
    for (const Facet& f : task.facets) {
      node.box.add(f.a);
      node.box.add(f.b);
      const Heights h = heights(line, f);
      if (h.on()) {
        facets_.push_back(f);
      } else if (h.in_front()) {
        front.facets.push_back(f);
      } else if (h.behind()) {
        back.facets.push_back(f);
      } else {
        const Vec2d middle = f.a + (f.b - f.a) * (h.a / (h.a - h.b));
        (h.a > 0 ? front : back).facets.push_back({f.a, middle, f.curve});
        (h.a > 0 ? back : front).facets.push_back({middle, f.b, f.curve});
        ++count;
      }
    }
    // Among coincident facets a light's is visible, else the last in the scene's order.
    std::stable_sort(facets_.begin() + node.first, facets_.end(), [&](const Facet& f, const Facet& g) {
      if (shines(f) != shines(g)) return shines(f);
      return f.curve->body > g.curve->body;
    });
    node.last = static_cast<std::uint32_t>(facets_.size());
    nodes_.push_back(node);
    if (count > most) {
      nodes_.clear();
      facets_.clear();
      return;
    }
    if (!front.facets.empty()) tasks.push_back(std::move(front));
    if (!back.facets.empty()) tasks.push_back(std::move(back));
  }
}

}  // namespace steradian::plane
