// Parts of a scene beyond lights and occluders: suns, fog, and bodies that transmit, mirror or absorb light.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

// Effect of a body on light that meets it from outside.
enum class Matter {
  opaque,  // it may be a light, too
  clear,   // light goes on, times the transmittance
  mirror,  // light is reflected
  deep,    // light ends; a point within the body sees through it
};
Matter matter_of(const PlaneBody& body);

struct Extras {
  std::vector<Matter> matter;        // by body
  std::vector<std::size_t> mirrors;  // bodies
  std::vector<std::size_t> lights;   // bodies
  bool clear = false, deep = false;  // does the scene have such a body?
  std::size_t hard_suns = 0;         // suns without width
  std::string names;                 // "a sun, fog, 'pane', which lets light through": for messages
  // Does light that a frame without extras computes change, too?
  bool changes_frames(const PlaneScene& scene) const { return clear || scene.fog_density > 0; }
};

// Null if the scene has no extras. Throws Error, with the body's name, for values without meaning.
std::unique_ptr<const Extras> extras_of(const PlaneScene& scene);

}  // namespace steradian::plane
