#include "render/environment/environment_shadows.h"

#include <algorithm>
#include <cmath>

#include "core/lattices.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::environment {
namespace {

constexpr int kSets = 16;  // sets of directions; more primary samples repeat them

// Number of directions on the sphere: about half are above a surface.
std::size_t directions_for(Quality quality) {
  switch (quality) {
    case Quality::draft: return 256;
    case Quality::high: return 4096;
    case Quality::normal: break;
  }
  return 1024;
}

}  // namespace

void HalvesOfRays::add(double half_difference, double luminance) {
  squares += half_difference * half_difference;
  light += luminance;
  ++count;
}

HalvesOfRays& HalvesOfRays::operator+=(const HalvesOfRays& other) {
  squares += other.squares;
  light += other.light;
  count += other.count;
  return *this;
}

double HalvesOfRays::relative_rms() const { return light > 0 ? std::sqrt(squares * count) / light : 0; }

// Origins of the rays of the surfaces.
struct EnvironmentShadows::Origins {
  std::array<Vec3d, kLanes> position;
  std::array<Vec3f, kLanes> horizon;  // normal of the triangle, or zero where its horizon occludes nothing
};

// Visible fractions of the light of all rays, and of two halves of them.
struct EnvironmentShadows::VisibleFractions {
  std::array<Vec3f, kLanes> all;
  std::array<float, kLanes> half_difference;
};

EnvironmentShadows::EnvironmentShadows(const EnvironmentLight& light, const Scene& scene, const RayScene& rays,
                                       const RenderOptions& options)
    : light_(light), rays_(rays), clear_(scene), terminator_(options.terminator) {
  const std::size_t count = directions_for(options.quality);
  const auto width = static_cast<float>(std::sqrt(1.0 / static_cast<double>(count)));  // of a disc of the solid angle of one direction
  for (int set = 0; set < std::min(options.aa, kSets); ++set) {
    std::vector<Direction>& directions = sets_.emplace_back();
    for (std::size_t i = 0; i < count; ++i) {
      const auto to = static_cast<Vec3f>(fibonacci_direction(i, count, static_cast<double>(set) / kSets));
      directions.push_back({to, light.rest(to, width)});
    }
  }
}

// Tests one direction a surface, and tints the light of those that no mesh blocks, which it returns. What lies below the horizon of its
// triangle is blocked.
std::uint32_t EnvironmentShadows::lets_pass(const Origins& origins, const std::array<Vec3f, kLanes>& directions, std::uint32_t asked,
                                            Colors& light) const {
  const double far = 8 * static_cast<double>(rays_.reach());  // beyond every mesh
  RayScene::Sixteen sixteen;
  std::uint32_t below = 0;
  SixteenSurfaces::each(asked, [&](std::size_t i) {
    if (dot(origins.horizon[i], directions[i]) < 0) {
      below |= 1u << i;
    } else {
      sixteen.set(i, origins.position[i], static_cast<Vec3d>(directions[i]) * far);
    }
  });
  const std::uint32_t above = asked & ~below, visible = above & ~rays_.blocked_among(sixteen, above, Casters::all);
  clear_.tint(rays_, sixteen, visible, light);
  return visible;
}

EnvironmentShadows::VisibleFractions EnvironmentShadows::diffuse_fractions(const Surfaces& surfaces, const Origins& origins,
                                                                           std::uint32_t asked, int sample) const {
  std::array<Vec3f, kLanes> normal{};
  SixteenSurfaces::each(asked, [&](std::size_t i) { normal[i] = surfaces.surface[i].normal; });
  struct Sums {
    std::array<Vec3f, kLanes> light{}, visible{};
  };
  std::array<Sums, 2> halves;
  const std::vector<Direction>& set = sets_[static_cast<std::size_t>(sample) % sets_.size()];
  for (std::size_t d = 0; d < set.size(); ++d) {
    const Direction& direction = set[d];
    std::uint32_t above = 0;
    std::array<float, kLanes> cosine;
    for (std::size_t i = 0; i < kLanes; ++i) {
      cosine[i] = dot(normal[i], direction.to);
      above |= static_cast<std::uint32_t>(cosine[i] > 0) << i;
    }
    above &= asked;
    if (above == 0) continue;
    std::array<Vec3f, kLanes> directions;
    directions.fill(direction.to);
    Sums& half = halves[d % 2];
    Colors light;
    SixteenSurfaces::each(above, [&](std::size_t i) { half.light[i] += light[i] = direction.light * cosine[i]; });
    SixteenSurfaces::each(lets_pass(origins, directions, above, light), [&](std::size_t i) { half.visible[i] += light[i]; });
  }
  VisibleFractions result;
  const auto ratio = [](float part, float whole) { return whole > 0 ? part / whole : 0.0f; };
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Vec3f light = halves[0].light[i] + halves[1].light[i], visible = halves[0].visible[i] + halves[1].visible[i];
    result.all[i] = {ratio(visible.x, light.x), ratio(visible.y, light.y), ratio(visible.z, light.z)};
    const auto of_half = [&](const Sums& half) {
      return ratio(static_cast<float>(luminance(static_cast<Vec3d>(half.visible[i]))),
                   static_cast<float>(luminance(static_cast<Vec3d>(half.light[i]))));
    };
    result.half_difference[i] = 0.5f * (of_half(halves[0]) - of_half(halves[1]));
  }
  return result;
}

// Adds the visible cones of a lobe of each surface.
void EnvironmentShadows::add_visible(const std::array<LobeCones, kLanes>& cones, const Origins& origins, std::array<Vec3f, kLanes>& result,
                                     std::array<double, kLanes>& half_difference) const {
  std::array<std::array<double, 2>, kLanes> light{}, visible{};  // luminance, by half
  for (std::size_t c = 0; c < LobeCones::kMost; ++c) {
    std::array<Vec3f, kLanes> axes;
    Colors reflected;
    std::uint32_t asked = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (c >= cones[i].count) continue;
      axes[i] = cones[i].cones[c].axis;
      reflected[i] = cones[i].cones[c].reflected;
      asked |= 1u << i;
      light[i][c % 2] += luminance(static_cast<Vec3d>(reflected[i]));
    }
    if (asked == 0) break;
    SixteenSurfaces::each(lets_pass(origins, axes, asked, reflected), [&](std::size_t i) {
      result[i] += reflected[i];
      visible[i][c % 2] += luminance(static_cast<Vec3d>(reflected[i]));
    });
  }
  for (std::size_t i = 0; i < kLanes; ++i)
    if (light[i][0] > 0 && light[i][1] > 0)
      half_difference[i] += 0.5 * (light[i][0] + light[i][1]) * (visible[i][0] / light[i][0] - visible[i][1] / light[i][1]);
}

std::array<Vec3f, EnvironmentShadows::kLanes> EnvironmentShadows::reflected(const Surfaces& surfaces, int sample,
                                                                            HalvesOfRays& halves) const {
  Origins origins{};
  std::array<std::vector<SurfaceLobe>, kLanes> lobes;
  std::size_t most_lobes = 0;
  std::uint32_t diffuse = 0;
  SixteenSurfaces::each(surfaces.lit, [&](std::size_t i) {
    const Surface& surface = surfaces.surface[i];
    origins.position[i] = rays_.off_surface(static_cast<Vec3d>(surface.position), static_cast<Vec3d>(surface.geometric_normal));
    if (terminator_ == Terminator::strict) origins.horizon[i] = surface.geometric_normal;
    lobes[i] = lobes_of(surface, light_.fitted());
    most_lobes = std::max(most_lobes, lobes[i].size());
    for (const SurfaceLobe& lobe : lobes[i]) diffuse |= static_cast<std::uint32_t>(lobe.material.brdf == Brdf::lambert) << i;
  });
  std::array<Vec3f, kLanes> result{};
  std::array<double, kLanes> half_difference{};
  if (diffuse != 0) {
    const VisibleFractions fractions = diffuse_fractions(surfaces, origins, diffuse, sample);
    SixteenSurfaces::each(diffuse, [&](std::size_t i) {
      for (const SurfaceLobe& lobe : lobes[i]) {
        if (lobe.material.brdf != Brdf::lambert) continue;
        const Vec3f whole = light_.diffuse(lobe, surfaces.view[i]);
        result[i] += whole * fractions.all[i];
        half_difference[i] += luminance(static_cast<Vec3d>(whole)) * static_cast<double>(fractions.half_difference[i]);
      }
    });
  }
  for (std::size_t k = 0; k < most_lobes; ++k) {
    std::array<LobeCones, kLanes> cones{};
    SixteenSurfaces::each(surfaces.lit, [&](std::size_t i) {
      if (k < lobes[i].size() && lobes[i][k].material.brdf != Brdf::lambert)
        cones[i] = light_.cones_of(lobes[i][k], surfaces.surface[i], surfaces.view[i], LobeCones::kMost,
                                   static_cast<double>(sample % kSets) / kSets);
    });
    add_visible(cones, origins, result, half_difference);
  }
  SixteenSurfaces::each(surfaces.lit, [&](std::size_t i) { halves.add(half_difference[i], luminance(static_cast<Vec3d>(result[i]))); });
  return result;
}

}  // namespace steradian::environment
