// Steradian 0.1.0, plane: light in the plane, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl.
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
