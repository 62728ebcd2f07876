// Parity cases of surface.glsl; tests/parity/case.glsl says how to write one.
// Needs: frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Any direction across a normal.
vec3 case_surface_any(vec3 n) { return transform(frame_from_normal(n), vec3(1.0, 0.0, 0.0)); }

// A colour from 0 to 1.
vec3 case_surface_color(vec4 v) { return vec3(0.5 + 0.5 * v.x, 0.5 + 0.5 * v.y, 0.5 + 0.5 * v.z); }

// Surface, frame of tangents
//   a.xyz  direction
//   a.w    range(-1, 1)
//   b.xyz  direction
// Values: 3
vec4 case_surface_frame(CaseInput i) {
    vec3 n = case_xyz(i.b);
    SurfaceFrame frame = surface_frame(n, i.a, case_surface_any(n));
    return case_of_vec3(frame.x + frame.y * 0.5 + frame.z * 0.25);
}

// Surface, normal of a map
//   a.xyz  direction
//   b.xyz  direction
//   c.x    range(0, 1)
//   c.y    range(0, 1)
//   c.z    range(0.4, 1)
//   c.w    range(0, 2)
// Values: 3
vec4 case_surface_bent_normal(CaseInput i) {
    vec3 n = case_xyz(i.b);
    return case_of_vec3(surface_bent_normal(surface_frame(n, i.a, case_surface_any(n)), case_xyz(i.c), i.c.w));
}

// Surface, a corner's share in the way of a hit to the curved surface
//   a.xyz  vector(0.1, 2)
//   b.xyz  direction
//   c.xyz  direction
//   a.w    range(0, 1)
// Values: 3
vec4 case_surface_lift(CaseInput i) { return case_of_vec3(surface_lift(case_xyz(i.a), case_xyz(i.b), case_xyz(i.c), i.a.w)); }

// Surface, normal turned to the view
//   a.xyz  direction
//   b.xyz  direction
//   a.w    range(0, 1)
// Values: 3
vec4 case_surface_towards(CaseInput i) { return case_of_vec3(surface_towards(case_xyz(i.a), case_xyz(i.b), i.a.w)); }

// Surface, tangent of a brushed lobe
//   a.xyz  direction
//   b.xyz  direction
//   c.x    range(0, 1)
//   c.y    range(0, 1)
// Values: 4
vec4 case_surface_tangent(CaseInput i) {
    vec3 tangent = surface_tangent(case_xyz(i.a), case_xyz(i.b), case_surface_any(case_xyz(i.b)));
    return vec4(tangent.x, tangent.y, tangent.z, surface_brushed_alpha(surface_alpha(i.c.x), i.c.y));
}

// The metallic-roughness surface of the cases.
SurfaceDielectric case_surface_dielectric(CaseInput i) {
    return surface_dielectric(i.b.w, surface_product(case_surface_color(i.b), case_surface_color(i.c)), i.c.w);
}

// Surface, lobes of metallic roughness: albedo, its loss, F0 and F90
//   a.xyz  direction
//   a.w    range(0, 1)
//   b.xyz  direction
//   b.w    range(0, 1)
//   c.xyz  direction
//   c.w    range(0.01, 0.3)
// Values: 4
vec4 case_surface_weights(CaseInput i) {
    vec3 color = case_surface_color(i.a);
    SurfaceWeights w = surface_weights(color, color, i.a.w, case_surface_dielectric(i));
    return vec4(w.albedo.x, w.fresnel_loss, w.f0.y, w.f90.z);
}

// Surface, a covering thin wall below sheen and a coat: albedo, coat, emission with sheen, what passes
//   a.xyz  direction
//   a.w    range(0, 1)
//   b.xyz  direction
//   b.w    range(0, 1)
//   c.xyz  direction
//   c.w    range(0.01, 0.3)
//   d.x    range(0, 1)
//   d.y    range(0, 1)
//   d.z    range(0, 1)
//   d.w    range(0, 1)
// Values: 4
vec4 case_surface_layers(CaseInput i) {
    vec3 color = case_surface_color(i.a);
    SurfaceDielectric dielectric = case_surface_dielectric(i);
    SurfaceWeights w = surface_weights(color, color, i.a.w, dielectric);
    w = surface_transmitting(w, color, i.a.w, dielectric, i.d.x, i.d.y);
    w = surface_with_sheen(w, case_surface_color(i.b), i.d.z);
    w = surface_with_coat(w, i.d.z, i.d.y);
    w = surface_covering(w, i.d.w);
    return vec4(w.albedo.x + w.f0.y + w.f90.z, w.coat, w.emission.y + w.sheen.z, w.passes.x);
}
