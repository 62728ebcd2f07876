// The text file of View3D (its output format 0): areas, view factors and emissivities.
#pragma once

#include <string>

#include "steradian/view_factors.h"

namespace steradian::exchange {

// Writes all n x n view factors with 17 digits, so that View3D's own reader and its users' scripts take them. Every emissivity is 1: the
// factors are those of black surfaces.
void write_view3d_text(const std::string& path, const ViewFactors& factors, const std::string& version);

}  // namespace steradian::exchange
