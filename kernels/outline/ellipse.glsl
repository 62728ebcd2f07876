// Disks and ellipses as lights, and the outlines of spheres and ellipsoids (ellipsoid.glsl), which are ellipses.
//
// An ellipse center + axis_a cos t + axis_b sin t, vectors from the shading point, is a conic in tan(t/2): its irradiance
// is closed (conic.glsl), above the horizon too. For other lobes it becomes a polygon whose corners gather where the
// lobe is sharp.
// Frame: z the surface normal. Walk order: det(center, axis_a, axis_b) > 0, see ellipse_prepare.
// Needs: constants.glsl inverse_trig.glsl light_elements.glsl complex.glsl quartic.glsl gauss_legendre.glsl conic.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// An ellipse, seen from the shading point.
struct Ellipse {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
};

// Turns the axes so that the walk with growing t is in walk order.
//
//   axis_a, axis_b  any two conjugate half axes; they need not be orthogonal
Ellipse ellipse_prepare(vec3 center, vec3 axis_a, vec3 axis_b) {
    Ellipse e;
    e.center = center;
    e.axis_a = axis_a;
    mask reversed = dot(center, cross(axis_a, axis_b)) < 0.0;
    e.axis_b = select(reversed, -axis_b, axis_b);
    return e;
}

// The same in the shading frame and in units of the distance, for any unit: squares of squares stay in the range of float.
Ellipse ellipse_in_units(mat3 frame, vec3 center, vec3 axis_a, vec3 axis_b) {
    real size2 = dot(center, center) + dot(axis_a, axis_a) + dot(axis_b, axis_b);
    real unit = inversesqrt(max(size2, smallest_divisor()));
    return ellipse_prepare(transform_transposed(frame, center) * unit, transform_transposed(frame, axis_a) * unit,
                           transform_transposed(frame, axis_b) * unit);
}

// The ellipse's area as four elements, for where it is small (light_elements.glsl).
//
//   e        of ellipse_prepare
LightElements ellipse_elements(Ellipse e) {
    LightElements elements;
    elements.center = e.center;
    elements.reach_a = e.axis_a * 0.707106781186547524;
    elements.reach_b = e.axis_b * 0.707106781186547524;
    elements.area = cross(e.axis_b, e.axis_a) * pi();
    return elements;
}

// An arc of the ellipse about t = 0 (begin and end are tan(t/2)).
ConicArc ellipse_arc(Ellipse e, real begin, real end) {
    return conic_prepare(e.center + e.axis_a, e.axis_b * 2.0, e.center - e.axis_a, begin, end);
}

// Irradiance vector of the part of the ellipse above the horizon [rad]; z is the irradiance for radiance 1, in [0, pi].
//
//   e        of ellipse_prepare; the shading point is not in its plane
//
// Degenerate: an ellipse below the horizon, without area, or seen from its plane gives 0 up to rounding.
// Error: docs/measured/accuracy.md, "Float against double", ellipse. Exact: 3 arcs of the ellipse and one of the horizon.
vec3 ellipse_irradiance_vector(Ellipse e) {
    // Axes from the highest place: axis_a up the ellipse, axis_b level.
    vec2 up = vec2(e.axis_a.z, e.axis_b.z);
    real rise = sqrt(dot(up, up));
    vec2 turn = select(rise > smallest_divisor(), up * (1.0 / max(rise, smallest_divisor())), vec2(1.0, 0.0));
    Ellipse level;
    level.center = e.center;
    level.axis_a = e.axis_a * turn.x + e.axis_b * turn.y;
    level.axis_b = e.axis_b * turn.x - e.axis_a * turn.y;

    // Above the horizon: |tan(t/2)| <= limit.
    real top = e.center.z + rise;
    real bottom = rise - e.center.z;
    mask shows = top > 0.0;
    mask cut = bottom > 0.0 && shows;
    real limit = sqrt(max(top, 0.0) / max(bottom, smallest_divisor()));
    limit = select(cut, limit, select(shows, 1.0e15, 0.0));
    mask more = limit > 1.0;
    real lower = select(more, 1.0 / max(limit, 1.0), 1.0);
    lower = select(limit > 1.0e14, 0.0, lower);
    Ellipse turned = level;
    real begin = -min(limit, 1.0);
    real end = min(limit, 1.0);
    vec3 sum = vec3(0.0, 0.0, 0.0);
    vec3 far_side = sum;
    // The arc about the highest place, and two that meet at the lowest.
    for (int i = 0; i < 3; i++) {
        vec3 arc = conic_vector(ellipse_arc(turned, begin, end));
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
        if (!any_lane(more)) {
            break;
        }
    }
    sum = select(more, sum + far_side, sum);
    if (any_lane(cut)) {
        // Along the horizon, from where the walk goes down, at +limit, to where it comes up.
        real inverse = 1.0 / (1.0 + limit * limit);
        vec3 middle = level.center + level.axis_a * ((1.0 - limit * limit) * inverse);
        vec3 aside = level.axis_b * (2.0 * limit * inverse);
        vec3 down = middle + aside;
        vec3 back_up = middle - aside;
        real angle = trig_atan2(down.x * back_up.y - down.y * back_up.x, down.x * back_up.x + down.y * back_up.y);
        sum = select(cut, sum + vec3(0.0, 0.0, 0.5 * angle), sum);
    }
    // Seen from its plane it may pass through the shading point, where the curve has no direction.
    real least = 1.0e-12;
    if (real_digits() > 24) {
        least = smallest_divisor();
    }
    real size = sqrt(dot(e.center, e.center)) * sqrt(dot(e.axis_a, e.axis_a)) * sqrt(dot(e.axis_b, e.axis_b));
    mask seen = dot(e.center, cross(e.axis_a, e.axis_b)) > least * size;
    return vec3(select(seen, sum.x, 0.0), select(seen, sum.y, 0.0), select(seen, clamp(sum.z, 0.0, pi()), 0.0));
}

// The same of an ellipse that is all above the horizon: without arcs, from the axes of the cone of directions to it.
//
//   e        of ellipse_prepare
//
// The cone's axes are those of B = a a' + b b' - c c' (a, b: half axes, c: centre), whose eigenvalues are -nu < 0 <= mu1, mu2. Along the
// axis of -nu the cone cuts the plane at distance 1 in an ellipse of half axes sqrt(mu / nu), and by symmetry the vector points along it:
// pi |det(a, b, c)| / sqrt(nu P) long, P = (mu1 + nu)(mu2 + nu). Newton finds nu from above, where the cubic is convex; the
// adjugate of B + nu, times c, is the axis, a sum whose terms all lie on c's side.
// Degenerate: an ellipse without area, or seen from its plane, gives 0.
// Error: next to the rim, at the share h of its reach, float loses a factor 1 / h.
// Source: the form factor of an ellipse from above its centre; this project for the axes.
vec3 ellipse_whole_irradiance_vector(Ellipse e) {
    vec3 normal = cross(e.axis_a, e.axis_b);
    vec3 across_a = cross(e.center, e.axis_a);
    vec3 across_b = cross(e.center, e.axis_b);
    real c2 = dot(e.center, e.center);
    real det = dot(e.center, normal);
    real det2 = det * det;
    real t = dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b) - c2;
    real s = dot(normal, normal) - dot(across_a, across_a) - dot(across_b, across_b);
    real tolerance = 1.0e-7;
    if (real_digits() > 24) {
        tolerance = 1.0e-15;
    }
    real nu = c2;
    mask moving = mask_all();  // a lane that stands still stays so, whatever its neighbours do
    for (int i = 0; i < 24; i++) {
        real step = (((nu + t) * nu + s) * nu - det2) / max((3.0 * nu + 2.0 * t) * nu + s, smallest_divisor());
        real next = clamp(nu - step, 0.0, nu);
        mask still_moving = moving && nu - next > tolerance * nu;
        nu = select(moving, next, nu);
        moving = still_moving;
        if (!any_lane(moving)) {
            break;
        }
    }
    vec3 axis = e.center * (nu * nu) + (cross(e.axis_a, across_a) + cross(e.axis_b, across_b)) * nu + normal * det;
    // |axis| = P |v.c| and axis.c = P (v.c)^2 with the unit axis v.
    real length2 = max(dot(axis, axis), smallest_square());
    real p = length2 / max(dot(axis, e.center), smallest_divisor());
    return axis * (pi() * det * inversesqrt(max(length2 * nu * p, smallest_square())));
}

// A polygon about an ellipse: where its corners gather.
//   ellipse    prepared
//   turn       (cos, sin) of the t of the corner nearest to the lobe
//   beta       1: corners at equal steps of t; below, they gather about that corner
//   near       whether the point is near the rim: then half of the corners, in steps that grow with the distance from there
//   near_turn  (cos, sin) of the t of the rim's place next to the point
//   near_beta  half its distance, in units of t
struct EllipseFan {
    Ellipse ellipse;
    vec2 turn;
    real beta;
    mask near;
    vec2 near_turn;
    real near_beta;
};

// The polygon whose corners stand at equal steps of t.
EllipseFan ellipse_fan(Ellipse e) {
    EllipseFan fan;
    fan.ellipse = e;
    fan.turn = vec2(1.0, 0.0);
    fan.beta = 1.0;
    fan.near = mask_none();
    fan.near_turn = vec2(1.0, 0.0);
    fan.near_beta = 1.0;
    return fan;
}

// A vector from the shading point to the rim.
vec3 ellipse_rim(Ellipse e, vec2 turn) { return e.center + e.axis_a * turn.x + e.axis_b * turn.y; }

// (cos t, sin t) of the rim's place nearest to the shading point.
//
// The nearest of eight places, and four of Newton's steps of at most 0.4 from there, or down the slope where the distance curves
// the other way. A place that is a little off costs nothing.
vec2 ellipse_nearest(Ellipse e) {
    vec2 nearest = vec2(1.0, 0.0);
    vec3 rim = ellipse_rim(e, nearest);
    real least = dot(rim, rim);
    for (int k = 1; k < 8; k++) {
        vec2 turn = complex_unit(0.25 * pi() * real(k - 8 * (k / 5)));
        rim = ellipse_rim(e, turn);
        real distance2 = dot(rim, rim);
        nearest = select(distance2 < least, turn, nearest);
        least = min(distance2, least);
    }
    for (int i = 0; i < 4; i++) {
        rim = ellipse_rim(e, nearest);
        vec3 tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        real slope = dot(rim, tangent);
        real curvature = dot(tangent, tangent) - dot(rim, rim - e.center);
        real step = -slope / max(abs(curvature), 1.0e-3 * dot(tangent, tangent) + smallest_divisor());
        nearest = complex_product(nearest, complex_unit(clamp(step, -0.4, 0.4)));
    }
    return nearest;
}

// Gathers half of the corners where the point is near the rim, closer than a fifth of its distance from the far end: what a
// fixed share of the radius stands out, or leaves out, would else be the half of what is seen.
//
// From the rim's nearest place, steps as long as half the distance, growing with it by a constant factor: to the eye all
// are alike. The other half stays with the lobe, which may meet the rim elsewhere. Of 32 corners, errors: docs/theory/ggx.md, section 6.
EllipseFan ellipse_fan_near(EllipseFan usual) {
    Ellipse e = usual.ellipse;
    EllipseFan fan = usual;
    // From further than one and a half of its reach, no end of the rim is five times as far as another.
    mask may_be = dot(e.center, e.center) < 2.25 * (dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b));
    if (any_lane(may_be)) {
        vec2 nearest = ellipse_nearest(e);
        vec3 rim = ellipse_rim(e, nearest);
        vec3 opposite = ellipse_rim(e, -nearest);
        vec3 tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        real distance2 = dot(rim, rim);
        fan.near = may_be && distance2 < 0.04 * dot(opposite, opposite);
        fan.near_turn = nearest;
        fan.near_beta = clamp(0.5 * sqrt(distance2 / max(dot(tangent, tangent), smallest_divisor())), 1.0e-6, 1.0);
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
EllipseFan ellipse_fan_concentrated(Ellipse e, vec3 r, real width) {
    vec3 normal = cross(e.axis_a, e.axis_b);
    real n2 = max(dot(normal, normal), smallest_divisor());
    real height = dot(e.center, normal);  // > 0 in walk order
    real along = dot(r, normal);
    // The place at which the axis meets the plane, in units of the half axes: (x, y) / along.
    vec3 across = r * height - e.center * along;
    vec2 place = vec2(dot(across, cross(e.axis_b, normal)), dot(across, cross(normal, e.axis_a))) * (1.0 / n2);
    real size2 = dot(place, place);
    mask off_centre = size2 > 1.0e-20;
    EllipseFan fan = ellipse_fan(e);
    fan.turn = select(off_centre, place * inversesqrt(max(size2, 1.0e-20)), vec2(1.0, 0.0));
    vec3 rim = e.center + e.axis_a * fan.turn.x + e.axis_b * fan.turn.y;
    vec3 tangent = e.axis_b * fan.turn.x - e.axis_a * fan.turn.y;
    real reach = min(sqrt(size2) / max(along, 1.0e-12), 1.0e6);
    real blur = 1.6 * width * sqrt(dot(rim, rim) / max(dot(tangent, tangent), smallest_divisor()));
    real beta = sqrt(0.5 * (1.0 - reach) * (1.0 - reach) + min(blur * blur, 1.0e6));
    fan.beta = select(along > 0.0, clamp(beta, 0.05, 1.0), 1.0);
    return ellipse_fan_near(fan);
}

// (cos t/2, sin t/2) where tan(t/2) = near_beta sinh(x), t from the rim's place next to the point.
vec2 ellipse_near_place(EllipseFan fan, real x) {
    real power = exp(x);
    return complex_sign(vec2(1.0, 0.5 * fan.near_beta * (power - 1.0 / power)));
}

// The share of the corners up to a place of a rim that is near: the mean of the lobe's share and of the near place's.
//
//   x        as in ellipse_near_place
//   lobe     (cos t/2, sin t/2) of the lobe's place, from the same origin
//   reach    the x up to which, on either side, the near place has corners
real ellipse_near_share(EllipseFan fan, real x, vec2 lobe, real reach) {
    vec2 w = ellipse_near_place(fan, x);
    vec2 from_lobe = vec2(w.x * lobe.x + w.y * lobe.y, (w.y * lobe.x - w.x * lobe.y) / fan.beta);
    vec2 start = vec2(-lobe.y, -lobe.x / fan.beta);  // opposite the near place
    real angle = trig_atan2_unwrapped(start.x * from_lobe.y - start.y * from_lobe.x, start.x * from_lobe.x + start.y * from_lobe.y);
    return 0.5 * (angle * inverse_pi() + clamp(0.5 + 0.5 * x / reach, 0.0, 1.0));
}

// (cos t/2, sin t/2) of corner k of count of a rim that is near, from the rim's place next to the point.
//
// The share's inverse, by a bracket that eight halvings leave and a straight line in it: a corner that is a little off costs nothing,
// and none passes another.
vec2 ellipse_near_corner(EllipseFan fan, int k, int count) {
    real far_side = 4.0 / fan.near_beta;
    real reach = log(far_side + sqrt(far_side * far_side + 1.0));
    vec2 apart = vec2(fan.turn.x * fan.near_turn.x + fan.turn.y * fan.near_turn.y, fan.turn.y * fan.near_turn.x - fan.turn.x * fan.near_turn.y);
    vec2 lobe = vec2(1.0 + apart.x, apart.y);
    lobe = select(dot(lobe, lobe) > 1.0e-10, complex_sign(lobe), vec2(0.0, 1.0));
    int turn = k / count;  // -1, as 0, stands for the corners before the first
    if (k < 0) {
        turn = -1;
    }
    real share = (real(k - turn * count) + 0.5) / real(count);
    real low = -reach - 3.0;
    real high = reach + 3.0;
    real low_share = 0.0;
    real high_share = 1.0;
    for (int i = 0; i < 8; i++) {
        real middle = 0.5 * (low + high);
        real value = ellipse_near_share(fan, middle, lobe, reach);
        mask below = value < share;
        low = select(below, middle, low);
        low_share = select(below, value, low_share);
        high = select(below, high, middle);
        high_share = select(below, high_share, value);
    }
    real rest = clamp((share - low_share) / max(high_share - low_share, 1.0e-6), 0.0, 1.0);
    return ellipse_near_place(fan, low + rest * (high - low));
}

// (cos t, sin t) of corner k of count, counted from the middle one.
vec2 ellipse_corner(EllipseFan fan, int k, int count) {
    real half_angle = pi() * (real(k) / real(count) - 0.5);
    vec2 u = complex_unit(half_angle);
    vec2 w = complex_sign(vec2(u.x, fan.beta * u.y));
    vec2 corner = complex_product(complex_product(w, w), fan.turn);
    if (any_lane(fan.near)) {
        w = ellipse_near_corner(fan, k, count);
        corner = select(fan.near, complex_product(complex_product(w, w), fan.near_turn), corner);
    }
    return corner;
}

// The angle from one corner to the next over its sine: what equal area needs; the angle is taken up to 2.6.
real ellipse_gap(vec2 from_corner, vec2 to_corner) {
    real c = dot(from_corner, to_corner);
    real s = from_corner.x * to_corner.y - from_corner.y * to_corner.x;
    real angle = trig_atan2_unwrapped(s, c);
    angle = clamp(angle, 0.0, 2.6);
    real sine = select(c > -0.856888753368947234 && s > 0.0, s, 0.515501371821464235);
    return select(angle < 1.0e-3, 1.0, angle / max(sine, 1.0e-4));
}

// A corner, as a vector from the shading point.
//
//   gaps     sum of ellipse_gap to the corner before it and to the one after it
//
// Pushed out so that the polygon has about the ellipse's area: inscribed, 8 corners lose several percent.
vec3 ellipse_corner_between(EllipseFan fan, vec2 here, real gaps) {
    real radius = sqrt(0.5 * gaps);
    Ellipse e = fan.ellipse;
    return e.center + (e.axis_a * here.x + e.axis_b * here.y) * radius;
}

// The corner between two others, as a vector from the shading point.
//
//   before, here, after  ellipse_corner of three neighbours
vec3 ellipse_pushed_corner(EllipseFan fan, vec2 before, vec2 here, vec2 after) {
    return ellipse_corner_between(fan, here, ellipse_gap(before, here) + ellipse_gap(here, after));
}

// Corner k of the polygon with count corners (even, 6 to 64), k from 0, as a vector from the shading point, in walk order.
//
// Error: docs/measured/accuracy.md, "Float against double", ellipse.
vec3 ellipse_fan_corner(EllipseFan fan, int k, int count) {
    return ellipse_pushed_corner(fan, ellipse_corner(fan, k - 1, count), ellipse_corner(fan, k, count), ellipse_corner(fan, k + 1, count));
}
