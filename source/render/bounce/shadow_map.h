// Reflective shadow maps: the places where light from the light sources first meets a surface, and the surfaces there.
#pragma once

#include <cstdint>
#include <vector>

#include "render/bounce/arrays.h"
#include "render/surface/ray_scene.h"
#include "steradian/scene.h"

namespace steradian::indirect {

// Texels of all lights, as a structure of arrays of a multiple of 16. Texels that meet no surface carry no flux.
struct ShadowMap {
  std::size_t count = 0;
  VectorArray position, normal;  // normal: unit, towards the lit side
  VectorArray incoming;          // unit, towards the light
  VectorArray flux;              // RGB [W]: flux of the texel's cone
  VectorArray albedo, f0, f90;
  FloatArray alpha;
  FloatArray area;                         // area of the cone's section with the surface [m2]
  VectorArray edge_x, edge_y;              // half axes of that section, a parallelogram about the position
  std::vector<std::uint16_t> column, row;  // place in the light's grid, which is fixed in the light's space

  void resize(std::size_t size);  // resizes all arrays and sets the count
};

// A ray of a texel, as floats.
struct MapRay {
  Vec3f origin;
  float begin = 0;  // distance at which it begins
  Vec3f direction;  // unit; 0: no ray
  float unused = 0;
};

// The first triangle that a ray meets.
struct FirstHit {
  static constexpr std::uint32_t kNothing = ~0u, kUnknown = ~1u;
  std::uint32_t mesh = kNothing, triangle = 0;
};

// Finds first hits in place of RayScene, a round of rays at a time.
class FirstHits {
 public:
  virtual ~FirstHits() = default;
  virtual std::size_t most() const = 0;  // most rays in a round
  // Memory for a round's rays.
  virtual MapRay* rays(std::size_t count) = 0;
  virtual void find(std::size_t count) = 0;
  // A hit of the last round; any thread may call it.
  virtual FirstHit hit(std::size_t ray) const = 0;
};

// Makes about `count` texels, divided among the lights by their power. The result is the same at any number of threads.
//
// Spot lights use a perspective grid over the cone. Directional lights use a parallel one over the scene. Point lights use a grid of equal
// solid angles. Area lights use rays from points spread over the surface, with a cosine-weighted grid of directions; the area of such a
// texel is that of a point light's, moved back by the light's size.
//
// hits: null for the rays' own hits; `rays` also answers what hits leaves unknown.
ShadowMap make_shadow_map(const Scene& scene, const RayScene& rays, int count, FirstHits* hits = nullptr);

}  // namespace steradian::indirect
