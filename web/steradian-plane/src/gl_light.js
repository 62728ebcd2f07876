// Light worked out by WebGL2: the module lists what each tile's pixels see, shaders add it up. source/gl_lists.h has the lists.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { LIBRARY, LIGHT_FRAG, MASK_FRAG, MASK_VERT, TILE_VERT } from "./plane_glsl.js";

const ACROSS = 2048; // words in a row of a texture, as shaders/textures.glsl has it
const KINDS = ["PLANE_LISTED", "PLANE_DISKS", "PLANE_CUTS", "PLANE_ARCS"];
const HEAD = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp usampler2D;\n";
const COVER_VERT = `void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
const BASE_FRAG = `uniform sampler2D base;
out vec4 light;
void main() { light = vec4(texelFetch(base, ivec2(gl_FragCoord.xy), 0).xyz, 0.0); }`;
// Is anything in a tile more than a shader could do?
const TROUBLE_FRAG = `uniform sampler2D lit;
out vec4 trouble;
void main() {
  float sum = 0.0;
  ivec2 first = 16 * ivec2(gl_FragCoord.xy), last = min(first + 16, textureSize(lit, 0));
  for (int y = first.y; y < last.y; y++)
    for (int x = first.x; x < last.x; x++) sum += texelFetch(lit, ivec2(x, y), 0).w;
  trouble = vec4(sum > 0.0 ? 1.0 : 0.0);
}`;

export class GlLight {
  /** For a context of WebGL2; null where it cannot add up floats. */
  static of(gl) {
    return gl.getExtension("EXT_color_buffer_float") && gl.getExtension("EXT_float_blend") ? new GlLight(gl) : null;
  }

  constructor(gl) {
    this.gl = gl;
    this.programs = new Map();
    this.textures = {};
    this.frame = gl.createFramebuffer();
    this.room = ACROSS * Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE), 8192);
  }

  /** The picture as a texture of floats, or null where shaders do not serve it. `facts`: of plane_gl_lists. */
  draw(machine, facts, width, height) {
    const gl = this.gl, [lists, listCount, pairs, pairCount, vertices, vertexCount, base, baseCount, maskWords, disks] = facts;
    this.put("list_words", gl.R32UI, machine.words(lists, listCount), 1);
    this.put("pair_words", gl.R32UI, machine.words(pairs, pairCount), 1);
    this.put("vertex_numbers", gl.RGBA32F, machine.floats(vertices, vertexCount), 4);
    this.texture("base", gl.RGB32F, width, height);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGB, gl.FLOAT, machine.floats(base, baseCount));
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.disable(gl.BLEND);

    const rows = Math.ceil(maskWords / ACROSS);
    this.into("mask_words", gl.R32UI, ACROSS, this.rowsFor("mask_words", rows));
    if (disks > 0) {
      const program = this.use("masks", MASK_VERT, MASK_FRAG);
      gl.uniform1f(program.at("rows"), this.textures.mask_words.height);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, disks);
    }

    this.into("lit", gl.RGBA32F, width, height);
    this.use("base", COVER_VERT, BASE_FRAG);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    KINDS.forEach((kind, i) => {
      const first = facts[10 + 2 * i], count = facts[11 + 2 * i];
      if (count === 0) return;
      const program = this.use(kind, TILE_VERT, LIGHT_FRAG, `#define KIND ${kind}\n`);
      gl.uniform2f(program.at("size"), width, height);
      gl.uniform1ui(program.at("first_job"), first);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    });
    gl.disable(gl.BLEND);

    const across = Math.ceil(width / 16), down = Math.ceil(height / 16), trouble = new Uint8Array(4 * across * down);
    this.into("trouble", gl.RGBA8, across, down);
    this.use("trouble", COVER_VERT, TROUBLE_FRAG);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, 0, across, down, gl.RGBA, gl.UNSIGNED_BYTE, trouble); // waits for all of it
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return gl.getError() === gl.NO_ERROR && trouble.every((x) => x === 0) ? this.textures.lit.texture : null;
  }

  /** Binds the program, made when it is first asked for, with its textures. */
  use(name, vertex, fragment, defines = "") {
    const gl = this.gl;
    if (!this.programs.has(name)) {
      const handle = gl.createProgram();
      for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
        const shader = gl.createShader(kind);
        gl.shaderSource(shader, HEAD + defines + (fragment === LIGHT_FRAG && kind === gl.FRAGMENT_SHADER ? LIBRARY : "") + text);
        gl.compileShader(shader);
        gl.attachShader(handle, shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
      }
      gl.linkProgram(handle);
      if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(`${name}: ${gl.getProgramInfoLog(handle)}`);
      const places = new Map(), at = (uniform) => places.get(uniform) ?? places.set(uniform, gl.getUniformLocation(handle, uniform)).get(uniform);
      const read = ["list_words", "pair_words", "mask_words", "vertex_numbers", "base", "lit"].filter((texture) => at(texture) !== null);
      this.programs.set(name, { handle, at, read });
    }
    const program = this.programs.get(name);
    gl.useProgram(program.handle);
    program.read.forEach((texture, i) => {
      gl.activeTexture(gl.TEXTURE2 + i); // the first two are the painter's
      gl.bindTexture(gl.TEXTURE_2D, this.textures[texture]?.texture ?? null);
      gl.uniform1i(program.at(texture), 2 + i);
    });
    return program;
  }

  /** Binds a texture of this size, made anew where it has another. */
  texture(name, format, width, height) {
    const gl = this.gl, known = this.textures[name];
    gl.activeTexture(gl.TEXTURE2);
    if (known?.width === width && known.height === height) return gl.bindTexture(gl.TEXTURE_2D, known.texture);
    if (known) gl.deleteTexture(known.texture);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    this.textures[name] = { texture, width, height };
  }

  /** Rows for a list: those that it has, where they do, else some to spare. */
  rowsFor(name, rows) {
    const has = this.textures[name]?.height ?? 0;
    return has >= rows && has > 0 ? has : Math.max(Math.ceil(1.3 * rows), 1);
  }

  put(name, format, values, each) {
    const gl = this.gl, count = values.length / each, full = Math.floor(count / ACROSS);
    this.texture(name, format, ACROSS, this.rowsFor(name, Math.ceil(count / ACROSS)));
    const [layout, type] = format === gl.R32UI ? [gl.RED_INTEGER, gl.UNSIGNED_INT] : [gl.RGBA, gl.FLOAT];
    if (full > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, ACROSS, full, layout, type, values.subarray(0, full * ACROSS * each));
    if (count > full * ACROSS) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, full, count - full * ACROSS, 1, layout, type, values.subarray(full * ACROSS * each));
  }

  into(name, format, width, height) {
    const gl = this.gl;
    this.texture(name, format, width, height);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.textures[name].texture, 0);
    gl.viewport(0, 0, width, height);
  }
}
