// Prints, as JSON, what the package answers: plane_test.py compares it with the program. Arguments: the package, scenes.
import { readFileSync } from "node:fs";
import { basename, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [packed, ...scenes] = process.argv.slice(2);
const { Plane, PlaneError } = await import(pathToFileURL(resolve(packed, "src/index.js")));
const found = { queries: [], frames: [], edits: [], refused: [] };

// A disk behind a square: values by hand.
const square = [[9, -1], [11, -1], [11, 1], [9, 1]];
const behind = await Plane.load({ width: 100, height: 20, origin: [-20, -10], lights: [{ circle: { center: [0, 0], radius: 1 } }], occluders: [{ polygon: square }] });
found.behind = [[20, 0], [20, 1], [20, 1.5], [20, 2.5], [20, 3.5], [40, 3]].map(([x, y]) => behind.query(x, y).radiance[0]);

for (const path of scenes) {
  const plane = await Plane.load(readFileSync(path, "utf8"), basename(path));
  const { x: ox, y: oy, width, height } = plane.view, points = [];
  for (let k = 0; k < 12; ++k) points.push([ox + ((k * 0.377) % 1) * width, oy + ((k * 0.691 + 0.05) % 1) * height]);
  for (const p of points) found.queries.push({ path, position: p, ...plane.query(...p) });
  const start = performance.now();
  const map = plane.light(Math.round(width), Math.round(height));
  const ms = performance.now() - start;
  const pixels = [];
  for (let k = 0; k < 60; ++k) {
    const i = (k * 7919) % map.width, j = (k * 104729) % map.height, at = 3 * (j * map.width + i);
    pixels.push({ position: [ox + ((i + 0.5) * width) / map.width, oy + ((j + 0.5) * height) / map.height], radiance: [...map.radiance.slice(at, at + 3)] });
  }
  found.frames.push({ path, ms, pixels });
}

// After edits the scene is the one that says so: as SVG, and by its values.
const room = await Plane.load(readFileSync(scenes[0], "utf8"));
const lamp = [...room.lights][0];
lamp.moveBy(3, 2);
lamp.radiance = [9, 5, 2];
lamp.range = 250;
lamp.scaleBy(1.5);
const added = room.occluders.add({ capsule: { from: [250, 200], to: [280, 260], radius: 3 }, color: 0.2 });
const gone = room.occluders.add({ polygon: [[400, 200], [440, 200], [440, 240]] });
const spot = room.lights.add({ circle: { center: [500, 200], radius: 6 }, radiance: 10, spot: { axis: [-1, 0.5], halfAngle: 0.6 } });
gone.remove();
added.move(270, 240);
spot.profile;
found.edits.push({ svg: room.toSVG(), points: [[100.5, 200.5], [300.5, 250.5], [420.5, 230.5], [200.5, 350.5]].map((p) => ({ position: p, ...room.query(...p) })) });
found.edits[0].again = (await Plane.load(room.toSVG())).query(300.5, 250.5).radiance;

// Coverage and moments.
const clear = behind.light(50, 10, { occluders: "clear", moments: true });
found.map = { inside: clear.alpha[5 * 50 + 14], outside: clear.alpha[5 * 50 + 40], moment: clear.momentX[3 * (2 * 50 + 40)], radiance: clear.radiance[3 * (2 * 50 + 40)] };
found.rays = behind.query(20, 2.5, { rays: 200000 }).radiance[0];

// A lamp inside a wall, and a stroke that is not drawn.
found.warnings = (await Plane.load(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80"><rect id="wall" x="40" y="30" width="20" height="20" stroke="#fff"/>
  <circle id="lamp" class="light" cx="50" cy="40" r="3"/><circle class="light" cx="5" cy="5" r="3"/></svg>`)).warnings;

const refuse = async (job) => {
  try {
    await job();
    found.refused.push("not refused");
  } catch (e) {
    found.refused.push(e instanceof PlaneError ? e.message : `not a PlaneError: ${e.stack}`);
  }
};
await refuse(() => Plane.load('<svg xmlns="http://www.w3.org/2000/svg">\n<rect width="x"/></svg>', "a.svg"));
await refuse(() => Plane.load("<svg>\n<g></svg>", "b.svg"));
await refuse(() => Plane.load("<svg>" + "<g>".repeat(100000), "deep.svg"));
await refuse(() => Plane.load({ lights: [{ circle: { center: [0, 0], radius: -1 } }] }));
await refuse(() => Plane.load({ lamps: [] }));
await refuse(() => behind.occluders.add({ polygon: square, range: 3 }));
await refuse(() => behind.query(NaN, 0));
await refuse(() => behind.light(0, 10));
await refuse(() => behind.light(100000, 10));
await refuse(() => behind.light(16000, 16000, { aa: 64 }));
await refuse(() => gone.moveBy(1, 1));
await refuse(() => (behind.lights.add({ circle: { center: [NaN, 0], radius: 1 } })));
await refuse(() => (lamp.radiance = -1));

// What has been disposed of is not given back once more when it is forgotten: others live in its memory by then.
const another = () => Plane.load({ lights: [{ circle: { center: [0, 0], radius: 1 } }], occluders: [{ polygon: square }] });
for (let i = 0; i < 3; ++i) (await another()).dispose();
const others = [];
for (let i = 0; i < 3; ++i) {
  others.push(await another());
  await new Promise((resume) => setTimeout(resume, 20));
  gc();
}
found.afterwards = others.map((plane) => plane.query(20, 2.5).radiance[0]);
console.log(JSON.stringify(found));
