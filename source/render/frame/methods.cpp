#include "render/frame/methods.h"

#include <algorithm>
#include <set>

#include "scene/table_file.h"
#include "steradian/error.h"

namespace steradian {
namespace {

// A lobe that a surface shows, in the form in which the table of methods is queried.
struct SpecularLobe {
  std::string material;
  Material lobe;
  bool layered = false;  // belongs to a metallic-roughness surface or a coat
};

Material ggx_of_any_width(bool anisotropic) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = anisotropic ? 2 * m.alpha_y : m.alpha_y;
  m.f0 = {0.04, 0.04, 0.04};
  return m;
}

Material sheen() {
  Material m;
  m.brdf = Brdf::charlie;
  return m;
}

// The specular lobes of the scene's meshes, by the materials' factors.
std::vector<SpecularLobe> specular_lobes_in(const Scene& scene) {
  std::vector<SpecularLobe> lobes;
  for (const Mesh& mesh : scene.meshes) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (m.unlit || mesh.is_light_shape || mesh.indices.empty()) continue;
    for (const Material& lobe : m.specular_override)
      if (lobe.brdf != Brdf::lambert) lobes.push_back({m.name, lobe});
    if (weighs(m.sheen_color)) lobes.push_back({m.name, sheen()});
    if (m.clearcoat > 0) lobes.push_back({m.name, ggx_of_any_width(false), true});
    const bool metal = m.metallic > 0 && weighs({m.base_color.x, m.base_color.y, m.base_color.z});
    if (m.specular_override.empty() && (metal || m.specular > 0)) lobes.push_back({m.name, ggx_of_any_width(m.anisotropy > 0), true});
  }
  return lobes;
}

std::string describe(const SpecularLobe& l) {
  const bool anisotropic = l.lobe.brdf == Brdf::ggx && l.lobe.alpha_x != l.lobe.alpha_y;
  return std::string(anisotropic ? "anisotropic " : "") + name_of(l.lobe.brdf) + " lobe of material '" + l.material + "'";
}

// Sheen has one method, which serves beside every method of GGX.
Method method_for(Method asked_for, const Material& lobe) {
  return lobe.brdf == Brdf::charlie && asked_for != Method::automatic && methods::row_of(asked_for).serves(ggx_of_any_width(false))
             ? Method::automatic
             : asked_for;
}

DirectMethod chosen(const std::vector<SpecularLobe>& lobes, const std::string& name, Quality quality) {
  DirectMethod method;
  const std::optional<Method> asked_for = method_of(name);
  if (!asked_for) throw UsageError("--method", "unknown method '" + name + "'");
  method.asked_for = *asked_for;
  bool layered = false;
  for (const SpecularLobe& l : lobes) {
    const methods::Row* row = methods::find(method_for(*asked_for, l.lobe), l.lobe, quality);
    if (row == nullptr || !row->in_float)  // in a picture, auto never means a reference
      throw UsageError("--method " + name, "does not serve the " + describe(l), "use auto, sampled or reference, or another material");
    // All layered lobes use one method: the first that a lobe asks for, or the closed form if another lobe cannot have that.
    if (l.layered) {
      method.ggx = !layered || method.ggx == row->method ? row->method : Method::closed_form;
      layered = true;
    }
  }
  if (*asked_for != Method::automatic) {
    method.name = name;
    return method;
  }
  const auto add = [&](Method m) {
    const std::string own = name_of(m);
    if (("+" + method.name + "+").find("+" + own + "+") == std::string::npos) method.name += (method.name.empty() ? "" : "+") + own;
  };
  for (const SpecularLobe& l : lobes) add(l.layered ? method.ggx : methods::find(*asked_for, l.lobe, quality)->method);
  if (method.name.empty()) method.name = name_of(Method::exact);
  return method;
}

// A table has one width. The method ltc refuses other lobes by itself.
void refuse_anisotropic(const std::vector<SpecularLobe>& lobes) {
  for (const SpecularLobe& l : lobes)
    if (l.lobe.brdf == Brdf::ggx && l.lobe.alpha_x != l.lobe.alpha_y)
      throw UsageError("--table", "does not serve the " + describe(l), "use another material, or leave --table out");
}

}  // namespace

const methods::Row& DirectMethod::row_for(const Material& lobe) const {
  return methods::resolve(method_for(asked_for, lobe), lobe, Precision::float_, quality);
}

RadianceOptions DirectMethod::options_for(Method by, Precision precision) const {
  RadianceOptions options = {by, quality, precision};
  options.table = table;
  options.peak_form = peak_form;
  options.early_stop = early_stop;
  return options;
}

LtcPackTables tables_of(const DirectMethod& method) { return ltc_pack_tables(method.ggx, method.quality, method.table.get()); }

std::vector<std::string> lobes_under_means(const Scene& scene, const DirectMethod& method) {
  std::vector<std::string> sentences;
  if (method.estimates()) return sentences;
  for (const AreaLight& light : scene.area_lights) {
    if (!light.texture) continue;
    std::set<std::string> said;
    for (const SpecularLobe& l : specular_lobes_in(scene))
      if (l.lobe.brdf != Brdf::ggx && said.insert(describe(l)).second)
        sentences.push_back("the " + describe(l) + " sees the textured light '" + light.name + "' in its mean colour");
  }
  return sentences;
}

DirectMethod choose_method(const Scene& scene, const RenderOptions& options) {
  const std::vector<SpecularLobe> lobes = specular_lobes_in(scene);
  DirectMethod method;
  if (options.method == "sampled" || options.method == "reference") {
    method.name = options.method;
    method.kind = method.name == "reference" ? MethodKind::reference : MethodKind::sampled;
    const bool uneven = std::any_of(scene.area_lights.begin(), scene.area_lights.end(),
                                    [](const AreaLight& light) { return light.texture.has_value() || light.emission.has_value(); });
    // Under a textured or profiled light or an environment, no closed form is exact.
    method.exact_diffuse = method.kind == MethodKind::sampled && options.shadows == Shadows::off && !uneven && !scene.environment;
    method.estimated_lobes = method.exact_diffuse ? LobeChoice::specular : LobeChoice::all;
  } else {
    method = chosen(lobes, options.method, options.quality);
  }
  method.quality = options.quality;
  method.peak_form = options.peak_form;
  method.early_stop = options.early_stop;
  if (options.table.empty()) return method;
  if (!method.estimates() && options.method != "ltc")
    throw UsageError("--table", "only the methods ltc, sampled and reference read a table", "add --method ltc");
  if (options.indirect.mode != IndirectMode::off) throw UsageError("--table", "--indirect has GGX's lobe alone", "leave one of them out");
  if (options.bounces != 0 && !method.estimates())
    throw UsageError("--table", "--bounces has GGX's albedo alone", "add --method reference, or leave one of them out");
  refuse_anisotropic(lobes);
  method.table = std::make_shared<const ClassicTable>(scene::read_classic_table(options.table));
  return method;
}

}  // namespace steradian
