// EdgeArrays: the edges that a tile or a group of points needs, in the layout of packs, and the segments that a point sees. Positions are
// in float. From cells on, the whole numbers are the same as in segments.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shadow/edges/gather.h"
#include "shadow/edges/segments.h"
#include "shadow/edges/solid_light.h"
#include "shadow/lanes/lanes.h"
#include "shadow/lanes/packs.h"

namespace steradian::shadow {

// Positions in float are relative to an anchor: the origin of a light's frame, or the middle of all triangles for a light that is so far
// away that its coordinates have no digits for distances between triangles.
Vec3d anchor_of(const Around& triangles, const LightFrame& frame);

class EdgeArrays {
 public:
  // Takes edges and crossing triangles with these numbers, ascending, in the coordinates of a frame.
  //
  //   inside  triangles inside the light's body, ascending: they do not block it
  void assign(const EdgeMesh& mesh, const LightFrame& frame, const std::vector<std::uint32_t>& edges,
              const std::vector<std::uint32_t>& crossing_triangles, std::span<const std::uint32_t> inside = {});
  // Takes the edges of a tile that a shaft needs. The shaft is in the world of the tile's frame.
  void assign_needed(const ShadowTable& packs, const EdgeMesh& mesh, const EdgeArrays& tile, const LightFrame& frame, const Shaft& shaft);

  // Adds edges of a solid light, in the coordinates of the frame of `assign`: each of its contours bounds a layer of the light.
  void add_light(const EdgeMesh& mesh, const LightFrame& frame, const SolidLight& light, const std::vector<std::uint32_t>& edges);

  Vec3d anchor() const { return anchor_; }
  Vec3d anchor_of(const LightFrame& frame) const { return shadow::anchor_of(around_, frame); }

  bool empty() const { return edge_.empty() && crossing_.empty(); }
  std::size_t edge_count() const { return edge_.size(); }
  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t plane_count() const { return plane_count_; }
  const std::vector<CrossingTriangle>& crossing() const { return crossing_; }

  // For lanes: the edges, and the cell of an edge's end as its point sees it.
  LaneEdges lane_edges() const;
  std::uint32_t edge_number(std::size_t row) const { return edge_[row]; }
  std::uint32_t vertex_number(std::size_t place) const { return vertex_[place]; }
  SnappedVertex end_of(std::size_t row, int end, std::int32_t x, std::int32_t y) const {
    return vertex_cell(static_cast<std::size_t>(end == 0 ? v0_[row] : v1_[row]), x, y);
  }

  // All segments that the point sees, in the frame of assign (`base`) or in another one. The result is empty if no occluder is among them;
  // see add_surroundings.
  //
  //   outline  of the frame (outline_segments)
  void see(const ShadowTable& packs, const LightFrame& frame, const Viewpoint& from, const std::vector<Segment>& outline,
           SegmentSet& result);
  void see_turned(const ShadowTable& packs, const LightFrame& base, const LightFrame& frame, const Viewpoint& from,
                  const std::vector<Segment>& outline, SegmentSet& result);

 private:
  struct Vectors {
    std::vector<float> x, y, z;
    void resize(std::size_t n);
    void push_back(const Vec3f& v);
    std::size_t size() const { return x.size(); }
    void pad();
    VectorView view() const { return {x.data(), y.data(), z.data()}; }
    VectorSpan span() { return {x.data(), y.data(), z.data()}; }
    Vec3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  };
  SnappedVertex vertex_cell(std::size_t v, std::int32_t x, std::int32_t y) const { return cell_of(vertex_[v], x, y); }
  void clear();
  void pad();
  void add_crossing(const EdgeMesh& mesh, CrossingTriangle triangle);
  EdgeView view() const;
  void collect(const ShadowTable& packs, const LightFrame& frame, const Vectors& vertices, const Vec3d& plane_point, const Viewpoint& from,
               const std::vector<Segment>& outline, SegmentSet& result);

  Around around_;
  Vec3d anchor_;
  std::size_t vertex_count_ = 0, plane_count_ = 0;
  std::size_t of_light_ = 0;  // first vertex of a solid light
  Vectors vertices_;
  std::vector<std::uint32_t> vertex_;  // numbers in the mesh
  Vectors normals_;
  std::vector<float> offsets_;
  std::vector<std::uint32_t> plane_;  // triangles in the mesh
  std::vector<std::uint32_t> edge_;   // numbers in the mesh
  std::vector<std::int32_t> v0_, v1_, plane0_, plane1_;
  std::vector<float> walks0_, walks1_;
  std::vector<std::uint8_t> has_more_;  // true: more than two triangles, all of them in `more_`
  std::vector<LaneEdges::More> more_;
  std::vector<LaneEdges::Incidence> incidences_;
  std::vector<CrossingTriangle> crossing_;

  // Buffers for one point.
  Vectors turned_, homogeneous_;
  std::vector<float> cell_x_, cell_y_, outside_, facing_;
  std::vector<std::uint32_t> found_;
  std::vector<std::int32_t> weights_;
  std::vector<EdgeTriangle> blocking_;
};

// Adds the other bounds of the light: its outline and the point's horizons. They follow the occluders. `see` leaves them out if there are
// no occluders.
void add_surroundings(const LightFrame& frame, const Viewpoint& from, const std::vector<Segment>& outline, SegmentSet& result);

// The outline of a light as segments.
std::vector<Segment> outline_segments(const LightFrame& frame);

}  // namespace steradian::shadow
