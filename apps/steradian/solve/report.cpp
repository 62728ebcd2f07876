#include "solve/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "image/codecs.h"
#include "page_text.h"
#include "solve/page.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "steradian/version.h"

namespace steradian::app {
namespace {

using Json = nlohmann::ordered_json;

// A number that JSON has; null for others.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json report_data(const SolveReport& report) {
  const Solution& found = report.found;
  Json parameters = Json::array(), steps = Json::array(), lux = Json::array();
  for (const FittedParameter& p : found.parameters)
    parameters.push_back({{"name", p.name},
                          {"start", number(p.start)},
                          {"value", number(p.value)},
                          {"sigma", number(p.sigma)},
                          {"at_bound", p.at_bound},
                          {"determined", p.determined}});
  for (const SolveStep& s : found.steps)
    steps.push_back({{"start", s.start}, {"step", s.step}, {"cost", number(s.cost)}, {"damping", number(s.damping)}});
  for (const LuxResult& l : found.lux)
    lux.push_back({{"name", l.name}, {"min", l.min}, {"mean", l.mean}, {"max", l.max}, {"outside", l.outside}, {"points", l.points}});
  return {{"version", version()},
          {"command", report.command},
          {"scene", report.scene_path},
          {"output", report.output},
          {"seconds", report.seconds},
          {"converged", found.converged},
          {"stopped", found.stopped},
          {"cost", number(found.cost)},
          {"picture_error", number(found.picture_error)},
          {"residuals", found.residuals},
          {"evaluations", found.evaluations},
          {"parameters", parameters},
          {"lux", lux},
          {"notes", found.notes},
          {"steps", steps}};
}

std::string png_text(const Picture& picture, float exposure) { return base64(image::encode_png(picture, exposure)); }

// The difference of luminances over twice the target's mean: red where it is positive, blue where it is negative.
std::string difference_text(const Picture& result, const Picture& target) {
  double mean = 0;
  for (const Vec3f& p : target.pixels) mean += luminance(static_cast<Vec3d>(p)) / static_cast<double>(target.pixels.size());
  return base64(image::encode_png_bytes(target.width, target.height, [&](int y, std::uint8_t* row) {
    for (int x = 0; x < target.width; ++x) {
      const double error =
          (luminance(static_cast<Vec3d>(result.at(x, y))) - luminance(static_cast<Vec3d>(target.at(x, y)))) / std::max(2 * mean, 1e-30);
      const auto shade = static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::min(std::fabs(error), 1.0))));
      *row++ = error > 0 ? shade : std::uint8_t{0};
      *row++ = 0;
      *row++ = error < 0 ? shade : std::uint8_t{0};
    }
  }));
}

// Pictures of the first target: the scene before, the target, and the written scene.
Json pictures_of(const SolveReport& report, const LoadOptions& load) {
  Json pictures = Json::object();
  for (const LightTarget& any : report.job.targets) {
    const auto* target = std::get_if<PictureTarget>(&any);
    if (target == nullptr) continue;
    RenderOptions options = report.render;
    options.width = target->picture.width;
    options.height = target->picture.height;
    options.camera = target->camera;
    const float exposure = auto_exposure(target->picture);
    pictures["start"] = png_text(render(report.start, options), exposure);
    pictures["target"] = png_text(target->picture, exposure);
    const Picture result = render(load_scene(report.output, load).scene, options);
    pictures["result"] = png_text(result, exposure);
    pictures["difference"] = difference_text(result, target->picture);
    return pictures;
  }
  RenderOptions options = report.render;
  options.width = 640;
  options.height = 360;
  const Picture result = render(load_scene(report.output, load).scene, options);
  const float exposure = auto_exposure(result);
  pictures["start"] = png_text(render(report.start, options), exposure);
  pictures["result"] = png_text(result, exposure);
  return pictures;
}

}  // namespace

std::string solve_report_json(const SolveReport& report) {
  return report_data(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_solve_report(const SolveReport& report, const std::string& folder, const LoadOptions& load) {
  const std::filesystem::path path(folder);
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (failed) throw Error(folder, "cannot make this folder: " + failed.message(), "choose another with --report");
  std::string page = kSolvePage;
  put(page, "@PICTURES@", in_script(pictures_of(report, load)));
  put(page, "@DATA@", in_script(report_data(report)));
  write_file((path / "report.json").string(), solve_report_json(report));
  write_file((path / "index.html").string(), page);
}

}  // namespace steradian::app
