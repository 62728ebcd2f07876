// The threads that work on a point: all lanes of a subgroup, each on every LANES-th edge or segment. Results of lanes are stored in the
// order of the edges, so nothing depends on timing. Segments and pieces are in shared memory; all else uses the subgroup.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

// A work group is as large as the device says that its subgroups are. If it is several of them nevertheless, main() skips the point.
layout(local_size_x_id = 2) in;
#define LANE gl_SubgroupInvocationID
#define LANES gl_WorkGroupSize.x

// Makes what lanes have written visible to all of them. Every lane must call this and all functions below, without divergent branches.
void meet() { subgroupBarrier(); }
// Place at which this lane's results begin among all lanes' results, in lane order. all: number of all results.
int begin_of(int count, out int all) {
    meet();
    all = subgroupAdd(count);
    return subgroupExclusiveAdd(count);
}
// The same for at most one result a lane.
int begin_of(bool one, out int all) {
    meet();
    uvec4 lanes = subgroupBallot(one);
    all = int(subgroupBallotBitCount(lanes));
    return int(subgroupBallotExclusiveBitCount(lanes));
}
vec4 sum_of_lanes(vec4 x) { return subgroupAdd(x); }
int sum_of_lanes(int x) { return subgroupAdd(x); }
int least_of_lanes(int x) { return subgroupMin(x); }
int most_of_lanes(int x) { return subgroupMax(x); }
float least_of_lanes(float x) { return subgroupMin(x); }
float most_of_lanes(float x) { return subgroupMax(x); }
bool any_of_lanes(bool x) { return subgroupAny(x); }
uint of_first_lane(uint x) { return subgroupBroadcastFirst(x); }

// Returns true if this lane's element exists. Lane by lane, i is first, first + 1 and so on.
bool is_mine(uint i, uint count) { return i < count; }
