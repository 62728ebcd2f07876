#include "plane/extras/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane/exact/emission.h"
#include "plane/exact/envelope.h"
#include "plane/exact/outline.h"
#include "plane/extras/extras.h"
#include "plane/extras/quadrature.h"
#include "plane/extras/trace.h"

namespace steradian::plane {
namespace {

using std::numbers::pi;

using Curves = std::vector<const Curve*>;

class SightFrom {
 public:
  SightFrom(const World& world, const View& view, Vec2d from, const SightRules& rules)
      : world_(world), view_(view), rules_(rules), start_(start_at(world, from)), from_(start_.at) {
    for (int body : start_.deep)
      for (std::size_t c = world.first_curve[static_cast<std::size_t>(body)]; c < world.first_curve[static_cast<std::size_t>(body) + 1];
           ++c)
        deep_.push_back(&world.curves[c]);
  }

  PlaneLight light() {
    if (start_.dark) return {};
    const bool lights = rules_.all || !start_.deep.empty();
    if (start_.light < 0)
      for (const SunView& sun : view_.suns) add_open_sun(sun, from_, sum_);
    // If only mirrors are needed, collect the curves in front of the mirrors that may show something.
    const bool mirrors_only = !lights && view_.suns.size() == world_.scene.suns.size();
    std::vector<ViewFan> fans;
    if (mirrors_only)
      for (const MirrorView& mirror : view_.mirrors)
        if (may_show(mirror)) fans.emplace_back(from_, *mirror.edge);
    if (mirrors_only && fans.empty()) return mean();
    Curves blocking;
    for (std::size_t i = 0; i < view_.blocking.size(); ++i)
      if (!passes(world_, start_, view_.blocking[i]->body) &&
          (!mirrors_only || std::any_of(fans.begin(), fans.end(), [&](const ViewFan& fan) { return fan.may_hold(view_.disks[i]); })))
        blocking.push_back(view_.blocking[i]);
    const Path direct{from_, nullptr, with_deep(view_.clear), {}};
    const std::vector<Visible> envelope = lower_envelope(blocking, from_, world_.scene.bodies, {start_.light});
    double open = 2 * pi;
    for (const Visible& v : envelope) {
      open -= v.end - v.begin;
      if (body_of(v).mirror)
        add_mirrored(v);
      else if (lights)
        add_light(v, direct);
    }
    add_suns(envelope, -pi, pi, direct);
    // Its own outline may leave directions open, by rounding.
    if (lights && start_.light >= 0 && open > 0)
      sum_.radiance += radiance_at(*world_.scene.bodies[static_cast<std::size_t>(start_.light)].light, from_) * open;
    add_hard_suns(std::move(blocking));
    return mean();
  }

 private:
  bool may_show(const MirrorView& mirror) const {
    if (dot(mirror.normal, from_ - mirror.edge->a) <= 0) return false;
    return !world_.scene.suns.empty() || shows(mirror, ViewFan(mirror.reflected(from_), *mirror.edge));
  }
  static bool shows(const MirrorView& mirror, const ViewFan& window) {
    return std::any_of(mirror.lights.begin(), mirror.lights.end(), [&](const BodyDisk& light) { return window.may_hold(light); });
  }

  PlaneLight mean() const {
    const double scale = 1 / (2 * pi);
    return {sum_.radiance * scale, sum_.moment_x * scale, sum_.moment_y * scale};
  }

  // How light arrives: directly, or by a mirror, as if from behind it.
  struct Path {
    Vec2d eye;
    const MirrorView* mirror;
    Curves before, beyond;  // curves that light passes, before the mirror and beyond it
  };

  const PlaneBody& body_of(const Visible& v) const { return world_.scene.bodies[static_cast<std::size_t>(v.curve->body)]; }

  Curves with_deep(const Curves& clear) const {
    Curves all = clear;
    all.insert(all.end(), deep_.begin(), deep_.end());
    return all;
  }

  void add_mirrored(const Visible& v) {
    for (const MirrorView& mirror : view_.mirrors) {
      if (mirror.edge != v.curve || dot(mirror.normal, from_ - v.curve->a) <= 0) continue;
      const auto on_edge = [&](double angle) {
        return from_ + direction_at(angle) * distance_along(*v.curve, v.back, from_, direction_at(angle));
      };
      const Path path{mirror.reflected(from_), &mirror, with_deep(view_.clear), with_deep(mirror.clear)};
      // A mirror reverses the order of directions.
      const Vec2d first = on_edge(v.end) - path.eye, last = on_edge(v.begin) - path.eye;
      const double begin = angle_of(first);
      double end = angle_of(last);
      const ViewFan window(path.eye, first / length(first), last / length(last));
      if (world_.scene.suns.empty() && !shows(mirror, window)) continue;
      Curves curves;
      for (std::size_t i = 0; i < mirror.beyond.size(); ++i)
        if (window.may_hold(mirror.disks[i]) && !passes(world_, start_, mirror.beyond[i].body)) curves.push_back(&mirror.beyond[i]);
      const std::vector<Visible> envelope = lower_envelope(curves, path.eye, world_.scene.bodies, {start_.light});
      if (end < begin) {
        add_window(envelope, -pi, end, path);
        end = pi;
      }
      add_window(envelope, begin, end, path);
    }
  }

  void add_window(const std::vector<Visible>& envelope, double begin, double end, const Path& path) {
    for (Visible v : envelope) {
      v.begin = std::max(v.begin, begin);
      v.end = std::min(v.end, end);
      if (v.end > v.begin) add_light(v, path);
    }
    add_suns(envelope, begin, end, path);
  }

  void add_light(const Visible& v, const Path& along) {
    const auto& light = body_of(v).light;
    if (!light) return;
    const Path path = between(along, v.begin, v.end);
    const bool within = v.curve->body == start_.light;
    std::vector<double> cuts = cuts_of(v.begin, v.end, v.curve, path);
    if (!within && light->spot_half_angle > 0)
      for (double side : {-1.0, 1.0}) add_cut(angle_of(-light->spot_axis) + side * light->spot_half_angle, cuts);
    const double density = within ? 0 : world_.scene.fog_density;
    const auto way = [&](Vec2d u) { return distance_along(*v.curve, v.back, path.eye, u); };
    add_cells(
        std::move(cuts), path, way, density > 0,
        [&](double begin, double end, PlaneLight& sum) {
          const Visible part{begin, end, v.curve, v.back};
          if (within)
            add_interior(part, *light, from_, sum);
          else
            add_emission(part, *light, path.eye, rules_.parts, sum);
        },
        [&](Vec2d u, double r) {
          return within ? radiance_at(*light, from_) : radiance_along(*v.curve, *light, path.eye, u, r) * std::exp(-density * r);
        });
  }

  // Adds suns in the gaps between `begin` and `end`.
  void add_suns(const std::vector<Visible>& envelope, double begin, double end, const Path& path) {
    if (start_.light >= 0) return;
    for (const PlaneSun& sun : world_.scene.suns)
      for (int turn = -1; turn <= 1 && sun.half_width > 0 && (path.mirror != nullptr || !is_open(view_, sun)); ++turn) {
        const double middle = std::remainder(sun.direction, 2 * pi) + 2 * pi * turn;
        double at = std::max(begin, middle - sun.half_width);
        const double last = std::min(end, middle + sun.half_width);
        for (const Visible& v : envelope) {
          if (v.end <= at) continue;
          if (v.begin >= last) break;
          if (v.begin > at) add_sun(sun, at, v.begin, path);
          at = v.end;
        }
        if (at < last) add_sun(sun, at, last, path);
      }
  }

  void add_sun(const PlaneSun& sun, double begin, double end, const Path& along) {
    const Path path = between(along, begin, end);
    const auto far = [](Vec2d) { return std::numeric_limits<double>::infinity(); };
    add_cells(
        cuts_of(begin, end, nullptr, path), path, far, false,
        [&](double from, double to, PlaneLight& sum) {
          sum.radiance += sun.radiance * (to - from);
          sum.moment_x += sun.radiance * (std::sin(to) - std::sin(from));
          sum.moment_y += sun.radiance * (std::cos(from) - std::cos(to));
        },
        [&](Vec2d, double) { return sun.radiance; });
  }

  // blocking: all curves that end light in the view.
  void add_hard_suns(Curves blocking) {
    const auto& all = world_.scene.suns;
    if (std::all_of(all.begin(), all.end(), [&](const PlaneSun& sun) { return sun.half_width > 0 || is_open(view_, sun); })) return;
    Curves curves = view_.all;
    if (curves.empty()) {
      curves = std::move(blocking);
      curves.insert(curves.end(), view_.clear.begin(), view_.clear.end());
      curves.insert(curves.end(), deep_.begin(), deep_.end());
    }
    const PlaneLight suns = Tracer(world_, curves, from_).hard_suns();
    sum_.radiance += suns.radiance;
    sum_.moment_x += suns.moment_x;
    sum_.moment_y += suns.moment_y;
  }

  // The path with only the curves that lie between two directions.
  Path between(const Path& path, double begin, double end) const {
    if (end - begin >= 0.5 * pi || (path.before.empty() && path.beyond.empty())) return path;
    const ViewFan fan(path.eye, direction_at(begin), direction_at(end));
    const auto met = [&](const Curves& curves, auto&& seen_at) {
      Curves near;
      int body = -1;
      bool is_met = false;
      for (const Curve* c : curves) {
        if (c->body != body) {
          body = c->body;
          const Box2d& box = world_.boxes[static_cast<std::size_t>(body)];
          is_met = fan.may_hold({seen_at(box.center()), box.radius()});
        }
        if (is_met) near.push_back(c);
      }
      return near;
    };
    const auto itself = [](Vec2d p) { return p; };
    if (path.mirror == nullptr) return {path.eye, nullptr, met(path.before, itself), {}};
    return {path.eye, path.mirror, met(path.before, [&](Vec2d p) { return path.mirror->reflected(p); }), met(path.beyond, itself)};
  }

  static void add_cut(double angle, std::vector<double>& cuts) {
    for (double at : {angle - 2 * pi, angle, angle + 2 * pi})
      if (at > cuts[0] && at < cuts[1]) cuts.push_back(at);
  }

  // Directions between which light passes the same bodies: where curves end, are touched, or cross the visible curve. The first two are the
  // ends.
  std::vector<double> cuts_of(double begin, double end, const Curve* seen, const Path& path) const {
    std::vector<double> cuts{begin, end};
    const auto cut = [&](Vec2d at) { add_cut(angle_of(at - path.eye), cuts); };
    const auto along = [&](const Curves& curves, Vec2d eye, auto&& to_path) {
      for (const Curve* c : curves) {
        to_path(c->a);
        to_path(c->b);
        if (c->kind == Curve::Kind::arc) {
          const Vec2d p = c->ellipse.to_unit(eye);
          if (const double d = length(p); d > 1)
            for (double side : {-1.0, 1.0}) to_path(c->ellipse.at(angle_of(p) + side * std::acos(1 / d)));
        }
        for (const Curve* other : {seen, path.mirror != nullptr ? path.mirror->edge : nullptr}) {
          if (other == nullptr) continue;
          const Crossings crossings = intersect(*c, *other);
          for (int k = 0; k < crossings.count; ++k) to_path(crossings.at[k]);
        }
      }
    };
    if (path.mirror == nullptr) {
      along(path.before, from_, cut);
    } else {
      along(path.before, from_, [&](Vec2d at) { cut(path.mirror->reflected(at)); });
      along(path.beyond, path.eye, cut);
    }
    return cuts;
  }

  // Fraction of light that remains in direction u of the path after a length `way`.
  Vec3d share(const Path& path, Vec2d u, double way) const {
    if (path.mirror == nullptr) return passage(world_, start_, path.before, from_, u, way);
    const double to_mirror = distance_along(*path.mirror->edge, false, path.eye, u);
    const Vec3d before = passage(world_, start_, path.before, from_, path.mirror->reflected_direction(u), to_mirror);
    const Vec3d beyond = passage(world_, start_, path.beyond, path.eye + u * to_mirror, u, way - to_mirror);
    return before * beyond * *world_.scene.bodies[static_cast<std::size_t>(path.mirror->edge->body)].mirror;
  }

  // Adds the integral over all cells between the cuts. It is `closed` between two angles, times the fraction in the middle; or, if that
  // fraction varies within a cell, `radiance` of direction and way.
  template <class Way, class Closed, class Radiance>
  void add_cells(std::vector<double> cuts, const Path& path, Way way, bool fades, Closed closed, Radiance radiance) {
    fades = fades || !deep_.empty();
    std::sort(cuts.begin(), cuts.end());
    PlaneLight sum;
    double first = cuts[0];  // start of the cells with the same fraction
    Vec3d shared;
    const auto finish = [&](double last) {
      PlaneLight part;
      if (last > first && (shared.x > 0 || shared.y > 0 || shared.z > 0)) closed(first, last, part);
      sum.radiance += shared * part.radiance;
      sum.moment_x += shared * part.moment_x;
      sum.moment_y += shared * part.moment_y;
    };
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double begin = cuts[i], end = cuts[i + 1];
      if (!(end > begin)) continue;
      if (fades) {
        const auto at = [&](Vec2d u) {
          const double r = way(u);
          return share(path, u, r) * radiance(u, r);
        };
        add_integral(at, begin, end, rules_.tolerance, sum);
        continue;
      }
      const Vec2d u = direction_at(0.5 * (begin + end));
      const Vec3d here = share(path, u, way(u));
      if (begin == cuts[0]) shared = here;
      if (here.x == shared.x && here.y == shared.y && here.z == shared.z) continue;
      finish(begin);
      first = begin;
      shared = here;
    }
    if (!fades) finish(cuts.back());
    deposit(sum, path);
  }

  void deposit(const PlaneLight& part, const Path& path) {
    sum_.radiance += part.radiance;
    if (path.mirror == nullptr) {
      sum_.moment_x += part.moment_x;
      sum_.moment_y += part.moment_y;
      return;
    }
    const Vec2d n = path.mirror->normal;
    const Vec3d across = (part.moment_x * n.x + part.moment_y * n.y) * 2;
    sum_.moment_x += part.moment_x - across * n.x;
    sum_.moment_y += part.moment_y - across * n.y;
  }

  const World& world_;
  const View& view_;
  const SightRules& rules_;
  Start start_;
  Vec2d from_;
  Curves deep_;  // curves of the absorbing bodies that hold the point
  PlaneLight sum_;
};

}  // namespace

PlaneLight sight(const World& world, const View& view, Vec2d from, const SightRules& rules) {
  return SightFrom(world, view, from, rules).light();
}

PlaneLight sight_from(const World& world, Vec2d from) { return sight(world, view_of(world, {from, 0}, true), from, {}); }

}  // namespace steradian::plane
