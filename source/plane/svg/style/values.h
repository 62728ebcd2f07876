// Values of animated attributes: interpolation and addition.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace steradian::plane::svg {

std::vector<std::string> split_list(std::string_view text, char separator);  // trimmed

// "a + share (b - a)" of two colours, in sRGB, or of two texts that differ in their numbers alone: lengths, points, paths. Empty if the two
// are of different kinds.
std::optional<std::string> value_between(std::string_view a, std::string_view b, double share);

// "a + times b" of such texts.
std::optional<std::string> value_sum(std::string_view a, std::string_view b, double times);

std::string number_text(double x);

}  // namespace steradian::plane::svg
