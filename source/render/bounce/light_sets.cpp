#include "render/bounce/light_sets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "render/bounce/receivers/blue_noise.h"
#include "steradian/kernels.h"

namespace steradian::indirect {
namespace {

constexpr float kPi = 3.14159265f;

constexpr float kEverywhere = 1e15f;  // a range that covers any scene; its square stays a float

// Schlick's Fresnel averaged over the lobe.
Vec3f mean_reflectance(const ShadowMap& map, const LobeArrays& lobes, std::size_t i) {
  const Vec3f f0 = map.f0[i], f90 = map.f90[i];
  return f0 * lobes.n_a[i] + (f90 - f0) * lobes.f_a[i];
}

Vec3f diffuse_brightness(const ShadowMap& map, std::size_t i) { return map.flux[i] * map.albedo[i] * (1 / kPi); }
Vec3f glossy_brightness(const ShadowMap& map, const LobeArrays& lobes, std::size_t i) {
  return map.flux[i] * mean_reflectance(map, lobes, i) * lobes.scale[i];
}

void push(VectorArray& a, Vec3f v) {
  a.x.push_back(v.x);
  a.y.push_back(v.y);
  a.z.push_back(v.z);
}

class SetMaker {
 public:
  SetMaker(const ShadowMap& map, const LobeArrays& lobes, const SetOptions& options)
      : map_(map), lobes_(lobes), options_(options), weight_(static_cast<float>(options.stride * options.stride)) {}

  LightSet make(int index, const std::vector<std::uint32_t>& texels) const {
    LightSet set;
    set.diffuse.reserve(texels.size());
    set.glossy.reserve(texels.size());
    // Each set turns the mask, so that neighbouring pixels skip different lights.
    const double shift = reference::Random(options_.seed, static_cast<std::uint64_t>(index)).uniform();
    for (const std::uint32_t i : texels) {
      const auto column = static_cast<std::size_t>(map_.column[i] / options_.stride) % kMaskSide;
      const auto row = static_cast<std::size_t>(map_.row[i] / options_.stride) % kMaskSide;
      const double turned = static_cast<double>(blue_noise()[row][column]) + shift;
      const float xi = std::max(static_cast<float>(turned - std::floor(turned)), 1e-6f);
      if (weighs(map_.albedo[i])) add_diffuse(set, i, xi);
      if (weighs(map_.f0[i]) || weighs(map_.f90[i])) add_glossy(set, i, 1 - xi > 0 ? std::max(1 - xi, 1e-6f) : xi);
    }
    pad(set);
    return set;
  }

 private:
  float soft(std::size_t i) const { return options_.soften ? map_.area[i] / kPi : 0; }
  float reach(Vec3f bright) const { return static_cast<float>(options_.threshold) / std::max(largest(bright), 1e-30f); }
  // range^2 = largest bright (with the lobe's scale) stretch / (threshold xi)
  float range(float reach, float xi, float stretch) const {
    const float bound = reach * xi;
    return std::min(bound > 0 ? std::sqrt(stretch / bound) : kEverywhere, kEverywhere);
  }
  // A set has one texel of stride x stride. The texel stands for its neighbours in the other sets, so the quads of a set cover as much as
  // all texels do.
  QuadLight quad(std::size_t i) const {
    const Vec3f x = map_.edge_x[i] * static_cast<float>(options_.stride), y = map_.edge_y[i] * static_cast<float>(options_.stride);
    return {x, y, 1 / std::max(map_.area[i] * weight_, 1e-20f), dot(x, x) + dot(y, y)};
  }

  void add_diffuse(LightSet& set, std::size_t i, float xi) const {
    const Vec3f p = map_.position[i], n = map_.normal[i];
    DiffuseLight light{p, -n, diffuse_brightness(map_, i) * weight_, 0, xi, soft(i)};
    light.reach = reach(light.bright);
    const float r = range(light.reach, xi, 1);
    set.diffuse.push_back(light);
    set.diffuse_quads.push_back(quad(i));
    push(set.eggs.position, p);
    push(set.eggs.normal, n);
    set.eggs.range.push_back(r);
    set.eggs.offset.push_back(dot(n, p));
  }

  void add_glossy(LightSet& set, std::size_t i, float xi) const {
    const Vec3f p = map_.position[i], n = map_.normal[i], f0 = map_.f0[i], f90 = map_.f90[i];
    const Vec3f bright = glossy_brightness(map_, lobes_, i) * weight_;
    if (!(largest(bright) > 0)) return;
    GlossyLight light{};
    light.position = p;
    light.row_x = lobes_.x[i];
    light.row_y = lobes_.y[i];
    light.row_z = lobes_.z[i];
    light.normal = -n;
    light.reach = reach(bright);
    light.xi = xi;
    light.soft = soft(i);
    light.incoming = map_.incoming[i];
    light.bright = bright;
    if (largest(f0) < kFresnelByPair) {
      const Vec3f plain = map_.flux[i] * (lobes_.n_a[i] * lobes_.scale[i] * weight_);
      light.by_pair = 1;
      light.bright = plain * f0;
      light.grazing = plain * (f90 - f0);
    }
    set.glossy.push_back(light);
    set.glossy_quads.push_back(quad(i));
    if (options_.mode != IndirectMode::ltc) add_ggx(set, i, light);

    const float r = range(light.reach, xi, lobes_.stretch[i]);
    const auto ball = Kernels<float>().indirect_ball();
    const float across = 1 / (ball.z.v * r), along = 1 / (ball.y.v * r);
    push(set.spheroids.x, light.row_x * across);
    push(set.spheroids.y, light.row_y * across);
    push(set.spheroids.z, light.row_z * along);
    push(set.spheroids.g, {dot(light.row_x, p) * across, dot(light.row_y, p) * across, dot(light.row_z, p) * along - ball.x.v / ball.y.v});
    push(set.spheroids.normal, n);
    set.spheroids.offset.push_back(dot(n, p));
  }

  void add_ggx(LightSet& set, std::size_t i, const GlossyLight& light) const {
    Kernels<float> k;
    const auto vector = [](Vec3f v) {
      return Kernels<float>::vec3{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    };
    const auto plain = [](const Kernels<float>::vec3& v) { return Vec3f{v.x.v, v.y.v, v.z.v}; };
    const auto frame = k.frame_from_normal_and_view(vector(map_.normal[i]), vector(map_.incoming[i]));
    GgxLight ggx{};
    ggx.position = light.position;
    ggx.frame_x = plain(frame.c0);
    ggx.frame_y = plain(frame.c1);
    ggx.normal = plain(frame.c2);
    ggx.view_x = dot(ggx.frame_x, light.incoming);
    ggx.view_z = dot(ggx.normal, light.incoming);
    ggx.alpha = map_.alpha[i];
    const Vec3f flux = map_.flux[i] * weight_;
    ggx.bright = flux * map_.f0[i];
    ggx.grazing = flux * (map_.f90[i] - map_.f0[i]);
    // The threshold over the brightness without the lobe: a GGX half already contains the lobe's size.
    ggx.reach = static_cast<float>(options_.threshold) /
                std::max(largest(flux * mean_reflectance(map_, lobes_, i)) / std::max(lobes_.n_a[i], 1e-6f), 1e-30f);
    ggx.xi = light.xi;
    ggx.soft = light.soft;
    set.ggx.push_back(ggx);
  }

  static void pad(LightSet& set) {
    while (set.eggs.range.size() % 16 != 0) {
      push(set.eggs.position, {});
      push(set.eggs.normal, {});
      set.eggs.range.push_back(0);
      set.eggs.offset.push_back(1);
    }
    while (set.spheroids.g.size() % 16 != 0) {
      for (VectorArray* a : {&set.spheroids.x, &set.spheroids.y, &set.spheroids.z}) push(*a, {});
      push(set.spheroids.g, {1e9f, 0, 0});
      push(set.spheroids.normal, {});
      set.spheroids.offset.push_back(1);
    }
  }

  const ShadowMap& map_;
  const LobeArrays& lobes_;
  const SetOptions& options_;
  const float weight_;
};

}  // namespace

std::vector<LightSet> make_sets(const ShadowMap& map, const LobeArrays& lobes, const SetOptions& options) {
  const int sets = options.stride * options.stride;
  std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(sets));
  for (std::size_t i = 0; i < map.count; ++i) {
    if (!weighs(map.flux[i])) continue;
    const int set = map.row[i] % options.stride * options.stride + map.column[i] % options.stride;
    members[static_cast<std::size_t>(set)].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<LightSet> result(static_cast<std::size_t>(sets));
  const SetMaker maker(map, lobes, options);
  tbb::parallel_for(0, sets, [&](int s) { result[static_cast<std::size_t>(s)] = maker.make(s, members[static_cast<std::size_t>(s)]); });
  return result;
}

TexelIrradiance irradiance_at(const ShadowMap& map, const LobeArrays& lobes, std::size_t i, Vec3f p) {
  const Vec3f v = map.position[i] - p;
  const float d2 = dot(v, v), cosine = -dot(map.normal[i], v);
  if (!(cosine > 0)) return {0, 0};
  const float inverse = 1 / std::sqrt(d2);
  const Vec3f w{dot(lobes.x[i], v), dot(lobes.y[i], v), dot(lobes.z[i], v)};
  const float w2 = dot(w, w), half = w.z > 0 ? w.z * d2 / (w2 * w2) : 0;
  return {largest(diffuse_brightness(map, i)) * cosine / d2 * inverse, largest(glossy_brightness(map, lobes, i)) * half * inverse};
}

namespace {

// Texel k of many, spread by the golden ratio so that the choice does not follow the rows of a map.
std::size_t spread(std::size_t k, std::size_t count) {
  const double x = 0.5 + static_cast<double>(k) * 0.61803398874989485;
  return std::min(static_cast<std::size_t>((x - std::floor(x)) * static_cast<double>(count)), count - 1);
}

}  // namespace

double travelled(const ShadowMap& map, const LobeArrays& lobes, const VectorArray& receivers) {
  constexpr std::size_t kLights = 256;
  double sum = 0, weighted = 0;
  for (std::size_t a = 0; a < receivers.size(); ++a)
    for (std::size_t b = 0; b < std::min(kLights, map.count); ++b) {
      const std::size_t i = spread(b, map.count);
      const TexelIrradiance e = irradiance_at(map, lobes, i, receivers[a]);
      const double weight = static_cast<double>(e.diffuse) + static_cast<double>(e.glossy);
      sum += weight;
      weighted += weight * static_cast<double>(length(map.position[i] - receivers[a]));
    }
  return sum > 0 ? weighted / sum : 0;
}

double threshold_for(const ShadowMap& map, const LobeArrays& lobes, const VectorArray& receivers, int stride, double kept) {
  constexpr std::size_t kLights = 512;
  const std::size_t places = receivers.size(), lights = std::min(kLights, map.count);
  if (map.count == 0 || places == 0 || !(kept > 0)) return 0;
  const double weight = stride * stride, share = static_cast<double>(map.count) / static_cast<double>(lights) / weight;
  std::vector<double> values;
  for (std::size_t a = 0; a < places; ++a)
    for (std::size_t b = 0; b < lights; ++b) {
      const TexelIrradiance e = irradiance_at(map, lobes, spread(b, map.count), receivers[a]);
      if (e.diffuse > 0) values.push_back(weight * static_cast<double>(e.diffuse));
      if (e.glossy > 0) values.push_back(weight * static_cast<double>(e.glossy));
    }
  if (values.empty()) return 0;
  const double most = *std::max_element(values.begin(), values.end());
  const auto kept_at = [&](double t) {
    double sum = 0;
    for (const double f : values) sum += std::min(1.0, f / t);
    return sum * share / static_cast<double>(places);
  };
  double low = most * 1e-12, high = most;
  if (kept_at(low) <= kept) return 0;  // too few lights to cull
  while (kept_at(high) > kept) high *= 4;
  for (int k = 0; k < 20; ++k) {  // to 2^-20 of the exponents' range
    const double middle = std::sqrt(low * high);
    (kept_at(middle) > kept ? low : high) = middle;
  }
  return high;
}

}  // namespace steradian::indirect
