// The segments in a form in which counts along them are simple: all run up, walls replace cuts by the box's left side, and those of a large
// space are in the order of their heights.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// All segments run up, or to the right. The count is that of a ray to the left from a place on the segment, higher than its middle by less
// than any other difference. So an end at the middle's height is below the ray.
void stand_up(int i) {
    vec4 e = cells[FIRST + i];
    if (e.y < e.w || (e.y == e.w && e.x <= e.z)) return;
    cells[FIRST + i] = e.zwxy;
    names[FIRST + i] = names[FIRST + i].yx;
    weights[FIRST + i] = -weights[FIRST + i];
}

// If the box's left side cuts a segment, the count changes for all rays above. A wall does the same: a segment far left, which goes up
// from there.
const float kFar = 16777216.0;  // beyond all cells
bool is_wall(vec4 e) { return e.x == -kFar; }

void add_walls() {
    int count = segment_count;
    for (int first = 0; first < count && !too_much; first += LANES) {
        int i = first + int(LANE);
        bvec2 cut = i < count ? greaterThanEqual(names[FIRST + i], uvec2(kLeftName)) : bvec2(false);
        if (!any_of_lanes(any(cut))) continue;
        if (any(cut)) names[FIRST + i] &= ~kLeftName;
        for (int end = 0; end < 2; end++) {
            found = end == 0 ? cut.x : cut.y;
            if (found) {
                float height = end == 0 ? cells[FIRST + i].y : cells[FIRST + i].w;
                add_segment(vec4(-kFar, height, -kFar, kFar), uvec2(0u), end == 0 ? -weights[FIRST + i] : weights[FIRST + i]);
            }
            gather_segments(segment_count);
        }
    }
    subgroupBarrier();
}

#if !FEW
// Boxes of as many segments as a turn looks at: low corner, high corner.
shared vec4 boxes[SPACE / kAtOnce];

// A height is one of kHeights ranges.
const int kHeights = 64;
int height_of(int i) {
    return clamp(int((cells[i].y + cells[i].w) / shadow_cells() * (0.25 * float(kHeights)) + 0.5 * float(kHeights)), 0, kHeights - 1);
}

// Puts the segments in the order of their heights. Then those of a turn are at about the same height, and so are those of the lanes. The
// arrays of pieces and crossings, which are still empty, hold them meanwhile.
void sort_segments() {
    for (int h = int(LANE); h < kHeights; h += LANES) crossing_links[h] = 0;
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) atomicAdd(crossing_links[height_of(i)], 1);
    int before = 0;
    for (int first = 0; first < kHeights; first += LANES) {
        int h = min(first + int(LANE), kHeights - 1);
        int all;
        int begin = before + begin_of(first + int(LANE) < kHeights ? crossing_links[h] : 0, all);
        before += all;
        if (first + int(LANE) < kHeights) crossing_links[h] = begin;
    }
    subgroupBarrier();
    // Segments of one height come in any order. Then each counts those of its height that have smaller numbers.
    for (int i = int(LANE); i < segment_count; i += LANES) piece_segments[atomicAdd(crossing_links[height_of(i)], 1)] = i;
    subgroupBarrier();
    int most = 0;
    for (int i = int(LANE); i < segment_count; i += LANES) {
        int h = height_of(i);
        int begin = h > 0 ? crossing_links[h - 1] : 0;
        int place = begin;
        most = max(most, crossing_links[h] - begin);
        for (int k = begin; k < crossing_links[h]; k++) place += piece_segments[k] < i ? 1 : 0;
        crossing_at[i] = float(place);
    }
    most = most_of_lanes(most);
    turns -= most * (segment_count / LANES + 1);
    sort_turns = most * (segment_count / kTogether + 1);
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
        pieces[to].x = float(weights[i]);
    }
    subgroupBarrier();
    for (int i = int(LANE); i < segment_count; i += LANES) {
        names[i] = uvec2(crossing_links[i], piece_segments[i]);
        weights[i] = int(pieces[i].x);
    }
    subgroupBarrier();
}

void find_boxes() {
    for (int b = int(LANE); b * kAtOnce < segment_count; b += LANES) {
        vec4 box = vec4(1.0e30, 1.0e30, -1.0e30, -1.0e30);
        for (int i = b * kAtOnce; i < min(b * kAtOnce + kAtOnce, segment_count); i++) {
            vec4 f = cells[i];
            box = vec4(min(box.xy, min(f.xy, f.zw)), max(box.zw, max(f.xy, f.zw)));
        }
        boxes[b] = box;
    }
}
#endif

void order_segments() {
    add_walls();
    // Segments far away without a weight fill the last turn.
    for (int i = segment_count + int(LANE); i < min(segment_count + kAtOnce, SPACE); i += LANES) {
        cells[FIRST + i] = vec4(kFar);
        weights[FIRST + i] = 0;
    }
    for (int i = int(LANE); i < segment_count; i += LANES) stand_up(i);
    subgroupBarrier();
#if !FEW
    sort_segments();
    find_boxes();
    subgroupBarrier();
#endif
}
