#include "scene/emitters/kept_meshes.h"

namespace steradian {
namespace {

using nlohmann::json;

constexpr const char* kArrays[] = {"meshes", "accessors", "bufferViews", "buffers"};

const json* element(const json& document, const char* array, const json* index) {
  if (index == nullptr || !index->is_number_integer() || index->get<std::int64_t>() < 0) return nullptr;
  const auto found = document.find(array);
  const auto i = index->get<std::size_t>();
  return found != document.end() && found->is_array() && i < found->size() ? &(*found)[i] : nullptr;
}

const json* member(const json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found != object->end() ? &*found : nullptr;
}

// True if an index refers to the same value in both documents.
bool same(const json& a, const json& b, const char* array, const json* index) {
  const json *x = element(a, array, index), *y = element(b, array, index);
  return x != nullptr && y != nullptr && *x == *y;
}

bool same_view(const json& a, const json& b, const json* index) {
  return same(a, b, "bufferViews", index) && same(a, b, "buffers", member(element(a, "bufferViews", index), "buffer"));
}

bool same_accessor(const json& a, const json& b, const json& index) {
  if (!same(a, b, "accessors", &index)) return false;
  const json* accessor = element(a, "accessors", &index);
  if (const json* view = member(accessor, "bufferView"); view != nullptr && !same_view(a, b, view)) return false;
  const json* sparse = member(accessor, "sparse");
  for (const char* part : {"indices", "values"})
    if (sparse != nullptr && !same_view(a, b, member(member(sparse, part), "bufferView"))) return false;
  return true;
}

bool same_accessors(const json& a, const json& b, const json* attributes) {
  if (attributes == nullptr) return true;
  for (const json& index : *attributes)
    if (!same_accessor(a, b, index)) return false;
  return true;
}

}  // namespace

std::shared_ptr<KeptMeshes> make_kept_meshes() { return std::make_shared<KeptMeshes>(); }

bool KeptMeshes::unchanged(const json& now, int mesh, int primitive) const {
  const json m = mesh, p = primitive;
  const auto primitive_of = [&](const json& document) -> const json* {
    const json* primitives = member(element(document, "meshes", &m), "primitives");
    return primitives != nullptr && static_cast<std::size_t>(primitive) < primitives->size()
               ? &(*primitives)[static_cast<std::size_t>(primitive)]
               : nullptr;
  };
  const json *old = primitive_of(before_), *of_now = primitive_of(now);
  if (old == nullptr || of_now == nullptr || *old != *of_now || !same_accessors(before_, now, member(of_now, "attributes"))) return false;
  if (const json* indices = member(of_now, "indices"); indices != nullptr && !same_accessor(before_, now, *indices)) return false;
  if (const json* targets = member(of_now, "targets"))
    for (const json& target : *targets)
      if (!same_accessors(before_, now, &target)) return false;
  return true;
}

void KeptMeshes::begin(const scene::GltfDocument& document) {
  found = 0;
  std::erase_if(kept_, [&](const auto& kept) { return !unchanged(document.json, kept.second.source.mesh, kept.first.second); });
  for (const char* array : kArrays) {
    const auto now = document.json.find(array);
    if (now == document.json.end())
      before_.erase(array);
    else if (before_[array] != *now)
      before_[array] = *now;
  }
}

const Mesh* KeptMeshes::find(int node, int primitive, const Source& source) const {
  const auto kept = kept_.find({node, primitive});
  return kept != kept_.end() && kept->second.source == source ? &kept->second.mesh : nullptr;
}

void KeptMeshes::keep(int node, int primitive, Source source, const Mesh& mesh) {
  kept_.insert_or_assign({node, primitive}, Kept{std::move(source), mesh});
}

}  // namespace steradian
