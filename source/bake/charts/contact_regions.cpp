#include "bake/charts/contact_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace steradian::bake {
namespace {

using PointKey = std::array<double, 2>;
PointKey key_of(Vec2d p) { return {p.x, p.y}; }

// Signed distance of a point from a line, positive on its left.
double left_of(Vec2d p, Vec2d from, Vec2d direction) { return cross(direction, p - from); }

Vec2d crossing(Vec2d a, Vec2d b, double da, double db) { return a + (b - a) * (da / (da - db)); }

Vec2d normalized_along(const std::array<Vec2d, 2>& line) { return (line[1] - line[0]) / length(line[1] - line[0]); }

// The part of a convex outline on the left (sign 1) or right (-1) of a line.
std::vector<Vec2d> half_of(const std::vector<Vec2d>& outline, Vec2d from, Vec2d direction, double sign) {
  std::vector<Vec2d> part;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2d a = outline[i], b = outline[(i + 1) % outline.size()];
    const double da = sign * left_of(a, from, direction), db = sign * left_of(b, from, direction);
    if (da >= 0) part.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) part.push_back(crossing(a, b, da, db));
  }
  return part;
}

}  // namespace

ContactRegions::ContactRegions(const Chart& chart, double tolerance) : tolerance_(tolerance) {
  std::map<std::array<PointKey, 2>, std::uint32_t> edges;
  for (std::uint32_t n = 0; n < chart.triangles.size(); ++n) {
    const auto& at = chart.triangles[n].at;
    pieces_.push_back({n, {at.begin(), at.end()}});
    if (doubled_area(at) < 0) std::reverse(pieces_.back().outline.begin(), pieces_.back().outline.end());
    for (std::size_t k = 0; k < 3; ++k) {
      const PointKey a = key_of(at[k]), b = key_of(at[(k + 1) % 3]);
      const auto [it, fresh] = edges.try_emplace({std::min(a, b), std::max(a, b)}, n);
      if (!fresh) links_.push_back({{it->second, n}, at[k], at[(k + 1) % 3]});
    }
  }
}

bool ContactRegions::cut(Vec2d from, Vec2d to) {
  const double l = length(to - from);
  if (!(l > tolerance_)) return true;
  contacts_.push_back({from, to});
  const Vec2d direction = (to - from) / l;
  const auto count = static_cast<std::uint32_t>(pieces_.size());
  count_steps();
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::vector<Vec2d>& outline = pieces_[n].outline;
    double low = 1e300, high = -1e300, first = 0, last = l;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const double d = left_of(outline[i], from, direction);
      low = std::min(low, d);
      high = std::max(high, d);
      // The part of the line on the inner side of the outline's edge.
      const Vec2d edge = outline[(i + 1) % outline.size()] - outline[i];
      const double start = cross(edge, from - outline[i]), slope = cross(edge, direction);
      if (slope > 0)
        first = std::max(first, -start / slope);
      else if (slope < 0)
        last = std::min(last, -start / slope);
      else if (start < 0)
        last = -1;
    }
    if (!(last - first > tolerance_) || low > -tolerance_ || high < tolerance_) continue;
    if (pieces_.size() >= kMostPieces) return false;
    split(n, from, direction);
  }
  part(from, direction, l);
  return true;
}

// Splits a piece along a whole line, and joins its halves there.
void ContactRegions::split(std::uint32_t piece, Vec2d from, Vec2d direction) {
  count_steps();
  std::vector<Vec2d> left = half_of(pieces_[piece].outline, from, direction, 1),
                     right = half_of(pieces_[piece].outline, from, direction, -1);
  const auto other = static_cast<std::uint32_t>(pieces_.size());
  pieces_.push_back({pieces_[piece].number, right});
  pieces_[piece].outline = left;
  split_links(links_, piece, other, from, direction);
  split_links(doors_, piece, other, from, direction);
  double first = 1e300, last = -1e300;
  for (const Vec2d p : left)
    if (std::fabs(left_of(p, from, direction)) <= 1e-3 * tolerance_) {
      first = std::min(first, dot(p - from, direction));
      last = std::max(last, dot(p - from, direction));
    }
  if (last > first) links_.push_back({{piece, other}, from + direction * first, from + direction * last});
}

// Hands the links of a piece that lie on the right of a line to the other half.
void ContactRegions::split_links(std::vector<Link>& links, std::uint32_t piece, std::uint32_t other, Vec2d from, Vec2d direction) const {
  const std::size_t count = links.size();
  for (std::size_t i = 0; i < count; ++i) {
    Link& link = links[i];
    if (link.piece[0] != piece && link.piece[1] != piece) continue;
    const double da = left_of(link.from, from, direction), db = left_of(link.to, from, direction);
    std::uint32_t& own = link.piece[0] == piece ? link.piece[0] : link.piece[1];
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      Link second = link;
      second.from = link.to = crossing(link.from, link.to, da, db);
      (da > 0 ? (link.piece[0] == piece ? second.piece[0] : second.piece[1]) : own) = other;
      links.push_back(second);
    } else if (da + db < 0) {
      own = other;
    }
  }
}

bool ContactRegions::cut_through(Vec2d from, Vec2d to) {
  const double l = length(to - from);
  if (!(l > tolerance_)) return true;
  const Vec2d direction = (to - from) / l;
  const auto count = static_cast<std::uint32_t>(pieces_.size());
  for (std::uint32_t n = 0; n < count; ++n) {
    double low = 1e300, high = -1e300;
    for (const Vec2d p : pieces_[n].outline) {
      low = std::min(low, left_of(p, from, direction));
      high = std::max(high, left_of(p, from, direction));
    }
    if (low > -tolerance_ || high < tolerance_) continue;
    if (pieces_.size() >= kMostPieces) return false;
    split(n, from, direction);
  }
  for (const auto& contact : contacts_) part(contact[0], normalized_along(contact), length(contact[1] - contact[0]));
  const auto is_door = [&](const Link& link) {
    return std::fabs(left_of(link.from, from, direction)) <= tolerance_ && std::fabs(left_of(link.to, from, direction)) <= tolerance_;
  };
  for (const Link& link : links_)
    if (is_door(link) && length(link.to - link.from) > tolerance_) doors_.push_back(link);
  std::erase_if(links_, is_door);
  return true;
}

std::uint32_t ContactRegions::piece_at(Vec2d p) const {
  for (std::uint32_t n = 0; n < pieces_.size(); ++n) {
    const std::vector<Vec2d>& outline = pieces_[n].outline;
    bool inside = true;
    for (std::size_t i = 0; i < outline.size() && inside; ++i)
      inside = cross(outline[(i + 1) % outline.size()] - outline[i], p - outline[i]) >= 0;
    if (inside) return n;
  }
  return kNowhere;
}

// Takes the line away from the links along it.
void ContactRegions::part(Vec2d from, Vec2d direction, double l) {
  std::vector<Link> left;
  for (const Link& link : links_) {
    if (std::fabs(left_of(link.from, from, direction)) > tolerance_ || std::fabs(left_of(link.to, from, direction)) > tolerance_) {
      left.push_back(link);
      continue;
    }
    const double a = dot(link.from - from, direction), b = dot(link.to - from, direction);
    const double low = std::min(a, b), high = std::max(a, b), first = std::max(low, -tolerance_), last = std::min(high, l + tolerance_);
    if (!(last > first)) {
      left.push_back(link);
      continue;
    }
    const auto keep = [&](double s, double t) {
      if (t - s > tolerance_) left.push_back({link.piece, from + direction * s, from + direction * t});
    };
    keep(low, first);
    keep(last, high);
  }
  links_ = std::move(left);
}

std::vector<std::uint32_t> ContactRegions::regions() const {
  std::vector<std::uint32_t> root(pieces_.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  for (const Link& link : links_) {
    if (!(length(link.to - link.from) > tolerance_)) continue;
    const std::uint32_t a = find(link.piece[0]), b = find(link.piece[1]);
    root[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> numbers(pieces_.size()), region(pieces_.size());
  std::uint32_t count = 0;
  for (std::uint32_t n = 0; n < pieces_.size(); ++n) {
    const std::uint32_t r = find(n);
    if (r == n) numbers[n] = count++;
    region[n] = numbers[r];
  }
  return region;
}

}  // namespace steradian::bake
