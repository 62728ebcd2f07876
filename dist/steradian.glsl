// Steradian 0.1.0: area light integrals in closed form, for GLSL 4.50.
//
// Paste after #version and your own declarations. Made by
// dist/make_dist.py from kernels/*.glsl: change those. For example:
//
//     // Radiance that a quad light sends to the eye from a Lambert surface.
//     //   p, n         surface point and its unit normal
//     //   v0 ... v3    the light's corners, counter-clockwise as seen from its lit side
//     //   radiance     of the light; the result is for albedo 1
//     float lit_by_quad(vec3 p, vec3 n, vec3 v0, vec3 v1, vec3 v2, vec3 v3, float radiance) {
//         mat3 frame = frame_from_normal(n);
//         vec3 a = polygon_direction(steradian_transform_transposed(frame, v3 - p));  // walk order: the corners backwards
//         vec3 b = polygon_direction(steradian_transform_transposed(frame, v2 - p));
//         vec3 c = polygon_direction(steradian_transform_transposed(frame, v1 - p));
//         vec3 d = polygon_direction(steradian_transform_transposed(frame, v0 - p));
//         PolygonWalk walk = polygon_begin();
//         walk = polygon_add_edge(walk, a, b);
//         walk = polygon_add_edge(walk, b, c);
//         walk = polygon_add_edge(walk, c, d);
//         walk = polygon_add_edge(walk, d, a);
//         bool lit = dot(cross(v1 - v0, v2 - v0), p - v0) > 0.0;
//         float irradiance = steradian_select(lit, polygon_irradiance(walk, !lit), 0.0);
//         return lambert_radiance(irradiance) * radiance;
//     }
//
// A light of any outline is walked edge by edge; each function's comment gives frame, units, preconditions,
// degenerate case and source.
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

float steradian_select(bool m, float a, float b) { return m ? a : b; }
vec2 steradian_select(bool m, vec2 a, vec2 b) { return m ? a : b; }
vec3 steradian_select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 steradian_select(bool m, vec4 a, vec4 b) { return m ? a : b; }

vec2 steradian_xy(vec3 v) { return v.xy; }

// Matrix of three columns times vector, and its transpose times vector.
vec3 steradian_transform(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
vec3 steradian_transform_transposed(mat3 m, vec3 v) { return vec3(dot(m[0], v), dot(m[1], v), dot(m[2], v)); }

// ==== frame ====

// Shading frames. A frame is a mat3 whose columns are x, y and z; transform_transposed(frame, w) takes a world
// vector into it, transform(frame, l) back.

// Orthonormal right-handed frame with z along n and x, y in any direction.
//
//   n        unit normal
//
// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin, "Building an orthonormal basis, revisited", 2017.
mat3 frame_from_normal(vec3 n) {
    float s = steradian_select(n.z < 0.0, -1.0, 1.0);
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    vec3 x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 y = vec3(b, s + n.y * n.y * a, -n.y);
    return mat3(x, y, n);
}

// Orthonormal right-handed frame with z along n and the view in the half plane of x and z.
//
//   n, v     unit normal and view
//
// Degenerate: a view along the normal (closer than 1e-6) gives any x.
mat3 frame_from_normal_and_view(vec3 n, vec3 v) {
    mat3 other = frame_from_normal(n);
    vec3 t = v - n * dot(n, v);
    float t2 = dot(t, t);
    vec3 x = steradian_select(t2 > 1.0e-12, t * inversesqrt(max(t2, 1.0e-12)), steradian_transform(other, vec3(1.0, 0.0, 0.0)));
    return mat3(x, cross(n, x), n);
}

// ==== ellipsoid ====

// Spheres and ellipsoids as lights: their outline, seen from a point, is a planar ellipse.

// The ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point [m], and whether it can be seen.
struct EllipsoidOutline {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
    bool outside;  // false: the point is inside, no light
};

// Outline of the ellipsoid c + S u, |u| = 1, whose cone of tangents meets the shading point.
//
//   to_center  c - p, from the shading point p to the centre
//   s          S, half axes as columns
//   inverse    S^-1, its columns
//
// Degenerate: a point inside or on the ellipsoid gives outside = false and a finite outline.
// Source: the unit sphere's outline from distance d is the circle of radius sqrt(1 - 1/d^2) at height 1/d above the
// centre; S maps it.
EllipsoidOutline ellipsoid_outline(vec3 to_center, mat3 s, mat3 inverse) {
    vec3 p = -steradian_transform(inverse, to_center);
    float d2 = dot(p, p);
    float safe = max(d2, 1.000001);
    float inverse_d = inversesqrt(safe);
    vec3 k = p * inversesqrt(max(d2, 1.0e-30));
    float rho = sqrt(1.0 - 1.0 / safe);
    mat3 frame = frame_from_normal(k);
    vec3 a = steradian_transform(frame, vec3(rho, 0.0, 0.0));
    vec3 b = steradian_transform(frame, vec3(0.0, rho, 0.0));
    EllipsoidOutline outline;
    outline.center = to_center + steradian_transform(s, k * inverse_d);
    outline.axis_a = steradian_transform(s, a);
    outline.axis_b = steradian_transform(s, b);
    outline.outside = d2 > 1.000001;
    return outline;
}

// ==== inverse_trig ====

// Inverse trigonometry for the kernels, the same in every language.
//
// The built-in acos and atan of shader compilers differ by up to 8e-5; these polynomials do not. Each exists for 24
// bits (float, GPU) and for 53 (double); real_digits() is a compile-time constant and picks one.
// Coefficients: tools/fit_inverse_trig finds them; the test InverseTrig.PolynomialsAreTheFittedOnes compares.

// The one function without a topic: every kernel may use it.
float steradian_pi() { return 3.14159265358979324; }

// Degree 9, largest relative error 1.3e-08 before rounding.
float trig_angle_over_sine_24_bits(float t) {
    float p = 0.01116282422619877;
    p = p * t - 0.032591688733997218;
    p = p * t + 0.05097575847577638;
    p = p * t - 0.033552997791327491;
    p = p * t + 0.030059175970996568;
    p = p * t + 0.020163489805166888;
    p = p * t + 0.057977801513775039;
    p = p * t + 0.13326657225500885;
    p = p * t + 0.33333538143391106;
    p = p * t + 0.9999999897346874;
    return p;
}

// Degree 8, largest relative error 1.8e-08 before rounding.
float trig_atan_over_argument_24_bits(float q) {
    float p = 0.002766283501762026;
    p = p * q - 0.015731249122183651;
    p = p * q + 0.042137623589193041;
    p = p * q - 0.07456854826004547;
    p = p * q + 0.10618370636953849;
    p = p * q - 0.14197797794085124;
    p = p * q + 0.19991872029109073;
    p = p * q - 0.33333036709286273;
    p = p * q + 0.99999998178865568;
    return p;
}

// Angle over sine of an angle in [0, pi/2], from its cosine: acos(c) / sqrt(1 - c*c).
//
//   t        1 - c, in [0, 1]
//   returns  1 at t = 0 to pi/2 at t = 1
//
// Error: see docs/accuracy.md, "angle over sine". A series in 1 - c has positive terms: nothing cancels.
float trig_angle_over_sine_acute(float t) {
    return trig_angle_over_sine_24_bits(t);
}

// Angle over sine of an angle in [0, pi], from its cosine and the square of its sine.
//
//   c        cosine, in [-1, 1]; the polynomial goes on smoothly where rounding exceeds it
//   s2       sine squared, computed on its own (a squared cross product), not as 1 - c*c, which cancels near pi
//
// Degenerate: towards pi the value grows like pi/sine; it stops at s2 = 1.0e-30, where products with the sine are 0.
float trig_angle_over_sine(float c, float s2) {
    float f = trig_angle_over_sine_acute(1.0 - abs(c));
    bool obtuse = c < 0.0;
    if (obtuse) {
        f = steradian_select(obtuse, steradian_pi() * inversesqrt(max(s2, 1.0e-30)) - f, f);
    }
    return f;
}

// The angle of the vector (x, y) from the x axis, in (-pi, pi] [rad].
//
// Degenerate: (0, 0) gives 0. Scale does not matter as long as the smaller over the larger does not underflow.
// Error: see docs/accuracy.md, "atan2".
float trig_atan2(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float larger = max(ax, ay);
    float t = min(ax, ay) / max(larger, 1.0e-37);
    float q = t * t;
    float p = trig_atan_over_argument_24_bits(q);
    float angle = t * p;
    angle = steradian_select(ay > ax, 0.5 * steradian_pi() - angle, angle);
    angle = steradian_select(x < 0.0, steradian_pi() - angle, angle);
    return steradian_select(y < 0.0, -angle, angle);
}

// The same angle, counted from -pi/2 to 3 pi/2: for angles known to lie in [0, pi], whose rounding must not wrap.
float trig_atan2_unwrapped(float y, float x) {
    float angle = trig_atan2(y, x);
    return steradian_select(angle < -0.5 * steradian_pi(), angle + 2.0 * steradian_pi(), angle);
}

// ==== lambert ====

// The diffuse surface: the same radiance to every side.

// Radiance that a Lambert surface of albedo 1 sends out, per radiance of the light.
//
//   irradiance  polygon_irradiance, in [0, pi]
float lambert_radiance(float irradiance) {
    return irradiance * 0.318309886183790672;
}

// The lobe itself: BRDF of albedo 1 times the cosine of the light's direction l (unit, shading frame).
float lambert_lobe(vec3 l) {
    return max(l.z, 0.0) * 0.318309886183790672;
}

// ==== microfacet ====

// Microfacet terms: GGX and Beckmann distributions, height-correlated Smith shadowing, Schlick's Fresnel.
//
// Frame: z the surface normal, x and y the directions of the widths ax and ay (equal where isotropic). l light,
// v view, h half vector, all unit and pointing away from the surface. Width alpha = roughness squared, at least 1.0e-4.

// Half vector of light and view. Degenerate: l = -v gives the zero vector.
vec3 microfacet_half_vector(vec3 l, vec3 v) {
    vec3 h = l + v;
    return h * inversesqrt(max(dot(h, h), 1.0e-36));
}

// Distribution of GGX: 1 / (pi ax ay ((h_x/ax)^2 + (h_y/ay)^2 + h_z^2)^2).
//
// In the components of h, not in 1 - h_z^2, which cancels in float at small alpha.
// Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction", 2007, eq. 33; anisotropic: Heitz,
// "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014, eq. 85.
float ggx_distribution(vec3 h, float ax, float ay) {
    float x = h.x / ax;
    float y = h.y / ay;
    float d = x * x + y * y + h.z * h.z;
    return 0.318309886183790672 / (ax * ay * d * d);
}

// Length of the direction w stretched by the surface: sqrt(w_z^2 + (ax w_x)^2 + (ay w_y)^2).
float ggx_stretched_length(vec3 w, float ax, float ay) {
    float x = ax * w.x;
    float y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Smith's shadowing and masking, height-correlated, in [0, 1].
//
// Degenerate: 0 where l or v is not above the surface.
// Source: Heitz 2014, eq. 99, written without Lambda: 2 l_z v_z / (l_z |v|' + v_z |l|').
float ggx_shadowing(vec3 l, vec3 v, float ax, float ay) {
    float lz = max(l.z, 0.0);
    float vz = max(v.z, 0.0);
    float d = lz * ggx_stretched_length(v, ax, ay) + vz * ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, 1.0e-36);
}

// Schlick's Fresnel with a free value at grazing.
//
//   f0, f90  reflectance along and across the normal
//   v_dot_h  cosine between view and half vector
//
// Source: Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, eq. 15.
float fresnel_schlick(float f0, float f90, float v_dot_h) {
    float x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Distribution of Beckmann: exp(-((h_x/ax)^2 + (h_y/ay)^2)/h_z^2) / (pi ax ay h_z^4).
//
// Degenerate: h_z is kept above 1.0e-5, where the exponential is 0 for any alpha up to 1.
// Source: Walter et al. 2007, eq. 25.
float beckmann_distribution(vec3 h, float ax, float ay) {
    float hz = max(h.z, 1.0e-5);
    float x = h.x / (ax * hz);
    float y = h.y / (ay * hz);
    float z2 = hz * hz;
    return 0.318309886183790672 * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}

// A microfacet lobe without shadowing and Fresnel: BRDF times cosine, D / (4 v_z).
//
//   d        distribution at the half vector
//   l, v     directions; 0 where either is not above the surface
float microfacet_lobe_unshadowed(float d, vec3 l, vec3 v) {
    bool above = l.z > 0.0 && v.z > 0.0;
    return steradian_select(above, d / (4.0 * max(v.z, 1.0e-6)), 0.0);
}

// The GGX lobe with shadowing, without Fresnel: BRDF times cosine, D G2 / (4 v_z).
float ggx_lobe(vec3 l, vec3 v, float ax, float ay) {
    vec3 h = microfacet_half_vector(l, v);
    float g = ggx_shadowing(l, v, ax, ay);
    return microfacet_lobe_unshadowed(ggx_distribution(h, ax, ay) * g, l, v);
}

// ==== phong ====

// Lobes that are a power of a cosine: Phong about the mirrored view, Blinn-Phong about the normal.

// x to the power n, for x in [0, 1] and n >= 0, as exp(n log x).
//
// Degenerate: x <= 1.0e-30 counts as 1.0e-30 (0 for any n of use; n = 0 gives 1).
// Error: relative, n |log x| roundings of the logarithm: where the power is not small, a few units of 1.0e-7 in float.
float phong_power(float x, float n) {
    return exp(n * log(max(x, 1.0e-30)));
}

// The view mirrored at the surface.
//
//   v        view direction, shading frame
vec3 phong_mirror(vec3 v) {
    return vec3(-v.x, -v.y, v.z);
}

// The Phong lobe: (n + 1) / (2 pi) max(l.r, 0)^n. Its integral over the sphere is 1; it has no foreshortening.
//
//   l        unit direction of the light, r unit axis of the lobe
//   n        exponent, at least 0
//
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017, eq. 10.
float phong_lobe(vec3 l, vec3 r, float n) {
    return (n + 1.0) * 0.159154943091895336 * phong_power(dot(l, r), n);
}

// Distribution of half vectors of Blinn-Phong: (n + 2) / (2 pi) h_z^n, normalised over projected solid angle.
//
//   h        unit half vector, shading frame
float blinn_phong_distribution(vec3 h, float n) {
    return (n + 2.0) * 0.159154943091895336 * phong_power(h.z, n);
}

// ==== polygon ====

// Irradiance and solid angle of polygonal lights: the boundary integrals of Lambert and Girard.
//
// A light is walked edge by edge, so that any number of vertices, non-convex outlines and holes (walked the other
// way round) cost no array. Frame: origin at the shading point, z the surface normal. Walk order: seen from the
// point, det(v_i, v_i+1, inside) > 0, the reverse of a stored polygon that is counter-clockwise from its lit side.

// The state of a walk.
//   edges    sum over the edges, each clipped to the horizon, of half its angle times its plane's unit normal [rad]
//   horizon  product of unit complex numbers: its angle is the arc of the horizon that closes the clipped outline
struct PolygonWalk {
    vec3 edges;
    vec2 horizon;
};

// Unit direction of a vertex.
//
//   v        vertex relative to the shading point, any unit of length
//
// Degenerate: a length below 1e-18 (the point lies on the vertex) gives a vector shorter than 1; one above 1e18, whose
// square leaves the range of float, the zero vector. Both are finite and add next to nothing to any sum.
vec3 polygon_direction(vec3 v) {
    float d2 = dot(v, v);
    float scale = steradian_select(d2 < 1.0e36, inversesqrt(max(d2, 1.0e-36)), 0.0);
    return v * scale;
}

// Irradiance vector of one edge: half the edge's angle times its plane's unit normal [rad].
//
//   a, b     unit directions of the edge's ends, in walk order
//   returns  its z is what the edge sends to a surface with normal z; divided by pi: the form factor's share
//
// Degenerate: a = b gives 0; a = -b spans no plane and gives 0.
// Error: see docs/accuracy.md, "polygon edge".
// Source: Lambert 1760; Baum, Rushmeier, Winget, "Improving radiosity solutions through the use of analytically
// determined form-factors", 1989, eq. 6.
vec3 polygon_edge(vec3 a, vec3 b) {
    vec3 n = cross(a, b);
    float f = trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}

// A walk before its first edge: no edges, and a horizon of angle 0.
PolygonWalk polygon_begin() {
    PolygonWalk walk;
    walk.edges = vec3(0.0, 0.0, 0.0);
    walk.horizon = vec2(1.0, 0.0);
    return walk;
}

// Adds one edge, clipped to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (polygon_direction), in walk order
//
// What lies below is replaced by an arc of the horizon from where the outline leaves to where it comes back. All
// these arcs of a plane light lie within one half circle and run the same way, so that only the sum of their angles
// counts: each crossing multiplies its azimuth into a complex number, in whatever order the crossings come.
PolygonWalk polygon_add_edge(PolygonWalk walk, vec3 a, vec3 b) {
    PolygonWalk next = walk;
    bool a_below = a.z < 0.0;
    bool b_below = b.z < 0.0;
    if (!a_below || !b_below) {
        vec3 start = a;
        vec3 end = b;
        if (a_below || b_below) {
            // Where the edge crosses the horizon: weights of one sign, so nothing cancels.
            float wa = abs(b.z);
            float wb = abs(a.z);
            vec2 p = vec2(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
            p = p * inversesqrt(max(dot(p, p), 1.0e-36));
            vec3 crossing = vec3(p.x, p.y, 0.0);
            start = steradian_select(a_below, crossing, a);
            end = steradian_select(b_below, crossing, b);  // both below: start = end, an edge of no length
            bool crosses = (a_below && !b_below) || (b_below && !a_below);
            float y = steradian_select(a_below, p.y, -p.y);  // coming up: the azimuth; going down: its conjugate
            vec2 h = walk.horizon;
            next.horizon = steradian_select(crosses, vec2(h.x * p.x - h.y * y, h.x * y + h.y * p.x), h);
        }
        next.edges = walk.edges + polygon_edge(start, end);
    }
    return next;
}

// Irradiance vector of the part of the light above the horizon [sr times radiance 1].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//   returns  in the shading frame; z is the irradiance, the direction is where the light is, seen on average
//
// Degenerate: a point in the light's plane gives 0 up to rounding.
vec3 polygon_irradiance_vector(PolygonWalk walk, bool reversed) {
    float facing = steradian_select(reversed, -1.0, 1.0);
    float arc = 0.0;
    if (abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0) {
        arc = trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    vec3 e = walk.edges * facing;
    return vec3(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, steradian_pi()));
}

// Irradiance of radiance 1 from the part of the light above the horizon, in [0, pi]. See polygon_irradiance_vector.
//
// Error: see docs/accuracy.md, "polygon irradiance".
float polygon_irradiance(PolygonWalk walk, bool reversed) {
    vec3 e = polygon_irradiance_vector(walk, reversed);
    return e.z;
}

// The state of a solid angle's walk: a product of complex numbers, each with half a triangle's solid angle.
struct SolidAngleWalk {
    vec3 first;
    vec2 product;
};

// Starts at a vertex.
//
//   first    unit direction of any vertex of the light
SolidAngleWalk solid_angle_begin(vec3 first) {
    SolidAngleWalk walk;
    walk.first = first;
    walk.product = vec2(1.0, 0.0);
    return walk;
}

// Adds the triangle of the first vertex and one edge. Directions as for polygon_add_edge; no horizon here.
//
// Degenerate: a triangle without area has a real factor and adds nothing.
// Source: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
SolidAngleWalk solid_angle_add_edge(SolidAngleWalk walk, vec3 a, vec3 b) {
    SolidAngleWalk next = walk;
    float re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    float im = dot(walk.first, cross(a, b));
    float scale = inversesqrt(max(re * re + im * im, 1.0e-36));
    re = re * scale;
    im = im * scale;
    vec2 p = walk.product;
    next.product = vec2(p.x * re - p.y * im, p.x * im + p.y * re);
    return next;
}

// Solid angle of a plane light, in [0, 2 pi] [sr].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Error: see docs/accuracy.md, "polygon solid angle".
float solid_angle_finish(SolidAngleWalk walk, bool reversed) {
    float y = steradian_select(reversed, -walk.product.y, walk.product.y);
    return max(2.0 * trig_atan2_unwrapped(y, walk.product.x), 0.0);
}
