// Letters of the page's fonts as outlines: drawn on a canvas of 256 pixels an em, and traced where half of a pixel is covered.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
const EM = 256, BESIDE = EM; // the space around a letter's advance box, for letters that reach beyond it
const TOLERANCE = 0.15; // pixels by which an outline may leave the traced one

/** The functions that source/page_fonts.cpp asks for. `machine`: gives the module's exports once they are there. */
export function lettersFor(machine) {
  const fonts = []; // CSS
  const text = (at) => {
    const memory = new Uint8Array(machine().memory.buffer);
    return new TextDecoder().decode(memory.subarray(at, memory.indexOf(0, at)));
  };
  const widths = new Map();
  const width = (font, letters) => {
    const key = `${font} ${letters}`;
    if (!widths.has(key)) {
      const context = contextFor(fonts[font - 1], 1, 1);
      widths.set(key, context.measureText(letters).width / EM);
    }
    return widths.get(key);
  };
  const letter = (code) => String.fromCodePoint(code);
  return {
    page_font: (families, weight, slant) => {
      const css = `${text(slant) || "normal"} ${text(weight) || "normal"} ${EM}px ${text(families) || "sans-serif"}`;
      const context = contextFor(css, 1, 1);
      if (!context) return 0;
      // A canvas ignores a font that it cannot read, and keeps "10px sans-serif".
      fonts.push(context.font.startsWith("10px") ? `${EM}px sans-serif` : css);
      return fonts.length;
    },
    page_advance: (font, code) => width(font, letter(code)),
    page_kerning: (font, before, code) => width(font, letter(before) + letter(code)) - width(font, letter(before)) - width(font, letter(code)),
    page_outlines: (font, code) => {
      const list = [];
      for (const outline of outlinesOf(fonts[font - 1], letter(code), width(font, letter(code)))) list.push(outline.length / 2, ...outline);
      list.push(0);
      const at = machine().malloc(8 * list.length);
      new Float64Array(machine().memory.buffer, at, list.length).set(list);
      return at;
    },
  };
}

function contextFor(font, width, height) {
  const canvas = typeof OffscreenCanvas !== "undefined" ? new OffscreenCanvas(width, height)
    : typeof document !== "undefined" ? Object.assign(document.createElement("canvas"), { width, height }) : null;
  const context = canvas?.getContext("2d", { willReadFrequently: true }) ?? null;
  if (context) context.font = font;
  return context;
}

/** Closed outlines in ems, x and y in turn, from the left end of the baseline. */
function outlinesOf(font, letter, advance) {
  const across = Math.ceil(advance * EM) + 2 * BESIDE, down = 2 * EM + BESIDE, base = Math.round(1.5 * EM);
  const context = contextFor(font, across, down);
  context.fillText(letter, BESIDE, base);
  const { data } = context.getImageData(0, 0, across, down);
  const covered = (x, y) => (x < 0 || y < 0 || x >= across || y >= down ? 0 : data[4 * (y * across + x) + 3] / 255);
  return trace(covered, across, down).map((outline) => {
    const simple = simplified(outline);
    return simple.flatMap(([x, y]) => [(x + 0.5 - BESIDE) / EM, (y + 0.5 - base) / EM]);
  });
}

/** Marching squares at one half, between the middles of pixels; linear in between. What is covered lies to the left of every outline's way. */
function trace(covered, across, down) {
  const next = new Map(), place = new Map();
  // Edges of the lattice by number: 2 k is to the right of the pixel, 2 k + 1 is below it.
  const right = (x, y) => 2 * ((y + 1) * (across + 2) + x + 1), below = (x, y) => right(x, y) + 1;
  const put = (edge, x, y, dx, dy) => {
    if (place.has(edge)) return edge;
    const a = covered(x, y), t = (0.5 - a) / (covered(x + dx, y + dy) - a);
    place.set(edge, [x + dx * t, y + dy * t]);
    return edge;
  };
  for (let y = -1; y < down; ++y)
    for (let x = -1; x < across; ++x) {
      const c = [covered(x, y), covered(x + 1, y), covered(x + 1, y + 1), covered(x, y + 1)].map((v) => v >= 0.5);
      const count = c.filter(Boolean).length;
      if (count === 0 || count === 4) continue;
      // The cell's sides in the order of its corners; a side from covered to bare is where an outline enters, the other way it leaves.
      const side = [() => put(right(x, y), x, y, 1, 0), () => put(below(x + 1, y), x + 1, y, 0, 1), () => put(right(x, y + 1), x, y + 1, 1, 0), () => put(below(x, y), x, y, 0, 1)];
      for (let k = 0; k < 4; ++k) {
        if (!(c[k] && !c[(k + 1) % 4])) continue;
        let end = k; // leaves by the side where what is covered begins, seen backwards
        while (!(c[(end + 1) % 4] && !c[end % 4])) end = (end + 1) % 4;
        next.set(side[k](), side[end]());
      }
    }
  const outlines = [];
  while (next.size > 0) {
    const outline = [];
    for (let edge = next.keys().next().value; next.has(edge); ) {
      outline.push(place.get(edge));
      const to = next.get(edge);
      next.delete(edge);
      edge = to;
    }
    outlines.push(outline);
  }
  return outlines;
}

/** Douglas and Peucker's points of a closed outline: no other point is further than TOLERANCE from them. */
function simplified(outline) {
  const distance = ([px, py], [ax, ay], [bx, by]) => {
    const dx = bx - ax, dy = by - ay, length2 = dx * dx + dy * dy;
    const t = length2 > 0 ? Math.min(Math.max(((px - ax) * dx + (py - ay) * dy) / length2, 0), 1) : 0;
    return Math.hypot(px - ax - t * dx, py - ay - t * dy);
  };
  const furthest = (from, to, measure) => {
    let best = from, most = -1;
    for (let k = from + 1; k < to; ++k) if (measure(outline[k]) > most) [best, most] = [k, measure(outline[k])];
    return [best, most];
  };
  const [far] = furthest(0, outline.length, ([x, y]) => Math.hypot(x - outline[0][0], y - outline[0][1]));
  const closed = [...outline, outline[0]], kept = new Set([0, far]), open = [[0, far], [far, outline.length]];
  while (open.length > 0) {
    const [from, to] = open.pop();
    const [at, off] = furthest(from, to, (p) => distance(p, closed[from], closed[to]));
    if (off <= TOLERANCE) continue;
    kept.add(at);
    open.push([from, at], [at, to]);
  }
  return [...kept].sort((a, b) => a - b).map((k) => outline[k]);
}
