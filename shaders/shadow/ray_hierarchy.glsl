// Finds the triangles that a ray meets, in a hierarchy of boxes in a buffer (source/device/shadow/ray_hierarchy.h). The traversal needs no
// stack: nodes stand in its order, and each has the number of the node past all that is below it.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// A ray from a point along a vector, in the hierarchy's unit. Places on it are in lengths of the vector.
struct Ray {
    vec3 origin;
    vec3 along;
    vec3 inverse;  // 1 / along
    int axis;      // axis along which it is longest
    vec3 shear;    // maps it to a ray along that axis, from 0 to 1
};

// The other two coordinates, then the one along the axis.
vec3 to_axis(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }

Ray ray_of(vec3 origin, vec3 along) {
    Ray ray;
    float unit = uintBitsToFloat(hierarchy[0].x);
    along *= unit;
    ray.origin = origin * unit;
    ray.along = along;
    vec3 size = abs(along);
    ray.axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    vec3 turned = to_axis(along, ray.axis);
    ray.shear = vec3(turned.xy / turned.z, 1.0 / turned.z);
    // This avoids products of infinity and 0; no ray is that long.
    for (int i = 0; i < 3; i++) ray.inverse[i] = 1.0 / (size[i] < 1.0e-30 ? 1.0e-30 : along[i]);
    return ray;
}

// Returns true wherever the ray meets the box between two places. T. Ize, "Robust BVH Ray Traversal", Journal of Computer Graphics
// Techniques 2(2), 2013. A difference, a reciprocal of 2.5 units in the last place and a product have a relative error of less than 4e-7.
// The end is then off by less than twice that relative to the beginning.
bool meets_box(Ray ray, float first, float last, vec3 low, vec3 high) {
    vec3 a = (low - ray.origin) * ray.inverse;
    vec3 b = (high - ray.origin) * ray.inverse;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    float begin = max(max(near.x, near.y), max(near.z, first));
    float end = min(min(far.x, far.y), min(far.z, last));
    return begin <= end * 1.000001;
}

// Twice the area of a triangle with a corner at 0. Its sign is right or it is 0: products round, but never past each other. With the sides
// in the other order the result is exactly the negative. It would not be if a compiler made one rounding of two.
float twice_area(vec2 a, vec2 b) {
    precise float left = a.x * b.y;
    precise float right = a.y * b.x;
    precise float twice = left - right;
    return twice;
}

// S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2(1), 2013. The test: which
// sides between the corners pass the ray on the left? Neighbours have the same corners, so they agree about their common side, and one of
// them is hit. A ray through a side hits both. A triangle seen edge-on is not hit; those around it are. place: valid after a hit.
bool meets_triangle(Ray ray, float first, float last, vec3 v0, vec3 v1, vec3 v2, out float place) {
    vec3 a = to_axis(v0 - ray.origin, ray.axis);
    vec3 b = to_axis(v1 - ray.origin, ray.axis);
    vec3 c = to_axis(v2 - ray.origin, ray.axis);
    precise vec2 pa = a.xy - ray.shear.xy * a.z;
    precise vec2 pb = b.xy - ray.shear.xy * b.z;
    precise vec2 pc = c.xy - ray.shear.xy * c.z;
    vec3 weights = vec3(twice_area(pb, pc), twice_area(pc, pa), twice_area(pa, pb));
    bool left = all(greaterThanEqual(weights, vec3(0.0)));
    bool right = all(lessThanEqual(weights, vec3(0.0)));
    float sum = weights.x + weights.y + weights.z;
    float at = dot(weights, vec3(a.z, b.z, c.z)) * ray.shear.z;
    float size = abs(sum);
    at = sum < 0.0 ? -at : at;
    place = at / size;
    return (left || right) && size > 0.0 && at >= first * size && at <= last * size;
}

// Software devices silently end a thread's loops after 65,535 turns in all. A node takes one, a triangle another, and the end of a leaf's
// loop one more. This many nodes stay below that. A traversal that is not at the end did not finish.
const int kMostNodes = 10000;

uvec4 node_low(uint node) { return hierarchy[uint(kHead) + 2u * node]; }
uvec4 node_high(uint node) { return hierarchy[uint(kHead) + 2u * node + 1u]; }

// Number, from 1, of the first triangle that a ray meets between two places; if `any`, of some triangle. kHostFinds: the traversal took too
// many turns.
uint met_along(Ray ray, float first, float last, bool any) {
    uint end = node_high(0u).w;
    uint node = 0u;
    uint met = uint(kMeetsNothing);
    for (int turn = 0; turn < kMostNodes && node < end && !(any && met != uint(kMeetsNothing)); turn++) {
        uvec4 low = node_low(node);
        uvec4 high = node_high(node);
        bool meets = meets_box(ray, first, last, uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz));
        node = meets ? node + 1u : high.w;
        uint begin = low.w / uint(kLeafSizes);
        uint past = meets ? begin + 3u * (low.w % uint(kLeafSizes)) : begin;
        for (uint t = begin; t < past; t += 3u) {
            uvec4 corner = hierarchy[t];
            float place;
            if (meets_triangle(ray, first, last, uintBitsToFloat(corner.xyz), uintBitsToFloat(hierarchy[t + 1u].xyz),
                               uintBitsToFloat(hierarchy[t + 2u].xyz), place)) {
                last = place;
                met = corner.w + 1u;
            }
        }
    }
    return node >= end || (any && met != uint(kMeetsNothing)) ? met : uint(kHostFinds);
}
