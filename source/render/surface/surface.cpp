#include "render/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "render/surface/surface_pack.h"
#include "steradian/albedo.h"

namespace steradian {
namespace {

constexpr auto kMinAlpha = static_cast<float>(kSmallestAlpha);

// Interpolation of values at the corners of a triangle.
struct Corner {
  std::uint32_t i0, i1, i2;
  float w0, u, v;
  SurfaceFootprint covered;

  Corner(const Mesh& mesh, unsigned triangle, float u_, float v_, const SurfaceFootprint& footprint = {})
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

Vec4f texel(const Scene& scene, const Mesh& mesh, const Corner& at, const TextureUse& use) {
  if (!use.present()) return {1, 1, 1, 1};
  const auto& set = mesh.texcoords[use.texcoord];
  if (set.empty() || at.covered.maps == nullptr) return sample_texture(scene.images, use, set.empty() ? Vec2f{} : at(set));
  return sample_texture(*at.covered.maps, use, at(set), {at.change(set, at.covered.right), at.change(set, at.covered.down)});
}

Vec4f base_color(const Scene& scene, const Mesh& mesh, const Corner& at, const SurfaceMaterial& m) {
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

// The part of a unit vector across a normal, as a unit vector. It is computed twice, because a small part is mostly rounding. Returns any
// direction across the normal if there is no such part.
Vec3f perpendicular_part(Vec3f a, Vec3f n) {
  const Vec3f once = a - n * dot(n, a);
  if (!(dot(once, once) > 1e-10f)) return any_tangent(n);
  const Vec3f x = unit(once);
  return unit(x - n * dot(n, x));
}

// The frame of tangent-space textures on the front face: the vertices' normal, and the mesh's tangent made perpendicular to it.
struct TangentFrame {
  Vec3f x, y, z;
};
TangentFrame tangent_frame(const Mesh& mesh, const Corner& at, Vec3f n) {
  if (!mesh.tangents.empty()) {
    const Vec4f t4 = at(mesh.tangents);
    const Vec3f t{t4.x, t4.y, t4.z};
    const Vec3f x = unit(t - n * dot(n, t));
    if (dot(x, x) > 0.5f) return {x, cross(n, x) * (t4.w < 0 ? -1.0f : 1.0f), n};
  }
  const Vec3f x = any_tangent(n);
  return {x, cross(n, x), n};
}

// Normal from a normal map, on the front face; the vertices' normal if the map points below the surface.
Vec3f bent_normal(const Scene& scene, const Mesh& mesh, const Corner& at, const TextureUse& use, const TangentFrame& frame) {
  if (!use.present()) return frame.z;
  const Vec4f c = texel(scene, mesh, at, use);
  const float up = 2 * c.z - 1;
  const Vec3f bent = unit(frame.x * ((2 * c.x - 1) * use.scale) + frame.y * ((2 * c.y - 1) * use.scale) + frame.z * up);
  return dot(bent, bent) > 0.5f && up > 0 ? bent : frame.z;
}

double cosine_of_view(const Surface& s, Vec3f view) { return std::clamp(static_cast<double>(dot(s.normal, view)), 0.0, 1.0); }

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

void scatter_between_facets(Surface& s, Vec3f view) {
  Material m = ggx_of(s);
  m.multiple_scattering = true;
  m = with_multiple_scattering(m, {{}, static_cast<Vec3d>(s.normal), static_cast<Vec3d>(view)});
  s.f0 = static_cast<Vec3f>(m.f0);
  s.f90 = static_cast<Vec3f>(m.f90);
}

// KHR_materials_sheen: light that the fibres reflect does not reach the layers below.
void add_sheen(Surface& s, const Scene& scene, const Mesh& mesh, const Corner& at, Vec3f view) {
  const SurfaceMaterial& m = *s.material;
  s.sheen = m.sheen_color;
  if (m.sheen_color_texture.present()) {
    const Vec4f c = texel(scene, mesh, at, m.sheen_color_texture);
    s.sheen = s.sheen * Vec3f{c.x, c.y, c.z};
  }
  const float strongest = std::max({s.sheen.x, s.sheen.y, s.sheen.z});
  if (!(strongest > 0)) return;
  float roughness = m.sheen_roughness;
  if (m.sheen_roughness_texture.present()) roughness *= texel(scene, mesh, at, m.sheen_roughness_texture).w;
  s.sheen_alpha = std::clamp(roughness * roughness, kMinAlpha, 1.0f);
  const auto albedo = static_cast<float>(charlie_albedo(static_cast<double>(s.sheen_alpha), cosine_of_view(s, view)));
  const float under = std::clamp(1 - strongest * albedo, 0.0f, 1.0f);
  s.albedo *= under;
  s.f0 *= under;
  s.f90 *= under;
  s.passes *= under;
}

Vec3f mix(Vec3f a, Vec3f b, float t) { return a * (1 - t) + b * t; }

float covered(const SurfaceMaterial& m, const Vec4f& base) {
  return m.alpha_mode == AlphaMode::blend ? std::clamp(base.w, 0.0f, 1.0f) : 1.0f;
}

// Scales a surface by its coverage. The rest of its place shows the surfaces behind.
void cover(Surface& s, float share) {
  if (share == 1) return;
  for (Vec3f* part : {&s.emission, &s.albedo, &s.f0, &s.f90, &s.sheen, &s.passes}) *part *= share;
  s.coat *= share;
  s.passes += Vec3f{1, 1, 1} * (1 - share);
}

// A visible surface is seen from above. If interpolation or a normal map turns the normal away from the viewer, this turns it back until
// the view lies just above its horizon.
//
//   facing   cosine between the view and the triangle, which itself never changes
Vec3f turned_to(Vec3f n, Vec3f view, float facing) {
  const float least = std::min(0.01f, 0.5f * facing), c = dot(n, view);
  return c >= least ? n : unit(n + view * (least - c));
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
  return base_color(scene, mesh, Corner(mesh, triangle, u, v), m);
}

Vec3f smooth_position(const Mesh& mesh, unsigned triangle, float u, float v, Vec3f outside) {
  const Corner at(mesh, triangle, u, v);
  const Vec3f hit = at(mesh.positions);
  Vec3f lift{};
  for (const auto& [i, weight] : {std::pair{at.i0, at.w0}, std::pair{at.i1, at.u}, std::pair{at.i2, at.v}}) {
    const Vec3f n = unit(mesh.normals[i]);
    const Vec3f up = dot(n, outside) < 0 ? -n : n;
    lift += up * (weight * std::max(0.0f, dot(mesh.positions[i] - hit, up)));
  }
  return hit + lift;
}

SurfaceFootprint footprint_on(const MipMaps& maps, const Mesh& mesh, unsigned triangle, Vec3f direction, float distance,
                              const PixelSteps& steps) {
  const Corner at(mesh, triangle, 0, 0);
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
  const Corner at(mesh, triangle, u, v, footprint);
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

  const Vec4f base = base_color(scene, mesh, at, m);
  const Vec3f color{base.x, base.y, base.z};
  if (m.unlit) {
    s.normal = s.coat_normal = n * side;
    s.tangent = any_tangent(n);
    s.emission = color;
    cover(s, covered(m, base));
    return s;
  }
  if (m.emits() && (front || m.double_sided)) {
    const LightEmission* lamp = emission_of(scene, mesh);
    s.emission = lamp != nullptr ? static_cast<Vec3f>(emitted_radiance(*lamp, static_cast<Vec3d>(view))) : m.emissive;
    if (m.emissive_texture.present()) {
      const Vec4f t = texel(scene, mesh, at, m.emissive_texture);
      s.emission = s.emission * Vec3f{t.x, t.y, t.z};
    }
  }

  const TangentFrame frame = tangent_frame(mesh, at, n);
  const float facing = std::fabs(dot(unit(geometric), view));
  s.normal = turned_to(bent_normal(scene, mesh, at, m.normal_texture, frame) * side, view, facing);
  s.coat_normal = turned_to(bent_normal(scene, mesh, at, m.clearcoat_normal_texture, frame) * side, view, facing);

  float metallic = m.metallic, roughness = m.roughness;
  if (m.metallic_roughness_texture.present()) {
    const Vec4f c = texel(scene, mesh, at, m.metallic_roughness_texture);
    roughness *= c.y;
    metallic *= c.z;
  }
  metallic = std::clamp(metallic, 0.0f, 1.0f);
  const float alpha = std::clamp(roughness * roughness, kMinAlpha, 1.0f);
  s.alpha_x = s.alpha_y = alpha;
  Vec3f along = frame.x;
  if (m.anisotropy > 0) {
    float strength = m.anisotropy, angle = m.anisotropy_rotation;
    if (m.anisotropy_texture.present()) {
      const Vec4f c = texel(scene, mesh, at, m.anisotropy_texture);
      angle += std::atan2(2 * c.y - 1, 2 * c.x - 1);
      strength *= c.z;
    }
    // KHR_materials_anisotropy: the lobe widens along the rotated tangent towards alpha = 1.
    s.alpha_x = alpha + (1 - alpha) * strength * strength;
    along = frame.x * std::cos(angle) + frame.y * std::sin(angle);
  }
  s.tangent = perpendicular_part(along, s.normal);

  float specular = m.specular;
  if (m.specular_texture.present()) specular *= texel(scene, mesh, at, m.specular_texture).w;
  Vec3f specular_color = m.specular_color;
  if (m.specular_color_texture.present()) {
    const Vec4f c = texel(scene, mesh, at, m.specular_color_texture);
    specular_color = specular_color * Vec3f{c.x, c.y, c.z};
  }
  const float r = (m.ior - 1) / (m.ior + 1);
  const auto clamp1 = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
  const Vec3f colored = specular_color * (r * r);
  const Vec3f dielectric = Vec3f{clamp1(colored.x), clamp1(colored.y), clamp1(colored.z)} * specular;
  const float largest_f0 = std::max({dielectric.x, dielectric.y, dielectric.z});
  s.albedo = color * ((1 - metallic) * (1 - largest_f0));
  s.fresnel_loss = largest_f0 < 1 ? (specular - largest_f0) / (1 - largest_f0) : 0;
  s.f0 = mix(dielectric, color, metallic);
  s.f90 = mix(Vec3f{specular, specular, specular}, Vec3f{1, 1, 1}, metallic);

  if (m.transmission > 0 && m.specular_override.empty()) {
    float share = m.transmission;
    if (m.transmission_texture.present()) share *= texel(scene, mesh, at, m.transmission_texture).x;
    const float c = std::clamp(1 - dot(s.normal, view), 0.0f, 1.0f), reflected = largest_f0 + (specular - largest_f0) * c * c * c * c * c;
    s.albedo *= 1 - share;
    s.passes = color * ((1 - metallic) * share * (1 - std::min(reflected, 1.0f)));
  }
  if (scene.multiple_scattering) scatter_between_facets(s, view);
  add_sheen(s, scene, mesh, at, view);

  s.coat = m.clearcoat;
  if (m.clearcoat_texture.present()) s.coat *= texel(scene, mesh, at, m.clearcoat_texture).x;
  if (s.coat > 0) {
    float coat_roughness = m.clearcoat_roughness;
    if (m.clearcoat_roughness_texture.present()) coat_roughness *= texel(scene, mesh, at, m.clearcoat_roughness_texture).y;
    s.coat_alpha = std::clamp(coat_roughness * coat_roughness, kMinAlpha, 1.0f);
    // KHR_materials_clearcoat: light that the coat reflects at the view's angle does not reach the layers below.
    const float c = std::clamp(1 - dot(s.coat_normal, view), 0.0f, 1.0f);
    const float under = 1 - s.coat * (kCoatF0 + (1 - kCoatF0) * c * c * c * c * c);
    s.albedo *= under;
    s.f0 *= under;
    s.f90 *= under;
    s.sheen *= under;
    s.emission *= under;
    s.passes *= under;
  }
  if (!m.specular_override.empty()) {
    s.f0 = s.f90 = {};
    s.fresnel_loss = 0;
  } else {
    cover(s, covered(m, base));
  }
  return s;
}

Material sheen_of(const Surface& s) {
  Material m;
  m.brdf = Brdf::charlie;
  m.alpha_x = m.alpha_y = static_cast<double>(s.sheen_alpha);
  m.albedo = static_cast<Vec3d>(s.sheen);
  return m;
}

std::vector<SurfaceLobe> lobes_of(const Surface& s) {
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
  return lobes;
}

}  // namespace steradian
