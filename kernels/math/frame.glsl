// Shading frames. A frame is a mat3 whose columns are x, y and z; transform_transposed(frame, w) takes a world
// vector into it, transform(frame, l) back.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Orthonormal right-handed frame with z along n and x, y in any direction.
//
//   n        unit normal
//
// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin, "Building an orthonormal basis, revisited", 2017.
mat3 frame_from_normal(vec3 n) {
    real s = select(n.z < 0.0, -1.0, 1.0);
    real a = -1.0 / (s + n.z);
    real b = n.x * n.y * a;
    vec3 x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 y = vec3(b, s + n.y * n.y * a, -n.y);
    return mat3(x, y, n);
}

// Orthonormal right-handed frame with z along n and the view in the half plane of x and z.
//
//   n, v     unit normal and view
//
// Degenerate: a view along the normal (closer than 1e-6) gives any x.
mat3 frame_from_normal_and_view(vec3 n, vec3 v) {
    mat3 other = frame_from_normal(n);
    vec3 t = v - n * dot(n, v);
    real t2 = dot(t, t);
    vec3 x = select(t2 > 1.0e-12, t * inversesqrt(max(t2, 1.0e-12)), transform(other, vec3(1.0, 0.0, 0.0)));
    return mat3(x, cross(n, x), n);
}
