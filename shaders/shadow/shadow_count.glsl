// The counts along all segments, and the pieces at the lowest count: steps 5 and 6 of docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Pieces of segments at the lowest count so far: fractions of the way at which each begins and ends.
shared vec2 pieces[ALL_SPACE];
int piece_count;
int level;
bool too_many_pieces;

// Crossings of the segments that the lanes have in work. Each segment has a chain of them, in their order along it.
shared float crossing_at[ALL_SPACE];
shared int crossing_links[ALL_SPACE];  // the change of the count, times kLinks; place of the next crossing
int crossing_count;
int near_pairs;  // that the lane has met, and those that floats leave open
int open_pairs;
const int kLinkBits = 12;
const int kLinks = 1 << kLinkBits;
const int kNoLink = kLinks - 1;

// Begin and end of a piece, with the side of the lower count on its left.
vec4 piece_ends(int i) {
    vec4 e = cells[FIRST + piece_segments[FIRST + i]];
    vec2 d = e.zw - e.xy;
    vec2 ways = pieces[FIRST + i];
    vec4 ends = vec4(e.xy + ways.x * d, ways.y < 1.0 ? e.xy + ways.y * d : e.zw);
    return marks[FIRST + piece_segments[FIRST + i]] >= kMarks ? ends.zwxy : ends;
}

// A segment e whose count is computed.
struct Walk {
    int number;
    bool mine;          // false: the lane only takes part in the loops of all lanes
    vec4 cells;
    uvec2 names;
    vec4 box;           // low corner, high corner
    vec2 middle;
    int count;          // to the left of the middle
    int before_middle;  // changes from the start to the middle
    int first;          // place of the first crossing
};

// Change that a segment across a height adds to the count of a left ray at that height. left: the ray starts on the segment's left.
int left_ray(int weight, bool upwards, bool left) { return upwards == left ? 0 : upwards ? -weight : weight; }

// Change that the events of a segment at the box's left side add at a height above its start, above its end.
int left_events(int mark, bool above_start, bool above_end) {
    return ((mark & kLeftStart) != 0 && above_start ? weight_of(mark) : 0) - ((mark & kLeftEnd) != 0 && above_end ? weight_of(mark) : 0);
}

// Adds to the count what segment f = i changes, if f and e are clearly apart. Returns true, and adds nothing, if their boxes meet or f ends
// at the height of e's middle. Where the boxes are apart there is no crossing, and f is left of the middle or right of it as a whole.
bool is_near(inout Walk e, int i) {
    vec4 f = cells[FIRST + i];
    int mark = marks[FIRST + i];
    vec2 high = max(f.xy, f.zw);
    vec2 gap = max(min(f.xy, f.zw) - e.box.zw, e.box.xy - high);
    vec2 above = f.yw - e.middle.yy;
    float sides = above.x * above.y;
    bool near = max(gap.x, gap.y) <= 0.0 || sides == 0.0;
    int change = sides < 0.0 && high.x < e.middle.x ? (above.x < 0.0 ? -weight_of(mark) : weight_of(mark)) : 0;
    if ((mark & (kLeftStart | kLeftEnd)) != 0) change += left_events(mark, above.x < 0.0, above.y < 0.0);
    e.count += near ? 0 : change;
    return near;
}

#if !FEW
// Boxes of as many segments as a turn looks at: low corner, high corner; and the sums of their events at the box's left side.
shared vec4 boxes[SPACE / kAtOnce];
shared int events_of_box[SPACE / kAtOnce];

// Puts the segments in the order of their heights. Then those of a turn are at about the same height, and so are those of the lanes. The
// arrays of pieces and crossings, which are still empty, hold them meanwhile.
void sort_segments() {
    // A key is the height, in 21 bits, and the segment's number.
    for (int i = int(LANE); i < (segment_count + kAtOnce - 1) / kAtOnce * kAtOnce; i += LANES)
        crossing_links[i] = (int(min(cells[i].y + cells[i].w, 2.0 * shadow_cells() - 1.0)) + 2 * int(shadow_cells()) >> 3 << 10) + i;
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) {
        int key = crossing_links[i];
        int place = 0;
        for (int first = 0; first < segment_count; first += kAtOnce)
            for (int k = 0; k < kAtOnce; k++) place += crossing_links[first + k] < key ? 1 : 0;  // compilers unroll it
        crossing_at[i] = float(place);
    }
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) {
        int to = int(crossing_at[i]);
        pieces[to] = cells[i].xy;
        crossing_links[to] = int(cells[i].z);
        piece_segments[to] = int(cells[i].w);
    }
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) cells[i] = vec4(pieces[i], crossing_links[i], piece_segments[i]);
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) {
        int to = int(crossing_at[i]);
        crossing_links[to] = int(names[i].x);
        piece_segments[to] = int(names[i].y);
        pieces[to].x = float(marks[i]);
    }
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) {
        names[i] = uvec2(crossing_links[i], piece_segments[i]);
        marks[i] = int(pieces[i].x);
    }
    subgroupBarrier();
}

void find_boxes() {
    for (int b = int(LANE); b * kAtOnce < segment_count; b += LANES) {
        vec4 box = vec4(1.0e30, 1.0e30, -1.0e30, -1.0e30);
        int events = 0;
        for (int i = b * kAtOnce; i < min(b * kAtOnce + kAtOnce, segment_count); i++) {
            vec4 f = cells[i];
            box = vec4(min(box.xy, min(f.xy, f.zw)), max(box.zw, max(f.xy, f.zw)));
            events += left_events(marks[i], true, true);
        }
        boxes[b] = box;
        events_of_box[b] = events;
    }
}

// Adds to the count what the segments of a turn change, if they are above e's box, below it or right of it. Returns false, and adds nothing,
// if they are elsewhere.
bool is_passed_by(inout Walk e, int b) {
    vec4 box = boxes[b];
    bool below = box.w < e.box.y;
    bool passed = below || box.y > e.box.w || box.x > e.box.z;
    if (any_of_lanes(!passed && e.mine)) return false;
    e.count += below ? events_of_box[b] : 0;
    return true;
}
#endif

// A lane's share of the turns in which 64 lanes, a segment each, would look at segments. Their boxes together decide, so the sum is an upper
// bound. For reports.
int looks_of_64() {
    int looks = 0;
#if !FEW
    int all = (segment_count + kAtOnce - 1) / kAtOnce;
    for (int first = 0; first < all; first += 64 / kAtOnce) {
        vec4 box = boxes[first];
        for (int b = first; b < min(first + 64 / kAtOnce, all); b++) box = vec4(min(box.xy, boxes[b].xy), max(box.zw, boxes[b].zw));
        for (int b = int(LANE); b < all; b += LANES) looks += boxes[b].w < box.y || boxes[b].y > box.w || boxes[b].x > box.z ? 0 : 1;
    }
#endif
    return looks;
}

bool share_an_end(uvec2 a, uvec2 b) { return a.x == b.x || a.x == b.y || a.y == b.x || a.y == b.y; }

// Adds to the count what segment f = i changes by floats alone. Returns true, and adds nothing, if they cannot decide.
//
// Three products tell all sides: of e's start from f, of f's start from e, and of e's direction from f's. The others are sums. Differences
// of cells are exact. Each sum is off by less than 2^-22 of the sizes of all products, and 4e-7 is more.
bool look_at_segment(inout Walk e, int i) {
    vec4 f = cells[FIRST + i];
    int mark = marks[FIRST + i];
    vec2 d = e.cells.zw - e.cells.xy;
    vec2 df = f.zw - f.xy;
    vec2 q = e.cells.xy - f.xy;
    vec2 ea = df * q.yx;
    vec2 turn = df * d.yx;
    vec2 fa = q * d.yx;
    float start = ea.x - ea.y;
    float all = turn.x - turn.y;
    float other = fa.x - fa.y;
    vec2 sizes = abs(ea) + abs(turn) + abs(fa);
    float bound = 4.0e-7 * (sizes.x + sizes.y);
    // They cross if both fractions of the way, -start / all and other / all, are between 0 and 1.
    float along = all < 0.0 ? start : -start;
    float across = all < 0.0 ? -other : other;
    bool meets = min(along, across) >= -bound && max(along, across) <= abs(all) + bound && !share_an_end(e.names, names[FIRST + i]);
    float middle = 2.0 * start + all;
    vec2 height = 2.0 * f.yw - (e.cells.y + e.cells.w);
    bool passes = (height.x > 0.0) != (height.y > 0.0) && i != e.number;
    bool open = meets || height.x == 0.0 || height.y == 0.0 || (passes && abs(middle) <= 2.0 * bound);
    int change = left_events(mark, height.x < 0.0, height.y < 0.0) + (passes ? left_ray(weight_of(mark), height.y > 0.0, middle > 0.0) : 0);
    e.count += open ? 0 : change;
    return open;
}

// Sides of two segments to each other, in one order of the infinitely small displacements: of e's start from f, of f's start from e, and
// what e's and f's directions add to them on the way to their ends.
struct Sides {
    int64_t ea;
    int64_t fa;
    int64_t turn;
};
// Signs: of e's start and end from f, and of f's start and end from e; then of e's middle from f.
struct Signs {
    ivec4 ends;
    int middle;
};
int first_of(int sign, int64_t next) { return sign != 0 ? sign : sign_of(next); }
Signs and_signs(Signs s, Sides sides) {
    int64_t eb = sides.ea + sides.turn;
    int64_t fb = sides.fa - sides.turn;
    ivec4 ends = ivec4(first_of(s.ends.x, sides.ea), first_of(s.ends.y, eb), first_of(s.ends.z, sides.fa), first_of(s.ends.w, fb));
    return Signs(ends, first_of(s.middle, sides.ea + eb));
}
// Fraction of the way from e's start to its end at which f lies, or -1 if the two are parallel.
float place_between(Sides sides) {
    float a = to_float(sides.ea);
    float d = a - to_float(sides.ea + sides.turn);
    return d == 0.0 ? -1.0 : clamp(a / d, 0.0, 1.0);
}

// Puts a crossing at its place in the chain of a segment. Returns the number of turns.
int add_crossing(inout Walk e, int place, float at, int change) {
    int before = kNoLink;
    int next = e.first;
    int steps = 0;
    while (next != kNoLink && crossing_at[FIRST + next] <= at) {
        before = next;
        next = crossing_links[FIRST + next] & kNoLink;
        ++steps;
    }
    crossing_at[FIRST + place] = at;
    crossing_links[FIRST + place] = kLinks * change + next;
    if (before == kNoLink)
        e.first = place;
    else
        crossing_links[FIRST + before] = crossing_links[FIRST + before] - next + place;
    return steps;
}

// Adds to the count what segment i changes by whole numbers, and the crossing to the chain. Lanes without `asked` add nothing.
void settle_segment(inout Walk e, int i, bool asked) {
    ivec4 c = ivec4(e.cells);
    ivec4 f = ivec4(cells[FIRST + i]);
    int mark = marks[FIRST + i];
    ivec2 d = c.zw - c.xy;
    ivec2 df = f.zw - f.xy;
    ivec2 q = c.xy - f.xy;
    Sides sides = Sides(long_cross(df, q), long_cross(q, d), long_cross(df, d));
    Signs signs = and_signs(Signs(ivec4(0), 0), sides);
    float at = place_between(sides);
    ivec2 height = 2 * f.yw - (c.y + c.w);
    bool tie = any(equal(signs.ends, ivec4(0))) || signs.middle == 0 || any(equal(height, ivec2(0)));
    // Displacements decide. A loop of at most one turn, as elsewhere.
    for (int turn = tie && asked ? 0 : 1; turn < 1; turn++) {
        ivec4 shift_e = displacements(e.names);
        ivec4 shift_f = displacements(names[FIRST + i]);
        ivec2 g = shift_e.zw - shift_e.xy;
        ivec2 gf = shift_f.zw - shift_f.xy;
        ivec2 r = shift_e.xy - shift_f.xy;
        Sides first = Sides(long_cross(df, r) + long_cross(gf, q), long_cross(r, d) + long_cross(q, g), long_cross(df, g) + long_cross(gf, d));
        signs = and_signs(and_signs(signs, first), Sides(long_cross(gf, r), long_cross(r, g), long_cross(gf, g)));
        if (at < 0.0) at = place_between(first);
        ivec2 shifted = 2 * shift_f.yw - (shift_e.y + shift_e.w);
        if (height.x == 0) height.x = shifted.x;
        if (height.y == 0) height.y = shifted.y;
    }
    bool passes = (height.x > 0) != (height.y > 0) && i != e.number;
    if (asked) e.count += left_events(mark, height.x < 0, height.y < 0) + (passes ? left_ray(weight_of(mark), height.y > 0, signs.middle >= 0) : 0);

    bool to_left = signs.ends.y >= 0;
    bool crosses = asked && (signs.ends.x >= 0) != to_left && (signs.ends.z >= 0) != (signs.ends.w >= 0) && !share_an_end(e.names, names[FIRST + i]);
    int change = to_left ? weight_of(mark) : -weight_of(mark);
    // The middle is still to come where it lies on the end's side.
    if (crosses && (signs.middle >= 0) == to_left) e.before_middle += change;
    int all;
    int place = crossing_count + begin_of(crosses, all);
    crossing_count += all;
    too_much = too_much || crossing_count > SPACE;
    int steps = 0;
    if (crosses && !too_much) steps = add_crossing(e, place, at < 0.0 ? 0.5 : at, change);
    turns -= 4 + most_of_lanes(steps);
}

void look_at_all(inout Walk e) {
    for (int first = 0; first < segment_count && !too_much; first += kSetOfPairs) {
        int past = min(first + kSetOfPairs, segment_count);
        uint near = 0u;
        for (int i = first; i < past; i += kAtOnce) {
#if !FEW
            if (is_passed_by(e, i / kAtOnce)) continue;
#endif
            uint some = 0u;
            for (int k = 0; k < kAtOnce; k++) some |= is_near(e, i + k) ? 1u << k : 0u;  // compilers unroll it
            near |= some << (i - first);
        }
        if (!e.mine) near = 0u;
        turns -= most_of_lanes(bitCount(near));
        near_pairs += bitCount(near);
        uint open = 0u;
        for (; near != 0u; near &= near - 1u)
            if (look_at_segment(e, first + findLSB(near))) open |= near & -near;
        open_pairs += bitCount(open);
        while (any_of_lanes(open != 0u) && !too_much) {
            settle_segment(e, first + max(findLSB(open), 0), open != 0u);
            open &= open - 1u;
            too_much = too_much || turns < 0;
        }
    }
}

// Appends the pieces of the lanes' segments to those of the segments before, if they are at the lowest count of all.
void take_pieces(Walk e) {
    float rise = e.cells.w - e.cells.y;
    bool up = rise > 0.0;
    for (int turn = rise == 0.0 ? 0 : 1; turn < 1; turn++) up = displacement(e.names.y).y > displacement(e.names.x).y;
    int weight = weight_of(marks[FIRST + e.number]);
    // The count is on the -x side, which is the left if the segment runs up.
    int begin = (up ? e.count : e.count + weight) - e.before_middle;
    bool has_pieces = e.mine && weight != 0;
    int lowest = kHidden / 2 - 1;
    int count = 0;
    int to = 0;
    int steps = 0;
    // The first pass counts the pieces at the lowest level, the second one stores them.
    for (int pass = 0; pass < 2; pass++) {
        bool walks = has_pieces;
        int left = begin;
        int next = e.first;
        float from = 0.0;
        count = 0;
        while (walks) {
            walks = next != kNoLink;
            float until = walks ? crossing_at[FIRST + next] : 1.0;
            int low = min(left, left - weight);
            if (until > from) {
                if (low < lowest) {
                    lowest = low;
                    count = 0;
                }
                if (low == lowest) {
                    if (pass == 1 && !too_many_pieces) {
                        pieces[FIRST + to + count] = vec2(from, until);
                        piece_segments[FIRST + to + count] = e.number;
                    }
                    ++count;
                }
                from = until;
            }
            if (walks) {
                left += crossing_links[FIRST + next] >> kLinkBits;
                next = crossing_links[FIRST + next] & kNoLink;
            }
            ++steps;
        }
        if (pass == 1) break;
        int least = least_of_lanes(lowest);
        if (least < level) {
            level = least;
            piece_count = 0;
            too_many_pieces = false;
        }
        int all;
        to = piece_count + begin_of(lowest == level ? count : 0, all);
        too_many_pieces = too_many_pieces || piece_count + all > SPACE;
        if (!too_many_pieces) piece_count += all;
        has_pieces = has_pieces && lowest == level;
    }
    turns -= most_of_lanes(steps);
}

void cut_segments(int base) {
    piece_count = 0;
    level = kHidden / 2 - 1;
    too_many_pieces = false;
    // Segments far away without a weight fill the last turn.
    for (int i = segment_count + int(LANE); i < min(segment_count + kAtOnce, SPACE); i += LANES) {
        cells[FIRST + i] = vec4(4.0 * shadow_cells());
        marks[FIRST + i] = 0;
    }
#if !FEW
    subgroupBarrier();
    sort_segments();
    find_boxes();
#endif
    subgroupBarrier();
    for (int first = 0; first < segment_count && !too_much; first += LANES) {
        int i = first + int(LANE);
        int number = min(i, segment_count - 1);
        vec4 ends = cells[FIRST + number];
        vec4 box = vec4(min(ends.xy, ends.zw), max(ends.xy, ends.zw));
        bool mine = i < segment_count && ends.xy != ends.zw;
        Walk e = Walk(number, mine, ends, names[FIRST + number], box, 0.5 * (ends.xy + ends.zw), base, 0, kNoLink);
        crossing_count = 0;
        look_at_all(e);
        take_pieces(e);
        too_much = too_much || turns < 0;
    }
    too_much = too_much || too_many_pieces;
    subgroupBarrier();
}
