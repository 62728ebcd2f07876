// Parity cases of inverse_trig.glsl; tests/parity/case.glsl says how to write one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// angle over sine, acute
//   a.x    range(0, 1)
// Error: relative
vec4 case_trig_angle_over_sine_acute(CaseInput i) { return case_of_real(trig_angle_over_sine_acute(i.a.x)); }

// angle over sine
//   a.x    range(-0.999, 1)
// Error: relative
vec4 case_trig_angle_over_sine(CaseInput i) {
    return case_of_real(trig_angle_over_sine(i.a.x, (1.0 - i.a.x) * (1.0 + i.a.x)));
}

// atan2
//   a.x    signed_log(1e-15, 1e15)
//   a.y    signed_log(1e-15, 1e15)
// Error: relative
vec4 case_trig_atan2(CaseInput i) { return case_of_real(trig_atan2(i.a.x, i.a.y)); }

// atan2, unwrapped
//   a.x    signed_log(1e-3, 1e3)
//   a.y    signed_log(1e-3, 1e3)
vec4 case_trig_atan2_unwrapped(CaseInput i) { return case_of_real(trig_atan2_unwrapped(i.a.x, i.a.y)); }

// slope of angle over sine
//   a.x    range(-0.999, 1)
// Error: relative
vec4 case_trig_angle_over_sine_and_slope(CaseInput i) {
    vec2 both = trig_angle_over_sine_and_slope(i.a.x, (1.0 - i.a.x) * (1.0 + i.a.x));
    return case_of_real(both.y);
}
