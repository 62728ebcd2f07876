// Measured reflection: lobes are written to files, read again and fitted.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <unistd.h>

#include "fit/fit.h"
#include "integrals/ggx/ltc_radiance.h"
#include "steradian/error.h"

namespace steradian::fit::samples_test {
namespace {

struct File {
  std::string path = (std::filesystem::temp_directory_path() / ("steradian_samples_" + std::to_string(getpid()))).string();
  explicit File(const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~File() { std::filesystem::remove(path); }
};

// A file of MERL's layout for an isotropic BRDF, from its definition. Its cells are those of three angles, the last fastest. The first is
// the half vector's angle, with edges uniform in its square root. The others are the difference vector's angle and its azimuth.
std::string merl(int half, int angles, int azimuths, const std::function<double(Vec3d view, Vec3d light)>& brdf) {
  std::string bytes;
  const auto append = [&](auto x) { bytes.append(reinterpret_cast<const char*>(&x), sizeof x); };
  for (const int n : {half, angles, azimuths}) append(static_cast<std::int32_t>(n));
  for (const double unit : {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0})
    for (int i = 0; i < half; ++i)
      for (int j = 0; j < angles; ++j)
        for (int k = 0; k < azimuths; ++k) {
          const double root = (i + 0.5) / half, th = 0.5 * std::numbers::pi * root * root, td = 0.5 * std::numbers::pi * (j + 0.5) / angles,
                       pd = std::numbers::pi * (k + 0.5) / azimuths;
          const Vec3d difference{std::sin(td) * std::cos(pd), std::sin(td) * std::sin(pd), std::cos(td)};
          const auto turned = [&](Vec3d v) {
            return Vec3d{std::cos(th) * v.x + std::sin(th) * v.z, v.y, std::cos(th) * v.z - std::sin(th) * v.x};
          };
          const Vec3d light = turned(difference), view = turned({-difference.x, -difference.y, difference.z});
          append(light.z > 0 && view.z > 0 ? brdf(view, light) / unit : -1.0);
        }
  return bytes;
}

double ggx(double alpha, Vec3d view, Vec3d light) {
  // Azimuths are relative to the view's, as for lobes.
  const double across = std::hypot(view.x, view.y);
  const Vec3d x = across > 0 ? Vec3d{view.x / across, view.y / across, 0} : Vec3d{1, 0, 0}, y{-x.y, x.x, 0};
  return ggx_lobe(alpha, {across, 0, view.z}).evaluate({dot(light, x), dot(light, y), light.z}) / light.z;
}

// A table of every combination of angles.
std::string table(const std::vector<double>& thetas, const std::vector<double>& azimuths,
                  const std::function<double(double, double, double)>& f) {
  std::string text = "# theta_view theta_light azimuth value\n\n";
  for (const double v : thetas)
    for (const double l : thetas)
      for (const double a : azimuths)
        text +=
            std::to_string(v) + " " + std::to_string(l) + ", " + std::to_string(a) + "\t" + std::to_string(f(v, l, a)) + "  # a sample\n";
  return text;
}

Vec3d direction(double theta, double azimuth) {
  const double t = theta * std::numbers::pi / 180, a = azimuth * std::numbers::pi / 180;
  return {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)};
}

}  // namespace

TEST(Samples, MerlsBinaryIsReadAsItsDefinitionSays) {
  const double alpha = 0.3;
  const File file(merl(90, 45, 60, [&](Vec3d v, Vec3d l) { return ggx(alpha, v, l); }));
  const LobeSamples samples = read_lobe_samples(file.path);
  EXPECT_EQ(samples.family.frame, LobeFrame::mirror);
  EXPECT_NEAR(std::pow(*samples.family.fixed_roughness, 2), alpha, 0.1 * alpha) << "as wide as it is";
  for (const double cosine : {0.95, 0.7, 0.4}) {
    const Vec3d view = view_from_cosine(cosine);
    const Lobe read = samples.family.at(0.123, cosine), own = ggx_lobe(alpha, view);
    const double peak = own.evaluate({-view.x, 0, view.z});
    // The values are linear between cells of 2 degrees of difference. The half vector's cells are at most 1 degree near the peak of a lobe
    // 17 degrees wide. The error is (1/17)^2 / 8 of its curvature, 2, and as much from the other angles.
    for (const Vec3d l : {Vec3d{-view.x, 0, view.z}, direction(20, 150), direction(50, 100), direction(35, -120)})
      EXPECT_NEAR(read.evaluate(l), own.evaluate(l), 0.01 * peak) << cosine;
    EXPECT_EQ(read.evaluate({0.6, 0, -0.8}), 0);
  }
  const Lobe above = samples.family.at(0, 1);
  double albedo = 0;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const Vec3d l = above.sample((i + 0.5) / 64, (j + 0.5) / 64);
      if (l.z > 0) albedo += ggx_lobe(alpha, {0, 0, 1}).evaluate(l) / above.pdf(l) / (64 * 64);
    }
  for (const double channel : {samples.albedo.x, samples.albedo.y, samples.albedo.z}) EXPECT_NEAR(channel, albedo, 0.01 * albedo);
}

TEST(Samples, AFitOfSamplesIsThatOfTheLobe) {
  const double alpha = 0.3, roughness = std::sqrt(alpha);
  const File file(merl(90, 45, 60, [&](Vec3d v, Vec3d l) { return ggx(alpha, v, l); }));
  const LobeSamples samples = read_lobe_samples(file.path);
  FitOptions options;
  options.size = 3;
  options.nodes = 24;
  options.lights = 0;
  const LtcTable table = fit_table(samples.family, options);
  for (int j = 0; j < 3; ++j) {
    const LtcCell lobe = fit_cell(lobe_family("ggx"), roughness, ltc_cosine_at(j, 3), {}, options);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(table.at(i, j).albedo, table.at(0, j).albedo) << "the same for every roughness";
    if (j == 2) continue;  // half a degree from grazing, where cells of 2 degrees resolve little
    EXPECT_NEAR(table.at(0, j).albedo, lobe.albedo, 0.02 * lobe.albedo) << j;
    EXPECT_LT(table.at(0, j).error, lobe.error + 0.03) << j;
  }
}

TEST(Samples, TablesAreLinearBetweenTheirAngles) {
  const auto f = [](double v, double l, double a) { return 0.1 + 0.001 * v + 0.002 * l + 0.0005 * a; };
  const File file(table({0, 30, 60, 85}, {0, 45, 90, 180}, f));
  const LobeSamples samples = read_lobe_samples(file.path);
  for (const double azimuth : {0.0, 30.0, 100.0, -100.0, 180.0})
    for (const double theta : {10.0, 70.0}) {
      const Lobe lobe = samples.family.at(0.5, std::cos(40 * std::numbers::pi / 180));
      const Vec3d l = direction(theta, azimuth);
      EXPECT_NEAR(lobe.evaluate(l), f(40, theta, std::fabs(azimuth)) * l.z, 1e-5) << azimuth << " " << theta;
    }
  const Lobe grazing = samples.family.at(0.5, std::cos(89 * std::numbers::pi / 180));
  EXPECT_NEAR(grazing.evaluate({0, 0, 1}), f(85, 0, 0), 1e-6) << "constant beyond the last";

  // A table of a whole turn gives the mean of both sides.
  const File whole(table({0, 90}, {0, 90, 180, 270, 360}, [](double, double, double a) { return a == 90 ? 0.3 : a == 270 ? 0.1 : 0.2; }));
  const Lobe lobe = read_lobe_samples(whole.path).family.at(0.5, 0.5);
  EXPECT_NEAR(lobe.evaluate(direction(60, 90)), 0.2 * 0.5, 1e-6);
  EXPECT_NEAR(lobe.evaluate(direction(60, -90)), 0.2 * 0.5, 1e-6);
}

TEST(Samples, RefusesWhatIsNoTable) {
  const std::string good = table({0, 45}, {0, 180}, [](double, double, double) { return 0.2; });
  const auto refusal = [](const std::string& text) {
    const File file(text);
    try {
      read_lobe_samples(file.path);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(refusal(good), "none");
  EXPECT_NE(refusal("").find("no samples"), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.rfind('\n', good.size() - 2) + 1)).find("every combination"), std::string::npos);
  EXPECT_NE(refusal(good + "0 0 0 1\n").find("every combination"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 1\n0 0 0 1\n").find("every combination"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 1\n0 0 north 1\n").find(":2"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 1 2\n").find("5 numbers"), std::string::npos);
  EXPECT_NE(refusal("0 91 0 1\n").find("angle"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 -1\n").find("negative"), std::string::npos);
  std::string broken = merl(4, 3, 2, [](Vec3d, Vec3d) { return 0.1; });
  const double nan = std::nan("");
  std::memcpy(broken.data() + 12, &nan, 8);
  EXPECT_NE(refusal(broken).find("not a number"), std::string::npos);
}

}  // namespace steradian::fit::samples_test
