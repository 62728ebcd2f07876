#include <cstdio>
#include <cstdlib>

#include "ranks/ranks.h"

namespace steradian::app {

bool is_rank() {
  const char* count = std::getenv("OMPI_COMM_WORLD_SIZE");
  return count != nullptr && std::atoi(count) > 1;
}

int run_with_ranks(int&, char**&, const std::vector<std::string>&) {
  const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
  if (rank == nullptr || std::atoi(rank) == 0)
    std::fprintf(stderr,
                 "steradian: this build has no MPI, and every rank would do all the work (configure with -DSTERADIAN_MPI=ON; Debian: "
                 "libopenmpi-dev, openmpi-bin; or use --part and steradian merge)\n");
  return 2;
}

}  // namespace steradian::app
