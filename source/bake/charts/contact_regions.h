// ContactRegions: the convex pieces of a plane chart between contact lines, joined where no line parts them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/charts/chart.h"

namespace steradian::bake {

class ContactRegions {
 public:
  static constexpr std::size_t kMostPieces = 20'000;

  // The triangles of a plane chart, joined at their common edges.
  //
  //   tolerance  distance [m] below which points count as one
  ContactRegions(const Chart& chart, double tolerance);

  // Cuts the pieces that a line crosses. Returns false where there would be more than kMostPieces.
  bool cut(Vec2d from, Vec2d to);
  // The pieces and links that all cuts looked at.
  std::uint64_t steps() const { return steps_; }

  // Cuts all pieces along the whole line through two points, so that the two sides are regions of their own. Where no contact lies on the
  // line, they have doors. To be called after all cuts.
  bool cut_through(Vec2d from, Vec2d to);

  const std::vector<ChartPiece>& pieces() const { return pieces_; }
  // The piece that holds a point; kNowhere: none.
  static constexpr std::uint32_t kNowhere = UINT32_MAX;
  std::uint32_t piece_at(Vec2d p) const;
  // The number of each piece's region. Regions are numbered from 0 on.
  std::vector<std::uint32_t> regions() const;

  // A part of the border between two pieces.
  struct Link {
    std::array<std::uint32_t, 2> piece;
    Vec2d from, to;
  };
  const std::vector<Link>& doors() const { return doors_; }

 private:
  void split(std::uint32_t piece, Vec2d from, Vec2d direction);
  void part(Vec2d from, Vec2d direction, double length);
  void split_links(std::vector<Link>& links, std::uint32_t piece, std::uint32_t other, Vec2d from, Vec2d direction) const;
  void count_steps() { steps_ += pieces_.size() + links_.size() + doors_.size(); }

  const double tolerance_;
  std::uint64_t steps_ = 0;
  std::vector<ChartPiece> pieces_;
  std::vector<Link> links_, doors_;
  std::vector<std::array<Vec2d, 2>> contacts_;
};

}  // namespace steradian::bake
