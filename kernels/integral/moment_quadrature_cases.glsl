// Parity cases of moment_quadrature.glsl; tests/parity/case.glsl says how to write one.
// Needs: moment_cases.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Phong quadrature, one edge: moment and power
//   a.x    range(0.3, 1)
//   a.y    range(0.2, 1)
//   a.z    range(0.2, 1)
//   a.w    log(1, 50)
// Values: 2
vec4 case_phong_quadrature(CaseInput i) {
    MomentIntegrands front = moment_quadrature_front(case_front_edge(i), i.a.w);
    return vec4(front.moment, front.power, 0.0, 0.0);
}
