#include "render/sampled/through_glass.h"

namespace steradian {
namespace {

Vec3d seen_along(const PathScene& in, const PassedRays& passed, const PassedRays::Ray& ray, int bounces, reference::Random& random) {
  constexpr int kMostPassed = 8;
  Vec3f origin = ray.origin;
  Vec3d passes{1, 1, 1};
  for (int k = 0; k <= kMostPassed; ++k) {
    RTCRayHit hit;
    if (!in.rays.intersect(origin, ray.direction, hit)) return static_cast<Vec3d>(passed.background(ray.direction)) * passes;
    const Mesh& mesh = in.scene.meshes[hit.hit.geomID];
    const Surface s = surface_at(in.scene, mesh, hit.hit.primID, hit.hit.u, hit.hit.v, -ray.direction);
    if (light_passes(in.scene, mesh)) {
      passes = passes * static_cast<Vec3d>(in.sampler.clear_meshes().at_face(hit.hit.geomID));
      origin = static_cast<Vec3f>(in.rays.off_surface(static_cast<Vec3d>(s.position), -static_cast<Vec3d>(s.geometric_normal)));
      continue;
    }
    Vec3d light = static_cast<Vec3d>(s.emission) + in.sampler.estimate(s, -ray.direction, LobeChoice::all, 1, random).mean;
    const int left = bounces == kAllBounces ? kAllBounces : bounces - 1;
    if (left != 0) light += trace_paths(in, s, -ray.direction, left, 1, random).mean;
    return light * passes;
  }
  return {};
}

}  // namespace

Estimate trace_through(const PathScene& scene, const PassedRays& passed, const Surface& face, Vec3f view, Vec3f passes, int bounces,
                       int paths, reference::Random& random) {
  return mean_of_paths(paths, [&]() -> Vec3d {
    const PassedRays::Ray ray = passed.pass_at_random(face, view, random);
    if (!(ray.weight.x > 0 || ray.weight.y > 0 || ray.weight.z > 0)) return {};
    return seen_along(scene, passed, ray, bounces, random) * static_cast<Vec3d>(passes * ray.weight);
  });
}

}  // namespace steradian
