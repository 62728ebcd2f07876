// Lobes of half vectors by edge splitting: a light's edge is split into arcs, each arc's image in half vector space is
// replaced by the great circle between its ends, along which the lobe's integral is closed, and what lies between the two
// is a sliver so thin that a few nodes along it serve.
//
// For lobes that have no closed form along the image itself (Blinn-Phong, Beckmann); GGX for comparison with
// ggx_closed_form.glsl. The arcs go where the edge passes the lobe: the poles of the GGX lobe of the same width say where.
//
//   ConicArc edge = ggx_edge(view, a, b);
//   HalfVectorWalk walk = half_vector_begin(view, edge);
//   for j in 1 .. count:
//       walk = half_vector_next(walk, view, edge, half_vector_split_pole_mapped(edge, j / count))
//       sum of blinn_phong_arc or beckmann_arc from walk.a to walk.b, then half_vector_radiance; of ggx_arc, then ggx_draft
//       and of the lobe at each half_vector_node times its solid angle
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
// Source: this project; the share 0.3 keeps arcs for where the lobe is dim (table in docs/theory/ggx.md).
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

// Weight of the edge's own angle in half_vector_split_pole_mapped, per radian.
real half_vector_split_weight(ConicArc edge) {
    real first = trig_atan2(edge.scale * edge.begin, 1.0);
    real last = trig_atan2(edge.scale * edge.end, 1.0);
    return 0.3 / max(last - first, 1.0e-12);
}

// A place of an edge with how dense half_vector_split_pole_mapped lays its places there.
//
//   weight   half_vector_split_weight
ConicNode half_vector_split_end(ConicArc edge, real tau, real weight) {
    real t = edge.scale * tau;
    real x1 = tau - edge.z1.x;
    real x2 = tau - edge.z2.x;
    ConicNode node;
    node.tau = tau;
    node.density = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
        + weight * edge.scale / (1.0 + t * t);
    return node;
}

// A node in the sliver between a great circle and the image that it stands for.
//   h            unit half vector, half way between them
//   solid_angle  positive where the image lies outside the great circle, negative inside [sr]
struct HalfVectorNode {
    vec3 h;
    real solid_angle;
};

// One node of the sliver between an arc's image and the great circle between its ends.
//
//   first, last half_vector_split_end of the arc's ends
//   a, b     half_vector_at of the same
//   rule     node and weight of a rule on [0, 1]: gauss_legendre_node
//
// The image's point x and its foot on the great circle of normal n are n g apart, g = n.x; swept along the arc, what lies
// between them has the solid angle -g n.(x dx) / |x|^3 at the middle. In tau the nodes lie by the map of ends to ends that is
// a quotient of lines and has the slopes of the splits: dense where the arc passes the lobe.
// Degenerate: an arc of no length has no sliver.
// Error: of the rule, with four nodes a tenth to a hundredth of what the great circle alone is off; docs/measured/accuracy.md, "Half vectors".
// Source: this project.
HalfVectorNode half_vector_between(GgxView view, ConicArc edge, ConicNode first, ConicNode last, vec3 a, vec3 b, vec2 rule) {
    real bend = sqrt(first.density / max(last.density, smallest_divisor()));
    real bottom = 1.0 / (rule.x + bend * (1.0 - rule.x));
    real length = last.tau - first.tau;
    real tau = first.tau + length * rule.x * bottom;
    real step = length * bend * bottom * bottom * rule.y;

    vec3 u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    vec3 du = edge.u1 + edge.u2 * (2.0 * tau);
    vec3 x = vec3(view.ax * u.x, view.ay * u.y, u.z);
    vec3 dx = vec3(view.ax * du.x, view.ay * du.y, du.z);
    real inverse = inversesqrt(max(dot(x, x), smallest_divisor()));
    x = x * inverse;
    vec3 n = cross(a, b - a);
    real n2 = dot(n, n);
    n = n * inversesqrt(max(n2, smallest_square()));
    real apart = dot(n, x - a);
    vec3 middle = x - n * (0.5 * apart);
    real shorter = inversesqrt(max(dot(middle, middle), smallest_divisor()));
    real sweep = dot(n, cross(x, dx)) * inverse * step;
    HalfVectorNode node;
    node.h = middle * shorter;
    node.solid_angle = select(n2 > smallest_square(), -apart * sweep * (shorter * shorter * shorter), 0.0);
    return node;
}

// A walk over the arcs of an edge.
//   weight       half_vector_split_weight
//   first, last  half_vector_split_end of the last arc's ends
//   a, b         half_vector_at of the same
struct HalfVectorWalk {
    real weight;
    ConicNode first;
    ConicNode last;
    vec3 a;
    vec3 b;
};

// The walk before the first arc.
HalfVectorWalk half_vector_begin(GgxView view, ConicArc edge) {
    HalfVectorWalk walk;
    walk.weight = half_vector_split_weight(edge);
    walk.last = half_vector_split_end(edge, edge.begin, walk.weight);
    walk.b = half_vector_at(view, edge, edge.begin);
    walk.first = walk.last;
    walk.a = walk.b;
    return walk;
}

// Goes on to the arc that ends at tau.
HalfVectorWalk half_vector_next(HalfVectorWalk walk, GgxView view, ConicArc edge, real tau) {
    HalfVectorWalk next = walk;
    next.first = walk.last;
    next.a = walk.b;
    next.last = half_vector_split_end(edge, tau, walk.weight);
    next.b = half_vector_at(view, edge, tau);
    return next;
}

// Number of nodes of an arc's sliver: three have four to ten times the error (docs/measured/accuracy.md, "Half vectors").
int half_vector_nodes() { return 4; }

// Node i of the last arc's sliver.
HalfVectorNode half_vector_node(HalfVectorWalk walk, GgxView view, ConicArc edge, int i) {
    vec2 rule = gauss_legendre_node(half_vector_nodes(), i);
    return half_vector_between(view, edge, walk.first, walk.last, walk.a, walk.b, rule);
}

// Blinn-Phong's lobe at a half vector, in the unit of blinn_phong_arc for each steradian of half vectors.
//
//   h        unit
real blinn_phong_at_half_vector(vec3 h, vec3 v, real n) {
    return 2.0 * pi() * blinn_phong_distribution(h, n) * max(dot(h, v), 0.0);
}

// Beckmann's lobe at a half vector, in the unit of beckmann_arc for each steradian of half vectors.
real beckmann_at_half_vector(GgxView view, vec3 h) {
    return 2.0 * pi() * beckmann_distribution(h, view.ax, view.ay) * max(dot(h, view.v), 0.0);
}

// The measure of GGX at a half vector, in the unit of ggx_arc for each steradian of half vectors.
vec3 ggx_at_half_vector(GgxView view, vec3 h) {
    vec3 u = vec3(h.x / view.ax, h.y / view.ay, h.z);
    real inverse2 = 1.0 / dot(u, u);
    return u * ((inverse2 / view.ax) * (inverse2 / view.ay));
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
// Error: of the series, see docs/measured/accuracy.md, "phong series".
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
// Error: of the series; see docs/measured/accuracy.md, "half vector".
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
