// Worker: renders what a window shows, in a thread of its own. The window asks and goes on; what is done it finds when it looks.
//
// A request while things move is answered by a picture of a half, a quarter or less of the size, as small as a thirtieth of a second asks
// for, and is let finish: else a drag would cancel every picture of itself. At rest pictures of rising size follow, the last of which is
// the one that `render` makes; a new request cancels them. A reference beside it (method `reference`) then grows for as long as nothing is
// asked for. What is sorted for one picture is kept for the next (LoadOptions::meshes, RenderCache).
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "accumulation.h"
#include "scene/gltf_file.h"
#include "steradian/load_scene.h"
#include "steradian/render_cache.h"

namespace steradian::view {

struct RenderRequest {
  scene::GltfFile file;
  std::uint64_t revision = 0;          // of the file: another number, and it is read again
  std::uint64_t source = 0;            // another number: its pictures are others, too
  std::optional<Camera> camera;        // none: the file's
  RenderOptions options;               // of the full picture
  std::optional<RenderOptions> other;  // a second picture of the same, for a comparison
  bool moving = false;
  bool refine = false;  // the last request again, at rest: its small picture is there
};

struct RenderedFrame {
  std::uint64_t request = 0;                 // which submit it answers, from 1 on
  std::shared_ptr<const LoadedScene> scene;  // its cameras may change: read them nowhere but in `camera`
  Camera camera;
  Picture picture, other;
  RenderStats stats, other_stats;
  int divisor = 1;            // the full size over this picture's
  bool last = false;          // nothing follows until the next request
  double load_ms = 0;         // 0: the scene was there
  bool same = false;          // but for `other` it is the frame before
  std::uint64_t pairs = 0;    // of samples a light and pixel, of an accumulated `other`; 0: it is none
  double standard_error = 0;  // of it, see Accumulation::relative_error
  std::string device_lost;    // what was wrong with the device that the options name; the CPU has rendered this, and will what follows
  std::string error;          // instead of all this
};

// What a picture of a divisor took: what depends on the scene alone, and the pixels.
struct Cost {
  double fixed_ms = 0, pixels_ms = 0;
  int divisor = 0;  // 0: nothing was rendered yet
};
// The divisor of a picture that shall take no more than the time: 1, 2, 4 or 8.
int divisor_within(double time_ms, const Cost& cost);

class Worker {
 public:
  using Render = std::function<Picture(const Scene&, const RenderOptions&, RenderCache&, RenderStats*, RenderState*)>;
  explicit Worker(Render render = {});  // none: steradian::render
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::uint64_t submit(RenderRequest request);
  std::optional<RenderedFrame> take();  // the newest since the last call
  void wait();                          // until there is one, or nothing to do

 private:
  struct Job {
    RenderRequest request;
    std::uint64_t number = 0;
  };
  void run();
  void answer(const Job& job);
  bool load(const Job& job, RenderedFrame& frame);
  bool show(const Job& job, RenderedFrame& frame, int divisor, bool last);  // false: cancelled
  bool render_one(const RenderOptions& options, RenderedFrame& frame, Picture& picture, RenderStats& stats);
  bool add_pass(const Job& job, RenderedFrame& frame, int divisor, int pairs);  // to a reference beside the picture
  void accumulate(const Job& job, RenderedFrame frame);                         // until something else is asked for, or it is good enough
  void publish(RenderedFrame frame);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::optional<RenderedFrame> done_;
  std::atomic<bool> cancel_{false};
  bool refining_ = false, busy_ = false, quit_ = false;
  std::uint64_t submitted_ = 0;

  // Of the thread.
  std::shared_ptr<LoadedScene> scene_;
  std::uint64_t revision_ = 0, source_ = 0;
  std::shared_ptr<DecodedPictures> pictures_;
  std::shared_ptr<KeptMeshes> meshes_;
  RenderCache cache_;
  Accumulation accumulation_;
  std::string device_lost_;
  Cost cost_;

  const Render render_;
  std::thread thread_;
};

}  // namespace steradian::view
