// PatchesInLobes: the patches that narrow lobes see, by directions of each lobe.
//
// A mean over the few mirrored rays that may fall into a lobe is poor. The patches are less detailed than what the rays show, but many more
// directions see them. So the mean of the rays' light plus the difference between two means of the patches, over the lobe's own directions
// and over the rays, has the detail of one and the even cover of the other.
#pragma once

#include "render/radiosity/block_fit.h"
#include "render/radiosity/bounce_rays.h"
#include "render/radiosity/mirror/mirrors.h"
#include "render/radiosity/patch_light.h"

namespace steradian::radiosity {

// A narrow lobe at a pixel.
struct MirrorLobe {
  Vec3f origin, normal, geometric_normal, tangent, view;  // origin: off the surface
  float alpha_x, alpha_y;
  // A pixel of several primary samples sees all of its surface: change of origin, normal and view from one pixel to the next.
  struct Step {
    Vec3f origin, normal, view;
  };
  Step right, down;
};

class PatchesInLobes {
 public:
  // Both must outlive this object. samples: primary samples of a pixel.
  PatchesInLobes(const PatchLight& light, const RayScene& rays, int samples) : light_(light), rays_(rays), samples_(samples) {}

  // Finds the radiance of the patches along those rays of a tile's mirrors that are traced, times the fraction that the mirrors reflect.
  void along_rays(const Mirrors& mirrors, const StandsFor& stands_for, TileVector& radiance) const;

  struct Seen {
    Gathered mean;
    Vec3f spread;  // standard deviation over the lobe
  };
  // The mean radiance of the patches that a lobe sees.
  Seen seen_by(const MirrorLobe& lobe) const;

 private:
  Vec3f radiance(const PatchPlace& met, Vec3f to, float width) const;

  const PatchLight& light_;
  const RayScene& rays_;
  const int samples_;
};

}  // namespace steradian::radiosity
