// The elements of a scene, in the planes that they share, and the triangles that obstruct between them.
#pragma once

#include "exchange/obstacles/obstacles.h"
#include "steradian/view_factors.h"

namespace steradian::exchange {

// Origins of later queries. With elements alone, triangles that have all elements on one side are dropped.
enum class AskedFrom { elements, points };

struct SceneElements {
  std::vector<PlaneElement> elements;  // by face
  Obstacles obstacles;
};

// Coplanar neighbours get one plane. Files round corners to 32 bits, so that each face alone has another plane; then neighbours would
// exchange radiation, and hide each other. Throws Error that names the face if a face is no plane polygon, or if its outline crosses itself
// and obstruction is on. extra: triangles that obstruct, besides the faces.
SceneElements scene_elements(const std::vector<ViewFactorFace>& faces, const std::vector<ObstacleTriangle>& extra, Obstruction obstruction,
                             AskedFrom from = AskedFrom::elements);

}  // namespace steradian::exchange
