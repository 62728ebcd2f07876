// Measured lamps from the host (source/device/direct/light_records.cpp): a head (type, numbers of vertical and horizontal angles),
// then the angles in degrees and the measured values, four numbers a vector.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

float profile_number(int first, int i) { return details[first + 1 + (i >> 2)][i & 3]; }

// Finds the two of `count` rising angles, from number `begin` on, between which a value lies. Returns the first, or -1 if the value is not
// within them, and the fraction of the way to the second.
vec2 profile_place(int first, int begin, int count, float at) {
    if (count == 1) return vec2(0.0);
    float rounding = 1.0e-4;
    if (at < profile_number(first, begin) - rounding || at > profile_number(first, begin + count - 1) + rounding)
        return vec2(-1.0, 0.0);
    int low = 0;
    int high = count - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (profile_number(first, begin + middle) <= at)
            low = middle;
        else
            high = middle;
    }
    float from = profile_number(first, begin + low);
    float share = (at - from) / (profile_number(first, begin + high) - from);
    return vec2(float(low), clamp(share, 0.0, 1.0));
}

// Intensity in candela in a direction of the profile's frame.
float profile_intensity(int first, vec3 d) {
    vec4 head = details[first];
    int verticals = int(head.y);
    int horizontals = int(head.z);
    float degree = 180.0 * inverse_pi();
    float pole = 1.0e-6;
    float across = length(d.xy);
    float vertical = trig_atan2(across, d.z) * degree;
    float horizontal = across > pole * abs(d.z) ? trig_atan2(d.y, d.x) * degree : 0.0;
    if (horizontal < 0.0) horizontal += 360.0;
    if (head.x > 0.5) {  // type b
        across = length(d.xz);
        vertical = across > pole * abs(d.y) ? trig_atan2(d.x, d.z) * degree : 0.0;
        horizontal = trig_atan2(-d.y, across) * degree;
    }
    vec2 v = profile_place(first, 0, verticals, vertical);
    vec2 h = profile_place(first, verticals, horizontals, horizontal);
    if (v.x < 0.0 || h.x < 0.0) return 0.0;
    int candela = verticals + horizontals;
    vec2 along = vec2(0.0);
    for (int k = 0; k < 2; k++) {
        int plane = candela + min(int(h.x) + k, horizontals - 1) * verticals;
        float low = profile_number(first, plane + int(v.x));
        along[k] = mix(low, profile_number(first, plane + min(int(v.x) + 1, verticals - 1)), v.y);
    }
    return mix(along.x, along.y, h.y);
}
