// Frames on a Vulkan device: the host finds the surfaces, the lights that may reach them and what blocks those, as for the CPU; the device
// adds the light of those that nothing blocks.
#pragma once

#include <memory>

#include "render/vulkan/device.h"
#include "steradian/render.h"
#include "steradian/render_cache.h"

namespace steradian::vulkan {

// Whether the device would have nothing to do: estimates by samples, and many lights added up together.
bool runs_on_host_alone(const Scene& scene, const RenderOptions& options);

// Who finds what the pixels see. automatic: the device, unless it is software, slower at that than the host, or something keeps the host at
// it.
enum class SurfacesBy { automatic, host, device };

// Who finds whether the ways to the visible parts of lights are free, and what the rays of the bounce's shadow map meet. automatic: the
// device, unless it is software, slower at that than the host.
enum class RaysBy { automatic, host, device };

// Who finds what is seen of lights behind more edges than one thread goes through. automatic: the device, a subgroup a point, unless it is
// software: its threads are the host's, whose search is not quadratic.
enum class ManyEdgesBy { automatic, host, device };

// Buffers and pipelines are made once, for any number of frames of a scene.
class Frame {
 public:
  // Scene and options must stay. surfaces: `device` is a UsageError where something keeps the host at it. device: null for the one that the
  // options name. cache: keeps what is sorted, and what is on that device, for the next frame; null: nothing is kept. Throws
  // UsageError for what runs on the host alone, and for options that this back end does not have yet; Error where there is no such device.
  Frame(const Scene& scene, const RenderOptions& options, std::shared_ptr<const Device> device = nullptr,
        SurfacesBy surfaces = SurfacesBy::automatic, RaysBy rays = RaysBy::automatic, RenderCache* cache = nullptr,
        ManyEdgesBy many_edges = ManyEdgesBy::automatic);
  ~Frame();

  // Sets stats of this frame alone. Returns early, with what it has, when options.stop becomes true.
  Picture render(RenderStats* stats = nullptr);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace steradian::vulkan
