// Meaning of the numbers of other programs' lights, and conversions between power, radiance and exposure. docs/lights.md contains the table
// with its sources.
//
//   double radiance = 100 * light_factor(LightSystem::blender, EmitterKind::area, 0.25);   // Blender: 100 W on 0.5 m by 0.5 m
//
// The units here are: radiance of lights with an extent [W/(m2 sr) or nits]; intensity of points and spots [W/sr or candela]; irradiance
// across the direction of directional lights [W/m2 or lux]. Only lumens_from_watts turns watts into lumens.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "steradian/error.h"

namespace steradian {

enum class LightSystem { gltf, blender, usd, three, mitsuba, pbrt };

// area: flat. sphere: in Blender, a point lamp with a radius.
enum class EmitterKind { area, sphere, point, spot, directional };

inline std::optional<LightSystem> light_system_of(std::string_view name) {
  constexpr std::string_view kNames[] = {"gltf", "blender", "usd", "three", "mitsuba", "pbrt"};
  for (int i = 0; i < 6; ++i)
    if (name == kNames[i]) return static_cast<LightSystem>(i);
  return {};
}
inline std::optional<EmitterKind> emitter_kind_of(std::string_view name) {
  constexpr std::string_view kNames[] = {"area", "sphere", "point", "spot", "directional"};
  for (int i = 0; i < 5; ++i)
    if (name == kNames[i]) return static_cast<EmitterKind>(i);
  return {};
}

// True if a system's numbers are photometric. Possible units are watts or candela, lumens or radiance.
inline bool is_photometric(LightSystem system) {
  return system == LightSystem::gltf || system == LightSystem::usd || system == LightSystem::three;
}

// The number here for a number of 1 there; it is linear in that number. area: of the light's surface [m2], 4 pi r^2 for a sphere; only
// Blender's numbers depend on it. For USD, the number is intensity times 2^exposure; with inputs:normalize on, divide by the area as well.
// A DistantLight's number is then the same as here; for its default of off multiply by pi sin^2 of half its angle. Throws Error for a kind
// that the system lacks.
inline double light_factor(LightSystem system, EmitterKind kind, double area = 1) {
  const bool point_like = kind == EmitterKind::point || kind == EmitterKind::spot;
  if (system == LightSystem::usd && point_like)
    throw Error("kind", "USD has no points and spots", "they are small sphere and disk lights there");
  if (system == LightSystem::three && kind == EmitterKind::sphere) throw Error("kind", "three.js has no sphere lights");
  if (system != LightSystem::blender || kind == EmitterKind::directional) return 1;
  if (point_like) return 1 / (4 * std::numbers::pi);
  if (!(area > 0)) throw Error("area", "must be above 0");
  return kind == EmitterKind::area ? 1 / (4 * area) : 1 / (std::numbers::pi * area);
}

// Radiance and power of a light that sends the same radiance to all directions of one side, as all lights here do. power: all that it sends
// [W or lumens].
inline double radiance_from_power(double power, double area) { return power / (std::numbers::pi * area); }
inline double power_from_radiance(double radiance, double area) { return radiance * std::numbers::pi * area; }

// Intensity and power of a light that sends the same intensity to all directions.
inline double intensity_from_power(double power) { return power / (4 * std::numbers::pi); }
inline double power_from_intensity(double intensity) { return intensity * 4 * std::numbers::pi; }

// 683 lm/W is the definition of the lumen at 540 THz, and exporters assume it for light of any colour. White light of a lamp has 200 to
// 350.
inline double lumens_from_watts(double watts, double efficacy = 683) { return watts * efficacy; }
inline double watts_from_lumens(double lumens, double efficacy = 683) { return lumens / efficacy; }

// The exposure value at ISO 100 of a camera, and the stops (`render --exposure`) that show its luminance of saturation, 1.2 times 2^EV
// nits, as 1. Source: ISO 12232:2006, saturation-based speed with its reserve of half a stop: 78 / (100 * 0.65) = 1.2.
inline double ev100_of_camera(double f_number, double seconds, double iso) { return std::log2(f_number * f_number / seconds * 100 / iso); }
inline double stops_from_ev100(double ev100) { return -std::log2(1.2) - ev100; }

}  // namespace steradian
