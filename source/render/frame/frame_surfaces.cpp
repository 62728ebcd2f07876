#include "render/frame/frame_surfaces.h"

#include <algorithm>
#include <utility>

namespace steradian {
namespace {

// Direct light alone would leave a lobe without what stands behind the glass.
PassedRays::Rough rough_glass_in(const RenderOptions& options, bool estimates) {
  if (options.bounces == 0) return PassedRays::Rough::sharp;
  return estimates ? PassedRays::Rough::random : PassedRays::Rough::blurred;
}

}  // namespace

FrameSurfaces::FrameSurfaces(const Scene& scene, const RenderOptions& options, const SceneParts& parts, const ClassicTable* fitted,
                             bool estimates)
    : scene_(scene),
      options_(options),
      camera_(find_camera(scene, options.camera), options.width, options.height),
      rays_(parts.rays),
      environment_(prepare_environment(fitted)),
      environment_shadows_(environment_ != nullptr && options.shadows != Shadows::off
                               ? std::make_unique<const environment::EnvironmentShadows>(*environment_, scene, *rays_, options)
                               : nullptr),
      maps_(parts.maps),
      shading_{surface_packs_for(active_simd()), options.shadows != Shadows::off ? options.terminator : Terminator::strict, maps_.get(),
               camera_.steps(options.aa)},
      passed_(scene, *rays_, shading_, background(), rough_glass_in(options, estimates)),
      tiles_x_((options.width + kTileSide - 1) / kTileSide),
      tiles_y_((options.height + kTileSide - 1) / kTileSide) {
  halves_of_rays_.resize(static_cast<std::size_t>(tile_count()));
}

std::unique_ptr<const environment::EnvironmentLight> FrameSurfaces::prepare_environment(const ClassicTable* fitted) {
  if (!scene_.environment) return nullptr;
  const auto start = Clock::now();
  auto light = std::make_unique<const environment::EnvironmentLight>(scene_, fitted);
  environment_build_ms_ = ms_since(start);
  return light;
}

PassedRays::Background FrameSurfaces::background() const {
  if (environment_ == nullptr || !options_.background) return {};
  return [this](Vec3f direction) { return environment_->background(direction); };
}

std::span<const AreaLight> FrameSurfaces::environment_spots() const {
  return environment_ ? std::span<const AreaLight>(environment_->spots()) : std::span<const AreaLight>();
}

TileArea FrameSurfaces::area(int index) const {
  const int x = index % tiles_x_ * kTileSide, y = index / tiles_x_ * kTileSide;
  return {x, y, std::min(kTileSide, options_.width - x), std::min(kTileSide, options_.height - y)};
}

TilePlane FrameSurfaces::fill(int index, int sample, SurfaceTile& tile, const TilePlane* behind) {
  TileHits hits;
  tile.seed = seed(index, sample);
  rays_clock_.run([&] { trace_tile(*rays_, camera_, area(index), pixel_place(sample, options_.aa), hits, behind); });
  gbuffer_clock_.run([&] {
    const float offset = rays_->offset_from_edges();
    for (std::size_t i = 0; i < kTilePixels; ++i)
      if (hits.geometry[i] != RTC_INVALID_GEOMETRY_ID)
        keep_within(scene_.meshes[hits.geometry[i]], hits.triangle[i], offset, hits.u[i], hits.v[i]);
    shade_tile(scene_, shading_, hits, tile);
    if (environment_ && options_.background) show_background(hits.direction, tile, behind);
  });
  TilePlane distances{};
  std::copy(hits.distance.begin(), hits.distance.end(), distances.begin());
  return distances;
}

void FrameSurfaces::fill_behind(int index, int sample, SurfaceTile& tile, PassedRays::Ways& ways) {
  ways.behind = fill(index, sample, tile, &ways.behind);
  passed_.fill(ways, PassedRays::Lamps::shown, tile);
}

void FrameSurfaces::add_background(int index, int sample, SurfaceTile& tile) const {
  if (!environment_ || !options_.background) return;
  const TileArea a = area(index);
  const PixelPlace place = pixel_place(sample, options_.aa);
  TileVector directions;
  for (int y = 0; y < kTileSide; ++y)
    for (int x = 0; x < kTileSide; ++x) {
      const Vec3f to = camera_.direction(static_cast<float>(a.x + x) + place.x, static_cast<float>(a.y + y) + place.y);
      const std::size_t i = tile_slot(x, y);
      directions.x[i] = to.x;
      directions.y[i] = to.y;
      directions.z[i] = to.z;
    }
  show_background(directions, tile, nullptr);
}

void FrameSurfaces::show_background(const TileVector& directions, SurfaceTile& tile, const TilePlane* behind) const {
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (tile.material[i] != nullptr || (behind != nullptr && !((*behind)[i] > 0))) continue;
    const Vec3f seen = environment_->background({directions.x[i], directions.y[i], directions.z[i]});
    tile.radiance.x[i] = seen.x;
    tile.radiance.y[i] = seen.y;
    tile.radiance.z[i] = seen.z;
  }
}

void FrameSurfaces::add_environment(int sample, SurfaceTile& tile, environment::HalvesOfRays& halves) {
  if (!environment_) return;
  const auto view = [&](std::size_t i) { return get(tile.view, i); };
  const auto add = [&](std::size_t i, Vec3f r) {
    tile.radiance.x[i] += r.x;
    tile.radiance.y[i] += r.y;
    tile.radiance.z[i] += r.z;
  };
  environment_clock_.run([&] {
    if (environment_shadows_ == nullptr) {
      for (std::size_t i = 0; i < kTilePixels; ++i)
        if (tile.material[i] != nullptr) add(i, environment_->reflected(surface_in(tile, i), view(i)));
      return;
    }
    using environment::EnvironmentShadows;
    EnvironmentShadows::Surfaces some;
    for (std::size_t first = 0; first < kTilePixels; first += EnvironmentShadows::kLanes) {
      some.take(tile, first);
      if (some.lit == 0) continue;
      const auto reflected = environment_shadows_->reflected(some, sample, halves);
      for (std::size_t i = 0; i < EnvironmentShadows::kLanes; ++i)
        if ((some.lit >> i & 1) != 0) add(first + i, reflected[i]);
    }
  });
}

double FrameSurfaces::environment_shadow_error() const {
  environment::HalvesOfRays all;
  for (const environment::HalvesOfRays& tile : halves_of_rays_) all += tile;
  return all.relative_rms();
}

void add_to_picture(const TileVector& values, TileArea a, const TileVector* shares, float weight, std::vector<Vec3f>& pixels, int width) {
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i = tile_slot(x, y);
      const Vec3f value{values.x[i], values.y[i], values.z[i]};
      const Vec3f share = shares != nullptr ? Vec3f{shares->x[i], shares->y[i], shares->z[i]} : Vec3f{1, 1, 1};
      pixels[static_cast<std::size_t>(a.y + y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(a.x + x)] +=
          value * share * weight;
    }
}

namespace {

// Calls use(begin, end) for the numbers of the pixels of each row of a tile.
template <class Use>
void each_row(TileArea a, int width, Use use) {
  for (int y = a.y; y < a.y + a.height; ++y) {
    const auto row = static_cast<std::ptrdiff_t>(y) * width + a.x;
    use(row, row + a.width);
  }
}

}  // namespace

void clear_area(TileArea area, Picture& picture) {
  each_row(area, picture.width, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::fill(picture.pixels.begin() + begin, picture.pixels.begin() + end, Vec3f{});
    for (auto& [name, layer] : picture.layers) std::fill(layer.begin() + begin, layer.begin() + end, Vec3f{});
  });
}

void copy_area(TileArea area, const Picture& from, Picture& to) {
  each_row(area, to.width, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::copy(from.pixels.begin() + begin, from.pixels.begin() + end, to.pixels.begin() + begin);
    for (auto& [name, layer] : to.layers) {
      const std::vector<Vec3f>& other = from.layers.at(name);
      std::copy(other.begin() + begin, other.begin() + end, layer.begin() + begin);
    }
  });
}

}  // namespace steradian
