#include "render/render_frames.h"
#include "render/direct_only.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <vector>

#include "core/progress.h"
#include "scene/gltf/gltf_animation.h"
#include "steradian/error.h"
#include "steradian/picture.h"
#include "steradian/version.h"

namespace steradian::app {
namespace {

using scene::GltfAnimation;
using scene::GltfFile;

GltfAnimation chosen(const GltfFile& file, const SceneFrames& job) {
  std::vector<GltfAnimation> all = read_animations(file, job.load.limits);
  std::string names;
  for (GltfAnimation& animation : all) {
    if (job.animation.empty() || animation.name == job.animation) return std::move(animation);
    names += (names.empty() ? "" : ", ") + animation.name;
  }
  if (job.animation.empty()) throw Error(job.scene, "has no animation", "leave --frames out for a picture of it");
  throw Error("--animation", "none is named '" + job.animation + "'", all.empty() ? "the file has none" : "there are: " + names);
}

// The scene at a moment. The reader's warnings are printed once for all frames.
class SceneMoments {
 public:
  explicit SceneMoments(const SceneFrames& job)
      : job_(job), file_(scene::read_gltf_file(job.scene, job.load.limits)), animation_(chosen(file_, job)) {
    load_.pictures = std::make_shared<DecodedPictures>();
    load_.meshes = make_kept_meshes();
  }

  Scene at(double seconds) {
    GltfFile moment = file_;
    moment.json = json_at(file_.json, animation_, seconds);
    LoadedScene loaded = scene::load_scene(moment, load_);
    for (const std::string& warning : loaded.warnings)
      if (said_.insert(warning).second) fmt::print(stderr, "warning: {}\n", warning);
    if (!said_direct_only_) say_direct_only(loaded.scene, job_.render);
    said_direct_only_ = true;
    loaded.scene.multiple_scattering = job_.multiple_scattering;
    return std::move(loaded.scene);
  }

 private:
  const SceneFrames& job_;
  LoadOptions load_ = job_.load;
  GltfFile file_;
  GltfAnimation animation_;
  std::set<std::string> said_;
  bool said_direct_only_ = false;
};

// The exposure of the first frame at a quarter of its size. It is the same for all frames, even if the first frame exists already.
float exposure_of(const SceneFrames& job, SceneMoments& moments) {
  RenderOptions small = job.render;
  small.width = std::max(1, small.width / 4);
  small.height = std::max(1, small.height / 4);
  small.aa = 1;
  return auto_exposure(render(moments.at(job.range.first / job.fps), small));
}

}  // namespace

void render_scene_frames(SceneFrames job) {
  const std::vector<int> wanted = frames_to_make(job.range, job.output, job.force, job.part);
  if (wanted.empty()) return;

  SceneMoments moments(job);
  const bool mapped = job.output.ends_with(".png");
  const float exposure = job.exposure ? *job.exposure : mapped ? exposure_of(job, moments) : 0.0f;
  if (!job.exposure && mapped) fmt::print(stderr, "steradian: --exposure {:.2f} (auto, of the first frame)\n", exposure);

  constexpr std::uint64_t kParts = 1000;  // progress steps per frame in the common bar
  Progress progress("frames", wanted.size() * kParts);
  RenderCache cache;  // cache for parts of the scene that do not move
  for (const int frame : wanted) {
    const Scene scene = moments.at(frame / job.fps);
    std::atomic<std::uint64_t> shown{0};
    RenderOptions options = job.render;
    options.progress = [&](std::uint64_t done, std::uint64_t total) {
      const std::uint64_t part = total > 0 ? std::min(done * kParts / total, kParts) : 0;
      std::uint64_t before = shown.load();
      while (before < part && !shown.compare_exchange_weak(before, part)) {
      }
      if (before < part) progress.add(part - before);
    };
    RenderStats stats;
    Picture picture = render(scene, options, cache, &stats);
    picture.metadata = {{"steradian.version", version()},
                        {"steradian.scene", job.scene},
                        {"steradian.method", stats.method},
                        {"steradian.frame", std::to_string(frame)},
                        {"steradian.fps", fmt::format("{}", job.fps)},
                        {"steradian.exposure", fmt::format("{}", exposure)}};
    write_picture(picture, numbered(job.output, frame), exposure, job.tone);
    progress.add(kParts - std::min(shown.load(), kParts));
  }
}

}  // namespace steradian::app
