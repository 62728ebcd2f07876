// Answer: what `steradian eval` says to one query, and the line of JSON that says it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "eval/query.h"
#include "steradian/polygon_derivatives.h"

namespace steradian::eval {

// Of the radiance, a number a channel, by what the light and the lobe are given by. None where the query has it not.
struct ParameterDerivatives {
  std::optional<Vec3d> radiance;   // of the light, in the same channel
  std::optional<Vec3d> f0;         // of one GGX lobe, in the same channel
  std::optional<Vec3d> roughness;  // perceptual, of one isotropic microfacet lobe
};

struct Answer {
  Vec3d radiance;      // finite
  std::string method;  // the resolved one; "exact+reference" where materials of a list resolve differently
  std::optional<double> bound;
  std::optional<double> standard_error;
  Precision precision = Precision::double_;
  std::optional<RadianceDerivatives> derivatives;  // where the query asks
  std::array<Vec3d, 3> by_position{};              // likewise
  std::vector<std::array<Vec3d, 3>> by_occluders;  // likewise, where the query lists them
  ParameterDerivatives parameters;                 // likewise
};

// Throws Error (key and hint) for what the query's method cannot do and for results that are not finite.
Answer evaluate(const Query& query);

// Appends one line. Numbers are the shortest decimals that read back the same; -0 is written as 0.
// id: JSON that becomes the first key; empty for none.
void write_answer(std::string& out, const Answer& answer, std::string_view id = {});
void write_error(std::string& out, std::string_view message, std::string_view id = {});

// A whole step of the stream: reads, evaluates, appends the answer or the error. False for an error.
bool answer_line(QueryReader& reader, std::string_view line, std::string& out);

}  // namespace steradian::eval
