#include "render/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "render/surface/surface_pack.h"
#include "steradian/albedo.h"
#include "steradian/kernels.h"

namespace steradian {
namespace {

using SurfaceKernels = Kernels<float>;

SurfaceKernels::real in_kernel(float x) { return SurfaceKernels::real::of(x); }
SurfaceKernels::vec3 in_kernel(Vec3f v) { return {in_kernel(v.x), in_kernel(v.y), in_kernel(v.z)}; }
SurfaceKernels::vec4 in_kernel(Vec4f v) { return {in_kernel(v.x), in_kernel(v.y), in_kernel(v.z), in_kernel(v.w)}; }
Vec3f from_kernel(SurfaceKernels::vec3 v) { return {v.x.v, v.y.v, v.z.v}; }
Vec3f color_of(Vec4f c) { return {c.x, c.y, c.z}; }

// Interpolation of values at the corners of a triangle.
struct TrianglePlace {
  std::uint32_t i0, i1, i2;
  float w0, u, v;
  SurfaceFootprint covered;

  TrianglePlace(const Mesh& mesh, unsigned triangle, float u_, float v_, const SurfaceFootprint& footprint = {})
      : i0(mesh.indices[3 * std::size_t{triangle}]),
        i1(mesh.indices[3 * std::size_t{triangle} + 1]),
        i2(mesh.indices[3 * std::size_t{triangle} + 2]),
        w0(1.0f - u_ - v_),
        u(u_),
        v(v_),
        covered(footprint) {}
  Vec3f operator()(const std::vector<Vec3f>& a) const { return a[i0] * w0 + a[i1] * u + a[i2] * v; }
  Vec2f operator()(const std::vector<Vec2f>& a) const {
    return {a[i0].x * w0 + a[i1].x * u + a[i2].x * v, a[i0].y * w0 + a[i1].y * u + a[i2].y * v};
  }
  // Change of a value with u and v.
  Vec2f change(const std::vector<Vec2f>& a, Vec2f by) const {
    return {(a[i1].x - a[i0].x) * by.x + (a[i2].x - a[i0].x) * by.y, (a[i1].y - a[i0].y) * by.x + (a[i2].y - a[i0].y) * by.y};
  }
  Vec4f operator()(const std::vector<Vec4f>& a) const {
    return {a[i0].x * w0 + a[i1].x * u + a[i2].x * v, a[i0].y * w0 + a[i1].y * u + a[i2].y * v, a[i0].z * w0 + a[i1].z * u + a[i2].z * v,
            a[i0].w * w0 + a[i1].w * u + a[i2].w * v};
  }
};

Vec4f texel(const Scene& scene, const Mesh& mesh, const TrianglePlace& at, const TextureUse& use) {
  if (!use.present()) return {1, 1, 1, 1};
  const auto& set = mesh.texcoords[use.texcoord];
  if (set.empty() || at.covered.maps == nullptr) return sample_texture(scene.images, use, set.empty() ? Vec2f{} : at(set));
  return sample_texture(*at.covered.maps, use, at(set), {at.change(set, at.covered.right), at.change(set, at.covered.down)});
}

Vec4f base_color(const Scene& scene, const Mesh& mesh, const TrianglePlace& at, const SurfaceMaterial& m) {
  Vec4f c = m.base_color;
  const auto multiply = [&](Vec4f t) { c = {c.x * t.x, c.y * t.y, c.z * t.z, c.w * t.w}; };
  if (m.base_color_texture.present()) multiply(texel(scene, mesh, at, m.base_color_texture));
  if (!mesh.colors.empty()) multiply(at(mesh.colors));
  return c;
}

// normalized() with its usual case inline.
inline Vec3f unit(Vec3f a) {
  const float square = dot(a, a);
  return square > 1e-30f && square < 1e30f ? a * (1 / std::sqrt(square)) : normalized(a);
}

// The same as Frame::from_normal, in float. Most surfaces have no tangents, and do not use this one.
Vec3f any_tangent(Vec3f n) {
  const float s = std::copysign(1.0f, n.z), a = -1 / (s + n.z);
  return {1 + s * n.x * n.x * a, n.x * n.y * a * s, -s * n.x};
}

// Normal from a normal map, on the front face, or the frame's own.
SurfaceKernels::vec3 bent_normal(const Scene& scene, const Mesh& mesh, const TrianglePlace& at, const TextureUse& use,
                                 const SurfaceKernels::SurfaceFrame& frame) {
  if (!use.present()) return frame.z;
  return SurfaceKernels().surface_bent_normal(frame, in_kernel(color_of(texel(scene, mesh, at, use))), in_kernel(use.scale));
}

Material ggx_of(const Surface& s) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = static_cast<double>(s.alpha_x);
  m.alpha_y = static_cast<double>(s.alpha_y);
  m.tangent = static_cast<Vec3d>(s.tangent);
  m.f0 = static_cast<Vec3d>(s.f0);
  m.f90 = static_cast<Vec3d>(s.f90);
  return m;
}

// F0 and F90 with the light that bounces between facets.
void scatter_between_facets(const Surface& s, Vec3f view, SurfaceKernels::SurfaceWeights& weights) {
  Material m = ggx_of(s);
  m.f0 = static_cast<Vec3d>(from_kernel(weights.f0));
  m.f90 = static_cast<Vec3d>(from_kernel(weights.f90));
  m.multiple_scattering = true;
  m = with_multiple_scattering(m, {{}, static_cast<Vec3d>(s.normal), static_cast<Vec3d>(view)});
  weights.f0 = in_kernel(static_cast<Vec3f>(m.f0));
  weights.f90 = in_kernel(static_cast<Vec3f>(m.f90));
}

// Puts the weights of its lobes into a surface. One without custom lobes covers the fraction of its place that its alpha says.
Surface& finish(Surface& s, SurfaceKernels::SurfaceWeights weights, float alpha) {
  const SurfaceMaterial& m = *s.material;
  const bool covers = m.unlit || m.specular_override.empty();
  if (covers && m.alpha_mode == AlphaMode::blend)
    weights = SurfaceKernels().surface_covering(weights, in_kernel(std::clamp(alpha, 0.0f, 1.0f)));
  s.emission = from_kernel(weights.emission);
  s.albedo = from_kernel(weights.albedo);
  s.sheen = from_kernel(weights.sheen);
  s.coat = weights.coat.v;
  s.passes = from_kernel(weights.passes);
  if (covers) {
    s.fresnel_loss = weights.fresnel_loss.v;
    s.f0 = from_kernel(weights.f0);
    s.f90 = from_kernel(weights.f90);
  }
  return s;
}

}  // namespace

const LightEmission* emission_of(const Scene& scene, const Mesh& mesh) {
  if (!mesh.is_light_shape || mesh.triangle_lights.empty() || mesh.triangle_lights.front() < 0) return nullptr;
  const auto& emission = scene.area_lights[static_cast<std::size_t>(mesh.triangle_lights.front())].emission;
  return emission ? &*emission : nullptr;
}

SurfaceKind kind_of(const Scene& scene, const Mesh& mesh) {
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  const auto black = [](Vec3f c) { return !(c.x > 0 || c.y > 0 || c.z > 0); };
  if (emission_of(scene, mesh) != nullptr) return SurfaceKind::layered;
  if (m.unlit || m.anisotropy != 0 || m.transmission != 0 || m.clearcoat != 0 || !black(m.sheen_color) || scene.multiple_scattering)
    return SurfaceKind::layered;
  bool textured = !mesh.colors.empty() || (m.emits() && !m.double_sided);
  for (const TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emissive_texture,
                                &m.specular_texture, &m.specular_color_texture}) {
    if (!use->present()) continue;
    textured = true;
    // Places along longer sides are not whole numbers in float.
    const Image& image = scene.images[static_cast<std::size_t>(use->image)];
    if (std::max(image.width, image.height) > 1 << 20) return SurfaceKind::layered;
  }
  return textured ? SurfaceKind::textured : SurfaceKind::plain;
}

Vec4f base_color_at(const Scene& scene, const Mesh& mesh, unsigned triangle, float u, float v) {
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  return base_color(scene, mesh, TrianglePlace(mesh, triangle, u, v), m);
}

void keep_within(const Mesh& mesh, unsigned triangle, float distance, float& u, float& v) {
  constexpr float kNear = 1.0f / 512;  // tested first: most hits are farther from all edges
  if (std::min({u, v, 1 - u - v}) >= kNear) return;
  const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * std::size_t{triangle} + i]]; };
  const std::array<Vec3f, 3> p = {corner(0), corner(1), corner(2)};
  const float twice_area = length(cross(p[1] - p[0], p[2] - p[0]));
  if (!(twice_area > 0)) return;
  std::array<float, 3> weight = {1 - u - v, u, v};
  float sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float least = distance * length(p[(i + 1) % 3] - p[(i + 2) % 3]) / twice_area;  // distance over the triangle's height
    weight[i] = std::max(weight[i], std::min(least, 1.0f / 3));
    sum += weight[i];
  }
  u = weight[1] / sum;
  v = weight[2] / sum;
}

Vec3f smooth_position(const Mesh& mesh, unsigned triangle, float u, float v, Vec3f outside) {
  const TrianglePlace at(mesh, triangle, u, v);
  const Vec3f hit = at(mesh.positions);
  Vec3f lift{};
  for (const auto& [i, weight] : {std::pair{at.i0, at.w0}, std::pair{at.i1, at.u}, std::pair{at.i2, at.v}})
    lift += from_kernel(SurfaceKernels().surface_lift(in_kernel(mesh.positions[i] - hit), in_kernel(unit(mesh.normals[i])),
                                                      in_kernel(outside), in_kernel(weight)));
  return hit + lift;
}

SurfaceFootprint footprint_on(const MipMaps& maps, const Mesh& mesh, unsigned triangle, Vec3f direction, float distance,
                              const PixelSteps& steps) {
  const TrianglePlace at(mesh, triangle, 0, 0);
  const Vec3f &p = mesh.positions[at.i0], e1 = mesh.positions[at.i1] - p, e2 = mesh.positions[at.i2] - p, n = cross(e1, e2);
  const float facing = dot(n, direction), area2 = dot(n, n), depth = distance * dot(direction, steps.forward);
  SurfaceFootprint covered{&maps, {}, {}};
  if (!(area2 > 0) || facing == 0) return covered;
  const auto change = [&](Vec3f step) {  // change of the hit, then of its coordinates
    const Vec3f q = (step - direction * (dot(n, step) / facing)) * (depth / area2);
    return Vec2f{dot(cross(q, e2), n), dot(cross(e1, q), n)};
  };
  covered.right = change(steps.right);
  covered.down = change(steps.down);
  return covered;
}

Surface surface_at(const Scene& scene, const Mesh& mesh, unsigned triangle, float u, float v, Vec3f view,
                   const SurfaceFootprint& footprint) {
  const TrianglePlace at(mesh, triangle, u, v, footprint);
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  Surface s;
  s.material = &m;
  s.position = at(mesh.positions);
  const Vec3f& p0 = mesh.positions[at.i0];
  const Vec3f geometric = cross(mesh.positions[at.i1] - p0, mesh.positions[at.i2] - p0);
  const bool front = dot(geometric, view) >= 0;
  Vec3f n = unit(at(mesh.normals));
  if (!(dot(n, n) > 0.5f)) n = unit(geometric);
  const float side = front ? 1.0f : -1.0f;
  s.geometric_normal = (dot(unit(geometric), unit(geometric)) > 0.5f ? unit(geometric) : n) * side;

  SurfaceKernels k;
  const auto look_up = [&](const TextureUse& use) { return texel(scene, mesh, at, use); };
  const Vec4f base = base_color(scene, mesh, at, m);
  const SurfaceKernels::vec3 color = in_kernel(color_of(base));
  if (m.unlit) {
    s.normal = s.coat_normal = n * side;
    s.tangent = any_tangent(n);
    return finish(s, k.surface_unlit(color), base.w);
  }
  Vec3f emission;
  if (m.emits() && (front || m.double_sided)) {
    const LightEmission* lamp = emission_of(scene, mesh);
    emission = lamp != nullptr ? static_cast<Vec3f>(emitted_radiance(*lamp, static_cast<Vec3d>(view))) : m.emissive;
    emission = emission * color_of(look_up(m.emissive_texture));
  }

  const SurfaceKernels::SurfaceFrame frame =
      k.surface_frame(in_kernel(n), in_kernel(mesh.tangents.empty() ? Vec4f{} : at(mesh.tangents)), in_kernel(any_tangent(n)));
  const auto normal_of = [&](const TextureUse& use) {
    return from_kernel(k.surface_towards(bent_normal(scene, mesh, at, use, frame) * in_kernel(side), in_kernel(view),
                                         in_kernel(std::fabs(dot(unit(geometric), view)))));
  };
  s.normal = normal_of(m.normal_texture);
  s.coat_normal = normal_of(m.clearcoat_normal_texture);

  const Vec4f rough_metal = look_up(m.metallic_roughness_texture);
  const SurfaceKernels::real metallic = in_kernel(std::clamp(m.metallic * rough_metal.z, 0.0f, 1.0f));
  s.alpha_x = s.alpha_y = k.surface_alpha(in_kernel(m.roughness * rough_metal.y)).v;
  SurfaceKernels::vec3 along = frame.x;
  if (m.anisotropy > 0) {
    float strength = m.anisotropy, angle = m.anisotropy_rotation;
    if (m.anisotropy_texture.present()) {
      const Vec4f c = look_up(m.anisotropy_texture);
      angle += std::atan2(2 * c.y - 1, 2 * c.x - 1);
      strength *= c.z;
    }
    s.alpha_x = k.surface_brushed_alpha(in_kernel(s.alpha_x), in_kernel(strength)).v;
    along = frame.x * in_kernel(std::cos(angle)) + frame.y * in_kernel(std::sin(angle));
  }
  s.tangent = from_kernel(k.surface_tangent(along, in_kernel(s.normal), in_kernel(any_tangent(s.normal))));

  const float r = (m.ior - 1) / (m.ior + 1), cosine = dot(s.normal, view);
  const SurfaceKernels::SurfaceDielectric dielectric =
      k.surface_dielectric(in_kernel(m.specular * look_up(m.specular_texture).w),
                           in_kernel(m.specular_color * color_of(look_up(m.specular_color_texture))), in_kernel(r * r));
  SurfaceKernels::SurfaceWeights weights = k.surface_weights(in_kernel(emission), color, metallic, dielectric);
  if (m.transmission > 0 && m.specular_override.empty()) {
    const float share = m.transmission * look_up(m.transmission_texture).x;
    weights = k.surface_transmitting(weights, color, metallic, dielectric, in_kernel(share), in_kernel(cosine));
  }
  if (scene.multiple_scattering) scatter_between_facets(s, view, weights);
  if (weighs(m.sheen_color)) {
    const Vec3f sheen = m.sheen_color * color_of(look_up(m.sheen_color_texture));
    if (weighs(sheen)) {
      s.sheen_alpha = k.surface_alpha(in_kernel(m.sheen_roughness * look_up(m.sheen_roughness_texture).w)).v;
      const double albedo = charlie_albedo(static_cast<double>(s.sheen_alpha), std::clamp(static_cast<double>(cosine), 0.0, 1.0));
      weights = k.surface_with_sheen(weights, in_kernel(sheen), in_kernel(static_cast<float>(albedo)));
    }
  }
  const float coat = m.clearcoat * look_up(m.clearcoat_texture).x;
  if (coat > 0) {
    s.coat_alpha = k.surface_alpha(in_kernel(m.clearcoat_roughness * look_up(m.clearcoat_roughness_texture).y)).v;
    weights = k.surface_with_coat(weights, in_kernel(coat), in_kernel(dot(s.coat_normal, view)));
  }
  return finish(s, weights, base.w);
}

Material sheen_of(const Surface& s) {
  Material m;
  m.brdf = Brdf::charlie;
  m.alpha_x = m.alpha_y = static_cast<double>(s.sheen_alpha);
  m.albedo = static_cast<Vec3d>(s.sheen);
  return m;
}

std::vector<SurfaceLobe> lobes_of(const Surface& s, const ClassicTable* fitted) {
  std::vector<SurfaceLobe> lobes;
  if (s.material->unlit) return lobes;
  if (weighs(s.albedo)) {
    Material m;
    m.albedo = static_cast<Vec3d>(s.albedo);
    m.fresnel_loss = static_cast<double>(s.fresnel_loss);
    lobes.push_back({m, s.normal, true});
  }
  if (weighs(s.f0) || weighs(s.f90)) {
    lobes.push_back({ggx_of(s), s.normal, false});
  }
  if (weighs(s.sheen)) lobes.push_back({sheen_of(s), s.normal, false});
  for (const Material& m : s.material->specular_override) lobes.push_back({m, s.normal, m.brdf == Brdf::lambert});
  if (s.coat > 0) {
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = m.alpha_y = s.coat_alpha;
    m.f0 = Vec3d{kCoatF0, kCoatF0, kCoatF0} * static_cast<double>(s.coat);
    m.f90 = Vec3d{1, 1, 1} * static_cast<double>(s.coat);
    lobes.push_back({m, s.coat_normal, false});
  }
  for (SurfaceLobe& lobe : lobes)
    if (lobe.material.brdf == Brdf::ggx) lobe.material.fitted = fitted;
  return lobes;
}

Vec3f left_after(const SurfaceMaterial& m, float distance) {
  if (!(m.attenuation_distance < std::numeric_limits<float>::infinity())) return {1, 1, 1};
  const float t = distance / m.attenuation_distance;
  return {std::pow(m.attenuation_color.x, t), std::pow(m.attenuation_color.y, t), std::pow(m.attenuation_color.z, t)};
}

}  // namespace steradian
