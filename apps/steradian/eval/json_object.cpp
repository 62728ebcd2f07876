#include "eval/json_object.h"

namespace steradian::eval {
namespace {

constexpr std::size_t kMostProblems = 20;  // without unknown keys, which are all named
constexpr std::size_t kLongestKey = 80;

}  // namespace

std::string Place::text() const {
  if (up == nullptr) return {};
  std::string result = up->text();
  if (key.empty()) return result + "[" + std::to_string(index) + "]";
  return result + (result.empty() ? "" : ".") + std::string(key);
}

void Problems::add(const Place& place, const std::string& problem, const std::string& hint) {
  if (found_.size() >= kMostProblems && problem != "unknown key") return;
  found_.emplace_back(place.text(), problem, hint);
}

void Problems::raise() const {
  if (found_.size() == 1) throw found_.front();
  std::string all;
  for (const Error& one : found_) all += (all.empty() ? "" : "; ") + std::string(one.what());
  throw Error("", all);
}

std::string readable(std::string_view key) {
  if (key.empty()) return "\"\"";
  if (key.size() <= kLongestKey) return std::string(key);
  std::size_t end = kLongestKey;
  while (end > 0 && (static_cast<unsigned char>(key[end]) & 0xc0) == 0x80) --end;  // never cuts within a character
  return std::string(key.substr(0, end)) + "...";
}

std::string quoted(std::string_view name) {
  std::string result(1, '\'');
  result += name.empty() ? std::string() : readable(name);
  result += '\'';
  return result;
}

const char* type_name(Json value) {
  switch (value.type()) {
    case simdjson::dom::element_type::ARRAY: return "a list";
    case simdjson::dom::element_type::OBJECT: return "an object";
    case simdjson::dom::element_type::STRING: return "a string";
    case simdjson::dom::element_type::BOOL: return "a truth value";
    case simdjson::dom::element_type::NULL_VALUE: return "null";
    default: return "a number";
  }
}

void wrong_type(Problems& problems, const Place& place, const char* expected, Json found) {
  problems.add(place, std::string("expected ") + expected + ", found " + type_name(found));
}

template <class T>
static T read_as(Problems& problems, const Place& place, const char* expected, Json value) {
  T x{};
  if (value.get(x) != simdjson::SUCCESS) wrong_type(problems, place, expected, value);
  return x;
}

double read_number(Problems& problems, const Place& place, Json value) {
  const auto x = read_as<double>(problems, place, "a number", value);
  if (!std::isfinite(x)) problems.add(place, "the number is not finite");
  return x;
}

double read_not_negative(Problems& problems, const Place& place, Json value) {
  const double x = read_number(problems, place, value);
  if (x < 0) problems.add(place, "must not be negative");
  return x;
}

std::int64_t read_integer(Problems& problems, const Place& place, Json value, std::int64_t low, std::int64_t high) {
  std::int64_t x = 0;
  if (value.get(x) != simdjson::SUCCESS) {
    wrong_type(problems, place, "an integer", value);
    return low;
  }
  if (x < low || x > high) problems.add(place, "must be an integer from " + std::to_string(low) + " to " + std::to_string(high));
  return x;
}

bool read_bool(Problems& problems, const Place& place, Json value) { return read_as<bool>(problems, place, "true or false", value); }

std::string_view read_string(Problems& problems, const Place& place, Json value) {
  return read_as<std::string_view>(problems, place, "a string", value);
}

Vec3d read_vector(Problems& problems, const Place& place, Json value) {
  simdjson::dom::array array;
  if (value.get(array) != simdjson::SUCCESS) {
    wrong_type(problems, place, "a list of 3 numbers", value);
    return {};
  }
  double v[3] = {0, 0, 0};
  std::size_t n = 0;
  for (const Json x : array) {
    if (n < 3) v[n] = read_number(problems, place.at(n), x);
    ++n;
  }
  if (n != 3) problems.add(place, "expected 3 numbers, found " + std::to_string(n));
  return {v[0], v[1], v[2]};
}

Vec3d read_direction(Problems& problems, const Place& place, Json value) {
  const bool clean = !problems.any();
  const Vec3d v = read_vector(problems, place, value);
  if (v == Vec3d{} && (clean != problems.any())) problems.add(place, "the vector is zero", "it needs a direction");
  return normalized(v);
}

Vec3d read_colour(Problems& problems, const Place& place, Json value) {
  if (value.is_array()) {
    const Vec3d c = read_vector(problems, place, value);
    if (c.x < 0 || c.y < 0 || c.z < 0) problems.add(place, "must not be negative");
    return c;
  }
  if (!value.is_number()) {
    wrong_type(problems, place, "a number or [r,g,b]", value);
    return {};
  }
  const double x = read_not_negative(problems, place, value);
  return {x, x, x};
}

std::optional<std::vector<Vec3d>> read_points(Problems& problems, const Place& place, const char* wants, Json value) {
  simdjson::dom::array array;
  if (value.get(array) != simdjson::SUCCESS) {
    wrong_type(problems, place, wants, value);
    return {};
  }
  std::vector<Vec3d> points;
  for (const Json point : array) points.push_back(read_vector(problems, place.at(points.size()), point));
  return points;
}

std::vector<Vec3d> read_contour(Problems& problems, const Place& place, Json value) {
  const auto contour = read_points(problems, place, "a list of vertices", value);
  if (contour && contour->size() < 3)
    problems.add(place, "a polygon needs at least 3 vertices, here are " + std::to_string(contour->size()));
  return contour.value_or(std::vector<Vec3d>{});
}

}  // namespace steradian::eval
