#include "solve/job.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/files.h"
#include "core/words.h"
#include "steradian/error.h"
#include "wrong_use.h"

namespace steradian::app {
namespace {

using namespace eval;

constexpr std::size_t kMostPoints = 200'000;  // of one target

template <class T>
T read_object(Problems& problems, const Place& place, Json value, std::span<const Field<T>> fields) {
  T result{};
  read_fields(problems, place, value, {}, fields, result);
  return result;
}

template <class Value>
std::optional<Value> read_word(Problems& problems, const Place& place, Json value) {
  const std::string_view word = read_string(problems, place, value);
  const std::optional<Value> found = words::find<Value>(word);
  if (value.is_string() && !found) problems.add(place, quoted(word) + " is not known", words::choices<Value>());
  return found;
}

// true, or an object.
bool is_true(Problems& problems, const Place& place, Json value) {
  if (!value.is_bool()) return false;
  if (!read_bool(problems, place, value)) problems.add(place, "is false", "leave the key out");
  return true;
}

FitRange read_range(Problems& problems, const Place& place, Json value) {
  FitRange range{0, std::numeric_limits<double>::infinity()};
  if (is_true(problems, place, value)) return range;
  static constexpr Field<FitRange> kFields[] = {{"min", into<read_not_negative, &FitRange::low>},
                                                {"max", into<read_not_negative, &FitRange::high>}};
  read_fields(problems, place, value, {}, std::span<const Field<FitRange>>(kFields), range);
  if (range.low > range.high) problems.add(place, "min is above max");
  return range;
}

struct BoxKeys {
  std::optional<Vec3d> min, max;
};
constexpr Field<BoxKeys> kBoxFields[] = {
    {"min", [](Problems& p, const Place& at, Json v, BoxKeys& k) { k.min = read_vector(p, at, v); }},
    {"max", [](Problems& p, const Place& at, Json v, BoxKeys& k) { k.max = read_vector(p, at, v); }},
};
void read_position(Problems& problems, const Place& place, Json value, LightFit& fit) {
  fit.position = true;
  if (is_true(problems, place, value)) return;
  const auto box = read_object<BoxKeys>(problems, place, value, kBoxFields);
  if (box.min) fit.position_x.low = box.min->x, fit.position_y.low = box.min->y, fit.position_z.low = box.min->z;
  if (box.max) fit.position_x.high = box.max->x, fit.position_y.high = box.max->y, fit.position_z.high = box.max->z;
  for (const FitRange& r : {fit.position_x, fit.position_y, fit.position_z})
    if (r.low > r.high) return problems.add(place, "min is above max");
}

constexpr Field<LightFit> kRotationFields[] = {{"max_degrees", into<read_not_negative, &LightFit::most_degrees>}};
void read_rotation(Problems& problems, const Place& place, Json value, LightFit& fit) {
  fit.rotation = true;
  if (!is_true(problems, place, value)) read_fields(problems, place, value, {}, std::span<const Field<LightFit>>(kRotationFields), fit);
}

constexpr Field<LightFit> kVertexFields[] = {{"max", into<read_not_negative, &LightFit::most_move>}};
void read_vertices(Problems& problems, const Place& place, Json value, LightFit& fit) {
  fit.vertices = true;
  if (!is_true(problems, place, value)) read_fields(problems, place, value, {}, std::span<const Field<LightFit>>(kVertexFields), fit);
}

struct FitKeys {
  std::string light;
  LightFit fit;
};
constexpr Field<FitKeys> kFitFields[] = {
    {"light", [](Problems& p, const Place& at, Json v, FitKeys& k) { k.light = read_string(p, at, v); }, true},
    {"position", [](Problems& p, const Place& at, Json v, FitKeys& k) { read_position(p, at, v, k.fit); }},
    {"rotation", [](Problems& p, const Place& at, Json v, FitKeys& k) { read_rotation(p, at, v, k.fit); }},
    {"size",
     [](Problems& p, const Place& at, Json v, FitKeys& k) {
       k.fit.size = true;
       k.fit.size_range = read_range(p, at, v);
     }},
    {"power",
     [](Problems& p, const Place& at, Json v, FitKeys& k) {
       k.fit.power = true;
       k.fit.power_range = read_range(p, at, v);
     }},
    {"color",
     [](Problems& p, const Place& at, Json v, FitKeys& k) {
       k.fit.color = true;
       k.fit.power_range = read_range(p, at, v);
     }},
    {"vertices", [](Problems& p, const Place& at, Json v, FitKeys& k) { read_vertices(p, at, v, k.fit); }},
    {"keep", [](Problems& p, const Place& at, Json v, FitKeys& k) { k.fit.keep = read_not_negative(p, at, v); }},
};

struct MaterialKeys {
  std::string material;
  MaterialFit fit;
};
constexpr Field<MaterialKeys> kMaterialFields[] = {
    {"material", [](Problems& p, const Place& at, Json v, MaterialKeys& k) { k.material = read_string(p, at, v); }, true},
    {"albedo",
     [](Problems& p, const Place& at, Json v, MaterialKeys& k) {
       k.fit.albedo = true;
       k.fit.albedo_range = read_range(p, at, v);
     }},
    {"roughness",
     [](Problems& p, const Place& at, Json v, MaterialKeys& k) {
       k.fit.roughness = true;
       k.fit.roughness_range = read_range(p, at, v);
     }},
    {"keep", [](Problems& p, const Place& at, Json v, MaterialKeys& k) { k.fit.keep = read_not_negative(p, at, v); }},
};

struct MirrorKeys {
  Vec3d point{}, normal{1, 0, 0};
};
constexpr Field<MirrorKeys> kMirrorFields[] = {{"point", into<read_vector, &MirrorKeys::point>, true},
                                               {"normal", into<read_direction, &MirrorKeys::normal>, true}};

struct TieKeys {
  std::vector<std::string> lights;
  std::optional<MirrorKeys> mirror;
};
constexpr Field<TieKeys> kTieFields[] = {
    {"lights",
     [](Problems& p, const Place& at, Json v, TieKeys& k) {
       simdjson::dom::array list;
       if (v.get(list) != simdjson::SUCCESS) return wrong_type(p, at, "a list of names", v);
       for (const Json name : list) k.lights.emplace_back(read_string(p, at.at(k.lights.size()), name));
     },
     true},
    {"mirror", [](Problems& p, const Place& at, Json v, TieKeys& k) { k.mirror = read_object<MirrorKeys>(p, at, v, kMirrorFields); }},
};

template <std::optional<double> LuxBand::*member>
void read_lux_value(Problems& problems, const Place& place, Json value, LuxBand& band) {
  band.*member = read_not_negative(problems, place, value);
}
constexpr Field<LuxBand> kLuxFields[] = {{"min", read_lux_value<&LuxBand::min>},
                                         {"max", read_lux_value<&LuxBand::max>},
                                         {"mean", read_lux_value<&LuxBand::mean>},
                                         {"uniformity", read_lux_value<&LuxBand::uniformity>}};
LuxBand read_lux(Problems& problems, const Place& place, Json value) {
  const auto band = read_object<LuxBand>(problems, place, value, kLuxFields);
  if (band.uniformity && *band.uniformity > 1)
    problems.add(place.in("uniformity"), "is above 1", "it is the least illuminance over the mean");
  if (band.min && band.max && *band.min > *band.max) problems.add(place, "min is above max");
  if (!band.min && !band.max && !band.mean && !band.uniformity)
    problems.add(place, "asks for nothing", "give min, max, mean or uniformity");
  return band;
}

constexpr std::int64_t kMostCells = 1000;  // of a zone, along each side

struct ZoneKeys {
  Vec3d center, x, y;
  std::optional<Vec3d> normal;
  std::int64_t columns = 8, rows = 8;
};
constexpr Field<ZoneKeys> kZoneFields[] = {
    {"center", into<read_vector, &ZoneKeys::center>, true},
    {"x", into<read_vector, &ZoneKeys::x>, true},
    {"y", into<read_vector, &ZoneKeys::y>, true},
    {"normal", [](Problems& p, const Place& at, Json v, ZoneKeys& k) { k.normal = read_direction(p, at, v); }},
    {"grid",
     [](Problems& p, const Place& at, Json v, ZoneKeys& k) {
       simdjson::dom::array list;
       if (v.get(list) != simdjson::SUCCESS || list.size() != 2) return wrong_type(p, at, "a list of 2 numbers", v);
       k.columns = read_integer(p, at.at(0), list.at(0).value_unsafe(), 1, kMostCells);
       k.rows = read_integer(p, at.at(1), list.at(1).value_unsafe(), 1, kMostCells);
     }},
};

// Points in the middle of the cells of a grid. The normal points upwards, or to the side that x cross y does not point to.
void add_zone(Problems& problems, const Place& place, Json value, LuxTarget& target) {
  const auto zone = read_object<ZoneKeys>(problems, place, value, kZoneFields);
  Vec3d normal = normalized(cross(zone.y, zone.x));
  if (zone.normal)
    normal = *zone.normal;
  else if (normal.y < -1e-9)
    normal = -normal;
  if (normal == Vec3d{}) return problems.add(place, "x and y are parallel", "give two directions");
  if (zone.columns > kMostCells || zone.rows > kMostCells) return;  // read_integer has said so
  for (std::int64_t j = 0; j < zone.rows; ++j)
    for (std::int64_t i = 0; i < zone.columns; ++i) {
      const double u = (2 * static_cast<double>(i) + 1) / static_cast<double>(zone.columns) - 1,
                   v = (2 * static_cast<double>(j) + 1) / static_cast<double>(zone.rows) - 1;
      target.points.push_back(zone.center + zone.x * u + zone.y * v);
      target.normals.push_back(normal);
    }
}

}  // namespace

// All keys of a target: which of them go together is judged afterwards.
struct SolveJobReader::TargetKeys {
  std::string picture, paint, camera, mask, mesh, name;
  Vec3d radiance{1, 1, 1};
  LightPart part = LightPart::all;
  double around = 0.1;
  std::optional<ResidualSpace> space;
  std::optional<ResidualLoss> loss;
  LuxTarget lux;
  std::optional<Vec3d> normal;
  double weight = 1, grid = 0.25;
  int kinds = 0;  // picture, zone, mesh, points: exactly one
  bool has_lux = false;
};

void SolveJobReader::read_fit(const Place& place, Json value) {
  simdjson::dom::object object;
  if (value.get(object) == simdjson::SUCCESS && object["material"].error() == simdjson::SUCCESS) return read_material_fit(place, value);
  FitKeys keys;
  read_fields(problems_, place, value, {}, std::span<const Field<FitKeys>>(kFitFields), keys);
  if (!keys.light.empty()) add_fits(keys.light, keys.fit, place.in("light"));
}

void SolveJobReader::read_material_fit(const Place& place, Json value) {
  MaterialKeys keys;
  read_fields(problems_, place, value, {}, std::span<const Field<MaterialKeys>>(kMaterialFields), keys);
  if (!keys.material.empty()) add_materials(keys.material, keys.fit, place.in("material"));
}

void SolveJobReader::read_tie(const Place& place, Json value) {
  const auto keys = read_object<TieKeys>(problems_, place, value, kTieFields);
  LightTie tie;
  std::size_t number = 0;
  for (const std::string& name : keys.lights) {
    const Place lights = place.in("lights");
    for (const std::size_t light : lights_named(name, lights.at(number))) tie.lights.push_back(light);
    ++number;
  }
  if (keys.mirror) {
    tie.has_mirror = true;
    tie.mirror_point = keys.mirror->point;
    tie.mirror_normal = keys.mirror->normal;
  }
  job_.ties.push_back(std::move(tie));
}

void SolveJobReader::add_mesh_points(const Place& place, const std::string& glob, double grid, LuxTarget& target) {
  if (!(grid > 0)) return problems_.add(place.in("grid"), "must be above 0");
  std::vector<std::string> names;
  bool found = false;
  for (const Mesh& mesh : scene_.meshes) {
    if (mesh.is_light_shape) continue;
    names.push_back(mesh.name);
    if (fnmatch(glob.c_str(), mesh.name.c_str(), 0) != 0) continue;
    found = true;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const auto corner = [&](std::size_t k) { return static_cast<Vec3d>(mesh.positions[mesh.indices[t + k]]); };
      const Vec3d a = corner(0), b = corner(1) - a, c = corner(2) - a, normal = normalized(cross(b, c));
      if (normal == Vec3d{}) continue;
      // The middles of equal triangles, whose sides are at most `grid` long.
      const double cells = std::ceil(std::max({length(b), length(c), length(c - b)}) / grid);
      if (static_cast<double>(target.points.size()) + cells * cells > static_cast<double>(kMostPoints))
        return problems_.add(place.in("grid"), "gives more than 200000 points", "choose a larger one");
      for (double i = 0; i < cells; ++i)
        for (double j = 0; i + j < cells; ++j)
          for (const double third : {1.0 / 3, 2.0 / 3}) {
            if (third > 0.5 && i + j + 1 >= cells) continue;
            target.points.push_back(a + b * ((i + third) / cells) + c * ((j + third) / cells));
            target.normals.push_back(normal);
          }
    }
  }
  if (found) return;
  const std::string near = nearest_word(glob, names);
  problems_.add(place.in("mesh"), "no mesh is named " + eval::quoted(glob),
                near.empty() ? "steradian info lists the meshes" : "did you mean '" + near + "'?");
}

void SolveJobReader::read_target(const Place& place, Json value, const std::string& folder) {
  static constexpr Field<TargetKeys> kFields[] = {
      {"picture", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.picture = read_string(p, at, v), ++k.kinds; }},
      {"paint", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.paint = read_string(p, at, v), ++k.kinds; }},
      {"radiance", into<read_colour, &TargetKeys::radiance>},
      {"around", into<read_not_negative, &TargetKeys::around>},
      {"part",
       [](Problems& p, const Place& at, Json v, TargetKeys& k) {
         if (const auto part = read_word<LightPart>(p, at, v)) k.part = *part;
       }},
      {"camera", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.camera = read_string(p, at, v); }},
      {"mask", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.mask = read_string(p, at, v); }},
      {"space", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.space = read_word<ResidualSpace>(p, at, v); }},
      {"loss", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.loss = read_word<ResidualLoss>(p, at, v); }},
      {"zone", [](Problems& p, const Place& at, Json v, TargetKeys& k) { add_zone(p, at, v, k.lux), ++k.kinds; }},
      {"mesh", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.mesh = read_string(p, at, v), ++k.kinds; }},
      {"grid", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.grid = read_number(p, at, v); }},
      {"points",
       [](Problems& p, const Place& at, Json v, TargetKeys& k) {
         if (const auto points = read_points(p, at, "a list of points", v)) k.lux.points = *points;
         ++k.kinds;
       }},
      {"normal", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.normal = read_direction(p, at, v); }},
      {"lux",
       [](Problems& p, const Place& at, Json v, TargetKeys& k) {
         k.lux.lux = read_lux(p, at, v);
         k.has_lux = true;
       }},
      {"weight", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.weight = read_number(p, at, v); }},
      {"name", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.name = read_string(p, at, v); }},
  };
  TargetKeys keys;
  read_fields(problems_, place, value, {}, std::span<const Field<TargetKeys>>(kFields), keys);
  if (!(keys.weight > 0)) problems_.add(place.in("weight"), "must be above 0");
  if (keys.kinds != 1)
    return problems_.add(place, keys.kinds == 0 ? "has no target" : "has several targets", "one of picture, paint, zone, mesh, points");
  const auto beside = [&](const std::string& path) { return path.empty() || path.front() == '/' ? path : folder + path; };
  if (!keys.picture.empty() || !keys.paint.empty()) {
    if (keys.has_lux) problems_.add(place.in("lux"), "a picture has none", "leave the key out");
    PictureTarget target;
    target.camera = keys.camera.empty() ? defaults_.camera : keys.camera;
    target.space = keys.space.value_or(defaults_.space);
    target.loss = keys.loss.value_or(defaults_.loss);
    target.weight = keys.weight;
    target.part = keys.part;
    check_camera(place.in("camera"), target.camera);
    if (!keys.paint.empty()) return add_strokes(place.in("paint"), beside(keys.paint), keys.radiance, keys.around, std::move(target));
    return add_picture(place.in("picture"), beside(keys.picture), beside(keys.mask), std::move(target));
  }
  if (!keys.has_lux) problems_.add(place.in("lux"), "missing", "what illuminance is wanted");
  if (!keys.mesh.empty()) add_mesh_points(place, keys.mesh, keys.grid, keys.lux);
  if (keys.lux.normals.empty()) keys.lux.normals.assign(keys.lux.points.size(), keys.normal.value_or(Vec3d{0, 1, 0}));
  keys.lux.weight = keys.weight;
  keys.lux.name = keys.name.empty() ? (keys.mesh.empty() ? place.text() : keys.mesh) : keys.name;
  job_.targets.emplace_back(std::move(keys.lux));
}

void SolveJobReader::add_file(const std::string& path) {
  Budget budget(limits_);
  const Bytes bytes = read_file(path, path, budget);
  const std::size_t slash = path.rfind('/');
  add_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, slash == std::string::npos ? "" : path.substr(0, slash + 1));
}

void SolveJobReader::add_text(std::string_view text, const std::string& place_text, const std::string& folder) {
  simdjson::dom::parser parser;
  Json root;
  const Place top, file = place_text.empty() ? top : top.in(place_text);
  const auto error = parser.parse(simdjson::padded_string(text)).get(root);
  if (error != simdjson::SUCCESS) return problems_.add(file, std::string("not JSON: ") + simdjson::error_message(error));
  simdjson::dom::object object;
  if (root.get(object) != simdjson::SUCCESS) return wrong_type(problems_, file, "an object", root);
  for (const auto [key, value] : object) {
    const Place place = file.in(key);
    if (key == "least") {
      job_.least_power = read_string(problems_, place, value) == "power";
      if (!job_.least_power) problems_.add(place, "is not known", "power is");
      continue;
    }
    if (key != "fit" && key != "tie" && key != "targets") {
      problems_.add(file.in(readable(key)), "unknown key", "known here: fit, tie, targets, least");
      continue;
    }
    simdjson::dom::array list;
    if (value.get(list) != simdjson::SUCCESS) {
      wrong_type(problems_, place, "a list", value);
      continue;
    }
    std::size_t number = 0;
    for (const Json entry : list) {
      const Place at = place.at(number++);
      if (key == "fit")
        read_fit(at, entry);
      else if (key == "tie")
        read_tie(at, entry);
      else
        read_target(at, entry, folder);
    }
  }
}

}  // namespace steradian::app
