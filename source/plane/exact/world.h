// The inside of a PlaneWorld: bodies, their curves, and the structures that find them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "plane/exact/edge_rows.h"
#include "plane/exact/emission.h"
#include "plane/exact/outline.h"
#include "plane/exact/ray_grid.h"

namespace steradian::plane {
struct Extras;  // plane/extras/extras.h
}

namespace steradian {

struct PlaneWorld::Impl {
  enum class Use { all, frames };  // frames: without the structures for queries, and with capacity for more
  Impl(PlaneScene scene, const Limits& limits, Use use = Use::all);
  ~Impl();

  // Changes of a world for frames, from bodies in the user's units. Returns false, with nothing changed, if a body has another number of
  // curves than before, or the capacity is not enough. Throws Error as the constructor does.
  bool set_body(std::size_t i, PlaneBody body);
  bool append(PlaneBody body);
  void drop(std::size_t i);  // leaves an empty place

  // Converts bodies to curves, and builds the structures that find them; `edges` is the largest number of curves.
  void take_apart(std::size_t edges, Use use);
  void add_rows(std::size_t i);

  // Is p in body i or on its edge?
  bool contains(std::size_t i, Vec2d p) const;

  // In units in which the picture's larger side has 1024 to 2048, so that no threshold depends on the user's units. The scale is a power of
  // two, so that nothing is rounded.
  PlaneScene scene;
  double scale = 1;                      // from the user's units
  std::optional<PlaneScene> given;       // as the user gave it, if the scale is not 1
  std::vector<plane::Curve> curves;      // all bodies, in the scene's order
  std::vector<std::size_t> first_curve;  // by body, and the number of curves at the end
  std::vector<Box2d> boxes;              // by body
  plane::RayGrid grid;
  std::vector<plane::EdgeRows> rows;            // for outlines with many edges
  std::vector<int> rows_of;                     // by body: index of its rows, or -1
  std::unique_ptr<const plane::Extras> extras;  // suns, fog and other features that this file does not handle; null: none
  const PlaneBody* beyond_par = nullptr;        // a light whose radiance depends on place or direction: `par` does not support it

  // Bodies that hold a point, and curves on which it lies, up to rounding. A light's outline is within the light, so that all of it is on
  // one side.
  struct Around {
    Vec2d at;
    std::vector<int> holders;  // by rising index
    std::vector<const plane::Curve*> on;
  };
  Around around(Vec2d p) const;
  // The same of a point beside it that is on no curve, in the same bodies if there is one. Bodies that meet in this point only leave it in
  // some of them, the last light among these if possible.
  Around off_outlines(Around around) const;

  // The body that fills the point: an occluder wins, then the last light. -1: nothing.
  struct Inside {
    int body = -1;
    bool dark = false;
    Vec2d at;  // off outlines
  };
  Inside inside(Vec2d p) const;
  // The exact light at a place, in these units, without the light of extras.
  PlaneLight light_at(Vec2d p) const;
  // The last occluder that holds the point, or -1.
  int occluder_at(Vec2d p) const;
};

}  // namespace steradian

namespace steradian::plane {

using World = PlaneWorld::Impl;

// The exact method over a chosen set of curves.
PlaneLight envelope_light(const World& world, const std::vector<const Curve*>& curves, Vec2d from, int inside_light,
                          EmissionParts parts = EmissionParts::radiance_and_moments);
// The same for one light; the others block.
PlaneLight envelope_light_of(const World& world, const std::vector<const Curve*>& curves, Vec2d from, int only, EmissionParts parts);
// Radiance within a light, if only these parts of other outlines are visible, and the light between them.
Vec3d light_between(const World& world, const std::vector<Curve>& parts, Vec2d from, int inside_light);
// Treatment of directions that several occluders cover. The paper merges their intervals; with `added` they count as often as they are
// covered. It measures the benefit of merging.
enum class ParOverlaps { merged, added };
PlaneLight par_light(const World& world, Vec2d from, ParOverlaps overlaps = ParOverlaps::merged);
PlaneLight sampled_light(const World& world, Vec2d from, int inside_light, const PlaneSampling& sampling);
PlaneLight marched_light(const World& world, Vec2d from, int inside_light, const PlaneSampling& sampling);

}  // namespace steradian::plane
