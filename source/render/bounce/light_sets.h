// Light sets: virtual lights distributed among the pixels of a pattern, each with a random range.
#pragma once

#include <cstdint>
#include <vector>

#include "render/bounce/virtual_lights.h"
#include "steradian/indirect.h"

namespace steradian::indirect {

// Data of a virtual light that a pair reads. A surface with two lobes makes two lights. `bright` is the light's weight in its set times
// flux times albedo / pi, or times rho_f and the lobe's scale. reach = threshold / largest bright.
struct DiffuseLight {
  Vec3f position;
  Vec3f normal;  // negated (indirect_turned): a receiver in front has a positive dot product with v
  Vec3f bright;
  float reach, xi;
  float soft;  // area over pi, or 0
};

struct GlossyLight {
  Vec3f position;
  Vec3f row_x, row_y, row_z;  // negated
  Vec3f normal;               // negated
  Vec3f bright;               // without Fresnel's grazing part if `grazing` is not zero
  float reach, xi;
  float soft;
  float by_pair;   // 1: Schlick's Fresnel is evaluated for every pair
  Vec3f grazing;   // times (1 - v.h)^5
  Vec3f incoming;  // unit, to the light
};

// The same light by its surface, for modes that evaluate the lobe for every pair.
struct GgxLight {
  Vec3f position;
  Vec3f frame_x, frame_y, normal;  // not negated
  float view_x, view_z;            // direction of the incoming light, in the frame
  float alpha;
  Vec3f bright, grazing;
  float reach, xi;
  float soft;
};

// The texel as a quad light: half axes, one over its area, and the sum of the axes' squares.
struct QuadLight {
  Vec3f edge_x, edge_y;
  float inverse_area;
  float size2;
};

// Bounds of the regions that lights matter to, in arrays that are read sixteen lights at a time; padding reaches nowhere. Diffuse: the egg
// d^2 <= range^2 cosine. Glossy: the unit ball of q = g - T p (kernels, indirect_spheroid).
struct EggArrays {
  VectorArray position, normal;      // normal: away from the surface
  std::vector<float> range, offset;  // offset: that of the surface's plane
};
struct SpheroidArrays {
  VectorArray x, y, z;  // rows of T
  VectorArray g;
  VectorArray normal;  // as for the eggs
  std::vector<float> offset;
};

struct LightSet {
  std::vector<DiffuseLight> diffuse;
  std::vector<QuadLight> diffuse_quads;
  EggArrays eggs;
  std::vector<GlossyLight> glossy;
  std::vector<GgxLight> ggx;  // one per glossy light, unless the mode is ltc
  std::vector<QuadLight> glossy_quads;
  SpheroidArrays spheroids;
};

struct SetOptions {
  IndirectMode mode = IndirectMode::ltc;
  int stride = 8;        // stride^2 sets
  double threshold = 0;  // irradiance; 0: every light reaches everywhere
  bool soften = true;
  std::uint64_t seed = 1;
};

// Surfaces whose largest F0 is below this get Fresnel by pair. The average would lose a quarter of a dielectric's light.
inline constexpr float kFresnelByPair = 0.1f;

std::vector<LightSet> make_sets(const ShadowMap& map, const LobeArrays& lobes, const SetOptions& options);

// The threshold at which one of these receivers keeps `kept` virtual lights of its set on average; 0 if there are not that many. It follows
// the receivers slowly: a moving camera changes ranges by little.
double threshold_for(const ShadowMap& map, const LobeArrays& lobes, const VectorArray& receivers, int stride, double kept);

// Mean distance from the virtual lights to these receivers, weighted by irradiance; 0 if no light arrives. Light varies on this scale.
double travelled(const ShadowMap& map, const LobeArrays& lobes, const VectorArray& receivers);

// Irradiance at p of one texel by its diffuse and by its glossy lobe: largest channel, mean Fresnel.
struct TexelIrradiance {
  float diffuse, glossy;
};
TexelIrradiance irradiance_at(const ShadowMap& map, const LobeArrays& lobes, std::size_t i, Vec3f p);

}  // namespace steradian::indirect
