// The light of a job's list at a pixel of its tile. The last channel counts jobs that were too much.
#include "../../../shaders/plane/plane_layout.glsl"
#include "../../../shaders/plane/plane_kinds.glsl"
#include "textures.glsl"
flat in uint job;
out vec4 light;

// ES 3.00 has none: the exponent of the lowest bit alone.
int findLSB_of(uint bits) { return int(floatBitsToUint(float(bits & (~bits + 1u))) >> 23) - 127; }

#include "../../../shaders/plane/plane_lights.glsl"

void main() {
    uint tile = lists[job];
    ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(int(lists[tile]), int(lists[tile + 1u]));
    uint slot = uint(pixel.y * 16 + pixel.x);
    if (((lists[tile + 2u + (slot >> 5)] >> (slot & 31u)) & 1u) == 1u) discard;  // something fills it
    light.xyz = light_of_job(job, float(pixel.x), float(pixel.y));
    light.w = is_for_cpu() ? 1.0 : 0.0;
}
