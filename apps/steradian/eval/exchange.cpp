#include "eval/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "eval/answer.h"
#include "eval/json_object.h"
#include "exchange/obstacles/obstructed.h"

namespace steradian::eval {
namespace {

using exchange::ObstacleTriangle;
using exchange::PlaneElement;

struct Outlines {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<Vec3d>> holes;
};

constexpr Field<Outlines> kOutlineFields[] = {
    {"vertices", into<read_contour, &Outlines::vertices>, true},
    {"holes",
     [](Problems& problems, const Place& place, Json value, Outlines& o) {
       simdjson::dom::array holes;
       if (value.get(holes) != simdjson::SUCCESS) return wrong_type(problems, place, "a list of holes", value);
       std::size_t number = 0;
       for (const Json hole : holes) o.holes.push_back(read_contour(problems, place.at(number++), hole));
     }},
};

// A list of points, or an object with vertices and holes.
PlaneElement read_element(Problems& problems, const Place& place, Json value) {
  Outlines outlines;
  if (value.is_object())
    read_fields(problems, place, value, {}, std::span<const Field<Outlines>>(kOutlineFields), outlines);
  else
    outlines.vertices = read_contour(problems, place, value);
  if (problems.any()) return {};
  try {
    return exchange::make_element(outlines.vertices, outlines.holes, place.text());
  } catch (const Error& e) {
    problems.add(place, e.problem(), e.hint());
  }
  return {};
}

struct ExchangeQuery {
  PlaneElement from, to;
  std::vector<ObstacleTriangle> obstacles;
  double eps = 1e-8;
};

void read_obstacles(Problems& problems, const Place& place, Json value, ExchangeQuery& query) {
  simdjson::dom::array polygons;
  if (value.get(polygons) != simdjson::SUCCESS) return wrong_type(problems, place, "a list of polygons", value);
  std::size_t number = 0;
  for (const Json polygon : polygons) {
    const Place at = place.at(number++);
    const PlaneElement element = read_element(problems, at, polygon);
    if (problems.any()) return;
    try {
      for (const PlaneElement& t : exchange::triangles_of_element(element, at.text()))
        query.obstacles.push_back({t.contours[0][0], t.contours[0][1], t.contours[0][2]});
    } catch (const Error& e) {
      problems.add(at, e.problem(), e.hint());
    }
  }
}

constexpr Field<ExchangeQuery> kExchangeFields[] = {
    {"id", [](Problems&, const Place&, Json, ExchangeQuery&) {}},
    {"from", into<read_element, &ExchangeQuery::from>, true},
    {"to", into<read_element, &ExchangeQuery::to>, true},
    {"obstacles", read_obstacles},
    {"eps",
     [](Problems& problems, const Place& place, Json value, ExchangeQuery& query) {
       query.eps = read_number(problems, place, value);
       if (!(query.eps >= 1e-14 && query.eps <= 0.1)) problems.add(place, "must lie between 1e-14 and 0.1");
     }},
};

}  // namespace

std::optional<bool> answer_exchange(std::string_view line, std::string& out) {
  if (line.find("\"from\"") == std::string_view::npos) return {};
  thread_local simdjson::dom::parser parser;
  Json root, from, given;
  if (parser.parse(line.data(), line.size(), false).get(root) != simdjson::SUCCESS || !root.is_object() ||
      root.at_key("from").get(from) != simdjson::SUCCESS)
    return {};
  std::string id;
  if (root.at_key("id").get(given) == simdjson::SUCCESS && (given.is_string() || given.is_number())) id = simdjson::minify(given);
  try {
    Problems problems;
    ExchangeQuery query;
    read_fields(problems, Place{}, root, {}, std::span<const Field<ExchangeQuery>>(kExchangeFields), query);
    if (problems.any()) problems.raise();
    const exchange::ExchangeArea h =
        exchange::visible_exchange(query.from, query.to, exchange::Obstacles(query.obstacles), query.eps).visible;
    const double factor = h.value / query.from.area, bound = h.error / query.from.area;
    if (!std::isfinite(factor) || !std::isfinite(bound))
      throw Error("from", "the result is out of the range of numbers", "scale the polygons to sizes near 1");
    const std::string head = id.empty() ? "" : "\"id\":" + id + ",";
    fmt::format_to(std::back_inserter(out), "{{{}\"view_factor\":{},\"bound\":{},\"exchange_area\":{},\"exchange_area_bound\":{}}}\n", head,
                   factor, bound, h.value, h.error);
    return true;
  } catch (const Error& e) {
    write_error(out, e.what(), id);
    return false;
  }
}

}  // namespace steradian::eval
