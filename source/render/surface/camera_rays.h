// Primary rays: their starting places within a pixel, and their directions.
#pragma once

#include <cmath>

#include "steradian/scene.h"

namespace steradian {

// Place of sample `index` of `count` within the pixel, in (0, 1)^2. Each of `count` columns and each of as many rows holds one place. Their
// order is that of the fractional parts of the golden ratio's multiples. The places are even for any count, and their mean is the pixel's
// centre, so the picture does not move. All pixels use the same places: methods and references see the same points.
struct PixelPlace {
  float x, y;
};
PixelPlace pixel_place(int index, int count);

// Steps from one pixel to the next, for directions that end on the plane at distance 1 before the camera.
struct PixelSteps {
  Vec3f right, down, forward;  // forward: unit
};

// Size of a pixel at distance 1, and the steps between pixels of that size about another direction.
inline float size_of_pixel(const PixelSteps& steps) { return std::sqrt(length(steps.right) * length(steps.down)); }
PixelSteps steps_about(Vec3f direction, float pixel);

class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);
  Vec3f origin() const { return origin_; }
  // Unit direction through a place in the picture, in pixels from its upper left corner.
  Vec3f direction(float x, float y) const { return normalized(corner_ + right_ * x + down_ * y); }
  // Steps between the parts of a pixel that one sample each stands for.
  PixelSteps steps(int samples) const;
  // Directions through the 4 x 4 places at distances 0 to 3 from (x, y), row by row.
  void block_directions(float x, float y, float (&dx)[16], float (&dy)[16], float (&dz)[16]) const;

 private:
  Vec3f origin_, corner_, right_, down_, forward_;
};

// The camera of that name; the first one for an empty name. Throws an Error that lists the scene's cameras.
const Camera& find_camera(const Scene& scene, const std::string& name);

}  // namespace steradian
