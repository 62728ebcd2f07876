// Steradian 0.1.0, ltc: linearly transformed cosines over polygons, textured ones too, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl, polygon.wgsl, lobe.wgsl.
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
