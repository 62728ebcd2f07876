// Pairs and vertices as the words and numbers that shaders read.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "plane/frame/events/events.h"
#include "steradian/vector2.h"

namespace steradian::plane {

// A float and its remainder.
struct Split {
  float most, rest;
  explicit Split(double x) : most(static_cast<float>(x)), rest(static_cast<float>(x - static_cast<double>(most))) {}
};

inline void put_vertex(std::vector<float>& to, Vec2d v) {
  const Split x(v.x), y(v.y);
  to.insert(to.end(), {x.most, x.rest, y.most, y.rest});
}

// Writes kPair words (shaders/plane/plane_layout.glsl).
inline void put_pair(std::uint32_t* to, const EventPair& pair) {
  const auto bytes = [](unsigned a, unsigned b, unsigned c, unsigned d) -> std::uint32_t { return a | b << 8 | c << 16 | d << 24; };
  for (const auto& line : pair.lines)
    for (float number : line) *to++ = std::bit_cast<std::uint32_t>(number);
  *to++ = std::bit_cast<std::uint32_t>(pair.radius);
  *to++ = static_cast<std::uint32_t>(pair.first);
  *to++ = bytes(pair.kind == EventPair::Kind::round ? 1 : 0, pair.count, 0, 0);
  *to++ = bytes(pair.end_first, pair.ends, pair.begin_first, pair.begins);
}

}  // namespace steradian::plane
