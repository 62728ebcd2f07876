#include "render/radiosity/gather.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/lattices.h"
#include "lobes/ggx_energy.h"
#include "lobes/lobe.h"
#include "render/radiosity/bounce_rays.h"
#include "render/environment/environment_light.h"  // mean_grazing
#include "render/radiosity/mirror/mirrors.h"

namespace steradian::radiosity {
namespace {

constexpr int kMostShifts = 16;  // of the grid; more primary samples repeat them

// Place of each of 4 x 4 pixels in a cell of the grid, a number of 4 x 4. Neither coordinate of the place, nor its first waves, has a
// component along those of the pixel: the linear fit would keep it.
constexpr std::array<int, 16> kPlaces = {1, 14, 10, 5, 15, 8, 0, 7, 4, 3, 11, 12, 6, 9, 13, 2};

constexpr std::uint32_t kAllLanes = (1u << SixteenSurfaces::kLanes) - 1;

// The quarter of its directions that each pixel of a block takes first. Those of the same place in four blocks take all four. Neither bit
// follows the place in 8 x 8 pixels.
std::array<std::size_t, SixteenSurfaces::kLanes> first_quarters(std::size_t block) {
  std::array<std::size_t, SixteenSurfaces::kLanes> quarters;
  for (std::size_t i = 0; i < quarters.size(); ++i) quarters[i] = block ^ ((i ^ i >> 3) & 1) ^ ((i >> 1 ^ i >> 2) & 1) << 1;
  return quarters;
}

Vec3f absolute(Vec3f v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

constexpr std::array<float, 4> kEvenQuarters = {0.25f, 0.25f, 0.25f, 0.25f};  // weights of quarters that share the light of all

// Place in a lobe of direction `k` of `count`, for a pixel of 4 x 4. Each pixel has a lattice of its own: together they see as many
// directions as all.
std::array<double, 2> place_in_lobe(std::size_t k, std::size_t count, std::size_t pixel, double turn) {
  const auto [shift, turned] = r2_place(kPlaces[pixel]);
  const auto [u, v] = fibonacci_place(k, count, turn + turned);
  return {u + (shift - 0.5) / static_cast<double>(count), v};
}

Vec3d ratio(Vec3d a, Vec3d b) {
  const auto one = [](double x, double y) { return y > 0 ? x / y : 1.0; };
  return {one(a.x, b.x), one(a.y, b.y), one(a.z, b.z)};
}

// Fraction of a lobe's light that its own directions gather.
float gathered_fraction(const SurfaceLobe& lobe, bool mirrored_rays) {
  const Material& m = lobe.material;
  return m.brdf == Brdf::ggx && mirrored_rays ? 1 - mirrored_fraction(static_cast<float>(m.alpha_x), static_cast<float>(m.alpha_y)) : 1;
}

// True if one of sixteen lobes reflects so much that its noise would show more than that of diffuse light.
bool reflects_much(const SixteenSurfaces& surfaces, const std::array<const SurfaceLobe*, SixteenSurfaces::kLanes>& lobes) {
  constexpr double kMuch = 0.2;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (lobes[i] == nullptr) continue;
    const std::optional<Vec3d> albedo =
        lobes::known_albedo(lobes[i]->material, static_cast<double>(dot(lobes[i]->normal, surfaces.view[i])));
    if (!albedo || std::max({albedo->x, albedo->y, albedo->z}) > kMuch) return true;
  }
  return false;
}

// Surfaces that have a diffuse lobe.
std::uint32_t with_diffuse(const SixteenSurfaces& surfaces) {
  std::uint32_t bits = 0;
  SixteenSurfaces::each(surfaces.lit, [&](std::size_t i) { bits |= std::uint32_t{weighs(surfaces.surface[i].albedo)} << i; });
  return bits;
}

// Fraction of the light from all sides that comes through a surface's boundary to its diffuse base and back to the view.
float passed_by_boundary(const Surface& s, Vec3f view) {
  const double cosine = std::max(static_cast<double>(dot(s.normal, view)), 0.0);
  return static_cast<float>(1 - static_cast<double>(s.fresnel_loss) * environment::mean_grazing(cosine));
}

}  // namespace

Gather::Gather(const PatchLight& light, const RayScene& rays, const Fineness& fineness, const Options& options)
    : light_(light),
      rays_(rays),
      strict_(options.strict),
      samples_(std::min(options.samples, kMostShifts)),
      lobe_rays_(fineness.lobe_rays),
      every_other_(fineness.every_other && !options.strict),
      tolerance_(static_cast<float>(options.error * light.mean_radiance())) {
  const std::size_t finest = options.error > 0 || strict_ ? kFinest : 0;
  for (std::size_t level = 0; level <= finest; ++level) add_grids(fineness.rows << level);
  const auto rays_over_sphere = static_cast<float>(grids_[0][0].size());
  near_ = std::sqrt(kLanes * light.bright_area() * rays_over_sphere / (4 * std::numbers::pi_v<float>));
}

// Adds the grids of a level, one for each primary sample.
void Gather::add_grids(int rows) {
  const int columns = 2 * rows;
  std::vector<Grid>& grids = grids_.emplace_back();
  for (int s = 0; s < samples_; ++s) {
    Grid& cells = grids.emplace_back(static_cast<std::size_t>(rows * columns));
    // The pixels take the places of a 4 x 4 grid in each cell; the primary samples, places in a cell of that.
    const double in_x = (s + 0.5) / samples_, in_y = std::fmod(s * kGolden + 0.5, 1.0);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const int quarter = row % 2 * 2 + column % 2, in_quarter = row / 2 * (columns / 2) + column / 2;
        Cell& cell = cells[static_cast<std::size_t>(quarter * (rows * columns / 4) + in_quarter)];
        for (std::size_t i = 0; i < kLanes; ++i) {
          const double x = (kPlaces[i] % 4 + in_x) / 4, y = (kPlaces[i] / 4 + in_y) / 4;
          const double up = 1 - 2 * (row + y) / rows, phi = 2 * std::numbers::pi * (column + x) / columns, r = std::sqrt(1 - up * up);
          cell.direction[i] = static_cast<Vec3f>(Vec3d{r * std::cos(phi), up, r * std::sin(phi)});
        }
      }
  }
}

// Adds the irradiance over pi that bright sides beyond near_ send, to each quarter its part. A place counts as a disk of the area that it
// stands for.
void Gather::add_bright(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level,
                        Quarters<Vec3f>& quarters) const {
  const std::size_t every = kLanes >> (2 * level);  // a pixel takes one of so many places
  const std::vector<BrightPlace>& places = light_.bright_places();
  const float soft = light_.bright_area() / std::numbers::pi_v<float>;
  for (std::size_t first = 0; first < places.size(); first += every) {
    RayScene::Sixteen rays;
    std::uint32_t traced = 0;
    std::array<Vec3f, kLanes> light;
    SixteenSurfaces::each(asked, [&](std::size_t i) {
      const auto number = static_cast<std::size_t>(kPlaces[(i + static_cast<std::size_t>(sample)) % kLanes]) % every;
      const BrightPlace& place = places[std::min(first + number, places.size() - 1)];
      const Surface& s = surfaces.surface[i];
      const Vec3d from = rays_.off_surface(static_cast<Vec3d>(s.position), static_cast<Vec3d>(s.geometric_normal));
      const Vec3d end = rays_.off_surface(static_cast<Vec3d>(place.position), static_cast<Vec3d>(place.normal));
      const Vec3f way = static_cast<Vec3f>(end - from);
      const float here = dot(way, s.normal), there = -dot(way, place.normal), square = dot(way, way);
      if (!(here > 0) || !(there > 0) || !(dot(way, s.geometric_normal) > 0) || square <= near_ * near_) return;
      light[i] = light_.radiance_towards(place, way * (-1 / std::sqrt(square))) *
                 (static_cast<float>(every) * place.area * here * there / (square * (square + soft)) / std::numbers::pi_v<float>);
      rays.set(i, from, end - from);
      traced |= 1u << i;
    });
    const std::size_t quarter = first / every % 4;
    const std::uint32_t visible = traced & ~rays_.blocked_among(rays, traced, Casters::and_lights);
    light_.patches().clear_meshes().tint(rays_, rays, visible, light);
    SixteenSurfaces::each(visible, [&](std::size_t i) { quarters[i][quarter] += light[i]; });
  }
}

// A result with its standard error.
struct Gather::Lit {
  Result result;
  std::array<Vec3f, kLanes> standard{};
  // False where the noise of a pixel would show.
  bool is_smooth() const {
    constexpr float kShown = 0.02f;  // of the mean light of the pixels
    Vec3f mean{};
    for (const Vec3f& r : result.radiance) mean += r * (1.0f / kLanes);
    const float most = kShown * std::max({mean.x, mean.y, mean.z});
    return std::all_of(standard.begin(), standard.end(), [&](Vec3f e) { return std::max({e.x, e.y, e.z}) <= most; });
  }
  // Puts the diffuse light of a surface, whose mean radiance from all sides is given.
  void put(std::size_t i, const SixteenSurfaces& surfaces, const FittedValue& mean) {
    const Surface& s = surfaces.surface[i];
    const Vec3f reflected = s.albedo * passed_by_boundary(s, surfaces.view[i]);
    result.radiance[i] = reflected * mean.value;
    result.error[i] = reflected * mean.error;
    standard[i] = reflected * mean.standard;
  }
};

bool Gather::is_within(const Lit& lit) const {
  return tolerance_ == 0 || std::all_of(lit.standard.begin(), lit.standard.end(), [&](Vec3f error) {
           return std::max({error.x, error.y, error.z}) <= tolerance_;
         });
}

// The light of bright sides at each surface.
std::array<FittedValue, Gather::kLanes> Gather::bright(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample,
                                                       std::size_t level) const {
  std::array<FittedValue, kLanes> fitted{};
  if (light_.bright_places().empty()) return fitted;
  Quarters<Vec3f> light{};
  add_bright(surfaces, asked, sample, level, light);
  std::array<Gathered, kLanes> means{};
  SixteenSurfaces::each(asked, [&](std::size_t i) { means[i] = mean_of_quarters(light[i], kEvenQuarters); });
  // The places of a pixel lie between those of its neighbours: its quarters are nearer to each other than to the truth.
  const BlockFit fit(surfaces, asked, strict_);
  SixteenSurfaces::each(asked, [&](std::size_t i) { fitted[i] = fit.at(i, means, BlockFit::Keeps::nothing); });
  return fitted;
}

// Sums over a quarter of the directions of each surface, by quarters of that. quarters: of the surfaces.
Gather::Sums Gather::quarter_sums(const SixteenSurfaces& surfaces, std::uint32_t asked, const Grid& cells,
                                  const std::array<std::size_t, kLanes>& quarters) const {
  Sums sums;
  BounceRays rays(rays_, light_.patches(), RayScene::Order::neighbours);
  SixteenSurfaces::each(asked, [&](std::size_t i) { rays.start(i, surfaces.surface[i]); });
  const std::size_t count = cells.size() / 4;
  const auto columns = static_cast<std::size_t>(std::lround(std::sqrt(2.0 * static_cast<double>(count))));  // twice the rows
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t part = k / columns % 2 * 2 + k % 2;
    std::array<float, kLanes> cosine{};
    std::array<Vec3f, kLanes> to{};
    SixteenSurfaces::each(asked, [&](std::size_t i) {
      to[i] = cells[quarters[i] * count + k].direction[i];
      cosine[i] = dot(surfaces.surface[i].normal, to[i]);
      if (!(cosine[i] > 0)) return;
      sums.weight[i][part] += cosine[i];
      rays.set(i, to[i]);
    });
    const auto met = rays.trace();
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (met[i].side == kNoSide) continue;
      if (light_.is_bright(met[i].side) && rays.distance(i) > near_) continue;
      const Vec3f weighted = rays.tint(i) * cosine[i], radiance = light_.radiance(met[i]) * weighted;
      sums.light[i][part] += light_.glossy_radiance(met[i].side, -to[i]) * weighted + radiance;
      sums.basis[i] += radiance - light_.coarse_radiance(met[i]) * weighted;
    }
  }
  return sums;
}

// The mean radiance about each surface, weighted by the cosine. first: sums over the first quarters, or null; block: of those.
std::array<FittedValue, Gather::kLanes> Gather::arriving(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample,
                                                         std::size_t level, std::size_t block, const Sums* first) const {
  Sums all;
  for (std::size_t round = 0; round < 4; ++round) {
    // Rays that are traced together are nearest where all take the same quarter.
    std::array<std::size_t, kLanes> quarters{};
    if (first != nullptr) quarters = first_quarters(block);
    for (std::size_t& quarter : quarters) quarter ^= round;
    const Sums sums = round == 0 && first != nullptr ? *first : quarter_sums(surfaces, asked, grid(level, sample), quarters);
    SixteenSurfaces::each(asked, [&](std::size_t i) {
      for (std::size_t q = 0; q < 4; ++q) {
        all.light[i][quarters[i]] += sums.light[i][q];
        all.weight[i][quarters[i]] += sums.weight[i][q];
      }
      all.basis[i] += sums.basis[i];
    });
  }
  std::array<Gathered, kLanes> means{};
  SixteenSurfaces::each(asked, [&](std::size_t i) { means[i] = mean_of_quarters(all.light[i], all.weight[i]); });
  const BlockFit fit(surfaces, asked, strict_);
  const std::array<FittedValue, kLanes> of_bright = bright(surfaces, asked, sample, level);
  std::array<FittedValue, kLanes> sum{};
  SixteenSurfaces::each(asked, [&](std::size_t i) {
    const FittedValue of_rays = fit.at(i, means, BlockFit::Keeps::own_values);
    const float weight = all.weight[i][0] + all.weight[i][1] + all.weight[i][2] + all.weight[i][3];
    const Vec3f basis = weight > 0 ? absolute(all.basis[i] * (1 / weight)) : Vec3f{};
    sum[i] = {of_rays.value + of_bright[i].value, of_rays.error + of_bright[i].error + basis, of_rays.standard + of_bright[i].standard};
  });
  return sum;
}

// The same times the surfaces' albedo.
Gather::Lit Gather::diffuse(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level, std::size_t block,
                            const Sums* first) const {
  const std::array<FittedValue, kLanes> sum = arriving(surfaces, asked, sample, level, block, first);
  Lit lit;
  SixteenSurfaces::each(asked, [&](std::size_t i) { lit.put(i, surfaces, sum[i]); });
  return lit;
}

// The same for 8 x 8 pixels in one plane, by one pixel of 2 x 2.
void Gather::diffuse_of_every_other(const FourBlocks& blocks, int sample, std::array<Lit, 4>& lit) const {
  const auto lane_of = [](std::size_t x, std::size_t y) { return y % 4 * 4 + x % 4; };
  const auto block_of = [](std::size_t x, std::size_t y) { return y / 4 * 2 + x / 4; };
  SixteenSurfaces some;
  some.lit = kAllLanes;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::size_t x = i % 4 * 2, y = i / 4 * 2;
    some.surface[i] = blocks[block_of(x, y)].surface[lane_of(x, y)];
    some.view[i] = blocks[block_of(x, y)].view[lane_of(x, y)];
  }
  const std::array<FittedValue, kLanes> sum = arriving(some, kAllLanes, sample, 0, 0, nullptr);
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 0; x < 8; ++x) lit[block_of(x, y)].put(lane_of(x, y), blocks[block_of(x, y)], between_even_pixels(sum, x, y));
}

// The same for 8 x 8 pixels, by a quarter of the directions. False where their light is no plane, or its error is above the tolerance; then
// `first` serves each block. Blocks whose bright sides need more directions are no matter of this.
bool Gather::diffuse_of_square(const FourBlocks& blocks, int sample, std::array<Sums, 4>& first, std::array<Lit, 4>& lit) const {
  std::array<std::array<Gathered, kLanes>, 4> means;
  std::array<Vec3f, 4> basis{};
  for (std::size_t b = 0; b < 4; ++b) {
    first[b] = quarter_sums(blocks[b], kAllLanes, grid(0, sample), first_quarters(b));
    float weight = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      means[b][i] = mean_of_quarters(first[b].light[i], first[b].weight[i]);
      basis[b] += first[b].basis[i];
      for (const float w : first[b].weight[i]) weight += w;
    }
    basis[b] = weight > 0 ? absolute(basis[b] * (1 / weight)) : Vec3f{};
  }
  std::array<std::array<FittedValue, kLanes>, 4> fitted;
  if (!fit_square(means, fitted)) return false;
  for (std::size_t b = 0; b < 4; ++b) {
    const std::array<FittedValue, kLanes> of_bright = bright(blocks[b], kAllLanes, sample, 0);
    for (std::size_t i = 0; i < kLanes; ++i)
      lit[b].put(i, blocks[b],
                 {fitted[b][i].value + of_bright[i].value, fitted[b][i].error + of_bright[i].error + basis[b],
                  fitted[b][i].standard + of_bright[i].standard});
    if (!is_within(lit[b])) return false;
  }
  return true;
}

// One glossy lobe of each surface that has one.
Gather::Lit Gather::glossy(const SixteenSurfaces& surfaces, const std::array<const SurfaceLobe*, kLanes>& of, int sample,
                           bool mirrored_rays, std::size_t level) const {
  const std::size_t count = lobe_rays_ << (2 * level);
  struct Walker {
    Frame frame;
    lobes::Lobe lobe;
    double fraction;  // of the lobe that these directions gather
    float wider;      // added width of the lobes that it sees: the rays of a wide lobe are far apart, and would miss narrow highlights
    std::optional<Vec3d> albedo;
    Vec3d weights;   // sum over the directions, which the albedo corrects
    bool is_solids;  // the lobe of a rough solid, whose shape is not known exactly
  };
  std::array<std::optional<Walker>, kLanes> walkers;
  std::uint32_t asked = 0;
  float narrowest = BlockFit::kFlat;
  BounceRays rays(rays_, light_.patches(), RayScene::Order::neighbours);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (of[i] == nullptr) continue;
    const Surface& s = surfaces.surface[i];
    const Vec3d tangent = of[i]->material.tangent == Vec3d{} ? static_cast<Vec3d>(s.tangent) : of[i]->material.tangent;
    const Frame frame = Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(of[i]->normal)), tangent);
    const lobes::Lobe lobe(lobes::in_frame(of[i]->material, frame), normalized(frame.to_local(static_cast<Vec3d>(surfaces.view[i]))));
    if (!lobe.above_surface()) continue;
    rays.start(i, s);
    // Half of its width is about the distance between 64 directions of a lobe, in half vectors.
    const Material& material = of[i]->material;
    const double width = std::min(std::max(material.alpha_x, material.alpha_y), 0.25);
    // A turn of the normals by half of the width moves the lobe by half of it, too.
    narrowest = std::min(narrowest, static_cast<float>(0.5 * std::min(material.alpha_x, material.alpha_y)));
    walkers[i] = Walker{frame,
                        lobe,
                        static_cast<double>(gathered_fraction(*of[i], mirrored_rays)),
                        static_cast<float>(width * std::exp2(-1.0 - static_cast<double>(level))),
                        lobes::known_albedo(of[i]->material, static_cast<double>(dot(of[i]->normal, surfaces.view[i]))),
                        Vec3d{},
                        s.material->solid};
    asked |= 1u << i;
  }
  Quarters<Vec3f> light{};
  std::array<Vec3f, kLanes> widened{};  // change by the added width
  std::array<Vec3f, kLanes> squares{};  // of the radiance that the directions see
  for (std::size_t k = 0; k < count; ++k) {
    std::array<Vec3f, kLanes> weight{}, to{};
    SixteenSurfaces::each(asked, [&](std::size_t i) {
      const auto [u, v] = place_in_lobe(k, count, i, static_cast<double>(sample % samples_) / samples_);
      const lobes::Lobe& lobe = walkers[i]->lobe;
      const Vec3d l = lobe.sample(u, v);
      if (!(l.z > 0)) return;
      const double pdf = lobe.pdf(l);
      if (!(pdf > 0)) return;
      const Vec3d whole = lobe.radiance(lobe.evaluate(l)) * (1 / (pdf * static_cast<double>(count)));
      walkers[i]->weights += whole;
      weight[i] = static_cast<Vec3f>(whole * walkers[i]->fraction);
      to[i] = static_cast<Vec3f>(walkers[i]->frame.to_world(l));
      rays.set(i, to[i]);
    });
    const auto met = rays.trace();
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (met[i].side == kNoSide) continue;
      const Vec3f weighted = weight[i] * rays.tint(i);
      const Vec3f radiance = light_.radiance(met[i]);
      light[i][k % 4] += radiance * weighted;
      squares[i] += radiance * radiance * weighted;
      if (!light_.has_lobe(met[i].side)) continue;
      const Vec3f of_lobe = light_.glossy_radiance(met[i].side, -to[i], walkers[i]->wider);
      light[i][k % 4] += of_lobe * weighted;
      // One direction of four tells the change.
      if (k % 4 == 0) widened[i] += (of_lobe - light_.glossy_radiance(met[i].side, -to[i], 0)) * (weighted * 4);
    }
  }
  std::array<Gathered, kLanes> gathered{};
  SixteenSurfaces::each(asked, [&](std::size_t i) {
    if (walkers[i]->albedo)
      for (Vec3f& quarter : light[i]) quarter = quarter * static_cast<Vec3f>(ratio(*walkers[i]->albedo, walkers[i]->weights));
    gathered[i] = mean_of_quarters(light[i], kEvenQuarters);
  });
  const BlockFit fit(surfaces, asked, strict_, narrowest);
  Lit lit;
  SixteenSurfaces::each(asked, [&](std::size_t i) {
    const FittedValue fitted = fit.at(i, gathered, BlockFit::Keeps::own_values);
    lit.result.radiance[i] = fitted.value;
    lit.standard[i] = fitted.standard + absolute(widened[i]);
    lit.result.error[i] = fitted.error + absolute(widened[i]);
    if (walkers[i]->is_solids) {
      const Vec3f whole = static_cast<Vec3f>(walkers[i]->weights * walkers[i]->fraction);
      lit.result.error[i] += spread(squares[i], gathered[i].value, whole) * kShapeOfSolids;
    }
  });
  return lit;
}

void Gather::add(const Result& result, Result& sum) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    sum.radiance[i] += result.radiance[i];
    sum.error[i] += result.error[i];
  }
}

// Adds the diffuse light of the surfaces that have such a lobe, by more directions until its standard errors are within the tolerance.
void Gather::add_diffuse(const SixteenSurfaces& surfaces, int sample, std::size_t block, const Sums* first, Result& sum) const {
  const std::uint32_t asked = with_diffuse(surfaces);
  if (asked == 0) return;
  std::size_t level = strict_ ? kFinest : 0;
  Lit lit = diffuse(surfaces, asked, sample, level, block, level == 0 ? first : nullptr);
  while (level < kFinest && !is_within(lit)) lit = diffuse(surfaces, asked, sample, ++level, block, nullptr);
  add(lit.result, sum);
}

void Gather::add_glossy(const SixteenSurfaces& surfaces, int sample, Asked asked, Result& sum) const {
  std::array<std::vector<SurfaceLobe>, kLanes> lobes;
  std::size_t most = 0;
  SixteenSurfaces::each(surfaces.lit, [&](std::size_t i) {
    for (SurfaceLobe& lobe : lobes_of(surfaces.surface[i]))
      if (lobe.material.brdf != Brdf::lambert && gathered_fraction(lobe, asked.mirrored_rays) > 0) lobes[i].push_back(std::move(lobe));
    most = std::max(most, lobes[i].size());
  });
  for (std::size_t k = 0; k < most; ++k) {
    std::array<const SurfaceLobe*, kLanes> of{};
    for (std::size_t i = 0; i < kLanes; ++i)
      if (k < lobes[i].size()) of[i] = &lobes[i][k];
    std::size_t level = strict_ ? kFinest : 0;
    Lit lit = glossy(surfaces, of, sample, asked.mirrored_rays, level);
    const bool must_be_smooth = asked.smooth && reflects_much(surfaces, of);
    while (level < kFinest && (!is_within(lit) || (level == 0 && must_be_smooth && !lit.is_smooth())))
      lit = glossy(surfaces, of, sample, asked.mirrored_rays, ++level);
    add(lit.result, sum);
  }
}

Gather::Result Gather::reflected(const SixteenSurfaces& surfaces, int sample, Asked asked) const {
  Result result;
  add_diffuse(surfaces, sample, 0, nullptr, result);
  add_glossy(surfaces, sample, asked, result);
  return result;
}

std::array<Gather::Result, 4> Gather::reflected(const FourBlocks& blocks, int sample, Asked asked) const {
  std::array<Result, 4> results;
  std::array<Sums, 4> first;
  std::array<Lit, 4> lit;
  const auto is_diffuse = [](const SixteenSurfaces& block) { return with_diffuse(block) == kAllLanes; };
  const bool may_join = !strict_ && std::all_of(blocks.begin(), blocks.end(), is_diffuse) && in_one_plane(blocks);
  if (may_join && every_other_) diffuse_of_every_other(blocks, sample, lit);
  const bool joined = may_join && (every_other_ || diffuse_of_square(blocks, sample, first, lit));
  for (std::size_t b = 0; b < 4; ++b) {
    if (joined)
      add(lit[b].result, results[b]);
    else
      add_diffuse(blocks[b], sample, b, may_join ? &first[b] : nullptr, results[b]);
    add_glossy(blocks[b], sample, asked, results[b]);
  }
  return results;
}

}  // namespace steradian::radiosity
