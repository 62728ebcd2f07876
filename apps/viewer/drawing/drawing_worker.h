// Draws a scene of the plane in a separate thread. After each change it draws only the parts that the change may reach (PlaneStage).
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "steradian/plane_stage.h"

namespace steradian::view {

struct PlaneEdit {
  enum class Kind { replace, add, remove };
  Kind kind = Kind::replace;
  std::size_t body = 0;
  PlaneBody with{};  // for replace and add
};

struct DrawnPicture {
  std::uint64_t request = 0;
  Picture picture;
  PlaneStageStats stats;
  std::string error;
};

class DrawingWorker {
 public:
  explicit DrawingWorker(int threads);
  ~DrawingWorker();
  DrawingWorker(const DrawingWorker&) = delete;
  DrawingWorker& operator=(const DrawingWorker&) = delete;

  // Requests made while it draws are handled together afterwards. Both functions return the number of the request.
  std::uint64_t show(PlaneScene scene, int width, int height);  // another scene, or size
  std::uint64_t follow(PlaneScene scene);                       // the current scene: only the changed parts are drawn
  std::uint64_t edit(PlaneEdit edit);
  std::optional<DrawnPicture> take();
  void wait();  // until there is a picture, or no work

 private:
  void run();

  const int threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<PlaneScene> scene_, followed_;
  int width_ = 0, height_ = 0;
  std::vector<PlaneEdit> edits_;
  std::uint64_t asked_ = 0, done_ = 0;
  std::optional<DrawnPicture> picture_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace steradian::view
