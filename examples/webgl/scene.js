// The scene: objects, lights of every shape, and their triangles.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
"use strict";

const SKY = [0.0006, 0.0007, 0.0010];
const KINDS = ["polygon", "disk", "ball", "tube"];  // their order is the numbers of light.glsl
const METHODS = {  // name in the address: name on the page, the best of its lobe; their order is the numbers of light.glsl
  "lambert": ["Diffuse alone: exact", "lambert"],
  "representative-point": ["GGX: representative point", "closed-form-high"],
  "ltc-clipless": ["GGX: LTC without clipping", "closed-form-high"],
  "ltc": ["GGX: LTC, table of 64 x 64", "closed-form-high"],
  "ltc-compact": ["GGX: LTC, 4 KB table", "closed-form-high"],
  "closed-form-draft": ["GGX: closed form, draft", "closed-form-high"],
  "closed-form": ["GGX: closed form", "closed-form-high"],
  "closed-form-high": ["GGX: closed form, high", "closed-form-high"],
  "half-vector": ["GGX: half vectors", "closed-form-high"],
  "blinn-phong": ["Blinn-Phong: half vectors", "blinn-phong"],
  "beckmann": ["Beckmann: half vectors", "beckmann"],
  "arvo": ["Phong: Arvo's recurrence", "phong-exact"],
  "lorentzian": ["Phong: Lorentzian fit", "phong-exact"],
  "pearson": ["Phong: Pearson fit", "phong-exact"],
  "ellipsoid": ["Phong: ellipsoid fit", "phong-exact"],
  "series": ["Phong: series", "phong-exact"],
  "series-high": ["Phong: series, high", "phong-exact"],
  "phong-exact": ["Phong: by quadrature", "phong-exact"],
};

const add = (a, b) => a.map((x, i) => x + b[i]);
const times = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(a, 1 / Math.hypot(...a));

// A grid of (columns + 1) x (rows + 1) points; at(u, v) gives place and normal, u and v from 0 to 1.
function patch(columns, rows, at) {
  const vertices = new Float32Array(6 * (columns + 1) * (rows + 1)), indices = [];
  for (let j = 0, k = 0; j <= rows; ++j)
    for (let i = 0; i <= columns; ++i, ++k) {
      const { place, normal } = at(i / columns, j / rows);
      vertices.set([...place, ...normal], 6 * k);
      if (i === columns || j === rows) continue;
      const a = j * (columns + 1) + i, b = a + columns + 1;
      indices.push(a, a + 1, b + 1, a, b + 1, b);
    }
  return { vertices, indices: new Uint32Array(indices) };
}

function joined(parts) {
  const vertices = [], indices = [];
  for (const part of parts) {
    const first = vertices.length / 6;
    for (const x of part.vertices) vertices.push(x);
    for (const i of part.indices) indices.push(i + first);
  }
  return { vertices: new Float32Array(vertices), indices: new Uint32Array(indices) };
}

const turn = (t) => [Math.cos(2 * Math.PI * t), Math.sin(2 * Math.PI * t)];
function sphere(center, radius, fine = 96) {
  return patch(fine, fine / 2, (u, v) => {
    const [c, s] = turn(u), [y, r] = turn(v / 2), normal = [r * c, y, r * s];
    return { place: add(center, times(normal, radius)), normal };
  });
}
// A ring, leaning forward by 25 degrees.
function torus(center, large, small) {
  const C = Math.cos(0.436), S = Math.sin(0.436), leaning = ([x, y, z]) => [x, C * y - S * z, S * y + C * z];
  return patch(128, 64, (u, v) => {
    const [c, s] = turn(u), [a, b] = turn(v), r = large + small * a;
    return { place: add(center, leaning([r * c, small * b, r * s])), normal: leaning([a * c, b, a * s]) };
  });
}
function rect(center, x, y, columns = 1, rows = 1) {
  const normal = unit(cross(x, y));
  return patch(columns, rows, (u, v) => ({ place: add(center, add(times(x, 2 * u - 1), times(y, 2 * v - 1))), normal }));
}
function box(center, half) {
  const faces = [];
  for (let k = 0; k < 3; ++k)
    for (const side of [-1, 1]) {
      const axis = (i, s) => [0, 1, 2].map((n) => (n === (k + i) % 3 ? half[n] * s : 0));
      faces.push(rect(add(center, axis(0, side)), axis(1, 1), axis(2, side), 8, 8));
    }
  return joined(faces);
}

const THINGS = [
  { mesh: "floor", make: () => rect([0, 0, 0], [0, 0, 9], [9, 0, 0], 96, 96), albedo: [0.30, 0.29, 0.28], checker: [0.16, 0.16, 0.17], f0: [0.04, 0.04, 0.04], roughness: 0.35 },
  { mesh: "gold ball", make: () => sphere([-1.15, 0.55, 0.35], 0.55), albedo: [0, 0, 0], f0: [1.0, 0.77, 0.34], roughness: 0.28 },
  { mesh: "red ball", make: () => sphere([0.45, 0.4, 1.0], 0.4), albedo: [0.55, 0.06, 0.05], f0: [0.05, 0.05, 0.05], roughness: 0.42 },
  { mesh: "ring", make: () => torus([1.35, 0.62, -0.25], 0.48, 0.17), albedo: [0, 0, 0], f0: [0.95, 0.93, 0.88], roughness: 0.2 },
  { mesh: "block", make: () => box([0.05, 0.45, -0.75], [0.45, 0.45, 0.3]), albedo: [0.12, 0.22, 0.36], f0: [0.04, 0.04, 0.04], roughness: 0.6 },
];

// A star of five points about a centre, counter-clockwise as seen from where x cross y points to.
function star(center, x, y) {
  return Array.from({ length: 10 }, (_, i) => {
    const [c, s] = turn(i / 10 + 0.25), r = i % 2 ? 0.45 : 1;
    return add(center, add(times(x, r * c), times(y, r * s)));
  });
}
function square(center, x, y) {
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => add(center, add(times(x, a), times(y, b))));
}

// The lights at a size: 1 as they are.
function lights_at(size, brightness) {
  const bright = (c) => times(c, brightness), s = size;
  const down = (v) => times(v, s);
  return [
    { name: "quad", kind: "polygon", radiance: bright([6.0, 4.9, 3.6]), vertices: square([0.2, 2.0, -1.2], down([0.75, 0, 0]), down([0, 0.28, 0.34])) },
    { name: "star", kind: "polygon", radiance: bright([3.6, 4.6, 7.0]), vertices: star([-2.3, 1.3, 0.3], down([0, 0.12, -0.55]), down([-0.2, 0.52, 0.12])) },
    { name: "disk", kind: "disk", radiance: bright([7.0, 3.4, 4.4]), vertices: [[2.5, 1.25, 0.8], down([0, 0, 0.42]), down([0.14, 0.4, 0])] },
    { name: "ball", kind: "ball", radiance: bright([9.0, 8.0, 6.0]), vertices: [[-0.35, 0.16, 1.55]], radius: 0.16 * s },
    { name: "tube", kind: "tube", radiance: bright([2.6, 7.0, 5.0]), vertices: [[-0.95, 0.07, 2.1], [0.3, 0.07, 2.45]], radius: 0.05 * s },
  ];
}

// A light as something to see: what faces away from its lit side is dark.
function light_mesh(light) {
  if (light.kind === "ball") return sphere(light.vertices[0], light.radius, 48);
  if (light.kind === "tube") {
    const [a, b] = light.vertices, axis = unit(add(b, times(a, -1))), x = unit(cross(axis, [0, 1, 0])), y = cross(axis, x);
    return patch(32, 33, (u, v) => {
      const [c, s] = turn(u), row = Math.round(v * 33), far = row > 16;
      const [up, r] = turn((far ? row - 17 : 16 - row) / 16 / 4), along = (far ? 1 : -1) * r, normal = add(times(add(times(x, c), times(y, s)), up), times(axis, along));
      return { place: add(far ? b : a, times(normal, light.radius)), normal };
    });
  }
  const outline = light.kind === "disk" ? Array.from({ length: 64 }, (_, i) => {
    const [c, s] = turn(i / 64);
    return add(light.vertices[0], add(times(light.vertices[1], c), times(light.vertices[2], s)));
  }) : light.vertices;
  const center = times(outline.reduce(add), 1 / outline.length), normal = [0, 1, 0];
  const vertices = new Float32Array([center, ...outline].flatMap((p) => [...p, ...normal]));
  return { vertices, indices: new Uint32Array(outline.flatMap((_, i) => [0, i + 1, ((i + 1) % outline.length) + 1])) };
}

// The visible faces of a light: a flat one shows nothing on its back.
function shown_of(light, eye) {
  if (light.kind === "ball" || light.kind === "tube") return light.radiance;
  const [first, ...others] = light.vertices, from = (p) => add(p, times(first, -1));
  const area = light.kind === "disk" ? cross(...others) : others.slice(1).map((p, i) => cross(from(others[i]), from(p))).reduce(add);
  return dot(area, from(eye)) > 0 ? light.radiance : [0.02, 0.02, 0.02];
}

// Column by column; a camera is { orbit, rise, distance }.
const AIM = [-0.3, 0.5, 0.2];
function eye_of({ orbit, rise, distance }) {
  return add(AIM, times([Math.sin(orbit) * Math.cos(rise), Math.sin(rise), Math.cos(orbit) * Math.cos(rise)], distance));
}
function projection_of(camera, aspect) {
  const eye = eye_of(camera), back = unit(add(eye, times(AIM, -1))), right = unit(cross([0, 1, 0], back)), up = cross(back, right);
  const f = 1 / 0.42, near = 0.05, far = 60, depth = (far + near) / (near - far), shift = (2 * far * near) / (near - far);
  const row = (v, s) => [...times(v, s), -dot(v, eye) * s];
  const rows = [row(right, f / aspect), row(up, f), [...times(back, depth), -dot(back, eye) * depth + shift], [...times(back, -1), dot(back, eye)]];
  return new Float32Array([0, 1, 2, 3].flatMap((c) => rows.map((r) => r[c])));
}
