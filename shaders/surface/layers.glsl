// Layers that glTF puts over the metallic-roughness surface, and effects that spread its lobe: sheen, coats, brushing, scattering.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Widens the lobe along a direction. Returns the direction's cosine and sine, measured from the tangent.
vec2 brush(inout Surface s, int material, Textures t) {
    vec4 factors = texelFetch(materials, material + kMaterialCoat);
    float strength = factors.z;
    float angle = factors.w;
    if (!(strength > 0.0)) return vec2(1.0, 0.0);
    if (has_texture(t, kUseAnisotropy)) {
        vec2 along = 2.0 * t.anisotropy.xy - 1.0;
        if (any(notEqual(along, vec2(0.0)))) angle += atan(along.y, along.x);
        strength *= t.anisotropy.z;
    }
    s.alpha.x = surface_brushed_alpha(s.alpha.x, strength);
    return vec2(cos(angle), sin(angle));
}

// Fraction of light that a lobe of width alpha reflects, by its compact table; `first` is the first node of its shapes. A lobe that is
// stored about the normal passes `upright`.
float table_albedo(int first, vec2 sizes, float alpha, float cosine, bool upright) {
    vec2 at = ltc_coordinates(sqrt(alpha), cosine);
    vec4 shape = look_up(first, int(sizes.x), at);
    float magnitude = look_up(first + int(sizes.x * sizes.x), int(sizes.y), at).x;
    vec3 view = vec3(sqrt(max(0.0, 1.0 - cosine * cosine)), 0.0, cosine);
    LtcMatrix m = ltc_from_compact(shape, upright ? 1.0 : alpha, upright ? vec3(0.0, 0.0, 1.0) : view);
    return clamp(magnitude * ltc_energy_above_horizon(m), 0.0, 1.0);
}

// Adds light between facets, for lobes that are as wide along the tangent as across it.
void scatter_between_facets(inout Surface s) {
    vec4 sizes = texelFetch(tables, 0);
    float albedo = table_albedo(1, sizes.xy, s.alpha.x, clamp(dot(s.normal, s.view), 0.0, 1.0), false);
    vec3 grown = vec3(ltc_multiple_scattering(s.weights.f0.x, albedo), ltc_multiple_scattering(s.weights.f0.y, albedo),
                      ltc_multiple_scattering(s.weights.f0.z, albedo));
    s.weights.f0 *= grown;
    s.weights.f90 *= grown;
}

// Adds sheen.
void add_sheen(inout Surface s, int material, Textures t) {
    vec4 factors = texelFetch(materials, material + kMaterialSheen);
    vec3 sheen = factors.xyz * t.sheen;
    if (!any(greaterThan(sheen, vec3(0.0)))) return;
    s.sheen_alpha = surface_alpha(factors.w * t.sheen_roughness);
    vec4 sizes = texelFetch(tables, 0);
    int first = 1 + int(dot(sizes.xy, sizes.xy));
    float albedo = table_albedo(first, sizes.zw, s.sheen_alpha, clamp(dot(s.normal, s.view), 0.0, 1.0), true);
    s.weights = surface_with_sheen(s.weights, sheen, albedo);
}

// Adds the coat.
void add_coat(inout Surface s, int material, Textures t) {
    vec4 factors = texelFetch(materials, material + kMaterialCoat);
    float coat = factors.x * t.coat;
    if (!(coat > 0.0)) return;
    s.coat_alpha = surface_alpha(factors.y * t.coat_roughness);
    s.weights = surface_with_coat(s.weights, coat, dot(s.coat_normal, s.view));
}
