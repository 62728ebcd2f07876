// The light that arrives past triangles, by rays alone: the reference of the shadow tests.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "shadow/edges/segments.h"
#include "shadow/region/light_frame.h"
#include "shadow/region/visible.h"

namespace steradian::shadow {

// Integrals of `kCount` functions of the direction (unit, in the shading frame) over the visible part of a light.
//
// Cells over the light are refined where rays to one of their corners or of their neighbours' corners disagree. In the last cells the
// border is a straight line between positions found by bisection on their sides. Its error is 1e-7 of the light where edges are long.
// Parts thinner than a first cell may be missed.
template <std::size_t kCount, class Functions>
class RaysIntegral {
 public:
  using Values = std::array<double, kCount>;

  RaysIntegral(const LightFrame& frame, const Viewpoint& at, const Blockers& blockers, const Frame& shading, Functions functions)
      : frame_(frame), at_(at), blockers_(blockers), shading_(shading), functions_(functions), height_(-frame.to_local(at.position).z) {}

  // cells: number of first cells per side, each halved up to `levels` times.
  Values run(long cells, int levels) {
    const long step = 1L << levels;
    nodes_ = cells * step;
    Values sum{};
    for (long i = 0; i < cells; ++i)
      for (long j = 0; j < cells; ++j) add(sum, cell(i * step, j * step, step, levels));
    return sum;
  }

 private:
  struct Hash {
    std::size_t operator()(const std::pair<long, long>& p) const { return static_cast<std::size_t>(p.first * 7919000003L + p.second); }
  };

  static void add(Values& sum, const Values& v, double weight = 1) {
    for (std::size_t i = 0; i < kCount; ++i) sum[i] += weight * v[i];
  }

  bool on_light(double x, double y) const {
    bool inside = false;
    for (const auto& c : frame_.contours)
      for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
        if ((c[i].y > y) != (c[j].y > y) && x < (c[j].x - c[i].x) * (y - c[i].y) / (c[j].y - c[i].y) + c[i].x) inside = !inside;
    return inside;
  }
  bool sees(double x, double y) const {
    if (!on_light(x, y)) return false;
    const Vec3d to = frame_.to_world({x, y, 0}) - at_.position;
    if (dot(to, at_.normal) < 0 || (at_.geometric_normal && dot(to, *at_.geometric_normal) < 0)) return false;
    return !blockers_.between(at_.position, at_.position + to * ((height_ - frame_.eta) / height_));
  }
  // The factors keep nodes off the light's sides at ratios that no test scene has.
  double x_of(double i) const { return (2 * i / static_cast<double>(nodes_) - 1) * frame_.box_x * 1.00371; }
  double y_of(double j) const { return (2 * j / static_cast<double>(nodes_) - 1) * frame_.box_y * 1.00283; }

  bool node(long i, long j) {
    const auto [place, is_new] = seen_.try_emplace({i, j}, false);
    if (is_new) place->second = sees(x_of(static_cast<double>(i)), y_of(static_cast<double>(j)));
    return place->second;
  }
  Values density(double x, double y) const {
    const Vec3d to = frame_.to_world({x, y, 0}) - at_.position;
    const double d2 = dot(to, to), d = std::sqrt(d2);
    Values v = functions_(shading_.to_local(to / d));
    for (double& f : v) f *= height_ / (d2 * d);
    return v;
  }

  bool neighbours_agree(long i, long j, long s, bool with) {
    for (long u = -1; u <= 2; ++u)
      for (long w = -1; w <= 2; ++w) {
        const long a = i + u * s, b = j + w * s;
        if (a < 0 || b < 0 || a > nodes_ || b > nodes_) continue;
        if (node(a, b) != with) return false;
      }
    return true;
  }

  Values cell(long i, long j, long s, int levels) {
    const bool corners[4] = {node(i, j), node(i + s, j), node(i + s, j + s), node(i, j + s)};
    const bool same = corners[0] == corners[1] && corners[1] == corners[2] && corners[2] == corners[3];
    const double x0 = x_of(static_cast<double>(i)), x1 = x_of(static_cast<double>(i + s));
    const double y0 = y_of(static_cast<double>(j)), y1 = y_of(static_cast<double>(j + s));
    const double area = (x1 - x0) * (y1 - y0);
    Values sum{};
    if (same && (levels == 0 || neighbours_agree(i, j, s, corners[0]))) {
      if (!corners[0]) return sum;
      for (const double u : {0.21132486540518712, 0.78867513459481288})
        for (const double w : {0.21132486540518712, 0.78867513459481288})
          add(sum, density(x0 + u * (x1 - x0), y0 + w * (y1 - y0)), 0.25 * area);
      return sum;
    }
    if (levels > 0) {
      const long h = s / 2;
      for (const auto& [a, b] : {std::pair{i, j}, std::pair{i + h, j}, std::pair{i, j + h}, std::pair{i + h, j + h}})
        add(sum, cell(a, b, h, levels - 1));
      return sum;
    }
    return last_cell({x0, x1, x1, x0}, {y0, y0, y1, y1}, corners, area);
  }

  // The visible polygon of a cell that one line cuts; a fraction by corners if more than one line cuts it.
  Values last_cell(const std::array<double, 4>& x, const std::array<double, 4>& y, const bool corners[4], double area) {
    std::array<std::pair<double, double>, 8> polygon;
    std::size_t count = 0;
    int changes = 0, seen = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      const std::size_t b = (a + 1) % 4;
      seen += corners[a];
      if (corners[a]) polygon[count++] = {x[a], y[a]};
      if (corners[a] == corners[b]) continue;
      ++changes;
      double low = 0, high = 1;
      for (int k = 0; k < 18; ++k) {
        const double t = 0.5 * (low + high);
        (sees(x[a] + t * (x[b] - x[a]), y[a] + t * (y[b] - y[a])) == corners[a] ? low : high) = t;
      }
      polygon[count++] = {x[a] + low * (x[b] - x[a]), y[a] + low * (y[b] - y[a])};
    }
    Values sum{};
    if (changes != 2) {
      add(sum, density(0.5 * (x[0] + x[2]), 0.5 * (y[0] + y[2])), 0.25 * seen * area);
      return sum;
    }
    double twice = 0, cx = 0, cy = 0;
    for (std::size_t a = 0; a < count; ++a) {
      const auto [px, py] = polygon[a];
      const auto [qx, qy] = polygon[(a + 1) % count];
      twice += (px - x[0]) * (qy - y[0]) - (qx - x[0]) * (py - y[0]);
      cx += px / static_cast<double>(count);
      cy += py / static_cast<double>(count);
    }
    add(sum, density(cx, cy), 0.5 * std::fabs(twice));
    return sum;
  }

  const LightFrame frame_;
  const Viewpoint at_;
  const Blockers& blockers_;
  const Frame shading_;
  const Functions functions_;
  const double height_;
  long nodes_ = 0;
  std::unordered_map<std::pair<long, long>, bool, Hash> seen_;
};

}  // namespace steradian::shadow
