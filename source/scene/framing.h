// The place and size of scenes, and defaults for those without a camera or without a light.
#pragma once

#include <vector>

#include "core/box.h"
#include "steradian/load_scene.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Sets bounds_min and bounds_max from all meshes.
void measure_bounds(Scene& scene);

Box3d box_around(const std::vector<Mesh>& meshes);

// The middle of a box that lies so far from the origin that floats are off by 1e-6 of its size; zero for other boxes.
Vec3d far_middle(const Box3d& box);

// A camera in front of the scene, to the right and above, as near as possible with all vertices in a picture of that aspect (width over
// height). The shapes of lights need not be in the picture.
Camera framing_camera(const Scene& scene, double aspect);

// A square light above, in front and to the left, that faces the scene's centre. It is not visible itself.
AreaLight default_light(const Scene& scene);

// Light of a quarter of that irradiance from the side of framing_camera, so that shade is not black. It is directional: its shadows are
// cheapest, and lie behind what that camera sees. Another camera does not move it, so a scene looks the same when it is saved with one.
PunctualLight default_fill();

// True if the scene's own lights leave its picture black. That is so if it has no light, or only emissive textures, each of which is one of
//   - a detail that glows on an object, such as a helmet's visor. Its radiance times area is below a thirtieth of the default light's.
//     Such textures are on meshes that are more than half of all surface;
//   - labels that light nothing else. At least half of the surface that faces the camera and does not emit gets little from them:
//     without shadows, less than a thousandth of what a surface facing the default light gets from that light.
// Other lights are intended, however weak, and so are textures that light visible surfaces.
bool wants_light(const Scene& scene, const Camera& camera);

// Adds the lights that a user asks for. None of them is visible itself.
void add_lights(Scene& scene, const std::vector<AddedLight>& lights);

}  // namespace steradian::scene
