// Draws scenes by WebGL2 and by WebAssembly, and says how far the floats are apart. plane_test.py appends it to the page, and ANSWER_TO and
// SCENES (name, text and bounces) before it.
async function drawn(plane, canvas, options) {
  const gl = canvas.getContext("webgl2"), times = [];
  for (let i = 0; i < 2; ++i) {
    plane.render(canvas, options);
    times.push(plane.stats.lightMs);
  }
  gl.activeTexture(gl.TEXTURE0);
  const frame = gl.createFramebuffer(), values = new Float32Array(4 * canvas.width * canvas.height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.FLOAT, values);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return { values, ms: Math.min(...times), method: plane.stats.method };
}

try {
  const answers = [];
  const Plane = await new Promise((resolve) => {
    const look = () => (globalThis.plane ? resolve(globalThis.plane.constructor) : setTimeout(look, 10));
    look();
  });
  for (const [name, text, bounce] of SCENES) {
    const plane = await Plane.load(text, name), { width, height } = plane.view, canvas = document.createElement("canvas");
    const scale = Math.min(1, Math.sqrt(10000 / (width * height)));
    Object.assign(canvas, { width: Math.round(width * scale), height: Math.round(height * scale) });
    const gpu = await drawn(plane, canvas, { method: "webgl2", bounce: bounce || 0 });
    const map = plane.light(canvas.width, canvas.height, { bounce: bounce || 0 });
    let worst = 0, lit = 0, beyond = 0, at = null;
    for (let i = 0; i < map.radiance.length; ++i) {
      const want = map.radiance[i], got = gpu.values[4 * Math.floor(i / 3) + (i % 3)];
      const off = Math.abs(got - want) / Math.max(1, want);
      beyond += !(off <= 2e-5);
      if (!(off <= worst)) [worst, at] = [off, [Math.floor(i / 3) % map.width, Math.floor(i / 3 / map.width), got, want]];
      lit += want > 0;
    }
    const start = performance.now();
    plane.light(canvas.width, canvas.height, { bounce: bounce || 0 });
    answers.push({ name, bounce, method: gpu.method, width: canvas.width, height: canvas.height, worst, at, beyond, lit: lit / map.radiance.length, gpuMs: gpu.ms, wasmMs: performance.now() - start });
    plane.dispose();
  }
  fetch(ANSWER_TO, { method: "POST", mode: "no-cors", body: JSON.stringify(answers) });
} catch (e) {
  fetch(ANSWER_TO, { method: "POST", mode: "no-cors", body: JSON.stringify([{ failed: e.stack }]) });
}
