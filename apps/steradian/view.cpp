// steradian view SCENE: the scene in a window.
#include <memory>

#include "../viewer/window.h"
#include "integrals/methods.h"
#include "picture_options.h"
#include "verbs.h"

namespace steradian::app {
namespace {

struct ViewArguments {
  std::string scene, size = "1280x720", shadows = "on", quality = "normal", exposure = "auto", tone = "neutral", backend = "cpu", script,
                     record, panel = "on";
  RenderOptions render;
};

void run(const ViewArguments& options) {
  view::WindowOptions window;
  window.scene = options.scene;
  window.render = options.render;
  const PictureSize size = picture_size(options.size);
  window.render.width = size.width;
  window.render.height = size.height;
  window.render.shadows = options.shadows == "off" ? Shadows::off : options.shadows == "exact" ? Shadows::exact : Shadows::on;
  window.render.quality = options.quality == "draft" ? Quality::draft : options.quality == "high" ? Quality::high : Quality::normal;
  if (options.backend == "vulkan") {
    window.render.backend = Backend::vulkan;
    window.render.shadows = Shadows::off;  // this backend has no shadows here
  }
  window.exposure = exposure_stops(options.exposure);
  window.tone = tone_curve_named(options.tone);
  window.script = options.script;
  window.record = options.record;
  window.panel = options.panel == "on";
  view::run_window(window);
}

}  // namespace

void add_view(CommandLine& line) {
  auto options = std::make_shared<ViewArguments>();
  Verb verb = line.verb("view", "Open a scene in a window and move its lights by hand");
  verb.group("Pictures");
  verb.footer("F1 in the window lists its keys. docs/view-scripts.md describes scripts.");
  verb.add("SCENE", options->scene, "scene file (.gltf, .glb, .svg)").required();
  verb.add("--size", options->size, "WIDTHxHEIGHT of the window in pixels");
  verb.add("--method", options->render.method, "method of the specular lobe").check([](const std::string& name) {
    return method_of(name) ? std::string() : "unknown method " + name + ", use " + methods::names();
  });
  verb.add("--quality", options->quality, "accuracy of the method").words({"draft", "normal", "high"});
  verb.add("--shadows", options->shadows, "direct shadows; exact has no fallback to rays").words({"off", "on", "exact"});
  verb.add("--camera", options->render.camera, "name of the camera; default: the file's first");
  verb.add("--exposure", options->exposure, "stops, or auto for middle grey in the first picture");
  verb.add("--tone", options->tone, "tone curve").words(tone_curve_names());
  verb.add("--aa", options->render.aa, "primary samples a pixel, at rest").range(1, 4096);
  verb.add("--backend", options->backend, "where to compute").words({"cpu", "vulkan"});
  verb.add("--device", options->render.device, "of vulkan: number or part of the name in `steradian info`");
  verb.add("--threads", options->render.threads, "number of threads (0: all)").range(0, 4096);
  verb.add("--panel", options->panel, "open the panel").words({"on", "off"});
  verb.add("--script", options->script, "play this file of drags, keys and pictures");
  verb.add("--record", options->record, "record a script into this file");
  verb.callback([options] { run(*options); });
}

}  // namespace steradian::app
