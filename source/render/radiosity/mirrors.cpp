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

// Steps between the pixels that meet a ray of this direction.
PixelSteps steps_about(Vec3f direction, float pixel) {
  const Frame frame = Frame::from_normal(static_cast<Vec3d>(direction));
  return {static_cast<Vec3f>(frame.x) * pixel, static_cast<Vec3f>(frame.y) * pixel, direction};
}

}  // namespace

Mirrors::Mirrors(const Scene& scene, const RayScene& rays, const MipMaps& maps, const PixelSteps& steps)
    : scene_(scene), rays_(rays), maps_(maps), pixel_(std::sqrt(length(steps.right) * length(steps.down))) {}

bool Mirrors::find(const SurfaceTile& tile, const TilePlane& distance, Image& image) const {
  clear_kinds(image.tile);
  image.tile.seed = tile.seed;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    put_nothing(image.tile, i);
    if (tile.material[i] == nullptr || tile.material[i]->unlit) continue;
    const Surface surface = surface_in(tile, i);
    const std::optional<Mirror> mirror = mirror_of(surface, get(tile.view, i));
    if (!mirror || !weighs(mirror->weight) || !(dot(mirror->direction, surface.geometric_normal) > 0)) continue;
    const Vec3d origin = rays_.off_surface(static_cast<Vec3d>(surface.position), static_cast<Vec3d>(surface.geometric_normal));
    RTCRayHit hit;
    if (!rays_.intersect(static_cast<Vec3f>(origin), mirror->direction, hit)) continue;
    const Mesh& mesh = scene_.meshes[hit.hit.geomID];
    image.distance[i] = distance[i] + hit.ray.tfar;
    Surface shown =
        surface_at(scene_, mesh, hit.hit.primID, hit.hit.u, hit.hit.v, -mirror->direction,
                   footprint_on(maps_, mesh, hit.hit.primID, mirror->direction, image.distance[i], steps_about(mirror->direction, pixel_)));
    // The lobe's integral over the lamps already holds their light.
    if (!shown.material->unlit) shown.emission = {};
    put_surface(image.tile, i, shown, -mirror->direction);
    image.weight.x[i] = mirror->weight.x;
    image.weight.y[i] = mirror->weight.y;
    image.weight.z[i] = mirror->weight.z;
  }
  return image.tile.any_surface;
}

}  // namespace steradian::radiosity
