// steradian fit --lobe NAME | --samples FILE --layout classic|compact -o FILE
#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <memory>

#include "core/progress.h"
#include "core/unfinished_file.h"
#include "fit/fit_part.h"
#include "fit/fit_report.h"
#include "fit/fitted_table.h"
#include "part.h"
#include "steradian/error.h"
#include "steradian/fit.h"
#include "verbs.h"

namespace steradian::app {
namespace {

using namespace fit;

struct FitArguments {
  std::string lobe = "ggx", samples, output, picture, search = "bobyqa", part = "1/1";
  bool report = false, fresnel_lobe = false, resume = false;
  TableForm form;
  FitOptions fit;
  Limits limits;
};

LtcTable fit_with_progress(const LobeFamily& family, FitOptions fit, LtcTable (*fitter)(const LobeFamily&, const FitOptions&) = fit_table) {
  Progress progress("fit " + family.name, columns_of_part(family, fit).size() * static_cast<std::uint64_t>(fit.size));
  fit.cell_done = [&] { progress.add(); };
  return fitter(family, fit);
}

// The fit, with its finished columns in a file beside the output. The caller removes the file when the output is written.
LtcTable resumed_fit(const LobeFamily& family, FitOptions fit, UnfinishedFile& unfinished) {
  fit.known = [&](int i, std::vector<LtcCell>& column) {
    const auto found = unfinished.find(static_cast<std::uint64_t>(i));
    column.resize(static_cast<std::size_t>(fit.size));
    if (!found || found->size() != column.size() * sizeof(LtcCell)) return false;
    std::memcpy(column.data(), found->data(), found->size());
    return true;
  };
  fit.finished = [&](int i, const std::vector<LtcCell>& column) {
    unfinished.add(static_cast<std::uint64_t>(i), {reinterpret_cast<const char*>(column.data()), column.size() * sizeof(LtcCell)});
  };
  return fit_with_progress(family, fit);
}

std::string with_suffix(const std::string& path, const std::string& suffix) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path + suffix : path.substr(0, dot) + suffix + path.substr(dot);
}

void report(const LtcTable& table, const FitArguments& options) {
  const LookUp look_up = look_up_of(table, options.form);
  if (options.form.layout == "compact") fmt::print("bytes        {}\n", compact_table(table, options.form.compact).bytes());
  ReportOptions all = whole_grid(), on_nodes = node_grid();
  const auto& fixed = table.family.fixed_roughness;
  if (fixed) all.roughness = on_nodes.roughness = {*fixed};
  const fit::FitReport whole = measure(table.family, look_up, all);
  const fit::FitReport nodes = measure(table.family, look_up, on_nodes);
  fmt::print("{}", describe(whole, nodes, fixed ? std::vector<BetweenNodes>{} : measure_between_nodes(table, look_up)));
  if (!options.picture.empty()) write_picture(draw(whole, all), options.picture);
}

void report_fresnel(const LtcTable& table, const LtcTable& fresnel, const FitArguments& options) {
  fmt::print("\nFresnel, F90 = 1, whole grid: relative error by n_A and f_A, and with the lobe of its own\n");
  for (double f0 : {0.04, 0.2, 0.9}) {
    const FresnelError e =
        measure_fresnel(table.family, look_up_of(table, options.form), look_up_of(fresnel, options.form), f0, whole_grid());
    fmt::print("F0 = {:.2f}  {:6.2f} %  {:6.2f} %\n", f0, 100 * e.split, 100 * e.lobe);
  }
}

void run(const FitArguments& options) {
  if (options.output.empty() && !options.report) throw WrongOption("-o or --report", "one of them is required");
  if (options.search != "bobyqa" && !options.output.empty())
    throw WrongOption("--search", "nelder-mead is a baseline to measure; use it with --report, without -o");
  if (options.fresnel_lobe && options.form.layout == "compact")
    throw WrongOption("--fresnel-lobe", "the compact layout has too few nodes for this lobe; use --layout classic");
  if (!options.samples.empty() && options.form.layout == "compact")
    throw WrongOption("--samples", "the compact layout's matrix follows the roughness, which samples do not have; use --layout classic");
  LobeSamples samples;
  if (!options.samples.empty()) samples = read_lobe_samples(options.samples, options.limits);
  const LobeFamily& family = options.samples.empty() ? lobe_family(options.lobe) : samples.family;
  // A wrong file ending is reported before the work.
  const Part part = part_named(options.part);
  if (part.count > 1) {
    for (const auto& [option, given] : {std::pair{"--report", options.report}, {"--fresnel-lobe", options.fresnel_lobe}})
      if (given) throw WrongOption(option, "needs the whole table; a part has some columns");
    if (!options.output.ends_with(".json")) throw WrongOption("-o", "a part is written as .json; steradian merge joins them");
  } else if (!options.output.empty()) {
    check_table_name(options.output, options.form);
  }
  if (!options.samples.empty())
    fmt::print("albedo       {:.4f} {:.4f} {:.4f} along the normal\n", samples.albedo.x, samples.albedo.y, samples.albedo.z);
  FitOptions fit = options.fit;
  fit.search = options.search == "bobyqa" ? FitSearch::bobyqa : FitSearch::nelder_mead;
  const auto start = std::chrono::steady_clock::now();
  fit.part = part.number;
  fit.parts = part.count;
  const std::string settings = part.count > 1 || options.resume ? fit_settings(family, options.samples, fit) : std::string();
  std::unique_ptr<UnfinishedFile> unfinished;
  if (options.resume) unfinished = std::make_unique<UnfinishedFile>(options.output + ".part", settings + " | part " + options.part);
  const LtcTable table = unfinished ? resumed_fit(family, fit, *unfinished) : fit_with_progress(family, fit);
  if (part.count > 1) {
    FitPart file{settings, options.form, family, fit.size, part};
    for (const int i : columns_of_part(family, fit))
      for (int j = 0; j < fit.size; ++j) file.columns[i].push_back(table.at(i, j));
    write_fit_part(file, options.output);
    if (unfinished) unfinished->remove();
    return;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.report) fmt::print("fit          {} x {} in {:.1f} s\n", table.size, table.size, seconds);
  if (!options.output.empty()) write_fitted_table(table, options.form, options.output);
  if (unfinished) unfinished->remove();
  if (options.report) report(table, options);
  if (options.fresnel_lobe) {
    LobeFamily fresnel = family;
    fresnel.name += "-fresnel";
    fresnel.at = [&family](double roughness, double cosine) { return with_grazing_fresnel(family.at(roughness, cosine)); };
    const LtcTable fitted = fit_with_progress(fresnel, fit, fit_table_from_both_sides);
    write_fitted_table(fitted, options.form, with_suffix(options.output, "_fresnel"));
    if (options.report) report_fresnel(table, fitted, options);
  }
}

}  // namespace

void add_fit(CommandLine& line) {
  Verb verb = line.verb("fit", "Fit linearly transformed cosines to a lobe: write the table, measure its error");
  verb.group("Light");
  verb.footer(
      "A file of --samples is MERL's, or a text with a line for each combination of the angles, in any\n"
      "order:\n"
      "    theta_view theta_light azimuth value\n"
      "  theta_view, theta_light  degrees from the normal, 0 to 90\n"
      "  azimuth                  degrees between view and light, 0 to 360: 180 is the side of the mirror\n"
      "  value                    the BRDF in 1/sr: one number, or three for red, green and blue\n"
      "Spaces, tabs, commas or semicolons are between the numbers, and # begins a comment. A white wall:\n"
      "    0 0 0 0.3183\n"
      "    0 90 0 0.3183\n"
      "    90 0 0 0.3183\n"
      "    90 90 0 0.3183\n"
      "The table is for `render --table` and `eval` (.json), for C and C++ (.h) or for shaders (.glsl).");
  const auto options = std::make_shared<FitArguments>();
  std::vector<std::string> names;
  for (const LobeFamily& family : lobe_families()) names.push_back(family.name);
  verb.add("--lobe", options->lobe, "lobe to fit").words(names);
  verb.add("--samples", options->samples, "measured lobe: MERL's .binary, or lines of angles and values").excludes("--lobe");
  verb.add("--size", options->fit.size, "nodes of roughness and of view").range(2, 1024);
  verb.add("--layout", options->form.layout, "two textures, or arrays of at most 4 KB").words({"classic", "compact"});
  verb.add("-o,--output", options->output, "table: .h .glsl .json; classic also .dds .exr (NAME_1, NAME_2)").writes(Writes::file);
  verb.add_flag("--fresnel-lobe", options->fresnel_lobe, "also fit the lobe times (1 - v.h)^5, into NAME_fresnel").needs("--output");
  verb.add_flag("--report", options->report, "measure the error on lights and between nodes");
  verb.add("--report-picture", options->picture, "picture of the error (.png, .exr)").writes(Writes::picture).needs("--report");
  verb.add("--normalisation", options->form.normalisation, "element 1 of the classic matrix").words({"middle", "last"});
  verb.add("--search", options->search, "search for the minimum").words({"bobyqa", "nelder-mead"});
  verb.add("--part", options->part, "k/n: fit one of n parts to a .json; steradian merge joins them").needs("--output");
  verb.add_flag("--resume", options->resume, "go on after an interruption; keeps finished columns in OUTPUT.part").needs("--output");
  verb.add("--threads", options->fit.threads, "number of threads (0: all)").range(0, 4096);
  verb.add_limits(options->limits);
  verb.callback([options] { run(*options); });
}

}  // namespace steradian::app
