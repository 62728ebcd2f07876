// Lights from the host (source/device/direct/light_records.cpp), and how a point sees them.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// One light.
//   r[0]  radiance (of a punctual light: intensity); number of the first vertex
//   r[1]  normal to the lit side; 1 where both sides are lit
//   r[2]  polygon: a point of its plane, number of places of its outline; others: centre, end_a or position; radius of a ball or
//         capsule, 1 / range^2
//   r[3]  polygon: middle, deviation squared; others: axis x, end_b or direction; spot_scale
//   r[4]  polygon: reach_a; others: axis y, half axis of a capsule; spot_offset
//   r[5]  polygon: reach_b; others: axis z
//   r[6]  polygon: area; ellipsoid: row x of the inverse; r[7], r[8]: its rows y and z; punctual: x and y of
//         the profile's frame, in r[7] its aim; r[7].w: place where the texture or profile begins; polygon, disk with a profile: r[8] the
//         intensity to which its candela refer, over the area
struct Light {
    vec4 r[kRecord];
};

//   number   the same for all threads of the group (entry.glsl)
Light light_at(uint number) {
    Light light;
    int first = int(in_common(number)) * kRecord;
    for (int i = 0; i < kRecord; i++) light.r[i] = lights[first + i];
    return light;
}

struct Seen {
    bool lit;
    bool reversed;
};

// The outline of a disk or an ellipsoid: see() computes it.
EllipsoidOutline round_outline;

EllipsoidOutline round_outline_from(Light light, vec3 p) {
    if (KIND == kDisk) {
        EllipsoidOutline outline;
        outline.center = light.r[2].xyz - p;
        outline.axis_a = light.r[3].xyz;
        outline.axis_b = light.r[4].xyz;
        outline.outside = true;
        return outline;
    }
    mat3 axes = mat3(light.r[3].xyz, light.r[4].xyz, light.r[5].xyz);
    mat3 inverse_axes = transpose(mat3(light.r[6].xyz, light.r[7].xyz, light.r[8].xyz));
    return ellipsoid_outline(light.r[2].xyz - p, axes, inverse_axes);
}

Ellipse ellipse_in(mat3 frame) { return ellipse_in_units(frame, round_outline.center, round_outline.axis_a, round_outline.axis_b); }

Capsule capsule_between(vec3 end_a, vec3 end_b, float radius, mat3 frame, vec3 p) {
    return capsule_in_units(transform_transposed(frame, end_a - p), transform_transposed(frame, end_b - p), radius);
}

Capsule capsule_in(Light light, mat3 frame, vec3 p) {
    return capsule_between(light.r[2].xyz, light.r[3].xyz, light.r[2].w, frame, p);
}

Seen see(Light light, vec3 p) {
    Seen seen;
    seen.reversed = false;
    if (KIND == kDisk || KIND == kEllipsoid) round_outline = round_outline_from(light, p);
    if (UNCUT || KIND == kPunctual || by_pieces()) {
        seen.lit = true;
    } else if (KIND == kPolygon || KIND == kDisk) {
        float height = dot(p - light.r[2].xyz, light.r[1].xyz);
        bool behind = height < 0.0;
        // Nearer to the plane than rounding, the light has no side: see_plane in source/shapes/polygon.h.
        bool apart = height * height > 1.8189894e-12 * (dot(p, p) + dot(light.r[2].xyz, light.r[2].xyz));
        seen.lit = apart && (!behind || light.r[1].w > 0.5);
        if (KIND == kPolygon) seen.reversed = behind;  // a disk's outline is always walked as it appears
    } else if (KIND == kEllipsoid) {
        seen.lit = round_outline.outside;
    } else {
        seen.lit = capsule_in(light, mat3(1.0), p).outside;
    }
    return seen;
}

// Mean square of the light's extent about its middle [m2]; for a round light, an upper bound.
float deviation2_of(Light light) {
    if (by_pieces()) return parts[part.first + 1].w;
    if (KIND == kPolygon) return light.r[3].w;
    if (KIND == kDisk) return (dot(light.r[3].xyz, light.r[3].xyz) + dot(light.r[4].xyz, light.r[4].xyz)) / 4.0;
    if (KIND == kEllipsoid)
        return dot(light.r[3].xyz, light.r[3].xyz) + dot(light.r[4].xyz, light.r[4].xyz) + dot(light.r[5].xyz, light.r[5].xyz);
    return dot(light.r[4].xyz, light.r[4].xyz) + light.r[2].w * light.r[2].w;
}

float distance2_of(Light light, vec3 p) {
    vec3 to = light.r[2].xyz - p;
    if (KIND == kPolygon) to = light.r[3].xyz - p;
    if (by_pieces()) to = parts[part.first].xyz;
    if (KIND == kCapsule) to = (light.r[2].xyz + light.r[3].xyz) * 0.5 - p;
    return dot(to, to);
}

// Elements in the shading frame, of the visible side.
LightElements elements_in(Light light, Seen seen, mat3 frame, vec3 p) {
    LightElements e;
    if (by_pieces()) {
        e.center = parts[part.first].xyz;
        e.reach_a = parts[part.first + 1].xyz;
        e.reach_b = parts[part.first + 2].xyz;
        e.area = parts[part.first + 3].xyz;
    } else if (KIND == kPolygon) {
        e.center = light.r[3].xyz - p;
        e.reach_a = light.r[4].xyz;
        e.reach_b = light.r[5].xyz;
        e.area = light.r[6].xyz * (seen.reversed ? -1.0 : 1.0);
    } else if (KIND == kCapsule) {
        e = capsule_elements((light.r[2].xyz - p + (light.r[3].xyz - p)) * 0.5, light.r[4].xyz * 2.0, light.r[2].w);
    } else {
        e = ellipse_elements(ellipse_prepare(round_outline.center, round_outline.axis_a, round_outline.axis_b));
    }
    e.center = transform_transposed(frame, e.center);
    e.reach_a = transform_transposed(frame, e.reach_a);
    e.reach_b = transform_transposed(frame, e.reach_b);
    e.area = transform_transposed(frame, e.area);
    return e;
}

// Returns true if four elements serve in place of an outline whose integral has these limits.
bool elements_serve(LightElements e, float sharpness, LightElementsLimits limits) {
    return light_elements_serve(e, vec3(0.0, 0.0, 1.0), sharpness, limits.roundings, limits.bias);
}
bool may_be_small(Light light, vec3 p, LightElementsLimits limits) {
    return CAREFUL && distance2_of(light, p) > deviation2_of(light) * limits.least_distance2;
}
