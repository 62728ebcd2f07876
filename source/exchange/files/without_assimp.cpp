#include "exchange/files/mesh_files.h"
#include "steradian/error.h"

namespace steradian::exchange {

std::vector<PolygonMesh> read_mesh_file(const std::string& path, Budget&) {
  throw UsageError(path, "this build reads no OBJ, STL and PLY files",
                   "configure with -DSTERADIAN_ASSIMP=ON (Debian: libassimp-dev), or export the scene as glTF");
}

}  // namespace steradian::exchange
