// Parity cases of texture.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Texture, taps over a footprint: their number, width and axis
//   a.x    signed_log(0.0001, 1)
//   a.y    signed_log(0.0001, 1)
//   b.x    signed_log(0.0001, 1)
//   b.y    signed_log(0.0001, 1)
// Values: 4
vec4 case_texture_taps(CaseInput i) {
    TextureTaps taps = texture_taps(vec2(256.0, 64.0), vec2(i.a.x, i.a.y), vec2(i.b.x, i.b.y));
    real width = select(taps.covers, taps.width, 0.5);
    return vec4(taps.count, width, taps.axis.x * taps.axis.x, taps.axis.x * taps.axis.y);
}

// Blend of two texels whose values rise along the picture and fall again.
real case_texture_blend(real u, int wrap) {
    TextureTexels texels = texture_texels(texture_coordinate(u), 16.0, wrap);
    real low = texels.low * (15.0 - texels.low);
    real high = texels.high * (15.0 - texels.high);
    return low + (high - low) * texels.share;
}

// Texture, texels about a coordinate, by wrap mode, and a texel's centre
//   a.x    range(-3, 3)
// Values: 4
vec4 case_texture_texels(CaseInput i) {
    real x = i.a.x;
    return vec4(case_texture_blend(x, 0), case_texture_blend(x, 1), case_texture_blend(x, 2), texture_center(x, 16.0));
}
