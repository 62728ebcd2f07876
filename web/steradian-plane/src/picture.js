// Radiance on a canvas: by WebGL2, which tone maps on the GPU, or, where there is none, by a 2D canvas.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { GlLight } from "./gl_light.js";

const painters = new WeakMap();

/** The painter of a canvas, made once: a canvas has one kind of context for its life. */
export function painterOf(canvas) {
  let painter = painters.get(canvas);
  if (painter?.lost) painter = undefined;
  if (!painter) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true });
    painter = gl ? new WebGLPainter(gl) : new CanvasPainter(canvas.getContext("2d"));
    painters.set(canvas, painter);
  }
  return painter;
}

// The tone curve of the program's .png: Khronos PBR Neutral, then sRGB (source/image/tone.cpp).
const TONE = `
vec3 neutral(vec3 c) {
  float low = min(c.x, min(c.y, c.z));
  c -= low < 0.08 ? low - 6.25 * low * low : 0.04;
  float peak = max(c.x, max(c.y, c.z));
  if (peak < 0.76) return c;
  float new_peak = 1.0 - 0.0576 / (peak + 0.24 - 0.76);
  c *= new_peak / peak;
  float g = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
  return mix(c, vec3(new_peak), g);
}
vec3 srgb(vec3 c) {
  return mix(1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}`;

const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D left, right;
uniform float scale, split;
uniform bool linear;
out vec4 color;
${TONE}
void main() {
  ivec2 size = textureSize(left, 0);
  ivec2 at = ivec2(int(gl_FragCoord.x), size.y - 1 - int(gl_FragCoord.y));
  vec3 c = gl_FragCoord.x < split ? texelFetch(left, at, 0).xyz : texelFetch(right, at, 0).xyz;
  c = clamp(c * scale, 0.0, 1e6);
  color = vec4(linear ? min(c, 1.0) : srgb(clamp(neutral(c), 0.0, 1.0)), 1.0);
}`;

class WebGLPainter {
  constructor(gl) {
    this.gl = gl;
    this.light = GlLight.of(gl);
    gl.canvas.addEventListener("webglcontextlost", () => (this.lost = true), { once: true });
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
    this.at = Object.fromEntries(["left", "right", "scale", "split", "linear"].map((name) => [name, gl.getUniformLocation(program, name)]));
    this.program = program;
    this.textures = [0, 1].map((unit) => {
      const texture = gl.createTexture();
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      return { texture, width: 0, height: 0 };
    });
    gl.useProgram(program);
    gl.uniform1i(this.at.left, 0);
    gl.uniform1i(this.at.right, 1);
  }

  /** Does the machine have a GPU of its own, rather than a program in the place of one? */
  get isFast() {
    const names = this.gl.getExtension("WEBGL_debug_renderer_info");
    return !/swiftshader|llvmpipe|software|basic render/i.test(this.gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : this.gl.RENDERER));
  }

  /** A picture that is there as a texture. */
  show(unit, texture) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
  }

  take(unit, values, width, height) {
    const gl = this.gl, t = this.textures[unit];
    this.show(unit, t.texture);
    if (t.width === width && t.height === height) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGB, gl.FLOAT, values);
    else gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB32F, width, height, 0, gl.RGB, gl.FLOAT, values);
    Object.assign(t, { width, height });
  }

  paint({ exposure, tone, split }) {
    const gl = this.gl;
    gl.useProgram(this.program);
    gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
    gl.uniform1f(this.at.scale, 2 ** exposure);
    gl.uniform1f(this.at.split, split * gl.canvas.width);
    gl.uniform1i(this.at.linear, Number(tone === "linear"));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

/** One pixel by the same curve; in place of values, three numbers from 0 to 255. */
export function toneMapped(r, g, b, scale, linear) {
  let c = [r, g, b].map((x) => Math.min(Math.max(x * scale, 0), 1e6));
  if (linear) return c.map((x) => 255 * Math.min(x, 1));
  const low = Math.min(...c);
  const offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
  c = c.map((x) => x - offset);
  const peak = Math.max(...c);
  if (peak >= 0.76) {
    const newPeak = 1 - 0.0576 / (peak + 0.24 - 0.76), g1 = 1 - 1 / (0.15 * (peak - newPeak) + 1);
    c = c.map((x) => ((x * newPeak) / peak) * (1 - g1) + newPeak * g1);
  }
  return c.map((x) => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.min(x, 1) ** (1 / 2.4) - 0.055));
}

class CanvasPainter {
  constructor(context) {
    this.context = context;
    this.layers = [];
  }

  take(unit, values, width, height) {
    this.layers[unit] = values.slice(); // the module's memory moves on
    this.width = width;
    this.height = height;
  }

  paint({ exposure, tone, split }) {
    const image = this.context.createImageData(this.width, this.height), edge = split * this.width, scale = 2 ** exposure;
    for (let i = 0; i < this.width * this.height; ++i) {
      const from = this.layers[(i % this.width) + 0.5 < edge ? 0 : 1];
      const [r, g, b] = toneMapped(from[3 * i], from[3 * i + 1], from[3 * i + 2], scale, tone === "linear");
      image.data.set([Math.round(r), Math.round(g), Math.round(b), 255], 4 * i);
    }
    this.context.putImageData(image, 0, 0);
  }
}
