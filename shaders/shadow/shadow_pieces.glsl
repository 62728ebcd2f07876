// The pieces of segments at the lowest count: step 6 of docs/shadows.md.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

int piece_count;
int level;  // the lowest count so far
bool too_many_pieces;

// Begin and end of a piece, with the side of the lower count on its left.
vec4 piece_ends(int i) {
    vec4 e = cells[FIRST + piece_segments[FIRST + i]];
    vec2 d = e.zw - e.xy;
    vec2 ways = pieces[FIRST + i];
    vec4 ends = vec4(e.xy + ways.x * d, ways.y < 1.0 ? e.xy + ways.y * d : e.zw);
    return weights[FIRST + piece_segments[FIRST + i]] > 0 ? ends.zwxy : ends;
}

// Puts the crossings of a lane's segment in their order along it. Returns the number of turns.
int sort_crossings(inout int first) {
    int steps = 0;
    int unsorted = first;
    first = kNoLink;
    while (unsorted != kNoLink) {
        int place = unsorted;
        int link = crossing_links[FIRST + place];
        float at = crossing_at[FIRST + place];
        unsorted = link & kNoLink;
        int before = kNoLink;
        int next = first;
        while (next != kNoLink && crossing_at[FIRST + next] <= at) {
            before = next;
            next = crossing_links[FIRST + next] & kNoLink;
            ++steps;
        }
        crossing_links[FIRST + place] = link - unsorted + next;
        if (before == kNoLink)
            first = place;
        else
            crossing_links[FIRST + before] = crossing_links[FIRST + before] - next + place;
        ++steps;
    }
    return steps;
}

// Appends the pieces of the lanes' segments to those of the segments before, if they are at the lowest count of all.
void take_pieces(int number, bool mine, int begin, int first) {
    int weight = weights[FIRST + number];
    bool has_pieces = mine && weight != 0;
    int lowest = kHidden / 2 - 1;
    int count = 0;
    int to = 0;
    int steps = sort_crossings(first);
    // The first pass counts the pieces at the lowest level, the second one stores them.
    for (int pass = 0; pass < 2; pass++) {
        bool walks = has_pieces;
        int left = begin;
        int next = first;
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
                        piece_segments[FIRST + to + count] = number;
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
    steps = most_of_lanes(steps);
    turns -= steps;
    count_crossings(steps);
}

void cut_segments(int base) {
    piece_count = 0;
    level = kHidden / 2 - 1;
    too_many_pieces = false;
    order_segments();
#if !FEW
    if (COUNTS == 1) looks_counted = looks_together();
#endif
    for (int first = 0; first < segment_count && !too_much; first += LANES) {
        int i = first + int(LANE);
        int number = min(i, segment_count - 1);
        vec4 ends = cells[FIRST + number];
        bool mine = i < segment_count && ends.xy != ends.zw && !is_wall(ends);
        Walk e = Walk(mine, ends, vec2(min(ends.x, ends.z), max(ends.x, ends.z)), 0);
        look_at_all(e, first);
        if (too_much) break;
        int own = OF_LANE(int(LANE));
        take_pieces(number, mine, base - e.met - from_start[own], first_crossing[own]);
        add_turns(first);
        too_much = too_much || turns < 0;
    }
    too_much = too_much || too_many_pieces;
    subgroupBarrier();
}
