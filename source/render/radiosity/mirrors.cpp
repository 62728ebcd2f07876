#include "render/radiosity/mirrors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace steradian::radiosity {
namespace {

// Widths between which a lobe's light passes from mirrored rays to directions of its own.
constexpr float kAllMirror = 0.03f, kNoMirror = 0.08f;

// The narrow lobes of a surface: their mirrored direction, the fraction that they reflect, and their mean widths.
struct Mirror {
  Vec3f normal, direction, weight;
  float alpha_x = 0, alpha_y = 0;
};

float sum(Vec3f v) { return v.x + v.y + v.z; }

// It leaves out lobes about another normal than the first.
std::optional<Mirror> mirror_of(const Surface& surface, Vec3f view) {
  std::optional<Mirror> mirror;
  for (const SurfaceLobe& lobe : lobes_of(surface)) {
    const Material& m = lobe.material;
    const auto alpha_x = static_cast<float>(m.alpha_x), alpha_y = static_cast<float>(m.alpha_y);
    if (m.brdf != Brdf::ggx || !(mirrored_fraction(alpha_x, alpha_y) > 0)) continue;
    const float cosine = dot(lobe.normal, view);
    if (!(cosine > 0) || (mirror && !(lobe.normal == mirror->normal))) continue;
    if (!mirror) mirror = Mirror{lobe.normal, normalized(lobe.normal * (2 * cosine) - view), {}};
    const float grazing = std::pow(std::max(1 - cosine, 0.0f), 5.0f);
    const Vec3f weight =
        (static_cast<Vec3f>(m.f0) * (1 - grazing) + static_cast<Vec3f>(m.f90) * grazing) * mirrored_fraction(alpha_x, alpha_y);
    mirror->weight += weight;
    mirror->alpha_x += alpha_x * sum(weight);
    mirror->alpha_y += alpha_y * sum(weight);
  }
  if (!mirror || !weighs(mirror->weight)) return std::nullopt;
  mirror->alpha_x /= sum(mirror->weight);
  mirror->alpha_y /= sum(mirror->weight);
  return mirror;
}

// A direction below the triangle's horizon moves onto it. Else the last facets before a smooth outline would be black.
Vec3f above(Vec3f direction, Vec3f geometric_normal) {
  constexpr float kLeast = 1e-3f;
  const float height = dot(direction, geometric_normal);
  return height > kLeast ? direction : normalized(direction + geometric_normal * (kLeast - height));
}

}  // namespace

float mirrored_fraction(float alpha_x, float alpha_y) {
  const float x = std::clamp((kNoMirror - std::sqrt(alpha_x * alpha_y)) / (kNoMirror - kAllMirror), 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

bool find_mirrors(const RayScene& rays, const SurfaceTile& tile, const TilePlane& distance, Mirrors& mirrors) {
  bool any = false;
  PassedRays::Ways& ways = mirrors.ways;
  ways.behind.fill(0);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    ways.bent[i] = 0;
    put(ways.shares, i, {});
    if (tile.material[i] == nullptr || tile.material[i]->unlit) continue;
    const Surface surface = surface_in(tile, i);
    const std::optional<Mirror> mirror = mirror_of(surface, get(tile.view, i));
    if (!mirror) continue;
    const Vec3d origin = rays.off_surface(static_cast<Vec3d>(surface.position), static_cast<Vec3d>(surface.geometric_normal));
    ways.bent[i] = 1;
    put(ways.shares, i, mirror->weight);
    put(ways.origin, i, static_cast<Vec3f>(origin));
    put(ways.direction, i, above(mirror->direction, surface.geometric_normal));
    ways.length[i] = distance[i];
    put(mirrors.normal, i, mirror->normal);
    mirrors.alpha_x[i] = mirror->alpha_x;
    mirrors.alpha_y[i] = mirror->alpha_y;
    any = true;
  }
  return any;
}

}  // namespace steradian::radiosity
