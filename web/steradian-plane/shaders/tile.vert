// The square of a job's tile.
#include "../../../shaders/plane/plane_layout.glsl"
#include "textures.glsl"
uniform uint first_job;
uniform vec2 size;
flat out uint job;

void main() {
    job = (first_job + uint(gl_InstanceID)) * uint(kJob);
    uint tile = lists[job];
    vec2 corner = vec2(float(lists[tile]), float(lists[tile + 1u])) + 16.0 * vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
    gl_Position = vec4(corner / size * 2.0 - 1.0, 0.0, 1.0);
}
