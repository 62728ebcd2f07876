#include "render/frame/tile_lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/lattices.h"
#include "render/direct/lobe_packs.h"
#include "render/frame/uneven_diffuse.h"
#include "render/surface/gbuffer.h"
#include "steradian/area_light.h"  // luminance

namespace steradian {
namespace {

Vec3f radiance_in(const SurfaceTile& tile, std::size_t i) { return {tile.radiance.x[i], tile.radiance.y[i], tile.radiance.z[i]}; }
void add_radiance(SurfaceTile& tile, std::size_t i, Vec3f r) {
  tile.radiance.x[i] += r.x;
  tile.radiance.y[i] += r.y;
  tile.radiance.z[i] += r.z;
}

// With fewer occluded lights, hardly any is so dim that its shadow need not be exact.
constexpr std::size_t kFewestLights = 8;
constexpr std::size_t kRaysOfDimLight = 4;

float largest(Vec3f v) { return std::max({v.x, v.y, v.z}); }

// Adds a fraction of the light `all` that a slot would get without occluders, and the bound of its error.
void add_estimated(SurfaceTile& tile, std::size_t i, Vec3f all, const RayFractions& fractions, EstimatedShadows& estimate) {
  add_radiance(tile, i, all * fractions.visible[i]);
  const float most = std::max(fractions.visible[i], 1 - fractions.visible[i]);
  estimate.bound.x[i] += all.x * most;
  estimate.bound.y[i] += all.y * most;
  estimate.bound.z[i] += all.z * most;
  const double error = luminance(static_cast<Vec3d>(all)) * static_cast<double>(fractions.half_difference[i]);
  estimate.squares += error * error;
}

// The fraction that arrives at a slot that sees all of the light, or a fraction by rays; 0 at the others.
float whole_fraction(const TileShadow& shadow, std::size_t i) {
  using Seen = TileShadow::Seen;
  return shadow.seen[i] == Seen::whole ? 1.0f : shadow.seen[i] == Seen::share ? shadow.share[i] : 0.0f;
}

std::vector<std::uint32_t> slots_with_surfaces(const SurfaceTile& tile) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < kTilePixels; ++i)
    if (tile.material[i] != nullptr) slots.push_back(i);
  return slots;
}

Box3f box_of(const SurfaceTile& tile) {
  Box3f positions;
  for (std::uint32_t i = 0; i < kTilePixels; ++i)
    if (tile.material[i] != nullptr) positions.add(get(tile.position, i));
  return positions;
}

// More lights than these share the rays of so many, in proportion to the light that they send to the tile.
constexpr std::size_t kLightsWithAllRays = 4;
constexpr std::size_t kFewestRays = 4;  // of a light
// Beyond these, a few lights in proportion to what they send find the visible fraction of all.
constexpr std::size_t kLightsOfTheirOwn = 64;

std::size_t rays_by_share(std::size_t rays, double share) {
  const auto half = static_cast<std::size_t>(share * static_cast<double>(kLightsWithAllRays * rays) / 2);
  return std::clamp(2 * half, std::min(rays, kFewestRays), rays);
}

}  // namespace

void EstimatedShadows::clear() {
  for (TilePlane* plane : {&bound.x, &bound.y, &bound.z}) plane->fill(0);
  squares = 0;
}

// The light that an area light sends to every slot, as if nothing occluded it, and with that of all dimmer ones.
struct TileLighting::WholeLight {
  const PackLight* light = nullptr;
  std::array<Vec3f, kTilePixels> all{}, with_dimmer{};
  double sum = 0;
};

// State of one tile's shadows, and the memory of one thread.
struct TileLighting::Work {
  TileShadow shadow;
  ShadowCounts counts;
  OpenLights::Work open;
  PackLight pieces;                  // visible parts of a light, for some slots
  RayFractions fractions;            // of one light
  std::vector<WholeLight> whole;     // of occluded lights, the brightest first
  std::vector<std::uint32_t> slots;  // slots copied to `some`, side by side
  SurfaceTile some;
  SurfaceTile coats;                 // coats that have a normal of their own
  std::size_t filled = kTilePixels;  // slots of `some` that may hold a surface
};

TileLighting::TileLighting(const Scene& scene, const RenderOptions& options, const DirectMethod& method,
                           const std::vector<PackLight>& lights, const SceneParts& parts, ManyLightPass* many_lights)
    : options_(options),
      method_(method),
      many_lights_(many_lights),
      packs_(lobe_packs_for(active_simd())),
      specular_(method),
      rays_(parts.rays),
      work_([] { return std::make_shared<Work>(); }) {
  if (options.shadows != Shadows::off && !method.estimates()) shadows_.emplace(scene, lights, parts, options.shadows);
  area_lights_ = static_cast<std::size_t>(std::count_if(lights.begin(), lights.end(), [](const PackLight& l) { return l.is_area(); }));
  if (shadows_ && (options.time_limit > 0 || options.bounces != 0 || may_estimate())) {
    few_rays_.emplace(*rays_, lights);
    if (area_lights_ > kLightsOfTheirOwn || may_estimate()) choice_.emplace(lights);
  }
}

bool TileLighting::bounds_shadows() const { return shadows_ && options_.shadows == Shadows::on && options_.shadow_error > 0; }

bool TileLighting::may_estimate() const { return bounds_shadows() && area_lights_ >= kFewestLights; }

// plain: lights whose diffuse light is still to be added.
void TileLighting::add_many(SurfaceTile& tile, const std::vector<const PackLight*>& lights, const std::vector<const PackLight*>& plain) {
  if (method_.exact_diffuse && tile.any_diffuse && !plain.empty())
    direct_clock_.run([&] {
      const std::vector<const PackLight*> even = even_ones(plain);
      if (!even.empty()) packs_.add_diffuse(tile, even.data(), even.size());
      if (even.size() < plain.size()) add_diffuse_from_uneven(tile, plain);
    });
  const SpecularPass::Far far = {many_lights_->lights(), many_lights_->error(), many_lights_->bound()};
  specular_clock_.run([&] { specular_.add(tile, lights, SpecularPass::Walk::specular_alone, &far); });
}

void TileLighting::add(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
  constexpr std::size_t kFew = 8;  // lights that are summed before cells are built
  if (many_lights_ != nullptr && lights.size() > kFew) {
    std::vector<const PackLight*> plain;
    if (method_.exact_diffuse && tile.any_diffuse) direct_clock_.run([&] { plain = many_lights_->add_to_tile(tile, lights); });
    return add_many(tile, lights, plain);
  }
  if (method_.exact_diffuse && tile.any_diffuse)
    direct_clock_.run([&] {
      std::vector<const PackLight*> plain = even_ones(lights);
      if (!method_.estimates()) std::erase_if(plain, [&](const PackLight* light) { return specular_.brings_diffuse(tile, *light); });
      if (!plain.empty()) packs_.add_diffuse(tile, plain.data(), plain.size());
      if (plain.size() < lights.size()) add_diffuse_from_uneven(tile, lights);
    });
  if (!method_.estimates()) specular_clock_.run([&] { specular_.add(tile, lights); });
}

// Calls add(tile) for the surfaces, and for their coats that have a normal of their own.
template <class Add>
void TileLighting::with_coats(SurfaceTile& tile, Work& work, Add add) {
  const bool coats = tile.any_coat && take_coats(tile, work.coats);
  add(tile);
  if (!coats) return;
  add(work.coats);
  put_back_coats(work.coats, tile);
}

void TileLighting::add_shadowed(SurfaceTile& tile, const std::vector<const PackLight*>& lights, int sample, EstimatedShadows* estimate) {
  if (lights.empty()) return;
  Work& work = *work_.local();
  with_coats(tile, work, [&](SurfaceTile& to) {
    const std::vector<const PackLight*> plain = estimate != nullptr && many_seem_dim(to, lights)
                                                    ? add_within_error(to, lights, sample, work, *estimate)
                                                    : add_past_blockers(to, lights, work);
    if (!plain.empty()) add(to, plain);
  });
}

// True if the rays of dim lights are likely to save more time than it takes to find which lights are dim.
bool TileLighting::many_seem_dim(const SurfaceTile& tile, const std::vector<const PackLight*>& lights) const {
  constexpr std::size_t kOneOf = 4;
  if (!tile.any_surface || lights.size() < kFewestLights) return false;
  return kOneOf * choice_->dim_count(lights, box_of(tile), options_.shadow_error) >= lights.size();
}

void TileLighting::add_shadowed_by_rays(SurfaceTile& tile, const std::vector<const PackLight*>& lights, std::size_t rays, int sample,
                                        EstimatedShadows& estimate) {
  if (lights.empty()) return;
  Work& work = *work_.local();
  with_coats(tile, work, [&](SurfaceTile& to) { add_by_rays(to, lights, rays, sample, work, estimate); });
}

void TileLighting::add_by_rays(SurfaceTile& tile, const std::vector<const PackLight*>& lights, std::size_t rays, int sample, Work& work,
                               EstimatedShadows& estimate) {
  const auto areas = static_cast<std::size_t>(std::count_if(lights.begin(), lights.end(), [](const PackLight* l) { return l->is_area(); }));
  const bool by_chosen = areas > kLightsOfTheirOwn;
  TilePoints points;
  shadow_clock_.run([&] {
    points = points_for_shadows(tile, *rays_, options_.terminator);
    if (!by_chosen) shadows_->find_open(points, lights, work.open);
  });
  std::vector<const PackLight*> plain, punctual, chosen_from;
  std::vector<WholeLight>& whole = work.whole;
  whole.clear();
  for (const PackLight* light : lights) {
    if (!light->is_area())
      punctual.push_back(light);  // one ray decides
    else if (by_chosen)
      chosen_from.push_back(light);
    else if (work.open.open[light->index] != 0)
      plain.push_back(light);
    else
      whole.emplace_back().light = light;
  }
  if (by_chosen) add_by_chosen(tile, points, chosen_from, kLightsWithAllRays * rays, sample, work, estimate);
  if (by_chosen) whole.clear();
  const std::vector<std::uint32_t> slots = find_whole(tile, work);
  double sum = 0;
  for (const WholeLight& w : whole) sum += w.sum;
  for (const WholeLight& w : whole) {
    if (!(w.sum > 0)) continue;
    const std::size_t count = whole.size() <= kLightsWithAllRays ? rays : rays_by_share(rays, w.sum / sum);
    shadow_clock_.run([&] { few_rays_->find(tile, points, *w.light, count, sample, work.fractions); });
    for (const std::uint32_t i : slots) add_estimated(tile, i, w.all[i], work.fractions, estimate);
  }
  for (const PackLight* light : add_past_blockers(tile, punctual, work)) plain.push_back(light);
  if (!plain.empty()) add(tile, plain);
}

// The light of all without occluders, times the visible fraction of a few.
void TileLighting::add_by_chosen(SurfaceTile& tile, const TilePoints& points, const std::vector<const PackLight*>& lights,
                                 std::size_t count, int sample, Work& work, EstimatedShadows& estimate) {
  const Box3f positions = box_of(tile);
  const double turn = 0.5 + kGolden * (sample == FewRays::kPlacesOfEach ? static_cast<double>(tile.seed) : sample);
  const std::vector<LightChoice::Chosen> chosen = choice_->choose(lights, positions, count, turn - std::floor(turn));
  work.whole.clear();
  for (const LightChoice::Chosen& c : chosen) work.whole.emplace_back().light = c.light;
  const std::vector<std::uint32_t> slots = find_whole(tile, work);

  const TileVector before = std::exchange(tile.radiance, {});
  add(tile, lights);
  const TileVector all = std::exchange(tile.radiance, before);

  std::array<std::array<double, 2>, kTilePixels> seen{}, sent{};  // by half
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const WholeLight& whole = work.whole[k];
    if (!(whole.sum > 0)) continue;
    const std::size_t rays = std::min(chosen[k].times, FewRays::kMost);
    shadow_clock_.run([&] { few_rays_->find(tile, points, *whole.light, rays, sample, work.fractions); });
    for (const std::uint32_t i : slots) {
      const double light = luminance(static_cast<Vec3d>(whole.all[i])) * chosen[k].weight * static_cast<double>(chosen[k].times);
      sent[i][k % 2] += light;
      seen[i][k % 2] += light * static_cast<double>(work.fractions.visible[i]);
    }
  }
  for (const std::uint32_t i : slots) {
    const auto ratio = [](double part, double whole) { return static_cast<float>(whole > 0 ? part / whole : 1.0); };
    work.fractions.visible[i] = ratio(seen[i][0] + seen[i][1], sent[i][0] + sent[i][1]);
    work.fractions.half_difference[i] = 0.5f * (ratio(seen[i][0], sent[i][0]) - ratio(seen[i][1], sent[i][1]));
    add_estimated(tile, i, get(all, i), work.fractions, estimate);
  }
}

std::vector<const PackLight*> TileLighting::hand_over_shadows(SurfaceTile& tile, const std::vector<const PackLight*>& lights,
                                                              ShadowTaker& taker) {
  if (lights.empty() || !shadows_) return lights;
  return add_past_blockers(tile, lights, *work_.local(), &taker);
}

void TileLighting::add_at(SurfaceTile& tile, const TilePoints& points, const PackLight& light) {
  Work& work = *work_.local();
  shadow_clock_.run([&] { shadows_->find_at(points, light, work.shadow, work.counts); });
  add_whole(tile, light, work);
  add_parts(tile, light, work);
}

// Returns the lights that nothing occludes; the caller adds them as usual. For the others, evaluates the slots that see all of the light or
// a part of it, side by side.
std::vector<const PackLight*> TileLighting::add_past_blockers(SurfaceTile& tile, const std::vector<const PackLight*>& lights, Work& work,
                                                              ShadowTaker* taker) {
  TilePoints points;
  shadow_clock_.run([&] {
    points = points_for_shadows(tile, *rays_, options_.terminator);
    shadows_->find_open(points, lights, work.open);
  });
  std::vector<const PackLight*> plain;
  for (const PackLight* light : lights) {
    if (work.open.open[light->index] != 0) {
      plain.push_back(light);
      continue;
    }
    if (is_late_ && light->is_area() && is_late_()) return {};
    shadow_clock_.run([&] { shadows_->find(tile, points, *light, work.shadow, work.counts, taker); });
    if (work.shadow.is_plain() && !light->is_pieces()) {
      plain.push_back(light);
      continue;
    }
    if (taker != nullptr) shadow_clock_.run([&] { taker->take(*light, work.shadow); });
    add_whole(tile, *light, work);
    add_parts(tile, *light, work);
  }
  return plain;
}

// Returns the lights that the caller adds as usual: none, or all that nothing occludes. Of the occluded ones, the brightest have exact
// shadows, at each pixel up to the first after which all others together send at most the permitted fraction of its light.
std::vector<const PackLight*> TileLighting::add_within_error(SurfaceTile& tile, const std::vector<const PackLight*>& lights, int sample,
                                                             Work& work, EstimatedShadows& estimate) {
  TilePoints points;
  shadow_clock_.run([&] {
    points = points_for_shadows(tile, *rays_, options_.terminator);
    shadows_->find_open(points, lights, work.open);
  });
  std::vector<const PackLight*> plain, occluded;
  std::vector<WholeLight>& whole = work.whole;
  whole.clear();
  for (const PackLight* light : lights) {
    if (work.open.open[light->index] != 0)
      plain.push_back(light);
    else if (light->is_area() && light->solid == nullptr)
      whole.emplace_back().light = light;
    else
      occluded.push_back(light);  // one ray, or one outline
  }
  if (whole.size() < kFewestLights) return add_past_blockers(tile, lights, work);
  for (const PackLight* light : add_past_blockers(tile, occluded, work)) plain.push_back(light);
  if (!plain.empty()) add(tile, plain);

  const std::vector<std::uint32_t> slots = find_whole(tile, work);
  std::stable_sort(whole.begin(), whole.end(), [](const WholeLight& a, const WholeLight& b) { return a.sum > b.sum; });
  for (std::size_t k = whole.size(); k-- > 0;)
    for (const std::uint32_t i : slots)
      whole[k].with_dimmer[i] = k + 1 < whole.size() ? whole[k].all[i] + whole[k + 1].with_dimmer[i] : whole[k].all[i];

  const auto error = static_cast<float>(options_.shadow_error);
  std::array<std::size_t, kTilePixels> dim;  // by slot: the first light whose shadow need not be exact
  dim.fill(whole.size());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    WholeLight& w = whole[k];
    const auto needs_no_more = [&](std::uint32_t i) { return largest(w.with_dimmer[i]) <= error * largest(radiance_in(tile, i)); };
    points.groups.remove([&](std::uint32_t i) {
      if (!needs_no_more(i)) return false;
      dim[i] = k;
      return true;
    });
    if (points.groups.groups.empty()) break;
    shadow_clock_.run([&] { shadows_->find(tile, points, *w.light, work.shadow, work.counts); });
    for (const std::uint32_t i : slots) add_radiance(tile, i, w.all[i] * whole_fraction(work.shadow, i));
    add_parts(tile, *w.light, work);
  }
  for (std::size_t k = 0; k < whole.size(); ++k) {
    const WholeLight& w = whole[k];
    if (!(w.sum > 0)) break;  // nor do the others send any
    if (std::none_of(slots.begin(), slots.end(), [&](std::uint32_t i) { return dim[i] <= k; })) continue;
    shadow_clock_.run([&] { few_rays_->find(tile, points, *w.light, kRaysOfDimLight, sample, work.fractions); });
    for (const std::uint32_t i : slots) {
      if (dim[i] > k) continue;
      ++work.counts.estimated;
      add_estimated(tile, i, w.all[i], work.fractions, estimate);
    }
  }
  return {};
}

// Finds the light that every slot with a surface would get of each of work.whole's lights without occluders. Returns these slots.
std::vector<std::uint32_t> TileLighting::find_whole(const SurfaceTile& tile, Work& work) {
  std::vector<std::uint32_t> slots = slots_with_surfaces(tile);
  if (work.whole.empty()) return slots;
  work.filled = take_slots(tile, slots, work.filled, work.some);
  for (WholeLight& whole : work.whole) {
    for (TilePlane* plane : {&work.some.radiance.x, &work.some.radiance.y, &work.some.radiance.z}) plane->fill(0);
    add(work.some, {whole.light});
    for (std::size_t k = 0; k < slots.size(); ++k) {
      whole.all[slots[k]] = radiance_in(work.some, k);
      whole.sum += luminance(static_cast<Vec3d>(whole.all[slots[k]]));
    }
  }
  return slots;
}

// Adds the light for slots that see all of it, or a fraction of it.
void TileLighting::add_whole(SurfaceTile& tile, const PackLight& light, Work& work) {
  work.slots.clear();
  for (std::uint32_t i = 0; i < kTilePixels; ++i)
    if (whole_fraction(work.shadow, i) > 0) work.slots.push_back(i);
  if (work.slots.empty()) return;
  SurfaceTile& some = light_slots(tile, light, work);
  for (std::size_t k = 0; k < work.slots.size(); ++k) {
    const std::uint32_t i = work.slots[k];
    add_radiance(tile, i, radiance_in(some, k) * whole_fraction(work.shadow, i));
  }
}

// The radiance that a light sends to some slots only, in their order.
SurfaceTile& TileLighting::light_slots(const SurfaceTile& tile, const PackLight& light, Work& work) {
  work.filled = take_slots(tile, work.slots, work.filled, work.some);
  // Pieces lie above the surface's horizon, and each coat's normal equals the surface's, except for rounding (take_coats).
  if (light.is_pieces()) work.some.coat_normal = work.some.normal;
  add(work.some, {&light});
  return work.some;
}

// Adds the light for slots that see a part of it.
void TileLighting::add_parts(SurfaceTile& tile, const PackLight& light, Work& work) {
  for (std::size_t i = 0; i < work.shadow.batch_count; ++i) add_batch(tile, light, work.shadow.batches[i], work);
}

void TileLighting::add_batch(SurfaceTile& tile, const PackLight& light, TileShadow::Batch& batch, Work& work) {
  work.slots = batch.slots;
  const std::size_t count = batch.slots.size();
  std::vector<Vec3f> radiance(count);
  work.pieces.radiance = light.radiance;
  work.pieces.textured = light.textured;
  work.pieces.profiled = light.profiled;
  light_pieces(tile, batch.visible, work, [&](const SurfaceTile& seen) {
    for (std::size_t k = 0; k < count; ++k) radiance[k] = radiance_in(seen, k) * batch.passes[k];
  });
  if (batch.all.point_count() > 0 && light.is_even()) {
    // The polygon replaces the light only for the fraction that arrives, so there is no step where shadows begin. Approximate methods may
    // find more light for a part than for the whole.
    const auto over = [](float part, float all) { return all > 0 ? std::min(part / all, 1.0f) : 0.0f; };
    light_pieces(tile, batch.all, work, [&](const SurfaceTile& all) {
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3f a = radiance_in(all, k);
        radiance[k] = {over(radiance[k].x, a.x), over(radiance[k].y, a.y), over(radiance[k].z, a.z)};
      }
    });
    const SurfaceTile& whole = light_slots(tile, light, work);
    for (std::size_t k = 0; k < count; ++k) radiance[k] = radiance[k] * radiance_in(whole, k);
  }
  for (std::size_t k = 0; k < count; ++k)
    if (batch.slots[k] != kNoSlot) add_radiance(tile, batch.slots[k], radiance[k]);
}

// Calls use(tile) with the radiance that some slots get from pieces, in their order.
template <class Use>
void TileLighting::light_pieces(const SurfaceTile& tile, packed::Pieces& pieces, Work& work, Use use) {
  if (!work.pieces.is_pieces()) work.pieces.shape = packed::Pieces();
  std::swap(std::get<packed::Pieces>(work.pieces.shape), pieces);
  use(light_slots(tile, work.pieces, work));
  std::swap(std::get<packed::Pieces>(work.pieces.shape), pieces);
}

ShadowCounts TileLighting::shadow_counts() const {
  ShadowCounts counts;
  for (const auto& work : work_) {
    counts.points += work->counts.points;
    counts.parts += work->counts.parts;
    counts.fallback += work->counts.fallback;
    counts.estimated += work->counts.estimated;
  }
  return counts;
}

double TileLighting::shadows_estimated() const {
  const ShadowCounts counts = shadow_counts();
  const std::uint64_t all = counts.points + counts.estimated;
  return all > 0 ? static_cast<double>(counts.estimated) / static_cast<double>(all) : 0;
}

double TileLighting::shadow_fallback() const {
  const ShadowCounts counts = shadow_counts();
  return counts.points > 0 ? static_cast<double>(counts.fallback) / static_cast<double>(counts.points) : 0;
}

}  // namespace steradian
