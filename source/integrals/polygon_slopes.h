// Derivatives of the two parts of a lobe's integral over a polygon, as sums over its edges (kernels/integral/slopes.glsl).
#pragma once

#include <array>
#include <vector>

#include "integrals/integrate.h"
#include "integrals/vertex_walk.h"
#include "steradian/material.h"
#include "steradian/polygon_derivatives.h"
#include "steradian/shading_point.h"

namespace steradian::slopes {

// A vector for each part of an integral (integrals::Part).
struct BothParts {
  Vec3d plain, fresnel;

  friend BothParts operator+(const BothParts& a, const BothParts& b) { return {a.plain + b.plain, a.fresnel + b.fresnel}; }
  friend BothParts operator*(const BothParts& a, double s) { return {a.plain * s, a.fresnel * s}; }
};

// A number for each part.
struct PartSlopes {
  double plain = 0, fresnel = 0;

  friend PartSlopes operator+(PartSlopes a, PartSlopes b) { return {a.plain + b.plain, a.fresnel + b.fresnel}; }
  friend PartSlopes operator-(PartSlopes a, PartSlopes b) { return {a.plain - b.plain, a.fresnel - b.fresnel}; }
  friend PartSlopes operator*(PartSlopes a, double s) { return {a.plain * s, a.fresnel * s}; }
};

// Derivatives by the unit directions of an edge's ends, in the frame.
struct EdgeDerivatives {
  BothParts a, b;
};

inline Vec3d to_vector(const Kernels<double>::vec3& v) { return {v.x.v, v.y.v, v.z.v}; }

// Sums over the edges: every edge depends on its two ends alone, and the horizon's arcs on none. Returns one entry a vertex, in walk order.
//
//   edge(a, b)  EdgeDerivatives of the unit directions of its ends in the frame
template <class Edge>
std::vector<BothParts> by_edges(const PreparedPolygon& light, int side, Vec3d position, const Frame& frame, const Edge& edge) {
  Kernels<double> k;
  std::vector<BothParts> result(light.vertices.size());
  struct Corner {
    Kernels<double>::vec3 direction;
    double scale;  // side over distance
  };
  integrals::walk_vertices(
      light.contours.data(), light.contours.size() - 1,
      [&](std::size_t i) {
        const auto v = integrals::to_kernel<double>(frame.to_local(light.vertices[i] - position));
        return Corner{k.polygon_direction(v), side * inversesqrt(max(dot(v, v), k.smallest_square())).v};
      },
      [&](const Corner& a, const Corner& b) {
        const EdgeDerivatives d = edge(a.direction, b.direction);
        return integrals::EndSlopes<BothParts>{d.a * a.scale, d.b * b.scale};
      },
      [&](std::size_t i, const BothParts& d) {
        result[i] = {frame.to_world(d.plain), frame.to_world(d.fresnel)};
      });
  return result;
}

// The channels of an integral's two parts: factors on the parts, one number a channel.
struct Factors {
  Vec3d plain, fresnel;

  std::array<Vec3d, 3> of(const BothParts& b) const {
    return {b.plain * plain.x + b.fresnel * fresnel.x, b.plain * plain.y + b.fresnel * fresnel.y,
            b.plain * plain.z + b.fresnel * fresnel.z};
  }
};

inline Factors factors_of(Vec3d radiance, const Material& m) {
  return m.brdf == Brdf::ggx ? Factors{radiance * m.f0, radiance * (m.f90 - m.f0)} : Factors{radiance * m.albedo, {}};
}

// The derivative by a rotation vector that turns the light about the point.
inline BothParts turn_of(const PreparedPolygon& light, Vec3d position, const std::vector<BothParts>& by_vertex) {
  BothParts turn{};
  for (std::size_t i = 0; i < by_vertex.size(); ++i) {
    turn.plain += cross(light.vertices[i] - position, by_vertex[i].plain);
    turn.fresnel += cross(light.vertices[i] - position, by_vertex[i].fresnel);
  }
  return turn;
}

// The derivative by the view, of a lobe that looks the same from all sides of the normal: a turn of the view about the normal is one of the
// light the other way.
//
//   across_view(direction)  PartSlopes as the view turns towards a unit direction across it
template <class AcrossView>
BothParts view_of_round_lobe(Vec3d normal, Vec3d view, const BothParts& light_turn, const AcrossView& across_view) {
  const Vec3d along = view - normal * dot(view, normal);
  const double slant = length(along);
  // About the normal itself, every direction leads outward.
  const bool is_normal = !(slant > 1e-5);
  const Frame frame = is_normal ? Frame::from_normal(normal) : Frame::from_normal_and_tangent(normal, along);
  const Vec3d outward = is_normal ? frame.x : frame.x * dot(view, normal) - normal * slant;
  const PartSlopes out = across_view(outward);
  const PartSlopes aside =
      is_normal ? across_view(frame.y) : PartSlopes{dot(normal, light_turn.plain), dot(normal, light_turn.fresnel)} * (-1 / slant);
  return {outward * out.plain + frame.y * aside.plain, outward * out.fresnel + frame.y * aside.fresnel};
}

// The derivative by the normal from those by the light's turn and by the view: a turn of light, view and surface together changes nothing.
// A tangent that leans towards the normal twists the frame as the normal turns.
//
//   view     unit; by_view is perpendicular to it
//   tangent  of a lobe of two widths; else zero
inline Vec3d by_normal(Vec3d normal, Vec3d tangent, Vec3d view, Vec3d light_turn, Vec3d by_view) {
  const Vec3d together = light_turn + cross(view, by_view);
  const Vec3d lying = tangent - normal * dot(normal, tangent);
  const double size2 = dot(lying, lying);
  const double twist = size2 > 1e-18 * dot(tangent, tangent) && size2 > 0 ? dot(normal, tangent) / size2 * dot(normal, together) : 0;
  return cross(normal, together + lying * twist);
}

// The same for each channel.
inline std::array<Vec3d, 3> by_normal(Vec3d normal, Vec3d tangent, Vec3d view, const std::array<Vec3d, 3>& light_turn,
                                      const std::array<Vec3d, 3>& by_view) {
  const auto one = [&](std::size_t c) { return by_normal(normal, tangent, view, light_turn[c], by_view[c]); };
  return {one(0), one(1), one(2)};
}

// The tangent that a lobe feels.
inline Vec3d felt_tangent(const Material& m) { return m.alpha_x == m.alpha_y ? Vec3d{} : m.tangent; }

// All derivatives of a light's radiance from those of the parts.
inline RadianceDerivatives gathered(const PreparedPolygon& light, const ShadingPoint& at, Vec3d tangent,
                                    const std::vector<BothParts>& by_vertex, const BothParts& by_view, const Factors& factors) {
  RadianceDerivatives result(by_vertex.size());
  for (std::size_t i = 0; i < by_vertex.size(); ++i) result.vertices[i] = factors.of(by_vertex[i]);
  result.view = factors.of(by_view);
  const BothParts turn = turn_of(light, at.position, by_vertex);
  const Vec3d n = normalized(at.normal), v = normalized(at.view);
  result.normal =
      factors.of({by_normal(n, tangent, v, turn.plain, by_view.plain), by_normal(n, tangent, v, turn.fresnel, by_view.fresnel)});
  return result;
}

}  // namespace steradian::slopes
