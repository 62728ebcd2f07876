// The two file formats of luminaires: https://www.ies.org, ANSI/IES LM-63-19, and EULUMDAT (Stockmar 1990).
#pragma once

#include <vector>

#include "scene/photometry/numbers.h"
#include "steradian/light_profile.h"

namespace steradian::scene {

LightProfile read_ies(PhotometryText text);
LightProfile read_eulumdat(PhotometryText text);

// True if rising angles of planes of type c cover a circle: one alone, 0 to 90, 0 to 180, 0 to more, or 90 to 270 with 180.
bool goes_round(const std::vector<double>& planes);

// Expands the symmetry of type c to the whole circle. profile.horizontal: the planes that profile.candela holds; goes_round must be true
// for them.
void complete_circle(LightProfile& profile);

}  // namespace steradian::scene
