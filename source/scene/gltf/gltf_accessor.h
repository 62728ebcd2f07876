// Reads glTF accessors: typed arrays with strides, normalised integers and sparse replacements, all bounds checked.
#pragma once

#include <string_view>

#include "scene/gltf/gltf_document.h"

namespace steradian::scene {

struct FloatArray {
  std::size_t count = 0;
  int components = 0;
  std::vector<float> values;  // count times components; all finite
};

// The element count of an accessor, after checking that its bytes cover the count.
std::size_t checked_count(const GltfDocument& document, int accessor);

// types: the allowed "type"s separated by spaces ("VEC3 VEC4"). Integers are read as numbers, normalised ones as [0, 1] or [-1, 1]. A value
// that is not finite is an Error if `finite` says so; otherwise it becomes 0.
enum class NotFinite { refuse, zero };
FloatArray read_floats(const GltfDocument& document, int accessor, std::string_view types, NotFinite finite = NotFinite::refuse);

// Reads the first `most` elements only, or all if there are fewer.
FloatArray read_first_floats(const GltfDocument& document, int accessor, std::string_view types, std::size_t most);

// Reads scalars (or, with types "VEC4", joints): unsigned integers only.
std::vector<std::uint32_t> read_unsigned(const GltfDocument& document, int accessor, std::string_view types);

}  // namespace steradian::scene
