// The scene of the published comparison: a Phong plane under an upright light, with a camera.
#pragma once

#include <string>
#include <vector>

#include "render/direct/lobe_packs.h"

namespace steradian::moment {

struct NamedLight {
  std::string name;  // "quad", "star", "triangle"
  PreparedPolygon light;
  std::size_t edges;
  std::vector<Vec3d> corners;
};

// The upright lights over the far half of the plane: a quad of 2 by 1.5, a star of five points, a skewed triangle.
std::vector<NamedLight> comparison_lights();

// The points of the plane y = 0 in the pixels of a picture. The camera is at (0, 1.6, 6), looks towards (0, 0.7, 0) and has a vertical
// field of view of 40 degrees. Pixels that show the sky are skipped.
struct PhongPlane {
  int width = 0, height = 0;
  std::vector<int> pixels;  // the pixel index of every point, row by row from the top
  std::size_t count = 0;    // number of points; the arrays are filled up to a multiple of 16 with copies of the last
  std::vector<float> x, y, z, nx, ny, nz, vx, vy, vz;

  Points points() const;
  ShadingPoint at(std::size_t i) const;  // the same numbers in double
};

PhongPlane make_phong_plane(int width, int height);

inline Material phong(double exponent) { return {.brdf = Brdf::phong, .exponent = exponent}; }

}  // namespace steradian::moment
