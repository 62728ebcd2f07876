// steradian view SCENE: the scene in a window.
#include <memory>

#include "../viewer/window/window.h"
#include "render/picture_options.h"
#include "verbs.h"

namespace steradian::app {
namespace {

struct ViewArguments {
  std::string size = "1280x720", exposure = "auto", bounces = "all";
  view::WindowOptions window;
};

void run(ViewArguments& options) {
  view::WindowOptions& window = options.window;
  const PictureSize size = picture_size(options.size);
  window.render.width = size.width;
  window.render.height = size.height;
  window.render.bounces = bounces_of(options.bounces);
  if (window.render.backend == Backend::vulkan) {  // this backend has neither here
    window.render.shadows = Shadows::off;
    window.render.bounces = 0;
  }
  window.exposure = exposure_stops(options.exposure);
  view::run_window(window);
}

}  // namespace

void add_view(CommandLine& line) {
  auto options = std::make_shared<ViewArguments>();
  view::WindowOptions& window = options->window;
  window.render.shadows = Shadows::on;
  Verb verb = line.verb("view", "Open a scene in a window and move its lights by hand");
  verb.group("Pictures");
  verb.footer("F1 in the window lists its keys. docs/view-scripts.md describes scripts.");
  verb.add("SCENE", window.scene, "scene file (.gltf, .glb, .svg)").required();
  verb.add("--size", options->size, "WIDTHxHEIGHT of the window in pixels");
  verb.add("--method", window.render.method, "method of the specular lobe").check([](const std::string& name) {
    return unknown_method(name, false);
  });
  verb.add_word("--quality", window.render.quality, "accuracy of the method");
  verb.add_word("--shadows", window.render.shadows, "direct shadows; exact has no fallback to rays");
  verb.add("--bounces", options->bounces, "light between surfaces: number of bounces, or all").check(unknown_bounces);
  verb.add("--camera", window.render.camera, "name of the camera; default: the file's first");
  verb.add("--exposure", options->exposure, "stops, or auto for middle grey in the first picture");
  verb.add_word("--tone", window.tone, "tone curve");
  verb.add("--aa", window.render.aa, "primary samples a pixel, at rest").range(1, 4096);
  verb.add_word("--backend", window.render.backend, "where to compute");
  verb.add("--device", window.render.device, "of vulkan: number or part of the name in `steradian info`");
  verb.add("--threads", window.render.threads, "number of threads (0: all)").range(0, 4096);
  verb.add_word("--panel", window.panel, "open the panel");
  verb.add("--script", window.script, "play this file of drags, keys and pictures");
  verb.add("--record", window.record, "record a script into this file").writes(Writes::file);
  verb.callback([options, verb] {
    verb.refuse_without_effect({{"--bounces", options->window.render.backend == Backend::cpu, "--backend cpu"}});
    run(*options);
  });
}

}  // namespace steradian::app
