#include "fit/clipped_sphere.h"

#include <algorithm>

#include "steradian/kernels.h"

namespace steradian::fit {

double clipped_sphere_form_factor(double cosine, double form_factor) {
  return Kernels<double>{}.ltc_clipped_sphere(std::clamp(cosine, -1.0, 1.0), std::clamp(form_factor, 0.0, 1.0)).v;
}

}  // namespace steradian::fit
