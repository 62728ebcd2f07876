// Which method serves the lobes of a scene, and what it leaves to whom.
#pragma once

#include <string>
#include <vector>

#include "render/cpu/monte_carlo.h"
#include "steradian/closed_form.h"
#include "steradian/render.h"

namespace steradian {

// How a specular lobe is integrated without sampling.
enum class LobeMethod {
  none, closed_form, ltc, ltc_compact, ltc_clipless, representative_point,  // ggx
  exact, arvo, lorentzian, pearson, ellipsoid, series,                      // phong
  half_vector                                                               // blinn-phong, beckmann
};

enum class MethodKind { analytic, sampled, reference };

struct Method {
  MethodKind kind = MethodKind::analytic;
  std::string name;                              // as asked for, `auto` resolved: the lobes' methods, joined by '+'
  bool exact_diffuse = true;                     // the diffuse lobe by boundary integrals
  LobeChoice estimated_lobes = LobeChoice::all;  // where kind is not analytic
  Quality quality = Quality::normal;

  // Of each lobe, where kind is analytic.
  LobeMethod ggx = LobeMethod::closed_form;
  LobeMethod phong = LobeMethod::series;
  LobeMethod half_vector = LobeMethod::half_vector;

  bool estimates() const { return kind != MethodKind::analytic; }
};

// Throws UsageError with lobe and material when the method does not serve a lobe of the scene, and for shadows with a
// method that has none.
Method choose_method(const Scene& scene, const RenderOptions& options);

// What the method leaves out of textured lights: a sentence for each lobe and light. Lobes other than GGX and the diffuse
// one take the light's mean.
std::vector<std::string> lobes_under_means(const Scene& scene, const Method& method);

}  // namespace steradian
