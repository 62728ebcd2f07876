#include "fit/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/cosine_sampler.h"
#include "steradian/error.h"

namespace steradian::fit {

Lobe with_grazing_fresnel(const Lobe& lobe) {
  Lobe result = lobe;
  result.evaluate = [lobe](Vec3d l) {
    const double f = lobe.evaluate(l);
    if (f <= 0) return 0.0;
    const double v_dot_h = dot(lobe.view, normalized(l + lobe.view));
    return f * std::pow(std::clamp(1 - v_dot_h, 0.0, 1.0), 5.0);
  };
  return result;
}

Lobe with_samples(Lobe lobe) {
  if (lobe.sample) return lobe;
  lobe.sample = [](double a, double b) { return lobes::sample_cosine_hemisphere(b, a); };
  lobe.pdf = lobes::pdf_cosine_hemisphere;
  return lobe;
}

const std::vector<LobeFamily>& lobe_families() {
  const auto by_alpha = [](Lobe (*lobe)(double, Vec3d)) {
    return [lobe](double roughness, double cos_theta) { return lobe(alpha_from_roughness(roughness), view_from_cosine(cos_theta)); };
  };
  static const std::vector<LobeFamily> families = {
      {"ggx", LobeFrame::mirror, by_alpha(ggx_lobe)},
      {"beckmann", LobeFrame::mirror, by_alpha(beckmann_lobe)},
      {"charlie", LobeFrame::normal, by_alpha(charlie_lobe)},
      {"disney-diffuse", LobeFrame::normal,
       [](double roughness, double cos_theta) { return disney_diffuse_lobe(roughness, view_from_cosine(cos_theta)); }},
      {"oren-nayar", LobeFrame::normal,
       [](double roughness, double cos_theta) { return oren_nayar_lobe(roughness * 0.5 * std::numbers::pi, view_from_cosine(cos_theta)); }},
  };
  return families;
}

const LobeFamily& lobe_family(const std::string& name) {
  std::string known;
  for (const LobeFamily& family : lobe_families()) {
    if (family.name == name) return family;
    known += (known.empty() ? "" : ", ") + family.name;
  }
  throw Error("--lobe", "unknown lobe '" + name + "'", "one of " + known);
}

}  // namespace steradian::fit
