// Derivatives of the light of a polygon light by its vertices, by the point, and by the surface's normal. They serve for fitting lights to
// pictures, for inverse lighting, and for error control.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "steradian/closed_form.h"
#include "steradian/ltc.h"

namespace steradian {

struct LightDerivatives {
  double value = 0;
  std::vector<Vec3d> vertices;  // by each vertex as stored: the outline, then the holes
  Vec3d position;               // by the shading point
  Vec3d normal;                 // by the normal, of the function of n/|n|: perpendicular to it
};

// Irradiance of radiance 1 (polygon_irradiance) and its derivatives. Zero if no light arrives. Vertices that a prepared light drops
// (repeated ones) have derivative 0. Moving one vertex of more than three bends the light; the boundary integral is differentiated as it
// stands, edge by edge.
LightDerivatives polygon_irradiance_derivatives(const PolygonLight& light, Vec3d position, Vec3d normal);
// The same for many points of one light; the derivatives are by each vertex of the prepared light.
LightDerivatives polygon_irradiance_derivatives(const PreparedPolygon& light, Vec3d position, Vec3d normal);

// Solid angle (polygon_solid_angle) and its derivatives; the normal does not matter.
LightDerivatives polygon_solid_angle_derivatives(const PolygonLight& light, Vec3d position);

// Radiance derivatives, one vector per channel.
struct RadianceDerivatives {
  std::vector<std::array<Vec3d, 3>> vertices;  // by each vertex as stored
  std::array<Vec3d, 3> normal{};               // of the function of n/|n|, with view and tangent fixed: perpendicular to the normal
  std::array<Vec3d, 3> view{};                 // of the function of v/|v|: perpendicular to the view

  explicit RadianceDerivatives(std::size_t vertex_count) : vertices(vertex_count) {}
};

// Derivatives of a light's radiance: of the true integral of the lobe. Those of GGX have a rule along the edges, at most 3e-4 of the
// largest derivative off by `normal`, 7e-6 by `high` (Slopes.*). By normal and view, shadowing and Fresnel inside the light count by the
// closed form's mean. GGX without shadowing or with multiple scattering, and foreshortened Phong, have differences of the value by normal
// and view. Throws Error for other lobes. Zero for a view below the surface and from behind.
RadianceDerivatives radiance_derivatives(const PolygonLight& light, const ShadingPoint& at, const Material& material,
                                         Quality quality = Quality::normal);
RadianceDerivatives radiance_derivatives(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                         Quality quality = Quality::normal);

// Derivatives of ltc_radiance by `classic`, `compact` or `fresnel`. By normal and view, the table's values change too: its interpolation is
// differentiated. The factor of multiple scattering counts as a constant. Throws Error for the other methods and for materials that
// ltc_radiance does not serve.
RadianceDerivatives ltc_radiance_derivatives(LtcMethod method, const PolygonLight& light, const ShadingPoint& at, const Material& material);
RadianceDerivatives ltc_radiance_derivatives(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at,
                                             const Material& material);

// Density of a lobe, for derivatives of a part of a light whose boundary moves (shadow/region/derivatives.h). It is the radiance to the
// view from a steradian of radiance 1 in a unit direction, one number a channel. Zero below the surface, and for a view below it.
using LobeDensity = std::function<Vec3d(Vec3d)>;

// The lobes and the errors thrown are those of radiance_derivatives and of ltc_radiance_derivatives.
LobeDensity lobe_density(const ShadingPoint& at, const Material& material);
LobeDensity ltc_lobe_density(LtcMethod method, const ShadingPoint& at, const Material& material);

// Stored vertex, outline first, of each vertex of the prepared light: contours lose repeated vertices and may be reversed.
std::vector<std::size_t> stored_vertices(const PolygonLight& light, const PreparedPolygon& prepared);

// Derivative by the point, with fixed normal and view direction: only the vector between light and point counts, so it is minus the sum
// over the vertices.
std::array<Vec3d, 3> by_position(const RadianceDerivatives& by_vertices);

}  // namespace steradian
