// Lobes from the compact table (source/render/bounce/lobe_pack.h). `tables` holds its nodes: matrices, then magnitudes.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

layout(constant_id = 0) const int MATRIX_SIZE = 2;
layout(constant_id = 1) const int MAGNITUDE_SIZE = 2;

vec4 look_up(int first, int size, vec2 at) {
    vec2 place = clamp(at, 0.0, 1.0) * float(size - 1);
    vec2 cell = min(floor(place), float(size - 2));
    vec2 f = place - cell;
    int node = first + int(cell.y) * size + int(cell.x);
    vec4 top = mix(tables[node], tables[node + 1], f.x);
    vec4 bottom = mix(tables[node + size], tables[node + size + 1], f.x);
    return mix(top, bottom, f.y);
}

vec4 look_up_magnitude(float roughness, float cosine) {
    return look_up(MATRIX_SIZE * MATRIX_SIZE, MAGNITUDE_SIZE, ltc_coordinates(roughness, cosine));
}

// Matrix of the lobe in a frame with x along the view and z the normal.
LtcMatrix lobe_matrix(vec3 normal, vec3 view, mat3 frame, float alpha) {
    float cosine = dot(normal, view);
    vec3 local = vec3(dot(frame[0], view), 0.0, cosine);
    return ltc_from_compact(look_up(0, MATRIX_SIZE, ltc_coordinates(sqrt(alpha), cosine)), max(alpha, 1.0e-4), local);
}
