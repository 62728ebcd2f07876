// measure_jitter SCENE [FRAMES]: measures the change of the bounce's own error from frame to frame of a moving camera, at silhouettes and
// elsewhere, with the filter and without it. Writes the table of docs/measured/indirect.md.
//
// The camera moves sideways by a quarter of a pixel a frame. Each frame's error is its difference from the sum of all virtual lights at
// every pixel, so that changes from the motion itself do not count. The jitter is the mean absolute change of an error from one frame to
// the next, over the mean light. A pixel is at a silhouette if a neighbour shows another mesh, or a normal 26 degrees off.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "render/surface/camera_rays.h"
#include "render/surface/ray_scene.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"

using namespace steradian;

namespace {

constexpr int kWidth = 384, kHeight = 216, kLights = 1 << 13;

struct Hit {
  unsigned mesh = RTC_INVALID_GEOMETRY_ID;
  Vec3f normal;
};

std::vector<bool> silhouettes(const Scene& scene, const RayScene& rays) {
  const CameraRays camera(scene.cameras[0], kWidth, kHeight);
  std::vector<Hit> hits(kWidth * kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      RTCRayHit hit;
      if (!rays.intersect(camera.origin(), camera.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), hit)) continue;
      hits[static_cast<std::size_t>(y * kWidth + x)] = {hit.hit.geomID, normalized(Vec3f{hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z})};
    }
  std::vector<bool> at(hits.size());
  const auto differ = [&](std::size_t a, std::size_t b) {
    return hits[a].mesh != hits[b].mesh || (hits[a].mesh != RTC_INVALID_GEOMETRY_ID && dot(hits[a].normal, hits[b].normal) < 0.9f);
  };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::size_t x = i % kWidth, y = i / kWidth;
    at[i] = (x > 0 && differ(i, i - 1)) || (x + 1 < kWidth && differ(i, i + 1)) || (y > 0 && differ(i, i - kWidth)) ||
            (y + 1 < kHeight && differ(i, i + kWidth));
  }
  return at;
}

std::vector<Vec3f> bounce(const Scene& scene, bool whole, bool filter) {
  RenderOptions o;
  o.width = kWidth;
  o.height = kHeight;
  o.method = "ltc-compact";
  o.shadows = Shadows::off;
  o.indirect.mode = IndirectMode::ltc;
  o.indirect.virtual_lights = kLights;
  o.indirect.filter = filter;
  if (whole) {
    o.indirect.kept_pairs = 0;
    o.indirect.interleave = 1;
  }
  const Picture picture = render(scene, o);
  return picture.layers.at("indirect");
}

struct Jitter {
  double change = 0, light = 0;
  double relative() const { return change / light; }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: measure_jitter SCENE [FRAMES]\n");
    return 2;
  }
  Scene scene = load_scene(argv[1]).scene;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 120;
  const RayScene rays(scene);
  // A pixel's width at the surface in the middle of the picture.
  const Camera first = scene.cameras[0];
  RTCRayHit middle;
  const CameraRays camera(first, kWidth, kHeight);
  const bool seen = rays.intersect(camera.origin(), camera.direction(kWidth / 2.0f, kHeight / 2.0f), middle);
  const double step = 0.25 * 2 * std::tan(0.5 * first.yfov) / kHeight * (seen ? static_cast<double>(middle.ray.tfar) : 1);
  std::array<std::array<Jitter, 2>, 2> found;  // by filter, by silhouette
  std::array<std::vector<Vec3f>, 2> before;
  std::vector<bool> edges_before;
  double share = 0;
  for (int f = 0; f < frames; ++f) {
    scene.cameras[0].position = first.position + first.x * (step * f);
    const std::vector<bool> edges = silhouettes(scene, rays);
    const std::vector<Vec3f> truth = bounce(scene, true, false);
    for (const bool filter : {false, true}) {
      std::vector<Vec3f> error = bounce(scene, false, filter);
      for (std::size_t i = 0; i < error.size(); ++i) error[i] = error[i] - truth[i];
      auto& jitter = found[filter];
      for (std::size_t i = 0; i < error.size() && f > 0; ++i) {
        const Vec3f change = error[i] - before[filter][i];
        Jitter& j = jitter[edges[i] || edges_before[i]];
        j.change += static_cast<double>(std::fabs(change.x) + std::fabs(change.y) + std::fabs(change.z));
        j.light += static_cast<double>(truth[i].x + truth[i].y + truth[i].z);
        if (filter && (edges[i] || edges_before[i])) share += 1.0 / (static_cast<double>(error.size()) * (frames - 1));
      }
      before[filter] = std::move(error);
    }
    edges_before = edges;
  }
  std::printf("| %s, %d frames of %d x %d | at silhouettes (%.1f %% of pixels) | elsewhere |\n|---|---|---|\n", argv[1], frames, kWidth,
              kHeight, 100 * share);
  for (const bool filter : {false, true})
    std::printf("| %s | %.4f | %.4f |\n", filter ? "with the filter" : "as the pattern leaves it", found[filter][1].relative(),
                found[filter][0].relative());
}
