#include "render/certificate/bounce_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

#include "shapes/triangulate.h"
#include "steradian/area_light.h"
#include "steradian/error.h"

namespace steradian::certificate {
namespace {

constexpr double kEnough = 0.2;    // width of a factor's range that is not split, over the mean of the factors of a row
constexpr double kBright = 0.999;  // largest albedo for which a bound exists that iterations reach

std::size_t patches_for(const RenderOptions& options) {
  switch (options.quality) {
    case Quality::draft: return 400;
    case Quality::high: return 4'000;
    case Quality::normal: break;
  }
  return 1'200;
}

void refuse(const std::string& place, const std::string& problem) {
  throw UsageError("--bound", place + " " + problem, "there is a proof for flat diffuse surfaces of one colour and polygon lights only");
}

double component(const Vec3d& v, int channel) { return channel == 0 ? v.x : channel == 1 ? v.y : v.z; }
double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

// All factors of a row add up to 1 at most. An upper sum therefore begins with the lower factors, and raises those of the brightest sides
// first.
class BounceBounds::RowSum {
 public:
  void add(double low, double high, const RadianceRange& radiance) { terms_.push_back({low, high, radiance}); }

  RadianceRange result() {
    constexpr double kRounding = 1e-9;
    RadianceRange sum;
    double lows = 0, highs = 0;
    for (const Term& t : terms_) {
      sum.low += t.radiance.low * t.low;
      sum.high += t.radiance.high * t.high;
      lows += t.low;
      highs += t.high;
    }
    if (highs > 1) {
      const auto capped = [&](int channel) {
        std::sort(terms_.begin(), terms_.end(), [channel](const Term& a, const Term& b) {
          return component(a.radiance.high, channel) > component(b.radiance.high, channel);
        });
        double left = std::max(1 + kRounding - lows, 0.0), total = 0;
        for (const Term& t : terms_) {
          const double more = std::min(t.high - t.low, left);
          left -= more;
          total += (t.low + more) * component(t.radiance.high, channel);
        }
        return total;
      };
      const double x = capped(0), y = capped(1), z = capped(2);
      sum.high = {x, y, z};
    }
    sum.low = sum.low * (1 - kRounding);
    sum.high = sum.high * (1 + kRounding);
    return sum;
  }

 private:
  struct Term {
    double low, high;
    RadianceRange radiance;
  };
  std::vector<Term> terms_;
};

void BounceBounds::check(const Scene& scene, const RenderOptions& options) {
  if (scene.environment != nullptr) refuse("the scene", "has an environment");
  for (const PunctualLight& light : scene.punctual_lights) refuse("the light \"" + light.name + "\"", "is no polygon");
  for (const AreaLight& light : scene.area_lights) {
    const std::string name = "the light \"" + light.name + "\"";
    if (!std::holds_alternative<Polygon>(light.shape)) refuse(name, "is no polygon");
    if (light.texture || light.emission) refuse(name, "does not shine evenly");
  }
  for (const Mesh& mesh : scene.meshes) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    const std::string name = "the material \"" + m.name + "\"";
    if (mesh.is_light_shape) continue;
    if (!mesh.casts_shadow || m.transmission > 0 || m.alpha_mode != AlphaMode::opaque) refuse(name, "lets light through");
    if (m.unlit) refuse(name, "is unlit");
    const bool shines = m.metallic > 0 || m.specular > 0 || m.clearcoat > 0 || m.sheen_color != Vec3f{} || !m.specular_override.empty();
    if (shines) refuse(name, "has more lobes than the diffuse one");
    if (m.base_color_texture.image >= 0 || m.normal_texture.image >= 0 || !mesh.colors.empty()) refuse(name, "has a texture");
    if (std::max({m.base_color.x, m.base_color.y, m.base_color.z}) > static_cast<float>(kBright)) refuse(name, "reflects all light");
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      constexpr float kFlat = 1e-4f;
      const auto at = [&](std::size_t k) { return mesh.indices[3 * t + k]; };
      const Vec3f a = mesh.positions[at(0)], n = cross(mesh.positions[at(1)] - a, mesh.positions[at(2)] - a);
      for (std::size_t k = 0; k < 3 && length(n) > 0; ++k)
        if (length(mesh.normals[at(k)] - n / length(n)) > kFlat)
          refuse("the mesh \"" + mesh.name + "\"", "has normals that are not its faces'");
    }
  }
  constexpr std::size_t kMostSides = 20'000;  // rows hold up to the square of it
  if (steps(scene, options) > kMostSides) refuse("the scene", "has too many triangles");
}

BounceBounds::BounceBounds(const Scene& scene, const RayScene& rays, const RenderOptions& options, const std::function<void()>& done)
    : rays_(rays), patches_(scene, patches_for(options)), occluders_(scene) {
  const std::size_t count = patches_.side_count();
  for (std::size_t s = 0; s < count; ++s) {
    const radiosity::Patches::Site& at = patches_.site(static_cast<std::uint32_t>(s));
    const Mesh& mesh = scene.meshes[at.mesh];
    const auto corner = [&](std::size_t k) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * std::size_t{at.triangle} + k]]); };
    const Vec3d a = corner(0), along_u = corner(1) - a, along_v = corner(2) - a;
    // The middle of a cell is a third or two thirds of a step from its lower corner; those in between are turned by half a turn.
    const double step = static_cast<double>(at.step), cell = static_cast<double>(at.u) / step;
    const double scale = cell - std::floor(cell) > 0.5 ? -step : step;
    const auto place = [&](double u, double v) {
      return a + along_u * (static_cast<double>(at.u) + (u - 1.0 / 3) * scale) +
             along_v * (static_cast<double>(at.v) + (v - 1.0 / 3) * scale);
    };
    const OrientedTriangle front = OrientedTriangle::of({place(0, 0), place(1, 0), place(0, 1)});
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    const Vec3d albedo{m.base_color.x, m.base_color.y, m.base_color.z};
    sides_.push_back({radiosity::Patches::is_front(static_cast<std::uint32_t>(s)) ? front : front.reversed(), albedo, {}});
  }
  add_lamps(scene);
  find_rows(done);
  solve(options.bounces);
}

std::size_t BounceBounds::steps(const Scene& scene, const RenderOptions& options) {
  return radiosity::Patches(scene, patches_for(options)).side_count();
}

// Cuts the lights into triangles of about the elements' size.
void BounceBounds::add_lamps(const Scene& scene) {
  double size = 0;
  for (const BoundedSide& side : sides_) size = std::max(size, side.triangle.radius);
  for (const AreaLight& light : scene.area_lights) {
    const PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
    if (!(polygon.area > 0)) continue;
    const Frame frame = Frame::from_normal(polygon.normal);
    Contours contours;
    std::vector<Vec3d> corners;
    for (std::size_t c = 0; c + 1 < polygon.contours.size(); ++c) {
      contours.emplace_back();
      for (std::size_t i = polygon.contours[c + 1]; i-- > polygon.contours[c];) {  // in stored order, the reverse of a walk's
        const Vec3d local = frame.to_local(polygon.vertices[i] - polygon.centroid);
        contours.back().push_back({local.x, local.y});
        corners.push_back(polygon.vertices[i]);
      }
    }
    const auto triangles = triangles_of(contours);
    if (!triangles) refuse("the light \"" + light.name + "\"", "has an outline that crosses itself");
    std::vector<OrientedTriangle> parts;
    for (const auto& t : *triangles) parts.push_back(OrientedTriangle::of({corners[t[0]], corners[t[1]], corners[t[2]]}));
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i].radius > size) {
        const auto quarters = parts[i].quarters();
        parts.insert(parts.end(), quarters.begin(), quarters.end());
        parts[i].area = 0;
      }
    for (const OrientedTriangle& part : parts) {
      if (!(part.area > 0)) continue;
      lamps_.push_back({part, light.radiance});
      if (light.two_sided) lamps_.push_back({part.reversed(), light.radiance});
    }
  }
}

void BounceBounds::find_rows(const std::function<void()>& done) {
  const std::size_t count = sides_.size();
  rows_.resize(count);
  direct_.resize(count);
  const double enough = kEnough * 2 / static_cast<double>(count);  // half of the sides are seen by none
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const BoundedSide& side = sides_[i];
    if (largest(side.albedo) > 0 && side.triangle.area > 0) {
      for (std::size_t j = 0; j < count; ++j) {
        if (!(largest(sides_[j].albedo) > 0) || !(sides_[j].triangle.area > 0)) continue;
        const FactorRange r = factor_range(side.triangle, sides_[j].triangle, occluders_, false, enough);
        if (r.high > 0)
          rows_[i].push_back({static_cast<std::uint32_t>(j), std::nextafter(static_cast<float>(r.low), 0.0f),
                              std::nextafter(static_cast<float>(r.high), 2.0f), r.is_open});
      }
      for (const Lamp& lamp : lamps_) {
        const FactorRange r = factor_range(side.triangle, lamp.triangle, occluders_, true, enough / 16);
        direct_[i].low += lamp.radiance * r.low;
        direct_[i].high += lamp.radiance * r.high;
      }
    }
    done();
  });
}

RadianceRange BounceBounds::reflected(std::size_t i) const {
  RowSum sum;
  for (const RowEntry& e : rows_[i]) sum.add(static_cast<double>(e.low), static_cast<double>(e.high), sides_[e.side].radiance);
  const RadianceRange gathered = sum.result();
  return {(direct_[i].low + gathered.low) * sides_[i].albedo, (direct_[i].high + gathered.high) * sides_[i].albedo};
}

// Each iteration adds a bounce to bounds that begin with darkness. For all bounces, upper bounds begin above the solution instead, and stay
// above it.
void BounceBounds::solve(int bounces) {
  constexpr int kMost = 200;
  const bool all = bounces < 0;
  if (all) {
    for (int channel = 0; channel < 3; ++channel) {
      double direct = 0, albedo = 0;
      for (std::size_t i = 0; i < sides_.size(); ++i) {
        direct = std::max(direct, component(direct_[i].high, channel));
        albedo = std::max(albedo, component(sides_[i].albedo, channel));
      }
      for (BoundedSide& side : sides_) {
        double& high = channel == 0 ? side.radiance.high.x : channel == 1 ? side.radiance.high.y : side.radiance.high.z;
        high = direct * albedo / (1 - albedo);
      }
    }
  }
  for (int k = 0; k < (all ? kMost : bounces); ++k) {
    std::vector<RadianceRange> next(sides_.size());
    tbb::parallel_for(std::size_t{0}, sides_.size(), [&](std::size_t i) { next[i] = reflected(i); });
    double change = 0, most = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      RadianceRange& radiance = sides_[i].radiance;
      change = std::max({change, largest(next[i].low - radiance.low), largest(radiance.high - next[i].high)});
      most = std::max(most, largest(next[i].high));
      radiance = next[i];
    }
    constexpr double kSettled = 1e-4;
    if (all && change <= kSettled * most) break;
  }
}

std::uint32_t BounceBounds::side_at(Vec3d position, Vec3d normal) const {
  RTCRayHit hit;
  const Vec3f direction = -static_cast<Vec3f>(normal);
  if (!rays_.intersect(static_cast<Vec3f>(rays_.off_surface(position, normal)), direction, hit)) return radiosity::kNoSide;
  const float towards = hit.hit.Ng_x * direction.x + hit.hit.Ng_y * direction.y + hit.hit.Ng_z * direction.z;
  return patches_.place_at(hit.hit.geomID, hit.hit.primID, hit.hit.u, hit.hit.v, towards < 0).side;
}

RadianceRange BounceBounds::white_at(Vec3d position, Vec3d normal) const {
  const std::uint32_t own = side_at(position, normal);
  if (own == radiosity::kNoSide) return {{}, Vec3d{1, 1, 1} * std::numeric_limits<double>::infinity()};
  const std::vector<RowEntry>& row = rows_[own];
  const auto width = [&](const RowEntry& e) { return static_cast<double>(e.high - e.low) * largest(sides_[e.side].radiance.high); };
  double mean = 0;
  for (const RowEntry& e : row) mean += width(e) / static_cast<double>(row.size());
  RowSum sum;
  const OrientedTriangle point = OrientedTriangle::point(position, normal, rays_.offset_from_surface(position));
  for (const RowEntry& e : row) {
    const BoundedSide& side = sides_[e.side];
    FactorRange r = {static_cast<double>(e.low), static_cast<double>(e.high)};
    constexpr double kNarrow = 0.1;  // entries whose ranges are of no consequence stay as they are
    if (width(e) > kNarrow * mean) {
      const FactorRange at =
          e.is_open ? whole_range(point, side.triangle) : factor_range(point, side.triangle, occluders_, false, kNarrow * r.high);
      r.low = std::max(at.low, r.low);
      r.high = std::max(std::min(at.high, r.high), r.low);
    }
    sum.add(r.low, r.high, side.radiance);
  }
  return sum.result();
}

}  // namespace steradian::certificate
