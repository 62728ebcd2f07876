#include "solve/receiving_tiles.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/float_mode.h"
#include "render/frame/frame_surfaces.h"
#include "render/radiosity/patch_solver.h"
#include "render/sampled/monte_carlo.h"
#include "render/surface/gbuffer.h"
#include "steradian/error.h"

namespace steradian::solving {

// Fitted lights keep their numbers as lights that do not shine: the meshes of other lights refer to numbers.
struct ReceivingTiles::Room {
  Scene lamp_meshes;            // only the meshes that show fitted lights
  Scene scene;                  // without them; its lights are those of the computation
  std::vector<AreaLight> area;  // all of them dark
  std::vector<AreaLight> fixed_area;
  std::vector<PunctualLight> fixed_punctual;
  RenderOptions options;
  DirectMethod method;
  SceneParts parts;
  std::shared_ptr<const radiosity::PatchLinks> links;  // of all computations; null before the first one
  tbb::task_arena arena;
  std::mutex one_at_a_time;  // of the computations, which take turns with the scene's lights and the tiles' radiance

  Room(const Scene& all, const RenderOptions& render, const std::vector<bool>& fitted)
      : lamp_meshes(only_lamps(all, fitted)),
        scene(without(all, fitted)),
        area(scene.area_lights),
        fixed_area(scene.area_lights),
        fixed_punctual(scene.punctual_lights),
        options(render),
        method(choose_method(scene, options)),
        parts(SceneParts::of(scene, options.shadows != Shadows::off ? Sorted::for_rays_and_edges : Sorted::for_rays)),
        arena(options.threads > 0 ? options.threads : static_cast<int>(tbb::info::default_concurrency())) {
    for (AreaLight& light : area) darken(light);
  }

  static void darken(AreaLight& light) {
    light.radiance = {};
    light.texture.reset();
    light.emission.reset();
  }

  static bool shows_fitted(const Mesh& mesh, const std::vector<bool>& fitted) {
    return mesh.is_light_shape && !mesh.triangle_lights.empty() && mesh.triangle_lights.front() >= 0 &&
           fitted[static_cast<std::size_t>(mesh.triangle_lights.front())];
  }
  static Scene only_lamps(const Scene& all, const std::vector<bool>& fitted) {
    Scene lamps;
    lamps.materials = all.materials;
    lamps.area_lights = all.area_lights;
    lamps.cameras = all.cameras;
    for (const Mesh& mesh : all.meshes)
      if (shows_fitted(mesh, fitted)) lamps.meshes.push_back(mesh);
    return lamps;
  }
  static Scene without(const Scene& all, const std::vector<bool>& fitted) {
    Scene left = all;
    std::erase_if(left.meshes, [&](const Mesh& mesh) { return shows_fitted(mesh, fitted); });
    for (std::size_t i = 0; i < left.area_lights.size(); ++i)
      if (fitted[i]) darken(left.area_lights[i]);
    std::vector<PunctualLight> punctual;
    for (std::size_t i = 0; i < left.punctual_lights.size(); ++i)
      if (!fitted[left.area_lights.size() + i]) punctual.push_back(left.punctual_lights[i]);
    left.punctual_lights = std::move(punctual);
    return left;
  }

  void take_fixed_lights() {
    scene.area_lights = fixed_area;
    scene.punctual_lights = fixed_punctual;
  }
  // Takes lamps instead of the scene's lights. Returns the number of the first.
  std::size_t take(const Lamps& lamps) {
    scene.area_lights = area;
    scene.area_lights.insert(scene.area_lights.end(), lamps.area.begin(), lamps.area.end());
    scene.punctual_lights = lamps.punctual;
    return area.size();
  }
};

ReceivingTiles::ReceivingTiles(const Scene& scene, const RenderOptions& options, const std::vector<bool>& fitted)
    : room_(std::make_unique<Room>(scene, options, fitted)) {
  if (room_->method.estimates()) throw Error("--method", options.method + " samples the light, whose noise a fit would follow", "use auto");
}
ReceivingTiles::~ReceivingTiles() = default;

void ReceivingTiles::each(std::size_t count, const std::function<void(std::size_t)>& work) const {
  room_->arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const FlushDenormals flush;
      work(i);
    });
  });
}

namespace {

// Leaves a part of a tile's light, and widens its specular lobes.
void restrict_to(LightPart part, float least_alpha, SurfaceTile& tile) {
  for (TilePlane* plane : {&tile.alpha_x, &tile.alpha_y, &tile.coat_alpha})
    for (float& alpha : *plane) alpha = std::max(alpha, least_alpha);
  const auto clear = [](TileVector& v) {
    for (TilePlane* plane : {&v.x, &v.y, &v.z}) plane->fill(0);
  };
  if (part == LightPart::specular) {
    clear(tile.albedo);
    tile.any_diffuse = false;
  }
  if (part == LightPart::diffuse) {
    for (TileVector* v : {&tile.f0, &tile.f90, &tile.sheen}) clear(*v);
    tile.coat.fill(0);
    tile.any_specular = tile.any_coat = tile.any_sheen = tile.any_override = false;
  }
}

// True for a slot that shows a surface by its own light: neither a lamp nor what light passes.
bool counts(const SurfaceTile& tile, std::size_t slot) {
  return tile.material[slot] != nullptr && !tile.material[slot]->emits() && !(tile.any_passing && weighs(get(tile.passes, slot)));
}

}  // namespace

// A camera's surfaces, which change with their materials.
struct ReceivingTiles::View {
  RenderOptions options;
  LightPart part;
  float least_alpha;
  std::size_t first_tile;
  FrameSurfaces surfaces;

  View(const Room& room, RenderOptions render, LightPart which, float alpha, std::size_t first)
      : options(std::move(render)),
        part(which),
        least_alpha(alpha),
        first_tile(first),
        surfaces(room.scene, options, room.parts, room.method.table.get()) {}
  std::size_t tile_count() const { return static_cast<std::size_t>(surfaces.tile_count()); }
};

void ReceivingTiles::fill(View& view) const {
  each(view.tile_count(), [&](std::size_t index) {
    SurfaceTile& tile = *tiles_[view.first_tile + index].surfaces;
    view.surfaces.fill(static_cast<int>(index), 0, tile);
    restrict_to(view.part, view.least_alpha, tile);
    view.surfaces.add_environment(static_cast<int>(index), 0, tile);
  });
}

void ReceivingTiles::add_camera(const std::string& camera, int width, int height, LightPart part, float least_alpha) {
  RenderOptions options = room_->options;
  options.camera = camera;
  options.width = width;
  options.height = height;
  View& view = *views_.emplace_back(std::make_unique<View>(*room_, options, part, least_alpha, tiles_.size()));
  for (std::size_t i = 0; i < view.tile_count(); ++i) tiles_.emplace_back().surfaces = std::make_unique<SurfaceTile>();
  fill(view);
  each(view.tile_count(), [&](std::size_t index) {
    ReceivingTile& tile = tiles_[view.first_tile + index];
    tile.value.fill(kNoValue);
    const TileArea a = view.surfaces.area(static_cast<int>(index));
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        if (const std::size_t slot = tile_slot(x, y); counts(*tile.surfaces, slot))
          tile.value[slot] = static_cast<std::uint32_t>((a.y + y) * width + a.x + x);
  });
}

void ReceivingTiles::take_materials(const std::vector<SurfaceMaterial>& materials) const {
  Room& room = *room_;
  if (materials.empty() || materials == room.scene.materials) return;
  std::copy(materials.begin(), materials.end(), room.scene.materials.begin());  // in place: tiles point to them
  room.links.reset();
  room.take_fixed_lights();
  for (const auto& view : views_) {
    fill(*view);
    add_fixed_light(view->first_tile, view->first_tile + view->tile_count());
  }
}

std::vector<char> ReceivingTiles::pixels_of_fitted(const std::string& camera, int width, int height) const {
  std::vector<char> shown(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  if (room_->lamp_meshes.meshes.empty()) return shown;
  RenderOptions options = room_->options;
  options.camera = camera;
  options.width = width;
  options.height = height;
  const SceneParts parts = SceneParts::of(room_->lamp_meshes, Sorted::for_rays);
  FrameSurfaces surfaces(room_->lamp_meshes, options, parts);
  each(static_cast<std::size_t>(surfaces.tile_count()), [&](std::size_t index) {
    const auto tile = std::make_unique<SurfaceTile>();
    surfaces.fill(static_cast<int>(index), 0, *tile);
    const TileArea a = surfaces.area(static_cast<int>(index));
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        if (tile->material[tile_slot(x, y)] != nullptr)
          shown[static_cast<std::size_t>(a.y + y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(a.x + x)] = 1;
  });
  return shown;
}

void ReceivingTiles::add_points(const std::vector<Vec3d>& points, const std::vector<Vec3d>& normals) {
  static const SurfaceMaterial white;
  for (std::size_t first = 0; first < points.size(); first += kTilePixels) {
    ReceivingTile& tile = tiles_.emplace_back();
    tile.surfaces = std::make_unique<SurfaceTile>();
    tile.value.fill(kNoValue);
    clear_kinds(*tile.surfaces);
    tile.surfaces->seed = tiles_.size();
    for (std::size_t i = 0; i < kTilePixels; ++i) put_nothing(*tile.surfaces, i);
    for (std::size_t i = 0; i < std::min(kTilePixels, points.size() - first); ++i) {
      Surface s;
      s.position = static_cast<Vec3f>(points[first + i]);
      s.normal = s.geometric_normal = s.coat_normal = static_cast<Vec3f>(normals[first + i]);
      s.tangent = static_cast<Vec3f>(Frame::from_normal(normals[first + i]).x);
      s.albedo = {1, 1, 1};
      s.material = &white;
      put_surface(*tile.surfaces, i, s, s.normal);
      tile.value[i] = static_cast<std::uint32_t>(first + i);
    }
  }
}

// Lights tiles by the lights of a scene, one by one, on one set of structures.
class ReceivingTiles::LampTable {
 public:
  LampTable(const Scene& scene, const RenderOptions& options, const DirectMethod& method, const SceneParts& parts)
      : lights_(prepare_lights(scene)),
        lighting_(scene, options, method, lights_, parts, nullptr),
        shadows_(options.shadows != Shadows::off),
        by_rays_(options.bounces != 0 && options.quality != Quality::high) {
    by_number_.assign(scene.area_lights.size() + scene.punctual_lights.size(), nullptr);
    std::size_t punctual = scene.area_lights.size();
    for (const PackLight& light : lights_) {  // dark lights and those without extent have none
      if (light.area != nullptr) {
        by_number_[static_cast<std::size_t>(light.area - scene.area_lights.data())] = &light;
        continue;
      }
      while (!weighs(static_cast<Vec3f>(scene.punctual_lights[punctual - scene.area_lights.size()].intensity))) ++punctual;
      by_number_[punctual++] = &light;
    }
  }

  std::size_t count() const { return by_number_.size(); }
  bool shines() const { return !lights_.empty(); }

  enum class For { values, patches };
  void add(std::size_t number, SurfaceTile& tile, For purpose) {
    if (by_number_[number] == nullptr) return;
    const PackLight* const one[] = {by_number_[number]};
    const ReachingLights reaching = lights_reaching(one, tile);
    if (reaching.lights.empty()) return;
    if (!shadows_) {
      lighting_.add(tile, reaching.lights);
    } else if (purpose == For::patches && by_rays_) {
      EstimatedShadows* estimate = estimates_.local().get();
      estimate->clear();
      lighting_.add_shadowed_by_rays(tile, reaching.lights, FewRays::kMost, 0, *estimate);
    } else {
      lighting_.add_shadowed(tile, reaching.lights);
    }
  }

 private:
  std::vector<PackLight> lights_;
  TileLighting lighting_;
  bool shadows_, by_rays_;
  std::vector<const PackLight*> by_number_;
  tbb::enumerable_thread_specific<std::unique_ptr<EstimatedShadows>> estimates_{[] { return std::make_unique<EstimatedShadows>(); }};
};

namespace {

void clear(TileVector& v) {
  for (TilePlane* plane : {&v.x, &v.y, &v.z}) plane->fill(0);
}

// A scene of some lights alone, by their numbers, with the images of textured ones.
Scene only_lights(const Scene& scene, std::size_t first, std::size_t last) {
  Scene lights;
  const std::size_t area = scene.area_lights.size();
  for (std::size_t number = first; number < last; ++number)
    if (number < area)
      lights.area_lights.push_back(scene.area_lights[number]);
    else
      lights.punctual_lights.push_back(scene.punctual_lights[number - area]);
  if (std::any_of(lights.area_lights.begin(), lights.area_lights.end(), [](const AreaLight& l) { return l.texture.has_value(); }))
    lights.images = scene.images;
  return lights;
}

// Adds the light that patches send to a tile's surfaces.
void add_gathered(const radiosity::Gather& gather, const SurfaceTile& tile, TileVector& light) {
  SixteenSurfaces some;
  for (std::size_t first = 0; first < kTilePixels; first += SixteenSurfaces::kLanes) {
    some.take(tile, first);
    if (some.lit == 0) continue;
    const radiosity::Gather::Result result = gather.reflected(some, 0, {false, true});
    for (std::size_t i = 0; i < SixteenSurfaces::kLanes; ++i) put(light, first + i, get(light, first + i) + result.radiance[i]);
  }
}

}  // namespace

bool ReceivingTiles::has_slopes() const {
  return room_->options.shadows == Shadows::off && room_->options.bounces == 0 && room_->method.ggx == Method::closed_form &&
         std::none_of(tiles_.begin(), tiles_.end(), [](const ReceivingTile& tile) {
           return tile.surfaces->any_sheen || tile.surfaces->any_coat || tile.surfaces->any_override;
         });
}

void ReceivingTiles::add_fixed_light(std::size_t first, std::size_t last) const {
  Room& room = *room_;
  LampTable table(room.scene, room.options, room.method, room.parts);
  if (!table.shines()) return;
  each(last - first, [&](std::size_t index) {
    for (std::size_t number = 0; number < table.count(); ++number)
      table.add(number, *tiles_[first + index].surfaces, LampTable::For::values);
  });
  if (room.options.bounces != 0)
    add_bounces(table, 0, table.count(), [&](std::size_t index) -> TileVector& { return tiles_[index].surfaces->radiance; });
}

void ReceivingTiles::add_fixed_light() { add_fixed_light(0, tiles_.size()); }

// One block of each square of factor x factor, in its middle.
bool ReceivingTiles::is_coarse_slot(std::size_t slot, int factor) {
  constexpr std::size_t kBlock = 16, kAcross = kTileSide / 4;
  const std::size_t block = slot / kBlock, step = static_cast<std::size_t>(factor);
  return block % kAcross % step == step / 2 && block / kAcross % step == step / 2;
}

void ReceivingTiles::add_coarse(std::size_t first, std::size_t last, int factor) {
  std::size_t filled = kTilePixels;
  for (std::size_t number = first; number < last; ++number)
    for (std::size_t slot = 0; slot < kTilePixels; ++slot) {
      if (!is_coarse_slot(slot, factor)) continue;
      if (filled == kTilePixels) {
        ReceivingTile& tile = tiles_.emplace_back();
        tile.surfaces = std::make_unique<SurfaceTile>();
        tile.surfaces->seed = tiles_.size();
        tile.value.fill(kNoValue);
        clear_kinds(*tile.surfaces);
        for (std::size_t i = 0; i < kTilePixels; ++i) put_nothing(*tile.surfaces, i);
        filled = 0;
      }
      const ReceivingTile& from = tiles_[number];
      if (from.value[slot] != kNoValue) {
        ReceivingTile& to = tiles_.back();
        put_surface(*to.surfaces, filled, surface_in(*from.surfaces, slot), get(from.surfaces->view, slot));
        put(to.surfaces->radiance, filled, get(from.surfaces->radiance, slot));
        to.value[filled] = from.value[slot];
      }
      ++filled;
    }
}

void ReceivingTiles::add_bounces(LampTable& table, std::size_t first, std::size_t last,
                                 const std::function<TileVector&(std::size_t)>& light) const {
  Room& room = *room_;
  const Scene lamps = only_lights(room.scene, first, last);
  // One quality below that of a picture: each lamp has patches of its own, and their light differs by 1e-3 from that of finer ones.
  const Quality quality = room.options.quality == Quality::high ? Quality::normal : Quality::draft;
  tbb::enumerable_thread_specific<std::unique_ptr<DirectSampler>> samplers([&] {
    return std::make_unique<DirectSampler>(lamps, room.options.shadows != Shadows::off ? room.parts.rays.get() : nullptr, nullptr,
                                           room.options.terminator, room.method.table.get());
  });
  room.arena.execute([&] {
    const auto direct = [&](SurfaceTile& tile) {
      if (!tile.any_surface) return;
      for (std::size_t number = first; number < last; ++number) table.add(number, tile, LampTable::For::patches);
    };
    // Glossy surfaces send the light of few lamps on in its directions, and of many evenly.
    const auto incident = [&](const Surface& surface, std::uint64_t number, std::vector<IncidentLight>& found) {
      constexpr std::size_t kMostLights = 64;
      DirectSampler& sampler = *samplers.local();
      if (sampler.light_count() == 0 || sampler.light_count() > kMostLights) return;
      reference::Random random(number);
      sampler.find_incident(surface, 16, random, found);
    };
    const radiosity::Fineness fineness = radiosity::fineness_of(quality);
    const radiosity::PatchLight patches = radiosity::solve_patches(room.scene, *room.parts.rays, *room.parts.maps,
                                                                   {room.options.bounces, fineness}, direct, incident, &room.links);
    const radiosity::Gather gather(patches, *room.parts.rays, fineness, {room.options.bounce_error, room.options.bounce_strict});
    each(tiles_.size(), [&](std::size_t index) { add_gathered(gather, *tiles_[index].surfaces, light(index)); });
  });
}

void ReceivingTiles::light(const Lamps& lamps, const std::vector<std::size_t>& numbers,
                           const std::function<void(std::size_t, const TileLight&)>& use) const {
  Room& room = *room_;
  const std::lock_guard<std::mutex> lock(room.one_at_a_time);
  take_materials(lamps.materials);
  const std::size_t first = room.take(lamps);
  LampTable table(room.scene, room.options, room.method, room.parts);
  const auto direct = [&](std::size_t index, TileLight& light) {
    SurfaceTile& tile = *tiles_[index].surfaces;
    const TileVector fixed = tile.radiance;
    for (std::size_t lamp = 0; lamp < light.size(); ++lamp) {
      clear(tile.radiance);
      table.add(first + lamp, tile, LampTable::For::values);
      light[lamp] = tile.radiance;
    }
    tile.radiance = fixed;
  };
  if (room.options.bounces == 0) {
    each(numbers.size(), [&](std::size_t i) {
      TileLight light(lamps.count());
      direct(numbers[i], light);
      use(numbers[i], light);
    });
    return;
  }
  std::vector<TileLight> all(tiles_.size(), TileLight(lamps.count()));
  each(tiles_.size(), [&](std::size_t index) { direct(index, all[index]); });
  for (std::size_t lamp = 0; lamp < lamps.count(); ++lamp)
    add_bounces(table, first + lamp, first + lamp + 1, [&](std::size_t index) -> TileVector& { return all[index][lamp]; });
  for (const std::size_t index : numbers) use(index, all[index]);
}

}  // namespace steradian::solving
