#include "render/cpu/camera_rays.h"

#include <cmath>

#include "steradian/error.h"

namespace steradian {

PixelPlace pixel_place(int index, int count) {
  if (count == 1) return {0.5f, 0.5f};
  const double plastic = 1.32471795724474602596;
  const auto fraction = [](double x) { return static_cast<float>(x - std::floor(x)); };
  return {fraction(0.5 + index / plastic), fraction(0.5 + index / (plastic * plastic))};
}

CameraRays::CameraRays(const Camera& camera, int width, int height) {
  const double h = std::tan(camera.yfov / 2), w = h * width / height;
  origin_ = static_cast<Vec3f>(camera.position);
  corner_ = static_cast<Vec3f>(-camera.z - camera.x * w + camera.y * h);
  right_ = static_cast<Vec3f>(camera.x * (2 * w / width));
  down_ = static_cast<Vec3f>(camera.y * (-2 * h / height));
}

const Camera& find_camera(const Scene& scene, const std::string& name) {
  std::string names;
  for (const Camera& camera : scene.cameras) {
    if (name.empty() || camera.name == name) return camera;
    names += (names.empty() ? "" : ", ") + camera.name;
  }
  throw Error("--camera", "no camera is named '" + name + "'", "there are: " + names);
}

}  // namespace steradian
