// Lights that are small against their distance and against the lobe: four elements in the place of the outline.
//
// Integrals along an outline cancel where the light is small: of the rounding of a unit direction, what is left is the
// (distance / size)^2-fold. A surface element has no such trouble. Four of them, each a quarter of the area, at
// center +- reach_a and center +- reach_b, have the light's area, centroid and second moments if the reaches are its
// principal deviations times the square root of 2, whatever its outline; so they integrate what is quadratic over the
// light exactly, and what is cubic too where the light is its own mirror image about its centroid.
//
// How far a lobe is from quadratic over a light, one number tells: t = deviation / distance * sharpness. The error, as a
// share of what the light would send from where the lobe is highest, is at most t^3 / 8: measured, over Lambert, Phong, GGX,
// Blinn-Phong and Beckmann lobes, parallelograms and triangles, at t up to 0.7 (test LightElements.ErrorIsBelowItsBound).
// Frame: any. Vectors are relative to the shading point.
// Needs: constants.glsl
// Topics: light_elements, light_element
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A light as four elements.
//   center            centroid of its area
//   reach_a, reach_b  conjugate half axes of the ellipse on which the elements lie
//   area              unit normal towards the side that shines here, times the area [m^2]
struct LightElements {
    vec3 center;
    vec3 reach_a;
    vec3 reach_b;
    vec3 area;
};

// One element as the point sees it.
//   direction    unit
//   solid_angle  not negative [sr]
struct LightElement {
    vec3 direction;
    real solid_angle;
};

// Element i of 0 to 3.
//
// Degenerate: an element at the point is a zero direction and finite.
LightElement light_element_at(LightElements e, int i) {
    real side = real(1 - 2 * (i / 2));
    vec3 r = e.center + e.reach_a * side;
    if (i == 1 || i == 3) {
        r = e.center + e.reach_b * side;
    }
    real inverse = inversesqrt(max(dot(r, r), smallest_square()));
    LightElement element;
    element.direction = r * inverse;
    // The area first: squares of distances may leave the range of float.
    real quarter = max(-0.25 * dot(e.area, element.direction), 0.0);
    element.solid_angle = (quarter * inverse) * inverse;
    return element;
}

// Sharpness of a diffuse surface; others add their own to it.
//
// For the cosine and the elements' own foreshortening and distance.
real light_elements_diffuse_sharpness() { return 2.5; }

// Sharpness of a lobe that is about a mirrored direction as wide as a Gaussian of this standard deviation [rad].
real light_elements_sharpness(real deviation) {
    return light_elements_diffuse_sharpness() + 1.0 / max(deviation, 1.0e-12);
}

// Sharpness of a lobe of half vectors.
//
//   deviation  of the distribution, of slopes: alpha / 2 of GGX, alpha / sqrt(2) of Beckmann, 1 / sqrt(n) of Blinn-Phong
//   view_z     cosine of the view: half vectors turn the light by twice their angle along the view, by 2 v.h across it
real light_elements_half_vector_sharpness(real deviation, real view_z) {
    return light_elements_sharpness(2.0 * deviation * max(view_z, 1.0e-6));
}

// Sharpness of a power n of a cosine, whose deviation is 1 / sqrt(n).
real light_elements_power_sharpness(real n) {
    return light_elements_diffuse_sharpness() + sqrt(n);
}

// Limits of an integral along the outline, beyond which the elements are better.
//   roundings        how many roundings of a unit direction the integral makes, relative to the light's solid angle times
//                    its distance over its size
//   least_distance2  squared distance in the light's mean square deviations below which elements never serve: there t^3 / 8
//                    of the least sharpness exceeds the rounding of float
//   bias             error of the integral that is none of rounding, as the share that t^3 / 8 bounds
struct LightElementsLimits {
    real roundings;
    real least_distance2;
    real bias;
};

// Limits from their three numbers.
LightElementsLimits light_elements_limits(real roundings, real least_distance2, real bias) {
    LightElementsLimits limits;
    limits.roundings = roundings;
    limits.least_distance2 = least_distance2;
    limits.bias = bias;
    return limits;
}

// Lambert's edges: few roundings, since they add up vectors of the light's size.
LightElementsLimits light_elements_along_edges() { return light_elements_limits(2.0, 4000.0, 0.0); }

// Transformed cosines, cubatures without arcs, and a light's point that stands for it.
LightElementsLimits light_elements_transformed() { return light_elements_limits(8.0, 2000.0, 0.0); }

// Arcs: an edge subtracts numbers of the order of 1.
LightElementsLimits light_elements_along_arcs() { return light_elements_limits(128.0, 500.0, 0.0); }

// Arcs of half vectors: their bias makes the elements better from much nearer on.
LightElementsLimits light_elements_along_half_vectors(real bias) { return light_elements_limits(128.0, 30.0, bias); }

// Edges of a power n of a cosine: t^3 / 8 falls below the bias at a distance that depends on the lobe.
LightElementsLimits light_elements_along_power(real n, real bias) {
    real sharpness = light_elements_power_sharpness(n);
    return light_elements_limits(128.0, select(bias > 0.0, min(500.0, 4.0 * sharpness * sharpness), 500.0), bias);
}

// Bias of the cosine series: t^3 / 8 where the elements' error is as large.
//
// The series' error is that fraction of the full lobe for each half of an edge (moment_series.glsl). Over a light that is
// small against the lobe, it is that fraction of the light.
real light_elements_series_bias() { return 0.015625; }

// Bias of the longer cosine series.
real light_elements_series_high_bias() { return 0.008695652173913044; }

// Bias of Beckmann's arcs.
real light_elements_beckmann_bias() { return 0.005; }

// True where the elements are better than an integral along the outline.
//
//   normal           the surface's, unit
//   sharpness        of the lobe
//   roundings, bias  LightElementsLimits
//
// A light across the horizon is cut only by whole elements: there the outline serves as long as rounding leaves it a digit.
mask light_elements_serve(LightElements e, vec3 normal, real sharpness, real roundings, real bias) {
    real unit = 6.0e-8;
    if (real_digits() > 24) {
        unit = 1.1e-16;
    }
    real inverse = inversesqrt(max(dot(e.center, e.center), smallest_square()));
    vec3 a = e.reach_a * inverse;
    vec3 b = e.reach_b * inverse;
    real deviation2 = 0.5 * (dot(a, a) + dot(b, b));
    real deviation = sqrt(deviation2);
    real t = min(deviation * sharpness, 1.0e6);
    real bound = 0.125 * t * t * t;
    mask better = bound < bias || bound * deviation < roundings * unit;
    // The outline of most lights ends within twice the reach.
    mask whole = dot(e.center, normal) * inverse > 2.0 * (abs(dot(a, normal)) + abs(dot(b, normal)));
    return better && (whole || deviation2 < 8.0 * unit);
}

// Irradiance vector of radiance 1, of the elements above the horizon z = 0.
vec3 light_elements_irradiance_vector(LightElements e) {
    vec3 nowhere = vec3(0.0, 0.0, 0.0);
    vec3 sum = nowhere;
    for (int i = 0; i < 4; i++) {
        LightElement element = light_element_at(e, i);
        sum = sum + select(element.direction.z > 0.0, element.direction * element.solid_angle, nowhere);
    }
    return sum;
}
