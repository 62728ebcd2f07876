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

// Place at which this lane's results begin among all lanes' results, in lane order. all: number of all results. Every lane must call this and
// the operations of the subgroup, without divergent branches. A barrier makes what lanes have written visible to all of them.
int begin_of(int count, out int all) {
    subgroupBarrier();
    all = subgroupAdd(count);
    return subgroupExclusiveAdd(count);
}
// The same for at most one result a lane.
int begin_of(bool one, out int all) {
    subgroupBarrier();
    uvec4 lanes = subgroupBallot(one);
    all = int(subgroupBallotBitCount(lanes));
    return int(subgroupBallotExclusiveBitCount(lanes));
}
