#include "scene/emitters/light_materials.h"

#include <algorithm>

namespace steradian::scene {

int material_of_light(const Scene& scene, std::size_t light) {
  for (const Mesh& mesh : scene.meshes)
    if (!mesh.is_light_shape &&
        std::find(mesh.triangle_lights.begin(), mesh.triangle_lights.end(), static_cast<std::int32_t>(light)) != mesh.triangle_lights.end())
      return mesh.material;
  return -1;
}

std::vector<std::size_t> lights_of_material(const Scene& scene, int material) {
  std::vector<std::size_t> lights;
  for (std::size_t i = 0; i < scene.area_lights.size(); ++i)
    if (material_of_light(scene, i) == material) lights.push_back(i);
  return lights;
}

}  // namespace steradian::scene
