// What a glTF file says about its extensions, before anything else of it is read.
#pragma once

#include "scene/json_cursor.h"
#include "scene/warnings.h"
#include "steradian/load_scene.h"

namespace steradian::scene {

// Throws Error for an extension that the file requires and that is not supported.
void check_required_extensions(const JsonCursor& root);

// The file's own words; what it uses and is not supported goes to the warnings.
FileFacts read_file_facts(const JsonCursor& root, Warnings& warnings);

}  // namespace steradian::scene
