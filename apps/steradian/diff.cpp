// steradian diff A B: the difference of two pictures in numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/codecs.h"
#include "steradian/compare.h"
#include "steradian/error.h"
#include "verbs.h"

namespace steradian::app {
namespace {

struct DiffArguments {
  std::string a, b;
  bool json = false;
  std::vector<std::string> fail_above, covered_by;
  Limits limits;
};

struct Limit {
  std::string metric;
  double value;
};

Limit parse_limit(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string metric = text.substr(0, equals);
  if (equals != std::string::npos && (metric == "rmse" || metric == "relative_l2" || metric == "max")) {
    std::size_t used = 0;
    try {
      const double value = std::stod(text.substr(equals + 1), &used);
      if (used == text.size() - equals - 1 && !std::isnan(value)) return {metric, value};
    } catch (const std::exception&) {  // continues with the message below
    }
  }
  throw WrongOption("--fail-above", "'" + text + "' is not METRIC=VALUE with rmse, relative_l2 or max");
}

// The largest difference of alpha, if both pictures have it.
std::optional<double> largest_of_alpha(const Picture& a, const Picture& b) {
  const auto of_a = a.layers.find("alpha"), of_b = b.layers.find("alpha");
  if (of_a == a.layers.end() || of_b == b.layers.end()) return {};
  double largest = 0;
  for (std::size_t i = 0; i < of_a->second.size(); ++i)
    largest = std::max(largest, std::fabs(static_cast<double>(of_a->second[i].x) - static_cast<double>(of_b->second[i].x)));
  return largest;
}

// Reports the layers that are not compared. Only pixels and alpha are compared.
void say_what_is_left_out(const std::string& path, const Picture& picture, bool with_alpha) {
  std::vector<std::string> names = picture.unread;
  for (const auto& [layer, pixels] : picture.layers)
    if (!with_alpha || layer != "alpha") names.push_back("layer " + layer);
  if (!names.empty()) fmt::print(stderr, "warning: {}: not compared: {}\n", path, fmt::join(names, ", "));
}

void run(const DiffArguments& options, Exit& exit) {
  std::vector<Limit> limits;
  for (const std::string& text : options.fail_above) limits.push_back(parse_limit(text));
  const Picture reference = read_picture(options.b, options.limits);
  const Picture picture = read_picture(options.a, options.limits);
  const Difference d = difference(picture, reference);
  std::optional<Coverage> covered;
  if (!options.covered_by.empty()) covered = coverage(picture, reference, options.covered_by);
  const std::optional<double> alpha = largest_of_alpha(picture, reference);
  say_what_is_left_out(options.a, picture, alpha.has_value());
  say_what_is_left_out(options.b, reference, alpha.has_value());
  const double white = white_of(reference);
  if (options.json) {
    nlohmann::ordered_json j = {
        {"rmse", d.rmse}, {"relative_l2", d.relative_l2}, {"max", d.max}, {"mean_ratio", d.mean_ratio}, {"white", white}};
    if (alpha) j["alpha_max"] = *alpha;
    if (covered) j["covered"] = covered->fraction, j["worst_of_errors"] = covered->worst;
    fmt::print("{}\n", j.dump());
  } else {
    fmt::print("rmse         {:.6g}\nrelative L2  {:.6g}\nmax          {:.6g} at ({}, {})\nmean ratio   {:.6g}\nwhite        {:.6g}\n",
               d.rmse, d.relative_l2, d.max, d.max_x, d.max_y, d.mean_ratio, white);
    if (alpha) fmt::print("alpha max    {:.6g}\n", *alpha);
    if (covered)
      fmt::print("covered      {:.6g} of the pixels; worst {:.4g} times its error at ({}, {})\n", covered->fraction, covered->worst,
                 covered->worst_x, covered->worst_y);
  }
  for (const Limit& limit : limits) {
    const double value = limit.metric == "rmse" ? d.rmse : limit.metric == "max" ? d.max : d.relative_l2;
    if (value <= limit.value) continue;
    fmt::print(stderr, "steradian: {} is {:.6g}, above {:.6g}\n", limit.metric, value, limit.value);
    exit.code = 1;
  }
}

}  // namespace

void add_diff(CommandLine& line) {
  auto options = std::make_shared<DiffArguments>();
  Verb verb = line.verb("diff", "Print the difference of two pictures (EXR, PNG, JPEG)");
  verb.group("Pictures");
  verb.add("A", options->a, "picture").required();
  verb.add("B", options->b, "reference picture").required();
  verb.add_flag("--json", options->json, "print JSON");
  verb.add("--fail-above", options->fail_above, "METRIC=VALUE of rmse, relative_l2, max: exit 1 above it");
  verb.add("--covered-by", options->covered_by, "print the fraction of pixels within error layers of A: LAYER,LAYER").separator(',');
  verb.add_limits(options->limits);
  verb.callback([options, &exit = line.exit()] { run(*options, exit); });
}

}  // namespace steradian::app
