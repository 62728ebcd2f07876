// ReceivingTiles: the surfaces whose light a fit compares, and the light that lamps send to them on packs.
//
// Surfaces are those that a camera sees, or white diffuse ones at given points, whose radiance times pi is the irradiance. They are stored,
// since mostly the lamps alone change from one step to the next.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/frame/tile_lighting.h"
#include "render/radiosity/gather.h"
#include "render/tile/tile.h"
#include "steradian/render.h"
#include "steradian/solve.h"

namespace steradian::solving {

inline constexpr std::uint32_t kNoValue = UINT32_MAX;

struct ReceivingTile {
  std::unique_ptr<SurfaceTile> surfaces;           // its radiance: light that no fitted lamp sends
  std::array<std::uint32_t, kTilePixels> value{};  // by slot: number of the pixel or point; kNoValue: none
};

// The lamps of one computation: area lights and punctual lights, in this order.
struct Lamps {
  std::vector<AreaLight> area;
  std::vector<PunctualLight> punctual;
  std::vector<SurfaceMaterial> materials;  // instead of the scene's; none: they stay
  std::size_t count() const { return area.size() + punctual.size(); }
};

// The radiance that each lamp sends from a tile's surfaces to the camera, by lamp.
using TileLight = std::vector<TileVector>;

class ReceivingTiles {
 public:
  // fitted: by number of the scene's lights; the meshes that show these lights are left out. The scene must outlive this object.
  ReceivingTiles(const Scene& scene, const RenderOptions& options, const std::vector<bool>& fitted);
  ~ReceivingTiles();
  ReceivingTiles(const ReceivingTiles&) = delete;

  // Adds the surfaces that a camera sees, as if the fitted lights were not visible. Pixels without a surface, and those that show
  // another light or what light passes, have no value.
  // least_alpha: widths of specular lobes below it are raised to it.
  void add_camera(const std::string& camera, int width, int height, LightPart part = LightPart::all, float least_alpha = 0);
  // By pixel: 1 where the camera sees a fitted light in its place in the scene.
  std::vector<char> pixels_of_fitted(const std::string& camera, int width, int height) const;
  // Adds white surfaces at points, with unit normals.
  void add_points(const std::vector<Vec3d>& points, const std::vector<Vec3d>& normals);
  // Computes the light of all lights that are not fitted. Call it once, after all surfaces are added.
  void add_fixed_light();
  // Adds tiles that repeat every factor-th block of 4 x 4 pixels of the tiles `first` to `last` - 1, in each direction (factor: 2 or 4).
  // Their materials stay as they are now. Call it after add_fixed_light.
  void add_coarse(std::size_t first, std::size_t last, int factor);
  static bool is_coarse_slot(std::size_t slot, int factor);

  const std::vector<ReceivingTile>& tiles() const { return tiles_; }
  // True if TileSlopes knows the light of polygons on all tiles: no shadows, and no lobes but diffuse ones and GGX in closed form.
  bool has_slopes() const;

  // Calls use(number of the tile, light) for some tiles, on all threads, in any order. Direct light, with the options' shadows; with
  // bounces, also the light of each lamp that other surfaces send.
  void light(const Lamps& lamps, const std::vector<std::size_t>& numbers,
             const std::function<void(std::size_t, const TileLight&)>& use) const;
  // Runs work(i) for i from 0 to count on the threads of this object.
  void each(std::size_t count, const std::function<void(std::size_t)>& work) const;

 private:
  struct Room;
  struct View;
  class LampTable;
  // Fills the tiles of a camera with its surfaces and the environment's light.
  void fill(View& view) const;
  // Adds the light of the lights that are not fitted to some tiles.
  void add_fixed_light(std::size_t first, std::size_t last) const;
  // Takes other materials, and finds the surfaces of all cameras again.
  void take_materials(const std::vector<SurfaceMaterial>& materials) const;
  // Adds the light that other surfaces send of the lamps `first` to `last`, to light(number of the tile).
  void add_bounces(LampTable& table, std::size_t first, std::size_t last, const std::function<TileVector&(std::size_t)>& light) const;

  std::unique_ptr<Room> room_;
  std::vector<std::unique_ptr<View>> views_;
  std::vector<ReceivingTile> tiles_;
};

}  // namespace steradian::solving
