// Parts of pages that need nothing else: numbers and pictures inside of scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace steradian::app {

std::string base64(const std::string& bytes);

// Text that is safe inside a script element.
std::string in_script(const nlohmann::ordered_json& json);

// Replaces the last place of a mark.
void put(std::string& page, const std::string& mark, const std::string& text);

}  // namespace steradian::app
