#include "render/cpu/plain_surface.h"

#include <array>

#include "core/pack.h"

STERADIAN_BEGIN_ISA
namespace {

constexpr std::size_t kBlock = 16;

// What blends the corners of each lane's triangle.
struct Corners {
  alignas(64) std::array<std::uint32_t, kLanes> i0, i1, i2;
  alignas(64) std::array<float, kLanes> w0, u, v;

  Corners(const Mesh& mesh, const TileHits& hits, std::size_t slot, std::uint32_t slots) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const bool here = (slots >> k & 1) != 0;  // other lanes take the first triangle: what they give is not kept
      const std::uint32_t* corner = &mesh.indices[here ? 3 * std::size_t{hits.triangle[slot + k]} : 0];
      i0[k] = corner[0];
      i1[k] = corner[1];
      i2[k] = corner[2];
      u[k] = here ? hits.u[slot + k] : 0;
      v[k] = here ? hits.v[slot + k] : 0;
      w0[k] = 1.0f - u[k] - v[k];
    }
  }
  // A function of its own, on numbers: the compiler makes more of it than of gathers.
  PackVec3 operator()(const std::vector<Vec3f>& values) const {
    alignas(64) std::array<float, kLanes> x, y, z;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec3f &a = values[i0[k]], &b = values[i1[k]], &c = values[i2[k]];
      x[k] = a.x * w0[k] + b.x * u[k] + c.x * v[k];
      y[k] = a.y * w0[k] + b.y * u[k] + c.y * v[k];
      z[k] = a.z * w0[k] + b.z * u[k] + c.z * v[k];
    }
    return {load(x.data()), load(y.data()), load(z.data())};
  }
  PackVec3 edges_product(const std::vector<Vec3f>& positions) const {
    alignas(64) std::array<float, kLanes> x, y, z;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec3f &p = positions[i0[k]], n = cross(positions[i1[k]] - p, positions[i2[k]] - p);
      x[k] = n.x;
      y[k] = n.y;
      z[k] = n.z;
    }
    return {load(x.data()), load(y.data()), load(z.data())};
  }
};

using Mask = PackKernels::mask;

// Writes the lanes that are kept.
struct Writer {
  std::size_t slot;
  Mask kept;
  bool all;

  STERADIAN_INLINE void operator()(TilePlane& plane, PackReal value) const {
    float* at = plane.data() + slot;
    store(at, all ? value : select(kept, value, load(at)));
  }
  STERADIAN_INLINE void operator()(TileVector& v, const PackVec3& value) const {
    (*this)(v.x, value.x);
    (*this)(v.y, value.y);
    (*this)(v.z, value.z);
  }
  STERADIAN_INLINE void operator()(TilePlane& plane, float value) const { (*this)(plane, broadcast(value)); }
  STERADIAN_INLINE void operator()(TileVector& v, Vec3f value) const { (*this)(v, broadcast(value)); }
};

// surface_at's turned_to.
STERADIAN_INLINE PackVec3 turned_to(const PackVec3& n, const PackVec3& view, const PackReal& facing) {
  const PackReal least = min(PackReal(0.01), PackReal(0.5) * facing), c = dot(n, view);
  const Mask above = !(c < least);
  if (!any_lane(!above)) return n;
  const PackVec3 turned = n + view * (least - c);
  return select(above, n, turned * inversesqrt(max(dot(turned, turned), PackReal(1e-30))));
}

__attribute__((flatten)) std::uint32_t fill_pack(const Mesh& mesh, const Surface& like, const TileHits& hits, std::size_t slot,
                                                 std::uint32_t slots, SurfaceTile& tile) {
  const Corners at(mesh, hits, slot, slots);
  const PackVec3 edges = at.edges_product(mesh.positions), blend = at(mesh.normals);
  const PackReal edges2 = dot(edges, edges), blend2 = dot(blend, blend), low(1e-30), high(1e30);
  const Mask usual = edges2 > low && edges2 < high && blend2 > low && blend2 < high;

  alignas(64) std::array<float, kLanes> here;
  store(here.data(), select(usual, PackReal(1.0), PackReal(0.0)));
  std::uint32_t kept = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    kept |= static_cast<std::uint32_t>((slots >> k & 1) != 0 && here[k] > 0) << k;
    here[k] = (kept >> k & 1) != 0 ? 1.0f : 0.0f;
  }
  if (kept == 0) return 0;
  const Writer write = {slot, load(here.data()) > PackReal(0.5), kept == (std::uint32_t{1} << kLanes) - 1};

  const PackVec3 view(-load(hits.direction.x.data() + slot), -load(hits.direction.y.data() + slot), -load(hits.direction.z.data() + slot));
  const PackVec3 geometric = edges * inversesqrt(edges2);
  const PackReal towards = dot(geometric, view), side = select(towards < PackReal(0.0), PackReal(-1.0), PackReal(1.0));
  const PackVec3 normal = turned_to(blend * (inversesqrt(blend2) * side), view, abs(towards));

  write(tile.position, at(mesh.positions));
  write(tile.normal, normal);
  write(tile.geometric_normal, geometric * side);
  write(tile.view, view);
  write(tile.tangent, PackKernels().frame_from_normal(normal).c0);
  write(tile.albedo, like.albedo);
  write(tile.fresnel_loss, like.fresnel_loss);
  write(tile.f0, like.f0);
  write(tile.f90, like.f90);
  write(tile.alpha_x, like.alpha_x);
  write(tile.alpha_y, like.alpha_y);
  write(tile.coat, 0.0f);
  write(tile.coat_alpha, 1.0f);
  write(tile.coat_normal, normal);
  write(tile.sheen, Vec3f{});
  write(tile.sheen_alpha, 1.0f);
  write(tile.passes, like.passes);
  write(tile.radiance, like.emission);
  for (std::size_t k = 0; k < kLanes; ++k)
    if ((kept >> k & 1) != 0) tile.material[slot + k] = like.material;
  return kept;
}

std::uint32_t fill(const Mesh& mesh, const Surface& like, const TileHits& hits, std::size_t first, std::uint32_t slots, SurfaceTile& tile) {
  std::uint32_t filled = 0;
  constexpr std::uint32_t kAll = (std::uint32_t{1} << kLanes) - 1;
  for (std::size_t k = 0; k < kBlock; k += kLanes) {
    const std::uint32_t here = slots >> k & kAll;
    if (here != 0) filled |= fill_pack(mesh, like, hits, first + k, here, tile) << k;
  }
  return filled;
}

}  // namespace

const PlainSurfaceTable& plain_surface_table() {
  static constexpr PlainSurfaceTable table = {fill};
  return table;
}

STERADIAN_END_ISA
