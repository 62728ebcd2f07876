// steradian render SCENE -o IMAGE
#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command_line.h"
#include "core/budget.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/simd.h"
#include "image/codecs.h"
#include "part.h"
#include "render/direct_only.h"
#include "render/part_facts.h"
#include "render/picture_options.h"
#include "render/render_frames.h"
#include "render/render_plane.h"
#include "render/resume.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "steradian/version.h"
#include "verbs.h"
#include "wrong_use.h"

namespace steradian::app {
namespace {

constexpr const char* kDefaultSize = "1280x720";

struct RenderArguments {
  std::string scene, output, size = kDefaultSize, indirect_shadows = "off", stats, exposure = "auto", bounces = "0", frames, animation,
                             part;
  double fps = 24;
  bool force = false, multiple_scattering = false, spp_given = false, resume = false;
  std::vector<std::string> lights;
  ToneCurve tone = ToneCurve::neutral;
  PlaneRender plane;  // the values that only plane scenes have
  LoadOptions load;
  RenderOptions render;
};

void parse_size(const std::string& text, RenderOptions& render) {
  const PictureSize size = picture_size(text);
  render.width = size.width;
  render.height = size.height;
}

nlohmann::ordered_json stats_json(const RenderArguments& options, const RenderStats& stats) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const PassTime& pass : stats.passes) passes.push_back({{"name", pass.name}, {"ms", pass.ms}});
  return {{"version", version()},
          {"command", command_line()},
          {"backend", words::name_of(options.render.backend)},
          {"device", stats.device},
          {"simd", name_of(active_simd())},
          {"threads", stats.threads},
          {"width", options.render.width},
          {"height", options.render.height},
          {"seed", options.render.seed},
          {"lights", stats.lights},
          {"triangles", stats.triangles},
          {"method", stats.method},
          {"passes", passes},
          {"environment_spots", stats.environment_spots},
          {"diffuse_residual", stats.diffuse_residual},
          {"specular_residual", stats.specular_residual},
          {"patches", stats.patches},
          {"bounce_iterations", stats.bounce_iterations},
          {"patch_rays", stats.patch_rays},
          {"bounce_glossy", stats.bounce_glossy},
          {"bounce_glossy_evenly", stats.bounce_glossy_evenly},
          {"bounce_left_out", stats.bounce_left_out},
          {"bounce_error", stats.bounce_error},
          {"bound_elements", stats.bound_elements},
          {"bound_mean", stats.bound_mean},
          {"bound_inside", stats.bound_inside},
          {"environment_shadow_error", stats.environment_shadow_error},
          {"shadow_fallback", stats.shadow_fallback},
          {"shadows_estimated", stats.shadows_estimated},
          {"shadow_on_host", stats.shadow_on_host},
          {"shadow_pairs", stats.shadow_pairs},
          {"shadow_looks", stats.shadow_looks},
          {"shadow_gathered", stats.shadow_gathered},
          {"shadow_work", stats.shadow_work},
          {"submissions", stats.submissions},
          {"exact_tiles", stats.exact_tiles},
          {"estimated_shadow_error", stats.estimated_shadow_error},
          {"light_sum", stats.light_tree ? "tree" : "all"},
          {"light_elements", stats.light_elements},
          {"light_outlines", stats.light_outlines},
          {"light_bound_max", stats.light_bound_max},
          {"light_bound_mean", stats.light_bound_mean},
          {"total_ms", stats.total_ms}};
}

void parse_indirect_shadows(RenderArguments& options) {
  IndirectOptions& indirect = options.render.indirect;
  if (options.indirect_shadows == "off") return;
  int used = 0;
  if (std::sscanf(options.indirect_shadows.c_str(), "%d%n", &indirect.shadow_rays, &used) != 1 ||
      static_cast<std::size_t>(used) != options.indirect_shadows.size() || indirect.shadow_rays < 1 || indirect.shadow_rays > 64)
    throw WrongOption("--indirect-shadows", "'" + options.indirect_shadows + "' is not off or a number of rays, 1 to 64");
  if (indirect.mode != IndirectMode::ltc && indirect.mode != IndirectMode::path && options.render.method != "reference")
    throw WrongOption("--indirect-shadows", fmt::format("--indirect {} has none", words::name_of(indirect.mode)));
}

// True if the render may take minutes. Such a render saves its state when it is interrupted.
bool samples(const RenderArguments& options) {
  const RenderOptions& r = options.render;
  return r.method == "reference" || r.method == "sampled" || r.indirect.mode == IndirectMode::path;
}

// Everything that the picture depends on, for renders that may be interrupted.
std::string identity_of(const RenderArguments& options, const Scene& scene) {
  const RenderOptions& r = options.render;
  const LoadOptions& load = options.load;
  return fmt::format(
             "steradian {} {} | files {} | lights {} {} {} | environment {} {} {} | camera {} | method {} {} | shadows {} {} | scattering "
             "{}",
             version(), name_of(active_simd()), fingerprint({options.scene, load.environment, r.table}, scene), load.max_lights.value_or(0),
             fmt::join(options.lights, ","), words::name_of(load.light_units), load.environment, load.environment_rotation,
             words::name_of(r.background), r.camera, r.method, words::name_of(r.quality), words::name_of(r.shadows),
             words::name_of(r.terminator), options.multiple_scattering) +
         fmt::format(" | bounces {} | indirect {} {} {} {} {} {} | size {} aa {} spp {} target {} seed {}", r.bounces,
                     words::name_of(r.indirect.mode), r.indirect.virtual_lights, options.indirect_shadows, r.indirect.kept_pairs,
                     words::name_of(r.indirect.quads), words::name_of(r.indirect.soften), options.size, r.aa, r.spp, r.target_error,
                     r.seed);
}

// The same for any render.
std::string settings_of(const RenderArguments& options, const Scene& scene) {
  const RenderOptions& r = options.render;
  return identity_of(options, scene) +
         fmt::format(" | peak {} {} | lights {} {} | shadow error {} | bounce error {} {} reflections {}", words::name_of(r.peak_form),
                     r.early_stop, words::name_of(r.lights), r.light_error, r.shadow_error, r.bounce_error, r.bounce_strict,
                     r.reflections) +
         (r.bound ? " bound" : "");
}

// Renders the picture. The error for running out of memory gives the picture and its size.
Picture rendered(const Scene& scene, const RenderArguments& options, RenderStats& stats, RenderState& state) {
  try {
    return render(scene, options.render, &stats, &state);
  } catch (const std::bad_alloc&) {
    const auto pixels = static_cast<std::uint64_t>(options.render.width) * static_cast<std::uint64_t>(options.render.height);
    throw Error("--size " + options.size,
                "the machine ran out of memory while it rendered; the pixels alone take " + readable_bytes(sizeof(Vec3f) * pixels),
                "free some memory, or choose a smaller --size");
  }
}

// Refuses options without effect in three dimensions.
void refuse_unused_in_space(const Verb& verb, const RenderArguments& options) {
  const RenderOptions& r = options.render;
  const bool ltc = r.indirect.mode == IndirectMode::ltc, path = r.indirect.mode == IndirectMode::path;
  const bool points = ltc || r.indirect.mode == IndirectMode::ltc_outgoing || r.indirect.mode == IndirectMode::ggx;
  const bool samples = r.method == "sampled" || path;
  const bool frames = !options.frames.empty();  // a part of a sequence has whole frames
  const char* bounce = "--indirect ltc, ltc-outgoing or ggx";
  verb.refuse_without_effect(
      {{"--spp", samples, "--method sampled or --indirect path"},
       {"--target-error", r.method == "reference", "--method reference"},
       {"--terminator", r.shadows != Shadows::off, "--shadows on or exact"},
       {"--peak-form", r.method == "lorentzian" || r.method == "pearson" || r.method == "ellipsoid",
        "--method lorentzian, pearson or ellipsoid"},
       {"--early-stop", r.method == "arvo", "--method arvo"},
       {"--light-error", r.lights != LightSum::all, "--lights auto or tree"},
       {"--device", options.render.backend == Backend::vulkan, "--backend vulkan"},
       {"--resume", (samples || r.method == "reference") && options.frames.empty(), "--method reference or sampled, or --indirect path"},
       {"--vpls", points, bounce},
       {"--indirect-pairs", points, bounce},
       {"--indirect-clamp", points, bounce},
       {"--indirect-shadows", points, bounce},
       {"--indirect-quads", ltc, "--indirect ltc"},
       {"--fps", !options.frames.empty(), "--frames"},
       {"--animation", !options.frames.empty(), "--frames"},
       {"--force", !options.frames.empty(), "--frames"},
       {"--stats", options.frames.empty(), "one picture, not --frames"},
       {"--part", frames || r.indirect.mode == IndirectMode::off, "no --indirect"},
       {"--part", frames || r.backend == Backend::cpu, "--backend cpu"},
       {"--part", frames || r.time_limit == 0, "no --time-limit"},
       {"--part", frames || options.output.ends_with(".exr"), "-o FILE.exr; steradian merge joins the parts"},
       {"--part", frames || options.bounces == "0" || samples || r.method == "reference" || r.reflections == 0,
        "--bounces with --reflections 0, since mirrors blur over the whole picture"},
       {"--bounces", r.indirect.mode == IndirectMode::off, "no --indirect"},
       {"--bounce-error", options.bounces != "0" && !samples && r.method != "reference", "--bounces, by a method without samples"},
       {"--bounce-strict", options.bounces != "0" && !samples && r.method != "reference", "--bounces, by a method without samples"},
       {"--bound", options.bounces != "0" && !samples && r.method != "reference", "--bounces, by a method without samples"},
       {"--reflections", options.bounces != "0" && !samples && r.method != "reference", "--bounces, by a method without samples"},
       {"--shadow-error", !samples && r.method != "reference" && r.shadows == Shadows::on, "--shadows on, by a method without samples"},
       {"--time-limit", r.method != "sampled" && r.method != "reference", "a method without samples"},
       {"--time-limit", r.shadows != Shadows::off, "--shadows on or exact"},
       {"--time-limit", r.indirect.mode == IndirectMode::off && options.bounces == "0", "direct light, without --bounces and --indirect"}});
  verb.refuse({"--moments", "--occluders", "--normal-map", "--lamp-height", "--bounce-lattice", "--edits"}, "a plane scene (.svg)");
}

// Refuses options without effect in the plane, such as those of three dimensions.
void refuse_unused_in_plane(const Verb& verb, const RenderArguments& options) {
  const std::string& method = options.render.method;
  const char* third = "a scene in three dimensions (.gltf, .glb)";
  verb.refuse({"--quality",    "--table",        "--peak-form",        "--early-stop",     "--terminator",     "--multiple-scattering",
               "--indirect",   "--vpls",         "--indirect-shadows", "--indirect-pairs", "--indirect-quads", "--indirect-clamp",
               "--max-lights", "--light",        "--lights",           "--light-error",    "--environment",    "--environment-rotation",
               "--background", "--light-units",  "--camera",           "--target-error",   "--resume",         "--animation",
               "--time-limit", "--bounce-error", "--bounce-strict",    "--bound",          "--reflections",    "--shadow-error"},
              third);
  verb.refuse_without_effect(
      {{"--shadows", options.render.shadows != Shadows::off, third},
       {"--device", options.render.backend == Backend::vulkan, "--backend vulkan"},
       {"--spp", method == "sampled" || method == "marched", "--method sampled or marched"},
       {"--moments", options.output.ends_with(".exr") && options.plane.normal_map.empty(), "-o FILE.exr, without --normal-map"},
       {"--normal-map", (method == "auto" || method == "exact") && options.frames.empty(), "--method exact, without --frames"},
       {"--lamp-height", !options.plane.normal_map.empty(), "--normal-map"},
       {"--occluders", options.plane.normal_map.empty(), "a light map, not --normal-map"},
       {"--bounces", (method == "auto" || method == "exact") && options.frames.empty(), "--method exact, without --frames"},
       {"--frames", method == "auto" || method == "exact", "--method exact"},
       {"--part", !options.frames.empty(), "--frames"},
       {"--bounce-lattice", options.bounces != "0", "--bounces"},
       {"--edits", !options.frames.empty(), "--frames"},
       {"--fps", !options.frames.empty(), "--frames"},
       {"--force", !options.frames.empty(), "--frames"},
       {"--stats", options.frames.empty(), "one picture, not --frames"}});
}

// A plane scene has its own size, one unit per pixel, and its own methods.
void run_plane(RenderArguments& options) {
  PlaneRender job = options.plane;
  job.scene = options.scene;
  job.output = options.output;
  job.method = options.render.method;
  job.stats = options.stats;
  job.limits = options.load.limits;
  job.tone = options.tone;
  job.exposure = exposure_stops(options.exposure).value_or(0.0f);  // light maps keep their scale from frame to frame
  if (options.size != kDefaultSize) {
    parse_size(options.size, options.render);
    job.frame.width = options.render.width;
    job.frame.height = options.render.height;
  }
  job.bounces = bounces_of(options.bounces);
  job.frames = options.frames;
  if (!options.part.empty()) job.part = part_named(options.part);
  job.fps = options.fps;
  job.force = options.force;
  job.vulkan = options.render.backend == Backend::vulkan;
  job.device = options.render.device;
  job.frame.aa = options.render.aa;
  job.frame.threads = options.render.threads;
  job.frame.sampling = {options.spp_given ? options.render.spp : 64, options.render.seed};
  render_plane_scene(job);
}

void run(const Verb& verb, RenderArguments& options) {
  RenderOptions& render_options = options.render;
  if (is_plane_scene(options.scene)) {
    refuse_unused_in_plane(verb, options);
    return run_plane(options);
  }
  if (!method_of(render_options.method)) throw WrongOption("--method", render_options.method + " is for plane scenes (.svg)");
  parse_size(options.size, render_options);
  refuse_unused_in_space(verb, options);
  render_options.bounces = bounces_of(options.bounces);
  const std::optional<float> fixed_exposure = exposure_stops(options.exposure);
  parse_indirect_shadows(options);
  LoadOptions& load = options.load;
  load.near_origin = true;
  load.aspect = static_cast<double>(render_options.width) / render_options.height;
  for (const std::string& light : options.lights) load.lights.push_back(*words::find<AddedLight>(light));
  const Part part = options.part.empty() ? Part{} : part_named(options.part);
  if (!options.frames.empty())
    return render_scene_frames({options.scene, options.output, frame_range(options.frames), part, options.fps, options.animation,
                                options.force, load, render_options, fixed_exposure, options.tone, options.multiple_scattering});
  render_options.part = {part.number, part.count};
  const auto start = std::chrono::steady_clock::now();
  LoadedScene loaded = load_scene(options.scene, load);
  const double load_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (render_options.time_limit > 0) {
    constexpr double kToWrite = 0.3e-6;  // seconds a pixel: an .exr with a layer takes 0.25 s at 1280x720
    const double rest = load_ms * 1e-3 + kToWrite * render_options.width * render_options.height;
    render_options.time_limit = std::max(render_options.time_limit - rest, 1e-3);
  }
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}\n", warning);
  say_direct_only(loaded.scene, render_options);

  for (const char* option : {"--background", "--environment-rotation"})
    verb.refuse_without_effect({{option, loaded.scene.environment != nullptr, "--environment, or a file with one"}});
  loaded.scene.multiple_scattering = options.multiple_scattering;

  std::optional<Progress> progress(std::in_place, "render", 1000);
  render_options.progress = [&](std::uint64_t done, std::uint64_t total) {
    progress->reach(static_cast<double>(done) / static_cast<double>(total));
  };
  RenderStats stats;
  std::optional<StopSignals> signals;
  if (samples(options)) render_options.stop = &signals.emplace().asked();
  const std::string identity = samples(options) ? identity_of(options, loaded.scene) + options.part : std::string();
  RenderState state = options.resume ? read_state(identity, options.output) : RenderState{};
  Picture picture = rendered(loaded.scene, options, stats, state);
  progress.reset();
  if (!state.complete) {
    write_state(state, identity, options.output);
    fmt::print(stderr, "steradian: interrupted; {} of {} tiles are kept in {}: the same command with --resume goes on\n",
               std::count(state.done.begin(), state.done.end(), 1), state.done.size(), partial_path(options.output));
    signals->end_by_it();
  }
  for (const std::string& warning : stats.warnings) fmt::print(stderr, "warning: {}\n", warning);

  if (stats.shadows_estimated > 0)
    fmt::print(stderr, "steradian: --shadow-error: rays estimate {:.1f} % of the shadows, within {:g} % of each pixel's light\n",
               100 * stats.shadows_estimated, 100 * render_options.shadow_error);

  if (stats.exact_tiles < 1)
    fmt::print(
        stderr,
        "steradian: --time-limit: {:.0f} % of the tiles are exact; a few rays estimate the shadows of the others, within {:.2g} % rms\n",
        100 * stats.exact_tiles, 100 * stats.estimated_shadow_error);

  if (stats.patches > 0)
    fmt::print(stderr, "steradian: --bounces: {} patches, {} iterations; the light between surfaces is estimated to {:.2g} % rms\n",
               stats.patches, stats.bounce_iterations, 100 * stats.bounce_error);
  constexpr double kNamed = 1e-3;
  if (stats.bounce_glossy >= kNamed)
    fmt::print(stderr,
               "steradian: --bounces: glossy surfaces send {:.2g} % of it on; {:.2g} % goes evenly to all directions, and the estimate "
               "leaves that "
               "out\n",
               100 * stats.bounce_glossy, 100 * stats.bounce_glossy_evenly);
  if (stats.patches > 0 && stats.bounce_left_out < 0)
    fmt::print(stderr, "warning: --bounces: surfaces that reflect all light keep it; no bound of the bounces left out is known\n");

  if (stats.bound_elements > 0)
    fmt::print(
        stderr,
        "steradian: --bound: {} sides; the bounds are on average {:.2g} % of the light from their middle, and {:.4g} % of the pixels "
        "lie between them\n",
        stats.bound_elements, 100 * stats.bound_mean, 100 * stats.bound_inside);

  if (loaded.scene.environment && stats.method != "sampled" && stats.method != "reference")
    fmt::print(
        stderr,
        "steradian: environment: {:.1f} % of its light as polygons, diffuse light of the rest within {:.2g} % rms, rough metal within "
        "{:.2g} % rms, shadows of the rest within {:.2g} % rms\n",
        100 * stats.environment_spots, 100 * stats.diffuse_residual, 100 * stats.specular_residual, 100 * stats.environment_shadow_error);

  const float exposure = fixed_exposure.value_or(auto_exposure(picture));
  if (!fixed_exposure && options.output.ends_with(".png")) fmt::print(stderr, "steradian: --exposure {:.2f} (auto)\n", exposure);
  picture.metadata = {{"steradian.version", version()},
                      {"steradian.scene", options.scene},
                      {"steradian.method", stats.method},
                      {"steradian.shadows", words::name_of(render_options.shadows)},
                      {"steradian.terminator", words::name_of(render_options.terminator)},
                      {"steradian.size", options.size},
                      {"steradian.aa", std::to_string(render_options.aa)},
                      {"steradian.seed", std::to_string(render_options.seed)},
                      {"steradian.exposure", fmt::format("{}", exposure)},
                      {"steradian.tone", name_of(options.tone)}};
  if (render_options.shadow_error > 0 && picture.layers.count("shadow_bound") != 0)
    picture.metadata["steradian.shadow_error"] = fmt::format("{}", render_options.shadow_error);
  if (render_options.time_limit > 0) {
    picture.metadata["steradian.exact_tiles"] = fmt::format("{}", stats.exact_tiles);
    picture.metadata["steradian.estimated_shadow_error"] = fmt::format("{}", stats.estimated_shadow_error);
  }
  if (stats.light_tree) picture.metadata["steradian.light_error"] = fmt::format("{}", render_options.light_error);
  if (!options.part.empty()) {
    picture.metadata["steradian.part"] = options.part;
    picture.metadata[part_facts::kSettings] = settings_of(options, loaded.scene);
    if (!fixed_exposure) picture.metadata["steradian.exposure"] = part_facts::kAutoExposure;
  }
  image::encode_exr_with(stats.threads);
  write_picture(picture, options.output, exposure, options.tone);
  stats.passes.insert(stats.passes.begin(), {{"load", load_ms - loaded.texture_ms}, {"textures", loaded.texture_ms}});
  stats.total_ms += load_ms;
  if (!options.stats.empty()) write_file(options.stats, stats_json(options, stats).dump(2) + "\n");
  if (options.resume) std::filesystem::remove(partial_path(options.output));
}

}  // namespace

void add_render(CommandLine& line) {
  auto options = std::make_shared<RenderArguments>();
  Verb verb = line.verb("render", "Render a scene (.gltf, .glb, .svg) to a picture (.exr linear, .png tone mapped)");
  verb.group("Pictures");
  verb.footer("`steradian methods` lists the methods with their errors.");
  RenderOptions& r = options->render;
  r.shadows = Shadows::on;
  verb.add("SCENE", options->scene, "scene file").required();
  verb.add("-o,--output", options->output, "picture: .exr (linear) or .png (tone mapped)").writes(Writes::picture).required();

  verb.add("--method", r.method, "method of the specular lobe; see `steradian methods`")
      .check([](const std::string& name) { return unknown_method(name, true); })
      .suggests(method_names())
      .group("Light");
  verb.add_word("--quality", r.quality, "accuracy of the method").group("Light");
  verb.add_word("--peak-form", r.peak_form, "f of lorentzian, pearson and ellipsoid").group("Light");
  verb.add("--early-stop", r.early_stop, "arvo: fraction of an edge's sum to leave out (0: none)").range(0.0, 1.0).group("Light");
  verb.add("--table", r.table, "a fitted lobe instead of GGX (.json of `steradian fit`)").group("Light");
  verb.add_flag("--multiple-scattering", options->multiple_scattering, "add the energy that single scattering by GGX loses").group("Light");
  verb.add_word("--shadows", r.shadows, "direct shadows; exact has no fallback to rays").group("Light");
  verb.add("--shadow-error", r.shadow_error, "dim lights may miss this fraction of a pixel; 0: exact").range(0.0, 1.0).group("Light");
  verb.add_word("--terminator", r.terminator, "shadow edge of curved meshes on themselves").group("Light");
  verb.add_word("--indirect", r.indirect.mode, "one bounce of light").group("Light");
  verb.add("--bounces", options->bounces, "light between surfaces: number of bounces, or all").check(unknown_bounces).group("Light");
  verb.add("--bounce-error", r.bounce_error, "of --bounces: standard error to aim at; 0: by --quality").range(0.0, 1.0).group("Light");
  verb.add_flag("--bound", r.bound, "of --bounces: layers lower and upper, a proof for flat diffuse scenes").group("Light");
  verb.add_flag("--bounce-strict", r.bounce_strict, "of --bounces: each pixel by itself, in 16 times the directions").group("Light");
  verb.add("--reflections", r.reflections, "of --bounces: mirrors in a row").range(0, 16).group("Light");
  verb.add_word("--lights", r.lights, "sum of diffuse lights; tree groups far ones").group("Light");
  verb.add("--light-error", r.light_error, "largest relative error of a light in the tree").range(1e-6, 1.0).group("Light");
  verb.add("--light", options->lights, "extra light; may be repeated").words(words::names<AddedLight>()).group("Light");
  add_environment(verb, options->load);

  verb.add("--size", options->size, "WIDTHxHEIGHT in pixels").group("Picture");
  verb.add("--aa", r.aa, "primary samples a pixel").range(1, 4096).group("Picture");
  verb.add("--camera", r.camera, "name of the camera; default: the file's first").group("Picture");
  verb.add_word("--background", r.background, "show the environment").group("Picture");
  verb.add("--exposure", options->exposure, "of .png: stops, or auto for middle grey in the mean").group("Picture");
  verb.add_word("--tone", options->tone, "of .png: tone curve").group("Picture");

  verb.add("--spp", r.spp, "of sampled: sample pairs a light").range(1, 1 << 20).group("Sampling");
  verb.add("--target-error", r.target_error, "of reference: relative rms error").range(1e-6, 1.0).group("Sampling");
  verb.add("--seed", r.seed, "seed of the random numbers").group("Sampling");
  verb.add_flag("--resume", options->resume, "continue an interrupted sampled, reference or path render").group("Sampling");

  verb.add("--frames", options->frames, "A..B: frames of an animation, numbered by the #s of -o").group("Frames");
  verb.add("--fps", options->fps, "frames a second").range(1e-3, 1e6).group("Frames");
  verb.add("--animation", options->animation, "name of the animation; default: the file's first").group("Frames");
  verb.add_flag("--force", options->force, "render frames again whose files exist").group("Frames");

  verb.add_word("--backend", r.backend, "where to compute").group("Machine");
  verb.add("--device", r.device, "of vulkan: number or part of the name in `steradian info`").group("Machine");
  verb.add("--threads", r.threads, "number of threads (0: all)").range(0, 4096).group("Machine");
  verb.add("--time-limit", r.time_limit, "seconds for the picture; 0: no limit").range(0.0, 1e6).group("Machine");
  verb.add("--part", options->part, "k/n: one of n parts, an .exr for steradian merge; or its --frames").group("Machine");
  verb.add("--stats", options->stats, "write times and counts of the passes to this JSON file").writes(Writes::file).group("Machine");

  verb.add("--vpls", r.indirect.virtual_lights, "number of virtual lights").range(64, 1 << 22).more("Bounce");
  verb.add("--indirect-shadows", options->indirect_shadows, "visibility by 1 to 64 rays a pixel, or off").more("Bounce");
  verb.add("--indirect-pairs", r.indirect.kept_pairs, "mean virtual lights a pixel; 0: all").range(0.0, 1e9).more("Bounce");
  verb.add_word("--indirect-quads", r.indirect.quads, "of ltc: quads for alpha below 0.1").more("Bounce");
  verb.add_word("--indirect-clamp", r.indirect.soften, "bound near virtual lights by their area").more("Bounce");

  verb.add("--bounce-lattice", options->plane.lattice, "interpolate bounces within this error; 0: never")
      .range(0.0, 1.0)
      .group("Plane scenes (.svg)");
  verb.add_flag("--moments", options->plane.frame.moments, "add the layers moment_x and moment_y (.exr)").group("Plane scenes (.svg)");
  verb.add("--normal-map", options->plane.normal_map, "light this normal map (.png, .exr; green upwards)").group("Plane scenes (.svg)");
  verb.add("--lamp-height", options->plane.lamp_height, "of --normal-map: degrees above the plane")
      .range(0.0, 90.0)
      .group("Plane scenes (.svg)");
  verb.add_word("--occluders", options->plane.frame.occluders, "colour of occluders").group("Plane scenes (.svg)");
  verb.add("--edits", options->plane.edits, "JSON file of what changes before which frame").group("Plane scenes (.svg)");

  verb.add("--max-lights", options->load.max_lights, "area lights kept, strongest first (256 and meshes)").range(1, 1 << 20).more("Limits");
  verb.add_word("--light-units", options->load.light_units, "unit of punctual lights").more("Limits");
  verb.add_limits(options->load.limits);
  verb.callback([options, verb] {
    options->spp_given = verb.given("--spp");
    run(verb, *options);
  });
}

}  // namespace steradian::app
