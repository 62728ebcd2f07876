// The two file formats of luminaires: https://www.ies.org, ANSI/IES LM-63-19, and EULUMDAT (Stockmar 1990).
#pragma once

#include <vector>

#include "scene/photometry/numbers.h"
#include "steradian/light_profile.h"

namespace steradian::scene {

LightProfile read_ies(PhotometryText text);
LightProfile read_eulumdat(PhotometryText text);

// Whether rising angles of planes of type c stand for a circle: one alone, 0 to 90, 0 to 180, 0 to more, or 90 to 270 with 180.
bool goes_round(const std::vector<double>& planes);

// Writes the symmetry of type c out to the whole circle. profile.horizontal: the planes that profile.candela holds, which go round.
void complete_circle(LightProfile& profile);

}  // namespace steradian::scene
