#include "render/radiosity/mirror/mirror_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lobes/lobe_parts.h"
#include "render/radiosity/fineness.h"

namespace steradian::radiosity {
namespace {

constexpr float kSharp = 1e-3f;      // alpha below which a lobe is narrower than a pixel of any picture
constexpr float kWidest = 8;         // half vectors farther out than so many alphas hold 1.5 % of a lobe
constexpr float kFine = 0.33f;       // size of a block over the distance in which the lobe changes, at the lobe's middle ...
constexpr float kCoarse = 0.5f;      // ... and far out, where little of the lobe is
constexpr float kContinuous = 0.9f;  // cosine between normals of neighbours on one smooth surface

// Weight of the patches in a mean of so many rays that fill a fraction of a lobe.
float asks_patches(float rays, float filled) {
  constexpr float kFew = 16, kMany = 64, kMost = 0.9f, kLeast = 0.7f;
  return std::max(std::clamp((kMany - rays) / (kMany - kFew), 0.0f, 1.0f), std::clamp((kMost - filled) / (kMost - kLeast), 0.0f, 1.0f));
}

Vec3f not_below_zero(Vec3f v) { return {std::max(v.x, 0.0f), std::max(v.y, 0.0f), std::max(v.z, 0.0f)}; }

Vec3f divided(Vec3f a, Vec3f by) {
  const auto one = [](float x, float y) { return y > 0 ? x / y : 0.0f; };
  return {one(a.x, by.x), one(a.y, by.y), one(a.z, by.z)};
}

}  // namespace

// Places that mirrors show, by blocks of pixels: level k holds blocks of 2^k x 2^k.
struct MirrorImage::Cells {
  struct Cell {
    Vec3f place, light, patches;  // light, patches: mean radiance
    int rays = 0;
    float area = 0;    // sum of the footprints
    float radius = 0;  // of a ball about the place that holds all of them
    const SurfaceMaterial* material = nullptr;
    bool mixed = false;  // of several materials
  };
  struct Level {
    int width, height;
    std::vector<Cell> cells;
  };
  std::vector<Level> levels;
  struct Block {
    std::size_t level;
    int x, y;
  };

  static Cell joined(const std::array<const Cell*, 4>& parts) {
    Cell whole;
    for (const Cell* part : parts) {
      if (part == nullptr || part->area == 0) continue;
      whole.mixed = whole.mixed || part->mixed || (whole.area > 0 && whole.material != part->material);
      whole.material = part->material;
      whole.place += part->place * part->area;
      whole.light += part->light * part->area;
      whole.patches += part->patches * part->area;
      whole.rays += part->rays;
      whole.area += part->area;
    }
    if (whole.area == 0) return whole;
    whole.place = whole.place * (1 / whole.area);
    whole.light = whole.light * (1 / whole.area);
    whole.patches = whole.patches * (1 / whole.area);
    for (const Cell* part : parts)
      if (part != nullptr && part->area > 0) whole.radius = std::max(whole.radius, length(part->place - whole.place) + part->radius);
    return whole;
  }

  void add_levels() {
    while (levels.back().width > 1 || levels.back().height > 1) {
      const Level& fine = levels.back();
      Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
      coarse.cells.resize(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height));
      const auto part = [&](int x, int y) -> const Cell* {
        return x < fine.width && y < fine.height ? &fine.cells[static_cast<std::size_t>(y * fine.width + x)] : nullptr;
      };
      for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x)
          coarse.cells[static_cast<std::size_t>(y * coarse.width + x)] =
              joined({part(2 * x, 2 * y), part(2 * x + 1, 2 * y), part(2 * x, 2 * y + 1), part(2 * x + 1, 2 * y + 1)});
      levels.push_back(std::move(coarse));
    }
  }

  // The mean of the places' light that a pixel's lobe sees, the fraction of the lobe that they fill, and the number of rays that would
  // tell as much if the lobe weighed all alike.
  struct Seen {
    Vec3f light, patches;
    float filled = 0, rays = 0;
  };
  Seen seen_from(const Pixel& pixel) const {
    Kernels<float> k;
    const Frame frame = Frame::from_normal_and_tangent(static_cast<Vec3d>(pixel.normal), static_cast<Vec3d>(pixel.tangent));
    const Vec3f ax = static_cast<Vec3f>(frame.x), ay = static_cast<Vec3f>(frame.y), az = static_cast<Vec3f>(frame.z);
    const auto along = [](Vec3f axis, Vec3f v) { return static_cast<double>(dot(axis, v)); };
    const auto local = [&](Vec3f v) { return Kernels<float>::vec3(along(ax, v), along(ay, v), along(az, v)); };
    const auto view = local(pixel.view);
    const float width = 2 * std::max(pixel.alpha_x, pixel.alpha_y), fine = 2 * std::min(pixel.alpha_x, pixel.alpha_y);
    Vec3f light{}, patches{};
    float sum = 0, squares = 0;
    std::array<Block, 64> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {levels.size() - 1, 0, 0};
    while (waiting > 0) {
      const Block block = stack[--waiting];
      const Level& level = levels[block.level];
      const Cell& cell = level.cells[static_cast<std::size_t>(block.y * level.width + block.x)];
      if (cell.area == 0 || (!cell.mixed && cell.material != pixel.material)) continue;
      const Vec3f way = cell.place - pixel.position;
      const float square = dot(way, way), distance = std::sqrt(square);
      const bool leaf = block.level == 0;
      if (!leaf && cell.radius >= distance) {
        push_parts(block, stack, waiting);
        continue;
      }
      if (!(distance > 0)) continue;
      const Vec3f to = way * (1 / distance);
      const float angle = cell.radius / distance, off = length(to - pixel.direction);
      if (!leaf && off - angle > kWidest * width) continue;
      const float out = off / width, size = std::min(kFine * (1 + out * out / 8), kCoarse) * (fine + off);
      if (!leaf && (cell.mixed || angle > size)) {
        push_parts(block, stack, waiting);
        continue;
      }
      const float weight = k.ggx_lobe(local(to), view, pixel.alpha_x, pixel.alpha_y).v * cell.area / square;
      light += cell.light * weight;
      patches += cell.patches * weight;
      sum += weight;
      squares += weight * weight / static_cast<float>(cell.rays);
    }
    if (!(sum > 0)) return {{}, {}, -1, 0};
    return {light * (1 / sum), patches * (1 / sum), std::min(sum, 1.0f), sum * sum / squares};
  }

  void push_parts(Block block, std::array<Block, 64>& stack, std::size_t& waiting) const {
    const Level& fine = levels[block.level - 1];
    for (int part = 3; part >= 0; --part) {
      const int x = 2 * block.x + part % 2, y = 2 * block.y + part / 2;
      if (x < fine.width && y < fine.height) stack[waiting++] = {block.level - 1, x, y};
    }
  }
};

MirrorImage::MirrorImage(int width, int height, float pixel, float far)
    : width_(width),
      height_(height),
      across_((width + kTileSide - 1) / kTileSide),
      pixel_(pixel),
      far_(far),
      tiles_(static_cast<std::size_t>(across_) * static_cast<std::size_t>((height + kTileSide - 1) / kTileSide)) {}

void MirrorImage::take(const Taken& taken, TileArea area) {
  Tile& tile = tiles_[static_cast<std::size_t>(area.y / kTileSide * across_ + area.x / kTileSide)];
  const Mirrors& mirrors = taken.mirrors;
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const std::size_t slot = tile_slot(x, y);
      if (mirrors.ways.bent[slot] == 0 || std::max(mirrors.alpha_x[slot], mirrors.alpha_y[slot]) < kSharp) continue;
      if (tile.of_slot.empty()) tile.of_slot.resize(kTilePixels);
      std::uint16_t& number = tile.of_slot[slot];
      if (number == 0) {
        Pixel pixel;
        pixel.x = area.x + x;
        pixel.y = area.y + y;
        pixel.position = get(mirrors.ways.origin, slot);
        pixel.normal = get(mirrors.normal, slot);
        pixel.geometric_normal = get(taken.tile.geometric_normal, slot);
        pixel.tangent = get(taken.tile.tangent, slot);
        pixel.view = get(taken.tile.view, slot);
        pixel.direction = get(mirrors.ways.direction, slot);
        const float reach = std::min(taken.reach[slot], far_);
        pixel.place = pixel.position + pixel.direction * reach;
        pixel.alpha_x = mirrors.alpha_x[slot];
        pixel.alpha_y = mirrors.alpha_y[slot];
        pixel.length = mirrors.ways.length[slot] + reach;
        pixel.material = taken.tile.material[slot];
        pixel.stands_for = taken.stands_for[slot];
        tile.pixels.push_back(pixel);
        number = static_cast<std::uint16_t>(tile.pixels.size());
      }
      Pixel& pixel = tile.pixels[number - 1u];
      const Vec3f arrives = (taken.shares != nullptr ? get(*taken.shares, slot) : Vec3f{1, 1, 1}) * taken.weight;
      pixel.share += get(mirrors.ways.shares, slot) * arrives;
      if (taken.stands_for[slot] != 0) pixel.traced_share += get(mirrors.ways.shares, slot) * arrives;
      pixel.light += get(taken.light, slot) * arrives;
      if (taken.patches != nullptr) pixel.patches += get(*taken.patches, slot) * arrives;
    }
}

// Change of of(pixel) from a pixel to the next ones of the same smooth surface, on both sides. Zero if there is none.
template <class Of>
Vec3f MirrorImage::step(const Pixel& pixel, const Places& at, int dx, int dy, Of of) const {
  Vec3f steps{};
  int count = 0;
  for (const int sign : {-1, 1}) {
    const int x = pixel.x + sign * dx, y = pixel.y + sign * dy;
    if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
    const Pixel* next = at[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    if (next == nullptr || next->material != pixel.material || !(dot(next->normal, pixel.normal) > kContinuous)) continue;
    steps += (of(*next) - of(pixel)) * static_cast<float>(sign);
    ++count;
  }
  return count > 0 ? steps * (1 / static_cast<float>(count)) : Vec3f{};
}

// Area of the footprint of a pixel at the place that it shows, across the ray. The next pixels of the same surface tell how the mirror
// spreads it.
float MirrorImage::footprint(const Pixel& pixel, const Places& at) const {
  const float reach = length(pixel.place - pixel.position);
  const auto end = [&](const Pixel& p) { return p.position + p.direction * reach; };
  const Vec3f right = step(pixel, at, 1, 0, end), down = step(pixel, at, 0, 1, end);
  const float least = pixel_ * pixel.length, area = std::fabs(dot(cross(right, down), pixel.direction));
  if (area > 0) return area;
  return least * std::max({length(right), length(down), least});
}

MirrorLobe MirrorImage::lobe_of(const Pixel& pixel, const Places& at) const {
  const auto moved = [&](int dx, int dy) {
    return MirrorLobe::Step{step(pixel, at, dx, dy, [](const Pixel& p) { return p.position; }),
                            step(pixel, at, dx, dy, [](const Pixel& p) { return p.normal; }),
                            step(pixel, at, dx, dy, [](const Pixel& p) { return p.view; })};
  };
  return {pixel.position, pixel.normal, pixel.geometric_normal, pixel.tangent, pixel.view, pixel.alpha_x, pixel.alpha_y,
          moved(1, 0),    moved(0, 1)};
}

void MirrorImage::blur(Picture& picture, const PatchesInLobes* in_lobes) const {
  Places at(picture.pixels.size(), nullptr), all;
  const auto place = [&](const Pixel& pixel) {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(pixel.x);
  };
  for (const Tile& tile : tiles_)
    for (const Pixel& pixel : tile.pixels) {
      at[place(pixel)] = &pixel;
      all.push_back(&pixel);
    }
  if (all.empty()) return;
  Cells cells;
  cells.levels.push_back({width_, height_, std::vector<Cells::Cell>(picture.pixels.size())});
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    const Pixel& pixel = *all[i];
    if (pixel.stands_for == 0) return;
    const float area = footprint(pixel, at) * static_cast<float>(pixel.stands_for);
    cells.levels[0].cells[place(pixel)] = {pixel.place,
                                           divided(pixel.light, pixel.traced_share),
                                           divided(pixel.patches, pixel.traced_share),
                                           1,
                                           area,
                                           std::sqrt(area / std::numbers::pi_v<float>),
                                           pixel.material};
  });
  cells.add_levels();
  std::vector<Vec3f>&indirect = picture.layers.at("indirect"), &error = picture.layers.at("bounce_error");
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    const Pixel& pixel = *all[i];
    const Cells::Seen seen = cells.seen_from(pixel);
    if (seen.filled < 0) return;
    Vec3f mean = seen.light, off = mean * (1 - seen.filled);
    const bool is_solids = pixel.material->solid;
    const float asked = in_lobes != nullptr ? asks_patches(seen.rays, seen.filled) : 0;
    if (asked > 0 || (in_lobes != nullptr && is_solids)) {
      const PatchesInLobes::Seen of_lobe = in_lobes->seen_by(lobe_of(pixel, at));
      mean = not_below_zero(mean + (of_lobe.mean.value - seen.patches) * asked);
      constexpr float kStandardErrors = 2;
      off = off * (1 - asked) + of_lobe.mean.error * (kStandardErrors * asked);
      if (is_solids) off += of_lobe.spread * kShapeOfSolids;
    }
    const Vec3f light = mean * pixel.share, change = light - pixel.light;
    picture.pixels[place(pixel)] += change;
    indirect[place(pixel)] += change;
    error[place(pixel)] += off * pixel.share;
  });
}

}  // namespace steradian::radiosity
