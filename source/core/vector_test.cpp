#include "steradian/vector.h"

#include <gtest/gtest.h>

#include "support/random_configurations.h"

namespace steradian::vector_test {

// A tangent along an oblique normal leaves only rounding; a frame must not be built from that.
TEST(Vector, FramesAreOrthonormalForEveryTangent) {
  reference::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d n = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const Vec3d any{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    for (const double aside : {0.0, 1e-17, 1e-15, 1e-12, 1e-8, 1e-3, 1.0})
      for (const double scale : {1.0, -1e-6, 1e9}) {
        const Frame frame = Frame::from_normal_and_tangent(n, (n + any * aside) * scale);
        EXPECT_NEAR(dot(frame.x, frame.z), 0, 1e-9);
        EXPECT_NEAR(dot(frame.y, frame.z), 0, 1e-9);
        EXPECT_NEAR(length(frame.x), 1, 1e-9);
        EXPECT_NEAR(length(frame.y), 1, 1e-9);
      }
  }
}

}  // namespace steradian::vector_test
