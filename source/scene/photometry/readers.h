// The two file formats of luminaires: https://www.ies.org, ANSI/IES LM-63-19, and EULUMDAT (Stockmar 1990).
#pragma once

#include "scene/photometry/numbers.h"
#include "steradian/light_profile.h"

namespace steradian::scene {

LightProfile read_ies(PhotometryText text);
LightProfile read_eulumdat(PhotometryText text);

// Writes the symmetry of type c out to the whole circle. planes: the angles of the planes that profile.candela holds, rising, in one of the
// ranges [a], [0, 90], [0, 180], [90, 270], (0, up to 360]. False for another range.
bool complete_circle(LightProfile& profile);

}  // namespace steradian::scene
