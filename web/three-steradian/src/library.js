// The topics math, polygon, lobe, round, phong, ltc, ltc_tables, ggx of dist/es, without their comments.
// Made by web/three-steradian/make_package.py.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
export const LIBRARY = `
float steradian_select(bool m, float a, float b) { return m ? a : b; }
vec2 steradian_select(bool m, vec2 a, vec2 b) { return m ? a : b; }
vec3 steradian_select(bool m, vec3 a, vec3 b) { return m ? a : b; }
vec4 steradian_select(bool m, vec4 a, vec4 b) { return m ? a : b; }
vec2 steradian_xy(vec3 v) { return v.xy; }
vec3 steradian_transform(mat3 m, vec3 v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
vec3 steradian_transform_transposed(mat3 m, vec3 v) { return vec3(dot(m[0], v), dot(m[1], v), dot(m[2], v)); }
float steradian_pi() { return 3.14159265358979324; }
float steradian_inverse_pi() { return 0.318309886183790672; }
float steradian_inverse_two_pi() { return 0.159154943091895336; }
bool steradian_mask_none() {
    float zero = 0.0;
    return zero > 0.0;
}
bool steradian_mask_all() { return !steradian_mask_none(); }
float steradian_smallest_square() { return 1.0e-36; }
float steradian_smallest_length() { return 1.0e-18; }
float steradian_smallest_divisor() { return 1.0e-30; }
vec2 steradian_complex_product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}
vec2 steradian_complex_quotient(vec2 a, vec2 b) {
    float scale = 1.0 / max(dot(b, b), steradian_smallest_square());
    return vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) * scale;
}
vec2 steradian_complex_sign(vec2 a) {
    return a * inversesqrt(max(dot(a, a), steradian_smallest_square()));
}
vec2 steradian_complex_unit(float x) {
    float y = 0.5 * x;
    float t = y * y;
    float c = 1.0;
    float s = 1.0;
    c = 1.0 - t * 0.0111111111111111111 * (1.0 - t * 0.00757575757575757576 * c);
    c = 1.0 - t * 0.0333333333333333333 * (1.0 - t * 0.0178571428571428571 * c);
    c = 1.0 - t * 0.5 * (1.0 - t * 0.0833333333333333333 * c);
    s = 1.0 - t * 0.0138888888888888889 * (1.0 - t * 0.00909090909090909091 * s);
    s = 1.0 - t * 0.05 * (1.0 - t * 0.0238095238095238095 * s);
    s = y * (1.0 - t * 0.166666666666666667 * s);
    return vec2(c * c - s * s, 2.0 * c * s);
}
mat3 steradian_frame_from_normal(vec3 n) {
    float s = steradian_select(n.z < 0.0, -1.0, 1.0);
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    vec3 x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 y = vec3(b, s + n.y * n.y * a, -n.y);
    return mat3(x, y, n);
}
mat3 steradian_frame_from_normal_and_view(vec3 n, vec3 v) {
    mat3 other = steradian_frame_from_normal(n);
    vec3 t = v - n * dot(n, v);
    float t2 = dot(t, t);
    vec3 x = steradian_select(t2 > 1.0e-12, t * inversesqrt(max(t2, 1.0e-12)), steradian_transform(other, vec3(1.0, 0.0, 0.0)));
    return mat3(x, cross(n, x), n);
}
vec2 steradian_gauss_legendre_node(int n, int j) {
    vec2 r = vec2(0.5, 0.0);
    if (n == 1) {
        if (j == 0) { r = vec2(0.5, 1.0); }
    }
    if (n == 2) {
        if (j == 0) { r = vec2(0.211324865405187118, 0.5); }
        if (j == 1) { r = vec2(0.788675134594812882, 0.5); }
    }
    if (n == 3) {
        if (j == 0) { r = vec2(0.112701665379258311, 0.277777777777777778); }
        if (j == 1) { r = vec2(0.5, 0.444444444444444444); }
        if (j == 2) { r = vec2(0.887298334620741689, 0.277777777777777778); }
    }
    if (n == 4) {
        if (j == 0) { r = vec2(0.069431844202973712, 0.173927422568726929); }
        if (j == 1) { r = vec2(0.330009478207571868, 0.326072577431273071); }
        if (j == 2) { r = vec2(0.669990521792428132, 0.326072577431273071); }
        if (j == 3) { r = vec2(0.930568155797026288, 0.173927422568726929); }
    }
    if (n == 5) {
        if (j == 0) { r = vec2(0.046910077030668004, 0.118463442528094544); }
        if (j == 1) { r = vec2(0.230765344947158454, 0.239314335249683234); }
        if (j == 2) { r = vec2(0.5, 0.284444444444444444); }
        if (j == 3) { r = vec2(0.769234655052841546, 0.239314335249683234); }
        if (j == 4) { r = vec2(0.953089922969331996, 0.118463442528094544); }
    }
    if (n == 6) {
        if (j == 0) { r = vec2(0.033765242898423986, 0.085662246189585173); }
        if (j == 1) { r = vec2(0.169395306766867743, 0.180380786524069304); }
        if (j == 2) { r = vec2(0.380690406958401546, 0.233956967286345524); }
        if (j == 3) { r = vec2(0.619309593041598454, 0.233956967286345524); }
        if (j == 4) { r = vec2(0.830604693233132257, 0.180380786524069304); }
        if (j == 5) { r = vec2(0.966234757101576014, 0.085662246189585173); }
    }
    if (n == 8) {
        if (j == 0) { r = vec2(0.019855071751231884, 0.05061426814518813); }
        if (j == 1) { r = vec2(0.10166676129318663, 0.111190517226687235); }
        if (j == 2) { r = vec2(0.237233795041835507, 0.156853322938943644); }
        if (j == 3) { r = vec2(0.408282678752175098, 0.181341891689180991); }
        if (j == 4) { r = vec2(0.591717321247824902, 0.181341891689180991); }
        if (j == 5) { r = vec2(0.762766204958164493, 0.156853322938943644); }
        if (j == 6) { r = vec2(0.89833323870681337, 0.111190517226687235); }
        if (j == 7) { r = vec2(0.980144928248768116, 0.05061426814518813); }
    }
    return r;
}
vec3 steradian_fan_place(vec3 centre, vec3 outward, float rim_cosine, float share) {
    float cosine = 1.0 - (1.0 - rim_cosine) * share;
    return centre * cosine + outward * sqrt(max(1.0 - cosine * cosine, 0.0));
}
vec2 steradian_trig_angle_over_sine_24_bits(float t) {
    float p = 0.01116282422619877;
    float d = p;
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
    return vec2(p, d);
}
float steradian_trig_atan_over_argument_24_bits(float q) {
    float p = 0.002766283501762026;
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
vec2 steradian_trig_angle_over_sine_acute_and_slope(float t) {
    return steradian_trig_angle_over_sine_24_bits(t);
}
float steradian_trig_angle_over_sine_acute(float t) {
    vec2 both = steradian_trig_angle_over_sine_acute_and_slope(t);
    return both.x;
}
float steradian_trig_angle_over_sine(float c, float s2) {
    float f = steradian_trig_angle_over_sine_acute(1.0 - abs(c));
    bool obtuse = c < 0.0;
    if (obtuse) {
        f = steradian_select(obtuse, steradian_pi() * inversesqrt(max(s2, steradian_smallest_divisor())) - f, f);
    }
    return f;
}
vec2 steradian_trig_angle_over_sine_and_slope(float c, float s2) {
    vec2 both = steradian_trig_angle_over_sine_acute_and_slope(1.0 - abs(c));
    bool obtuse = c < 0.0;
    if (obtuse) {
        float f = steradian_pi() * inversesqrt(max(s2, steradian_smallest_divisor())) - both.x;
        both = steradian_select(obtuse, vec2(f, (1.0 - c * min(f, 1.0e12)) / max(s2, 1.0e-12)), both);
    }
    return both;
}
float steradian_trig_atan2(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float larger = max(ax, ay);
    float t = min(ax, ay) / max(larger, 1.0e-37);
    float q = t * t;
    float p = steradian_trig_atan_over_argument_24_bits(q);
    float angle = t * p;
    angle = steradian_select(ay > ax, 0.5 * steradian_pi() - angle, angle);
    angle = steradian_select(x < 0.0, steradian_pi() - angle, angle);
    return steradian_select(y < 0.0, -angle, angle);
}
float steradian_trig_atan2_unwrapped(float y, float x) {
    float angle = steradian_trig_atan2(y, x);
    return steradian_select(angle < -0.5 * steradian_pi(), angle + 2.0 * steradian_pi(), angle);
}
struct SteradianQuarticPoles {
    vec2 z1;
    vec2 z2;
};
float steradian_quartic_third_cosine(float x) {
    float t = sqrt(max(0.5 + 0.5 * x, 0.0));
    float c = 0.5 + t * (0.577350269189625765 - 0.0773502691896257645 * t);
    for (int i = 0; i < 2; i++) {
        float c2 = c * c;
        c = c - (c * (4.0 * c2 - 3.0) - x) / max(12.0 * c2 - 3.0, 1.0e-6);
    }
    return c;
}
SteradianQuarticPoles steradian_quartic_poles_approximate(float c0, float c1, float c2, float c3) {
    float shift = 0.25 * c3;
    float shift2 = shift * shift;
    float p = c2 - 6.0 * shift2;
    float q = c1 - 2.0 * c2 * shift + 8.0 * shift2 * shift;
    float r = c0 - c1 * shift + c2 * shift2 - 3.0 * shift2 * shift2;
    float radius2 = max(p * p + 12.0 * r, 1.0e-12);
    float radius = sqrt(radius2);
    float cosine = clamp((p * (p * p - 36.0 * r) + 13.5 * q * q) / (radius2 * radius), -1.0, 1.0);
    float z = max(0.666666666666666667 * (radius * steradian_quartic_third_cosine(cosine) - p), 0.0);
    float s = sqrt(z);
    float sum = p + z;
    float root = sqrt(max(sum * sum - 4.0 * r, 0.0));
    float difference = steradian_select(z > 1.0e-3 * abs(p), q / max(s, steradian_smallest_length()), steradian_select(q < 0.0, -root, root));
    SteradianQuarticPoles poles;
    poles.z1 = vec2(-0.5 * s - shift, sqrt(max(0.5 * (sum - difference) - 0.25 * z, 1.0e-6)));
    poles.z2 = vec2(0.5 * s - shift, sqrt(max(0.5 * (sum + difference) - 0.25 * z, 1.0e-6)));
    return poles;
}
struct SteradianPolygonWalk {
    vec3 edges;
    vec2 horizon;
};
vec3 steradian_polygon_direction(vec3 v) {
    float d2 = dot(v, v);
    float scale = steradian_select(d2 < 1.0e36, inversesqrt(max(d2, steradian_smallest_square())), 0.0);
    return v * scale;
}
vec3 steradian_polygon_edge(vec3 a, vec3 b) {
    vec3 n = cross(a, b - a);
    float f = steradian_trig_angle_over_sine(dot(a, b), dot(n, n));
    return n * (0.5 * f);
}
SteradianPolygonWalk steradian_polygon_begin() {
    SteradianPolygonWalk walk;
    walk.edges = vec3(0.0, 0.0, 0.0);
    walk.horizon = vec2(1.0, 0.0);
    return walk;
}
struct SteradianEdgePart {
    vec3 start;
    vec3 end;
    float start_a;
    float start_b;
    float end_a;
    float end_b;
    bool rises;
    bool sinks;
};
SteradianEdgePart steradian_edge_whole(vec3 a, vec3 b) {
    SteradianEdgePart part;
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
SteradianEdgePart steradian_edge_above_horizon(vec3 a, vec3 b) {
    bool a_below = a.z < 0.0;
    bool b_below = b.z < 0.0;
    SteradianEdgePart part = steradian_edge_whole(a, b);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (a_below || b_below) {
        float wa = abs(b.z);
        float wb = abs(a.z);
        vec2 p = vec2(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
        float scale = inversesqrt(max(dot(p, p), steradian_smallest_square()));
        vec3 crossing = vec3(p.x * scale, p.y * scale, 0.0);
        part.start = steradian_select(a_below, crossing, a);
        part.end = steradian_select(b_below, crossing, b);  
        part.start_a = steradian_select(a_below, wa * scale, 1.0);
        part.start_b = steradian_select(a_below, wb * scale, 0.0);
        part.end_a = steradian_select(b_below, wa * scale, 0.0);
        part.end_b = steradian_select(b_below, wb * scale, 1.0);
    }
    return part;
}
SteradianPolygonWalk steradian_polygon_add_part(SteradianPolygonWalk walk, SteradianEdgePart part) {
    SteradianPolygonWalk next = walk;
    bool crosses = part.rises || part.sinks;
    if (crosses) {
        vec3 crossing = steradian_select(part.rises, part.start, part.end);
        float y = steradian_select(part.rises, crossing.y, -crossing.y);  
        vec2 h = walk.horizon;
        next.horizon = steradian_select(crosses, vec2(h.x * crossing.x - h.y * y, h.x * y + h.y * crossing.x), h);
    }
    next.edges = walk.edges + steradian_polygon_edge(part.start, part.end);
    return next;
}
SteradianPolygonWalk steradian_polygon_add_edge(SteradianPolygonWalk walk, vec3 a, vec3 b) {
    SteradianPolygonWalk next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        next = steradian_polygon_add_part(walk, steradian_edge_above_horizon(a, b));
    }
    return next;
}
vec3 steradian_polygon_irradiance_vector(SteradianPolygonWalk walk, bool reversed) {
    float facing = steradian_select(reversed, -1.0, 1.0);
    float arc = 0.0;
    if (abs(walk.horizon.y) > 0.0 || walk.horizon.x < 0.0) {
        arc = steradian_trig_atan2_unwrapped(facing * walk.horizon.y, walk.horizon.x);
    }
    vec3 e = walk.edges * facing;
    return vec3(e.x, e.y, clamp(e.z + 0.5 * arc, 0.0, steradian_pi()));
}
float steradian_polygon_irradiance(SteradianPolygonWalk walk, bool reversed) {
    vec3 e = steradian_polygon_irradiance_vector(walk, reversed);
    return e.z;
}
struct SteradianSolidAngleWalk {
    vec3 first;
    vec2 product;
};
SteradianSolidAngleWalk steradian_solid_angle_begin(vec3 first) {
    SteradianSolidAngleWalk walk;
    walk.first = first;
    walk.product = vec2(1.0, 0.0);
    return walk;
}
SteradianSolidAngleWalk steradian_solid_angle_add_edge(SteradianSolidAngleWalk walk, vec3 a, vec3 b) {
    SteradianSolidAngleWalk next = walk;
    float re = 1.0 + dot(walk.first, a) + dot(a, b) + dot(b, walk.first);
    float im = dot(walk.first, cross(a - walk.first, b - a));  
    float scale = inversesqrt(max(re * re + im * im, steradian_smallest_square()));
    re = re * scale;
    im = im * scale;
    vec2 p = walk.product;
    next.product = vec2(p.x * re - p.y * im, p.x * im + p.y * re);
    return next;
}
float steradian_solid_angle_finish(SteradianSolidAngleWalk walk, bool reversed) {
    float y = steradian_select(reversed, -walk.product.y, walk.product.y);
    return max(2.0 * steradian_trig_atan2_unwrapped(y, walk.product.x), 0.0);
}
struct SteradianHorizonClip {
    vec3 start;
    vec3 end;
    vec3 arc_start;
    vec3 arc_end;
    bool closes;
    vec3 leave;
    vec3 entry;
};
SteradianHorizonClip steradian_horizon_clip_begin() {
    vec3 nowhere = vec3(0.0, 0.0, 0.0);
    SteradianHorizonClip clip;
    clip.start = nowhere;
    clip.end = nowhere;
    clip.arc_start = nowhere;
    clip.arc_end = nowhere;
    clip.closes = steradian_mask_none();
    clip.leave = nowhere;
    clip.entry = nowhere;
    return clip;
}
vec3 steradian_horizon_crossing(vec3 a, vec3 b) {
    float wa = abs(b.z);
    float wb = abs(a.z);
    vec2 p = vec2(a.x * wa + b.x * wb, a.y * wa + b.y * wb);
    p = p * inversesqrt(max(dot(p, p), steradian_smallest_square()));
    return vec3(p.x, p.y, 0.0);
}
bool steradian_horizon_arc_wide(vec3 a, vec3 b) { return dot(a, b) < -0.9999; }
vec3 steradian_horizon_arc_middle(vec3 a, vec3 b, float facing) {
    float unsure = 1.0e-6;
    vec2 across = vec2(b.y - a.y, a.x - b.x) * facing;
    float turn = (a.x * b.y - a.y * b.x) * facing;
    across = across * (inversesqrt(max(dot(across, across), steradian_smallest_square())) * steradian_select(turn < -unsure, -1.0, 1.0));
    return vec3(across.x, across.y, 0.0);
}
SteradianHorizonClip steradian_horizon_clip_edge(SteradianHorizonClip clip, vec3 a, vec3 b) {
    SteradianHorizonClip next = clip;
    bool a_below = a.z < 0.0;
    bool b_below = b.z < 0.0;
    next.start = a;
    next.end = b;
    next.closes = steradian_mask_none();
    if (a_below || b_below) {
        vec3 nowhere = vec3(0.0, 0.0, 0.0);
        vec3 crossing = steradian_horizon_crossing(a, b);
        next.start = steradian_select(a_below, crossing, a);
        next.end = steradian_select(b_below, crossing, b);  
        bool comes_up = a_below && !b_below;
        bool goes_down = b_below && !a_below;
        bool was_left = dot(clip.leave, clip.leave) > 0.5;
        bool due = goes_down && was_left;
        next.closes = (comes_up && was_left) || due;
        next.arc_end = steradian_select(due, clip.entry, crossing);
        next.arc_start = steradian_select(next.closes, clip.leave, next.arc_end);
        next.leave = steradian_select(goes_down, crossing, steradian_select(comes_up, nowhere, clip.leave));
        next.entry = steradian_select(comes_up && !was_left, crossing, steradian_select(due, nowhere, clip.entry));
    }
    return next;
}
SteradianHorizonClip steradian_horizon_clip_finish(SteradianHorizonClip clip) {
    SteradianHorizonClip next = clip;
    next.closes = dot(clip.leave, clip.leave) > 0.5 && dot(clip.entry, clip.entry) > 0.5;
    next.start = clip.end;
    next.arc_start = steradian_select(next.closes, clip.leave, clip.entry);
    next.arc_end = clip.entry;
    return next;
}
float steradian_lambert_radiance(float irradiance) {
    return irradiance * steradian_inverse_pi();
}
float steradian_lambert_lobe(vec3 l) {
    return max(l.z, 0.0) * steradian_inverse_pi();
}
float steradian_lambert_grazing(vec3 l, vec3 v) {
    float x = 1.0 - sqrt(clamp(0.5 + 0.5 * dot(l, v), 0.0, 1.0));
    float x2 = x * x;
    return x2 * x2 * x;
}
float steradian_lambert_grazing_of_sky(float v_z) {
    float t = 1.0 - clamp(v_z, 0.0, 1.0);
    return 8.2571e-5 + t * (2.01647e-3 + t * (9.33829e-3 + t * (7.74731e-3 + t * 8.97984e-3)));
}
float steradian_lambert_grazing_of_light(vec3 e, vec3 v) {
    vec3 mean = e * inversesqrt(max(dot(e, e), steradian_smallest_square()));
    float in_mean = steradian_lambert_grazing(mean, v);
    float share = clamp(e.z * steradian_inverse_pi(), 0.0, 1.0);
    return in_mean + (steradian_lambert_grazing_of_sky(v.z) - in_mean) * share;
}
float steradian_lambert_irradiance_below(vec3 e, vec3 v, float loss) {
    return e.z * (1.0 - loss * steradian_lambert_grazing_of_light(e, v));
}
struct SteradianCharlieLobe {
    vec3 view;
    float exponent;
    float scale;
    float a;
    float b;
    float c;
    float d;
    float e;
    float middle;
    float masking;
};
float steradian_charlie_curve(SteradianCharlieLobe lobe, float x) {
    float power = exp(lobe.c * log(max(x, 1.0e-9)));
    return lobe.a / (1.0 + lobe.b * power) + lobe.d * x + lobe.e;
}
float steradian_charlie_lambda(SteradianCharlieLobe lobe, float cosine) {
    float x = clamp(cosine, 0.0, 1.0);
    bool steep = x > 0.5;
    float curve = steradian_charlie_curve(lobe, steradian_select(steep, 1.0 - x, x));
    return exp(steradian_select(steep, 2.0 * lobe.middle - curve, curve));
}
SteradianCharlieLobe steradian_charlie_prepare(vec3 v, float alpha) {
    float width = clamp(alpha, 0.04, 1.0);
    float t = (1.0 - width) * (1.0 - width);
    SteradianCharlieLobe lobe;
    lobe.view = v;
    lobe.exponent = 0.5 / width;
    lobe.scale = steradian_select(v.z > 0.0, (2.0 + 1.0 / width) * 0.0397887357729738339 / max(v.z, 1.0e-6), 0.0);
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
float steradian_charlie_lobe(SteradianCharlieLobe lobe, vec3 l) {
    vec3 h = l + lobe.view;
    float across = h.x * h.x + h.y * h.y;
    float sine2 = across / max(across + h.z * h.z, steradian_smallest_divisor());
    float power = exp(lobe.exponent * log(clamp(sine2, steradian_smallest_divisor(), 1.0)));
    float shadowed = lobe.scale * power / (lobe.masking + steradian_charlie_lambda(lobe, l.z));
    return steradian_select(l.z > 0.0, shadowed, 0.0);
}
struct SteradianCosineLobe {
    vec3 axis;
    float exponent;
    float scale;
};
struct SteradianStretchedLobe {
    mat3 frame;
    vec3 stretch;  
    float exponent;
    float scale;
};
struct SteradianLobeProduct {
    mat3 about;
    float total;
    float log_scale;
    vec2 slope;
    vec3 curvature;
    float lowest;
};
SteradianLobeProduct steradian_lobe_product_begin(vec3 direction) {
    SteradianLobeProduct p;
    p.about = steradian_frame_from_normal(direction);
    p.total = 0.0;
    p.log_scale = 0.0;
    p.slope = vec2(0.0, 0.0);
    p.curvature = vec3(0.0, 0.0, 0.0);
    p.lowest = 1.0;
    return p;
}
SteradianLobeProduct steradian_lobe_product_add(SteradianLobeProduct p, vec3 r, float n) {
    vec3 local = steradian_transform_transposed(p.about, r);
    float z = max(local.z, 1.0e-4);
    float x = local.x / z;
    float y = local.y / z;
    SteradianLobeProduct next = p;
    next.total = p.total + n;
    next.log_scale = p.log_scale + n * log(z);
    next.slope = p.slope + vec2(n * x, n * y);
    next.curvature = p.curvature + vec3(n * x * x, n * x * y, n * y * y);
    next.lowest = min(p.lowest, local.z);
    return next;
}
vec3 steradian_lobe_product_newton(SteradianLobeProduct p) {
    float xx = p.total + p.curvature.x;
    float yy = p.total + p.curvature.z;
    float xy = p.curvature.y;
    float inverse = 1.0 / max(xx * yy - xy * xy, steradian_smallest_divisor());
    vec3 step_to = vec3(inverse * (yy * p.slope.x - xy * p.slope.y), inverse * (xx * p.slope.y - xy * p.slope.x), 1.0);
    vec3 u = steradian_transform(p.about, step_to);
    return u * inversesqrt(dot(u, u));
}
float steradian_lobe_product_scale(SteradianLobeProduct p) {
    return steradian_select(p.lowest > 1.0e-4, exp(p.log_scale), 0.0);
}
SteradianCosineLobe steradian_lobe_product_isotropic(SteradianLobeProduct p) {
    float xx = p.total + p.curvature.x;
    float yy = p.total + p.curvature.z;
    SteradianCosineLobe lobe;
    lobe.axis = steradian_transform(p.about, vec3(0.0, 0.0, 1.0));
    lobe.exponent = sqrt(max(xx * yy - p.curvature.y * p.curvature.y, 0.0));
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}
SteradianStretchedLobe steradian_lobe_product_anisotropic(SteradianLobeProduct p) {
    float xx = p.total + p.curvature.x + 3.0;
    float yy = p.total + p.curvature.z + 3.0;
    float xy = p.curvature.y;
    float d = sqrt(max(xx * yy - xy * xy, steradian_smallest_divisor()));
    float root = inversesqrt((xx + yy) / d + 2.0);
    SteradianStretchedLobe lobe;
    lobe.frame = p.about;
    lobe.stretch = vec3(root * (xx / d + 1.0), root * xy / d, root * (yy / d + 1.0));
    lobe.exponent = d - 3.0;
    lobe.scale = steradian_lobe_product_scale(p);
    return lobe;
}
vec3 steradian_lobe_product_stretch(SteradianStretchedLobe lobe, vec3 u) {
    vec3 l = steradian_transform_transposed(lobe.frame, u);
    return vec3(lobe.stretch.x * l.x + lobe.stretch.y * l.y, lobe.stretch.y * l.x + lobe.stretch.z * l.y, l.z);
}
vec3 steradian_lobe_product_peak_of_two(vec3 r1, float n1, vec3 r2, float n2) {
    float cosine = max(dot(r1, r2), 1.0e-6);
    vec3 across = r2 - r1 * dot(r1, r2);
    float sine2 = dot(across, across);
    float tangent = sqrt(sine2) / cosine;
    float sum = n1 + n2;
    float t = 2.0 * n2 * tangent / (sum + sqrt(sum * sum + 4.0 * n1 * n2 * tangent * tangent));
    vec3 u = r1 + across * (t * inversesqrt(max(sine2, steradian_smallest_divisor())));
    return u * inversesqrt(dot(u, u));
}
vec3 steradian_microfacet_half_vector(vec3 l, vec3 v) {
    vec3 h = l + v;
    return h * inversesqrt(max(dot(h, h), steradian_smallest_square()));
}
float steradian_ggx_distribution(vec3 h, float ax, float ay) {
    float x = h.x / ax;
    float y = h.y / ay;
    float d = max(x * x + y * y + h.z * h.z, 1.0e-6);
    return steradian_inverse_pi() / (ax * ay * d * d);
}
float steradian_ggx_stretched_length(vec3 w, float ax, float ay) {
    float x = ax * w.x;
    float y = ay * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}
float steradian_ggx_shadowing(vec3 l, vec3 v, float ax, float ay) {
    float lz = max(l.z, 0.0);
    float vz = max(v.z, 0.0);
    float d = lz * steradian_ggx_stretched_length(v, ax, ay) + vz * steradian_ggx_stretched_length(l, ax, ay);
    return 2.0 * lz * vz / max(d, steradian_smallest_square());
}
float steradian_fresnel_schlick(float f0, float f90, float v_dot_h) {
    float x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}
float steradian_beckmann_distribution(vec3 h, float ax, float ay) {
    float hz = max(h.z, 1.0e-5);
    float x = h.x / (ax * hz);
    float y = h.y / (ay * hz);
    float z2 = hz * hz;
    return steradian_inverse_pi() * exp(-(x * x + y * y)) / (ax * ay * z2 * z2);
}
float steradian_microfacet_lobe_unshadowed(float d, vec3 l, vec3 v) {
    bool above = l.z > 0.0 && v.z > 0.0;
    return steradian_select(above, d / (4.0 * max(v.z, 1.0e-6)), 0.0);
}
float steradian_ggx_lobe(vec3 l, vec3 v, float ax, float ay) {
    vec3 h = steradian_microfacet_half_vector(l, v);
    float g = steradian_ggx_shadowing(l, v, ax, ay);
    return steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, ax, ay) * g, l, v);
}
float steradian_phong_log(float x) {
    float near = 0.75;
    float result = log(x);
    bool high = x > near;
    if (high) {
        float d = x - 1.0;
        float t = d / (2.0 + d);
        float t2 = t * t;
        float series = d - t * (d - t2 * (0.666666666666666667 + t2 * (0.4 + t2 * 0.285714285714285714)));
        result = steradian_select(high, series, result);
    }
    return result;
}
float steradian_phong_power(float x, float n) {
    return exp(n * steradian_phong_log(max(x, steradian_smallest_divisor())));
}
vec3 steradian_phong_mirror(vec3 v) {
    return vec3(-v.x, -v.y, v.z);
}
float steradian_phong_lobe(vec3 l, vec3 r, float n) {
    return (n + 1.0) * steradian_inverse_two_pi() * steradian_phong_power(dot(l, r), n);
}
float steradian_blinn_phong_distribution(vec3 h, float n) {
    return (n + 2.0) * steradian_inverse_two_pi() * steradian_phong_power(h.z, n);
}
struct SteradianLightElements {
    vec3 center;
    vec3 reach_a;
    vec3 reach_b;
    vec3 area;
};
struct SteradianLightElement {
    vec3 direction;
    float solid_angle;
};
SteradianLightElement steradian_light_element_at(SteradianLightElements e, int i) {
    float side = float(1 - 2 * (i / 2));
    vec3 r = e.center + e.reach_a * side;
    if (i == 1 || i == 3) {
        r = e.center + e.reach_b * side;
    }
    float inverse = inversesqrt(max(dot(r, r), steradian_smallest_square()));
    SteradianLightElement element;
    element.direction = r * inverse;
    float quarter = max(-0.25 * dot(e.area, element.direction), 0.0);
    element.solid_angle = (quarter * inverse) * inverse;
    return element;
}
float steradian_light_elements_diffuse_sharpness() { return 2.5; }
float steradian_light_elements_sharpness(float deviation) {
    return steradian_light_elements_diffuse_sharpness() + 1.0 / max(deviation, 1.0e-12);
}
float steradian_light_elements_half_vector_sharpness(float deviation, float view_z) {
    return steradian_light_elements_sharpness(2.0 * deviation * max(view_z, 1.0e-6));
}
float steradian_light_elements_power_sharpness(float n) {
    return steradian_light_elements_diffuse_sharpness() + sqrt(n);
}
struct SteradianLightElementsLimits {
    float roundings;
    float least_distance2;
    float bias;
};
SteradianLightElementsLimits steradian_light_elements_limits(float roundings, float least_distance2, float bias) {
    SteradianLightElementsLimits limits;
    limits.roundings = roundings;
    limits.least_distance2 = least_distance2;
    limits.bias = bias;
    return limits;
}
SteradianLightElementsLimits steradian_light_elements_along_edges() { return steradian_light_elements_limits(2.0, 4000.0, 0.0); }
SteradianLightElementsLimits steradian_light_elements_transformed() { return steradian_light_elements_limits(8.0, 2000.0, 0.0); }
SteradianLightElementsLimits steradian_light_elements_along_arcs() { return steradian_light_elements_limits(128.0, 500.0, 0.0); }
SteradianLightElementsLimits steradian_light_elements_along_half_vectors(float bias) { return steradian_light_elements_limits(128.0, 30.0, bias); }
SteradianLightElementsLimits steradian_light_elements_along_power(float n, float bias) {
    float sharpness = steradian_light_elements_power_sharpness(n);
    return steradian_light_elements_limits(128.0, steradian_select(bias > 0.0, min(500.0, 4.0 * sharpness * sharpness), 500.0), bias);
}
float steradian_light_elements_series_bias() { return 0.015625; }
float steradian_light_elements_series_high_bias() { return 0.008695652173913044; }
float steradian_light_elements_beckmann_bias() { return 0.005; }
bool steradian_light_elements_serve(SteradianLightElements e, vec3 normal, float sharpness, float roundings, float bias) {
    float unit = 6.0e-8;
    float inverse = inversesqrt(max(dot(e.center, e.center), steradian_smallest_square()));
    vec3 a = e.reach_a * inverse;
    vec3 b = e.reach_b * inverse;
    float deviation2 = 0.5 * (dot(a, a) + dot(b, b));
    float deviation = sqrt(deviation2);
    float t = min(deviation * sharpness, 1.0e6);
    float bound = 0.125 * t * t * t;
    bool better = bound < bias || bound * deviation < roundings * unit;
    bool whole = dot(e.center, normal) * inverse > 2.0 * (abs(dot(a, normal)) + abs(dot(b, normal)));
    return better && (whole || deviation2 < 8.0 * unit);
}
vec3 steradian_light_elements_irradiance_vector(SteradianLightElements e) {
    vec3 nowhere = vec3(0.0, 0.0, 0.0);
    vec3 sum = nowhere;
    for (int i = 0; i < 4; i++) {
        SteradianLightElement element = steradian_light_element_at(e, i);
        sum = sum + steradian_select(element.direction.z > 0.0, element.direction * element.solid_angle, nowhere);
    }
    return sum;
}
struct SteradianConicArc {
    vec3 u0;
    vec3 u1;
    vec3 u2;
    float begin;
    float end;
    float scale;
    vec2 z1;
    vec2 z2;
    vec2 sweep;
};
vec2 steradian_conic_slope(vec2 z, vec2 o, float d4) {
    float x = z.x - o.x;
    float y2 = (z.y - o.y) * (z.y + o.y);
    float s = 2.0 * d4 * z.y;
    return vec2(-2.0 * x * z.y, x * x - y2) * s;
}
vec2 steradian_conic_pole_step(SteradianConicArc arc, vec2 z, vec2 o, float d4) {
    vec3 re = arc.u0 + arc.u1 * z.x + arc.u2 * (z.x * z.x - z.y * z.y);
    vec3 im = (arc.u1 + arc.u2 * (2.0 * z.x)) * z.y;
    vec2 value = vec2(dot(re - im, re + im), 2.0 * dot(re, im));
    vec2 step = steradian_complex_quotient(value, steradian_conic_slope(z, o, d4));
    vec2 apart = z - o;
    float apart2 = dot(apart, apart);
    float longest = 0.5 * sqrt(apart2) + z.y;
    step = step * min(longest * inversesqrt(max(dot(step, step), steradian_smallest_divisor())), 1.0);
    bool free = apart2 > 1.0e-12 * (1.0 + dot(z, z));
    vec2 next = z - steradian_select(free, step, vec2(0.0, 0.0));
    return vec2(next.x, max(abs(next.y), 1.0e-9));
}
SteradianQuarticPoles steradian_conic_polish_poles(SteradianConicArc arc, SteradianQuarticPoles start) {
    SteradianQuarticPoles poles = start;
    float d4 = dot(arc.u2, arc.u2);
    int sweeps = 16;
    float tolerance = 1.0e-6;
    bool moving = arc.end > arc.begin;
    for (int i = 0; i < sweeps; i++) {
        bool moves = steradian_mask_none();
        for (int k = 0; k < 2; k++) {
            vec2 z = steradian_conic_pole_step(arc, poles.z1, poles.z2, d4);
            vec2 step = z - poles.z1;
            moves = moves || dot(step, step) > tolerance * z.y * z.y;
            z = steradian_select(moving, z, poles.z1);
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
float steradian_conic_sweep(vec2 z, float begin, float end) {
    return steradian_trig_atan2_unwrapped(z.y * (end - begin), z.y * z.y + (begin - z.x) * (end - z.x));
}
SteradianConicArc steradian_conic_scaled(vec3 u0, vec3 u1, vec3 u2, float begin, float end) {
    float least = 1.0e-12;
    float d0 = max(dot(u0, u0), steradian_smallest_divisor());
    float d4 = dot(u2, u2);
    float ratio = sqrt(d0 / max(d4, least * d0));
    SteradianConicArc arc;
    arc.scale = sqrt(ratio);
    arc.u0 = u0;
    arc.u1 = u1 * arc.scale;
    arc.u2 = steradian_select(d4 > least * d0, u2, u0 * sqrt(least)) * ratio;
    arc.begin = begin / arc.scale;
    arc.end = end / arc.scale;
    arc.z1 = vec2(0.0, 1.0);
    arc.z2 = vec2(0.0, 1.0);
    arc.sweep = vec2(0.0, 0.0);
    return arc;
}
SteradianQuarticPoles steradian_conic_poles(SteradianConicArc arc) {
    float inverse = 1.0 / max(dot(arc.u2, arc.u2), steradian_smallest_divisor());
    SteradianQuarticPoles poles = steradian_quartic_poles_approximate(
        dot(arc.u0, arc.u0) * inverse, 2.0 * dot(arc.u0, arc.u1) * inverse,
        (dot(arc.u1, arc.u1) + 2.0 * dot(arc.u0, arc.u2)) * inverse, 2.0 * dot(arc.u1, arc.u2) * inverse);
    return steradian_conic_polish_poles(arc, poles);
}
SteradianConicArc steradian_conic_with_poles(SteradianConicArc scaled, SteradianQuarticPoles poles) {
    SteradianConicArc arc = scaled;
    arc.z1 = poles.z1;
    arc.z2 = poles.z2;
    arc.sweep = vec2(steradian_conic_sweep(arc.z1, arc.begin, arc.end), steradian_conic_sweep(arc.z2, arc.begin, arc.end));
    return arc;
}
SteradianConicArc steradian_conic_prepare(vec3 u0, vec3 u1, vec3 u2, float begin, float end) {
    SteradianConicArc arc = steradian_conic_scaled(u0, u1, u2, begin, end);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}
struct SteradianConicNode {
    float tau;
    float density;
};
SteradianConicNode steradian_conic_node(SteradianConicArc arc, float share) {
    float p1 = arc.z1.x;
    float p2 = arc.z2.x;
    float b1 = arc.z1.y;
    float b2 = arc.z2.y;
    vec2 start = steradian_complex_product(vec2(b1, arc.begin - p1), vec2(b2, arc.begin - p2));
    float total = arc.sweep.x + arc.sweep.y;
    vec2 turned = steradian_complex_product(steradian_complex_sign(start), -steradian_complex_unit(share * total - steradian_pi()));
    float s = turned.y;
    float c = turned.x;
    float linear_term = c * (b1 + b2) - s * (p1 + p2);
    float constant_term = s * p1 * p2 - c * (b1 * p2 + b2 * p1) - s * b1 * b2;
    float root = sqrt(max(linear_term * linear_term - 4.0 * s * constant_term, 0.0));
    bool positive = linear_term >= 0.0;
    float top = steradian_select(positive, -2.0 * constant_term, root - linear_term);
    float bottom = steradian_select(positive, linear_term + root, 2.0 * s);
    bool usable = abs(bottom) > steradian_smallest_divisor();
    float tau = steradian_select(usable, top / steradian_select(usable, bottom, 1.0), arc.begin);
    SteradianConicNode node;
    node.tau = clamp(tau, arc.begin, arc.end);
    float x1 = node.tau - p1;
    float x2 = node.tau - p2;
    node.density = b1 / (x1 * x1 + b1 * b1) + b2 / (x2 * x2 + b2 * b2);
    return node;
}
vec3 steradian_conic_residue(SteradianConicArc arc, vec2 z, vec2 o, float sweep) {
    vec3 n0 = cross(arc.u0, arc.u1);
    vec3 n1 = cross(arc.u0, arc.u2) * 2.0;
    vec3 n2 = cross(arc.u1, arc.u2);
    vec3 re = n0 + n1 * z.x + n2 * (z.x * z.x - z.y * z.y);
    vec3 im = (n1 + n2 * (2.0 * z.x)) * z.y;
    float x0 = arc.begin - z.x;
    float x1 = arc.end - z.x;
    float y2 = z.y * z.y;
    vec2 logarithm = vec2(0.5 * log((x1 * x1 + y2) / (x0 * x0 + y2)), sweep);
    vec2 factor = steradian_complex_quotient(logarithm, steradian_conic_slope(z, o, dot(arc.u2, arc.u2)));
    return re * factor.x - im * factor.y;
}
vec3 steradian_conic_vector_approximate(SteradianConicArc arc, bool wanted) {
    vec3 sum = vec3(0.0, 0.0, 0.0);
    float total = arc.sweep.x + arc.sweep.y;
    for (int i = 0; i < 16; i++) {
        if (!wanted) {
            break;
        }
        int part = i / 8;
        vec2 rule = steradian_gauss_legendre_node(8, i - 8 * part);
        SteradianConicNode node = steradian_conic_node(arc, 0.5 * (rule.x + float(part)));
        vec3 u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
        vec3 du = arc.u1 + arc.u2 * (2.0 * node.tau);
        sum = sum + cross(u, du) * (0.25 * rule.y * total / (node.density * max(dot(u, u), steradian_smallest_divisor())));
    }
    return sum;
}
vec3 steradian_conic_vector(SteradianConicArc arc) {
    vec3 e = steradian_conic_residue(arc, arc.z1, arc.z2, arc.sweep.x) + steradian_conic_residue(arc, arc.z2, arc.z1, arc.sweep.y);
    float close = 1.0e-2;
    vec2 apart = arc.z1 - arc.z2;
    bool meet = dot(apart, apart) < close * arc.z1.y * arc.z2.y && arc.end > arc.begin;
    if (meet) {
        e = steradian_select(meet, steradian_conic_vector_approximate(arc, meet), e);
    }
    return e;
}
struct SteradianEllipse {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
};
SteradianEllipse steradian_ellipse_prepare(vec3 center, vec3 axis_a, vec3 axis_b) {
    SteradianEllipse e;
    e.center = center;
    e.axis_a = axis_a;
    bool reversed = dot(center, cross(axis_a, axis_b)) < 0.0;
    e.axis_b = steradian_select(reversed, -axis_b, axis_b);
    return e;
}
SteradianEllipse steradian_ellipse_in_units(mat3 frame, vec3 center, vec3 axis_a, vec3 axis_b) {
    float size2 = dot(center, center) + dot(axis_a, axis_a) + dot(axis_b, axis_b);
    float unit = inversesqrt(max(size2, steradian_smallest_divisor()));
    return steradian_ellipse_prepare(steradian_transform_transposed(frame, center) * unit, steradian_transform_transposed(frame, axis_a) * unit,
                           steradian_transform_transposed(frame, axis_b) * unit);
}
SteradianLightElements steradian_ellipse_elements(SteradianEllipse e) {
    SteradianLightElements elements;
    elements.center = e.center;
    elements.reach_a = e.axis_a * 0.707106781186547524;
    elements.reach_b = e.axis_b * 0.707106781186547524;
    elements.area = cross(e.axis_b, e.axis_a) * steradian_pi();
    return elements;
}
SteradianConicArc steradian_ellipse_arc(SteradianEllipse e, float begin, float end) {
    return steradian_conic_prepare(e.center + e.axis_a, e.axis_b * 2.0, e.center - e.axis_a, begin, end);
}
vec3 steradian_ellipse_irradiance_vector(SteradianEllipse e) {
    vec2 up = vec2(e.axis_a.z, e.axis_b.z);
    float rise = sqrt(dot(up, up));
    vec2 turn = steradian_select(rise > steradian_smallest_divisor(), up * (1.0 / max(rise, steradian_smallest_divisor())), vec2(1.0, 0.0));
    SteradianEllipse level;
    level.center = e.center;
    level.axis_a = e.axis_a * turn.x + e.axis_b * turn.y;
    level.axis_b = e.axis_b * turn.x - e.axis_a * turn.y;
    float top = e.center.z + rise;
    float bottom = rise - e.center.z;
    bool shows = top > 0.0;
    bool cut = bottom > 0.0 && shows;
    float limit = sqrt(max(top, 0.0) / max(bottom, steradian_smallest_divisor()));
    limit = steradian_select(cut, limit, steradian_select(shows, 1.0e15, 0.0));
    bool more = limit > 1.0;
    float lower = steradian_select(more, 1.0 / max(limit, 1.0), 1.0);
    lower = steradian_select(limit > 1.0e14, 0.0, lower);
    SteradianEllipse turned = level;
    float begin = -min(limit, 1.0);
    float end = min(limit, 1.0);
    vec3 sum = vec3(0.0, 0.0, 0.0);
    vec3 far_side = sum;
    for (int i = 0; i < 3; i++) {
        vec3 arc = steradian_conic_vector(steradian_ellipse_arc(turned, begin, end));
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
    sum = steradian_select(more, sum + far_side, sum);
    if (cut) {
        float inverse = 1.0 / (1.0 + limit * limit);
        vec3 middle = level.center + level.axis_a * ((1.0 - limit * limit) * inverse);
        vec3 aside = level.axis_b * (2.0 * limit * inverse);
        vec3 down = middle + aside;
        vec3 back_up = middle - aside;
        float angle = steradian_trig_atan2(down.x * back_up.y - down.y * back_up.x, down.x * back_up.x + down.y * back_up.y);
        sum = steradian_select(cut, sum + vec3(0.0, 0.0, 0.5 * angle), sum);
    }
    float least = 1.0e-12;
    float size = sqrt(dot(e.center, e.center)) * sqrt(dot(e.axis_a, e.axis_a)) * sqrt(dot(e.axis_b, e.axis_b));
    bool seen = dot(e.center, cross(e.axis_a, e.axis_b)) > least * size;
    return vec3(steradian_select(seen, sum.x, 0.0), steradian_select(seen, sum.y, 0.0), steradian_select(seen, clamp(sum.z, 0.0, steradian_pi()), 0.0));
}
vec3 steradian_ellipse_whole_irradiance_vector(SteradianEllipse e) {
    vec3 normal = cross(e.axis_a, e.axis_b);
    vec3 across_a = cross(e.center, e.axis_a);
    vec3 across_b = cross(e.center, e.axis_b);
    float c2 = dot(e.center, e.center);
    float det = dot(e.center, normal);
    float det2 = det * det;
    float t = dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b) - c2;
    float s = dot(normal, normal) - dot(across_a, across_a) - dot(across_b, across_b);
    float tolerance = 1.0e-7;
    float nu = c2;
    bool moving = steradian_mask_all();  
    for (int i = 0; i < 24; i++) {
        float step = (((nu + t) * nu + s) * nu - det2) / max((3.0 * nu + 2.0 * t) * nu + s, steradian_smallest_divisor());
        float next = clamp(nu - step, 0.0, nu);
        bool still_moving = moving && nu - next > tolerance * nu;
        nu = steradian_select(moving, next, nu);
        moving = still_moving;
        if (!moving) {
            break;
        }
    }
    vec3 axis = e.center * (nu * nu) + (cross(e.axis_a, across_a) + cross(e.axis_b, across_b)) * nu + normal * det;
    float length2 = max(dot(axis, axis), steradian_smallest_square());
    float p = length2 / max(dot(axis, e.center), steradian_smallest_divisor());
    return axis * (steradian_pi() * det * inversesqrt(max(length2 * nu * p, steradian_smallest_square())));
}
struct SteradianEllipseFan {
    SteradianEllipse ellipse;
    vec2 turn;
    float beta;
    bool near;
    vec2 near_turn;
    float near_beta;
};
SteradianEllipseFan steradian_ellipse_fan(SteradianEllipse e) {
    SteradianEllipseFan fan;
    fan.ellipse = e;
    fan.turn = vec2(1.0, 0.0);
    fan.beta = 1.0;
    fan.near = steradian_mask_none();
    fan.near_turn = vec2(1.0, 0.0);
    fan.near_beta = 1.0;
    return fan;
}
vec3 steradian_ellipse_rim(SteradianEllipse e, vec2 turn) { return e.center + e.axis_a * turn.x + e.axis_b * turn.y; }
vec2 steradian_ellipse_nearest(SteradianEllipse e) {
    vec2 nearest = vec2(1.0, 0.0);
    vec3 rim = steradian_ellipse_rim(e, nearest);
    float least = dot(rim, rim);
    for (int k = 1; k < 8; k++) {
        vec2 turn = steradian_complex_unit(0.25 * steradian_pi() * float(k - 8 * (k / 5)));
        rim = steradian_ellipse_rim(e, turn);
        float distance2 = dot(rim, rim);
        nearest = steradian_select(distance2 < least, turn, nearest);
        least = min(distance2, least);
    }
    for (int i = 0; i < 4; i++) {
        rim = steradian_ellipse_rim(e, nearest);
        vec3 tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        float slope = dot(rim, tangent);
        float curvature = dot(tangent, tangent) - dot(rim, rim - e.center);
        float step = -slope / max(abs(curvature), 1.0e-3 * dot(tangent, tangent) + steradian_smallest_divisor());
        nearest = steradian_complex_product(nearest, steradian_complex_unit(clamp(step, -0.4, 0.4)));
    }
    return nearest;
}
SteradianEllipseFan steradian_ellipse_fan_near(SteradianEllipseFan usual) {
    SteradianEllipse e = usual.ellipse;
    SteradianEllipseFan fan = usual;
    bool may_be = dot(e.center, e.center) < 2.25 * (dot(e.axis_a, e.axis_a) + dot(e.axis_b, e.axis_b));
    if (may_be) {
        vec2 nearest = steradian_ellipse_nearest(e);
        vec3 rim = steradian_ellipse_rim(e, nearest);
        vec3 opposite = steradian_ellipse_rim(e, -nearest);
        vec3 tangent = e.axis_b * nearest.x - e.axis_a * nearest.y;
        float distance2 = dot(rim, rim);
        fan.near = may_be && distance2 < 0.04 * dot(opposite, opposite);
        fan.near_turn = nearest;
        fan.near_beta = clamp(0.5 * sqrt(distance2 / max(dot(tangent, tangent), steradian_smallest_divisor())), 1.0e-6, 1.0);
    }
    return fan;
}
SteradianEllipseFan steradian_ellipse_fan_concentrated(SteradianEllipse e, vec3 r, float width) {
    vec3 normal = cross(e.axis_a, e.axis_b);
    float n2 = max(dot(normal, normal), steradian_smallest_divisor());
    float height = dot(e.center, normal);  
    float along = dot(r, normal);
    vec3 across = r * height - e.center * along;
    vec2 place = vec2(dot(across, cross(e.axis_b, normal)), dot(across, cross(normal, e.axis_a))) * (1.0 / n2);
    float size2 = dot(place, place);
    bool off_centre = size2 > 1.0e-20;
    SteradianEllipseFan fan = steradian_ellipse_fan(e);
    fan.turn = steradian_select(off_centre, place * inversesqrt(max(size2, 1.0e-20)), vec2(1.0, 0.0));
    vec3 rim = e.center + e.axis_a * fan.turn.x + e.axis_b * fan.turn.y;
    vec3 tangent = e.axis_b * fan.turn.x - e.axis_a * fan.turn.y;
    float reach = min(sqrt(size2) / max(along, 1.0e-12), 1.0e6);
    float blur = 1.6 * width * sqrt(dot(rim, rim) / max(dot(tangent, tangent), steradian_smallest_divisor()));
    float beta = sqrt(0.5 * (1.0 - reach) * (1.0 - reach) + min(blur * blur, 1.0e6));
    fan.beta = steradian_select(along > 0.0, clamp(beta, 0.05, 1.0), 1.0);
    return steradian_ellipse_fan_near(fan);
}
vec2 steradian_ellipse_near_place(SteradianEllipseFan fan, float x) {
    float power = exp(x);
    return steradian_complex_sign(vec2(1.0, 0.5 * fan.near_beta * (power - 1.0 / power)));
}
float steradian_ellipse_near_share(SteradianEllipseFan fan, float x, vec2 lobe, float reach) {
    vec2 w = steradian_ellipse_near_place(fan, x);
    vec2 from_lobe = vec2(w.x * lobe.x + w.y * lobe.y, (w.y * lobe.x - w.x * lobe.y) / fan.beta);
    vec2 start = vec2(-lobe.y, -lobe.x / fan.beta);  
    float angle = steradian_trig_atan2_unwrapped(start.x * from_lobe.y - start.y * from_lobe.x, start.x * from_lobe.x + start.y * from_lobe.y);
    return 0.5 * (angle * steradian_inverse_pi() + clamp(0.5 + 0.5 * x / reach, 0.0, 1.0));
}
vec2 steradian_ellipse_near_corner(SteradianEllipseFan fan, int k, int count) {
    float far_side = 4.0 / fan.near_beta;
    float reach = log(far_side + sqrt(far_side * far_side + 1.0));
    vec2 apart = vec2(fan.turn.x * fan.near_turn.x + fan.turn.y * fan.near_turn.y, fan.turn.y * fan.near_turn.x - fan.turn.x * fan.near_turn.y);
    vec2 lobe = vec2(1.0 + apart.x, apart.y);
    lobe = steradian_select(dot(lobe, lobe) > 1.0e-10, steradian_complex_sign(lobe), vec2(0.0, 1.0));
    int turn = k / count;  
    if (k < 0) {
        turn = -1;
    }
    float share = (float(k - turn * count) + 0.5) / float(count);
    float low = -reach - 3.0;
    float high = reach + 3.0;
    float low_share = 0.0;
    float high_share = 1.0;
    for (int i = 0; i < 8; i++) {
        float middle = 0.5 * (low + high);
        float value = steradian_ellipse_near_share(fan, middle, lobe, reach);
        bool below = value < share;
        low = steradian_select(below, middle, low);
        low_share = steradian_select(below, value, low_share);
        high = steradian_select(below, high, middle);
        high_share = steradian_select(below, high_share, value);
    }
    float rest = clamp((share - low_share) / max(high_share - low_share, 1.0e-6), 0.0, 1.0);
    return steradian_ellipse_near_place(fan, low + rest * (high - low));
}
vec2 steradian_ellipse_corner(SteradianEllipseFan fan, int k, int count) {
    float half_angle = steradian_pi() * (float(k) / float(count) - 0.5);
    vec2 u = steradian_complex_unit(half_angle);
    vec2 w = steradian_complex_sign(vec2(u.x, fan.beta * u.y));
    vec2 corner = steradian_complex_product(steradian_complex_product(w, w), fan.turn);
    if (fan.near) {
        w = steradian_ellipse_near_corner(fan, k, count);
        corner = steradian_select(fan.near, steradian_complex_product(steradian_complex_product(w, w), fan.near_turn), corner);
    }
    return corner;
}
float steradian_ellipse_gap(vec2 from_corner, vec2 to_corner) {
    float c = dot(from_corner, to_corner);
    float s = from_corner.x * to_corner.y - from_corner.y * to_corner.x;
    float angle = steradian_trig_atan2_unwrapped(s, c);
    angle = clamp(angle, 0.0, 2.6);
    float sine = steradian_select(c > -0.856888753368947234 && s > 0.0, s, 0.515501371821464235);
    return steradian_select(angle < 1.0e-3, 1.0, angle / max(sine, 1.0e-4));
}
vec3 steradian_ellipse_corner_between(SteradianEllipseFan fan, vec2 here, float gaps) {
    float radius = sqrt(0.5 * gaps);
    SteradianEllipse e = fan.ellipse;
    return e.center + (e.axis_a * here.x + e.axis_b * here.y) * radius;
}
vec3 steradian_ellipse_pushed_corner(SteradianEllipseFan fan, vec2 before, vec2 here, vec2 after) {
    return steradian_ellipse_corner_between(fan, here, steradian_ellipse_gap(before, here) + steradian_ellipse_gap(here, after));
}
vec3 steradian_ellipse_fan_corner(SteradianEllipseFan fan, int k, int count) {
    return steradian_ellipse_pushed_corner(fan, steradian_ellipse_corner(fan, k - 1, count), steradian_ellipse_corner(fan, k, count), steradian_ellipse_corner(fan, k + 1, count));
}
SteradianLightElements steradian_capsule_elements(vec3 center, vec3 axis, float radius) {
    float r2 = radius * radius;
    float length2 = dot(axis, axis);
    vec3 along = axis * inversesqrt(max(length2, steradian_smallest_square()));
    vec3 sight = center * inversesqrt(max(dot(center, center), steradian_smallest_square()));
    vec3 across = sight - along * dot(along, sight);
    vec3 aside = cross(along, sight);
    float strip = 2.0 * radius * sqrt(length2);
    float balls = steradian_pi() * r2;
    float share = 2.0 / max(strip + balls, steradian_smallest_square());
    SteradianLightElements e;
    e.center = center;
    e.area = -(across * (inversesqrt(max(dot(across, across), 1.0e-12)) * strip) + sight * balls);
    e.reach_a = along * sqrt(share * (strip * length2 * 0.0833333333333333333 + balls * (length2 + r2) * 0.25));
    e.reach_b = aside * (inversesqrt(max(dot(aside, aside), 1.0e-12)) * sqrt(share * r2 * (strip * 0.333333333333333333 + balls * 0.25)));
    return e;
}
struct SteradianCapsule {
    vec3 end_a;
    vec3 end_b;
    vec3 along;
    vec3 toward;
    float at_a;
    float at_b;
    float span;
    float height;
    float radius;
    bool outside;
};
SteradianCapsule steradian_capsule_prepare(vec3 end_a, vec3 end_b, float radius) {
    vec3 difference = end_b - end_a;
    float span2 = dot(difference, difference);
    float a2 = dot(end_a, end_a);
    float b2 = dot(end_b, end_b);
    vec3 nearer = steradian_select(a2 < b2, end_a, end_b);
    float nearer2 = min(a2, b2);
    vec3 along = difference * inversesqrt(max(span2, steradian_smallest_square()));
    vec3 moment = cross(nearer, along);
    float height2 = dot(moment, moment);
    float at_a = dot(end_a, along);
    float at_b = dot(end_b, along);
    float radius2 = radius * radius;
    bool tube = height2 > radius2 && span2 > steradian_smallest_divisor();
    bool beside = at_a < 0.0 && at_b > 0.0 && span2 > steradian_smallest_divisor();
    float nearest = sqrt(nearer2);
    vec3 direction = steradian_select(nearer2 > steradian_smallest_square(), nearer * inversesqrt(max(nearer2, steradian_smallest_square())), vec3(0.0, 0.0, 1.0));
    mat3 across = steradian_frame_from_normal(direction);
    SteradianCapsule c;
    c.end_a = steradian_select(tube, end_a, nearer);
    c.end_b = steradian_select(tube, end_b, nearer);
    c.along = steradian_select(tube, along, steradian_transform(across, vec3(1.0, 0.0, 0.0)));
    c.toward = steradian_select(tube, cross(along, moment) * inversesqrt(max(height2, steradian_smallest_square())), direction);
    c.at_a = steradian_select(tube, at_a, 0.0);
    c.at_b = steradian_select(tube, at_b, 0.0);
    c.span = steradian_select(tube, sqrt(span2), 0.0);
    c.height = steradian_select(tube, sqrt(height2), nearest);
    c.radius = radius;
    c.outside = steradian_select(beside, height2, nearer2) > radius2;
    return c;
}
SteradianCapsule steradian_capsule_in_units(vec3 end_a, vec3 end_b, float radius) {
    float unit = inversesqrt(max(dot(end_a, end_a) + dot(end_b, end_b) + radius * radius, steradian_smallest_divisor()));
    return steradian_capsule_prepare(end_a * unit, end_b * unit, radius * unit);
}
float steradian_capsule_touch(SteradianCapsule c) {
    return sqrt(max((c.height - c.radius) * (c.height + c.radius), 0.0));
}
float steradian_capsule_half_angle(SteradianCapsule c, float place, float distance) {
    return steradian_trig_atan2(steradian_capsule_touch(c), c.radius * place / max(distance, steradian_smallest_length()));
}
vec3 steradian_capsule_straight_part(vec3 along, vec3 toward, float at_a, float at_b, float span, float height, float angle, float share) {
    float h2 = height * height;
    float both = (h2 + at_a * at_a) * (h2 + at_b * at_b);
    float chords = share * span * height / max(both, steradian_smallest_square());
    return toward * (0.5 * (angle + chords * (h2 - at_a * at_b))) + along * (0.5 * chords * height * (at_a + at_b));
}
vec3 steradian_capsule_whole_vector(SteradianCapsule c) {
    float touch = steradian_capsule_touch(c);
    float angle = steradian_trig_atan2_unwrapped(c.span * touch, touch * touch + c.at_a * c.at_b);
    float share = touch / max(c.height, steradian_smallest_length());
    float slope = c.radius / max(c.height, steradian_smallest_length());
    vec3 e = steradian_capsule_straight_part(c.along, c.toward, c.at_a, c.at_b, c.span, c.height, angle, share) * (2.0 * slope);
    float a2 = max(dot(c.end_a, c.end_a), steradian_smallest_square());
    float b2 = max(dot(c.end_b, c.end_b), steradian_smallest_square());
    float ia = inversesqrt(a2);
    float ib = inversesqrt(b2);
    float sine_a = c.radius * ia;
    float sine_b = c.radius * ib;
    e = e + c.end_a * (sine_a * sine_a * ia * steradian_capsule_half_angle(c, -c.at_a, sqrt(a2)));
    return e + c.end_b * (sine_b * sine_b * ib * steradian_capsule_half_angle(c, c.at_b, sqrt(b2)));
}
SteradianPolygonWalk steradian_capsule_add_arc(SteradianPolygonWalk walk, vec3 center, float radius, vec3 middle, float half_angle, vec3 start, vec3 finish) {
    float d2 = max(dot(center, center), steradian_smallest_square());
    float distance = sqrt(d2);
    float inverse = 1.0 / distance;
    float tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    float root = sqrt(max((radius - center.z) * (radius + center.z), 0.0));
    float horizon = steradian_trig_atan2(distance * root, -tangent * center.z);
    horizon = steradian_select(root > 0.0, horizon, steradian_select(center.z > 0.0, steradian_pi(), 0.0));
    float turn = steradian_trig_atan2(abs(middle.x * center.y - middle.y * center.x) * inverse, middle.z);
    float low = turn - half_angle;
    float high = turn + half_angle;
    float seen = max(min(high, horizon) - max(low, -horizon), 0.0) + max(high - (2.0 * steradian_pi() - horizon), 0.0);
    float flat2 = max(center.x * center.x + center.y * center.y, steradian_smallest_square());
    vec2 azimuth = vec2(center.x, center.y) * inversesqrt(flat2);
    vec2 tilt = steradian_complex_sign(vec2(tangent, root));
    vec2 comes = steradian_complex_product(azimuth, tilt);
    vec2 goes = steradian_complex_product(azimuth, vec2(tilt.x, -tilt.y));
    bool start_below = start.z < 0.0;
    bool finish_below = finish.z < 0.0;
    bool meets = root > 0.0;
    bool twice = meets && ((!start_below && !finish_below && high > steradian_pi()) || (start_below && finish_below && turn < half_angle));
    bool comes_up = twice || (start_below && !finish_below);
    bool goes_down = twice || (finish_below && !start_below);
    vec3 nowhere = vec3(0.0, 0.0, 0.0);
    vec3 chord = steradian_select(start_below, nowhere, start) - steradian_select(finish_below, nowhere, finish);
    chord = chord + steradian_select(comes_up, vec3(comes.x, comes.y, 0.0), nowhere);
    chord = chord - steradian_select(goes_down, vec3(goes.x, goes.y, 0.0), nowhere);
    float sine = radius * inverse;
    SteradianPolygonWalk next = walk;
    next.edges = walk.edges + center * (0.5 * sine * sine * inverse * seen) -
                 cross(center, chord) * (0.5 * tangent * inverse * inverse);
    vec2 up = steradian_select(comes_up, comes, vec2(1.0, 0.0));
    vec2 down = steradian_select(goes_down, vec2(goes.x, -goes.y), vec2(1.0, 0.0));
    next.horizon = steradian_complex_product(walk.horizon, steradian_complex_product(up, down));
    return next;
}
vec3 steradian_capsule_irradiance_vector(SteradianCapsule c) {
    vec3 e = steradian_capsule_whole_vector(c);
    bool cut = min(c.end_a.z, c.end_b.z) < c.radius;
    if (cut) {
        float a2 = dot(c.end_a, c.end_a);
        float b2 = dot(c.end_b, c.end_b);
        float r2 = c.radius * c.radius;
        vec3 side = cross(c.toward, c.along);
        vec3 inward = c.toward * (r2 / max(c.height, steradian_smallest_length()));
        vec3 aside = side * (c.radius * steradian_capsule_touch(c) / max(c.height, steradian_smallest_length()));
        float ia = inversesqrt(max(a2 - r2, steradian_smallest_square()));
        float ib = inversesqrt(max(b2 - r2, steradian_smallest_square()));
        vec3 a_left = (c.end_a - inward + aside) * ia;
        vec3 a_right = (c.end_a - inward - aside) * ia;
        vec3 b_left = (c.end_b - inward + aside) * ib;
        vec3 b_right = (c.end_b - inward - aside) * ib;
        float da = sqrt(max(a2, steradian_smallest_square()));
        float db = sqrt(max(b2, steradian_smallest_square()));
        vec3 a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
        vec3 b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
        SteradianPolygonWalk walk = steradian_polygon_begin();
        walk = steradian_capsule_add_arc(walk, c.end_a, c.radius, a_middle, steradian_capsule_half_angle(c, -c.at_a, da), a_left, a_right);
        walk = steradian_polygon_add_edge(walk, a_right, b_right);
        walk = steradian_capsule_add_arc(walk, c.end_b, c.radius, b_middle, steradian_capsule_half_angle(c, c.at_b, db), b_right, b_left);
        walk = steradian_polygon_add_edge(walk, b_left, a_left);
        bool shows = max(c.end_a.z, c.end_b.z) > -c.radius;
        vec3 above = steradian_polygon_irradiance_vector(walk, steradian_mask_none());
        e = steradian_select(cut, steradian_select(shows, above, vec3(0.0, 0.0, 0.0)), e);
    }
    e = vec3(e.x, e.y, clamp(e.z, 0.0, steradian_pi()));
    return steradian_select(c.outside, e, vec3(0.0, 0.0, 0.0));
}
vec3 steradian_line_irradiance_vector(vec3 end_a, vec3 end_b) {
    float wa = abs(end_a.z);
    float wb = abs(end_b.z);
    vec3 crossing = (end_a * wb + end_b * wa) * (1.0 / max(wa + wb, steradian_smallest_square()));
    vec3 a = steradian_select(end_a.z < 0.0, crossing, end_a);
    vec3 b = steradian_select(end_b.z < 0.0, crossing, end_b);
    vec3 difference = b - a;
    float span2 = dot(difference, difference);
    vec3 along = difference * inversesqrt(max(span2, steradian_smallest_square()));
    vec3 moment = cross(steradian_select(dot(a, a) < dot(b, b), a, b), along);
    float height2 = max(dot(moment, moment), steradian_smallest_square());
    float height = sqrt(height2);
    vec3 toward = cross(along, moment) * (1.0 / height);
    float span = sqrt(span2);
    float at_a = dot(a, along);
    float at_b = dot(b, along);
    float angle = steradian_trig_atan2_unwrapped(span * height, height2 + at_a * at_b);
    vec3 e = steradian_capsule_straight_part(along, toward, at_a, at_b, span, height, angle, 1.0) * (1.0 / height);
    e = vec3(e.x, e.y, max(e.z, 0.0));
    return steradian_select(end_a.z <= 0.0 && end_b.z <= 0.0, vec3(0.0, 0.0, 0.0), e);
}
struct SteradianCapsuleEnd {
    vec3 center;
    vec3 middle;
    vec3 side;
    vec2 last;
    float corners;
    vec2 turn;
    float beta;
    float first;
    float step;
};
struct SteradianCapsuleFan {
    SteradianCapsuleEnd a;
    SteradianCapsuleEnd b;
};
SteradianCapsuleEnd steradian_capsule_end(vec3 center, float radius, vec3 middle, float half_angle, vec3 r, float width) {
    float d2 = max(dot(center, center), steradian_smallest_square());
    float inverse = inversesqrt(d2);
    float sine = max(radius * inverse, steradian_smallest_length());
    float cosine2 = max(1.0 - sine * sine, steradian_smallest_length());
    float cosine = sqrt(cosine2);
    vec3 axis = center * inverse;
    vec3 side = cross(axis, middle);
    SteradianCapsuleEnd end;
    end.center = center * cosine2;
    end.middle = middle * (radius * cosine);
    end.side = side * (radius * cosine);
    end.last = steradian_complex_unit(half_angle);
    float along = dot(r, axis);
    vec2 place = vec2(dot(r, middle), dot(r, side)) * (cosine / (sine * max(along, 1.0e-12)));
    float nearest = clamp(steradian_trig_atan2(place.y, place.x), -half_angle, half_angle);
    end.turn = steradian_complex_unit(nearest);
    vec2 apart = place - end.turn;
    float blur = min(1.6 * width / sine, 1.0e3);
    float beta = sqrt(min(0.5 * dot(apart, apart), 1.0e6) + blur * blur);
    end.beta = steradian_select(along > 0.0, clamp(beta, 0.05, 1.0), 1.0);
    vec2 low = steradian_complex_unit(-0.5 * (half_angle + nearest));
    vec2 high = steradian_complex_unit(0.5 * (half_angle - nearest));
    end.first = steradian_trig_atan2(low.y, end.beta * low.x);
    end.step = steradian_trig_atan2(high.y, end.beta * high.x) - end.first;
    end.corners = 1.0;
    return end;
}
vec2 steradian_capsule_corner(SteradianCapsuleEnd end, float j) {
    vec2 u = steradian_complex_unit(clamp(end.first + end.step * (j + 0.5), -steradian_pi(), steradian_pi()));
    vec2 w = steradian_complex_sign(vec2(u.x, end.beta * u.y));
    vec2 corner = steradian_complex_product(steradian_complex_product(w, w), end.turn);
    vec2 limit = vec2(0.939372712847378920, 0.342897807455451364);  
    bool outer_low = j < 0.5;
    bool outer_high = j > end.corners - 1.5;
    vec2 low = vec2(end.last.x, -end.last.y);
    corner = steradian_select(outer_low && dot(corner, low) < limit.x, steradian_complex_product(low, limit), corner);
    corner = steradian_select(outer_high && dot(corner, end.last) < limit.x, steradian_complex_product(end.last, vec2(limit.x, -limit.y)), corner);
    return steradian_select(outer_low && outer_high, vec2(1.0, 0.0), corner);
}
float steradian_capsule_gap(vec2 corner, vec2 neighbour, vec2 joint, bool outer) {
    float cosine = dot(corner, neighbour);
    float sine = abs(corner.x * neighbour.y - corner.y * neighbour.x);
    float angle = clamp(steradian_trig_atan2(sine, cosine), 0.0, 2.6);
    sine = steradian_select(cosine > -0.856888753368947234, sine, 0.515501371821464235);
    float even = steradian_select(angle < 1.0e-3, 1.0, angle / max(sine, 1.0e-4));
    float c = max(dot(neighbour, joint), 0.5);
    float s = abs(neighbour.x * joint.y - neighbour.y * joint.x);
    float given = (even + (steradian_trig_atan2(s, c) - s / c) / max(sine, 1.0e-4)) * c;
    given = steradian_select(angle < 1.0e-3, 1.0, max(given, 0.5));
    return steradian_select(outer, given * given, even);
}
vec3 steradian_capsule_end_corner(SteradianCapsuleEnd end, float j) {
    vec2 here = steradian_capsule_corner(end, j);
    vec2 joint = vec2(end.last.x, -end.last.y);
    bool joins = j < 1.5;
    bool outer_low = j < 0.5;
    bool outer_high = j > end.corners - 1.5;
    float outer = 1.0 / max(dot(here, steradian_select(outer_low, joint, end.last)), 0.5);
    float gaps = 0.0;
    for (int i = 0; i < 2; i++) {
        gaps = gaps + steradian_capsule_gap(here, steradian_capsule_corner(end, j + float(2 * i - 1)), joint, joins);
        joint = end.last;
        joins = j > end.corners - 2.5;
    }
    float radius = steradian_select(outer_low || outer_high, outer, sqrt(0.5 * gaps));
    return end.center + (end.middle * here.x + end.side * here.y) * radius;
}
SteradianCapsuleFan steradian_capsule_fan(SteradianCapsule c, vec3 r, float width, int count) {
    float da = sqrt(max(dot(c.end_a, c.end_a), steradian_smallest_square()));
    float db = sqrt(max(dot(c.end_b, c.end_b), steradian_smallest_square()));
    float angle_a = steradian_capsule_half_angle(c, -c.at_a, da);
    float angle_b = steradian_capsule_half_angle(c, c.at_b, db);
    vec3 a_middle = (c.toward * c.at_a - c.along * c.height) * (1.0 / da);
    vec3 b_middle = (c.along * c.height - c.toward * c.at_b) * (1.0 / db);
    SteradianCapsuleFan fan;
    fan.a = steradian_capsule_end(c.end_a, c.radius, a_middle, angle_a, r, width);
    fan.b = steradian_capsule_end(c.end_b, c.radius, b_middle, angle_b, r, width);
    float share = fan.a.step / max(fan.a.step + fan.b.step, steradian_smallest_length());
    fan.a.corners = 1.0 + floor(0.5 + float(count - 2) * share);
    fan.b.corners = float(count) - fan.a.corners;
    fan.a.step = fan.a.step / fan.a.corners;
    fan.b.step = fan.b.step / fan.b.corners;
    return fan;
}
vec3 steradian_capsule_fan_corner(SteradianCapsuleFan fan, int k) {
    bool first = float(k) < fan.a.corners;
    SteradianCapsuleEnd end;
    end.center = steradian_select(first, fan.a.center, fan.b.center);
    end.middle = steradian_select(first, fan.a.middle, fan.b.middle);
    end.side = steradian_select(first, fan.a.side, fan.b.side);
    end.last = steradian_select(first, fan.a.last, fan.b.last);
    end.corners = steradian_select(first, fan.a.corners, fan.b.corners);
    end.turn = steradian_select(first, fan.a.turn, fan.b.turn);
    end.beta = steradian_select(first, fan.a.beta, fan.b.beta);
    end.first = steradian_select(first, fan.a.first, fan.b.first);
    end.step = steradian_select(first, fan.a.step, fan.b.step);
    return steradian_capsule_end_corner(end, steradian_select(first, float(k), float(k) - fan.a.corners));
}
struct SteradianEllipsoidOutline {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
    bool outside;  
};
SteradianEllipsoidOutline steradian_ellipsoid_outline(vec3 to_center, mat3 s, mat3 inverse) {
    vec3 p = -steradian_transform(inverse, to_center);
    float d2 = dot(p, p);
    float safe = max(d2, 1.000001);
    float inverse_d = inversesqrt(safe);
    vec3 k = p * inversesqrt(max(d2, steradian_smallest_divisor()));
    float rho = sqrt(1.0 - 1.0 / safe);
    mat3 frame = steradian_frame_from_normal(k);
    vec3 a = steradian_transform(frame, vec3(rho, 0.0, 0.0));
    vec3 b = steradian_transform(frame, vec3(0.0, rho, 0.0));
    SteradianEllipsoidOutline outline;
    outline.center = to_center + steradian_transform(s, k * inverse_d);
    outline.axis_a = steradian_transform(s, a);
    outline.axis_b = steradian_transform(s, b);
    outline.outside = d2 > 1.000001;
    return outline;
}
vec3 steradian_far_element_vector(vec3 area, vec3 r) {
    float inverse = 1.0 / max(dot(r, r), steradian_smallest_divisor());
    return (r * inverse) * (max(-dot(area, r), 0.0) * inverse);
}
vec3 steradian_far_ball_vector(vec3 r) {
    float inverse = inversesqrt(max(dot(r, r), steradian_smallest_divisor()));
    return (r * inverse) * (inverse * inverse);
}
float steradian_far_error_of_one(float deviation2, float distance2) { return 3.0 * deviation2 / distance2; }
float steradian_far_error_of_four(float third, float fourth, bool symmetric, float distance2) {
    float by_third = 4.0 * third * inversesqrt(distance2);
    float by_fourth = 5.0 * fourth / distance2;
    return steradian_select(symmetric, min(by_third, by_fourth), by_third) / distance2;
}
float steradian_far_error_across_horizon(float top, float deviation_up, float deviation, float distance) {
    float inverse = 1.0 / distance;
    return min(top * inverse, (0.5 * deviation_up + 3.0 * top * deviation * inverse) * inverse);
}
float steradian_far_error_of_nodes(int nodes, float reach, float distance) {
    float step = reach / (2.0 * distance);
    float power = 2.0 * float(nodes + 1);
    for (int i = 0; i < nodes; i++) {
        power = power * step;
    }
    return power;
}
vec2 steradian_far_grazing(float c) {
    float x = clamp(1.0 - c, 0.0, 1.0);
    float x2 = x * x;
    return vec2(x2 * x2 * x, 2.5 * x2 * x2 * sqrt(max(1.0 - (1.0 - x) * (1.0 - x), 0.0)));
}
float steradian_far_error_of_grazing_nodes(int nodes, float reach, float distance, float view_distance, float least_square) {
    float room = min(distance, view_distance);
    float best = 1.0e6;
    for (int k = 1; k < 4; k++) {
        float rho = 0.2 * float(k) * room;
        float x = rho / (distance - rho);
        float y = rho / (view_distance - rho);
        float left = least_square - 0.5 * (x + y + x * y);
        float grazing = steradian_far_grazing(sqrt(max(left, 0.0))).x;
        float step = reach / (2.0 * rho);
        float growth = 1.0 + x;
        float power = 2.0 * growth * growth * grazing;
        for (int i = 0; i < nodes; i++) {
            power = power * step;
        }
        best = steradian_select(left > 0.0, min(best, power), best);
    }
    return best;
}
struct SteradianPunctualSource {
    vec3 position;
    vec3 direction;
    float inverse_range2;
    float spot_scale;
    float spot_offset;
};
struct SteradianPunctualIncident {
    vec3 direction;
    float irradiance;
};
SteradianPunctualIncident steradian_punctual_incident(SteradianPunctualSource light, vec3 p) {
    vec3 to = light.position - p;
    float d2 = max(dot(to, to), 1.0e-12);
    SteradianPunctualIncident incident;
    incident.direction = to * inversesqrt(d2);
    float q = d2 * light.inverse_range2;
    float within = clamp(1.0 - q * q, 0.0, 1.0);
    float spot = clamp(light.spot_offset - dot(light.direction, incident.direction) * light.spot_scale, 0.0, 1.0);
    incident.irradiance = within * (spot * spot) / d2;
    return incident;
}
struct SteradianMomentEdge {
    float side;
    float s;
    float c;
    float x0;
    float y0;
    float x1;
    float y1;
    float log_c;
    float swept;
};
float steradian_moment_log_1_plus(float z) {
    float near = 0.25;
    float t = z / (2.0 + z);
    float t2 = t * t;
    float series = 2.0 * t * (1.0 + t2 * (0.333333333333333333 + t2 * (0.2 + t2 * (0.142857142857142857 + t2 * 0.111111111111111111))));
    return steradian_select(z < near, series, log(1.0 + z));
}
float steradian_moment_1_minus_exp(float x) {
    float near = 0.25;
    float result = 1.0 - exp(-x);
    bool small = x < near;
    if (small) {
        float series = x * (1.0 - 0.5 * x * (1.0 - 0.333333333333333333 * x * (1.0 - 0.25 * x * (1.0 - 0.2 * x * (1.0 - 0.166666666666666667 * x)))));
        result = steradian_select(small, series, result);
    }
    return result;
}
float steradian_moment_angle(float w, float x0, float y0, float x1, float y1) {
    return steradian_trig_atan2_unwrapped(w * (x0 * y1 - x1 * y0), w * w * x0 * x1 + y0 * y1);
}
float steradian_moment_minus_log_cosine2(float s2, float c2) {
    float near = 0.05;
    float result = -log(c2);
    bool small = s2 < near;
    if (small) {
        float series = s2 * (1.0 + s2 * (0.5 + s2 * (0.333333333333333333 + s2 * (0.25 + s2 * (0.2 + s2 * 0.166666666666666667)))));
        result = steradian_select(small, series, result);
    }
    return result;
}
SteradianMomentEdge steradian_moment_edge(vec3 a, vec3 b, vec3 r) {
    float pole2 = 1.0e-6;
    vec3 n = cross(a, b - a);  
    float n2 = dot(n, n);
    bool has_length = n2 > steradian_smallest_divisor();
    n = n * inversesqrt(max(n2, steradian_smallest_divisor()));
    float s = dot(n, r);
    vec3 q = cross(n, r);
    float s2 = clamp(s * s, steradian_smallest_divisor(), 1.0);
    float c2 = clamp(dot(q, q), pole2, 1.0);
    SteradianMomentEdge edge;
    edge.side = steradian_select(has_length, steradian_select(s < 0.0, -1.0, 1.0), 0.0);
    edge.s = s2 * inversesqrt(s2);
    edge.c = c2 * inversesqrt(c2);
    edge.log_c = steradian_moment_minus_log_cosine2(s2, c2);
    float x0 = dot(a, r);
    float y0 = dot(a, q);
    float x1 = dot(b, r);
    float y1 = dot(b, q);
    edge.x0 = x0;
    edge.y0 = y0;
    edge.x1 = x1;
    edge.y1 = y1;
    edge.swept = 0.0;
    bool behind0 = x0 <= 0.0;
    bool behind1 = x1 <= 0.0;
    bool pole = x0 * x0 + y0 * y0 < pole2;
    if (behind0 || behind1 || pole) {
        bool none = (behind0 && behind1) || pole;
        edge.x0 = steradian_select(behind0 || none, 0.0, x0);
        edge.y0 = steradian_select(none, edge.c, steradian_select(behind0, -edge.c, y0));
        edge.x1 = steradian_select(behind1 || none, 0.0, x1);
        edge.y1 = steradian_select(behind1 || none, edge.c, y1);
        float whole = steradian_moment_angle(edge.s, x0, y0, x1, y1);
        float in_front = steradian_moment_angle(edge.s, edge.x0, edge.y0, edge.x1, edge.y1);
        float swept = steradian_select(none, whole, max(whole - in_front, 0.0));
        if (pole) {
            float arc = steradian_trig_atan2(sqrt(n2), dot(a, b));
            swept = steradian_select(pole, arc, swept);
        }
        edge.swept = steradian_select(behind0 || behind1 || pole, swept, 0.0);
    }
    return edge;
}
float steradian_moment_edge_share(SteradianMomentEdge edge, float front) {
    return edge.side * (front + edge.swept);
}
float steradian_moment_phong_radiance(float sum, bool reversed) {
    return clamp(steradian_select(reversed, -sum, sum) * steradian_inverse_two_pi(), 0.0, 1.0);
}
struct SteradianMomentQuadrature {
    float m;
    float s2;
    float c2;
    float kap;
    float w;
    float t0;
    float t1;
};
float steradian_moment_quadrature_parameter(float w, float x, float y) {
    float wx = w * x;
    return clamp(y / max(wx + sqrt(wx * wx + y * y), steradian_smallest_length()), -1.0, 1.0);
}
SteradianMomentQuadrature steradian_moment_quadrature_prepare(SteradianMomentEdge edge, float n) {
    SteradianMomentQuadrature q;
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
    float moment;
    float power;
};
SteradianMomentIntegrands steradian_moment_quadrature_integrands(SteradianMomentQuadrature q, float t) {
    float t2 = t * t;
    float d = 1.0 / (1.0 + t2);
    float cos_u = max((1.0 - t2) * d, 1.0e-15);
    float sin_u = 2.0 * t * d;
    float cos2 = cos_u * cos_u;
    float wsin2 = q.w * q.w * sin_u * sin_u;
    float Q = q.s2 * cos2 + wsin2;
    float exponent = 0.5 * q.m * steradian_moment_log_1_plus(Q / (q.c2 * cos2));  
    SteradianMomentIntegrands result;
    result.moment = 2.0 * d * q.kap * q.w * q.w * steradian_moment_1_minus_exp(exponent) / Q;
    result.power = 2.0 * d * q.w * exp(-exponent) / (cos2 + wsin2);
    return result;
}
SteradianMomentIntegrands steradian_moment_quadrature_pair(SteradianMomentIntegrands sum, SteradianMomentQuadrature q, float mid, float offset, float weight) {
    SteradianMomentIntegrands a = steradian_moment_quadrature_integrands(q, mid - offset);
    SteradianMomentIntegrands b = steradian_moment_quadrature_integrands(q, mid + offset);
    SteradianMomentIntegrands next;
    next.moment = sum.moment + weight * (a.moment + b.moment);
    next.power = sum.power + weight * (a.power + b.power);
    return next;
}
SteradianMomentIntegrands steradian_moment_quadrature_piece(SteradianMomentQuadrature q, float low, float high) {
    float mid = 0.5 * (low + high);
    float h = 0.5 * (high - low);
    SteradianMomentIntegrands sum;
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
SteradianMomentIntegrands steradian_moment_quadrature_front(SteradianMomentEdge edge, float n) {
    SteradianMomentQuadrature q = steradian_moment_quadrature_prepare(edge, n);
    SteradianMomentIntegrands to0 = steradian_moment_quadrature_piece(q, 0.0, q.t0);
    SteradianMomentIntegrands to1 = steradian_moment_quadrature_piece(q, 0.0, q.t1);
    SteradianMomentIntegrands result;
    result.moment = max(to1.moment - to0.moment, 0.0);
    result.power = max(to1.power - to0.power, 0.0);
    return result;
}
struct SteradianMomentSeries {
    float m;
    vec4 b0;
    vec4 b1;
    vec4 b2;
    vec4 b3;
};
struct SteradianMomentSeriesHigh {
    float m;
    vec3 low0;
    vec3 high0;
    vec3 low1;
    vec3 high1;
    vec3 low2;
    vec3 high2;
    vec3 low3;
    vec3 high3;
    vec3 low4;
    vec3 high4;
    vec3 low5;
    vec3 high5;
};
SteradianMomentSeries steradian_moment_series_prepare(float n) {
    float g = 1.0 / (n + 1.0);
    SteradianMomentSeries series;
    series.m = n + 1.0;
    series.b0 = vec4(
        0.12391 + g * (-0.25888 + g * 0.02078),
        0.07456 + g * (-0.20614 + g * 0.11305),
        -0.12583 + g * (0.43406 - g * 0.36368),
        0.15639 + g * (-0.50303 + g * 0.37906));
    series.b1 = vec4(
        -0.03292 + g * (0.01056 + g * 0.11495),
        0.06163 + g * (-0.30904 + g * 0.37892),
        -0.11837 + g * (0.57004 - g * 0.68066),
        0.14285 + g * (-0.68183 + g * 0.80688));
    series.b2 = vec4(
        -0.13853 + g * (0.41672 - g * 0.28568),
        -0.06770 + g * (0.08453 + g * 0.12882),
        0.04014 + g * (0.23881 - g * 0.72146),
        -0.07736 + g * (-0.16196 + g * 0.72256));
    series.b3 = vec4(
        0.05051 + g * (-0.15092 + g * 0.09913),
        -0.07193 + g * (0.41519 - g * 0.56582),
        0.16852 + g * (-0.91416 + g * 1.19835),
        -0.20343 + g * (1.12430 - g * 1.49409));
    return series;
}
SteradianMomentSeriesHigh steradian_moment_series_high_prepare(float n) {
    float g = 1.0 / (n + 1.0);
    SteradianMomentSeriesHigh series;
    series.m = n + 1.0;
    series.low0 = vec3(
        0.12669 + g * (-0.27819 + g * 0.04967),
        0.07312 + g * (-0.20720 + g * 0.11887),
        -0.28171 + g * (0.96646 - g * 0.78366));
    series.high0 = vec3(
        0.96760 + g * (-3.22789 + g * 2.51001),
        -1.31672 + g * (4.38441 - g * 3.39728),
        0.67908 + g * (-2.22981 + g * 1.68799));
    series.low1 = vec3(
        -0.03401 + g * (0.03357 + g * 0.07057),
        0.06494 + g * (-0.35196 + g * 0.45924),
        -0.35605 + g * (1.94458 - g * 2.56698));
    series.high1 = vec3(
        1.18702 + g * (-6.44998 + g * 8.48253),
        -1.61836 + g * (8.78673 - g * 11.54971),
        0.82904 + g * (-4.48596 + g * 5.88295));
    series.low2 = vec3(
        -0.13696 + g * (0.38633 - g * 0.22764),
        -0.06158 + g * (0.07469 + g * 0.12325),
        0.10552 + g * (0.38974 - g * 1.38750));
    series.high2 = vec3(
        -0.41931 + g * (-1.05462 + g * 4.38637),
        0.57016 + g * (1.43774 - g * 5.97208),
        -0.30823 + g * (-0.67167 + g * 2.98664));
    series.low3 = vec3(
        0.04598 + g * (-0.11007 + g * 0.03214),
        -0.06747 + g * (0.36907 - g * 0.48289),
        0.33782 + g * (-1.67745 + g * 2.03933));
    series.high3 = vec3(
        -1.15579 + g * (5.80262 - g * 7.12399),
        1.57642 + g * (-7.90773 + g * 9.70255),
        -0.81732 + g * (4.11164 - g * 5.05901));
    series.low4 = vec3(
        0.00469 + g * (-0.08385 + g * 0.15819),
        -0.00971 + g * (0.12521 - g * 0.23654),
        0.23694 + g * (-1.87957 + g * 3.05375));
    series.high4 = vec3(
        -0.72818 + g * (5.87109 - g * 9.60316),
        0.99890 + g * (-8.04735 + g * 13.15881),
        -0.50043 + g * (4.05438 - g * 6.64504));
    series.low5 = vec3(
        -0.01005 + g * (0.07653 - g * 0.11794),
        -0.00224 + g * (0.01770 - g * 0.03021),
        -0.00365 + g * (-0.11481 + g * 0.29662));
    series.high5 = vec3(
        0.03795 + g * (0.13754 - g * 0.56050),
        -0.05687 + g * (-0.14794 + g * 0.70035),
        0.04439 + g * (-0.05460 - g * 0.13949));
    return series;
}
float steradian_moment_series_cubic(vec4 b, float t) {
    return ((b.w * t + b.z) * t + b.y) * t + b.x;
}
float steradian_moment_series_quintic(vec3 low, vec3 high, float t) {
    return ((((high.z * t + high.y) * t + high.x) * t + low.z) * t + low.y) * t + low.x;
}
struct SteradianMomentWarp {
    float kap;
    float kap2;
    float du;
    vec2 cosine;
    vec2 sine;
};
SteradianMomentWarp steradian_moment_warp(SteradianMomentEdge edge, float m) {
    SteradianMomentWarp warp;
    warp.kap2 = steradian_moment_1_minus_exp(0.5 * m * edge.log_c);
    float over_kap = inversesqrt(warp.kap2);
    warp.kap = warp.kap2 * over_kap;
    float w = edge.s * over_kap;
    float wx0 = w * edge.x0;
    float wx1 = w * edge.x1;
    warp.du = steradian_trig_atan2_unwrapped(wx0 * edge.y1 - wx1 * edge.y0, wx0 * wx1 + edge.y0 * edge.y1);
    float d0 = wx0 * wx0 + edge.y0 * edge.y0;
    float d1 = wx1 * wx1 + edge.y1 * edge.y1;
    float over_both = 2.0 / max(d0 * d1, steradian_smallest_divisor());
    float scale0 = over_both * d1;
    float scale1 = over_both * d0;
    warp.cosine = vec2(scale0 * (wx0 * wx0 - edge.y0 * edge.y0), scale1 * (wx1 * wx1 - edge.y1 * edge.y1));
    warp.sine = vec2(scale0 * wx0 * edge.y0, scale1 * wx1 * edge.y1);
    return warp;
}
float steradian_moment_series_front(SteradianMomentEdge edge, SteradianMomentSeries series) {
    SteradianMomentWarp warp = steradian_moment_warp(edge, series.m);
    float t = warp.kap2;
    vec2 s1 = warp.sine;
    vec2 s2 = vec2(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    vec2 s3 = vec2(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    float bump = steradian_moment_series_cubic(series.b0, t) * warp.du
              + steradian_moment_series_cubic(series.b1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_cubic(series.b2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_cubic(series.b3, t) * (s3.y - s3.x) * 0.166666666666666667;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}
float steradian_moment_series_high_front(SteradianMomentEdge edge, SteradianMomentSeriesHigh series) {
    SteradianMomentWarp warp = steradian_moment_warp(edge, series.m);
    float t = warp.kap2;
    vec2 s1 = warp.sine;
    vec2 s2 = vec2(warp.cosine.x * s1.x, warp.cosine.y * s1.y);
    vec2 s3 = vec2(warp.cosine.x * s2.x - s1.x, warp.cosine.y * s2.y - s1.y);
    vec2 s4 = vec2(warp.cosine.x * s3.x - s2.x, warp.cosine.y * s3.y - s2.y);
    vec2 s5 = vec2(warp.cosine.x * s4.x - s3.x, warp.cosine.y * s4.y - s3.y);
    float bump = steradian_moment_series_quintic(series.low0, series.high0, t) * warp.du
              + steradian_moment_series_quintic(series.low1, series.high1, t) * (s1.y - s1.x) * 0.5
              + steradian_moment_series_quintic(series.low2, series.high2, t) * (s2.y - s2.x) * 0.25
              + steradian_moment_series_quintic(series.low3, series.high3, t) * (s3.y - s3.x) * 0.166666666666666667
              + steradian_moment_series_quintic(series.low4, series.high4, t) * (s4.y - s4.x) * 0.125
              + steradian_moment_series_quintic(series.low5, series.high5, t) * (s5.y - s5.x) * 0.1;
    return max(warp.kap * (warp.du + (1.0 - t) * bump), 0.0);
}
float steradian_moment_cosine_from_foot(float x, float y, float n) {
    float a = n + 0.5;
    float v2 = steradian_moment_log_1_plus(y * y / max(x * x, steradian_smallest_divisor()));
    float t = 0.5 * a * v2;
    float v = sqrt(v2);
    float decay = exp(-t);
    float e = 1.0 / (1.0 + 0.3275911 * sqrt(t));
    float p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    float correction = v * (v2 + 3.0 / a) * inversesqrt(a) / (60.1590786 - 3.75994241 / (a * a));
    float k = 0.5 * n + 0.25;
    float quarter_turn = 0.886226925452758014 * inversesqrt(k + 0.03125 / k - 0.00439453125 / (k * k * k));
    float magnitude = quarter_turn * (1.0 - decay * (p - correction));
    return steradian_select(y < 0.0, -magnitude, magnitude);
}
float steradian_moment_cosine_front(SteradianMomentEdge edge, float n, int low) {
    float order = n;
    if (low == 1) {
        order = n + 4.0;
    }
    float cosines = steradian_moment_cosine_from_foot(edge.x1, edge.y1, order) - steradian_moment_cosine_from_foot(edge.x0, edge.y0, order);
    float result = exp(-0.5 * order * edge.log_c) * cosines;
    if (low == 1) {
        float c2 = edge.c * edge.c;
        float p0 = steradian_phong_power(edge.x0, n + 1.0) * edge.y0;
        float p1 = steradian_phong_power(edge.x1, n + 1.0) * edge.y1;
        result = ((n + 4.0) * result - (p1 * edge.x1 * edge.x1 - p0 * edge.x0 * edge.x0)) / ((n + 3.0) * c2);
        result = ((n + 2.0) * result - (p1 - p0)) / ((n + 1.0) * c2);
    }
    return max(result, 0.0);
}
float steradian_moment_series_low_front(SteradianMomentEdge edge, SteradianMomentSeries raised, float n) {
    return max(steradian_moment_series_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}
float steradian_moment_series_high_low_front(SteradianMomentEdge edge, SteradianMomentSeriesHigh raised, float n) {
    return max(steradian_moment_series_high_front(edge, raised) - edge.s * steradian_moment_cosine_front(edge, n + 1.0, 1), 0.0);
}
float steradian_moment_double_axis_share(vec3 a, vec3 b, vec3 r, vec3 v, float share, float cosines) {
    vec3 n = cross(a, b);
    float n2 = dot(n, n);
    float inward = dot(n, v) * inversesqrt(max(n2, steradian_smallest_divisor()));
    return dot(r, v) * share + steradian_select(n2 > steradian_smallest_divisor(), inward * cosines, 0.0);
}
SteradianMomentIntegrands steradian_moment_foreshortened_front(SteradianMomentEdge edge, float n, int level) {
    SteradianMomentIntegrands front;
    front.moment = 0.0;
    front.power = 0.0;
    if (level > 0) {
        front.power = steradian_trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    } else {
        front = steradian_moment_quadrature_front(edge, n - 1.0);
    }
    return front;
}
float steradian_moment_foreshortened_share(SteradianMomentEdge edge, vec3 a, vec3 b, vec3 r, float front, float cosines) {
    return steradian_moment_double_axis_share(a, b, r, vec3(0.0, 0.0, 1.0), steradian_moment_edge_share(edge, front), cosines);
}
struct SteradianLtcMatrix {
    float xx;
    float xz;
    float yy;
    float zx;
    float zz;
};
vec2 steradian_ltc_coordinates(float roughness, float n_dot_v) {
    return vec2(clamp(roughness, 0.0, 1.0), sqrt(clamp(1.0 - n_dot_v, 0.0, 1.0)));
}
SteradianLtcMatrix steradian_ltc_from_classic(vec4 t) {
    SteradianLtcMatrix m;
    m.xx = t.x;
    m.xz = t.z;
    m.yy = 1.0;
    m.zx = t.y;
    m.zz = t.w;
    return m;
}
SteradianLtcMatrix steradian_ltc_from_compact(vec4 e, float alpha, vec3 view) {
    float tilt = alpha * e.z;
    float shear = alpha * e.w;
    float width = alpha * e.x;
    SteradianLtcMatrix m;
    m.xx = view.z + tilt * view.x;
    m.xz = view.x - tilt * view.z;
    m.yy = (e.x - tilt * e.w) / e.y;
    m.zx = -(shear * view.z + width * view.x);
    m.zz = width * view.z - shear * view.x;
    return m;
}
vec3 steradian_ltc_transform(SteradianLtcMatrix m, vec3 v) {
    return vec3(m.xx * v.x + m.xz * v.z, m.yy * v.y, m.zx * v.x + m.zz * v.z);
}
vec3 steradian_ltc_transform_transposed(SteradianLtcMatrix m, vec3 v) {
    return vec3(m.xx * v.x + m.zx * v.z, m.yy * v.y, m.xz * v.x + m.zz * v.z);
}
float steradian_ltc_lobe(SteradianLtcMatrix m, vec3 l) {
    vec3 w = steradian_ltc_transform(m, l);
    float d2 = max(dot(w, w), steradian_smallest_length());
    float determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    return determinant * max(w.z, 0.0) * steradian_inverse_pi() / (d2 * d2);
}
float steradian_ltc_sharpness(SteradianLtcMatrix m, vec3 l) {
    vec3 w = steradian_ltc_transform(m, l);
    float size2 = m.xx * m.xx + m.xz * m.xz + m.yy * m.yy + m.zx * m.zx + m.zz * m.zz;
    return sqrt(size2 * dot(l, l) / max(dot(w, w), steradian_smallest_square()));
}
float steradian_ltc_energy_above_horizon(SteradianLtcMatrix m) {
    return 0.5 + 0.5 * m.xx * inversesqrt(max(m.xx * m.xx + m.zx * m.zx, steradian_smallest_square()));
}
struct SteradianLtcWalk {
    SteradianPolygonWalk lobe;
    vec3 anchor;
    bool anchored;
};
SteradianLtcWalk steradian_ltc_begin() {
    SteradianLtcWalk walk;
    walk.lobe = steradian_polygon_begin();
    walk.anchor = vec3(0.0, 0.0, 0.0);
    walk.anchored = steradian_mask_none();
    return walk;
}
vec3 steradian_ltc_direction(SteradianLtcMatrix m, vec3 v) {
    return steradian_polygon_direction(steradian_ltc_transform(m, v));
}
SteradianEdgePart steradian_ltc_part(SteradianLtcMatrix m, vec3 a, vec3 b, vec3 ta, vec3 tb) {
    bool a_below = a.z < 0.0;
    bool b_below = b.z < 0.0;
    SteradianEdgePart part = steradian_edge_whole(ta, tb);
    part.rises = a_below && !b_below;
    part.sinks = b_below && !a_below;
    if (a_below || b_below) {
        float wa = abs(b.z);
        float wb = abs(a.z);
        vec3 horizon = vec3(a.x * wa + b.x * wb, a.y * wa + b.y * wb, 0.0);
        vec3 under = steradian_ltc_transform(m, horizon);
        vec3 crossing = steradian_select(part.rises || part.sinks, steradian_polygon_direction(under), vec3(0.0, 0.0, 0.0));
        part.start = steradian_select(a_below, crossing, ta);
        part.end = steradian_select(b_below, crossing, tb);
        vec3 under_a = steradian_ltc_transform(m, a);
        vec3 under_b = steradian_ltc_transform(m, b);
        float scale = inversesqrt(max(dot(under, under), steradian_smallest_square()));
        float of_a = wa * sqrt(dot(under_a, under_a)) * scale;
        float of_b = wb * sqrt(dot(under_b, under_b)) * scale;
        part.start_a = steradian_select(a_below, of_a, 1.0);
        part.start_b = steradian_select(a_below, of_b, 0.0);
        part.end_a = steradian_select(b_below, of_a, 0.0);
        part.end_b = steradian_select(b_below, of_b, 1.0);
    }
    return part;
}
SteradianLtcWalk steradian_ltc_close_gap(SteradianLtcWalk walk, SteradianEdgePart part) {
    SteradianLtcWalk next = walk;
    bool crosses = part.rises || part.sinks;
    if (crosses) {
        vec3 none = vec3(0.0, 0.0, 0.0);
        vec3 crossing = steradian_select(part.rises, part.start, part.end);
        bool closes = crosses && walk.anchored;
        if (closes) {
            vec3 departure = steradian_select(part.rises, walk.anchor, crossing);
            vec3 arrival = steradian_select(part.rises, crossing, walk.anchor);
            next.lobe = steradian_polygon_add_edge(next.lobe, steradian_select(closes, departure, none), steradian_select(closes, arrival, none));
        }
        next.anchor = steradian_select(crosses && !walk.anchored, crossing, walk.anchor);
        next.anchored = walk.anchored || crosses;
    }
    return next;
}
SteradianLtcWalk steradian_ltc_add_edge(SteradianLtcWalk walk, SteradianLtcMatrix m, vec3 a, vec3 b, vec3 ta, vec3 tb) {
    SteradianLtcWalk next = walk;
    if (!(a.z < 0.0) || !(b.z < 0.0)) {
        SteradianEdgePart part = steradian_ltc_part(m, a, b, ta, tb);
        next = steradian_ltc_close_gap(walk, part);
        next.lobe = steradian_polygon_add_edge(next.lobe, part.start, part.end);
    }
    return next;
}
float steradian_ltc_integral(SteradianLtcWalk walk, bool reversed) {
    return steradian_polygon_irradiance(walk.lobe, reversed) * steradian_inverse_pi();
}
float steradian_ltc_specular_scale(float f0, float f90, float n_a, float f_a) {
    return f0 * n_a + (f90 - f0) * f_a;
}
float steradian_ltc_specular_with_fresnel_lobe(float f0, float f90, float n_a, float integral, float f_a, float grazing) {
    return f0 * n_a * integral + (f90 - f0) * f_a * grazing;
}
float steradian_ltc_multiple_scattering(float f0, float albedo) {
    float a = clamp(albedo, 1.0e-2, 1.0);
    return 1.0 + f0 * (1.0 - a) / a;
}
float steradian_ltc_clear_coat(float base, float coat, float clearcoat, float n_dot_v) {
    float f = steradian_fresnel_schlick(0.04, 1.0, n_dot_v);
    return base * (1.0 - clearcoat * f) + clearcoat * coat;
}
float steradian_ltc_sheen(float base, float sheen, float strongest, float albedo) {
    return base * clamp(1.0 - strongest * albedo, 0.0, 1.0) + sheen;
}
struct SteradianLtcTextureFootprint {
    vec3 center;
    vec3 axis_a;
    vec3 axis_b;
    bool valid;
};
vec3 steradian_ltc_texture_transform_back(SteradianLtcMatrix m, vec3 w) {
    float determinant = m.xx * m.zz - m.xz * m.zx;
    return vec3(m.zz * w.x - m.xz * w.z, w.y * (determinant / m.yy), m.xx * w.z - m.zx * w.x);
}
SteradianLtcMatrix steradian_ltc_texture_diffuse() {
    SteradianLtcMatrix m;
    m.xx = 1.0;
    m.xz = 0.0;
    m.yy = 1.0;
    m.zx = 0.0;
    m.zz = 1.0;
    return m;
}
vec3 steradian_ltc_texture_irradiance_vector(SteradianLtcWalk walk, bool reversed) {
    return steradian_polygon_irradiance_vector(walk.lobe, reversed);
}
SteradianLtcTextureFootprint steradian_ltc_texture_footprint(SteradianLtcMatrix m, vec3 phi, vec3 normal, float height) {
    float p2 = dot(phi, phi);
    bool lit = p2 > steradian_smallest_divisor();
    vec3 w = steradian_select(lit, phi * inversesqrt(max(p2, steradian_smallest_divisor())), vec3(0.0, 0.0, 1.0));
    mat3 across = steradian_frame_from_normal(w);
    vec3 l = steradian_ltc_texture_transform_back(m, w);
    float along = dot(normal, l);
    bool meets = lit && along * height > 0.0;
    float inverse = steradian_select(meets, 1.0 / steradian_select(meets, along, 1.0), 0.0);
    float t = height * inverse;
    vec3 a = steradian_ltc_texture_transform_back(m, steradian_transform(across, vec3(1.0, 0.0, 0.0)));
    vec3 b = steradian_ltc_texture_transform_back(m, steradian_transform(across, vec3(0.0, 1.0, 0.0)));
    SteradianLtcTextureFootprint f;
    f.center = l * t;
    f.axis_a = (a - l * (dot(normal, a) * inverse)) * t;
    f.axis_b = (b - l * (dot(normal, b) * inverse)) * t;
    f.valid = meets;
    return f;
}
struct SteradianLtcTextureEllipse {
    vec2 major;
    float minor;
};
SteradianLtcTextureEllipse steradian_ltc_texture_axes(vec2 a, vec2 b) {
    float xx = a.x * a.x + b.x * b.x;
    float yy = a.y * a.y + b.y * b.y;
    float xy2 = a.x * a.y + b.x * b.y;
    float half_difference = 0.5 * (xx - yy);
    float spread = sqrt(half_difference * half_difference + xy2 * xy2);
    vec2 v = steradian_select(half_difference > 0.0, vec2(half_difference + spread, xy2), vec2(xy2, spread - half_difference));
    float v2 = dot(v, v);
    vec2 direction = steradian_select(v2 > steradian_smallest_square(), v * inversesqrt(max(v2, steradian_smallest_square())), vec2(1.0, 0.0));
    float longest = sqrt(0.5 * (xx + yy) + spread);
    SteradianLtcTextureEllipse e;
    e.major = direction * longest;
    e.minor = abs(a.x * b.y - a.y * b.x) / max(longest, steradian_smallest_length());
    return e;
}
SteradianLtcTextureEllipse steradian_ltc_texture_gaussian(SteradianLtcTextureEllipse e, float width, float widest) {
    float longest = width * sqrt(dot(e.major, e.major));
    SteradianLtcTextureEllipse g;
    g.major = e.major * (width * (widest / max(longest, widest)));
    g.minor = min(width * e.minor, widest);
    return g;
}
vec2 steradian_ltc_texture_place(SteradianLtcTextureEllipse g, vec2 aside, vec2 slope, vec3 light) {
    float major2 = dot(g.major, g.major);
    float minor2 = g.minor * g.minor;
    vec2 u = g.major * inversesqrt(max(major2, steradian_smallest_square()));
    float along = major2 - minor2;
    float sxx = minor2 + along * u.x * u.x;
    float sxy = along * u.x * u.y;
    float syy = minor2 + along * u.y * u.y;
    float least = 1.0e-6 * (light.x + light.z) + steradian_smallest_divisor();
    float vxx = light.x + least;
    float vyy = light.z + least;
    float txx = vxx + sxx;
    float txy = light.y + sxy;
    float tyy = vyy + syy;
    float t_inverse = 1.0 / max(txx * tyy - txy * txy, steradian_smallest_square());
    vec2 p = vec2(vxx * slope.x + light.y * slope.y, light.y * slope.x + vyy * slope.y);
    p = vec2(tyy * p.x - txy * p.y, txx * p.y - txy * p.x) * t_inverse;
    p = vec2(sxx * p.x + sxy * p.y, sxy * p.x + syy * p.y);
    float q = max(dot(slope, p), 0.0);
    float share = 2.0 / (1.0 + sqrt(1.0 + 4.0 * q));
    vec2 d = aside + p * share;
    float v_inverse = 1.0 / max(vxx * vyy - light.y * light.y, steradian_smallest_square());
    vec2 e = vec2(vyy * d.x - light.y * d.y, vxx * d.y - light.y * d.x) * v_inverse;
    vec2 push = vec2(sxx * e.x + sxy * e.y, sxy * e.x + syy * e.y);
    float pushed2 = max(dot(push, e), 0.0);
    return d + push * (2.5 * inversesqrt(max(pushed2, 6.25)));
}
const highp uint steradian_ltc_ggx_shape_words[512] = uint[512](
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
const highp uint steradian_ltc_ggx_magnitude_words[484] = uint[484](
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
vec4 steradian_ltc_ggx_shape_at(int k) {
    return vec4(unpackHalf2x16(steradian_ltc_ggx_shape_words[2 * k]), unpackHalf2x16(steradian_ltc_ggx_shape_words[2 * k + 1]));
}
vec4 steradian_ltc_ggx_shape(vec2 place) {
    vec2 x = clamp(place, 0.0, 1.0) * 15.0;
    vec2 node = min(floor(x), vec2(14.0, 14.0));
    vec2 f = x - node;
    int k = int(node.y) * 16 + int(node.x);
    vec4 low = mix(steradian_ltc_ggx_shape_at(k), steradian_ltc_ggx_shape_at(k + 1), f.x);
    vec4 high = mix(steradian_ltc_ggx_shape_at(k + 16), steradian_ltc_ggx_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}
vec2 steradian_ltc_ggx_magnitude_at(int k) { return unpackHalf2x16(steradian_ltc_ggx_magnitude_words[k]); }
vec2 steradian_ltc_ggx_magnitude(vec2 place) {
    vec2 x = clamp(place, 0.0, 1.0) * 21.0;
    vec2 node = min(floor(x), vec2(20.0, 20.0));
    vec2 f = x - node;
    int k = int(node.y) * 22 + int(node.x);
    vec2 low = mix(steradian_ltc_ggx_magnitude_at(k), steradian_ltc_ggx_magnitude_at(k + 1), f.x);
    vec2 high = mix(steradian_ltc_ggx_magnitude_at(k + 22), steradian_ltc_ggx_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}
const highp uint steradian_ltc_charlie_shape_words[512] = uint[512](
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
const highp uint steradian_ltc_charlie_magnitude_words[484] = uint[484](
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
vec4 steradian_ltc_charlie_shape_at(int k) {
    return vec4(unpackHalf2x16(steradian_ltc_charlie_shape_words[2 * k]), unpackHalf2x16(steradian_ltc_charlie_shape_words[2 * k + 1]));
}
vec4 steradian_ltc_charlie_shape(vec2 place) {
    vec2 x = clamp(place, 0.0, 1.0) * 15.0;
    vec2 node = min(floor(x), vec2(14.0, 14.0));
    vec2 f = x - node;
    int k = int(node.y) * 16 + int(node.x);
    vec4 low = mix(steradian_ltc_charlie_shape_at(k), steradian_ltc_charlie_shape_at(k + 1), f.x);
    vec4 high = mix(steradian_ltc_charlie_shape_at(k + 16), steradian_ltc_charlie_shape_at(k + 17), f.x);
    return mix(low, high, f.y);
}
vec2 steradian_ltc_charlie_magnitude_at(int k) { return unpackHalf2x16(steradian_ltc_charlie_magnitude_words[k]); }
vec2 steradian_ltc_charlie_magnitude(vec2 place) {
    vec2 x = clamp(place, 0.0, 1.0) * 21.0;
    vec2 node = min(floor(x), vec2(20.0, 20.0));
    vec2 f = x - node;
    int k = int(node.y) * 22 + int(node.x);
    vec2 low = mix(steradian_ltc_charlie_magnitude_at(k), steradian_ltc_charlie_magnitude_at(k + 1), f.x);
    vec2 high = mix(steradian_ltc_charlie_magnitude_at(k + 22), steradian_ltc_charlie_magnitude_at(k + 23), f.x);
    return mix(low, high, f.y);
}
struct SteradianCharlieCubature {
    SteradianCharlieLobe lobe;
    vec3 centre;
    float facing;
    float sum;
    float at_centre;
};
SteradianCharlieCubature steradian_charlie_cubature_begin(SteradianCharlieLobe lobe, vec3 e, float facing) {
    vec3 inward = e * facing;
    float length2 = dot(inward, inward);
    SteradianCharlieCubature c;
    c.lobe = lobe;
    c.centre = steradian_select(length2 > steradian_smallest_square(), inward * inversesqrt(max(length2, steradian_smallest_square())), vec3(0.0, 0.0, 1.0));
    c.facing = facing;
    c.sum = 0.0;
    c.at_centre = 0.0;
    return c;
}
SteradianCharlieCubature steradian_charlie_cubature_arc(SteradianCharlieCubature c, vec3 a, vec3 b) {
    SteradianCharlieCubature next = c;
    float cosine = dot(a, b);
    float n = 2.0 + steradian_select(cosine < 0.968912421710644784, 1.0, 0.0) + steradian_select(cosine < 0.696706709347165421, 1.0, 0.0);
    float fan = dot(c.centre, cross(a, b)) * c.facing;
    for (int j = 0; j < 4; j++) {
        bool present = n > float(j) + 0.5 && abs(fan) > 0.0;
        if (present) {
            vec2 rule = steradian_select(n > 3.5, steradian_gauss_legendre_node(4, j), steradian_select(n > 2.5, steradian_gauss_legendre_node(3, j), steradian_gauss_legendre_node(2, j)));
            vec3 u = a + (b - a) * rule.x;
            float inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
            vec3 rim = u * sqrt(inverse2);
            float rim_cosine = dot(rim, c.centre);
            vec3 aside = rim - c.centre * rim_cosine;
            vec3 outward = aside * inversesqrt(max(dot(aside, aside), steradian_smallest_divisor()));
            float weight = steradian_select(present, fan * inverse2 * rule.y / (1.0 + max(rim_cosine, -0.9)), 0.0);
            next.at_centre = next.at_centre + 0.0625 * weight;
            float radial = 0.328844319980059696 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.212340538239152943));
            radial = radial + 0.388193468843171893 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.590533135559265283));
            radial = radial + 0.220462211176768373 * steradian_charlie_lobe(c.lobe, steradian_fan_place(c.centre, outward, rim_cosine, 0.911412040487296148));
            next.sum = next.sum + weight * radial;
        }
    }
    return next;
}
SteradianCharlieCubature steradian_charlie_cubature_edge(SteradianCharlieCubature c, vec3 a, vec3 b) {
    bool wide = dot(a, b) < 0.0;
    vec3 middle = a + b;
    middle = steradian_select(wide, middle * inversesqrt(max(dot(middle, middle), steradian_smallest_divisor())), b);
    SteradianCharlieCubature next = steradian_charlie_cubature_arc(c, a, middle);
    if (wide) {
        next = steradian_charlie_cubature_arc(next, middle, b);
    }
    return next;
}
float steradian_charlie_cubature_finish(SteradianCharlieCubature c) {
    return max(c.sum + c.at_centre * steradian_charlie_lobe(c.lobe, c.centre), 0.0);
}
struct SteradianGgxView {
    vec3 v;
    vec3 w;
    float ax;
    float ay;
    float masking;
};
SteradianGgxView steradian_ggx_view(vec3 v, float ax, float ay) {
    SteradianGgxView view;
    float z = max(v.z, 1.0e-6);
    view.v = vec3(v.x, v.y, z);
    view.w = vec3(ax * v.x, ay * v.y, z);
    view.ax = ax;
    view.ay = ay;
    view.masking = sqrt(dot(view.w, view.w)) / z;
    return view;
}
SteradianConicArc steradian_ggx_edge_scaled(SteradianGgxView view, vec3 a, vec3 b) {
    vec3 chord = b - a;
    vec3 sum = a + b;
    float chord2 = dot(chord, chord);
    float sum2 = dot(sum, sum);
    bool usable = chord2 > steradian_smallest_divisor() && sum2 > 1.0e-12;
    vec3 middle = sum * inversesqrt(max(sum2, steradian_smallest_divisor()));
    vec3 along = chord * inversesqrt(max(chord2, steradian_smallest_square()));
    float half_sine = 0.5 * sqrt(chord2);
    float half_cosine = max(0.5 * sqrt(sum2), 1.0e-6);
    bool from_end = dot(middle, view.v) > 0.9;
    float side = steradian_select(from_end, steradian_select(dot(chord, view.v) > 0.0, -1.0, 1.0), 0.0);
    float turn_cosine = steradian_select(from_end, half_cosine, 1.0);
    vec3 base = middle * turn_cosine + along * (side * half_sine);
    vec3 q = along * turn_cosine - middle * (side * half_sine);
    float reach = steradian_select(usable, half_sine / (half_cosine + steradian_select(from_end, 0.0, 1.0)), 0.0);
    float x = 1.0 / view.ax;
    float y = 1.0 / view.ay;
    vec3 u0 = view.v + base;
    vec3 u2 = view.v - base;
    return steradian_conic_scaled(
        vec3(u0.x * x, u0.y * y, u0.z), vec3(q.x * x, q.y * y, q.z) * 2.0, vec3(u2.x * x, u2.y * y, u2.z),
        steradian_select(side < 0.0, 0.0, -reach), steradian_select(side > 0.0, 0.0, reach));
}
SteradianConicArc steradian_ggx_edge(SteradianGgxView view, vec3 a, vec3 b) {
    SteradianConicArc arc = steradian_ggx_edge_scaled(view, a, b);
    return steradian_conic_with_poles(arc, steradian_conic_poles(arc));
}
float steradian_ggx_unshadowed(SteradianGgxView view, vec3 e) {
    return max(dot(view.w, e), 0.0) * steradian_inverse_pi() / view.v.z;
}
vec2 steradian_ggx_lobe_and_fresnel(SteradianGgxView view, vec3 l, float smith) {
    vec3 h = steradian_microfacet_half_vector(l, view.v);
    float g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
    float plain = steradian_microfacet_lobe_unshadowed(steradian_ggx_distribution(h, view.ax, view.ay) * g, l, view.v);
    return vec2(plain, plain * steradian_fresnel_schlick(0.0, 1.0, dot(view.v, h)));
}
struct SteradianGgxCubature {
    SteradianGgxView view;
    vec3 centre;
    float amount;
    float extent;
    float smith;
    float facing;
    float weight;
    float centre_weight;
    vec2 weighted;
    vec2 at_centre;
    vec2 lowest;
    vec2 highest;
};
vec2 steradian_ggx_shadowing_and_fresnel(SteradianGgxView view, vec3 u, float smith) {
    vec3 h = vec3(view.ax * u.x, view.ay * u.y, u.z);
    h = h * inversesqrt(max(dot(h, h), steradian_smallest_divisor()));
    float v_dot_h = clamp(dot(view.v, h), 0.0, 1.0);
    vec3 l = h * (2.0 * v_dot_h) - view.v;
    float lz = max(l.z, 0.0);
    float shadowing = 2.0 * lz / max(lz * view.masking + steradian_ggx_stretched_length(l, view.ax, view.ay), steradian_smallest_divisor());
    float g = steradian_select(l.z > 0.0, 1.0 + smith * (shadowing - 1.0), 0.0);
    float x = 1.0 - v_dot_h;
    float x2 = x * x;
    return vec2(g, g * (x2 * x2 * x));
}
SteradianGgxCubature steradian_ggx_cubature_begin(SteradianGgxView view, vec3 e, float smith, float facing) {
    SteradianGgxCubature c;
    vec3 inward = e * facing;
    float length2 = dot(inward, inward);
    bool usable = length2 > steradian_smallest_square();
    c.view = view;
    c.centre = steradian_select(usable, inward * inversesqrt(max(length2, steradian_smallest_square())), vec3(0.0, 0.0, 1.0));
    c.amount = steradian_select(usable, steradian_ggx_unshadowed(view, inward), 0.0);
    c.extent = sqrt(length2);
    c.smith = smith;
    c.facing = facing;
    c.weight = 0.0;
    c.centre_weight = 0.0;
    c.weighted = vec2(0.0, 0.0);
    c.at_centre = steradian_ggx_shadowing_and_fresnel(view, c.centre, smith);
    c.lowest = c.at_centre;
    c.highest = c.at_centre;
    return c;
}
SteradianGgxCubature steradian_ggx_cubature_add(SteradianGgxCubature c, vec3 u, float weight) {
    SteradianGgxCubature next = c;
    float o = weight * max(dot(c.view.w, u), 0.0);
    vec2 g = steradian_ggx_shadowing_and_fresnel(c.view, u, c.smith);
    bool counts = abs(o) > 0.0;
    next.weight = c.weight + o;
    next.weighted = c.weighted + g * o;
    next.lowest = steradian_select(counts, vec2(min(c.lowest.x, g.x), min(c.lowest.y, g.y)), c.lowest);
    next.highest = steradian_select(counts, vec2(max(c.highest.x, g.x), max(c.highest.y, g.y)), c.highest);
    return next;
}
vec2 steradian_ggx_rule(float n, int j, int most) {
    vec2 r = steradian_gauss_legendre_node(1, j);
    for (int k = 2; k <= most; k++) {
        r = steradian_select(n > float(k) - 0.5, steradian_gauss_legendre_node(k, j), r);
    }
    return r;
}
SteradianGgxCubature steradian_ggx_cubature_edge(SteradianGgxCubature c, SteradianConicArc edge, int extra) {
    SteradianGgxCubature next = c;
    float total = edge.sweep.x + edge.sweep.y;
    float n = 1.0 + steradian_select(total < 0.25, 0.0, 1.0) + steradian_select(total < 0.8, 0.0, 1.0) + steradian_select(total < 1.6, 0.0, 1.0) + float(extra);
    bool fine = total >= 0.5;
    if (extra > 0) {
        fine = total > -1.0;
    }
    bool wide = c.extent > 0.3 && max(c.view.ax, c.view.ay) > 0.08;
    for (int j = 0; j < 4 + extra; j++) {
        bool present = n > float(j) + 0.5 && total > 0.0;
        vec2 rule = steradian_ggx_rule(n, j, 4 + extra);
        SteradianConicNode node = steradian_conic_node(edge, rule.x);
        vec3 u = edge.u0 + (edge.u1 + edge.u2 * node.tau) * node.tau;
        vec3 du = edge.u1 + edge.u2 * (2.0 * node.tau);
        float inverse2 = 1.0 / max(dot(u, u), steradian_smallest_divisor());
        vec3 rim = u * sqrt(inverse2);
        float rim_cosine = dot(rim, c.centre);
        vec3 out_of_centre = rim - c.centre * rim_cosine;
        vec3 outward = out_of_centre * inversesqrt(max(dot(out_of_centre, out_of_centre), steradian_smallest_divisor()));
        float om = dot(c.centre, cross(u, du)) * (c.facing * inverse2 * rule.y * total / node.density)
            / (1.0 + max(rim_cosine, -0.9));  
        om = steradian_select(present, om, 0.0);
        next.centre_weight = next.centre_weight + om * steradian_select(wide, 0.04, steradian_select(fine, 0.111111111111111111, 0.25));
        int turns = 1;
        if (fine && present) {
            turns = 2;
        }
        if (wide && present) {
            turns = 4;
        }
        for (int k = 0; k < turns; k++) {
            float share = steradian_select(wide, 0.139759864343780571, steradian_select(fine, 0.355051025721682190, 0.666666666666666667));
            float share_weight = steradian_select(wide, 0.223103901083570916, steradian_select(fine, 0.512485826188421615, 0.75));
            if (k == 1) {
                share = steradian_select(wide, 0.416409567631083166, 0.844948974278317810);
                share_weight = steradian_select(wide, 0.311826522975741250, steradian_select(fine, 0.376403062700467274, 0.0));
            }
            if (k == 2) {
                share = 0.723156986361876117;
                share_weight = steradian_select(wide, 0.281356015149461949, 0.0);
            }
            if (k == 3) {
                share = 0.942895803885482318;
                share_weight = steradian_select(wide, 0.143713560791225886, 0.0);
            }
            next = steradian_ggx_cubature_add(next, steradian_fan_place(c.centre, outward, rim_cosine, share), om * share_weight);
            if (k + 1 == turns) {
                break;
            }
        }
        if (!(present && n > float(j) + 1.5)) {
            break;
        }
    }
    return next;
}
vec2 steradian_ggx_limited(float amount, vec2 mean, float smith) {
    float whole = amount * mean.x;
    whole = steradian_select(smith > 0.5, min(whole, 1.0), whole);
    return vec2(whole, clamp(amount * mean.y, 0.0, whole));
}
vec2 steradian_ggx_cubature_finish(SteradianGgxCubature c) {
    float o = c.centre_weight * max(dot(c.view.w, c.centre), 0.0);
    float weight = c.weight + o;
    bool usable = weight > 1.0e-9 * c.extent;
    float scale = 1.0 / steradian_select(usable, weight, 1.0);
    vec2 mean = (c.weighted + c.at_centre * o) * scale;
    mean = vec2(clamp(mean.x, c.lowest.x, c.highest.x), clamp(mean.y, c.lowest.y, c.highest.y));
    mean = steradian_select(usable, mean, c.at_centre);
    return steradian_ggx_limited(c.amount, mean, c.smith);
}
vec2 steradian_ggx_draft(SteradianGgxView view, vec3 e, float smith, float facing) {
    SteradianGgxCubature c = steradian_ggx_cubature_begin(view, e, smith, facing);
    return steradian_ggx_limited(c.amount, c.at_centre, smith);
}
float steradian_ggx_radiance(vec2 r, float f0, float f90) {
    return f0 * (r.x - r.y) + f90 * r.y;
}
float steradian_blinn_phong_alpha(float n) {
    return sqrt(2.0 / (n + 2.0));
}
vec3 steradian_half_vector_at(SteradianGgxView view, SteradianConicArc edge, float tau) {
    vec3 u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    vec3 h = vec3(view.ax * u.x, view.ay * u.y, u.z);
    return h * inversesqrt(max(dot(h, h), steradian_smallest_divisor()));
}
float steradian_half_vector_split_uniform(SteradianConicArc edge, float share) {
    float first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    float last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    vec2 u = steradian_complex_unit(first + share * (last - first));
    return clamp(u.y / max(u.x * edge.scale, steradian_smallest_length()), edge.begin, edge.end);
}
float steradian_half_vector_split_pole_mapped(SteradianConicArc edge, float share) {
    float first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    float last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    float weight = 0.3 / max(last - first, 1.0e-12);
    float total = edge.sweep.x + edge.sweep.y + 0.3;
    float tolerance = 2.0e-6;
    SteradianConicNode node = steradian_conic_node(edge, share);
    float tau = node.tau;
    float low = edge.begin;
    float high = edge.end;
    float left = total;
    bool off = edge.end > edge.begin;
    for (int i = 0; i < 24; i++) {
        if (off) {
            float t = edge.scale * tau;
            float value = steradian_conic_sweep(edge.z1, edge.begin, tau) + steradian_conic_sweep(edge.z2, edge.begin, tau)
                + weight * (steradian_trig_atan2(t, 1.0) - first) - share * total;
            float x1 = tau - edge.z1.x;
            float x2 = tau - edge.z2.x;
            float slope = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
                + weight * edge.scale / (1.0 + t * t);
            low = steradian_select(value < 0.0, tau, low);
            high = steradian_select(value < 0.0, high, tau);
            float next = tau - value / slope;
            bool fast = next > low && next < high && abs(value) < 0.5 * left;
            off = off && abs(value) > tolerance * total;
            left = abs(value);
            tau = steradian_select(off, steradian_select(fast, next, 0.5 * (low + high)), tau);
        }
    }
    return tau;
}
float steradian_half_vector_split_weight(SteradianConicArc edge) {
    float first = steradian_trig_atan2(edge.scale * edge.begin, 1.0);
    float last = steradian_trig_atan2(edge.scale * edge.end, 1.0);
    return 0.3 / max(last - first, 1.0e-12);
}
SteradianConicNode steradian_half_vector_split_end(SteradianConicArc edge, float tau, float weight) {
    float t = edge.scale * tau;
    float x1 = tau - edge.z1.x;
    float x2 = tau - edge.z2.x;
    SteradianConicNode node;
    node.tau = tau;
    node.density = edge.z1.y / (x1 * x1 + edge.z1.y * edge.z1.y) + edge.z2.y / (x2 * x2 + edge.z2.y * edge.z2.y)
        + weight * edge.scale / (1.0 + t * t);
    return node;
}
struct SteradianHalfVectorNode {
    vec3 h;
    float solid_angle;
};
SteradianHalfVectorNode steradian_half_vector_between(SteradianGgxView view, SteradianConicArc edge, SteradianConicNode first, SteradianConicNode last, vec3 a, vec3 b, vec2 rule) {
    float bend = sqrt(first.density / max(last.density, steradian_smallest_divisor()));
    float bottom = 1.0 / (rule.x + bend * (1.0 - rule.x));
    float length = last.tau - first.tau;
    float tau = first.tau + length * rule.x * bottom;
    float step = length * bend * bottom * bottom * rule.y;
    vec3 u = edge.u0 + (edge.u1 + edge.u2 * tau) * tau;
    vec3 du = edge.u1 + edge.u2 * (2.0 * tau);
    vec3 x = vec3(view.ax * u.x, view.ay * u.y, u.z);
    vec3 dx = vec3(view.ax * du.x, view.ay * du.y, du.z);
    float inverse = inversesqrt(max(dot(x, x), steradian_smallest_divisor()));
    x = x * inverse;
    vec3 n = cross(a, b - a);
    float n2 = dot(n, n);
    n = n * inversesqrt(max(n2, steradian_smallest_square()));
    float apart = dot(n, x - a);
    vec3 middle = x - n * (0.5 * apart);
    float shorter = inversesqrt(max(dot(middle, middle), steradian_smallest_divisor()));
    float sweep = dot(n, cross(x, dx)) * inverse * step;
    SteradianHalfVectorNode node;
    node.h = middle * shorter;
    node.solid_angle = steradian_select(n2 > steradian_smallest_square(), -apart * sweep * (shorter * shorter * shorter), 0.0);
    return node;
}
struct SteradianHalfVectorWalk {
    float weight;
    SteradianConicNode first;
    SteradianConicNode last;
    vec3 a;
    vec3 b;
};
SteradianHalfVectorWalk steradian_half_vector_begin(SteradianGgxView view, SteradianConicArc edge) {
    SteradianHalfVectorWalk walk;
    walk.weight = steradian_half_vector_split_weight(edge);
    walk.last = steradian_half_vector_split_end(edge, edge.begin, walk.weight);
    walk.b = steradian_half_vector_at(view, edge, edge.begin);
    walk.first = walk.last;
    walk.a = walk.b;
    return walk;
}
SteradianHalfVectorWalk steradian_half_vector_next(SteradianHalfVectorWalk walk, SteradianGgxView view, SteradianConicArc edge, float tau) {
    SteradianHalfVectorWalk next = walk;
    next.first = walk.last;
    next.a = walk.b;
    next.last = steradian_half_vector_split_end(edge, tau, walk.weight);
    next.b = steradian_half_vector_at(view, edge, tau);
    return next;
}
int steradian_half_vector_nodes() { return 4; }
SteradianHalfVectorNode steradian_half_vector_node(SteradianHalfVectorWalk walk, SteradianGgxView view, SteradianConicArc edge, int i) {
    vec2 rule = steradian_gauss_legendre_node(steradian_half_vector_nodes(), i);
    return steradian_half_vector_between(view, edge, walk.first, walk.last, walk.a, walk.b, rule);
}
float steradian_blinn_phong_at_half_vector(vec3 h, vec3 v, float n) {
    return 2.0 * steradian_pi() * steradian_blinn_phong_distribution(h, n) * max(dot(h, v), 0.0);
}
float steradian_beckmann_at_half_vector(SteradianGgxView view, vec3 h) {
    return 2.0 * steradian_pi() * steradian_beckmann_distribution(h, view.ax, view.ay) * max(dot(h, view.v), 0.0);
}
vec3 steradian_ggx_at_half_vector(SteradianGgxView view, vec3 h) {
    vec3 u = vec3(h.x / view.ax, h.y / view.ay, h.z);
    float inverse2 = 1.0 / dot(u, u);
    return u * ((inverse2 / view.ax) * (inverse2 / view.ay));
}
float steradian_blinn_phong_arc(vec3 a, vec3 b, vec3 v, float n) {
    vec3 z = vec3(0.0, 0.0, 1.0);
    SteradianMomentEdge edge = steradian_moment_edge(a, b, z);
    SteradianMomentIntegrands front = steradian_moment_quadrature_front(edge, max(n, 1.0e-6) - 1.0);
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front.moment), front.power);
}
float steradian_blinn_phong_arc_approximate(vec3 a, vec3 b, vec3 v, SteradianMomentSeries series, float n, int range) {
    vec3 z = vec3(0.0, 0.0, 1.0);
    SteradianMomentEdge edge = steradian_moment_edge(a, b, z);
    float front = 0.0;
    if (range == 2) {
        front = steradian_moment_series_low_front(edge, series, n - 1.0);
    } else {
        front = steradian_moment_series_front(edge, series);
    }
    int low = 0;
    if (range > 0) {
        low = 1;
    }
    return steradian_moment_double_axis_share(a, b, z, v, steradian_moment_edge_share(edge, front), steradian_moment_cosine_front(edge, n, low));
}
float steradian_beckmann_error_function_approximate(float x) {
    float t = abs(x);
    float e = 1.0 / (1.0 + 0.3275911 * t);
    float p = ((((1.061405429 * e - 1.453152027) * e + 1.421413741) * e - 0.284496736) * e + 0.254829592) * e;
    float y = 1.0 - p * exp(-min(t * t, 80.0));
    return steradian_select(x < 0.0, -y, y);
}
SteradianMomentSeriesHigh steradian_beckmann_series() {
    SteradianMomentSeriesHigh series = steradian_moment_series_high_prepare(1.0e30);
    series.m = 2.0;  
    return series;
}
float steradian_beckmann_arc(SteradianGgxView view, vec3 a, vec3 b, SteradianMomentSeriesHigh series) {
    float za = 1.0 / max(a.z, 1.0e-6);
    float zb = 1.0 / max(b.z, 1.0e-6);
    vec2 p = vec2(a.x * za / view.ax, a.y * za / view.ay);
    vec2 q = vec2(b.x * zb / view.ax, b.y * zb / view.ay);
    vec2 along = q - p;
    float length2 = dot(along, along);
    bool usable = length2 > steradian_smallest_divisor();
    along = along * inversesqrt(max(length2, steradian_smallest_divisor()));
    float d = p.x * along.y - p.y * along.x;
    float low = dot(p, along);
    float high = dot(q, along);
    SteradianMomentEdge edge;
    edge.side = steradian_select(d < 0.0, -1.0, 1.0);
    edge.s = max(abs(d), 1.0e-6);
    edge.c = 1.0;
    edge.x0 = 1.0;
    edge.y0 = low;
    edge.x1 = 1.0;
    edge.y1 = high;
    edge.log_c = min(edge.s * edge.s, 80.0);
    edge.swept = 0.0;
    float around = steradian_moment_edge_share(edge, steradian_moment_series_high_front(edge, series));
    float across = exp(-edge.log_c) * 0.886226925452758014
        * (steradian_beckmann_error_function_approximate(high) - steradian_beckmann_error_function_approximate(low));
    float share = view.w.z * around + (view.w.y * along.x - view.w.x * along.y) * across;
    return steradian_select(usable, share, 0.0);
}
vec3 steradian_ggx_arc(SteradianGgxView view, vec3 a, vec3 b) {
    vec3 p = steradian_polygon_direction(vec3(a.x / view.ax, a.y / view.ay, a.z));
    vec3 q = steradian_polygon_direction(vec3(b.x / view.ax, b.y / view.ay, b.z));
    return steradian_polygon_edge(p, q);
}
float steradian_half_vector_radiance(SteradianGgxView view, float sum, float facing) {
    return max(sum * facing, 0.0) * steradian_inverse_two_pi() / view.v.z;
}
struct SteradianEdgeSlopes {
    vec3 normal;
    float by_start;
    float by_end;
};
struct SteradianEdgeSlopesOfBoth {
    vec3 normal;
    vec2 by_start;
    vec2 by_end;
    vec3 turn;
    vec3 turn_of_fresnel;
};
SteradianEdgeSlopes steradian_edge_irradiance_slopes(vec3 start, vec3 end) {
    SteradianEdgeSlopes slopes;
    slopes.normal = cross(start, end - start);
    float c = dot(start, end);
    vec2 half_angle = steradian_trig_angle_over_sine_and_slope(c, dot(slopes.normal, slopes.normal)) * 0.5;
    float q = half_angle.y;
    float p = half_angle.x - c * q;
    slopes.by_start = -(start.z * p + end.z * q);
    slopes.by_end = -(end.z * p + start.z * q);
    return slopes;
}
SteradianEdgeSlopes steradian_edge_slopes_of_whole(SteradianEdgePart part, SteradianEdgeSlopes of_part) {
    SteradianEdgeSlopes slopes = of_part;
    if (part.rises || part.sinks) {
        slopes.by_start = part.start_a * of_part.by_start + part.end_a * of_part.by_end;
        slopes.by_end = part.start_b * of_part.by_start + part.end_b * of_part.by_end;
    }
    return slopes;
}
SteradianEdgeSlopes steradian_polygon_part_slopes(SteradianEdgePart part) {
    return steradian_edge_slopes_of_whole(part, steradian_edge_irradiance_slopes(part.start, part.end));
}
SteradianEdgeSlopes steradian_polygon_edge_slopes(vec3 a, vec3 b) {
    return steradian_polygon_part_slopes(steradian_edge_above_horizon(a, b));
}
SteradianEdgeSlopes steradian_ltc_part_slopes(SteradianEdgePart part, SteradianEdgePart lobe_part) {
    SteradianEdgeSlopes slopes = steradian_edge_slopes_of_whole(part, steradian_polygon_part_slopes(lobe_part));
    slopes.normal = slopes.normal * steradian_inverse_pi();
    return slopes;
}
SteradianEdgeSlopes steradian_ltc_edge_slopes(SteradianLtcMatrix m, vec3 a, vec3 b) {
    SteradianEdgePart part = steradian_ltc_part(m, a, b, steradian_ltc_direction(m, a), steradian_ltc_direction(m, b));
    return steradian_ltc_part_slopes(part, steradian_edge_above_horizon(part.start, part.end));
}
vec3 steradian_ltc_edge_transform_back(SteradianLtcMatrix m, vec3 v, vec3 g) {
    vec3 under = steradian_ltc_transform(m, v);
    return steradian_ltc_transform_transposed(m, g * inversesqrt(max(dot(under, under), steradian_smallest_square())));
}
SteradianEdgeSlopes steradian_phong_part_slopes(SteradianEdgePart part, vec3 r, float n, int low) {
    vec3 sum = part.start + part.end;
    vec3 chord = part.end - part.start;
    float chord2 = dot(chord, chord);
    float sum_inverse = inversesqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    float chord_inverse = inversesqrt(max(chord2, steradian_smallest_divisor()));
    float axis_middle = dot(r, sum) * sum_inverse;
    float axis_along = dot(r, chord) * chord_inverse;
    float m = n + 1.0;
    float even = 0.0;
    float odd = 0.0;
    bool is_short = chord2 * m < 4.0 && chord2 < 1.0 && dot(r, part.start) > 0.0 && dot(r, part.end) > 0.0;
    if (is_short) {
        float half_tangent = sum_inverse * chord2 * chord_inverse;
        for (int i = 0; i < 4; i++) {
            vec2 rule = steradian_gauss_legendre_node(4, i);
            float u = half_tangent * (2.0 * rule.x - 1.0);
            float cosine = inversesqrt(1.0 + u * u);
            float x = (axis_middle + axis_along * u) * cosine;
            float w = 2.0 * half_tangent * rule.y * steradian_phong_power(x, n) * cosine * cosine * cosine;
            even = even + w;
            odd = odd + w * u;
        }
    }
    if (!is_short) {
        SteradianMomentEdge edge = steradian_moment_edge(part.start, part.end, r);
        float towards = steradian_moment_cosine_front(edge, m, low);
        float across = (steradian_phong_power(edge.x0, m) - steradian_phong_power(edge.x1, m)) / m;
        float over_c2 = 1.0 / (edge.c * edge.c);
        even = steradian_select(is_short, even, (towards * axis_middle - across * axis_along) * over_c2);
        odd = steradian_select(is_short, odd, (towards * axis_along + across * axis_middle) * over_c2);
    }
    SteradianEdgeSlopes of_part;
    of_part.normal = cross(part.start, chord);
    float n2 = dot(of_part.normal, of_part.normal);
    float scale = steradian_select(n2 > steradian_smallest_divisor(), -m * steradian_inverse_two_pi() * inversesqrt(max(n2, steradian_smallest_divisor())), 0.0);
    even = even * sum_inverse;
    odd = odd * chord_inverse;
    of_part.by_start = (even - odd) * scale;
    of_part.by_end = (even + odd) * scale;
    return steradian_edge_slopes_of_whole(part, of_part);
}
SteradianEdgeSlopes steradian_phong_edge_slopes(vec3 a, vec3 b, vec3 r, float n, int low) {
    return steradian_phong_part_slopes(steradian_edge_above_horizon(a, b), r, n, low);
}
SteradianEdgeSlopesOfBoth steradian_ggx_edge_slopes_of_part(SteradianGgxView view, SteradianEdgePart part, SteradianConicArc arc, float smith, int nodes, int pieces) {
    vec3 sum = part.start + part.end;
    vec3 chord = part.end - part.start;
    float sum_inverse = inversesqrt(max(dot(sum, sum), steradian_smallest_divisor()));
    float chord_inverse = inversesqrt(max(dot(chord, chord), steradian_smallest_divisor()));
    float half_cosine = 0.5 / sum_inverse;
    float half_sine = 0.5 / chord_inverse;
    bool from_start = !(arc.begin < 0.0);
    bool from_end = !(arc.end > 0.0);
    vec2 base = vec2(steradian_select(from_start || from_end, half_cosine, 1.0), steradian_select(from_start, -half_sine, steradian_select(from_end, half_sine, 0.0)));
    vec3 n = cross(part.start, chord);
    vec3 across = n * inversesqrt(max(dot(n, n), steradian_smallest_divisor()));
    vec2 even = vec2(0.0, 0.0);
    vec2 odd = vec2(0.0, 0.0);
    vec3 turn = vec3(0.0, 0.0, 0.0);
    vec3 turn_of_fresnel = vec3(0.0, 0.0, 0.0);
    float total = arc.sweep.x + arc.sweep.y;
    float share = 1.0 / float(pieces);
    for (int i = 0; i < pieces; i++) {
        for (int j = 0; j < nodes; j++) {
            vec2 rule = steradian_gauss_legendre_node(nodes, j);
            SteradianConicNode node = steradian_conic_node(arc, (rule.x + float(i)) * share);
            vec3 u = arc.u0 + (arc.u1 + arc.u2 * node.tau) * node.tau;
            vec3 p = vec3(u.x * view.ax, u.y * view.ay, u.z);  
            float p2 = max(dot(p, p), steradian_smallest_divisor());
            float along = dot(p, view.v);
            float u2 = max(dot(u, u), steradian_smallest_divisor());
            vec3 l = p * (2.0 * along / p2) - view.v;
            float g = 1.0 + smith * (steradian_ggx_shadowing(l, view.v, view.ax, view.ay) - 1.0);
            float w = (p2 / u2) * (along / u2) * g * rule.y * share * total / max(node.density, steradian_smallest_divisor());
            float p_inverse = inversesqrt(p2);
            vec2 both = vec2(w, w * steradian_fresnel_schlick(0.0, 1.0, along * p_inverse));
            vec3 h = p * p_inverse;
            vec3 moved = h * (2.0 * dot(across, h)) - across;
            turn = turn + moved * both.x;
            turn_of_fresnel = turn_of_fresnel + moved * both.y;
            float t = node.tau * arc.scale;
            float d = 1.0 / (1.0 + t * t);
            vec2 angle = steradian_complex_product(base, vec2((1.0 - t * t) * d, 2.0 * t * d));
            even = even + both * (angle.x * sum_inverse);
            odd = odd + both * (angle.y * chord_inverse);
        }
    }
    float density = arc.scale * steradian_inverse_pi() / (view.ax * view.ay * view.v.z);
    density = steradian_select(arc.end > arc.begin, density, 0.0);
    float scale = -density * inversesqrt(max(dot(n, n), steradian_smallest_divisor()));
    vec2 by_part_start = (even - odd) * scale;
    vec2 by_part_end = (even + odd) * scale;
    SteradianEdgeSlopesOfBoth slopes;
    slopes.normal = n;
    slopes.by_start = by_part_start * part.start_a + by_part_end * part.end_a;
    slopes.by_end = by_part_start * part.start_b + by_part_end * part.end_b;
    slopes.turn = turn * density;
    slopes.turn_of_fresnel = turn_of_fresnel * density;
    return slopes;
}
SteradianEdgeSlopesOfBoth steradian_ggx_edge_slopes(SteradianGgxView view, vec3 a, vec3 b, float smith, int nodes, int pieces) {
    SteradianEdgePart part = steradian_edge_above_horizon(a, b);
    return steradian_ggx_edge_slopes_of_part(view, part, steradian_ggx_edge(view, part.start, part.end), smith, nodes, pieces);
}
`;
