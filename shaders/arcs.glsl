// Arcs of great circles in half vectors' space, and the slivers between them and an edge's image. Mirrors source/integrals/ggx/half_vector.h.
//
// A shader defines before: ARC_SUM, the type of the sums, share_of_arc(view, a, b), and share_at(view, h) for each steradian.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
const int SPLITS = QUALITY == 2 ? 8 : 3 + QUALITY;
const int kSliverNodes = 4;

ARC_SUM sum_over_arcs(GgxView view, ConicArc edge) {
    ARC_SUM sum = ARC_SUM(0.0);
    if (!(edge.end > edge.begin)) return sum;
    float weight = half_vector_split_weight(edge);
    ConicNode first = half_vector_split_end(edge, edge.begin, weight);
    vec3 a = half_vector_at(view, edge, edge.begin);
    for (int j = 1; j <= SPLITS; j++) {
        float tau = edge.end;
        if (j < SPLITS) tau = half_vector_split_pole_mapped(edge, float(j) / float(SPLITS));
        vec3 b = half_vector_at(view, edge, tau);
        ConicNode last = half_vector_split_end(edge, tau, weight);
        sum += share_of_arc(view, a, b);
        for (int i = 0; i < kSliverNodes; i++) {
            HalfVectorNode node = half_vector_between(view, edge, first, last, a, b, gauss_legendre_node(kSliverNodes, i));
            sum += share_at(view, node.h) * node.solid_angle;
        }
        a = b;
        first = last;
    }
    return sum;
}
