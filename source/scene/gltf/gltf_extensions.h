// Facts that a glTF file states about its extensions. They are read before everything else.
#pragma once

#include "scene/json_cursor.h"
#include "scene/warnings.h"
#include "steradian/load_scene.h"

namespace steradian::scene {

// Throws Error for an extension that the file requires and that is not supported.
void check_required_extensions(const JsonCursor& root);

// Facts as the file states them. Extensions that it uses and that are not supported go to the warnings.
FileFacts read_file_facts(const JsonCursor& root, Warnings& warnings);

}  // namespace steradian::scene
