// Parity cases of gauss_legendre.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Gauss and Legendre on 1 / (1 + x)
//   a.x    range(0, 1)
vec4 case_gauss_legendre(CaseInput i) {
    real sum = 0.0;
    for (int n = 1; n <= 8; n++) {
        for (int j = 0; j < n; j++) {
            vec2 rule = gauss_legendre_node(n, j);
            sum = sum + rule.y / (1.0 + i.a.x * rule.x);
        }
    }
    return case_of_real(sum);
}
