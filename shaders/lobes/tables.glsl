// Tables of lobes, interpolated between their nodes.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

vec4 look_up(int first, int size, vec2 at) {
    vec2 place = clamp(at, 0.0, 1.0) * float(size - 1);
    vec2 cell = min(floor(place), float(size - 2));
    vec2 f = place - cell;
    int node = first + int(cell.y) * size + int(cell.x);
    vec4 top = mix(texelFetch(tables, node), texelFetch(tables, node + 1), f.x);
    vec4 bottom = mix(texelFetch(tables, node + size), texelFetch(tables, node + size + 1), f.x);
    return mix(top, bottom, f.y);
}
