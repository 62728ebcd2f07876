#include "plane/exact/world.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <string>

#include "core/budget.h"
#include "core/words.h"
#include "plane/exact/emission.h"
#include "plane/exact/on_curve.h"
#include "plane/extras/extras.h"
#include "plane/extras/sight.h"
#include "plane/extras/trace.h"

namespace steradian {

const char* name_of(PlaneMethod method) { return words::name_of(method); }

PlaneMethod plane_method_from_name(const std::string& name) {
  if (const auto method = words::find<PlaneMethod>(name)) return *method;
  throw Error("method", "unknown method '" + name + "' for a plane scene", "use " + words::choices<PlaneMethod>());
}

PlaneWorld::Impl::Around PlaneWorld::Impl::around(Vec2d p) const {
  Around result{p, {}, {}};
  const auto look_at = [&](std::size_t k) {
    if (!boxes[k].contains(p)) return;
    const std::size_t before = result.on.size();
    for (std::size_t c = first_curve[k]; c < first_curve[k + 1]; ++c)
      if (plane::is_on(curves[c], p)) result.on.push_back(&curves[c]);
    const bool in_light = scene.bodies[k].light && scene.bodies[k].shape != PlaneBody::Shape::polyline && result.on.size() > before;
    if (in_light || contains(k, p)) result.holders.push_back(static_cast<int>(k));
  };
  if (grid.is_empty())
    for (std::size_t k = 0; k < boxes.size(); ++k) look_at(k);
  else
    for (int i : grid.bodies_near(p)) look_at(static_cast<std::size_t>(i));
  return result;
}

PlaneWorld::Impl::Around PlaneWorld::Impl::off_outlines(Around here) const {
  if (here.on.empty()) return here;
  const auto last_light = [&](const Around& a) {
    int last = -1;
    for (int i : a.holders)
      if (scene.bodies[static_cast<std::size_t>(i)].light) last = i;
    return last;
  };
  Around best;
  int rank = 0;
  for (Vec2d q : plane::places_beside(here.on, here.at)) {
    Around there = around(q);
    if (!there.on.empty() || !std::includes(here.holders.begin(), here.holders.end(), there.holders.begin(), there.holders.end())) continue;
    const int its = there.holders == here.holders ? 3 : last_light(there) == last_light(here) ? 2 : 1;
    if (its > rank) rank = its, best = std::move(there);
    if (rank == 3) break;
  }
  return rank > 0 ? best : here;
}

PlaneWorld::Impl::Inside PlaneWorld::Impl::inside(Vec2d p) const {
  const Around here = around(p);
  for (int i : here.holders)
    if (!scene.bodies[static_cast<std::size_t>(i)].light) return {i, true, p};
  const Around beside = off_outlines(here);
  return {beside.holders.empty() ? -1 : beside.holders.back(), false, beside.at};
}

int PlaneWorld::Impl::occluder_at(Vec2d p) const {
  int result = -1;
  for (int i : grid.bodies_near(p)) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (i > result && !scene.bodies[k].light && boxes[k].contains(p) && contains(k, p)) result = i;
  }
  return result;
}

}  // namespace steradian

namespace steradian::plane {

using std::numbers::pi;

namespace {

template <class Counts>
PlaneLight envelope_sum(const World& world, const std::vector<const Curve*>& curves, Vec2d from, int inside, EmissionParts parts,
                        Counts counts) {
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
  // Its own outline may leave directions open, by rounding.
  if (inside >= 0 && open > 0) sum.radiance += radiance_at(*world.scene.bodies[static_cast<std::size_t>(inside)].light, from) * open;
  const double scale = 1 / (2 * pi);
  return {sum.radiance * scale, sum.moment_x * scale, sum.moment_y * scale};
}

}  // namespace

PlaneLight envelope_light(const World& world, const std::vector<const Curve*>& curves, Vec2d from, int inside_light, EmissionParts parts) {
  return envelope_sum(world, curves, from, inside_light, parts, [](int) { return true; });
}

// Directions and distances in which a light can be visible: the wedge around its bounding circle.
class Wedge {
 public:
  Wedge(const Box2d& light, Vec2d from) : from_(from) {
    const Vec2d to = light.center() - from;
    const double radius = light.radius() * (1 + 1e-9), d = length(to);
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

PlaneLight envelope_light_of(const World& world, const std::vector<const Curve*>& curves, Vec2d from, int only, EmissionParts parts) {
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

double nearest_in(const Box2d& box, Vec2d p) {
  return length({std::max({box.low.x - p.x, 0.0, p.x - box.high.x}), std::max({box.low.y - p.y, 0.0, p.y - box.high.y})});
}
double farthest_in(const Box2d& box, Vec2d p) {
  return length({std::max(p.x - box.low.x, box.high.x - p.x), std::max(p.y - box.low.y, box.high.y - p.y)});
}

// Only curves nearer than the farthest light that reaches the point can matter. From within a light, that light counts at any distance.
std::vector<const Curve*> curves_that_matter(const World& world, Vec2d p, int inside_light) {
  // With more lights, the tests of their wedges take longer than the curves that they spare.
  constexpr std::size_t kMostWedges = 16;
  thread_local std::vector<Wedge> wedges;
  wedges.clear();
  double reach = inside_light >= 0 ? farthest_in(world.boxes[static_cast<std::size_t>(inside_light)], p) : 0;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const auto& light = world.scene.bodies[i].light;
    if (!light || world.first_curve[i] == world.first_curve[i + 1]) continue;
    if (nearest_in(world.boxes[i], p) >= light->range) continue;
    reach = std::max(reach, std::min(farthest_in(world.boxes[i], p), light->range));
    if (wedges.size() <= kMostWedges) wedges.emplace_back(world.boxes[i], p);
  }
  // From inside a light, every direction counts.
  const bool in_wedges = inside_light < 0 && wedges.size() <= kMostWedges;
  std::vector<const Curve*> result;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    if (nearest_in(world.boxes[i], p) > reach) continue;
    for (std::size_t c = world.first_curve[i]; c < world.first_curve[i + 1]; ++c)
      if (!in_wedges || std::any_of(wedges.begin(), wedges.end(), [&](const Wedge& w) { return w.touches(world.curves[c]); }))
        result.push_back(&world.curves[c]);
  }
  return result;
}

}  // namespace

}  // namespace steradian::plane

namespace steradian {

namespace {

double scale_of(const PlaneScene& scene) {
  const double side = std::max(scene.width, scene.height);
  return side > 1e-12 && side < 1e12 ? std::ldexp(1.0, 10 - std::ilogb(side)) : 1;
}

void scale_body(PlaneBody& body, double scale) {
  for (auto& contour : body.contours)
    for (Vec2d& p : contour) p = p * scale;
  body.center = body.center * scale;
  body.x_axis = body.x_axis * scale;
  body.y_axis = body.y_axis * scale;
  body.radius *= scale;
  body.light_depth *= scale;
  if (!body.light) return;
  PlaneEmission& light = *body.light;
  light.range *= scale;
  const double brighter = light.profile == PlaneProfile::inverse ? scale : 1;  // divided by a longer distance
  light.radiance = light.radiance * brighter;
  if (!light.gradient) return;
  light.gradient->from = light.gradient->from * scale;
  light.gradient->to = light.gradient->to * scale;
  for (PlaneStop& stop : light.gradient->stops) stop.radiance = stop.radiance * brighter;
}

PlaneScene scaled(PlaneScene scene, double scale) {
  scene.origin = scene.origin * scale;
  scene.width *= scale;
  scene.height *= scale;
  scene.fog_density /= scale;
  for (PlaneBody& body : scene.bodies) scale_body(body, scale);
  return scene;
}

std::size_t edges_of(const PlaneBody& body) {
  std::size_t edges = 4;
  for (const auto& contour : body.contours) edges += contour.size();
  return edges;
}

// From this many edges on, rows find the edges at a point's height faster than a loop over all of them.
constexpr std::size_t kManyEdges = 24;

}  // namespace

// Is the radiance the same from every place of the body, in all directions and at all distances?
static bool shines_alike(const PlaneBody& body) {
  return !body.light || (!body.light->gradient && body.light->profile == PlaneProfile::uniform && std::isinf(body.light->range) &&
                         body.light->spot_half_angle == 0);
}

PlaneWorld::Impl::Impl(PlaneScene from, const Limits& limits, Use use) : scene(std::move(from)), scale(scale_of(scene)) {
  extras = plane::extras_of(scene);
  if (scale != 1 && use == Use::frames) {
    scene = scaled(std::move(scene), scale);
  } else if (scale != 1) {
    given = std::move(scene);
    scene = scaled(*given, scale);
  }
  std::size_t edges = 0;
  for (const PlaneBody& body : scene.bodies) edges += edges_of(body);
  Budget budget(limits);
  const std::string what = "the " + std::to_string(edges) + " edges of its shapes";
  budget.take_memory(scene.name, what, edges * 3 * sizeof(plane::Curve));
  budget.take_work(scene.name, what, edges * 1000);
  try {
    take_apart(edges, use);
  } catch (const std::bad_alloc&) {
    throw budget.out_of_memory();
  }
}

PlaneWorld::Impl::~Impl() = default;

void PlaneWorld::Impl::take_apart(std::size_t edges, Use use) {
  curves.reserve(use == Use::all ? edges : edges + edges / 2 + 1024);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const PlaneBody& body = scene.bodies[i];
    if (beyond_par == nullptr && !shines_alike(body)) beyond_par = &body;
    first_curve.push_back(curves.size());
    const std::vector<plane::Curve> outline = plane::outline_of(body, static_cast<int>(i));
    curves.insert(curves.end(), outline.begin(), outline.end());
    boxes.push_back(plane::bounds_of(body));
    add_rows(i);
  }
  first_curve.push_back(curves.size());
  if (use == Use::all) grid = plane::RayGrid(curves, scene.bodies);
}

void PlaneWorld::Impl::add_rows(std::size_t i) {
  const PlaneBody& body = scene.bodies[i];
  const bool many = body.shape == PlaneBody::Shape::polygon && edges_of(body) > kManyEdges;
  rows_of.push_back(many ? static_cast<int>(rows.size()) : -1);
  if (many) rows.emplace_back(body.contours);
}

bool PlaneWorld::Impl::set_body(std::size_t i, PlaneBody body) {
  scale_body(body, scale);
  const std::vector<plane::Curve> outline = plane::outline_of(body, static_cast<int>(i));
  const bool many = body.shape == PlaneBody::Shape::polygon && edges_of(body) > kManyEdges;
  if (outline.size() != first_curve[i + 1] - first_curve[i] || many != (rows_of[i] >= 0)) return false;
  std::copy(outline.begin(), outline.end(), curves.begin() + static_cast<std::ptrdiff_t>(first_curve[i]));
  boxes[i] = plane::bounds_of(body);
  if (many) rows[static_cast<std::size_t>(rows_of[i])] = plane::EdgeRows(body.contours);
  scene.bodies[i] = std::move(body);
  return true;
}

bool PlaneWorld::Impl::append(PlaneBody body) {
  scale_body(body, scale);
  const std::vector<plane::Curve> outline = plane::outline_of(body, static_cast<int>(scene.bodies.size()));
  if (curves.size() + outline.size() > curves.capacity()) return false;  // others point to them
  curves.insert(curves.end(), outline.begin(), outline.end());
  first_curve.push_back(curves.size());
  boxes.push_back(plane::bounds_of(body));
  scene.bodies.push_back(std::move(body));
  add_rows(scene.bodies.size() - 1);
  return true;
}

void PlaneWorld::Impl::drop(std::size_t i) {
  scene.bodies[i].light.reset();
  boxes[i] = {};
}

bool PlaneWorld::Impl::contains(std::size_t i, Vec2d p) const {
  const int with = rows_of[i];
  return with < 0 ? plane::contains(scene.bodies[i], p) : rows[static_cast<std::size_t>(with)].contains(p, scene.bodies[i].even_odd);
}

PlaneLight PlaneWorld::Impl::light_at(Vec2d p) const {
  const Inside in = inside(p);
  if (in.dark) return {};
  return plane::envelope_light(*this, plane::curves_that_matter(*this, in.at, in.body), in.at, in.body);
}

PlaneWorld::PlaneWorld(PlaneScene scene, const Limits& limits) : impl_(std::make_unique<Impl>(std::move(scene), limits)) {}

PlaneWorld::~PlaneWorld() = default;
PlaneWorld::PlaneWorld(PlaneWorld&&) noexcept = default;
PlaneWorld& PlaneWorld::operator=(PlaneWorld&&) noexcept = default;

const PlaneScene& PlaneWorld::scene() const { return impl_->given ? *impl_->given : impl_->scene; }

PlaneLight PlaneWorld::query(Vec2d position, PlaneMethod method, const PlaneSampling& sampling) const {
  if (!is_finite(position)) throw Error("position", "a coordinate is not finite");
  position = position * impl_->scale;
  if (impl_->extras) {
    if (method == PlaneMethod::exact) return plane::sight_from(*impl_, position);
    if (method == PlaneMethod::sampled) return plane::traced_light(*impl_, position, sampling);
    throw Error(impl_->scene.name, "has " + impl_->extras->names + ", of which the method " + name_of(method) + " knows nothing",
                "use exact or sampled");
  }
  if (method == PlaneMethod::par) {
    if (const PlaneBody* body = impl_->beyond_par)
      throw Error(body->name.empty() ? impl_->scene.name : impl_->scene.name + ": " + body->name,
                  "a light with a range, a spot, a profile or a gradient, of which the method par knows nothing", "use exact");
    return plane::par_light(*impl_, position);
  }
  if (method == PlaneMethod::exact) return impl_->light_at(position);
  const Impl::Inside in = impl_->inside(position);
  if (in.dark) return {};
  switch (method) {
    case PlaneMethod::sampled: return plane::sampled_light(*impl_, in.at, in.body, sampling);
    default: return plane::marched_light(*impl_, in.at, in.body, sampling);
  }
}

}  // namespace steradian
