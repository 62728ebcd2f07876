// A lobe of one's own in a table: Minnaert's, a dusty surface that is darker, or brighter, towards its edge.
//
//   example minnaert.json
//   steradian render SCENE.glb -o picture.png --method ltc --table minnaert.json
#include <steradian/steradian.h>

#include <cmath>
#include <cstdio>

namespace {

constexpr double kPi = 3.14159265358979324;

// f = (k + 1) / (2 pi) (cos v cos l)^(k - 1): Lambert where k is 1. Minnaert, "The reciprocity principle in lunar photometry", 1941.
double minnaert(double k, steradian::Vec3d view, steradian::Vec3d light) { return (k + 1) / (2 * kPi) * std::pow(view.z * light.z, k - 1); }

}  // namespace

int main(int argc, char** argv) {
  steradian::LobeFamily family;
  family.name = "minnaert";
  family.frame = steradian::LobeFrame::normal;  // it has no peak about the mirror direction
  family.at = [](double roughness, double cosine) {
    const double k = 1 + roughness;  // the table's axis: roughness 0 is Lambert
    steradian::LobeFunction lobe;
    lobe.view = {std::sqrt(1 - cosine * cosine), 0, cosine};
    lobe.evaluate = [=](steradian::Vec3d l) { return l.z > 0 ? minnaert(k, {0, 0, cosine}, l) * l.z : 0.0; };
    return lobe;
  };
  const steradian::LobeFit fit = steradian::fit_lobe_table(family, argc > 1 ? argv[1] : "minnaert.json", {.size = 8});
  std::printf("fitted: off by %.3f of a lobe in the mean, %.3f at most\n", fit.mean_error, fit.largest_error);
  return fit.mean_error < 0.1 ? 0 : 1;
}
