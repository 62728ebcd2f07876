// The rows of the masks' texture in which a disk's are.
#include "../../../shaders/plane/plane_layout.glsl"
#include "textures.glsl"
uniform float rows;
flat out uint disk;

void main() {
    disk = lists[kDiskHeader] + uint(gl_InstanceID) * uint(kDisk);
    uint cells = lists[disk + uint(kDiskTiles) + 2u] * lists[disk + uint(kDiskTiles) + 3u];
    uint first = lists[disk + uint(kDiskMasks)];
    uint end = first + cells * ((lists[disk + uint(kDiskPairs)] + 31u) / 32u + 1u);
    float row = gl_VertexID < 2 ? float(first / 2048u) : float((end + 2047u) / 2048u);
    gl_Position = vec4((gl_VertexID & 1) == 0 ? -1.0 : 1.0, row / rows * 2.0 - 1.0, 0.0, 1.0);
}
