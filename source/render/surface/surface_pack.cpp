#include "render/surface/surface_pack.h"

#include <array>

#include "core/pack.h"
#include "render/surface/texture_pack.h"

STERADIAN_BEGIN_ISA
namespace {

constexpr std::size_t kBlock = 16;

// Interpolates the corners of each lane's triangle.
struct Corners {
  alignas(64) std::array<std::uint32_t, kLanes> i0, i1, i2;
  alignas(64) std::array<float, kLanes> w0, u, v;

  Corners(const Mesh& mesh, const TileHits& hits, std::size_t slot, std::uint32_t slots) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const bool here = (slots >> k & 1) != 0;  // other lanes use the first triangle; their results are discarded
      const std::uint32_t* corner = &mesh.indices[here ? 3 * std::size_t{hits.triangle[slot + k]} : 0];
      i0[k] = corner[0];
      i1[k] = corner[1];
      i2[k] = corner[2];
      u[k] = here ? hits.u[slot + k] : 0;
      v[k] = here ? hits.v[slot + k] : 0;
      w0[k] = 1.0f - u[k] - v[k];
    }
  }
  // This is a function of its own, on numbers: the compiler optimizes it better than gathers.
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
  PackColor operator()(const std::vector<Vec4f>& values) const {
    alignas(64) std::array<float, kLanes> x, y, z, w;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec4f &a = values[i0[k]], &b = values[i1[k]], &c = values[i2[k]];
      x[k] = a.x * w0[k] + b.x * u[k] + c.x * v[k];
      y[k] = a.y * w0[k] + b.y * u[k] + c.y * v[k];
      z[k] = a.z * w0[k] + b.z * u[k] + c.z * v[k];
      w[k] = a.w * w0[k] + b.w * u[k] + c.w * v[k];
    }
    return {{load(x.data()), load(y.data()), load(z.data())}, load(w.data())};
  }
  // Edge from the first corner to another one.
  PackVec3 edge(const std::vector<Vec3f>& positions, const std::array<std::uint32_t, kLanes>& other) const {
    alignas(64) std::array<float, kLanes> x, y, z;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec3f e = positions[other[k]] - positions[i0[k]];
      x[k] = e.x;
      y[k] = e.y;
      z[k] = e.z;
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
using Weights = PackKernels::SurfaceWeights;

// Writes the lanes in `kept`.
struct LaneWriter {
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

// Hits of the lanes' rays on the mesh.
struct Hits {
  Corners at;
  std::uint32_t kept = 0;     // lanes with a normal whose square is in the range of float
  PackVec3 edges, view;       // edges: normal of the triangle, as long as twice its area
  PackVec3 geometric, blend;  // unit normals of the front face: the triangle's, and the interpolated one
  PackReal towards, side;     // cosine between the triangle and the view; side: -1 on the back

  STERADIAN_INLINE Hits(const Mesh& mesh, const TileHits& hits, std::size_t slot, std::uint32_t slots) : at(mesh, hits, slot, slots) {
    edges = at.edges_product(mesh.positions);
    blend = at(mesh.normals);
    const PackReal edges2 = dot(edges, edges), blend2 = dot(blend, blend), low(1e-30), high(1e30);
    const Mask usual = edges2 > low && edges2 < high && blend2 > low && blend2 < high;
    alignas(64) std::array<float, kLanes> here;
    store(here.data(), select(usual, PackReal(1.0), PackReal(0.0)));
    for (std::size_t k = 0; k < kLanes; ++k) kept |= static_cast<std::uint32_t>((slots >> k & 1) != 0 && here[k] > 0) << k;
    view = {-load(hits.direction.x.data() + slot), -load(hits.direction.y.data() + slot), -load(hits.direction.z.data() + slot)};
    geometric = edges * inversesqrt(edges2);
    blend = blend * inversesqrt(blend2);
    towards = dot(geometric, view);
    side = select(towards < PackReal(0.0), PackReal(-1.0), PackReal(1.0));
  }
};

// Returns the lanes that it wrote.
STERADIAN_INLINE Mask write_surfaces(const Mesh& mesh, const Hits& hits, const PackVec3& normal, const PackVec3& tangent,
                                     const Weights& weights, const PackReal& alpha, const SurfaceMaterial* material, std::size_t slot,
                                     SurfaceTile& tile) {
  alignas(64) std::array<float, kLanes> here;
  for (std::size_t k = 0; k < kLanes; ++k) here[k] = (hits.kept >> k & 1) != 0 ? 1.0f : 0.0f;
  const LaneWriter write = {slot, load(here.data()) > PackReal(0.5), hits.kept == (std::uint32_t{1} << kLanes) - 1};
  write(tile.position, hits.at(mesh.positions));
  write(tile.normal, normal);
  write(tile.geometric_normal, hits.geometric * hits.side);
  write(tile.view, hits.view);
  write(tile.tangent, tangent);
  write(tile.albedo, weights.albedo);
  write(tile.fresnel_loss, weights.fresnel_loss);
  write(tile.f0, weights.f0);
  write(tile.f90, weights.f90);
  write(tile.alpha_x, alpha);
  write(tile.alpha_y, alpha);
  write(tile.coat, 0.0f);
  write(tile.coat_alpha, 1.0f);
  write(tile.coat_normal, normal);
  write(tile.sheen, Vec3f{});
  write(tile.sheen_alpha, 1.0f);
  write(tile.passes, weights.passes);
  write(tile.radiance, weights.emission);
  for (std::size_t k = 0; k < kLanes; ++k)
    if ((hits.kept >> k & 1) != 0) tile.material[slot + k] = material;
  return write.kept;
}

__attribute__((flatten)) std::uint32_t fill_plain_pack(const Mesh& mesh, const Surface& like, const TileHits& tile_hits, std::size_t slot,
                                                       std::uint32_t slots, SurfaceTile& tile) {
  const Hits hits(mesh, tile_hits, slot, slots);
  if (hits.kept == 0) return 0;
  PackKernels k;
  const PackVec3 normal = k.surface_towards(hits.blend * hits.side, hits.view, abs(hits.towards));
  Weights weights = k.surface_unlit(broadcast(like.emission));
  weights.albedo = broadcast(like.albedo);
  weights.fresnel_loss = broadcast(like.fresnel_loss);
  weights.f0 = broadcast(like.f0);
  weights.f90 = broadcast(like.f90);
  weights.passes = broadcast(like.passes);
  write_surfaces(mesh, hits, normal, k.frame_from_normal(normal).c0, weights, broadcast(like.alpha_x), like.material, slot, tile);
  return hits.kept;
}

// The textures of a block.
class Textures {
 public:
  Textures(const Mesh& mesh, const Hits& hits, const HitShading& shading, const TileHits& tile_hits, std::size_t slot)
      : mesh_(mesh), hits_(hits), maps_(*shading.maps) {
    // The same as footprint_on, lane by lane.
    const Corners& at = hits.at;
    const PackVec3 e1 = at.edge(mesh.positions, at.i1), e2 = at.edge(mesh.positions, at.i2), &n = hits.edges, direction = -hits.view;
    const PackReal facing = dot(n, direction), area2 = dot(n, n);
    const PackReal depth = load(tile_hits.distance.data() + slot) * dot(direction, broadcast(shading.steps.forward));
    const Mask parallel = !(abs(facing) > PackReal(0.0));
    const PackReal across = select(parallel, PackReal(0.0), depth / area2), over = PackReal(1.0) / select(parallel, PackReal(1.0), facing);
    const auto change = [&](Vec3f step) {
      const PackVec3 s = broadcast(step), q = (s - direction * (dot(n, s) * over)) * across;
      return PackVec2{dot(cross(q, e2), n), dot(cross(e1, q), n)};
    };
    right_ = change(shading.steps.right);
    down_ = change(shading.steps.down);
  }

  // Returns white without a texture.
  PackColor operator()(const TextureUse& use) const {
    const PackReal one(1.0);
    if (!use.present()) return {{one, one, one}, one};
    const auto& set = mesh_.texcoords[use.texcoord];
    PackLookup lookup{maps_, use, {PackReal(0.0), PackReal(0.0)}, {}, {}};
    if (set.empty()) {
      lookup.right = lookup.down = lookup.t;
      return sample_texture(lookup);
    }
    const Corners& at = hits_.at;
    alignas(64) std::array<float, kLanes> tx, ty, ux, uy, vx, vy;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Vec2f &a = set[at.i0[k]], &b = set[at.i1[k]], &c = set[at.i2[k]];
      tx[k] = a.x * at.w0[k] + b.x * at.u[k] + c.x * at.v[k];
      ty[k] = a.y * at.w0[k] + b.y * at.u[k] + c.y * at.v[k];
      ux[k] = b.x - a.x;
      uy[k] = b.y - a.y;
      vx[k] = c.x - a.x;
      vy[k] = c.y - a.y;
    }
    lookup.t = {load(tx.data()), load(ty.data())};
    const auto change = [&](const PackVec2& by) {
      return PackVec2{load(ux.data()) * by.x + load(vx.data()) * by.y, load(uy.data()) * by.x + load(vy.data()) * by.y};
    };
    lookup.right = change(right_);
    lookup.down = change(down_);
    return sample_texture(lookup);
  }

 private:
  const Mesh& mesh_;
  const Hits& hits_;
  const MipMaps& maps_;
  PackVec2 right_, down_;
};

// Tangents with their w; 0 for a mesh without them.
STERADIAN_INLINE PackKernels::vec4 tangents_of(const Mesh& mesh, const Hits& hits) {
  if (mesh.tangents.empty()) return {0.0, 0.0, 0.0, 0.0};
  const PackColor t = hits.at(mesh.tangents);
  return {t.rgb.x, t.rgb.y, t.rgb.z, t.alpha};
}

__attribute__((flatten)) std::uint32_t fill_textured_pack(const Scene& scene, const Mesh& mesh, const HitShading& shading,
                                                          const TileHits& tile_hits, std::size_t slot, std::uint32_t slots,
                                                          SurfaceTile& tile) {
  const Hits hits(mesh, tile_hits, slot, slots);
  if (hits.kept == 0) return 0;
  const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
  const Textures textures(mesh, hits, shading, tile_hits, slot);
  const PackReal zero(0.0), one(1.0);
  PackKernels k;

  // The same steps as surface_at, in its order.
  PackColor base = textures(m.base_color_texture);
  base = {k.surface_product(base.rgb, broadcast(Vec3f{m.base_color.x, m.base_color.y, m.base_color.z})),
          base.alpha * broadcast(m.base_color.w)};
  if (!mesh.colors.empty()) {
    const PackColor of_vertices = hits.at(mesh.colors);
    base = {k.surface_product(base.rgb, of_vertices.rgb), base.alpha * of_vertices.alpha};
  }
  PackVec3 emission = broadcast(Vec3f{});
  if (m.emits()) {
    const PackVec3 shines = k.surface_product(textures(m.emissive_texture).rgb, broadcast(m.emissive));
    emission = m.double_sided ? shines : select(hits.side > zero, shines, emission);
  }
  const PackVec3& n = hits.blend;
  const auto frame = k.surface_frame(n, tangents_of(mesh, hits), k.frame_from_normal(n).c0);
  PackVec3 normal = n;
  if (m.normal_texture.present()) normal = k.surface_bent_normal(frame, textures(m.normal_texture).rgb, broadcast(m.normal_texture.scale));
  normal = k.surface_towards(normal * hits.side, hits.view, abs(hits.towards));
  const PackVec3 tangent = k.surface_tangent(frame.x, normal, k.frame_from_normal(normal).c0);

  const PackVec3 rough_metal = textures(m.metallic_roughness_texture).rgb;
  const PackReal metallic = clamp(broadcast(m.metallic) * rough_metal.z, zero, one);
  const PackReal alpha = k.surface_alpha(broadcast(m.roughness) * rough_metal.y);
  const float r = (m.ior - 1) / (m.ior + 1);
  const auto dielectric =
      k.surface_dielectric(broadcast(m.specular) * textures(m.specular_texture).alpha,
                           k.surface_product(broadcast(m.specular_color), textures(m.specular_color_texture).rgb), broadcast(r * r));
  Weights weights = k.surface_weights(emission, base.rgb, metallic, dielectric);
  if (!m.specular_override.empty()) {
    weights.f0 = weights.f90 = broadcast(Vec3f{});
    weights.fresnel_loss = zero;
  } else if (m.alpha_mode == AlphaMode::blend) {
    weights = k.surface_covering(weights, clamp(base.alpha, zero, one));
  }
  const Mask kept = write_surfaces(mesh, hits, normal, tangent, weights, alpha, &m, slot, tile);
  const auto weighs = [&](const PackVec3& c) { return any_lane(kept && max(c.x, max(c.y, c.z)) > zero); };
  tile.any_surface = true;
  tile.any_passing |= weighs(weights.passes);
  tile.any_diffuse |= weighs(weights.albedo);
  tile.any_specular |= weighs(weights.f0) || weighs(weights.f90);
  tile.any_override |= !m.specular_override.empty();
  return hits.kept;
}

// fill(slot, slots): fills the slots of a pack.
template <class Fill>
std::uint32_t by_packs(std::size_t first, std::uint32_t slots, Fill fill) {
  std::uint32_t filled = 0;
  constexpr std::uint32_t kAll = (std::uint32_t{1} << kLanes) - 1;
  for (std::size_t k = 0; k < kBlock; k += kLanes) {
    const std::uint32_t here = slots >> k & kAll;
    if (here != 0) filled |= fill(first + k, here) << k;
  }
  return filled;
}

std::uint32_t fill_plain(const Mesh& mesh, const Surface& like, const TileHits& hits, std::size_t first, std::uint32_t slots,
                         SurfaceTile& tile) {
  return by_packs(first, slots, [&](std::size_t slot, std::uint32_t here) { return fill_plain_pack(mesh, like, hits, slot, here, tile); });
}

std::uint32_t fill_textured(const Scene& scene, const Mesh& mesh, const HitShading& shading, const TileHits& hits, std::size_t first,
                            std::uint32_t slots, SurfaceTile& tile) {
  return by_packs(first, slots,
                  [&](std::size_t slot, std::uint32_t here) { return fill_textured_pack(scene, mesh, shading, hits, slot, here, tile); });
}

}  // namespace

const SurfacePacks& surface_packs() {
  static constexpr SurfacePacks table = {fill_plain, fill_textured};
  return table;
}

STERADIAN_END_ISA
