#include "document/document.h"

#include "steradian/error.h"

namespace steradian::view {
namespace {

using Pointer = Json::json_pointer;

// The highest of a pointer's parents that is missing in the document, or the pointer itself.
Pointer first_missing(const Json& json, const Pointer& pointer) {
  Pointer at = pointer;
  while (!at.parent_pointer().empty() && !json.contains(at.parent_pointer())) at = at.parent_pointer();
  return at;
}

}  // namespace

const Json* EditedDocument::find(const std::string& pointer) const {
  const Pointer at(pointer);
  return file_.json.contains(at) ? &file_.json.at(at) : nullptr;
}

double EditedDocument::number(const std::string& pointer, double otherwise) const {
  const Json* found = find(pointer);
  return found != nullptr && found->is_number() ? found->get<double>() : otherwise;
}

int EditedDocument::index(const std::string& pointer) const {
  const Json* found = find(pointer);
  return found != nullptr && found->is_number_integer() ? found->get<int>() : -1;
}

std::string EditedDocument::text(const std::string& pointer, const std::string& otherwise) const {
  const Json* found = find(pointer);
  return found != nullptr && found->is_string() ? found->get<std::string>() : otherwise;
}

bool EditedDocument::flag(const std::string& pointer) const {
  const Json* found = find(pointer);
  return found != nullptr && found->is_boolean() && found->get<bool>();
}

std::vector<double> EditedDocument::numbers(const std::string& pointer, std::size_t count) const {
  const Json* found = find(pointer);
  std::vector<double> result;
  if (found == nullptr || !found->is_array() || found->size() != count) return result;
  for (const Json& element : *found) {
    if (!element.is_number()) return {};
    result.push_back(element.get<double>());
  }
  return result;
}

std::size_t EditedDocument::count(const std::string& array) const {
  const Json* found = find(array);
  return found != nullptr && found->is_array() ? found->size() : 0;
}

void EditedDocument::set(const std::string& pointer, Json value) {
  const Pointer target(pointer), top = first_missing(file_.json, target);
  // Missing parents become objects, or arrays if the key is the first element of an array.
  Pointer at = target;
  while (at != top) {
    const std::string key = at.back();
    Json around = key == "0" ? Json::array() : Json::object();
    if (key == "0")
      around.push_back(std::move(value));
    else
      around[key] = std::move(value);
    value = std::move(around);
    at = at.parent_pointer();
  }
  record(top.to_string(), std::move(value));
}

void EditedDocument::erase(const std::string& pointer) {
  if (find(pointer) != nullptr) record(pointer, std::nullopt);
}

void EditedDocument::record(const std::string& where, std::optional<Json> after) {
  const Json* now = find(where);
  std::optional<Json> before = now != nullptr ? std::optional<Json>(*now) : std::nullopt;
  if (before == after) return;
  put(where, after);
  redone_from_.clear();
  // A drag changes the same few values repeatedly. Each value is stored once, unless its container was changed since.
  for (std::size_t i = open_.size(); i-- > 0;) {
    Change& change = open_[i];
    if (change.where == where) {
      change.after = std::move(after);
      return;
    }
    if (change.where.starts_with(where) || where.starts_with(change.where)) break;
  }
  open_.push_back({where, std::move(before), std::move(after)});
}

void EditedDocument::put(const std::string& where, const std::optional<Json>& value) {
  const Pointer at(where);
  Json& parent = at.parent_pointer().empty() ? file_.json : file_.json.at(at.parent_pointer());
  if (parent.is_array()) {
    const std::size_t index = std::stoul(at.back());
    if (!value && index + 1 == parent.size())
      parent.erase(index);
    else if (value && index == parent.size())
      parent.push_back(*value);
    else if (value && index < parent.size())
      parent[index] = *value;
    else
      throw Error(file_.path + ": " + where, "is no element of the array, and not the next one");
  } else if (value) {
    parent[at.back()] = *value;
  } else {
    parent.erase(at.back());
  }
  ++revision_;
}

void EditedDocument::close_step() {
  if (open_.empty()) return;
  undone_from_.push_back(std::move(open_));
  open_.clear();
}

void EditedDocument::undo() {
  close_step();
  if (undone_from_.empty()) return;
  Step step = std::move(undone_from_.back());
  undone_from_.pop_back();
  for (std::size_t i = step.size(); i-- > 0;) put(step[i].where, step[i].before);
  redone_from_.push_back(std::move(step));
}

void EditedDocument::redo() {
  if (redone_from_.empty()) return;
  close_step();
  Step step = std::move(redone_from_.back());
  redone_from_.pop_back();
  for (const Change& change : step) put(change.where, change.after);
  undone_from_.push_back(std::move(step));
}

}  // namespace steradian::view
