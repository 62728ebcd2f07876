// VS3: the input files of View3D, with vertices and surfaces (F 3).
#pragma once

#include <string>

#include "exchange/files/scene_faces.h"

namespace steradian::exchange {

bool is_vs3_file(const std::string& path);

// Surfaces (S), subsurfaces and null surfaces (N: holes in their base), masks (M), obstructions (O). Combined surfaces are groups by node;
// with masks, faces are groups, too. Throws Error with the line for anything else: the form F 3a, surfaces that name missing vertices.
SceneFaces read_vs3(const std::string& path, const FaceOptions& options, Budget& budget);

}  // namespace steradian::exchange
