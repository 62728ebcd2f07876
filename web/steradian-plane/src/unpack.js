// LZMA, unpacked: the module is a quarter smaller by it than zipped, which is what browsers unpack by themselves.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
//
// A stream without header, of 3 bits of literal context and none of position, as make_package.py packs it. The decoder of LZMA is a state machine
// whose every decision is a bit of an arithmetic code with a probability of its own, of 11 bits, which moves a 32nd of the way at each bit.

const STATES = 12;

const probabilities = (count) => new Uint16Array(count).fill(1024);

/** What `size` bytes were packed into. */
export function unpack(packed, size) {
  const s = new Uint32Array([0xffffffff, 0]); // range and code: in variables they would be boxed
  let at = 1; // the first byte is 0
  for (; at < 5; ++at) s[1] = (s[1] << 8) | packed[at];

  function normalize() {
    if (s[0] >= 0x1000000) return;
    s[0] <<= 8;
    s[1] = (s[1] << 8) | packed[at++];
  }
  function bit(p, i) {
    const bound = (s[0] >>> 11) * p[i];
    if (s[1] < bound) {
      s[0] = bound;
      p[i] += (2048 - p[i]) >>> 5;
      normalize();
      return 0;
    }
    s[0] -= bound;
    s[1] -= bound;
    p[i] -= p[i] >>> 5;
    normalize();
    return 1;
  }
  function evenBits(count) {
    let value = 0;
    while (count--) {
      s[0] >>>= 1;
      const one = s[1] >= s[0] ? 1 : 0;
      if (one) s[1] -= s[0];
      normalize();
      value = 2 * value + one;
    }
    return value;
  }
  // A number of so many bits, the highest first; each prefix has its probability, from p[from + 1] on.
  function number(p, from, bits) {
    let m = 1;
    for (let i = 0; i < bits; ++i) m = 2 * m + bit(p, from + m);
    return m - (1 << bits);
  }
  function reversed(p, from, bits) {
    let m = 1, value = 0;
    for (let i = 0; i < bits; ++i) {
      const b = bit(p, from + m);
      m = 2 * m + b;
      value |= b << i;
    }
    return value;
  }
  const lengths = () => ({ choice: probabilities(2), low: probabilities(8), middle: probabilities(8), high: probabilities(256) });
  function length(l) {
    if (!bit(l.choice, 0)) return 2 + number(l.low, 0, 3);
    if (!bit(l.choice, 1)) return 10 + number(l.middle, 0, 3);
    return 18 + number(l.high, 0, 8);
  }

  const isMatch = probabilities(STATES), isRepeat = probabilities(STATES), isLater = probabilities(STATES), isThird = probabilities(STATES),
    isFourth = probabilities(STATES), isLong = probabilities(STATES);
  const literals = probabilities(8 * 768), slots = probabilities(4 * 64), near = probabilities(128), low = probabilities(16);
  const ofMatch = lengths(), ofRepeat = lengths();
  const out = new Uint8Array(size), last = [0, 0, 0, 0]; // the last four distances, less 1
  let end = 0, state = 0;
  while (end < size) {
    if (!bit(isMatch, state)) {
      const context = end ? 768 * (out[end - 1] >>> 5) : 0;
      let m = 1;
      if (state >= 7)
        // After a match the byte is not the one that would go on with it: that byte's bits say where to look, up to the first that differs.
        for (let other = out[end - last[0] - 1], one; m < 256; ) {
          one = (other >>> 7) & 1;
          other <<= 1;
          const b = bit(literals, context + ((1 + one) << 8) + m);
          m = 2 * m + b;
          if (b !== one) break;
        }
      while (m < 256) m = 2 * m + bit(literals, context + m);
      out[end++] = m;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let count;
    if (!bit(isRepeat, state)) {
      last.pop();
      count = length(ofMatch);
      state = state < 7 ? 7 : 10;
      const slot = number(slots, 64 * Math.min(count - 2, 3), 6);
      let distance = slot;
      if (slot > 3) {
        const bits = (slot >>> 1) - 1;
        distance = (2 | (slot & 1)) * 2 ** bits;
        distance += slot < 14 ? reversed(near, distance - slot, bits) : 16 * evenBits(bits - 4) + reversed(low, 0, 4);
      }
      last.unshift(distance);
    } else {
      let which = 0;
      if (bit(isLater, state)) which = bit(isThird, state) ? 2 + bit(isFourth, state) : 1;
      else if (!bit(isLong, state)) {
        out[end] = out[end - last[0] - 1];
        ++end;
        state = state < 7 ? 9 : 11;
        continue;
      }
      last.unshift(...last.splice(which, 1));
      count = length(ofRepeat);
      state = state < 7 ? 8 : 11;
    }
    for (const to = Math.min(end + count, size), from = last[0] + 1; end < to; ++end) out[end] = out[end - from];
  }
  return out;
}
