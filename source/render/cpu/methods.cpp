#include "render/cpu/methods.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "steradian/error.h"

namespace steradian {
namespace {

struct SpecularLobe {
  std::string material;
  Brdf brdf;
  bool anisotropic = false;
  double exponent = 0;
};

bool weighs(Vec3f v) { return v.x > 0 || v.y > 0 || v.z > 0; }

// The specular lobes that meshes of the scene show, by the materials' factors.
std::vector<SpecularLobe> specular_lobes_in(const Scene& scene) {
  std::vector<SpecularLobe> lobes;
  for (const Mesh& mesh : scene.meshes) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (m.unlit || mesh.is_light_shape || mesh.indices.empty()) continue;
    for (const Material& lobe : m.specular_override)
      if (lobe.brdf != Brdf::lambert)
        lobes.push_back({m.name, lobe.brdf, lobe.alpha_x != lobe.alpha_y, lobe.exponent});
    if (weighs(m.sheen_color)) lobes.push_back({m.name, Brdf::charlie});
    if (m.clearcoat > 0) lobes.push_back({m.name, Brdf::ggx});
    const bool metal = m.metallic > 0 && weighs({m.base_color.x, m.base_color.y, m.base_color.z});
    if (m.specular_override.empty() && (metal || m.specular > 0))
      lobes.push_back({m.name, Brdf::ggx, m.anisotropy > 0});
  }
  return lobes;
}

struct Entry {
  const char* name;
  LobeMethod method;
  std::function<bool(const SpecularLobe&)> serves;
};

const std::vector<Entry>& entries() {
  // Sheen goes by its table beside every method of GGX.
  const auto ggx = [](const SpecularLobe& l) { return l.brdf == Brdf::ggx || l.brdf == Brdf::charlie; };
  const auto isotropic_ggx = [ggx](const SpecularLobe& l) { return ggx(l) && !l.anisotropic; };
  const auto phong = [](const SpecularLobe& l) { return l.brdf == Brdf::phong; };
  const auto integer_phong = [](const SpecularLobe& l) {
    return l.brdf == Brdf::phong && l.exponent == std::floor(l.exponent);
  };
  const auto half_vector = [](const SpecularLobe& l) {
    return l.brdf == Brdf::blinn_phong || l.brdf == Brdf::beckmann;
  };
  static const std::vector<Entry> table = {
      {"closed-form", LobeMethod::closed_form, ggx},
      {"ltc", LobeMethod::ltc, isotropic_ggx},
      {"ltc-compact", LobeMethod::ltc_compact, isotropic_ggx},
      {"ltc-clipless", LobeMethod::ltc_clipless, isotropic_ggx},
      {"representative-point", LobeMethod::representative_point, isotropic_ggx},
      {"exact", LobeMethod::exact, phong},
      {"arvo", LobeMethod::arvo, integer_phong},
      {"lorentzian", LobeMethod::lorentzian, phong},
      {"pearson", LobeMethod::pearson, phong},
      {"ellipsoid", LobeMethod::ellipsoid, phong},
      {"series", LobeMethod::series, phong},
      {"half-vector", LobeMethod::half_vector, half_vector},
  };
  return table;
}

std::string describe(const SpecularLobe& lobe) {
  return std::string(lobe.anisotropic ? "anisotropic " : "") + name_of(lobe.brdf) + " lobe of material '" + lobe.material +
         "'";
}

// The most accurate real-time method of each lobe; a draft takes the table for GGX where it can.
Method automatic(const std::vector<SpecularLobe>& lobes, Quality quality) {
  Method method;
  bool ggx = false, anisotropic = false, phong = false, sheen = false, other = false;
  for (const SpecularLobe& l : lobes) {
    ggx |= l.brdf == Brdf::ggx;
    anisotropic |= l.brdf == Brdf::ggx && l.anisotropic;
    phong |= l.brdf == Brdf::phong;
    sheen |= l.brdf == Brdf::charlie;
    other |= l.brdf == Brdf::blinn_phong || l.brdf == Brdf::beckmann;
  }
  if (quality == Quality::draft && !anisotropic) method.ggx = LobeMethod::ltc_compact;
  for (const auto& [present, name] : {std::pair{ggx, method.ggx == LobeMethod::ltc_compact ? "ltc-compact" : "closed-form"},
                                      std::pair{phong, "series"}, std::pair{other, "half-vector"}})
    if (present) method.name += (method.name.empty() ? "" : "+") + std::string(name);
  if (method.name.empty()) method.name = sheen ? "ltc-compact" : "exact";
  return method;
}

Method chosen(const std::vector<SpecularLobe>& lobes, const std::string& name) {
  Method method;
  method.name = name;
  for (const Entry& entry : entries()) {
    if (entry.name != name) continue;
    for (const SpecularLobe& lobe : lobes)
      if (!entry.serves(lobe))
        throw UsageError("--method " + name, "does not serve the " + describe(lobe),
                         "use auto, sampled or reference, or another material");
    method.ggx = method.phong = method.half_vector = entry.method;
    return method;
  }
  throw UsageError("--method", "unknown method '" + name + "'");
}

}  // namespace

std::vector<std::string> lobes_under_means(const Scene& scene, const Method& method) {
  std::vector<std::string> sentences;
  if (method.estimates()) return sentences;
  for (const AreaLight& light : scene.area_lights) {
    if (!light.texture) continue;
    std::set<std::string> said;
    for (const SpecularLobe& lobe : specular_lobes_in(scene))
      if (lobe.brdf != Brdf::ggx && said.insert(describe(lobe)).second)
        sentences.push_back("the " + describe(lobe) + " sees the textured light '" + light.name + "' in its mean colour");
  }
  return sentences;
}

Method choose_method(const Scene& scene, const RenderOptions& options) {
  const std::vector<SpecularLobe> lobes = specular_lobes_in(scene);
  Method method;
  if (options.method == "sampled" || options.method == "reference" || (options.method == "auto" && options.shadows)) {
    method.name = options.method == "auto" ? "sampled" : options.method;
    method.kind = method.name == "reference" ? MethodKind::reference : MethodKind::sampled;
    const bool textured = std::any_of(scene.area_lights.begin(), scene.area_lights.end(),
                                      [](const AreaLight& light) { return light.texture.has_value(); });
    // Under a textured light, no closed form is exact.
    method.exact_diffuse = method.kind == MethodKind::sampled && !options.shadows && !textured;
    method.estimated_lobes = method.exact_diffuse ? LobeChoice::specular : LobeChoice::all;
  } else {
    method = options.method == "auto" ? automatic(lobes, options.quality) : chosen(lobes, options.method);
    if (options.shadows)
      throw UsageError("--shadows on", "'" + options.method + "' casts no shadows", "use --method sampled or reference");
  }
  method.quality = options.quality;
  return method;
}

}  // namespace steradian
