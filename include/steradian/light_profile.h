// LightProfile: luminous intensity by direction, as measured by a goniophotometer. Read from IES LM-63 and EULUMDAT files.
//
//   const LightProfile lamp = read_light_profile("lamp.ies");
//   double candela = intensity(lamp, {0, 0, 1});   // straight ahead
//   double lumen = luminous_flux(lamp);
//
// In its frame, z is the direction in which the lamp aims (the photometric zero: straight down for a ceiling lamp). x is the plane of
// horizontal angle 0, y that of 90 degrees. In glTF (EXT_lights_ies) these are the node's -z, x and y: seen from behind the lamp, angles
// run counter-clockwise.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "steradian/limits.h"
#include "steradian/vector.h"

namespace steradian {

struct LightProfile {
  // c: vertical angles from z (0 to 180 degrees), horizontal ones about it. b: the vertical angle turns about the axis -y, from z towards
  // x (-90 to 90); the horizontal one leads from there towards -y (-90 to 90).
  enum class Type { c, b };

  Type type = Type::c;
  std::vector<double> vertical;    // degrees, rising; nothing shines beyond them
  std::vector<double> horizontal;  // degrees, rising, symmetries written out: for c 0 to 360, or one value for all around
  std::vector<double> candela;     // by horizontal, then vertical angle
  double rated_lumens = 0;         // lumens of its lamps, as the file states; 0: not stated
};

// Candela in a direction, which need not be unit. It is linear in both angles between the measured ones, as usual in the field. 0 for the
// zero vector.
double intensity(const LightProfile& profile, Vec3d direction);

// Lumens over all directions: the integral of `intensity`, exactly.
double luminous_flux(const LightProfile& profile);

// Orientation of a profile's frame in space.
struct ProfileAxes {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, aim{0, 0, -1};

  bool operator==(const ProfileAxes&) const = default;
};
// aim: need not be unit, must not be zero. towards_x: direction to which x is nearest; any x if it is along aim.
ProfileAxes profile_axes(Vec3d aim, Vec3d towards_x);

// Reads IES LM-63 of 1986 to 2019 (.ies), types B and C, and EULUMDAT (.ldt); the contents decide which. Intensities are those of the lamp
// as sold: times the multiplier, the ballast's factors, or the lumens of the lamps. TILT, sizes and keywords are ignored. Throws Error with
// the file, its line, and the problem.
LightProfile read_light_profile(const std::string& path, const Limits& limits = {});
// name: name of the file in messages.
LightProfile read_light_profile_from_memory(std::string_view bytes, const std::string& name, const Limits& limits = {});

}  // namespace steradian
