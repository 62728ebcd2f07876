// Steradian 0.1.0, lit: surfaces lit by a quad or a polygon in one call: GGX and Lambert, for HLSL.
//
// #include or paste it; it has no macros and no resources.
// It needs these files before it, in this order: math.hlsl, polygon.hlsl, lobe.hlsl, ltc.hlsl, ltc_tables.hlsl.
// Made by dist/make_dist.py from kernels/ and dist/source/: change those.
//
// MIT License
//
// Copyright (c) 2026 The Steradian authors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy
// of this software and associated documentation files (the "Software"), to deal
// in the Software without restriction, including without limitation the rights
// to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
// copies of the Software, and to permit persons to whom the Software is
// furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all
// copies or substantial portions of the Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
// IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
// FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
// AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
// LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
// OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
// SOFTWARE.

// ==== lit ====

// A surface lit by a polygon light of radiance 1, in one call: Lambert's lobe exactly, GGX by transformed cosines and the compact table.
//
// Everything is in one frame, such as the engine's world, with any unit of length. It may be left-handed. The light's corners lie in one plane.
// The light shines to the side to which cross(v1 - v0, v2 - v0) points: counter-clockwise corners as seen from there, or
// clockwise ones in a left-handed frame. Multiply the results by the light's radiance, and by the visible fraction if something occludes it.

// Twice the area of a triangle times its unit normal. Summed over the edges of a polygon and one corner: twice its area times its normal.
//
//   corner     any point of the light's plane near it
//   start, end the ends of an edge
float3 steradian_lit_area_of_edge(float3 corner, float3 start, float3 end) {
    return cross(start - corner, end - corner);
}

// A diffuse surface and the edges of a light that were added.
//   position   of the surface
//   frame      x, y and the normal
//   walk       sum over the edges
//   corner     of the light
//   area       twice the light's area times its normal, which points to its lit side
struct SteradianLambertPolygon {
    float3 position;
    float3x3 frame;
    SteradianPolygonWalk walk;
    float3 corner;
    float3 area;
};

// A diffuse surface before the first edge.
//
//   position   of the surface
//   normal     unit
//   corner     any corner of the light
SteradianLambertPolygon steradian_lambert_polygon_begin(float3 position, float3 normal, float3 corner) {
    SteradianLambertPolygon light;
    light.position = position;
    light.frame = steradian_frame_from_normal(normal);
    light.walk = steradian_polygon_begin();
    light.corner = corner;
    light.area = float3(0.0, 0.0, 0.0);
    return light;
}

// Adds one edge of the light. Edges may come in any order. The edges of a hole run the other way round.
SteradianLambertPolygon steradian_lambert_polygon_add_edge(SteradianLambertPolygon light, float3 start, float3 end) {
    float3 a = steradian_polygon_direction(steradian_transform_transposed(light.frame, end - light.position));
    float3 b = steradian_polygon_direction(steradian_transform_transposed(light.frame, start - light.position));
    SteradianLambertPolygon next = light;
    next.walk = steradian_polygon_add_edge(light.walk, a, b);
    next.area = light.area + steradian_lit_area_of_edge(light.corner, start, end);
    return next;
}

// Radiance of a surface of albedo 1, in [0, 1]; 0 behind the light.
//
// Error: see docs/measured/accuracy.md, "polygon irradiance".
float steradian_lambert_polygon_radiance(SteradianLambertPolygon light) {
    bool lit = dot(light.area, light.position - light.corner) > 0.0;
    return steradian_select(lit, steradian_lambert_radiance(steradian_polygon_irradiance(light.walk, !lit)), 0.0);
}

// Radiance of a surface of albedo 1 under a light with two lit sides, in [0, 1].
float steradian_lambert_polygon_radiance_of_both_sides(SteradianLambertPolygon light) {
    bool behind = dot(light.area, light.position - light.corner) < 0.0;
    return steradian_lambert_radiance(steradian_polygon_irradiance(light.walk, behind));
}

// Radiance of a diffuse surface of albedo 1 under a light of four corners, in [0, 1]; 0 behind the light.
//
//   position   of the surface
//   normal     unit
//   v0 ... v3  corners of the light, in order
float steradian_lambert_quad(float3 position, float3 normal, float3 v0, float3 v1, float3 v2, float3 v3) {
    float3x3 frame = steradian_frame_from_normal(normal);
    float3 a = steradian_polygon_direction(steradian_transform_transposed(frame, v3 - position));
    float3 b = steradian_polygon_direction(steradian_transform_transposed(frame, v2 - position));
    float3 c = steradian_polygon_direction(steradian_transform_transposed(frame, v1 - position));
    float3 d = steradian_polygon_direction(steradian_transform_transposed(frame, v0 - position));
    SteradianPolygonWalk walk = steradian_polygon_begin();
    walk = steradian_polygon_add_edge(walk, a, b);
    walk = steradian_polygon_add_edge(walk, b, c);
    walk = steradian_polygon_add_edge(walk, c, d);
    walk = steradian_polygon_add_edge(walk, d, a);
    bool lit = dot(cross(v1 - v0, v2 - v0), position - v0) > 0.0;
    return steradian_select(lit, steradian_lambert_radiance(steradian_polygon_irradiance(walk, !lit)), 0.0);
}

// The GGX lobe of a surface towards a view, from the compact table.
//   frame      x along the view's projection, z the normal
//   shape      of the lobe
//   magnitude  of the lobe without Fresnel, and of the lobe times (1 - v.h)^5
//   above      true if the view is above the surface
struct SteradianGgxLobe {
    float3x3 frame;
    SteradianLtcMatrix shape;
    float2 magnitude;
    bool above;
};

// The lobe of a surface towards a view. It serves any number of lights.
//
//   normal     unit
//   view       unit, from the surface to the eye
//   roughness  perceptual: the square root of alpha. It is clamped to [0.01, 1]
SteradianGgxLobe steradian_ggx_lobe_from_table(float3 normal, float3 view, float roughness) {
    float clamped = clamp(roughness, 1.0e-2, 1.0);
    SteradianGgxLobe lobe;
    lobe.frame = steradian_frame_from_normal_and_view(normal, view);
    float3 turned = steradian_transform_transposed(lobe.frame, view);
    float2 place = steradian_ltc_coordinates(clamped, turned.z);
    lobe.shape = steradian_ltc_from_compact(steradian_ltc_ggx_shape(place), clamped * clamped, float3(turned.x, 0.0, turned.z));
    lobe.magnitude = steradian_ltc_ggx_magnitude(place);
    lobe.above = turned.z > 0.0;
    return lobe;
}

// Radiance of a lobe with Schlick's Fresnel; 0 for a view from below the surface.
//
//   f0         reflectance along the normal, a colour; at grazing angles it is 1
//   integral   steradian_ltc_integral of the light
float3 steradian_ggx_lobe_radiance(SteradianGgxLobe lobe, float3 f0, float integral) {
    float straight = steradian_select(lobe.above, (lobe.magnitude.x - lobe.magnitude.y) * integral, 0.0);
    float grazing = steradian_select(lobe.above, lobe.magnitude.y * integral, 0.0);
    return f0 * straight + float3(grazing, grazing, grazing);
}

// A glossy surface and the edges of a light that were added.
//   position   of the surface
//   lobe       of the surface
//   walk       sum over the edges
//   corner     of the light
//   area       twice the light's area times its normal, which points to its lit side
struct SteradianGgxPolygon {
    float3 position;
    SteradianGgxLobe lobe;
    SteradianLtcWalk walk;
    float3 corner;
    float3 area;
};

// A glossy surface before the first edge.
//
//   position   of the surface
//   normal     unit
//   view       unit, from the surface to the eye
//   roughness  perceptual: the square root of alpha
//   corner     any corner of the light
SteradianGgxPolygon steradian_ggx_polygon_begin(float3 position, float3 normal, float3 view, float roughness, float3 corner) {
    SteradianGgxPolygon light;
    light.position = position;
    light.lobe = steradian_ggx_lobe_from_table(normal, view, roughness);
    light.walk = steradian_ltc_begin();
    light.corner = corner;
    light.area = float3(0.0, 0.0, 0.0);
    return light;
}

// Adds one edge of the light. Edges may come in any order. The edges of a hole run the other way round.
SteradianGgxPolygon steradian_ggx_polygon_add_edge(SteradianGgxPolygon light, float3 start, float3 end) {
    float3 a = steradian_polygon_direction(steradian_transform_transposed(light.lobe.frame, end - light.position));
    float3 b = steradian_polygon_direction(steradian_transform_transposed(light.lobe.frame, start - light.position));
    float3 ta = steradian_ltc_direction(light.lobe.shape, a);
    float3 tb = steradian_ltc_direction(light.lobe.shape, b);
    SteradianGgxPolygon next = light;
    next.walk = steradian_ltc_add_edge(light.walk, light.lobe.shape, a, b, ta, tb);
    next.area = light.area + steradian_lit_area_of_edge(light.corner, start, end);
    return next;
}

// Radiance of the glossy surface towards the view; 0 behind the light and for a view from below the surface.
//
//   f0         reflectance along the normal, a colour; at grazing angles it is 1
//
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel", ltc-compact.
float3 steradian_ggx_polygon_radiance(SteradianGgxPolygon light, float3 f0) {
    bool lit = dot(light.area, light.position - light.corner) > 0.0;
    return steradian_ggx_lobe_radiance(light.lobe, f0, steradian_select(lit, steradian_ltc_integral(light.walk, !lit), 0.0));
}

// Radiance of the glossy surface towards the view under a light with two lit sides. See steradian_ggx_polygon_radiance.
float3 steradian_ggx_polygon_radiance_of_both_sides(SteradianGgxPolygon light, float3 f0) {
    bool behind = dot(light.area, light.position - light.corner) < 0.0;
    return steradian_ggx_lobe_radiance(light.lobe, f0, steradian_ltc_integral(light.walk, behind));
}

// Radiance of a glossy surface towards the view under a light of four corners. Add the diffuse part by steradian_lambert_quad.
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
float3 steradian_ggx_quad(float3 position, float3 normal, float3 view, float3 v0, float3 v1, float3 v2, float3 v3, float roughness, float3 f0) {
    SteradianGgxLobe lobe = steradian_ggx_lobe_from_table(normal, view, roughness);
    float3 a = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v3 - position));
    float3 b = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v2 - position));
    float3 c = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v1 - position));
    float3 d = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v0 - position));
    float3 ta = steradian_ltc_direction(lobe.shape, a);
    float3 tb = steradian_ltc_direction(lobe.shape, b);
    float3 tc = steradian_ltc_direction(lobe.shape, c);
    float3 td = steradian_ltc_direction(lobe.shape, d);
    SteradianLtcWalk walk = steradian_ltc_begin();
    walk = steradian_ltc_add_edge(walk, lobe.shape, a, b, ta, tb);
    walk = steradian_ltc_add_edge(walk, lobe.shape, b, c, tb, tc);
    walk = steradian_ltc_add_edge(walk, lobe.shape, c, d, tc, td);
    walk = steradian_ltc_add_edge(walk, lobe.shape, d, a, td, ta);
    bool lit = dot(cross(v1 - v0, v2 - v0), position - v0) > 0.0;
    return steradian_ggx_lobe_radiance(lobe, f0, steradian_select(lit, steradian_ltc_integral(walk, !lit), 0.0));
}
