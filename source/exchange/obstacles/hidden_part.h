// HiddenPart: the part of a plane element that triangles hide from a point, in double and without rounding in its decisions.
//
// The count of triangles on the way to each place of the element is known from the silhouettes, as for shadows (docs/theory/shadows.md).
// Here a cell is 2^-40 of the element's half size, so that the part's area is right to 1e-11; signs are decided in 128 bits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exchange/pairs/plane_element.h"
#include "shadow/edges/edges.h"

namespace steradian::exchange {

// A place in cells, with the displacement by an infinitely small e (dx, dy) that breaks ties. Equal ids: the same vertex. The numbers are
// whole; in double, their differences and doubles are exact.
struct FineCell {
  double x = 0, y = 0;
  std::int32_t dx = 0, dy = 0;
  std::uint64_t id = 0;
};

// weight: count on the left minus count on the right of the direction from a to b.
struct FineSegment {
  FineCell a, b;
  std::int32_t weight = 0;
  std::uint32_t line = 0;  // the same for all points: of an edge, of a section by the near plane, or of a side of the outline
};

class HiddenPart {
 public:
  // All points lie in front of the target, and see its front. The mesh must outlive the object.
  HiddenPart(const PlaneElement& target, const shadow::EdgeMesh& mesh);

  // The configuration factor of the hidden part for a point with a unit normal: what the triangles take from the factor of the whole
  // target, which lies above the point's horizon. Never negative.
  double hidden_factor(Vec3d point, Vec3d normal);

  // The factor of the target itself by the same sum.
  double whole_factor(Vec3d point, Vec3d normal);

  // Area of the target behind parts of obstacles that lie nearer to its plane than the finder tells apart. These parts are not hidden.
  double area_near_plane() const { return area_near_plane_; }

  // Tells the last hidden parts apart by the lines and crossings that bound them. Where it changes, the factor is not smooth.
  std::uint64_t shape() const { return shape_; }

  // True if the boundary of the last hidden part was closed to rounding. If not, the part is not known.
  bool is_proven() const;

 private:
  struct LeftCrossing {
    double y;
    std::int32_t dy, weight;
  };
  // Crossing of a segment with another one: fraction of the way, side of the middle, change of the count on the left.
  struct CrossedAt {
    bool after_middle;
    double t;
    std::int32_t change;
    std::uint32_t line;  // of the other segment
  };
  struct Homogeneous {
    double x, y, w;
  };
  Homogeneous seen(Vec3d vertex) const {
    return {vertex.x * eye_.z + eye_.x * vertex.z, vertex.y * eye_.z + eye_.y * vertex.z, vertex.z + eye_.z};
  }
  bool lies_below(std::uint32_t vertex) const { return vertices_[vertex].z < -eta_; }
  double shadow_near_plane(const std::array<std::uint32_t, 3>& corners) const;
  void add_segment(Homogeneous a, Homogeneous b, std::uint64_t id_a, std::uint64_t id_b, std::uint32_t line, std::int32_t weight);
  void collect();
  void arrange(Vec3d normal);
  void bound_segments();
  void find_crossings();
  void add_crossings(std::size_t i, std::size_t j);
  std::int32_t count_left_of(const FineSegment& e, std::size_t own) const;
  std::int32_t hits_towards(double x, double y) const;
  std::int32_t level_of_visible();
  double edge_factor(double ax, double ay, double bx, double by, Vec3d normal) const;

  const shadow::EdgeMesh& mesh_;
  Frame axes_;
  Vec3d origin_;
  double box_x_ = 0, box_y_ = 0, eta_ = 0, area_near_plane_ = 0;
  std::vector<std::vector<std::array<double, 2>>> outline_;
  std::vector<Vec3d> vertices_;  // in the target's frame
  struct LocalFace {
    Vec3d normal;
    double offset;
  };
  std::vector<LocalFace> faces_;
  std::vector<std::int32_t> facing_;  // of the faces, for the current point: 1 or -1

  // For the current point.
  Vec3d eye_;  // (x, y, -z) in the target's frame
  std::vector<FineSegment> segments_;
  std::vector<LeftCrossing> crossings_;
  std::vector<double> low_, high_, left_, right_;
  std::vector<std::vector<CrossedAt>> crossed_;  // of each segment
  double sum_ = 0, closure_ = 0;
  std::uint64_t shape_ = 0;
};

}  // namespace steradian::exchange
