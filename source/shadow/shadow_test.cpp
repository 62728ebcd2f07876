#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/random.h"
#include "integrals/tables/ggx_tables.h"
#include "integrals/tables/table.h"
#include "lobes/lobe.h"
#include "night.h"
#include "shadow/edges/edge_arrays.h"
#include "shadow/lanes/point_lanes.h"
#include "shadow/rays/triangle_rays.h"
#include "shadow/region/round_light.h"
#include "shadow/region/visible.h"
#include "shadow/region/visible_part.h"
#include "steradian/kernels.h"
#include "steradian/kernels.h"
#include "support/rays_integral.h"
#include "support/shadow_families.h"

namespace steradian::shadow::shadow_test {
namespace {

using K = Kernels<double>;

// A prepared family.
struct Stage {
  explicit Stage(const families::Family& f)
      : family(f),
        light(prepare_polygon(f.light)),
        mesh(build_edges(f.triangles.positions, f.triangles.indices)),
        rays(mesh),
        frames{light_frame(light, 1), light_frame(light, -1)} {
    for (std::size_t i = 0; i < 2; ++i) {
      exact[i].assign_all(mesh, frames[i]);
      single[i].assign_all(mesh, frames[i]);
    }
  }
  std::size_t side_of(const Viewpoint& at) const { return light.side_of(at.position) > 0 ? 0 : 1; }

  const families::Family& family;
  PreparedPolygon light;
  EdgeMesh mesh;
  TriangleRays rays;
  LightFrame frames[2];
  LocalEdges<double> exact[2];
  LocalEdges<float> single[2];
};

const ShadowTable& packs() { return shadow_table_for(active_simd()); }

double area_of(const VisibleRegion& region) {
  double area = 0;
  for (const Boundary& b : region.boundary) area += 0.5 * (b.ax * b.by - b.ay * b.bx);
  return area / (4.0 * kCells * kCells);  // as a fraction of the box
}

// Distance to the nearest segment, in half sides.
double clearance(const SegmentSet& set, double x, double y) {
  double least = INFINITY;
  for (const Segment& s : set.segments) {
    const double fx = s.b.x - s.a.x, fy = s.b.y - s.a.y, gx = x - s.a.x, gy = y - s.a.y;
    const double length2 = fx * fx + fy * fy;
    const double t = length2 > 0 ? std::clamp((gx * fx + gy * fy) / length2, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(gx - t * fx, gy - t * fy));
  }
  return least / kCells;
}

// Judge of the whole construction: a ray must confirm the level at a position of the light.
TEST(SoftShadow, RaysFindWhatTheLevelsSay) {
  constexpr int kPoints = 40, kRays = 30;
  for (const families::Family& family : families::all()) {
    SCOPED_TRACE(family.name);
    const Stage stage(family);
    families::Random random(1, 17);
    Scratch scratch, single;
    VisibleRegion region, in_single;
    double single_squares = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double rounding = i % 2 == 0 ? 0x1p-24 : 0x1p-50;  // as in pictures, and as in eval
      const families::Point point = families::random_point(family, stage.mesh, stage.light, random, rounding);
      const Viewpoint& at = point.at;
      const std::size_t side = stage.side_of(at);
      const LightFrame& frame = stage.frames[side];
      stage.exact[side].see(at, scratch.set);
      find_visible(frame, at.position, stage.rays, scratch, region);

      // The pieces close: their vector sum is rounding, 2^-53 of a half side for each of some hundred pieces.
      double x = 0, y = 0;
      for (const Boundary& b : region.boundary) {
        x += (b.bx - b.ax) / kCells;
        y += (b.by - b.ay) / kCells;
      }
      EXPECT_LE(std::hypot(x, y), 1e-12) << point.kind << " " << i;

      const double height = -frame.to_local(at.position).z;
      for (int k = 0; k < kRays; ++k) {
        const double qx = random.uniform(-1, 1) * kCells, qy = random.uniform(-1, 1) * kCells;
        if (clearance(scratch.set, qx, qy) < 1e-5) continue;
        const std::int32_t count = count_at(scratch.set, qx, qy);
        const bool visible = !region.boundary.empty() && count <= region.level;
        if (count >= kHidden / 2) {
          EXPECT_FALSE(visible) << point.kind << " " << i;
          continue;
        }
        const Vec3d to = frame.to_world({qx / kCells * frame.box_x, qy / kCells * frame.box_y, 0}) - at.position;
        EXPECT_EQ(visible, !stage.rays.between(at.position, at.position + to * ((height - frame.eta) / height)))
            << point.kind << " " << i << ", count " << count << ", level " << region.level;
      }

      // Positions in float move a vertex by about 2^-24 of its distance from the light's middle. The bound is less than 1e-4 of the
      // light's area (goal), and 5e-7 in the mean.
      stage.single[side].see(at, single.set);
      find_visible(frame, at.position, stage.rays, single, in_single);
      const double change = area_of(region) - area_of(in_single);
      EXPECT_LE(std::fabs(change), 1e-4) << point.kind << " " << i;
      single_squares += change * change;
    }
    EXPECT_LE(std::sqrt(single_squares / kPoints), 5e-7);
  }
}

// Lambert, a transformed cosine and bare GGX over the visible part, against rays.
TEST(SoftShadow, PiecesHoldTheLightThatArrivesByRays) {
  std::size_t number = 0;
  for (const families::Family& family : families::all()) {
    if (number++ % test::by_day_or_night<std::size_t>(2, 1) != 0) continue;
    SCOPED_TRACE(family.name);
    const Stage stage(family);
    families::Random random(2, 17);
    Scratch scratch;
    VisibleRegion region;
    // If a cell of the judge could miss thin parts, it begins with smaller cells.
    const bool fine = family.edges_tolerance > 2e-5 || stage.mesh.triangles.size() == 24 * 12 || family.name == "12 boxes under a star" ||
                      family.name.starts_with("occluders") || family.name.starts_with("boxes through");
    for (int tries = 0, points = 0; points < 1 && tries < 1000; ++tries) {
      const families::Point point = families::random_point(family, stage.mesh, stage.light, random);
      const Viewpoint& at = point.at;
      const std::size_t side = stage.side_of(at);
      const LightFrame& frame = stage.frames[side];
      stage.exact[side].see(at, scratch.set);
      find_visible(frame, at.position, stage.rays, scratch, region);
      if (scratch.set.occluders == 0 || region.boundary.empty()) continue;
      ++points;

      K k;
      const Frame shading = Frame::from_normal(at.normal);
      const Vec3d view{0.6, 0, 0.8};
      Material ggx;
      ggx.brdf = Brdf::ggx;
      ggx.alpha_x = ggx.alpha_y = 0.25;
      ggx.shadowing = false;
      const lobes::Lobe lobe(ggx, view);
      const LtcValue value = ggx_classic_table().look_up(0.5, view.z);
      K::LtcMatrix m;
      m.xx = value.inverse.xx, m.xz = value.inverse.xz, m.yy = value.inverse.yy, m.zx = value.inverse.zx, m.zz = value.inverse.zz;
      const auto densities = [&](Vec3d l) -> std::array<double, 3> {
        if (!(l.z > 0)) return {};
        return {l.z / std::numbers::pi, k.ltc_lobe(m, {l.x, l.y, l.z}).v, lobe.evaluate(l).plain};
      };
      RaysIntegral<3, decltype(densities)> by_rays(frame, at, stage.rays, shading, densities);
      const std::array<double, 3> expected = fine ? by_rays.run(240, 3) : by_rays.run(48, 5);

      // The same densities over all of the light, to which errors are relative.
      const TriangleRays nothing{EdgeMesh{}};
      RaysIntegral<3, decltype(densities)> unoccluded(frame, {at.position, at.normal, {}}, nothing, shading, densities);
      const std::array<double, 3> whole = unoccluded.run(48, 5);

      const auto ggx_view = k.ggx_view({view.x, view.y, view.z}, 0.25, 0.25);
      K::vec3 irradiance(0.0, 0.0, 0.0), e(0.0, 0.0, 0.0);
      auto walk = k.polygon_begin();
      for (const Boundary& piece : region.boundary) {
        const WorldPiece w = relative_to(at.position, frame, piece);
        const auto direction = [&](Vec3d v) {
          const Vec3d l = shading.to_local(v);
          return k.polygon_direction({l.x, l.y, std::max(l.z, 0.0)});
        };
        const auto a = direction(w.a), b = direction(w.b);
        irradiance = irradiance + k.polygon_edge(a, b);
        walk = k.polygon_add_edge(walk, k.ltc_direction(m, a), k.ltc_direction(m, b));
        e = e + k.conic_vector(k.ggx_edge(ggx_view, a, b));
      }
      const std::array<double, 3> pieces = {irradiance.z.v / std::numbers::pi,
                                            k.polygon_irradiance(walk, Mask<double>(false)).v / std::numbers::pi,
                                            k.ggx_unshadowed(ggx_view, e).v};
      // Cells of 2^-22 of the light's half side move edges by half of that; lobes weigh some positions more than others. The bound is the
      // goal for single points, 2e-4 of the unoccluded value.
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(pieces[i], expected[i], 2e-4 * whole[i]) << "density " << i << ", " << point.kind << ", " << tries;
    }
  }
}

// The example of docs/shadows.md: a closed box in front of a light, counted by hand.
TEST(SoftShadow, SilhouettesOfClosedMeshesWeighTwo) {
  families::Triangles t;
  t.box({-0.1, 0.9, -0.1}, {0.1, 1.1, 0.1});
  const Stage stage(families::Family{"box", t, families::ceiling_light(2.0, 0.5)});
  const Viewpoint at{{0.02, 0, 0.01}, {0, 1, 0}, {}};
  Scratch scratch;
  stage.exact[0].see(at, scratch.set);
  EXPECT_EQ(scratch.set.occluders, 4u);  // the bottom's edges: everything above is hidden behind it
  for (const Segment& s : scratch.set.segments) EXPECT_EQ(std::abs(s.weight), s.source == Source::edge ? 2 : kHidden);
  VisibleRegion region;
  find_visible(stage.frames[0], at.position, stage.rays, scratch, region);
  EXPECT_EQ(region.level, 0);
  EXPECT_EQ(region.rays, 1);

  // The bottom, 0.9 of 2 high: it covers 0.2 x 2 / 0.9 of the light in both directions.
  const double light = 1.0 * 0.8, box = 4 * stage.frames[0].box_x * stage.frames[0].box_y;

  const double shade = 0.2 * 2 / 0.9 * 0.2 * 2 / 0.9;
  EXPECT_NEAR(area_of(region) * box, light - shade, 1e-6);
}

// The edges that a group gathers give each of its points the segments that all edges give.
TEST(SoftShadow, GroupsGatherWhatTheirPointsSee) {
  std::size_t gathered = 0, all_edges = 0, groups = 0;
  for (const families::Family& family : families::all()) {
    if (family.name.starts_with("fine sphere")) continue;  // all its edges for each point take too long
    SCOPED_TRACE(family.name);
    const Stage stage(family);
    const EdgeTree tree(stage.mesh);
    families::Random random(3, 17);
    SegmentSet by_all, by_group;
    for (int g = 0; g < 6; ++g) {
      const families::Point first = families::random_point(family, stage.mesh, stage.light, random);
      const std::size_t side = stage.side_of(first.at);
      const LightFrame& frame = stage.frames[side];
      const Frame surface = Frame::from_normal(first.at.normal);
      std::vector<Viewpoint> points;
      std::vector<Vec3d> positions;
      for (int i = 0; i < 16; ++i) {
        Viewpoint at = first.at;
        at.position += surface.x * random.uniform(-0.05, 0.05) + surface.y * random.uniform(-0.05, 0.05);
        if (!(frame.to_local(at.position).z < -1e-3)) continue;
        points.push_back(at);
        positions.push_back(at.position);
      }
      if (points.empty()) continue;
      const Shaft shaft(frame, positions);
      std::vector<std::uint32_t> edges, crossing;
      tree.gather(packs(), shaft, edges);
      for (const std::uint32_t t : crossing_triangles(stage.mesh, frame))
        if (shaft.needs_triangle(stage.mesh, t)) crossing.push_back(t);
      LocalEdges<double> local;
      local.assign(stage.mesh, frame, edges, crossing);
      gathered += edges.size();
      all_edges += stage.mesh.edges.size();
      ++groups;
      for (const Viewpoint& at : points) {
        stage.exact[side].see(at, by_all);
        local.see(at, by_group);
        ASSERT_EQ(by_all.segments.size(), by_group.segments.size());
        EXPECT_EQ(by_all.events.size(), by_group.events.size());
        for (std::size_t i = 0; i < by_all.segments.size(); ++i) {
          const Segment &a = by_all.segments[i], &b = by_group.segments[i];
          EXPECT_TRUE(a.a.id == b.a.id && a.b.id == b.b.id && a.weight == b.weight && a.a.x == b.a.x && a.a.y == b.a.y && a.b.x == b.b.x &&
                      a.b.y == b.b.y);
        }
      }
    }
  }
  EXPECT_LT(gathered, all_edges / 4) << groups;  // or gathering would be for nothing
}

// Whole numbers decide, so packs and scalars cut every segment to the same pieces, bit for bit.
TEST(SoftShadow, PacksArrangeTheSamePieces) {
  std::size_t pieces = 0;
  for (const families::Family& family : families::all()) {
    SCOPED_TRACE(family.name);
    const Stage stage(family);
    families::Random random(4, 17);
    SegmentSet set;
    SegmentArrays arrays;
    std::vector<Piece> by_scalars, by_packs;
    for (int i = 0; i < 20; ++i) {
      const Viewpoint at = families::random_point(family, stage.mesh, stage.light, random).at;
      stage.exact[stage.side_of(at)].see(at, set);
      arrange(set, by_scalars);
      arrange(packs(), set, arrays, by_packs);
      ASSERT_EQ(by_scalars.size(), by_packs.size());
      for (std::size_t k = 0; k < by_scalars.size(); ++k) {
        const Piece &a = by_scalars[k], &b = by_packs[k];
        ASSERT_TRUE(a.ax == b.ax && a.ay == b.ay && a.bx == b.bx && a.by == b.by && a.left == b.left && a.right == b.right &&
                    a.segment == b.segment)
            << "piece " << k << " of point " << i;
      }
      pieces += by_packs.size();
    }
  }
  EXPECT_GT(pieces, 10000u);  // or there was nothing to compare
}

// Packs project in float, from the edges that a group gathered. The reference is all edges in double, as for positions in float above.
TEST(SoftShadow, PacksSeeWhatDoublesSee) {
  for (const families::Family& family : families::all()) {
    SCOPED_TRACE(family.name);
    const Stage stage(family);
    const EdgeTree tree(stage.mesh);
    families::Random random(5, 17);
    Scratch exact, on_packs;
    VisibleRegion in_exact, in_packs, in_turned;
    double squares = 0;
    constexpr int kPoints = 40;
    for (int i = 0; i < kPoints; ++i) {
      const Viewpoint at = families::random_point(family, stage.mesh, stage.light, random).at;
      const std::size_t side = stage.side_of(at);
      const LightFrame& frame = stage.frames[side];
      stage.exact[side].see(at, exact.set);
      find_visible(frame, at.position, stage.rays, exact, in_exact);

      const Shaft around(frame, {at.position + Vec3d{0.1, 0, 0}, at.position, at.position + Vec3d{0, 0, 0.1}}), shaft(frame, {at.position});
      std::vector<std::uint32_t> edges, crossing;
      tree.gather(packs(), around, edges);
      for (const std::uint32_t t : crossing_triangles(stage.mesh, frame))
        if (around.needs_triangle(stage.mesh, t)) crossing.push_back(t);
      EdgeArrays tile, group;
      const std::vector<Segment> outline = outline_segments(frame);
      const auto region_of = [&](const LightFrame& base, bool turned, VisibleRegion& region) {
        tile.assign(stage.mesh, base, edges, crossing);
        group.assign_needed(packs(), stage.mesh, tile, base, shaft);
        if (turned)
          group.see_turned(packs(), base, frame, at, outline, on_packs.set);
        else
          group.see(packs(), frame, at, outline, on_packs.set);
        if (on_packs.set.occluders == 0) add_surroundings(frame, at, outline, on_packs.set);
        find_visible_on_packs(packs(), frame, at.position, stage.rays, on_packs, region);
        // Counts that chains hand on must equal those that left rays find.
        std::vector<Piece> by_scalars;
        arrange(on_packs.set, by_scalars);
        EXPECT_TRUE(std::equal(by_scalars.begin(), by_scalars.end(), on_packs.pieces.begin(), on_packs.pieces.end(),
                               [](const Piece& a, const Piece& b) {
                                 return a.ax == b.ax && a.by == b.by && a.left == b.left && a.right == b.right && a.segment == b.segment;
                               }))
            << i;
        return area_of(region);
      };
      const double change = region_of(frame, false, in_packs) - area_of(in_exact);
      EXPECT_LE(std::fabs(change), 1e-4) << i;
      squares += change * change;
      double x = 0, y = 0;
      for (const Boundary& b : in_packs.boundary) {
        x += (b.bx - b.ax) / kCells;
        y += (b.by - b.ay) / kCells;
      }
      EXPECT_LE(std::hypot(x, y), 1e-12) << i;
      // The same in the coordinates of another frame.
      LightFrame other;
      other.origin = frame.origin + frame.axes.x * 0.1;
      other.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      EXPECT_LE(std::fabs(region_of(other, true, in_turned) - area_of(in_exact)), 1e-4) << i;
    }
    EXPECT_LE(std::sqrt(squares / kPoints), 5e-7);
  }
}

// Sixteen points at once see what each of them sees by itself.
TEST(SoftShadow, LanesSeeWhatPointsSee) {
  std::size_t lanes_found = 0, lanes_asked = 0, with_sections_found = 0, with_sections_asked = 0, thin_lanes = 0;
  for (const families::Family& family : families::all()) {
    SCOPED_TRACE(family.name);
    const Stage stage(family);
    const EdgeTree tree(stage.mesh);
    families::Random random(6, 17);
    Scratch exact;
    VisibleRegion in_exact;
    PointLanes lanes;
    double squares = 0;
    int compared = 0;
    for (int g = 0; g < 8; ++g) {
      const families::Point first = families::random_point(family, stage.mesh, stage.light, random);
      const std::size_t side = stage.side_of(first.at);
      const LightFrame& frame = stage.frames[side];
      const Frame surface = Frame::from_normal(first.at.normal);
      std::vector<Viewpoint> points;
      std::vector<Vec3d> positions;
      for (std::size_t i = 0; i < kPoints; ++i) {
        Viewpoint at = first.at;
        if (i > 0) at.position += surface.x * random.uniform(-0.02, 0.02) + surface.y * random.uniform(-0.02, 0.02);
        if (!(frame.to_local(at.position).z < -1e-3)) continue;
        points.push_back(at);
        positions.push_back(at.position);
      }
      if (points.empty()) continue;
      const Shaft shaft(frame, positions);
      std::vector<std::uint32_t> edges;
      tree.gather(packs(), shaft, edges);
      std::vector<std::uint32_t> crossing;
      for (const std::uint32_t t : crossing_triangles(stage.mesh, frame))
        if (shaft.needs_triangle(stage.mesh, t)) crossing.push_back(t);
      LocalEdges<double> local;
      local.assign(stage.mesh, frame, edges, crossing);
      const std::vector<Segment> outline = outline_segments(frame);
      LightFrame other;
      other.origin = frame.origin + frame.axes.x * 0.1;
      other.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (const bool turned : {false, true}) {
        const LightFrame& base = turned ? other : frame;
        EdgeArrays arrays;
        arrays.assign(stage.mesh, base, edges, crossing);
        std::vector<PointLanes::Point> asked;
        for (const Viewpoint& at : points) asked.push_back({&frame, &at, &outline, true});
        lanes.find(lane_table_for(active_simd()), arrays, base, turned, asked);
        for (std::size_t k = 0; k < points.size(); ++k) {
          const Viewpoint& at = points[k];
          local.see(at, exact.set);
          find_visible(frame, at.position, stage.rays, exact, in_exact);
          ++(crossing.empty() ? lanes_asked : with_sections_asked);
          const bool thin = (lanes.thin() >> k & 1) != 0;
          thin_lanes += thin;
          if (lanes.none() >> k & 1) {
            EXPECT_TRUE(in_exact.boundary.empty() || thin) << first.kind << " " << g << " " << k;
            ++(crossing.empty() ? lanes_found : with_sections_found);
            continue;
          }
          if ((lanes.found() >> k & 1) == 0) continue;  // falls back to its own search
          ++(crossing.empty() ? lanes_found : with_sections_found);
          const double height = -frame.to_local(at.position).z;
          const Vec3d to = lanes.place(k) - at.position;
          const bool free = !stage.rays.between(at.position, at.position + to * ((height - frame.eta) / height));
          double area = 0, x = 0, y = 0;
          int edge_count = 0;
          if (free)
            lanes.each_edge(k, [&](double ax, double ay, double bx, double by) {
              area += 0.5 * (ax * by - ay * bx);
              x += (bx - ax) / frame.box_x;
              y += (by - ay) / frame.box_y;
              ++edge_count;
            });
          // Ends of pieces are floats in units of a half side.
          EXPECT_LE(std::hypot(x, y), 2.4e-7 * edge_count) << first.kind << " " << g << " " << k;
          const double change = area / (4 * frame.box_x * frame.box_y) - area_of(in_exact);
          EXPECT_LE(std::fabs(change), 1e-4) << first.kind << " " << g << " " << k << (turned ? " turned" : "");
          squares += change * change;
          ++compared;
        }
      }
    }
    // The bound is that for positions in float; one point above the goal's mean counts among few.
    EXPECT_LE(std::sqrt(squares / std::max(compared, 1)), 1e-6) << compared;
  }
  EXPECT_GT(lanes_found, lanes_asked * 99 / 100) << lanes_found << " of " << lanes_asked;
  EXPECT_GT(with_sections_found, with_sections_asked * 99 / 100) << with_sections_found << " of " << with_sections_asked;
  EXPECT_GT(with_sections_asked, 400u);
  EXPECT_GT(thin_lanes, 10u);  // or no lane passed over a level
}

// A vertex lies inside by less than a rounding. Its edge must stay, with the event of the side that cut it. Otherwise counts to its left
// would be off by its weight (a black pixel).
TEST(SoftShadow, KeepsAnEdgeThatEndsARoundingInside) {
  Kernels<float> k;
  const float inside = std::nextafter(-1.0f, 0.0f);
  for (const bool out_first : {true, false}) {
    const Kernels<float>::vec3 out(-1000.0, 0.0, 1.0), in(static_cast<double>(inside), 0.25, 1.0);
    const auto s = out_first ? k.shadow_clip(out, in, {1.0, 1.0}) : k.shadow_clip(in, out, {1.0, 1.0});
    EXPECT_TRUE(s.inside.m);
    EXPECT_EQ((out_first ? s.sides.x : s.sides.y).v, 1.0f);
  }
}

// Strange input: finite answers in bounded time.
TEST(SoftShadow, StandsDegenerateTriangles) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3d> positions = {{0, 1, 0}, {kNan, 1, 0}, {0.2, 1, 0.2}, {0.1, 1, 0.1}, {0.3, 1, 0}, {0, 1, 0}, {1e30, 1, 1e30}};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3, 0, 5, 4, 0, 2, 4, 0, 2, 6};
  const EdgeMesh mesh = build_edges(positions, indices);
  EXPECT_EQ(mesh.triangles.size(), 3u);  // not the one with NaN, not the one with equal corners
  const Occluders occluders(mesh);
  const PreparedPolygon light = prepare_polygon(families::ceiling_light());
  for (const Vec3d p : {Vec3d{0, 0, 0}, Vec3d{0.1, 1, 0.1}, Vec3d{0, 1, 0}, Vec3d{0, 2.5, 0}, Vec3d{0.1, 2.5 - 1e-9, 0}, Vec3d{0, 3, 0}}) {
    const PreparedPolygon part = visible_part(light, occluders, {p, {0, 1, 0}, {}}, 1e-9);
    for (const Vec3d& v : part.vertices) EXPECT_TRUE(is_finite(v)) << p.y;
  }
}

TEST(SoftShadow, SeesNothingOfALightWithoutWidth) {
  PolygonLight line;
  line.vertices = {{0, 2, 0}, {1, 2, 0}, {2, 2, 0}};
  EXPECT_TRUE(visible_part(prepare_polygon(line), Occluders(EdgeMesh{}), {{0, 0, 0}, {0, 1, 0}, {}}, 1e-9).vertices.empty());
}

// A polygon that represents a ball turns only as the point moves. When roundings turned it, it took 1e-3 of the light more or less from
// pixel to pixel, a tenth of a sliver at the horizon.
TEST(SoftShadow, BallsHaveNeighboursCorners) {
  reference::Random random(7);
  const auto vector = [&] { return Vec3d{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5}; };
  for (int i = 0; i < 1000; ++i) {
    const double out = 1 + 2e-7 * (i % 3);  // as in files, in float
    const Ellipsoid ball{vector(), {0, 0.3, 0}, {0, 0, 0.3 * out}, {0.3, 0, 0}};
    const Vec3d far = normalized(vector()) * (0.4 + 3 * random.uniform());
    if (std::fabs(far.z) < 1e-3 || std::fabs(far.x) < 1e-3 || std::fabs(far.y) < 1e-3) continue;  // the frame's x changes here
    const auto here = frame_of_ellipsoid(ball, ball.center + far, 24),
               beside = frame_of_ellipsoid(ball, ball.center + far * (1 + 1e-7) + vector() * 1e-7, 24);
    ASSERT_TRUE(here && beside);
    EXPECT_GT(dot(here->axes.x, beside->axes.x), 1 - 1e-8) << far.x << ' ' << far.y << ' ' << far.z;
    EXPECT_NEAR(here->half_x, here->half_y, 1e-6);
  }
}

// Edges of any number of triangles, welded over equal positions.
TEST(EdgeMesh, WeldsEqualPositionsOnly) {
  families::Triangles t;
  t.box({0, 0, 0}, {1, 1, 1});
  const EdgeMesh mesh = build_edges(t.positions, t.indices);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.edges.size(), 18u);
  for (const MeshEdge& e : mesh.edges) {
    ASSERT_EQ(e.count, 2u);
    EXPECT_EQ(mesh.edge_triangles[e.first].walks + mesh.edge_triangles[e.first + 1].walks, 0);
  }
}

}  // namespace
}  // namespace steradian::shadow::shadow_test
