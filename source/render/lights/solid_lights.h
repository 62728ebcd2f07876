// Closed emissive meshes as one light each, for shadows that find the light's outline from every point.
#pragma once

#include <vector>

#include "render/lights/light_list.h"
#include "shadow/edges/solid_light.h"

namespace steradian {

// A closed mesh that shines evenly: its form, and its faces for points in its midst.
struct SolidPackLight {
  shadow::SolidLight form;
  std::vector<PreparedPolygon> faces;
};

// Replaces the lights of closed meshes that shine evenly by one light each. The result is numbered anew. Only passes that see such a light
// by its edges can take it (ShadowPass).
std::vector<PackLight> with_solids(std::vector<PackLight> lights, const Scene& scene);

}  // namespace steradian
