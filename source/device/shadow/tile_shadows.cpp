#include "device/shadow/tile_shadows.h"

#include <algorithm>
#include <bit>

#include "shadow/edges/gather.h"

namespace steradian::vulkan {
namespace {

#include "shaders/shadow/shadow_layout.glsl"

using shadow::Viewpoint;

constexpr std::size_t kMostEdges = 20480, kMostIncidences = 1024, kMostCorners = 126;  // per group: shaders/shadow/shadow_turns.glsl
constexpr std::size_t kMostValues = std::size_t{1} << 23;                              // per tile: a quarter of a buffer
constexpr std::uint32_t kMostNumber = 1 << 27;                                         // vertex or edge: names have 28 bits
constexpr std::size_t kMostPlaces = 1 << 16;                                           // vertices and planes per group

static_assert(std::tuple_size_v<decltype(TileShadows::Search::header)> == 4 * static_cast<std::size_t>(kShadowHeader));

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
std::uint32_t bits(double x) { return bits(static_cast<float>(x)); }
std::uint32_t whole(std::size_t n) { return static_cast<std::uint32_t>(n); }
std::uint32_t flag(int f) { return static_cast<std::uint32_t>(f); }

using FourBits = std::array<std::uint32_t, 4>;
FourBits with_bits(Vec3d v, double w) { return {bits(v.x), bits(v.y), bits(v.z), bits(w)}; }

// Adds vectors of four, one after another.
class VectorRows {
 public:
  explicit VectorRows(std::vector<std::uint32_t>& values) : values_(values) {}
  std::uint32_t size() const { return whole(values_.size() / 4); }
  void add(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t w) { values_.insert(values_.end(), {x, y, z, w}); }
  void add(const FourBits& row) { values_.insert(values_.end(), row.begin(), row.end()); }
  void add(const shadow::Segment& s) {
    add(static_cast<std::uint32_t>(s.a.x), static_cast<std::uint32_t>(s.a.y), static_cast<std::uint32_t>(s.b.x),
        static_cast<std::uint32_t>(s.b.y));
  }
  void fill() {
    while (values_.size() % 4 != 0) values_.push_back(0);
  }

 private:
  std::vector<std::uint32_t>& values_;
};

std::uint32_t walks_of(float walks, int there, int against) { return walks == 0 ? 0u : flag(there) | (walks < 0 ? flag(against) : 0u); }

void add_edges(const shadow::EdgeArrays& arrays, std::vector<std::uint32_t>& values, std::array<std::uint32_t, 24>& header) {
  const shadow::LaneEdges edges = arrays.lane_edges();
  VectorRows rows(values);
  header[0] = rows.size();
  for (std::size_t i = 0; i < edges.vertex_count; ++i)
    rows.add(bits(edges.vertices.x[i]), bits(edges.vertices.y[i]), bits(edges.vertices.z[i]), arrays.vertex_number(i));
  header[1] = rows.size();
  for (std::size_t i = 0; i < edges.plane_count; ++i)
    rows.add(bits(edges.normals.x[i]), bits(edges.normals.y[i]), bits(edges.normals.z[i]), bits(edges.offsets[i]));
  header[2] = rows.size();
  header[3] = whole(edges.edge_count);
  std::size_t more = 0, incidences = 0;
  const shadow::EdgeView& e = edges.edges;
  const auto pair = [](auto a, auto b) { return static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b) << 16; };
  for (std::size_t i = 0; i < edges.edge_count; ++i) {
    std::uint32_t planes = pair(e.plane0[i], e.plane1[i]);
    std::uint32_t walks = walks_of(e.walks0[i], kWalks0, kAgainst0) | walks_of(e.walks1[i], kWalks1, kAgainst1);
    if (more < edges.more_count && edges.more[more].edge == i) {
      planes = pair(edges.more[more].first, edges.more[more].count);
      incidences = edges.more[more].first + edges.more[more].count;
      walks = flag(kManyWalks);
      ++more;
    }
    rows.add(pair(e.v0[i], e.v1[i]), planes, arrays.edge_number(i), walks);
  }
  header[4] = rows.size();
  for (std::size_t i = 0; i < incidences; ++i)
    values.push_back(edges.incidences[i].plane | (edges.incidences[i].walks < 0 ? flag(kAgainst) : 0u));
  rows.fill();
}

// Adds a point's position, its flags and its horizons.
void add_point(const LightSide& side, const Viewpoint& at, bool shares, std::vector<std::uint32_t>& values) {
  const shadow::LightFrame& frame = side.frame;
  const Vec3d local = frame.to_local(at.position), eye{local.x, local.y, -local.z};
  const bool cut = is_cut(frame, at), simple = side.middle && dot(*side.middle - at.position, at.normal) > 0 && !cut;
  shadow::SegmentSet set;
  std::uint32_t flags = (simple ? 0 : flag(kArranged)) | (cut ? flag(kCutByTriangle) : 0) | (shares ? flag(kShares) : 0);
  std::int32_t base = shadow::kHidden;
  shadow::Segment horizons[2];
  for (int h = 0; h < (at.geometric_normal ? 2 : 1); ++h) {
    set.clear();
    base += shadow::add_horizon(frame, eye, frame.axes.to_local(h == 0 ? at.normal : *at.geometric_normal),
                                h == 0 ? shadow::Source::shading_horizon : shadow::Source::geometric_horizon, set);
    if (set.segments.empty()) continue;
    horizons[h] = set.segments.front();
    flags |= flag(kHorizon << h);
    for (const shadow::LeftEvent& event : set.events)
      flags |= flag((event.weight == horizons[h].weight ? kHorizonLeft : 2 * kHorizonLeft) << (2 * h));
  }
  flags += flag(kBase) * static_cast<std::uint32_t>(base / shadow::kHidden);
  VectorRows rows(values);
  rows.add(bits(eye.x), bits(eye.y), bits(eye.z), flags);
  rows.add(with_bits(at.normal, 0));
  for (const shadow::Segment& h : horizons) rows.add(h);
}

// Vectors 3, 4 and 5 of a header.
std::array<FourBits, 3> plane_of(const shadow::LightFrame& f) {
  return {with_bits(f.axes.x, f.half_x), with_bits(f.axes.y, f.half_y), with_bits(f.axes.z, -f.eta)};
}

void add_plane(const shadow::LightFrame& f, const shadow::LightFrame& base, const Viewpoint& at, VectorRows rows) {
  for (const FourBits& row : plane_of(f)) rows.add(row);
  rows.add(with_bits(base.to_local(f.origin), f.box_x));
  rows.add(with_bits(base.to_local(at.position), f.box_y));
}

bool is_one_contour(const std::vector<shadow::Segment>& outline) {
  return std::adjacent_find(outline.begin(), outline.end(),
                            [](const shadow::Segment& e, const shadow::Segment& next) { return e.b.id != next.a.id; }) == outline.end();
}

}  // namespace

void TileShadows::clear() {
  by_light.clear();
  groups.clear();
  values.clear();
  points.clear();
  sides.clear();
}

bool TileShadows::find(const Group& asked) {
  const shadow::EdgeArrays& edges = asked.edges;
  const shadow::LaneEdges all = edges.lane_edges();
  const std::vector<shadow::CrossingTriangle>& crossing = edges.crossing();
  // A triangle takes one and a half times as many loop turns as an edge.
  const std::size_t turns = all.edge_count + crossing.size() + crossing.size() / 2;
  if (values.size() > kMostValues || turns > kMostEdges) return false;
  if (edges.is_far()) return false;
  for (const auto& triangle : crossing)
    if (triangle.number >= kMostNumber || *std::max_element(std::begin(triangle.edges), std::end(triangle.edges)) >= kMostNumber)
      return false;
  if (all.vertex_count >= kMostPlaces || all.plane_count >= kMostPlaces) return false;
  for (std::size_t i = 0; i < all.edge_count; ++i)
    if (edges.edge_number(i) >= kMostNumber) return false;
  for (std::size_t i = 0; i < all.vertex_count; ++i)
    if (edges.vertex_number(i) >= kMostNumber) return false;
  std::size_t incidences = 0;
  for (std::size_t i = 0; i < all.more_count; ++i) incidences += all.more[i].count;
  if (incidences > kMostIncidences) return false;

  // Collect the sides, and test if they share one outline.
  const std::size_t sides_before = sides.size();
  std::vector<Point> found;
  bool own_corners = false;
  for (const std::uint32_t slot : asked.slots) {
    const LightSide* side = asked.side_at(slot);
    if (side == nullptr) continue;
    if (asked.base != nullptr) side = &sides.emplace_back(*side);
    found.push_back({whole(by_light.size()), slot, side, asked.shares, asked.points[slot]});
    own_corners |= side->outline != found.front().side->outline;
  }
  if (found.empty()) return true;
  const std::vector<shadow::Segment>& outline = *found.front().side->outline;
  const std::size_t corners = outline.size();
  const bool fits = corners <= kMostCorners && (!asked.shares || is_one_contour(outline)) &&
                    std::all_of(found.begin(), found.end(), [&](const Point& p) { return p.side->outline->size() == corners; });
  if (!fits) {
    sides.resize(sides_before);
    return false;
  }

  Search group{};
  group.points = found.size();
  const bool turned = asked.base != nullptr;
  add_edges(edges, values, group.header);
  VectorRows rows(values);
  group.header[5] = rows.size();
  for (const shadow::Segment& s : outline) {
    rows.add(s);
    rows.add(static_cast<std::uint32_t>(s.a.id & ~shadow::kCornerId), static_cast<std::uint32_t>(s.b.id & ~shadow::kCornerId), 0, 0);
  }
  for (const auto& t : crossing) {
    rows.add(t.corners[0] | t.corners[1] << 16, t.corners[2] | t.plane << 16, t.number, 0);
    rows.add(t.edges[0], t.edges[1], t.edges[2], 0);
  }
  group.header[6] = rows.size();
  group.header[7] = whole(corners) + (turned ? flag(kTurned) : 0u) + (own_corners ? flag(kOwnCorners) : 0u);
  group.header[8] = whole(found.size()) + flag(kTriangles) * whole(crossing.size());
  group.header[9] = whole(points.size());
  if (!turned) {
    const shadow::LightFrame& f = found.front().side->frame;
    group.header[10] = bits(f.box_x);
    group.header[11] = bits(f.box_y);
    const std::array<FourBits, 3> plane = plane_of(f);
    for (std::size_t i = 0; i < plane.size(); ++i) std::copy(plane[i].begin(), plane[i].end(), group.header.begin() + 12 + 4 * i);
  }
  for (const Point& point : found) {
    add_point(*point.side, point.at, asked.shares, values);
    if (turned) add_plane(point.side->frame, *asked.base, point.at, rows);
    if (own_corners)
      for (const shadow::Segment& s : *point.side->outline) rows.add(s);
  }
  points.insert(points.end(), found.begin(), found.end());
  groups.push_back(group);
  return true;
}

void TileShadows::take(const PackLight& light, TileShadow& shadow) {
  const bool searched = !points.empty() && points.back().light == by_light.size();
  if (!searched && std::find(shadow.seen.begin(), shadow.seen.end(), TileShadow::Seen::whole) == shadow.seen.end()) return;
  Light& to = by_light.emplace_back(Light{&light});
  to.shares = searched && points.back().shares;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (shadow.seen[i] != TileShadow::Seen::whole) continue;
    to.states[i] = flag(kSeesWhole);
    shadow.seen[i] = TileShadow::Seen::elsewhere;
  }
}

}  // namespace steradian::vulkan
