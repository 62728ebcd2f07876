// TexturedLight: the mean radiance of a textured light under a lobe. It uses cells of the light (texture_tree.h) where the lobe is wider
// than they are, else one look-up in its blurred copies. Approximate; the error is measured in docs/theory/ltc.md, "Textured lights".
#pragma once

#include "integrals/textured/filtered_texture.h"
#include "shapes/plane_region.h"
#include "steradian/reference.h"

namespace steradian {

// A part of the lobe's footprint: a Gaussian of this width (in radians of the footprint's cone).
struct TextureGaussian {
  double weight, width;
};

inline const TextureGaussian kMixture[] = {{static_cast<double>(kTextureNarrowWeight), static_cast<double>(kTextureNarrow)},
                                           {1 - static_cast<double>(kTextureNarrowWeight), static_cast<double>(kTextureWide)}};

// either: cells where they serve, else a look-up. look_up: only the look-up, if packs have found that cells do not serve: floats and
// doubles may disagree.
enum class TextureWay { either, look_up };

class TexturedLight {
 public:
  // The light must have a texture; `polygon` is its prepared outline.
  TexturedLight(const AreaLight& light, const PreparedPolygon& polygon, const std::vector<Image>& images)
      : polygon_(polygon), texture_(light, polygon, images), tree_(texture_.finest()) {}

  // The mean over the light's visible part, weighted with the lobe. Times the lobe's integral over a light of radiance 1, it is the
  // radiance. If the light sends nothing, it is the light's plain mean. fitted: a table in the place of GGX; null: GGX.
  Vec3f seen_by_diffuse(const ShadingPoint& at, TextureWay way = TextureWay::either) const;
  Vec3f seen_by_ggx(const ShadingPoint& at, double alpha, TextureWay way = TextureWay::either, const ClassicTable* fitted = nullptr) const;

  // The same past occluders: the mean over the visible part of the light, in coordinates of the texture's axes, exact up to the smallest
  // cells. Where the lobe sees less than those, the mean over the whole light.
  Vec3f seen_by_diffuse(const ShadingPoint& at, const PlaneRegion& visible) const;
  Vec3f seen_by_ggx(const ShadingPoint& at, double alpha, const PlaneRegion& visible, const ClassicTable* fitted = nullptr) const;

  const FilteredTexture& texture() const { return texture_; }
  const TextureTree& tree() const { return tree_; }

 private:
  Vec3f diffuse(const ShadingPoint& at, TextureWay way, const PlaneRegion* visible) const;
  Vec3f ggx(const ShadingPoint& at, double alpha, TextureWay way, const PlaneRegion* visible, const ClassicTable* fitted) const;

  PreparedPolygon polygon_;
  FilteredTexture texture_;
  TextureTree tree_;
};

}  // namespace steradian
