// Solid lights: their frames, and the part of one that points see past occluders, against rays.
#include "shadow/edges/solid_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/random.h"
#include "shadow/edges/edge_arrays.h"
#include "shadow/lanes/point_lanes.h"
#include "shadow/rays/triangle_rays.h"
#include "shadow/region/visible.h"
#include "support/rings.h"

namespace steradian::shadow::solid_light_test {
namespace {

struct Ring {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
  SolidLight light;
};

// Every triangle is a face.
std::optional<SolidLight> light_of(const std::vector<Vec3d>& positions, const std::vector<std::uint32_t>& indices) {
  std::vector<std::array<Vec3d, 3>> triangles;
  std::vector<std::uint32_t> face_of;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    triangles.push_back({positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]});
    face_of.push_back(static_cast<std::uint32_t>(i / 3));
  }
  return solid_light(triangles, face_of, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

Ring ring() {
  const Mesh mesh = scene::ring_mesh({0, 0, 0}, 0.5, 0.15, 0.3, 0, 24, 8);
  Ring r;
  for (const Vec3f& p : mesh.positions) r.positions.push_back(static_cast<Vec3d>(p));
  r.indices = mesh.indices;
  r.light = light_of(r.positions, r.indices).value();
  return r;
}

Box3d box_at(Vec3d p, double half) { return {p - Box3d::all(half), p + Box3d::all(half)}; }

Vec3d around(reference::Random& random, double least, double most) {
  while (true) {
    const Vec3d p{random.uniform() * 2 - 1, random.uniform() * 2 - 1, random.uniform() * 2 - 1};
    if (dot(p, p) < 1 && dot(p, p) > 1e-4) return normalized(p) * (least + (most - least) * random.uniform());
  }
}

TEST(SolidLight, IsMadeOfClosedMeshesOnly) {
  Ring r = ring();
  EXPECT_EQ(r.light.vertices.size(), 192u);
  EXPECT_EQ(r.light.edges.size(), 576u);  // vertices - edges + faces = 0
  r.indices.resize(r.indices.size() - 3);
  EXPECT_FALSE(light_of(r.positions, r.indices));
}

// The light lies beyond the frame's plane, and within its box as seen from any point.
TEST(SolidLight, LiesInItsFrame) {
  const Ring r = ring();
  reference::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Box3d points = box_at(around(random, 0.9, 6), 0.1 * random.uniform());
    const std::vector<LightFrame> frames = frames_of(r.light, points);
    ASSERT_FALSE(frames.empty()) << i;
    const LightFrame* frame = &frames[static_cast<std::size_t>(i) % frames.size()];
    for (int k = 0; k < 8; ++k) {
      const Vec3d size = points.size();
      const Vec3d eye =
          frame->to_local(points.low + Vec3d{size.x * random.uniform(), size.y * random.uniform(), size.z * random.uniform()});
      EXPECT_LT(eye.z, -frame->eta);
      for (const Vec3d& v : r.light.vertices) {
        const Vec3d p = frame->to_local(v);
        EXPECT_GT(p.z, -1e-12);
        const double t = -eye.z / (p.z - eye.z);
        EXPECT_LT(std::fabs(eye.x + (p.x - eye.x) * t), frame->box_x);
        EXPECT_LT(std::fabs(eye.y + (p.y - eye.y) * t), frame->box_y);
      }
    }
  }
  EXPECT_TRUE(frames_of(r.light, box_at({0, 0, 0}, 0.01)).empty());
}

double area_in_box(const VisibleRegion& region) {
  double area = 0;
  for (const Boundary& b : region.boundary) area += 0.5 * (b.ax * b.by - b.ay * b.bx);
  return area / kCells / kCells;  // in half sides
}
double perimeter_in_box(const VisibleRegion& region) {
  double sum = 0;
  for (const Boundary& b : region.boundary) sum += std::hypot(b.bx - b.ax, b.by - b.ay);
  return sum / kCells;
}

// The visible part has the area that rays find, by lanes and by each point's own search. From many points the ring lies before itself.
TEST(SolidLight, IsSeenAsByRays) {
  const Ring r = ring();
  reference::Random random(2);
  const ShadowTable& packs = shadow_table_for(active_simd());
  const EdgeMesh ring_mesh = build_edges(r.positions, r.indices);
  const TriangleRays ring_rays(ring_mesh);
  PointLanes lanes;
  int tested = 0, in_lanes = 0, layered = 0;
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3d p = around(random, 1, 3);
    const std::vector<LightFrame> frames = frames_of(r.light, box_at(p, 0));
    ASSERT_FALSE(frames.empty());
    const LightFrame* frame = &frames[static_cast<std::size_t>(i) % frames.size()];
    const Frame across = Frame::from_normal(normalized(p));
    const Vec3d m = p * 0.8, u = across.x * 0.5, v = across.y * 0.04, s = across.y * 0.5, t = across.x * 0.03;
    // Two bars before the point, one behind the other.
    const Vec3d n = p * 0.75;
    const EdgeMesh bars = build_edges({m - u - v, m + u - v, m + u + v, m - u + v, n - s - t, n + s - t, n + s + t, n - s + t},
                                      {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
    const TriangleRays bar_rays(bars);
    std::vector<std::uint32_t> all(bars.edges.size());
    for (std::uint32_t e = 0; e < all.size(); ++e) all[e] = e;
    EdgeArrays arrays;
    arrays.assign(bars, *frame, all, crossing_triangles(bars, *frame));
    arrays.add_light(bars, *frame, r.light, contours_from(r.light, box_at(p, 0)));
    const Viewpoint at{p, normalized(-p), {}, 1};
    Scratch scratch;
    VisibleRegion region;
    const std::vector<Segment> nothing;
    arrays.see(packs, *frame, at, nothing, scratch.set);
    find_visible(*frame, p, bar_rays, scratch, region);
    const double area = area_in_box(region), perimeter = perimeter_in_box(region);
    const auto lies_on_light = [&](const Piece& e) {
      return std::abs(scratch.set.segments[e.segment].weight) == kLayer && e.left == e.right && e.left < kHidden;
    };
    layered += std::any_of(scratch.pieces.begin(), scratch.pieces.end(), lies_on_light);

    const std::vector<PointLanes::Point> asked{{&*frame, &at, &nothing, true}};
    lanes.find(lane_table_for(active_simd()), arrays, *frame, false, asked);
    if ((lanes.found() & 1) != 0) {
      ++in_lanes;
      double of_lane = 0;
      lanes.each_edge(0, [&](double ax, double ay, double bx, double by) { of_lane += 0.5 * (ax * by - ay * bx); });
      // A crossing in a lane lies on a float's grid in cells: 2^-24 of the box, on either side of an edge.
      EXPECT_NEAR(of_lane / (frame->box_x * frame->box_y), area, 2 * perimeter * 0x1p-23) << i;
    }

    // One ray in each of n x n squares. Each square that the boundary crosses is wrong by at most half of its area, with either sign: their
    // number is at most 4/pi perimeter / side and one for each piece.
    constexpr int kSide = 96;
    int seen = 0;
    for (int a = 0; a < kSide; ++a)
      for (int b = 0; b < kSide; ++b) {
        const double x = (2 * (a + random.uniform()) / kSide - 1) * frame->box_x,
                     y = (2 * (b + random.uniform()) / kSide - 1) * frame->box_y;
        const Vec3d q = frame->to_world({x, y, 0});
        seen += ring_rays.between(p, p + (q - p) * 20) && !bar_rays.between(p, q);
      }
    const double square = 4.0 / kSide / kSide;
    const double crossed = 4 / M_PI * perimeter * kSide / 2 + static_cast<double>(region.boundary.size());
    const double off = std::fabs(seen * square - area) / (0.5 * square * std::sqrt(crossed));
    worst = std::max(worst, off);
    EXPECT_LT(off, 5) << i << ": rays " << seen * square << ", region " << area;
    ++tested;
  }
  std::printf("%d points, %d in lanes, %d see the ring before itself; worst difference %.1f sigma\n", tested, in_lanes, layered, worst);
  EXPECT_GT(in_lanes, tested / 2);
  EXPECT_GT(layered, 5);
}

}  // namespace
}  // namespace steradian::shadow::solid_light_test
