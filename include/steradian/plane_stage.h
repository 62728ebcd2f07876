// A picture of the plane that follows its scene: bodies move, are added and removed, and only tiles that may have changed are drawn again.
//
//   PlaneStage stage(scene, options);
//   stage.move(lamp, {3, 0});  stage.remove(box);
//   const Picture& picture = stage.draw();     // the same bytes as render_plane of the current scene
//
// A tile is skipped if no pair of a light and a moved body reaches it, before or after. The tests are those of the frame on its way down to
// the tile. The area that a moved lamp lights or overlaps is drawn again. For uniform round lights, the light of each to each tile is
// cached, a kilobyte for a light and a tile. The cache takes 1 GB or a quarter of the memory that the limits allow at most. So only lights
// that have changed there are computed. Only the parts of the scene that a change touches are prepared again.
#pragma once

#include <memory>

#include "steradian/plane.h"

namespace steradian {

struct PlaneStageStats {
  std::size_t tiles = 0, drawn = 0;  // of 16 x 16 pixels; those that the last draw rendered
  bool anew = false;                 // the whole scene was prepared again, not only the changes
  double ms = 0;
};

// True if two bodies look the same, as lights and as shadows.
bool looks_alike(const PlaneBody& a, const PlaneBody& b);

class PlaneStage {
 public:
  // Supports exact light, without moments, bounces or antialiasing, with black occluders. Throws Error for other options, and like
  // PlaneWorld.
  explicit PlaneStage(PlaneScene scene, const PlaneFrameOptions& options = {});
  ~PlaneStage();
  PlaneStage(PlaneStage&&) noexcept;
  PlaneStage& operator=(PlaneStage&&) noexcept;

  const PlaneScene& scene() const;
  std::size_t add(PlaneBody body);                   // on top; returns its index
  void remove(std::size_t body);                     // those behind it move up by one
  void replace(std::size_t body, PlaneBody with);    // replaces shape, place, light and everything else
  void move(std::size_t body, Vec2d by);             // in user units; a gradient moves along
  void recolour(std::size_t light, Vec3d radiance);  // for a light without a gradient
  // Changes to another scene, body by body: bodies that look alike stay. Those behind an added or removed one count as other bodies.
  void follow(const PlaneScene& next);

  // The picture of the current scene. Throws Error if the scene has become one that PlaneWorld refuses; the picture then stays.
  const Picture& draw();
  const PlaneStageStats& stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace steradian
