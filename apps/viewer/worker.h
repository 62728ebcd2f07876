// Worker: renders the pictures of a window in a separate thread. The window submits requests and continues; it polls for results.
//
// While things move, the answer is a picture of a half, a quarter or less of the size, small enough for a thirtieth of a second. It is
// allowed to finish, because otherwise every step of a drag would cancel the previous step's picture. At rest pictures of rising size
// follow. The last of them equals that of `render`. A new request cancels them. A reference beside it (method `reference`) then improves as
// long as there is no new request. Sorted data of one picture is cached for the next (LoadOptions::meshes, RenderCache).
//
// With bounces, the first picture at rest has direct light alone, then comes a preview of all light, then all light. While things move,
// pictures are previews of the size that a sixth of a second allows. If even small ones take more than half a second, they have direct
// light.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "accumulation.h"
#include "scene/gltf/gltf_file.h"
#include "steradian/load_scene.h"
#include "steradian/render_cache.h"

namespace steradian::view {

struct RenderRequest {
  scene::GltfFile file;
  std::uint64_t revision = 0;          // the file's; a different number makes the worker read it again
  std::uint64_t source = 0;            // a different number means that its pictures differ, too
  std::optional<Camera> camera;        // none: the file's
  RenderOptions options;               // options of the full-size picture
  std::optional<RenderOptions> other;  // a second picture of the same scene, for a comparison
  bool moving = false;
  bool refine = false;  // the last request again, at rest: its small picture exists
};

// The light of a picture. preview: all light with few patches and directions.
enum class ShownLight { direct, preview, all };

struct RenderedFrame {
  std::uint64_t request = 0;                 // number of the submit that it answers, from 1 on
  std::shared_ptr<const LoadedScene> scene;  // its cameras may change: read only `camera`
  Camera camera;
  Picture picture, other;
  RenderStats stats, other_stats;
  int divisor = 1;  // the full size over this picture's
  ShownLight light = ShownLight::all;
  bool last = false;          // no frame follows until the next request
  double load_ms = 0;         // 0: the scene was loaded already
  bool same = false;          // equal to the frame before, except for `other`
  std::uint64_t pairs = 0;    // pairs of samples per light and pixel of an accumulated `other`; 0: it is not accumulated
  double standard_error = 0;  // error of `other`, see Accumulation::relative_error
  std::string device_lost;    // error of the device that the options name; the CPU rendered this frame, and will render all that follow
  std::string error;          // set instead of all other members
};

// The time of a picture with a divisor: a fixed part that depends on the scene alone, and the pixels.
struct Cost {
  double fixed_ms = 0, pixels_ms = 0;
  int divisor = 0;  // 0: nothing was rendered yet
};
// The divisor of a picture that takes no more than the given time: 1, 2, 4 or 8.
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
  void wait();                          // until there is a frame, or no work

 private:
  struct Job {
    RenderRequest request;
    std::uint64_t number = 0;
  };
  void run();
  void answer(const Job& job);
  bool load(const Job& job, RenderedFrame& frame);
  struct Step {
    ShownLight light;
    int divisor;
    bool operator==(const Step&) const = default;
  };
  Cost cost_of(ShownLight light) const;  // the lesser of the last two: the machine may have delayed one picture
  Step first_step(const RenderRequest& request) const;
  std::vector<Step> further_steps(const RenderRequest& request, Step first) const;
  bool show(const Job& job, RenderedFrame& frame, Step step);  // false: cancelled
  bool render_one(const RenderOptions& options, RenderedFrame& frame, Picture& picture, RenderStats& stats);
  bool add_pass(const Job& job, RenderedFrame& frame, Step step, int pairs);  // to a reference beside the picture
  void accumulate(const Job& job, RenderedFrame frame);                       // until a new request, or until it is good enough
  void publish(RenderedFrame frame);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::optional<RenderedFrame> done_;
  std::atomic<bool> cancel_{false};
  bool refining_ = false, busy_ = false, quit_ = false;
  std::uint64_t submitted_ = 0;

  // Members of the thread.
  std::shared_ptr<LoadedScene> scene_;
  std::uint64_t revision_ = 0, source_ = 0;
  std::shared_ptr<DecodedPictures> pictures_;
  std::shared_ptr<KeptMeshes> meshes_;
  RenderCache cache_;
  Accumulation accumulation_;
  std::string device_lost_;
  struct Measured {
    Cost last, before;
  };
  std::array<Measured, 3> costs_;  // by light

  const Render render_;
  std::thread thread_;
};

}  // namespace steradian::view
