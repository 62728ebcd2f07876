#include "render/surface/camera_rays.h"

#include <cmath>
#include <numbers>
#include <xsimd/xsimd.hpp>

#include "steradian/error.h"

namespace steradian {

PixelPlace pixel_place(int index, int count) {
  const auto turn = [](int i) {
    const double x = (i + 1) / std::numbers::phi;
    return x - std::floor(x);
  };
  const double own = turn(index);
  int row = 0;  // number of the others with a smaller turn
  for (int i = 0; i < count; ++i) row += turn(i) < own ? 1 : 0;
  const auto middle = [count](int cell) { return static_cast<float>((cell + 0.5) / count); };
  return {middle(index), middle(row)};
}

PixelSteps steps_about(Vec3f direction, float pixel) {
  const Frame frame = Frame::from_normal(static_cast<Vec3d>(direction));
  return {static_cast<Vec3f>(frame.x) * pixel, static_cast<Vec3f>(frame.y) * pixel, direction};
}

CameraRays::CameraRays(const Camera& camera, int width, int height) {
  const double h = std::tan(camera.yfov / 2), w = h * width / height;
  origin_ = static_cast<Vec3f>(camera.position);
  corner_ = static_cast<Vec3f>(-camera.z - camera.x * w + camera.y * h);
  right_ = static_cast<Vec3f>(camera.x * (2 * w / width));
  down_ = static_cast<Vec3f>(camera.y * (-2 * h / height));
  forward_ = static_cast<Vec3f>(-camera.z);
}

PixelSteps CameraRays::steps(int samples) const {
  const float share = 1 / std::sqrt(static_cast<float>(samples));
  return {right_ * share, down_ * share, forward_};
}

void CameraRays::block_directions(float x, float y, float (&dx)[16], float (&dy)[16], float (&dz)[16]) const {
  using Row = xsimd::batch<float, xsimd::sse2>;  // available on every x86-64; the order of operations is direction()'s
  static_assert(Row::size == 4);
  constexpr float kSteps[] = {0, 1, 2, 3};
  const Row across = Row(x) + Row::load_unaligned(kSteps);
  for (unsigned row = 0; row < 4; ++row) {
    const Row down(y + static_cast<float>(row));
    const Row wx = Row(corner_.x) + Row(right_.x) * across + Row(down_.x) * down;
    const Row wy = Row(corner_.y) + Row(right_.y) * across + Row(down_.y) * down;
    const Row wz = Row(corner_.z) + Row(right_.z) * across + Row(down_.z) * down;
    const Row length = xsimd::sqrt(wx * wx + wy * wy + wz * wz);
    (wx / length).store_unaligned(dx + 4 * row);
    (wy / length).store_unaligned(dy + 4 * row);
    (wz / length).store_unaligned(dz + 4 * row);
  }
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
