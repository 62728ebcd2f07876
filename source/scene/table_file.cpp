#include "scene/table_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/budget.h"
#include "core/files.h"
#include "steradian/error.h"

namespace steradian::scene {
namespace {

constexpr int kLargestSize = 1024;  // the limit of `fit`
constexpr double kLargestValue = 1e6;

std::vector<std::array<float, 4>> read_nodes(const nlohmann::json& table, const char* key, int size, const std::string& path) {
  const auto rows = table.find(key);
  const auto count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  if (rows == table.end() || !rows->is_array() || rows->size() != count)
    throw Error(path, std::string("\"") + key + "\" is no list of " + std::to_string(count) + " nodes");
  std::vector<std::array<float, 4>> result;
  result.reserve(count);
  for (const nlohmann::json& node : *rows) {
    if (!node.is_array() || node.size() != 4) throw Error(path, std::string("\"") + key + "\" has a node that is not 4 numbers");
    std::array<float, 4>& values = result.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      const nlohmann::json& x = node[c];
      const double value = x.is_number() ? x.get<double>() : kLargestValue;
      if (!(std::fabs(value) < kLargestValue)) throw Error(path, std::string("\"") + key + "\" has a value that is no number of a table");
      values[c] = static_cast<float>(value);
    }
  }
  return result;
}

// Divides the matrices whose last element is 1 by their middle one. At the nodes they are the same lobes. Between the nodes, the entries of
// this form are interpolated.
void make_middle_1(ClassicTable& table, const std::string& path) {
  for (std::array<float, 4>& m : table.matrix) {
    m = {m[0] / m[3], m[1] / m[3], m[2] / m[3], 1 / m[3]};
    if (!std::all_of(m.begin(), m.end(), [](float x) { return static_cast<double>(std::fabs(x)) < kLargestValue; }))
      throw Error(path, "\"matrix\" has a node whose middle element is 0");
  }
}

}  // namespace

ClassicTable read_classic_table(const std::string& path) {
  Budget budget(Limits{.memory = 400'000'000, .work = 0});
  const Bytes bytes = read_file(path, path, budget);
  const nlohmann::json table = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
  const char* hint = "write it by steradian fit --layout classic -o FILE.json";
  if (table.is_discarded() || !table.is_object()) throw Error(path, "is no table in JSON", hint);
  const auto layout = table.find("layout"), size = table.find("size");
  if (layout == table.end() || *layout != "classic") throw Error(path, "is no table of the classic layout", hint);
  if (size == table.end() || !size->is_number_integer() || *size < 2 || *size > kLargestSize)
    throw Error(path, "\"size\" is no number from 2 to " + std::to_string(kLargestSize), hint);
  const int n = size->get<int>();
  ClassicTable read = {n, read_nodes(table, "matrix", n, path), read_nodes(table, "magnitude", n, path), ClassicNormalisation::middle};
  const auto one = table.find("normalisation");
  if (one != table.end() && *one == "last")
    make_middle_1(read, path);
  else if (one != table.end() && *one != "middle")
    throw Error(path, "\"normalisation\" is neither \"middle\" nor \"last\"", hint);
  return read;
}

}  // namespace steradian::scene
