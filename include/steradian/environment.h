// Environment: light from all around, as a map of directions, for scenes.
//
// The map is equirectangular: its upper edge lies above (+y), the middle of its width towards -z, where a camera without a turn looks,
// and what is right of the middle towards +x.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "steradian/limits.h"
#include "steradian/picture.h"
#include "steradian/vector.h"

namespace steradian {

// What a Lambertian surface gets where a file gives it: coefficients of the real spherical harmonics up to degree 2, in the order
// (0,0) (1,-1) (1,0) (1,1) (2,-2) ... (2,2), about axes of their own. A sum over the harmonics is the irradiance.
struct IrradianceCoefficients {
  std::array<Vec3d, 9> rgb;
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3d at(Vec3d normal) const;
};

struct Environment {
  std::string name;  // of the file, or "white", "sky"
  Picture map;       // radiance, finite and not negative
  std::optional<IrradianceCoefficients> irradiance;
  std::size_t repaired = 0;  // values that were negative, infinite or not numbers: now 0, or the largest of the others
};

// white: radiance 1 from everywhere. sky: a clear sky without its sun over a ground of albedo 0.2, the sun's side where --light sun
// shines from. Else a file that read_picture takes; throws Error as that does, and for a map without a finite value.
Environment load_environment(const std::string& name, const Limits& limits = {});
Environment white_environment();
Environment clear_sky();

// A place in the map, both from 0 to 1, and back: the unit direction.
struct MapPlace {
  double u = 0, v = 0;
};
MapPlace place_of(Vec3d direction);
Vec3d direction_of(MapPlace place);

// Linear between the centres of the four texels about the direction.
Vec3f radiance_from(const Picture& map, Vec3d direction);

}  // namespace steradian
