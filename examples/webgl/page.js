// The page's controls. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
"use strict";
const $ = (id) => document.getElementById(id);
const query = new URLSearchParams(location.search);
const SLIDERS = [  // name, label, unit, low, high, start, step
  ["size", "Size of the lights", "times", 0.3, 2, 1, 0.01],
  ["brightness", "Brightness", "times", 0.1, 4, 1, 0.05],
  ["gloss", "Roughness", "times", 0.5, 2, 1, 0.01],
  ["exposure", "Exposure", "EV", -3, 3, 0.7, 0.1],
  ["bar", "Bar", "", 0, 1, 0.5, 0.01],
  ["gain", "Difference shown", "times", 1, 64, 8, 1],
];
const COMPARE = ["one", "side by side", "difference"];
const canvas = $("canvas");
const state = { method: query.get("method") ?? "closed-form", other: query.get("other") ?? "ltc-compact", mode: Number(query.get("mode") ?? 0),
                camera: { orbit: Number(query.get("orbit") ?? 0.35), rise: Number(query.get("rise") ?? 0.3), distance: Number(query.get("distance") ?? 5.2) },
                lights: (query.get("lights") ?? "quad,star,disk,ball,tube").split(",") };
for (const [name, , , , , start] of SLIDERS) state[name] = Number(query.get(name) ?? start);
let renderer = null;

function scene_now(eye) {
  const lights = lights_at(state.size, state.brightness).filter((l) => state.lights.includes(l.name));
  const things = THINGS.map((t) => ({ ...t, roughness: Math.min(Math.max(t.roughness * state.gloss, 0.05), 1) }));
  for (const light of lights) {
    const mesh = `${light.name} ${state.size}`;
    things.push({ mesh, make: () => light_mesh(light), emission: shown_of(light, eye) });
  }
  return { lights, things };
}

// Draws at the canvas's size, scale x scale texels a pixel: for smooth edges, the light needs none.
function draw(scale) {
  const { width, height } = canvas, eye = eye_of(state.camera), { lights, things } = scene_now(eye);
  const g = renderer.fill_gbuffer(things, state.camera, width * scale, height * scale);
  const first = renderer.light("first", g, lights, state.method, eye);
  const second = state.mode > 0 ? renderer.light("second", g, lights, state.other, eye) : first;
  renderer.show(first, second, { mode: state.mode, scale, exposure: state.exposure, gain: state.gain, bar: state.bar, width, height });
  return { g, first, lights, eye };
}

// How far a method is from the best of its lobe, over what a small picture sees: relative root mean square.
function error_of(method) {
  const best = METHODS[method][1], width = 240, height = 160, eye = eye_of(state.camera), { lights, things } = scene_now(eye);
  if (best === method) return null;
  const { width: w, height: h } = canvas;
  const g = renderer.fill_gbuffer(things, state.camera, width, height);
  const place = renderer.read(g), a = renderer.read(renderer.light("first", g, lights, method, eye)), b = renderer.read(renderer.light("second", g, lights, best, eye));
  let off = 0, sum = 0;
  for (let i = 0; i < a.length; i += 4) {
    if (place[i + 3] < 0.5) continue;
    for (let c = 0; c < 3; ++c) {
      off += (a[i + c] - b[i + c]) ** 2;
      sum += b[i + c] ** 2;
    }
  }
  canvas.width = w;
  canvas.height = h;
  return Math.sqrt(off / Math.max(sum, 1e-30));
}
function show_errors() {
  const words = [...new Set([state.method, ...(state.mode > 0 ? [state.other] : [])])].map((m) => {
    const e = error_of(m);
    return `${METHODS[m][0]}: ${e === null ? "the best of its lobe" : `${(100 * e).toPrecision(2)} % rms off ${METHODS[METHODS[m][1]][0].split(": ")[1]}`}`;
  });
  $("errors").textContent = words.join("; ");
}

// For the test: what a small picture shows, and what it is made of, ?test=WIDTHxHEIGHT&method=...
function dump(size) {
  [canvas.width, canvas.height] = size.split("x").map(Number);
  const { g, first, lights, eye } = draw(1), { width, height } = canvas, gl = renderer.gl;
  const shown = new Uint8Array(4 * width * height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, shown);
  const coded = (array) => {
    const bytes = new Uint8Array(array.buffer);
    let text = "";
    for (let i = 0; i < bytes.length; i += 3072) text += String.fromCharCode(...bytes.subarray(i, i + 3072));
    return btoa(text);
  };
  const [places, normals, albedos, mirrors] = [0, 1, 2, 3].map((i) => coded(renderer.read(g, i)));
  const answer = { width, height, eye, lights, places, normals, albedos, mirrors, radiance: coded(renderer.read(first)), shown: coded(shown), error: query.has("error") ? error_of(state.method) : null };
  document.body.innerHTML = `<pre id="answer">${JSON.stringify(answer)}</pre>`;
}

function fail(e) { $("errors").textContent = `Cannot draw: ${e.message}`; }

let pending = false, settle = 0;
function redraw() {
  clearTimeout(settle);
  settle = setTimeout(() => frame(true), 180);
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    frame(false);
  });
}
// While something moves a pixel is one texel; at rest four, and errors are told.
function frame(at_rest) {
  const scale = Math.min(window.devicePixelRatio, 1.5);
  canvas.width = Math.round(canvas.clientWidth * scale);
  canvas.height = Math.round(canvas.clientHeight * scale);
  try {
    if (at_rest) show_errors();
    draw(at_rest ? 2 : 1);
  } catch (e) {
    fail(e);
  }
}

function row_of(html, parent) {
  const row = document.createElement("label");
  row.innerHTML = html;
  parent.append(row);
  return row;
}
function refresh() {
  for (const [name, , unit] of SLIDERS) $(`row-${name}`).children[1].textContent = `${state[name]} ${unit}`;
  $("row-bar").hidden = state.mode !== 1;
  $("row-gain").hidden = state.mode !== 2;
  $("row-other").hidden = state.mode === 0;
  $("method").value = state.method;
  $("other").value = state.other;
  $("mode").value = state.mode;
  for (const name of ["quad", "star", "disk", "ball", "tube"]) $(`light-${name}`).checked = state.lights.includes(name);
  redraw();
}
function toggle(name) {
  state.lights = state.lights.includes(name) ? state.lights.filter((n) => n !== name) : [...state.lights, name];
  refresh();
}

function add_controls() {
  const rows = $("rows"), options = (names) => names.map(([value, words]) => `<option value="${value}">${words}</option>`).join("");
  const methods = options(Object.entries(METHODS).map(([k, v]) => [k, v[0]]));
  row_of(`<span>Method</span><select id="method">${methods}</select>`, rows);
  row_of(`<span>Compare</span><select id="mode">${options(COMPARE.map((words, i) => [i, words]))}</select>`, rows);
  row_of(`<span>With</span><select id="other">${methods}</select>`, rows).id = "row-other";
  for (const name of ["method", "other"]) $(name).oninput = () => { state[name] = $(name).value; refresh(); };
  $("mode").oninput = () => { state.mode = Number($("mode").value); refresh(); };
  for (const [name, label, , low, high, , step] of SLIDERS) {
    const row = row_of(`<span>${label}</span><output></output><input type="range" min="${low}" max="${high}" step="${step}" value="${state[name]}">`, rows);
    row.id = `row-${name}`;
    row.lastChild.oninput = () => { state[name] = Number(row.lastChild.value); refresh(); };
  }
  for (const name of ["quad", "star", "disk", "ball", "tube"]) {
    row_of(`<input type="checkbox" id="light-${name}"> ${name}`, $("lights"));
    $(`light-${name}`).oninput = () => toggle(name);
  }
}

// Mouse, pen, touch: one pointer walks around, two come nearer; the wheel too. Keys: see the page.
const pointers = new Map();
function turn_camera(dx, dy) {
  state.camera.orbit -= dx * 0.006;
  state.camera.rise = Math.min(Math.max(state.camera.rise + dy * 0.006, 0.03), 1.45);
  redraw();
}
function zoom(factor) {
  state.camera.distance = Math.min(Math.max(state.camera.distance * factor, 2.2), 14);
  redraw();
}
function span() {
  const [a, b] = [...pointers.values()];
  return Math.hypot(a.x - b.x, a.y - b.y);
}
function add_hands() {
  canvas.addEventListener("pointerdown", (e) => {
    canvas.focus({ preventScroll: true });
    pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    try { canvas.setPointerCapture(e.pointerId); } catch { /* of a script */ }
  });
  canvas.addEventListener("pointermove", (e) => {
    const last = pointers.get(e.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? span() : 0, dx = e.clientX - last.x, dy = e.clientY - last.y;
    Object.assign(last, { x: e.clientX, y: e.clientY });
    if (pointers.size === 2) zoom(before / Math.max(span(), 1));
    else turn_camera(dx, dy);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom(1.1 ** Math.sign(e.deltaY)); }, { passive: false });
  const names = Object.keys(METHODS), next = (name, by) => names[(names.indexOf(name) + by + names.length) % names.length];
  const keys = {
    ArrowLeft: () => turn_camera(-12, 0), ArrowRight: () => turn_camera(12, 0), ArrowUp: () => turn_camera(0, 12), ArrowDown: () => turn_camera(0, -12),
    "+": () => zoom(1 / 1.1), "-": () => zoom(1.1), m: () => { state.method = next(state.method, 1); refresh(); }, M: () => { state.method = next(state.method, -1); refresh(); },
    o: () => { state.other = next(state.other, 1); refresh(); }, c: () => { state.mode = (state.mode + 1) % 3; refresh(); },
  };
  ["quad", "star", "disk", "ball", "tube"].forEach((name, i) => { keys[i + 1] = () => toggle(name); });
  canvas.addEventListener("keydown", (e) => {
    if (!keys[e.key] || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    keys[e.key]();
  });
  window.addEventListener("resize", redraw);
}

try {
  const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
  if (!gl) throw new Error("this browser has no WebGL2");
  for (const name of [state.method, state.other]) if (!(name in METHODS)) throw new Error(`no method ${name}`);
  renderer = new Renderer(gl, $("steradian").textContent, $("light-shader").textContent);
  if (query.has("test")) dump(query.get("test"));
  else {
    add_controls();
    add_hands();
    refresh();
  }
} catch (e) {
  fail(e);
}
