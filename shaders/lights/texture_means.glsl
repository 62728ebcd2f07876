// Mean radiance of a textured light, as a lobe sees it: over cells of it (texture_cell.glsl). If the lobe is too narrow for cells,
// it is a look-up in blurred copies.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The surface's lobe: 0 the diffuse one, 1 the base's, 2 the coat's, 3 one of extras.steradian.
const int OF_LOBE = WHICH_LOBE;

struct Mean {
    vec3 radiance;
    bool found;
};

// Sum over the cells that a threshold does not split.
struct CellSums {
    LtcTextureCellSeen seen;
    int splits;
    bool too_deep;
};

CellSums sum_cells(LightTexture t, LtcTextureCellView view, vec3 expected, float threshold) {
    CellSums sums;
    sums.seen.weight = 0.0;
    sums.seen.radiance = vec3(0.0);
    sums.seen.error = 0.0;
    sums.splits = 0;
    sums.too_deep = false;
    int number = 0;
    int path = 1;  // below the cell: one half for each bit after the first
    do {
        TreeCell tree = tree_cell_at(t, number);
        LtcTextureCell cell = part_of(t, tree.cell, path);
        LtcTextureCellSeen seen = ltc_texture_cell_seen(cell, view, expected);
        bool covered = cell.area > 0.0;
        bool split = covered && seen.error > threshold;
        if (split && findMSB(path) == kTextureDeepest) {
            sums.too_deep = true;
            return sums;
        }
        if (split) {
            ++sums.splits;
            if (tree.child > 0)
                number = tree.child;
            else
                path *= 2;
        } else {
            if (covered) {
                sums.seen.weight += seen.weight;
                sums.seen.radiance += seen.radiance;
                sums.seen.error += seen.error;
            }
            path >>= findLSB(~path);
            if (path > 1)
                path |= 1;
            else {
                path = 1;
                number = tree.next;
            }
        }
    } while (number >= 0 && sums.splits <= kTextureSplits);
    return sums;
}

Mean mean_over_cells(LightTexture t, LtcTextureCellView view) {
    Mean mean;
    mean.radiance = vec3(0.0);
    mean.found = false;
    if (!ltc_texture_cell_resolves(view, t.finest, t.bounds)) return mean;
    vec3 expected = tree_cell_at(t, 0).cell.mean;
    LtcTextureCellSeen seen;
    float threshold = uintBitsToFloat(0x7f800000u);  // infinite
    bool over = false;
    bool closing = false;
    for (int turn = 0; turn <= kTexturePasses; turn++) {  // the first one looks at the whole light
        if (turn > 0) {
            float allowed = kTextureTolerance * ltc_texture_cell_luminance(seen.radiance);
            if (!(seen.error > allowed)) break;
            if (turn == 1) threshold = seen.error;
            float share = allowed / seen.error;
            threshold *= over ? kTextureBack : clamp(share * share * kTextureMargin, kTextureSteepest, 0.5);
            if (seen.weight > 1.0e-37) expected = seen.radiance / seen.weight;
        }
        CellSums sums = sum_cells(t, view, expected, threshold);
        if (sums.too_deep) return mean;
        over = sums.splits > kTextureSplits;
        if (!over) seen = sums.seen;
        if (!over && closing) break;
        closing = closing || over;
    }
    mean.found = seen.weight > 1.0e-37 && seen.error < 1.0e30;
    if (mean.found) mean.radiance = seen.radiance / seen.weight;
    return mean;
}

vec3 mean_by_look_up(Light light, LightTexture t, LtcTextureCellView view, mat3 frame, vec3 p) {
    LtcWalk walk = ltc_begin();
    int count = outline_length(light);
    int i = 1;
    vec3 previous = outline_place(light, frame, p, 0).direction;
    do {
        Place place = outline_place(light, frame, p, i);
        vec3 from = place.joined ? previous : place.direction;
        walk = ltc_add_edge(walk, view.transform_inverse, from, place.direction, ltc_direction(view.transform_inverse, from),
                            ltc_direction(view.transform_inverse, place.direction));
        previous = place.direction;
        ++i;
    } while (i < count);
    vec3 phi = ltc_texture_irradiance_vector(walk, see(light, p).reversed);
    vec3 normal = transform_transposed(frame, light.r[1].xyz);
    LtcTextureFootprint f = ltc_texture_footprint(view.transform_inverse, phi, normal, dot(light.r[1].xyz, t.origin - p));
    if (!f.valid) return t.mean;

    LtcTextureEllipse ellipse =
        ltc_texture_axes(vec2(dot(f.axis_a, view.x), dot(f.axis_a, view.y)), vec2(dot(f.axis_b, view.x), dot(f.axis_b, view.y)));
    vec3 from_origin = f.center - view.origin;
    vec2 hit = vec2(dot(from_origin, view.x), dot(from_origin, view.y));
    float z = max(ltc_transform(view.transform_inverse, f.center).z, smallest_divisor());
    vec2 slope = vec2(ltc_transform(view.transform_inverse, view.x).z, ltc_transform(view.transform_inverse, view.y).z) / z;
    float widest = kTextureWidest * sqrt(t.covariance.x + t.covariance.z);
    vec4 sum = vec4(0.0);
    vec4 here = vec4(0.0);
    for (int k = 0; k < 4; k++) {  // one loop, so that the code of a look-up is there once
        bool narrow = k < 2;
        LtcTextureEllipse g = ltc_texture_gaussian(ellipse, narrow ? kTextureNarrow : kTextureWide, widest);
        vec2 place = (k & 1) == 0 ? hit : t.middle + ltc_texture_place(g, hit - t.middle, slope, t.covariance);
        vec4 there = under_gaussian(t, place, g);
        float weight = narrow ? kTextureNarrowWeight : 1.0 - kTextureNarrowWeight;
        if ((k & 1) == 0)
            here = there;
        else
            sum += there.w > kTextureLeastCoverage ? there * (weight * here.w / there.w) : here * weight;
    }
    return sum.w > kTextureLeastCoverage ? sum.xyz / sum.w : t.mean;
}

vec3 mean_seen(Light light, vec3 p, vec3 n, vec3 v, float alpha) {
    LightTexture t = light_texture_at(int(light.r[kWhereDetails].w));
    mat3 frame = OF_LOBE == 0 ? frame_from_normal(n) : frame_from_normal_and_view(n, v);
    LtcMatrix matrix = ltc_texture_diffuse();
    GgxView half_vectors = ggx_view(vec3(0.0, 0.0, 1.0), 1.0, 1.0);
    if (OF_LOBE > 0) {
        float width = max(alpha, 1.0e-4);
        vec3 view = vec3(dot(frame[0], v), 0.0, dot(n, v));
        matrix = ltc_from_compact(look_up(TABLE_FIRST, MATRIX_SIZE, ltc_coordinates(sqrt(width), view.z)), width, view);
        half_vectors = ggx_view(view, width, width);
    }
    LtcTextureCellView view =
        ltc_texture_cell_view(matrix, OF_LOBE > 0 ? 1 : 0, half_vectors, transform_transposed(frame, t.origin - p),
                              transform_transposed(frame, t.axis_x), transform_transposed(frame, t.axis_y));
    Mean mean = mean_over_cells(t, view);
    return mean.found ? mean.radiance : mean_by_look_up(light, t, view, frame, p);
}

void main() {
    Entry entry = entry_here();
    vec4 position = surface_at(entry.tile, kPosition, entry.slot);
    vec4 normal = surface_at(entry.tile, kNormal, entry.slot);
    vec3 v = surface_at(entry.tile, kView, entry.slot).xyz;
    vec3 n = normal.xyz;
    float alpha = sqrt(position.w * normal.w);
    vec3 weight = vec3(0.0);
    if (OF_LOBE == 0) {
        weight = surface_at(entry.tile, kAlbedo, entry.slot).xyz;
    } else if (OF_LOBE == 1) {
        weight = surface_at(entry.tile, kF0, entry.slot).xyz + surface_at(entry.tile, kF90, entry.slot).xyz;
    } else if (OF_LOBE == 3) {
        OwnLobe own = own_lobe_at(entry.own);
        alpha = sqrt(own.ax * own.ay);
        if (surface_at(entry.tile, kF0, entry.slot).w == own.material) weight = own.color + own.f90;
    } else {
        vec4 coat = surface_at(entry.tile, kCoatNormal, entry.slot);
        n = coat.xyz;
        alpha = coat.w;
        weight = vec3(surface_at(entry.tile, kTangent, entry.slot).w);
    }
    bool reflects = dot(normal.xyz, normal.xyz) > 0.25 && weight.x + weight.y + weight.z > 0.0 && (OF_LOBE == 0 || dot(n, v) > 0.0);
    // Only one light: llvmpipe ends a thread's loops after 65,535 turns in all.
    Light light = light_at(listed(entry.first));
    vec3 mean = vec3(0.0);
    if (reflects && see(light, position.xyz).lit) mean = mean_seen(light, position.xyz, n, v, alpha);
    means[listed(entry.first + 1u) + slot_of_means()] = vec4(mean, 0.0);
}
