#include "plane/exact/ray_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::plane {
namespace {

constexpr double kFar = 1e300;

Box2d box_of(const Curve& c) {
  Box2d box;
  box.add(c.a);
  box.add(c.b);
  if (c.kind == Curve::Kind::arc) {
    const Vec2d half{std::hypot(c.ellipse.x.x, c.ellipse.y.x), std::hypot(c.ellipse.x.y, c.ellipse.y.y)};
    box.add(c.ellipse.center - half);
    box.add(c.ellipse.center + half);
  }
  return box;
}

bool on_arc(const Curve& c, Vec2d hit) {
  if (c.tau_span >= 2 * std::numbers::pi - 1e-12) return true;
  double t = angle_of(c.ellipse.to_unit(hit)) - c.tau0;
  while (t < 0) t += 2 * std::numbers::pi;
  while (t >= 2 * std::numbers::pi) t -= 2 * std::numbers::pi;
  return t <= c.tau_span;
}

}  // namespace

RayHit hit_curve(const Curve& c, Vec2d from, Vec2d u, int inside) {
  const bool inner = c.two_sided || c.body == inside;
  if (c.kind == Curve::Kind::segment) {
    const Vec2d e = c.b - c.a, a = c.a - from;
    const double turn = cross(u, e);
    if (turn == 0) return {};
    const bool back = turn > 0;
    const double r = cross(a, e) / turn, t = cross(a, u) / turn;
    if (r <= 0 || t < 0 || t > 1) return {};
    if ((cross(c.a - from, c.b - from) > 0) && !inner) return {};
    return {&c, r, back};
  }
  const Vec2d p = c.ellipse.to_unit(from), v = c.ellipse.to_unit(c.ellipse.center + u);
  const double a = dot(v, v), b = dot(p, v), k = dot(p, p) - 1, det = b * b - a * k;
  if (det <= 0) return {};
  const double root = std::sqrt(det);
  if (k > 0 && b < 0) {
    const double r = k / (root - b);
    if (on_arc(c, from + u * r)) return {&c, r, false};
  }
  const double far = (root - b) / a;
  if (inner && far > 0 && on_arc(c, from + u * far)) return {&c, far, true};
  return {};
}

RayGrid::RayGrid(const std::vector<Curve>& curves, const std::vector<PlaneBody>& bodies) : bodies_(&bodies) {
  Box2d all;
  std::vector<Box2d> boxes;
  for (const Curve& c : curves) {
    boxes.push_back(box_of(c));
    all.add(boxes.back());
  }
  std::vector<Box2d> body_boxes;
  for (const PlaneBody& body : bodies) {
    body_boxes.push_back(bounds_of(body));
    all.add(body_boxes.back());
  }
  if (all.is_empty()) return;
  low_ = all.low;
  high_ = all.high;
  const Vec2d size = high_ - low_;
  const double larger = std::max(std::max(size.x, size.y), 1e-6);
  const double wanted = 2.0 * static_cast<double>(curves.size()) + 1;
  // A lower bound of the cell size: a thin scene must not need millions of cells.
  cell_ = std::max(std::sqrt(std::max(size.x, larger * 1e-3) * std::max(size.y, larger * 1e-3) / wanted), larger / 2000);
  // Curves and bodies that span many cells are entered in all of them. Cells become coarser until there are no more than a few entries
  // each.
  const auto lay_out = [&] {
    columns_ = static_cast<int>(size.x / cell_) + 1;
    rows_ = static_cast<int>(size.y / cell_) + 1;
    std::size_t entries = 0;
    for (const std::vector<Box2d>* some : {&boxes, &body_boxes})
      for (const Box2d& box : *some)
        if (!box.is_empty())
          entries += static_cast<std::size_t>(row(box.high.y) - row(box.low.y) + 1) *
                     static_cast<std::size_t>(column(box.high.x) - column(box.low.x) + 1);
    return entries;
  };
  while (lay_out() > 64 * (boxes.size() + body_boxes.size()) + 10'000 && columns_ * rows_ > 1) cell_ *= 2;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  cell_bodies_.resize(cells_.size());
  const auto cells_of = [&](const Box2d& box, auto&& put) {
    for (int y = row(box.low.y); y <= row(box.high.y); ++y)
      for (int x = column(box.low.x); x <= column(box.high.x); ++x)
        put(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x), x, y);
  };
  for (std::size_t i = 0; i < curves.size(); ++i)
    cells_of(boxes[i], [&](std::size_t cell, int x, int y) {
      const Curve& c = curves[i];
      if (c.kind == Curve::Kind::segment) {
        // Skip cells that the segment does not touch.
        const Vec2d middle{low_.x + (x + 0.5) * cell_, low_.y + (y + 0.5) * cell_}, e = c.b - c.a;
        const double reach = 0.5 * cell_ * (std::fabs(e.x) + std::fabs(e.y)) * (1 + 1e-9) + 1e-9 * larger * length(e);
        if (std::fabs(cross(e, middle - c.a)) > reach) return;
      }
      cells_[cell].push_back(&c);
    });
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!body_boxes[i].is_empty())
      cells_of(body_boxes[i], [&](std::size_t cell, int, int) { cell_bodies_[cell].push_back(static_cast<int>(i)); });
}

int RayGrid::column(double x) const { return std::clamp(static_cast<int>(std::floor((x - low_.x) / cell_)), 0, columns_ - 1); }
int RayGrid::row(double y) const { return std::clamp(static_cast<int>(std::floor((y - low_.y) / cell_)), 0, rows_ - 1); }

const std::vector<int>& RayGrid::bodies_near(Vec2d p) const {
  static const std::vector<int> none;
  if (columns_ == 0 || p.x < low_.x || p.y < low_.y || p.x > high_.x || p.y > high_.y) return none;
  return cell_bodies_[static_cast<std::size_t>(row(p.y)) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column(p.x))];
}

// Amanatides, Woo, "A fast voxel traversal algorithm for ray tracing", 1987.
RayHit RayGrid::first_hit(Vec2d from, Vec2d u, int inside) const {
  if (columns_ == 0) return {};
  double enter = 0, leave = kFar;
  const double o[2] = {from.x, from.y}, d[2] = {u.x, u.y};
  const double lo[2] = {low_.x, low_.y}, hi[2] = {high_.x, high_.y};
  for (int k = 0; k < 2; ++k) {
    if (d[k] == 0) {
      if (o[k] < lo[k] || o[k] > hi[k]) return {};
      continue;
    }
    const double t0 = (lo[k] - o[k]) / d[k], t1 = (hi[k] - o[k]) / d[k];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return {};
  int x = column(from.x + u.x * enter), y = row(from.y + u.y * enter);
  const auto first_wall = [&](double origin, double step, double low, int cell) {
    if (step == 0) return kFar;
    return (low + (cell + (step > 0 ? 1 : 0)) * cell_ - origin) / step;
  };
  double next_x = first_wall(o[0], d[0], lo[0], x), next_y = first_wall(o[1], d[1], lo[1], y);
  const double step_x = d[0] != 0 ? cell_ / std::fabs(d[0]) : kFar, step_y = d[1] != 0 ? cell_ / std::fabs(d[1]) : kFar;
  RayHit best;
  best.distance = kFar;
  while (x >= 0 && y >= 0 && x < columns_ && y < rows_) {
    for (const Curve* c : cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)]) {
      const RayHit hit = hit_curve(*c, from, u, inside);
      if (hit.curve == nullptr) continue;
      const double slack = 1e-10 * hit.distance;
      const auto shines = [&](const RayHit& h) { return (*bodies_)[static_cast<std::size_t>(h.curve->body)].light.has_value(); };
      if (hit.distance < best.distance - slack ||
          (hit.distance < best.distance + slack && shines(hit) && (!shines(best) || hit.curve->body > best.curve->body)))
        best = hit;
    }
    const double end = std::min(next_x, next_y);
    if (best.curve != nullptr && best.distance <= end) return best;
    if (next_x < next_y) {
      x += d[0] > 0 ? 1 : -1;
      next_x += step_x;
    } else {
      y += d[1] > 0 ? 1 : -1;
      next_y += step_y;
    }
  }
  return best.curve != nullptr ? best : RayHit{};
}

}  // namespace steradian::plane
