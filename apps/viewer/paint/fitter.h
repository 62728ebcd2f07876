// Fitter: fits lights to strokes in a separate thread. The window starts it and polls for the lights of its latest step.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scene/gltf/gltf_file.h"
#include "steradian/load_scene.h"
#include "steradian/solve.h"
#include "paint/strokes.h"

namespace steradian::view {

struct FitTask {
  scene::GltfFile file;
  std::vector<PaintStroke> strokes;
  FitChoice choice;
  int node = -1;         // the selected one, for FitChoice::selected
  RenderOptions render;  // shadows, quality and bounces count
};

struct FitNews {
  std::shared_ptr<const LoadedScene> scene;  // to which the changes belong
  std::vector<LightChange> changes;          // empty: none yet
  int step = 0;
  double cost = 0;
  bool ended = false;   // no news follows
  std::string message;  // at the end
};

class Fitter {
 public:
  Fitter() = default;
  ~Fitter();
  Fitter(const Fitter&) = delete;
  Fitter& operator=(const Fitter&) = delete;

  // Neither waits: a fit that runs ends after its present evaluation, and has no news any more.
  void start(FitTask task);
  void stop();
  bool running() const { return wanted_ != ended_; }
  std::optional<FitNews> take();  // the newest since the last call
  void wait();                    // until there are news, if it runs

 private:
  void run();
  void fit(const FitTask& task, std::uint64_t number);
  void tell(FitNews news, std::uint64_t number);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<FitTask> next_;
  std::optional<FitNews> news_;
  std::atomic<std::uint64_t> wanted_{0};  // number of the latest task or stop
  std::uint64_t ended_ = 0;               // number of the latest one whose end was taken
  bool quit_ = false;
  std::thread thread_;  // from the first task on
};

}  // namespace steradian::view
