// The topics math, polygon, lobe, round, phong, ltc, ltc_tables, ggx of dist/wgsl, without their comments.
// Made by web/three-steradian/make_package.py.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
export const LIBRARY_WGSL = `
fn steradian_xy(v: vec3f) -> vec2f { return v.xy; }
fn steradian_transform(m: mat3x3f, v: vec3f) -> vec3f { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
fn steradian_transform_transposed(m: mat3x3f, v: vec3f) -> vec3f {
    return vec3f(dot(m[0], v), dot(m[1], v), dot(m[2], v));
}
fn steradian_pi() -> f32 { return 3.14159265358979324; }
fn steradian_inverse_pi() -> f32 { return 0.318309886183790672; }
fn steradian_inverse_two_pi() -> f32 { return 0.159154943091895336; }
fn steradian_mask_none() -> bool {
    let zero = 0.0;
    return zero > 0.0;
}
fn steradian_mask_all() -> bool { return !steradian_mask_none(); }
fn steradian_smallest_square() -> f32 { return 1.0e-36; }
fn steradian_smallest_length() -> f32 { return 1.0e-18; }
fn steradian_smallest_divisor() -> f32 { return 1.0e-30; }
fn steradian_complex_product(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}
fn steradian_complex_quotient(a: vec2f, b: vec2f) -> vec2f {
    let scale = 1.0 / max(dot(b, b), steradian_smallest_square());
    return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) * scale;
}
fn steradian_complex_sign(a: vec2f) -> vec2f {
    return a * inverseSqrt(max(dot(a, a), steradian_smallest_square()));
}
fn steradian_complex_unit(x: f32) -> vec2f {
    let y = 0.5 * x;
    let t = y * y;
    var c = 1.0;
    var s = 1.0;
    c = 1.0 - t * 0.0111111111111111111 * (1.0 - t * 0.00757575757575757576 * c);
    c = 1.0 - t * 0.0333333333333333333 * (1.0 - t * 0.0178571428571428571 * c);
    c = 1.0 - t * 0.5 * (1.0 - t * 0.0833333333333333333 * c);
    s = 1.0 - t * 0.0138888888888888889 * (1.0 - t * 0.00909090909090909091 * s);
    s = 1.0 - t * 0.05 * (1.0 - t * 0.0238095238095238095 * s);
    s = y * (1.0 - t * 0.166666666666666667 * s);
    return vec2f(c * c - s * s, 2.0 * c * s);
}
fn steradian_frame_from_normal(n: vec3f) -> mat3x3f {
    let s = select(1.0, -1.0, n.z < 0.0);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    let y = vec3f(b, s + n.y * n.y * a, -n.y);
    return mat3x3f(x, y, n);
}
fn steradian_frame_from_normal_and_view(n: vec3f, v: vec3f) -> mat3x3f {
    let other = steradian_frame_from_normal(n);
    let t = v - n * dot(n, v);
    let t2 = dot(t, t);
    let x = select(steradian_transform(other, vec3f(1.0, 0.0, 0.0)), t * inverseSqrt(max(t2, 1.0e-12)), t2 > 1.0e-12);
    return mat3x3f(x, cross(n, x), n);
}
fn steradian_gauss_legendre_node(n: i32, j: i32) -> vec2f {
    var r = vec2f(0.5, 0.0);
    if (n == 1) {
        if (j == 0) { r = vec2f(0.5, 1.0); }
    }
    if (n == 2) {
        if (j == 0) { r = vec2f(0.211324865405187118, 0.5); }
        if (j == 1) { r = vec2f(0.788675134594812882, 0.5); }
    }
    if (n == 3) {
        if (j == 0) { r = vec2f(0.112701665379258311, 0.277777777777777778); }
        if (j == 1) { r = vec2f(0.5, 0.444444444444444444); }
        if (j == 2) { r = vec2f(0.887298334620741689, 0.277777777777777778); }
    }
    if (n == 4) {
        if (j == 0) { r = vec2f(0.069431844202973712, 0.173927422568726929); }
        if (j == 1) { r = vec2f(0.330009478207571868, 0.326072577431273071); }
        if (j == 2) { r = vec2f(0.669990521792428132, 0.326072577431273071); }
        if (j == 3) { r = vec2f(0.930568155797026288, 0.173927422568726929); }
    }
    if (n == 5) {
        if (j == 0) { r = vec2f(0.046910077030668004, 0.118463442528094544); }
        if (j == 1) { r = vec2f(0.230765344947158454, 0.239314335249683234); }
        if (j == 2) { r = vec2f(0.5, 0.284444444444444444); }
        if (j == 3) { r = vec2f(0.769234655052841546, 0.239314335249683234); }
        if (j == 4) { r = vec2f(0.953089922969331996, 0.118463442528094544); }
    }
    if (n == 6) {
        if (j == 0) { r = vec2f(0.033765242898423986, 0.085662246189585173); }
        if (j == 1) { r = vec2f(0.169395306766867743, 0.180380786524069304); }
        if (j == 2) { r = vec2f(0.380690406958401546, 0.233956967286345524); }
        if (j == 3) { r = vec2f(0.619309593041598454, 0.233956967286345524); }
        if (j == 4) { r = vec2f(0.830604693233132257, 0.180380786524069304); }
        if (j == 5) { r = vec2f(0.966234757101576014, 0.085662246189585173); }
    }
    if (n == 8) {
        if (j == 0) { r = vec2f(0.019855071751231884, 0.05061426814518813); }
        if (j == 1) { r = vec2f(0.10166676129318663, 0.111190517226687235); }
        if (j == 2) { r = vec2f(0.237233795041835507, 0.156853322938943644); }
        if (j == 3) { r = vec2f(0.408282678752175098, 0.181341891689180991); }
        if (j == 4) { r = vec2f(0.591717321247824902, 0.181341891689180991); }
        if (j == 5) { r = vec2f(0.762766204958164493, 0.156853322938943644); }
        if (j == 6) { r = vec2f(0.89833323870681337, 0.111190517226687235); }
        if (j == 7) { r = vec2f(0.980144928248768116, 0.05061426814518813); }
    }
    return r;
}
fn steradian_fan_place(centre: vec3f, outward: vec3f, rim_cosine: f32, share: f32) -> vec3f {
    let cosine = 1.0 - (1.0 - rim_cosine) * share;
    return centre * cosine + outward * sqrt(max(1.0 - cosine * cosine, 0.0));
}
fn steradian_trig_angle_over_sine_24_bits(t: f32) -> vec2f {
    var p = 0.01116282422619877;
    var d = p;
    p = p * t - 0.032591688733997218;
    d = d * t + p;
    p = p * t + 0.05097575847577638;
    d = d * t + p;
    p = p * t - 0.033552997791327491;
    d = d * t + p;
    p = p * t + 0.030059175970996568;
    d = d * t + p;
    p = p * t + 0.020163489805166888;
    d = d * t + p;
    p = p * t + 0.057977801513775039;
    d = d * t + p;
    p = p * t + 0.13326657225500885;
    d = d * t + p;
    p = p * t + 0.33333538143391106;
    d = d * t + p;
    p = p * t + 0.9999999897346874;
    return vec2f(p, d);
}
fn steradian_trig_atan_over_argument_24_bits(q: f32) -> f32 {
    var p = 0.002766283501762026;
    p = p * q - 0.015731249122183651;
    p = p * q + 0.042137623589193041;
    p = p * q - 0.07456854826004547;
    p = p * q + 0.10618370636953849;
    p = p * q - 0.14197797794085124;
    p = p * q + 0.19991872029109073;
    p = p * q - 0.33333036709286273;
    p = p * q + 0.99999998178865568;
    return p;
}
fn steradian_trig_angle_over_sine_acute_and_slope(t: f32) -> vec2f {
    return steradian_trig_angle_over_sine_24_bits(t);
}
fn steradian_trig_angle_over_sine_acute(t: f32) -> f32 {
    let both = steradian_trig_angle_over_sine_acute_and_slope(t);
    return both.x;
}
fn steradian_trig_angle_over_sine(c: f32, s2: f32) -> f32 {
    var f = steradian_trig_angle_over_sine_acute(1.0 - abs(c));
    let obtuse = c < 0.0;
    if (obtuse) {
        f = select(f, steradian_pi() * inverseSqrt(max(s2, steradian_smallest_divisor())) - f, obtuse);
    }
    return f;
}
fn steradian_trig_angle_over_sine_and_slope(c: f32, s2: f32) -> vec2f {
    var both = steradian_trig_angle_over_sine_acute_and_slope(1.0 - abs(c));
    let obtuse = c < 0.0;
    if (obtuse) {
        let f = steradian_pi() * inverseSqrt(max(s2, steradian_smallest_divisor())) - both.x;
        both = select(both, vec2f(f, (1.0 - c * min(f, 1.0e12)) / max(s2, 1.0e-12)), obtuse);
    }
    return both;
}
fn steradian_trig_atan2(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let larger = max(ax, ay);
    let t = min(ax, ay) / max(larger, 1.0e-37);
    let q = t * t;
    let p = steradian_trig_atan_over_argument_24_bits(q);
    var angle = t * p;
    angle = select(angle, 0.5 * steradian_pi() - angle, ay > ax);
    angle = select(angle, steradian_pi() - angle, x < 0.0);
    return select(angle, -angle, y < 0.0);
}
fn steradian_trig_atan2_unwrapped(y: f32, x: f32) -> f32 {
    let angle = steradian_trig_atan2(y, x);
    return select(angle, angle + 2.0 * steradian_pi(), angle < -0.5 * steradian_pi());
}
struct SteradianQuarticPoles {
    z1: vec2f,
    z2: vec2f,
}
fn steradian_quartic_third_cosine(x: f32) -> f32 {
    let t = sqrt(max(0.5 + 0.5 * x, 0.0));
    var c = 0.5 + t * (0.577350269189625765 - 0.0773502691896257645 * t);
    for (var i: i32 = 0; i < 2; i++) {
        let c2 = c * c;
        c = c - (c * (4.0 * c2 - 3.0) - x) / max(12.0 * c2 - 3.0, 1.0e-6);
    }
    return c;
}
fn steradian_quartic_poles_approximate(c0: f32, c1: f32, c2: f32, c3: f32) -> SteradianQuarticPoles {
    let shift = 0.25 * c3;
    let shift2 = shift * shift;
    let p = c2 - 6.0 * shift2;
    let q = c1 - 2.0 * c2 * shift + 8.0 * shift2 * shift;
    let r = c0 - c1 * shift + c2 * shift2 - 3.0 * shift2 * shift2;
    let radius2 = max(p * p + 12.0 * r, 1.0e-12);
    let radius = sqrt(radius2);
    let cosine = clamp((p * (p * p - 36.0 * r) + 13.5 * q * q) / (radius2 * radius), -1.0, 1.0);
    let z = max(0.666666666666666667 * (radius * steradian_quartic_third_cosine(cosine) - p), 0.0);
    let s = sqrt(z);
    let sum = p + z;
    let root = sqrt(max(sum * sum - 4.0 * r, 0.0));
    let difference = select(select(root, -root, q < 0.0), q / max(s, steradian_smallest_length()), z > 1.0e-3 * abs(p));
    var poles: SteradianQuarticPoles;
    poles.z1 = vec2f(-0.5 * s - shift, sqrt(max(0.5 * (sum - difference) - 0.25 * z, 1.0e-6)));
    poles.z2 = vec2f(0.5 * s - shift, sqrt(max(0.5 * (sum + difference) - 0.25 * z, 1.0e-6)));
    return poles;
}
struct SteradianPolygonWalk {
    edges: vec3f,
    horizon: vec2f,
}
fn steradian_polygon_direction(v: vec3f) -> vec3f {
    let d2 = dot(v, v);
    let scale = select(0.0, inverseSqrt(max(d2, steradian_smallest_square())), d2 < 1.0e36);
    return v * scale;
}
fn steradian_polygon_edge(a: vec3f, b: vec3f) -> vec3f {
    let n = cross(a, b - a);
    let f = steradian_trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}
fn steradian_polygon_begin() -> SteradianPolygonWalk {
    var walk: SteradianPolygonWalk;
    walk.edges = vec3f(0.0, 0.0, 0.0);
    walk.horizon = vec2f(1.0, 0.0);
    return walk;
}
struct SteradianEdgePart {
    start: vec3f,
    end: vec3f,
    start_a: f32,
    start_b: f32,
    end_a: f32,
    end_b: f32,
    rises: bool,
    sinks: bool,
}
fn steradian_edge_whole(a: vec3f, b: vec3f) -> SteradianEdgePart {
    var part: SteradianEdgePart;
    part.start = a;
    part.end = b;
    part.start_a = 1.0;
    part.start_b = 0.0;
    part.end_a = 0.0;
    part.end_b = 1.0;
    part.rises = steradian_mask_none();
    part.sinks = steradian_mask_none();
    return part;
}
fn steradian_edge_above_horizon(a: vec3f, b: vec3f) -> SteradianEdgePart {
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    var part = steradian_edge_whole(a, b);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (a_below || b_below) {
        let wa = abs(b.z);
        let wb = abs(a.z);
        let p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
        let scale = inverseSqrt(max(dot(p, p), steradian_smallest_square()));
        let crossing = vec3f(p.x * scale, p.y * scale, 0.0);
        part.start = select(a, crossing, a_below);
        part.end = select(b, crossing, b_below);  
        part.start_a = select(1.0, wa * scale, a_below);
        part.start_b = select(0.0, wb * scale, a_below);
        part.end_a = select(0.0, wa * scale, b_below);
        part.end_b = select(1.0, wb * scale, b_below);
    }
    return part;
}
fn steradian_polygon_add_part(walk: SteradianPolygonWalk, part: SteradianEdgePart) -> SteradianPolygonWalk {
    var next = walk;
    let crosses = part.rises || part.sinks;
    if (crosses) {
        let crossing = select(part.end, part.start, part.rises);
        let y = select(-crossing.y, crossing.y, part.rises);  
        let h = walk.horizon;
        next.horizon = select(h, vec2f(h.x * crossing.x - h.y * y, h.x * y + h.y * crossing.x), crosses);
    }
    next.edges = walk.edges + steradian_polygon_edge(part.start, part.end);
    return next;
}
fn steradian_polygon_add_edge(walk: SteradianPolygonWalk, a: vec3f, b: vec3f) -> SteradianPolygonWalk {
    var next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        next = steradian_polygon_add_part(walk, steradian_edge_above_horizon(a, b));
    }
    return next;
}
fn steradian_polygon_irradiance_vector(walk: SteradianPolygonWalk, reversed: bool) -> vec3f {
    let facing = select(1.0, -1.0, reversed);
    var arc = 0.0;
    if (abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0) {
        arc = steradian_trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    let e = walk.edges * facing;
    return vec3f(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, steradian_pi()));
}
fn steradian_polygon_irradiance(walk: SteradianPolygonWalk, reversed: bool) -> f32 {
    let e = steradian_polygon_irradiance_vector(walk, reversed);
    return e.z;
}
struct SteradianSolidAngleWalk {
    first: vec3f,
    product: vec2f,
}
fn steradian_solid_angle_begin(first: vec3f) -> SteradianSolidAngleWalk {
    var walk: SteradianSolidAngleWalk;
    walk.first = first;
    walk.product = vec2f(1.0, 0.0);
    return walk;
}
fn steradian_solid_angle_add_edge(walk: SteradianSolidAngleWalk, a: vec3f, b: vec3f) -> SteradianSolidAngleWalk {
    var next = walk;
    var re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    var im = dot(walk.first, cross(a - walk.first, b - a));  
    let scale = inverseSqrt(max(re * re + im * im, steradian_smallest_square()));
    re = re * scale;
    im = im * scale;
    let p = walk.product;
    next.product = vec2f(p.x * re - p.y * im, p.x * im + p.y * re);
    return next;
}
fn steradian_solid_angle_finish(walk: SteradianSolidAngleWalk, reversed: bool) -> f32 {
    let y = select(walk.product.y, -walk.product.y, reversed);
    return max(2.0 * steradian_trig_atan2_unwrapped(y, walk.product.x), 0.0);
}
struct SteradianHorizonClip {
    start: vec3f,
    end: vec3f,
    arc_start: vec3f,
    arc_end: vec3f,
    closes: bool,
    leave: vec3f,
    entry: vec3f,
}
fn steradian_horizon_clip_begin() -> SteradianHorizonClip {
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var clip: SteradianHorizonClip;
    clip.start = nowhere;
    clip.end = nowhere;
    clip.arc_start = nowhere;
    clip.arc_end = nowhere;
    clip.closes = steradian_mask_none();
    clip.leave = nowhere;
    clip.entry = nowhere;
    return clip;
}
fn steradian_horizon_crossing(a: vec3f, b: vec3f) -> vec3f {
    let wa = abs(b.z);
    let wb = abs(a.z);
    var p = vec2f(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    p = p * inverseSqrt(max(dot(p, p), steradian_smallest_square()));
    return vec3f(p.x, p.y, 0.0);
}
fn steradian_horizon_arc_wide(a: vec3f, b: vec3f) -> bool { return dot(a, b) < -0.9999; }
fn steradian_horizon_arc_middle(a: vec3f, b: vec3f, facing: f32) -> vec3f {
    let unsure = 1.0e-6;
    var across = vec2f(b.y - a.y, a.x - b.x) * facing;
    let turn = (a.x * b.y - a.y * b.x) * facing;
    across = across * (inverseSqrt(max(dot(across, across), steradian_smallest_square())) * select(1.0, -1.0, turn < -unsure));
    return vec3f(across.x, across.y, 0.0);
}
fn steradian_horizon_clip_edge(clip: SteradianHorizonClip, a: vec3f, b: vec3f) -> SteradianHorizonClip {
    var next = clip;
    let a_below = a.z < 0.0;
    let b_below = b.z < 0.0;
    next.start = a;
    next.end = b;
    next.closes = steradian_mask_none();
    if (a_below || b_below) {
        let nowhere = vec3f(0.0, 0.0, 0.0);
        let crossing = steradian_horizon_crossing(a, b);
        next.start = select(a, crossing, a_below);
        next.end = select(b, crossing, b_below);  
        let comes_up = a_below && !b_below;
        let goes_down = b_below && !a_below;
        let was_left = dot(clip.leave, clip.leave) > 0.5;
        let due = goes_down && was_left;
        next.closes = (comes_up && was_left) || due;
        next.arc_end = select(crossing, clip.entry, due);
        next.arc_start = select(next.arc_end, clip.leave, next.closes);
        next.leave = select(select(clip.leave, nowhere, comes_up), crossing, goes_down);
        next.entry = select(select(clip.entry, nowhere, due), crossing, comes_up && !was_left);
    }
    return next;
}
fn steradian_horizon_clip_finish(clip: SteradianHorizonClip) -> SteradianHorizonClip {
    var next = clip;
    next.closes = dot(clip.leave, clip.leave) > 0.5 && dot(clip.entry, clip.entry) > 0.5;
    next.start = clip.end;
    next.arc_start = select(clip.entry, clip.leave, next.closes);
    next.arc_end = clip.entry;
    return next;
}
fn steradian_lambert_radiance(irradiance: f32) -> f32 {
    return irradiance * steradian_inverse_pi();
}
fn steradian_lambert_lobe(l: vec3f) -> f32 {
    return max(l.z, 0.0) * steradian_inverse_pi();
}
fn steradian_lambert_grazing(l: vec3f, v: vec3f) -> f32 {
    let x = 1.0 - sqrt(clamp(0.5 + 0.5 * dot(l, v), 0.0, 1.0));
    let x2 = x * x;
    return x2 * x2 * x;
}
fn steradian_lambert_grazing_of_sky(v_z: f32) -> f32 {
    let t = 1.0 - clamp(v_z, 0.0, 1.0);
    return 8.2571e-5 + t * (2.01647e-3 + t * (9.33829e-3 + t * (7.74731e-3 + t * 8.97984e-3)));
}
fn steradian_lambert_grazing_of_light(e: vec3f, v: vec3f) -> f32 {
    let mean = e * inverseSqrt(max(dot(e, e), steradian_smallest_square()));
    let in_mean = steradian_lambert_grazing(mean, v);
    let share = clamp(e.z * steradian_inverse_pi(), 0.0, 1.0);
    return in_mean + (steradian_lambert_grazing_of_sky(v.z) - in_mean) * share;
}
fn steradian_lambert_irradiance_below(e: vec3f, v: vec3f, loss: f32) -> f32 {
    return e.z * (1.0 - loss * steradian_lambert_grazing_of_light(e, v));
}
struct SteradianCharlieLobe {
    view: vec3f,
    exponent: f32,
    scale: f32,
    a: f32,
    b: f32,
    c: f32,
    d: f32,
    e: f32,
    middle: f32,
    masking: f32,
}
fn steradian_charlie_curve(lobe: SteradianCharlieLobe, x: f32) -> f32 {
    let power = exp(lobe.c * log(max(x, 1.0e-9)));
    return lobe.a / (1.0 + lobe.b * power) + lobe.d * x + lobe.e;
}
fn steradian_charlie_lambda(lobe: SteradianCharlieLobe, cosine: f32) -> f32 {
    let x = clamp(cosine, 0.0, 1.0);
    let steep = x > 0.5;
    let curve = steradian_charlie_curve(lobe, select(x, 1.0 - x, steep));
    return exp(select(curve, 2.0 * lobe.middle - curve, steep));
}
fn steradian_charlie_prepare(v: vec3f, alpha: f32) -> SteradianCharlieLobe {
    let width = clamp(alpha, 0.04, 1.0);
    let t = (1.0 - width) * (1.0 - width);
    var lobe: SteradianCharlieLobe;
    lobe.view = v;
    lobe.exponent = 0.5 / width;
    lobe.scale = select(0.0, (2.0 + 1.0 / width) * 0.0397887357729738339 / max(v.z, 1.0e-6), v.z > 0.0);
    lobe.a = 21.5473 + t * (25.3245 - 21.5473);
    lobe.b = 3.82987 + t * (3.32435 - 3.82987);
    lobe.c = 0.19823 + t * (0.16801 - 0.19823);
    lobe.d = -1.97760 + t * (1.97760 - 1.27393);
    lobe.e = -4.32054 + t * (4.32054 - 4.85967);
    lobe.middle = 0.0;
    lobe.middle = steradian_charlie_curve(lobe, 0.5);
    lobe.masking = 0.0;
    lobe.masking = 1.0 + steradian_charlie_lambda(lobe, v.z);
    return lobe;
}
fn steradian_charlie_lobe(lobe: SteradianCharlieLobe, l: vec3f) -> f32 {
    let h = l + lobe.view;
    let across = h.x * h.x + h.y * h.y;
    let sine2 = across / max(across + h.z * h.z, steradian_smallest_divisor());
    let power = exp(lobe.exponent * log(clamp(sine2, steradian_smallest_divisor(), 1.0)));
    let shadowed = lobe.scale * power / (lobe.masking + steradian_charlie_lambda(lobe, l.z));
    return select(0.0, shadowed, l.z > 0.0);
}
struct SteradianCosineLobe {
    axis: vec3f,
    exponent: f32,
    scale: f32,
}
struct SteradianStretchedLobe {
    frame: mat3x3f,
    stretch: vec3f,  
    exponent: f32,
    scale: f32,
}
struct SteradianLobeProduct {
    about: mat3x3f,
    total: f32,
    log_scale: f32,
    slope: vec2f,
    curvature: vec3f,
    lowest: f32,
}
fn steradian_lobe_product_begin(direction: vec3f) -> SteradianLobeProduct {
    var p: SteradianLobeProduct;
    p.about = steradian_frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2f(0.0, 0.0);
    p.curvature = vec3f(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}
fn steradian_lobe_product_add(p: SteradianLobeProduct, r: vec3f, n: f32) -> SteradianLobeProduct {
    let local = steradian_transform_transposed(p.about, r);
    let z = max(local.z, 1.0e-4);
    let x = local.x / z;
    let y = local.y / z;
    var next = p;
    next.total = p.total + n;
    next.log_scale = p.log_scale + n * log(z);
    next.slope = p.slope + vec2f(n * x, n * y);
    next.curvature = p.curvature + vec3f(n * x * x, n * x * y, n * y * y);
    next.lowest = min(p.lowest, local.z);
    return next;
}
fn steradian_lobe_product_newton(p: SteradianLobeProduct) -> vec3f {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    let xy = p.curvature.y;
    let inverse = 1.0 / max(xx * yy - xy * xy, steradian_smallest_divisor());
    let step_to = vec3f(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    let u = steradian_transform(p.about, step_to);
    return u * inverseSqrt(dot(u, u));
}
fn steradian_lobe_product_scale(p: SteradianLobeProduct) -> f32 {
    return select(0.0, exp(p.log_scale), p.lowest > 1.0e-4);
}
fn steradian_lobe_product_isotropic(p: SteradianLobeProduct) -> SteradianCosineLobe {
    let xx = p.total + p.curvature.x;
    let yy = p.total + p.curvature.z;
    var lobe: SteradianCosineLobe;
    lobe.axis = steradian_transform(p.about, vec3f(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}
fn steradian_lobe_product_anisotropic(p: SteradianLobeProduct) -> SteradianStretchedLobe {
    let xx = p.total + p.curvature.x + 3.0;
    let yy = p.total + p.curvature.z + 3.0;
    let xy = p.curvature.y;
    let d = sqrt(max(xx * yy - xy * xy, steradian_smallest_divisor()));
    let root = inverseSqrt((xx + yy) / d + 2.0);
    var lobe: SteradianStretchedLobe;
    lobe.frame = p.about;
    lobe.stretch = vec3f(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}
fn steradian_lobe_product_stretch(lobe: SteradianStretchedLobe, u: vec3f) -> vec3f {
    let l = steradian_transform_transposed(lobe.frame, u);
    return vec3f(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}
fn steradian_lobe_product_peak_of_two(r1: vec3f, n1: f32, r2: vec3f, n2: f32) -> vec3f {
    let cosine = max(dot(r1, r2), 1.0e-6);
    let across = r2 - r1 * dot(r1, r2);
    let sine2 = dot(across, across);
    let tangent = sqrt(sine2) / cosine;
    let sum = n1 + n2;
    let t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    let u = r1 + across * (t * inverseSqrt(max(sine2, steradian_smallest_divisor())));
    return u * inverseSqrt(dot(u, u));
}
fn steradian_microfacet_half_vector(l: vec3f, v: vec3f) -> vec3f {
    let h = l + v;
    return h * inverseSqrt(max(dot(h, h), steradian_smallest_square()));
}
fn steradian_ggx_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let x = h.x / ax;
    let y = h.y / ay;
    let d = max(x * x + y * y + h.z * h.z, 1.0e-6);
    return steradian_inverse_pi() / (ax * ay * d * d);
}
fn steradian_ggx_stretched_length(w: vec3f, ax: f32, ay: f32) -> f32 {
    let x = ax * w.x;
    let y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}
fn steradian_ggx_shadowing(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let lz = max(l.z, 0.0);
    let vz = max(v.z, 0.0);
    let d = lz * steradian_ggx_stretched_length(v, ax, ay) + vz * steradian_ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, steradian_smallest_square());
}
fn steradian_fresnel_schlick(f0: f32, f90: f32, v_dot_h: f32) -> f32 {
    let x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    let x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}
fn steradian_beckmann_distribution(h: vec3f, ax: f32, ay: f32) -> f32 {
    let hz = max(h.z, 1.0e-5);
    let x = h.x / (ax * hz);
    let y = h.y / (ay * hz);
    let z2 = hz * hz;
    return steradian_inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}
fn steradian_microfacet_lobe_unshadowed(d: f32, l: vec3f, v: vec3f) -> f32 {
    let above = l.z > 0.0 && v.z > 0.0;
    return select(0.0, d / (4.0 * max(v.z, 1.0e-6)), above);
}
fn steradian_ggx_lobe(l: vec3f, v: vec3f, ax: f32, ay: f32) -> f32 {
    let h = steradian_microfacet_half_vector(l, v);
    let g = steradian_ggx_shadowing(l, v, ax, ay);
    return steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, ax, ay) * g, l, v);
}
fn steradian_phong_log(x: f32) -> f32 {
    let near = 0.75;
    var result = log(x);
    let high = x > near;
    if (high) {
        let d = x - 1.0;
        let t = d / (2.0 + d);
        let t2 = t * t;
        let series = d - t * (d - t2 * (0.666666666666666667 + t2 * (0.4 + t2 * 0.285714285714285714)));
        result = select(result, series, high);
    }
    return result;
}
fn steradian_phong_power(x: f32, n: f32) -> f32 {
    return exp(n * steradian_phong_log(max(x, steradian_smallest_divisor())));
}
fn steradian_phong_mirror(v: vec3f) -> vec3f {
    return vec3f(-v.x, -v.y, v.z);
}
fn steradian_phong_lobe(l: vec3f, r: vec3f, n: f32) -> f32 {
    return (n + 1.0) * steradian_inverse_two_pi() * steradian_phong_power(dot(l, r), n);
}
fn steradian_blinn_phong_distribution(h: vec3f, n: f32) -> f32 {
    return (n + 2.0) * steradian_inverse_two_pi() * steradian_phong_power(h.z, n);
}
struct SteradianLightElements {
    center: vec3f,
    reach_a: vec3f,
    reach_b: vec3f,
    area: vec3f,
}
struct SteradianLightElement {
    direction: vec3f,
    solid_angle: f32,
}
fn steradian_light_element_at(e: SteradianLightElements, i: i32) -> SteradianLightElement {
    let side = f32(1 - 2 * (i / 2));
    var r = e.center + e.reach_a * side;
    if (i == 1 || i == 3) {
        r = e.center + e.reach_b * side;
    }
    let inverse = inverseSqrt(max(dot(r, r), steradian_smallest_square()));
    var element: SteradianLightElement;
    element.direction = r * inverse;
    let quarter = max(-0.25 * dot(e.area, element.direction), 0.0);
    element.solid_angle = (quarter * inverse) * inverse;
    return element;
}
fn steradian_light_elements_diffuse_sharpness() -> f32 { return 2.5; }
fn steradian_light_elements_sharpness(deviation: f32) -> f32 {
    return steradian_light_elements_diffuse_sharpness() + 1.0 / max(deviation, 1.0e-12);
}
fn steradian_light_elements_half_vector_sharpness(deviation: f32, view_z: f32) -> f32 {
    return steradian_light_elements_sharpness(2.0 * deviation * max(view_z, 1.0e-6));
}
fn steradian_light_elements_power_sharpness(n: f32) -> f32 {
    return steradian_light_elements_diffuse_sharpness() + sqrt(n);
}
struct SteradianLightElementsLimits {
    roundings: f32,
    least_distance2: f32,
    bias: f32,
}
fn steradian_light_elements_limits(roundings: f32, least_distance2: f32, bias: f32) -> SteradianLightElementsLimits {
    var limits: SteradianLightElementsLimits;
    limits.roundings = roundings;
    limits.least_distance2 = least_distance2;
    limits.bias = bias;
    return limits;
}
fn steradian_light_elements_along_edges() -> SteradianLightElementsLimits { return steradian_light_elements_limits(2.0, 4000.0, 0.0); }
fn steradian_light_elements_transformed() -> SteradianLightElementsLimits { return steradian_light_elements_limits(8.0, 2000.0, 0.0); }
fn steradian_light_elements_along_arcs() -> SteradianLightElementsLimits { return steradian_light_elements_limits(128.0, 500.0, 0.0); }
fn steradian_light_elements_along_half_vectors(bias: f32) -> SteradianLightElementsLimits { return steradian_light_elements_limits(128.0, 30.0, bias); }
fn steradian_light_elements_along_power(n: f32, bias: f32) -> SteradianLightElementsLimits {
    let sharpness = steradian_light_elements_power_sharpness(n);
    return steradian_light_elements_limits(128.0, select(500.0, min(500.0, 4.0 * sharpness * sharpness), bias > 0.0), bias);
}
fn steradian_light_elements_series_bias() -> f32 { return 0.015625; }
fn steradian_light_elements_series_high_bias() -> f32 { return 0.008695652173913044; }
fn steradian_light_elements_beckmann_bias() -> f32 { return 0.005; }
fn steradian_light_elements_serve(e: SteradianLightElements, normal: vec3f, sharpness: f32, roundings: f32, bias: f32) -> bool {
    let unit = 6.0e-8;
    let inverse = inverseSqrt(max(dot(e.center, e.center), steradian_smallest_square()));
    let a = e.reach_a * inverse;
    let b = e.reach_b * inverse;
    let deviation2 = 0.5 * (dot(a, a) + dot(b, b));
    let deviation = sqrt(deviation2);
    let t = min(deviation * sharpness, 1.0e6);
    let bound = 0.125 * t * t * t;
    let better = bound < bias || bound * deviation < roundings * unit;
    let whole = dot(e.center, normal) * inverse > 2.0 * (abs(dot(a, normal)) + abs(dot(b, normal)));
    return better && (whole || deviation2 < 8.0 * unit);
}
fn steradian_light_elements_irradiance_vector(e: SteradianLightElements) -> vec3f {
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var sum = nowhere;
    for (var i: i32 = 0; i < 4; i++) {
        let element = steradian_light_element_at(e, i);
        sum = sum + select(nowhere, element.direction * element.solid_angle, element.direction.z > 0.0);
    }
    return sum;
}
struct SteradianConicArc {
    u0: vec3f,
    u1: vec3f,
    u2: vec3f,
    begin: f32,
    end: f32,
    scale: f32,
    z1: vec2f,
    z2: vec2f,
    sweep: vec2f,
}
fn steradian_conic_slope(z: vec2f, o: vec2f, d4: f32) -> vec2f {
    let x = z.x - o.x;
    let y2 = (z.y - o.y) * (z.y + o.y);
    let s = 2.0 * d4 * z.y;
    return vec2f(-2.0 * x * z.y, x * x - y2) * s;
}
fn steradian_conic_pole_step(arc: SteradianConicArc, z: vec2f, o: vec2f, d4: f32) -> vec2f {
    let re = arc.u0 + arc.u1 * z.x + arc.u2 * (z.x * z.x - z.y * z.y);
    let im = (arc.u1 + arc.u2 * (2.0 * z.x)) * z.y;
    let value = vec2f(dot(re - im, re + im), 2.0 * dot(re, im));
    var step = steradian_complex_quotient(value, steradian_conic_slope(z, o, d4));
    let apart = z - o;
    let apart2 = dot(apart, apart);
    let longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * inverseSqrt(max(dot(step, step), steradian_smallest_divisor())), 1.0);
    let free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    let next = z - select(vec2f(0.0, 0.0), step, free);
    return vec2f(next.x, max(abs(next.y), 1.0e-9));
}
fn steradian_conic_polish_poles(arc: SteradianConicArc, start: SteradianQuarticPoles) -> SteradianQuarticPoles {
    var poles = start;
    let d4 = dot(arc.u2, arc.u2);
    let sweeps: i32 = 16;
    let tolerance = 1.0e-6;
    var moving = arc.end > arc.begin;
    for (var i: i32 = 0; i < sweeps; i++) {
        var moves = steradian_mask_none();
        for (var k: i32 = 0; k < 2; k++) {
            var z = steradian_conic_pole_step(arc, poles.z1, poles.z2, d4);
            let step = z - poles.z1;
            moves = moves || dot(step, step) > tolerance * z.y * z.y;
            z = select(poles.z1, z, moving);
            poles.z1 = poles.z2;
            poles.z2 = z;
        }
        moving = moving && moves;
        if (!moving) {
            break;
        }
    }
    return poles;
}
fn steradian_conic_sweep(z: vec2f, begin: f32, end: f32) -> f32 {
    return steradian_trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}
fn steradian_conic_scaled(u0: vec3f, u1: vec3f, u2: vec3f, begin: f32, end: f32) -> SteradianConicArc {
    let least = 1.0e-12;
    let d0 = max(dot(u0, u0), steradian_smallest_divisor());
    let d4 = dot(u2, u2);
    let ratio = sqrt(d0 / max(d4, least * d0));
    var arc: SteradianConicArc;
    arc.scale = sqrt(ratio);
    arc.u0 = u0;
    arc.u1 = u1 * arc.scale;
    arc.u2 = select(u0 * sqrt(least), u2, d4 > least * d0) * ratio;
    arc.begin = begin / arc.scale;
    arc.end = end / arc.scale;
    arc.z1 = vec2f(0.0, 1.0);
    arc.z2 = vec2f(0.0, 1.0);
    arc.sweep = vec2f(0.0, 0.0);
    return arc;
}
fn steradian_conic_poles(arc: SteradianConicArc) -> SteradianQuarticPoles {
    let inverse = 1.0 / max(dot(arc.u2, arc.u2), steradian_smallest_divisor());
    let poles = steradian_quartic_poles_approximate(
        dot(arc.u0, arc.u0) * inverse, 2.0 * dot(arc.u0, arc.u1) * inverse,
        (dot(arc.u1, arc.u1) + 2.0 * dot(arc.u0, arc.u2)) * inverse, 2.0 * dot(arc.u1, arc.u2) * inverse);
    return steradian_conic_polish_poles(arc, poles);
}
fn steradian_conic_with_poles(scaled: SteradianConicArc, poles: SteradianQuarticPoles) -> SteradianConicArc {
    var arc = scaled;
    arc.z1 = poles.z1;
    arc.z2 = poles.z2;
    arc.sweep = vec2f(steradian_conic_sweep(arc.z1, arc.begin, arc.end), steradian_conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}
fn steradian_conic_prepare(u0: vec3f, u1: vec3f, u2: vec3f, begin: f32, end: f32) -> SteradianConicArc {
    let arc = steradian_conic_scaled(u0, u1, u2, begin, end);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}
struct SteradianConicNode {
    tau: f32,
    density: f32,
}
fn steradian_conic_node(arc: SteradianConicArc, share: f32) -> SteradianConicNode {
    let p1 = arc.z1.x;
    let p2 = arc.z2.x;
    let b1 = arc.z1.y;
    let b2 = arc.z2.y;
    let start = steradian_complex_product(vec2f(b1, arc.begin - p1), vec2f(b2, arc.begin - p2));
    let total = arc.sweep.x + arc.sweep.y;
    let turned = steradian_complex_product(steradian_complex_sign(start), -steradian_complex_unit(share * total - steradian_pi()));
    let s = turned.y;
    let c = turned.x;
    let linear_term = c * (b1 + b2) - s * (p1 + p2);
    let constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    let root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    let positive = linear_term >= 0.0;
    let top = select(root - linear_term, -2.0 * constant_term, positive);
    let bottom = select(2.0 * s, linear_term + root, positive);
    let usable = abs(bottom) > steradian_smallest_divisor();
    let tau = select(arc.begin, top / select(1.0, bottom, usable), usable);
    var node: SteradianConicNode;
    node.tau = clamp(tau, arc.begin, arc.end);
    let x1 = node.tau - p1;
    let x2 = node.tau - p2;
    node.density = b1 / (x1 * x1 + b1 * b1) + b2 / (x2 * x2 + b2 * b2);
    return node;
}
fn steradian_conic_residue(arc: SteradianConicArc, z: vec2f, o: vec2f, sweep: f32) -> vec3f {
    let n0 = cross(arc.u0, arc.u1);
    let n1 = cross(arc.u0, arc.u2) * 2.0;
    let n2 = cross(arc.u1, arc.u2);
    let re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    let im = (n1 + n2 * (2.0 * z.x)) * z.y;
    let x0 = arc.begin - z.x;
    let x1 = arc.end - z.x;
    let y2 = z.y * z.y;
    let logarithm = vec2f(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    let factor = steradian_complex_quotient(logarithm, steradian_conic_slope(z, o, dot(arc.u2, arc.u2)));
    return re * factor.x - im * factor.y;
}
fn steradian_conic_vector_approximate(arc: SteradianConicArc, wanted: bool) -> vec3f {
    var sum = vec3f(0.0, 0.0, 0.0);
    let total = arc.sweep.x + arc.sweep.y;
    for (var i: i32 = 0; i < 16; i++) {
        if (!wanted) {
            break;
        }
        let part: i32 = i / 8;
        let rule = steradian_gauss_legendre_node(8, i - 8 * part);
        let node = steradian_conic_node(arc, 0.5 * (rule.x + f32(part)));
        let u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
        let du = arc.u1 + arc.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), steradian_smallest_divisor())));
    }
    return sum;
}
fn steradian_conic_vector(arc: SteradianConicArc) -> vec3f {
    var e = steradian_conic_residue(arc, arc.z1, arc.z2, arc.sweep.x) + steradian_conic_residue(arc, arc.z2, arc.z1, arc.sweep.y);
    let close = 1.0e-2;
    let apart = arc.z1 - arc.z2;
    let meet = dot(apart, apart) < close * arc.z1.y * arc.z2.y && arc.end > arc.begin;
    if (meet) {
        e = select(e, steradian_conic_vector_approximate(arc, meet), meet);
    }
    return e;
}
struct SteradianEllipse {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
}
fn steradian_ellipse_prepare(center: vec3f, axis_a: vec3f, axis_b: vec3f) -> SteradianEllipse {
    var e: SteradianEllipse;
    e.center = center;
    e.axis_a = axis_a;
    let reversed = dot(center, cross(axis_a, axis_b)) < 0.0;
    e.axis_b = select(axis_b, -axis_b, reversed);
    return e;
}
fn steradian_ellipse_in_units(frame: mat3x3f, center: vec3f, axis_a: vec3f, axis_b: vec3f) -> SteradianEllipse {
    let size2 = dot(center, center) + dot(axis_a, axis_a) + dot(axis_b, axis_b);
    let unit = inverseSqrt(max(size2, steradian_smallest_divisor()));
    return steradian_ellipse_prepare(steradian_transform_transposed(frame, center) * unit, steradian_transform_transposed(frame, axis_a) * unit,
                           steradian_transform_transposed(frame, axis_b) * unit);
}
fn steradian_ellipse_elements(e: SteradianEllipse) -> SteradianLightElements {
    var elements: SteradianLightElements;
    elements.center = e.center;
    elements.reach_a = e.axis_a * 0.707106781186547524;
    elements.reach_b = e.axis_b * 0.707106781186547524;
    elements.area = cross(e.axis_b, e.axis_a) * steradian_pi();
    return elements;
}
fn steradian_ellipse_arc(e: SteradianEllipse, begin: f32, end: f32) -> SteradianConicArc {
    return steradian_conic_prepare(e.center + e.axis_a, e.axis_b * 2.0, e.center - e.axis_a, begin, end);
}
fn steradian_ellipse_irradiance_vector(e: SteradianEllipse) -> vec3f {
    let up = vec2f(e.axis_a.z, e.axis_b.z);
    let rise = sqrt(dot(up, up));
    let turn = select(vec2f(1.0, 0.0), up * (1.0 / max(rise, steradian_smallest_divisor())), rise > steradian_smallest_divisor());
    var level: SteradianEllipse;
    level.center = e.center;
    level.axis_a = e.axis_a * turn.x + e.axis_b * turn.y;
    level.axis_b = e.axis_b * turn.x - e.axis_a * turn.y;
    let top = e.center.z + rise;
    let bottom = rise - e.center.z;
    let shows = top > 0.0;
    let cut = bottom > 0.0 && shows;
    var limit = sqrt(max(top, 0.0) / max(bottom, steradian_smallest_divisor()));
    limit = select(select(0.0, 1.0e15, shows), limit, cut);
    let more = limit > 1.0;
    var lower = select(1.0, 1.0 / max(limit, 1.0), more);
    lower = select(lower, 0.0, limit > 1.0e14);
    var turned = level;
    var begin = -min(limit, 1.0);
    var end = min(limit, 1.0);
    var sum = vec3f(0.0, 0.0, 0.0);
    var far_side = sum;
    for (var i: i32 = 0; i < 3; i++) {
        let arc = steradian_conic_vector(steradian_ellipse_arc(turned, begin, end));
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
        if (!more) {
            break;
        }
    }
    sum = select(sum, sum + far_side, more);
    if (cut) {
        let inverse = 1.0 / (1.0 + limit * limit);
        let middle = level.center + level.axis_a * ((1.0 - limit * limit) * inverse);
        let aside = level.axis_b * (2.0 * limit * inverse);
        let down = middle + aside;
        let back_up = middle - aside;
        let angle = steradian_trig_atan2(down.x * back_up.y - down.y * back_up.x, down.x * back_up.x + down.y * back_up.y);
        sum = select(sum, sum + vec3f(0.0, 0.0, 0.5 * angle), cut);
    }
    let least = 1.0e-12;
    let size = sqrt(dot(e.center, e.center)) * sqrt(dot(e.axis_a, e.axis_a)) * sqrt(dot(e.axis_b, e.axis_b));
    let seen = dot(e.center, cross(e.axis_a, e.axis_b)) > least * size;
    return vec3f(select(0.0, sum.x, seen), select(0.0, sum.y, seen), select(0.0, clamp(sum.z, 0.0, steradian_pi()), seen));
}
fn steradian_ellipse_whole_irradiance_vector(e: SteradianEllipse) -> vec3f {
    let normal = cross(e.axis_a, e.axis_b);
    let across_a = cross(e.center, e.axis_a);
    let across_b = cross(e.center, e.axis_b);
    let c2 = dot(e.center, e.center);
    let det = dot(e.center, normal);
    let det2 = det * det;
    let t = dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b) - c2;
    let s = dot(normal, normal) - dot(across_a, across_a) - dot(across_b, across_b);
    let tolerance = 1.0e-7;
    var nu = c2;
    var moving = steradian_mask_all();  
    for (var i: i32 = 0; i < 24; i++) {
        let step = (((nu + t) * nu + s) * nu - det2) / max((3.0 * nu + 2.0 * t) * nu + s, steradian_smallest_divisor());
        let next = clamp(nu - step, 0.0, nu);
        let still_moving = moving && nu - next > tolerance * nu;
        nu = select(nu, next, moving);
        moving = still_moving;
        if (!moving) {
            break;
        }
    }
    let axis = e.center * (nu * nu) + (cross(e.axis_a, across_a) + cross(e.axis_b, across_b)) * nu + normal * det;
    let length2 = max(dot(axis, axis), steradian_smallest_square());
    let p = length2 / max(dot(axis, e.center), steradian_smallest_divisor());
    return axis * (steradian_pi() * det * inverseSqrt(max(length2 * nu * p, steradian_smallest_square())));
}
struct SteradianEllipseFan {
    ellipse: SteradianEllipse,
    turn: vec2f,
    beta: f32,
    near: bool,
    near_turn: vec2f,
    near_beta: f32,
}
fn steradian_ellipse_fan(e: SteradianEllipse) -> SteradianEllipseFan {
    var fan: SteradianEllipseFan;
    fan.ellipse = e;
    fan.turn = vec2f(1.0, 0.0);
    fan.beta = 1.0;
    fan.near = steradian_mask_none();
    fan.near_turn = vec2f(1.0, 0.0);
    fan.near_beta = 1.0;
    return fan;
}
fn steradian_ellipse_rim(e: SteradianEllipse, turn: vec2f) -> vec3f { return e.center + e.axis_a * turn.x + e.axis_b * turn.y; }
fn steradian_ellipse_nearest(e: SteradianEllipse) -> vec2f {
    var nearest = vec2f(1.0, 0.0);
    var rim = steradian_ellipse_rim(e, nearest);
    var least = dot(rim, rim);
    for (var k: i32 = 1; k < 8; k++) {
        let turn = steradian_complex_unit(0.25 * steradian_pi() * f32(k - 8 * (k / 5)));
        rim = steradian_ellipse_rim(e, turn);
        let distance2 = dot(rim, rim);
        nearest = select(nearest, turn, distance2 < least);
        least = min(distance2, least);
    }
    for (var i: i32 = 0; i < 4; i++) {
        rim = steradian_ellipse_rim(e, nearest);
        let tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        let slope = dot(rim, tangent);
        let curvature = dot(tangent, tangent) - dot(rim, rim - e.center);
        let step = -slope / max(abs(curvature), 1.0e-3 * dot(tangent, tangent) + steradian_smallest_divisor());
        nearest = steradian_complex_product(nearest, steradian_complex_unit(clamp(step, -0.4, 0.4)));
    }
    return nearest;
}
fn steradian_ellipse_fan_near(usual: SteradianEllipseFan) -> SteradianEllipseFan {
    let e = usual.ellipse;
    var fan = usual;
    let may_be = dot(e.center, e.center) < 2.25 * (dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b));
    if (may_be) {
        let nearest = steradian_ellipse_nearest(e);
        let rim = steradian_ellipse_rim(e, nearest);
        let opposite = steradian_ellipse_rim(e, -nearest);
        let tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        let distance2 = dot(rim, rim);
        fan.near = may_be && distance2 < 0.04 * dot(opposite, opposite);
        fan.near_turn = nearest;
        fan.near_beta = clamp(0.5 * sqrt(distance2 / max(dot(tangent, tangent), steradian_smallest_divisor())), 1.0e-6, 1.0);
    }
    return fan;
}
fn steradian_ellipse_fan_concentrated(e: SteradianEllipse, r: vec3f, width: f32) -> SteradianEllipseFan {
    let normal = cross(e.axis_a, e.axis_b);
    let n2 = max(dot(normal, normal), steradian_smallest_divisor());
    let height = dot(e.center, normal);  
    let along = dot(r, normal);
    let across = r * height - e.center * along;
    let place = vec2f(dot(across, cross(e.axis_b, normal)), dot(across, cross(normal, e.axis_a))) * (1.0 / n2);
    let size2 = dot(place, place);
    let off_centre = size2 > 1.0e-20;
    var fan = steradian_ellipse_fan(e);
    fan.turn = select(vec2f(1.0, 0.0), place * inverseSqrt(max(size2, 1.0e-20)), off_centre);
    let rim = e.center + e.axis_a * fan.turn.x + e.axis_b * fan.turn.y;
    let tangent = e.axis_b * fan.turn.x - e.axis_a * fan.turn.y;
    let reach = min(sqrt(size2) / max(along, 1.0e-12), 1.0e6);
    let blur = 1.6 * width * sqrt(dot(rim, rim) / max(dot(tangent, tangent), steradian_smallest_divisor()));
    let beta = sqrt(0.5 * (1.0 - reach) * (1.0 - reach) + min(blur * blur, 1.0e6));
    fan.beta = select(1.0, clamp(beta, 0.05, 1.0), along > 0.0);
    return steradian_ellipse_fan_near(fan);
}
fn steradian_ellipse_near_place(fan: SteradianEllipseFan, x: f32) -> vec2f {
    let power = exp(x);
    return steradian_complex_sign(vec2f(1.0, 0.5 * fan.near_beta * (power - 1.0 / power)));
}
fn steradian_ellipse_near_share(fan: SteradianEllipseFan, x: f32, lobe: vec2f, reach: f32) -> f32 {
    let w = steradian_ellipse_near_place(fan, x);
    let from_lobe = vec2f(w.x * lobe.x + w.y * lobe.y, (w.y * lobe.x - w.x * lobe.y) / fan.beta);
    let start = vec2f(-lobe.y, -lobe.x / fan.beta);  
    let angle = steradian_trig_atan2_unwrapped(start.x * from_lobe.y - start.y * from_lobe.x, start.x * from_lobe.x + start.y * from_lobe.y);
    return 0.5 * (angle * steradian_inverse_pi() + clamp(0.5 + 0.5 * x / reach, 0.0, 1.0));
}
fn steradian_ellipse_near_corner(fan: SteradianEllipseFan, k: i32, count: i32) -> vec2f {
    let far_side = 4.0 / fan.near_beta;
    let reach = log(far_side + sqrt(far_side * far_side + 1.0));
    let apart = vec2f(fan.turn.x * fan.near_turn.x + fan.turn.y * fan.near_turn.y, fan.turn.y * fan.near_turn.x - fan.turn.x * fan.near_turn.y);
    var lobe = vec2f(1.0 + apart.x, apart.y);
    lobe = select(vec2f(0.0, 1.0), steradian_complex_sign(lobe), dot(lobe, lobe) > 1.0e-10);
    var turn: i32 = k / count;  
    if (k < 0) {
        turn = -1;
    }
    let share = (f32(k - turn * count) + 0.5) / f32(count);
    var low = -reach - 3.0;
    var high = reach + 3.0;
    var low_share = 0.0;
    var high_share = 1.0;
    for (var i: i32 = 0; i < 8; i++) {
        let middle = 0.5 * (low + high);
        let value = steradian_ellipse_near_share(fan, middle, lobe, reach);
        let below = value < share;
        low = select(low, middle, below);
        low_share = select(low_share, value, below);
        high = select(middle, high, below);
        high_share = select(value, high_share, below);
    }
    let rest = clamp((share - low_share) / max(high_share - low_share, 1.0e-6), 0.0, 1.0);
    return steradian_ellipse_near_place(fan, low + rest * (high - low));
}
fn steradian_ellipse_corner(fan: SteradianEllipseFan, k: i32, count: i32) -> vec2f {
    let half_angle = steradian_pi() * (f32(k) / f32(count) - 0.5);
    let u = steradian_complex_unit(half_angle);
    var w = steradian_complex_sign(vec2f(u.x, fan.beta * u.y));
    var corner = steradian_complex_product(steradian_complex_product(w, w), fan.turn);
    if (fan.near) {
        w = steradian_ellipse_near_corner(fan, k, count);
        corner = select(corner, steradian_complex_product(steradian_complex_product(w, w), fan.near_turn), fan.near);
    }
    return corner;
}
fn steradian_ellipse_gap(from_corner: vec2f, to_corner: vec2f) -> f32 {
    let c = dot(from_corner, to_corner);
    let s = from_corner.x * to_corner.y - from_corner.y * to_corner.x;
    var angle = steradian_trig_atan2_unwrapped(s, c);
    angle = clamp(angle, 0.0, 2.6);
    let sine = select(0.515501371821464235, s, c > -0.856888753368947234 && s > 0.0);
    return select(angle / max(sine, 1.0e-4), 1.0, angle < 1.0e-3);
}
fn steradian_ellipse_corner_between(fan: SteradianEllipseFan, here: vec2f, gaps: f32) -> vec3f {
    let radius = sqrt(0.5 * gaps);
    let e = fan.ellipse;
    return e.center + (e.axis_a * here.x + e.axis_b * here.y) * radius;
}
fn steradian_ellipse_pushed_corner(fan: SteradianEllipseFan, before: vec2f, here: vec2f, after: vec2f) -> vec3f {
    return steradian_ellipse_corner_between(fan, here, steradian_ellipse_gap(before, here) + steradian_ellipse_gap(here, after));
}
fn steradian_ellipse_fan_corner(fan: SteradianEllipseFan, k: i32, count: i32) -> vec3f {
    return steradian_ellipse_pushed_corner(fan, steradian_ellipse_corner(fan, k - 1, count), steradian_ellipse_corner(fan, k, count), steradian_ellipse_corner(fan, k + 1, count));
}
fn steradian_capsule_elements(center: vec3f, axis: vec3f, radius: f32) -> SteradianLightElements {
    let r2 = radius * radius;
    let length2 = dot(axis, axis);
    let along = axis * inverseSqrt(max(length2, steradian_smallest_square()));
    let sight = center * inverseSqrt(max(dot(center, center), steradian_smallest_square()));
    let across = sight - along * dot(along, sight);
    let aside = cross(along, sight);
    let strip = 2.0 * radius * sqrt(length2);
    let balls = steradian_pi() * r2;
    let share = 2.0 / max(strip + balls, steradian_smallest_square());
    var e: SteradianLightElements;
    e.center = center;
    e.area = -(across * (inverseSqrt(max(dot(across, across), 1.0e-12)) * strip) + sight * balls);
    e.reach_a = along * sqrt(share * (strip * length2 * 0.0833333333333333333 + balls * (length2 + r2) * 0.25));
    e.reach_b = aside * (inverseSqrt(max(dot(aside, aside), 1.0e-12)) * sqrt(share * r2 * (strip * 0.333333333333333333 + balls * 0.25)));
    return e;
}
struct SteradianCapsule {
    end_a: vec3f,
    end_b: vec3f,
    along: vec3f,
    toward: vec3f,
    at_a: f32,
    at_b: f32,
    span: f32,
    height: f32,
    radius: f32,
    outside: bool,
}
fn steradian_capsule_prepare(end_a: vec3f, end_b: vec3f, radius: f32) -> SteradianCapsule {
    let difference = end_b - end_a;
    let span2 = dot(difference, difference);
    let a2 = dot(end_a, end_a);
    let b2 = dot(end_b, end_b);
    let nearer = select(end_b, end_a, a2 < b2);
    let nearer2 = min(a2, b2);
    let along = difference * inverseSqrt(max(span2, steradian_smallest_square()));
    let moment = cross(nearer, along);
    let height2 = dot(moment, moment);
    let at_a = dot(end_a, along);
    let at_b = dot(end_b, along);
    let radius2 = radius * radius;
    let tube = height2 > radius2 && span2 > steradian_smallest_divisor();
    let beside = at_a < 0.0 && at_b > 0.0 && span2 > steradian_smallest_divisor();
    let nearest = sqrt(nearer2);
    let direction = select(vec3f(0.0, 0.0, 1.0), nearer * inverseSqrt(max(nearer2, steradian_smallest_square())), nearer2 > steradian_smallest_square());
    let across = steradian_frame_from_normal(direction);
    var c: SteradianCapsule;
    c.end_a = select(nearer, end_a, tube);
    c.end_b = select(nearer, end_b, tube);
    c.along = select(steradian_transform(across, vec3f(1.0, 0.0, 0.0)), along, tube);
    c.toward = select(direction, cross(along, moment) * inverseSqrt(max(height2, steradian_smallest_square())), tube);
    c.at_a = select(0.0, at_a, tube);
    c.at_b = select(0.0, at_b, tube);
    c.span = select(0.0, sqrt(span2), tube);
    c.height = select(nearest, sqrt(height2), tube);
    c.radius = radius;
    c.outside = select(nearer2, height2, beside) > radius2;
    return c;
}
fn steradian_capsule_in_units(end_a: vec3f, end_b: vec3f, radius: f32) -> SteradianCapsule {
    let unit = inverseSqrt(max(dot(end_a, end_a) + dot(end_b, end_b) + radius * radius, steradian_smallest_divisor()));
    return steradian_capsule_prepare(end_a * unit, end_b * unit, radius * unit);
}
fn steradian_capsule_touch(c: SteradianCapsule) -> f32 {
    return sqrt(max((c.height - c.radius) * (c.height + c.radius), 0.0));
}
fn steradian_capsule_half_angle(c: SteradianCapsule, place: f32, distance: f32) -> f32 {
    return steradian_trig_atan2(steradian_capsule_touch(c), c.radius * place / max(distance, steradian_smallest_length()));
}
fn steradian_capsule_straight_part(along: vec3f, toward: vec3f, at_a: f32, at_b: f32, span: f32, height: f32, angle: f32, share: f32) -> vec3f {
    let h2 = height * height;
    let both = (h2 + at_a * at_a) * (h2 + at_b * at_b);
    let chords = share * span * height / max(both, steradian_smallest_square());
    return toward * (0.5 * (angle + chords * (h2 - at_a * at_b))) + along * (0.5 * chords * height * (at_a + at_b));
}
fn steradian_capsule_whole_vector(c: SteradianCapsule) -> vec3f {
    let touch = steradian_capsule_touch(c);
    let angle = steradian_trig_atan2_unwrapped(c.span * touch, touch * touch + c.at_a * c.at_b);
    let share = touch / max(c.height, steradian_smallest_length());
    let slope = c.radius / max(c.height, steradian_smallest_length());
    var e = steradian_capsule_straight_part(c.along, c.toward, c.at_a, c.at_b, c.span, c.height, angle, share) * (2.0 * slope);
    let a2 = max(dot(c.end_a, c.end_a), steradian_smallest_square());
    let b2 = max(dot(c.end_b, c.end_b), steradian_smallest_square());
    let ia = inverseSqrt(a2);
    let ib = inverseSqrt(b2);
    let sine_a = c.radius * ia;
    let sine_b = c.radius * ib;
    e = e + c.end_a * (sine_a * sine_a * ia * steradian_capsule_half_angle(c, -c.at_a, sqrt(a2)));
    return e + c.end_b * (sine_b * sine_b * ib * steradian_capsule_half_angle(c, c.at_b, sqrt(b2)));
}
fn steradian_capsule_add_arc(walk: SteradianPolygonWalk, center: vec3f, radius: f32, middle: vec3f, half_angle: f32, start: vec3f, finish: vec3f) -> SteradianPolygonWalk {
    let d2 = max(dot(center, center), steradian_smallest_square());
    let distance = sqrt(d2);
    let inverse = 1.0 / distance;
    let tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    let root = sqrt(max((radius - center.z) * (radius + center.z), 0.0));
    var horizon = steradian_trig_atan2(distance * root, -tangent * center.z);
    horizon = select(select(0.0, steradian_pi(), center.z > 0.0), horizon, root > 0.0);
    let turn = steradian_trig_atan2(abs(middle.x * center.y - middle.y * center.x) * inverse, middle.z);
    let low = turn - half_angle;
    let high = turn + half_angle;
    let seen = max(min(high, horizon) - max(low, -horizon), 0.0) + max(high - (2.0 * steradian_pi() - horizon), 0.0);
    let flat2 = max(center.x * center.x + center.y * center.y, steradian_smallest_square());
    let azimuth = vec2f(center.x, center.y) * inverseSqrt(flat2);
    let tilt = steradian_complex_sign(vec2f(tangent, root));
    let comes = steradian_complex_product(azimuth, tilt);
    let goes = steradian_complex_product(azimuth, vec2f(tilt.x, -tilt.y));
    let start_below = start.z < 0.0;
    let finish_below = finish.z < 0.0;
    let meets = root > 0.0;
    let twice = meets && ((!start_below && !finish_below && high > steradian_pi()) || (start_below && finish_below && turn < half_angle));
    let comes_up = twice || (start_below && !finish_below);
    let goes_down = twice || (finish_below && !start_below);
    let nowhere = vec3f(0.0, 0.0, 0.0);
    var chord = select(start, nowhere, start_below) - select(finish, nowhere, finish_below);
    chord = chord + select(nowhere, vec3f(comes.x, comes.y, 0.0), comes_up);
    chord = chord - select(nowhere, vec3f(goes.x, goes.y, 0.0), goes_down);
    let sine = radius * inverse;
    var next = walk;
    next.edges = walk.edges + center * (0.5 * sine * sine * inverse * seen) -
                 cross(center, chord) * (0.5 * tangent * inverse * inverse);
    let up = select(vec2f(1.0, 0.0), comes, comes_up);
    let down = select(vec2f(1.0, 0.0), vec2f(goes.x, -goes.y), goes_down);
    next.horizon = steradian_complex_product(walk.horizon, steradian_complex_product(up, down));
    return next;
}
fn steradian_capsule_irradiance_vector(c: SteradianCapsule) -> vec3f {
    var e = steradian_capsule_whole_vector(c);
    let cut = min(c.end_a.z, c.end_b.z) < c.radius;
    if (cut) {
        let a2 = dot(c.end_a, c.end_a);
        let b2 = dot(c.end_b, c.end_b);
        let r2 = c.radius * c.radius;
        let side = cross(c.toward, c.along);
        let inward = c.toward * (r2 / max(c.height, steradian_smallest_length()));
        let aside = side * (c.radius * steradian_capsule_touch(c) / max(c.height, steradian_smallest_length()));
        let ia = inverseSqrt(max(a2 - r2, steradian_smallest_square()));
        let ib = inverseSqrt(max(b2 - r2, steradian_smallest_square()));
        let a_left = (c.end_a - inward + aside) * ia;
        let a_right = (c.end_a - inward - aside) * ia;
        let b_left = (c.end_b - inward + aside) * ib;
        let b_right = (c.end_b - inward - aside) * ib;
        let da = sqrt(max(a2, steradian_smallest_square()));
        let db = sqrt(max(b2, steradian_smallest_square()));
        let a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
        let b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
        var walk = steradian_polygon_begin();
        walk = steradian_capsule_add_arc(walk, c.end_a, c.radius, a_middle, steradian_capsule_half_angle(c, -c.at_a, da), a_left, a_right);
        walk = steradian_polygon_add_edge(walk, a_right, b_right);
        walk = steradian_capsule_add_arc(walk, c.end_b, c.radius, b_middle, steradian_capsule_half_angle(c, c.at_b, db), b_right, b_left);
        walk = steradian_polygon_add_edge(walk, b_left, a_left);
        let shows = max(c.end_a.z, c.end_b.z) > -c.radius;
        let above = steradian_polygon_irradiance_vector(walk, steradian_mask_none());
        e = select(e, select(vec3f(0.0, 0.0, 0.0), above, shows), cut);
    }
    e = vec3f(e.x, e.y, clamp(e.z, 0.0, steradian_pi()));
    return select(vec3f(0.0, 0.0, 0.0), e, c.outside);
}
fn steradian_line_irradiance_vector(end_a: vec3f, end_b: vec3f) -> vec3f {
    let wa = abs(end_a.z);
    let wb = abs(end_b.z);
    let crossing = (end_a * wb + end_b * wa) * (1.0 / max(wa + wb, steradian_smallest_square()));
    let a = select(end_a, crossing, end_a.z < 0.0);
    let b = select(end_b, crossing, end_b.z < 0.0);
    let difference = b - a;
    let span2 = dot(difference, difference);
    let along = difference * inverseSqrt(max(span2, steradian_smallest_square()));
    let moment = cross(select(b, a, dot(a, a) < dot(b, b)), along);
    let height2 = max(dot(moment, moment), steradian_smallest_square());
    let height = sqrt(height2);
    let toward = cross(along, moment) * (1.0 / height);
    let span = sqrt(span2);
    let at_a = dot(a, along);
    let at_b = dot(b, along);
    let angle = steradian_trig_atan2_unwrapped(span * height, height2 + at_a * at_b);
    var e = steradian_capsule_straight_part(along, toward, at_a, at_b, span, height, angle, 1.0) * (1.0 / height);
    e = vec3f(e.x, e.y, max(e.z, 0.0));
    return select(e, vec3f(0.0, 0.0, 0.0), end_a.z <= 0.0 && end_b.z <= 0.0);
}
struct SteradianCapsuleEnd {
    center: vec3f,
    middle: vec3f,
    side: vec3f,
    last: vec2f,
    corners: f32,
    turn: vec2f,
    beta: f32,
    first: f32,
    step: f32,
}
struct SteradianCapsuleFan {
    a: SteradianCapsuleEnd,
    b: SteradianCapsuleEnd,
}
fn steradian_capsule_end(center: vec3f, radius: f32, middle: vec3f, half_angle: f32, r: vec3f, width: f32) -> SteradianCapsuleEnd {
    let d2 = max(dot(center, center), steradian_smallest_square());
    let inverse = inverseSqrt(d2);
    let sine = max(radius * inverse, steradian_smallest_length());
    let cosine2 = max(1.0 - sine * sine, steradian_smallest_length());
    let cosine = sqrt(cosine2);
    let axis = center * inverse;
    let side = cross(axis, middle);
    var end: SteradianCapsuleEnd;
    end.center = center * cosine2;
    end.middle = middle * (radius * cosine);
    end.side = side * (radius * cosine);
    end.last = steradian_complex_unit(half_angle);
    let along = dot(r, axis);
    let place = vec2f(dot(r, middle), dot(r, side)) * (cosine / (sine * max(along, 1.0e-12)));
    let nearest = clamp(steradian_trig_atan2(place.y, place.x), -half_angle, half_angle);
    end.turn = steradian_complex_unit(nearest);
    let apart = place - end.turn;
    let blur = min(1.6 * width / sine, 1.0e3);
    let beta = sqrt(min(0.5 * dot(apart, apart), 1.0e6) + blur * blur);
    end.beta = select(1.0, clamp(beta, 0.05, 1.0), along > 0.0);
    let low = steradian_complex_unit(-0.5 * (half_angle + nearest));
    let high = steradian_complex_unit(0.5 * (half_angle - nearest));
    end.first = steradian_trig_atan2(low.y, end.beta * low.x);
    end.step = steradian_trig_atan2(high.y, end.beta * high.x) - end.first;
    end.corners = 1.0;
    return end;
}
fn steradian_capsule_corner(end: SteradianCapsuleEnd, j: f32) -> vec2f {
    let u = steradian_complex_unit(clamp(end.first + end.step * (j + 0.5), -steradian_pi(), steradian_pi()));
    let w = steradian_complex_sign(vec2f(u.x, end.beta * u.y));
    var corner = steradian_complex_product(steradian_complex_product(w, w), end.turn);
    let limit = vec2f(0.939372712847378920, 0.342897807455451364);  
    let outer_low = j < 0.5;
    let outer_high = j > end.corners - 1.5;
    let low = vec2f(end.last.x, -end.last.y);
    corner = select(corner, steradian_complex_product(low, limit), outer_low && dot(corner, low) < limit.x);
    corner = select(corner, steradian_complex_product(end.last, vec2f(limit.x, -limit.y)), outer_high && dot(corner, end.last) < limit.x);
    return select(corner, vec2f(1.0, 0.0), outer_low && outer_high);
}
fn steradian_capsule_gap(corner: vec2f, neighbour: vec2f, joint: vec2f, outer: bool) -> f32 {
    let cosine = dot(corner, neighbour);
    var sine = abs(corner.x * neighbour.y - corner.y * neighbour.x);
    let angle = clamp(steradian_trig_atan2(sine, cosine), 0.0, 2.6);
    sine = select(0.515501371821464235, sine, cosine > -0.856888753368947234);
    let even = select(angle / max(sine, 1.0e-4), 1.0, angle < 1.0e-3);
    let c = max(dot(neighbour, joint), 0.5);
    let s = abs(neighbour.x * joint.y - neighbour.y * joint.x);
    var given = (even + (steradian_trig_atan2(s, c) - s / c) / max(sine, 1.0e-4)) * c;
    given = select(max(given, 0.5), 1.0, angle < 1.0e-3);
    return select(even, given * given, outer);
}
fn steradian_capsule_end_corner(end: SteradianCapsuleEnd, j: f32) -> vec3f {
    let here = steradian_capsule_corner(end, j);
    var joint = vec2f(end.last.x, -end.last.y);
    var joins = j < 1.5;
    let outer_low = j < 0.5;
    let outer_high = j > end.corners - 1.5;
    let outer = 1.0 / max(dot(here, select(end.last, joint, outer_low)), 0.5);
    var gaps = 0.0;
    for (var i: i32 = 0; i < 2; i++) {
        gaps = gaps + steradian_capsule_gap(here, steradian_capsule_corner(end, j + f32(2 * i - 1)), joint, joins);
        joint = end.last;
        joins = j > end.corners - 2.5;
    }
    let radius = select(sqrt(0.5 * gaps), outer, outer_low || outer_high);
    return end.center + (end.middle * here.x + end.side * here.y) * radius;
}
fn steradian_capsule_fan(c: SteradianCapsule, r: vec3f, width: f32, count: i32) -> SteradianCapsuleFan {
    let da = sqrt(max(dot(c.end_a, c.end_a), steradian_smallest_square()));
    let db = sqrt(max(dot(c.end_b, c.end_b), steradian_smallest_square()));
    let angle_a = steradian_capsule_half_angle(c, -c.at_a, da);
    let angle_b = steradian_capsule_half_angle(c, c.at_b, db);
    let a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
    let b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
    var fan: SteradianCapsuleFan;
    fan.a = steradian_capsule_end(c.end_a, c.radius, a_middle, angle_a, r, width);
    fan.b = steradian_capsule_end(c.end_b, c.radius, b_middle, angle_b, r, width);
    let share = fan.a.step / max(fan.a.step + fan.b.step, steradian_smallest_length());
    fan.a.corners = 1.0 + floor(0.5 + f32(count - 2) * share);
    fan.b.corners = f32(count) - fan.a.corners;
    fan.a.step = fan.a.step / fan.a.corners;
    fan.b.step = fan.b.step / fan.b.corners;
    return fan;
}
fn steradian_capsule_fan_corner(fan: SteradianCapsuleFan, k: i32) -> vec3f {
    let first = f32(k) < fan.a.corners;
    var end: SteradianCapsuleEnd;
    end.center = select(fan.b.center, fan.a.center, first);
    end.middle = select(fan.b.middle, fan.a.middle, first);
    end.side = select(fan.b.side, fan.a.side, first);
    end.last = select(fan.b.last, fan.a.last, first);
    end.corners = select(fan.b.corners, fan.a.corners, first);
    end.turn = select(fan.b.turn, fan.a.turn, first);
    end.beta = select(fan.b.beta, fan.a.beta, first);
    end.first = select(fan.b.first, fan.a.first, first);
    end.step = select(fan.b.step, fan.a.step, first);
    return steradian_capsule_end_corner(end, select(f32(k) - fan.a.corners, f32(k), first));
}
struct SteradianEllipsoidOutline {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
    outside: bool,  
}
fn steradian_ellipsoid_outline(to_center: vec3f, s: mat3x3f, inverse: mat3x3f) -> SteradianEllipsoidOutline {
    let p = -steradian_transform(inverse, to_center);
    let d2 = dot(p, p);
    let safe = max(d2, 1.000001);
    let inverse_d = inverseSqrt(safe);
    let k = p * inverseSqrt(max(d2, steradian_smallest_divisor()));
    let rho = sqrt(1.0 - 1.0 / safe);
    let frame = steradian_frame_from_normal(k);
    let a = steradian_transform(frame, vec3f(rho, 0.0, 0.0));
    let b = steradian_transform(frame, vec3f(0.0, rho, 0.0));
    var outline: SteradianEllipsoidOutline;
    outline.center = to_center + steradian_transform(s, k * inverse_d);
    outline.axis_a = steradian_transform(s, a);
    outline.axis_b = steradian_transform(s, b);
    outline.outside = d2 > 1.000001;
    return outline;
}
fn steradian_far_element_vector(area: vec3f, r: vec3f) -> vec3f {
    let inverse = 1.0 / max(dot(r, r), steradian_smallest_divisor());
    return (r * inverse) * (max(-dot(area, r), 0.0) * inverse);
}
fn steradian_far_ball_vector(r: vec3f) -> vec3f {
    let inverse = inverseSqrt(max(dot(r, r), steradian_smallest_divisor()));
    return (r * inverse) * (inverse * inverse);
}
fn steradian_far_error_of_one(deviation2: f32, distance2: f32) -> f32 { return 3.0 * deviation2 / distance2; }
fn steradian_far_error_of_four(third: f32, fourth: f32, symmetric: bool, distance2: f32) -> f32 {
    let by_third = 4.0 * third * inverseSqrt(distance2);
    let by_fourth = 5.0 * fourth / distance2;
    return select(by_third, min(by_third, by_fourth), symmetric) / distance2;
}
fn steradian_far_error_across_horizon(top: f32, deviation_up: f32, deviation: f32, distance: f32) -> f32 {
    let inverse = 1.0 / distance;
    return min(top * inverse, (0.5 * deviation_up + 3.0 * top * deviation * inverse) * inverse);
}
fn steradian_far_error_of_nodes(nodes: i32, reach: f32, distance: f32) -> f32 {
    let step = reach / (2.0 * distance);
    var power = 2.0 * f32(nodes + 1);
    for (var i: i32 = 0; i < nodes; i++) {
        power = power * step;
    }
    return power;
}
fn steradian_far_grazing(c: f32) -> vec2f {
    let x = clamp(1.0 - c, 0.0, 1.0);
    let x2 = x * x;
    return vec2f(x2 * x2 * x, 2.5 * x2 * x2 * sqrt(max(1.0 - (1.0 - x) * (1.0 - x), 0.0)));
}
fn steradian_far_error_of_grazing_nodes(nodes: i32, reach: f32, distance: f32, view_distance: f32, least_square: f32) -> f32 {
    let room = min(distance, view_distance);
    var best = 1.0e6;
    for (var k: i32 = 1; k < 4; k++) {
        let rho = 0.2 * f32(k) * room;
        let x = rho / (distance - rho);
        let y = rho / (view_distance - rho);
        let left = least_square - 0.5 * (x + y + x * y);
        let grazing = steradian_far_grazing(sqrt(max(left, 0.0))).x;
        let step = reach / (2.0 * rho);
        let growth = 1.0 + x;
        var power = 2.0 * growth * growth * grazing;
        for (var i: i32 = 0; i < nodes; i++) {
            power = power * step;
        }
        best = select(best, min(best, power), left > 0.0);
    }
    return best;
}
struct SteradianPunctualSource {
    position: vec3f,
    direction: vec3f,
    inverse_range2: f32,
    spot_scale: f32,
    spot_offset: f32,
}
struct SteradianPunctualIncident {
    direction: vec3f,
    irradiance: f32,
}
fn steradian_punctual_incident(light: SteradianPunctualSource, p: vec3f) -> SteradianPunctualIncident {
    let to = light.position - p;
    let d2 = max(dot(to, to), 1.0e-12);
    var incident: SteradianPunctualIncident;
    incident.direction = to * inverseSqrt(d2);
    let q = d2 * light.inverse_range2;
    let within = clamp(1.0 - q * q, 0.0, 1.0);
    let spot = clamp(light.spot_offset - dot(light.direction, incident.direction) * light.spot_scale, 0.0, 1.0);
    incident.irradiance = within * (spot * spot) / d2;
    return incident;
}
struct SteradianMomentEdge {
    side: f32,
    s: f32,
    c: f32,
    x0: f32,
    y0: f32,
    x1: f32,
    y1: f32,
    log_c: f32,
    swept: f32,
}
fn steradian_moment_log_1_plus(z: f32) -> f32 {
    let near = 0.25;
    let t = z / (2.0 + z);
    let t2 = t * t;
    let series = 2.0 * t * (1.0 + t2 * (0.333333333333333333 + t2 * (0.2 + t2 * (0.142857142857142857 + t2 * 0.111111111111111111))));
    return select(log(1.0 + z), series, z < near);
}
fn steradian_moment_1_minus_exp(x: f32) -> f32 {
    let near = 0.25;
    var result = 1.0 - exp(-x);
    let small = x < near;
    if (small) {
        let series = x * (1.0 - 0.5 * x * (1.0 - 0.333333333333333333 * x * (1.0 - 0.25 * x * (1.0 - 0.2 * x * (1.0 - 0.166666666666666667 * x)))));
        result = select(result, series, small);
    }
    return result;
}
fn steradian_moment_angle(w: f32, x0: f32, y0: f32, x1: f32, y1: f32) -> f32 {
    return steradian_trig_atan2_unwrapped(w * (x0 * y1 - x1 * y0), w * w * x0 * x1 + y0 * y1);
}
fn steradian_moment_minus_log_cosine2(s2: f32, c2: f32) -> f32 {
    let near = 0.05;
    var result = -log(c2);
    let small = s2 < near;
    if (small) {
        let series = s2 * (1.0 + s2 * (0.5 + s2 * (0.333333333333333333 + s2 * (0.25 + s2 * (0.2 + s2 * 0.166666666666666667)))));
        result = select(result, series, small);
    }
    return result;
}
fn steradian_moment_edge(a: vec3f, b: vec3f, r: vec3f) -> SteradianMomentEdge {
    let pole2 = 1.0e-6;
    var n = cross(a, b - a);  
    let n2 = dot(n, n);
    let has_length = n2 > steradian_smallest_divisor();
    n = n * inverseSqrt(max(n2, steradian_smallest_divisor()));
    let s = dot(n, r);
    let q = cross(n, r);
    let s2 = clamp(s * s, steradian_smallest_divisor(), 1.0);
    let c2 = clamp(dot(q, q), pole2, 1.0);
    var edge: SteradianMomentEdge;
    edge.side = select(0.0, select(1.0, -1.0, s < 0.0), has_length);
    edge.s = s2 * inverseSqrt(s2);
    edge.c = c2 * inverseSqrt(c2);
    edge.log_c = steradian_moment_minus_log_cosine2(s2, c2);
    let x0 = dot(a, r);
    let y0 = dot(a, q);
    let x1 = dot(b, r);
    let y1 = dot(b, q);
    edge.x0 = x0;
    edge.y0 = y0;
    edge.x1 = x1;
    edge.y1 = y1;
    edge.swept = 0.0;
    let behind0 = x0 <= 0.0;
    let behind1 = x1 <= 0.0;
    let pole = x0 * x0 + y0 * y0 < pole2;
    if (behind0 || behind1 || pole) {
        let none = (behind0 && behind1) || pole;
        edge.x0 = select(x0, 0.0, behind0 || none);
        edge.y0 = select(select(y0, -edge.c, behind0), edge.c, none);
        edge.x1 = select(x1, 0.0, behind1 || none);
        edge.y1 = select(y1, edge.c, behind1 || none);
        let whole = steradian_moment_angle(edge.s, x0, y0, x1, y1);
        let in_front = steradian_moment_angle(edge.s, edge.x0, edge.y0, edge.x1, edge.y1);
        var swept = select(max(whole - in_front, 0.0), whole, none);
        if (pole) {
            let arc = steradian_trig_atan2(sqrt(n2), dot(a, b));
            swept = select(swept, arc, pole);
        }
        edge.swept = select(0.0, swept, behind0 || behind1 || pole);
    }
    return edge;
}
fn steradian_moment_edge_share(edge: SteradianMomentEdge, front: f32) -> f32 {
    return edge.side * (front + edge.swept);
}
fn steradian_moment_phong_radiance(sum: f32, reversed: bool) -> f32 {
    return clamp(select(sum, -sum, reversed) * steradian_inverse_two_pi(), 0.0, 1.0);
}
struct SteradianMomentQuadrature {
    m: f32,
    s2: f32,
    c2: f32,
    kap: f32,
    w: f32,
    t0: f32,
    t1: f32,
}
fn steradian_moment_quadrature_parameter(w: f32, x: f32, y: f32) -> f32 {
    let wx = w * x;
    return clamp(y / max(wx + sqrt(wx * wx + y * y), steradian_smallest_length()), -1.0, 1.0);
}
fn steradian_moment_quadrature_prepare(edge: SteradianMomentEdge, n: f32) -> SteradianMomentQuadrature {
    var q: SteradianMomentQuadrature;
    q.m = n + 1.0;
    q.s2 = edge.s * edge.s;
    q.c2 = edge.c * edge.c;
    q.kap = sqrt(steradian_moment_1_minus_exp(0.5 * q.m * edge.log_c));
    q.w = edge.s / q.kap;
    q.t0 = steradian_moment_quadrature_parameter(q.w, edge.x0, edge.y0);
    q.t1 = steradian_moment_quadrature_parameter(q.w, edge.x1, edge.y1);
    return q;
}
struct SteradianMomentIntegrands {
    moment: f32,
    power: f32,
}
fn steradian_moment_quadrature_integrands(q: SteradianMomentQuadrature, t: f32) -> SteradianMomentIntegrands {
    let t2 = t * t;
    let d = 1.0 / (1.0 + t2);
    let cos_u = max((1.0 - t2) * d, 1.0e-15);
    let sin_u = 2.0 * t * d;
    let cos2 = cos_u * cos_u;
    let wsin2 = q.w * q.w * sin_u * sin_u;
    let Q = q.s2 * cos2 + wsin2;
    let exponent = 0.5 * q.m * steradian_moment_log_1_plus(Q / (q.c2 * cos2));  
    var result: SteradianMomentIntegrands;
    result.moment = 2.0 * d * q.kap * q.w * q.w * steradian_moment_1_minus_exp(exponent) / Q;
    result.power = 2.0 * d * q.w * exp(-exponent) / (cos2 + wsin2);
    return result;
}
fn steradian_moment_quadrature_pair(sum: SteradianMomentIntegrands, q: SteradianMomentQuadrature, mid: f32, offset: f32, weight: f32) -> SteradianMomentIntegrands {
    let a = steradian_moment_quadrature_integrands(q, mid - offset);
    let b = steradian_moment_quadrature_integrands(q, mid + offset);
    var next: SteradianMomentIntegrands;
    next.moment = sum.moment + weight * (a.moment + b.moment);
    next.power = sum.power + weight * (a.power + b.power);
    return next;
}
fn steradian_moment_quadrature_piece(q: SteradianMomentQuadrature, low: f32, high: f32) -> SteradianMomentIntegrands {
    let mid = 0.5 * (low + high);
    let h = 0.5 * (high - low);
    var sum: SteradianMomentIntegrands;
    sum.moment = 0.0;
    sum.power = 0.0;
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.986283808696812339, h * 0.035119460331751863);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.928434883663573517, h * 0.080158087159760210);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.827201315069764993, h * 0.121518570687903185);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.687292904811685470, h * 0.157203167158193535);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.515248636358154092, h * 0.185538397477937814);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.319112368927889760, h * 0.205198463721295604);
    sum = steradian_moment_quadrature_pair(sum, q, mid, h * 0.108054948707343662, h * 0.215263853463157790);
    return sum;
}
fn steradian_moment_quadrature_front(edge: SteradianMomentEdge, n: f32) -> SteradianMomentIntegrands {
    let q = steradian_moment_quadrature_prepare(edge, n);
    let to0 = steradian_moment_quadrature_piece(q, 0.0, q.t0);
    let to1 = steradian_moment_quadrature_piece(q, 0.0, q.t1);
    var result: SteradianMomentIntegrands;
    result.moment = max(to1.moment - to0.moment, 0.0);
    result.power = max(to1.power - to0.power, 0.0);
    return result;
}
struct SteradianMomentSeries {
    m: f32,
    b0: vec4f,
    b1: vec4f,
    b2: vec4f,
    b3: vec4f,
}
struct SteradianMomentSeriesHigh {
    m: f32,
    low0: vec3f,
    high0: vec3f,
    low1: vec3f,
    high1: vec3f,
    low2: vec3f,
    high2: vec3f,
    low3: vec3f,
    high3: vec3f,
    low4: vec3f,
    high4: vec3f,
    low5: vec3f,
    high5: vec3f,
}
fn steradian_moment_series_prepare(n: f32) -> SteradianMomentSeries {
    let g = 1.0 / (n + 1.0);
    var series: SteradianMomentSeries;
    series.m = n + 1.0;
    series.b0 = vec4f(
        0.12391 + g * (-0.25888 + g * 0.02078),
        0.07456 + g * (-0.20614 + g * 0.11305),
        -0.12583 + g * (0.43406 - g * 0.36368),
        0.15639 + g * (-0.50303 + g * 0.37906));
    series.b1 = vec4f(
        -0.03292 + g * (0.01056 + g * 0.11495),
        0.06163 + g * (-0.30904 + g * 0.37892),
        -0.11837 + g * (0.57004 - g * 0.68066),
        0.14285 + g * (-0.68183 + g * 0.80688));
    series.b2 = vec4f(
        -0.13853 + g * (0.41672 - g * 0.28568),
        -0.06770 + g * (0.08453 + g * 0.12882),
        0.04014 + g * (0.23881 - g * 0.72146),
        -0.07736 + g * (-0.16196 + g * 0.72256));
    series.b3 = vec4f(
        0.05051 + g * (-0.15092 + g * 0.09913),
        -0.07193 + g * (0.41519 - g * 0.56582),
        0.16852 + g * (-0.91416 + g * 1.19835),
        -0.20343 + g * (1.12430 - g * 1.49409));
    return series;
}
fn steradian_moment_series_high_prepare(n: f32) -> SteradianMomentSeriesHigh {
    let g = 1.0 / (n + 1.0);
    var series: SteradianMomentSeriesHigh;
    series.m = n + 1.0;
    series.low0 = vec3f(
        0.12669 + g * (-0.27819 + g * 0.04967),
        0.07312 + g * (-0.20720 + g * 0.11887),
        -0.28171 + g * (0.96646 - g * 0.78366));
    series.high0 = vec3f(
        0.96760 + g * (-3.22789 + g * 2.51001),
        -1.31672 + g * (4.38441 - g * 3.39728),
        0.67908 + g * (-2.22981 + g * 1.68799));
    series.low1 = vec3f(
        -0.03401 + g * (0.03357 + g * 0.07057),
        0.06494 + g * (-0.35196 + g * 0.45924),
        -0.35605 + g * (1.94458 - g * 2.56698));
    series.high1 = vec3f(
        1.18702 + g * (-6.44998 + g * 8.48253),
        -1.61836 + g * (8.78673 - g * 11.54971),
        0.82904 + g * (-4.48596 + g * 5.88295));
    series.low2 = vec3f(
        -0.13696 + g * (0.38633 - g * 0.22764),
        -0.06158 + g * (0.07469 + g * 0.12325),
        0.10552 + g * (0.38974 - g * 1.38750));
    series.high2 = vec3f(
        -0.41931 + g * (-1.05462 + g * 4.38637),
        0.57016 + g * (1.43774 - g * 5.97208),
        -0.30823 + g * (-0.67167 + g * 2.98664));
    series.low3 = vec3f(
        0.04598 + g * (-0.11007 + g * 0.03214),
        -0.06747 + g * (0.36907 - g * 0.48289),
        0.33782 + g * (-1.67745 + g * 2.03933));
    series.high3 = vec3f(
        -1.15579 + g * (5.80262 - g * 7.12399),
        1.57642 + g * (-7.90773 + g * 9.70255),
        -0.81732 + g * (4.11164 - g * 5.05901));
    series.low4 = vec3f(
        0.00469 + g * (-0.08385 + g * 0.15819),
        -0.00971 + g * (0.12521 - g * 0.23654),
        0.23694 + g * (-1.87957 + g * 3.05375));
    series.high4 = vec3f(
        -0.72818 + g * (5.87109 - g * 9.60316),
        0.99890 + g * (-8.04735 + g * 13.15881),
        -0.50043 + g * (4.05438 - g * 6.64504));
    series.low5 = vec3f(
        -0.01005 + g * (0.07653 - g * 0.11794),
        -0.00224 + g * (0.01770 - g * 0.03021),
        -0.00365 + g * (-0.11481 + g * 0.29662));
    series.high5 = vec3f(
        0.03795 + g * (0.13754 - g * 0.56050),
        -0.05687 + g * (-0.14794 + g * 0.70035),
        0.04439 + g * (-0.05460 - g * 0.13949));
    return series;
}
fn steradian_moment_series_cubic(b: vec4f, t: f32) -> f32 {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}
fn steradian_moment_series_quintic(low: vec3f, high: vec3f, t: f32) -> f32 {
    return ((((high.z * t + high.y) * t + high.x) * t + low.z) * t + low.y) * t + low.x;
}
struct SteradianMomentWarp {
    kap: f32,
    kap2: f32,
    du: f32,
    cosine: vec2f,
    sine: vec2f,
}
fn steradian_moment_warp(edge: SteradianMomentEdge, m: f32) -> SteradianMomentWarp {
    var warp: SteradianMomentWarp;
    warp.kap2 = steradian_moment_1_minus_exp(0.5 * m * edge.log_c);
    let over_kap = inverseSqrt(warp.kap2);
    warp.kap = warp.kap2 * over_kap;
    let w = edge.s * over_kap;
    let wx0 = w * edge.x0;
    let wx1 = w * edge.x1;
    warp.du = steradian_trig_atan2_unwrapped(wx0 * edge.y1 - wx1 * edge.y0, wx0 * wx1 + edge.y0 * edge.y1);
    let d0 = wx0 * wx0 + edge.y0 * edge.y0;
    let d1 = wx1 * wx1 + edge.y1 * edge.y1;
    let over_both = 2.0 / max(d0 * d1, steradian_smallest_divisor());
    let scale0 = over_both * d1;
    let scale1 = over_both * d0;
    warp.cosine = vec2f(scale0 * (wx0 * wx0 - edge.y0 * edge.y0), scale1 * (wx1 * wx1 - edge.y1 * edge.y1));
    warp.sine = vec2f(scale0 * wx0 * edge.y0, scale1 * wx1 * edge.y1);
    return warp;
}
fn steradian_moment_series_front(edge: SteradianMomentEdge, series: SteradianMomentSeries) -> f32 {
    let warp = steradian_moment_warp(edge, series.m);
    let t = warp.kap2;
    let s1 = warp.sine;
    let s2 = vec2f(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    let s3 = vec2f(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    let bump = steradian_moment_series_cubic(series.b0, t) * warp.du
              + steradian_moment_series_cubic(series.b1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_cubic(series.b2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_cubic(series.b3, t) * (s3.y - s3.x) * 0.166666666666666667;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}
fn steradian_moment_series_high_front(edge: SteradianMomentEdge, series: SteradianMomentSeriesHigh) -> f32 {
    let warp = steradian_moment_warp(edge, series.m);
    let t = warp.kap2;
    let s1 = warp.sine;
    let s2 = vec2f(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    let s3 = vec2f(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    let s4 = vec2f(warp.cosine.x * s3.x - s2.x, warp.cosine.y * s3.y - s2.y);
    let s5 = vec2f(warp.cosine.x * s4.x - s3.x, warp.cosine.y * s4.y - s3.y);
    let bump = steradian_moment_series_quintic(series.low0, series.high0, t) * warp.du
              + steradian_moment_series_quintic(series.low1, series.high1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_quintic(series.low2, series.high2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_quintic(series.low3, series.high3, t) * (s3.y - s3.x) * 0.166666666666666667
              + steradian_moment_series_quintic(series.low4, series.high4, t) * (s4.y - s4.x) * 0.125
              + steradian_moment_series_quintic(series.low5, series.high5, t) * (s5.y - s5.x) * 0.1;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}
fn steradian_moment_cosine_from_foot(x: f32, y: f32, n: f32) -> f32 {
    let a = n + 0.5;
    let v2 = steradian_moment_log_1_plus(y * y / max(x * x, steradian_smallest_divisor()));
    let t = 0.5 * a * v2;
    let v = sqrt(v2);
    let decay = exp(-t);
    let e = 1.0 / (1.0 + 0.3275911 * sqrt(t));
    let p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    let correction = v * (v2 + 3.0 / a) * inverseSqrt(a) / (60.1590786 - 3.75994241 / (a * a));
    let k = 0.5 * n + 0.25;
    let quarter_turn = 0.886226925452758014 * inverseSqrt(k + 0.03125 / k - 0.00439453125 / (k * k * k));
    let magnitude = quarter_turn * (1.0 - decay * (p - correction));
    return select(magnitude, -magnitude, y < 0.0);
}
fn steradian_moment_cosine_front(edge: SteradianMomentEdge, n: f32, low: i32) -> f32 {
    var order = n;
    if (low == 1) {
        order = n + 4.0;
    }
    let cosines = steradian_moment_cosine_from_foot(edge.x1, edge.y1, order) - steradian_moment_cosine_from_foot(edge.x0, edge.y0, order);
    var result = exp(-0.5 * order * edge.log_c) * cosines;
    if (low == 1) {
        let c2 = edge.c * edge.c;
        let p0 = steradian_phong_power(edge.x0, n + 1.0) * edge.y0;
        let p1 = steradian_phong_power(edge.x1, n + 1.0) * edge.y1;
        result = ((n + 4.0) * result - (p1 * edge.x1 * edge.x1 - p0 * edge.x0 * edge.x0)) / ((n + 3.0) * c2);
        result = ((n + 2.0) * result - (p1 - p0)) / ((n + 1.0) * c2);
    }
    return max(result, 0.0);
}
fn steradian_moment_series_low_front(edge: SteradianMomentEdge, raised: SteradianMomentSeries, n: f32) -> f32 {
    return max(steradian_moment_series_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}
fn steradian_moment_series_high_low_front(edge: SteradianMomentEdge, raised: SteradianMomentSeriesHigh, n: f32) -> f32 {
    return max(steradian_moment_series_high_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}
fn steradian_moment_double_axis_share(a: vec3f, b: vec3f, r: vec3f, v: vec3f, share: f32, cosines: f32) -> f32 {
    let n = cross(a, b);
    let n2 = dot(n, n);
    let inward = dot(n, v) * inverseSqrt(max(n2, steradian_smallest_divisor()));
    return dot(r, v) * share + select(0.0, inward * cosines, n2 > steradian_smallest_divisor());
}
fn steradian_moment_foreshortened_front(edge: SteradianMomentEdge, n: f32, level: i32) -> SteradianMomentIntegrands {
    var front: SteradianMomentIntegrands;
    front.moment = 0.0;
    front.power = 0.0;
    if (level > 0) {
        front.power = steradian_trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    } else {
        front = steradian_moment_quadrature_front(edge, n - 1.0);
    }
    return front;
}
fn steradian_moment_foreshortened_share(edge: SteradianMomentEdge, a: vec3f, b: vec3f, r: vec3f, front: f32, cosines: f32) -> f32 {
    return steradian_moment_double_axis_share(a, b, r, vec3f(0.0, 0.0, 1.0), steradian_moment_edge_share(edge, front), cosines);
}
struct SteradianLtcMatrix {
    xx: f32,
    xz: f32,
    yy: f32,
    zx: f32,
    zz: f32,
}
fn steradian_ltc_coordinates(roughness: f32, n_dot_v: f32) -> vec2f {
    return vec2f(clamp(roughness, 0.0, 1.0), sqrt(clamp(1.0 - n_dot_v, 0.0, 1.0)));
}
fn steradian_ltc_from_classic(t: vec4f) -> SteradianLtcMatrix {
    var m: SteradianLtcMatrix;
    m.xx = t.x;
    m.xz = t.z;
    m.yy = 1.0;
    m.zx = t.y;
    m.zz = t.w;
    return m;
}
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
fn steradian_ltc_transform(m: SteradianLtcMatrix, v: vec3f) -> vec3f {
    return vec3f(m.xx * v.x + m.xz * v.z, m.yy * v.y, m.zx * v.x + m.zz * v.z);
}
fn steradian_ltc_transform_transposed(m: SteradianLtcMatrix, v: vec3f) -> vec3f {
    return vec3f(m.xx * v.x + m.zx * v.z, m.yy * v.y, m.xz * v.x + m.zz * v.z);
}
fn steradian_ltc_lobe(m: SteradianLtcMatrix, l: vec3f) -> f32 {
    let w = steradian_ltc_transform(m, l);
    let d2 = max(dot(w, w), steradian_smallest_length());
    let determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    return determinant * max(w.z, 0.0) * steradian_inverse_pi() / (d2 * d2);
}
fn steradian_ltc_sharpness(m: SteradianLtcMatrix, l: vec3f) -> f32 {
    let w = steradian_ltc_transform(m, l);
    let size2 = m.xx * m.xx + m.xz * m.xz + m.yy * m.yy + m.zx * m.zx + m.zz * m.zz;
    return sqrt(size2 * dot(l, l) / max(dot(w, w), steradian_smallest_square()));
}
fn steradian_ltc_energy_above_horizon(m: SteradianLtcMatrix) -> f32 {
    return 0.5 + 0.5 * m.xx * inverseSqrt(max(m.xx * m.xx + m.zx * m.zx, steradian_smallest_square()));
}
struct SteradianLtcWalk {
    lobe: SteradianPolygonWalk,
    anchor: vec3f,
    anchored: bool,
}
fn steradian_ltc_begin() -> SteradianLtcWalk {
    var walk: SteradianLtcWalk;
    walk.lobe = steradian_polygon_begin();
    walk.anchor = vec3f(0.0, 0.0, 0.0);
    walk.anchored = steradian_mask_none();
    return walk;
}
fn steradian_ltc_direction(m: SteradianLtcMatrix, v: vec3f) -> vec3f {
    return steradian_polygon_direction(steradian_ltc_transform(m, v));
}
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
fn steradian_ltc_close_gap(walk: SteradianLtcWalk, part: SteradianEdgePart) -> SteradianLtcWalk {
    var next = walk;
    let crosses = part.rises || part.sinks;
    if (crosses) {
        let none = vec3f(0.0, 0.0, 0.0);
        let crossing = select(part.end, part.start, part.rises);
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
fn steradian_ltc_add_edge(walk: SteradianLtcWalk, m: SteradianLtcMatrix, a: vec3f, b: vec3f, ta: vec3f, tb: vec3f) -> SteradianLtcWalk {
    var next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        let part = steradian_ltc_part(m, a, b, ta, tb);
        next = steradian_ltc_close_gap(walk, part);
        next.lobe = steradian_polygon_add_edge(next.lobe, part.start, part.end);
    }
    return next;
}
fn steradian_ltc_integral(walk: SteradianLtcWalk, reversed: bool) -> f32 {
    return steradian_polygon_irradiance(walk.lobe, reversed) * steradian_inverse_pi();
}
fn steradian_ltc_specular_scale(f0: f32, f90: f32, n_a: f32, f_a: f32) -> f32 {
    return f0 * n_a + (f90 - f0) * f_a;
}
fn steradian_ltc_specular_with_fresnel_lobe(f0: f32, f90: f32, n_a: f32, integral: f32, f_a: f32, grazing: f32) -> f32 {
    return f0 * n_a * integral + (f90 - f0) * f_a * grazing;
}
fn steradian_ltc_multiple_scattering(f0: f32, albedo: f32) -> f32 {
    let a = clamp(albedo, 1.0e-2, 1.0);
    return 1.0 + f0 * (1.0 - a) / a;
}
fn steradian_ltc_clear_coat(base: f32, coat: f32, clearcoat: f32, n_dot_v: f32) -> f32 {
    let f = steradian_fresnel_schlick(0.04, 1.0, n_dot_v);
    return base * (1.0 - clearcoat * f) + clearcoat * coat;
}
fn steradian_ltc_sheen(base: f32, sheen: f32, strongest: f32, albedo: f32) -> f32 {
    return base * clamp(1.0 - strongest * albedo, 0.0, 1.0) + sheen;
}
struct SteradianLtcTextureFootprint {
    center: vec3f,
    axis_a: vec3f,
    axis_b: vec3f,
    valid: bool,
}
fn steradian_ltc_texture_transform_back(m: SteradianLtcMatrix, w: vec3f) -> vec3f {
    let determinant = m.xx * m.zz - m.xz * m.zx;
    return vec3f(m.zz * w.x - m.xz * w.z, w.y * (determinant / m.yy), m.xx * w.z - m.zx * w.x);
}
fn steradian_ltc_texture_diffuse() -> SteradianLtcMatrix {
    var m: SteradianLtcMatrix;
    m.xx = 1.0;
    m.xz = 0.0;
    m.yy = 1.0;
    m.zx = 0.0;
    m.zz = 1.0;
    return m;
}
fn steradian_ltc_texture_irradiance_vector(walk: SteradianLtcWalk, reversed: bool) -> vec3f {
    return steradian_polygon_irradiance_vector(walk.lobe, reversed);
}
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
struct SteradianLtcTextureEllipse {
    major: vec2f,
    minor: f32,
}
fn steradian_ltc_texture_axes(a: vec2f, b: vec2f) -> SteradianLtcTextureEllipse {
    let xx = a.x * a.x + b.x * b.x;
    let yy = a.y * a.y + b.y * b.y;
    let xy2 = a.x * a.y + b.x * b.y;
    let half_difference = 0.5 * (xx - yy);
    let spread = sqrt(half_difference * half_difference + xy2 * xy2);
    let v = select(vec2f(xy2, spread - half_difference), vec2f(half_difference + spread, xy2), half_difference > 0.0);
    let v2 = dot(v, v);
    let direction = select(vec2f(1.0, 0.0), v * inverseSqrt(max(v2, steradian_smallest_square())), v2 > steradian_smallest_square());
    let longest = sqrt(0.5 * (xx + yy) + spread);
    var e: SteradianLtcTextureEllipse;
    e.major = direction * longest;
    e.minor = abs(a.x * b.y - a.y * b.x) / max(longest, steradian_smallest_length());
    return e;
}
fn steradian_ltc_texture_gaussian(e: SteradianLtcTextureEllipse, width: f32, widest: f32) -> SteradianLtcTextureEllipse {
    let longest = width * sqrt(dot(e.major, e.major));
    var g: SteradianLtcTextureEllipse;
    g.major = e.major * (width * (widest / max(longest, widest)));
    g.minor = min(width * e.minor, widest);
    return g;
}
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
    let txx = vxx + sxx;
    let txy = light.y + sxy;
    let tyy = vyy + syy;
    let t_inverse = 1.0 / max(txx * tyy - txy * txy, steradian_smallest_square());
    var p = vec2f(vxx * slope.x + light.y * slope.y, light.y * slope.x + vyy * slope.y);
    p = vec2f(tyy * p.x - txy * p.y, txx * p.y - txy * p.x) * t_inverse;
    p = vec2f(sxx * p.x + sxy * p.y, sxy * p.x + syy * p.y);
    let q = max(dot(slope, p), 0.0);
    let share = 2.0 / (1.0 + sqrt(1.0 + 4.0 * q));
    let d = aside + p * share;
    let v_inverse = 1.0 / max(vxx * vyy - light.y * light.y, steradian_smallest_square());
    let e = vec2f(vyy * d.x - light.y * d.y, vxx * d.y - light.y * d.x) * v_inverse;
    let push = vec2f(sxx * e.x + sxy * e.y, sxy * e.x + syy * e.y);
    let pushed2 = max(dot(push, e), 0.0);
    return d + push * (2.5 * inverseSqrt(max(pushed2, 6.25)));
}
var<private> steradian_ltc_ggx_shape_words: array<u32, 512> = array<u32, 512>(
    0x40004000u, 0x14cf0182u, 0x40014000u, 0xa0378318u, 0x40003fffu, 0xa1200dc5u, 0x40024001u, 0x26159618u,
    0x40054006u, 0x21a19280u, 0x40074008u, 0x1c078e1cu, 0x40024002u, 0x24c8983au, 0x3fe93fedu, 0x21251653u,
    0x3fb63fc4u, 0x96d81bd5u, 0x3f6b3f7cu, 0x9e741d86u, 0x3f093f18u, 0x9b491c84u, 0x3e933ea0u, 0x98211b85u,
    0x3e113e1bu, 0x9ce81b2fu, 0x3d893d91u, 0x96951870u, 0x3d063d0bu, 0x89521396u, 0x3c863c8au, 0x1412141du,
    0x3ff84000u, 0x9ab08009u, 0x3ff94000u, 0x9fe00088u, 0x3ff73fffu, 0x131906cbu, 0x3ffb4002u, 0x97ec90fcu,
    0x40014007u, 0xa57212d5u, 0x40024007u, 0xa96b1594u, 0x3ffe4000u, 0xa8c21b9cu, 0x3fe13fe9u, 0xac1521feu,
    0x3faf3fbdu, 0xad7d25feu, 0x3f653f75u, 0xaf302924u, 0x3f033f12u, 0xafbf2b19u, 0x3e923e9du, 0xb0012c80u,
    0x3e113e17u, 0xb0002d43u, 0x3d8c3d90u, 0xafc22db8u, 0x3d093d0au, 0xaf5a2e0eu, 0x3c8b3c8cu, 0xaed42e18u,
    0x3fdd4000u, 0x0c5a0039u, 0x3fdd4000u, 0xa1ce009du, 0x3fdc3fffu, 0x9cbd0c5cu, 0x3fde4001u, 0x9eed90a7u,
    0x3fe64006u, 0xab0716acu, 0x3fe94005u, 0xaca71af7u, 0x3fe33ffcu, 0xad4d2100u, 0x3fc93fe0u, 0xb014260bu,
    0x3f993fb1u, 0xb19e29ebu, 0x3f513f68u, 0xb2f82ce8u, 0x3ef53f06u, 0xb3952eddu, 0x3e883e90u, 0xb3f0306au,
    0x3e0f3e0fu, 0xb3ef3131u, 0x3d923d8cu, 0xb3bf31c0u, 0x3d143d08u, 0xb3553204u, 0x3c9c3c8du, 0xb2e6321du,
    0x3fb04000u, 0xa8e6000du, 0x3fb04000u, 0xa49c0524u, 0x3faf3fffu, 0xa53910d6u, 0x3fb14001u, 0xa7401516u,
    0x3fb84005u, 0xab281b1eu, 0x3fbc4004u, 0xae921fd0u, 0x3fb63ff7u, 0xb027244fu, 0x3f9e3fd6u, 0xb22128f1u,
    0x3f723fa1u, 0xb4322c8bu, 0x3f303f54u, 0xb5222f6eu, 0x3edc3ef2u, 0xb5bc3135u, 0x3e7b3e80u, 0xb5f732a8u,
    0x3e103e02u, 0xb5ef33cdu, 0x3d9e3d83u, 0xb5d23456u, 0x3d2b3d04u, 0xb5903493u, 0x3cba3c90u, 0xb54834abu,
    0x3f704000u, 0xa9a501bfu, 0x3f704000u, 0xa60c06c2u, 0x3f6f3fffu, 0xab251535u, 0x3f724001u, 0xac831c02u,
    0x3f774006u, 0xae751efbu, 0x3f7a4003u, 0xb065230eu, 0x3f763ff2u, 0xb1fc273du, 0x3f623fcau, 0xb4422b42u,
    0x3f3c3f8eu, 0xb5b62e83u, 0x3f033f3bu, 0xb6ec3125u, 0x3ebc3ed7u, 0xb7a8332au, 0x3e6b3e69u, 0xb8023487u,
    0x3e103df0u, 0xb806354eu, 0x3db03d79u, 0xb7e335e2u, 0x3d4a3d01u, 0xb7a1363bu, 0x3ce63c93u, 0xb740365du,
    0x3f1e4000u, 0xaf7e871bu, 0x3f1e4000u, 0xb0661220u, 0x3f1d3fffu, 0xb00319e3u, 0x3f214002u, 0xb0531f29u,
    0x3f254004u, 0xb18e22e4u, 0x3f284002u, 0xb2f32655u, 0x3f253fe9u, 0xb46c29e6u, 0x3f133fbbu, 0xb5ac2d4fu,
    0x3ef73f75u, 0xb7443072u, 0x3ecd3f1du, 0xb86b32d7u, 0x3e963eb6u, 0xb8dd34abu, 0x3e593e4au, 0xb91435d7u,
    0x3e143ddbu, 0xb91c36ceu, 0x3dc93d6bu, 0xb90d378du, 0x3d793cffu, 0xb8e23802u, 0x3d243c98u, 0xb8bb3820u,
    0x3eba4000u, 0xb23902efu, 0x3eba4000u, 0xafa1106bu, 0x3eb93fffu, 0xb28a1cf2u, 0x3ebc4002u, 0xb3ed22bau,
    0x3ec24003u, 0xb4832609u, 0x3ec63ffbu, 0xb5502947u, 0x3ec33fdcu, 0xb63c2c92u, 0x3eb93fa8u, 0xb7732f8du,
    0x3ea53f59u, 0xb8963206u, 0x3e8d3ef8u, 0xb970346eu, 0x3e6d3e8eu, 0xb9fb35ecu, 0x3e463e26u, 0xba323749u,
    0x3e1d3dbfu, 0xba453838u, 0x3dec3d5bu, 0xba3c38adu, 0x3db43cfau, 0xba2238fcu, 0x3d763c9cu, 0xb9ec3929u,
    0x3e444000u, 0xb4798915u, 0x3e444000u, 0xb47915feu, 0x3e433fffu, 0xb58e206au, 0x3e474003u, 0xb66a2576u,
    0x3e4d4001u, 0xb6a628deu, 0x3e513ff3u, 0xb76d2c1eu, 0x3e543fccu, 0xb82c2ebfu, 0x3e513f8fu, 0xb8c73154u,
    0x3e4e3f37u, 0xb9a03402u, 0x3e4a3ecbu, 0xba9335aeu, 0x3e423e5fu, 0xbb2f3764u, 0x3e393dfcu, 0xbb6d3877u,
    0x3e2e3d9fu, 0xbb893924u, 0x3e1c3d44u, 0xbb8b39acu, 0x3e063cf3u, 0xbb833a1bu, 0x3dea3ca5u, 0xbb643a63u,
    0x3dbb4000u, 0xb62782c5u, 0x3dbb4000u, 0xb67b1713u, 0x3dbb3fffu, 0xb8882327u, 0x3dbf4001u, 0xb8912821u,
    0x3dc44000u, 0xb8bc2b4du, 0x3dcb3feau, 0xb90a2e1cu, 0x3dd33fbbu, 0xb98130edu, 0x3ddd3f74u, 0xba1a336bu,
    0x3dee3f11u, 0xbada3551u, 0x3e053e9au, 0xbbd23735u, 0x3e1b3e27u, 0xbc3d388fu, 0x3e313dc9u, 0xbc64396du,
    0x3e493d75u, 0xbc7b3a2fu, 0x3e5f3d2cu, 0xbc863ad5u, 0x3e743ce8u, 0xbc903b60u, 0x3e813cb2u, 0xbc913bd0u,
    0x3d204000u, 0xb8f58b5du, 0x3d214000u, 0xb92c1a85u, 0x3d203fffu, 0xb9af249du, 0x3d224001u, 0xba672996u,
    0x3d293ff7u, 0xba6b2d3cu, 0x3d323fddu, 0xbb083067u, 0x3d453fa2u, 0xbb6a3308u, 0x3d633f50u, 0xbbce3521u,
    0x3d8b3ee3u, 0xbc323700u, 0x3dc13e60u, 0xbca73892u, 0x3dfa3de8u, 0xbcfb399au, 0x3e353d8eu, 0xbd253a8cu,
    0x3e753d43u, 0xbd4b3b68u, 0x3ebe3d0au, 0xbd6d3c1au, 0x3f063cdbu, 0xbd893c74u, 0x3f5c3cbdu, 0xbdb43cd0u,
    0x3c734000u, 0xbb21902fu, 0x3c734000u, 0xbbdd1d0au, 0x3c733ffeu, 0xbc7a273au, 0x3c7d3ff9u, 0xbc762c4fu,
    0x3c853fe9u, 0xbc792fffu, 0x3c933fc1u, 0xbcb83271u, 0x3cb33f74u, 0xbd10350bu, 0x3ce73f1cu, 0xbd12370fu,
    0x3d2d3ea6u, 0xbd3638a5u, 0x3d873e1eu, 0xbd8339cbu, 0x3de63d9eu, 0xbdd73ae2u, 0x3e4c3d44u, 0xbe0c3beau,
    0x3ebf3d07u, 0xbe3f3c71u, 0x3f413cdfu, 0xbe813cefu, 0x3fde3ccbu, 0xbece3d70u, 0x40483cceu, 0xbf353dfeu,
    0x3b6b4000u, 0xbe8e9275u, 0x3b6a4000u, 0xbe062031u, 0x3b6e3ffeu, 0xbe6329b6u, 0x3b813ff5u, 0xbe642e8bu,
    0x3baf3fd2u, 0xbe2a320cu, 0x3be53f9bu, 0xbe4f34c9u, 0x3c1f3f32u, 0xbea93738u, 0x3c733ecdu, 0xbe9538e2u,
    0x3cdd3e5bu, 0xbe763a2cu, 0x3d5b3dc7u, 0xbea53b60u, 0x3dea3d42u, 0xbee23c3fu, 0x3e813cebu, 0xbf243cceu,
    0x3f323cbau, 0xbf733d5fu, 0x40033ca7u, 0xbfe63dfcu, 0x40883cb0u, 0xc03c3eb4u, 0x41423ce9u, 0xc0bb3fb3u,
    0x39bf4000u, 0xbbbf9592u, 0x39c04000u, 0xc0842123u, 0x39b93fffu, 0xc0422a49u, 0x39d33fd4u, 0xc07c3078u,
    0x3a353fb9u, 0xc032349bu, 0x3a953f66u, 0xc03d3743u, 0x3b333edbu, 0xc04b3946u, 0x3c113e6bu, 0xc0453adcu,
    0x3ca63df1u, 0xc0103c23u, 0x3d523d55u, 0xc00f3cbfu, 0x3e0f3cceu, 0xc01e3d4du, 0x3ee93c72u, 0xc0463de8u,
    0x3feb3c54u, 0xc0843e90u, 0x409c3c54u, 0xc0e93f6fu, 0x41853c8bu, 0xc187404fu, 0x42e43d04u, 0xc2814132u,
    0x380f4001u, 0xc55e9c43u, 0x38103ffbu, 0xc4272774u, 0x38203ffbu, 0xc28e30b3u, 0x38254006u, 0xc1fd343bu,
    0x387f3f7bu, 0xc22b3789u, 0x399b3f0cu, 0xc1d039f4u, 0x3a7c3e66u, 0xc1b83bf6u, 0x3ba03db3u, 0xc1ae3cefu,
    0x3ca93d43u, 0xc1423dacu, 0x3d8b3cabu, 0xc1113e3du, 0x3e863c23u, 0xc10c3ec2u, 0x3fb03b9au, 0xc13d3f68u,
    0x409b3b67u, 0xc1b64033u, 0x41a23bc3u, 0xc26e40c5u, 0x43263c42u, 0xc36d41aau, 0x45113d55u, 0xc507439du,
    0x33b93ffdu, 0x453495aau, 0x33b34005u, 0xc42b1bc9u, 0x335a400eu, 0xc44aab3fu, 0x342d3eeeu, 0xc54434f1u,
    0x352c3f42u, 0xc4a23b59u, 0x38623eb2u, 0xc4523d32u, 0x3ab53d7cu, 0xc3fb3e9cu, 0x3bfa3d06u, 0xc3563f56u,
    0x3d1b3c70u, 0xc2b63ff0u, 0x3e373ba5u, 0xc26c4029u, 0x3f763a56u, 0xc266406au, 0x409a39b6u, 0xc2b840d8u,
    0x41c339cfu, 0xc37d4161u, 0x439b39fcu, 0xc48242a4u, 0x45a63b52u, 0xc63c4484u, 0x48a63d3cu, 0xc8a646e8u,
    0x24d34002u, 0xd40ca6b9u, 0x25843fe4u, 0xccf33393u, 0x2a973eb4u, 0xcca43c45u, 0x31f940f9u, 0xc9204052u,
    0x35774002u, 0xc8424158u, 0x3ad93d1du, 0xc6e641d6u, 0x3c9b3ca3u, 0xc59641bbu, 0x3d4d3a86u, 0xc52b41d7u,
    0x3eba38f7u, 0xc4c041ddu, 0x4021364au, 0xc48e41fau, 0x411c343bu, 0xc4934245u, 0x4293330du, 0xc4ff42eeu,
    0x447d30f6u, 0xc623443cu, 0x468832f2u, 0xc8024552u, 0x491a3635u, 0xc9994777u, 0x4bc03c5au, 0xcbd848d8u);
var<private> steradian_ltc_ggx_magnitude_words: array<u32, 484> = array<u32, 484>(
    0x00003c00u, 0x00003c00u, 0x00013c00u, 0x00063bffu, 0x00113bfdu, 0x00283bf9u, 0x004e3bf1u, 0x00863be3u,
    0x00d13bcbu, 0x012c3ba8u, 0x01923b75u, 0x01fc3b30u, 0x025f3ad8u, 0x02b33a6du, 0x02f139f2u, 0x0313396du,
    0x031a38e1u, 0x03093855u, 0x02e3379bu, 0x02ae369eu, 0x027135b6u, 0x023134e7u, 0x00003c00u, 0x00003c00u,
    0x00013c00u, 0x00063bffu, 0x00123bfdu, 0x002c3bf9u, 0x00563bf1u, 0x00943be3u, 0x00e53bcbu, 0x01493ba8u,
    0x01b83b75u, 0x022b3b30u, 0x02963ad8u, 0x02ef3a6du, 0x032e39f2u, 0x0350396cu, 0x035438e1u, 0x033d3855u,
    0x0312379cu, 0x02d8369fu, 0x029535b8u, 0x024f34e9u, 0x00003c00u, 0x00003c00u, 0x00023c00u, 0x00073bffu,
    0x00183bfdu, 0x003a3bf9u, 0x00713bf1u, 0x00c43be3u, 0x012f3bcbu, 0x01b13ba8u, 0x02403b75u, 0x02d13b2fu,
    0x03543ad7u, 0x03bc3a6cu, 0x040039f1u, 0x041f396cu, 0x041738e1u, 0x03f03856u, 0x03b237a0u, 0x036336a4u,
    0x030d35bdu, 0x02b534efu, 0x00003c00u, 0x00003c00u, 0x00023c00u, 0x000a3bffu, 0x00233bfdu, 0x00573bf9u,
    0x00ab3bf1u, 0x01263be3u, 0x01c43bcbu, 0x02833ba7u, 0x03503b74u, 0x04193b2eu, 0x04c63ad5u, 0x05473a6au,
    0x059039f0u, 0x05a3396bu, 0x058238e2u, 0x053a3858u, 0x04d537a5u, 0x046036abu, 0x03e535c5u, 0x036d34f8u,
    0x00013c00u, 0x00003c00u, 0x00043c00u, 0x00133bffu, 0x00393bfdu, 0x00923bf9u, 0x011a3bf1u, 0x01de3be3u,
    0x02dd3bcbu, 0x04073ba7u, 0x053d3b73u, 0x06613b2du, 0x074e3ad3u, 0x07ee3a68u, 0x081b39eeu, 0x0815396bu,
    0x07d738e2u, 0x0751385au, 0x06aa37acu, 0x05f436b5u, 0x053c35d1u, 0x048d3505u, 0x00083c00u, 0x00063c00u,
    0x000e3c00u, 0x00283bffu, 0x006f3bfdu, 0x01073bf9u, 0x01f23bf1u, 0x03413be3u, 0x04e73bcbu, 0x06c53ba6u,
    0x08543b72u, 0x092a3b2au, 0x09cb3ad0u, 0x0a283a65u, 0x0a3f39ecu, 0x0a18396au, 0x09bf38e3u, 0x0946385du,
    0x08ba37b7u, 0x082b36c2u, 0x073e35e1u, 0x063b3516u, 0x00323c00u, 0x00313c00u, 0x003e3c00u, 0x00793bffu,
    0x00fc3bfdu, 0x020c3bf9u, 0x03b33bf1u, 0x05f53be2u, 0x085f3bcbu, 0x09e23ba5u, 0x0b573b70u, 0x0c463b27u,
    0x0caf3acdu, 0x0cdc3a61u, 0x0cd439e9u, 0x0c9c3969u, 0x0c4538e5u, 0x0bb43861u, 0x0acf37c3u, 0x09ec36d3u,
    0x091635f5u, 0x0856352cu, 0x00f63c00u, 0x00f53c00u, 0x010e3c00u, 0x01873bffu, 0x028e3bfdu, 0x04763bf9u,
    0x077d3bf1u, 0x09b53be2u, 0x0c063bcau, 0x0d3c3ba4u, 0x0e553b6du, 0x0f293b24u, 0x0fa33ac8u, 0x0fbb3a5du,
    0x0f8039e6u, 0x0f043968u, 0x0e6038e7u, 0x0da93866u, 0x0cef37d4u, 0x0c3d36e8u, 0x0b35360du, 0x0a173546u,
    0x03c93c00u, 0x03c63c00u, 0x04023c00u, 0x04ec3bffu, 0x06e73bfdu, 0x09423bf9u, 0x0bed3bf1u, 0x0da93be2u,
    0x0f933bc8u, 0x10ba3ba1u, 0x11833b6au, 0x12093b1fu, 0x123e3ac3u, 0x12283a58u, 0x11d439e3u, 0x11573968u,
    0x10c438eau, 0x1029386du, 0x0f2937e8u, 0x0e153702u, 0x0d20362bu, 0x0c4c3566u, 0x0a4b3c00u, 0x0a483c00u,
    0x0a8c3c00u, 0x0b5a3bffu, 0x0cab3bfdu, 0x0e4a3bf9u, 0x104d3bf0u, 0x11b53be1u, 0x13383bc6u, 0x144c3b9eu,
    0x14d03b65u, 0x15163b19u, 0x15183abdu, 0x14e23a52u, 0x148339e0u, 0x140d3968u, 0x131938eeu, 0x121c3875u,
    0x11313800u, 0x105e3720u, 0x0f4c364eu, 0x0e14358du, 0x10963c00u, 0x10953c00u, 0x10b53c00u, 0x111a3bffu,
    0x11fc3bfdu, 0x13633bf9u, 0x14a73bf0u, 0x15c43bdfu, 0x16e23bc4u, 0x17ce3b9au, 0x18303b5fu, 0x18433b12u,
    0x18223ab5u, 0x17b43a4cu, 0x16f239dcu, 0x161c3969u, 0x154438f4u, 0x14793880u, 0x1384380fu, 0x12443745u,
    0x11333678u, 0x104e35bau, 0x16053c00u, 0x16053c00u, 0x16203c00u, 0x167c3bffu, 0x17363bfdu, 0x18323bf9u,
    0x18f13befu, 0x19c33bddu, 0x1a813bc0u, 0x1b063b94u, 0x1b393b58u, 0x1b143b0au, 0x1aa63aadu, 0x1a053a46u,
    0x194e39dau, 0x1893396bu, 0x17c538fcu, 0x1685388du, 0x156d3821u, 0x147e3771u, 0x136936aau, 0x121d35f0u,
    0x1b403c00u, 0x1b413c00u, 0x1b573c00u, 0x1ba33bffu, 0x1c1e3bfdu, 0x1c8e3bf8u, 0x1d183beeu, 0x1da13bdau,
    0x1e0b3bbbu, 0x1e3a3b8cu, 0x1e243b4eu, 0x1dcd3b00u, 0x1d463aa4u, 0x1ca63a40u, 0x1c0239d8u, 0x1acd3970u,
    0x19b23906u, 0x18bb389eu, 0x17d13837u, 0x166f37a5u, 0x154936e5u, 0x14593630u, 0x20113c00u, 0x20113c00u,
    0x201a3c00u, 0x20363bffu, 0x206e3bfdu, 0x20bb3bf7u, 0x21113bebu, 0x21593bd6u, 0x217b3bb3u, 0x21683b81u,
    0x211f3b41u, 0x20ac3af3u, 0x201f3a9au, 0x1f173a3au, 0x1dff39d9u, 0x1d033977u, 0x1c263915u, 0x1ad638b3u,
    0x199d3851u, 0x189b37e4u, 0x178c372cu, 0x1633367cu, 0x244a3c00u, 0x244a3c00u, 0x24503c00u, 0x24643bffu,
    0x24873bfcu, 0x24b43bf6u, 0x24dc3be8u, 0x24ed3bcfu, 0x24d63ba7u, 0x24933b72u, 0x242c3b31u, 0x235e3ae5u,
    0x22543a90u, 0x21553a37u, 0x206f39ddu, 0x1f513983u, 0x1e023928u, 0x1cec38cdu, 0x1c073872u, 0x1a983818u,
    0x19673781u, 0x187036d7u, 0x284b3c00u, 0x284b3c00u, 0x284f3c00u, 0x285a3bffu, 0x286c3bfcu, 0x287c3bf3u,
    0x287d3be3u, 0x28623bc6u, 0x28223b98u, 0x27843b5eu, 0x269f3b1eu, 0x25ad3ad6u, 0x24c43a88u, 0x23e23a37u,
    0x227939e6u, 0x214b3995u, 0x20533943u, 0x1f1038efu, 0x1dc6389bu, 0x1cba3847u, 0x1bc237e8u, 0x1a643746u,
    0x2c1c3c00u, 0x2c1c3c00u, 0x2c1e3c00u, 0x2c213bfeu, 0x2c233bfau, 0x2c1b3befu, 0x2bfb3bdbu, 0x2b833bb7u,
    0x2ad03b83u, 0x29f93b48u, 0x29183b08u, 0x28433ac8u, 0x27063a84u, 0x25bc3a3du, 0x24ac39f7u, 0x239a39afu,
    0x22323966u, 0x210f391bu, 0x202538cfu, 0x1ece3881u, 0x1d9a3834u, 0x1ca237cfu, 0x2f8e3c00u, 0x2f8d3c00u,
    0x2f8c3c00u, 0x2f883bfeu, 0x2f753bf9u, 0x2f3a3be9u, 0x2ecf3bcdu, 0x2e2d3ba2u, 0x2d623b67u, 0x2c913b2eu,
    0x2b943af3u, 0x2a3a3abfu, 0x29103a88u, 0x281b3a4du, 0x26aa3a13u, 0x256b39d6u, 0x246c3997u, 0x233f3955u,
    0x21f63910u, 0x20ec38cbu, 0x20153884u, 0x1ecd383du, 0x32b83c00u, 0x32b83c00u, 0x32b63bffu, 0x32a23bfbu,
    0x326f3bf1u, 0x32193bdcu, 0x318b3bb5u, 0x30d13b7fu, 0x300f3b49u, 0x2eac3b12u, 0x2d713ae7u, 0x2c6c3ac3u,
    0x2b293a9bu, 0x29cd3a70u, 0x28b63a41u, 0x27b23a0fu, 0x265039dau, 0x253639a2u, 0x24523967u, 0x2332392au,
    0x220638ecu, 0x211238acu, 0x35c13c00u, 0x35bf3c00u, 0x35b43c00u, 0x35a03c01u, 0x35693bf8u, 0x34e03bc3u,
    0x34333b85u, 0x330b3b59u, 0x31c13b2eu, 0x30a73b0cu, 0x2f8c3af9u, 0x2e1e3ae6u, 0x2cf73acdu, 0x2c0a3aaeu,
    0x2a9d3a8bu, 0x29723a64u, 0x28833a3au, 0x27873a0du, 0x265239ddu, 0x255639abu, 0x24883977u, 0x23c03943u,
    0x38e03c00u, 0x38e23c00u, 0x38df3bfcu, 0x389c3bceu, 0x38093b77u, 0x37093b70u, 0x35e23b6cu, 0x34c83b57u,
    0x33be3b4cu, 0x32523b52u, 0x31253b4eu, 0x30313b42u, 0x2ee03b34u, 0x2da53b1bu, 0x2cae3b03u, 0x2bd23ae9u,
    0x2a953accu, 0x29953aaeu, 0x28c43a8du, 0x281a3a6au, 0x271a3a46u, 0x26303a20u, 0x3bab3c00u, 0x3ba03bfdu,
    0x3b243bfbu, 0x3a5b3c13u, 0x39d23c6du, 0x38983c3au, 0x377d3c29u, 0x35fc3c09u, 0x34fc3c13u, 0x340e3c05u,
    0x32aa3bf9u, 0x31843beeu, 0x30983be1u, 0x2fb73bd8u, 0x2e8c3bd1u, 0x2d9b3bcbu, 0x2cd93bc4u, 0x2c3c3bbdu,
    0x2b793bb6u, 0x2aa93bafu, 0x29fd3ba7u, 0x29733ba4u);
fn steradian_ltc_ggx_shape_at(k: i32) -> vec4f {
    return vec4f(unpack2x16float(steradian_ltc_ggx_shape_words[2 * k]), unpack2x16float(steradian_ltc_ggx_shape_words[2 * k + 1]));
}
fn steradian_ltc_ggx_shape(place: vec2f) -> vec4f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 15.0;
    let node = min(floor(x), vec2f(14.0, 14.0));
    let f = x - node;
    let k = i32(node.y) * 16 + i32(node.x);
    let low = mix(steradian_ltc_ggx_shape_at(k), steradian_ltc_ggx_shape_at(k + 1), f.x);
    let high = mix(steradian_ltc_ggx_shape_at(k + 16), steradian_ltc_ggx_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}
fn steradian_ltc_ggx_magnitude_at(k: i32) -> vec2f { return unpack2x16float(steradian_ltc_ggx_magnitude_words[k]); }
fn steradian_ltc_ggx_magnitude(place: vec2f) -> vec2f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 21.0;
    let node = min(floor(x), vec2f(20.0, 20.0));
    let f = x - node;
    let k = i32(node.y) * 22 + i32(node.x);
    let low = mix(steradian_ltc_ggx_magnitude_at(k), steradian_ltc_ggx_magnitude_at(k + 1), f.x);
    let high = mix(steradian_ltc_ggx_magnitude_at(k + 22), steradian_ltc_ggx_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}
var<private> steradian_ltc_charlie_shape_words: array<u32, 512> = array<u32, 512>(
    0x3b7137b5u, 0x9ee5b491u, 0x3e423cc4u, 0x99e2b415u, 0xb8debcf5u, 0xa41fb5bdu, 0x47354781u, 0x2806231au,
    0x46ad46c6u, 0x9ab42c50u, 0x44aa44aau, 0xa61fa4fau, 0x4325431au, 0xa452a8cdu, 0x41d541c6u, 0xa16ba90bu,
    0x410040eeu, 0x9ceaa8afu, 0x4072405eu, 0x936da838u, 0x400f3ff7u, 0x9022a73cu, 0x3f8e3f68u, 0x1258a645u,
    0x3f213efcu, 0x109ba55du, 0x3ecb3ea8u, 0x1033a4a8u, 0x3e833e62u, 0x1234a40du, 0x3e423e23u, 0x12a8a303u,
    0x388d3f71u, 0x23d43978u, 0x3cc1406du, 0x24f13c62u, 0xbb743c05u, 0x1db7b502u, 0x46b14559u, 0x2b0744c0u,
    0x45a344e1u, 0x2fb24146u, 0x444343f6u, 0x31533d8fu, 0x42d0428au, 0x31433a7eu, 0x41ae417cu, 0x30783827u,
    0x40ea40c1u, 0x2f6535b4u, 0x40634041u, 0x2e293426u, 0x40043fccu, 0x2d283253u, 0x3f7c3f46u, 0x2c5f30fau,
    0x3f133ee2u, 0x2b793009u, 0x3ebe3e92u, 0x2a6d2eb2u, 0x3e773e4fu, 0x29982da5u, 0x3e373e14u, 0x28e22cd5u,
    0x46a9419cu, 0xb6c54677u, 0x469c419au, 0xb6c1466au, 0x46ca419fu, 0xb6cf4698u, 0x4625418du, 0xb69e45f2u,
    0x445d41a6u, 0xae0a4252u, 0x43184167u, 0x2c263ff3u, 0x4206410fu, 0x30c53d39u, 0x413c40a1u, 0x31883b2fu,
    0x40a64038u, 0x314a3933u, 0x40373fc7u, 0x30c837dbu, 0x3fcc3f45u, 0x30393627u, 0x3f503ee1u, 0x2f6834f2u,
    0x3eef3e92u, 0x2e7b3411u, 0x3ea13e51u, 0x2dae32d0u, 0x3e5f3e1au, 0x2d0031cbu, 0x3e223de6u, 0x2c6e30fcu,
    0x45b83dabu, 0xb9bd4654u, 0x45b63db9u, 0xb9bd464du, 0x45be3d8au, 0xb9be4664u, 0x45a23e33u, 0xb9b94612u,
    0x43c63fb4u, 0xb5024287u, 0x42483fe7u, 0xad81403du, 0x41653fb7u, 0x20db3df7u, 0x40c53f66u, 0x2c773c60u,
    0x40523f1au, 0x2eff3a9fu, 0x3ff93ecfu, 0x2fe4392du, 0x3f753e8bu, 0x2fe03828u, 0x3f0f3e51u, 0x2f7736d0u,
    0x3ebd3e20u, 0x2ee235b0u, 0x3e793df5u, 0x2e4434d1u, 0x3e3d3dcdu, 0x2dad3420u, 0x3e063da6u, 0x2d223323u,
    0x45b23aa3u, 0xbb81465du, 0x45ad3ab5u, 0xbb804657u, 0x45be3a76u, 0xbb81466cu, 0x45833b5au, 0xbb7e4622u,
    0x43503de6u, 0xb75c4278u, 0x41d63e48u, 0xb3364047u, 0x41003e49u, 0xadee3e1bu, 0x40723e29u, 0xa2cd3c9eu,
    0x400e3e06u, 0x27673b46u, 0x3f8a3deau, 0x2b7b39ddu, 0x3f1f3dd2u, 0x2ccd38d3u, 0x3ec93dbbu, 0x2d473807u,
    0x3e853da4u, 0x2d4d36d2u, 0x3e4c3d8eu, 0x2d1f35d8u, 0x3e183d76u, 0x2cd8350cu, 0x3de83d5cu, 0x2c813466u,
    0x45a33831u, 0xbc61463bu, 0x459c3841u, 0xbc5e4636u, 0x45b4380bu, 0xbc6a4647u, 0x455f38cdu, 0xbc3d4608u,
    0x43073d09u, 0xb85f423cu, 0x41953d63u, 0xb5184035u, 0x40c03d68u, 0xb1dd3e0cu, 0x40383d5cu, 0xadbd3ca5u,
    0x3fba3d53u, 0xa7ca3b6fu, 0x3f383d4au, 0x19c13a20u, 0x3ed83d43u, 0x25a13924u, 0x3e8f3d3du, 0x287f385eu,
    0x3e543d37u, 0x2987377fu, 0x3e233d30u, 0x2a08367eu, 0x3df73d25u, 0x2a3235a9u, 0x3dcc3d16u, 0x2a1d34f8u,
    0x456837a7u, 0xbc7945d5u, 0x456137c3u, 0xbc7445d0u, 0x45793764u, 0xbc8545e0u, 0x4523385du, 0xbc4945a8u,
    0x42c63ca9u, 0xb89a41eau, 0x41683ce6u, 0xb5fa4010u, 0x40953ceau, 0xb3a13de1u, 0x40113ce0u, 0xb0b33c92u,
    0x3f733cddu, 0xad883b66u, 0x3efb3cddu, 0xaa133a29u, 0x3ea43ce0u, 0xa5643938u, 0x3e623ce2u, 0x9c0f387cu,
    0x3e2f3ce5u, 0x1f1537c9u, 0x3e033ce5u, 0x234136cfu, 0x3ddc3ce3u, 0x24d335fcu, 0x3db63cdcu, 0x2576354au,
    0x450f38d6u, 0xbc284547u, 0x450938e2u, 0xbc234542u, 0x451e38b9u, 0xbc334552u, 0x44d4394au, 0xbbf4451bu,
    0x42893c90u, 0xb87c418cu, 0x41433cb1u, 0xb6303fb5u, 0x40773caau, 0xb4323da3u, 0x3fef3ca0u, 0xb1bd3c6eu,
    0x3f453c9cu, 0xaffc3b3bu, 0x3ed23c9cu, 0xad9b3a0fu, 0x3e803ca0u, 0xabc3392cu, 0x3e433ca6u, 0xa9443879u,
    0x3e143cacu, 0xa6f137cfu, 0x3dec3cb1u, 0xa44a36e0u, 0x3dc93cb3u, 0xa0df3615u, 0x3da73cb1u, 0x9caa3568u,
    0x44b53a4eu, 0xbb5544b3u, 0x44b13a57u, 0xbb4f44afu, 0x44c03a39u, 0xbb6444bcu, 0x448c3aa6u, 0xbb17448eu,
    0x42563ca2u, 0xb82f4129u, 0x41233ca7u, 0xb5ed3f3au, 0x40613c95u, 0xb42b3d5au, 0x3fcb3c87u, 0xb2113c3eu,
    0x3f293c7eu, 0xb09e3af7u, 0x3eb93c7du, 0xaf3739dfu, 0x3e6a3c80u, 0xad993908u, 0x3e303c85u, 0xac68385eu,
    0x3e033c8cu, 0xaaf637abu, 0x3ddd3c92u, 0xa99836c7u, 0x3dbd3c96u, 0xa8883606u, 0x3d9d3c96u, 0xa77a3561u,
    0x44663bfbu, 0xba324424u, 0x44633c01u, 0xba2d4421u, 0x446e3bebu, 0xba40442cu, 0x44463c1du, 0xb9fb4405u,
    0x42283cd8u, 0xb75e40beu, 0x41093cbcu, 0xb5533eb7u, 0x40503c9du, 0xb3ad3d09u, 0x3fb63c88u, 0xb1e53c06u,
    0x3f1a3c7cu, 0xb0bc3aa3u, 0x3ead3c77u, 0xafca399du, 0x3e603c77u, 0xae8538d4u, 0x3e273c7cu, 0xad713834u,
    0x3dfc3c82u, 0xaca03765u, 0x3dd73c87u, 0xabde368du, 0x3db83c8cu, 0xaaca35d7u, 0x3d9a3c8du, 0xa9f3353au,
    0x44213cdfu, 0xb8ec433bu, 0x441f3ce0u, 0xb8e94337u, 0x44263cdbu, 0xb8f34346u, 0x440d3cf0u, 0xb8ce430fu,
    0x42033d24u, 0xb61c4051u, 0x40f63ce7u, 0xb4783e31u, 0x40473cbau, 0xb2a73cb4u, 0x3fad3c9du, 0xb1523b90u,
    0x3f163c8cu, 0xb0723a43u, 0x3eac3c84u, 0xaf9e394eu, 0x3e603c82u, 0xaea23893u, 0x3e283c84u, 0xadbc37f8u,
    0x3dfd3c89u, 0xad0c3705u, 0x3dd93c8eu, 0xac7c363bu, 0x3dbb3c92u, 0xabf6358fu, 0x3d9e3c93u, 0xab2434fcu,
    0x43df3dbau, 0xb7534247u, 0x43dc3dbbu, 0xb74f4244u, 0x43e63db8u, 0xb75d4250u, 0x43c33dc1u, 0xb7284226u,
    0x41e93d83u, 0xb4ae3fc9u, 0x40ea3d25u, 0xb2f43da8u, 0x40423ce8u, 0xb15d3c59u, 0x3fae3cc2u, 0xb0733b08u,
    0x3f1b3cacu, 0xafbc39d8u, 0x3eb33ca0u, 0xaede38f6u, 0x3e693c9bu, 0xae193846u, 0x3e313c9cu, 0xad6d3775u,
    0x3e063c9eu, 0xacee3692u, 0x3de33ca2u, 0xac7735d5u, 0x3dc53ca5u, 0xac0f3535u, 0x3daa3ca7u, 0xab5d34acu,
    0x43b03e9bu, 0xb50a4173u, 0x43af3e9bu, 0xb5084171u, 0x43b53e9bu, 0xb5104178u, 0x439e3e9cu, 0xb4f3415eu,
    0x41e03dfau, 0xb26a3ef4u, 0x40eb3d7bu, 0xb0d93d24u, 0x404a3d2du, 0xafa63bfau, 0x3fc23cfdu, 0xaea83a7bu,
    0x3f323ce0u, 0xae0e3967u, 0x3ecd3cd0u, 0xad803897u, 0x3e833cc8u, 0xad0d37e9u, 0x3e4a3cc6u, 0xacaf36e6u,
    0x3e1e3cc6u, 0xac4a3613u, 0x3dfb3cc9u, 0xabe33563u, 0x3ddd3ccbu, 0xab3934cfu, 0x3dc23ccdu, 0xaa9e3450u,
    0x43ba3fb6u, 0xb15f40b2u, 0x43b93fb6u, 0xb15c40b1u, 0x43be3fb8u, 0xb16640b7u, 0x43aa3fb0u, 0xb13f40a2u,
    0x41f83ea6u, 0xaea63e2eu, 0x41063e01u, 0xad163ca0u, 0x40673d9au, 0xac653b40u, 0x3ffd3d5cu, 0xac2839ecu,
    0x3f6e3d37u, 0xabea38f2u, 0x3f073d21u, 0xab953835u, 0x3eba3d15u, 0xab2a3740u, 0x3e803d0fu, 0xaac93651u,
    0x3e523d0du, 0xaa5c358eu, 0x3e2d3d0du, 0xa9ee34ecu, 0x3e0e3d0eu, 0xa9843464u, 0x3df33d0eu, 0xa92a33e1u,
    0x43f14086u, 0xa8a43ff8u, 0x43ef4086u, 0xa89c3ff5u, 0x43f54088u, 0xa8b83ffeu, 0x43e14081u, 0xa8543fdfu,
    0x422d3f91u, 0x9e3d3d65u, 0x413b3ebeu, 0x9c7c3c18u, 0x409b3e3bu, 0x9ed13a77u, 0x40323decu, 0xa2b7394cu,
    0x3fd13dbau, 0xa4bf3870u, 0x3f663d9cu, 0xa5c8378fu, 0x3f163d8au, 0xa6583685u, 0x3ed73d7fu, 0xa67b35adu,
    0x3ea63d79u, 0xa68934fdu, 0x3e7f3d76u, 0xa664346bu, 0x3e5f3d74u, 0xa62a33e3u, 0x3e433d73u, 0xa5f03316u,
    0x449d4292u, 0x32f43e4au, 0x449c4291u, 0x32f63e48u, 0x44a04295u, 0x32f13e4eu, 0x44944286u, 0x33023e39u,
    0x43284132u, 0x321c3c69u, 0x420e407au, 0x30b53adcu, 0x41534008u, 0x2f133988u, 0x40d73f84u, 0x2d3d389au,
    0x40813f2du, 0x2beb37c6u, 0x40423ef2u, 0x29ce36aeu, 0x40123eccu, 0x284c35ccu, 0x3fd93eb2u, 0x26323518u,
    0x3fa03e9fu, 0x24ab3483u, 0x3f703e93u, 0x22e43407u, 0x3f493e89u, 0x211b333cu, 0x3f293e82u, 0x1f37328bu);
var<private> steradian_ltc_charlie_magnitude_words: array<u32, 484> = array<u32, 484>(
    0x00000009u, 0x00000004u, 0x0000001bu, 0x00000000u, 0x0000018au, 0x00000174u, 0x00060fd8u, 0x00161896u,
    0x00301e43u, 0x00512269u, 0x0077257eu, 0x009e282du, 0x00c529d4u, 0x00eb2ba4u, 0x010f2cc6u, 0x01312dbdu,
    0x01502eb0u, 0x016c2f9au, 0x0185303au, 0x0198309du, 0x01a730f5u, 0x01b0313eu, 0x00000000u, 0x00000000u,
    0x00000000u, 0x00000000u, 0x0000018cu, 0x000001d9u, 0x00061048u, 0x001618d5u, 0x00301e7eu, 0x00522295u,
    0x0079259bu, 0x00a2283eu, 0x00cb29e7u, 0x00f22bb9u, 0x01182cd1u, 0x013c2dc8u, 0x015d2ebcu, 0x017b2fa6u,
    0x01953040u, 0x01aa30a3u, 0x01b930fau, 0x01c33143u, 0x0000007au, 0x0000007au, 0x00000079u, 0x0000007cu,
    0x0000006eu, 0x00010349u, 0x0006116cu, 0x00161999u, 0x00321f35u, 0x0057231fu, 0x008125f5u, 0x00af2874u,
    0x00dd2a24u, 0x010b2bfbu, 0x01372cf3u, 0x01612decu, 0x01882ee0u, 0x01ab2fcau, 0x01c93052u, 0x01e330b5u,
    0x01f6310cu, 0x02023154u, 0x00000116u, 0x00000117u, 0x00000111u, 0x00000130u, 0x000000a3u, 0x0001068bu,
    0x00061391u, 0x00171ae7u, 0x0034202bu, 0x005d23f2u, 0x008e267eu, 0x00c428c7u, 0x00fb2a83u, 0x01342c31u,
    0x016b2d2au, 0x019f2e25u, 0x01d12f1bu, 0x01fe3003u, 0x02253070u, 0x024730d3u, 0x02613129u, 0x02723170u,
    0x00000253u, 0x00000258u, 0x00000244u, 0x0000029cu, 0x0000010du, 0x00010a8eu, 0x00071597u, 0x00181c79u,
    0x00382106u, 0x00662492u, 0x00a02740u, 0x00e12939u, 0x01272b04u, 0x016f2c78u, 0x01b62d76u, 0x01fc2e74u,
    0x023d2f6bu, 0x027a302cu, 0x02b03099u, 0x02de30fbu, 0x03023151u, 0x031b3198u, 0x000004f8u, 0x00000502u,
    0x000004dau, 0x0000058eu, 0x0000025du, 0x00010e51u, 0x00081837u, 0x001b1dfbu, 0x003e223bu, 0x00742565u,
    0x00b92823u, 0x010a29d1u, 0x01632badu, 0x01c12cd3u, 0x021f2dd6u, 0x027c2ed8u, 0x02d52fd3u, 0x03283060u,
    0x037330ceu, 0x03b43130u, 0x03e83185u, 0x040d31cau, 0x0000093au, 0x00000943u, 0x0000091eu, 0x000009c2u,
    0x000005bbu, 0x000211dcu, 0x000a1a5eu, 0x001f200du, 0x004823deu, 0x0088267cu, 0x00dd28ccu, 0x01422a94u,
    0x01b42c42u, 0x022e2d46u, 0x02ac2e4fu, 0x03292f55u, 0x03a33029u, 0x041730a1u, 0x0480310fu, 0x04db3171u,
    0x052731c5u, 0x055e3209u, 0x00010d55u, 0x00010d5cu, 0x00010d3fu, 0x00010dc5u, 0x00000acbu, 0x0002153au,
    0x000d1cc8u, 0x00272182u, 0x00582502u, 0x00a527e1u, 0x010e29a2u, 0x018f2b86u, 0x02222cc6u, 0x02c22dd3u,
    0x03692ee3u, 0x04132feeu, 0x04b93077u, 0x055930f0u, 0x05ec315eu, 0x066e31c0u, 0x06db3213u, 0x072c3255u,
    0x00011148u, 0x0001114du, 0x00011136u, 0x000111a0u, 0x00010f85u, 0x00041882u, 0x00121f17u, 0x0033237au,
    0x00712665u, 0x00d228d0u, 0x01552aa8u, 0x01f92c56u, 0x02b72d66u, 0x03892e7du, 0x04682f94u, 0x054d3052u,
    0x063130d4u, 0x070c314eu, 0x07d931bdu, 0x0848321eu, 0x08963270u, 0x08d132b0u, 0x00021507u, 0x0002150bu,
    0x000214fau, 0x00021547u, 0x000113cfu, 0x00061b92u, 0x001b2132u, 0x0048250cu, 0x009a2814u, 0x011529e5u,
    0x01be2be7u, 0x02902d06u, 0x03882e24u, 0x049d2f45u, 0x05c63032u, 0x06fa30bdu, 0x08183142u, 0x08af31bcu,
    0x093d322bu, 0x09bd328cu, 0x0a2c32ddu, 0x0a81331au, 0x000318acu, 0x000318afu, 0x000318a2u, 0x000318dau,
    0x000217b9u, 0x000b1e33u, 0x002a2387u, 0x006c26c6u, 0x00dc2931u, 0x01802b38u, 0x025d2cb3u, 0x03712dd8u,
    0x04b62f04u, 0x06243018u, 0x07b030acu, 0x08a7313au, 0x097a31c1u, 0x0a49323du, 0x0b0d32adu, 0x0bc0330du,
    0x0c2d335cu, 0x0c6a3396u, 0x00061c3bu, 0x00061c3du, 0x00061c34u, 0x00061c5bu, 0x00041b58u, 0x001420fdu,
    0x00482567u, 0x00ac2885u, 0x014b2a98u, 0x022d2c6bu, 0x03572d9au, 0x04c72ed1u, 0x06783005u, 0x083130a1u,
    0x093a313au, 0x0a5231ccu, 0x0b703255u, 0x0c4532d2u, 0x0ccc3342u, 0x0d4833a2u, 0x0db533efu, 0x0e0a3412u,
    0x000c1f81u, 0x000d1f84u, 0x000c1f78u, 0x000d1facu, 0x000a1ec1u, 0x002823e5u, 0x008027b1u, 0x011d2a02u,
    0x020a2c2eu, 0x034d2d6au, 0x04ec2eaeu, 0x06e32ff7u, 0x089830a0u, 0x09e23142u, 0x0b4a31dfu, 0x0c633274u,
    0x0d263300u, 0x0de83380u, 0x0ea133f0u, 0x0f4d3427u, 0x0fe3344du, 0x102d3466u, 0x001e228bu, 0x001e228cu,
    0x001e2285u, 0x001f22a7u, 0x0019220du, 0x00542629u, 0x00ef2971u, 0x01ef2bf8u, 0x035c2d4du, 0x053c2ea4u,
    0x078e2ffeu, 0x092a30acu, 0x0ac23157u, 0x0c4531feu, 0x0d3c32a0u, 0x0e41333au, 0x0f4d33c9u, 0x102c3425u,
    0x10ac345eu, 0x1122348du, 0x118a34b0u, 0x11dd34c7u, 0x0043259cu, 0x0043259eu, 0x00432599u, 0x004525aeu,
    0x0038254eu, 0x00b528c6u, 0x01d02badu, 0x037e2d49u, 0x05c62ebdu, 0x08513017u, 0x0a0930cdu, 0x0c053182u,
    0x0d283233u, 0x0e6932e1u, 0x0fc43387u, 0x10983413u, 0x1152345cu, 0x120c349eu, 0x12be34d7u, 0x13623505u,
    0x13f23527u, 0x1432353bu, 0x00c128cbu, 0x00c128cbu, 0x00c028c9u, 0x00c528d5u, 0x00ad289bu, 0x01a82b60u,
    0x03bb2d6fu, 0x06a32f0fu, 0x092d3051u, 0x0b6d3115u, 0x0d0731d4u, 0x0e85328fu, 0x10183347u, 0x110033fau,
    0x11f93453u, 0x12fd34a4u, 0x140334efu, 0x14863533u, 0x1503356cu, 0x1576359au, 0x15db35bbu, 0x162935cbu,
    0x01be2c10u, 0x01bf2c10u, 0x01bc2c0fu, 0x01c82c16u, 0x01912be8u, 0x03d82db3u, 0x07ea2fb7u, 0x0a8630bdu,
    0x0cd23191u, 0x0ea2325bu, 0x10583320u, 0x117c33e0u, 0x12bd344eu, 0x140b34aau, 0x14c23502u, 0x157f3556u,
    0x163f35a3u, 0x16fb35e8u, 0x17ae3622u, 0x18293650u, 0x186f366eu, 0x18a5367au, 0x06112ee5u, 0x06122ee5u,
    0x060d2ee4u, 0x06232eebu, 0x05c12ec9u, 0x092c3065u, 0x0c89317eu, 0x0ecf3263u, 0x10b73337u, 0x122e33ffu,
    0x13ce3461u, 0x14ca34c0u, 0x15bf351fu, 0x16c4357cu, 0x17d635d6u, 0x1877362cu, 0x1905367cu, 0x198e36c2u,
    0x1a1036fdu, 0x1a853729u, 0x1ae83745u, 0x1b31374bu, 0x0b4731dau, 0x0b4831dau, 0x0b4331d9u, 0x0b5b31ddu,
    0x0aee31ccu, 0x0e4d32d8u, 0x112a33e4u, 0x133f345au, 0x14c134bau, 0x15f73515u, 0x17453570u, 0x185635ccu,
    0x19153629u, 0x19de3686u, 0x1aaf36e1u, 0x1b843739u, 0x1c2c378au, 0x1c9237d2u, 0x1cf23807u, 0x1d46381cu,
    0x1d8c3828u, 0x1dbe3828u, 0x143d350au, 0x143d350au, 0x143c350au, 0x1442350bu, 0x142a3505u, 0x15693568u,
    0x171c35c1u, 0x18663606u, 0x194b3649u, 0x1a3e3690u, 0x1b4136ddu, 0x1c2b372fu, 0x1cbe3786u, 0x1d5937e0u,
    0x1df9381eu, 0x1e9b384au, 0x1f3c3874u, 0x1fd63899u, 0x203238b7u, 0x206f38cbu, 0x20a038d5u, 0x20c138d1u,
    0x19673886u, 0x19673886u, 0x19663886u, 0x196c3886u, 0x194f3887u, 0x1b203879u, 0x1c813868u, 0x1d493861u,
    0x1e0e3865u, 0x1ed73874u, 0x1fa9388bu, 0x204438abu, 0x20bb38d1u, 0x213738fbu, 0x21b63928u, 0x22373956u,
    0x22b63981u, 0x232e39a8u, 0x239b39c7u, 0x23f739dbu, 0x241e39e2u, 0x243339d6u, 0x25893c9fu, 0x25893c9fu,
    0x258a3c9fu, 0x25893c9eu, 0x258d3ca5u, 0x25403c24u, 0x25063b6fu, 0x24f23af2u, 0x24f93aa5u, 0x25163a7du,
    0x25453a6fu, 0x25853a77u, 0x25d13a8fu, 0x26283ab2u, 0x26873addu, 0x26ea3b0du, 0x274c3b3du, 0x27aa3b68u,
    0x27fe3b8bu, 0x28213ba1u, 0x28373ba4u, 0x283e3b8eu);
fn steradian_ltc_charlie_shape_at(k: i32) -> vec4f {
    return vec4f(unpack2x16float(steradian_ltc_charlie_shape_words[2 * k]), unpack2x16float(steradian_ltc_charlie_shape_words[2 * k + 1]));
}
fn steradian_ltc_charlie_shape(place: vec2f) -> vec4f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 15.0;
    let node = min(floor(x), vec2f(14.0, 14.0));
    let f = x - node;
    let k = i32(node.y) * 16 + i32(node.x);
    let low = mix(steradian_ltc_charlie_shape_at(k), steradian_ltc_charlie_shape_at(k + 1), f.x);
    let high = mix(steradian_ltc_charlie_shape_at(k + 16), steradian_ltc_charlie_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}
fn steradian_ltc_charlie_magnitude_at(k: i32) -> vec2f { return unpack2x16float(steradian_ltc_charlie_magnitude_words[k]); }
fn steradian_ltc_charlie_magnitude(place: vec2f) -> vec2f {
    let x = clamp(place, vec2f(0.0, 0.0), vec2f(1.0, 1.0)) * 21.0;
    let node = min(floor(x), vec2f(20.0, 20.0));
    let f = x - node;
    let k = i32(node.y) * 22 + i32(node.x);
    let low = mix(steradian_ltc_charlie_magnitude_at(k), steradian_ltc_charlie_magnitude_at(k + 1), f.x);
    let high = mix(steradian_ltc_charlie_magnitude_at(k + 22), steradian_ltc_charlie_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}
struct SteradianCharlieCubature {
    lobe: SteradianCharlieLobe,
    centre: vec3f,
    facing: f32,
    sum: f32,
    at_centre: f32,
}
fn steradian_charlie_cubature_begin(lobe: SteradianCharlieLobe, e: vec3f, facing: f32) -> SteradianCharlieCubature {
    let inward = e * facing;
    let length2 = dot(inward, inward);
    var c: SteradianCharlieCubature;
    c.lobe = lobe;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, steradian_smallest_square())), length2 > steradian_smallest_square());
    c.facing = facing;
    c.sum = 0.0;
    c.at_centre = 0.0;
    return c;
}
fn steradian_charlie_cubature_arc(c: SteradianCharlieCubature, a: vec3f, b: vec3f) -> SteradianCharlieCubature {
    var next = c;
    let cosine = dot(a, b);
    let n = 2.0 + select(0.0, 1.0, cosine < 0.968912421710644784) + select(0.0, 1.0, cosine < 0.696706709347165421);
    let fan = dot(c.centre, cross(a, b)) * c.facing;
    for (var j: i32 = 0; j < 4; j++) {
        let present = n > f32(j) + 0.5 && abs(fan) > 0.0;
        if (present) {
            let rule = select(select(steradian_gauss_legendre_node(2, j), steradian_gauss_legendre_node(3, j), n > 2.5), steradian_gauss_legendre_node(4, j), n > 3.5);
            let u = a + (b - a) * rule.x;
            let inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
            let rim = u * sqrt(inverse2);
            let rim_cosine = dot(rim, c.centre);
            let aside = rim - c.centre * rim_cosine;
            let outward = aside * inverseSqrt(max(dot(aside, aside), steradian_smallest_divisor()));
            let weight = select(0.0, fan * inverse2 * rule.y / (1.0 + max(rim_cosine, -0.9)), present);
            next.at_centre = next.at_centre + 0.0625 * weight;
            var radial = 0.328844319980059696 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.212340538239152943));
            radial = radial + 0.388193468843171893 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.590533135559265283));
            radial = radial + 0.220462211176768373 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.911412040487296148));
            next.sum = next.sum + weight * radial;
        }
    }
    return next;
}
fn steradian_charlie_cubature_edge(c: SteradianCharlieCubature, a: vec3f, b: vec3f) -> SteradianCharlieCubature {
    let wide = dot(a, b) < 0.0;
    var middle = a + b;
    middle = select(b, middle * inverseSqrt(max(dot(middle, middle), steradian_smallest_divisor())), wide);
    var next = steradian_charlie_cubature_arc(c, a, middle);
    if (wide) {
        next = steradian_charlie_cubature_arc(next, middle, b);
    }
    return next;
}
fn steradian_charlie_cubature_finish(c: SteradianCharlieCubature) -> f32 {
    return max(c.sum + c.at_centre * steradian_charlie_lobe(c.lobe, c.centre), 0.0);
}
struct SteradianGgxView {
    v: vec3f,
    w: vec3f,
    ax: f32,
    ay: f32,
    masking: f32,
}
fn steradian_ggx_view(v: vec3f, ax: f32, ay: f32) -> SteradianGgxView {
    var view: SteradianGgxView;
    let z = max(v.z, 1.0e-6);
    view.v = vec3f(v.x, v.y, z);
    view.w = vec3f(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}
fn steradian_ggx_edge_scaled(view: SteradianGgxView, a: vec3f, b: vec3f) -> SteradianConicArc {
    let chord = b - a;
    let sum = a + b;
    let chord2 = dot(chord, chord);
    let sum2 = dot(sum, sum);
    let usable = chord2 > steradian_smallest_divisor() && sum2 > 1.0e-12;
    let middle = sum * inverseSqrt(max(sum2, steradian_smallest_divisor()));
    let along = chord * inverseSqrt(max(chord2, steradian_smallest_square()));
    let half_sine = 0.5 * sqrt(chord2);
    let half_cosine = max(0.5 * sqrt(sum2), 1.0e-6);
    let from_end = dot(middle, view.v) > 0.9;
    let side = select(0.0, select(1.0, -1.0, dot(chord, view.v) > 0.0), from_end);
    let turn_cosine = select(1.0, half_cosine, from_end);
    let base = middle * turn_cosine + along * (side * half_sine);
    let q = along * turn_cosine - middle * (side * half_sine);
    let reach = select(0.0, half_sine / (half_cosine + select(1.0, 0.0, from_end)), usable);
    let x = 1.0 / view.ax;
    let y = 1.0 / view.ay;
    let u0 = view.v + base;
    let u2 = view.v - base;
    return steradian_conic_scaled(
        vec3f(u0.x * x, u0.y * y, u0.z), vec3f(q.x * x, q.y * y, q.z) * 2.0, vec3f(u2.x * x, u2.y * y, u2.z),
        select(-reach, 0.0, side < 0.0), select(reach, 0.0, side > 0.0));
}
fn steradian_ggx_edge(view: SteradianGgxView, a: vec3f, b: vec3f) -> SteradianConicArc {
    let arc = steradian_ggx_edge_scaled(view, a, b);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}
fn steradian_ggx_unshadowed(view: SteradianGgxView, e: vec3f) -> f32 {
    return max(dot(view.w, e), 0.0) * steradian_inverse_pi() / view.v.z;
}
fn steradian_ggx_lobe_and_fresnel(view: SteradianGgxView, l: vec3f, smith: f32) -> vec2f {
    let h = steradian_microfacet_half_vector(l, view.v);
    let g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
    let plain = steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, view.ax, view.ay) * g, l, view.v);
    return vec2f(plain, plain * steradian_fresnel_schlick(0.0, 1.0, dot(view.v, h)));
}
struct SteradianGgxCubature {
    view: SteradianGgxView,
    centre: vec3f,
    amount: f32,
    extent: f32,
    smith: f32,
    facing: f32,
    weight: f32,
    centre_weight: f32,
    weighted: vec2f,
    at_centre: vec2f,
    lowest: vec2f,
    highest: vec2f,
}
fn steradian_ggx_shadowing_and_fresnel(view: SteradianGgxView, u: vec3f, smith: f32) -> vec2f {
    var h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    h = h * inverseSqrt(max(dot(h, h), steradian_smallest_divisor()));
    let v_dot_h = clamp(dot(view.v, h), 0.0, 1.0);
    let l = h * (2.0 * v_dot_h) - view.v;
    let lz = max(l.z, 0.0);
    let shadowing = 2.0 * lz / max(lz * view.masking + steradian_ggx_stretched_length(l, view.ax, view.ay), steradian_smallest_divisor());
    let g = select(0.0, 1.0 + smith * (shadowing - 1.0), l.z > 0.0);
    let x = 1.0 - v_dot_h;
    let x2 = x * x;
    return vec2f(g, g * (x2 * x2 * x));
}
fn steradian_ggx_cubature_begin(view: SteradianGgxView, e: vec3f, smith: f32, facing: f32) -> SteradianGgxCubature {
    var c: SteradianGgxCubature;
    let inward = e * facing;
    let length2 = dot(inward, inward);
    let usable = length2 > steradian_smallest_square();
    c.view = view;
    c.centre = select(vec3f(0.0, 0.0, 1.0), inward * inverseSqrt(max(length2, steradian_smallest_square())), usable);
    c.amount = select(0.0, steradian_ggx_unshadowed(view, inward), usable);
    c.extent = sqrt(length2);
    c.smith = smith;
    c.facing = facing;
    c.weight = 0.0;
    c.centre_weight = 0.0;
    c.weighted = vec2f(0.0, 0.0);
    c.at_centre = steradian_ggx_shadowing_and_fresnel(view, c.centre, smith);
    c.lowest = c.at_centre;
    c.highest = c.at_centre;
    return c;
}
fn steradian_ggx_cubature_add(c: SteradianGgxCubature, u: vec3f, weight: f32) -> SteradianGgxCubature {
    var next = c;
    let o = weight * max(dot(c.view.w, u), 0.0);
    let g = steradian_ggx_shadowing_and_fresnel(c.view, u, c.smith);
    let counts = abs(o) > 0.0;
    next.weight = c.weight + o;
    next.weighted = c.weighted + g * o;
    next.lowest = select(c.lowest, vec2f(min(c.lowest.x, g.x), min(c.lowest.y, g.y)), counts);
    next.highest = select(c.highest, vec2f(max(c.highest.x, g.x), max(c.highest.y, g.y)), counts);
    return next;
}
fn steradian_ggx_rule(n: f32, j: i32, most: i32) -> vec2f {
    var r = steradian_gauss_legendre_node(1, j);
    for (var k: i32 = 2; k <= most; k++) {
        r = select(r, steradian_gauss_legendre_node(k, j), n > f32(k) - 0.5);
    }
    return r;
}
fn steradian_ggx_cubature_edge(c: SteradianGgxCubature, edge: SteradianConicArc, extra: i32) -> SteradianGgxCubature {
    var next = c;
    let total = edge.sweep.x + edge.sweep.y;
    let n = 1.0 + select(1.0, 0.0, total < 0.25) + select(1.0, 0.0, total < 0.8) + select(1.0, 0.0, total < 1.6) + f32(extra);
    var fine = total >= 0.5;
    if (extra > 0) {
        fine = total > -1.0;
    }
    let wide = c.extent > 0.3 && max(c.view.ax, c.view.ay) > 0.08;
    for (var j: i32 = 0; j < 4 + extra; j++) {
        let present = n > f32(j) + 0.5 && total > 0.0;
        let rule = steradian_ggx_rule(n, j, 4 + extra);
        let node = steradian_conic_node(edge, rule.x);
        let u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
        let du = edge.u1 + edge.u2 * (2.0 * node.tau);
        let inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
        let rim = u * sqrt(inverse2);
        let rim_cosine = dot(rim, c.centre);
        let out_of_centre = rim - c.centre * rim_cosine;
        let outward = out_of_centre * inverseSqrt(max(dot(out_of_centre, out_of_centre), steradian_smallest_divisor()));
        var om = dot(c.centre, cross(u, du)) * (c.facing * inverse2 * rule.y * total / node.density)
            / (1.0 + max(rim_cosine, -0.9));  
        om = select(0.0, om, present);
        next.centre_weight = next.centre_weight + om * select(select(0.25, 0.111111111111111111, fine), 0.04, wide);
        var turns: i32 = 1;
        if (fine && present) {
            turns = 2;
        }
        if (wide && present) {
            turns = 4;
        }
        for (var k: i32 = 0; k < turns; k++) {
            var share = select(select(0.666666666666666667, 0.355051025721682190, fine), 0.139759864343780571, wide);
            var share_weight = select(select(0.75, 0.512485826188421615, fine), 0.223103901083570916, wide);
            if (k == 1) {
                share = select(0.844948974278317810, 0.416409567631083166, wide);
                share_weight = select(select(0.0, 0.376403062700467274, fine), 0.311826522975741250, wide);
            }
            if (k == 2) {
                share = 0.723156986361876117;
                share_weight = select(0.0, 0.281356015149461949, wide);
            }
            if (k == 3) {
                share = 0.942895803885482318;
                share_weight = select(0.0, 0.143713560791225886, wide);
            }
            next = steradian_ggx_cubature_add(next, steradian_fan_place(c.centre, outward, rim_cosine, share), om * share_weight);
            if (k + 1 == turns) {
                break;
            }
        }
        if (!(present && n > f32(j) + 1.5)) {
            break;
        }
    }
    return next;
}
fn steradian_ggx_limited(amount: f32, mean: vec2f, smith: f32) -> vec2f {
    var whole = amount * mean.x;
    whole = select(whole, min(whole, 1.0), smith > 0.5);
    return vec2f(whole, clamp(amount * mean.y, 0.0, whole));
}
fn steradian_ggx_cubature_finish(c: SteradianGgxCubature) -> vec2f {
    let o = c.centre_weight * max(dot(c.view.w, c.centre), 0.0);
    let weight = c.weight + o;
    let usable = weight > 1.0e-9 * c.extent;
    let scale = 1.0 / select(1.0, weight, usable);
    var mean = (c.weighted + c.at_centre * o) * scale;
    mean = vec2f(clamp(mean.x, c.lowest.x, c.highest.x), clamp(mean.y, c.lowest.y, c.highest.y));
    mean = select(c.at_centre, mean, usable);
    return steradian_ggx_limited(c.amount, mean, c.smith);
}
fn steradian_ggx_draft(view: SteradianGgxView, e: vec3f, smith: f32, facing: f32) -> vec2f {
    let c = steradian_ggx_cubature_begin(view, e, smith, facing);
    return steradian_ggx_limited(c.amount, c.at_centre, smith);
}
fn steradian_ggx_radiance(r: vec2f, f0: f32, f90: f32) -> f32 {
    return f0 * (r.x - r.y) + f90 * r.y;
}
fn steradian_blinn_phong_alpha(n: f32) -> f32 {
    return sqrt(2.0 / (n + 2.0));
}
fn steradian_half_vector_at(view: SteradianGgxView, edge: SteradianConicArc, tau: f32) -> vec3f {
    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let h = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    return h * inverseSqrt(max(dot(h, h), steradian_smallest_divisor()));
}
fn steradian_half_vector_split_uniform(edge: SteradianConicArc, share: f32) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    let u = steradian_complex_unit(first + share * (last - first));
    return clamp(u.y / max(u.x * edge.scale, steradian_smallest_length()), edge.begin, edge.end);
}
fn steradian_half_vector_split_pole_mapped(edge: SteradianConicArc, share: f32) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    let weight = 0.3 / max(last - first, 1.0e-12);
    let total = edge.sweep.x + edge.sweep.y + 0.3;
    let tolerance = 2.0e-6;
    let node = steradian_conic_node(edge, share);
    var tau = node.tau;
    var low = edge.begin;
    var high = edge.end;
    var left = total;
    var off = edge.end > edge.begin;
    for (var i: i32 = 0; i < 24; i++) {
        if (off) {
            let t = edge.scale * tau;
            let value = steradian_conic_sweep(edge.z1, edge.begin, tau) + steradian_conic_sweep(edge.z2, edge.begin, tau)
                + weight * (steradian_trig_atan2(t, 1.0) - first) - share * total;
            let x1 = tau - edge.z1.x;
            let x2 = tau - edge.z2.x;
            let slope = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
                + weight * edge.scale / (1.0 + t * t);
            low = select(low, tau, value < 0.0);
            high = select(tau, high, value < 0.0);
            let next = tau - value / slope;
            let fast = next > low && next < high && abs(value) < 0.5 * left;
            off = off && abs(value) > tolerance * total;
            left = abs(value);
            tau = select(tau, select(0.5 * (low + high), next, fast), off);
        }
    }
    return tau;
}
fn steradian_half_vector_split_weight(edge: SteradianConicArc) -> f32 {
    let first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    let last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    return 0.3 / max(last - first, 1.0e-12);
}
fn steradian_half_vector_split_end(edge: SteradianConicArc, tau: f32, weight: f32) -> SteradianConicNode {
    let t = edge.scale * tau;
    let x1 = tau - edge.z1.x;
    let x2 = tau - edge.z2.x;
    var node: SteradianConicNode;
    node.tau = tau;
    node.density = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
        + weight * edge.scale / (1.0 + t * t);
    return node;
}
struct SteradianHalfVectorNode {
    h: vec3f,
    solid_angle: f32,
}
fn steradian_half_vector_between(view: SteradianGgxView, edge: SteradianConicArc, first: SteradianConicNode, last: SteradianConicNode, a: vec3f, b: vec3f, rule: vec2f) -> SteradianHalfVectorNode {
    let bend = sqrt(first.density / max(last.density, steradian_smallest_divisor()));
    let bottom = 1.0 / (rule.x + bend * (1.0 - rule.x));
    let length = last.tau - first.tau;
    let tau = first.tau + length * rule.x * bottom;
    let step = length * bend * bottom * bottom * rule.y;
    let u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    let du = edge.u1 + edge.u2 * (2.0 * tau);
    var x = vec3f(view.ax * u.x, view.ay * u.y, u.z);
    let dx = vec3f(view.ax * du.x, view.ay * du.y, du.z);
    let inverse = inverseSqrt(max(dot(x, x), steradian_smallest_divisor()));
    x = x * inverse;
    var n = cross(a, b - a);
    let n2 = dot(n, n);
    n = n * inverseSqrt(max(n2, steradian_smallest_square()));
    let apart = dot(n, x - a);
    let middle = x - n * (0.5 * apart);
    let shorter = inverseSqrt(max(dot(middle, middle), steradian_smallest_divisor()));
    let sweep = dot(n, cross(x, dx)) * inverse * step;
    var node: SteradianHalfVectorNode;
    node.h = middle * shorter;
    node.solid_angle = select(0.0, -apart * sweep * (shorter * shorter * shorter), n2 > steradian_smallest_square());
    return node;
}
struct SteradianHalfVectorWalk {
    weight: f32,
    first: SteradianConicNode,
    last: SteradianConicNode,
    a: vec3f,
    b: vec3f,
}
fn steradian_half_vector_begin(view: SteradianGgxView, edge: SteradianConicArc) -> SteradianHalfVectorWalk {
    var walk: SteradianHalfVectorWalk;
    walk.weight = steradian_half_vector_split_weight(edge);
    walk.last = steradian_half_vector_split_end(edge, edge.begin, walk.weight);
    walk.b = steradian_half_vector_at(view, edge, edge.begin);
    walk.first = walk.last;
    walk.a = walk.b;
    return walk;
}
fn steradian_half_vector_next(walk: SteradianHalfVectorWalk, view: SteradianGgxView, edge: SteradianConicArc, tau: f32) -> SteradianHalfVectorWalk {
    var next = walk;
    next.first = walk.last;
    next.a = walk.b;
    next.last = steradian_half_vector_split_end(edge, tau, walk.weight);
    next.b = steradian_half_vector_at(view, edge, tau);
    return next;
}
fn steradian_half_vector_nodes() -> i32 { return 4; }
fn steradian_half_vector_node(walk: SteradianHalfVectorWalk, view: SteradianGgxView, edge: SteradianConicArc, i: i32) -> SteradianHalfVectorNode {
    let rule = steradian_gauss_legendre_node(steradian_half_vector_nodes(), i);
    return steradian_half_vector_between(view, edge, walk.first, walk.last, walk.a, walk.b, rule);
}
fn steradian_blinn_phong_at_half_vector(h: vec3f, v: vec3f, n: f32) -> f32 {
    return 2.0 * steradian_pi() * steradian_blinn_phong_distribution(h, n) * max(dot(h, v), 0.0);
}
fn steradian_beckmann_at_half_vector(view: SteradianGgxView, h: vec3f) -> f32 {
    return 2.0 * steradian_pi() * steradian_beckmann_distribution(h, view.ax, view.ay) * max(dot(h, view.v), 0.0);
}
fn steradian_ggx_at_half_vector(view: SteradianGgxView, h: vec3f) -> vec3f {
    let u = vec3f(h.x / view.ax, h.y / view.ay, h.z);
    let inverse2 = 1.0 / dot(u, u);
    return u * ((inverse2 / view.ax) * (inverse2 / view.ay));
}
fn steradian_blinn_phong_arc(a: vec3f, b: vec3f, v: vec3f, n: f32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = steradian_moment_edge(a, b, z);
    let front = steradian_moment_quadrature_front(edge, max(n, 1.0e-6) - 1.0);
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front.moment), front.power);
}
fn steradian_blinn_phong_arc_approximate(a: vec3f, b: vec3f, v: vec3f, series: SteradianMomentSeries, n: f32, range: i32) -> f32 {
    let z = vec3f(0.0, 0.0, 1.0);
    let edge = steradian_moment_edge(a, b, z);
    var front = 0.0;
    if (range == 2) {
        front = steradian_moment_series_low_front(edge, series, n - 1.0);
    } else {
        front = steradian_moment_series_front(edge, series);
    }
    var low: i32 = 0;
    if (range > 0) {
        low = 1;
    }
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front), steradian_moment_cosine_front(edge, n, low));
}
fn steradian_beckmann_error_function_approximate(x: f32) -> f32 {
    let t = abs(x);
    let e = 1.0 / (1.0 + 0.3275911 * t);
    let p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    let y = 1.0 - p * exp(-min(t * t, 80.0));
    return select(y, -y, x < 0.0);
}
fn steradian_beckmann_series() -> SteradianMomentSeriesHigh {
    var series = steradian_moment_series_high_prepare(1.0e30);
    series.m = 2.0;  
    return series;
}
fn steradian_beckmann_arc(view: SteradianGgxView, a: vec3f, b: vec3f, series: SteradianMomentSeriesHigh) -> f32 {
    let za = 1.0 / max(a.z, 1.0e-6);
    let zb = 1.0 / max(b.z, 1.0e-6);
    let p = vec2f(a.x * za / view.ax, a.y * za / view.ay);
    let q = vec2f(b.x * zb / view.ax, b.y * zb / view.ay);
    var along = q - p;
    let length2 = dot(along, along);
    let usable = length2 > steradian_smallest_divisor();
    along = along * inverseSqrt(max(length2, steradian_smallest_divisor()));
    let d = p.x * along.y - p.y * along.x;
    let low = dot(p, along);
    let high = dot(q, along);
    var edge: SteradianMomentEdge;
    edge.side = select(1.0, -1.0, d < 0.0);
    edge.s = max(abs(d), 1.0e-6);
    edge.c = 1.0;
    edge.x0 = 1.0;
    edge.y0 = low;
    edge.x1 = 1.0;
    edge.y1 = high;
    edge.log_c = min(edge.s * edge.s, 80.0);
    edge.swept = 0.0;
    let around = steradian_moment_edge_share(edge, steradian_moment_series_high_front(edge, series));
    let across = exp(-edge.log_c) * 0.886226925452758014
        * (steradian_beckmann_error_function_approximate(high) - steradian_beckmann_error_function_approximate(low));
    let share = view.w.z * around + (view.w.y * along.x - view.w.x * along.y) * across;
    return select(0.0, share, usable);
}
fn steradian_ggx_arc(view: SteradianGgxView, a: vec3f, b: vec3f) -> vec3f {
    let p = steradian_polygon_direction(vec3f(a.x / view.ax, a.y / view.ay, a.z));
    let q = steradian_polygon_direction(vec3f(b.x / view.ax, b.y / view.ay, b.z));
    return steradian_polygon_edge(p, q);
}
fn steradian_half_vector_radiance(view: SteradianGgxView, sum: f32, facing: f32) -> f32 {
    return max(sum * facing, 0.0) * steradian_inverse_two_pi() / view.v.z;
}
struct SteradianEdgeSlopes {
    normal: vec3f,
    by_start: f32,
    by_end: f32,
}
struct SteradianEdgeSlopesOfBoth {
    normal: vec3f,
    by_start: vec2f,
    by_end: vec2f,
    turn: vec3f,
    turn_of_fresnel: vec3f,
}
fn steradian_edge_irradiance_slopes(start: vec3f, end: vec3f) -> SteradianEdgeSlopes {
    var slopes: SteradianEdgeSlopes;
    slopes.normal = cross(start, end - start);
    let c = dot(start, end);
    let half_angle = steradian_trig_angle_over_sine_and_slope(c, dot(slopes.normal, slopes.normal)) * 0.5;
    let q = half_angle.y;
    let p = half_angle.x - c * q;
    slopes.by_start = -(start.z * p + end.z * q);
    slopes.by_end = -(end.z * p + start.z * q);
    return slopes;
}
fn steradian_edge_slopes_of_whole(part: SteradianEdgePart, of_part: SteradianEdgeSlopes) -> SteradianEdgeSlopes {
    var slopes = of_part;
    if (part.rises || part.sinks) {
        slopes.by_start = part.start_a * of_part.by_start + part.end_a * of_part.by_end;
        slopes.by_end = part.start_b * of_part.by_start + part.end_b * of_part.by_end;
    }
    return slopes;
}
fn steradian_polygon_part_slopes(part: SteradianEdgePart) -> SteradianEdgeSlopes {
    return steradian_edge_slopes_of_whole(part, steradian_edge_irradiance_slopes(part.start, part.end));
}
fn steradian_polygon_edge_slopes(a: vec3f, b: vec3f) -> SteradianEdgeSlopes {
    return steradian_polygon_part_slopes(steradian_edge_above_horizon(a, b));
}
fn steradian_ltc_part_slopes(part: SteradianEdgePart, lobe_part: SteradianEdgePart) -> SteradianEdgeSlopes {
    var slopes = steradian_edge_slopes_of_whole(part, steradian_polygon_part_slopes(lobe_part));
    slopes.normal = slopes.normal * steradian_inverse_pi();
    return slopes;
}
fn steradian_ltc_edge_slopes(m: SteradianLtcMatrix, a: vec3f, b: vec3f) -> SteradianEdgeSlopes {
    let part = steradian_ltc_part(m, a, b, steradian_ltc_direction(m, a), steradian_ltc_direction(m, b));
    return steradian_ltc_part_slopes(part, steradian_edge_above_horizon(part.start, part.end));
}
fn steradian_ltc_edge_transform_back(m: SteradianLtcMatrix, v: vec3f, g: vec3f) -> vec3f {
    let under = steradian_ltc_transform(m, v);
    return steradian_ltc_transform_transposed(m, g * inverseSqrt(max(dot(under, under), steradian_smallest_square())));
}
fn steradian_phong_part_slopes(part: SteradianEdgePart, r: vec3f, n: f32, low: i32) -> SteradianEdgeSlopes {
    let sum = part.start + part.end;
    let chord = part.end - part.start;
    let chord2 = dot(chord, chord);
    let sum_inverse = inverseSqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    let chord_inverse = inverseSqrt(max(chord2, steradian_smallest_divisor()));
    let axis_middle = dot(r, sum) * sum_inverse;
    let axis_along = dot(r, chord) * chord_inverse;
    let m = n + 1.0;
    var even = 0.0;
    var odd = 0.0;
    let is_short = chord2 * m < 4.0 && chord2 < 1.0 && dot(r, part.start) > 0.0 && dot(r, part.end) > 0.0;
    if (is_short) {
        let half_tangent = sum_inverse * chord2 * chord_inverse;
        for (var i: i32 = 0; i < 4; i++) {
            let rule = steradian_gauss_legendre_node(4, i);
            let u = half_tangent * (2.0 * rule.x - 1.0);
            let cosine = inverseSqrt(1.0 + u * u);
            let x = (axis_middle + axis_along * u) * cosine;
            let w = 2.0 * half_tangent * rule.y * steradian_phong_power(x, n) * cosine * cosine * cosine;
            even = even + w;
            odd = odd + w * u;
        }
    }
    if (!is_short) {
        let edge = steradian_moment_edge(part.start, part.end, r);
        let towards = steradian_moment_cosine_front(edge, m, low);
        let across = (steradian_phong_power(edge.x0, m) - steradian_phong_power(edge.x1, m)) / m;
        let over_c2 = 1.0 / (edge.c * edge.c);
        even = select((towards * axis_middle - across * axis_along) * over_c2, even, is_short);
        odd = select((towards * axis_along + across * axis_middle) * over_c2, odd, is_short);
    }
    var of_part: SteradianEdgeSlopes;
    of_part.normal = cross(part.start, chord);
    let n2 = dot(of_part.normal, of_part.normal);
    let scale = select(0.0, -m * steradian_inverse_two_pi() * inverseSqrt(max(n2, steradian_smallest_divisor())), n2 > steradian_smallest_divisor());
    even = even * sum_inverse;
    odd = odd * chord_inverse;
    of_part.by_start = (even - odd) * scale;
    of_part.by_end = (even + odd) * scale;
    return steradian_edge_slopes_of_whole(part, of_part);
}
fn steradian_phong_edge_slopes(a: vec3f, b: vec3f, r: vec3f, n: f32, low: i32) -> SteradianEdgeSlopes {
    return steradian_phong_part_slopes(steradian_edge_above_horizon(a, b), r, n, low);
}
fn steradian_ggx_edge_slopes_of_part(view: SteradianGgxView, part: SteradianEdgePart, arc: SteradianConicArc, smith: f32, nodes: i32, pieces: i32) -> SteradianEdgeSlopesOfBoth {
    let sum = part.start + part.end;
    let chord = part.end - part.start;
    let sum_inverse = inverseSqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    let chord_inverse = inverseSqrt(max(dot(chord, chord), steradian_smallest_divisor()));
    let half_cosine = 0.5 / sum_inverse;
    let half_sine = 0.5 / chord_inverse;
    let from_start = !(arc.begin < 0.0);
    let from_end = !(arc.end > 0.0);
    let base = vec2f(select(1.0, half_cosine, from_start || from_end), select(select(0.0, half_sine, from_end), -half_sine, from_start));
    let n = cross(part.start, chord);
    let across = n * inverseSqrt(max(dot(n, n), steradian_smallest_divisor()));
    var even = vec2f(0.0, 0.0);
    var odd = vec2f(0.0, 0.0);
    var turn = vec3f(0.0, 0.0, 0.0);
    var turn_of_fresnel = vec3f(0.0, 0.0, 0.0);
    let total = arc.sweep.x + arc.sweep.y;
    let share = 1.0 / f32(pieces);
    for (var i: i32 = 0; i < pieces; i++) {
        for (var j: i32 = 0; j < nodes; j++) {
            let rule = steradian_gauss_legendre_node(nodes, j);
            let node = steradian_conic_node(arc, (rule.x + f32(i)) * share);
            let u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
            let p = vec3f(u.x * view.ax, u.y * view.ay, u.z);  
            let p2 = max(dot(p, p), steradian_smallest_divisor());
            let along = dot(p, view.v);
            let u2 = max(dot(u, u), steradian_smallest_divisor());
            let l = p * (2.0 * along / p2) - view.v;
            let g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
            let w = (p2 / u2) * (along / u2) * g * rule.y * share * total / max(node.density, steradian_smallest_divisor());
            let p_inverse = inverseSqrt(p2);
            let both = vec2f(w, w * steradian_fresnel_schlick(0.0, 1.0, along * p_inverse));
            let h = p * p_inverse;
            let moved = h * (2.0 * dot(across, h)) - across;
            turn = turn + moved * both.x;
            turn_of_fresnel = turn_of_fresnel + moved * both.y;
            let t = node.tau * arc.scale;
            let d = 1.0 / (1.0 + t * t);
            let angle = steradian_complex_product(base, vec2f((1.0 - t * t) * d, 2.0 * t * d));
            even = even + both * (angle.x * sum_inverse);
            odd = odd + both * (angle.y * chord_inverse);
        }
    }
    var density = arc.scale * steradian_inverse_pi() / (view.ax * view.ay * view.v.z);
    density = select(0.0, density, arc.end > arc.begin);
    let scale = -density * inverseSqrt(max(dot(n, n), steradian_smallest_divisor()));
    let by_part_start = (even - odd) * scale;
    let by_part_end = (even + odd) * scale;
    var slopes: SteradianEdgeSlopesOfBoth;
    slopes.normal = n;
    slopes.by_start = by_part_start * part.start_a + by_part_end * part.end_a;
    slopes.by_end = by_part_start * part.start_b + by_part_end * part.end_b;
    slopes.turn = turn * density;
    slopes.turn_of_fresnel = turn_of_fresnel * density;
    return slopes;
}
fn steradian_ggx_edge_slopes(view: SteradianGgxView, a: vec3f, b: vec3f, smith: f32, nodes: i32, pieces: i32) -> SteradianEdgeSlopesOfBoth {
    let part = steradian_edge_above_horizon(a, b);
    return steradian_ggx_edge_slopes_of_part(view, part, steradian_ggx_edge(view, part.start, part.end), smith, nodes, pieces);
}
`;
