// A surface lit by a polygon light of radiance 1, in one call: Lambert's lobe exactly, GGX by transformed cosines and the compact table.
//
// Everything is in one frame, such as the engine's world, with any unit of length. It may be left-handed. The light's corners lie in one plane.
// The light shines to the side to which cross(v1 - v0, v2 - v0) points: counter-clockwise corners as seen from there, or
// clockwise ones in a left-handed frame. Multiply the results by the light's radiance, and by the visible fraction if something occludes it.
// Needs: constants.glsl frame.glsl polygon.glsl lambert.glsl ltc.glsl
// Topics: ggx, lambert, lit
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Twice the area of a triangle times its unit normal. Summed over the edges of a polygon and one corner: twice its area times its normal.
//
//   corner     any point of the light's plane near it
//   start, end the ends of an edge
vec3 lit_area_of_edge(vec3 corner, vec3 start, vec3 end) {
    return cross(start - corner, end - corner);
}

// A diffuse surface and the edges of a light that were added.
//   position   of the surface
//   frame      x, y and the normal
//   walk       sum over the edges
//   corner     of the light
//   area       twice the light's area times its normal, which points to its lit side
struct LambertPolygon {
    vec3 position;
    mat3 frame;
    PolygonWalk walk;
    vec3 corner;
    vec3 area;
};

// A diffuse surface before the first edge.
//
//   position   of the surface
//   normal     unit
//   corner     any corner of the light
LambertPolygon lambert_polygon_begin(vec3 position, vec3 normal, vec3 corner) {
    LambertPolygon light;
    light.position = position;
    light.frame = frame_from_normal(normal);
    light.walk = polygon_begin();
    light.corner = corner;
    light.area = vec3(0.0, 0.0, 0.0);
    return light;
}

// Adds one edge of the light. Edges may come in any order. The edges of a hole run the other way round.
LambertPolygon lambert_polygon_add_edge(LambertPolygon light, vec3 start, vec3 end) {
    vec3 a = polygon_direction(transform_transposed(light.frame, end - light.position));
    vec3 b = polygon_direction(transform_transposed(light.frame, start - light.position));
    LambertPolygon next = light;
    next.walk = polygon_add_edge(light.walk, a, b);
    next.area = light.area + lit_area_of_edge(light.corner, start, end);
    return next;
}

// Radiance of a surface of albedo 1, in [0, 1]; 0 behind the light.
//
// Error: see docs/measured/accuracy.md, "polygon irradiance".
real lambert_polygon_radiance(LambertPolygon light) {
    mask lit = dot(light.area, light.position - light.corner) > 0.0;
    return select(lit, lambert_radiance(polygon_irradiance(light.walk, !lit)), 0.0);
}

// Radiance of a surface of albedo 1 under a light with two lit sides, in [0, 1].
real lambert_polygon_radiance_of_both_sides(LambertPolygon light) {
    mask behind = dot(light.area, light.position - light.corner) < 0.0;
    return lambert_radiance(polygon_irradiance(light.walk, behind));
}

// Radiance of a diffuse surface of albedo 1 under a light of four corners, in [0, 1]; 0 behind the light.
//
//   position   of the surface
//   normal     unit
//   v0 ... v3  corners of the light, in order
real lambert_quad(vec3 position, vec3 normal, vec3 v0, vec3 v1, vec3 v2, vec3 v3) {
    mat3 frame = frame_from_normal(normal);
    vec3 a = polygon_direction(transform_transposed(frame, v3 - position));
    vec3 b = polygon_direction(transform_transposed(frame, v2 - position));
    vec3 c = polygon_direction(transform_transposed(frame, v1 - position));
    vec3 d = polygon_direction(transform_transposed(frame, v0 - position));
    PolygonWalk walk = polygon_begin();
    walk = polygon_add_edge(walk, a, b);
    walk = polygon_add_edge(walk, b, c);
    walk = polygon_add_edge(walk, c, d);
    walk = polygon_add_edge(walk, d, a);
    mask lit = dot(cross(v1 - v0, v2 - v0), position - v0) > 0.0;
    return select(lit, lambert_radiance(polygon_irradiance(walk, !lit)), 0.0);
}

// The GGX lobe of a surface towards a view, from the compact table.
//   frame      x along the view's projection, z the normal
//   shape      of the lobe
//   magnitude  of the lobe without Fresnel, and of the lobe times (1 - v.h)^5
//   above      true if the view is above the surface
struct GgxLobe {
    mat3 frame;
    LtcMatrix shape;
    vec2 magnitude;
    mask above;
};

// The lobe of a surface towards a view. It serves any number of lights.
//
//   normal     unit
//   view       unit, from the surface to the eye
//   roughness  perceptual: the square root of alpha. It is clamped to [0.01, 1]
GgxLobe ggx_lobe_from_table(vec3 normal, vec3 view, real roughness) {
    real clamped = clamp(roughness, 1.0e-2, 1.0);
    GgxLobe lobe;
    lobe.frame = frame_from_normal_and_view(normal, view);
    vec3 turned = transform_transposed(lobe.frame, view);
    vec2 place = ltc_coordinates(clamped, turned.z);
    lobe.shape = ltc_from_compact(ltc_ggx_shape(place), clamped * clamped, vec3(turned.x, 0.0, turned.z));
    lobe.magnitude = ltc_ggx_magnitude(place);
    lobe.above = turned.z > 0.0;
    return lobe;
}

// Radiance of a lobe with Schlick's Fresnel; 0 for a view from below the surface.
//
//   f0         reflectance along the normal, a colour; at grazing angles it is 1
//   integral   ltc_integral of the light
vec3 ggx_lobe_radiance(GgxLobe lobe, vec3 f0, real integral) {
    real straight = select(lobe.above, (lobe.magnitude.x - lobe.magnitude.y) * integral, 0.0);
    real grazing = select(lobe.above, lobe.magnitude.y * integral, 0.0);
    return f0 * straight + vec3(grazing, grazing, grazing);
}

// A glossy surface and the edges of a light that were added.
//   position   of the surface
//   lobe       of the surface
//   walk       sum over the edges
//   corner     of the light
//   area       twice the light's area times its normal, which points to its lit side
struct GgxPolygon {
    vec3 position;
    GgxLobe lobe;
    LtcWalk walk;
    vec3 corner;
    vec3 area;
};

// A glossy surface before the first edge.
//
//   position   of the surface
//   normal     unit
//   view       unit, from the surface to the eye
//   roughness  perceptual: the square root of alpha
//   corner     any corner of the light
GgxPolygon ggx_polygon_begin(vec3 position, vec3 normal, vec3 view, real roughness, vec3 corner) {
    GgxPolygon light;
    light.position = position;
    light.lobe = ggx_lobe_from_table(normal, view, roughness);
    light.walk = ltc_begin();
    light.corner = corner;
    light.area = vec3(0.0, 0.0, 0.0);
    return light;
}

// Adds one edge of the light. Edges may come in any order. The edges of a hole run the other way round.
GgxPolygon ggx_polygon_add_edge(GgxPolygon light, vec3 start, vec3 end) {
    vec3 a = polygon_direction(transform_transposed(light.lobe.frame, end - light.position));
    vec3 b = polygon_direction(transform_transposed(light.lobe.frame, start - light.position));
    vec3 ta = ltc_direction(light.lobe.shape, a);
    vec3 tb = ltc_direction(light.lobe.shape, b);
    GgxPolygon next = light;
    next.walk = ltc_add_edge(light.walk, light.lobe.shape, a, b, ta, tb);
    next.area = light.area + lit_area_of_edge(light.corner, start, end);
    return next;
}

// Radiance of the glossy surface towards the view; 0 behind the light and for a view from below the surface.
//
//   f0         reflectance along the normal, a colour; at grazing angles it is 1
//
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel", ltc-compact.
vec3 ggx_polygon_radiance(GgxPolygon light, vec3 f0) {
    mask lit = dot(light.area, light.position - light.corner) > 0.0;
    return ggx_lobe_radiance(light.lobe, f0, select(lit, ltc_integral(light.walk, !lit), 0.0));
}

// Radiance of the glossy surface towards the view under a light with two lit sides. See ggx_polygon_radiance.
vec3 ggx_polygon_radiance_of_both_sides(GgxPolygon light, vec3 f0) {
    mask behind = dot(light.area, light.position - light.corner) < 0.0;
    return ggx_lobe_radiance(light.lobe, f0, ltc_integral(light.walk, behind));
}

// Radiance of a glossy surface towards the view under a light of four corners. Add the diffuse part by lambert_quad.
//
//   position   of the surface
//   normal     unit
//   view       unit, from the surface to the eye
//   v0 ... v3  corners of the light, in order
//   roughness  perceptual: the square root of alpha. It is clamped to [0.01, 1]
//   f0         reflectance along the normal, a colour: 0.04 for plastic and glass, the base colour of a metal
//
// Degenerate: a point behind the light or in its plane gives 0, and so does a view from below the surface.
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel", ltc-compact.
vec3 ggx_quad(vec3 position, vec3 normal, vec3 view, vec3 v0, vec3 v1, vec3 v2, vec3 v3, real roughness, vec3 f0) {
    GgxLobe lobe = ggx_lobe_from_table(normal, view, roughness);
    vec3 a = polygon_direction(transform_transposed(lobe.frame, v3 - position));
    vec3 b = polygon_direction(transform_transposed(lobe.frame, v2 - position));
    vec3 c = polygon_direction(transform_transposed(lobe.frame, v1 - position));
    vec3 d = polygon_direction(transform_transposed(lobe.frame, v0 - position));
    vec3 ta = ltc_direction(lobe.shape, a);
    vec3 tb = ltc_direction(lobe.shape, b);
    vec3 tc = ltc_direction(lobe.shape, c);
    vec3 td = ltc_direction(lobe.shape, d);
    LtcWalk walk = ltc_begin();
    walk = ltc_add_edge(walk, lobe.shape, a, b, ta, tb);
    walk = ltc_add_edge(walk, lobe.shape, b, c, tb, tc);
    walk = ltc_add_edge(walk, lobe.shape, c, d, tc, td);
    walk = ltc_add_edge(walk, lobe.shape, d, a, td, ta);
    mask lit = dot(cross(v1 - v0, v2 - v0), position - v0) > 0.0;
    return ggx_lobe_radiance(lobe, f0, select(lit, ltc_integral(walk, !lit), 0.0));
}
