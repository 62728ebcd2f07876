#include "worker.h"

#include <algorithm>
#include <chrono>

namespace steradian::view {
namespace {

constexpr double kFrameMs = 1000.0 / 30;

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

RenderOptions reduced(RenderOptions options, int divisor) {
  options.width = std::max(1, options.width / divisor);
  options.height = std::max(1, options.height / divisor);
  if (divisor > 1) options.aa = 1;
  return options;
}

}  // namespace

int divisor_within(double time_ms, const Cost& cost) {
  // What does not shrink with the picture leaves less for the pixels, but never less than half.
  const double left = std::max(time_ms - cost.fixed_ms, time_ms / 2);
  int divisor = 1;
  while (divisor < 8 && cost.pixels_ms * cost.divisor * cost.divisor / (divisor * divisor) > left) divisor *= 2;
  return divisor;
}

Worker::Worker() : thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    cancel_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::uint64_t Worker::submit(RenderRequest request) {
  const std::lock_guard lock(mutex_);
  next_ = Job{std::move(request), ++submitted_};
  if (refining_) cancel_ = true;
  changed_.notify_all();
  return submitted_;
}

std::optional<RenderedFrame> Worker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, std::nullopt);
}

void Worker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return done_ || (!next_ && !busy_); });
}

void Worker::run() {
  for (;;) {
    std::optional<Job> job;
    {
      std::unique_lock lock(mutex_);
      busy_ = false;
      changed_.notify_all();
      changed_.wait(lock, [&] { return next_ || quit_; });
      if (quit_) return;
      job = std::exchange(next_, std::nullopt);
      cancel_ = false;
      busy_ = true;
      refining_ = false;
    }
    try {
      answer(*job);
    } catch (const std::exception& e) {
      RenderedFrame frame;
      frame.request = job->number;
      frame.error = e.what();
      frame.last = true;
      publish(std::move(frame));
    }
  }
}

void Worker::publish(RenderedFrame frame) {
  const std::lock_guard lock(mutex_);
  done_ = std::move(frame);
  changed_.notify_all();
}

void Worker::answer(const Job& job) {
  RenderedFrame frame;
  frame.request = job.number;
  const RenderRequest& request = job.request;
  if (!scene_ || revision_ != request.revision) {
    const auto start = std::chrono::steady_clock::now();
    LoadOptions options;
    options.aspect = static_cast<double>(request.options.width) / request.options.height;
    if (!pictures_ || source_ != request.source) pictures_ = std::make_shared<DecodedPictures>();
    source_ = request.source;
    options.pictures = pictures_;
    scene_.reset();
    scene_ = std::make_shared<LoadedScene>(load_scene_from_memory(glb_bytes(request.file), request.file.path, options));
    revision_ = request.revision;
    frame.load_ms = ms_since(start);
  }
  if (request.camera) {
    // The scene is shared with the window, which reads what is drawn of it, but not this.
    scene_->scene.cameras.assign(1, *request.camera);
  }
  frame.scene = scene_;
  frame.camera = scene_->scene.cameras.front();

  const int first = cost_.divisor == 0 ? 4 : divisor_within(kFrameMs, cost_);
  if (!request.refine || first == 1) {
    if (!show(job, frame, first, first == 1) || request.moving || first == 1) return;
  }
  // At rest: a picture of half the size on the way where the whole one takes long.
  {
    const std::lock_guard lock(mutex_);
    refining_ = true;
    if (next_) return;
  }
  constexpr double kLong = 500;
  const double whole = cost_.pixels_ms * cost_.divisor * cost_.divisor;
  if (first > 2 && whole > kLong && !show(job, frame, 2, false)) return;
  show(job, frame, 1, true);
}

bool Worker::show(const Job& job, RenderedFrame frame, int divisor, bool last) {
  const auto render_one = [&](const RenderOptions& full, Picture& picture, RenderStats& stats) {
    RenderOptions options = reduced(full, divisor);
    options.stop = &cancel_;
    RenderState state;
    picture = render(scene_->scene, options, &stats, &state);
    return state.complete;
  };
  const auto start = std::chrono::steady_clock::now();
  if (!render_one(job.request.options, frame.picture, frame.stats)) return false;
  if (job.request.other && !render_one(*job.request.other, frame.other, frame.other_stats)) return false;
  const auto build_ms = [](const RenderStats& stats) { return stats.passes.empty() ? 0.0 : stats.passes.front().ms; };
  const double fixed = build_ms(frame.stats) + build_ms(frame.other_stats);
  cost_ = {fixed, std::max(ms_since(start) - fixed, 0.0), divisor};
  frame.divisor = divisor;
  frame.last = last;
  publish(std::move(frame));
  return true;
}

}  // namespace steradian::view
