// Textured lights from the host (source/device/direct/light_records.cpp): a head, the levels of blurred copies, the cells of the
// tree.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#include "integrals/textured/texture_rule.glsl"
#include "integral/texture_cell.glsl"

// Contents of the head, of a level and of a cell: kTextureHead, kTextureLevel and kTextureCell vectors.
//   head   origin, deviation of the smallest cells; axis x, number of levels; axis y, where the cells begin; bounds; mean;
//          centroid; covariance of its area
//   level  left, bottom, spacing, sigma; width, height, where its texels begin
//   cell   centre, axis a; axis b, area, radius; mean, deviation; along a, first child (0: none); along b, the cell after it and all below
//          it (-1: none)
struct LightTexture {
    int first;
    vec3 origin;
    vec3 axis_x;
    vec3 axis_y;
    float finest;
    int levels;
    int cells;
    vec4 bounds;
    vec3 mean;
    vec2 middle;
    vec3 covariance;
};

LightTexture light_texture_at(int first) {
    LightTexture t;
    t.first = first;
    t.origin = details[first].xyz;
    t.finest = details[first].w;
    t.axis_x = details[first + 1].xyz;
    t.levels = int(details[first + 1].w);
    t.axis_y = details[first + 2].xyz;
    t.cells = int(details[first + 2].w);
    t.bounds = details[first + 3];
    t.mean = details[first + 4].xyz;
    t.middle = details[first + 5].xy;
    t.covariance = details[first + 6].xyz;
    return t;
}

// Radiance times coverage, and coverage, at a place of a level, interpolated between its texels.
vec4 at_level(LightTexture t, int k, vec2 at) {
    vec4 place = details[t.first + kTextureHead + kTextureLevel * k];
    vec4 size = details[t.first + kTextureHead + kTextureLevel * k + 1];
    vec2 q = (at - place.xy) / place.z;
    if (!(q.x > -1.0 && q.y > -1.0 && q.x < size.x && q.y < size.y)) return vec4(0.0);
    vec2 low = floor(q);
    vec2 share = q - low;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; i++) {
        vec2 side = vec2(float(i & 1), float(i >> 1));
        vec2 texel = low + side;
        vec2 weights = mix(1.0 - share, share, side);
        bool inside = texel.x >= 0.0 && texel.y >= 0.0 && texel.x < size.x && texel.y < size.y;
        if (inside) sum += weights.x * weights.y * details[int(size.z) + int(texel.y) * int(size.x) + int(texel.x)];
    }
    return sum;
}

float finest_sigma(LightTexture t) { return details[t.first + kTextureHead].w; }

// The texture blurred by sigma, interpolated between two levels in proportion to the variance.
vec4 blurred_at(LightTexture t, vec2 at, float sigma) {
    float finest = finest_sigma(t);
    float level = clamp(log2(max(sigma, finest) / finest), 0.0, float(t.levels - 1));
    int k = min(int(level), t.levels - 2);
    float ratio = exp2(level - float(k));
    float share = (ratio * ratio - 1.0) / 3.0;
    return mix(at_level(t, k, at), at_level(t, k + 1, at), share);
}

// The texture under a Gaussian, by probes along its longer axis.
vec4 under_gaussian(LightTexture t, vec2 at, LtcTextureEllipse g) {
    float longest = length(g.major);
    float sigma = max(max(g.minor, longest / kTextureAnisotropy), finest_sigma(t));
    if (longest < 1.1 * sigma) return blurred_at(t, at, max(sigma, longest));
    float spread2 = (longest * longest - sigma * sigma) / (longest * longest);
    float span = kTextureProbeSpacing * sigma / longest;
    int side = int(ceil(2.0 * sqrt(spread2) / span));
    vec4 sum = vec4(0.0);
    float total = 0.0;
    for (int i = -side; i <= side; i++) {
        float u = float(i) * span;
        float w = exp(-u * u / (2.0 * spread2));
        sum += w * blurred_at(t, at + g.major * u, sigma);
        total += w;
    }
    return sum / total;
}

// A cell of the tree, its first child, and the next cell after it and all below it.
struct TreeCell {
    LtcTextureCell cell;
    int child;
    int next;
};

TreeCell tree_cell_at(LightTexture t, int number) {
    int first = t.cells + number * kTextureCell;
    vec4 a = details[first];
    vec4 b = details[first + 1];
    vec4 c = details[first + 2];
    vec4 d = details[first + 3];
    vec4 e = details[first + 4];
    TreeCell tree;
    tree.cell.center = a.xy;
    tree.cell.axis_a = a.zw;
    tree.cell.axis_b = b.xy;
    tree.cell.area = b.z;
    tree.cell.radius = b.w;
    tree.cell.deviation = c.w;
    tree.cell.mean = c.xyz;
    tree.cell.along_a = d.xyz;
    tree.cell.along_b = e.xyz;
    tree.child = int(d.w);
    tree.next = int(e.w);
    return tree;
}

// Radiance times coverage, and coverage, at a texel of the finest level, which continues beyond its border.
vec4 texel_of_finest(vec4 size, vec2 texel) { return details[int(size.z) + int(texel.y) * int(size.x) + int(texel.x)]; }

// Every second of five bits, including the last.
int every_second(int bits) { return ((bits >> 2) & 4) | ((bits >> 1) & 2) | (bits & 1); }

// Part of one of the smallest cells: TextureTree::half, once for each bit of `path` after its first, at most kTextureDeepest times. The
// halves alternate between the two axes, so the bits of each axis form a number: how far along it the part lies. So no loop is needed.
// llvmpipe silently allows a thread only 65,535 turns of loops in all.
LtcTextureCell part_of(LightTexture t, LtcTextureCell cell, int path) {
    int depth = findMSB(path);
    if (depth == 0) return cell;
    int bits = path << (kTextureDeepest - depth);
    float of_a = 1.0 / float(1 << ((depth + 1) / 2));
    float of_b = 1.0 / float(1 << (depth / 2));
    vec2 along = vec2(every_second(bits >> 1), every_second(bits)) * 0.5 - 2.0 * (1.0 - vec2(of_a, of_b));
    vec2 a = cell.axis_a * of_a;
    vec2 b = cell.axis_b * of_b;
    bool across = (depth & 1) == 1;
    LtcTextureCell part = cell;
    part.center = cell.center + (cell.axis_a * along.x + cell.axis_b * along.y) * 0.612372435695794525;
    part.axis_a = across ? b : a;
    part.axis_b = across ? a : b;
    part.area = cell.area * of_a * of_b;
    part.radius = sqrt(1.5 * (dot(a, a) + dot(b, b)));
    part.along_a = vec3(0.0);
    part.along_b = vec3(0.0);
    part.deviation = cell.deviation * (across ? 0.7 : 1.0) * ((depth & 2) == 2 ? 0.49 : 1.0) * ((depth & 4) == 4 ? 0.2401 : 1.0);
    vec4 place = details[t.first + kTextureHead];
    vec4 size = details[t.first + kTextureHead + 1];
    vec2 q = clamp((part.center - place.xy) / place.z, vec2(0.0), size.xy - 1.0);
    vec2 low = min(floor(q), max(size.xy - 2.0, 0.0));
    vec2 high = min(low + 1.0, size.xy - 1.0);
    vec2 share = q - low;
    vec4 below = mix(texel_of_finest(size, low), texel_of_finest(size, vec2(high.x, low.y)), share.x);
    vec4 above = mix(texel_of_finest(size, vec2(low.x, high.y)), texel_of_finest(size, high), share.x);
    vec4 sum = mix(below, above, share.y);
    if (sum.w > 0.0) part.mean = sum.xyz / sum.w;
    return part;
}
