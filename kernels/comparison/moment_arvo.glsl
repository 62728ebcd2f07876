// The Phong lobe's boundary integral by Arvo's recurrence: exact for integer n, in n/2 steps an edge.
//
// (1 - x^m)/(1 - x^2) is the finite sum of x^k over every other k below m: 1 + x^2 + ... for even m. For odd m one
// factor x is taken out first, (x - x^m)/(1 - x^2) = x + x^3 + ..., and the rest, 1/(1 + x), integrates to half the
// angle of a spherical triangle. Each power integrates by parts from the last but one.
// Source: Arvo 1995, sec. 5; Lecocq et al. 2017, eq. 1 to 3, with N = n - 1.
// Needs: moment.glsl
// Topics: moment
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// |s| times the integral of 1/(1 + x) over the part in front: summed over a polygon, its solid angle.
real moment_solid_angle_front(MomentEdge edge) {
    real c0 = edge.c + edge.x0;
    real c1 = edge.c + edge.x1;
    real k = edge.s / (1.0 + edge.c);
    return 2.0 * trig_atan2(k * (c0 * edge.y1 - c1 * edge.y0), c0 * c1 + k * k * edge.y0 * edge.y1);
}

// |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of one edge.
//
//   n        integer exponent, at least 1
//   can_stop 1: stop when what is left is below relative_precision of the sum; 0: sum everything. Every lane waits for
//            the slowest: at grazing views, where c is near 1, the stop comes late or never.
//
// Error: see docs/measured/accuracy.md, "phong recurrence"; the recurrence is stable, its factor is below c^2.
real moment_arvo_front(MomentEdge edge, int n, int can_stop, real relative_precision) {
    int odd_m = 1 - (n - (n / 2) * 2);
    real c2 = edge.c * edge.c;
    real x02 = edge.x0 * edge.x0;
    real x12 = edge.x1 * edge.x1;
    // The integral of x^p, and x^(p+1) y at both ends, which the next step needs.
    real power = trig_atan2(edge.x0 * edge.y1 - edge.x1 * edge.y0, edge.x0 * edge.x1 + edge.y0 * edge.y1);
    real b0 = edge.x0 * edge.y0;
    real b1 = edge.x1 * edge.y1;
    real p = 2.0;
    int steps = (n - 1) / 2;
    if (odd_m == 1) {
        power = edge.y1 - edge.y0;
        b0 = x02 * edge.y0;
        b1 = x12 * edge.y1;
        p = 3.0;
        steps = n / 2 - 1;
    }
    real sum = power;
    real left = relative_precision * (1.0 - c2);
    for (int i = 0; i < steps; i++) {
        power = (b1 - b0 + (p - 1.0) * c2 * power) / p;
        b0 = b0 * x02;
        b1 = b1 * x12;
        p = p + 2.0;
        sum = sum + power;
        // The terms fall by c^2 or more: those left sum to less than power c^2 / (1 - c^2).
        if (can_stop == 1) {
            if (all_lanes(power * c2 <= sum * left)) {
                break;
            }
        }
    }
    real front = edge.s * sum;
    if (odd_m == 1) {
        front = front + moment_solid_angle_front(edge);
    }
    return max(front, 0.0);
}
