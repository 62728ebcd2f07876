// Reflective shadow maps: where the light of the lights first meets a surface, and what surface that is.
#pragma once

#include <cstdint>
#include <vector>

#include "render/indirect/arrays.h"
#include "render/cpu/ray_scene.h"
#include "steradian/scene.h"

namespace steradian::indirect {

// Texels of all lights. Those that meet no surface carry no flux. Structure of arrays of a multiple of 16.
struct ShadowMap {
  std::size_t count = 0;
  VectorArray position, normal;  // normal: unit, to the side that is lit
  VectorArray incoming;          // unit, to the light
  VectorArray flux;              // RGB [W]: what the texel's cone carries
  VectorArray albedo, f0, f90;
  FloatArray alpha;
  FloatArray area;                         // of the cone's section with the surface [m2]
  VectorArray edge_x, edge_y;              // half axes of that section, a parallelogram about the position
  std::vector<std::uint16_t> column, row;  // place in the light's grid, which is fixed in the light's space

  void resize(std::size_t size);  // all arrays, and the count
};

// A ray of a texel, as floats.
struct MapRay {
  Vec3f origin;
  float begin = 0;  // how far on
  Vec3f direction;  // unit; 0: none
  float unused = 0;
};

// The triangle that it meets first.
struct FirstHit {
  static constexpr std::uint32_t kNothing = ~0u, kUnknown = ~1u;
  std::uint32_t mesh = kNothing, triangle = 0;
};

// What finds those in the place of RayScene, a round of rays at a time.
class FirstHits {
 public:
  virtual ~FirstHits() = default;
  virtual std::size_t most() const = 0;  // of a round
  // Room for a round's rays.
  virtual MapRay* rays(std::size_t count) = 0;
  virtual void find(std::size_t count) = 0;
  // What it has found last; from any thread.
  virtual FirstHit hit(std::size_t ray) const = 0;
};

// About `count` texels, shared among the lights by their power. The same arrays at any number of threads.
//
// Spot lights: a perspective grid over the cone. Directional: a parallel one over the scene. Point lights: a grid of equal
// solid angles. Area lights: rays from points spread over the surface, their directions a cosine-weighted grid; the
// area of such a texel is that of a point light's, moved back by the light's size.
//
// hits: null for the rays' own; they answer, too, what hits leaves unknown.
ShadowMap make_shadow_map(const Scene& scene, const RayScene& rays, int count, FirstHits* hits = nullptr);

}  // namespace steradian::indirect
