// What a point sees of a light that something hides from its tile in part.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Of the light in work: shadow_layout.glsl.
struct Part {
    bool seen;     // anything of it
    bool pieces;   // an outline of its own
    int first;     // of its record
    int places;
    float weight;
};
Part part;

void take_part(uint state) {
    part.seen = state != uint(kSeesNone);
    part.pieces = false;
    part.first = 0;
    part.places = 0;
    part.weight = 1.0;
    if (state >= uint(kSeesPart)) {
        part.first = int(state) - kSeesPart;
        part.places = int(parts[part.first].w);
        part.pieces = part.places > 0;
        part.weight = parts[part.first + 2].w;
    }
}

bool by_pieces() { return SHADOWED && part.pieces; }
