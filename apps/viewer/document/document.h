// Document: the JSON of a glTF file with its history. Every change of a scene is a change of its file. So the saved file equals the
// displayed scene, and untouched values stay as they were.
//
// A change is a value put at a JSON pointer. Changes between two calls of close_step are one step of undo: a drag is one step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/gltf_file.h"

namespace steradian::view {

using scene::Json;

class EditedDocument {
 public:
  explicit EditedDocument(scene::GltfFile file) : file_(std::move(file)) {}

  const scene::GltfFile& file() const { return file_; }
  const Json& json() const { return file_.json; }
  const Json* find(const std::string& pointer) const;  // null if there is no value
  // The value, or `otherwise` if there is no value or one of another type: a file may contain anything.
  double number(const std::string& pointer, double otherwise) const;
  int index(const std::string& pointer) const;  // -1
  std::string text(const std::string& pointer, const std::string& otherwise) const;
  bool flag(const std::string& pointer) const;
  std::vector<double> numbers(const std::string& pointer, std::size_t count) const;  // `count` numbers, or empty

  // Puts a value, and creates the missing parent objects. An array's next index appends.
  void set(const std::string& pointer, Json value);
  // Removes a member of an object, or the last element of an array. Does nothing if it does not exist.
  void erase(const std::string& pointer);
  std::size_t count(const std::string& array) const;  // 0 if absent

  void close_step();
  bool can_undo() const { return !open_.empty() || !undone_from_.empty(); }
  bool can_redo() const { return !redone_from_.empty(); }
  void undo();
  void redo();

  std::uint64_t revision() const { return revision_; }  // rises with every change
  bool saved() const { return revision_ == saved_; }
  void mark_saved() { saved_ = revision_; }

 private:
  struct Change {
    std::string where;
    std::optional<Json> before, after;
  };
  using Step = std::vector<Change>;

  void record(const std::string& where, std::optional<Json> after);
  void put(const std::string& where, const std::optional<Json>& value);

  scene::GltfFile file_;
  Step open_;
  std::vector<Step> undone_from_, redone_from_;
  std::uint64_t revision_ = 1, saved_ = 1;
};

}  // namespace steradian::view
