// The light that a picture lacks.
#pragma once

#include "steradian/render.h"
#include "steradian/scene.h"

namespace steradian::app {

// The mean part of the light of a surface that the others would send back to it, at most: by their form factors and base colours, without
// shadows, from 256 points spread over all surfaces that do not shine.
double light_between_surfaces(const Scene& scene);

// True if a scene has solids that would focus light: no picture has these caustics.
bool may_focus_light(const Scene& scene);

// Prints one line for each thing that a picture lacks: caustics, and without light between surfaces the blur of rough glass, and that light
// where it is a twentieth of all or more.
void say_direct_only(const Scene& scene, const RenderOptions& options);

}  // namespace steradian::app
