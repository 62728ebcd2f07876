#include "render/radiosity/bounce_rays.h"

#include <algorithm>
#include <limits>

namespace steradian::radiosity {

BounceRays::BounceRays(const RayScene& rays, const Patches& patches, RayScene::Order order)
    : rays_(rays), patches_(patches), order_(order) {
  std::fill_n(packet_.ray.dir_z, kLanes, 1.0f);  // a direction for lanes without a ray, too
  std::fill_n(packet_.ray.mask, kLanes, 1u);     // what the camera sees
}

void BounceRays::start(std::size_t lane, const Surface& from) {
  origin_[lane] = static_cast<Vec3f>(rays_.off_surface(static_cast<Vec3d>(from.position), static_cast<Vec3d>(from.geometric_normal)));
  normal_[lane] = from.geometric_normal;
}

std::array<PatchPlace, BounceRays::kLanes> BounceRays::trace() {
  std::array<PatchPlace, kLanes> places;
  if (asked_ == 0) return places;
  alignas(64) int valid[kLanes];
  std::array<unsigned, kLanes> met;  // mesh
  met.fill(RTC_INVALID_GEOMETRY_ID);
  RTCRay16& ray = packet_.ray;
  for (std::size_t i = 0; i < kLanes; ++i) {
    valid[i] = (asked_ >> i & 1) != 0 ? -1 : 0;
    ray.org_x[i] = origin_[i].x;
    ray.org_y[i] = origin_[i].y;
    ray.org_z[i] = origin_[i].z;
    ray.tnear[i] = 0;
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet_.hit.geomID[i] = packet_.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  tint_.fill({1, 1, 1});
  any_tint_ = false;
  constexpr int kMostPassed = 8;
  for (int passed = 0; passed <= kMostPassed; ++passed) {
    rays_.intersect(valid, packet_, order_);
    // Rays go straight through glass, and are traced again behind it.
    bool again = false;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (valid[i] == 0) continue;
      const unsigned mesh = packet_.hit.geomID[i];
      valid[i] = mesh != RTC_INVALID_GEOMETRY_ID && patches_.lets_through(mesh) ? -1 : 0;
      if (valid[i] == 0) {
        met[i] = mesh;
        continue;
      }
      again = any_tint_ = true;
      tint_[i] = tint_[i] * patches_.clear_meshes().at_face(mesh);
      ray.tnear[i] = ray.tfar[i] * (1 + 2e-5f);
      ray.tfar[i] = std::numeric_limits<float>::infinity();
      packet_.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!again) break;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    if ((asked_ >> i & 1) == 0 || met[i] == RTC_INVALID_GEOMETRY_ID) continue;
    // Embree's normal is that of the winding.
    const float towards = packet_.hit.Ng_x[i] * ray.dir_x[i] + packet_.hit.Ng_y[i] * ray.dir_y[i] + packet_.hit.Ng_z[i] * ray.dir_z[i];
    const PatchPlace place = patches_.place_at(met[i], packet_.hit.primID[i], packet_.hit.u[i], packet_.hit.v[i], towards < 0);
    if (place.side == kNoSide) continue;
    const Vec3f way = {ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]};
    places[i] = patches_.seen_along(place, origin_[i] + way * ray.tfar[i], rays_);
  }
  asked_ = 0;
  return places;
}

}  // namespace steradian::radiosity
