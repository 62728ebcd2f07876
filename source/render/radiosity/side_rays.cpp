#include "render/radiosity/side_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lattices.h"
#include "core/random.h"

namespace steradian::radiosity {

// A lattice of the disc, lifted to the hemisphere.
SideRays::SideRays(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto [square, v] = fibonacci_place(i, count, 0);
    const double r = std::sqrt(square), phi = 2 * std::numbers::pi * v;
    directions_.push_back({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - square)});
  }
  // A curve through the disc: the bits of its two coordinates in turn.
  const auto along_curve = [](Vec3d d) {
    const auto x = static_cast<unsigned>((d.x + 1) * 127), y = static_cast<unsigned>((d.y + 1) * 127);
    unsigned place = 0;
    for (unsigned bit = 0; bit < 8; ++bit) place |= (x >> bit & 1) << 2 * bit | (y >> bit & 1) << (2 * bit + 1);
    return place;
  };
  std::sort(directions_.begin(), directions_.end(), [&](Vec3d a, Vec3d b) { return along_curve(a) < along_curve(b); });
}

Frame SideRays::frame(const Surface& surface, std::size_t side) {
  reference::Random random(side);
  const double angle = 2 * std::numbers::pi * random.uniform();
  Frame frame = Frame::from_normal(normalized(static_cast<Vec3d>(surface.geometric_normal)));
  const Vec3d x = frame.x, y = frame.y;
  frame.x = x * std::cos(angle) + y * std::sin(angle);
  frame.y = y * std::cos(angle) - x * std::sin(angle);
  return frame;
}

}  // namespace steradian::radiosity
