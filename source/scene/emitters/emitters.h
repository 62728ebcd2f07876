// Emissive meshes as lights, and how exactly points lie on a flat light's face.
#pragma once

#include "core/budget.h"
#include "steradian/area_light.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Faces of flat lights. Points on a light's visible face, which other lights illuminate, lie exactly in the plane that emits.

// The largest distance in float by which a point on a flat light's face may seem to be off its plane; 0 for a round light.
//
// Let c be the largest coordinate of its corners and u = 2^-24. Corners and the point are stored within u c in each of three coordinates.
// Their differences are at most 2 sqrt(3) c long. They are multiplied by a normal that is off by some 4 u and added up within 3 u: 30 u c
// in all. The bound is doubled for triangles whose own normal is less exact. In addition, corners may be off their plane by 1e-5 of the
// light's size (prepare_polygon).
float roundings_of_plane(const AreaLight& light);

// Converts emissive meshes to lights.

// Appends one light for every ball, tube or flat patch of every mesh whose material emits, and sets Mesh::triangle_lights. Returns the
// number of triangles skipped because they have no area. Throws Error where the lights would exceed the budget. path: the file's path, for
// the message.
std::size_t add_emitters(Scene& scene, Budget& budget, const std::string& path);

}  // namespace steradian::scene
