// Steradian 0.1.0, plane: light in the plane, for HLSL.
//
// #include or paste it; it has no macros and no resources.
// It needs these files before it, in this order: math.hlsl.
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
float steradian_plane_power_integral(int n, float t, float f) {
    float sec2 = 1.0 + t * t;
    float sec = sqrt(sec2);
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
    float a = log(abs(t) + sec);
    a = steradian_select(t < 0.0, -a, a);
    if (n == -1) {
        return a;
    }
    float cubed = 0.5 * (t * sec + a);
    if (n == -3) {
        return cubed;
    }
    return 0.25 * t * sec * sec2 + 0.75 * cubed;
}

// Antiderivative of tan(f)^j cos(f)^n, j = 0, 1 or 2. See steradian_plane_power_integral; j = 2 takes n >= -3.
float steradian_plane_term(int j, int n, float t, float f) {
    if (j == 0) {
        return steradian_plane_power_integral(n, t, f);
    }
    if (j == 2) {
        return steradian_plane_power_integral(n - 2, t, f) - steradian_plane_power_integral(n, t, f);
    }
    // -cos^n / n, and -log(cos) for n = 0; cos^2 = 1 / sec2
    float sec2 = 1.0 + t * t;
    if (n == 0) {
        return 0.5 * log(sec2);
    }
    if (n == 2) {
        return -0.5 / sec2;
    }
    if (n == 1) {
        return -rsqrt(sec2);
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
float steradian_plane_edge_integral(int j, int k, float t, float f, float q) {
    float w0 = steradian_plane_term(j, k, t, f);
    float w2 = steradian_plane_term(j, k - 2, t, f);
    float w4 = steradian_plane_term(j, k - 4, t, f);
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
float steradian_plane_disk_window_integral(float d2, float rho2, float d, float c, float s, float psi, float chord, float beta) {
    float x = d * s;
    float sin2 = 2.0 * s * c;
    float cos2 = c * c - s * s;
    float half_disk = x * chord + rho2 * beta;
    float r2 = 0.5 * d2 * sin2 + rho2 * psi - half_disk;
    float even = psi * rho2 * (rho2 + 2.0 * d2) + d2 * sin2 * (2.0 * rho2 + 0.5 * d2 * cos2);
    float mixed = 2.0 * (d2 + rho2) * half_disk - x * (2.0 * x * x - rho2) * chord - rho2 * rho2 * beta;
    return psi - 2.0 * r2 + even - mixed;
}

// Square root of x >= 0 as x over its square root: a packed square root takes as long as ten multiplications.
//
// Error: two roundings more than sqrt; 0 at 0.
float steradian_plane_root(float x) {
    return x * rsqrt(max(x, steradian_smallest_divisor()));
}

// Arc tangent in the ranges that lights far from a point leave: a polynomial where |m| <= 1 on all lanes.
float steradian_plane_angle_of_slope(float m) {
    float q = m * m;
    float angle = m * steradian_trig_atan_over_argument_24_bits(q);
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
float steradian_plane_disk_window(float m, float d2, float rho2) {
    float d = steradian_plane_root(d2);
    float c = rsqrt(1.0 + m * m);
    float x = m * c * d;
    float x2 = x * x;
    float chord = steradian_plane_root(max(rho2 - x2, 0.0));
    float psi = steradian_plane_angle_of_slope(m);
    float inverse_rho = rsqrt(rho2);
    float acute = steradian_trig_angle_over_sine_acute(max(1.0 - abs(x) * inverse_rho, 0.0)) * chord * inverse_rho;
    float beta = 0.5 * steradian_pi() - acute;
    beta = steradian_select(m < 0.0, -beta, beta);
    float e = 2.0 - 2.0 * d2 - rho2;
    return psi * ((1.0 - rho2) * (1.0 - rho2) + 2.0 * rho2 * d2)
         + x * (c * d * (4.0 * rho2 - 2.0 + d2 - 2.0 * x2) + chord * (e - 2.0 * rho2 + 2.0 * x2))
         + beta * (rho2 * e);
}

// The disk window integral over the whole disk: from tangent to tangent.
//
//   m        the tangents' slope: sqrt(rho2 / (d2 - rho2))
float steradian_plane_disk_window_whole(float m, float d2, float rho2) {
    float e = 2.0 - 2.0 * d2 - rho2;
    return 2.0 * (steradian_plane_angle_of_slope(m) * ((1.0 - rho2) * (1.0 - rho2) + 2.0 * rho2 * d2)
         + m * (d2 - rho2) * (2.0 * rho2 - 2.0 + d2)) + steradian_pi() * (rho2 * e);
}

// The slope of a point in a frame: tangent of the angle from the axis.
//
//   w, t     components of the point along the axis and across it (counter-clockwise positive), any common scale
//   beyond   the slope where the point is not in front of the axis: +-1.0e9
float steradian_plane_slope(float w, float t, float beyond) {
    return steradian_select(w > 1.0e-12, clamp(t / max(w, 1.0e-12), -1.0e9, 1.0e9), beyond);
}

// The slope from the centre's direction of a ray that passes a disk's centre at the signed distance x.
float steradian_plane_disk_slope(float x, float d2) {
    return x * rsqrt(max(d2 - x * x, 1.0e-12));
}

// The largest x of rays that reach a disk within the range, R = 1; 0 inside the disk.
//
// The near side leaves the range before the tangent does: law of cosines.
float steradian_plane_disk_reach(float d2, float radius) {
    float rho2 = radius * radius;
    bool leaves = d2 - rho2 > 1.0;
    float reach = steradian_select(d2 > rho2, radius, 0.0);
    if (leaves) {
        float along = 0.5 * (d2 + 1.0 - rho2);
        reach = steradian_select(leaves, min(sqrt(max(d2 - along * along, 0.0)), radius), reach);
    }
    return reach;
}

// A place beyond all of a disk, on the side of a place.
float steradian_plane_beyond(float place) {
    return steradian_select(place > 0.0, 1.0e6, -1.0e6);
}

// The signed distance at which the ray from the eye through a vertex passes a disk's centre.
//
//   from_light, from_eye  of the vertex
//   returns               -radius at the low tangent to radius at the high one; beyond all of the disk if the vertex is behind the eye
float steradian_plane_place_on_light(float2 from_light, float2 from_eye) {
    float across = from_light.y * from_eye.x - from_light.x * from_eye.y;
    float ahead = dot(from_eye - from_light, from_eye);
    float place = across * rsqrt(max(dot(from_eye, from_eye), steradian_smallest_divisor()));
    return steradian_select(ahead > 0.0, place, steradian_plane_beyond(across));
}

// The same of the two tangents of a round blocker.
struct SteradianPlaneRoundEnds {
    float begin;
    float end;
    bool begins_ahead;
    bool ends_ahead;
};

// The places on a disk between which a round blocker occludes it.
//
//   to_light, to_blocker  from the eye to both centres
//   from_light            from the light's centre to the blocker's
//   radius                the blocker's
SteradianPlaneRoundEnds steradian_plane_round_ends(float2 to_light, float2 to_blocker, float2 from_light, float radius) {
    float k2 = dot(to_blocker, to_blocker);
    float t = steradian_plane_root(max(k2 - radius * radius, 0.0));
    // cross(a, k) = cross(a, k - a): no cancellation if the blocker is far behind the light.
    float across = to_light.x * from_light.y - to_light.y * from_light.x;
    float ahead = dot(to_light, to_blocker);
    float inverse = 1.0 / max(k2, steradian_smallest_divisor());
    float begin = (t * across - radius * ahead) * inverse;
    float end = (t * across + radius * ahead) * inverse;
    SteradianPlaneRoundEnds ends;
    ends.begins_ahead = t * ahead + radius * across > 0.0;
    ends.ends_ahead = t * ahead - radius * across > 0.0;
    ends.begin = steradian_select(ends.begins_ahead, begin, steradian_plane_beyond(begin));
    ends.end = steradian_select(ends.ends_ahead, end, steradian_plane_beyond(end));
    return ends;
}
