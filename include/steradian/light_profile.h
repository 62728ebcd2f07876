// LightProfile: luminous intensity by direction, as a goniophotometer measured it. Read from IES LM-63 and EULUMDAT files.
//
//   const LightProfile lamp = read_light_profile("lamp.ies");
//   double candela = intensity(lamp, {0, 0, 1});   // straight ahead
//   double lumen = luminous_flux(lamp);
//
// Frame: z is where the lamp aims (the photometric zero: straight down of a ceiling lamp), x the plane of horizontal angle 0, y that
// of 90 degrees. In glTF (EXT_lights_ies) these are the node's -z, x and y: seen from behind the lamp, angles run counter-clockwise.
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
  std::vector<double> horizontal;  // degrees, rising, symmetries written out: of c 0 to 360, or one for all around
  std::vector<double> candela;     // by horizontal, then vertical angle
  double rated_lumens = 0;         // of the lamps in it, as the file says; 0: it says none
};

// Candela in a direction, which need not be unit: linear in both angles between those measured, as the field does. 0 for no direction.
double intensity(const LightProfile& profile, Vec3d direction);

// Lumens over all directions: the integral of `intensity`, exactly.
double luminous_flux(const LightProfile& profile);

// Where a profile's frame stands in space.
struct ProfileAxes {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, aim{0, 0, -1};
};
// aim: need not be unit, must not be zero. towards_x: what x is nearest to; where it is along aim, any.
ProfileAxes profile_axes(Vec3d aim, Vec3d towards_x);

// IES LM-63 of 1986 to 2019 (.ies), types B and C, and EULUMDAT (.ldt); which, is told from the contents. Intensities are those of the
// lamp as sold: times the multiplier, the ballast's factors, or the lumens of the lamps. TILT, sizes and keywords are passed over.
// Throws Error with the file, its line, and what is wrong.
LightProfile read_light_profile(const std::string& path, const Limits& limits = {});
// name: for messages.
LightProfile read_light_profile_from_memory(std::string_view bytes, const std::string& name, const Limits& limits = {});

}  // namespace steradian
