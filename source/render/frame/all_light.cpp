#include "render/frame/all_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "steradian/area_light.h"  // luminance

namespace steradian {

namespace {

constexpr float kFar = 1000;  // distance of what mirrors do not meet, in sizes of the scene

void add(TileVector& to, std::size_t i, Vec3f r) {
  to.x[i] += r.x;
  to.y[i] += r.y;
  to.z[i] += r.z;
}

}  // namespace

AllLight::AllLight(std::shared_ptr<const radiosity::PatchLight> patches, std::unique_ptr<const certificate::BounceBounds> bounds,
                   const FrameSurfaces& surfaces, const RenderOptions& options, radiosity::AddDirect add_direct)
    : width_(options.width),
      bounces_(options.bounces),
      reflections_(options.reflections),
      preview_(options.bounce_preview),
      eye_(surfaces.camera().origin()),
      patches_(std::move(patches)),
      bounds_(std::move(bounds)),
      gather_(*patches_, surfaces.rays(), radiosity::fineness_of(options), {options.bounce_error, options.bounce_strict, options.aa}),
      in_lobes_(*patches_, surfaces.rays(), options.aa),
      mirror_images_(kMostTurns, radiosity::MirrorImage(options.width, options.height, size_of_pixel(surfaces.camera().steps(1)),
                                                        kFar * static_cast<float>(surfaces.rays().reach()))),
      surfaces_(surfaces),
      add_direct_(std::move(add_direct)) {}

void AllLight::begin(Picture& picture, const RenderOptions& options) {
  for (const char* layer : {"indirect", "bounce_error", "bounce_bound"}) picture.layers[layer].resize(picture.pixels.size());
  if (!options.bound) return;
  for (const char* layer : {"lower", "upper"}) picture.layers[layer].resize(picture.pixels.size());
}

// Adds the light that a tile's surfaces gather to `light`.
void AllLight::gather(SurfaceTile& tile, int sample, radiosity::Gather::Asked asked, TileVector& light, TileVector& error) const {
  constexpr std::size_t kLanes = SixteenSurfaces::kLanes;
  const auto blocks = std::make_unique<radiosity::FourBlocks>();
  for (int y = 0; y < kTileSide; y += 8)
    for (int x = 0; x < kTileSide; x += 8) {
      std::array<std::size_t, 4> first;
      for (std::size_t b = 0; b < 4; ++b) {
        first[b] = tile_slot(x + static_cast<int>(b) % 2 * 4, y + static_cast<int>(b) / 2 * 4);
        (*blocks)[b].take(tile, first[b]);
      }
      const std::array<radiosity::Gather::Result, 4> results = gather_.reflected(*blocks, sample, asked);
      for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t i = 0; i < kLanes; ++i) {
          steradian::add(light, first[b] + i, results[b].radiance[i]);
          steradian::add(error, first[b] + i, results[b].error[i]);
        }
    }
}

// Adds the light of the surfaces that mirrors show, which are lit like those that the camera sees. The lobes' integrals over the lamps
// already hold the lamps' light. Returns the length of each mirrored ray to what it met first, infinity where it met nothing.
TilePlane AllLight::follow_mirrors(radiosity::Mirrors& mirrors, std::uint64_t seed, int sample, int depth, TileVector& light,
                                   TileVector& error) const {
  PassedRays::Ways& ways = mirrors.ways;
  TilePlane reach;
  reach.fill(std::numeric_limits<float>::infinity());
  const auto shown = std::make_unique<SurfaceTile>();
  ways.restart();
  do {
    clear_kinds(*shown);
    shown->seed = seed;
    for (std::size_t i = 0; i < kTilePixels; ++i) put_nothing(*shown, i);
    surfaces_.passed_rays().fill(ways, PassedRays::Lamps::hidden, *shown);
    if (!shown->any_surface) continue;
    add_direct_(*shown);
    TileVector error_of_shown{};
    // The mirror is a bounce of its own.
    const bool last = bounces_ == reflections_ - depth + 1;
    if (!last) gather(*shown, sample, {depth > 1, false}, shown->radiance, error_of_shown);
    TilePlane onwards;
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const float way = length(get(shown->position, i) - get(ways.origin, i));
      onwards[i] = ways.length[i] + way;
      if (ways.turn == 0 && shown->material[i] != nullptr) reach[i] = way;
    }
    const auto deeper = std::make_unique<radiosity::Mirrors>();
    if (depth > 1 && !last && radiosity::find_mirrors(surfaces_.rays(), *shown, onwards, *deeper))
      follow_mirrors(*deeper, seed, sample, depth - 1, shown->radiance, error_of_shown);
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      if (shown->material[i] == nullptr) continue;
      steradian::add(light, i, get(shown->radiance, i) * get(ways.shares, i));
      steradian::add(error, i, get(error_of_shown, i) * get(ways.shares, i));
    }
  } while (surfaces_.passed_rays().go_on(*shown, ways));
  return reach;
}

// Adds the light that a tile's mirrors show, and keeps it for the blur.
void AllLight::add_mirrored(const SurfaceTile& tile, const TilePlane& distance, const Seen& seen, TileVector& light, TileVector& error) {
  radiosity::MirrorImage& image = mirror_images_[static_cast<std::size_t>(seen.layer)];
  const auto mirrors = std::make_unique<radiosity::Mirrors>();
  if (!radiosity::find_mirrors(surfaces_.rays(), tile, distance, *mirrors)) return;
  const auto some = std::make_unique<radiosity::SomeMirrors>();
  radiosity::StandsFor stands_for;
  TileVector mirrored{}, error_of_mirrored{};
  TilePlane reach;
  reach.fill(std::numeric_limits<float>::infinity());
  const auto trace = [&] {
    TileVector of_some{}, error_of_some{};
    const TilePlane reach_of_some = follow_mirrors(some->mirrors, tile.seed, seen.sample, reflections_, of_some, error_of_some);
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const std::uint32_t slot = some->source[i];
      if (slot == kNoSlot) continue;
      reach[slot] = reach_of_some[i];
      put(mirrored, slot, get(of_some, i));
      put(error_of_mirrored, slot, get(error_of_some, i));
    }
  };
  radiosity::choose_first(tile, *mirrors, image.pixel(), stands_for, *some);
  trace();
  if (radiosity::choose_rest(*mirrors, image.pixel(), reach, stands_for, *some)) trace();
  for (int y = 0; y < kTileSide; ++y)
    for (int x = 0; x < kTileSide; ++x) {
      const std::size_t slot = tile_slot(x, y), from = radiosity::traced_slot(stands_for, x, y);
      if (mirrors->ways.bent[slot] != 0) steradian::add(error, slot, get(error_of_mirrored, from));
    }
  TileVector patches;
  in_lobes_.along_rays(*mirrors, stands_for, patches);
  image.take({tile, *mirrors, stands_for, reach, mirrored, &patches, seen.shares, seen.weight}, seen.area);
  for (std::size_t i = 0; i < kTilePixels; ++i) steradian::add(light, i, get(mirrored, i));
}

void AllLight::add(SurfaceTile& tile, const Seen& seen, Picture& picture) {
  TileVector light{}, error{};
  clock_.run([&] {
    gather(tile, seen.sample, {reflections_ > 0, !preview_}, light, error);
    TilePlane distance;
    for (std::size_t i = 0; i < kTilePixels; ++i) distance[i] = length(get(tile.position, i) - eye_);
    if (reflections_ > 0) add_mirrored(tile, distance, seen, light, error);
    add_bounds(tile, light, seen, picture);
    for (std::size_t i = 0; i < kTilePixels; ++i) steradian::add(tile.radiance, i, get(light, i));
  });
  add_to_picture(light, seen.area, seen.shares, seen.weight, picture.layers.at("indirect"), width_);
  add_to_picture(error, seen.area, seen.shares, seen.weight, picture.layers.at("bounce_error"), width_);
}

// Adds what is known of the light that `light` stands for: a tile's lower and upper bounds, if they are asked for, else a bound of the
// bounces that the iterations leave out.
void AllLight::add_bounds(const SurfaceTile& tile, const TileVector& light, const Seen& seen, Picture& picture) const {
  TileVector bound{}, lower{}, upper{};
  const float left_out = patches_->left_out().value_or(0);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] == nullptr) continue;
    if (bounds_ == nullptr) {
      put(bound, i, {left_out, left_out, left_out});  // no surface reflects more than arrives
      continue;
    }
    const Vec3f direct = get(tile.radiance, i), shown = get(light, i), albedo = get(tile.albedo, i);
    Vec3f low{}, high{};
    if (albedo != Vec3f{}) {
      const certificate::RadianceRange white =
          bounds_->white_at(static_cast<Vec3d>(get(tile.position, i)), static_cast<Vec3d>(get(tile.normal, i)));
      low = static_cast<Vec3f>(white.low) * albedo;
      high = static_cast<Vec3f>(white.high) * albedo;
    }
    const auto farther = [](float value, float least, float most) { return std::max(value - least, most - value); };
    put(bound, i, {farther(shown.x, low.x, high.x), farther(shown.y, low.y, high.y), farther(shown.z, low.z, high.z)});
    put(lower, i, direct + low);
    put(upper, i, direct + high);
  }
  add_to_picture(bound, seen.area, seen.shares, seen.weight, picture.layers.at("bounce_bound"), width_);
  if (bounds_ == nullptr) return;
  add_to_picture(lower, seen.area, seen.shares, seen.weight, picture.layers.at("lower"), width_);
  add_to_picture(upper, seen.area, seen.shares, seen.weight, picture.layers.at("upper"), width_);
}

void AllLight::finish(Picture& picture) {
  clock_.run([&] {
    for (const radiosity::MirrorImage& image : mirror_images_) image.blur(picture, &in_lobes_);
  });
}

void AllLight::report(int threads, RenderStats& stats, const Picture& picture) const {
  stats.passes.push_back(clock_.time(threads));
  stats.patches = patches_->patches().side_count() / 2;
  stats.bounce_iterations = patches_->iterations();
  stats.patch_rays = patches_->traced();
  stats.bounce_glossy = patches_->glossy_shares().all;
  stats.bounce_glossy_evenly = patches_->glossy_shares().evenly;
  stats.bounce_left_out = static_cast<double>(patches_->left_out().value_or(-1));
  double squares = 0, light = 0;
  for (const Vec3f& e : picture.layers.at("bounce_error")) squares += std::pow(luminance(static_cast<Vec3d>(e)), 2);
  for (const Vec3f& p : picture.pixels) light += luminance(static_cast<Vec3d>(p));
  const auto count = static_cast<double>(picture.pixels.size());
  stats.bounce_error = light > 0 ? std::sqrt(squares / count) / (light / count) : 0;
  if (bounds_ == nullptr) return;
  stats.bound_elements = bounds_->side_count();
  const std::vector<Vec3f>&lower = picture.layers.at("lower"), &upper = picture.layers.at("upper");
  double distance = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < lower.size(); ++i) {
    distance += luminance(static_cast<Vec3d>(upper[i] - lower[i])) / 2;
    constexpr float kRounding = 1e-6f;
    const auto is_between = [](float value, float low, float high) {
      return value >= low * (1 - kRounding) && value <= high * (1 + kRounding);
    };
    const Vec3f p = picture.pixels[i];
    inside += is_between(p.x, lower[i].x, upper[i].x) && is_between(p.y, lower[i].y, upper[i].y) && is_between(p.z, lower[i].z, upper[i].z);
  }
  stats.bound_mean = light > 0 ? distance / light : 0;
  stats.bound_inside = count > 0 ? static_cast<double>(inside) / count : 1;
}

}  // namespace steradian
