#include "render/surface/rough_glass.h"

#include <algorithm>
#include <cmath>

#include "core/lattices.h"
#include "lobes/lobe.h"
#include "steradian/albedo.h"

namespace steradian {
namespace {

constexpr float kSharp = 2.5e-3f;  // alpha below which glass is clear: a roughness of 0.05

bool has_lobe_behind(const SurfaceMaterial& m) {
  return m.transmission > 0 && !m.unlit && m.specular_override.empty() && m.alpha_mode != AlphaMode::blend;
}

// A lobe that loses no light: its colour makes up for what facets hide from each other.
Vec3f lossless(const Surface& lobe, Vec3f view) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = static_cast<double>(lobe.alpha_x);
  m.alpha_y = static_cast<double>(lobe.alpha_y);
  m.tangent = static_cast<Vec3d>(lobe.tangent);
  m.f0 = m.f90 = {1, 1, 1};
  m.multiple_scattering = true;
  return static_cast<Vec3f>(with_multiple_scattering(m, {{}, static_cast<Vec3d>(lobe.normal), static_cast<Vec3d>(view)}).f0);
}

}  // namespace

RoughGlass::RoughGlass(const Scene& scene) : scene_(scene), behind_(scene.materials.size()) {
  for (std::size_t i = 0; i < behind_.size(); ++i) behind_[i].solid = scene.materials[i].solid;
}

bool RoughGlass::blurs(const Surface& s) { return has_lobe_behind(*s.material) && std::max(s.alpha_x, s.alpha_y) > kSharp; }

bool RoughGlass::may_blur(const SurfaceMaterial& m) { return has_lobe_behind(m) && m.roughness * m.roughness > kSharp; }

Surface RoughGlass::lobe_of(const Surface& face) const {
  Surface lobe;
  lobe.position = face.position;
  lobe.tangent = face.tangent;
  lobe.alpha_x = face.alpha_x;
  lobe.alpha_y = face.alpha_y;
  lobe.material = &behind_[static_cast<std::size_t>(face.material - scene_.materials.data())];
  return lobe;
}

RoughGlass::Lobe RoughGlass::behind_wall(const Surface& wall, Vec3f view, float offset) const {
  Lobe lobe{lobe_of(wall), normalized(view - wall.normal * (2 * dot(view, wall.normal)))};
  lobe.surface.position = wall.position - wall.geometric_normal * offset;
  lobe.surface.normal = lobe.surface.coat_normal = -wall.normal;
  lobe.surface.geometric_normal = -wall.geometric_normal;
  lobe.surface.f0 = lobe.surface.f90 = lossless(lobe.surface, lobe.view);
  return lobe;
}

float RoughGlass::reflected_within(const Surface& face, Vec3f to_ray, float eta) {
  constexpr std::size_t kFacets = 64;
  // Facets of the first face have turned the ray by this fraction of their tilt.
  const double turned = 1 - 1 / static_cast<double>(eta), wider = std::sqrt(1 + turned * turned);
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = std::min(static_cast<double>(face.alpha_x) * wider, 1.0);
  m.alpha_y = std::min(static_cast<double>(face.alpha_y) * wider, 1.0);
  const Frame frame = Frame::from_normal_and_tangent(static_cast<Vec3d>(face.normal), static_cast<Vec3d>(face.tangent));
  const Vec3d view = frame.to_local(static_cast<Vec3d>(to_ray));
  if (!(view.z > 0) || !(eta > 1)) return 0;
  const lobes::Lobe lobe(m, view);
  std::size_t count = 0;
  for (std::size_t i = 0; i < kFacets; ++i) {
    const auto [u, v] = fibonacci_place(i, kFacets, 0);
    const Vec3d half = lobe.sample(u, v) + view;
    const double cosine = length(half) > 0 ? dot(normalized(half), view) : 1,
                 sine = static_cast<double>(eta) * std::sqrt(1 - std::min(cosine * cosine, 1.0));
    count += sine > 1 ? 1 : 0;
  }
  return static_cast<float>(count) / kFacets;
}

RoughGlass::Lobe RoughGlass::before_solid(const Surface& face, Vec3f view, float offset) const {
  Lobe lobe{lobe_of(face), view};
  lobe.surface.position = face.position + face.geometric_normal * offset;
  lobe.surface.normal = lobe.surface.coat_normal = face.normal;
  lobe.surface.geometric_normal = face.geometric_normal;
  lobe.surface.albedo = {1, 1, 1};
  return lobe;
}

RoughGlass::Lobe RoughGlass::behind_solid(const Surface& face, const Exit& exit) const {
  Lobe lobe{lobe_of(face), exit.direction};
  Surface& s = lobe.surface;
  s.position = exit.position;
  s.normal = s.coat_normal = exit.direction;
  s.geometric_normal = exit.normal;
  // The squares of the changes add up to an ellipse. A facet turns a reflected direction by twice its tilt.
  const Frame frame = Frame::from_normal(static_cast<Vec3d>(exit.direction));
  double xx = 0, xy = 0, yy = 0;
  for (const Vec3f& change : exit.changes) {
    const Vec3d to = frame.to_local(static_cast<Vec3d>(change)) * 0.5;
    xx += to.x * to.x;
    xy += to.x * to.y;
    yy += to.y * to.y;
  }
  const double turn = 0.5 * std::atan2(2 * xy, xx - yy), middle = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
  const auto width = [](double square) { return static_cast<float>(std::clamp(std::sqrt(std::max(square, 0.0)), 1e-3, 1.0)); };
  s.tangent = static_cast<Vec3f>(frame.x * std::cos(turn) + frame.y * std::sin(turn));
  s.alpha_x = width(middle + apart);
  s.alpha_y = width(middle - apart);
  s.f0 = s.f90 = lossless(s, lobe.view) * (1 - exit.within);
  const float evenly = exit.within - front_share(exit.within);
  s.albedo = {evenly, evenly, evenly};
  return lobe;
}

}  // namespace steradian
