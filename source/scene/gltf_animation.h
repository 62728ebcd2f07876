// Animations of a glTF file: what changes of it with time. A moment is the file with the values of that moment in the places that they
// animate, so that whatever reads the file reads the moment.
#pragma once

#include <string>
#include <vector>

#include "scene/gltf_file.h"

namespace steradian::scene {

struct AnimationChannel {
  enum class Between { step, linear, cubic };

  std::string pointer;  // the value's place in the file: "/nodes/3/translation"
  Between between = Between::linear;
  bool rotation = false;       // a unit quaternion: along the arc
  bool number = false;         // a number, not a list
  std::vector<double> times;   // rising [s]
  std::size_t width = 0;       // numbers of a value
  std::vector<double> values;  // by time; of cubic: tangent before, value, tangent after
};

struct GltfAnimation {
  std::string name;
  double duration = 0;  // of its last key [s]
  std::vector<AnimationChannel> channels;
};

// Of nodes (translation, rotation, scale, weights) and, by KHR_animation_pointer, of any number or list of numbers that the file has:
// cameras, lights, materials. Throws Error with the place in the file for what is broken.
std::vector<GltfAnimation> read_animations(const GltfFile& file, const Limits& limits = {});

// The value of a channel, before its first key that of the first, after its last that of the last.
std::vector<double> value_at(const AnimationChannel& channel, double seconds);

// The file at a moment.
Json json_at(const Json& json, const GltfAnimation& animation, double seconds);

}  // namespace steradian::scene
