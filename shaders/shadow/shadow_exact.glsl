// Signs of integers of 64 bits, and the displacements that break ties.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

int sign_of(int64_t a) { return a < 0l ? -1 : a > 0l ? 1 : 0; }
// The rounding is that of two halves, so that all devices have the same.
float to_float(int64_t a) {
    uvec2 size = unpackUint2x32(uint64_t(abs(a)));
    float value = float(int(size.y)) * 4294967296.0 + float(size.x);
    return a < 0l ? -value : value;
}

// a x b
int64_t long_cross(ivec2 a, ivec2 b) { return int64_t(a.x) * int64_t(b.y) - int64_t(a.y) * int64_t(b.x); }

// The name of a segment's end: ends with equal names are the same vertex.
const uint kNameNumber = 0x0fffffffu;
const uint kCutName = 0x10000000u;     // cut of an edge by the light's plane
const uint kCornerName = 0x20000000u;  // corner of the outline
const uint kClipName = 0x30000000u;    // cut of an edge by the box: twice its number, plus 1 at its end
const uint kHorizonName = 0x40000000u; // cut of a horizon by the box: 0, 1; the triangle's: 2, 3
const uint kSectionName = 0x50000000u; // cut of a triangle's section (by the light's plane) by the box: as for an edge
const uint kLeftName = 0x80000000u;    // flag beside it: cut by the box's left side

int odd_of(uint bits) {
    int size = int((bits & 0xfffffu) | 1u);
    return (bits & 0x100000u) != 0u ? -size : size;
}

// Displacement of a vertex: Sebastiano Vigna's splitmix64 of its id.
ivec2 displacement(uint name) {
    uint kind = name & 0x70000000u;
    uvec2 id = uvec2(name & kNameNumber, kind);
    if (kind == kSectionName) id.y = 0x31000000u;
    if (kind == kHorizonName) id = uvec2(id.x & 1u, 0x33000000u + ((id.x & 2u) << 23));
    uint64_t x = packUint2x32(id) + 0x9e3779b97f4a7c15ul;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ul;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebul;
    uvec2 bits = unpackUint2x32(x ^ (x >> 31));
    return ivec2(odd_of(bits.x), odd_of(bits.y));
}
