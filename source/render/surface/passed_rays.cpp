#include "render/surface/passed_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lobes/lobe.h"

namespace steradian {
namespace {

constexpr float kLeastShare = 1e-3f;  // least fraction of the light from behind; less is black
constexpr int kMostFaces = 8;         // of a solid that a ray meets from within; then it ends

bool lets_through(const SurfaceMaterial& m) { return m.transmission > 0 && m.specular_override.empty(); }

// The triangle's normal by the order of its corners, not of unit length.
Vec3f front_of(const Mesh& mesh, unsigned triangle) {
  const auto corner = [&](std::size_t c) { return mesh.positions[mesh.indices[3 * std::size_t{triangle} + c]]; };
  return cross(corner(1) - corner(0), corner(2) - corner(0));
}

}  // namespace

PassedRays::PassedRays(const Scene& scene, const RayScene& rays, const HitShading& shading, Background background, Rough rough)
    : scene_(scene),
      rays_(rays),
      shading_(shading),
      background_(std::move(background)),
      pixel_(size_of_pixel(shading.steps)),
      rough_(rough),
      rough_glass_(rough != Rough::sharp ? std::optional<RoughGlass>(scene) : std::nullopt) {}

void PassedRays::begin(const TilePlane& distances, Ways& ways) {
  for (TilePlane* plane : {&ways.shares.x, &ways.shares.y, &ways.shares.z}) plane->fill(1);
  ways.behind = distances;
  ways.bent.fill(0);
  ways.lobes.clear();
}

namespace {

Vec3f smooth_facet(const Surface& s, Vec3f, int) { return s.normal; }

}  // namespace

// A ray that meets the face of a solid again, to know its side.
PassedRays::Ray PassedRays::before_face(Vec3f position, Vec3f view, float length) const {
  const auto past = static_cast<float>(rays_.offset_from_surface(static_cast<Vec3d>(position)));
  return {position + view * (4 * past), -view, {1, 1, 1}, length};
}

// Follows a ray from just before the face of a solid to where it is outside of all solids, or to what stands in one. At a face the ray goes
// on refracted. Light that is reflected within counts as leaving there too, so that a solid that does not absorb loses none. Where all is
// reflected, the ray follows the reflection.
template <class Facet>
PassedRays::Faces PassedRays::pass_solid(Ray& ray, Facet facet) const {
  Faces faces;
  std::vector<const SurfaceMaterial*> within;  // solids that the ray is in, the innermost last
  for (int face = 0; face <= kMostFaces; ++face) {
    RTCRayHit hit;
    if (!rays_.intersect(ray.origin, ray.direction, hit)) return faces;
    const Mesh& mesh = scene_.meshes[hit.hit.geomID];
    const SurfaceMaterial& m = scene_.materials[static_cast<std::size_t>(mesh.material)];
    const bool stops = !m.solid || !lets_through(m);
    const bool enters = dot(front_of(mesh, hit.hit.primID), ray.direction) < 0;
    if (face > 0 && within.empty() && (stops || enters)) return faces;  // the next surface of the picture
    if (!within.empty()) ray.weight = ray.weight * left_after(*within.back(), hit.ray.tfar);
    if (stops) return faces;
    const Surface s = surface_at(scene_, mesh, hit.hit.primID, hit.hit.u, hit.hit.v, -ray.direction);
    if (face > 0 && enters) ray.weight = ray.weight * s.passes;
    if (RoughGlass::blurs(s)) faces.widest = std::max({faces.widest, s.alpha_x, s.alpha_y});
    const Vec3f normal = facet(s, -ray.direction, faces.count++);
    const auto inner = [&](std::size_t from_last) { return within.size() > from_last ? within[within.size() - 1 - from_last]->ior : 1.0f; };
    // A ray that starts within a solid leaves it first.
    const float eta = enters ? inner(0) / m.ior : m.ior / inner(within.empty() ? 0 : 1);
    const float cosine = dot(normal, -ray.direction), rest = 1 - eta * eta * (1 - cosine * cosine);
    ray.length += hit.ray.tfar;
    faces.last = rest < 0 ? s.geometric_normal : -s.geometric_normal;
    if (rest < 0) {
      ray.direction = normalized(ray.direction + normal * (2 * cosine));
      if (!(dot(ray.direction, s.geometric_normal) > 0))
        ray.direction = normalized(ray.direction - s.geometric_normal * (2 * dot(ray.direction, s.geometric_normal)));
      ray.origin = static_cast<Vec3f>(rays_.off_surface(static_cast<Vec3d>(s.position), static_cast<Vec3d>(s.geometric_normal)));
      if (within.empty() && !enters) within.push_back(&m);
      continue;
    }
    const Vec3f bent = normalized(ray.direction * eta + normal * (eta * cosine - std::sqrt(rest)));
    if (dot(bent, s.geometric_normal) < 0)
      ray.direction = bent;  // a smooth normal may bend it out of its triangle: then it goes straight on
    ray.origin = static_cast<Vec3f>(rays_.off_surface(static_cast<Vec3d>(s.position), static_cast<Vec3d>(-s.geometric_normal)));
    if (enters)
      within.push_back(&m);
    else if (!within.empty())
      within.pop_back();
    if (within.empty()) return faces;
  }
  ray.weight = {};
  return faces;
}

bool PassedRays::is_random(const Surface& surface) const {
  return rough_ == Rough::random && surface.material->solid && RoughGlass::blurs(surface);
}

PassedRays::Ray PassedRays::pass_at_random(const Surface& face, Vec3f view, reference::Random& random) const {
  Ray ray = before_face(face.position, view, 0);
  pass_solid(ray, [&](const Surface& s, Vec3f to_view, int) {
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = static_cast<double>(s.alpha_x);
    m.alpha_y = static_cast<double>(s.alpha_y);
    const Frame frame = Frame::from_normal_and_tangent(static_cast<Vec3d>(s.normal), static_cast<Vec3d>(s.tangent));
    const Vec3d v = frame.to_local(static_cast<Vec3d>(to_view));
    if (!RoughGlass::blurs(s) || !(v.z > 0)) return s.normal;
    const double a = random.uniform(), b = random.uniform();
    const Vec3d half = lobes::Lobe(m, v).sample(a, b) + v;
    return length(half) > 0 ? static_cast<Vec3f>(frame.to_world(normalized(half))) : s.normal;
  });
  return ray;
}

// How facets that are tilted to one side change the direction of a ray, face by face.
RoughGlass::Exit PassedRays::exit_of(const Ray& start, const Ray& end, const Faces& faces) const {
  constexpr float kMostTilt = 0.5f;
  RoughGlass::Exit exit{end.origin, end.direction, faces.last, {}};
  for (int face = 0; face < faces.count; ++face)
    for (const bool along : {true, false}) {
      Ray ray = start;
      float alpha = 0;
      const Faces met = pass_solid(ray, [&](const Surface& s, Vec3f, int number) {
        if (number != face || !RoughGlass::blurs(s)) return s.normal;
        alpha = along ? s.alpha_x : s.alpha_y;
        return normalized(s.normal + (along ? s.tangent : cross(s.normal, s.tangent)) * std::min(alpha, kMostTilt));
      });
      if (!(alpha > 0)) continue;
      const Vec3f change = (ray.direction - end.direction) * (alpha / std::min(alpha, kMostTilt));
      // A tilted ray that meets other faces tells nothing of the lobe about this one.
      if (met.count == faces.count && is_finite(change)) exit.changes.push_back(change);
    }
  return exit;
}

void PassedRays::look_through(const SurfaceTile& tile, Ways& ways) const {
  constexpr float kPast = 1 + 2e-5f;  // some roundings of a distance and of a triangle's coordinates
  ways.lobes.clear();
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    Vec3f share = get(ways.shares, i) * get(tile.passes, i);
    if (tile.material[i] == nullptr || !(std::max({share.x, share.y, share.z}) > kLeastShare)) {
      put(ways.shares, i, {});
      ways.behind[i] = 0;
      ways.bent[i] = 0;
      continue;
    }
    const bool solid = tile.material[i]->solid;
    if (rough_glass_ && !solid && RoughGlass::blurs(surface_in(tile, i))) {
      put(ways.shares, i, share);
      end_at_lobe(tile, i, ways);
      continue;
    }
    if (!solid && ways.bent[i] == 0) {
      put(ways.shares, i, share);
      ways.behind[i] *= kPast;
      continue;
    }
    const Vec3f position = get(tile.position, i), view = get(tile.view, i), normal = get(tile.geometric_normal, i);
    const auto past = static_cast<float>(rays_.offset_from_surface(static_cast<Vec3d>(position)));
    Ray ray{position - normal * past,
            -view,
            {1, 1, 1},
            ways.bent[i] != 0 ? ways.length[i] + length(position - get(ways.origin, i)) : ways.behind[i]};
    Faces faces;
    Ray start;
    if (solid) {
      start = ray = before_face(position, view, ray.length);
      faces = pass_solid(ray, smooth_facet);
    }
    share = share * ray.weight;
    const bool random = solid && is_random(surface_in(tile, i)), ends = random || !(std::max({share.x, share.y, share.z}) > kLeastShare);
    if (!ends && rough_glass_ && faces.widest > 0) {
      put(ways.shares, i, share);
      ways.lobes.push_back({i, rough_glass_->behind_solid(surface_in(tile, i), exit_of(start, ray, faces))});
      ways.behind[i] = 0;
      ways.bent[i] = 0;
      put(ways.origin, i, ray.origin);
      ways.length[i] = ray.length;
      continue;
    }
    put(ways.shares, i, ends ? Vec3f{} : share);
    ways.behind[i] = 0;
    ways.bent[i] = ends ? 0 : 1;
    put(ways.origin, i, ray.origin);
    put(ways.direction, i, ray.direction);
    ways.length[i] = ray.length;
  }
}

// Ends a ray at the lobe through a thin wall.
void PassedRays::end_at_lobe(const SurfaceTile& tile, std::size_t slot, Ways& ways) const {
  const Vec3f position = get(tile.position, slot);
  const auto past = static_cast<float>(rays_.offset_from_surface(static_cast<Vec3d>(position)));
  const RoughGlass::Lobe lobe = rough_glass_->behind_wall(surface_in(tile, slot), get(tile.view, slot), past);
  ways.lobes.push_back({slot, lobe});
  ways.length[slot] = ways.bent[slot] != 0 ? ways.length[slot] + length(position - get(ways.origin, slot)) : ways.behind[slot];
  ways.behind[slot] = 0;
  ways.bent[slot] = 0;
  put(ways.origin, slot, lobe.surface.position);
}

void PassedRays::fill(const Ways& ways, Lamps lamps, SurfaceTile& tile) const {
  for (const Ways::LobeIn& at : ways.lobes) put_surface(tile, at.slot, at.lobe.surface, at.lobe.view);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (ways.bent[i] == 0) continue;
    const Vec3f origin = get(ways.origin, i), direction = get(ways.direction, i);
    RTCRayHit hit;
    if (!rays_.intersect(origin, direction, hit)) {
      if (background_ && lamps == Lamps::shown) put(tile.radiance, i, background_(direction));
      continue;
    }
    const Mesh& mesh = scene_.meshes[hit.hit.geomID];
    const SurfaceFootprint footprint =
        footprint_on(*shading_.maps, mesh, hit.hit.primID, direction, ways.length[i] + hit.ray.tfar, steps_about(direction, pixel_));
    keep_within(mesh, hit.hit.primID, rays_.offset_from_edges(), hit.hit.u, hit.hit.v);
    Surface surface = surface_at(scene_, mesh, hit.hit.primID, hit.hit.u, hit.hit.v, -direction, footprint);
    if (shading_.terminator == Terminator::smooth)
      surface.position = smooth_position(mesh, hit.hit.primID, hit.hit.u, hit.hit.v, surface.geometric_normal);
    if (lamps == Lamps::hidden && !surface.material->unlit) surface.emission = {};
    put_surface(tile, i, surface, -direction);
  }
}

}  // namespace steradian
