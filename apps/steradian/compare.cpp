// steradian compare SCENE --methods a,b,c -o DIR: compares every method with the reference, as pictures, numbers and a page.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

#include "command_line.h"
#include "compare/report.h"
#include "core/files.h"
#include "core/progress.h"
#include "image/flip.h"
#include "integrals/methods.h"
#include "picture_options.h"
#include "render_plane.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/plane.h"
#include "verbs.h"

namespace steradian::app {
namespace {

struct CompareArguments {
  std::string scene, output, size, exposure = "auto";
  std::vector<std::string> methods;
  bool settings = true;
  std::optional<int> max_lights;
  Limits limits;
  RenderOptions render;
};

// The picture of a method, with its time and passes.
struct Made {
  Picture picture;
  double ms = 0;
  std::vector<PassTime> passes;
};

// One setting of a method: its name, and the function that renders it.
struct Setting {
  std::string words;
  std::function<Made()> make;
};

// A scene in three dimensions or in the plane, in the form that `compare` needs.
struct Subject {
  std::function<Made()> reference;
  std::string reference_words;
  // The settings of a method, from cheap to expensive, and the index of the one in the table.
  std::function<std::pair<std::vector<Setting>, std::size_t>(const std::string& method)> settings;
};

// A separate progress bar for each picture; their lines take turns.
std::function<void(std::uint64_t, std::uint64_t)> progress_of(const std::string& label) {
  static const ProgressOutput output = progress_on_stderr();
  auto bar = std::make_shared<std::unique_ptr<Progress>>();
  auto mutex = std::make_shared<std::mutex>();
  return [=](std::uint64_t, std::uint64_t total) {
    {
      const std::lock_guard lock(*mutex);
      if (!*bar) *bar = std::make_unique<Progress>("compare: " + label, total, output);
    }
    (*bar)->add();
  };
}

// ---- Three dimensions --------------------------------------------------------------------------------------------

Made make_frame(const Scene& scene, RenderOptions options, const std::string& label) {
  options.progress = progress_of(label);
  RenderStats stats;
  Made made;
  made.picture = render(scene, options, &stats);
  made.ms = stats.total_ms;
  made.passes = stats.passes;
  return made;
}

Subject frame_subject(const std::shared_ptr<const Scene>& scene, const CompareArguments& options) {
  Subject subject;
  RenderOptions judge = options.render;
  judge.method = "reference";
  subject.reference_words = fmt::format("Monte Carlo until its standard error is {:.3g} of the picture", judge.target_error);
  subject.reference = [=] { return make_frame(*scene, judge, "reference"); };
  subject.settings = [scene, render = options.render, all = options.settings](const std::string& method) {
    std::vector<Setting> settings;
    const auto add = [&](const std::string& words, const RenderOptions& r) {
      settings.push_back({words, [=] { return make_frame(*scene, r, method + ", " + words); }});
    };
    RenderOptions r = render;
    r.method = method;
    if (method == "sampled") {
      for (r.spp = all ? 1 : render.spp; r.spp < render.spp; r.spp *= 4) add(fmt::format("{} spp", r.spp), r);
      r.spp = render.spp;
      add(fmt::format("{} spp", r.spp), r);
      return std::pair{settings, settings.size() - 1};
    }
    const std::optional<Method> known = method_of(method);
    const bool qualities = known && (*known == Method::automatic || *methods::row_of(*known).qualities != '\0');
    if (!all || !qualities) {
      add("normal", r);
      return std::pair{settings, std::size_t{0}};
    }
    for (const words::OptionWord<Quality>& quality : words::kTable<Quality>) {
      r.quality = quality.value;
      add(quality.name, r);
    }
    return std::pair{settings, std::size_t{1}};
  };
  return subject;
}

// ---- The plane ---------------------------------------------------------------------------------------------------

Made make_plane(const PlaneWorld& world, PlaneFrameOptions options, const std::string& label) {
  options.progress = progress_of(label);
  PlaneFrameStats stats;
  Made made;
  made.picture = render_plane(world, options, &stats);
  made.picture.layers.clear();
  made.ms = stats.prepare_ms + stats.frame_ms;
  made.passes = {{"prepare", stats.prepare_ms}, {"frame", stats.frame_ms}};
  return made;
}

Subject plane_subject(const std::shared_ptr<const PlaneWorld>& world, const CompareArguments& options) {
  PlaneFrameOptions frame;
  frame.limits = options.limits;
  frame.threads = options.render.threads;
  frame.aa = options.render.aa;
  if (!options.size.empty()) {
    const PictureSize size = picture_size(options.size);
    frame.width = size.width;
    frame.height = size.height;
  }
  frame.sampling = {options.render.spp, options.render.seed};
  Subject subject;
  subject.reference_words = "the closed form in double precision, point by point";
  subject.reference = [=] {
    PlaneFrameOptions judge = frame;
    judge.moments = true;  // in double, pixel by pixel
    return make_plane(*world, judge, "reference");
  };
  subject.settings = [world, frame, all = options.settings](const std::string& method) {
    std::vector<Setting> settings;
    PlaneFrameOptions f = frame;
    f.method = plane_method_from_name(method == "auto" ? "exact" : method);
    const auto add = [&](const std::string& words) {
      settings.push_back({words, [world, f, label = method + ", " + words] { return make_plane(*world, f, label); }});
    };
    if (f.method == PlaneMethod::sampled || f.method == PlaneMethod::marched) {
      for (f.sampling.spp = all ? 4 : frame.sampling.spp; f.sampling.spp < frame.sampling.spp; f.sampling.spp *= 4)
        add(fmt::format("{} spp", f.sampling.spp));
      f.sampling.spp = frame.sampling.spp;
      add(fmt::format("{} spp", f.sampling.spp));
    } else {
      add("normal");
    }
    return std::pair{settings, settings.size() - 1};
  };
  return subject;
}

// ---- The comparison ----------------------------------------------------------------------------------------------

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

Report compared(const Subject& subject, const CompareArguments& options) {
  // The settings of all methods are built first, so that an unknown or unsuitable method is refused before the long work.
  std::vector<std::pair<std::vector<Setting>, std::size_t>> settings;
  for (const std::string& method : options.methods) settings.push_back(subject.settings(method));

  Report report;
  report.scene = options.scene;
  report.command = command_line();
  std::vector<std::vector<Made>> made;
  for (const auto& [of_method, chosen] : settings) {
    made.emplace_back();
    for (const Setting& setting : of_method) made.back().push_back(setting.make());
  }
  Made reference = subject.reference();
  report.reference_words = subject.reference_words;
  report.reference_ms = reference.ms;
  report.reference_error = own_error(reference.picture);
  report.reference = std::move(reference.picture);
  report.exposure = exposure_stops(options.exposure).value_or(auto_exposure(report.reference));
  report.white = white_of(report.reference);
  for (std::size_t m = 0; m < settings.size(); ++m)
    for (std::size_t s = 0; s < made[m].size(); ++s) {
      Made& of = made[m][s];
      const Run run = {options.methods[m], settings[m].first[s].words, of.ms, difference(of.picture, report.reference)};
      report.over_time.push_back(run);
      if (s != settings[m].second) continue;
      image::Flip flip = image::flip(of.picture, report.reference, report.exposure);
      report.methods.push_back({run, std::move(of.picture), of.passes, flip.mean, std::move(flip.error)});
    }
  return report;
}

void write(const Report& report, const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error(folder.string(), "cannot make this folder: " + failed.message(), "choose another with -o");
  write_picture(report.reference, (folder / "reference.exr").string());
  for (const Compared& of : report.methods) write_picture(of.picture, (folder / (of.run.method + ".exr")).string());
  write_file((folder / "report.json").string(), report_json(report));
  write_file((folder / "index.html").string(), report_page(report));
}

void print(const Report& report, const std::string& folder) {
  fmt::print("{:<22} {:>10} {:>11} {:>11} {:>11} {:>10} {:>8}\n", "method", "ms", "relative L2", "rmse", "max", "mean ratio", "FLIP");
  for (const Compared& of : report.methods) {
    const Difference& d = of.run.difference;
    fmt::print("{:<22} {:>10.1f} {:>11.3e} {:>11.3e} {:>11.3e} {:>10.5f} {:>8.4f}\n", of.run.method, of.run.ms, d.relative_l2, d.rmse,
               d.max, d.mean_ratio, of.flip);
  }
  fmt::print("reference: {}", report.reference_words);
  if (report.reference_error > 0) fmt::print("; as relative L2 it is itself good to {:.1e}", report.reference_error);
  fmt::print("\n{}\n", (std::filesystem::path(folder) / "index.html").string());
}

std::shared_ptr<const Scene> scene_of(const CompareArguments& options) {
  LoadedScene loaded = load_scene(options.scene, {options.max_lights, options.limits, {}});
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
  Subject subject;
  if (is_plane_scene(options.scene)) {
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
  const Report report = compared(subject, options);
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
  verb.add("--methods", options->methods, "names separated by commas; default: the usual four").separator(',');
  verb.add_flag("!--one-setting", options->settings, "one quality and one number of samples a method");
  verb.add_word("--shadows", r.shadows, "direct shadows");
  verb.add("--size", options->size, "WIDTHxHEIGHT in pixels; default: 960x540, or the drawing's").group("Picture");
  verb.add("--camera", r.camera, "name of the camera; default: the file's first").group("Picture");
  verb.add("--exposure", options->exposure, "of the page and of FLIP: stops, or auto").group("Picture");
  verb.add("--aa", r.aa, "primary samples a pixel").range(1, 4096).group("Picture");
  verb.add("--spp", r.spp, "of sampled and marched").range(1, 1 << 20).group("Sampling");
  verb.add("--target-error", r.target_error, "of reference: relative rms error").range(1e-6, 1.0).group("Sampling");
  verb.add("--seed", r.seed, "seed of the random numbers").group("Sampling");
  verb.add("--threads", r.threads, "number of threads (0: all)").range(0, 4096).group("Machine");
  verb.add("--max-lights", options->max_lights, "area lights kept, strongest first (256 and meshes)").range(1, 1 << 20).more("Limits");
  verb.add_limits(options->limits);
  verb.callback([options] { run(*options); });
}

}  // namespace steradian::app
