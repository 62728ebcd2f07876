// steradian compare SCENE --methods a,b,c -o DIR: compares every method with the reference, as pictures, numbers and a page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "command_line.h"
#include "compare/report.h"
#include "compare/subject.h"
#include "core/files.h"
#include "image/flip.h"
#include "render/picture_options.h"
#include "render/render_plane.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/plane.h"
#include "verbs.h"

namespace steradian::app {
namespace {

// Relative error of an estimate with a layer of variances: the root of their sum over the picture's norm.
double own_error(const Picture& picture) {
  const auto layer = picture.layers.find("variance");
  if (layer == picture.layers.end()) return 0;
  double variance = 0, norm = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto v = static_cast<Vec3d>(layer->second[i]), p = static_cast<Vec3d>(picture.pixels[i]);
    variance += v.x + v.y + v.z;
    norm += dot(p, p);
  }
  return norm > 0 ? std::sqrt(variance / norm) : 0;
}

// The time that a comparison has. Without a limit, all parts of it are infinite.
class TimeLeft {
 public:
  explicit TimeLeft(double limit) : limit_(limit > 0 ? limit : std::numeric_limits<double>::infinity()) {}
  // A share of the first `part` of the limit, for one of `works` that have yet to be done.
  double share(double part, std::size_t works) const {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return (part * limit_ - spent) / static_cast<double>(works);
  }

 private:
  double limit_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// The pictures of all methods and settings; none where the time was over.
struct Pictures {
  std::vector<std::vector<std::optional<Made>>> made;
  Made reference;
};

// The methods' pictures of the table come first, because they find out quickly what a method refuses. They share half of the time. The
// reference has the rest, and other settings what remains after it.
Pictures pictures_of(const Subject& subject, const std::vector<Settings>& settings, const CompareArguments& options) {
  const TimeLeft time(options.time_limit);
  subject.warm_up();
  Pictures pictures;
  for (std::size_t m = 0; m < settings.size(); ++m) {
    pictures.made.emplace_back(settings[m].first.size());
    pictures.made[m][settings[m].second] = settings[m].first[settings[m].second].make(Alarm(time.share(0.5, settings.size() - m)));
  }
  const auto fits = [&](std::size_t m) { return pictures.made[m][settings[m].second].has_value(); };
  const auto more = "give more time, or a smaller --size";
  bool any = false;
  for (std::size_t m = 0; m < settings.size(); ++m) any |= fits(m);
  if (!any) throw Error("--time-limit", fmt::format("no method fits into half of {} s", options.time_limit), more);
  std::optional<Made> reference = subject.reference(Alarm(time.share(1, 1)));
  if (!reference)
    throw Error("--time-limit", fmt::format("the reference does not fit into {} s", options.time_limit),
                std::string(more) + ", or a larger --target-error");
  pictures.reference = std::move(*reference);
  for (std::size_t m = 0; m < settings.size(); ++m)
    for (std::size_t s = 0; s < settings[m].first.size(); ++s)
      if (fits(m) && s != settings[m].second) pictures.made[m][s] = settings[m].first[s].make(Alarm(time.share(1, 1)));
  return pictures;
}

ComparisonReport compared(const Subject& subject, const CompareArguments& options) {
  // The settings of all methods are built first, so that an unknown or unsuitable method is refused before the long work.
  std::vector<Settings> settings;
  for (const std::string& method : options.methods) settings.push_back(subject.settings(method));
  Pictures pictures = pictures_of(subject, settings, options);

  ComparisonReport report;
  report.scene = options.scene;
  report.command = command_line();
  report.time_limit = options.time_limit;
  report.reference_words = subject.reference_words;
  report.reference_ms = pictures.reference.ms;
  report.reference_error = own_error(pictures.reference.picture);
  report.reference = std::move(pictures.reference.picture);
  report.exposure = exposure_stops(options.exposure).value_or(auto_exposure(report.reference));
  report.white = white_of(report.reference);
  for (std::size_t m = 0; m < settings.size(); ++m) {
    const std::string& method = options.methods[m];
    const auto& [of_method, chosen] = settings[m];
    if (!pictures.made[m][chosen]) {
      report.did_not_fit.push_back(method);
      continue;
    }
    for (std::size_t s = 0; s < of_method.size(); ++s) {
      if (!pictures.made[m][s]) {
        report.did_not_fit.push_back(method + " at " + of_method[s].words);
        continue;
      }
      Made& of = *pictures.made[m][s];
      const Run run = {method, of_method[s].words, of.ms, difference(of.picture, report.reference)};
      report.over_time.push_back(run);
      if (s != chosen) continue;
      image::Flip flip = image::flip(of.picture, report.reference, report.exposure);
      report.methods.push_back({run, std::move(of.picture), of.passes, flip.mean, std::move(flip.error)});
    }
  }
  return report;
}

void write(const ComparisonReport& report, const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error(folder.string(), "cannot make this folder: " + failed.message(), "choose another with -o");
  write_picture(report.reference, (folder / "reference.exr").string());
  for (const ComparedPicture& of : report.methods) write_picture(of.picture, (folder / (of.run.method + ".exr")).string());
  write_file((folder / "report.json").string(), report_json(report));
  write_file((folder / "index.html").string(), report_page(report));
}

void print(const ComparisonReport& report, const std::string& folder) {
  fmt::print("{:<22} {:>10} {:>11} {:>11} {:>11} {:>10} {:>8}\n", "method", "ms", "relative L2", "rmse", "max", "mean ratio", "FLIP");
  for (const ComparedPicture& of : report.methods) {
    const Difference& d = of.run.difference;
    fmt::print("{:<22} {:>10.1f} {:>11.3e} {:>11.3e} {:>11.3e} {:>10.5f} {:>8.4f}\n", of.run.method, of.run.ms, d.relative_l2, d.rmse,
               d.max, d.mean_ratio, of.flip);
  }
  fmt::print("reference: {}", report.reference_words);
  if (report.reference_error > 0) fmt::print("; as relative L2 it is itself good to {:.1e}", report.reference_error);
  if (!report.did_not_fit.empty()) fmt::print("\ndid not fit into {} s: {}", report.time_limit, fmt::join(report.did_not_fit, ", "));
  fmt::print("\n{}\n", (std::filesystem::path(folder) / "index.html").string());
}

std::shared_ptr<const Scene> scene_of(const CompareArguments& options) {
  LoadOptions load = {options.max_lights, options.limits};
  load.near_origin = true;
  LoadedScene loaded = load_scene(options.scene, load);
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return std::make_shared<const Scene>(std::move(loaded.scene));
}

using Names = std::vector<std::string>;

// True if the heuristic supports the scene's lights.
bool takes_par(const PlaneWorld& world) {
  try {
    world.query(world.scene().origin, PlaneMethod::par);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void run(CompareArguments& options) {
  std::vector<std::string> seen;
  for (const std::string& method : options.methods) {
    if (std::find(seen.begin(), seen.end(), method) != seen.end()) throw WrongOption("--methods", method + " is named twice");
    if (method == "reference") throw WrongOption("--methods", "reference is what the others are compared with");
    seen.push_back(method);
  }
  exposure_stops(options.exposure);
  options.render.bounces = bounces_of(options.bounces);
  Subject subject;
  if (is_plane_scene(options.scene)) {
    if (options.render.bounces != 0) throw WrongOption("--bounces", "has an effect only with a scene in three dimensions (.gltf, .glb)");
    const auto world = std::make_shared<const PlaneWorld>(load_plane_scene(options.scene, options.limits).scene, options.limits);
    if (options.methods.empty())
      options.methods = takes_par(*world) ? Names{"exact", "par", "sampled", "marched"} : Names{"exact", "sampled", "marched"};
    for (const std::string& method : options.methods) {
      try {
        if (method != "auto") plane_method_from_name(method);
      } catch (const Error& e) {
        throw UsageError("--methods", e.problem(), e.hint());
      }
    }
    subject = plane_subject(world, options);
  } else {
    if (options.methods.empty()) options.methods = {"auto", "ltc", "ltc-compact", "sampled"};
    for (const std::string& method : options.methods)
      if (const std::string problem = unknown_method(method, false); !problem.empty()) throw WrongOption("--methods", problem);
    const PictureSize size = picture_size(options.size.empty() ? "960x540" : options.size);
    options.render.width = size.width;
    options.render.height = size.height;
    subject = frame_subject(scene_of(options), options);
  }
  const ComparisonReport report = compared(subject, options);
  write(report, options.output);
  print(report, options.output);
}

}  // namespace

void add_compare(CommandLine& line) {
  auto options = std::make_shared<CompareArguments>();
  RenderOptions& r = options->render;
  r.target_error = 0.02;
  r.spp = 64;
  Verb verb = line.verb("compare", "Compare methods with the reference: pictures, error maps, numbers, one page");
  verb.group("Pictures");
  verb.footer(
      "The folder gets index.html (needs nothing else), report.json, reference.exr and METHOD.exr.\n`steradian methods` lists the "
      "methods.");
  verb.add("SCENE", options->scene, "scene file: .gltf, .glb, .svg").required();
  verb.add("-o,--output", options->output, "folder of the report").writes(Writes::folder).required();
  verb.add("--methods", options->methods, "names separated by commas; default: the usual four").separator(',').suggests(method_names());
  verb.add_flag("!--one-setting", options->settings, "one quality and one number of samples a method");
  verb.add_word("--shadows", r.shadows, "direct shadows");
  verb.add("--bounces", options->bounces, "light between surfaces (.gltf, .glb): number of bounces, or all").check(unknown_bounces);
  verb.add("--size", options->size, "WIDTHxHEIGHT in pixels; default: 960x540, or the drawing's").group("Picture");
  verb.add("--camera", r.camera, "name of the camera; default: the file's first").group("Picture");
  verb.add("--exposure", options->exposure, "of the page and of FLIP: stops, or auto").group("Picture");
  verb.add("--aa", r.aa, "primary samples a pixel").range(1, 4096).group("Picture");
  verb.add("--spp", r.spp, "of sampled and marched").range(1, 1 << 20).group("Sampling");
  verb.add("--target-error", r.target_error, "of reference: relative rms error").range(1e-6, 1.0).group("Sampling");
  verb.add("--seed", r.seed, "seed of the random numbers").group("Sampling");
  verb.add("--threads", r.threads, "number of threads (0: all)").range(0, 4096).group("Machine");
  verb.add("--time-limit", options->time_limit, "seconds for the pictures; names what does not fit; 0: none")
      .value_name("S")
      .check([](const std::string& text) {
        double seconds = 0;
        int used = 0;
        const bool number = std::sscanf(text.c_str(), "%lf%n", &seconds, &used) == 1 && static_cast<std::size_t>(used) == text.size();
        return number && seconds >= 0 && seconds <= 1e9 ? std::string() : "'" + text + "' is not a number of seconds, 0 to 1e9";
      })
      .group("Machine");
  verb.add("--max-lights", options->max_lights, "area lights kept, strongest first (256 and meshes)").range(1, 1 << 20).more("Limits");
  verb.add_limits(options->limits);
  verb.callback([options] { run(*options); });
}

}  // namespace steradian::app
