// Queries of `eval` for the view factor from one polygon to another, behind obstacles.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace steradian::eval {

// Answers a line that has the key "from": {"from": polygon, "to": polygon, "obstacles": [polygon, ...], "eps": 1e-8}. Appends one line with
// the factor, the exchange area and the bounds of their errors, or an error. None: the line is another query, and nothing is appended.
//
//   line     with kQueryPadding readable bytes behind its end
//   returns  true if it was answered without an error
std::optional<bool> answer_exchange(std::string_view line, std::string& out);

}  // namespace steradian::eval
