#include "solve/tile_slopes.h"

#include "render/direct/vertex_slopes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using K = PackKernels;

// The numbers of one motion at a pack of points.
struct Slope {
  PackReal diffuse{0.0}, plain{0.0}, fresnel{0.0};
};

__attribute__((flatten)) void find(const SurfaceTile& tile, const PackLight& light, const std::vector<solving::VertexMotion>& motions,
                                   TileVector* slopes) {
  const Points points = points_of(tile);
  std::vector<Slope> sums(motions.size());
  for (std::size_t i = 0; i < kTilePixels; i += kLanes) {
    const PackVec3 albedo = load(arrays_of(tile.albedo), i), f0 = load(arrays_of(tile.f0), i), f90 = load(arrays_of(tile.f90), i);
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    SeenLight seen(light, p, i);
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
    seen.lit = seen.lit && view.z > PackReal(0.0);
    const slopes::PolygonHere here(seen, frame, p);
    std::fill(sums.begin(), sums.end(), Slope());
    const auto add = [&](std::size_t vertex, const PackVec3& by_vertex, PackReal Slope::*member) {
      const PackVec3 world = transform(frame, by_vertex);
      for (std::size_t m = 0; m < motions.size(); ++m) sums[m].*member += dot(world, broadcast(motions[m][vertex]));
    };
    PackReal below(1.0);  // fraction of the irradiance that a boundary lets through
    if (any_lane(albedo.x + albedo.y + albedo.z > PackReal(0.0))) {
      const PackVec3 e =
          slopes::walk_irradiance(here, seen.reversed, [&](std::size_t vertex, const PackVec3& d) { add(vertex, d, &Slope::diffuse); });
      const PackReal loss = load(tile.fresnel_loss.data() + i);
      if (any_lane(loss > PackReal(0.0))) below = PackReal(1.0) - loss * k.lambert_grazing_of_light(e, view);
    }
    if (any_lane(f90.x + f90.y + f90.z + f0.x + f0.y + f0.z > PackReal(0.0))) {
      const auto ggx = k.ggx_view(view, load(tile.alpha_x.data() + i), load(tile.alpha_y.data() + i));
      slopes::walk_ggx_slopes(
          here, ggx, PackReal(1.0), [&](const K::EdgePart& part) { return k.ggx_edge(ggx, part.start, part.end); },
          [&](std::size_t vertex, const slopes::FrameSlopes& d) {
            add(vertex, d.plain, &Slope::plain);
            add(vertex, d.fresnel, &Slope::fresnel);
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
