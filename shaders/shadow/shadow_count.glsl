// The counts of the segments that the lanes have in work, and their crossings: step 5 of docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

shared uint crossing_counts[POINTS];
const int kLinkBits = 12;
const int kLinks = 1 << kLinkBits;
const int kNoLink = kLinks - 1;

// A segment e whose count is computed: the lane's own.
struct Walk {
    bool mine;   // false: the lane only takes part in the loops of all lanes
    vec4 cells;
    vec2 sides;  // least and greatest x
    int met;     // weights that the ray from its middle meets, far from it
};
float middle_height(vec4 e) { return 0.5 * (e.y + e.w); }

// Results for the segments in work, which any lane may add.
shared int from_start[gl_WorkGroupSize.x];  // weights that the ray meets near the segment, and changes from the start to the middle
shared int first_crossing[gl_WorkGroupSize.x];
#define OF_LANE(lane) (MINE * LANES + (lane))

// A ray to the left at a height meets segments that reach from below it, or from it, to above it. The count at its begin is lower by the
// weights of those that it meets.
bool is_across(vec4 f, float height) { return f.y <= height && f.w > height; }

// Adds the weight of segment f = i if the ray from e's middle meets it, and f and e are clearly apart. Returns true, and adds nothing,
// if their boxes meet. Where they are apart there is no crossing, and a segment across the ray's height is left of e or right of it as a whole.
bool is_near(inout Walk e, int i, float height) {
    vec4 f = cells[FIRST + i];
    int weight = weights[FIRST + i];
    bool left = max(f.x, f.z) < e.sides.x;
    bool right = min(f.x, f.z) > e.sides.y;
    e.met += left && is_across(f, height) ? weight : 0;
    return f.y <= e.cells.w && f.w >= e.cells.y && !left && !right;
}

#if !FEW
// Bits of the boxes whose segments may change something: they are not above all lanes' segments, below them or right of them.
shared uint reached_boxes[SPACE / kAtOnce / 32 + 1];

void find_reached_boxes(Walk e) {
    for (int word = int(LANE); word <= SPACE / kAtOnce / 32; word += LANES) reached_boxes[word] = 0u;
    vec2 heights = least_of_lanes(e.mine ? vec2(e.cells.y, -e.cells.w) : vec2(kFar));
    float right = -least_of_lanes(vec2(e.mine ? -e.sides.y : kFar)).x;
    subgroupBarrier();
    for (int b = int(LANE); b * kAtOnce < segment_count; b += LANES) {
        vec4 box = boxes[b];
        if (box.w >= heights.x && box.y <= -heights.y && box.x <= right) atomicOr(reached_boxes[b / 32], 1u << b % 32);
    }
}

// For reports: turns in which kTogether lanes look at boxes. The box of all their segments decides, so this is an upper bound.
int looks_together() {
    int looks = 0;
    int all = (segment_count + kAtOnce - 1) / kAtOnce;
    for (int first = 0; first < segment_count; first += kTogether) {
        vec4 box = vec4(kFar, kFar, -kFar, -kFar);
        for (int i = first; i < min(first + kTogether, segment_count); i++)
            if (!is_wall(cells[i])) box = vec4(min(box.xy, min(cells[i].xy, cells[i].zw)), max(box.zw, max(cells[i].xy, cells[i].zw)));
        for (int b = 0; b < all; b++) looks += boxes[b].w < box.y || boxes[b].y > box.w || boxes[b].x > box.z ? 0 : 1;
    }
    return looks;
}
#endif

bool share_an_end(uvec2 a, uvec2 b) { return a.x == b.x || a.x == b.y || a.y == b.x || a.y == b.y; }

// A pair of segments near each other: that of a lane, e, and another one, f.
const int kNumberBits = 10;
struct Pair {
    int lane;
    int number;
    int other;
};
Pair pair_of(uint packed, int first) {
    int lane = int(packed >> kNumberBits);
    return Pair(lane, first + lane, int(packed & (1u << kNumberBits) - 1u));
}

// Adds what f changes. The crossings of a segment are in no order yet.
void add_pair(Pair pair, bool met, bool crosses, float at, bool to_left, bool left_of_f) {
    int weight = weights[FIRST + pair.other];
    int change = to_left ? weight : -weight;
    // The middle is still to come where it lies on the end's side.
    int before_middle = crosses && left_of_f == to_left ? change : 0;
    atomicAdd(from_start[OF_LANE(pair.lane)], (met ? weight : 0) + before_middle);
    if (!crosses) return;
    int place = int(atomicAdd(crossing_counts[MINE], 1u));
    if (place >= SPACE) return;
    crossing_at[FIRST + place] = at;
    crossing_links[FIRST + place] = kLinks * change + atomicExchange(first_crossing[OF_LANE(pair.lane)], place);
}

// Adds what a pair changes, by floats alone. Returns true, and adds nothing, if they cannot decide.
//
// Three products tell all sides: of e's start from f, of f's start from e, and of e's direction from f's. The others are sums. Differences
// of cells are exact. Each sum is off by less than 2^-22 of the sizes of all products, and 4e-7 is more. Floats also leave open a crossing
// whose place on e may be off by kOffCells.
// Two segments as long as the box, which cross in their middles at right angles, are within it: 4e-7 times 2 times 2^23 cells.
const float kOffCells = 8.0;
bool look_at_pair(Pair pair) {
    vec4 e = cells[FIRST + pair.number];
    vec4 f = cells[FIRST + pair.other];
    vec2 d = e.zw - e.xy;
    vec2 df = f.zw - f.xy;
    vec2 q = e.xy - f.xy;
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
    float least = min(along, across);
    float most = max(along, across) - abs(all);
    bool meets = least >= -bound && most <= bound && !share_an_end(names[FIRST + pair.number], names[FIRST + pair.other]);
    float middle = 2.0 * start + all;
    bool off = least <= bound || most >= -bound || bound * max(abs(d.x), d.y) > kOffCells * abs(all);
    bool across_ray = is_across(f, middle_height(e));
    if ((across_ray || meets) && abs(middle) <= 2.0 * bound || meets && off) return true;
    add_pair(pair, across_ray && middle < 0.0, meets, -start / all, all > 0.0, middle > 0.0);
    return false;
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

// Adds what a pair changes, by whole numbers.
void settle_pair(Pair pair) {
    ivec4 c = ivec4(cells[FIRST + pair.number]);
    ivec4 f = ivec4(cells[FIRST + pair.other]);
    uvec2 named = names[FIRST + pair.number];
    uvec2 named_f = names[FIRST + pair.other];
    ivec2 d = c.zw - c.xy;
    ivec2 df = f.zw - f.xy;
    ivec2 q = c.xy - f.xy;
    Sides sides = Sides(long_cross(df, q), long_cross(q, d), long_cross(df, d));
    Signs signs = and_signs(Signs(ivec4(0), 0), sides);
    float at = place_between(sides);
    // Then the ray's begin is above the middle.
    if (signs.middle == 0) signs.middle = d.y > 0 ? sign_of(sides.turn) : sign(df.x);
    bool tie = any(equal(signs.ends, ivec4(0))) || signs.middle == 0;
    // Displacements decide. A loop of at most one turn, as elsewhere.
    for (int turn = tie ? 0 : 1; turn < 1; turn++) {
        ivec4 shift_e = displacements(named);
        ivec4 shift_f = displacements(named_f);
        ivec2 g = shift_e.zw - shift_e.xy;
        ivec2 gf = shift_f.zw - shift_f.xy;
        ivec2 r = shift_e.xy - shift_f.xy;
        Sides first = Sides(long_cross(df, r) + long_cross(gf, q), long_cross(r, d) + long_cross(q, g), long_cross(df, g) + long_cross(gf, d));
        signs = and_signs(and_signs(signs, first), Sides(long_cross(gf, r), long_cross(r, g), long_cross(gf, g)));
        if (at < 0.0) at = place_between(first);
    }
    bool to_left = signs.ends.y >= 0;
    bool crosses = (signs.ends.x >= 0) != to_left && (signs.ends.z >= 0) != (signs.ends.w >= 0) && !share_an_end(named, named_f);
    bool met = signs.middle < 0 && is_across(vec4(f), middle_height(vec4(c)));
    add_pair(pair, met, crosses, at < 0.0 ? 0.5 : at, to_left, signs.middle >= 0);
}

// Pairs wait until there is one for each lane: near ones from the begin on, and those that floats leave open from the end on. No more than
// LANES wait of one kind while up to twice as many wait of the other one.
shared uint waiting_pairs[3 * gl_WorkGroupSize.x];
#define FIRST_WAITING (3 * OF_LANE(0))

// Looks at all segments for those of the lanes, from `first` on.
void look_at_all(inout Walk e, int first) {
    if (LANE == 0u) crossing_counts[MINE] = 0u;
    from_start[OF_LANE(int(LANE))] = 0;
    first_crossing[OF_LANE(int(LANE))] = kNoLink;
#if !FEW
    find_reached_boxes(e);
#endif
    subgroupBarrier();
    int all;
    int near_waiting = 0;
    int open_waiting = 0;
    int own = first + int(LANE);
    int last_waiting = FIRST_WAITING + 3 * LANES - 1;
    for (int set = 0; set < segment_count + kSetOfPairs && !too_much; set += kSetOfPairs) {
        bool last = set >= segment_count;
        uint near = 0u;
        float height = middle_height(e.cells);
#if !FEW
        uint reached = reached_boxes[set / kAtOnce / 32] >> set / kAtOnce % 32;
#endif
        for (int i = set; i < min(set + kSetOfPairs, segment_count); i += kAtOnce) {
#if !FEW
            if ((reached & 1u << (i - set) / kAtOnce) == 0u) continue;
#endif
            uint some = 0u;
            for (int k = 0; k < kAtOnce; k++) some |= is_near(e, i + k, height) ? 1u << k : 0u;  // compilers unroll it
            near |= some << (i - set);
        }
        if (!e.mine) near = 0u;
        if (own / kSetOfPairs == set / kSetOfPairs) near &= ~(1u << own % kSetOfPairs);
        count_turns(set / kSetOfPairs, bitCount(near));
        bool again = true;
        while (again) {
            while (near_waiting < LANES && any_of_lanes(near != 0u)) {
                int to = FIRST_WAITING + near_waiting + begin_of(near != 0u, all);
                if (near != 0u) waiting_pairs[to] = LANE << kNumberBits | uint(set + findLSB(near));
                near &= near - 1u;
                near_waiting += all;
                --turns;
            }
            subgroupBarrier();
            if (near_waiting >= LANES || last) {
                bool looks = int(LANE) < near_waiting;
                near_waiting = max(near_waiting - LANES, 0);
                uint pair = waiting_pairs[FIRST_WAITING + near_waiting + int(LANE)];
                bool open = looks && look_at_pair(pair_of(pair, first));
                int to = last_waiting - open_waiting - begin_of(open, all);
                if (open) waiting_pairs[to] = pair;
                open_waiting += all;
                subgroupBarrier();
            }
            if (open_waiting >= LANES || (last && open_waiting > 0)) {
                bool settles = int(LANE) < open_waiting;
                open_counted += min(open_waiting, LANES);
                open_waiting = max(open_waiting - LANES, 0);
                if (settles) settle_pair(pair_of(waiting_pairs[last_waiting - open_waiting - int(LANE)], first));
            }
            again = any_of_lanes(near != 0u) || (last && near_waiting + open_waiting > 0);
            turns -= 3;
        }
        too_much = turns < 0;
    }
    subgroupBarrier();
    too_much = too_much || crossing_counts[MINE] > uint(SPACE);
}
