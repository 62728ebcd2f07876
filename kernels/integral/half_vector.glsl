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
// Needs: constants.glsl inverse_trig.glsl complex.glsl quartic.glsl gauss_legendre.glsl conic.glsl microfacet.glsl phong.glsl moment.glsl moment_quadrature.glsl moment_series.glsl moment_cosine.glsl polygon.glsl ggx_closed_form.glsl
// Topics: half_vector blinn_phong beckmann ggx
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The GGX width whose lobe is as wide as Blinn-Phong's of exponent n: both have the mean squared slope 2 / (n + 2).
real blinn_phong_alpha(real n) {
    return sqrt(2.0 / (n + 2.0));
}

// Unit half vector at a place of an edge.
vec3 half_vector_at(GgxView view, ConicArc edge, real tau) {
    vec3 u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    vec3 h = vec3(view.ax * u.x, view.ay * u.y, u.z);
    return h * inversesqrt(max(dot(h, h), smallest_divisor()));
}

// The place at a share of the edge's angle, seen from the surface: equal arcs on the light.
real half_vector_split_uniform(ConicArc edge, real share) {
    real first = trig_atan2(edge.scale * edge.begin, 1.0);
    real last = trig_atan2(edge.scale * edge.end, 1.0);
    vec2 u = complex_unit(first + share * (last - first));
    return clamp(u.y / max(u.x * edge.scale, smallest_length()), edge.begin, edge.end);
}

// The place at a share of the angle C under which the poles see the edge, plus 0.3 for the edge's own length: arcs where
// the edge passes the lobe, and some for the rest.
//
// Newton's steps where they halve what is left, else the middle of a bracket: 5 or 6 as a rule, 24 at most; to the last
// digits, since a light that is thin, or seen edge-on, is what two edges leave of each other's errors: both must be split
// at the same places.
// Source: this project; the share 0.3 keeps arcs for where the lobe is dim (table in docs/ggx.md).
real half_vector_split_pole_mapped(ConicArc edge, real share) {
    real first = trig_atan2(edge.scale * edge.begin, 1.0);
    real last = trig_atan2(edge.scale * edge.end, 1.0);
    real weight = 0.3 / max(last - first, 1.0e-12);
    real total = edge.sweep.x + edge.sweep.y + 0.3;
    real tolerance = 2.0e-6;
    if (real_digits() > 24) {
        tolerance = 1.0e-13;
    }
    ConicNode node = conic_node(edge, share);
    real tau = node.tau;
    real low = edge.begin;
    real high = edge.end;
    real left = total;
    mask off = edge.end > edge.begin;
    for (int i = 0; i < 24; i++) {
        if (any_lane(off)) {
            real t = edge.scale * tau;
            real value = conic_sweep(edge.z1, edge.begin, tau) + conic_sweep(edge.z2, edge.begin, tau)
                + weight * (trig_atan2(t, 1.0) - first) - share * total;
            real x1 = tau - edge.z1.x;
            real x2 = tau - edge.z2.x;
            real slope = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
                + weight * edge.scale / (1.0 + t * t);
            low = select(value < 0.0, tau, low);
            high = select(value < 0.0, high, tau);
            real next = tau - value / slope;
            mask fast = next > low && next < high && abs(value) < 0.5 * left;
            off = off && abs(value) > tolerance * total;
            left = abs(value);
            tau = select(off, select(fast, next, 0.5 * (low + high)), tau);
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
real blinn_phong_arc(vec3 a, vec3 b, vec3 v, real n) {
    vec3 z = vec3(0.0, 0.0, 1.0);
    MomentEdge edge = moment_edge(a, b, z);
    MomentIntegrands front = moment_quadrature_front(edge, max(n, 1.0e-6) - 1.0);
    return moment_double_axis_share(a, b, z, v, moment_edge_share(edge, front.moment), front.power);
}

// One arc's share of Blinn-Phong as in blinn_phong_arc, by the cosine series and the error function instead of quadrature.
//
//   series   of exponent n - 1, or of n + 1 where n < 2
//   range    0 for n >= 8, 1 for 2 <= n < 8, 2 for n < 2; the same for every lane
//
// Error: of the series, see docs/accuracy.md, "phong series".
real blinn_phong_arc_approximate(vec3 a, vec3 b, vec3 v, MomentSeries series, real n, int range) {
    vec3 z = vec3(0.0, 0.0, 1.0);
    MomentEdge edge = moment_edge(a, b, z);
    real front = 0.0;
    if (range == 2) {
        front = moment_series_low_front(edge, series, n - 1.0);
    } else {
        front = moment_series_front(edge, series);
    }
    int low = 0;
    if (range > 0) {
        low = 1;
    }
    return moment_double_axis_share(a, b, z, v, moment_edge_share(edge, front), moment_cosine_front(edge, n, low));
}

// The error function. Error: 1.5e-7 absolute.
// Source: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 7.1.26.
real beckmann_error_function_approximate(real x) {
    real t = abs(x);
    real e = 1.0 / (1.0 + 0.3275911 * t);
    real p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    real y = 1.0 - p * exp(-min(t * t, 80.0));
    return select(x < 0.0, -y, y);
}

// The series that beckmann_arc takes: that of an infinite exponent.
MomentSeriesHigh beckmann_series() {
    MomentSeriesHigh series = moment_series_high_prepare(1.0e30);
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
real beckmann_arc(GgxView view, vec3 a, vec3 b, MomentSeriesHigh series) {
    real za = 1.0 / max(a.z, 1.0e-6);
    real zb = 1.0 / max(b.z, 1.0e-6);
    vec2 p = vec2(a.x * za / view.ax, a.y * za / view.ay);
    vec2 q = vec2(b.x * zb / view.ax, b.y * zb / view.ay);
    vec2 along = q - p;
    real length2 = dot(along, along);
    mask usable = length2 > smallest_divisor();
    along = along * inversesqrt(max(length2, smallest_divisor()));
    real d = p.x * along.y - p.y * along.x;
    real low = dot(p, along);
    real high = dot(q, along);

    MomentEdge edge;
    edge.side = select(d < 0.0, -1.0, 1.0);
    edge.s = max(abs(d), 1.0e-6);
    edge.c = 1.0;
    edge.x0 = 1.0;
    edge.y0 = low;
    edge.x1 = 1.0;
    edge.y1 = high;
    edge.log_c = min(edge.s * edge.s, 80.0);
    edge.swept = 0.0;
    real around = moment_edge_share(edge, moment_series_high_front(edge, series));
    real across = exp(-edge.log_c) * 0.886226925452758014
        * (beckmann_error_function_approximate(high) - beckmann_error_function_approximate(low));
    real share = view.w.z * around + (view.w.y * along.x - view.w.x * along.y) * across;
    return select(usable, share, 0.0);
}

// One arc's share of E (ggx_closed_form.glsl) for GGX, exact along the great circle.
vec3 ggx_arc(GgxView view, vec3 a, vec3 b) {
    vec3 p = polygon_direction(vec3(a.x / view.ax, a.y / view.ay, a.z));
    vec3 q = polygon_direction(vec3(b.x / view.ax, b.y / view.ay, b.z));
    return polygon_edge(p, q);
}

// Radiance from the sum over the arcs, for radiance 1; not negative.
//
//   facing   1.0; -1.0 where the light is seen from behind
real half_vector_radiance(GgxView view, real sum, real facing) {
    return max(sum * facing, 0.0) * inverse_two_pi() / view.v.z;
}
