// RoughGlass: the blurred lobe through a face of rough glass, as a surface that reflects.
//
// A rough thin wall sends light on in the directions in which it would reflect it, turned through its plane (KHR_materials_transmission).
// So seen from behind, by the mirror image of the viewer, the wall is a rough mirror. Lamps, the sky and other surfaces light this mirror
// as they light any other. Behind a solid the lobe is about the direction in which the ray leaves.
#pragma once

#include <vector>

#include "render/surface/surface.h"

namespace steradian {

class RoughGlass {
 public:
  explicit RoughGlass(const Scene& scene);

  // True if a face blurs what stands behind it.
  static bool blurs(const Surface& face);
  // True if faces of a material may, by its factors.
  static bool may_blur(const SurfaceMaterial& material);

  // The lobe that a face sends on, and the viewer who sees it.
  struct Lobe {
    Surface surface;
    Vec3f view;
  };
  // offset: of the lobe's place from the wall.
  Lobe behind_wall(const Surface& wall, Vec3f view, float offset) const;

  // Light that leaves a solid. Each change is that of the direction by facets of one face, tilted one width of the lobe to one side.
  struct Exit {
    Vec3f position, direction, normal;  // normal: of the last face
    float within = 0;                   // fraction that facets of the last face reflect within
    std::vector<Vec3f> changes;
  };
  // Fraction of the light that facets of a face reflect totally.
  //
  //   to_ray  direction from the face to where the ray comes from
  //   eta     index before the face over the one behind it
  static float reflected_within(const Surface& face, Vec3f to_ray, float eta);
  // face: where the ray has entered.
  Lobe behind_solid(const Surface& face, const Exit& exit) const;
  // Light that was reflected within leaves in all directions, by turns before and behind the solid. This is what leaves before it, for a
  // fraction of front_share of all.
  Lobe before_solid(const Surface& face, Vec3f view, float offset) const;
  static float front_share(float within) { return within / (1 + within); }

 private:
  Surface lobe_of(const Surface& face) const;

  const Scene& scene_;
  std::vector<SurfaceMaterial> behind_;  // of the lobes, by the scene's material
};

}  // namespace steradian
