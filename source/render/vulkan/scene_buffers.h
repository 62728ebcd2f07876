// A scene as the shaders that find surfaces read it (shaders/surface_layout.glsl): geometry, materials, pyramids of textures.
#pragma once

#include <string>
#include <vector>

#include "core/mip_maps.h"
#include "render/vulkan/buffer.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// Why the shaders do not find this scene's surfaces; empty: they do, but those of some materials.
std::string what_keeps_on_host(const Scene& scene, const DeviceInfo& device);
// Those materials, a sentence each: tiles that show one are the host's.
std::vector<std::string> materials_for_host(const Scene& scene);

struct SceneBuffers {
  std::size_t triangle_count = 0;
  Buffer vertices, triangles, materials, texels;
};

// Of a scene that nothing keeps on the host; computes the pyramids.
SceneBuffers make_scene_buffers(const Device& device, const Scene& scene, const MipMaps& maps);

}  // namespace steradian::vulkan
