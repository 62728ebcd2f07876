// Segments: a point's view of edges, outline and horizons in the plane of a light, each with the jump of the count across it. See steps 1
// to 4 of docs/shadows.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shadow/edges/edges.h"
#include "shadow/region/light_frame.h"

namespace steradian::shadow {

inline constexpr std::int32_t kCells = 1 << 22;   // number from the middle of the box to a side (shadow_cells)
inline constexpr std::int32_t kHidden = 1 << 20;  // weight of outline and horizons: larger than any number of triangles on a ray

// The outline of a solid light may lie on itself. Its weight is kLayer, and a place that some layers of the light cover has the count
// kLayer (1 - layers) + occluders. The layers are taken off before counts are compared, by the function below. There may be 128 layers, and
// 1,023 occluding triangles more than at the box's corner.
inline constexpr std::int32_t kLayer = 1 << 11;
inline std::int32_t without_layers(std::int32_t count) {
  return count > kLayer / 2 ? kHidden : ((count + kLayer / 2) & (kLayer - 1)) - kLayer / 2;
}

// Origin of a segment. Horizons move with nothing.
enum class Source : std::uint8_t { edge, section, outline, shading_horizon, geometric_horizon };

// A vertex in cells, with the displacement that breaks ties: its position is (x, y) + e (dx, dy) for an infinitely small e > 0.
struct SnappedVertex {
  std::int32_t x = 0, y = 0, dx = 0, dy = 0;
  std::uint64_t id = 0;  // equal ids: the same vertex. Equal cells prove nothing.
};

// Computes the displacement of a vertex from its id: two odd numbers below 2^20 in size.
SnappedVertex cell_of(std::uint64_t id, std::int32_t x, std::int32_t y);

// weight: count on the left minus count on the right of the direction from a to b.
struct Segment {
  SnappedVertex a, b;
  std::int32_t weight = 0;
  Source source = Source::edge;
  std::uint32_t index = 0;  // index of the edge, triangle or corner
  // Places of its ends in a table of vertices, if there is one: small numbers, equal if ids are equal.
  std::int32_t place_a = -1, place_b = -1;
};

// Upward crossing of the box's left side: there the count grows by weight.
struct LeftEvent {
  std::int32_t y = 0, dy = 0, weight = 0;
};

struct SegmentSet {
  std::vector<Segment> segments;
  std::vector<LeftEvent> events;
  std::int32_t base = 0;      // count at the lower left corner, without triangles
  std::size_t occluders = 0;  // segments of edges and sections: S
  bool layered = false;       // the light's outline may lie on itself; set with the horizons

  void clear();
};

// A point and its horizons, in world space.
struct Viewpoint {
  Vec3d position;                         // moved off its surface (offset_from_surface)
  Vec3d normal;                           // shading normal, unit
  std::optional<Vec3d> geometric_normal;  // normal of the triangle, towards the viewer; none if it is the normal
  std::uint64_t seed = 0;                 // seed of everything found by random rays from the point
};

// Distance that a point keeps from its triangle. It exceeds the roundings of the point, and those of triangles in the frame of a light
// (docs/theory/shadows.md, "The point").
//
//   reach     largest coordinate of the triangles and the light
//   rounding  of the numbers that hold them, relative
double offset_from_surface(Vec3d position, double reach, double rounding);

inline double largest_coordinate(Vec3d p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }

// Edges and crossing triangles that some points need, in a light's frame. S is the type in which positions are computed: double, or float
// as packs do.
template <class S>
class LocalEdges {
 public:
  // Takes the edges and triangles with these numbers, ascending. They must include every triangle that crosses the plane z = -eta.
  //
  //   inside  triangles inside the light's body, ascending: they do not block it
  void assign(const EdgeMesh& mesh, const LightFrame& frame, const std::vector<std::uint32_t>& edges,
              const std::vector<std::uint32_t>& crossing_triangles, std::span<const std::uint32_t> inside = {});
  void assign_all(const EdgeMesh& mesh, const LightFrame& frame, std::span<const std::uint32_t> inside = {});
  // Moves the same edges and triangles to another frame.
  void move_to(const EdgeMesh& mesh, const LightFrame& frame);

  // All segments that the point sees. `eye` is the point in the light's frame, below the plane.
  void see(const Viewpoint& from, SegmentSet& result) const;

 private:
  struct Vector {
    S x, y, z;
  };
  struct LocalPlane {
    Vector normal;
    S offset;
  };
  struct Incidence {
    std::uint32_t plane;
    std::int32_t walks;
  };
  struct LocalEdge {
    std::uint32_t v0, v1, first, count, number;
  };
  struct LocalTriangle {
    std::uint32_t plane, number;
    std::uint32_t corners[3];
    std::uint32_t edges[3];  // numbers in the mesh
  };

  const LightFrame* frame_ = nullptr;
  std::vector<Vector> vertices_;
  std::vector<std::uint32_t> vertex_numbers_, plane_numbers_;
  std::vector<LocalPlane> planes_;
  std::vector<Incidence> incidences_;
  std::vector<LocalEdge> edges_;
  std::vector<LocalTriangle> crossing_;
};

// Triangles that cross the plane z = -eta of a light, except those inside its body.
std::vector<std::uint32_t> crossing_triangles(const EdgeMesh& mesh, const LightFrame& frame, std::span<const std::uint32_t> inside = {});

// True if a triangle crosses the plane z = -eta of a light.
bool crosses(const EdgeMesh& mesh, const LightFrame& frame, std::uint32_t triangle);

// The triangles of an edge that block a light: those that are not inside its body. Appends them; without any that matter, appends none.
void add_incidences(const EdgeMesh& mesh, const MeshEdge& edge, std::span<const std::uint32_t> inside, std::vector<EdgeTriangle>& to);

}  // namespace steradian::shadow
