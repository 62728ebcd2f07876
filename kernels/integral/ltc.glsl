// Linearly transformed cosines: area lights on glossy surfaces by a table look-up and a polygon integral.
//
// A lobe is a clamped cosine under a linear map M. The integral of the lobe over a light is the cosine's integral over
// the light under M^-1. Shading frame: z the surface normal, x along the view's projection, so that the unit view
// is (s, 0, c). The caller fetches table values at ltc_coordinates and passes them in. See docs/theory/ltc.md.
// Needs: constants.glsl inverse_trig.glsl polygon.glsl microfacet.glsl
// Source: Heitz, Dupuy, Hill, Neubelt, "Real-time polygonal-light shading with linearly transformed cosines", 2016.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The inverse matrix M^-1 of a linearly transformed cosine, up to a positive factor: rows (xx, 0, xz), (0, yy, 0), (zx, 0, zz); its
// determinant is positive.
struct LtcMatrix {
    real xx;
    real xz;
    real yy;
    real zx;
    real zz;
};

// The place where a table is read: both coordinates are in [0, 1], and the outer nodes stand on the ends.
//
//   roughness  perceptual: the square root of alpha
//   n_dot_v    cosine of the view
vec2 ltc_coordinates(real roughness, real n_dot_v) {
    return vec2(clamp(roughness, 0.0, 1.0), sqrt(clamp(1.0 - n_dot_v, 0.0, 1.0)));
}

// The matrix as the literature's texture stores it.
//
//   t        M^-1 divided by its middle element: column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2
LtcMatrix ltc_from_classic(vec4 t) {
    LtcMatrix m;
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
LtcMatrix ltc_from_compact(vec4 e, real alpha, vec3 view) {
    real tilt = alpha * e.z;
    real shear = alpha * e.w;
    real width = alpha * e.x;
    LtcMatrix m;
    m.xx = view.z + tilt * view.x;
    m.xz = view.x - tilt * view.z;
    m.yy = (e.x - tilt * e.w) / e.y;
    m.zx = -(shear * view.z + width * view.x);
    m.zz = width * view.z - shear * view.x;
    return m;
}

// The vector M^-1 v, up to the matrix' factor, for any vector v of the shading frame.
vec3 ltc_transform(LtcMatrix m, vec3 v) {
    return vec3(m.xx * v.x + m.xz * v.z, m.yy * v.y, m.zx * v.x + m.zz * v.z);
}

// The transpose of M^-1 times a vector.
vec3 ltc_transform_transposed(LtcMatrix m, vec3 v) {
    return vec3(m.xx * v.x + m.zx * v.z, m.yy * v.y, m.xz * v.x + m.zz * v.z);
}

// The lobe's density per solid angle at the unit direction l: |M^-1| max(w_z, 0) / (pi |w|^4) with w = M^-1 l.
real ltc_lobe(LtcMatrix m, vec3 l) {
    vec3 w = ltc_transform(m, l);
    real d2 = max(dot(w, w), smallest_length());
    real determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    return determinant * max(w.z, 0.0) * inverse_pi() / (d2 * d2);
}

// How fast the lobe changes about the direction l: the inverse of the angle over which M^-1 l may change by its own length.
real ltc_sharpness(LtcMatrix m, vec3 l) {
    vec3 w = ltc_transform(m, l);
    real size2 = m.xx * m.xx + m.xz * m.xz + m.yy * m.yy + m.zx * m.zx + m.zz * m.zz;
    return sqrt(size2 * dot(l, l) / max(dot(w, w), smallest_square()));
}

// The lobe's share above the real horizon, in [0, 1]; tables hold magnitudes divided by it.
//
// Under M^-1 the sky becomes a half space, which shares a lune with the cosine's: (1 + cosine of their angle) / 2.
real ltc_energy_above_horizon(LtcMatrix m) {
    return 0.5 + 0.5 * m.xx * inversesqrt(max(m.xx * m.xx + m.zx * m.zx, smallest_square()));
}

// The state of a walk along a light's outline under M^-1.
//   lobe      what the clipped edges add up to
//   anchor    where the outline first crossed the real horizon, under M^-1
//   anchored  whether it did
struct LtcWalk {
    PolygonWalk lobe;
    vec3 anchor;
    mask anchored;
};

// A walk with no edge yet.
LtcWalk ltc_begin() {
    LtcWalk walk;
    walk.lobe = polygon_begin();
    walk.anchor = vec3(0.0, 0.0, 0.0);
    walk.anchored = mask_none();
    return walk;
}

// Unit direction of a vertex under M^-1.
//
//   v        vertex or direction in the shading frame
vec3 ltc_direction(LtcMatrix m, vec3 v) {
    return polygon_direction(ltc_transform(m, v));
}

// The part of an edge above the real horizon, under M^-1.
//
//   a, b     ends in the shading frame, in walk order: polygon_direction of the vertices
//   ta, tb   ltc_direction(m, a) and ltc_direction(m, b): a vertex is transformed once for its two edges
//   returns  its ends are unit directions under M^-1, and its weights are those of ta and tb
//
// Degenerate: an edge below the horizon has ends of 0.
EdgePart ltc_part(LtcMatrix m, vec3 a, vec3 b, vec3 ta, vec3 tb) {
    mask a_below = a.z < 0.0;
    mask b_below = b.z < 0.0;
    EdgePart part = edge_whole(ta, tb);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (any_lane(a_below || b_below)) {
        real wa = abs(b.z);
        real wb = abs(a.z);
        vec3 horizon = vec3(a.x * wa + b.x * wb, a.y * wa + b.y * wb, 0.0);
        vec3 under = ltc_transform(m, horizon);
        vec3 crossing = select(part.rises || part.sinks, polygon_direction(under), vec3(0.0, 0.0, 0.0));
        part.start = select(a_below, crossing, ta);
        part.end = select(b_below, crossing, tb);
        vec3 under_a = ltc_transform(m, a);
        vec3 under_b = ltc_transform(m, b);
        real scale = inversesqrt(max(dot(under, under), smallest_square()));
        real of_a = wa * sqrt(dot(under_a, under_a)) * scale;
        real of_b = wb * sqrt(dot(under_b, under_b)) * scale;
        part.start_a = select(a_below, of_a, 1.0);
        part.start_b = select(a_below, of_b, 0.0);
        part.end_a = select(b_below, of_a, 0.0);
        part.end_b = select(b_below, of_b, 1.0);
    }
    return part;
}

// Closes the gaps that a part's ends leave along the real horizon.
//
// They go from each crossing down to the next crossing up. They lie on one line of the light's plane, so that the way from one to the
// other may go by any point of that line: a crossing down adds the edge to the first crossing of the walk, a crossing up the edge from
// it, in whatever order they come.
//
//   part     of ltc_part
LtcWalk ltc_close_gap(LtcWalk walk, EdgePart part) {
    LtcWalk next = walk;
    mask crosses = part.rises || part.sinks;
    if (any_lane(crosses)) {
        vec3 none = vec3(0.0, 0.0, 0.0);
        vec3 crossing = select(part.rises, part.start, part.end);
        // The first crossing is its own anchor: an edge of no length.
        mask closes = crosses && walk.anchored;
        if (any_lane(closes)) {
            vec3 departure = select(part.rises, walk.anchor, crossing);
            vec3 arrival = select(part.rises, crossing, walk.anchor);
            next.lobe = polygon_add_edge(next.lobe, select(closes, departure, none), select(closes, arrival, none));
        }
        next.anchor = select(crosses && !walk.anchored, crossing, walk.anchor);
        next.anchored = walk.anchored || crosses;
    }
    return next;
}

// Adds one edge, clipped to the real horizon, then to the lobe's. Arguments: ltc_part.
//
// Degenerate: an edge below the real horizon adds nothing, exactly: a light below it gives 0.
LtcWalk ltc_add_edge(LtcWalk walk, LtcMatrix m, vec3 a, vec3 b, vec3 ta, vec3 tb) {
    LtcWalk next = walk;
    if (any_lane(!(a.z < 0.0) || !(b.z < 0.0))) {
        EdgePart part = ltc_part(m, a, b, ta, tb);
        next = ltc_close_gap(walk, part);
        next.lobe = polygon_add_edge(next.lobe, part.start, part.end);
    }
    return next;
}

// Integral of the lobe over the part of the light above the real horizon, in [0, 1].
//
//   reversed true where the light is seen from behind
real ltc_integral(LtcWalk walk, mask reversed) {
    return polygon_irradiance(walk.lobe, reversed) * inverse_pi();
}

// The factor of the lobe's integral: Schlick's Fresnel averaged over the lobe.
//
//   n_a      magnitude of the lobe without Fresnel
//   f_a      of the lobe times (1 - v.h)^5
real ltc_specular_scale(real f0, real f90, real n_a, real f_a) {
    return f0 * n_a + (f90 - f0) * f_a;
}

// The specular radiance where the lobe times (1 - v.h)^5 has a matrix of its own (table of fit --fresnel-lobe).
//
//   integral, grazing  ltc_integral with the lobe's and with the Fresnel lobe's matrix
real ltc_specular_with_fresnel_lobe(real f0, real f90, real n_a, real integral, real f_a, real grazing) {
    return f0 * n_a * integral + (f90 - f0) * f_a * grazing;
}

// Factor on the specular radiance that returns what single scattering loses between the facets.
//
//   f0       reflectance along the normal
//   albedo   of the lobe with F = 1: n_a times ltc_energy_above_horizon, in (0, 1]
//
// Source: Turquin, "Practical multiple scattering compensation for microfacet models", 2019, eq. 16.
real ltc_multiple_scattering(real f0, real albedo) {
    real a = clamp(albedo, 1.0e-2, 1.0);
    return 1.0 + f0 * (1.0 - a) / a;
}

// A surface under a clear coat of glTF: the coat reflects its share and dims what lies below.
//
//   base       radiance of the surface below
//   coat       radiance of the coat's lobe with its own Fresnel (f0 0.04) in it
//   clearcoat  strength in [0, 1]
//   n_dot_v    cosine of the view to the coat's normal
real ltc_clear_coat(real base, real coat, real clearcoat, real n_dot_v) {
    real f = fresnel_schlick(0.04, 1.0, n_dot_v);
    return base * (1.0 - clearcoat * f) + clearcoat * coat;
}

// A surface under sheen of glTF: what the cloth's fibres reflect does not reach what lies below.
//
//   base      radiance of the surface below
//   sheen     radiance of the sheen lobe, its colour included
//   strongest largest component of the sheen's colour
//   albedo    of the sheen lobe at this view: n_a times ltc_energy_above_horizon
real ltc_sheen(real base, real sheen, real strongest, real albedo) {
    return base * clamp(1.0 - strongest * albedo, 0.0, 1.0) + sheen;
}
