#include "render/many/many_lights.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

namespace steradian::lights {
namespace {

Vec3f at(const Planes& planes, std::uint32_t i) { return {planes.x[i], planes.y[i], planes.z[i]}; }

// Costs in nanoseconds of one core with AVX-512: a light's element and outline at a point; a light that a half of a cell judges and takes
// into its polynomial; a half itself. They only decide which way is faster.
constexpr double kElement = 1, kFour = 3, kOutline = 8, kJudge = 60, kHalf = 60000;
constexpr std::size_t kFewest = 64;  // sets with fewer points are not divided further

}  // namespace

// Error bounds by channel.
struct ManyLights::Bound {
  Vec3f plain{}, grazing{};
  Vec3f most{};  // the largest irradiance: rounding of sums is a fraction of it
  void add(Vec3f radiance, float p, float g, float m) {
    plain = plain + radiance * p;
    grazing = grazing + radiance * g;
    most = most + radiance * m;
  }
};

// Results of the enclosing cells: the polynomial of the innermost one that has one, or null.
struct ManyLights::Outer {
  const ReceiverCell* cell = nullptr;
  const Polynomial* polynomial = nullptr;
  int fits = 0;  // the number of those that went into it
  Bound bound;
};

struct ManyLights::Work {
  // Data of one depth of cells.
  struct Level {
    std::vector<Share> share;
    std::vector<float> plain, grazing, most;
    std::vector<std::uint32_t> left, exact;
    FarElements elements;
    Polynomial polynomial;
  };
  std::deque<Level> levels;
  std::vector<std::uint32_t> numbers;
  ReceiverSet of_tile;
  const Receiver* first = nullptr;  // first point of the set
  Received* received = nullptr;     // results of the set
  CellReceivers receivers;
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
      irradiance_(lobe_packs_for(active_simd())[methods::Procedure::diffuse]) {}

void ManyLights::add_diffuse(SurfaceTile& tile, const std::vector<const PackLight*>& lights, TileVector& bound, Work& work) const {
  ReceiverSet& set = work.of_tile;
  set.points.clear();
  set.add(tile, [](std::uint32_t slot) { return slot; });
  if (lights.size() < far_.count) {
    work.numbers.clear();
    for (const PackLight* light : lights) work.numbers.push_back(static_cast<std::uint32_t>(far_.number_of[light->index]));
    add_diffuse(set, {work.numbers.data(), work.numbers.size()}, work);
  } else {
    add_diffuse(set, work);
  }
  for (std::size_t k = 0; k < set.points.size(); ++k) {
    const std::uint32_t i = set.points[k].place;
    put(tile.radiance, i, get(tile.radiance, i) + set.received[k].radiance);
    put(bound, i, get(bound, i) + set.received[k].bound);
  }
}

void ManyLights::add_diffuse(ReceiverSet& set, Numbers numbers, Work& work) const {
  set.received.assign(set.points.size(), {});
  if (set.points.empty() || numbers.count == 0) return;
  work.first = set.points.data();
  work.received = set.received.data();
  work.counts.points += set.points.size();
  add_in_order(set.points, numbers, work);
}

// Separates points of several surfaces first.
void ManyLights::add_in_order(ReceiverSpan points, Numbers numbers, Work& work) const {
  if (points.empty()) return;
  ReceiverCell cell = cell_about(points, eye_);
  const Disorder disorder = disorder_of(points, cell);
  if (disorder != Disorder::none) {
    const auto [front, back] = disorder == Disorder::normals ? divided_by_normals(points) : divided_by_place(points, cell);
    if (!front.empty() && !back.empty()) {
      add_in_order(front, numbers, work);
      return add_in_order(back, numbers, work);
    }
  }
  cell.grid = grid_for(cell.half, distance_of_lights(cell, numbers), error_);
  add_to_cell(points, cell, numbers, {}, 0, work);
}

// Harmonic mean over some of the lights, weighted by the most they can send. The mean is halved, since most lights that count are half as
// far away.
float ManyLights::distance_of_lights(const ReceiverCell& cell, Numbers numbers) const {
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

// side: -1 for the light of the other side.
void ManyLights::add_element(std::uint32_t i, bool four, float side, FarElements& elements) const {
  if (four) {
    elements.fours.push_back(far_.fours[i]);
    if (side < 0) elements.fours.back().area = -elements.fours.back().area;
  } else if (far_.is_flat[i] > 0) {
    elements.ones.push_back(far_.elements[i]);
    if (side < 0) elements.ones.back().area = -elements.ones.back().area;
  } else {
    elements.balls.push_back(far_.elements[i]);
  }
}

void ManyLights::add_to_cell(ReceiverSpan points, const ReceiverCell& cell, Numbers numbers, const Outer& outer, std::size_t depth,
                             Work& work) const {
  Work::Level& level = work.level(depth);
  const std::size_t room = (numbers.count + 15) / 16 * 16;
  level.share.resize(room);
  level.plain.resize(room);
  level.grazing.resize(room);
  level.most.resize(room);
  packs_.judge(far_, numbers.numbers, numbers.count, cell, error_,
               {level.share.data(), level.plain.data(), level.grazing.data(), level.most.data()});

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
    const bool behind = far_.two_sided[i] > 0 && dot(cell.center - far_.elements[i].center, at(far_.normal, i)) < 0;
    add_element(i, share == Share::four, behind ? -1.0f : 1.0f, level.elements);
    inner.bound.add(far_.elements[i].radiance, level.plain[k], level.grazing[k], level.most[k]);
  }
  if (!level.elements.empty()) {
    packs_.fit(level.elements, cell, outer.polynomial, outer.cell, level.polynomial);
    inner.cell = &cell;
    inner.polynomial = &level.polynomial;
    ++inner.fits;
  }

  const auto count = static_cast<double>(points.size());
  const double here = count * (ones * kElement + fours * kFour + exact * kOutline);
  const double halves = 2 * (kHalf + static_cast<double>(level.left.size()) * kJudge);
  const Numbers left{level.left.data(), level.left.size()};
  if (points.size() >= 2 * kFewest && here > halves && depth < 16) {
    const auto [front, back] = divided_by_place(points, cell);
    if (!front.empty() && !back.empty()) {
      for (const ReceiverSpan part : {front, back}) {
        ReceiverCell half = cell_about(part, cell.axes, eye_);
        half.grid = cell.grid;
        add_to_cell(part, half, left, inner, depth + 1, work);
      }
      return;
    }
  }
  add_to_points(points, cell, numbers, inner, depth, work);
}

void ManyLights::add_to_points(ReceiverSpan points, const ReceiverCell& cell, Numbers numbers, const Outer& outer, std::size_t depth,
                               Work& work) const {
  Work::Level& level = work.level(depth);
  Outer inner = outer;
  level.exact.clear();
  level.elements.clear();
  for (std::size_t k = 0; k < numbers.count; ++k) {
    const std::uint32_t i = numbers[k];
    if (level.share[k] == Share::exact) level.exact.push_back(i);
    const bool four = level.share[k] == Share::four_at_points;
    if (!four && level.share[k] != Share::one_at_points) continue;
    add_element(i, four, 1, level.elements);
    if (far_.two_sided[i] > 0) add_element(i, four, -1, level.elements);  // each point sees one of its sides
    inner.bound.add(far_.elements[i].radiance, level.plain[k], level.grazing[k], level.most[k]);
    work.counts.elements += points.size();
  }
  work.counts.outlines += points.size() * level.exact.size();
  for (std::size_t first = 0; first < points.size(); first += kTilePixels)
    add_to_some(points.subspan(first, std::min(kTilePixels, points.size() - first)), cell, {level.exact.data(), level.exact.size()},
                level.elements, inner, work);
}

// Adds light to at most as many points as a tile has.
void ManyLights::add_to_some(ReceiverSpan points, const ReceiverCell& cell, Numbers exact, const FarElements& elements, const Outer& outer,
                             Work& work) const {
  CellReceivers& receivers = work.receivers;
  receivers.count = points.size();
  receivers.filled = (points.size() + 15) / 16 * 16;
  for (std::size_t k = 0; k < receivers.filled; ++k) {
    const Receiver& q = points[std::min(k, points.size() - 1)];
    put(receivers.position, k, q.position);
    put(receivers.normal, k, q.normal);
    receivers.loss[k] = q.loss;
    put(receivers.irradiance, k, {});
    put(receivers.rounding, k, {});
  }
  if (cell.loss > 0)
    for (std::size_t k = 0; k < receivers.filled; ++k) put(receivers.view, k, normalized(eye_ - get(receivers.position, k)));
  if (outer.polynomial != nullptr) packs_.add_polynomial(*outer.polynomial, *outer.cell, receivers);
  for (std::size_t k = 0; k < exact.count; ++k) add_outline(exact[k], cell, receivers);
  if (!elements.empty()) packs_.add_elements(elements, receivers);
  // Sums over lights, and a sum over the nodes for each fit and for the receiver.
  const auto of_sums = static_cast<float>(kPart + far_.count / kPart);
  const float of_most = kUnit * (of_sums + static_cast<float>(2 * kMostNodes * lebesgue(cell.grid)) * static_cast<float>(outer.fits));
  Received* received = work.received + (points.data() - work.first);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3f lobe = points[k].albedo * std::numbers::inv_pi_v<float>;
    const Vec3f irradiance = get(receivers.irradiance, k);
    const Vec3f rounding =
        get(receivers.rounding, k) + outer.bound.most * of_most + irradiance * (kUnit * (of_sums + static_cast<float>(exact.count + 8)));
    received[k] = {lobe * irradiance, lobe * (outer.bound.plain + outer.bound.grazing * receivers.loss[k] + rounding)};
  }
}

void ManyLights::add_outline(std::uint32_t number, const ReceiverCell& cell, CellReceivers& receivers) const {
  const PackLight& light = *far_.lights[number];
  alignas(64) TilePlane sent;
  std::optional<packed::FloatPolygon> cut;
  if (light.is_polygon()) cut = with_long_edges_cut(light.polygon, static_cast<Vec3d>(cell.center), static_cast<double>(cell.radius));
  if (cut) {
    PackLight copy = light;
    copy.shape = std::move(*cut);
    irradiance_(copy, receivers.points(), {}, {sent.data()});
  } else {
    irradiance_(light, receivers.points(), {}, {sent.data()});
  }
  packs_.add_outline(far_, number, sent.data(), receivers);
}

}  // namespace steradian::lights
