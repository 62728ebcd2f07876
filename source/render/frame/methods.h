// Choice of the methods for the lobes of a scene, and the lobes that a method leaves to sampling.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrals/methods.h"
#include "render/direct/ltc_tables.h"
#include "render/sampled/monte_carlo.h"
#include "steradian/render.h"

namespace steradian {

enum class MethodKind { analytic, sampled, reference };

struct DirectMethod {
  MethodKind kind = MethodKind::analytic;
  std::string name;                              // as asked for, with `auto` resolved: the lobes' methods, joined by '+'
  bool exact_diffuse = true;                     // the diffuse lobe by boundary integrals
  LobeChoice estimated_lobes = LobeChoice::all;  // used if kind is not analytic
  Quality quality = Quality::normal;
  std::shared_ptr<const ClassicTable> table{};  // a fitted table in the place of GGX; null: GGX

  // Used if kind is analytic.
  Method asked_for = Method::automatic;
  PeakForm peak_form = PeakForm::best;
  double early_stop = 0;
  Method ggx = Method::closed_form;  // one method for all metallic-roughness surfaces and coats: they share a walk on packs

  bool estimates() const { return kind != MethodKind::analytic; }

  RadianceOptions options_for(Method by, Precision precision) const;

  // The method that integrates a lobe of a surface. Sheen has one method, which serves beside every method of GGX.
  const methods::Row& row_for(const Material& lobe) const;
};

// Throws UsageError, naming lobe and material, if the method does not serve a lobe of the scene.
DirectMethod choose_method(const Scene& scene, const RenderOptions& options);

// The tables by which a method integrates layered GGX.
LtcPackTables tables_of(const DirectMethod& method);

// Light that the method omits under textured lights: a sentence for each lobe and light. Lobes other than GGX and the diffuse one use the
// light's mean.
std::vector<std::string> lobes_under_means(const Scene& scene, const DirectMethod& method);

}  // namespace steradian
