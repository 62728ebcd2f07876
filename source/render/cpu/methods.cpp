#include "render/cpu/methods.h"

#include <algorithm>
#include <optional>

#include "steradian/error.h"

namespace steradian {
namespace {

struct SpecularLobe {
  std::string material;
  Brdf brdf;
};

bool weighs(Vec3f v) { return v.x > 0 || v.y > 0 || v.z > 0; }

// The first specular lobe that a mesh of the scene shows, by the materials' factors.
std::optional<SpecularLobe> specular_lobe_in(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (m.unlit || mesh.is_light_shape || mesh.indices.empty()) continue;
    for (const Material& lobe : m.specular_override)
      if (lobe.brdf != Brdf::lambert) return SpecularLobe{m.name, lobe.brdf};
    if (m.clearcoat > 0) return SpecularLobe{m.name, Brdf::ggx};
    const bool metal = m.metallic > 0 && weighs({m.base_color.x, m.base_color.y, m.base_color.z});
    if (m.specular_override.empty() && (metal || m.specular > 0)) return SpecularLobe{m.name, Brdf::ggx};
  }
  return std::nullopt;
}

}  // namespace

Method choose_method(const Scene& scene, const RenderOptions& options) {
  const auto specular = specular_lobe_in(scene);
  Method method;
  method.name = options.method;
  if (method.name == "auto") method.name = specular || options.shadows ? "sampled" : "exact";
  if (method.name == "exact") {
    if (specular)
      throw UsageError("--method exact",
                       std::string("no closed form without approximation for the ") + name_of(specular->brdf) +
                           " lobe of material '" + specular->material + "'",
                       "use auto, sampled or reference");
    if (options.shadows)
      throw UsageError("--shadows on", "the closed form casts no shadows", "use --method sampled or reference");
    return method;
  }
  method.kind = method.name == "reference" ? MethodKind::reference : MethodKind::sampled;
  method.exact_diffuse = method.kind == MethodKind::sampled && !options.shadows;
  method.estimated_lobes = method.exact_diffuse ? LobeChoice::specular : LobeChoice::all;
  return method;
}

}  // namespace steradian
