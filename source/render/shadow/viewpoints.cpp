#include "render/shadow/viewpoints.h"

namespace steradian {
namespace {

using shadow::Viewpoint;

Vec3d double_of(const TileVector& v, std::size_t i) { return static_cast<Vec3d>(Vec3f{v.x[i], v.y[i], v.z[i]}); }

}  // namespace

TilePoints points_for_shadows(const SurfaceTile& tile, Terminator terminator) {
  TilePoints result;
  result.points.resize(kTilePixels);
  std::vector<Vec3d> positions(kTilePixels);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Vec3d position = double_of(tile.position, i), geometric = double_of(tile.geometric_normal, i),
                normal = normalized(double_of(tile.normal, i));
    Viewpoint& at = result.points[i];
    positions[i] = at.position = position + geometric * shadow::offset_from_surface(position);
    at.normal = normal;
    at.seed = tile.seed * kTilePixels + i;
    if (terminator == Terminator::strict && length(normal - geometric) > 1e-5) at.geometric_normal = geometric;
  }
  result.groups = groups_of(tile, positions);
  return result;
}

}  // namespace steradian
