#include "render/radiosity/mirror/mirrors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lobes/ggx_energy.h"

namespace steradian::radiosity {
namespace {

// Widths between which a lobe's light passes from mirrored rays to directions of its own.
constexpr float kAllMirror = 0.03f, kNoMirror = 0.08f;

// The narrow lobes of a surface: their mirrored direction, the fraction that they reflect, and their mean widths.
struct Mirror {
  Vec3f normal, direction, weight;
  float alpha_x = 0, alpha_y = 0;
};

float sum(Vec3f v) { return v.x + v.y + v.z; }

// It leaves out lobes about another normal than the first.
std::optional<Mirror> mirror_of(const Surface& surface, Vec3f view) {
  std::optional<Mirror> mirror;
  for (const SurfaceLobe& lobe : lobes_of(surface)) {
    const Material& m = lobe.material;
    const auto alpha_x = static_cast<float>(m.alpha_x), alpha_y = static_cast<float>(m.alpha_y);
    if (m.brdf != Brdf::ggx || !(mirrored_fraction(alpha_x, alpha_y) > 0)) continue;
    const float cosine = dot(lobe.normal, view);
    if (!(cosine > 0) || (mirror && !(lobe.normal == mirror->normal))) continue;
    if (!mirror) mirror = Mirror{lobe.normal, normalized(lobe.normal * (2 * cosine) - view), {}};
    const lobes::LobeValue energy = lobes::ggx_energy(std::sqrt(m.alpha_x * m.alpha_y), static_cast<double>(cosine));
    const auto weight = static_cast<Vec3f>(lobes::coloured(energy, m.f0, m.f90) * static_cast<double>(mirrored_fraction(alpha_x, alpha_y)));
    mirror->weight += weight;
    mirror->alpha_x += alpha_x * sum(weight);
    mirror->alpha_y += alpha_y * sum(weight);
  }
  if (!mirror || !weighs(mirror->weight)) return std::nullopt;
  mirror->alpha_x /= sum(mirror->weight);
  mirror->alpha_y /= sum(mirror->weight);
  return mirror;
}

}  // namespace

Vec3f above_triangle(Vec3f direction, Vec3f geometric_normal) {
  constexpr float kLeast = 1e-3f;
  const float height = dot(direction, geometric_normal);
  return height > kLeast ? direction : normalized(direction + geometric_normal * (kLeast - height));
}

float mirrored_fraction(float alpha_x, float alpha_y) {
  const float x = std::clamp((kNoMirror - std::sqrt(alpha_x * alpha_y)) / (kNoMirror - kAllMirror), 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

bool find_mirrors(const RayScene& rays, const SurfaceTile& tile, const TilePlane& distance, Mirrors& mirrors) {
  bool any = false;
  PassedRays::Ways& ways = mirrors.ways;
  ways.behind.fill(0);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    ways.bent[i] = 0;
    put(ways.shares, i, {});
    if (tile.material[i] == nullptr || tile.material[i]->unlit) continue;
    const Surface surface = surface_in(tile, i);
    const std::optional<Mirror> mirror = mirror_of(surface, get(tile.view, i));
    if (!mirror) continue;
    const Vec3d origin = rays.off_surface(static_cast<Vec3d>(surface.position), static_cast<Vec3d>(surface.geometric_normal));
    ways.bent[i] = 1;
    put(ways.shares, i, mirror->weight);
    put(ways.origin, i, static_cast<Vec3f>(origin));
    put(ways.direction, i, above_triangle(mirror->direction, surface.geometric_normal));
    ways.length[i] = distance[i];
    put(mirrors.normal, i, mirror->normal);
    mirrors.alpha_x[i] = mirror->alpha_x;
    mirrors.alpha_y[i] = mirror->alpha_y;
    any = true;
  }
  return any;
}

namespace {

constexpr int kSquare = 8;    // pixels along the side of a square in which all pixels are treated alike
constexpr float kPixels = 8;  // least width of a lobe in pixels

// Width of a lobe in pixels of what it shows at a distance.
float width_in_pixels(const Mirrors& mirrors, std::size_t slot, float pixel, float reach) {
  const float near = reach < std::numeric_limits<float>::infinity() ? reach / (mirrors.ways.length[slot] + reach) : 1.0f;
  return 2 * std::min(mirrors.alpha_x[slot], mirrors.alpha_y[slot]) / pixel * near;
}

// Slot of the pixel that stands for those of its 2 x 2.
std::size_t standing_slot(int x, int y) { return tile_slot(x & ~1, y & ~1); }

// True if the mirror in `slot` continues the one in `other`.
bool continues(const SurfaceTile& tile, const Mirrors& mirrors, std::size_t slot, std::size_t other) {
  constexpr float kSameWay = 0.98f;  // cosine
  return mirrors.ways.bent[other] != 0 && tile.material[slot] == tile.material[other] &&
         dot(get(mirrors.normal, slot), get(mirrors.normal, other)) > kSameWay;
}

// Puts mirrors into slots, one after another.
class Collector {
 public:
  Collector(const Mirrors& from, SomeMirrors& to) : from_(from), to_(to) {
    PassedRays::Ways& ways = to.mirrors.ways;
    ways.behind.fill(0);
    ways.bent.fill(0);
    for (TilePlane* plane : {&ways.shares.x, &ways.shares.y, &ways.shares.z}) plane->fill(0);
    to.source.fill(kNoSlot);
  }
  void put_next(std::size_t slot) {
    const std::size_t i = next_++;
    if (from_.ways.bent[slot] == 0) return;
    PassedRays::Ways& ways = to_.mirrors.ways;
    to_.source[i] = static_cast<std::uint32_t>(slot);
    ways.bent[i] = 1;
    put(ways.shares, i, get(from_.ways.shares, slot));
    put(ways.origin, i, get(from_.ways.origin, slot));
    put(ways.direction, i, get(from_.ways.direction, slot));
    ways.length[i] = from_.ways.length[slot];
  }
  // The next sixteen slots begin a block of their own.
  void begin_block() { next_ = (next_ + 15) / 16 * 16; }
  bool empty() const { return next_ == 0; }

 private:
  const Mirrors& from_;
  SomeMirrors& to_;
  std::size_t next_ = 0;
};

template <class Use>  // use(x, y): the left upper pixel of each square of a tile
void each_square(Use use) {
  for (int y = 0; y < kTileSide; y += kSquare)
    for (int x = 0; x < kTileSide; x += kSquare) use(x, y);
}

}  // namespace

void choose_first(const SurfaceTile& tile, const Mirrors& mirrors, float pixel, StandsFor& stands_for, SomeMirrors& some) {
  stands_for.fill(0);
  Collector collector(mirrors, some);
  each_square([&](int x, int y) {
    bool any = false, sparse = true;
    for (int k = 0; k < kSquare * kSquare; ++k) {
      const int px = x + k % kSquare, py = y + k / kSquare;
      const std::size_t slot = tile_slot(px, py);
      if (mirrors.ways.bent[slot] == 0) continue;
      any = true;
      sparse = sparse && width_in_pixels(mirrors, slot, pixel, std::numeric_limits<float>::infinity()) > kPixels &&
               continues(tile, mirrors, slot, standing_slot(px, py));
    }
    if (!any) return;
    const int step = sparse ? 2 : 1;
    for (int top = y; top < y + kSquare; top += 4 * step)
      for (int left = x; left < x + kSquare; left += 4 * step)
        for (int k = 0; k < 16; ++k) collector.put_next(tile_slot(left + k % 4 * step, top + k / 4 * step));
    for (int k = 0; k < kSquare * kSquare; ++k) {
      const int px = x + k % kSquare, py = y + k / kSquare;
      if (mirrors.ways.bent[tile_slot(px, py)] != 0) ++stands_for[sparse ? standing_slot(px, py) : tile_slot(px, py)];
    }
  });
}

std::size_t traced_slot(const StandsFor& stands_for, int x, int y) {
  const std::size_t slot = tile_slot(x, y);
  return stands_for[slot] != 0 ? slot : standing_slot(x, y);
}

bool choose_rest(const Mirrors& mirrors, float pixel, const TilePlane& reach, StandsFor& stands_for, SomeMirrors& some) {
  Collector collector(mirrors, some);
  each_square([&](int x, int y) {
    bool sparse = false, near = false;
    for (int k = 0; k < kSquare * kSquare; ++k) {
      const std::size_t slot = tile_slot(x + k % kSquare, y + k / kSquare);
      if (mirrors.ways.bent[slot] == 0) continue;
      sparse = sparse || stands_for[slot] == 0;
      near = near || (stands_for[slot] != 0 && width_in_pixels(mirrors, slot, pixel, reach[slot]) < kPixels);
    }
    if (!sparse || !near) return;
    collector.begin_block();
    for (int k = 0; k < kSquare * kSquare; ++k) {
      const std::size_t slot = tile_slot(x + k % kSquare, y + k / kSquare);
      if (mirrors.ways.bent[slot] != 0 && stands_for[slot] == 0) collector.put_next(slot);
      if (mirrors.ways.bent[slot] != 0) stands_for[slot] = 1;
    }
  });
  return !collector.empty();
}

}  // namespace steradian::radiosity
