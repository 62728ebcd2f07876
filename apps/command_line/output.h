// Outputs of verbs, judged before the work: a folder that is missing or cannot be written gives its error at once.
#pragma once

#include <string>

namespace steradian::app {

enum class Writes { file, picture, folder };

// Throws the Error that writing would give. An empty path and "-" are standard output. The #s of numbered pictures may be in the name of
// the file; a folder with # is left to frames_to_make.
void check_output(const std::string& path, Writes kind);

}  // namespace steradian::app
