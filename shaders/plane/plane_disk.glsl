// Round lights: light from a part of one.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A round light as a pixel sees it. x is the signed distance at which a ray passes its centre.
struct DiskView {
    vec2 to;      // direction to its centre
    float reach;  // greatest visible x, to either side
    float d2;     // squared distance of the centre; in units of the range, where there is one
    float rho2;
    float scale;  // 1 / range, 0 without a range
};

DiskView disk_view(vec2 center, float radius, float inverse_range) {
    DiskView view;
    view.to = center - eye;
    view.scale = inverse_range;
    float unit = inverse_range > 0.0 ? inverse_range : 1.0;
    vec2 to = view.to * unit;
    view.d2 = dot(to, to);
    float rho = radius * unit;
    view.rho2 = rho * rho;
    // Without a range, the reach is that of a tangent.
    float reach = view.d2 > view.rho2 ? rho : 0.0;
    if (inverse_range > 0.0) reach = plane_disk_reach(view.d2, rho);
    view.reach = reach / unit;
    return view;
}

float disk_slope(DiskView view, float x) {
    if (view.scale > 0.0) x *= view.scale;
    return plane_disk_slope(x, view.d2);
}

// Light between two rays, which are given by their slopes from the centre's direction.
float disk_share(DiskView view, float from, float to) {
    if (view.scale > 0.0) return plane_disk_window(to, view.d2, view.rho2) - plane_disk_window(from, view.d2, view.rho2);
    return trig_atan2_unwrapped(to - from, 1.0 + from * to);
}
