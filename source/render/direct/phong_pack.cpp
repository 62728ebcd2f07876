#include "integrals/phong/phong.h"
#include "render/direct/lobe_loop_pack.h"

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

// A function for each method, so that it holds one walk in registers. walk(seen, frame, p, shading, integral): the sum.
template <class Share, class Walk>
__attribute__((flatten, noinline)) void walk_points(const Share& share, const PackLight& light, const Points& points, const PackLobe& lobe,
                                                    const LobeRadiance& result, const Walk& walk) {
  integrals::PhongIntegral<Pack, Share> integral(share, lobe.lobe.exponent, lobe.options);
  for_each_pack(light, points, result, [&](std::size_t i, const PackVec3& p, const SeenLight& seen) {
    const PackVec3 n = load(points.normal, i), v = load(points.view, i);
    const auto frame = PackKernels().frame_from_normal(n);
    return walk(seen, frame, p, seen.shading(transform_transposed(frame, v)), integral);
  });
}

}  // namespace

void phong_lobe_on_packs(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result) {
  const double exponent = lobe.lobe.exponent;
  const PhongOptions& options = lobe.options;
  const integrals::PhongLobe<Pack> of(exponent, options);
  // The corners of a round light gather about the mirrored view.
  const auto curved = [&](const auto& share) {
    walk_points(share, light, points, lobe, result,
                [&](const SeenLight& seen, const auto& frame, const PackVec3& p, const auto& shading, auto& integral) {
                  if (light.is_pieces()) return integrate(PiecesOutline{seen, frame}, shading, integral);
                  const AboutLobe about = {PackKernels().phong_mirror(shading.view), PackReal(1 / std::sqrt(exponent + 1)), 12};
                  return integrate(RoundOutline{seen, frame, p, about}, shading, integral);
                });
  };
  const auto series = [&]<Quality quality>() {
    curved([&](const auto& a, const auto& b, const auto& axis) { return of.template share<Method::series, quality>(a, b, axis); });
  };
  if (!light.is_pieces() && !light.is_round())
    integrals::with_phong_share<Pack>(of, options, [&](const auto& share) {
      walk_points(share, light, points, lobe, result,
                  [](const SeenLight& seen, const auto& frame, const PackVec3& p, const auto& shading, auto& integral) {
                    return integrate(PolygonOutline{{seen, frame, p}}, shading, integral);
                  });
    });
  else if (options.method != Method::series)
    integrals::with_phong_share<Pack>(of, options, [&](const auto& share) { curved(CalledShare(share)); });
  else if (options.quality == Quality::high)
    series.template operator()<Quality::high>();
  else
    series.template operator()<Quality::normal>();
}

STERADIAN_END_ISA
