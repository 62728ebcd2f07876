// steradian bake SCENE -o SCENE
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bake/bake.h"
#include "bake/baked_file.h"
#include "bake/light_groups.h"
#include "bake/map_preview.h"
#include "bake/scene_to_bake.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/simd.h"
#include "core/words.h"
#include "render/picture_options.h"
#include "render/resume.h"
#include "part.h"
#include "steradian/version.h"
#include "command_line.h"
#include "verbs.h"
#include "wrong_use.h"

namespace steradian::app {
namespace {

struct BakeArguments {
  std::string scene, output, bounces = "all", direct = "on", target = "texture", encoding = "rgbm", preview, stats, part;
  std::vector<std::string> groups;
  bool resume = false;
  LoadOptions load;
  bake::BakeOptions bake;
};

nlohmann::ordered_json stats_json(const BakeArguments& options, const bake::LightMap& map, const bake::BakeStats& stats) {
  return {{"version", version()},
          {"command", command_line()},
          {"width", map.width},
          {"height", map.height},
          {"charts", stats.charts},
          {"cut_planes", stats.cut},
          {"seams", stats.seams},
          {"texels", stats.texels},
          {"samples", stats.samples},
          {"patches", stats.patches},
          {"mean_irradiance", stats.mean},
          {"rms_residual", stats.rms_residual},
          {"rms_bounce_error", stats.rms_error},
          {"largest_seam", stats.largest_seam},
          {"shadow_fallback", stats.shadow_fallback},
          {"solve_ms", stats.solve_ms},
          {"light_ms", stats.sample_ms},
          {"fit_ms", stats.fit_ms},
          {"total_ms", stats.total_ms},
          {"threads", options.bake.light.threads}};
}

// Everything else that the texels depend on. The parts of one map agree in it.
std::string settings_of(const BakeArguments& options) {
  const RenderOptions& r = options.bake.light;
  const LoadOptions& load = options.load;
  return fmt::format("{} | bounces {} {}{} | {} | shadows {} | environment {} {} | lights {} {}", name_of(active_simd()), options.bounces,
                     r.bounce_error, r.bounce_strict ? " strict" : "", words::name_of(r.quality), words::name_of(r.shadows),
                     load.environment, load.environment_rotation, load.max_lights.value_or(0), words::name_of(load.light_units));
}

// Everything that the map depends on.
std::string identity_of(const BakeArguments& options, const Scene& scene) {
  const bake::BakeOptions& b = options.bake;
  std::string identity = fmt::format("{} | {} | {} | texels {} | direct {} | {} | part {}/{}", version(),
                                     fingerprint({options.scene, options.load.environment}, scene), settings_of(options), b.texels,
                                     options.direct, options.target, b.part, b.parts);
  for (const std::string& group : options.groups) identity += " | group " + group;
  return identity;
}

void parse_part(BakeArguments& options) {
  if (options.part.empty()) return;
  const Part part = part_named(options.part);
  bake::BakeOptions& bake = options.bake;
  bake.part = static_cast<std::size_t>(part.number);
  bake.parts = static_cast<std::size_t>(part.count);
  if (bake.target == bake::BakeTarget::vertex) throw WrongOption("--part", "is for --target texture");
  if (!options.groups.empty()) throw WrongOption("--part", "is for one map, not for --group");
}

void write_map(const BakeArguments& options, const bake::LightMap& map, const std::string& path) {
  Picture picture = bake::picture_of(map);
  picture.metadata = {{"steradian.version", version()},
                      {"steradian.scene", options.scene},
                      {"steradian.bounces", options.bounces},
                      {"steradian.direct", options.direct},
                      {"steradian.encoding", options.encoding},
                      {"steradian.texels", fmt::format("{}", options.bake.texels)},
                      {"steradian.settings", settings_of(options)}};
  if (options.bake.parts > 1) picture.metadata["steradian.part"] = fmt::format("{}/{}", options.bake.part, options.bake.parts);
  write_picture(picture, path);
}

void print_summary(const BakeArguments& options, const bake::LightMap& map, const bake::BakeStats& stats) {
  const bool texture = options.bake.target == bake::BakeTarget::texture;
  if (texture) fmt::print("map         {} x {} texels\n", map.width, map.height);
  fmt::print("charts      {}, {} planes cut at contacts\n", stats.charts, stats.cut);
  fmt::print("samples     {}\n", stats.samples);
  fmt::print("mean light  {:.6g}\n", stats.mean);
  fmt::print("residual    {:.2g} % rms of the mean\n", 100 * stats.rms_residual);
  fmt::print("bounces     {:.2g} % rms, estimated\n", 100 * stats.rms_error);
  if (texture) fmt::print("seams       {}, at most {:.2g} % apart\n", stats.seams, 100 * stats.largest_seam);
  fmt::print("time        {:.1f} s: patches {:.1f}, light {:.1f}, fit {:.1f}\n", stats.total_ms * 1e-3, stats.solve_ms * 1e-3,
             stats.sample_ms * 1e-3, stats.fit_ms * 1e-3);
}

void run(const Verb& verb, BakeArguments& options) {
  bake::BakeOptions& bake = options.bake;
  bake.light.bounces = bounces_of(options.bounces);
  bake.direct = options.direct == "on" ? bake::BakedDirect::on : bake::BakedDirect::off;
  if (bake.direct == bake::BakedDirect::off && bake.light.bounces == 0)
    throw WrongOption("--direct", "off leaves no light with --bounces 0");
  bake.target = options.target == "texture" ? bake::BakeTarget::texture : bake::BakeTarget::vertex;
  parse_part(options);
  const bool part = bake.parts > 1;
  if (part ? !options.output.ends_with(".exr") : !options.output.ends_with(".glb") && !options.output.ends_with(".gltf"))
    throw WrongOption("-o", part ? "a part is written as .exr; steradian merge joins them" : "the baked scene is a .glb or .gltf file");
  if (!options.groups.empty() && bake.target == bake::BakeTarget::vertex) throw WrongOption("--group", "is for --target texture");
  if (!options.preview.empty() && !options.preview.ends_with(".glb") && !options.preview.ends_with(".gltf"))
    throw WrongOption("--preview", "the scene that shows the map is a .glb or .gltf file");
  verb.refuse_without_effect({{"--preview", bake.target == bake::BakeTarget::texture && !part, "--target texture, without --part"},
                              {"--bounce-error", bake.light.bounces != 0, "--bounces"},
                              {"--bounce-strict", bake.light.bounces != 0, "--bounces"},
                              {"--encoding", bake.target == bake::BakeTarget::texture, "--target texture"},
                              {"--environment-rotation", !options.load.environment.empty(), "--environment"}});
  LoadOptions& load = options.load;
  const auto start = std::chrono::steady_clock::now();
  const LoadedScene loaded = bake::load_to_bake(options.scene, load);
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const Scene& scene = loaded.scene;

  std::optional<UnfinishedFile> unfinished;
  if (options.resume) bake.unfinished = &unfinished.emplace(options.output + ".part", identity_of(options, scene));
  std::optional<Progress> progress(std::in_place, "bake", 1000);
  bake.progress = [&](double fraction) { progress->reach(fraction); };
  bake::BakeStats stats;
  Budget budget(load.limits);
  const bake::LightMap map =
      options.groups.empty()
          ? bake::bake_map(scene, bake, options.scene, budget, &stats)
          : bake::bake_light_groups(scene, bake::light_groups(scene, options.groups, options.scene), bake, options.scene, budget, stats);
  progress.reset();
  for (const std::string& warning : map.warnings) fmt::print(stderr, "warning: {}\n", warning);

  const std::string exr = part ? options.output : bake::map_beside(options.output);
  if (bake.target == bake::BakeTarget::texture) write_map(options, map, exr);
  if (!part) {
    scene::GltfFile file = scene::read_gltf_file(options.scene, load.limits);
    bake::add_light_map(file, loaded, map, std::filesystem::path(exr).filename().string(), load.limits,
                        bake::encoding_of(options.encoding));
    scene::write_gltf_file(file, options.output);
    if (!options.preview.empty()) scene::write_gltf_file(bake::map_preview(file, map), options.preview);
  }
  if (unfinished) unfinished->remove();
  stats.total_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (!options.stats.empty()) write_file(options.stats, stats_json(options, map, stats).dump(2) + "\n");
  print_summary(options, map, stats);
}

}  // namespace

void add_bake(CommandLine& line) {
  auto options = std::make_shared<BakeArguments>();
  Verb verb = line.verb("bake", "Bake the light of a scene (.gltf, .glb) into a light map without noise");
  verb.group("Pictures");
  verb.footer("The map stands beside the scene as .exr, with an error for each texel, and in it as PNG.");
  RenderOptions& r = options->bake.light;
  r.shadows = Shadows::on;
  verb.add("SCENE", options->scene, "scene file").required();
  verb.add("-o,--output", options->output, "baked scene: .glb or .gltf; its map is the .exr beside it").writes(Writes::file).required();
  verb.add("--target", options->target, "a light map, or the attribute _IRRADIANCE").words({"texture", "vertex"}).group("Map");
  verb.add("--encoding", options->encoding, "PNG of the map: 8 bits a channel, or 16").words({"rgbm", "rgb16"}).group("Map");
  verb.add("--preview", options->preview, "also write a scene that shows the map in any viewer (.glb, .gltf)")
      .writes(Writes::file)
      .group("Map");
  verb.add("--texels", options->bake.texels, "texels a metre").range(bake::kLeastTexels, bake::kMostTexels).group("Map");
  verb.add("--bounces", options->bounces, "light between surfaces: number of bounces, or all").check(unknown_bounces).group("Light");
  verb.add("--group", options->groups, "lights whose names begin so get a map of their own; may be repeated").group("Light");
  verb.add("--direct", options->direct, "light of lamps and environment").words({"on", "off"}).group("Light");
  verb.add_word("--quality", r.quality, "patches and rays of --bounces").group("Light");
  verb.add("--bounce-error", r.bounce_error, "of --bounces: standard error to aim at; 0: by --quality").range(0.0, 1.0).group("Light");
  verb.add_flag("--bounce-strict", r.bounce_strict, "of --bounces: each place by itself, in 16 times the directions").group("Light");
  verb.add_word("--shadows", r.shadows, "direct shadows; exact has no fallback to rays").group("Light");
  add_environment(verb, options->load);
  verb.add("--part", options->part, "k/n: bake one of n parts to an .exr; steradian merge joins them").group("Machine");
  verb.add_flag("--resume", options->resume, "go on after an interruption; keeps finished charts in OUTPUT.part").group("Machine");
  verb.add("--threads", r.threads, "number of threads (0: all)").range(0, 4096).group("Machine");
  verb.add("--stats", options->stats, "write counts, errors and times to this JSON file").writes(Writes::file).group("Machine");
  verb.add("--max-lights", options->load.max_lights, "area lights kept, strongest first (256 and meshes)").range(1, 1 << 20).more("Limits");
  verb.add_word("--light-units", options->load.light_units, "unit of punctual lights").more("Limits");
  verb.add_limits(options->load.limits);
  verb.callback([options, verb] { run(verb, *options); });
}

}  // namespace steradian::app
