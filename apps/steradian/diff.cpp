// steradian diff A B: the difference of two pictures in numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/read_picture.h"
#include "steradian/compare.h"
#include "steradian/error.h"
#include "verbs.h"

namespace steradian::app {
namespace {

struct Options {
  std::string a, b;
  bool json = false;
  std::vector<std::string> fail_above;
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
    } catch (const std::exception&) {  // falls through to the message
    }
  }
  throw CLI::ValidationError("--fail-above", "'" + text + "' is not METRIC=VALUE with rmse, relative_l2 or max");
}

// The pictures alone are compared, not what else their files hold.
void say_what_is_left_out(const std::string& path, const Picture& picture) {
  std::vector<std::string> names = picture.unread;
  for (const auto& [layer, pixels] : picture.layers) names.push_back("layer " + layer);
  if (!names.empty()) fmt::print(stderr, "warning: {}: not compared: {}\n", path, fmt::join(names, ", "));
}

void run(const Options& options, Exit& exit) {
  std::vector<Limit> limits;
  for (const std::string& text : options.fail_above) limits.push_back(parse_limit(text));
  const Picture reference = read_picture(options.b, options.limits);
  const Picture picture = read_picture(options.a, options.limits);
  say_what_is_left_out(options.a, picture);
  say_what_is_left_out(options.b, reference);
  const Difference d = difference(picture, reference);
  const double white = white_of(reference);
  if (options.json) {
    nlohmann::ordered_json j = {
        {"rmse", d.rmse}, {"relative_l2", d.relative_l2}, {"max", d.max}, {"mean_ratio", d.mean_ratio}, {"white", white}};
    fmt::print("{}\n", j.dump());
  } else {
    fmt::print("rmse         {:.6g}\nrelative L2  {:.6g}\nmax          {:.6g} at ({}, {})\nmean ratio   {:.6g}\nwhite        {:.6g}\n",
               d.rmse, d.relative_l2, d.max, d.max_x, d.max_y, d.mean_ratio, white);
  }
  for (const Limit& limit : limits) {
    const double value = limit.metric == "rmse" ? d.rmse : limit.metric == "max" ? d.max : d.relative_l2;
    if (value <= limit.value) continue;
    fmt::print(stderr, "steradian: {} is {:.6g}, above {:.6g}\n", limit.metric, value, limit.value);
    exit.code = 1;
  }
}

}  // namespace

void add_diff(CLI::App& app, Exit& exit) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("diff", "Difference of two pictures (EXR, PNG, JPEG) in numbers");
  verb->add_option("A", options->a, "picture")->required();
  verb->add_option("B", options->b, "reference picture")->required();
  verb->add_flag("--json", options->json, "print JSON");
  verb->add_option("--fail-above", options->fail_above,
                   "METRIC=VALUE: exit 1 when rmse, relative_l2 or max is above VALUE; may be repeated");
  add_limits(*verb, options->limits);
  verb->callback([options, &exit] { run(*options, exit); });
}

}  // namespace steradian::app
