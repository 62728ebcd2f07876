// The keys of a lobe in files, for `eval` and for the extras of glTF materials.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steradian/material.h"

namespace steradian::lobes {

enum class KeyKind {
  not_negative,  // a number, 0 or more
  share,         // a number from 0 to 1
  colour,        // a number or [r,g,b], not negative
  direction,     // [x,y,z], not zero; made unit
  flag,          // true or false
  factors,       // a list of {"axis": direction, "exponent": not_negative}
  word           // one of Key::words
};

// Value of a key, in the member of its kind.
struct KeyValue {
  double number = 0;
  Vec3d vector;  // also holds a colour
  bool flag = false;
  std::string word;
  std::vector<AxisPower> factors;
};

// A material while it is read. The width may be given in three ways; which of them were used is checked at the end.
struct Draft {
  Material material;
  bool roughness = false, alpha = false, alpha_x = false, alpha_y = false;
};

struct Key {
  std::string_view name;
  KeyKind kind;
  void (*set)(Draft& draft, const KeyValue& value);
  bool required = false;
  std::string_view words{};  // for KeyKind::word, separated by spaces
};

// True if the keys contain this one.
template <class Keys>
bool has_key(const Keys& keys, std::string_view name) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
}

// A problem with the width of a lobe: the key, the problem, and what to do.
struct WidthProblem {
  std::string_view key, problem, hint;
};
std::optional<WidthProblem> check_width(const Draft& draft);

// ---- Keys that several lobes have --------------------------------------------------------------------------------

inline constexpr Key kAlbedo = {"albedo", KeyKind::colour, [](Draft& d, const KeyValue& v) { d.material.albedo = v.vector; }};
inline constexpr Key kExponent = {"exponent", KeyKind::not_negative, [](Draft& d, const KeyValue& v) { d.material.exponent = v.number; },
                                  true};
inline constexpr Key kRoughness = {"roughness", KeyKind::share, [](Draft& d, const KeyValue& v) {
                                     d.material.alpha_x = d.material.alpha_y = alpha_from_roughness(v.number);
                                     d.roughness = true;
                                   }};
inline constexpr Key kAlpha = {"alpha", KeyKind::share, [](Draft& d, const KeyValue& v) {
                                 d.material.alpha_x = d.material.alpha_y = std::max(v.number, kSmallestAlpha);
                                 d.alpha = true;
                               }};
inline constexpr Key kAlphaX = {"alpha_x", KeyKind::share, [](Draft& d, const KeyValue& v) {
                                  d.material.alpha_x = std::max(v.number, kSmallestAlpha);
                                  d.alpha_x = true;
                                }};
inline constexpr Key kAlphaY = {"alpha_y", KeyKind::share, [](Draft& d, const KeyValue& v) {
                                  d.material.alpha_y = std::max(v.number, kSmallestAlpha);
                                  d.alpha_y = true;
                                }};
inline constexpr Key kTangent = {"tangent", KeyKind::direction, [](Draft& d, const KeyValue& v) { d.material.tangent = v.vector; }};

}  // namespace steradian::lobes
