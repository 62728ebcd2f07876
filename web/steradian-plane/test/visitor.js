// A visitor of the room: drags the lamp, draws a wall, looks at a point, switches everything on once. plane_test.py appends it to the
// page, and ANSWER_TO before it.
const results = [];
const byId = (id) => document.getElementById(id);
const frames = () => Number(document.body.dataset.frames ?? 0);
const until = (done) => new Promise((resolve) => {
  const look = () => (done() ? resolve() : setTimeout(look, 10));
  look();
});
async function nextFrame(act) {
  const before = frames();
  act();
  await until(() => frames() > before);
}
function pointer(type, [x, y]) {
  const marks = byId("marks"), box = marks.getBoundingClientRect();
  const [x0, y0] = plane.placeOf(0, 0, box.width, box.height), [x1, y1] = plane.placeOf(box.width, box.height, box.width, box.height);
  const clientX = box.left + (box.width * (x - x0)) / (x1 - x0), clientY = box.top + (box.height * (y - y0)) / (y1 - y0);
  marks.dispatchEvent(new PointerEvent(type, { clientX, clientY, pointerId: 1, bubbles: true, button: 0 }));
}
/** The picture as it is shown, at a few points, and what the page says. */
function look(what) {
  pointer("pointermove", [300.5, 120.5]);
  const canvas = byId("picture"), copy = document.createElement("canvas");
  Object.assign(copy, { width: canvas.width, height: canvas.height });
  const context = copy.getContext("2d", { willReadFrequently: true });
  context.drawImage(canvas, 0, 0);
  const data = context.getImageData(0, 0, copy.width, copy.height).data, shown = [];
  for (let k = 0; k < 400; ++k) {
    const x = (k * 379) % copy.width, y = (k * 211) % copy.height, i = 4 * (y * copy.width + x);
    shown.push([x, y, data[i], data[i + 1], data[i + 2]]);
  }
  const said = (id) => byId(id).textContent;
  results.push({ what, width: copy.width, height: copy.height, shown, svg: plane.toSVG(), at: said("at"), value: said("value"), rays: said("by-rays"),
    error: said("error"), tiles: said("tiles"), light: said("light-ms"), problem: said("problem"), chosen: said("chosen") });
}

try {
  await until(() => frames() > 0);
  look("as it opens");
  const lamp = plane.lights.get("lamp"), from = lamp.center;
  pointer("pointerdown", from);
  for (let i = 1; i <= 6; ++i) await nextFrame(() => pointer("pointermove", [from[0] + 8 * i, from[1] + 5 * i]));
  const dragged = byId("tiles").textContent;
  await nextFrame(() => pointer("pointerup", [from[0] + 48, from[1] + 30]));
  look("the lamp is dragged");
  results.at(-1).tiles = dragged;
  byId("wall").click();
  pointer("pointerdown", [260, 260]);
  pointer("pointermove", [300, 330]);
  await nextFrame(() => pointer("pointerup", [300, 330]));
  look("a wall is drawn");
  byId("move").click();
  await nextFrame(() => byId("lamp").click());
  await nextFrame(() => byId("marks").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", shiftKey: true })));
  look("a lamp more, moved by a key");
  for (const [id, value] of [["size", 9], ["brightness", 2], ["range", 200]])
    await nextFrame(() => {
      byId(id).value = value;
      byId(id).dispatchEvent(new Event("input"));
    });
  look("smaller, with a range");
  await nextFrame(() => byId("remove").click());
  await nextFrame(() => byId("bounce").click());
  look("all bounces");
  await nextFrame(() => byId("bounce").click());
  await nextFrame(() => byId("split").click());
  look("half by rays");
  await nextFrame(() => byId("split").click());
  let copied = "";
  Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => (copied = text) }, configurable: true });
  byId("copy").click();
  await until(() => copied !== "");
  if (copied !== plane.toSVG()) throw new Error("what is copied is not the scene");
  if (!/^[0-9.]+ ms$/.test(byId("light-ms").textContent)) throw new Error(`the page gives ${byId("light-ms").textContent} as a frame's time`);
} catch (e) {
  results.push({ what: "failed", problem: e.stack });
}
fetch(ANSWER_TO, { method: "POST", mode: "no-cors", body: JSON.stringify(results) });
