#include "render/radiosity/patch_solver.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "core/float_mode.h"
#include "render/radiosity/even_reflectance.h"
#include "render/surface/gbuffer.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::radiosity {
namespace {

constexpr std::size_t kMostLinks = std::size_t{1} << 25;  // of all sides: 128 MB
constexpr float kSmallChange = 1e-4f;                     // of the largest radiance, at which the iterations end
constexpr float kNoChange = 1e-6f;                        // the same where the factor from bounce to bounce is not yet below 1
constexpr int kMostIterations = 500;
constexpr std::uint32_t kFromSides = UINT32_MAX;  // in the place of a light's number: bounced light

constexpr std::size_t kTilePatches = kTilePixels / 2;  // of a tile of sides
// Ends of the stages of a solve, as fractions of its time: estimates for progress, from the scenes cornell, room, gallery and furnished.
struct SolveShares {
  double direct, refined, glossy, links;
};
SolveShares shares_of(int bounces) { return bounces == 1 ? SolveShares{0.5, 0.9, 1, 1} : SolveShares{0.2, 0.35, 0.4, 0.9}; }

std::size_t tiles_for(std::size_t patches) { return (patches + kTilePatches - 1) / kTilePatches; }

}  // namespace

class PatchSolver {
 public:
  // kept: links that serve the scene; null: none.
  PatchSolver(const Scene& scene, const RayScene& rays, const MipMaps& maps, const PatchOptions& options,
              const std::shared_ptr<const PatchLinks>& kept)
      : scene_(scene),
        rays_(rays),
        maps_(maps),
        options_(options),
        links_(kept != nullptr ? std::make_shared<PatchLinks>(*kept) : std::make_shared<PatchLinks>(scene, rays, options.fineness.patches)),
        light_(links_->patches()) {}

  PatchLight solve(const AddDirect& add_direct, const FindIncident& find_incident);
  std::shared_ptr<const PatchLinks> links() const { return links_; }
  bool stopped() const { return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed); }

 private:
  const Patches& patches() const { return light_.patches(); }
  template <class Work>
  void each(std::size_t count, Work work) const {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      if (stopped()) return;
      const FlushDenormals flush;
      work(i);
    });
  }
  Surface surface_at(const Patches::Site& at, std::uint32_t side) const {
    return surface_at_site(scene_, maps_, at, Patches::is_front(side));
  }
  Surface surface_of(std::uint32_t side) const { return surface_at(patches().site(side), side); }
  WorkFraction part(double first, double last) const { return part_of(options_.progress, first, last); }
  void find_direct(const AddDirect& add_direct);
  void refine_direct(const AddDirect& add_direct);
  void find_glossy(const FindIncident& find_incident);
  void find_links();
  std::vector<Vec3f> tints_of(std::size_t side) const;
  void find_from_glossy();
  void iterate();
  void turn_bounces();
  void find_glossy_shares();
  void find_coarse();
  void find_bright_sides();
  float area_of(std::uint32_t side) const;
  // Mean luminance of a radiance over the sides that have any; 0 if none has.
  template <class Radiance>
  double mean_of_lit(Radiance radiance) const {
    double power = 0, area = 0;
    for (std::uint32_t side = 0; side < static_cast<std::uint32_t>(patches().side_count()); ++side) {
      const double light = luminance(static_cast<Vec3d>(radiance(side)));
      if (!(light > 0)) continue;
      power += light * static_cast<double>(area_of(side));
      area += static_cast<double>(area_of(side));
    }
    return area > 0 ? power / area : 0;
  }
  float turn_of(std::uint32_t side) const;

  const Scene& scene_;
  const RayScene& rays_;
  const MipMaps& maps_;
  const PatchOptions options_;
  const SolveShares shares_ = shares_of(options_.bounces);
  const std::shared_ptr<PatchLinks> links_;
  PatchLight light_;
  std::vector<Vec3f> reflectance_, direct_;  // by side
  std::vector<Vec3f> even_glossy_;           // by side: mean radiance of its glossy lobe, where light_ keeps it by direction
  std::vector<Vec3f> from_glossy_;           // by side: mean radiance that glossy lobes of other sides send there
};

void put_white(SurfaceTile& tile, std::size_t slot, const Surface& s) {
  static const SurfaceMaterial plain;
  Surface white;
  white.position = s.position;
  white.normal = white.coat_normal = s.normal;
  white.geometric_normal = s.geometric_normal;
  white.tangent = s.tangent;
  white.albedo = {1, 1, 1};
  white.material = &plain;
  put_surface(tile, slot, white, s.geometric_normal);
}

PatchLight PatchSolver::solve(const AddDirect& add_direct, const FindIncident& find_incident) {
  const std::size_t sides = patches().side_count();
  reflectance_.resize(sides);
  direct_.resize(sides);
  find_direct(add_direct);
  refine_direct(add_direct);
  find_glossy(find_incident);
  for (std::size_t side = 0; side < sides; ++side) light_.sides_[side].radiance = direct_[side];
  if (sides == 0) return std::move(light_);
  if (options_.bounces != 1) {
    find_links();
    find_from_glossy();
    iterate();
    turn_bounces();
  }
  find_glossy_shares();
  find_coarse();
  find_bright_sides();
  if (options_.progress) options_.progress(1);
  return std::move(light_);
}

PatchLight solve_patches(const Scene& scene, const RayScene& rays, const MipMaps& maps, const PatchOptions& options,
                         const AddDirect& add_direct, const FindIncident& find_incident, std::shared_ptr<const PatchLinks>* kept) {
  PatchSolver solver(scene, rays, maps, options, kept != nullptr ? *kept : nullptr);
  PatchLight light = solver.solve(add_direct, find_incident);
  if (kept != nullptr && !solver.stopped()) *kept = solver.links();
  return light;
}

std::size_t solve_tiles(const Scene& scene, const PatchOptions& options) {
  const std::size_t tiles = tiles_for(Patches(scene, options.fineness.patches).side_count() / 2);
  return options.bounces == 0 ? 0 : static_cast<std::size_t>(static_cast<double>(tiles) / shares_of(options.bounces).direct) + 1;
}

// Finds the direct light of the sides, a tile of sides at a time: the fronts of its patches, and then their backs.
void PatchSolver::find_direct(const AddDirect& add_direct) {
  const std::size_t count = patches().side_count() / 2;
  WorkSteps steps(part(0, shares_.direct), tiles_for(count));
  each(tiles_for(count), [&](std::size_t number) {
    const auto tile = std::make_unique<SurfaceTile>();
    clear_kinds(*tile);
    tile->seed = number;
    // The side in a slot, or kNoSide.
    const auto side_of = [&](std::size_t slot) {
      const std::size_t patch = number * kTilePatches + slot % kTilePatches;
      return patch < count ? static_cast<std::uint32_t>(2 * patch + slot / kTilePatches) : kNoSide;
    };
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const std::uint32_t side = side_of(i);
      put_nothing(*tile, i);
      if (side == kNoSide) continue;
      const Surface s = surface_of(side);
      reflectance_[side] = even_reflectance(s).all;
      if (!weighs(reflectance_[side])) continue;
      put_white(*tile, i, s);
    }
    add_direct(*tile);
    for (std::size_t i = 0; i < kTilePixels; ++i)
      if (const std::uint32_t side = side_of(i); side != kNoSide) direct_[side] = get(tile->radiance, i) * reflectance_[side];
    steps.advance();
  });
}

// Sides beside which the direct light changes a lot get a light for each part, and its mean: a border of light or shadow crosses them.
void PatchSolver::refine_direct(const AddDirect& add_direct) {
  constexpr double kChange = 0.1;  // of the mean light of the sides
  constexpr std::size_t kTileSides = kTilePixels / kPatchParts;
  const auto sides = static_cast<std::uint32_t>(patches().side_count());
  const auto light = [&](std::uint32_t side) { return luminance(static_cast<Vec3d>(direct_[side])); };
  double power = 0, area = 0;
  for (std::uint32_t side = 0; side < sides; ++side) {
    power += light(side) * static_cast<double>(area_of(side));
    area += static_cast<double>(area_of(side));
  }
  const double least = area > 0 ? kChange * power / area : 0;
  if (!(least > 0)) return;
  std::vector<std::uint32_t> refined;
  for (std::uint32_t side = 0; side < sides; ++side) {
    const Patches::Site& at = patches().site(side);
    const auto changes_to = [&](float u, float v) {
      if (!(u > 0) || !(v > 0) || !(u + v < 1)) return false;
      return std::fabs(light(patches().place_at(at.mesh, at.triangle, u, v, Patches::is_front(side)).side) - light(side)) > least;
    };
    if (changes_to(at.u + at.step, at.v) || changes_to(at.u - at.step, at.v) || changes_to(at.u, at.v + at.step) ||
        changes_to(at.u, at.v - at.step))
      refined.push_back(side);
  }
  light_.change_in_parts_.resize(refined.size());
  for (std::uint32_t k = 0; k < refined.size(); ++k) light_.sides_[refined[k]].parts = k & PatchLight::kNoParts;
  const std::size_t tiles = (refined.size() + kTileSides - 1) / kTileSides;
  WorkSteps steps(part(shares_.direct, shares_.refined), tiles);
  each(tiles, [&](std::size_t number) {
    const auto tile = std::make_unique<SurfaceTile>();
    clear_kinds(*tile);
    tile->seed = number;
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      put_nothing(*tile, i);
      const std::size_t k = number * kTileSides + i / kPatchParts;
      if (k >= refined.size()) continue;
      put_white(*tile, i, surface_at(patches().site({refined[k], static_cast<std::uint32_t>(i % kPatchParts)}), refined[k]));
    }
    add_direct(*tile);
    for (std::size_t k = 0; k < kTileSides && number * kTileSides + k < refined.size(); ++k) {
      const std::uint32_t side = refined[number * kTileSides + k];
      std::array<Vec3f, kPatchParts>& parts = light_.change_in_parts_[light_.sides_[side].parts];
      Vec3f sum{};
      float held = 0;
      for (std::uint32_t i = 0; i < kPatchParts; ++i) {
        parts[i] = get(tile->radiance, k * kPatchParts + i) * reflectance_[side];
        if (!patches().holds({side, i})) continue;
        sum += parts[i];
        held += 1;
      }
      const Vec3f mean = held > 0 ? sum * (1 / held) : Vec3f{};
      direct_[side] = mean;
      for (std::uint32_t i = 0; i < kPatchParts; ++i) parts[i] = patches().holds({side, i}) ? parts[i] - mean : Vec3f{};
    }
    steps.advance();
  });
}

// Takes the light that glossy lobes send on out of the sides' even radiance, and keeps it by direction.
void PatchSolver::find_glossy(const FindIncident& find_incident) {
  constexpr double kLeast = 0.0002;  // of the mean direct radiance: less light goes on as if the side were diffuse
  constexpr std::size_t kBatch = 4096;
  const auto sides = static_cast<std::uint32_t>(patches().side_count());
  even_glossy_.resize(sides);
  const double least = kLeast * mean_of_lit([&](std::uint32_t side) { return direct_[side]; });
  if (!(least > 0)) return;
  WorkSteps steps(part(shares_.refined, shares_.glossy), sides);
  struct Found {
    Surface surface;
    Vec3f share;  // of the radiance
    std::vector<IncidentLight> incident;
  };
  for (std::uint32_t first = 0; first < sides; first += kBatch) {
    std::vector<Found> found(std::min(kBatch, std::size_t{sides - first}));
    each(found.size(), [&](std::size_t k) {
      steps.advance();
      const auto side = static_cast<std::uint32_t>(first + k);
      if (!weighs(direct_[side])) return;
      const Surface surface = surface_of(side);
      if (!GlossySides::has_lobe(surface)) return;
      const Vec3f share = even_reflectance(surface).glossy_share();
      if (luminance(static_cast<Vec3d>(direct_[side] * share)) <= least) return;
      found[k] = {surface, share, {}};
      find_incident(surface, side, found[k].incident);
    });
    for (std::size_t k = 0; k < found.size(); ++k) {
      const auto side = static_cast<std::uint32_t>(first + k);
      const Vec3f all = reflectance_[side];
      const auto over = [](float a, float b) { return b > 0 ? a / b : 0; };
      const Vec3f irradiance =
          Vec3f{over(direct_[side].x, all.x), over(direct_[side].y, all.y), over(direct_[side].z, all.z)} * std::numbers::pi_v<float>;
      if (found[k].incident.empty()) continue;
      light_.sides_[side].glossy = light_.glossy_.keep(found[k].surface, found[k].incident, irradiance, turn_of(side));
      if (light_.sides_[side].glossy == GlossySides::kNone) continue;
      const Vec3f rest = Vec3f{1, 1, 1} - found[k].share;
      even_glossy_[side] = direct_[side] * found[k].share;
      direct_[side] = direct_[side] * rest;
      if (light_.sides_[side].parts == PatchLight::kNoParts) continue;
      for (Vec3f& part : light_.change_in_parts_[light_.sides_[side].parts]) part = part * rest;
    }
  }
}

void PatchSolver::find_links() {
  const std::size_t sides = patches().side_count();
  WorkSteps steps(part(shares_.glossy, shares_.links), sides);
  const auto each_side = [&](std::size_t count, const std::function<void(std::size_t)>& work) {
    each(count, [&](std::size_t side) {
      work(side);
      steps.advance();
    });
  };
  if (links_->rays() == 0 || !links_->follow(scene_, rays_, maps_, each_side)) {
    const std::size_t rays = std::clamp(kMostLinks / sides, std::size_t{16}, options_.fineness.rays);
    links_->find(scene_, rays_, maps_, rays / BounceRays::kLanes * BounceRays::kLanes, each_side);
  }
  light_.traced_ = links_->traced();
}

// Fraction of light that the glass before each ray of a side lets through.
std::vector<Vec3f> PatchSolver::tints_of(std::size_t side) const {
  std::vector<Vec3f> tints(links_->rays(), {1, 1, 1});
  for (const PatchLinks::Absorbed& a : links_->absorbed(side)) tints[a.ray] = tints[a.ray] - a.fraction;
  return tints;
}

// Finds the mean radiance that glossy lobes of other sides send to each side.
void PatchSolver::find_from_glossy() {
  from_glossy_.resize(patches().side_count());
  each(patches().side_count(), [&](std::size_t side) {
    const auto shines = [&](std::size_t k) { return links_->met(side, k) != kNoSide && light_.has_lobe(links_->met(side, k)); };
    std::size_t first = 0;
    while (first < links_->rays() && !shines(first)) ++first;
    if (first == links_->rays()) return;
    const Frame frame = SideRays::frame(surface_of(static_cast<std::uint32_t>(side)), side);
    const std::vector<Vec3f> tints = tints_of(side);
    for (std::size_t k = first; k < links_->rays(); ++k)
      if (shines(k)) {
        const auto to = static_cast<Vec3f>(frame.to_world(links_->side_rays().direction(k)));
        from_glossy_[side] += light_.glossy_radiance(links_->met(side, k), -to) * tints[k] * (1 / static_cast<float>(links_->rays()));
      }
  });
}

// Adds bounces until the picture's last one, or until those that are left out are within kSmallChange.
//
// Every bounce is the same positive linear map of the one before. So if it is nowhere more than a factor f of the one before, all that
// follow are within f / (1 - f) of it. Where light goes to and fro between surfaces, no such f is below 1. Then the largest reflectance
// bounds the largest radiance of each bounce by that of the one before.
void PatchSolver::iterate() {
  const int bounces = options_.bounces;
  const std::size_t sides = patches().side_count();
  const float over_links = 1.0f / static_cast<float>(links_->rays());
  std::vector<Vec3f> bounce = direct_, next(sides);  // radiance after exactly so many bounces
  const auto largest_of = [](Vec3f v) { return std::max({v.x, v.y, v.z}); };
  float largest_reflectance = 0;
  for (const Vec3f& reflectance : reflectance_) largest_reflectance = std::max(largest_reflectance, largest_of(reflectance));
  const int most = bounces == kAllBounces ? kMostIterations : bounces - 1;
  for (light_.iterations_ = 0; light_.iterations_ < most && !stopped();) {
    each(sides, [&](std::size_t side) {
      Vec3f sum{};
      for (std::size_t k = 0; k < links_->rays(); ++k) {
        const std::uint32_t met = links_->met(side, k);
        if (met != kNoSide) sum += bounce[met];
      }
      for (const PatchLinks::Absorbed& a : links_->absorbed(side)) sum = sum - bounce[links_->met(side, a.ray)] * a.fraction;
      // Light from glossy lobes of other sides is direct light that has bounced once.
      next[side] = reflectance_[side] * (sum * over_links + (light_.iterations_ == 0 ? from_glossy_[side] : Vec3f{}));
    });
    float factor = 0, largest_bounce = 0, largest = 0;
    const auto grows = [](float from, float to) { return to > 0 ? (from > 0 ? to / from : std::numeric_limits<float>::infinity()) : 0.0f; };
    for (std::size_t side = 0; side < sides; ++side) {
      const Vec3f a = bounce[side], b = next[side];
      light_.sides_[side].radiance += b;
      factor = std::max({factor, grows(a.x, b.x), grows(a.y, b.y), grows(a.z, b.z)});
      largest_bounce = std::max(largest_bounce, largest_of(b));
      largest = std::max(largest, largest_of(light_.sides_[side].radiance));
    }
    bounce.swap(next);
    ++light_.iterations_;
    if (bounces != kAllBounces) continue;
    // The first bounce holds light of glossy lobes that the direct light does not.
    light_.left_out_.reset();
    const float decrease = std::min(light_.iterations_ > 1 ? factor : largest_reflectance, largest_reflectance);
    if (decrease < 1) light_.left_out_ = largest_bounce * decrease / (1 - decrease);
    if (largest_bounce <= kNoChange * largest || (light_.left_out_ && *light_.left_out_ <= kSmallChange * largest)) break;
  }
}

// Takes the bounced light that glossy lobes of metals send on out of the sides' even radiance, and keeps it by direction: the gather sees
// it so. From side to side it went evenly.
void PatchSolver::turn_bounces() {
  constexpr float kMetal = 0.25f;  // share of the light that the glossy lobe reflects
  constexpr double kLeast = 0.02;  // of the mean radiance
  constexpr std::size_t kBatch = 4096;
  const auto sides = static_cast<std::uint32_t>(patches().side_count());
  const double least = kLeast * mean_of_lit([&](std::uint32_t side) { return light_.sides_[side].radiance; });
  if (!(least > 0)) return;
  struct Found {
    Surface surface;
    Vec3f turned, irradiance;
    std::vector<IncidentLight> incident;
  };
  struct Turned {
    std::uint32_t side, lobe;
    Vec3f radiance;
  };
  std::vector<Turned> turned;
  for (std::uint32_t first = 0; first < sides; first += kBatch) {
    std::vector<Found> found(std::min(kBatch, std::size_t{sides - first}));
    each(found.size(), [&](std::size_t k) {
      const std::size_t side = first + k;
      const Vec3f bounced = light_.sides_[side].radiance - direct_[side];
      if (!weighs(bounced)) return;
      const Surface surface = surface_of(static_cast<std::uint32_t>(side));
      if (!GlossySides::has_lobe(surface)) return;
      const Vec3f share = even_reflectance(surface).glossy_share();
      if (std::max({share.x, share.y, share.z}) < kMetal || luminance(static_cast<Vec3d>(bounced * share)) <= least) return;
      found[k] = {surface, bounced * share, {}, {}};
      const Frame frame = SideRays::frame(surface, side);
      const float per_ray = std::numbers::pi_v<float> / static_cast<float>(links_->rays());
      const std::vector<Vec3f> tints = tints_of(side);
      for (std::size_t i = 0; i < links_->rays(); ++i) {
        const std::uint32_t met = links_->met(side, i);
        if (met == kNoSide) continue;
        const auto to = static_cast<Vec3f>(frame.to_world(links_->side_rays().direction(i)));
        const Vec3f irradiance = (light_.sides_[met].radiance + light_.glossy_radiance(met, -to)) * tints[i] * per_ray;
        found[k].irradiance += irradiance;
        if (weighs(irradiance))
          found[k].incident.push_back({to, irradiance, per_ray / static_cast<float>(links_->side_rays().direction(i).z), kFromSides});
      }
    });
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (found[k].incident.empty()) continue;
      const auto side = static_cast<std::uint32_t>(first + k);
      const std::uint32_t lobe =
          light_.glossy_.keep(found[k].surface, found[k].incident, found[k].irradiance, turn_of(side), light_.sides_[side].glossy);
      if (lobe != GlossySides::kNone) turned.push_back({side, lobe, found[k].turned});
    }
  }
  for (const Turned& t : turned) {
    light_.sides_[t.side].radiance -= t.radiance;
    light_.sides_[t.side].glossy = t.lobe;
    even_glossy_[t.side] += t.radiance;
  }
}

// Finds the fractions of the light that glossy lobes send on. From side to side, bounced light of these lobes always went evenly.
void PatchSolver::find_glossy_shares() {
  struct Light {
    double all = 0, glossy = 0, kept = 0;
  };
  std::vector<Light> of_sides(patches().side_count());
  each(of_sides.size(), [&](std::size_t k) {
    const auto side = static_cast<std::uint32_t>(k);
    const Vec3f kept = even_glossy_[side], sent = light_.sides_[side].radiance + kept;
    if (!weighs(sent)) return;
    const auto light = [&](Vec3f v) { return luminance(static_cast<Vec3d>(v)) * static_cast<double>(area_of(side)); };
    const Surface surface = surface_of(side);
    of_sides[k] = {light(sent), 0, light(kept)};
    if (GlossySides::has_lobe(surface)) of_sides[k].glossy = light(sent * even_reflectance(surface).glossy_share());
  });
  Light sum;
  for (const Light& of : of_sides) {
    sum.all += of.all;
    sum.glossy += of.glossy;
    sum.kept += std::min(of.kept, of.glossy);
  }
  if (sum.all > 0) light_.glossy_shares_ = {sum.glossy / sum.all, (sum.glossy - sum.kept) / sum.all};
}

// Joins the sides of each group, whose patches have equal areas.
void PatchSolver::find_coarse() {
  const auto sides = static_cast<std::uint32_t>(patches().side_count());
  std::vector<Vec3f> sum(sides);
  std::vector<float> count(sides);
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t group = patches().group_of(side);
    sum[group] += light_.sides_[side].radiance;
    count[group] += 1;
  }
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t group = patches().group_of(side);
    light_.sides_[side].coarse = sum[group] * (1 / count[group]);
  }
}

float PatchSolver::area_of(std::uint32_t side) const {
  const Patches::Site& at = patches().site(side);
  const Mesh& mesh = scene_.meshes[at.mesh];
  const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[3 * std::size_t{at.triangle} + i]]; };
  return 0.5f * length(cross(corner(1) - corner(0), corner(2) - corner(0))) * patches().area(side);
}

// Largest angle between the normals at a patch's middle and its corners, where vertices have normals.
float PatchSolver::turn_of(std::uint32_t side) const {
  const Patches::Site& at = patches().site(side);
  const Mesh& mesh = scene_.meshes[at.mesh];
  if (mesh.normals.empty()) return 0;
  const auto corner = [&](std::size_t i) { return mesh.normals[mesh.indices[3 * std::size_t{at.triangle} + i]]; };
  const Vec3f middle = (corner(0) + corner(1) + corner(2)) * (1.0f / 3);
  return std::max({length(corner(0) - middle), length(corner(1) - middle), length(corner(2) - middle)}) * at.step;
}

// Spreads places over the bright sides in proportion to their light.
void PatchSolver::find_bright_sides() {
  constexpr double kBright = 6;  // times the mean radiance of the sides that send light
  const std::size_t most = options_.fineness.bright;
  const auto sides = static_cast<std::uint32_t>(patches().side_count());
  const auto radiance = [&](std::uint32_t side) { return light_.sides_[side].radiance + even_glossy_[side]; };
  const auto brightness = [&](std::uint32_t side) { return luminance(static_cast<Vec3d>(radiance(side))); };
  light_.mean_radiance_ = mean_of_lit(radiance);
  const double least = kBright * light_.mean_radiance_;
  std::vector<std::uint8_t> bright(sides);
  double bright_power = 0, bright_area = 0;
  for (std::uint32_t side = 0; side < sides; ++side) {
    bright[side] = least > 0 && brightness(side) > least;
    if (bright[side] == 0) continue;
    bright_power += brightness(side) * static_cast<double>(area_of(side));
    bright_area += static_cast<double>(area_of(side));
  }
  if (!(bright_power > 0)) return;
  double before = 0;
  for (std::uint32_t side = 0; side < sides; ++side) {
    if (bright[side] == 0) continue;
    before += brightness(side) * static_cast<double>(area_of(side));
    while (light_.places_.size() < most &&
           (static_cast<double>(light_.places_.size()) + 0.5) * bright_power < before * static_cast<double>(most)) {
      const Surface s = surface_of(side);
      light_.places_.push_back(
          {s.position, s.geometric_normal, side, static_cast<float>(bright_power / static_cast<double>(most) / brightness(side))});
    }
  }
  for (std::uint32_t side = 0; side < sides; ++side) light_.sides_[side].bright = bright[side] & 1u;
  light_.bright_area_ = static_cast<float>(bright_area / static_cast<double>(most));
}

}  // namespace steradian::radiosity
