#include "drawing/drawing_worker.h"

#include <utility>

namespace steradian::view {

DrawingWorker::DrawingWorker(int threads) : threads_(threads), thread_([this] { run(); }) {}

DrawingWorker::~DrawingWorker() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::uint64_t DrawingWorker::show(PlaneScene scene, int width, int height) {
  const std::lock_guard lock(mutex_);
  scene_ = std::move(scene);
  width_ = width;
  height_ = height;
  followed_.reset();
  edits_.clear();
  changed_.notify_all();
  return ++asked_;
}

std::uint64_t DrawingWorker::follow(PlaneScene scene) {
  const std::lock_guard lock(mutex_);
  (scene_ ? scene_ : followed_) = std::move(scene);
  edits_.clear();
  changed_.notify_all();
  return ++asked_;
}

std::uint64_t DrawingWorker::edit(PlaneEdit edit) {
  const std::lock_guard lock(mutex_);
  // For a dragged body only its latest position is drawn.
  if (!edits_.empty() && edit.kind == PlaneEdit::Kind::replace && edits_.back().kind == edit.kind && edits_.back().body == edit.body)
    edits_.back() = std::move(edit);
  else
    edits_.push_back(std::move(edit));
  changed_.notify_all();
  return ++asked_;
}

std::optional<DrawnPicture> DrawingWorker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(picture_, std::nullopt);
}

void DrawingWorker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return picture_ || done_ == asked_; });
}

void DrawingWorker::run() {
  std::optional<PlaneStage> stage;
  for (;;) {
    std::optional<PlaneScene> scene, followed;
    std::vector<PlaneEdit> edits;
    PlaneFrameOptions options;
    options.threads = threads_;
    std::uint64_t request = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return done_ != asked_ || quit_; });
      if (quit_) return;
      scene = std::exchange(scene_, std::nullopt);
      followed = std::exchange(followed_, std::nullopt);
      edits = std::exchange(edits_, {});
      options.width = width_;
      options.height = height_;
      request = asked_;
    }
    DrawnPicture drawn;
    drawn.request = request;
    try {
      if (scene) stage.emplace(std::move(*scene), options);
      // A stage keeps the suns and the fog that it began with.
      if (followed && (!followed->suns.empty() || followed->fog_density > 0))
        stage.emplace(std::move(*followed), options);
      else if (followed)
        stage->follow(*followed);
      for (PlaneEdit& e : edits) {
        if (e.kind == PlaneEdit::Kind::replace) stage->replace(e.body, std::move(e.with));
        if (e.kind == PlaneEdit::Kind::add) stage->add(std::move(e.with));
        if (e.kind == PlaneEdit::Kind::remove) stage->remove(e.body);
      }
      drawn.picture = stage->draw();
      drawn.stats = stage->stats();
    } catch (const std::exception& e) {
      drawn.error = e.what();
    }
    const std::lock_guard lock(mutex_);
    done_ = request;
    picture_ = std::move(drawn);
    changed_.notify_all();
  }
}

}  // namespace steradian::view
