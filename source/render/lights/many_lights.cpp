#include "render/lights/many_lights.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

namespace steradian::lights {
namespace {

Vec3f at(const Planes& planes, std::uint32_t i) { return {planes.x[i], planes.y[i], planes.z[i]}; }
Vec3f get(const TileVector& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }
void put(TileVector& v, std::size_t i, Vec3f a) {
  v.x[i] = a.x;
  v.y[i] = a.y;
  v.z[i] = a.z;
}

// What work costs, in nanoseconds of one core with AVX-512: a light's element and outline at a point, a light that a half of a cell
// judges and takes into its polynomial, and a half itself. They decide what is quicker, and nothing else.
constexpr double kElement = 1, kFour = 3, kOutline = 8, kJudge = 60, kHalf = 15000;
constexpr std::size_t kFewest = 64;  // points that are not divided further

}  // namespace

// Lights by number; null: all.
struct ManyLights::Numbers {
  const std::uint32_t* numbers;
  std::size_t count;
  std::uint32_t operator[](std::size_t i) const { return numbers != nullptr ? numbers[i] : static_cast<std::uint32_t>(i); }
};

// By channel.
struct ManyLights::Bound {
  Vec3f plain{}, grazing{};
  void add(Vec3f radiance, float p, float g) {
    plain = plain + radiance * p;
    grazing = grazing + radiance * g;
  }
};

// What cells around a cell already know: the polynomial of the innermost that has one, null where none has.
struct ManyLights::Outer {
  const Cell* cell = nullptr;
  const Polynomial* polynomial = nullptr;
  Bound bound;
};

struct ManyLights::Work {
  // Of one depth of cells.
  struct Level {
    std::vector<Share> share;
    std::vector<float> plain, grazing;
    std::vector<std::uint32_t> left;
    Elements elements;
    Polynomial polynomial;
  };
  std::deque<Level> levels;
  std::vector<std::uint32_t> numbers;
  std::array<std::uint32_t, kTilePixels> slots;
  Receivers receivers;
  Counts counts;

  Level& level(std::size_t depth) {
    while (levels.size() <= depth) levels.emplace_back();
    return levels[depth];
  }
};

void ManyLights::DeleteWork::operator()(Work* work) const { delete work; }
ManyLights::WorkPointer ManyLights::make_work() { return WorkPointer(new Work()); }
const Counts& ManyLights::counts(const Work& work) { return work.counts; }

ManyLights::ManyLights(const std::vector<PackLight>& lights, Vec3f eye, float error)
    : far_(prepare_far_lights(lights)),
      eye_(eye),
      error_(error),
      packs_(cell_table_for(active_simd())),
      outlines_(irradiance_table_for(active_simd())) {}

void ManyLights::add_diffuse(SurfaceTile& tile, const std::vector<const PackLight*>& lights, TileVector& bound, Work& work) const {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kTilePixels; ++i)
    if (tile.material[i] != nullptr && tile.albedo.x[i] + tile.albedo.y[i] + tile.albedo.z[i] > 0) work.slots[count++] = i;
  if (count == 0 || lights.empty()) return;
  Numbers numbers{nullptr, far_.count};
  if (lights.size() < far_.count) {
    work.numbers.clear();
    for (const PackLight* light : lights) work.numbers.push_back(static_cast<std::uint32_t>(far_.number_of[light->index]));
    numbers = {work.numbers.data(), work.numbers.size()};
  }
  work.counts.points += count;
  add_in_order(tile, Slots(work.slots).first(count), numbers, bound, work);
}

// Points of several surfaces are told apart first.
void ManyLights::add_in_order(SurfaceTile& tile, Slots slots, Numbers numbers, TileVector& bound, Work& work) const {
  if (slots.empty()) return;
  Cell cell = cell_about(tile, slots, eye_);
  const Disorder disorder = disorder_of(tile, slots, cell);
  if (disorder != Disorder::none) {
    const auto [front, back] = disorder == Disorder::normals ? divided_by_normals(tile, slots) : divided_by_place(tile, slots, cell);
    if (!front.empty() && !back.empty()) {
      add_in_order(tile, front, numbers, bound, work);
      return add_in_order(tile, back, numbers, bound, work);
    }
  }
  cell.grid = grid_for(cell.half, distance_of_lights(cell, numbers), error_);
  add_to_cell(tile, slots, cell, numbers, {}, 0, bound, work);
}

// The harmonic mean over some of them, each by what it can send: half as near are most that count.
float ManyLights::distance_of_lights(const Cell& cell, Numbers numbers) const {
  constexpr std::size_t kSome = 128;
  const std::size_t step = std::max<std::size_t>(numbers.count / kSome, 1);
  float weights = 0, sum = 0;
  for (std::size_t i = 0; i < numbers.count; i += step) {
    const Vec3f d = at(far_.center, numbers[i]) - cell.center;
    const float r2 = std::max(dot(d, d), cell.radius * cell.radius + 1e-12f), w = far_.area[numbers[i]] / r2;
    weights += w;
    sum += w / std::sqrt(r2);
  }
  return sum > 0 ? weights / sum / 2 : cell.radius + 1e-6f;
}

// As all of the cell sees it, if it sees one side.
Element ManyLights::element_of(std::uint32_t i, const Cell& cell) const {
  const Vec3f center = at(far_.center, i), normal = at(far_.normal, i), radiance = at(far_.radiance, i);
  if (!(far_.is_flat[i] > 0)) return {center, {far_.area[i], 0, 0}, radiance};
  const bool behind = far_.two_sided[i] > 0 && dot(cell.center - center, normal) < 0;
  return {center, normal * (behind ? -far_.area[i] : far_.area[i]), radiance};
}

void ManyLights::add_element(std::uint32_t i, const Element& e, bool four, Elements& elements) const {
  if (four)
    elements.fours.push_back({e.center, at(far_.reach_a, i), at(far_.reach_b, i), e.area * 0.25f, e.radiance});
  else
    (far_.is_flat[i] > 0 ? elements.ones : elements.balls).push_back(e);
}

void ManyLights::add_to_cell(SurfaceTile& tile, Slots slots, const Cell& cell, Numbers numbers, const Outer& outer, std::size_t depth,
                             TileVector& bound, Work& work) const {
  Work::Level& level = work.level(depth);
  const std::size_t room = (numbers.count + 15) / 16 * 16;
  level.share.resize(room);
  level.plain.resize(room);
  level.grazing.resize(room);
  packs_.judge(far_, numbers.numbers, numbers.count, cell, error_, {level.share.data(), level.plain.data(), level.grazing.data()});

  Outer inner = outer;
  level.left.clear();
  level.elements.clear();
  double ones = 0, fours = 0, exact = 0;
  for (std::size_t k = 0; k < numbers.count; ++k) {
    const Share share = level.share[k];
    if (share == Share::nothing) continue;
    const std::uint32_t i = numbers[k];
    if (share != Share::one && share != Share::four) {
      level.left.push_back(i);
      ++(share == Share::exact ? exact : share == Share::four_at_points ? fours : ones);
      continue;
    }
    const Element e = element_of(i, cell);
    add_element(i, e, share == Share::four, level.elements);
    inner.bound.add(e.radiance, level.plain[k], level.grazing[k]);
  }
  if (!level.elements.empty()) {
    packs_.fit(level.elements, cell, outer.polynomial, outer.cell, level.polynomial);
    inner.cell = &cell;
    inner.polynomial = &level.polynomial;
  }

  const auto points = static_cast<double>(slots.size());
  const double here = points * (ones * kElement + fours * kFour + exact * kOutline);
  const double halves = 2 * (kHalf + static_cast<double>(level.left.size()) * kJudge);
  const Numbers left{level.left.data(), level.left.size()};
  if (slots.size() >= 2 * kFewest && here > halves && depth < 16) {
    const auto [front, back] = divided_by_place(tile, slots, cell);
    if (!front.empty() && !back.empty()) {
      for (const Slots part : {front, back}) {
        Cell half = cell_about(tile, part, cell.axes, eye_);
        half.grid = cell.grid;
        add_to_cell(tile, part, half, left, inner, depth + 1, bound, work);
      }
      return;
    }
  }
  add_to_points(tile, slots, cell, numbers, inner, depth, bound, work);
}

void ManyLights::add_to_points(SurfaceTile& tile, Slots slots, const Cell& cell, Numbers numbers, const Outer& outer, std::size_t depth,
                               TileVector& bound, Work& work) const {
  Work::Level& level = work.level(depth);
  Receivers& receivers = work.receivers;
  receivers.count = slots.size();
  receivers.filled = (slots.size() + 15) / 16 * 16;
  for (std::size_t k = 0; k < receivers.filled; ++k) {
    const std::uint32_t i = slots[std::min(k, slots.size() - 1)];
    put(receivers.position, k, get(tile.position, i));
    put(receivers.normal, k, get(tile.normal, i));
    put(receivers.view, k, get(tile.view, i));
    receivers.loss[k] = tile.fresnel_loss[i];
    put(receivers.irradiance, k, {});
  }
  if (outer.polynomial != nullptr) packs_.add_polynomial(*outer.polynomial, *outer.cell, receivers);

  Bound error = outer.bound;
  level.elements.clear();
  for (std::size_t k = 0; k < numbers.count; ++k) {
    const std::uint32_t i = numbers[k];
    if (level.share[k] == Share::exact) {
      add_outline(*far_.lights[i], cell, receivers);
      work.counts.outlines += slots.size();
    }
    const bool four = level.share[k] == Share::four_at_points;
    if (!four && level.share[k] != Share::one_at_points) continue;
    Element e = element_of(i, cell);
    add_element(i, e, four, level.elements);
    if (far_.two_sided[i] > 0) {  // each point sees one of its sides
      e.area = -e.area;
      add_element(i, e, four, level.elements);
    }
    error.add(e.radiance, level.plain[k], level.grazing[k]);
    work.counts.elements += slots.size();
  }
  if (!level.elements.empty()) packs_.add_elements(level.elements, receivers);

  for (std::size_t k = 0; k < slots.size(); ++k) {
    const std::uint32_t i = slots[k];
    const Vec3f lobe = get(tile.albedo, i) * std::numbers::inv_pi_v<float>;
    put(tile.radiance, i, get(tile.radiance, i) + lobe * get(receivers.irradiance, k));
    put(bound, i, get(bound, i) + lobe * (error.plain + error.grazing * receivers.loss[k]));
  }
}

void ManyLights::add_outline(const PackLight& light, const Cell& cell, Receivers& receivers) const {
  alignas(64) TilePlane sent;
  std::optional<packed::Polygon> cut;
  if (light.is_polygon()) cut = with_long_edges_cut(light.polygon, static_cast<Vec3d>(cell.center), static_cast<double>(cell.radius));
  if (cut) {
    PackLight copy = light;
    copy.shape = std::move(*cut);
    outlines_.irradiance(copy, receivers.points(), sent.data());
  } else {
    outlines_.irradiance(light, receivers.points(), sent.data());
  }
  for (std::size_t k = 0; k < receivers.count; ++k) put(receivers.irradiance, k, get(receivers.irradiance, k) + light.radiance * sent[k]);
}

}  // namespace steradian::lights
