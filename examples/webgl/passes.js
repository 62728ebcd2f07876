// WebGL2: the G-buffer by raster, one pass a light, and what is shown. SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
"use strict";

const FULL_SCREEN = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

const SURFACE_VERTEX = `#version 300 es
uniform mat4 projection;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
out vec3 p;
out vec3 n;
void main() {
  p = position;
  n = normal;
  gl_Position = projection * vec4(position, 1.0);
}`;

const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 albedo, checker, f0, emission;
uniform float roughness;
in vec3 p;
in vec3 n;
layout(location = 0) out vec4 place;
layout(location = 1) out vec4 surface;
layout(location = 2) out vec4 matt;
layout(location = 3) out vec4 mirror;
layout(location = 4) out vec4 emitted;
void main() {
  bool shines = emission.x >= 0.0;
  float odd = mod(floor(p.x) + floor(p.z), 2.0);
  place = vec4(p, shines ? 0.0 : 1.0);
  surface = vec4(normalize(n), roughness);
  matt = vec4(mix(albedo, checker, odd), 1.0);
  mirror = vec4(f0, 1.0);
  emitted = vec4(shines ? emission : vec3(0.0), 1.0);
}`;

const COPY = `#version 300 es
precision highp float;
uniform sampler2D from;
out vec4 colour;
void main() { colour = texelFetch(from, ivec2(gl_FragCoord.xy), 0); }`;

// first, second: sums of radiance, scale times as fine as the picture. mode 0: first; 1: first left of the bar, second right of it;
// 2: their difference times gain.
const SHOW = `#version 300 es
precision highp float;
uniform sampler2D first, second;
uniform int scale, mode;
uniform float exposure, gain, bar;
out vec4 colour;
vec3 display(vec3 radiance) {
  vec3 x = 1.0 - exp(-radiance * exp2(exposure));
  return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, vec3(lessThanEqual(x, vec3(0.0031308))));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) * scale;
  vec3 sum = vec3(0.0);
  for (int j = 0; j < scale; j++) {
    for (int i = 0; i < scale; i++) {
      ivec2 texel = at + ivec2(i, j);
      vec3 x = display(texelFetch(first, texel, 0).xyz);
      if (mode == 1 && gl_FragCoord.x > bar) x = display(texelFetch(second, texel, 0).xyz);
      if (mode == 2) x = min(abs(x - display(texelFetch(second, texel, 0).xyz)) * gain, 1.0);
      sum += x;
    }
  }
  colour = vec4(sum / float(scale * scale), 1.0);
  if (mode == 1 && abs(gl_FragCoord.x - bar) < 1.0) colour = vec4(1.0);
}`;

class Renderer {
  constructor(gl, library, light_shader) {
    this.gl = gl;
    this.library = library;
    this.light_shader = light_shader;
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("this browser draws no floats (EXT_color_buffer_float)");
    // Lights add up in 32 bits where those blend, else in 16.
    this.sum_format = gl.getExtension("EXT_float_blend") ? gl.RGBA32F : gl.RGBA16F;
    this.tables = { ltc_matrix: this.table(LTC_TABLE.matrix), ltc_magnitude: this.table(LTC_TABLE.magnitude) };
    this.programs = new Map();
    this.meshes = new Map();
    this.targets = new Map();
  }

  // A table of half floats, four an entry, as base64.
  table(text) {
    const gl = this.gl, bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), size = LTC_TABLE.size, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16F, size, size);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, size, size, gl.RGBA, gl.HALF_FLOAT, new Uint16Array(bytes.buffer));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  }

  program(key, vertex, fragment) {
    if (this.programs.has(key)) return this.programs.get(key);
    const gl = this.gl, program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`${key}: ${gl.getShaderInfoLog(shader)}`);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`${key}: ${gl.getProgramInfoLog(program)}`);
    const places = new Map();
    const at = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name);
    };
    this.programs.set(key, { program, at });
    return this.programs.get(key);
  }

  // A program holds one method and one kind of light: what is not looked at is not compiled.
  light_program(method, kind) {
    return this.program(`${method} ${kind}`, FULL_SCREEN,
      `#version 300 es\nprecision highp float;\nprecision highp int;\n#define METHOD ${Object.keys(METHODS).indexOf(method)}\n` +
      `#define KIND ${KINDS.indexOf(kind)}\n${this.library}\n${this.light_shader}`);
  }

  mesh(name, make) {
    if (this.meshes.has(name)) return this.meshes.get(name);
    const gl = this.gl, { vertices, indices } = make(), array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    for (const i of [0, 1]) {
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 24, 12 * i);
    }
    gl.bindVertexArray(null);
    this.meshes.set(name, { array, count: indices.length });
    return this.meshes.get(name);
  }

  forget_mesh(name) {
    this.meshes.delete(name);
  }

  // A frame buffer of so many textures; made anew where its size has changed.
  target(name, width, height, formats, depth) {
    const known = this.targets.get(name), gl = this.gl;
    if (known && known.width === width && known.height === height) return known;
    if (known) {
      known.textures.forEach((t) => gl.deleteTexture(t));
      gl.deleteRenderbuffer(known.depth);
      gl.deleteFramebuffer(known.buffer);
    }
    const made = { width, height, buffer: gl.createFramebuffer(), textures: [], depth: null };
    gl.bindFramebuffer(gl.FRAMEBUFFER, made.buffer);
    formats.forEach((format, i) => {
      const texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0);
      made.textures.push(texture);
    });
    gl.drawBuffers(formats.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    if (depth) {
      made.depth = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, made.depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, made.depth);
    }
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error(`no frame buffer of ${width} x ${height} floats`);
    this.targets.set(name, made);
    return made;
  }

  bind(program, textures) {
    const gl = this.gl;
    gl.useProgram(program.program);
    Object.entries(textures).forEach(([name, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(program.at(name), unit);
    });
  }

  fill_gbuffer(scene, camera, width, height) {
    const gl = this.gl, f = gl.RGBA32F, g = this.target("gbuffer", width, height, [f, f, f, f, f], true);
    gl.bindFramebuffer(gl.FRAMEBUFFER, g.buffer);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.clearBufferfv(gl.COLOR, 4, [...SKY, 1]);
    gl.enable(gl.DEPTH_TEST);
    const p = this.program("surface", SURFACE_VERTEX, SURFACE_FRAGMENT);
    gl.useProgram(p.program);
    gl.uniformMatrix4fv(p.at("projection"), false, projection_of(camera, width / height));
    for (const thing of scene) {
      const mesh = this.mesh(thing.mesh, thing.make);
      gl.uniform3fv(p.at("albedo"), thing.albedo ?? [0, 0, 0]);
      gl.uniform3fv(p.at("checker"), thing.checker ?? thing.albedo ?? [0, 0, 0]);
      gl.uniform3fv(p.at("f0"), thing.f0 ?? [0, 0, 0]);
      gl.uniform3fv(p.at("emission"), thing.emission ?? [-1, -1, -1]);
      gl.uniform1f(p.at("roughness"), thing.roughness ?? 1);
      gl.bindVertexArray(mesh.array);
      gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    }
    gl.bindVertexArray(null);
    gl.disable(gl.DEPTH_TEST);
    return g;
  }

  // The sum of all lights by one method.
  light(name, g, lights, method, eye) {
    const gl = this.gl, sum = this.target(name, g.width, g.height, [this.sum_format], false);
    const [places, normals, albedos, mirrors, emitted] = g.textures;
    gl.bindFramebuffer(gl.FRAMEBUFFER, sum.buffer);
    gl.viewport(0, 0, g.width, g.height);
    this.bind(this.program("copy", FULL_SCREEN, COPY), { from: emitted });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    for (const light of lights) {
      const p = this.light_program(method, light.kind);
      this.bind(p, { places, normals, albedos, mirrors, ...this.tables });
      gl.uniform3fv(p.at("eye"), eye);
      gl.uniform3fv(p.at("radiance"), light.radiance);
      gl.uniform3fv(p.at("vertices"), light.vertices.flat());
      gl.uniform1i(p.at("vertex_count"), light.vertices.length);
      gl.uniform1f(p.at("radius"), light.radius ?? 0);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    gl.disable(gl.BLEND);
    return sum;
  }

  show(first, second, { mode, scale, exposure, gain, bar, width, height }, target = null) {
    const gl = this.gl, p = this.program("show", FULL_SCREEN, SHOW);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(0, 0, width, height);
    this.bind(p, { first: first.textures[0], second: second.textures[0] });
    gl.uniform1i(p.at("mode"), mode);
    gl.uniform1i(p.at("scale"), scale);
    gl.uniform1f(p.at("exposure"), exposure);
    gl.uniform1f(p.at("gain"), gain);
    gl.uniform1f(p.at("bar"), bar * width);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  read(target, i = 0) {
    const gl = this.gl, pixels = new Float32Array(4 * target.width * target.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.buffer);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + i);
    gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, pixels);
    return pixels;
  }
}
