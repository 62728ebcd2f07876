// The lamps of a document: everything that emits, with the values that a panel shows and changes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/document.h"
#include "document/node_pose.h"

namespace steradian::view {

enum class LampKind { area, punctual, profile, mesh };

// A lamp is a node with a light, or a mesh whose material emits. If nodes share a light, a change affects all of them.
struct Lamp {
  LampKind kind = LampKind::area;
  int node = 0;
  int light = 0;           // index into its extension's lights; for a mesh: its material
  std::string name, type;  // "disk", "spot", "mesh"
};
std::vector<Lamp> lamps_of(const EditedDocument& document, const NodeTree& tree);

struct LampValues {
  Vec3d color{1, 1, 1};
  double intensity = 1;  // radiance is color times intensity; in candela for point lights, in lux for suns
  // Each of the following is set only if the lamp has it.
  std::optional<std::string> type;                 // rect, disk, sphere, capsule; or point, spot, directional
  std::optional<double> size, aspect, length;      // for area lights
  std::optional<bool> two_sided;                   // for flat lights
  std::optional<double> inner_angle, outer_angle;  // for spots [rad]
};
LampValues values_of(const EditedDocument& document, const Lamp& lamp);
void set_values(EditedDocument& document, const Lamp& lamp, const LampValues& values);  // writes changed values only

// Adds a light with a size of one metre and radiance 5 at a place, which shines along `direction`; returns its node. point, spot and
// directional have an intensity of 5.
int add_light(EditedDocument& document, const std::string& type, Vec3d position, Vec3d direction, double size = 1);
// Adds a node to the scene whose -z points along `direction`.
int add_node(EditedDocument& document, Json json, Vec3d position, Vec3d direction);
void use_extension(EditedDocument& document, const std::string& name);
// The lamp's node no longer emits; a mesh is no longer shown.
void remove_lamp(EditedDocument& document, const Lamp& lamp);

struct MaterialValues {
  std::string name;
  Vec3d base_color{1, 1, 1};
  double metallic = 1, roughness = 1;
  Json lobe;  // replaces the specular lobe, as in extras.steradian; null: no replacement
};
// The lobes that a material may have, and the JSON of one of them with the keys that it needs.
std::vector<std::string> lobe_names();
Json lobe_named(const std::string& name);
MaterialValues material_values(const EditedDocument& document, int material);
void set_material_values(EditedDocument& document, int material, const MaterialValues& values);

}  // namespace steradian::view
