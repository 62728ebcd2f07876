#include "device/direct/light_details.h"

#include <algorithm>
#include <bit>

#include "integrals/textured/textured_light.h"
#include "integrals/textured/profiled_light.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"

constexpr std::size_t kHead = static_cast<std::size_t>(kTextureHead), kLevel = static_cast<std::size_t>(kTextureLevel),
                      kCell = static_cast<std::size_t>(kTextureCell), kProfiled = static_cast<std::size_t>(kProfileHead);
constexpr std::size_t kMostNumbers = std::size_t{1} << 24;  // largest count that a float holds

float number(double x) { return static_cast<float>(x); }
float number(std::size_t n) { return static_cast<float>(n); }
Vec4Floats with(Vec3d v, double w) { return {number(v.x), number(v.y), number(v.z), number(w)}; }

std::size_t texels_of(const FilteredTexture& texture) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < texture.level_count(); ++k) count += texture.level(k).texels.size();
  return count;
}

std::size_t vectors_of(const TexturedLight& light) {
  const FilteredTexture& texture = light.texture();
  return kHead + kLevel * texture.level_count() + texels_of(texture) + kCell * light.tree().cells().size();
}

void add_cells(const std::vector<TextureCell>& cells, std::vector<Vec4Floats>& to) {
  // Successor of a cell and its subtree: for a first child the second one, for a second child its parent's successor.
  std::vector<double> next(cells.size(), -1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].children == 0) continue;
    const auto child = static_cast<std::size_t>(cells[i].children);
    next[child] = static_cast<double>(child + 1);
    next[child + 1] = next[i];
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const TextureCell& c = cells[i];
    to.insert(to.end(), {Vec4Floats{number(c.center[0]), number(c.center[1]), number(c.axis_a[0]), number(c.axis_a[1])},
                         Vec4Floats{number(c.axis_b[0]), number(c.axis_b[1]), number(c.area), number(c.radius)}, with(c.mean, c.deviation),
                         with(c.along_a, c.children), with(c.along_b, next[i])});
  }
}

void add_texture(const TexturedLight& light, std::vector<Vec4Floats>& to) {
  const FilteredTexture& texture = light.texture();
  const TextureTree& tree = light.tree();
  const std::size_t first_texel = to.size() + kHead + kLevel * texture.level_count(), first_cell = first_texel + texels_of(texture);
  const auto [left, right, bottom, top] = tree.bounds();
  to.insert(to.end(),
            {with(texture.origin(), tree.finest()), with(texture.axis_x(), static_cast<double>(texture.level_count())),
             with(texture.axis_y(), static_cast<double>(first_cell)), Vec4Floats{number(left), number(right), number(bottom), number(top)},
             with(static_cast<Vec3d>(texture.mean()), 0), with({texture.centroid()[0], texture.centroid()[1], 0}, 0),
             with({texture.covariance()[0], texture.covariance()[1], texture.covariance()[2]}, 0)});
  std::size_t texel = first_texel;
  for (std::size_t k = 0; k < texture.level_count(); ++k) {
    const PlaneTexels level = texture.level(k);
    to.push_back({number(level.left), number(level.bottom), number(level.spacing), number(texture.sigma(k))});
    to.push_back({static_cast<float>(level.width), static_cast<float>(level.height), number(texel), 0});
    texel += level.texels.size();
  }
  for (std::size_t k = 0; k < texture.level_count(); ++k) {
    const auto& texels = texture.level(k).texels;
    to.insert(to.end(), texels.begin(), texels.end());
  }
  add_cells(tree.cells(), to);
}

// A head, then all numbers of the profile, four per vector.
std::size_t vectors_of(const LightProfile& profile) {
  return 1 + (profile.vertical.size() + profile.horizontal.size() + profile.candela.size() + 3) / 4;
}

void add_profile(const LightProfile& profile, std::vector<Vec4Floats>& to) {
  to.push_back(
      {profile.type == LightProfile::Type::b ? 1.0f : 0.0f, number(profile.vertical.size()), number(profile.horizontal.size()), 0});
  std::size_t k = 0;
  for (const std::vector<double>* numbers : {&profile.vertical, &profile.horizontal, &profile.candela})
    for (const double x : *numbers) {
      if (k % 4 == 0) to.emplace_back();
      to.back()[k++ % 4] = number(x);
    }
}

// Adds the data of a rect or disk, followed by its profile.
void add_profiled(const PackLight& light, std::vector<Vec4Floats>& to) {
  const LightEmission& emission = light.profiled->emission();
  const ProfiledLight::Outline o = light.profiled->outline();
  // Mean over all directions, in the unit of the profile's candela.
  const auto largest = [](Vec3d v) { return std::max({v.x, v.y, v.z}); };
  const double mean = largest(static_cast<Vec3d>(light.radiance)) * emission.area / largest(emission.intensity);
  to.insert(to.end(), {with(o.center, o.round ? 1 : 0), with(o.x, o.widest), with(o.y, static_cast<double>(to.size() + kProfiled)),
                       with(emission.axes.x, length(cross(o.x, o.y))), with(emission.axes.y, mean), with(emission.axes.aim, 0)});
  add_profile(*emission.profile, to);
}

const LightProfile* profile_of(const PackLight& light) {
  if (light.profiled != nullptr) return light.profiled->emission().profile.get();
  const auto* punctual = std::get_if<packed::Punctual>(&light.shape);
  return punctual != nullptr ? punctual->profile : nullptr;
}

// A mean uses up to 2,304 directions, each found among the angles by bisection. Software devices end a thread's loops after 65,535 turns.
bool is_too_fine(const LightProfile& profile) {
  constexpr int kMostHalvings = 19;
  const auto halvings = [](const std::vector<double>& angles) { return std::bit_width(angles.size()); };
  return halvings(profile.vertical) + halvings(profile.horizontal) > kMostHalvings;
}

const void* key_of(const PackLight& light) {
  if (light.profiled != nullptr) return light.profiled.get();
  return light.textured != nullptr ? static_cast<const void*>(light.textured.get()) : profile_of(light);
}

}  // namespace

LightDetails::LightDetails(const std::vector<PackLight>& lights, std::size_t most_vectors) {
  most_vectors = std::min(most_vectors, kMostNumbers);
  for (const PackLight& light : lights) {
    const void* key = key_of(light);
    if (key == nullptr || firsts_.contains(key)) continue;
    const LightProfile* profile = profile_of(light);
    if (light.profiled != nullptr && is_too_fine(*profile)) continue;
    if (values_.size() + (profile != nullptr ? kProfiled + vectors_of(*profile) : vectors_of(*light.textured)) > most_vectors) continue;
    firsts_[key] = values_.size();
    if (light.profiled != nullptr)
      add_profiled(light, values_);
    else if (profile != nullptr)
      add_profile(*profile, values_);
    else
      add_texture(*light.textured, values_);
  }
}

bool LightDetails::has(const PackLight& light) const {
  const void* key = key_of(light);
  return key == nullptr || firsts_.contains(key);
}

std::ptrdiff_t LightDetails::first_of(const PackLight& light) const {
  const auto at = firsts_.find(key_of(light));
  return at == firsts_.end() ? kNoDetails : static_cast<std::ptrdiff_t>(at->second);
}

}  // namespace steradian::vulkan
