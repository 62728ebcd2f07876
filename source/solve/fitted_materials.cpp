#include "solve/fitted_materials.h"

#include <algorithm>
#include <limits>

namespace steradian::solving {
namespace {

// The reason why a material lacks a parameter; empty if it has it.
std::string lack_of(const MaterialFit& fit, const SurfaceMaterial& m) {
  if (!fit.albedo && !fit.roughness) return "nothing of it is free (name albedo or roughness)";
  if (m.unlit) return "an unlit material takes no light";
  if (fit.roughness && !m.specular_override.empty()) return "its lobe is one of the file's own, without a roughness";
  return "";
}

}  // namespace

FittedMaterials::FittedMaterials(const Scene& scene, const std::vector<MaterialFit>& fits, std::vector<Unknown>& unknowns,
                                 std::vector<std::string>& problems)
    : scene_(&scene) {
  for (const MaterialFit& fit : fits) {
    if (fit.material >= scene.materials.size()) {
      problems.push_back("material " + std::to_string(fit.material) + " is not in the scene, which has " +
                         std::to_string(scene.materials.size()));
      continue;
    }
    const SurfaceMaterial& m = scene.materials[fit.material];
    Fitted fitted;
    fitted.name = !fit.name.empty() ? fit.name : !m.name.empty() ? m.name : "material " + std::to_string(fit.material);
    fitted.start = {fit.material, fit.albedo, fit.roughness, Vec3d(Vec3f{m.base_color.x, m.base_color.y, m.base_color.z}),
                    static_cast<double>(m.roughness)};
    const auto complain = [&](const std::string& problem) { problems.push_back("'" + fitted.name + "': " + problem); };
    if (std::any_of(fitted_.begin(), fitted_.end(), [&](const Fitted& f) { return f.start.material == fit.material; })) {
      complain("it is fitted twice (name it once)");
      continue;
    }
    if (const std::string lack = lack_of(fit, m); !lack.empty()) {
      complain(lack);
      continue;
    }
    const auto add = [&](const char* word, UnknownKind kind, double start, const FitRange& range) {
      const double low = std::max(range.low, 0.0), high = std::min(range.high, 1.0);
      if (!(low <= high))
        complain(std::string(word) + ": the least value is above the largest");
      else if (!(start >= low && start <= high))
        complain(std::string(word) + ": the start is outside of its range (widen the range)");
      fitted.unknowns.push_back(unknowns.size());
      fitted.kinds.push_back(kind);
      unknowns.push_back({fitted.name + ": " + word, fitted_.size(), kind, start, low, high, 1, fit.keep});
    };
    if (fit.albedo) {
      add("albedo red", UnknownKind::albedo_red, fitted.start.albedo.x, fit.albedo_range);
      add("albedo green", UnknownKind::albedo_green, fitted.start.albedo.y, fit.albedo_range);
      add("albedo blue", UnknownKind::albedo_blue, fitted.start.albedo.z, fit.albedo_range);
    }
    if (fit.roughness) add("roughness", UnknownKind::roughness, fitted.start.roughness, fit.roughness_range);
    if (!(fit.keep >= 0 && fit.keep < std::numeric_limits<double>::infinity())) complain("keep must be 0 or more");
    fitted_.push_back(std::move(fitted));
  }
}

std::vector<MaterialChange> FittedMaterials::changes_at(const std::vector<double>& x) const {
  std::vector<MaterialChange> changes;
  for (const Fitted& fitted : fitted_) {
    MaterialChange& change = changes.emplace_back(fitted.start);
    for (std::size_t i = 0; i < fitted.unknowns.size(); ++i) {
      const double value = x[fitted.unknowns[i]];
      switch (fitted.kinds[i]) {
        case UnknownKind::albedo_red: change.albedo.x = value; break;
        case UnknownKind::albedo_green: change.albedo.y = value; break;
        case UnknownKind::albedo_blue: change.albedo.z = value; break;
        default: change.roughness = value; break;
      }
    }
  }
  return changes;
}

std::vector<SurfaceMaterial> FittedMaterials::at(const std::vector<double>& x) const {
  if (empty()) return {};
  std::vector<SurfaceMaterial> materials = scene_->materials;
  for (const MaterialChange& change : changes_at(x)) {
    SurfaceMaterial& m = materials[change.material];
    const Vec3f albedo(change.albedo);
    m.base_color = {albedo.x, albedo.y, albedo.z, m.base_color.w};
    m.roughness = static_cast<float>(change.roughness);
  }
  return materials;
}

std::vector<std::string> FittedMaterials::notes() const {
  std::vector<std::string> notes;
  for (const Fitted& fitted : fitted_) {
    const auto meshes = std::count_if(scene_->meshes.begin(), scene_->meshes.end(),
                                      [&](const Mesh& mesh) { return static_cast<std::size_t>(mesh.material) == fitted.start.material; });
    if (meshes > 1) notes.push_back("material '" + fitted.name + "' is that of " + std::to_string(meshes) + " meshes, which all change");
  }
  return notes;
}

}  // namespace steradian::solving
