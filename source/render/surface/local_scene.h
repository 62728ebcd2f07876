// LocalScene: a scene in coordinates that suit floats, for renderers.
#pragma once

#include <optional>

#include "steradian/scene.h"

namespace steradian {

// A scene far from the origin of its coordinates is moved there, and one that is tiny or huge is scaled by a power of two. Its picture is
// that of the original. Scenes of usual size and place stay as they are.
class LocalScene {
 public:
  // The original must outlive this object.
  explicit LocalScene(const Scene& original);
  const Scene& scene() const { return moved_ ? *moved_ : original_; }

 private:
  const Scene& original_;
  std::optional<Scene> moved_;
};

}  // namespace steradian
