// Signs of integers of 64 bits, and the displacements that break ties.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

struct Long {
    int high;
    uint low;
};

Long long_product(int a, int b) {
    int high;
    int low;
    imulExtended(a, b, high, low);
    return Long(high, uint(low));
}
Long long_sum(Long a, Long b) {
    uint carry;
    uint low = uaddCarry(a.low, b.low, carry);
    return Long(a.high + b.high + int(carry), low);
}
Long long_difference(Long a, Long b) {
    uint borrow;
    uint low = usubBorrow(a.low, b.low, borrow);
    return Long(a.high - b.high - int(borrow), low);
}
int sign_of(Long a) { return a.high < 0 ? -1 : (a.high > 0 || a.low > 0u) ? 1 : 0; }
float to_float(Long a) {
    bool negative = a.high < 0;
    if (negative) a = long_difference(Long(0, 0u), a);
    float size = float(a.high) * 4294967296.0 + float(a.low);
    return negative ? -size : size;
}

// a x b
Long long_cross(ivec2 a, ivec2 b) { return long_difference(long_product(a.x, b.y), long_product(a.y, b.x)); }

// The name of a segment's end: ends with equal names are the same vertex.
const uint kNameNumber = 0x0fffffffu;
const uint kVertexName = 0u;
const uint kCutName = 0x10000000u;     // cut of an edge by the light's plane
const uint kCornerName = 0x20000000u;  // corner of the outline
const uint kClipName = 0x30000000u;    // cut of an edge by the box: twice its number, plus 1 at its end
const uint kHorizonName = 0x40000000u; // cut of a horizon by the box: 0, 1; the triangle's: 2, 3
const uint kSectionName = 0x50000000u; // cut of a triangle's section (by the light's plane) by the box: as for an edge
const uint kLeftName = 0x80000000u;    // flag beside it: cut by the box's left side

uvec2 long_times(uvec2 a, uvec2 b) {
    uint high;
    uint low;
    umulExtended(a.x, b.x, high, low);
    return uvec2(low, high + a.x * b.y + a.y * b.x);
}
uvec2 long_shifted(uvec2 a, int bits) { return uvec2((a.x >> bits) | (a.y << (32 - bits)), a.y >> bits); }
uvec2 long_plus(uvec2 a, uvec2 b) {
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

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
    uvec2 x = long_plus(id, uvec2(0x7f4a7c15u, 0x9e3779b9u));
    x = long_times(x ^ long_shifted(x, 30), uvec2(0x1ce4e5b9u, 0xbf58476du));
    x = long_times(x ^ long_shifted(x, 27), uvec2(0x133111ebu, 0x94d049bbu));
    x = x ^ long_shifted(x, 31);
    return ivec2(odd_of(x.x), odd_of(x.y));
}
