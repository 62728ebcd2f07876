// judge_shadows [--size WIDTHxHEIGHT] [--error E] [--studio] FILE...: compares pictures of glTF files with shadows with `reference`, pixel
// by pixel. It prints the fraction of pixels that the test accepts, and the worst of the others. --studio adds the studio's area lights,
// for files without lights.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/z_test.h"

using namespace steradian;

namespace {

struct Worst {
  double z;
  std::size_t pixel;
};

void judge(const std::string& file, const LoadOptions& load, RenderOptions options, double error) {
  const Scene scene = load_scene(file, load).scene;
  options.shadows = Shadows::exact;
  RenderStats stats;
  const Picture analytic = render(scene, options, &stats);
  options.method = "reference";
  options.target_error = 0.02;
  Picture reference = render(scene, options);
  options.method = "auto";
  options.shadows = Shadows::off;
  image::add_variance_of_rare_samples(reference, render(scene, options));
  // A variance too small to be visible in any picture.
  double squares = 0;
  for (const Vec3f p : reference.pixels) squares += static_cast<double>(dot(p, p)) / static_cast<double>(reference.pixels.size());
  const auto unseen = static_cast<float>(1e-10 * squares);
  for (Vec3f& v : reference.layers.at("variance")) v += Vec3f{unseen, unseen, unseen};
  const image::ZTest z = image::z_test(analytic, reference, error);
  std::vector<Worst> worst;
  const std::vector<Vec3f>& variance = reference.layers.at("variance");
  std::size_t black = 0;
  for (std::size_t i = 0; i < analytic.pixels.size(); ++i) {
    const Vec3f a = analytic.pixels[i], b = reference.pixels[i], v = variance[i];
    const double sigma = std::sqrt(static_cast<double>(v.x + v.y + v.z)) + error * static_cast<double>(length(b));
    const double off = static_cast<double>(length(a - b));
    if (off > 0) worst.push_back({off / std::max(sigma, 1e-12), i});
    black += !(length(a) > 0) && length(b) > 0 && static_cast<double>(length(b)) > z.threshold * sigma;
  }
  std::sort(worst.begin(), worst.end(), [](const Worst& a, const Worst& b) { return a.z > b.z; });
  std::printf("%s: %zu of %zu channels accepted (%.4f), %zu black pixels that are not, %.2g of the pairs by rays\n", file.c_str(),
              z.accepted, z.tested, z.share(), black, stats.shadow_fallback);
  for (std::size_t k = 0; k < std::min<std::size_t>(worst.size(), 4) && worst[k].z > z.threshold; ++k) {
    const std::size_t i = worst[k].pixel;
    const auto width = static_cast<std::size_t>(options.width);
    std::printf("  (%zu, %zu): %.4g, reference %.4g, %.1f standard errors\n", i % width, i / width,
                static_cast<double>(analytic.pixels[i].y), static_cast<double>(reference.pixels[i].y), worst[k].z);
  }
}

}  // namespace

int main(int argc, char** argv) {
  RenderOptions options;
  options.width = 96;
  options.height = 72;
  double error = 0.03;  // error of a lobe's method in a penumbra
  LoadOptions load;
  bool any = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--size") == 0 && i + 1 < argc) {
      if (std::sscanf(argv[++i], "%dx%d", &options.width, &options.height) != 2) return 2;
    } else if (std::strcmp(argv[i], "--error") == 0 && i + 1 < argc) {
      error = std::atof(argv[++i]);
    } else if (std::strcmp(argv[i], "--studio") == 0) {
      load.lights = {AddedLight::studio};
    } else {
      any = true;
      try {
        load.aspect = static_cast<double>(options.width) / options.height;
        judge(argv[i], load, options, error);
      } catch (const Error& e) {
        std::printf("%s: %s\n", argv[i], e.what());
      }
      std::fflush(stdout);
    }
  }
  if (!any) std::fprintf(stderr, "usage: judge_shadows [--size WIDTHxHEIGHT] [--error E] [--studio] FILE...\n");
  return any ? 0 : 2;
}
