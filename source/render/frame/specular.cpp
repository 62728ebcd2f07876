#include "render/frame/specular.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "integrals/irradiance.h"
#include "integrals/point_light.h"
#include "integrals/textured/profiled_light.h"
#include "integrals/textured/textured_light.h"
#include "render/direct/profiled_means.h"
#include "render/direct/textured_means.h"
#include "render/frame/uneven_diffuse.h"
#include "render/many/lobe_elements.h"
#include "render/surface/gbuffer.h"
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/half_vector.h"
#include "steradian/ltc.h"

namespace steradian {

// One GGX lobe at every pixel of a tile: normal, widths and Fresnel's two reflectances.
struct SpecularPass::Lobe {
  const TileVector& normal;
  const TilePlane &alpha_x, &alpha_y;
  TileVector f0, f90;
  bool over_diffuse = false;  // the walk for this lobe may serve the diffuse one
};

namespace {

void add_to(TileVector& v, std::size_t i, Vec3f a) {
  v.x[i] += a.x;
  v.y[i] += a.y;
  v.z[i] += a.z;
}

// Adds one channel at every pixel. The fresnel part is the plain one weighted by (1 - v.h)^5.
void add_coloured(TilePlane& radiance, const TilePlane& f0, const TilePlane& f90, const TilePlane& plain, const TilePlane& fresnel,
                  float light) {
  for (std::size_t i = 0; i < kTilePixels; ++i) radiance[i] += light * (f0[i] * (plain[i] - fresnel[i]) + f90[i] * fresnel[i]);
}

void add_diffuse(TilePlane& radiance, const TilePlane& albedo, const TilePlane& irradiance, float light) {
  const float factor = light * std::numbers::inv_pi_v<float>;
  for (std::size_t i = 0; i < kTilePixels; ++i) radiance[i] += albedo[i] * factor * irradiance[i];
}

ShadingPoint shading_point(const SurfaceTile& tile, const TileVector& normal, std::size_t i) {
  return {static_cast<Vec3d>(get(tile.position, i)), normalized(static_cast<Vec3d>(get(normal, i))),
          normalized(static_cast<Vec3d>(get(tile.view, i)))};
}
ShadingPoint shading_point(const SurfaceTile& tile, std::size_t i) { return shading_point(tile, tile.normal, i); }

// The ellipse that a point sees of a round light; empty if the light does not shine there.
std::optional<Ellipse> outline_at(const AreaLight& light, Vec3d position) {
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&light.shape)) return silhouette(*ellipsoid, position);
  const auto& disk = std::get<Ellipse>(light.shape);
  const double height = dot(position - disk.center, cross(disk.x, disk.y));
  if (height > 0 || (height < 0 && light.two_sided)) return disk;
  return {};
}

// The light as the point sees it: a round light as a polygon about the lobe. No vertices: the light does not shine there.
PreparedPolygon polygon_at(const PackLight& light, std::size_t slot, const ShadingPoint& at, const Material& material, Quality quality) {
  if (light.is_polygon()) return light.polygon;
  if (const auto* pieces = std::get_if<packed::Pieces>(&light.shape)) {
    PreparedPolygon seen = pieces->light_of(slot, at.position, at.normal);
    seen.radiance = static_cast<Vec3d>(light.radiance);
    return seen;
  }
  const int corners = quality == Quality::high ? 16 : 12;
  PolygonLight seen;
  if (const auto* capsule = std::get_if<Capsule>(&light.area->shape)) {
    seen = polygon_for_lobe(*capsule, at.position, lobe_axis(material, at), corners);
  } else if (const std::optional<Ellipse> outline = outline_at(*light.area, at.position)) {
    seen = polygon_for_lobe(*outline, at.position, lobe_axis(material, at), corners);
  }
  if (seen.vertices.empty()) return {};
  seen.radiance = light.area->radiance;
  return prepare_polygon(seen);
}

// Width of the round lobe that replaces an anisotropic one in texture look-ups.
double width(double alpha_x, double alpha_y) { return std::sqrt(alpha_x * alpha_y); }

// Radiance of one lobe at one point under an area light of its mean radiance, by the library's float functions.
Vec3d point_radiance_of_mean(const methods::Row& row, const DirectMethod& method, const PackLight& light, std::size_t slot,
                             const ShadingPoint& at, const Material& material) {
  const PreparedPolygon polygon = polygon_at(light, slot, at, material, method.quality);
  if (polygon.vertices.empty()) return {};
  return row.polygon(polygon, at, material, method.options_for(row.method, Precision::float_)).radiance;
}

double largest_of(Vec3d v) { return std::max({v.x, v.y, v.z}); }

// Mean radiance of a textured or profiled light as a lobe sees it. Lobes other than GGX use the mean of textured lights
// (lobes_under_means).
//
//   even  light that the lobe sends to the view under radiance 1
Vec3d seen_by(const PackLight& light, std::size_t slot, const Material& material, const ShadingPoint& at, Vec3d even,
              TextureWay way = TextureWay::either) {
  const double alpha = width(material.alpha_x, material.alpha_y);
  const bool textured = light.textured != nullptr && material.brdf == Brdf::ggx;
  const auto by_texture = [&](auto... how) { return static_cast<Vec3d>(light.textured->seen_by_ggx(at, alpha, how..., material.fitted)); };
  if (light.profiled != nullptr)
    if (const std::optional<Vec3d> even_light = light.profiled->even_radiance(at.position)) return *even_light;
  if (light.is_pieces() && (light.profiled != nullptr || textured)) {
    const PlaneRegion visible = visible_region(light, slot, at.position);
    if (textured) return by_texture(visible);
    return light.profiled->seen_in_part(material, at, largest_of(even), visible);
  }
  if (light.profiled != nullptr) return light.profiled->seen_by(material, at, largest_of(even));
  if (textured) return by_texture(way);
  return static_cast<Vec3d>(light.radiance);
}

// The same, with the textured or profiled light as the lobe sees it.
Vec3d point_radiance(const methods::Row& row, const DirectMethod& method, const PackLight& light, std::size_t slot, const ShadingPoint& at,
                     const Material& material) {
  const Vec3d r = point_radiance_of_mean(row, method, light, slot, at, material);
  if (light.is_even() || r == Vec3d{}) return r;
  const Vec3d mean = static_cast<Vec3d>(light.radiance);
  const auto shares = [](Vec3d a, Vec3d b) { return Vec3d{b.x > 0 ? a.x / b.x : 0, b.y > 0 ? a.y / b.y : 0, b.z > 0 ? a.z / b.z : 0}; };
  const Vec3d even = shares(r, mean);
  return even * seen_by(light, slot, material, at, even);
}

// The same under a punctual light: the lobe is evaluated in one direction.
Vec3d point_radiance_punctual(const methods::Row& row, const DirectMethod& method, const PackLight& light, const ShadingPoint& at,
                              const Material& material) {
  const auto incident = shapes::incident<double>(*std::get_if<packed::Punctual>(&light.shape), shapes::to_kernel<double>(at.position));
  const Vec3d to = {incident.direction.x.v, incident.direction.y.v, incident.direction.z.v};
  return methods::lobe_towards(to, at, material, row, method.options_for(row.method, Precision::double_)) *
         static_cast<Vec3d>(light.radiance) * incident.irradiance.v;
}

}  // namespace

SpecularPass::SpecularPass(const DirectMethod& method)
    : method_(method),
      procedure_(methods::procedure_of(method.ggx, Brdf::ggx)),
      packs_(lobe_packs_for(active_simd())),
      elements_(elements_of(procedure_, active_simd())),
      tables_(tables_of(method)),
      compact_tables_(ltc_pack_tables(Method::ltc_compact)) {}

bool SpecularPass::brings_diffuse(const SurfaceTile& tile, const PackLight& light) const {
  return procedure_ == methods::Procedure::ltc && tile.any_specular && tile.any_diffuse && (light.is_polygon() || light.is_pieces()) &&
         light.is_even();
}

Material SpecularPass::ggx_material(const Lobe& lobe, const SurfaceTile& tile, std::size_t i) const {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = static_cast<double>(lobe.alpha_x[i]);
  m.alpha_y = static_cast<double>(lobe.alpha_y[i]);
  m.tangent = static_cast<Vec3d>(get(tile.tangent, i));
  m.f0 = static_cast<Vec3d>(get(lobe.f0, i));
  m.f90 = static_cast<Vec3d>(get(lobe.f90, i));
  m.fitted = method_.table.get();
  return m;
}

void SpecularPass::integrate_ggx(const PackLight& light, const Points& points, const LobeRadiance& result) const {
  const auto punctual = tables_.matrix.size > 0 ? packs_.punctual_ltc : packs_.punctual_ggx;
  (light.is_area() ? packs_[procedure_] : punctual)(light, points, {{}, {method_.ggx, method_.quality}, &tables_}, result);
}

// The largest channel of the lobe decides, as in ProfiledLight::seen_by.
void SpecularPass::find_profiled_means(const ProfiledLight& light, const Points& points, const Lobe& lobe, const LobeRadiance& even,
                                       const ProfiledMeans& means) {
  alignas(64) TilePlane f0, f90, integral;
  const auto largest = [](const TileVector& v, std::size_t i) { return std::max({v.x[i], v.y[i], v.z[i]}); };
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    f0[i] = largest(lobe.f0, i), f90[i] = largest(lobe.f90, i);
    integral[i] = f0[i] * (even.plain[i] - even.fresnel[i]) + f90[i] * even.fresnel[i];
  }
  profiled_means_table_for(active_simd()).ggx(light, points, {f0.data(), f90.data(), integral.data()}, means);
}

void SpecularPass::add_ggx(SurfaceTile& tile, const Lobe& lobe, const std::vector<const PackLight*>& lights) const {
  const Points points = points_of(tile, lobe.normal, lobe.alpha_x, lobe.alpha_y);
  alignas(64) TilePlane plain, fresnel, irradiance;
  for (const PackLight* light : lights) {
    const bool diffuse = lobe.over_diffuse && brings_diffuse(tile, *light);
    integrate_ggx(*light, points, {plain.data(), fresnel.data(), diffuse ? irradiance.data() : nullptr});
    if (diffuse) {
      add_diffuse(tile.radiance.x, tile.albedo.x, irradiance, light->radiance.x);
      add_diffuse(tile.radiance.y, tile.albedo.y, irradiance, light->radiance.y);
      add_diffuse(tile.radiance.z, tile.albedo.z, irradiance, light->radiance.z);
    }
    if (light->is_even()) {
      add_coloured(tile.radiance.x, lobe.f0.x, lobe.f90.x, plain, fresnel, light->radiance.x);
      add_coloured(tile.radiance.y, lobe.f0.y, lobe.f90.y, plain, fresnel, light->radiance.y);
      add_coloured(tile.radiance.z, lobe.f0.z, lobe.f90.z, plain, fresnel, light->radiance.z);
      continue;
    }
    TileVector seen;
    alignas(64) TilePlane found, wanted, candela;
    for (std::size_t i = 0; i < kTilePixels; ++i) wanted[i] = std::max(plain[i], fresnel[i]);
    found.fill(0);
    // The packs of profiles have GGX alone.
    const bool on_packs =
        light->profiled != nullptr && light->profiled->table() != nullptr && !light->is_pieces() && method_.table == nullptr;
    if (on_packs) find_profiled_means(*light->profiled, points, lobe, {plain.data(), fresnel.data()}, {candela.data(), found.data()});
    if (light->textured != nullptr && !light->is_pieces())
      textured_means_table_for(active_simd())
          .ggx(*light->textured, points, method_.table != nullptr ? tables_ : compact_tables_, wanted.data(),
               {seen.x.data(), seen.y.data(), seen.z.data(), found.data()});
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      if (!(wanted[i] > 0)) continue;
      const Vec3f f0 = get(lobe.f0, i), f90 = get(lobe.f90, i);
      Vec3f radiance = on_packs ? static_cast<Vec3f>(light->profiled->radiance_of(static_cast<double>(candela[i]))) : get(seen, i);
      const Vec3f even = f0 * (plain[i] - fresnel[i]) + f90 * fresnel[i];
      if (!(std::max({even.x, even.y, even.z}) > 0)) continue;
      if (!(found[i] > 0))
        radiance = static_cast<Vec3f>(seen_by(*light, i, ggx_material(lobe, tile, i), shading_point(tile, lobe.normal, i),
                                              static_cast<Vec3d>(even), TextureWay::look_up));
      add_to(tile.radiance, i, radiance * even);
    }
  }
}

// Elements serve sixteen points at a time. The other points of a light stand side by side for its outline.
void SpecularPass::add_far_ggx(SurfaceTile& tile, const Lobe& lobe, const std::vector<const PackLight*>& lights, const Far& far) const {
  std::vector<const PackLight*> together, others;
  std::vector<std::uint32_t> numbers;
  for (const PackLight* light : lights) {
    const std::int32_t number = far.lights.number_of[light->index];
    if (number >= 0 && light->is_polygon() && far.lights.area[static_cast<std::size_t>(number)] > 0) {
      together.push_back(light);
      numbers.push_back(static_cast<std::uint32_t>(number));
    } else {
      others.push_back(light);
    }
  }
  const Points points = points_of(tile, lobe.normal, lobe.alpha_x, lobe.alpha_y);
  lights::LobeSums sums = {};
  std::vector<std::uint64_t> left(numbers.size(), 0);
  elements_->add(far.lights, numbers.data(), numbers.size(), points, tables_, far.error, sums, left.data());
  const auto reflected = [&](std::size_t i, Vec3f plain, Vec3f fresnel) {
    return get(lobe.f0, i) * (plain - fresnel) + get(lobe.f90, i) * fresnel;
  };
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    add_to(tile.radiance, i, reflected(i, get(sums.specular, i), get(sums.grazing, i)));
    add_to(far.bound, i, reflected(i, get(sums.specular_error, i), get(sums.grazing_error, i)));
  }

  // Blocks of sixteen neighbouring slots stay together.
  TileVector position, normal, view, tangent;
  alignas(64) TilePlane alpha_x, alpha_y, plain, fresnel;
  const std::pair<const TilePlane*, TilePlane*> copies[] = {
      {&tile.position.x, &position.x}, {&tile.position.y, &position.y}, {&tile.position.z, &position.z}, {&lobe.normal.x, &normal.x},
      {&lobe.normal.y, &normal.y},     {&lobe.normal.z, &normal.z},     {&tile.view.x, &view.x},         {&tile.view.y, &view.y},
      {&tile.view.z, &view.z},         {&tile.tangent.x, &tangent.x},   {&tile.tangent.y, &tangent.y},   {&tile.tangent.z, &tangent.z},
      {&lobe.alpha_x, &alpha_x},       {&lobe.alpha_y, &alpha_y}};
  constexpr std::size_t kBlock = 16;
  for (std::size_t n = 0; n < together.size(); ++n) {
    Points some;
    for (std::uint64_t bits = left[n]; bits != 0; bits &= bits - 1, some.count += kBlock)
      for (const auto& [from, to] : copies)
        std::copy_n(from->begin() + std::countr_zero(bits) * static_cast<std::ptrdiff_t>(kBlock), kBlock,
                    to->begin() + static_cast<std::ptrdiff_t>(some.count));
    if (some.count == 0) continue;
    some.position = arrays_of(position);
    some.normal = arrays_of(normal);
    some.view = arrays_of(view);
    some.tangent = arrays_of(tangent);
    some.alpha_x = alpha_x.data();
    some.alpha_y = alpha_y.data();
    integrate_ggx(*together[n], some, {plain.data(), fresnel.data()});
    const Vec3f light = together[n]->radiance;
    std::size_t k = 0;
    for (std::uint64_t bits = left[n]; bits != 0; bits &= bits - 1)
      for (std::size_t i = static_cast<std::size_t>(std::countr_zero(bits)) * kBlock, end = i + kBlock; i < end; ++i, ++k)
        add_to(tile.radiance, i, reflected(i, light * plain[k], light * fresnel[k]));
  }
  if (!others.empty()) add_ggx(tile, lobe, others);
}

// Sheen uses its cubature with any method of GGX.
void SpecularPass::add_sheen(SurfaceTile& tile, const std::vector<const PackLight*>& lights) const {
  alignas(64) TilePlane plain;
  for (const PackLight* light : lights) {
    if (light->is_area()) {
      packs_[methods::Procedure::sheen](*light, points_of(tile, tile.sheen_alpha, tile.sheen_alpha), {}, {plain.data()});
      for (std::size_t i = 0; i < kTilePixels; ++i) {
        if (!(plain[i] > 0)) continue;
        const Vec3f color = get(tile.sheen, i);
        if (light->profiled != nullptr && !(color.x + color.y + color.z > 0)) continue;
        const Vec3f radiance = light->profiled == nullptr
                                   ? light->radiance
                                   : static_cast<Vec3f>(seen_by(*light, i, sheen_of(surface_in(tile, i)), shading_point(tile, i),
                                                                static_cast<Vec3d>(color * plain[i])));
        add_to(tile.radiance, i, color * radiance * plain[i]);
      }
      continue;
    }
    const methods::Row& row = methods::row_of(Method::cubature);
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const Vec3f color = get(tile.sheen, i);
      if (!(color.x + color.y + color.z > 0)) continue;
      const Material m = sheen_of(surface_in(tile, i));
      add_to(tile.radiance, i, static_cast<Vec3f>(point_radiance_punctual(row, method_, *light, shading_point(tile, i), m)));
    }
  }
}

// Adds a lobe in the way of the layers' lobes. Returns false if the lobe needs features that those lack.
bool SpecularPass::add_ggx_override(SurfaceTile& tile, const SurfaceMaterial& surface, const Material& m,
                                    const std::vector<const PackLight*>& lights) const {
  if (m.brdf != Brdf::ggx || !m.shadowing || m.multiple_scattering || m.tangent != Vec3d{} || method_.row_for(m).method != method_.ggx)
    return false;
  alignas(64) TilePlane alpha_x, alpha_y;
  alpha_x.fill(static_cast<float>(m.alpha_x));
  alpha_y.fill(static_cast<float>(m.alpha_y));
  Lobe lobe = {tile.normal, alpha_x, alpha_y, {}, {}};
  const auto fill = [&](TileVector& v, Vec3d value) {
    const auto f = static_cast<Vec3f>(value);
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const bool here = tile.material[i] == &surface;
      v.x[i] = here ? f.x : 0;
      v.y[i] = here ? f.y : 0;
      v.z[i] = here ? f.z : 0;
    }
  };
  fill(lobe.f0, m.f0);
  fill(lobe.f90, m.f90);
  add_ggx(tile, lobe, lights);
  return true;
}

void SpecularPass::add_overrides(SurfaceTile& tile, const std::vector<const PackLight*>& lights) const {
  const std::set<const SurfaceMaterial*> materials(tile.material.begin(), tile.material.end());
  for (const SurfaceMaterial* surface : materials) {
    if (surface == nullptr || surface->unlit) continue;
    for (const Material& material : surface->specular_override) {
      if (material.brdf == Brdf::lambert || add_ggx_override(tile, *surface, material, lights)) continue;
      const methods::Row& row = method_.row_for(material);
      const auto procedure = methods::procedure_of(row.method, material.brdf);
      const bool on_packs = (procedure == methods::Procedure::phong_lobe || procedure == methods::Procedure::half_vector) &&
                            material.brdf != Brdf::ggx && methods::has_packs(material);
      for (const PackLight* light : lights) {
        if (light->is_area() && on_packs) {
          alignas(64) TilePlane result;
          packs_[procedure](*light, points_of(tile), {material, {row.method, method_.quality, method_.early_stop, method_.peak_form}},
                            {result.data()});
          const auto factor = material.brdf == Brdf::phong ? static_cast<Vec3f>(material.albedo) : Vec3f{1, 1, 1};
          for (std::size_t i = 0; i < kTilePixels; ++i) {
            if (tile.material[i] != surface || !(result[i] > 0)) continue;
            const Vec3f even = factor * result[i];
            const Vec3f radiance = light->profiled == nullptr
                                       ? light->radiance
                                       : static_cast<Vec3f>(seen_by(*light, i, material, shading_point(tile, i), static_cast<Vec3d>(even)));
            add_to(tile.radiance, i, radiance * even);
          }
          continue;
        }
        for (std::size_t i = 0; i < kTilePixels; ++i) {
          if (tile.material[i] != surface) continue;
          const ShadingPoint at = shading_point(tile, i);
          Material m = material;
          if (m.tangent == Vec3d{}) m.tangent = static_cast<Vec3d>(get(tile.tangent, i));
          if (m.brdf == Brdf::ggx) m.fitted = method_.table.get();
          const Vec3d r =
              light->is_area() ? point_radiance(row, method_, *light, i, at, m) : point_radiance_punctual(row, method_, *light, at, m);
          add_to(tile.radiance, i, static_cast<Vec3f>(r));
        }
      }
    }
  }
}

void SpecularPass::add(SurfaceTile& tile, const std::vector<const PackLight*>& lights, Walk walk, const Far* far) const {
  // At quality high, the lobe times (1 - v.h)^5 has a table of its own, and no elements.
  const bool elements = far != nullptr && elements_ != nullptr && tables_.fresnel_matrix.size == 0;
  const auto add_lobe = [&](const Lobe& lobe) {
    if (elements)
      add_far_ggx(tile, lobe, lights, *far);
    else
      add_ggx(tile, lobe, lights);
  };
  if (tile.any_specular) add_lobe({tile.normal, tile.alpha_x, tile.alpha_y, tile.f0, tile.f90, walk == Walk::both_lobes});
  if (tile.any_sheen) add_sheen(tile, lights);
  if (tile.any_coat) {
    Lobe coat = {tile.coat_normal, tile.coat_alpha, tile.coat_alpha, {}, {}};
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      coat.f0.x[i] = coat.f0.y[i] = coat.f0.z[i] = tile.coat[i] * kCoatF0;
      coat.f90.x[i] = coat.f90.y[i] = coat.f90.z[i] = tile.coat[i];
    }
    add_lobe(coat);
  }
  if (tile.any_override) add_overrides(tile, lights);
}

}  // namespace steradian
