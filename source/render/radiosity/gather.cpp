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
#include "render/radiosity/mirrors.h"

namespace steradian::radiosity {
namespace {

constexpr int kMostShifts = 16;  // of the grid; more primary samples repeat them

// Place of each of 4 x 4 pixels in a cell of the grid, a number of 4 x 4. Neither coordinate of the place, nor its first waves, has a
// component along those of the pixel: the linear fit would keep it.
constexpr std::array<int, 16> kPlaces = {1, 14, 10, 5, 15, 8, 0, 7, 4, 3, 11, 12, 6, 9, 13, 2};

// Quarter of the directions that one of the grid belongs to: every other row and column.
std::size_t quarter_of(std::size_t direction, std::size_t count) {
  const auto columns = static_cast<std::size_t>(std::lround(std::sqrt(2.0 * static_cast<double>(count))));  // twice the rows
  return direction / columns % 2 * 2 + direction % 2;
}

Vec3f absolute(Vec3f v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

// Standard error of a mean from the values of four quarters.
Vec3f error_of_quarters(const std::array<Vec3f, 4>& values, Vec3f mean) {
  Vec3f squares{};
  for (const Vec3f& v : values) squares += (v - mean) * (v - mean);
  return {std::sqrt(squares.x / 12), std::sqrt(squares.y / 12), std::sqrt(squares.z / 12)};
}

Vec3d ratio(Vec3d a, Vec3d b) {
  const auto one = [](double x, double y) { return y > 0 ? x / y : 1.0; };
  return {one(a.x, b.x), one(a.y, b.y), one(a.z, b.z)};
}

// Fraction of a lobe's light that its own directions gather.
float gathered_fraction(const SurfaceLobe& lobe) {
  const Material& m = lobe.material;
  return m.brdf == Brdf::ggx ? 1 - mirrored_fraction(static_cast<float>(m.alpha_x), static_cast<float>(m.alpha_y)) : 1;
}

// Joins the values of sixteen pixels, 4 x 4, by linear fits over those of one plane.
class BlockFit {
 public:
  static constexpr std::size_t kLanes = SixteenSurfaces::kLanes;
  // strict: every pixel keeps its own value.
  BlockFit(const SixteenSurfaces& surfaces, std::uint32_t asked, bool strict) : surfaces_(surfaces), asked_(asked), strict_(strict) {}

  // The value of the fit at a pixel, and an estimate of its error: two standard errors, and the distance from the pixel's own value. Few
  // pixels keep their own.
  //
  //   errors  of the values, from their rays. keeps: the pixel's own value takes the place of the fit's where the values differ more than
  //           that
  struct Value {
    Vec3f value, error;
  };
  enum class Keeps { nothing, own_values };
  Value at(std::size_t lane, const std::array<Vec3f, kLanes>& values, const std::array<Vec3f, kLanes>& errors, Keeps keeps) const {
    if (strict_) return {values[lane], errors[lane] * kDeviations};
    std::uint32_t same = 0;
    const Surface& here = surfaces_.surface[lane];
    SixteenSurfaces::each(asked_, [&](std::size_t i) {
      const Surface& there = surfaces_.surface[i];
      const Vec3f way = there.position - here.position;
      if (dot(here.normal, there.normal) > kSameDirection && std::fabs(dot(way, here.normal)) <= kFlat * length(way)) same |= 1u << i;
    });
    const int count = std::popcount(same);
    if (count < kFewest) return {values[lane], errors[lane] * kDeviations};
    // Least squares in coordinates about the mean: the two slopes and the mean are nearly independent.
    float mean_x = 0, mean_y = 0;
    Vec3f mean{};
    SixteenSurfaces::each(same, [&](std::size_t i) {
      mean_x += x_of(i);
      mean_y += y_of(i);
      mean += values[i];
    });
    const float over = 1 / static_cast<float>(count);
    mean_x *= over;
    mean_y *= over;
    mean = mean * over;
    float xx = 0, xy = 0, yy = 0;
    Vec3f vx{}, vy{}, low = values[lane], high = values[lane];
    SixteenSurfaces::each(same, [&](std::size_t i) {
      const float x = x_of(i) - mean_x, y = y_of(i) - mean_y;
      xx += x * x;
      xy += x * y;
      yy += y * y;
      vx += values[i] * x;
      vy += values[i] * y;
      low = {std::min(low.x, values[i].x), std::min(low.y, values[i].y), std::min(low.z, values[i].z)};
      high = {std::max(high.x, values[i].x), std::max(high.y, values[i].y), std::max(high.z, values[i].z)};
    });
    const float determinant = xx * yy - xy * xy;
    Vec3f slope_x{}, slope_y{};
    if (determinant > 1) {
      slope_x = (vx * yy - vy * xy) * (1 / determinant);
      slope_y = (vy * xx - vx * xy) * (1 / determinant);
    }
    const auto fit = [&](std::size_t i) { return mean + slope_x * (x_of(i) - mean_x) + slope_y * (y_of(i) - mean_y); };
    Vec3f squares{}, of_rays{};
    SixteenSurfaces::each(same, [&](std::size_t i) {
      const Vec3f d = values[i] - fit(i);
      squares += d * d;
      of_rays += errors[i] * errors[i];
    });
    of_rays = of_rays * over;
    const Vec3f variance = squares * (1 / static_cast<float>(count - 3));
    // Slopes that the differences between the rays explain shrink to zero: they would show as steps from block to block.
    const auto shrunk = [&](Vec3f slope, float moment) {
      const auto kept = [&](float m, float v) { return m * m * moment > 0 ? std::max(1 - kDoubt * v / (m * m * moment), 0.0f) : 0.0f; };
      return slope * Vec3f{kept(slope.x, variance.x), kept(slope.y, variance.y), kept(slope.z, variance.z)};
    };
    slope_x = shrunk(slope_x, xx);
    slope_y = shrunk(slope_y, yy);
    const Vec3f value = fit(lane);
    const float share = 3 * over;  // of three parameters
    const auto joined = [&](float own, float fitted, float ray_variance, float fit_variance) {
      const bool keep = keeps == Keeps::own_values && fit_variance > kDoubt * ray_variance;
      const float kept = keep ? 1 - kDoubt * ray_variance / fit_variance : 0;  // of the own value
      const float deviation = std::sqrt((1 - kept) * (1 - kept) * share * fit_variance + kept * kept * kDoubt * ray_variance);
      return std::pair{fitted + (own - fitted) * kept, kDeviations * deviation + (1 - kept) * std::fabs(own - fitted)};
    };
    const Vec3f own = values[lane];
    const auto x = joined(own.x, std::clamp(value.x, low.x, high.x), of_rays.x, variance.x);
    const auto y = joined(own.y, std::clamp(value.y, low.y, high.y), of_rays.y, variance.y);
    const auto z = joined(own.z, std::clamp(value.z, low.z, high.z), of_rays.z, variance.z);
    return {{x.first, y.first, z.first}, {x.second, y.second, z.second}};
  }

 private:
  static constexpr float kSameDirection = 0.98f;  // cosine
  static constexpr float kFlat = 0.1f;            // distance from the plane over the distance
  static constexpr int kFewest = 6;               // pixels of a fit
  static constexpr float kDeviations = 2;         // standard errors of an error
  static constexpr float kDoubt = 4;              // variances below which a slope counts as chance
  static float x_of(std::size_t lane) { return static_cast<float>(lane % 4); }
  static float y_of(std::size_t lane) { return static_cast<float>(lane / 4); }

  const SixteenSurfaces& surfaces_;
  const std::uint32_t asked_;
  const bool strict_;
};

}  // namespace

Gather::Gather(const PatchLight& light, const RayScene& rays, const Fineness& fineness, const Options& options)
    : light_(light),
      rays_(rays),
      strict_(options.strict),
      samples_(std::min(options.samples, kMostShifts)),
      lobe_rays_(fineness.lobe_rays),
      tolerance_(static_cast<float>(options.error * light.mean_radiance())) {
  for (int level = 0; level <= (options.error > 0 || strict_ ? kFinest : 0); ++level) add_grids(fineness.rows << level);
  const auto rays_over_sphere = static_cast<float>(grids_[0][0].size());
  near_ = std::sqrt(kLanes * light.bright_area() * rays_over_sphere / (4 * std::numbers::pi_v<float>));
}

// Adds the grids of a level, one for each primary sample.
void Gather::add_grids(int rows) {
  const int columns = 2 * rows;
  std::vector<std::vector<Cell>>& grids = grids_.emplace_back();
  for (int s = 0; s < samples_; ++s) {
    std::vector<Cell>& cells = grids.emplace_back();
    // The pixels take the places of a 4 x 4 grid in each cell; the primary samples, places in a cell of that.
    const double in_x = (s + 0.5) / samples_, in_y = std::fmod(s * kGolden + 0.5, 1.0);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        Cell& cell = cells.emplace_back();
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
    const std::uint32_t visible = traced & ~rays_.blocked_among(rays, traced, Casters::all);
    light_.patches().clear_meshes().tint(rays_, rays, visible, light);
    SixteenSurfaces::each(visible, [&](std::size_t i) { quarters[i][quarter] += light[i]; });
  }
}

// The mean radiance about each surface, weighted by the cosine, times its albedo.
Gather::Result Gather::diffuse(const SixteenSurfaces& surfaces, std::uint32_t asked, int sample, std::size_t level) const {
  Quarters<Vec3f> light{}, bright{};
  Quarters<float> weight{};
  std::array<Vec3f, kLanes> basis{};  // what the size of the patches changes
  BounceRays rays(rays_, light_.patches());
  SixteenSurfaces::each(asked, [&](std::size_t i) { rays.start(i, surfaces.surface[i]); });
  const std::vector<Cell>& cells = grids_[level][static_cast<std::size_t>(sample % samples_)];
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::size_t quarter = quarter_of(k, cells.size());
    std::array<float, kLanes> cosine{};
    SixteenSurfaces::each(asked, [&](std::size_t i) {
      const Vec3f to = cells[k].direction[i];
      cosine[i] = dot(surfaces.surface[i].normal, to);
      if (!(cosine[i] > 0)) return;
      weight[i][quarter] += cosine[i];
      rays.set(i, to);
    });
    const auto met = rays.trace();
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (met[i].side == kNoSide) continue;
      if (light_.is_bright(met[i].side) && rays.distance(i) > near_) continue;
      const Vec3f weighted = rays.tint(i) * cosine[i], radiance = light_.radiance(met[i]) * weighted;
      light[i][quarter] += light_.glossy_radiance(met[i].side, -cells[k].direction[i]) * weighted + radiance;
      basis[i] += radiance - light_.coarse_radiance(met[i]) * weighted;
    }
  }
  add_bright(surfaces, asked, sample, level, bright);
  std::array<Vec3f, kLanes> mean{}, error{}, of_bright{}, error_of_bright{};
  SixteenSurfaces::each(asked, [&](std::size_t i) {
    const std::array<float, 4>& w = weight[i];
    const float whole = w[0] + w[1] + w[2] + w[3];
    const auto over = [](Vec3f sum, float by) { return by > 0 ? sum * (1 / by) : Vec3f{}; };
    std::array<Vec3f, 4> of_rays, of_places;
    for (std::size_t q = 0; q < 4; ++q) {
      mean[i] += over(light[i][q], whole);
      of_bright[i] += bright[i][q];
      of_rays[q] = over(light[i][q], w[q]);
      of_places[q] = bright[i][q] * 4;
    }
    error[i] = error_of_quarters(of_rays, mean[i]);
    error_of_bright[i] = error_of_quarters(of_places, of_bright[i]);
    basis[i] = absolute(over(basis[i], whole));
  });
  const BlockFit fit(surfaces, asked, strict_);
  Result result;
  SixteenSurfaces::each(asked, [&](std::size_t i) {
    const Surface& s = surfaces.surface[i];
    const double cos_view = std::max(static_cast<double>(dot(s.normal, surfaces.view[i])), 0.0);
    const auto passed = static_cast<float>(1 - static_cast<double>(s.fresnel_loss) * environment::mean_grazing(cos_view));
    const BlockFit::Value rays_value = fit.at(i, mean, error, BlockFit::Keeps::own_values);
    // The places of a pixel lie between those of its neighbours: its quarters are nearer to each other than to the truth.
    const BlockFit::Value bright_value = fit.at(i, of_bright, error_of_bright, BlockFit::Keeps::nothing);
    result.radiance[i] = s.albedo * (rays_value.value + bright_value.value) * passed;
    result.error[i] = s.albedo * (rays_value.error + bright_value.error + basis[i]) * passed;
  });
  return result;
}

// One glossy lobe of each surface that has one.
Gather::Result Gather::glossy(const SixteenSurfaces& surfaces, const std::array<const SurfaceLobe*, kLanes>& of, int sample,
                              std::size_t level) const {
  const std::size_t count = lobe_rays_ << (2 * level);
  struct Walker {
    Frame frame;
    lobes::Lobe lobe;
    double fraction;  // of the lobe that these directions gather
    float wider;      // added width of the lobes that it sees: the rays of a wide lobe are far apart, and would miss their highlights
    std::optional<Vec3d> albedo;
    Vec3d weights;  // sum over the directions, which the albedo corrects
  };
  std::array<std::optional<Walker>, kLanes> walkers;
  BounceRays rays(rays_, light_.patches());
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (of[i] == nullptr) continue;
    const Surface& s = surfaces.surface[i];
    const Vec3d tangent = of[i]->material.tangent == Vec3d{} ? static_cast<Vec3d>(s.tangent) : of[i]->material.tangent;
    const Frame frame = Frame::from_normal_and_tangent(normalized(static_cast<Vec3d>(of[i]->normal)), tangent);
    const lobes::Lobe lobe(lobes::in_frame(of[i]->material, frame), normalized(frame.to_local(static_cast<Vec3d>(surfaces.view[i]))));
    if (!lobe.above_surface()) continue;
    rays.start(i, s);
    walkers[i] = Walker{frame,
                        lobe,
                        static_cast<double>(gathered_fraction(*of[i])),
                        static_cast<float>(std::min(std::max(of[i]->material.alpha_x, of[i]->material.alpha_y), 0.25) * 2),
                        lobes::known_albedo(of[i]->material, static_cast<double>(dot(of[i]->normal, surfaces.view[i]))),
                        Vec3d{}};
  }
  std::array<std::array<Vec3f, 2>, kLanes> halves{};
  for (std::size_t k = 0; k < count; ++k) {
    const auto [u, v] = fibonacci_place(k, count, static_cast<double>(sample % samples_) / samples_);
    std::array<Vec3f, kLanes> weight{}, to{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (!walkers[i]) continue;
      const lobes::Lobe& lobe = walkers[i]->lobe;
      const Vec3d l = lobe.sample(u, v);
      if (!(l.z > 0)) continue;
      const double pdf = lobe.pdf(l);
      if (!(pdf > 0)) continue;
      const Vec3d whole = lobe.radiance(lobe.evaluate(l)) * (1 / (pdf * static_cast<double>(count)));
      walkers[i]->weights += whole;
      weight[i] = static_cast<Vec3f>(whole * walkers[i]->fraction);
      to[i] = static_cast<Vec3f>(walkers[i]->frame.to_world(l));
      rays.set(i, to[i]);
    }
    const auto met = rays.trace();
    for (std::size_t i = 0; i < kLanes; ++i)
      if (met[i].side != kNoSide)
        halves[i][k % 2] +=
            (light_.radiance(met[i]) + light_.glossy_radiance(met[i].side, -to[i], walkers[i]->wider)) * weight[i] * rays.tint(i);
  }
  Result result;
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (walkers[i] && walkers[i]->albedo)
      for (Vec3f& half : halves[i]) half = half * static_cast<Vec3f>(ratio(*walkers[i]->albedo, walkers[i]->weights));
    result.radiance[i] = halves[i][0] + halves[i][1];
    const Vec3f d = halves[i][0] - halves[i][1];  // each half stands for half of the light
    result.error[i] = {std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
  }
  return result;
}

// Adds the first result of of(level), from the coarsest level on, whose errors are all within the tolerance, or that of the finest level.
template <class Of>
void Gather::refine(Of of, Result& sum) const {
  Result result;
  for (std::size_t level = strict_ ? grids_.size() - 1 : 0; level < grids_.size(); ++level) {
    result = of(level);
    const auto is_within = [&](Vec3f error) { return std::max({error.x, error.y, error.z}) <= tolerance_; };
    if (std::all_of(result.error.begin(), result.error.end(), is_within)) break;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    sum.radiance[i] += result.radiance[i];
    sum.error[i] += result.error[i];
  }
}

Gather::Result Gather::reflected(const SixteenSurfaces& surfaces, int sample) const {
  Result result;
  std::array<std::vector<SurfaceLobe>, kLanes> lobes;
  std::uint32_t with_diffuse = 0;
  std::size_t most = 0;
  SixteenSurfaces::each(surfaces.lit, [&](std::size_t i) {
    for (SurfaceLobe& lobe : lobes_of(surfaces.surface[i])) {
      if (lobe.material.brdf == Brdf::lambert)
        with_diffuse |= 1u << i;
      else if (gathered_fraction(lobe) > 0)
        lobes[i].push_back(std::move(lobe));
    }
    most = std::max(most, lobes[i].size());
  });
  if (with_diffuse != 0) refine([&](std::size_t level) { return diffuse(surfaces, with_diffuse, sample, level); }, result);
  for (std::size_t k = 0; k < most; ++k) {
    std::array<const SurfaceLobe*, kLanes> of{};
    for (std::size_t i = 0; i < kLanes; ++i)
      if (k < lobes[i].size()) of[i] = &lobes[i][k];
    refine([&](std::size_t level) { return glossy(surfaces, of, sample, level); }, result);
  }
  return result;
}

}  // namespace steradian::radiosity
