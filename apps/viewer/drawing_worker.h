// Draws a scene of the plane in a thread of its own, after each change only what the change may reach (PlaneStage).
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
  PlaneBody with{};  // of replace and add
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

  // What is asked while it draws is done together, after it. Both answer with the number of the request.
  std::uint64_t show(PlaneScene scene, int width, int height);  // another scene, or size
  std::uint64_t follow(PlaneScene scene);                       // the scene as it is now: only what is another is drawn
  std::uint64_t edit(PlaneEdit edit);
  std::optional<DrawnPicture> take();
  void wait();  // until there is a picture, or nothing to do

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
