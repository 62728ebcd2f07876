#include "paint/fitter.h"

#include <algorithm>
#include <utility>

#include "document/light_changes.h"
#include "scene/emitters/light_materials.h"
#include "steradian/error.h"

namespace steradian::view {
namespace {

constexpr double kKeep = 0.05;  // weight of staying: strokes may not see a light at all
constexpr int kMostSteps = 60;
constexpr double kTolerance = 1e-5;

// The node that a light belongs to; that of its mesh, if the material emits.
int node_of_light(const LoadedScene& loaded, std::size_t light) {
  const Scene& scene = loaded.scene;
  const std::size_t area = scene.area_lights.size();
  if (light >= area) return scene.punctual_lights[light - area].node;
  if (scene.area_lights[light].node >= 0) return scene.area_lights[light].node;
  for (std::size_t i = 0; i < scene.meshes.size() && i < loaded.mesh_nodes.size(); ++i) {
    const auto& lights = scene.meshes[i].triangle_lights;
    if (std::find(lights.begin(), lights.end(), static_cast<std::int32_t>(light)) != lights.end()) return loaded.mesh_nodes[i];
  }
  return -1;
}

struct Unknowns {
  std::vector<LightFit> fits;
  std::vector<LightTie> ties;
};

// Lights of an emissive material shine alike. One that has a material of its own also has vertices.
Unknowns unknowns_of(const LoadedScene& loaded, const FitTask& task) {
  const FitChoice& choice = task.choice;
  const Scene& scene = loaded.scene;
  Unknowns result;
  std::vector<int> materials;
  for (std::size_t light = 0; light < scene.area_lights.size() + scene.punctual_lights.size(); ++light) {
    if (choice.selected && node_of_light(loaded, light) != task.node) continue;
    LightFit fit;
    fit.light = light;
    fit.keep = kKeep;
    const int material =
        light < scene.area_lights.size() && scene.area_lights[light].node < 0 ? scene::material_of_light(scene, light) : -1;
    if (material >= 0) {
      if (std::find(materials.begin(), materials.end(), material) != materials.end()) continue;
      materials.push_back(material);
      const std::vector<std::size_t> alike = scene::lights_of_material(scene, material);
      if (alike.size() > 1) result.ties.push_back({alike});
      fit.vertices = choice.vertices && alike.size() == 1;
      fit.power = choice.power || !fit.vertices;
    } else {
      fit.color = choice.color;
      fit.power = choice.power && !choice.color;
      fit.position = choice.position;
      fit.rotation = choice.rotation;
      fit.size = choice.size;
    }
    if (fit.power || fit.color || fit.position || fit.rotation || fit.size || fit.vertices) result.fits.push_back(fit);
  }
  return result;
}

std::string summary(const Solution& found) {
  std::string text = found.converged ? "fitted" : "stopped";
  text += " after " + std::to_string(found.steps.empty() ? 0 : found.steps.back().step) + " steps";
  for (const FittedParameter& p : found.parameters)
    if (!p.determined) return text + "; the strokes do not tell " + p.name;
  return text;
}

}  // namespace

Fitter::~Fitter() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    ++wanted_;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Fitter::start(FitTask task) {
  const std::lock_guard lock(mutex_);
  ++wanted_;
  news_.reset();
  next_ = std::move(task);
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  changed_.notify_all();
}

void Fitter::stop() {
  const std::lock_guard lock(mutex_);
  ended_ = ++wanted_;
  next_.reset();
  news_.reset();
}

std::optional<FitNews> Fitter::take() {
  const std::lock_guard lock(mutex_);
  std::optional<FitNews> news = std::exchange(news_, std::nullopt);
  if (news && news->ended) ended_ = wanted_;
  return news;
}

void Fitter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return news_.has_value() || wanted_ == ended_; });
}

void Fitter::tell(FitNews news, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  if (number != wanted_) return;
  news_ = std::move(news);
  changed_.notify_all();
}

void Fitter::run() {
  for (;;) {
    std::optional<FitTask> task;
    std::uint64_t number = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return next_ || quit_; });
      if (quit_) return;
      task = std::exchange(next_, std::nullopt);
      number = wanted_;
    }
    fit(*task, number);
  }
}

void Fitter::fit(const FitTask& task, std::uint64_t number) {
  FitNews news;
  try {
    LoadOptions load;
    load.lights = {AddedLight::none};  // a light that the file does not have cannot change there
    const auto loaded = std::make_shared<LoadedScene>(scene::load_scene(task.file, load));
    const std::vector<LightTarget> targets = targets_of(task.strokes, loaded->scene);
    const Unknowns unknowns = unknowns_of(*loaded, task);
    if (unknowns.fits.empty())
      throw Error("fit", "there is no light with these parameters", task.choice.selected ? "select one" : "choose others, or add a light");
    news.scene = loaded;
    SolveOptions options;
    options.render = task.render;
    options.max_steps = kMostSteps;
    options.tolerance = kTolerance;
    options.moved = [&](const std::vector<LightChange>& changes) { news.changes = changes; };
    options.progress = [&](const SolveStep& step) {
      news.step = step.step;
      news.cost = step.cost;
      tell(news, number);
      return number == wanted_;
    };
    const Solution found = solve(loaded->scene, unknowns.fits, unknowns.ties, targets, options);
    news.changes = found.changes;
    news.cost = found.cost;
    news.message = summary(found);
  } catch (const std::exception& e) {
    news.changes.clear();
    news.message = e.what();
  }
  news.ended = true;
  tell(std::move(news), number);
}

}  // namespace steradian::view
