#include "render/shadow/viewpoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/box.h"
#include "steradian/scene.h"

namespace steradian {
namespace {

// Fraction of the longest side of all members: a gap between neighbours of this width splits them.
constexpr double kGap = 0.35;

struct Member {
  std::uint32_t number;
  Box3d box;
};

// Splits members at gaps between their boxes along the longest side of all members.
void split(std::vector<Member>& members, std::vector<std::vector<std::uint32_t>>& result) {
  std::vector<std::pair<std::size_t, std::size_t>> ranges = {{0, members.size()}};
  while (!ranges.empty()) {
    const auto [begin, end] = ranges.back();
    ranges.pop_back();
    Box3d all;
    for (std::size_t i = begin; i < end; ++i) all.add(members[i].box);
    const int axis = all.longest_side();
    const double longest = coordinate(all.size(), axis);
    const auto from = members.begin() + static_cast<std::ptrdiff_t>(begin), to = members.begin() + static_cast<std::ptrdiff_t>(end);
    std::stable_sort(from, to, [&](const Member& a, const Member& b) { return coordinate(a.box.low, axis) < coordinate(b.box.low, axis); });
    double reached = -INFINITY;
    std::size_t gap = begin;
    for (std::size_t i = begin; i < end && gap == begin; ++i) {
      if (i > begin && coordinate(members[i].box.low, axis) - reached > kGap * longest && longest > 0) gap = i;
      reached = std::max(reached, coordinate(members[i].box.high, axis));
    }
    if (gap > begin) {
      ranges.push_back({begin, gap});
      ranges.push_back({gap, end});
      continue;
    }
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = begin; i < end; ++i) numbers.push_back(members[i].number);
    std::sort(numbers.begin(), numbers.end());
    result.push_back(std::move(numbers));
  }
}

// False for a surface without a lobe, such as the black body of a lamp: no light changes it.
bool reflects(const SurfaceTile& tile, std::uint32_t i) {
  const SurfaceMaterial* material = tile.material[i];
  if (material == nullptr || material->unlit) return false;
  const auto is_black = [&](const TileVector& v) { return v.x[i] == 0 && v.y[i] == 0 && v.z[i] == 0; };
  return !material->specular_override.empty() || !is_black(tile.albedo) || !is_black(tile.f0) || !is_black(tile.f90) || tile.coat[i] != 0 ||
         !is_black(tile.sheen) || tile.any_passing;
}

// Number of a slot's square of 8 x 8 pixels, which is four blocks of slots.
std::uint32_t square_of(std::uint32_t slot) {
  constexpr std::uint32_t kBlocks = kTileSide / 4;
  const std::uint32_t block = slot / 16;
  return block / kBlocks / 2 * (kBlocks / 2) + block % kBlocks / 2;
}

}  // namespace

PointGroups groups_of(const SurfaceTile& tile, const std::vector<Vec3d>& positions) {
  std::array<std::vector<Member>, kTilePixels / 64> squares;
  for (std::uint32_t i = 0; i < kTilePixels; ++i) {
    if (!reflects(tile, i)) continue;
    Member m{i, {}};
    m.box.add(positions[i]);
    squares[square_of(i)].push_back(m);
  }
  PointGroups result;
  for (std::vector<Member>& square : squares)
    if (!square.empty()) split(square, result.groups);
  std::vector<Member> boxes;
  for (std::uint32_t g = 0; g < result.groups.size(); ++g) {
    Member m{g, {}};
    for (const std::uint32_t slot : result.groups[g]) m.box.add(positions[slot]);
    boxes.push_back(m);
  }
  if (!boxes.empty()) split(boxes, result.clusters);
  return result;
}

namespace {

using shadow::Viewpoint;

Vec3d double_of(const TileVector& v, std::size_t i) { return static_cast<Vec3d>(Vec3f{v.x[i], v.y[i], v.z[i]}); }

}  // namespace

void PointGroups::remove(const std::function<bool(std::uint32_t)>& leaves) {
  bool any_empty = false;
  for (std::vector<std::uint32_t>& slots : groups) {
    std::erase_if(slots, leaves);
    any_empty = any_empty || slots.empty();
  }
  if (!any_empty) return;
  std::vector<std::uint32_t> new_number(groups.size());
  std::vector<std::vector<std::uint32_t>> kept;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    new_number[g] = static_cast<std::uint32_t>(kept.size());
    if (!groups[g].empty()) kept.push_back(std::move(groups[g]));
  }
  std::vector<std::vector<std::uint32_t>> kept_clusters;
  for (const std::vector<std::uint32_t>& cluster : clusters) {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t g : cluster) {
      const std::size_t next = g + 1 < new_number.size() ? new_number[g + 1] : kept.size();
      if (next > new_number[g]) numbers.push_back(new_number[g]);
    }
    if (!numbers.empty()) kept_clusters.push_back(std::move(numbers));
  }
  groups = std::move(kept);
  clusters = std::move(kept_clusters);
}

TilePoints points_for_shadows(const SurfaceTile& tile, const RayScene& rays, Terminator terminator) {
  TilePoints result;
  result.points.resize(kTilePixels);
  std::vector<Vec3d> positions(kTilePixels);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    const Vec3d position = double_of(tile.position, i), geometric = double_of(tile.geometric_normal, i),
                normal = normalized(double_of(tile.normal, i));
    Viewpoint& at = result.points[i];
    positions[i] = at.position = rays.off_surface(position, geometric);
    at.normal = normal;
    at.seed = tile.seed * kTilePixels + i;
    if (terminator == Terminator::strict && length(normal - geometric) > 1e-5) at.geometric_normal = geometric;
  }
  result.groups = groups_of(tile, positions);
  return result;
}

}  // namespace steradian
