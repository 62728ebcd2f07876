#include "device/shadow/tile_shadows.h"

#include <algorithm>
#include <bit>

#include "shadow/edges/edge_arrays.h"

namespace steradian::vulkan {
namespace {

#include "shaders/shadow/shadow_layout.glsl"

using shadow::Viewpoint;

constexpr std::size_t kMostCorners = 126;                  // per group
constexpr std::size_t kMostValues = std::size_t{1} << 23;  // per tile: a quarter of a buffer

static_assert(static_cast<std::size_t>(kShaftBounds) == shadow::kShaftSides);
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

 private:
  std::vector<std::uint32_t>& values_;
};

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
  const shadow::EdgeMesh& mesh = asked.mesh;
  if (values.size() > kMostValues || asked.crossing.size() > static_cast<std::size_t>(kMostEdges)) return false;
  if (!(shadow::anchor_of(mesh.around, asked.frame) == asked.frame.origin)) return false;

  // Collect the sides, and test if they share one outline.
  const std::size_t sides_before = sides.size();
  std::vector<Point> found;
  bool own_corners = false;
  for (const std::uint32_t slot : asked.slots) {
    const LightSide* side = asked.side_at(slot);
    if (side == nullptr) continue;
    if (asked.turned) side = &sides.emplace_back(*side);
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

  Search group{{}, found.size(), asked.key, asked.frame.axes, asked.frame.origin};
  VectorRows rows(values);
  group.header[5] = rows.size();
  for (const shadow::Segment& s : outline) {
    rows.add(s);
    rows.add(static_cast<std::uint32_t>(s.a.id & ~shadow::kCornerId), static_cast<std::uint32_t>(s.b.id & ~shadow::kCornerId), 0, 0);
  }
  for (const std::uint32_t t : asked.crossing) {
    const auto &at = mesh.triangles[t], &edges = mesh.triangle_edges[t];
    rows.add(at[0], at[1], at[2], t);
    rows.add(t, edges[0], edges[1], edges[2]);
  }
  group.header[6] = rows.size();
  group.header[7] = whole(corners) + (asked.turned ? flag(kTurned) : 0u) + (own_corners ? flag(kOwnCorners) : 0u);
  group.header[8] = whole(found.size()) + flag(kTriangles) * whole(asked.crossing.size());
  group.header[9] = whole(points.size());
  if (!asked.turned) {
    const shadow::LightFrame& f = found.front().side->frame;
    group.header[10] = bits(f.box_x);
    group.header[11] = bits(f.box_y);
    const std::array<FourBits, 3> plane = plane_of(f);
    for (std::size_t i = 0; i < plane.size(); ++i) std::copy(plane[i].begin(), plane[i].end(), group.header.begin() + 12 + 4 * i);
  }
  const shadow::ShaftView shaft = asked.shaft.view_from(Frame::world(), mesh.around.middle);
  auto to = group.header.begin() + 4 * kShaft;
  const auto put = [&](const float v[3], float w) {
    to = std::copy_n(FourBits{bits(v[0]), bits(v[1]), bits(v[2]), bits(w)}.begin(), 4, to);
  };
  for (std::size_t i = 0; i < shadow::kShaftSides; ++i) put(shaft.normal[i], shaft.offset[i]);
  for (const auto& half : shaft.half) put(half, 0);
  put(shaft.middle, shaft.reach);
  for (const Point& point : found) {
    add_point(*point.side, point.at, asked.shares, values);
    if (asked.turned) add_plane(point.side->frame, asked.frame, point.at, rows);
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
  to.searched = searched;
  to.shares = searched && points.back().shares;
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    if (shadow.seen[i] != TileShadow::Seen::whole) continue;
    to.states[i] = flag(kSeesWhole);
    shadow.seen[i] = TileShadow::Seen::elsewhere;
  }
}

}  // namespace steradian::vulkan
