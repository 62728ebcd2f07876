// Properties of elements, from attributes and style sheets, and their inheritance.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plane/svg/clip.h"
#include "plane/svg/document.h"
#include "plane/svg/text/text.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {

// Purpose for which elements are read: the picture, the outline of a clipPath (by clip-rule, whatever their paint), or the whites and
// blacks of a mask.
enum class Purpose { picture, clip, mask };

enum class Role { by_shape, light, occluder, sun, ignore };

// Position of a sun, and half of its width, in radians.
struct SunPlace {
  double direction = 0, half_width = 0;
};

// Properties that elements inherit.
struct Style {
  std::string fill = "black", stroke = "none", color = "black", cap = "butt", join = "miter", rule = "nonzero", clip_rule = "nonzero";
  std::string dashes = "none";
  std::string family = "sans-serif", weight = "normal", slant = "normal", anchor = "start";
  double font_size = 16;
  std::optional<double> stroke_width;  // none: a line without thickness, or of width 1 with round ends
  double miter_limit = 4;
  Role role = Role::by_shape;
  double intensity = 1;
  std::optional<Vec3d> albedo, transmittance, mirror;
  double light_depth = 0;
  std::optional<SunPlace> sun;
  double opacity = 1, fill_opacity = 1, stroke_opacity = 1;
  double range = std::numeric_limits<double>::infinity();
  PlaneProfile profile = PlaneProfile::uniform;
  Vec2d spot_axis;
  double spot_half_angle = 0;
  Transform transform;
  Purpose purpose = Purpose::picture;
  std::string clip, mask;                                // those of the element itself; empty: none
  std::vector<std::shared_ptr<const ClipRegion>> clips;  // for the element and those around it, in the scene's coordinates
};

class Styles {
 public:
  // `diagonal`: reference of percentages that belong to neither width nor height.
  Styles(SvgDocument& document, double diagonal) : document_(document), diagonal_(diagonal) {}

  // The style of an element within a parent of the given style. An element is read once however many <use> show it.
  Style inherit(pugi::xml_node n, Style style);

 private:
  // Properties declared by one element.
  struct Declared {
    std::optional<std::string> fill, stroke, color, cap, join, dashes, rule, clip_rule, family, font_size, weight, slant, anchor, clip,
        mask;
    std::optional<double> stroke_width, miter_limit, intensity, range, fill_opacity, stroke_opacity;
    double opacity = 1;          // for the whole element
    Role role = Role::by_shape;  // by_shape: not declared
    std::optional<PlaneProfile> profile;
    std::optional<Vec3d> albedo, transmittance, mirror;
    std::optional<double> light_depth;
    std::optional<SunPlace> sun;
    std::optional<std::pair<Vec2d, double>> spot;
    std::optional<Transform> transform;
  };

  const Declared& declared(pugi::xml_node n);
  void read_declared(pugi::xml_node n, Declared& d);
  std::optional<double> share(pugi::xml_node n, const char* key) const;
  void refuse_misspelt(pugi::xml_node n) const;
  void read_role(pugi::xml_node n, Declared& d) const;
  void read_profile(pugi::xml_node n, Declared& d) const;
  std::optional<Vec3d> read_shares(pugi::xml_node n, const char* key) const;
  void read_sun(pugi::xml_node n, Declared& d) const;

  SvgDocument& document_;
  double diagonal_;
  std::unordered_map<const void*, Declared> declared_;
};

}  // namespace steradian::plane::svg
