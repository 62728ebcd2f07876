// Animations of a glTF file. A moment is the file with the animated values replaced by their values at that time. So whatever reads the
// file can read the moment.
#pragma once

#include <string>
#include <vector>

#include "scene/gltf/gltf_file.h"

namespace steradian::scene {

struct AnimationChannel {
  enum class Between { step, linear, cubic };

  std::string pointer;  // the value's place in the file: "/nodes/3/translation"
  Between between = Between::linear;
  bool rotation = false;       // a unit quaternion, interpolated along the arc
  bool number = false;         // a number, not a list
  std::vector<double> times;   // rising [s]
  std::size_t width = 0;       // numbers per value
  std::vector<double> values;  // one value per time; for cubic: tangent before, value, tangent after
};

struct GltfAnimation {
  std::string name;
  double duration = 0;  // time of the last key [s]
  std::vector<AnimationChannel> channels;
};

// Reads the animations of nodes (translation, rotation, scale, weights). By KHR_animation_pointer they also animate any number or list of
// numbers in the file: cameras, lights, materials. Throws Error with the place in the file for broken animations.
std::vector<GltfAnimation> read_animations(const GltfFile& file, const Limits& limits = {});

// The value of a channel. Times before the first key give the first value, times after the last key the last value.
std::vector<double> value_at(const AnimationChannel& channel, double seconds);

// The file's JSON at a moment.
Json json_at(const Json& json, const GltfAnimation& animation, double seconds);

}  // namespace steradian::scene
