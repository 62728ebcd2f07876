// The camera of a window: orbits, flies and pans; and the way between points of space and pixels.
#pragma once

#include <optional>

#include "document.h"
#include "scene/gltf_nodes.h"
#include "steradian/scene.h"
#include "steradian/vector2.h"

namespace steradian::view {

struct Ray {
  Vec3d origin, direction;  // unit
};

class ViewCamera {
 public:
  // Looks as `camera` does, at what is `distance` before it.
  ViewCamera(const Camera& camera, double distance) : camera_(camera), distance_(distance) {}

  // Numbers of a drag are in shares of the picture's height, right and down positive.
  void orbit(double right, double down);              // about what is looked at; up stays up
  void pan(double right, double down);                // what is looked at follows the pointer
  void dolly(double steps);                           // a step of a wheel: nearer by a tenth
  void look(double right, double down);               // turns where it stands
  void fly(double right, double up, double forward);  // in shares of the distance to what is looked at
  void look_at(Vec3d target);                         // orbits about it from now on, from the same place

  Vec3d target() const { return camera_.position - camera_.z * distance_; }
  double distance() const { return distance_; }
  const Camera& camera() const { return camera_; }

 private:
  void turn(double yaw, double pitch);

  Camera camera_;
  double distance_;
};

// Through a place of the picture, pixels from its upper left corner; a pixel's middle is at .5.
Ray ray_through(const Camera& camera, Vec2d pixel, double width, double height);
// Where a point is seen; nothing where it lies behind the camera.
std::optional<Vec2d> project(const Camera& camera, Vec3d point, double width, double height);

// The camera as the file's first, so that whoever renders the file sees the same picture. Throws a std::exception for a file that
// load_scene would refuse.
scene::GltfFile with_camera(scene::GltfFile file, const Camera& camera);
// What a file says of a camera whose axes are orthonormal only to rounding, so that both are the same bits.
Camera as_read(const Camera& camera);

}  // namespace steradian::view
