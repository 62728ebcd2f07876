// PointLanes: the parts of a light that up to sixteen neighbouring points see, computed at once. The result equals each point's own
// segments, arrangement and region. Without a position well inside the region, the point falls back to its own search.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shadow/edges/edge_arrays.h"
#include "shadow/lanes/lanes.h"
#include "shadow/region/visible.h"

namespace steradian::shadow {

class PointLanes {
 public:
  struct Point {
    const LightFrame* frame = nullptr;
    const Viewpoint* at = nullptr;
    const std::vector<Segment>* outline = nullptr;  // of its frame, in its cells
    bool arranged = false;                          // true: also if it sees no occluder
  };

  // edges: in the coordinates of `base`. base: the points' frame, or another one if `turned`. The outlines of all points have the same
  // number of segments.
  void find(const LaneTable& packs, const EdgeArrays& edges, const LightFrame& base, bool turned, std::span<const Point> points);

  // Lanes that see occluders. Of the other lanes, only those to be arranged are in the results below.
  LaneBits occluded() const { return occluded_; }
  LaneBits none() const { return region_.none; }    // lanes that see nothing
  LaneBits found() const { return region_.found; }  // lanes that see a region if the way to its position is free, else nothing
  Vec3d place(std::size_t lane) const { return in_world(lane, double{region_.place_x.at[lane]}, double{region_.place_y.at[lane]}); }
  // Lanes with a thin region at a lower level. If the way to its position is free, and that to place() is not, they see that region.
  LaneBits thin() const { return thin_; }
  Vec3d thin_place(std::size_t lane) const { return in_world(lane, thin_places_[lane].x, thin_places_[lane].y); }
  // Number of segments that a lane sees.
  std::size_t segment_count(std::size_t lane) const;

  // The edges that bound the region in some lanes: their number, and their values in planes of a block of packed::Pieces.
  std::size_t count_edges(const LaneTable& packs, LaneBits lanes) const { return packs.count_edges(work_, lanes); }
  void write_edges(const LaneTable& packs, LaneBits lanes, float* to) const { packs.write_edges(work_, view_, region_, lanes, to); }

  // Calls use(ax, ay, bx, by) for the edges of one lane, in the light's plane.
  template <class Use>
  void each_edge(std::size_t lane, Use use) const {
    const auto in_frame = [&](float ax, float ay, float bx, float by, bool backwards) {
      const double x = points_[lane].frame->box_x / kCells, y = points_[lane].frame->box_y / kCells;
      const double a[2] = {static_cast<double>(ax) * x, static_cast<double>(ay) * y};
      const double b[2] = {static_cast<double>(bx) * x, static_cast<double>(by) * y};
      backwards ? use(b[0], b[1], a[0], a[1]) : use(a[0], a[1], b[0], b[1]);
    };
    for (std::size_t s = 0; s < work_.count; ++s) {
      const SegmentLanes& e = segments_[s];
      if ((e.bounds >> lane & 1) != 0) in_frame(e.ax.at[lane], e.ay.at[lane], e.bx.at[lane], e.by.at[lane], e.weight.at[lane] > 0);
    }
    for (std::size_t k = 0; k < work_.pieces.size; ++k) {
      const CrossedPiece& p = pieces_[k];
      if (p.lane == lane) in_frame(p.ax, p.ay, p.bx, p.by, false);
    }
  }

 private:
  void take_points(const EdgeArrays& edges, const LightFrame& base, bool turned);
  void add_surroundings(LaneBits lanes);
  void make_room();
  void find_boxes(const LaneTable& packs);
  std::uint32_t cut_edge(const CrossingTriangle& triangle, int end, std::size_t lane) const;
  Segment segment(std::uint32_t number, std::size_t lane) const;
  ExactLanes exact() const;
  void cut(const LaneTable& packs, LaneBits arranged);
  void pass_over_thin_levels(const LaneTable& packs, LaneBits arranged);
  Width width_in(std::size_t lane);
  Vec3d in_world(std::size_t lane, double x, double y) const;  // from cells

  std::array<Point, kPoints> points_;
  std::size_t point_count_ = 0;
  const EdgeArrays* edges_ = nullptr;
  std::size_t outline_size_ = 0;
  LaneBits occluded_ = 0;
  LaneView view_;
  LaneWork work_;
  RegionLanes region_;
  SeenByLanes seen_;
  struct Horizon {
    std::array<Segment, kPoints> lanes;
  };
  std::array<Horizon, 2> horizons_;  // horizons of the shading normal and the triangle
  std::array<std::uint32_t, 2> horizon_rows_{};
  LaneBits thin_ = 0;
  std::array<Corner, kPoints> thin_places_;  // in cells

  // Reused memory.
  std::vector<std::uint16_t> front_;
  std::vector<std::int32_t> place_of_;
  std::vector<VertexLanes> vertices_;
  std::vector<SegmentLanes> segments_;
  std::vector<CrossingLanes> crossings_;
  std::vector<CrossedPiece> pieces_;
  std::vector<float> low_x_, high_x_, low_y_, high_y_, block_low_x_, block_high_x_, block_low_y_, block_high_y_;
  std::vector<LaneReals> sorted_t_;
  std::vector<LaneInts> sorted_change_;
  std::vector<std::uint32_t> crossing_first_, crossing_list_, end_first_, ends_, stack_, events_, place_in_set_;
  std::vector<LaneBits> shared_by_two_;
  SegmentSet horizon_, of_lane_;
  std::vector<Piece> pieces_of_lane_;
};

}  // namespace steradian::shadow
