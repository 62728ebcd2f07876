// The literature's first experiment: one point light over a plane of F0 = 1, seen from 22 degrees above. It compares transformed cosines at
// a virtual light's end with GGX itself, in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/lobe.h"
#include "integrals/tables/ggx_tables.h"
#include "steradian/kernels.h"

namespace steradian::indirect {

struct PointLightPlane {
  int width, height;
  std::vector<double> transformed, ggx;  // radiance of each pixel; 0 above the horizon
  double white = 0;                      // 99.9th percentile of ggx below the horizon
  double rmse = 0;                       // of a picture that is scaled to white = 1
  double relative_l2 = 0, mean_ratio = 0;
};

inline PointLightPlane point_light_over_plane(double roughness, int width, int height) {
  using K = Kernels<double>;
  K k;
  const auto vector = [](Vec3d v) { return K::vec3(v.x, v.y, v.z); };
  const Vec3d camera{0, 2, 5}, light{0, 1, -1}, normal{0, 1, 0};
  const Vec3d forward = normalized(-camera), right = normalized(cross(forward, normal)), up = cross(right, forward);
  const double alpha = alpha_from_roughness(roughness);
  PointLightPlane result{width, height, {}, {}};
  result.transformed.resize(static_cast<std::size_t>(width * height));
  result.ggx.resize(result.transformed.size());
  std::vector<double> truth;
  double squares = 0, norm = 0, sum = 0, true_sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double s = 0.73 / height;  // twice the tangent of half the picture's height
      const Vec3d ray = normalized(forward + right * (s * (x + 0.5 - 0.5 * width)) - up * (s * (y + 0.5 - 0.5 * height)));
      if (ray.y > -0.02) continue;
      const Vec3d p = camera - ray * (camera.y / ray.y), v = light - p;
      const Frame f = Frame::from_normal_and_tangent(normal, -ray);
      const double t = fit::ggx_lobe(alpha, f.to_local(-ray)).evaluate(f.to_local(normalized(v))) / dot(v, v);
      const LtcValue value = ggx_compact_table().look_up(roughness, -ray.y);
      const LtcInverse& m = value.inverse;
      const auto lobe = k.indirect_lobe({m.xx, m.xz, m.yy, m.zx, m.zz}, k.frame_from_normal_and_view(vector(normal), vector(-ray)));
      const double e = value.n_a * k.indirect_point_light(lobe, vector(v)).v;
      const auto pixel = static_cast<std::size_t>(y * width + x);
      result.ggx[pixel] = t;
      result.transformed[pixel] = e;
      truth.push_back(t);
      squares += (e - t) * (e - t);
      norm += t * t;
      sum += e;
      true_sum += t;
    }
  const auto n = static_cast<double>(truth.size());
  const auto white = truth.begin() + static_cast<std::ptrdiff_t>(0.999 * n);
  std::nth_element(truth.begin(), white, truth.end());
  result.white = *white;
  result.rmse = std::sqrt(squares / n) / *white;
  result.relative_l2 = std::sqrt(squares / norm);
  result.mean_ratio = sum / true_sum;
  return result;
}

}  // namespace steradian::indirect
