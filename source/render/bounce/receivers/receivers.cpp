#include "render/bounce/receivers/receivers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/box.h"

namespace steradian::indirect {
namespace {

// Calls use(pixel, receiver) for all pixels, in areas as wide as `stride` tiles, so that both orders stay in the cache.
template <class Use>
void for_each_pixel(const Layout& layout, Use use) {
  const int side = layout.stride * kTile;
  const Raster raster{layout.width, layout.height};
  std::vector<std::size_t> columns;
  for (int x = 0; x < layout.width; ++x) columns.push_back(layout.column_part(x));
  tbb::parallel_for(0, layout.tiles(), [&](int tile) {
    const int x0 = tile % layout.tiles_x * side, y0 = tile / layout.tiles_x * side;
    const int x1 = std::min(x0 + side, layout.width), y1 = std::min(y0 + side, layout.height);
    for (int y = y0; y < y1; ++y) {
      const std::size_t row = layout.row_part(y);
      for (int x = x0; x < x1; ++x) use(raster.at(x, y), row + columns[static_cast<std::size_t>(x)]);
    }
  });
}

void copy(VectorArray& to, std::size_t i, const VectorArray& from, std::size_t k) {
  to.x[i] = from.x[k];
  to.y[i] = from.y[k];
  to.z[i] = from.z[k];
}

}  // namespace

void widen_over_pattern(PictureSurfaces& s, int side) {
  constexpr float kMean = 1.0f / 3;     // of the squares from the middle of the pattern to its side, over that of the side
  constexpr float kSameSurface = 0.8f;  // cosine: beyond 37 degrees it is another surface, or an edge
  const FloatArray before = s.alpha;
  const int reach = side / 2;
  tbb::parallel_for(0, s.raster.height, [&](int y) {
    for (int x = 0; x < s.raster.width; ++x) {
      const std::size_t i = s.raster.at(x, y);
      const Vec3f n = s.normal[i];
      if (!(dot(n, n) > 0) || !(largest(s.f0[i]) + largest(s.f90[i]) > 0)) continue;
      float turn2 = 0;
      for (const auto& [dx, dy] : {std::pair{-reach, 0}, {reach, 0}, {0, -reach}, {0, reach}}) {
        if (x + dx < 0 || x + dx >= s.raster.width || y + dy < 0 || y + dy >= s.raster.height) continue;
        const float cosine = dot(n, s.normal[s.raster.at(x + dx, y + dy)]);
        if (cosine > kSameSurface) turn2 = std::max(turn2, 2 - 2 * cosine);
      }
      s.alpha[i] = std::min(std::sqrt(before[i] * before[i] + turn2 * kMean), std::max(before[i], 1.0f));
    }
  });
}

Receivers interleave(const PictureSurfaces& s, const Layout& layout, IndirectMode mode) {
  Receivers r;
  const std::size_t n = layout.size();
  r.position.resize(n);
  r.normal.resize(n);
  r.view.resize(n);
  r.alpha.resize(n);
  r.glossy.resize(n);
  if (mode == IndirectMode::ggx) {
    r.f0.resize(n);
    r.f90.resize(n);
  }
  for_each_pixel(layout, [&](std::size_t pixel, std::size_t receiver) {
    copy(r.position, receiver, s.position, pixel);
    copy(r.normal, receiver, s.normal, pixel);
    copy(r.view, receiver, s.view, pixel);
    r.alpha[receiver] = s.alpha[pixel];
    r.glossy[receiver] = largest(s.f0[pixel]) + largest(s.f90[pixel]) > 0 ? 1.0f : 0.0f;
    if (mode == IndirectMode::ggx) {
      copy(r.f0, receiver, s.f0, pixel);
      copy(r.f90, receiver, s.f90, pixel);
    }
  });
  return r;
}

IncomingLight deinterleave(const IncomingLight& light, const Layout& layout) {
  IncomingLight result;
  const std::size_t n = Raster{layout.width, layout.height}.size();
  result.diffuse.resize(n);
  result.glossy.resize(n);
  for_each_pixel(layout, [&](std::size_t pixel, std::size_t receiver) {
    copy(result.diffuse, pixel, light.diffuse, receiver);
    copy(result.glossy, pixel, light.glossy, receiver);
  });
  return result;
}

ReceiverBounds bounds_of(const Receivers& r, std::size_t first, std::size_t count) {
  Box3f positions, normals;
  for (std::size_t i = first; i < first + count; ++i) {
    const Vec3f n = r.normal[i];
    if (n.x == 0 && n.y == 0 && n.z == 0) continue;
    positions.add(r.position[i]);
    normals.add(n);
  }
  if (positions.is_empty()) return {};
  // The bounds are slightly wider than the points, because they are computed in float.
  const Vec3f center = positions.center();
  const float slack = 1e-6f * (std::fabs(center.x) + std::fabs(center.y) + std::fabs(center.z));
  const Vec3f wide{slack, slack, slack}, turn{1e-6f, 1e-6f, 1e-6f};
  return {center, positions.half() + wide, normals.center(), normals.half() + turn, false};
}

}  // namespace steradian::indirect
