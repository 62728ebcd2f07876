#include "viewfactor/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "core/files.h"
#include "page_text.h"
#include "steradian/version.h"
#include "viewfactor/page.h"

namespace steradian::app {

using namespace exchange;

namespace {

using Json = nlohmann::ordered_json;

// An entry takes some 20 bytes of the page. Beyond 6 MB of them it shows no factors of single faces.
constexpr std::uint64_t kPageEntries = 300'000;

Json report_json(const std::string& scene, const StoredRun& stored, const std::vector<std::string>& warnings, double seconds) {
  const ViewFactors& f = stored.factors;
  const GuaranteeCounts g = guarantees_of(stored);
  const auto verdict = [](std::size_t count) { return count == 0 ? "pass" : "fail"; };
  Json sky = Json::array();
  for (const double sum : f.row_sums) sky.push_back(std::max(1 - sum, 0.0));
  return {{"version", version()},
          {"command", command_line()},
          {"scene", scene},
          {"faces", stored.faces.size()},
          {"rows", f.size()},
          {"entries", f.entries()},
          {"eps", stored.run.eps},
          {"left_out_below", stored.run.smallest},
          {"obstruction", stored.run.obstruction},
          {"seconds", seconds},
          {"guarantees",
           {{"factors from 0 to 1", verdict(g.outside)},
            {"row sums at most 1 + error", stored.run.obstruction ? verdict(g.overfull) : "not promised without obstruction"}}},
          {"warnings", warnings},
          {"worst_row_error", g.worst_error},
          {"row_sums", f.row_sums},
          {"row_errors", f.row_errors},
          {"areas", f.areas},
          {"sky", sky},
          {"names", f.names}};
}

// Five digits are enough for a picture, and make the page small.
double short_number(double x) { return std::stod(fmt::format("{:.5g}", x)); }

// The faces' contours, the row of each face, and the factors of each row to the columns before it.
Json picture_of(const StoredRun& stored) {
  const ViewFactors& f = stored.factors;
  Json faces = Json::array();
  for (const ViewFactorFace& face : stored.faces) {
    Json loops = Json::array();
    const auto add = [&](const std::vector<Vec3d>& loop) {
      Json numbers = Json::array();
      for (const Vec3d& v : loop)
        for (const double x : {v.x, v.y, v.z}) numbers.push_back(short_number(x));
      loops.push_back(std::move(numbers));
    };
    add(face.outline);
    for (const std::vector<Vec3d>& hole : face.holes) add(hole);
    faces.push_back(std::move(loops));
  }
  Json exchanges = Json::array();
  const bool has_factors = f.entries() <= kPageEntries;
  for (const ExchangeBlock& b : f.blocks)
    for (std::size_t r = 0; has_factors && r < b.rows(); ++r)
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k)
        exchanges.push_back({b.first_row + r, b.columns[k], short_number(b.values[k])});
  return {{"faces", faces}, {"rows", stored.run.groups}, {"has_factors", has_factors}, {"exchanges", exchanges}, {"own", f.own}};
}

}  // namespace

GuaranteeCounts guarantees_of(const StoredRun& stored) {
  const ViewFactors& f = stored.factors;
  GuaranteeCounts counts;
  for (const ExchangeBlock& b : f.blocks)
    for (std::size_t r = 0; r < b.rows(); ++r)
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) {
        const double least = std::min(f.areas[b.first_row + r], f.areas[b.columns[k]]);
        counts.outside += !(b.values[k] >= 0 && b.values[k] <= least);
      }
  for (std::size_t i = 0; i < f.size(); ++i) {
    // Faces that hide each other may add up to more than 1 without obstruction.
    counts.overfull += stored.run.obstruction && f.row_sums[i] > 1 + f.row_errors[i] + kRowRounding;
    counts.worst_error = std::max(counts.worst_error, f.row_errors[i]);
    counts.largest_sum = std::max(counts.largest_sum, f.row_sums[i]);
    counts.smallest_sum = std::min(counts.smallest_sum, f.row_sums[i]);
  }
  return counts;
}

void write_report(const std::string& path, const std::string& scene, const StoredRun& stored, const std::vector<std::string>& warnings,
                  double seconds) {
  const Json report = report_json(scene, stored, warnings, seconds);
  if (!path.ends_with(".html")) return write_file(path, report.dump(1) + "\n");
  std::string page = kViewFactorPage;
  put(page, "@PICTURE@", in_script(picture_of(stored)));
  put(page, "@DATA@", in_script(report));
  write_file(path, page);
}

}  // namespace steradian::app
