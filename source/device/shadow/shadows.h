// Shadows on a device: a subgroup per point finds the visible parts of lights behind edges (shaders/shadow/shadow_parts.comp). One ray per
// point tests that the part is unoccluded (shaders/shadow/shadow_rays.comp). Lighting follows in the same submission. Points that exceed a
// capacity of the subgroup or are uncertain are left to the host, which adds their light.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "device/shadow/scene_rays.h"
#include "device/shadow/tile_shadows.h"
#include "device/vulkan/buffer.h"
#include "device/vulkan/compute_program.h"
#include "render/shadow/viewpoints.h"

namespace steradian::vulkan {

class DeviceShadows {
 public:
  // Objects on the device, for any number of pictures in turn. The device must outlive them.
  struct Kept {
    explicit Kept(const Device& device);
    const Device& device;
    ComputeProgram program;
    KeptBuffer groups, answers, parts, states, mesh, frames, gathered;
    std::shared_ptr<const ShadowEdges> edges;  // of `mesh`
  };

  // Returns true if a device supports a subgroup per point.
  static bool has(const DeviceInfo& device);

  // Returns true if buffers of the device have capacity for the edges in the coordinates of all lights.
  static bool fits(const DeviceInfo& device, const ShadowEdges& edges, const std::vector<PackLight>& lights);

  // All arguments must outlive this object.
  DeviceShadows(Kept& kept, const SceneRays& rays, std::shared_ptr<const ShadowEdges> edges);

  // Uploads the points of the first tiles, as many as buffers have capacity for, and returns their number: at least one. Throws Error if
  // one is too many.
  std::size_t upload(std::span<TileShadows> tiles);
  // Records the search for these points. If their parts exceed the buffer, it writes 0 to all numbers of `gates`.
  ComputeProgram& record(const Buffer& gates);

  // Results: tile after tile and light after light, kTilePixels states; and the parts' records.
  const Buffer& states() const { return kept_.states.get(); }
  const Buffer& parts() const { return kept_.parts.get(); }

  // To be called when the search has run. Returns false if the same tiles must be uploaded again: their parts exceeded the buffer.
  bool finish();
  // Calls add for each light of a tile of this search and its points that the device has left. Threads may ask for different tiles.
  void each_left(std::size_t tile, const std::function<void(const PackLight&, const TilePoints&)>& add) const;

  // Milliseconds on the device so far.
  double time() const { return time_; }
  double rays_time() const { return rays_time_; }
  // Pairs of a surface and a light that the device has answered, and how many of these see a part of the light.
  std::uint64_t points() const { return points_; }
  std::uint64_t found() const { return found_; }
  // RenderStats::shadow_pairs.
  const std::vector<std::uint64_t>& pairs() const { return pairs_; }
  const std::vector<std::vector<std::uint64_t>>& work() const { return work_; }
  std::uint64_t looks() const { return looks_; }
  const std::array<std::uint64_t, 2>& gathered() const { return gathered_; }  // nodes and leaves of edges that groups met

 private:
  // First places of a tile's data among those of all.
  struct Begin {
    std::size_t light = 0, point = 0, row = 0, group = 0;
  };
  void upload_frames();
  void upload_groups();
  void upload_states();
  void upload_points();

  Kept& kept_;
  const SceneRays& rays_;
  std::span<TileShadows> tiles_;               // of the last upload()
  std::vector<Begin> begins_;                  // of each, and the end
  std::size_t wanted_ = 0;                     // vectors that the parts need, if a search has shown it
  std::size_t wanted_edges_ = 0;               // numbers that the edges of groups need, if a search has shown it
  std::map<const void*, std::size_t> frames_;  // numbers of those written
  std::uint32_t left_ = 0;                     // points of the last search
  std::size_t most_tiles_ = SIZE_MAX;
  double time_ = 0, rays_time_ = 0;
  std::uint64_t points_ = 0, found_ = 0, looks_ = 0;
  std::array<std::uint64_t, 2> gathered_{};
  std::vector<std::uint64_t> pairs_;
  std::vector<std::vector<std::uint64_t>> work_;
};

}  // namespace steradian::vulkan
