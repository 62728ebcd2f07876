// Steradian 0.1.0, round: disks, ellipses, spheres, ellipsoids, tubes and lines, point and spot lights, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl, polygon.wgsl.
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
    center: vec3f,
    reach_a: vec3f,
    reach_b: vec3f,
    area: vec3f,
}

// One element as the point sees it.
//   direction    unit
//   solid_angle  not negative [sr]
struct SteradianLightElement {
    direction: vec3f,
    solid_angle: f32,
}

// Element i of 0 to 3.
//
// Degenerate: an element at the point is a zero direction and finite.
fn steradian_light_element_at(e: SteradianLightElements, i: i32) -> SteradianLightElement {
    let side = f32(1 - 2 * (i / 2));
    var r = e.center + e.reach_a * side;
    if (i == 1 || i == 3) {
        r = e.center + e.reach_b * side;
    }
    let inverse = inverseSqrt(max(dot(r, r), steradian_smallest_square()));
    var element: SteradianLightElement;
    element.direction = r * inverse;
    // The area first: squares of distances may leave the range of float.
    let quarter = max(-0.25 * dot(e.area, element.direction), 0.0);
    element.solid_angle = (quarter * inverse) * inverse;
    return element;
}

// Sharpness of a diffuse surface; others add their own to it.
//
// For the cosine and the elements' own foreshortening and distance.
fn steradian_light_elements_diffuse_sharpness() -> f32 { return 2.5; }

// Sharpness of a lobe that is about a mirrored direction as wide as a Gaussian of this standard deviation [rad].
fn steradian_light_elements_sharpness(deviation: f32) -> f32 {
    return steradian_light_elements_diffuse_sharpness() + 1.0 / max(deviation, 1.0e-12);
}

// Sharpness of a lobe of half vectors.
//
//   deviation  of the distribution, of slopes: alpha / 2 of GGX, alpha / sqrt(2) of Beckmann, 1 / sqrt(n) of Blinn-Phong
//   view_z     cosine of the view: half vectors turn the light by twice their angle along the view, by 2 v.h across it
fn steradian_light_elements_half_vector_sharpness(deviation: f32, view_z: f32) -> f32 {
    return steradian_light_elements_sharpness(2.0 * deviation * max(view_z, 1.0e-6));
}

// Sharpness of a power n of a cosine, whose deviation is 1 / sqrt(n).
fn steradian_light_elements_power_sharpness(n: f32) -> f32 {
    return steradian_light_elements_diffuse_sharpness() + sqrt(n);
}

// Limits of an integral along the outline, beyond which the elements are better.
//   roundings        how many roundings of a unit direction the integral makes, relative to the light's solid angle times
//                    its distance over its size
//   least_distance2  squared distance in the light's mean square deviations below which elements never serve: there t^3 / 8
//                    of the least sharpness exceeds the rounding of float
//   bias             error of the integral that is none of rounding, as the share that t^3 / 8 bounds
struct SteradianLightElementsLimits {
    roundings: f32,
    least_distance2: f32,
    bias: f32,
}

// Limits from their three numbers.
fn steradian_light_elements_limits(roundings: f32, least_distance2: f32, bias: f32) -> SteradianLightElementsLimits {
    var limits: SteradianLightElementsLimits;
    limits.roundings = roundings;
    limits.least_distance2 = least_distance2;
    limits.bias = bias;
    return limits;
}

// Lambert's edges: few roundings, since they add up vectors of the light's size.
fn steradian_light_elements_along_edges() -> SteradianLightElementsLimits { return steradian_light_elements_limits(2.0, 4000.0, 0.0); }

// Transformed cosines, cubatures without arcs, and a light's point that stands for it.
fn steradian_light_elements_transformed() -> SteradianLightElementsLimits { return steradian_light_elements_limits(8.0, 2000.0, 0.0); }

// Arcs: an edge subtracts numbers of the order of 1.
fn steradian_light_elements_along_arcs() -> SteradianLightElementsLimits { return steradian_light_elements_limits(128.0, 500.0, 0.0); }

// Arcs of half vectors: their bias makes the elements better from much nearer on.
fn steradian_light_elements_along_half_vectors(bias: f32) -> SteradianLightElementsLimits { return steradian_light_elements_limits(128.0, 30.0, bias); }

// Edges of a power n of a cosine: t^3 / 8 falls below the bias at a distance that depends on the lobe.
fn steradian_light_elements_along_power(n: f32, bias: f32) -> SteradianLightElementsLimits {
    let sharpness = steradian_light_elements_power_sharpness(n);
    return steradian_light_elements_limits(128.0, select(500.0, min(500.0, 4.0 * sharpness * sharpness), bias > 0.0), bias);
}

// Bias of the cosine series: t^3 / 8 where the elements' error is as large.
//
// The series' error is that fraction of the full lobe for each half of an edge (moment_series.glsl). Over a light that is
// small against the lobe, it is that fraction of the light.
fn steradian_light_elements_series_bias() -> f32 { return 0.015625; }

// Bias of the longer cosine series.
fn steradian_light_elements_series_high_bias() -> f32 { return 0.008695652173913044; }

// Bias of Beckmann's arcs.
fn steradian_light_elements_beckmann_bias() -> f32 { return 0.005; }

// True where the elements are better than an integral along the outline.
//
//   normal           the surface's, unit
//   sharpness        of the lobe
//   roundings, bias  SteradianLightElementsLimits
//
// A light across the horizon is cut only by whole elements: there the outline serves as long as rounding leaves it a digit.
fn steradian_light_elements_serve(e: SteradianLightElements, normal: vec3f, sharpness: f32, roundings: f32, bias: f32) -> bool {
    let unit = 6.0e-8;
    let inverse = inverseSqrt(max(dot(e.center, e.center), steradian_smallest_square()));
    let a = e.reach_a * inverse;
    let b = e.reach_b * inverse;
    let deviation2 = 0.5 * (dot(a, a) + dot(b, b));
    let deviation = sqrt(deviation2);
    let t = min(deviation * sharpness, 1.0e6);
    let bound = 0.125 * t * t * t;
    let better = bound < bias || bound * deviation < roundings * unit;
    // The outline of most lights ends within twice the reach.
    let whole = dot(e.center, normal) * inverse > 2.0 * (abs(dot(a, normal)) + abs(dot(b, normal)));
    return better && (whole || deviation2 < 8.0 * unit);
}

// Irradiance vector of radiance 1, of the elements above the horizon z = 0.
fn steradian_light_elements_irradiance_vector(e: SteradianLightElements) -> vec3f {
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var sum = nowhere;
    for (var i: i32 = 0; i < 4; i++) {
        let element = steradian_light_element_at(e, i);
        sum = sum + select(nowhere, element.direction * element.solid_angle, element.direction.z > 0.0);
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
    u0: vec3f,
    u1: vec3f,
    u2: vec3f,
    begin: f32,
    end: f32,
    scale: f32,
    z1: vec2f,
    z2: vec2f,
    sweep: vec2f,
}

// The derivative of the quartic at its root z, formed from the roots: d4 (z - conj z)(z - o)(z - conj o). Formed from the
// coefficients it would cost float 5 to 40 times the error.
//
//   z, o     a root and the root of the other pair
fn steradian_conic_slope(z: vec2f, o: vec2f, d4: f32) -> vec2f {
    let x = z.x - o.x;
    let y2 = (z.y - o.y) * (z.y + o.y);
    let s = 2.0 * d4 * z.y;
    return vec2f(-2.0 * x * z.y, x * x - y2) * s;
}

// One step of Durand and Kerner for the root z of u.u, evaluated from the vectors: the quartic's coefficients have lost
// the digits that small imaginary parts need.
//
//   returns  the new root, with positive imaginary part
//
// The step is at most half the way to the other root plus the height above the axis, so that no start runs away.
fn steradian_conic_pole_step(arc: SteradianConicArc, z: vec2f, o: vec2f, d4: f32) -> vec2f {
    let re = arc.u0 + arc.u1 * z.x + arc.u2 * (z.x * z.x - z.y * z.y);
    let im = (arc.u1 + arc.u2 * (2.0 * z.x)) * z.y;
    let value = vec2f(dot(re - im, re + im), 2.0 * dot(re, im));
    var step = steradian_complex_quotient(value, steradian_conic_slope(z, o, d4));
    let apart = z - o;
    let apart2 = dot(apart, apart);
    let longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * inverseSqrt(max(dot(step, step), steradian_smallest_divisor())), 1.0);
    let free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    let next = z - select(vec2f(0.0, 0.0), step, free);
    return vec2f(next.x, max(abs(next.y), 1.0e-9));
}

// Gauss and Seidel's sweeps over the two poles until both stand still.
//
// Number of sweeps: 2 or 3 at ordinary widths and views; a pole much nearer to the axis than its start comes down by half a
// sweep, which makes up to 16 at alpha = 1.0e-4 and grazing views.
// Error: in float, poles to 1.0e-3 of their height at least, and since steps square, mostly to rounding.
fn steradian_conic_polish_poles(arc: SteradianConicArc, start: SteradianQuarticPoles) -> SteradianQuarticPoles {
    var poles = start;
    let d4 = dot(arc.u2, arc.u2);
    let sweeps: i32 = 16;
    let tolerance = 1.0e-6;
    var moving = arc.end > arc.begin;
    for (var i: i32 = 0; i < sweeps; i++) {
        var moves = steradian_mask_none();
        // One pole, then the other: each turn swaps them.
        for (var k: i32 = 0; k < 2; k++) {
            var z = steradian_conic_pole_step(arc, poles.z1, poles.z2, d4);
            let step = z - poles.z1;
            moves = moves || dot(step, step) > tolerance * z.y * z.y;
            z = select(poles.z1, z, moving);
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
fn steradian_conic_sweep(z: vec2f, begin: f32, end: f32) -> f32 {
    return steradian_trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}

// An arc in its unit, whose poles are still to be found: all of steradian_conic_prepare that costs little.
//
//   u0..u2      the curve; the origin must not lie on it
//   begin, end  ends in tau, begin <= end
//
// Degenerate: |u2| below 1.0e-6 |u0| (1.0e-12 in double) is replaced by a little of u0, which leaves the curve's direction at
// tau = 0 as it is.
fn steradian_conic_scaled(u0: vec3f, u1: vec3f, u2: vec3f, begin: f32, end: f32) -> SteradianConicArc {
    let least = 1.0e-12;
    let d0 = max(dot(u0, u0), steradian_smallest_divisor());
    let d4 = dot(u2, u2);
    let ratio = sqrt(d0 / max(d4, least * d0));
    var arc: SteradianConicArc;
    arc.scale = sqrt(ratio);
    arc.u0 = u0;
    arc.u1 = u1 * arc.scale;
    arc.u2 = select(u0 * sqrt(least), u2, d4 > least * d0) * ratio;
    arc.begin = begin / arc.scale;
    arc.end = end / arc.scale;
    arc.z1 = vec2f(0.0, 1.0);
    arc.z2 = vec2f(0.0, 1.0);
    arc.sweep = vec2f(0.0, 0.0);
    return arc;
}

// The poles of a scaled arc.
fn steradian_conic_poles(arc: SteradianConicArc) -> SteradianQuarticPoles {
    let inverse = 1.0 / max(dot(arc.u2, arc.u2), steradian_smallest_divisor());
    let poles = steradian_quartic_poles_approximate(
        dot(arc.u0, arc.u0) * inverse, 2.0 * dot(arc.u0, arc.u1) * inverse,
        (dot(arc.u1, arc.u1) + 2.0 * dot(arc.u0, arc.u2)) * inverse, 2.0 * dot(arc.u1, arc.u2) * inverse);
    return steradian_conic_polish_poles(arc, poles);
}

// A scaled arc and its poles, found now or kept from before: steradian_conic_prepare is steradian_conic_with_poles(arc, steradian_conic_poles(arc)).
fn steradian_conic_with_poles(scaled: SteradianConicArc, poles: SteradianQuarticPoles) -> SteradianConicArc {
    var arc = scaled;
    arc.z1 = poles.z1;
    arc.z2 = poles.z2;
    arc.sweep = vec2f(steradian_conic_sweep(arc.z1, arc.begin, arc.end), steradian_conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}

// Prepares an arc. Arguments and degenerate case: steradian_conic_scaled.
fn steradian_conic_prepare(u0: vec3f, u1: vec3f, u2: vec3f, begin: f32, end: f32) -> SteradianConicArc {
    let arc = steradian_conic_scaled(u0, u1, u2, begin, end);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}

// A place on an arc by its share of the angle C under which both poles together see it: in C the integrand is smooth
// wherever the arc passes.
//   tau      between the arc's begin and end
//   density  dC/dtau
struct SteradianConicNode {
    tau: f32,
    density: f32,
}

// The place where C is a given share of its way from the arc's begin to its end.
//
//   share    in [0, 1]
//
// C(tau) is the argument of (b1 + i (tau - p1))(b2 + i (tau - p2)) with poles p + i b, so that tau is the root of a quadratic.
fn steradian_conic_node(arc: SteradianConicArc, share: f32) -> SteradianConicNode {
    let p1 = arc.z1.x;
    let p2 = arc.z2.x;
    let b1 = arc.z1.y;
    let b2 = arc.z2.y;
    let start = steradian_complex_product(vec2f(b1, arc.begin - p1), vec2f(b2, arc.begin - p2));
    let total = arc.sweep.x + arc.sweep.y;
    // The angle is in [0, 2 pi]: half a turn less, and the sign.
    let turned = steradian_complex_product(steradian_complex_sign(start), -steradian_complex_unit(share * total - steradian_pi()));
    let s = turned.y;
    let c = turned.x;
    let linear_term = c * (b1 + b2) - s * (p1 + p2);
    let constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    let root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    let positive = linear_term >= 0.0;
    let top = select(root - linear_term, -2.0 * constant_term, positive);
    let bottom = select(2.0 * s, linear_term + root, positive);
    let usable = abs(bottom) > steradian_smallest_divisor();
    let tau = select(arc.begin, top / select(1.0, bottom, usable), usable);
    var node: SteradianConicNode;
    node.tau = clamp(tau, arc.begin, arc.end);
    let x1 = node.tau - p1;
    let x2 = node.tau - p2;
    node.density = b1 / (x1 * x1 + b1 * b1) + b2 / (x2 * x2 + b2 * b2);
    return node;
}

// Half of INT u x u' / |u|^2 dtau as residues.
//
//   z, o     a pole and the other one
//   sweep    the angle under which z sees the arc
fn steradian_conic_residue(arc: SteradianConicArc, z: vec2f, o: vec2f, sweep: f32) -> vec3f {
    let n0 = cross(arc.u0, arc.u1);
    let n1 = cross(arc.u0, arc.u2) * 2.0;
    let n2 = cross(arc.u1, arc.u2);
    let re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    let im = (n1 + n2 * (2.0 * z.x)) * z.y;
    let x0 = arc.begin - z.x;
    let x1 = arc.end - z.x;
    let y2 = z.y * z.y;
    let logarithm = vec2f(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    let factor = steradian_complex_quotient(logarithm, steradian_conic_slope(z, o, dot(arc.u2, arc.u2)));
    return re * factor.x - im * factor.y;
}

// The same integral as steradian_conic_residue sums, by Gauss and Legendre in the angle C, for poles that nearly coincide, where residues
// cancel. 8 nodes, twice.
//
//   wanted   where the value counts; others may be left at 0
fn steradian_conic_vector_approximate(arc: SteradianConicArc, wanted: bool) -> vec3f {
    var sum = vec3f(0.0, 0.0, 0.0);
    let total = arc.sweep.x + arc.sweep.y;
    for (var i: i32 = 0; i < 16; i++) {
        if (!wanted) {
            break;
        }
        let part: i32 = i / 8;
        let rule = steradian_gauss_legendre_node(8, i - 8 * part);
        let node = steradian_conic_node(arc, 0.5 * (rule.x + f32(part)));
        let u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
        let du = arc.u1 + arc.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), steradian_smallest_divisor())));
    }
    return sum;
}

// An arc's share of the irradiance vector: 1/2 INT u x u' / |u|^2 dtau [rad].
//
// Error: docs/measured/accuracy.md, "Float against double", conic vector.
fn steradian_conic_vector(arc: SteradianConicArc) -> vec3f {
    var e = steradian_conic_residue(arc, arc.z1, arc.z2, arc.sweep.x) + steradian_conic_residue(arc, arc.z2, arc.z1, arc.sweep.y);
    // Poles nearer to each other than this share of their heights, squared: residues lose the inverse of the share, and the
    // quadrature, whose nearest singularity recedes as poles meet, is good to the digits that remain.
    let close = 1.0e-2;
    let apart = arc.z1 - arc.z2;
    let meet = dot(apart, apart) < close * arc.z1.y * arc.z2.y && arc.end > arc.begin;
    if (meet) {
        e = select(e, steradian_conic_vector_approximate(arc, meet), meet);
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
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
}

// Turns the axes so that the walk with growing t is in walk order.
//
//   axis_a, axis_b  any two conjugate half axes; they need not be orthogonal
fn steradian_ellipse_prepare(center: vec3f, axis_a: vec3f, axis_b: vec3f) -> SteradianEllipse {
    var e: SteradianEllipse;
    e.center = center;
    e.axis_a = axis_a;
    let reversed = dot(center, cross(axis_a, axis_b)) < 0.0;
    e.axis_b = select(axis_b, -axis_b, reversed);
    return e;
}

// The same in the shading frame and in units of the distance, for any unit: squares of squares stay in the range of float.
fn steradian_ellipse_in_units(frame: mat3x3f, center: vec3f, axis_a: vec3f, axis_b: vec3f) -> SteradianEllipse {
    let size2 = dot(center, center) + dot(axis_a, axis_a) + dot(axis_b, axis_b);
    let unit = inverseSqrt(max(size2, steradian_smallest_divisor()));
    return steradian_ellipse_prepare(steradian_transform_transposed(frame, center) * unit, steradian_transform_transposed(frame, axis_a) * unit,
                           steradian_transform_transposed(frame, axis_b) * unit);
}

// The ellipse's area as four elements, for where it is small (light_elements.glsl).
//
//   e        of steradian_ellipse_prepare
fn steradian_ellipse_elements(e: SteradianEllipse) -> SteradianLightElements {
    var elements: SteradianLightElements;
    elements.center = e.center;
    elements.reach_a = e.axis_a * 0.707106781186547524;
    elements.reach_b = e.axis_b * 0.707106781186547524;
    elements.area = cross(e.axis_b, e.axis_a) * steradian_pi();
    return elements;
}

// An arc of the ellipse about t = 0 (begin and end are tan(t/2)).
fn steradian_ellipse_arc(e: SteradianEllipse, begin: f32, end: f32) -> SteradianConicArc {
    return steradian_conic_prepare(e.center + e.axis_a, e.axis_b * 2.0, e.center - e.axis_a, begin, end);
}

// Irradiance vector of the part of the ellipse above the horizon [rad]; z is the irradiance for radiance 1, in [0, pi].
//
//   e        of steradian_ellipse_prepare; the shading point is not in its plane
//
// Degenerate: an ellipse below the horizon, without area, or seen from its plane gives 0 up to rounding.
// Error: docs/measured/accuracy.md, "Float against double", ellipse. Exact: 3 arcs of the ellipse and one of the horizon.
fn steradian_ellipse_irradiance_vector(e: SteradianEllipse) -> vec3f {
    // Axes from the highest place: axis_a up the ellipse, axis_b level.
    let up = vec2f(e.axis_a.z, e.axis_b.z);
    let rise = sqrt(dot(up, up));
    let turn = select(vec2f(1.0, 0.0), up * (1.0 / max(rise, steradian_smallest_divisor())), rise > steradian_smallest_divisor());
    var level: SteradianEllipse;
    level.center = e.center;
    level.axis_a = e.axis_a * turn.x + e.axis_b * turn.y;
    level.axis_b = e.axis_b * turn.x - e.axis_a * turn.y;

    // Above the horizon: |tan(t/2)| <= limit.
    let top = e.center.z + rise;
    let bottom = rise - e.center.z;
    let shows = top > 0.0;
    let cut = bottom > 0.0 && shows;
    var limit = sqrt(max(top, 0.0) / max(bottom, steradian_smallest_divisor()));
    limit = select(select(0.0, 1.0e15, shows), limit, cut);
    let more = limit > 1.0;
    var lower = select(1.0, 1.0 / max(limit, 1.0), more);
    lower = select(lower, 0.0, limit > 1.0e14);
    var turned = level;
    var begin = -min(limit, 1.0);
    var end = min(limit, 1.0);
    var sum = vec3f(0.0, 0.0, 0.0);
    var far_side = sum;
    // The arc about the highest place, and two that meet at the lowest.
    for (var i: i32 = 0; i < 3; i++) {
        let arc = steradian_conic_vector(steradian_ellipse_arc(turned, begin, end));
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
    sum = select(sum, sum + far_side, more);
    if (cut) {
        // Along the horizon, from where the walk goes down, at +limit, to where it comes up.
        let inverse = 1.0 / (1.0 + limit * limit);
        let middle = level.center + level.axis_a * ((1.0 - limit * limit) * inverse);
        let aside = level.axis_b * (2.0 * limit * inverse);
        let down = middle + aside;
        let back_up = middle - aside;
        let angle = steradian_trig_atan2(down.x * back_up.y - down.y * back_up.x, down.x * back_up.x + down.y * back_up.y);
        sum = select(sum, sum + vec3f(0.0, 0.0, 0.5 * angle), cut);
    }
    // Seen from its plane it may pass through the shading point, where the curve has no direction.
    let least = 1.0e-12;
    let size = sqrt(dot(e.center, e.center)) * sqrt(dot(e.axis_a, e.axis_a)) * sqrt(dot(e.axis_b, e.axis_b));
    let seen = dot(e.center, cross(e.axis_a, e.axis_b)) > least * size;
    return vec3f(select(0.0, sum.x, seen), select(0.0, sum.y, seen), select(0.0, clamp(sum.z, 0.0, steradian_pi()), seen));
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
fn steradian_ellipse_whole_irradiance_vector(e: SteradianEllipse) -> vec3f {
    let normal = cross(e.axis_a, e.axis_b);
    let across_a = cross(e.center, e.axis_a);
    let across_b = cross(e.center, e.axis_b);
    let c2 = dot(e.center, e.center);
    let det = dot(e.center, normal);
    let det2 = det * det;
    let t = dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b) - c2;
    let s = dot(normal, normal) - dot(across_a, across_a) - dot(across_b, across_b);
    let tolerance = 1.0e-7;
    var nu = c2;
    var moving = steradian_mask_all();  // a lane that stands still stays so, whatever its neighbours do
    for (var i: i32 = 0; i < 24; i++) {
        let step = (((nu + t) * nu + s) * nu - det2) / max((3.0 * nu + 2.0 * t) * nu + s, steradian_smallest_divisor());
        let next = clamp(nu - step, 0.0, nu);
        let still_moving = moving && nu - next > tolerance * nu;
        nu = select(nu, next, moving);
        moving = still_moving;
        if (!moving) {
            break;
        }
    }
    let axis = e.center * (nu * nu) + (cross(e.axis_a, across_a) + cross(e.axis_b, across_b)) * nu + normal * det;
    // |axis| = P |v.c| and axis.c = P (v.c)^2 with the unit axis v.
    let length2 = max(dot(axis, axis), steradian_smallest_square());
    let p = length2 / max(dot(axis, e.center), steradian_smallest_divisor());
    return axis * (steradian_pi() * det * inverseSqrt(max(length2 * nu * p, steradian_smallest_square())));
}

// A polygon about an ellipse: where its corners gather.
//   ellipse    prepared
//   turn       (cos, sin) of the t of the corner nearest to the lobe
//   beta       1: corners at equal steps of t; below, they gather about that corner
//   near       whether the point is near the rim: then half of the corners, in steps that grow with the distance from there
//   near_turn  (cos, sin) of the t of the rim's place next to the point
//   near_beta  half its distance, in units of t
struct SteradianEllipseFan {
    ellipse: SteradianEllipse,
    turn: vec2f,
    beta: f32,
    near: bool,
    near_turn: vec2f,
    near_beta: f32,
}

// The polygon whose corners stand at equal steps of t.
fn steradian_ellipse_fan(e: SteradianEllipse) -> SteradianEllipseFan {
    var fan: SteradianEllipseFan;
    fan.ellipse = e;
    fan.turn = vec2f(1.0, 0.0);
    fan.beta = 1.0;
    fan.near = steradian_mask_none();
    fan.near_turn = vec2f(1.0, 0.0);
    fan.near_beta = 1.0;
    return fan;
}

// A vector from the shading point to the rim.
fn steradian_ellipse_rim(e: SteradianEllipse, turn: vec2f) -> vec3f { return e.center + e.axis_a * turn.x + e.axis_b * turn.y; }

// (cos t, sin t) of the rim's place nearest to the shading point.
//
// The nearest of eight places, and four of Newton's steps of at most 0.4 from there, or down the slope where the distance curves
// the other way. A place that is a little off costs nothing.
fn steradian_ellipse_nearest(e: SteradianEllipse) -> vec2f {
    var nearest = vec2f(1.0, 0.0);
    var rim = steradian_ellipse_rim(e, nearest);
    var least = dot(rim, rim);
    for (var k: i32 = 1; k < 8; k++) {
        let turn = steradian_complex_unit(0.25 * steradian_pi() * f32(k - 8 * (k / 5)));
        rim = steradian_ellipse_rim(e, turn);
        let distance2 = dot(rim, rim);
        nearest = select(nearest, turn, distance2 < least);
        least = min(distance2, least);
    }
    for (var i: i32 = 0; i < 4; i++) {
        rim = steradian_ellipse_rim(e, nearest);
        let tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        let slope = dot(rim, tangent);
        let curvature = dot(tangent, tangent) - dot(rim, rim - e.center);
        let step = -slope / max(abs(curvature), 1.0e-3 * dot(tangent, tangent) + steradian_smallest_divisor());
        nearest = steradian_complex_product(nearest, steradian_complex_unit(clamp(step, -0.4, 0.4)));
    }
    return nearest;
}

// Gathers half of the corners where the point is near the rim, closer than a fifth of its distance from the far end: what a
// fixed share of the radius stands out, or leaves out, would else be the half of what is seen.
//
// From the rim's nearest place, steps as long as half the distance, growing with it by a constant factor: to the eye all
// are alike. The other half stays with the lobe, which may meet the rim elsewhere. Of 32 corners, errors: docs/theory/ggx.md, section 6.
fn steradian_ellipse_fan_near(usual: SteradianEllipseFan) -> SteradianEllipseFan {
    let e = usual.ellipse;
    var fan = usual;
    // From further than one and a half of its reach, no end of the rim is five times as far as another.
    let may_be = dot(e.center, e.center) < 2.25 * (dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b));
    if (may_be) {
        let nearest = steradian_ellipse_nearest(e);
        let rim = steradian_ellipse_rim(e, nearest);
        let opposite = steradian_ellipse_rim(e, -nearest);
        let tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        let distance2 = dot(rim, rim);
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
fn steradian_ellipse_fan_concentrated(e: SteradianEllipse, r: vec3f, width: f32) -> SteradianEllipseFan {
    let normal = cross(e.axis_a, e.axis_b);
    let n2 = max(dot(normal, normal), steradian_smallest_divisor());
    let height = dot(e.center, normal);  // > 0 in walk order
    let along = dot(r, normal);
    // The place at which the axis meets the plane, in units of the half axes: (x, y) / along.
    let across = r * height - e.center * along;
    let place = vec2f(dot(across, cross(e.axis_b, normal)), dot(across, cross(normal, e.axis_a))) * (1.0 / n2);
    let size2 = dot(place, place);
    let off_centre = size2 > 1.0e-20;
    var fan = steradian_ellipse_fan(e);
    fan.turn = select(vec2f(1.0, 0.0), place * inverseSqrt(max(size2, 1.0e-20)), off_centre);
    let rim = e.center + e.axis_a * fan.turn.x + e.axis_b * fan.turn.y;
    let tangent = e.axis_b * fan.turn.x - e.axis_a * fan.turn.y;
    let reach = min(sqrt(size2) / max(along, 1.0e-12), 1.0e6);
    let blur = 1.6 * width * sqrt(dot(rim, rim) / max(dot(tangent, tangent), steradian_smallest_divisor()));
    let beta = sqrt(0.5 * (1.0 - reach) * (1.0 - reach) + min(blur * blur, 1.0e6));
    fan.beta = select(1.0, clamp(beta, 0.05, 1.0), along > 0.0);
    return steradian_ellipse_fan_near(fan);
}

// (cos t/2, sin t/2) where tan(t/2) = near_beta sinh(x), t from the rim's place next to the point.
fn steradian_ellipse_near_place(fan: SteradianEllipseFan, x: f32) -> vec2f {
    let power = exp(x);
    return steradian_complex_sign(vec2f(1.0, 0.5 * fan.near_beta * (power - 1.0 / power)));
}

// The share of the corners up to a place of a rim that is near: the mean of the lobe's share and of the near place's.
//
//   x        as in steradian_ellipse_near_place
//   lobe     (cos t/2, sin t/2) of the lobe's place, from the same origin
//   reach    the x up to which, on either side, the near place has corners
fn steradian_ellipse_near_share(fan: SteradianEllipseFan, x: f32, lobe: vec2f, reach: f32) -> f32 {
    let w = steradian_ellipse_near_place(fan, x);
    let from_lobe = vec2f(w.x * lobe.x + w.y * lobe.y, (w.y * lobe.x - w.x * lobe.y) / fan.beta);
    let start = vec2f(-lobe.y, -lobe.x / fan.beta);  // opposite the near place
    let angle = steradian_trig_atan2_unwrapped(start.x * from_lobe.y - start.y * from_lobe.x, start.x * from_lobe.x + start.y * from_lobe.y);
    return 0.5 * (angle * steradian_inverse_pi() + clamp(0.5 + 0.5 * x / reach, 0.0, 1.0));
}

// (cos t/2, sin t/2) of corner k of count of a rim that is near, from the rim's place next to the point.
//
// The share's inverse, by a bracket that eight halvings leave and a straight line in it: a corner that is a little off costs nothing,
// and none passes another.
fn steradian_ellipse_near_corner(fan: SteradianEllipseFan, k: i32, count: i32) -> vec2f {
    let far_side = 4.0 / fan.near_beta;
    let reach = log(far_side + sqrt(far_side * far_side + 1.0));
    let apart = vec2f(fan.turn.x * fan.near_turn.x + fan.turn.y * fan.near_turn.y, fan.turn.y * fan.near_turn.x - fan.turn.x * fan.near_turn.y);
    var lobe = vec2f(1.0 + apart.x, apart.y);
    lobe = select(vec2f(0.0, 1.0), steradian_complex_sign(lobe), dot(lobe, lobe) > 1.0e-10);
    var turn: i32 = k / count;  // -1, as 0, stands for the corners before the first
    if (k < 0) {
        turn = -1;
    }
    let share = (f32(k - turn * count) + 0.5) / f32(count);
    var low = -reach - 3.0;
    var high = reach + 3.0;
    var low_share = 0.0;
    var high_share = 1.0;
    for (var i: i32 = 0; i < 8; i++) {
        let middle = 0.5 * (low + high);
        let value = steradian_ellipse_near_share(fan, middle, lobe, reach);
        let below = value < share;
        low = select(low, middle, below);
        low_share = select(low_share, value, below);
        high = select(middle, high, below);
        high_share = select(value, high_share, below);
    }
    let rest = clamp((share - low_share) / max(high_share - low_share, 1.0e-6), 0.0, 1.0);
    return steradian_ellipse_near_place(fan, low + rest * (high - low));
}

// (cos t, sin t) of corner k of count, counted from the middle one.
fn steradian_ellipse_corner(fan: SteradianEllipseFan, k: i32, count: i32) -> vec2f {
    let half_angle = steradian_pi() * (f32(k) / f32(count) - 0.5);
    let u = steradian_complex_unit(half_angle);
    var w = steradian_complex_sign(vec2f(u.x, fan.beta * u.y));
    var corner = steradian_complex_product(steradian_complex_product(w, w), fan.turn);
    if (fan.near) {
        w = steradian_ellipse_near_corner(fan, k, count);
        corner = select(corner, steradian_complex_product(steradian_complex_product(w, w), fan.near_turn), fan.near);
    }
    return corner;
}

// The angle from one corner to the next over its sine: what equal area needs; the angle is taken up to 2.6.
fn steradian_ellipse_gap(from_corner: vec2f, to_corner: vec2f) -> f32 {
    let c = dot(from_corner, to_corner);
    let s = from_corner.x * to_corner.y - from_corner.y * to_corner.x;
    var angle = steradian_trig_atan2_unwrapped(s, c);
    angle = clamp(angle, 0.0, 2.6);
    let sine = select(0.515501371821464235, s, c > -0.856888753368947234 && s > 0.0);
    return select(angle / max(sine, 1.0e-4), 1.0, angle < 1.0e-3);
}

// A corner, as a vector from the shading point.
//
//   gaps     sum of steradian_ellipse_gap to the corner before it and to the one after it
//
// Pushed out so that the polygon has about the ellipse's area: inscribed, 8 corners lose several percent.
fn steradian_ellipse_corner_between(fan: SteradianEllipseFan, here: vec2f, gaps: f32) -> vec3f {
    let radius = sqrt(0.5 * gaps);
    let e = fan.ellipse;
    return e.center + (e.axis_a * here.x + e.axis_b * here.y) * radius;
}

// The corner between two others, as a vector from the shading point.
//
//   before, here, after  steradian_ellipse_corner of three neighbours
fn steradian_ellipse_pushed_corner(fan: SteradianEllipseFan, before: vec2f, here: vec2f, after: vec2f) -> vec3f {
    return steradian_ellipse_corner_between(fan, here, steradian_ellipse_gap(before, here) + steradian_ellipse_gap(here, after));
}

// Corner k of the polygon with count corners (even, 6 to 64), k from 0, as a vector from the shading point, in walk order.
//
// Error: docs/measured/accuracy.md, "Float against double", ellipse.
fn steradian_ellipse_fan_corner(fan: SteradianEllipseFan, k: i32, count: i32) -> vec3f {
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
fn steradian_capsule_elements(center: vec3f, axis: vec3f, radius: f32) -> SteradianLightElements {
    let r2 = radius * radius;
    let length2 = dot(axis, axis);
    let along = axis * inverseSqrt(max(length2, steradian_smallest_square()));
    let sight = center * inverseSqrt(max(dot(center, center), steradian_smallest_square()));
    let across = sight - along * dot(along, sight);
    let aside = cross(along, sight);
    let strip = 2.0 * radius * sqrt(length2);
    let balls = steradian_pi() * r2;
    let share = 2.0 / max(strip + balls, steradian_smallest_square());
    var e: SteradianLightElements;
    e.center = center;
    e.area = -(across * (inverseSqrt(max(dot(across, across), 1.0e-12)) * strip) + sight * balls);
    e.reach_a = along * sqrt(share * (strip * length2 * 0.0833333333333333333 + balls * (length2 + r2) * 0.25));
    e.reach_b = aside * (inverseSqrt(max(dot(aside, aside), 1.0e-12)) * sqrt(share * r2 * (strip * 0.333333333333333333 + balls * 0.25)));
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
    end_a: vec3f,
    end_b: vec3f,
    along: vec3f,
    toward: vec3f,
    at_a: f32,
    at_b: f32,
    span: f32,
    height: f32,
    radius: f32,
    outside: bool,
}

// Prepares a capsule.
//
//   end_a, end_b  centres of the end balls, from the shading point
//   radius        not negative
//
// Degenerate: ends that meet make a sphere. A point inside gives finite members.
fn steradian_capsule_prepare(end_a: vec3f, end_b: vec3f, radius: f32) -> SteradianCapsule {
    let difference = end_b - end_a;
    let span2 = dot(difference, difference);
    let a2 = dot(end_a, end_a);
    let b2 = dot(end_b, end_b);
    let nearer = select(end_b, end_a, a2 < b2);
    let nearer2 = min(a2, b2);
    let along = difference * inverseSqrt(max(span2, steradian_smallest_square()));
    let moment = cross(nearer, along);
    let height2 = dot(moment, moment);
    let at_a = dot(end_a, along);
    let at_b = dot(end_b, along);
    let radius2 = radius * radius;
    // From within the endless cylinder, the nearer ball hides the other.
    let tube = height2 > radius2 && span2 > steradian_smallest_divisor();
    let beside = at_a < 0.0 && at_b > 0.0 && span2 > steradian_smallest_divisor();

    let nearest = sqrt(nearer2);
    let direction = select(vec3f(0.0, 0.0, 1.0), nearer * inverseSqrt(max(nearer2, steradian_smallest_square())), nearer2 > steradian_smallest_square());
    let across = steradian_frame_from_normal(direction);
    var c: SteradianCapsule;
    c.end_a = select(nearer, end_a, tube);
    c.end_b = select(nearer, end_b, tube);
    c.along = select(steradian_transform(across, vec3f(1.0, 0.0, 0.0)), along, tube);
    c.toward = select(direction, cross(along, moment) * inverseSqrt(max(height2, steradian_smallest_square())), tube);
    c.at_a = select(0.0, at_a, tube);
    c.at_b = select(0.0, at_b, tube);
    c.span = select(0.0, sqrt(span2), tube);
    c.height = select(nearest, sqrt(height2), tube);
    c.radius = radius;
    c.outside = select(nearer2, height2, beside) > radius2;
    return c;
}

// The same in units of the distance, for ends in any unit: squares of squares stay in the range of float.
fn steradian_capsule_in_units(end_a: vec3f, end_b: vec3f, radius: f32) -> SteradianCapsule {
    let unit = inverseSqrt(max(dot(end_a, end_a) + dot(end_b, end_b) + radius * radius, steradian_smallest_divisor()));
    return steradian_capsule_prepare(end_a * unit, end_b * unit, radius * unit);
}

// Distance of the two touching planes' lines of touch from the point: sqrt(height^2 - radius^2).
fn steradian_capsule_touch(c: SteradianCapsule) -> f32 {
    return sqrt(max((c.height - c.radius) * (c.height + c.radius), 0.0));
}

// Half the angle of an end's arc [rad], in [0, pi], counted about the cap's centre. Those of the two ends sum to pi where they
// meet.
//
//   place     of the end along the axis, outward: -at_a of end_a, at_b of end_b
//   distance  of the end's centre
fn steradian_capsule_half_angle(c: SteradianCapsule, place: f32, distance: f32) -> f32 {
    return steradian_trig_atan2(steradian_capsule_touch(c), c.radius * place / max(distance, steradian_smallest_length()));
}

// Irradiance vector of a line's or a capsule's two great circles and the chords of its arcs, over 2 radius / height.
//
//   angle    of the great circles [rad]
//   share    of the chords' length in the width: sqrt(1 - (radius / height)^2), 1 for a line; the others as in Capsule
//
// The chords' parts nearly cancel for a short or distant light; their difference is formed on paper.
fn steradian_capsule_straight_part(along: vec3f, toward: vec3f, at_a: f32, at_b: f32, span: f32, height: f32, angle: f32, share: f32) -> vec3f {
    let h2 = height * height;
    let both = (h2 + at_a * at_a) * (h2 + at_b * at_b);
    let chords = share * span * height / max(both, steradian_smallest_square());
    return toward * (0.5 * (angle + chords * (h2 - at_a * at_b))) + along * (0.5 * chords * height * (at_a + at_b));
}

// Irradiance vector of the whole capsule, the horizon left out [sr].
//
//   c        prepared; the point is outside
//
// Degenerate: radius 0 gives 0.
// Error: relative to the value, but for what height and at_a, at_b lose of a capsule seen end-on.
// Source: this project; Stokes' theorem as in conic.glsl. Small circles: Lambert 1760.
fn steradian_capsule_whole_vector(c: SteradianCapsule) -> vec3f {
    let touch = steradian_capsule_touch(c);
    let angle = steradian_trig_atan2_unwrapped(c.span * touch, touch * touch + c.at_a * c.at_b);
    let share = touch / max(c.height, steradian_smallest_length());
    let slope = c.radius / max(c.height, steradian_smallest_length());
    var e = steradian_capsule_straight_part(c.along, c.toward, c.at_a, c.at_b, c.span, c.height, angle, share) * (2.0 * slope);
    let a2 = max(dot(c.end_a, c.end_a), steradian_smallest_square());
    let b2 = max(dot(c.end_b, c.end_b), steradian_smallest_square());
    let ia = inverseSqrt(a2);
    let ib = inverseSqrt(b2);
    let sine_a = c.radius * ia;
    let sine_b = c.radius * ib;
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
fn steradian_capsule_add_arc(walk: SteradianPolygonWalk, center: vec3f, radius: f32, middle: vec3f, half_angle: f32, start: vec3f, finish: vec3f) -> SteradianPolygonWalk {
    let d2 = max(dot(center, center), steradian_smallest_square());
    let distance = sqrt(d2);
    let inverse = 1.0 / distance;
    let tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    let root = sqrt(max((radius - center.z) * (radius + center.z), 0.0));

    // Angles about the cap's centre, from its highest point: of the horizon and of the arc's middle (mirrored: >= 0).
    var horizon = steradian_trig_atan2(distance * root, -tangent * center.z);
    horizon = select(select(0.0, steradian_pi(), center.z > 0.0), horizon, root > 0.0);
    let turn = steradian_trig_atan2(abs(middle.x * center.y - middle.y * center.x) * inverse, middle.z);
    let low = turn - half_angle;
    let high = turn + half_angle;
    let seen = max(min(high, horizon) - max(low, -horizon), 0.0) + max(high - (2.0 * steradian_pi() - horizon), 0.0);

    // The crossings of the cap's rim: azimuths left and right of the cap's own.
    let flat2 = max(center.x * center.x + center.y * center.y, steradian_smallest_square());
    let azimuth = vec2f(center.x, center.y) * inverseSqrt(flat2);
    let tilt = steradian_complex_sign(vec2f(tangent, root));
    let comes = steradian_complex_product(azimuth, tilt);
    let goes = steradian_complex_product(azimuth, vec2f(tilt.x, -tilt.y));

    let start_below = start.z < 0.0;
    let finish_below = finish.z < 0.0;
    let meets = root > 0.0;
    let twice = meets && ((!start_below && !finish_below && high > steradian_pi()) || (start_below && finish_below && turn < half_angle));
    let comes_up = twice || (start_below && !finish_below);
    let goes_down = twice || (finish_below && !start_below);
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var chord = select(start, nowhere, start_below) - select(finish, nowhere, finish_below);
    chord = chord + select(nowhere, vec3f(comes.x, comes.y, 0.0), comes_up);
    chord = chord - select(nowhere, vec3f(goes.x, goes.y, 0.0), goes_down);

    let sine = radius * inverse;
    var next = walk;
    next.edges = walk.edges + center * (0.5 * sine * sine * inverse * seen) -
                 cross(center, chord) * (0.5 * tangent * inverse * inverse);
    let up = select(vec2f(1.0, 0.0), comes, comes_up);
    let down = select(vec2f(1.0, 0.0), vec2f(goes.x, -goes.y), goes_down);
    next.horizon = steradian_complex_product(walk.horizon, steradian_complex_product(up, down));
    return next;
}

// Irradiance vector of the part of the capsule above the horizon [sr]; z is the irradiance for radiance 1, in [0, pi].
//
//   c        of steradian_capsule_prepare
//
// Degenerate: a capsule below the horizon and a point inside give 0.
// Error: docs/measured/accuracy.md, "Float against double", capsule. Exact: two arcs, two edges and an arc of the horizon.
fn steradian_capsule_irradiance_vector(c: SteradianCapsule) -> vec3f {
    var e = steradian_capsule_whole_vector(c);
    let cut = min(c.end_a.z, c.end_b.z) < c.radius;
    if (cut) {
        let a2 = dot(c.end_a, c.end_a);
        let b2 = dot(c.end_b, c.end_b);
        let r2 = c.radius * c.radius;
        let side = cross(c.toward, c.along);
        let inward = c.toward * (r2 / max(c.height, steradian_smallest_length()));
        let aside = side * (c.radius * steradian_capsule_touch(c) / max(c.height, steradian_smallest_length()));
        let ia = inverseSqrt(max(a2 - r2, steradian_smallest_square()));
        let ib = inverseSqrt(max(b2 - r2, steradian_smallest_square()));
        let a_left = (c.end_a - inward + aside) * ia;
        let a_right = (c.end_a - inward - aside) * ia;
        let b_left = (c.end_b - inward + aside) * ib;
        let b_right = (c.end_b - inward - aside) * ib;
        let da = sqrt(max(a2, steradian_smallest_square()));
        let db = sqrt(max(b2, steradian_smallest_square()));
        let a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
        let b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
        var walk = steradian_polygon_begin();
        walk = steradian_capsule_add_arc(walk, c.end_a, c.radius, a_middle, steradian_capsule_half_angle(c, -c.at_a, da), a_left, a_right);
        walk = steradian_polygon_add_edge(walk, a_right, b_right);
        walk = steradian_capsule_add_arc(walk, c.end_b, c.radius, b_middle, steradian_capsule_half_angle(c, c.at_b, db), b_right, b_left);
        walk = steradian_polygon_add_edge(walk, b_left, a_left);
        let shows = max(c.end_a.z, c.end_b.z) > -c.radius;
        let above = steradian_polygon_irradiance_vector(walk, steradian_mask_none());
        e = select(e, select(vec3f(0.0, 0.0, 0.0), above, shows), cut);
    }
    e = vec3f(e.x, e.y, clamp(e.z, 0.0, steradian_pi()));
    return select(vec3f(0.0, 0.0, 0.0), e, c.outside);
}

// Irradiance vector of the part of a line above the horizon [1 / m]: the limit of a capsule's over its width 2 radius.
//
//   end_a, end_b  from the shading point
//
// Degenerate: a line towards the point, or of no length, gives 0; one that passes through the point a finite value.
// Error: docs/measured/accuracy.md, "Float against double", line. A capsule differs by at most docs/eval.md's bound.
// Source: as for any linear light; here the limit of steradian_capsule_whole_vector.
fn steradian_line_irradiance_vector(end_a: vec3f, end_b: vec3f) -> vec3f {
    let wa = abs(end_a.z);
    let wb = abs(end_b.z);
    let crossing = (end_a * wb + end_b * wa) * (1.0 / max(wa + wb, steradian_smallest_square()));
    let a = select(end_a, crossing, end_a.z < 0.0);
    let b = select(end_b, crossing, end_b.z < 0.0);
    let difference = b - a;
    let span2 = dot(difference, difference);
    let along = difference * inverseSqrt(max(span2, steradian_smallest_square()));
    let moment = cross(select(b, a, dot(a, a) < dot(b, b)), along);
    let height2 = max(dot(moment, moment), steradian_smallest_square());
    let height = sqrt(height2);
    let toward = cross(along, moment) * (1.0 / height);
    let span = sqrt(span2);
    let at_a = dot(a, along);
    let at_b = dot(b, along);
    let angle = steradian_trig_atan2_unwrapped(span * height, height2 + at_a * at_b);
    var e = steradian_capsule_straight_part(along, toward, at_a, at_b, span, height, angle, 1.0) * (1.0 / height);
    e = vec3f(e.x, e.y, max(e.z, 0.0));
    return select(e, vec3f(0.0, 0.0, 0.0), end_a.z <= 0.0 && end_b.z <= 0.0);
}

// Corners about the arc of one end.
//   center, middle, side  the rim is center + middle cos t + side sin t, vectors from the shading point
//   last                  (cos, sin) of half the arc's angle, where it ends; it begins at (last.x, -last.y)
//   corners               how many, 1 or more
//   turn                  (cos, sin) of the place nearest to the lobe
//   beta                  1: equal steps; below, corners gather there
//   first, step           of the arc's parameter, half a turn a corner
struct SteradianCapsuleEnd {
    center: vec3f,
    middle: vec3f,
    side: vec3f,
    last: vec2f,
    corners: f32,
    turn: vec2f,
    beta: f32,
    first: f32,
    step: f32,
}

// A polygon about a capsule's outline: straight edges stay straight, each arc becomes a chain of corners.
struct SteradianCapsuleFan {
    a: SteradianCapsuleEnd,
    b: SteradianCapsuleEnd,
}

// Prepares the arc of one end as a single step; steradian_capsule_fan divides it.
//
//   center      of the ball
//   middle      unit, across `center`, where the arc's middle lies
//   r, width    the lobe's unit axis and width [rad], as for steradian_ellipse_fan_concentrated
fn steradian_capsule_end(center: vec3f, radius: f32, middle: vec3f, half_angle: f32, r: vec3f, width: f32) -> SteradianCapsuleEnd {
    let d2 = max(dot(center, center), steradian_smallest_square());
    let inverse = inverseSqrt(d2);
    let sine = max(radius * inverse, steradian_smallest_length());
    let cosine2 = max(1.0 - sine * sine, steradian_smallest_length());
    let cosine = sqrt(cosine2);
    let axis = center * inverse;
    let side = cross(axis, middle);
    var end: SteradianCapsuleEnd;
    end.center = center * cosine2;
    end.middle = middle * (radius * cosine);
    end.side = side * (radius * cosine);
    end.last = steradian_complex_unit(half_angle);

    // The place at which the lobe's axis meets the rim's plane, in units of the rim's radius.
    let along = dot(r, axis);
    let place = vec2f(dot(r, middle), dot(r, side)) * (cosine / (sine * max(along, 1.0e-12)));
    let nearest = clamp(steradian_trig_atan2(place.y, place.x), -half_angle, half_angle);
    end.turn = steradian_complex_unit(nearest);
    let apart = place - end.turn;
    let blur = min(1.6 * width / sine, 1.0e3);
    let beta = sqrt(min(0.5 * dot(apart, apart), 1.0e6) + blur * blur);
    end.beta = select(1.0, clamp(beta, 0.05, 1.0), along > 0.0);

    let low = steradian_complex_unit(-0.5 * (half_angle + nearest));
    let high = steradian_complex_unit(0.5 * (half_angle - nearest));
    end.first = steradian_trig_atan2(low.y, end.beta * low.x);
    end.step = steradian_trig_atan2(high.y, end.beta * high.x) - end.first;
    end.corners = 1.0;
    return end;
}

// (cos t, sin t) of corner j of an end, in the middle of its step.
//
// The outer ones lie on the straight edges' continuation and keep within 0.35 of the arc's ends: of 0.35, 0.5 and 0.7 the one
// with the smallest errors in the test CapsulePolygons.
fn steradian_capsule_corner(end: SteradianCapsuleEnd, j: f32) -> vec2f {
    let u = steradian_complex_unit(clamp(end.first + end.step * (j + 0.5), -steradian_pi(), steradian_pi()));
    let w = steradian_complex_sign(vec2f(u.x, end.beta * u.y));
    var corner = steradian_complex_product(steradian_complex_product(w, w), end.turn);
    let limit = vec2f(0.939372712847378920, 0.342897807455451364);  // (cos, sin) of 0.35
    let outer_low = j < 0.5;
    let outer_high = j > end.corners - 1.5;
    let low = vec2f(end.last.x, -end.last.y);
    corner = select(corner, steradian_complex_product(low, limit), outer_low && dot(corner, low) < limit.x);
    corner = select(corner, steradian_complex_product(end.last, vec2f(limit.x, -limit.y)), outer_high && dot(corner, end.last) < limit.x);
    return select(corner, vec2f(1.0, 0.0), outer_low && outer_high);
}

// The square of a corner's radius that equal area requires, for the step to its neighbour. With `outer`, the neighbour stands on a straight
// edge's continuation: its radius is given, and so is the area that it adds.
//
//   joint    (cos, sin) of the arc's end behind the neighbour
fn steradian_capsule_gap(corner: vec2f, neighbour: vec2f, joint: vec2f, outer: bool) -> f32 {
    let cosine = dot(corner, neighbour);
    var sine = abs(corner.x * neighbour.y - corner.y * neighbour.x);
    let angle = clamp(steradian_trig_atan2(sine, cosine), 0.0, 2.6);
    sine = select(0.515501371821464235, sine, cosine > -0.856888753368947234);
    let even = select(angle / max(sine, 1.0e-4), 1.0, angle < 1.0e-3);
    let c = max(dot(neighbour, joint), 0.5);
    let s = abs(neighbour.x * joint.y - neighbour.y * joint.x);
    var given = (even + (steradian_trig_atan2(s, c) - s / c) / max(sine, 1.0e-4)) * c;
    given = select(max(given, 0.5), 1.0, angle < 1.0e-3);
    return select(even, given * given, outer);
}

// Corner j of an end, as a vector from the shading point.
fn steradian_capsule_end_corner(end: SteradianCapsuleEnd, j: f32) -> vec3f {
    let here = steradian_capsule_corner(end, j);
    var joint = vec2f(end.last.x, -end.last.y);
    var joins = j < 1.5;
    let outer_low = j < 0.5;
    let outer_high = j > end.corners - 1.5;
    let outer = 1.0 / max(dot(here, select(end.last, joint, outer_low)), 0.5);
    var gaps = 0.0;
    // The corner before, and the one after.
    for (var i: i32 = 0; i < 2; i++) {
        gaps = gaps + steradian_capsule_gap(here, steradian_capsule_corner(end, j + f32(2 * i - 1)), joint, joins);
        joint = end.last;
        joins = j > end.corners - 2.5;
    }
    let radius = select(sqrt(0.5 * gaps), outer, outer_low || outer_high);
    return end.center + (end.middle * here.x + end.side * here.y) * radius;
}

// Prepares a polygon about a capsule.
//
//   c        prepared; the point is outside
//   r        unit axis of the lobe
//   width    of the lobe [rad]: 1/sqrt(n + 1) of Phong
//   count    of all corners, 6 or more; each end has its share of the steps, at least one
fn steradian_capsule_fan(c: SteradianCapsule, r: vec3f, width: f32, count: i32) -> SteradianCapsuleFan {
    let da = sqrt(max(dot(c.end_a, c.end_a), steradian_smallest_square()));
    let db = sqrt(max(dot(c.end_b, c.end_b), steradian_smallest_square()));
    let angle_a = steradian_capsule_half_angle(c, -c.at_a, da);
    let angle_b = steradian_capsule_half_angle(c, c.at_b, db);
    let a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
    let b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
    var fan: SteradianCapsuleFan;
    fan.a = steradian_capsule_end(c.end_a, c.radius, a_middle, angle_a, r, width);
    fan.b = steradian_capsule_end(c.end_b, c.radius, b_middle, angle_b, r, width);
    let share = fan.a.step / max(fan.a.step + fan.b.step, steradian_smallest_length());
    fan.a.corners = 1.0 + floor(0.5 + f32(count - 2) * share);
    fan.b.corners = f32(count) - fan.a.corners;
    fan.a.step = fan.a.step / fan.a.corners;
    fan.b.step = fan.b.step / fan.b.corners;
    return fan;
}

// Corner k of the polygon, k from 0, as a vector from the shading point, in walk order. Only its direction counts: the
// corners of the two ends lie in different planes.
//
// Error: see docs/theory/ggx.md, "Round lights".
fn steradian_capsule_fan_corner(fan: SteradianCapsuleFan, k: i32) -> vec3f {
    let first = f32(k) < fan.a.corners;
    var end: SteradianCapsuleEnd;
    end.center = select(fan.b.center, fan.a.center, first);
    end.middle = select(fan.b.middle, fan.a.middle, first);
    end.side = select(fan.b.side, fan.a.side, first);
    end.last = select(fan.b.last, fan.a.last, first);
    end.corners = select(fan.b.corners, fan.a.corners, first);
    end.turn = select(fan.b.turn, fan.a.turn, first);
    end.beta = select(fan.b.beta, fan.a.beta, first);
    end.first = select(fan.b.first, fan.a.first, first);
    end.step = select(fan.b.step, fan.a.step, first);
    return steradian_capsule_end_corner(end, select(f32(k) - fan.a.corners, f32(k), first));
}

// ==== ellipsoid ====

// Spheres and ellipsoids as lights: their outline, seen from a point, is a planar ellipse.

// The ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point [m], and whether it can be seen.
struct SteradianEllipsoidOutline {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
    outside: bool,  // false: the point is inside, no light
}

// Outline of the ellipsoid c + S u, |u| = 1, whose cone of tangents meets the shading point.
//
//   to_center  c - p, from the shading point p to the centre
//   s          S, half axes as columns
//   inverse    S^-1, its columns
//
// Degenerate: a point inside or on the ellipsoid gives outside = false and a finite outline.
// Source: the unit sphere's outline from distance d is the circle of radius sqrt(1 - 1/d^2) at height 1/d above the
// centre; S maps it.
fn steradian_ellipsoid_outline(to_center: vec3f, s: mat3x3f, inverse: mat3x3f) -> SteradianEllipsoidOutline {
    let p = -steradian_transform(inverse, to_center);
    let d2 = dot(p, p);
    let safe = max(d2, 1.000001);
    let inverse_d = inverseSqrt(safe);
    let k = p * inverseSqrt(max(d2, steradian_smallest_divisor()));
    let rho = sqrt(1.0 - 1.0 / safe);
    let frame = steradian_frame_from_normal(k);
    let a = steradian_transform(frame, vec3f(rho, 0.0, 0.0));
    let b = steradian_transform(frame, vec3f(0.0, rho, 0.0));
    var outline: SteradianEllipsoidOutline;
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
fn steradian_far_element_vector(area: vec3f, r: vec3f) -> vec3f {
    let inverse = 1.0 / max(dot(r, r), steradian_smallest_divisor());
    return (r * inverse) * (max(-dot(area, r), 0.0) * inverse);
}

// Irradiance vector of a ball of radiance 1 that covers 1 m^2, wholly above the horizon: exact at any distance.
//
// Source: Lambert 1760. Degenerate: at the centre it is finite.
fn steradian_far_ball_vector(r: vec3f) -> vec3f {
    let inverse = inverseSqrt(max(dot(r, r), steradian_smallest_divisor()));
    return (r * inverse) * (inverse * inverse);
}

// Error of one element in the light's centroid: what is linear over the light it has exactly.
//
//   deviation2  mean square distance of the light's points from the centroid
//   distance2   R^2 > 0
fn steradian_far_error_of_one(deviation2: f32, distance2: f32) -> f32 { return 3.0 * deviation2 / distance2; }

// Error of four elements with the light's first and second moments (light_elements.glsl).
//
//   third      mean cubed distances from the centroid, the light's and the elements' together
//   fourth     the same of fourth powers
//   symmetric  the light is its own mirror image about its centroid: then no cubic part is left
fn steradian_far_error_of_four(third: f32, fourth: f32, symmetric: bool, distance2: f32) -> f32 {
    let by_third = 4.0 * third * inverseSqrt(distance2);
    let by_fourth = 5.0 * fourth / distance2;
    return select(by_third, min(by_third, by_fourth), symmetric) / distance2;
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
fn steradian_far_error_across_horizon(top: f32, deviation_up: f32, deviation: f32, distance: f32) -> f32 {
    let inverse = 1.0 / distance;
    return min(top * inverse, (0.5 * deviation_up + 3.0 * top * deviation * inverse) * inverse);
}

// Error of a polynomial through Chebyshev's nodes along an axis.
//
//   nodes     their number, at least 1
//   reach     half the length of the interval
//   distance  R > 0
fn steradian_far_error_of_nodes(nodes: i32, reach: f32, distance: f32) -> f32 {
    let step = reach / (2.0 * distance);
    var power = 2.0 * f32(nodes + 1);
    for (var i: i32 = 0; i < nodes; i++) {
        power = power * step;
    }
    return power;
}

// Upper bound of Schlick's (1 - v.h)^5 where the cosine of half the angle between view and light is at least c, and of how fast it
// turns with the light's direction [1/rad].
fn steradian_far_grazing(c: f32) -> vec2f {
    let x = clamp(1.0 - c, 0.0, 1.0);
    let x2 = x * x;
    return vec2f(x2 * x2 * x, 2.5 * x2 * x2 * sqrt(max(1.0 - (1.0 - x) * (1.0 - x), 0.0)));
}

// Error of a polynomial through Chebyshev's nodes of the vector times (1 - v.h)^5, v the direction to an eye that stays.
//
//   view_distance  least distance of the receivers from the eye, > 0
//   least_square   least square of v.h over receivers and light: (1 + v.l) / 2
//
// By Cauchy's inequality over discs of three radii in the complex plane. A step of radius rho times a unit vector turns l by at most
// x = rho / (R - rho), v by y alike, and v.l by x + y + x y; the vector grows to 1 / (R - rho)^2.
// Degenerate: large where v.h may vanish, at the root's singularity.
fn steradian_far_error_of_grazing_nodes(nodes: i32, reach: f32, distance: f32, view_distance: f32, least_square: f32) -> f32 {
    let room = min(distance, view_distance);
    var best = 1.0e6;
    for (var k: i32 = 1; k < 4; k++) {
        let rho = 0.2 * f32(k) * room;
        let x = rho / (distance - rho);
        let y = rho / (view_distance - rho);
        let left = least_square - 0.5 * (x + y + x * y);
        let grazing = steradian_far_grazing(sqrt(max(left, 0.0))).x;
        let step = reach / (2.0 * rho);
        let growth = 1.0 + x;
        var power = 2.0 * growth * growth * grazing;
        for (var i: i32 = 0; i < nodes; i++) {
            power = power * step;
        }
        best = select(best, min(best, power), left > 0.0);
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
    position: vec3f,
    direction: vec3f,
    inverse_range2: f32,
    spot_scale: f32,
    spot_offset: f32,
}

// Light from one direction.
//   direction   unit, to the light
//   irradiance  across it, of a light of intensity 1 [1/m2]
struct SteradianPunctualIncident {
    direction: vec3f,
    irradiance: f32,
}

// Light of intensity 1 at the point p.
//
// Degenerate: distances below 1.0e-6 count as that; at none, the direction is the zero vector.
// Source: KHR_lights_punctual, "Range property" and "Inner and outer cone angles".
fn steradian_punctual_incident(light: SteradianPunctualSource, p: vec3f) -> SteradianPunctualIncident {
    let to = light.position - p;
    let d2 = max(dot(to, to), 1.0e-12);
    var incident: SteradianPunctualIncident;
    incident.direction = to * inverseSqrt(d2);
    let q = d2 * light.inverse_range2;
    let within = clamp(1.0 - q * q, 0.0, 1.0);
    let spot = clamp(light.spot_offset - dot(light.direction, incident.direction) * light.spot_scale, 0.0, 1.0);
    incident.irradiance = within * (spot * spot) / d2;
    return incident;
}
