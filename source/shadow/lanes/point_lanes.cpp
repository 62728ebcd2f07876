#include "shadow/lanes/point_lanes.h"

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>

#include "shadow/edges/gather.h"
#include "shadow/region/arrangement.h"

namespace steradian::shadow {
namespace {

void put(LaneReals to[3], std::size_t lane, Vec3d v) {
  to[0].at[lane] = static_cast<float>(v.x);
  to[1].at[lane] = static_cast<float>(v.y);
  to[2].at[lane] = static_cast<float>(v.z);
}

// Writes a segment that only some lanes see, or that all lanes see in the same cells.
void put_cells(SegmentLanes& to, std::size_t lane, const Segment& s) {
  to.ax.at[lane] = static_cast<float>(s.a.x);
  to.ay.at[lane] = static_cast<float>(s.a.y);
  to.bx.at[lane] = static_cast<float>(s.b.x);
  to.by.at[lane] = static_cast<float>(s.b.y);
  to.weight.at[lane] = s.weight;
}

void clear_bits(SegmentLanes& s) {
  s.present = s.clipped_a = s.clipped_b = s.cut_a = s.cut_b = s.left_a = s.left_b = 0;
  s.place_a = s.place_b = -1;
  s.row = 0;
}

std::int32_t whole(float x) { return static_cast<std::int32_t>(x); }

}  // namespace

void PointLanes::take_points(const EdgeArrays& edges, const LightFrame& base, bool turned) {
  view_.turned = turned;
  view_.valid = static_cast<LaneBits>((1u << point_count_) - 1);
  for (std::size_t lane = 0; lane < kPoints; ++lane) {
    const Point& point = points_[std::min(lane, point_count_ - 1)];
    const LightFrame& frame = *point.frame;
    const Vec3d anchor = edges.anchor_of(frame);
    const Eye eye = eye_of(frame, anchor, point.at->position);
    put(view_.eye, lane, eye.eye);
    put(view_.shift, lane, eye.shift);
    put(view_.at, lane, base.axes.to_local(point.at->position - edges.anchor()));
    put(view_.origin, lane, base.axes.to_local(anchor - edges.anchor()));
    put(view_.axes, lane, frame.axes.x);
    put(view_.axes + 3, lane, frame.axes.y);
    put(view_.axes + 6, lane, frame.axes.z);
    put(view_.normal, lane, point.at->normal);
    view_.box_x.at[lane] = static_cast<float>(frame.box_x);
    view_.box_y.at[lane] = static_cast<float>(frame.box_y);
    view_.height.at[lane] = static_cast<float>(eye.height);
    view_.base.at[lane] = 0;
  }
}

// Adds the outline, and the horizons of the points whose light they cut.
void PointLanes::add_surroundings(LaneBits lanes) {
  for (std::size_t k = 0; k < outline_size_; ++k) {
    const Segment& of = (*points_[0].outline)[k];
    SegmentLanes& s = segments_[work_.count++];
    clear_bits(s);
    for (std::size_t lane = 0; lane < kPoints; ++lane) put_cells(s, lane, (*points_[std::min(lane, point_count_ - 1)].outline)[k]);
    s.present = lanes;
    s.row = static_cast<std::uint32_t>(k);
    s.place_a = static_cast<std::int32_t>(seen_.vertices) + of.place_a;
    s.place_b = static_cast<std::int32_t>(seen_.vertices) + of.place_b;
  }
  horizon_rows_.fill(0);
  for (std::size_t h = 0; h < 2; ++h) {
    SegmentLanes* s = nullptr;
    for (std::size_t lane = 0; lane < point_count_; ++lane) {
      if ((lanes >> lane & 1) == 0) continue;
      const Viewpoint& at = *points_[lane].at;
      const LightFrame& frame = *points_[lane].frame;
      if (h == 0) view_.base.at[lane] = frame.layered ? kLayer : kHidden;
      if (h == 1 && !at.geometric_normal) continue;
      horizon_.clear();
      const Vec3d local = frame.to_local(at.position);
      view_.base.at[lane] +=
          add_horizon(frame, {local.x, local.y, -local.z}, frame.axes.to_local(h == 0 ? at.normal : *at.geometric_normal),
                      h == 0 ? Source::shading_horizon : Source::geometric_horizon, horizon_);
      if (horizon_.segments.empty()) continue;
      if (s == nullptr) {
        horizon_rows_[h] = static_cast<std::uint32_t>(work_.count);
        s = &segments_[work_.count++];
        clear_bits(*s);
      }
      const auto bit = static_cast<LaneBits>(1u << lane);
      const Segment& horizon = horizons_[h].lanes[lane] = horizon_.segments.front();
      put_cells(*s, lane, horizon);
      s->present |= bit;
      s->clipped_a |= bit;
      s->clipped_b |= bit;
      for (const LeftEvent& event : horizon_.events) (event.weight == horizon.weight ? s->left_a : s->left_b) |= bit;
    }
  }
}

// The edge of a crossing triangle at which its section starts (0) or ends (1).
std::uint32_t PointLanes::cut_edge(const CrossingTriangle& triangle, int end, std::size_t lane) const {
  const auto above = [&](std::size_t c) {
    return (vertices_[static_cast<std::size_t>(place_of_[triangle.corners[c % 3]])].above >> lane & 1) != 0;
  };
  std::size_t side = 0;
  while (side < 2 && !(above(side) == (end != 0) && above(side + 1) == (end == 0))) ++side;
  return triangle.edges[side];
}

Segment PointLanes::segment(std::uint32_t number, std::size_t lane) const {
  const std::size_t surroundings = seen_.edges + seen_.sections;
  if (number >= surroundings && number < surroundings + outline_size_) {
    Segment s = (*points_[lane].outline)[number - surroundings];
    s.place_a = s.place_b = -1;
    return s;
  }
  if (number >= surroundings) return horizons_[number == horizon_rows_[0] ? 0 : 1].lanes[lane];
  const SegmentLanes& s = segments_[number];
  const CrossingTriangle* triangle = number < seen_.edges ? nullptr : &edges_->crossing()[s.row];
  const auto end = [&](int which, LaneBits clipped, LaneBits cut, const LaneReals& x, const LaneReals& y) {
    const std::int32_t cell_x = whole(x.at[lane]), cell_y = whole(y.at[lane]);
    if ((cut >> lane & 1) != 0)
      return cell_of(kCutId | (triangle != nullptr ? cut_edge(*triangle, which, lane) : edges_->edge_number(s.row)), cell_x, cell_y);
    if ((clipped >> lane & 1) != 0)
      return cell_of(triangle != nullptr ? clip_id(Source::section, triangle->number, which)
                                         : clip_id(Source::edge, edges_->edge_number(s.row), which),
                     cell_x, cell_y);
    return edges_->end_of(s.row, which, cell_x, cell_y);
  };
  Segment result;
  result.a = end(0, s.clipped_a, s.cut_a, s.ax, s.ay);
  result.b = end(1, s.clipped_b, s.cut_b, s.bx, s.by);
  result.weight = s.weight.at[lane];
  return result;
}

ExactLanes PointLanes::exact() const {
  static constexpr auto self_of = [](const void* self) -> const PointLanes& { return *static_cast<const PointLanes*>(self); };
  ExactLanes result;
  result.self = this;
  result.cross = [](const void* self, std::uint32_t e, std::uint32_t f, std::size_t lane, CrossingLanes& to) {
    const PointLanes& lanes = self_of(self);
    const Segment of_e = lanes.segment(e, lane), of_f = lanes.segment(f, lane);
    CrossingPair pair;
    if (!shadow::cross(of_e, of_f, pair)) return;
    const auto set = [&](LaneBits& bits, bool value) {
      const auto bit = static_cast<LaneBits>(1u << lane);
      bits = static_cast<LaneBits>(value ? bits | bit : bits & ~bit);
    };
    set(to.mask, true);
    set(to.e_to_left, pair.on_e.change == of_f.weight);
    set(to.f_to_left, pair.on_f.change == of_e.weight);
    set(to.after_e, pair.on_e.after);
    set(to.after_f, pair.on_f.after);
    to.t_e.at[lane] = static_cast<float>(pair.on_e.t);
    to.t_f.at[lane] = static_cast<float>(pair.on_f.t);
  };
  result.left_ray = [](const void* self, std::uint32_t e, std::uint32_t f, std::size_t lane) {
    return left_ray_crosses(self_of(self).segment(e, lane), self_of(self).segment(f, lane));
  };
  result.event_below = [](const void* self, std::uint32_t e, std::uint32_t f, int end, std::size_t lane) {
    const Segment with_event = self_of(self).segment(f, lane);
    const SnappedVertex& at = end == 0 ? with_event.a : with_event.b;
    return lies_below_middle({at.y, at.dy, 0}, self_of(self).segment(e, lane));
  };
  result.runs_up = [](const void* self, std::uint32_t e, std::size_t lane) { return shadow::runs_up(self_of(self).segment(e, lane)); };
  return result;
}

// Allocates memory for all results that depend on the segments.
void PointLanes::make_room() {
  const std::size_t n = segments_.size(), room = padded(n);
  if (events_.size() < room) {
    for (std::vector<float>* v : {&low_x_, &high_x_, &low_y_, &high_y_}) v->resize(room);
    for (std::vector<float>* v : {&block_low_x_, &block_high_x_, &block_low_y_, &block_high_y_}) v->resize(padded(room / kPadding));
    place_in_set_.resize(room);
    events_.resize(room);
    crossing_first_.resize(room + 1);
    ends_.resize(2 * room);
    stack_.resize(kPoints * room + 1);
  }
  const std::size_t places = vertices_.size() + outline_size_ + 1;
  if (end_first_.size() < places + 1) {
    end_first_.resize(places + 1);
    shared_by_two_.resize(places);
  }
}

// Computes the boxes of the segments and of their blocks. The order is that of the edges in their tree, so the boxes of a block are near
// each other: a sort by height gains less than it costs.
void PointLanes::find_boxes(const LaneTable& packs) {
  constexpr float kFar = 1e9f;
  const std::size_t n = work_.count, room = padded(n);
  work_.boxes = {low_x_.data(),       high_x_.data(),       low_y_.data(),       high_y_.data(),
                 block_low_x_.data(), block_high_x_.data(), block_low_y_.data(), block_high_y_.data()};
  packs.bound(segments_.data(), n, work_.boxes);
  for (std::size_t i = n; i < room; ++i) {
    low_x_[i] = low_y_[i] = kFar;
    high_x_[i] = high_y_[i] = -kFar;
  }
  for (std::size_t block = 0; block < room / kPadding; ++block) {
    const auto first = static_cast<std::ptrdiff_t>(block * kPadding), last = first + static_cast<std::ptrdiff_t>(kPadding);
    block_low_x_[block] = *std::min_element(low_x_.begin() + first, low_x_.begin() + last);
    block_low_y_[block] = *std::min_element(low_y_.begin() + first, low_y_.begin() + last);
    block_high_x_[block] = *std::max_element(high_x_.begin() + first, high_x_.begin() + last);
    block_high_y_[block] = *std::max_element(high_y_.begin() + first, high_y_.begin() + last);
  }
  for (std::size_t block = room / kPadding; block < padded(room / kPadding); ++block) {
    block_low_x_[block] = block_low_y_[block] = kFar;
    block_high_x_[block] = block_high_y_[block] = -kFar;
  }
}

void PointLanes::find(const LaneTable& packs, const EdgeArrays& edges, const LightFrame& base, bool turned, std::span<const Point> points) {
  edges_ = &edges;
  outline_size_ = points.front().outline->size();
  point_count_ = points.size();
  std::copy(points.begin(), points.end(), points_.begin());
  take_points(edges, base, turned);
  const auto grow = [](auto& v, std::size_t n) {
    if (v.size() < n) v.resize(n + n / 2);
  };
  grow(front_, edges.plane_count() + 1);
  if (edges.plane_count() == 0) front_[0] = 0;  // edges without a triangle read the first entry
  grow(place_of_, edges.vertex_count());
  grow(vertices_, edges.vertex_count());
  grow(segments_, edges.edge_count() + edges.crossing().size() + outline_size_ + 2);
  seen_ = packs.see(edges.lane_edges(), view_, front_.data(), place_of_.data(), vertices_.data(), segments_.data());
  work_.count = seen_.edges + seen_.sections;
  work_.outline = static_cast<std::uint32_t>(work_.count);
  work_.layered = points.front().frame->layered;
  occluded_ = 0;
  for (std::size_t s = 0; s < work_.count; ++s) occluded_ |= segments_[s].present;
  LaneBits arranged = occluded_;
  for (std::size_t lane = 0; lane < point_count_; ++lane)
    if (points_[lane].arranged) arranged |= static_cast<LaneBits>(1u << lane);
  region_.none = region_.found = thin_ = 0;
  if (arranged == 0) return;
  add_surroundings(arranged);
  make_room();
  find_boxes(packs);
  work_.segments = segments_.data();
  work_.place_count = seen_.vertices + outline_size_;
  work_.crossing_first = crossing_first_.data();
  work_.end_first = end_first_.data();
  work_.ends = ends_.data();
  work_.shared_by_two = shared_by_two_.data();
  work_.stack = stack_.data();
  work_.events = events_.data();
  work_.exact = exact();
  while (true) {
    work_.crossings.data = crossings_.data();
    work_.crossings.capacity = crossings_.size();
    if (packs.cross(work_)) break;
    crossings_.resize(2 * crossings_.size() + 64);
  }
  grow(crossing_list_, 2 * work_.crossings.size);
  grow(sorted_t_, 2 * work_.crossings.size);
  grow(sorted_change_, 2 * work_.crossings.size);
  work_.crossing_list = crossing_list_.data();
  work_.sorted_t = sorted_t_.data();
  work_.sorted_change = sorted_change_.data();
  packs.count(work_, view_);
  std::fill(std::begin(region_.floor.at), std::end(region_.floor.at), INT_MIN);
  cut(packs, arranged);
  packs.region(work_, view_, arranged, region_);
  pass_over_thin_levels(packs, arranged);
}

void PointLanes::cut(const LaneTable& packs, LaneBits arranged) {
  while (true) {
    work_.pieces.data = pieces_.data();
    work_.pieces.capacity = pieces_.size();
    if (packs.cut(work_, arranged, region_)) break;
    pieces_.resize(2 * pieces_.size() + 256);
  }
}

// The region of the lowest level may be a sliver that roundings made. Then the next level decides, as in find_visible.
void PointLanes::pass_over_thin_levels(const LaneTable& packs, LaneBits arranged) {
  constexpr int kMostLevels = 8;
  thin_ = 0;
  for (int passed = 0; passed < kMostLevels; ++passed) {
    LaneBits again = 0;
    for (std::uint32_t bits = arranged & ~(region_.none | region_.wide); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const Width width = width_in(lane);
      if (width == Width::wide) continue;  // the lane is left to its own search
      if (width == Width::thin) thin_ |= static_cast<LaneBits>(1u << lane);
      again |= static_cast<LaneBits>(1u << lane);
      region_.floor.at[lane] = region_.level.at[lane];
    }
    if (again == 0) return;
    const RegionLanes before = region_;
    cut(packs, arranged);
    packs.region(work_, view_, again, region_);
    const auto settled = static_cast<LaneBits>(~again);
    region_.wide |= before.wide & settled;
    region_.found |= before.found & settled;
    for (std::size_t lane = 0; lane < kPoints; ++lane) {
      if ((again >> lane & 1) != 0) continue;
      region_.place_x.at[lane] = before.place_x.at[lane];
      region_.place_y.at[lane] = before.place_y.at[lane];
    }
  }
}

// Judges the region of a lane's level, and keeps a place of a thin one.
Width PointLanes::width_in(std::size_t lane) {
  of_lane_.clear();
  of_lane_.base = view_.base.at[lane];
  of_lane_.layered = work_.layered;
  pieces_of_lane_.clear();
  const std::int32_t level = region_.level.at[lane];
  const auto add = [&](float ax, float ay, float bx, float by, std::size_t number, bool backwards) {
    Piece piece{double{ax}, double{ay}, double{bx}, double{by}, level, level + 1, static_cast<std::uint32_t>(number)};
    if (backwards) std::swap(piece.left, piece.right);
    pieces_of_lane_.push_back(piece);
  };
  for (std::uint32_t number = 0; number < work_.count; ++number) {
    const SegmentLanes& s = segments_[number];
    if ((s.present >> lane & 1) == 0) continue;
    place_in_set_[number] = static_cast<std::uint32_t>(of_lane_.segments.size());
    const Segment segment = this->segment(number, lane);
    of_lane_.segments.push_back(segment);
    if ((s.left_a >> lane & 1) != 0) of_lane_.events.push_back({segment.a.y, segment.a.dy, segment.weight});
    if ((s.left_b >> lane & 1) != 0) of_lane_.events.push_back({segment.b.y, segment.b.dy, -segment.weight});
    if ((s.bounds >> lane & 1) != 0)
      add(s.ax.at[lane], s.ay.at[lane], s.bx.at[lane], s.by.at[lane], place_in_set_[number], segment.weight > 0);
  }
  for (std::size_t k = 0; k < work_.pieces.size; ++k) {
    const CrossedPiece& p = pieces_[k];
    if (p.lane == lane) add(p.ax, p.ay, p.bx, p.by, place_in_set_[p.segment], false);
  }
  return width_of(of_lane_, pieces_of_lane_, level, thin_places_[lane].x, thin_places_[lane].y);
}

Vec3d PointLanes::in_world(std::size_t lane, double x, double y) const {
  const LightFrame& frame = *points_[lane].frame;
  return frame.to_world({x / kCells * frame.box_x, y / kCells * frame.box_y, 0});
}

std::size_t PointLanes::segment_count(std::size_t lane) const {
  std::size_t n = 0;
  for (std::size_t s = 0; s < seen_.edges + seen_.sections; ++s) n += segments_[s].present >> lane & 1;
  return n;
}

}  // namespace steradian::shadow
