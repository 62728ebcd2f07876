// steradian viewfactor SCENE -o FILE; viewfactor points SCENE SENSORS -o FILE; viewfactor verify FILE
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include "command_line.h"
#include "core/files.h"
#include "core/progress.h"
#include "exchange/files/matrix_files.h"
#include "exchange/obstacles/point_factors.h"
#include "exchange/obstacles/scene_elements.h"
#include "exchange/files/scene_faces.h"
#include "exchange/files/unfinished.h"
#include "exchange/files/vs3.h"
#include "part.h"
#include "steradian/error.h"
#include "steradian/version.h"
#include "steradian/view_factors.h"
#include "verbs.h"
#include "viewfactor/finish.h"
#include "viewfactor/in_file.h"
#include "viewfactor/report.h"

namespace steradian::app {
namespace {

using namespace exchange;

struct ViewFactorArguments {
  std::vector<std::string> inputs;
  std::string output, by = "face", part = "1/1", report;
  double eps = 1e-6, divide = 0, drop = 0;
  bool two_sided = false, no_obstruction = false, close = false, resume = false;
  int pairs = 1000;
  Limits limits;
};

SceneFaces load_faces(const std::string& path, const ViewFactorArguments& arguments) {
  FaceOptions options;
  options.by = arguments.by == "node" ? FacesBy::node : arguments.by == "material" ? FacesBy::material : FacesBy::face;
  options.divide = arguments.divide;
  options.two_sided = arguments.two_sided;
  Budget budget(arguments.limits);
  LoadOptions load;
  load.limits = arguments.limits;
  load.max_lights = 1 << 20;
  load.lights = {AddedLight::none};
  SceneFaces faces = in_file(path, [&] {
    return is_vs3_file(path)    ? read_vs3(path, options, budget)
           : is_mesh_file(path) ? faces_of_meshes(read_mesh_file(path, budget), options, budget)
                                : faces_of_scene(load_scene(path, load), options, budget);
  });
  warn(path, faces.warnings);
  if (faces.faces.empty()) throw Error(path, "the scene has no faces", "export meshes with triangles");
  return faces;
}

void compute(const ViewFactorArguments& arguments) {
  if (arguments.inputs.size() != 1) throw WrongOption("SCENE", "one scene is expected");
  if (arguments.output.empty()) throw WrongOption("-o", "is required");
  check_factors_name(arguments.output);
  StoredRun stored;
  stored.run.version = version();
  stored.run.eps = arguments.eps;
  stored.run.obstruction = !arguments.no_obstruction;
  const Part part = part_named(arguments.part);
  stored.run.part = part.number;
  stored.run.parts = part.count;
  if (stored.run.parts > 1 && arguments.close) throw WrongOption("--close", "needs the whole matrix; give it to steradian merge");
  if (stored.run.parts > 1 && !arguments.report.empty())
    throw WrongOption("--report", "needs the whole matrix; give it to steradian merge");
  if (stored.run.parts > 1 && arguments.drop > 0) throw WrongOption("--drop", "needs the whole matrix; give it to steradian merge");
  if (stored.run.parts > 1 && !arguments.output.ends_with(".npz")) throw WrongOption("-o", "a part is written as .npz");
  smallest_kept(arguments.drop, arguments.eps);  // an error comes before the work
  SceneFaces faces = load_faces(arguments.inputs[0], arguments);
  stored.faces = faces.faces;
  stored.obstacles = faces.obstacles;
  stored.grouping = {faces.groups, faces.group_names, faces.masks};

  const auto start = std::chrono::steady_clock::now();
  ViewFactorOptions options;
  options.eps = arguments.eps;
  options.obstruction = arguments.no_obstruction ? Obstruction::off : Obstruction::on;
  options.obstacles = stored.obstacles;
  options.part = stored.run.part;
  options.parts = stored.run.parts;
  std::uint64_t pairs = 0;
  for (const auto& [first, end] : rows_of_part(faces.faces.size(), stored.run.part, stored.run.parts))
    for (std::size_t row = first; row < end; ++row) pairs += row;
  std::unique_ptr<UnfinishedFactors> unfinished;
  if (arguments.resume) {
    unfinished = std::make_unique<UnfinishedFactors>(arguments.output + ".part", stored);
    options.known = [&](ExchangeBlock& block) { return unfinished->find(block); };
    options.finished = [&](const ExchangeBlock& block) { unfinished->add(block); };
  }
  {
    Progress progress("view factors", pairs);
    options.advanced = [&](std::uint64_t done) { progress.add(done); };
    stored.factors = in_file(arguments.inputs[0], [&] { return view_factors(stored.faces, options); });
  }
  if (stored.run.parts == 1)
    for (const std::string& doubt : finish_factors(arguments.inputs[0], stored, {arguments.close, arguments.drop}))
      faces.warnings.push_back(doubt);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_factors(arguments.output, stored);
  if (unfinished) unfinished->remove();
  if (!arguments.report.empty()) write_report(arguments.report, arguments.inputs[0], stored, faces.warnings, seconds);
  print_summary(stored, seconds);
}

std::vector<Sensor> read_sensors(const std::string& path, Budget& budget) {
  const Bytes bytes = read_file(path, path, budget);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::vector<Sensor> sensors;
  std::string line;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    double v[6];
    bool good = true;
    for (double& x : v) good = good && static_cast<bool>(numbers >> x) && std::isfinite(x);
    std::string rest;
    good = good && !(numbers >> rest);
    // A first line of names is a heading.
    if (!good && sensors.empty() && number == 1) continue;
    const Vec3d normal = normalized(Vec3d{v[3], v[4], v[5]});
    if (!good || normal == Vec3d{})
      throw Error(path + ":" + std::to_string(number), "is not x,y,z,nx,ny,nz with a normal that has a length", "give six numbers a line");
    sensors.push_back({{v[0], v[1], v[2]}, normal});
  }
  if (sensors.empty()) throw Error(path, "has no sensors", "give x,y,z,nx,ny,nz a line");
  return sensors;
}

// A column's name in CSV.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\n") == std::string::npos) return name;
  std::string result = "\"";
  for (const char c : name) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

void compute_points(const ViewFactorArguments& arguments) {
  if (arguments.inputs.size() != 3) throw WrongOption("points", "expects a scene and a file of sensors");
  Budget budget(arguments.limits);
  const SceneFaces faces = load_faces(arguments.inputs[1], arguments);
  const std::vector<Sensor> sensors = read_sensors(arguments.inputs[2], budget);
  const auto [elements, obstacles] = in_file(arguments.inputs[1], [&] {
    return scene_elements(faces.faces, faces.obstacles, arguments.no_obstruction ? Obstruction::off : Obstruction::on, AskedFrom::points);
  });
  std::string csv = "x,y,z,nx,ny,nz,sky,backs";
  const std::vector<std::string>& groups = faces.group_names;
  for (std::size_t i = 0; i < (groups.empty() ? faces.faces.size() : groups.size()); ++i)
    csv += "," + quoted(groups.empty() ? faces.faces[i].name : groups[i]);
  csv += "\n";
  Progress progress("points", sensors.size());
  std::size_t unproven = 0;
  for (const Sensor& s : sensors) {
    const SensorFactors f = sensor_factors(s, elements, obstacles);
    unproven += !f.is_proven;
    std::vector<double> columns(groups.empty() ? elements.size() : groups.size(), 0.0);
    for (std::size_t i = 0; i < elements.size(); ++i) columns[groups.empty() ? i : faces.groups[i]] += f.fronts[i];
    csv += fmt::format("{},{},{},{},{},{},{:.17g},{:.17g}", s.position.x, s.position.y, s.position.z, s.normal.x, s.normal.y, s.normal.z,
                       f.sky, f.backs);
    for (const double c : columns) csv += fmt::format(",{:.17g}", c);
    csv += "\n";
    progress.add();
  }
  if (unproven > 0) fmt::print(stderr, "warning: the visible parts of {} sensors are not proven\n", unproven);
  if (arguments.output.empty() || arguments.output == "-")
    fmt::print("{}", csv);
  else
    write_file(arguments.output, csv);
}

void verify(const ViewFactorArguments& arguments, Exit& exit) {
  if (arguments.inputs.size() != 2) throw WrongOption("verify", "expects one file of view factors");
  const std::string& path = arguments.inputs[1];
  Budget budget(arguments.limits);
  const StoredRun stored = read_factors_npz(path, budget);
  if (!stored.run.groups.empty()) throw Error(path, "is of groups", "verify a file by face");
  const auto [elements, obstacles] = in_file(
      path, [&] { return scene_elements(stored.faces, stored.obstacles, stored.run.obstruction ? Obstruction::on : Obstruction::off); });
  std::vector<std::size_t> rows;
  for (const ExchangeBlock& b : stored.factors.blocks)
    for (std::size_t r = std::max<std::size_t>(b.first_row, 1); r < b.first_row + b.rows(); ++r) rows.push_back(r);
  if (rows.empty()) throw Error(path, "has no pairs");
  // The other direction, at a hundredth of the error.
  std::mt19937_64 random(1);
  std::size_t beyond = 0, worst_i = 0, worst_j = 0, far_i = 0, far_j = 0;
  double worst = 0, worst_ratio = 0, farthest = 0;
  Progress progress("verify", static_cast<std::uint64_t>(arguments.pairs));
  for (int k = 0; k < arguments.pairs; ++k) {
    const std::size_t i = rows[random() % rows.size()], j = random() % i;
    const ExchangeArea h = visible_exchange(elements[j], elements[i], obstacles, std::max(stored.run.eps * 0.01, 1e-12)).visible;
    const double smaller = std::min(elements[i].area, elements[j].area), value = stored.factors.between(i, j);
    const double left_out = value > 0 ? 0 : stored.run.smallest * smaller;
    const double difference = std::fabs(h.value - value), allowed = stored.factors.error_between(i, j) + left_out + h.error;
    if (difference > allowed + 1e-15 * elements[i].area) {
      ++beyond;
      const double times = difference / std::max(allowed, 1e-15 * elements[i].area);
      if (times > farthest) farthest = times, far_i = i, far_j = j;
    }
    const double factor = difference / smaller;
    if (factor > worst) worst = factor, worst_i = i, worst_j = j, worst_ratio = difference / std::max(allowed, 1e-300);
    progress.add();
  }
  progress.wipe();
  fmt::print("pairs               {}\n", arguments.pairs);
  fmt::print("largest difference  {:.3g} of a factor, {:.3g} of the reported error\n", worst, worst_ratio);
  if (worst > 0) fmt::print("                    {} and {}\n", stored.faces[worst_i].name, stored.faces[worst_j].name);
  fmt::print("beyond the error    {}\n", beyond);
  if (beyond > 0)
    fmt::print("                    most of all {} and {}: {:.3g} times the error\n", stored.faces[far_i].name, stored.faces[far_j].name,
               farthest);
  if (beyond > 0) exit.code = 1;
}

}  // namespace

void add_viewfactor(CommandLine& line) {
  auto a = std::make_shared<ViewFactorArguments>();
  Verb verb = line.verb("viewfactor", "Compute exact view factors between the faces of a scene, with an error for each");
  verb.group("View factors");
  verb.add("SCENE", a->inputs, "scene (glTF, OBJ, STL, PLY, VS3), points SCENE SENSORS, verify FILE").required();
  verb.add("-o,--output", a->output, "view factors (.npz, .h5, .mtx, .vf); points: of the sensors (.csv)").writes(Writes::file);
  verb.add("--eps", a->eps, "relative error of an entry").range(1e-14, 0.1);
  verb.add("--by", a->by, "rows of the matrix, columns of the points").words({"face", "node", "material"});
  verb.add("--divide", a->divide, "cut faces into elements of this length [m]; 0: no").range(0.0, 1e9);
  verb.add_flag("--two-sided", a->two_sided, "faces exchange from their backs, too");
  verb.add_flag("--no-obstruction", a->no_obstruction, "leave out what stands between faces");
  verb.add_flag("--close", a->close, "correct a closed enclosure: rows add up to 1");
  verb.add("--drop", a->drop, "leave out entries below this times --eps; 0: none").range(0.0, 1e12);
  verb.add("--part", a->part, "k/n: compute one of n parts; steradian merge joins them");
  verb.add_flag("--resume", a->resume, "go on after an interruption; keeps finished rows in OUTPUT.part");
  verb.add("--report", a->report, "report of rows, errors and guarantees (.json), or a page (.html)").writes(Writes::file);
  verb.add("--pairs", a->pairs, "verify: number of random pairs").range(1, 1'000'000'000);
  verb.add_limits(a->limits);
  verb.callback([a, &exit = line.exit()] {
    if (a->inputs[0] == "points") return compute_points(*a);
    if (a->inputs[0] == "verify") return verify(*a, exit);
    compute(*a);
  });
}

}  // namespace steradian::app
