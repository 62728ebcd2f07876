// Which method serves the lobes of a scene, and what it leaves to whom.
#pragma once

#include <string>

#include "render/cpu/monte_carlo.h"
#include "steradian/render.h"

namespace steradian {

enum class MethodKind { exact, sampled, reference };

struct Method {
  MethodKind kind = MethodKind::exact;
  std::string name;                             // as asked for, `auto` resolved
  bool exact_diffuse = true;                    // the diffuse lobe by boundary integrals
  LobeChoice estimated_lobes = LobeChoice::all; // where kind is not exact

  bool estimates() const { return kind != MethodKind::exact; }
};

// Throws UsageError with lobe and material when the method does not serve a lobe of the scene, and for shadows with a
// method that has none.
Method choose_method(const Scene& scene, const RenderOptions& options);

}  // namespace steradian
