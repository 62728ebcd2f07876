// Steradian 0.1.0, surface: surfaces of glTF: frames, lobes and texture look-up from factors and texels, for WGSL.
//
// Put it before your module's text; it has no bindings.
// It needs these files before it, in this order: math.wgsl.
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
fn steradian_surface_product(a: vec3f, b: vec3f) -> vec3f {
    return vec3f(a.x * b.x, a.y * b.y, a.z * b.z);
}

// Unit vector; a vector shorter than 1e-15 stays short.
fn steradian_surface_unit(a: vec3f) -> vec3f {
    return a * inverseSqrt(max(dot(a, a), steradian_smallest_divisor()));
}

// True if a vector is long enough to have a direction, and its square is in the range of float.
fn steradian_surface_has_direction(a: vec3f) -> bool {
    let square = dot(a, a);
    return square > steradian_smallest_divisor() && square < 1.0e30;
}

// The frame of tangent-space textures on the front face.
struct SteradianSurfaceFrame {
    x: vec3f,
    y: vec3f,
    z: vec3f,
}

// The frame of a normal and the mesh's tangent.
//
//   n        unit normal
//   tangent  w below 0 reverses y
//   any      unit, perpendicular to n: x where the tangent is 0 or along the normal
fn steradian_surface_frame(n: vec3f, tangent: vec4f, any: vec3f) -> SteradianSurfaceFrame {
    let t = vec3f(tangent.x, tangent.y, tangent.z);
    let across = t - n * dot(n, t);
    let usual = steradian_surface_has_direction(across);
    var frame: SteradianSurfaceFrame;
    frame.x = select(any, steradian_surface_unit(across), usual);
    frame.y = cross(n, frame.x) * select(1.0, -1.0, usual && tangent.w < 0.0);
    frame.z = n;
    return frame;
}

// Normal from a normal map, unit; the frame's normal if the map points below the surface.
//
//   map      texel, from 0 to 1
//   scale    factor of its x and y
fn steradian_surface_bent_normal(frame: SteradianSurfaceFrame, map: vec3f, scale: f32) -> vec3f {
    let up = 2.0 * map.z - 1.0;
    let bent = frame.x * ((2.0 * map.x - 1.0) * scale) + frame.y * ((2.0 * map.y - 1.0) * scale) + frame.z * up;
    return select(frame.z, steradian_surface_unit(bent), steradian_surface_has_direction(bent) && up > 0.0);
}

// A visible surface is seen from above. If interpolation or a normal map turns the normal away from the viewer, this turns it back until
// the view lies just above its horizon.
//
//   n, view  unit
//   facing   cosine between the view and the triangle, which itself never changes
fn steradian_surface_towards(n: vec3f, view: vec3f, facing: f32) -> vec3f {
    let least = min(0.01, 0.5 * facing);
    let cosine = dot(n, view);
    let below = cosine < least;
    var turned = n;
    if (below) {
        turned = select(n, steradian_surface_unit(n + view * (least - cosine)), below);
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
fn steradian_surface_lift(corner: vec3f, normal: vec3f, outside: vec3f, weight: f32) -> vec3f {
    let up = normal * select(1.0, -1.0, dot(normal, outside) < 0.0);
    return up * (weight * max(0.0, dot(corner, up)));
}

// The part of a unit vector across a normal, as a unit vector. It is computed twice, because a small part is mostly rounding.
//
//   any      the result if there is no such part
fn steradian_surface_tangent(along: vec3f, n: vec3f, any: vec3f) -> vec3f {
    let across = along - n * dot(n, along);
    let x = steradian_surface_unit(across);
    return select(any, steradian_surface_unit(x - n * dot(n, x)), dot(across, across) > 1.0e-10);
}

// Width of a lobe.
fn steradian_surface_alpha(roughness: f32) -> f32 {
    return clamp(roughness * roughness, 1.0e-4, 1.0);
}

// Width of a brushed lobe along the rotated tangent.
//
//   strength   of anisotropy, from 0 to 1
fn steradian_surface_brushed_alpha(alpha: f32, strength: f32) -> f32 {
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
    emission: vec3f,
    albedo: vec3f,
    fresnel_loss: f32,
    f0: vec3f,
    f90: vec3f,
    sheen: vec3f,
    coat: f32,
    passes: vec3f,
}

// A surface that only emits.
fn steradian_surface_unlit(emission: vec3f) -> SteradianSurfaceWeights {
    let black = vec3f(0.0, 0.0, 0.0);
    var weights: SteradianSurfaceWeights;
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
    f0: vec3f,
    f90: f32,
    largest: f32,
}

// The dielectric of a material.
//
//   specular     strength; its colour multiplies the reflectance
//   reflectance  F0 of the index of refraction
fn steradian_surface_dielectric(specular: f32, specular_color: vec3f, reflectance: f32) -> SteradianSurfaceDielectric {
    let f0 = specular_color * reflectance;
    var dielectric: SteradianSurfaceDielectric;
    dielectric.f0 = vec3f(clamp(f0.x, 0.0, 1.0), clamp(f0.y, 0.0, 1.0), clamp(f0.z, 0.0, 1.0)) * specular;
    dielectric.f90 = specular;
    dielectric.largest = max(dielectric.f0.x, max(dielectric.f0.y, dielectric.f0.z));
    return dielectric;
}

// The metallic-roughness surface. The diffuse lobe has albedo base (1 - metallic) (1 - F), F the largest channel of the dielectric's Fresnel:
// light that its specular lobe reflects does not reach it.
//
//   metallic   from 0 to 1
fn steradian_surface_weights(emission: vec3f, base: vec3f, metallic: f32, dielectric: SteradianSurfaceDielectric) -> SteradianSurfaceWeights {
    let enters = 1.0 - dielectric.largest;
    let loses = dielectric.largest < 1.0;
    var weights = steradian_surface_unlit(emission);
    weights.albedo = base * ((1.0 - metallic) * enters);
    weights.fresnel_loss = select(0.0, (dielectric.f90 - dielectric.largest) / select(1.0, enters, loses), loses);
    weights.f0 = dielectric.f0 * (1.0 - metallic) + base * metallic;
    let f90 = dielectric.f90 * (1.0 - metallic) + metallic;
    weights.f90 = vec3f(f90, f90, f90);
    return weights;
}

// The same surface as a thin wall.
//
//   share    of the diffuse light that passes instead
//   cosine   between the normal and the view
fn steradian_surface_transmitting(opaque: SteradianSurfaceWeights, base: vec3f, metallic: f32, dielectric: SteradianSurfaceDielectric, share: f32, cosine: f32) -> SteradianSurfaceWeights {
    let c = clamp(1.0 - cosine, 0.0, 1.0);
    let reflected = dielectric.largest + (dielectric.f90 - dielectric.largest) * c * c * c * c * c;
    var weights = opaque;
    weights.albedo = opaque.albedo * (1.0 - share);
    weights.passes = base * ((1.0 - metallic) * share * (1.0 - min(reflected, 1.0)));
    return weights;
}

// A surface below a layer that lets a fraction of the light through.
fn steradian_surface_below(bare: SteradianSurfaceWeights, fraction: f32) -> SteradianSurfaceWeights {
    var weights = bare;
    weights.albedo = bare.albedo * fraction;
    weights.f0 = bare.f0 * fraction;
    weights.f90 = bare.f90 * fraction;
    weights.passes = bare.passes * fraction;
    return weights;
}

// A surface below sheen. Light that the fibres reflect does not reach the layers below.
//
//   albedo   of a white sheen, as seen from the view
fn steradian_surface_with_sheen(bare: SteradianSurfaceWeights, sheen: vec3f, albedo: f32) -> SteradianSurfaceWeights {
    var weights = steradian_surface_below(bare, clamp(1.0 - max(sheen.x, max(sheen.y, sheen.z)) * albedo, 0.0, 1.0));
    weights.sheen = sheen;
    return weights;
}

// A surface below a clear coat. Light that it reflects at the view's angle does not reach the layers below.
//
//   cosine   between the coat's normal and the view
fn steradian_surface_with_coat(bare: SteradianSurfaceWeights, coat: f32, cosine: f32) -> SteradianSurfaceWeights {
    let c = clamp(1.0 - cosine, 0.0, 1.0);
    let fraction = 1.0 - coat * (0.04 + 0.96 * c * c * c * c * c);
    var weights = steradian_surface_below(bare, fraction);
    weights.sheen = bare.sheen * fraction;
    weights.emission = bare.emission * fraction;
    weights.coat = coat;
    return weights;
}

// A surface that covers a part of its place. The rest shows the surfaces behind.
//
//   coverage   alpha of its base colour, from 0 to 1
fn steradian_surface_covering(bare: SteradianSurfaceWeights, coverage: f32) -> SteradianSurfaceWeights {
    let gap = 1.0 - coverage;
    var weights = steradian_surface_below(bare, coverage);
    weights.emission = bare.emission * coverage;
    weights.sheen = bare.sheen * coverage;
    weights.coat = bare.coat * coverage;
    weights.passes = weights.passes + vec3f(gap, gap, gap);
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
    covers: bool,
    count: f32,
    axis: vec2f,
    width: f32,
}

// Taps on the longer axis of the ellipse inscribed in the footprint, as wide as the shorter axis. In texels, a circle of diameter 1 becomes
// an ellipse, whose axes are those of J transpose(J).
//
//   size         of the picture, in texels
//   right, down  change of the coordinates to the pixel's neighbours
//
// Degenerate: a footprint of a million texels or more gets one tap on the mean of all.
fn steradian_texture_taps(size: vec2f, right: vec2f, down: vec2f) -> SteradianTextureTaps {
    let a = vec2f(right.x * size.x, right.y * size.y);
    let b = vec2f(down.x * size.x, down.y * size.y);
    let xx = a.x * a.x + b.x * b.x;
    let xy = a.x * a.y + b.x * b.y;
    let yy = a.y * a.y + b.y * b.y;
    let difference = 0.5 * (xx - yy);
    let longer2 = 0.5 * (xx + yy) + sqrt(difference * difference + xy * xy);
    var taps: SteradianTextureTaps;
    taps.covers = longer2 > 1.0;
    taps.count = 1.0;
    taps.axis = vec2f(0.0, 0.0);
    taps.width = 1.0;
    if (taps.covers) {
        let spread = taps.covers && longer2 < 1.0e12;
        let square = select(1.0, longer2, spread);
        let longer = sqrt(square);
        let shorter = max(1.0, abs(a.x * b.y - a.y * b.x) / longer);
        let wide = difference > 0.0;
        let along = vec2f(select(xy, square - yy, wide), select(square - xx, xy, wide));
        let along2 = along.x * along.x + along.y * along.y;
        let scale = select(0.0, longer / sqrt(max(along2, steradian_smallest_divisor())), along2 > 0.0);
        taps.count = select(1.0, clamp(-floor(0.001 - longer / shorter), 1.0, 16.0), spread);
        taps.axis = vec2f(select(0.0, along.x * scale / size.x, spread), select(0.0, along.y * scale / size.y, spread));
        taps.width = select(select(1.0, 1.0e12, taps.covers), max(shorter, longer * 0.0625), spread);
    }
    return taps;
}

// A coordinate that can be looked up: 0 for those that are not numbers, or too large to have a fraction.
fn steradian_texture_coordinate(u: f32) -> f32 {
    return select(0.0, u, abs(u) < 1.0e7);
}

// The centre of the texel at a coordinate, where neighbours weigh nothing.
//
//   size   of the picture in that direction, in texels
fn steradian_texture_center(u: f32, size: f32) -> f32 {
    return (floor(u * size) + 0.5) / size;
}

// Texels on both sides of a coordinate.
//   low, high  their numbers
//   share      weight of the second
struct SteradianTextureTexels {
    low: f32,
    high: f32,
    share: f32,
}

// The two texels whose blend is a picture's value at a coordinate.
//
//   size   in texels, at most 2^20
//   wrap   0 repeats the picture, 1 mirrors it, 2 continues its edge
fn steradian_texture_texels(u: f32, size: f32, wrap: i32) -> SteradianTextureTexels {
    var inside = u;
    if (wrap == 0) {
        inside = u - floor(u);
    }
    if (wrap == 1) {
        let turn = u - 2.0 * floor(u * 0.5);
        inside = min(turn, 2.0 - turn);
    }
    let last = size - 1.0;
    let at = min(max(inside, 0.0), 1.0) * size - 0.5;
    let low = floor(at);
    let high = low + 1.0;
    var texels: SteradianTextureTexels;
    texels.share = at - low;
    texels.low = max(low, 0.0);
    texels.high = min(high, last);
    if (wrap == 0) {
        texels.low = select(low, last, low < 0.0);
        texels.high = select(high, 0.0, high > last);
    }
    return texels;
}
