// steradian solve SCENE --target PICTURE --fit LIGHT:PARAMETERS -o SOLVED.glb
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "command_line.h"
#include "core/files.h"
#include "render/picture_options.h"
#include "render/resume.h"
#include "solve/job.h"
#include "solve/report.h"
#include "solve/solved_file.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/solve.h"
#include "verbs.h"

namespace steradian::app {
namespace {

struct SolveArguments {
  std::string scene, output, target, mask, spec, size, report, bounces = "0";
  std::vector<std::string> fits;
  bool json = false;
  PictureDefaults picture;
  LoadOptions load;
  SolveOptions solve;
};

// Prints a line a second, from the second second on.
class StepLines {
 public:
  void show(const SolveStep& step) {
    const double now = seconds();
    if (now < next_) return;
    next_ = now + 1;
    fmt::print(stderr, "start {}, step {}: cost {:.6g}, damping {:.1e}\n", step.start, step.step, step.cost, step.damping);
  }

 private:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double next_ = 1;
};

void print(const Solution& found, const SolveArguments& options) {
  fmt::print("{:<32} {:>12} {:>12} {:>12}\n", "parameter", "start", "result", "+-");
  for (const FittedParameter& p : found.parameters)
    fmt::print("{:<32} {:>12.5g} {:>12.5g} {:>12} {}\n", p.name, p.start, p.value, p.determined ? fmt::format("{:.2g}", p.sigma) : "-",
               !p.determined ? "not determined"
               : p.at_bound  ? "at its bound"
                             : "");
  for (const LuxResult& lux : found.lux)
    fmt::print("{}: {:.1f} to {:.1f} lux, mean {:.1f}, min/mean {:.2f}; {} of {} points outside\n", lux.name, lux.min, lux.max, lux.mean,
               lux.mean > 0 ? lux.min / lux.mean : 0, lux.outside, lux.points);
  if (found.picture_error > 0) fmt::print("picture: rms residual {:.3g}\n", found.picture_error);
  for (const std::string& note : found.notes) fmt::print("{}\n", note);
  fmt::print("{}: cost {:.6g} after {} steps, {} evaluations\n",
             found.stopped     ? "stopped"
             : found.converged ? "solved"
                               : "not converged",
             found.cost, found.steps.empty() ? 0 : found.steps.back().step, found.evaluations);
  if (!options.output.empty() && options.output != "-") fmt::print("{}\n", options.output);
}

void run(SolveArguments& options, CommandLine& line) {
  const auto begin = std::chrono::steady_clock::now();
  if (!options.size.empty()) {
    const PictureSize size = picture_size(options.size);
    options.picture.width = size.width;
    options.picture.height = size.height;
  }
  options.solve.render.bounces = bounces_of(options.bounces);
  options.load.lights = {AddedLight::none};  // a light that the file does not have cannot be written
  const LoadedScene loaded = load_scene(options.scene, options.load);
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}\n", warning);
  SolveJobReader reader(loaded.scene, options.picture, options.load.limits);
  for (const std::string& fit : options.fits) reader.add_fit(fit);
  if (!options.target.empty()) reader.add_target(options.target, options.mask);
  if (!options.spec.empty()) reader.add_file(options.spec);
  const SolveJob job = reader.finish();
  options.solve.least_power = job.least_power;
  options.solve.materials = job.materials;

  const StopSignals signals;
  StepLines lines;
  options.solve.progress = [&](const SolveStep& step) {
    lines.show(step);
    return !signals.asked();
  };
  const Solution found = solve(loaded.scene, job.fits, job.ties, job.targets, options.solve);
  write_solved(options.scene, loaded.scene, found, options.output);
  SolveReport report{options.scene,  options.output,
                     command_line(), std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                     loaded.scene,   job,
                     found,          options.solve.render};
  if (!options.report.empty()) write_solve_report(report, options.report, options.load);
  if (options.json)
    fmt::print("{}", solve_report_json(report));
  else
    print(found, options);
  if (found.stopped) {
    std::fflush(stdout);
    signals.end_by_it();
  }
  if (!found.converged) line.exit().code = 3;
}

}  // namespace

void add_solve(CommandLine& line) {
  auto options = std::make_shared<SolveArguments>();
  RenderOptions& r = options->solve.render;
  r.shadows = Shadows::on;  // as render
  Verb verb = line.verb("solve", "Find lights from a wanted picture or from illuminances");
  verb.group("Question");
  verb.footer(
      "Parameters: power (the default), color, position, rotation, size, vertices.\n"
      "Parameters of a material: albedo (the default), roughness.\n"
      "Example: steradian solve room.glb --target wanted.exr --fit 'lamp*:position,power' -o solved.glb\n"
      "Exit status: 0 solved, 1 error, 3 the tolerance was not reached (the file is written).");
  verb.add("SCENE", options->scene, "scene file: .gltf, .glb").existing_file().required();
  verb.add("-o,--output", options->output, "the scene with the fitted lights: .gltf, .glb").writes(Writes::file).required();
  verb.add("--target", options->target, "wanted picture: .exr, .hdr, .png, .jpg").existing_file();
  verb.add("--fit", options->fits, "LIGHT[:PARAMETER,...] or material:NAME[:...]; * matches any name");
  verb.add("--spec", options->spec, "JSON file of parameters, ties and targets (docs/solve-questions.md)").existing_file();
  verb.add("--mask", options->mask, "picture of weights for the target's pixels").existing_file().needs("--target");
  verb.add("--camera", options->picture.camera, "name of the target's camera; default: the file's first").group("Target");
  verb.add("--size", options->size, "WIDTHxHEIGHT to which targets are resampled; default: their own").group("Target");
  verb.add_word("--space", options->picture.space, "what residuals compare").group("Target");
  verb.add_word("--loss", options->picture.loss, "cauchy: wrong pixels hardly count").group("Target");
  verb.add_word("--shadows", r.shadows, "direct shadows").group("Light");
  verb.add("--bounces", options->bounces, "light between surfaces, for powers alone: number, or all").check(unknown_bounces).group("Light");
  verb.add_word("--quality", r.quality, "of integrals and bounces").group("Light");
  verb.add("--starts", options->solve.starts, "starting points: the file's own, and random ones").range(1, 10000).group("Search");
  verb.add("--seed", options->solve.seed, "seed of the random starting points").group("Search");
  verb.add("--max-steps", options->solve.max_steps, "most steps of the last search").range(1, 100000).group("Search");
  verb.add("--tolerance", options->solve.tolerance, "relative change at which the search ends").range(1e-12, 0.1).group("Search");
  verb.add("--report", options->report, "folder of a report: one page and report.json").writes(Writes::folder).group("Report");
  verb.add_flag("--json", options->json, "print the result as JSON").group("Report");
  verb.add("--threads", r.threads, "number of threads (0: all)").range(0, 4096).group("Machine");
  verb.add("--max-lights", options->load.max_lights, "area lights kept, strongest first (256 and meshes)").range(1, 1 << 20).more("Limits");
  verb.add_word("--light-units", options->load.light_units, "unit of punctual lights").more("Limits");
  verb.add_limits(options->load.limits);
  verb.callback([options, &line] { run(*options, line); });
}

}  // namespace steradian::app
