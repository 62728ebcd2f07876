#include "exchange/files/mesh_files.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace steradian::exchange {

bool is_mesh_file(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return false;
  std::string ending = path.substr(dot);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".obj" || ending == ".stl" || ending == ".ply";
}

}  // namespace steradian::exchange
