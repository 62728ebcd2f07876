#include "plane/svg/backdrop.h"

#include <algorithm>
#include <optional>

#include "core/box.h"
#include "plane/exact/edge_rows.h"
#include "plane/exact/outline.h"
#include "plane/svg/clip.h"

namespace steradian::plane::svg {
namespace {

constexpr double kMargin = 1e-3;  // of the picture's larger side

Box2d flat_bounds(const PlaneBody& flat) {
  Box2d box;
  for (const auto& contour : flat.contours)
    for (const Vec2d p : contour) box.add(p);
  return box;
}

bool holds_box(const Box2d& outer, const Box2d& inner) { return outer.contains(inner.low) && outer.contains(inner.high); }

// Calls each(a, b) for the edges of a body, until it returns false. Does it always return true?
template <class Each>
bool every_edge(const PlaneBody& flat, Each each) {
  const bool closed = flat.shape == PlaneBody::Shape::polygon;
  for (const auto& c : flat.contours)
    for (std::size_t i = 0; i + (closed ? 0 : 1) < c.size(); ++i)
      if (!each(c[i], c[(i + 1) % c.size()])) return false;
  return true;
}

bool holds_point(const PlaneBody& flat, Vec2d p) {
  Winding winding(p);
  every_edge(flat, [&](Vec2d a, Vec2d b) {
    winding.add(a, b);
    return true;
  });
  return winding.within(flat.even_odd);
}

// Has the segment a point in the box? Its line passes all four corners on one side, or their boxes lie apart, if not.
bool enters(const Box2d& box, Vec2d a, Vec2d b) {
  Box2d own;
  own.add(a);
  own.add(b);
  if (!own.meets(box)) return false;
  const Vec2d corners[] = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  const auto side = [&](Vec2d corner) { return cross(b - a, corner - a); };
  return !std::all_of(corners, corners + 4, [&](Vec2d c) { return side(c) > 0; }) &&
         !std::all_of(corners, corners + 4, [&](Vec2d c) { return side(c) < 0; });
}

double distance_between(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
  const bool cross_each_other =
      (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) && (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
  return cross_each_other ? 0
                          : std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                                      distance_to_segment(d, a, b)});
}

struct FlatLight {
  PlaneBody flat;
  Box2d box;  // with the margin at which outlines touch
};

class BackdropJudge {
 public:
  BackdropJudge(const PlaneScene& scene, double tolerance, const std::function<void(std::uint64_t)>& spend)
      : scene_(scene), tolerance_(tolerance), spend_(spend) {
    const double margin = kMargin * std::max(scene.width, scene.height);
    const Vec2d inset{std::min(margin, scene.width / 4), std::min(margin, scene.height / 4)}, size{scene.width, scene.height};
    picture_ = {scene.origin + inset, scene.origin + size - inset};
  }

  std::optional<PlaneLeftOut::Why> why(const PlaneBody& body) {
    const Box2d box = bounds_of(body);
    const bool near_picture = holds_box(box, picture_), near_lights = scene_.suns.empty() && holds_lights(box);
    if (!near_picture && !near_lights) return {};
    const PlaneBody cover = flattened(body, tolerance_);
    if (near_picture && covers_picture(cover)) return PlaneLeftOut::Why::covers_picture;
    if (near_lights && covers_lights(cover)) return PlaneLeftOut::Why::covers_lights;
    return {};
  }

 private:
  bool holds_lights(const Box2d& box) {
    if (!prepared_) prepare();
    return !lights_.empty() && holds_box(box, all_lights_);
  }

  void prepare() {
    prepared_ = true;
    for (const PlaneBody& body : scene_.bodies) {
      if (!body.light) continue;
      FlatLight light{flattened(body, tolerance_), {}};
      light.box = flat_bounds(light.flat);
      all_lights_.add(light.box);
      const Vec2d margin{tolerance_, tolerance_};
      light.box = {light.box.low - margin, light.box.high + margin};
      lights_.push_back(std::move(light));
    }
  }

  bool covers_picture(const PlaneBody& cover) {
    spend_(edges_of(cover));
    return every_edge(cover, [&](Vec2d a, Vec2d b) { return !enters(picture_, a, b); }) && holds_point(cover, picture_.center());
  }

  bool covers_lights(const PlaneBody& cover) {
    return std::all_of(lights_.begin(), lights_.end(), [&](const FlatLight& light) { return covers(cover, light); });
  }

  // Every contour of the light is in the cover if one point of it is, and no edges touch.
  bool covers(const PlaneBody& cover, const FlatLight& light) {
    spend_(edges_of(cover) * (1 + light.flat.contours.size()));
    for (const auto& contour : light.flat.contours)
      if (!contour.empty() && !holds_point(cover, contour.front())) return false;
    return every_edge(cover, [&](Vec2d a, Vec2d b) {
      if (!enters(light.box, a, b)) return true;
      spend_(edges_of(light.flat));
      return every_edge(light.flat, [&](Vec2d c, Vec2d d) { return distance_between(a, b, c, d) > tolerance_; });
    });
  }

  static std::uint64_t edges_of(const PlaneBody& flat) {
    std::uint64_t count = 0;
    for (const auto& contour : flat.contours) count += contour.size();
    return count;
  }

  const PlaneScene& scene_;
  double tolerance_;
  const std::function<void(std::uint64_t)>& spend_;
  Box2d picture_, all_lights_;
  std::vector<FlatLight> lights_;
  bool prepared_ = false;
};

struct Occluder {
  std::size_t body;
  Box2d box;
  std::optional<PlaneBody> flat;  // found when a place lies in the box
};

class BurialJudge {
 public:
  BurialJudge(const PlaneScene& scene, double tolerance) : scene_(scene), tolerance_(tolerance) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const PlaneBody& body = scene.bodies[i];
      const bool passes = body.transmittance.has_value() || body.light_depth > 0;
      if (!body.light && !passes && body.shape != PlaneBody::Shape::polyline) occluders_.push_back({i, bounds_of(body), std::nullopt});
    }
  }

  // The occluder that holds the first tested place, if one holds each place on either side of the light's edges that is not in the light.
  std::optional<std::size_t> around(const PlaneBody& light) {
    constexpr std::size_t kMostEdges = 256;
    const PlaneBody flat = flattened(light, tolerance_);
    std::size_t edges = 0, number = 0;
    every_edge(flat, [&](Vec2d, Vec2d) { return ++edges > 0; });
    const std::size_t step = edges / kMostEdges + 1;
    const Occluder* first = nullptr;
    const bool buried = every_edge(flat, [&](Vec2d a, Vec2d b) {
      if (number++ % step != 0 || a == b) return true;
      const Vec2d aside = Vec2d{a.y - b.y, b.x - a.x} * (2 * tolerance_ / length(b - a));
      for (const Vec2d place : {(a + b) * 0.5 + aside, (a + b) * 0.5 - aside}) {
        if (flat.shape == PlaneBody::Shape::polygon && holds_point(flat, place)) continue;
        const Occluder* holder = holder_of(place);
        if (holder == nullptr) return false;
        if (first == nullptr) first = holder;
      }
      return true;
    });
    return buried && first != nullptr ? std::optional(first->body) : std::nullopt;
  }

 private:
  const Occluder* holder_of(Vec2d place) {
    if (last_ != nullptr && last_->box.contains(place) && holds_point(*last_->flat, place)) return last_;
    for (Occluder& occluder : occluders_) {
      if (work_++ > kMostWork) return nullptr;
      if (!occluder.box.contains(place)) continue;
      if (!occluder.flat) occluder.flat = flattened(scene_.bodies[occluder.body], tolerance_);
      for (const auto& contour : occluder.flat->contours) work_ += contour.size();
      if (holds_point(*occluder.flat, place)) return last_ = &occluder;
    }
    return nullptr;
  }

  static constexpr std::uint64_t kMostWork = 20'000'000;  // about a tenth of a second
  const PlaneScene& scene_;
  double tolerance_;
  std::vector<Occluder> occluders_;
  const Occluder* last_ = nullptr;  // a light's places lie in one occluder, as a rule
  std::uint64_t work_ = 0;
};

}  // namespace

std::vector<BuriedLight> buried_lights(const PlaneScene& scene, double tolerance) {
  std::vector<BuriedLight> result;
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [](const PlaneBody& body) { return body.light.has_value(); })) return result;
  BurialJudge judge(scene, tolerance);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].light)
      if (const auto occluder = judge.around(scene.bodies[i])) result.push_back({i, *occluder});
  return result;
}

std::vector<Backdrop> backdrops_among(const PlaneScene& scene, const std::vector<std::size_t>& bodies, double tolerance,
                                      const std::function<void(std::uint64_t)>& spend) {
  BackdropJudge judge(scene, tolerance, spend);
  std::vector<Backdrop> result;
  for (const std::size_t i : bodies)
    if (const auto why = judge.why(scene.bodies[i])) result.push_back({i, *why});
  return result;
}

}  // namespace steradian::plane::svg
