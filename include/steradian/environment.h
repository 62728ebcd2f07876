// Environment: light from all directions, as a map, for scenes.
//
// The map is equirectangular. Its upper edge lies above (+y). The middle of its width points to -z, where an unrotated camera looks, and
// the part right of the middle to +x.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "steradian/limits.h"
#include "steradian/picture.h"
#include "steradian/vector.h"

namespace steradian {

// Irradiance of a Lambertian surface as a file gives it: coefficients of the real spherical harmonics up to degree 2. They are in the order
// (0,0) (1,-1) (1,0) (1,1) (2,-2) ... (2,2), about axes of their own. A sum over the harmonics is the irradiance.
struct IrradianceCoefficients {
  std::array<Vec3d, 9> rgb;
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3d at(Vec3d normal) const;
};

struct Environment {
  std::string name;  // name of the file, or "white", "sky"
  Picture map;       // radiance, finite and not negative
  std::optional<IrradianceCoefficients> irradiance;
  std::size_t repaired = 0;  // values that were negative, infinite or NaN: now 0, or the largest of the others
};

// white: radiance 1 from everywhere. sky: a clear sky without its sun over a ground of albedo 0.2; the sun's side is the direction from
// which --light sun shines. Other names are files that read_picture reads. Throws Error like read_picture, and for a map without a finite
// value.
Environment load_environment(const std::string& name, const Limits& limits = {});
Environment white_environment();
Environment clear_sky();

// A place in the map, both coordinates from 0 to 1. The functions convert it from and to the unit direction.
struct MapPlace {
  double u = 0, v = 0;
};
MapPlace place_of(Vec3d direction);
Vec3d direction_of(MapPlace place);

// Linear interpolation between the centres of the four texels about the direction.
Vec3f radiance_from(const Picture& map, Vec3d direction);

}  // namespace steradian
