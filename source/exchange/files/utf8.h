// Texts as single characters, for arrays whose texts have one length.
#pragma once

#include <string>
#include <vector>

namespace steradian::exchange {

std::vector<char32_t> characters_of(const std::string& utf8);
void append_utf8(std::string& to, char32_t c);

}  // namespace steradian::exchange
