#include "render/surface/passed_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lobes/lobe.h"

namespace steradian {
namespace {

constexpr float kLeastShare = 1e-3f;   // least fraction of the light from behind; less is black
constexpr int kMostFaces = 8;          // of a solid that a ray meets from within; then it ends
constexpr float kLeastWithin = 1e-2f;  // least fraction of the light that goes on reflected within; less leaves

bool lets_through(const SurfaceMaterial& m) { return m.transmission > 0 && m.specular_override.empty(); }

// The triangle's normal by the order of its corners, not of unit length.
Vec3f front_of(const Mesh& mesh, unsigned triangle) {
  const auto corner = [&](std::size_t c) { return mesh.positions[mesh.indices[3 * std::size_t{triangle} + c]]; };
  return cross(corner(1) - corner(0), corner(2) - corner(0));
}

// Fraction that a smooth face reflects, of unpolarised light (Fresnel). eta: ratio of the indices, before over behind.
float reflected_by_face(float eta, float cosine, float cosine_behind) {
  const float across = (eta * cosine - cosine_behind) / (eta * cosine + cosine_behind);
  const float along = (cosine - eta * cosine_behind) / (cosine + eta * cosine_behind);
  return (across * across + along * along) / 2;
}

float largest(Vec3f v) { return std::max({v.x, v.y, v.z}); }

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
  ways.restart();
}

void PassedRays::Ways::restart() {
  lobes.clear();
  asides.clear();
  layer = turn = 0;
}

bool PassedRays::go_on(const SurfaceTile& tile, Ways& ways) const {
  if (++ways.turn == kMostTurns) return false;
  if (tile.any_passing && ++ways.layer < kMostLayers) {
    look_through(tile, ways);
    return true;
  }
  if (ways.asides.empty()) return false;
  begin_aside(ways);
  return true;
}

// Begins the next waiting ray of each slot.
void PassedRays::begin_aside(Ways& ways) {
  std::vector<Ways::Aside> waiting;
  std::vector<std::size_t> ended;
  ways.layer = 0;
  ways.lobes.clear();
  ways.behind.fill(0);
  ways.bent.fill(0);
  for (TilePlane* plane : {&ways.shares.x, &ways.shares.y, &ways.shares.z}) plane->fill(0);
  for (const Ways::Aside& aside : ways.asides) {
    if (ways.bent[aside.slot] != 0) {
      waiting.push_back(aside);
      continue;
    }
    put(ways.shares, aside.slot, aside.ray.weight);
    go_along(aside.ray, aside.slot, ways);
    if (!aside.lobe) continue;
    ways.lobes.push_back({aside.slot, *aside.lobe});
    ended.push_back(aside.slot);
  }
  for (const std::size_t slot : ended) ways.bent[slot] = 0;
  ways.asides = std::move(waiting);
}

void PassedRays::go_along(const Ray& ray, std::size_t slot, Ways& ways) {
  ways.behind[slot] = 0;
  ways.bent[slot] = 1;
  put(ways.origin, slot, ray.origin);
  put(ways.direction, slot, ray.direction);
  ways.length[slot] = ray.length;
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
// on refracted. Light that is reflected within and that `reflected` does not take counts as leaving there too, so that a solid that does
// not absorb loses none. Where all is reflected, the ray follows the reflection.
template <class Facet>
PassedRays::Faces PassedRays::pass_solid(Inner& inside, Facet facet, std::vector<Inner>* reflected) const {
  Faces faces;
  Ray& ray = inside.ray;
  std::vector<const SurfaceMaterial*>& within = inside.within;
  for (int& face = inside.faces; face <= kMostFaces; ++face) {
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
    const auto reflect = [&](Inner& in) {
      in.ray.direction = normalized(in.ray.direction + normal * (2 * cosine));
      if (!(dot(in.ray.direction, s.geometric_normal) > 0))
        in.ray.direction = normalized(in.ray.direction - s.geometric_normal * (2 * dot(in.ray.direction, s.geometric_normal)));
      in.ray.origin = static_cast<Vec3f>(rays_.off_surface(static_cast<Vec3d>(s.position), static_cast<Vec3d>(s.geometric_normal)));
      if (in.within.empty() && !enters) in.within.push_back(&m);
    };
    if (rest < 0) {
      reflect(inside);
      continue;
    }
    if (reflected != nullptr && !enters && !RoughGlass::blurs(s)) {
      const float fraction = std::min(m.specular, 1.0f) * reflected_by_face(eta, cosine, std::sqrt(rest));
      if (face < kMostFaces && largest(ray.weight) * fraction > kLeastWithin) {
        Inner& other = reflected->emplace_back(inside);
        ++other.faces;
        other.ray.weight = ray.weight * fraction;
        reflect(other);
        ray.weight = ray.weight * (1 - fraction);
      }
    }
    if (reflected != nullptr && !enters && RoughGlass::blurs(s)) faces.within = RoughGlass::reflected_within(s, -ray.direction, eta);
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
  Inner inside{before_face(face.position, view, 0)};
  pass_solid(inside, [&](const Surface& s, Vec3f to_view, int) {
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
  return inside.ray;
}

// How facets that are tilted to one side change the direction of a ray, face by face.
RoughGlass::Exit PassedRays::exit_of(const Ray& start, const Ray& end, const Faces& faces) const {
  constexpr float kMostTilt = 0.5f;
  RoughGlass::Exit exit{end.origin, end.direction, faces.last, faces.within, {}};
  for (int face = 0; face < faces.count; ++face)
    for (const bool along : {true, false}) {
      Inner inside{start};
      float alpha = 0;
      const Faces met = pass_solid(inside, [&](const Surface& s, Vec3f, int number) {
        if (number != face || !RoughGlass::blurs(s)) return s.normal;
        alpha = along ? s.alpha_x : s.alpha_y;
        return normalized(s.normal + (along ? s.tangent : cross(s.normal, s.tangent)) * std::min(alpha, kMostTilt));
      });
      if (!(alpha > 0)) continue;
      const Vec3f change = (inside.ray.direction - end.direction) * (alpha / std::min(alpha, kMostTilt));
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
    if (tile.material[i] == nullptr || !(largest(share) > kLeastShare)) {
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
    const float way = ways.bent[i] != 0 ? ways.length[i] + length(position - get(ways.origin, i)) : ways.behind[i];
    if (!solid) {
      put(ways.shares, i, share);
      go_along({position - normal * past, -view, {}, way}, i, ways);
      continue;
    }
    const Surface face = surface_in(tile, i);
    const bool ends = is_random(face);
    Inner inside{before_face(position, view, way)};
    const Ray start = inside.ray;
    // The weights are shares, so that little light within is known as such.
    inside.ray.weight = ends ? Vec3f{} : share;
    std::vector<Inner> reflected;
    const Faces faces = pass_solid(inside, smooth_facet, rough_ != Rough::sharp ? &reflected : nullptr);
    for (std::size_t k = 0; k < reflected.size(); ++k) {
      Inner other = std::move(reflected[k]);
      pass_solid(other, smooth_facet, &reflected);
      if (largest(other.ray.weight) > kLeastShare) ways.asides.push_back({i, other.ray});
    }
    const Ray& ray = inside.ray;
    const bool is_seen = largest(ray.weight) > kLeastShare;
    put(ways.shares, i, is_seen ? ray.weight : Vec3f{});
    go_along(ray, i, ways);
    const bool has_lobe = is_seen && rough_glass_ && faces.widest > 0;
    if (has_lobe) {
      ways.lobes.push_back({i, rough_glass_->behind_solid(face, exit_of(start, ray, faces))});
      const float before = RoughGlass::front_share(faces.within);
      const RoughGlass::Lobe lobe = rough_glass_->before_solid(face, view, past);
      if (before > 0) ways.asides.push_back({i, {lobe.surface.position, -view, ray.weight * before, way}, lobe});
    }
    if (has_lobe || !is_seen) ways.bent[i] = 0;
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
