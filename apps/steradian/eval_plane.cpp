#include "eval_plane.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "steradian/error.h"

namespace steradian::app {
namespace {

using nlohmann::ordered_json;

ordered_json triple(Vec3d v) { return {v.x, v.y, v.z}; }

template <class T>
T number(const ordered_json& query, const char* key, T otherwise) {
  if (!query.contains(key)) return otherwise;
  if (!query[key].is_number_unsigned()) throw Error(key, "not a whole number");
  return query[key].get<T>();
}

int bounces_of(const ordered_json& query) {
  if (!query.contains("bounces")) return 0;
  if (query["bounces"] == "all") return kAllBounces;
  const auto count = number(query, "bounces", std::uint64_t{0});
  if (count > 100000) throw Error("bounces", "more than 100000", "use \"all\"");
  return static_cast<int>(count);
}

}  // namespace

const PlaneWorld& PlaneAnswers::world(const std::string& path) {
  const auto known = worlds_.find(path);
  if (known != worlds_.end()) return known->second;
  return worlds_.emplace(path, PlaneWorld(load_plane_scene(path, defaults_.limits).scene, defaults_.limits)).first->second;
}

const PlaneBounces& PlaneAnswers::bounces(const std::string& path, int count) {
  const auto known = bounces_.find({path, count});
  if (known != bounces_.end()) return known->second;
  PlaneBounceOptions options;
  options.bounces = count;
  options.limits = defaults_.limits;
  return bounces_.emplace(std::pair(path, count), PlaneBounces(world(path), options)).first->second;
}

std::string PlaneAnswers::answer(std::string_view line) {
  const ordered_json query = ordered_json::parse(line);
  if (!query.is_object()) throw Error("", "a query is a JSON object");
  for (const auto& [key, value] : query.items())
    if (key != "scene" && key != "position" && key != "method" && key != "spp" && key != "seed" && key != "moments" && key != "bounces")
      throw Error(key, "unknown key", "use scene, position, method, spp, seed, moments and bounces");
  if (!query.contains("scene") || !query["scene"].is_string()) throw Error("scene", "give the name of an SVG file");
  if (!query.contains("position")) throw Error("position", "give two numbers");
  const auto& p = query["position"];
  if (!p.is_array() || p.size() != 2 || !p[0].is_number() || !p[1].is_number()) throw Error("position", "give two numbers");
  PlaneMethod method = defaults_.method;
  if (query.contains("method")) {
    if (!query["method"].is_string()) throw Error("method", "not a text");
    method = plane_method_from_name(query["method"].get<std::string>());
  }
  PlaneSampling sampling = defaults_.sampling;
  sampling.spp = number(query, "spp", sampling.spp);
  sampling.seed = number(query, "seed", sampling.seed);
  if (sampling.spp < 1) throw Error("spp", "must be at least 1");
  const std::string scene = query["scene"].get<std::string>();
  const Vec2d at{p[0].get<double>(), p[1].get<double>()};
  const int count = bounces_of(query);
  if (count != 0 && method != PlaneMethod::exact) throw Error("bounces", "are added to exact light only", "use method exact");
  PlaneLight light = world(scene).query(at, method, sampling);
  ordered_json result = {{"mean_radiance", triple(light.radiance)}, {"method", name_of(method)}};
  if (count != 0) {
    const PlaneBounces& walls = bounces(scene, count);
    const PlaneLight bounced = walls.query(at);
    light.radiance += bounced.radiance;
    light.moment_x += bounced.moment_x;
    light.moment_y += bounced.moment_y;
    result["mean_radiance"] = triple(light.radiance);
    result["bounced"] = triple(bounced.radiance);
    result["bounce_error"] = triple(walls.error(at));
  }
  if (query.contains("moments") && query["moments"].is_boolean() && query["moments"].get<bool>()) {
    result["moment_x"] = triple(light.moment_x);
    result["moment_y"] = triple(light.moment_y);
  }
  return result.dump();
}

bool PlaneAnswers::answer_line(std::string_view line, std::string& out) {
  std::string problem;
  try {
    out += answer(line) + "\n";
    return true;
  } catch (const nlohmann::json::exception& e) {
    problem = std::string("not a query: ") + e.what();
  } catch (const std::exception& e) {
    problem = e.what();
  }
  out += ordered_json{{"error", problem}}.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  return false;
}

}  // namespace steradian::app
