// The GGX lobe over a light in closed form: what the distribution of half vectors alone sends, without shadowing and
// Fresnel (ggx_cubature.glsl adds both).
//
// In stretched half vector space, u = normalize(h_x/ax, h_y/ay, h_z) and w = (ax v_x, ay v_y, v_z), the lobe is the plain
// measure: D(h) (v.h) dh = (w.u) du / pi. By Stokes the integral over the light's image is (w.E) / (pi v_z) with
//   E = 1/2 sum over the edges of INT U x U' / |U|^2 dtau,
// a quadratic over a quartic: residues times logarithms at the poles of ggx_edge.glsl.
//
//   E = sum of ggx_edge_vector(ggx_edge(view, a, b)) over the edges clipped to the horizon (horizon_clip.glsl),
//   negated where the light is seen from behind; then ggx_unshadowed(view, E).
//
// Frame and order: as ggx_edge.glsl.
// Needs: inverse_trig.glsl complex.glsl quartic.glsl gauss_legendre.glsl microfacet.glsl ggx_edge.glsl
// Topics: ggx
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A place on an edge by its share of the angle C under which both poles together see the edge: in C the lobe's
// integrand is smooth wherever the edge passes.
//   tau      between the edge's begin and end
//   density  dC/dtau
struct GgxNode {
    real tau;
    real density;
};

// The place where C is a given share of its way from the edge's begin to its end.
//
//   share    in [0, 1]
//
// C(tau) is the argument of (b1 + i (tau - p1))(b2 + i (tau - p2)) with poles p + i b, so that tau is the root of a quadratic.
GgxNode ggx_edge_node(GgxEdge edge, real share) {
    real p1 = edge.z1.x;
    real p2 = edge.z2.x;
    real b1 = edge.z1.y;
    real b2 = edge.z2.y;
    vec2 start = complex_product(vec2(b1, edge.begin - p1), vec2(b2, edge.begin - p2));
    real total = edge.sweep.x + edge.sweep.y;
    // The angle is in [0, 2 pi]: half a turn less, and the sign.
    vec2 turned = complex_product(complex_sign(start), -complex_unit(share * total - pi()));
    real s = turned.y;
    real c = turned.x;
    real linear_term = c * (b1 + b2) - s * (p1 + p2);
    real constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    real root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    mask positive = linear_term >= 0.0;
    real top = select(positive, -2.0 * constant_term, root - linear_term);
    real bottom = select(positive, linear_term + root, 2.0 * s);
    mask usable = abs(bottom) > 1.0e-30;
    real tau = select(usable, top / select(usable, bottom, 1.0), edge.begin);
    GgxNode node;
    node.tau = clamp(tau, edge.begin, edge.end);
    real x1 = node.tau - p1;
    real x2 = node.tau - p2;
    node.density = b1 / (x1 * x1 + b1 * b1) + b2 / (x2 * x2 + b2 * b2);
    return node;
}

// Half of INT U x U' / |U|^2 dtau as residues.
//
//   z, o     a pole and the other one
//   sweep    the angle under which z sees the edge
vec3 ggx_residue(GgxEdge edge, vec2 z, vec2 o, real sweep) {
    vec3 n0 = cross(edge.u0, edge.u1);
    vec3 n1 = cross(edge.u0, edge.u2) * 2.0;
    vec3 n2 = cross(edge.u1, edge.u2);
    vec3 re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    vec3 im = (n1 + n2 * (2.0 * z.x)) * z.y;
    real x0 = edge.begin - z.x;
    real x1 = edge.end - z.x;
    real y2 = z.y * z.y;
    vec2 logarithm = vec2(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    vec2 factor = complex_quotient(logarithm, ggx_quartic_slope(z, o, dot(edge.u2, edge.u2)));
    return re * factor.x - im * factor.y;
}

// The same by Gauss and Legendre in the angle C, for poles that nearly coincide, where residues cancel. 8 nodes, twice.
vec3 ggx_edge_vector_approximate(GgxEdge edge) {
    vec3 sum = vec3(0.0, 0.0, 0.0);
    real total = edge.sweep.x + edge.sweep.y;
    for (int i = 0; i < 16; i++) {
        int part = i / 8;
        vec2 rule = gauss_legendre_node(8, i - 8 * part);
        GgxNode node = ggx_edge_node(edge, 0.5 * (rule.x + real(part)));
        vec3 u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
        vec3 du = edge.u1 + edge.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), 1.0e-30)));
    }
    return sum;
}

// One edge's share of E.
//
// Error: see docs/accuracy.md, "GGX closed form".
vec3 ggx_edge_vector(GgxEdge edge) {
    vec3 e = ggx_residue(edge, edge.z1, edge.z2, edge.sweep.x) + ggx_residue(edge, edge.z2, edge.z1, edge.sweep.y);
    // Poles nearer to each other than this share of their heights, squared: residues lose the inverse of the share, and the
    // quadrature, whose nearest singularity recedes as poles meet, is good to the digits that remain.
    real near = 1.0e-2;
    if (real_digits() > 24) {
        near = 1.0e-6;
    }
    vec2 apart = edge.z1 - edge.z2;
    mask meet = dot(apart, apart) < near * edge.z1.y * edge.z2.y && edge.end > edge.begin;
    if (any_lane(meet)) {
        e = select(meet, ggx_edge_vector_approximate(edge), e);
    }
    return e;
}

// Radiance that the distribution of half vectors alone sends to the view, for radiance 1: INT D / (4 v_z) over the light.
//
//   e        sum over the edges of ggx_edge_vector, negated where the light is seen from behind
//   returns  not negative; above 1 is possible, since nothing shadows: 5.4 at alpha 0.72 and 86 degrees
real ggx_unshadowed(GgxView view, vec3 e) {
    return max(dot(view.w, e), 0.0) * 0.318309886183790672 / view.v.z;
}
