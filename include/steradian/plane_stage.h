// A picture of the plane that follows its scene: bodies move, come and go, and only the tiles that may have changed are drawn again.
//
//   PlaneStage stage(scene, options);
//   stage.move(lamp, {3, 0});  stage.remove(box);
//   const Picture& picture = stage.draw();     // the same bytes as render_plane of the scene as it is now
//
// A tile is left alone where no pair of a light and a moved body reaches it, before or after, by the very tests that the frame makes on its
// way down to the tile. What a moved lamp lights, and what it overlaps, is drawn again. Of round lights that are uniform, what each sends
// to each tile is kept (a kilobyte for a light and a tile, 1 GB or a quarter of the memory that the limits allow at most), so that only
// lights that have changed there are worked out. Of the scene, only what a change touches is made ready again.
#pragma once

#include <memory>

#include "steradian/plane.h"

namespace steradian {

struct PlaneStageStats {
  std::size_t tiles = 0, drawn = 0;  // of 16 x 16 pixels; those that the last draw made
  bool anew = false;                 // all of the scene was made ready again, not just what changed
  double ms = 0;
};

// Whether two bodies look the same, as lights and as shadows.
bool looks_alike(const PlaneBody& a, const PlaneBody& b);

class PlaneStage {
 public:
  // Exact light, without moments, bounces or antialiasing, occluders black. Throws Error for other options, and as PlaneWorld does.
  explicit PlaneStage(PlaneScene scene, const PlaneFrameOptions& options = {});
  ~PlaneStage();
  PlaneStage(PlaneStage&&) noexcept;
  PlaneStage& operator=(PlaneStage&&) noexcept;

  const PlaneScene& scene() const;
  std::size_t add(PlaneBody body);                   // on top; its index
  void remove(std::size_t body);                     // those behind it move up by one
  void replace(std::size_t body, PlaneBody with);    // shape, place, light and all
  void move(std::size_t body, Vec2d by);             // by user units; a gradient moves along
  void recolour(std::size_t light, Vec3d radiance);  // of a light without a gradient
  // Becomes another scene, body by body: what looks alike stays. Those behind one that has come or gone are other ones.
  void follow(const PlaneScene& next);

  // The picture of the scene as it is now. Throws Error where the scene has become one that PlaneWorld refuses; the picture then stays.
  const Picture& draw();
  const PlaneStageStats& stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace steradian
