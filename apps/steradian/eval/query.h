// Query: one query of `steradian eval`, read from a line of JSON.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "integrals/methods.h"
#include "integrals/tables/table.h"
#include "shadow/region/visible_part.h"
#include "shapes/shape.h"
#include "steradian/area_light.h"
#include "steradian/material.h"

namespace steradian::eval {

using Light = std::variant<AreaLight, PointLight, DirectionalLight>;

struct Query {
  std::vector<Light> lights;    // at least one; their contributions add
  std::string_view light_type;  // of the last one, as in its key "type"
  Vec3d position;
  Vec3d normal;               // unit
  std::optional<Vec3d> view;  // unit; absent only where every material is lambert
  std::vector<Material> materials;
  Method method = Method::automatic;
  Precision precision = Precision::double_;
  Quality quality = Quality::normal;
  int spp = 256;
  std::uint64_t seed = 1;
  std::shared_ptr<const ClassicTable> table;           // table for ltc, instead of GGX's
  PeakForm peak_form = PeakForm::best;                 // for lorentzian, pearson and ellipsoid
  double early_stop = 0;                               // for arvo
  bool derivatives = false;                            // radiance by the light's vertices, its radiance and the lobe's parameters
  std::shared_ptr<const shadow::Occluders> occluders;  // none: nothing is occluded
  bool occluders_are_listed = false;                   // listed by the query itself, not by the name of a scene
  std::optional<Vec3d> geometric_normal;               // unit normal of the triangle at the position; none: the normal
};

struct QueryDefaults {
  Method method = Method::automatic;
  int spp = 256;
  std::uint64_t seed = 1;
};

// Bytes behind the text of a query that must be readable; their values do not matter.
inline constexpr std::size_t kQueryPadding = 64;

// Reads queries one after the other and reuses its memory.
class QueryReader {
 public:
  explicit QueryReader(QueryDefaults defaults = {});
  ~QueryReader();

  // line: one JSON object, with kQueryPadding readable bytes behind its end. Throws Error that names every wrong key by its path
  // (light.vertices[2]) and the expected value.
  Query read(std::string_view line);

  // The key `id` of the line last read, as its JSON text; empty if it has none.
  const std::string& id() const { return id_; }

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  QueryDefaults defaults_;
  std::string id_;
};

}  // namespace steradian::eval
