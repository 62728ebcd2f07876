// The WebAssembly module, and calls of it with strings and numbers.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
import { lettersFor } from "./letters.js";
import { PLANE_SIZE, PLANE_WASM } from "./plane_wasm.js";
import { unpack } from "./unpack.js";

/** What is wrong with a scene or a call: where, what, and what to do about it. */
export class PlaneError extends Error {
  constructor(place, problem, hint) {
    super(`${place ? `${place}: ` : ""}${problem}${hint ? ` (${hint})` : ""}`);
    this.name = "PlaneError";
    this.place = place;
    this.problem = problem;
    this.hint = hint;
  }
}

let machine = null; // the promise of the one instance that all planes share

export function loadMachine() {
  machine ??= start().catch((e) => {
    machine = null;
    throw e;
  });
  return machine;
}

async function start() {
  const packed = Uint8Array.from(atob(PLANE_WASM), (c) => c.charCodeAt(0));
  let exports = null;
  // The library writes nothing and reads no file; of what it may ask for, only the clock is there.
  const system = { clock_time_get: (clock, precision, at) => writeTime(exports.memory, at), proc_exit: quit };
  const made = await WebAssembly.instantiate(unpack(packed, PLANE_SIZE), {
    env: {
      emscripten_notify_memory_growth: () => {},
      ...lettersFor(() => exports),
      number_of_text: (at, size) => Number(new TextDecoder().decode(new Uint8Array(exports.memory.buffer, at, size))),
      text_of_number: (x, digits, at) =>
        new TextEncoder().encodeInto(String(digits ? Number(x.toPrecision(digits)) : x), new Uint8Array(exports.memory.buffer, at, 32)).written,
    },
    wasi_snapshot_preview1: new Proxy(system, { get: (known, name) => known[name] ?? (() => 0) }),
  });
  exports = made.instance.exports;
  exports._initialize();
  return new Machine(exports);
}

function quit() {
  throw new PlaneError("plane", "the WebAssembly module has ended", "reload the page");
}

function writeTime(memory, at) {
  new DataView(memory.buffer).setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
  return 0;
}

class Machine {
  constructor(exports) {
    this.exports = exports;
  }

  /** Calls a function that answers null or -1 where it fails; strings and lists of numbers are copied in. */
  call(name, ...args) {
    const copies = [];
    try {
      const plain = args.map((a) => {
        if (typeof a === "number") return a;
        const at = typeof a === "string" ? this.copyText(a) : this.copyNumbers(a);
        copies.push(at);
        return at;
      });
      const found = this.exports[name](...plain);
      if (found === 0 && POINTERS.has(name)) throw this.problem();
      if (found === -1) throw this.problem();
      return found;
    } catch (e) {
      if (e instanceof PlaneError) throw e;
      throw new PlaneError("plane", e.message ?? String(e), "the scene may be too large for a page; reload it");
    } finally {
      for (const at of copies) this.exports.free(at);
    }
  }

  problem() {
    const [place, problem, ...hint] = this.text(this.exports.plane_problem()).split("\n");
    return new PlaneError(place, problem ?? "", hint.join(" "));
  }

  copyText(text) {
    const bytes = new TextEncoder().encode(text);
    const at = this.exports.malloc(bytes.length + 1);
    const memory = new Uint8Array(this.exports.memory.buffer, at, bytes.length + 1);
    memory.set(bytes);
    memory[bytes.length] = 0;
    return at;
  }

  copyNumbers(list) {
    const at = this.exports.malloc(8 * list.length);
    new Float64Array(this.exports.memory.buffer, at, list.length).set(list);
    return at;
  }

  text(at) {
    const memory = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(memory.subarray(at, memory.indexOf(0, at)));
  }

  /** Views: they end with the next call. */
  doubles(at, count) {
    return new Float64Array(this.exports.memory.buffer, at, count);
  }
  floats(at, count) {
    return new Float32Array(this.exports.memory.buffer, at, count);
  }
  words(at, count) {
    return new Uint32Array(this.exports.memory.buffer, at, count);
  }
}

// The functions whose null means that they failed.
const POINTERS = new Set(["plane_from_svg", "plane_empty", "plane_body", "plane_body_name", "plane_query", "plane_draw", "plane_gl_lists", "plane_light", "plane_svg"]);
