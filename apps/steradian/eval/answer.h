// Answer: the answer of `steradian eval` to one query, and its line of JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/derivatives.h"
#include "eval/query.h"

namespace steradian::eval {

struct Answer {
  Vec3d radiance;      // finite
  std::string method;  // the resolved one; "exact+reference" if materials of a list resolve differently
  std::optional<double> bound;
  std::optional<double> standard_error;
  Precision precision = Precision::double_;
  std::vector<Derivative> derivatives;  // if the query asks for them
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
