// Parity cases of representative_point.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Walk around the parallelogram for its representative point.
RepresentativeWalk case_representative_walk(CaseInput i, vec3 mirror) {
    RepresentativeWalk walk = representative_begin();
    for (int k = 0; k < 4; k++) {
        walk = representative_add_edge(walk, mirror, case_vertex(i, k), case_vertex(i, k + 1));
    }
    return walk;
}

// representative point, radiance and v.h, quad
//   a.xyz  vector(1, 5)
//   b.xyz  vector(0.1, 2)
//   c.xyz  vector(0.1, 2)
//   d.xyz  upper_direction
//   a.w    range(0.2, 1)
//   b.w    range(0, 3)
// Values: 2
vec4 case_representative_point(CaseInput i) {
    vec3 view = case_xyz(i.d);
    vec3 mirror = vec3(-view.x, -view.y, view.z);
    RepresentativeWalk walk = case_representative_walk(i, mirror);
    mask reversed = case_walk_reversed(i);
    return vec4(representative_radiance(walk, view, mirror, i.b.w, i.a.w, reversed),
                representative_v_dot_h(walk, view, mirror, reversed), 0.0, 0.0);
}
