// Contribution of a part of a round light to a pixel: the angle between two rays, weighted by the range window. For *_pack.cpp only.
//
// A ray is given by the signed distance x at which it passes the centre. Shares are not yet divided by 2 pi.
#pragma once

#include "core/pack.h"
#include "core/pack_bits.h"
#include "plane/frame/events/events.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

using PackMask = Mask<Pack>;

// A light without a range: the share is the angle itself.
struct DiskAngle {
  const EventLight& light;
  explicit DiskAngle(const EventLight& l) : light(l) {}

  struct Seen {
    PackReal d2, reach;
    STERADIAN_INLINE PackReal slope(PackReal x) const { return PackKernels().plane_disk_slope(x, d2); }
    STERADIAN_INLINE PackReal between(PackReal from, PackReal to) const {
      const PackReal a = slope(from), b = slope(to);
      return PackKernels().trig_atan2_unwrapped(b - a, PackReal(1.0) + a * b);
    }
    STERADIAN_INLINE bool is_whole(PackReal, PackReal) const { return false; }
    STERADIAN_INLINE PackReal whole() const { return PackReal(0.0); }
  };
  STERADIAN_INLINE Seen at(int, PackReal px, PackReal py) const {
    const PackReal x = broadcast(light.x) - px, y = broadcast(light.y) - py, d2 = x * x + y * y, r = broadcast(light.radius);
    return {d2, select(d2 > r * r, r, PackReal(0.0))};
  }
};

// A light with a range, by the kernels' closed form.
struct DiskWindow {
  const EventLight& light;
  PackReal range;
  explicit DiskWindow(const EventLight& l) : light(l), range(broadcast(1 / l.inverse_range)) {}

  struct Seen {
    PackReal reach;              // in the scene's units, like all x
    PackReal d2, radius, scale;  // R = 1
    STERADIAN_INLINE PackReal share(PackReal x) const {
      x *= scale;
      return PackKernels().plane_disk_window(PackKernels().plane_disk_slope(x, d2), d2, radius * radius);
    }
    STERADIAN_INLINE PackReal between(PackReal from, PackReal to) const { return share(to) - share(from); }
    STERADIAN_INLINE bool is_whole(PackReal low, PackReal high) const {
      return all_lanes((high - low) * scale >= PackReal(1.999999) * radius);
    }
    STERADIAN_INLINE PackReal whole() const {
      const PackReal rho2 = radius * radius;
      return PackKernels().plane_disk_window_whole(radius * inversesqrt(max(d2 - rho2, PackReal(1e-12))), d2, rho2);
    }
  };
  STERADIAN_INLINE Seen at(int, PackReal px, PackReal py) const {
    const PackReal scale = broadcast(light.inverse_range), radius = broadcast(light.radius) * scale;
    const PackReal x = (broadcast(light.x) - px) * scale, y = (broadcast(light.y) - py) * scale, d2 = x * x + y * y;
    return {PackKernels().plane_disk_reach(d2, radius) * range, d2, radius, scale};
  }
};

// Far from the light the share has a closed form in w, the squared distance, and y = x / radius, with R = 1:
//
//   x (s0 + x^2 s1 + x^4 s2 + x^6 s3) + radius^2 y (e h1(y^2) - 2 radius^2 h2(y^2)),   e = 2 - 2 w - radius^2.
//
// It expands the window's integral in x / d. s0 and s1 are quadratics in w about a block's centre, the others constants of it.
// y h1(y^2) fits asin y + y sqrt(1 - y^2) to 5.1e-4, y h2(y^2) fits y (1 - y^2)^(3/2). Beyond 6 radii and 16 blocks it is within 5e-6.
struct DiskQuadratics {
  std::uint32_t blocks = 0;  // blocks that lie far enough

  explicit STERADIAN_INLINE DiskQuadratics(const EventLight& l, const PackReal* block_x, const PackReal* block_y)
      : light_(l), range_(broadcast(1 / l.inverse_range)), inverse_rho_(broadcast(1 / (l.radius * l.inverse_range))) {
    const PackReal scale = broadcast(l.inverse_range), rho = broadcast(l.radius) * scale, rho2 = rho * rho, one(1.0);
    const PackReal least = max(PackReal(6.0) * broadcast(l.radius), PackReal(16.0) * broadcast(l.block)) * scale;
    const PackReal a0 = (one - rho2) * (one - rho2), b0 = PackReal(6.0) * rho2 - PackReal(2.0);
    const PackReal b1 = one - rho2 * PackReal(5.0 / 3.0), b2 = PackReal(0.25) - PackReal(0.35) * rho2,
                   b3 = PackReal(0.125) - PackReal(0.1607) * rho2;
    for (int g = 0; g < 16; g += static_cast<int>(kLanes)) {
      const std::size_t group = static_cast<std::size_t>(g) / kLanes;
      const PackReal x = block_x[group] * scale, y = block_y[group] * scale;
      const PackReal w = max(x * x + y * y, PackReal(1e-12)), u = inversesqrt(w), v = u * u;  // v = 1 / w
      blocks |= bits_of(w > least * least) << g;
      const PackReal wu = w * u, uv = u * v, uvv = uv * v;
      const PackReal s00 = a0 * u + wu * (b0 + w), s01 = u * (PackReal(0.5) * b0 + PackReal(1.5) * w) - PackReal(0.5) * a0 * uv,
                     s02 = PackReal(0.375) * a0 * uvv - PackReal(0.125) * b0 * uv + PackReal(0.375) * u;
      const PackReal s10 = a0 * PackReal(1.0 / 6.0) * uv + b1 * u - PackReal(2.5) * wu,
                     s11 = -(PackReal(0.25) * a0 * uvv + PackReal(0.5) * b1 * uv + PackReal(1.25) * u),
                     s12 = PackReal(5.0 / 16.0) * a0 * uvv * v + PackReal(0.375) * b1 * uvv + PackReal(5.0 / 16.0) * uv;
      const PackReal s2 = PackReal(0.075) * a0 * uvv + b2 * uv + PackReal(0.875) * u;
      const PackReal s3 = PackReal(15.0 / 336.0) * a0 * uvv * v + b3 * uvv + PackReal(0.1875) * uv;
      const PackReal e = PackReal(2.0) - PackReal(2.0) * w - rho2;
      store(w_ + g, w);
      store(s_[0] + g, s00), store(s_[1] + g, s01), store(s_[2] + g, s02);
      store(s_[3] + g, s10), store(s_[4] + g, s11), store(s_[5] + g, s12);
      store(s_[6] + g, s2), store(s_[7] + g, s3);
      store(f_[0] + g, PackReal(2.0) * (rho * (s00 + rho2 * (s10 + rho2 * (s2 + rho2 * s3))) + PackReal(1.5707963267948966) * rho2 * e));
      store(f_[1] + g, PackReal(2.0) * (rho * (s01 + rho2 * s11) - PackReal(3.1415926535897932) * rho2));
      store(f_[2] + g, PackReal(2.0) * (rho * (s02 + rho2 * s12)));
    }
  }

  struct Seen {
    PackReal reach, dw, scale, inverse_rho, rho2, e;
    const DiskQuadratics& of;
    int block;
    STERADIAN_INLINE PackReal number(const float* column) const { return broadcast(column[block]); }
    STERADIAN_INLINE PackReal quadratic(const float (*s)[16]) const { return number(s[0]) + dw * (number(s[1]) + dw * number(s[2])); }
    STERADIAN_INLINE PackReal share(PackReal x, PackReal s0, PackReal s1) const {
      x *= scale;
      const PackReal y = x * inverse_rho, x2 = x * x, y2 = y * y;
      const PackReal h1 =
          PackReal(1.99503785) +
          y2 * (PackReal(-0.256803777) + y2 * (PackReal(-0.370334077) + y2 * (PackReal(0.485533376) - PackReal(0.282124238) * y2)));
      const PackReal h2 = PackReal(1.03550204) + y2 * (PackReal(-1.71832842) + PackReal(0.677070776) * y2);
      return x * (s0 + x2 * (s1 + x2 * (number(of.s_[6]) + x2 * number(of.s_[7])))) + rho2 * y * (e * h1 - PackReal(2.0) * rho2 * h2);
    }
    STERADIAN_INLINE PackReal between(PackReal from, PackReal to) const {
      const PackReal s0 = quadratic(of.s_), s1 = quadratic(of.s_ + 3);
      return share(to, s0, s1) - share(from, s0, s1);
    }
    STERADIAN_INLINE bool is_whole(PackReal low, PackReal high) const {
      return all_lanes(high - low >= PackReal(1.999999) * broadcast(of.light_.radius));
    }
    STERADIAN_INLINE PackReal whole() const { return quadratic(of.f_); }
  };
  STERADIAN_INLINE Seen at(int block, PackReal px, PackReal py) const {
    const PackReal scale = broadcast(light_.inverse_range), rho = broadcast(light_.radius) * scale, rho2 = rho * rho;
    const PackReal x = (broadcast(light_.x) - px) * scale, y = (broadcast(light_.y) - py) * scale, w = x * x + y * y;
    return {PackKernels().plane_disk_reach(w, rho) * range_,
            w - broadcast(w_[block]),
            scale,
            inverse_rho_,
            rho2,
            PackReal(2.0) - PackReal(2.0) * w - rho2,
            *this,
            block};
  }

 private:
  const EventLight& light_;
  PackReal range_, inverse_rho_;
  alignas(64) float w_[16], s_[8][16], f_[3][16];
};

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
