// The part of a light that blockers leave visible: an interval, and intervals cut out of it. Places are slopes, or distances at which rays
// pass a round light's centre (plane_disk.glsl).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

const float kBeyond = 1.0e9;

float low;
float high;
float begins[kIntervals];  // sorted and disjoint
float ends[kIntervals];
int taken;
bool too_many;
int turns;  // upper bound of the turns that loops have taken

void open_cut(float from, float to) {
    low = from;
    high = to;
    taken = 0;
}

void keep_interval(float from, float to) {
    turns += 3 * taken + 3;
    int first = 0;
    while (first < taken && ends[first] < from) ++first;
    int last = first;
    while (last < taken && begins[last] <= to) {
        from = min(from, begins[last]);
        to = max(to, ends[last]);
        ++last;
    }
    if (last == first) {
        if (taken == kIntervals) {
            too_many = true;
            return;
        }
        for (int k = taken; k > first; k--) {
            begins[k] = begins[k - 1];
            ends[k] = ends[k - 1];
        }
        ++taken;
    } else if (last > first + 1) {
        int gone = last - first - 1;
        for (int k = last; k < taken; k++) {
            begins[k - gone] = begins[k];
            ends[k - gone] = ends[k];
        }
        taken -= gone;
    }
    begins[first] = from;
    ends[first] = to;
}

void take(float from, float to) {
    if (!(from < to)) return;
    if (from <= low) {
        low = max(low, to);
    } else if (to >= high) {
        high = min(high, from);
    } else if (low < high) {
        keep_interval(from, to);
    }
}

// End of gap k of the gaps that are left, 0 ... taken; a gap may be empty. `from` is where gap k begins: low at first.
float gap_end(int k) { return k < taken ? min(begins[k], high) : high; }
float after_gap(int k, float from) { return k < taken ? max(from, min(ends[k], high)) : high; }

// Slope of a direction (w along the axis, t across it), or `beyond` if it is not in front.
float slope(float w, float t, float beyond) { return plane_slope(w, t, beyond); }
