// Changes of lights that a fit has found, put into the document that they belong to.
#pragma once

#include <vector>

#include "document/document.h"
#include "steradian/solve.h"

namespace steradian::view {

// start: the scene of the document. Lights that nodes share get copies; the lights of one material change together. Throws Error for a
// light that the file does not hold in a form that can be changed.
void apply_changes(EditedDocument& document, const Scene& start, const std::vector<LightChange>& changes);

// The file's material of a light of an emissive mesh; -1 for other lights.
int material_of_light(const Scene& scene, std::size_t light);
// All lights of an emissive material. They shine alike.
std::vector<std::size_t> lights_of_material(const Scene& scene, int material);

}  // namespace steradian::view
