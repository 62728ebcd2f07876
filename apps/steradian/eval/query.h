// Query: one question of `steradian eval`, read from a line of JSON.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "integrals/ltc/table.h"
#include "integrals/methods.h"
#include "shadow/visible_part.h"
#include "shapes/shape.h"
#include "steradian/material.h"
#include "steradian/area_light.h"

namespace steradian::eval {

using Light = std::variant<AreaLight, PointLight, DirectionalLight>;

struct Query {
  std::vector<Light> lights;  // at least one; their light adds
  Vec3d position;
  Vec3d normal;               // unit
  std::optional<Vec3d> view;  // unit; absent only where every material is lambert
  std::vector<Material> materials;
  Method method = Method::automatic;
  Precision precision = Precision::double_;
  Quality quality = Quality::normal;
  int spp = 256;
  std::uint64_t seed = 1;
  std::shared_ptr<const ClassicTable> table;           // of ltc: in place of GGX's
  bool derivatives = false;                            // of the radiance by the light's vertices, its radiance and the lobe's parameters
  std::shared_ptr<const shadow::Occluders> occluders;  // none: nothing blocks
  bool occluders_are_listed = false;                   // by the query itself, not by the name of a scene
  std::optional<Vec3d> geometric_normal;               // unit, of the triangle that the position is on; none: the normal
};

struct QueryDefaults {
  Method method = Method::automatic;
  int spp = 256;
  std::uint64_t seed = 1;
};

// Bytes that must be readable (not meaningful) behind the text of a query.
inline constexpr std::size_t kQueryPadding = 64;

// Reads queries one after the other and keeps its memory between them.
class QueryReader {
 public:
  explicit QueryReader(QueryDefaults defaults = {});
  ~QueryReader();

  // line: one JSON object, with kQueryPadding readable bytes behind its end.
  // Throws Error that names every wrong key by its path (light.vertices[2]) and says what is expected there.
  Query read(std::string_view line);

  // The key `id` of the line last read, as its JSON stands there; empty where it has none.
  const std::string& id() const { return id_; }

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  QueryDefaults defaults_;
  std::string id_;
};

}  // namespace steradian::eval
