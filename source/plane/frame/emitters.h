// Emitters of a frame: those of lights, and walls that reflect.
#pragma once

#include <optional>
#include <vector>

#include "plane/bounce/bounces.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// Emitters of a light: whole disks, sides of edges, arcs of ellipses.

// Emitters of a light, each with a radiance that is linear in the place on it, and the runs of its edges (runs.h). Empty for ellipses so
// thin that packs would lose them in rounding.
std::optional<std::vector<Emitter>> emitters_of(const World& world, std::size_t body);

bool is_round(const PlaneEllipse& e);
double stretch_of(const PlaneEllipse& e);  // the longer half axis divided by the other
bool is_full_circle(const Curve& c);

// Walls that reflect light (plane/bounce) as emitters of a frame.

enum class WallLight { radiance, error };

// Emitters of all elements, with edges in the runs of their walls.
std::vector<Emitter> wall_emitters(const PlaneBounces::Impl& bounces, WallLight what);

}  // namespace steradian::plane
