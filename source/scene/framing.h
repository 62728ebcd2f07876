// What a scene gets that brings no camera or no light.
#pragma once

#include "steradian/load_scene.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Sets bounds_min and bounds_max from all meshes.
void measure_bounds(Scene& scene);

// A camera in front of the scene and above it, as near as it can be with all vertices in a picture of that aspect (width over height).
// The shapes of lights need not be in it.
Camera framing_camera(const Scene& scene, double aspect);

// A square light above, in front and to the left, that looks at the scene's centre. It is not visible itself.
AreaLight default_light(const Scene& scene);

// Whether the scene's own lights leave its picture black: it has none, or none but emissive textures, which are one of
//   - a detail that glows on an object, a helmet's visor: their radiance times area is below a thirtieth of the default light's, on
//     meshes that are more than half of all surface;
//   - labels that light nothing else: half or more of the surface that faces the camera and does not shine gets from them, shadows aside,
//     less than a thousandth of what faces the default light gets from that.
// Other lights, and textures that light what is seen, however weak, are meant.
bool wants_light(const Scene& scene, const Camera& camera);

// Adds what a user asks for; none of these lights is visible itself.
void add_lights(Scene& scene, const std::vector<AddedLight>& lights);

}  // namespace steradian::scene
