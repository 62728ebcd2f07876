// accuracy FILE: measures the values of docs/measured/accuracy.md, and writes the page.
#include <cstdio>
#include <fstream>
#include <sstream>

#include "sections.h"

using namespace steradian::accuracy;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: accuracy FILE\n");
    return 2;
  }
  std::ostringstream page;
  page << "# Accuracy\n\nWritten by `./dev accuracy`. Every number was measured by that command; nothing here is typed by hand.\n";
  write_functions(page);
  write_targets(page);
  write_lambert(page);
  write_diffuse_below(page);
  write_phong(page);
  write_ggx(page);
  write_point_lights(page);
  write_half_vector(page);
  write_sheen(page);
  write_lights(page);
  write_limits(page);
  std::ofstream file(argv[1], std::ios::binary);
  file << page.str();
  file.close();
  if (!file) std::fprintf(stderr, "accuracy: cannot write %s\n", argv[1]);
  return file ? 0 : 1;
}
