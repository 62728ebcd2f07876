// Even reflectance: the fraction of even light from all sides that a surface reflects, by which patches pass light on.
#pragma once

#include "render/surface/surface.h"

namespace steradian::radiosity {

// Fractions of even light: by all lobes, and by the GGX lobe of the base.
struct EvenReflectance {
  Vec3f all{}, glossy{};
  Vec3f glossy_share() const;  // of the reflected light
};
EvenReflectance even_reflectance(const Surface& surface);

}  // namespace steradian::radiosity
