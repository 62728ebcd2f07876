#include "device/direct/direct_light.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "device/vulkan/shaders.h"
#include "render/direct/ltc_tables.h"
#include "render/lights/light_bounds.h"
#include "steradian/error.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"

// Values of SHADOWED_LIGHTS of shaders/direct.glsl.
constexpr int kUnoccluded = 0, kByPieces = 1, kWholeLights = 2;
constexpr std::size_t kTexels = 2, kBuffers = 8;  // as bound in run
constexpr std::size_t kTilesOfBatch = 256;
constexpr std::size_t kSlotsOfSquare = static_cast<std::size_t>(kGroupsOfSquare * kGroup);
constexpr float kPushed =
    3.25f;  // a round light's corners may be this much farther from its centre than itself (ellipse_pushed_corner: 2.25)

constexpr auto bytes_of_planes(int planes) {
  return static_cast<std::size_t>(planes) * static_cast<std::size_t>(kSlots) * sizeof(Vec4Floats);
}

static_assert(static_cast<std::size_t>(kSlots) == kTilePixels && kGroup * kGroupsOfTile == kSlots);
static_assert(kRadiance == kSlots + kGroupsOfTile * kBounds);

using methods::Procedure;

// Shaders in the order in which they run: lobes need the means of textured lights; the shares use the results of all lobes.
constexpr std::size_t kTextureMeans = 0, kShares = methods::kProcedures + 1;
constexpr std::size_t shader_of(Procedure procedure) { return 1 + static_cast<std::size_t>(procedure); }

std::vector<ShaderCode> shaders() {
  std::vector<ShaderCode> all = {shader("texture_means.comp")};
#define STERADIAN_SHADER(name) all.push_back(shader(#name ".comp"));
  STERADIAN_PROCEDURES(STERADIAN_SHADER)
#undef STERADIAN_SHADER
  all.push_back(shader("shadow_shares.comp"));
  return all;
}

void put_vector(Vec4Floats* planes, int number, const TileVector& v, const TilePlane& beside) {
  Vec4Floats* to = planes + number * kSlots;
  for (std::size_t i = 0; i < kTilePixels; ++i) to[i] = {v.x[i], v.y[i], v.z[i], beside[i]};
}

// Squared distances of a point from a box.
struct Distances {
  float nearest = 0, farthest = 0;
};
Distances distances(Vec3f p, const Box3f& box) {
  Distances d;
  const auto add = [&](float at, float from, float to) {
    const float outside = std::max({from - at, at - to, 0.0f}), across = std::max(at - from, to - at);
    d.nearest += outside * outside;
    d.farthest += across * across;
  };
  add(p.x, box.low.x, box.high.x);
  add(p.y, box.low.y, box.high.y);
  add(p.z, box.low.z, box.high.z);
  return d;
}

}  // namespace

struct DirectPass::Pass {
  Procedure procedure = Procedure::diffuse;
  bool coat = false;
  const OwnLobes::Lobe* own = nullptr;
  bool with_diffuse = false;  // true: one walk serves both
  bool over_lobe() const { return procedure != Procedure::diffuse; }
  // The other lobes use the mean radiance of textured lights.
  bool asks_for_mean(const LightRecord& light) const {
    return light.textured && procedure != Procedure::sheen && procedure != Procedure::phong_lobe;
  }
  const char* name() const {
    return own != nullptr                    ? "lobes"
           : procedure == Procedure::diffuse ? "direct"
           : procedure == Procedure::sheen   ? "sheen"
           : coat                            ? "coat"
                                             : "specular";
  }
};

// How the points of a square may see a light.
struct DirectPass::Sight {
  bool small = false;     // some of them, as small
  bool near_rim = false;  // some of them, from near its rim
  bool whole = false;     // all of them, whole
};

// Lists of a batch: for each pipeline, tiles with their lights.
struct DirectPass::Work {
  struct Entry {
    std::uint32_t square, count, own;
    std::vector<std::uint32_t> lights;  // numbers; of shadowed lights each with its states, of textured ones with its means
  };
  struct Key {
    std::size_t shader;
    std::vector<std::int32_t> constants;
    auto operator<=>(const Key&) const = default;
  };
  struct Group {
    std::string name;
    std::vector<Entry> entries;
  };
  std::map<Key, Group> groups;
  std::uint32_t means = 0;  // vectors that the means take

  // Adds a light of a square: its numbers in the list.
  void add(const Key& key, const char* name, std::uint32_t own, std::uint32_t square, const std::vector<std::uint32_t>& light) {
    Group& group = groups[key];
    group.name = name;
    if (group.entries.empty() || group.entries.back().square != square || group.entries.back().own != own)
      group.entries.push_back({square, 0, own, {}});
    ++group.entries.back().count;
    std::vector<std::uint32_t>& numbers = group.entries.back().lights;
    numbers.insert(numbers.end(), light.begin(), light.end());
  }
};

DirectPass::Kept::Kept(const Device& d)
    : device(d),
      tiles((check_device(d.info(), kBuffers, "direct light"),
             std::min(kTilesOfBatch, d.info().texel_buffer / static_cast<std::size_t>(kPlanes * kSlots)))),
      program(d, shaders(), kBuffers, kTexels),
      surfaces(d, BufferUse::host_writes, BufferForm::texels),
      radiance(d, BufferUse::host_reads),
      tables(d, BufferUse::host_writes, BufferForm::texels),
      details(d, BufferUse::host_writes),
      lights(d, BufferUse::host_writes),
      vertices(d, BufferUse::host_writes),
      lists(d, BufferUse::host_writes),
      means(d, BufferUse::host_writes),
      gates(d) {
  surfaces.fit(tiles * bytes_of_planes(kPlanes));
  radiance.fit(tiles * static_cast<std::size_t>(kRadiance) * sizeof(Vec4Floats));
}

DirectPass::DirectPass(Kept& kept, const Scene& scene, const DirectMethod& method, const std::vector<PackLight>& lights)
    : kept_(kept),
      method_(method),
      specular_(methods::procedure_of(method.ggx, Brdf::ggx)),
      light_details_(lights, kept.details.most() / sizeof(Vec4Floats) - OwnLobes::most_vectors(scene)),
      own_lobes_(scene, method, light_details_.values().size()) {
  for (const PackLight& light : lights) records_.add(light, light_details_.first_of(light));
  scene_lights_ = records_.lights.size();
  scene_vertices_ = records_.vertices.size();

  const LtcPackTables tables = tables_of(method);
  std::vector<float> nodes;
  for (const PackTable* t : {&tables.matrix, &tables.magnitude, &tables.fresnel_matrix, &tables.fresnel_magnitude})
    nodes.insert(nodes.end(), t->nodes.begin(), t->nodes.end());
  if (std::any_of(lights.begin(), lights.end(), [](const PackLight& light) { return light.textured != nullptr; })) {
    const LtcPackTables compact = ltc_pack_tables(Method::ltc_compact);
    compact_first_ = static_cast<int>(nodes.size() / 4);
    compact_size_ = compact.matrix.size;
    nodes.insert(nodes.end(), compact.matrix.nodes.begin(), compact.matrix.nodes.end());
  }
  std::vector<Vec4Floats> details = light_details_.values();
  details.insert(details.end(), own_lobes_.values().begin(), own_lobes_.values().end());
  kept.details.hold(details);
  matrix_size_ = std::max(tables.matrix.size, 2);
  magnitude_size_ = std::max(tables.magnitude.size, 2);
  compact_table_ = tables.compact;
  fresnel_table_ = tables.fresnel_matrix.size > 0;
  kept.tables.hold(nodes);
}

bool DirectPass::has(const PackLight& light) const { return light_details_.has(light); }

Vec4Floats* DirectPass::planes_of(std::size_t place) {
  return static_cast<Vec4Floats*>(kept_.surfaces.get().mapped()) + place * static_cast<std::size_t>(kPlanes * kSlots);
}

void DirectPass::put(std::size_t place, const SurfaceTile& tile) {
  Vec4Floats* planes = planes_of(place);
  put_vector(planes, kPosition, tile.position, tile.alpha_x);
  put_vector(planes, kNormal, tile.normal, tile.alpha_y);
  put_vector(planes, kView, tile.view, tile.fresnel_loss);
  if (tile.any_diffuse) put_vector(planes, kAlbedo, tile.albedo, tile.coat);
  if (tile.any_specular || tile.any_coat || tile.any_override) put_vector(planes, kTangent, tile.tangent, tile.coat);
  if (tile.any_specular || tile.any_override) {
    TilePlane numbers;
    for (std::size_t i = 0; i < kTilePixels; ++i) numbers[i] = static_cast<float>(own_lobes_.number_of(tile.material[i]));
    put_vector(planes, kF0, tile.f0, numbers);
    put_vector(planes, kF90, tile.f90, tile.coat);
  }
  if (tile.any_sheen) put_vector(planes, kSheen, tile.sheen, tile.sheen_alpha);
  if (tile.any_coat) put_vector(planes, kCoatNormal, tile.coat_normal, tile.coat_alpha);
  put_radiance(place, tile);
}

void DirectPass::put_radiance(std::size_t place, const SurfaceTile& tile) {
  put_vector(static_cast<Vec4Floats*>(kept_.radiance.get().mapped()) + place * static_cast<std::size_t>(kRadiance), 0, tile.radiance,
             tile.coat);
}

void DirectPass::take_radiance(std::size_t place, TileVector& radiance) const {
  const Vec4Floats* from = static_cast<const Vec4Floats*>(kept_.radiance.get().mapped()) + place * static_cast<std::size_t>(kRadiance);
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    radiance.x[i] = from[i][0];
    radiance.y[i] = from[i][1];
    radiance.z[i] = from[i][2];
  }
}

// Like SpecularPass::brings_diffuse: one walk along a polygon serves both lobes.
bool DirectPass::brings_diffuse(const Square& square, const PackLight& light) const {
  return specular_ == Procedure::ltc && square.any_specular && square.any_diffuse && light.is_polygon() && light.is_even();
}

// Least squared distance for a lobe's integral, in the light's mean square deviations.
double DirectPass::least_distance2(const LightRecord& light, const Pass& pass) const {
  Kernels<double> k;
  const auto limits = [&] {
    switch (pass.procedure) {
      case Procedure::diffuse: return light.kind == kPolygon ? k.light_elements_along_edges() : k.light_elements_along_arcs();
      case Procedure::closed_form: return k.light_elements_along_arcs();
      case Procedure::half_vector: return k.light_elements_along_half_vectors(0.0);
      default: return k.light_elements_transformed();
    }
  };
  return pass.procedure == Procedure::phong_lobe ? pass.own->least_distance2 : limits().least_distance2.v;
}

// Returns true if some point of a box may see the light as small. Otherwise the shaders skip the test.
bool DirectPass::may_be_small(const LightRecord& light, const SurfaceBounds& where, const Pass& pass, bool shadowed) const {
  if (light.kind == kPunctual) return false;
  const double least = least_distance2(light, pass);
  // Parts may be small at points where the whole light is not: kNeverSmall.
  const auto small = static_cast<float>(shadowed ? std::min(least, 100.0) : least);
  return distances(light.middle, where.positions).farthest > light.deviation2 * small;
}

// Returns true if some point of a box may be near the rim of a light that has corners (ellipse_fan_near). Otherwise the shaders skip the
// test.
bool DirectPass::may_be_near_rim(const LightRecord& light, const SurfaceBounds& where, const Pass& pass) {
  return pass.over_lobe() && distances(light.middle, where.positions).nearest < light.near_distance2;
}

std::vector<std::int32_t> DirectPass::choices(const LightRecord& light, const Pass& pass, Sight sight, int shadowed) const {
  const bool by_arcs = pass.procedure == Procedure::closed_form || pass.procedure == Procedure::half_vector;
  const bool by_points = pass.own != nullptr && pass.own->by_points;
  const bool fine = (by_arcs || by_points) && method_.quality == Quality::high;
  const bool specular = pass.over_lobe();
  return {shadowed == kByPieces ? kPolygon : light.kind,
          pass.with_diffuse ? 1 : 0,
          specular && compact_table_ ? 1 : 0,
          specular ? static_cast<int>(method_.quality) : 1,
          pass.own != nullptr ? 2
          : pass.coat         ? 1
                              : 0,
          sight.small ? 1 : 0,
          specular && fresnel_table_ ? 1 : 0,
          light.ball && shadowed != kByPieces ? 1 : 0,
          fine ? 16 : 12,
          matrix_size_,
          magnitude_size_,
          shadowed,
          sight.whole ? 1 : 0,
          pass.asks_for_mean(light) ? 1 : 0,
          0,
          light.profiled ? 1 : 0,
          pass.own != nullptr ? pass.own->form : 0,
          pass.own != nullptr ? pass.own->phong : 0,
          pass.own != nullptr ? pass.own->low : 0,
          sight.near_rim && shadowed != kByPieces ? 1 : 0};
}

// Lists the mean of a textured light for a lobe. It is an entry of its own, since software devices limit a thread's loop
// turns.
void DirectPass::list_means(Work& work, std::uint32_t place, const Pass& pass, std::uint32_t light) const {
  std::vector<std::int32_t> constants = choices({}, {}, {}, kUnoccluded);
  constants[4] = !pass.over_lobe() ? 0 : pass.own != nullptr ? 3 : pass.coat ? 2 : 1;
  constants[9] = compact_size_;
  constants[14] = compact_first_;
  Work::Group& group = work.groups[{kTextureMeans, constants}];
  group.name = "textures";
  group.entries.push_back({place, 1, pass.own != nullptr ? pass.own->first : 0, {light, work.means}});
}

void DirectPass::find_squares(const SurfaceTile& surfaces, Tile& tile) const {
  constexpr auto kGroupSlots = static_cast<std::size_t>(kGroup);
  const auto any = [](const TileVector& v, std::size_t first) {
    const auto some = [&](const TilePlane& p) { return std::any_of(&p[first], &p[first] + kGroupSlots, [](float x) { return x > 0; }); };
    return some(v.x) || some(v.y) || some(v.z);
  };
  for (std::size_t group = 0; group < static_cast<std::size_t>(kGroupsOfTile); ++group) {
    Square& square = tile.squares[square_of_group(group)];
    const std::size_t first = group * kGroupSlots;
    add(square.bounds, surfaces, first, kGroupSlots);
    square.any_diffuse |= surfaces.any_diffuse && any(surfaces.albedo, first);
    square.any_specular |= surfaces.any_specular && (any(surfaces.f0, first) || any(surfaces.f90, first));
    square.any_sheen |= surfaces.any_sheen && any(surfaces.sheen, first);
    square.any_coat |=
        surfaces.any_coat && std::any_of(&surfaces.coat[first], &surfaces.coat[first] + kGroupSlots, [](float c) { return c > 0; });
    for (std::size_t i = first; surfaces.any_override && i < first + kGroupSlots; ++i) {
      const std::size_t number = own_lobes_.number_of(surfaces.material[i]);
      if (number > 0 && std::find(square.own.begin(), square.own.end(), number) == square.own.end()) square.own.push_back(number);
    }
  }
}

bool DirectPass::is_cut(const Tile& tile, const PackLight& light) {
  return std::any_of(tile.lights.cut.begin(), tile.lights.cut.end(), [&](const auto& cut) { return cut.get() == &light; });
}

void DirectPass::list_lights(Tile& tile) const {
  const bool leaks = specular_ == Procedure::ltc_clipless;  // lights that reach the tile, also from below the horizon
  for (Square& square : tile.squares) {
    if (square.bounds.positions.is_empty()) continue;
    for (const PackLight* light : tile.lights.lights) {
      if (!leaks && !reaches(*light, square.bounds)) continue;
      square.lights.push_back({light, is_cut(tile, *light), sees_whole(*light, square.bounds), sees_whole(*light, square.bounds, kPushed)});
    }
  }
}

std::uint32_t DirectPass::number_of(const PackLight& light, bool cut) {
  return cut ? records_.add(light, light_details_.first_of(light)) : static_cast<std::uint32_t>(light.index);
}

void DirectPass::list(Work& work, std::uint32_t place, const Tile& tile, const Square& square, const Pass& pass) {
  for (const Square::Listed& listed : square.lights) list(work, place, square, pass, listed, nullptr);
  for (const Tile::Shadowed& shadowed : tile.shadowed)
    if (reaches(*shadowed.light, square.bounds))
      list(work, place, square, pass, {shadowed.light, is_cut(tile, *shadowed.light), false, false}, &shadowed);
}

void DirectPass::list_shares(Work& work, std::uint32_t place, const Tile& tile, const Square& square) {
  for (const Tile::Shadowed& shadowed : tile.shadowed)
    if (shadowed.shares && reaches(*shadowed.light, square.bounds)) work.add({kShares, {}}, "shares", 0, place, {0, shadowed.states});
}

void DirectPass::list(Work& work, std::uint32_t place, const Square& square, const Pass& pass, const Square::Listed& listed,
                      const Tile::Shadowed* shadowed) {
  const bool together = brings_diffuse(square, *listed.light);
  if (pass.procedure == Procedure::diffuse && together) return;
  Pass own = pass;
  own.with_diffuse = together && pass.procedure == Procedure::ltc && !pass.coat && pass.own == nullptr;
  const std::uint32_t number = number_of(*listed.light, listed.cut_for_tile);
  const LightRecord& record = records_.lights[number];
  // The irradiance of tubes and balls has the same formula whether they are seen whole or not.
  const Sight sight = {.small = may_be_small(record, square.bounds, own, shadowed != nullptr),
                       .near_rim = may_be_near_rim(record, square.bounds, own),
                       .whole = own.over_lobe() ? listed.whole_about : listed.whole && !(record.kind == kCapsule || record.ball)};
  const auto key = [&](int how) { return Work::Key{shader_of(own.procedure), choices(record, own, sight, how)}; };
  std::vector<std::uint32_t> numbers = {number};
  if (shadowed != nullptr) numbers.push_back(shadowed->states);
  if (own.asks_for_mean(record)) {
    list_means(work, place, own, number);
    numbers.push_back(work.means);
    work.means += static_cast<std::uint32_t>(kSlotsOfSquare);
  }
  const auto add = [&](int how) { work.add(key(how), own.name(), own.own != nullptr ? own.own->first : 0, place, numbers); };
  if (shadowed != nullptr && shadowed->searched) add(kByPieces);
  add(shadowed != nullptr ? kWholeLights : kUnoccluded);
}

void DirectPass::run(const std::vector<Tile>& tiles, std::size_t first_tile, std::size_t end, const Visibility& visibility) {
  records_.keep(scene_lights_, scene_vertices_);
  Work work;
  for (std::size_t i = first_tile; i < end; ++i) {
    for (std::size_t s = 0; s < tiles[i].squares.size(); ++s) {
      const Square& square = tiles[i].squares[s];
      const auto place = static_cast<std::uint32_t>(i * tiles[i].squares.size() + s);
      if (square.any_diffuse) list(work, place, tiles[i], square, {});
      if (square.any_specular) list(work, place, tiles[i], square, {specular_});
      if (square.any_sheen) list(work, place, tiles[i], square, {Procedure::sheen});
      if (square.any_coat) list(work, place, tiles[i], square, {specular_, true});
      for (const std::size_t number : square.own)
        for (const OwnLobes::Lobe& lobe : own_lobes_.of(number)) list(work, place, tiles[i], square, {lobe.procedure, false, &lobe});
      if (!square.bounds.positions.is_empty()) list_shares(work, place, tiles[i], square);
    }
  }
  if (work.groups.empty() && !visibility.record) return;
  if (work.means > kGuaranteedBuffer / sizeof(Vec4Floats) && end - first_tile > 1) {  // more than the buffer's capacity
    const std::size_t middle = (first_tile + end) / 2;
    run(tiles, first_tile, middle, visibility);
    run(tiles, middle, end, visibility);
    return;
  }
  const auto fit = [](KeptBuffer& buffer, std::size_t bytes) -> Buffer& {
    return buffer.fit_with_room(bytes, "the lights' lists", "use fewer --max-lights, or --backend cpu");
  };
  fit(kept_.means, work.means * sizeof(Vec4Floats));

  std::vector<std::uint32_t> entries, numbers, gates;
  std::vector<ComputeProgram::Dispatch> dispatches;
  std::size_t count = 0;
  for (const auto& [key, group] : work.groups) count += group.entries.size();
  const std::size_t after_entries = count * static_cast<std::size_t>(kEntry);
  for (const auto& [key, group] : work.groups) {
    dispatches.push_back({.pipeline = kept_.program.pipeline(key.shader, key.constants),
                          .push = static_cast<std::uint32_t>(entries.size() / kEntry),
                          .groups_at = gates.size() * sizeof gates[0]});
    gates.insert(gates.end(), {static_cast<std::uint32_t>(kGroupsOfSquare), static_cast<std::uint32_t>(group.entries.size()), 1});
    for (const Work::Entry& entry : group.entries) dispatches.back().units += kSlotsOfSquare * entry.count;
    for (const Work::Entry& entry : group.entries) {
      entries.insert(entries.end(), {entry.square, static_cast<std::uint32_t>(after_entries + numbers.size()), entry.count, entry.own});
      numbers.insert(numbers.end(), entry.lights.begin(), entry.lights.end());
    }
  }
  entries.insert(entries.end(), numbers.begin(), numbers.end());

  const auto write = [&](KeptBuffer& buffer, const auto& values) {
    const std::size_t bytes = values.size() * sizeof values[0];
    Buffer& to = fit(buffer, bytes);
    to.write(values.data(), bytes);
    return &to;
  };
  const Buffer* lists = write(kept_.lists, entries);
  const Buffer* lights = write(kept_.lights, records_.values);
  const Buffer* vertices = write(kept_.vertices, records_.vertices);
  const Buffer *radiance = &kept_.radiance.get(), *none = lists, *counts = write(kept_.gates, gates);
  for (ComputeProgram::Dispatch& dispatch : dispatches) dispatch.groups = counts;
  const Buffer* states = visibility.states != nullptr ? visibility.states : none;
  const Buffer* parts = visibility.parts != nullptr ? visibility.parts : none;
  kept_.program.record({&kept_.surfaces.get(), &kept_.tables.get(), lights, vertices, lists, radiance, states, parts, &kept_.means.get(),
                        &kept_.details.get()},
                       dispatches);
  kept_.program.run(visibility.record ? &visibility.record(*counts) : nullptr);
  const std::vector<double>& ms = kept_.program.times();
  std::size_t i = 0;
  for (const auto& [key, group] : work.groups)
    if (i < ms.size()) times_[group.name] += ms[i++];
}

}  // namespace steradian::vulkan
