// viewfactor/box/N: all pairs of about N elements inside a unit cube whose faces are turned; an item is a pair. On all threads.
#include "steradian/view_factors.h"

#include <cmath>
#include <memory>
#include <string>

#include "benches.h"

namespace steradian::bench {
namespace {

std::vector<ViewFactorFace> turned_cube(int elements) {
  const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(elements / 6.0))));
  const Vec3d axis = normalized(Vec3d{1, 2, 3}), x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  std::vector<ViewFactorFace> faces;
  const auto add = [&](Vec3d corner, Vec3d a, Vec3d b) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int s, int t) {
          return rotated(corner + a * (static_cast<double>(s) / n) + b * (static_cast<double>(t) / n), axis, 0.7);
        };
        faces.push_back({"", {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
  };
  add({}, x, y);
  add(z, y, x);
  add({}, y, z);
  add(x, z, y);
  add({}, z, x);
  add(y, x, z);
  return faces;
}

}  // namespace

void add_view_factors(BenchList& list) {
  for (const int elements : {100, 1000, 2400, 10000}) {
    const std::string name = "viewfactor/box/" + std::to_string(elements);
    list.add(name, [=](const BenchOptions&) {
      const auto faces = std::make_shared<std::vector<ViewFactorFace>>(turned_cube(elements));
      Bench bench;
      bench.name = name;
      bench.items = faces->size() * (faces->size() - 1) / 2;
      bench.one_core = false;
      bench.body = [faces] { keep(view_factors(*faces)); };
      return bench;
    });
  }
}

}  // namespace steradian::bench
