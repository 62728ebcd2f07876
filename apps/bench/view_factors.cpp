// viewfactor/box/N: all pairs of about N elements inside a unit cube whose faces are turned; viewfactor/town/N: those of N x N houses and
// their streets, which hide each other, at eps 1e-4. An item is a pair. On all threads.
#include "steradian/view_factors.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "benches.h"
#include "support/exchange_faces.h"

namespace steradian::bench {

namespace {

void add_matrix(BenchList& list, const std::string& name, std::vector<ViewFactorFace> (*make_faces)(int), int size, double eps) {
  list.add(name, [=](const BenchOptions&) {
    const auto faces = std::make_shared<std::vector<ViewFactorFace>>(make_faces(size));
    ViewFactorOptions options;
    options.eps = eps;
    Bench bench;
    bench.name = name;
    bench.items = faces->size() * (faces->size() - 1) / 2;
    bench.one_core = false;
    bench.body = [faces, options] { keep(view_factors(*faces, options)); };
    return bench;
  });
}

}  // namespace

void add_view_factors(BenchList& list) {
  for (const int elements : {100, 1000, 2400, 10000}) {
    const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(elements / 6.0))));
    add_matrix(list, "viewfactor/box/" + std::to_string(elements), exchange::turned_cube, side, ViewFactorOptions{}.eps);
  }
  for (const int houses : {3, 6}) add_matrix(list, "viewfactor/town/" + std::to_string(houses), exchange::town, houses, 1e-4);
}

}  // namespace steradian::bench
