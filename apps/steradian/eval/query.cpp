// The keys of a query: one table per object, one row per light type. The keys of lobes are in lobes/keys.h.
#include "eval/query.h"

#include <limits>
#include <optional>

#include "core/words.h"
#include "eval/json_object.h"
#include "lobes/lobe.h"
#include "scene/table_file.h"
#include "steradian/load_scene.h"

namespace steradian::eval {
namespace {

// ---- Lights ----------------------------------------------------------------------------------------------------

// Values of the keys of any light type, before the light is known to be complete.
struct LightKeys {
  Polygon polygon;
  Vec3d radiance{1, 1, 1};
  bool two_sided = false;
  Vec3d center, x, y, z;
  double radius = 0;
  Capsule shape;  // without its radius
  PointLight point_light;
  std::shared_ptr<const LightProfile> profile;  // for a point, a rect or a disk
  Vec3d intensity{1, 1, 1};                     // intensity of a point, or the factor of the other lights' profile
  bool has_radiance = false;
  Vec3d aim{0, -1, 0};             // aim of a point's profile
  std::optional<Vec3d> towards_x;  // the x axis of a profile
  DirectionalLight directional_light;
};

using LightField = Field<LightKeys>;

// Reads a file's profile. The last file is cached for further lines that name it.
std::shared_ptr<const LightProfile> read_profile(Problems& problems, const Place& place, Json value) {
  const std::string_view name = read_string(problems, place, value);
  if (!value.is_string()) return nullptr;
  thread_local std::pair<std::string, std::shared_ptr<const LightProfile>> last;
  try {
    if (last.first != name || last.second == nullptr)
      last = {std::string(name), std::make_shared<const LightProfile>(read_light_profile(std::string(name)))};
    return last.second;
  } catch (const Error& e) {
    problems.add(place, e.what());
    return nullptr;
  }
}

constexpr LightField kRadiance = {"radiance", [](Problems& p, const Place& at, Json v, LightKeys& k) {
                                    k.radiance = read_colour(p, at, v);
                                    k.has_radiance = true;
                                  }};
constexpr LightField kIntensity = {"intensity", into<read_colour, &LightKeys::intensity>};
constexpr LightField kProfile = {"profile", into<read_profile, &LightKeys::profile>};
constexpr LightField kTowardsX = {"tangent", into<read_direction, &LightKeys::towards_x>};
constexpr LightField kTwoSided = {"two_sided", into<read_bool, &LightKeys::two_sided>};
constexpr LightField kCenter = {"center", into<read_vector, &LightKeys::center>, true};
constexpr LightField kHalfAxisX = {"x", into<read_vector, &LightKeys::x>, true};
constexpr LightField kHalfAxisY = {"y", into<read_vector, &LightKeys::y>, true};
constexpr LightField kHalfAxisZ = {"z", into<read_vector, &LightKeys::z>, true};
constexpr LightField kRadius = {"radius", into<read_not_negative, &LightKeys::radius>, true};

constexpr LightField kPolygonFields[] = {
    {"vertices", into<read_contour, &LightKeys::polygon, &Polygon::vertices>, true},
    {"holes",
     [](Problems& p, const Place& at, Json v, LightKeys& k) {
       simdjson::dom::array holes;
       if (v.get(holes) != simdjson::SUCCESS) return wrong_type(p, at, "a list of holes", v);
       for (const Json hole : holes) k.polygon.holes.push_back(read_contour(p, at.at(k.polygon.holes.size()), hole));
     }},
    kRadiance,
    kTwoSided,
};
constexpr LightField kRectFields[] = {kCenter, kHalfAxisX, kHalfAxisY, kRadiance, kTwoSided, kProfile, kIntensity, kTowardsX};
constexpr LightField kSphereFields[] = {kCenter, kRadius, kRadiance};
constexpr LightField kEllipsoidFields[] = {kCenter, kHalfAxisX, kHalfAxisY, kHalfAxisZ, kRadiance};
constexpr LightField kCapsuleFields[] = {
    {"ends",
     [](Problems& p, const Place& at, Json v, LightKeys& k) {
       const auto ends = read_points(p, at, "a list of two points", v);
       if (ends && ends->size() != 2) p.add(at, "expected 2 points, found " + std::to_string(ends->size()));
       if (ends && ends->size() == 2) k.shape = {(*ends)[0], (*ends)[1], 0};
     },
     true},
    kRadius,
    kRadiance,
};
constexpr LightField kPointFields[] = {
    {"position", into<read_vector, &LightKeys::point_light, &PointLight::position>, true},
    kIntensity,
    kProfile,
    {"aim", into<read_direction, &LightKeys::aim>},
    kTowardsX,
};

constexpr LightField kDirectionalFields[] = {
    {"direction", into<read_direction, &LightKeys::directional_light, &DirectionalLight::direction>, true},
    {"illuminance", into<read_colour, &LightKeys::directional_light, &DirectionalLight::illuminance>},
};

Light solid(Shape shape, const LightKeys& k) {
  AreaLight light;
  light.shape = std::move(shape);
  light.radiance = k.radiance;
  return light;
}
Light flat(Shape shape, const LightKeys& k) {
  Light light = solid(std::move(shape), k);
  std::get<AreaLight>(light).two_sided = k.two_sided;
  return light;
}

// A rect or a disk, which may have a profile.
Light lamp(Shape shape, const LightKeys& k) {
  Light light = flat(std::move(shape), k);
  if (k.profile != nullptr) set_emission(std::get<AreaLight>(light), k.profile, k.towards_x.value_or(k.x), k.intensity);
  return light;
}

Light polygon_of(LightKeys&& k) { return flat(std::move(k.polygon), k); }
Light rect_of(LightKeys&& k) {
  return lamp(Polygon{{k.center - k.x - k.y, k.center + k.x - k.y, k.center + k.x + k.y, k.center - k.x + k.y}, {}}, k);
}
Light disk_of(LightKeys&& k) { return lamp(Ellipse{k.center, k.x, k.y}, k); }
Light ellipsoid_of(LightKeys&& k) { return solid(Ellipsoid{k.center, k.x, k.y, k.z}, k); }
Light sphere_of(LightKeys&& k) { return solid(Ellipsoid{k.center, {k.radius, 0, 0}, {0, k.radius, 0}, {0, 0, k.radius}}, k); }
Light capsule_of(LightKeys&& k) { return solid(capsule_or_line(k.shape.end_a, k.shape.end_b, k.radius), k); }
Light point_of(LightKeys&& k) {
  k.point_light.profile = k.profile;
  k.point_light.intensity = k.intensity;
  k.point_light.axes = profile_axes(k.aim, k.towards_x.value_or(Vec3d{1, 0, 0}));
  return k.point_light;
}
Light directional_of(LightKeys&& k) { return k.directional_light; }

struct LightRow {
  std::string_view name;
  std::span<const LightField> fields;
  Light (*finish)(LightKeys&&);
};
constexpr LightRow kLights[] = {
    {"polygon", kPolygonFields, polygon_of},
    {"rect", kRectFields, rect_of},
    {"disk", kRectFields, disk_of},
    {"sphere", kSphereFields, sphere_of},
    {"ellipsoid", kEllipsoidFields, ellipsoid_of},
    {"capsule", kCapsuleFields, capsule_of},
    {"point", kPointFields, point_of},
    {"directional", kDirectionalFields, directional_of},
};

bool has_axes(const LightRow& row) { return row.finish == rect_of || row.finish == disk_of; }

void read_light(Problems& problems, const Place& place, Json value, Query& query) {
  const LightRow* row = read_tag<LightRow>(problems, place, value, "type", kLights);
  if (row == nullptr) return;
  LightKeys keys;
  read_fields(problems, place, value, "type", row->fields, keys);
  if (keys.profile != nullptr && keys.has_radiance)
    problems.add(place.in("radiance"), "given beside \"profile\"", "its factor is \"intensity\"");
  if (keys.profile == nullptr && has_axes(*row)) {
    Json given;
    for (const char* key : {"intensity", "tangent"})
      if (value.at_key(key).get(given) == simdjson::SUCCESS) problems.add(place.in(key), "given without \"profile\"", "use \"radiance\"");
  }
  query.light_type = row->name;
  query.lights.push_back(row->finish(std::move(keys)));
}

void read_lights(Problems& problems, const Place& place, Json value, Query& query) {
  simdjson::dom::array list;
  if (value.get(list) != simdjson::SUCCESS) return wrong_type(problems, place, "a list of lights", value);
  std::size_t i = 0;
  for (const Json light : list) read_light(problems, place.at(i++), light, query);
  if (i == 0) problems.add(place, "the list is empty", "give at least one light");
}

// ---- Materials -------------------------------------------------------------------------------------------------

}  // namespace

using lobes::Draft;
using lobes::Key;
using lobes::KeyKind;
using lobes::KeyValue;

namespace {

constexpr Field<AxisPower> kFactorFields[] = {{"axis", into<read_direction, &AxisPower::axis>, true},
                                              {"exponent", into<read_not_negative, &AxisPower::exponent>, true}};

std::vector<AxisPower> read_factors(Problems& problems, const Place& place, Json value) {
  std::vector<AxisPower> factors;
  simdjson::dom::array list;
  if (value.get(list) != simdjson::SUCCESS) {
    wrong_type(problems, place, "a list of {axis, exponent}", value);
    return factors;
  }
  for (const Json one : list) {
    const Place at = place.at(factors.size());
    AxisPower& factor = factors.emplace_back();
    if (one.is_object())
      read_fields(problems, at, one, {}, std::span<const Field<AxisPower>>(kFactorFields), factor);
    else
      wrong_type(problems, at, "an object with axis and exponent", one);
  }
  return factors;
}

}  // namespace

// The read_key of Field is the other overload; read_fields finds both by the namespace of their arguments.
static void read_key(Problems& p, const Place& at, Json v, const Key& key, Draft& draft) {
  KeyValue value;
  switch (key.kind) {
    case KeyKind::not_negative: value.number = read_not_negative(p, at, v); break;
    case KeyKind::share:
      value.number = read_number(p, at, v);
      if (value.number < 0 || value.number > 1) p.add(at, "must be from 0 to 1");
      break;
    case KeyKind::colour: value.vector = read_colour(p, at, v); break;
    case KeyKind::direction: value.vector = read_direction(p, at, v); break;
    case KeyKind::flag: value.flag = read_bool(p, at, v); break;
    case KeyKind::factors: value.factors = read_factors(p, at, v); break;
    case KeyKind::word:
      value.word = read_string(p, at, v);
      if (v.is_string() && !words::contains(key.words, value.word))
        p.add(at, eval::quoted(value.word) + " is not known", "one of: " + std::string(key.words));
      break;
  }
  key.set(draft, value);
}

namespace {

void read_material(Problems& problems, const Place& place, Json value, Query& query) {
  const lobes::LobeRow* row = read_tag<lobes::LobeRow>(problems, place, value, "brdf", lobes::lobe_rows());
  if (row == nullptr) return;
  Draft draft;
  draft.material.brdf = row->brdf;
  read_fields(problems, place, value, "brdf", row->keys, draft);
  if (const auto wrong = lobes::check_width(draft))
    problems.add(place.in(wrong->key), std::string(wrong->problem), std::string(wrong->hint));
  query.materials.push_back(draft.material);
}

void read_materials(Problems& problems, const Place& place, Json value, Query& query) {
  simdjson::dom::array list;
  if (value.get(list) != simdjson::SUCCESS) return read_material(problems, place, value, query);
  std::size_t i = 0;
  for (const Json material : list) read_material(problems, place.at(i++), material, query);
  if (i == 0) problems.add(place, "the list is empty", "give at least one material");
}

// ---- The query -------------------------------------------------------------------------------------------------

Method read_method(Problems& problems, const Place& place, Json value) {
  const std::string_view name = read_string(problems, place, value);
  const std::optional<Method> method = method_of(name);
  if (value.is_string() && !method) problems.add(place, quoted(name) + " is not supported", "supported: " + methods::names());
  return method.value_or(Method::automatic);
}

template <class Value>
Value read_word(Problems& problems, const Place& place, Json value) {
  const std::string_view name = read_string(problems, place, value);
  const std::optional<Value> found = words::find<Value>(name);
  if (value.is_string() && !found) problems.add(place, quoted(name) + " is not known", words::choices<Value>());
  return found.value_or(Value{});
}

// {"positions": [...], "indices": [...]}
struct MeshKeys {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
};
constexpr Field<MeshKeys> kMeshFields[] = {
    {"positions",
     [](Problems& p, const Place& at, Json v, MeshKeys& k) {
       if (auto points = read_points(p, at, "a list of points", v)) k.positions = std::move(*points);
     },
     true},
    {"indices",
     [](Problems& p, const Place& at, Json v, MeshKeys& k) {
       simdjson::dom::array list;
       if (v.get(list) != simdjson::SUCCESS) return wrong_type(p, at, "a list of whole numbers", v);
       for (const Json i : list)
         k.indices.push_back(
             static_cast<std::uint32_t>(read_integer(p, at.at(k.indices.size()), i, 0, std::numeric_limits<std::int32_t>::max())));
       if (k.indices.size() % 3 != 0) p.add(at, "expected three a triangle, found " + std::to_string(k.indices.size()));
     },
     true},
};

// Reads a file's triangles. The last file is cached for further lines that name it.
std::shared_ptr<const shadow::Occluders> occluders_in(const std::string& file) {
  thread_local std::pair<std::string, std::shared_ptr<const shadow::Occluders>> last;
  if (last.first != file || last.second == nullptr) {
    LoadOptions options;
    options.near_origin = true;
    const LoadedScene loaded = load_scene(file, options);
    auto [positions, indices] = shadow::blocking_triangles(loaded.scene);
    for (Vec3d& p : positions) p += loaded.origin;
    last = {file, std::make_shared<shadow::Occluders>(shadow::build_edges(positions, indices))};
  }
  return last.second;
}

// The last file is cached, as above.
void read_table(Problems& problems, const Place& place, Json value, Query& query) {
  const std::string_view name = read_string(problems, place, value);
  if (!value.is_string()) return;
  thread_local std::pair<std::string, std::shared_ptr<const ClassicTable>> last;
  try {
    if (last.first != name || last.second == nullptr)
      last = {std::string(name), std::make_shared<const ClassicTable>(scene::read_classic_table(std::string(name)))};
    query.table = last.second;
  } catch (const Error& e) {
    problems.add(place, e.what());
  }
}

// Reads the name of a scene file, a mesh, or triangles as lists of three points.
void read_occluders(Problems& problems, const Place& place, Json value, Query& query) {
  std::string_view name;
  if (value.get(name) == simdjson::SUCCESS) {
    try {
      query.occluders = occluders_in(std::string(name));
    } catch (const Error& e) {
      problems.add(place, e.what());
    }
    return;
  }
  MeshKeys mesh;
  simdjson::dom::array triangles;
  if (value.is_object()) {
    read_fields(problems, place, value, {}, std::span<const Field<MeshKeys>>(kMeshFields), mesh);
    for (const std::uint32_t i : mesh.indices)
      if (i >= mesh.positions.size()) return problems.add(place.in("indices"), std::to_string(i) + " is none of the positions");
  } else if (value.get(triangles) == simdjson::SUCCESS) {
    std::size_t number = 0;
    for (const Json t : triangles) {
      const Place at = place.at(number++);
      const auto corners = read_points(problems, at, "a triangle of three points", t);
      if (!corners) continue;
      if (corners->size() != 3) {
        problems.add(at, "expected 3 points, found " + std::to_string(corners->size()));
        continue;
      }
      for (const Vec3d& corner : *corners) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(corner);
      }
    }
  } else {
    return wrong_type(problems, place, "triangles, a mesh or the name of a scene", value);
  }
  query.occluders_are_listed = true;
  if (!problems.any()) query.occluders = std::make_shared<shadow::Occluders>(shadow::build_edges(mesh.positions, mesh.indices));
}

constexpr Field<Query> kQueryFields[] = {
    {"id",
     [](Problems& p, const Place& at, Json v, Query&) {
       if (!v.is_string() && !v.is_number()) wrong_type(p, at, "a string or a number", v);
     }},
    {"light", read_light},
    {"lights", read_lights},
    {"position", into<read_vector, &Query::position>, true},
    {"normal", into<read_direction, &Query::normal>, true},
    {"view", into<read_direction, &Query::view>},
    {"material", read_materials, true},
    {"method", into<read_method, &Query::method>},
    {"precision", into<read_word<Precision>, &Query::precision>},
    {"quality", into<read_word<Quality>, &Query::quality>},
    {"spp", [](Problems& p, const Place& at, Json v,
               Query& q) { q.spp = static_cast<int>(read_integer(p, at, v, 1, std::numeric_limits<int>::max())); }},
    {"seed", [](Problems& p, const Place& at, Json v,
                Query& q) { q.seed = static_cast<std::uint64_t>(read_integer(p, at, v, 0, std::numeric_limits<std::int64_t>::max())); }},
    {"table", read_table},
    {"peak_form", into<read_word<PeakForm>, &Query::peak_form>},
    {"early_stop", into<read_not_negative, &Query::early_stop>},
    {"occluders", read_occluders},
    {"geometric_normal", into<read_direction, &Query::geometric_normal>},
    {"derivatives", into<read_bool, &Query::derivatives>},
};

}  // namespace

struct QueryReader::Parser {
  simdjson::dom::parser json;
};

QueryReader::QueryReader(QueryDefaults defaults) : parser_(std::make_unique<Parser>()), defaults_(defaults) {}
QueryReader::~QueryReader() = default;

Query QueryReader::read(std::string_view line) {
  static_assert(kQueryPadding >= simdjson::SIMDJSON_PADDING);
  id_.clear();
  Json root;
  const auto error = parser_->json.parse(line.data(), line.size(), false).get(root);
  if (error == simdjson::CAPACITY || error == simdjson::MEMALLOC) throw Error("", "the line is too long to be read");
  if (error != simdjson::SUCCESS)
    throw Error("", std::string("not JSON: ") + simdjson::error_message(error),
                "one object a line; numbers are decimals within the range of double, so no NaN and no Infinity");

  Query query;
  query.method = defaults_.method;
  query.spp = defaults_.spp;
  query.seed = defaults_.seed;
  Problems problems;
  const Place top;
  if (!root.is_object()) throw Error("", std::string("expected an object, found ") + type_name(root));
  Json id, one, several;
  if (root.at_key("id").get(id) == simdjson::SUCCESS && (id.is_string() || id.is_number())) id_ = simdjson::minify(id);
  read_fields(problems, top, root, {}, std::span<const Field<Query>>(kQueryFields), query);
  const bool has_one = root.at_key("light").get(one) == simdjson::SUCCESS,
             has_list = root.at_key("lights").get(several) == simdjson::SUCCESS;
  if (!has_one && !has_list) problems.add(top.in("light"), "missing", "or \"lights\", a list");
  if (has_one && has_list) problems.add(top.in("lights"), "given beside \"light\"", "put all of them into the list");
  if (!problems.any() && !query.view)
    for (const Material& m : query.materials)
      if (m.brdf != Brdf::lambert) {
        problems.add(top.in("view"), "missing", std::string("brdf ") + name_of(m.brdf) + " depends on it");
        break;
      }
  if (query.table != nullptr && query.method != Method::ltc && query.method != Method::reference && query.method != Method::sampled)
    problems.add(top.in("table"), "only the methods ltc, reference and sampled read one", "add \"method\": \"ltc\"");
  if (query.table != nullptr && query.derivatives) problems.add(top.in("table"), "has no derivatives", "leave one of the keys out");
  for (Material& m : query.materials) {
    if (query.table == nullptr || m.brdf != Brdf::ggx) continue;
    if (m.alpha_x != m.alpha_y) problems.add(top.in("table"), "serves isotropic ggx", "give the material one width");
    m.fitted = query.table.get();
  }
  if (problems.any()) problems.raise();
  return query;
}

}  // namespace steradian::eval
