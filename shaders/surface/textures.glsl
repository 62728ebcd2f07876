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

vec4 texel_at(int first, float width, float x, float y, bool srgb) {
    vec4 c = texelFetch(texels, first + int(y) * int(width) + int(x));
    return srgb ? vec4(linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z), c.w) : c;
}

// Bilinear look-up in a level, at coordinates from 0 to 1 over the picture.
vec4 bilinear(int level, vec2 uv, int flags) {
    vec4 record = texelFetch(materials, level);
    int first = int(record.x) * kTexelRow + int(record.y);
    TextureTexels x = texture_texels(uv.x, record.z, flags & 3);
    TextureTexels y = texture_texels(uv.y, record.w, (flags >> 2) & 3);
    bool srgb = (flags & kSrgb) != 0;
    vec4 top = mix(texel_at(first, record.z, x.low, y.low, srgb), texel_at(first, record.z, x.high, y.low, srgb), x.share);
    vec4 bottom = mix(texel_at(first, record.z, x.low, y.high, srgb), texel_at(first, record.z, x.high, y.high, srgb), x.share);
    return mix(top, bottom, y.share);
}

// Returns white without a texture. use: number of the use's first vector.
vec4 sample_texture(int use, Footprint of_mesh) {
    vec4 a = texelFetch(materials, use);
    if (a.x < 0.0) return vec4(1.0);
    vec4 b = texelFetch(materials, use + 1);
    vec4 c = texelFetch(materials, use + 2);
    mat2 turn = mat2(b.x, b.w, b.y, c.x);
    int flags = int(a.z);
    int first = int(a.x);
    vec2 size = texelFetch(materials, first).zw;
    vec2 middle = turn * of_mesh.at + vec2(b.z, c.y);
    middle = vec2(texture_coordinate(middle.x), texture_coordinate(middle.y));
    TextureTaps taps = texture_taps(size, turn * of_mesh.right, turn * of_mesh.down);
    if (!taps.covers && (flags & kNearest) != 0) middle = vec2(texture_center(middle.x, size.x), texture_center(middle.y, size.y));
    float level = taps.covers ? clamp(log2(taps.width), 0.0, a.y - 1.0) : 0.0;  // logarithms of devices may fall below 0
    float coarser = level - floor(level);
    int fine = first + int(level);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 2 * int(taps.count); i++) {  // one loop over taps and levels, so that the code of a tap is there once
        float weight = (i & 1) == 0 ? 1.0 - coarser : coarser;
        if (weight > 0.0) sum += bilinear(fine + (i & 1), middle + taps.axis * ((float(i / 2) + 0.5) / taps.count - 0.5), flags) * weight;
    }
    return sum / taps.count;
}
