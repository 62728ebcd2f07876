// SurfaceSampler: directions to the true surface of a disk, an ellipsoid or a tube, with their density. No polygon stands for the light.
#pragma once

#include <optional>

#include "shapes/body.h"
#include "steradian/area_light.h"

namespace steradian::reference {

class SurfaceSampler {
 public:
  // A disk, an ellipsoid or a tube as a point sees it.
  SurfaceSampler(const AreaLight& light, Vec3d from);

  // density: of the direction, per solid angle; 0: the direction misses the light, or meets a side that is dark.
  struct Place {
    Vec3d direction;
    double distance = 0, density = 0;
  };
  // The place of two uniform numbers. It may have no density: half of a tube's surface faces away.
  Place sample(double u, double v) const;
  // The place in a unit direction.
  Place towards(Vec3d direction) const;

 private:
  Place at(Vec3d place, Vec3d normal, double area) const;  // uniform on a surface
  Place on_ellipsoid(Vec3d unit) const;

  const AreaLight& light_;
  Vec3d from_;
  std::optional<Body> body_;
  bool sees_ = false;
  // In the space in which an ellipsoid is the unit sphere: the point, the frame towards the center and 1 - cosine of its cone.
  Vec3d unit_from_;
  Frame to_center_;
  double cap_ = 0, determinant_ = 0;
};

}  // namespace steradian::reference
