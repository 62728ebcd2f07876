#include "worker.h"

#include <algorithm>
#include <chrono>

#include "steradian/error.h"

namespace steradian::view {
namespace {

constexpr double kFrameMs = 1000.0 / 30;   // of a picture while things move
constexpr double kPreviewMs = 1000.0 / 6;  // of one with all light, by whose size it is chosen
constexpr double kLongPreviewMs = 500;     // of the smallest one that is still shown
constexpr double kColdPreviewMs = 1000;    // of the first one ever, which also pays for cold caches
constexpr double kLongMs = 500;            // of a picture that a smaller one precedes, at rest

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

RenderOptions reduced(RenderOptions options, ShownLight light, int divisor) {
  options.width = std::max(1, options.width / divisor);
  options.height = std::max(1, options.height / divisor);
  if (divisor > 1) options.aa = 1;
  if (light == ShownLight::direct) options.bounces = 0;
  options.bounce_preview = light == ShownLight::preview;
  return options;
}

// Time of the whole picture.
double whole_ms(const Cost& cost) { return cost.fixed_ms + cost.pixels_ms * cost.divisor * cost.divisor; }

// Time that does not depend on the number of pixels.
double fixed_ms(const RenderStats& stats) {
  double sum = 0;
  for (const PassTime& pass : stats.passes)
    if (pass.name == "build" || pass.name == "bounces: patches") sum += pass.ms;
  return sum;
}

// A reference improves while it is displayed.
bool is_accumulated(const std::optional<RenderOptions>& other) { return other && other->method == "reference"; }
constexpr int kFirstPairs = 4;  // pairs of samples per light and pixel: noisy, but immediate

}  // namespace

int divisor_within(double time_ms, const Cost& cost) {
  // The fixed time leaves less time for the pixels, but never less than half.
  const double left = std::max(time_ms - cost.fixed_ms, time_ms / 2);
  int divisor = 1;
  while (divisor < 8 && cost.pixels_ms * cost.divisor * cost.divisor / (divisor * divisor) > left) divisor *= 2;
  return divisor;
}

Worker::Worker(Render render)
    : render_(render ? std::move(render)
                     : [](const Scene& scene, const RenderOptions& options, RenderCache& cache, RenderStats* stats,
                          RenderState* state) { return steradian::render(scene, options, cache, stats, state); }),
      thread_([this] { run(); }) {}

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
  if (done_ && !done_->same) frame.same = false;  // the previous frame was never shown
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
    if (!pictures_ || source_ != request.source) {
      pictures_ = std::make_shared<DecodedPictures>();
      meshes_ = make_kept_meshes();
    }
    source_ = request.source;
    options.pictures = pictures_;
    options.meshes = meshes_;
    scene_.reset();
    scene_ = std::make_shared<LoadedScene>(scene::load_scene(request.file, options));
    revision_ = request.revision;
    frame.load_ms = ms_since(start);
  }
  if (request.camera) {
    // The window shares the scene. It reads the scene's displayed data, but not the cameras.
    scene_->scene.cameras.assign(1, *request.camera);
  }
  frame.scene = scene_;
  frame.camera = scene_->scene.cameras.front();

  const Step first = first_step(request);
  const std::vector<Step> further = further_steps(request, first);
  frame.last = further.empty();
  if (!request.refine || further.empty()) {
    if (!show(job, frame, first) || request.moving) return;
  }
  {
    const std::lock_guard lock(mutex_);
    refining_ = true;
    if (next_) return;
  }
  for (const Step& step : further) {
    frame.last = step == further.back();
    if (!show(job, frame, step)) return;
  }
  if (frame.pairs > 0) accumulate(job, std::move(frame));
}

Cost Worker::cost_of(ShownLight light) const {
  const auto& [last, before] = costs_[static_cast<std::size_t>(light)];
  return before.divisor != 0 && whole_ms(before) < whole_ms(last) ? before : last;
}

// The light and the size of the picture that is shown while things move.
Worker::Step Worker::first_step(const RenderRequest& request) const {
  const bool bounces = request.options.bounces != 0;
  if (bounces) {
    const Cost preview = cost_of(ShownLight::preview);
    const bool cold = costs_[static_cast<std::size_t>(ShownLight::preview)].before.divisor == 0;
    const int divisor = divisor_within(kPreviewMs, preview);
    const double time_ms = preview.fixed_ms + whole_ms({0, preview.pixels_ms, preview.divisor}) / (divisor * divisor);
    if (preview.divisor != 0 && time_ms <= (cold ? kColdPreviewMs : kLongPreviewMs)) return {ShownLight::preview, divisor};
  }
  const ShownLight light = bounces ? ShownLight::direct : ShownLight::all;
  const Cost cost = cost_of(light);
  return {light, cost.divisor == 0 ? 4 : divisor_within(kFrameMs, cost)};
}

// The pictures that follow at rest.
std::vector<Worker::Step> Worker::further_steps(const RenderRequest& request, Step first) const {
  if (first.light == ShownLight::all && first.divisor == 1) return {};
  std::vector<Step> steps;
  const bool bounces = request.options.bounces != 0;
  if (bounces && first.light == ShownLight::direct) steps.push_back({ShownLight::preview, 4});
  // If the whole picture takes long, one of half the size comes before it.
  const Cost cost = cost_of(ShownLight::all);
  const bool takes_long = cost.divisor == 0 ? bounces : whole_ms(cost) > kLongMs;
  if (takes_long && (bounces || first.divisor > 2)) steps.push_back({ShownLight::all, 2});
  steps.push_back({ShownLight::all, 1});
  return steps;
}

bool Worker::render_one(const RenderOptions& wanted, RenderedFrame& frame, Picture& picture, RenderStats& stats) {
  RenderOptions options = wanted;
  options.stop = &cancel_;
  RenderState state;
  if (!device_lost_.empty()) options.backend = Backend::cpu;
  try {
    picture = render_(scene_->scene, options, cache_, &stats, &state);
  } catch (const UsageError&) {
    throw;  // an error of the request, not of the device
  } catch (const Error& e) {
    if (options.backend == Backend::cpu) throw;
    device_lost_ = e.what();
    options.backend = Backend::cpu;
    picture = render_(scene_->scene, options, cache_, &stats, &state);
  }
  frame.device_lost = device_lost_;
  return state.complete;
}

bool Worker::add_pass(const Job& job, RenderedFrame& frame, Step step, int pairs) {
  RenderOptions options = reduced(*job.request.other, step.light, step.divisor);
  options.target_error = 0;
  options.spp = pairs;
  options.seed += accumulation_.pairs();  // a different seed for every pass
  Picture pass;
  if (!render_one(options, frame, pass, frame.other_stats)) return false;
  accumulation_.add(pass, pairs);
  frame.other = accumulation_.picture();
  frame.pairs = accumulation_.pairs();
  frame.standard_error = accumulation_.relative_error();
  return true;
}

bool Worker::show(const Job& job, RenderedFrame& frame, Step step) {
  const RenderRequest& request = job.request;
  const auto start = std::chrono::steady_clock::now();
  const bool last = frame.last;
  if (!render_one(reduced(request.options, step.light, step.divisor), frame, frame.picture, frame.stats)) return false;
  accumulation_ = {};
  if (is_accumulated(request.other)) {
    if (!add_pass(job, frame, step, kFirstPairs)) return false;
  } else if (request.other && !render_one(reduced(*request.other, step.light, step.divisor), frame, frame.other, frame.other_stats)) {
    return false;
  }
  const double fixed = fixed_ms(frame.stats) + fixed_ms(frame.other_stats);
  Measured& measured = costs_[static_cast<std::size_t>(step.light)];
  measured = {{fixed, std::max(ms_since(start) - fixed, 0.0), step.divisor}, measured.last};
  frame.divisor = step.divisor;
  frame.light = step.light;
  frame.last = last && (frame.pairs == 0 || frame.standard_error <= request.other->target_error);
  publish(frame);
  return true;
}

void Worker::accumulate(const Job& job, RenderedFrame frame) {
  constexpr double kPassMs = 300;            // a pass that takes no longer is followed by one of twice as many samples
  constexpr double kGoodEnough = 1.0 / 16;   // fraction of the requested error: beyond it a screen of 8 bits shows no difference
  constexpr std::uint64_t kMost = 1u << 20;  // pairs
  const double target = job.request.other->target_error;
  int pairs = kFirstPairs;
  frame.same = true;
  while (frame.standard_error > target * kGoodEnough && frame.pairs < kMost) {
    const auto start = std::chrono::steady_clock::now();
    if (!add_pass(job, frame, {ShownLight::all, 1}, pairs)) return;
    if (ms_since(start) < kPassMs) pairs *= 2;
    frame.last = frame.standard_error <= target || frame.pairs >= kMost;
    publish(frame);
  }
}

}  // namespace steradian::view
