// Small lights: every method at every size, in double and in float, against quadrature; and the elements' own bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "integrals/methods.h"
#include "lobes/lobe.h"
#include "shapes/outline.h"
#include "shapes/small_light.h"
#include "steradian/reference.h"

namespace steradian::small_light_test {
namespace {

// Error of a method over a light that is a thousandth of its distance or less, as a fraction of what it sends. The tables have the error of
// their fit at any size. The published fits and float's series err only where double's elements do not serve yet. All others have rounding
// errors: 24 bits, and 53 bits of vertices that the distance has rounded.
double stated(Method method, Precision precision, double size) {
  switch (method) {
    case Method::ltc:
    case Method::ltc_compact:
    case Method::ltc_clipless: return 0.03;
    case Method::representative_point: return 3 * size + 1e-5;
    case Method::lorentzian:
    case Method::pearson:
    case Method::ellipsoid:
      return precision == Precision::float_ ? 1e-4 : 0.07;  // their own bias, over lights that are small against the lobe
    default: return precision == Precision::float_ ? 1e-4 : 1e-7 + 1e-15 / size;
  }
}

PolygonLight small_light(double size, double distance) {
  const Vec3d center = normalized(Vec3d{-0.5, 0.8, -0.1}) * distance;
  const Vec3d x = Vec3d{0.8, 0.3, 0} * (size * distance), y = Vec3d{0, 0.2, -0.9} * (size * distance);
  PolygonLight light;
  light.vertices = {center - x - y, center + x - y, center + x * 0.4 + y, center - x + y};  // not symmetric
  if (dot(cross(x, y), center) > 0) std::reverse(light.vertices.begin(), light.vertices.end());
  return light;
}

Material material(Brdf brdf, double width) {
  Material m;
  m.brdf = brdf;
  m.exponent = width;
  m.alpha_x = m.alpha_y = width;
  return m;
}

}  // namespace

TEST(SmallLight, EveryMethodAtEverySize) {
  const ShadingPoint at = {{}, {0, 1, 0}, normalized(Vec3d{0.6, 0.8, 0.2})};
  Material unshadowed = material(Brdf::ggx, 0.25);
  unshadowed.shadowing = false;
  Material product = material(Brdf::lobe_product, 30), foreshortened = material(Brdf::phong, 20);
  product.axis_exponent = 8;
  product.axis = {0.2, 1, 0.1};
  foreshortened.foreshortening = true;
  const Material materials[] = {material(Brdf::lambert, 1),
                                material(Brdf::phong, 20),
                                material(Brdf::ggx, 0.25),
                                material(Brdf::blinn_phong, 50),
                                material(Brdf::beckmann, 0.25),
                                unshadowed,
                                material(Brdf::charlie, 0.5),
                                product,
                                foreshortened};
  int tested = 0;
  for (const Material& m : materials)
    for (const double distance : {1e-6, 4.0, 1e6})
      for (const double size : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
        const PreparedPolygon light = prepare_polygon(small_light(size, distance));
        // The lobe in the light's direction times its solid angle has an error of a fraction of the size squared.
        const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
        const lobes::Lobe lobe(lobes::in_frame(m, frame), frame.to_local(at.view));
        const Vec3d to = light.quarters.center - at.position, direction = normalized(to);
        const double solid_angle = -dot(light.normal, direction) * light.area / dot(to, to);
        const double truth = lobe.radiance(lobe.evaluate(frame.to_local(direction))).x * solid_angle;
        for (const methods::Row& entry : methods::all()) {
          if (!entry.serves(m) || entry.method == Method::sampled || entry.method == Method::reference) continue;
          for (const Precision precision : {Precision::double_, Precision::float_}) {
            RadianceOptions options;
            options.precision = precision;
            const double value = entry.polygon(light, at, m, options).radiance.x;
            EXPECT_NEAR(value / truth, 1, stated(entry.method, precision, size) + 200 * size * size)
                << entry.name << " " << name_of(m.brdf) << " size " << size << " distance " << distance
                << (precision == Precision::float_ ? " float" : " double");
            ++tested;
          }
        }
      }
  EXPECT_GT(tested, 600);
}

// Lights against which these approximations are biased at any quality: the elements replace them.
TEST(SmallLight, NoBiasInsideALobe) {
  const ShadingPoint at = {{}, {0, 1, 0}, normalized(Vec3d{0.6, 0.8, 0.2})};
  for (const Material& m : {material(Brdf::phong, 20), material(Brdf::phong, 500), material(Brdf::beckmann, 0.25),
                            material(Brdf::beckmann, 0.04), material(Brdf::blinn_phong, 200)})
    for (const double size : {0.003, 0.01, 0.03, 0.1, 0.3}) {
      const PreparedPolygon light = prepare_polygon(small_light(size, 2));
      const double truth = reference_radiance(light, at, m).radiance.x;
      const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
      const lobes::Lobe lobe(m, frame.to_local(at.view));
      const double peak = lobe.evaluate(lobe.shape().peak).plain;
      // Light from the lobe's peak, at most 1: the scale of the bias.
      const double full = std::min(1.0, peak * light.area / 4);
      for (const Quality quality : {Quality::normal, Quality::high})
        for (const Precision precision : {Precision::double_, Precision::float_}) {
          RadianceOptions options;
          options.quality = quality;
          options.precision = precision;
          const methods::Row& entry = methods::resolve(m.brdf == Brdf::phong ? Method::series : Method::half_vector, m, precision, quality);
          EXPECT_NEAR(entry.polygon(light, at, m, options).radiance.x, truth, 0.008 * full)
              << entry.name << " " << name_of(m.brdf) << " " << m.exponent << " " << m.alpha_x << " size " << size;
        }
    }
}

// The bound t^3 / 8 of kernels/outline/light_elements.glsl: parallelograms and triangles near the peaks of lobes.
TEST(LightElements, ErrorIsBelowItsBound) {
  Kernels<double> k;
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) { return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto vector = [&] { return Vec3d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; };
  double largest_share = 0;
  for (int i = 0; i < 400; ++i) {
    const Material m = i % 4 == 0   ? material(Brdf::phong, 100)
                       : i % 4 == 1 ? material(Brdf::ggx, 0.1)
                       : i % 4 == 2 ? material(Brdf::beckmann, 0.2)
                                    : material(Brdf::lambert, 1);
    const double view_z = uniform(0.15, 1);
    const Vec3d view{std::sqrt(1 - view_z * view_z), 0, view_z};
    const lobes::Lobe lobe(m, view);
    const Vec3d peak = m.brdf == Brdf::lambert ? Vec3d{0, 0, 1} : Vec3d{-view.x, 0, view.z};
    const double sharpness = m.brdf == Brdf::phong ? k.light_elements_sharpness(0.1).v
                             : m.brdf == Brdf::lambert
                                 ? k.light_elements_diffuse_sharpness().v
                                 : k.light_elements_half_vector_sharpness(m.brdf == Brdf::ggx ? 0.05 : 0.2 / std::sqrt(2.0), view_z).v;
    const double t = uniform(0.1, 0.7), deviation = t / sharpness;
    const Vec3d direction = normalized(peak + vector() * (2 / sharpness));
    if (direction.z < 0.05 + 3 * deviation) continue;
    const Vec3d normal = normalized(vector() * 0.5 - direction);
    const Frame plane = Frame::from_normal(normal);
    const double turn = uniform(0, 6.28), aspect = uniform(0.3, 1);
    const Vec3d x = plane.x * std::cos(turn) + plane.y * std::sin(turn), y = cross(normal, x) * aspect;
    // The shape has units in which its deviation is computed first, then it is scaled.
    PolygonLight shape;
    shape.vertices = i % 2 == 0 ? std::vector<Vec3d>{-x - y, x - y, x + y, y - x} : std::vector<Vec3d>{-x - y, x - y, x * 0.3 + y};
    const LightQuarters q = prepare_polygon(shape).quarters;
    const double scale = deviation / std::sqrt((dot(q.reach_a, q.reach_a) + dot(q.reach_b, q.reach_b)) / 2);
    for (Vec3d& v : shape.vertices) v = direction + (v - q.center) * scale;
    const PreparedPolygon light = prepare_polygon(shape);
    const Frame local{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto elements = integrals::contours_in<double>(light, local, {}).elements();
    double value = 0;
    for (int j = 0; j < 4; ++j) {
      const auto element = k.light_element_at(elements, j);
      const auto& l = element.direction;
      value += lobe.evaluate({l.x.v, l.y.v, l.z.v}).plain * element.solid_angle.v;
    }
    const double truth = reference_radiance(light, {{}, {0, 0, 1}, view}, m).radiance.x;
    double highest = lobe.evaluate(peak).plain;
    for (int j = 0; j < 400; ++j) highest = std::max(highest, lobe.evaluate(normalized(peak + vector() * (2 / sharpness))).plain);
    const double share = std::fabs(value - truth) / (highest * light.area) / (t * t * t / 8);
    EXPECT_LT(share, 1) << name_of(m.brdf) << " t " << t << " view " << view_z;
    largest_share = std::max(largest_share, share);
  }
  EXPECT_GT(largest_share, 0.2);  // the bound holds and is not far from the error
}

// The family of small rects about the plane of the surface that they light: any place, size and tilt about one of their axes, with half of
// them below the surface. The upper half's irradiance by Gauss is the truth. Errors are fractions of what the rect sends face on.
TEST(SmallLight, TiltedRectsAboutTheSurfacesPlane) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> any(0, 1);
  constexpr std::array<double, 8> kTilts = {0, 1e-9, 1e-7, 1e-5, 1e-3, 0.03, 0.3, 1.2};
  std::array<double, 2> worst{};
  int tried = 0;
  for (int k = 0; k < 400; ++k) {
    const Frame floor = Frame::from_normal(normalized(Vec3d{any(engine) - 0.5, any(engine) - 0.5, any(engine) - 0.5}));
    const Vec3d origin = {any(engine), any(engine), any(engine)};
    const double size = std::pow(10.0, -3 + 2 * any(engine)), distance = size * (3 + 30 * any(engine)), ratio = 0.2 + any(engine);
    const double tilt = kTilts[static_cast<std::size_t>(k) % kTilts.size()], around = 6 * any(engine);
    const auto world = [&](double x, double y, double z) { return origin + floor.x * x + floor.y * y + floor.z * z; };
    const auto of_light = [&](double u, double v) {  // u along the axis of the tilt
      const double y = v * std::cos(tilt), z = v * std::sin(tilt);
      return world(distance + u * std::cos(around) - y * std::sin(around), u * std::sin(around) + y * std::cos(around), z);
    };
    PolygonLight light;
    light.vertices = {of_light(-size, -size * ratio), of_light(size, -size * ratio), of_light(size, size * ratio),
                      of_light(-size, size * ratio)};
    light.two_sided = true;
    const Vec3d normal = normalized(cross(light.vertices[1] - light.vertices[0], light.vertices[3] - light.vertices[0]));
    constexpr std::array<double, 8> kNodes = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
                                              0.5917173212478249, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681};
    constexpr std::array<double, 8> kWeights = {0.0506142681451881, 0.1111905172266872, 0.1568533229389436, 0.1813418916891810,
                                                0.1813418916891810, 0.1568533229389436, 0.1111905172266872, 0.0506142681451881};
    double truth = 0;
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = 0; j < 8; ++j) {
        const double height = kNodes[j] * size * ratio * std::sin(tilt);
        const Vec3d to = of_light(size * (2 * kNodes[i] - 1), kNodes[j] * size * ratio) - origin;
        const double square = dot(to, to);
        truth += kWeights[i] * kWeights[j] * 2 * size * size * ratio * height * std::fabs(dot(normal, to)) / (square * square);
      }
    const double face_on = 4 * size * size * ratio / (distance * distance);
    Material white;
    white.brdf = Brdf::lambert;
    const ShadingPoint at = {origin, floor.z, floor.z};
    const PreparedPolygon prepared = prepare_polygon(light);
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      RadianceOptions options;
      options.precision = precision;
      const double value =
          methods::resolve(Method::exact, white, precision, Quality::normal).polygon(prepared, at, white, options).radiance.x *
          std::numbers::pi;
      const double error = std::fabs(value - truth) / face_on;
      auto& most = worst[precision == Precision::float_ ? 1 : 0];
      most = std::max(most, error);
    }
    ++tried;
  }
  std::printf("%d rects: worst error %.1e in double, %.1e in float, of what they send face on\n", tried, worst[0], worst[1]);
  // Coordinates of 1 are rounded by 2^-53, over sizes from 1e-3: a tilt of 1e-13, which a wrong side would turn into light. Gauss errs by
  // (size / distance / 2)^16. Float rounds directions by 2^-24 and sums some of them.
  EXPECT_LT(worst[0], 1e-11);
  EXPECT_LT(worst[1], 1e-5);
}

}  // namespace steradian::small_light_test
