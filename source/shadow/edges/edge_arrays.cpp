#include "shadow/edges/edge_arrays.h"

#include <algorithm>
#include <cmath>

#include "shadow/edges/gather.h"
#include "steradian/kernels.h"

namespace steradian::shadow {
namespace {

// Numbers items in the order in which they are first requested. Each thread has its own memory.
class Renumbering {
 public:
  void begin(std::size_t size) {
    if (known_.size() < size) known_.resize(size);
    if (++now_ == 0) {
      std::fill(known_.begin(), known_.end(), Known{});
      now_ = 1;
    }
  }
  // add() is called for a new item and returns its place.
  template <class Add>
  std::uint32_t of(std::uint32_t number, Add add) {
    Known& known = known_[number];
    if (known.since != now_) known = {now_, add()};
    return known.place;
  }

 private:
  struct Known {
    std::uint32_t since = 0, place = 0;
  };
  std::vector<Known> known_;
  std::uint32_t now_ = 0;
};
thread_local Renumbering vertices_seen, planes_seen;

Vec3f to_float(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

using K = Kernels<float>;

// An end of an edge as seen from the point.
struct SnappedEnd {
  K::vec3 homogeneous;
  std::int32_t x, y;  // in cells; valid if not outside
  int outside;
};

// The part of an edge inside the box.
struct Clipped {
  std::int32_t ax, ay, bx, by;
  int side_a, side_b;  // 0 not clipped, 1 left, 2 right, 3 bottom, 4 top
};

// Relies on `outside` for the ends, so that all edges of a vertex agree.
bool clip(const SnappedEnd& a, const SnappedEnd& b, K::vec2 box, Clipped& result) {
  if ((a.outside & b.outside & kBoxOut) != 0) return false;
  K k;
  result = {a.x, a.y, b.x, b.y, 0, 0};
  if (((a.outside | b.outside) & kBoxOut) == 0) return true;
  K::ShadowSpan span;
  span.t0 = 0.0;
  span.t1 = 1.0;
  span.sides = {0.0, 0.0};
  span.inside = Mask<float>(true);
  const auto distances = [&](const K::vec3& h, int bit) {
    const K::real d = bit == kLeftOut     ? box.x * h.z + h.x
                      : bit == kRightOut  ? box.x * h.z - h.x
                      : bit == kBottomOut ? box.y * h.z + h.y
                                          : box.y * h.z - h.y;
    return d;
  };
  constexpr int kBits[4] = {kLeftOut, kRightOut, kBottomOut, kTopOut};
  for (int side = 0; side < 4; ++side) {
    const auto distance = [&](const SnappedEnd& e) {
      const K::real d = distances(e.homogeneous, kBits[side]);
      return (e.outside & kBits[side]) != 0 ? min(d, K::real(0.0)) : max(d, K::real(1e-30));
    };
    span = k.shadow_clip_side(span, distance(a), distance(b), side + 1.0);
  }
  // An end inside is not lost if the other lies a rounding beyond its side; otherwise its chain would break.
  if (!(span.t0 < span.t1).m && span.sides.x.v > 0.5f && span.sides.y.v > 0.5f) return false;
  const K::vec3 d = b.homogeneous - a.homogeneous;
  const auto cell = [](K::real v) { return static_cast<std::int32_t>(v.v); };
  if (span.sides.x.v > 0.5f) {
    const K::vec2 c = k.shadow_cell(a.homogeneous + d * span.t0, box, span.sides.x);
    result.ax = cell(c.x), result.ay = cell(c.y), result.side_a = cell(span.sides.x);
  }
  if (span.sides.y.v > 0.5f) {
    const K::vec2 c = k.shadow_cell(a.homogeneous + d * span.t1, box, span.sides.y);
    result.bx = cell(c.x), result.by = cell(c.y), result.side_b = cell(span.sides.y);
  }
  return true;
}

// A vertex that no array holds: the cut of an edge by the light's plane.
SnappedEnd end_at(const K::vec3& h, K::vec2 box) {
  const K::vec2 c = K().shadow_cell(h, box, 0.0);
  const auto out = [](K::real d, int bit) { return d.v <= 0 ? bit : 0; };
  return {h, static_cast<std::int32_t>(c.x.v), static_cast<std::int32_t>(c.y.v),
          out(box.x * h.z + h.x, kLeftOut) | out(box.x * h.z - h.x, kRightOut) | out(box.y * h.z + h.y, kBottomOut) |
              out(box.y * h.z - h.y, kTopOut)};
}

}  // namespace

void EdgeArrays::Vectors::resize(std::size_t n) {
  x.resize(n);
  y.resize(n);
  z.resize(n);
}
void EdgeArrays::Vectors::push_back(const Vec3f& v) {
  x.push_back(v.x);
  y.push_back(v.y);
  z.push_back(v.z);
}

Vec3d anchor_of(const Around& triangles, const LightFrame& frame) {
  // Farther away than this many radii, roundings of the light's coordinates come near a point's distance from its triangle.
  constexpr double kFar = 4;
  return length(frame.origin - triangles.middle) > kFar * triangles.radius ? triangles.middle : frame.origin;
}

void EdgeArrays::clear() {
  for (Vectors* v : {&vertices_, &normals_}) v->resize(0);
  for (auto* v : {&vertex_, &plane_, &edge_}) v->clear();
  for (auto* v : {&v0_, &v1_, &plane0_, &plane1_}) v->clear();
  for (auto* v : {&offsets_, &walks0_, &walks1_}) v->clear();
  has_more_.clear();
  more_.clear();
  incidences_.clear();
  crossing_.clear();
}

void EdgeArrays::pad() {
  vertex_count_ = of_light_ = vertex_.size();
  plane_count_ = plane_.size();
  vertices_.resize(padded(vertex_count_));
  normals_.resize(padded(plane_count_));
  offsets_.resize(padded(plane_count_));
  const std::size_t edges = padded(edge_.size());
  for (auto* v : {&v0_, &v1_, &plane0_, &plane1_}) v->resize(edges, 0);
  for (auto* v : {&walks0_, &walks1_}) v->resize(edges, 0.0f);
  has_more_.resize(edges, 0);
  turned_.resize(vertices_.size());
  homogeneous_.resize(vertices_.size());
  for (auto* v : {&cell_x_, &cell_y_, &outside_}) v->resize(vertices_.size());
  facing_.resize(padded(plane_count_) + kPadding);  // never empty: edges without a triangle read the first entry
  found_.resize(edges + more_.size());
  weights_.resize(edges + more_.size());
}

EdgeView EdgeArrays::view() const {
  return {walks0_.size(), v0_.data(), v1_.data(), plane0_.data(), plane1_.data(), walks0_.data(), walks1_.data()};
}

LaneEdges EdgeArrays::lane_edges() const {
  return {view(),       edge_.size(), plane_count_,       vertex_count_,    vertices_.view(), normals_.view(), offsets_.data(),
          more_.data(), more_.size(), incidences_.data(), crossing_.data(), crossing_.size(), vertex_.data(),  of_light_};
}

// Adds a crossing triangle and finds its twin: the first among the crossing ones with the same corners.
void EdgeArrays::add_crossing(const EdgeMesh& mesh, CrossingTriangle triangle) {
  triangle.twin = -1;
  const auto twin = std::lower_bound(mesh.coincident.begin(), mesh.coincident.end(), triangle.number,
                                     [](const CoincidentTriangle& c, std::uint32_t number) { return c.number < number; });
  if (twin != mesh.coincident.end() && twin->number == triangle.number) {
    const auto first = std::lower_bound(crossing_.begin(), crossing_.end(), twin->first,
                                        [](const CrossingTriangle& c, std::uint32_t number) { return c.number < number; });
    if (first != crossing_.end() && first->number == twin->first) {
      triangle.twin = static_cast<std::int32_t>(first - crossing_.begin());
      triangle.same_direction = twin->same_direction;
    }
  }
  crossing_.push_back(triangle);
}

void EdgeArrays::assign(const EdgeMesh& mesh, const LightFrame& frame, const std::vector<std::uint32_t>& edges,
                        const std::vector<std::uint32_t>& crossing, std::span<const std::uint32_t> inside) {
  clear();
  around_ = mesh.around;
  anchor_ = anchor_of(frame);
  vertices_seen.begin(mesh.vertices.size());
  planes_seen.begin(mesh.triangles.size());
  const auto vertex = [&](std::uint32_t v) {
    return vertices_seen.of(v, [&] {
      vertices_.push_back(to_float(frame.axes.to_local(mesh.vertices[v] - anchor_)));
      vertex_.push_back(v);
      return static_cast<std::uint32_t>(vertex_.size() - 1);
    });
  };
  const auto plane = [&](std::uint32_t t) {
    return planes_seen.of(t, [&] {
      const Plane& p = mesh.planes[t];
      normals_.push_back(to_float(frame.axes.to_local(p.normal)));
      // A plane far from the anchor keeps its digits only if the offset is taken there.
      offsets_.push_back(static_cast<float>(p.offset - dot(p.normal, anchor_)));
      plane_.push_back(t);
      return static_cast<std::uint32_t>(plane_.size() - 1);
    });
  };
  for (const std::uint32_t number : edges) {
    const MeshEdge& e = mesh.edges[number];
    const EdgeTriangle* t = &mesh.edge_triangles[e.first];
    std::uint32_t triangles = e.count;
    if (e.at_body) {
      blocking_.clear();
      add_incidences(mesh, e, inside, blocking_);
      if (blocking_.empty()) continue;
      t = blocking_.data();
      triangles = static_cast<std::uint32_t>(blocking_.size());
    }
    v0_.push_back(static_cast<std::int32_t>(vertex(e.v0)));
    v1_.push_back(static_cast<std::int32_t>(vertex(e.v1)));
    const bool many = triangles > 2;
    plane0_.push_back(many ? 0 : static_cast<std::int32_t>(plane(t[0].triangle)));
    walks0_.push_back(many ? 0.0f : static_cast<float>(t[0].walks));
    plane1_.push_back(many || triangles < 2 ? 0 : static_cast<std::int32_t>(plane(t[1].triangle)));
    walks1_.push_back(many || triangles < 2 ? 0.0f : static_cast<float>(t[1].walks));
    has_more_.push_back(many ? 1 : 0);
    if (many) {
      more_.push_back({static_cast<std::uint32_t>(edge_.size()), static_cast<std::uint32_t>(incidences_.size()), triangles});
      for (std::uint32_t i = 0; i < triangles; ++i) incidences_.push_back({plane(t[i].triangle), t[i].walks});
    }
    edge_.push_back(number);
  }
  for (const std::uint32_t number : crossing) {
    CrossingTriangle t{number, plane(number), {}, {}, -1, true};
    for (std::size_t c = 0; c < 3; ++c) {
      t.corners[c] = vertex(mesh.triangles[number][c]);
      t.edges[c] = mesh.triangle_edges[number][c];
    }
    add_crossing(mesh, t);
  }
  pad();
}

void EdgeArrays::assign_needed(const ShadowTable& packs, const EdgeMesh& mesh, const EdgeArrays& tile, const LightFrame& frame,
                               const Shaft& shaft) {
  clear();
  around_ = tile.around_;
  anchor_ = tile.anchor_;
  found_.resize(tile.walks0_.size());
  const std::size_t kept = packs.filter(tile.view(), tile.vertices_.view(), tile.normals_.view(), tile.offsets_.data(),
                                        shaft.view_from(frame.axes, anchor_), tile.has_more_.data(), found_.data());
  vertices_seen.begin(tile.vertex_.size());
  planes_seen.begin(tile.plane_.size());
  const auto vertex = [&](std::uint32_t v) {
    return vertices_seen.of(v, [&] {
      vertices_.push_back(tile.vertices_.at(v));
      vertex_.push_back(tile.vertex_[v]);
      return static_cast<std::uint32_t>(vertex_.size() - 1);
    });
  };
  const auto plane = [&](std::uint32_t t) {
    return planes_seen.of(t, [&] {
      normals_.push_back(tile.normals_.at(t));
      offsets_.push_back(tile.offsets_[t]);
      plane_.push_back(tile.plane_[t]);
      return static_cast<std::uint32_t>(plane_.size() - 1);
    });
  };
  std::size_t more = 0;
  for (std::size_t i = 0; i < kept; ++i) {
    const std::uint32_t e = found_[i];
    v0_.push_back(static_cast<std::int32_t>(vertex(static_cast<std::uint32_t>(tile.v0_[e]))));
    v1_.push_back(static_cast<std::int32_t>(vertex(static_cast<std::uint32_t>(tile.v1_[e]))));
    walks0_.push_back(tile.walks0_[e]);
    walks1_.push_back(tile.walks1_[e]);
    const auto plane_at = [&](float walks, std::int32_t p) {
      return walks == 0 ? 0 : static_cast<std::int32_t>(plane(static_cast<std::uint32_t>(p)));
    };
    plane0_.push_back(plane_at(tile.walks0_[e], tile.plane0_[e]));
    plane1_.push_back(plane_at(tile.walks1_[e], tile.plane1_[e]));
    has_more_.push_back(tile.has_more_[e]);
    if (tile.has_more_[e] != 0) {
      while (tile.more_[more].edge != e) ++more;
      const LaneEdges::More& m = tile.more_[more];
      more_.push_back({static_cast<std::uint32_t>(edge_.size()), static_cast<std::uint32_t>(incidences_.size()), m.count});
      for (std::uint32_t k = m.first; k < m.first + m.count; ++k)
        incidences_.push_back({plane(tile.incidences_[k].plane), tile.incidences_[k].walks});
    }
    edge_.push_back(tile.edge_[e]);
  }
  for (const CrossingTriangle& t : tile.crossing_) {
    if (!shaft.needs_triangle(mesh, t.number)) continue;
    CrossingTriangle own = t;
    own.plane = plane(t.plane);
    for (std::uint32_t& c : own.corners) c = vertex(c);
    add_crossing(mesh, own);
  }
  pad();
}

void EdgeArrays::add_light(const EdgeMesh& mesh, const LightFrame& frame, const SolidLight& light,
                           const std::vector<std::uint32_t>& edges) {
  const std::size_t first = vertex_count_;
  // Removes the padding.
  for (Vectors* v : {&vertices_, &normals_}) v->resize(v == &vertices_ ? vertex_count_ : plane_count_);
  offsets_.resize(plane_count_);
  for (auto* v : {&v0_, &v1_, &plane0_, &plane1_}) v->resize(edge_.size());
  for (auto* v : {&walks0_, &walks1_}) v->resize(edge_.size());
  has_more_.resize(edge_.size());

  const auto first_number = static_cast<std::uint32_t>(mesh.vertices.size());
  vertices_seen.begin(mesh.vertices.size() + light.vertices.size());
  planes_seen.begin(light.faces.size());
  const auto vertex = [&](std::uint32_t v) {
    return static_cast<std::int32_t>(vertices_seen.of(first_number + v, [&] {
      vertices_.push_back(to_float(frame.axes.to_local(light.vertices[v] - anchor_)));
      vertex_.push_back(first_number + v);
      return static_cast<std::uint32_t>(vertex_.size() - 1);
    }));
  };
  const auto plane = [&](std::uint32_t f) {
    return static_cast<std::int32_t>(planes_seen.of(f, [&] {
      const Plane& p = light.faces[f];
      normals_.push_back(to_float(frame.axes.to_local(p.normal)));
      offsets_.push_back(static_cast<float>(p.offset - dot(p.normal, anchor_)));
      plane_.push_back(static_cast<std::uint32_t>(mesh.triangles.size()) + f);
      return static_cast<std::uint32_t>(plane_.size() - 1);
    }));
  };
  // A contour has two triangles, which would count as two occluders; the light's inside has the lower count.
  constexpr float kWalks = -kLayer / 2;
  for (const std::uint32_t number : edges) {
    const SolidEdge& e = light.edges[number];
    v0_.push_back(vertex(e.v0));
    v1_.push_back(vertex(e.v1));
    plane0_.push_back(plane(e.face0));
    plane1_.push_back(plane(e.face1));
    walks0_.push_back(kWalks);
    walks1_.push_back(-kWalks);
    has_more_.push_back(0);
    edge_.push_back(static_cast<std::uint32_t>(mesh.edges.size()) + number);
  }
  pad();
  of_light_ = first;
}

void EdgeArrays::see(const ShadowTable& packs, const LightFrame& frame, const Viewpoint& from, const std::vector<Segment>& outline,
                     SegmentSet& result) {
  collect(packs, frame, vertices_, frame.axes.to_local(from.position - anchor_), from, outline, result);
}

void EdgeArrays::see_turned(const ShadowTable& packs, const LightFrame& base, const LightFrame& frame, const Viewpoint& from,
                            const std::vector<Segment>& outline, SegmentSet& result) {
  const Vec3f x = to_float(base.axes.to_local(frame.axes.x)), y = to_float(base.axes.to_local(frame.axes.y)),
              z = to_float(base.axes.to_local(frame.axes.z)), o = to_float(base.axes.to_local(anchor_of(frame) - anchor_));
  const float axes[9] = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}, origin[3] = {o.x, o.y, o.z};
  packs.turn(vertices_.view(), vertices_.size(), axes, origin, turned_.span());
  collect(packs, frame, turned_, base.axes.to_local(from.position - anchor_), from, outline, result);
}

void EdgeArrays::collect(const ShadowTable& packs, const LightFrame& frame, const Vectors& vertices, const Vec3d& in_planes,
                         const Viewpoint& from, const std::vector<Segment>& outline, SegmentSet& result) {
  result.clear();
  const Eye point = eye_of(frame, anchor_of(frame), from.position);
  const Vec3f eye = to_float(point.eye), shift = to_float(point.shift), seen_by_planes = to_float(in_planes);
  const K::vec2 box(static_cast<float>(frame.box_x), static_cast<float>(frame.box_y));
  const auto height = static_cast<float>(point.height);
  const float at[3] = {seen_by_planes.x, seen_by_planes.y, seen_by_planes.z};
  packs.facing(normals_.view(), offsets_.data(), normals_.size(), at, facing_.data());
  packs.project(vertices.view(), vertices.size(), {{eye.x, eye.y, eye.z}, {shift.x, shift.y, shift.z}, {box.x.v, box.y.v}, height},
                {homogeneous_.span(), cell_x_.data(), cell_y_.data(), outside_.data()});
  for (std::size_t v = of_light_; v < vertex_count_; ++v) outside_[v] = static_cast<float>(static_cast<int>(outside_[v]) & kBoxOut);
  std::size_t count = packs.contours(view(), facing_.data(), outside_.data(), found_.data(), weights_.data());

  if (!more_.empty()) {
    // Insert edges of more than two triangles at their places among the others.
    for (const LaneEdges::More& m : more_) {
      std::int32_t weight = 0;
      for (std::uint32_t i = m.first; i < m.first + m.count; ++i)
        weight -= incidences_[i].walks * (facing_[incidences_[i].plane] > 0 ? 1 : -1);
      const int o0 = static_cast<int>(outside_[static_cast<std::size_t>(v0_[m.edge])]),
                o1 = static_cast<int>(outside_[static_cast<std::size_t>(v1_[m.edge])]);
      if (weight == 0 || (o0 & o1 & kAbove) != 0) continue;
      std::size_t i = count++;
      for (; i > 0 && found_[i - 1] > m.edge; --i) {
        found_[i] = found_[i - 1];
        weights_[i] = weights_[i - 1];
      }
      found_[i] = m.edge;
      weights_[i] = weight;
    }
  }

  const K::vec3 eye_kernel(eye.x, eye.y, eye.z), shift_kernel(shift.x, shift.y, shift.z);
  const auto position = [&](std::size_t v) { return K::vec3(vertices.x[v], vertices.y[v], vertices.z[v]); };
  const auto end_of = [&](std::size_t v) -> SnappedEnd {
    return {{homogeneous_.x[v], homogeneous_.y[v], homogeneous_.z[v]},
            static_cast<std::int32_t>(cell_x_[v]),
            static_cast<std::int32_t>(cell_y_[v]),
            static_cast<int>(outside_[v])};
  };
  const auto cut_between = [&](std::size_t v0, std::size_t v1) {
    return end_at(K().shadow_project(eye_kernel, shift_kernel, K().shadow_cut(position(v0), position(v1), height)), box);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t e = found_[i];
    const auto v0 = static_cast<std::size_t>(v0_[e]), v1 = static_cast<std::size_t>(v1_[e]);
    SnappedEnd a = end_of(v0), b = end_of(v1);
    const bool above0 = (a.outside & kAbove) != 0, above1 = (b.outside & kAbove) != 0;
    if (above0) a = cut_between(v0, v1);
    if (above1) b = cut_between(v0, v1);
    Clipped c;
    if (!clip(a, b, box, c)) continue;
    const auto cell = [&](int end, int side, bool cut, std::size_t v, std::int32_t x, std::int32_t y) {
      if (side != 0) return cell_of(clip_id(Source::edge, edge_[e], end), x, y);
      return cut ? cell_of(kCutId | edge_[e], x, y) : vertex_cell(v, x, y);
    };
    add_cells(result, cell(0, c.side_a, above0, v0, c.ax, c.ay), cell(1, c.side_b, above1, v1, c.bx, c.by), c.side_a == 1, c.side_b == 1,
              weights_[i], Source::edge, edge_[e]);
    Segment& added = result.segments.back();
    if (c.side_a == 0 && !above0) added.place_a = static_cast<std::int32_t>(v0);
    if (c.side_b == 0 && !above1) added.place_b = static_cast<std::int32_t>(v1);
  }

  const std::size_t sections = result.segments.size();
  for (const CrossingTriangle& t : crossing_) {
    // The section runs from where the triangle's outline leaves the space below the plane to where it comes back.
    int leaving = -1, returning = -1;
    const auto below = [&](std::uint32_t v) { return (static_cast<int>(outside_[v]) & kAbove) == 0; };
    for (int c = 0; c < 3; ++c) {
      const bool here = below(t.corners[c]), there = below(t.corners[(c + 1) % 3]);
      if (here && !there) leaving = c;
      if (!here && there) returning = c;
    }
    if (leaving < 0 || returning < 0) continue;
    const auto cut = [&](int side) {
      const std::uint32_t from_v = t.corners[side], to_v = t.corners[(side + 1) % 3];
      return vertex_[from_v] < vertex_[to_v] ? cut_between(from_v, to_v) : cut_between(to_v, from_v);
    };
    Clipped c;
    if (!clip(cut(leaving), cut(returning), box, c)) continue;
    const auto cell = [&](int end, int side, std::uint32_t edge, std::int32_t x, std::int32_t y) {
      return cell_of(side != 0 ? clip_id(Source::section, t.number, end) : kCutId | edge, x, y);
    };
    add_section(result, sections, [&] {
      add_cells(result, cell(0, c.side_a, t.edges[leaving], c.ax, c.ay), cell(1, c.side_b, t.edges[returning], c.bx, c.by), c.side_a == 1,
                c.side_b == 1, facing_[t.plane] > 0 ? -1 : 1, Source::section, t.number);
    });
  }
  result.occluders = result.segments.size();
  if (result.occluders == 0) return;
  add_surroundings(frame, from, outline, result);
  // The outline's corners follow the vertices.
  for (std::size_t i = result.occluders; i < result.occluders + outline.size(); ++i)
    for (std::int32_t* place : {&result.segments[i].place_a, &result.segments[i].place_b})
      *place += static_cast<std::int32_t>(vertex_count_);
}

void add_surroundings(const LightFrame& frame, const Viewpoint& from, const std::vector<Segment>& outline, SegmentSet& result) {
  result.segments.insert(result.segments.end(), outline.begin(), outline.end());
  add_horizons(frame, from, frame.to_local(from.position), result);
}

std::vector<Segment> outline_segments(const LightFrame& frame) {
  SegmentSet set;
  add_outline(frame, set);
  return set.segments;
}

}  // namespace steradian::shadow
