// Which method serves the lobes of a scene, and what it leaves to whom.
#pragma once

#include <string>
#include <vector>

#include "integrals/methods.h"
#include "render/cpu/monte_carlo.h"
#include "steradian/render.h"

namespace steradian {

enum class MethodKind { analytic, sampled, reference };

struct DirectMethod {
  MethodKind kind = MethodKind::analytic;
  std::string name;                              // as asked for, `auto` resolved: the lobes' methods, joined by '+'
  bool exact_diffuse = true;                     // the diffuse lobe by boundary integrals
  LobeChoice estimated_lobes = LobeChoice::all;  // where kind is not analytic
  Quality quality = Quality::normal;

  // Where kind is analytic.
  Method asked_for = Method::automatic;
  Method ggx = Method::closed_form;  // of metallic-roughness surfaces and coats, one for all: they share a walk on packs

  bool estimates() const { return kind != MethodKind::analytic; }

  // How a lobe of a surface is integrated. Sheen has one method, which serves beside every method of GGX.
  const methods::Row& row_for(const Material& lobe) const;
};

// Throws UsageError with lobe and material when the method does not serve a lobe of the scene.
DirectMethod choose_method(const Scene& scene, const RenderOptions& options);

// What the method leaves out of textured lights: a sentence for each lobe and light. Lobes other than GGX and the diffuse
// one take the light's mean.
std::vector<std::string> lobes_under_means(const Scene& scene, const DirectMethod& method);

}  // namespace steradian
