// Charlie: the sheen of cloth, glTF's KHR_materials_sheen.
//
// Frame: z the surface normal; l light and v view unit and pointing away from the surface. Brightest where light or view
// grazes, and dark about the mirror direction: no peak, but a hole.
// Source: Estevez, Kulla, "Production friendly microfacet sheen BRDF", 2017, eq. 2 to 4 and table 1.
// Needs: constants.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The lobe of one view.
//   exponent  of the half vector's sine squared: 1 / (2 alpha)
//   scale     what multiplies its power over 1 + both shadowings: (2 + 1 / alpha) / (8 pi v_z); 0 for a view below
//   a ... e   the curve of the shadowing's logarithm, blended for alpha
//   middle    that curve at 1/2
//   masking   the view's own 1 + Lambda
struct CharlieLobe {
    vec3 view;
    real exponent;
    real scale;
    real a;
    real b;
    real c;
    real d;
    real e;
    real middle;
    real masking;
};

// The authors' curve: a / (1 + b x^c) + d x + e.
//
//   x        in [0, 1/2]; below 1.0e-9 it is taken there, where the power is not yet 0 but the lobe is
real charlie_curve(CharlieLobe lobe, real x) {
    real power = exp(lobe.c * log(max(x, 1.0e-9)));
    return lobe.a / (1.0 + lobe.b * power) + lobe.d * x + lobe.e;
}

// Lambda of the shadowing, fitted by its authors; the curve's mirror image beyond cosine 1/2.
//
//   cosine   of light or view; outside of [0, 1] (by rounding) it is taken at the end
real charlie_lambda(CharlieLobe lobe, real cosine) {
    real x = clamp(cosine, 0.0, 1.0);
    mask steep = x > 0.5;
    real curve = charlie_curve(lobe, select(steep, 1.0 - x, x));
    return exp(select(steep, 2.0 * lobe.middle - curve, curve));
}

// Prepares the lobe of a view.
//
//   v        unit view
//   alpha    roughness squared in (0, 1], taken to be at least 0.04: below, the model reflects more than arrives and only
//            within a few degrees of the horizon
//
// Degenerate: a view that is not above the surface makes a lobe of 0.
CharlieLobe charlie_prepare(vec3 v, real alpha) {
    real width = clamp(alpha, 0.04, 1.0);
    real t = (1.0 - width) * (1.0 - width);
    CharlieLobe lobe;
    lobe.view = v;
    lobe.exponent = 0.5 / width;
    lobe.scale = select(v.z > 0.0, (2.0 + 1.0 / width) * 0.0397887357729738339 / max(v.z, 1.0e-6), 0.0);
    lobe.a = 21.5473 + t * (25.3245 - 21.5473);
    lobe.b = 3.82987 + t * (3.32435 - 3.82987);
    lobe.c = 0.19823 + t * (0.16801 - 0.19823);
    lobe.d = -1.97760 + t * (1.97760 - 1.27393);
    lobe.e = -4.32054 + t * (4.32054 - 4.85967);
    lobe.middle = 0.0;
    lobe.middle = charlie_curve(lobe, 0.5);
    lobe.masking = 0.0;
    lobe.masking = 1.0 + charlie_lambda(lobe, v.z);
    return lobe;
}

// BRDF of colour 1 times the light's cosine, D / (4 v_z (1 + Lambda_v + Lambda_l)).
//
//   l        unit; 0 where it is not above the surface
//
// Degenerate: l = -v has no half vector and gives a finite number.
// Error: see docs/measured/accuracy.md, "Charlie lobe".
real charlie_lobe(CharlieLobe lobe, vec3 l) {
    vec3 h = l + lobe.view;
    real across = h.x * h.x + h.y * h.y;
    real sine2 = across / max(across + h.z * h.z, smallest_divisor());
    real power = exp(lobe.exponent * log(clamp(sine2, smallest_divisor(), 1.0)));
    real shadowed = lobe.scale * power / (lobe.masking + charlie_lambda(lobe, l.z));
    return select(l.z > 0.0, shadowed, 0.0);
}
