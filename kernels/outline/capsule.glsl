// Tubes as lights: a capsule is all that lies within a radius of a segment; and the line that it becomes as the radius goes
// to 0.
//
// Seen from outside, a capsule fills the convex hull of two round caps, the images of its end balls. Two planes through the
// point touch both balls; the outline is an arc about each cap and two great circles between them. All four pieces have
// antiderivatives in elementary functions: the irradiance needs no more than four arc tangents. Where the point sees one
// cap within the other, it sees a sphere.
// Frame: z the surface normal; origin at the shading point. Any unit of length, but float wants distances near 1.
// Needs: constants.glsl inverse_trig.glsl frame.glsl polygon.glsl light_elements.glsl complex.glsl ellipse.glsl
// Topics: capsule, line
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The capsule as four elements, for where it is small: the strip of its cylinder, which is equally wide from all directions
// across, and the half balls at its ends. Each has its second moment along the axis.
//
//   center   its middle, from the shading point
//   axis     from one end to the other
//
// Degenerate: ends that meet make a sphere.
LightElements capsule_elements(vec3 center, vec3 axis, real radius) {
    real r2 = radius * radius;
    real length2 = dot(axis, axis);
    vec3 along = axis * inversesqrt(max(length2, smallest_square()));
    vec3 sight = center * inversesqrt(max(dot(center, center), smallest_square()));
    vec3 across = sight - along * dot(along, sight);
    vec3 aside = cross(along, sight);
    real strip = 2.0 * radius * sqrt(length2);
    real balls = pi() * r2;
    real share = 2.0 / max(strip + balls, smallest_square());
    LightElements e;
    e.center = center;
    e.area = -(across * (inversesqrt(max(dot(across, across), 1.0e-12)) * strip) + sight * balls);
    e.reach_a = along * sqrt(share * (strip * length2 * 0.0833333333333333333 + balls * (length2 + r2) * 0.25));
    e.reach_b = aside * (inversesqrt(max(dot(aside, aside), 1.0e-12)) * sqrt(share * r2 * (strip * 0.333333333333333333 + balls * 0.25)));
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
struct Capsule {
    vec3 end_a;
    vec3 end_b;
    vec3 along;
    vec3 toward;
    real at_a;
    real at_b;
    real span;
    real height;
    real radius;
    mask outside;
};

// Prepares a capsule.
//
//   end_a, end_b  centres of the end balls, from the shading point
//   radius        not negative
//
// Degenerate: ends that meet make a sphere. A point inside gives finite members.
Capsule capsule_prepare(vec3 end_a, vec3 end_b, real radius) {
    vec3 difference = end_b - end_a;
    real span2 = dot(difference, difference);
    real a2 = dot(end_a, end_a);
    real b2 = dot(end_b, end_b);
    vec3 nearer = select(a2 < b2, end_a, end_b);
    real nearer2 = min(a2, b2);
    vec3 along = difference * inversesqrt(max(span2, smallest_square()));
    vec3 moment = cross(nearer, along);
    real height2 = dot(moment, moment);
    real at_a = dot(end_a, along);
    real at_b = dot(end_b, along);
    real radius2 = radius * radius;
    // From within the endless cylinder, the nearer ball hides the other.
    mask tube = height2 > radius2 && span2 > smallest_divisor();
    mask beside = at_a < 0.0 && at_b > 0.0 && span2 > smallest_divisor();

    real nearest = sqrt(nearer2);
    vec3 direction = select(nearer2 > smallest_square(), nearer * inversesqrt(max(nearer2, smallest_square())), vec3(0.0, 0.0, 1.0));
    mat3 across = frame_from_normal(direction);
    Capsule c;
    c.end_a = select(tube, end_a, nearer);
    c.end_b = select(tube, end_b, nearer);
    c.along = select(tube, along, transform(across, vec3(1.0, 0.0, 0.0)));
    c.toward = select(tube, cross(along, moment) * inversesqrt(max(height2, smallest_square())), direction);
    c.at_a = select(tube, at_a, 0.0);
    c.at_b = select(tube, at_b, 0.0);
    c.span = select(tube, sqrt(span2), 0.0);
    c.height = select(tube, sqrt(height2), nearest);
    c.radius = radius;
    c.outside = select(beside, height2, nearer2) > radius2;
    return c;
}

// The same in units of the distance, for ends in any unit: squares of squares stay in the range of float.
Capsule capsule_in_units(vec3 end_a, vec3 end_b, real radius) {
    real unit = inversesqrt(max(dot(end_a, end_a) + dot(end_b, end_b) + radius * radius, smallest_divisor()));
    return capsule_prepare(end_a * unit, end_b * unit, radius * unit);
}

// Distance of the two touching planes' lines of touch from the point: sqrt(height^2 - radius^2).
real capsule_touch(Capsule c) {
    return sqrt(max((c.height - c.radius) * (c.height + c.radius), 0.0));
}

// Half the angle of an end's arc [rad], in [0, pi], counted about the cap's centre. Those of the two ends sum to pi where they
// meet.
//
//   place     of the end along the axis, outward: -at_a of end_a, at_b of end_b
//   distance  of the end's centre
real capsule_half_angle(Capsule c, real place, real distance) {
    return trig_atan2(capsule_touch(c), c.radius * place / max(distance, smallest_length()));
}

// Irradiance vector of a line's or a capsule's two great circles and the chords of its arcs, over 2 radius / height.
//
//   angle    of the great circles [rad]
//   share    of the chords' length in the width: sqrt(1 - (radius / height)^2), 1 for a line; the others as in Capsule
//
// The chords' parts nearly cancel for a short or distant light; their difference is formed on paper.
vec3 capsule_straight_part(vec3 along, vec3 toward, real at_a, real at_b, real span, real height, real angle, real share) {
    real h2 = height * height;
    real both = (h2 + at_a * at_a) * (h2 + at_b * at_b);
    real chords = share * span * height / max(both, smallest_square());
    return toward * (0.5 * (angle + chords * (h2 - at_a * at_b))) + along * (0.5 * chords * height * (at_a + at_b));
}

// Irradiance vector of the whole capsule, the horizon left out [sr].
//
//   c        prepared; the point is outside
//
// Degenerate: radius 0 gives 0.
// Error: relative to the value, but for what height and at_a, at_b lose of a capsule seen end-on.
// Source: this project; Stokes' theorem as in conic.glsl. Small circles: Lambert 1760.
vec3 capsule_whole_vector(Capsule c) {
    real touch = capsule_touch(c);
    real angle = trig_atan2_unwrapped(c.span * touch, touch * touch + c.at_a * c.at_b);
    real share = touch / max(c.height, smallest_length());
    real slope = c.radius / max(c.height, smallest_length());
    vec3 e = capsule_straight_part(c.along, c.toward, c.at_a, c.at_b, c.span, c.height, angle, share) * (2.0 * slope);
    real a2 = max(dot(c.end_a, c.end_a), smallest_square());
    real b2 = max(dot(c.end_b, c.end_b), smallest_square());
    real ia = inversesqrt(a2);
    real ib = inversesqrt(b2);
    real sine_a = c.radius * ia;
    real sine_b = c.radius * ib;
    e = e + c.end_a * (sine_a * sine_a * ia * capsule_half_angle(c, -c.at_a, sqrt(a2)));
    return e + c.end_b * (sine_b * sine_b * ib * capsule_half_angle(c, c.at_b, sqrt(b2)));
}

// Adds the arc of an end to a walk, clipped to the horizon z = 0.
//
//   center      of the end's ball
//   middle      unit, across `center`: where the arc's middle lies
//   half_angle  of the arc [rad], in [0, pi]
//   start, finish  unit directions of its ends, in walk order
//
// Where the arc crosses is decided by the ends' signs alone, as for straight edges (polygon_add_edge), so that both agree at
// the joints; an arc between two ends on one side crosses twice or not at all.
PolygonWalk capsule_add_arc(PolygonWalk walk, vec3 center, real radius, vec3 middle, real half_angle, vec3 start, vec3 finish) {
    real d2 = max(dot(center, center), smallest_square());
    real distance = sqrt(d2);
    real inverse = 1.0 / distance;
    real tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    real root = sqrt(max((radius - center.z) * (radius + center.z), 0.0));

    // Angles about the cap's centre, from its highest point: of the horizon and of the arc's middle (mirrored: >= 0).
    real horizon = trig_atan2(distance * root, -tangent * center.z);
    horizon = select(root > 0.0, horizon, select(center.z > 0.0, pi(), 0.0));
    real turn = trig_atan2(abs(middle.x * center.y - middle.y * center.x) * inverse, middle.z);
    real low = turn - half_angle;
    real high = turn + half_angle;
    real seen = max(min(high, horizon) - max(low, -horizon), 0.0) + max(high - (2.0 * pi() - horizon), 0.0);

    // The crossings of the cap's rim: azimuths left and right of the cap's own.
    real flat2 = max(center.x * center.x + center.y * center.y, smallest_square());
    vec2 azimuth = vec2(center.x, center.y) * inversesqrt(flat2);
    vec2 tilt = complex_sign(vec2(tangent, root));
    vec2 comes = complex_product(azimuth, tilt);
    vec2 goes = complex_product(azimuth, vec2(tilt.x, -tilt.y));

    mask start_below = start.z < 0.0;
    mask finish_below = finish.z < 0.0;
    mask meets = root > 0.0;
    mask twice = meets && ((!start_below && !finish_below && high > pi()) || (start_below && finish_below && turn < half_angle));
    mask comes_up = twice || (start_below && !finish_below);
    mask goes_down = twice || (finish_below && !start_below);
    vec3 nowhere = vec3(0.0, 0.0, 0.0);
    vec3 chord = select(start_below, nowhere, start) - select(finish_below, nowhere, finish);
    chord = chord + select(comes_up, vec3(comes.x, comes.y, 0.0), nowhere);
    chord = chord - select(goes_down, vec3(goes.x, goes.y, 0.0), nowhere);

    real sine = radius * inverse;
    PolygonWalk next = walk;
    next.edges = walk.edges + center * (0.5 * sine * sine * inverse * seen) -
                 cross(center, chord) * (0.5 * tangent * inverse * inverse);
    vec2 up = select(comes_up, comes, vec2(1.0, 0.0));
    vec2 down = select(goes_down, vec2(goes.x, -goes.y), vec2(1.0, 0.0));
    next.horizon = complex_product(walk.horizon, complex_product(up, down));
    return next;
}

// Irradiance vector of the part of the capsule above the horizon [sr]; z is the irradiance for radiance 1, in [0, pi].
//
//   c        of capsule_prepare
//
// Degenerate: a capsule below the horizon and a point inside give 0.
// Error: docs/measured/accuracy.md, "Float against double", capsule. Exact: two arcs, two edges and an arc of the horizon.
vec3 capsule_irradiance_vector(Capsule c) {
    vec3 e = capsule_whole_vector(c);
    mask cut = min(c.end_a.z, c.end_b.z) < c.radius;
    if (any_lane(cut)) {
        real a2 = dot(c.end_a, c.end_a);
        real b2 = dot(c.end_b, c.end_b);
        real r2 = c.radius * c.radius;
        vec3 side = cross(c.toward, c.along);
        vec3 inward = c.toward * (r2 / max(c.height, smallest_length()));
        vec3 aside = side * (c.radius * capsule_touch(c) / max(c.height, smallest_length()));
        real ia = inversesqrt(max(a2 - r2, smallest_square()));
        real ib = inversesqrt(max(b2 - r2, smallest_square()));
        vec3 a_left = (c.end_a - inward + aside) * ia;
        vec3 a_right = (c.end_a - inward - aside) * ia;
        vec3 b_left = (c.end_b - inward + aside) * ib;
        vec3 b_right = (c.end_b - inward - aside) * ib;
        real da = sqrt(max(a2, smallest_square()));
        real db = sqrt(max(b2, smallest_square()));
        vec3 a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
        vec3 b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
        PolygonWalk walk = polygon_begin();
        walk = capsule_add_arc(walk, c.end_a, c.radius, a_middle, capsule_half_angle(c, -c.at_a, da), a_left, a_right);
        walk = polygon_add_edge(walk, a_right, b_right);
        walk = capsule_add_arc(walk, c.end_b, c.radius, b_middle, capsule_half_angle(c, c.at_b, db), b_right, b_left);
        walk = polygon_add_edge(walk, b_left, a_left);
        mask shows = max(c.end_a.z, c.end_b.z) > -c.radius;
        vec3 above = polygon_irradiance_vector(walk, mask_none());
        e = select(cut, select(shows, above, vec3(0.0, 0.0, 0.0)), e);
    }
    e = vec3(e.x, e.y, clamp(e.z, 0.0, pi()));
    return select(c.outside, e, vec3(0.0, 0.0, 0.0));
}

// Irradiance vector of the part of a line above the horizon [1 / m]: the limit of a capsule's over its width 2 radius.
//
//   end_a, end_b  from the shading point
//
// Degenerate: a line towards the point, or of no length, gives 0; one that passes through the point a finite value.
// Error: docs/measured/accuracy.md, "Float against double", line. A capsule differs by at most docs/eval.md's bound.
// Source: as for any linear light; here the limit of capsule_whole_vector.
vec3 line_irradiance_vector(vec3 end_a, vec3 end_b) {
    real wa = abs(end_a.z);
    real wb = abs(end_b.z);
    vec3 crossing = (end_a * wb + end_b * wa) * (1.0 / max(wa + wb, smallest_square()));
    vec3 a = select(end_a.z < 0.0, crossing, end_a);
    vec3 b = select(end_b.z < 0.0, crossing, end_b);
    vec3 difference = b - a;
    real span2 = dot(difference, difference);
    vec3 along = difference * inversesqrt(max(span2, smallest_square()));
    vec3 moment = cross(select(dot(a, a) < dot(b, b), a, b), along);
    real height2 = max(dot(moment, moment), smallest_square());
    real height = sqrt(height2);
    vec3 toward = cross(along, moment) * (1.0 / height);
    real span = sqrt(span2);
    real at_a = dot(a, along);
    real at_b = dot(b, along);
    real angle = trig_atan2_unwrapped(span * height, height2 + at_a * at_b);
    vec3 e = capsule_straight_part(along, toward, at_a, at_b, span, height, angle, 1.0) * (1.0 / height);
    e = vec3(e.x, e.y, max(e.z, 0.0));
    return select(end_a.z <= 0.0 && end_b.z <= 0.0, vec3(0.0, 0.0, 0.0), e);
}

// Corners about the arc of one end.
//   center, middle, side  the rim is center + middle cos t + side sin t, vectors from the shading point
//   last                  (cos, sin) of half the arc's angle, where it ends; it begins at (last.x, -last.y)
//   corners               how many, 1 or more
//   turn                  (cos, sin) of the place nearest to the lobe
//   beta                  1: equal steps; below, corners gather there
//   first, step           of the arc's parameter, half a turn a corner
struct CapsuleEnd {
    vec3 center;
    vec3 middle;
    vec3 side;
    vec2 last;
    real corners;
    vec2 turn;
    real beta;
    real first;
    real step;
};

// A polygon about a capsule's outline: straight edges stay straight, each arc becomes a chain of corners.
struct CapsuleFan {
    CapsuleEnd a;
    CapsuleEnd b;
};

// Prepares the arc of one end as a single step; capsule_fan divides it.
//
//   center      of the ball
//   middle      unit, across `center`, where the arc's middle lies
//   r, width    the lobe's unit axis and width [rad], as for ellipse_fan_concentrated
CapsuleEnd capsule_end(vec3 center, real radius, vec3 middle, real half_angle, vec3 r, real width) {
    real d2 = max(dot(center, center), smallest_square());
    real inverse = inversesqrt(d2);
    real sine = max(radius * inverse, smallest_length());
    real cosine2 = max(1.0 - sine * sine, smallest_length());
    real cosine = sqrt(cosine2);
    vec3 axis = center * inverse;
    vec3 side = cross(axis, middle);
    CapsuleEnd end;
    end.center = center * cosine2;
    end.middle = middle * (radius * cosine);
    end.side = side * (radius * cosine);
    end.last = complex_unit(half_angle);

    // The place at which the lobe's axis meets the rim's plane, in units of the rim's radius.
    real along = dot(r, axis);
    vec2 place = vec2(dot(r, middle), dot(r, side)) * (cosine / (sine * max(along, 1.0e-12)));
    real nearest = clamp(trig_atan2(place.y, place.x), -half_angle, half_angle);
    end.turn = complex_unit(nearest);
    vec2 apart = place - end.turn;
    real blur = min(1.6 * width / sine, 1.0e3);
    real beta = sqrt(min(0.5 * dot(apart, apart), 1.0e6) + blur * blur);
    end.beta = select(along > 0.0, clamp(beta, 0.05, 1.0), 1.0);

    vec2 low = complex_unit(-0.5 * (half_angle + nearest));
    vec2 high = complex_unit(0.5 * (half_angle - nearest));
    end.first = trig_atan2(low.y, end.beta * low.x);
    end.step = trig_atan2(high.y, end.beta * high.x) - end.first;
    end.corners = 1.0;
    return end;
}

// (cos t, sin t) of corner j of an end, in the middle of its step.
//
// The outer ones lie on the straight edges' continuation and keep within 0.35 of the arc's ends: of 0.35, 0.5 and 0.7 the one
// with the smallest errors in the test CapsulePolygons.
vec2 capsule_corner(CapsuleEnd end, real j) {
    vec2 u = complex_unit(clamp(end.first + end.step * (j + 0.5), -pi(), pi()));
    vec2 w = complex_sign(vec2(u.x, end.beta * u.y));
    vec2 corner = complex_product(complex_product(w, w), end.turn);
    vec2 limit = vec2(0.939372712847378920, 0.342897807455451364);  // (cos, sin) of 0.35
    mask outer_low = j < 0.5;
    mask outer_high = j > end.corners - 1.5;
    vec2 low = vec2(end.last.x, -end.last.y);
    corner = select(outer_low && dot(corner, low) < limit.x, complex_product(low, limit), corner);
    corner = select(outer_high && dot(corner, end.last) < limit.x, complex_product(end.last, vec2(limit.x, -limit.y)), corner);
    return select(outer_low && outer_high, vec2(1.0, 0.0), corner);
}

// The square of a corner's radius that equal area requires, for the step to its neighbour. With `outer`, the neighbour stands on a straight
// edge's continuation: its radius is given, and so is the area that it adds.
//
//   joint    (cos, sin) of the arc's end behind the neighbour
real capsule_gap(vec2 corner, vec2 neighbour, vec2 joint, mask outer) {
    real cosine = dot(corner, neighbour);
    real sine = abs(corner.x * neighbour.y - corner.y * neighbour.x);
    real angle = clamp(trig_atan2(sine, cosine), 0.0, 2.6);
    sine = select(cosine > -0.856888753368947234, sine, 0.515501371821464235);
    real even = select(angle < 1.0e-3, 1.0, angle / max(sine, 1.0e-4));
    real c = max(dot(neighbour, joint), 0.5);
    real s = abs(neighbour.x * joint.y - neighbour.y * joint.x);
    real given = (even + (trig_atan2(s, c) - s / c) / max(sine, 1.0e-4)) * c;
    given = select(angle < 1.0e-3, 1.0, max(given, 0.5));
    return select(outer, given * given, even);
}

// Corner j of an end, as a vector from the shading point.
vec3 capsule_end_corner(CapsuleEnd end, real j) {
    vec2 here = capsule_corner(end, j);
    vec2 joint = vec2(end.last.x, -end.last.y);
    mask joins = j < 1.5;
    mask outer_low = j < 0.5;
    mask outer_high = j > end.corners - 1.5;
    real outer = 1.0 / max(dot(here, select(outer_low, joint, end.last)), 0.5);
    real gaps = 0.0;
    // The corner before, and the one after.
    for (int i = 0; i < 2; i++) {
        gaps = gaps + capsule_gap(here, capsule_corner(end, j + real(2 * i - 1)), joint, joins);
        joint = end.last;
        joins = j > end.corners - 2.5;
    }
    real radius = select(outer_low || outer_high, outer, sqrt(0.5 * gaps));
    return end.center + (end.middle * here.x + end.side * here.y) * radius;
}

// Prepares a polygon about a capsule.
//
//   c        prepared; the point is outside
//   r        unit axis of the lobe
//   width    of the lobe [rad]: 1/sqrt(n + 1) of Phong
//   count    of all corners, 6 or more; each end has its share of the steps, at least one
CapsuleFan capsule_fan(Capsule c, vec3 r, real width, int count) {
    real da = sqrt(max(dot(c.end_a, c.end_a), smallest_square()));
    real db = sqrt(max(dot(c.end_b, c.end_b), smallest_square()));
    real angle_a = capsule_half_angle(c, -c.at_a, da);
    real angle_b = capsule_half_angle(c, c.at_b, db);
    vec3 a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
    vec3 b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
    CapsuleFan fan;
    fan.a = capsule_end(c.end_a, c.radius, a_middle, angle_a, r, width);
    fan.b = capsule_end(c.end_b, c.radius, b_middle, angle_b, r, width);
    real share = fan.a.step / max(fan.a.step + fan.b.step, smallest_length());
    fan.a.corners = 1.0 + floor(0.5 + real(count - 2) * share);
    fan.b.corners = real(count) - fan.a.corners;
    fan.a.step = fan.a.step / fan.a.corners;
    fan.b.step = fan.b.step / fan.b.corners;
    return fan;
}

// Corner k of the polygon, k from 0, as a vector from the shading point, in walk order. Only its direction counts: the
// corners of the two ends lie in different planes.
//
// Error: see docs/theory/ggx.md, "Round lights".
vec3 capsule_fan_corner(CapsuleFan fan, int k) {
    mask first = real(k) < fan.a.corners;
    CapsuleEnd end;
    end.center = select(first, fan.a.center, fan.b.center);
    end.middle = select(first, fan.a.middle, fan.b.middle);
    end.side = select(first, fan.a.side, fan.b.side);
    end.last = select(first, fan.a.last, fan.b.last);
    end.corners = select(first, fan.a.corners, fan.b.corners);
    end.turn = select(first, fan.a.turn, fan.b.turn);
    end.beta = select(first, fan.a.beta, fan.b.beta);
    end.first = select(first, fan.a.first, fan.b.first);
    end.step = select(first, fan.a.step, fan.b.step);
    return capsule_end_corner(end, select(first, real(k), real(k) - fan.a.corners));
}
