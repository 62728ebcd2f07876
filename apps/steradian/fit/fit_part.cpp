#include "fit/fit_part.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "core/files.h"
#include "core/fingerprint.h"
#include "core/simd.h"
#include "steradian/error.h"
#include "steradian/version.h"

namespace steradian::app {

using namespace fit;
using nlohmann::json;

namespace {

constexpr const char* kPartOfFit = "steradian fit --part";  // the value of the key "file"
constexpr std::size_t kNumbers = sizeof(LtcCell) / sizeof(double);
static_assert(sizeof(LtcCell) == 13 * sizeof(double), "a cell is a list of doubles, as parts store it");

using CellNumbers = std::array<double, kNumbers>;

}  // namespace

std::string fit_settings(const LobeFamily& family, const std::string& samples, const FitOptions& options) {
  Fingerprint contents = 0;
  if (!samples.empty()) {
    Budget budget;
    const Bytes bytes = read_file(samples, samples, budget);
    contents = fingerprint(bytes.data(), bytes.size());
  }
  return fmt::format("steradian {} {} | lobe {} {:016x} | size {} | search {}", version(), name_of(active_simd()), family.name, contents,
                     options.size, options.search == FitSearch::bobyqa ? "bobyqa" : "nelder-mead");
}

void write_fit_part(const FitPart& part, const std::string& path) {
  json columns = json::object();
  for (const auto& [i, column] : part.columns) {
    json& cells = columns[std::to_string(i)] = json::array();
    for (const LtcCell& cell : column) cells.push_back(std::bit_cast<CellNumbers>(cell));
  }
  json file = {{"file", kPartOfFit},
               {"part", fmt::format("{}/{}", part.part.number, part.part.count)},
               {"settings", part.settings},
               {"layout", part.form.layout},
               {"normalisation", part.form.normalisation},
               {"lobe", part.family.name},
               {"frame", part.family.frame == LobeFrame::mirror ? "mirror" : "normal"},
               {"size", part.size},
               {"columns", columns}};
  if (part.family.fixed_roughness) file["fixed_roughness"] = *part.family.fixed_roughness;
  write_file(path, file.dump() + "\n");
}

FitPart read_fit_part(const std::string& path, const Limits& limits) {
  Budget budget(limits);
  const Bytes bytes = read_file(path, path, budget);
  budget.take_memory(path, "the columns of a part", 8 * static_cast<std::uint64_t>(bytes.size()));
  const json file = json::parse(bytes.begin(), bytes.end(), nullptr, false);
  const auto fail = [&](const char* problem) -> Error { return Error(path, problem, "merge the files of fit --part"); };
  if (!file.is_object() || file.value("file", json()) != kPartOfFit) throw fail("is no part of a fit");
  FitPart part;
  try {
    part.part = part_named(file.at("part").get<std::string>());
    part.settings = file.at("settings").get<std::string>();
    part.form.layout = file.at("layout").get<std::string>();
    part.form.normalisation = file.at("normalisation").get<std::string>();
    part.family.name = file.at("lobe").get<std::string>();
    part.family.frame = file.at("frame").get<std::string>() == "mirror" ? LobeFrame::mirror : LobeFrame::normal;
    if (file.contains("fixed_roughness")) part.family.fixed_roughness = file.at("fixed_roughness").get<double>();
    part.size = file.at("size").get<int>();
    // The name becomes part of names in headers.
    const std::string& name = part.family.name;
    if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-") != std::string::npos)
      throw fail("has a lobe whose name has other characters than letters, digits and -");
    if ((part.form.layout != "classic" && part.form.layout != "compact") ||
        (part.form.normalisation != "middle" && part.form.normalisation != "last"))
      throw fail("has an unknown layout");
    if (part.size < 2 || part.size > 1024) throw fail("has a size that is not 2 to 1024");
    FitOptions options;
    options.size = part.size;
    options.part = part.part.number;
    options.parts = part.part.count;
    for (const int i : columns_of_part(part.family, options)) {
      const json& cells = file.at("columns").at(std::to_string(i));
      if (cells.size() != static_cast<std::size_t>(part.size)) throw fail("has a column that is not whole");
      for (const json& cell : cells) part.columns[i].push_back(std::bit_cast<LtcCell>(cell.get<CellNumbers>()));
    }
  } catch (const std::exception& e) {
    if (dynamic_cast<const Error*>(&e) != nullptr) throw;
    throw fail("is a damaged part");
  }
  return part;
}

}  // namespace steradian::app
