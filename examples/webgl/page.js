// The page's controls and its one draw call. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
"use strict";
const kGgx = ["ltc-compact", "closed-form-draft", "closed-form"], kGlossy = [...kGgx, "series"];
const kMethods = {  // name in the address: name on the page; their order is the numbers of scene.glsl
  "lambert": "Lambert: exact",
  "ltc-compact": "GGX: LTC, 4 KB table",
  "closed-form-draft": "GGX: closed form, draft",
  "closed-form": "GGX: closed form",
  "series": "Phong: series",
};
const kSliders = [  // name, label, unit, low, high, start, step, methods that have it
  ["roughness", "Roughness", "", 0.1, 1, 0.3, 0.01, kGgx],
  ["exponent", "Exponent", "", 1, 400, 60, 1, ["series"]],
  ["f0", "F0", "", 0, 1, 0.5, 0.01, kGlossy],
  ["height", "Height", "m", 0.05, 3, 1.3, 0.01],
  ["size", "Size", "m", 0.2, 3, 1.6, 0.01],
  ["tilt", "Tilt", "°", 0, 90, 35, 1],
  ["intensity", "Intensity", "", 0.5, 20, 5, 0.1],
  ["exposure", "Exposure", "EV", -3, 3, 0, 0.1],
  ["gain", "Difference shown", "times", 1, 64, 16, 1],
];
const query = new URLSearchParams(location.search);
const state = { orbit: Number(query.get("orbit") ?? 0.45), method: query.get("method") ?? "ltc-compact",
                other: query.get("other") ?? "" };
const canvas = document.getElementById("canvas");
const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
const text = (id) => document.getElementById(id).textContent;

function shader(type, source) {
  const s = gl.createShader(type);
  gl.shaderSource(s, source);
  gl.compileShader(s);
  if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
  return s;
}

// A program holds one method or two: what is not looked at is not compiled.
const programs = new Map();
function program_of(method, other) {
  const key = `${method} ${other}`;
  if (programs.has(key)) return programs.get(key);
  const names = Object.keys(kMethods);
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `#version 300 es
    void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER,
    `#version 300 es\nprecision highp float;\nprecision highp int;\n#define FIRST ${names.indexOf(method)}\n` +
    `#define SECOND ${names.indexOf(other)}\n` + text("steradian") + text("scene")));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const at = new Proxy({}, { get: (_, name) => gl.getUniformLocation(program, name) });
  programs.set(key, { program, at });
  return programs.get(key);
}

function draw(samples) {
  const { program, at } = program_of(state.method, state.other);
  gl.useProgram(program);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.uniform2f(at.resolution, canvas.width, canvas.height);
  gl.uniform1i(at.samples, samples);
  for (const name of ["orbit", "height", "intensity", "roughness", "f0", "exponent", "exposure", "gain"])
    gl.uniform1f(at[name], state[name]);
  gl.uniform2f(at.half_size, state.size / 2, state.size * 0.3);
  gl.uniform1f(at.tilt, state.tilt * Math.PI / 180);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

// For the test: the picture of the address's settings as text, ?test=WIDTHxHEIGHT&method=...&height=...
function dump(size) {
  [canvas.width, canvas.height] = size.split("x").map(Number);
  draw(1);
  const pixels = new Uint8Array(canvas.width * canvas.height * 4);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let bytes = "";
  for (let i = 0; i < pixels.length; i += 3072) bytes += String.fromCharCode(...pixels.subarray(i, i + 3072));
  document.body.innerHTML = `<pre id="pixels">${btoa(bytes)}</pre>`;
}

function fail(e) { document.getElementById("footer").textContent = `Cannot draw: ${e.message}`; }

let pending = false;
function redraw() {
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => {
    pending = false;
    const scale = Math.min(window.devicePixelRatio, 2);
    canvas.width = Math.round(canvas.clientWidth * scale);
    canvas.height = Math.round(canvas.clientHeight * scale);
    try { draw(2); } catch (e) { fail(e); }
  });
}

function add_choices(rows) {
  for (const [name, label, none] of [["method", "Method"], ["other", "Compare with", "nothing"]]) {
    const row = document.createElement("label");
    row.innerHTML = `<span>${label}</span><select></select>`;
    const select = row.lastChild;
    if (none) select.add(new Option(none, ""));
    for (const [value, words] of Object.entries(kMethods)) select.add(new Option(words, value));
    select.value = state[name];
    select.addEventListener("input", () => { state[name] = select.value; show_sliders(); redraw(); });
    rows.append(row);
  }
}

function add_sliders(rows) {
  for (const [name, label, unit, low, high, , step] of kSliders) {
    const row = document.createElement("label");
    row.id = `row-${name}`;
    row.innerHTML = `<span>${label}</span><output></output><input type="range" min="${low}" max="${high}" step="${step}">`;
    const [, output, input] = row.children;
    input.value = state[name];
    const show = () => { output.textContent = `${state[name]} ${unit}`; };
    input.addEventListener("input", () => { state[name] = Number(input.value); show(); redraw(); });
    show();
    rows.append(row);
  }
}

// Those that the chosen methods have.
function show_sliders() {
  for (const [name, , , , , , , methods] of kSliders) {
    const used = name === "gain" ? state.other !== "" : !methods || methods.includes(state.method) || methods.includes(state.other);
    document.getElementById(`row-${name}`).hidden = !used;
  }
}

function interact() {
  const rows = document.getElementById("rows");
  add_choices(rows);
  add_sliders(rows);
  show_sliders();
  canvas.addEventListener("pointerdown", (e) => canvas.setPointerCapture(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    if (e.buttons === 0) return;
    state.orbit -= e.movementX * 0.006;
    redraw();
  });
  window.addEventListener("resize", redraw);
  redraw();
}

try {
  if (!gl) throw new Error("this browser has no WebGL2");
  if (!(state.method in kMethods)) throw new Error(`no method ${state.method}`);
  for (const [name, , , , , start] of kSliders) state[name] = Number(query.get(name) ?? start);
  if (query.has("test")) dump(query.get("test"));
  else interact();
} catch (e) {
  fail(e);
}
