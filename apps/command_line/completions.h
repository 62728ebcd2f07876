// Completions for shells, and the manual page, made of the table of options.
#pragma once

#include <string>

#include "options_table.h"

namespace steradian::app {

std::string bash_completion(const ProgramRow& program);
std::string zsh_completion(const ProgramRow& program);
std::string fish_completion(const ProgramRow& program);
std::string manual_page(const ProgramRow& program);  // for man, section 1

}  // namespace steradian::app
