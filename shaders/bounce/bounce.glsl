// Declarations that all passes of the bounce share. A thread handles a block, a tile's word of lights, or a pixel.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#include "bounce_layout.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };  // and alpha
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };      // zero without a surface; w: F90's red, ...
layout(std430, binding = 2) readonly buffer Views { vec4 views[]; };          // ... green
layout(std430, binding = 3) readonly buffer F0s { vec4 f0s[]; };              // ... and blue
layout(std430, binding = 4) readonly buffer Albedos { vec4 albedos[]; };
layout(std430, binding = 5) buffer Diffuse { vec4 diffuse_light[]; };
layout(std430, binding = 6) buffer Glossy { vec4 glossy_light[]; };
layout(std430, binding = 7) buffer DiffuseRows { vec4 diffuse_rows[]; };  // filtered along x; finally the radiance
layout(std430, binding = 8) buffer GlossyRows { vec4 glossy_rows[]; };
layout(std430, binding = 9) readonly buffer Lights { vec4 lights[]; };
layout(std430, binding = 10) buffer Masks { uint masks[]; };
layout(std430, binding = 11) buffer Boxes { vec4 boxes[]; };
layout(std430, binding = 12) readonly buffer Tables { vec4 tables[]; };
layout(std430, binding = 13) readonly buffer Parameters { uint parameters[]; };
layout(push_constant) uniform Push { uint step; };

int parameter(int place) { return int(parameters[place]); }

// Pixel of a tile's receiver (source/render/bounce/receivers/receivers.h, Layout). x is negative outside of the picture.
ivec2 pixel_of(int set, int tile, int receiver) {
    int block = receiver / 16;
    int tiles_x = parameter(kTilesX);
    ivec2 at = ivec2(tile % tiles_x, tile / tiles_x) * kTileSide;
    at += ivec2(block % 4, block / 4) * kBlockSide + ivec2(receiver % 4, receiver / 4 % 4);
    int stride = parameter(kStride);
    ivec2 pixel = at * stride + ivec2(set % stride, set / stride);
    return pixel.x < parameter(kWidth) && pixel.y < parameter(kHeight) ? pixel : ivec2(-1);
}
int index_of(ivec2 pixel) { return pixel.y * parameter(kWidth) + pixel.x; }

vec3 f90_at(int i) { return vec3(normals[i].w, views[i].w, f0s[i].w); }
bool is_glossy(int i) {
    vec3 f0 = f0s[i].xyz;
    vec3 f90 = f90_at(i);
    return max(f0.x, max(f0.y, f0.z)) + max(f90.x, max(f90.y, f90.z)) > 0.0;
}
