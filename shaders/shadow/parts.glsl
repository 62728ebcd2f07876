// The visible part of a light that something occludes partly for its tile.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Part of the current light: shadow_layout.glsl.
struct Part {
    int first;   // place of its record
    int places;
    int whole;   // record of the polygon that replaces a round light, 0: none
};
Part part;

void take_record(int record) {
    part.first = record;
    part.places = int(parts[record].w);
}

// Turns that a light takes. By pieces: its part, and then the polygon that replaces a round light. By its own outline: the light that is
// seen whole, or whose fraction counts.
int turns_of(uint state) {
    part.whole = 0;
    if (state < uint(kSeesPart)) return BY_PIECES || state == uint(kSeesNone) ? 0 : 1;
    take_record(int(state) - kSeesPart);
    int ahead = int(parts[part.first + 3].w);
    if (ahead > 0) part.whole = part.first + ahead;
    return BY_PIECES ? (ahead > 0 ? 2 : 1) : (ahead > 0 ? 1 : 0);
}

// Parts are polygons: modules of other kinds of lights (source/CMakeLists.txt) have no code for them. A call, since compilers fold no
// constants that a pipeline may choose.
#if KIND == 0
bool by_pieces() { return BY_PIECES; }
#else
bool by_pieces() { return false; }
#endif
