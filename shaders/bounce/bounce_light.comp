// Algorithm 2 of Xia et al. 2023, second pass: light from virtual lights at each pixel. A thread handles a receiver and its block's lights.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "bounce.glsl"
#include "bounce_kernels.glsl"
#include "bounce_lobe.glsl"

layout(constant_id = 2) const int GGX_LOBES = 0;
// Choices for a tile's receivers: some have a glossy lobe; some are sharp, and see virtual lights as quads.
layout(constant_id = 3) const int ANY_GLOSSY = 1;
layout(constant_id = 4) const int ANY_QUADS = 0;
const bool GGX = GGX_LOBES == 1;
const bool SHINES = ANY_GLOSSY == 1;
const bool QUADS = ANY_QUADS == 1;

struct Receiver {
    vec3 position;
    vec3 normal;
    bool glossy;
    bool sharp;
    IndirectLobe lobe;
    mat3 frame;  // GGX only, like all below
    vec3 view;
    float alpha;
    vec3 f0;
    vec3 grazing;
};

vec3 diffuse_sum;
vec3 glossy_sum;

void add_pair(Receiver at, IndirectWay way, float kept, float value, vec3 bright, float soft, vec3 light_normal, int edges,
              float inverse_area, float size2) {
    float cosine = max(dot(at.normal, way.v), 0.0);
    diffuse_sum += bright * (kept * cosine * (way.inverse * way.inverse));
    if (!SHINES || !at.glossy) return;
    if (GGX) {
        IndirectGgx end = indirect_ggx(at.frame, at.view, at.alpha, way.v * way.inverse);
        glossy_sum += bright * (at.f0 + at.grazing * end.grazing) * (kept * (end.lobe * way.inverse));
        return;
    }
    float through = indirect_glossy_half(at.lobe, way.v, way.d2, 0.0);
    if (QUADS && at.sharp) {
        IndirectQuad quad = IndirectQuad(light_normal, lights[edges].xyz, lights[edges + 1].xyz, inverse_area, size2);
        if (indirect_quad_matters(at.lobe, quad, way, kept, value))
            through = indirect_quad_half(at.lobe, quad, way, soft, kept / max(value, smallest_divisor()));
    }
    if (cosine > 0.0) glossy_sum += bright * (kept * through);
}

void add_diffuse_light(Receiver at, int light) {
    vec4 place = lights[light];
    vec4 turned = lights[light + 1];
    vec4 bright = lights[light + 2];
    IndirectWay way = indirect_way(place.xyz, at.position);
    float value = indirect_diffuse_half(turned.xyz, way.v, way.d2, bright.w);
    float kept = indirect_kept(value, place.w * (way.d2 * way.inverse), turned.w);
    if (kept > 0.0)
        add_pair(at, way, kept, value, bright.xyz, bright.w, turned.xyz, light + 3, lights[light + 3].w, lights[light + 4].w);
}

void add_glossy_light(Receiver at, int light) {
    vec4 place = lights[light];
    vec4 x = lights[light + 1];
    vec4 y = lights[light + 2];
    vec4 z = lights[light + 3];
    vec4 turned = lights[light + 4];
    vec4 colour = lights[light + 5];
    vec3 grazing = lights[light + 6].xyz;
    IndirectWay way = indirect_way(place.xyz, at.position);
    vec3 bright = colour.xyz;
    float value = 0.0;
    if (GGX) {
        IndirectGgx end = indirect_ggx(mat3(x.xyz, y.xyz, z.xyz), vec3(turned.w, 0.0, colour.w), z.w, way.v * -way.inverse);
        value = end.lobe * way.inverse * way.d2 / (way.d2 + y.w);
        bright += grazing * end.grazing;
    } else {
        IndirectLobe lobe = IndirectLobe(x.xyz, y.xyz, z.xyz, 1.0);
        if (dot(turned.xyz, way.v) > 0.0) value = indirect_glossy_half(lobe, way.v, way.d2, y.w);
        if (z.w > 0.0) bright += grazing * indirect_grazing(lights[light + 7].xyz, way.v, way.d2);
    }
    float kept = indirect_kept(value, place.w * (way.d2 * way.inverse), x.w);
    if (kept > 0.0) add_pair(at, way, kept, value, bright, y.w, turned.xyz, light + 8, turned.w, colour.w);
}

void main() {
    int tiles = parameter(kTilesX) * parameter(kTilesY);
    int tile = parameter(parameter(kTilesAt) + int(step + gl_WorkGroupID.y));
    int set = tile / tiles;
    tile = tile % tiles;
    int receiver = int(gl_WorkGroupID.x * 64u + gl_LocalInvocationID.x);
    ivec2 pixel = pixel_of(set, tile, receiver);
    if (pixel.x < 0) return;
    int i = index_of(pixel);
    Receiver at;
    at.position = positions[i].xyz;
    at.normal = normals[i].xyz;
    at.glossy = SHINES && is_glossy(i);
    at.sharp = false;
    at.alpha = positions[i].w;
    diffuse_sum = vec3(0.0);
    glossy_sum = vec3(0.0);
    bool there = at.normal != vec3(0.0);
    vec3 view = views[i].xyz;
    vec4 magnitude = vec4(0.0);
    if (there && at.glossy) {
        at.frame = frame_from_normal_and_view(at.normal, view);
        if (GGX) {
            at.view = transform_transposed(at.frame, view);
            at.f0 = f0s[i].xyz;
            at.grazing = f90_at(i) - at.f0;
            magnitude = look_up_magnitude(sqrt(at.alpha), at.view.z);
        } else {
            at.lobe = indirect_lobe(lobe_matrix(at.normal, view, at.frame, at.alpha), at.frame);
            at.sharp = at.alpha < indirect_sharp();
        }
    }
    if (there) {
        int words = parameter(kMaskWords);
        int first_mask = ((set * tiles + tile) * kBlocksOfTile + receiver / 16) * 2 * words;
        for (int k = 0; k < 2 * words; k++) {
            uint left = masks[first_mask + k];
            bool diffuse = k < words;
            int first = parameter(kSets + set * kSet + (diffuse ? 0 : 2));
            int word = diffuse ? k : k - words;
            while (left != 0u) {
                int j = 32 * word + findLSB(left);
                left &= left - 1u;
                if (diffuse)
                    add_diffuse_light(at, first + j * kDiffuse);
                else
                    add_glossy_light(at, first + j * kGlossy);
            }
        }
    }
    if (GGX) {
        // Demodulated by the same mean reflectance as the other mode, so that both filter the same kind of signal.
        vec3 mean = at.f0 * magnitude.x + at.grazing * magnitude.y;
        for (int c = 0; c < 3; c++) glossy_sum[c] = at.glossy && mean[c] > 1.0e-12 ? glossy_sum[c] / mean[c] : 0.0;
    } else {
        glossy_sum = there && at.glossy && dot(at.normal, view) > 0.0 ? glossy_sum * at.lobe.scale : vec3(0.0);
    }
    bool adds = parameter(kAdds) == 1;
    diffuse_light[i] = vec4(diffuse_sum, 0.0) + (adds ? diffuse_light[i] : vec4(0.0));
    glossy_light[i] = vec4(glossy_sum, 0.0) + (adds ? glossy_light[i] : vec4(0.0));
}
