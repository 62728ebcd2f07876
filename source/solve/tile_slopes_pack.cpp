#include "solve/tile_slopes.h"

#include <array>

#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;
constexpr int kNodes = 4;  // of an edge of GGX: within 3e-4 of the largest derivative

// The numbers of one motion at a pack of points.
struct Slope {
  PackReal diffuse{0.0}, plain{0.0}, fresnel{0.0};
};

// Sums over the edges, and the irradiance vector of the same walk.
struct EdgeSums {
  K k;
  const packed::FloatPolygon& polygon;
  const K::mat3& frame;
  const PackVec3& p;
  PackReal facing;

  // add(i, j, n, scale_i, scale_j, a, b): edge from vertex i to j, whose directions in the frame are a and b; scale: side over distance.
  template <class Add>
  STERADIAN_INLINE void walk(Add add) const {
    for (std::size_t c = 0; c + 1 < polygon.contours.size(); ++c) {
      const std::size_t first = polygon.contours[c], last = polygon.contours[c + 1];
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t j = i + 1 < last ? i + 1 : first;
        const PackVec3 a = broadcast(polygon.vertices[i]) - p, b = broadcast(polygon.vertices[j]) - p;
        const PackReal ia = inversesqrt(max(dot(a, a), 1.0e-36)), ib = inversesqrt(max(dot(b, b), 1.0e-36));
        add(i, j, facing * ia, facing * ib, transform_transposed(frame, a * ia), transform_transposed(frame, b * ib));
      }
    }
  }
};

__attribute__((flatten)) void find(const SurfaceTile& tile, const PackLight& light, const std::vector<solving::VertexMotion>& motions,
                                   TileVector* slopes) {
  const auto& polygon = *std::get_if<packed::FloatPolygon>(&light.shape);
  const Points points = points_of(tile);
  std::vector<Slope> sums(motions.size());
  for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
    const PackVec3 albedo = load(arrays_of(tile.albedo), i), f0 = load(arrays_of(tile.f0), i), f90 = load(arrays_of(tile.f90), i);
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const SeenLight seen(light, p, i);
    const auto zero = [&](TileVector& t) {
      for (TilePlane* plane : {&t.x, &t.y, &t.z}) store(plane->data() + i, PackReal(0.0));
    };
    if (!any_lane(seen.lit && dot(n, v) > PackReal(0.0))) {
      for (std::size_t m = 0; m < motions.size(); ++m) zero(slopes[m]);
      continue;
    }
    K k;
    const auto frame = k.frame_from_normal_and_view(n, load(points.tangent, i));
    const PackVec3 view = transform_transposed(frame, v);
    const PackReal lit = select(seen.lit && view.z > PackReal(0.0), PackReal(1.0), PackReal(0.0));
    const EdgeSums edges{k, polygon, frame, p, lit * select(seen.reversed, PackReal(-1.0), PackReal(1.0))};
    std::fill(sums.begin(), sums.end(), Slope());
    const auto add = [&](std::size_t a, std::size_t b, PackVec3 normal, PackReal at_a, PackReal at_b, PackReal Slope::*member) {
      const PackVec3 world = transform(frame, normal);
      for (std::size_t m = 0; m < motions.size(); ++m)
        sums[m].*member += dot(world, broadcast(motions[m][a])) * at_a + dot(world, broadcast(motions[m][b])) * at_b;
    };
    PackReal below(1.0);  // fraction of the irradiance that a boundary lets through
    if (any_lane(albedo.x + albedo.y + albedo.z > PackReal(0.0))) {
      auto walk = k.polygon_begin();
      edges.walk([&](std::size_t a, std::size_t b, PackReal scale_a, PackReal scale_b, const PackVec3& from, const PackVec3& to) {
        walk = k.polygon_add_edge(walk, from, to);
        const auto s = k.polygon_edge_slopes(from, to);
        add(a, b, s.normal, s.by_start * scale_a, s.by_end * scale_b, &Slope::diffuse);
      });
      const PackReal loss = load(tile.fresnel_loss.data() + i);
      if (any_lane(loss > PackReal(0.0)))
        below = PackReal(1.0) - loss * k.lambert_grazing_of_light(k.polygon_irradiance_vector(walk, seen.reversed), view);
    }
    if (any_lane(f90.x + f90.y + f90.z + f0.x + f0.y + f0.z > PackReal(0.0))) {
      const auto ggx = k.ggx_view(view, load(tile.alpha_x.data() + i), load(tile.alpha_y.data() + i));
      edges.walk([&](std::size_t a, std::size_t b, PackReal scale_a, PackReal scale_b, const PackVec3& from, const PackVec3& to) {
        const auto s = k.ggx_edge_slopes(ggx, from, to, PackReal(1.0), kNodes, 1);
        add(a, b, s.normal, s.by_start.x * scale_a, s.by_end.x * scale_b, &Slope::plain);
        add(a, b, s.normal, s.by_start.y * scale_a, s.by_end.y * scale_b, &Slope::fresnel);
      });
    }
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const Slope& s = sums[m];
      const PackReal diffuse = k.lambert_radiance(s.diffuse * below), plain = s.plain - s.fresnel;
      store(slopes[m].x.data() + i, albedo.x * diffuse + f0.x * plain + f90.x * s.fresnel);
      store(slopes[m].y.data() + i, albedo.y * diffuse + f0.y * plain + f90.y * s.fresnel);
      store(slopes[m].z.data() + i, albedo.z * diffuse + f0.z * plain + f90.z * s.fresnel);
    }
  }
}

}  // namespace

const TileSlopes& tile_slopes() {
  static constexpr TileSlopes table = {find};
  return table;
}

STERADIAN_END_ISA
