// Mean radiance of a rect or disk with a measured profile, as a lobe sees it: Gauss's rule of 3 x 3 points in cells. Cells are as fine as
// lobe and profile need. Mirrors source/integrals/textured/profiled_light.cpp; the parity of frames holds the two together.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The surface's lobe: 0 the diffuse one, 1 the base's, 2 the coat's, 3 sheen.
const int OF_LOBE = WHICH_LOBE;

// Fraction of the lobe's width that a cell may span, as in source/integrals/textured/profiled_light.cpp.
const float kProfileLobeShare = 0.6;

// A profiled light as the host wrote it (source/device/direct/light_records.cpp): kProfileHead vectors.
struct ProfiledLight {
    vec3 center;
    bool round;
    vec3 x;
    float widest;
    vec3 y;
    int profile;
    mat3 axes;  // the profile's: x, y, aim
    float size;
    float mean;
};

ProfiledLight profiled_light_at(int first) {
    ProfiledLight light;
    light.center = details[first].xyz;
    light.round = details[first].w > 0.5;
    light.x = details[first + 1].xyz;
    light.widest = details[first + 1].w;
    light.y = details[first + 2].xyz;
    light.profile = int(details[first + 2].w);
    light.axes = mat3(details[first + 3].xyz, details[first + 4].xyz, details[first + 5].xyz);
    light.size = details[first + 3].w;
    light.mean = details[first + 4].w;
    return light;
}

// Rect: u and v along the half axes, from -1 to 1. Disk: u the distance from the middle, v the angle about it.
vec3 place_on(ProfiledLight light, vec2 at) {
    if (!light.round) return light.center + light.x * at.x + light.y * at.y;
    return light.center + light.x * (at.x * cos(at.y)) + light.y * (at.x * sin(at.y));
}

struct SeeingLobe {
    vec3 p;
    mat3 frame;
    vec3 view;
    vec3 axis;
    float width;
    vec2 factors;
    GgxView ggx;
    CharlieLobe charlie;
};

float lobe_towards(SeeingLobe lobe, vec3 direction) {
    vec3 l = transform_transposed(lobe.frame, direction);
    if (!(l.z > 0.0)) return 0.0;
    if (OF_LOBE == 0) return l.z * inverse_pi();
    if (OF_LOBE == 3) return charlie_lobe(lobe.charlie, l) * lobe.factors.x;
    return dot(ggx_lobe_and_fresnel(lobe.ggx, l, 1.0), lobe.factors);
}

// Cells: bounds u0, u1, v0, v1. A heap of cells that are too wide stands at the front, the widest first: it compares a cell's span with the
// allowed span. Cells that are fine enough stand at the back.
const int kMostCells = 256;
vec4 cells[kMostCells];
float excess_of[kMostCells];  // negative if the cell is to be halved along v
int waiting;
int fine;

void put_cell(ProfiledLight light, SeeingLobe lobe, vec4 cell) {
    vec2 low = cell.xz;
    vec2 high = cell.yw;
    vec2 at = 0.5 * (low + high);
    vec3 middle = polygon_direction(place_on(light, at) - lobe.p);
    float across_u = length(polygon_direction(place_on(light, vec2(low.x, at.y)) - lobe.p) - middle) +
                     length(polygon_direction(place_on(light, vec2(high.x, at.y)) - lobe.p) - middle);
    float across_v = length(polygon_direction(place_on(light, vec2(at.x, low.y)) - lobe.p) - middle) +
                     length(polygon_direction(place_on(light, vec2(at.x, high.y)) - lobe.p) - middle);
    float span = max(across_u, across_v);
    float from_peak = length(middle - lobe.axis) - 0.5 * span;
    float excess = span / min(light.widest, kProfileLobeShare * max(lobe.width, from_peak));
    if (!(excess > 1.0)) {
        ++fine;
        cells[kMostCells - fine] = cell;
        return;
    }
    int i = waiting;
    ++waiting;
    while (i > 0 && abs(excess_of[(i - 1) / 2]) < excess) {
        cells[i] = cells[(i - 1) / 2];
        excess_of[i] = excess_of[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    cells[i] = cell;
    excess_of[i] = across_u > across_v ? excess : -excess;
}

// Puts the last cell in place of the first.
void drop_first() {
    --waiting;
    vec4 cell = cells[waiting];
    float excess = excess_of[waiting];
    int i = 0;
    int child = 1;
    while (child < waiting) {
        if (child + 1 < waiting && abs(excess_of[child + 1]) > abs(excess_of[child])) ++child;
        if (abs(excess_of[child]) <= abs(excess)) break;
        cells[i] = cells[child];
        excess_of[i] = excess_of[child];
        i = child;
        child = 2 * i + 1;
    }
    cells[i] = cell;
    excess_of[i] = excess;
}

void find_cells(ProfiledLight light, SeeingLobe lobe) {
    waiting = 0;
    fine = 0;
    float quarter = 0.5 * pi();
    int first = light.round ? 4 : 1;
    for (int k = 0; k < first; k++)
        put_cell(light, lobe, light.round ? vec4(0.0, 1.0, float(k) * quarter, float(k + 1) * quarter) : vec4(-1.0, 1.0, -1.0, 1.0));
    while (waiting > 0 && waiting + fine < kMostCells) {
        vec4 cell = cells[0];
        bool along_u = excess_of[0] > 0.0;
        drop_first();
        float u = 0.5 * (cell.x + cell.y);
        float v = 0.5 * (cell.z + cell.w);
        put_cell(light, lobe, along_u ? vec4(cell.x, u, cell.zw) : vec4(cell.xy, cell.z, v));
        put_cell(light, lobe, along_u ? vec4(u, cell.y, cell.zw) : vec4(cell.xy, v, cell.w));
    }
}

float candela_along(ProfiledLight light, vec3 l) { return profile_intensity(light.profile, -transform_transposed(light.axes, l)); }

// Returns 0 if the peak misses the light.
float radiance_of_peak(ProfiledLight light, SeeingLobe lobe) {
    vec3 aim = light.axes[2];
    float cosine = -dot(lobe.axis, aim);
    vec3 to_center = light.center - lobe.p;
    float distance = -dot(to_center, aim) / cosine;
    if (!(distance > 0.0 && distance < 1.0e30)) return 0.0;
    vec3 at = lobe.axis * distance - to_center;
    vec3 normal = cross(light.x, light.y);
    float size2 = light.size * light.size;
    float u = dot(cross(at, light.y), normal) / size2;
    float v = dot(cross(light.x, at), normal) / size2;
    bool misses = light.round ? u * u + v * v > 1.0 : max(abs(u), abs(v)) > 1.0;
    return misses ? 0.0 : candela_along(light, lobe.axis) / abs(cosine);
}

// The mean in the form that profiled_mean (direct.glsl) reads.
vec4 mean_seen(ProfiledLight light, SeeingLobe lobe) {
    find_cells(light, lobe);
    float peak = radiance_of_peak(light, lobe);
    float seen = 0.0;
    float weight = 0.0;
    float beside_peak = 0.0;
    float least = 3.0e38;
    float most = 0.0;
    for (int i = 0; i < waiting + fine; i++) {
        vec4 cell = cells[i < waiting ? i : kMostCells - 1 - (i - waiting)];
        vec2 at = 0.5 * (cell.xz + cell.yw);
        vec2 half_size = 0.5 * (cell.yw - cell.xz);
        for (int k = 0; k < 9; k++) {
            vec2 node = vec2(float(k % 3 - 1), float(k / 3 - 1));
            vec2 here = at + half_size * (node * 0.774596669241483377);
            vec3 to = place_on(light, here) - lobe.p;
            float distance2 = dot(to, to);
            if (!(distance2 > 0.0)) continue;
            vec3 l = to * inversesqrt(distance2);
            float rule = (8.0 - 3.0 * abs(node.x)) * (8.0 - 3.0 * abs(node.y)) / 81.0;
            float w = lobe_towards(lobe, l) * rule * half_size.x * half_size.y * ((light.round ? here.x : 1.0) * light.size / distance2);
            float even = abs(dot(l, light.axes[2]));
            if (!(w > 0.0 && even > 0.0)) continue;
            float candela = candela_along(light, l);
            seen += w * candela;
            weight += w * even;
            beside_peak += w * (candela - peak * even);
            least = min(least, candela / even);
            most = max(most, candela / even);
        }
    }
    if (!(weight > 0.0)) return vec4(light.mean, 0.0, light.mean, light.mean);
    float mean = seen / weight;
    return peak > 0.0 ? vec4(peak, beside_peak, min(least, peak), max(most, peak)) : vec4(mean, 0.0, mean, mean);
}

vec2 ggx_factors(vec3 f0, vec3 f90) {
    vec3 more = abs(f90 - f0);
    return vec2(max(f0.x, max(f0.y, f0.z)), max(more.x, max(more.y, more.z)));
}

void main() {
    Entry entry = entry_here();
    vec4 position = surface_at(entry.tile, kPosition, entry.slot);
    vec4 normal = surface_at(entry.tile, kNormal, entry.slot);
    vec4 tangent = surface_at(entry.tile, kTangent, entry.slot);
    vec3 v = surface_at(entry.tile, kView, entry.slot).xyz;
    vec3 n = normal.xyz;
    vec2 alpha = vec2(position.w, normal.w);
    SeeingLobe lobe;
    lobe.p = position.xyz;
    lobe.factors = vec2(1.0, 0.0);
    if (OF_LOBE == 0) {
        vec3 albedo = surface_at(entry.tile, kAlbedo, entry.slot).xyz;
        if (!(albedo.x + albedo.y + albedo.z > 0.0)) lobe.factors.x = 0.0;
        v = n;
    } else if (OF_LOBE == 1) {
        lobe.factors = ggx_factors(surface_at(entry.tile, kF0, entry.slot).xyz, surface_at(entry.tile, kF90, entry.slot).xyz);
    } else if (OF_LOBE == 2) {
        vec4 coat = surface_at(entry.tile, kCoatNormal, entry.slot);
        n = coat.xyz;
        alpha = vec2(coat.w);
        lobe.factors = tangent.w * vec2(0.04, 0.96);
    } else {
        vec4 sheen = surface_at(entry.tile, kSheen, entry.slot);
        alpha = vec2(sheen.w);
        lobe.factors.x = max(sheen.x, max(sheen.y, sheen.z));
    }
    bool reflects = dot(normal.xyz, normal.xyz) > 0.25 && lobe.factors.x + lobe.factors.y > 0.0 && dot(n, v) > 0.0;
    Light light = light_at(listed(entry.first));
    vec4 mean = vec4(0.0);
    if (reflects && see(light, position.xyz).lit) {
        lobe.frame = OF_LOBE == 0 || OF_LOBE == 3 ? frame_from_normal(n) : frame_from_normal_and_view(n, tangent.xyz);
        lobe.view = transform_transposed(lobe.frame, v);
        bool mirrors = OF_LOBE == 1 || OF_LOBE == 2;
        lobe.axis = mirrors ? polygon_direction(2.0 * dot(n, v) * n - v) : n;
        lobe.width = mirrors ? 2.0 * max(alpha.x, alpha.y) : 1.0;
        if (mirrors) lobe.ggx = ggx_view(lobe.view, alpha.x, alpha.y);
        if (OF_LOBE == 3) lobe.charlie = charlie_prepare(lobe.view, alpha.x);
        mean = mean_seen(profiled_light_at(int(light.r[kWhereDetails].w)), lobe);
    }
    means[listed(entry.first + 1u) + slot_of_means()] = mean;
}
