#include "solve/job.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/files.h"
#include "core/words.h"
#include "solve/solved_file.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"
#include "wrong_use.h"

namespace steradian::app {
namespace {

using namespace eval;

constexpr std::size_t kMostPoints = 200'000;  // of one target

// Splits at a character; no empty text gives no parts.
std::vector<std::string> parts_of(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

const std::string& own_name(const Scene& scene, std::size_t number) {
  const std::size_t area = scene.area_lights.size();
  return number < area ? scene.area_lights[number].name : scene.punctual_lights[number - area].name;
}

std::size_t count_of_lights(const Scene& scene) { return scene.area_lights.size() + scene.punctual_lights.size(); }

bool set_parameter(const std::string& word, LightFit& fit) {
  bool* const value = word == "power"      ? &fit.power
                      : word == "color"    ? &fit.color
                      : word == "position" ? &fit.position
                      : word == "rotation" ? &fit.rotation
                      : word == "size"     ? &fit.size
                                           : nullptr;
  if (value != nullptr) *value = true;
  return value != nullptr;
}

const std::vector<std::string> kParameters = {"power", "color", "position", "rotation", "size"};

// Calls use(pixel, fraction) for the pixels of a picture within pixel (x, y) of another size.
template <class Use>
void each_within(const Picture& from, const Picture& to, int x, int y, Use use) {
  const double sx = static_cast<double>(from.width) / to.width, sy = static_cast<double>(from.height) / to.height;
  const double x0 = x * sx, x1 = (x + 1) * sx, y0 = y * sy, y1 = (y + 1) * sy;
  for (int j = static_cast<int>(y0); j < std::min(static_cast<int>(std::ceil(y1)), from.height); ++j)
    for (int i = static_cast<int>(x0); i < std::min(static_cast<int>(std::ceil(x1)), from.width); ++i)
      use(from.at(i, j),
          (std::min(x1, i + 1.0) - std::max(x0, static_cast<double>(i))) * (std::min(y1, j + 1.0) - std::max(y0, static_cast<double>(j))));
}

// Means over the pixels that a coarser or finer picture has in the same place.
Picture resampled(const Picture& from, int width, int height) {
  Picture to(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Vec3d sum{};
      double area = 0;
      each_within(from, to, x, y, [&](Vec3f p, double part) {
        sum += static_cast<Vec3d>(p) * part;
        area += part;
      });
      to.at(x, y) = static_cast<Vec3f>(sum / std::max(area, 1e-30));
    }
  return to;
}

// Weights of a resampled picture: 0 where a pixel mixes a lamp with what it lights.
std::vector<float> unmixed(const Picture& from, const Picture& to) {
  double mean = 0;
  for (const Vec3f& p : from.pixels) mean += luminance(static_cast<Vec3d>(p)) / static_cast<double>(from.pixels.size());
  std::vector<float> weights;
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      double least = std::numeric_limits<double>::infinity(), most = 0;
      each_within(from, to, x, y, [&](Vec3f p, double) {
        const double l = luminance(static_cast<Vec3d>(p));
        least = std::min(least, l);
        most = std::max(most, l);
      });
      weights.push_back(most > 4 * mean && least < 0.5 * most ? 0.0f : 1.0f);
    }
  return weights;
}

}  // namespace

std::string SolveJobReader::name_of_light(std::size_t number) const {
  const std::string& own = own_name(scene_, number);
  std::size_t before = 0, same = 0;
  for (std::size_t i = 0; i < count_of_lights(scene_); ++i) {
    if (own_name(scene_, i) != own) continue;
    ++same;
    before += i < number ? 1u : 0u;
  }
  const std::string base = own.empty() ? "light" : own;
  return same > 1 || own.empty() ? base + " " + std::to_string(before + 1) : base;
}

std::vector<std::size_t> SolveJobReader::lights_named(const std::string& glob, const Place& place) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  const std::size_t all = count_of_lights(scene_);
  for (std::size_t i = 0; i < all; ++i) {
    const std::string &own = own_name(scene_, i), name = name_of_light(i);
    if (fnmatch(glob.c_str(), own.c_str(), 0) == 0 || fnmatch(glob.c_str(), name.c_str(), 0) == 0) found.push_back(i);
    if (!own.empty()) names.push_back(name);
  }
  if (!found.empty()) return found;
  std::string hint = all == 0 ? "the scene has no light that shines" : nearest_word(glob, names);
  if (all > 0 && !hint.empty()) hint = "did you mean '" + hint + "'?";
  if (hint.empty()) {
    for (const std::string& name : nearest_beginnings(glob, names, 5)) hint += (hint.empty() ? "there are: " : ", ") + name;
    if (hint.empty()) hint = "the scene's lights have no names: * fits all of them";
  }
  problems_.add(place, "no light is named " + eval::quoted(glob), hint);
  return found;
}

// The lights of one emissive material shine alike: the first leads the others.
void SolveJobReader::add_fits(const std::string& glob, const LightFit& like, const Place& place) {
  for (const std::size_t light : lights_named(glob, place)) {
    const bool fitted = std::any_of(job_.fits.begin(), job_.fits.end(), [&](const LightFit& f) { return f.light == light; });
    if (fitted) {
      problems_.add(place, "light '" + name_of_light(light) + "' is fitted twice", "name each light once");
      continue;
    }
    const int material = material_of_light(scene_, light);
    if (material >= 0) {
      if (std::find(materials_.begin(), materials_.end(), material) != materials_.end()) continue;
      materials_.push_back(material);
      if (like.position || like.rotation || like.size || like.color)
        problems_.add(place, "light '" + name_of_light(light) + "' is an emissive mesh, whose power alone is fitted", "name power");
      LightTie tie{{light}};
      for (std::size_t i = 0; i < scene_.area_lights.size(); ++i)
        if (i != light && material_of_light(scene_, i) == material) tie.lights.push_back(i);
      if (tie.lights.size() > 1) job_.ties.push_back(std::move(tie));
    }
    job_.fits.push_back(like);
    job_.fits.back().light = light;
    job_.fits.back().name = name_of_light(light);
  }
}

void SolveJobReader::add_fit(const std::string& text) {
  const Place top, place = top.in("--fit");
  const std::size_t colon = text.rfind(':');
  LightFit fit;
  if (colon == std::string::npos) fit.power = true;
  for (const std::string& word : colon == std::string::npos ? std::vector<std::string>{} : parts_of(text.substr(colon + 1), ',')) {
    if (set_parameter(word, fit)) continue;
    const std::string near = nearest_word(word, kParameters);
    problems_.add(place, eval::quoted(word) + " is not a parameter",
                  near.empty() ? "power, color, position, rotation and size are" : "did you mean " + near + "?");
  }
  add_fits(text.substr(0, colon), fit, place);
}

void SolveJobReader::check_camera(const Place& place, const std::string& name) {
  std::vector<std::string> names;
  for (const Camera& camera : scene_.cameras) {
    if (name.empty() || camera.name == name) return;
    names.push_back(camera.name);
  }
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "there are: " : ", ") + n;
  problems_.add(place, "no camera is named " + eval::quoted(name), all);
}

void SolveJobReader::add_picture(const Place& place, const std::string& path, const std::string& mask, PictureTarget target) {
  try {
    target.picture = read_picture(path);
    const bool resample = defaults_.width > 0 && (target.picture.width != defaults_.width || target.picture.height != defaults_.height);
    const int width = target.picture.width, height = target.picture.height;
    if (resample) {
      Picture other = resampled(target.picture, defaults_.width, defaults_.height);
      target.pixel_weights = unmixed(target.picture, other);
      target.picture = std::move(other);
    }
    if (!mask.empty()) {
      Picture weights = read_picture(mask);
      if (weights.width != width || weights.height != height) {
        problems_.add(place,
                      mask + " is " + std::to_string(weights.width) + "x" + std::to_string(weights.height) + ", the target " +
                          std::to_string(width) + "x" + std::to_string(height),
                      "resample the mask");
        return;
      }
      if (resample) weights = resampled(weights, defaults_.width, defaults_.height);
      target.pixel_weights.resize(weights.pixels.size(), 1.0f);
      for (std::size_t i = 0; i < weights.pixels.size(); ++i) {
        const Vec3f& p = weights.pixels[i];
        target.pixel_weights[i] *= (p.x + p.y + p.z) / 3;
      }
    }
    job_.targets.emplace_back(std::move(target));
  } catch (const Error& e) {
    problems_.add(place, e.what());
  }
}

// Painted pixels want the radiance, and all others none of the part, with less weight.
void SolveJobReader::add_strokes(const Place& place, const std::string& path, Vec3d radiance, double around, PictureTarget target) {
  try {
    Picture strokes = read_picture(path);
    if (defaults_.width > 0) {
      const auto alpha = strokes.layers.find("alpha");
      if (alpha != strokes.layers.end()) strokes.pixels = alpha->second;
      strokes = resampled(strokes, defaults_.width, defaults_.height);
    } else if (const auto alpha = strokes.layers.find("alpha"); alpha != strokes.layers.end()) {
      strokes.pixels = alpha->second;
    }
    target.picture = Picture(strokes.width, strokes.height);
    for (std::size_t i = 0; i < strokes.pixels.size(); ++i) {
      const Vec3f& p = strokes.pixels[i];
      const float painted = std::min(std::max({p.x, p.y, p.z}), 1.0f);
      if (painted > 0.01f) target.picture.pixels[i] = static_cast<Vec3f>(radiance);
      target.pixel_weights.push_back(painted > 0.01f ? painted : static_cast<float>(around));
    }
    job_.targets.emplace_back(std::move(target));
  } catch (const Error& e) {
    problems_.add(place, e.what());
  }
}

void SolveJobReader::add_target(const std::string& picture, const std::string& mask) {
  const Place top;
  check_camera(top.in("--camera"), defaults_.camera);
  PictureTarget target;
  target.camera = defaults_.camera;
  target.space = defaults_.space;
  target.loss = defaults_.loss;
  add_picture(top.in("--target"), picture, mask, std::move(target));
}

namespace {

template <class T>
T read_object(Problems& problems, const Place& place, Json value, std::span<const Field<T>> fields) {
  T result{};
  read_fields(problems, place, value, {}, fields, result);
  return result;
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
    {"keep", [](Problems& p, const Place& at, Json v, FitKeys& k) { k.fit.keep = read_not_negative(p, at, v); }},
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
       k.columns = read_integer(p, at.at(0), list.at(0).value_unsafe(), 1, 1000);
       k.rows = read_integer(p, at.at(1), list.at(1).value_unsafe(), 1, 1000);
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
  FitKeys keys;
  read_fields(problems_, place, value, {}, std::span<const Field<FitKeys>>(kFitFields), keys);
  if (!keys.light.empty()) add_fits(keys.light, keys.fit, place.in("light"));
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
         const auto part = words::find<LightPart>(read_string(p, at, v));
         if (!part) return p.add(at, "is not known", words::choices<LightPart>());
         k.part = *part;
       }},
      {"camera", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.camera = read_string(p, at, v); }},
      {"mask", [](Problems& p, const Place& at, Json v, TargetKeys& k) { k.mask = read_string(p, at, v); }},
      {"space",
       [](Problems& p, const Place& at, Json v, TargetKeys& k) {
         k.space = words::find<ResidualSpace>(read_string(p, at, v));
         if (!k.space) p.add(at, "is not known", words::choices<ResidualSpace>());
       }},
      {"loss",
       [](Problems& p, const Place& at, Json v, TargetKeys& k) {
         k.loss = words::find<ResidualLoss>(read_string(p, at, v));
         if (!k.loss) p.add(at, "is not known", words::choices<ResidualLoss>());
       }},
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

SolveJob SolveJobReader::finish() {
  const Place top;
  if (job_.fits.empty() && !problems_.any()) problems_.add(top, "nothing to fit", "name lights with --fit, or in the file of --spec");
  if (job_.targets.empty() && !problems_.any()) problems_.add(top, "no target", "give --target, or targets in the file of --spec");
  if (problems_.any()) problems_.raise();
  return std::move(job_);
}

}  // namespace steradian::app
