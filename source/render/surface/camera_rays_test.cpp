#include "render/surface/camera_rays.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "render/surface/ray_scene.h"
#include "steradian/scene.h"

namespace steradian::camera_rays_test {
namespace {

// Each of `count` columns and rows holds one place, in its middle. Their mean is therefore the pixel's centre, except for float roundings.
TEST(CameraRays, PlacesInAPixelAreEvenAndDoNotMoveThePicture) {
  for (const int count : {1, 2, 3, 4, 7, 16, 64, 100}) {
    double x = 0, y = 0;
    std::set<int> columns, rows;
    for (int i = 0; i < count; ++i) {
      const PixelPlace p = pixel_place(i, count);
      x += static_cast<double>(p.x) / count;
      y += static_cast<double>(p.y) / count;
      columns.insert(static_cast<int>(p.x * static_cast<float>(count)));
      rows.insert(static_cast<int>(p.y * static_cast<float>(count)));
    }
    EXPECT_NEAR(x, 0.5, 1e-7) << count;
    EXPECT_NEAR(y, 0.5, 1e-7) << count;
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
  }
}

// Every quarter of the pixel has its number of places, to one and a half.
TEST(CameraRays, PlacesInAPixelFillItsQuarters) {
  for (int count = 4; count <= 64; ++count) {
    int quarters[4] = {};
    for (int i = 0; i < count; ++i) {
      const PixelPlace p = pixel_place(i, count);
      ++quarters[(p.x < 0.5f ? 0 : 1) + (p.y < 0.5f ? 0 : 2)];
    }
    for (const int n : quarters) EXPECT_NEAR(n, count / 4.0, 1.5) << count;
  }
}

// A floor that every ray meets; only some lanes hold a ray. Before AVX-512 Embree ignores the mask of lanes, so that tiles at a picture's
// edge got surfaces beyond it.
TEST(RayScene, LanesWithoutARayMeetNothing) {
  Scene scene;
  scene.materials.emplace_back();
  Mesh floor;
  floor.positions = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
  floor.indices = {0, 2, 1, 0, 3, 2};
  scene.meshes = {floor};
  const RayScene rays(scene);
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[16];
  constexpr float kFar = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < 16; ++i) {
    valid[i] = i % 3 == 0 ? 0 : -1;
    packet.ray.org_x[i] = packet.ray.org_z[i] = 0.1f * static_cast<float>(i);
    packet.ray.org_y[i] = 1;
    packet.ray.dir_x[i] = packet.ray.dir_z[i] = packet.ray.tnear[i] = packet.ray.time[i] = 0;
    packet.ray.dir_y[i] = -1;
    packet.ray.tfar[i] = kFar;
    packet.ray.mask[i] = 1;  // seen by the camera
    packet.ray.id[i] = packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rays.intersect(valid, packet);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(packet.hit.geomID[i], valid[i] == 0 ? RTC_INVALID_GEOMETRY_ID : 0u) << i;
    EXPECT_EQ(packet.ray.tfar[i], valid[i] == 0 ? kFar : 1.0f) << i;
  }

  // And lanes that ask for no shadow may hold any numbers.
  RayScene::Sixteen sixteen;
  std::fill_n(&sixteen.rays.org_x[0], sizeof sixteen.rays / sizeof(float), std::numeric_limits<float>::quiet_NaN());
  sixteen.set(5, {0, 1, 0}, {0, 1, 0});
  sixteen.set(6, {0, 1, 0}, {0, -2, 0});
  EXPECT_EQ(rays.blocked_among(sixteen, 1u << 5 | 1u << 6), 1u << 6);
}

}  // namespace
}  // namespace steradian::camera_rays_test
