#include "plane/extras/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/extras/extras.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

Disk disk_of(const Box& box) {
  if (!(box.low.x <= box.high.x)) return {{1e300, 1e300}, 0};
  return {(box.low + box.high) * 0.5, 0.5 * length(box.high - box.low)};
}

Disk disk_of(const Curve& c) {
  if (c.kind == Curve::Kind::segment) return {(c.a + c.b) * 0.5, 0.5 * length(c.b - c.a)};
  return {c.ellipse.center, std::sqrt(dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y))};
}

// What an eye looks at. Larger than needed by little: a hull is taken as a capsule, and rounding is left room.
class Targets {
 public:
  explicit Targets(Disk eye) : eye_(eye) {}

  void add(Disk light) { lights_.push_back(light); }
  void add(const PlaneSun& sun) { suns_.push_back(&sun); }
  bool empty() const { return lights_.empty() && suns_.empty(); }

  // May it stand between the eye and something that it looks at?
  bool touched_by(Disk body) const {
    return std::any_of(lights_.begin(), lights_.end(), [&](Disk light) { return between(light, body); }) ||
           std::any_of(suns_.begin(), suns_.end(), [&](const PlaneSun* sun) { return towards(*sun, body); });
  }
  bool between(Disk light, Disk body) const {
    const Vec2d way = light.center - eye_.center, to = body.center - eye_.center;
    const double length2 = dot(way, way), t = length2 > 0 ? std::clamp(dot(to, way) / length2, 0.0, 1.0) : 0;
    const double reach = (std::max(eye_.radius, light.radius) + body.radius) * (1 + 1e-9) + 1e-6;
    const Vec2d off = to - way * t;
    return dot(off, off) <= reach * reach;
  }
  bool towards(const PlaneSun& sun, Disk body) const {
    const double reach = (eye_.radius + body.radius) * (1 + 1e-9) + 1e-6;
    const Vec2d to = body.center - eye_.center;
    if (dot(to, to) <= reach * reach || sun.half_width >= 0.5 * pi) return true;
    const auto direction = [](double angle) { return Vec2d{std::cos(angle), std::sin(angle)}; };
    return dot(direction(sun.direction), to) >= -reach && cross(direction(sun.direction + sun.half_width), to) <= reach &&
           cross(direction(sun.direction - sun.half_width), to) >= -reach;
  }

 private:
  Disk eye_;
  std::vector<Disk> lights_;
  std::vector<const PlaneSun*> suns_;
};

class Viewer {
 public:
  Viewer(const World& world, Disk eye) : world_(world), eye_(eye) {
    const auto& bodies = world.scene.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!bodies[i].light || world.first_curve[i] == world.first_curve[i + 1]) continue;
      const Light light{disk_of(world.boxes[i]), bodies[i].light->range};
      if (reaches(light, eye)) lights_.push_back(light);
    }
  }

  View view(bool lights) {
    Targets direct(eye_);
    for (const Light& light : lights_)
      if (lights) direct.add(light.disk);
    for (const PlaneSun& sun : world_.scene.suns) direct.add(sun);
    for (std::size_t i : world_.extras->mirrors)
      for (std::size_t c = world_.first_curve[i]; c < world_.first_curve[i + 1]; ++c)
        if (add_mirror(world_.curves[c])) direct.add(disk_of(world_.curves[c]));
    for_each_touching(direct, [&](const Curve& c) { (is_clear(c) ? view_.clear : view_.blocking).push_back(&c); });
    if (world_.extras->hard_suns > 0 && !world_.extras->mirrors.empty())
      for (const Curve& c : world_.curves) view_.all.push_back(&c);
    return std::move(view_);
  }

 private:
  struct Light {
    Disk disk;
    double range;
  };

  static bool reaches(const Light& light, Disk eye) {
    return length(light.disk.center - eye.center) - light.disk.radius - eye.radius < light.range;
  }

  bool is_clear(const Curve& c) const { return world_.extras->matter[static_cast<std::size_t>(c.body)] == Matter::clear; }

  template <class F>
  void for_each_touching(const Targets& targets, F f) const {
    if (targets.empty()) return;
    for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) {
      const std::size_t first = world_.first_curve[i], last = world_.first_curve[i + 1];
      if (first == last || !targets.touched_by(disk_of(world_.boxes[i]))) continue;
      for (std::size_t c = first; c < last; ++c)
        if (last - first <= 4 || targets.touched_by(disk_of(world_.curves[c]))) f(world_.curves[c]);
    }
  }

  // Both sides, where the eye may be on both and the edge has two. False: nothing is seen by it.
  bool add_mirror(const Curve& edge) {
    const Vec2d along = edge.b - edge.a, right = Vec2d{along.y, -along.x} / length(along);
    bool any = false;
    for (double side : {1.0, -1.0}) {
      if (side < 0 && !edge.two_sided) continue;
      const Vec2d normal = right * side;
      if (dot(normal, eye_.center - edge.a) + eye_.radius > 0) any |= add_mirror(edge, normal);
    }
    return any;
  }

  bool add_mirror(const Curve& edge, Vec2d normal) {
    MirrorView mirror{&edge, normal, {}, {}};
    const Disk eye{mirror.reflected(eye_.center), eye_.radius}, glass = disk_of(edge);
    Targets targets(eye);
    const auto in_front = [&](Disk d) { return dot(normal, d.center - edge.a) + d.radius > 0; };
    for (const Light& light : lights_)
      if (reaches(light, eye) && in_front(light.disk) && targets.between(light.disk, glass)) targets.add(light.disk);
    for (const PlaneSun& sun : world_.scene.suns)
      if (targets.towards(sun, glass)) targets.add(sun);
    if (targets.empty()) return false;
    for_each_touching(targets, [&](const Curve& c) {
      if (&c == &edge || !in_front(disk_of(c))) return;
      if (is_clear(c))
        mirror.clear.push_back(&c);
      else
        cut_at_line(c, edge.a, normal, mirror.beyond);
    });
    view_.mirrors.push_back(std::move(mirror));
    return true;
  }

  const World& world_;
  Disk eye_;
  std::vector<Light> lights_;  // that reach the eye; by a mirror the way is longer
  View view_;
};

}  // namespace

View view_of(const World& world, Disk eye, bool lights) { return Viewer(world, eye).view(lights); }

void cut_at_line(const Curve& c, Vec2d at, Vec2d normal, std::vector<Curve>& out) {
  // On the line counts as behind it.
  constexpr double kOn = 1e-9;
  std::vector<double> cuts{0, 1};
  if (c.kind == Curve::Kind::segment) {
    const double a = dot(normal, c.a - at), b = dot(normal, c.b - at);
    if (std::max(a, b) <= kOn) return;
    if (std::min(a, b) >= 0) return out.push_back(c);
    cuts.push_back(a / (a - b));
  } else {
    // On an ellipse the height over the line is a constant plus a cosine of tau.
    const double height = dot(normal, c.ellipse.center - at), x = dot(normal, c.ellipse.x), y = dot(normal, c.ellipse.y);
    const double most = std::hypot(x, y);
    if (height + most <= kOn) return;
    if (height - most >= 0) return out.push_back(c);
    for (double sign : {-1.0, 1.0}) {
      double along = std::atan2(y, x) + sign * std::acos(-height / most) - c.tau0;
      along -= 2 * pi * std::floor(along / (2 * pi));
      if (along < c.tau_span) cuts.push_back(along / c.tau_span);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (!(cuts[i + 1] - cuts[i] > 1e-12)) continue;
    const Curve part = part_of(c, cuts[i], cuts[i + 1]);
    const Vec2d middle = c.kind == Curve::Kind::segment ? (part.a + part.b) * 0.5 : part.ellipse.at(part.tau0 + 0.5 * part.tau_span);
    if (dot(normal, middle - at) > 0) out.push_back(part);
  }
}

}  // namespace steradian::plane
