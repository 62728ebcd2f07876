// The names of pictures that can be written, to be judged before the work.
#pragma once

#include <string>

namespace steradian::image {

// Throws the Error that write_picture would give for the ending of this name.
void check_picture_name(const std::string& path);

}  // namespace steradian::image
