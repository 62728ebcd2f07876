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
// docs/theory/ggx.md has the derivation.
// Frame: z the surface normal, x and y the directions of the widths. Walk order, as polygon.glsl has it.
// Needs: constants.glsl inverse_trig.glsl complex.glsl quartic.glsl gauss_legendre.glsl microfacet.glsl conic.glsl
// Topics: ggx
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The values of the view and the surface that the lobe's integrals need.
//   v        unit view, z > 0
//   w        (ax v_x, ay v_y, v_z): w.u is v.h in stretched space
//   ax, ay   widths: roughness squared, at least 1.0e-4
//   masking  the view's |v|' / v_z of Smith's shadowing, at least 1
struct GgxView {
    vec3 v;
    vec3 w;
    real ax;
    real ay;
    real masking;
};

// Prepares a view.
//
// Degenerate: a view at or below the surface counts as v_z = 1.0e-6; callers give 0 for it.
GgxView ggx_view(vec3 v, real ax, real ay) {
    GgxView view;
    real z = max(v.z, 1.0e-6);
    view.v = vec3(v.x, v.y, z);
    view.w = vec3(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}

// One edge of a light as a scaled arc in stretched half vector space, without its poles (conic_scaled).
//
//   a, b     unit directions of the ends, in walk order, not below the horizon
//
// tau counts from the edge's middle; where the middle is near the view, and u2 = S (v - l) would vanish, from the end that
// is further from it.
// Degenerate: a = b, and a = -b, which spans no plane, give an arc of no length.
ConicArc ggx_edge_scaled(GgxView view, vec3 a, vec3 b) {
    vec3 chord = b - a;
    vec3 sum = a + b;
    real chord2 = dot(chord, chord);
    real sum2 = dot(sum, sum);
    mask usable = chord2 > smallest_divisor() && sum2 > 1.0e-12;
    vec3 middle = sum * inversesqrt(max(sum2, smallest_divisor()));
    vec3 along = chord * inversesqrt(max(chord2, smallest_square()));
    real half_sine = 0.5 * sqrt(chord2);
    real half_cosine = max(0.5 * sqrt(sum2), 1.0e-6);

    mask from_end = dot(middle, view.v) > 0.9;
    real side = select(from_end, select(dot(chord, view.v) > 0.0, -1.0, 1.0), 0.0);
    real turn_cosine = select(from_end, half_cosine, 1.0);
    vec3 base = middle * turn_cosine + along * (side * half_sine);
    vec3 q = along * turn_cosine - middle * (side * half_sine);
    real reach = select(usable, half_sine / (half_cosine + select(from_end, 0.0, 1.0)), 0.0);

    real x = 1.0 / view.ax;
    real y = 1.0 / view.ay;
    vec3 u0 = view.v + base;
    vec3 u2 = view.v - base;
    return conic_scaled(
        vec3(u0.x * x, u0.y * y, u0.z), vec3(q.x * x, q.y * y, q.z) * 2.0, vec3(u2.x * x, u2.y * y, u2.z),
        select(side < 0.0, 0.0, -reach), select(side > 0.0, 0.0, reach));
}

// One edge of a light as an arc in stretched half vector space. Arguments and degenerate case: ggx_edge_scaled.
ConicArc ggx_edge(GgxView view, vec3 a, vec3 b) {
    ConicArc arc = ggx_edge_scaled(view, a, b);
    return conic_with_poles(arc, conic_poles(arc));
}

// Radiance that the distribution of half vectors alone sends to the view, for radiance 1: INT D / (4 v_z) over the light.
//
//   e        sum over the edges of conic_vector, negated where the light is seen from behind
//   returns  not negative; above 1 is possible, since nothing shadows: 5.4 at alpha 0.72 and 86 degrees
real ggx_unshadowed(GgxView view, vec3 e) {
    return max(dot(view.w, e), 0.0) * inverse_pi() / view.v.z;
}

// The lobe itself towards the view, with F = 1 and with F = (1 - v.h)^5: BRDF times cosine, for ggx_radiance.
//
//   l        unit direction of the light; below the surface 0
//   smith    1 with shadowing, 0 without
vec2 ggx_lobe_and_fresnel(GgxView view, vec3 l, real smith) {
    vec3 h = microfacet_half_vector(l, view.v);
    real g = 1.0 + smith * (ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
    real plain = microfacet_lobe_unshadowed(ggx_distribution(h, view.ax, view.ay) * g, l, view.v);
    return vec2(plain, plain * fresnel_schlick(0.0, 1.0, dot(view.v, h)));
}
