// Frames a second of drawings by one thread of WebAssembly, in processor time: cold, and where the first light moves from frame to frame, as
// `render` draws it.
//   node frame_times.mjs PACKAGE WIDTHxHEIGHT DRAWING.svg...
import { readFileSync } from "node:fs";
import { basename, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [packageFolder, size, ...drawings] = process.argv.slice(2);
const { Plane } = await import(pathToFileURL(resolve(packageFolder, "src/index.js")));
const [width, height] = size.split("x").map(Number);

/** The median of the processor's milliseconds for a frame, of two seconds of frames. */
function median(frame) {
  const times = [];
  for (const begin = performance.now(); times.length < 5 || performance.now() - begin < 2000; ) {
    const start = process.cpuUsage();
    frame();
    const used = process.cpuUsage(start);
    times.push((used.user + used.system) / 1000);
  }
  return times.sort((a, b) => a - b)[times.length >> 1];
}

for (const drawing of drawings) {
  const plane = await Plane.load(readFileSync(drawing, "utf8"), basename(drawing));
  const cold = median(() => plane.light(width, height)), light = [...plane.lights][0];
  let step = 1;
  const moving = median(() => {
    light.moveBy(step, 0.5 * step);
    step = -step;
    plane.machine.call("plane_draw", plane.handle, width, height, 0, 0);
  });
  const says = (ms) => `${ms.toFixed(1)} ms, ${(1000 / ms).toFixed(1)} frames a second`;
  console.log(`${basename(drawing)}: cold ${says(cold)}; the first light moves ${says(moving)}`);
  plane.dispose();
}
