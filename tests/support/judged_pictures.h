// For tests: a picture with exact shadows, and the pictures that judge it.
#pragma once

#include "steradian/render.h"
#include "support/z_test.h"

namespace steradian {

struct JudgedPictures {
  Picture open;       // by the method `auto`, without shadows
  Picture analytic;   // by the method `auto`, with exact shadows
  Picture reference;  // by rays, with their variance and that of rare samples
};

// options: for all three pictures, except method, shadows and target error.
inline JudgedPictures judged_pictures(const Scene& scene, RenderOptions options, double target_error) {
  JudgedPictures p;
  options.method = "auto";
  options.shadows = Shadows::off;
  p.open = render(scene, options);
  options.shadows = Shadows::exact;
  p.analytic = render(scene, options);
  options.method = "reference";
  options.target_error = target_error;
  p.reference = render(scene, options);
  image::add_variance_of_rare_samples(p.reference, p.open);
  return p;
}

}  // namespace steradian
