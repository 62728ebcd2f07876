#include "plane/frame/tiles/filling.h"

#include <algorithm>
#include <cmath>

#include "plane/exact/on_curve.h"

namespace steradian::plane {

Filling::Filling(const FrameScene& frame, const PixelGrid& grid) : frame_(frame), world_(*frame.world), grid_(grid) {
  std::fill(std::begin(inside_), std::end(inside_), kOutside);
}

void Filling::find(const std::vector<int>& bodies, int x0, int y0, const TileRectangle& tile) {
  for (int i : marked_) inside_[i] = kOutside;
  marked_.clear();
  on_own_outline_.reset();
  tile_ = tile;
  interior_body_ = -1;
  x0_ = x0;
  y0_ = y0;
  columns_ = std::min(kTileSide, grid_.width - x0);
  rows_ = std::min(kTileSide, grid_.height - y0);
  int dark = 0;
  for (int index : bodies) {
    if (dark == columns_ * rows_) return;
    const PlaneBody& body = world_.scene.bodies[static_cast<std::size_t>(index)];
    const Box2d& box = world_.boxes[static_cast<std::size_t>(index)];
    const Vec2d first = grid_.at(x0, y0);
    const auto low = [](double at, double origin, double step) {
      return static_cast<int>(std::ceil(std::clamp((at - origin) / step - 1e-9, 0.0, 1.0 * kTileSide)));
    };
    const auto high = [](double at, double origin, double step, int count) {
      return static_cast<int>(std::floor(std::min((at - origin) / step + 1e-9, count - 1.0)));
    };
    const int x0_box = low(box.low.x, first.x, grid_.step.x), x1_box = high(box.high.x, first.x, grid_.step.x, columns_);
    for (int y = low(box.low.y, first.y, grid_.step.y); y <= high(box.high.y, first.y, grid_.step.y, rows_); ++y) {
      const auto within = [&](int x) { return world_.contains(static_cast<std::size_t>(index), grid_.at(x0 + x, y0 + y)); };
      const auto mark = [&](int x) {
        int& inside = inside_[y * kTileSide + x];
        if (inside == kOutside) marked_.push_back(y * kTileSide + x);
        if (inside == kDark) return;
        inside = body.light ? index : kDark;
        dark += inside == kDark ? 1 : 0;
      };
      int begin = x0_box, end = x1_box;
      if (frame_.convex[static_cast<std::size_t>(index)] != 0) {
        guess_row(body, grid_.at(x0, y0 + y).y, first.x, begin, end);
        while (begin <= end && !within(begin)) ++begin;
        while (end > begin && !within(end)) --end;
        for (int x = begin; x <= end; ++x) mark(x);
      } else {
        for (int x = begin; x <= end; ++x)
          if (within(x)) mark(x);
      }
    }
  }
  if (!frame_.light_at) return;
  for (int index : bodies) find_on_outlines(static_cast<std::size_t>(index));
}

// Finds pixels within a hair's breadth of a curve.
void Filling::find_on_outlines(std::size_t body) {
  constexpr double kHair = 1e-4;  // fraction of the picture, whose larger side is 1024 to 2048
  const Vec2d first = grid_.at(x0_, y0_);
  for (std::size_t c = world_.first_curve[body]; c < world_.first_curve[body + 1]; ++c) {
    const Curve& curve = world_.curves[c];
    if (curve.kind == Curve::Kind::arc) {
      // A bound of the change of |unit|^2 over that breadth.
      const PlaneEllipse& e = curve.ellipse;
      const double steepest = std::sqrt(dot(e.x, e.x) + dot(e.y, e.y)) / std::fabs(cross(e.x, e.y)), h = kHair * steepest;
      for (int i = 0; i < columns_ * rows_; ++i) {
        const Vec2d p = grid_.at(x0_ + i % columns_, y0_ + i / columns_), unit = e.to_unit(p);
        if (std::fabs(dot(unit, unit) - 1) <= h * (2 + h) && distance_to(curve, p) <= kHair)
          mark_on_outline(body, i % columns_, i / columns_);
      }
      continue;
    }
    const Vec2d a = curve.a - first, b = curve.b - first, along = curve.b - curve.a;
    // Steps along its steeper direction, pixel by pixel, and marks the pixel next to the crossing.
    const bool rows = std::fabs(along.y) * grid_.step.x > std::fabs(along.x) * grid_.step.y;
    const auto walk = [&](double from, double to, double step, int count, double across_from, double across_along, double across_step,
                          int across_count, auto mark) {
      if (from == to) return;
      const double low = std::min(from, to) - kHair, high = std::max(from, to) + kHair;
      const int begin = static_cast<int>(std::ceil(std::clamp(low / step, 0.0, 1.0 * kTileSide))),
                end = static_cast<int>(std::floor(std::min(high / step, count - 1.0)));
      for (int i = begin; i <= end; ++i) {
        const double across = across_from + (i * step - from) * across_along, near = std::round(across / across_step);
        if (near >= 0 && near < across_count && std::fabs(across - near * across_step) <= kHair) mark(i, static_cast<int>(near));
      }
    };
    if (rows)
      walk(a.y, b.y, grid_.step.y, rows_, a.x, along.x / along.y, grid_.step.x, columns_,
           [&](int y, int x) { mark_on_outline(body, x, y); });
    else
      walk(a.x, b.x, grid_.step.x, columns_, a.y, along.y / along.x, grid_.step.y, rows_,
           [&](int x, int y) { mark_on_outline(body, x, y); });
  }
}

// Narrows a row of a convex polygon to one pixel beyond the crossings with its edges: the exact test decides the rest.
void Filling::guess_row(const PlaneBody& body, double y, double first, int& begin, int& end) const {
  if (body.shape != PlaneBody::Shape::polygon) return;
  const std::vector<Vec2d>& contour = body.contours[0];
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2d a = contour[i], b = contour[i + 1 < contour.size() ? i + 1 : 0];
    if ((a.y < y && b.y < y) || (a.y > y && b.y > y)) continue;
    const double t = a.y == b.y ? 0 : (y - a.y) / (b.y - a.y), x = a.x + t * (b.x - a.x);
    low = std::min({low, x, a.y == b.y ? b.x : x});
    high = std::max({high, x, a.y == b.y ? b.x : x});
  }
  if (low > high) return;
  begin = std::max(begin, static_cast<int>(std::ceil(std::max(low - first, -1e6) / grid_.step.x - 1e-6)));
  end = std::min(end, static_cast<int>(std::floor(std::min(high - first, 1e6) / grid_.step.x + 1e-6)));
}

void Filling::draw(Picture& picture) {
  for (int i : marked_) {
    const int x = x0_ + i % kTileSide, y = y0_ + i / kTileSide, inside = inside_[i];
    const Vec2d p = grid_.at(x, y);
    Vec3d light;
    if (inside == kOnOutline)
      light = frame_.light_at(p);
    else if (inside != kDark)
      light = interior(static_cast<std::size_t>(inside),
                       on_own_outline_[static_cast<std::size_t>(i)] ? world_.off_outlines(world_.around(p)).at : p);
    picture.at(x, y) = static_cast<Vec3f>(light);
  }
}

std::uint32_t Filling::open_blocks() const {
  int filled[16] = {};
  for (int i : marked_) ++filled[i / kTileSide / 4 * 4 + i % kTileSide / 4];
  std::uint32_t open = 0;
  for (int b = 0; b < 16; ++b) open |= std::uint32_t{filled[b] < 16} << b;
  return open;
}

std::bitset<kTilePixels> Filling::pixels() const {
  std::bitset<kTilePixels> filled;
  for (int i : marked_) filled.set(static_cast<std::size_t>(i));
  return filled;
}

Vec3d Filling::interior(std::size_t body, Vec2d p) {
  if (!frame_.shines_within) return {};
  const LightInterior& inside = frame_.interior[body];
  if (inside.curves.empty()) return radiance_at(*world_.scene.bodies[body].light, p);
  if (inside.by_chords) return radiance_at(*world_.scene.bodies[body].light, p) * open_share(inside.chords, p);
  if (inside.by_parts) return light_between(world_, inside.parts, p, static_cast<int>(body));
  if (inside.in_polygon) return interior_of_polygon(inside, body, p);
  if (static_cast<int>(body) != interior_body_) {
    interior_body_ = static_cast<int>(body);
    interior_curves_ = curves_that_matter_within(inside.curves, inside.own, tile_.center, tile_.radius);
  }
  const std::size_t own = interior_curves_.size() - (inside.curves.size() - inside.own);
  return envelope_light(world_, curves_that_matter_within(interior_curves_, own, p, 0), p, static_cast<int>(body), EmissionParts::radiance)
      .radiance;
}

Vec3d Filling::interior_of_polygon(const LightInterior& inside, std::size_t body, Vec2d p) {
  if (static_cast<int>(body) != interior_body_) {
    interior_body_ = static_cast<int>(body);
    seen_within_ = seen_within(inside, tile_.center, tile_.radius);
  }
  const auto own = [&] { return radiance_at(*world_.scene.bodies[body].light, p); };
  if (seen_within_.curves.empty()) return own();
  keep_seen_from(seen_within_, p, seen_from_);
  if (seen_from_.curves.size() == seen_from_.own) return own();
  // Dark and not occluded from the point: the directions that they occlude need no depth.
  const auto is_dark = [&](const Curve* c) {
    return c->kind == Curve::Kind::segment && !world_.scene.bodies[static_cast<std::size_t>(c->body)].light;
  };
  if (seen_from_.own == 0 && std::all_of(seen_from_.curves.begin(), seen_from_.curves.end(), is_dark))
    return own() * open_share(seen_from_.curves, p);
  return envelope_light(world_, seen_from_.curves, p, static_cast<int>(body), EmissionParts::radiance).radiance;
}

}  // namespace steradian::plane
