// Parity cases of complex.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// complex product and quotient
//   a.x    range(-2, 2)
//   a.y    range(-2, 2)
//   b.x    signed_log(0.1, 2)
//   b.y    range(-2, 2)
// Values: 4
vec4 case_complex(CaseInput i) {
    vec2 a = vec2(i.a.x, i.a.y);
    vec2 b = vec2(i.b.x, i.b.y);
    vec2 p = complex_product(a, b);
    vec2 q = complex_quotient(a, b);
    return vec4(p.x, p.y, q.x, q.y);
}

// complex unit and sign
//   a.x    range(-3.14159, 3.14159)
//   b.x    signed_log(0.01, 2)
//   b.y    range(-2, 2)
// Values: 4
vec4 case_complex_unit(CaseInput i) {
    vec2 u = complex_unit(i.a.x);
    vec2 s = complex_sign(vec2(i.b.x, i.b.y));
    return vec4(u.x, u.y, s.x, s.y);
}
