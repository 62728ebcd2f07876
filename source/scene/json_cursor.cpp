#include "scene/json_cursor.h"

#include <cmath>

namespace steradian::scene {
namespace {

std::string member_place(const std::string& place, std::string_view key) {
  // The first member follows the file's name; deeper ones follow a member.
  const bool root = place.find(": ") == std::string::npos;
  return place + (root ? ": " : ".") + std::string(key);
}

std::string shown(double x) { return nlohmann::json(x).dump(); }

}  // namespace

void JsonCursor::wrong_type(const char* wanted) const {
  fail(std::string("must be ") + wanted + ", is " +
       (value_->is_number() ? "the number " + value_->dump() : std::string("of type ") + value_->type_name()));
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  if (!value_->is_object()) wrong_type("an object");
  const auto it = value_->find(std::string(key));
  if (it == value_->end()) return {};
  return JsonCursor(*it, member_place(place_, key));
}

JsonCursor JsonCursor::at(std::string_view key) const {
  const auto member = find(key);
  if (!member) fail("\"" + std::string(key) + "\" is missing");
  return *member;
}

JsonElements JsonCursor::elements() const {
  if (!value_->is_array()) wrong_type("an array");
  return {*value_, place_};
}

JsonElements JsonCursor::elements(std::string_view key) const {
  const auto member = find(key);
  return member ? member->elements() : JsonElements{};
}

double JsonCursor::as_number() const {
  if (!value_->is_number()) wrong_type("a number");
  const double x = value_->get<double>();
  if (!std::isfinite(x)) fail("is not a finite number");
  return x;
}

std::int64_t JsonCursor::as_integer(std::int64_t low, std::int64_t high) const {
  const double x = as_number();
  if (x != std::floor(x)) wrong_type("an integer");
  if (x < static_cast<double>(low) || x > static_cast<double>(high))
    fail("is " + value_->dump() + ", must be from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<std::int64_t>(x);
}

int JsonCursor::as_index(std::size_t count, std::string_view what) const {
  const double x = as_number();
  if (x != std::floor(x)) wrong_type("an integer");
  if (x < 0 || x >= static_cast<double>(count))
    fail(std::string(what) + " " + value_->dump() + " does not exist: the file has " + std::to_string(count));
  return static_cast<int>(x);
}

std::string JsonCursor::as_text() const {
  if (!value_->is_string()) wrong_type("a string");
  return value_->get<std::string>();
}

double JsonCursor::number(std::string_view key, double otherwise) const {
  const auto member = find(key);
  return member ? member->as_number() : otherwise;
}

double JsonCursor::number(std::string_view key, double otherwise, double low, double high) const {
  const auto member = find(key);
  if (!member) return otherwise;
  const double x = member->as_number();
  if (x < low || x > high)
    member->fail(
        "is " + shown(x) + ", must be " +
        (high == std::numeric_limits<double>::infinity() ? "at least " + shown(low) : "from " + shown(low) + " to " + shown(high)));
  return x;
}

std::int64_t JsonCursor::integer(std::string_view key, std::int64_t otherwise, std::int64_t low, std::int64_t high) const {
  const auto member = find(key);
  return member ? member->as_integer(low, high) : otherwise;
}

bool JsonCursor::flag(std::string_view key, bool otherwise) const {
  const auto member = find(key);
  if (!member) return otherwise;
  if (!member->value_->is_boolean()) member->wrong_type("true or false");
  return member->value_->get<bool>();
}

std::string JsonCursor::text(std::string_view key, const std::string& otherwise) const {
  const auto member = find(key);
  return member ? member->as_text() : otherwise;
}

Vec3d JsonCursor::vector(std::string_view key, Vec3d otherwise) const {
  const auto member = find(key);
  if (!member) return otherwise;
  const auto v = member->as_numbers<3>();
  return {v[0], v[1], v[2]};
}

int JsonCursor::index(std::string_view key, std::size_t count, std::string_view what) const {
  const auto member = find(key);
  return member ? member->as_index(count, what) : -1;
}

std::optional<JsonCursor> find_extension(const JsonCursor& object, std::string_view name) {
  const auto extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

}  // namespace steradian::scene
