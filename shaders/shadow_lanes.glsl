// Who works on a point: one thread, or all those of a subgroup, its lanes, each on every LANES-th edge or segment. What lanes find is put in the
// order of the edges, so nothing depends on who was first. Segments and pieces stand in shared memory; all else goes through the subgroup.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

#ifdef MANY_EDGES
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

// A work group is as large as the device says that its subgroups are. Where it is several of them nevertheless, main() leaves the point.
layout(local_size_x_id = 2) in;
#define LANE gl_SubgroupInvocationID
#define LANES gl_WorkGroupSize.x
#define SHARED shared

// What lanes have written is there for all of them. Every lane must come here and to all below: no branch that they do not all take.
void meet() { subgroupBarrier(); }
// Where what this lane has begins among all lanes' in their order; all: how much they have.
uint begin_of(uint count, out uint all) {
    meet();
    all = subgroupAdd(count);
    return subgroupExclusiveAdd(count);
}
vec4 sum_of_lanes(vec4 x) { return subgroupAdd(x); }
int sum_of_lanes(int x) { return subgroupAdd(x); }
int least_of_lanes(int x) { return subgroupMin(x); }
int most_of_lanes(int x) { return subgroupMax(x); }
float least_of_lanes(float x) { return subgroupMin(x); }
float most_of_lanes(float x) { return subgroupMax(x); }
bool any_of_lanes(bool x) { return subgroupAny(x); }
uint of_first_lane(uint x) { return subgroupBroadcastFirst(x); }

#else

const uint LANES = 1u;
layout(local_size_x = 64) in;
#define LANE 0u
#define SHARED

void meet() {}
vec4 sum_of_lanes(vec4 x) { return x; }
int sum_of_lanes(int x) { return x; }
int least_of_lanes(int x) { return x; }
int most_of_lanes(int x) { return x; }
float least_of_lanes(float x) { return x; }
float most_of_lanes(float x) { return x; }
bool any_of_lanes(bool x) { return x; }
uint of_first_lane(uint x) { return x; }

#endif

// Lane by lane what is first, first + 1 and so on, as far as there is one.
bool is_mine(uint i, uint count) { return LANES == 1u || i < count; }
