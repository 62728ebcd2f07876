// Parity cases of texture_cell.glsl; tests/parity/case.glsl says how to write one.
// Needs: frame.glsl
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.

// The classic table's matrix and GGX, over the plane across c from a place about b on: mostly above the surface.
LtcTextureCellView case_texture_view(CaseInput i, int by_ggx) {
    mat3 frame = frame_from_normal(case_xyz(i.c));
    vec3 x = transform(frame, vec3(1.0, 0.0, 0.0));
    vec3 y = transform(frame, vec3(0.0, 1.0, 0.0));
    GgxView half_vectors = ggx_view(vec3(0.6, 0.0, 0.8), 0.5, 0.3);
    return ltc_texture_cell_view(ltc_from_classic(i.d), by_ggx, half_vectors, vec3(i.b.x, i.b.y, i.b.z + 1.0), x, y);
}

// A cell whose colours vary across it.
LtcTextureCell case_texture_cell(CaseInput i) {
    LtcTextureCell cell;
    cell.center = vec2(i.a.x, i.a.y);
    cell.axis_a = vec2(i.a.z, i.a.w);
    cell.axis_b = vec2(-0.5 * i.a.w, 0.5 * i.a.z);
    cell.area = 2.0 * dot(cell.axis_a, cell.axis_a);
    cell.radius = 2.0 * sqrt(dot(cell.axis_a, cell.axis_a));
    cell.deviation = i.b.w;
    cell.mean = vec3(i.c.w, 0.5, 0.25);
    cell.along_a = vec3(0.1, 0.05 * i.c.w, -0.05);
    cell.along_b = vec3(-0.1 * i.c.w, 0.05, 0.05);
    return cell;
}

// textured light, a lobe at a place of its plane: transformed cosine and GGX
//   a.xyz  vector(0.3, 2)
//   b.xyz  vector(0.3, 2)
//   c.xyz  direction
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
// Values: 2
vec4 case_texture_cell_value(CaseInput i) {
    vec3 place = vec3(i.a.x, i.a.y, i.a.z + 1.0);
    real by_table = ltc_texture_cell_value(case_texture_view(i, 0), place);
    return vec4(by_table, ltc_texture_cell_value(case_texture_view(i, 1), place), 0.0, 0.0);
}

// textured light, what a lobe sees of a cell: weight, radiance and what the cell may leave off
//   a.x    range(-1, 1)
//   a.y    range(-1, 1)
//   a.z    range(0.02, 0.2)
//   a.w    range(-0.1, 0.1)
//   b.xyz  vector(0.3, 2)
//   b.w    range(0.01, 0.5)
//   c.xyz  direction
//   c.w    range(0.1, 1)
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
// Values: 3
vec4 case_texture_cell_seen(CaseInput i) {
    LtcTextureCellSeen seen = ltc_texture_cell_seen(case_texture_cell(i), case_texture_view(i, 0), vec3(0.3, 0.4, 0.5));
    return vec4(seen.weight, ltc_texture_cell_luminance(seen.radiance), seen.error, 0.0);
}

// textured light, whether cells are small against a lobe whose peak is on the light
//   a.x    log(0.1, 3)
//   a.y    range(0.5, 2)
//   a.z    range(0.5, 2)
//   b.xyz  vector(0.3, 2)
//   c.xyz  direction
//   d.x    range(0.5, 1.5)
//   d.y    range(-0.4, 0.4)
//   d.z    range(-0.4, 0.4)
//   d.w    range(1, 2)
vec4 case_texture_cell_resolves(CaseInput i) {
    mask resolves = ltc_texture_cell_resolves(case_texture_view(i, 0), i.a.x, vec4(-i.a.y, i.a.z, -i.a.z, i.a.y));
    return case_of_real(select(resolves, 1.0, 0.0));
}
