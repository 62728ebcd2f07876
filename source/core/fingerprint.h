// Fingerprint: a number that identifies bytes without a copy of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace steradian {

using Fingerprint = std::uint64_t;

// Fingerprint of the bytes; 0 for none. Other bytes have the same one by an accident of one in 2^64. It finds what has changed from picture
// to picture; it is no defence against an attacker. There are four lanes, since a multiplication takes longer than the next one has to
// wait.
//
// The constants are pi's and e's fractions in 64 bits, made odd: any odd numbers without a pattern serve. A word is mixed before it meets
// the others, so that no two small changes cancel each other.
inline Fingerprint fingerprint(const void* data, std::size_t bytes) {
  constexpr std::uint64_t kPi = 0x243f6a8885a308d3, kE = 0xb7e151628aed2a6b;
  const auto mixed = [](std::uint64_t word) {
    word *= kPi;
    word ^= word >> 32;
    return word * kE;
  };
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint64_t lanes[4] = {bytes, kPi, kE, kPi ^ kE};
  std::size_t left = bytes;
  for (; left >= sizeof lanes; left -= sizeof lanes, at += sizeof lanes) {
    std::uint64_t words[4];
    std::memcpy(words, at, sizeof words);
    for (int i = 0; i < 4; ++i) lanes[i] = std::rotl(lanes[i] ^ mixed(words[i]), 27) * kPi + kE;
  }
  if (bytes == 0) return 0;
  std::uint64_t rest[4] = {};
  if (left > 0) std::memcpy(rest, at, left);
  std::uint64_t all = 0;
  for (int i = 0; i < 4; ++i) all = mixed(std::rotl(all, 29) ^ std::rotl(lanes[i] ^ mixed(rest[i]), 27));
  return all ^ all >> 32;
}

template <class Value>
Fingerprint fingerprint(std::span<const Value> values) {
  return fingerprint(values.data(), values.size_bytes());
}

}  // namespace steradian
