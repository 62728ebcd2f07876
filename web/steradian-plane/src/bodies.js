// Lights and blockers: descriptions as a page writes them, and the lists of numbers that the module reads
// (source/body_numbers.h has the same order).
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { PlaneError } from "./wasm.js";

const SHAPES = ["polygon", "polyline", "ellipse", "capsule"];
const PROFILES = ["uniform", "lambert", "inverse"];
const OF_LIGHTS = ["radiance", "range", "profile", "spot", "gradient"];
const OF_ALL = ["id", "polygon", "polygons", "evenOdd", "line", "lines", "circle", "ellipse", "capsule", "color", "albedo"];

function finite(x, what) {
  if (typeof x !== "number" || !Number.isFinite(x)) throw new PlaneError("body", `${what} is no finite number`, "give a number");
  return x;
}
function pair(v, what) {
  if (!v || v.length !== 2) throw new PlaneError("body", `${what} is no point`, "give [x, y]");
  return [finite(v[0], what), finite(v[1], what)];
}
/** One number for all channels, or three. */
function triple(v, what) {
  const all = typeof v === "number" ? [v, v, v] : v;
  if (!all || all.length !== 3) throw new PlaneError("body", `${what} is no colour`, "give one number or [r, g, b], linear");
  return all.map((x) => {
    if (finite(x, what) < 0) throw new PlaneError("body", `${what} is negative`, "give numbers of at least 0");
    return x;
  });
}
function contour(list, what) {
  if (!Array.isArray(list) || list.length === 0) throw new PlaneError("body", `${what} has no points`, "give [[x, y], ...]");
  return list.map((p) => pair(p, what));
}

/** A description as a plain record of all that a body has. shines: whether it goes into the lights. */
export function bodyFrom(spec, shines) {
  if (!spec || typeof spec !== "object") throw new PlaneError("body", "is no object", "give { circle: { center, radius } }, { polygon: [...] } or another shape");
  for (const key of Object.keys(spec)) {
    if (OF_ALL.includes(key) || (shines && OF_LIGHTS.includes(key))) continue;
    const hint = OF_LIGHTS.includes(key) ? "only lights have it" : `there are ${[...OF_ALL, ...(shines ? OF_LIGHTS : [])].join(", ")}`;
    throw new PlaneError("body", `has no '${key}'`, hint);
  }
  const body = { shape: 0, evenOdd: Boolean(spec.evenOdd), center: [0, 0], x: [0, 0], y: [0, 0], radius: 0, contours: [] };
  if (spec.polygon) body.contours = [contour(spec.polygon, "polygon")];
  else if (spec.polygons) body.contours = spec.polygons.map((c) => contour(c, "polygons"));
  else if (spec.line || spec.lines) {
    body.shape = 1;
    body.contours = (spec.lines ?? [spec.line]).map((c) => contour(c, "line"));
  } else if (spec.circle) {
    const r = finite(spec.circle.radius, "circle.radius");
    if (!(r > 0)) throw new PlaneError("body", "circle.radius is not positive", "give a number above 0");
    Object.assign(body, { shape: 2, center: pair(spec.circle.center, "circle.center"), x: [r, 0], y: [0, r] });
  } else if (spec.ellipse) {
    const { center, x, y } = spec.ellipse;
    Object.assign(body, { shape: 2, center: pair(center, "ellipse.center"), x: pair(x, "ellipse.x"), y: pair(y, "ellipse.y") });
  } else if (spec.capsule) {
    const { from, to, radius } = spec.capsule;
    Object.assign(body, { shape: 3, contours: [[pair(from, "capsule.from"), pair(to, "capsule.to")]], radius: finite(radius, "capsule.radius") });
  } else throw new PlaneError("body", "has no shape", "give polygon, polygons, line, lines, circle, ellipse or capsule");
  body.color = triple(spec.color ?? 0, "color");
  body.albedo = spec.albedo === undefined || spec.albedo === null ? null : triple(spec.albedo, "albedo");
  body.light = shines ? lightFrom(spec) : null;
  return body;
}

function lightFrom(spec) {
  const profile = PROFILES.indexOf(spec.profile ?? "uniform");
  if (profile < 0) throw new PlaneError("light", `there is no profile '${spec.profile}'`, `there are ${PROFILES.join(", ")}`);
  const range = spec.range ?? Infinity;
  if (!(range > 0)) throw new PlaneError("light", "its range is not positive", "give a number above 0, or none");
  const light = { radiance: triple(spec.radiance ?? 1, "radiance"), profile, range, spotAxis: [0, 0], spotHalfAngle: 0, gradient: null };
  if (spec.spot) {
    light.spotAxis = pair(spec.spot.axis, "spot.axis");
    light.spotHalfAngle = finite(spec.spot.halfAngle, "spot.halfAngle");
    if (!(light.spotHalfAngle > 0 && light.spotHalfAngle <= Math.PI)) throw new PlaneError("light", "spot.halfAngle is not between 0 and pi", "give it in radians");
  }
  if (spec.gradient) {
    const { from, to, stops } = spec.gradient;
    if (!Array.isArray(stops) || stops.length === 0) throw new PlaneError("light", "its gradient has no stops", "give stops: [[offset, [r, g, b]], ...]");
    light.gradient = { from: pair(from, "gradient.from"), to: pair(to, "gradient.to"), stops: stops.map(([at, c]) => [finite(at, "gradient.stops"), triple(c, "gradient.stops")]) };
  }
  return light;
}

export function numbersOf(body) {
  const out = [body.shape, Number(body.evenOdd), ...body.center, ...body.x, ...body.y, body.radius, ...body.color, Number(body.albedo !== null),
    ...(body.albedo ?? [0, 0, 0]), Number(body.light !== null)];
  if (body.light) {
    const { radiance, profile, range, spotAxis, spotHalfAngle, gradient } = body.light;
    out.push(...radiance, profile, range, ...spotAxis, spotHalfAngle, gradient ? gradient.stops.length : 0);
    if (gradient) out.push(...gradient.from, ...gradient.to, ...gradient.stops.flat(2));
  }
  out.push(body.contours.length);
  for (const c of body.contours) {
    out.push(c.length);
    for (const p of c) out.push(p[0], p[1]);
  }
  return out;
}

export function bodyOf(numbers) {
  let at = 0;
  const take = () => numbers[at++];
  const many = (n) => Array.from({ length: n }, take);
  const body = { shape: take(), evenOdd: take() !== 0, center: many(2), x: many(2), y: many(2), radius: take(), color: many(3) };
  const hasAlbedo = take() !== 0, albedo = many(3);
  body.albedo = hasAlbedo ? albedo : null;
  body.light = null;
  if (take() !== 0) {
    body.light = { radiance: many(3), profile: take(), range: take(), spotAxis: many(2), spotHalfAngle: take(), gradient: null };
    const stops = take();
    if (stops > 0) body.light.gradient = { from: many(2), to: many(2), stops: Array.from({ length: stops }, () => [take(), many(3)]) };
  }
  body.contours = Array.from({ length: take() }, () => Array.from({ length: take() }, () => many(2)));
  return body;
}

/** The middle of a body: of what it spans. */
export function centerOf(body) {
  if (body.shape === 2) return [...body.center];
  const all = body.contours.flat();
  const middle = (k) => (Math.min(...all.map((p) => p[k])) + Math.max(...all.map((p) => p[k]))) / 2;
  return [middle(0), middle(1)];
}

/** Moves a body in place. */
export function shift(body, dx, dy) {
  const by = (p) => {
    p[0] += dx;
    p[1] += dy;
  };
  by(body.center);
  body.contours.forEach((c) => c.forEach(by));
  if (body.light?.gradient) [body.light.gradient.from, body.light.gradient.to].forEach(by);
}

/** Makes a body larger or smaller about its middle, in place. */
export function scale(body, factor) {
  const [cx, cy] = centerOf(body);
  const by = (p) => {
    p[0] = cx + (p[0] - cx) * factor;
    p[1] = cy + (p[1] - cy) * factor;
  };
  body.contours.forEach((c) => c.forEach(by));
  body.x = body.x.map((v) => v * factor);
  body.y = body.y.map((v) => v * factor);
  body.radius *= factor;
}

export const shapeName = (body) => SHAPES[body.shape];
export const profileName = (light) => PROFILES[light.profile];
export { triple };
