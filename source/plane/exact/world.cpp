#include "plane/exact/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/emission.h"
#include "steradian/error.h"

namespace steradian {

const char* name_of(PlaneMethod method) {
  switch (method) {
    case PlaneMethod::exact: return "exact";
    case PlaneMethod::par: return "par";
    case PlaneMethod::sampled: return "sampled";
    case PlaneMethod::marched: return "marched";
  }
  return "?";
}

PlaneMethod plane_method_from_name(const std::string& name) {
  for (PlaneMethod m : {PlaneMethod::exact, PlaneMethod::par, PlaneMethod::sampled, PlaneMethod::marched})
    if (name == name_of(m)) return m;
  throw Error("method", "unknown method '" + name + "' for a plane scene", "use exact, par, sampled or marched");
}

PlaneWorld::Impl::Inside PlaneWorld::Impl::inside(Vec2d p) const {
  Inside result;
  for (int i : grid.bodies_near(p)) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (!boxes[k].holds(p) || !plane::contains(scene.bodies[k], p)) continue;
    if (!scene.bodies[k].light) return {i, true};
    result.body = std::max(result.body, i);
  }
  return result;
}

}  // namespace steradian

namespace steradian::plane {

using std::numbers::pi;

namespace {

template <class Counts>
PlaneLight envelope_sum(const World& world, const std::vector<const Curve*>& curves, Vec2d from, int inside,
                        EmissionParts parts, Counts counts) {
  PlaneLight sum;
  double open = 2 * pi;
  for (const Visible& v : lower_envelope(curves, from, world.scene.bodies, {inside})) {
    open -= v.end - v.begin;
    const auto& light = world.scene.bodies[static_cast<std::size_t>(v.curve->body)].light;
    if (!light || !counts(v.curve->body)) continue;
    if (v.curve->body == inside)
      add_interior(v, *light, from, sum);
    else
      add_emission(v, *light, from, parts, sum);
  }
  // On a light's edge its own outline leaves directions open: the point counts as inside.
  if (inside >= 0 && open > 0) sum.radiance += radiance_at(*world.scene.bodies[static_cast<std::size_t>(inside)].light, from) * open;
  const double scale = 1 / (2 * pi);
  return {sum.radiance * scale, sum.moment_x * scale, sum.moment_y * scale};
}

}  // namespace

PlaneLight envelope_light(const World& world, const std::vector<const Curve*>& curves, Vec2d from,
                          int inside_light, EmissionParts parts) {
  return envelope_sum(world, curves, from, inside_light, parts, [](int) { return true; });
}

// Directions and distances in which a light can be seen: the wedge about its bounding circle.
class Wedge {
 public:
  Wedge(const Box& light, Vec2d from) : from_(from) {
    const Vec2d to = (light.low + light.high) * 0.5 - from;
    const double radius = 0.5 * length(light.high - light.low) * (1 + 1e-9), d = length(to);
    everything_ = d <= radius;
    if (everything_) return;
    const double sine = radius / d, cosine = std::sqrt(1 - sine * sine);
    along_ = to / d;
    low_ = {along_.x * cosine + along_.y * sine, along_.y * cosine - along_.x * sine};
    high_ = {along_.x * cosine - along_.y * sine, along_.y * cosine + along_.x * sine};
    far_ = d + radius;
  }
  bool touches(const Curve& c) const {
    if (everything_) return true;
    if (c.kind == Curve::Kind::segment) return touches(c.a - from_, c.b - from_, 0);
    const Vec2d center = c.ellipse.center - from_;
    return touches(center, center, std::sqrt(dot(c.ellipse.x, c.ellipse.x) + dot(c.ellipse.y, c.ellipse.y)));
  }

 private:
  bool touches(Vec2d a, Vec2d b, double r) const {
    if (std::min(cross(high_, a), cross(high_, b)) > r || std::max(cross(low_, a), cross(low_, b)) < -r) return false;
    const double near = std::min(dot(along_, a), dot(along_, b)), far = std::max(dot(along_, a), dot(along_, b));
    return far >= -r && near <= far_ + r;
  }
  Vec2d from_, along_, low_, high_;
  double far_ = 0;
  bool everything_ = false;
};

PlaneLight envelope_light_of(const World& world, const std::vector<const Curve*>& curves, Vec2d from,
                             int only, EmissionParts parts) {
  const Wedge wedge(world.boxes[static_cast<std::size_t>(only)], from);
  thread_local std::vector<const Curve*> near;
  near.clear();
  for (const Curve* c : curves)
    if (wedge.touches(*c)) near.push_back(c);
  return envelope_sum(world, near, from, -1, parts, [&](int body) { return body == only; });
}

Vec3d light_between(const World& world, const std::vector<Curve>& parts, Vec2d from, int inside_light) {
  PlaneLight sum;
  double open = 2 * pi;
  thread_local std::vector<const Curve*> curves;
  curves.clear();
  for (const Curve& c : parts) curves.push_back(&c);
  for (const Visible& v : lower_envelope(curves, from, world.scene.bodies, {inside_light})) {
    open -= v.end - v.begin;
    if (const auto& light = world.scene.bodies[static_cast<std::size_t>(v.curve->body)].light)
      add_emission(v, *light, from, EmissionParts::radiance, sum);
  }
  const Vec3d own = radiance_at(*world.scene.bodies[static_cast<std::size_t>(inside_light)].light, from);
  return (sum.radiance + own * open) / (2 * pi);
}

namespace {

double nearest_in(const Box& box, Vec2d p) {
  return length({std::max({box.low.x - p.x, 0.0, p.x - box.high.x}), std::max({box.low.y - p.y, 0.0, p.y - box.high.y})});
}
double farthest_in(const Box& box, Vec2d p) {
  return length({std::max(p.x - box.low.x, box.high.x - p.x), std::max(p.y - box.low.y, box.high.y - p.y)});
}

// Only what is nearer than the farthest light that reaches the point can matter.
std::vector<const Curve*> curves_that_matter(const World& world, Vec2d p) {
  double reach = 0;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const auto& light = world.scene.bodies[i].light;
    if (!light || world.first_curve[i] == world.first_curve[i + 1]) continue;
    if (nearest_in(world.boxes[i], p) >= light->range) continue;
    reach = std::max(reach, std::min(farthest_in(world.boxes[i], p), light->range));
  }
  std::vector<const Curve*> result;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    if (nearest_in(world.boxes[i], p) > reach) continue;
    for (std::size_t c = world.first_curve[i]; c < world.first_curve[i + 1]; ++c) result.push_back(&world.curves[c]);
  }
  return result;
}

}  // namespace

}  // namespace steradian::plane

namespace steradian {

PlaneWorld::PlaneWorld(PlaneScene scene) : impl_(std::make_unique<Impl>()) {
  impl_->scene = std::move(scene);
  for (std::size_t i = 0; i < impl_->scene.bodies.size(); ++i) {
    impl_->first_curve.push_back(impl_->curves.size());
    const std::vector<plane::Curve> outline = plane::outline_of(impl_->scene.bodies[i], static_cast<int>(i));
    impl_->curves.insert(impl_->curves.end(), outline.begin(), outline.end());
    impl_->boxes.push_back(plane::bounds_of(impl_->scene.bodies[i]));
  }
  impl_->first_curve.push_back(impl_->curves.size());
  impl_->grid = plane::RayGrid(impl_->curves, impl_->scene.bodies);
}

PlaneWorld::~PlaneWorld() = default;
PlaneWorld::PlaneWorld(PlaneWorld&&) noexcept = default;
PlaneWorld& PlaneWorld::operator=(PlaneWorld&&) noexcept = default;

const PlaneScene& PlaneWorld::scene() const { return impl_->scene; }

PlaneLight PlaneWorld::query(Vec2d position, PlaneMethod method, const PlaneSampling& sampling) const {
  if (!is_finite(position)) throw Error("position", "a coordinate is not finite");
  if (method == PlaneMethod::par) return plane::par_light(*impl_, position);
  const Impl::Inside inside = impl_->inside(position);
  if (inside.dark) return {};
  switch (method) {
    case PlaneMethod::sampled: return plane::sampled_light(*impl_, position, sampling);
    case PlaneMethod::marched: return plane::marched_light(*impl_, position, sampling);
    default: return plane::envelope_light(*impl_, plane::curves_that_matter(*impl_, position), position, inside.body);
  }
}

}  // namespace steradian
