#include "core/simd.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "steradian/error.h"

namespace steradian::simd_test {

TEST(Simd, EnvironmentForcesAnAvailableSetAndRefusesOthers) {
  for (Simd simd : available_simd()) {
    setenv("STERADIAN_SIMD", name_of(simd), 1);
    EXPECT_EQ(active_simd(), simd);
  }
  setenv("STERADIAN_SIMD", "mmx", 1);
  EXPECT_THROW(active_simd(), Error);
  unsetenv("STERADIAN_SIMD");
  EXPECT_EQ(active_simd(), available_simd().back());
}

}  // namespace steradian::simd_test
