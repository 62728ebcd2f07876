// Selection of the method, quality and arithmetic of an integral. `steradian eval --help` and docs/methods.md describe each method and the
// lobes that it serves.
#pragma once

#include <optional>
#include <string_view>

namespace steradian {

// `automatic` ("auto") is the most accurate real-time method that serves the lobe.
enum class Method {
  automatic,
  series,
  exact,
  arvo,
  lorentzian,
  pearson,
  ellipsoid,  // Phong; exact: others as well
  closed_form,
  ltc,
  ltc_compact,
  ltc_clipless,
  representative_point,  // GGX
  half_vector,           // Blinn-Phong, Beckmann, GGX
  matched_lobe,          // products of Phong lobes
  cubature,              // Charlie
  reference,
  sampled  // every lobe
};

// Amount of work that a method puts into its approximation; methods without such a choice ignore it.
//
// series, matched-lobe   draft, normal: three harmonics; high: five
// closed-form  averaging of the smooth factor, shadowing times Fresnel, over the light, the distribution's integral being
//              exact at every quality. draft: at one direction; normal: up to 33 nodes on a quad; high: up to 49
// half-vector  arcs of an edge: 3, 4, 8
// auto         draft: the compact table for isotropic GGX
enum class Quality { draft, normal, high };

enum class Precision { double_, float_ };

// "auto", "series", "closed-form", ...: the names of the command line, of JSON and of messages.
const char* name_of(Method method);
std::optional<Method> method_of(std::string_view name);

// The peak fits' f in their integrand (f - x^m)/(1 - x^2): docs/theory/moments.md, "The published fits".
enum class PeakForm {
  best,       // the one that is closer, for each fit
  one,        // f = 1
  x,          // f = x
  by_parity,  // f = x for even n, 1 for all others: as published, and not continuous in n
};

}  // namespace steradian
