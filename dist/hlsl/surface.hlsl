// Steradian 0.1.0, surface: surfaces of glTF: frames, lobes and texture look-up from factors and texels, for HLSL.
//
// #include or paste it; it has no macros and no resources.
// It needs these files before it, in this order: math.hlsl.
// Made by dist/make_dist.py from kernels/ and dist/source/: change those.
//
// MIT License
//
// Copyright (c) 2026 The Steradian authors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy
// of this software and associated documentation files (the "Software"), to deal
// in the Software without restriction, including without limitation the rights
// to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
// copies of the Software, and to permit persons to whom the Software is
// furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all
// copies or substantial portions of the Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
// IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
// FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
// AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
// LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
// OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
// SOFTWARE.

// ==== surface ====

// The surface of glTF: frames and lobes, from a material's factors times its texels.
//
// Radiance = emission + diffuse + specular (+ sheen) (+ coat). A back face shows the front's frame with a reversed normal:
// bumps and directions of brushing keep their places.
// Source: glTF 2.0, appendix B, and KHR_materials_specular, _ior, _transmission, _anisotropy, _sheen and _clearcoat.

// Product of two colours.
float3 steradian_surface_product(float3 a, float3 b) {
    return float3(a.x * b.x, a.y * b.y, a.z * b.z);
}

// Unit vector; a vector shorter than 1e-15 stays short.
float3 steradian_surface_unit(float3 a) {
    return a * rsqrt(max(dot(a, a), steradian_smallest_divisor()));
}

// True if a vector is long enough to have a direction, and its square is in the range of float.
bool steradian_surface_has_direction(float3 a) {
    float square = dot(a, a);
    return square > steradian_smallest_divisor() && square < 1.0e30;
}

// The frame of tangent-space textures on the front face.
struct SteradianSurfaceFrame {
    float3 x;
    float3 y;
    float3 z;
};

// The frame of a normal and the mesh's tangent.
//
//   n        unit normal
//   tangent  w below 0 reverses y
//   any      unit, perpendicular to n: x where the tangent is 0 or along the normal
SteradianSurfaceFrame steradian_surface_frame(float3 n, float4 tangent, float3 any) {
    float3 t = float3(tangent.x, tangent.y, tangent.z);
    float3 across = t - n * dot(n, t);
    bool usual = steradian_surface_has_direction(across);
    SteradianSurfaceFrame frame;
    frame.x = steradian_select(usual, steradian_surface_unit(across), any);
    frame.y = cross(n, frame.x) * steradian_select(usual && tangent.w < 0.0, -1.0, 1.0);
    frame.z = n;
    return frame;
}

// Normal from a normal map, unit; the frame's normal if the map points below the surface.
//
//   map      texel, from 0 to 1
//   scale    factor of its x and y
float3 steradian_surface_bent_normal(SteradianSurfaceFrame frame, float3 map, float scale) {
    float up = 2.0 * map.z - 1.0;
    float3 bent = frame.x * ((2.0 * map.x - 1.0) * scale) + frame.y * ((2.0 * map.y - 1.0) * scale) + frame.z * up;
    return steradian_select(steradian_surface_has_direction(bent) && up > 0.0, steradian_surface_unit(bent), frame.z);
}

// A visible surface is seen from above. If interpolation or a normal map turns the normal away from the viewer, this turns it back until
// the view lies just above its horizon.
//
//   n, view  unit
//   facing   cosine between the view and the triangle, which itself never changes
float3 steradian_surface_towards(float3 n, float3 view, float facing) {
    float least = min(0.01, 0.5 * facing);
    float cosine = dot(n, view);
    bool below = cosine < least;
    float3 turned = n;
    if (below) {
        turned = steradian_select(below, steradian_surface_unit(n + view * (least - cosine)), n);
    }
    return turned;
}

// Share of a triangle's corner in the way of a hit to the curved surface that the corners' normals describe. The way leads to the mean of
// the hit's feet on the planes through the corners, by their weights. At a vertex, on a flat triangle and in a hollow it is zero.
//
//   corner   from the hit
//   normal   of the corner: unit, or zero
//   outside  the triangle's normal, turned to the viewer
// Source: Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021.
float3 steradian_surface_lift(float3 corner, float3 normal, float3 outside, float weight) {
    float3 up = normal * steradian_select(dot(normal, outside) < 0.0, -1.0, 1.0);
    return up * (weight * max(0.0, dot(corner, up)));
}

// The part of a unit vector across a normal, as a unit vector. It is computed twice, because a small part is mostly rounding.
//
//   any      the result if there is no such part
float3 steradian_surface_tangent(float3 along, float3 n, float3 any) {
    float3 across = along - n * dot(n, along);
    float3 x = steradian_surface_unit(across);
    return steradian_select(dot(across, across) > 1.0e-10, steradian_surface_unit(x - n * dot(n, x)), any);
}

// Width of a lobe.
float steradian_surface_alpha(float roughness) {
    return clamp(roughness * roughness, 1.0e-4, 1.0);
}

// Width of a brushed lobe along the rotated tangent.
//
//   strength   of anisotropy, from 0 to 1
float steradian_surface_brushed_alpha(float alpha, float strength) {
    return alpha + (1.0 - alpha) * strength * strength;
}

// Weights of a surface's lobes.
//   emission      radiance towards the viewer
//   albedo        diffuse, in the direction in which the boundary above reflects F0
//   fresnel_loss  decrease of the albedo in other directions: this fraction of (1 - v.h)^5
//   f0, f90       of the specular lobe; both are 0 without one
//   sheen         colour of Charlie's lobe
//   coat          weight of the clear coat; its F0 is 0.04
//   passes        fraction of the light from behind that comes through
struct SteradianSurfaceWeights {
    float3 emission;
    float3 albedo;
    float fresnel_loss;
    float3 f0;
    float3 f90;
    float3 sheen;
    float coat;
    float3 passes;
};

// A surface that only emits.
SteradianSurfaceWeights steradian_surface_unlit(float3 emission) {
    float3 black = float3(0.0, 0.0, 0.0);
    SteradianSurfaceWeights weights;
    weights.emission = emission;
    weights.albedo = black;
    weights.fresnel_loss = 0.0;
    weights.f0 = black;
    weights.f90 = black;
    weights.sheen = black;
    weights.coat = 0.0;
    weights.passes = black;
    return weights;
}

// The dielectric below a material's colour.
//   f0, f90  of its boundary
//   largest  channel of f0
struct SteradianSurfaceDielectric {
    float3 f0;
    float f90;
    float largest;
};

// The dielectric of a material.
//
//   specular     strength; its colour multiplies the reflectance
//   reflectance  F0 of the index of refraction
SteradianSurfaceDielectric steradian_surface_dielectric(float specular, float3 specular_color, float reflectance) {
    float3 f0 = specular_color * reflectance;
    SteradianSurfaceDielectric dielectric;
    dielectric.f0 = float3(clamp(f0.x, 0.0, 1.0), clamp(f0.y, 0.0, 1.0), clamp(f0.z, 0.0, 1.0)) * specular;
    dielectric.f90 = specular;
    dielectric.largest = max(dielectric.f0.x, max(dielectric.f0.y, dielectric.f0.z));
    return dielectric;
}

// The metallic-roughness surface. The diffuse lobe has albedo base (1 - metallic) (1 - F), F the largest channel of the dielectric's Fresnel:
// light that its specular lobe reflects does not reach it.
//
//   metallic   from 0 to 1
SteradianSurfaceWeights steradian_surface_weights(float3 emission, float3 base, float metallic, SteradianSurfaceDielectric dielectric) {
    float enters = 1.0 - dielectric.largest;
    bool loses = dielectric.largest < 1.0;
    SteradianSurfaceWeights weights = steradian_surface_unlit(emission);
    weights.albedo = base * ((1.0 - metallic) * enters);
    weights.fresnel_loss = steradian_select(loses, (dielectric.f90 - dielectric.largest) / steradian_select(loses, enters, 1.0), 0.0);
    weights.f0 = dielectric.f0 * (1.0 - metallic) + base * metallic;
    float f90 = dielectric.f90 * (1.0 - metallic) + metallic;
    weights.f90 = float3(f90, f90, f90);
    return weights;
}

// The same surface as a thin wall.
//
//   share    of the diffuse light that passes instead
//   cosine   between the normal and the view
SteradianSurfaceWeights steradian_surface_transmitting(SteradianSurfaceWeights opaque, float3 base, float metallic, SteradianSurfaceDielectric dielectric, float share, float cosine) {
    float c = clamp(1.0 - cosine, 0.0, 1.0);
    float reflected = dielectric.largest + (dielectric.f90 - dielectric.largest) * c * c * c * c * c;
    SteradianSurfaceWeights weights = opaque;
    weights.albedo = opaque.albedo * (1.0 - share);
    weights.passes = base * ((1.0 - metallic) * share * (1.0 - min(reflected, 1.0)));
    return weights;
}

// A surface below a layer that lets a fraction of the light through.
SteradianSurfaceWeights steradian_surface_below(SteradianSurfaceWeights bare, float fraction) {
    SteradianSurfaceWeights weights = bare;
    weights.albedo = bare.albedo * fraction;
    weights.f0 = bare.f0 * fraction;
    weights.f90 = bare.f90 * fraction;
    weights.passes = bare.passes * fraction;
    return weights;
}

// A surface below sheen. Light that the fibres reflect does not reach the layers below.
//
//   albedo   of a white sheen, as seen from the view
SteradianSurfaceWeights steradian_surface_with_sheen(SteradianSurfaceWeights bare, float3 sheen, float albedo) {
    SteradianSurfaceWeights weights = steradian_surface_below(bare, clamp(1.0 - max(sheen.x, max(sheen.y, sheen.z)) * albedo, 0.0, 1.0));
    weights.sheen = sheen;
    return weights;
}

// A surface below a clear coat. Light that it reflects at the view's angle does not reach the layers below.
//
//   cosine   between the coat's normal and the view
SteradianSurfaceWeights steradian_surface_with_coat(SteradianSurfaceWeights bare, float coat, float cosine) {
    float c = clamp(1.0 - cosine, 0.0, 1.0);
    float fraction = 1.0 - coat * (0.04 + 0.96 * c * c * c * c * c);
    SteradianSurfaceWeights weights = steradian_surface_below(bare, fraction);
    weights.sheen = bare.sheen * fraction;
    weights.emission = bare.emission * fraction;
    weights.coat = coat;
    return weights;
}

// A surface that covers a part of its place. The rest shows the surfaces behind.
//
//   coverage   alpha of its base colour, from 0 to 1
SteradianSurfaceWeights steradian_surface_covering(SteradianSurfaceWeights bare, float coverage) {
    float gap = 1.0 - coverage;
    SteradianSurfaceWeights weights = steradian_surface_below(bare, coverage);
    weights.emission = bare.emission * coverage;
    weights.sheen = bare.sheen * coverage;
    weights.coat = bare.coat * coverage;
    weights.passes = weights.passes + float3(gap, gap, gap);
    return weights;
}

// ==== texture ====

// Texture look-up: the mean over a pixel's footprint, as taps on ever smaller pictures. The caller reads the texels.
//
// Coordinates run from 0 to 1 over the picture. Texel centres lie at half-integers.

// Taps on a texture for the mean over a footprint.
//   covers  the footprint is more than a texel; else there is one tap on the picture itself
//   count   side by side along the footprint's longer axis, about its middle; at most 16
//   axis    that axis at full length
//   width   of a tap, in texels; its logarithm to base 2 is the level to read
struct SteradianTextureTaps {
    bool covers;
    float count;
    float2 axis;
    float width;
};

// Taps on the longer axis of the ellipse inscribed in the footprint, as wide as the shorter axis. In texels, a circle of diameter 1 becomes
// an ellipse, whose axes are those of J transpose(J).
//
//   size         of the picture, in texels
//   right, down  change of the coordinates to the pixel's neighbours
//
// Degenerate: a footprint of a million texels or more gets one tap on the mean of all.
SteradianTextureTaps steradian_texture_taps(float2 size, float2 right, float2 down) {
    float2 a = float2(right.x * size.x, right.y * size.y);
    float2 b = float2(down.x * size.x, down.y * size.y);
    float xx = a.x * a.x + b.x * b.x;
    float xy = a.x * a.y + b.x * b.y;
    float yy = a.y * a.y + b.y * b.y;
    float difference = 0.5 * (xx - yy);
    float longer2 = 0.5 * (xx + yy) + sqrt(difference * difference + xy * xy);
    SteradianTextureTaps taps;
    taps.covers = longer2 > 1.0;
    taps.count = 1.0;
    taps.axis = float2(0.0, 0.0);
    taps.width = 1.0;
    if (taps.covers) {
        bool spread = taps.covers && longer2 < 1.0e12;
        float square = steradian_select(spread, longer2, 1.0);
        float longer = sqrt(square);
        float shorter = max(1.0, abs(a.x * b.y - a.y * b.x) / longer);
        bool wide = difference > 0.0;
        float2 along = float2(steradian_select(wide, square - yy, xy), steradian_select(wide, xy, square - xx));
        float along2 = along.x * along.x + along.y * along.y;
        float scale = steradian_select(along2 > 0.0, longer / sqrt(max(along2, steradian_smallest_divisor())), 0.0);
        taps.count = steradian_select(spread, clamp(-floor(0.001 - longer / shorter), 1.0, 16.0), 1.0);
        taps.axis = float2(steradian_select(spread, along.x * scale / size.x, 0.0), steradian_select(spread, along.y * scale / size.y, 0.0));
        taps.width = steradian_select(spread, max(shorter, longer * 0.0625), steradian_select(taps.covers, 1.0e12, 1.0));
    }
    return taps;
}

// A coordinate that can be looked up: 0 for those that are not numbers, or too large to have a fraction.
float steradian_texture_coordinate(float u) {
    return steradian_select(abs(u) < 1.0e7, u, 0.0);
}

// The centre of the texel at a coordinate, where neighbours weigh nothing.
//
//   size   of the picture in that direction, in texels
float steradian_texture_center(float u, float size) {
    return (floor(u * size) + 0.5) / size;
}

// Texels on both sides of a coordinate.
//   low, high  their numbers
//   share      weight of the second
struct SteradianTextureTexels {
    float low;
    float high;
    float share;
};

// The two texels whose blend is a picture's value at a coordinate.
//
//   size   in texels, at most 2^20
//   wrap   0 repeats the picture, 1 mirrors it, 2 continues its edge
SteradianTextureTexels steradian_texture_texels(float u, float size, int wrap) {
    float inside = u;
    if (wrap == 0) {
        inside = u - floor(u);
    }
    if (wrap == 1) {
        float turn = u - 2.0 * floor(u * 0.5);
        inside = min(turn, 2.0 - turn);
    }
    float last = size - 1.0;
    float at = min(max(inside, 0.0), 1.0) * size - 0.5;
    float low = floor(at);
    float high = low + 1.0;
    SteradianTextureTexels texels;
    texels.share = at - low;
    texels.low = max(low, 0.0);
    texels.high = min(high, last);
    if (wrap == 0) {
        texels.low = steradian_select(low < 0.0, last, low);
        texels.high = steradian_select(high > last, 0.0, high);
    }
    return texels;
}
