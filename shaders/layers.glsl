// Layers that glTF puts over the metallic-roughness surface, and effects that spread its lobe: sheen, coats, brushing, light between
// facets. Names and order are those of source/render/surface/surface.cpp.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// Widens the lobe along a direction. Returns the direction's cosine and sine, measured from the tangent.
vec2 brush(inout Surface s, int material, Coordinates c) {
    vec4 factors = texelFetch(materials, material + kMaterialCoat);
    float strength = factors.z;
    float angle = factors.w;
    if (!(strength > 0.0)) return vec2(1.0, 0.0);
    int use = material + kMaterialTextures + kUse * kUseAnisotropy;
    if (texelFetch(materials, use).x >= 0.0) {
        vec3 map = texture_of(use, c).xyz;
        vec2 along = 2.0 * map.xy - 1.0;
        if (any(notEqual(along, vec2(0.0)))) angle += atan(along.y, along.x);
        strength *= map.z;
    }
    s.alpha.x += (1.0 - s.alpha.x) * strength * strength;
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
    vec3 grown = vec3(ltc_multiple_scattering(s.f0.x, albedo), ltc_multiple_scattering(s.f0.y, albedo),
                      ltc_multiple_scattering(s.f0.z, albedo));
    s.f0 *= grown;
    s.f90 *= grown;
}

// Adds sheen. Light that the fibres reflect does not reach the layers below.
void add_sheen(inout Surface s, int material, Coordinates c) {
    vec4 factors = texelFetch(materials, material + kMaterialSheen);
    int uses = material + kMaterialTextures;
    if (!any(greaterThan(factors.xyz, vec3(0.0)))) return;
    s.sheen = factors.xyz * texture_of(uses + kUse * kUseSheen, c).xyz;
    float strongest = max(s.sheen.x, max(s.sheen.y, s.sheen.z));
    if (!(strongest > 0.0)) return;
    s.sheen_alpha = alpha_of(factors.w * texture_of(uses + kUse * kUseSheenRoughness, c).w);
    vec4 sizes = texelFetch(tables, 0);
    int first = 1 + int(dot(sizes.xy, sizes.xy));
    float albedo = table_albedo(first, sizes.zw, s.sheen_alpha, clamp(dot(s.normal, s.view), 0.0, 1.0), true);
    float under = clamp(1.0 - strongest * albedo, 0.0, 1.0);
    s.albedo *= under;
    s.f0 *= under;
    s.f90 *= under;
}

// Adds the coat. Light that it reflects at the view's angle does not reach the layers below.
void add_coat(inout Surface s, int material, Coordinates c) {
    vec4 factors = texelFetch(materials, material + kMaterialCoat);
    int uses = material + kMaterialTextures;
    if (!(factors.x > 0.0)) return;
    s.coat = factors.x * texture_of(uses + kUse * kUseCoat, c).x;
    if (!(s.coat > 0.0)) return;
    s.coat_alpha = alpha_of(factors.y * texture_of(uses + kUse * kUseCoatRoughness, c).y);
    float facing = clamp(1.0 - dot(s.coat_normal, s.view), 0.0, 1.0);
    float under = 1.0 - s.coat * (0.04 + 0.96 * facing * facing * facing * facing * facing);
    s.albedo *= under;
    s.f0 *= under;
    s.f90 *= under;
    s.sheen *= under;
    s.emission *= under;
}
