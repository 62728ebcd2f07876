// Texture look-up: the mean over the footprint of a pixel.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Coordinates, and their change to the next pixels.
struct Footprint {
    vec2 at;
    vec2 right;
    vec2 down;
};

// Uses the host's table: the powers of devices are less accurate.
float linear_from_srgb(float c) {
    int code = int(c * 255.0 + 0.5);
    return texelFetch(materials, code >> 2)[code & 3];
}

int wrapped(int i, int size, int wrap) {
    if (wrap == 0) return i < 0 ? size - 1 : i >= size ? 0 : i;
    return clamp(i, 0, size - 1);
}
float folded(float u, int wrap) {
    if (wrap == 0) u -= floor(u);
    if (wrap == 1) {
        u -= 2.0 * floor(u * 0.5);
        u = min(u, 2.0 - u);
    }
    return clamp(u, 0.0, 1.0);
}

vec4 texel_at(int first, int width, ivec2 at, bool srgb) {
    vec4 c = texelFetch(texels, first + at.y * width + at.x);
    return srgb ? vec4(linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z), c.w) : c;
}

// Bilinear look-up in a level, at coordinates from 0 to 1 over the picture.
vec4 bilinear(int level, vec2 uv, int flags) {
    vec4 record = texelFetch(materials, level);
    int first = int(record.x) * kTexelRow + int(record.y);
    ivec2 size = ivec2(record.zw);
    ivec2 wrap = ivec2(flags & 3, (flags >> 2) & 3);
    vec2 place = vec2(folded(uv.x, wrap.x), folded(uv.y, wrap.y)) * record.zw - 0.5;
    ivec2 low = ivec2(floor(place));
    vec2 share = place - vec2(low);
    ivec2 a = ivec2(wrapped(low.x, size.x, wrap.x), wrapped(low.y, size.y, wrap.y));
    ivec2 b = ivec2(wrapped(low.x + 1, size.x, wrap.x), wrapped(low.y + 1, size.y, wrap.y));
    bool srgb = (flags & kSrgb) != 0;
    vec4 top = mix(texel_at(first, size.x, a, srgb), texel_at(first, size.x, ivec2(b.x, a.y), srgb), share.x);
    vec4 bottom = mix(texel_at(first, size.x, ivec2(a.x, b.y), srgb), texel_at(first, size.x, b, srgb), share.x);
    return mix(top, bottom, share.y);
}

bool is_usual(float u) { return abs(u) < 1.0e7; }  // a number, and small enough to have a fraction

// Returns white without a texture. use: number of the use's first vector.
vec4 sample_texture(int use, Footprint of_mesh) {
    const float most_taps = 16.0;
    vec4 a = texelFetch(materials, use);
    if (a.x < 0.0) return vec4(1.0);
    vec4 b = texelFetch(materials, use + 1);
    vec4 c = texelFetch(materials, use + 2);
    mat2 turn = mat2(b.x, b.w, b.y, c.x);
    int flags = int(a.z);
    int first = int(a.x);
    vec2 size = texelFetch(materials, first).zw;
    vec2 middle = turn * of_mesh.at + vec2(b.z, c.y);
    middle = vec2(is_usual(middle.x) ? middle.x : 0.0, is_usual(middle.y) ? middle.y : 0.0);

    // Same steps as texture_taps.
    vec2 right = turn * of_mesh.right * size;
    vec2 down = turn * of_mesh.down * size;
    float xx = right.x * right.x + down.x * down.x;
    float xy = right.x * right.y + down.x * down.y;
    float yy = right.y * right.y + down.y * down.y;
    float half_difference = 0.5 * (xx - yy);
    float longer2 = 0.5 * (xx + yy) + sqrt(half_difference * half_difference + xy * xy);
    float last = a.y - 1.0;
    float count = 1.0;
    float level = 0.0;
    vec2 axis = vec2(0.0);
    if (!(longer2 > 1.0)) {
        if ((flags & kNearest) != 0) middle = (floor(middle * size) + 0.5) / size;  // middle of a texel, where no neighbour counts
    } else if (!(longer2 < 1.0e12)) {
        level = last;
    } else {
        float longer = sqrt(longer2);
        float shorter = max(1.0, abs(right.x * down.y - right.y * down.x) / longer);
        count = clamp(ceil(longer / shorter - 1.0e-3), 1.0, most_taps);
        level = min(last, log2(max(shorter, longer / most_taps)));
        vec2 along = half_difference > 0.0 ? vec2(longer2 - yy, xy) : vec2(xy, longer2 - xx);
        float along2 = dot(along, along);
        if (along2 > 0.0) axis = along * (longer / sqrt(along2)) / size;
    }
    float coarser = level - floor(level);
    int fine = first + int(level);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < int(count); i++) {
        vec2 at = middle + axis * ((float(i) + 0.5) / count - 0.5);
        sum += bilinear(fine, at, flags) * (1.0 - coarser);
        if (coarser > 0.0) sum += bilinear(fine + 1, at, flags) * coarser;
    }
    return sum / count;
}
