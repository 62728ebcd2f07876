// Direct light on a device: the host writes the surfaces of batches of tiles, and compute shaders light them (shaders/direct.glsl).
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "device/direct/light_records.h"
#include "device/direct/own_lobes.h"
#include "device/vulkan/buffer.h"
#include "device/vulkan/compute_program.h"
#include "render/frame/methods.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian::vulkan {

class DirectPass {
 public:
  // Objects on the device, for any number of pictures in turn. The device must outlive them. Throws Error if the device lacks something.
  struct Kept {
    explicit Kept(const Device& device);
    const Device& device;
    const std::size_t tiles;  // per batch
    ComputeProgram program;
    KeptBuffer surfaces, radiance, tables, details, lights, vertices, lists, means, gates;
  };

  // `kept`, the scene and the lights must outlive this object.
  DirectPass(Kept& kept, const Scene& scene, const DirectMethod& method, const std::vector<PackLight>& lights);

  // Returns true if the shaders have this light, without shadows.
  bool has(const PackLight& light) const;
  // The lobes of extras.steradian.
  const OwnLobes& own_lobes() const { return own_lobes_; }

  std::size_t tiles_of_batch() const { return kept_.tiles; }

  // Writes the data of a tile, which is number `place` of the batch. Threads may write different places at the same time.
  void put(std::size_t place, const SurfaceTile& tile);
  // The same if the device already has the surfaces: their radiance alone.
  void put_radiance(std::size_t place, const SurfaceTile& tile);

  // Buffers that others than put may write: planes of shaders/layout.glsl.
  Buffer& surfaces() { return kept_.surfaces.get(); }
  Buffer& radiance() { return kept_.radiance.get(); }

  // Input of the passes: for each of a tile's squares of 16 x 16 pixels, its surfaces and the lights that reach them.
  struct Square {
    SurfaceBounds bounds;
    bool any_diffuse = false, any_specular = false, any_sheen = false, any_coat = false;
    struct Listed {
      const PackLight* light;
      bool cut_for_tile;        // see ReachingLights::cut
      bool whole, whole_about;  // fully visible; also the corners that represent a round light about a lobe
    };
    std::vector<Listed> lights;
    std::vector<std::size_t> own;  // materials with lobes of extras.steradian: OwnLobes::number_of
  };
  struct Tile {
    ReachingLights lights;
    std::array<Square, 4> squares;
    // Lights in addition to those of the squares: occluded from some points, or in part.
    struct Shadowed {
      const PackLight* light;
      std::uint32_t states;  // first state of the tile
      bool searched;         // some points may see a part
      bool shares;           // parts may count as fractions of a polygon's light: shaders/shadow/shadow_layout.glsl
    };
    std::vector<Shadowed> shadowed;
  };
  // Finds the squares' surfaces in the tile's.
  void find_squares(const SurfaceTile& surfaces, Tile& tile) const;
  static std::size_t square_of_group(std::size_t group) { return group / 8 * 2 + group % 2; }
  // Lists the squares' lights from the tile's.
  void list_lights(Tile& tile) const;
  // Visibility of shadowed lights (Shadows). record: if not null, it records the search for it in a program that runs before. The search
  // may write 0 to all numbers of `gates`. Then no light is added.
  struct Visibility {
    std::function<ComputeProgram&(const Buffer& gates)> record;
    const Buffer* states = nullptr;
    const Buffer* parts = nullptr;
  };
  // Adds the light of the lists to the radiance of some tiles.
  void run(const std::vector<Tile>& tiles, std::size_t first, std::size_t end, const Visibility& visibility);
  void run(const std::vector<Tile>& tiles) { run(tiles, 0, tiles.size(), {}); }
  void take_radiance(std::size_t place, TileVector& radiance) const;

  // Milliseconds on the device so far, by pass; empty if it does not report them.
  const std::map<std::string, double>& times() const { return times_; }

 private:
  struct Pass;
  struct Sight;
  struct Work;
  Vec4Floats* planes_of(std::size_t place);
  static bool is_cut(const Tile& tile, const PackLight& light);
  bool brings_diffuse(const Square& square, const PackLight& light) const;
  void list(Work& work, std::uint32_t place, const Tile& tile, const Square& square, const Pass& pass);
  void list(Work& work, std::uint32_t place, const Square& square, const Pass& pass, const Square::Listed& listed,
            const Tile::Shadowed* shadowed);
  double least_distance2(const LightRecord& light, const Pass& pass) const;
  void list_shares(Work& work, std::uint32_t place, const Tile& tile, const Square& square);
  bool may_be_small(const LightRecord& light, const SurfaceBounds& where, const Pass& pass, bool shadowed) const;
  static bool may_be_near_rim(const LightRecord& light, const SurfaceBounds& where, const Pass& pass);
  void list_means(Work& work, std::uint32_t place, const Pass& pass, std::uint32_t light) const;
  std::vector<std::int32_t> choices(const LightRecord& light, const Pass& pass, Sight sight, int shadowed) const;
  std::uint32_t number_of(const PackLight& light, bool cut);

  Kept& kept_;
  const DirectMethod method_;
  const methods::Procedure specular_;
  const LightDetails light_details_;
  const OwnLobes own_lobes_;
  LightRecords records_;
  std::size_t scene_lights_ = 0, scene_vertices_ = 0;
  int matrix_size_ = 2, magnitude_size_ = 2, compact_first_ = 0, compact_size_ = 2;  // compact: for means of textured lights
  bool compact_table_ = false, fresnel_table_ = false;
  std::map<std::string, double> times_;
};

}  // namespace steradian::vulkan
