// viewfactor/box/N: all pairs of about N elements inside a unit cube whose faces are turned; an item is a pair. On all threads.
#include "steradian/view_factors.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "benches.h"
#include "support/exchange_faces.h"

namespace steradian::bench {

void add_view_factors(BenchList& list) {
  for (const int elements : {100, 1000, 2400, 10000}) {
    const std::string name = "viewfactor/box/" + std::to_string(elements);
    list.add(name, [=](const BenchOptions&) {
      const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(elements / 6.0))));
      const auto faces = std::make_shared<std::vector<ViewFactorFace>>(exchange::turned_cube(side));
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
