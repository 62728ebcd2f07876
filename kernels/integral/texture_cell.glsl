// Textured lights by cells: a lobe's view of one cell of a light's plane, and the bound on the cell's error.
//
// The caller splits the light into cells until the sum of the errors is small against the sum of the visible light
// (source/integrals/textured/texture_mean.h). The quotient of radiance and weight is the mean of the texture under the lobe.
//
//   LtcTextureCellView view = ltc_texture_cell_view(m, 0, ggx_view(...), origin, x, y);     // once
//   LtcTextureCellSeen seen = ltc_texture_cell_seen(cell, view, expected);                  // for each cell
//
// Frame: the shading frame; cells in the plane's own coordinates [m].
// Topics: ltc_texture_cell
// Needs: constants.glsl ltc.glsl ltc_texture.glsl light_elements.glsl ggx_closed_form.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A lobe over the light's plane from a point.
//   transform_inverse  M^-1 of the transformed cosine that gives the lobe's width, and that is the lobe if by_ggx is 0
//   by_ggx        1: the lobe is GGX, of half_vectors
//   origin, x, y  of the plane's coordinates, from the point; x and y unit
//   height        of the point over the plane
//   least_length  |M^-1 l| in the lobe's own direction
//   determinant   of M^-1
struct LtcTextureCellView {
    LtcMatrix transform_inverse;
    int by_ggx;
    GgxView half_vectors;
    vec3 origin;
    vec3 x;
    vec3 y;
    real height;
    real least_length;
    real determinant;
};

// Prepares a view.
LtcTextureCellView ltc_texture_cell_view(LtcMatrix m, int by_ggx, GgxView half_vectors, vec3 origin, vec3 x, vec3 y) {
    LtcTextureCellView view;
    view.transform_inverse = m;
    view.by_ggx = by_ggx;
    view.half_vectors = half_vectors;
    view.origin = origin;
    view.x = x;
    view.y = y;
    view.height = abs(dot(cross(x, y), origin));
    vec3 peak = ltc_texture_transform_back(m, vec3(0.0, 0.0, 1.0));
    vec3 under = ltc_transform(m, peak * inversesqrt(max(dot(peak, peak), smallest_square())));
    view.least_length = sqrt(dot(under, under));
    view.determinant = m.yy * (m.xx * m.zz - m.xz * m.zx);
    return view;
}

// Covered part of a piece of the light's plane.
//   center            its centroid
//   axis_a, axis_b    conjugate half axes of the ellipse on which its four elements lie (light_elements.glsl)
//   area              [m2]; 0: nothing is covered
//   radius            largest distance of a part of it from the centroid
//   deviation         of its channels: the root of their mean variance, since uniform luminance may still vary in colour
//   mean              of its radiance
//   along_a, along_b  offset of each channel's centroid from the area's, in units of the axes, times the mean
struct LtcTextureCell {
    vec2 center;
    vec2 axis_a;
    vec2 axis_b;
    real area;
    real radius;
    real deviation;
    vec3 mean;
    vec3 along_a;
    vec3 along_b;
};

// A cell as weighted by a lobe.
//   weight    integral of the lobe
//   radiance  of the lobe times the texture, not negative
//   error     possible error of the quotient of the sums due to the cell, times the sum of the weights
struct LtcTextureCellSeen {
    real weight;
    vec3 radiance;
    real error;
};

// Mean of the three channels.
real ltc_texture_cell_luminance(vec3 v) {
    return (v.x + v.y + v.z) * 0.333333333333333333;
}

// Value of the lobe at a place of the plane, over the square of its distance and times the cosine at the light over the point's height. 0
// below the horizon.
real ltc_texture_cell_value(LtcTextureCellView view, vec3 r) {
    mask above = r.z > 0.0;
    vec3 upper = vec3(r.x, r.y, select(above, r.z, 1.0));
    real inverse2 = 1.0 / max(dot(upper, upper), smallest_square());
    real inverse = sqrt(inverse2);
    vec3 l = upper * inverse;
    int by_ggx = view.by_ggx;
    real lobe = 0.0;
    if (by_ggx > 0) {
        lobe = ggx_lobe_and_fresnel(view.half_vectors, l, 1.0).x;
    } else {
        lobe = ltc_lobe(view.transform_inverse, l);
    }
    return select(above, lobe * inverse * inverse2, 0.0);
}

// A cell as weighted by the lobe, by its four elements. Their values give the mean of the lobe and its slopes, which multiply the texture's
// mean and first moments.
//
//   expected  current estimate of the mean of the whole light
//
// The bound on the error uses t of light_elements.glsl. It is t^3 / 8 times the difference of the cell's mean from the expected one, plus
// t^2 / 2 times its deviation. Both are times the largest value of the lobe there, det / (pi |M^-1 l|^3). Its denominator is reduced by at
// most the cell's reach, and not below its least.
// Error: docs/theory/ltc.md, "Textured lights". Source: this project.
LtcTextureCellSeen ltc_texture_cell_seen(LtcTextureCell cell, LtcTextureCellView view, vec3 expected) {
    vec3 center = view.origin + (view.x * cell.center.x + view.y * cell.center.y);
    vec3 a = view.x * cell.axis_a.x + view.y * cell.axis_a.y;
    vec3 b = view.x * cell.axis_b.x + view.y * cell.axis_b.y;
    real at_a = ltc_texture_cell_value(view, center + a);
    real from_a = ltc_texture_cell_value(view, center - a);
    real at_b = ltc_texture_cell_value(view, center + b);
    real from_b = ltc_texture_cell_value(view, center - b);
    real area = cell.area * view.height;
    real mean = 0.25 * (at_a + from_a + at_b + from_b);
    vec3 power = (cell.mean * mean + cell.along_a * (0.5 * (at_a - from_a)) + cell.along_b * (0.5 * (at_b - from_b))) * area;

    real distance2 = max(dot(center, center), smallest_square());
    real inverse_distance = inversesqrt(distance2);
    real distance = distance2 * inverse_distance;
    real steepness = ltc_sharpness(view.transform_inverse, center);
    real deviation = sqrt(0.5 * (dot(cell.axis_a, cell.axis_a) + dot(cell.axis_b, cell.axis_b)));
    real t = deviation * inverse_distance * (light_elements_diffuse_sharpness() + steepness);
    vec3 under = ltc_transform(view.transform_inverse, center * inverse_distance);
    real reach = min(cell.radius * inverse_distance * steepness, 1.0);
    real m = max(sqrt(dot(under, under)) * (1.0 - reach), view.least_length);
    real nearest = max(max(distance - cell.radius, view.height), 1.0e-12);
    real steep = min(view.height + cell.radius, nearest) / (nearest * nearest * nearest);
    real highest = view.determinant * inverse_pi() / max(m * m * m, smallest_square()) * steep;
    vec3 apart = cell.mean - expected;
    real off = sqrt(dot(apart, apart) * 0.333333333333333333);
    real small = min(t, 2.0);

    LtcTextureCellSeen seen;
    seen.weight = area * mean;
    seen.radiance = vec3(max(power.x, 0.0), max(power.y, 0.0), max(power.z, 0.0));
    seen.error = cell.area * highest * (off * small * small * small * 0.125 + 0.5 * cell.deviation * small * small);
    return seen;
}

// True if cells of the deviation `finest` are small against the lobe, in case its peak is on the light.
//
//   bounds   left, right, bottom and top of the light
mask ltc_texture_cell_resolves(LtcTextureCellView view, real finest, vec4 bounds) {
    vec3 normal = cross(view.x, view.y);
    vec3 peak = ltc_texture_transform_back(view.transform_inverse, vec3(0.0, 0.0, 1.0));
    real along = dot(normal, peak);
    real height = dot(normal, view.origin);
    mask towards = along * height > 0.0;
    vec3 hit = peak * (height / select(towards, along, 1.0));
    real x = dot(hit - view.origin, view.x);
    real y = dot(hit - view.origin, view.y);
    real distance = sqrt(dot(hit, hit));
    real sharpness = ltc_sharpness(view.transform_inverse, hit);
    real size = finest * sharpness / max(distance, smallest_length());
    real margin = 2.0 * distance / max(sharpness, smallest_length());
    mask on_light = x > bounds.x - margin && x < bounds.y + margin && y > bounds.z - margin && y < bounds.w + margin;
    return !towards || !on_light || size < 1.5;
}
