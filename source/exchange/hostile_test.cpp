// Strange faces: an Error that names the face, or factors from 0 to 1 with errors.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "night.h"
#include "steradian/error.h"
#include "steradian/view_factors.h"

namespace steradian::exchange::hostile_test {
namespace {

class StrangeFaces {
 public:
  explicit StrangeFaces(unsigned seed) : random_(seed), scale_(std::pow(10.0, std::uniform_int_distribution<int>(-6, 6)(random_))) {}

  ViewFactorFace next(const std::vector<ViewFactorFace>& before) {
    const Vec3d o = point(), a = point(), b = point();
    switch (std::uniform_int_distribution<int>(0, 13)(random_)) {
      case 0: return {"", {o, o + a, o + b}};
      case 1: return {"thin", {o, o + a, o + a * 2.0 + b * 1e-9, o + b * 1e-9}};
      case 2: return {"line", {o, o + a, o + a * 2.0}};
      case 3: return {"point", {o, o, o, o}};
      case 4: return {"bent", {o, o + a, o + a + b + cross(a, b) / scale_ * 0.1, o + b}};
      case 5: return {"bow tie", {o, o + a, o + b, o + a + b}};
      case 6: return {"not a number", {o, o + a, {std::numeric_limits<double>::quiet_NaN(), 0, 0}}};
      case 7: return {"huge", {o * 1e6, (o + a) * 1e6, (o + b) * 1e6}};
      case 8: return {"tiny", {o, o + a * 1e-6, o + b * 1e-6}};
      case 9: return before.empty() ? ViewFactorFace{"empty", {}} : before.back();  // the same once more
      case 10: {                                                                    // on a corner of another one
        if (before.empty() || before.back().outline.empty()) return {"two corners", {o, o + a}};
        const Vec3d v = before.back().outline[0];
        return {"", {v, v + a, v + a + b, v + b}};
      }
      case 11: return {"turned", {o, o + b, o + a + b, o + a}};
      case 12: return {"hole", {o, o + a, o + a + b, o + b}, {{o + a * 0.2 + b * 0.2, o + a * 0.8 + b * 0.2, o + a * 0.5 + b * 0.8}}};
      default: return {"", {o, o + a, o + a + b, o + b}};
    }
  }

 private:
  // On a coarse grid half of the time, so that corners, edges and planes meet.
  Vec3d point() {
    std::uniform_real_distribution<double> place(-1, 1);
    const bool is_coarse = std::uniform_int_distribution<int>(0, 1)(random_) == 1;
    const auto number = [&] {
      const double x = place(random_);
      return (is_coarse ? std::round(x * 2) / 2 : x) * scale_;
    };
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }

  std::mt19937 random_;
  double scale_;
};

TEST(HostileFaces, GiveAnErrorOrFactorsFromZeroToOne) {
  int refused = 0, computed = 0;
  const auto scenes = test::by_day_or_night(300u, 1000u);
  for (unsigned seed = 0; seed < scenes; ++seed) {
    StrangeFaces strange(seed);
    std::vector<ViewFactorFace> faces;
    for (int i = 0; i < 5; ++i) faces.push_back(strange.next(faces));
    ViewFactorOptions options;
    options.eps = 1e-3;
    // A face that an error names is left out, until the rest is taken.
    while (true) {
      try {
        const ViewFactors f = view_factors(faces, options);
        ++computed;
        for (std::size_t i = 0; i < f.size(); ++i)
          for (std::size_t j = 0; j < i; ++j) {
            const double h = f.between(i, j), error = f.error_between(i, j), least = std::min(f.areas[i], f.areas[j]);
            EXPECT_TRUE(h >= 0 && h <= least) << "seed " << seed << ", " << i << ", " << j << ": " << h / least;
            EXPECT_TRUE(std::isfinite(error)) << seed;
          }
        break;
      } catch (const Error& e) {
        ++refused;
        ASSERT_EQ(e.place().compare(0, 5, "face "), 0) << e.what();
        const std::size_t number = std::stoul(e.place().substr(5));
        ASSERT_LT(number, faces.size());
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(number));
      }
    }
  }
  EXPECT_GT(refused, static_cast<int>(scenes / 2));
  EXPECT_EQ(computed, static_cast<int>(scenes));
}

}  // namespace
}  // namespace steradian::exchange::hostile_test
