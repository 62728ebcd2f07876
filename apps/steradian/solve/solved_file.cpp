#include "solve/solved_file.h"

#include "document/light_changes.h"

namespace steradian::app {

void write_solved(const std::string& input, const Scene& start, const Solution& found, const std::string& output) {
  view::EditedDocument document(scene::read_gltf_file(input));
  view::apply_changes(document, start, found.changes);
  view::apply_changes(document, found.material_changes);
  scene::write_gltf_file(document.file(), output);
}

}  // namespace steradian::app
