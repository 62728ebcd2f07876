// Steradian 0.1.0: area light integrals in closed form, for WGSL.
//
// A surface lit by a quad light: a module is this file and then
//
//     struct Scene {
//         eye: vec4f,
//         corners: array<vec4f, 4>,  // of the light
//         radiance: vec4f,           // of the light
//         albedo: vec4f,
//         f0: vec4f,                 // w: roughness
//     }
//     @group(0) @binding(0) var<uniform> scene: Scene;
//
//     @fragment
//     fn main(@location(0) position: vec3f, @location(1) normal: vec3f) -> @location(0) vec4f {
//         let n = normalize(normal);
//         let v = normalize(scene.eye.xyz - position);
//         let a = scene.corners[0].xyz;
//         let b = scene.corners[1].xyz;
//         let c = scene.corners[2].xyz;
//         let d = scene.corners[3].xyz;
//         let specular = steradian_ggx_quad(position, n, v, a, b, c, d, scene.f0.w, scene.f0.xyz);
//         let diffuse = steradian_lambert_quad(position, n, a, b, c, d);
//         return vec4f(scene.radiance.rgb * (scene.albedo.rgb * diffuse + specular), 1.0);
//     }
//
// Put it before your module's text; it has no bindings.
// The light shines to the side from which its corners run counter-clockwise, or clockwise in a left-handed frame. See the topic `lit`.
// Lights of other outlines and shapes, and other lobes, are walked edge by edge. Each function's comment gives frame, units,
// preconditions, degenerate case and source.
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

// ======== math: arithmetic that all topics share ========

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
fn steradian_inverse_pi() -> f32 { return 0.318309886183790672; }

// 1 / (2 pi).
fn steradian_inverse_two_pi() -> f32 { return 0.159154943091895336; }

// False in every lane.
fn steradian_mask_none() -> bool {
    let zero = 0.0;
    return zero > 0.0;
}

// True in every lane.
fn steradian_mask_all() -> bool { return !steradian_mask_none(); }

// Squared lengths are kept above this before a division or an inverse root: the smallest normal float is 1.2e-38, and below it
// GPUs and packs count every number as 0.
fn steradian_smallest_square() -> f32 { return 1.0e-36; }

// Lengths are kept above this before a division: the root of steradian_smallest_square.
fn steradian_smallest_length() -> f32 { return 1.0e-18; }

// Divisors of numbers of the order of 1 are kept above this, so that the quotient may still be multiplied by 1.0e8 within float.
// What is smaller is rounding: a cross product of two unit vectors of float has a square of about 1.0e-14 where they are equal.
fn steradian_smallest_divisor() -> f32 { return 1.0e-30; }

// ==== complex ====

// Complex numbers: vec2(real part, imaginary part).

// The product a b.
fn steradian_complex_product(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The quotient a / b. Degenerate: |b|^2 below 1.0e-36 counts as 1.0e-36.
fn steradian_complex_quotient(a: vec2f, b: vec2f) -> vec2f {
    let scale = 1.0 / max(dot(b, b), steradian_smallest_square());
    return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) * scale;
}

// The unit number in the direction of a: a / |a|. Degenerate: zero stays zero.
fn steradian_complex_sign(a: vec2f) -> vec2f {
    return a * inverseSqrt(max(dot(a, a), steradian_smallest_square()));
}

// The unit number of angle x, exp(i x), for x in [-pi, pi].
//
// Taylor series of the cosine and the sine of x / 2, then the square. Error: the first terms left out, (pi/2)^14/14! =
// 6.4e-9 for 24 bits and (pi/2)^22/22! = 1.8e-17 for 53.
fn steradian_complex_unit(x: f32) -> vec2f {
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

// Shading frames. A frame is a mat3 whose columns are x, y and z; steradian_transform_transposed(frame, w) takes a world
// vector into it, transform(frame, l) back.

// Orthonormal right-handed frame with z along n and x, y in any direction.
//
//   n        unit normal
//
// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin, "Building an orthonormal basis, revisited", 2017.
fn steradian_frame_from_normal(n: vec3f) -> mat3x3f {
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
fn steradian_frame_from_normal_and_view(n: vec3f, v: vec3f) -> mat3x3f {
    let other = steradian_frame_from_normal(n);
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
fn steradian_gauss_legendre_node(n: i32, j: i32) -> vec2f {
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

// A direction of a fan of the sphere about a centre, on the way from there to the rim: where a radial rule in the cosine has its node.
//
//   outward     unit, perpendicular to the centre
//   rim_cosine  of the rim's distance from the centre
//   share       of 1 - cosine, in [0, 1]
fn steradian_fan_place(centre: vec3f, outward: vec3f, rim_cosine: f32, share: f32) -> vec3f {
    let cosine = 1.0 - (1.0 - rim_cosine) * share;
    return centre * cosine + outward * sqrt(max(1.0 - cosine * cosine, 0.0));
}

// ==== inverse_trig ====

// Inverse trigonometry for the kernels, the same in every language.
//
// The built-in acos and atan of shader compilers differ by up to 8e-5; these polynomials do not. Each exists for 24
// bits (float, GPU) and for 53 (double); real_digits() is a compile-time constant and picks one.
// Coefficients: tools/fit_inverse_trig finds them; the test InverseTrig.PolynomialsAreTheFittedOnes compares.

// Degree 9, largest relative error 1.3e-08 before rounding; and its derivative, by the same steps.
fn steradian_trig_angle_over_sine_24_bits(t: f32) -> vec2f {
    var p = 0.01116282422619877;
    var d = p;
    p = p * t - 0.032591688733997218;
    d = d * t + p;
    p = p * t + 0.05097575847577638;
    d = d * t + p;
    p = p * t - 0.033552997791327491;
    d = d * t + p;
    p = p * t + 0.030059175970996568;
    d = d * t + p;
    p = p * t + 0.020163489805166888;
    d = d * t + p;
    p = p * t + 0.057977801513775039;
    d = d * t + p;
    p = p * t + 0.13326657225500885;
    d = d * t + p;
    p = p * t + 0.33333538143391106;
    d = d * t + p;
    p = p * t + 0.9999999897346874;
    return vec2f(p, d);
}

// Degree 8, largest relative error 1.8e-08 before rounding.
fn steradian_trig_atan_over_argument_24_bits(q: f32) -> f32 {
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

// Angle over sine of an angle in [0, pi/2], from its cosine: acos(c) / sqrt(1 - c*c), and its derivative by t.
//
//   t        1 - c, in [0, 1]
//   returns  vec2(1, 1/3) at t = 0 to vec2(pi/2, 1) at t = 1
//
// Error: see docs/measured/accuracy.md, "angle over sine" and "slope of angle over sine". A series in 1 - c has positive terms: nothing
// cancels.
fn steradian_trig_angle_over_sine_acute_and_slope(t: f32) -> vec2f {
    return steradian_trig_angle_over_sine_24_bits(t);
}

// Angle over sine alone. Arguments: steradian_trig_angle_over_sine_acute_and_slope.
fn steradian_trig_angle_over_sine_acute(t: f32) -> f32 {
    let both = steradian_trig_angle_over_sine_acute_and_slope(t);
    return both.x;
}

// Angle over sine of an angle in [0, pi], from its cosine and the square of its sine.
//
//   c        cosine, in [-1, 1]; the polynomial goes on smoothly where rounding exceeds it
//   s2       sine squared, computed on its own (a squared cross product), not as 1 - c*c, which cancels near pi
//
// Degenerate: towards pi the value grows like pi/sine; it stops at s2 = 1.0e-30, where products with the sine are 0.
fn steradian_trig_angle_over_sine(c: f32, s2: f32) -> f32 {
    var f = steradian_trig_angle_over_sine_acute(1.0 - abs(c));
    let obtuse = c < 0.0;
    if (obtuse) {
        f = select(f, steradian_pi() * inverseSqrt(max(s2, steradian_smallest_divisor())) - f, obtuse);
    }
    return f;
}

// Angle over sine, and minus its derivative by the cosine: 1/3 at c = 1, 1 at c = 0; (1 - c f) / s2 in between and beyond. Arguments:
// steradian_trig_angle_over_sine, whose value is x.
//
// Degenerate: the slope grows like pi / s2^1.5 towards pi and stops at s2 = 1.0e-12.
// Error: see docs/measured/accuracy.md, "slope of angle over sine". The quotient cancels for acute angles; the polynomial does not.
fn steradian_trig_angle_over_sine_and_slope(c: f32, s2: f32) -> vec2f {
    var both = steradian_trig_angle_over_sine_acute_and_slope(1.0 - abs(c));
    let obtuse = c < 0.0;
    if (obtuse) {
        let f = steradian_pi() * inverseSqrt(max(s2, steradian_smallest_divisor())) - both.x;
        both = select(both, vec2f(f, (1.0 - c * min(f, 1.0e12)) / max(s2, 1.0e-12)), obtuse);
    }
    return both;
}

// The angle of the vector (x, y) from the x axis, in (-pi, pi] [rad].
//
// Degenerate: (0, 0) gives 0. Scale does not matter as long as the smaller over the larger does not underflow.
// Error: see docs/measured/accuracy.md, "atan2".
fn steradian_trig_atan2(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let larger = max(ax, ay);
    let t = min(ax, ay) / max(larger, 1.0e-37);
    let q = t * t;
    let p = steradian_trig_atan_over_argument_24_bits(q);
    var angle = t * p;
    angle = select(angle, 0.5 * steradian_pi() - angle, ay > ax);
    angle = select(angle, steradian_pi() - angle, x < 0.0);
    return select(angle, -angle, y < 0.0);
}

// The same angle, counted from -pi/2 to 3 pi/2: for angles known to lie in [0, pi], whose rounding must not wrap.
fn steradian_trig_atan2_unwrapped(y: f32, x: f32) -> f32 {
    let angle = steradian_trig_atan2(y, x);
    return select(angle, angle + 2.0 * steradian_pi(), angle < -0.5 * steradian_pi());
}

// ==== quartic ====

// Quartic polynomials that are positive on the real axis: two conjugate pairs of roots.

// The roots of a real quartic without real roots: one of each conjugate pair, the one with positive imaginary part.
struct SteradianQuarticPoles {
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
fn steradian_quartic_third_cosine(x: f32) -> f32 {
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
fn steradian_quartic_poles_approximate(c0: f32, c1: f32, c2: f32, c3: f32) -> SteradianQuarticPoles {
    let shift = 0.25 * c3;
    let shift2 = shift * shift;
    let p = c2 - 6.0 * shift2;
    let q = c1 - 2.0 * c2 * shift + 8.0 * shift2 * shift;
    let r = c0 - c1 * shift + c2 * shift2 - 3.0 * shift2 * shift2;

    // Largest root of the resolvent z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2.
    let radius2 = max(p * p + 12.0 * r, 1.0e-12);
    let radius = sqrt(radius2);
    let cosine = clamp((p * (p * p - 36.0 * r) + 13.5 * q * q) / (radius2 * radius), -1.0, 1.0);
    let z = max(0.666666666666666667 * (radius * steradian_quartic_third_cosine(cosine) - p), 0.0);
    let s = sqrt(z);

    let sum = p + z;
    let root = sqrt(max(sum * sum - 4.0 * r, 0.0));
    let difference = select(select(root, -root, q < 0.0), q / max(s, steradian_smallest_length()), z > 1.0e-3 * abs(p));
    var poles: SteradianQuarticPoles;
    poles.z1 = vec2f(-0.5 * s - shift, sqrt(max(0.5 * (sum - difference) - 0.25 * z, 1.0e-6)));
    poles.z2 = vec2f(0.5 * s - shift, sqrt(max(0.5 * (sum + difference) - 0.25 * z, 1.0e-6)));
    return poles;
}

// ======== surface: surfaces of glTF: frames, lobes and texture look-up from factors and texels ========

// ==== surface ====

// The surface of glTF: frames and lobes, from a material's factors times its texels.
//
// Radiance = emission + diffuse + specular (+ sheen) (+ coat). A back face shows the front's frame with a reversed normal:
// bumps and directions of brushing keep their places.
// Source: glTF 2.0, appendix B, and KHR_materials_specular, _ior, _transmission, _anisotropy, _sheen and _clearcoat.

// Product of two colours.
fn steradian_surface_product(a: vec3f, b: vec3f) -> vec3f {
    return vec3f(a.x * b.x, a.y * b.y, a.z * b.z);
}

// Unit vector; a vector shorter than 1e-15 stays short.
fn steradian_surface_unit(a: vec3f) -> vec3f {
    return a * inverseSqrt(max(dot(a, a), steradian_smallest_divisor()));
}

// True if a vector is long enough to have a direction, and its square is in the range of float.
fn steradian_surface_has_direction(a: vec3f) -> bool {
    let square = dot(a, a);
    return square > steradian_smallest_divisor() && square < 1.0e30;
}

// The frame of tangent-space textures on the front face.
struct SteradianSurfaceFrame {
    x: vec3f,
    y: vec3f,
    z: vec3f,
}

// The frame of a normal and the mesh's tangent.
//
//   n        unit normal
//   tangent  w below 0 reverses y
//   any      unit, perpendicular to n: x where the tangent is 0 or along the normal
fn steradian_surface_frame(n: vec3f, tangent: vec4f, any: vec3f) -> SteradianSurfaceFrame {
    let t = vec3f(tangent.x, tangent.y, tangent.z);
    let across = t - n * dot(n, t);
    let usual = steradian_surface_has_direction(across);
    var frame: SteradianSurfaceFrame;
    frame.x = select(any, steradian_surface_unit(across), usual);
    frame.y = cross(n, frame.x) * select(1.0, -1.0, usual && tangent.w < 0.0);
    frame.z = n;
    return frame;
}

// Normal from a normal map, unit; the frame's normal if the map points below the surface.
//
//   map      texel, from 0 to 1
//   scale    factor of its x and y
fn steradian_surface_bent_normal(frame: SteradianSurfaceFrame, map: vec3f, scale: f32) -> vec3f {
    let up = 2.0 * map.z - 1.0;
    let bent = frame.x * ((2.0 * map.x - 1.0) * scale) + frame.y * ((2.0 * map.y - 1.0) * scale) + frame.z * up;
    return select(frame.z, steradian_surface_unit(bent), steradian_surface_has_direction(bent) && up > 0.0);
}

// A visible surface is seen from above. If interpolation or a normal map turns the normal away from the viewer, this turns it back until
// the view lies just above its horizon.
//
//   n, view  unit
//   facing   cosine between the view and the triangle, which itself never changes
fn steradian_surface_towards(n: vec3f, view: vec3f, facing: f32) -> vec3f {
    let least = min(0.01, 0.5 * facing);
    let cosine = dot(n, view);
    let below = cosine < least;
    var turned = n;
    if (below) {
        turned = select(n, steradian_surface_unit(n + view * (least - cosine)), below);
    }
    return turned;
}

// Share of a triangle's corner in the way of a hit to the curved surface that the corners' normals describe. The way leads to the mean of
// the hit's feet on the planes through the corners, by their weights. At a vertex, on a flat triangle and in a hollow it is zero.
//
//   corner   from the hit
//   normal   of the corner: unit, or zero
//   outside  the triangle's normal, turned to the viewer
// Source: Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021.
fn steradian_surface_lift(corner: vec3f, normal: vec3f, outside: vec3f, weight: f32) -> vec3f {
    let up = normal * select(1.0, -1.0, dot(normal, outside) < 0.0);
    return up * (weight * max(0.0, dot(corner, up)));
}

// The part of a unit vector across a normal, as a unit vector. It is computed twice, because a small part is mostly rounding.
//
//   any      the result if there is no such part
fn steradian_surface_tangent(along: vec3f, n: vec3f, any: vec3f) -> vec3f {
    let across = along - n * dot(n, along);
    let x = steradian_surface_unit(across);
    return select(any, steradian_surface_unit(x - n * dot(n, x)), dot(across, across) > 1.0e-10);
}

// Width of a lobe.
fn steradian_surface_alpha(roughness: f32) -> f32 {
    return clamp(roughness * roughness, 1.0e-4, 1.0);
}

// Width of a brushed lobe along the rotated tangent.
//
//   strength   of anisotropy, from 0 to 1
fn steradian_surface_brushed_alpha(alpha: f32, strength: f32) -> f32 {
    return alpha + (1.0 - alpha) * strength * strength;
}

// Weights of a surface's lobes.
//   emission      radiance towards the viewer
//   albedo        diffuse, in the direction in which the boundary above reflects F0
//   fresnel_loss  decrease of the albedo in other directions: this fraction of (1 - v.h)^5
//   f0, f90       of the specular lobe; both are 0 without one
//   sheen         colour of Charlie's lobe
//   coat          weight of the clear coat; its F0 is 0.04
//   passes        fraction of the light from behind that comes through
struct SteradianSurfaceWeights {
    emission: vec3f,
    albedo: vec3f,
    fresnel_loss: f32,
    f0: vec3f,
    f90: vec3f,
    sheen: vec3f,
    coat: f32,
    passes: vec3f,
}

// A surface that only emits.
fn steradian_surface_unlit(emission: vec3f) -> SteradianSurfaceWeights {
    let black = vec3f(0.0, 0.0, 0.0);
    var weights: SteradianSurfaceWeights;
    weights.emission = emission;
    weights.albedo = black;
    weights.fresnel_loss = 0.0;
    weights.f0 = black;
    weights.f90 = black;
    weights.sheen = black;
    weights.coat = 0.0;
    weights.passes = black;
    return weights;
}

// The dielectric below a material's colour.
//   f0, f90  of its boundary
//   largest  channel of f0
struct SteradianSurfaceDielectric {
    f0: vec3f,
    f90: f32,
    largest: f32,
}

// The dielectric of a material.
//
//   specular     strength; its colour multiplies the reflectance
//   reflectance  F0 of the index of refraction
fn steradian_surface_dielectric(specular: f32, specular_color: vec3f, reflectance: f32) -> SteradianSurfaceDielectric {
    let f0 = specular_color * reflectance;
    var dielectric: SteradianSurfaceDielectric;
    dielectric.f0 = vec3f(clamp(f0.x, 0.0, 1.0), clamp(f0.y, 0.0, 1.0), clamp(f0.z, 0.0, 1.0)) * specular;
    dielectric.f90 = specular;
    dielectric.largest = max(dielectric.f0.x, max(dielectric.f0.y, dielectric.f0.z));
    return dielectric;
}

// The metallic-roughness surface. The diffuse lobe has albedo base (1 - metallic) (1 - F), F the largest channel of the dielectric's Fresnel:
// light that its specular lobe reflects does not reach it.
//
//   metallic   from 0 to 1
fn steradian_surface_weights(emission: vec3f, base: vec3f, metallic: f32, dielectric: SteradianSurfaceDielectric) -> SteradianSurfaceWeights {
    let enters = 1.0 - dielectric.largest;
    let loses = dielectric.largest < 1.0;
    var weights = steradian_surface_unlit(emission);
    weights.albedo = base * ((1.0 - metallic) * enters);
    weights.fresnel_loss = select(0.0, (dielectric.f90 - dielectric.largest) / select(1.0, enters, loses), loses);
    weights.f0 = dielectric.f0 * (1.0 - metallic) + base * metallic;
    let f90 = dielectric.f90 * (1.0 - metallic) + metallic;
    weights.f90 = vec3f(f90, f90, f90);
    return weights;
}

// The same surface as a thin wall.
//
//   share    of the diffuse light that passes instead
//   cosine   between the normal and the view
fn steradian_surface_transmitting(opaque: SteradianSurfaceWeights, base: vec3f, metallic: f32, dielectric: SteradianSurfaceDielectric, share: f32, cosine: f32) -> SteradianSurfaceWeights {
    let c = clamp(1.0 - cosine, 0.0, 1.0);
    let reflected = dielectric.largest + (dielectric.f90 - dielectric.largest) * c * c * c * c * c;
    var weights = opaque;
    weights.albedo = opaque.albedo * (1.0 - share);
    weights.passes = base * ((1.0 - metallic) * share * (1.0 - min(reflected, 1.0)));
    return weights;
}

// A surface below a layer that lets a fraction of the light through.
fn steradian_surface_below(bare: SteradianSurfaceWeights, fraction: f32) -> SteradianSurfaceWeights {
    var weights = bare;
    weights.albedo = bare.albedo * fraction;
    weights.f0 = bare.f0 * fraction;
    weights.f90 = bare.f90 * fraction;
    weights.passes = bare.passes * fraction;
    return weights;
}

// A surface below sheen. Light that the fibres reflect does not reach the layers below.
//
//   albedo   of a white sheen, as seen from the view
fn steradian_surface_with_sheen(bare: SteradianSurfaceWeights, sheen: vec3f, albedo: f32) -> SteradianSurfaceWeights {
    var weights = steradian_surface_below(bare, clamp(1.0 - max(sheen.x, max(sheen.y, sheen.z)) * albedo, 0.0, 1.0));
    weights.sheen = sheen;
    return weights;
}

// A surface below a clear coat. Light that it reflects at the view's angle does not reach the layers below.
//
//   cosine   between the coat's normal and the view
fn steradian_surface_with_coat(bare: SteradianSurfaceWeights, coat: f32, cosine: f32) -> SteradianSurfaceWeights {
    let c = clamp(1.0 - cosine, 0.0, 1.0);
    let fraction = 1.0 - coat * (0.04 + 0.96 * c * c * c * c * c);
    var weights = steradian_surface_below(bare, fraction);
    weights.sheen = bare.sheen * fraction;
    weights.emission = bare.emission * fraction;
    weights.coat = coat;
    return weights;
}

// A surface that covers a part of its place. The rest shows the surfaces behind.
//
//   coverage   alpha of its base colour, from 0 to 1
fn steradian_surface_covering(bare: SteradianSurfaceWeights, coverage: f32) -> SteradianSurfaceWeights {
    let gap = 1.0 - coverage;
    var weights = steradian_surface_below(bare, coverage);
    weights.emission = bare.emission * coverage;
    weights.sheen = bare.sheen * coverage;
    weights.coat = bare.coat * coverage;
    weights.passes = weights.passes + vec3f(gap, gap, gap);
    return weights;
}

// ==== texture ====

// Texture look-up: the mean over a pixel's footprint, as taps on ever smaller pictures. The caller reads the texels.
//
// Coordinates run from 0 to 1 over the picture. Texel centres lie at half-integers.

// Taps on a texture for the mean over a footprint.
//   covers  the footprint is more than a texel; else there is one tap on the picture itself
//   count   side by side along the footprint's longer axis, about its middle; at most 16
//   axis    that axis at full length
//   width   of a tap, in texels; its logarithm to base 2 is the level to read
struct SteradianTextureTaps {
    covers: bool,
    count: f32,
    axis: vec2f,
    width: f32,
}

// Taps on the longer axis of the ellipse inscribed in the footprint, as wide as the shorter axis. In texels, a circle of diameter 1 becomes
// an ellipse, whose axes are those of J transpose(J).
//
//   size         of the picture, in texels
//   right, down  change of the coordinates to the pixel's neighbours
//
// Degenerate: a footprint of a million texels or more gets one tap on the mean of all.
fn steradian_texture_taps(size: vec2f, right: vec2f, down: vec2f) -> SteradianTextureTaps {
    let a = vec2f(right.x * size.x, right.y * size.y);
    let b = vec2f(down.x * size.x, down.y * size.y);
    let xx = a.x * a.x + b.x * b.x;
    let xy = a.x * a.y + b.x * b.y;
    let yy = a.y * a.y + b.y * b.y;
    let difference = 0.5 * (xx - yy);
    let longer2 = 0.5 * (xx + yy) + sqrt(difference * difference + xy * xy);
    var taps: SteradianTextureTaps;
    taps.covers = longer2 > 1.0;
    taps.count = 1.0;
    taps.axis = vec2f(0.0, 0.0);
    taps.width = 1.0;
    if (taps.covers) {
        let spread = taps.covers && longer2 < 1.0e12;
        let square = select(1.0, longer2, spread);
        let longer = sqrt(square);
        let shorter = max(1.0, abs(a.x * b.y - a.y * b.x) / longer);
        let wide = difference > 0.0;
        let along = vec2f(select(xy, square - yy, wide), select(square - xx, xy, wide));
        let along2 = along.x * along.x + along.y * along.y;
        let scale = select(0.0, longer / sqrt(max(along2, steradian_smallest_divisor())), along2 > 0.0);
        taps.count = select(1.0, clamp(-floor(0.001 - longer / shorter), 1.0, 16.0), spread);
        taps.axis = vec2f(select(0.0, along.x * scale / size.x, spread), select(0.0, along.y * scale / size.y, spread));
        taps.width = select(select(1.0, 1.0e12, taps.covers), max(shorter, longer * 0.0625), spread);
    }
    return taps;
}

// A coordinate that can be looked up: 0 for those that are not numbers, or too large to have a fraction.
fn steradian_texture_coordinate(u: f32) -> f32 {
    return select(0.0, u, abs(u) < 1.0e7);
}

// The centre of the texel at a coordinate, where neighbours weigh nothing.
//
//   size   of the picture in that direction, in texels
fn steradian_texture_center(u: f32, size: f32) -> f32 {
    return (floor(u * size) + 0.5) / size;
}

// Texels on both sides of a coordinate.
//   low, high  their numbers
//   share      weight of the second
struct SteradianTextureTexels {
    low: f32,
    high: f32,
    share: f32,
}

// The two texels whose blend is a picture's value at a coordinate.
//
//   size   in texels, at most 2^20
//   wrap   0 repeats the picture, 1 mirrors it, 2 continues its edge
fn steradian_texture_texels(u: f32, size: f32, wrap: i32) -> SteradianTextureTexels {
    var inside = u;
    if (wrap == 0) {
        inside = u - floor(u);
    }
    if (wrap == 1) {
        let turn = u - 2.0 * floor(u * 0.5);
        inside = min(turn, 2.0 - turn);
    }
    let last = size - 1.0;
    let at = min(max(inside, 0.0), 1.0) * size - 0.5;
    let low = floor(at);
    let high = low + 1.0;
    var texels: SteradianTextureTexels;
    texels.share = at - low;
    texels.low = max(low, 0.0);
    texels.high = min(high, last);
    if (wrap == 0) {
        texels.low = select(low, last, low < 0.0);
        texels.high = select(high, 0.0, high > last);
    }
    return texels;
}

// ======== polygon: polygons: irradiance, solid angle, clipping to the horizon; Lambert's lobe ========

// ==== polygon ====

// Irradiance and solid angle of polygonal lights: the boundary integrals of Lambert and Girard.
//
// A light is walked edge by edge, so that any number of vertices, non-convex outlines and holes (walked the other
// way round) cost no array. Frame: origin at the shading point, z the surface normal. Walk order: seen from the
// point, det(v_i, v_i+1, inside) > 0, the reverse of a stored polygon that is counter-clockwise from its lit side.

// The state of a walk.
//   edges    sum over the edges, each clipped to the horizon, of half its angle times its plane's unit normal [rad]
//   horizon  product of unit complex numbers: its angle is the arc of the horizon that closes the clipped outline
struct SteradianPolygonWalk {
    edges: vec3f,
    horizon: vec2f,
}

// Unit direction of a vertex.
//
//   v        vertex relative to the shading point, any unit of length
//
// Degenerate: a length below 1e-18 (the point lies on the vertex) gives a vector shorter than 1; one above 1e18, whose
// square leaves the range of float, the zero vector. Both are finite and add next to nothing to any sum.
fn steradian_polygon_direction(v: vec3f) -> vec3f {
    let d2 = dot(v, v);
    let scale = select(0.0, inverseSqrt(max(d2, steradian_smallest_square())), d2 < 1.0e36);
    return v * scale;
}

// Irradiance vector of one edge: half the edge's angle times its plane's unit normal [rad].
//
//   a, b     unit directions of the edge's ends, in walk order
//   returns  its z is what the edge sends to a surface with normal z; divided by pi: the form factor's share
//
// Degenerate: a = b gives 0; a = -b spans no plane and gives 0.
// Error: see docs/measured/accuracy.md, "polygon edge"; the normal is taken from the ends' difference, so that the rounding of the
// product is a share of the edge's length and not of 1.
// Source: Lambert 1760; Baum, Rushmeier, Winget, "Improving radiosity solutions through the use of analytically
// determined form-factors", 1989, eq. 6.
fn steradian_polygon_edge(a: vec3f, b: vec3f) -> vec3f {
    let n = cross(a, b - a);
    let f = steradian_trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}

// A walk before its first edge: no edges, and a horizon of angle 0.
fn steradian_polygon_begin() -> SteradianPolygonWalk {
    var walk: SteradianPolygonWalk;
    walk.edges = vec3f(0.0, 0.0, 0.0);
    walk.horizon = vec2f(1.0, 0.0);
    return walk;
}

// The part of an edge above the horizon, by its ends: start = a start_a + b start_b, end = a end_a + b end_b.
//   start, end   unit directions; equal where nothing is above
//   rises, sinks whether the part begins, or ends, on the horizon
struct SteradianEdgePart {
    start: vec3f,
    end: vec3f,
    start_a: f32,
    start_b: f32,
    end_a: f32,
    end_b: f32,
    rises: bool,
    sinks: bool,
}

// An edge as a part of itself.
fn steradian_edge_whole(a: vec3f, b: vec3f) -> SteradianEdgePart {
    var part: SteradianEdgePart;
    part.start = a;
    part.end = b;
    part.start_a = 1.0;
    part.start_b = 0.0;
    part.end_a = 0.0;
    part.end_b = 1.0;
    part.rises = steradian_mask_none();
    part.sinks = steradian_mask_none();
    return part;
}

// Clips an edge to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (steradian_polygon_direction), in walk order
//
// Degenerate: an edge below the horizon has equal ends.
fn steradian_edge_above_horizon(a: vec3f, b: vec3f) -> SteradianEdgePart {
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    var part = steradian_edge_whole(a, b);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (a_below || b_below) {
        // The edge's crossing of the horizon: weights of one sign, so nothing cancels.
        let wa = abs(b.z);
        let wb = abs(a.z);
        let p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
        let scale = inverseSqrt(max(dot(p, p), steradian_smallest_square()));
        let crossing = vec3f(p.x * scale, p.y * scale, 0.0);
        part.start = select(a, crossing, a_below);
        part.end = select(b, crossing, b_below);  // both below: start = end, an edge of no length
        part.start_a = select(1.0, wa * scale, a_below);
        part.start_b = select(0.0, wb * scale, a_below);
        part.end_a = select(0.0, wa * scale, b_below);
        part.end_b = select(1.0, wb * scale, b_below);
    }
    return part;
}

// Adds the part of an edge above the horizon (steradian_edge_above_horizon).
//
// What lies below is replaced by an arc of the horizon from where the outline leaves to where it comes back. All
// these arcs of a plane light lie within one half circle and run the same way, so that only the sum of their angles
// counts: each crossing multiplies its azimuth into a complex number, in whatever order the crossings come.
fn steradian_polygon_add_part(walk: SteradianPolygonWalk, part: SteradianEdgePart) -> SteradianPolygonWalk {
    var next = walk;
    let crosses = part.rises || part.sinks;
    if (crosses) {
        let crossing = select(part.end, part.start, part.rises);
        let y = select(-crossing.y, crossing.y, part.rises);  // coming up: the azimuth; going down: its conjugate
        let h = walk.horizon;
        next.horizon = select(h, vec2f(h.x * crossing.x - h.y * y, h.x * y + h.y * crossing.x), crosses);
    }
    next.edges = walk.edges + steradian_polygon_edge(part.start, part.end);
    return next;
}

// Adds one edge, clipped to the horizon z = 0.
//
//   a, b     unit directions of the edge's ends (steradian_polygon_direction), in walk order
fn steradian_polygon_add_edge(walk: SteradianPolygonWalk, a: vec3f, b: vec3f) -> SteradianPolygonWalk {
    var next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        next = steradian_polygon_add_part(walk, steradian_edge_above_horizon(a, b));
    }
    return next;
}

// Irradiance vector of the part of the light above the horizon [sr times radiance 1].
//
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//   returns  in the shading frame; z is the irradiance, the direction is where the light is, seen on average
//
// Degenerate: a point in the light's plane gives 0 up to rounding.
fn steradian_polygon_irradiance_vector(walk: SteradianPolygonWalk, reversed: bool) -> vec3f {
    let facing = select(1.0, -1.0, reversed);
    var arc = 0.0;
    if (abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0) {
        arc = steradian_trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    let e = walk.edges * facing;
    return vec3f(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, steradian_pi()));
}

// Irradiance of radiance 1 from the part of the light above the horizon, in [0, pi]. See steradian_polygon_irradiance_vector.
//
// Error: see docs/measured/accuracy.md, "polygon irradiance".
fn steradian_polygon_irradiance(walk: SteradianPolygonWalk, reversed: bool) -> f32 {
    let e = steradian_polygon_irradiance_vector(walk, reversed);
    return e.z;
}

// The state of a solid angle's walk: a product of complex numbers, each with half a triangle's solid angle.
struct SteradianSolidAngleWalk {
    first: vec3f,
    product: vec2f,
}

// A solid angle's walk before its first triangle.
//
//   first    unit direction of any vertex of the light
fn steradian_solid_angle_begin(first: vec3f) -> SteradianSolidAngleWalk {
    var walk: SteradianSolidAngleWalk;
    walk.first = first;
    walk.product = vec2f(1.0, 0.0);
    return walk;
}

// Adds the triangle of the first vertex and one edge. Directions as for steradian_polygon_add_edge; no horizon here.
//
// Degenerate: a triangle without area has a real factor and adds nothing.
// Source: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
fn steradian_solid_angle_add_edge(walk: SteradianSolidAngleWalk, a: vec3f, b: vec3f) -> SteradianSolidAngleWalk {
    var next = walk;
    var re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    var im = dot(walk.first, cross(a - walk.first, b - a));  // the determinant, from differences: it is small where they are
    let scale = inverseSqrt(max(re * re + im * im, steradian_smallest_square()));
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
// Error: see docs/measured/accuracy.md, "polygon solid angle".
fn steradian_solid_angle_finish(walk: SteradianSolidAngleWalk, reversed: bool) -> f32 {
    let y = select(walk.product.y, -walk.product.y, reversed);
    return max(2.0 * steradian_trig_atan2_unwrapped(y, walk.product.x), 0.0);
}

// ==== horizon_clip ====

// Clipping a walked outline to the horizon, for integrals along its edges.
//
// Lambert's integral needs only the length of the arcs of the horizon that close a clipped outline
// (steradian_polygon_add_edge); every other boundary integral has to be taken along them. The clip hands them out as ordinary
// edges: where the outline comes back up, the arc from where it last went down. An outline that begins below the
// horizon comes up before it was seen to go down: this first entry is kept, and the last arc ends there.
// The arcs of a plane light lie on one half circle, and what counts is the signed sum over them; so arcs may join
// different contours, and one clip serves a whole light with its holes:
//
//   SteradianHorizonClip clip = steradian_horizon_clip_begin();
//   for each edge a, b of each contour:
//       clip = steradian_horizon_clip_edge(clip, a, b);
//       integrate clip.start, clip.end
//       if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
//   clip = steradian_horizon_clip_finish(clip);
//   if (any_lane(clip.closes)) integrate clip.arc_start, clip.arc_end
// each arc in two where it is wide (steradian_horizon_arc_wide, steradian_horizon_arc_middle)
//
// Frame: z the surface normal; unit directions (steradian_polygon_direction) in walk order.

// The state of a clip and what it last handed out.
//   start, end          the edge's part above the horizon; equal where there is none
//   arc_start, arc_end  an arc of the horizon that belongs to the outline; equal where there is none
//   closes              whether there is an arc
//   leave               where the outline last went down and did not come back yet; zero: nowhere
//   entry               where it came up without having been seen to go down; zero: nowhere
struct SteradianHorizonClip {
    start: vec3f,
    end: vec3f,
    arc_start: vec3f,
    arc_end: vec3f,
    closes: bool,
    leave: vec3f,
    entry: vec3f,
}

// The state before the first edge.
fn steradian_horizon_clip_begin() -> SteradianHorizonClip {
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var clip: SteradianHorizonClip;
    clip.start = nowhere;
    clip.end = nowhere;
    clip.arc_start = nowhere;
    clip.arc_end = nowhere;
    clip.closes = steradian_mask_none();
    clip.leave = nowhere;
    clip.entry = nowhere;
    return clip;
}

// The direction in which the edge from a to b crosses the plane z = 0; their z must differ in sign.
//
// Degenerate: an edge through the zenith's axis, or an end that is the zero vector, has no azimuth and gives zero.
// Error: weights of one sign, so nothing cancels unless a and b are nearly opposite.
fn steradian_horizon_crossing(a: vec3f, b: vec3f) -> vec3f {
    let wa = abs(b.z);
    let wb = abs(a.z);
    var p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    p = p * inverseSqrt(max(dot(p, p), steradian_smallest_square()));
    return vec3f(p.x, p.y, 0.0);
}

// True where an arc from a to b may be nearly half the horizon: integrals take it in two.
fn steradian_horizon_arc_wide(a: vec3f, b: vec3f) -> bool { return dot(a, b) < -0.9999; }

// A direction between the ends of an arc of the horizon that is wider than a right angle.
//
//   a, b     unit directions of its ends, z = 0
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
//
// Two ends that are opposite to rounding say no more which half of the horizon is meant: it is the one that the walk goes round the
// zenith, as the arcs that close an outline do.
// Degenerate: equal ends give a zero vector.
fn steradian_horizon_arc_middle(a: vec3f, b: vec3f, facing: f32) -> vec3f {
    let unsure = 1.0e-6;
    var across = vec2f(b.y - a.y, a.x - b.x) * facing;
    let turn = (a.x * b.y - a.y * b.x) * facing;
    across = across * (inverseSqrt(max(dot(across, across), steradian_smallest_square())) * select(1.0, -1.0, turn < -unsure));
    return vec3f(across.x, across.y, 0.0);
}

// Clips one edge.
//
//   a, b     unit directions of the edge's ends; z < 0 is below
//   returns  the state with start, end and, where the edge crosses and an arc is due, the arc
fn steradian_horizon_clip_edge(clip: SteradianHorizonClip, a: vec3f, b: vec3f) -> SteradianHorizonClip {
    var next = clip;
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    next.start = a;
    next.end = b;
    next.closes = steradian_mask_none();
    if (a_below || b_below) {
        let nowhere = vec3f(0.0, 0.0, 0.0);
        let crossing = steradian_horizon_crossing(a, b);
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
fn steradian_horizon_clip_finish(clip: SteradianHorizonClip) -> SteradianHorizonClip {
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
//   irradiance  steradian_polygon_irradiance, in [0, pi]
fn steradian_lambert_radiance(irradiance: f32) -> f32 {
    return irradiance * steradian_inverse_pi();
}

// The lobe itself: BRDF of albedo 1 times the cosine of the light's direction l (unit, shading frame).
fn steradian_lambert_lobe(l: vec3f) -> f32 {
    return max(l.z, 0.0) * steradian_inverse_pi();
}

// Schlick's (1 - v.h)^5 in one direction of the light. Unit vectors; 0 where l = v, 1 where l = -v.
fn steradian_lambert_grazing(l: vec3f, v: vec3f) -> f32 {
    let x = 1.0 - sqrt(clamp(0.5 + 0.5 * dot(l, v), 0.0, 1.0));
    let x2 = x * x;
    return x2 * x2 * x;
}

// The same averaged over an even sky, each direction by its cosine.
//
//   v_z      cosine of the view, in [0, 1]
//
// Error: 9.0e-6. The test LambertUnderFresnel.MeanOverTheSkyIsThatOfQuadrature finds the polynomial again.
fn steradian_lambert_grazing_of_sky(v_z: f32) -> f32 {
    let t = 1.0 - clamp(v_z, 0.0, 1.0);
    return 8.2571e-5 + t * (2.01647e-3 + t * (9.33829e-3 + t * (7.74731e-3 + t * 8.97984e-3)));
}

// The same averaged over a light, each direction by its cosine. Approximate: in the light's mean direction, blended with
// the sky's mean by the share of the sky that the light is.
//
//   e        irradiance vector of the light above the horizon; e.z its irradiance, in [0, pi]
//   v        unit view
//
// Exact for small lights and for the whole sky. Error: see docs/measured/accuracy.md, "Diffuse under Fresnel".
// Degenerate: no light gives a number in [0, 1].
fn steradian_lambert_grazing_of_light(e: vec3f, v: vec3f) -> f32 {
    let mean = e * inverseSqrt(max(dot(e, e), steradian_smallest_square()));
    let in_mean = steradian_lambert_grazing(mean, v);
    let share = clamp(e.z * steradian_inverse_pi(), 0.0, 1.0);
    return in_mean + (steradian_lambert_grazing_of_sky(v.z) - in_mean) * share;
}

// Irradiance that reaches a diffuse lobe below a dielectric's boundary, of what it would get at F = F0.
//
//   loss     (F90 - F0) / (1 - F0) of the boundary; 0: what the lobe gets does not depend on the light's direction
//   e, v     as for steradian_lambert_grazing_of_light
//
// Source: glTF 2.0, appendix B: diffuse light weighs 1 - F(v.h).
fn steradian_lambert_irradiance_below(e: vec3f, v: vec3f, loss: f32) -> f32 {
    return e.z * (1.0 - loss * steradian_lambert_grazing_of_light(e, v));
}

// ======== lobe: lobes of surfaces ========

// ==== charlie ====

// Charlie: the sheen of cloth, glTF's KHR_materials_sheen.
//
// Frame: z the surface normal; l light and v view unit and pointing away from the surface. Brightest where light or view
// grazes, and dark about the mirror direction: no peak, but a hole.
// Source: Estevez, Kulla, "Production friendly microfacet sheen BRDF", 2017, eq. 2 to 4 and table 1.

// The lobe of one view.
//   exponent  of the half vector's sine squared: 1 / (2 alpha)
//   scale     what multiplies its power over 1 + both shadowings: (2 + 1 / alpha) / (8 pi v_z); 0 for a view below
//   a ... e   the curve of the shadowing's logarithm, blended for alpha
//   middle    that curve at 1/2
//   masking   the view's own 1 + Lambda
struct SteradianCharlieLobe {
    view: vec3f,
    exponent: f32,
    scale: f32,
    a: f32,
    b: f32,
    c: f32,
    d: f32,
    e: f32,
    middle: f32,
    masking: f32,
}

// The authors' curve: a / (1 + b x^c) + d x + e.
//
//   x        in [0, 1/2]; below 1.0e-9 it is taken there, where the power is not yet 0 but the lobe is
fn steradian_charlie_curve(lobe: SteradianCharlieLobe, x: f32) -> f32 {
    let power = exp(lobe.c * log(max(x, 1.0e-9)));
    return lobe.a / (1.0 + lobe.b * power) + lobe.d * x + lobe.e;
}

// Lambda of the shadowing, fitted by its authors; the curve's mirror image beyond cosine 1/2.
//
//   cosine   of light or view; outside of [0, 1] (by rounding) it is taken at the end
fn steradian_charlie_lambda(lobe: SteradianCharlieLobe, cosine: f32) -> f32 {
    let x = clamp(cosine, 0.0, 1.0);
    let steep = x > 0.5;
    let curve = steradian_charlie_curve(lobe, select(x, 1.0 - x, steep));
    return exp(select(curve, 2.0 * lobe.middle - curve, steep));
}

// Prepares the lobe of a view.
//
//   v        unit view
//   alpha    roughness squared in (0, 1], taken to be at least 0.04: below, the model reflects more than arrives and only
//            within a few degrees of the horizon
//
// Degenerate: a view that is not above the surface makes a lobe of 0.
fn steradian_charlie_prepare(v: vec3f, alpha: f32) -> SteradianCharlieLobe {
    let width = clamp(alpha, 0.04, 1.0);
    let t = (1.0 - width) * (1.0 - width);
    var lobe: SteradianCharlieLobe;
    lobe.view = v;
    lobe.exponent = 0.5 / width;
    lobe.scale = select(0.0, (2.0 + 1.0 / width) * 0.0397887357729738339 / max(v.z, 1.0e-6), v.z > 0.0);
    lobe.a = 21.5473 + t * (25.3245 - 21.5473);
    lobe.b = 3.82987 + t * (3.32435 - 3.82987);
    lobe.c = 0.19823 + t * (0.16801 - 0.19823);
    lobe.d = -1.97760 + t * (1.97760 - 1.27393);
    lobe.e = -4.32054 + t * (4.32054 - 4.85967);
    lobe.middle = 0.0;
    lobe.middle = steradian_charlie_curve(lobe, 0.5);
    lobe.masking = 0.0;
    lobe.masking = 1.0 + steradian_charlie_lambda(lobe, v.z);
    return lobe;
}

// BRDF of colour 1 times the light's cosine, D / (4 v_z (1 + Lambda_v + Lambda_l)).
//
//   l        unit; 0 where it is not above the surface
//
// Degenerate: l = -v has no half vector and gives a finite number.
// Error: see docs/measured/accuracy.md, "Charlie lobe".
fn steradian_charlie_lobe(lobe: SteradianCharlieLobe, l: vec3f) -> f32 {
    let h = l + lobe.view;
    let across = h.x * h.x + h.y * h.y;
    let sine2 = across / max(across + h.z * h.z, steradian_smallest_divisor());
    let power = exp(lobe.exponent * log(clamp(sine2, steradian_smallest_divisor(), 1.0)));
    let shadowed = lobe.scale * power / (lobe.masking + steradian_charlie_lambda(lobe, l.z));
    return select(0.0, shadowed, l.z > 0.0);
}

// ==== lobe_product ====

// The product of cosine lobes as one lobe: peak-matched, isotropic or anisotropic.
//
// P(u) = product of (u.r_i)^n_i is replaced by a lobe that has its maximum, at the same place, and its curvature
// there. Spherical Gaussians, the usual way, miss height and width from 30 degrees between the axes on.
// Any number of lobes is walked several times: twice for Newton steps towards the maximum, once for the result.
//
//   SteradianLobeProduct p = steradian_lobe_product_begin(start);          // start: direction of the sum of n_i r_i
//   for each lobe: p = steradian_lobe_product_add(p, r_i, n_i);
//   start = steradian_lobe_product_newton(p);                     // three lobes within 50 degrees: .003 degrees off after one
//   ... the same again, then
//   SteradianCosineLobe lobe = steradian_lobe_product_isotropic(p);
//
// Frame: any. Axes are unit vectors; the peak must lie in front of all of them, else the product is 0.
// Source: this project (docs/theory/moments.md).

// A cosine lobe: scale (u.axis)^exponent.
struct SteradianCosineLobe {
    axis: vec3f,
    exponent: f32,
    scale: f32,
}

// A stretched cosine lobe: scale (w.z)^exponent with w the unit direction of steradian_lobe_product_stretch(lobe, u): about the z axis of its own
// frame.
struct SteradianStretchedLobe {
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
struct SteradianLobeProduct {
    about: mat3x3f,
    total: f32,
    log_scale: f32,
    slope: vec2f,
    curvature: vec3f,
    lowest: f32,
}

// The state before the first lobe.
fn steradian_lobe_product_begin(direction: vec3f) -> SteradianLobeProduct {
    var p: SteradianLobeProduct;
    p.about = steradian_frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2f(0.0, 0.0);
    p.curvature = vec3f(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}

// Adds (u.r)^n.
fn steradian_lobe_product_add(p: SteradianLobeProduct, r: vec3f, n: f32) -> SteradianLobeProduct {
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
fn steradian_lobe_product_newton(p: SteradianLobeProduct) -> vec3f {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    let xy = p.curvature.y;
    let inverse = 1.0 / max(xx * yy - xy * xy, steradian_smallest_divisor());
    let step_to = vec3f(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    let u = steradian_transform(p.about, step_to);
    return u * inverseSqrt(dot(u, u));
}

// Height of the product at the sums' direction; 0 where a lobe does not reach.
fn steradian_lobe_product_scale(p: SteradianLobeProduct) -> f32 {
    return select(0.0, exp(p.log_scale), p.lowest > 1.0e-4);
}

// The isotropic lobe; its exponent gives the full lobe's integral the right size.
fn steradian_lobe_product_isotropic(p: SteradianLobeProduct) -> SteradianCosineLobe {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    var lobe: SteradianCosineLobe;
    lobe.axis = steradian_transform(p.about, vec3f(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}

// The anisotropic lobe. A linear map of determinant 1 turns it into an isotropic one and polygons into polygons:
// the integral over a light is scale times the moment of the stretched outline about z.
fn steradian_lobe_product_anisotropic(p: SteradianLobeProduct) -> SteradianStretchedLobe {
    let xx = p.total + p.curvature.x + 3.0;
    let yy = p.total + p.curvature.z + 3.0;
    let xy = p.curvature.y;
    let d = sqrt(max(xx * yy - xy * xy, steradian_smallest_divisor()));
    // The root of a symmetric matrix M of determinant 1 is (M + 1)/sqrt(trace M + 2).
    let root = inverseSqrt((xx + yy) / d + 2.0);
    var lobe: SteradianStretchedLobe;
    lobe.frame = p.about;
    lobe.stretch = vec3f(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}

// A direction in the lobe's stretched frame. It is not unit; the zero vector stays zero.
fn steradian_lobe_product_stretch(lobe: SteradianStretchedLobe, u: vec3f) -> vec3f {
    let l = steradian_transform_transposed(lobe.frame, u);
    return vec3f(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}

// The maximum of (u.r1)^n1 (u.r2)^n2, in closed form: it lies in the plane of the two axes.
//
// Degenerate: axes 90 degrees apart and more give a direction where the product is about 0; equal axes give r1.
fn steradian_lobe_product_peak_of_two(r1: vec3f, n1: f32, r2: vec3f, n2: f32) -> vec3f {
    let cosine = max(dot(r1, r2), 1.0e-6);
    let across = r2 - r1 * dot(r1, r2);
    let sine2 = dot(across, across);
    let tangent = sqrt(sine2) / cosine;
    let sum = n1 + n2;
    let t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    let u = r1 + across * (t * inverseSqrt(max(sine2, steradian_smallest_divisor())));
    return u * inverseSqrt(dot(u, u));
}

// ==== microfacet ====

// Microfacet terms: GGX and Beckmann distributions, height-correlated Smith shadowing, Schlick's Fresnel.
//
// Frame: z the surface normal, x and y the directions of the widths ax and ay (equal where isotropic). l light,
// v view, h half vector, all unit and pointing away from the surface. Width alpha = roughness squared, at least 1.0e-4.

// Half vector of light and view. Degenerate: l = -v gives the zero vector.
fn steradian_microfacet_half_vector(l: vec3f, v: vec3f) -> vec3f {
    let h = l + v;
    return h * inverseSqrt(max(dot(h, h), steradian_smallest_square()));
}

// Distribution of GGX: 1 / (pi ax ay ((h_x/ax)^2 + (h_y/ay)^2 + h_z^2)^2).
//
// In the components of h, not in 1 - h_z^2, which cancels in float at small alpha.
// Degenerate: the sum is at least 1 for a unit h; the zero half vector of l = -v, finite.
// Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction", 2007, eq. 33; anisotropic: Heitz,
// "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014, eq. 85.
fn steradian_ggx_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let x = h.x / ax;
    let y = h.y / ay;
    let d = max(x * x + y * y + h.z * h.z, 1.0e-6);
    return steradian_inverse_pi() / (ax * ay * d * d);
}

// Length of the direction w stretched by the surface: sqrt(w_z^2 + (ax w_x)^2 + (ay w_y)^2).
fn steradian_ggx_stretched_length(w: vec3f, ax: f32, ay: f32) -> f32 {
    let x = ax * w.x;
    let y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Smith's shadowing and masking, height-correlated, in [0, 1].
//
// Degenerate: 0 where l or v is not above the surface.
// Source: Heitz 2014, eq. 99, written without Lambda: 2 l_z v_z / (l_z |v|' + v_z |l|').
fn steradian_ggx_shadowing(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let lz = max(l.z, 0.0);
    let vz = max(v.z, 0.0);
    let d = lz * steradian_ggx_stretched_length(v, ax, ay) + vz * steradian_ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, steradian_smallest_square());
}

// Schlick's Fresnel with a free value at grazing.
//
//   f0, f90  reflectance along and across the normal
//   v_dot_h  cosine between view and half vector
//
// Source: Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, eq. 15.
fn steradian_fresnel_schlick(f0: f32, f90: f32, v_dot_h: f32) -> f32 {
    let x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    let x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// Distribution of Beckmann: exp(-((h_x/ax)^2 + (h_y/ay)^2)/h_z^2) / (pi ax ay h_z^4).
//
// Degenerate: h_z is kept above 1.0e-5, where the exponential is 0 for any alpha up to 1.
// Source: Walter et al. 2007, eq. 25.
fn steradian_beckmann_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let hz = max(h.z, 1.0e-5);
    let x = h.x / (ax * hz);
    let y = h.y / (ay * hz);
    let z2 = hz * hz;
    return steradian_inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}

// A microfacet lobe without shadowing and Fresnel: BRDF times cosine, D / (4 v_z).
//
//   d        distribution at the half vector
//   l, v     directions; 0 where either is not above the surface
fn steradian_microfacet_lobe_unshadowed(d: f32, l: vec3f, v: vec3f) -> f32 {
    let above = l.z > 0.0 && v.z > 0.0;
    return select(0.0, d / (4.0 * max(v.z, 1.0e-6)), above);
}

// The GGX lobe with shadowing, without Fresnel: BRDF times cosine, D G2 / (4 v_z).
fn steradian_ggx_lobe(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let h = steradian_microfacet_half_vector(l, v);
    let g = steradian_ggx_shadowing(l, v, ax, ay);
    return steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, ax, ay) * g, l, v);
}

// ==== phong ====

// Lobes that are a power of a cosine: Phong about the mirrored view, Blinn-Phong about the normal.

// The logarithm of x for x in (0, 1], with small relative error up to 1: near 1 a GPU's own log promises 5e-7 of absolute error, and a
// high exponent multiplies it.
//
// Error: relative 1e-7 in float for x above 0.75, 3e-16 in double; below as the built-in log.
fn steradian_phong_log(x: f32) -> f32 {
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
fn steradian_phong_power(x: f32, n: f32) -> f32 {
    return exp(n * steradian_phong_log(max(x, steradian_smallest_divisor())));
}

// The view mirrored at the surface.
//
//   v        view direction, shading frame
fn steradian_phong_mirror(v: vec3f) -> vec3f {
    return vec3f(-v.x, -v.y, v.z);
}

// The Phong lobe: (n + 1) / (2 pi) max(l.r, 0)^n. Its integral over the sphere is 1; it has no foreshortening.
//
//   l        unit direction of the light, r unit axis of the lobe
//   n        exponent, at least 0
//
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017, eq. 10.
fn steradian_phong_lobe(l: vec3f, r: vec3f, n: f32) -> f32 {
    return (n + 1.0) * steradian_inverse_two_pi() * steradian_phong_power(dot(l, r), n);
}

// Distribution of half vectors of Blinn-Phong: (n + 2) / (2 pi) h_z^n, normalised over projected solid angle.
//
//   h        unit half vector, shading frame
fn steradian_blinn_phong_distribution(h: vec3f, n: f32) -> f32 {
    return (n + 2.0) * steradian_inverse_two_pi() * steradian_phong_power(h.z, n);
}

// ======== round: disks, ellipses, spheres, ellipsoids, tubes and lines, point and spot lights ========

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

// ======== phong: Phong's lobe over polygons, exactly and by a series ========

// ==== moment ====

// Axial moments of spherical polygons: the integral of max(u.r, 0)^n over a light, for the Phong lobe about r.
//
// With m = n + 1, theta the angle from r and psi the azimuth about r,
//     m * moment = closed integral over the outline of (1 - max(cos theta, 0)^m) dpsi
// for any real n > -1, as long as -r is not inside (docs/theory/moments.md derives it). No parity of n, no solid angle, no
// vertices on the lobe's equator. On an edge, phi is the angle along its great circle from the foot, the point
// nearest to r, where u.r = c; s = sin of the angle from r to the circle's plane; x = u.r = c cos phi and
// y = c sin phi. The edge's share is
//     sign(s) * ( |s| * integral of (1 - x^m)/(1 - x^2) dphi  over the part in front of the lobe's equator
//                 + the azimuth that the part behind sweeps ).
// steradian_moment_edge finds what every method shares; the methods, a file each, integrate the part in front.
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
struct SteradianMomentEdge {
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
fn steradian_moment_log_1_plus(z: f32) -> f32 {
    let near = 0.25;
    // Twice the inverse hyperbolic tangent of t; the next term is t^10 / 11.
    let t = z / (2.0 + z);
    let t2 = t * t;
    let series = 2.0 * t * (1.0 + t2 * (0.333333333333333333 + t2 * (0.2 + t2 * (0.142857142857142857 + t2 * 0.111111111111111111))));
    return select(log(1.0 + z), series, z < near);
}

// 1 - exp(-x) for x >= 0. Error: relative 3e-7 in float, 1e-13 in double.
fn steradian_moment_1_minus_exp(x: f32) -> f32 {
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
fn steradian_moment_angle(w: f32, x0: f32, y0: f32, x1: f32, y1: f32) -> f32 {
    return steradian_trig_atan2_unwrapped(w * (x0 * y1 - x1 * y0), w * w * x0 * x1 + y0 * y1);
}

// -log(1 - s2), from s2 where it is small and from c2 = 1 - s2 where that is. Error: relative 3e-6 in float, 1e-13.
fn steradian_moment_minus_log_cosine2(s2: f32, c2: f32) -> f32 {
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
fn steradian_moment_edge(a: vec3f, b: vec3f, r: vec3f) -> SteradianMomentEdge {
    let pole2 = 1.0e-6;
    var n = cross(a, b - a);  // of a short edge, too, with all its digits
    let n2 = dot(n, n);
    let has_length = n2 > steradian_smallest_divisor();
    n = n * inverseSqrt(max(n2, steradian_smallest_divisor()));
    let s = dot(n, r);
    let q = cross(n, r);
    // The share vanishes with s, like s sqrt(n/2) in the highlight: a floor of 1e-10 would show there.
    let s2 = clamp(s * s, steradian_smallest_divisor(), 1.0);
    let c2 = clamp(dot(q, q), pole2, 1.0);

    var edge: SteradianMomentEdge;
    edge.side = select(0.0, select(1.0, -1.0, s < 0.0), has_length);
    edge.s = s2 * inverseSqrt(s2);
    edge.c = c2 * inverseSqrt(c2);
    edge.log_c = steradian_moment_minus_log_cosine2(s2, c2);
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
        let whole = steradian_moment_angle(edge.s, x0, y0, x1, y1);
        let in_front = steradian_moment_angle(edge.s, edge.x0, edge.y0, edge.x1, edge.y1);
        var swept = select(max(whole - in_front, 0.0), whole, none);
        if (pole) {
            let arc = steradian_trig_atan2(sqrt(n2), dot(a, b));
            swept = select(swept, arc, pole);
        }
        edge.swept = select(0.0, swept, behind0 || behind1 || pole);
    }
    return edge;
}

// The edge's share of m times the moment.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, by any method
fn steradian_moment_edge_share(edge: SteradianMomentEdge, front: f32) -> f32 {
    return edge.side * (front + edge.swept);
}

// Radiance of an energy-normalised Phong lobe of albedo 1 under radiance 1, in [0, 1].
//
//   sum      of the edges' shares
//   reversed true where the light is seen from behind, so that the walk ran the wrong way round
//
// Source: Lecocq et al. 2017, eq. 10: (n + 1)/(2 pi) times the moment; without foreshortening.
fn steradian_moment_phong_radiance(sum: f32, reversed: bool) -> f32 {
    return clamp(select(sum, -sum, reversed) * steradian_inverse_two_pi(), 0.0, 1.0);
}

// ==== moment_quadrature ====

// The Phong lobe's boundary integral by Gauss-Legendre quadrature in the ellipsoid's angle u (moment_series.glsl).
//
// The reference for the methods in constant time: exact up to quadrature, any real n > -1. The library's exact form
// subdivides steradian_moment_quadrature_piece until it converges (source/integrals/phong/exact_moment.cpp); steradian_moment_quadrature_front
// is the fixed rule, 14 nodes for each side of the foot.
// The variable of integration is t = tan(u/2), in [-1, 1] in front: no trigonometry.
// Source: this project (docs/theory/moments.md); nodes: roots of the Legendre polynomial of degree 14.

// The values that the integrand needs from an edge and a lobe.
//   t0, t1   ends of the part in front
struct SteradianMomentQuadrature {
    m: f32,
    s2: f32,
    c2: f32,
    kap: f32,
    w: f32,
    t0: f32,
    t1: f32,
}

// The parameter t = tan(u/2) of the direction (w x, y), x >= 0, whose angle is u.
fn steradian_moment_quadrature_parameter(w: f32, x: f32, y: f32) -> f32 {
    let wx = w * x;
    return clamp(y / max(wx + sqrt(wx * wx + y * y), steradian_smallest_length()), -1.0, 1.0);
}

// Prepares the integrand of one edge for a lobe of exponent n.
fn steradian_moment_quadrature_prepare(edge: SteradianMomentEdge, n: f32) -> SteradianMomentQuadrature {
    var q: SteradianMomentQuadrature;
    q.m = n + 1.0;
    q.s2 = edge.s * edge.s;
    q.c2 = edge.c * edge.c;
    q.kap = sqrt(steradian_moment_1_minus_exp(0.5 * q.m * edge.log_c));
    q.w = edge.s / q.kap;
    q.t0 = steradian_moment_quadrature_parameter(q.w, edge.x0, edge.y0);
    q.t1 = steradian_moment_quadrature_parameter(q.w, edge.x1, edge.y1);
    return q;
}

// Both integrands at t, with du/dt included.
//   moment   |s| (1 - x^m)/(1 - x^2) dphi = kap E du, E = w^2 (1 - x^m)/Q, Q = s^2 cos^2 u + w^2 sin^2 u
//   power    x^m dphi
struct SteradianMomentIntegrands {
    moment: f32,
    power: f32,
}

// The integrands at one t.
fn steradian_moment_quadrature_integrands(q: SteradianMomentQuadrature, t: f32) -> SteradianMomentIntegrands {
    let t2 = t * t;
    let d = 1.0 / (1.0 + t2);
    let cos_u = max((1.0 - t2) * d, 1.0e-15);
    let sin_u = 2.0 * t * d;
    let cos2 = cos_u * cos_u;
    let wsin2 = q.w * q.w * sin_u * sin_u;
    let Q = q.s2 * cos2 + wsin2;
    let exponent = 0.5 * q.m * steradian_moment_log_1_plus(Q / (q.c2 * cos2));  // -log(x^m)
    var result: SteradianMomentIntegrands;
    result.moment = 2.0 * d * q.kap * q.w * q.w * steradian_moment_1_minus_exp(exponent) / Q;
    result.power = 2.0 * d * q.w * exp(-exponent) / (cos2 + wsin2);
    return result;
}

// Adds one pair of nodes at mid - offset and mid + offset.
fn steradian_moment_quadrature_pair(sum: SteradianMomentIntegrands, q: SteradianMomentQuadrature, mid: f32, offset: f32, weight: f32) -> SteradianMomentIntegrands {
    let a = steradian_moment_quadrature_integrands(q, mid - offset);
    let b = steradian_moment_quadrature_integrands(q, mid + offset);
    var next: SteradianMomentIntegrands;
    next.moment = sum.moment + weight * (a.moment + b.moment);
    next.power = sum.power + weight * (a.power + b.power);
    return next;
}

// Both integrals from t = low to t = high.
fn steradian_moment_quadrature_piece(q: SteradianMomentQuadrature, low: f32, high: f32) -> SteradianMomentIntegrands {
    let mid = 0.5 * (low + high);
    let h = 0.5 * (high - low);
    var sum: SteradianMomentIntegrands;
    sum.moment = 0.0;
    sum.power = 0.0;
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.986283808696812339, h * 0.035119460331751863);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.928434883663573517, h * 0.080158087159760210);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.827201315069764993, h * 0.121518570687903185);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.687292904811685470, h * 0.157203167158193535);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.515248636358154092, h * 0.185538397477937814);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.319112368927889760, h * 0.205198463721295604);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.108054948707343662, h * 0.215263853463157790);
    return sum;
}

// Both integrals over the part in front of an edge.
//   moment   |s| times the integral of (1 - x^m)/(1 - x^2) dphi, m = n + 1
//   power    the integral of x^m dphi
//
// Error: see docs/measured/accuracy.md, "phong quadrature".
fn steradian_moment_quadrature_front(edge: SteradianMomentEdge, n: f32) -> SteradianMomentIntegrands {
    let q = steradian_moment_quadrature_prepare(edge, n);
    let to0 = steradian_moment_quadrature_piece(q, 0.0, q.t0);
    let to1 = steradian_moment_quadrature_piece(q, 0.0, q.t1);
    var result: SteradianMomentIntegrands;
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
// Source: this project (docs/theory/moments.md).

// A lobe's series: amplitude of harmonic k is (1 - kap2) times a cubic in kap2, constant first.
struct SteradianMomentSeries {
    m: f32,
    b0: vec4f,
    b1: vec4f,
    b2: vec4f,
    b3: vec4f,
}

// The series of high quality: two harmonics more, each a quintic; low holds its first three coefficients.
struct SteradianMomentSeriesHigh {
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
fn steradian_moment_series_prepare(n: f32) -> SteradianMomentSeries {
    let g = 1.0 / (n + 1.0);
    var series: SteradianMomentSeries;
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
fn steradian_moment_series_high_prepare(n: f32) -> SteradianMomentSeriesHigh {
    let g = 1.0 / (n + 1.0);
    var series: SteradianMomentSeriesHigh;
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
fn steradian_moment_series_cubic(b: vec4f, t: f32) -> f32 {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}

// A harmonic's amplitude over 1 - kap2 in high quality, at t = kap2.
fn steradian_moment_series_quintic(low: vec3f, high: vec3f, t: f32) -> f32 {
    return ((((high.z * t + high.y) * t + high.x) * t + low.z) * t + low.y) * t + low.x;
}

// The part in front in the ellipsoid's own angle.
//   kap, kap2  of the ellipsoid
//   du         angle from end to end [rad]
//   cosine     twice the cosine of 2u at end 0 and end 1
//   sine       the sine of 2u
struct SteradianMomentWarp {
    kap: f32,
    kap2: f32,
    du: f32,
    cosine: vec2f,
    sine: vec2f,
}

// Finds the ellipsoid of one edge for a lobe of exponent m - 1.
fn steradian_moment_warp(edge: SteradianMomentEdge, m: f32) -> SteradianMomentWarp {
    var warp: SteradianMomentWarp;
    warp.kap2 = steradian_moment_1_minus_exp(0.5 * m * edge.log_c);
    let over_kap = inverseSqrt(warp.kap2);
    warp.kap = warp.kap2 * over_kap;
    let w = edge.s * over_kap;
    let wx0 = w * edge.x0;
    let wx1 = w * edge.x1;
    warp.du = steradian_trig_atan2_unwrapped(wx0 * edge.y1 - wx1 * edge.y0, wx0 * wx1 + edge.y0 * edge.y1);
    // One division for both ends: they are at least c^2 w^2, 1e-10 where the pole begins.
    let d0 = wx0 * wx0 + edge.y0 * edge.y0;
    let d1 = wx1 * wx1 + edge.y1 * edge.y1;
    let over_both = 2.0 / max(d0 * d1, steradian_smallest_divisor());
    let scale0 = over_both * d1;
    let scale1 = over_both * d0;
    warp.cosine = vec2f(scale0 * (wx0 * wx0 - edge.y0 * edge.y0), scale1 * (wx1 * wx1 - edge.y1 * edge.y1));
    warp.sine = vec2f(scale0 * wx0 * edge.y0, scale1 * wx1 * edge.y1);
    return warp;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   edge     by steradian_moment_edge
//   series   by steradian_moment_series_prepare, n >= 1
//
// Error: see docs/measured/accuracy.md, "phong series": 3e-4 of the full lobe's 2 pi for each side of the foot.
fn steradian_moment_series_front(edge: SteradianMomentEdge, series: SteradianMomentSeries) -> f32 {
    let warp = steradian_moment_warp(edge, series.m);
    let t = warp.kap2;
    // sin(2(k + 1)u) = 2 cos(2u) sin(2ku) - sin(2(k - 1)u), at both ends.
    let s1 = warp.sine;
    let s2 = vec2f(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    let s3 = vec2f(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    let bump = steradian_moment_series_cubic(series.b0, t) * warp.du
              + steradian_moment_series_cubic(series.b1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_cubic(series.b2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_cubic(series.b3, t) * (s3.y - s3.x) * 0.166666666666666667;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// The result of steradian_moment_series_front, in high quality. Error: about 5e-5 of the full lobe for each side of the foot.
fn steradian_moment_series_high_front(edge: SteradianMomentEdge, series: SteradianMomentSeriesHigh) -> f32 {
    let warp = steradian_moment_warp(edge, series.m);
    let t = warp.kap2;
    let s1 = warp.sine;
    let s2 = vec2f(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    let s3 = vec2f(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    let s4 = vec2f(warp.cosine.x * s3.x - s2.x, warp.cosine.y * s3.y - s2.y);
    let s5 = vec2f(warp.cosine.x * s4.x - s3.x, warp.cosine.y * s4.y - s3.y);
    let bump = steradian_moment_series_quintic(series.low0, series.high0, t) * warp.du
              + steradian_moment_series_quintic(series.low1, series.high1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_quintic(series.low2, series.high2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_quintic(series.low3, series.high3, t) * (s3.y - s3.x) * 0.166666666666666667
              + steradian_moment_series_quintic(series.low4, series.high4, t) * (s4.y - s4.x) * 0.125
              + steradian_moment_series_quintic(series.low5, series.high5, t) * (s5.y - s5.x) * 0.1;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}

// ==== moment_cosine ====

// Powers of the cosine along an edge, the exact double-axis moment, and the Phong series below exponent 1.
//
// The integral of cos^n from the foot is an incomplete beta function. With v^2 = -2 log cos phi it becomes that of
// exp(-(n + 1/2) v^2/2) (1 - v^4/48 ...): an error function and one correction. For n < 8 two steps of the recurrence
// over n lead to where that is close.
// Source: this project (docs/theory/moments.md); the double-axis moment: Arvo 1995, sec. 5.

// The integral of cos^n phi from the foot to the end (x, y) = (c cos phi, c sin phi), |phi| <= pi/2, n >= 4.
//
// Error: relative to the integral up to pi/2, 7e-5 at n = 4, 7e-6 at n = 8, 3e-6 at n = 10, 2e-7 at n = 20.
// Source of the error function: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
fn steradian_moment_cosine_from_foot(x: f32, y: f32, n: f32) -> f32 {
    let a = n + 0.5;
    let v2 = steradian_moment_log_1_plus(y * y / max(x * x, steradian_smallest_divisor()));
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
fn steradian_moment_cosine_front(edge: SteradianMomentEdge, n: f32, low: i32) -> f32 {
    var order = n;
    if (low == 1) {
        order = n + 4.0;
    }
    let cosines = steradian_moment_cosine_from_foot(edge.x1, edge.y1, order) - steradian_moment_cosine_from_foot(edge.x0, edge.y0, order);
    var result = exp(-0.5 * order * edge.log_c) * cosines;
    if (low == 1) {
        // (n + 1) c^2 int x^n = (n + 2) int x^(n+2) - [x^(n+1) y], twice.
        let c2 = edge.c * edge.c;
        let p0 = steradian_phong_power(edge.x0, n + 1.0) * edge.y0;
        let p1 = steradian_phong_power(edge.x1, n + 1.0) * edge.y1;
        result = ((n + 4.0) * result - (p1 * edge.x1 * edge.x1 - p0 * edge.x0 * edge.x0)) / ((n + 3.0) * c2);
        result = ((n + 2.0) * result - (p1 - p0)) / ((n + 1.0) * c2);
    }
    return max(result, 0.0);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, for m = n + 1 below 2.
//
//   n        exponent, in [0, 1)
//   raised   the series of exponent n + 2: (1 - x^m)/(1 - x^2) = (1 - x^(m+2))/(1 - x^2) - x^m
fn steradian_moment_series_low_front(edge: SteradianMomentEdge, raised: SteradianMomentSeries, n: f32) -> f32 {
    return max(steradian_moment_series_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// The result of steradian_moment_series_low_front, in high quality; the error is then that of the cosines.
fn steradian_moment_series_high_low_front(edge: SteradianMomentEdge, raised: SteradianMomentSeriesHigh, n: f32) -> f32 {
    return max(steradian_moment_series_high_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}

// One edge's share of (n + 2) times the double-axis moment, the integral of max(u.r, 0)^n (u.v) over a light.
//
//   a, b     as for steradian_moment_edge, r unit axis of the power, v the other axis, of any length
//   share    steradian_moment_edge_share with exponent n - 1 (m = n), by any method, n >= 1
//   cosines  the integral of x^n dphi over the part in front, by any method
//
// Exact as far as share and cosines are: foreshortening (v the normal) and the v.h of half-vector space need no
// product of lobes.
fn steradian_moment_double_axis_share(a: vec3f, b: vec3f, r: vec3f, v: vec3f, share: f32, cosines: f32) -> f32 {
    let n = cross(a, b);
    let n2 = dot(n, n);
    let inward = dot(n, v) * inverseSqrt(max(n2, steradian_smallest_divisor()));
    return dot(r, v) * share + select(0.0, inward * cosines, n2 > steradian_smallest_divisor());
}

// The two integrands over the part in front of a lobe of exponent n times the light's cosine, by quadrature: share's and cosines'.
//
//   level  1 where n is 0, the same for every lane: the integral of x^0 is the angle, and (1 - x^0)/(1 - x^2) is 0
fn steradian_moment_foreshortened_front(edge: SteradianMomentEdge, n: f32, level: i32) -> SteradianMomentIntegrands {
    var front: SteradianMomentIntegrands;
    front.moment = 0.0;
    front.power = 0.0;
    if (level > 0) {
        front.power = steradian_trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    } else {
        front = steradian_moment_quadrature_front(edge, n - 1.0);
    }
    return front;
}

// One edge's share of (n + 2) times the moment of a lobe times the light's cosine: z is the normal.
//
//   front    |s| times the integral of (1 - x^m)/(1 - x^2) with exponent n - 1, by any method
//   cosines  the integral of x^n dphi over the part in front, by any method
fn steradian_moment_foreshortened_share(edge: SteradianMomentEdge, a: vec3f, b: vec3f, r: vec3f, front: f32, cosines: f32) -> f32 {
    return steradian_moment_double_axis_share(a, b, r, vec3f(0.0, 0.0, 1.0), steradian_moment_edge_share(edge, front), cosines);
}

// ======== ltc: linearly transformed cosines over polygons, textured ones too ========

// ==== ltc ====

// Linearly transformed cosines: area lights on glossy surfaces by a table look-up and a polygon integral.
//
// A lobe is a clamped cosine under a linear map M. The integral of the lobe over a light is the cosine's integral over
// the light under M^-1. Shading frame: z the surface normal, x along the view's projection, so that the unit view
// is (s, 0, c). The caller fetches table values at steradian_ltc_coordinates and passes them in. See docs/theory/ltc.md.
// Source: Heitz, Dupuy, Hill, Neubelt, "Real-time polygonal-light shading with linearly transformed cosines", 2016.

// The inverse matrix M^-1 of a linearly transformed cosine, up to a positive factor: rows (xx, 0, xz), (0, yy, 0), (zx, 0, zz); its
// determinant is positive.
struct SteradianLtcMatrix {
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
fn steradian_ltc_coordinates(roughness: f32, n_dot_v: f32) -> vec2f {
    return vec2f(clamp(roughness, 0.0, 1.0), sqrt(clamp(1.0 - n_dot_v, 0.0, 1.0)));
}

// The matrix as the literature's texture stores it.
//
//   t        M^-1 divided by its middle element: column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2
fn steradian_ltc_from_classic(t: vec4f) -> SteradianLtcMatrix {
    var m: SteradianLtcMatrix;
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
fn steradian_ltc_from_compact(e: vec4f, alpha: f32, view: vec3f) -> SteradianLtcMatrix {
    let tilt = alpha * e.z;
    let shear = alpha * e.w;
    let width = alpha * e.x;
    var m: SteradianLtcMatrix;
    m.xx = view.z + tilt * view.x;
    m.xz = view.x - tilt * view.z;
    m.yy = (e.x - tilt * e.w) / e.y;
    m.zx = -(shear * view.z + width * view.x);
    m.zz = width * view.z - shear * view.x;
    return m;
}

// The vector M^-1 v, up to the matrix' factor, for any vector v of the shading frame.
fn steradian_ltc_transform(m: SteradianLtcMatrix, v: vec3f) -> vec3f {
    return vec3f(m.xx * v.x + m.xz * v.z, m.yy * v.y, m.zx * v.x + m.zz * v.z);
}

// The transpose of M^-1 times a vector.
fn steradian_ltc_transform_transposed(m: SteradianLtcMatrix, v: vec3f) -> vec3f {
    return vec3f(m.xx * v.x + m.zx * v.z, m.yy * v.y, m.xz * v.x + m.zz * v.z);
}

// The lobe's density per solid angle at the unit direction l: |M^-1| max(w_z, 0) / (pi |w|^4) with w = M^-1 l.
fn steradian_ltc_lobe(m: SteradianLtcMatrix, l: vec3f) -> f32 {
    let w = steradian_ltc_transform(m, l);
    let d2 = max(dot(w, w), steradian_smallest_length());
    let determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    return determinant * max(w.z, 0.0) * steradian_inverse_pi() / (d2 * d2);
}

// How fast the lobe changes about the direction l: the inverse of the angle over which M^-1 l may change by its own length.
fn steradian_ltc_sharpness(m: SteradianLtcMatrix, l: vec3f) -> f32 {
    let w = steradian_ltc_transform(m, l);
    let size2 = m.xx * m.xx + m.xz * m.xz + m.yy * m.yy + m.zx * m.zx + m.zz * m.zz;
    return sqrt(size2 * dot(l, l) / max(dot(w, w), steradian_smallest_square()));
}

// The lobe's share above the real horizon, in [0, 1]; tables hold magnitudes divided by it.
//
// Under M^-1 the sky becomes a half space, which shares a lune with the cosine's: (1 + cosine of their angle) / 2.
fn steradian_ltc_energy_above_horizon(m: SteradianLtcMatrix) -> f32 {
    return 0.5 + 0.5 * m.xx * inverseSqrt(max(m.xx * m.xx + m.zx * m.zx, steradian_smallest_square()));
}

// The state of a walk along a light's outline under M^-1.
//   lobe      what the clipped edges add up to
//   anchor    where the outline first crossed the real horizon, under M^-1
//   anchored  whether it did
struct SteradianLtcWalk {
    lobe: SteradianPolygonWalk,
    anchor: vec3f,
    anchored: bool,
}

// A walk with no edge yet.
fn steradian_ltc_begin() -> SteradianLtcWalk {
    var walk: SteradianLtcWalk;
    walk.lobe = steradian_polygon_begin();
    walk.anchor = vec3f(0.0, 0.0, 0.0);
    walk.anchored = steradian_mask_none();
    return walk;
}

// Unit direction of a vertex under M^-1.
//
//   v        vertex or direction in the shading frame
fn steradian_ltc_direction(m: SteradianLtcMatrix, v: vec3f) -> vec3f {
    return steradian_polygon_direction(steradian_ltc_transform(m, v));
}

// The part of an edge above the real horizon, under M^-1.
//
//   a, b     ends in the shading frame, in walk order: steradian_polygon_direction of the vertices
//   ta, tb   steradian_ltc_direction(m, a) and steradian_ltc_direction(m, b): a vertex is transformed once for its two edges
//   returns  its ends are unit directions under M^-1, and its weights are those of ta and tb
//
// Degenerate: an edge below the horizon has ends of 0.
fn steradian_ltc_part(m: SteradianLtcMatrix, a: vec3f, b: vec3f, ta: vec3f, tb: vec3f) -> SteradianEdgePart {
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    var part = steradian_edge_whole(ta, tb);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (a_below || b_below) {
        let wa = abs(b.z);
        let wb = abs(a.z);
        let horizon = vec3f(a.x * wa + b.x * wb, a.y * wa + b.y * wb, 0.0);
        let under = steradian_ltc_transform(m, horizon);
        let crossing = select(vec3f(0.0, 0.0, 0.0), steradian_polygon_direction(under), part.rises || part.sinks);
        part.start = select(ta, crossing, a_below);
        part.end = select(tb, crossing, b_below);
        let under_a = steradian_ltc_transform(m, a);
        let under_b = steradian_ltc_transform(m, b);
        let scale = inverseSqrt(max(dot(under, under), steradian_smallest_square()));
        let of_a = wa * sqrt(dot(under_a, under_a)) * scale;
        let of_b = wb * sqrt(dot(under_b, under_b)) * scale;
        part.start_a = select(1.0, of_a, a_below);
        part.start_b = select(0.0, of_b, a_below);
        part.end_a = select(0.0, of_a, b_below);
        part.end_b = select(1.0, of_b, b_below);
    }
    return part;
}

// Closes the gaps that a part's ends leave along the real horizon.
//
// They go from each crossing down to the next crossing up. They lie on one line of the light's plane, so that the way from one to the
// other may go by any point of that line: a crossing down adds the edge to the first crossing of the walk, a crossing up the edge from
// it, in whatever order they come.
//
//   part     of steradian_ltc_part
fn steradian_ltc_close_gap(walk: SteradianLtcWalk, part: SteradianEdgePart) -> SteradianLtcWalk {
    var next = walk;
    let crosses = part.rises || part.sinks;
    if (crosses) {
        let none = vec3f(0.0, 0.0, 0.0);
        let crossing = select(part.end, part.start, part.rises);
        // The first crossing is its own anchor: an edge of no length.
        let closes = crosses && walk.anchored;
        if (closes) {
            let departure = select(crossing, walk.anchor, part.rises);
            let arrival = select(walk.anchor, crossing, part.rises);
            next.lobe = steradian_polygon_add_edge(next.lobe, select(none, departure, closes), select(none, arrival, closes));
        }
        next.anchor = select(walk.anchor, crossing, crosses && !walk.anchored);
        next.anchored = walk.anchored || crosses;
    }
    return next;
}

// Adds one edge, clipped to the real horizon, then to the lobe's. Arguments: steradian_ltc_part.
//
// Degenerate: an edge below the real horizon adds nothing, exactly: a light below it gives 0.
fn steradian_ltc_add_edge(walk: SteradianLtcWalk, m: SteradianLtcMatrix, a: vec3f, b: vec3f, ta: vec3f, tb: vec3f) -> SteradianLtcWalk {
    var next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        let part = steradian_ltc_part(m, a, b, ta, tb);
        next = steradian_ltc_close_gap(walk, part);
        next.lobe = steradian_polygon_add_edge(next.lobe, part.start, part.end);
    }
    return next;
}

// Integral of the lobe over the part of the light above the real horizon, in [0, 1].
//
//   reversed true where the light is seen from behind
fn steradian_ltc_integral(walk: SteradianLtcWalk, reversed: bool) -> f32 {
    return steradian_polygon_irradiance(walk.lobe, reversed) * steradian_inverse_pi();
}

// The factor of the lobe's integral: Schlick's Fresnel averaged over the lobe.
//
//   n_a      magnitude of the lobe without Fresnel
//   f_a      of the lobe times (1 - v.h)^5
fn steradian_ltc_specular_scale(f0: f32, f90: f32, n_a: f32, f_a: f32) -> f32 {
    return f0 * n_a + (f90 - f0) * f_a;
}

// The specular radiance where the lobe times (1 - v.h)^5 has a matrix of its own (table of fit --fresnel-lobe).
//
//   integral, grazing  steradian_ltc_integral with the lobe's and with the Fresnel lobe's matrix
fn steradian_ltc_specular_with_fresnel_lobe(f0: f32, f90: f32, n_a: f32, integral: f32, f_a: f32, grazing: f32) -> f32 {
    return f0 * n_a * integral + (f90 - f0) * f_a * grazing;
}

// Factor on the specular radiance that returns what single scattering loses between the facets.
//
//   f0       reflectance along the normal
//   albedo   of the lobe with F = 1: n_a times steradian_ltc_energy_above_horizon, in (0, 1]
//
// Source: Turquin, "Practical multiple scattering compensation for microfacet models", 2019, eq. 16.
fn steradian_ltc_multiple_scattering(f0: f32, albedo: f32) -> f32 {
    let a = clamp(albedo, 1.0e-2, 1.0);
    return 1.0 + f0 * (1.0 - a) / a;
}

// A surface under a clear coat of glTF: the coat reflects its share and dims what lies below.
//
//   base       radiance of the surface below
//   coat       radiance of the coat's lobe with its own Fresnel (f0 0.04) in it
//   clearcoat  strength in [0, 1]
//   n_dot_v    cosine of the view to the coat's normal
fn steradian_ltc_clear_coat(base: f32, coat: f32, clearcoat: f32, n_dot_v: f32) -> f32 {
    let f = steradian_fresnel_schlick(0.04, 1.0, n_dot_v);
    return base * (1.0 - clearcoat * f) + clearcoat * coat;
}

// A surface under sheen of glTF: what the cloth's fibres reflect does not reach what lies below.
//
//   base      radiance of the surface below
//   sheen     radiance of the sheen lobe, its colour included
//   strongest largest component of the sheen's colour
//   albedo    of the sheen lobe at this view: n_a times steradian_ltc_energy_above_horizon
fn steradian_ltc_sheen(base: f32, sheen: f32, strongest: f32, albedo: f32) -> f32 {
    return base * clamp(1.0 - strongest * albedo, 0.0, 1.0) + sheen;
}

// ==== ltc_texture ====

// Textured lights: where on a light a lobe looks, and how widely.
//
// The mean of a texture over a light, weighted with the lobe, is read from blurred copies of the texture: around the
// point where the irradiance vector of the light under M^-1, brought back by M, meets the light's plane. The footprint is a
// cone of directions about that vector in the cosine's space, cut by the plane: an ellipse. Its radii are those of a thin
// cone, per radian; the caller multiplies them by the widths of docs/theory/ltc.md, "Textured lights":
//
//   SteradianLtcTextureFootprint f = steradian_ltc_texture_footprint(m, phi, normal, height);            // once
//   SteradianLtcTextureEllipse e = steradian_ltc_texture_axes(...f.axis_a..., ...f.axis_b...);       // in the plane's coordinates
//   SteradianLtcTextureEllipse g = steradian_ltc_texture_gaussian(e, width, widest);                 // for each Gaussian of the lobe's mixture
//   vec2 at = centroid + steradian_ltc_texture_place(g, hit - centroid, slope, light);   // where to read the copy blurred by g
//
// A diffuse surface passes the identity for M^-1 (steradian_ltc_texture_diffuse).
// Source of the idea: Heitz, Hill, "Real-time polygonal-light shading with linearly transformed cosines", 2016.

// An ellipse on the light's plane, in the shading frame.
//   center   relative to the shading point
//   axis_a, axis_b  conjugate radii, per radian of the cone's half angle
//   valid    false where the light sends nothing
struct SteradianLtcTextureFootprint {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
    valid: bool,
}

// The vector M w, up to a positive factor: the inverse of steradian_ltc_transform.
fn steradian_ltc_texture_transform_back(m: SteradianLtcMatrix, w: vec3f) -> vec3f {
    let determinant = m.xx * m.zz - m.xz * m.zx;
    return vec3f(m.zz * w.x - m.xz * w.z, w.y * (determinant / m.yy), m.xx * w.z - m.zx * w.x);
}

// The matrix of a diffuse lobe: none.
fn steradian_ltc_texture_diffuse() -> SteradianLtcMatrix {
    var m: SteradianLtcMatrix;
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
fn steradian_ltc_texture_irradiance_vector(walk: SteradianLtcWalk, reversed: bool) -> vec3f {
    return steradian_polygon_irradiance_vector(walk.lobe, reversed);
}

// The footprint of a lobe on a light's plane.
//
//   m        M^-1
//   phi      irradiance vector of the light under M^-1 (steradian_ltc_texture_irradiance_vector)
//   normal   unit normal of the light's plane, in the shading frame, either sign
//   height   dot(normal, any point of the plane relative to the shading point)
//
// A direction w turned by a small angle e across itself meets the plane at M w t + e (M c - M w (n.Mc)/(n.Mw)) t.
//
// Degenerate: a light that sends nothing, or a vector along the plane, has a footprint of size 0 that is not valid.
// Error: docs/theory/ltc.md, "Textured lights".
fn steradian_ltc_texture_footprint(m: SteradianLtcMatrix, phi: vec3f, normal: vec3f, height: f32) -> SteradianLtcTextureFootprint {
    let p2 = dot(phi, phi);
    let lit = p2 > steradian_smallest_divisor();
    let w = select(vec3f(0.0, 0.0, 1.0), phi * inverseSqrt(max(p2, steradian_smallest_divisor())), lit);
    let across = steradian_frame_from_normal(w);
    let l = steradian_ltc_texture_transform_back(m, w);
    let along = dot(normal, l);
    let meets = lit && along * height > 0.0;
    let inverse = select(0.0, 1.0 / select(1.0, along, meets), meets);
    let t = height * inverse;
    let a = steradian_ltc_texture_transform_back(m, steradian_transform(across, vec3f(1.0, 0.0, 0.0)));
    let b = steradian_ltc_texture_transform_back(m, steradian_transform(across, vec3f(0.0, 1.0, 0.0)));
    var f: SteradianLtcTextureFootprint;
    f.center = l * t;
    f.axis_a = (a - l * (dot(normal, a) * inverse)) * t;
    f.axis_b = (b - l * (dot(normal, b) * inverse)) * t;
    f.valid = meets;
    return f;
}

// An ellipse on the light's plane: its long half axis, and the length of the short one.
struct SteradianLtcTextureEllipse {
    major: vec2f,
    minor: f32,
}

// Principal axes of the ellipse of two conjugate radii.
//
//   a, b     in the plane's own coordinates [m]
//
// Degenerate: a circle has any major axis.
fn steradian_ltc_texture_axes(a: vec2f, b: vec2f) -> SteradianLtcTextureEllipse {
    let xx = a.x * a.x + b.x * b.x;
    let yy = a.y * a.y + b.y * b.y;
    let xy2 = a.x * a.y + b.x * b.y;
    let half_difference = 0.5 * (xx - yy);
    let spread = sqrt(half_difference * half_difference + xy2 * xy2);
    // An eigenvector of the larger eigenvalue, from the row that does not cancel.
    let v = select(vec2f(xy2, spread - half_difference), vec2f(half_difference + spread, xy2), half_difference > 0.0);
    let v2 = dot(v, v);
    let direction = select(vec2f(1.0, 0.0), v * inverseSqrt(max(v2, steradian_smallest_square())), v2 > steradian_smallest_square());
    let longest = sqrt(0.5 * (xx + yy) + spread);
    var e: SteradianLtcTextureEllipse;
    e.major = direction * longest;
    e.minor = abs(a.x * b.y - a.y * b.x) / max(longest, steradian_smallest_length());
    return e;
}

// A Gaussian's standard deviations: the ellipse times a width, neither above `widest`.
fn steradian_ltc_texture_gaussian(e: SteradianLtcTextureEllipse, width: f32, widest: f32) -> SteradianLtcTextureEllipse {
    let longest = width * sqrt(dot(e.major, e.major));
    var g: SteradianLtcTextureEllipse;
    g.major = e.major * (width * (widest / max(longest, widest)));
    g.minor = min(width * e.minor, widest);
    return g;
}

// The place at which a Gaussian must stand for the light under it to have the centroid that it has under the lobe.
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
fn steradian_ltc_texture_place(g: SteradianLtcTextureEllipse, aside: vec2f, slope: vec2f, light: vec3f) -> vec2f {
    let major2 = dot(g.major, g.major);
    let minor2 = g.minor * g.minor;
    let u = g.major * inverseSqrt(max(major2, steradian_smallest_square()));
    let along = major2 - minor2;
    let sxx = minor2 + along * u.x * u.x;
    let sxy = along * u.x * u.y;
    let syy = minor2 + along * u.y * u.y;
    let least = 1.0e-6 * (light.x + light.z) + steradian_smallest_divisor();
    let vxx = light.x + least;
    let vyy = light.z + least;
    // (V^-1 + S^-1)^-1 slope = S (V + S)^-1 V slope
    let txx = vxx + sxx;
    let txy = light.y + sxy;
    let tyy = vyy + syy;
    let t_inverse = 1.0 / max(txx * tyy - txy * txy, steradian_smallest_square());
    var p = vec2f(vxx * slope.x + light.y * slope.y, light.y * slope.x + vyy * slope.y);
    p = vec2f(tyy * p.x - txy * p.y, txx * p.y - txy * p.x) * t_inverse;
    p = vec2f(sxx * p.x + sxy * p.y, sxy * p.x + syy * p.y);
    // The maximum of exp(-x^2 / 2) (1 + q^(1/2) x), over its first order.
    let q = max(dot(slope, p), 0.0);
    let share = 2.0 / (1.0 + sqrt(1.0 + 4.0 * q));
    let d = aside + p * share;
    let v_inverse = 1.0 / max(vxx * vyy - light.y * light.y, steradian_smallest_square());
    let e = vec2f(vyy * d.x - light.y * d.y, vxx * d.y - light.y * d.x) * v_inverse;
    let push = vec2f(sxx * e.x + sxy * e.y, sxy * e.x + syy * e.y);
    let pushed2 = max(dot(push, e), 0.0);
    return d + push * (2.5 * inverseSqrt(max(pushed2, 6.25)));
}

// ======== ltc_tables: the tables of linearly transformed cosines, 4 KB each, and how they are read ========

var<private> steradian_ltc_ggx_shape_words: array<u32, 512> = array<u32, 512>(
    0x40004000u, 0x14cf0182u, 0x40014000u, 0xa0378318u, 0x40003fffu, 0xa1200dc5u, 0x40024001u, 0x26159618u,
    0x40054006u, 0x21a19280u, 0x40074008u, 0x1c078e1cu, 0x40024002u, 0x24c8983au, 0x3fe93fedu, 0x21251653u,
    0x3fb63fc4u, 0x96d81bd5u, 0x3f6b3f7cu, 0x9e741d86u, 0x3f093f18u, 0x9b491c84u, 0x3e933ea0u, 0x98211b85u,
    0x3e113e1bu, 0x9ce81b2fu, 0x3d893d91u, 0x96951870u, 0x3d063d0bu, 0x89521396u, 0x3c863c8au, 0x1412141du,
    0x3ff84000u, 0x9ab08009u, 0x3ff94000u, 0x9fe00088u, 0x3ff73fffu, 0x131906cbu, 0x3ffb4002u, 0x97ec90fcu,
    0x40014007u, 0xa57212d5u, 0x40024007u, 0xa96b1594u, 0x3ffe4000u, 0xa8c21b9cu, 0x3fe13fe9u, 0xac1521feu,
    0x3faf3fbdu, 0xad7d25feu, 0x3f653f75u, 0xaf302924u, 0x3f033f12u, 0xafbf2b19u, 0x3e923e9du, 0xb0012c80u,
    0x3e113e17u, 0xb0002d43u, 0x3d8c3d90u, 0xafc22db8u, 0x3d093d0au, 0xaf5a2e0eu, 0x3c8b3c8cu, 0xaed42e18u,
    0x3fdd4000u, 0x0c5a0039u, 0x3fdd4000u, 0xa1ce009du, 0x3fdc3fffu, 0x9cbd0c5cu, 0x3fde4001u, 0x9eed90a7u,
    0x3fe64006u, 0xab0716acu, 0x3fe94005u, 0xaca71af7u, 0x3fe33ffcu, 0xad4d2100u, 0x3fc93fe0u, 0xb014260bu,
    0x3f993fb1u, 0xb19e29ebu, 0x3f513f68u, 0xb2f82ce8u, 0x3ef53f06u, 0xb3952eddu, 0x3e883e90u, 0xb3f0306au,
    0x3e0f3e0fu, 0xb3ef3131u, 0x3d923d8cu, 0xb3bf31c0u, 0x3d143d08u, 0xb3553204u, 0x3c9c3c8du, 0xb2e6321du,
    0x3fb04000u, 0xa8e6000du, 0x3fb04000u, 0xa49c0524u, 0x3faf3fffu, 0xa53910d6u, 0x3fb14001u, 0xa7401516u,
    0x3fb84005u, 0xab281b1eu, 0x3fbc4004u, 0xae921fd0u, 0x3fb63ff7u, 0xb027244fu, 0x3f9e3fd6u, 0xb22128f1u,
    0x3f723fa1u, 0xb4322c8bu, 0x3f303f54u, 0xb5222f6eu, 0x3edc3ef2u, 0xb5bc3135u, 0x3e7b3e80u, 0xb5f732a8u,
    0x3e103e02u, 0xb5ef33cdu, 0x3d9e3d83u, 0xb5d23456u, 0x3d2b3d04u, 0xb5903493u, 0x3cba3c90u, 0xb54834abu,
    0x3f704000u, 0xa9a501bfu, 0x3f704000u, 0xa60c06c2u, 0x3f6f3fffu, 0xab251535u, 0x3f724001u, 0xac831c02u,
    0x3f774006u, 0xae751efbu, 0x3f7a4003u, 0xb065230eu, 0x3f763ff2u, 0xb1fc273du, 0x3f623fcau, 0xb4422b42u,
    0x3f3c3f8eu, 0xb5b62e83u, 0x3f033f3bu, 0xb6ec3125u, 0x3ebc3ed7u, 0xb7a8332au, 0x3e6b3e69u, 0xb8023487u,
    0x3e103df0u, 0xb806354eu, 0x3db03d79u, 0xb7e335e2u, 0x3d4a3d01u, 0xb7a1363bu, 0x3ce63c93u, 0xb740365du,
    0x3f1e4000u, 0xaf7e871bu, 0x3f1e4000u, 0xb0661220u, 0x3f1d3fffu, 0xb00319e3u, 0x3f214002u, 0xb0531f29u,
    0x3f254004u, 0xb18e22e4u, 0x3f284002u, 0xb2f32655u, 0x3f253fe9u, 0xb46c29e6u, 0x3f133fbbu, 0xb5ac2d4fu,
    0x3ef73f75u, 0xb7443072u, 0x3ecd3f1du, 0xb86b32d7u, 0x3e963eb6u, 0xb8dd34abu, 0x3e593e4au, 0xb91435d7u,
    0x3e143ddbu, 0xb91c36ceu, 0x3dc93d6bu, 0xb90d378du, 0x3d793cffu, 0xb8e23802u, 0x3d243c98u, 0xb8bb3820u,
    0x3eba4000u, 0xb23902efu, 0x3eba4000u, 0xafa1106bu, 0x3eb93fffu, 0xb28a1cf2u, 0x3ebc4002u, 0xb3ed22bau,
    0x3ec24003u, 0xb4832609u, 0x3ec63ffbu, 0xb5502947u, 0x3ec33fdcu, 0xb63c2c92u, 0x3eb93fa8u, 0xb7732f8du,
    0x3ea53f59u, 0xb8963206u, 0x3e8d3ef8u, 0xb970346eu, 0x3e6d3e8eu, 0xb9fb35ecu, 0x3e463e26u, 0xba323749u,
    0x3e1d3dbfu, 0xba453838u, 0x3dec3d5bu, 0xba3c38adu, 0x3db43cfau, 0xba2238fcu, 0x3d763c9cu, 0xb9ec3929u,
    0x3e444000u, 0xb4798915u, 0x3e444000u, 0xb47915feu, 0x3e433fffu, 0xb58e206au, 0x3e474003u, 0xb66a2576u,
    0x3e4d4001u, 0xb6a628deu, 0x3e513ff3u, 0xb76d2c1eu, 0x3e543fccu, 0xb82c2ebfu, 0x3e513f8fu, 0xb8c73154u,
    0x3e4e3f37u, 0xb9a03402u, 0x3e4a3ecbu, 0xba9335aeu, 0x3e423e5fu, 0xbb2f3764u, 0x3e393dfcu, 0xbb6d3877u,
    0x3e2e3d9fu, 0xbb893924u, 0x3e1c3d44u, 0xbb8b39acu, 0x3e063cf3u, 0xbb833a1bu, 0x3dea3ca5u, 0xbb643a63u,
    0x3dbb4000u, 0xb62782c5u, 0x3dbb4000u, 0xb67b1713u, 0x3dbb3fffu, 0xb8882327u, 0x3dbf4001u, 0xb8912821u,
    0x3dc44000u, 0xb8bc2b4du, 0x3dcb3feau, 0xb90a2e1cu, 0x3dd33fbbu, 0xb98130edu, 0x3ddd3f74u, 0xba1a336bu,
    0x3dee3f11u, 0xbada3551u, 0x3e053e9au, 0xbbd23735u, 0x3e1b3e27u, 0xbc3d388fu, 0x3e313dc9u, 0xbc64396du,
    0x3e493d75u, 0xbc7b3a2fu, 0x3e5f3d2cu, 0xbc863ad5u, 0x3e743ce8u, 0xbc903b60u, 0x3e813cb2u, 0xbc913bd0u,
    0x3d204000u, 0xb8f58b5du, 0x3d214000u, 0xb92c1a85u, 0x3d203fffu, 0xb9af249du, 0x3d224001u, 0xba672996u,
    0x3d293ff7u, 0xba6b2d3cu, 0x3d323fddu, 0xbb083067u, 0x3d453fa2u, 0xbb6a3308u, 0x3d633f50u, 0xbbce3521u,
    0x3d8b3ee3u, 0xbc323700u, 0x3dc13e60u, 0xbca73892u, 0x3dfa3de8u, 0xbcfb399au, 0x3e353d8eu, 0xbd253a8cu,
    0x3e753d43u, 0xbd4b3b68u, 0x3ebe3d0au, 0xbd6d3c1au, 0x3f063cdbu, 0xbd893c74u, 0x3f5c3cbdu, 0xbdb43cd0u,
    0x3c734000u, 0xbb21902fu, 0x3c734000u, 0xbbdd1d0au, 0x3c733ffeu, 0xbc7a273au, 0x3c7d3ff9u, 0xbc762c4fu,
    0x3c853fe9u, 0xbc792fffu, 0x3c933fc1u, 0xbcb83271u, 0x3cb33f74u, 0xbd10350bu, 0x3ce73f1cu, 0xbd12370fu,
    0x3d2d3ea6u, 0xbd3638a5u, 0x3d873e1eu, 0xbd8339cbu, 0x3de63d9eu, 0xbdd73ae2u, 0x3e4c3d44u, 0xbe0c3beau,
    0x3ebf3d07u, 0xbe3f3c71u, 0x3f413cdfu, 0xbe813cefu, 0x3fde3ccbu, 0xbece3d70u, 0x40483cceu, 0xbf353dfeu,
    0x3b6b4000u, 0xbe8e9275u, 0x3b6a4000u, 0xbe062031u, 0x3b6e3ffeu, 0xbe6329b6u, 0x3b813ff5u, 0xbe642e8bu,
    0x3baf3fd2u, 0xbe2a320cu, 0x3be53f9bu, 0xbe4f34c9u, 0x3c1f3f32u, 0xbea93738u, 0x3c733ecdu, 0xbe9538e2u,
    0x3cdd3e5bu, 0xbe763a2cu, 0x3d5b3dc7u, 0xbea53b60u, 0x3dea3d42u, 0xbee23c3fu, 0x3e813cebu, 0xbf243cceu,
    0x3f323cbau, 0xbf733d5fu, 0x40033ca7u, 0xbfe63dfcu, 0x40883cb0u, 0xc03c3eb4u, 0x41423ce9u, 0xc0bb3fb3u,
    0x39bf4000u, 0xbbbf9592u, 0x39c04000u, 0xc0842123u, 0x39b93fffu, 0xc0422a49u, 0x39d33fd4u, 0xc07c3078u,
    0x3a353fb9u, 0xc032349bu, 0x3a953f66u, 0xc03d3743u, 0x3b333edbu, 0xc04b3946u, 0x3c113e6bu, 0xc0453adcu,
    0x3ca63df1u, 0xc0103c23u, 0x3d523d55u, 0xc00f3cbfu, 0x3e0f3cceu, 0xc01e3d4du, 0x3ee93c72u, 0xc0463de8u,
    0x3feb3c54u, 0xc0843e90u, 0x409c3c54u, 0xc0e93f6fu, 0x41853c8bu, 0xc187404fu, 0x42e43d04u, 0xc2814132u,
    0x380f4001u, 0xc55e9c43u, 0x38103ffbu, 0xc4272774u, 0x38203ffbu, 0xc28e30b3u, 0x38254006u, 0xc1fd343bu,
    0x387f3f7bu, 0xc22b3789u, 0x399b3f0cu, 0xc1d039f4u, 0x3a7c3e66u, 0xc1b83bf6u, 0x3ba03db3u, 0xc1ae3cefu,
    0x3ca93d43u, 0xc1423dacu, 0x3d8b3cabu, 0xc1113e3du, 0x3e863c23u, 0xc10c3ec2u, 0x3fb03b9au, 0xc13d3f68u,
    0x409b3b67u, 0xc1b64033u, 0x41a23bc3u, 0xc26e40c5u, 0x43263c42u, 0xc36d41aau, 0x45113d55u, 0xc507439du,
    0x33b93ffdu, 0x453495aau, 0x33b34005u, 0xc42b1bc9u, 0x335a400eu, 0xc44aab3fu, 0x342d3eeeu, 0xc54434f1u,
    0x352c3f42u, 0xc4a23b59u, 0x38623eb2u, 0xc4523d32u, 0x3ab53d7cu, 0xc3fb3e9cu, 0x3bfa3d06u, 0xc3563f56u,
    0x3d1b3c70u, 0xc2b63ff0u, 0x3e373ba5u, 0xc26c4029u, 0x3f763a56u, 0xc266406au, 0x409a39b6u, 0xc2b840d8u,
    0x41c339cfu, 0xc37d4161u, 0x439b39fcu, 0xc48242a4u, 0x45a63b52u, 0xc63c4484u, 0x48a63d3cu, 0xc8a646e8u,
    0x24d34002u, 0xd40ca6b9u, 0x25843fe4u, 0xccf33393u, 0x2a973eb4u, 0xcca43c45u, 0x31f940f9u, 0xc9204052u,
    0x35774002u, 0xc8424158u, 0x3ad93d1du, 0xc6e641d6u, 0x3c9b3ca3u, 0xc59641bbu, 0x3d4d3a86u, 0xc52b41d7u,
    0x3eba38f7u, 0xc4c041ddu, 0x4021364au, 0xc48e41fau, 0x411c343bu, 0xc4934245u, 0x4293330du, 0xc4ff42eeu,
    0x447d30f6u, 0xc623443cu, 0x468832f2u, 0xc8024552u, 0x491a3635u, 0xc9994777u, 0x4bc03c5au, 0xcbd848d8u);

var<private> steradian_ltc_ggx_magnitude_words: array<u32, 484> = array<u32, 484>(
    0x00003c00u, 0x00003c00u, 0x00013c00u, 0x00063bffu, 0x00113bfdu, 0x00283bf9u, 0x004e3bf1u, 0x00863be3u,
    0x00d13bcbu, 0x012c3ba8u, 0x01923b75u, 0x01fc3b30u, 0x025f3ad8u, 0x02b33a6du, 0x02f139f2u, 0x0313396du,
    0x031a38e1u, 0x03093855u, 0x02e3379bu, 0x02ae369eu, 0x027135b6u, 0x023134e7u, 0x00003c00u, 0x00003c00u,
    0x00013c00u, 0x00063bffu, 0x00123bfdu, 0x002c3bf9u, 0x00563bf1u, 0x00943be3u, 0x00e53bcbu, 0x01493ba8u,
    0x01b83b75u, 0x022b3b30u, 0x02963ad8u, 0x02ef3a6du, 0x032e39f2u, 0x0350396cu, 0x035438e1u, 0x033d3855u,
    0x0312379cu, 0x02d8369fu, 0x029535b8u, 0x024f34e9u, 0x00003c00u, 0x00003c00u, 0x00023c00u, 0x00073bffu,
    0x00183bfdu, 0x003a3bf9u, 0x00713bf1u, 0x00c43be3u, 0x012f3bcbu, 0x01b13ba8u, 0x02403b75u, 0x02d13b2fu,
    0x03543ad7u, 0x03bc3a6cu, 0x040039f1u, 0x041f396cu, 0x041738e1u, 0x03f03856u, 0x03b237a0u, 0x036336a4u,
    0x030d35bdu, 0x02b534efu, 0x00003c00u, 0x00003c00u, 0x00023c00u, 0x000a3bffu, 0x00233bfdu, 0x00573bf9u,
    0x00ab3bf1u, 0x01263be3u, 0x01c43bcbu, 0x02833ba7u, 0x03503b74u, 0x04193b2eu, 0x04c63ad5u, 0x05473a6au,
    0x059039f0u, 0x05a3396bu, 0x058238e2u, 0x053a3858u, 0x04d537a5u, 0x046036abu, 0x03e535c5u, 0x036d34f8u,
    0x00013c00u, 0x00003c00u, 0x00043c00u, 0x00133bffu, 0x00393bfdu, 0x00923bf9u, 0x011a3bf1u, 0x01de3be3u,
    0x02dd3bcbu, 0x04073ba7u, 0x053d3b73u, 0x06613b2du, 0x074e3ad3u, 0x07ee3a68u, 0x081b39eeu, 0x0815396bu,
    0x07d738e2u, 0x0751385au, 0x06aa37acu, 0x05f436b5u, 0x053c35d1u, 0x048d3505u, 0x00083c00u, 0x00063c00u,
    0x000e3c00u, 0x00283bffu, 0x006f3bfdu, 0x01073bf9u, 0x01f23bf1u, 0x03413be3u, 0x04e73bcbu, 0x06c53ba6u,
    0x08543b72u, 0x092a3b2au, 0x09cb3ad0u, 0x0a283a65u, 0x0a3f39ecu, 0x0a18396au, 0x09bf38e3u, 0x0946385du,
    0x08ba37b7u, 0x082b36c2u, 0x073e35e1u, 0x063b3516u, 0x00323c00u, 0x00313c00u, 0x003e3c00u, 0x00793bffu,
    0x00fc3bfdu, 0x020c3bf9u, 0x03b33bf1u, 0x05f53be2u, 0x085f3bcbu, 0x09e23ba5u, 0x0b573b70u, 0x0c463b27u,
    0x0caf3acdu, 0x0cdc3a61u, 0x0cd439e9u, 0x0c9c3969u, 0x0c4538e5u, 0x0bb43861u, 0x0acf37c3u, 0x09ec36d3u,
    0x091635f5u, 0x0856352cu, 0x00f63c00u, 0x00f53c00u, 0x010e3c00u, 0x01873bffu, 0x028e3bfdu, 0x04763bf9u,
    0x077d3bf1u, 0x09b53be2u, 0x0c063bcau, 0x0d3c3ba4u, 0x0e553b6du, 0x0f293b24u, 0x0fa33ac8u, 0x0fbb3a5du,
    0x0f8039e6u, 0x0f043968u, 0x0e6038e7u, 0x0da93866u, 0x0cef37d4u, 0x0c3d36e8u, 0x0b35360du, 0x0a173546u,
    0x03c93c00u, 0x03c63c00u, 0x04023c00u, 0x04ec3bffu, 0x06e73bfdu, 0x09423bf9u, 0x0bed3bf1u, 0x0da93be2u,
    0x0f933bc8u, 0x10ba3ba1u, 0x11833b6au, 0x12093b1fu, 0x123e3ac3u, 0x12283a58u, 0x11d439e3u, 0x11573968u,
    0x10c438eau, 0x1029386du, 0x0f2937e8u, 0x0e153702u, 0x0d20362bu, 0x0c4c3566u, 0x0a4b3c00u, 0x0a483c00u,
    0x0a8c3c00u, 0x0b5a3bffu, 0x0cab3bfdu, 0x0e4a3bf9u, 0x104d3bf0u, 0x11b53be1u, 0x13383bc6u, 0x144c3b9eu,
    0x14d03b65u, 0x15163b19u, 0x15183abdu, 0x14e23a52u, 0x148339e0u, 0x140d3968u, 0x131938eeu, 0x121c3875u,
    0x11313800u, 0x105e3720u, 0x0f4c364eu, 0x0e14358du, 0x10963c00u, 0x10953c00u, 0x10b53c00u, 0x111a3bffu,
    0x11fc3bfdu, 0x13633bf9u, 0x14a73bf0u, 0x15c43bdfu, 0x16e23bc4u, 0x17ce3b9au, 0x18303b5fu, 0x18433b12u,
    0x18223ab5u, 0x17b43a4cu, 0x16f239dcu, 0x161c3969u, 0x154438f4u, 0x14793880u, 0x1384380fu, 0x12443745u,
    0x11333678u, 0x104e35bau, 0x16053c00u, 0x16053c00u, 0x16203c00u, 0x167c3bffu, 0x17363bfdu, 0x18323bf9u,
    0x18f13befu, 0x19c33bddu, 0x1a813bc0u, 0x1b063b94u, 0x1b393b58u, 0x1b143b0au, 0x1aa63aadu, 0x1a053a46u,
    0x194e39dau, 0x1893396bu, 0x17c538fcu, 0x1685388du, 0x156d3821u, 0x147e3771u, 0x136936aau, 0x121d35f0u,
    0x1b403c00u, 0x1b413c00u, 0x1b573c00u, 0x1ba33bffu, 0x1c1e3bfdu, 0x1c8e3bf8u, 0x1d183beeu, 0x1da13bdau,
    0x1e0b3bbbu, 0x1e3a3b8cu, 0x1e243b4eu, 0x1dcd3b00u, 0x1d463aa4u, 0x1ca63a40u, 0x1c0239d8u, 0x1acd3970u,
    0x19b23906u, 0x18bb389eu, 0x17d13837u, 0x166f37a5u, 0x154936e5u, 0x14593630u, 0x20113c00u, 0x20113c00u,
    0x201a3c00u, 0x20363bffu, 0x206e3bfdu, 0x20bb3bf7u, 0x21113bebu, 0x21593bd6u, 0x217b3bb3u, 0x21683b81u,
    0x211f3b41u, 0x20ac3af3u, 0x201f3a9au, 0x1f173a3au, 0x1dff39d9u, 0x1d033977u, 0x1c263915u, 0x1ad638b3u,
    0x199d3851u, 0x189b37e4u, 0x178c372cu, 0x1633367cu, 0x244a3c00u, 0x244a3c00u, 0x24503c00u, 0x24643bffu,
    0x24873bfcu, 0x24b43bf6u, 0x24dc3be8u, 0x24ed3bcfu, 0x24d63ba7u, 0x24933b72u, 0x242c3b31u, 0x235e3ae5u,
    0x22543a90u, 0x21553a37u, 0x206f39ddu, 0x1f513983u, 0x1e023928u, 0x1cec38cdu, 0x1c073872u, 0x1a983818u,
    0x19673781u, 0x187036d7u, 0x284b3c00u, 0x284b3c00u, 0x284f3c00u, 0x285a3bffu, 0x286c3bfcu, 0x287c3bf3u,
    0x287d3be3u, 0x28623bc6u, 0x28223b98u, 0x27843b5eu, 0x269f3b1eu, 0x25ad3ad6u, 0x24c43a88u, 0x23e23a37u,
    0x227939e6u, 0x214b3995u, 0x20533943u, 0x1f1038efu, 0x1dc6389bu, 0x1cba3847u, 0x1bc237e8u, 0x1a643746u,
    0x2c1c3c00u, 0x2c1c3c00u, 0x2c1e3c00u, 0x2c213bfeu, 0x2c233bfau, 0x2c1b3befu, 0x2bfb3bdbu, 0x2b833bb7u,
    0x2ad03b83u, 0x29f93b48u, 0x29183b08u, 0x28433ac8u, 0x27063a84u, 0x25bc3a3du, 0x24ac39f7u, 0x239a39afu,
    0x22323966u, 0x210f391bu, 0x202538cfu, 0x1ece3881u, 0x1d9a3834u, 0x1ca237cfu, 0x2f8e3c00u, 0x2f8d3c00u,
    0x2f8c3c00u, 0x2f883bfeu, 0x2f753bf9u, 0x2f3a3be9u, 0x2ecf3bcdu, 0x2e2d3ba2u, 0x2d623b67u, 0x2c913b2eu,
    0x2b943af3u, 0x2a3a3abfu, 0x29103a88u, 0x281b3a4du, 0x26aa3a13u, 0x256b39d6u, 0x246c3997u, 0x233f3955u,
    0x21f63910u, 0x20ec38cbu, 0x20153884u, 0x1ecd383du, 0x32b83c00u, 0x32b83c00u, 0x32b63bffu, 0x32a23bfbu,
    0x326f3bf1u, 0x32193bdcu, 0x318b3bb5u, 0x30d13b7fu, 0x300f3b49u, 0x2eac3b12u, 0x2d713ae7u, 0x2c6c3ac3u,
    0x2b293a9bu, 0x29cd3a70u, 0x28b63a41u, 0x27b23a0fu, 0x265039dau, 0x253639a2u, 0x24523967u, 0x2332392au,
    0x220638ecu, 0x211238acu, 0x35c13c00u, 0x35bf3c00u, 0x35b43c00u, 0x35a03c01u, 0x35693bf8u, 0x34e03bc3u,
    0x34333b85u, 0x330b3b59u, 0x31c13b2eu, 0x30a73b0cu, 0x2f8c3af9u, 0x2e1e3ae6u, 0x2cf73acdu, 0x2c0a3aaeu,
    0x2a9d3a8bu, 0x29723a64u, 0x28833a3au, 0x27873a0du, 0x265239ddu, 0x255639abu, 0x24883977u, 0x23c03943u,
    0x38e03c00u, 0x38e23c00u, 0x38df3bfcu, 0x389c3bceu, 0x38093b77u, 0x37093b70u, 0x35e23b6cu, 0x34c83b57u,
    0x33be3b4cu, 0x32523b52u, 0x31253b4eu, 0x30313b42u, 0x2ee03b34u, 0x2da53b1bu, 0x2cae3b03u, 0x2bd23ae9u,
    0x2a953accu, 0x29953aaeu, 0x28c43a8du, 0x281a3a6au, 0x271a3a46u, 0x26303a20u, 0x3bab3c00u, 0x3ba03bfdu,
    0x3b243bfbu, 0x3a5b3c13u, 0x39d23c6du, 0x38983c3au, 0x377d3c29u, 0x35fc3c09u, 0x34fc3c13u, 0x340e3c05u,
    0x32aa3bf9u, 0x31843beeu, 0x30983be1u, 0x2fb73bd8u, 0x2e8c3bd1u, 0x2d9b3bcbu, 0x2cd93bc4u, 0x2c3c3bbdu,
    0x2b793bb6u, 0x2aa93bafu, 0x29fd3ba7u, 0x29733ba4u);

// The table ggx at a place that steradian_ltc_coordinates gives: GGX; the shape is what steradian_ltc_from_compact takes.
fn steradian_ltc_ggx_shape_at(k: i32) -> vec4f {
    return vec4f(unpack2x16float(steradian_ltc_ggx_shape_words[2 * k]), unpack2x16float(steradian_ltc_ggx_shape_words[2 * k + 1]));
}
fn steradian_ltc_ggx_shape(place: vec2f) -> vec4f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 15.0;
    let node = min(floor(x), vec2f(14.0, 14.0));
    let f = x - node;
    let k = i32(node.y) * 16 + i32(node.x);
    let low = mix(steradian_ltc_ggx_shape_at(k), steradian_ltc_ggx_shape_at(k + 1), f.x);
    let high = mix(steradian_ltc_ggx_shape_at(k + 16), steradian_ltc_ggx_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}

// The magnitudes of the table ggx at such a place: what steradian_ltc_specular_scale takes.
fn steradian_ltc_ggx_magnitude_at(k: i32) -> vec2f { return unpack2x16float(steradian_ltc_ggx_magnitude_words[k]); }
fn steradian_ltc_ggx_magnitude(place: vec2f) -> vec2f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 21.0;
    let node = min(floor(x), vec2f(20.0, 20.0));
    let f = x - node;
    let k = i32(node.y) * 22 + i32(node.x);
    let low = mix(steradian_ltc_ggx_magnitude_at(k), steradian_ltc_ggx_magnitude_at(k + 1), f.x);
    let high = mix(steradian_ltc_ggx_magnitude_at(k + 22), steradian_ltc_ggx_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}

var<private> steradian_ltc_charlie_shape_words: array<u32, 512> = array<u32, 512>(
    0x3b7137b5u, 0x9ee5b491u, 0x3e423cc4u, 0x99e2b415u, 0xb8debcf5u, 0xa41fb5bdu, 0x47354781u, 0x2806231au,
    0x46ad46c6u, 0x9ab42c50u, 0x44aa44aau, 0xa61fa4fau, 0x4325431au, 0xa452a8cdu, 0x41d541c6u, 0xa16ba90bu,
    0x410040eeu, 0x9ceaa8afu, 0x4072405eu, 0x936da838u, 0x400f3ff7u, 0x9022a73cu, 0x3f8e3f68u, 0x1258a645u,
    0x3f213efcu, 0x109ba55du, 0x3ecb3ea8u, 0x1033a4a8u, 0x3e833e62u, 0x1234a40du, 0x3e423e23u, 0x12a8a303u,
    0x388d3f71u, 0x23d43978u, 0x3cc1406du, 0x24f13c62u, 0xbb743c05u, 0x1db7b502u, 0x46b14559u, 0x2b0744c0u,
    0x45a344e1u, 0x2fb24146u, 0x444343f6u, 0x31533d8fu, 0x42d0428au, 0x31433a7eu, 0x41ae417cu, 0x30783827u,
    0x40ea40c1u, 0x2f6535b4u, 0x40634041u, 0x2e293426u, 0x40043fccu, 0x2d283253u, 0x3f7c3f46u, 0x2c5f30fau,
    0x3f133ee2u, 0x2b793009u, 0x3ebe3e92u, 0x2a6d2eb2u, 0x3e773e4fu, 0x29982da5u, 0x3e373e14u, 0x28e22cd5u,
    0x46a9419cu, 0xb6c54677u, 0x469c419au, 0xb6c1466au, 0x46ca419fu, 0xb6cf4698u, 0x4625418du, 0xb69e45f2u,
    0x445d41a6u, 0xae0a4252u, 0x43184167u, 0x2c263ff3u, 0x4206410fu, 0x30c53d39u, 0x413c40a1u, 0x31883b2fu,
    0x40a64038u, 0x314a3933u, 0x40373fc7u, 0x30c837dbu, 0x3fcc3f45u, 0x30393627u, 0x3f503ee1u, 0x2f6834f2u,
    0x3eef3e92u, 0x2e7b3411u, 0x3ea13e51u, 0x2dae32d0u, 0x3e5f3e1au, 0x2d0031cbu, 0x3e223de6u, 0x2c6e30fcu,
    0x45b83dabu, 0xb9bd4654u, 0x45b63db9u, 0xb9bd464du, 0x45be3d8au, 0xb9be4664u, 0x45a23e33u, 0xb9b94612u,
    0x43c63fb4u, 0xb5024287u, 0x42483fe7u, 0xad81403du, 0x41653fb7u, 0x20db3df7u, 0x40c53f66u, 0x2c773c60u,
    0x40523f1au, 0x2eff3a9fu, 0x3ff93ecfu, 0x2fe4392du, 0x3f753e8bu, 0x2fe03828u, 0x3f0f3e51u, 0x2f7736d0u,
    0x3ebd3e20u, 0x2ee235b0u, 0x3e793df5u, 0x2e4434d1u, 0x3e3d3dcdu, 0x2dad3420u, 0x3e063da6u, 0x2d223323u,
    0x45b23aa3u, 0xbb81465du, 0x45ad3ab5u, 0xbb804657u, 0x45be3a76u, 0xbb81466cu, 0x45833b5au, 0xbb7e4622u,
    0x43503de6u, 0xb75c4278u, 0x41d63e48u, 0xb3364047u, 0x41003e49u, 0xadee3e1bu, 0x40723e29u, 0xa2cd3c9eu,
    0x400e3e06u, 0x27673b46u, 0x3f8a3deau, 0x2b7b39ddu, 0x3f1f3dd2u, 0x2ccd38d3u, 0x3ec93dbbu, 0x2d473807u,
    0x3e853da4u, 0x2d4d36d2u, 0x3e4c3d8eu, 0x2d1f35d8u, 0x3e183d76u, 0x2cd8350cu, 0x3de83d5cu, 0x2c813466u,
    0x45a33831u, 0xbc61463bu, 0x459c3841u, 0xbc5e4636u, 0x45b4380bu, 0xbc6a4647u, 0x455f38cdu, 0xbc3d4608u,
    0x43073d09u, 0xb85f423cu, 0x41953d63u, 0xb5184035u, 0x40c03d68u, 0xb1dd3e0cu, 0x40383d5cu, 0xadbd3ca5u,
    0x3fba3d53u, 0xa7ca3b6fu, 0x3f383d4au, 0x19c13a20u, 0x3ed83d43u, 0x25a13924u, 0x3e8f3d3du, 0x287f385eu,
    0x3e543d37u, 0x2987377fu, 0x3e233d30u, 0x2a08367eu, 0x3df73d25u, 0x2a3235a9u, 0x3dcc3d16u, 0x2a1d34f8u,
    0x456837a7u, 0xbc7945d5u, 0x456137c3u, 0xbc7445d0u, 0x45793764u, 0xbc8545e0u, 0x4523385du, 0xbc4945a8u,
    0x42c63ca9u, 0xb89a41eau, 0x41683ce6u, 0xb5fa4010u, 0x40953ceau, 0xb3a13de1u, 0x40113ce0u, 0xb0b33c92u,
    0x3f733cddu, 0xad883b66u, 0x3efb3cddu, 0xaa133a29u, 0x3ea43ce0u, 0xa5643938u, 0x3e623ce2u, 0x9c0f387cu,
    0x3e2f3ce5u, 0x1f1537c9u, 0x3e033ce5u, 0x234136cfu, 0x3ddc3ce3u, 0x24d335fcu, 0x3db63cdcu, 0x2576354au,
    0x450f38d6u, 0xbc284547u, 0x450938e2u, 0xbc234542u, 0x451e38b9u, 0xbc334552u, 0x44d4394au, 0xbbf4451bu,
    0x42893c90u, 0xb87c418cu, 0x41433cb1u, 0xb6303fb5u, 0x40773caau, 0xb4323da3u, 0x3fef3ca0u, 0xb1bd3c6eu,
    0x3f453c9cu, 0xaffc3b3bu, 0x3ed23c9cu, 0xad9b3a0fu, 0x3e803ca0u, 0xabc3392cu, 0x3e433ca6u, 0xa9443879u,
    0x3e143cacu, 0xa6f137cfu, 0x3dec3cb1u, 0xa44a36e0u, 0x3dc93cb3u, 0xa0df3615u, 0x3da73cb1u, 0x9caa3568u,
    0x44b53a4eu, 0xbb5544b3u, 0x44b13a57u, 0xbb4f44afu, 0x44c03a39u, 0xbb6444bcu, 0x448c3aa6u, 0xbb17448eu,
    0x42563ca2u, 0xb82f4129u, 0x41233ca7u, 0xb5ed3f3au, 0x40613c95u, 0xb42b3d5au, 0x3fcb3c87u, 0xb2113c3eu,
    0x3f293c7eu, 0xb09e3af7u, 0x3eb93c7du, 0xaf3739dfu, 0x3e6a3c80u, 0xad993908u, 0x3e303c85u, 0xac68385eu,
    0x3e033c8cu, 0xaaf637abu, 0x3ddd3c92u, 0xa99836c7u, 0x3dbd3c96u, 0xa8883606u, 0x3d9d3c96u, 0xa77a3561u,
    0x44663bfbu, 0xba324424u, 0x44633c01u, 0xba2d4421u, 0x446e3bebu, 0xba40442cu, 0x44463c1du, 0xb9fb4405u,
    0x42283cd8u, 0xb75e40beu, 0x41093cbcu, 0xb5533eb7u, 0x40503c9du, 0xb3ad3d09u, 0x3fb63c88u, 0xb1e53c06u,
    0x3f1a3c7cu, 0xb0bc3aa3u, 0x3ead3c77u, 0xafca399du, 0x3e603c77u, 0xae8538d4u, 0x3e273c7cu, 0xad713834u,
    0x3dfc3c82u, 0xaca03765u, 0x3dd73c87u, 0xabde368du, 0x3db83c8cu, 0xaaca35d7u, 0x3d9a3c8du, 0xa9f3353au,
    0x44213cdfu, 0xb8ec433bu, 0x441f3ce0u, 0xb8e94337u, 0x44263cdbu, 0xb8f34346u, 0x440d3cf0u, 0xb8ce430fu,
    0x42033d24u, 0xb61c4051u, 0x40f63ce7u, 0xb4783e31u, 0x40473cbau, 0xb2a73cb4u, 0x3fad3c9du, 0xb1523b90u,
    0x3f163c8cu, 0xb0723a43u, 0x3eac3c84u, 0xaf9e394eu, 0x3e603c82u, 0xaea23893u, 0x3e283c84u, 0xadbc37f8u,
    0x3dfd3c89u, 0xad0c3705u, 0x3dd93c8eu, 0xac7c363bu, 0x3dbb3c92u, 0xabf6358fu, 0x3d9e3c93u, 0xab2434fcu,
    0x43df3dbau, 0xb7534247u, 0x43dc3dbbu, 0xb74f4244u, 0x43e63db8u, 0xb75d4250u, 0x43c33dc1u, 0xb7284226u,
    0x41e93d83u, 0xb4ae3fc9u, 0x40ea3d25u, 0xb2f43da8u, 0x40423ce8u, 0xb15d3c59u, 0x3fae3cc2u, 0xb0733b08u,
    0x3f1b3cacu, 0xafbc39d8u, 0x3eb33ca0u, 0xaede38f6u, 0x3e693c9bu, 0xae193846u, 0x3e313c9cu, 0xad6d3775u,
    0x3e063c9eu, 0xacee3692u, 0x3de33ca2u, 0xac7735d5u, 0x3dc53ca5u, 0xac0f3535u, 0x3daa3ca7u, 0xab5d34acu,
    0x43b03e9bu, 0xb50a4173u, 0x43af3e9bu, 0xb5084171u, 0x43b53e9bu, 0xb5104178u, 0x439e3e9cu, 0xb4f3415eu,
    0x41e03dfau, 0xb26a3ef4u, 0x40eb3d7bu, 0xb0d93d24u, 0x404a3d2du, 0xafa63bfau, 0x3fc23cfdu, 0xaea83a7bu,
    0x3f323ce0u, 0xae0e3967u, 0x3ecd3cd0u, 0xad803897u, 0x3e833cc8u, 0xad0d37e9u, 0x3e4a3cc6u, 0xacaf36e6u,
    0x3e1e3cc6u, 0xac4a3613u, 0x3dfb3cc9u, 0xabe33563u, 0x3ddd3ccbu, 0xab3934cfu, 0x3dc23ccdu, 0xaa9e3450u,
    0x43ba3fb6u, 0xb15f40b2u, 0x43b93fb6u, 0xb15c40b1u, 0x43be3fb8u, 0xb16640b7u, 0x43aa3fb0u, 0xb13f40a2u,
    0x41f83ea6u, 0xaea63e2eu, 0x41063e01u, 0xad163ca0u, 0x40673d9au, 0xac653b40u, 0x3ffd3d5cu, 0xac2839ecu,
    0x3f6e3d37u, 0xabea38f2u, 0x3f073d21u, 0xab953835u, 0x3eba3d15u, 0xab2a3740u, 0x3e803d0fu, 0xaac93651u,
    0x3e523d0du, 0xaa5c358eu, 0x3e2d3d0du, 0xa9ee34ecu, 0x3e0e3d0eu, 0xa9843464u, 0x3df33d0eu, 0xa92a33e1u,
    0x43f14086u, 0xa8a43ff8u, 0x43ef4086u, 0xa89c3ff5u, 0x43f54088u, 0xa8b83ffeu, 0x43e14081u, 0xa8543fdfu,
    0x422d3f91u, 0x9e3d3d65u, 0x413b3ebeu, 0x9c7c3c18u, 0x409b3e3bu, 0x9ed13a77u, 0x40323decu, 0xa2b7394cu,
    0x3fd13dbau, 0xa4bf3870u, 0x3f663d9cu, 0xa5c8378fu, 0x3f163d8au, 0xa6583685u, 0x3ed73d7fu, 0xa67b35adu,
    0x3ea63d79u, 0xa68934fdu, 0x3e7f3d76u, 0xa664346bu, 0x3e5f3d74u, 0xa62a33e3u, 0x3e433d73u, 0xa5f03316u,
    0x449d4292u, 0x32f43e4au, 0x449c4291u, 0x32f63e48u, 0x44a04295u, 0x32f13e4eu, 0x44944286u, 0x33023e39u,
    0x43284132u, 0x321c3c69u, 0x420e407au, 0x30b53adcu, 0x41534008u, 0x2f133988u, 0x40d73f84u, 0x2d3d389au,
    0x40813f2du, 0x2beb37c6u, 0x40423ef2u, 0x29ce36aeu, 0x40123eccu, 0x284c35ccu, 0x3fd93eb2u, 0x26323518u,
    0x3fa03e9fu, 0x24ab3483u, 0x3f703e93u, 0x22e43407u, 0x3f493e89u, 0x211b333cu, 0x3f293e82u, 0x1f37328bu);

var<private> steradian_ltc_charlie_magnitude_words: array<u32, 484> = array<u32, 484>(
    0x00000009u, 0x00000004u, 0x0000001bu, 0x00000000u, 0x0000018au, 0x00000174u, 0x00060fd8u, 0x00161896u,
    0x00301e43u, 0x00512269u, 0x0077257eu, 0x009e282du, 0x00c529d4u, 0x00eb2ba4u, 0x010f2cc6u, 0x01312dbdu,
    0x01502eb0u, 0x016c2f9au, 0x0185303au, 0x0198309du, 0x01a730f5u, 0x01b0313eu, 0x00000000u, 0x00000000u,
    0x00000000u, 0x00000000u, 0x0000018cu, 0x000001d9u, 0x00061048u, 0x001618d5u, 0x00301e7eu, 0x00522295u,
    0x0079259bu, 0x00a2283eu, 0x00cb29e7u, 0x00f22bb9u, 0x01182cd1u, 0x013c2dc8u, 0x015d2ebcu, 0x017b2fa6u,
    0x01953040u, 0x01aa30a3u, 0x01b930fau, 0x01c33143u, 0x0000007au, 0x0000007au, 0x00000079u, 0x0000007cu,
    0x0000006eu, 0x00010349u, 0x0006116cu, 0x00161999u, 0x00321f35u, 0x0057231fu, 0x008125f5u, 0x00af2874u,
    0x00dd2a24u, 0x010b2bfbu, 0x01372cf3u, 0x01612decu, 0x01882ee0u, 0x01ab2fcau, 0x01c93052u, 0x01e330b5u,
    0x01f6310cu, 0x02023154u, 0x00000116u, 0x00000117u, 0x00000111u, 0x00000130u, 0x000000a3u, 0x0001068bu,
    0x00061391u, 0x00171ae7u, 0x0034202bu, 0x005d23f2u, 0x008e267eu, 0x00c428c7u, 0x00fb2a83u, 0x01342c31u,
    0x016b2d2au, 0x019f2e25u, 0x01d12f1bu, 0x01fe3003u, 0x02253070u, 0x024730d3u, 0x02613129u, 0x02723170u,
    0x00000253u, 0x00000258u, 0x00000244u, 0x0000029cu, 0x0000010du, 0x00010a8eu, 0x00071597u, 0x00181c79u,
    0x00382106u, 0x00662492u, 0x00a02740u, 0x00e12939u, 0x01272b04u, 0x016f2c78u, 0x01b62d76u, 0x01fc2e74u,
    0x023d2f6bu, 0x027a302cu, 0x02b03099u, 0x02de30fbu, 0x03023151u, 0x031b3198u, 0x000004f8u, 0x00000502u,
    0x000004dau, 0x0000058eu, 0x0000025du, 0x00010e51u, 0x00081837u, 0x001b1dfbu, 0x003e223bu, 0x00742565u,
    0x00b92823u, 0x010a29d1u, 0x01632badu, 0x01c12cd3u, 0x021f2dd6u, 0x027c2ed8u, 0x02d52fd3u, 0x03283060u,
    0x037330ceu, 0x03b43130u, 0x03e83185u, 0x040d31cau, 0x0000093au, 0x00000943u, 0x0000091eu, 0x000009c2u,
    0x000005bbu, 0x000211dcu, 0x000a1a5eu, 0x001f200du, 0x004823deu, 0x0088267cu, 0x00dd28ccu, 0x01422a94u,
    0x01b42c42u, 0x022e2d46u, 0x02ac2e4fu, 0x03292f55u, 0x03a33029u, 0x041730a1u, 0x0480310fu, 0x04db3171u,
    0x052731c5u, 0x055e3209u, 0x00010d55u, 0x00010d5cu, 0x00010d3fu, 0x00010dc5u, 0x00000acbu, 0x0002153au,
    0x000d1cc8u, 0x00272182u, 0x00582502u, 0x00a527e1u, 0x010e29a2u, 0x018f2b86u, 0x02222cc6u, 0x02c22dd3u,
    0x03692ee3u, 0x04132feeu, 0x04b93077u, 0x055930f0u, 0x05ec315eu, 0x066e31c0u, 0x06db3213u, 0x072c3255u,
    0x00011148u, 0x0001114du, 0x00011136u, 0x000111a0u, 0x00010f85u, 0x00041882u, 0x00121f17u, 0x0033237au,
    0x00712665u, 0x00d228d0u, 0x01552aa8u, 0x01f92c56u, 0x02b72d66u, 0x03892e7du, 0x04682f94u, 0x054d3052u,
    0x063130d4u, 0x070c314eu, 0x07d931bdu, 0x0848321eu, 0x08963270u, 0x08d132b0u, 0x00021507u, 0x0002150bu,
    0x000214fau, 0x00021547u, 0x000113cfu, 0x00061b92u, 0x001b2132u, 0x0048250cu, 0x009a2814u, 0x011529e5u,
    0x01be2be7u, 0x02902d06u, 0x03882e24u, 0x049d2f45u, 0x05c63032u, 0x06fa30bdu, 0x08183142u, 0x08af31bcu,
    0x093d322bu, 0x09bd328cu, 0x0a2c32ddu, 0x0a81331au, 0x000318acu, 0x000318afu, 0x000318a2u, 0x000318dau,
    0x000217b9u, 0x000b1e33u, 0x002a2387u, 0x006c26c6u, 0x00dc2931u, 0x01802b38u, 0x025d2cb3u, 0x03712dd8u,
    0x04b62f04u, 0x06243018u, 0x07b030acu, 0x08a7313au, 0x097a31c1u, 0x0a49323du, 0x0b0d32adu, 0x0bc0330du,
    0x0c2d335cu, 0x0c6a3396u, 0x00061c3bu, 0x00061c3du, 0x00061c34u, 0x00061c5bu, 0x00041b58u, 0x001420fdu,
    0x00482567u, 0x00ac2885u, 0x014b2a98u, 0x022d2c6bu, 0x03572d9au, 0x04c72ed1u, 0x06783005u, 0x083130a1u,
    0x093a313au, 0x0a5231ccu, 0x0b703255u, 0x0c4532d2u, 0x0ccc3342u, 0x0d4833a2u, 0x0db533efu, 0x0e0a3412u,
    0x000c1f81u, 0x000d1f84u, 0x000c1f78u, 0x000d1facu, 0x000a1ec1u, 0x002823e5u, 0x008027b1u, 0x011d2a02u,
    0x020a2c2eu, 0x034d2d6au, 0x04ec2eaeu, 0x06e32ff7u, 0x089830a0u, 0x09e23142u, 0x0b4a31dfu, 0x0c633274u,
    0x0d263300u, 0x0de83380u, 0x0ea133f0u, 0x0f4d3427u, 0x0fe3344du, 0x102d3466u, 0x001e228bu, 0x001e228cu,
    0x001e2285u, 0x001f22a7u, 0x0019220du, 0x00542629u, 0x00ef2971u, 0x01ef2bf8u, 0x035c2d4du, 0x053c2ea4u,
    0x078e2ffeu, 0x092a30acu, 0x0ac23157u, 0x0c4531feu, 0x0d3c32a0u, 0x0e41333au, 0x0f4d33c9u, 0x102c3425u,
    0x10ac345eu, 0x1122348du, 0x118a34b0u, 0x11dd34c7u, 0x0043259cu, 0x0043259eu, 0x00432599u, 0x004525aeu,
    0x0038254eu, 0x00b528c6u, 0x01d02badu, 0x037e2d49u, 0x05c62ebdu, 0x08513017u, 0x0a0930cdu, 0x0c053182u,
    0x0d283233u, 0x0e6932e1u, 0x0fc43387u, 0x10983413u, 0x1152345cu, 0x120c349eu, 0x12be34d7u, 0x13623505u,
    0x13f23527u, 0x1432353bu, 0x00c128cbu, 0x00c128cbu, 0x00c028c9u, 0x00c528d5u, 0x00ad289bu, 0x01a82b60u,
    0x03bb2d6fu, 0x06a32f0fu, 0x092d3051u, 0x0b6d3115u, 0x0d0731d4u, 0x0e85328fu, 0x10183347u, 0x110033fau,
    0x11f93453u, 0x12fd34a4u, 0x140334efu, 0x14863533u, 0x1503356cu, 0x1576359au, 0x15db35bbu, 0x162935cbu,
    0x01be2c10u, 0x01bf2c10u, 0x01bc2c0fu, 0x01c82c16u, 0x01912be8u, 0x03d82db3u, 0x07ea2fb7u, 0x0a8630bdu,
    0x0cd23191u, 0x0ea2325bu, 0x10583320u, 0x117c33e0u, 0x12bd344eu, 0x140b34aau, 0x14c23502u, 0x157f3556u,
    0x163f35a3u, 0x16fb35e8u, 0x17ae3622u, 0x18293650u, 0x186f366eu, 0x18a5367au, 0x06112ee5u, 0x06122ee5u,
    0x060d2ee4u, 0x06232eebu, 0x05c12ec9u, 0x092c3065u, 0x0c89317eu, 0x0ecf3263u, 0x10b73337u, 0x122e33ffu,
    0x13ce3461u, 0x14ca34c0u, 0x15bf351fu, 0x16c4357cu, 0x17d635d6u, 0x1877362cu, 0x1905367cu, 0x198e36c2u,
    0x1a1036fdu, 0x1a853729u, 0x1ae83745u, 0x1b31374bu, 0x0b4731dau, 0x0b4831dau, 0x0b4331d9u, 0x0b5b31ddu,
    0x0aee31ccu, 0x0e4d32d8u, 0x112a33e4u, 0x133f345au, 0x14c134bau, 0x15f73515u, 0x17453570u, 0x185635ccu,
    0x19153629u, 0x19de3686u, 0x1aaf36e1u, 0x1b843739u, 0x1c2c378au, 0x1c9237d2u, 0x1cf23807u, 0x1d46381cu,
    0x1d8c3828u, 0x1dbe3828u, 0x143d350au, 0x143d350au, 0x143c350au, 0x1442350bu, 0x142a3505u, 0x15693568u,
    0x171c35c1u, 0x18663606u, 0x194b3649u, 0x1a3e3690u, 0x1b4136ddu, 0x1c2b372fu, 0x1cbe3786u, 0x1d5937e0u,
    0x1df9381eu, 0x1e9b384au, 0x1f3c3874u, 0x1fd63899u, 0x203238b7u, 0x206f38cbu, 0x20a038d5u, 0x20c138d1u,
    0x19673886u, 0x19673886u, 0x19663886u, 0x196c3886u, 0x194f3887u, 0x1b203879u, 0x1c813868u, 0x1d493861u,
    0x1e0e3865u, 0x1ed73874u, 0x1fa9388bu, 0x204438abu, 0x20bb38d1u, 0x213738fbu, 0x21b63928u, 0x22373956u,
    0x22b63981u, 0x232e39a8u, 0x239b39c7u, 0x23f739dbu, 0x241e39e2u, 0x243339d6u, 0x25893c9fu, 0x25893c9fu,
    0x258a3c9fu, 0x25893c9eu, 0x258d3ca5u, 0x25403c24u, 0x25063b6fu, 0x24f23af2u, 0x24f93aa5u, 0x25163a7du,
    0x25453a6fu, 0x25853a77u, 0x25d13a8fu, 0x26283ab2u, 0x26873addu, 0x26ea3b0du, 0x274c3b3du, 0x27aa3b68u,
    0x27fe3b8bu, 0x28213ba1u, 0x28373ba4u, 0x283e3b8eu);

// The table charlie at a place that steradian_ltc_coordinates gives: Charlie's sheen; the shape is M^-1 about the normal: xx, yy, xz, zx, and zz is 1.
fn steradian_ltc_charlie_shape_at(k: i32) -> vec4f {
    return vec4f(unpack2x16float(steradian_ltc_charlie_shape_words[2 * k]), unpack2x16float(steradian_ltc_charlie_shape_words[2 * k + 1]));
}
fn steradian_ltc_charlie_shape(place: vec2f) -> vec4f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 15.0;
    let node = min(floor(x), vec2f(14.0, 14.0));
    let f = x - node;
    let k = i32(node.y) * 16 + i32(node.x);
    let low = mix(steradian_ltc_charlie_shape_at(k), steradian_ltc_charlie_shape_at(k + 1), f.x);
    let high = mix(steradian_ltc_charlie_shape_at(k + 16), steradian_ltc_charlie_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}

// The magnitudes of the table charlie at such a place: what steradian_ltc_specular_scale takes.
fn steradian_ltc_charlie_magnitude_at(k: i32) -> vec2f { return unpack2x16float(steradian_ltc_charlie_magnitude_words[k]); }
fn steradian_ltc_charlie_magnitude(place: vec2f) -> vec2f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 21.0;
    let node = min(floor(x), vec2f(20.0, 20.0));
    let f = x - node;
    let k = i32(node.y) * 22 + i32(node.x);
    let low = mix(steradian_ltc_charlie_magnitude_at(k), steradian_ltc_charlie_magnitude_at(k + 1), f.x);
    let high = mix(steradian_ltc_charlie_magnitude_at(k + 22), steradian_ltc_charlie_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}

// ======== lit: surfaces lit by a quad or a polygon in one call: GGX and Lambert ========

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
fn steradian_lit_area_of_edge(corner: vec3f, start: vec3f, end: vec3f) -> vec3f {
    return cross(start - corner, end - corner);
}

// A diffuse surface and the edges of a light that were added.
//   position   of the surface
//   frame      x, y and the normal
//   walk       sum over the edges
//   corner     of the light
//   area       twice the light's area times its normal, which points to its lit side
struct SteradianLambertPolygon {
    position: vec3f,
    frame: mat3x3f,
    walk: SteradianPolygonWalk,
    corner: vec3f,
    area: vec3f,
}

// A diffuse surface before the first edge.
//
//   position   of the surface
//   normal     unit
//   corner     any corner of the light
fn steradian_lambert_polygon_begin(position: vec3f, normal: vec3f, corner: vec3f) -> SteradianLambertPolygon {
    var light: SteradianLambertPolygon;
    light.position = position;
    light.frame = steradian_frame_from_normal(normal);
    light.walk = steradian_polygon_begin();
    light.corner = corner;
    light.area = vec3f(0.0, 0.0, 0.0);
    return light;
}

// Adds one edge of the light. Edges may come in any order. The edges of a hole run the other way round.
fn steradian_lambert_polygon_add_edge(light: SteradianLambertPolygon, start: vec3f, end: vec3f) -> SteradianLambertPolygon {
    let a = steradian_polygon_direction(steradian_transform_transposed(light.frame, end - light.position));
    let b = steradian_polygon_direction(steradian_transform_transposed(light.frame, start - light.position));
    var next = light;
    next.walk = steradian_polygon_add_edge(light.walk, a, b);
    next.area = light.area + steradian_lit_area_of_edge(light.corner, start, end);
    return next;
}

// Radiance of a surface of albedo 1, in [0, 1]; 0 behind the light.
//
// Error: see docs/measured/accuracy.md, "polygon irradiance".
fn steradian_lambert_polygon_radiance(light: SteradianLambertPolygon) -> f32 {
    let lit = dot(light.area, light.position - light.corner) > 0.0;
    return select(0.0, steradian_lambert_radiance(steradian_polygon_irradiance(light.walk, !lit)), lit);
}

// Radiance of a surface of albedo 1 under a light with two lit sides, in [0, 1].
fn steradian_lambert_polygon_radiance_of_both_sides(light: SteradianLambertPolygon) -> f32 {
    let behind = dot(light.area, light.position - light.corner) < 0.0;
    return steradian_lambert_radiance(steradian_polygon_irradiance(light.walk, behind));
}

// Radiance of a diffuse surface of albedo 1 under a light of four corners, in [0, 1]; 0 behind the light.
//
//   position   of the surface
//   normal     unit
//   v0 ... v3  corners of the light, in order
fn steradian_lambert_quad(position: vec3f, normal: vec3f, v0: vec3f, v1: vec3f, v2: vec3f, v3: vec3f) -> f32 {
    let frame = steradian_frame_from_normal(normal);
    let a = steradian_polygon_direction(steradian_transform_transposed(frame, v3 - position));
    let b = steradian_polygon_direction(steradian_transform_transposed(frame, v2 - position));
    let c = steradian_polygon_direction(steradian_transform_transposed(frame, v1 - position));
    let d = steradian_polygon_direction(steradian_transform_transposed(frame, v0 - position));
    var walk = steradian_polygon_begin();
    walk = steradian_polygon_add_edge(walk, a, b);
    walk = steradian_polygon_add_edge(walk, b, c);
    walk = steradian_polygon_add_edge(walk, c, d);
    walk = steradian_polygon_add_edge(walk, d, a);
    let lit = dot(cross(v1 - v0, v2 - v0), position - v0) > 0.0;
    return select(0.0, steradian_lambert_radiance(steradian_polygon_irradiance(walk, !lit)), lit);
}

// The GGX lobe of a surface towards a view, from the compact table.
//   frame      x along the view's projection, z the normal
//   shape      of the lobe
//   magnitude  of the lobe without Fresnel, and of the lobe times (1 - v.h)^5
//   above      true if the view is above the surface
struct SteradianGgxLobe {
    frame: mat3x3f,
    shape: SteradianLtcMatrix,
    magnitude: vec2f,
    above: bool,
}

// The lobe of a surface towards a view. It serves any number of lights.
//
//   normal     unit
//   view       unit, from the surface to the eye
//   roughness  perceptual: the square root of alpha. It is clamped to [0.01, 1]
fn steradian_ggx_lobe_from_table(normal: vec3f, view: vec3f, roughness: f32) -> SteradianGgxLobe {
    let clamped = clamp(roughness, 1.0e-2, 1.0);
    var lobe: SteradianGgxLobe;
    lobe.frame = steradian_frame_from_normal_and_view(normal, view);
    let turned = steradian_transform_transposed(lobe.frame, view);
    let place = steradian_ltc_coordinates(clamped, turned.z);
    lobe.shape = steradian_ltc_from_compact(steradian_ltc_ggx_shape(place), clamped * clamped, vec3f(turned.x, 0.0, turned.z));
    lobe.magnitude = steradian_ltc_ggx_magnitude(place);
    lobe.above = turned.z > 0.0;
    return lobe;
}

// Radiance of a lobe with Schlick's Fresnel; 0 for a view from below the surface.
//
//   f0         reflectance along the normal, a colour; at grazing angles it is 1
//   integral   steradian_ltc_integral of the light
fn steradian_ggx_lobe_radiance(lobe: SteradianGgxLobe, f0: vec3f, integral: f32) -> vec3f {
    let straight = select(0.0, (lobe.magnitude.x - lobe.magnitude.y) * integral, lobe.above);
    let grazing = select(0.0, lobe.magnitude.y * integral, lobe.above);
    return f0 * straight + vec3f(grazing, grazing, grazing);
}

// A glossy surface and the edges of a light that were added.
//   position   of the surface
//   lobe       of the surface
//   walk       sum over the edges
//   corner     of the light
//   area       twice the light's area times its normal, which points to its lit side
struct SteradianGgxPolygon {
    position: vec3f,
    lobe: SteradianGgxLobe,
    walk: SteradianLtcWalk,
    corner: vec3f,
    area: vec3f,
}

// A glossy surface before the first edge.
//
//   position   of the surface
//   normal     unit
//   view       unit, from the surface to the eye
//   roughness  perceptual: the square root of alpha
//   corner     any corner of the light
fn steradian_ggx_polygon_begin(position: vec3f, normal: vec3f, view: vec3f, roughness: f32, corner: vec3f) -> SteradianGgxPolygon {
    var light: SteradianGgxPolygon;
    light.position = position;
    light.lobe = steradian_ggx_lobe_from_table(normal, view, roughness);
    light.walk = steradian_ltc_begin();
    light.corner = corner;
    light.area = vec3f(0.0, 0.0, 0.0);
    return light;
}

// Adds one edge of the light. Edges may come in any order. The edges of a hole run the other way round.
fn steradian_ggx_polygon_add_edge(light: SteradianGgxPolygon, start: vec3f, end: vec3f) -> SteradianGgxPolygon {
    let a = steradian_polygon_direction(steradian_transform_transposed(light.lobe.frame, end - light.position));
    let b = steradian_polygon_direction(steradian_transform_transposed(light.lobe.frame, start - light.position));
    let ta = steradian_ltc_direction(light.lobe.shape, a);
    let tb = steradian_ltc_direction(light.lobe.shape, b);
    var next = light;
    next.walk = steradian_ltc_add_edge(light.walk, light.lobe.shape, a, b, ta, tb);
    next.area = light.area + steradian_lit_area_of_edge(light.corner, start, end);
    return next;
}

// Radiance of the glossy surface towards the view; 0 behind the light and for a view from below the surface.
//
//   f0         reflectance along the normal, a colour; at grazing angles it is 1
//
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel", ltc-compact.
fn steradian_ggx_polygon_radiance(light: SteradianGgxPolygon, f0: vec3f) -> vec3f {
    let lit = dot(light.area, light.position - light.corner) > 0.0;
    return steradian_ggx_lobe_radiance(light.lobe, f0, select(0.0, steradian_ltc_integral(light.walk, !lit), lit));
}

// Radiance of the glossy surface towards the view under a light with two lit sides. See steradian_ggx_polygon_radiance.
fn steradian_ggx_polygon_radiance_of_both_sides(light: SteradianGgxPolygon, f0: vec3f) -> vec3f {
    let behind = dot(light.area, light.position - light.corner) < 0.0;
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
fn steradian_ggx_quad(position: vec3f, normal: vec3f, view: vec3f, v0: vec3f, v1: vec3f, v2: vec3f, v3: vec3f, roughness: f32, f0: vec3f) -> vec3f {
    let lobe = steradian_ggx_lobe_from_table(normal, view, roughness);
    let a = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v3 - position));
    let b = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v2 - position));
    let c = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v1 - position));
    let d = steradian_polygon_direction(steradian_transform_transposed(lobe.frame, v0 - position));
    let ta = steradian_ltc_direction(lobe.shape, a);
    let tb = steradian_ltc_direction(lobe.shape, b);
    let tc = steradian_ltc_direction(lobe.shape, c);
    let td = steradian_ltc_direction(lobe.shape, d);
    var walk = steradian_ltc_begin();
    walk = steradian_ltc_add_edge(walk, lobe.shape, a, b, ta, tb);
    walk = steradian_ltc_add_edge(walk, lobe.shape, b, c, tb, tc);
    walk = steradian_ltc_add_edge(walk, lobe.shape, c, d, tc, td);
    walk = steradian_ltc_add_edge(walk, lobe.shape, d, a, td, ta);
    let lit = dot(cross(v1 - v0, v2 - v0), position - v0) > 0.0;
    return steradian_ggx_lobe_radiance(lobe, f0, select(0.0, steradian_ltc_integral(walk, !lit), lit));
}

// ======== ggx: GGX in closed form, and half vector methods for Blinn-Phong and Beckmann ========

// ==== charlie_cubature ====

// Charlie's sheen under an area light: cubature over the light's outline, fanned about its mean direction.
//
// The lobe is smooth, with a hole where others have a peak; no transformed cosine is like it, but a few nodes are.
// Two walks along the outline, clipped to the horizon (horizon_clip.glsl): the first sums e = steradian_polygon_edge(start, end),
// the second the nodes.
//   SteradianCharlieCubature c = steradian_charlie_cubature_begin(steradian_charlie_prepare(v, alpha), e, facing);
//   for each edge: c = steradian_charlie_cubature_edge(c, start, end);
//   real radiance = steradian_charlie_cubature_finish(c);

// The state of the second walk.
//   centre   where the light is on average: what its outline is fanned about
//   facing   1.0; -1.0 where the outline is walked the wrong way round
//   sum      over the nodes so far
//   at_centre  the centre's weight, which all edges share
struct SteradianCharlieCubature {
    lobe: SteradianCharlieLobe,
    centre: vec3f,
    facing: f32,
    sum: f32,
    at_centre: f32,
}

// Starts the second walk.
//
//   e        sum of the edge vectors of the first walk, in the order in which the edges were walked
//   facing   1.0; -1.0 where the light is seen from behind, so that the walk ran the wrong way round
fn steradian_charlie_cubature_begin(lobe: SteradianCharlieLobe, e: vec3f, facing: f32) -> SteradianCharlieCubature {
    let inward = e * facing;
    let length2 = dot(inward, inward);
    var c: SteradianCharlieCubature;
    c.lobe = lobe;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, steradian_smallest_square())), length2 > steradian_smallest_square());
    c.facing = facing;
    c.sum = 0.0;
    c.at_centre = 0.0;
    return c;
}

// Adds the nodes of an arc of at most a quarter of a circle.
//
//   a, b     unit directions of its ends, in walk order
//
// Along the chord, whose points' directions have a fan of det(c, a, b) / |u|^2 per length: 2 to 4 nodes of Gauss for
// angles up to 0.25, 0.8 and beyond. Inwards, in the cosine: Radau's rule of four nodes, of which the centre is one.
fn steradian_charlie_cubature_arc(c: SteradianCharlieCubature, a: vec3f, b: vec3f) -> SteradianCharlieCubature {
    var next = c;
    let cosine = dot(a, b);
    let n = 2.0 + select(0.0, 1.0, cosine < 0.968912421710644784) + select(0.0, 1.0, cosine < 0.696706709347165421);
    let fan = dot(c.centre, cross(a, b)) * c.facing;
    for (var j: i32 = 0; j < 4; j++) {
        let present = n > f32(j) + 0.5 && abs(fan) > 0.0;
        if (present) {
            let rule = select(select(steradian_gauss_legendre_node(2, j), steradian_gauss_legendre_node(3, j), n > 2.5), steradian_gauss_legendre_node(4, j), n > 3.5);
            let u = a + (b - a) * rule.x;
            let inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
            let rim = u * sqrt(inverse2);
            let rim_cosine = dot(rim, c.centre);
            let aside = rim - c.centre * rim_cosine;
            let outward = aside * inverseSqrt(max(dot(aside, aside), steradian_smallest_divisor()));
            let weight = select(0.0, fan * inverse2 * rule.y / (1.0 + max(rim_cosine, -0.9)), present);
            next.at_centre = next.at_centre + 0.0625 * weight;
            var radial = 0.328844319980059696 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.212340538239152943));
            radial = radial + 0.388193468843171893 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.590533135559265283));
            radial = radial + 0.220462211176768373 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.911412040487296148));
            next.sum = next.sum + weight * radial;
        }
    }
    return next;
}

// Adds the nodes of one edge, or of an arc of the horizon; one longer than a quarter of a circle in two halves.
fn steradian_charlie_cubature_edge(c: SteradianCharlieCubature, a: vec3f, b: vec3f) -> SteradianCharlieCubature {
    let wide = dot(a, b) < 0.0;
    var middle = a + b;
    middle = select(b, middle * inverseSqrt(max(dot(middle, middle), steradian_smallest_divisor())), wide);
    var next = steradian_charlie_cubature_arc(c, a, middle);
    if (wide) {
        next = steradian_charlie_cubature_arc(next, middle, b);
    }
    return next;
}

// Radiance of colour 1 for radiance 1, at least 0.
//
// Error: see docs/measured/accuracy.md, "Sheen".
fn steradian_charlie_cubature_finish(c: SteradianCharlieCubature) -> f32 {
    return max(c.sum + c.at_centre * steradian_charlie_lobe(c.lobe, c.centre), 0.0);
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
//   E = sum of steradian_conic_vector(steradian_ggx_edge(view, a, b)) over the edges clipped to the horizon (horizon_clip.glsl),
//   negated where the light is seen from behind; then steradian_ggx_unshadowed(view, E).
//
// docs/theory/ggx.md has the derivation.
// Frame: z the surface normal, x and y the directions of the widths. Walk order, as polygon.glsl has it.

// The values of the view and the surface that the lobe's integrals need.
//   v        unit view, z > 0
//   w        (ax v_x, ay v_y, v_z): w.u is v.h in stretched space
//   ax, ay   widths: roughness squared, at least 1.0e-4
//   masking  the view's |v|' / v_z of Smith's shadowing, at least 1
struct SteradianGgxView {
    v: vec3f,
    w: vec3f,
    ax: f32,
    ay: f32,
    masking: f32,
}

// Prepares a view.
//
// Degenerate: a view at or below the surface counts as v_z = 1.0e-6; callers give 0 for it.
fn steradian_ggx_view(v: vec3f, ax: f32, ay: f32) -> SteradianGgxView {
    var view: SteradianGgxView;
    let z = max(v.z, 1.0e-6);
    view.v = vec3f(v.x, v.y, z);
    view.w = vec3f(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}

// One edge of a light as a scaled arc in stretched half vector space, without its poles (steradian_conic_scaled).
//
//   a, b     unit directions of the ends, in walk order, not below the horizon
//
// tau counts from the edge's middle; where the middle is near the view, and u2 = S (v - l) would vanish, from the end that
// is further from it.
// Degenerate: a = b, and a = -b, which spans no plane, give an arc of no length.
fn steradian_ggx_edge_scaled(view: SteradianGgxView, a: vec3f, b: vec3f) -> SteradianConicArc {
    let chord = b - a;
    let sum = a + b;
    let chord2 = dot(chord, chord);
    let sum2 = dot(sum, sum);
    let usable = chord2 > steradian_smallest_divisor() && sum2 > 1.0e-12;
    let middle = sum * inverseSqrt(max(sum2, steradian_smallest_divisor()));
    let along = chord * inverseSqrt(max(chord2, steradian_smallest_square()));
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
    return steradian_conic_scaled(
        vec3f(u0.x * x, u0.y * y, u0.z), vec3f(q.x * x, q.y * y, q.z) * 2.0, vec3f(u2.x * x, u2.y * y, u2.z),
        select(-reach, 0.0, side < 0.0), select(reach, 0.0, side > 0.0));
}

// One edge of a light as an arc in stretched half vector space. Arguments and degenerate case: steradian_ggx_edge_scaled.
fn steradian_ggx_edge(view: SteradianGgxView, a: vec3f, b: vec3f) -> SteradianConicArc {
    let arc = steradian_ggx_edge_scaled(view, a, b);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}

// Radiance that the distribution of half vectors alone sends to the view, for radiance 1: INT D / (4 v_z) over the light.
//
//   e        sum over the edges of steradian_conic_vector, negated where the light is seen from behind
//   returns  not negative; above 1 is possible, since nothing shadows: 5.4 at alpha 0.72 and 86 degrees
fn steradian_ggx_unshadowed(view: SteradianGgxView, e: vec3f) -> f32 {
    return max(dot(view.w, e), 0.0) * steradian_inverse_pi() / view.v.z;
}

// The lobe itself towards the view, with F = 1 and with F = (1 - v.h)^5: BRDF times cosine, for steradian_ggx_radiance.
//
//   l        unit direction of the light; below the surface 0
//   smith    1 with shadowing, 0 without
fn steradian_ggx_lobe_and_fresnel(view: SteradianGgxView, l: vec3f, smith: f32) -> vec2f {
    let h = steradian_microfacet_half_vector(l, view.v);
    let g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
    let plain = steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, view.ax, view.ay) * g, l, view.v);
    return vec2f(plain, plain * steradian_fresnel_schlick(0.0, 1.0, dot(view.v, h)));
}

// ==== ggx_cubature ====

// Shadowing and Fresnel over a light: the mean of G2 F under the closed form's measure, by a few nodes that the poles place.
//
// Second walk over the edges, with the sum E of the first (ggx_closed_form.glsl):
//   SteradianGgxCubature c = steradian_ggx_cubature_begin(view, e, smith, facing);
//   for each edge: c = steradian_ggx_cubature_edge(c, edge, extra_nodes);
//   vec2 r = steradian_ggx_cubature_finish(c);         // or, without the second walk: steradian_ggx_draft(view, e, smith, facing)
//   radiance = steradian_ggx_radiance(r, f0, f90)      // per channel
//
// In stretched half vector space the light's image is fanned about its centre us = E/|E|. Nodes go along each edge by
// equal steps of the angle under which the poles see it, and inwards by the moments of a spherical triangle.
// The measure itself is exact; only the smooth factor G2 F is sampled.

// The state of the second walk.
//   centre          us
//   amount          what the distribution alone sends (steradian_ggx_unshadowed)
//   extent          the length of E
//   smith           1 with shadowing, 0 without
//   facing          -1 where the light is seen from behind
//   weight          sum of the weights; weighted: of weight times (G2, G2 (1 - v.h)^5)
//   centre_weight   share of the weights that belongs to the centre
//   at_centre       (G2, G2 (1 - v.h)^5) there
//   lowest, highest of all values with weight
struct SteradianGgxCubature {
    view: SteradianGgxView,
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
fn steradian_ggx_shadowing_and_fresnel(view: SteradianGgxView, u: vec3f, smith: f32) -> vec2f {
    var h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    h = h * inverseSqrt(max(dot(h, h), steradian_smallest_divisor()));
    let v_dot_h = clamp(dot(view.v, h), 0.0, 1.0);
    let l = h * (2.0 * v_dot_h) - view.v;
    let lz = max(l.z, 0.0);
    let shadowing = 2.0 * lz / max(lz * view.masking + steradian_ggx_stretched_length(l, view.ax, view.ay), steradian_smallest_divisor());
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
fn steradian_ggx_cubature_begin(view: SteradianGgxView, e: vec3f, smith: f32, facing: f32) -> SteradianGgxCubature {
    var c: SteradianGgxCubature;
    let inward = e * facing;
    let length2 = dot(inward, inward);
    let usable = length2 > steradian_smallest_square();
    c.view = view;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, steradian_smallest_square())), usable);
    c.amount = select(0.0, steradian_ggx_unshadowed(view, inward), usable);
    c.extent = sqrt(length2);
    c.smith = smith;
    c.facing = facing;
    c.weight = 0.0;
    c.centre_weight = 0.0;
    c.weighted = vec2f(0.0, 0.0);
    c.at_centre = steradian_ggx_shadowing_and_fresnel(view, c.centre, smith);
    c.lowest = c.at_centre;
    c.highest = c.at_centre;
    return c;
}

// Adds one node.
//
//   u        unit direction in stretched half vector space
//   weight   0 for a lane that does not have this node
fn steradian_ggx_cubature_add(c: SteradianGgxCubature, u: vec3f, weight: f32) -> SteradianGgxCubature {
    var next = c;
    let o = weight * max(dot(c.view.w, u), 0.0);
    let g = steradian_ggx_shadowing_and_fresnel(c.view, u, c.smith);
    let counts = abs(o) > 0.0;
    next.weight = c.weight + o;
    next.weighted = c.weighted + g * o;
    next.lowest = select(c.lowest, vec2f(min(c.lowest.x, g.x), min(c.lowest.y, g.y)), counts);
    next.highest = select(c.highest, vec2f(max(c.highest.x, g.x), max(c.highest.y, g.y)), counts);
    return next;
}

// Node j of the rule with n nodes, n differing from lane to lane in 1 to `most`, at most 6: vec2(node, weight), weight 0 from j = n on.
fn steradian_ggx_rule(n: f32, j: i32, most: i32) -> vec2f {
    var r = steradian_gauss_legendre_node(1, j);
    for (var k: i32 = 2; k <= most; k++) {
        r = select(r, steradian_gauss_legendre_node(k, j), n > f32(k) - 0.5);
    }
    return r;
}

// Adds the nodes of one edge.
//
//   extra    more nodes along the edge than its angle asks for, and always the finer rule inwards: 0 is normal, 2 high quality
//
// Along the edge: 1 to 4 nodes for angles up to 0.25, 0.8, 1.6 and beyond. Inwards, in cos: three rules for a fan triangle,
// exact to degree 2 (with the centre and 2/3), 4 (with the centre and two more: Radau's), the finer from 0.5 on, and 8 (with four
// more) where a rough lobe sees a large light: there the horizon, at which shadowing ends, is among what is averaged.
fn steradian_ggx_cubature_edge(c: SteradianGgxCubature, edge: SteradianConicArc, extra: i32) -> SteradianGgxCubature {
    var next = c;
    let total = edge.sweep.x + edge.sweep.y;
    let n = 1.0 + select(1.0, 0.0, total < 0.25) + select(1.0, 0.0, total < 0.8) + select(1.0, 0.0, total < 1.6) + f32(extra);
    var fine = total >= 0.5;
    if (extra > 0) {
        fine = total > -1.0;
    }
    let wide = c.extent > 0.3 && max(c.view.ax, c.view.ay) > 0.08;
    for (var j: i32 = 0; j < 4 + extra; j++) {
        let present = n > f32(j) + 0.5 && total > 0.0;
        let rule = steradian_ggx_rule(n, j, 4 + extra);
        let node = steradian_conic_node(edge, rule.x);
        let u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
        let du = edge.u1 + edge.u2 * (2.0 * node.tau);
        let inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
        let rim = u * sqrt(inverse2);
        let rim_cosine = dot(rim, c.centre);
        let out_of_centre = rim - c.centre * rim_cosine;
        let outward = out_of_centre * inverseSqrt(max(dot(out_of_centre, out_of_centre), steradian_smallest_divisor()));
        var om = dot(c.centre, cross(u, du)) * (c.facing * inverse2 * rule.y * total / node.density)
            / (1.0 + max(rim_cosine, -0.9));  // solid angle of the fan
        om = select(0.0, om, present);

        next.centre_weight = next.centre_weight + om * select(select(0.25, 0.111111111111111111, fine), 0.04, wide);
        var turns: i32 = 1;
        if (fine && present) {
            turns = 2;
        }
        if (wide && present) {
            turns = 4;
        }
        for (var k: i32 = 0; k < turns; k++) {
            var share = select(select(0.666666666666666667, 0.355051025721682190, fine), 0.139759864343780571, wide);
            var share_weight = select(select(0.75, 0.512485826188421615, fine), 0.223103901083570916, wide);
            if (k == 1) {
                share = select(0.844948974278317810, 0.416409567631083166, wide);
                share_weight = select(select(0.0, 0.376403062700467274, fine), 0.311826522975741250, wide);
            }
            if (k == 2) {
                share = 0.723156986361876117;
                share_weight = select(0.0, 0.281356015149461949, wide);
            }
            if (k == 3) {
                share = 0.942895803885482318;
                share_weight = select(0.0, 0.143713560791225886, wide);
            }
            next = steradian_ggx_cubature_add(next, steradian_fan_place(c.centre, outward, rim_cosine, share), om * share_weight);
            // At the end, here and below, as in steradian_conic_polish_poles.
            if (k + 1 == turns) {
                break;
            }
        }
        if (!(present && n > f32(j) + 1.5)) {
            break;
        }
    }
    return next;
}

// Limits what leaves: with shadowing no lobe sends more than it gets.
//
//   mean     means of (G2, G2 (1 - v.h)^5)
fn steradian_ggx_limited(amount: f32, mean: vec2f, smith: f32) -> vec2f {
    var whole = amount * mean.x;
    whole = select(whole, min(whole, 1.0), smith > 0.5);
    return vec2f(whole, clamp(amount * mean.y, 0.0, whole));
}

// Ends the second walk.
//
//   returns  radiance for radiance 1 as two numbers for steradian_ggx_radiance: with F = 1, and with F = (1 - v.h)^5
//
// Degenerate: weights that cancel leave the centre's value.
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel".
fn steradian_ggx_cubature_finish(c: SteradianGgxCubature) -> vec2f {
    // The centre's values are known all along, its weight only now.
    let o = c.centre_weight * max(dot(c.view.w, c.centre), 0.0);
    let weight = c.weight + o;
    let usable = weight > 1.0e-9 * c.extent;
    let scale = 1.0 / select(1.0, weight, usable);
    var mean = (c.weighted + c.at_centre * o) * scale;
    mean = vec2f(clamp(mean.x, c.lowest.x, c.highest.x), clamp(mean.y, c.lowest.y, c.highest.y));
    mean = select(c.at_centre, mean, usable);
    return steradian_ggx_limited(c.amount, mean, c.smith);
}

// Shadowing and Fresnel at the centre only: one walk. Arguments as steradian_ggx_cubature_begin, result as steradian_ggx_cubature_finish.
fn steradian_ggx_draft(view: SteradianGgxView, e: vec3f, smith: f32, facing: f32) -> vec2f {
    let c = steradian_ggx_cubature_begin(view, e, smith, facing);
    return steradian_ggx_limited(c.amount, c.at_centre, smith);
}

// Radiance of one channel, for radiance 1.
//
//   r        of steradian_ggx_cubature_finish or steradian_ggx_draft
//   f0, f90  Schlick's reflectances
fn steradian_ggx_radiance(r: vec2f, f0: f32, f90: f32) -> f32 {
    return f0 * (r.x - r.y) + f90 * r.y;
}

// ==== half_vector ====

// Lobes of half vectors by edge splitting: a light's edge is split into arcs, each arc's image in half vector space is
// replaced by the great circle between its ends, along which the lobe's integral is closed, and what lies between the two
// is a sliver so thin that a few nodes along it serve.
//
// For lobes that have no closed form along the image itself (Blinn-Phong, Beckmann); GGX for comparison with
// ggx_closed_form.glsl. The arcs go where the edge passes the lobe: the poles of the GGX lobe of the same width say where.
//
//   SteradianConicArc edge = steradian_ggx_edge(view, a, b);
//   SteradianHalfVectorWalk walk = steradian_half_vector_begin(view, edge);
//   for j in 1 .. count:
//       walk = steradian_half_vector_next(walk, view, edge, steradian_half_vector_split_pole_mapped(edge, j / count))
//       sum of steradian_blinn_phong_arc or steradian_beckmann_arc from walk.a to walk.b, then steradian_half_vector_radiance; of steradian_ggx_arc, then steradian_ggx_draft
//       and of the lobe at each steradian_half_vector_node times its solid angle
//
// Frame and order: as ggx_closed_form.glsl.

// The GGX width whose lobe is as wide as Blinn-Phong's of exponent n: both have the mean squared slope 2 / (n + 2).
fn steradian_blinn_phong_alpha(n: f32) -> f32 {
    return sqrt(2.0 / (n + 2.0));
}

// Unit half vector at a place of an edge.
fn steradian_half_vector_at(view: SteradianGgxView, edge: SteradianConicArc, tau: f32) -> vec3f {
    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    return h * inverseSqrt(max(dot(h, h), steradian_smallest_divisor()));
}

// The place at a share of the edge's angle, seen from the surface: equal arcs on the light.
fn steradian_half_vector_split_uniform(edge: SteradianConicArc, share: f32) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    let u = steradian_complex_unit(first + share * (last - first));
    return clamp(u.y / max(u.x * edge.scale, steradian_smallest_length()), edge.begin, edge.end);
}

// The place at a share of the angle C under which the poles see the edge, plus 0.3 for the edge's own length: arcs where
// the edge passes the lobe, and some for the rest.
//
// Newton's steps where they halve what is left, else the middle of a bracket: 5 or 6 as a rule, 24 at most; to the last
// digits, since a light that is thin, or seen edge-on, is what two edges leave of each other's errors: both must be split
// at the same places.
// Source: this project; the share 0.3 keeps arcs for where the lobe is dim (table in docs/theory/ggx.md).
fn steradian_half_vector_split_pole_mapped(edge: SteradianConicArc, share: f32) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    let weight = 0.3 / max(last - first, 1.0e-12);
    let total = edge.sweep.x + edge.sweep.y + 0.3;
    let tolerance = 2.0e-6;
    let node = steradian_conic_node(edge, share);
    var tau = node.tau;
    var low = edge.begin;
    var high = edge.end;
    var left = total;
    var off = edge.end > edge.begin;
    for (var i: i32 = 0; i < 24; i++) {
        if (off) {
            let t = edge.scale * tau;
            let value = steradian_conic_sweep(edge.z1, edge.begin, tau) + steradian_conic_sweep(edge.z2, edge.begin, tau)
                + weight * (steradian_trig_atan2(t, 1.0) - first) - share * total;
            let x1 = tau - edge.z1.x;
            let x2 = tau - edge.z2.x;
            let slope = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
                + weight * edge.scale / (1.0 + t * t);
            low = select(low, tau, value < 0.0);
            high = select(tau, high, value < 0.0);
            let next = tau - value / slope;
            let fast = next > low && next < high && abs(value) < 0.5 * left;
            off = off && abs(value) > tolerance * total;
            left = abs(value);
            tau = select(tau, select(0.5 * (low + high), next, fast), off);
        }
    }
    return tau;
}

// Weight of the edge's own angle in steradian_half_vector_split_pole_mapped, per radian.
fn steradian_half_vector_split_weight(edge: SteradianConicArc) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    return 0.3 / max(last - first, 1.0e-12);
}

// A place of an edge with how dense steradian_half_vector_split_pole_mapped lays its places there.
//
//   weight   steradian_half_vector_split_weight
fn steradian_half_vector_split_end(edge: SteradianConicArc, tau: f32, weight: f32) -> SteradianConicNode {
    let t = edge.scale * tau;
    let x1 = tau - edge.z1.x;
    let x2 = tau - edge.z2.x;
    var node: SteradianConicNode;
    node.tau = tau;
    node.density = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
        + weight * edge.scale / (1.0 + t * t);
    return node;
}

// A node in the sliver between a great circle and the image that it stands for.
//   h            unit half vector, half way between them
//   solid_angle  positive where the image lies outside the great circle, negative inside [sr]
struct SteradianHalfVectorNode {
    h: vec3f,
    solid_angle: f32,
}

// One node of the sliver between an arc's image and the great circle between its ends.
//
//   first, last steradian_half_vector_split_end of the arc's ends
//   a, b     steradian_half_vector_at of the same
//   rule     node and weight of a rule on [0, 1]: steradian_gauss_legendre_node
//
// The image's point x and its foot on the great circle of normal n are n g apart, g = n.x; swept along the arc, what lies
// between them has the solid angle -g n.(x dx) / |x|^3 at the middle. In tau the nodes lie by the map of ends to ends that is
// a quotient of lines and has the slopes of the splits: dense where the arc passes the lobe.
// Degenerate: an arc of no length has no sliver.
// Error: of the rule, with four nodes a tenth to a hundredth of what the great circle alone is off; docs/measured/accuracy.md, "Half vectors".
// Source: this project.
fn steradian_half_vector_between(view: SteradianGgxView, edge: SteradianConicArc, first: SteradianConicNode, last: SteradianConicNode, a: vec3f, b: vec3f, rule: vec2f) -> SteradianHalfVectorNode {
    let bend = sqrt(first.density / max(last.density, steradian_smallest_divisor()));
    let bottom = 1.0 / (rule.x + bend * (1.0 - rule.x));
    let length = last.tau - first.tau;
    let tau = first.tau + length * rule.x * bottom;
    let step = length * bend * bottom * bottom * rule.y;

    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let du = edge.u1 + edge.u2 * (2.0 * tau);
    var x = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    let dx = vec3f(view.ax * du.x, view.ay * du.y, du.z);
    let inverse = inverseSqrt(max(dot(x, x), steradian_smallest_divisor()));
    x = x * inverse;
    var n = cross(a, b - a);
    let n2 = dot(n, n);
    n = n * inverseSqrt(max(n2, steradian_smallest_square()));
    let apart = dot(n, x - a);
    let middle = x - n * (0.5 * apart);
    let shorter = inverseSqrt(max(dot(middle, middle), steradian_smallest_divisor()));
    let sweep = dot(n, cross(x, dx)) * inverse * step;
    var node: SteradianHalfVectorNode;
    node.h = middle * shorter;
    node.solid_angle = select(0.0, -apart * sweep * (shorter * shorter * shorter), n2 > steradian_smallest_square());
    return node;
}

// A walk over the arcs of an edge.
//   weight       steradian_half_vector_split_weight
//   first, last  steradian_half_vector_split_end of the last arc's ends
//   a, b         steradian_half_vector_at of the same
struct SteradianHalfVectorWalk {
    weight: f32,
    first: SteradianConicNode,
    last: SteradianConicNode,
    a: vec3f,
    b: vec3f,
}

// The walk before the first arc.
fn steradian_half_vector_begin(view: SteradianGgxView, edge: SteradianConicArc) -> SteradianHalfVectorWalk {
    var walk: SteradianHalfVectorWalk;
    walk.weight = steradian_half_vector_split_weight(edge);
    walk.last = steradian_half_vector_split_end(edge, edge.begin, walk.weight);
    walk.b = steradian_half_vector_at(view, edge, edge.begin);
    walk.first = walk.last;
    walk.a = walk.b;
    return walk;
}

// Goes on to the arc that ends at tau.
fn steradian_half_vector_next(walk: SteradianHalfVectorWalk, view: SteradianGgxView, edge: SteradianConicArc, tau: f32) -> SteradianHalfVectorWalk {
    var next = walk;
    next.first = walk.last;
    next.a = walk.b;
    next.last = steradian_half_vector_split_end(edge, tau, walk.weight);
    next.b = steradian_half_vector_at(view, edge, tau);
    return next;
}

// Number of nodes of an arc's sliver: three have four to ten times the error (docs/measured/accuracy.md, "Half vectors").
fn steradian_half_vector_nodes() -> i32 { return 4; }

// Node i of the last arc's sliver.
fn steradian_half_vector_node(walk: SteradianHalfVectorWalk, view: SteradianGgxView, edge: SteradianConicArc, i: i32) -> SteradianHalfVectorNode {
    let rule = steradian_gauss_legendre_node(steradian_half_vector_nodes(), i);
    return steradian_half_vector_between(view, edge, walk.first, walk.last, walk.a, walk.b, rule);
}

// Blinn-Phong's lobe at a half vector, in the unit of steradian_blinn_phong_arc for each steradian of half vectors.
//
//   h        unit
fn steradian_blinn_phong_at_half_vector(h: vec3f, v: vec3f, n: f32) -> f32 {
    return 2.0 * steradian_pi() * steradian_blinn_phong_distribution(h, n) * max(dot(h, v), 0.0);
}

// Beckmann's lobe at a half vector, in the unit of steradian_beckmann_arc for each steradian of half vectors.
fn steradian_beckmann_at_half_vector(view: SteradianGgxView, h: vec3f) -> f32 {
    return 2.0 * steradian_pi() * steradian_beckmann_distribution(h, view.ax, view.ay) * max(dot(h, view.v), 0.0);
}

// The measure of GGX at a half vector, in the unit of steradian_ggx_arc for each steradian of half vectors.
fn steradian_ggx_at_half_vector(view: SteradianGgxView, h: vec3f) -> vec3f {
    let u = vec3f(h.x / view.ax, h.y / view.ay, h.z);
    let inverse2 = 1.0 / dot(u, u);
    return u * ((inverse2 / view.ax) * (inverse2 / view.ay));
}

// One arc's share of Blinn-Phong: 2 pi v_z times the radiance, exact along the great circle.
//
//   a, b     unit half vectors of the arc's ends, in walk order
//   v        unit view
//   n        exponent, at least 0
//
// (n + 2) / (2 pi) h_z^n (v.h) is a double-axis moment, of axes z and v.
fn steradian_blinn_phong_arc(a: vec3f, b: vec3f, v: vec3f, n: f32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = steradian_moment_edge(a, b, z);
    let front = steradian_moment_quadrature_front(edge, max(n, 1.0e-6) - 1.0);
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front.moment), front.power);
}

// One arc's share of Blinn-Phong as in steradian_blinn_phong_arc, by the cosine series and the error function instead of quadrature.
//
//   series   of exponent n - 1, or of n + 1 where n < 2
//   range    0 for n >= 8, 1 for 2 <= n < 8, 2 for n < 2; the same for every lane
//
// Error: of the series, see docs/measured/accuracy.md, "phong series".
fn steradian_blinn_phong_arc_approximate(a: vec3f, b: vec3f, v: vec3f, series: SteradianMomentSeries, n: f32, range: i32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = steradian_moment_edge(a, b, z);
    var front = 0.0;
    if (range == 2) {
        front = steradian_moment_series_low_front(edge, series, n - 1.0);
    } else {
        front = steradian_moment_series_front(edge, series);
    }
    var low: i32 = 0;
    if (range > 0) {
        low = 1;
    }
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front), steradian_moment_cosine_front(edge, n, low));
}

// The error function. Error: 1.5e-7 absolute.
// Source: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
fn steradian_beckmann_error_function_approximate(x: f32) -> f32 {
    let t = abs(x);
    let e = 1.0 / (1.0 + 0.3275911 * t);
    let p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    let y = 1.0 - p * exp(-min(t * t, 80.0));
    return select(y, -y, x < 0.0);
}

// The series that steradian_beckmann_arc takes: that of an infinite exponent.
fn steradian_beckmann_series() -> SteradianMomentSeriesHigh {
    var series = steradian_moment_series_high_prepare(1.0e30);
    series.m = 2.0;  // log_c below is the square of the distance
    return series;
}

// One arc's share of Beckmann: 2 pi v_z times the radiance.
//
//   a, b     unit half vectors of the arc's ends, in walk order, above the surface
//   series   steradian_beckmann_series()
//
// In the plane of slopes, divided by the widths, a great circle is a straight line and the lobe exp(-p^2) / pi times
// w.(p, 1): the constant part is Phong's boundary integral at infinite exponent, the linear one an error function.
// Error: of the series; see docs/measured/accuracy.md, "half vector".
fn steradian_beckmann_arc(view: SteradianGgxView, a: vec3f, b: vec3f, series: SteradianMomentSeriesHigh) -> f32 {
    let za = 1.0 / max(a.z, 1.0e-6);
    let zb = 1.0 / max(b.z, 1.0e-6);
    let p = vec2f(a.x * za / view.ax, a.y * za / view.ay);
    let q = vec2f(b.x * zb / view.ax, b.y * zb / view.ay);
    var along = q - p;
    let length2 = dot(along, along);
    let usable = length2 > steradian_smallest_divisor();
    along = along * inverseSqrt(max(length2, steradian_smallest_divisor()));
    let d = p.x * along.y - p.y * along.x;
    let low = dot(p, along);
    let high = dot(q, along);

    var edge: SteradianMomentEdge;
    edge.side = select(1.0, -1.0, d < 0.0);
    edge.s = max(abs(d), 1.0e-6);
    edge.c = 1.0;
    edge.x0 = 1.0;
    edge.y0 = low;
    edge.x1 = 1.0;
    edge.y1 = high;
    edge.log_c = min(edge.s * edge.s, 80.0);
    edge.swept = 0.0;
    let around = steradian_moment_edge_share(edge, steradian_moment_series_high_front(edge, series));
    let across = exp(-edge.log_c) * 0.886226925452758014
        * (steradian_beckmann_error_function_approximate(high) - steradian_beckmann_error_function_approximate(low));
    let share = view.w.z * around + (view.w.y * along.x - view.w.x * along.y) * across;
    return select(0.0, share, usable);
}

// One arc's share of E (ggx_closed_form.glsl) for GGX, exact along the great circle.
fn steradian_ggx_arc(view: SteradianGgxView, a: vec3f, b: vec3f) -> vec3f {
    let p = steradian_polygon_direction(vec3f(a.x / view.ax, a.y / view.ay, a.z));
    let q = steradian_polygon_direction(vec3f(b.x / view.ax, b.y / view.ay, b.z));
    return steradian_polygon_edge(p, q);
}

// Radiance from the sum over the arcs, for radiance 1; not negative.
//
//   facing   1.0; -1.0 where the light is seen from behind
fn steradian_half_vector_radiance(view: SteradianGgxView, sum: f32, facing: f32) -> f32 {
    return max(sum * facing, 0.0) * steradian_inverse_two_pi() / view.v.z;
}

// ==== slopes ====

// Derivatives of integrals over polygonal lights, by the boundary: how the integral changes as an edge moves.
//
// When an edge from a to b moves, the integral changes by the lobe times cosine along the edge times the motion across it:
//
//   d integral = - INT f(l) N.(x da + y db) ds,   l = x a + y b on the edge's part above the horizon, N its plane's unit normal
//
// The horizon, and the arcs of it that close an outline, do not move with the light, and have no term. All derivatives are along the
// edge's normal, so that one number for each end says all:
//
//   derivative by the unit direction a = normal by_start,  by the vertex v_a = normal by_start / |v_a|
//
// No projection is needed, since the normal is across both ends. Where the light is seen from behind, the sum changes its sign.
// Frame and walk order: as polygon.glsl has them. docs/theory/derivatives.md has the derivation.
// Source: Reynolds' transport theorem, applied to the boundary integrals of polygon.glsl, ltc.glsl, moment.glsl and ggx_closed_form.glsl.

// Derivatives of one integral by an edge's ends.
//   normal    of the edge's part, start cross end: not unit
//   by_start, by_end  derivative by the end's unit direction, over the normal
struct SteradianEdgeSlopes {
    normal: vec3f,
    by_start: f32,
    by_end: f32,
}

// The same for two integrals: with F = 1, and with F = (1 - v.h)^5.
//   turn, turn_of_fresnel  INT f (2 (N.h) h - N) ds, N the plane's unit normal: the edge's part of the derivative by the view
struct SteradianEdgeSlopesOfBoth {
    normal: vec3f,
    by_start: vec2f,
    by_end: vec2f,
    turn: vec3f,
    turn_of_fresnel: vec3f,
}

// Irradiance of an edge's part by its own ends, which are not below the horizon.
//
// INT l_z s ds over the arc, l = s start + t end, has the closed form |n| (start_z P + end_z Q) / 2 with F the angle over the sine,
// Q its slope and P = F - c Q.
// Error: opposite ends, where the point lies on the edge, give finite numbers.
fn steradian_edge_irradiance_slopes(start: vec3f, end: vec3f) -> SteradianEdgeSlopes {
    var slopes: SteradianEdgeSlopes;
    slopes.normal = cross(start, end - start);
    let c = dot(start, end);
    let half_angle = steradian_trig_angle_over_sine_and_slope(c, dot(slopes.normal, slopes.normal)) * 0.5;
    let q = half_angle.y;
    let p = half_angle.x - c * q;
    slopes.by_start = -(start.z * p + end.z * q);
    slopes.by_end = -(end.z * p + start.z * q);
    return slopes;
}

// The derivatives by an edge's ends from those by the ends of its part.
fn steradian_edge_slopes_of_whole(part: SteradianEdgePart, of_part: SteradianEdgeSlopes) -> SteradianEdgeSlopes {
    var slopes = of_part;
    if (part.rises || part.sinks) {
        slopes.by_start = part.start_a * of_part.by_start + part.end_a * of_part.by_end;
        slopes.by_end = part.start_b * of_part.by_start + part.end_b * of_part.by_end;
    }
    return slopes;
}

// Derivatives of the irradiance for radiance 1 (steradian_polygon_irradiance) by the ends of one edge.
//
//   part     of steradian_edge_above_horizon: a walk that computes the value has it already (steradian_polygon_add_part)
//
// Degenerate: an edge of no length, or below the horizon, has a normal of 0. Opposite ends, where the point lies on the edge, give
// finite numbers.
// Error: see docs/measured/accuracy.md, "polygon, edge slopes".
fn steradian_polygon_part_slopes(part: SteradianEdgePart) -> SteradianEdgeSlopes {
    return steradian_edge_slopes_of_whole(part, steradian_edge_irradiance_slopes(part.start, part.end));
}

// The same from the ends.
//
//   a, b     unit directions of the ends (steradian_polygon_direction), in walk order
fn steradian_polygon_edge_slopes(a: vec3f, b: vec3f) -> SteradianEdgeSlopes {
    return steradian_polygon_part_slopes(steradian_edge_above_horizon(a, b));
}

// Derivatives of the integral of a linearly transformed cosine (steradian_ltc_integral) by the ends of one edge.
//
//   part       of steradian_ltc_part
//   lobe_part  steradian_edge_above_horizon(part.start, part.end): above the lobe's own horizon
//   returns    derivatives by steradian_ltc_direction(m, a) and steradian_ltc_direction(m, b): the derivative by a is steradian_ltc_edge_transform_back of it
//
// The edges that close the real horizon lie in its image and do not move.
// Degenerate: as steradian_polygon_part_slopes.
// Error: see docs/measured/accuracy.md, "LTC, edge slopes".
fn steradian_ltc_part_slopes(part: SteradianEdgePart, lobe_part: SteradianEdgePart) -> SteradianEdgeSlopes {
    var slopes = steradian_edge_slopes_of_whole(part, steradian_polygon_part_slopes(lobe_part));
    slopes.normal = slopes.normal * steradian_inverse_pi();
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends in the shading frame, in walk order
fn steradian_ltc_edge_slopes(m: SteradianLtcMatrix, a: vec3f, b: vec3f) -> SteradianEdgeSlopes {
    let part = steradian_ltc_part(m, a, b, steradian_ltc_direction(m, a), steradian_ltc_direction(m, b));
    return steradian_ltc_part_slopes(part, steradian_edge_above_horizon(part.start, part.end));
}

// The derivative by v from that by steradian_ltc_direction(m, v): M^-T over the length of M^-1 v.
fn steradian_ltc_edge_transform_back(m: SteradianLtcMatrix, v: vec3f, g: vec3f) -> vec3f {
    let under = steradian_ltc_transform(m, v);
    return steradian_ltc_transform_transposed(m, g * inverseSqrt(max(dot(under, under), steradian_smallest_square())));
}

// Derivatives of the Phong lobe's integral, (n + 1)/(2 pi) times the moment, by the ends of one edge.
//
//   part     of steradian_edge_above_horizon
//   r        unit axis of the lobe, the mirrored view
//   n        exponent, 0 or more
//   low      1 for n < 7, else 0; the same for every lane
//
// On the edge, x = l.r = c cos phi with phi from the foot. So INT x^n l dphi is that of x^(n + 1) towards the foot, and has the
// antiderivative -x^(n + 1)/(n + 1) across it. Edges shorter than two widths of the lobe, in front of its equator, take Gauss and Legendre's
// rule, since a difference of two antiderivatives would lose their digits: its error is 3e-5 at two widths.
// Degenerate: an edge of no length, or behind the lobe's equator, has derivatives of 0.
// Error: see docs/measured/accuracy.md, "Phong, edge slopes"; that of steradian_moment_cosine_front, 4e-5 of the full lobe for n >= 1.
fn steradian_phong_part_slopes(part: SteradianEdgePart, r: vec3f, n: f32, low: i32) -> SteradianEdgeSlopes {
    let sum = part.start + part.end;
    let chord = part.end - part.start;
    let chord2 = dot(chord, chord);
    let sum_inverse = inverseSqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    let chord_inverse = inverseSqrt(max(chord2, steradian_smallest_divisor()));
    // The axis at the part's middle and along it there.
    let axis_middle = dot(r, sum) * sum_inverse;
    let axis_along = dot(r, chord) * chord_inverse;
    let m = n + 1.0;
    // INT f cos t dt and INT f sin t dt, with t from the middle.
    var even = 0.0;
    var odd = 0.0;
    let is_short = chord2 * m < 4.0 && chord2 < 1.0 && dot(r, part.start) > 0.0 && dot(r, part.end) > 0.0;
    if (is_short) {
        let half_tangent = sum_inverse * chord2 * chord_inverse;
        for (var i: i32 = 0; i < 4; i++) {
            let rule = steradian_gauss_legendre_node(4, i);
            let u = half_tangent * (2.0 * rule.x - 1.0);
            let cosine = inverseSqrt(1.0 + u * u);
            let x = (axis_middle + axis_along * u) * cosine;
            let w = 2.0 * half_tangent * rule.y * steradian_phong_power(x, n) * cosine * cosine * cosine;
            even = even + w;
            odd = odd + w * u;
        }
    }
    if (!is_short) {
        let edge = steradian_moment_edge(part.start, part.end, r);
        let towards = steradian_moment_cosine_front(edge, m, low);
        let across = (steradian_phong_power(edge.x0, m) - steradian_phong_power(edge.x1, m)) / m;
        let over_c2 = 1.0 / (edge.c * edge.c);
        even = select((towards * axis_middle - across * axis_along) * over_c2, even, is_short);
        odd = select((towards * axis_along + across * axis_middle) * over_c2, odd, is_short);
    }
    var of_part: SteradianEdgeSlopes;
    of_part.normal = cross(part.start, chord);
    let n2 = dot(of_part.normal, of_part.normal);
    let scale = select(0.0, -m * steradian_inverse_two_pi() * inverseSqrt(max(n2, steradian_smallest_divisor())), n2 > steradian_smallest_divisor());
    even = even * sum_inverse;
    odd = odd * chord_inverse;
    of_part.by_start = (even - odd) * scale;
    of_part.by_end = (even + odd) * scale;
    return steradian_edge_slopes_of_whole(part, of_part);
}

// The same from the ends.
//
//   a, b     unit directions of the ends (steradian_polygon_direction), in walk order
fn steradian_phong_edge_slopes(a: vec3f, b: vec3f, r: vec3f, n: f32, low: i32) -> SteradianEdgeSlopes {
    return steradian_phong_part_slopes(steradian_edge_above_horizon(a, b), r, n, low);
}

// Derivatives of the GGX lobe's integral, with shadowing and Fresnel, by the ends of one edge.
//
//   part     of steradian_edge_above_horizon
//   arc      steradian_ggx_edge(view, part.start, part.end): an edge whose value was computed has it already
//   smith    1 with shadowing, 0 without
//   nodes, pieces  Gauss and Legendre's nodes (1 to 6, or 8) in each of so many equal pieces of the poles' angle
//
// Only the lobe along the edge counts, so that shadowing and Fresnel are exact here but for the rule. 4 nodes serve packs, 6 single values.
// Degenerate: an edge of no length has derivatives of 0.
// Error: see docs/measured/accuracy.md, "GGX, edge slopes"; with 6 nodes 4.0e-3 of the light's largest derivative at the 99th percentile.
fn steradian_ggx_edge_slopes_of_part(view: SteradianGgxView, part: SteradianEdgePart, arc: SteradianConicArc, smith: f32, nodes: i32, pieces: i32) -> SteradianEdgeSlopesOfBoth {
    let sum = part.start + part.end;
    let chord = part.end - part.start;
    let sum_inverse = inverseSqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    let chord_inverse = inverseSqrt(max(dot(chord, chord), steradian_smallest_divisor()));
    // (cosine, sine) of the angle from the part's middle to the place from which tau counts: one of the ends, or the middle.
    let half_cosine = 0.5 / sum_inverse;
    let half_sine = 0.5 / chord_inverse;
    let from_start = !(arc.begin < 0.0);
    let from_end = !(arc.end > 0.0);
    let base = vec2f(select(1.0, half_cosine, from_start || from_end), select(select(0.0, half_sine, from_end), -half_sine, from_start));
    let n = cross(part.start, chord);
    let across = n * inverseSqrt(max(dot(n, n), steradian_smallest_divisor()));
    var even = vec2f(0.0, 0.0);
    var odd = vec2f(0.0, 0.0);
    var turn = vec3f(0.0, 0.0, 0.0);
    var turn_of_fresnel = vec3f(0.0, 0.0, 0.0);
    let total = arc.sweep.x + arc.sweep.y;
    let share = 1.0 / f32(pieces);
    for (var i: i32 = 0; i < pieces; i++) {
        for (var j: i32 = 0; j < nodes; j++) {
            let rule = steradian_gauss_legendre_node(nodes, j);
            let node = steradian_conic_node(arc, (rule.x + f32(i)) * share);
            let u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
            let p = vec3f(u.x * view.ax, u.y * view.ay, u.z);  // (l + v) times a positive factor
            let p2 = max(dot(p, p), steradian_smallest_divisor());
            let along = dot(p, view.v);
            let u2 = max(dot(u, u), steradian_smallest_divisor());
            let l = p * (2.0 * along / p2) - view.v;
            let g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
            let w = (p2 / u2) * (along / u2) * g * rule.y * share * total / max(node.density, steradian_smallest_divisor());
            let p_inverse = inverseSqrt(p2);
            let both = vec2f(w, w * steradian_fresnel_schlick(0.0, 1.0, along * p_inverse));
            let h = p * p_inverse;
            let moved = h * (2.0 * dot(across, h)) - across;
            turn = turn + moved * both.x;
            turn_of_fresnel = turn_of_fresnel + moved * both.y;
            // l = even (start + end) + odd (end - start), by its angle from the middle: from l itself, a short edge in float would lose
            // the digits of `odd`.
            let t = node.tau * arc.scale;
            let d = 1.0 / (1.0 + t * t);
            let angle = steradian_complex_product(base, vec2f((1.0 - t * t) * d, 2.0 * t * d));
            even = even + both * (angle.x * sum_inverse);
            odd = odd + both * (angle.y * chord_inverse);
        }
    }
    var density = arc.scale * steradian_inverse_pi() / (view.ax * view.ay * view.v.z);
    density = select(0.0, density, arc.end > arc.begin);
    let scale = -density * inverseSqrt(max(dot(n, n), steradian_smallest_divisor()));
    let by_part_start = (even - odd) * scale;
    let by_part_end = (even + odd) * scale;
    var slopes: SteradianEdgeSlopesOfBoth;
    slopes.normal = n;
    slopes.by_start = by_part_start * part.start_a + by_part_end * part.end_a;
    slopes.by_end = by_part_start * part.start_b + by_part_end * part.end_b;
    slopes.turn = turn * density;
    slopes.turn_of_fresnel = turn_of_fresnel * density;
    return slopes;
}

// The same from the ends.
//
//   a, b     unit directions of the ends (steradian_polygon_direction), in walk order
fn steradian_ggx_edge_slopes(view: SteradianGgxView, a: vec3f, b: vec3f, smith: f32, nodes: i32, pieces: i32) -> SteradianEdgeSlopesOfBoth {
    let part = steradian_edge_above_horizon(a, b);
    return steradian_ggx_edge_slopes_of_part(view, part, steradian_ggx_edge(view, part.start, part.end), smith, nodes, pieces);
}

// ======== comparison: methods of the literature that ours are compared with ========

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
fn steradian_ltc_clipped_sphere(cosine: f32, f: f32) -> f32 {
    let z = clamp(cosine, -1.0, 1.0);
    let s2 = clamp(f, 1.0e-12, 1.0);
    let sin_w = sqrt(max(1.0 - z * z, steradian_smallest_divisor()));
    let cos_s = sqrt(1.0 - s2);
    let crossed = z * z < s2;
    // The rim meets the horizon at the azimuth whose sine and cosine are x and y.
    let x = clamp(cos_s / sin_w, 0.0, 1.0);
    let y = sqrt(max(1.0 - x * x, 0.0));
    let root = sqrt(max(s2 - y * y, 0.0));
    let arc = steradian_trig_atan2(y, x) + x * y - 2.0 * sin_w * cos_s * y;
    let rim = abs(z) * (y * root + s2 * steradian_trig_atan2(y, root));
    let whole = steradian_pi() * s2 * max(z, 0.0);
    let cut = select(whole, whole + arc - rim, crossed);
    return clamp(cut / (steradian_pi() * s2), 0.0, 1.0);
}

// Adds one edge to the irradiance vector under M^-1 [rad].
//
//   ta, tb   steradian_ltc_direction of the edge's ends, in walk order
fn steradian_ltc_clipless_add_edge(sum: vec3f, ta: vec3f, tb: vec3f) -> vec3f {
    return sum + steradian_polygon_edge(ta, tb);
}

// Integral of the lobe over the light, approximately, in [0, 1].
//
//   sum      of steradian_ltc_clipless_add_edge, begun at zero
//   reversed true where the light is seen from behind
fn steradian_ltc_clipless_integral(sum: vec3f, reversed: bool) -> f32 {
    let e = sum * select(1.0, -1.0, reversed);
    let e2 = dot(e, e);
    let inverse = inverseSqrt(max(e2, steradian_smallest_square()));
    let form_factor = clamp(e2 * inverse * steradian_inverse_pi(), 0.0, 1.0);
    return form_factor * steradian_ltc_clipped_sphere(clamp(e.z * inverse, -1.0, 1.0), form_factor);
}

// ==== moment_arvo ====

// The Phong lobe's boundary integral by Arvo's recurrence: exact for integer n, in n/2 steps an edge.
//
// (1 - x^m)/(1 - x^2) is the finite sum of x^k over every other k below m: 1 + x^2 + ... for even m. For odd m one
// factor x is taken out first, (x - x^m)/(1 - x^2) = x + x^3 + ..., and the rest, 1/(1 + x), integrates to half the
// angle of a spherical triangle. Each power integrates by parts from the last but one.
// Source: Arvo 1995, sec. 5; Lecocq et al. 2017, eq. 1 to 3, with N = n - 1.

// |s| times the integral of 1/(1 + x) over the part in front: summed over a polygon, its solid angle.
fn steradian_moment_solid_angle_front(edge: SteradianMomentEdge) -> f32 {
    let c0 = edge.c + edge.x0;
    let c1 = edge.c + edge.x1;
    let k = edge.s / (1.0 + edge.c);
    return 2.0 * steradian_trig_atan2(k * (c0 * edge.y1 - c1 * edge.y0), c0 * c1 + k * k * edge.y0 * edge.y1);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   n        integer exponent, at least 1
//   can_stop 1: stop when what is left is below relative_precision of the sum; 0: sum everything. Every lane waits for
//            the slowest: at grazing views, where c is near 1, the stop comes late or never.
//
// Error: see docs/measured/accuracy.md, "phong recurrence"; the recurrence is stable, its factor is below c^2.
fn steradian_moment_arvo_front(edge: SteradianMomentEdge, n: i32, can_stop: i32, relative_precision: f32) -> f32 {
    let odd_m: i32 = 1 - (n - (n / 2) * 2);
    let c2 = edge.c * edge.c;
    let x02 = edge.x0 * edge.x0;
    let x12 = edge.x1 * edge.x1;
    // The integral of x^p, and x^(p+1) y at both ends, which the next step needs.
    var power = steradian_trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
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
        front = front + steradian_moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// ==== moment_peak_fits ====

// The published peak fits of the Phong lobe's boundary integrand: Lorentzian, Lorentzian-Pearson, ellipsoid.
//
// The integrand I = (f - x^m)/(1 - x^2) is a peak over phi with its foot at 0, f = x or f = 1: the paper takes x for even n
// and 1 otherwise, but each serves every n.
// Each fit is a peak P with an antiderivative, scaled to I's largest and smallest value and to its value at the half
// width x_w; the blends also meet I at a place in the tail. For comparison with moment_series.glsl, which is both
// faster and closer. Corrected against the paper where its prints do not hold (docs/theory/moments.md lists the places).
// Source: Lecocq, Dufay, Sourimant, Marvie, "Analytic approximations for real-time area light shading", 2017,
// eq. 5 to 16; its order N is n - 1 here.

// The values that the fits share for one edge.
//   x_w, x_t     half width and the place in the tail [rad]
//   ratio_w      x_w over its limit for c -> 0
//   peak         I at the foot, less its smallest value
//   y_w, y_t     the same at x_w and x_t, over peak
//   smallest     I at phi = pi/2: 0 for f = x, 1 for f = 1
//   phi0, phi1   ends of the part in front [rad]
struct SteradianMomentPeak {
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
fn steradian_moment_peak_cosine(x: f32) -> f32 {
    let t = x * x;
    return 1.0 - t / 2.0 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0 * (1.0 - t / 132.0 * (1.0 - t / 182.0))))));
}

// Sine for |x| <= pi/2: Taylor, the next term is x^15/15!, 7e-10 at pi/2.
fn steradian_moment_peak_sine(x: f32) -> f32 {
    let t = x * x;
    return x * (1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0 * (1.0 - t / 156.0))))));
}

// I less its smallest value, at x = c cos phi. f = x: x (1 - x^n)/(1 - x^2); f = 1: x^2 (1 - x^(n-1))/(1 - x^2).
//
//   f_is_x   1 for f = x, 0 for f = 1
fn steradian_moment_peak_height(s2: f32, c2: f32, n: f32, f_is_x: i32, cosine: f32, sine: f32) -> f32 {
    let rest = s2 + c2 * sine * sine;  // 1 - x^2 without cancellation
    let x2 = max(c2 * cosine * cosine, 1.0e-12);
    let log_x = 0.5 * steradian_moment_log_1_plus(rest / x2);
    if (f_is_x == 1) {
        return sqrt(x2) * steradian_moment_1_minus_exp(n * log_x) / rest;
    }
    return x2 * steradian_moment_1_minus_exp((n - 1.0) * log_x) / rest;
}

// The half width by the paper's fit, over its limit for c -> 0 (pi/3 for f = x, pi/4 for f = 1).
//
// Error: up to 17 % (f = x) and 32 % (f = 1, n = 5000), 4 to 8 % on the average.
// Source: eq. 7, with pi/4 outside the power.
fn steradian_moment_peak_half_width_ratio(c: f32, n: f32, f_is_x: i32) -> f32 {
    if (f_is_x == 1) {
        let reduced = c - c / max(n - 1.0, 1.0);
        return sqrt(max(1.0 - reduced * reduced, 1.0e-8));
    }
    let k = max(c - c / max(n - 2.0, 1.0), 1.0e-6);
    return steradian_phong_power(max(1.0 - steradian_phong_power(k, 2.5), 1.0e-8), 0.45);
}

// The values that the fits share for one edge and a lobe of exponent n.
fn steradian_moment_peak_prepare(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> SteradianMomentPeak {
    let s2 = edge.s * edge.s;
    let c2 = edge.c * edge.c;
    var widest = 0.785398163397448310;
    var p: SteradianMomentPeak;
    p.smallest = 1.0;
    if (f_is_x == 1) {
        widest = 1.04719755119659775;
        p.smallest = 0.0;
    }
    p.ratio_w = steradian_moment_peak_half_width_ratio(edge.c, n, f_is_x);
    p.x_w = widest * p.ratio_w;
    let k = 1.0 - p.ratio_w;  // eq. 14: its twelfth power
    let k2 = k * k;
    let k4 = k2 * k2;
    p.x_t = min(p.x_w + 0.3946 * widest * (1.0 - k4 * k4 * k4), 1.57079632679489662);
    p.peak = steradian_moment_peak_height(s2, c2, n, f_is_x, 1.0, 0.0);
    let scale = 1.0 / max(p.peak, 1.0e-12);
    p.y_w = scale * steradian_moment_peak_height(s2, c2, n, f_is_x, steradian_moment_peak_cosine(p.x_w), steradian_moment_peak_sine(p.x_w));
    p.y_t = scale * steradian_moment_peak_height(s2, c2, n, f_is_x, steradian_moment_peak_cosine(p.x_t), steradian_moment_peak_sine(p.x_t));
    p.y_w = clamp(p.y_w, 0.01, 0.99);
    p.phi0 = steradian_trig_atan2(edge.y0, edge.x0);
    p.phi1 = steradian_trig_atan2(edge.y1, edge.x1);
    return p;
}

// A peak scaled to 1 at the foot and 0 at pi/2.
//   integral  over the part in front
//   tail      its value at x_t
struct SteradianMomentFit {
    integral: f32,
    tail: f32,
}

// The scaled peak from a peak's integral, its value at the tail's place and its value at pi/2; at the foot it is 1.
fn steradian_moment_fit_scaled(p: SteradianMomentPeak, integral: f32, tail: f32, lowest: f32) -> SteradianMomentFit {
    let scale = 1.0 / (1.0 - lowest);
    var fit: SteradianMomentFit;
    fit.integral = scale * (integral - lowest * (p.phi1 - p.phi0));
    fit.tail = scale * (tail - lowest);
    return fit;
}

// Width parameter of the Lorentzian. Source: eq. 11. Kept above 1.0e-3, where the scaled peak is its limit.
fn steradian_moment_lorentzian_width(p: SteradianMomentPeak) -> f32 {
    let x2 = p.x_w * p.x_w;
    return max((1.0 - p.y_w - 0.405284734569351086 * x2) / (p.y_w * x2), 1.0e-3);
}

// The Lorentzian peak 1/(1 + a phi^2). Source: eq. 11 and 12.
fn steradian_moment_fit_lorentzian(p: SteradianMomentPeak) -> SteradianMomentFit {
    let a = steradian_moment_lorentzian_width(p);
    let root = sqrt(a);
    let integral = steradian_trig_atan2(root * (p.phi1 - p.phi0), 1.0 + a * p.phi0 * p.phi1) / root;
    return steradian_moment_fit_scaled(p, integral, 1.0 / (1.0 + a * p.x_t * p.x_t), 1.0 / (1.0 + a * 2.46740110027233966));
}

// The peak of Pearson VII: (1 + b phi^2)^-2 with b = a/2.
fn steradian_moment_fit_pearson(p: SteradianMomentPeak) -> SteradianMomentFit {
    let b = 0.5 * steradian_moment_lorentzian_width(p);
    let root = sqrt(b);
    let angle = steradian_trig_atan2(root * (p.phi1 - p.phi0), 1.0 + b * p.phi0 * p.phi1);
    let ends = p.phi1 / (1.0 + b * p.phi1 * p.phi1) - p.phi0 / (1.0 + b * p.phi0 * p.phi0);
    let t = 1.0 / (1.0 + b * p.x_t * p.x_t);
    let l = 1.0 / (1.0 + b * 2.46740110027233966);
    return steradian_moment_fit_scaled(p, 0.5 * (ends + angle / root), t * t, l * l);
}

// A width of exactly 1 is a constant peak, 0/0 when scaled: kept 4e-3 away.
fn steradian_moment_fit_not_one(a: f32) -> f32 {
    return select(a, 1.004, abs(a - 1.0) < 0.004);
}

// Width parameter of the ellipsoid. Source: eq. 15.
fn steradian_moment_ellipsoid_width(p: SteradianMomentPeak) -> f32 {
    let cosine = steradian_moment_peak_cosine(p.x_w);
    let sine = steradian_moment_peak_sine(p.x_w);
    return p.y_w * sine * sine / (cosine * cosine * (1.0 - p.y_w));
}

// The ellipsoid peak a/(1 + (a - 1) cos^2 phi). Source: eq. 15 and 16.
fn steradian_moment_fit_ellipsoid(edge: SteradianMomentEdge, p: SteradianMomentPeak) -> SteradianMomentFit {
    let a = steradian_moment_fit_not_one(steradian_moment_ellipsoid_width(p));
    let root = sqrt(a);
    let cosine = steradian_moment_peak_cosine(p.x_t);
    let integral = root * steradian_moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    return steradian_moment_fit_scaled(p, integral, a / (1.0 + (a - 1.0) * cosine * cosine), a);
}

// The squared ellipsoid peak (b/(1 + (b - 1) cos^2 phi))^2.
fn steradian_moment_fit_ellipsoid_squared(edge: SteradianMomentEdge, p: SteradianMomentPeak) -> SteradianMomentFit {
    let b = steradian_moment_fit_not_one(steradian_moment_ellipsoid_width(p) * (2.1 + 1.28 * p.ratio_w));
    let root = sqrt(b);
    let cosine = steradian_moment_peak_cosine(p.x_t);
    let e0 = edge.x0 * edge.y0 / max(b * edge.x0 * edge.x0 + edge.y0 * edge.y0, steradian_smallest_divisor());
    let e1 = edge.x1 * edge.y1 / max(b * edge.x1 * edge.x1 + edge.y1 * edge.y1, steradian_smallest_divisor());
    let angle = steradian_moment_angle(root, edge.x0, edge.y0, edge.x1, edge.y1);
    let integral = 0.5 * root * (b + 1.0) * angle - 0.5 * b * (b - 1.0) * (e1 - e0);
    let t = b / (1.0 + (b - 1.0) * cosine * cosine);
    return steradian_moment_fit_scaled(p, integral, t * t, b * b);
}

// Blend of a peak with too heavy a tail and one with too light a tail, so that the blend meets I in the tail.
//
// Source: eq. 13, clamped: its denominator vanishes where the two meet.
fn steradian_moment_fit_blended(p: SteradianMomentPeak, heavy: SteradianMomentFit, light: SteradianMomentFit) -> SteradianMomentFit {
    let d = light.tail - heavy.tail;
    var alpha = (light.tail - p.y_t) / select(max(d, 1.0e-12), min(d, -1.0e-12), d < 0.0);
    alpha = clamp(alpha, 0.0, 1.0);
    var fit: SteradianMomentFit;
    fit.integral = alpha * heavy.integral + (1.0 - alpha) * light.integral;
    fit.tail = alpha * heavy.tail + (1.0 - alpha) * light.tail;
    return fit;
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front, from a fit.
//
// Degenerate: a peak below 1e-12 (n = 1) leaves the smallest value alone.
fn steradian_moment_fit_front(edge: SteradianMomentEdge, p: SteradianMomentPeak, fit: SteradianMomentFit, f_is_x: i32) -> f32 {
    let peak = select(0.0, p.peak * fit.integral, p.peak > 1.0e-12);
    var front = edge.s * (peak + p.smallest * (p.phi1 - p.phi0));
    if (f_is_x == 1) {
        front = front + steradian_moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}

// The Lorentzian for one edge. Error: see docs/measured/accuracy.md, "phong peak fits".
fn steradian_moment_lorentzian_front(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> f32 {
    let p = steradian_moment_peak_prepare(edge, n, f_is_x);
    return steradian_moment_fit_front(edge, p, steradian_moment_fit_lorentzian(p), f_is_x);
}

// The blend of Lorentzian and Pearson VII for one edge.
fn steradian_moment_pearson_front(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> f32 {
    let p = steradian_moment_peak_prepare(edge, n, f_is_x);
    let fit = steradian_moment_fit_blended(p, steradian_moment_fit_lorentzian(p), steradian_moment_fit_pearson(p));
    return steradian_moment_fit_front(edge, p, fit, f_is_x);
}

// The blend of ellipsoid and squared ellipsoid for one edge.
fn steradian_moment_ellipsoid_front(edge: SteradianMomentEdge, n: f32, f_is_x: i32) -> f32 {
    let p = steradian_moment_peak_prepare(edge, n, f_is_x);
    let fit = steradian_moment_fit_blended(p, steradian_moment_fit_ellipsoid(edge, p), steradian_moment_fit_ellipsoid_squared(edge, p));
    return steradian_moment_fit_front(edge, p, fit, f_is_x);
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
struct SteradianRepresentativeWalk {
    turn: f32,
    nearest: vec3f,
    cosine: f32,
}

// A walk with no edge yet.
fn steradian_representative_begin() -> SteradianRepresentativeWalk {
    var walk: SteradianRepresentativeWalk;
    walk.turn = 0.0;
    walk.nearest = vec3f(0.0, 0.0, 1.0);
    walk.cosine = -2.0;  // below any cosine, so that the first edge counts
    return walk;
}

// Adds one edge.
//
//   mirror   unit: the view mirrored at the normal
//   a, b     unit directions of the edge's ends
fn steradian_representative_add_edge(walk: SteradianRepresentativeWalk, mirror: vec3f, a: vec3f, b: vec3f) -> SteradianRepresentativeWalk {
    var next = walk;
    let ca = dot(mirror, a);
    let cb = dot(mirror, b);
    next.turn = walk.turn + steradian_trig_atan2(dot(mirror, cross(a, b)), dot(a, b) - ca * cb);
    // The nearest of the great circle, if it lies between the ends.
    let n = cross(a, b);
    let n2 = max(dot(n, n), steradian_smallest_divisor());
    let p = mirror - n * (dot(mirror, n) / n2);
    let on_circle = p * inverseSqrt(max(dot(p, p), steradian_smallest_divisor()));
    let between = dot(cross(a, p), n) > 0.0 && dot(cross(p, b), n) > 0.0;
    let nearest = select(select(b, a, ca > cb), on_circle, between);
    let cosine = dot(mirror, nearest);
    let better = cosine > walk.cosine;
    next.nearest = select(walk.nearest, nearest, better);
    next.cosine = select(walk.cosine, cosine, better);
    return next;
}

// The direction that stands for the light: the mirror direction if the light holds it, else the nearest of the outline.
fn steradian_representative_direction(walk: SteradianRepresentativeWalk, mirror: vec3f, reversed: bool) -> vec3f {
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
// Error: see docs/measured/accuracy.md, "GGX with shadowing and Fresnel".
fn steradian_representative_radiance(walk: SteradianRepresentativeWalk, view: vec3f, mirror: vec3f, solid_angle: f32, alpha: f32, reversed: bool) -> f32 {
    let l = steradian_representative_direction(walk, mirror, reversed);
    let h = steradian_microfacet_half_vector(l, view);
    let wider = alpha + sqrt(solid_angle * 0.0795774715459476679 / max(dot(view, h), 1.0e-6));
    let fall = alpha / wider;
    return steradian_ggx_lobe(l, view, alpha, alpha) * (fall * fall) * solid_angle;
}

// The half vector's cosine for Fresnel. Arguments as for steradian_representative_radiance.
fn steradian_representative_v_dot_h(walk: SteradianRepresentativeWalk, view: vec3f, mirror: vec3f, reversed: bool) -> f32 {
    let h = steradian_microfacet_half_vector(steradian_representative_direction(walk, mirror, reversed), view);
    return dot(view, h);
}

// ======== plane: light in the plane ========

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
// Error: docs/theory/plane.md, "closed forms"; against quadrature in plane_kernel_test.
fn steradian_plane_power_integral(n: i32, t: f32, f: f32) -> f32 {
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

// Antiderivative of tan(f)^j cos(f)^n, j = 0, 1 or 2. See steradian_plane_power_integral; j = 2 takes n >= -3.
fn steradian_plane_term(j: i32, n: i32, t: f32, f: f32) -> f32 {
    if (j == 0) {
        return steradian_plane_power_integral(n, t, f);
    }
    if (j == 2) {
        return steradian_plane_power_integral(n - 2, t, f) - steradian_plane_power_integral(n, t, f);
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
fn steradian_plane_edge_integral(j: i32, k: i32, t: f32, f: f32, q: f32) -> f32 {
    let w0 = steradian_plane_term(j, k, t, f);
    let w2 = steradian_plane_term(j, k - 2, t, f);
    let w4 = steradian_plane_term(j, k - 4, t, f);
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
fn steradian_plane_disk_window_integral(d2: f32, rho2: f32, d: f32, c: f32, s: f32, psi: f32, chord: f32, beta: f32) -> f32 {
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
fn steradian_plane_root(x: f32) -> f32 {
    return x * inverseSqrt(max(x, steradian_smallest_divisor()));
}

// Arc tangent in the ranges that lights far from a point leave: a polynomial where |m| <= 1 on all lanes.
fn steradian_plane_angle_of_slope(m: f32) -> f32 {
    let q = m * m;
    var angle = m * steradian_trig_atan_over_argument_24_bits(q);
    if (abs(m) > 1.0) {
        angle = steradian_trig_atan2(m, 1.0);
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
fn steradian_plane_disk_window(m: f32, d2: f32, rho2: f32) -> f32 {
    let d = steradian_plane_root(d2);
    let c = inverseSqrt(1.0 + m * m);
    let x = m * c * d;
    let x2 = x * x;
    let chord = steradian_plane_root(max(rho2 - x2, 0.0));
    let psi = steradian_plane_angle_of_slope(m);
    let inverse_rho = inverseSqrt(rho2);
    let acute = steradian_trig_angle_over_sine_acute(max(1.0 - abs(x) * inverse_rho, 0.0)) * chord * inverse_rho;
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
fn steradian_plane_disk_window_whole(m: f32, d2: f32, rho2: f32) -> f32 {
    let e = 2.0 - 2.0 * d2 - rho2;
    return 2.0 * (steradian_plane_angle_of_slope(m) * ((1.0 - rho2) * (1.0 - rho2) + 2.0 * rho2 * d2)
         + m * (d2 - rho2) * (2.0 * rho2 - 2.0 + d2)) + steradian_pi() * (rho2 * e);
}

// The slope of a point in a frame: tangent of the angle from the axis.
//
//   w, t     components of the point along the axis and across it (counter-clockwise positive), any common scale
//   beyond   the slope where the point is not in front of the axis: +-1.0e9
fn steradian_plane_slope(w: f32, t: f32, beyond: f32) -> f32 {
    return select(beyond, clamp(t / max(w, 1.0e-12), -1.0e9, 1.0e9), w > 1.0e-12);
}

// The slope from the centre's direction of a ray that passes a disk's centre at the signed distance x.
fn steradian_plane_disk_slope(x: f32, d2: f32) -> f32 {
    return x * inverseSqrt(max(d2 - x * x, 1.0e-12));
}

// The largest x of rays that reach a disk within the range, R = 1; 0 inside the disk.
//
// The near side leaves the range before the tangent does: law of cosines.
fn steradian_plane_disk_reach(d2: f32, radius: f32) -> f32 {
    let rho2 = radius * radius;
    let leaves = d2 - rho2 > 1.0;
    var reach = select(0.0, radius, d2 > rho2);
    if (leaves) {
        let along = 0.5 * (d2 + 1.0 - rho2);
        reach = select(reach, min(sqrt(max(d2 - along * along, 0.0)), radius), leaves);
    }
    return reach;
}

// A place beyond all of a disk, on the side of a place.
fn steradian_plane_beyond(place: f32) -> f32 {
    return select(-1.0e6, 1.0e6, place > 0.0);
}

// The signed distance at which the ray from the eye through a vertex passes a disk's centre.
//
//   from_light, from_eye  of the vertex
//   returns               -radius at the low tangent to radius at the high one; beyond all of the disk if the vertex is behind the eye
fn steradian_plane_place_on_light(from_light: vec2f, from_eye: vec2f) -> f32 {
    let across = from_light.y * from_eye.x - from_light.x * from_eye.y;
    let ahead = dot(from_eye - from_light, from_eye);
    let place = across * inverseSqrt(max(dot(from_eye, from_eye), steradian_smallest_divisor()));
    return select(steradian_plane_beyond(across), place, ahead > 0.0);
}

// The same of the two tangents of a round blocker.
struct SteradianPlaneRoundEnds {
    begin: f32,
    end: f32,
    begins_ahead: bool,
    ends_ahead: bool,
}

// The places on a disk between which a round blocker occludes it.
//
//   to_light, to_blocker  from the eye to both centres
//   from_light            from the light's centre to the blocker's
//   radius                the blocker's
fn steradian_plane_round_ends(to_light: vec2f, to_blocker: vec2f, from_light: vec2f, radius: f32) -> SteradianPlaneRoundEnds {
    let k2 = dot(to_blocker, to_blocker);
    let t = steradian_plane_root(max(k2 - radius * radius, 0.0));
    // cross(a, k) = cross(a, k - a): no cancellation if the blocker is far behind the light.
    let across = to_light.x * from_light.y - to_light.y * from_light.x;
    let ahead = dot(to_light, to_blocker);
    let inverse = 1.0 / max(k2, steradian_smallest_divisor());
    let begin = (t * across - radius * ahead) * inverse;
    let end = (t * across + radius * ahead) * inverse;
    var ends: SteradianPlaneRoundEnds;
    ends.begins_ahead = t * ahead + radius * across > 0.0;
    ends.ends_ahead = t * ahead - radius * across > 0.0;
    ends.begin = select(steradian_plane_beyond(begin), begin, ends.begins_ahead);
    ends.end = select(steradian_plane_beyond(end), end, ends.ends_ahead);
    return ends;
}

// ======== indirect: one bounce from virtual lights ========

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
// At a virtual light v comes in from the front's other side: there the rows are negated (steradian_indirect_turned).
struct SteradianIndirectLobe {
    x: vec3f,
    y: vec3f,
    z: vec3f,
    scale: f32,
}

// The lobe of a table's matrix and the frame it belongs to (x along the view, z the normal). The matrix' factor cancels in a half.
fn steradian_indirect_lobe(m: SteradianLtcMatrix, frame: mat3x3f) -> SteradianIndirectLobe {
    var lobe: SteradianIndirectLobe;
    lobe.x = steradian_transform(frame, vec3f(m.xx, 0.0, m.xz));
    lobe.y = steradian_transform(frame, vec3f(0.0, m.yy, 0.0));
    lobe.z = steradian_transform(frame, vec3f(m.zx, 0.0, m.zz));
    lobe.scale = m.yy * (m.xx * m.zz - m.xz * m.zx) * steradian_inverse_pi();
    return lobe;
}

// The lobe for vectors that point at the surface instead of away from it: what a virtual light needs.
fn steradian_indirect_turned(lobe: SteradianIndirectLobe) -> SteradianIndirectLobe {
    var turned: SteradianIndirectLobe;
    turned.x = -lobe.x;
    turned.y = -lobe.y;
    turned.z = -lobe.z;
    turned.scale = lobe.scale;
    return turned;
}

// The vector v under the lobe's M^-1; v is any vector in world space.
fn steradian_indirect_under(lobe: SteradianIndirectLobe, v: vec3f) -> vec3f {
    return vec3f(dot(lobe.x, v), dot(lobe.y, v), dot(lobe.z, v));
}

// The contribution of a glossy end to a pair, its half, for scale 1: w_z D / |w|^4. One division.
//
//   v        as the lobe's rows take it
//   d2       dot(v, v)
//   wide2    0, or an area over pi that softens the nearness of a virtual light: D becomes D + wide2 in 1 / D
//
// Degenerate: v = 0 gives 0. In float |v| and the lobe's width want |v|^6 width^4 in the range of numbers.
fn steradian_indirect_glossy_half(lobe: SteradianIndirectLobe, v: vec3f, d2: f32, wide2: f32) -> f32 {
    let w = steradian_indirect_under(lobe, v);
    let w2 = dot(w, w);
    return max(w.z, 0.0) * d2 * d2 / max(w2 * w2 * (d2 + wide2), steradian_smallest_square());
}

// The contribution of a diffuse end of albedo pi to a pair, its half: cosine over distance.
fn steradian_indirect_diffuse_half(n: vec3f, v: vec3f, d2: f32, wide2: f32) -> f32 {
    return max(dot(n, v), 0.0) / max(d2 + wide2, steradian_smallest_square());
}

// Radiance towards the eye from a point light of intensity 1: the lobe over the squared distance.
//
//   v        light's position minus the surface's
//   lobe     of the surface and its view; times rho_f: with Fresnel
//
// Degenerate: v = 0 gives 0.
// Source: Xia et al. 2023, eq. 9; the sum over lights with lobe.scale taken out is eq. 11.
fn steradian_indirect_point_light(lobe: SteradianIndirectLobe, v: vec3f) -> f32 {
    let d2 = dot(v, v);
    return lobe.scale * steradian_indirect_glossy_half(lobe, v, d2, 0.0) * inverseSqrt(max(d2, steradian_smallest_square()));
}

// The four halves of a pair. Light through a pair: flux (diffuse' from_diffuse + glossy' from_glossy) (diffuse
// to_diffuse + glossy to_glossy), with diffuse = albedo / pi and glossy = rho_f times the lobe's scale at each end.
struct SteradianIndirectPair {
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
fn steradian_indirect_pair(v: vec3f, n: vec3f, receiver: SteradianIndirectLobe, light_n: vec3f, light: SteradianIndirectLobe) -> SteradianIndirectPair {
    let d2 = dot(v, v);
    let w = steradian_indirect_under(receiver, v);
    let o = steradian_indirect_under(light, v);
    let w2 = dot(w, w);
    let o2 = dot(o, o);
    let w4 = w2 * w2;
    let o4 = o2 * o2;
    let both = w4 * o4;
    let inverse = 1.0 / max(d2 * both, steradian_smallest_square());
    let peak = inverse * d2 * d2;
    let n_v = max(dot(n, v), 0.0);
    let light_n_v = max(dot(light_n, v), 0.0);
    var pair: SteradianIndirectPair;
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
fn steradian_indirect_grazing(incoming: vec3f, v: vec3f, d2: f32) -> f32 {
    let cosine = -dot(incoming, v) * inverseSqrt(max(d2, steradian_smallest_square()));
    let half_angle = max(0.5 + 0.5 * cosine, 1.0e-12);
    return steradian_fresnel_schlick(0.0, 1.0, half_angle * inverseSqrt(half_angle));
}

// One end on GGX microsurfaces, without Fresnel, and Schlick's weight: the ground truth, and the baseline.
struct SteradianIndirectGgx {
    lobe: f32,
    grazing: f32,
}

// GGX for the unit direction l away from the surface: BRDF times the cosine of l.
//
//   frame    x along the view, z the normal
//   view     unit, in the frame
fn steradian_indirect_ggx(frame: mat3x3f, view: vec3f, alpha: f32, l: vec3f) -> SteradianIndirectGgx {
    let local = steradian_transform_transposed(frame, l);
    let h = steradian_microfacet_half_vector(local, view);
    var end: SteradianIndirectGgx;
    end.lobe = steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, alpha, alpha) * steradian_ggx_shadowing(local, view, alpha, alpha), local, view);
    end.grazing = steradian_fresnel_schlick(0.0, 1.0, dot(h, view));
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
fn steradian_indirect_kept(value: f32, reach: f32, xi: f32) -> f32 {
    return select(0.0, max(value, reach), value > xi * reach);
}

// The way from a receiver to a virtual light: the vector v, D, and 1 / |v|.
struct SteradianIndirectWay {
    v: vec3f,
    d2: f32,
    inverse: f32,
}

// The way from the point p; a light at the point is 1.0e-10 away.
fn steradian_indirect_way(light: vec3f, p: vec3f) -> SteradianIndirectWay {
    var way: SteradianIndirectWay;
    way.v = light - p;
    way.d2 = max(dot(way.v, way.v), 1.0e-20);
    way.inverse = inverseSqrt(way.d2);
    return way;
}

// A virtual light as a quad, for lobes so sharp that its middle does not stand for it.
//   normal          unit, on the side away from the receiver
//   edge_x, edge_y  half its sides
//   inverse_area    one over its area
//   size2           squared length of its longer edge
struct SteradianIndirectQuad {
    normal: vec3f,
    edge_x: vec3f,
    edge_y: vec3f,
    inverse_area: f32,
    size2: f32,
}

// Lobes of a smaller alpha see virtual lights as quads.
fn steradian_indirect_sharp() -> f32 { return 0.1; }

// True where the quad is larger than a speck in the lobe's own space, |edge|^2 > 0.02 |w|^2: over a speck the lobe is nearly
// constant. Also false where the quad is seen edge-on, to a thousandth: steradian_indirect_quad_half divides by that sine, and is off by 1.0e-7 of
// the hemisphere.
//
//   kept, value  the light's half after culling and before
fn steradian_indirect_quad_matters(lobe: SteradianIndirectLobe, quad: SteradianIndirectQuad, way: SteradianIndirectWay, kept: f32, value: f32) -> bool {
    let w = steradian_indirect_under(lobe, way.v);
    let facing = dot(quad.normal, way.v);
    return kept > 0.0 && quad.size2 * kept > dot(w, w) * value * 0.02 && facing > 0.0 && facing * facing > way.d2 * 1.0e-6;
}

// A walk around the quad in the lobe's own space.
fn steradian_indirect_quad_walk(lobe: SteradianIndirectLobe, v: vec3f, ex: vec3f, ey: vec3f) -> SteradianPolygonWalk {
    let a = steradian_polygon_direction(steradian_indirect_under(lobe, v + (-ex - ey)));
    let b = steradian_polygon_direction(steradian_indirect_under(lobe, v + (ex - ey)));
    let c = steradian_polygon_direction(steradian_indirect_under(lobe, v + (ex + ey)));
    let d = steradian_polygon_direction(steradian_indirect_under(lobe, v + (ey - ex)));
    var walk = steradian_polygon_begin();
    walk = steradian_polygon_add_edge(walk, a, b);
    walk = steradian_polygon_add_edge(walk, b, c);
    walk = steradian_polygon_add_edge(walk, c, d);
    return steradian_polygon_add_edge(walk, d, a);
}

// The half of a glossy end, for scale 1, over the quad in place of its value at the middle.
//
//   rarity   by which the light stands for more: kept over value
fn steradian_indirect_quad_half(lobe: SteradianIndirectLobe, quad: SteradianIndirectQuad, way: SteradianIndirectWay, wide2: f32, rarity: f32) -> f32 {
    let grow = sqrt(rarity);
    let ex = quad.edge_x * grow;
    let ey = quad.edge_y * grow;
    let reversed = dot(cross(ex, ey), way.v) < 0.0;
    let integral = steradian_polygon_irradiance(steradian_indirect_quad_walk(lobe, way.v, ex, ey), reversed) * steradian_inverse_pi();
    let facing = max(dot(quad.normal, way.v), 1.0e-12);
    return integral * (way.d2 + wide2) * quad.inverse_area / (facing * lobe.scale * rarity);
}

// Conditions under which the filter takes two points for one surface.
//   least_cosine  between the normals
//   slope2        squared distance from the plane over squared distance
//   widths        lobes whose alphas differ by more than this fraction have different glossy light
struct SteradianIndirectLikeness {
    least_cosine: f32,
    slope2: f32,
    widths: f32,
}

// The usual conditions: 26 degrees and a twentieth.
fn steradian_indirect_alike() -> SteradianIndirectLikeness {
    var like: SteradianIndirectLikeness;
    like.least_cosine = 0.9;
    like.slope2 = 0.0025;
    like.widths = 0.2;
    return like;
}

// Loose conditions, for places that find so little that the pattern would be visible, at edges.
fn steradian_indirect_alike_loosely() -> SteradianIndirectLikeness {
    var like: SteradianIndirectLikeness;
    like.least_cosine = 0.3;
    like.slope2 = 0.49;
    like.widths = 0.5;
    return like;
}

// True if a point is on the same surface as another, to a hundredth of a millimetre.
//
//   n, m     unit normals
//   d        vector between the points [m]
fn steradian_indirect_same_surface(like: SteradianIndirectLikeness, n: vec3f, m: vec3f, d: vec3f) -> bool {
    let off = dot(n, d);
    return dot(n, m) > like.least_cosine && off * off < dot(d, d) * like.slope2 + 1.0e-10;
}

// Fraction of the filter's weights that is enough.
fn steradian_indirect_enough() -> f32 { return 0.6; }

// The filter's mean of a weighted sum; zero weights give zero.
fn steradian_indirect_over(sum: vec3f, weight: f32) -> vec3f { return sum * (1.0 / max(weight, 1.0e-12)); }

// The same; where the weight is less than enough, others supply the rest.
fn steradian_indirect_filtered(sum: vec3f, weight: f32, others: vec3f, others_weight: f32) -> vec3f {
    let lack = max(steradian_indirect_enough() - weight, 0.0);
    return steradian_indirect_over(sum + steradian_indirect_over(others, others_weight) * lack, weight + lack);
}

// The largest factor by which M stretches a vector: one over the least by which M^-1 does.
fn steradian_indirect_largest_stretch(m: SteradianLtcMatrix) -> f32 {
    // The 2 x 2 block's smaller singular value, from its trace and determinant; the larger divides, nothing cancels.
    let determinant = m.xx * m.zz - m.xz * m.zx;
    let square = m.xx * m.xx + m.xz * m.xz + m.zx * m.zx + m.zz * m.zz;
    let gap2 = max(square * square - 4.0 * determinant * determinant, 0.0);
    let larger2 = 0.5 * (square + gap2 * inverseSqrt(max(gap2, steradian_smallest_square())));
    let least2 = determinant * determinant / max(larger2, steradian_smallest_square());
    return inverseSqrt(max(min(least2, m.yy * m.yy), steradian_smallest_square()));
}

// The spheroid that holds the egg of range 1 (steradian_indirect_spheroid): the distance of its centre in front of the light, and its half axes
// along that direction and across. A ball of the last holds it too.
fn steradian_indirect_ball() -> vec3f { return vec3f(0.46, 0.54, 0.628); }

// The region in which the irradiance of a virtual light can exceed a threshold: a ball of radius 1 about the origin of the result.
//
//   lobe     turned; a diffuse light's: its frame
//   v        virtual light's position minus the point's
//   range    square root of bright scale stretch / threshold, stretch of steradian_indirect_largest_stretch
//
// Irradiance is bright scale (w_z |v|) / |w|^4 <= bright scale stretch cos / |w|^2 with cos = w_z / |w|, so that the region lies
// inside |w|^2 <= range^2 cos: an egg, which the spheroid about 0.46 range on the axis, half axes 0.54 range along it
// and 0.628 range across, contains. Both numbers: tests Indirect.SpheroidHoldsTheEgg.
fn steradian_indirect_spheroid(lobe: SteradianIndirectLobe, v: vec3f, range: f32) -> vec3f {
    let w = steradian_indirect_under(lobe, v);
    let inverse = 1.0 / range;
    let ball = steradian_indirect_ball();
    return vec3f(w.x * (inverse / ball.z), w.y * (inverse / ball.z), (w.z * inverse - ball.x) / ball.y);
}

// Bounds of receivers: a box of their places, and of their normals.
//   center, extent  the box' middle and half its sides
//   normal, turn    the same of the normals
struct SteradianIndirectBox {
    center: vec3f,
    extent: vec3f,
    normal: vec3f,
    turn: vec3f,
}

// Half the box' extent along a vector, times its length.
fn steradian_indirect_box_reach(box: SteradianIndirectBox, along: vec3f) -> f32 {
    return abs(along.x) * box.extent.x + abs(along.y) * box.extent.y + abs(along.z) * box.extent.z;
}

// Squared distance of a point from the box.
fn steradian_indirect_box_distance2(box: SteradianIndirectBox, p: vec3f) -> f32 {
    let d = vec3f(max(abs(box.center.x - p.x) - box.extent.x, 0.0), max(abs(box.center.y - p.y) - box.extent.y, 0.0),
                  max(abs(box.center.z - p.z) - box.extent.z, 0.0));
    return dot(d, d);
}

// The largest product of a coordinate of a normal and of a way, each within its bounds.
fn steradian_indirect_most(normal: f32, turn: f32, way: f32, extent: f32) -> f32 {
    return normal * way + abs(normal) * extent + turn * (abs(way) + extent);
}

// True if the egg of a diffuse virtual light may reach the box.
//
//   at, n    place and normal
//   range    square root of bright / threshold
//   offset   dot(n, p) of the light's plane
//
// Two bounds: d^3 <= range^2 h, with the least distance d and the greatest height h above the light's plane, culls boxes in the plane
// itself; the ball that holds the egg is for large boxes. No light comes from below the horizons of all receivers: n.v is largest where
// each of its three products is.
fn steradian_indirect_egg_reaches(box: SteradianIndirectBox, at: vec3f, n: vec3f, range: f32, offset: f32) -> bool {
    let height = dot(n, box.center) + abs(n.x) * box.extent.x + abs(n.y) * box.extent.y + abs(n.z) * box.extent.z - offset;
    let v = at - box.center;
    let above = steradian_indirect_most(box.normal.x, box.turn.x, v.x, box.extent.x) + steradian_indirect_most(box.normal.y, box.turn.y, v.y, box.extent.y)
        + steradian_indirect_most(box.normal.z, box.turn.z, v.z, box.extent.z);
    var reaches = height > 0.0 && above > 0.0;
    if (reaches) {  // neighbours in the light's grid mostly agree
        let ball = steradian_indirect_ball();
        let range2 = range * range;
        let d2 = steradian_indirect_box_distance2(box, at);
        let reach = range2 * height;
        let ball2 = steradian_indirect_box_distance2(box, at + n * (range * ball.x));
        reaches = reaches && d2 * d2 * d2 <= reach * reach && ball2 <= range2 * (ball.z * ball.z);
    }
    return reaches;
}

// True if the spheroid of a glossy virtual light may reach the box.
//
//   x, y, z  rows of T
//   g        the unit ball is that of q = g - T p
//   n        the light's normal
//   offset   dot(n, p) of the light's plane
//
// The ball is tested against the box under T, a parallelepiped. They are apart if the plane that touches the ball below the box' centre
// separates them. They are also apart if the box' bounds along the lobe's axes miss the egg in the ball: |w|^3 <= w_z, w in units of the
// range. A sharp and bright lobe's ball is so large that it contains everything near its light. The egg begins at the light, and extends
// one way.
fn steradian_indirect_spheroid_reaches(box: SteradianIndirectBox, x: vec3f, y: vec3f, z: vec3f, g: vec3f, n: vec3f, offset: f32) -> bool {
    let ball = steradian_indirect_ball();
    let qz = g.z - dot(z, box.center);
    let wz = ball.y * qz + ball.x;
    let deep = ball.y * steradian_indirect_box_reach(box, z);
    let highest = wz + deep + 1.0e-6 * (abs(g.z) + 1.0);  // plus the rounding of a difference in float
    var reaches = highest > 0.0 && dot(n, box.center) + steradian_indirect_box_reach(box, n) > offset;
    if (reaches) {
        let q = vec3f(g.x - dot(x, box.center), g.y - dot(y, box.center), qz);
        let q2 = dot(q, q);
        let gap = q2 - steradian_indirect_box_reach(box, x * q.x + y * q.y + z * q.z);  // T transposed times q
        let least = vec3f(ball.z * max(abs(q.x) - steradian_indirect_box_reach(box, x), 0.0), ball.z * max(abs(q.y) - steradian_indirect_box_reach(box, y), 0.0),
                          max(abs(wz) - deep, 0.0));
        let w2 = dot(least, least);
        reaches = reaches && !(gap > 0.0 && gap * gap > q2) && w2 * w2 * w2 <= highest * highest;
    }
    return reaches;
}
