// steradian view SCENE: the scene in a window.
#include <memory>

#include "integrals/methods.h"
#include "picture_options.h"
#include "steradian/error.h"
#include "verbs.h"
#ifdef STERADIAN_WINDOW
#include "../viewer/window.h"
#endif

namespace steradian::app {
namespace {

struct Options {
  std::string scene, size = "1280x720", shadows = "on", quality = "normal", exposure = "auto", tone = "neutral", backend = "cpu", script,
                     record, panel = "on";
  RenderOptions render;
};

#ifdef STERADIAN_WINDOW
void run(const Options& options) {
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
    window.render.shadows = Shadows::off;  // which it does not have
  }
  window.exposure = exposure_stops(options.exposure);
  window.tone = tone_curve_named(options.tone);
  window.script = options.script;
  window.record = options.record;
  window.panel = options.panel == "on";
  view::run_window(window);
}
#else
void run(const Options&) {
  throw Error("view", "this program was built without a window", "install libglfw3-dev and libimgui-dev, then configure and build again");
}
#endif

}  // namespace

void add_view(CLI::App& app, Exit&) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("view", "Open a scene in a window: light that can be taken in the hand");
  verb->footer("F1 in the window lists its keys. A script is a JSON object a line, as docs/view.md describes.");
  verb->add_option("SCENE", options->scene, "scene file (.gltf, .glb, .svg)")->required();
  verb->add_option("--size", options->size, "WIDTHxHEIGHT of the window in pixels");
  verb->add_option("--method", options->render.method, "how specular light is done, as in render")
      ->check(CLI::Validator(
          [](std::string& name) { return method_of(name) ? std::string() : "unknown method " + name + ", use " + methods::names(); }, ""));
  verb->add_option("--quality", options->quality, "as in render")->check(CLI::IsMember({"draft", "normal", "high"}));
  verb->add_option("--shadows", options->shadows, "as in render")->check(CLI::IsMember({"off", "on", "exact"}));
  verb->add_option("--camera", options->render.camera, "camera by name; none: the first");
  verb->add_option("--exposure", options->exposure, "stops, or auto: middle grey in the mean of the first picture");
  verb->add_option("--tone", options->tone, "the curve from radiance to the screen, as in render")
      ->check(CLI::IsMember(tone_curve_names()));
  verb->add_option("--aa", options->render.aa, "primary samples a pixel, at rest")->check(CLI::Range(1, 4096));
  verb->add_option("--backend", options->backend, "Where to compute: docs/vulkan.md")->check(CLI::IsMember({"cpu", "vulkan"}));
  verb->add_option("--device", options->render.device, "of vulkan: its number in `steradian info`, or part of its name; none: the first");
  verb->add_option("--threads", options->render.threads, "0: all")->check(CLI::Range(0, 4096));
  verb->add_option("--panel", options->panel, "whether the panel is open")->check(CLI::IsMember({"on", "off"}));
  verb->add_option("--script", options->script, "play what a file says: drags, keys, pictures of the window");
  verb->add_option("--record", options->record, "write what is done to a file that --script plays");
  verb->callback([options] { run(*options); });
}

}  // namespace steradian::app
