#include "render/frame/tinted_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace steradian {
namespace {

constexpr std::size_t kMostGroups = 4;  // each takes as long as the shadows of all opaque meshes

struct Clear {
  Vec3f passes;
  std::vector<std::uint32_t> meshes;
};

// The clear meshes by the fraction that they pass. The nearest groups are joined while there are too many.
std::vector<Clear> grouped(const ClearMeshes& meshes) {
  std::vector<Clear> groups;
  for (const std::uint32_t mesh : meshes.numbers()) {
    const Vec3f passes = meshes.passes(mesh);
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Clear& g) { return g.passes == passes; });
    if (same != groups.end())
      same->meshes.push_back(mesh);
    else
      groups.push_back({passes, {mesh}});
  }
  while (groups.size() > kMostGroups) {
    std::size_t first = 0, second = 1;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < groups.size(); ++i)
      for (std::size_t j = i + 1; j < groups.size(); ++j)
        if (const float d = length(groups[i].passes - groups[j].passes); d < least) least = d, first = i, second = j;
    const auto a = static_cast<float>(groups[first].meshes.size()), b = static_cast<float>(groups[second].meshes.size());
    groups[first].passes = (groups[first].passes * a + groups[second].passes * b) * (1 / (a + b));
    groups[first].meshes.insert(groups[first].meshes.end(), groups[second].meshes.begin(), groups[second].meshes.end());
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(second));
  }
  return groups;
}

Scene with_opaque(const Scene& scene, const std::vector<std::uint32_t>& meshes) {
  Scene copy = scene;
  for (const std::uint32_t mesh : meshes) copy.meshes[mesh].casts_shadow = true;
  return copy;
}

}  // namespace

struct TintedShadows::Group {
  Group(const Scene& original, const Clear& clear, const RenderOptions& options, const DirectMethod& method,
        const std::vector<PackLight>& lights, ManyLightPass* many_lights)
      : absorbs(Vec3f{1, 1, 1} - clear.passes),
        scene(with_opaque(original, clear.meshes)),
        parts(SceneParts::of(scene, Sorted::for_rays_and_edges)),
        lighting(scene, options, method, lights, parts, many_lights) {}
  const Vec3f absorbs;
  const Scene scene;
  const SceneParts parts;
  TileLighting lighting;
};

TintedShadows::TintedShadows(const Scene& scene, const RenderOptions& options, const DirectMethod& method,
                             const std::vector<PackLight>& lights, ManyLightPass* many_lights) {
  if (options.shadows == Shadows::off || method.estimates()) return;
  for (const Clear& clear : grouped(ClearMeshes(scene)))
    groups_.push_back(std::make_unique<Group>(scene, clear, options, method, lights, many_lights));
}

TintedShadows::~TintedShadows() = default;

TileLighting& TintedShadows::lighting_of(Group& group) { return group.lighting; }

void TintedShadows::clear(TileVector& v) {
  for (TilePlane* plane : {&v.x, &v.y, &v.z}) plane->fill(0);
}

void TintedShadows::absorb(const Group& group, const TileVector& past_all, Sums& sums) {
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const Vec3f blocked = get(sums.light, i) - get(past_all, i);
    put(sums.arrives, i,
        get(sums.arrives, i) - Vec3f{std::max(blocked.x, 0.0f), std::max(blocked.y, 0.0f), std::max(blocked.z, 0.0f)} * group.absorbs);
  }
}

void TintedShadows::put_sum(const Sums& sums, TileVector& radiance) {
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const Vec3f arrives = get(sums.arrives, i);
    put(radiance, i, get(sums.before, i) + Vec3f{std::max(arrives.x, 0.0f), std::max(arrives.y, 0.0f), std::max(arrives.z, 0.0f)});
  }
}

}  // namespace steradian
