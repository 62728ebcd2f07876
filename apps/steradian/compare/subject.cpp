#include "compare/subject.h"

#include <fmt/format.h>

#include <mutex>

#include "core/progress.h"
#include "core/words.h"
#include "integrals/methods.h"
#include "render/picture_options.h"

namespace steradian::app {
namespace {

// Size of the picture that warms up.
constexpr int kWarmWidth = 64, kWarmHeight = 36;

// A separate progress bar for each picture; their lines take turns.
std::function<void(std::uint64_t, std::uint64_t)> progress_of(const std::string& label) {
  static const ProgressOutput output = progress_on_stderr();
  auto bar = std::make_shared<std::unique_ptr<Progress>>();
  auto mutex = std::make_shared<std::mutex>();
  return [=](std::uint64_t, std::uint64_t total) {
    {
      const std::lock_guard lock(*mutex);
      if (!*bar) *bar = std::make_unique<Progress>("compare: " + label, total, output);
    }
    (*bar)->add();
  };
}

// ---- Three dimensions --------------------------------------------------------------------------------------------

std::optional<Made> make_frame(const Scene& scene, RenderOptions options, const std::string& label, const Alarm& alarm) {
  options.progress = progress_of(label);
  options.stop = alarm.is_set() ? &alarm.rung() : nullptr;
  RenderStats stats;
  RenderState state;
  Made made;
  made.picture = render(scene, options, &stats, &state);
  if (!state.complete) return {};
  made.ms = stats.total_ms;
  made.passes = stats.passes;
  return made;
}

}  // namespace

Subject frame_subject(const std::shared_ptr<const Scene>& scene, const CompareArguments& options) {
  Subject subject;
  RenderOptions judge = options.render;
  judge.method = "reference";
  subject.reference_words = fmt::format("Monte Carlo until its standard error is {:.3g} of the picture", judge.target_error);
  subject.reference = [=](const Alarm& alarm) { return make_frame(*scene, judge, "reference", alarm); };
  subject.settings = [scene, render = options.render, all = options.settings](const std::string& method) {
    std::vector<Setting> settings;
    const auto add = [&](const std::string& words, const RenderOptions& r) {
      settings.push_back({words, [=](const Alarm& alarm) { return make_frame(*scene, r, method + ", " + words, alarm); }});
    };
    RenderOptions r = render;
    r.method = method;
    if (method == "sampled") {
      ++r.seed;  // with the random numbers of the reference, the errors of both would be alike
      for (r.spp = all ? 1 : render.spp; r.spp < render.spp; r.spp *= 4) add(fmt::format("{} spp", r.spp), r);
      r.spp = render.spp;
      add(fmt::format("{} spp", r.spp), r);
      return std::pair{settings, settings.size() - 1};
    }
    const std::optional<Method> known = method_of(method);
    const bool qualities = known && (*known == Method::automatic || *methods::row_of(*known).qualities != '\0');
    if (!all || !qualities) {
      add("normal", r);
      return std::pair{settings, std::size_t{0}};
    }
    for (const words::OptionWord<Quality>& quality : words::kTable<Quality>) {
      r.quality = quality.value;
      add(quality.name, r);
    }
    return std::pair{settings, std::size_t{1}};
  };
  subject.warm_up = [scene, small = options.render]() mutable {
    small.width = kWarmWidth;
    small.height = kWarmHeight;
    small.bounces = 0;  // whose time does not depend on the size
    render(*scene, small);
  };
  return subject;
}

namespace {

// ---- The plane ---------------------------------------------------------------------------------------------------

std::optional<Made> make_plane(const PlaneWorld& world, PlaneFrameOptions options, const std::string& label, const Alarm& alarm) {
  struct Rung {};  // an exception of the progress ends the picture
  options.progress = [&alarm, show = progress_of(label)](std::uint64_t done, std::uint64_t total) {
    if (alarm.rung()) throw Rung();
    show(done, total);
  };
  PlaneFrameStats stats;
  Made made;
  try {
    if (alarm.rung()) throw Rung();
    made.picture = render_plane(world, options, &stats);
  } catch (const Rung&) {
    return {};
  }
  made.picture.layers.clear();
  made.ms = stats.prepare_ms + stats.frame_ms;
  made.passes = {{"prepare", stats.prepare_ms}, {"frame", stats.frame_ms}};
  return made;
}

}  // namespace

Subject plane_subject(const std::shared_ptr<const PlaneWorld>& world, const CompareArguments& options) {
  PlaneFrameOptions frame;
  frame.limits = options.limits;
  frame.threads = options.render.threads;
  frame.aa = options.render.aa;
  if (!options.size.empty()) {
    const PictureSize size = picture_size(options.size);
    frame.width = size.width;
    frame.height = size.height;
  }
  frame.sampling = {options.render.spp, options.render.seed};
  Subject subject;
  subject.reference_words = "the closed form in double precision, point by point";
  subject.reference = [=](const Alarm& alarm) {
    PlaneFrameOptions judge = frame;
    judge.moments = true;  // in double, pixel by pixel
    return make_plane(*world, judge, "reference", alarm);
  };
  subject.settings = [world, frame, all = options.settings](const std::string& method) {
    std::vector<Setting> settings;
    PlaneFrameOptions f = frame;
    f.method = plane_method_from_name(method == "auto" ? "exact" : method);
    const auto add = [&](const std::string& words) {
      settings.push_back(
          {words, [world, f, label = method + ", " + words](const Alarm& alarm) { return make_plane(*world, f, label, alarm); }});
    };
    if (f.method == PlaneMethod::sampled || f.method == PlaneMethod::marched) {
      for (f.sampling.spp = all ? 4 : frame.sampling.spp; f.sampling.spp < frame.sampling.spp; f.sampling.spp *= 4)
        add(fmt::format("{} spp", f.sampling.spp));
      f.sampling.spp = frame.sampling.spp;
      add(fmt::format("{} spp", f.sampling.spp));
    } else {
      add("normal");
    }
    return std::pair{settings, settings.size() - 1};
  };
  subject.warm_up = [world, small = frame]() mutable {
    small.width = kWarmWidth;
    small.height = kWarmHeight;
    render_plane(*world, small);
  };
  return subject;
}

}  // namespace steradian::app
