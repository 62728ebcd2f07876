// Parity cases of polygon.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// polygon direction
//   a.xyz  vector(1e-12, 1e12)
// Values: 3
vec4 case_polygon_direction(CaseInput i) { return case_of_vec3(polygon_direction(case_xyz(i.a))); }

// polygon edge
//   a.xyz  direction
//   b.xyz  direction
// Values: 3
vec4 case_polygon_edge(CaseInput i) { return case_of_vec3(polygon_edge(case_xyz(i.a), case_xyz(i.b))); }

// Corner of a parallelogram with centre a and half axes b and c.
vec3 case_corner(CaseInput i, real x, real y) {
    return case_xyz(i.a) + case_xyz(i.b) * x + case_xyz(i.c) * y;
}

// Walk around that parallelogram.
PolygonWalk case_walk(CaseInput i) {
    vec3 v0 = polygon_direction(case_corner(i, -1.0, -1.0));
    vec3 v1 = polygon_direction(case_corner(i, 1.0, -1.0));
    vec3 v2 = polygon_direction(case_corner(i, 1.0, 1.0));
    vec3 v3 = polygon_direction(case_corner(i, -1.0, 1.0));
    PolygonWalk walk = polygon_begin();
    walk = polygon_add_edge(walk, v0, v1);
    walk = polygon_add_edge(walk, v1, v2);
    walk = polygon_add_edge(walk, v2, v3);
    walk = polygon_add_edge(walk, v3, v0);
    return walk;
}

// True where the walk around the parallelogram runs the wrong way.
mask case_walk_reversed(CaseInput i) {
    return dot(case_xyz(i.a), cross(case_xyz(i.b), case_xyz(i.c))) < 0.0;
}

// polygon irradiance vector, quad
//   a.xyz  vector(0.1, 10)
//   b.xyz  vector(0.1, 3)
//   c.xyz  vector(0.1, 3)
// Values: 3
vec4 case_polygon_irradiance_vector(CaseInput i) {
    return case_of_vec3(polygon_irradiance_vector(case_walk(i), case_walk_reversed(i)));
}

// polygon irradiance, quad
//   a.xyz  vector(0.1, 10)
//   b.xyz  vector(0.1, 3)
//   c.xyz  vector(0.1, 3)
vec4 case_polygon_irradiance(CaseInput i) {
    return case_of_real(polygon_irradiance(case_walk(i), case_walk_reversed(i)));
}

// polygon solid angle, quad
//   a.xyz  vector(0.1, 10)
//   b.xyz  vector(0.1, 3)
//   c.xyz  vector(0.1, 3)
vec4 case_solid_angle(CaseInput i) {
    vec3 v0 = polygon_direction(case_corner(i, -1.0, -1.0));
    vec3 v1 = polygon_direction(case_corner(i, 1.0, -1.0));
    vec3 v2 = polygon_direction(case_corner(i, 1.0, 1.0));
    vec3 v3 = polygon_direction(case_corner(i, -1.0, 1.0));
    SolidAngleWalk walk = solid_angle_begin(v0);
    walk = solid_angle_add_edge(walk, v1, v2);
    walk = solid_angle_add_edge(walk, v2, v3);
    return case_of_real(solid_angle_finish(walk, case_walk_reversed(i)));
}

// Direction of corner k of the parallelogram, k from 0 to 4.
vec3 case_vertex(CaseInput i, int k) {
    real x = -1.0;
    real y = -1.0;
    if (k == 1 || k == 2) {
        x = 1.0;
    }
    if (k == 2 || k == 3) {
        y = 1.0;
    }
    return polygon_direction(case_corner(i, x, y));
}
