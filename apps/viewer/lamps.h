// The lamps of a document: what shines in it, with the values that a panel shows and changes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document.h"
#include "node_pose.h"

namespace steradian::view {

enum class LampKind { area, punctual, profile, mesh };

// A lamp is a node that carries a light, or a mesh of a material that shines. Nodes may share a light: it changes for all of them.
struct Lamp {
  LampKind kind = LampKind::area;
  int node = 0;
  int light = 0;           // into its extension's lights; of a mesh: its material
  std::string name, type;  // "disk", "spot", "mesh"
};
std::vector<Lamp> lamps_of(const Document& document, const NodeTree& tree);

struct LampValues {
  Vec3d color{1, 1, 1};
  double intensity = 1;  // radiance is color times intensity; of point lights candela, of suns lux
  // Each only where the lamp has it.
  std::optional<std::string> type;                 // rect, disk, sphere, capsule; or point, spot, directional
  std::optional<double> size, aspect, length;      // of area lights
  std::optional<bool> two_sided;                   // of flat ones
  std::optional<double> inner_angle, outer_angle;  // of spots [rad]
};
LampValues values_of(const Document& document, const Lamp& lamp);
void set_values(Document& document, const Lamp& lamp, const LampValues& values);  // writes what differs alone

// A light of one metre and radiance 5 at a place, shining along `direction`; its node. point, spot and directional have an intensity of 5.
int add_light(Document& document, const std::string& type, Vec3d position, Vec3d direction, double size = 1);
// A node of the scene whose -z looks along `direction`.
int add_node(Document& document, Json json, Vec3d position, Vec3d direction);
void use_extension(Document& document, const std::string& name);
// Its node no longer shines; a mesh is no longer shown.
void remove_lamp(Document& document, const Lamp& lamp);

struct MaterialValues {
  std::string name;
  Vec3d base_color{1, 1, 1};
  double metallic = 1, roughness = 1;
  Json lobe;  // that stands in the place of the specular one, as extras.steradian says it; null: none does
};
// The lobes that a material may be given, and one of them with the keys that it needs.
std::vector<std::string> lobe_names();
Json lobe_named(const std::string& name);
MaterialValues material_values(const Document& document, int material);
void set_material_values(Document& document, int material, const MaterialValues& values);

}  // namespace steradian::view
