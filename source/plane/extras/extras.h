// What a scene has beyond lights and occluders: suns, fog, and bodies that let light through, mirror it or take it in.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

// What becomes of light that meets a body from outside.
enum class Matter {
  opaque,  // lights, too
  clear,   // goes on, times the transmittance
  mirror,  // is sent back
  deep,    // ends; a point within the body sees through it
};
Matter matter_of(const PlaneBody& body);

struct Extras {
  std::vector<Matter> matter;        // by body
  std::vector<std::size_t> mirrors;  // bodies
  std::vector<std::size_t> lights;   // bodies
  bool clear = false, deep = false;  // is there such a body?
  std::size_t hard_suns = 0;         // without width
  std::string names;                 // "a sun, fog, 'pane', which lets light through": for messages
  // Does the light that a frame without extras knows of change, too?
  bool changes_frames(const PlaneScene& scene) const { return clear || scene.fog_density > 0; }
};

// Null where the scene has none. Throws Error, with the body's name, for values that mean nothing.
std::unique_ptr<const Extras> extras_of(const PlaneScene& scene);

}  // namespace steradian::plane
