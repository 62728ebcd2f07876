#include "render/sampled/paths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lobes/lobe.h"

namespace steradian {
namespace {

constexpr int kMostBounces = 1000;  // of kAllBounces: a path of albedo 1 that roulette has not ended by then counts as ended
constexpr int kSureBounces = 3;     // bounces before roulette begins

Vec3d wide(Vec3f v) { return static_cast<Vec3d>(v); }

// The lobes of a surface for one view.
class LobesAt {
 public:
  LobesAt(const PathScene& in, const Surface& surface, Vec3f view) {
    for (const SurfaceLobe& l : lobes_of(surface, in.sampler.fitted())) {
      const Frame frame = Frame::from_normal_and_tangent(normalized(wide(l.normal)), wide(surface.tangent));
      const lobes::Lobe lobe(lobes::in_frame(l.material, frame), normalized(frame.to_local(wide(view))));
      if (lobe.above_surface()) lobes_.push_back({frame, lobe});
    }
  }
  std::size_t count() const { return lobes_.size(); }

  // A direction by one of the lobes, and what all of them reflect from there, over the sum of their densities.
  struct Direction {
    Vec3f to;
    Vec3d weight;
  };
  std::optional<Direction> sample(std::size_t number, reference::Random& random) const {
    const LobeInFrame& sampled = lobes_[number];
    const double a = random.uniform(), b = random.uniform();
    const Vec3d l = sampled.lobe.sample(a, b), to = sampled.frame.to_world(l);
    if (!(l.z > 0)) return {};
    double pdf = 0;
    Vec3d f{};
    for (const LobeInFrame& other : lobes_) {
      const Vec3d there = &other == &sampled ? l : other.frame.to_local(to);
      if (!(there.z > 0)) continue;
      pdf += other.lobe.pdf(there);
      f += other.lobe.radiance(other.lobe.evaluate(there));
    }
    if (!(pdf > 0)) return {};
    return Direction{static_cast<Vec3f>(to), f / pdf};
  }

 private:
  struct LobeInFrame {  // a coat may have a normal of its own
    Frame frame;
    lobes::Lobe lobe;
  };
  std::vector<LobeInFrame> lobes_;
};

// The surface in a direction from another; none if the ray leaves the scene, or meets a surface that reflects nothing. Multiplies the
// throughput by what clear surfaces on the way pass.
std::optional<Surface> next_surface(const PathScene& in, const Surface& from, Vec3f direction, Vec3d& throughput) {
  // Below its own triangle a surface sees nothing.
  if (!(dot(direction, from.geometric_normal) > 0)) return {};
  constexpr int kMostPassed = 8;
  auto origin = static_cast<Vec3f>(in.rays.off_surface(wide(from.position), wide(from.geometric_normal)));
  for (int passed = 0; passed <= kMostPassed; ++passed) {
    RTCRayHit hit;
    if (!in.rays.intersect(origin, direction, hit)) return {};
    const Mesh& mesh = in.scene.meshes[hit.hit.geomID];
    const Surface next = surface_at(in.scene, mesh, hit.hit.primID, hit.hit.u, hit.hit.v, -direction);
    if (!light_passes(in.scene, mesh)) return next.material->unlit ? std::nullopt : std::optional(next);
    throughput = throughput * wide(in.sampler.clear_meshes().at_face(hit.hit.geomID));
    origin = static_cast<Vec3f>(in.rays.off_surface(wide(next.position), -wide(next.geometric_normal)));
  }
  return {};
}

// Light that a path brings from its first direction on, per unit of its weight.
Vec3d follow(const PathScene& in, const Surface& receiver, Vec3f direction, int bounces, reference::Random& random) {
  Vec3d sum{}, throughput{1, 1, 1};
  std::optional<Surface> surface = next_surface(in, receiver, direction, throughput);
  const int most = bounces == kAllBounces ? kMostBounces : bounces;
  for (int bounce = 1; surface && bounce <= most; ++bounce) {
    sum += throughput * in.sampler.estimate(*surface, -direction, LobeChoice::all, 1, random).mean;
    if (bounce == most) break;
    const LobesAt lobes(in, *surface, -direction);
    if (lobes.count() == 0) break;
    const auto number = std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(lobes.count())), lobes.count() - 1);
    const auto next = lobes.sample(number, random);
    if (!next) break;
    throughput = throughput * next->weight * static_cast<double>(lobes.count());
    if (bounce >= kSureBounces) {
      const double survives = std::clamp(std::max({throughput.x, throughput.y, throughput.z}), 0.05, 0.95);
      if (random.uniform() >= survives) break;
      throughput = throughput / survives;
    }
    direction = next->to;
    surface = next_surface(in, *surface, direction, throughput);
  }
  return sum;
}

}  // namespace

Estimate trace_paths(const PathScene& scene, const Surface& receiver, Vec3f view, int bounces, int paths, reference::Random& random) {
  const LobesAt lobes(scene, receiver, view);
  if (lobes.count() == 0) return {};
  return mean_of_paths(paths, [&] {
    Vec3d x{};
    for (std::size_t i = 0; i < lobes.count(); ++i)  // one direction from each lobe: the multiple-sample balance heuristic
      if (const auto to = lobes.sample(i, random)) x += to->weight * follow(scene, receiver, to->to, bounces, random);
    return x;
  });
}

}  // namespace steradian
