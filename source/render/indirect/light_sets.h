// Light sets: virtual lights shared out among the pixels of a pattern, each with the range that chance gives it.
#pragma once

#include <cstdint>
#include <vector>

#include "render/indirect/virtual_lights.h"
#include "steradian/indirect.h"

namespace steradian::indirect {

// What a pair reads of a virtual light. A surface with two lobes makes two lights. `bright` is the share of a set's
// light times flux times albedo / pi, or times rho_f and the lobe's scale. reach = threshold / largest bright.
struct DiffuseLight {
  Vec3f position;
  Vec3f normal;  // turned: a receiver in front has a positive dot product with v
  Vec3f bright;
  float reach, xi;
  float soft;  // area over pi, or 0
};

struct GlossyLight {
  Vec3f position;
  Vec3f row_x, row_y, row_z;  // turned
  Vec3f normal;               // turned
  Vec3f bright;               // without Fresnel's grazing share where `grazing` is not zero
  float reach, xi;
  float soft;
  float by_pair;   // 1: Schlick's Fresnel is evaluated for every pair
  Vec3f grazing;   // times (1 - v.h)^5
  Vec3f incoming;  // unit, to the light
};

// The same light on GGX microsurfaces.
struct GgxLight {
  Vec3f position;
  Vec3f frame_x, frame_y, normal;  // not turned
  float view_x, view_z;            // where the light comes from, in the frame
  float alpha;
  Vec3f bright, grazing;
  float reach, xi;
  float soft;
};

// The texel as a quad that shines: half axes, one over its area, and the axes' squares.
struct QuadLight {
  Vec3f edge_x, edge_y;
  float inverse_area;
  float size2;
};

// Bounds of where lights matter, in arrays that are read sixteen lights at a time; padding reaches nowhere.
// Diffuse: the egg d^2 <= range^2 cosine. Glossy: the unit ball of q = g - T p (kernels, indirect_spheroid).
struct EggArrays {
  VectorArray position, normal;      // normal: away from the surface
  std::vector<float> range, offset;  // offset: of the surface's plane
};
// The ball that holds an egg of range 1: how far in front of the light, and its radius.
inline constexpr float kBallCenter = 0.46f, kBallRadius = 0.628f;
inline constexpr float kBallAlong = 0.54f;  // the spheroid's half axis
struct SpheroidArrays {
  VectorArray x, y, z;  // rows of T
  VectorArray g;
  VectorArray normal;  // as of the eggs
  std::vector<float> offset;
};

struct LightSet {
  std::vector<DiffuseLight> diffuse;
  std::vector<QuadLight> diffuse_quads;
  EggArrays eggs;
  std::vector<GlossyLight> glossy;
  std::vector<GgxLight> ggx;  // as many, in mode ggx only
  std::vector<QuadLight> glossy_quads;
  SpheroidArrays spheroids;
};

struct SetOptions {
  IndirectMode mode = IndirectMode::ltc;
  int stride = 8;        // stride^2 sets
  double threshold = 0;  // of irradiance; 0: everything reaches everywhere
  bool soften = true;
  std::uint64_t seed = 1;
};

// Surfaces whose largest F0 is below this get Fresnel by pair: the average would lose a quarter of a dielectric's light.
inline constexpr float kFresnelByPair = 0.1f;

std::vector<LightSet> make_sets(const ShadowMap& map, const LobeArrays& lobes, const SetOptions& options);

// The threshold at which one of these receivers keeps `kept` virtual lights of its set on average; 0 where there are not
// so many. It follows the receivers slowly: a camera that moves changes ranges by little.
double threshold_for(const ShadowMap& map, const LobeArrays& lobes, const VectorArray& receivers, int stride, double kept);

// How far the light that reaches these receivers has come from the virtual lights: the mean distance, weighted by their
// irradiance. Light varies on this scale. 0 where none arrives.
double travelled(const ShadowMap& map, const LobeArrays& lobes, const VectorArray& receivers);

// Irradiance at p of one texel by its diffuse and by its glossy lobe: largest channel, mean Fresnel.
struct TexelIrradiance {
  float diffuse, glossy;
};
TexelIrradiance irradiance_at(const ShadowMap& map, const LobeArrays& lobes, std::size_t i, Vec3f p);

}  // namespace steradian::indirect
