// Patches::split: sides that a wall crosses become several.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/radiosity/patches.h"

namespace steradian::radiosity {
namespace {

// A patch's triangle, with places a little above it.
struct Raised {
  Vec3f corner, right, up;
  Vec3d lift;
  float size = 0;  // of the patch; 0: the triangle has no area

  Raised(const Mesh& mesh, const Patches::Site& at, bool front, const RayScene& rays) {
    constexpr float kHeight = 0.02f;  // in sizes of the patch
    const auto corner_of = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * std::size_t{at.triangle} + i]]; };
    corner = corner_of(0);
    right = corner_of(1) - corner;
    up = corner_of(2) - corner;
    const Vec3f across = cross(right, up);
    if (!(length(across) > 0)) return;
    size = std::max({length(right), length(up), length(up - right)}) * at.step;
    const Vec3d normal = static_cast<Vec3d>(normalized(across) * (front ? 1.0f : -1.0f)), on = static_cast<Vec3d>(corner);
    lift = rays.off_surface(on, normal) - on + normal * static_cast<double>(kHeight * size);
  }
  Vec3d above(const Patches::Site& at) const { return static_cast<Vec3d>(corner + right * at.u + up * at.v) + lift; }
};

}  // namespace

std::array<std::uint8_t, kPatchParts> Patches::groups_of_parts(std::uint32_t side, const Scene& scene, const RayScene& rays) const {
  std::array<std::uint8_t, kPatchParts> groups{};
  const Site& middle = site(side);
  const Raised raised(scene.meshes[middle.mesh], middle, is_front(side), rays);
  if (raised.size == 0 || raised.size < size_ / 2) return groups;  // small triangles stay whole
  std::array<Vec3d, kPatchParts> places;
  for (std::uint32_t part = 0; part < kPatchParts; ++part) places[part] = raised.above(site({side, part}));
  // Returns those of `parts` that a place sees.
  const auto seen_from = [&](Vec3d from, std::uint32_t parts) {
    RayScene::Sixteen sixteen;
    for (std::uint32_t part = 0; part < kPatchParts; ++part) sixteen.set(part, from, places[part] - from);
    return parts & ~rays.blocked_among(sixteen, parts, Casters::all);
  };
  constexpr std::uint32_t kAll = (1u << kPatchParts) - 1;
  std::uint32_t rest = kAll & ~seen_from(raised.above(middle), kAll);
  for (std::uint8_t group = 1; rest != 0; ++group) {
    const auto first = static_cast<std::uint32_t>(std::countr_zero(rest));
    std::uint32_t members = 1u << first;
    if (const std::uint32_t others = rest & ~members; others != 0) members |= seen_from(places[first], others);
    for (std::uint32_t bits = members; bits != 0; bits &= bits - 1) groups[static_cast<std::size_t>(std::countr_zero(bits))] = group;
    rest &= ~members;
  }
  return groups;
}

void Patches::split(const Scene& scene, const RayScene& rays) {
  const std::size_t sides = side_count();
  std::vector<std::array<std::uint8_t, kPatchParts>> groups(sides);
  tbb::parallel_for(std::size_t{0}, sides, [&](std::size_t side) {
    if (!lets_through(sites_[side / 2].mesh)) groups[side] = groups_of_parts(static_cast<std::uint32_t>(side), scene, rays);
  });
  split_of_.assign(sides, kNoSide);
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint8_t most = *std::max_element(groups[side].begin(), groups[side].end());
    if (most == 0) continue;
    const Site middle = site(side);
    const Raised raised(scene.meshes[middle.mesh], middle, is_front(side), rays);
    Split split{{}, {side}, {raised.above(middle)}, raised.lift};
    split.of_parts.fill(side);
    for (std::uint8_t group = 1; group <= most; ++group) {
      const std::uint32_t own = 2 * static_cast<std::uint32_t>(sites_.size()) + side % 2;
      std::uint32_t first = kPatchParts;
      for (std::uint32_t part = 0; part < kPatchParts; ++part)
        if (groups[side][part] == group) split.of_parts[part] = own, first = std::min(first, part);
      Site at = site({side, first});
      at.step = middle.step;
      split.sides.push_back(own);
      split.places.push_back(raised.above(at));
      sites_.push_back(at);
      wholes_.push_back(side / 2);
    }
    split_of_[side] = static_cast<std::uint32_t>(splits_.size());
    splits_.push_back(split);
  }
}

PatchPlace Patches::seen_along(PatchPlace at, Vec3f place, const RayScene& rays) const {
  const Split* split = split_of(at.side);
  if (split == nullptr) return at;
  const Vec3d above = static_cast<Vec3d>(place) + split->lift;
  const auto sees = [&](std::size_t k) { return !rays.between(above, split->places[k], Casters::all); };
  for (std::size_t k = 0; k < split->sides.size(); ++k)
    if (split->sides[k] == at.side && sees(k)) return at;
  for (std::size_t k = 0; k < split->sides.size(); ++k)
    if (split->sides[k] != at.side && sees(k)) return {split->sides[k], at.part};
  return at;
}

}  // namespace steradian::radiosity
