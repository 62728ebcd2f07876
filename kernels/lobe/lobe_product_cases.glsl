// Parity cases of lobe_product.glsl; tests/parity/case.glsl says how to write one.
// Needs: polygon.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Product of two lobes that reach each other: one step from the middle.
LobeProduct case_lobe_product(CaseInput i) {
    vec3 r = case_xyz(i.a);
    vec3 other = polygon_direction(r + case_xyz(i.b) * 0.5);
    LobeProduct p = lobe_product_begin(polygon_direction(r + other));
    p = lobe_product_add(lobe_product_add(p, r, i.a.w), other, i.b.w);
    vec3 better = lobe_product_newton(p);
    p = lobe_product_begin(better);
    return lobe_product_add(lobe_product_add(p, r, i.a.w), other, i.b.w);
}

// lobe product, isotropic: axis and scale
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
// Values: 4
vec4 case_lobe_product_isotropic(CaseInput i) {
    CosineLobe lobe = lobe_product_isotropic(case_lobe_product(i));
    return vec4(lobe.axis.x, lobe.axis.y, lobe.axis.z, lobe.scale);
}

// lobe product, exponents over the sum of the lobes'
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
// Values: 2
vec4 case_lobe_product_exponents(CaseInput i) {
    LobeProduct p = case_lobe_product(i);
    real whole = 1.0 / (i.a.w + i.b.w);
    CosineLobe lobe = lobe_product_isotropic(p);
    StretchedLobe stretched = lobe_product_anisotropic(p);
    return vec4(lobe.exponent * whole, stretched.exponent * whole, 0.0, 0.0);
}

// lobe product, a direction in the stretched frame
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
//   c.xyz  direction
// Values: 3
vec4 case_lobe_product_stretch(CaseInput i) {
    return case_of_vec3(lobe_product_stretch(lobe_product_anisotropic(case_lobe_product(i)), case_xyz(i.c)));
}

// lobe product, peak of two
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(1, 20)
//   b.w    range(1, 20)
// Values: 3
vec4 case_lobe_product_peak(CaseInput i) {
    vec3 r = case_xyz(i.a);
    return case_of_vec3(lobe_product_peak_of_two(r, i.a.w, polygon_direction(r + case_xyz(i.b) * 0.5), i.b.w));
}
