// The counts along all segments, and the pieces at the lowest count: steps 5 and 6 of docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Terms of order 0, 1 and 2 of f x (p - scale f.a) in the infinitely small displacement. p, shift: a vertex, or twice a midpoint.
struct Side {
    Long d0;
    Long d1;
    Long d2;
};
Side side_of(ivec4 f, ivec4 shift_f, ivec2 p, ivec2 shift, int scale) {
    ivec2 d = f.zw - f.xy;
    ivec2 g = shift_f.zw - shift_f.xy;
    ivec2 q = p - scale * f.xy;
    ivec2 r = shift - scale * shift_f.xy;
    return Side(long_cross(d, q), long_sum(long_cross(d, r), long_cross(g, q)), long_cross(g, r));
}
Side side_sum(Side a, Side b) { return Side(long_sum(a.d0, b.d0), long_sum(a.d1, b.d1), long_sum(a.d2, b.d2)); }
bool is_left(Side s) {
    int sign = sign_of(s.d0);
    if (sign == 0) sign = sign_of(s.d1);
    if (sign == 0) sign = sign_of(s.d2);
    return sign >= 0;
}
// Fraction of the way between two vertices at which the line lies.
float place_between(Side from, Side to) {
    float a = to_float(from.d0);
    float d = a - to_float(to.d0);
    if (d == 0.0) {
        a = to_float(from.d1);
        d = a - to_float(to.d1);
    }
    return d == 0.0 ? 0.5 : clamp(a / d, 0.0, 1.0);
}

// Floats hold differences of cells exactly. A product has a relative error of 2^-24, and so has the difference of two. Returns 1 for left,
// -1 for right, 0 if floats cannot decide.
int float_side(ivec2 d, ivec2 q) {
    float a = float(d.x) * float(q.y);
    float b = float(d.y) * float(q.x);
    float bound = 4.0e-7 * (abs(a) + abs(b));
    return a - b > bound ? 1 : a - b < -bound ? -1 : 0;
}

bool share_an_end(uvec2 e, uvec2 f) {
    uvec2 a = e & ~kLeftName;
    uvec2 b = f & ~kLeftName;
    return a.x == b.x || a.x == b.y || a.y == b.x || a.y == b.y;
}

// Pieces of segments at the lowest count so far: fractions of the way at which each begins and ends.
shared vec2 pieces[PIECE_SPACE];
shared int piece_segments[PIECE_SPACE];
int piece_count;
int level;
bool too_many_pieces;

// Pieces of the segment that this lane handles.
const int TAKEN_SPACE = kCrossings + 1;
vec2 taken[TAKEN_SPACE];
int taken_segments[TAKEN_SPACE];
int taken_count;
int taken_level;

// Appends the pieces that each lane has taken to those of all lanes, if they are at the lowest count of all.
void gather_pieces() {
    int lowest = least_of_lanes(taken_level);
    if (lowest < level) {
        level = lowest;
        piece_count = 0;
        too_many_pieces = false;
    }
    uint all;
    uint count = taken_level == level ? uint(taken_count) : 0u;
    int to = piece_count + int(begin_of(count, all));
    too_many_pieces = too_many_pieces || piece_count + int(all) > PIECE_SPACE;
    for (int i = too_many_pieces ? int(count) : 0; i < int(count); i++) {
        pieces[to + i] = taken[i];
        piece_segments[to + i] = taken_segments[i];
    }
    if (!too_many_pieces) piece_count += int(all);
    taken_count = 0;
    taken_level = level;
}

void take_piece(vec2 ways, int segment, int left) {
    int weight = weights[segment];
    int low = min(left, left - weight);
    if (low >= kHidden / 2 || low > taken_level || weight == 0) return;
    if (low < taken_level) {
        taken_level = low;
        taken_count = 0;
        too_many_pieces = false;
    }
    if (taken_count == TAKEN_SPACE) {
        too_many_pieces = true;
        return;
    }
    taken[taken_count] = ways;
    taken_segments[taken_count] = segment;
    ++taken_count;
}

// Begin and end of a piece, with the side of the lower count on its left.
vec4 piece_ends(int i) {
    ivec4 e = cells[piece_segments[i]];
    vec2 d = vec2(e.zw - e.xy);
    vec2 ways = pieces[i];
    vec4 ends = vec4(vec2(e.xy) + ways.x * d, ways.y < 1.0 ? vec2(e.xy) + ways.y * d : vec2(e.zw));
    return weights[piece_segments[i]] > 0 ? ends.zwxy : ends;
}

// Segments that a segment, or the left ray from its middle, may cross, with flags for what floats could decide.
const int kMeets = 1;
const int kNotCertain = 2;
const int kEndAbove = 4;
const int kCloseNumber = 8;
int close[kClose];
int close_count;

// Crossings of one segment, in their order.
float crossing_at[kCrossings];
int crossing_change[kCrossings];
int shifts_here;  // moves made while sorting them

// A segment whose count is computed.
struct Walk {
    int number;
    ivec4 cells;
    ivec4 shifts;
    uvec2 names;
    ivec2 m;  // twice the middle
    ivec2 shift_m;
    ivec4 bounds;
};

// Change that a segment across a height adds to the count of a left ray at that height. left: the ray starts on the segment's left.
int left_ray(int weight, bool upwards, bool left) { return upwards ? (left ? 0 : -weight) : (left ? weight : 0); }

// Returns what segment i adds to the count left of the middle, as far as floats can decide. Stores it in `close` if more is needed.
int look_at_segment(Walk e, int i) {
    ivec4 f = cells[i];
    uvec2 named_f = names[i];
    int weight = weights[i];
    int count = 0;
    // Events of the box's left side, and the ends that lie above the middle; displacements break ties.
    ivec2 height = 2 * f.yw - ivec2(e.m.y);
    ivec2 shifted = 2 * height_shifts(i) - ivec2(e.shift_m.y);
    bool start_above = height.x > 0 || (height.x == 0 && shifted.x > 0);
    bool end_above = height.y > 0 || (height.y == 0 && shifted.y > 0);
    bool start_below = height.x < 0 || (height.x == 0 && shifted.x < 0);
    bool end_below = height.y < 0 || (height.y == 0 && shifted.y < 0);
    if ((named_f.x & kLeftName) != 0u && start_below) count += weight;
    if ((named_f.y & kLeftName) != 0u && end_below) count -= weight;
    if (i == e.number) return count;

    ivec2 d = e.cells.zw - e.cells.xy;
    ivec2 df = f.zw - f.xy;
    ivec2 low = min(f.xy, f.zw);
    ivec2 high = max(f.xy, f.zw);
    bool passes = start_above != end_above && 2 * low.x <= e.m.x;
    bool certain = true;
    if (passes) {
        int side = 2 * high.x < e.m.x ? (end_above ? -1 : 1) : float_side(df, e.m - 2 * f.xy);
        certain = side != 0;
        count += left_ray(side == 0 ? 0 : weight, end_above, side > 0);
    }
    bool meets = all(lessThanEqual(low, e.bounds.zw)) && all(greaterThanEqual(high, e.bounds.xy)) && !share_an_end(e.names, named_f);
    if (meets) {
        int ea = float_side(df, e.cells.xy - f.xy);
        int eb = float_side(df, e.cells.zw - f.xy);
        int fa = float_side(d, f.xy - e.cells.xy);
        int fb = float_side(d, f.zw - e.cells.xy);
        meets = ea * eb <= 0 && fa * fb <= 0;
    }
    if (meets || !certain) {
        too_much = too_much || close_count == kClose;
        close[min(close_count, kClose - 1)] =
            kCloseNumber * i + (meets ? kMeets : 0) + (certain ? 0 : kNotCertain) + (end_above ? kEndAbove : 0);
        ++close_count;
    }
    return count;
}

// If `mine` is false, the lane only takes part in looking at the segments that all lanes look at.
void cut_segment(int number, int base, bool mine) {
    Walk w;
    w.number = number;
    w.cells = cells[number];
    w.shifts = shifts_of(number);
    w.names = names[number];
    ivec4 e = w.cells;
    ivec4 shift_e = w.shifts;
    ivec2 d = e.zw - e.xy;
    w.m = e.xy + e.zw;
    w.shift_m = shift_e.xy + shift_e.zw;
    w.bounds = ivec4(min(e.xy, e.zw), max(e.xy, e.zw));
    close_count = 0;
    int count = base;
    for (int i = 0; i < segment_count; i += kAtOnce) {
        count += look_at_segment(w, i);
        if (i + 1 < segment_count) count += look_at_segment(w, i + 1);
        if (i + 2 < segment_count) count += look_at_segment(w, i + 2);
        if (i + 3 < segment_count) count += look_at_segment(w, i + 3);
    }
    turns -= 2 * most_of_lanes(close_count);
    too_much = too_much || turns < 0;
    if (!mine || d == ivec2(0)) return;
    int most_shifts = turns / int(LANES);
    int before_middle = 0;
    int crossings = 0;
    for (int n = 0; n < close_count && !too_much; n++) {
        int i = close[n] / kCloseNumber;
        ivec4 f = cells[i];
        ivec4 shift_f = shifts_of(i);
        int weight = weights[i];
        if ((close[n] & kNotCertain) != 0)
            count += left_ray(weight, (close[n] & kEndAbove) != 0, is_left(side_of(f, shift_f, w.m, w.shift_m, 2)));
        if ((close[n] & kMeets) == 0) continue;
        Side ea = side_of(f, shift_f, e.xy, shift_e.xy, 1);
        Side eb = side_of(f, shift_f, e.zw, shift_e.zw, 1);
        bool to_left = is_left(eb);
        if (is_left(ea) == to_left) continue;
        if (is_left(side_of(e, shift_e, f.xy, shift_f.xy, 1)) == is_left(side_of(e, shift_e, f.zw, shift_f.zw, 1))) continue;
        if (crossings == kCrossings || shifts_here > most_shifts) {
            too_much = true;
            break;
        }
        int change = to_left ? weight : -weight;
        // The middle is still to come where it lies on the end's side.
        if (is_left(side_sum(ea, eb)) == to_left) before_middle += change;
        float t = place_between(ea, eb);
        int k = crossings;
        shifts_here += k;
        while (k > 0 && crossing_at[k - 1] > t) {
            crossing_at[k] = crossing_at[k - 1];
            crossing_change[k] = crossing_change[k - 1];
            --k;
        }
        crossing_at[k] = t;
        crossing_change[k] = change;
        ++crossings;
    }
    // The count is on the -x side, which is the left if the segment runs up.
    bool up = d.y > 0 || (d.y == 0 && shift_e.w > shift_e.y);
    int left = (up ? count : count + weights[number]) - before_middle;
    float from = 0.0;
    for (int k = 0; k <= crossings; k++) {
        float to = k < crossings ? crossing_at[k] : 1.0;
        if (to > from) {
            take_piece(vec2(from, to), number, left);
            from = to;
        }
        if (k < crossings) left += crossing_change[k];
    }
}

void cut_segments(int base) {
    piece_count = 0;
    level = 2147483647;
    too_many_pieces = false;
    taken_count = 0;
    taken_level = level;
    for (int first = 0; first < segment_count && !too_much; first += int(LANES)) {
        uint i = uint(first) + LANE;
        shifts_here = 0;
        cut_segment(min(int(i), segment_count - 1), base, is_mine(i, uint(segment_count)));
        turns -= sum_of_lanes(shifts_here);
        too_much = any_of_lanes(too_much);
        gather_pieces();
    }
    too_much = too_much || any_of_lanes(too_many_pieces);
    meet();
}
