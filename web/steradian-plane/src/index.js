// Light in the plane, without sampling. README.md is the manual.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { bodyFrom, bodyOf, centerOf, numbersOf, profileName, scale, shapeName, shift, triple } from "./bodies.js";
import { painterOf } from "./picture.js";
import { loadMachine, PlaneError } from "./wasm.js";

export { PlaneError };

const METHODS = ["auto", "wasm", "webgl2"];

/** One body of a scene. What is set is taken over at once; the next picture shows it. */
class Body {
  #plane;
  #body;

  constructor(plane, index, id, body) {
    this.#plane = plane;
    this.index = index; // the plane keeps it: bodies behind one that is removed move up
    this.id = id;
    this.#body = body;
  }

  get shape() {
    return shapeName(this.#body);
  }
  get isLight() {
    return this.#body.light !== null;
  }
  get center() {
    return centerOf(this.#body);
  }
  /** Of polygons, lines and capsules: their points. */
  get contours() {
    return structuredClone(this.#body.contours);
  }
  /** Of ellipses: the two conjugate half axes. */
  get axes() {
    return [[...this.#body.x], [...this.#body.y]];
  }
  get radius() {
    return this.#body.shape === 2 ? Math.hypot(...this.#body.x) : this.#body.radius;
  }
  get color() {
    return [...this.#body.color];
  }
  get albedo() {
    return this.#body.albedo && [...this.#body.albedo];
  }
  set albedo(value) {
    this.#change((b) => (b.albedo = value === null ? null : triple(value, "albedo")));
  }
  get radiance() {
    return this.#light().radiance.slice();
  }
  set radiance(value) {
    this.#change(() => (this.#light().radiance = triple(value, "radiance")));
  }
  get range() {
    return this.#light().range;
  }
  set range(value) {
    if (!(value > 0)) throw new PlaneError(this.id, "its range is not positive", "give a number above 0, Infinity for none");
    this.#change(() => (this.#light().range = value));
  }
  get profile() {
    return profileName(this.#light());
  }

  /** Its middle goes to x, y. */
  move(x, y) {
    const [cx, cy] = this.center;
    this.moveBy(x - cx, y - cy);
  }
  moveBy(dx, dy) {
    if (!Number.isFinite(dx) || !Number.isFinite(dy)) throw new PlaneError(this.id, "cannot move there", "give two finite numbers");
    this.#change((b) => shift(b, dx, dy));
  }
  scaleBy(factor) {
    if (!(factor > 0 && Number.isFinite(factor))) throw new PlaneError(this.id, "cannot be scaled so", "give a number above 0");
    this.#change((b) => scale(b, factor));
  }
  /** Another shape or light altogether: as what lights.add and occluders.add take. */
  replace(spec) {
    const next = bodyFrom(spec, this.isLight);
    this.#change((b) => Object.assign(b, next));
  }
  remove() {
    this.#plane.takeOut(this);
    this.index = -1;
  }

  #light() {
    if (!this.#body.light) throw new PlaneError(this.id, "is no light", "ask one of plane.lights");
    return this.#body.light;
  }
  #change(edit) {
    if (this.index < 0) throw new PlaneError(this.id, "has been removed", "add a new one");
    edit(this.#body);
    const numbers = numbersOf(this.#body);
    this.#plane.machine.call("plane_replace", this.#plane.handle, this.index, numbers, numbers.length);
  }
}

/** The lights of a plane, or its occluders: those of an id, and all in the scene's order. */
class Bodies {
  #shines;
  constructor(plane, shines) {
    this.plane = plane;
    this.#shines = shines;
  }
  get(id) {
    return this.plane.bodies.find((b) => b.isLight === this.#shines && b.id === id);
  }
  get size() {
    return [...this].length;
  }
  *[Symbol.iterator]() {
    yield* this.plane.bodies.filter((b) => b.isLight === this.#shines);
  }
  add(spec) {
    const body = bodyFrom(spec, this.#shines);
    return this.plane.put(body, spec.id ?? "");
  }
}

const releases = typeof FinalizationRegistry === "undefined" ? null : new FinalizationRegistry(({ machine, handle }) => machine.exports.plane_delete(handle));

export class Plane {
  /** From the text of an SVG file, or { width, height, origin, lights: [...], occluders: [...] }. Throws PlaneError. */
  static async load(scene, name = "scene.svg") {
    const machine = await loadMachine();
    const size = { width: 512, height: 512, origin: [0, 0] };
    if (typeof scene === "string" && scene.includes("<text") && typeof document !== "undefined") await document.fonts?.ready; // letters of the page's own fonts
    if (typeof scene === "string") return new Plane(machine, machine.call("plane_from_svg", scene, name));
    if (!scene || typeof scene !== "object") throw new PlaneError(name, "is no scene", "give the text of an SVG file or { lights, occluders }");
    const { width, height, origin, lights = [], occluders = [], ...rest } = { ...size, ...scene };
    for (const key of Object.keys(rest)) throw new PlaneError(name, `has no '${key}'`, "there are width, height, origin, lights, occluders");
    const plane = new Plane(machine, machine.call("plane_empty", Number(origin[0]), Number(origin[1]), Number(width), Number(height)));
    for (const spec of occluders) plane.occluders.add(spec);
    for (const spec of lights) plane.lights.add(spec);
    return plane;
  }

  /** Use Plane.load. */
  constructor(machine, handle) {
    this.machine = machine;
    this.handle = handle;
    releases?.register(this, { machine, handle }, this);
    this.warnings = machine.text(machine.call("plane_ignored", handle)).split("\n").filter(Boolean);
    this.bodies = Array.from({ length: machine.call("plane_count", handle) }, (_, i) => {
      const id = machine.text(machine.call("plane_body_name", handle, i));
      const at = machine.call("plane_body", handle, i);
      const length = machine.doubles(at, 1)[0];
      return new Body(this, i, id, bodyOf(machine.doubles(at + 8, length)));
    });
    this.lights = new Bodies(this, true);
    this.occluders = new Bodies(this, false);
    /** How far the last picture may be off, in shares of a light of radiance 1; of bounces, of the walls' mean radiance. */
    this.error = 0;
    /** Of the last picture: by what, milliseconds of light and of showing it, tiles of 16 x 16 pixels, those that were drawn again. */
    this.stats = { method: "wasm", lightMs: 0, showMs: 0, tiles: 0, drawn: 0 };
  }

  /** The part of the plane that pictures show. */
  get view() {
    const [x, y, width, height] = this.#facts();
    return { x, y, width, height };
  }

  /** Where a place of a picture is in the plane: x, y in pixels from its left top, 0.5 the middle of the first. */
  placeOf(x, y, width, height) {
    const [left, top, w, h, , , , fit, alignX, alignY] = this.#facts();
    let sx = w / width, sy = h / height;
    if (fit !== 0) sx = sy = fit === 1 ? Math.max(sx, sy) : Math.min(sx, sy); // all of the scene, or nothing but it
    return [left + (w - sx * width) * alignX + x * sx, top + (h - sy * height) * alignY + y * sy];
  }

  put(body, id) {
    const numbers = numbersOf(body);
    const index = this.machine.call("plane_add", this.handle, numbers, numbers.length, String(id));
    const made = new Body(this, index, String(id), body);
    this.bodies.push(made);
    return made;
  }
  takeOut(body) {
    if (this.bodies[body.index] !== body) throw new PlaneError(body.id, "has been removed already", "forget it");
    this.machine.call("plane_remove", this.handle, body.index);
    this.bodies.splice(body.index, 1);
    this.bodies.forEach((b, i) => (b.index = i));
  }

  /** What arrives at a point, averaged over the circle of directions, in double. rays: by so many rays instead, to compare. */
  query(x, y, { bounce = 0, rays = 0 } = {}) {
    const at = this.machine.call("plane_query", this.handle, Number(x), Number(y), bounces(bounce), whole(rays, "rays", 0, 1e6));
    const v = Array.from(this.machine.doubles(at, 9));
    return { radiance: v.slice(0, 3), moment: { x: v.slice(3, 6), y: v.slice(6, 9) } };
  }

  /**
   * Draws the light into a canvas, at its size in pixels. method: "wasm", of which, without bounces, only tiles that may have changed are worked
   * out again; "webgl2", all of it by the GPU; "auto", by the GPU where there is one and round lights are all that shines.
   * exposure in stops; tone: the curve of the program's .png ("neutral") or "linear", clipped; split: { at, rays } shows, right of that share
   * of the width, what so many rays a pixel give.
   */
  render(canvas, { method = "auto", bounce = 0, exposure = 0, tone = "neutral", split = null } = {}) {
    if (!METHODS.includes(method)) throw new PlaneError("method", `there is no '${method}'`, `there are ${METHODS.join(", ")}`);
    const { width, height } = canvas, count = bounces(bounce);
    const painter = painterOf(canvas);
    if (method === "webgl2" && !painter.light)
      throw new PlaneError("method", "webgl2 is not to be had on this canvas", "it wants WebGL2 with EXT_color_buffer_float and EXT_float_blend; use auto");
    const start = performance.now();
    const draw = (rays) => this.machine.floats(this.machine.call("plane_draw", this.handle, size(width), size(height), count, rays), 3 * width * height);
    if (split) painter.take(1, draw(whole(split.rays ?? 64, "split.rays", 1, 4096)), width, height);
    const byGpu = method === "webgl2" || (method === "auto" && painter.light && painter.isFast && count === 0 && this.#roundLights());
    const lit = byGpu ? this.#byGpu(painter.light, size(width), size(height), count) : null;
    if (lit) painter.show(0, lit);
    else painter.take(0, draw(0), width, height);
    const done = performance.now();
    const [, , , , tiles, drawn, error] = this.#facts();
    painter.paint({ exposure, tone, split: split ? split.at ?? 0.5 : 1 });
    this.error = error;
    this.stats = { method: lit ? "webgl2" : "wasm", lightMs: done - start, showMs: performance.now() - done, tiles, drawn };
  }

  /** A texture, or null where a pixel is more than the shaders can do. */
  #byGpu(light, width, height, count) {
    const at = this.machine.call("plane_gl_lists", this.handle, width, height, count, light.room);
    return light.draw(this.machine, Array.from(this.machine.doubles(at, 19)), width, height);
  }
  #roundLights() {
    return [...this.lights].every((l) => l.shape === "ellipse" && l.profile === "uniform");
  }

  /**
   * A light map for engines: radiance, RGB, row 0 on top. With moments: the averages of radiance times direction too. occluders: "black", "fill"
   * (their colour) or "clear" (the map has alpha, 0 in them). aa: point values a pixel.
   */
  light(width, height, { bounce = 0, moments = false, occluders = "black", aa = 1 } = {}) {
    const kind = ["black", "fill", "clear"].indexOf(occluders);
    if (kind < 0) throw new PlaneError("occluders", `cannot be '${occluders}'`, "there are black, fill, clear");
    const count = 3 * size(width) * size(height);
    const at = this.machine.call("plane_light", this.handle, width, height, bounces(bounce), Number(moments), whole(aa, "aa", 1, 64), kind);
    const layer = (i) => this.machine.floats(at + 4 * count * i, count).slice();
    const map = { width, height, radiance: layer(0) };
    if (moments) Object.assign(map, { momentX: layer(1), momentY: layer(2) });
    if (kind === 2) map.alpha = layer(moments ? 3 : 1).filter((_, i) => i % 3 === 0);
    return map;
  }

  /** The scene as an SVG file that the program, and Plane.load, read as the same scene. */
  toSVG() {
    return this.machine.text(this.machine.call("plane_svg", this.handle));
  }

  /** Gives its memory back at once, rather than when it is forgotten. */
  dispose() {
    releases?.unregister(this);
    this.machine.call("plane_delete", this.handle);
    this.handle = 0;
  }

  #facts() {
    return Array.from(this.machine.doubles(this.machine.call("plane_facts", this.handle), 10));
  }
}

function whole(value, what, low, high) {
  if (!Number.isInteger(value) || value < low || value > high) throw new PlaneError(what, `${value} does not do`, `give a whole number from ${low} to ${high}`);
  return value;
}
function size(value) {
  return whole(value, "size", 1, 16384);
}
function bounces(value) {
  return value === Infinity ? -1 : whole(value, "bounce", 0, 1000);
}
