// Nodes and weights of Gauss and Legendre on [0, 1]: zeros of Legendre's polynomials.
//
// The test GaussLegendre.IntegratesPolynomialsOfItsDegreesExactly proves every number.
// Topics: gauss_legendre fan
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Node j of the rule with n nodes, j from 0, n in 1 to 6 or 8: vec2(node, weight). Weights add up to 1.
//
// Degenerate: a rule or node that there is not gives (1/2, 0).
vec2 gauss_legendre_node(int n, int j) {
    vec2 r = vec2(0.5, 0.0);
    if (n == 1) {
        if (j == 0) { r = vec2(0.5, 1.0); }
    }
    if (n == 2) {
        if (j == 0) { r = vec2(0.211324865405187118, 0.5); }
        if (j == 1) { r = vec2(0.788675134594812882, 0.5); }
    }
    if (n == 3) {
        if (j == 0) { r = vec2(0.112701665379258311, 0.277777777777777778); }
        if (j == 1) { r = vec2(0.5, 0.444444444444444444); }
        if (j == 2) { r = vec2(0.887298334620741689, 0.277777777777777778); }
    }
    if (n == 4) {
        if (j == 0) { r = vec2(0.069431844202973712, 0.173927422568726929); }
        if (j == 1) { r = vec2(0.330009478207571868, 0.326072577431273071); }
        if (j == 2) { r = vec2(0.669990521792428132, 0.326072577431273071); }
        if (j == 3) { r = vec2(0.930568155797026288, 0.173927422568726929); }
    }
    if (n == 5) {
        if (j == 0) { r = vec2(0.046910077030668004, 0.118463442528094544); }
        if (j == 1) { r = vec2(0.230765344947158454, 0.239314335249683234); }
        if (j == 2) { r = vec2(0.5, 0.284444444444444444); }
        if (j == 3) { r = vec2(0.769234655052841546, 0.239314335249683234); }
        if (j == 4) { r = vec2(0.953089922969331996, 0.118463442528094544); }
    }
    if (n == 6) {
        if (j == 0) { r = vec2(0.033765242898423986, 0.085662246189585173); }
        if (j == 1) { r = vec2(0.169395306766867743, 0.180380786524069304); }
        if (j == 2) { r = vec2(0.380690406958401546, 0.233956967286345524); }
        if (j == 3) { r = vec2(0.619309593041598454, 0.233956967286345524); }
        if (j == 4) { r = vec2(0.830604693233132257, 0.180380786524069304); }
        if (j == 5) { r = vec2(0.966234757101576014, 0.085662246189585173); }
    }
    if (n == 8) {
        if (j == 0) { r = vec2(0.019855071751231884, 0.05061426814518813); }
        if (j == 1) { r = vec2(0.10166676129318663, 0.111190517226687235); }
        if (j == 2) { r = vec2(0.237233795041835507, 0.156853322938943644); }
        if (j == 3) { r = vec2(0.408282678752175098, 0.181341891689180991); }
        if (j == 4) { r = vec2(0.591717321247824902, 0.181341891689180991); }
        if (j == 5) { r = vec2(0.762766204958164493, 0.156853322938943644); }
        if (j == 6) { r = vec2(0.89833323870681337, 0.111190517226687235); }
        if (j == 7) { r = vec2(0.980144928248768116, 0.05061426814518813); }
    }
    return r;
}

// A direction of a fan of the sphere about a centre, on the way from there to the rim: where a radial rule in the cosine has its node.
//
//   outward     unit, perpendicular to the centre
//   rim_cosine  of the rim's distance from the centre
//   share       of 1 - cosine, in [0, 1]
vec3 fan_place(vec3 centre, vec3 outward, real rim_cosine, real share) {
    real cosine = 1.0 - (1.0 - rim_cosine) * share;
    return centre * cosine + outward * sqrt(max(1.0 - cosine * cosine, 0.0));
}
