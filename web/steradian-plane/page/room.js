// A room to play in: lamps and walls that can be dragged, what arrives under the pointer, and how long it took.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { Plane } from "../src/index.js";

const ROOM = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 400">
<g fill="#8d8a84"><path d="M0 0H640V14H0Z"/><path d="M0 386H640V400H0Z"/><path d="M0 14H14V386H0Z"/><path d="M626 14H640V386H626Z"/>
<path d="M210 14h12v120h-12z"/><path d="M210 210h12v176h-12z"/><path d="M430 250h196v12h-196z"/></g>
<g fill="#b0552f"><rect x="70" y="250" width="70" height="44"/><path d="M330 300l44 -22l18 36l-44 22z"/></g>
<g fill="#5f8f5a"><circle cx="500" cy="120" r="20"/><circle cx="300" cy="180" r="10"/><rect x="540" y="310" width="40" height="40"/></g>
<circle id="lamp" class="light" cx="120" cy="90" r="14" fill="#ffd9a0" data-intensity="7"/>
<circle id="window" class="light" cx="400" cy="90" r="20" fill="#9fc4ff" data-intensity="3"/>
<circle id="candle" class="light" cx="490" cy="330" r="6" fill="#ff8a3c" data-intensity="12" data-range="300"/>
</svg>`;

const $ = (id) => document.getElementById(id);
const picture = $("picture"), marks = $("marks");
let plane = null, chosen = null, hover = null, drag = null, wall = null, pointer = null;
let drawing = false, due = false;

const sRGB = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
const linear = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
const hex = (c) => "#" + c.map((x) => Math.round(255 * Math.min(Math.max(sRGB(x), 0), 1)).toString(16).padStart(2, "0")).join("");
const unhex = (text) => [1, 3, 5].map((i) => linear(parseInt(text.slice(i, i + 2), 16) / 255));

function say(e) {
  $("problem").textContent = e ? e.message : "";
}
function guarded(job) {
  try {
    job();
    say(null);
  } catch (e) {
    say(e);
  }
}

async function open(svg, name) {
  try {
    const next = await Plane.load(svg, name);
    plane?.dispose();
    plane = next;
    globalThis.plane = plane; // for the console
    chosen = hover = drag = wall = null;
    say(plane.warnings.length ? { message: `left out: ${plane.warnings.join("; ")}` } : null);
    fit();
    choose(null);
  } catch (e) {
    say(e);
  }
}

/** As large as the room it has, at most 1.3 million pixels. */
function fit() {
  if (!plane) return;
  const { width, height } = plane.view, box = $("stage").getBoundingClientRect();
  const css = Math.min(box.width / width, box.height / height);
  const pixels = css * Math.min(devicePixelRatio, Math.sqrt(1.3e6 / (css * css * width * height)));
  for (const canvas of [picture, marks]) {
    canvas.width = Math.max(1, Math.round(width * pixels));
    canvas.height = Math.max(1, Math.round(height * pixels));
    canvas.style.width = `${width * css}px`;
    canvas.style.height = `${height * css}px`;
  }
  redraw();
}

/** Once a frame of the display at most. */
function redraw() {
  due = true;
  if (drawing) return;
  drawing = true;
  requestAnimationFrame(() => {
    drawing = false;
    if (!due || !plane) return;
    due = false;
    guarded(draw);
  });
}

function draw() {
  // Bounces take a while: while something moves, light comes straight.
  const bounce = $("bounce").checked && !drag ? Infinity : 0;
  plane.render(picture, { method: $("method").value, bounce, exposure: Number($("exposure").value), split: $("split").checked && !drag ? { at: 0.5, rays: 64 } : null });
  const { method, lightMs, showMs, tiles, drawn } = plane.stats;
  $("by").textContent = { wasm: "WebAssembly", webgl2: "WebGL2" }[method];
  $("light-ms").textContent = `${lightMs.toFixed(1)} ms`;
  $("show-ms").textContent = `${showMs.toFixed(1)} ms`;
  $("tiles").textContent = `${drawn} of ${tiles} anew`;
  $("pixels").textContent = `${picture.width} x ${picture.height}`;
  $("error").textContent = plane.error.toExponential(1);
  drawMarks();
  query();
  document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
}

function pathOf(body) {
  const path = new Path2D(), { k, ox, oy } = pixels();
  const put = (p) => [(p[0] - ox) * k, (p[1] - oy) * k];
  if (body.shape === "ellipse") {
    const [[ax, ay], [bx, by]] = body.axes, [cx, cy] = body.center;
    const at = (t) => put([cx + ax * Math.cos(t) + bx * Math.sin(t), cy + ay * Math.cos(t) + by * Math.sin(t)]);
    path.moveTo(...at(0));
    for (let i = 1; i < 64; ++i) path.lineTo(...at((i * Math.PI) / 32));
    path.closePath();
    return path;
  }
  for (const contour of body.contours) {
    contour.forEach((p, i) => (i ? path.lineTo(...put(p)) : path.moveTo(...put(p))));
    if (body.shape === "polygon") path.closePath();
  }
  return path;
}

function drawMarks() {
  const g = marks.getContext("2d"), { k, ox, oy } = pixels();
  g.clearRect(0, 0, marks.width, marks.height);
  g.lineJoin = g.lineCap = "round";
  for (const body of plane.bodies) {
    const path = pathOf(body), wide = body.shape === "capsule" ? 2 * body.radius * k : 1.5;
    g.lineWidth = wide;
    if (!body.isLight) {
      g.fillStyle = g.strokeStyle = hex(body.color.map((x) => 0.25 * x + 0.02));
      body.shape === "polygon" || body.shape === "ellipse" ? g.fill(path, body.shape === "polygon" ? "evenodd" : "nonzero") : g.stroke(path);
    }
    if (body !== chosen && body !== hover) continue;
    g.lineWidth = wide + (body === chosen ? 2.5 : 1);
    g.strokeStyle = body === chosen ? "#5b9bff" : "#ffffff90";
    g.stroke(path);
  }
  if (wall) {
    g.strokeStyle = "#5b9bff";
    g.lineWidth = 8 * k;
    g.beginPath();
    g.moveTo((wall.from[0] - ox) * k, (wall.from[1] - oy) * k);
    g.lineTo((wall.to[0] - ox) * k, (wall.to[1] - oy) * k);
    g.stroke();
  }
}

function placeOf(event) {
  const box = marks.getBoundingClientRect();
  return plane.placeOf(event.clientX - box.left, event.clientY - box.top, box.width, box.height);
}
/** From the plane to pixels of the marks: their scale, and where the origin of the plane is. */
function pixels() {
  const [x, y] = plane.placeOf(0, 0, marks.width, marks.height), k = marks.width / (plane.placeOf(marks.width, 0, marks.width, marks.height)[0] - x);
  return { k, ox: x, oy: y };
}

/** The body under a point, lights first, with some room around them for fingers. */
function bodyAt([x, y], slack) {
  const g = marks.getContext("2d"), { k, ox, oy } = pixels();
  const within = (body) => {
    g.lineWidth = (2 * (body.shape === "capsule" ? body.radius : 0) + (body.isLight ? 2 * slack : slack)) * k;
    const path = pathOf(body), at = [(x - ox) * k, (y - oy) * k];
    return (body.shape === "polygon" && g.isPointInPath(path, ...at, "evenodd")) || (body.shape === "ellipse" && g.isPointInPath(path, ...at)) || g.isPointInStroke(path, ...at);
  };
  return [...plane.bodies].reverse().sort((a, b) => Number(b.isLight) - Number(a.isLight)).find(within) ?? null;
}

function query() {
  if (!pointer) return;
  const [x, y] = pointer, bounce = $("bounce").checked && !drag ? Infinity : 0;
  const show = (v) => v.map((c) => c.toFixed(5)).join(" ");
  $("at").textContent = `${x.toFixed(2)}, ${y.toFixed(2)}`;
  $("value").textContent = show(plane.query(x, y, { bounce }).radiance);
  $("by-rays").textContent = show(plane.query(x, y, { rays: 64 }).radiance);
}

function choose(body) {
  chosen = body;
  const light = body?.isLight;
  $("chosen").textContent = body ? `${light ? "Lamp" : "Wall"} ${body.id ? `"${body.id}"` : ""}` : "Nothing is chosen";
  $("remove").disabled = !body;
  $("size").disabled = !body;
  for (const id of ["brightness", "range", "colour"]) $(id).disabled = !light;
  if (body) $("size").value = sizeOf(body);
  if (light) {
    const top = Math.max(...body.radiance, 1e-6);
    $("brightness").value = Math.log2(top);
    $("range").value = Math.min(body.range, 1000);
    $("colour").value = hex(body.radiance.map((x) => x / top));
  }
  showNumbers();
  if (plane) drawMarks();
}
function sizeOf(body) {
  if (body.shape === "ellipse") return body.radius;
  const all = body.contours.flat(), span = (k) => Math.max(...all.map((p) => p[k])) - Math.min(...all.map((p) => p[k]));
  return Math.max(span(0), span(1)) / 2 || 1;
}
function showNumbers() {
  const put = (id, text) => ($(id).nextElementSibling.textContent = text);
  put("size", chosen ? sizeOf(chosen).toFixed(0) : "");
  put("brightness", chosen?.isLight ? (2 ** $("brightness").value).toFixed(2) : "");
  put("range", chosen?.isLight ? (Number($("range").value) >= 1000 ? "none" : $("range").value) : "");
  put("exposure", Number($("exposure").value).toFixed(1));
}

// ---- Pointer: mouse, pen and touch -----------------------------------------------------------------------------------

let tool = "move";
function takeTool(name) {
  tool = name;
  for (const id of ["move", "wall"]) $(id).setAttribute("aria-pressed", String(id === name));
  marks.style.cursor = name === "wall" ? "crosshair" : "default";
}

marks.addEventListener("pointerdown", (e) => {
  if (!plane) return;
  marks.focus({ preventScroll: true });
  pointer = placeOf(e);
  if (tool === "wall") wall = { from: pointer, to: pointer };
  else {
    const body = bodyAt(pointer, e.pointerType === "touch" ? 16 : 4);
    choose(body);
    if (body) drag = { body, last: pointer };
  }
  try {
    marks.setPointerCapture(e.pointerId);
  } catch {
    // a pointer that is not there, of a script
  }
});
marks.addEventListener("pointermove", (e) => {
  if (!plane) return;
  pointer = placeOf(e);
  if (wall) wall.to = pointer;
  if (drag) {
    guarded(() => drag.body.moveBy(pointer[0] - drag.last[0], pointer[1] - drag.last[1]));
    drag.last = pointer;
    redraw();
    return;
  }
  const under = tool === "move" && !wall ? bodyAt(pointer, 4) : null;
  if (under !== hover) marks.style.cursor = tool === "wall" ? "crosshair" : under ? "grab" : "default";
  hover = under;
  drawMarks();
  guarded(query);
});
function release() {
  if (wall && Math.hypot(wall.to[0] - wall.from[0], wall.to[1] - wall.from[1]) > 3) {
    const { from, to } = wall;
    guarded(() => choose(plane.occluders.add({ capsule: { from, to, radius: 4 }, color: [0.3, 0.3, 0.28] })));
  }
  wall = drag = null;
  if (plane) redraw();
}
marks.addEventListener("pointerup", release);
marks.addEventListener("pointercancel", release);
marks.addEventListener("pointerleave", () => {
  if (!drag) hover = null;
});

// ---- Keys and controls -------------------------------------------------------------------------------------------------

const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
marks.addEventListener("keydown", (e) => {
  if (!plane) return;
  const step = STEPS[e.key];
  if (step && chosen) guarded(() => chosen.moveBy(step[0] * (e.shiftKey ? 10 : 1), step[1] * (e.shiftKey ? 10 : 1)));
  else if ((e.key === "Delete" || e.key === "Backspace") && chosen) removeChosen();
  else if (e.key === "Tab" && plane.bodies.length > 0) {
    const next = plane.bodies.indexOf(chosen) + (e.shiftKey ? -1 : 1);
    if (next < 0 || next >= plane.bodies.length) return choose(null); // the browser's own focus goes on
    choose(plane.bodies[next]);
  } else return;
  e.preventDefault();
  redraw();
});
function removeChosen() {
  guarded(() => chosen.remove());
  if (hover === chosen) hover = null;
  choose(null);
  redraw();
}

$("move").onclick = () => takeTool("move");
$("wall").onclick = () => takeTool("wall");
$("remove").onclick = removeChosen;
$("lamp").onclick = () => {
  const { x, y, width, height } = plane.view;
  guarded(() => choose(plane.lights.add({ circle: { center: [x + width / 2, y + height / 2], radius: height / 40 }, radiance: [8, 7, 5] })));
  takeTool("move");
  redraw();
};
$("size").oninput = () => {
  guarded(() => chosen.scaleBy(Number($("size").value) / sizeOf(chosen)));
  showNumbers();
  redraw();
};
const setLight = () => {
  guarded(() => {
    const top = 2 ** $("brightness").value, range = Number($("range").value);
    chosen.radiance = unhex($("colour").value).map((x) => x * top);
    chosen.range = range >= 1000 ? Infinity : range;
  });
  showNumbers();
  redraw();
};
for (const id of ["brightness", "range", "colour"]) $(id).oninput = setLight;
for (const id of ["bounce", "exposure", "split", "method"])
  $(id).oninput = () => {
    showNumbers();
    redraw();
  };
$("copy").onclick = async () => {
  const svg = plane.toSVG();
  try {
    await navigator.clipboard.writeText(svg);
    say({ message: "The SVG is on the clipboard." });
  } catch {
    // Without leave to write there: as a file.
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
    link.download = "room.svg";
    link.click();
    URL.revokeObjectURL(link.href);
  }
};
$("open").onclick = () => $("file").click();
$("file").onchange = async () => {
  const file = $("file").files[0];
  if (file) await open(await file.text(), file.name);
};
addEventListener("resize", fit);
open(ROOM, "room.svg");
