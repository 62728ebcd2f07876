#include "fit/textured_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/random.h"
#include "integrals/tables/ggx_tables.h"
#include "integrals/textured/textured_light.h"
#include "lobes/lobe.h"

namespace steradian::fit {
namespace {

using reference::Random;

constexpr double kRoughness[] = {0, 0.1, 0.2, 0.35, 0.5, 0.8};
constexpr double kDistances[] = {0.5, 1, 2};
constexpr int kTexels = 128;
constexpr std::uint64_t kSeed = 20;

NamedImage made(const std::string& name, const std::function<double(double u, double v)>& value) {
  NamedImage result{name, {name, kTexels, kTexels, {}}};
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      const double t = value((x + 0.5) / kTexels, (y + 0.5) / kTexels);
      const auto code = static_cast<std::uint8_t>(std::lround(255 * std::clamp(t, 0.0, 1.0)));
      result.image.rgba.insert(result.image.rgba.end(), {code, code, code, 255});
    }
  return result;
}

// Waves of random direction and phase, with equal number and power in every octave: the density of power over the plane of frequencies
// falls as 1/f^2.
double waves(double u, double v) {
  Random random(kSeed);
  double sum = 0.5;
  for (int i = 0; i < 48; ++i) {
    const double frequency = std::exp2(5.0 * i / 48), angle = random.uniform(0, 2 * M_PI), phase = random.uniform(0, 2 * M_PI);
    sum += 0.04 * std::sin(2 * M_PI * frequency * (u * std::cos(angle) + v * std::sin(angle)) + phase);
  }
  return sum;
}

struct Setup {
  AreaLight light;
  ShadingPoint at;
};

// A square of side 1 facing the origin, tilted by up to 60 degrees, its centre within half its size of the mirror direction.
Setup random_setup(Random& random, double distance) {
  Setup s;
  s.at.normal = {0, 0, 1};
  const double theta = std::acos(random.uniform(0.17, 0.94)), phi = random.uniform(-M_PI, M_PI);  // 20 to 80 degrees
  s.at.view = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  const Vec3d mirror{-s.at.view.x, -s.at.view.y, s.at.view.z};
  const double tilt = random.uniform(0, M_PI / 3), around = random.uniform(-M_PI, M_PI), turn = random.uniform(-M_PI, M_PI);
  const Frame to_light = Frame::from_normal(-mirror);
  const Vec3d normal = to_light.to_world({std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)});
  const Frame plane = Frame::from_normal(normal);
  const Vec3d x = plane.to_world({std::cos(turn), std::sin(turn), 0}), y = plane.to_world({-std::sin(turn), std::cos(turn), 0});
  const Vec3d center = mirror * distance + x * random.uniform(-0.5, 0.5) + y * random.uniform(-0.5, 0.5);
  s.light.shape =
      Polygon{{center - x * 0.5 - y * 0.5, center + x * 0.5 - y * 0.5, center + x * 0.5 + y * 0.5, center - x * 0.5 + y * 0.5}, {}};
  s.light.texture = LightTexture{};
  LightTexture& t = *s.light.texture;
  t.origin = std::get<Polygon>(s.light.shape).vertices[0];
  t.du = x;
  t.dv = y;
  return s;
}

// Integrals of the lobe over the light, plain and times each texture: a grid on the light and one on the lobe's own square, weighted by the
// balance heuristic.
std::vector<double> integrate(const Setup& s, const Material& material, const std::vector<std::vector<Image>>& images, int n) {
  const lobes::Lobe lobe(material, s.at.view);
  const LightTexture& t = *s.light.texture;
  const Vec3d normal = cross(t.du, t.dv);
  const double height = dot(normal, t.origin);
  std::vector<double> sums(images.size() + 1);
  const auto add = [&](Vec3d l, Vec3d p, double d2) {
    const double light_pdf = d2 / std::fabs(dot(normal, l));
    const double w = lobe.evaluate(l).plain / (light_pdf + lobe.pdf(l));
    if (!(w > 0)) return;
    sums[0] += w;
    for (std::size_t i = 0; i < images.size(); ++i) sums[i + 1] += w * texture_radiance(t, images[i], p).x;
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = (i + 0.5) / n, v = (j + 0.5) / n;
      const Vec3d p = t.origin + t.du * u + t.dv * v;
      const double d2 = dot(p, p);
      const Vec3d l = p / std::sqrt(d2);
      if (l.z > 0) add(l, p, d2);
      const Vec3d by_lobe = lobe.sample(u, v);
      const double along = dot(normal, by_lobe);
      if (!(by_lobe.z > 0) || !(along * height > 0)) continue;
      const Vec3d q = by_lobe * (height / along), r = q - t.origin;
      const double a = dot(r, t.du), b = dot(r, t.dv);
      if (a >= 0 && a < 1 && b >= 0 && b < 1) add(by_lobe, q, dot(q, q));
    }
  for (double& sum : sums) sum /= double(n) * n;
  return sums;
}

// The published look-up: the place at which the irradiance vector under M^-1 meets the light's plane, and a level of detail from its
// distance in sides of the light. The horizon does not clip the light here.
//
// Source: Heitz, Dupuy, Hill, Neubelt, "Real-time polygonal-light shading with linearly transformed cosines", 2016, section 5.
float by_published_level(const Setup& s, double roughness, const FilteredTexture& texture) {
  // Standard deviation of the level's Gaussian over that distance. The paper gives none: of 0.3, 0.5, 0.7 and 1, this one has the least rms
  // over the whole table.
  constexpr double kWidth = 0.7;
  const Vec3d v = s.at.view;
  const double across = std::hypot(v.x, v.y);
  const LtcInverse m = roughness > 0 ? ggx_compact_table().look_up(roughness, v.z).inverse : LtcInverse{1, 0, 1, 0, 1};
  const auto under = [&](Vec3d p) {
    const Vec3d l = {(p.x * v.x + p.y * v.y) / across, (p.y * v.x - p.x * v.y) / across, p.z};
    return Vec3d{m.xx * l.x + m.xz * l.z, m.yy * l.y, m.zx * l.x + m.zz * l.z};
  };
  const LightTexture& t = *s.light.texture;
  const Vec3d corner = under(t.origin), du = under(t.du), dv = under(t.dv), normal = cross(du, dv);
  const double area2 = dot(normal, normal), height = dot(normal, corner);
  const Vec3d corners[] = {normalized(corner), normalized(corner + du), normalized(corner + du + dv), normalized(corner + dv)};
  Vec3d irradiance{};
  for (int i = 0; i < 4; ++i) {
    const Vec3d p = corners[i], q = corners[(i + 1) % 4], n = cross(p, q);
    if (length(n) > 0) irradiance += n * (std::atan2(length(n), dot(p, q)) / length(n));
  }
  const Vec3d direction = normalized(irradiance);
  const double along = dot(normal, direction);
  if (!(std::fabs(along) > 1e-9)) return texture.mean().x;
  const double distance = height / along;  // the vector may point away from the light
  const Vec3d foot = direction * distance - corner;
  const double a = dot(cross(foot, dv), normal) / area2, b = dot(cross(du, foot), normal) / area2;
  const double sides = std::fabs(distance) / std::pow(area2, 0.25);
  const Vec3d place = t.origin + t.du * a + t.dv * b - texture.origin();
  const double sigma = kWidth * sides;
  return texture.radiance(texture.under({dot(place, texture.axis_x()), dot(place, texture.axis_y()), sigma, 0, sigma})).x;
}

}  // namespace

const std::vector<NamedImage>& test_textures() {
  static const std::vector<NamedImage> textures = {
      made("gradient", [](double u, double v) { return 0.7 * u + 0.3 * v; }),
      made("checker", [](double u, double v) { return (static_cast<int>(8 * u) + static_cast<int>(8 * v)) % 2 == 0 ? 1.0 : 0.0; }),
      made("noise", waves),
      made("corner", [](double u, double v) { return u < 0.25 && v < 0.25 ? 1.0 : 0.0; }),
      made("half", [](double u, double) { return u < 0.5 ? 1.0 : 0.0; }),
  };
  return textures;
}

std::vector<TexturedErrorRow> measure_textured_error(const TexturedErrorOptions& options) {
  std::vector<std::vector<Image>> images;
  for (const NamedImage& t : test_textures()) images.push_back({t.image});
  const std::size_t count = images.size();
  struct Sums {
    double error = 0, of_mean = 0, of_level = 0, square = 0, value = 0, truth = 0;
  };
  std::vector<TexturedErrorRow> rows;
  for (const double roughness : kRoughness)
    for (int d = 0; d < options.distances; ++d) rows.push_back({roughness, kDistances[d], {}, {}, {}, {}});
  std::vector<std::vector<Sums>> sums(rows.size(), std::vector<Sums>(count));

  for (int d = 0; d < options.distances; ++d) {
    Random random(kSeed);
    for (int i = 0; i < options.setups; ++i) {
      Setup s = random_setup(random, kDistances[d]);
      s.light.texture->use.image = 0;
      s.light.texture->use.wrap_u = s.light.texture->use.wrap_v = Wrap::clamp_to_edge;
      std::vector<TexturedLight> lights;
      for (const auto& image : images) lights.emplace_back(s.light, prepare_polygon(flat_polygon(s.light)), image);
      for (std::size_t r = 0; r < rows.size(); ++r) {
        const double roughness = rows[r].roughness;
        if (rows[r].distance != kDistances[d]) continue;
        Material material;
        if (roughness > 0) material.brdf = Brdf::ggx;
        material.alpha_x = material.alpha_y = roughness * roughness;
        const std::vector<double> integral = integrate(s, material, images, options.samples);
        for (std::size_t t = 0; t < count; ++t) {
          const Vec3f seen = roughness > 0 ? lights[t].seen_by_ggx(s.at, material.alpha_x) : lights[t].seen_by_diffuse(s.at);
          const double value = integral[0] * static_cast<double>(seen.x), truth = integral[t + 1];
          const double by_mean = integral[0] * static_cast<double>(lights[t].texture().mean().x);
          Sums& sum = sums[r][t];
          sum.error += (value - truth) * (value - truth);
          sum.of_mean += (by_mean - truth) * (by_mean - truth);
          const double by_level = integral[0] * static_cast<double>(by_published_level(s, roughness, lights[t].texture()));
          sum.of_level += (by_level - truth) * (by_level - truth);
          sum.square += truth * truth;
          sum.value += value;
          sum.truth += truth;
        }
      }
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const Sums& sum : sums[r]) {
      rows[r].error.push_back(std::sqrt(sum.error / sum.square));
      rows[r].mean.push_back(std::sqrt(sum.of_mean / sum.square));
      rows[r].level.push_back(std::sqrt(sum.of_level / sum.square));
      rows[r].bias.push_back(sum.value / sum.truth - 1);
    }
  return rows;
}

std::string textured_error_text(const std::vector<TexturedErrorRow>& rows) {
  std::string text = "| roughness | distance |", rule = "|---|---|";
  for (const NamedImage& t : test_textures()) {
    text += " " + t.name + " | by the mean | published | energy |";
    rule += "---|---|---|---|";
  }
  text += "\n" + rule + "\n";
  const auto cell = [&](const char* pattern, double x) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, pattern, x);
    text += buffer;
  };
  for (const TexturedErrorRow& row : rows) {
    if (row.roughness > 0)
      cell("| %.2f |", row.roughness);
    else
      text += "| diffuse |";
    cell(" %.1f |", row.distance);
    for (std::size_t t = 0; t < row.error.size(); ++t) {
      cell(" %.1f %% |", 100 * row.error[t]);
      cell(" %.1f %% |", 100 * row.mean[t]);
      cell(" %.1f %% |", 100 * row.level[t]);
      cell(" %+.1f %% |", 100 * row.bias[t]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace steradian::fit
