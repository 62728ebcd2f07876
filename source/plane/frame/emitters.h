// A light taken apart into emitters: whole disks, sides of edges, arcs of ellipses.
#pragma once

#include <optional>
#include <vector>

#include "plane/frame/scene.h"

namespace steradian::plane {

// Emitters of a light, each with a radiance that is linear in the place on it, and the runs of its edges (runs.h). Nothing for ellipses so
// thin that packs would lose them in rounding.
std::optional<std::vector<Emitter>> emitters_of(const World& world, std::size_t body);

bool is_round(const Ellipse& e);
double stretch_of(const Ellipse& e);  // the longer half axis over the other
bool is_full_circle(const Curve& c);

}  // namespace steradian::plane
