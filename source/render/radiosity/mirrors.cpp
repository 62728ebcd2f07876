#include "render/radiosity/mirrors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/radiosity/gather.h"

namespace steradian::radiosity {
namespace {

// The mirrored direction of a surface's narrow lobes, and the fraction that they reflect. It leaves out lobes about another normal than the
// first.
struct Mirror {
  Vec3f direction, weight;
};

std::optional<Mirror> mirror_of(const Surface& surface, Vec3f view) {
  std::optional<Mirror> mirror;
  Vec3f normal;
  for (const SurfaceLobe& lobe : lobes_of(surface)) {
    const Material& m = lobe.material;
    if (m.brdf != Brdf::ggx || std::min(m.alpha_x, m.alpha_y) >= double{Gather::kLeastWidth}) continue;
    const float cosine = dot(lobe.normal, view);
    if (!(cosine > 0) || (mirror && !(lobe.normal == normal))) continue;
    if (!mirror) mirror = Mirror{normalized(lobe.normal * (2 * cosine) - view), {}};
    normal = lobe.normal;
    const float grazing = std::pow(std::max(1 - cosine, 0.0f), 5.0f);
    mirror->weight += static_cast<Vec3f>(m.f0) * (1 - grazing) + static_cast<Vec3f>(m.f90) * grazing;
  }
  return mirror;
}

}  // namespace

bool find_mirrored(const RayScene& rays, const SurfaceTile& tile, const TilePlane& distance, PassedRays::Ways& ways) {
  bool any = false;
  ways.behind.fill(0);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    ways.bent[i] = 0;
    put(ways.shares, i, {});
    if (tile.material[i] == nullptr || tile.material[i]->unlit) continue;
    const Surface surface = surface_in(tile, i);
    const std::optional<Mirror> mirror = mirror_of(surface, get(tile.view, i));
    if (!mirror || !weighs(mirror->weight) || !(dot(mirror->direction, surface.geometric_normal) > 0)) continue;
    const Vec3d origin = rays.off_surface(static_cast<Vec3d>(surface.position), static_cast<Vec3d>(surface.geometric_normal));
    ways.bent[i] = 1;
    put(ways.shares, i, mirror->weight);
    put(ways.origin, i, static_cast<Vec3f>(origin));
    put(ways.direction, i, mirror->direction);
    ways.length[i] = distance[i];
    any = true;
  }
  return any;
}

}  // namespace steradian::radiosity
