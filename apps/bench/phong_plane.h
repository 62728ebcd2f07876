// The scene of the published comparison: a Phong plane under an upright light, seen by a camera.
#pragma once

#include <string>
#include <vector>

#include "render/cpu/phong.h"

namespace steradian::moment {

struct NamedLight {
  std::string name;  // "quad", "star", "triangle"
  PreparedPolygon light;
  std::size_t edges;
  std::vector<Vec3d> corners;
};

// The upright lights over the far half of the plane: a quad of 2 by 1.5, a star of five points, a skewed triangle.
std::vector<NamedLight> comparison_lights();

// The points of the plane y = 0 that the pixels of a picture see from (0, 1.6, 6) towards (0, 0.7, 0), vertical field
// of view 40 degrees; pixels that see the sky are left out.
struct PhongPlane {
  int width = 0, height = 0;
  std::vector<int> pixels;  // index of the pixel, row by row from above, of every point
  std::size_t count = 0;    // points; the arrays are filled up to a multiple of 16 with copies of the last
  std::vector<float> x, y, z, nx, ny, nz, vx, vy, vz;

  Points points() const;
  ShadingPoint at(std::size_t i) const;  // the same numbers in double
};

PhongPlane make_phong_plane(int width, int height);

}  // namespace steradian::moment
