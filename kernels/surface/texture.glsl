// Texture look-up: the mean over a pixel's footprint, as taps on ever smaller pictures. The caller reads the texels.
//
// Coordinates run from 0 to 1 over the picture. Texel centres lie at half-integers.
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Taps on a texture for the mean over a footprint.
//   covers  the footprint is more than a texel; else there is one tap on the picture itself
//   count   side by side along the footprint's longer axis, about its middle; at most 16
//   axis    that axis at full length
//   width   of a tap, in texels; its logarithm to base 2 is the level to read
struct TextureTaps {
    mask covers;
    real count;
    vec2 axis;
    real width;
};

// Taps on the longer axis of the ellipse inscribed in the footprint, as wide as the shorter axis. In texels, a circle of diameter 1 becomes
// an ellipse, whose axes are those of J transpose(J).
//
//   size         of the picture, in texels
//   right, down  change of the coordinates to the pixel's neighbours
//
// Degenerate: a footprint of a million texels or more gets one tap on the mean of all.
TextureTaps texture_taps(vec2 size, vec2 right, vec2 down) {
    vec2 a = vec2(right.x * size.x, right.y * size.y);
    vec2 b = vec2(down.x * size.x, down.y * size.y);
    real xx = a.x * a.x + b.x * b.x;
    real xy = a.x * a.y + b.x * b.y;
    real yy = a.y * a.y + b.y * b.y;
    real difference = 0.5 * (xx - yy);
    real longer2 = 0.5 * (xx + yy) + sqrt(difference * difference + xy * xy);
    TextureTaps taps;
    taps.covers = longer2 > 1.0;
    taps.count = 1.0;
    taps.axis = vec2(0.0, 0.0);
    taps.width = 1.0;
    if (any_lane(taps.covers)) {
        mask spread = taps.covers && longer2 < 1.0e12;
        real square = select(spread, longer2, 1.0);
        real longer = sqrt(square);
        real shorter = max(1.0, abs(a.x * b.y - a.y * b.x) / longer);
        mask wide = difference > 0.0;
        vec2 along = vec2(select(wide, square - yy, xy), select(wide, xy, square - xx));
        real along2 = along.x * along.x + along.y * along.y;
        real scale = select(along2 > 0.0, longer / sqrt(max(along2, smallest_divisor())), 0.0);
        taps.count = select(spread, clamp(-floor(0.001 - longer / shorter), 1.0, 16.0), 1.0);
        taps.axis = vec2(select(spread, along.x * scale / size.x, 0.0), select(spread, along.y * scale / size.y, 0.0));
        taps.width = select(spread, max(shorter, longer * 0.0625), select(taps.covers, 1.0e12, 1.0));
    }
    return taps;
}

// A coordinate that can be looked up: 0 for those that are not numbers, or too large to have a fraction.
real texture_coordinate(real u) {
    return select(abs(u) < 1.0e7, u, 0.0);
}

// The centre of the texel at a coordinate, where neighbours weigh nothing.
//
//   size   of the picture in that direction, in texels
real texture_center(real u, real size) {
    return (floor(u * size) + 0.5) / size;
}

// Texels on both sides of a coordinate.
//   low, high  their numbers
//   share      weight of the second
struct TextureTexels {
    real low;
    real high;
    real share;
};

// The two texels whose blend is a picture's value at a coordinate.
//
//   size   in texels, at most 2^20
//   wrap   0 repeats the picture, 1 mirrors it, 2 continues its edge
TextureTexels texture_texels(real u, real size, int wrap) {
    real inside = u;
    if (wrap == 0) {
        inside = u - floor(u);
    }
    if (wrap == 1) {
        real turn = u - 2.0 * floor(u * 0.5);
        inside = min(turn, 2.0 - turn);
    }
    real last = size - 1.0;
    real at = min(max(inside, 0.0), 1.0) * size - 0.5;
    real low = floor(at);
    real high = low + 1.0;
    TextureTexels texels;
    texels.share = at - low;
    texels.low = max(low, 0.0);
    texels.high = min(high, last);
    if (wrap == 0) {
        texels.low = select(low < 0.0, last, low);
        texels.high = select(high > last, 0.0, high);
    }
    return texels;
}
