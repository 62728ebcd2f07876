#include "command_line.h"
#include "render/left_out.h"
#include "render/render_plane.h"
#include "render/render_plane_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "core/files.h"
#include "core/progress.h"
#include "core/simd.h"
#include "steradian/error.h"
#include "steradian/plane_animation.h"
#include "steradian/plane_device.h"
#include "steradian/plane_normals.h"
#include "steradian/version.h"

namespace steradian::app {

bool is_plane_scene(const std::string& path) { return path.size() > 4 && (path.ends_with(".svg") || path.ends_with(".SVG")); }

void render_plane_scene(const PlaneRender& job) {
  PlaneSvg loaded = load_plane_scene(job.scene, job.limits);
  // For an animated drawing, animations are skipped only if no frames are requested.
  const bool still = job.frames.empty() || !PlaneAnimation(job.scene, job.limits).moves();
  if (still) say_backdrops(loaded, job.scene);
  for (const std::string& warning : loaded.warnings) fmt::print(stderr, "warning: {}: {}\n", job.scene, warning);
  if (!loaded.ignored.empty() && still) {
    std::string names;
    for (const std::string& name : loaded.ignored) names += (names.empty() ? "" : ", ") + name;
    fmt::print(stderr, "steradian: {}: not supported and left out: {}\n", job.scene, names);
  }
  const auto& bodies = loaded.scene.bodies;
  if (loaded.scene.suns.empty() && std::none_of(bodies.begin(), bodies.end(), [](const PlaneBody& body) { return body.light.has_value(); }))
    fmt::print(stderr,
               "steradian: {}: no light in this file, so the picture is black: give a shape or its group class=\"light\" or "
               "data-steradian=\"light\", or name its layer \"lights\"\n",
               job.scene);
  PlaneFrameOptions options = job.frame;
  options.limits = job.limits;
  try {
    options.method = plane_method_from_name(job.method == "auto" ? "exact" : job.method);
  } catch (const Error& e) {
    throw UsageError("--method", e.problem(), e.hint());
  }
  if (!job.frames.empty()) {
    return render_plane_frames(job, {frame_range(job.frames), job.edits}, options, std::move(loaded.scene));
  }
  std::optional<Picture> normals;
  if (!job.normal_map.empty()) {
    normals = normals_of_map(read_picture(job.normal_map), !job.normal_map.ends_with(".exr"));
    if (options.width == 0) options.width = normals->width, options.height = normals->height;
    if (options.width != normals->width || options.height != normals->height)
      throw UsageError("--size", fmt::format("the normal map has {}x{} pixels", normals->width, normals->height), "leave --size out");
    options.moments = true;
  }
  const PlaneWorld world(std::move(loaded.scene), job.limits);

  std::optional<PlaneBounces> bounces;
  if (job.bounces != 0) {
    PlaneBounceOptions how;
    how.bounces = job.bounces;
    how.limits = job.limits;
    bounces.emplace(world, how);
    options.bounces = &*bounces;
    options.bounce_lattice = job.lattice;
    options.bounce_error = job.output.ends_with(".exr");
  }

  std::optional<Progress> progress(std::in_place, "render", 1000);
  options.progress = [&](std::uint64_t done, std::uint64_t total) {
    progress->reach(static_cast<double>(done) / static_cast<double>(total));
  };
  PlaneFrameStats stats;
  std::optional<PlaneDevice> device;
  if (job.vulkan) device.emplace(job.device);
  Picture picture = device ? device->render(world, options, &stats) : render_plane(world, options, &stats);
  progress.reset();
  if (normals) picture = light_normals(picture, *normals, job.lamp_height * std::numbers::pi / 180);
  picture.metadata = {{"steradian.version", version()},
                      {"steradian.scene", job.scene},
                      {"steradian.method", name_of(options.method)},
                      {"steradian.size", fmt::format("{}x{}", picture.width, picture.height)},
                      {"steradian.aa", std::to_string(options.aa)},
                      {"steradian.spp", std::to_string(options.sampling.spp)},
                      {"steradian.seed", std::to_string(options.sampling.seed)},
                      {"steradian.exposure", fmt::format("{}", job.exposure)}};
  if (bounces) picture.metadata["steradian.bounces"] = job.bounces == kAllBounces ? "all" : std::to_string(job.bounces);
  write_picture(picture, job.output, job.exposure, job.tone);
  if (job.stats.empty()) return;
  nlohmann::ordered_json passes = {{{"name", "prepare"}, {"ms", stats.prepare_ms}}, {{"name", "frame"}, {"ms", stats.frame_ms}}};
  nlohmann::ordered_json json = {{"version", version()},
                                 {"command", command_line()},
                                 {"backend", device ? "vulkan" : "cpu"},
                                 {"device", device ? device->name() : "cpu"},
                                 {"simd", name_of(active_simd())},
                                 {"threads", stats.threads},
                                 {"width", picture.width},
                                 {"height", picture.height},
                                 {"seed", options.sampling.seed},
                                 {"lights", stats.lights},
                                 {"occluders", stats.occluders},
                                 {"tile_lights", stats.tile_lights},
                                 {"tile_blockers", stats.tile_blockers},
                                 {"method", name_of(options.method)},
                                 {"passes", passes},
                                 {"total_ms", stats.prepare_ms + stats.frame_ms}};
  if (device) {
    // Parts of the frame's time. The device's parts come from its own clock.
    const PlaneDeviceStats& d = device->stats();
    const std::pair<const char*, double> parts[] = {{"frame: lists", d.lists_ms},         {"frame: upload", d.upload_ms},
                                                    {"frame: device", d.device_ms},       {"frame: resolve", d.resolve_ms},
                                                    {"device: lists", d.making_lists_ms}, {"device: round lights", d.disks_ms},
                                                    {"device: edges", d.cuts_ms},         {"device: arcs", d.arcs_ms}};
    for (const auto& [name, ms] : parts) json["passes"].push_back({{"name", name}, {"ms", ms}});
    json["tiles"] = {
        {"on_device", d.tiles - d.tiles_of_cpu}, {"on_cpu", d.tiles_of_cpu}, {"lights_listed", d.lights_listed}, {"bytes", d.bytes}};
  }
  if (bounces) {
    const PlaneBounceStats& b = bounces->stats();
    json["bounces"] = {{"elements", b.elements}, {"rounds", b.rounds}, {"sweeps", b.sweeps}, {"ms", b.ms}, {"error", b.error}};
    if (job.lattice > 0) {
      json["bounces"]["lattice_error"] = stats.lattice_error;
      json["bounces"]["lattice_drawn"] = stats.lattice_drawn;
    }
  }
  write_file(job.stats, json.dump(2) + "\n");
}

}  // namespace steradian::app
