// JsonCursor: a value of a JSON document that knows its place in the file, so that every error message names the place.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "steradian/error.h"
#include "steradian/vector.h"

namespace steradian::scene {

class JsonElements;

class JsonCursor {
 public:
  // place: "scene.gltf" for the root; members append ": key", ".key" and "[i]".
  JsonCursor(const nlohmann::json& value, std::string place) : value_(&value), place_(std::move(place)) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& place() const { return place_; }
  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const { throw Error(place_, problem, hint); }

  // Members. All but `is_object` throw if this is no object or the member has another type than requested.
  bool has(std::string_view key) const { return find(key).has_value(); }
  std::optional<JsonCursor> find(std::string_view key) const;
  JsonCursor at(std::string_view key) const;                    // required
  JsonElements elements(std::string_view key) const;            // none if absent
  double number(std::string_view key, double otherwise) const;  // finite
  double number(std::string_view key, double otherwise, double low, double high) const;
  std::int64_t integer(std::string_view key, std::int64_t otherwise, std::int64_t low, std::int64_t high) const;
  bool flag(std::string_view key, bool otherwise) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  Vec3d vector(std::string_view key, Vec3d otherwise) const;
  // An index of another object; -1 if absent. what: "mesh", for the message.
  int index(std::string_view key, std::size_t count, std::string_view what) const;

  // This value itself.
  JsonElements elements() const;
  double as_number() const;
  std::int64_t as_integer(std::int64_t low, std::int64_t high) const;
  int as_index(std::size_t count, std::string_view what) const;
  std::string as_text() const;
  template <std::size_t N>
  std::array<double, N> as_numbers() const;

 private:
  [[noreturn]] void wrong_type(const char* wanted) const;

  const nlohmann::json* value_;
  std::string place_;
};

// The elements of an array. Each cursor is created on access, because an array may have millions of elements and few are read twice.
class JsonElements {
 public:
  JsonElements() = default;
  JsonElements(const nlohmann::json& array, std::string place) : array_(&array), place_(std::move(place)) {}

  std::size_t size() const { return array_ ? array_->size() : 0; }
  bool empty() const { return size() == 0; }
  JsonCursor operator[](std::size_t i) const { return {(*array_)[i], place_ + "[" + std::to_string(i) + "]"}; }

  class Iterator {
   public:
    Iterator(const JsonElements& elements, std::size_t i) : elements_(&elements), i_(i) {}
    JsonCursor operator*() const { return (*elements_)[i_]; }
    Iterator& operator++() { return ++i_, *this; }
    bool operator!=(const Iterator& other) const { return i_ != other.i_; }

   private:
    const JsonElements* elements_;
    std::size_t i_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  const nlohmann::json* array_ = nullptr;
  std::string place_;
};

template <std::size_t N>
std::array<double, N> JsonCursor::as_numbers() const {
  const JsonElements parts = elements();
  if (parts.size() != N) fail("needs " + std::to_string(N) + " numbers, has " + std::to_string(parts.size()));
  std::array<double, N> result{};
  for (std::size_t i = 0; i < N; ++i) result[i] = parts[i].as_number();
  return result;
}

// The extension `name` of an object, if the object has it.
std::optional<JsonCursor> find_extension(const JsonCursor& object, std::string_view name);

}  // namespace steradian::scene
