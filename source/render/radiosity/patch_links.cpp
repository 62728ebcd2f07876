#include "render/radiosity/patch_links.h"

#include <algorithm>
#include <atomic>
#include <tuple>

#include "render/radiosity/bounce_rays.h"

namespace steradian::radiosity {
namespace {

std::shared_ptr<const Patches> patches_of(const Scene& scene, const RayScene& rays, std::size_t wanted) {
  auto patches = std::make_shared<Patches>(scene, wanted);
  patches->split(scene, rays);
  return patches;
}

// All of a mesh that rays and surfaces depend on.
auto surface_of(const Mesh& m) {
  return std::tie(m.material, m.positions, m.normals, m.tangents, m.texcoords[0], m.texcoords[1], m.colors, m.indices, m.casts_shadow);
}

SurfaceMaterial unlit(SurfaceMaterial material) {
  material.emissive = {};
  material.emissive_texture = {};
  return material;
}

// A ball around a lamp's shape.
struct LampBall {
  Vec3d middle;
  double radius = 0;

  // slack: of the roundings of rays
  LampBall(const std::vector<Vec3f>& positions, double slack) {
    if (positions.empty()) return;
    Vec3f low = positions.front(), high = low;
    for (const Vec3f& p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    middle = (static_cast<Vec3d>(low) + static_cast<Vec3d>(high)) * 0.5;
    for (const Vec3f& p : positions) radius = std::max(radius, length(static_cast<Vec3d>(p) - middle));
    radius += slack;
  }
  bool is_met(Vec3d from, Vec3d along) const {
    const Vec3d to = middle - from;
    if (dot(to, to) <= radius * radius) return true;
    const Vec3d off = cross(to, along);  // along: unit
    return dot(to, along) > 0 && dot(off, off) <= radius * radius;
  }
};

}  // namespace

Surface surface_at_site(const Scene& scene, const MipMaps& maps, const Patches::Site& at, bool front) {
  const Mesh& mesh = scene.meshes[at.mesh];
  const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * std::size_t{at.triangle} + i]]; };
  const Vec3f across = cross(corner(1) - corner(0), corner(2) - corner(0));
  const float size = length(across);
  const Vec3f normal = size > 0 ? across / size : Vec3f{0, 0, 1};
  return surface_at(scene, mesh, at.triangle, at.u, at.v, front ? normal : -normal, {&maps, {at.step, 0}, {0, at.step}});
}

PatchLinks::PatchLinks(const Scene& scene, const RayScene& rays, std::size_t wanted) : patches_(patches_of(scene, rays, wanted)) {}

bool PatchLinks::serve_both(const Scene& a, const Scene& b) {
  const auto same_mesh = [](const Mesh& m, const Mesh& n) {
    return m.is_light_shape == n.is_light_shape && (m.is_light_shape || surface_of(m) == surface_of(n));
  };
  const auto same_material = [](const SurfaceMaterial& m, const SurfaceMaterial& n) { return m == n || unlit(m) == unlit(n); };
  return std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(), same_mesh) &&
         std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(), same_material) && a.images == b.images;
}

void PatchLinks::keep_lamps(const Scene& scene, const RayScene& rays) {
  lamps_.clear();
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    if (scene.meshes[m].is_light_shape) lamps_.push_back({m, scene.meshes[m].positions});
  reach_ = rays.reach();
}

void PatchLinks::find(const Scene& scene, const RayScene& rays, const MipMaps& maps, std::size_t count, const Each& each) {
  side_rays_ = SideRays(count);
  met_.assign(count * patches_->side_count(), kNoSide);
  absorbed_.assign(patches_->side_count(), {});
  keep_lamps(scene, rays);
  trace(scene, rays, maps, each, [](Vec3d, Vec3d) { return true; });
}

bool PatchLinks::follow(const Scene& scene, const RayScene& rays, const MipMaps& maps, const Each& each) {
  if (rays.reach() != reach_) return false;
  constexpr double kSlack = 1e-5;  // of the scene's size: a hundred times the roundings of rays
  std::vector<LampBall> changed;
  for (const LampShape& lamp : lamps_) {
    const std::vector<Vec3f>& now = scene.meshes[lamp.mesh].positions;
    if (now == lamp.positions) continue;
    for (const auto* positions : {&lamp.positions, &now}) changed.emplace_back(*positions, kSlack * static_cast<double>(reach_));
  }
  keep_lamps(scene, rays);
  traced_ = 0;
  if (!changed.empty())
    trace(scene, rays, maps, each, [&](Vec3d from, Vec3d along) {
      return std::any_of(changed.begin(), changed.end(), [&](const LampBall& ball) { return ball.is_met(from, along); });
    });
  return true;
}

void PatchLinks::trace(const Scene& scene, const RayScene& rays, const MipMaps& maps, const Each& each, const Asked& asked) {
  constexpr std::size_t kLanes = BounceRays::kLanes;
  std::atomic<std::uint64_t> traced{0};
  each(patches_->side_count(), [&](std::size_t side) {
    const auto number = static_cast<std::uint32_t>(side);
    const Surface surface = surface_at_site(scene, maps, patches_->site(number), Patches::is_front(number));
    const Frame frame = SideRays::frame(surface, side);
    BounceRays bounce(rays, *patches_, RayScene::Order::scattered);
    for (std::size_t i = 0; i < kLanes; ++i) bounce.start(i, surface);
    const Vec3d from = bounce.origin(0);
    std::array<std::size_t, kLanes> packet;  // numbers of rays
    std::size_t count = 0, of_side = 0;
    const auto flush = [&] {
      const auto met = bounce.trace();
      for (std::size_t i = 0; i < count; ++i) {
        met_[side * this->rays() + packet[i]] = met[i].side;
        if (met[i].side == kNoSide || !bounce.any_tint()) continue;
        const Vec3f tint = bounce.tint(i);
        if (tint != Vec3f{1, 1, 1}) absorbed_[side].push_back({packet[i], Vec3f{1, 1, 1} - tint});
      }
      of_side += count;
      count = 0;
    };
    for (std::size_t k = 0; k < this->rays(); ++k) {
      const auto to = static_cast<Vec3f>(frame.to_world(side_rays_.direction(k)));
      if (!asked(from, static_cast<Vec3d>(to))) continue;
      std::erase_if(absorbed_[side], [&](const Absorbed& a) { return a.ray == k; });
      bounce.set(count, to);
      packet[count++] = k;
      if (count == kLanes) flush();
    }
    if (count > 0) flush();
    std::sort(absorbed_[side].begin(), absorbed_[side].end(), [](const Absorbed& a, const Absorbed& b) { return a.ray < b.ray; });
    traced += of_side;
  });
  traced_ = traced;
}

}  // namespace steradian::radiosity
