// Tubes in `steradian eval`: capsules, and lines where the radius is 0.
#pragma once

#include "eval/methods.h"
#include "steradian/area_light.h"

namespace steradian::eval {

struct CapsuleLight {
  Capsule shape;
  Vec3d radiance{1, 1, 1};  // of a line, radiance times width
};

// What one lobe sends to the view, by a method of the table.
//
// lambert by `exact` is closed; other methods walk polygons as of other round lights (outline_answer.h). A line, and a
// capsule thinner than 1e-7 of its distance, is for them a strip across the sight: of a half width, seen, of a thousandth
// of the lobe's width (in float 3 %), and its radiance so much the higher. The error is quadratic in that width;
// `reference` doubles it once and holds the difference in its bound.
LobeAnswer capsule_light_answer(const CapsuleLight& light, const ShadingPoint& at, const Material& material,
                                const MethodEntry& entry, const MethodOptions& options);

}  // namespace steradian::eval
