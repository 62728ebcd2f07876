#include "scene/gltf_materials.h"

namespace steradian {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

float factor(const JsonCursor& object, const char* key, double otherwise) {
  return static_cast<float>(object.number(key, otherwise, 0, 1));
}

Vec3f color(const JsonCursor& object, const char* key, Vec3d otherwise, double highest) {
  const Vec3d c = object.vector(key, otherwise);
  if (c.x < 0 || c.y < 0 || c.z < 0 || c.x > highest || c.y > highest || c.z > highest)
    object.at(key).fail(highest == 1 ? "components must be from 0 to 1" : "components must not be negative");
  return static_cast<Vec3f>(c);
}

void read_base(SurfaceMaterial& m, const JsonCursor& json, GltfTextures& textures) {
  if (const auto pbr = json.find("pbrMetallicRoughness")) {
    if (const auto base = pbr->find("baseColorFactor")) {
      const auto c = base->as_numbers<4>();
      for (const double x : c)
        if (x < 0 || x > 1) base->fail("components must be from 0 to 1");
      m.base_color = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]),
                      static_cast<float>(c[3])};
    }
    m.base_color_texture = textures.use(*pbr, "baseColorTexture", ColorSpace::srgb);
    m.metallic = factor(*pbr, "metallicFactor", 1);
    m.roughness = factor(*pbr, "roughnessFactor", 1);
    m.metallic_roughness_texture = textures.use(*pbr, "metallicRoughnessTexture", ColorSpace::linear);
  }
  m.normal_texture = textures.use(json, "normalTexture", ColorSpace::linear);
  m.occlusion_texture = textures.use(json, "occlusionTexture", ColorSpace::linear);
  m.emissive = color(json, "emissiveFactor", {0, 0, 0}, 1);
  m.emissive_texture = textures.use(json, "emissiveTexture", ColorSpace::srgb);
  m.double_sided = json.flag("doubleSided", false);
}

void read_alpha(SurfaceMaterial& m, const JsonCursor& json, Warnings& warnings) {
  const std::string mode = json.text("alphaMode", "OPAQUE");
  if (mode == "MASK") {
    m.alpha_mode = AlphaMode::mask;
  } else if (mode == "BLEND") {
    m.alpha_mode = AlphaMode::blend;
    warnings.say("materials with alpha mode BLEND are rendered as opaque, the first is " + json.place());
  } else if (mode != "OPAQUE") {
    json.at("alphaMode").fail("\"" + mode + "\" is not an alpha mode", "OPAQUE, MASK or BLEND");
  }
  m.alpha_cutoff = static_cast<float>(json.number("alphaCutoff", 0.5, 0, kInfinity));
}

void read_extensions(SurfaceMaterial& m, const JsonCursor& json, GltfTextures& textures) {
  m.unlit = find_extension(json, "KHR_materials_unlit").has_value();
  if (const auto x = find_extension(json, "KHR_materials_emissive_strength"))
    m.emissive *= static_cast<float>(x->number("emissiveStrength", 1, 0, 1e30));
  if (const auto x = find_extension(json, "KHR_materials_clearcoat")) {
    m.clearcoat = factor(*x, "clearcoatFactor", 0);
    m.clearcoat_texture = textures.use(*x, "clearcoatTexture", ColorSpace::linear);
    m.clearcoat_roughness = factor(*x, "clearcoatRoughnessFactor", 0);
    m.clearcoat_roughness_texture = textures.use(*x, "clearcoatRoughnessTexture", ColorSpace::linear);
    m.clearcoat_normal_texture = textures.use(*x, "clearcoatNormalTexture", ColorSpace::linear);
  }
  if (const auto x = find_extension(json, "KHR_materials_sheen")) {
    m.sheen_color = color(*x, "sheenColorFactor", {0, 0, 0}, 1);
    m.sheen_color_texture = textures.use(*x, "sheenColorTexture", ColorSpace::srgb);
    m.sheen_roughness = factor(*x, "sheenRoughnessFactor", 0);
    m.sheen_roughness_texture = textures.use(*x, "sheenRoughnessTexture", ColorSpace::linear);
  }
  if (const auto x = find_extension(json, "KHR_materials_ior")) {
    const double ior = x->number("ior", 1.5, 0, kInfinity);
    if (ior > 0 && ior < 1) x->at("ior").fail("must be 0 or at least 1");
    // The extension's special value: an infinite index, Fresnel 1.
    m.ior = ior == 0 ? std::numeric_limits<float>::max() : static_cast<float>(std::min(ior, 1e30));
  }
  if (const auto x = find_extension(json, "KHR_materials_specular")) {
    m.specular = factor(*x, "specularFactor", 1);
    m.specular_texture = textures.use(*x, "specularTexture", ColorSpace::linear);
    m.specular_color = color(*x, "specularColorFactor", {1, 1, 1}, 1e30);
    m.specular_color_texture = textures.use(*x, "specularColorTexture", ColorSpace::srgb);
  }
  if (const auto x = find_extension(json, "KHR_materials_anisotropy")) {
    m.anisotropy = factor(*x, "anisotropyStrength", 0);
    m.anisotropy_rotation = static_cast<float>(x->number("anisotropyRotation", 0));
    m.anisotropy_texture = textures.use(*x, "anisotropyTexture", ColorSpace::linear);
  }
}

void read_extras(SurfaceMaterial& m, const JsonCursor& json) {
  const auto extras = json.find("extras");
  if (!extras || !extras->value().is_object()) return;
  const auto ours = extras->find("steradian");
  if (!ours) return;
  if (!ours->value().is_array()) {
    m.specular_override.push_back(read_lobe(*ours));
    return;
  }
  for (const JsonCursor& lobe : ours->elements()) m.specular_override.push_back(read_lobe(lobe));
  if (m.specular_override.empty()) ours->fail("the list of lobes is empty");
}

Brdf brdf_of(const JsonCursor& brdf) {
  const std::string name = brdf.as_text();
  std::string known;
  for (const Brdf b : {Brdf::lambert, Brdf::phong, Brdf::ggx, Brdf::blinn_phong, Brdf::beckmann, Brdf::charlie}) {
    if (name == name_of(b)) return b;
    known += (known.empty() ? "" : ", ") + std::string(name_of(b));
  }
  brdf.fail("\"" + name + "\" is not a lobe", "known are " + known);
}

// A number stands for a grey.
Vec3d grey_or_rgb(const JsonCursor& object, const char* key, Vec3d otherwise) {
  const auto member = object.find(key);
  if (!member) return otherwise;
  if (member->value().is_number()) {
    const double x = object.number(key, 0, 0, 1e30);
    return {x, x, x};
  }
  return static_cast<Vec3d>(color(object, key, otherwise, 1e30));
}

void read_widths(Material& m, const JsonCursor& lobe) {
  constexpr double kSmallest = 1e-4;  // the smallest alpha of the library's convention
  const int ways = lobe.has("roughness") + lobe.has("alpha") + (lobe.has("alpha_x") || lobe.has("alpha_y"));
  if (ways > 1)
    lobe.fail("gives its width more than once", "use one of roughness, alpha, alpha_x with alpha_y");
  const double r = lobe.number("roughness", 0.5, 0, 1);
  const double alpha = lobe.number("alpha", r * r, 0, 1);
  m.alpha_x = std::max(lobe.number("alpha_x", alpha, 0, 1), kSmallest);
  m.alpha_y = std::max(lobe.number("alpha_y", alpha, 0, 1), kSmallest);
  if (lobe.has("alpha_x") != lobe.has("alpha_y")) lobe.fail("needs both alpha_x and alpha_y");
  m.tangent = lobe.vector("tangent", {0, 0, 0});
}

const char* keys_of(Brdf brdf) {
  switch (brdf) {
    case Brdf::lambert:
      return "albedo";
    case Brdf::phong:
      return "exponent albedo";
    case Brdf::ggx:
      return "roughness alpha alpha_x alpha_y tangent f0 f90 shadowing multiple_scattering";
    case Brdf::blinn_phong:
      return "exponent";
    case Brdf::beckmann:
      return "roughness alpha alpha_x alpha_y tangent";
    case Brdf::charlie:
      return "roughness alpha albedo";
  }
  return "";
}

}  // namespace

Material read_lobe(const JsonCursor& lobe) {
  Material m;
  m.brdf = brdf_of(lobe.at("brdf"));
  const std::string allowed = keys_of(m.brdf);
  for (const auto& [key, value] : lobe.value().items())
    if (key != "brdf" && !has_word(allowed, key))
      lobe.fail("\"" + key + "\" is not a key of " + name_of(m.brdf), "known are " + allowed);
  m.albedo = grey_or_rgb(lobe, "albedo", m.albedo);
  if (m.brdf == Brdf::phong || m.brdf == Brdf::blinn_phong) {
    lobe.at("exponent");
    m.exponent = lobe.number("exponent", 1, 0, 1e6);
  }
  read_widths(m, lobe);
  m.f0 = grey_or_rgb(lobe, "f0", m.f0);
  m.f90 = grey_or_rgb(lobe, "f90", m.f90);
  const std::string shadowing = lobe.text("shadowing", "smith");
  if (shadowing != "smith" && shadowing != "none") lobe.at("shadowing").fail("must be \"smith\" or \"none\"");
  m.shadowing = shadowing == "smith";
  m.multiple_scattering = lobe.flag("multiple_scattering", false);
  return m;
}

std::vector<SurfaceMaterial> read_materials(const GltfDocument& document, GltfTextures& textures,
                                            Warnings& warnings) {
  std::vector<SurfaceMaterial> result;
  for (const JsonCursor& json : document.root().elements("materials")) {
    SurfaceMaterial m;
    m.name = json.text("name", "");
    read_base(m, json, textures);
    read_alpha(m, json, warnings);
    read_extensions(m, json, textures);
    read_extras(m, json);
    result.push_back(std::move(m));
  }
  return result;
}

}  // namespace steradian
