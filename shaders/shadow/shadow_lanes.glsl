// The threads that work on a point: LANES lanes of a subgroup, each on every LANES-th edge or segment. Results of lanes are stored in the
// order of the edges, so nothing depends on timing. Segments and pieces are in shared memory; all else uses the subgroup.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

// A work group is as large as the device says that its subgroups are. If it is several of them nevertheless, main() skips the point.
layout(local_size_x_id = 2) in;
#if FEW
// A subgroup works on several points, each by a set of LANES lanes: a power of two, at most 32.
layout(constant_id = 1) const int LANES = 4;
#define LANE (gl_SubgroupInvocationID % uint(LANES))
#define POINTS (gl_WorkGroupSize.x / uint(LANES))
#define MINE int(gl_SubgroupInvocationID / uint(LANES))  // the set of lanes
#else
#define LANES int(gl_WorkGroupSize.x)
#define LANE gl_SubgroupInvocationID
#define POINTS 1u
#define MINE 0
#endif

// All lanes of a point must call the functions below without divergent branches. Two points may take different branches.

#if FEW
shared vec2 lane_values[gl_WorkGroupSize.x];

// The value of the lane whose number differs by `bit`.
vec2 of_other_lane(vec2 value, uint bit) {
    subgroupBarrier();
    lane_values[gl_SubgroupInvocationID] = value;
    subgroupBarrier();
    return lane_values[gl_SubgroupInvocationID ^ bit];
}
vec2 sum_of_lanes(vec2 value) {
    for (uint bit = 1u; bit < uint(LANES); bit *= 2u) value += of_other_lane(value, bit);
    return value;
}
vec2 least_of_lanes(vec2 value) {
    for (uint bit = 1u; bit < uint(LANES); bit *= 2u) value = min(value, of_other_lane(value, bit));
    return value;
}
// Few segments have whole numbers below 2^24, so floats have them.
int sum_of_lanes(int value) { return int(sum_of_lanes(vec2(value)).x); }
int least_of_lanes(int value) { return int(least_of_lanes(vec2(value)).x); }

// The bits of the lanes with a flag.
uint lanes_with(bool one) {
    uint first = uint(LANES) * uint(MINE);
    return subgroupBallot(one)[first / 32u] >> (first % 32u) & 0xffffffffu >> (32 - LANES);
}
bool any_of_lanes(bool one) { return lanes_with(one) != 0u; }

// Place at which this lane's results begin among all lanes' results, in lane order. all: number of all results. A barrier makes what
// lanes have written visible to all of them. Here for at most one result a lane.
int begin_of(bool one, out int all) {
    subgroupBarrier();
    uint lanes = lanes_with(one);
    all = bitCount(lanes);
    return bitCount(lanes & (1u << LANE) - 1u);
}
// The same for any number of results.
int begin_of(int count, out int all) {
    int before = 0;
    all = 0;
    for (int bit = 0; any_of_lanes(count >> bit != 0); bit++) {
        int of_bit;
        before += begin_of((count >> bit & 1) != 0, of_bit) << bit;
        all += of_bit << bit;
    }
    return before;
}
#else
vec2 sum_of_lanes(vec2 value) { return subgroupAdd(value); }
int sum_of_lanes(int value) { return subgroupAdd(value); }
vec2 least_of_lanes(vec2 value) { return subgroupMin(value); }
int least_of_lanes(int value) { return subgroupMin(value); }
bool any_of_lanes(bool one) { return subgroupAny(one); }
int begin_of(bool one, out int all) {
    subgroupBarrier();
    uvec4 lanes = subgroupBallot(one);
    all = int(subgroupBallotBitCount(lanes));
    return int(subgroupBallotExclusiveBitCount(lanes));
}
int begin_of(int count, out int all) {
    subgroupBarrier();
    all = subgroupAdd(count);
    return subgroupExclusiveAdd(count);
}
#endif
int most_of_lanes(int value) { return -least_of_lanes(-value); }
