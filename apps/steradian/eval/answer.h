// Answer: the answer of `steradian eval` to one query, and its line of JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "eval/query.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::eval {

// Derivatives of the radiance, one number per channel, by the parameters of the light and the lobe. A derivative is empty if the query
// lacks the parameter.
struct ParameterDerivatives {
  std::optional<Vec3d> radiance;   // by the light's radiance in the same channel
  std::optional<Vec3d> f0;         // by F0 of one GGX lobe, in the same channel
  std::optional<Vec3d> roughness;  // by the perceptual roughness of one isotropic microfacet lobe
};

struct Answer {
  Vec3d radiance;      // finite
  std::string method;  // the resolved one; "exact+reference" if materials of a list resolve differently
  std::optional<double> bound;
  std::optional<double> standard_error;
  Precision precision = Precision::double_;
  std::optional<RadianceDerivatives> derivatives;  // if the query asks for them
  std::array<Vec3d, 3> by_position{};              // likewise
  std::vector<std::array<Vec3d, 3>> by_occluders;  // likewise, if the query lists them
  ParameterDerivatives parameters;                 // likewise
};

// Throws Error (key and hint) if the query's method does not support the query, and for results that are not finite.
Answer evaluate(const Query& query);

// Appends one line. Numbers are the shortest decimals that read back the same; -0 is written as 0. id: JSON that becomes the first key;
// empty for none.
void write_answer(std::string& out, const Answer& answer, std::string_view id = {});
void write_error(std::string& out, std::string_view message, std::string_view id = {});

// One step of the stream: reads, evaluates, appends the answer or the error. False for an error.
bool answer_line(QueryReader& reader, std::string_view line, std::string& out);

}  // namespace steradian::eval
