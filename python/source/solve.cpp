// Lights that fit themselves, and their values with derivatives for other optimizers.
#include <memory>

#include "bindings.h"
#include "solve/job.h"
#include "solve/report.h"
#include "solve/solved_file.h"
#include "steradian/load_scene.h"
#include "steradian/solve.h"

namespace steradian::python {
namespace {

// A question: the scene, the parameters and the targets.
struct Question {
  std::string path;
  LoadedScene loaded;
  app::SolveJob job;
  SolveOptions options;
};

// spec: JSON as `steradian solve --spec` reads it; folder: of its relative paths.
std::unique_ptr<Question> question_of(const std::string& path, const std::string& spec, const std::string& folder, const py::dict& o) {
  auto question = std::make_unique<Question>();
  question->path = path;
  SolveOptions& options = question->options;
  options.render.shadows = value_of<Shadows>(o["shadows"], "shadows");
  options.render.quality = value_of<Quality>(o["quality"], "quality");
  options.render.bounces = o["bounces"].cast<int>();
  options.render.threads = o["threads"].cast<int>();
  options.starts = o["starts"].cast<int>();
  options.seed = o["seed"].cast<std::uint64_t>();
  options.max_steps = o["max_steps"].cast<int>();
  options.tolerance = o["tolerance"].cast<double>();
  LoadOptions load;
  load.lights = {AddedLight::none};
  const py::gil_scoped_release free;
  question->loaded = load_scene(path, load);
  app::SolveJobReader reader(question->loaded.scene, {}, load.limits);
  reader.add_text(spec, "spec", folder);
  question->job = reader.finish();
  options.least_power = question->job.least_power;
  options.materials = question->job.materials;
  return question;
}

std::string solve_file(const std::string& path, const std::string& output, const std::string& spec, const std::string& folder,
                       const py::dict& o, const py::object& progress) {
  const std::unique_ptr<Question> question = question_of(path, spec, folder, o);
  std::exception_ptr raised;
  question->options.progress = [&](const SolveStep& step) {
    const py::gil_scoped_acquire hold;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none()) progress(step.start, step.step, step.cost);
    } catch (...) {
      raised = std::current_exception();
    }
    return raised == nullptr;
  };
  const Scene& scene = question->loaded.scene;
  Solution found;
  {
    const py::gil_scoped_release free;
    found = solve(scene, question->job.fits, question->job.ties, question->job.targets, question->options);
    if (raised == nullptr && !output.empty()) app::write_solved(path, scene, found, output);
  }
  if (raised != nullptr) std::rethrow_exception(raised);
  return app::solve_report_json({question->path, output, "", 0, scene, question->job, found, question->options.render});
}

py::array_t<double> array_of(const std::vector<double>& v) { return py::array_t<double>(static_cast<py::ssize_t>(v.size()), v.data()); }

class Model {
 public:
  explicit Model(std::unique_ptr<Question> question)
      : question_(std::move(question)),
        model_(question_->loaded.scene, question_->job.fits, question_->job.ties, question_->job.targets, question_->options) {}

  std::vector<LightModel::Variable> variables() const { return model_.variables(); }
  py::array_t<double> wanted() const { return array_of(model_.wanted()); }
  py::array_t<double> values(const std::vector<double>& x) const {
    const LightModel::Values found = [&] {
      const py::gil_scoped_release free;
      return model_.at(x);
    }();
    return array_of(found.value);
  }
  py::array_t<double> slopes(const std::vector<double>& x) const {
    const LightModel::Values found = [&] {
      const py::gil_scoped_release free;
      return model_.with_slopes(x);
    }();
    return py::array_t<double>({static_cast<py::ssize_t>(found.value.size()), static_cast<py::ssize_t>(x.size())}, found.slopes.data());
  }

 private:
  std::unique_ptr<Question> question_;
  LightModel model_;
};

}  // namespace

void add_solve(py::module_& m) {
  m.def("solve", solve_file);
  py::class_<Model>(m, "LightModel")
      .def(py::init([](const std::string& path, const std::string& spec, const std::string& folder, const py::dict& o) {
        return std::make_unique<Model>(question_of(path, spec, folder, o));
      }))
      .def_property_readonly("names",
                             [](const Model& model) {
                               std::vector<std::string> names;
                               for (const auto& v : model.variables()) names.push_back(v.name);
                               return names;
                             })
      .def_property_readonly("start",
                             [](const Model& model) {
                               std::vector<double> x;
                               for (const auto& v : model.variables()) x.push_back(v.start);
                               return array_of(x);
                             })
      .def_property_readonly("low",
                             [](const Model& model) {
                               std::vector<double> x;
                               for (const auto& v : model.variables()) x.push_back(v.low);
                               return array_of(x);
                             })
      .def_property_readonly("high",
                             [](const Model& model) {
                               std::vector<double> x;
                               for (const auto& v : model.variables()) x.push_back(v.high);
                               return array_of(x);
                             })
      .def_property_readonly("wanted", &Model::wanted)
      .def("values", &Model::values)
      .def("slopes", &Model::slopes);
}

}  // namespace steradian::python
