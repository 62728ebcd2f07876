#include "render/radiosity/mirror/patches_in_lobes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/lattices.h"
#include "lobes/ggx.h"

namespace steradian::radiosity {
namespace {

constexpr std::size_t kDirections = 128;
constexpr std::size_t kLanes = BounceRays::kLanes;

}  // namespace

// The highlights that a lobe sees are widened by about the distance between its directions. Rays and directions see the same.
Vec3f PatchesInLobes::radiance(const PatchPlace& met, Vec3f to, float width) const {
  if (met.side == kNoSide) return {};
  return light_.radiance(met) + light_.glossy_radiance(met.side, -to, 0.5f * width);
}

void PatchesInLobes::along_rays(const Mirrors& mirrors, const StandsFor& stands_for, TileVector& result) const {
  BounceRays rays(rays_, light_.patches(), RayScene::Order::neighbours);
  const PassedRays::Ways& ways = mirrors.ways;
  for (std::size_t first = 0; first < kTilePixels; first += kLanes) {
    bool any = false;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::size_t slot = first + i;
      put(result, slot, {});
      if (ways.bent[slot] == 0 || stands_for[slot] == 0) continue;
      const Vec3f direction = get(ways.direction, slot);
      rays.start_off(i, get(ways.origin, slot), direction);
      rays.set(i, direction);
      any = true;
    }
    if (!any) continue;
    const auto met = rays.trace();
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::size_t slot = first + i;
      if (met[i].side == kNoSide) continue;
      const float width = std::max(mirrors.alpha_x[slot], mirrors.alpha_y[slot]);
      put(result, slot, radiance(met[i], get(ways.direction, slot), width) * rays.tint(i) * get(ways.shares, slot));
    }
  }
}

PatchesInLobes::Seen PatchesInLobes::seen_by(const MirrorLobe& at) const {
  constexpr std::size_t kQuarters = 4;
  BounceRays rays(rays_, light_.patches(), RayScene::Order::neighbours);
  Material material;
  material.brdf = Brdf::ggx;
  material.alpha_x = static_cast<double>(at.alpha_x);
  material.alpha_y = static_cast<double>(at.alpha_y);
  material.f0 = material.f90 = {1, 1, 1};
  const float width = std::max(at.alpha_x, at.alpha_y);
  std::array<Vec3f, kQuarters> light{};
  std::array<float, kQuarters> weights{};
  Vec3f of_squares{};
  for (std::size_t first = 0; first < kDirections; first += kLanes) {
    std::array<Vec3f, kLanes> to{};
    std::array<float, kLanes> weight{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      MirrorLobe from = at;
      if (samples_ > 1) {
        const auto [x, y] = r2_place(static_cast<double>(first + i) + 0.5);
        const auto moved = [&](Vec3f value, Vec3f right, Vec3f down) {
          return value + right * static_cast<float>(x - 0.5) + down * static_cast<float>(y - 0.5);
        };
        from.origin = moved(at.origin, at.right.origin, at.down.origin);
        from.normal = normalized(moved(at.normal, at.right.normal, at.down.normal));
        from.view = normalized(moved(at.view, at.right.view, at.down.view));
      }
      const Frame frame = Frame::from_normal_and_tangent(static_cast<Vec3d>(from.normal), static_cast<Vec3d>(at.tangent));
      const Vec3d view = frame.to_local(static_cast<Vec3d>(from.view));
      if (!(view.z > 0)) continue;
      const lobes::Ggx lobe(material, view);
      const auto [u, v] = fibonacci_place(first + i, kDirections, 0);
      const Vec3d l = lobe.sample(u, v);
      const double pdf = l.z > 0 ? lobe.pdf(l) : 0;
      if (!(pdf > 0)) continue;
      weight[i] = static_cast<float>(lobe.evaluate(l).plain / pdf);
      to[i] = above_triangle(static_cast<Vec3f>(frame.to_world(l)), at.geometric_normal);
      rays.start_off(i, from.origin, to[i]);
      rays.set(i, to[i]);
    }
    const auto met = rays.trace();
    for (std::size_t i = 0; i < kLanes; ++i) {
      weights[i % kQuarters] += weight[i];
      const Vec3f seen = radiance(met[i], to[i], width) * rays.tint(i);
      light[i % kQuarters] += seen * weight[i];
      of_squares += seen * seen * weight[i];
    }
  }
  const float all = weights[0] + weights[1] + weights[2] + weights[3];
  if (!(all > 0)) return {};
  const Vec3f sum = light[0] + light[1] + light[2] + light[3];
  const Seen seen = {mean_of_quarters(light, weights), spread(of_squares, sum, {all, all, all}) * (1 / all)};
  return seen;
}

}  // namespace steradian::radiosity
