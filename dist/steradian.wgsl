// Steradian 0.1.0: area light integrals in closed form, for WGSL.
//
// Put it before your module's text; it has no bindings or globals. Made by
// dist/make_dist.py from kernels/: change those. For example:
//
//     // Radiance that a quad light sends to the eye from a Lambert surface.
//     //   p, n         surface point and its unit normal
//     //   v0 ... v3    the light's corners, counter-clockwise as seen from its lit side
//     //   radiance     of the light; the result is for albedo 1
//     fn lit_by_quad(p: vec3f, n: vec3f, v0: vec3f, v1: vec3f, v2: vec3f, v3: vec3f, radiance: f32) -> f32 {
//         let frame = frame_from_normal(n);
//         let a = polygon_direction(steradian_transform_transposed(frame, v3 - p));  // walk order: the corners backwards
//         let b = polygon_direction(steradian_transform_transposed(frame, v2 - p));
//         let c = polygon_direction(steradian_transform_transposed(frame, v1 - p));
//         let d = polygon_direction(steradian_transform_transposed(frame, v0 - p));
//         var walk = polygon_begin();
//         walk = polygon_add_edge(walk, a, b);
//         walk = polygon_add_edge(walk, b, c);
//         walk = polygon_add_edge(walk, c, d);
//         walk = polygon_add_edge(walk, d, a);
//         let lit = dot(cross(v1 - v0, v2 - v0), p - v0) > 0.0;
//         let irradiance = select(0.0, polygon_irradiance(walk, !lit), lit);
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

fn steradian_xy(v: vec3f) -> vec2f { return v.xy; }

// Matrix of three columns times vector, and its transpose times vector.
fn steradian_transform(m: mat3x3f, v: vec3f) -> vec3f { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
fn steradian_transform_transposed(m: mat3x3f, v: vec3f) -> vec3f {
    return vec3f(dot(m[0], v), dot(m[1], v), dot(m[2], v));
}

// ==== constants ====

// The constants that all kernels share. A constant is a function: the same in every language.

// The circle's constant.
fn steradian_pi() -> f32 { return 3.14159265358979324; }

// 1 / pi.
fn inverse_pi() -> f32 { return 0.318309886183790672; }

// 1 / (2 pi).
fn inverse_two_pi() -> f32 { return 0.159154943091895336; }

// False in every lane.
fn mask_none() -> bool {
    let zero = 0.0;
    return zero > 0.0;
}

// True in every lane.
fn mask_all() -> bool { return !mask_none(); }

// Squared lengths are kept above this before a division or an inverse root: the smallest normal float is 1.2e-38, and below it
// GPUs and packs count every number as 0.
fn smallest_square() -> f32 { return 1.0e-36; }

// Lengths are kept above this before a division: the root of smallest_square.
fn smallest_length() -> f32 { return 1.0e-18; }

// Divisors of numbers of the order of 1 are kept above this, so that the quotient may still be multiplied by 1.0e8 within float.
// What is smaller is rounding: a cross product of two unit vectors of float has a square of about 1.0e-14 where they are equal.
fn smallest_divisor() -> f32 { return 1.0e-30; }

// ==== complex ====

// Complex numbers: vec2(real part, imaginary part).

// The product a b.
fn complex_product(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The quotient a / b. Degenerate: |b|^2 below 1.0e-36 counts as 1.0e-36.
fn complex_quotient(a: vec2f, b: vec2f) -> vec2f {
    let scale = 1.0 / max(dot(b, b), smallest_square());
    return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) * scale;
}

// The unit number in the direction of a: a / |a|. Degenerate: zero stays zero.
fn complex_sign(a: vec2f) -> vec2f {
    return a * inverseSqrt(max(dot(a, a), smallest_square()));
}

// The unit number of angle x, exp(i x), for x in [-pi, pi].
//
// Taylor series of the cosine and the sine of x / 2, then the square. Error: the first terms left out, (pi/2)^14/14! =
// 6.4e-9 for 24 bits and (pi/2)^22/22! = 1.8e-17 for 53.
fn complex_unit(x: f32) -> vec2f {
    let y = 0.5 * x;
    let t = y * y;
    var c = 1.0;
    var s = 1.0;
    c = 1.0 - t * 0.0111111111111111111 * (1.0 - t * 0.00757575757575757576 * c);
    c = 1.0 - t * 0.0333333333333333333 * (1.0 - t * 0.0178571428571428571 * c);
    c = 1.0 - t * 0.5 * (1.0 - t * 0.0833333333333333333 * c);
    s = 1.0 - t * 0.0138888888888888889 * (1.0 - t * 0.00909090909090909091 * s);
    s = 1.0 - t * 0.05 * (1.0 - t * 0.0238095238095238095 * s);
    s = y * (1.0 - t * 0.166666666666666667 * s);
    return vec2f(c * c - s * s, 2.0 * c * s);
}

// ==== frame ====

// Shading frames. A frame is a mat3 whose columns are x, y and z; transform_transposed(frame, w) takes a world
// vector into it, transform(frame, l) back.

// Orthonormal right-handed frame with z along n and x, y in any direction.
//
//   n        unit normal
//
// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin, "Building an orthonormal basis, revisited", 2017.
fn frame_from_normal(n: vec3f) -> mat3x3f {
    let s = select(1.0, -1.0, n.z < 0.0);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    let y = vec3f(b, s + n.y * n.y * a, -n.y);
    return mat3x3f(x, y, n);
}

// Orthonormal right-handed frame with z along n and the view in the half plane of x and z.
//
//   n, v     unit normal and view
//
// Degenerate: a view along the normal (closer than 1e-6) gives any x.
fn frame_from_normal_and_view(n: vec3f, v: vec3f) -> mat3x3f {
    let other = frame_from_normal(n);
    let t = v - n * dot(n, v);
    let t2 = dot(t, t);
    let x = select(steradian_transform(other, vec3f(1.0, 0.0, 0.0)), t * inverseSqrt(max(t2, 1.0e-12)), t2 > 1.0e-12);
    return mat3x3f(x, cross(n, x), n);
}

// ==== gauss_legendre ====

// Nodes and weights of Gauss and Legendre on [0, 1]: zeros of Legendre's polynomials.
//
// The test GaussLegendre.IntegratesPolynomialsOfItsDegreesExactly proves every number.

// Node j of the rule with n nodes, j from 0, n in 1 to 6 or 8: vec2(node, weight). Weights add up to 1.
//
// Degenerate: a rule or node that there is not gives (1/2, 0).
fn gauss_legendre_node(n: i32, j: i32) -> vec2f {
    var r = vec2f(0.5, 0.0);
    if (n == 1) {
        if (j == 0) { r = vec2f(0.5, 1.0); }
    }
    if (n == 2) {
        if (j == 0) { r = vec2f(0.211324865405187118, 0.5); }
        if (j == 1) { r = vec2f(0.788675134594812882, 0.5); }
    }
    if (n == 3) {
        if (j == 0) { r = vec2f(0.112701665379258311, 0.277777777777777778); }
        if (j == 1) { r = vec2f(0.5, 0.444444444444444444); }
        if (j == 2) { r = vec2f(0.887298334620741689, 0.277777777777777778); }
    }
    if (n == 4) {
        if (j == 0) { r = vec2f(0.069431844202973712, 0.173927422568726929); }
        if (j == 1) { r = vec2f(0.330009478207571868, 0.326072577431273071); }
        if (j == 2) { r = vec2f(0.669990521792428132, 0.326072577431273071); }
        if (j == 3) { r = vec2f(0.930568155797026288, 0.173927422568726929); }
    }
    if (n == 5) {
        if (j == 0) { r = vec2f(0.046910077030668004, 0.118463442528094544); }
        if (j == 1) { r = vec2f(0.230765344947158454, 0.239314335249683234); }
        if (j == 2) { r = vec2f(0.5, 0.284444444444444444); }
        if (j == 3) { r = vec2f(0.769234655052841546, 0.239314335249683234); }
        if (j == 4) { r = vec2f(0.953089922969331996, 0.118463442528094544); }
    }
    if (n == 6) {
        if (j == 0) { r = vec2f(0.033765242898423986, 0.085662246189585173); }
        if (j == 1) { r = vec2f(0.169395306766867743, 0.180380786524069304); }
        if (j == 2) { r = vec2f(0.380690406958401546, 0.233956967286345524); }
        if (j == 3) { r = vec2f(0.619309593041598454, 0.233956967286345524); }
        if (j == 4) { r = vec2f(0.830604693233132257, 0.180380786524069304); }
        if (j == 5) { r = vec2f(0.966234757101576014, 0.085662246189585173); }
    }
    if (n == 8) {
        if (j == 0) { r = vec2f(0.019855071751231884, 0.05061426814518813); }
        if (j == 1) { r = vec2f(0.10166676129318663, 0.111190517226687235); }
        if (j == 2) { r = vec2f(0.237233795041835507, 0.156853322938943644); }
        if (j == 3) { r = vec2f(0.408282678752175098, 0.181341891689180991); }
        if (j == 4) { r = vec2f(0.591717321247824902, 0.181341891689180991); }
        if (j == 5) { r = vec2f(0.762766204958164493, 0.156853322938943644); }
        if (j == 6) { r = vec2f(0.89833323870681337, 0.111190517226687235); }
        if (j == 7) { r = vec2f(0.980144928248768116, 0.05061426814518813); }
    }
    return r;
}

// ==== inverse_trig ====

// Inverse trigonometry for the kernels, the same in every language.
//
// The built-in acos and atan of shader compilers differ by up to 8e-5; these polynomials do not. Each exists for 24
// bits (float, GPU) and for 53 (double); real_digits() is a compile-time constant and picks one.
// Coefficients: tools/fit_inverse_trig finds them; the test InverseTrig.PolynomialsAreTheFittedOnes compares.

// Degree 9, largest relative error 1.3e-08 before rounding.
fn trig_angle_over_sine_24_bits(t: f32) -> f32 {
    var p = 0.01116282422619877;
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
fn trig_atan_over_argument_24_bits(q: f32) -> f32 {
    var p = 0.002766283501762026;
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
fn trig_angle_over_sine_acute(t: f32) -> f32 {
    return trig_angle_over_sine_24_bits(t);
}

// Angle over sine of an angle in [0, pi], from its cosine and the square of its sine.
//
//   c        cosine, in [-1, 1]; the polynomial goes on smoothly where rounding exceeds it
//   s2       sine squared, computed on its own (a squared cross product), not as 1 - c*c, which cancels near pi
//
// Degenerate: towards pi the value grows like pi/sine; it stops at s2 = 1.0e-30, where products with the sine are 0.
fn trig_angle_over_sine(c: f32, s2: f32) -> f32 {
    var f = trig_angle_over_sine_acute(1.0 - abs(c));
    let obtuse = c < 0.0;
    if (obtuse) {
        f = select(f, steradian_pi() * inverseSqrt(max(s2, smallest_divisor())) - f, obtuse);
    }
    return f;
}

// The angle of the vector (x, y) from the x axis, in (-pi, pi] [rad].
//
// Degenerate: (0, 0) gives 0. Scale does not matter as long as the smaller over the larger does not underflow.
// Error: see docs/accuracy.md, "atan2".
fn trig_atan2(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let larger = max(ax, ay);
    let t = min(ax, ay) / max(larger, 1.0e-37);
    let q = t * t;
    let p = trig_atan_over_argument_24_bits(q);
    var angle = t * p;
    angle = select(angle, 0.5 * steradian_pi() - angle, ay > ax);
    angle = select(angle, steradian_pi() - angle, x < 0.0);
    return select(angle, -angle, y < 0.0);
}

// The same angle, counted from -pi/2 to 3 pi/2: for angles known to lie in [0, pi], whose rounding must not wrap.
fn trig_atan2_unwrapped(y: f32, x: f32) -> f32 {
    let angle = trig_atan2(y, x);
    return select(angle, angle + 2.0 * steradian_pi(), angle < -0.5 * steradian_pi());
}

// ==== quartic ====

// Quartic polynomials that are positive on the real axis: two conjugate pairs of roots.

// The roots of a real quartic without real roots: one of each conjugate pair, the one with positive imaginary part.
struct QuarticPoles {
    z1: vec2f,
    z2: vec2f,
}

// Largest root of 4 c^3 - 3 c = x: the cosine of a third of the angle whose cosine is x, in [1/2, 1].
//
//   x        in [-1, 1]
//
// The start in t = sqrt((1 + x)/2), the cosine of half the angle, has the right value at both ends and the right slope
// at x = -1, where the root has infinite slope in x; then two steps of Newton.
// Error: 1e-7 at worst before rounding; test Quartic.CosineOfTheThirdOfAnAngle.
fn quartic_third_cosine(x: f32) -> f32 {
    let t = sqrt(max(0.5 + 0.5 * x, 0.0));
    var c = 0.5 + t * (0.577350269189625765 - 0.0773502691896257645 * t);
    for (var i: i32 = 0; i < 2; i++) {
        let c2 = c * c;
        c = c - (c * (4.0 * c2 - 3.0) - x) / max(12.0 * c2 - 3.0, 1.0e-6);
    }
    return c;
}

// Roots of t^4 + c3 t^3 + c2 t^2 + c1 t + c0, good enough to start an iteration from.
//
//   c0..c3   the roots should be of the order of 1: scale the variable so that c0 = 1
//   returns  imaginary parts at least 1.0e-3: below, the square is the noise of 24 bits
//
// Ferrari: with y = t + c3/4 the quartic is (y^2 + s y + a)(y^2 - s y + b). s^2, the squared distance of the pairs along
// the real axis, is the only root of the resolvent that is not negative; all three are real, so that it is a
// cosine. Where s is small, b - a comes from a + b and a b instead of from a quotient of noise.
// Error: a start; float loses half the digits where pairs are nearly equal.
// Source: Ferrari in Cardano, "Ars magna", 1545; the three real roots: Viete.
fn quartic_poles_approximate(c0: f32, c1: f32, c2: f32, c3: f32) -> QuarticPoles {
    let shift = 0.25 * c3;
    let shift2 = shift * shift;
    let p = c2 - 6.0 * shift2;
    let q = c1 - 2.0 * c2 * shift + 8.0 * shift2 * shift;
    let r = c0 - c1 * shift + c2 * shift2 - 3.0 * shift2 * shift2;

    // Largest root of the resolvent z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2.
    let radius2 = max(p * p + 12.0 * r, 1.0e-12);
    let radius = sqrt(radius2);
    let cosine = clamp((p * (p * p - 36.0 * r) + 13.5 * q * q) / (radius2 * radius), -1.0, 1.0);
    let z = max(0.666666666666666667 * (radius * quartic_third_cosine(cosine) - p), 0.0);
    let s = sqrt(z);

    let sum = p + z;
    let root = sqrt(max(sum * sum - 4.0 * r, 0.0));
    let difference = select(select(root, -root, q < 0.0), q / max(s, smallest_length()), z > 1.0e-3 * abs(p));
    var poles: QuarticPoles;
    poles.z1 = vec2f(-0.5 * s - shift, sqrt(max(0.5 * (sum - difference) - 0.25 * z, 1.0e-6)));
    poles.z2 = vec2f(0.5 * s - shift, sqrt(max(0.5 * (sum + difference) - 0.25 * z, 1.0e-6)));
    return poles;
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
    edges: vec3f,
    horizon: vec2f,
}

// Unit direction of a vertex.
//
//   v        vertex relative to the shading point, any unit of length
//
// Degenerate: a length below 1e-18 (the point lies on the vertex) gives a vector shorter than 1; one above 1e18, whose
// square leaves the range of float, the zero vector. Both are finite and add next to nothing to any sum.
fn polygon_direction(v: vec3f) -> vec3f {
    let d2 = dot(v, v);
    let scale = select(0.0, inverseSqrt(max(d2, smallest_square())), d2 < 1.0e36);
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
fn polygon_edge(a: vec3f, b: vec3f) -> vec3f {
    let n = cross(a, b);
    let f = trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}

// A walk before its first edge: no edges, and a horizon of angle 0.
fn polygon_begin() -> PolygonWalk {
    var walk: PolygonWalk;
    walk.edges = vec3f(0.0, 0.0, 0.0);
    walk.horizon = vec2f(1.0, 0.0);
    return walk;
}

// Adds one edge, clipped to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (polygon_direction), in walk order
//
// What lies below is replaced by an arc of the horizon from where the outline leaves to where it comes back. All
// these arcs of a plane light lie within one half circle and run the same way, so that only the sum of their angles
// counts: each crossing multiplies its azimuth into a complex number, in whatever order the crossings come.
fn polygon_add_edge(walk: PolygonWalk, a: vec3f, b: vec3f) -> PolygonWalk {
    var next = walk;
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    if (!a_below || !b_below) {
        var start = a;
        var end = b;
        if (a_below || b_below) {
            // Where the edge crosses the horizon: weights of one sign, so nothing cancels.
            let wa = abs(b.z);
            let wb = abs(a.z);
            var p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
            p = p * inverseSqrt(max(dot(p, p), smallest_square()));
            let crossing = vec3f(p.x, p.y, 0.0);
            start = select(a, crossing, a_below);
            end = select(b, crossing, b_below);  // both below: start = end, an edge of no length
            let crosses = (a_below && !b_below) || (b_below && !a_below);
            let y = select(-p.y, p.y, a_below);  // coming up: the azimuth; going down: its conjugate
            let h = walk.horizon;
            next.horizon = select(h, vec2f(h.x * p.x - h.y * y, h.x * y + h.y * p.x), crosses);
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
fn polygon_irradiance_vector(walk: PolygonWalk, reversed: bool) -> vec3f {
    let facing = select(1.0, -1.0, reversed);
    var arc = 0.0;
    if (abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0) {
        arc = trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    let e = walk.edges * facing;
    return vec3f(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, steradian_pi()));
}

// Irradiance of radiance 1 from the part of the light above the horizon, in [0, pi]. See polygon_irradiance_vector.
//
// Error: see docs/accuracy.md, "polygon irradiance".
fn polygon_irradiance(walk: PolygonWalk, reversed: bool) -> f32 {
    let e = polygon_irradiance_vector(walk, reversed);
    return e.z;
}

// The state of a solid angle's walk: a product of complex numbers, each with half a triangle's solid angle.
struct SolidAngleWalk {
    first: vec3f,
    product: vec2f,
}

// A solid angle's walk before its first triangle.
//
//   first    unit direction of any vertex of the light
fn solid_angle_begin(first: vec3f) -> SolidAngleWalk {
    var walk: SolidAngleWalk;
    walk.first = first;
    walk.product = vec2f(1.0, 0.0);
    return walk;
}

// Adds the triangle of the first vertex and one edge. Directions as for polygon_add_edge; no horizon here.
//
// Degenerate: a triangle without area has a real factor and adds nothing.
// Source: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
fn solid_angle_add_edge(walk: SolidAngleWalk, a: vec3f, b: vec3f) -> SolidAngleWalk {
    var next = walk;
    var re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    var im = dot(walk.first, cross(a, b));
    let scale = inverseSqrt(max(re * re + im * im, smallest_square()));
    re = re * scale;
    im = im * scale;
    let p = walk.product;
    next.product = vec2f(p.x * re - p.y * im, p.x * im + p.y * re);
    return next;
}

// Solid angle of a plane light, in [0, 2 pi] [sr].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Error: see docs/accuracy.md, "polygon solid angle".
fn solid_angle_finish(walk: SolidAngleWalk, reversed: bool) -> f32 {
    let y = select(walk.product.y, -walk.product.y, reversed);
    return max(2.0 * trig_atan2_unwrapped(y, walk.product.x), 0.0);
}

// ==== conic ====

// Arcs of conics in space: the boundary integral of irradiance along them, in closed form.
//
// A curve u(tau) = u0 + u1 tau + u2 tau^2, seen from the origin, bounds a region of directions; its share of the region's
// irradiance vector is  1/2 INT u x u' / |u|^2 dtau,  a quadratic over a quartic. The quartic |u|^2 is positive: its
// two conjugate pairs of roots, the poles, say where the curve passes the origin and how closely, and the integral is a
// sum of residues times logarithms. Straight edges, circles and ellipses are such curves, and so is the half vector of
// a light's edge stretched by a GGX surface (ggx_closed_form.glsl). docs/ggx.md has the derivation.

// A prepared arc, in units of tau in which the poles' distances from 0 have the product 1.
//   u0..u2      the curve
//   begin, end  its ends in tau; equal where the arc has no length
//   scale       the unit: tau as the caller counted it is scale times tau here
//   z1, z2      poles: roots of |u|^2 with positive imaginary part
//   sweep       the angles under which the poles see the arc [rad], in [0, pi]
struct ConicArc {
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
fn conic_slope(z: vec2f, o: vec2f, d4: f32) -> vec2f {
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
fn conic_pole_step(arc: ConicArc, z: vec2f, o: vec2f, d4: f32) -> vec2f {
    let re = arc.u0 + arc.u1 * z.x + arc.u2 * (z.x * z.x - z.y * z.y);
    let im = (arc.u1 + arc.u2 * (2.0 * z.x)) * z.y;
    let value = vec2f(dot(re - im, re + im), 2.0 * dot(re, im));
    var step = complex_quotient(value, conic_slope(z, o, d4));
    let apart = z - o;
    let apart2 = dot(apart, apart);
    let longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * inverseSqrt(max(dot(step, step), smallest_divisor())), 1.0);
    let free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    let next = z - select(vec2f(0.0, 0.0), step, free);
    return vec2f(next.x, max(abs(next.y), 1.0e-9));
}

// Gauss and Seidel's sweeps over the two poles until both stand still.
//
// Number of sweeps: 2 or 3 at ordinary widths and views; a pole much nearer to the axis than its start comes down by half a
// sweep, which makes up to 16 at alpha = 1.0e-4 and grazing views.
// Error: in float, poles to 1.0e-3 of their height at least, and since steps square, mostly to rounding.
fn conic_polish_poles(arc: ConicArc, start: QuarticPoles) -> QuarticPoles {
    var poles = start;
    let d4 = dot(arc.u2, arc.u2);
    let sweeps: i32 = 16;
    let tolerance = 1.0e-6;
    var moving = arc.end > arc.begin;
    for (var i: i32 = 0; i < sweeps; i++) {
        if (moving) {
            let z1 = conic_pole_step(arc, poles.z1, poles.z2, d4);
            let z2 = conic_pole_step(arc, poles.z2, z1, d4);
            let step1 = z1 - poles.z1;
            let step2 = z2 - poles.z2;
            poles.z1 = select(poles.z1, z1, moving);
            poles.z2 = select(poles.z2, z2, moving);
            moving = moving && (dot(step1, step1) > tolerance * z1.y * z1.y || dot(step2, step2) > tolerance * z2.y * z2.y);
        }
    }
    return poles;
}

// The angle under which a pole sees the arc [rad], in [0, pi].
fn conic_sweep(z: vec2f, begin: f32, end: f32) -> f32 {
    return trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}

// Prepares an arc.
//
//   u0..u2      the curve; the origin must not lie on it
//   begin, end  ends in tau, begin <= end
//
// Degenerate: |u2| below 1.0e-6 |u0| (1.0e-12 in double) is replaced by a little of u0, which leaves the curve's direction at
// tau = 0 as it is.
fn conic_prepare(u0: vec3f, u1: vec3f, u2: vec3f, begin: f32, end: f32) -> ConicArc {
    let least = 1.0e-12;
    let d0 = max(dot(u0, u0), smallest_divisor());
    let d4 = dot(u2, u2);
    let ratio = sqrt(d0 / max(d4, least * d0));
    var arc: ConicArc;
    arc.scale = sqrt(ratio);
    arc.u0 = u0;
    arc.u1 = u1 * arc.scale;
    arc.u2 = select(u0 * sqrt(least), u2, d4 > least * d0) * ratio;
    arc.begin = begin / arc.scale;
    arc.end = end / arc.scale;

    let inverse = 1.0 / max(dot(arc.u2, arc.u2), smallest_divisor());
    var poles = quartic_poles_approximate(
        dot(arc.u0, arc.u0) * inverse, 2.0 * dot(arc.u0, arc.u1) * inverse,
        (dot(arc.u1, arc.u1) + 2.0 * dot(arc.u0, arc.u2)) * inverse, 2.0 * dot(arc.u1, arc.u2) * inverse);
    poles = conic_polish_poles(arc, poles);
    arc.z1 = poles.z1;
    arc.z2 = poles.z2;
    arc.sweep = vec2f(conic_sweep(arc.z1, arc.begin, arc.end), conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}

// A place on an arc by its share of the angle C under which both poles together see it: in C the integrand is smooth
// wherever the arc passes.
//   tau      between the arc's begin and end
//   density  dC/dtau
struct ConicNode {
    tau: f32,
    density: f32,
}

// The place where C is a given share of its way from the arc's begin to its end.
//
//   share    in [0, 1]
//
// C(tau) is the argument of (b1 + i (tau - p1))(b2 + i (tau - p2)) with poles p + i b, so that tau is the root of a quadratic.
fn conic_node(arc: ConicArc, share: f32) -> ConicNode {
    let p1 = arc.z1.x;
    let p2 = arc.z2.x;
    let b1 = arc.z1.y;
    let b2 = arc.z2.y;
    let start = complex_product(vec2f(b1, arc.begin - p1), vec2f(b2, arc.begin - p2));
    let total = arc.sweep.x + arc.sweep.y;
    // The angle is in [0, 2 pi]: half a turn less, and the sign.
    let turned = complex_product(complex_sign(start), -complex_unit(share * total - steradian_pi()));
    let s = turned.y;
    let c = turned.x;
    let linear_term = c * (b1 + b2) - s * (p1 + p2);
    let constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    let root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    let positive = linear_term >= 0.0;
    let top = select(root - linear_term, -2.0 * constant_term, positive);
    let bottom = select(2.0 * s, linear_term + root, positive);
    let usable = abs(bottom) > smallest_divisor();
    let tau = select(arc.begin, top / select(1.0, bottom, usable), usable);
    var node: ConicNode;
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
fn conic_residue(arc: ConicArc, z: vec2f, o: vec2f, sweep: f32) -> vec3f {
    let n0 = cross(arc.u0, arc.u1);
    let n1 = cross(arc.u0, arc.u2) * 2.0;
    let n2 = cross(arc.u1, arc.u2);
    let re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    let im = (n1 + n2 * (2.0 * z.x)) * z.y;
    let x0 = arc.begin - z.x;
    let x1 = arc.end - z.x;
    let y2 = z.y * z.y;
    let logarithm = vec2f(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    let factor = complex_quotient(logarithm, conic_slope(z, o, dot(arc.u2, arc.u2)));
    return re * factor.x - im * factor.y;
}

// The same integral as conic_residue sums, by Gauss and Legendre in the angle C, for poles that nearly coincide, where residues cancel. 8 nodes, twice.
fn conic_vector_approximate(arc: ConicArc) -> vec3f {
    var sum = vec3f(0.0, 0.0, 0.0);
    let total = arc.sweep.x + arc.sweep.y;
    for (var i: i32 = 0; i < 16; i++) {
        let part: i32 = i / 8;
        let rule = gauss_legendre_node(8, i - 8 * part);
        let node = conic_node(arc, 0.5 * (rule.x + f32(part)));
        let u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
        let du = arc.u1 + arc.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), smallest_divisor())));
    }
    return sum;
}

// An arc's share of the irradiance vector: 1/2 INT u x u' / |u|^2 dtau [rad].
//
// Error: docs/accuracy.md, "Float against double", conic vector.
fn conic_vector(arc: ConicArc) -> vec3f {
    var e = conic_residue(arc, arc.z1, arc.z2, arc.sweep.x) + conic_residue(arc, arc.z2, arc.z1, arc.sweep.y);
    // Poles nearer to each other than this share of their heights, squared: residues lose the inverse of the share, and the
    // quadrature, whose nearest singularity recedes as poles meet, is good to the digits that remain.
    let close = 1.0e-2;
    let apart = arc.z1 - arc.z2;
    let meet = dot(apart, apart) < close * arc.z1.y * arc.z2.y && arc.end > arc.begin;
    if (meet) {
        e = select(e, conic_vector_approximate(arc), meet);
    }
    return e;
}

// ==== ellipse ====

// Disks and ellipses as lights, and the outlines of spheres and ellipsoids (ellipsoid.glsl), which are ellipses.
//
// An ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point, is a conic in tan(t/2): its irradiance
// is closed (conic.glsl), above the horizon too. For other lobes it becomes a polygon whose corners gather where the
// lobe is sharp.
// Frame: z the surface normal. Walk order: det(center, axis_a, axis_b) > 0, see ellipse_prepare.

// An ellipse, seen from the shading point.
struct Ellipse {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
}

// Turns the axes so that the walk with growing t is in walk order.
//
//   axis_a, axis_b  any two conjugate half axes; they need not be orthogonal
fn ellipse_prepare(center: vec3f, axis_a: vec3f, axis_b: vec3f) -> Ellipse {
    var e: Ellipse;
    e.center = center;
    e.axis_a = axis_a;
    let reversed = dot(center, cross(axis_a, axis_b)) < 0.0;
    e.axis_b = select(axis_b, -axis_b, reversed);
    return e;
}

// An arc of the ellipse about t = 0 (begin and end are tan(t/2)).
fn ellipse_arc(e: Ellipse, begin: f32, end: f32) -> ConicArc {
    return conic_prepare(e.center + e.axis_a, e.axis_b * 2.0, e.center - e.axis_a, begin, end);
}

// Irradiance vector of the part of the ellipse above the horizon [rad]; z is the irradiance for radiance 1, in [0, pi].
//
//   e        of ellipse_prepare; the shading point is not in its plane
//
// Degenerate: an ellipse below the horizon, without area, or seen from its plane gives 0 up to rounding.
// Error: docs/accuracy.md, "Float against double", ellipse. Exact: 3 arcs of the ellipse and one of the horizon.
fn ellipse_irradiance_vector(e: Ellipse) -> vec3f {
    // Axes from the highest place: axis_a up the ellipse, axis_b level.
    let up = vec2f(e.axis_a.z, e.axis_b.z);
    let rise = sqrt(dot(up, up));
    let turn = select(vec2f(1.0, 0.0), up * (1.0 / max(rise, smallest_divisor())), rise > 0.0);
    var level: Ellipse;
    level.center = e.center;
    level.axis_a = e.axis_a * turn.x + e.axis_b * turn.y;
    level.axis_b = e.axis_b * turn.x - e.axis_a * turn.y;

    // Above the horizon: |tan(t/2)| <= limit.
    let top = e.center.z + rise;
    let bottom = rise - e.center.z;
    let shows = top > 0.0;
    let cut = bottom > 0.0 && shows;
    var limit = sqrt(max(top, 0.0) / max(bottom, smallest_divisor()));
    limit = select(select(0.0, 1.0e15, shows), limit, cut);
    let upper = min(limit, 1.0);
    var sum = conic_vector(ellipse_arc(level, -upper, upper));
    let more = limit > 1.0;
    if (more) {
        var back: Ellipse;
        back.center = level.center;
        back.axis_a = -level.axis_a;
        back.axis_b = -level.axis_b;
        var lower = select(1.0, 1.0 / max(limit, 1.0), more);
        lower = select(lower, 0.0, limit > 1.0e14);
        let far_side = conic_vector(ellipse_arc(back, -1.0, -lower)) + conic_vector(ellipse_arc(back, lower, 1.0));
        sum = select(sum, sum + far_side, more);
    }
    if (cut) {
        // Along the horizon, from where the walk goes down, at +limit, to where it comes up.
        let inverse = 1.0 / (1.0 + limit * limit);
        let middle = level.center + level.axis_a * ((1.0 - limit * limit) * inverse);
        let aside = level.axis_b * (2.0 * limit * inverse);
        let down = middle + aside;
        let back_up = middle - aside;
        let angle = trig_atan2(down.x * back_up.y - down.y * back_up.x, down.x * back_up.x + down.y * back_up.y);
        sum = select(sum, sum + vec3f(0.0, 0.0, 0.5 * angle), cut);
    }
    return vec3f(sum.x, sum.y, clamp(sum.z, 0.0, steradian_pi()));
}

// A polygon about an ellipse: where its corners gather.
//   ellipse  prepared
//   turn     (cos, sin) of the t of the corner nearest to the lobe
//   beta     1: corners at equal steps of t; below, they gather about that corner
struct EllipseFan {
    ellipse: Ellipse,
    turn: vec2f,
    beta: f32,
}

// The polygon whose corners stand at equal steps of t.
fn ellipse_fan(e: Ellipse) -> EllipseFan {
    var fan: EllipseFan;
    fan.ellipse = e;
    fan.turn = vec2f(1.0, 0.0);
    fan.beta = 1.0;
    return fan;
}

// The polygon whose corners gather where the lobe's axis meets the ellipse's rim.
//
//   r        unit axis of the lobe
//   width    of the lobe [rad]: 1/sqrt(n + 1) of Phong
//
// A map of the circle onto itself (Moebius) concentrates the corners; how far, the distance of the axis from the rim and
// the lobe's width over the rim's size say.
// Source: this project; table of errors in docs/ggx.md.
fn ellipse_fan_concentrated(e: Ellipse, r: vec3f, width: f32) -> EllipseFan {
    let normal = cross(e.axis_a, e.axis_b);
    let n2 = max(dot(normal, normal), smallest_divisor());
    let height = dot(e.center, normal);  // > 0 in walk order
    let along = dot(r, normal);
    // Where the axis meets the plane, in units of the half axes: (x, y) / along.
    let across = r * height - e.center * along;
    let place = vec2f(dot(across, cross(e.axis_b, normal)), dot(across, cross(normal, e.axis_a))) * (1.0 / n2);
    let size2 = dot(place, place);
    let off_centre = size2 > 1.0e-20;
    var fan: EllipseFan;
    fan.ellipse = e;
    fan.turn = select(vec2f(1.0, 0.0), place * inverseSqrt(max(size2, 1.0e-20)), off_centre);
    let rim = e.center + e.axis_a * fan.turn.x + e.axis_b * fan.turn.y;
    let tangent = e.axis_b * fan.turn.x - e.axis_a * fan.turn.y;
    let reach = min(sqrt(size2) / max(along, 1.0e-12), 1.0e6);
    let blur = 1.6 * width * sqrt(dot(rim, rim) / max(dot(tangent, tangent), smallest_divisor()));
    let beta = sqrt(0.5 * (1.0 - reach) * (1.0 - reach) + min(blur * blur, 1.0e6));
    fan.beta = select(1.0, clamp(beta, 0.05, 1.0), along > 0.0);
    return fan;
}

// (cos t, sin t) of corner k of count, counted from the middle one.
fn ellipse_corner(fan: EllipseFan, k: i32, count: i32) -> vec2f {
    let half_angle = steradian_pi() * (f32(k) / f32(count) - 0.5);
    let u = complex_unit(half_angle);
    let w = complex_sign(vec2f(u.x, fan.beta * u.y));
    return complex_product(complex_product(w, w), fan.turn);
}

// The angle from one corner to the next over its sine: what equal area needs; the angle is taken up to 2.6.
fn ellipse_gap(from_corner: vec2f, to_corner: vec2f) -> f32 {
    let c = dot(from_corner, to_corner);
    let s = from_corner.x * to_corner.y - from_corner.y * to_corner.x;
    var angle = trig_atan2_unwrapped(s, c);
    angle = clamp(angle, 0.0, 2.6);
    let sine = select(0.515501371821464235, s, c > -0.856888753368947234 && s > 0.0);
    return select(angle / max(sine, 1.0e-4), 1.0, angle < 1.0e-3);
}

// Corner k of the polygon with count corners (even, 6 to 64), k from 0, as a vector from the shading point, in walk order.
//
// Pushed out so that the polygon has about the ellipse's area: inscribed, 8 corners lose several percent.
// Error: docs/accuracy.md, "Float against double", ellipse.
fn ellipse_fan_corner(fan: EllipseFan, k: i32, count: i32) -> vec3f {
    let before = ellipse_corner(fan, k - 1, count);
    let here = ellipse_corner(fan, k, count);
    let after = ellipse_corner(fan, k + 1, count);
    let radius = sqrt(0.5 * (ellipse_gap(before, here) + ellipse_gap(here, after)));
    let e = fan.ellipse;
    return e.center + (e.axis_a * here.x + e.axis_b * here.y) * radius;
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

// A capsule, seen from the shading point. Where the point sees a sphere, both ends are the nearer one and `along` is any
// direction across: half of the sphere's outline belongs to each.
//   end_a, end_b  centres of the end balls
//   along         unit, from end_a to end_b
//   toward        unit, from the point to the nearest place of the axis' line
//   at_a, at_b    places of the ends along the line, counted from there; span their distance
//   height        distance of the line
//   outside       whether the point is; inside there is no light
struct Capsule {
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
fn capsule_prepare(end_a: vec3f, end_b: vec3f, radius: f32) -> Capsule {
    let difference = end_b - end_a;
    let span2 = dot(difference, difference);
    let a2 = dot(end_a, end_a);
    let b2 = dot(end_b, end_b);
    let nearer = select(end_b, end_a, a2 < b2);
    let nearer2 = min(a2, b2);
    let along = difference * inverseSqrt(max(span2, smallest_square()));
    let moment = cross(nearer, along);
    let height2 = dot(moment, moment);
    let at_a = dot(end_a, along);
    let at_b = dot(end_b, along);
    let radius2 = radius * radius;
    // From within the endless cylinder, the nearer ball hides the other.
    let tube = height2 > radius2 && span2 > smallest_divisor();
    let beside = at_a < 0.0 && at_b > 0.0 && span2 > smallest_divisor();

    let nearest = sqrt(nearer2);
    let direction = select(vec3f(0.0, 0.0, 1.0), nearer * inverseSqrt(max(nearer2, smallest_square())), nearer2 > smallest_square());
    let across = frame_from_normal(direction);
    var c: Capsule;
    c.end_a = select(nearer, end_a, tube);
    c.end_b = select(nearer, end_b, tube);
    c.along = select(steradian_transform(across, vec3f(1.0, 0.0, 0.0)), along, tube);
    c.toward = select(direction, cross(along, moment) * inverseSqrt(max(height2, smallest_square())), tube);
    c.at_a = select(0.0, at_a, tube);
    c.at_b = select(0.0, at_b, tube);
    c.span = select(0.0, sqrt(span2), tube);
    c.height = select(nearest, sqrt(height2), tube);
    c.radius = radius;
    c.outside = select(nearer2, height2, beside) > radius2;
    return c;
}

// Distance of the two touching planes' lines of touch from the point: sqrt(height^2 - radius^2).
fn capsule_touch(c: Capsule) -> f32 {
    return sqrt(max((c.height - c.radius) * (c.height + c.radius), 0.0));
}

// Half the angle of an end's arc [rad], in [0, pi], counted about the cap's centre. Those of the two ends sum to pi where they
// meet.
//
//   place     of the end along the axis, outward: -at_a of end_a, at_b of end_b
//   distance  of the end's centre
fn capsule_half_angle(c: Capsule, place: f32, distance: f32) -> f32 {
    return trig_atan2(capsule_touch(c), c.radius * place / max(distance, smallest_length()));
}

// Irradiance vector of a line's or a capsule's two great circles and the chords of its arcs, over 2 radius / height.
//
//   angle    of the great circles [rad]
//   share    of the chords' length in the width: sqrt(1 - (radius / height)^2), 1 for a line; the others as in Capsule
//
// The chords' parts nearly cancel for a short or distant light; their difference is formed on paper.
fn capsule_straight_part(along: vec3f, toward: vec3f, at_a: f32, at_b: f32, span: f32, height: f32, angle: f32, share: f32) -> vec3f {
    let h2 = height * height;
    let both = (h2 + at_a * at_a) * (h2 + at_b * at_b);
    let chords = share * span * height / max(both, smallest_square());
    return toward * (0.5 * (angle + chords * (h2 - at_a * at_b))) + along * (0.5 * chords * height * (at_a + at_b));
}

// Irradiance vector of the whole capsule, the horizon left out [sr].
//
//   c        prepared; the point is outside
//
// Degenerate: radius 0 gives 0.
// Error: relative to the value, but for what height and at_a, at_b lose of a capsule seen end-on.
// Source: this project; Stokes' theorem as in conic.glsl. Small circles: Lambert 1760.
fn capsule_whole_vector(c: Capsule) -> vec3f {
    let touch = capsule_touch(c);
    let angle = trig_atan2_unwrapped(c.span * touch, touch * touch + c.at_a * c.at_b);
    let share = touch / max(c.height, smallest_length());
    let slope = c.radius / max(c.height, smallest_length());
    var e = capsule_straight_part(c.along, c.toward, c.at_a, c.at_b, c.span, c.height, angle, share) * (2.0 * slope);
    let a2 = max(dot(c.end_a, c.end_a), smallest_square());
    let b2 = max(dot(c.end_b, c.end_b), smallest_square());
    let ia = inverseSqrt(a2);
    let ib = inverseSqrt(b2);
    let sine_a = c.radius * ia;
    let sine_b = c.radius * ib;
    e = e + c.end_a * (sine_a * sine_a * ia * capsule_half_angle(c, -c.at_a, sqrt(a2)));
    return e + c.end_b * (sine_b * sine_b * ib * capsule_half_angle(c, c.at_b, sqrt(b2)));
}

// Adds the arc of an end to a walk, clipped to the horizon z = 0.
//
//   center      of the end's ball
//   middle      unit, across `center`: where the arc's middle lies
//   half_angle  of the arc [rad], in [0, pi]
//   start, finish  unit directions of its ends, in walk order
//
// Where the arc crosses is decided by the ends' signs alone, as for straight edges (polygon_add_edge), so that both agree at
// the joints; an arc between two ends on one side crosses twice or not at all.
fn capsule_add_arc(walk: PolygonWalk, center: vec3f, radius: f32, middle: vec3f, half_angle: f32, start: vec3f, finish: vec3f) -> PolygonWalk {
    let d2 = max(dot(center, center), smallest_square());
    let distance = sqrt(d2);
    let inverse = 1.0 / distance;
    let tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    let root = sqrt(max((radius - center.z) * (radius + center.z), 0.0));

    // Angles about the cap's centre, from its highest point: of the horizon and of the arc's middle (mirrored: >= 0).
    var horizon = trig_atan2(distance * root, -tangent * center.z);
    horizon = select(select(0.0, steradian_pi(), center.z > 0.0), horizon, root > 0.0);
    let turn = trig_atan2(abs(middle.x * center.y - middle.y * center.x) * inverse, middle.z);
    let low = turn - half_angle;
    let high = turn + half_angle;
    let seen = max(min(high, horizon) - max(low, -horizon), 0.0) + max(high - (2.0 * steradian_pi() - horizon), 0.0);

    // Where the cap's rim crosses: azimuths left and right of the cap's own.
    let flat2 = max(center.x * center.x + center.y * center.y, smallest_square());
    let azimuth = vec2f(center.x, center.y) * inverseSqrt(flat2);
    let tilt = complex_sign(vec2f(tangent, root));
    let comes = complex_product(azimuth, tilt);
    let goes = complex_product(azimuth, vec2f(tilt.x, -tilt.y));

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
    next.horizon = complex_product(walk.horizon, complex_product(up, down));
    return next;
}

// Irradiance vector of the part of the capsule above the horizon [sr]; z is the irradiance for radiance 1, in [0, pi].
//
//   c        of capsule_prepare
//
// Degenerate: a capsule below the horizon and a point inside give 0.
// Error: docs/accuracy.md, "Float against double", capsule. Exact: two arcs, two edges and an arc of the horizon.
fn capsule_irradiance_vector(c: Capsule) -> vec3f {
    var e = capsule_whole_vector(c);
    let cut = min(c.end_a.z, c.end_b.z) < c.radius;
    if (cut) {
        let a2 = dot(c.end_a, c.end_a);
        let b2 = dot(c.end_b, c.end_b);
        let r2 = c.radius * c.radius;
        let side = cross(c.toward, c.along);
        let inward = c.toward * (r2 / max(c.height, smallest_length()));
        let aside = side * (c.radius * capsule_touch(c) / max(c.height, smallest_length()));
        let ia = inverseSqrt(max(a2 - r2, smallest_square()));
        let ib = inverseSqrt(max(b2 - r2, smallest_square()));
        let a_left = (c.end_a - inward + aside) * ia;
        let a_right = (c.end_a - inward - aside) * ia;
        let b_left = (c.end_b - inward + aside) * ib;
        let b_right = (c.end_b - inward - aside) * ib;
        let da = sqrt(max(a2, smallest_square()));
        let db = sqrt(max(b2, smallest_square()));
        let a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
        let b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
        var walk = polygon_begin();
        walk = capsule_add_arc(walk, c.end_a, c.radius, a_middle, capsule_half_angle(c, -c.at_a, da), a_left, a_right);
        walk = polygon_add_edge(walk, a_right, b_right);
        walk = capsule_add_arc(walk, c.end_b, c.radius, b_middle, capsule_half_angle(c, c.at_b, db), b_right, b_left);
        walk = polygon_add_edge(walk, b_left, a_left);
        let shows = max(c.end_a.z, c.end_b.z) > -c.radius;
        let above = polygon_irradiance_vector(walk, mask_none());
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
// Error: docs/accuracy.md, "Float against double", line. A capsule differs by at most docs/eval.md's bound.
// Source: as for any linear light; here the limit of capsule_whole_vector.
fn line_irradiance_vector(end_a: vec3f, end_b: vec3f) -> vec3f {
    let wa = abs(end_a.z);
    let wb = abs(end_b.z);
    let crossing = (end_a * wb + end_b * wa) * (1.0 / max(wa + wb, smallest_square()));
    let a = select(end_a, crossing, end_a.z < 0.0);
    let b = select(end_b, crossing, end_b.z < 0.0);
    let difference = b - a;
    let span2 = dot(difference, difference);
    let along = difference * inverseSqrt(max(span2, smallest_square()));
    let moment = cross(select(b, a, dot(a, a) < dot(b, b)), along);
    let height2 = max(dot(moment, moment), smallest_square());
    let height = sqrt(height2);
    let toward = cross(along, moment) * (1.0 / height);
    let span = sqrt(span2);
    let at_a = dot(a, along);
    let at_b = dot(b, along);
    let angle = trig_atan2_unwrapped(span * height, height2 + at_a * at_b);
    var e = capsule_straight_part(along, toward, at_a, at_b, span, height, angle, 1.0) * (1.0 / height);
    e = vec3f(e.x, e.y, max(e.z, 0.0));
    return select(e, vec3f(0.0, 0.0, 0.0), end_a.z <= 0.0 && end_b.z <= 0.0);
}

// Corners about the arc of one end.
//   center, middle, side  the rim is center + middle cos t + side sin t, vectors from the shading point
//   half_angle            the arc runs from -half_angle to half_angle [rad]
//   corners               how many, 1 or more
//   turn                  (cos, sin) of the place nearest to the lobe
//   beta                  1: equal steps; below, corners gather there
//   first, step           of the arc's parameter, half a turn a corner
struct CapsuleEnd {
    center: vec3f,
    middle: vec3f,
    side: vec3f,
    half_angle: f32,
    corners: f32,
    turn: vec2f,
    beta: f32,
    first: f32,
    step: f32,
}

// A polygon about a capsule's outline: straight edges stay straight, each arc becomes a chain of corners.
struct CapsuleFan {
    a: CapsuleEnd,
    b: CapsuleEnd,
}

// Prepares the arc of one end as a single step; capsule_fan divides it.
//
//   center      of the ball
//   middle      unit, across `center`, where the arc's middle lies
//   r, width    the lobe's unit axis and width [rad], as for ellipse_fan_concentrated
fn capsule_end(center: vec3f, radius: f32, middle: vec3f, half_angle: f32, r: vec3f, width: f32) -> CapsuleEnd {
    let d2 = max(dot(center, center), smallest_square());
    let inverse = inverseSqrt(d2);
    let sine = max(radius * inverse, smallest_length());
    let cosine2 = max(1.0 - sine * sine, smallest_length());
    let cosine = sqrt(cosine2);
    let axis = center * inverse;
    let side = cross(axis, middle);
    var end: CapsuleEnd;
    end.center = center * cosine2;
    end.middle = middle * (radius * cosine);
    end.side = side * (radius * cosine);
    end.half_angle = half_angle;

    // Where the lobe's axis meets the rim's plane, in units of the rim's radius.
    let along = dot(r, axis);
    let place = vec2f(dot(r, middle), dot(r, side)) * (cosine / (sine * max(along, 1.0e-12)));
    let nearest = clamp(trig_atan2(place.y, place.x), -half_angle, half_angle);
    end.turn = complex_unit(nearest);
    let apart = place - end.turn;
    let blur = min(1.6 * width / sine, 1.0e3);
    let beta = sqrt(min(0.5 * dot(apart, apart), 1.0e6) + blur * blur);
    end.beta = select(1.0, clamp(beta, 0.05, 1.0), along > 0.0);

    let low = complex_unit(-0.5 * (half_angle + nearest));
    let high = complex_unit(0.5 * (half_angle - nearest));
    end.first = trig_atan2(low.y, end.beta * low.x);
    end.step = trig_atan2(high.y, end.beta * high.x) - end.first;
    end.corners = 1.0;
    return end;
}

// (cos t, sin t) of corner j of an end, in the middle of its step.
//
// The outer ones lie on the straight edges' continuation and keep within 0.35 of the arc's ends: of 0.35, 0.5 and 0.7 the one
// with the smallest errors in the test CapsulePolygons.
fn capsule_corner(end: CapsuleEnd, j: f32) -> vec2f {
    let u = complex_unit(clamp(end.first + end.step * (j + 0.5), -steradian_pi(), steradian_pi()));
    let w = complex_sign(vec2f(u.x, end.beta * u.y));
    var corner = complex_product(complex_product(w, w), end.turn);
    let last = complex_unit(end.half_angle);
    let limit = vec2f(0.939372712847378920, 0.342897807455451364);  // (cos, sin) of 0.35
    let outer_low = j < 0.5;
    let outer_high = j > end.corners - 1.5;
    let low = vec2f(last.x, -last.y);
    corner = select(corner, complex_product(low, limit), outer_low && dot(corner, low) < limit.x);
    corner = select(corner, complex_product(last, vec2f(limit.x, -limit.y)), outer_high && dot(corner, last) < limit.x);
    return select(corner, vec2f(1.0, 0.0), outer_low && outer_high);
}

// What equal area needs of the square of a corner's radius, for the step to its neighbour, which stands on a straight edge's
// continuation where `outer`: that one's radius is given, and so is the area that it adds.
//
//   joint    (cos, sin) of the arc's end behind the neighbour
fn capsule_gap(corner: vec2f, neighbour: vec2f, joint: vec2f, outer: bool) -> f32 {
    let cosine = dot(corner, neighbour);
    var sine = abs(corner.x * neighbour.y - corner.y * neighbour.x);
    let angle = clamp(trig_atan2(sine, cosine), 0.0, 2.6);
    sine = select(0.515501371821464235, sine, cosine > -0.856888753368947234);
    let even = select(angle / max(sine, 1.0e-4), 1.0, angle < 1.0e-3);
    let c = max(dot(neighbour, joint), 0.5);
    let s = abs(neighbour.x * joint.y - neighbour.y * joint.x);
    var given = (even + (trig_atan2(s, c) - s / c) / max(sine, 1.0e-4)) * c;
    given = select(max(given, 0.5), 1.0, angle < 1.0e-3);
    return select(even, given * given, outer);
}

// Corner j of an end, as a vector from the shading point.
fn capsule_end_corner(end: CapsuleEnd, j: f32) -> vec3f {
    let here = capsule_corner(end, j);
    let last = complex_unit(end.half_angle);
    let low = vec2f(last.x, -last.y);
    let outer_low = j < 0.5;
    let outer_high = j > end.corners - 1.5;
    let before = capsule_gap(here, capsule_corner(end, j - 1.0), low, j < 1.5);
    let after = capsule_gap(here, capsule_corner(end, j + 1.0), last, j > end.corners - 2.5);
    let even = sqrt(0.5 * (before + after));
    let outer = 1.0 / max(dot(here, select(last, low, outer_low)), 0.5);
    let radius = select(even, outer, outer_low || outer_high);
    return end.center + (end.middle * here.x + end.side * here.y) * radius;
}

// Prepares a polygon about a capsule.
//
//   c        prepared; the point is outside
//   r        unit axis of the lobe
//   width    of the lobe [rad]: 1/sqrt(n + 1) of Phong
//   count    of all corners, 6 or more; each end has its share of the steps, at least one
fn capsule_fan(c: Capsule, r: vec3f, width: f32, count: i32) -> CapsuleFan {
    let da = sqrt(max(dot(c.end_a, c.end_a), smallest_square()));
    let db = sqrt(max(dot(c.end_b, c.end_b), smallest_square()));
    let angle_a = capsule_half_angle(c, -c.at_a, da);
    let angle_b = capsule_half_angle(c, c.at_b, db);
    let a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
    let b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
    var fan: CapsuleFan;
    fan.a = capsule_end(c.end_a, c.radius, a_middle, angle_a, r, width);
    fan.b = capsule_end(c.end_b, c.radius, b_middle, angle_b, r, width);
    let share = fan.a.step / max(fan.a.step + fan.b.step, smallest_length());
    fan.a.corners = 1.0 + floor(0.5 + f32(count - 2) * share);
    fan.b.corners = f32(count) - fan.a.corners;
    fan.a.step = fan.a.step / fan.a.corners;
    fan.b.step = fan.b.step / fan.b.corners;
    return fan;
}

// Corner k of the polygon, k from 0, as a vector from the shading point, in walk order. Only its direction counts: the
// corners of the two ends lie in different planes.
//
// Error: see docs/ggx.md, "Round lights".
fn capsule_fan_corner(fan: CapsuleFan, k: i32) -> vec3f {
    let first = f32(k) < fan.a.corners;
    var end: CapsuleEnd;
    end.center = select(fan.b.center, fan.a.center, first);
    end.middle = select(fan.b.middle, fan.a.middle, first);
    end.side = select(fan.b.side, fan.a.side, first);
    end.half_angle = select(fan.b.half_angle, fan.a.half_angle, first);
    end.corners = select(fan.b.corners, fan.a.corners, first);
    end.turn = select(fan.b.turn, fan.a.turn, first);
    end.beta = select(fan.b.beta, fan.a.beta, first);
    end.first = select(fan.b.first, fan.a.first, first);
    end.step = select(fan.b.step, fan.a.step, first);
    return capsule_end_corner(end, select(f32(k) - fan.a.corners, f32(k), first));
}

// ==== ellipsoid ====

// Spheres and ellipsoids as lights: their outline, seen from a point, is a planar ellipse.

// The ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point [m], and whether it can be seen.
struct EllipsoidOutline {
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
fn ellipsoid_outline(to_center: vec3f, s: mat3x3f, inverse: mat3x3f) -> EllipsoidOutline {
    let p = -steradian_transform(inverse, to_center);
    let d2 = dot(p, p);
    let safe = max(d2, 1.000001);
    let inverse_d = inverseSqrt(safe);
    let k = p * inverseSqrt(max(d2, smallest_divisor()));
    let rho = sqrt(1.0 - 1.0 / safe);
    let frame = frame_from_normal(k);
    let a = steradian_transform(frame, vec3f(rho, 0.0, 0.0));
    let b = steradian_transform(frame, vec3f(0.0, rho, 0.0));
    var outline: EllipsoidOutline;
    outline.center = to_center + steradian_transform(s, k * inverse_d);
    outline.axis_a = steradian_transform(s, a);
    outline.axis_b = steradian_transform(s, b);
    outline.outside = d2 > 1.000001;
    return outline;
}

// ==== horizon_clip ====

// Clipping a walked outline to the horizon, for integrals along its edges.
//
// Lambert's integral needs only the length of the arcs of the horizon that close a clipped outline
// (polygon_add_edge); every other boundary integral has to be taken along them. The clip hands them out as ordinary
// edges: where the outline comes back up, the arc from where it last went down. An outline that begins below the
// horizon comes up before it was seen to go down: this first entry is kept, and the last arc ends there.
// The arcs of a plane light lie on one half circle, and what counts is the signed sum over them; so arcs may join
// different contours, and one clip serves a whole light with its holes:
//
//   HorizonClip clip = horizon_clip_begin();
//   for each edge a, b of each contour:
//       clip = horizon_clip_edge(clip, a, b);
//       integrate clip.start, clip.end
//       if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
//   clip = horizon_clip_finish(clip);
//   if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
//
// Frame: z the surface normal; unit directions (polygon_direction) in walk order.

// The state of a clip and what it last handed out.
//   start, end          the edge's part above the horizon; equal where there is none
//   arc_start, arc_end  an arc of the horizon that belongs to the outline; equal where there is none
//   closes              whether there is an arc
//   leave               where the outline last went down and did not come back yet; zero: nowhere
//   entry               where it came up without having been seen to go down; zero: nowhere
struct HorizonClip {
    start: vec3f,
    end: vec3f,
    arc_start: vec3f,
    arc_end: vec3f,
    closes: bool,
    leave: vec3f,
    entry: vec3f,
}

// The state before the first edge.
fn horizon_clip_begin() -> HorizonClip {
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var clip: HorizonClip;
    clip.start = nowhere;
    clip.end = nowhere;
    clip.arc_start = nowhere;
    clip.arc_end = nowhere;
    clip.closes = mask_none();
    clip.leave = nowhere;
    clip.entry = nowhere;
    return clip;
}

// Where the edge from a to b crosses the plane z = 0; their z must differ in sign.
//
// Degenerate: an edge through the zenith's axis, or an end that is the zero vector, has no azimuth and gives zero.
// Error: weights of one sign, so nothing cancels unless a and b are nearly opposite.
fn horizon_crossing(a: vec3f, b: vec3f) -> vec3f {
    let wa = abs(b.z);
    let wb = abs(a.z);
    var p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    p = p * inverseSqrt(max(dot(p, p), smallest_square()));
    return vec3f(p.x, p.y, 0.0);
}

// Clips one edge.
//
//   a, b     unit directions of the edge's ends; z < 0 is below
//   returns  the state with start, end and, where the edge crosses and an arc is due, the arc
fn horizon_clip_edge(clip: HorizonClip, a: vec3f, b: vec3f) -> HorizonClip {
    var next = clip;
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    next.start = a;
    next.end = b;
    next.closes = mask_none();
    if (a_below || b_below) {
        let nowhere = vec3f(0.0, 0.0, 0.0);
        let crossing = horizon_crossing(a, b);
        next.start = select(a, crossing, a_below);
        next.end = select(b, crossing, b_below);  // both below: start = end
        let comes_up = a_below && !b_below;
        let goes_down = b_below && !a_below;
        let was_left = dot(clip.leave, clip.leave) > 0.5;
        // Going down twice: a contour ended below and the next began above. The first one's last arc is due.
        let due = goes_down && was_left;
        next.closes = (comes_up && was_left) || due;
        next.arc_end = select(crossing, clip.entry, due);
        next.arc_start = select(next.arc_end, clip.leave, next.closes);
        next.leave = select(select(clip.leave, nowhere, comes_up), crossing, goes_down);
        next.entry = select(select(clip.entry, nowhere, due), crossing, comes_up && !was_left);
    }
    return next;
}

// Ends the walk: the last arc, from where the outline went down to where it had first come up.
fn horizon_clip_finish(clip: HorizonClip) -> HorizonClip {
    var next = clip;
    next.closes = dot(clip.leave, clip.leave) > 0.5 && dot(clip.entry, clip.entry) > 0.5;
    next.start = clip.end;
    next.arc_start = select(clip.entry, clip.leave, next.closes);
    next.arc_end = clip.entry;
    return next;
}

// ==== lambert ====

// The diffuse surface: the same radiance to every side.

// Radiance that a Lambert surface of albedo 1 sends out, per radiance of the light.
//
//   irradiance  polygon_irradiance, in [0, pi]
fn lambert_radiance(irradiance: f32) -> f32 {
    return irradiance * inverse_pi();
}

// The lobe itself: BRDF of albedo 1 times the cosine of the light's direction l (unit, shading frame).
fn lambert_lobe(l: vec3f) -> f32 {
    return max(l.z, 0.0) * inverse_pi();
}

// ==== lobe_product ====

// The product of cosine lobes as one lobe: peak-matched, isotropic or anisotropic.
//
// P(u) = product of (u.r_i)^n_i is replaced by a lobe that has its maximum, at the same place, and its curvature
// there. Spherical Gaussians, the usual way, miss height and width from 30 degrees between the axes on.
// Any number of lobes is walked several times: twice for Newton steps towards the maximum, once for the result.
//
//   LobeProduct p = lobe_product_begin(start);          // start: direction of the sum of n_i r_i
//   for each lobe: p = lobe_product_add(p, r_i, n_i);
//   start = lobe_product_newton(p);                     // three lobes within 50 degrees: .003 degrees off after one
//   ... the same again, then
//   CosineLobe lobe = lobe_product_isotropic(p);
//
// Frame: any. Axes are unit vectors; the peak must lie in front of all of them, else the product is 0.
// Source: this project (docs/moments.md).

// A cosine lobe: scale (u.axis)^exponent.
struct CosineLobe {
    axis: vec3f,
    exponent: f32,
    scale: f32,
}

// A stretched cosine lobe: scale (w.z)^exponent with w the unit direction of lobe_product_stretch(lobe, u): about the z axis of its own frame.
struct StretchedLobe {
    frame: mat3x3f,
    stretch: vec3f,  // symmetric 2x2 of determinant 1: xx, xy, yy
    exponent: f32,
    scale: f32,
}

// Sums over the lobes, seen from a direction.
//   about      frame whose z is that direction
//   total      sum of n_i
//   log_scale  sum of n_i log(z.r_i)
//   slope      sum of n_i tau_i, tau_i = (r_i.x, r_i.y)/(r_i.z) in the frame
//   curvature  sum of n_i tau_i tau_i^T: xx, xy, yy
//   lowest     smallest z.r_i
struct LobeProduct {
    about: mat3x3f,
    total: f32,
    log_scale: f32,
    slope: vec2f,
    curvature: vec3f,
    lowest: f32,
}

// The state before the first lobe.
fn lobe_product_begin(direction: vec3f) -> LobeProduct {
    var p: LobeProduct;
    p.about = frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2f(0.0, 0.0);
    p.curvature = vec3f(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}

// Adds (u.r)^n.
fn lobe_product_add(p: LobeProduct, r: vec3f, n: f32) -> LobeProduct {
    let local = steradian_transform_transposed(p.about, r);
    let z = max(local.z, 1.0e-4);
    let x = local.x / z;
    let y = local.y / z;
    var next = p;
    next.total = p.total + n;
    next.log_scale = p.log_scale + n * log(z);
    next.slope = p.slope + vec2f(n * x, n * y);
    next.curvature = p.curvature + vec3f(n * x * x, n * x * y, n * y * y);
    next.lowest = min(p.lowest, local.z);
    return next;
}

// A direction nearer to the maximum: one Newton step on the logarithm, whose Hessian is -(total + curvature).
fn lobe_product_newton(p: LobeProduct) -> vec3f {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    let xy = p.curvature.y;
    let inverse = 1.0 / max(xx * yy - xy * xy, smallest_divisor());
    let step_to = vec3f(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    let u = steradian_transform(p.about, step_to);
    return u * inverseSqrt(dot(u, u));
}

// Height of the product at the sums' direction; 0 where a lobe does not reach.
fn lobe_product_scale(p: LobeProduct) -> f32 {
    return select(0.0, exp(p.log_scale), p.lowest > 1.0e-4);
}

// The isotropic lobe; its exponent gives the full lobe's integral the right size.
fn lobe_product_isotropic(p: LobeProduct) -> CosineLobe {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    var lobe: CosineLobe;
    lobe.axis = steradian_transform(p.about, vec3f(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = lobe_product_scale(p);
    return lobe;
}

// The anisotropic lobe. A linear map of determinant 1 turns it into an isotropic one and polygons into polygons:
// the integral over a light is scale times the moment of the stretched outline about z.
fn lobe_product_anisotropic(p: LobeProduct) -> StretchedLobe {
    let xx = p.total + p.curvature.x + 3.0;
    let yy = p.total + p.curvature.z + 3.0;
    let xy = p.curvature.y;
    let d = sqrt(max(xx * yy - xy * xy, smallest_divisor()));
    // The root of a symmetric matrix M of determinant 1 is (M + 1)/sqrt(trace M + 2).
    let root = inverseSqrt((xx + yy) / d + 2.0);
    var lobe: StretchedLobe;
    lobe.frame = p.about;
    lobe.stretch = vec3f(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = lobe_product_scale(p);
    return lobe;
}

// A direction in the lobe's stretched frame. It is not unit; the zero vector stays zero.
fn lobe_product_stretch(lobe: StretchedLobe, u: vec3f) -> vec3f {
    let l = steradian_transform_transposed(lobe.frame, u);
    return vec3f(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}

// The maximum of (u.r1)^n1 (u.r2)^n2, in closed form: it lies in the plane of the two axes.
//
// Degenerate: axes 90 degrees apart and more give a direction where the product is about 0; equal axes give r1.
fn lobe_product_peak_of_two(r1: vec3f, n1: f32, r2: vec3f, n2: f32) -> vec3f {
    let cosine = max(dot(r1, r2), 1.0e-6);
    let across = r2 - r1 * dot(r1, r2);
    let sine2 = dot(across, across);
    let tangent = sqrt(sine2) / cosine;
    let sum = n1 + n2;
    let t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    let u = r1 + across * (t * inverseSqrt(max(sine2, smallest_divisor())));
    return u * inverseSqrt(dot(u, u));
}

// ==== microfacet ====

// Microfacet terms: GGX and Beckmann distributions, height-correlated Smith shadowing, Schlick's Fresnel.
//
// Frame: z the surface normal, x and y the directions of the widths ax and ay (equal where isotropic). l light,
// v view, h half vector, all unit and pointing away from the surface. Width alpha = roughness squared, at least 1.0e-4.

// Half vector of light and view. Degenerate: l = -v gives the zero vector.
fn microfacet_half_vector(l: vec3f, v: vec3f) -> vec3f {
    let h = l + v;
    return h * inverseSqrt(max(dot(h, h), smallest_square()));
}

// Distribution of GGX: 1 / (pi ax ay ((h_x/ax)^2 + (h_y/ay)^2 + h_z^2)^2).
//
// In the components of h, not in 1 - h_z^2, which cancels in float at small alpha.
// Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction", 2007, eq. 33; anisotropic: Heitz,
// "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014, eq. 85.
fn ggx_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let x = h.x / ax;
    let y = h.y / ay;
    let d = x * x + y * y + h.z * h.z;
    return inverse_pi() / (ax * ay * d * d);
}

// Length of the direction w stretched by the surface: sqrt(w_z^2 + (ax w_x)^2 + (ay w_y)^2).
fn ggx_stretched_length(w: vec3f, ax: f32, ay: f32) -> f32 {
    let x = ax * w.x;
    let y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Smith's shadowing and masking, height-correlated, in [0, 1].
//
// Degenerate: 0 where l or v is not above the surface.
// Source: Heitz 2014, eq. 99, written without Lambda: 2 l_z v_z / (l_z |v|' + v_z |l|').
fn ggx_shadowing(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let lz = max(l.z, 0.0);
    let vz = max(v.z, 0.0);
    let d = lz * ggx_stretched_length(v, ax, ay) + vz * ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, smallest_square());
}

// Schlick's Fresnel with a free value at grazing.
//
//   f0, f90  reflectance along and across the normal
//   v_dot_h  cosine between view and half vector
//
// Source: Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, eq. 15.
fn fresnel_schlick(f0: f32, f90: f32, v_dot_h: f32) -> f32 {
    let x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    let x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Distribution of Beckmann: exp(-((h_x/ax)^2 + (h_y/ay)^2)/h_z^2) / (pi ax ay h_z^4).
//
// Degenerate: h_z is kept above 1.0e-5, where the exponential is 0 for any alpha up to 1.
// Source: Walter et al. 2007, eq. 25.
fn beckmann_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let hz = max(h.z, 1.0e-5);
    let x = h.x / (ax * hz);
    let y = h.y / (ay * hz);
    let z2 = hz * hz;
    return inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}

// A microfacet lobe without shadowing and Fresnel: BRDF times cosine, D / (4 v_z).
//
//   d        distribution at the half vector
//   l, v     directions; 0 where either is not above the surface
fn microfacet_lobe_unshadowed(d: f32, l: vec3f, v: vec3f) -> f32 {
    let above = l.z > 0.0 && v.z > 0.0;
    return select(0.0, d / (4.0 * max(v.z, 1.0e-6)), above);
}

// The GGX lobe with shadowing, without Fresnel: BRDF times cosine, D G2 / (4 v_z).
fn ggx_lobe(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let h = microfacet_half_vector(l, v);
    let g = ggx_shadowing(l, v, ax, ay);
    return microfacet_lobe_unshadowed(ggx_distribution(h, ax, ay) * g, l, v);
}

// ==== phong ====

// Lobes that are a power of a cosine: Phong about the mirrored view, Blinn-Phong about the normal.

// The logarithm of x for x in (0, 1], with small relative error up to 1: near 1 a GPU's own log promises 5e-7 of absolute error, and a
// high exponent multiplies it.
//
// Error: relative 1e-7 in float for x above 0.75, 3e-16 in double; below as the built-in log.
fn phong_log(x: f32) -> f32 {
    let near = 0.75;
    var result = log(x);
    let high = x > near;
    if (high) {
        // d - d^2 / (2 + d) is twice t, the first term of twice the inverse hyperbolic tangent of t: so d, which is exact, carries
        // most of the digits. The next term is 2 t^9 / 9, relative 2e-8 at t = 1/7.
        let d = x - 1.0;
        let t = d / (2.0 + d);
        let t2 = t * t;
        let series = d - t * (d - t2 * (0.666666666666666667 + t2 * (0.4 + t2 * 0.285714285714285714)));
        result = select(result, series, high);
    }
    return result;
}

// The power x^n, for x in [0, 1] and n >= 0, as exp(n log x).
//
// Degenerate: x <= 1.0e-30 counts as 1.0e-30 (0 for any n of use; n = 0 gives 1).
// Error: relative, n |log x| roundings of the logarithm: where the power is not small, a few units of 1.0e-7 in float.
fn phong_power(x: f32, n: f32) -> f32 {
    return exp(n * phong_log(max(x, smallest_divisor())));
}

// The view mirrored at the surface.
//
//   v        view direction, shading frame
fn phong_mirror(v: vec3f) -> vec3f {
    return vec3f(-v.x, -v.y, v.z);
}

// The Phong lobe: (n + 1) / (2 pi) max(l.r, 0)^n. Its integral over the sphere is 1; it has no foreshortening.
//
//   l        unit direction of the light, r unit axis of the lobe
//   n        exponent, at least 0
//
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017, eq. 10.
fn phong_lobe(l: vec3f, r: vec3f, n: f32) -> f32 {
    return (n + 1.0) * inverse_two_pi() * phong_power(dot(l, r), n);
}

// Distribution of half vectors of Blinn-Phong: (n + 2) / (2 pi) h_z^n, normalised over projected solid angle.
//
//   h        unit half vector, shading frame
fn blinn_phong_distribution(h: vec3f, n: f32) -> f32 {
    return (n + 2.0) * inverse_two_pi() * phong_power(h.z, n);
}

// ==== ggx_closed_form ====

// The GGX lobe over a light in closed form: what the distribution of half vectors alone sends, without shadowing and
// Fresnel (ggx_cubature.glsl adds both).
//
// In stretched half vector space, u = normalize(h_x/ax, h_y/ay, h_z) and w = (ax v_x, ay v_y, v_z), the lobe is the plain
// measure: D(h) (v.h) dh = (w.u) du / pi. The integral over the light is (w.E) / (pi v_z), E the irradiance vector of the
// light's image. A light edge is an arc l(angle); with tau = tan(angle/2) its image is the conic
//   u(tau) = S (l + v) (1 + tau^2),  S = diag(1/ax, 1/ay, 1):
//
//   E = sum of conic_vector(ggx_edge(view, a, b)) over the edges clipped to the horizon (horizon_clip.glsl),
//   negated where the light is seen from behind; then ggx_unshadowed(view, E).
//
// docs/ggx.md has the derivation.
// Frame: z the surface normal, x and y the directions of the widths. Walk order, as polygon.glsl has it.

// What the lobe's integrals need of the view and the surface.
//   v        unit view, z > 0
//   w        (ax v_x, ay v_y, v_z): w.u is v.h in stretched space
//   ax, ay   widths: roughness squared, at least 1.0e-4
//   masking  the view's |v|' / v_z of Smith's shadowing, at least 1
struct GgxView {
    v: vec3f,
    w: vec3f,
    ax: f32,
    ay: f32,
    masking: f32,
}

// Prepares a view.
//
// Degenerate: a view at or below the surface counts as v_z = 1.0e-6; callers give 0 for it.
fn ggx_view(v: vec3f, ax: f32, ay: f32) -> GgxView {
    var view: GgxView;
    let z = max(v.z, 1.0e-6);
    view.v = vec3f(v.x, v.y, z);
    view.w = vec3f(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}

// One edge of a light as an arc in stretched half vector space.
//
//   a, b     unit directions of the ends, in walk order, not below the horizon
//
// tau counts from the edge's middle; where the middle is near the view, and u2 = S (v - l) would vanish, from the end that
// is further from it.
// Degenerate: a = b, and a = -b, which spans no plane, give an arc of no length.
fn ggx_edge(view: GgxView, a: vec3f, b: vec3f) -> ConicArc {
    let chord = b - a;
    let sum = a + b;
    let chord2 = dot(chord, chord);
    let sum2 = dot(sum, sum);
    let usable = chord2 > smallest_divisor() && sum2 > 1.0e-12;
    let middle = sum * inverseSqrt(max(sum2, smallest_divisor()));
    let along = chord * inverseSqrt(max(chord2, smallest_square()));
    let half_sine = 0.5 * sqrt(chord2);
    let half_cosine = max(0.5 * sqrt(sum2), 1.0e-6);

    let from_end = dot(middle, view.v) > 0.9;
    let side = select(0.0, select(1.0, -1.0, dot(chord, view.v) > 0.0), from_end);
    let turn_cosine = select(1.0, half_cosine, from_end);
    let base = middle * turn_cosine + along * (side * half_sine);
    let q = along * turn_cosine - middle * (side * half_sine);
    let reach = select(0.0, half_sine / (half_cosine + select(1.0, 0.0, from_end)), usable);

    let x = 1.0 / view.ax;
    let y = 1.0 / view.ay;
    let u0 = view.v + base;
    let u2 = view.v - base;
    return conic_prepare(
        vec3f(u0.x * x, u0.y * y, u0.z), vec3f(q.x * x, q.y * y, q.z) * 2.0, vec3f(u2.x * x, u2.y * y, u2.z),
        select(-reach, 0.0, side < 0.0), select(reach, 0.0, side > 0.0));
}

// Radiance that the distribution of half vectors alone sends to the view, for radiance 1: INT D / (4 v_z) over the light.
//
//   e        sum over the edges of conic_vector, negated where the light is seen from behind
//   returns  not negative; above 1 is possible, since nothing shadows: 5.4 at alpha 0.72 and 86 degrees
fn ggx_unshadowed(view: GgxView, e: vec3f) -> f32 {
    return max(dot(view.w, e), 0.0) * inverse_pi() / view.v.z;
}

// ==== ggx_cubature ====

// Shadowing and Fresnel over a light: the mean of G2 F under the closed form's measure, by a few nodes that the poles place.
//
// Second walk over the edges, with the sum E of the first (ggx_closed_form.glsl):
//   GgxCubature c = ggx_cubature_begin(view, e, smith, facing);
//   for each edge: c = ggx_cubature_edge(c, edge, extra_nodes);
//   vec2 r = ggx_cubature_finish(c);         // or, without the second walk: ggx_draft(view, e, smith, facing)
//   radiance = ggx_radiance(r, f0, f90)      // per channel
//
// In stretched half vector space the light's image is fanned about its centre us = E/|E|. Nodes go along each edge by
// equal steps of the angle under which the poles see it, and inwards by the moments of a spherical triangle.
// The measure itself is exact; only the smooth factor G2 F is sampled.

// The state of the second walk.
//   centre          us
//   amount          what the distribution alone sends (ggx_unshadowed)
//   extent          the length of E
//   smith           1 with shadowing, 0 without
//   facing          -1 where the light is seen from behind
//   weight          sum of the weights; weighted: of weight times (G2, G2 (1 - v.h)^5)
//   centre_weight   share of the weights that belongs to the centre
//   at_centre       (G2, G2 (1 - v.h)^5) there
//   lowest, highest of all values with weight
struct GgxCubature {
    view: GgxView,
    centre: vec3f,
    amount: f32,
    extent: f32,
    smith: f32,
    facing: f32,
    weight: f32,
    centre_weight: f32,
    weighted: vec2f,
    at_centre: vec2f,
    lowest: vec2f,
    highest: vec2f,
}

// Shadowing, and shadowing times Schlick's (1 - v.h)^5, at a direction of stretched half vector space.
//
//   u        unit
//   smith    1 with shadowing, 0 without
//   returns  (0, 0) where the mirrored light is not above the surface
fn ggx_shadowing_and_fresnel(view: GgxView, u: vec3f, smith: f32) -> vec2f {
    var h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    h = h * inverseSqrt(max(dot(h, h), smallest_divisor()));
    let v_dot_h = clamp(dot(view.v, h), 0.0, 1.0);
    let l = h * (2.0 * v_dot_h) - view.v;
    let lz = max(l.z, 0.0);
    let shadowing = 2.0 * lz / max(lz * view.masking + ggx_stretched_length(l, view.ax, view.ay), smallest_divisor());
    let g = select(0.0, 1.0 + smith * (shadowing - 1.0), l.z > 0.0);
    let x = 1.0 - v_dot_h;
    let x2 = x * x;
    return vec2f(g, g * (x2 * x2 * x));
}

// Starts the second walk.
//
//   e        sum of the edge vectors of the first walk, in the order in which the edges were walked
//   smith    1.0: height-correlated shadowing; 0.0: none
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
fn ggx_cubature_begin(view: GgxView, e: vec3f, smith: f32, facing: f32) -> GgxCubature {
    var c: GgxCubature;
    let inward = e * facing;
    let length2 = dot(inward, inward);
    let usable = length2 > smallest_square();
    c.view = view;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, smallest_square())), usable);
    c.amount = select(0.0, ggx_unshadowed(view, inward), usable);
    c.extent = sqrt(length2);
    c.smith = smith;
    c.facing = facing;
    c.weight = 0.0;
    c.centre_weight = 0.0;
    c.weighted = vec2f(0.0, 0.0);
    c.at_centre = ggx_shadowing_and_fresnel(view, c.centre, smith);
    c.lowest = c.at_centre;
    c.highest = c.at_centre;
    return c;
}

// Adds one node.
//
//   u        unit direction in stretched half vector space
//   weight   0 for a lane that does not have this node
fn ggx_cubature_add(c: GgxCubature, u: vec3f, weight: f32) -> GgxCubature {
    var next = c;
    let o = weight * max(dot(c.view.w, u), 0.0);
    let g = ggx_shadowing_and_fresnel(c.view, u, c.smith);
    let counts = abs(o) > 0.0;
    next.weight = c.weight + o;
    next.weighted = c.weighted + g * o;
    next.lowest = select(c.lowest, vec2f(min(c.lowest.x, g.x), min(c.lowest.y, g.y)), counts);
    next.highest = select(c.highest, vec2f(max(c.highest.x, g.x), max(c.highest.y, g.y)), counts);
    return next;
}

// Node j of the rule with n nodes, n differing from lane to lane in 1 to 6: vec2(node, weight), weight 0 from j = n on.
fn ggx_rule(n: f32, j: i32) -> vec2f {
    var r = gauss_legendre_node(1, j);
    for (var k: i32 = 2; k <= 6; k++) {
        r = select(r, gauss_legendre_node(k, j), n > f32(k) - 0.5);
    }
    return r;
}

// Adds the nodes of one edge.
//
//   extra    more nodes along the edge than its angle asks for, and always the finer rule inwards: 0 is normal, 2 high quality
//
// Along the edge: 1 to 4 nodes for angles up to 0.25, 0.8, 1.6 and beyond. Inwards, in cos: two rules for a fan triangle,
// exact to degree 2 (with the centre and 2/3) and 4 (with the centre and two more: Radau's), the finer from 0.5 on.
fn ggx_cubature_edge(c: GgxCubature, edge: ConicArc, extra: i32) -> GgxCubature {
    var next = c;
    let total = edge.sweep.x + edge.sweep.y;
    let n = 1.0 + select(1.0, 0.0, total < 0.25) + select(1.0, 0.0, total < 0.8) + select(1.0, 0.0, total < 1.6) + f32(extra);
    var fine = total >= 0.5;
    if (extra > 0) {
        fine = total > -1.0;
    }
    for (var j: i32 = 0; j < 4 + extra; j++) {
        let present = n > f32(j) + 0.5 && total > 0.0;
        if (present) {
            let rule = ggx_rule(n, j);
            let node = conic_node(edge, rule.x);
            let u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
            let du = edge.u1 + edge.u2 * (2.0 * node.tau);
            let inverse2 = 1.0 / max(dot(u, u), smallest_divisor());
            let rim = u * sqrt(inverse2);
            let rim_cosine = dot(rim, c.centre);
            let out_of_centre = rim - c.centre * rim_cosine;
            let outward = out_of_centre * inverseSqrt(max(dot(out_of_centre, out_of_centre), smallest_divisor()));
            var om = dot(c.centre, cross(u, du)) * (c.facing * inverse2 * rule.y * total / node.density)
                / (1.0 + max(rim_cosine, -0.9));  // solid angle of the fan
            om = select(0.0, om, present);

            let first = select(0.666666666666666667, 0.355051025721682190, fine);
            let first_weight = select(0.75, 0.512485826188421615, fine);
            let centre_weight = select(0.25, 0.111111111111111111, fine);
            var cosine = 1.0 - (1.0 - rim_cosine) * first;
            var sine = sqrt(max(1.0 - cosine * cosine, 0.0));
            next = ggx_cubature_add(next, c.centre * cosine + outward * sine, om * first_weight);
            next.centre_weight = next.centre_weight + om * centre_weight;
            if (fine && present) {
                cosine = 1.0 - (1.0 - rim_cosine) * 0.844948974278317810;
                sine = sqrt(max(1.0 - cosine * cosine, 0.0));
                om = select(0.0, om * 0.376403062700467274, fine);
                next = ggx_cubature_add(next, c.centre * cosine + outward * sine, om);
            }
        }
    }
    return next;
}

// Limits what leaves: with shadowing no lobe sends more than it gets.
//
//   mean     means of (G2, G2 (1 - v.h)^5)
fn ggx_limited(amount: f32, mean: vec2f, smith: f32) -> vec2f {
    var whole = amount * mean.x;
    whole = select(whole, min(whole, 1.0), smith > 0.5);
    return vec2f(whole, clamp(amount * mean.y, 0.0, whole));
}

// Ends the second walk.
//
//   returns  radiance for radiance 1 as two numbers for ggx_radiance: with F = 1, and with F = (1 - v.h)^5
//
// Degenerate: weights that cancel leave the centre's value.
// Error: see docs/accuracy.md, "GGX with shadowing and Fresnel".
fn ggx_cubature_finish(c: GgxCubature) -> vec2f {
    // The centre's values are known all along, its weight only now.
    let o = c.centre_weight * max(dot(c.view.w, c.centre), 0.0);
    let weight = c.weight + o;
    let usable = weight > 1.0e-9 * c.extent;
    let scale = 1.0 / select(1.0, weight, usable);
    var mean = (c.weighted + c.at_centre * o) * scale;
    mean = vec2f(clamp(mean.x, c.lowest.x, c.highest.x), clamp(mean.y, c.lowest.y, c.highest.y));
    mean = select(c.at_centre, mean, usable);
    return ggx_limited(c.amount, mean, c.smith);
}

// Shadowing and Fresnel at the centre only: one walk. Arguments as ggx_cubature_begin, result as ggx_cubature_finish.
fn ggx_draft(view: GgxView, e: vec3f, smith: f32, facing: f32) -> vec2f {
    let c = ggx_cubature_begin(view, e, smith, facing);
    return ggx_limited(c.amount, c.at_centre, smith);
}

// Radiance of one channel, for radiance 1.
//
//   r        of ggx_cubature_finish or ggx_draft
//   f0, f90  Schlick's reflectances
fn ggx_radiance(r: vec2f, f0: f32, f90: f32) -> f32 {
    return f0 * (r.x - r.y) + f90 * r.y;
}

// ==== moment ====

// Axial moments of spherical polygons: the integral of max(u.r, 0)^n over a light, for the Phong lobe about r.
//
// With m = n + 1, theta the angle from r and psi the azimuth about r,
//     m * moment = closed integral over the outline of (1 - max(cos theta, 0)^m) dpsi
// for any real n > -1, as long as -r is not inside (docs/moments.md derives it). No parity of n, no solid angle, no
// vertices on the lobe's equator. On an edge, phi is the angle along its great circle from the foot, the point
// nearest to r, where u.r = c; s = sin of the angle from r to the circle's plane; x = u.r = c cos phi and
// y = c sin phi. The edge's share is
//     sign(s) * ( |s| * integral of (1 - x^m)/(1 - x^2) dphi  over the part in front of the lobe's equator
//                 + the azimuth that the part behind sweeps ).
// moment_edge finds what every method shares; the methods, a file each, integrate the part in front.
//
// Frame: any; r is the unit axis. Edges in walk order (kernels/outline/polygon.glsl), clipped to the surface's horizon
// (kernels/outline/horizon_clip.glsl) before, so that -r cannot be inside a light.
// Source: Arvo, "Applications of irradiance tensors to the simulation of non-Lambertian phenomena", 1995; Lecocq,
// Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017. The form without
// parity is this project's own.

// One edge, seen from the lobe's axis.
//   side            sign of s, +1 or -1; 0 for an edge without length
//   s, c            |s| and the cosine that belongs to it
//   x0, y0, x1, y1  the ends of the part in front, (c cos phi, c sin phi); equal where there is none
//   log_c           -log(c^2), accurate for c near 1
//   swept           azimuth that the part behind sweeps, positive [rad]
struct MomentEdge {
    side: f32,
    s: f32,
    c: f32,
    x0: f32,
    y0: f32,
    x1: f32,
    y1: f32,
    log_c: f32,
    swept: f32,
}

// log(1 + z) for z >= 0. Error: relative 3e-7 in float, 1e-13 in double.
fn moment_log_1_plus(z: f32) -> f32 {
    let near = 0.25;
    // Twice the inverse hyperbolic tangent of t; the next term is t^10 / 11.
    let t = z / (2.0 + z);
    let t2 = t * t;
    let series = 2.0 * t * (1.0 + t2 * (0.333333333333333333 + t2 * (0.2 + t2 * (0.142857142857142857 + t2 * 0.111111111111111111))));
    return select(log(1.0 + z), series, z < near);
}

// 1 - exp(-x) for x >= 0. Error: relative 3e-7 in float, 1e-13 in double.
fn moment_1_minus_exp(x: f32) -> f32 {
    let near = 0.25;
    var result = 1.0 - exp(-x);
    let small = x < near;
    if (small) {
        // Taylor, nested; the next term is x^6 / 5040.
        let series = x * (1.0 - 0.5 * x * (1.0 - 0.333333333333333333 * x * (1.0 - 0.25 * x * (1.0 - 0.2 * x * (1.0 - 0.166666666666666667 * x)))));
        result = select(result, series, small);
    }
    return result;
}

// Angle in [0, pi] from the direction (w x0, y0) to (w x1, y1): the definite integral of atan(tan(phi) / w).
fn moment_angle(w: f32, x0: f32, y0: f32, x1: f32, y1: f32) -> f32 {
    return trig_atan2_unwrapped(w * (x0 * y1 - x1 * y0), w * w * x0 * x1 + y0 * y1);
}

// -log(1 - s2), from s2 where it is small and from c2 = 1 - s2 where that is. Error: relative 3e-6 in float, 1e-13.
fn moment_minus_log_cosine2(s2: f32, c2: f32) -> f32 {
    let near = 0.05;
    var result = -log(c2);
    let small = s2 < near;
    if (small) {
        // Taylor; the next term is s2^7 / 7.
        let series = s2 * (1.0 + s2 * (0.5 + s2 * (0.333333333333333333 + s2 * (0.25 + s2 * (0.2 + s2 * 0.166666666666666667)))));
        result = select(result, series, small);
    }
    return result;
}

// Prepares one edge.
//
//   a, b     unit directions of the edge's ends, in walk order
//   r        unit axis of the lobe
//
// Degenerate: a = b, a = -b or a zero vector gives an edge that adds nothing. An axis within 1e-3 of the normal of
// the edge's plane sees the whole edge near its equator, where the integrand is 1: all of it counts as swept.
fn moment_edge(a: vec3f, b: vec3f, r: vec3f) -> MomentEdge {
    let pole2 = 1.0e-6;
    var n = cross(a, b);
    let n2 = dot(n, n);
    let has_length = n2 > smallest_divisor();
    n = n * inverseSqrt(max(n2, smallest_divisor()));
    let s = dot(n, r);
    let q = cross(n, r);
    // The share vanishes with s, like s sqrt(n/2) in the highlight: a floor of 1e-10 would show there.
    let s2 = clamp(s * s, smallest_divisor(), 1.0);
    let c2 = clamp(dot(q, q), pole2, 1.0);

    var edge: MomentEdge;
    edge.side = select(0.0, select(1.0, -1.0, s < 0.0), has_length);
    edge.s = s2 * inverseSqrt(s2);
    edge.c = c2 * inverseSqrt(c2);
    edge.log_c = moment_minus_log_cosine2(s2, c2);
    let x0 = dot(a, r);
    let y0 = dot(a, q);
    let x1 = dot(b, r);
    let y1 = dot(b, q);
    edge.x0 = x0;
    edge.y0 = y0;
    edge.x1 = x1;
    edge.y1 = y1;
    edge.swept = 0.0;
    let behind0 = x0 <= 0.0;
    let behind1 = x1 <= 0.0;
    let pole = x0 * x0 + y0 * y0 < pole2;
    if (behind0 || behind1 || pole) {
        // The lobe's equator cuts the circle at phi = -pi/2 and pi/2.
        let none = (behind0 && behind1) || pole;
        edge.x0 = select(x0, 0.0, behind0 || none);
        edge.y0 = select(select(y0, -edge.c, behind0), edge.c, none);
        edge.x1 = select(x1, 0.0, behind1 || none);
        edge.y1 = select(y1, edge.c, behind1 || none);
        let whole = moment_angle(edge.s, x0, y0, x1, y1);
        let in_front = moment_angle(edge.s, edge.x0, edge.y0, edge.x1, edge.y1);
        var swept = select(max(whole - in_front, 0.0), whole, none);
        if (pole) {
            let arc = trig_atan2(sqrt(n2), dot(a, b));
            swept = select(swept, arc, pole);
        }
        edge.swept = select(0.0, swept, behind0 || behind1 || pole);
    }
    return edge;
}

// The edge's share of m times the moment.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, by any method
fn moment_edge_share(edge: MomentEdge, front: f32) -> f32 {
    return edge.side * (front + edge.swept);
}

// Radiance of an energy-normalised Phong lobe of albedo 1 under radiance 1, in [0, 1].
//
//   sum      of the edges' shares
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Source: Lecocq et al. 2017, eq. 10: (n + 1)/(2 pi) times the moment; without foreshortening.
fn moment_phong_radiance(sum: f32, reversed: bool) -> f32 {
    return clamp(select(sum, -sum, reversed) * inverse_two_pi(), 0.0, 1.0);
}

// ==== moment_quadrature ====

// The Phong lobe's boundary integral by Gauss-Legendre quadrature in the ellipsoid's angle u (moment_series.glsl).
//
// The reference for the methods in constant time: exact up to quadrature, any real n > -1. The library's exact form
// subdivides moment_quadrature_piece until it converges (source/moment/exact_moment.cpp); moment_quadrature_front
// is the fixed rule, 14 nodes for each side of the foot.
// The variable of integration is t = tan(u/2), in [-1, 1] in front: no trigonometry.
// Source: this project (docs/moments.md); nodes: roots of the Legendre polynomial of degree 14.

// What the integrand needs of an edge and a lobe.
//   t0, t1   ends of the part in front
struct MomentQuadrature {
    m: f32,
    s2: f32,
    c2: f32,
    kap: f32,
    w: f32,
    t0: f32,
    t1: f32,
}

// The parameter t = tan(u/2) of the direction (w x, y), x >= 0, whose angle is u.
fn moment_quadrature_parameter(w: f32, x: f32, y: f32) -> f32 {
    let wx = w * x;
    return clamp(y / max(wx + sqrt(wx * wx + y * y), smallest_length()), -1.0, 1.0);
}

// Prepares the integrand of one edge for a lobe of exponent n.
fn moment_quadrature_prepare(edge: MomentEdge, n: f32) -> MomentQuadrature {
    var q: MomentQuadrature;
    q.m = n + 1.0;
    q.s2 = edge.s * edge.s;
    q.c2 = edge.c * edge.c;
    q.kap = sqrt(moment_1_minus_exp(0.5 * q.m * edge.log_c));
    q.w = edge.s / q.kap;
    q.t0 = moment_quadrature_parameter(q.w, edge.x0, edge.y0);
    q.t1 = moment_quadrature_parameter(q.w, edge.x1, edge.y1);
    return q;
}

// Both integrands at t, with du/dt included.
//   moment   |s| (1 - x^m)/(1 - x^2) dphi = kap E du, E = w^2 (1 - x^m)/Q, Q = s^2 cos^2 u + w^2 sin^2 u
//   power    x^m dphi
struct MomentIntegrands {
    moment: f32,
    power: f32,
}

// The integrands at one t.
fn moment_quadrature_integrands(q: MomentQuadrature, t: f32) -> MomentIntegrands {
    let t2 = t * t;
    let d = 1.0 / (1.0 + t2);
    let cos_u = max((1.0 - t2) * d, 1.0e-15);
    let sin_u = 2.0 * t * d;
    let cos2 = cos_u * cos_u;
    let wsin2 = q.w * q.w * sin_u * sin_u;
    let Q = q.s2 * cos2 + wsin2;
    let exponent = 0.5 * q.m * moment_log_1_plus(Q / (q.c2 * cos2));  // -log(x^m)
    var result: MomentIntegrands;
    result.moment = 2.0 * d * q.kap * q.w * q.w * moment_1_minus_exp(exponent) / Q;
    result.power = 2.0 * d * q.w * exp(-exponent) / (cos2 + wsin2);
    return result;
}

// Adds one pair of nodes at mid - offset and mid + offset.
fn moment_quadrature_pair(sum: MomentIntegrands, q: MomentQuadrature, mid: f32, offset: f32, weight: f32) -> MomentIntegrands {
    let a = moment_quadrature_integrands(q, mid - offset);
    let b = moment_quadrature_integrands(q, mid + offset);
    var next: MomentIntegrands;
    next.moment = sum.moment + weight * (a.moment + b.moment);
    next.power = sum.power + weight * (a.power + b.power);
    return next;
}

// Both integrals from t = low to t = high.
fn moment_quadrature_piece(q: MomentQuadrature, low: f32, high: f32) -> MomentIntegrands {
    let mid = 0.5 * (low + high);
    let h = 0.5 * (high - low);
    var sum: MomentIntegrands;
    sum.moment = 0.0;
    sum.power = 0.0;
    sum = moment_quadrature_pair(sum, q, mid, h * 0.986283808696812339, h * 0.035119460331751863);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.928434883663573517, h * 0.080158087159760210);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.827201315069764993, h * 0.121518570687903185);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.687292904811685470, h * 0.157203167158193535);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.515248636358154092, h * 0.185538397477937814);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.319112368927889760, h * 0.205198463721295604);
    sum = moment_quadrature_pair(sum, q, mid, h * 0.108054948707343662, h * 0.215263853463157790);
    return sum;
}

// Both integrals over the part in front of an edge.
//   moment   |s| times the integral of (1 - x^m)/(1 - x^2) dphi, m = n + 1
//   power    the integral of x^m dphi
//
// Error: see docs/accuracy.md, "phong quadrature".
fn moment_quadrature_front(edge: MomentEdge, n: f32) -> MomentIntegrands {
    let q = moment_quadrature_prepare(edge, n);
    let to0 = moment_quadrature_piece(q, 0.0, q.t0);
    let to1 = moment_quadrature_piece(q, 0.0, q.t1);
    var result: MomentIntegrands;
    result.moment = max(to1.moment - to0.moment, 0.0);
    result.power = max(to1.power - to0.power, 0.0);
    return result;
}

// ==== moment_series ====

// The Phong lobe's boundary integral in constant time: the matched ellipsoid and its cosine series.
//
// The integrand (1 - x^m)/(1 - x^2) is compared with that of the ellipsoid which has the same peak and the same
// far tail. In the ellipsoid's own angle u, tan u = tan(phi)/w, w = |s|/kap, kap^2 = 1 - c^m,
//     |s| * integral of the integrand dphi = kap * integral of E(u) du,
// exactly; E is even, periodic in pi, 1 at both ends, and within 0.3 of 1 between: a few cosines give it. Their
// amplitudes depend on kap^2 and 1/m alone and carry the factor 1 - kap^2 = c^m, so that the error vanishes away
// from the highlight. Valid for n >= 1; moment_cosine.glsl serves 0 <= n < 1.
// Coefficients: tools/fit_phong_series finds them; the test PhongSeries.CoefficientsAreTheFittedOnes compares.
// Source: this project (docs/moments.md).

// A lobe's series: amplitude of harmonic k is (1 - kap2) times a cubic in kap2, constant first.
struct MomentSeries {
    m: f32,
    b0: vec4f,
    b1: vec4f,
    b2: vec4f,
    b3: vec4f,
}

// The series of high quality: two harmonics more, each a quintic; low holds its first three coefficients.
struct MomentSeriesHigh {
    m: f32,
    low0: vec3f,
    high0: vec3f,
    low1: vec3f,
    high1: vec3f,
    low2: vec3f,
    high2: vec3f,
    low3: vec3f,
    high3: vec3f,
    low4: vec3f,
    high4: vec3f,
    low5: vec3f,
    high5: vec3f,
}

// The series of the lobe of exponent n. Prepare once per lobe.
// Largest error 2.7e-04 of the full lobe for a piece of an edge that begins at the foot.
fn moment_series_prepare(n: f32) -> MomentSeries {
    let g = 1.0 / (n + 1.0);
    var series: MomentSeries;
    series.m = n + 1.0;
    series.b0 = vec4f(
        0.12391 + g * (-0.25888 + g * 0.02078),
        0.07456 + g * (-0.20614 + g * 0.11305),
        -0.12583 + g * (0.43406 - g * 0.36368),
        0.15639 + g * (-0.50303 + g * 0.37906));
    series.b1 = vec4f(
        -0.03292 + g * (0.01056 + g * 0.11495),
        0.06163 + g * (-0.30904 + g * 0.37892),
        -0.11837 + g * (0.57004 - g * 0.68066),
        0.14285 + g * (-0.68183 + g * 0.80688));
    series.b2 = vec4f(
        -0.13853 + g * (0.41672 - g * 0.28568),
        -0.06770 + g * (0.08453 + g * 0.12882),
        0.04014 + g * (0.23881 - g * 0.72146),
        -0.07736 + g * (-0.16196 + g * 0.72256));
    series.b3 = vec4f(
        0.05051 + g * (-0.15092 + g * 0.09913),
        -0.07193 + g * (0.41519 - g * 0.56582),
        0.16852 + g * (-0.91416 + g * 1.19835),
        -0.20343 + g * (1.12430 - g * 1.49409));
    return series;
}

// Largest error 5.2e-05 of the full lobe for a piece of an edge that begins at the foot.
fn moment_series_high_prepare(n: f32) -> MomentSeriesHigh {
    let g = 1.0 / (n + 1.0);
    var series: MomentSeriesHigh;
    series.m = n + 1.0;
    series.low0 = vec3f(
        0.12669 + g * (-0.27819 + g * 0.04967),
        0.07312 + g * (-0.20720 + g * 0.11887),
        -0.28171 + g * (0.96646 - g * 0.78366));
    series.high0 = vec3f(
        0.96760 + g * (-3.22789 + g * 2.51001),
        -1.31672 + g * (4.38441 - g * 3.39728),
        0.67908 + g * (-2.22981 + g * 1.68799));
    series.low1 = vec3f(
        -0.03401 + g * (0.03357 + g * 0.07057),
        0.06494 + g * (-0.35196 + g * 0.45924),
        -0.35605 + g * (1.94458 - g * 2.56698));
    series.high1 = vec3f(
        1.18702 + g * (-6.44998 + g * 8.48253),
        -1.61836 + g * (8.78673 - g * 11.54971),
        0.82904 + g * (-4.48596 + g * 5.88295));
    series.low2 = vec3f(
        -0.13696 + g * (0.38633 - g * 0.22764),
        -0.06158 + g * (0.07469 + g * 0.12325),
        0.10552 + g * (0.38974 - g * 1.38750));
    series.high2 = vec3f(
        -0.41931 + g * (-1.05462 + g * 4.38637),
        0.57016 + g * (1.43774 - g * 5.97208),
        -0.30823 + g * (-0.67167 + g * 2.98664));
    series.low3 = vec3f(
        0.04598 + g * (-0.11007 + g * 0.03214),
        -0.06747 + g * (0.36907 - g * 0.48289),
        0.33782 + g * (-1.67745 + g * 2.03933));
    series.high3 = vec3f(
        -1.15579 + g * (5.80262 - g * 7.12399),
        1.57642 + g * (-7.90773 + g * 9.70255),
        -0.81732 + g * (4.11164 - g * 5.05901));
    series.low4 = vec3f(
        0.00469 + g * (-0.08385 + g * 0.15819),
        -0.00971 + g * (0.12521 - g * 0.23654),
        0.23694 + g * (-1.87957 + g * 3.05375));
    series.high4 = vec3f(
        -0.72818 + g * (5.87109 - g * 9.60316),
        0.99890 + g * (-8.04735 + g * 13.15881),
        -0.50043 + g * (4.05438 - g * 6.64504));
    series.low5 = vec3f(
        -0.01005 + g * (0.07653 - g * 0.11794),
        -0.00224 + g * (0.01770 - g * 0.03021),
        -0.00365 + g * (-0.11481 + g * 0.29662));
    series.high5 = vec3f(
        0.03795 + g * (0.13754 - g * 0.56050),
        -0.05687 + g * (-0.14794 + g * 0.70035),
        0.04439 + g * (-0.05460 - g * 0.13949));
    return series;
}

// A harmonic's amplitude over 1 - kap2, at t = kap2.
fn moment_series_cubic(b: vec4f, t: f32) -> f32 {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}

// A harmonic's amplitude over 1 - kap2 in high quality, at t = kap2.
fn moment_series_quintic(low: vec3f, high: vec3f, t: f32) -> f32 {
    return ((((high.z * t + high.y) * t + high.x) * t + low.z) * t + low.y) * t + low.x;
}

// The part in front in the ellipsoid's own angle.
//   kap, kap2  of the ellipsoid
//   du         angle from end to end [rad]
//   cosine     twice the cosine of 2u at end 0 and end 1
//   sine       the sine of 2u
struct MomentWarp {
    kap: f32,
    kap2: f32,
    du: f32,
    cosine: vec2f,
    sine: vec2f,
}

// Finds the ellipsoid of one edge for a lobe of exponent m - 1.
fn moment_warp(edge: MomentEdge, m: f32) -> MomentWarp {
    var warp: MomentWarp;
    warp.kap2 = moment_1_minus_exp(0.5 * m * edge.log_c);
    let over_kap = inverseSqrt(warp.kap2);
    warp.kap = warp.kap2 * over_kap;
    let w = edge.s * over_kap;
    let wx0 = w * edge.x0;
    let wx1 = w * edge.x1;
    warp.du = trig_atan2_unwrapped(wx0 * edge.y1 - wx1 * edge.y0, wx0 * wx1 + edge.y0 * edge.y1);
    // One division for both ends: they are at least c^2 w^2, 1e-10 where the pole begins.
    let d0 = wx0 * wx0 + edge.y0 * edge.y0;
    let d1 = wx1 * wx1 + edge.y1 * edge.y1;
    let over_both = 2.0 / max(d0 * d1, smallest_divisor());
    let scale0 = over_both * d1;
    let scale1 = over_both * d0;
    warp.cosine = vec2f(scale0 * (wx0 * wx0 - edge.y0 * edge.y0), scale1 * (wx1 * wx1 - edge.y1 * edge.y1));
    warp.sine = vec2f(scale0 * wx0 * edge.y0, scale1 * wx1 * edge.y1);
    return warp;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   edge     by moment_edge
//   series   by moment_series_prepare, n >= 1
//
// Error: see docs/accuracy.md, "phong series": 3e-4 of the full lobe's 2 pi for each side of the foot.
fn moment_series_front(edge: MomentEdge, series: MomentSeries) -> f32 {
    let warp = moment_warp(edge, series.m);
    let t = warp.kap2;
    // sin(2(k + 1)u) = 2 cos(2u) sin(2ku) - sin(2(k - 1)u), at both ends.
    let s1 = warp.sine;
    let s2 = vec2f(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    let s3 = vec2f(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    let bump = moment_series_cubic(series.b0, t) * warp.du
              + moment_series_cubic(series.b1, t) * (s1.y - s1.x) * 0.5
              + moment_series_cubic(series.b2, t) * (s2.y - s2.x) * 0.25
              + moment_series_cubic(series.b3, t) * (s3.y - s3.x) * 0.166666666666666667;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// What moment_series_front returns, in high quality. Error: about 5e-5 of the full lobe for each side of the foot.
fn moment_series_high_front(edge: MomentEdge, series: MomentSeriesHigh) -> f32 {
    let warp = moment_warp(edge, series.m);
    let t = warp.kap2;
    let s1 = warp.sine;
    let s2 = vec2f(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    let s3 = vec2f(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    let s4 = vec2f(warp.cosine.x * s3.x - s2.x, warp.cosine.y * s3.y - s2.y);
    let s5 = vec2f(warp.cosine.x * s4.x - s3.x, warp.cosine.y * s4.y - s3.y);
    let bump = moment_series_quintic(series.low0, series.high0, t) * warp.du
              + moment_series_quintic(series.low1, series.high1, t) * (s1.y - s1.x) * 0.5
              + moment_series_quintic(series.low2, series.high2, t) * (s2.y - s2.x) * 0.25
              + moment_series_quintic(series.low3, series.high3, t) * (s3.y - s3.x) * 0.166666666666666667
              + moment_series_quintic(series.low4, series.high4, t) * (s4.y - s4.x) * 0.125
              + moment_series_quintic(series.low5, series.high5, t) * (s5.y - s5.x) * 0.1;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// ==== moment_cosine ====

// Powers of the cosine along an edge, the exact double-axis moment, and the Phong series below exponent 1.
//
// The integral of cos^n from the foot is an incomplete beta function. With v^2 = -2 log cos phi it becomes that of
// exp(-(n + 1/2) v^2/2) (1 - v^4/48 ...): an error function and one correction. For n < 8 two steps of the recurrence
// over n lead to where that is close.
// Source: this project (docs/moments.md); the double-axis moment: Arvo 1995, sec. 5.

// The integral of cos^n phi from the foot to the end (x, y) = (c cos phi, c sin phi), |phi| <= pi/2, n >= 4.
//
// Error: relative to the integral up to pi/2, 7e-5 at n = 4, 7e-6 at n = 8, 3e-6 at n = 10, 2e-7 at n = 20.
// Source of the error function: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
fn moment_cosine_from_foot(x: f32, y: f32, n: f32) -> f32 {
    let a = n + 0.5;
    let v2 = moment_log_1_plus(y * y / max(x * x, smallest_divisor()));
    let t = 0.5 * a * v2;
    let v = sqrt(v2);
    let decay = exp(-t);
    let e = 1.0 / (1.0 + 0.3275911 * sqrt(t));
    let p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    // The correction's share of the integral up to pi/2, which is sqrt(pi/(2 a)) (1 - 1/(16 a^2)).
    let correction = v * (v2 + 3.0 / a) * inverseSqrt(a) / (60.1590786 - 3.75994241 / (a * a));
    // Half the beta function B(1/2, (n+1)/2): Gamma(h + 1)/Gamma(h + 1/2) squared is k + 1/(32 k) - 9/(2048 k^3),
    // k = h + 1/4, h = n/2, to 2e-5 at n = 4 and 4e-7 at n = 8.
    let k = 0.5 * n + 0.25;
    let quarter_turn = 0.886226925452758014 * inverseSqrt(k + 0.03125 / k - 0.00439453125 / (k * k * k));
    let magnitude = quarter_turn * (1.0 - decay * (p - correction));
    return select(magnitude, -magnitude, y < 0.0);
}

// The integral of x^n dphi, x = c cos phi, over the part in front of one edge; n >= 0.
//
//   low      1 for n < 8, else 0; the same for every lane
//
// Error: at most 9e-5 of the integral over a half circle for n >= 0, 4e-5 for n >= 1, 7e-6 for n >= 5.
fn moment_cosine_front(edge: MomentEdge, n: f32, low: i32) -> f32 {
    var order = n;
    if (low == 1) {
        order = n + 4.0;
    }
    let cosines = moment_cosine_from_foot(edge.x1, edge.y1, order) - moment_cosine_from_foot(edge.x0, edge.y0, order);
    var result = exp(-0.5 * order * edge.log_c) * cosines;
    if (low == 1) {
        // (n + 1) c^2 int x^n = (n + 2) int x^(n+2) - [x^(n+1) y], twice.
        let c2 = edge.c * edge.c;
        let p0 = phong_power(edge.x0, n + 1.0) * edge.y0;
        let p1 = phong_power(edge.x1, n + 1.0) * edge.y1;
        result = ((n + 4.0) * result - (p1 * edge.x1 * edge.x1 - p0 * edge.x0 * edge.x0)) / ((n + 3.0) * c2);
        result = ((n + 2.0) * result - (p1 - p0)) / ((n + 1.0) * c2);
    }
    return max(result, 0.0);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, for m = n + 1 below 2.
//
//   n        exponent, in [0, 1)
//   raised   the series of exponent n + 2: (1 - x^m)/(1 - x^2) = (1 - x^(m+2))/(1 - x^2) - x^m
fn moment_series_low_front(edge: MomentEdge, raised: MomentSeries, n: f32) -> f32 {
    return max(moment_series_front(edge, raised) - edge.s * moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// What moment_series_low_front returns, in high quality; the error is then that of the cosines.
fn moment_series_high_low_front(edge: MomentEdge, raised: MomentSeriesHigh, n: f32) -> f32 {
    return max(moment_series_high_front(edge, raised) - edge.s * moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// One edge's share of (n + 2) times the double-axis moment, the integral of max(u.r, 0)^n (u.v) over a light.
//
//   a, b     as for moment_edge, r unit axis of the power, v the other axis, of any length
//   share    moment_edge_share with exponent n - 1 (m = n), by any method, n >= 1
//   cosines  the integral of x^n dphi over the part in front, by any method
//
// Exact as far as share and cosines are: foreshortening (v the normal) and the v.h of half-vector space need no
// product of lobes.
fn moment_double_axis_share(a: vec3f, b: vec3f, r: vec3f, v: vec3f, share: f32, cosines: f32) -> f32 {
    let n = cross(a, b);
    let n2 = dot(n, n);
    let inward = dot(n, v) * inverseSqrt(max(n2, smallest_divisor()));
    return dot(r, v) * share + select(0.0, inward * cosines, n2 > smallest_divisor());
}

// ==== half_vector ====

// Lobes of half vectors by edge splitting: a light's edge is split into arcs, each arc's image in half vector space is
// replaced by the great circle between its ends, and the lobe's integral is closed along great circles.
//
// For lobes that have no closed form along the image itself (Blinn-Phong, Beckmann); GGX for comparison with
// ggx_closed_form.glsl. The arcs go where the edge passes the lobe: the poles of the GGX lobe of the same width say where.
//
//   ConicArc edge = ggx_edge(view, a, b);
//   for j in 0 .. count - 1:
//       p = half_vector_at(view, edge, half_vector_split_pole_mapped(edge, j / count)), q the next one
//       sum of blinn_phong_arc or beckmann_arc, then half_vector_radiance; of ggx_arc, then ggx_draft
//
// Frame and order: as ggx_closed_form.glsl.

// The GGX width whose lobe is as wide as Blinn-Phong's of exponent n: both have the mean squared slope 2 / (n + 2).
fn blinn_phong_alpha(n: f32) -> f32 {
    return sqrt(2.0 / (n + 2.0));
}

// Unit half vector at a place of an edge.
fn half_vector_at(view: GgxView, edge: ConicArc, tau: f32) -> vec3f {
    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    return h * inverseSqrt(max(dot(h, h), smallest_divisor()));
}

// The place at a share of the edge's angle, seen from the surface: equal arcs on the light.
fn half_vector_split_uniform(edge: ConicArc, share: f32) -> f32 {
    let first = trig_atan2(edge.scale * edge.begin, 1.0);
    let last = trig_atan2(edge.scale * edge.end, 1.0);
    let u = complex_unit(first + share * (last - first));
    return clamp(u.y / max(u.x * edge.scale, smallest_length()), edge.begin, edge.end);
}

// The place at a share of the angle C under which the poles see the edge, plus 0.3 for the edge's own length: arcs where
// the edge passes the lobe, and some for the rest.
//
// Newton's steps where they halve what is left, else the middle of a bracket: 4 or 5 as a rule, 24 at most. A split that is
// a little off costs nothing.
// Source: this project; the share 0.3 keeps arcs for where the lobe is dim (table in docs/ggx.md).
fn half_vector_split_pole_mapped(edge: ConicArc, share: f32) -> f32 {
    let first = trig_atan2(edge.scale * edge.begin, 1.0);
    let last = trig_atan2(edge.scale * edge.end, 1.0);
    let weight = 0.3 / max(last - first, 1.0e-12);
    let total = edge.sweep.x + edge.sweep.y + 0.3;
    let node = conic_node(edge, share);
    var tau = node.tau;
    var low = edge.begin;
    var high = edge.end;
    var left = total;
    var off = edge.end > edge.begin;
    for (var i: i32 = 0; i < 24; i++) {
        if (off) {
            let t = edge.scale * tau;
            let value = conic_sweep(edge.z1, edge.begin, tau) + conic_sweep(edge.z2, edge.begin, tau)
                + weight * (trig_atan2(t, 1.0) - first) - share * total;
            let x1 = tau - edge.z1.x;
            let x2 = tau - edge.z2.x;
            let slope = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
                + weight * edge.scale / (1.0 + t * t);
            low = select(low, tau, value < 0.0);
            high = select(tau, high, value < 0.0);
            let next = tau - value / slope;
            let fast = next > low && next < high && abs(value) < 0.5 * left;
            off = off && abs(value) > 1.0e-4 * total;
            left = abs(value);
            tau = select(tau, select(0.5 * (low + high), next, fast), off);
        }
    }
    return tau;
}

// One arc's share of Blinn-Phong: 2 pi v_z times the radiance, exact along the great circle.
//
//   a, b     unit half vectors of the arc's ends, in walk order
//   v        unit view
//   n        exponent, at least 0
//
// (n + 2) / (2 pi) h_z^n (v.h) is a double-axis moment, of axes z and v.
fn blinn_phong_arc(a: vec3f, b: vec3f, v: vec3f, n: f32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = moment_edge(a, b, z);
    let front = moment_quadrature_front(edge, max(n, 1.0e-6) - 1.0);
    return moment_double_axis_share(a, b, z, v, moment_edge_share(edge, front.moment), front.power);
}

// One arc's share of Blinn-Phong as in blinn_phong_arc, by the cosine series and the error function instead of quadrature.
//
//   series   of exponent n - 1, or of n + 1 where n < 2
//   range    0 for n >= 8, 1 for 2 <= n < 8, 2 for n < 2; the same for every lane
//
// Error: of the series, see docs/accuracy.md, "phong series".
fn blinn_phong_arc_approximate(a: vec3f, b: vec3f, v: vec3f, series: MomentSeries, n: f32, range: i32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = moment_edge(a, b, z);
    var front = 0.0;
    if (range == 2) {
        front = moment_series_low_front(edge, series, n - 1.0);
    } else {
        front = moment_series_front(edge, series);
    }
    var low: i32 = 0;
    if (range > 0) {
        low = 1;
    }
    return moment_double_axis_share(a, b, z, v, moment_edge_share(edge, front), moment_cosine_front(edge, n, low));
}

// The error function. Error: 1.5e-7 absolute.
// Source: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
fn beckmann_error_function_approximate(x: f32) -> f32 {
    let t = abs(x);
    let e = 1.0 / (1.0 + 0.3275911 * t);
    let p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    let y = 1.0 - p * exp(-min(t * t, 80.0));
    return select(y, -y, x < 0.0);
}

// The series that beckmann_arc takes: that of an infinite exponent.
fn beckmann_series() -> MomentSeriesHigh {
    var series = moment_series_high_prepare(1.0e30);
    series.m = 2.0;  // log_c below is the square of the distance
    return series;
}

// One arc's share of Beckmann: 2 pi v_z times the radiance.
//
//   a, b     unit half vectors of the arc's ends, in walk order, above the surface
//   series   beckmann_series()
//
// In the plane of slopes, divided by the widths, a great circle is a straight line and the lobe exp(-p^2) / pi times
// w.(p, 1): the constant part is Phong's boundary integral at infinite exponent, the linear one an error function.
// Error: of the series; see docs/accuracy.md, "half vector".
fn beckmann_arc(view: GgxView, a: vec3f, b: vec3f, series: MomentSeriesHigh) -> f32 {
    let za = 1.0 / max(a.z, 1.0e-6);
    let zb = 1.0 / max(b.z, 1.0e-6);
    let p = vec2f(a.x * za / view.ax, a.y * za / view.ay);
    let q = vec2f(b.x * zb / view.ax, b.y * zb / view.ay);
    var along = q - p;
    let length2 = dot(along, along);
    let usable = length2 > smallest_divisor();
    along = along * inverseSqrt(max(length2, smallest_divisor()));
    let d = p.x * along.y - p.y * along.x;
    let low = dot(p, along);
    let high = dot(q, along);

    var edge: MomentEdge;
    edge.side = select(1.0, -1.0, d < 0.0);
    edge.s = max(abs(d), 1.0e-6);
    edge.c = 1.0;
    edge.x0 = 1.0;
    edge.y0 = low;
    edge.x1 = 1.0;
    edge.y1 = high;
    edge.log_c = min(edge.s * edge.s, 80.0);
    edge.swept = 0.0;
    let around = moment_edge_share(edge, moment_series_high_front(edge, series));
    let across = exp(-edge.log_c) * 0.886226925452758014
        * (beckmann_error_function_approximate(high) - beckmann_error_function_approximate(low));
    let share = view.w.z * around + (view.w.y * along.x - view.w.x * along.y) * across;
    return select(0.0, share, usable);
}

// One arc's share of E (ggx_closed_form.glsl) for GGX, exact along the great circle.
fn ggx_arc(view: GgxView, a: vec3f, b: vec3f) -> vec3f {
    let p = polygon_direction(vec3f(a.x / view.ax, a.y / view.ay, a.z));
    let q = polygon_direction(vec3f(b.x / view.ax, b.y / view.ay, b.z));
    return polygon_edge(p, q);
}

// Radiance from the sum over the arcs, for radiance 1; not negative.
//
//   facing   1.0; -1.0 where the light is seen from behind
fn half_vector_radiance(view: GgxView, sum: f32, facing: f32) -> f32 {
    return max(sum * facing, 0.0) * inverse_two_pi() / view.v.z;
}

// ==== ltc ====

// Linearly transformed cosines: area lights on glossy surfaces by a table look-up and a polygon integral.
//
// A lobe is a clamped cosine under a linear map M. The integral of the lobe over a light is the cosine's integral over
// the light under M^-1. Shading frame: z the surface normal, x along the view's projection, so that the unit view
// is (s, 0, c). The caller fetches table values at ltc_coordinates and passes them in. See docs/ltc.md.
// Source: Heitz, Dupuy, Hill, Neubelt, "Real-time polygonal-light shading with linearly transformed cosines", 2016.

// The inverse matrix M^-1 of a linearly transformed cosine, up to a positive factor: rows (xx, 0, xz), (0, yy, 0), (zx, 0, zz); its determinant is positive.
struct LtcMatrix {
    xx: f32,
    xz: f32,
    yy: f32,
    zx: f32,
    zz: f32,
}

// The place where a table is read: both coordinates are in [0, 1], and the outer nodes stand on the ends.
//
//   roughness  perceptual: the square root of alpha
//   n_dot_v    cosine of the view
fn ltc_coordinates(roughness: f32, n_dot_v: f32) -> vec2f {
    return vec2f(clamp(roughness, 0.0, 1.0), sqrt(clamp(1.0 - n_dot_v, 0.0, 1.0)));
}

// The matrix as the literature's texture stores it.
//
//   t        M^-1 divided by its middle element: column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2
fn ltc_from_classic(t: vec4f) -> LtcMatrix {
    var m: LtcMatrix;
    m.xx = t.x;
    m.xz = t.z;
    m.yy = 1.0;
    m.zx = t.y;
    m.zz = t.w;
    return m;
}

// The matrix from the compact table, in which it is stored about the mirror direction and divided by alpha.
//
//   e        entries (0,0), (1,1), (0,2), (2,0) of R^T M over alpha, M scaled so that entry (2,2) of R^T M is 1;
//            R turns z into the mirror direction (-s, 0, c)
//   alpha    roughness squared, at least 1.0e-4
//   view     unit, in the shading frame: (s, 0, c). Take s from the frame, not from sqrt(1 - c*c), which
//            loses half the digits near the normal, where a narrow lobe needs them
//
// A lobe that is stored about the normal (diffuse, sheen) passes alpha = 1 and view = (0, 0, 1).
fn ltc_from_compact(e: vec4f, alpha: f32, view: vec3f) -> LtcMatrix {
    let tilt = alpha * e.z;
    let shear = alpha * e.w;
    let width = alpha * e.x;
    var m: LtcMatrix;
    m.xx = view.z + tilt * view.x;
    m.xz = view.x - tilt * view.z;
    m.yy = (e.x - tilt * e.w) / e.y;
    m.zx = -(shear * view.z + width * view.x);
    m.zz = width * view.z - shear * view.x;
    return m;
}

// The vector M^-1 v, up to the matrix' factor, for any vector v of the shading frame.
fn ltc_transform(m: LtcMatrix, v: vec3f) -> vec3f {
    return vec3f(m.xx * v.x + m.xz * v.z, m.yy * v.y, m.zx * v.x + m.zz * v.z);
}

// The lobe's density per solid angle at the unit direction l: |M^-1| max(w_z, 0) / (pi |w|^4) with w = M^-1 l.
fn ltc_lobe(m: LtcMatrix, l: vec3f) -> f32 {
    let w = ltc_transform(m, l);
    let d2 = max(dot(w, w), smallest_length());
    let determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    return determinant * max(w.z, 0.0) * inverse_pi() / (d2 * d2);
}

// The lobe's share above the real horizon, in [0, 1]; tables hold magnitudes divided by it.
//
// Under M^-1 the sky becomes a half space, which shares a lune with the cosine's: (1 + cosine of their angle) / 2.
fn ltc_energy_above_horizon(m: LtcMatrix) -> f32 {
    return 0.5 + 0.5 * m.xx * inverseSqrt(max(m.xx * m.xx + m.zx * m.zx, smallest_square()));
}

// The state of a walk along a light's outline under M^-1.
//   lobe      what the clipped edges add up to
//   anchor    where the outline first crossed the real horizon, under M^-1
//   anchored  whether it did
struct LtcWalk {
    lobe: PolygonWalk,
    anchor: vec3f,
    anchored: bool,
}

// A walk with no edge yet.
fn ltc_begin() -> LtcWalk {
    var walk: LtcWalk;
    walk.lobe = polygon_begin();
    walk.anchor = vec3f(0.0, 0.0, 0.0);
    walk.anchored = mask_none();
    return walk;
}

// Unit direction of a vertex under M^-1.
//
//   v        vertex or direction in the shading frame
fn ltc_direction(m: LtcMatrix, v: vec3f) -> vec3f {
    return polygon_direction(ltc_transform(m, v));
}

// Adds one edge, clipped to the real horizon, then to the lobe's.
//
//   a, b     ends in the shading frame, in walk order: polygon_direction of the vertices
//   ta, tb   ltc_direction(m, a) and ltc_direction(m, b): a vertex is transformed once for its two edges
//
// Clipping to the real horizon leaves gaps along it, from each crossing down to the next crossing up. They lie on one
// line of the light's plane, so that the way from one to the other may go by any point of that line: a crossing down
// adds the edge to the first crossing of the walk, a crossing up the edge from it, in whatever order they come.
//
// Degenerate: an edge below the real horizon adds nothing, exactly: a light below it gives 0.
fn ltc_add_edge(walk: LtcWalk, m: LtcMatrix, a: vec3f, b: vec3f, ta: vec3f, tb: vec3f) -> LtcWalk {
    var next = walk;
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    if (!a_below || !b_below) {
        var start = ta;
        var end = tb;
        if (a_below || b_below) {
            let none = vec3f(0.0, 0.0, 0.0);
            let crosses = (a_below && !b_below) || (b_below && !a_below);
            let wa = abs(b.z);
            let wb = abs(a.z);
            let horizon = vec3f(a.x * wa + b.x * wb, a.y * wa + b.y * wb, 0.0);
            let crossing = select(none, ltc_direction(m, horizon), crosses);
            start = select(ta, crossing, a_below);
            end = select(tb, crossing, b_below);
            // The first crossing is its own anchor: an edge of no length.
            if (crosses && walk.anchored) {
                let closes = crosses && walk.anchored;
                let departure = select(crossing, walk.anchor, a_below);
                let arrival = select(walk.anchor, crossing, a_below);
                next.lobe = polygon_add_edge(next.lobe, select(none, departure, closes), select(none, arrival, closes));
            }
            next.anchor = select(walk.anchor, crossing, crosses && !walk.anchored);
            next.anchored = walk.anchored || crosses;
        }
        next.lobe = polygon_add_edge(next.lobe, start, end);
    }
    return next;
}

// Integral of the lobe over the part of the light above the real horizon, in [0, 1].
//
//   reversed true where the light is seen from behind
fn ltc_integral(walk: LtcWalk, reversed: bool) -> f32 {
    return polygon_irradiance(walk.lobe, reversed) * inverse_pi();
}

// What multiplies the lobe's integral: Schlick's Fresnel averaged over the lobe.
//
//   n_a      magnitude of the lobe without Fresnel
//   f_a      of the lobe times (1 - v.h)^5
fn ltc_specular_scale(f0: f32, f90: f32, n_a: f32, f_a: f32) -> f32 {
    return f0 * n_a + (f90 - f0) * f_a;
}

// The specular radiance where the lobe times (1 - v.h)^5 has a matrix of its own (table of fit --fresnel-lobe).
//
//   integral, grazing  ltc_integral with the lobe's and with the Fresnel lobe's matrix
fn ltc_specular_with_fresnel_lobe(f0: f32, f90: f32, n_a: f32, integral: f32, f_a: f32, grazing: f32) -> f32 {
    return f0 * n_a * integral + (f90 - f0) * f_a * grazing;
}

// Factor on the specular radiance that returns what single scattering loses between the facets.
//
//   f0       reflectance along the normal
//   albedo   of the lobe with F = 1: n_a times ltc_energy_above_horizon, in (0, 1]
//
// Source: Turquin, "Practical multiple scattering compensation for microfacet models", 2019, eq. 16.
fn ltc_multiple_scattering(f0: f32, albedo: f32) -> f32 {
    let a = clamp(albedo, 1.0e-2, 1.0);
    return 1.0 + f0 * (1.0 - a) / a;
}

// A surface under a clear coat of glTF: the coat reflects its share and dims what lies below.
//
//   base       radiance of the surface below
//   coat       radiance of the coat's lobe with its own Fresnel (f0 0.04) in it
//   clearcoat  strength in [0, 1]
//   n_dot_v    cosine of the view to the coat's normal
fn ltc_clear_coat(base: f32, coat: f32, clearcoat: f32, n_dot_v: f32) -> f32 {
    let f = fresnel_schlick(0.04, 1.0, n_dot_v);
    return base * (1.0 - clearcoat * f) + clearcoat * coat;
}

// A surface under sheen of glTF: what the cloth's fibres reflect does not reach what lies below.
//
//   base      radiance of the surface below
//   sheen     radiance of the sheen lobe, its colour included
//   strongest largest component of the sheen's colour
//   albedo    of the sheen lobe at this view: n_a times ltc_energy_above_horizon
fn ltc_sheen(base: f32, sheen: f32, strongest: f32, albedo: f32) -> f32 {
    return base * clamp(1.0 - strongest * albedo, 0.0, 1.0) + sheen;
}

// ==== ltc_texture ====

// Textured lights: where on a light a lobe looks, and how widely.
//
// The mean of a texture over a light, weighted with the lobe, is read from blurred copies of the texture: around the
// point where the irradiance vector of the light under M^-1, brought back by M, meets the light's plane. The footprint is a
// cone of directions about that vector in the cosine's space, cut by the plane: an ellipse. Its radii are those of a thin
// cone, per radian; the caller multiplies them by the widths of docs/ltc.md, "Textured lights":
//
//   LtcTextureFootprint f = ltc_texture_footprint(m, phi, normal, height);            // once
//   LtcTextureEllipse e = ltc_texture_axes(...f.axis_a..., ...f.axis_b...);       // in the plane's coordinates
//   LtcTextureEllipse g = ltc_texture_gaussian(e, width, widest);                 // for each Gaussian of the lobe's mixture
//   vec2 at = centroid + ltc_texture_place(g, hit - centroid, slope, light);   // where to read the copy blurred by g
//
// A diffuse surface passes the identity for M^-1 (ltc_texture_diffuse).
// Source of the idea: Heitz, Hill, "Real-time polygonal-light shading with linearly transformed cosines", 2016.

// An ellipse on the light's plane, in the shading frame.
//   center   relative to the shading point
//   axis_a, axis_b  conjugate radii, per radian of the cone's half angle
//   valid    false where the light sends nothing
struct LtcTextureFootprint {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
    valid: bool,
}

// The vector M w, up to a positive factor: the inverse of ltc_transform.
fn ltc_texture_transform_back(m: LtcMatrix, w: vec3f) -> vec3f {
    let determinant = m.xx * m.zz - m.xz * m.zx;
    return vec3f(m.zz * w.x - m.xz * w.z, w.y * (determinant / m.yy), m.xx * w.z - m.zx * w.x);
}

// The matrix of a diffuse lobe: none.
fn ltc_texture_diffuse() -> LtcMatrix {
    var m: LtcMatrix;
    m.xx = 1.0;
    m.xz = 0.0;
    m.yy = 1.0;
    m.zx = 0.0;
    m.zz = 1.0;
    return m;
}

// Irradiance vector, under M^-1, of the part of the light above both horizons.
//
//   reversed true where the light is seen from behind
fn ltc_texture_irradiance_vector(walk: LtcWalk, reversed: bool) -> vec3f {
    return polygon_irradiance_vector(walk.lobe, reversed);
}

// Where a lobe looks on a light's plane.
//
//   m        M^-1
//   phi      irradiance vector of the light under M^-1 (ltc_texture_irradiance_vector)
//   normal   unit normal of the light's plane, in the shading frame, either sign
//   height   dot(normal, any point of the plane relative to the shading point)
//
// A direction w turned by a small angle e across itself meets the plane at M w t + e (M c - M w (n.Mc)/(n.Mw)) t.
//
// Degenerate: a light that sends nothing, or a vector along the plane, has a footprint of size 0 that is not valid.
// Error: docs/ltc.md, "Textured lights".
fn ltc_texture_footprint(m: LtcMatrix, phi: vec3f, normal: vec3f, height: f32) -> LtcTextureFootprint {
    let p2 = dot(phi, phi);
    let lit = p2 > smallest_divisor();
    let w = select(vec3f(0.0, 0.0, 1.0), phi * inverseSqrt(max(p2, smallest_divisor())), lit);
    let across = frame_from_normal(w);
    let l = ltc_texture_transform_back(m, w);
    let along = dot(normal, l);
    let meets = lit && along * height > 0.0;
    let inverse = select(0.0, 1.0 / select(1.0, along, meets), meets);
    let t = height * inverse;
    let a = ltc_texture_transform_back(m, steradian_transform(across, vec3f(1.0, 0.0, 0.0)));
    let b = ltc_texture_transform_back(m, steradian_transform(across, vec3f(0.0, 1.0, 0.0)));
    var f: LtcTextureFootprint;
    f.center = l * t;
    f.axis_a = (a - l * (dot(normal, a) * inverse)) * t;
    f.axis_b = (b - l * (dot(normal, b) * inverse)) * t;
    f.valid = meets;
    return f;
}

// An ellipse on the light's plane: its long half axis, and the length of the short one.
struct LtcTextureEllipse {
    major: vec2f,
    minor: f32,
}

// Principal axes of the ellipse of two conjugate radii.
//
//   a, b     in the plane's own coordinates [m]
//
// Degenerate: a circle has any major axis.
fn ltc_texture_axes(a: vec2f, b: vec2f) -> LtcTextureEllipse {
    let xx = a.x * a.x + b.x * b.x;
    let yy = a.y * a.y + b.y * b.y;
    let xy2 = a.x * a.y + b.x * b.y;
    let half_difference = 0.5 * (xx - yy);
    let spread = sqrt(half_difference * half_difference + xy2 * xy2);
    // An eigenvector of the larger eigenvalue, from the row that does not cancel.
    let v = select(vec2f(xy2, spread - half_difference), vec2f(half_difference + spread, xy2), half_difference > 0.0);
    let v2 = dot(v, v);
    let direction = select(vec2f(1.0, 0.0), v * inverseSqrt(max(v2, smallest_square())), v2 > smallest_square());
    let longest = sqrt(0.5 * (xx + yy) + spread);
    var e: LtcTextureEllipse;
    e.major = direction * longest;
    e.minor = abs(a.x * b.y - a.y * b.x) / max(longest, smallest_length());
    return e;
}

// A Gaussian's standard deviations: the ellipse times a width, neither above `widest`.
fn ltc_texture_gaussian(e: LtcTextureEllipse, width: f32, widest: f32) -> LtcTextureEllipse {
    let longest = width * sqrt(dot(e.major, e.major));
    var g: LtcTextureEllipse;
    g.major = e.major * (width * (widest / max(longest, widest)));
    g.minor = min(width * e.minor, widest);
    return g;
}

// Where a Gaussian must stand for the light under it to have the centroid that it has under the lobe.
//
// A wide Gaussian over a small light hardly knows where it stands, and its mean is the light's own. If the light were a
// Gaussian of covariance V, the centroid under a Gaussian of covariance S at distance x would be at V (V + S)^-1 x; this
// inverts that. The irradiance vector also lacks the lobe's cosine; it moves the centroid to the largest value of the
// product of (V^-1 + S^-1)^-1's Gaussian and the cosine, along the cosine's slope.
//
//   g        the Gaussian: its standard deviations
//   aside    where the irradiance vector meets the plane, from the light's centroid
//   slope    of the logarithm of z under M^-1 along the plane, there
//   light    covariance of the light's area: xx, xy, yy
//   returns  from the light's centroid
//
// It stands at most 2.5 of its standard deviations away from there: further out, next to nothing of the light is under it.
//
// Degenerate: a light without width counts as a thousandth as wide as long.
fn ltc_texture_place(g: LtcTextureEllipse, aside: vec2f, slope: vec2f, light: vec3f) -> vec2f {
    let major2 = dot(g.major, g.major);
    let minor2 = g.minor * g.minor;
    let u = g.major * inverseSqrt(max(major2, smallest_square()));
    let along = major2 - minor2;
    let sxx = minor2 + along * u.x * u.x;
    let sxy = along * u.x * u.y;
    let syy = minor2 + along * u.y * u.y;
    let least = 1.0e-6 * (light.x + light.z) + smallest_divisor();
    let vxx = light.x + least;
    let vyy = light.z + least;
    // (V^-1 + S^-1)^-1 slope = S (V + S)^-1 V slope
    let txx = vxx + sxx;
    let txy = light.y + sxy;
    let tyy = vyy + syy;
    let t_inverse = 1.0 / max(txx * tyy - txy * txy, smallest_square());
    var p = vec2f(vxx * slope.x + light.y * slope.y, light.y * slope.x + vyy * slope.y);
    p = vec2f(tyy * p.x - txy * p.y, txx * p.y - txy * p.x) * t_inverse;
    p = vec2f(sxx * p.x + sxy * p.y, sxy * p.x + syy * p.y);
    // Of exp(-x^2 / 2) (1 + q^(1/2) x): the maximum, over its first order.
    let q = max(dot(slope, p), 0.0);
    let share = 2.0 / (1.0 + sqrt(1.0 + 4.0 * q));
    let d = aside + p * share;
    let v_inverse = 1.0 / max(vxx * vyy - light.y * light.y, smallest_square());
    let e = vec2f(vyy * d.x - light.y * d.y, vxx * d.y - light.y * d.x) * v_inverse;
    let push = vec2f(sxx * e.x + sxy * e.y, sxy * e.x + syy * e.y);
    let pushed2 = max(dot(push, e), 0.0);
    return d + push * (2.5 * inverseSqrt(max(pushed2, 6.25)));
}

// ==== ltc_clipless ====

// Linearly transformed cosines without clipping, for comparison: the light is taken for the sphere that has the same
// irradiance vector under M^-1, and the horizon cuts that. The real horizon is not looked at: light leaks from below.
// Source: Hill, Heitz, "Real-time area lighting: a journey from research to production", 2016.

// Form factor of a sphere above the horizon over that of the whole sphere towards its centre.
//
//   cosine   of the sphere's centre to z, in [-1, 1]
//   f        form factor of the whole sphere towards its centre: sine squared of its angular radius, in [0, 1]
//
// Degenerate: f = 0 gives max(cosine, 0).
// Source: Snyder, "Area light sources for real-time graphics", 1996, section 3.2.
fn ltc_clipped_sphere(cosine: f32, f: f32) -> f32 {
    let z = clamp(cosine, -1.0, 1.0);
    let s2 = clamp(f, 1.0e-12, 1.0);
    let sin_w = sqrt(max(1.0 - z * z, smallest_divisor()));
    let cos_s = sqrt(1.0 - s2);
    let crossed = z * z < s2;
    // The rim meets the horizon at the azimuth whose sine and cosine are x and y.
    let x = clamp(cos_s / sin_w, 0.0, 1.0);
    let y = sqrt(max(1.0 - x * x, 0.0));
    let root = sqrt(max(s2 - y * y, 0.0));
    let arc = trig_atan2(y, x) + x * y - 2.0 * sin_w * cos_s * y;
    let rim = abs(z) * (y * root + s2 * trig_atan2(y, root));
    let whole = steradian_pi() * s2 * max(z, 0.0);
    let cut = select(whole, whole + arc - rim, crossed);
    return clamp(cut / (steradian_pi() * s2), 0.0, 1.0);
}

// Adds one edge to the irradiance vector under M^-1 [rad].
//
//   ta, tb   ltc_direction of the edge's ends, in walk order
fn ltc_clipless_add_edge(sum: vec3f, ta: vec3f, tb: vec3f) -> vec3f {
    return sum + polygon_edge(ta, tb);
}

// Integral of the lobe over the light, approximately, in [0, 1].
//
//   sum      of ltc_clipless_add_edge, begun at zero
//   reversed true where the light is seen from behind
fn ltc_clipless_integral(sum: vec3f, reversed: bool) -> f32 {
    let e = sum * select(1.0, -1.0, reversed);
    let e2 = dot(e, e);
    let inverse = inverseSqrt(max(e2, smallest_square()));
    let form_factor = clamp(e2 * inverse * inverse_pi(), 0.0, 1.0);
    return form_factor * ltc_clipped_sphere(clamp(e.z * inverse, -1.0, 1.0), form_factor);
}

// ==== moment_arvo ====

// The Phong lobe's boundary integral by Arvo's recurrence: exact for integer n, in n/2 steps an edge.
//
// (1 - x^m)/(1 - x^2) is the finite sum of x^k over every other k below m: 1 + x^2 + ... for even m. For odd m one
// factor x is taken out first, (x - x^m)/(1 - x^2) = x + x^3 + ..., and the rest, 1/(1 + x), integrates to half the
// angle of a spherical triangle. Each power integrates by parts from the last but one.
// Source: Arvo 1995, sec. 5; Lecocq et al. 2017, eq. 1 to 3, with N = n - 1.

// |s| times the integral of 1/(1 + x) over the part in front: summed over a polygon, its solid angle.
fn moment_solid_angle_front(edge: MomentEdge) -> f32 {
    let c0 = edge.c + edge.x0;
    let c1 = edge.c + edge.x1;
    let k = edge.s / (1.0 + edge.c);
    return 2.0 * trig_atan2(k * (c0 * edge.y1 - c1 * edge.y0), c0 * c1 + k * k * edge.y0 * edge.y1);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   n        integer exponent, at least 1
//   can_stop 1: stop when what is left is below relative_precision of the sum; 0: sum everything. Every lane waits for
//            the slowest: at grazing views, where c is near 1, the stop comes late or never.
//
// Error: see docs/accuracy.md, "phong recurrence"; the recurrence is stable, its factor is below c^2.
fn moment_arvo_front(edge: MomentEdge, n: i32, can_stop: i32, relative_precision: f32) -> f32 {
    let odd_m: i32 = 1 - (n - (n / 2) * 2);
    let c2 = edge.c * edge.c;
    let x02 = edge.x0 * edge.x0;
    let x12 = edge.x1 * edge.x1;
    // The integral of x^p, and x^(p+1) y at both ends, which the next step needs.
    var power = trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    var b0 = edge.x0 * edge.y0;
    var b1 = edge.x1 * edge.y1;
    var p = 2.0;
    var steps: i32 = (n - 1) / 2;
    if (odd_m == 1) {
        power = edge.y1 - edge.y0;
        b0 = x02 * edge.y0;
        b1 = x12 * edge.y1;
        p = 3.0;
        steps = n / 2 - 1;
    }
    var sum = power;
    let left = relative_precision * (1.0 - c2);
    for (var i: i32 = 0; i < steps; i++) {
        power = (b1 - b0 + (p - 1.0) * c2 * power) / p;
        b0 = b0 * x02;
        b1 = b1 * x12;
        p = p + 2.0;
        sum = sum + power;
        // The terms fall by c^2 or more: those left sum to less than power c^2 / (1 - c^2).
        if (can_stop == 1) {
            if (power * c2 <= sum * left) {
                break;
            }
        }
    }
    var front = edge.s * sum;
    if (odd_m == 1) {
        front = front + moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// ==== moment_peak_fits ====

// The published peak fits of the Phong lobe's boundary integrand: Lorentzian, Lorentzian-Pearson, ellipsoid.
//
// The integrand I = (f - x^m)/(1 - x^2) is a peak over phi with its foot at 0: f = x for even n, f = 1 otherwise.
// Each fit is a peak P with an antiderivative, scaled to I's largest and smallest value and to its value at the half
// width x_w; the blends also meet I at a place in the tail. For comparison with moment_series.glsl, which is both
// faster and closer. Corrected against the paper where its prints do not hold (docs/moments.md lists the places).
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017,
// eq. 5 to 16; its order N is n - 1 here.

// What the fits share for one edge.
//   x_w, x_t     half width and the place in the tail [rad]
//   ratio_w      x_w over its limit for c -> 0
//   peak         I at the foot, less its smallest value
//   y_w, y_t     the same at x_w and x_t, over peak
//   smallest     I at phi = pi/2: 0 for f = x, 1 for f = 1
//   phi0, phi1   ends of the part in front [rad]
struct MomentPeak {
    x_w: f32,
    x_t: f32,
    ratio_w: f32,
    peak: f32,
    y_w: f32,
    y_t: f32,
    smallest: f32,
    phi0: f32,
    phi1: f32,
}

// Cosine for |x| <= pi/2: Taylor, the next term is x^16/16!, 7e-11 at pi/2.
fn moment_peak_cosine(x: f32) -> f32 {
    let t = x * x;
    return 1.0 - t / 2.0 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0 * (1.0 - t / 132.0 * (1.0 - t / 182.0))))));
}

// Sine for |x| <= pi/2: Taylor, the next term is x^15/15!, 7e-10 at pi/2.
fn moment_peak_sine(x: f32) -> f32 {
    let t = x * x;
    return x * (1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0))))));
}

// I less its smallest value, at x = c cos phi. f = x: x (1 - x^n)/(1 - x^2); f = 1: x^2 (1 - x^(n-1))/(1 - x^2).
//
//   even_n   1 for f = x, 0 for f = 1
fn moment_peak_height(s2: f32, c2: f32, n: f32, even_n: i32, cosine: f32, sine: f32) -> f32 {
    let rest = s2 + c2 * sine * sine;  // 1 - x^2 without cancellation
    let x2 = max(c2 * cosine * cosine, 1.0e-12);
    let log_x = 0.5 * moment_log_1_plus(rest / x2);
    if (even_n == 1) {
        return sqrt(x2) * moment_1_minus_exp(n * log_x) / rest;
    }
    return x2 * moment_1_minus_exp((n - 1.0) * log_x) / rest;
}

// The half width by the paper's fit, over its limit for c -> 0 (pi/3 for f = x, pi/4 for f = 1).
//
// Error: up to 17 % (f = x) and 32 % (f = 1, n = 5000), 4 to 8 % on the average.
// Source: eq. 7, with pi/4 outside the power.
fn moment_peak_half_width_ratio(c: f32, n: f32, even_n: i32) -> f32 {
    if (even_n == 1) {
        let reduced = c - c / max(n - 1.0, 1.0);
        return sqrt(max(1.0 - reduced * reduced, 1.0e-8));
    }
    let k = max(c - c / max(n - 2.0, 1.0), 1.0e-6);
    return phong_power(max(1.0 - phong_power(k, 2.5), 1.0e-8), 0.45);
}

// What the fits share for one edge and a lobe of exponent n.
fn moment_peak_prepare(edge: MomentEdge, n: f32, even_n: i32) -> MomentPeak {
    let s2 = edge.s * edge.s;
    let c2 = edge.c * edge.c;
    var widest = 0.785398163397448310;
    var p: MomentPeak;
    p.smallest = 1.0;
    if (even_n == 1) {
        widest = 1.04719755119659775;
        p.smallest = 0.0;
    }
    p.ratio_w = moment_peak_half_width_ratio(edge.c, n, even_n);
    p.x_w = widest * p.ratio_w;
    let k = 1.0 - p.ratio_w;  // eq. 14: its twelfth power
    let k2 = k * k;
    let k4 = k2 * k2;
    p.x_t = min(p.x_w + 0.3946 * widest * (1.0 - k4 * k4 * k4), 1.57079632679489662);
    p.peak = moment_peak_height(s2, c2, n, even_n, 1.0, 0.0);
    let scale = 1.0 / max(p.peak, 1.0e-12);
    p.y_w = scale * moment_peak_height(s2, c2, n, even_n, moment_peak_cosine(p.x_w), moment_peak_sine(p.x_w));
    p.y_t = scale * moment_peak_height(s2, c2, n, even_n, moment_peak_cosine(p.x_t), moment_peak_sine(p.x_t));
    p.y_w = clamp(p.y_w, 0.01, 0.99);
    p.phi0 = trig_atan2(edge.y0, edge.x0);
    p.phi1 = trig_atan2(edge.y1, edge.x1);
    return p;
}

// A peak scaled to 1 at the foot and 0 at pi/2.
//   integral  over the part in front
//   tail      its value at x_t
struct MomentFit {
    integral: f32,
    tail: f32,
}

// The scaled peak from a peak's integral, its value at the tail's place and its value at pi/2; at the foot it is 1.
fn moment_fit_scaled(p: MomentPeak, integral: f32, tail: f32, lowest: f32) -> MomentFit {
    let scale = 1.0 / (1.0 - lowest);
    var fit: MomentFit;
    fit.integral = scale * (integral - lowest * (p.phi1 - p.phi0));
    fit.tail = scale * (tail - lowest);
    return fit;
}

// Width parameter of the Lorentzian. Source: eq. 11. Kept above 1.0e-3, where the scaled peak is its limit.
fn moment_lorentzian_width(p: MomentPeak) -> f32 {
    let x2 = p.x_w * p.x_w;
    return max((1.0 - p.y_w - 0.405284734569351086 * x2) / (p.y_w * x2), 1.0e-3);
}

// The Lorentzian peak 1/(1 + a phi^2). Source: eq. 11 and 12.
fn moment_fit_lorentzian(p: MomentPeak) -> MomentFit {
    let a = moment_lorentzian_width(p);
    let root = sqrt(a);
    let integral = trig_atan2(root * (p.phi1 - p.phi0), 1.0 + a * p.phi0 * p.phi1) / root;
    return moment_fit_scaled(p, integral, 1.0 / (1.0 + a * p.x_t * p.x_t), 1.0 / (1.0 + a * 2.46740110027233966));
}

// The peak of Pearson VII: (1 + b phi^2)^-2 with b = a/2.
fn moment_fit_pearson(p: MomentPeak) -> MomentFit {
    let b = 0.5 * moment_lorentzian_width(p);
    let root = sqrt(b);
    let angle = trig_atan2(root * (p.phi1 - p.phi0), 1.0 + b * p.phi0 * p.phi1);
    let ends = p.phi1 / (1.0 + b * p.phi1 * p.phi1) - p.phi0 / (1.0 + b * p.phi0 * p.phi0);
    let t = 1.0 / (1.0 + b * p.x_t * p.x_t);
    let l = 1.0 / (1.0 + b * 2.46740110027233966);
    return moment_fit_scaled(p, 0.5 * (ends + angle / root), t * t, l * l);
}

// A width of exactly 1 is a constant peak, 0/0 when scaled: kept 4e-3 away.
fn moment_fit_not_one(a: f32) -> f32 {
    return select(a, 1.004, abs(a - 1.0) < 0.004);
}

// Width parameter of the ellipsoid. Source: eq. 15.
fn moment_ellipsoid_width(p: MomentPeak) -> f32 {
    let cosine = moment_peak_cosine(p.x_w);
    let sine = moment_peak_sine(p.x_w);
    return p.y_w * sine * sine / (cosine * cosine * (1.0 - p.y_w));
}

// The ellipsoid peak a/(1 + (a - 1) cos^2 phi). Source: eq. 15 and 16.
fn moment_fit_ellipsoid(edge: MomentEdge, p: MomentPeak) -> MomentFit {
    let a = moment_fit_not_one(moment_ellipsoid_width(p));
    let root = sqrt(a);
    let cosine = moment_peak_cosine(p.x_t);
    let integral = root * moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    return moment_fit_scaled(p, integral, a / (1.0 + (a - 1.0) * cosine * cosine), a);
}

// The squared ellipsoid peak (b/(1 + (b - 1) cos^2 phi))^2.
fn moment_fit_ellipsoid_squared(edge: MomentEdge, p: MomentPeak) -> MomentFit {
    let b = moment_fit_not_one(moment_ellipsoid_width(p) * (2.1 + 1.28 * p.ratio_w));
    let root = sqrt(b);
    let cosine = moment_peak_cosine(p.x_t);
    let e0 = edge.x0 * edge.y0 / max(b * edge.x0 * edge.x0 + edge.y0 * edge.y0, smallest_divisor());
    let e1 = edge.x1 * edge.y1 / max(b * edge.x1 * edge.x1 + edge.y1 * edge.y1, smallest_divisor());
    let angle = moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    let integral = 0.5 * root * (b + 1.0) * angle - 0.5 * b * (b - 1.0) * (e1 - e0);
    let t = b / (1.0 + (b - 1.0) * cosine * cosine);
    return moment_fit_scaled(p, integral, t * t, b * b);
}

// Blend of a peak with too heavy a tail and one with too light a tail, so that the blend meets I in the tail.
//
// Source: eq. 13, clamped: its denominator vanishes where the two meet.
fn moment_fit_blended(p: MomentPeak, heavy: MomentFit, light: MomentFit) -> MomentFit {
    let d = light.tail - heavy.tail;
    var alpha = (light.tail - p.y_t) / select(max(d, 1.0e-12), min(d, -1.0e-12), d < 0.0);
    alpha = clamp(alpha, 0.0, 1.0);
    var fit: MomentFit;
    fit.integral = alpha * heavy.integral + (1.0 - alpha) * light.integral;
    fit.tail = alpha * heavy.tail + (1.0 - alpha) * light.tail;
    return fit;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, from a fit.
//
// Degenerate: a peak below 1e-12 (n = 1) leaves the smallest value alone.
fn moment_fit_front(edge: MomentEdge, p: MomentPeak, fit: MomentFit, even_n: i32) -> f32 {
    let peak = select(0.0, p.peak * fit.integral, p.peak > 1.0e-12);
    var front = edge.s * (peak + p.smallest * (p.phi1 - p.phi0));
    if (even_n == 1) {
        front = front + moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// The Lorentzian for one edge. Error: see docs/accuracy.md, "phong peak fits".
fn moment_lorentzian_front(edge: MomentEdge, n: f32, even_n: i32) -> f32 {
    let p = moment_peak_prepare(edge, n, even_n);
    return moment_fit_front(edge, p, moment_fit_lorentzian(p), even_n);
}

// The blend of Lorentzian and Pearson VII for one edge.
fn moment_pearson_front(edge: MomentEdge, n: f32, even_n: i32) -> f32 {
    let p = moment_peak_prepare(edge, n, even_n);
    let fit = moment_fit_blended(p, moment_fit_lorentzian(p), moment_fit_pearson(p));
    return moment_fit_front(edge, p, fit, even_n);
}

// The blend of ellipsoid and squared ellipsoid for one edge.
fn moment_ellipsoid_front(edge: MomentEdge, n: f32, even_n: i32) -> f32 {
    let p = moment_peak_prepare(edge, n, even_n);
    let fit = moment_fit_blended(p, moment_fit_ellipsoid(edge, p), moment_fit_ellipsoid_squared(edge, p));
    return moment_fit_front(edge, p, fit, even_n);
}

// ==== representative_point ====

// The representative point of a polygon light, for comparison: all of its light from the direction that is nearest to
// the mirror direction, on a lobe widened to make up for it.
//
// Assumes that the light is small against the lobe, or the lobe against the light; between the two it is off by a third and more.
//   1. The light is a point light of the light's solid angle, in the direction nearest to the mirror's.
//   2. The lobe's peak falls by (alpha/alpha')^2, alpha' = alpha + radius/(2 distance). A sphere of that radius and distance
//      has the solid angle W = pi (radius/distance)^2; of half vectors it covers W/(4 v.h), a disk of radius sqrt(W/(4 pi v.h)),
//      which at the normal is radius/(2 distance). The factor 1/sqrt(v.h) is not in the source: without it a mirror that
//      sees the light sends 1/v.h times the light's radiance, 14 times at 86 degrees.
// Walk the outline clipped to the horizon (horizon_clip.glsl).
// Source: Karis, "Real shading in Unreal Engine 4", 2013, section "Area lights", its sphere taken to a polygon. The half
// radius: its alpha' with the factor 2 at which a mirror (alpha = 0) sends the radiance of the light it sees.

// The state of a walk.
//   turn     how far the outline has turned about the mirror direction [rad]: two pi at the end where that is inside,
//            minus two pi where its opposite is, else zero; the other sign where the light is seen from behind
//   nearest  direction on the outline nearest to it
//   cosine   between the two
struct RepresentativeWalk {
    turn: f32,
    nearest: vec3f,
    cosine: f32,
}

// A walk with no edge yet.
fn representative_begin() -> RepresentativeWalk {
    var walk: RepresentativeWalk;
    walk.turn = 0.0;
    walk.nearest = vec3f(0.0, 0.0, 1.0);
    walk.cosine = -2.0;  // below any cosine, so that the first edge counts
    return walk;
}

// Adds one edge.
//
//   mirror   unit: the view mirrored at the normal
//   a, b     unit directions of the edge's ends
fn representative_add_edge(walk: RepresentativeWalk, mirror: vec3f, a: vec3f, b: vec3f) -> RepresentativeWalk {
    var next = walk;
    let ca = dot(mirror, a);
    let cb = dot(mirror, b);
    next.turn = walk.turn + trig_atan2(dot(mirror, cross(a, b)), dot(a, b) - ca * cb);
    // The nearest of the great circle, if it lies between the ends.
    let n = cross(a, b);
    let n2 = max(dot(n, n), smallest_divisor());
    let p = mirror - n * (dot(mirror, n) / n2);
    let on_circle = p * inverseSqrt(max(dot(p, p), smallest_divisor()));
    let between = dot(cross(a, p), n) > 0.0 && dot(cross(p, b), n) > 0.0;
    let nearest = select(select(b, a, ca > cb), on_circle, between);
    let cosine = dot(mirror, nearest);
    let better = cosine > walk.cosine;
    next.nearest = select(walk.nearest, nearest, better);
    next.cosine = select(walk.cosine, cosine, better);
    return next;
}

// The direction that stands for the light: the mirror direction if the light holds it, else the nearest of the outline.
fn representative_direction(walk: RepresentativeWalk, mirror: vec3f, reversed: bool) -> vec3f {
    let turn = select(walk.turn, -walk.turn, reversed);
    return select(walk.nearest, mirror, turn > steradian_pi());
}

// Radiance towards the view, per radiance of the light, without Fresnel.
//
//   view, mirror  unit, in the shading frame
//   solid_angle   of the light's part above the horizon [sr]
//   alpha         of the GGX lobe
//   reversed      true where the light is seen from behind
//
// Degenerate: 0 where the representative direction is below the horizon. For a mirror inside the light: at most 1, and
// towards alpha = 0 it is 1.
// Error: see docs/accuracy.md, "GGX with shadowing and Fresnel".
fn representative_radiance(walk: RepresentativeWalk, view: vec3f, mirror: vec3f, solid_angle: f32, alpha: f32, reversed: bool) -> f32 {
    let l = representative_direction(walk, mirror, reversed);
    let h = microfacet_half_vector(l, view);
    let wider = alpha + sqrt(solid_angle * 0.0795774715459476679 / max(dot(view, h), 1.0e-6));
    let fall = alpha / wider;
    return ggx_lobe(l, view, alpha, alpha) * (fall * fall) * solid_angle;
}

// The half vector's cosine for Fresnel. Arguments as for representative_radiance.
fn representative_v_dot_h(walk: RepresentativeWalk, view: vec3f, mirror: vec3f, reversed: bool) -> f32 {
    let h = microfacet_half_vector(representative_direction(walk, mirror, reversed), view);
    return dot(view, h);
}

// ==== plane ====

// Light in the plane: integrals of emission over the directions in which a piece of an edge or of a circle is seen.
//
// An edge is seen in the frame of its foot: d the distance of its line, f the angle from the perpendicular, t = tan f.
// A circle is seen in the frame of its centre: D the centre's distance, psi the angle from the centre's direction.
// Range window: (1 - r^2/R^2)^2 with r the distance to the surface; q = d^2/R^2; no window is q = 0, R = infinite.

// Antiderivative of cos(f)^n.
//
//   n        2, 1, 0, -1, ..., -5, the same for all lanes
//   t        tan f, f in (-pi/2, pi/2)
//   f        the angle; read for n = 2 and n = 0 only
//
// Error: docs/plane.md, "closed forms"; against quadrature in plane_kernel_test.
fn plane_power_integral(n: i32, t: f32, f: f32) -> f32 {
    let sec2 = 1.0 + t * t;
    let sec = sqrt(sec2);
    if (n == 2) {
        return 0.5 * (f + t / sec2);
    }
    if (n == 1) {
        return t / sec;
    }
    if (n == 0) {
        return f;
    }
    if (n == -2) {
        return t;
    }
    if (n == -4) {
        return t + t * t * t * 0.33333333333333333;
    }
    // asinh t, odd: the logarithm of a number at least 1, so that nothing cancels
    var a = log(abs(t) + sec);
    a = select(a, -a, t < 0.0);
    if (n == -1) {
        return a;
    }
    let cubed = 0.5 * (t * sec + a);
    if (n == -3) {
        return cubed;
    }
    return 0.25 * t * sec * sec2 + 0.75 * cubed;
}

// Antiderivative of tan(f)^j cos(f)^n, j = 0, 1 or 2. See plane_power_integral; j = 2 takes n >= -3.
fn plane_term(j: i32, n: i32, t: f32, f: f32) -> f32 {
    if (j == 0) {
        return plane_power_integral(n, t, f);
    }
    if (j == 2) {
        return plane_power_integral(n - 2, t, f) - plane_power_integral(n, t, f);
    }
    // -cos^n / n, and -log(cos) for n = 0; cos^2 = 1 / sec2
    let sec2 = 1.0 + t * t;
    if (n == 0) {
        return 0.5 * log(sec2);
    }
    if (n == 2) {
        return -0.5 / sec2;
    }
    if (n == 1) {
        return -inverseSqrt(sec2);
    }
    if (n == -1) {
        return sqrt(sec2);
    }
    if (n == -2) {
        return 0.5 * sec2;
    }
    if (n == -3) {
        return sec2 * sqrt(sec2) * 0.33333333333333333;
    }
    return 0.25 * sec2 * sec2;
}

// Antiderivative of tan(f)^j cos(f)^k under the range window (1 - q/cos^2)^2: what an edge of this emission sends.
//
//   j        0 constant along the edge, 1 linear along it (2: moments of the linear one)
//   k        0 uniform, 1 Lambert or 1/r (times 1/d); one more for first moments
//   q        (d/R)^2; the caller clips the edge to cos f >= d/R
fn plane_edge_integral(j: i32, k: i32, t: f32, f: f32, q: f32) -> f32 {
    let w0 = plane_term(j, k, t, f);
    let w2 = plane_term(j, k - 2, t, f);
    let w4 = plane_term(j, k - 4, t, f);
    return w0 - 2.0 * q * w2 + q * q * w4;
}

// Antiderivative of the range window over the directions of a circle of uniform radiance, seen from outside.
//
//   d2       squared distance of the centre, above rho2 = squared radius; both in units of the range: R = 1
//   c, s     cosine and sine of psi
//   psi      the angle from the centre's direction
//   chord    sqrt(rho2 - x^2), x = D sin psi: half the chord that the ray cuts; 0 for a tangent ray
//   beta     asin(x / rho): pi/2 for a tangent ray
//
// With x as the variable, r^2 and r^4 split into a polynomial in x and the chord times one, and both integrate to
// elementary terms: int chord dx = (x chord + rho2 beta) / 2, int x^2 chord dx = (x (2 x^2 - rho2) chord + rho2^2 beta) / 8.
// Linear in the two angles: differences of psi and beta may be taken before the call.
fn plane_disk_window_integral(d2: f32, rho2: f32, d: f32, c: f32, s: f32, psi: f32, chord: f32, beta: f32) -> f32 {
    let x = d * s;
    let sin2 = 2.0 * s * c;
    let cos2 = c * c - s * s;
    let half_disk = x * chord + rho2 * beta;
    let r2 = 0.5 * d2 * sin2 + rho2 * psi - half_disk;
    let even = psi * rho2 * (rho2 + 2.0 * d2) + d2 * sin2 * (2.0 * rho2 + 0.5 * d2 * cos2);
    let mixed = 2.0 * (d2 + rho2) * half_disk - x * (2.0 * x * x - rho2) * chord - rho2 * rho2 * beta;
    return psi - 2.0 * r2 + even - mixed;
}

// Square root of x >= 0 as x over its square root: a packed square root takes as long as ten multiplications.
//
// Error: two roundings more than sqrt; 0 at 0.
fn plane_root(x: f32) -> f32 {
    return x * inverseSqrt(max(x, smallest_divisor()));
}

// Arc tangent in the ranges that lights far from a point leave: a polynomial where |m| <= 1 on all lanes.
fn plane_angle_of_slope(m: f32) -> f32 {
    let q = m * m;
    var angle = m * trig_atan_over_argument_24_bits(q);
    if (abs(m) > 1.0) {
        angle = trig_atan2(m, 1.0);
    }
    return angle;
}

// The disk window integral from the direction of the centre to a ray, by the ray's slope.
//
//   m        tangent of psi, within the disk's own tangents; negative slopes give negative integrals
//   d2, rho2 as above, R = 1; d2 > rho2
//   returns  integral of the window over psi from 0; the caller has clipped the ray to the range
//
// A rounding of the chord does not matter: the chord's and beta's terms move against each other. So beta may come from
// the chord by a polynomial for the arc cosine, without a division.
fn plane_disk_window(m: f32, d2: f32, rho2: f32) -> f32 {
    let d = plane_root(d2);
    let c = inverseSqrt(1.0 + m * m);
    let x = m * c * d;
    let x2 = x * x;
    let chord = plane_root(max(rho2 - x2, 0.0));
    let psi = plane_angle_of_slope(m);
    let inverse_rho = inverseSqrt(rho2);
    let acute = trig_angle_over_sine_acute(max(1.0 - abs(x) * inverse_rho, 0.0)) * chord * inverse_rho;
    var beta = 0.5 * steradian_pi() - acute;
    beta = select(beta, -beta, m < 0.0);
    let e = 2.0 - 2.0 * d2 - rho2;
    return psi * ((1.0 - rho2) * (1.0 - rho2) + 2.0 * rho2 * d2)
         + x * (c * d * (4.0 * rho2 - 2.0 + d2 - 2.0 * x2) + chord * (e - 2.0 * rho2 + 2.0 * x2))
         + beta * (rho2 * e);
}

// The disk window integral over the whole disk: from tangent to tangent.
//
//   m        the tangents' slope: sqrt(rho2 / (d2 - rho2))
fn plane_disk_window_whole(m: f32, d2: f32, rho2: f32) -> f32 {
    let e = 2.0 - 2.0 * d2 - rho2;
    return 2.0 * (plane_angle_of_slope(m) * ((1.0 - rho2) * (1.0 - rho2) + 2.0 * rho2 * d2)
         + m * (d2 - rho2) * (2.0 * rho2 - 2.0 + d2)) + steradian_pi() * (rho2 * e);
}

// The slope of a point in a frame: tangent of the angle from the axis.
//
//   w, t     components of the point along the axis and across it (counter-clockwise positive), any common scale
//   beyond   the slope where the point is not in front of the axis: +-1.0e9
fn plane_slope(w: f32, t: f32, beyond: f32) -> f32 {
    return select(beyond, clamp(t / max(w, 1.0e-12), -1.0e9, 1.0e9), w > 1.0e-12);
}

// ==== indirect ====

// One glossy bounce: virtual point lights and receivers whose lobes are linearly transformed cosines.
//
// A virtual light stands where light first meets a surface, and sends out what that surface reflects. v is its position
// minus the receiver's, in world space and of any length; D = v.v. A lobe at either end is a matrix that takes v to
// w: the lobe is proportional to max(w_z, 0) / |w|^4 for a unit v. What each end contributes is called its half:
//
//   half = lobe(v / |v|) / |v| = scale w_z D / |w|^4        diffuse: cosine / |v| = (n.v) / D
//
// and light that reaches the eye by a pair is flux times the product of both halves: no square root. See docs/indirect.md.
// Source: Xia, Liu, Zeng, Pu, Zhang, "Real-time indirect glossy reflection based on linearly transformed spherical
// distributions", 2023; Tokuyoshi, Harada, "Stochastic light culling", 2016.

// A lobe in world space: rows of M^-1 times the shading frame, and |M^-1| / pi.
//
// At a virtual light v comes in from the front's other side: there the rows are negated (indirect_turned).
struct IndirectLobe {
    x: vec3f,
    y: vec3f,
    z: vec3f,
    scale: f32,
}

// The lobe of a table's matrix and the frame it belongs to (x along the view, z the normal). The matrix' factor cancels in a half.
fn indirect_lobe(m: LtcMatrix, frame: mat3x3f) -> IndirectLobe {
    var lobe: IndirectLobe;
    lobe.x = steradian_transform(frame, vec3f(m.xx, 0.0, m.xz));
    lobe.y = steradian_transform(frame, vec3f(0.0, m.yy, 0.0));
    lobe.z = steradian_transform(frame, vec3f(m.zx, 0.0, m.zz));
    lobe.scale = m.yy * (m.xx * m.zz - m.xz * m.zx) * inverse_pi();
    return lobe;
}

// The lobe for vectors that point at the surface instead of away from it: what a virtual light needs.
fn indirect_turned(lobe: IndirectLobe) -> IndirectLobe {
    var turned: IndirectLobe;
    turned.x = -lobe.x;
    turned.y = -lobe.y;
    turned.z = -lobe.z;
    turned.scale = lobe.scale;
    return turned;
}

// The vector v under the lobe's M^-1; v is any vector in world space.
fn indirect_under(lobe: IndirectLobe, v: vec3f) -> vec3f {
    return vec3f(dot(lobe.x, v), dot(lobe.y, v), dot(lobe.z, v));
}

// What a glossy end contributes to a pair, its half, for scale 1: w_z D / |w|^4. One division.
//
//   v        as the lobe's rows take it
//   d2       dot(v, v)
//   wide2    0, or an area over pi that softens the nearness of a virtual light: D becomes D + wide2 in 1 / D
//
// Degenerate: v = 0 gives 0. In float |v| and the lobe's width want |v|^6 width^4 in the range of numbers.
fn indirect_glossy_half(lobe: IndirectLobe, v: vec3f, d2: f32, wide2: f32) -> f32 {
    let w = indirect_under(lobe, v);
    let w2 = dot(w, w);
    return max(w.z, 0.0) * d2 * d2 / max(w2 * w2 * (d2 + wide2), smallest_square());
}

// What a diffuse end of albedo pi contributes to a pair, its half: cosine over distance.
fn indirect_diffuse_half(n: vec3f, v: vec3f, d2: f32, wide2: f32) -> f32 {
    return max(dot(n, v), 0.0) / max(d2 + wide2, smallest_square());
}

// Radiance towards the eye from a point light of intensity 1: the lobe over the squared distance.
//
//   v        light's position minus the surface's
//   lobe     of the surface and its view; times rho_f: with Fresnel
//
// Degenerate: v = 0 gives 0.
// Source: Xia et al. 2023, eq. 9; the sum over lights with lobe.scale taken out is eq. 11.
fn indirect_point_light(lobe: IndirectLobe, v: vec3f) -> f32 {
    let d2 = dot(v, v);
    return lobe.scale * indirect_glossy_half(lobe, v, d2, 0.0) * inverseSqrt(max(d2, smallest_square()));
}

// The four halves of a pair. Light through a pair: flux (diffuse' from_diffuse + glossy' from_glossy) (diffuse
// to_diffuse + glossy to_glossy), with diffuse = albedo / pi and glossy = rho_f times the lobe's scale at each end.
struct IndirectPair {
    from_diffuse: f32,
    from_glossy: f32,
    to_diffuse: f32,
    to_glossy: f32,
}

// The halves of both ends at once, with no square root and one division.
//
//   receiver, n          the receiver's lobe and normal
//   light, light_n       the virtual light's, turned
//
// What lies below either horizon gives 0: a lobe leaks there.
// Degenerate: v = 0 gives 0. In float |v|^10 times both widths to the fourth must stay in the range of numbers; where it
// falls below 1.0e-36 the peak is cut.
fn indirect_pair(v: vec3f, n: vec3f, receiver: IndirectLobe, light_n: vec3f, light: IndirectLobe) -> IndirectPair {
    let d2 = dot(v, v);
    let w = indirect_under(receiver, v);
    let o = indirect_under(light, v);
    let w2 = dot(w, w);
    let o2 = dot(o, o);
    let w4 = w2 * w2;
    let o4 = o2 * o2;
    let both = w4 * o4;
    let inverse = 1.0 / max(d2 * both, smallest_square());
    let peak = inverse * d2 * d2;
    let n_v = max(dot(n, v), 0.0);
    let light_n_v = max(dot(light_n, v), 0.0);
    var pair: IndirectPair;
    pair.to_diffuse = n_v * (inverse * both);
    pair.from_diffuse = light_n_v * (inverse * both);
    pair.to_glossy = select(0.0, max(w.z, 0.0) * (peak * o4), n_v > 0.0);
    pair.from_glossy = select(0.0, max(o.z, 0.0) * (peak * w4), light_n_v > 0.0);
    return pair;
}

// Schlick's weight (1 - v.h)^5 at a virtual light, whose half vector lies between where its light came from and v.
//
//   incoming unit, from the virtual light to the light that feeds it
//   v        to the virtual light
fn indirect_grazing(incoming: vec3f, v: vec3f, d2: f32) -> f32 {
    let cosine = -dot(incoming, v) * inverseSqrt(max(d2, smallest_square()));
    let half_angle = max(0.5 + 0.5 * cosine, 1.0e-12);
    return fresnel_schlick(0.0, 1.0, half_angle * inverseSqrt(half_angle));
}

// One end on GGX microsurfaces, without Fresnel, and Schlick's weight: the ground truth, and the baseline.
struct IndirectGgx {
    lobe: f32,
    grazing: f32,
}

// GGX for the unit direction l away from the surface: BRDF times the cosine of l.
//
//   frame    x along the view, z the normal
//   view     unit, in the frame
fn indirect_ggx(frame: mat3x3f, view: vec3f, alpha: f32, l: vec3f) -> IndirectGgx {
    let local = steradian_transform_transposed(frame, l);
    let h = microfacet_half_vector(local, view);
    var end: IndirectGgx;
    end.lobe = microfacet_lobe_unshadowed(ggx_distribution(h, alpha, alpha) * ggx_shadowing(local, view, alpha, alpha), local, view);
    end.grazing = fresnel_schlick(0.0, 1.0, dot(h, view));
    return end;
}

// The half that stochastic culling leaves of a virtual light's half: on average what comes in.
//
//   value      the half; its irradiance at the receiver is bright times value over distance
//   reach      threshold over bright, times distance: the half whose irradiance is the threshold
//   xi         of the virtual light, in (0, 1)
//
// A pair is kept where value > xi reach, with probability min(1, value / reach), and then weighs its inverse.
// Source: Tokuyoshi, Harada 2016.
fn indirect_kept(value: f32, reach: f32, xi: f32) -> f32 {
    return select(0.0, max(value, reach), value > xi * reach);
}

// The largest factor by which M stretches a vector: one over the least by which M^-1 does.
fn indirect_largest_stretch(m: LtcMatrix) -> f32 {
    // The 2 x 2 block's smaller singular value, from its trace and determinant; the larger divides, nothing cancels.
    let determinant = m.xx * m.zz - m.xz * m.zx;
    let square = m.xx * m.xx + m.xz * m.xz + m.zx * m.zx + m.zz * m.zz;
    let gap2 = max(square * square - 4.0 * determinant * determinant, 0.0);
    let larger2 = 0.5 * (square + gap2 * inverseSqrt(max(gap2, smallest_square())));
    let least2 = determinant * determinant / max(larger2, smallest_square());
    return inverseSqrt(max(min(least2, m.yy * m.yy), smallest_square()));
}

// Where the irradiance of a virtual light can exceed a threshold: a ball of radius 1 about the origin of the result.
//
//   lobe     turned; a diffuse light's: its frame
//   v        virtual light's position minus the point's
//   range    square root of bright scale stretch / threshold, stretch of indirect_largest_stretch
//
// Irradiance is bright scale (w_z |v|) / |w|^4 <= bright scale stretch cos / |w|^2 with cos = w_z / |w|, so that the region lies
// inside |w|^2 <= range^2 cos: an egg, which the spheroid about 0.46 range on the axis, half axes 0.54 range along it
// and 0.628 range across, contains. Both numbers: tests Indirect.SpheroidHoldsTheEgg.
fn indirect_spheroid(lobe: IndirectLobe, v: vec3f, range: f32) -> vec3f {
    let w = indirect_under(lobe, v);
    let inverse = 1.0 / range;
    return vec3f(w.x * (inverse / 0.628), w.y * (inverse / 0.628), (w.z * inverse - 0.46) / 0.54);
}
