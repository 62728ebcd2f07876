#include "plane/extras/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/extras/extras.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

BodyDisk disk_of(const Box2d& box) {
  if (box.is_empty()) return {{1e300, 1e300}, 0};
  return {box.center(), box.radius()};
}

// Targets that an eye looks at. It errs on the large side by a little: a hull counts as a capsule, with a margin for rounding.
class Targets {
 public:
  explicit Targets(BodyDisk eye) : eye_(eye) {}

  void add(BodyDisk light) { lights_.push_back(light); }
  void add(const PlaneSun& sun) { suns_.push_back(&sun); }
  bool empty() const { return lights_.empty() && suns_.empty(); }

  // Can the body be between the eye and one of its targets?
  bool touched_by(BodyDisk body) const {
    return std::any_of(lights_.begin(), lights_.end(), [&](BodyDisk light) { return between(light, body); }) ||
           std::any_of(suns_.begin(), suns_.end(), [&](const PlaneSun* sun) { return towards(*sun, body); });
  }
  bool between(BodyDisk light, BodyDisk body) const {
    const Vec2d way = light.center - eye_.center, to = body.center - eye_.center;
    const double length2 = dot(way, way), t = length2 > 0 ? std::clamp(dot(to, way) / length2, 0.0, 1.0) : 0;
    const double reach = (std::max(eye_.radius, light.radius) + body.radius) * (1 + 1e-9) + 1e-6;
    const Vec2d off = to - way * t;
    return dot(off, off) <= reach * reach;
  }
  bool towards(const PlaneSun& sun, BodyDisk body) const {
    const double reach = (eye_.radius + body.radius) * (1 + 1e-9) + 1e-6;
    const Vec2d to = body.center - eye_.center;
    if (dot(to, to) <= reach * reach || sun.half_width >= 0.5 * pi) return true;
    const auto direction = [](double angle) { return Vec2d{std::cos(angle), std::sin(angle)}; };
    return dot(direction(sun.direction), to) >= -reach && cross(direction(sun.direction + sun.half_width), to) <= reach &&
           cross(direction(sun.direction - sun.half_width), to) >= -reach;
  }

 private:
  BodyDisk eye_;
  std::vector<BodyDisk> lights_;
  std::vector<const PlaneSun*> suns_;
};

class Viewer {
 public:
  Viewer(const World& world, BodyDisk eye) : world_(world), eye_(eye) {
    for (std::size_t i : world.extras->lights) {
      if (world.first_curve[i] == world.first_curve[i + 1]) continue;
      const Light light{disk_of(world.boxes[i]), world.scene.bodies[i].light->range, i};
      if (reaches(light, eye)) lights_.push_back(light);
    }
  }

  View view(bool lights) {
    Targets direct(eye_);
    for (const Light& light : lights_)
      if (lights) direct.add(light.disk);
    const bool within = is_within_deep(), hard = !within && !world_.extras->clear && world_.extras->mirrors.empty();
    for (const PlaneSun& sun : world_.scene.suns)
      if (within || !is_plain(sun) || (sun.half_width == 0 && !hard) || !add_open(sun)) direct.add(sun);
    for_each_mirror([&](const Curve& edge, Vec2d normal) {
      if (add_mirror(edge, normal)) direct.add(disk_of(edge));
    });
    for_each_touching(direct, [&](const Curve& c) { (is_clear(c) ? view_.clear : view_.blocking).push_back(&c); });
    for (const Curve* c : view_.blocking) view_.disks.push_back(disk_of(*c));
    if (world_.extras->hard_suns > 0 && !world_.extras->mirrors.empty())
      for (const Curve& c : world_.curves) view_.all.push_back(&c);
    return std::move(view_);
  }

  // Uses the tests of `view`, or wider ones.
  bool depends_on(const std::vector<std::size_t>& bodies, bool lights) const {
    if (bodies.empty()) return false;
    if (world_.extras->hard_suns > 0 && !world_.extras->mirrors.empty()) return true;
    const auto is_one = [&](std::size_t body) { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); };
    const auto any_disk = [&](auto&& test) {
      return std::any_of(bodies.begin(), bodies.end(), [&](std::size_t i) { return test(disk_of(world_.boxes[i])); });
    };
    // Bodies that hold points of the eye.
    if (any_disk([&](BodyDisk d) { return length(d.center - eye_.center) <= (d.radius + eye_.radius) * (1 + 1e-9) + 1e-6; })) return true;
    Targets direct(eye_);
    for (const Light& light : lights_) {
      if (!lights && !is_within_deep()) break;
      if (is_one(light.body)) return true;
      direct.add(light.disk);
    }
    for (const PlaneSun& sun : world_.scene.suns) direct.add(sun);
    bool found = false;
    for_each_mirror([&](const Curve& edge, Vec2d normal) {
      if (found) return;
      const MirrorTargets shown = targets_of(edge, normal);
      if (shown.targets.empty()) return;
      direct.add(disk_of(edge));
      found = is_one(static_cast<std::size_t>(edge.body)) ||
              std::any_of(shown.lights.begin(), shown.lights.end(), [&](const Light* light) { return is_one(light->body); }) ||
              any_disk([&](BodyDisk d) { return shown.targets.touched_by(d); });
    });
    return found || any_disk([&](BodyDisk d) { return direct.touched_by(d); });
  }

 private:
  struct Light {
    BodyDisk disk;
    double range;
    std::size_t body;
  };

  static bool reaches(const Light& light, BodyDisk eye) {
    return length(light.disk.center - eye.center) - light.disk.radius - eye.radius < light.range;
  }

  // Can a point of the eye be in a body that absorbs light?
  bool is_within_deep() const {
    if (!world_.extras->deep) return false;
    for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) {
      if (world_.extras->matter[i] != Matter::deep) continue;
      const BodyDisk body = disk_of(world_.boxes[i]);
      if (length(body.center - eye_.center) <= body.radius + eye_.radius) return true;
    }
    return false;
  }

  // Returns false if something clear may be in front of the sun.
  bool add_open(const PlaneSun& sun) {
    Targets targets(eye_);
    targets.add(sun);
    SunView view{&sun, {}};
    bool open = true;
    for_each_touching(targets, [&](const Curve& c) {
      if (is_clear(c)) open = false;
      if (!turned_away(c)) view.blocking.push_back(&c);
    });
    if (open) view_.suns.push_back(std::move(view));
    return open;
  }

  // Does its inner face look at all of the eye, from outside of its body?
  bool turned_away(const Curve& c) const {
    if (c.kind != Curve::Kind::segment || c.two_sided) return false;
    return cross(c.a - eye_.center, c.b - eye_.center) > (eye_.radius * (1 + 1e-9) + 1e-6) * length(c.b - c.a);
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

  // Calls f(edge, normal): for both sides, if the eye may be on both and the edge has two.
  template <class F>
  void for_each_mirror(F f) const {
    for (std::size_t i : world_.extras->mirrors)
      for (std::size_t c = world_.first_curve[i]; c < world_.first_curve[i + 1]; ++c) {
        const Curve& edge = world_.curves[c];
        const Vec2d along = edge.b - edge.a, right = Vec2d{along.y, -along.x} / length(along);
        for (double side : {1.0, -1.0}) {
          const Vec2d normal = right * side;
          if ((side > 0 || edge.two_sided) && dot(normal, eye_.center - edge.a) + eye_.radius > 0) f(edge, normal);
        }
      }
  }

  // Targets that may be visible by a mirror, seen from behind it.
  struct MirrorTargets {
    Targets targets;
    std::vector<const Light*> lights;
  };
  static bool in_front(BodyDisk d, const Curve& edge, Vec2d normal) { return dot(normal, d.center - edge.a) + d.radius > 0; }
  MirrorTargets targets_of(const Curve& edge, Vec2d normal) const {
    const BodyDisk eye{eye_.center - normal * (2 * dot(normal, eye_.center - edge.a)), eye_.radius}, glass = disk_of(edge);
    MirrorTargets result{Targets(eye), {}};
    for (const Light& light : lights_)
      if (reaches(light, eye) && in_front(light.disk, edge, normal) && result.targets.between(light.disk, glass)) {
        result.targets.add(light.disk);
        result.lights.push_back(&light);
      }
    for (const PlaneSun& sun : world_.scene.suns)
      if (result.targets.towards(sun, glass)) result.targets.add(sun);
    return result;
  }

  // Returns false if nothing is visible by it.
  bool add_mirror(const Curve& edge, Vec2d normal) {
    const MirrorTargets shown = targets_of(edge, normal);
    if (shown.targets.empty()) return false;
    MirrorView mirror{&edge, normal, {}, {}, {}, {}};
    for (const Light* light : shown.lights) mirror.lights.push_back(light->disk);
    for_each_touching(shown.targets, [&](const Curve& c) {
      if (&c == &edge || !in_front(disk_of(c), edge, normal)) return;
      if (is_clear(c))
        mirror.clear.push_back(&c);
      else
        cut_at_line(c, edge.a, normal, mirror.beyond);
    });
    for (const Curve& c : mirror.beyond) mirror.disks.push_back(disk_of(c));
    view_.mirrors.push_back(std::move(mirror));
    return true;
  }

  const World& world_;
  BodyDisk eye_;
  std::vector<Light> lights_;  // lights that reach the eye; by a mirror the path is longer
  View view_;
};

}  // namespace

BodyDisk disk_of(const Curve& c) {
  if (c.kind == Curve::Kind::segment) return {(c.a + c.b) * 0.5, 0.5 * length(c.b - c.a)};
  return {c.ellipse.center, std::sqrt(dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y))};
}

View view_of(const World& world, BodyDisk eye, bool lights) { return Viewer(world, eye).view(lights); }

bool may_matter(const World& world, BodyDisk eye, bool lights, const std::vector<std::size_t>& bodies) {
  return Viewer(world, eye).depends_on(bodies, lights);
}

void cut_at_line(const Curve& c, Vec2d at, Vec2d normal, std::vector<Curve>& out) {
  // A point on the line counts as behind it.
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
