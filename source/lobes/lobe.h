// Lobe: a material's lobe at one view. Quadrature integrates it, Monte Carlo samples it, the fitter fits it, and lights of one direction
// are reflected by it.
//
// Each kind has a file of its own beside this one: a struct with
//
//   kBrdf, kName, kKeys                  its name, and its keys in files (keys.h)
//   axis_and_width(material, at)         position of the lobe, for an outline that gathers its corners there
//   constructor (material, view)
//   evaluate(l), sample(u, v), pdf(l)    l and view are above the surface in evaluate
//   shape(), sensitivity(), ending_planes(), and the colours plain and fresnel
//
// and stands in the list of Lobe::Kind. Fitted stands last: it has no name, and takes the place of GGX. Directions are unit and in the
// shading frame: z the normal, x the tangent of the widths.
#pragma once

#include <array>
#include <span>
#include <variant>

#include "lobes/beckmann.h"
#include "lobes/blinn_phong.h"
#include "lobes/charlie.h"
#include "lobes/fitted.h"
#include "lobes/ggx.h"
#include "lobes/lambert.h"
#include "lobes/lobe_product.h"
#include "lobes/phong.h"

namespace steradian::lobes {

class Lobe {
 public:
  using Kind = std::variant<Lambert, Phong, Ggx, BlinnPhong, Beckmann, Charlie, LobeProduct, Fitted>;

  Lobe(const Material& material, Vec3d view);

  // BRDF times cosine; 0 where l or the view is not above the surface.
  LobeValue evaluate(Vec3d l) const;

  // A direction with density pdf(l) per solid angle, for u, v in [0, 1). The zero vector means no direction; the density then integrates to
  // less than 1. Directions below the surface occur.
  Vec3d sample(double u, double v) const;
  double pdf(Vec3d l) const;

  // The colour of an integral: albedo, or Schlick's Fresnel.
  Vec3d radiance(LobeValue integral) const { return colours_.plain * integral.plain + colours_.fresnel * integral.fresnel; }
  // Largest factor of each of the two scalars in any channel.
  LobeValue largest_factors() const;

  LobeShape shape() const;
  // Relative error of evaluate() per unit of the last place of l and the view.
  double sensitivity() const;
  // Planes through the point, by their normals, at which the lobe ends abruptly. Zero vectors: no plane.
  std::array<Vec3d, 2> ending_planes() const;
  bool above_surface() const { return view_.z > 0; }

 private:
  Kind kind_;
  Vec3d view_;
  Colours colours_;
};

// The material with its directions in a frame, as Lobe needs it.
Material in_frame(const Material& material, const Frame& frame);

// A kind of lobe with its name and keys in files.
struct LobeRow {
  const char* name;
  Brdf brdf;
  std::span<const Key> keys;
};
std::span<const LobeRow> lobe_rows();
const LobeRow& row_of(Brdf brdf);

}  // namespace steradian::lobes
