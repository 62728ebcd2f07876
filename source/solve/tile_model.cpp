#include "solve/tile_model.h"

#include <algorithm>

#include "solve/tile_slopes.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::solving {
namespace {

constexpr double kAlbedoDifference = 0.1;
constexpr double kRoughnessDifference = 2e-3;  // error of 4e-4 at a roughness of 0.1, rounding of 1e-4
constexpr double kDifference = 2e-4;           // step of differences, in typical changes: rounding of floats over it is 5e-4 of the light

// Lamps of a computation, in the order in which they were added.
struct LampList {
  Lamps lamps;
  std::vector<std::pair<bool, std::size_t>> entries;  // punctual, and the number among its kind

  std::size_t add(const FittedLight& light) {
    entries.emplace_back(light.is_punctual, light.is_punctual ? lamps.punctual.size() : lamps.area.size());
    if (light.is_punctual)
      lamps.punctual.push_back(light.punctual);
    else
      lamps.area.push_back(light.area);
    return entries.size() - 1;
  }
  std::size_t size() const { return entries.size(); }
  // Number of an entry in a TileLight.
  std::size_t place(std::size_t entry) const { return entries[entry].second + (entries[entry].first ? lamps.area.size() : 0); }
};

std::vector<Vec3d> vertices_of(const PolygonLight& light) {
  std::vector<Vec3d> all = light.vertices;
  for (const auto& hole : light.holes) all.insert(all.end(), hole.begin(), hole.end());
  return all;
}

// A polygon whose vertices move with some unknowns.
struct MovingPolygon {
  std::size_t light;  // among the fitted ones
  PolygonLight stored;
  PreparedPolygon prepared;
  PackLight pack;
  std::vector<VertexMotion> motions;
  std::vector<std::size_t> unknowns;  // by motion

  MovingPolygon(std::size_t number, const AreaLight& area)
      : light(number), stored(flat_polygon(area)), prepared(prepare_polygon(stored)), pack(prepare_light(prepared)) {}

  // The motion from one place to another in a time.
  void add(std::size_t unknown, const AreaLight& from, const AreaLight& to, double time) {
    const std::vector<Vec3d> first = vertices_of(flat_polygon(from)), last = vertices_of(flat_polygon(to));
    VertexMotion motion;
    for (const std::size_t i : stored_vertices(stored, prepared)) motion.push_back(static_cast<Vec3f>((last[i] - first[i]) / time));
    motions.push_back(std::move(motion));
    unknowns.push_back(unknown);
  }
};

void add(TileVector& to, const TileVector& light, Vec3d factor) {
  const auto f = static_cast<Vec3f>(factor);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    to.x[i] += f.x * light.x[i];
    to.y[i] += f.y * light.y[i];
    to.z[i] += f.z * light.z[i];
  }
}

bool is_plain_polygon(const FittedLight& light) {
  return !light.is_punctual && std::holds_alternative<Polygon>(light.area.shape) && !light.area.texture && !light.area.emission;
}

}  // namespace

TileModel::TileModel(const FittedLights& lights, const ReceivingTiles& tiles, const std::vector<std::size_t>& all)
    : lights_(lights), tiles_(tiles) {
  if (!lights_.is_linear()) return;
  columns_.resize(tiles_.tiles().size());
  LampList list;
  for (const FittedLight& light : lights_.at(std::vector<double>(lights_.unknowns().size(), 1.0))) list.add(light);
  tiles_.light(list.lamps, all, [&](std::size_t tile, const TileLight& light) {
    for (std::size_t i = 0; i < list.size(); ++i) columns_[tile].push_back(light[list.place(i)]);
  });
}

// The light is affine in the albedo, so that a wide difference is exact. Within the range of a parameter, since there is no other material.
std::vector<TileLight> TileModel::slopes_by_materials(const std::vector<double>& x, const std::vector<FittedLight>& lights,
                                                      const std::vector<std::size_t>& numbers) const {
  std::vector<TileLight> by(lights_.materials().empty() ? 0 : x.size());
  for (std::size_t u = 0; u < by.size(); ++u) {
    const UnknownKind kind = lights_.unknowns()[u].kind;
    if (!is_of_material(kind)) continue;
    by[u].resize(tiles_.tiles().size());
    const double step = kind == UnknownKind::roughness ? kRoughnessDifference : kAlbedoDifference;
    const double low = std::max(x[u] - step, 0.0), high = std::min(x[u] + step, 1.0);
    for (const auto& [place, factor] : {std::pair{low, -1 / (high - low)}, std::pair{high, 1 / (high - low)}}) {
      std::vector<double> there = x;
      there[u] = place;
      LampList list;
      for (const FittedLight& light : lights) list.add(light);
      list.lamps.materials = lights_.materials().at(there);
      tiles_.light(list.lamps, numbers, [&, f = factor](std::size_t tile, const TileLight& light) {
        add(by[u][tile], tiles_.tiles()[tile].surfaces->radiance, Vec3d{f, f, f});
        for (std::size_t i = 0; i < lights.size(); ++i) add(by[u][tile], light[list.place(i)], lights[i].scale * f);
      });
    }
  }
  return by;
}

void TileModel::each(const std::vector<double>& x, Wants wants, const std::vector<std::size_t>& numbers,
                     const std::function<void(std::size_t, const TileVector&, const TileLight&)>& use) const {
  const std::vector<FittedLight> lights = lights_.at(x);
  const std::size_t unknowns = wants == Wants::derivatives ? lights_.unknowns().size() : 0;
  // slope = by[k].factor * light[by[k].lamp], summed over k
  struct Term {
    std::size_t lamp;
    Vec3d factor;
  };
  std::vector<Term> value;
  std::vector<std::vector<Term>> slopes(unknowns);
  LampList list;
  std::vector<MovingPolygon> moving;
  const bool by_boundary = tiles_.has_slopes();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    value.push_back({list.add(lights[i]), lights[i].scale});
    if (by_boundary && unknowns > 0 && !lights_.is_linear() && is_plain_polygon(lights[i])) moving.emplace_back(i, lights[i].area);
  }
  for (std::size_t u = 0; u < unknowns; ++u) {
    const Unknown& unknown = lights_.unknowns()[u];
    if (is_of_material(unknown.kind)) continue;
    const double step = kDifference * unknown.typical;
    std::vector<double> there = x;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (!lights_.drives(u, i)) continue;
      if (is_scale(unknown.kind)) {
        const Vec3d channels = unknown.kind == UnknownKind::power   ? Vec3d{1, 1, 1}
                               : unknown.kind == UnknownKind::red   ? Vec3d{1, 0, 0}
                               : unknown.kind == UnknownKind::green ? Vec3d{0, 1, 0}
                                                                    : Vec3d{0, 0, 1};
        slopes[u].push_back({value[i].lamp, lights_.is_linear() ? channels : channels * lights[i].scale});
        continue;
      }
      if (const auto polygon = std::find_if(moving.begin(), moving.end(), [&](const MovingPolygon& m) { return m.light == i; });
          polygon != moving.end()) {
        there[u] = x[u] - step;
        const FittedLight from = lights_.at(there)[i];
        there[u] = x[u] + step;
        const FittedLight to = lights_.at(there)[i];
        polygon->add(u, from.area, to.area, 2 * step);
        slopes[u].push_back({value[i].lamp, (to.scale - from.scale) / (2 * step)});
        continue;
      }
      for (const double side : {1.0, -1.0}) {
        there[u] = x[u] + side * step;
        const FittedLight moved = lights_.at(there)[i];
        slopes[u].push_back({list.add(moved), moved.scale * (side / (2 * step))});
      }
    }
  }
  const std::vector<TileLight> by_materials = unknowns > 0 ? slopes_by_materials(x, lights, numbers) : std::vector<TileLight>{};
  list.lamps.materials = lights_.materials().at(x);
  const auto sum = [&](std::size_t tile, const TileLight& light, const auto& place) {
    TileVector all = tiles_.tiles()[tile].surfaces->radiance;
    for (const Term& term : value) add(all, light[place(term.lamp)], term.factor);
    TileLight by(unknowns);
    for (std::size_t u = 0; u < by_materials.size(); ++u)
      if (is_of_material(lights_.unknowns()[u].kind)) by[u] = by_materials[u][tile];
    for (std::size_t u = 0; u < unknowns; ++u)
      for (const Term& term : slopes[u]) add(by[u], light[place(term.lamp)], term.factor);
    for (const MovingPolygon& polygon : moving) {
      TileLight motions(polygon.motions.size());
      tile_slopes_for(active_simd()).find(*tiles_.tiles()[tile].surfaces, polygon.pack, polygon.motions, motions.data());
      for (std::size_t k = 0; k < motions.size(); ++k)
        add(by[polygon.unknowns[k]], motions[k], lights[polygon.light].area.radiance * lights[polygon.light].scale);
    }
    use(tile, all, by);
  };
  if (lights_.is_linear())
    tiles_.each(numbers.size(), [&](std::size_t i) { sum(numbers[i], columns_[numbers[i]], [](std::size_t lamp) { return lamp; }); });
  else
    tiles_.light(list.lamps, numbers,
                 [&](std::size_t tile, const TileLight& light) { sum(tile, light, [&](std::size_t lamp) { return list.place(lamp); }); });
}

}  // namespace steradian::solving
