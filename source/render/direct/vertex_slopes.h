// A polygon's light at many surface points and its derivatives by all vertices, from one walk on packs (kernels/integral/slopes.glsl).
#pragma once

#include "render/direct/lobe_packs.h"

namespace steradian {

// Results for a light of radiance 1 and a lobe of albedo 1. Derivative by the coordinate `axis` of vertex v at point i, of `count` points:
// [(3 v + axis) count + i]. Vertices are in walk order.
struct VertexSlopes {
  LobeRadiance value;        // as LobePacks gives it, but for far lights, which are walked, too
  float* plain;              // derivatives of value.plain
  float* fresnel = nullptr;  // of value.fresnel; null: not wanted, but closed_form always sets it
};

struct VertexSlopePacks {
  using Function = void (*)(const PackLight& light, const Points& points, const PackLobe& lobe, const VertexSlopes& result);

  Function diffuse;      // the irradiance. The mean direction by which a boundary dims the diffuse lobe counts as a constant
  Function ltc;          // by the tables of the lobe
  Function phong;        // the series; quality: of the value. fresnel is not set
  Function closed_form;  // GGX; quality: of the value
};

STERADIAN_DECLARE_PACK_TABLE(VertexSlopePacks, vertex_slope_packs)

}  // namespace steradian
