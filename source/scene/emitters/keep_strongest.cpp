#include "scene/emitters/keep_strongest.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace steradian::scene {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// A light's centre and the direction that it faces; zero: all directions.
struct LightPlace {
  Vec3d center, facing;
};

struct PlaceOf {
  bool two_sided;

  LightPlace operator()(const Polygon& p) const {
    const PreparedPolygon prepared = prepare_polygon({p.vertices, p.holes});
    return {prepared.centroid, two_sided ? Vec3d{} : prepared.normal};
  }
  LightPlace operator()(const Ellipse& e) const { return {e.center, two_sided ? Vec3d{} : cross(e.x, e.y)}; }
  LightPlace operator()(const Ellipsoid& e) const { return {e.center, {}}; }
  LightPlace operator()(const Capsule& c) const { return {(c.end_a + c.end_b) * 0.5, {}}; }
  LightPlace operator()(const Line& l) const { return {(l.end_a + l.end_b) * 0.5, {}}; }
};

// The source of each light: the mesh that it comes from. Each light without a mesh is its own source.
std::vector<std::size_t> sources(const Scene& scene) {
  std::vector<std::size_t> source(scene.area_lights.size());
  std::iota(source.begin(), source.end(), scene.meshes.size());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    for (const std::int32_t light : scene.meshes[m].triangle_lights)
      if (light >= 0) source[static_cast<std::size_t>(light)] = m;
  return source;
}

constexpr std::size_t kFewest = 256, kMost = 65536;  // number kept by default

// The number of sources that emit.
std::size_t count_of(const std::vector<std::size_t>& source, const std::vector<std::size_t>& with_power) {
  std::set<std::size_t> shining;
  for (const std::size_t i : with_power) shining.insert(source[i]);
  return shining.size();
}

// Chooses `count` lights of one source to keep. It divides the source's power into `count` equal parts, in the file's order, which mostly
// is an order in space. The lights that hold the middles of the parts stay, then the strongest of the others.
void keep_of_source(const std::vector<AreaLight>& lights, const std::vector<std::size_t>& of_source, std::size_t count,
                    std::vector<bool>& keep) {
  double power = 0, before = 0;
  for (const std::size_t i : of_source) power += lights[i].power;
  std::size_t part = 0, kept = 0;
  for (const std::size_t i : of_source) {
    before += lights[i].power;
    const bool holds = part < count && (static_cast<double>(part) + 0.5) * power <= before * static_cast<double>(count);
    if (holds) keep[i] = true, ++kept;
    while (part < count && (static_cast<double>(part) + 0.5) * power <= before * static_cast<double>(count)) ++part;
  }
  std::vector<std::size_t> others;
  for (const std::size_t i : of_source)
    if (!keep[i]) others.push_back(i);
  std::stable_sort(others.begin(), others.end(), [&](std::size_t a, std::size_t b) { return lights[a].power > lights[b].power; });
  for (std::size_t k = 0; kept < count && k < others.size(); ++k, ++kept) keep[others[k]] = true;
}

// Chooses the lights to keep. First every source gets one place, the strongest first, as far as the places go. The other places go to the
// sources by power: the k-th place of a source counts its power over k (d'Hondt's method).
std::vector<bool> choose(const std::vector<AreaLight>& lights, const std::vector<std::size_t>& source, std::size_t source_count,
                         const std::vector<std::size_t>& with_power, std::size_t most) {
  std::vector<std::vector<std::size_t>> of_source(source_count);
  std::vector<double> power(source_count, 0.0);
  for (const std::size_t i : with_power) {
    of_source[source[i]].push_back(i);
    power[source[i]] += lights[i].power;
  }
  struct Claim {
    bool first;
    double worth;
    std::size_t source;
  };
  std::vector<Claim> claims;
  for (std::size_t s = 0; s < source_count; ++s)
    for (std::size_t k = 1; k <= of_source[s].size(); ++k) claims.push_back({k == 1, power[s] / static_cast<double>(k), s});
  std::stable_sort(claims.begin(), claims.end(),
                   [](const Claim& a, const Claim& b) { return a.first != b.first ? a.first : a.worth > b.worth; });
  std::vector<std::size_t> places(source_count, 0);
  for (std::size_t i = 0; i < std::min(most, claims.size()); ++i) ++places[claims[i].source];
  std::vector<bool> keep(lights.size(), false);
  for (std::size_t s = 0; s < source_count; ++s)
    if (places[s] > 0) keep_of_source(lights, of_source[s], places[s], keep);
  return keep;
}

struct LightCandidate {
  std::size_t light;
  LightPlace place;
};

// The candidate that takes over a light's power.
std::size_t nearest(const LightPlace& at, const std::vector<LightCandidate>& candidates) {
  std::size_t best = kNone;
  bool best_faces = false;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const LightCandidate& c : candidates) {
    const bool faces = dot(at.facing, c.place.facing) >= 0;
    const Vec3d to = c.place.center - at.center;
    const double distance = dot(to, to);
    if (best != kNone && (faces == best_faces ? distance >= best_distance : best_faces)) continue;
    best = c.light;
    best_faces = faces;
    best_distance = distance;
  }
  return best;
}

void grow(AreaLight& light, double factor) {
  light.radiance = light.radiance * factor;
  light.power *= factor;
  if (light.texture) light.texture->factor = light.texture->factor * factor;
  if (light.emission) light.emission->intensity = light.emission->intensity * factor;
}

// Adds the power of the removed lights to the lights that stay.
void merge_into_kept(Scene& scene, const std::vector<std::size_t>& source, const std::vector<std::size_t>& with_power,
                     const std::vector<bool>& keep, Budget& budget, const std::string& path, KeptLights& result) {
  std::vector<AreaLight>& lights = scene.area_lights;
  const auto place_of = [&](std::size_t i) { return std::visit(PlaceOf{lights[i].two_sided}, lights[i].shape); };
  std::vector<std::vector<LightCandidate>> kept(scene.meshes.size() + lights.size());
  double all = 0;
  for (const std::size_t i : with_power) {
    all += lights[i].power;
    if (keep[i]) kept[source[i]].push_back({i, place_of(i)});
  }
  std::uint64_t pairs = 0;
  for (const std::size_t i : with_power)
    if (!keep[i]) pairs += kept[source[i]].size();
  budget.take_work(path, "merging its weakest lights into those that max-lights keeps", pairs);
  std::vector<double> gained(lights.size(), 0.0);
  result.of.resize(kept.size());
  for (const std::size_t i : with_power) {
    if (keep[i]) continue;
    const std::vector<LightCandidate>& candidates = kept[source[i]];
    if (candidates.empty()) {
      ++result.dropped;
      result.dropped_share += lights[i].power / all;
    } else {
      gained[nearest(place_of(i), candidates)] += lights[i].power;
      for (MergedLights* merged : {&result.merged, &result.of[source[i]]}) {
        ++merged->count;
        merged->share += lights[i].power / all;
      }
    }
  }
  for (const std::size_t i : with_power)
    if (keep[i]) grow(lights[i], 1 + gained[i] / lights[i].power);
}

// Removes all lights but those that `keep` names.
void remove_others(Scene& scene, const std::vector<bool>& keep) {
  std::vector<std::int32_t> renumbered(keep.size(), -1);
  std::vector<AreaLight> lights;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    renumbered[i] = static_cast<std::int32_t>(lights.size());
    lights.push_back(std::move(scene.area_lights[i]));
  }
  scene.area_lights = std::move(lights);
  for (Mesh& mesh : scene.meshes)
    for (std::int32_t& light : mesh.triangle_lights)
      if (light >= 0) light = renumbered[static_cast<std::size_t>(light)];
}

}  // namespace

KeptLights keep_strongest(Scene& scene, std::optional<std::size_t> wanted, Budget& budget, const std::string& path) {
  KeptLights result;
  std::vector<std::size_t> with_power;
  std::vector<bool> keep(scene.area_lights.size(), false);
  for (std::size_t i = 0; i < scene.area_lights.size(); ++i)
    if (scene.area_lights[i].power > 0) with_power.push_back(i), keep[i] = true;
  result.without_power = scene.area_lights.size() - with_power.size();
  const std::vector<std::size_t> source = sources(scene);
  result.most = wanted.value_or(std::clamp(count_of(source, with_power), kFewest, kMost));
  if (result.most < with_power.size()) {
    keep = choose(scene.area_lights, source, scene.meshes.size() + scene.area_lights.size(), with_power, result.most);
    merge_into_kept(scene, source, with_power, keep, budget, path, result);
  }
  remove_others(scene, keep);
  return result;
}

}  // namespace steradian::scene
