// Reads JSON objects by tables of keys and reports every wrong key by its path. Uses simdjson's DOM.
#pragma once

#include <simdjson.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "steradian/error.h"
#include "steradian/vector.h"

namespace steradian::eval {

using Json = simdjson::dom::element;

// A place in the JSON, as a chain through the callers' frames. It is written out ("light.holes[0][2]") only for a message.
struct Place {
  const Place* up = nullptr;
  std::string_view key;  // or, if empty, an index
  std::size_t index = 0;

  Place in(std::string_view name) const { return {this, name, 0}; }
  Place at(std::size_t i) const { return {this, {}, i}; }
  std::string text() const;
};

// Collects all problems for one message. Readers continue with a default value.
class Problems {
 public:
  void add(const Place& place, const std::string& problem, const std::string& hint = {});
  bool any() const { return !found_.empty(); }
  [[noreturn]] void raise() const;

 private:
  std::vector<Error> found_;
};

// One key of an object that becomes a T.
template <class T>
struct Field {
  std::string_view name;
  void (*read)(Problems&, const Place&, Json, T&);
  bool required = false;
};

// The function of a Field that stores the value in a member of the result. members: from the outermost to the innermost, `result.*a.*b`.
template <auto read, auto... members, class T>
void into(Problems& problems, const Place& place, Json value, T& result) {
  (result.*....*members) = read(problems, place, value);
}

template <class T>
void read_key(Problems& problems, const Place& place, Json value, const Field<T>& field, T& result) {
  field.read(problems, place, value, result);
}

std::string readable(std::string_view key);  // a key from the input, shortened if it is long
std::string quoted(std::string_view name);   // the same in quotes '' for a value
const char* type_name(Json value);
void wrong_type(Problems& problems, const Place& place, const char* expected, Json found);

// Reads the keys of the table. The table consists of Fields or of other rows with a name, `required` and a read_key; `tag` is a key that
// was read before. Unknown, repeated and missing keys are problems.
template <class Row, class T>
void read_fields(Problems& problems, const Place& place, Json value, std::string_view tag, std::span<const Row> fields, T& result) {
  simdjson::dom::object object;
  if (value.get(object) != simdjson::SUCCESS) return wrong_type(problems, place, "an object", value);
  unsigned long long seen = 0;  // a bit per field, the highest for the tag
  constexpr unsigned long long kTagBit = 1ull << 63;
  for (const auto [key, child] : object) {
    std::size_t i = 0;
    while (i < fields.size() && fields[i].name != key) ++i;
    const bool is_tag = !tag.empty() && key == tag;
    if (i == fields.size() && !is_tag) {
      std::string known(tag);
      for (const Row& f : fields) known += (known.empty() ? "" : ", ") + std::string(f.name);
      const std::string name = readable(key);
      problems.add(place.in(name), "unknown key", "known here: " + known);
      continue;
    }
    const unsigned long long bit = is_tag ? kTagBit : 1ull << i;
    if ((seen & bit) != 0)
      problems.add(place.in(key), "the key is given twice");
    else if (!is_tag)
      read_key(problems, place.in(key), child, fields[i], result);
    seen |= bit;
  }
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].required && (seen & (1ull << i)) == 0) problems.add(place.in(fields[i].name), "missing");
}

// The row of `rows` (which have a name) for the string at a key of an object; null, and a problem, for anything else.
template <class Row>
const Row* read_tag(Problems& problems, const Place& place, Json value, std::string_view tag, std::span<const Row> rows) {
  simdjson::dom::object object;
  if (value.get(object) != simdjson::SUCCESS) {
    wrong_type(problems, place, "an object", value);
    return nullptr;
  }
  std::string names;
  for (const Row& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
  Json found;
  if (object.at_key(tag).get(found) != simdjson::SUCCESS) {
    problems.add(place.in(tag), "missing", "one of: " + names);
    return nullptr;
  }
  std::string_view name;
  if (found.get(name) != simdjson::SUCCESS) {
    wrong_type(problems, place.in(tag), "a string", found);
    return nullptr;
  }
  for (const Row& row : rows)
    if (name == row.name) return &row;
  problems.add(place.in(tag), quoted(name) + " is not supported", "supported: " + names);
  return nullptr;
}

double read_number(Problems& problems, const Place& place, Json value);
double read_not_negative(Problems& problems, const Place& place, Json value);
std::int64_t read_integer(Problems& problems, const Place& place, Json value, std::int64_t low, std::int64_t high);
bool read_bool(Problems& problems, const Place& place, Json value);
std::string_view read_string(Problems& problems, const Place& place, Json value);
Vec3d read_vector(Problems& problems, const Place& place, Json value);
Vec3d read_direction(Problems& problems, const Place& place, Json value);  // normalised; zero is a problem
Vec3d read_colour(Problems& problems, const Place& place, Json value);     // a number or [r,g,b], not negative
// Empty if the value is no list; wants: the expected value, for the message.
std::optional<std::vector<Vec3d>> read_points(Problems& problems, const Place& place, const char* wants, Json value);
std::vector<Vec3d> read_contour(Problems& problems, const Place& place, Json value);

}  // namespace steradian::eval
