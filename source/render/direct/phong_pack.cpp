#include "render/direct/phong.h"

#include "integrals/phong/phong.h"
#include "render/direct/seen_light_pack.h"

STERADIAN_BEGIN_ISA
namespace {

// A share of one edge behind a pointer: the literature's methods walk round lights and visible pieces by one function, which the compiler
// makes once. Their own walk is that of polygons, and that of the series is its own everywhere.
struct CalledShare {
  template <class Share>
  explicit CalledShare(const Share& s)
      : share(&s), call([](const void* to, const PackVec3& from, const PackVec3& end, const PackVec3& axis) {
          return (*static_cast<const Share*>(to))(from, end, axis);
        }) {}
  PackReal operator()(const PackVec3& from, const PackVec3& end, const PackVec3& axis) const { return call(share, from, end, axis); }

  const void* share;
  PackReal (*call)(const void* share, const PackVec3& from, const PackVec3& end, const PackVec3& axis);
};

// A function for each method, so that it holds one walk in registers.
template <class Share, class Walk>
STERADIAN_INLINE void walk_points(const Share& share, double exponent, const PhongOptions& options, const PackLight& light,
                                  const Points& points, float* result, const Walk& walk) {
  PackKernels k;
  integrals::Phong<Pack, Share> integral(share, exponent, options);
  for (std::size_t i = 0; i < points.count; i += kLanes) {
    const PackVec3 p = load(points.position, i), n = load(points.normal, i), v = load(points.view, i);
    const auto frame = k.frame_from_normal(n);
    const SeenLight seen(light, p, i);
    const PackVec3 view = transform_transposed(frame, v);
    store(result + i, walk(seen, frame, p, view, integral).x);
  }
}

template <class Share>
__attribute__((flatten, noinline)) void polygon_radiance(const Share& share, double exponent, const PhongOptions& options,
                                                         const PackLight& light, const Points& points, float* result) {
  walk_points(share, exponent, options, light, points, result,
              [](const SeenLight& seen, const auto& frame, const PackVec3& p, const PackVec3& view, auto& integral) {
                return integrate(PolygonOutline{{seen, frame, p}}, seen.shading(view), integral);
              });
}

// The corners of a round light gather about the mirrored view.
template <class Share>
__attribute__((flatten, noinline)) void curved_radiance(const Share& share, double exponent, const PhongOptions& options,
                                                        const PackLight& light, const Points& points, float* result) {
  walk_points(share, exponent, options, light, points, result,
              [&](const SeenLight& seen, const auto& frame, const PackVec3& p, const PackVec3& view, auto& integral) {
                const auto shading = seen.shading(view);
                if (light.is_pieces()) return integrate(PiecesOutline{seen, frame}, shading, integral);
                const AboutLobe about = {PackKernels().phong_mirror(view), PackReal(1 / std::sqrt(exponent + 1)), 12};
                return integrate(RoundOutline{seen, frame, p, about}, shading, integral);
              });
}

void radiance(const PackLight& light, const Points& points, double exponent, const PhongOptions& options, float* result) {
  const integrals::PhongLobe<Pack> lobe(exponent, options);
  const auto curved = [&](const auto& share) { curved_radiance(share, exponent, options, light, points, result); };
  const auto series = [&]<Quality quality>() {
    curved([&](const auto& a, const auto& b, const auto& axis) { return lobe.template share<Method::series, quality>(a, b, axis); });
  };
  if (!light.is_pieces() && !light.is_round())
    integrals::with_phong_share<Pack>(lobe, options,
                                      [&](const auto& share) { polygon_radiance(share, exponent, options, light, points, result); });
  else if (options.method != Method::series)
    integrals::with_phong_share<Pack>(lobe, options, [&](const auto& share) { curved(CalledShare(share)); });
  else if (options.quality == Quality::high)
    series.template operator()<Quality::high>();
  else
    series.template operator()<Quality::normal>();
}

}  // namespace

const PhongTable& phong_table() {
  static constexpr PhongTable table = {radiance};
  return table;
}

STERADIAN_END_ISA
