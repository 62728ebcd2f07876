// EXT_lights_area, KHR_lights_punctual and EXT_lights_ies.
#pragma once

#include "scene/gltf/gltf_nodes.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Appends the area lights of the visible nodes, and for each light the mesh and the material that make it visible to the camera. Returns
// the nodes of these meshes, in order.
std::vector<int> add_area_lights(const GltfDocument& document, const GltfNodes& nodes, Scene& scene);

// The punctual lights of KHR_lights_punctual and EXT_lights_ies.
std::vector<PunctualLight> read_punctual_lights(const GltfDocument& document, const GltfNodes& nodes);

// The triangles of a light's shape: a fan for flat ones, 64 x 32 quadrilaterals for an ellipsoid, 64 x 33 for a capsule.
Mesh mesh_of_light(const AreaLight& light);

}  // namespace steradian::scene
