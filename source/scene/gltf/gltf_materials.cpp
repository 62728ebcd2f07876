#include "scene/gltf/gltf_materials.h"

#include "core/words.h"
#include "lobes/lobe.h"

namespace steradian::scene {
namespace {

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
      m.base_color = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]), static_cast<float>(c[3])};
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

void read_alpha(SurfaceMaterial& m, const JsonCursor& json) {
  const std::string mode = json.text("alphaMode", "OPAQUE");
  if (mode == "MASK") {
    m.alpha_mode = AlphaMode::mask;
  } else if (mode == "BLEND") {
    m.alpha_mode = AlphaMode::blend;
  } else if (mode != "OPAQUE") {
    json.at("alphaMode").fail("\"" + mode + "\" is not an alpha mode", "OPAQUE, MASK or BLEND");
  }
  m.alpha_cutoff = static_cast<float>(json.number("alphaCutoff", 0.5, 0, std::numeric_limits<double>::infinity()));
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
    const double ior = x->number("ior", 1.5, 0, std::numeric_limits<double>::infinity());
    if (ior > 0 && ior < 1) x->at("ior").fail("must be 0 or at least 1");
    // The extension's special value 0 means an infinite index: Fresnel 1.
    m.ior = ior == 0 ? std::numeric_limits<float>::max() : static_cast<float>(std::min(ior, 1e30));
  }
  if (const auto x = find_extension(json, "KHR_materials_specular")) {
    m.specular = factor(*x, "specularFactor", 1);
    m.specular_texture = textures.use(*x, "specularTexture", ColorSpace::linear);
    m.specular_color = color(*x, "specularColorFactor", {1, 1, 1}, 1e30);
    m.specular_color_texture = textures.use(*x, "specularColorTexture", ColorSpace::srgb);
  }
  if (const auto x = find_extension(json, "KHR_materials_transmission")) {
    m.transmission = factor(*x, "transmissionFactor", 0);
    m.transmission_texture = textures.use(*x, "transmissionTexture", ColorSpace::linear);
  }
  if (const auto x = find_extension(json, "KHR_materials_volume")) {
    m.solid = x->number("thicknessFactor", 0, 0, 1e30) > 0;
    m.attenuation_color = color(*x, "attenuationColor", {1, 1, 1}, 1);
    if (x->find("attenuationDistance")) {
      const double distance = x->number("attenuationDistance", 1, 0, 1e30);
      if (!(distance > 0)) x->at("attenuationDistance").fail("must be above 0");
      m.attenuation_distance = static_cast<float>(distance);
    }
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

const lobes::LobeRow& row_named(const JsonCursor& brdf) {
  const std::string name = brdf.as_text();
  std::string known;
  for (const lobes::LobeRow& row : lobes::lobe_rows()) {
    if (name == row.name) return row;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  brdf.fail("\"" + name + "\" is not a lobe", "known are " + known);
}

// A single number means grey.
Vec3d grey_or_rgb(const JsonCursor& object, const char* key, Vec3d otherwise) {
  const auto member = object.find(key);
  if (!member) return otherwise;
  if (member->value().is_number()) {
    const double x = object.number(key, 0, 0, 1e30);
    return {x, x, x};
  }
  return static_cast<Vec3d>(color(object, key, otherwise, 1e30));
}

Vec3d read_direction(const JsonCursor& object, const std::string& key) {
  const Vec3d v = normalized(object.vector(key, {}));
  if (v == Vec3d{}) object.at(key).fail("the vector is zero", "it needs a direction");
  return v;
}

std::vector<AxisPower> read_factors(const JsonCursor& list) {
  if (!list.value().is_array()) list.fail("expected a list of {axis, exponent}");
  std::vector<AxisPower> factors;
  for (const JsonCursor& one : list.elements()) {
    if (!one.value().is_object()) one.fail("expected an object with axis and exponent");
    for (const auto& [key, value] : one.value().items())
      if (key != "axis" && key != "exponent") one.fail("\"" + key + "\" is not a key of a factor", "known are axis exponent");
    one.at("axis"), one.at("exponent");
    factors.push_back({read_direction(one, "axis"), one.number("exponent", 0, 0, 1e30)});
  }
  return factors;
}

lobes::KeyValue read_key(const JsonCursor& lobe, const lobes::Key& key) {
  using lobes::KeyKind;
  const std::string name(key.name);
  lobes::KeyValue value;
  switch (key.kind) {
    case KeyKind::not_negative: value.number = lobe.number(name, 0, 0, 1e30); break;
    case KeyKind::share: value.number = lobe.number(name, 0, 0, 1); break;
    case KeyKind::colour: value.vector = grey_or_rgb(lobe, name.c_str(), {1, 1, 1}); break;
    case KeyKind::direction: value.vector = read_direction(lobe, name); break;
    case KeyKind::flag: value.flag = lobe.flag(name, false); break;
    case KeyKind::factors: value.factors = read_factors(lobe.at(name)); break;
    case KeyKind::word:
      value.word = lobe.text(name, "");
      if (!words::contains(key.words, value.word))
        lobe.at(name).fail("\"" + value.word + "\" is not known", "one of: " + std::string(key.words));
      break;
  }
  return value;
}

}  // namespace

Material read_lobe(const JsonCursor& lobe) {
  const lobes::LobeRow& row = row_named(lobe.at("brdf"));
  lobes::Draft draft;
  draft.material.brdf = row.brdf;
  std::string known;
  for (const lobes::Key& key : row.keys) known += (known.empty() ? "" : " ") + std::string(key.name);
  for (const auto& [key, value] : lobe.value().items())
    if (key != "brdf" && !lobes::has_key(row.keys, key)) lobe.fail("\"" + key + "\" is not a key of " + row.name, "known are " + known);
  for (const lobes::Key& key : row.keys) {
    if (key.required) lobe.at(key.name);
    if (lobe.has(key.name)) key.set(draft, read_key(lobe, key));
  }
  if (const auto wrong = lobes::check_width(draft))
    lobe.fail("\"" + std::string(wrong->key) + "\": " + std::string(wrong->problem), std::string(wrong->hint));
  return draft.material;
}

std::vector<SurfaceMaterial> read_materials(const GltfDocument& document, GltfTextures& textures) {
  std::vector<SurfaceMaterial> result;
  for (const JsonCursor& json : document.root().elements("materials")) {
    SurfaceMaterial m;
    m.name = json.text("name", "");
    read_base(m, json, textures);
    read_alpha(m, json);
    read_extensions(m, json, textures);
    read_extras(m, json);
    result.push_back(std::move(m));
  }
  return result;
}

}  // namespace steradian::scene
