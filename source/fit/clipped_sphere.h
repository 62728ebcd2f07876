// Form factor of a sphere cut by the horizon, over that of the whole sphere: the value that `ltc-clipless` looks up.
#pragma once

namespace steradian::fit {

//   cosine       of the sphere's centre to the normal, in [-1, 1]
//   form_factor  of the whole sphere towards its centre: sin^2 of its angular radius, in [0, 1]
// Degenerate: form factor 0 gives max(cosine, 0).
double clipped_sphere_form_factor(double cosine, double form_factor);

}  // namespace steradian::fit
