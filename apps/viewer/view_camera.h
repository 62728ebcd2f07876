// The camera of a window: orbits, flies and pans; also converts between points in space and pixels.
#pragma once

#include <optional>

#include "document/document.h"
#include "scene/gltf/gltf_nodes.h"
#include "steradian/scene.h"
#include "steradian/vector2.h"

namespace steradian::view {

struct Ray {
  Vec3d origin, direction;  // unit
};

class ViewCamera {
 public:
  // Starts as `camera`, and orbits the point `distance` in front of it.
  ViewCamera(const Camera& camera, double distance) : camera_(camera), distance_(distance) {}

  // Numbers of a drag are fractions of the picture's height, right and down positive.
  void orbit(double right, double down);              // about the orbited point; up stays up
  void pan(double right, double down);                // the orbited point follows the pointer
  void dolly(double steps);                           // one step of a wheel: nearer by a tenth
  void look(double right, double down);               // turns in place
  void fly(double right, double up, double forward);  // in fractions of the distance to the orbited point
  void look_at(Vec3d target);                         // orbits about the target from now on, without moving

  Vec3d target() const { return camera_.position - camera_.z * distance_; }
  double distance() const { return distance_; }
  const Camera& camera() const { return camera_; }

 private:
  void turn(double yaw, double pitch);

  Camera camera_;
  double distance_;
};

// The ray through a place of the picture, in pixels from its upper left corner; a pixel's middle is at .5.
Ray ray_through(const Camera& camera, Vec2d pixel, double width, double height);
// The pixel at which a point appears; empty if it lies behind the camera.
std::optional<Vec2d> project(const Camera& camera, Vec3d point, double width, double height);

// Adds the camera as the file's first, so that every renderer of the file shows the same picture. Throws a std::exception for a file that
// load_scene would refuse.
scene::GltfFile with_camera(scene::GltfFile file, const Camera& camera);
// The camera as it is read back from a file, if its axes are orthonormal only to rounding. It makes both cameras equal to the bit.
Camera as_read(const Camera& camera);

}  // namespace steradian::view
