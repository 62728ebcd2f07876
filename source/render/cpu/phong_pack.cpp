#include "render/cpu/phong.h"

#include "core/pack.h"
#include "moment/clipped_edges.h"
#include "moment/phong_lobe.h"

STERADIAN_BEGIN_ISA
namespace {

template <PhongMethod method, PhongQuality quality = PhongQuality::normal>
__attribute__((flatten)) void radiance_by(const PreparedPolygon& light, const ViewedPoints& points,
                                          const PhongLobe<Pack>& lobe, float* result) {
  PackKernels k;
  const SurfacePoints& s = points.surface;
  const PackVec3 plane_normal(light.normal.x, light.normal.y, light.normal.z);
  const PackVec3 plane_point(light.centroid.x, light.centroid.y, light.centroid.z);
  const bool two_sided = light.two_sided;

  for (std::size_t i = 0; i < s.count; i += kLanes) {
    const PackVec3 p(load(s.x + i), load(s.y + i), load(s.z + i));
    const PackVec3 n(load(s.nx + i), load(s.ny + i), load(s.nz + i));
    const PackVec3 v(load(points.vx + i), load(points.vy + i), load(points.vz + i));
    const auto height = dot(p - plane_point, plane_normal);
    const auto behind = height < PackReal(0.0);
    const auto facing = two_sided ? behind || height > PackReal(0.0) : height > PackReal(0.0);
    const auto frame = k.frame_from_normal(n);
    const auto local_v = transform_transposed(frame, v);
    const auto lit = facing && local_v.z > PackReal(0.0);
    if (!any_lane(lit)) {
      store(result + i, PackReal(0.0));
      continue;
    }
    const auto r = k.phong_mirror(local_v);
    const auto direction = [&](const Vec3d& vertex) {
      return k.polygon_direction(transform_transposed(frame, PackVec3(vertex.x, vertex.y, vertex.z) - p));
    };
    const auto sum = sum_over_clipped_edges<Pack>(light, direction, [&](const PackVec3& a, const PackVec3& b) {
      return lobe.template share<method, quality>(a, b, r);
    });
    store(result + i, select(lit, k.moment_phong_radiance(sum, behind), PackReal(0.0)));
  }
}

void radiance(const PreparedPolygon& light, const ViewedPoints& points, double exponent, const PhongOptions& options,
              float* result) {
  const PhongLobe<Pack> lobe(exponent, options.relative_precision);
  switch (options.method) {
    case PhongMethod::exact: return radiance_by<PhongMethod::exact>(light, points, lobe, result);
    case PhongMethod::arvo: return radiance_by<PhongMethod::arvo>(light, points, lobe, result);
    case PhongMethod::lorentzian: return radiance_by<PhongMethod::lorentzian>(light, points, lobe, result);
    case PhongMethod::pearson: return radiance_by<PhongMethod::pearson>(light, points, lobe, result);
    case PhongMethod::ellipsoid: return radiance_by<PhongMethod::ellipsoid>(light, points, lobe, result);
    case PhongMethod::series: break;
  }
  if (options.quality == PhongQuality::high)
    return radiance_by<PhongMethod::series, PhongQuality::high>(light, points, lobe, result);
  radiance_by<PhongMethod::series>(light, points, lobe, result);
}

}  // namespace

const PhongTable& phong_table() {
  static constexpr PhongTable table = {radiance};
  return table;
}

STERADIAN_END_ISA
