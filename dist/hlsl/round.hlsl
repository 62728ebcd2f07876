// Steradian 0.1.0, round: disks, ellipses, spheres, ellipsoids, tubes and lines, point and spot lights, for HLSL.
//
// #include or paste it; it has no macros and no resources.
// It needs these files before it, in this order: math.hlsl, polygon.hlsl.
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

// ==== light_elements ====

// Lights that are small against their distance and against the lobe: four elements in the place of the outline.
//
// Integrals along an outline cancel where the light is small: of the rounding of a unit direction, what is left is the
// (distance / size)^2-fold. A surface element has no such trouble. Four of them, each a quarter of the area, at
// center +- reach_a and center +- reach_b, have the light's area, centroid and second moments if the reaches are its
// principal deviations times the square root of 2, whatever its outline; so they integrate what is quadratic over the
// light exactly, and what is cubic too where the light is its own mirror image about its centroid.
//
// How far a lobe is from quadratic over a light, one number tells: t = deviation / distance * sharpness. The error, as a
// share of what the light would send from where the lobe is highest, is at most t^3 / 8: measured, over Lambert, Phong, GGX,
// Blinn-Phong and Beckmann lobes, parallelograms and triangles, at t up to 0.7 (test SteradianLightElements.ErrorIsBelowItsBound).
// Frame: any. Vectors are relative to the shading point.

// A light as four elements.
//   center            centroid of its area
//   reach_a, reach_b  conjugate half axes of the ellipse on which the elements lie
//   area              unit normal towards the side that shines here, times the area [m^2]
struct SteradianLightElements {
    float3 center;
    float3 reach_a;
    float3 reach_b;
    float3 area;
};

// One element as the point sees it.
//   direction    unit
//   solid_angle  not negative [sr]
struct SteradianLightElement {
    float3 direction;
    float solid_angle;
};

// Element i of 0 to 3.
//
// Degenerate: an element at the point is a zero direction and finite.
SteradianLightElement steradian_light_element_at(SteradianLightElements e, int i) {
    float side = float(1 - 2 * (i / 2));
    float3 r = e.center + e.reach_a * side;
    if (i == 1 || i == 3) {
        r = e.center + e.reach_b * side;
    }
    float inverse = rsqrt(max(dot(r, r), steradian_smallest_square()));
    SteradianLightElement element;
    element.direction = r * inverse;
    // The area first: squares of distances may leave the range of float.
    float quarter = max(-0.25 * dot(e.area, element.direction), 0.0);
    element.solid_angle = (quarter * inverse) * inverse;
    return element;
}

// Sharpness of a diffuse surface; others add their own to it.
//
// For the cosine and the elements' own foreshortening and distance.
float steradian_light_elements_diffuse_sharpness() { return 2.5; }

// Sharpness of a lobe that is about a mirrored direction as wide as a Gaussian of this standard deviation [rad].
float steradian_light_elements_sharpness(float deviation) {
    return steradian_light_elements_diffuse_sharpness() + 1.0 / max(deviation, 1.0e-12);
}

// Sharpness of a lobe of half vectors.
//
//   deviation  of the distribution, of slopes: alpha / 2 of GGX, alpha / sqrt(2) of Beckmann, 1 / sqrt(n) of Blinn-Phong
//   view_z     cosine of the view: half vectors turn the light by twice their angle along the view, by 2 v.h across it
float steradian_light_elements_half_vector_sharpness(float deviation, float view_z) {
    return steradian_light_elements_sharpness(2.0 * deviation * max(view_z, 1.0e-6));
}

// Sharpness of a power n of a cosine, whose deviation is 1 / sqrt(n).
float steradian_light_elements_power_sharpness(float n) {
    return steradian_light_elements_diffuse_sharpness() + sqrt(n);
}

// Limits of an integral along the outline, beyond which the elements are better.
//   roundings        how many roundings of a unit direction the integral makes, relative to the light's solid angle times
//                    its distance over its size
//   least_distance2  squared distance in the light's mean square deviations below which elements never serve: there t^3 / 8
//                    of the least sharpness exceeds the rounding of float
//   bias             error of the integral that is none of rounding, as the share that t^3 / 8 bounds
struct SteradianLightElementsLimits {
    float roundings;
    float least_distance2;
    float bias;
};

// Limits from their three numbers.
SteradianLightElementsLimits steradian_light_elements_limits(float roundings, float least_distance2, float bias) {
    SteradianLightElementsLimits limits;
    limits.roundings = roundings;
    limits.least_distance2 = least_distance2;
    limits.bias = bias;
    return limits;
}

// Lambert's edges: few roundings, since they add up vectors of the light's size.
SteradianLightElementsLimits steradian_light_elements_along_edges() { return steradian_light_elements_limits(2.0, 4000.0, 0.0); }

// Transformed cosines, cubatures without arcs, and a light's point that stands for it.
SteradianLightElementsLimits steradian_light_elements_transformed() { return steradian_light_elements_limits(8.0, 2000.0, 0.0); }

// Arcs: an edge subtracts numbers of the order of 1.
SteradianLightElementsLimits steradian_light_elements_along_arcs() { return steradian_light_elements_limits(128.0, 500.0, 0.0); }

// Arcs of half vectors: their bias makes the elements better from much nearer on.
SteradianLightElementsLimits steradian_light_elements_along_half_vectors(float bias) { return steradian_light_elements_limits(128.0, 30.0, bias); }

// Edges of a power n of a cosine: t^3 / 8 falls below the bias at a distance that depends on the lobe.
SteradianLightElementsLimits steradian_light_elements_along_power(float n, float bias) {
    float sharpness = steradian_light_elements_power_sharpness(n);
    return steradian_light_elements_limits(128.0, steradian_select(bias > 0.0, min(500.0, 4.0 * sharpness * sharpness), 500.0), bias);
}

// Bias of the cosine series: t^3 / 8 where the elements' error is as large.
//
// The series' error is that fraction of the full lobe for each half of an edge (moment_series.glsl). Over a light that is
// small against the lobe, it is that fraction of the light.
float steradian_light_elements_series_bias() { return 0.015625; }

// Bias of the longer cosine series.
float steradian_light_elements_series_high_bias() { return 0.008695652173913044; }

// Bias of Beckmann's arcs.
float steradian_light_elements_beckmann_bias() { return 0.005; }

// True where the elements are better than an integral along the outline.
//
//   normal           the surface's, unit
//   sharpness        of the lobe
//   roundings, bias  SteradianLightElementsLimits
//
// A light across the horizon is cut only by whole elements: there the outline serves as long as rounding leaves it a digit.
bool steradian_light_elements_serve(SteradianLightElements e, float3 normal, float sharpness, float roundings, float bias) {
    float unit = 6.0e-8;
    float inverse = rsqrt(max(dot(e.center, e.center), steradian_smallest_square()));
    float3 a = e.reach_a * inverse;
    float3 b = e.reach_b * inverse;
    float deviation2 = 0.5 * (dot(a, a) + dot(b, b));
    float deviation = sqrt(deviation2);
    float t = min(deviation * sharpness, 1.0e6);
    float bound = 0.125 * t * t * t;
    bool better = bound < bias || bound * deviation < roundings * unit;
    // The outline of most lights ends within twice the reach.
    bool whole = dot(e.center, normal) * inverse > 2.0 * (abs(dot(a, normal)) + abs(dot(b, normal)));
    return better && (whole || deviation2 < 8.0 * unit);
}

// Irradiance vector of radiance 1, of the elements above the horizon z = 0.
float3 steradian_light_elements_irradiance_vector(SteradianLightElements e) {
    float3 nowhere = float3(0.0, 0.0, 0.0);
    float3 sum = nowhere;
    for (int i = 0; i < 4; i++) {
        SteradianLightElement element = steradian_light_element_at(e, i);
        sum = sum + steradian_select(element.direction.z > 0.0, element.direction * element.solid_angle, nowhere);
    }
    return sum;
}

// ==== conic ====

// Arcs of conics in space: the boundary integral of irradiance along them, in closed form.
//
// A curve u(tau) = u0 + u1 tau + u2 tau^2, seen from the origin, bounds a region of directions; its share of the region's
// irradiance vector is  1/2 INT u x u' / |u|^2 dtau,  a quadratic over a quartic. The quartic |u|^2 is positive: its
// two conjugate pairs of roots, the poles, say where the curve passes the origin and how closely, and the integral is a
// sum of residues times logarithms. Straight edges, circles and ellipses are such curves, and so is the half vector of
// a light's edge stretched by a GGX surface (ggx_closed_form.glsl). docs/theory/ggx.md has the derivation.

// A prepared arc, in units of tau in which the poles' distances from 0 have the product 1.
//   u0..u2      the curve
//   begin, end  its ends in tau; equal where the arc has no length
//   scale       the unit: tau as the caller counted it is scale times tau here
//   z1, z2      poles: roots of |u|^2 with positive imaginary part
//   sweep       the angles under which the poles see the arc [rad], in [0, pi]
struct SteradianConicArc {
    float3 u0;
    float3 u1;
    float3 u2;
    float begin;
    float end;
    float scale;
    float2 z1;
    float2 z2;
    float2 sweep;
};

// The derivative of the quartic at its root z, formed from the roots: d4 (z - conj z)(z - o)(z - conj o). Formed from the
// coefficients it would cost float 5 to 40 times the error.
//
//   z, o     a root and the root of the other pair
float2 steradian_conic_slope(float2 z, float2 o, float d4) {
    float x = z.x - o.x;
    float y2 = (z.y - o.y) * (z.y + o.y);
    float s = 2.0 * d4 * z.y;
    return float2(-2.0 * x * z.y, x * x - y2) * s;
}

// One step of Durand and Kerner for the root z of u.u, evaluated from the vectors: the quartic's coefficients have lost
// the digits that small imaginary parts need.
//
//   returns  the new root, with positive imaginary part
//
// The step is at most half the way to the other root plus the height above the axis, so that no start runs away.
float2 steradian_conic_pole_step(SteradianConicArc arc, float2 z, float2 o, float d4) {
    float3 re = arc.u0 + arc.u1 * z.x + arc.u2 * (z.x * z.x - z.y * z.y);
    float3 im = (arc.u1 + arc.u2 * (2.0 * z.x)) * z.y;
    float2 value = float2(dot(re - im, re + im), 2.0 * dot(re, im));
    float2 step = steradian_complex_quotient(value, steradian_conic_slope(z, o, d4));
    float2 apart = z - o;
    float apart2 = dot(apart, apart);
    float longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * rsqrt(max(dot(step, step), steradian_smallest_divisor())), 1.0);
    bool free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    float2 next = z - steradian_select(free, step, float2(0.0, 0.0));
    return float2(next.x, max(abs(next.y), 1.0e-9));
}

// Gauss and Seidel's sweeps over the two poles until both stand still.
//
// Number of sweeps: 2 or 3 at ordinary widths and views; a pole much nearer to the axis than its start comes down by half a
// sweep, which makes up to 16 at alpha = 1.0e-4 and grazing views.
// Error: in float, poles to 1.0e-3 of their height at least, and since steps square, mostly to rounding.
SteradianQuarticPoles steradian_conic_polish_poles(SteradianConicArc arc, SteradianQuarticPoles start) {
    SteradianQuarticPoles poles = start;
    float d4 = dot(arc.u2, arc.u2);
    int sweeps = 16;
    float tolerance = 1.0e-6;
    bool moving = arc.end > arc.begin;
    for (int i = 0; i < sweeps; i++) {
        bool moves = steradian_mask_none();
        // One pole, then the other: each turn swaps them.
        for (int k = 0; k < 2; k++) {
            float2 z = steradian_conic_pole_step(arc, poles.z1, poles.z2, d4);
            float2 step = z - poles.z1;
            moves = moves || dot(step, step) > tolerance * z.y * z.y;
            z = steradian_select(moving, z, poles.z1);
            poles.z1 = poles.z2;
            poles.z2 = z;
        }
        moving = moving && moves;
        // At the end: devices that mask lanes instead of jumping would go through a sweep for nobody.
        if (!moving) {
            break;
        }
    }
    return poles;
}

// The angle under which a pole sees the arc [rad], in [0, pi].
float steradian_conic_sweep(float2 z, float begin, float end) {
    return steradian_trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}

// An arc in its unit, whose poles are still to be found: all of steradian_conic_prepare that costs little.
//
//   u0..u2      the curve; the origin must not lie on it
//   begin, end  ends in tau, begin <= end
//
// Degenerate: |u2| below 1.0e-6 |u0| (1.0e-12 in double) is replaced by a little of u0, which leaves the curve's direction at
// tau = 0 as it is.
SteradianConicArc steradian_conic_scaled(float3 u0, float3 u1, float3 u2, float begin, float end) {
    float least = 1.0e-12;
    float d0 = max(dot(u0, u0), steradian_smallest_divisor());
    float d4 = dot(u2, u2);
    float ratio = sqrt(d0 / max(d4, least * d0));
    SteradianConicArc arc;
    arc.scale = sqrt(ratio);
    arc.u0 = u0;
    arc.u1 = u1 * arc.scale;
    arc.u2 = steradian_select(d4 > least * d0, u2, u0 * sqrt(least)) * ratio;
    arc.begin = begin / arc.scale;
    arc.end = end / arc.scale;
    arc.z1 = float2(0.0, 1.0);
    arc.z2 = float2(0.0, 1.0);
    arc.sweep = float2(0.0, 0.0);
    return arc;
}

// The poles of a scaled arc.
SteradianQuarticPoles steradian_conic_poles(SteradianConicArc arc) {
    float inverse = 1.0 / max(dot(arc.u2, arc.u2), steradian_smallest_divisor());
    SteradianQuarticPoles poles = steradian_quartic_poles_approximate(
        dot(arc.u0, arc.u0) * inverse, 2.0 * dot(arc.u0, arc.u1) * inverse,
        (dot(arc.u1, arc.u1) + 2.0 * dot(arc.u0, arc.u2)) * inverse, 2.0 * dot(arc.u1, arc.u2) * inverse);
    return steradian_conic_polish_poles(arc, poles);
}

// A scaled arc and its poles, found now or kept from before: steradian_conic_prepare is steradian_conic_with_poles(arc, steradian_conic_poles(arc)).
SteradianConicArc steradian_conic_with_poles(SteradianConicArc scaled, SteradianQuarticPoles poles) {
    SteradianConicArc arc = scaled;
    arc.z1 = poles.z1;
    arc.z2 = poles.z2;
    arc.sweep = float2(steradian_conic_sweep(arc.z1, arc.begin, arc.end), steradian_conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}

// Prepares an arc. Arguments and degenerate case: steradian_conic_scaled.
SteradianConicArc steradian_conic_prepare(float3 u0, float3 u1, float3 u2, float begin, float end) {
    SteradianConicArc arc = steradian_conic_scaled(u0, u1, u2, begin, end);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}

// A place on an arc by its share of the angle C under which both poles together see it: in C the integrand is smooth
// wherever the arc passes.
//   tau      between the arc's begin and end
//   density  dC/dtau
struct SteradianConicNode {
    float tau;
    float density;
};

// The place where C is a given share of its way from the arc's begin to its end.
//
//   share    in [0, 1]
//
// C(tau) is the argument of (b1 + i (tau - p1))(b2 + i (tau - p2)) with poles p + i b, so that tau is the root of a quadratic.
SteradianConicNode steradian_conic_node(SteradianConicArc arc, float share) {
    float p1 = arc.z1.x;
    float p2 = arc.z2.x;
    float b1 = arc.z1.y;
    float b2 = arc.z2.y;
    float2 start = steradian_complex_product(float2(b1, arc.begin - p1), float2(b2, arc.begin - p2));
    float total = arc.sweep.x + arc.sweep.y;
    // The angle is in [0, 2 pi]: half a turn less, and the sign.
    float2 turned = steradian_complex_product(steradian_complex_sign(start), -steradian_complex_unit(share * total - steradian_pi()));
    float s = turned.y;
    float c = turned.x;
    float linear_term = c * (b1 + b2) - s * (p1 + p2);
    float constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    float root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    bool positive = linear_term >= 0.0;
    float top = steradian_select(positive, -2.0 * constant_term, root - linear_term);
    float bottom = steradian_select(positive, linear_term + root, 2.0 * s);
    bool usable = abs(bottom) > steradian_smallest_divisor();
    float tau = steradian_select(usable, top / steradian_select(usable, bottom, 1.0), arc.begin);
    SteradianConicNode node;
    node.tau = clamp(tau, arc.begin, arc.end);
    float x1 = node.tau - p1;
    float x2 = node.tau - p2;
    node.density = b1 / (x1 * x1 + b1 * b1) + b2 / (x2 * x2 + b2 * b2);
    return node;
}

// Half of INT u x u' / |u|^2 dtau as residues.
//
//   z, o     a pole and the other one
//   sweep    the angle under which z sees the arc
float3 steradian_conic_residue(SteradianConicArc arc, float2 z, float2 o, float sweep) {
    float3 n0 = cross(arc.u0, arc.u1);
    float3 n1 = cross(arc.u0, arc.u2) * 2.0;
    float3 n2 = cross(arc.u1, arc.u2);
    float3 re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    float3 im = (n1 + n2 * (2.0 * z.x)) * z.y;
    float x0 = arc.begin - z.x;
    float x1 = arc.end - z.x;
    float y2 = z.y * z.y;
    float2 logarithm = float2(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    float2 factor = steradian_complex_quotient(logarithm, steradian_conic_slope(z, o, dot(arc.u2, arc.u2)));
    return re * factor.x - im * factor.y;
}

// The same integral as steradian_conic_residue sums, by Gauss and Legendre in the angle C, for poles that nearly coincide, where residues
// cancel. 8 nodes, twice.
//
//   wanted   where the value counts; others may be left at 0
float3 steradian_conic_vector_approximate(SteradianConicArc arc, bool wanted) {
    float3 sum = float3(0.0, 0.0, 0.0);
    float total = arc.sweep.x + arc.sweep.y;
    for (int i = 0; i < 16; i++) {
        if (!wanted) {
            break;
        }
        int part = i / 8;
        float2 rule = steradian_gauss_legendre_node(8, i - 8 * part);
        SteradianConicNode node = steradian_conic_node(arc, 0.5 * (rule.x + float(part)));
        float3 u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
        float3 du = arc.u1 + arc.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), steradian_smallest_divisor())));
    }
    return sum;
}

// An arc's share of the irradiance vector: 1/2 INT u x u' / |u|^2 dtau [rad].
//
// Error: docs/measured/accuracy.md, "Float against double", conic vector.
float3 steradian_conic_vector(SteradianConicArc arc) {
    float3 e = steradian_conic_residue(arc, arc.z1, arc.z2, arc.sweep.x) + steradian_conic_residue(arc, arc.z2, arc.z1, arc.sweep.y);
    // Poles nearer to each other than this share of their heights, squared: residues lose the inverse of the share, and the
    // quadrature, whose nearest singularity recedes as poles meet, is good to the digits that remain.
    float close = 1.0e-2;
    float2 apart = arc.z1 - arc.z2;
    bool meet = dot(apart, apart) < close * arc.z1.y * arc.z2.y && arc.end > arc.begin;
    if (meet) {
        e = steradian_select(meet, steradian_conic_vector_approximate(arc, meet), e);
    }
    return e;
}

// ==== ellipse ====

// Disks and ellipses as lights, and the outlines of spheres and ellipsoids (ellipsoid.glsl), which are ellipses.
//
// An ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point, is a conic in tan(t/2): its irradiance
// is closed (conic.glsl), above the horizon too. For other lobes it becomes a polygon whose corners gather where the
// lobe is sharp.
// Frame: z the surface normal. Walk order: det(center, axis_a, axis_b) > 0, see steradian_ellipse_prepare.

// An ellipse, seen from the shading point.
struct SteradianEllipse {
    float3 center;
    float3 axis_a;
    float3 axis_b;
};

// Turns the axes so that the walk with growing t is in walk order.
//
//   axis_a, axis_b  any two conjugate half axes; they need not be orthogonal
SteradianEllipse steradian_ellipse_prepare(float3 center, float3 axis_a, float3 axis_b) {
    SteradianEllipse e;
    e.center = center;
    e.axis_a = axis_a;
    bool reversed = dot(center, cross(axis_a, axis_b)) < 0.0;
    e.axis_b = steradian_select(reversed, -axis_b, axis_b);
    return e;
}

// The same in the shading frame and in units of the distance, for any unit: squares of squares stay in the range of float.
SteradianEllipse steradian_ellipse_in_units(float3x3 frame, float3 center, float3 axis_a, float3 axis_b) {
    float size2 = dot(center, center) + dot(axis_a, axis_a) + dot(axis_b, axis_b);
    float unit = rsqrt(max(size2, steradian_smallest_divisor()));
    return steradian_ellipse_prepare(steradian_transform_transposed(frame, center) * unit, steradian_transform_transposed(frame, axis_a) * unit,
                           steradian_transform_transposed(frame, axis_b) * unit);
}

// The ellipse's area as four elements, for where it is small (light_elements.glsl).
//
//   e        of steradian_ellipse_prepare
SteradianLightElements steradian_ellipse_elements(SteradianEllipse e) {
    SteradianLightElements elements;
    elements.center = e.center;
    elements.reach_a = e.axis_a * 0.707106781186547524;
    elements.reach_b = e.axis_b * 0.707106781186547524;
    elements.area = cross(e.axis_b, e.axis_a) * steradian_pi();
    return elements;
}

// An arc of the ellipse about t = 0 (begin and end are tan(t/2)).
SteradianConicArc steradian_ellipse_arc(SteradianEllipse e, float begin, float end) {
    return steradian_conic_prepare(e.center + e.axis_a, e.axis_b * 2.0, e.center - e.axis_a, begin, end);
}

// Irradiance vector of the part of the ellipse above the horizon [rad]; z is the irradiance for radiance 1, in [0, pi].
//
//   e        of steradian_ellipse_prepare; the shading point is not in its plane
//
// Degenerate: an ellipse below the horizon, without area, or seen from its plane gives 0 up to rounding.
// Error: docs/measured/accuracy.md, "Float against double", ellipse. Exact: 3 arcs of the ellipse and one of the horizon.
float3 steradian_ellipse_irradiance_vector(SteradianEllipse e) {
    // Axes from the highest place: axis_a up the ellipse, axis_b level.
    float2 up = float2(e.axis_a.z, e.axis_b.z);
    float rise = sqrt(dot(up, up));
    float2 turn = steradian_select(rise > steradian_smallest_divisor(), up * (1.0 / max(rise, steradian_smallest_divisor())), float2(1.0, 0.0));
    SteradianEllipse level;
    level.center = e.center;
    level.axis_a = e.axis_a * turn.x + e.axis_b * turn.y;
    level.axis_b = e.axis_b * turn.x - e.axis_a * turn.y;

    // Above the horizon: |tan(t/2)| <= limit.
    float top = e.center.z + rise;
    float bottom = rise - e.center.z;
    bool shows = top > 0.0;
    bool cut = bottom > 0.0 && shows;
    float limit = sqrt(max(top, 0.0) / max(bottom, steradian_smallest_divisor()));
    limit = steradian_select(cut, limit, steradian_select(shows, 1.0e15, 0.0));
    bool more = limit > 1.0;
    float lower = steradian_select(more, 1.0 / max(limit, 1.0), 1.0);
    lower = steradian_select(limit > 1.0e14, 0.0, lower);
    SteradianEllipse turned = level;
    float begin = -min(limit, 1.0);
    float end = min(limit, 1.0);
    float3 sum = float3(0.0, 0.0, 0.0);
    float3 far_side = sum;
    // The arc about the highest place, and two that meet at the lowest.
    for (int i = 0; i < 3; i++) {
        float3 arc = steradian_conic_vector(steradian_ellipse_arc(turned, begin, end));
        if (i == 0) {
            sum = arc;
            turned.axis_a = -level.axis_a;
            turned.axis_b = -level.axis_b;
            begin = -1.0;
            end = -lower;
        } else {
            far_side = far_side + arc;
            begin = lower;
            end = 1.0;
        }
        if (!more) {
            break;
        }
    }
    sum = steradian_select(more, sum + far_side, sum);
    if (cut) {
        // Along the horizon, from where the walk goes down, at +limit, to where it comes up.
        float inverse = 1.0 / (1.0 + limit * limit);
        float3 middle = level.center + level.axis_a * ((1.0 - limit * limit) * inverse);
        float3 aside = level.axis_b * (2.0 * limit * inverse);
        float3 down = middle + aside;
        float3 back_up = middle - aside;
        float angle = steradian_trig_atan2(down.x * back_up.y - down.y * back_up.x, down.x * back_up.x + down.y * back_up.y);
        sum = steradian_select(cut, sum + float3(0.0, 0.0, 0.5 * angle), sum);
    }
    // Seen from its plane it may pass through the shading point, where the curve has no direction.
    float least = 1.0e-12;
    float size = sqrt(dot(e.center, e.center)) * sqrt(dot(e.axis_a, e.axis_a)) * sqrt(dot(e.axis_b, e.axis_b));
    bool seen = dot(e.center, cross(e.axis_a, e.axis_b)) > least * size;
    return float3(steradian_select(seen, sum.x, 0.0), steradian_select(seen, sum.y, 0.0), steradian_select(seen, clamp(sum.z, 0.0, steradian_pi()), 0.0));
}

// The same of an ellipse that is all above the horizon: without arcs, from the axes of the cone of directions to it.
//
//   e        of steradian_ellipse_prepare
//
// The cone's axes are those of B = a a' + b b' - c c' (a, b: half axes, c: centre), whose eigenvalues are -nu < 0 <= mu1, mu2. Along the
// axis of -nu the cone cuts the plane at distance 1 in an ellipse of half axes sqrt(mu / nu), and by symmetry the vector points along it:
// pi |det(a, b, c)| / sqrt(nu P) long, P = (mu1 + nu)(mu2 + nu). Newton finds nu from above, where the cubic is convex; the
// adjugate of B + nu, times c, is the axis, a sum whose terms all lie on c's side.
// Degenerate: an ellipse without area, or seen from its plane, gives 0.
// Error: next to the rim, at the share h of its reach, float loses a factor 1 / h.
// Source: the form factor of an ellipse from above its centre; this project for the axes.
float3 steradian_ellipse_whole_irradiance_vector(SteradianEllipse e) {
    float3 normal = cross(e.axis_a, e.axis_b);
    float3 across_a = cross(e.center, e.axis_a);
    float3 across_b = cross(e.center, e.axis_b);
    float c2 = dot(e.center, e.center);
    float det = dot(e.center, normal);
    float det2 = det * det;
    float t = dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b) - c2;
    float s = dot(normal, normal) - dot(across_a, across_a) - dot(across_b, across_b);
    float tolerance = 1.0e-7;
    float nu = c2;
    bool moving = steradian_mask_all();  // a lane that stands still stays so, whatever its neighbours do
    for (int i = 0; i < 24; i++) {
        float step = (((nu + t) * nu + s) * nu - det2) / max((3.0 * nu + 2.0 * t) * nu + s, steradian_smallest_divisor());
        float next = clamp(nu - step, 0.0, nu);
        bool still_moving = moving && nu - next > tolerance * nu;
        nu = steradian_select(moving, next, nu);
        moving = still_moving;
        if (!moving) {
            break;
        }
    }
    float3 axis = e.center * (nu * nu) + (cross(e.axis_a, across_a) + cross(e.axis_b, across_b)) * nu + normal * det;
    // |axis| = P |v.c| and axis.c = P (v.c)^2 with the unit axis v.
    float length2 = max(dot(axis, axis), steradian_smallest_square());
    float p = length2 / max(dot(axis, e.center), steradian_smallest_divisor());
    return axis * (steradian_pi() * det * rsqrt(max(length2 * nu * p, steradian_smallest_square())));
}

// A polygon about an ellipse: where its corners gather.
//   ellipse    prepared
//   turn       (cos, sin) of the t of the corner nearest to the lobe
//   beta       1: corners at equal steps of t; below, they gather about that corner
//   near       whether the point is near the rim: then half of the corners, in steps that grow with the distance from there
//   near_turn  (cos, sin) of the t of the rim's place next to the point
//   near_beta  half its distance, in units of t
struct SteradianEllipseFan {
    SteradianEllipse ellipse;
    float2 turn;
    float beta;
    bool near;
    float2 near_turn;
    float near_beta;
};

// The polygon whose corners stand at equal steps of t.
SteradianEllipseFan steradian_ellipse_fan(SteradianEllipse e) {
    SteradianEllipseFan fan;
    fan.ellipse = e;
    fan.turn = float2(1.0, 0.0);
    fan.beta = 1.0;
    fan.near = steradian_mask_none();
    fan.near_turn = float2(1.0, 0.0);
    fan.near_beta = 1.0;
    return fan;
}

// A vector from the shading point to the rim.
float3 steradian_ellipse_rim(SteradianEllipse e, float2 turn) { return e.center + e.axis_a * turn.x + e.axis_b * turn.y; }

// (cos t, sin t) of the rim's place nearest to the shading point.
//
// The nearest of eight places, and four of Newton's steps of at most 0.4 from there, or down the slope where the distance curves
// the other way. A place that is a little off costs nothing.
float2 steradian_ellipse_nearest(SteradianEllipse e) {
    float2 nearest = float2(1.0, 0.0);
    float3 rim = steradian_ellipse_rim(e, nearest);
    float least = dot(rim, rim);
    for (int k = 1; k < 8; k++) {
        float2 turn = steradian_complex_unit(0.25 * steradian_pi() * float(k - 8 * (k / 5)));
        rim = steradian_ellipse_rim(e, turn);
        float distance2 = dot(rim, rim);
        nearest = steradian_select(distance2 < least, turn, nearest);
        least = min(distance2, least);
    }
    for (int i = 0; i < 4; i++) {
        rim = steradian_ellipse_rim(e, nearest);
        float3 tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        float slope = dot(rim, tangent);
        float curvature = dot(tangent, tangent) - dot(rim, rim - e.center);
        float step = -slope / max(abs(curvature), 1.0e-3 * dot(tangent, tangent) + steradian_smallest_divisor());
        nearest = steradian_complex_product(nearest, steradian_complex_unit(clamp(step, -0.4, 0.4)));
    }
    return nearest;
}

// Gathers half of the corners where the point is near the rim, closer than a fifth of its distance from the far end: what a
// fixed share of the radius stands out, or leaves out, would else be the half of what is seen.
//
// From the rim's nearest place, steps as long as half the distance, growing with it by a constant factor: to the eye all
// are alike. The other half stays with the lobe, which may meet the rim elsewhere. Of 32 corners, errors: docs/theory/ggx.md, section 6.
SteradianEllipseFan steradian_ellipse_fan_near(SteradianEllipseFan usual) {
    SteradianEllipse e = usual.ellipse;
    SteradianEllipseFan fan = usual;
    // From further than one and a half of its reach, no end of the rim is five times as far as another.
    bool may_be = dot(e.center, e.center) < 2.25 * (dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b));
    if (may_be) {
        float2 nearest = steradian_ellipse_nearest(e);
        float3 rim = steradian_ellipse_rim(e, nearest);
        float3 opposite = steradian_ellipse_rim(e, -nearest);
        float3 tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        float distance2 = dot(rim, rim);
        fan.near = may_be && distance2 < 0.04 * dot(opposite, opposite);
        fan.near_turn = nearest;
        fan.near_beta = clamp(0.5 * sqrt(distance2 / max(dot(tangent, tangent), steradian_smallest_divisor())), 1.0e-6, 1.0);
    }
    return fan;
}

// The polygon whose corners gather where the lobe's axis meets the ellipse's rim.
//
//   r        unit axis of the lobe
//   width    of the lobe [rad]: 1/sqrt(n + 1) of Phong
//
// A map of the circle onto itself (Moebius) concentrates the corners; how far, the distance of the axis from the rim and
// the lobe's width over the rim's size say.
// Source: this project; table of errors in docs/theory/ggx.md.
SteradianEllipseFan steradian_ellipse_fan_concentrated(SteradianEllipse e, float3 r, float width) {
    float3 normal = cross(e.axis_a, e.axis_b);
    float n2 = max(dot(normal, normal), steradian_smallest_divisor());
    float height = dot(e.center, normal);  // > 0 in walk order
    float along = dot(r, normal);
    // The place at which the axis meets the plane, in units of the half axes: (x, y) / along.
    float3 across = r * height - e.center * along;
    float2 place = float2(dot(across, cross(e.axis_b, normal)), dot(across, cross(normal, e.axis_a))) * (1.0 / n2);
    float size2 = dot(place, place);
    bool off_centre = size2 > 1.0e-20;
    SteradianEllipseFan fan = steradian_ellipse_fan(e);
    fan.turn = steradian_select(off_centre, place * rsqrt(max(size2, 1.0e-20)), float2(1.0, 0.0));
    float3 rim = e.center + e.axis_a * fan.turn.x + e.axis_b * fan.turn.y;
    float3 tangent = e.axis_b * fan.turn.x - e.axis_a * fan.turn.y;
    float reach = min(sqrt(size2) / max(along, 1.0e-12), 1.0e6);
    float blur = 1.6 * width * sqrt(dot(rim, rim) / max(dot(tangent, tangent), steradian_smallest_divisor()));
    float beta = sqrt(0.5 * (1.0 - reach) * (1.0 - reach) + min(blur * blur, 1.0e6));
    fan.beta = steradian_select(along > 0.0, clamp(beta, 0.05, 1.0), 1.0);
    return steradian_ellipse_fan_near(fan);
}

// (cos t/2, sin t/2) where tan(t/2) = near_beta sinh(x), t from the rim's place next to the point.
float2 steradian_ellipse_near_place(SteradianEllipseFan fan, float x) {
    float power = exp(x);
    return steradian_complex_sign(float2(1.0, 0.5 * fan.near_beta * (power - 1.0 / power)));
}

// The share of the corners up to a place of a rim that is near: the mean of the lobe's share and of the near place's.
//
//   x        as in steradian_ellipse_near_place
//   lobe     (cos t/2, sin t/2) of the lobe's place, from the same origin
//   reach    the x up to which, on either side, the near place has corners
float steradian_ellipse_near_share(SteradianEllipseFan fan, float x, float2 lobe, float reach) {
    float2 w = steradian_ellipse_near_place(fan, x);
    float2 from_lobe = float2(w.x * lobe.x + w.y * lobe.y, (w.y * lobe.x - w.x * lobe.y) / fan.beta);
    float2 start = float2(-lobe.y, -lobe.x / fan.beta);  // opposite the near place
    float angle = steradian_trig_atan2_unwrapped(start.x * from_lobe.y - start.y * from_lobe.x, start.x * from_lobe.x + start.y * from_lobe.y);
    return 0.5 * (angle * steradian_inverse_pi() + clamp(0.5 + 0.5 * x / reach, 0.0, 1.0));
}

// (cos t/2, sin t/2) of corner k of count of a rim that is near, from the rim's place next to the point.
//
// The share's inverse, by a bracket that eight halvings leave and a straight line in it: a corner that is a little off costs nothing,
// and none passes another.
float2 steradian_ellipse_near_corner(SteradianEllipseFan fan, int k, int count) {
    float far_side = 4.0 / fan.near_beta;
    float reach = log(far_side + sqrt(far_side * far_side + 1.0));
    float2 apart = float2(fan.turn.x * fan.near_turn.x + fan.turn.y * fan.near_turn.y, fan.turn.y * fan.near_turn.x - fan.turn.x * fan.near_turn.y);
    float2 lobe = float2(1.0 + apart.x, apart.y);
    lobe = steradian_select(dot(lobe, lobe) > 1.0e-10, steradian_complex_sign(lobe), float2(0.0, 1.0));
    int turn = k / count;  // -1, as 0, stands for the corners before the first
    if (k < 0) {
        turn = -1;
    }
    float share = (float(k - turn * count) + 0.5) / float(count);
    float low = -reach - 3.0;
    float high = reach + 3.0;
    float low_share = 0.0;
    float high_share = 1.0;
    for (int i = 0; i < 8; i++) {
        float middle = 0.5 * (low + high);
        float value = steradian_ellipse_near_share(fan, middle, lobe, reach);
        bool below = value < share;
        low = steradian_select(below, middle, low);
        low_share = steradian_select(below, value, low_share);
        high = steradian_select(below, high, middle);
        high_share = steradian_select(below, high_share, value);
    }
    float rest = clamp((share - low_share) / max(high_share - low_share, 1.0e-6), 0.0, 1.0);
    return steradian_ellipse_near_place(fan, low + rest * (high - low));
}

// (cos t, sin t) of corner k of count, counted from the middle one.
float2 steradian_ellipse_corner(SteradianEllipseFan fan, int k, int count) {
    float half_angle = steradian_pi() * (float(k) / float(count) - 0.5);
    float2 u = steradian_complex_unit(half_angle);
    float2 w = steradian_complex_sign(float2(u.x, fan.beta * u.y));
    float2 corner = steradian_complex_product(steradian_complex_product(w, w), fan.turn);
    if (fan.near) {
        w = steradian_ellipse_near_corner(fan, k, count);
        corner = steradian_select(fan.near, steradian_complex_product(steradian_complex_product(w, w), fan.near_turn), corner);
    }
    return corner;
}

// The angle from one corner to the next over its sine: what equal area needs; the angle is taken up to 2.6.
float steradian_ellipse_gap(float2 from_corner, float2 to_corner) {
    float c = dot(from_corner, to_corner);
    float s = from_corner.x * to_corner.y - from_corner.y * to_corner.x;
    float angle = steradian_trig_atan2_unwrapped(s, c);
    angle = clamp(angle, 0.0, 2.6);
    float sine = steradian_select(c > -0.856888753368947234 && s > 0.0, s, 0.515501371821464235);
    return steradian_select(angle < 1.0e-3, 1.0, angle / max(sine, 1.0e-4));
}

// A corner, as a vector from the shading point.
//
//   gaps     sum of steradian_ellipse_gap to the corner before it and to the one after it
//
// Pushed out so that the polygon has about the ellipse's area: inscribed, 8 corners lose several percent.
float3 steradian_ellipse_corner_between(SteradianEllipseFan fan, float2 here, float gaps) {
    float radius = sqrt(0.5 * gaps);
    SteradianEllipse e = fan.ellipse;
    return e.center + (e.axis_a * here.x + e.axis_b * here.y) * radius;
}

// The corner between two others, as a vector from the shading point.
//
//   before, here, after  steradian_ellipse_corner of three neighbours
float3 steradian_ellipse_pushed_corner(SteradianEllipseFan fan, float2 before, float2 here, float2 after) {
    return steradian_ellipse_corner_between(fan, here, steradian_ellipse_gap(before, here) + steradian_ellipse_gap(here, after));
}

// Corner k of the polygon with count corners (even, 6 to 64), k from 0, as a vector from the shading point, in walk order.
//
// Error: docs/measured/accuracy.md, "Float against double", ellipse.
float3 steradian_ellipse_fan_corner(SteradianEllipseFan fan, int k, int count) {
    return steradian_ellipse_pushed_corner(fan, steradian_ellipse_corner(fan, k - 1, count), steradian_ellipse_corner(fan, k, count), steradian_ellipse_corner(fan, k + 1, count));
}

// ==== capsule ====

// Tubes as lights: a capsule is all that lies within a radius of a segment; and the line that it becomes as the radius goes
// to 0.
//
// Seen from outside, a capsule fills the convex hull of two round caps, the images of its end balls. Two planes through the
// point touch both balls; the outline is an arc about each cap and two great circles between them. All four pieces have
// antiderivatives in elementary functions: the irradiance needs no more than four arc tangents. Where the point sees one
// cap within the other, it sees a sphere.
// Frame: z the surface normal; origin at the shading point. Any unit of length, but float wants distances near 1.

// The capsule as four elements, for where it is small: the strip of its cylinder, which is equally wide from all directions
// across, and the half balls at its ends. Each has its second moment along the axis.
//
//   center   its middle, from the shading point
//   axis     from one end to the other
//
// Degenerate: ends that meet make a sphere.
SteradianLightElements steradian_capsule_elements(float3 center, float3 axis, float radius) {
    float r2 = radius * radius;
    float length2 = dot(axis, axis);
    float3 along = axis * rsqrt(max(length2, steradian_smallest_square()));
    float3 sight = center * rsqrt(max(dot(center, center), steradian_smallest_square()));
    float3 across = sight - along * dot(along, sight);
    float3 aside = cross(along, sight);
    float strip = 2.0 * radius * sqrt(length2);
    float balls = steradian_pi() * r2;
    float share = 2.0 / max(strip + balls, steradian_smallest_square());
    SteradianLightElements e;
    e.center = center;
    e.area = -(across * (rsqrt(max(dot(across, across), 1.0e-12)) * strip) + sight * balls);
    e.reach_a = along * sqrt(share * (strip * length2 * 0.0833333333333333333 + balls * (length2 + r2) * 0.25));
    e.reach_b = aside * (rsqrt(max(dot(aside, aside), 1.0e-12)) * sqrt(share * r2 * (strip * 0.333333333333333333 + balls * 0.25)));
    return e;
}

// A capsule, seen from the shading point. Where the point sees a sphere, both ends are the nearer one and `along` is any
// direction across: half of the sphere's outline belongs to each.
//   end_a, end_b  centres of the end balls
//   along         unit, from end_a to end_b
//   toward        unit, from the point to the nearest place of the axis' line
//   at_a, at_b    places of the ends along the line, counted from there; span their distance
//   height        distance of the line
//   outside       whether the point is; inside there is no light
struct SteradianCapsule {
    float3 end_a;
    float3 end_b;
    float3 along;
    float3 toward;
    float at_a;
    float at_b;
    float span;
    float height;
    float radius;
    bool outside;
};

// Prepares a capsule.
//
//   end_a, end_b  centres of the end balls, from the shading point
//   radius        not negative
//
// Degenerate: ends that meet make a sphere. A point inside gives finite members.
SteradianCapsule steradian_capsule_prepare(float3 end_a, float3 end_b, float radius) {
    float3 difference = end_b - end_a;
    float span2 = dot(difference, difference);
    float a2 = dot(end_a, end_a);
    float b2 = dot(end_b, end_b);
    float3 nearer = steradian_select(a2 < b2, end_a, end_b);
    float nearer2 = min(a2, b2);
    float3 along = difference * rsqrt(max(span2, steradian_smallest_square()));
    float3 moment = cross(nearer, along);
    float height2 = dot(moment, moment);
    float at_a = dot(end_a, along);
    float at_b = dot(end_b, along);
    float radius2 = radius * radius;
    // From within the endless cylinder, the nearer ball hides the other.
    bool tube = height2 > radius2 && span2 > steradian_smallest_divisor();
    bool beside = at_a < 0.0 && at_b > 0.0 && span2 > steradian_smallest_divisor();

    float nearest = sqrt(nearer2);
    float3 direction = steradian_select(nearer2 > steradian_smallest_square(), nearer * rsqrt(max(nearer2, steradian_smallest_square())), float3(0.0, 0.0, 1.0));
    float3x3 across = steradian_frame_from_normal(direction);
    SteradianCapsule c;
    c.end_a = steradian_select(tube, end_a, nearer);
    c.end_b = steradian_select(tube, end_b, nearer);
    c.along = steradian_select(tube, along, steradian_transform(across, float3(1.0, 0.0, 0.0)));
    c.toward = steradian_select(tube, cross(along, moment) * rsqrt(max(height2, steradian_smallest_square())), direction);
    c.at_a = steradian_select(tube, at_a, 0.0);
    c.at_b = steradian_select(tube, at_b, 0.0);
    c.span = steradian_select(tube, sqrt(span2), 0.0);
    c.height = steradian_select(tube, sqrt(height2), nearest);
    c.radius = radius;
    c.outside = steradian_select(beside, height2, nearer2) > radius2;
    return c;
}

// The same in units of the distance, for ends in any unit: squares of squares stay in the range of float.
SteradianCapsule steradian_capsule_in_units(float3 end_a, float3 end_b, float radius) {
    float unit = rsqrt(max(dot(end_a, end_a) + dot(end_b, end_b) + radius * radius, steradian_smallest_divisor()));
    return steradian_capsule_prepare(end_a * unit, end_b * unit, radius * unit);
}

// Distance of the two touching planes' lines of touch from the point: sqrt(height^2 - radius^2).
float steradian_capsule_touch(SteradianCapsule c) {
    return sqrt(max((c.height - c.radius) * (c.height + c.radius), 0.0));
}

// Half the angle of an end's arc [rad], in [0, pi], counted about the cap's centre. Those of the two ends sum to pi where they
// meet.
//
//   place     of the end along the axis, outward: -at_a of end_a, at_b of end_b
//   distance  of the end's centre
float steradian_capsule_half_angle(SteradianCapsule c, float place, float distance) {
    return steradian_trig_atan2(steradian_capsule_touch(c), c.radius * place / max(distance, steradian_smallest_length()));
}

// Irradiance vector of a line's or a capsule's two great circles and the chords of its arcs, over 2 radius / height.
//
//   angle    of the great circles [rad]
//   share    of the chords' length in the width: sqrt(1 - (radius / height)^2), 1 for a line; the others as in Capsule
//
// The chords' parts nearly cancel for a short or distant light; their difference is formed on paper.
float3 steradian_capsule_straight_part(float3 along, float3 toward, float at_a, float at_b, float span, float height, float angle, float share) {
    float h2 = height * height;
    float both = (h2 + at_a * at_a) * (h2 + at_b * at_b);
    float chords = share * span * height / max(both, steradian_smallest_square());
    return toward * (0.5 * (angle + chords * (h2 - at_a * at_b))) + along * (0.5 * chords * height * (at_a + at_b));
}

// Irradiance vector of the whole capsule, the horizon left out [sr].
//
//   c        prepared; the point is outside
//
// Degenerate: radius 0 gives 0.
// Error: relative to the value, but for what height and at_a, at_b lose of a capsule seen end-on.
// Source: this project; Stokes' theorem as in conic.glsl. Small circles: Lambert 1760.
float3 steradian_capsule_whole_vector(SteradianCapsule c) {
    float touch = steradian_capsule_touch(c);
    float angle = steradian_trig_atan2_unwrapped(c.span * touch, touch * touch + c.at_a * c.at_b);
    float share = touch / max(c.height, steradian_smallest_length());
    float slope = c.radius / max(c.height, steradian_smallest_length());
    float3 e = steradian_capsule_straight_part(c.along, c.toward, c.at_a, c.at_b, c.span, c.height, angle, share) * (2.0 * slope);
    float a2 = max(dot(c.end_a, c.end_a), steradian_smallest_square());
    float b2 = max(dot(c.end_b, c.end_b), steradian_smallest_square());
    float ia = rsqrt(a2);
    float ib = rsqrt(b2);
    float sine_a = c.radius * ia;
    float sine_b = c.radius * ib;
    e = e + c.end_a * (sine_a * sine_a * ia * steradian_capsule_half_angle(c, -c.at_a, sqrt(a2)));
    return e + c.end_b * (sine_b * sine_b * ib * steradian_capsule_half_angle(c, c.at_b, sqrt(b2)));
}

// Adds the arc of an end to a walk, clipped to the horizon z = 0.
//
//   center      of the end's ball
//   middle      unit, across `center`: where the arc's middle lies
//   half_angle  of the arc [rad], in [0, pi]
//   start, finish  unit directions of its ends, in walk order
//
// Where the arc crosses is decided by the ends' signs alone, as for straight edges (steradian_polygon_add_edge), so that both agree at
// the joints; an arc between two ends on one side crosses twice or not at all.
SteradianPolygonWalk steradian_capsule_add_arc(SteradianPolygonWalk walk, float3 center, float radius, float3 middle, float half_angle, float3 start, float3 finish) {
    float d2 = max(dot(center, center), steradian_smallest_square());
    float distance = sqrt(d2);
    float inverse = 1.0 / distance;
    float tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    float root = sqrt(max((radius - center.z) * (radius + center.z), 0.0));

    // Angles about the cap's centre, from its highest point: of the horizon and of the arc's middle (mirrored: >= 0).
    float horizon = steradian_trig_atan2(distance * root, -tangent * center.z);
    horizon = steradian_select(root > 0.0, horizon, steradian_select(center.z > 0.0, steradian_pi(), 0.0));
    float turn = steradian_trig_atan2(abs(middle.x * center.y - middle.y * center.x) * inverse, middle.z);
    float low = turn - half_angle;
    float high = turn + half_angle;
    float seen = max(min(high, horizon) - max(low, -horizon), 0.0) + max(high - (2.0 * steradian_pi() - horizon), 0.0);

    // The crossings of the cap's rim: azimuths left and right of the cap's own.
    float flat2 = max(center.x * center.x + center.y * center.y, steradian_smallest_square());
    float2 azimuth = float2(center.x, center.y) * rsqrt(flat2);
    float2 tilt = steradian_complex_sign(float2(tangent, root));
    float2 comes = steradian_complex_product(azimuth, tilt);
    float2 goes = steradian_complex_product(azimuth, float2(tilt.x, -tilt.y));

    bool start_below = start.z < 0.0;
    bool finish_below = finish.z < 0.0;
    bool meets = root > 0.0;
    bool twice = meets && ((!start_below && !finish_below && high > steradian_pi()) || (start_below && finish_below && turn < half_angle));
    bool comes_up = twice || (start_below && !finish_below);
    bool goes_down = twice || (finish_below && !start_below);
    float3 nowhere = float3(0.0, 0.0, 0.0);
    float3 chord = steradian_select(start_below, nowhere, start) - steradian_select(finish_below, nowhere, finish);
    chord = chord + steradian_select(comes_up, float3(comes.x, comes.y, 0.0), nowhere);
    chord = chord - steradian_select(goes_down, float3(goes.x, goes.y, 0.0), nowhere);

    float sine = radius * inverse;
    SteradianPolygonWalk next = walk;
    next.edges = walk.edges + center * (0.5 * sine * sine * inverse * seen) -
                 cross(center, chord) * (0.5 * tangent * inverse * inverse);
    float2 up = steradian_select(comes_up, comes, float2(1.0, 0.0));
    float2 down = steradian_select(goes_down, float2(goes.x, -goes.y), float2(1.0, 0.0));
    next.horizon = steradian_complex_product(walk.horizon, steradian_complex_product(up, down));
    return next;
}

// Irradiance vector of the part of the capsule above the horizon [sr]; z is the irradiance for radiance 1, in [0, pi].
//
//   c        of steradian_capsule_prepare
//
// Degenerate: a capsule below the horizon and a point inside give 0.
// Error: docs/measured/accuracy.md, "Float against double", capsule. Exact: two arcs, two edges and an arc of the horizon.
float3 steradian_capsule_irradiance_vector(SteradianCapsule c) {
    float3 e = steradian_capsule_whole_vector(c);
    bool cut = min(c.end_a.z, c.end_b.z) < c.radius;
    if (cut) {
        float a2 = dot(c.end_a, c.end_a);
        float b2 = dot(c.end_b, c.end_b);
        float r2 = c.radius * c.radius;
        float3 side = cross(c.toward, c.along);
        float3 inward = c.toward * (r2 / max(c.height, steradian_smallest_length()));
        float3 aside = side * (c.radius * steradian_capsule_touch(c) / max(c.height, steradian_smallest_length()));
        float ia = rsqrt(max(a2 - r2, steradian_smallest_square()));
        float ib = rsqrt(max(b2 - r2, steradian_smallest_square()));
        float3 a_left = (c.end_a - inward + aside) * ia;
        float3 a_right = (c.end_a - inward - aside) * ia;
        float3 b_left = (c.end_b - inward + aside) * ib;
        float3 b_right = (c.end_b - inward - aside) * ib;
        float da = sqrt(max(a2, steradian_smallest_square()));
        float db = sqrt(max(b2, steradian_smallest_square()));
        float3 a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
        float3 b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
        SteradianPolygonWalk walk = steradian_polygon_begin();
        walk = steradian_capsule_add_arc(walk, c.end_a, c.radius, a_middle, steradian_capsule_half_angle(c, -c.at_a, da), a_left, a_right);
        walk = steradian_polygon_add_edge(walk, a_right, b_right);
        walk = steradian_capsule_add_arc(walk, c.end_b, c.radius, b_middle, steradian_capsule_half_angle(c, c.at_b, db), b_right, b_left);
        walk = steradian_polygon_add_edge(walk, b_left, a_left);
        bool shows = max(c.end_a.z, c.end_b.z) > -c.radius;
        float3 above = steradian_polygon_irradiance_vector(walk, steradian_mask_none());
        e = steradian_select(cut, steradian_select(shows, above, float3(0.0, 0.0, 0.0)), e);
    }
    e = float3(e.x, e.y, clamp(e.z, 0.0, steradian_pi()));
    return steradian_select(c.outside, e, float3(0.0, 0.0, 0.0));
}

// Irradiance vector of the part of a line above the horizon [1 / m]: the limit of a capsule's over its width 2 radius.
//
//   end_a, end_b  from the shading point
//
// Degenerate: a line towards the point, or of no length, gives 0; one that passes through the point a finite value.
// Error: docs/measured/accuracy.md, "Float against double", line. A capsule differs by at most docs/eval.md's bound.
// Source: as for any linear light; here the limit of steradian_capsule_whole_vector.
float3 steradian_line_irradiance_vector(float3 end_a, float3 end_b) {
    float wa = abs(end_a.z);
    float wb = abs(end_b.z);
    float3 crossing = (end_a * wb + end_b * wa) * (1.0 / max(wa + wb, steradian_smallest_square()));
    float3 a = steradian_select(end_a.z < 0.0, crossing, end_a);
    float3 b = steradian_select(end_b.z < 0.0, crossing, end_b);
    float3 difference = b - a;
    float span2 = dot(difference, difference);
    float3 along = difference * rsqrt(max(span2, steradian_smallest_square()));
    float3 moment = cross(steradian_select(dot(a, a) < dot(b, b), a, b), along);
    float height2 = max(dot(moment, moment), steradian_smallest_square());
    float height = sqrt(height2);
    float3 toward = cross(along, moment) * (1.0 / height);
    float span = sqrt(span2);
    float at_a = dot(a, along);
    float at_b = dot(b, along);
    float angle = steradian_trig_atan2_unwrapped(span * height, height2 + at_a * at_b);
    float3 e = steradian_capsule_straight_part(along, toward, at_a, at_b, span, height, angle, 1.0) * (1.0 / height);
    e = float3(e.x, e.y, max(e.z, 0.0));
    return steradian_select(end_a.z <= 0.0 && end_b.z <= 0.0, float3(0.0, 0.0, 0.0), e);
}

// Corners about the arc of one end.
//   center, middle, side  the rim is center + middle cos t + side sin t, vectors from the shading point
//   last                  (cos, sin) of half the arc's angle, where it ends; it begins at (last.x, -last.y)
//   corners               how many, 1 or more
//   turn                  (cos, sin) of the place nearest to the lobe
//   beta                  1: equal steps; below, corners gather there
//   first, step           of the arc's parameter, half a turn a corner
struct SteradianCapsuleEnd {
    float3 center;
    float3 middle;
    float3 side;
    float2 last;
    float corners;
    float2 turn;
    float beta;
    float first;
    float step;
};

// A polygon about a capsule's outline: straight edges stay straight, each arc becomes a chain of corners.
struct SteradianCapsuleFan {
    SteradianCapsuleEnd a;
    SteradianCapsuleEnd b;
};

// Prepares the arc of one end as a single step; steradian_capsule_fan divides it.
//
//   center      of the ball
//   middle      unit, across `center`, where the arc's middle lies
//   r, width    the lobe's unit axis and width [rad], as for steradian_ellipse_fan_concentrated
SteradianCapsuleEnd steradian_capsule_end(float3 center, float radius, float3 middle, float half_angle, float3 r, float width) {
    float d2 = max(dot(center, center), steradian_smallest_square());
    float inverse = rsqrt(d2);
    float sine = max(radius * inverse, steradian_smallest_length());
    float cosine2 = max(1.0 - sine * sine, steradian_smallest_length());
    float cosine = sqrt(cosine2);
    float3 axis = center * inverse;
    float3 side = cross(axis, middle);
    SteradianCapsuleEnd end;
    end.center = center * cosine2;
    end.middle = middle * (radius * cosine);
    end.side = side * (radius * cosine);
    end.last = steradian_complex_unit(half_angle);

    // The place at which the lobe's axis meets the rim's plane, in units of the rim's radius.
    float along = dot(r, axis);
    float2 place = float2(dot(r, middle), dot(r, side)) * (cosine / (sine * max(along, 1.0e-12)));
    float nearest = clamp(steradian_trig_atan2(place.y, place.x), -half_angle, half_angle);
    end.turn = steradian_complex_unit(nearest);
    float2 apart = place - end.turn;
    float blur = min(1.6 * width / sine, 1.0e3);
    float beta = sqrt(min(0.5 * dot(apart, apart), 1.0e6) + blur * blur);
    end.beta = steradian_select(along > 0.0, clamp(beta, 0.05, 1.0), 1.0);

    float2 low = steradian_complex_unit(-0.5 * (half_angle + nearest));
    float2 high = steradian_complex_unit(0.5 * (half_angle - nearest));
    end.first = steradian_trig_atan2(low.y, end.beta * low.x);
    end.step = steradian_trig_atan2(high.y, end.beta * high.x) - end.first;
    end.corners = 1.0;
    return end;
}

// (cos t, sin t) of corner j of an end, in the middle of its step.
//
// The outer ones lie on the straight edges' continuation and keep within 0.35 of the arc's ends: of 0.35, 0.5 and 0.7 the one
// with the smallest errors in the test CapsulePolygons.
float2 steradian_capsule_corner(SteradianCapsuleEnd end, float j) {
    float2 u = steradian_complex_unit(clamp(end.first + end.step * (j + 0.5), -steradian_pi(), steradian_pi()));
    float2 w = steradian_complex_sign(float2(u.x, end.beta * u.y));
    float2 corner = steradian_complex_product(steradian_complex_product(w, w), end.turn);
    float2 limit = float2(0.939372712847378920, 0.342897807455451364);  // (cos, sin) of 0.35
    bool outer_low = j < 0.5;
    bool outer_high = j > end.corners - 1.5;
    float2 low = float2(end.last.x, -end.last.y);
    corner = steradian_select(outer_low && dot(corner, low) < limit.x, steradian_complex_product(low, limit), corner);
    corner = steradian_select(outer_high && dot(corner, end.last) < limit.x, steradian_complex_product(end.last, float2(limit.x, -limit.y)), corner);
    return steradian_select(outer_low && outer_high, float2(1.0, 0.0), corner);
}

// The square of a corner's radius that equal area requires, for the step to its neighbour. With `outer`, the neighbour stands on a straight
// edge's continuation: its radius is given, and so is the area that it adds.
//
//   joint    (cos, sin) of the arc's end behind the neighbour
float steradian_capsule_gap(float2 corner, float2 neighbour, float2 joint, bool outer) {
    float cosine = dot(corner, neighbour);
    float sine = abs(corner.x * neighbour.y - corner.y * neighbour.x);
    float angle = clamp(steradian_trig_atan2(sine, cosine), 0.0, 2.6);
    sine = steradian_select(cosine > -0.856888753368947234, sine, 0.515501371821464235);
    float even = steradian_select(angle < 1.0e-3, 1.0, angle / max(sine, 1.0e-4));
    float c = max(dot(neighbour, joint), 0.5);
    float s = abs(neighbour.x * joint.y - neighbour.y * joint.x);
    float given = (even + (steradian_trig_atan2(s, c) - s / c) / max(sine, 1.0e-4)) * c;
    given = steradian_select(angle < 1.0e-3, 1.0, max(given, 0.5));
    return steradian_select(outer, given * given, even);
}

// Corner j of an end, as a vector from the shading point.
float3 steradian_capsule_end_corner(SteradianCapsuleEnd end, float j) {
    float2 here = steradian_capsule_corner(end, j);
    float2 joint = float2(end.last.x, -end.last.y);
    bool joins = j < 1.5;
    bool outer_low = j < 0.5;
    bool outer_high = j > end.corners - 1.5;
    float outer = 1.0 / max(dot(here, steradian_select(outer_low, joint, end.last)), 0.5);
    float gaps = 0.0;
    // The corner before, and the one after.
    for (int i = 0; i < 2; i++) {
        gaps = gaps + steradian_capsule_gap(here, steradian_capsule_corner(end, j + float(2 * i - 1)), joint, joins);
        joint = end.last;
        joins = j > end.corners - 2.5;
    }
    float radius = steradian_select(outer_low || outer_high, outer, sqrt(0.5 * gaps));
    return end.center + (end.middle * here.x + end.side * here.y) * radius;
}

// Prepares a polygon about a capsule.
//
//   c        prepared; the point is outside
//   r        unit axis of the lobe
//   width    of the lobe [rad]: 1/sqrt(n + 1) of Phong
//   count    of all corners, 6 or more; each end has its share of the steps, at least one
SteradianCapsuleFan steradian_capsule_fan(SteradianCapsule c, float3 r, float width, int count) {
    float da = sqrt(max(dot(c.end_a, c.end_a), steradian_smallest_square()));
    float db = sqrt(max(dot(c.end_b, c.end_b), steradian_smallest_square()));
    float angle_a = steradian_capsule_half_angle(c, -c.at_a, da);
    float angle_b = steradian_capsule_half_angle(c, c.at_b, db);
    float3 a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
    float3 b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
    SteradianCapsuleFan fan;
    fan.a = steradian_capsule_end(c.end_a, c.radius, a_middle, angle_a, r, width);
    fan.b = steradian_capsule_end(c.end_b, c.radius, b_middle, angle_b, r, width);
    float share = fan.a.step / max(fan.a.step + fan.b.step, steradian_smallest_length());
    fan.a.corners = 1.0 + floor(0.5 + float(count - 2) * share);
    fan.b.corners = float(count) - fan.a.corners;
    fan.a.step = fan.a.step / fan.a.corners;
    fan.b.step = fan.b.step / fan.b.corners;
    return fan;
}

// Corner k of the polygon, k from 0, as a vector from the shading point, in walk order. Only its direction counts: the
// corners of the two ends lie in different planes.
//
// Error: see docs/theory/ggx.md, "Round lights".
float3 steradian_capsule_fan_corner(SteradianCapsuleFan fan, int k) {
    bool first = float(k) < fan.a.corners;
    SteradianCapsuleEnd end;
    end.center = steradian_select(first, fan.a.center, fan.b.center);
    end.middle = steradian_select(first, fan.a.middle, fan.b.middle);
    end.side = steradian_select(first, fan.a.side, fan.b.side);
    end.last = steradian_select(first, fan.a.last, fan.b.last);
    end.corners = steradian_select(first, fan.a.corners, fan.b.corners);
    end.turn = steradian_select(first, fan.a.turn, fan.b.turn);
    end.beta = steradian_select(first, fan.a.beta, fan.b.beta);
    end.first = steradian_select(first, fan.a.first, fan.b.first);
    end.step = steradian_select(first, fan.a.step, fan.b.step);
    return steradian_capsule_end_corner(end, steradian_select(first, float(k), float(k) - fan.a.corners));
}

// ==== ellipsoid ====

// Spheres and ellipsoids as lights: their outline, seen from a point, is a planar ellipse.

// The ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point [m], and whether it can be seen.
struct SteradianEllipsoidOutline {
    float3 center;
    float3 axis_a;
    float3 axis_b;
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
SteradianEllipsoidOutline steradian_ellipsoid_outline(float3 to_center, float3x3 s, float3x3 inverse) {
    float3 p = -steradian_transform(inverse, to_center);
    float d2 = dot(p, p);
    float safe = max(d2, 1.000001);
    float inverse_d = rsqrt(safe);
    float3 k = p * rsqrt(max(d2, steradian_smallest_divisor()));
    float rho = sqrt(1.0 - 1.0 / safe);
    float3x3 frame = steradian_frame_from_normal(k);
    float3 a = steradian_transform(frame, float3(rho, 0.0, 0.0));
    float3 b = steradian_transform(frame, float3(0.0, rho, 0.0));
    SteradianEllipsoidOutline outline;
    outline.center = to_center + steradian_transform(s, k * inverse_d);
    outline.axis_a = steradian_transform(s, a);
    outline.axis_b = steradian_transform(s, b);
    outline.outside = d2 > 1.000001;
    return outline;
}

// ==== far_light ====

// Far lights: one surface element in the place of a light, and how far off that and what is interpolated can be.
//
// The irradiance vector of a light does not depend on the receiver's normal as long as no horizon cuts the light, and is smooth
// in the receiver's place: so one polynomial over the places of many receivers may stand for the light. Both bounds here rest on one
// fact. Along any line, the k-th derivative of an element's vector over k! is at most (k + 1) |area| / R^(k + 2), R the distance: in the
// plane of the line the vector is a sum of 1/r^2 and 1/conj(r)^2, whose coefficients are U_k(cos) and k + 1. It is sharp towards the
// element, and holds for r / r^3, the vector of spheres and points, too.
// Frame: any. Vectors go from the receiver to the light. Errors are shares of |area| / R^2, what an element sends at most; R is
// the least distance between any receiver and any point of the light.

// Irradiance vector of an element of radiance 1; 0 from behind.
//
//   area  unit normal to the lit side, times the area [m^2]
//   r     to the element [m]
//
// Degenerate: at the element it is finite.
float3 steradian_far_element_vector(float3 area, float3 r) {
    float inverse = 1.0 / max(dot(r, r), steradian_smallest_divisor());
    return (r * inverse) * (max(-dot(area, r), 0.0) * inverse);
}

// Irradiance vector of a ball of radiance 1 that covers 1 m^2, wholly above the horizon: exact at any distance.
//
// Source: Lambert 1760. Degenerate: at the centre it is finite.
float3 steradian_far_ball_vector(float3 r) {
    float inverse = rsqrt(max(dot(r, r), steradian_smallest_divisor()));
    return (r * inverse) * (inverse * inverse);
}

// Error of one element in the light's centroid: what is linear over the light it has exactly.
//
//   deviation2  mean square distance of the light's points from the centroid
//   distance2   R^2 > 0
float steradian_far_error_of_one(float deviation2, float distance2) { return 3.0 * deviation2 / distance2; }

// Error of four elements with the light's first and second moments (light_elements.glsl).
//
//   third      mean cubed distances from the centroid, the light's and the elements' together
//   fourth     the same of fourth powers
//   symmetric  the light is its own mirror image about its centroid: then no cubic part is left
float steradian_far_error_of_four(float third, float fourth, bool symmetric, float distance2) {
    float by_third = 4.0 * third * rsqrt(distance2);
    float by_fourth = 5.0 * fourth / distance2;
    return steradian_select(symmetric, min(by_third, by_fourth), by_third) / distance2;
}

// Error of one element of a flat light, clamped to 0 below the receiver's horizon, where the horizon may cut the light.
//
//   top           greatest height of the light above the horizon [m], not negative
//   deviation_up  root of the mean square height of the light's points about its centroid's
//   deviation     root of deviation2
//   distance      R > 0
//
// The irradiance is the mean of max(height, 0) times k = -n'.r / r^4, whose slope is at most 3 / R^4. With k held, a mean differs from the
// centroid's value by half of the mean distance of the heights from it at most; what k changes is the second part. Nor do both
// exceed top / R.
float steradian_far_error_across_horizon(float top, float deviation_up, float deviation, float distance) {
    float inverse = 1.0 / distance;
    return min(top * inverse, (0.5 * deviation_up + 3.0 * top * deviation * inverse) * inverse);
}

// Error of a polynomial through Chebyshev's nodes along an axis.
//
//   nodes     their number, at least 1
//   reach     half the length of the interval
//   distance  R > 0
float steradian_far_error_of_nodes(int nodes, float reach, float distance) {
    float step = reach / (2.0 * distance);
    float power = 2.0 * float(nodes + 1);
    for (int i = 0; i < nodes; i++) {
        power = power * step;
    }
    return power;
}

// Upper bound of Schlick's (1 - v.h)^5 where the cosine of half the angle between view and light is at least c, and of how fast it
// turns with the light's direction [1/rad].
float2 steradian_far_grazing(float c) {
    float x = clamp(1.0 - c, 0.0, 1.0);
    float x2 = x * x;
    return float2(x2 * x2 * x, 2.5 * x2 * x2 * sqrt(max(1.0 - (1.0 - x) * (1.0 - x), 0.0)));
}

// Error of a polynomial through Chebyshev's nodes of the vector times (1 - v.h)^5, v the direction to an eye that stays.
//
//   view_distance  least distance of the receivers from the eye, > 0
//   least_square   least square of v.h over receivers and light: (1 + v.l) / 2
//
// By Cauchy's inequality over discs of three radii in the complex plane. A step of radius rho times a unit vector turns l by at most
// x = rho / (R - rho), v by y alike, and v.l by x + y + x y; the vector grows to 1 / (R - rho)^2.
// Degenerate: large where v.h may vanish, at the root's singularity.
float steradian_far_error_of_grazing_nodes(int nodes, float reach, float distance, float view_distance, float least_square) {
    float room = min(distance, view_distance);
    float best = 1.0e6;
    for (int k = 1; k < 4; k++) {
        float rho = 0.2 * float(k) * room;
        float x = rho / (distance - rho);
        float y = rho / (view_distance - rho);
        float left = least_square - 0.5 * (x + y + x * y);
        float grazing = steradian_far_grazing(sqrt(max(left, 0.0))).x;
        float step = reach / (2.0 * rho);
        float growth = 1.0 + x;
        float power = 2.0 * growth * growth * grazing;
        for (int i = 0; i < nodes; i++) {
            power = power * step;
        }
        best = steradian_select(left > 0.0, min(best, power), best);
    }
    return best;
}

// ==== punctual ====

// Point and spot lights of glTF (KHR_lights_punctual): what arrives at a point from one direction.
//
// Positions in metres, vectors in any one frame. A directional light needs no kernel: its illuminance arrives everywhere
// against its direction.

// The values of one light.
//   position        [m]
//   direction       unit: along which a spot shines
//   inverse_range2  1 / range^2 [1/m2]; 0 without a limit
//   spot_scale, spot_offset
//                   of the line from the cosine of the angle to the spot's axis to the square root of its fall-off: 1 / (cos
//                   inner - cos outer) and -cos outer times that; 0 and 1 of a point light
struct SteradianPunctualSource {
    float3 position;
    float3 direction;
    float inverse_range2;
    float spot_scale;
    float spot_offset;
};

// Light from one direction.
//   direction   unit, to the light
//   irradiance  across it, of a light of intensity 1 [1/m2]
struct SteradianPunctualIncident {
    float3 direction;
    float irradiance;
};

// Light of intensity 1 at the point p.
//
// Degenerate: distances below 1.0e-6 count as that; at none, the direction is the zero vector.
// Source: KHR_lights_punctual, "Range property" and "Inner and outer cone angles".
SteradianPunctualIncident steradian_punctual_incident(SteradianPunctualSource light, float3 p) {
    float3 to = light.position - p;
    float d2 = max(dot(to, to), 1.0e-12);
    SteradianPunctualIncident incident;
    incident.direction = to * rsqrt(d2);
    float q = d2 * light.inverse_range2;
    float within = clamp(1.0 - q * q, 0.0, 1.0);
    float spot = clamp(light.spot_offset - dot(light.direction, incident.direction) * light.spot_scale, 0.0, 1.0);
    incident.irradiance = within * (spot * spot) / d2;
    return incident;
}
