// Changes of lights that a fit has found, put into the document that they belong to.
#pragma once

#include <vector>

#include "document/document.h"
#include "steradian/solve.h"

namespace steradian::view {

// start: the scene of the document. Lights that nodes share get copies; the lights of one material change together. Throws Error for a
// light that the file does not hold in a form that can be changed.
void apply_changes(EditedDocument& document, const Scene& start, const std::vector<LightChange>& changes);

// The same for materials, whose numbers are those of the file.
void apply_changes(EditedDocument& document, const std::vector<MaterialChange>& changes);

}  // namespace steradian::view
