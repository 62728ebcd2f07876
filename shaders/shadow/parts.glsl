// The visible part of a light that something occludes partly for its tile.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Part of the current light: shadow_layout.glsl.
struct Part {
    bool seen;    // any of it is visible
    bool pieces;  // it has its own outline
    int first;    // place of its record
    int places;
    float weight;
    int whole;    // record of the polygon that replaces a round light, 0: none
};
Part part;

void take_pieces(int record) {
    part.first = record;
    part.places = int(parts[record].w);
    part.pieces = part.places > 0;
}

void take_part(uint state) {
    part.seen = state != uint(kSeesNone);
    part.pieces = false;
    part.first = 0;
    part.places = 0;
    part.weight = 1.0;
    part.whole = 0;
    if (state >= uint(kSeesPart)) {
        take_pieces(int(state) - kSeesPart);
        part.weight = parts[part.first + 2].w;
        int ahead = int(parts[part.first + 3].w);
        if (ahead > 0) part.whole = part.first + ahead;
    }
}

// A part of a round light takes three turns: the part, the polygon, the light. Others take only the last one.
const int kLastTurn = kPartSums - 1;
int first_turn() { return !part.seen ? kLastTurn + 1 : part.whole > 0 ? 0 : kLastTurn; }
void turn_to(int turn) {
    if (part.whole == 0) return;
    if (turn == 1) take_pieces(part.whole);
    if (turn == kLastTurn) part.pieces = false;
}

bool by_pieces() { return SHADOWED && part.pieces; }
