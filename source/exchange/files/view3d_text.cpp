#include "exchange/files/view3d_text.h"

#include <algorithm>
#include <cstdio>

#include "core/files.h"

namespace steradian::exchange {
namespace {

// View3D pads its first line to this length.
constexpr std::size_t kHeadLength = 30;

}  // namespace

void write_view3d_text(const std::string& path, const ViewFactors& factors, const std::string& version) {
  AtomicFile file(path);
  const std::size_t n = factors.size();
  // The program, its version, format 0 (text), no correction of an enclosure, no emissivities in the factors, the number of surfaces.
  std::string text = "steradian " + version + " 0 0 0 " + std::to_string(n);
  text.resize(std::max(text.size(), kHeadLength), ' ');
  text += '\n';
  const auto add = [&](double value, std::size_t column) {
    char number[32];
    text.append(number, static_cast<std::size_t>(std::snprintf(number, sizeof number, "%.17g", value)));
    text += column + 1 < n ? ' ' : '\n';
  };
  for (std::size_t i = 0; i < n; ++i) add(factors.areas[i], i);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) add(factors.between(i, j) / factors.areas[i], j);
    file.write(text);
    text.clear();
  }
  for (std::size_t i = 0; i < n; ++i) add(1, i);
  file.write(text);
  file.commit();
}

}  // namespace steradian::exchange
