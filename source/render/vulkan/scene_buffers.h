// A scene as the shaders that find surfaces read it (shaders/surface_layout.glsl): geometry, materials, pyramids of textures.
#pragma once

#include <string>

#include "core/mip_maps.h"
#include "render/vulkan/buffer.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// Why the shaders do not find this scene's surfaces; empty: they do.
std::string what_keeps_on_host(const Scene& scene, const DeviceInfo& device);

struct SceneBuffers {
  std::size_t triangle_count = 0;
  Buffer vertices, triangles, materials, texels;
};

// Of a scene that nothing keeps on the host; computes the pyramids.
SceneBuffers make_scene_buffers(const Device& device, const Scene& scene, const MipMaps& maps);

}  // namespace steradian::vulkan
